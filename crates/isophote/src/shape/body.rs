//! Shapes without parts in one form: as what is inside surfaces that are described in the shape's own axes.

use super::{Geometry, Placement};
use crate::vector::Vector;

/// A shape, or a part of one, in its own axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Body {
    /// The origin of its axes, in metres.
    pub origin: Vector,
    /// Its axes: coordinates are the products with them. Their lengths are one over the unit of the coordinates, in metres.
    pub axes: [Vector; 3],
    /// Its form.
    pub form: Form,
    /// The size of its coordinates.
    pub size: f64,
}

/// What a body is in its own axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Form {
    /// x² + y² + z² ≤ 1.
    Ball,
    /// |x| ≤ a, |y| ≤ b, |z| ≤ c.
    Box(Vector),
    /// x² + y² ≤ (R + kz)², 0 ≤ z ≤ h.
    Cone {
        /// R.
        radius: f64,
        /// k.
        slope: f64,
        /// h.
        height: f64,
    },
    /// z = 0.
    Plane,
    /// |x| ≤ a, |y| ≤ b, z = 0.
    Rectangle([f64; 2]),
    /// x² + y² ≤ R², z = 0.
    Disk(f64),
}

impl Body {
    pub(super) fn placed(placement: &Placement, form: Form, size: f64) -> Self {
        Self { origin: placement.origin, axes: placement.axes(), form, size }
    }

    /// A ball or an ellipsoid, from its axes of unit length and its radii, in metres.
    pub(super) fn ball(origin: Vector, axes: [Vector; 3], radii: [f64; 3]) -> Self {
        let [x, y, z] = axes;
        let axes = [x * (1.0 / radii[0]), y * (1.0 / radii[1]), z * (1.0 / radii[2])];
        Self { origin, axes, form: Form::Ball, size: 1.0 }
    }
}

impl Geometry {
    /// A part in its own axes; `None` for a triangle.
    pub(crate) fn body(&self, part: u32) -> Option<Body> {
        match self {
            Self::Sphere(sphere) => Some(sphere.body()),
            Self::Spheres(cloud) => Some(cloud.spheres[part as usize].body()),
            Self::Ellipsoid(ellipsoid) => Some(ellipsoid.body()),
            Self::Plane(plane) => Some(plane.body()),
            Self::Rectangle(rectangle) => Some(rectangle.body()),
            Self::Disk(disk) => Some(disk.body()),
            Self::Cuboid(cuboid) => Some(cuboid.body()),
            Self::Cylinder(cylinder) => Some(cylinder.body()),
            Self::Cone(cone) => Some(cone.body()),
            Self::Mesh(_) => None,
        }
    }
}
