use super::{O, X, Y, Z, corners, mesh_fault, write::binary_stl};
use crate::import::{MeshFormat::Stl, mesh_from_bytes};

const ASCII: &str = "solid a part
facet normal 0 0 0
  outer loop
    vertex 0 0 0
    vertex 1.0 0 0
    vertex 0 1e0 0
  endloop
endfacet
endsolid
SOLID another
FACET NORMAL 0 0 1
OUTER LOOP
VERTEX 0 0 0
VERTEX -0.0 1 0
VERTEX 0 0 1
ENDLOOP
ENDFACET
ENDSOLID another
";

#[test]
fn ascii_solids_are_read_and_welded() {
    let mesh = mesh_from_bytes(ASCII.as_bytes(), Stl).unwrap();
    assert_eq!(corners(&mesh), [[O, X, Y], [O, Y, Z]]);
    assert_eq!(mesh.vertices.len(), 4);
}

#[test]
fn a_binary_file_is_told_by_its_size_even_if_it_begins_with_solid() {
    let bytes = binary_stl(b"solid but binary", &[[O, X, Y], [O, Y, Z], [X, X, Z]]);
    let mesh = mesh_from_bytes(&bytes, Stl).unwrap();
    assert_eq!(corners(&mesh), [[O, X, Y], [O, Y, Z]]);
    assert_eq!((mesh.vertices.len(), mesh.degenerate), (4, 1));
}

#[test]
fn mistakes_of_binary_files_are_named() {
    let bytes = binary_stl(b"solid", &[[O, X, Y], [O, Y, Z]]);
    assert_eq!(mesh_fault(Stl, &bytes[..150]), "header: 2 triangles need 100 bytes, but 66 are left in the file");
    assert_eq!(
        mesh_fault(Stl, [&bytes[..], &[0; 7]].concat()),
        "header: 7 bytes follow after 2 triangles; nothing may follow"
    );
    let mut lying = bytes.clone();
    lying[80..84].fill(0xff);
    assert_eq!(
        mesh_fault(Stl, lying),
        "header: 4294967295 triangles need 214748364750 bytes, but 100 are left in the file"
    );
    assert_eq!(
        mesh_fault(Stl, &bytes[..40]),
        "header: the header and the number of triangles need 84 bytes, but 40 are left in the file"
    );
    let infinite = binary_stl(b"", &[[O, X, Y], [O, [0.0, f64::INFINITY, 0.0], Z]]);
    assert_eq!(mesh_fault(Stl, infinite), "triangle 1: y is inf; it must be finite");
    assert_eq!(mesh_fault(Stl, binary_stl(b"", &[])), "the file: it has no triangles with an area (0 without)");
}

#[test]
fn mistakes_of_ascii_files_are_named_with_their_line() {
    let without = |line: usize| {
        let lines: Vec<&str> = ASCII.lines().collect();
        mesh_fault(Stl, [&lines[..line - 1], &lines[line..]].concat().join("\n"))
    };
    assert_eq!(without(3), "line 3: the line's first word is ‘vertex’; allowed: outer loop");
    assert_eq!(without(5), "line 6: the line's first word is ‘endloop’; allowed: vertex");
    assert_eq!(without(18), "line 17: ‘facet normal, or endsolid’ is missing; the file ends within a solid");
    let with = |vertex: &str| mesh_fault(Stl, ASCII.replace("1.0 0 0", vertex));
    assert_eq!(with("1 nan 0"), "line 5: y is NaN; it must be finite");
    assert_eq!(with("1 o 0"), "line 5: y is ‘o’; a number is needed");
    assert_eq!(with("1 0"), "line 5: the vertex has 2; allowed are 3 numbers");
    assert_eq!(with("1 0 0 0"), "line 5: the vertex has 4; allowed are 3 numbers");
}
