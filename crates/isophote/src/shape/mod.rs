//! Shapes: what a ray can hit.

mod body;
mod box_tree;
mod center_lines;
mod cone;
mod cuboid;
mod cylinder;
mod disk;
mod ellipsoid;
mod flat;
mod intersection;
mod locate;
mod mesh;
mod placement;
mod plane;
mod rectangle;
mod side;
mod span;
mod sphere;
mod spheres;

use std::sync::Arc;

pub(crate) use body::{Body, Form};
pub use box_tree::BoxTree;
pub use center_lines::CenterLine;
pub use cone::Cone;
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use disk::Disk;
pub use ellipsoid::Ellipsoid;
pub use intersection::{Accuracy, Intersection, ShapeHit, SurfacePoint, TracingError};
pub use locate::{Located, Miss, surface_at};
pub use mesh::{CornerNormals, Mesh, MeshData, MeshError, MeshPlacing};
pub use placement::{LocalRay, Placement, Rotation};
pub use plane::Plane;
pub use rectangle::Rectangle;
pub use side::Side;
pub use sphere::Sphere;
pub use spheres::Spheres;

use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vector::Vector;

/// The form of a shape and its place in space. A closed set: each variant has a file of its own.
///
/// A shape has parts, which rays hit one by one: the spheres of a cloud, the triangles of a mesh. Every other shape is a
/// single part, number 0. All kinds except spheres are stored on the heap and shared: a scene may have a hundred thousand
/// shapes.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// See [`Sphere`].
    Sphere(Sphere),
    /// See [`Spheres`].
    Spheres(Arc<Spheres>),
    /// See [`Ellipsoid`].
    Ellipsoid(Arc<Ellipsoid>),
    /// See [`Plane`].
    Plane(Arc<Plane>),
    /// See [`Rectangle`].
    Rectangle(Arc<Rectangle>),
    /// See [`Disk`].
    Disk(Arc<Disk>),
    /// See [`Cuboid`].
    Cuboid(Arc<Cuboid>),
    /// See [`Cylinder`].
    Cylinder(Arc<Cylinder>),
    /// See [`Cone`].
    Cone(Arc<Cone>),
    /// See [`Mesh`].
    Mesh(Arc<Mesh>),
}

/// A part of a shape: what a ray hits, and what casts a shadow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Primitive {
    /// Index of the shape.
    pub shape: usize,
    /// The part; 0 if there is only one.
    pub part: u32,
}

/// A bounding box with sides along the axes, in metres.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Bounds {
    /// The corner with the smallest coordinates.
    pub least: Vector,
    /// The corner with the largest coordinates.
    pub greatest: Vector,
}

