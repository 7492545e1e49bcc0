//! Triangle meshes of PLY files: element `vertex` (`x`, `y`, `z`, optionally `nx`, `ny`, `nz`), element `face` with a list
//! `vertex_indices` or `vertex_index`. Polygons become fans of triangles around their first corner.

use super::{Header, Row, Rows};
use crate::import::{
    Fault, FilePosition, FileProblem, TriangleMesh,
    mesh::{MeshBuilder, NO_NORMALS},
    text::finite,
};
use crate::message;

/// The mesh of a PLY file.
pub(in crate::import) fn read(bytes: &[u8]) -> Result<TriangleMesh, Fault> {
    let (header, rest) = Header::split(bytes)?;
    let vertex = VertexLayout::of(&header).map_err(|problem| problem.at(FilePosition::Header))?;
    let indices = face_indices(&header).map_err(|problem| problem.at(FilePosition::Header))?;
    let mut rows = Rows::new(&header, rest);
    let mut vertices = Vertices::default();
    let mut faces = Faces::default();
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" => rows.read(element, None, |row| vertices.read(&vertex, &row))?,
            "face" => rows.read(element, Some(indices), |row| faces.read(&row, &vertices))?,
            _ => rows.read(element, None, |_| Ok(()))?,
        }
    }
    rows.finish()?;
    faces.builder.finish()
}

struct VertexLayout {
    position: [usize; 3],
    normal: Option<[usize; 3]>,
}

impl VertexLayout {
    fn of(header: &Header) -> Result<Self, FileProblem> {
        let element = header.element("vertex", || message!("x, y and z stand there"))?;
        let position = element.values(["x", "y", "z"])?;
        let has_normal = ["nx", "ny", "nz"].iter().any(|name| element.property(&[name]).is_some());
        let normal = has_normal.then(|| element.values(["nx", "ny", "nz"])).transpose()?;
        Ok(Self { position, normal })
    }
}

/// The property of the faces that holds the indices of their corners.
fn face_indices(header: &Header) -> Result<usize, FileProblem> {
    let face = header
        .element("face", || message!("without faces there is no surface (points with a radius can be spheres)"))?;
    let needed = || message!("a list of whole numbers, the indices of its corners");
    let missing = || FileProblem::Missing {
        what: message!("property {name} of element {element}", name = "vertex_indices", element = "face"),
        needed: needed(),
    };
    let index = face.property(&["vertex_indices", "vertex_index"]).ok_or_else(missing)?;
    let property = &face.properties[index];
    if property.length.is_none() || !property.kind.is_integer() {
        return Err(missing());
    }
    let first = header.elements.iter().find(|element| matches!(element.name.as_str(), "vertex" | "face"));
    if first == Some(face) {
        return Err(FileProblem::Unsupported {
            what: message!("faces before vertices"),
            instead: message!("write vertices first"),
        });
    }
    Ok(index)
}

#[derive(Default)]
struct Vertices {
    positions: Vec<[f64; 3]>,
    normals: Vec<[f64; 3]>,
}

impl Vertices {
    fn read(&mut self, layout: &VertexLayout, row: &Row) -> Result<(), FileProblem> {
        let [x, y, z] = layout.position.map(|index| row.values[index]);
        self.positions.push([finite(x, "x")?, finite(y, "y")?, finite(z, "z")?]);
        if let Some(normal) = layout.normal {
            let [x, y, z] = normal.map(|index| row.values[index]);
            self.normals.push([finite(x, "nx")?, finite(y, "ny")?, finite(z, "nz")?]);
        }
        Ok(())
    }
}

#[derive(Default)]
struct Faces {
    corners: Vec<usize>,
    builder: MeshBuilder,
}

impl Faces {
    fn read(&mut self, row: &Row, vertices: &Vertices) -> Result<(), FileProblem> {
        self.corners.clear();
        for index in row.list {
            self.corners.push(vertex_index(*index, vertices.positions.len())?);
        }
        let [first, between @ ..] = self.corners.as_slice() else { return Err(too_few(0)) };
        if between.len() < 2 {
            return Err(too_few(1 + between.len()));
        }
        let material = self.builder.materials.slot(None)?;
        for pair in between.windows(2) {
            let triangle = [*first, pair[0], pair[1]];
            let normals = if vertices.normals.is_empty() {
                NO_NORMALS
            } else {
                Some(triangle.map(|index| (vertices.normals[index], index as u64)))
            };
            self.builder.triangle(triangle.map(|index| vertices.positions[index]), normals, material)?;
        }
        Ok(())
    }
}

fn too_few(found: usize) -> FileProblem {
    FileProblem::Parts {
        what: message!("the face"),
        found: found as u64,
        allowed: message!("at least 3 corners are needed"),
    }
}

fn vertex_index(index: f64, count: usize) -> Result<usize, FileProblem> {
    #[expect(clippy::cast_possible_truncation, reason = "it is a whole number of 32 bits")]
    let index = index as i64;
    let allowed = usize::try_from(index).ok().filter(|index| *index < count);
    allowed.ok_or_else(|| FileProblem::Index {
        field: message!("a vertex index"),
        index,
        first: 0,
        count: count as u64,
        backwards: 0,
    })
}
