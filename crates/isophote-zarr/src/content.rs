//! Which pixels of a shard see anything: most images are mostly empty, and what is empty costs nothing.

use std::ops::Range;

use isophote::map::Map;

/// A row's pixels from the first that sees a surface to the last.
pub struct Span {
    /// Row of the map, from 0.
    pub row: usize,
    /// Columns of the map, from 0.
    pub columns: Range<usize>,
}

/// The spans of all rows that see anything.
pub fn spans(map: &Map) -> Vec<Span> {
    let is_seen = |shape: &i32| *shape >= 0;
    let rows = map.shapes().chunks_exact(map.region.size.width as usize).enumerate();
    rows.filter_map(|(row, shapes)| {
        let first = shapes.iter().position(is_seen)?;
        let last = shapes.iter().rposition(is_seen)?;
        Some(Span { row, columns: first..last + 1 })
    })
    .collect()
}

impl Span {
    /// Where the span's pixels are in the values of the map's channels.
    pub fn indices(&self, map: &Map) -> Range<usize> {
        let start = self.row * map.region.size.width as usize;
        start + self.columns.start..start + self.columns.end
    }
}
