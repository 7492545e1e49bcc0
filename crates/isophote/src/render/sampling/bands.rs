//! A region split into bands of rows, each sampled by one thread, and the map that they make up.

use crate::map::{Channel, Map, Mask, Pixel, Region, Resolution, Run, Values};
use crate::prepare::PreparedScene;
use crate::render::RenderSettings;

/// Rows of a region, plus the surrounding rows from which a filter spreads light into them.
#[derive(Clone, Copy)]
pub struct RowBand {
    /// All rows, including the surrounding ones.
    region: Region,
    /// The number of surrounding rows above.
    above: u32,
    /// The number of its own rows.
    rows: u32,
}

/// Rows of a band: enough that starting it costs little, few enough that it stays in the cache and threads finish together.
const ROWS: u32 = 32;

/// The bands of a region, with `reach` rows around each, as far as the region extends.
pub fn bands(region: Region, reach: u32) -> Vec<RowBand> {
    let Region { corner, size } = region;
    let end = corner.row + size.height;
    let mut bands = Vec::new();
    let mut start = corner.row;
    while start < end {
        let next = ((start / ROWS + 1) * ROWS).min(end);
        let first = start.saturating_sub(reach).max(corner.row);
        let last = next.saturating_add(reach).min(end);
        let region =
            Region { corner: Pixel { row: first, ..corner }, size: Resolution { height: last - first, ..size } };
        bands.push(RowBand { region, above: start - first, rows: next - start });
        start = next;
    }
    bands
}

impl RowBand {
    /// The settings to render it with.
    pub fn settings<'o>(&self, settings: &RenderSettings<'o>) -> RenderSettings<'o> {
        RenderSettings { region: Some(self.region), ..settings.clone() }
    }
}

/// The map of a region, assembled from bands.
pub struct Stack {
    region: Region,
    /// The common data of the bands, and their values so far.
    map: Option<Map>,
    runs: Vec<Run>,
}

impl Stack {
    /// An empty stack.
    pub fn new(region: Region) -> Self {
        Self { region, map: None, runs: Vec::new() }
    }

    /// Adds a band; bands may come in any order.
    pub fn add(&mut self, band: RowBand, part: &Map) {
        let Self { region, map, runs } = self;
        let width = region.size.width as usize;
        let map = map.get_or_insert_with(|| {
            let channels = part.channels.iter().map(|channel| empty(channel, region.size.pixels())).collect();
            let mask = Mask::new(region.size, Vec::new());
            let (window, provenance) = (part.window, part.provenance.clone());
            let (full, whole) = (part.full, part.whole);
            Map { full, region: *region, window, whole, provenance, over_tolerance: None, mask, channels }
        });
        let above = band.above as usize * width;
        let start = (band.region.corner.row + band.above - region.corner.row) as usize * width;
        let own = above..above + band.rows as usize * width;
        // Runs never continue into the next row.
        for run in part.mask.runs().iter().filter(|run| own.contains(&run.start)) {
            let target = run.start - above + start..run.end - above + start;
            for (channel, part) in map.channels.iter_mut().zip(&part.channels) {
                copy(&part.values, run.start..run.end, &mut channel.values, target.clone());
            }
            runs.push(Run { start: target.start, end: target.end, shape: run.shape });
        }
    }

    /// The map of all bands.
    pub fn finish(self, scene: &PreparedScene) -> Map {
        let Self { region, map, mut runs } = self;
        runs.sort_unstable_by_key(|run| run.start);
        let map = map.expect("a region has rows");
        let window = scene.scene().camera().window(region, scene.scene().length());
        Map { mask: Mask::new(region.size, runs), window, ..map }
    }
}

/// A channel of this many pixels that see nothing.
fn empty(like: &Channel, pixels: usize) -> Channel {
    let values = match &like.values {
        Values::Scalar(_) => Values::Scalar(vec![0.0; pixels]),
        Values::Single(_) => Values::Single(vec![0.0; pixels]),
        Values::Vector(_) => Values::Vector(vec![[0.0; 3]; pixels]),
        Values::Index(_) => Values::Index(vec![-1; pixels]),
    };
    Channel { quantity: like.quantity.clone(), unit: like.unit.clone(), values }
}

/// Copies values; both sides must be of the same kind.
fn copy(from: &Values, source: std::ops::Range<usize>, to: &mut Values, target: std::ops::Range<usize>) {
    match (from, to) {
        (Values::Scalar(from), Values::Scalar(to)) => to[target].copy_from_slice(&from[source]),
        (Values::Single(from), Values::Single(to)) => to[target].copy_from_slice(&from[source]),
        (Values::Vector(from), Values::Vector(to)) => to[target].copy_from_slice(&from[source]),
        (Values::Index(from), Values::Index(to)) => to[target].copy_from_slice(&from[source]),
        _ => unreachable!("all bands have the same channels"),
    }
}
