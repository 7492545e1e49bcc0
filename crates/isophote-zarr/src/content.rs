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
    let width = map.region.size.width as usize;
    let mut spans: Vec<Span> = Vec::new();
    for run in map.mask().runs() {
        let (row, start) = (run.start / width, run.start % width);
        let end = start + (run.end - run.start);
        match spans.last_mut() {
            Some(span) if span.row == row => span.columns.end = end,
            _ => spans.push(Span { row, columns: start..end }),
        }
    }
    spans
}

impl Span {
    /// Where the span's pixels are in the values of the map's channels.
    pub fn indices(&self, map: &Map) -> Range<usize> {
        let start = self.row * map.region.size.width as usize;
        start + self.columns.start..start + self.columns.end
    }
}
