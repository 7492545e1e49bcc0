//! The fast renderer: it chooses how visibility is found (by rows, tiles or packets), and cuts the work into bands for its
//! threads.

use std::num::NonZeroUsize;

use super::band::{self, Band, Sheet};
use super::packets::{self, Packets};
use super::rows::{Candidate, RowsJob};
use super::sampling::{self, Renders};
use super::shading::emitters::Lighting;
use super::tiles::{self, Tiles};
use super::{RenderError, RenderSettings, Renderer, derived, layers, rays};
use crate::lanes::{Instructions, Precision};
use crate::map::{Map, Region, Run, Values};
use crate::outline::Outline;
use crate::prepare::PreparedScene;
use crate::shape::Primitive;
use crate::threads::Threads;
use crate::units::Keyword;

/// The fast renderer, on one thread or several. The output bytes do not depend on the number of threads.
pub struct SimdRenderer {
    precision: Precision,
    threads: Threads,
    instructions: Instructions,
}

/// The data that all bands of a map share.
struct Work<'w> {
    scene: &'w PreparedScene,
    settings: &'w RenderSettings<'w>,
    lighting: Lighting,
    asked_for: Vec<usize>,
    uses_tiles: bool,
}

impl SimdRenderer {
    /// A renderer with this precision and number of threads; one thread per processor when `None`.
    #[must_use]
    pub fn new(precision: Precision, threads: Option<NonZeroUsize>) -> Self {
        Self { precision, threads: Threads::new(threads), instructions: Instructions::best() }
    }

    /// The same renderer with this instruction set instead of the machine's best.
    #[must_use]
    pub fn with_instructions(self, instructions: Instructions) -> Self {
        Self { instructions, ..self }
    }

    /// Whether part of an image is done before other threads would have woken up, so that there is no need to wait for it on
    /// another thread, or to be able to stop it.
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

    fn render_in(
        &self,
        memory: Vec<Values>,
        scene: &PreparedScene,
        settings: &RenderSettings<'_>,
    ) -> Result<Map, RenderError> {
        let layers = if scene.scene().sampling().is_multisampled() {
            let centres = |threads| {
                move |memory, scene: &PreparedScene, settings: &RenderSettings<'_>| {
                    self.centres(memory, scene, settings, threads)
                }
            };
            let single = Threads::single();
            let (parallel, serial) = (&centres(&self.threads), &centres(&single));
            let renders = Renders { parallel, serial, instructions: Some(self.instructions) };
            sampling::render(scene, settings, &self.threads, &renders)?
        } else {
            self.centres(memory, scene, settings, &self.threads)?
        };
        Ok(layers::combined(scene, &settings.quantities, layers))
    }

    fn centres(
        &self,
        memory: Vec<Values>,
        scene: &PreparedScene,
        settings: &RenderSettings<'_>,
        threads: &Threads,
    ) -> Result<Vec<Map>, RenderError> {
        let sheet = Sheet::of_camera(scene, settings, self.name())?;
        let mut layers = band::empty_layers(scene, &sheet, &settings.quantities, self.precision, memory)?;
        let uses_tiles = tiles::supports(scene);
        if uses_tiles {
            // Built here, where all threads are free: the renderer's own threads would wait for each other.
            scene.accelerator();
        }
        let asked_for = band::asked_for(&layers[0], scene);
        let lighting = Lighting::new(scene, &asked_for);
        let work = Work { scene, settings, lighting, asked_for, uses_tiles };
        let fill = |band: Band<'_>| self.fill(band, &work);
        let (height, region) = (layers[0].region.size.height, layers[0].region);
        let runs: Vec<Vec<Run>> = if threads.count() == 1 || estimated_time(scene, region, uses_tiles) < WORTH_THREADS {
            band::split(&mut layers, height).into_iter().map(fill).collect::<Result<_, _>>()?
        } else {
            threads.start()?;
            let parts = u32::try_from(threads.count()).unwrap_or(u32::MAX).saturating_mul(BANDS_A_THREAD);
            let rows = if uses_tiles { tiles::HEIGHT } else { height.div_ceil(parts).next_multiple_of(packets::SIDE) };
            threads.map::<_, _, Result<_, _>>(band::split(&mut layers, rows), fill)?
        };
        band::finish(&mut layers, runs.into_iter().flatten().collect());
        Ok(layers)
    }

    fn fill(&self, mut band: Band<'_>, work: &Work<'_>) -> Result<Vec<Run>, RenderError> {
        let Work { scene, settings: RenderSettings { observer, .. }, lighting, asked_for, uses_tiles } = work;
        let (precision, instructions, observer) = (self.precision, self.instructions, *observer);
        if *uses_tiles {
            return Tiles { scene, lighting, asked_for, precision, instructions, observer }.fill(band);
        }
        let rows = band.first.row..band.first.row + band.size.height;
        match Candidate::all(scene, rows) {
            Some(candidates) => {
                let job = RowsJob { scene, band, candidates, lighting, asked_for, precision, observer };
                self.instructions.run(job)
            }
            None if packets::ARE_COMPILED && packets::supports(scene, instructions) => {
                Packets { scene, lighting, asked_for, instructions }.fill(band, observer)
            }
            None => rays::fill(&mut band, scene, asked_for, observer),
        }
    }
}

/// Work shorter than this, in nanoseconds, is done before other threads have woken up.
const WORTH_THREADS: f64 = 200_000.0;

/// Bands per thread: enough that no thread waits long for the last one, few enough that starting them costs nothing.
const BANDS_A_THREAD: u32 = 8;

/// Roughly the time that one thread takes, in nanoseconds.
fn estimated_time(scene: &PreparedScene, region: Region, uses_tiles: bool) -> f64 {
    let pixels = f64::from(region.size.width) * f64::from(region.size.height);
    if uses_tiles {
        return 50.0 * pixels;
    }
    let covered = |shape| match scene.outline(shape) {
        Outline::Unseen => 0.0,
        Outline::Unknown => 20.0 * pixels,
        // All of it is traced again with 32 digits.
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
        // Renderers that produce different bytes have different names.
        let rounding = if self.instructions.fuse() { "" } else { " without fused multiply-add" };
        format!("{} precision, lanes{rounding}", self.precision.name())
    }

    fn render(&self, scene: &PreparedScene, settings: &RenderSettings<'_>) -> Result<Map, RenderError> {
        derived::render(scene, settings, |scene, settings| self.render_in(Vec::new(), scene, settings))
    }

    fn render_again(
        &self,
        scene: &PreparedScene,
        settings: &RenderSettings<'_>,
        earlier: Map,
    ) -> Result<Map, RenderError> {
        let mut memory = band::recycle([earlier]);
        derived::render(scene, settings, |scene, settings| self.render_in(std::mem::take(&mut memory), scene, settings))
    }
}
