//! Light that comes from one direction: the sun.

use crate::vector::Vector;

/// A light so far away that all its light travels in one direction and does not weaken with distance (3.8): E_j = v_j E₀
/// cosθ_i.
#[derive(Clone, Debug, PartialEq)]
pub struct ParallelLight {
    /// The direction in which it travels, a unit vector: −L.
    pub direction: Vector,
    /// E₀: the irradiance (W/m²) or illuminance (lx) on a plane perpendicular to the direction.
    pub irradiance: f64,
}
