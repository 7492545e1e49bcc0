use super::{O, X, Y, Z, corners, mesh_fault, normals};
use crate::import::{MeshFormat::Ply, mesh_from_bytes};

const ASCII: &str = "ply
format ascii 1.0
comment made by hand
element vertex 5
property uchar red
property double z
property float x
property float y
element face 2
property uchar quality
property list uchar int vertex_indices
element edge 1
property int vertex1
property int vertex2
end_header
0 0 0 0
0 0 1 0
255 0 1 1
0 0 0 1
9 1 0 0

7 4 0 1 2 3
7 3 0 1 4
0 1
";

#[test]
fn properties_come_in_any_order_and_others_are_passed_over() {
    let mesh = mesh_from_bytes(ASCII.as_bytes(), Ply).unwrap();
    assert_eq!(corners(&mesh), [[O, X, [1.0, 1.0, 0.0]], [O, [1.0, 1.0, 0.0], Y], [O, X, Z]]);
    assert!(mesh.normals.is_none());
    assert_eq!(mesh_from_bytes(ASCII.replace('\n', "\r\n").as_bytes(), Ply).unwrap(), mesh);
}

#[test]
fn binary_files_of_both_byte_orders_say_the_same() {
    let header = |order: &str| {
        format!(
            "ply\nformat binary_{order}_endian 1.0\nelement tags 1\nproperty list ushort short tag\nelement vertex 3\n\
             property double x\nproperty float y\nproperty short z\nproperty float nx\nproperty float ny\nproperty char nz\n\
             element face 1\nproperty list uint ushort vertex_index\nend_header\n"
        )
    };
    let body = |big: bool| {
        let mut body = Vec::new();
        let mut put = |bytes: &[u8]| {
            let mut bytes = bytes.to_vec();
            if big {
                bytes.reverse();
            }
            body.extend(bytes);
        };
        for value in [2_u16, 1, 65535] {
            put(&value.to_le_bytes());
        }
        for (x, y, z) in [(0.0, 0.0, 0), (0.1, 0.0, 0), (0.0, 0.5, -300)] {
            put(&f64::to_le_bytes(x));
            put(&f32::to_le_bytes(y));
            put(&i16::to_le_bytes(z));
            put(&f32::to_le_bytes(0.0));
            put(&f32::to_le_bytes(0.0));
            put(&i8::to_le_bytes(-2));
        }
        put(&3_u32.to_le_bytes());
        for value in [0_u16, 1, 2] {
            put(&value.to_le_bytes());
        }
        body
    };
    let little = [header("little").into_bytes(), body(false)].concat();
    let big = [header("big").into_bytes(), body(true)].concat();
    let mesh = mesh_from_bytes(&little, Ply).unwrap();
    assert_eq!(corners(&mesh), [[O, [0.1, 0.0, 0.0], [0.0, 0.5, -300.0]]]);
    assert_eq!(normals(&mesh), [[[0.0, 0.0, -1.0]; 3]]);
    assert_eq!(mesh_from_bytes(&big, Ply).unwrap(), mesh);

    let index = little.len() - 2;
    let wrong = [&little[..index], &[3, 0]].concat();
    assert_eq!(mesh_fault(Ply, wrong), "face 0: a vertex index is 3; allowed are 0 to 2");
    let long = [&little[..index - 8], &u32::MAX.to_le_bytes(), &[0; 6]].concat();
    let message = "face 0: 4294967295 values of list vertex_index need 8589934590 bytes, but 6 are left in the file";
    assert_eq!(mesh_fault(Ply, long), message);
    assert_eq!(
        mesh_fault(Ply, &little[..little.len() - 1]),
        "face 0: 3 values of list vertex_index need 6 bytes, but 5 are left in the file"
    );
    assert_eq!(
        mesh_fault(Ply, [&little[..], b"\n"].concat()),
        "the file: 1 bytes follow after the last element that the header announces; nothing may follow"
    );
    let nan = [&little[..little.len() - 10 - 23], &f64::NAN.to_le_bytes(), &little[little.len() - 10 - 15..]].concat();
    assert_eq!(mesh_fault(Ply, nan), "vertex 2: x is NaN; it must be finite");
}

#[test]
fn a_lying_header_takes_no_memory() {
    for (element, property, format) in [
        ("vertex", "float x\nproperty float y\nproperty float z", "binary_little_endian"),
        ("vertex", "float x\nproperty float y\nproperty float z", "ascii"),
        ("other", "list uchar int numbers", "binary_big_endian"),
    ] {
        let count = 4_000_000_000_u64;
        let rest = if element == "vertex" {
            ""
        } else {
            "element vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
        };
        let file = format!(
            "ply\nformat {format} 1.0\nelement {element} {count}\nproperty {property}\n{rest}\
             element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n"
        );
        let message = mesh_fault(Ply, file);
        assert!(message.starts_with(&format!("header: 4000000000 rows of element {element} need ")), "{message}");
        assert!(message.ends_with(" bytes, but 6 are left in the file"), "{message}");
    }
}

