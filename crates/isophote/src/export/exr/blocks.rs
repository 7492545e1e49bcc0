//! The pixels of an EXR file: blocks of rows, compressed on all processors, written in order.
//!
//! The `exr` crate does the file around them. Its own way from samples to blocks takes a call for every sample and a
//! copy of every channel, background or not: 1.7 s for all channels of a map of 3840×2160, before any compression.

use std::{io, iter::repeat_n, ops::Range};

use exr::{
    block::{
        chunk::{Chunk, CompressedBlock, CompressedScanLineBlock},
        writer::{ChunkWriter, ChunksWriter},
    },
    error::UnitResult,
};
use flate2::{Compress, Compression, FlushCompress, Status};
use rayon::prelude::*;

use crate::map::{Map, Mask, Run, Values};

/// One channel of the file.
pub(super) struct Plane<'m> {
    pub(super) name: &'m str,
    samples: Samples<'m>,
}

/// Where a channel's samples come from.
#[derive(Clone, Copy)]
enum Samples<'m> {
    Double(&'m [f64]),
    Single(&'m [f32]),
    Component(&'m [[f64; 3]], usize),
    Index(&'m [i32]),
}

/// The format's `ZIP16`: rows in a block.
const ROWS: usize = 16;

/// Blocks that are compressed before they are written: enough to keep all processors busy to the end of a batch, and
/// little memory beside the map.
const BATCH: usize = 32;

/// Writes all pixels. Whatever the number of threads, the bytes are the same.
pub(super) fn write<W: io::Write + io::Seek>(
    map: &Map,
    planes: &[Plane<'_>],
    chunks: &mut ChunkWriter<W>,
) -> UnitResult {
    let failed = |reason: rayon::ThreadPoolBuildError| io::Error::other(reason);
    // Told outright: the pool would otherwise take its size from an environment variable.
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZeroUsize::get);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(failed)?;
    let blocks = Blocks::new(map, planes)?;
    let first_line = map.region.corner.row.cast_signed();
    for batch in all_rows(map).chunks(BATCH) {
        let compressed: io::Result<Vec<Vec<u8>>> = pool.install(|| {
            let blocks =
                batch.par_iter().map_init(|| Scratch::new(LEVEL), |scratch, rows| blocks.compress(rows, scratch));
            blocks.collect()
        });
        for (rows, bytes) in batch.iter().zip(compressed?) {
            let y_coordinate = first_line + i32::try_from(rows.start).map_err(io::Error::other)?;
            let lines = CompressedScanLineBlock { y_coordinate, compressed_pixels_le: bytes };
            let chunk = Chunk { layer_index: 0, compressed_block: CompressedBlock::ScanLine(lines) };
            chunks.write_chunk(rows.start / ROWS, chunk)?;
        }
    }
    Ok(())
}

impl<'m> Plane<'m> {
    /// The channel, or a component of it if it holds vectors.
    pub(super) fn new(name: &'m str, values: &'m Values, component: usize) -> Self {
        let samples = match values {
            Values::Scalar(values) => Samples::Double(values),
            Values::Single(values) => Samples::Single(values),
            Values::Vector(values) => Samples::Component(values, component),
            Values::Index(indices) => Samples::Index(indices),
        };
        Self { name, samples }
    }

    /// The first value that has no finite 32-bit counterpart, or index that has no exact one, and its pixel's index.
    pub(super) fn overflow(&self, mask: &Mask) -> Option<(usize, f64)> {
        let too_large = |value: &f64| !single(*value).is_finite();
        mask.runs().iter().find_map(|run| {
            let pixels = run.start..run.end;
            let (offset, value) = match self.samples {
                Samples::Double(values) => find(values[pixels].iter().copied(), too_large),
                Samples::Single(_) => None,
                Samples::Component(values, axis) => find(values[pixels].iter().map(|vector| vector[axis]), too_large),
                Samples::Index(indices) => {
                    let mut indices = indices[pixels].iter().enumerate();
                    indices.find(|(_, index)| !is_exact(**index)).map(|(offset, index)| (offset, f64::from(*index)))
                }
            }?;
            Some((run.start + offset, value))
        })
    }

    /// What the file has where no surface is seen.
    fn background(&self) -> [u8; 4] {
        match self.samples {
            Samples::Index(_) => (-1.0_f32).to_le_bytes(),
            Samples::Double(_) | Samples::Single(_) | Samples::Component(..) => [0; 4],
        }
    }

    /// Stores the samples of these pixels.
    fn store(&self, pixels: Range<usize>, line: &mut [[u8; 4]]) {
        match self.samples {
            Samples::Double(values) => fill(line, values[pixels].iter().map(|value| single(*value))),
            Samples::Single(values) => fill(line, values[pixels].iter().copied()),
            Samples::Component(values, axis) => fill(line, values[pixels].iter().map(|vector| single(vector[axis]))),
            Samples::Index(indices) => fill(line, indices[pixels].iter().map(|index| single(f64::from(*index)))),
        }
    }
}

fn find(values: impl Iterator<Item = f64>, is_wanted: impl Fn(&f64) -> bool) -> Option<(usize, f64)> {
    values.enumerate().find(|(_, value)| is_wanted(value))
}

#[expect(clippy::cast_possible_truncation, reason = "32 bits are what the format has; overflow is refused")]
fn single(value: f64) -> f32 {
    value as f32
}

#[expect(clippy::cast_possible_truncation, reason = "the loss is what is tested")]
fn is_exact(index: i32) -> bool {
    single(f64::from(index)) as i32 == index
}

fn fill(line: &mut [[u8; 4]], samples: impl Iterator<Item = f32>) {
    for (bytes, sample) in line.iter_mut().zip(samples) {
        *bytes = sample.to_le_bytes();
    }
}

/// The blocks of an image.
struct Blocks<'m> {
    map: &'m Map,
    planes: &'m [Plane<'m>],
    /// A compressed block of full height without a surface: they are all the same.
    background: Option<Vec<u8>>,
}

/// The rows of each block, from the top.
fn all_rows(map: &Map) -> Vec<Range<usize>> {
    let height = map.region.size.height as usize;
    (0..height).step_by(ROWS).map(|first| first..(first + ROWS).min(height)).collect()
}

impl<'m> Blocks<'m> {
    fn new(map: &'m Map, planes: &'m [Plane<'m>]) -> io::Result<Self> {
        let mut blocks = Self { map, planes, background: None };
        if let Some(rows) = all_rows(map).into_iter().find(|rows| blocks.is_background(rows)) {
            blocks.background = Some(blocks.compress(&rows, &mut Scratch::new(BACKGROUND_LEVEL))?);
        }
        Ok(blocks)
    }

    fn is_background(&self, rows: &Range<usize>) -> bool {
        rows.len() == ROWS && self.runs(rows).is_empty()
    }

    /// The block as it goes into the file.
    fn compress(&self, rows: &Range<usize>, scratch: &mut Scratch) -> io::Result<Vec<u8>> {
        if let Some(compressed) = self.background.as_ref().filter(|_| self.is_background(rows)) {
            return Ok(compressed.clone());
        }
        self.store(rows, &mut scratch.plain);
        scratch.deflate()
    }

    /// The samples: row after row, in each row channel after channel.
    fn store(&self, rows: &Range<usize>, samples: &mut Vec<[u8; 4]>) {
        let width = self.map.region.size.width as usize;
        let mut runs = self.runs(rows);
        samples.clear();
        for row in rows.clone() {
            let here = runs.partition_point(|run| run.start < (row + 1) * width);
            let (in_row, below) = runs.split_at(here);
            for plane in self.planes {
                let first = samples.len();
                samples.extend(repeat_n(plane.background(), width));
                for run in in_row {
                    let line = &mut samples[first + run.start - row * width..first + run.end - row * width];
                    plane.store(run.start..run.end, line);
                }
            }
            runs = below;
        }
    }

    fn runs(&self, rows: &Range<usize>) -> &'m [Run] {
        let width = self.map.region.size.width as usize;
        let runs = self.map.mask().runs();
        let first = runs.partition_point(|run| run.start < rows.start * width);
        let end = runs.partition_point(|run| run.start < rows.end * width);
        &runs[first..end]
    }
}

/// What is worth keeping from one block to the next: new memory costs more than what is done to it.
struct Scratch {
    plain: Vec<[u8; 4]>,
    differences: Vec<u8>,
    compressed: Vec<u8>,
    deflate: Compress,
}

/// The brightness and the shape of a sphere in 3840×2160 pixels: 26 ms on one thread and 2.5 MB, with level 2 38 ms and
/// 2.3 MB, with level 6 76 ms and 2.3 MB. The file has 2.6 MB, with all channels 21.8; with the method `PIZ` these were
/// 3.1 and 24.2 MB.
const LEVEL: Compression = Compression::new(1);

/// Level 1 has no codes of its own for what there is: a block of one value takes several times the room.
const BACKGROUND_LEVEL: Compression = Compression::new(2);

impl Scratch {
    fn new(level: Compression) -> Self {
        Self { plain: vec![], differences: vec![], compressed: vec![], deflate: Compress::new(level, true) }
    }

    /// The plain samples as they go into the file: compressed, or as they are where that is not shorter.
    fn deflate(&mut self) -> io::Result<Vec<u8>> {
        let plain = self.plain.as_flattened();
        predict(plain, &mut self.differences);
        self.deflate.reset();
        self.compressed.clear();
        // No more room than the plain samples take: what needs more is not wanted.
        self.compressed.reserve_exact(plain.len());
        let status = self.deflate.compress_vec(&self.differences, &mut self.compressed, FlushCompress::Finish)?;
        let is_shorter = status == Status::StreamEnd && self.compressed.len() < plain.len();
        Ok(if is_shorter { self.compressed.clone() } else { plain.to_vec() })
    }
}

/// What the format compresses in place of the bytes: those at even places, then those at odd ones, of all but the first
/// the difference from the one before, plus 128.
fn predict(plain: &[u8], differences: &mut Vec<u8>) {
    let (pairs, _) = plain.as_chunks::<2>();
    differences.resize(plain.len(), 0);
    let (evens, odds) = differences.split_at_mut(pairs.len());
    let difference = |byte: u8, before: u8| byte.wrapping_sub(before).wrapping_add(128);
    if let (Some([even, odd]), Some([last, _])) = (pairs.first(), pairs.last()) {
        evens[0] = *even;
        odds[0] = difference(*odd, *last);
    }
    for ((even, odd), [before, pair]) in evens.iter_mut().zip(odds).skip(1).zip(pairs.array_windows()) {
        *even = difference(pair[0], before[0]);
        *odd = difference(pair[1], before[1]);
    }
}
