//! Files of triangle meshes (OBJ, PLY, STL, glTF binary) and of many spheres (CSV, NPY, PLY), read into plain data. This
//! module knows nothing about scenes: lengths are in the file's unit, materials are names.
//!
//! Files are read strictly: anything wrong is an error that names the place, the value and what is allowed, never a guess.
//! Memory is allocated for what a file really holds, not for what its header claims.

mod error;
mod format;
mod materials;
mod mesh;
mod ply;
mod resolver;
mod spheres;
#[cfg(test)]
mod tests;
mod text;

use std::path::Path;

pub use error::{Fault, FilePosition, FileProblem, ImportError};
pub use format::{MeshFormat, SpheresFormat};
pub use materials::MaterialSlots;
pub use mesh::TriangleMesh;
pub use resolver::{MemoryFiles, NoFiles, Origin, ReadFailure, Resolver};
pub use spheres::SphereList;

/// The triangles of a file whose suffix is `.obj`, `.ply`, `.stl` or `.glb`.
///
/// # Errors
/// [`ImportError`]: another suffix; a file that cannot be read; everything that [`mesh_from_bytes`] rejects.
pub fn read_mesh(files: &dyn Resolver, name: &str) -> Result<TriangleMesh, ImportError> {
    read(files, name, MeshFormat::from_suffix, mesh_from_bytes, |mesh| mesh.triangles.len())
}

/// The spheres of a file whose suffix is `.csv`, `.npy` or `.ply`.
///
/// # Errors
/// [`ImportError`]: another suffix; a file that cannot be read; everything that [`spheres_from_bytes`] rejects.
pub fn read_spheres(files: &dyn Resolver, name: &str) -> Result<SphereList, ImportError> {
    read(files, name, SpheresFormat::from_suffix, spheres_from_bytes, |spheres| spheres.radii.len())
}

fn read<F, T>(
    files: &dyn Resolver,
    name: &str,
    format: impl FnOnce(&Path) -> Result<F, ImportError>,
    content: impl FnOnce(&[u8], F) -> Result<T, Fault>,
    parts: impl FnOnce(&T) -> usize,
) -> Result<T, ImportError> {
    let file = files.full_name(name);
    let format = format(&file)?;
    let unread = |failure| ImportError::Unread { file: file.clone(), failure };
    files.admit(files.size(name).unwrap_or(0)).map_err(unread)?;
    let bytes = files.read(name).map_err(unread)?;
    let content =
        content(&bytes, format).map_err(|fault| ImportError::Content { file: file.clone(), fault: fault.into() })?;
    drop(bytes);
    files.admit(PART_BYTES * parts(&content) as u64).map_err(unread)?;
    Ok(content)
}

/// The memory in bytes that a triangle or a sphere of a file takes in a scene, with its part of the tree, as measured.
pub const PART_BYTES: u64 = 160;

/// The triangles in the contents of a file.
///
/// # Errors
/// [`Fault`]: contents of another format; damage; numbers that are not finite; indices out of range; no triangle with an
/// area; features of the format that are not supported (each named).
pub fn mesh_from_bytes(bytes: &[u8], format: MeshFormat) -> Result<TriangleMesh, Fault> {
    format::check(bytes, format.format())?;
    match format {
        MeshFormat::Obj => mesh::obj::read(bytes),
        MeshFormat::Ply => ply::mesh::read(bytes),
        MeshFormat::Stl => mesh::stl::read(bytes),
        MeshFormat::Glb => mesh::glb::read(bytes),
    }
}

/// The triangles of arrays: the vertices, the three corners of each triangle, and a direction at each vertex, if there are any.
///
/// # Errors
/// [`Fault`]: indices out of range; a direction of no length; no triangle with an area.
pub fn mesh_from_arrays(
    vertices: &[[f64; 3]],
    faces: &[[u64; 3]],
    normals: Option<&[[f64; 3]]>,
) -> Result<TriangleMesh, Fault> {
    mesh::arrays::read(vertices, faces, normals)
}

/// The spheres in the contents of a file.
///
/// # Errors
/// [`Fault`]: contents of another format; damage; numbers that are not finite; radii that are not positive; no sphere;
/// missing or unknown columns.
pub fn spheres_from_bytes(bytes: &[u8], format: SpheresFormat) -> Result<SphereList, Fault> {
    format::check(bytes, format.format())?;
    match format {
        SpheresFormat::Csv => spheres::csv::read(bytes),
        SpheresFormat::Npy => spheres::npy::read(bytes),
        SpheresFormat::Ply => ply::spheres::read(bytes),
    }
}
