//! Triangle meshes, one file per format.

mod build;
pub(super) mod glb;
pub(super) mod obj;
pub(super) mod stl;
mod weld;

pub(super) use build::{MeshBuilder, NO_NORMALS};

use super::MaterialSlots;
use crate::shape::CornerNormals;

/// The triangles of a file that have an area, in its order.
///
/// No two vertices are equal, and each belongs to a triangle: neighbours share the indices of their corners, whether the
/// file had them apart (STL; seams of textures) or not. Corners run counter-clockwise as seen from outside, where the
/// file keeps to that.
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleMesh {
    /// Positions in the file's unit of length, all finite.
    pub vertices: Vec<[f64; 3]>,
    /// The corners of each triangle: indices into `vertices`.
    pub triangles: Vec<[u32; 3]>,
    /// Directions for smooth shading, where the file has any.
    pub normals: Option<CornerNormals>,
    /// Materials by name, where the file has any.
    pub materials: Option<MaterialSlots>,
    /// How many triangles of the file have no area and were left out.
    pub degenerate: u64,
}
