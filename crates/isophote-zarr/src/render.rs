//! The computation: each worker renders a shard, writes it, and takes the next.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use isophote::prepare::PreparedScene;
use isophote::render::{Observer, RenderError, RenderSettings, Renderer};
use isophote::threads::ThreadsError;

use crate::describe::{need, rendered};
use crate::error::StoreError;
use crate::plan::{Part, Shard};
use crate::record::Record;
use crate::statistics::MapStatistics;
use crate::store::{Check, Store};
use crate::workers::{SceneMemory, Workers};

/// How far the store is.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It is complete.
    Complete(MapStatistics),
    /// The requested part is done.
    Part {
        /// Shards of the whole store that are done.
        done: u64,
        /// Shards that are not done yet.
        left: u64,
    },
}

impl Store {
    /// Pixels of the part: done, and total.
    #[must_use]
    pub fn pixels(&self, part: Option<Part>) -> [u64; 2] {
        let mut pixels = [0, 0];
        for ((shard, &is_done), index) in self.plan().shards().zip(&self.was_done).zip(0..) {
            if part.is_none_or(|part| part.has(index)) {
                let count = self.plan().region(shard).size.count();
                pixels[0] += if is_done { count } else { 0 };
                pixels[1] += count;
            }
        }
        pixels
    }

    /// The shards of the part that were not done when the store was opened, with their indices in the plan.
    pub fn due(&self, part: Option<Part>) -> impl Iterator<Item = (u64, Shard)> {
        let shards = (0..).zip(self.plan().shards()).zip(&self.was_done);
        let is_due = move |index, is_done: bool| !is_done && part.is_none_or(|part| part.has(index));
        shards.filter(move |((index, _), is_done)| is_due(*index, **is_done)).map(|(shard, _)| shard)
    }

    /// Computes the shards that are not done yet, and merges the results unless only a part was requested. Every thread
    /// calls the renderer separately, so the renderer should not use threads of its own.
    ///
    /// # Errors
    /// A file that cannot be written, too little memory, or an interruption. Finished shards are kept.
    pub fn render(
        &self,
        scene: &PreparedScene,
        renderer: &(dyn Renderer + Sync),
        workers: Workers,
        part: Option<Part>,
        observer: Option<&dyn Observer>,
    ) -> Result<Outcome, StoreError> {
        let due: Vec<Shard> = self.due(part).map(|(_, shard)| shard).collect();
        let need_per_pixel = need(scene, renderer, &self.quantities())?;
        let count = workers.fitting(&self.plan(), need_per_pixel, &SceneMemory::of(scene))?.min(due.len());
        let work = Work {
            store: self,
            scene,
            renderer,
            observer,
            due: &due,
            is_alone: part.is_none(),
            next: AtomicUsize::new(0),
            is_stopped: AtomicBool::new(false),
            error: Mutex::new(None),
        };
        work.on_threads(count)?;
        if let Some(error) = work.error.into_inner().unwrap_or_else(PoisonError::into_inner) {
            return Err(error);
        }
        if part.is_none() {
            return self.merge_observed(Check::Presence, observer).map(Outcome::Complete);
        }
        let mut done = 0;
        for shard in self.plan().shards() {
            done += u64::from(Record::read(&self.files, &self.arrays, shard)?.is_ok());
        }
        Ok(Outcome::Part { done, left: self.plan().count() - done })
    }
}

/// What the workers share.
struct Work<'w> {
    store: &'w Store,
    scene: &'w PreparedScene,
    renderer: &'w (dyn Renderer + Sync),
    observer: Option<&'w dyn Observer>,
    due: &'w [Shard],
    /// Whether no other process should write to the store.
    is_alone: bool,
    next: AtomicUsize,
    is_stopped: AtomicBool,
    error: Mutex<Option<StoreError>>,
}