#[test]
fn mistakes_of_headers_are_named() {
    let with = |from: &str, to: &str| mesh_fault(Ply, ASCII.replacen(from, to, 1));
    assert_eq!(
        with("ascii", "text"),
        "line 2: the format is ‘text’; allowed: ascii, binary_little_endian and binary_big_endian"
    );
    assert_eq!(
        with("format ascii 1.0\n", ""),
        "line 14: the line ‘format … 1.0’ is missing; it says how numbers are written"
    );
    assert_eq!(with("vertex 5", "vertex -5"), "line 4: the number of elements is ‘-5’; 0 or more is needed");
    assert_eq!(with("vertex 5", "vertex many"), "line 4: the number of elements is ‘many’; a whole number is needed");
    assert_eq!(
        with("uchar red", "byte red"),
        "line 5: the kind of a property is ‘byte’; allowed: char, uchar, short, ushort, int, uint, float, double (or int8 to \
         float64)"
    );
    assert_eq!(
        with("property float x\n", ""),
        "header: property x of element vertex is missing; it must be a single number"
    );
    assert_eq!(
        with("property float x\n", "property float x\nproperty float nx\n"),
        "header: property ny of element vertex is missing; it must be a single number"
    );
    assert_eq!(with("float x", "float z"), "line 7: a property that is there twice is ‘z’; allowed: each name once");
    assert_eq!(
        with("element edge 1", "element face 1"),
        "line 12: an element that is there twice is ‘face’; allowed: each name once"
    );
    assert_eq!(
        with("vertex_indices", "indices"),
        "header: property vertex_indices of element face is missing; a list of whole numbers, the indices of its corners"
    );
    assert_eq!(
        with("element face 2", "element faces 2"),
        "header: element face is missing; without faces there is no surface (points with a radius can be spheres)"
    );
    assert_eq!(
        with("list uchar int", "list float int"),
        "line 11: the kind of a list's length is ‘float’; allowed: whole numbers"
    );
    assert_eq!(mesh_fault(Ply, &ASCII[..60]), "header: the line ‘end_header’ is missing; it ends the header");
}

#[test]
fn mistakes_of_rows_are_named_with_their_line() {
    let with = |from: &str, to: &str| mesh_fault(Ply, ASCII.replacen(from, to, 1));
    assert_eq!(with("255 0 1 1", "255 0 1"), "line 18: the row, by its numbers, has 3; property y is missing");
    assert_eq!(with("255 0 1 1", "255 0 1 1 1"), "line 18: the row, by its numbers, has 5; its properties take 4");
    assert_eq!(with("255 0 1 1", "255 0 inf 1"), "line 18: x is inf; it must be finite");
    assert_eq!(with("255 0 1 1", "255 0 - 1"), "line 18: x is ‘-’; a number is needed");
    assert_eq!(with("7 4 0 1 2 3", "7 4 0 1 2 5"), "line 22: a vertex index is 5; allowed are 0 to 4");
    assert_eq!(with("7 4 0 1 2 3", "7 4 0 1 2 -1"), "line 22: a vertex index is -1; allowed are 0 to 4");
    assert_eq!(
        with("7 4 0 1 2 3", "7 4 0 1 2 4294967296"),
        "line 22: vertex_indices is ‘4294967296’; a whole number of 32 bits is needed"
    );
    assert_eq!(with("7 4 0 1 2 3", "7 2 0 1"), "line 22: the face has 2; at least 3 corners are needed");
    assert_eq!(
        with("7 4 0 1 2 3", "7 -4 0 1 2 3"),
        "line 22: the length of list vertex_indices is ‘-4’; 0 or more is needed"
    );
    assert_eq!(
        with("\n0 1\n", "\n0 1\n2 3\n"),
        "the file: 3 bytes follow after the last element that the header announces; nothing may follow"
    );
    let none = "header: 1 rows of element edge need 3 bytes, but 0 are left in the file";
    assert_eq!(with("\n0 1\n", "\n"), none);
    assert_eq!(with("\n0 1\n", "\n\n\n\n"), "line 26: element edge has 0; the header announces 1 rows");
}

/// Each name is compared with all others: without a bound, a long header would take for ever.
#[test]
fn a_header_has_a_bounded_number_of_elements_and_properties() {
    let header = |lines: Vec<String>| format!("ply\nformat ascii 1.0\n{}\nend_header\n", lines.join("\n"));
    let elements = (0..101).map(|number| format!("element e{number} 0")).collect();
    let fault = mesh_fault(Ply, header(elements));
    assert_eq!(fault, "line 103: there are more than 100 elements in the header");
    let properties = (0..1001).map(|number| format!("property float p{number}"));
    let lines = ["element vertex 0".to_owned()].into_iter().chain(properties).collect();
    let fault = mesh_fault(Ply, header(lines));
    assert_eq!(fault, "line 1004: there are more than 1000 properties of one element");
}
