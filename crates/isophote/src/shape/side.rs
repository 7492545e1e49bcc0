//! The two sides of a surface.

use serde::{Deserialize, Serialize};

use crate::units::Keyword;

/// One of the two sides of a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// The outside of a closed shape; the side to which the normal of a flat one leads; of a grid that of u × v.
    #[default]
    Front,
    /// The other one.
    Back,
}

impl Keyword for Side {
    const ALL: &'static [Self] = &[Self::Front, Self::Back];

    fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
        }
    }
}

impl Side {
    /// 1 for the front, −1 for the back: what a normal is multiplied by.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Front => 1.0,
            Self::Back => -1.0,
        }
    }
}
