//! Light that comes from one direction: the sun.

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
