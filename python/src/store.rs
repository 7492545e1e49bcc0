//! Maps larger than memory.

use std::num::{NonZeroU32, NonZeroUsize};
use std::path::{Path, PathBuf};

use isophote::analysis::statistics::Extreme;
use isophote::lanes::Precision;
use isophote::map::Quantity;
use isophote::prepare::PreparedScene;
use isophote::render::SimdRenderer;
use isophote_zarr::{Check, MapStatistics, Opening, Part, Request, Store, StoreError, Workers};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error;
use crate::job::{self, Progress, Watch};
use crate::names::{keyword, quantities};
use crate::scene::Scene;

/// What goes into a store, and how.
struct Plan {
    path: PathBuf,
    /// Without duplicates, in the package's order.
    quantities: Vec<Quantity>,
    precision: Precision,
    shard_side: Option<NonZeroU32>,
}

impl Plan {
    /// Each worker renders on its own thread, as the store requires.
    fn renderer(&self) -> SimdRenderer {
        SimdRenderer::new(self.precision, Some(NonZeroUsize::MIN))
    }

    fn open(
        &self,
        scene: &PreparedScene,
        part: Option<Part>,
        opening: Opening,
        workers: Option<Workers>,
    ) -> Result<Store, StoreError> {
        let request =
            Request { quantities: self.quantities.clone(), opening, part, shard_side: self.shard_side, workers };
        Store::prepare(&self.path, scene, &self.renderer(), &request)
    }
}

/// Creates a store, or opens it if it may be resumed; returns the indices of the shards that are not done, and the
/// total.
#[pyfunction]
#[pyo3(signature = (scene, path, channels, precision, shard_side, resume))]
pub fn store_prepare(
    py: Python<'_>,
    scene: &Scene,
    path: PathBuf,
    channels: Vec<String>,
    precision: &str,
    shard_side: Option<NonZeroU32>,
    resume: bool,
) -> PyResult<(Vec<u64>, u64)> {
    let plan = plan(py, path, &channels, precision, shard_side)?;
    let content = scene.content();
    let opening = if resume { Opening::Continue } else { Opening::New };
    let found = job::run_to_its_end(py, &Progress::none(), move |_| {
        let prepared = content.prepared();
        let store = plan.open(&prepared, None, opening, None)?;
        Ok((store.due(None).map(|(number, _)| number).collect(), store.plan().count()))
    })?;
    found.map_err(|error| error::of_store(py, &error))
}

/// Renders one shard of a store, or all remaining ones.
#[pyfunction]
#[pyo3(signature = (scene, path, channels, precision, shard_side, shard, threads, memory, progress))]
pub fn store_render(
    py: Python<'_>,
    scene: &Scene,
    path: PathBuf,
    channels: Vec<String>,
    precision: &str,
    shard_side: Option<NonZeroU32>,
    shard: Option<[u32; 2]>,
    threads: Option<NonZeroUsize>,
    memory: Option<u64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<()> {
    let plan = plan(py, path, &channels, precision, shard_side)?;
    let part = shard.and_then(|[number, count]| Part::new(number + 1, count));
    let threads = threads.or_else(|| std::thread::available_parallelism().ok()).unwrap_or(NonZeroUsize::MIN);
    let content = scene.content();
    let resolution = scene.core().camera().resolution;
    let total = u64::from(resolution.width) * u64::from(resolution.height);
    let outcome = job::run_to_its_end(py, &Progress { function: progress, total }, move |watch| {
        let prepared = content.prepared();
        let workers = Workers { threads, memory, used: 0 };
        let store = plan.open(&prepared, part, Opening::Continue, Some(workers))?;
        store.render(&prepared, &plan.renderer(), workers, part, Some(watch))
    })?;
    outcome.map(|_| ()).map_err(|error| error::of_store(py, &error))
}

/// Merges the parts of a store; with `check` every byte is read.
#[pyfunction]
pub fn store_merge(py: Python<'_>, path: PathBuf, check: bool) -> PyResult<Bound<'_, PyDict>> {
    let check = if check { Check::Content } else { Check::Presence };
    let merged = job::run_to_its_end(py, &Progress::none(), move |watch| merge(&path, check, watch))?;
    described(py, &merged.map_err(|error| error::of_store(py, &error))?)
}

fn merge(path: &Path, check: Check, watch: &Watch) -> Result<MapStatistics, StoreError> {
    Store::open(path)?.merge_observed(check, Some(watch))
}

fn plan(
    py: Python<'_>,
    path: PathBuf,
    channels: &[String],
    precision: &str,
    shard_side: Option<NonZeroU32>,
) -> PyResult<Plan> {
    let (quantities, precision) = (quantities(py, channels)?, keyword(py, "precision", precision)?);
    Ok(Plan { path, quantities, precision, shard_side })
}

fn described<'py>(py: Python<'py>, statistics: &MapStatistics) -> PyResult<Bound<'py, PyDict>> {
    let described = PyDict::new(py);
    described.set_item("pixels", statistics.pixels)?;
    described.set_item("visible", statistics.visible)?;
    described.set_item("lit", statistics.lit)?;
    let channels = PyDict::new(py);
    let place = |extreme: Extreme| (extreme.value, [extreme.pixel.column, extreme.pixel.row]);
    for channel in &statistics.channels {
        let of = channel.statistics.map(|of| (place(of.min), place(of.max), of.mean));
        channels.set_item(channel.quantity.name(), of)?;
    }
    described.set_item("channels", channels)?;
    Ok(described)
}
