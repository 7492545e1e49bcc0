//! Every format is read correctly, and every fault in a file is reported.

mod files;
mod glb;
mod obj;
mod ply;
mod round_trip;
mod spheres;
mod stl;
mod write;

use super::{MeshFormat, SpheresFormat, TriangleMesh, mesh_from_bytes, spheres_from_bytes};

/// The message about a faulty mesh file.
fn mesh_fault(format: MeshFormat, bytes: impl AsRef<[u8]>) -> String {
    mesh_from_bytes(bytes.as_ref(), format).expect_err("something is wrong with it").to_string()
}

/// The message about a faulty file of spheres.
fn spheres_fault(format: SpheresFormat, bytes: impl AsRef<[u8]>) -> String {
    spheres_from_bytes(bytes.as_ref(), format).expect_err("something is wrong with it").to_string()
}

/// The corners of each triangle.
fn corners(mesh: &TriangleMesh) -> Vec<[[f64; 3]; 3]> {
    mesh.triangles.iter().map(|triangle| triangle.map(|index| mesh.vertices[index as usize])).collect()
}

/// The normals at the corners of each triangle.
fn normals(mesh: &TriangleMesh) -> Vec<[[f64; 3]; 3]> {
    let normals = mesh.normals.as_ref().expect("the mesh has normals");
    normals.corners.iter().map(|triangle| triangle.map(|index| normals.vectors[index as usize])).collect()
}

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];
const O: [f64; 3] = [0.0; 3];
