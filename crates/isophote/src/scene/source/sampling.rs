//! How pixels are sampled, as it is written.

use super::declare::tables;
use crate::scene::{Filter, limits};

tables! {
    /// How many rays a pixel's value is made of.
    #[serde(deny_unknown_fields)]
    pub struct SamplingSource {
        /// Rays for each pixel. With a tolerance the most that a pixel gets, 4096 by default.
        #[schemars(range(min = 1, max = limits::SAMPLES), extend("default" = 1))]
        pub samples: Option<u64>,
        /// The error of a pixel's brightness that is allowed, as a part of the largest brightness of the image: each pixel
        /// gets as many rays as that takes.
        #[schemars(range(min = *limits::TOLERANCE.start(), max = *limits::TOLERANCE.end()))]
        pub tolerance: Option<f64>,
        /// What a pixel is a mean over.
        #[schemars(extend("default" = "box"))]
        pub filter: Option<Filter>,
    }
}
