//! Common code of flat shapes: the plane z = 0 of their own axes (2.4).

use super::placement::Placement;
use super::{Accuracy, Intersection, NearestPoint, PLACE_ERROR, ShapeHit, SurfacePoint};
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vector::Vector;

/// Intersects a ray with a flat shape.
///
/// `size` is its extent in metres, `None` if it is unbounded. `beyond` returns how far a point (x, y) is outside the border,
/// in metres, negative inside.
#[inline]
pub fn intersect<T: Scalar>(
    placement: &Placement,
    size: Option<f64>,
    ray: &Ray<T>,
    accuracy: Accuracy,
    beyond: impl Fn(T, T) -> T,
) -> Intersection<T> {
    let local = placement.local_ray(ray);
    let error = PLACE_ERROR * (local.reach + size.unwrap_or(0.0));
    if size.is_some_and(|size| local.passes_by(size + error)) {
        return Intersection::MISS;
    }
    let slope = local.direction.z;
    // Seen edge-on it has no area; so small a slope is only rounding error, which more digits can resolve.
    if (slope * slope).rounded() < 1e4 * T::NEGLIGIBLE_SQUARE {
        return Intersection { hit: None, doubtful_from: Some(T::zero()) };
    }
    let at = -(local.nearest.z / slope);
    let distance = local.along + at;
    let error = (error + f64::EPSILON * at.rounded().abs()) / slope.rounded().abs();
    let (x, y) = (local.direction.x.mul_add(at, local.nearest.x), local.direction.y.mul_add(at, local.nearest.y));
    let beyond = beyond(x, y);
    if beyond.rounded() > error || distance.rounded() < -error {
        return Intersection::MISS;
    }
    let is_uncertain = beyond.rounded() > -error || distance.rounded() < error;
    let size = size.unwrap_or(distance.rounded());
    let is_doubtful = is_uncertain || accuracy.is_exceeded_by(error / size, 0.0);
    let doubtful_from = is_doubtful.then(|| (distance - T::from_f64(error)).max(T::zero()));
    if T::zero().is_less(beyond) || !T::zero().is_less(distance) {
        return Intersection { hit: None, doubtful_from };
    }
    let towards_eye = T::from_f64(if T::zero().is_less(slope) { -1.0 } else { 1.0 });
    let [first, second, third] = placement.axes();
    let point = SurfacePoint {
        anchor: placement.origin,
        // Built in the plane: its component along N is zero.
        offset: first * x + second * y,
        normal: third * towards_eye,
        view: -ray.direction,
        cos_theta_o: -(slope * towards_eye),
    };
    let hit = ShapeHit { distance, point, from_inside: false, shadow_ray_offset: Vector::zero() };
    Intersection { hit: Some(hit), doubtful_from }
}

/// The point of a flat shape nearest to a given point, with N on that point's side. `nearest_place` finds it in the shape's
/// own axes.
pub fn nearest(placement: &Placement, point: Vector, nearest_place: impl Fn(Vector) -> Vector) -> NearestPoint {
    let place = placement.place_of(point);
    let offset = placement.to_scene(nearest_place(place));
    let side = 1.0_f64.copysign(place.z);
    NearestPoint::new(placement.origin, offset, placement.axis(2) * side)
}
