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

/// A light with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Its name, unique among the lights.
    pub name: String,
    /// What it is.
    pub kind: LightKind,
    /// Whether shapes keep its light from each other, if the scene has shadows.
    pub casts_shadows: bool,
}

/// The kinds of lights. A closed set: each has a file of its own.
#[derive(Clone, Debug, PartialEq)]
pub enum LightKind {
    /// All of it comes from one point.
    Point(PointLight),
    /// All of it comes from one direction.
    Parallel(ParallelLight),
}

impl Light {
    /// Where it stands, in metres; a parallel light stands nowhere, and outside everything.
    #[must_use]
    pub fn position(&self) -> Option<Vector> {
        match &self.kind {
            LightKind::Point(light) => Some(light.position),
            LightKind::Parallel(_) => None,
        }
    }

    /// The way from a place to the light, in metres; of a parallel light L, a unit vector.
    #[must_use]
    pub fn seen_from(&self, place: Vector) -> Vector {
        match &self.kind {
            LightKind::Point(light) => light.position - place,
            LightKind::Parallel(light) => -light.direction,
        }
    }

    /// The largest part of its strength by which it grows per radian at an edge of its own: 0 where it has none.
    #[must_use]
    pub fn steepest_edge(&self) -> f64 {
        match &self.kind {
            LightKind::Point(PointLight { emission: Emission::Spot(spot), .. }) => spot.steepest(),
            LightKind::Point(_) | LightKind::Parallel(_) => 0.0,
        }
    }
}
