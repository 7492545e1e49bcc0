//! Pixels as means over their area instead of values at their centres.

mod apply;
mod bands;
mod cut;
mod edge;
mod fixed;
mod narrow;
mod outlined;
mod pattern;
mod refine;
mod rule;
mod tracer;
mod uncertain;

use std::ops::Range;

use self::narrow::Narrow;
use self::outlined::{Nodes, Outlined};
use self::pattern::Patterns;
use self::refine::{Averages, Refinement, Refiner, Wanted};
use self::tracer::SampleTracer;
use self::uncertain::{Finder, Suspects, uncertain_in_rows};
use super::band::{self, advance};
use super::shading::emitters::Lighting;
use super::{RenderError, RenderSettings};
use crate::lanes::Instructions;
use crate::map::{Channel, Map, Mask, Pixel, Quantity, Region, Resolution, Values, totals};
use crate::prepare::PreparedScene;
use crate::threads::Threads;

/// The first samples of an uncertain pixel: enough to estimate how much its values differ.
const FIRST_SAMPLES: u32 = 16;

/// Where pixels are integrated, fewer than this are done before another thread has woken up.
const WORTH_THREADS: usize = 20_000;

/// How many rings of pixels around one decide whether it is uncertain: its neighbours, and theirs.
const NEIGHBOURS: u32 = 2;

/// The number of rows that one thread searches and refines at a time.
const ROWS: usize = 16;

/// Renders the centres of pixels in every layer, reusing memory of earlier maps if there is any.
pub type Centres<'c> =
    dyn Fn(Vec<Values>, &PreparedScene, &RenderSettings<'_>) -> Result<Vec<Map>, RenderError> + Sync + 'c;

/// What renders the centres of pixels.
pub struct Renders<'c> {
    /// On all threads.
    pub parallel: &'c Centres<'c>,
    /// On the calling thread.
    pub serial: &'c Centres<'c>,
    /// The instruction set for samples; without one, they are traced one by one.
    pub instructions: Option<Instructions>,
}

/// Renders means over pixels: of as many samples as the scene asks for, or of more where the value is uncertain.
///
/// The result does not depend on the region or the number of threads: a pixel's value depends on its neighbours and on the
/// scene as a whole, never on what else is computed.
pub fn render(
    scene: &PreparedScene,
    settings: &RenderSettings<'_>,
    threads: &Threads,
    renders: &Renders<'_>,
) -> Result<Vec<Map>, RenderError> {
    let sampling = scene.scene().sampling();
    let reach = sampling.filter.reach();
    let full = scene.scene().camera().resolution;
    let region = settings.region.unwrap_or(Region::all(full));
    band::check(region, full)?;
    let wide = RenderSettings { region: Some(grown(region, reach, full)), ..settings.clone() };
    let layers = match sampling.tolerance {
        Some(tolerance) => refined(scene, &wide, (tolerance, region), threads, renders)?,
        None => fixed::render(scene, &wide, threads, renders)?,
    };
    let finish = |map| {
        let mut map = cropped(map, region, scene);
        let is_wanted = |quantity: &Quantity| settings.quantities.contains(quantity);
        map.retain(|quantity| is_wanted(quantity) || *quantity == Quantity::Brightness && is_wanted(&Quantity::Color));
        map.provenance.renderer = format!("{}, {}", map.provenance.renderer, sampling.describe());
        map
    };
    Ok(layers.into_iter().map(finish).collect())
}

