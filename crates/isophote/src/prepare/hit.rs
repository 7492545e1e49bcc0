//! What a ray hits.

use crate::double_double::DoubleDouble;
use crate::scalar::Scalar;
use crate::shape::{Primitive, ShapeHit, SurfacePoint};
use crate::vector::Vector;

/// The first thing that a ray from the eye hits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<T = f64> {
    /// The primitive that was hit.
    pub primitive: Primitive,
    /// t, the distance from the eye in metres (2.2).
    pub distance: T,
    /// The surface point.
    pub point: SurfacePoint<T>,
    /// Whether a closed shape is seen from inside.
    pub from_inside: bool,
    /// [`ShapeHit::shadow_ray_offset`](crate::shape::ShapeHit::shadow_ray_offset), shorter where something stands that close.
    pub shadow_ray_offset: Vector<T>,
}

impl<T> Hit<T> {
    /// A hit on a primitive.
    pub(crate) fn of(primitive: Primitive, hit: ShapeHit<T>) -> Self {
        let ShapeHit { distance, point, from_inside, shadow_ray_offset } = hit;
        Self { primitive, distance, point, from_inside, shadow_ray_offset }
    }
}

impl<T: Scalar> Hit<T> {
    /// The same hit in another number type.
    pub(super) fn map<U: Scalar>(self, convert: impl Fn(T) -> U) -> Hit<U> {
        Hit {
            primitive: self.primitive,
            distance: convert(self.distance),
            point: self.point.map(&convert),
            from_inside: self.from_inside,
            shadow_ray_offset: self.shadow_ray_offset.map(&convert),
        }
    }
}

impl Hit {
    /// A point that lies on no shape.
    pub(crate) fn on_no_shape(point: SurfacePoint) -> Self {
        let primitive = Primitive { shape: 0, part: 0 };
        Self { primitive, distance: 0.0, point, from_inside: false, shadow_ray_offset: Vector::zero() }
    }

    pub(super) fn exactly(&self) -> Hit<DoubleDouble> {
        self.map(DoubleDouble::from_f64)
    }
}

impl Hit<DoubleDouble> {
    pub(crate) fn rounded(self) -> Hit {
        self.map(DoubleDouble::rounded)
    }
}
