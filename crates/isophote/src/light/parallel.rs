//! Light that comes from one direction: the sun.

use super::{PlacedLight, Rays};
use crate::scalar::Scalar;
use crate::vector::Vector;

/// A light so far away that all of it travels in one direction and none of it is lost on the way (3.8):
/// E_j = v_j E₀ cosθ_i.
#[derive(Clone, Debug, PartialEq)]
pub struct ParallelLight {
    /// The direction in which it travels, a unit vector: −L.
    pub direction: Vector,
    /// E₀: the irradiance (W/m²) or illuminance (lx) of a plane at right angles to the direction.
    pub irradiance: f64,
}

impl ParallelLight {
    #[inline(always)]
    pub(super) fn seen_from_anywhere<T: Scalar>(&self) -> PlacedLight<T> {
        PlacedLight {
            position: Vector::from_f64(-self.direction),
            intensity: T::from_f64(self.irradiance),
            rays: Rays::Parallel,
        }
    }
}
