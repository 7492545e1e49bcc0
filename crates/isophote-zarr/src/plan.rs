//! How an image is divided into shards.

use std::fmt;
use std::num::NonZeroU32;

use isophote::map::{Pixel, Region, Resolution};
use isophote::scene::limits;
use serde::{Deserialize, Serialize};

/// Side of the inner chunks: the amount that a reader decodes to get at one pixel, 2 MiB of doubles.
const LARGEST_INNER: u32 = 512;
/// The largest side of a shard, however much memory there is.
const LARGEST_SIDE: u32 = 2048;
/// The memory that a shard may need while it is made, in bytes: two fit into 512 MiB beside the program.
const LARGEST_NEED: u64 = 192 << 20;

/// How an image is divided. It depends only on the image and its channels, so that a computation can be continued with
/// another number of threads, another memory limit, or on another computer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Plan {
    /// The image.
    pub full: Resolution,
    /// Side of a shard in pixels, a multiple of the inner side.
    pub shard_side: NonZeroU32,
    /// Side of an inner chunk in pixels.
    pub inner_side: NonZeroU32,
}

/// A shard, identified by its position in the grid of shards.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Shard {
    /// Counted from the top, from 0.
    pub row: u32,
    /// Counted from the left, from 0.
    pub column: u32,
}

/// Every `of`-th shard of a plan, for jobs that share a store.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Which part, from 1 to `of`.
    number: u32,
    /// How many parts there are.
    of: u32,
}

impl Plan {
    /// The most shards of a store: the largest image in the smallest shards that are ever chosen. Each is a file of its own.
    pub const MOST_SHARDS: u64 = 4_000_000;

    /// The plan for an image whose shards need this many bytes per pixel while they are made.
    #[must_use]
    pub fn new(full: Resolution, need_per_pixel: u64) -> Self {
        let need = |side: u32| u64::from(side) * u64::from(side) * need_per_pixel;
        let mut side = LARGEST_SIDE;
        while side > LARGEST_INNER && need(side) > LARGEST_NEED {
            side /= 2;
        }
        Self::with_sides(full, side, LARGEST_INNER.min(side))
    }

    /// A plan with shards of another size, with inner chunks of a quarter of that side if that is a whole number.
    #[must_use]
    pub fn with_shard_side(full: Resolution, side: NonZeroU32) -> Self {
        let side = side.get();
        Self::with_sides(full, side, if side.is_multiple_of(4) { side / 4 } else { side })
    }

    fn with_sides(full: Resolution, shard: u32, inner: u32) -> Self {
        let side = |side| NonZeroU32::new(side).unwrap_or(NonZeroU32::MIN);
        Self { full, shard_side: side(shard), inner_side: side(inner) }
    }

    /// Whether it divides the image into whole shards of whole chunks, which a damaged description may not.
    pub(crate) fn is_sound(&self) -> bool {
        let sides = [self.full.width, self.full.height];
        sides.into_iter().all(|side| (1..=limits::SIDE).contains(&side))
            && self.shard_side.get().is_multiple_of(self.inner_side.get())
            && self.count() <= Self::MOST_SHARDS
    }

    /// Rows and columns of shards.
    fn grid(&self) -> [u32; 2] {
        let side = self.shard_side.get();
        [self.full.height.div_ceil(side), self.full.width.div_ceil(side)]
    }

    /// How many shards there are.
    #[must_use]
    pub fn count(&self) -> u64 {
        let [rows, columns] = self.grid();
        u64::from(rows) * u64::from(columns)
    }

    /// The shards in the order of the plan: row by row from the top.
    pub fn shards(&self) -> impl Iterator<Item = Shard> + use<> {
        let [rows, columns] = self.grid();
        (0..rows).flat_map(move |row| (0..columns).map(move |column| Shard { row, column }))
    }

    /// The pixels of a shard that are inside the image: shards at the right and lower edges extend past it.
    #[must_use]
    pub fn region(&self, shard: Shard) -> Region {
        let side = self.shard_side.get();
        let (column, row) = (shard.column * side, shard.row * side);
        let size = Resolution { width: side.min(self.full.width - column), height: side.min(self.full.height - row) };
        Region { corner: Pixel { column, row }, size }
    }

    /// Pixels in a whole shard.
    pub(crate) fn shard_pixels(&self) -> u64 {
        u64::from(self.shard_side.get()) * u64::from(self.shard_side.get())
    }
}

impl Part {
    /// Part `number` of `of`, counted from 1; none if there is no such part.
    #[must_use]
    pub fn new(number: u32, of: u32) -> Option<Self> {
        (1..=of).contains(&number).then_some(Self { number, of })
    }

    /// Whether the shard with this index in the plan belongs to the part.
    pub(crate) fn has(self, index: u64) -> bool {
        index % u64::from(self.of) == u64::from(self.number - 1)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}/{}", self.row, self.column)
    }
}

impl fmt::Display for Part {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}/{}", self.number, self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(width: u32, height: u32, side: u32) -> Plan {
        Plan::with_shard_side(Resolution { width, height }, NonZeroU32::new(side).unwrap())
    }

    #[test]
    fn the_shards_cover_every_pixel_once() {
        let plan = plan(101, 37, 16);
        let mut seen = vec![0; 101 * 37];
        for shard in plan.shards() {
            let Region { corner, size } = plan.region(shard);
            for row in corner.row..corner.row + size.height {
                for column in corner.column..corner.column + size.width {
                    seen[(row * 101 + column) as usize] += 1;
                }
            }
        }
        assert!(seen.iter().all(|&count| count == 1));
        assert_eq!(plan.count(), plan.shards().count() as u64);
    }

    #[test]
    fn a_plan_has_no_more_shards_than_a_file_system_holds() {
        let largest = Resolution { width: limits::SIDE, height: limits::SIDE };
        assert!(Plan::new(largest, 100_000).is_sound());
        assert!(!plan(limits::SIDE, limits::SIDE, 1).is_sound());
        assert!(!plan(limits::SIDE, limits::SIDE, 400).is_sound());
        assert!(!plan(u32::MAX, 10, 512).is_sound());
    }

    #[test]
    fn the_parts_share_the_plan_out() {
        for of in [1, 2, 3, 16] {
            let parts: Vec<Part> = (1..=of).map(|number| Part::new(number, of).unwrap()).collect();
            assert!((0..40).all(|index| parts.iter().filter(|part| part.has(index)).count() == 1), "{of}");
        }
        assert_eq!((Part::new(0, 3), Part::new(4, 3), Part::new(0, 0)), (None, None, None));
    }

    #[test]
    fn shards_are_smaller_where_a_pixel_holds_more() {
        let full = Resolution { width: 100_000, height: 75_000 };
        let sides = [44, 150, 800, 100_000].map(|need| Plan::new(full, need).shard_side.get());
        assert_eq!(sides, [2048, 1024, 512, 512]);
        assert_eq!(Plan::new(full, 44).count(), 49 * 37);
    }
}
