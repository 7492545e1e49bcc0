//! Coordinates on a surface.

use super::cylinder::CylinderChart;
use super::disk::DiskChart;
use super::rectangle::RectangleChart;
use super::sphere::SphereChart;
use super::{SurfaceError, SurfaceProjection};
use crate::map::Coordinates;
use crate::shape::Geometry;
use crate::vector::Vector;

/// The coordinates of a shape: one variant for each kind that has them.
#[derive(Clone, Debug)]
pub(super) enum Chart {
    Sphere(SphereChart),
    Cylinder(CylinderChart),
    Rectangle(RectangleChart),
    Disk(DiskChart),
}

/// A point with given coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct ChartPoint {
    /// See [`SurfacePoint`](crate::shape::SurfacePoint).
    pub(super) anchor: Vector,
    pub(super) offset: Vector,
    /// The unit normal on the front.
    pub(super) normal: Vector,
}

impl Chart {
    pub(super) fn new(
        geometry: &Geometry,
        part: u32,
        projection: SurfaceProjection,
        axis: Option<Vector>,
    ) -> Result<Self, SurfaceError> {
        let chart = match geometry {
            Geometry::Sphere(sphere) => return Ok(Self::Sphere(SphereChart::new(sphere, projection, axis))),
            Geometry::Spheres(cloud) => {
                return Ok(Self::Sphere(SphereChart::new(&cloud.spheres[part as usize], projection, axis)));
            }
            Geometry::Cylinder(cylinder) => Self::Cylinder(CylinderChart::new(cylinder)),
            Geometry::Rectangle(rectangle) => Self::Rectangle(RectangleChart::new(rectangle)),
            Geometry::Disk(disk) => Self::Disk(DiskChart::new(disk, projection)),
            _ => return Err(SurfaceError::NoCoordinates { kind: geometry.kind() }),
        };
        if axis.is_some() { Err(SurfaceError::AxisOfItsOwn { kind: geometry.kind() }) } else { Ok(chart) }
    }

    pub(super) fn coordinates(&self) -> Coordinates {
        match self {
            Self::Sphere(sphere) => sphere.coordinates(),
            Self::Cylinder(_) => Coordinates::AngleHeight,
            Self::Rectangle(_) => Coordinates::Sides,
            Self::Disk(disk) => disk.coordinates(),
        }
    }

    /// The ranges of x and y: in degrees, in metres, or as pure numbers.
    pub(super) fn ranges(&self) -> [[f64; 2]; 2] {
        match self {
            Self::Sphere(sphere) => [CIRCLE, sphere.latitudes()],
            Self::Cylinder(cylinder) => [CIRCLE, [0.0, cylinder.height()]],
            Self::Rectangle(rectangle) => rectangle.ranges(),
            Self::Disk(disk) => [CIRCLE, disk.radii()],
        }
    }

    /// Width and height of the map on paper, by convention or as the surface unrolls.
    pub(super) fn proportions(&self) -> [f64; 2] {
        match self {
            Self::Sphere(sphere) => sphere.proportions(),
            Self::Cylinder(cylinder) => cylinder.proportions(),
            Self::Rectangle(rectangle) => rectangle.ranges().map(|[first, last]| last - first),
            Self::Disk(_) => DiskChart::PROPORTIONS,
        }
    }

    pub(super) fn point(&self, place: [f64; 2]) -> ChartPoint {
        match self {
            Self::Sphere(sphere) => sphere.point(place),
            Self::Cylinder(cylinder) => cylinder.point(place),
            Self::Rectangle(rectangle) => rectangle.point(place),
            Self::Disk(disk) => disk.point(place),
        }
    }

    /// The exact area between two x and two y, in m².
    pub(super) fn area(&self, x: [f64; 2], y: [f64; 2]) -> f64 {
        match self {
            Self::Sphere(sphere) => sphere.area(x, y),
            Self::Cylinder(cylinder) => cylinder.area(x, y),
            Self::Rectangle(_) => (x[1] - x[0]) * (y[1] - y[0]),
            Self::Disk(disk) => disk.area(x, y),
        }
    }

    pub(super) fn axis_of_sphere(&self) -> Option<Vector> {
        match self {
            Self::Sphere(sphere) => Some(sphere.axis()),
            _ => None,
        }
    }

    pub(super) fn left_out(&self) -> Option<&'static str> {
        matches!(self, Self::Cylinder(_)).then_some("its two ends")
    }
}

/// All angles about an axis, in degrees.
const CIRCLE: [f64; 2] = [-180.0, 180.0];

/// Unit vectors perpendicular to an axis (a unit vector), in the directions of the angles 0° and 90°. 0° is on the side of
/// +z, or of +x if the axis is along z. Seen against the axis, angles grow counter-clockwise in right-handed axes: with the
/// axis along y, 90° is +x.
pub(super) fn meridians(axis: Vector) -> [Vector; 2] {
    let side = if axis.z.abs() > 0.999 { Vector::new(1.0, 0.0, 0.0) } else { Vector::new(0.0, 0.0, 1.0) };
    let ninety = axis.cross(side).normalized();
    [ninety.cross(axis), ninety]
}

/// The direction of an angle in degrees.
pub(super) fn around([zero, ninety]: [Vector; 2], degrees: f64) -> Vector {
    let angle = degrees.to_radians();
    zero * libm::cos(angle) + ninety * libm::sin(angle)
}
