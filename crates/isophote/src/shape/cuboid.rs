//! The box (2.4).

use super::body::{Body, Form};
use super::placement::{Placement, Rotation};
use super::span::{Span, pass};
use super::{Accuracy, Bounds, Intersection, Measure, NearestPoint, PLACE_ERROR, ShapeHit, SurfacePoint};
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vector::Vector;

/// A box: |x| ≤ a, |y| ≤ b, |z| ≤ c in its own axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Cuboid {
    placement: Placement,
    /// a, b, c, in metres, positive.
    half: Vector,
}

impl Cuboid {
    /// It in its own axes.
    pub(super) fn body(&self) -> Body {
        Body::placed(&self.placement, Form::Box(self.half), self.size())
    }

    /// Its axes.
    pub(crate) fn placement(&self) -> &Placement {
        &self.placement
    }

    /// a, b and c, in metres.
    pub(crate) fn half_sides(&self) -> Vector {
        self.half
    }

    /// A box with these sides (in metres, positive) around a centre.
    #[must_use]
    pub fn new(center: Vector, size: Vector, rotation: Rotation) -> Self {
        Self { placement: Placement::turned(center, rotation), half: size * 0.5 }
    }

    /// Its centre, in metres.
    #[must_use]
    pub fn center(&self) -> Vector {
        self.placement.origin
    }

    /// From its centre to the middle of a face, along each of its own axes, in metres.
    #[must_use]
    pub fn half_axes(&self) -> [Vector; 3] {
        let [x, y, z] = self.placement.axes();
        [x * self.half.x, y * self.half.y, z * self.half.z]
    }

    /// The part of the ray between each pair of faces, and the intersection of the three parts (2.4).
    pub fn intersect<T: Scalar>(&self, ray: &Ray<T>, accuracy: Accuracy) -> Intersection<T> {
        let local = self.placement.local_ray(ray);
        let size = self.size();
        let error = PLACE_ERROR * (local.reach + size);
        if local.passes_by(size + error) {
            return Intersection::MISS;
        }
        let (places, directions) = (local.nearest.to_array(), local.direction.to_array());
        let half = self.half.to_array().map(T::from_f64);
        let span = |axis: usize| {
            Span::between(places[axis], directions[axis], [-half[axis], half[axis]], error, [2 * axis, 2 * axis + 1])
        };
        let passage = pass([span(0), span(1), span(2)], local.along);
        let doubtful_from = passage.doubtful_from.map(T::from_f64);
        let Some(crossing) = passage.crossing else { return Intersection { hit: None, doubtful_from } };
        let (axis, is_upper) = (crossing.face / 2, crossing.face % 2 == 1);
        let side = T::from_f64(if is_upper { 1.0 } else { -1.0 });
        let mut place = local.at(crossing.at).to_array();
        place[axis] = half[axis] * side;
        let slope = directions[axis];
        let towards_eye = T::from_f64(if T::zero().is_less(slope) { -1.0 } else { 1.0 });
        let cos_theta_o = -(slope * towards_eye);
        let point = SurfacePoint {
            anchor: self.placement.origin,
            offset: self.placement.to_scene(Vector::from(place)),
            normal: self.placement.axis::<T>(axis) * towards_eye,
            view: -ray.direction,
            cos_theta_o,
        };
        let distance = local.along + crossing.at;
        let is_inexact = accuracy.is_exceeded_by(error / (size * cos_theta_o.rounded()), 0.0);
        let doubtful_from = doubtful_from.or(is_inexact.then_some(distance));
        let hit = ShapeHit { distance, point, from_inside: passage.from_inside, shadow_ray_offset: Vector::zero() };
        Intersection { hit: Some(hit), doubtful_from }
    }

    /// The distance from the surface, negative inside.
    #[must_use]
    pub fn signed_distance(&self, point: Vector) -> f64 {
        let place = self.placement.place_of(point);
        let outside = |place: f64, half: f64| place.abs() - half;
        let out = [outside(place.x, self.half.x), outside(place.y, self.half.y), outside(place.z, self.half.z)];
        let largest = out.into_iter().fold(f64::NEG_INFINITY, f64::max);
        if largest < 0.0 { largest } else { Vector::from(out.map(|out| out.max(0.0))).length() }
    }

    /// The surface point nearest to a point.
    #[must_use]
    pub fn nearest(&self, point: Vector) -> NearestPoint {
        let half = self.half.to_array();
        let place = self.placement.place_of(point).to_array();
        let depth = |axis: usize| half[axis] - place[axis].abs();
        let face = (0..3).min_by(|first, second| depth(*first).total_cmp(&depth(*second))).unwrap_or(0);
        let mut nearest = [0, 1, 2].map(|axis| place[axis].clamp(-half[axis], half[axis]));
        let side = 1.0_f64.copysign(place[face]);
        nearest[face] = half[face] * side;
        let offset = self.placement.to_scene(Vector::from(nearest));
        NearestPoint::new(self.placement.origin, offset, self.placement.axis(face) * side)
    }

    /// Its bounding box, with sides along the scene's axes.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        Bounds::around(self.placement.origin, self.placement.half_sides(self.half))
    }

    /// Half its diagonal, in metres.
    #[must_use]
    pub fn size(&self) -> f64 {
        self.half.length()
    }

    /// The distance of a point, in units of half the shortest side.
    #[must_use]
    pub fn relative_distance(&self, point: Vector) -> f64 {
        let Vector { x, y, z } = self.half;
        (point - self.placement.origin).length() / x.min(y).min(z)
    }

    /// The values that describe it.
    #[must_use]
    pub fn measures(&self) -> Vec<(&'static str, Measure)> {
        let mut measures =
            vec![("center", Measure::Vector(self.placement.origin)), ("size", Measure::Vector(self.half * 2.0))];
        measures.extend(self.placement.turn_measures());
        measures
    }
}
