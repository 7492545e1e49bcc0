//! The parts of a scene, besides its camera and its lights.

use super::source::ShadowSource;
use crate::map::Resolution;
use crate::reflectance::Reflectance;
use crate::shape::{Geometry, Side};
use crate::vector::Vector;

/// A named material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its name, unique among the materials.
    pub name: String,
    /// Its coefficients.
    pub reflectance: Reflectance,
}

/// An object that can be seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Its name, unique among the shapes.
    pub name: String,
    /// Index of its material; `None` only in the `irradiance` convention.
    pub material: Option<usize>,
    /// Its form and place.
    pub geometry: Geometry,
    /// Whether it blocks other shapes' light, if the scene has shadows.
    pub casts_shadow: bool,
    /// Whether other shapes block its light.
    pub receives_shadow: bool,
}

impl Shape {
    pub(super) fn new(name: String, material: Option<usize>, geometry: Geometry, shadow: ShadowSource) -> Self {
        let [casts_shadow, receives_shadow] =
            [shadow.casts_shadow, shadow.receives_shadow].map(|written| written.unwrap_or(true));
        Self { name, material, geometry, casts_shadow, receives_shadow }
    }
}

/// A point on a surface whose values are reported.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Its name, unique among the probes.
    pub name: String,
    /// The point, in metres.
    pub at: Vector,
    /// A published value for this point, in the unit of the brightness.
    pub published: Option<f64>,
}

/// Points on a rectangle at which the irradiance is computed. Lengths in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Its name, unique among the grids.
    pub name: String,
    /// The corner where both edges begin.
    pub corner: Vector,
    /// One edge.
    pub u: Vector,
    /// The other edge, perpendicular to the first.
    pub v: Vector,
    /// The number of points along u and along v.
    pub points: Resolution,
    /// The lit side: u × v points to the front.
    pub side: Side,
}
