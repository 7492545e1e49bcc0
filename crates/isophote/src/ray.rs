//! Rays.

use crate::scalar::Scalar;
use crate::vector::Vector;

/// A ray from the eye, or from a surface to a light. It starts at `anchor + offset`; the two are stored separately because,
/// far from the origin, the sum would lose digits that the offset still has.
#[derive(Clone, Copy, Debug)]
pub struct Ray<T = f64> {
    /// A place near the start, in metres.
    pub anchor: Vector<T>,
    /// From the anchor to the start, in metres.
    pub offset: Vector<T>,
    /// D, a unit vector.
    pub direction: Vector<T>,
}

impl<T: Scalar> Ray<T> {
    /// The start of the ray, relative to a place.
    #[inline(always)]
    pub fn start_from(&self, place: Vector) -> Vector<T> {
        (self.anchor - Vector::from_f64(place)) + self.offset
    }
}
