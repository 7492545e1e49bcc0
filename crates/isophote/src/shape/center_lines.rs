//! Lines in a shape along which it is looked for where it appears narrower than a pixel.

use super::{Geometry, Sphere};
use crate::vector::Vector;

/// A straight line in a shape, with the half width of the shape around it; a point if both ends are the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CenterLine {
    /// Its ends, in metres.
    pub ends: [Vector; 2],
    /// The half width at each end, in metres; 0 at an edge, which has other lines around it.
    pub radii: [f64; 2],
}

/// The number of sides of the polygon that stands for a circle.
const SIDES: u32 = 24;

/// How far inside an edge its line is, as a fraction of the shape's size: a ray along the edge itself may pass by.
const INSET: f64 = 1e-3;

impl Geometry {
    /// The lines of a part. Wherever the part appears narrower than a pixel, every pixel that shows some of it is within a half
    /// width of one of them. An unbounded shape has none.
    #[must_use]
    pub fn center_lines(&self, part: u32) -> Vec<CenterLine> {
        match self {
            Self::Sphere(sphere) => vec![of_sphere(sphere)],
            Self::Spheres(cloud) => vec![of_sphere(&cloud.spheres[part as usize])],
            Self::Ellipsoid(ellipsoid) => {
                // Thin like a needle, or flat like a coin.
                let [shortest, middle, longest] = ellipsoid.semi_axes();
                let center = ellipsoid.center();
                let [width, thickness] = [middle.length(), shortest.length()];
                let needle = CenterLine { ends: [center - longest, center + longest], radii: [width; 2] };
                ring(center, longest, middle, thickness).chain([needle]).collect()
            }
            Self::Plane(_) => Vec::new(),
            Self::Rectangle(rectangle) => {
                let ([right, up, _], [width, height]) = (rectangle.axes(), rectangle.sides());
                let (right, up) = (right * (0.5 * width), up * (0.5 * height));
                outline(rectangle.center(), &[right + up, up - right, -right - up, right - up]).collect()
            }
            Self::Disk(disk) => {
                let [first, second] = disk.normal().perpendiculars();
                ring(disk.center(), first * disk.size(), second * disk.size(), 0.0).collect()
            }
            Self::Cuboid(cuboid) => edges(cuboid.center(), cuboid.half_axes()),
            Self::Cylinder(cylinder) => of_cone(cylinder.ends(), [cylinder.radius(); 2]),
            Self::Cone(cone) => of_cone(cone.ends(), cone.radii()),
            Self::Mesh(mesh) => {
                let corners = mesh.corners(part);
                let middle = (corners[0] + corners[1] + corners[2]) * (1.0 / 3.0);
                outline(middle, &corners.map(|corner| corner - middle)).collect()
            }
        }
    }
}

fn of_sphere(sphere: &Sphere) -> CenterLine {
    CenterLine { ends: [sphere.center; 2], radii: [sphere.radius; 2] }
}

/// The axis, and the rims of both ends.
fn of_cone(ends: [Vector; 2], radii: [f64; 2]) -> Vec<CenterLine> {
    let [first, second] = (ends[1] - ends[0]).normalized().perpendiculars();
    let middle = (ends[0] + ends[1]) * 0.5;
    let rims = ends
        .into_iter()
        .zip(radii)
        .flat_map(|(end, radius)| ring(end + (middle - end) * INSET, first * radius, second * radius, 0.0));
    rims.chain([CenterLine { ends, radii }]).collect()
}

/// The twelve edges of a box with these halves of its sides.
fn edges(center: Vector, [a, b, c]: [Vector; 3]) -> Vec<CenterLine> {
    let along = |along: Vector, one: Vector, other: Vector| {
        [one + other, one - other, other - one, -one - other].map(move |beside| [beside - along, beside + along])
    };
    let edges = [along(a, b, c), along(b, c, a), along(c, a, b)];
    edges.into_iter().flatten().map(|ends| edge(center, ends)).collect()
}

/// A circle or an ellipse around a centre, with these two half axes.
fn ring(center: Vector, first: Vector, second: Vector, radius: f64) -> impl Iterator<Item = CenterLine> {
    let corner = move |index: u32| {
        let angle = std::f64::consts::TAU * f64::from(index) / f64::from(SIDES);
        first * libm::cos(angle) + second * libm::sin(angle)
    };
    (0..SIDES).map(move |index| {
        let edge = edge(center, [corner(index), corner(index + 1)]);
        CenterLine { radii: [radius; 2], ..edge }
    })
}

/// The edges of a polygon, whose corners are given from its middle.
fn outline(middle: Vector, corners: &[Vector]) -> impl Iterator<Item = CenterLine> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(move |(corner, next)| edge(middle, [*corner, *next]))
}

/// An edge, just inside it.
fn edge(middle: Vector, ends: [Vector; 2]) -> CenterLine {
    CenterLine { ends: ends.map(|end| middle + end * (1.0 - INSET)), radii: [0.0; 2] }
}
