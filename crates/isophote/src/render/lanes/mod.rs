//! Rows in lanes: the fast renderer.
//!
//! Shapes are found by their [outlines](crate::shape::Outline) instead of ray by ray; what they see is shaded several
//! pixels at a time. Pixels for which that is not exact enough are traced and summed one by one, as the reference does.

pub(super) mod kernel;
pub(super) mod lights;
mod points;
pub(super) mod power;
pub(super) mod visible;

use std::num::NonZeroUsize;
use std::sync::OnceLock;

use rayon::ThreadPool;
use rayon::prelude::*;

use self::kernel::BandJob;
pub use self::points::{PointKernel, PointValues};
use self::visible::Candidate;
use super::band::{self, Band};
use super::color;
use super::sampling::{self, Renders};
use super::tiles::{self, Tiles};
use super::{RenderError, RenderSettings, Renderer};
use crate::lanes::{Instructions, Precision};
use crate::map::{Map, Region, Run, Values};
use crate::outline::Outline;
use crate::prepare::PreparedScene;
use crate::shape::Primitive;
use crate::units::Keyword;

/// The fast renderer, on one thread or several. The bytes do not depend on how many.
pub struct SimdRenderer {
    precision: Precision,
    threads: usize,
    instructions: Instructions,
    pool: OnceLock<ThreadPool>,
}

impl SimdRenderer {
    /// A renderer of a precision on so many threads; as many as there are processors when unstated.
    #[must_use]
    pub fn new(precision: Precision, threads: Option<NonZeroUsize>) -> Self {
        // Told outright: the pool would otherwise take its size from an environment variable.
        let threads = threads.or_else(|| std::thread::available_parallelism().ok()).map_or(1, NonZeroUsize::get);
        Self { precision, threads, instructions: Instructions::best(), pool: OnceLock::new() }
    }

    /// The same renderer with these instructions instead of the machine's best.
    #[must_use]
    pub fn with_instructions(self, instructions: Instructions) -> Self {
        Self { instructions, ..self }
    }

    /// Whether a part of an image is done before other threads have woken up, so that nobody needs to wait for it on another
    /// thread, or to be able to stop it.
    #[must_use]
    pub fn is_quick(&self, scene: &PreparedScene, region: Region) -> bool {
        let description = scene.scene();
        let is_plain = !description.sampling().is_multisampled() && description.color().is_none();
        let is_known = |shape| !matches!(scene.outline(shape), Outline::Unknown);
        is_plain
            && !tiles::supports(scene)
            && (0..description.shapes().len()).all(is_known)
            && estimated_time(scene, region, false) < WORTH_THREADS
    }

