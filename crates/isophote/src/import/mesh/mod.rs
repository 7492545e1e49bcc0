//! Triangle meshes, one file per format.

pub(super) mod arrays;
mod build;
pub(super) mod glb;
pub(super) mod obj;
pub(super) mod stl;
mod weld;

pub(super) use build::{MeshBuilder, NO_NORMALS};

use super::MaterialSlots;
use crate::shape::CornerNormals;

/// The triangles of a file that have an area, in the order of the file.
///
/// No two vertices are equal, and each belongs to a triangle: neighbours share the indices of their corners, even where the
/// file stores them separately (STL; texture seams). Corners run counter-clockwise as seen from outside, if the file follows
/// that rule.
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleMesh {
    /// Positions in the file's unit of length, all finite.
    pub vertices: Vec<[f64; 3]>,
    /// The corners of each triangle: indices into `vertices`.
    pub triangles: Vec<[u32; 3]>,
    /// Directions for smooth shading, if the file has any.
    pub normals: Option<CornerNormals>,
    /// Materials by name, if the file has any.
    pub materials: Option<MaterialSlots>,
    /// The number of triangles in the file that have no area and were left out.
    pub degenerate: u64,
}
