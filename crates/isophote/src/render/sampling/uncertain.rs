//! Which pixels need more than the value at their centre.

use std::ops::Range;

use rayon::ThreadPool;
use rayon::prelude::*;

use crate::map::{Map, Quantity, Region, Scalars};

/// A pixel whose value is not that at its centre.
pub struct Uncertain {
    /// Index in the map.
    pub index: usize,
    /// By how much its neighbours differ from it: so much may be in a corner of it that the first samples miss.
    pub contrast: f64,
    /// Whether its centre sees a surface.
    pub sees: bool,
}

/// The uncertain pixels of a region: those where the brightness bends by more than the tolerance on one of the four lines
/// through the pixel and two of its neighbours, or differs by more from a neighbour that sees something else. A slope
/// alone needs nothing: its mean is the value at the centre. But across a limb it may be an accident.
pub fn pixels(map: &Map, region: Region, tolerance: f64, pool: Option<&ThreadPool>) -> Vec<Uncertain> {
    let Region { corner, size } = map.region;
    let columns = (region.corner.column - corner.column) as usize;
    let columns = columns..columns + region.size.width as usize;
    let rows = (region.corner.row - corner.row) as usize;
    let rows = rows..rows + region.size.height as usize;
    let view = View {
        brightness: map.scalar(&Quantity::Brightness).expect("it was asked for"),
        shapes: &map.mask().shapes(),
        width: size.width as usize,
        height: size.height as usize,
        tolerance,
    };
    let spans = spans(map);
    let of_row = |row: usize| {
        // Of the background only pixels beside something can be uncertain.
        let around = &spans[row.saturating_sub(1)..(row + 2).min(view.height)];
        let start = around.iter().map(|span| span.start).min().unwrap_or(0).saturating_sub(1);
        let end = around.iter().map(|span| span.end).max().unwrap_or(0) + 1;
        view.uncertain_in(row, start.max(columns.start)..end.min(columns.end))
    };
    match pool {
        Some(pool) => pool.install(|| rows.into_par_iter().with_min_len(16).flat_map_iter(of_row).collect()),
        None => rows.flat_map(of_row).collect(),
    }
}

/// From the first to the last pixel of each row that sees anything.
fn spans(map: &Map) -> Vec<Range<usize>> {
    let width = map.region.size.width as usize;
    let mut spans = vec![width..0; map.region.size.height as usize];
    for run in map.mask().runs() {
        let row = run.start / width;
        let span = &mut spans[row];
        *span = span.start.min(run.start - row * width)..span.end.max(run.end - row * width);
    }
    spans
}

struct View<'m> {
    brightness: Scalars<'m>,
    shapes: &'m [i32],
    width: usize,
    height: usize,
    tolerance: f64,
}

impl View<'_> {
    fn uncertain_in(&self, row: usize, columns: Range<usize>) -> Vec<Uncertain> {
        if columns.is_empty() {
            return Vec::new();
        }
        let mut suspects = vec![true; columns.len()];
        let inner = columns.start.max(1)..columns.end.min(self.width - 1);
        if row > 0 && row + 1 < self.height && inner.start < inner.end {
            let suspects = &mut suspects[inner.start - columns.start..inner.end - columns.start];
            match self.brightness {
                Scalars::Double(values) => self.suspect(values, row, inner, suspects),
                Scalars::Single(values) => self.suspect(values, row, inner, suspects),
            }
        }
        let suspects = columns.zip(suspects).filter(|(_, is_suspect)| *is_suspect);
        suspects.filter_map(|(column, _)| self.uncertain(row, column)).collect()
    }

    /// Leaves those columns alone that have a bend or another shape beside them; those of a row that has neighbours all
    /// around. (Without branches, for compilers to make vectors of it.)
    fn suspect<T: Copy + Into<f64>>(&self, values: &[T], row: usize, columns: Range<usize>, suspects: &mut [bool]) {
        let count = columns.len();
        let start = |row: usize| row * self.width + columns.start - 1;
        let three = |row: usize| (&values[start(row)..][..count + 2], &self.shapes[start(row)..][..count + 2]);
        let [(above, shapes_above), (here, shapes), (below, shapes_below)] = [row - 1, row, row + 1].map(three);
        for (index, suspect) in suspects.iter_mut().enumerate() {
            let [left, middle, right] = [index, index + 1, index + 2];
            let twice = 2.0 * here[middle].into();
            let bends = |before: T, after: T| (before.into() + after.into() - twice).abs() > self.tolerance;
            let shape = shapes[middle];
            let differs = |shapes: &[i32]| (shapes[left] ^ shape) | (shapes[middle] ^ shape) | (shapes[right] ^ shape);
            *suspect = bends(here[left], here[right])
                | bends(above[middle], below[middle])
                | bends(above[left], below[right])
                | bends(above[right], below[left])
                | (differs(shapes_above) | differs(shapes) | differs(shapes_below) != 0);
        }
    }

    fn uncertain(&self, row: usize, column: usize) -> Option<Uncertain> {
        let at = |row: usize, column: usize| {
            let index = row * self.width + column;
            (self.brightness.at(index), self.shapes[index])
        };
        let (here, shape) = at(row, column);
        let (mut is_uncertain, mut contrast) = (false, 0.0_f64);
        for (down, across) in [(0_isize, 1_isize), (1, 0), (1, 1), (1, -1)] {
            let neighbour = |sign: isize| {
                let row = row.checked_add_signed(sign * down).filter(|row| *row < self.height)?;
                let column = column.checked_add_signed(sign * across).filter(|column| *column < self.width)?;
                Some(at(row, column))
            };
            let [after, before] = [neighbour(1), neighbour(-1)];
            for (value, other) in [after, before].into_iter().flatten() {
                contrast = contrast.max((value - here).abs());
                is_uncertain |= other != shape && (value - here).abs() > self.tolerance;
            }
            let bend = match (after, before) {
                (Some((after, _)), Some((before, _))) => before + after - 2.0 * here,
                (Some((only, _)), None) | (None, Some((only, _))) => only - here,
                (None, None) => 0.0,
            };
            is_uncertain |= bend.abs() > self.tolerance;
        }
        is_uncertain.then_some(Uncertain { index: row * self.width + column, contrast, sees: shape >= 0 })
    }
}