impl Work<'_> {
    /// Runs on so many threads at the same time.
    fn on_threads(&self, count: usize) -> Result<(), RenderError> {
        std::thread::scope(|scope| {
            for _ in 0..count {
                if let Err(error) = std::thread::Builder::new().spawn_scoped(scope, || self.run()) {
                    self.is_stopped.store(true, Ordering::Relaxed);
                    return Err(ThreadsError { threads: count, reason: error.to_string() }.into());
                }
            }
            Ok(())
        })
    }

    fn run(&self) {
        while let Some(&shard) = self.due.get(self.next.fetch_add(1, Ordering::Relaxed)) {
            if let Err(error) = self.shard(shard) {
                self.is_stopped.store(true, Ordering::Relaxed);
                // Errors after the first are its consequences.
                self.error.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
                return;
            }
        }
    }

    fn shard(&self, shard: Shard) -> Result<(), StoreError> {
        let Store { files, arrays, .. } = self.store;
        let region = Some(self.store.plan().region(shard));
        let settings = RenderSettings { region, quantities: rendered(&self.store.quantities()), observer: Some(self) };
        let map = self.renderer.render(self.scene, &settings)?;
        // It was not done when the store was opened.
        if !self.store.is_locked() && self.is_alone && Record::read(files, arrays, shard)?.is_ok() {
            return Err(StoreError::Met { path: files.root().into(), shard });
        }
        Record::make(files, arrays, self.store.plan(), shard, &map, &|| match self.advance(0) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(RenderError::Interrupted.into()),
        })?;
        self.store.count_one();
        Ok(())
    }
}

impl Observer for Work<'_> {
    fn advance(&self, pixels: u64) -> ControlFlow<()> {
        if self.is_stopped.load(Ordering::Relaxed) {
            return ControlFlow::Break(());
        }
        self.observer.map_or(ControlFlow::Continue(()), |observer| observer.advance(pixels))
    }
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroUsize;
    use std::path::Path;

    use isophote::map::{Quantity, Resolution};
    use isophote::render::ReferenceRenderer;
    use isophote::scene::library::Starter;
    use isophote::scene::{Scene, Syntax};

    use super::*;
    use crate::store::{Opening, Request};

    const WORKERS: Workers = Workers { threads: NonZeroUsize::MIN, memory: None, used: 0 };

    fn opened(path: &Path, scene: &PreparedScene) -> Store {
        let request = Request {
            quantities: vec![Quantity::Brightness],
            opening: Opening::Continue,
            part: None,
            shard_side: 16.try_into().ok(),
            workers: None,
        };
        Store::prepare(path, scene, &ReferenceRenderer, &request).unwrap()
    }

    /// On a file system without locks, two processes believe that each is alone.
    #[test]
    fn a_shard_that_somebody_else_has_written_meanwhile_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let scene = Scene::from_text("the lab's", Starter::Lab.text(), Syntax::Toml).unwrap();
        let scene = PreparedScene::new(&scene.with_resolution(Resolution { width: 40, height: 20 }).unwrap());
        let path = folder.path().join("map.zarr");
        let mut store = opened(&path, &scene);
        store.lock.is_held = false;
        // The other one, which has been at the first shard.
        let shard = store.plan().shards().next().unwrap();
        let settings = RenderSettings {
            region: Some(store.plan().region(shard)),
            quantities: rendered(&store.quantities()),
            observer: None,
        };
        let map = ReferenceRenderer.render(&scene, &settings).unwrap();
        Record::make(&store.files, &store.arrays, store.plan(), shard, &map, &|| Ok(())).unwrap();
        let error = store.render(&scene, &ReferenceRenderer, WORKERS, None, None).unwrap_err();
        assert!(matches!(error, StoreError::Met { shard: found, .. } if found == shard), "{error}");
        drop(store);
        // Opened again, what is done counts as done.
        opened(&path, &scene).render(&scene, &ReferenceRenderer, WORKERS, None, None).unwrap();
    }
}