/// The centres of a region, with the uncertain pixels refined. Those over the tolerance are counted in the part `counted`.
fn refined(
    scene: &PreparedScene,
    settings: &RenderSettings<'_>,
    (tolerance, counted): (f64, Region),
    threads: &Threads,
    renders: &Renders<'_>,
) -> Result<Vec<Map>, RenderError> {
    let sampling = scene.scene().sampling();
    let full = scene.scene().camera().resolution;
    let region = settings.region.unwrap_or(Region::all(full));
    let mut quantities = settings.quantities.clone();
    quantities.push(Quantity::Brightness);
    let wide = RenderSettings { region: Some(grown(region, NEIGHBOURS, full)), quantities, ..settings.clone() };
    let mut layers = (renders.parallel)(Vec::new(), scene, &wide)?;
    let tolerances: Vec<f64> = peaks(scene, renders)?.into_iter().map(|peak| tolerance * peak).collect();
    let averages: Vec<Averages> = layers.iter().map(Averages::of).collect();
    let asked_for = band::asked_for(&layers[0], scene);
    let lighting = Lighting::new(scene, &asked_for);
    let (patterns, offsets) = (Patterns::new(sampling.samples), refine::offsets(sampling.filter));
    let wanted =
        Wanted { averages: &averages, sampling, patterns: &patterns, offsets: &offsets, tolerances: &tolerances };
    let outlined = Outlined::new(scene, &wanted, &asked_for, refine::has_geometry(&layers[0]));
    let finders: Vec<Finder<'_>> =
        layers.iter().zip(&tolerances).map(|(map, tolerance)| Finder::new(map, region, *tolerance)).collect();
    let narrow = Narrow::new(scene, &layers[0], region, &finders, &tolerances);
    let narrow = narrow.find(&asked_for, threads, settings.observer)?;
    let refine = |rows: Range<usize>| {
        let (mut nodes, mut suspects) = (Nodes::new(asked_for.len()), Suspects::default());
        let (mut refined, mut left) = (Vec::new(), Vec::new());
        for uncertain in uncertain_in_rows(&finders, &narrow, rows, &mut suspects) {
            let pixel = layers[0].pixel(uncertain.index);
            if outlined.as_ref().is_some_and(|outlined| outlined.is_missed_by_all(pixel, &uncertain)) {
                continue;
            }
            advance(settings.observer, 0)?;
            match outlined.as_ref().and_then(|outlined| outlined.mean(&mut nodes, pixel, &uncertain)) {
                Some(mean) => refined.push(mean),
                None => left.push((pixel, uncertain)),
            }
        }
        if !left.is_empty() {
            let tracer = SampleTracer::new(scene, &lighting, &asked_for, renders.instructions);
            let mut refiner = Refiner { tracer, wanted: &wanted };
            refined.extend(refiner.refine(left.into_iter(), || advance(settings.observer, 0))?);
            refined.sort_unstable_by_key(|refinement| refinement.index);
        }
        Ok(refined)
    };
    let first = (region.corner.row - layers[0].region.corner.row) as usize;
    let last = first + region.size.height as usize;
    let parts: Vec<Range<usize>> = (first..last).step_by(ROWS).map(|row| row..(row + ROWS).min(last)).collect();
    let is_worth_threads = outlined.is_none() || layers[0].mask.visible() > WORTH_THREADS;
    let refined: Vec<Vec<Refinement>> = if is_worth_threads {
        threads.start()?;
        threads.map::<_, _, Result<_, RenderError>>(parts, refine)?
    } else {
        parts.into_iter().map(refine).collect::<Result<_, RenderError>>()?
    };
    let refined: Vec<Refinement> = refined.into_iter().flatten().collect();
    let is_over = |refinement: &&Refinement| {
        let pixel = layers[0].pixel(refinement.index);
        let mut errors = refinement.error_bounds.iter().zip(&tolerances);
        counted.contains(pixel) && errors.any(|(bound, tolerance)| bound > tolerance)
    };
    let over_tolerance = refined.iter().filter(is_over).count();
    for (layer, (map, averages)) in layers.iter_mut().zip(&averages).enumerate() {
        apply::apply((layer, map), averages, sampling.filter, &refined)?;
        map.over_tolerance = Some(over_tolerance);
    }
    Ok(layers)
}

/// The least and the greatest of some values.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, greatest], value| [least.min(value), greatest.max(value)])
}

/// A region grown by this many pixels on every side, as far as the image extends.
fn grown(region: Region, by: u32, full: Resolution) -> Region {
    let Region { corner, size } = region;
    let first = |start: u32| start.saturating_sub(by);
    let last = |start: u32, size: u32, whole: u32| (start + size).saturating_add(by).min(whole);
    let corner_of_grown = Pixel { column: first(corner.column), row: first(corner.row) };
    let width = last(corner.column, size.width, full.width) - corner_of_grown.column;
    let height = last(corner.row, size.height, full.height) - corner_of_grown.row;
    Region { corner: corner_of_grown, size: Resolution { width, height } }
}

/// The longer side of the small image that is rendered to estimate how bright a scene is.
const GLANCE: u32 = 96;

/// Roughly the largest brightness of the whole image in each layer, whatever the region: that of a small image of the scene.
fn peaks(scene: &PreparedScene, renders: &Renders<'_>) -> Result<Vec<f64>, RenderError> {
    let full = scene.scene().camera().resolution;
    let longer = f64::from(full.width.max(full.height));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most the side it had")]
    let side = |side: u32| ((f64::from(side) * f64::from(GLANCE) / longer).ceil() as u32).clamp(1, side);
    let small = scene.at_resolution(Resolution { width: side(full.width), height: side(full.height) });
    let settings = RenderSettings { quantities: vec![Quantity::Brightness], ..RenderSettings::default() };
    let layers = (renders.parallel)(Vec::new(), &small, &settings)?;
    let peak = |map| totals(map, &Quantity::Brightness).map_or(0.0, |totals| totals.max.value);
    Ok(layers.iter().map(peak).collect())
}

/// A part of a map.
fn cropped(map: Map, region: Region, scene: &PreparedScene) -> Map {
    if map.region == region {
        return map;
    }
    let outer = map.region;
    let left = (region.corner.column - outer.corner.column) as usize;
    let top = (region.corner.row - outer.corner.row) as usize;
    let (width, outer_width) = (region.size.width as usize, outer.size.width as usize);
    let rows = || (top..top + region.size.height as usize).map(|row| row * outer_width + left);
    let channels = map.channels.into_iter().map(|Channel { quantity, unit, values }| {
        let values = match values {
            Values::Scalar(values) => Values::Scalar(part(&values, rows(), width)),
            Values::Single(values) => Values::Single(part(&values, rows(), width)),
            Values::Vector(values) => Values::Vector(part(&values, rows(), width)),
            Values::Index(values) => Values::Index(part(&values, rows(), width)),
        };
        Channel { quantity, unit, values }
    });
    let mask = Mask::of_shapes(region.size, &part(&map.mask.shapes(), rows(), width));
    let window = scene.scene().camera().window(region, scene.scene().length());
    Map { region, window, mask, channels: channels.collect(), ..map }
}

/// `width` values from each start.
fn part<T: Copy>(values: &[T], starts: impl Iterator<Item = usize>, width: usize) -> Vec<T> {
    starts.flat_map(|start| values[start..start + width].iter().copied()).collect()
}
