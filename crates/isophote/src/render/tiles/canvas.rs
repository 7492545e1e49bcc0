//! The depth buffer of a tile.

use super::outlines::{Block, Outlines, View};
use super::{HEIGHT, WIDTH};
use crate::lanes::{Lane, LaneJob};
use crate::map::Pixel;
use crate::prepare::ERROR_OF_DISTANCE;
use crate::render::band::Tile;

/// The length of a row in memory: vectors may extend beyond the tile's edge.
const STRIDE: usize = WIDTH as usize + 16;
const PIXELS: usize = STRIDE * HEIGHT as usize;

/// The size of the parts of a tile whose farthest depth is tracked.
const PART: usize = 16;
const PART_ROWS: usize = 8;
const PARTS: usize = WIDTH as usize / PART;

/// Which outline each pixel of a tile sees, and how far away.
pub struct Canvas {
    /// t‖d‖ of (2.1), where d is the direction to the pixel on a screen at distance 1: it follows from the root of a row's
    /// outline without another root.
    depths: Vec<f64>,
    /// Index of the outline; negative where nothing is seen.
    outlines: Vec<f64>,
    /// The farthest depth in each part.
    farthest: [[f64; PARTS]; HEIGHT as usize / PART_ROWS],
    doubts: Doubts,
}

/// What may or may not be visible at each pixel: of all that is there, a lower bound on the depth of the nearest. (Where many
/// spheres coincide, each is in doubt at each pixel.)
struct Doubts {
    from: Vec<f64>,
    /// The pixels that have any.
    pixels: Vec<usize>,
}

/// No outline.
const NONE: f64 = -1.0;

/// A row of an outline being drawn.
struct RowOf {
    roots: [f64; 2],
    /// d·c at u = 0, and its change per column.
    depth: [f64; 2],
}

/// The values that do not depend on the row.
struct Pen {
    column: f64,
    index: f64,
    /// cos²θ_o ‖d‖² R² over (u − u_a)(u_b − u).
    clearance: f64,
    /// Clearances between these limits, times ‖d‖² R², are in doubt.
    doubtful: [f64; 2],
    /// The possible error of depths, for comparing nearly equal ones.
    uncertain: f64,
    /// The same error at the edge, where the depth is that of the grazing ray.
    uncertain_at_edge: f64,
}

/// Draws the last batch of outlines, from near to far.
pub struct Draw<'t> {
    /// The canvas to draw on.
    pub canvas: &'t mut Canvas,
    /// The outlines to draw.
    pub outlines: &'t Outlines,
    /// The camera.
    pub view: &'t View,
    /// The tile.
    pub tile: Tile,
    /// The smallest length of d in the tile.
    pub least_length: f64,
}

impl LaneJob for Draw<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S, D>(self, token: S::Token)
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        let Self { canvas, outlines, view, tile, least_length } = self;
        for index in outlines.by_distance() {
            canvas.draw::<D>(token, outlines, *index, tile, least_length, view);
        }
        canvas.measure::<D>(token, tile);
    }
}

impl Canvas {
    /// An empty tile.
    pub fn new() -> Self {
        Self {
            depths: vec![f64::INFINITY; PIXELS],
            outlines: vec![NONE; PIXELS],
            farthest: [[f64::INFINITY; PARTS]; HEIGHT as usize / PART_ROWS],
            doubts: Doubts { from: vec![f64::INFINITY; PIXELS], pixels: Vec::new() },
        }
    }

    /// Clears the tile.
    pub fn clear(&mut self) {
        self.depths.fill(f64::INFINITY);
        self.outlines.fill(NONE);
        self.farthest = [[f64::INFINITY; PARTS]; HEIGHT as usize / PART_ROWS];
        self.doubts.clear();
    }

    /// The greatest depth of any pixel: t‖d‖, in metres.
    pub fn farthest(&self) -> f64 {
        self.farthest.iter().flatten().copied().fold(0.0, f64::max)
    }

