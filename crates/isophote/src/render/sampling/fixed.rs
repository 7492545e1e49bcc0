//! The same number of rays through every pixel: for each band, one image per sample position, rendered like the centres, and
//! the mean of all.

use std::sync::{Mutex, PoisonError};

use super::Renders;
use super::apply::{copy_geometry, put, put_exactly, put_shapes};
use super::bands::{RowBand, Stack, bands};
use super::pattern::Patterns;
use super::refine::{is_mean, offsets};
use crate::map::{Map, Quantity, Run, Scalars, Values};
use crate::prepare::PreparedScene;
use crate::render::share::Share;
use crate::render::{Observer, RenderError, RenderSettings, band};
use crate::scene::{Filter, Sampling};
use crate::threads::Threads;

/// Renders every sample position in the pixels of a region and takes the means. Threads share the bands, not the images: the
/// images of a band are rendered one after another in the same memory, which stays in the cache.
pub fn render(
    scene: &PreparedScene,
    settings: &RenderSettings<'_>,
    threads: &Threads,
    renders: &Renders<'_>,
) -> Result<Vec<Map>, RenderError> {
    let Sampling { samples, filter, .. } = scene.scene().sampling();
    let region = settings.region.expect("it was grown for the filter");
    let share = settings.observer.map(|whole| Share::new(whole, u64::from(samples) + 1));
    let observer = share.as_ref().map(|share| share as &dyn Observer);
    let quantities = settings.quantities.iter().filter(|quantity| is_sampled(quantity)).cloned().collect();
    let sampled = RenderSettings { quantities, observer, region: None };
    let centres = RenderSettings { observer, ..settings.clone() };
    let start = |band: RowBand| {
        let layers = (renders.serial)(Vec::new(), scene, &band.settings(&centres))?;
        let layers = layers.into_iter().map(|map| (Means::new(&map, filter), map)).collect();
        Ok::<_, RenderError>(BandMeans { layers, memory: Vec::new() })
    };
    let count = scene.layers().len();
    let stacks = Mutex::new((0..count).map(|_| Stack::new(region)).collect::<Vec<_>>());
    let mut parts: Vec<(RowBand, Option<BandMeans>)> =
        bands(region, filter.reach()).into_iter().map(|band| (band, None)).collect();
    let patterns = Patterns::new(samples);
    let mut left = samples as usize;
    threads.start()?;
    for places in patterns.of(samples).chunks(views_at_once(scene)) {
        left -= places.len();
        let views: Vec<_> = places.iter().map(|place| (*place, scene.seen_through(*place))).collect();
        parts = threads.map::<_, _, Result<_, RenderError>>(parts, |(band, part): (RowBand, Option<BandMeans>)| {
            let mut part = part.map_or_else(|| start(band), Ok)?;
            part.add(&views, &band.settings(&sampled), renders)?;
            if left > 0 {
                return Ok((band, Some(part)));
            }
            let layers = part.finish(samples)?;
            let mut stacks = stacks.lock().unwrap_or_else(PoisonError::into_inner);
            for (stack, map) in stacks.iter_mut().zip(&layers) {
                stack.add(band, map);
            }
            Ok((band, None))
        })?;
    }
    let stacks = stacks.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok(stacks.into_iter().map(|stack| stack.finish(scene)).collect())
}

/// How many views of a scene are cached at a time: each has a list of the scene's shapes.
fn views_at_once(scene: &PreparedScene) -> usize {
    (1_000_000 / scene.scene().shapes().len().max(1)).clamp(1, 64)
}

/// Whether a quantity is rendered at every sample position: for its mean, or for what the centre may miss.
fn is_sampled(quantity: &Quantity) -> bool {
    let is_geometry = matches!(quantity, Quantity::Depth | Quantity::Position | Quantity::Normal);
    is_mean(quantity) || is_geometry || *quantity == Quantity::Color
}

/// The state of a band so far.
struct BandMeans {
    /// The map of each layer, and the sums for it.
    layers: Vec<(Means, Map)>,
    /// Cleared buffers of the last image.
    memory: Vec<Values>,
}

