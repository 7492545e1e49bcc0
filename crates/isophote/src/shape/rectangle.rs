//! The rectangle (2.4).

use super::body::{Body, Form};
use super::placement::Placement;
use super::{Accuracy, Bounds, Intersection, Measure, NearestPoint, flat};
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vector::Vector;

/// |x| ≤ w/2, |y| ≤ h/2, z = 0 in its own axes, with z along its normal and y along its height.
#[derive(Clone, Debug, PartialEq)]
pub struct Rectangle {
    placement: Placement,
    /// w/2, in metres, positive.
    half_width: f64,
    /// h/2, in metres, positive.
    half_height: f64,
}

impl Rectangle {
    /// It in its own axes.
    pub(super) fn body(&self) -> Body {
        Body::placed(&self.placement, Form::Rectangle([self.half_width, self.half_height]), self.size())
    }

    /// Its axes: the third is normal to it.
    pub(crate) fn placement(&self) -> &Placement {
        &self.placement
    }

    /// A rectangle of this width and height (in metres, positive) around a centre. Its height runs along `up` as far as its
    /// normal allows; the two are not parallel.
    #[must_use]
    pub fn new(center: Vector, [width, height]: [f64; 2], normal: Vector, up: Vector) -> Self {
        let placement = Placement::facing(center, normal, up);
        Self { placement, half_width: 0.5 * width, half_height: 0.5 * height }
    }

    /// A hit of the plane within its borders.
    pub fn intersect<T: Scalar>(&self, ray: &Ray<T>, accuracy: Accuracy) -> Intersection<T> {
        let absolute = |value: T| value.max(-value);
        let beyond =
            |x: T, y: T| (absolute(x) - T::from_f64(self.half_width)).max(absolute(y) - T::from_f64(self.half_height));
        flat::intersect(&self.placement, Some(self.size()), ray, accuracy, beyond)
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
        let [x, y] = [(place.x, self.half_width), (place.y, self.half_height)].map(|(at, half)| at.clamp(-half, half));
        Vector::new(x, y, 0.0)
    }

    /// Its bounding box, with sides along the scene's axes.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        let half = self.placement.half_sides(Vector::new(self.half_width, self.half_height, 0.0));
        Bounds::around(self.placement.origin, half)
    }

    /// Its centre, in metres.
    #[must_use]
    pub fn center(&self) -> Vector {
        self.placement.origin
    }

    /// Unit vectors along its width and its height, and its normal.
    #[must_use]
    pub fn axes(&self) -> [Vector; 3] {
        self.placement.axes()
    }

    /// Width and height, in metres.
    #[must_use]
    pub fn sides(&self) -> [f64; 2] {
        [2.0 * self.half_width, 2.0 * self.half_height]
    }

    /// Half its diagonal, in metres.
    #[must_use]
    pub fn size(&self) -> f64 {
        self.half_width.hypot(self.half_height)
    }

    /// The distance of a point, in units of half the shorter side.
    #[must_use]
    pub fn relative_distance(&self, point: Vector) -> f64 {
        (point - self.placement.origin).length() / self.half_width.min(self.half_height)
    }

    /// The values that describe it.
    #[must_use]
    pub fn measures(&self) -> Vec<(&'static str, Measure)> {
        vec![
            ("center", Measure::Vector(self.placement.origin)),
            ("width", Measure::Number(2.0 * self.half_width)),
            ("height", Measure::Number(2.0 * self.half_height)),
            ("normal", Measure::Vector(self.placement.axis(2))),
            ("up", Measure::Vector(self.placement.axis(1))),
        ]
    }
}
