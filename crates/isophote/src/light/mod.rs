//! Lights and where they send their power.

mod ambient;
mod emission;
mod emitter;
mod parallel;
mod pattern;
mod point;
mod spot;

pub use ambient::Ambient;
pub use emission::Emission;
pub use emitter::{Emitter, Emitters, PlacedEmitter};
pub use parallel::ParallelLight;
pub use pattern::{Cone, Pattern};
pub use point::PointLight;
pub use spot::Spot;

use crate::vector::Vector;

/// A named light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Its name, unique among the lights.
    pub name: String,
    /// Its kind, with the parameters of that kind.
    pub kind: LightKind,
    /// Whether shapes block its light for one another, if the scene has shadows.
    pub casts_shadows: bool,
    /// Whether it is switched on. A light that is off keeps its place and its name, and has no strength.
    pub is_on: bool,
}

/// The kinds of lights: a closed set, each in a file of its own.
#[derive(Clone, Debug, PartialEq)]
pub enum LightKind {
    /// All of it comes from one point.
    Point(PointLight),
    /// All of it comes from one direction.
    Parallel(ParallelLight),
}

impl Light {
    /// Its position, in metres; `None` for a parallel light, which is outside everything.
    #[must_use]
    pub fn position(&self) -> Option<Vector> {
        match &self.kind {
            LightKind::Point(light) => Some(light.position),
            LightKind::Parallel(_) => None,
        }
    }

    /// The vector from a place to the light, in metres; L, a unit vector, for a parallel light.
    #[must_use]
    pub fn seen_from(&self, place: Vector) -> Vector {
        match &self.kind {
            LightKind::Point(light) => light.position - place,
            LightKind::Parallel(light) => -light.direction,
        }
    }

    /// The same light switched on, or off: without strength.
    #[must_use]
    pub fn switched(mut self, is_on: bool) -> Self {
        self.is_on = is_on;
        match &mut self.kind {
            _ if is_on => {}
            LightKind::Point(light) => light.intensity = 0.0,
            LightKind::Parallel(light) => light.irradiance = 0.0,
        }
        self
    }

    /// The steepest growth of its intensity per radian at an edge of its own, as a fraction of its full strength; 0 if it
    /// has no edge.
    #[must_use]
    pub fn steepest_edge(&self) -> f64 {
        match &self.kind {
            LightKind::Point(PointLight { emission: Emission::Spot(spot), .. }) => spot.steepest(),
            LightKind::Point(_) | LightKind::Parallel(_) => 0.0,
        }
    }
}
