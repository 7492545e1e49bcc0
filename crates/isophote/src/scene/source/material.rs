//! Materials, as they are written.

use super::declare::tables;
use super::{Amount, amount};
use crate::scene::limits;

tables! {
    /// What a surface is made of.
    #[serde(deny_unknown_fields)]
    pub struct MaterialSource {
        /// Diffuse coefficient k_d, or those of red, green and blue.
        #[schemars(required, with = "Option<amount::Coefficient>")]
        pub diffuse: Option<Amount>,
        /// Specular coefficient k_s, or those of red, green and blue.
        #[schemars(with = "Option<amount::Coefficient>", extend("default" = 0))]
        pub specular: Option<Amount>,
        /// Shininess n, the exponent of the highlight. Must be given where `specular` is not 0.
        #[schemars(extend("exclusiveMinimum" = 0), range(max = limits::SHININESS))]
        pub shininess: Option<f64>,
    }
}
