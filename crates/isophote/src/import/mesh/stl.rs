//! Stereolithography, ASCII and binary. Each triangle has its own corners; equal ones become one vertex.
//!
//! The facets' normals are not read: they only repeat what the order of the corners says, and many programs leave them zero.

use super::{MeshBuilder, NO_NORMALS, TriangleMesh};
use crate::import::{
    Fault, FilePosition, FileProblem,
    format::is_binary_stl,
    text::{finite, finite_number, lines, shown, words},
};
use crate::message;
use crate::text::Message;

/// The mesh of an STL file.
pub(in crate::import) fn read(bytes: &[u8]) -> Result<TriangleMesh, Fault> {
    // The headers of many binary files also start with `solid`; the file size and zero bytes tell them apart.
    let is_ascii = bytes.trim_ascii_start().starts_with(b"solid") && !bytes[..bytes.len().min(1024)].contains(&0);
    if is_binary_stl(bytes) || !is_ascii { read_binary(bytes) } else { read_ascii(bytes) }
}

fn read_binary(bytes: &[u8]) -> Result<TriangleMesh, Fault> {
    let total = bytes.len() as u64;
    let truncated =
        |what: Message, needed, left| FileProblem::Truncated { what, needed, left }.at(FilePosition::Header);
    let Some((header, body)) = bytes.split_at_checked(84) else {
        return Err(truncated(message!("the header and the number of triangles"), 84, total));
    };
    let count = u64::from(u32::from_le_bytes(header[80..].try_into().expect("four bytes")));
    let (needed, left) = (50 * count, total - 84);
    if needed > left {
        return Err(truncated(message!("{count} triangles", count), needed.into(), left));
    }
    if needed < left {
        return Err(FileProblem::Leftover { what: message!("{count} triangles", count), left: left - needed }
            .at(FilePosition::Header));
    }
    let mut builder = MeshBuilder::default();
    let material = builder.materials.slot(None).expect("one slot is always free");
    for (number, facet) in (0..).zip(body.as_chunks::<50>().0) {
        let corner = |first: usize| vertex(facet[first..first + 12].try_into().expect("twelve bytes"));
        let corners = [corner(12), corner(24), corner(36)];
        let at = |problem: FileProblem| problem.at(FilePosition::Element { kind: "triangle", number });
        let [a, b, c] = corners.map(|corner| corner.map_err(at));
        builder.triangle([a?, b?, c?], NO_NORMALS, material).map_err(at)?;
    }
    builder.finish()
}

fn vertex(bytes: &[u8; 12]) -> Result<[f64; 3], FileProblem> {
    let [x, y, z] = [0, 4, 8].map(|at| f32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes")));
    Ok([finite(x.into(), "x")?, finite(y.into(), "y")?, finite(z.into(), "z")?])
}

/// One or more solids. Line breaks have no meaning in this format, but all programs write them in the same places, so every
/// error can be reported with its line.
fn read_ascii(bytes: &[u8]) -> Result<TriangleMesh, Fault> {
    let mut reader = AsciiReader { builder: MeshBuilder::default(), expected: Expected::Solid, corners: Vec::new() };
    let mut last = 0;
    for (number, line) in lines(bytes) {
        reader.line(line).map_err(|problem| problem.at(FilePosition::Line(number)))?;
        last = number;
    }
    if reader.expected != Expected::Solid {
        let what = message!("‘{keywords}’", keywords = reader.expected.keywords());
        let needed = message!("the file ends within a solid");
        return Err(FileProblem::Missing { what, needed }.at(FilePosition::Line(last)));
    }
    reader.builder.finish()
}

struct AsciiReader {
    builder: MeshBuilder,
    expected: Expected,
    corners: Vec<[f64; 3]>,
}

/// What the next line must start with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Expected {
    Solid,
    FacetOrEnd,
    OuterLoop,
    Vertex,
    EndLoop,
    EndFacet,
}

impl Expected {
    fn keywords(self) -> Message {
        match self {
            Self::Solid => Message::verbatim("solid"),
            Self::FacetOrEnd => message!("facet normal, or endsolid"),
            Self::OuterLoop => Message::verbatim("outer loop"),
            Self::Vertex => Message::verbatim("vertex"),
            Self::EndLoop => Message::verbatim("endloop"),
            Self::EndFacet => Message::verbatim("endfacet"),
        }
    }
}

impl AsciiReader {
    fn line(&mut self, line: &[u8]) -> Result<(), FileProblem> {
        let mut parts = words(line);
        let Some(keyword) = parts.next() else { return Ok(()) };
        self.expected = match (self.expected, keyword.to_ascii_lowercase().as_slice()) {
            (Expected::Solid, b"solid") => Expected::FacetOrEnd,
            (Expected::FacetOrEnd, b"endsolid") => Expected::Solid,
            (Expected::FacetOrEnd, b"facet") => Expected::OuterLoop,
            (Expected::OuterLoop, b"outer") => Expected::Vertex,
            (Expected::Vertex, b"vertex") => {
                self.corners.push(position(parts)?);
                if self.corners.len() == 3 { Expected::EndLoop } else { Expected::Vertex }
            }
            (Expected::EndLoop, b"endloop") => Expected::EndFacet,
            (Expected::EndFacet, b"endfacet") => {
                let corners = self.corners.as_slice().try_into().expect("three were read");
                self.corners.clear();
                let material = self.builder.materials.slot(None)?;
                self.builder.triangle(corners, NO_NORMALS, material)?;
                Expected::FacetOrEnd
            }
            (expected, _) => {
                let (what, allowed) = (message!("the line's first word"), expected.keywords());
                return Err(FileProblem::Unexpected { what, found: shown(keyword), allowed });
            }
        };
        Ok(())
    }
}

fn position<'a>(mut parts: impl Iterator<Item = &'a [u8]>) -> Result<[f64; 3], FileProblem> {
    let (mut position, mut found) = ([0.0; 3], 0);
    for (component, field) in position.iter_mut().zip(["x", "y", "z"]) {
        let Some(word) = parts.next() else { break };
        *component = finite_number(word, field)?;
        found += 1;
    }
    found += parts.count() as u64;
    if found == 3 {
        return Ok(position);
    }
    Err(FileProblem::Parts {
        what: message!("the vertex"),
        found,
        allowed: message!("allowed are {counts} numbers", counts = 3),
    })
}
