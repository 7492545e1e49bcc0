//! The pixels of a tile that see the same sphere.

use super::WIDTH;
use super::canvas::Canvas;
use super::outlines::Seen;
use crate::accelerate::Walk;
use crate::map::Pixel;
use crate::render::band::Tile;
use crate::shape::Primitive;

/// The most pixels that are shaded together.
pub const MOST: usize = 256;

/// A pixel of a tile.
#[derive(Clone, Copy, Debug, Default)]
pub struct TilePixel(u16);

impl TilePixel {
    /// The pixel of the image.
    #[inline(always)]
    pub fn within(self, tile: Tile) -> Pixel {
        let [row, column] = [u32::from(self.0) / WIDTH, u32::from(self.0) % WIDTH];
        Pixel { column: tile.first.column + column, row: tile.first.row + row }
    }
}

/// Pixels that see the same sphere.
pub struct Group<'g> {
    /// The sphere, with its outline.
    pub seen: &'g Seen,
    /// What it is.
    pub primitive: Primitive,
    /// The tile that the pixels are in.
    pub tile: Tile,
    /// At most [`MOST`].
    pub pixels: &'g [TilePixel],
    /// Scratch memory for a query.
    pub walk: &'g mut Walk,
}

/// All pixels of a tile, grouped by what they see.
#[derive(Default)]
pub struct Groups {
    /// The visible outlines.
    pub seen: Vec<u32>,
    /// The end of each visible outline's pixels.
    ends: Vec<usize>,
    cells: Vec<TilePixel>,
    /// For each outline, the number of its pixels, and later the position of the next one.
    places: Vec<usize>,
}

impl Groups {
    /// Groups the pixels of a tile.
    pub fn collect(&mut self, canvas: &Canvas, tile: Tile, outlines: usize) {
        self.places.clear();
        self.places.resize(outlines, 0);
        for row in 0..tile.height {
            for outline in canvas.row(row, tile.width).iter().filter(|outline| **outline >= 0.0) {
                self.places[whole(*outline)] += 1;
            }
        }
        self.seen.clear();
        self.ends.clear();
        let mut end = 0;
        for (outline, place) in (0..).zip(&mut self.places) {
            if *place > 0 {
                let count = *place;
                *place = end;
                end += count;
                self.seen.push(outline);
                self.ends.push(end);
            }
        }
        self.cells.clear();
        self.cells.resize(end, TilePixel::default());
        for row in 0..tile.height {
            for (column, outline) in (0..).zip(canvas.row(row, tile.width)) {
                if *outline >= 0.0 {
                    let place = &mut self.places[whole(*outline)];
                    self.cells[*place] = TilePixel(u16::try_from(row * WIDTH + column).unwrap_or(0));
                    *place += 1;
                }
            }
        }
    }

    /// The pixels that see the visible outline with this index.
    pub fn pixels_of(&self, index: usize) -> &[TilePixel] {
        let start = if index == 0 { 0 } else { self.ends[index - 1] };
        &self.cells[start..self.ends[index]]
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index")]
fn whole(outline: f64) -> usize {
    outline as usize
}
