use super::{O, X, Y, Z, corners, mesh_fault, normals};
use crate::import::{MeshFormat::Obj, TriangleMesh, mesh_from_bytes};

fn read(text: &str) -> TriangleMesh {
    mesh_from_bytes(text.as_bytes(), Obj).unwrap_or_else(|fault| panic!("{fault}"))
}

#[test]
fn polygons_become_fans_and_neighbours_share_corners() {
    let mesh = read("# a square\nv 0 0 0\nv 1 0 0 # with a comment\r\nv 1 1 0 1.0\nv 0 1 0 0.5 0.5 0.5\n\nf 1 2 3 4\n");
    assert_eq!(corners(&mesh), [[O, X, [1.0, 1.0, 0.0]], [O, [1.0, 1.0, 0.0], Y]]);
    assert_eq!((mesh.vertices.len(), mesh.degenerate), (4, 0));
    assert!(mesh.normals.is_none() && mesh.materials.is_none());
}

#[test]
fn indices_count_backwards_and_forwards_and_lines_go_on() {
    let mesh = read("f 1 2 \\\n 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf -3/1 -2/-1 -1/1\nv 0 0 1\nf -1 1 2");
    assert_eq!(corners(&mesh), [[O, X, Y], [O, X, Y], [Z, O, X]]);
}

#[test]
fn normals_are_unit_vectors_and_faces_without_any_have_their_planes() {
    let mesh = read(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 5\nvn 3 0 0\nvt 0 0\nf 1 2 3\nf 1//1 2//2 3//1\nf 1/1/2 3/1/2 2/1/2\nf 1 3 2\n",
    );
    assert_eq!(normals(&mesh), [[Z; 3], [Z, X, Z], [X; 3], [[0.0, 0.0, -1.0]; 3]]);
}

#[test]
fn materials_are_slots_by_name() {
    let face = "f 1 2 3\n";
    let text = format!(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\n{face}usemtl red paint\n{face}usemtl b\n{face}{face}usemtl red paint\n{face}"
    );
    let materials = read(&text).materials.expect("some are named");
    assert_eq!(materials.names, [None, Some("red paint".to_owned()), Some("b".to_owned())]);
    assert_eq!(materials.slots, [0, 1, 2, 2, 1]);
    let all_named =
        read("usemtl none has this\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3").materials.expect("all are named");
    assert_eq!(all_named.names, [Some("a".to_owned())]);
}

#[test]
fn triangles_without_area_are_counted_and_leave_no_vertices() {
    let mesh = read("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 5 5 5\nusemtl a\nf 2 3 4\nf 2 3 5\nf 1 1 6\n");
    assert_eq!((mesh.vertices.len(), mesh.triangles.len(), mesh.degenerate), (3, 1, 2));
    assert_eq!(mesh.materials.expect("there is one").slots, [0]);
    assert_eq!(mesh_fault(Obj, "v 0 0 0\nf 1 1 1\n"), "the file: it has no triangles with an area (1 without)");
    assert_eq!(mesh_fault(Obj, "v 0 0 0\n"), "the file: it has no triangles with an area (0 without)");
}

#[test]
fn mistakes_are_named_with_their_line() {
    let three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let with = |line: &str| mesh_fault(Obj, format!("{three}{line}\n"));
    assert_eq!(with("f 1 2 4"), "line 4: the vertex index is 4; allowed are 1 to 3, or -3 to -1 counted backwards");
    assert_eq!(with("f 1 2 0"), "line 4: the vertex index is 0; allowed are 1 to 3, or -3 to -1 counted backwards");
    assert_eq!(with("f -4 1 2"), "line 4: the vertex index is -4; allowed are 1 to 3, or -3 to -1 counted backwards");
    assert_eq!(with("f 1//1 2//1 3//1"), "line 4: the normal index is 1; there are none");
    assert_eq!(with("f 1 2"), "line 4: the face has 2; at least 3 corners are needed");
    assert_eq!(with("f 1 2 3.5"), "line 4: the vertex index is ‘3.5’; a whole number is needed");
    assert_eq!(with("f 1/ 2 3"), "line 4: a corner is ‘1/’; allowed: v, v/vt, v//vn or v/vt/vn");
    assert_eq!(
        with("vn 0 0 1\nf 1//1 2 3"),
        "line 5: corner 2 of the face is ‘2’; allowed: the form of the first corner (v, v/vt, v//vn or v/vt/vn)"
    );
    assert_eq!(
        with("vn 0 0 0\nf 1//1 2//1 3//1"),
        "line 5: normal 1 of a triangle's corner is (0, 0, 0); a normal needs a direction"
    );
    assert_eq!(with("v 1 nan 2"), "line 4: y is NaN; it must be finite");
    assert_eq!(with("v 1 2 -1e999"), "line 4: z is -inf; it must be finite");
    assert_eq!(with("v 1 2 three"), "line 4: z is ‘three’; a number is needed");
    assert_eq!(with("v 1 2"), "line 4: the vertex has 2; allowed are 3, 4, 6, 7 numbers");
    assert_eq!(
        with("vertex 1 2 3"),
        "line 4: the line's first word is ‘vertex’; allowed: the keywords of OBJ: v, vn, vt, f, usemtl, o, g, s, mtllib \
         and others"
    );
    assert_eq!(
        with("cstype bezier"),
        "line 4: ‘cstype’ (curves, curved surfaces, other files) cannot be read here; export polygons"
    );
    assert_eq!(with("f 1 2 \\"), "the file: the line after the last ‘\\’ is missing; it is continued there");
}