impl BandMeans {
    /// Adds samples.
    fn add(
        &mut self,
        views: &[([f64; 2], PreparedScene)],
        settings: &RenderSettings<'_>,
        renders: &Renders<'_>,
    ) -> Result<(), RenderError> {
        for (place, view) in views {
            let samples = (renders.serial)(std::mem::take(&mut self.memory), view, settings)?;
            for ((means, map), sample) in self.layers.iter_mut().zip(&samples) {
                means.add(map, sample, *place);
                means.fill_in(map, sample);
            }
            self.memory = band::recycle(samples);
        }
        Ok(())
    }

    fn finish(self, samples: u32) -> Result<Vec<Map>, RenderError> {
        let finish = |(means, mut map): (Means, Map)| {
            means.finish(&mut map, samples)?;
            Ok(map)
        };
        self.layers.into_iter().map(finish).collect()
    }
}

/// The sums over the samples.
struct Means {
    filter: Filter,
    width: usize,
    /// The channels of the map that are means, with the sums of weight × value.
    sums: Vec<(usize, Vec<f64>)>,
    /// For each pixel within reach of the filter, row by row from the upper left, the sum of its weights there.
    weights: Vec<f64>,
    /// The difference between the number of samples that see a surface in a pixel and in the one before it.
    steps: Vec<i32>,
    /// What each pixel sees: at its centre, or otherwise at the first sample position that sees anything.
    shapes: Vec<i32>,
}

impl Means {
    fn new(map: &Map, filter: Filter) -> Self {
        let pixels = map.region.size.pixels();
        let channels = map.channels.iter().enumerate().filter(|(_, channel)| is_mean(&channel.quantity));
        Self {
            filter,
            width: map.region.size.width as usize,
            sums: channels.map(|(index, _)| (index, vec![0.0; pixels])).collect(),
            weights: vec![0.0; offsets(filter).len()],
            steps: vec![0; pixels + 1],
            shapes: map.mask.shapes(),
        }
    }

    /// Adds the image of a sample position: to its own pixels and, weighted, to those within reach of the filter.
    fn add(&mut self, map: &Map, sample: &Map, [across, down]: [f64; 2]) {
        let Self { filter, width, sums, weights, steps, .. } = self;
        let offsets = offsets(*filter);
        let parts = offsets.iter().map(|[columns, rows]| filter.weight(across - 0.5 - columns, down - 0.5 - rows));
        let parts: Vec<f64> = parts.collect();
        weights.iter_mut().zip(&parts).for_each(|(sum, weight)| *sum += weight);
        let runs = sample.mask.runs();
        for run in runs {
            steps[run.start] += 1;
            steps[run.end] -= 1;
        }
        for (channel, sums) in sums {
            let values = sample.scalar(&map.channels[*channel].quantity).expect("it was asked for");
            for (row, sums) in sums.chunks_exact_mut(*width).enumerate() {
                for ([columns, rows], weight) in offsets.iter().zip(&parts) {
                    #[expect(clippy::cast_possible_truncation, reason = "a few pixels")]
                    let (columns, rows) = (*columns as isize, *rows as isize);
                    if let Some(from) = row.checked_add_signed(-rows) {
                        let start = from * *width;
                        add_row(sums, columns, *weight, values, start, within(runs, start, *width));
                    }
                }
            }
        }
    }

    /// Where no centre has seen anything so far, records what this sample sees.
    fn fill_in(&mut self, map: &mut Map, sample: &Map) {
        for run in sample.mask.runs() {
            for index in run.start..run.end {
                if self.shapes[index] < 0 {
                    self.shapes[index] = i32::try_from(run.shape).unwrap_or(i32::MAX);
                    copy_geometry_of(map, sample, index);
                }
            }
        }
    }

    fn finish(mut self, map: &mut Map, samples: u32) -> Result<(), RenderError> {
        let is_counted = |quantity: &Quantity| matches!(quantity, Quantity::Samples | Quantity::Coverage);
        if map.channels.iter().any(|channel| is_counted(&channel.quantity)) {
            self.count(map, samples);
        }
        if self.filter.reach() > 0 {
            self.see_neighbours(map);
        }
        put_shapes(map, &self.shapes);
        let of_all: f64 = self.weights.iter().rev().sum();
        for index in (0..self.shapes.len()).filter(|index| self.shapes[*index] >= 0) {
            let weight = if self.is_inner(index) { of_all } else { self.weight(index) };
            for (channel, sums) in &self.sums {
                put(map, *channel, index, sums[index] / weight)?;
            }
        }
        Ok(())
    }

