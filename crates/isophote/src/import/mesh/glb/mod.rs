//! glTF 2.0 in one binary file: the triangles of a scene's nodes with the nodes' transforms applied, in glTF's axes (y up).
//!
//! The document is read into structures of our own, which hold what affects the shape: numbers stay doubles, and every
//! reference is checked where it is followed. Materials are names; unnamed ones are called `material N`.

mod accessor;
mod document;
mod transform;

use crate::message;
use crate::text::Message;
use document::{Document, Node, Primitive};
use transform::Transform;

use self::accessor::Buffers;
use super::{MeshBuilder, TriangleMesh};
use crate::import::{Fault, FilePosition, FileProblem};

/// The mesh of a glTF binary file.
pub(in crate::import) fn read(bytes: &[u8]) -> Result<TriangleMesh, Fault> {
    let (json, binary) = chunks(bytes).map_err(|problem| problem.at(FilePosition::Header))?;
    let document = Document::parse(json)?;
    document.check_supported()?;
    let buffers = Buffers { document: &document, binary };
    let nodes = document.placed_nodes()?;
    check_corners(&document, &nodes, binary.len() as u64)?;
    let mut reader = Reader { document: &document, buffers, builder: MeshBuilder::default() };
    for (index, transform) in nodes {
        reader.node(index, &transform)?;
    }
    reader.builder.finish()
}

/// The JSON and the binary chunk; other chunks are ignored.
fn chunks(bytes: &[u8]) -> Result<(&[u8], &[u8]), FileProblem> {
    let word = |at: usize| bytes.get(at..at + 4).map(|word| u32::from_le_bytes(word.try_into().expect("four bytes")));
    let left = bytes.len() as u64;
    let truncated = |what: Message, needed: u128| FileProblem::Truncated { what, needed, left };
    let (Some(version), Some(length)) = (word(4), word(8)) else {
        return Err(truncated(message!("magic, version, length"), 12));
    };
    if version != 2 {
        let (what, allowed) = (message!("the version of glTF"), Message::verbatim("2"));
        return Err(FileProblem::Unexpected { what, found: version.to_string(), allowed });
    }
    if u64::from(length) < left {
        return Err(FileProblem::Leftover {
            what: message!("{length} announced bytes", length),
            left: left - u64::from(length),
        });
    }
    let (mut json, mut binary) = (None, None);
    let mut at = 12;
    while at < bytes.len() {
        let (Some(length), Some(kind)) = (word(at), word(at + 4)) else {
            return Err(truncated(message!("length and kind of a chunk"), at as u128 + 8));
        };
        let end = at as u128 + 8 + u128::from(length);
        let chunk = usize::try_from(end).ok().and_then(|end| bytes.get(at + 8..end));
        let chunk = chunk.ok_or_else(|| truncated(message!("the file with its chunk"), end))?;
        match kind {
            JSON if json.is_none() => json = Some(chunk),
            BINARY if binary.is_none() => binary = Some(chunk),
            _ => {}
        }
        at += 8 + chunk.len();
    }
    if u64::from(length) > left {
        return Err(truncated(message!("the announced contents"), length.into()));
    }
    let json = json.ok_or_else(|| FileProblem::Missing {
        what: message!("the JSON chunk"),
        needed: message!("it describes the scene"),
    })?;
    Ok((json, binary.unwrap_or_default()))
}

const JSON: u32 = u32::from_le_bytes(*b"JSON");
const BINARY: u32 = u32::from_le_bytes(*b"BIN\0");

/// The maximum number of vertices and corners, including all repetitions, in a file that has fewer bytes of them: a node needs
/// only a few bytes of the file to repeat a whole mesh.
const MOST_CORNERS: u64 = 10_000_000;

fn check_corners(document: &Document, nodes: &[(usize, Transform)], bytes: u64) -> Result<(), Fault> {
    // Each takes at least a byte. Wrong accessors and indices out of range are found when they are read.
    let count = |accessor: Option<usize>| {
        let accessor = accessor.and_then(|accessor| document.accessors.get(accessor));
        accessor.map_or(0, |accessor| accessor.count.min(bytes))
    };
    let corners = |primitive: &Primitive| count(primitive.attributes.position) + count(primitive.indices);
    let of_meshes: Vec<u64> =
        document.meshes.iter().map(|mesh| mesh.primitives.iter().map(corners).fold(0, u64::saturating_add)).collect();
    let most = bytes.max(MOST_CORNERS);
    let mut all = 0_u64;
    for (index, _) in nodes {
        let mesh = document.nodes[*index].mesh.and_then(|mesh| of_meshes.get(mesh));
        all = all.saturating_add(mesh.copied().unwrap_or(0));
        if all > most {
            let problem = FileProblem::TooMany { what: message!("corners, with all repetitions"), most };
            return Err(problem.at(FilePosition::Json(Message::verbatim(format!("nodes[{index}]")))));
        }
    }
    Ok(())
}

