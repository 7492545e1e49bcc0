//! Longitude and latitude (2.10): x is the longitude in degrees, from the direction of view towards the right; y is the
//! latitude in degrees, upwards from the plane of the forward and right directions.

use super::Extent;
use crate::double_double::{DoubleDouble, ExactProduct};
use crate::real::Real;
use crate::scalar::Scalar;
use crate::vector::Vector;

/// The unit vector (right, up, forward) seen at a screen point; `None` beyond the poles.
pub(super) fn direction<T: Scalar>(longitude: DoubleDouble, latitude: DoubleDouble) -> Option<Vector<T>> {
    if latitude.rounded().abs() > 90.0 {
        return None;
    }
    let (sine, cosine) = T::sine_and_cosine_of(radians(longitude));
    let (height, ring) = T::sine_and_cosine_of(radians(latitude));
    Some(Vector::new(ring * sine, height, ring * cosine))
}

/// The unit vectors seen at screen points, and how far up or down they are, in parts of the way to a pole.
#[inline(always)]
pub(super) fn direction_in_lanes<T: ExactProduct>(
    longitude: DoubleDouble<T>,
    latitude: DoubleDouble<T>,
) -> (Vector<DoubleDouble<T>>, T) {
    let (sine, cosine) = radians(longitude).sine_and_cosine();
    let (height, ring) = radians(latitude).sine_and_cosine();
    let above = latitude.nearest();
    let eccentricity = above.max(-above) / above.splat_like(90.0);
    (Vector::new(ring * sine, height, ring * cosine), eccentricity)
}

/// An angle in degrees.
#[inline(always)]
pub(super) fn radians<T: ExactProduct>(degrees: DoubleDouble<T>) -> DoubleDouble<T> {
    let like = degrees.nearest();
    degrees * DoubleDouble::PI.constant_like(like) / degrees.splat_like(180.0)
}

/// Where a direction (right, up, forward) appears: at the longitude that is at or east of the image's left edge, by less
/// than a full turn.
pub(super) fn project(extent: &Extent, direction: Vector) -> [f64; 2] {
    let longitude = libm::atan2(direction.x, direction.z).to_degrees();
    let latitude = libm::atan2(direction.y, libm::hypot(direction.x, direction.z)).to_degrees();
    let [west, _] = extent.x;
    let turns = libm::ceil((west - longitude) / 360.0);
    [longitude + 360.0 * turns, latitude]
}