    /// Updates the farthest depth of each part.
    #[inline(always)]
    fn measure<D: Lane<Element = f64>>(&mut self, token: D::Token, tile: Tile) {
        for (row, parts) in self.farthest.iter_mut().enumerate() {
            for (column, farthest) in parts.iter_mut().enumerate() {
                let rows = (row * PART_ROWS)..((row + 1) * PART_ROWS).min(tile.height as usize);
                let end = (tile.width as usize).saturating_sub(column * PART).min(PART);
                *farthest = 0.0;
                for row in rows {
                    let at = row * STRIDE + column * PART;
                    let part = &self.depths[at..at + PART];
                    *farthest = if end == PART {
                        greatest::<D>(token, part).max(*farthest)
                    } else {
                        part[..end].iter().copied().fold(*farthest, f64::max)
                    };
                }
            }
        }
    }

    /// Draws a sphere from its outline, unless everything that it covers is closer.
    #[inline(always)]
    fn draw<D: Lane<Element = f64>>(
        &mut self,
        token: D::Token,
        outlines: &Outlines,
        index: u32,
        tile: Tile,
        least_length: f64,
        view: &View,
    ) {
        let (block, lane) = outlines.place(index);
        let ellipse = &block.ellipse;
        let [first, last] = [ellipse.rows[0][lane], ellipse.rows[1][lane]];
        let row = ellipse.row[lane];
        let [top, left] = [f64::from(tile.first.row), f64::from(tile.first.column)];
        let [bottom, right] = [top + f64::from(tile.height), left + f64::from(tile.width)];
        // One extra row on either side, for pixels in doubt.
        let rows = [(row + first).floor().max(top), ((row + last).ceil() + 1.0).min(bottom)];
        if rows[0] >= rows[1] || self.is_hidden(block, lane, [rows[0] - top, rows[1] - top], left, least_length) {
            return;
        }
        let pen = Pen::new(block, lane, index, view);
        let [middle, slope] = [ellipse.middle[0][lane], ellipse.middle[1][lane]];
        let width_squared = ellipse.width_squared[lane];
        let mut at_row = rows[0];
        while at_row < rows[1] {
            let v = at_row - row;
            let squared = width_squared * ((v - first) * (last - v));
            let width = squared.max(0.0).sqrt();
            let center = middle + slope * v;
            let depth = block.depth[2][lane].mul_add(v, block.depth[0][lane]);
            let row_of = RowOf { roots: [center - width, center + width], depth: [depth, block.depth[1][lane]] };
            let start = (pen.column + row_of.roots[0]).floor().max(left);
            let end = ((pen.column + row_of.roots[1]).ceil() + 1.0).min(right);
            if start < end {
                let at = whole(at_row - top) * STRIDE + whole(start - left);
                if squared >= 0.0 {
                    self.draw_row::<D>(token, &pen, &row_of, start, end, at);
                } else if pen.clearance * squared > pen.doubtful[0] {
                    for offset in 0..whole(end - start) {
                        self.doubts.add(at + offset, 0.0);
                    }
                }
            }
            at_row += 1.0;
        }
    }