impl Geometry {
    /// Its kind, in one word.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Sphere(_) => "sphere",
            Self::Spheres(_) => "spheres",
            Self::Ellipsoid(_) => "ellipsoid",
            Self::Plane(_) => "plane",
            Self::Rectangle(_) => "rectangle",
            Self::Disk(_) => "disk",
            Self::Cuboid(_) => "box",
            Self::Cylinder(_) => "cylinder",
            Self::Cone(_) => "cone",
            Self::Mesh(_) => "mesh",
        }
    }

    /// The values that describe it, with names, in metres.
    #[must_use]
    pub fn measures(&self) -> Vec<(&'static str, Measure)> {
        match self {
            Self::Sphere(sphere) => {
                vec![("center", Measure::Vector(sphere.center)), ("radius", Measure::Number(sphere.radius))]
            }
            Self::Spheres(cloud) => vec![("count", Measure::Count(cloud.spheres.len()))],
            Self::Ellipsoid(ellipsoid) => ellipsoid.measures(),
            Self::Plane(plane) => plane.measures(),
            Self::Rectangle(rectangle) => rectangle.measures(),
            Self::Disk(disk) => disk.measures(),
            Self::Cuboid(cuboid) => cuboid.measures(),
            Self::Cylinder(cylinder) => cylinder.measures(),
            Self::Cone(cone) => cone.measures(),
            Self::Mesh(mesh) => mesh.measures(),
        }
    }

    /// Its centre, in metres: of a plane its own point, of a mesh or a cloud, a cylinder or a cone the middle of its bounding
    /// box.
    #[must_use]
    pub fn center(&self) -> Vector {
        let named = self.measures().into_iter().find_map(|(name, measure)| match measure {
            Measure::Vector(place) if matches!(name, "center" | "point") => Some(place),
            _ => None,
        });
        named.unwrap_or_else(|| {
            let parts = (0..self.parts()).filter_map(|part| self.bounds(part));
            let Bounds { least, greatest } = parts.reduce(Bounds::union).unwrap_or_default();
            (least + greatest) * 0.5
        })
    }

    /// Whether every part is a sphere: a point's anchor is then its centre.
    #[must_use]
    pub fn is_round(&self) -> bool {
        matches!(self, Self::Sphere(_) | Self::Spheres(_))
    }

    /// Whether its parts have materials of their own.
    #[must_use]
    pub fn has_own_materials(&self) -> bool {
        self.material_of(0).is_some()
    }

    /// The materials of its parts, possibly with repetitions.
    pub fn materials_of_parts(&self) -> impl Iterator<Item = usize> {
        (0..self.parts()).filter_map(|part| self.material_of(part))
    }

    /// The number of parts.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the reader of the file counted in 32 bits")]
    pub fn parts(&self) -> u32 {
        match self {
            Self::Spheres(cloud) => cloud.spheres.len() as u32,
            Self::Mesh(mesh) => mesh.parts(),
            _ => 1,
        }
    }

    /// Intersects a ray with a part: the nearest intersection in front of its start (2.2).
    #[inline(always)]
    pub fn intersect<T: Scalar>(&self, part: u32, ray: &Ray<T>, accuracy: Accuracy) -> Intersection<T> {
        match self {
            Self::Sphere(sphere) => sphere.intersect(ray, accuracy),
            Self::Spheres(cloud) => cloud.spheres[part as usize].intersect(ray, accuracy),
            Self::Ellipsoid(ellipsoid) => ellipsoid.intersect(ray, accuracy),
            Self::Plane(plane) => plane.intersect(ray, accuracy),
            Self::Rectangle(rectangle) => rectangle.intersect(ray, accuracy),
            Self::Disk(disk) => disk.intersect(ray, accuracy),
            Self::Cuboid(cuboid) => cuboid.intersect(ray, accuracy),
            Self::Cylinder(cylinder) => cylinder.intersect(ray, accuracy),
            Self::Cone(cone) => cone.intersect(ray, accuracy),
            Self::Mesh(mesh) => mesh.intersect(part, ray, accuracy),
        }
    }

    /// The bounding box of a part; `None` if it is unbounded.
    #[must_use]
    pub fn bounds(&self, part: u32) -> Option<Bounds> {
        match self {
            Self::Sphere(sphere) => Some(sphere.bounds()),
            Self::Spheres(cloud) => Some(cloud.spheres[part as usize].bounds()),
            Self::Ellipsoid(ellipsoid) => Some(ellipsoid.bounds()),
            Self::Plane(_) => None,
            Self::Rectangle(rectangle) => Some(rectangle.bounds()),
            Self::Disk(disk) => Some(disk.bounds()),
            Self::Cuboid(cuboid) => Some(cuboid.bounds()),
            Self::Cylinder(cylinder) => Some(cylinder.bounds()),
            Self::Cone(cone) => Some(cone.bounds()),
            Self::Mesh(mesh) => Some(mesh.part_bounds(part)),
        }
    }

    /// The bounding box of all parts; `None` if it is unbounded.
    #[must_use]
    pub fn bounds_of_all(&self) -> Option<Bounds> {
        (0..self.parts()).map(|part| self.bounds(part)).reduce(|first, second| Some(first?.union(second?))).flatten()
    }

    /// Whether a point is inside a part that is closed and convex.
    #[must_use]
    pub fn part_encloses(&self, part: u32, point: Vector) -> bool {
        match self {
            Self::Spheres(cloud) => cloud.spheres[part as usize].signed_distance(point) < 0.0,
            _ => self.is_closed() && self.signed_distance(point) < 0.0,
        }
    }

    /// Whether its parts have an inside. For a shape without one, the eye sees the side that faces it.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        !matches!(self, Self::Plane(_) | Self::Rectangle(_) | Self::Disk(_) | Self::Mesh(_))
    }

    /// In metres: another part of the same shape blocks a part's light only if it is farther than this from the point.
    /// Neighbours touch along an edge, where otherwise rounding would decide whether they block each other's light.
    #[must_use]
    pub fn least_shadow_distance(&self) -> f64 {
        match self {
            Self::Mesh(mesh) => 1e-12 * mesh.size(),
            _ => 0.0,
        }
    }

    /// The material of a part, if parts have their own.
    #[must_use]
    pub fn material_of(&self, part: u32) -> Option<usize> {
        match self {
            Self::Spheres(cloud) => cloud.materials.get(part as usize).map(|material| *material as usize),
            Self::Mesh(mesh) => mesh.material_of(part),
            _ => None,
        }
    }

    /// Signed distance of a point from the surface in metres, negative inside; surfaces that enclose nothing have no inside.
    #[must_use]
    pub fn signed_distance(&self, point: Vector) -> f64 {
        match self {
            Self::Sphere(sphere) => sphere.signed_distance(point),
            Self::Spheres(cloud) => cloud.signed_distance(point),
            Self::Ellipsoid(ellipsoid) => ellipsoid.signed_distance(point),
            Self::Plane(plane) => plane.distance(point),
            Self::Rectangle(rectangle) => rectangle.distance(point),
            Self::Disk(disk) => disk.distance(point),
            Self::Cuboid(cuboid) => cuboid.signed_distance(point),
            Self::Cylinder(cylinder) => cylinder.signed_distance(point),
            Self::Cone(cone) => cone.signed_distance(point),
            Self::Mesh(mesh) => mesh.distance(point),
        }
    }

    /// The signed distance of a point from a part alone.
    pub(crate) fn part_signed_distance(&self, part: u32, point: Vector) -> f64 {
        match self {
            Self::Mesh(mesh) => mesh.triangle(part).distance(point),
            Self::Spheres(cloud) => cloud.spheres[part as usize].signed_distance(point),
            _ => self.signed_distance(point),
        }
    }

    /// The point of a part that is nearest to a point.
    pub(crate) fn part_nearest(&self, part: u32, point: Vector) -> NearestPoint {
        let nearest = match self {
            Self::Mesh(mesh) => mesh.triangle(part).nearest(point),
            Self::Spheres(cloud) => cloud.spheres[part as usize].nearest(point),
            _ => return self.nearest(point),
        };
        NearestPoint { part, ..nearest }
    }

    /// The surface point nearest to a point.
    #[must_use]
    pub fn nearest(&self, point: Vector) -> NearestPoint {
        match self {
            Self::Sphere(sphere) => sphere.nearest(point),
            Self::Spheres(cloud) => cloud.nearest(point),
            Self::Ellipsoid(ellipsoid) => ellipsoid.nearest(point),
            Self::Plane(plane) => plane.nearest(point),
            Self::Rectangle(rectangle) => rectangle.nearest(point),
            Self::Disk(disk) => disk.nearest(point),
            Self::Cuboid(cuboid) => cuboid.nearest(point),
            Self::Cylinder(cylinder) => cylinder.nearest(point),
            Self::Cone(cone) => cone.nearest(point),
            Self::Mesh(mesh) => mesh.nearest(point),
        }
    }

    /// The surface point in a direction (a unit vector) from the centre of a sphere; `None` for other shapes.
    #[must_use]
    pub fn in_direction(&self, direction: Vector) -> Option<NearestPoint> {
        match self {
            Self::Sphere(sphere) => Some(sphere.in_direction(direction)),
            _ => None,
        }
    }

    /// Its size in metres: R for a sphere, and about half the longest dimension for other shapes; for a cloud, that of the
    /// sphere whose surface is nearest to a point; for a plane, a length that depends on how far away the point is.
    #[must_use]
    pub fn size_near(&self, point: Vector) -> f64 {
        match self {
            Self::Sphere(sphere) => sphere.radius,
            Self::Spheres(cloud) => cloud.spheres[cloud.nearest_part(point) as usize].radius,
            Self::Ellipsoid(ellipsoid) => ellipsoid.size(),
            Self::Plane(plane) => plane.size_near(point),
            Self::Rectangle(rectangle) => rectangle.size(),
            Self::Disk(disk) => disk.size(),
            Self::Cuboid(cuboid) => cuboid.size(),
            Self::Cylinder(cylinder) => cylinder.size(),
            Self::Cone(cone) => cone.size(),
            Self::Mesh(mesh) => mesh.size(),
        }
    }

    /// Whether it is the same form in the same place. For meshes and clouds, which are large: whether both are the same data
    /// in memory, read once.
    #[must_use]
    pub fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Mesh(mesh), Self::Mesh(other)) => Arc::ptr_eq(mesh, other),
            (Self::Spheres(cloud), Self::Spheres(other)) => Arc::ptr_eq(cloud, other),
            _ => self == other,
        }
    }

    /// The distance of a point from the shape, in sizes of the shape.
    #[must_use]
    pub fn relative_distance(&self, point: Vector) -> f64 {
        match self {
            Self::Sphere(sphere) => (sphere.center - point).length() / sphere.radius,
            Self::Spheres(cloud) => {
                let relative_distance = |sphere: &Sphere| (sphere.center - point).length() / sphere.radius;
                cloud.spheres.iter().map(relative_distance).fold(0.0, f64::max)
            }
            Self::Ellipsoid(ellipsoid) => ellipsoid.relative_distance(point),
            Self::Rectangle(rectangle) => rectangle.relative_distance(point),
            Self::Disk(disk) => disk.relative_distance(point),
            Self::Cuboid(cuboid) => cuboid.relative_distance(point),
            Self::Cylinder(cylinder) => cylinder.relative_distance(point),
            Self::Cone(cone) => cone.relative_distance(point),
            Self::Mesh(mesh) => mesh.relative_distance(point),
            // It is unbounded, and so comes near everything.
            Self::Plane(_) => 0.0,
        }
    }

    /// How close a point must be to the surface to count as on it: a billionth of the shape's size, in metres. Ten typed
    /// digits are enough for that.
    #[must_use]
    pub fn surface_tolerance(&self, point: Vector) -> f64 {
        1e-9 * self.size_near(point)
    }

    /// The same for a point whose nearest part is known.
    pub(crate) fn part_tolerance(&self, part: u32, point: Vector) -> f64 {
        match self {
            Self::Spheres(cloud) => 1e-9 * cloud.spheres[part as usize].radius,
            _ => self.surface_tolerance(point),
        }
    }
}

