//! Maps whose cells are not pixels of a camera.

use crate::lanes::Precision;
use crate::map::{Map, Pixel, Quantity, Region, Resolution, Run, Window};
use crate::prepare::{Hit, PreparedScene};
use crate::render::band::{self, Band, Sheet};
use crate::render::hits::HitBlock;
use crate::render::layers;
use crate::render::{Observer, RenderError};
use crate::shape::SurfacePoint;

/// What is at the centre of a cell.
pub(super) enum Cell {
    /// A point of a shape, with its brightness as seen by the eye.
    OnShape(Hit),
    /// A point on no shape: only the light that arrives is computed.
    Free(SurfacePoint),
}

/// The layout of a map of cells.
pub(super) struct Layout {
    pub(super) size: Resolution,
    pub(super) window: Window,
    /// What the map shows, and how it was computed.
    pub(super) renderer: String,
    /// Index of the shape that all cells belong to.
    pub(super) shape: usize,
}

/// Builds the map from the cells. Cells without a value are left out of the mask.
///
/// # Errors
/// A light that the scene does not have, or the observer's wish to end.
pub(super) fn map(
    scene: &PreparedScene,
    layout: Layout,
    quantities: &[Quantity],
    observer: Option<&dyn Observer>,
    cell: impl Fn(Pixel) -> Option<Cell> + Sync + Send,
) -> Result<Map, RenderError> {
    let Layout { size, window, renderer, shape } = layout;
    let sheet = Sheet { full: size, region: Region::all(size), window, whole: window, renderer };
    let mut layers = band::empty_layers(scene, &sheet, quantities, Precision::Double, Vec::new())?;
    let asked_for = band::asked_for(&layers[0], scene);
    let fill = |mut band: Band<'_>| {
        let mut hits = HitBlock::new(scene, &asked_for);
        let mut runs = Vec::new();
        for index in 0..band.size.pixels() {
            let pixel = band.pixel(index);
            let Some(cell) = cell(pixel) else { continue };
            match cell {
                Cell::OnShape(hit) => hits.push(index, &hit, None),
                Cell::Free(point) => hits.push_free(index, &point),
            }
            band.see(pixel, 1, shape, &mut runs);
            if hits.is_full() {
                band::advance(observer, hits.len() as u64)?;
                hits.put(&mut band)?;
            }
        }
        band::advance(observer, hits.len() as u64)?;
        hits.put(&mut band)?;
        Ok(runs)
    };
    let runs: Vec<Vec<Run>> = scene.threads().map::<_, _, Result<_, RenderError>>(band::split(&mut layers, 1), fill)?;
    band::finish(&mut layers, runs.into_iter().flatten().collect());
    Ok(layers::combined(scene, quantities, layers))
}