    /// The threads, started when they are first needed.
    fn pool(&self) -> Result<&ThreadPool, RenderError> {
        if let Some(pool) = self.pool.get() {
            return Ok(pool);
        }
        let threads = self.threads;
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|error| RenderError::Threads { threads, reason: error.to_string() })?;
        Ok(self.pool.get_or_init(|| pool))
    }

    fn render_in(
        &self,
        memory: Vec<Values>,
        scene: &PreparedScene,
        settings: &RenderSettings<'_>,
    ) -> Result<Map, RenderError> {
        if scene.scene().sampling().is_multisampled() {
            let pool = if self.threads == 1 { None } else { Some(self.pool()?) };
            let centres = |threads| {
                move |memory, scene: &PreparedScene, settings: &RenderSettings<'_>| {
                    self.centres(memory, scene, settings, threads)
                }
            };
            sampling::render(scene, settings, pool, &Renders { parallel: &centres(self.threads), serial: &centres(1) })
        } else {
            self.centres(memory, scene, settings, self.threads)
        }
    }

    fn centres(
        &self,
        memory: Vec<Values>,
        scene: &PreparedScene,
        settings: &RenderSettings<'_>,
        threads: usize,
    ) -> Result<Map, RenderError> {
        let mut map = band::empty_map(scene, settings, self.name(), self.precision, memory)?;
        let uses_tiles = tiles::supports(scene);
        if uses_tiles {
            // Here, where all threads are free: those of the renderer would wait for each other.
            scene.accelerator();
        }
        let height = map.region.size.height;
        let order = lights::by_place(scene.scene().lights());
        let fill = |band: Band<'_>| {
            if uses_tiles {
                self.fill_by_tiles(band, scene, &order, settings)
            } else {
                self.fill_by_rows(band, scene, &order, settings)
            }
        };
        let runs = if threads == 1 || estimated_time(scene, map.region, uses_tiles) < WORTH_THREADS {
            let bands = band::split(&mut map, scene, height).into_iter();
            bands.map(fill).collect::<Result<Vec<_>, _>>()?
        } else {
            let parts = u32::try_from(threads).unwrap_or(u32::MAX).saturating_mul(BANDS_A_THREAD);
            let rows = if uses_tiles { tiles::HEIGHT } else { height.div_ceil(parts) };
            let bands = band::split(&mut map, scene, rows);
            self.pool()?.install(|| {
                let bands = bands.into_par_iter().with_max_len(1);
                bands.map(fill).collect::<Result<Vec<_>, _>>()
            })?
        };
        band::finish(&mut map, runs.into_iter().flatten().collect());
        Ok(map)
    }

    fn fill_by_tiles(
        &self,
        band: Band<'_>,
        scene: &PreparedScene,
        order: &[usize],
        settings: &RenderSettings<'_>,
    ) -> Result<Vec<Run>, RenderError> {
        let (precision, instructions) = (self.precision, self.instructions);
        Tiles { scene, order, precision, instructions, observer: settings.observer }.fill(band)
    }

    fn fill_by_rows(
        &self,
        mut band: Band<'_>,
        scene: &PreparedScene,
        order: &[usize],
        settings: &RenderSettings<'_>,
    ) -> Result<Vec<Run>, RenderError> {
        let observer = settings.observer;
        let rows = band.first.row..band.first.row + band.size.height;
        match Candidate::all(scene, rows) {
            Some(candidates) => {
                let job = BandJob { scene, band, candidates, order, precision: self.precision, observer };
                self.instructions.run(job)
            }
            None => band.render(scene, observer),
        }
    }
}

/// Work below this, in nanoseconds, is done before other threads have woken up.
const WORTH_THREADS: f64 = 200_000.0;

/// Bands for each thread: enough that none waits long for the last, few enough that their start costs nothing.
const BANDS_A_THREAD: u32 = 8;

/// About the time that one thread takes, in nanoseconds.
fn estimated_time(scene: &PreparedScene, region: Region, uses_tiles: bool) -> f64 {
    let pixels = f64::from(region.size.width) * f64::from(region.size.height);
    if uses_tiles {
        return 50.0 * pixels;
    }
    let covered = |shape| match scene.outline(shape) {
        Outline::Unseen => 0.0,
        Outline::Unknown => 20.0 * pixels,
        // Traced again with 32 digits, all of it.
        Outline::Ellipse(ellipse) if scene.doubtful_in_outline(Primitive { shape, part: 0 }).end.is_infinite() => {
            500.0 * ellipse.area().min(pixels)
        }
        Outline::Ellipse(ellipse) => ellipse.area().min(pixels),
    };
    let covered: f64 = (0..scene.scene().shapes().len()).map(covered).sum();
    #[expect(clippy::cast_precision_loss, reason = "an estimate")]
    let lights = scene.scene().lights().len() as f64;
    covered.min(500.0 * pixels) * (1.0 + 0.5 * lights)
}

impl Renderer for SimdRenderer {
    fn name(&self) -> String {
        // What makes other bytes has another name.
        let rounding = if self.instructions.fuse() { "" } else { " without fused multiply-add" };
        format!("{} precision, lanes{rounding}", self.precision.name())
    }

    fn render(&self, scene: &PreparedScene, settings: &RenderSettings<'_>) -> Result<Map, RenderError> {
        color::render(scene, settings, |scene, settings| self.render_in(Vec::new(), scene, settings))
    }

    fn render_again(
        &self,
        scene: &PreparedScene,
        settings: &RenderSettings<'_>,
        earlier: Map,
    ) -> Result<Map, RenderError> {
        if scene.components().is_some() {
            drop(earlier);
            return self.render(scene, settings);
        }
        self.render_in(band::recycle(earlier), scene, settings)
    }
}
