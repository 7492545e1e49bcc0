//! Files of triangle meshes (OBJ, PLY, STL, glTF binary) and of many spheres (CSV, NPY, PLY), read into plain data.
//! Nothing here knows of scenes: lengths are in the file's unit, materials are names.
//!
//! A file is read strictly: what is wrong in it is an error that names the place, the value and what is allowed, never
//! a guess. Memory is taken for what a file really holds, not for what its header claims.

mod error;
mod format;
mod materials;
mod mesh;
mod ply;
mod spheres;
#[cfg(test)]
mod tests;
mod text;

use std::path::Path;

pub use error::{Fault, FilePosition, FileProblem, ImportError};
pub use format::{MeshFormat, SpheresFormat};
pub use materials::MaterialSlots;
pub use mesh::TriangleMesh;
pub use spheres::SphereList;

/// The triangles of a file whose suffix is `.obj`, `.ply`, `.stl` or `.glb`.
///
/// # Errors
/// [`ImportError`]: another suffix; a file that cannot be read; all that [`mesh_from_bytes`] refuses.
pub fn read_mesh(path: &Path) -> Result<TriangleMesh, ImportError> {
    let format = MeshFormat::from_suffix(path)?;
    let bytes = format::contents(path)?;
    mesh_from_bytes(&bytes, format).map_err(|fault| ImportError::Content { file: path.into(), fault: fault.into() })
}

/// The spheres of a file whose suffix is `.csv`, `.npy` or `.ply`.
///
/// # Errors
/// [`ImportError`]: another suffix; a file that cannot be read; all that [`spheres_from_bytes`] refuses.
pub fn read_spheres(path: &Path) -> Result<SphereList, ImportError> {
    let format = SpheresFormat::from_suffix(path)?;
    let bytes = format::contents(path)?;
    spheres_from_bytes(&bytes, format).map_err(|fault| ImportError::Content { file: path.into(), fault: fault.into() })
}

/// The triangles of a file's contents.
///
/// # Errors
/// [`Fault`]: contents of another format; damage; numbers that are not finite; indices out of range; no triangle that
/// has an area; features of the format that are not supported (named one by one).
pub fn mesh_from_bytes(bytes: &[u8], format: MeshFormat) -> Result<TriangleMesh, Fault> {
    format::check(bytes, format.format())?;
    match format {
        MeshFormat::Obj => mesh::obj::read(bytes),
        MeshFormat::Ply => ply::mesh::read(bytes),
        MeshFormat::Stl => mesh::stl::read(bytes),
        MeshFormat::Glb => mesh::glb::read(bytes),
    }
}

/// The spheres of a file's contents.
///
/// # Errors
/// [`Fault`]: contents of another format; damage; numbers that are not finite; radii that are not positive; no sphere;
/// columns that are missing or unknown.
pub fn spheres_from_bytes(bytes: &[u8], format: SpheresFormat) -> Result<SphereList, Fault> {
    format::check(bytes, format.format())?;
    match format {
        SpheresFormat::Csv => spheres::csv::read(bytes),
        SpheresFormat::Npy => spheres::npy::read(bytes),
        SpheresFormat::Ply => ply::spheres::read(bytes),
    }
}