    #[inline(always)]
    fn draw_row<D: Lane<Element = f64>>(
        &mut self,
        token: D::Token,
        pen: &Pen,
        row: &RowOf,
        mut column: f64,
        end: f64,
        mut at: usize,
    ) {
        let (zero, beyond) = (D::splat(token, 0.0), D::splat(token, f64::INFINITY));
        let [least, greatest] = [D::splat(token, pen.doubtful[0]), D::splat(token, pen.doubtful[1])];
        while column < end {
            let first = column - pen.column;
            let u = D::counted(token, first);
            let after_first = u - D::splat(token, row.roots[0]);
            let before_last = D::splat(token, row.roots[1]) - u;
            let clearance = D::splat(token, pen.clearance) * after_first * before_last;
            let along = u.mul_add(D::splat(token, row.depth[1]), D::splat(token, row.depth[0]));
            let depth = D::select(zero.is_less(clearance), along - clearance.max_zero().sqrt(), beyond);
            let before = D::load(token, &self.depths[at..]);
            let is_nearer = depth.is_less(before);
            let apart = (depth - before).max(before - depth);
            let at_edge = D::bits(least.is_less(clearance)) & D::bits(clearance.is_less(greatest));
            let close = D::bits(apart.is_less(D::splat(token, pen.uncertain)));
            let here = bits_below(end - column);
            if (at_edge | close) & here != 0 {
                self.doubt(pen, [at_edge & here, close & here], &stored(along), &stored(clearance), &stored(depth), at);
            }
            D::select(is_nearer, depth, before).store(&mut self.depths[at..]);
            let outlines = D::load(token, &self.outlines[at..]);
            D::select(is_nearer, D::splat(token, pen.index), outlines).store(&mut self.outlines[at..]);
            column += count_of::<D>();
            at += D::COUNT;
        }
    }

    /// Records pixels at an edge, and pixels where two surfaces meet.
    #[inline(never)]
    fn doubt(
        &mut self,
        pen: &Pen,
        [at_edge, close]: [u32; 2],
        along: &[f64; 16],
        clearance: &[f64; 16],
        depth: &[f64; 16],
        at: usize,
    ) {
        for lane in 0..16 {
            if at_edge >> lane & 1 == 1 {
                let from = along[lane] - clearance[lane].max(0.0).sqrt() - pen.uncertain_at_edge;
                self.doubts.add(at + lane, from);
            }
            if close >> lane & 1 == 1 {
                let farther = depth[lane].max(self.depths[at + lane]);
                self.doubts.add(at + lane, farther - 0.25 * pen.uncertain);
            }
        }
    }

    /// Whether everything that a sphere covers, including a margin of one pixel, is closer than the sphere.
    #[inline(always)]
    fn is_hidden(&self, block: &Block, lane: usize, rows: [f64; 2], left: f64, least_length: f64) -> bool {
        let [start, end] = columns_of(block, lane);
        let columns = [(start - left).max(0.0), (end - left).min(f64::from(WIDTH) - 1.0)];
        let near = (block.distance[lane] - block.radius[lane]) * least_length * (1.0 - 1e-6);
        if !(columns[0] <= columns[1]) {
            return false;
        }
        let parts = whole(columns[0]) / PART..=whole(columns[1]) / PART;
        let rows = whole(rows[0]) / PART_ROWS..=whole(rows[1] - 1.0) / PART_ROWS;
        self.farthest[rows].iter().all(|row| row[parts.clone()].iter().all(|farthest| near > *farthest))
    }

    /// Moves the pixels in doubt to `doubtful`.
    pub fn settle(&mut self, tile: Tile, doubtful: &mut Vec<Pixel>) {
        for at in &self.doubts.pixels {
            // Written so that NaN stays in doubt.
            if !(self.doubts.from[*at] > self.depths[*at]) {
                self.outlines[*at] = DOUBTFUL;
                let [row, column] = [at / STRIDE, at % STRIDE].map(|count| u32::try_from(count).unwrap_or(0));
                doubtful.push(Pixel { column: tile.first.column + column, row: tile.first.row + row });
            }
        }
    }

    /// The outlines visible in a row, negative where there is none.
    pub fn row(&self, row: u32, width: u32) -> &[f64] {
        &self.outlines[row as usize * STRIDE..][..width as usize]
    }
}

impl Doubts {
    /// Something at a pixel, from a depth on. NaN counts as in front of everything.
    fn add(&mut self, at: usize, from: f64) {
        let nearest = &mut self.from[at];
        if *nearest == f64::INFINITY {
            self.pixels.push(at);
        }
        *nearest = if from.is_nan() { f64::NEG_INFINITY } else { nearest.min(from).min(f64::MAX) };
    }

