//! The reference's rows, shared among threads. A pixel depends on nothing but the scene, so the bytes are the same
//! for any number of threads.

use rayon::prelude::*;

use super::{RenderError, RenderSettings, Renderer, rows};
use crate::map::{Map, Mask};
use crate::prepare::PreparedScene;

/// Rows on several threads, in double precision.
#[derive(Clone, Copy, Debug, Default)]
pub struct Threaded {
    /// How many threads; as many as there are processors when unstated.
    pub threads: Option<std::num::NonZeroUsize>,
}

impl Renderer for Threaded {
    fn name(&self) -> String {
        "double precision, threaded".into()
    }

    fn render(&self, scene: &PreparedScene, settings: &RenderSettings<'_>) -> Result<Map, RenderError> {
        let mut map = rows::empty_map(scene, settings, self.name())?;
        // Told outright: the pool would otherwise take its size from an environment variable.
        let available = std::thread::available_parallelism();
        let threads = self.threads.or(available.ok()).map_or(1, std::num::NonZeroUsize::get);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|error| RenderError::Threads { threads, reason: error.to_string() })?;
        let rows = pool.install(|| {
            let rows = rows::split(&mut map, scene).into_par_iter();
            rows.map(|mut row| row.render(scene, settings.observer)).collect::<Result<Vec<_>, _>>()
        })?;
        map.mask = Mask::new(map.region.size, rows.into_iter().flatten().collect());
        Ok(map)
    }
}
