//! A cloud of spheres, which counts as one shape.

use super::{NearestPoint, Sphere};
use crate::vector::Vector;

/// Many spheres of a single scene entry, read from a file of points.
#[derive(Clone, Debug, PartialEq)]
pub struct Spheres {
    /// The spheres: the parts of the shape.
    pub spheres: Vec<Sphere>,
    /// For each sphere, the index of its material; empty if all use the shape's own.
    pub materials: Vec<u32>,
}

impl Spheres {
    /// A cloud of at least one sphere.
    #[must_use]
    pub fn new(spheres: Vec<Sphere>, materials: Vec<u32>) -> Self {
        Self { spheres, materials }
    }

    /// The part whose surface is nearest to a point.
    #[must_use]
    pub fn nearest_part(&self, point: Vector) -> u32 {
        let distances = self.spheres.iter().map(|sphere| sphere.signed_distance(point).abs());
        let nearest = (0..).zip(distances).min_by(|(_, first), (_, second)| first.total_cmp(second));
        nearest.map_or(0, |(part, _)| part)
    }

    /// The surface point nearest to a point.
    #[must_use]
    pub fn nearest(&self, point: Vector) -> NearestPoint {
        let part = self.nearest_part(point);
        NearestPoint { part, ..self.spheres[part as usize].nearest(point) }
    }

    /// Signed distance of a point from the union of the spheres: negative inside any of them.
    #[must_use]
    pub fn signed_distance(&self, point: Vector) -> f64 {
        self.spheres.iter().map(|sphere| sphere.signed_distance(point)).fold(f64::INFINITY, f64::min)
    }
}
