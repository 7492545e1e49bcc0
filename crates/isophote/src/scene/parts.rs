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

/// A circle or a rectangle whose extremes and mean are reported. Lengths in metres, or in degrees on the screen of a camera
/// that has them.
#[derive(Clone, Debug, PartialEq)]
pub struct Area {
    /// Its name, unique among the areas.
    pub name: String,
    /// Where it is.
    pub place: AreaPlace,
    /// Its outline.
    pub outline: AreaOutline,
}

/// Where an area is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AreaPlace {
    /// On a flat shape.
    Surface {
        /// Index of the shape.
        shape: usize,
        /// Its centre.
        center: Vector,
        /// The unit vectors along its width and its height.
        axes: [Vector; 2],
    },
    /// On the screen: its centre, x and y.
    Screen([f64; 2]),
}

/// The outline of an area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AreaOutline {
    /// A circle.
    Circle {
        /// Its radius.
        radius: f64,
    },
    /// A rectangle.
    Rectangle {
        /// Half its width and half its height.
        half: [f64; 2],
    },
}

impl AreaOutline {
    /// Its area, in square metres or square degrees.
    #[must_use]
    pub fn content(&self) -> f64 {
        match *self {
            Self::Circle { radius } => std::f64::consts::PI * radius * radius,
            Self::Rectangle { half: [width, height] } => 4.0 * width * height,
        }
    }

    /// The nearest place within: places are (1, 0) and (0, 1) at the ends of its half axes.
    #[must_use]
    pub fn within(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Circle { .. } => {
                let distance = libm::hypot(u, v).max(1.0);
                [u / distance, v / distance]
            }
            Self::Rectangle { .. } => [u.clamp(-1.0, 1.0), v.clamp(-1.0, 1.0)],
        }
    }

    /// How far a place within is from the centre.
    #[must_use]
    pub fn offset(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        match *self {
            Self::Circle { radius } => [u * radius, v * radius],
            Self::Rectangle { half: [width, height] } => [u * width, v * height],
        }
    }
}

impl AreaPlace {
    /// The point at an offset from the centre, on a surface.
    #[must_use]
    pub fn point(&self, [along_width, along_height]: [f64; 2]) -> Option<Vector> {
        match *self {
            Self::Surface { center, axes: [width, height], .. } => {
                Some(center + width * along_width + height * along_height)
            }
            Self::Screen(_) => None,
        }
    }
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
