//! The triangle mesh (2.5).

mod build;
#[cfg(test)]
mod tests;
mod triangle;

use super::{Accuracy, Bounds, Intersection, Measure, NearestPoint};
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vector::Vector;

pub use build::{CornerNormals, MeshData, MeshError, MeshPlacing};
use triangle::Triangle;

/// Triangles that share their corners: the parts of the shape. Stored compactly, since there may be millions: two lists of
/// numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    normals: Option<CornerNormals>,
    /// The slot of each triangle; empty if all use the shape's own material.
    slots: Vec<u16>,
    /// The material of each slot; `None` stands for the shape's own.
    materials: Vec<Option<u32>>,
    /// The number of triangles without area that were left out.
    left_out: usize,
    bounds: Bounds,
}

impl Mesh {
    /// Intersects a ray with one of its triangles; see `Triangle::intersect`.
    pub fn intersect<T: Scalar>(&self, part: u32, ray: &Ray<T>, accuracy: Accuracy) -> Intersection<T> {
        self.triangle(part).intersect(ray, accuracy, self.size())
    }

    /// The corners of one of its triangles, in metres, and the normals there, if it has any: unit vectors, or zero.
    pub(crate) fn corners_and_normals(&self, part: u32) -> ([Vector; 3], Option<[Vector; 3]>) {
        let Triangle { corners, normals } = self.triangle(part);
        (corners, normals)
    }

    pub(super) fn triangle(&self, part: u32) -> Triangle {
        let (corners, part) = (self.corners(part), part as usize);
        let vector = |list: &[[f64; 3]], index: u32| Vector::from(list[index as usize]);
        let normals = self.normals.as_ref();
        let normals = normals.map(|normals| normals.corners[part].map(|index| vector(&normals.vectors, index)));
        Triangle { corners, normals }
    }

    /// The number of triangles.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "`new` refuses more than 32 bits can count")]
    pub fn parts(&self) -> u32 {
        self.triangles.len() as u32
    }

    /// The number of triangles without area that were left out.
    #[must_use]
    pub fn left_out(&self) -> usize {
        self.left_out
    }

    /// The material of a triangle, if it has its own.
    #[must_use]
    pub fn material_of(&self, part: u32) -> Option<usize> {
        let slot = *self.slots.get(part as usize)?;
        self.materials.get(usize::from(slot)).copied().flatten().map(|material| material as usize)
    }

    /// The distance to the nearest triangle, never negative: a mesh need not enclose anything.
    #[must_use]
    pub fn distance(&self, point: Vector) -> f64 {
        self.nearest_triangle(point).1
    }

    /// The surface point nearest to a point.
    #[must_use]
    pub fn nearest(&self, point: Vector) -> NearestPoint {
        let (part, _) = self.nearest_triangle(point);
        NearestPoint { part, ..self.triangle(part).nearest(point) }
    }

    fn nearest_triangle(&self, point: Vector) -> (u32, f64) {
        let distances = (0..self.parts()).map(|part| (part, self.triangle(part).distance(point)));
        distances.min_by(|first, second| first.1.total_cmp(&second.1)).unwrap_or((0, f64::INFINITY))
    }

    /// The corners of one of its triangles, in metres.
    #[must_use]
    pub fn corners(&self, part: u32) -> [Vector; 3] {
        self.triangles[part as usize].map(|index| Vector::from(self.vertices[index as usize]))
    }

    /// The bounding box of one of its triangles.
    #[must_use]
    pub fn part_bounds(&self, part: u32) -> Bounds {
        let corners = self.corners(part);
        corners
            .map(|corner| Bounds { least: corner, greatest: corner })
            .into_iter()
            .fold(Bounds { least: corners[0], greatest: corners[0] }, Bounds::union)
    }
    /// Half the diagonal of its bounding box, in metres.
    #[must_use]
    pub fn size(&self) -> f64 {
        0.5 * (self.bounds.greatest - self.bounds.least).length()
    }

    /// The distance of a point, in sizes.
    #[must_use]
    pub fn relative_distance(&self, point: Vector) -> f64 {
        let middle = self.bounds.least * 0.5 + self.bounds.greatest * 0.5;
        (point - middle).length() / self.size()
    }

    /// The values that describe it.
    #[must_use]
    pub fn measures(&self) -> Vec<(&'static str, Measure)> {
        vec![
            ("triangles", Measure::Count(self.triangles.len())),
            ("vertices", Measure::Count(self.vertices.len())),
            ("least corner", Measure::Vector(self.bounds.least)),
            ("greatest corner", Measure::Vector(self.bounds.greatest)),
        ]
    }
}
