//! Where a shape is and how it is rotated.

use super::Measure;
use crate::double_double::DoubleDouble;
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vector::Vector;

/// A shape's own axes, in which its formulas are written.
///
/// The axes have 32 digits, and double precision uses them rounded, so a trace with 32 digits sees exactly the same shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// The origin of the shape's axes, in metres.
    pub origin: Vector,
    axes: [Vector<DoubleDouble>; 3],
}

/// A rotation, as a quaternion w + xi + yj + zk. Its length does not matter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    w: f64,
    xyz: Vector,
}

/// A ray in a shape's axes, relative to its point that is nearest to their origin: however far away the ray starts, the
/// numbers are then no larger than the shape.
#[derive(Clone, Copy, Debug)]
pub struct LocalRay<T> {
    /// From the start of the ray to that point, in metres; negative if the ray starts beyond it.
    pub along: T,
    /// The point.
    pub nearest: Vector<T>,
    /// The direction, a unit vector.
    pub direction: Vector<T>,
    /// The distance of the ray's start from the origin, in metres: its rounding error is proportional to this.
    pub reach: f64,
}

impl Rotation {
    /// No rotation.
    pub const NONE: Self = Self { w: 1.0, xyz: Vector::new(0.0, 0.0, 0.0) };

    /// A rotation about an axis (of any nonzero length): counter-clockwise when looking against the axis.
    #[must_use]
    pub fn about(axis: Vector, degrees: f64) -> Self {
        // Whole turns are removed first: they change nothing, and would cost digits.
        let half = (degrees % 720.0).to_radians() * 0.5;
        Self { w: libm::cos(half), xyz: axis.normalized() * libm::sin(half) }
    }

    /// The rotated axes, with 32 digits.
    fn axes(self) -> [Vector<DoubleDouble>; 3] {
        let [w, x, y, z] = [self.w, self.xyz.x, self.xyz.y, self.xyz.z].map(DoubleDouble::from_f64);
        let (one, two) = (DoubleDouble::from_f64(1.0), DoubleDouble::from_f64(2.0));
        let scale = two / (w * w + x * x + y * y + z * z);
        [
            Vector::new(one - scale * (y * y + z * z), scale * (x * y + w * z), scale * (x * z - w * y)),
            Vector::new(scale * (x * y - w * z), one - scale * (x * x + z * z), scale * (y * z + w * x)),
            Vector::new(scale * (x * z + w * y), scale * (y * z - w * x), one - scale * (x * x + y * y)),
        ]
    }

    /// The rotated axes: the columns of its matrix.
    #[must_use]
    pub fn matrix(self) -> [Vector; 3] {
        self.axes().map(|axis| axis.map(DoubleDouble::rounded))
    }
}

impl Placement {
    /// Axes rotated from those of the scene.
    #[must_use]
    pub fn turned(origin: Vector, rotation: Rotation) -> Self {
        Self { origin, axes: rotation.axes() }
    }

    /// Axes whose third points in a direction (of any nonzero length); where the others point does not matter.
    #[must_use]
    pub fn along(origin: Vector, third: Vector<DoubleDouble>) -> Self {
        let third = third.normalized();
        let components = third.map(|component| component.rounded().abs());
        // The scene axis that is farthest from parallel.
        let across = if components.x <= components.y && components.x <= components.z {
            Vector::new(1.0, 0.0, 0.0)
        } else if components.y <= components.z {
            Vector::new(0.0, 1.0, 0.0)
        } else {
            Vector::new(0.0, 0.0, 1.0)
        };
        let first = Vector::from_f64(across).cross(third).normalized();
        Self { origin, axes: [first, third.cross(first), third] }
    }

    /// Axes whose third points in a direction, and whose second points as far as possible in another one, not parallel to
    /// it.
    #[must_use]
    pub fn facing(origin: Vector, third: Vector, second: Vector) -> Self {
        let third = Vector::from_f64(third).normalized();
        let first = Vector::from_f64(second).cross(third).normalized();
        Self { origin, axes: [first, third.cross(first), third] }
    }

    /// The axes, unit vectors.
    #[inline(always)]
    #[must_use]
    pub fn axes<T: Scalar>(&self) -> [Vector<T>; 3] {
        [self.axis(0), self.axis(1), self.axis(2)]
    }

    /// One of the axes, a unit vector.
    #[inline(always)]
    pub fn axis<T: Scalar>(&self, index: usize) -> Vector<T> {
        self.axes[index].map(T::from_precise)
    }