/// A value that describes a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measure {
    /// A point or a direction.
    Vector(Vector),
    /// A length, or another number.
    Number(f64),
    /// A number of items.
    Count(usize),
}

/// The transverse rounding error of a ray, as a fraction of the distance at which it starts plus the size of the shape.
const PLACE_ERROR: f64 = 8.0 * f64::EPSILON;

impl Bounds {
    /// The box with this middle and these half sides.
    #[must_use]
    pub fn around(middle: Vector, half: Vector) -> Self {
        Self { least: middle - half, greatest: middle + half }
    }

    /// The bounding box of a disk with this unit normal.
    #[must_use]
    pub fn of_disk(center: Vector, normal: Vector, radius: f64) -> Self {
        Self::around(center, normal.map(|cosine| (1.0 - cosine * cosine).max(0.0).sqrt()) * radius)
    }

    /// The bounding box of two boxes.
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

/// The point of a surface that is nearest to a given point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestPoint {
    /// The part of the shape.
    pub part: u32,
    /// See [`SurfacePoint::anchor`].
    pub anchor: Vector,
    /// See [`SurfacePoint::offset`].
    pub offset: Vector,
    /// The unit normal for shading, which points out of the shape; if the shape encloses nothing, to one of its sides.
    pub outward_normal: Vector,
    /// The unit normal of the surface itself, on the same side: it differs only on meshes with smooth normals.
    pub face_normal: Vector,
    /// See [`ShapeHit::shadow_ray_offset`], seen from the side of `face_normal`.
    pub shadow_ray_offset: Vector,
    /// The same offset, seen from the other side.
    pub shadow_ray_offset_behind: Vector,
}

impl NearestPoint {
    /// A point of a shape with a single part, with the same normal for shading and for shadows.
    #[must_use]
    pub fn new(anchor: Vector, offset: Vector, outward_normal: Vector) -> Self {
        let (shadow_ray_offset, shadow_ray_offset_behind) = (Vector::default(), Vector::default());
        Self {
            part: 0,
            anchor,
            offset,
            outward_normal,
            face_normal: outward_normal,
            shadow_ray_offset,
            shadow_ray_offset_behind,
        }
    }
}
