//! The unbounded plane (2.4).

use super::body::{Body, Form};
use super::placement::Placement;
use super::{Accuracy, Intersection, Measure, NearestPoint, flat};
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vector::Vector;

/// (P − Q)·N = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    placement: Placement,
}

impl Plane {
    /// It in its own axes.
    pub(super) fn body(&self) -> Body {
        Body::placed(&self.placement, Form::Plane, 0.0)
    }

    /// Its axes: the third is normal to it.
    pub(crate) fn placement(&self) -> &Placement {
        &self.placement
    }

    /// The plane through a point, perpendicular to a direction (of any nonzero length).
    #[must_use]
    pub fn new(point: Vector, normal: Vector) -> Self {
        Self { placement: Placement::along(point, Vector::from_f64(normal)) }
    }

    /// Intersects a ray with it.
    pub fn intersect<T: Scalar>(&self, ray: &Ray<T>, accuracy: Accuracy) -> Intersection<T> {
        flat::intersect(&self.placement, None, ray, accuracy, |_, _| -T::from_f64(f64::INFINITY))
    }

    /// The distance from it, never negative.
    #[must_use]
    pub fn distance(&self, point: Vector) -> f64 {
        self.placement.place_of(point).z.abs()
    }

    /// The point of it nearest to a given point, with N on that point's side.
    #[must_use]
    pub fn nearest(&self, point: Vector) -> NearestPoint {
        flat::nearest(&self.placement, point, |place| Vector::new(place.x, place.y, 0.0))
    }

    /// A substitute for its size at a point, in metres: the point's distance from Q, plus a millionth of Q's distance from
    /// the origin, so that coordinates rounded to 15 digits count as on the plane.
    #[must_use]
    pub fn size_near(&self, point: Vector) -> f64 {
        (point - self.placement.origin).length() + 1e-6 * self.placement.origin.length()
    }

    /// The values that describe it.
    #[must_use]
    pub fn measures(&self) -> Vec<(&'static str, Measure)> {
        vec![("point", Measure::Vector(self.placement.origin)), ("normal", Measure::Vector(self.placement.axis(2)))]
    }
}
