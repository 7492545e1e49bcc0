use super::{
    O, X, Y, Z, corners, mesh_fault, normals,
    write::{glb, single},
};
use crate::import::{MeshFormat::Glb, mesh_from_bytes};

/// The unit triangle O, X, Y with normals along z, with its corners once as bytes; and a fourth vertex Z.
fn binary() -> Vec<u8> {
    [single(&[O, X, Y, Z]), single(&[Z, Z, Z, [0.0, 1.0, 1.0]]), vec![0, 1, 2, 3]].concat()
}

const MESHES: &str = r#"[{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2}]}]"#;
const ACCESSORS: &str = r#"[
    {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
    {"bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 4, "type": "VEC3"},
    {"bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR"}]"#;
const VIEWS: &str =
    r#"[{"buffer": 0, "byteLength": 96, "byteStride": 12}, {"buffer": 0, "byteOffset": 96, "byteLength": 4}]"#;
const BUFFERS: &str = r#"[{"byteLength": 100}]"#;
const SCENES: &str = r#"[{"nodes": [0]}]"#;

fn document(nodes: &str, meshes: &str, more: &str) -> String {
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": {SCENES}, "nodes": {nodes}, "meshes": {meshes},
        "accessors": {ACCESSORS}, "bufferViews": {VIEWS}, "buffers": {BUFFERS}{more}}}"#
    )
}

const NODE: &str = r#"[{"mesh": 0}]"#;

