//! Shapes: what a ray can hit.

mod locate;
mod outline;
mod ray;
mod sphere;
mod spheres;

use std::sync::Arc;

pub use locate::{Located, Miss, surface_at};
pub(crate) use outline::{BEFORE_THE_EYE, Grid};
pub use outline::{Ellipse, Outline, PlaceInRow, PointInRow, RowOfEllipse};
pub use ray::{Accuracy, Intersection, Meeting, Ray, SurfacePoint, TracingError};
pub use sphere::Sphere;
pub use spheres::Spheres;

use crate::camera::CameraFrame;
use crate::double_double::DoubleDouble;
use crate::real::Scalar;
use crate::vector::Vector;

/// The form of a shape and its place in space. A closed set: each variant has a file of its own.
///
/// A shape has parts, which rays hit one by one: the spheres of a cloud. Every other shape is one part, number 0.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// See [`Sphere`].
    Sphere(Sphere),
    /// See [`Spheres`].
    Spheres(Arc<Spheres>),
}

/// A part of a shape: what a ray hits, and what casts a shadow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Primitive {
    /// Index of the shape.
    pub shape: usize,
    /// Which part of it; 0 where it has only one.
    pub part: u32,
}

/// A box with sides along the axes, in metres.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Bounds {
    /// The corner with the least coordinates.
    pub least: Vector,
    /// The corner with the greatest.
    pub greatest: Vector,
}

