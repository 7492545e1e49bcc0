//! Vectors in space.

use std::ops::{Add, Mul, Neg, Sub};

use crate::real::Real;

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

    /// A vector of doubles, exactly.
    #[must_use]
    #[inline(always)]
    pub fn from_f64(vector: Vector) -> Self {
        Self::new(T::from_f64(vector.x), T::from_f64(vector.y), T::from_f64(vector.z))
    }

    /// Scalar product.
    #[must_use]
    #[inline(always)]
    pub fn dot(self, other: Self) -> T {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Vector product.
    #[must_use]
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
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
        self * (T::from_f64(1.0) / self.length())
    }
}

impl Vector {
    /// The components in order.
    #[must_use]
    pub const fn to_array(self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }
}

impl From<[f64; 3]> for Vector {
    fn from([x, y, z]: [f64; 3]) -> Self {
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
