//! The disk (2.4).

use super::body::{Body, Form};
use super::placement::Placement;
use super::{Accuracy, Bounds, Intersection, Measure, NearestPoint, flat};
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vector::Vector;

/// x² + y² ≤ R², z = 0 in its own axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Disk {
    placement: Placement,
    /// R, in metres, positive.
    radius: f64,
}

impl Disk {
    /// It in its own axes.
    pub(super) fn body(&self) -> Body {
        Body::placed(&self.placement, Form::Disk(self.radius), self.radius)
    }

    /// Its axes: the third is normal to it.
    pub(crate) fn placement(&self) -> &Placement {
        &self.placement
    }

    /// A disk with a radius (in metres, positive) around a centre, perpendicular to a direction (of any nonzero length).
    #[must_use]
    pub fn new(center: Vector, normal: Vector, radius: f64) -> Self {
        Self { placement: Placement::along(center, Vector::from_f64(normal)), radius }
    }

    /// A hit of the plane within its border.
    pub fn intersect<T: Scalar>(&self, ray: &Ray<T>, accuracy: Accuracy) -> Intersection<T> {
        let beyond = |x: T, y: T| x.mul_add(x, y * y).sqrt() - T::from_f64(self.radius);
        flat::intersect(&self.placement, Some(self.radius), ray, accuracy, beyond)
    }

    /// The distance from it, never negative.
    #[must_use]
    pub fn distance(&self, point: Vector) -> f64 {
        let place = self.placement.place_of(point);
        (place - self.nearest_place(place)).length()
    }

    /// The point of it nearest to a given point, with N on that point's side.
    #[must_use]
    pub fn nearest(&self, point: Vector) -> NearestPoint {
        flat::nearest(&self.placement, point, |place| self.nearest_place(place))
    }

    fn nearest_place(&self, place: Vector) -> Vector {
        let distance = place.x.hypot(place.y);
        let scale = if distance > self.radius { self.radius / distance } else { 1.0 };
        Vector::new(place.x * scale, place.y * scale, 0.0)
    }

    /// Its bounding box, with sides along the scene's axes.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        Bounds::of_disk(self.placement.origin, self.placement.axis(2), self.radius)
    }

    /// Its centre, in metres.
    #[must_use]
    pub fn center(&self) -> Vector {
        self.placement.origin
    }

    /// Its unit normal.
    #[must_use]
    pub fn normal(&self) -> Vector {
        self.placement.axis(2)
    }

    /// R, in metres.
    #[must_use]
    pub fn size(&self) -> f64 {
        self.radius
    }

    /// The distance of a point, in radii.
    #[must_use]
    pub fn relative_distance(&self, point: Vector) -> f64 {
        (point - self.placement.origin).length() / self.radius
    }

    /// The values that describe it.
    #[must_use]
    pub fn measures(&self) -> Vec<(&'static str, Measure)> {
        vec![
            ("center", Measure::Vector(self.placement.origin)),
            ("normal", Measure::Vector(self.placement.axis(2))),
            ("radius", Measure::Number(self.radius)),
        ]
    }
}