    fn clear(&mut self) {
        for at in self.pixels.drain(..) {
            self.from[at] = f64::INFINITY;
        }
    }
}

/// Marks a pixel in doubt.
const DOUBTFUL: f64 = -2.0;

impl Pen {
    #[inline(always)]
    fn new(block: &Block, lane: usize, index: u32, view: &View) -> Self {
        let radius = block.radius[lane];
        let length = view.greatest_length;
        let squared = radius * radius;
        let scale = length * length * squared;
        let uncertain = 4.0 * ERROR_OF_DISTANCE * length * (block.distance[lane] + radius);
        Self {
            column: block.ellipse.column[lane],
            index: index.into(),
            clearance: block.ellipse.clearance[lane] * squared,
            doubtful: [-128.0 * f64::EPSILON * scale, block.doubtful[lane] * scale],
            uncertain,
            uncertain_at_edge: uncertain + 1e-6 * radius * length,
        }
    }
}

/// The first and last column that an outline may touch, with one extra on either side.
#[inline(always)]
fn columns_of(block: &Block, lane: usize) -> [f64; 2] {
    let ellipse = &block.ellipse;
    let [first, last] = [ellipse.rows[0][lane], ellipse.rows[1][lane]];
    let half = 0.5 * (last - first);
    let middle = ellipse.column[lane] + ellipse.middle[0][lane] + ellipse.middle[1][lane] * (first + half);
    let reach = (ellipse.width_squared[lane].sqrt() + ellipse.middle[1][lane].abs()) * half + 1.0;
    [(middle - reach).floor(), (middle + reach).ceil()]
}

#[inline(always)]
fn greatest<D: Lane<Element = f64>>(token: D::Token, numbers: &[f64]) -> f64 {
    let mut greatest = D::load(token, numbers);
    for numbers in numbers.chunks_exact(D::COUNT).skip(1) {
        greatest = greatest.max(D::load(token, numbers));
    }
    stored(greatest)[..D::COUNT].iter().copied().fold(0.0, f64::max)
}

#[inline(always)]
fn stored<D: Lane<Element = f64>>(numbers: D) -> [f64; 16] {
    let mut out = [0.0; 16];
    numbers.store(&mut out);
    out
}

/// The lanes below an index.
#[inline(always)]
fn bits_below(count: f64) -> u32 {
    if count >= 16.0 { 0xffff } else { (1 << whole(count)) - 1 }
}

#[inline(always)]
#[expect(clippy::cast_precision_loss, reason = "at most 16")]
fn count_of<D: Lane>() -> f64 {
    D::COUNT as f64
}

/// An index within a tile.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "held within the tile")]
fn whole(count: f64) -> usize {
    count as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_number_of_things_in_doubt_take_one_place_a_pixel() {
        let mut canvas = Canvas::new();
        let tile = Tile { first: Pixel { column: 64, row: 128 }, width: 64, height: 64 };
        canvas.depths[..5].copy_from_slice(&[1.0, 1.0, f64::INFINITY, f64::NAN, 1.0]);
        for count in 0..100_000 {
            let behind = 2.0 + f64::from(count);
            canvas.doubts.add(0, behind);
            canvas.doubts.add(1, behind);
            canvas.doubts.add(2, behind);
            canvas.doubts.add(3, behind);
            canvas.doubts.add(4, if count == 7 { f64::NAN } else { behind });
        }
        canvas.doubts.add(1, 0.5);
        assert_eq!(canvas.doubts.pixels.len(), 5);
        let mut doubtful = Vec::new();
        canvas.settle(tile, &mut doubtful);
        let columns: Vec<u32> = doubtful.iter().map(|pixel| pixel.column - 64).collect();
        assert_eq!(columns, [1, 2, 3, 4]);
        canvas.clear();
        doubtful.clear();
        canvas.settle(tile, &mut doubtful);
        assert!(doubtful.is_empty());
    }
}
