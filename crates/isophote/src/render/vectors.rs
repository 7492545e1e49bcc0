//! Vectors in lanes, and arrays of vectors by axis.

use crate::lanes::Lane;
use crate::vector::Vector;

/// A vector per point, by axis.
pub type Vectors<E, const N: usize> = [[E; N]; 3];

/// The same vector in every lane.
#[inline(always)]
pub fn splat<V: Lane<Element = f64>>(token: V::Token, vector: Vector) -> Vector<V> {
    Vector::new(V::splat(token, vector.x), V::splat(token, vector.y), V::splat(token, vector.z))
}

/// Reads some vectors.
#[inline(always)]
pub fn load<V: Lane, const N: usize>(token: V::Token, at: usize, [x, y, z]: &Vectors<V::Element, N>) -> Vector<V> {
    Vector { x: V::load(token, &x[at..]), y: V::load(token, &y[at..]), z: V::load(token, &z[at..]) }
}

/// Writes some vectors.
#[inline(always)]
pub fn store<V: Lane, const N: usize>(vector: Vector<V>, at: usize, [x, y, z]: &mut Vectors<V::Element, N>) {
    vector.x.store(&mut x[at..]);
    vector.y.store(&mut y[at..]);
    vector.z.store(&mut z[at..]);
}

/// Reads a vector.
#[inline(always)]
pub fn get<E: Copy, const N: usize>([x, y, z]: &Vectors<E, N>, at: usize) -> Vector<E> {
    Vector { x: x[at], y: y[at], z: z[at] }
}

/// Writes a vector.
#[inline(always)]
pub fn put<E, const N: usize>(vector: Vector<E>, at: usize, [x, y, z]: &mut Vectors<E, N>) {
    (x[at], y[at], z[at]) = (vector.x, vector.y, vector.z);
}

/// The greatest of the numbers in all lanes.
#[inline(always)]
pub fn greatest_of<V: Lane<Element = f64>>(numbers: V) -> f64 {
    let mut all = [0.0; 16];
    numbers.store(&mut all);
    all[..V::COUNT].iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

/// The least of the numbers in all lanes.
#[inline(always)]
pub fn least_of<V: Lane<Element = f64>>(numbers: V) -> f64 {
    -greatest_of(-numbers)
}