impl Geometry {
    /// What it is, in one word.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Sphere(_) => "sphere",
            Self::Spheres(_) => "spheres",
        }
    }

    /// What describes it, with names, in metres.
    #[must_use]
    pub fn measures(&self) -> Vec<(&'static str, Measure)> {
        match self {
            Self::Sphere(sphere) => {
                vec![("center", Measure::Vector(sphere.center)), ("radius", Measure::Number(sphere.radius))]
            }
            Self::Spheres(cloud) => vec![("count", Measure::Count(cloud.spheres.len()))],
        }
    }

    /// Whether every part is a sphere: a point's anchor is then its centre.
    #[must_use]
    pub fn is_round(&self) -> bool {
        matches!(self, Self::Sphere(_) | Self::Spheres(_))
    }

    /// How many parts there are.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the reader of the file counted in 32 bits")]
    pub fn parts(&self) -> u32 {
        match self {
            Self::Sphere(_) => 1,
            Self::Spheres(cloud) => cloud.spheres.len() as u32,
        }
    }

    /// How a ray meets a part: the nearest intersection in front of its start (2.2).
    #[inline(always)]
    pub fn meet<T: Scalar>(&self, part: u32, ray: &Ray<T>, accuracy: Accuracy) -> Meeting<T> {
        match self {
            Self::Sphere(sphere) => sphere.meet(ray, accuracy),
            Self::Spheres(cloud) => cloud.spheres[part as usize].meet(ray, accuracy),
        }
    }

    /// The box around a part; nothing for what has no end.
    #[must_use]
    pub fn bounds(&self, part: u32) -> Option<Bounds> {
        match self {
            Self::Sphere(sphere) => Some(sphere.bounds()),
            Self::Spheres(cloud) => Some(cloud.spheres[part as usize].bounds()),
        }
    }

    /// Whether a point is inside a part that is closed and convex.
    #[must_use]
    pub fn part_encloses(&self, part: u32, point: Vector) -> bool {
        match self {
            Self::Sphere(sphere) => sphere.signed_distance(point) < 0.0,
            Self::Spheres(cloud) => cloud.spheres[part as usize].signed_distance(point) < 0.0,
        }
    }

    /// In metres: what is nearer to a point of a part is no blocker of its light if it is another part of the shape.
    /// Neighbours touch along an edge, where rounding alone would tell whether they stand in each other's light.
    #[must_use]
    pub fn least_shadow_distance(&self, _part: u32) -> f64 {
        match self {
            Self::Sphere(_) | Self::Spheres(_) => 0.0,
        }
    }

    /// The material of a part, where parts have their own.
    #[must_use]
    pub fn material_of(&self, part: u32) -> Option<usize> {
        match self {
            Self::Spheres(cloud) => cloud.materials.get(part as usize).map(|material| *material as usize),
            Self::Sphere(_) => None,
        }
    }

    /// Where the shape appears on the screen.
    #[must_use]
    pub fn outline(&self, frame: &CameraFrame<DoubleDouble>) -> Outline {
        match self {
            Self::Sphere(sphere) if sphere.signed_distance(frame.eye.map(DoubleDouble::rounded)) > 0.0 => {
                Ellipse::of_sphere(sphere, frame)
            }
            Self::Sphere(_) | Self::Spheres(_) => Outline::Unknown,
        }
    }

    /// Signed distance of a point from the surface in metres, negative inside; surfaces that enclose nothing have no
    /// inside.
    #[must_use]
    pub fn signed_distance(&self, point: Vector) -> f64 {
        match self {
            Self::Sphere(sphere) => sphere.signed_distance(point),
            Self::Spheres(cloud) => cloud.signed_distance(point),
        }
    }

    /// The surface point nearest to a point.
    #[must_use]
    pub fn nearest(&self, point: Vector) -> NearestPoint {
        match self {
            Self::Sphere(sphere) => sphere.nearest(point),
            Self::Spheres(cloud) => cloud.nearest(point),
        }
    }

    /// The surface point that lies in a direction (a unit vector) from the centre of a sphere; other shapes have none.
    #[must_use]
    pub fn in_direction(&self, direction: Vector) -> Option<NearestPoint> {
        match self {
            Self::Sphere(sphere) => Some(sphere.in_direction(direction)),
            Self::Spheres(_) => None,
        }
    }

    /// Its size in metres: R of a sphere; of a cloud, of the sphere whose surface is nearest to a point.
    #[must_use]
    pub fn size_near(&self, point: Vector) -> f64 {
        match self {
            Self::Sphere(sphere) => sphere.radius,
            Self::Spheres(cloud) => cloud.spheres[cloud.nearest_part(point) as usize].radius,
        }
    }

    /// How far away a point is from the shape, in sizes of the shape.
    #[must_use]
    pub fn remoteness(&self, point: Vector) -> f64 {
        match self {
            Self::Sphere(sphere) => (sphere.center - point).length() / sphere.radius,
            Self::Spheres(cloud) => {
                let remoteness = |sphere: &Sphere| (sphere.center - point).length() / sphere.radius;
                cloud.spheres.iter().map(remoteness).fold(0.0, f64::max)
            }
        }
    }

    /// How near a place must be to the surface to count as on it: a billionth of the shape's size, in metres. Ten
    /// typed digits are enough for that.
    #[must_use]
    pub fn surface_tolerance(&self, point: Vector) -> f64 {
        1e-9 * self.size_near(point)
    }
}

/// A value that describes a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measure {
    /// A point or a direction.
    Vector(Vector),
    /// A length, or another number.
    Number(f64),
    /// How many of something.
    Count(usize),
}

impl Bounds {
    /// The box around two boxes.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        let least = |first: f64, second: f64| first.min(second);
        let greatest = |first: f64, second: f64| first.max(second);
        let both = |first: Vector, second: Vector, choose: fn(f64, f64) -> f64| {
            Vector::new(choose(first.x, second.x), choose(first.y, second.y), choose(first.z, second.z))
        };
        Self { least: both(self.least, other.least, least), greatest: both(self.greatest, other.greatest, greatest) }
    }
}

/// The point of a surface that is nearest to some place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestPoint {
    /// Which part of the shape.
    pub part: u32,
    /// See [`SurfacePoint::anchor`].
    pub anchor: Vector,
    /// See [`SurfacePoint::offset`].
    pub offset: Vector,
    /// The unit normal that points out of the shape.
    pub outward_normal: Vector,
    /// See [`Intersection::lift`].
    pub lift: Vector,
}

impl NearestPoint {
    /// A point of a shape that is one part, with the same normal for shading and for shadows.
    #[must_use]
    pub fn new(anchor: Vector, offset: Vector, outward_normal: Vector) -> Self {
        Self { part: 0, anchor, offset, outward_normal, lift: Vector::default() }
    }
}