#[test]
fn nodes_are_placed_with_all_their_parents() {
    let nodes = r#"[{"children": [2, 1], "translation": [0.1, 0, 0], "scale": [1, 2, 4]},
        {"mesh": 0, "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476]},
        {"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]},
        {"mesh": 0}]"#;
    let mesh = mesh_from_bytes(&glb(&document(nodes, MESHES, ""), &binary()), Glb).unwrap();
    let [first, second] = corners(&mesh)[..] else { panic!("the last node is not in the scene") };
    assert_eq!(first, [[0.1, 0.0, 20.0], [1.1, 0.0, 20.0], [0.1, 2.0, 20.0]]);
    // A quarter turn about z takes X to Y and Y to −X; then the scale applies.
    let expected = [[0.1, 0.0, 0.0], [0.1, 2.0, 0.0], [-0.9, 0.0, 0.0]];
    for (found, expected) in second.as_flattened().iter().zip(expected.as_flattened()) {
        assert!((found - expected).abs() < 1e-15);
    }
}

#[test]
fn normals_follow_the_inverse_transpose_and_mirrors_turn_corners_round() {
    let meshes = r#"[{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "mode": 5}]}]"#;
    let nodes = r#"[{"mesh": 0, "scale": [1, -2, 4]}]"#;
    let mesh = mesh_from_bytes(&glb(&document(nodes, meshes, ""), &binary()), Glb).unwrap();
    let (x, y, z) = (X, [0.0, -2.0, 0.0], [0.0, 0.0, 4.0]);
    // Without the mirror they are O, X, Y and X, Z, Y.
    assert_eq!(corners(&mesh), [[O, y, x], [x, y, z]]);
    let length = (0.25_f64 + 0.0625).sqrt();
    let [_, last] = normals(&mesh)[..] else { panic!("two triangles") };
    // (0, 1, 1) becomes (0, 1/−2, 1/4), up to a factor.
    let found = last.iter().find(|normal| normal[1] != 0.0).unwrap();
    assert!((found[1] + 0.5 / length).abs() < 1e-15 && (found[2] - 0.25 / length).abs() < 1e-15);
}

#[test]
fn every_mode_makes_its_triangles() {
    let with = |mode: u32| {
        let meshes = format!(r#"[{{"primitives": [{{"attributes": {{"POSITION": 0}}, "mode": {mode}}}]}}]"#);
        mesh_from_bytes(&glb(&document(NODE, &meshes, ""), &binary()), Glb)
    };
    assert_eq!(corners(&with(5).unwrap()), [[O, X, Y], [X, Z, Y]]);
    assert_eq!(corners(&with(6).unwrap()), [[O, X, Y], [O, Y, Z]]);
    assert_eq!(
        with(4).unwrap_err().to_string(),
        "meshes[0].primitives[0]: the list of corners has 4; a multiple of 3 is needed"
    );
    assert_eq!(with(1).unwrap_err().to_string(), "the file: it has no triangles with an area (0 without)");
    assert_eq!(with(7).unwrap_err().to_string(), "meshes[0].primitives[0]: mode is ‘7’; allowed: 0 to 6");
}

#[test]
fn materials_are_slots_by_name() {
    let primitive = r#"{"attributes": {"POSITION": 0}, "indices": 2"#;
    let meshes = format!(
        r#"[{{"primitives": [{primitive}, "material": 1}}, {primitive}, "material": 0}}, {primitive}}}, {primitive}, "material": 1}}]}}]"#
    );
    let document = document(NODE, &meshes, r#", "materials": [{"name": "red"}, {}]"#);
    let materials = mesh_from_bytes(&glb(&document, &binary()), Glb).unwrap().materials.unwrap();
    assert_eq!(materials.names, [Some("material 1".to_owned()), Some("red".to_owned()), None]);
    assert_eq!(materials.slots, [0, 1, 2, 0]);
}

#[test]
fn mistakes_of_the_container_are_named() {
    let good = glb(&document(NODE, MESHES, ""), &binary());
    let length = good.len();
    mesh_from_bytes(&good, Glb).unwrap();
    let with = |at: usize, bytes: &[u8]| {
        let mut file = good.clone();
        file[at..at + bytes.len()].copy_from_slice(bytes);
        mesh_fault(Glb, file)
    };
    assert_eq!(with(4, &[1]), "header: the version of glTF is ‘1’; allowed: 2");
    let message = format!("header: the announced contents need 4294967295 bytes, but {length} are left in the file");
    assert_eq!(with(8, &[255; 4]), message);
    let message = format!("header: the file with its chunk need 4294967315 bytes, but {length} are left in the file");
    assert_eq!(with(12, &[255; 4]), message);
    assert_eq!(with(16, b"json"), "header: the JSON chunk is missing; it describes the scene");
    assert_eq!(mesh_fault(Glb, &good[..8]), "header: magic, version, length need 12 bytes, but 8 are left in the file");
    let message = format!("header: 4 bytes follow after {length} announced bytes; nothing may follow");
    assert_eq!(mesh_fault(Glb, [&good[..], &[0; 4]].concat()), message);
    assert_eq!(
        mesh_fault(Glb, glb("{]", &[])),
        "JSON: the JSON chunk is ‘key must be a string at line 1 column 2’; allowed: a document of glTF 2.0"
    );
}

#[test]
fn mistakes_of_the_document_are_named() {
    let good = document(NODE, MESHES, "");
    let with = |from: &str, to: &str| {
        assert!(good.contains(from), "{from}");
        mesh_fault(Glb, glb(&good.replacen(from, to, 1), &binary()))
    };
    assert_eq!(with(r#""scene": 0"#, r#""scene": 3"#), "document: scene is 3; allowed are 0 to 0");
    assert_eq!(with(r#"{"nodes": [0]}"#, r#"{"nodes": [1]}"#), "a scene or node: a node is 1; allowed are 0 to 0");
    assert_eq!(with(r#"{"mesh": 0}"#, r#"{"mesh": 2}"#), "nodes[0]: mesh is 2; allowed are 0 to 0");
    let parents = "nodes[0]: the node's parents is ‘two’; allowed: one parent, and no circle";
    assert_eq!(with(r#"{"mesh": 0}"#, r#"{"mesh": 0, "children": [0]}"#), parents);
    assert_eq!(
        with(r#"{"mesh": 0}"#, r#"{"mesh": 0, "scale": [1, 0, 1]}"#),
        "nodes[0]: the determinant of its transform is ‘0’; allowed: a finite number other than 0"
    );
    assert_eq!(
        with(r#"{"mesh": 0}"#, r#"{"mesh": 0, "rotation": [1, 1, 1, 1]}"#),
        "nodes[0]: the length of the rotation is ‘2’; allowed: 1"
    );
    assert_eq!(
        with(r#"{"mesh": 0}"#, r#"{"mesh": 0, "skin": 0}"#),
        "nodes[0]: a skin cannot be read here; apply the pose before the export"
    );
    assert_eq!(
        with(r#""asset""#, r#""extensionsRequired": ["KHR_materials_unlit", "KHR_draco_mesh_compression"], "asset""#),
        "extensionsRequired: extension KHR_draco_mesh_compression cannot be read here; export without compression or \
         quantization"
    );
    assert_eq!(with(r#""POSITION": 0"#, r#""POSITION": 9"#), "a primitive: an accessor is 9; allowed are 0 to 2");
    assert_eq!(
        with(r#""POSITION": 0, "#, ""),
        "meshes[0].primitives[0]: POSITION is missing; a surface needs vertices"
    );
    assert_eq!(with(r#""count": 4"#, r#""count": 3"#), "meshes[0].primitives[0]: NORMAL has 4; POSITION has 3");
    assert_eq!(
        with(
            r#""bufferView": 0, "componentType": 5126, "count": 4"#,
            r#""bufferView": 0, "componentType": 5126, "count": 4000000000"#
        ),
        "accessors[0]: the accessor's elements need 48000000000 bytes, but 96 are left in the file"
    );
    assert_eq!(
        with(r#""byteLength": 100"#, r#""byteLength": 100, "uri": "mesh.bin""#),
        "accessors[0]: a buffer outside of the file cannot be read here; export all into one .glb"
    );
    assert_eq!(
        with(r#""byteStride": 12"#, r#""byteStride": 0"#),
        "accessors[0]: byteStride is ‘0’; allowed: 12 to 252"
    );
    assert_eq!(
        with("VEC3", "VEC2"),
        "accessors[0]: the kind of its elements is ‘VEC2 of 5126’; allowed: VEC3 of component type 5126"
    );
    assert_eq!(
        with(r#""bufferView": 0, "#, r#""sparse": {}, "#),
        "accessors[0]: sparse numbers cannot be read here; export without sparse accessors"
    );
    let mut nan = binary();
    nan[16..20].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(mesh_fault(Glb, glb(&good, &nan)), "accessors[0], vector 1: y is NaN; it must be finite");
    let mut index = binary();
    index[97] = 4;
    assert_eq!(mesh_fault(Glb, glb(&good, &index)), "accessors[2], number 1: a vertex index is 4; allowed are 0 to 3");
}

#[test]
fn a_mesh_repeated_without_end_is_refused() {
    // A thousand nodes with a thousand primitives, each with a million corners.
    let primitive = r#"{"attributes": {"POSITION": 0}, "indices": 1}"#;
    let json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [{}]}}], "nodes": [{}],
        "meshes": [{{"primitives": [{}]}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}},
        {{"bufferView": 0, "byteOffset": 36, "componentType": 5121, "count": 3000000, "type": "SCALAR"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 3000036}}], "buffers": [{{"byteLength": 3000036}}]}}"#,
        (0..1000).map(|i| i.to_string()).collect::<Vec<_>>().join(","),
        vec![r#"{"mesh": 0}"#; 1000].join(","),
        vec![primitive; 1000].join(","),
    );
    assert_eq!(
        mesh_fault(Glb, glb(&json, &vec![0; 3_000_036])),
        "nodes[0]: there are more than 10000000 corners, with all repetitions"
    );
}
