//! How the intensity of a point light depends on the direction, as written in the scene.

use super::{Pattern, Spot};
use crate::vector::Vector;

/// The emission pattern I(ω) of a light (section 3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Emission {
    /// I₀ in every direction; power 4π I₀.
    Isotropic,
    /// I₀ max(0, cosγ), γ the angle from the axis; power π I₀.
    Lambertian {
        /// Unit vector of the axis.
        axis: Vector,
    },
    /// I₀ within a cone, 0 outside another: see [`Spot`].
    Spot(Spot),
}

impl Emission {
    /// Power over intensity on the axis, in sr: 4π, π, or that of the [`Spot`].
    #[must_use]
    pub fn solid_angle(self) -> f64 {
        match self {
            Self::Isotropic => 4.0 * std::f64::consts::PI,
            Self::Lambertian { .. } => std::f64::consts::PI,
            Self::Spot(spot) => spot.solid_angle(),
        }
    }

    /// The same pattern in the form that the formula evaluates.
    #[must_use]
    pub fn pattern(self) -> Pattern {
        match self {
            Self::Isotropic => Pattern::Isotropic,
            Self::Lambertian { axis } => Pattern::Lambertian { axis },
            Self::Spot(Spot { cone }) => Pattern::Cone(cone),
        }
    }
}
