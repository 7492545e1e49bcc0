//! What must hold for every file that a reader accepts.

use isophote::{
    import::{MaterialSlots, MeshFormat, SpheresFormat, mesh_from_bytes, spheres_from_bytes},
    scene::{Scene, Syntax},
};

/// Whatever the bytes, they give a valid mesh or an error message.
pub fn check_mesh(bytes: &[u8], format: MeshFormat) {
    let mesh = match mesh_from_bytes(bytes, format) {
        Ok(mesh) => mesh,
        Err(fault) => return drop(fault.to_string()),
    };
    assert!(!mesh.triangles.is_empty());
    assert!(mesh.vertices.as_flattened().iter().all(|coordinate| coordinate.is_finite()));
    check_indices(&mesh.triangles, mesh.vertices.len());
    if let Some(normals) = &mesh.normals {
        assert_eq!(normals.corners.len(), mesh.triangles.len());
        check_indices(&normals.corners, normals.vectors.len());
        for normal in &normals.vectors {
            let square: f64 = normal.iter().map(|component| component * component).sum();
            assert!((square - 1.0).abs() < 1e-12, "{normal:?}");
        }
    }
    check_materials(mesh.materials.as_ref(), mesh.triangles.len());
}

/// Whatever the bytes, they give a valid list of spheres or an error message.
pub fn check_spheres(bytes: &[u8], format: SpheresFormat) {
    let list = match spheres_from_bytes(bytes, format) {
        Ok(list) => list,
        Err(fault) => return drop(fault.to_string()),
    };
    assert!(!list.centers.is_empty());
    assert_eq!(list.centers.len(), list.radii.len());
    assert!(list.centers.as_flattened().iter().all(|coordinate| coordinate.is_finite()));
    assert!(list.radii.iter().all(|radius| radius.is_finite() && *radius > 0.0));
    check_materials(list.materials.as_ref(), list.centers.len());
}

/// Whatever the text, it gives a scene or a report of its mistakes.
pub fn check_scene(bytes: &[u8], syntax: Syntax) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    if let Err(error) = Scene::from_text("scene", text, syntax) {
        drop(error.to_string());
    }
}

fn check_indices(triangles: &[[u32; 3]], count: usize) {
    assert!(triangles.as_flattened().iter().all(|index| (*index as usize) < count));
}

fn check_materials(materials: Option<&MaterialSlots>, count: usize) {
    let Some(MaterialSlots { names, slots }) = materials else { return };
    assert_eq!(slots.len(), count);
    assert!(slots.iter().all(|slot| usize::from(*slot) < names.len()));
}
