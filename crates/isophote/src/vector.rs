//! Vectors in space.

use std::ops::{Add, Mul, Neg, Sub};

use crate::real::Real;
use crate::scalar::Scalar;

/// A vector or a point: x, y, z.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Vector<T = f64> {
    /// First component.
    pub x: T,
    /// Second component.
    pub y: T,
    /// Third component.
    pub z: T,
}

impl<T: Real> Vector<T> {
    /// The vector with these components.
    #[inline(always)]
    pub const fn new(x: T, y: T, z: T) -> Self {
        Self { x, y, z }
    }

    /// Scalar product.
    #[must_use]
    #[inline(always)]
    pub fn dot(self, other: Self) -> T {
        self.z.mul_add(other.z, self.y.mul_add(other.y, self.x * other.x))
    }

    /// Vector product.
    #[must_use]
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self::new(
            self.y.mul_add(other.z, -(self.z * other.y)),
            self.z.mul_add(other.x, -(self.x * other.z)),
            self.x.mul_add(other.y, -(self.y * other.x)),
        )
    }

    /// Length.
    #[must_use]
    #[inline(always)]
    pub fn length(self) -> T {
        self.dot(self).sqrt()
    }

    /// The unit vector of the same direction. The length must not be zero.
    #[must_use]
    #[inline(always)]
    pub fn normalized(self) -> Self {
        self * (self.x.splat_like(1.0) / self.length())
    }

    /// self · factor + addend.
    #[must_use]
    #[inline(always)]
    pub fn mul_add(self, factor: T, addend: Self) -> Self {
        Self::new(self.x.mul_add(factor, addend.x), self.y.mul_add(factor, addend.y), self.z.mul_add(factor, addend.z))
    }
}

impl<T: Copy> Vector<T> {
    /// The same vector in another number type.
    #[must_use]
    #[inline(always)]
    pub fn map<U>(self, convert: impl Fn(T) -> U) -> Vector<U> {
        Vector { x: convert(self.x), y: convert(self.y), z: convert(self.z) }
    }
}

impl<T: Scalar> Vector<T> {
    /// A vector of doubles, exactly.
    #[must_use]
    #[inline(always)]
    pub fn from_f64(vector: Vector) -> Self {
        vector.map(T::from_f64)
    }

    /// The zero vector.
    #[must_use]
    #[inline(always)]
    pub fn zero() -> Self {
        Self::new(T::zero(), T::zero(), T::zero())
    }
}

impl<T: Copy> Vector<T> {
    /// The components in order.
    #[must_use]
    #[inline(always)]
    pub const fn to_array(self) -> [T; 3] {
        [self.x, self.y, self.z]
    }
}

impl Vector {
    /// Two unit vectors perpendicular to this unit vector and to each other. (Duff et al., "Building an orthonormal basis,
    /// revisited", Journal of Computer Graphics Techniques 6(1), 2017.)
    #[must_use]
    pub fn perpendiculars(self) -> [Self; 2] {
        // A zero has a sign too, which must not matter.
        let sign = 1.0_f64.copysign(self.z + 0.0);
        let a = -1.0 / (sign + self.z);
        let b = self.x * self.y * a;
        [
            Self::new(1.0 + sign * self.x * self.x * a, sign * b, -sign * self.x),
            Self::new(b, sign + self.y * self.y * a, -self.y),
        ]
    }
}

impl<T> From<[T; 3]> for Vector<T> {
    #[inline(always)]
    fn from([x, y, z]: [T; 3]) -> Self {
        Self { x, y, z }
    }
}

impl<T: Real> Add for Vector<T> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<T: Real> Sub for Vector<T> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<T: Real> Neg for Vector<T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl<T: Real> Mul<T> for Vector<T> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: T) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_basis_is_orthonormal(direction in prop::array::uniform3(-1.0..1.0_f64)) {
            prop_assume!(Vector::from(direction).length() > 1e-3);
            let normal = Vector::from(direction).normalized();
            let [first, second] = normal.perpendiculars();
            for (product, expected) in [
                (first.dot(first), 1.0),
                (second.dot(second), 1.0),
                (first.dot(second), 0.0),
                (first.dot(normal), 0.0),
                (second.dot(normal), 0.0),
            ] {
                prop_assert!((product - expected).abs() < 1e-15, "{product}");
            }
        }
    }
}
