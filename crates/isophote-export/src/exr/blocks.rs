//! The pixels of an EXR file: blocks of rows, compressed on several threads, written in order.
//!
//! The `exr` crate writes the rest of the file. Its own path from samples to blocks makes a call for every sample and a
//! copy of every channel, background or not: 1.7 s for all channels of a map of 3840×2160, before any compression.

use std::io;
use std::iter::repeat_n;
use std::num::NonZeroUsize;
use std::ops::Range;

use exr::block::chunk::{Chunk, CompressedBlock, CompressedScanLineBlock};
use exr::block::writer::{ChunkWriter, ChunksWriter};
use exr::error::UnitResult;
use isophote::map::{Map, Run};
use rayon::prelude::*;

use crate::exr::planes::Plane;
use crate::exr::scratch::{BACKGROUND_LEVEL, LEVEL, Scratch};

/// Rows per block in the format's `ZIP16`.
const ROWS: usize = 16;

/// Number of blocks compressed before they are written: enough to keep all threads busy until the end of a batch, and
/// little memory compared with the map.
const BATCH: usize = 32;

/// Writes all pixels. The bytes do not depend on the number of threads.
pub(super) fn write<W: io::Write + io::Seek>(
    map: &Map,
    planes: &[Plane<'_>],
    threads: NonZeroUsize,
    chunks: &mut ChunkWriter<W>,
) -> UnitResult {
    let mut workers = Workers::new(threads)?;
    let blocks = Blocks::new(map, planes)?;
    let first_line = map.region.corner.row.cast_signed();
    for batch in all_rows(map).chunks(BATCH) {
        let compressed = workers.compress(&blocks, batch)?;
        for (rows, bytes) in batch.iter().zip(compressed) {
            let y_coordinate = first_line + i32::try_from(rows.start).map_err(io::Error::other)?;
            let lines = CompressedScanLineBlock { y_coordinate, compressed_pixels_le: bytes };
            let chunk = Chunk { layer_index: 0, compressed_block: CompressedBlock::ScanLine(lines) };
            chunks.write_chunk(rows.start / ROWS, chunk)?;
        }
    }
    Ok(())
}

/// Where compression runs: on this thread, or in the writer's own pool, because rayon's shared pool has its own number
/// of threads.
enum Workers {
    Alone(Box<Scratch>),
    Together(rayon::ThreadPool),
}

impl Workers {
    fn new(threads: NonZeroUsize) -> io::Result<Self> {
        if threads == NonZeroUsize::MIN {
            return Ok(Self::Alone(Box::new(Scratch::new(LEVEL))));
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.get()).build();
        pool.map(Self::Together).map_err(io::Error::other)
    }

    fn compress(&mut self, blocks: &Blocks, batch: &[Range<usize>]) -> io::Result<Vec<Vec<u8>>> {
        match self {
            Self::Alone(scratch) => batch.iter().map(|rows| blocks.compress(rows, scratch)).collect(),
            Self::Together(pool) => pool.install(|| {
                let rows = batch.par_iter();
                rows.map_init(|| Scratch::new(LEVEL), |scratch, rows| blocks.compress(rows, scratch)).collect()
            }),
        }
    }
}

/// The blocks of an image.
struct Blocks<'m> {
    map: &'m Map,
    planes: &'m [Plane<'m>],
    /// A compressed full-height block without a surface: all such blocks are the same.
    background: Option<Vec<u8>>,
}

/// The rows of each block, from top to bottom.
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

    /// The block as stored in the file.
    fn compress(&self, rows: &Range<usize>, scratch: &mut Scratch) -> io::Result<Vec<u8>> {
        if let Some(compressed) = self.background.as_ref().filter(|_| self.is_background(rows)) {
            return Ok(compressed.clone());
        }
        self.store(rows, &mut scratch.plain);
        scratch.deflate()
    }

    /// The samples: row by row, and channel by channel within each row.
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
