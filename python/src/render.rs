//! Rendering.

use std::collections::HashMap;
use std::num::NonZeroUsize;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use isophote::lanes::Precision;
use isophote::map::{Pixel, Quantity, Region, Resolution};
use isophote::render::{Lanes, RenderSettings, Renderer};
use isophote::units::Choice;
use pyo3::prelude::*;

use crate::error;
use crate::job::{self, Progress};
use crate::map::Map;
use crate::scene::Scene;

/// Renders a scene. `region` is column, row, width, height.
#[pyfunction]
#[pyo3(signature = (scene, channels, precision, region, threads, progress))]
pub fn render(
    py: Python<'_>,
    scene: &Scene,
    channels: Vec<String>,
    precision: &str,
    region: Option<[u32; 4]>,
    threads: Option<NonZeroUsize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Map> {
    let quantities = quantities(py, &channels)?;
    let renderer = renderer(self::precision(py, precision)?, threads);
    let region = region.map_or_else(|| Region::all(scene.core().camera().resolution), region_of);
    let prepared = scene.prepared();
    let total = region.size.pixels() as u64;
    // Waiting for another thread would take longer than many a small map.
    let progress = Progress { function: progress, total };
    let map = if renderer.is_quick(&prepared, region) {
        let settings = RenderSettings { region: Some(region), quantities, observer: None };
        job::run_here(py, &progress, || renderer.render(&prepared, &settings))?
    } else {
        job::run(py, &progress, move |watch| {
            renderer.render(&prepared, &RenderSettings { region: Some(region), quantities, observer: Some(watch) })
        })?
    };
    Ok(Map::new(map.map_err(|error| error::of_render(py, &error))?))
}

fn region_of([column, row, width, height]: [u32; 4]) -> Region {
    Region { corner: Pixel { column, row }, size: Resolution { width, height } }
}

pub fn precision(py: Python<'_>, name: &str) -> PyResult<Precision> {
    let unknown = || error::value(py, format!("there is no precision \"{name}\"; allowed: double, single"));
    Precision::from_name(name).ok_or_else(unknown)
}

/// Channels by their names. Whether the scene has the lights in them is checked by the work itself.
pub fn quantities(py: Python<'_>, names: &[String]) -> PyResult<Vec<Quantity>> {
    let quantity = |name: &String| {
        let known = Quantity::COMMON.iter().chain(&Quantity::OF_SAMPLING).chain([&Quantity::Color]);
        let allowed = || known.map(Quantity::name).collect::<Vec<_>>().join(", ");
        Quantity::from_name(name).ok_or_else(|| {
            error::value(py, format!("there is no channel \"{name}\"; allowed: {}, light.NAME", allowed()))
        })
    };
    names.iter().map(quantity).collect()
}

/// Renderers keep their threads, which take longer to start than a small map to render: one for each number of threads,
/// and process, for a forked one has none of its parent's threads.
///
/// The lock is only ever held by who holds the interpreter's, so that it is free in a forked process.
fn renderer(precision: Precision, threads: Option<NonZeroUsize>) -> Arc<Lanes> {
    type Renderers = HashMap<(u32, Precision, Option<NonZeroUsize>), Arc<Lanes>>;
    static RENDERERS: OnceLock<Mutex<Renderers>> = OnceLock::new();
    let mut renderers = RENDERERS.get_or_init(Mutex::default).lock().unwrap_or_else(PoisonError::into_inner);
    let key = (std::process::id(), precision, threads);
    Arc::clone(renderers.entry(key).or_insert_with(|| Arc::new(Lanes::new(precision, threads))))
}