struct Reader<'a> {
    document: &'a Document,
    buffers: Buffers<'a>,
    builder: MeshBuilder,
}

impl Reader<'_> {
    fn node(&mut self, index: usize, transform: &Transform) -> Result<(), Fault> {
        let Node { mesh: Some(mesh), .. } = &self.document.nodes[index] else { return Ok(()) };
        let place = Message::verbatim(format!("nodes[{index}]"));
        transform.check().map_err(|problem| problem.at(FilePosition::Json(place.clone())))?;
        let primitives = &follow(&self.document.meshes, *mesh, &place, || Message::verbatim("mesh"))?.primitives;
        for (number, primitive) in primitives.iter().enumerate() {
            self.primitive(primitive, transform, &Message::verbatim(format!("meshes[{mesh}].primitives[{number}]")))?;
        }
        Ok(())
    }

    fn primitive(&mut self, primitive: &Primitive, transform: &Transform, place: &Message) -> Result<(), Fault> {
        let at = |problem: FileProblem| problem.at(FilePosition::Json(place.clone()));
        let Some(mode) = Mode::of(primitive.mode).map_err(at)? else { return Ok(()) };
        let Some(position) = primitive.attributes.position else {
            return Err(at(FileProblem::Missing {
                what: Message::verbatim("POSITION"),
                needed: message!("a surface needs vertices"),
            }));
        };
        let positions = self.buffers.vectors(position)?;
        let normals = primitive.attributes.normal.map(|normal| self.buffers.vectors(normal)).transpose()?;
        if let Some(normals) = normals.as_ref().filter(|normals| normals.len() != positions.len()) {
            let allowed = message!("{other} has {count}", other = "POSITION", count = positions.len());
            return Err(at(FileProblem::Parts {
                what: Message::verbatim("NORMAL"),
                found: normals.len() as u64,
                allowed,
            }));
        }
        let indices = match primitive.indices {
            Some(indices) => self.buffers.indices(indices, positions.len())?,
            None => (0..positions.len()).collect(),
        };
        let positions = transform.points(&positions).map_err(at)?;
        let normals = normals.map(|normals| transform.normals(&normals));
        let name = primitive.material.map(|index| self.document.material_name(index, place)).transpose()?;
        let material = self.builder.materials.slot(name.as_deref()).map_err(at)?;
        for mut triangle in mode.triangles(&indices).map_err(at)? {
            if transform.is_mirror {
                triangle.swap(1, 2);
            }
            let normals = normals.as_ref().map(|normals| triangle.map(|index| (normals[index], index as u64)));
            self.builder.triangle(triangle.map(|index| positions[index]), normals, material).map_err(at)?;
        }
        Ok(())
    }
}

/// How indices form triangles.
#[derive(Debug, Clone, Copy)]
enum Mode {
    List,
    Strip,
    Fan,
}

impl Mode {
    /// `None` for points and lines, which have no surface.
    fn of(number: u64) -> Result<Option<Self>, FileProblem> {
        match number {
            0..=3 => Ok(None),
            4 => Ok(Some(Self::List)),
            5 => Ok(Some(Self::Strip)),
            6 => Ok(Some(Self::Fan)),
            _ => Err(FileProblem::Unexpected {
                what: Message::verbatim("mode"),
                found: number.to_string(),
                allowed: message!("{least} to {most}", least = 0, most = 6),
            }),
        }
    }

    fn triangles(self, indices: &[usize]) -> Result<Box<dyn Iterator<Item = [usize; 3]> + '_>, FileProblem> {
        let wrong = |allowed: Message| {
            let what = message!("the list of corners");
            Err(FileProblem::Parts { what, found: indices.len() as u64, allowed })
        };
        match self {
            Self::List if !indices.len().is_multiple_of(3) => wrong(message!("a multiple of 3 is needed")),
            Self::Strip | Self::Fan if indices.len() < 3 => wrong(message!("at least 3 are needed")),
            Self::List => Ok(Box::new(indices.as_chunks::<3>().0.iter().copied())),
            Self::Strip => Ok(Box::new(indices.windows(3).enumerate().map(|(number, corners)| match number % 2 {
                0 => [corners[0], corners[1], corners[2]],
                _ => [corners[0], corners[2], corners[1]],
            }))),
            Self::Fan => Ok(Box::new(indices[1..].windows(2).map(|pair| [indices[0], pair[0], pair[1]]))),
        }
    }
}

/// The element that a reference points to.
fn follow<'a, T>(elements: &'a [T], index: usize, place: &Message, field: fn() -> Message) -> Result<&'a T, Fault> {
    elements.get(index).ok_or_else(|| {
        let (index, count) = (i64::try_from(index).unwrap_or(i64::MAX), elements.len() as u64);
        FileProblem::Index { field: field(), index, first: 0, count, backwards: 0 }
            .at(FilePosition::Json(place.clone()))
    })
}
