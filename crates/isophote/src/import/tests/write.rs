//! Small writers for every format, as input for the readers.

use std::fmt::Write as _;

/// A polygon mesh as stored in files; normals belong to vertices.
#[derive(Debug, Clone)]
pub struct Polygons {
    pub vertices: Vec<[f64; 3]>,
    pub normals: Option<Vec<[f64; 3]>>,
    pub faces: Vec<Vec<usize>>,
}

impl Polygons {
    /// The faces as fans of triangles.
    pub fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        self.faces.iter().flat_map(|face| face[1..].windows(2).map(|pair| [face[0], pair[0], pair[1]]))
    }
}

pub fn obj(mesh: &Polygons) -> Vec<u8> {
    let mut text = String::new();
    for [x, y, z] in &mesh.vertices {
        writeln!(text, "v {x} {y} {z}").unwrap();
    }
    for [x, y, z] in mesh.normals.iter().flatten() {
        writeln!(text, "vn {x:e} {y} {z}").unwrap();
    }
    for face in &mesh.faces {
        text.push('f');
        for corner in face {
            let corner = corner + 1;
            match mesh.normals {
                Some(_) => write!(text, " {corner}//{corner}").unwrap(),
                None => write!(text, " {corner}").unwrap(),
            }
        }
        text.push('\n');
    }
    text.into_bytes()
}

fn ply_header(mesh: &Polygons, format: &str) -> String {
    let normals =
        if mesh.normals.is_some() { "property double nx\nproperty double ny\nproperty double nz\n" } else { "" };
    format!(
        "ply\nformat {format} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n{normals}\
         element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        mesh.vertices.len(),
        mesh.faces.len()
    )
}

/// The numbers of each vertex.
fn vertex_rows(mesh: &Polygons) -> impl Iterator<Item = Vec<f64>> + '_ {
    mesh.vertices.iter().enumerate().map(|(index, position)| match &mesh.normals {
        Some(normals) => [*position, normals[index]].concat(),
        None => position.to_vec(),
    })
}

pub fn ascii_ply(mesh: &Polygons) -> Vec<u8> {
    let mut text = ply_header(mesh, "ascii");
    for row in vertex_rows(mesh) {
        let numbers: Vec<String> = row.iter().map(f64::to_string).collect();
        writeln!(text, "{}", numbers.join(" ")).unwrap();
    }
    for face in &mesh.faces {
        let indices: Vec<String> = face.iter().map(usize::to_string).collect();
        writeln!(text, "{} {}", face.len(), indices.join(" ")).unwrap();
    }
    text.into_bytes()
}

pub fn binary_ply(mesh: &Polygons, is_big: bool) -> Vec<u8> {
    let mut bytes = ply_header(mesh, if is_big { "binary_big_endian" } else { "binary_little_endian" }).into_bytes();
    for number in vertex_rows(mesh).flatten() {
        bytes.extend(if is_big { number.to_be_bytes() } else { number.to_le_bytes() });
    }
    for face in &mesh.faces {
        bytes.push(u8::try_from(face.len()).unwrap());
        for index in face {
            let index = u32::try_from(*index).unwrap();
            bytes.extend(if is_big { index.to_be_bytes() } else { index.to_le_bytes() });
        }
    }
    bytes
}

pub fn ascii_stl(triangles: &[[[f64; 3]; 3]]) -> Vec<u8> {
    let mut text = String::from("solid\n");
    for triangle in triangles {
        text.push_str("facet normal 0 0 0\nouter loop\n");
        for [x, y, z] in triangle {
            writeln!(text, "vertex {x} {y} {z}").unwrap();
        }
        text.push_str("endloop\nendfacet\n");
    }
    text.push_str("endsolid\n");
    text.into_bytes()
}

pub fn binary_stl(header: &[u8], triangles: &[[[f64; 3]; 3]]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, 0);
    bytes.extend(u32::try_from(triangles.len()).unwrap().to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(single(triangle));
        bytes.extend([0; 2]);
    }
    bytes
}

/// Little-endian bytes of single precision.
pub fn single(vectors: &[[f64; 3]]) -> Vec<u8> {
    vectors.as_flattened().iter().flat_map(|number| rounded(*number).to_le_bytes()).collect()
}

#[expect(clippy::cast_possible_truncation, reason = "what a file of single precision holds")]
pub fn rounded(number: f64) -> f32 {
    number as f32
}

/// A document and the binary chunk, one after the other.
pub fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let chunk = |kind: &[u8; 4], bytes: &[u8], padding: u8| {
        let mut bytes = bytes.to_vec();
        bytes.resize(bytes.len().next_multiple_of(4), padding);
        [&u32::try_from(bytes.len()).unwrap().to_le_bytes()[..], kind, &bytes].concat()
    };
    let chunks = [chunk(b"JSON", json.as_bytes(), b' '), chunk(b"BIN\0", binary, 0)].concat();
    let length = u32::try_from(12 + chunks.len()).unwrap();
    [&b"glTF\x02\0\0\0"[..], &length.to_le_bytes(), &chunks].concat()
}

/// One node with one primitive; numbers in single precision.
pub fn glb_of(mesh: &Polygons) -> Vec<u8> {
    let indices: Vec<u8> =
        mesh.triangles().flatten().flat_map(|index| u32::try_from(index).unwrap().to_le_bytes()).collect();
    let positions = single(&mesh.vertices);
    let normals = mesh.normals.as_deref().map(single).unwrap_or_default();
    let (count, size, corners) = (mesh.vertices.len(), positions.len(), indices.len() / 4);
    let normal = if mesh.normals.is_some() { r#", "NORMAL": 1"# } else { "" };
    let json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0{normal}}}, "indices": 2}}]}}],
        "accessors": [
            {{"bufferView": 0, "componentType": 5126, "count": {count}, "type": "VEC3"}},
            {{"bufferView": 1, "componentType": 5126, "count": {count}, "type": "VEC3"}},
            {{"bufferView": 2, "componentType": 5125, "count": {corners}, "type": "SCALAR"}}],
        "bufferViews": [
            {{"buffer": 0, "byteLength": {size}}},
            {{"buffer": 0, "byteOffset": {size}, "byteLength": {}}},
            {{"buffer": 0, "byteOffset": {}, "byteLength": {}}}],
        "buffers": [{{"byteLength": {}}}]}}"#,
        normals.len(),
        size + normals.len(),
        indices.len(),
        size + normals.len() + indices.len()
    );
    glb(&json, &[positions, normals, indices].concat())
}
