//! A small picture of the whole map, made shard by shard.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use isophote::map::{Map, Provenance, Quantity, Region, Resolution, Values};
use isophote_export::FileMetadata;
use isophote_export::png::{self, PictureOptions};

use crate::error::StoreError;

/// The longest side of the picture in pixels.
const LONGEST: u32 = 1024;

/// How the image is divided into boxes, each of which becomes one pixel.
#[derive(Clone, Copy)]
pub struct Boxes {
    full: Resolution,
    side: u32,
}

/// Sums over boxes.
pub struct Preview {
    boxes: Boxes,
    size: Resolution,
    sums: Vec<f64>,
}

impl Boxes {
    /// The smallest boxes that keep each side of the picture within [`LONGEST`] pixels.
    pub fn new(full: Resolution) -> Self {
        Self { full, side: full.width.max(full.height).div_ceil(LONGEST) }
    }

    /// The boxes that a region touches: the first one, and the number of columns and rows.
    fn of(self, region: Region) -> Region {
        let meets = |start: u32, length: u32| [start / self.side, (start + length - 1) / self.side];
        let [left, right] = meets(region.corner.column, region.size.width);
        let [top, bottom] = meets(region.corner.row, region.size.height);
        Region {
            corner: isophote::map::Pixel { column: left, row: top },
            size: Resolution { width: right - left + 1, height: bottom - top + 1 },
        }
    }

    /// A shard's part of the sums as text: 32-bit numbers are more precise than a picture shows; empty if all are 0.
    pub fn part(self, map: &Map, quantity: &Quantity) -> String {
        let runs = map.mask().runs();
        let Some(values) = map.scalar(quantity).filter(|_| !runs.is_empty()) else { return String::new() };
        let boxes = self.of(map.region);
        let mut sums = vec![0.0_f64; boxes.size.pixels()];
        let side = self.side as usize;
        for run in runs {
            let pixel = map.pixel(run.start);
            let row = (pixel.row as usize / side - boxes.corner.row as usize) * boxes.size.width as usize;
            let first = pixel.column as usize;
            let end = first + (run.end - run.start);
            let mut start = first;
            while start < end {
                let column = start / side;
                let next = ((column + 1) * side).min(end);
                let sum: f64 = (start - first..next - first).map(|index| values.at(run.start + index)).sum();
                sums[row + column - boxes.corner.column as usize] += sum;
                start = next;
            }
        }
        #[expect(clippy::cast_possible_truncation, reason = "for a picture; a sum too large becomes infinite")]
        let bytes: Vec<u8> = sums.iter().flat_map(|&sum| (sum as f32).to_le_bytes()).collect();
        STANDARD.encode(bytes)
    }
}

impl Preview {
    pub fn new(boxes: Boxes) -> Self {
        let size = boxes.of(Region::all(boxes.full)).size;
        Self { boxes, size, sums: vec![0.0; size.pixels()] }
    }

    /// Adds a shard's part; an error if it does not match the region.
    pub fn add(&mut self, region: Region, part: &str) -> Result<(), String> {
        if part.is_empty() {
            return Ok(());
        }
        let bytes = STANDARD.decode(part).map_err(|error| error.to_string())?;
        let Region { corner, size } = self.boxes.of(region);
        if bytes.len() != size.pixels() * 4 {
            return Err(format!("{} bytes for {}×{} boxes", bytes.len(), size.width, size.height));
        }
        let mut sums = bytes.chunks_exact(4).map(|four| f32::from_le_bytes([four[0], four[1], four[2], four[3]]));
        for row in corner.row..corner.row + size.height {
            let start = row as usize * self.size.width as usize + corner.column as usize;
            for total in &mut self.sums[start..start + size.width as usize] {
                *total += f64::from(sums.next().unwrap_or_default());
            }
        }
        Ok(())
    }

    /// The picture as a PNG that carries the scene; it shows nothing for a channel that is not a scalar.
    pub fn to_png(&self, metadata: &FileMetadata, quantity: &Quantity, unit: &str) -> Result<Vec<u8>, StoreError> {
        let means: Vec<f64> = self.sums.iter().enumerate().map(|(index, sum)| sum / self.pixels(index)).collect();
        let seen = means.iter().map(|mean| if *mean == 0.0 { -1 } else { 0 }).collect();
        let provenance = Provenance {
            program: metadata.program.clone(),
            title: metadata.title.clone(),
            scene: metadata.scene.clone(),
            files: metadata.files.clone(),
            convention: metadata.convention.clone(),
            renderer: metadata.renderer.clone(),
            color_space: metadata.color_space.clone(),
        };
        let builder = Map::builder(self.size, metadata.window, provenance).shapes(seen);
        let map = builder.channel(quantity.clone(), unit, Values::Scalar(means)).build();
        let map = map.map_err(|error| StoreError::Encode { quantity: quantity.clone(), reason: error.to_string() })?;
        let mut bytes = Vec::new();
        png::write(&map, &PictureOptions::new(quantity.clone()), &mut bytes)?;
        Ok(bytes)
    }

    /// Pixels in a box: boxes at the right and lower edges extend past the image.
    fn pixels(&self, index: usize) -> f64 {
        let Boxes { full, side } = self.boxes;
        #[expect(clippy::cast_possible_truncation, reason = "a preview has at most 1024 columns and rows")]
        let [column, row] =
            [index % self.size.width as usize, index / self.size.width as usize].map(|place| place as u32);
        f64::from(side.min(full.width - column * side)) * f64::from(side.min(full.height - row * side))
    }
}
