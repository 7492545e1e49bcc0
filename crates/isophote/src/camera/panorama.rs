//! Longitude and latitude (2.10): x is the longitude in degrees, from the direction of view towards the right; y is the
//! latitude in degrees, upwards from the plane of the forward and right directions.

use super::Extent;
use crate::double_double::DoubleDouble;
use crate::scalar::Scalar;
use crate::vector::Vector;

/// The unit vector (right, up, forward) seen at a screen point; `None` beyond the poles.
pub(super) fn direction<T: Scalar>(longitude: DoubleDouble, latitude: DoubleDouble) -> Option<Vector<T>> {
    if latitude.rounded().abs() > 90.0 {
        return None;
    }
    let radians = |degrees: DoubleDouble| degrees * DoubleDouble::PI / DoubleDouble::from_f64(180.0);
    let (sine, cosine) = T::sine_and_cosine_of(radians(longitude));
    let (height, ring) = T::sine_and_cosine_of(radians(latitude));
    Some(Vector::new(ring * sine, height, ring * cosine))
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
