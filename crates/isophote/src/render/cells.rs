//! Maps whose cells are not pixels of a camera: points of shapes, or of planes that lie on none.

use super::band::{self, Band};
use super::hits::HitBlock;
use super::packets::{self, Packets};
use super::shading::emitters::Lighting;
use super::{Observer, RenderError};
use crate::lanes::Instructions;
use crate::map::{Map, Pixel, Run};
use crate::prepare::{Hit, PreparedScene};
use crate::shape::SurfacePoint;

/// What is at the centre of each cell, if anything.
pub enum Cells<'c> {
    /// Points of shapes, with their brightness as seen by the eye.
    OnShapes(&'c (dyn Fn(Pixel) -> Option<Hit> + Sync)),
    /// Points on no shape: only the light that arrives is computed.
    Free(&'c (dyn Fn(Pixel) -> Option<SurfacePoint> + Sync)),
}

/// Fills the maps of all layers; the cells belong to this shape. Without an instruction set, they are shaded one by one.
///
/// # Errors
/// The observer's wish to end.
pub fn fill(
    layers: &mut [Map],
    (scene, shape): (&PreparedScene, usize),
    cells: &Cells<'_>,
    instructions: Option<Instructions>,
    observer: Option<&dyn Observer>,
) -> Result<(), RenderError> {
    let asked_for = band::asked_for(&layers[0], scene);
    let lighting = Lighting::new(scene, &asked_for);
    let shape = u32::try_from(shape).unwrap_or(band::NOTHING);
    let instructions =
        instructions.filter(|instructions| packets::ARE_COMPILED && packets::supports(scene, *instructions));
    let fill = |band: Band<'_>| match instructions {
        Some(instructions) => {
            let packets = Packets { scene, lighting: &lighting, asked_for: &asked_for, instructions };
            packets.fill_cells(band, shape, cells, observer)
        }
        None => one_by_one(band, (scene, shape), &asked_for, cells, observer),
    };
    let bands = band::split(layers, packets::SIDE);
    let runs: Vec<Vec<Run>> = scene.threads().map::<_, _, Result<_, RenderError>>(bands, fill)?;
    band::finish(layers, runs.into_iter().flatten().collect());
    Ok(())
}

fn one_by_one(
    mut band: Band<'_>,
    (scene, shape): (&PreparedScene, u32),
    asked_for: &[usize],
    cells: &Cells<'_>,
    observer: Option<&dyn Observer>,
) -> Result<Vec<Run>, RenderError> {
    let mut hits = HitBlock::new(scene, asked_for);
    let mut seen = vec![band::NOTHING; band.size.pixels()];
    for (index, seen) in seen.iter_mut().enumerate() {
        let pixel = band.pixel(index);
        match cells {
            Cells::OnShapes(cell) => match cell(pixel) {
                Some(hit) => hits.push(index, &hit, None),
                None => continue,
            },
            Cells::Free(cell) => match cell(pixel) {
                Some(point) => hits.push_free(index, &point),
                None => continue,
            },
        }
        *seen = shape;
        if hits.is_full() {
            band::advance(observer, hits.len() as u64)?;
            hits.put(&mut band)?;
        }
    }
    band::advance(observer, hits.len() as u64)?;
    hits.put(&mut band)?;
    Ok(band.runs(&seen))
}