    /// Writes the number of rays through each pixel, and the fraction of them that hit a surface.
    fn count(&self, map: &mut Map, samples: u32) {
        let mut covered = 0;
        for (index, step) in self.steps[..self.shapes.len()].iter().enumerate() {
            covered += step;
            if self.shapes[index] >= 0 {
                put_exactly(map, &Quantity::Samples, index, samples.into());
                put_exactly(map, &Quantity::Coverage, index, f64::from(covered) / f64::from(samples));
            }
        }
    }

    /// Whether everything within reach of the filter is in the image.
    fn is_inner(&self, index: usize) -> bool {
        let reach = self.filter.reach() as usize;
        if reach == 0 {
            return true;
        }
        let rows = self.shapes.len() / self.width;
        let (row, column) = (index / self.width, index % self.width);
        row >= reach && row + reach < rows && column >= reach && column + reach < self.width
    }

    /// A pixel that sees nothing but gets light from neighbours takes its geometry from the first such neighbour.
    fn see_neighbours(&mut self, map: &mut Map) {
        let seen = self.shapes.clone();
        for index in (0..seen.len()).filter(|index| seen[*index] < 0) {
            let neighbours = self.neighbours(index).flatten();
            if let Some(source) = neighbours.into_iter().find(|source| seen[*source] >= 0) {
                self.shapes[index] = seen[source];
                copy_geometry(map, source, index);
            }
        }
    }

    /// The pixels that spread light into one, in reverse order of the weights; `None` for those outside the image.
    fn neighbours(&self, index: usize) -> impl Iterator<Item = Option<usize>> + use<> {
        let (width, rows) = (self.width, self.shapes.len() / self.width);
        let (row, column) = (index / width, index % width);
        let reach = self.filter.reach().cast_signed() as isize;
        (-reach..=reach).flat_map(move |down| {
            (-reach..=reach).map(move |across| {
                let row = row.checked_add_signed(down).filter(|row| *row < rows)?;
                let column = column.checked_add_signed(across).filter(|column| *column < width)?;
                Some(row * width + column)
            })
        })
    }

    /// The sum of all weights that a pixel received, including the background's.
    fn weight(&self, index: usize) -> f64 {
        let weights = self.neighbours(index).zip(self.weights.iter().rev());
        weights.filter_map(|(source, weight)| source.map(|_| weight)).sum()
    }
}

/// The runs of a row that starts at an index.
fn within(runs: &[Run], start: usize, width: usize) -> &[Run] {
    let first = runs.partition_point(|run| run.end <= start);
    let count = runs[first..].partition_point(|run| run.start < start + width);
    &runs[first..first + count]
}

/// Adds weight × value of the runs of a row to the pixels `columns` to the right of them.
fn add_row(sums: &mut [f64], columns: isize, weight: f64, values: Scalars<'_>, start: usize, runs: &[Run]) {
    for run in runs {
        // The part that ends up within the row.
        let [first, last] = [run.start - start, run.end - start];
        let first = first.max((-columns).max(0).unsigned_abs());
        let last = last.min(sums.len().saturating_add_signed(-columns));
        if first >= last {
            continue;
        }
        let target = first.saturating_add_signed(columns)..last.saturating_add_signed(columns);
        let sums = sums[target].iter_mut();
        match values {
            Scalars::Double(values) => {
                sums.zip(&values[start + first..start + last]).for_each(|(sum, value)| *sum += weight * value);
            }
            Scalars::Single(values) => {
                let values = values[start + first..start + last].iter();
                sums.zip(values).for_each(|(sum, value)| *sum += weight * f64::from(*value));
            }
        }
    }
}

/// Copies the geometry that a pixel sees from another map.
fn copy_geometry_of(map: &mut Map, other: &Map, index: usize) {
    for channel in &mut map.channels {
        let Some(source) = other.channel(&channel.quantity) else { continue };
        match (&channel.quantity, &mut channel.values, &source.values) {
            (Quantity::Depth, Values::Scalar(values), Values::Scalar(source)) => values[index] = source[index],
            (Quantity::Normal | Quantity::Position, Values::Vector(values), Values::Vector(source)) => {
                values[index] = source[index];
            }
            _ => {}
        }
    }
}
