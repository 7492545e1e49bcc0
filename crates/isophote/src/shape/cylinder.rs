//! The cylinder with both its ends (2.4).

use super::body::Body;
use super::{Accuracy, Bounds, Cone, Intersection, Measure, NearestPoint};
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vector::Vector;

/// The points within a radius of the segment between two points, with flat ends: a [`Cone`] with equal radii.
#[derive(Clone, Debug, PartialEq)]
pub struct Cylinder {
    body: Cone,
}

impl Cylinder {
    /// It in its own axes.
    pub(super) fn body(&self) -> Body {
        self.body.body()
    }

    /// A cylinder between two distinct points, with a radius in metres, positive.
    #[must_use]
    pub fn new(from: Vector, to: Vector, radius: f64) -> Self {
        Self { body: Cone::new(from, to, [radius, radius]) }
    }

    /// See [`Cone::intersect`].
    pub fn intersect<T: Scalar>(&self, ray: &Ray<T>, accuracy: Accuracy) -> Intersection<T> {
        self.body.intersect(ray, accuracy)
    }

    /// See [`Cone::signed_distance`].
    #[must_use]
    pub fn signed_distance(&self, point: Vector) -> f64 {
        self.body.signed_distance(point)
    }

    /// See [`Cone::nearest`].
    #[must_use]
    pub fn nearest(&self, point: Vector) -> NearestPoint {
        self.body.nearest(point)
    }

    /// The centres of its two ends.
    #[must_use]
    pub fn ends(&self) -> [Vector; 2] {
        self.body.ends()
    }

    /// R, in metres.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.body.radii()[0]
    }

    /// Its bounding box, with sides along the scene's axes.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        self.body.bounds()
    }

    /// See [`Cone::size`].
    #[must_use]
    pub fn size(&self) -> f64 {
        self.body.size()
    }

    /// See [`Cone::relative_distance`].
    #[must_use]
    pub fn relative_distance(&self, point: Vector) -> f64 {
        self.body.relative_distance(point)
    }

    /// The values that describe it.
    #[must_use]
    pub fn measures(&self) -> Vec<(&'static str, Measure)> {
        let [from, to] = self.body.ends();
        vec![
            ("from", Measure::Vector(from)),
            ("to", Measure::Vector(to)),
            ("radius", Measure::Number(self.body.radii()[0])),
        ]
    }
}
