//! Shapes: what a ray can hit.

mod locate;
mod outline;
mod sphere;

pub use locate::{Located, Miss, surface_at};
pub use outline::{Ellipse, Outline, PlaceInRow, PointInRow, RowOfEllipse};
pub use sphere::Sphere;

use crate::camera::CameraFrame;
use crate::double_double::DoubleDouble;
use crate::real::Scalar;
use crate::vector::Vector;

/// The form of a shape and its place in space. A closed set: each variant has a file of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Geometry {
    /// See [`Sphere`].
    Sphere(Sphere),
}

/// A ray from the eye.
#[derive(Clone, Copy, Debug)]
pub struct Ray<T = f64> {
    /// O, in metres.
    pub origin: Vector<T>,
    /// D, a unit vector.
    pub direction: Vector<T>,
}

/// How a ray passes a shape.
#[derive(Clone, Copy, Debug)]
pub struct Approach<T = f64> {
    /// How far the ray is from grazing the shape: cos²θ_o of a hit, which is positive; negative for a miss. A ray that
    /// touches at a single point sees no area: a miss.
    pub clearance: T,
    pub(crate) along: T,
    pub(crate) perpendicular: Vector<T>,
}

/// Where a ray meets a shape.
#[derive(Clone, Copy, Debug)]
pub struct Intersection<T = f64> {
    /// t, the distance from the eye in metres.
    pub distance: T,
    /// The point that was hit.
    pub point: SurfacePoint<T>,
}

/// A point on a surface, as its shading needs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint<T = f64> {
    /// A place near the point (the centre of a sphere), in metres. The point is kept as `anchor + offset`, because
    /// far from the origin the sum would lose the digits that the offset still has.
    pub anchor: Vector,
    /// From the anchor to the point, in metres.
    pub offset: Vector<T>,
    /// N, the unit normal on the viewer's side.
    pub normal: Vector<T>,
    /// V, the unit vector to the eye.
    pub view: Vector<T>,
    /// cosθ_o = N·V.
    pub cos_theta_o: T,
}

impl<T: Scalar> SurfacePoint<T> {
    /// P, in metres.
    #[must_use]
    pub fn position(&self) -> Vector<T> {
        Vector::from_f64(self.anchor) + self.offset
    }
}

impl Geometry {
    /// How a ray passes. `from_inside` says that it starts inside the shape.
    #[inline(always)]
    pub fn approach<T: Scalar>(&self, ray: &Ray<T>, from_inside: bool) -> Approach<T> {
        match self {
            Self::Sphere(sphere) => sphere.approach(ray, from_inside),
        }
    }

    /// The nearest intersection with a ray (2.2), of which the approach says that there is one.
    #[inline(always)]
    pub fn intersection<T: Scalar>(&self, ray: &Ray<T>, from_inside: bool, approach: &Approach<T>) -> Intersection<T> {
        match self {
            Self::Sphere(sphere) => sphere.intersection(ray, from_inside, approach),
        }
    }

    /// Where the shape appears on the screen.
    #[must_use]
    pub fn outline(&self, frame: &CameraFrame<DoubleDouble>) -> Outline {
        match self {
            Self::Sphere(sphere) => Ellipse::of_sphere(sphere, frame),
        }
    }

    /// Signed distance of a point from the surface in metres, negative inside.
    #[must_use]
    pub fn signed_distance(&self, point: Vector) -> f64 {
        match self {
            Self::Sphere(sphere) => sphere.signed_distance(point),
        }
    }

    /// The surface point nearest to a point.
    #[must_use]
    pub fn nearest(&self, point: Vector) -> NearestPoint {
        match self {
            Self::Sphere(sphere) => sphere.nearest(point),
        }
    }

    /// The surface point that lies in a direction (a unit vector) from the shape's centre.
    #[must_use]
    pub fn in_direction(&self, direction: Vector) -> NearestPoint {
        match self {
            Self::Sphere(sphere) => sphere.in_direction(direction),
        }
    }

    /// Its middle, in metres: C of a sphere.
    #[must_use]
    pub fn center(&self) -> Vector {
        match self {
            Self::Sphere(sphere) => sphere.center,
        }
    }

    /// Its size in metres: R of a sphere.
    #[must_use]
    pub fn size(&self) -> f64 {
        match self {
            Self::Sphere(sphere) => sphere.radius,
        }
    }

    /// How far away a point is from the shape, in sizes of the shape.
    #[must_use]
    pub fn remoteness(&self, point: Vector) -> f64 {
        match self {
            Self::Sphere(sphere) => (sphere.center - point).length() / sphere.radius,
        }
    }

    /// How near a place must be to the surface to count as on it: a billionth of the shape's size, in metres. Ten
    /// typed digits are enough for that.
    #[must_use]
    pub fn surface_tolerance(&self) -> f64 {
        match self {
            Self::Sphere(sphere) => 1e-9 * sphere.radius,
        }
    }
}

/// The point of a surface that is nearest to some place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestPoint {
    /// See [`SurfacePoint::anchor`].
    pub anchor: Vector,
    /// See [`SurfacePoint::offset`].
    pub offset: Vector,
    /// The unit normal that points out of the shape.
    pub outward_normal: Vector,
}
