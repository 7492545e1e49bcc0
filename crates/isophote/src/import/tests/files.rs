//! Files by name, and contents that do not match their names.

use super::{
    mesh_fault, spheres_fault,
    write::{binary_stl, glb},
};
use crate::import::{
    ImportError, MemoryFiles,
    MeshFormat::{self, Glb, Obj, Ply, Stl},
    Resolver,
    SpheresFormat::{self, Csv, Npy},
    read_mesh, read_spheres,
};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

#[test]
fn a_format_is_chosen_by_the_suffix_in_either_case() {
    let files = MemoryFiles::from_iter([("Triangle.OBJ", TRIANGLE), ("points.csv", "x,y,z,radius\n1,2,3,4\n")]);
    assert_eq!(read_mesh(&files, "Triangle.OBJ").unwrap().triangles.len(), 1);
    assert_eq!(read_spheres(&files, "points.csv").unwrap().radii, [4.0]);
}

#[test]
fn a_file_that_is_not_at_hand_is_called_by_its_name() {
    let files = MemoryFiles::from_iter([("triangle.obj", TRIANGLE), ("square.obj", TRIANGLE)]);
    let error = read_mesh(&files, "circle.obj").unwrap_err();
    assert_eq!(error.to_string(), "there is no file ‘circle.obj’ here");
    let ImportError::Unread { failure, .. } = error else { panic!("{error}") };
    assert_eq!(failure.help().to_string(), "allowed: square.obj, triangle.obj");
}

#[test]
fn files_in_memory_are_told_apart_by_what_they_hold() {
    let files = |content: &str| MemoryFiles::from_iter([("triangle.obj", content)]).origin();
    assert!(files(TRIANGLE).is_same_place(&files(TRIANGLE)));
    assert!(!files(TRIANGLE).is_same_place(&files("")));
}

#[test]
fn an_empty_file_is_no_mesh_and_no_list() {
    assert_eq!(mesh_fault(Obj, ""), "the file: it is empty; OBJ is needed");
    assert_eq!(mesh_fault(Stl, ""), "the file: it is empty; STL is needed");
    assert_eq!(spheres_fault(Npy, ""), "the file: it is empty; NPY is needed");
}

#[test]
fn contents_of_another_format_are_recognised() {
    let ply = b"ply\nformat ascii 1.0\nend_header\n";
    let stl = binary_stl(b"", &[[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]]);
    let contents: [(&[u8], &str); 14] = [
        (TRIANGLE.as_bytes(), "OBJ"),
        (b"# from somewhere\n\nmtllib a.mtl\n", "OBJ"),
        (ply, "PLY"),
        (&stl, "STL"),
        (b" solid x\nfacet", "STL"),
        (&glb("{}", &[]), "glTF binary"),
        (b"x,y,z,radius\n", "CSV"),
        (b"\x93NUMPY\x01\0", "NPY"),
        (b"PK\x03\x04...", "a ZIP archive (NPZ, 3MF, USDZ)"),
        (b"\x89PNG\r\n\x1a\n", "a PNG picture"),
        (b"{\"asset\": {}}", "JSON (a glTF scene goes into one file as .glb)"),
        (b"<?xml version=\"1.0\"?>", "XML or HTML"),
        (b"\xff\xfev\0 \0", "text in UTF-16"),
        (b"\0\x01\x02", "binary data"),
    ];
    for (bytes, name) in contents {
        for (format, expected) in [(Obj, "OBJ"), (Ply, "PLY"), (Stl, "STL"), (Glb, "glTF binary")] {
            let fault = mesh_error(format, bytes);
            let is_another = expected != name && (expected, name) != ("STL", "binary data");
            let message = format!("the file: it is no {expected} file: it looks like {name}");
            assert_eq!(fault.as_deref() == Some(&message), is_another, "{name} as {expected}: {fault:?}");
        }
        for (format, expected) in [(Csv, "CSV"), (Npy, "NPY"), (SpheresFormat::Ply, "PLY")] {
            let message = format!("the file: it is no {expected} file: it looks like {name}");
            let is_another = expected != name;
            assert_eq!(spheres_fault_or_none(format, bytes) == Some(message), is_another, "{name} as {expected}");
        }
    }
    assert_eq!(mesh_fault(Ply, "hello"), "the file: it is no PLY file: it looks like nothing known here");
}

fn mesh_error(format: MeshFormat, bytes: &[u8]) -> Option<String> {
    crate::import::mesh_from_bytes(bytes, format).err().map(|fault| fault.to_string())
}

fn spheres_fault_or_none(format: SpheresFormat, bytes: &[u8]) -> Option<String> {
    crate::import::spheres_from_bytes(bytes, format).err().map(|fault| fault.to_string())
}