    /// Converts a vector from the scene's axes to the shape's.
    #[inline(always)]
    pub fn to_local<T: Scalar>(&self, vector: Vector<T>) -> Vector<T> {
        let [x, y, z] = self.axes();
        Vector::new(x.dot(vector), y.dot(vector), z.dot(vector))
    }

    /// Converts a vector from the shape's axes to the scene's.
    #[inline(always)]
    pub fn to_scene<T: Scalar>(&self, vector: Vector<T>) -> Vector<T> {
        let [x, y, z] = self.axes();
        x * vector.x + y * vector.y + z * vector.z
    }

    /// Converts a ray to the shape's axes.
    #[inline(always)]
    pub fn local_ray<T: Scalar>(&self, ray: &Ray<T>) -> LocalRay<T> {
        let start = ray.start_from(self.origin);
        let along = -start.dot(ray.direction);
        let nearest = ray.direction.mul_add(along, start);
        let reach = along.rounded().abs() + nearest.length().rounded();
        LocalRay { along, nearest: self.to_local(nearest), direction: self.to_local(ray.direction), reach }
    }

    /// Converts a point of the scene to the shape's axes.
    #[must_use]
    pub fn place_of(&self, point: Vector) -> Vector {
        self.to_local(point - self.origin)
    }

    /// The rotation in readable form: the directions of the shape's own x and y; empty if they are the scene's.
    #[must_use]
    pub fn turn_measures(&self) -> Vec<(&'static str, Measure)> {
        let [x, y, _] = self.axes::<f64>();
        let is_turned = x != Vector::new(1.0, 0.0, 0.0) || y != Vector::new(0.0, 1.0, 0.0);
        if is_turned { vec![("x axis", Measure::Vector(x)), ("y axis", Measure::Vector(y))] } else { Vec::new() }
    }

    /// Half the sides of the bounding box of a body that extends this far along each of its own axes.
    #[must_use]
    pub fn half_sides(&self, half: Vector) -> Vector {
        let [x, y, z] = self.axes::<f64>().map(|axis| axis.map(f64::abs));
        x * half.x + y * half.y + z * half.z
    }
}

impl<T: Scalar> LocalRay<T> {
    /// Whether it stays farther from the origin than this.
    #[inline(always)]
    pub fn passes_by(&self, distance: f64) -> bool {
        self.nearest.dot(self.nearest).rounded() > distance * distance
    }

    /// The point at this distance from the nearest one.
    #[inline(always)]
    pub fn at(&self, distance: T) -> Vector<T> {
        self.direction.mul_add(distance, self.nearest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(first: Vector, second: Vector) -> bool {
        (first - second).length() < 1e-15
    }

    #[test]
    fn a_quarter_turn_about_z_leads_x_to_y() {
        let turn = Rotation::about(Vector::new(0.0, 0.0, 3.0), 90.0);
        let [x, _, z] = turn.matrix();
        assert!(close(x, Vector::new(0.0, 1.0, 0.0)) && close(z, Vector::new(0.0, 0.0, 1.0)));
        let [x, y, z] = Rotation::about(Vector::new(1.0, 1.0, 1.0), 120.0).matrix();
        let turned = x * 1.0 + y * 2.0 + z * 3.0;
        assert!(close(turned, Vector::new(3.0, 1.0, 2.0)), "{turned:?}");
    }

    #[test]
    fn axes_are_orthonormal_in_both_number_types() {
        let axis = Vector::new(0.3, -2.0, 0.7);
        let places = [
            Placement::turned(axis, Rotation::about(axis, 77.7)),
            Placement::along(axis, Vector::from_f64(axis)),
            Placement::facing(axis, axis, Vector::new(0.0, 1.0, 0.1)),
        ];
        for place in places {
            let precise = place.axes::<DoubleDouble>();
            let double = place.axes::<f64>();
            for first in 0..3 {
                for second in 0..3 {
                    let expected = if first == second { 1.0 } else { 0.0 };
                    let product = precise[first].dot(precise[second]) - DoubleDouble::from_f64(expected);
                    assert!(product.rounded().abs() < 1e-30, "{product:?}");
                    assert!((double[first].dot(double[second]) - expected).abs() < 1e-15);
                }
            }
            let handed = double[0].cross(double[1]).dot(double[2]);
            assert!((handed - 1.0).abs() < 1e-15, "right-handed");
        }
    }
}
