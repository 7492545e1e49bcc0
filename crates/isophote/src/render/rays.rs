//! Visibility by ray tracing: one ray through the centre of each pixel.

use super::band::{self, Band};
use super::hits::HitBlock;
use super::{Observer, RenderError};
use crate::camera::ScreenPosition;
use crate::map::{Pixel, Run};
use crate::prepare::{Hit, PreparedScene};

/// Fills a band, and returns what its pixels see.
pub fn fill(
    band: &mut Band<'_>,
    scene: &PreparedScene,
    asked_for: &[usize],
    observer: Option<&dyn Observer>,
) -> Result<Vec<Run>, RenderError> {
    let mut runs = Vec::new();
    let mut hits = HitBlock::new(scene, asked_for);
    let asks_often = scene.scene().lights().len() > 1000;
    for row in 0..band.size.height {
        for column in 0..band.size.width {
            if asks_often {
                band::advance(observer, 0)?;
            }
            let pixel = Pixel { column: band.first.column + column, row: band.first.row + row };
            if let Some(hit) = scene.trace_pixel(pixel) {
                put(pixel, &hit, band, &mut hits)?;
                band.see(pixel, 1, hit.primitive.shape, &mut runs);
            }
        }
        band::advance(observer, band.size.width.into())?;
    }
    hits.put(band)?;
    Ok(runs)
}

/// Traces again, with 32 digits, the pixels that are too close to call in double precision; returns those that see
/// something, with what they see.
pub fn retrace(
    scene: &PreparedScene,
    pixels: impl Iterator<Item = Pixel>,
    band: &mut Band<'_>,
    hits: &mut HitBlock<'_>,
) -> Result<Vec<(Pixel, usize)>, RenderError> {
    let mut seen = Vec::new();
    for pixel in pixels {
        if let Some(hit) = scene.trace_precisely(ScreenPosition::PixelCenter(pixel)).map(Hit::rounded) {
            put(pixel, &hit, band, hits)?;
            seen.push((pixel, hit.primitive.shape));
        }
    }
    Ok(seen)
}

/// Shades what the ray through the centre of a pixel hits, and writes it as soon as there is enough of it.
pub fn put(pixel: Pixel, hit: &Hit, band: &mut Band<'_>, hits: &mut HitBlock<'_>) -> Result<(), RenderError> {
    hits.push(band.index(pixel), hit, Some(ScreenPosition::PixelCenter(pixel)));
    if hits.is_full() { hits.put(band) } else { Ok(()) }
}
