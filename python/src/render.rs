//! Rendering.

use std::num::NonZeroUsize;
use std::sync::{Arc, Mutex, PoisonError};

use isophote::lanes::Precision;
use isophote::map::{Pixel, Region, Resolution};
use isophote::render::{RenderSettings, Renderer, SimdRenderer};
use pyo3::prelude::*;

use crate::error;
use crate::job::{self, Progress};
use crate::map::Map;
use crate::names::{keyword, quantities};
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
    let renderer = renderer(py, keyword(py, "precision", precision)?, threads)?;
    let region = region.map_or_else(|| Region::all(scene.core().camera().resolution), region_of);
    let content = scene.content();
    let total = region.size.count();
    // Waiting for another thread would take longer than rendering many a small map.
    let progress = Progress { function: progress, total };
    let quick = content.prepared_at_once().filter(|prepared| renderer.is_quick(prepared, region));
    let map = if let Some(prepared) = quick {
        let settings = RenderSettings { region: Some(region), quantities, observer: None };
        job::run_here(py, &progress, || renderer.render(&prepared, &settings))?
    } else {
        job::run(py, &progress, move |watch| {
            let settings = RenderSettings { region: Some(region), quantities, observer: Some(watch) };
            renderer.render(&content.prepared(), &settings)
        })?
    };
    Ok(Map::new(map.map_err(|error| error::of_render(py, &error))?))
}

fn region_of([column, row, width, height]: [u32; 4]) -> Region {
    Region { corner: Pixel { column, row }, size: Resolution { width, height } }
}

/// Renderers keep their threads, which take longer to start than a small map takes to render. The ones kept are those
/// for the machine's number of threads and for the last other number; per process, because a forked process has none of
/// its parent's threads.
///
/// The lock is only ever held by a thread that holds the interpreter's lock, so it is free in a forked process.
fn renderer(py: Python<'_>, precision: Precision, threads: Option<NonZeroUsize>) -> PyResult<Arc<SimdRenderer>> {
    type Key = (u32, Precision, Option<NonZeroUsize>);
    static RENDERERS: Mutex<Vec<(Key, Arc<SimdRenderer>)>> = Mutex::new(Vec::new());
    if let Some(threads) = threads.filter(|threads| threads.get() > MOST_THREADS) {
        return Err(error::value(py, format!("threads is {threads}; allowed: 1 to {MOST_THREADS}")));
    }
    let process = std::process::id();
    let key = (process, precision, threads);
    let mut renderers = RENDERERS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, renderer)) = renderers.iter().find(|(known, _)| *known == key) {
        return Ok(Arc::clone(renderer));
    }
    if threads.is_some() {
        // (Those of a parent stay: their threads cannot be ended from here.)
        renderers
            .retain(|((of, _, threads), _)| *of != process || threads.is_none() || *threads == Some(NonZeroUsize::MIN));
    }
    let renderer = Arc::new(SimdRenderer::new(precision, threads));
    renderers.push((key, Arc::clone(&renderer)));
    Ok(renderer)
}

/// More threads would only wait for each other.
const MOST_THREADS: usize = 1024;
