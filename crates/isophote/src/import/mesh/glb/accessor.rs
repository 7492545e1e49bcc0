//! Numbers in glTF buffers: an accessor of a view of a buffer, each within the bounds of the one before.

use super::{
    document::{Accessor, Document},
    follow,
};
use crate::import::{
    Fault, FilePosition, FileProblem,
    text::{finite, shown},
};
use crate::message;
use crate::text::Message;

/// The document with its binary chunk.
pub(super) struct Buffers<'a> {
    pub document: &'a Document,
    pub binary: &'a [u8],
}

impl Buffers<'_> {
    /// Positions or normals: three numbers of single precision each, all finite.
    pub fn vectors(&self, index: usize) -> Result<Vec<[f64; 3]>, Fault> {
        let (accessor, place) = self.accessor(index)?;
        let at = |problem: FileProblem| problem.at(FilePosition::Json(place.clone()));
        check_kind(accessor, "VEC3", &[FLOAT]).map_err(at)?;
        let rows = self.rows(accessor, 12, &place)?;
        let mut vectors = Vec::with_capacity(rows.len());
        for (number, row) in rows.enumerate() {
            let component = |first: usize, field| {
                let bytes = row[first..first + 4].try_into().expect("four bytes");
                let value = finite(f32::from_le_bytes(bytes).into(), field);
                value.map_err(|problem| {
                    problem.at(FilePosition::Json(message!("{place}, vector {number}", place, number)))
                })
            };
            vectors.push([component(0, "x")?, component(4, "y")?, component(8, "z")?]);
        }
        Ok(vectors)
    }

    /// Indices into that many vertices.
    pub fn indices(&self, index: usize, vertices: usize) -> Result<Vec<usize>, Fault> {
        let (accessor, place) = self.accessor(index)?;
        let allowed = [UNSIGNED_BYTE, UNSIGNED_SHORT, UNSIGNED_INT];
        check_kind(accessor, "SCALAR", &allowed).map_err(|problem| problem.at(FilePosition::Json(place.clone())))?;
        let size = match accessor.component_type {
            UNSIGNED_BYTE => 1,
            UNSIGNED_SHORT => 2,
            _ => 4,
        };
        let rows = self.rows(accessor, size, &place)?;
        let mut indices = Vec::with_capacity(rows.len());
        for (number, row) in rows.enumerate() {
            let index = row.iter().rev().fold(0_u32, |index, byte| (index << 8) | u32::from(*byte));
            if index as usize >= vertices {
                let (field, index, count) = (message!("a vertex index"), index.into(), vertices as u64);
                let place = FilePosition::Json(message!("{place}, number {number}", place, number));
                return Err(FileProblem::Index { field, index, first: 0, count, backwards: 0 }.at(place));
            }
            indices.push(index as usize);
        }
        Ok(indices)
    }

    fn accessor(&self, index: usize) -> Result<(&Accessor, Message), Fault> {
        let place = Message::verbatim(format!("accessors[{index}]"));
        Ok((follow(&self.document.accessors, index, &message!("a primitive"), || message!("an accessor"))?, place))
    }

    /// The bytes of each element of an accessor.
    fn rows(
        &self,
        accessor: &Accessor,
        size: usize,
        place: &Message,
    ) -> Result<impl ExactSizeIterator<Item = &[u8]>, Fault> {
        let at = |problem: FileProblem| problem.at(FilePosition::Json(place.clone()));
        let Some(view) = accessor.buffer_view.filter(|_| accessor.sparse.is_none()) else {
            let (what, instead) = (message!("sparse numbers"), message!("export without sparse accessors"));
            return Err(at(FileProblem::Unsupported { what, instead }));
        };
        let view = follow(&self.document.buffer_views, view, place, || Message::verbatim("bufferView"))?;
        let buffer = follow(&self.document.buffers, view.buffer, place, || Message::verbatim("buffer"))?;
        if view.buffer != 0 || buffer.uri.is_some() {
            let (what, instead) = (message!("a buffer outside of the file"), message!("export all into one .glb"));
            return Err(at(FileProblem::Unsupported { what, instead }));
        }
        let buffer = within(self.binary, 0, buffer.byte_length.into(), || message!("the buffer")).map_err(at)?;
        let view_bytes =
            within(buffer, view.byte_offset, view.byte_length.into(), || message!("the view")).map_err(at)?;
        let stride = view.byte_stride.unwrap_or(size as u64);
        let allowed = size as u64..=252;
        if !allowed.contains(&stride) {
            let (what, allowed) =
                (Message::verbatim("byteStride"), message!("{least} to {most}", least = size, most = 252));
            return Err(at(FileProblem::Unexpected { what, found: stride.to_string(), allowed }));
        }
        // No gap is needed after the last element.
        let needed = match accessor.count {
            0 => 0,
            count => u128::from(count - 1) * u128::from(stride) + size as u128,
        };
        let bytes =
            within(view_bytes, accessor.byte_offset, needed, || message!("the accessor's elements")).map_err(at)?;
        let stride = usize::try_from(stride).expect("at most 252");
        Ok(bytes.chunks(stride).map(move |row| &row[..size]))
    }
}

const UNSIGNED_BYTE: u64 = 5121;
const UNSIGNED_SHORT: u64 = 5123;
const UNSIGNED_INT: u64 = 5125;
const FLOAT: u64 = 5126;

fn check_kind(accessor: &Accessor, kind: &str, components: &[u64]) -> Result<(), FileProblem> {
    if accessor.kind == kind && components.contains(&accessor.component_type) {
        return Ok(());
    }
    let components: Vec<String> = components.iter().map(u64::to_string).collect();
    Err(FileProblem::Unexpected {
        what: message!("the kind of its elements"),
        found: format!("{} of {}", shown(accessor.kind.as_bytes()), accessor.component_type),
        allowed: message!("{kind} of component type {components}", kind, components = components.join(", ")),
    })
}

fn within(bytes: &[u8], offset: u64, length: u128, what: fn() -> Message) -> Result<&[u8], FileProblem> {
    let left = (bytes.len() as u64).saturating_sub(offset);
    let start = usize::try_from(offset).ok().filter(|start| *start <= bytes.len());
    let end = start.and_then(|start| start.checked_add(usize::try_from(length).ok()?));
    let found = start.zip(end).and_then(|(start, end)| bytes.get(start..end));
    found.ok_or_else(|| FileProblem::Truncated { what: what(), needed: length, left })
}
