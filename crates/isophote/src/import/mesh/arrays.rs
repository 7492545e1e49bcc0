//! Meshes that are given as arrays instead of in a file.

use super::{MeshBuilder, NO_NORMALS, TriangleMesh};
use crate::import::{Fault, FilePosition, FileProblem};
use crate::text::Message;

/// The mesh of these vertices, and of the three corners of each triangle.
pub(in crate::import) fn read(
    vertices: &[[f64; 3]],
    faces: &[[u64; 3]],
    normals: Option<&[[f64; 3]]>,
) -> Result<TriangleMesh, Fault> {
    let mut builder = MeshBuilder::default();
    let at = |number: u64| move |problem: FileProblem| problem.at(FilePosition::Element { kind: "face", number });
    let material = builder.materials.slot(None).map_err(at(0))?;
    for (number, face) in (0..).zip(faces) {
        let [a, b, c] = face.map(|index| place(index, vertices.len()));
        let corners = [a.map_err(at(number))?, b.map_err(at(number))?, c.map_err(at(number))?];
        let directions = match normals {
            None => NO_NORMALS,
            Some(normals) => Some(corners.map(|index| (normals[index], index as u64))),
        };
        builder.triangle(corners.map(|index| vertices[index]), directions, material).map_err(at(number))?;
    }
    builder.finish()
}

fn place(index: u64, count: usize) -> Result<usize, FileProblem> {
    usize::try_from(index).ok().filter(|index| *index < count).ok_or_else(|| FileProblem::Index {
        field: Message::verbatim("vertices"),
        index: i64::try_from(index).unwrap_or(i64::MAX),
        first: 0,
        count: count as u64,
        backwards: 0,
    })
}
