//! How much work fits into the memory at the same time.

use std::num::NonZeroUsize;

use isophote::prepare::PreparedScene;
use isophote::scene::PART_BYTES;

use crate::error::StoreError;
use crate::plan::Plan;

/// The memory that the program uses besides the shards in flight.
const BASE: u64 = 48 << 20;
const MIB: u64 = 1 << 20;

/// The limits on concurrent work.
#[derive(Clone, Copy, Debug)]
pub struct Workers {
    /// The maximum number of shards at a time, each on its own thread.
    pub threads: NonZeroUsize,
    /// A memory limit in bytes for the program and the shards in flight, which may reduce that number.
    pub memory: Option<u64>,
    /// The most memory in bytes that the program has used so far, where that is known: reading a scene may take more than is
    /// reckoned here.
    pub used: u64,
}

impl Workers {
    /// How many shards may be in flight; an error if not even one may.
    pub(crate) fn fitting(self, plan: &Plan, need_per_pixel: u64, scene: &SceneMemory) -> Result<usize, StoreError> {
        let Some(limit) = self.memory else { return Ok(self.threads.get()) };
        let base = (BASE + scene.read).max(self.used) + scene.written;
        let shard = need_per_pixel * plan.shard_pixels() + scene.each_worker;
        let count = limit.saturating_sub(base) / shard;
        if count == 0 {
            return Err(StoreError::Memory { limit: limit / MIB, needed: (base + shard).div_ceil(MIB) });
        }
        Ok(self.threads.get().min(usize::try_from(count).unwrap_or(usize::MAX)))
    }
}

/// The memory that a scene takes, in bytes.
pub(crate) struct SceneMemory {
    /// As it was read, with its tree.
    read: u64,
    /// To write and check its description.
    written: u64,
    /// The lights as the renderer places them for each shape.
    each_worker: u64,
}

impl SceneMemory {
    /// What a prepared scene takes. A scene with colours has its lights and materials four times: of each component, and as
    /// luminances.
    pub fn of(scene: &PreparedScene) -> Self {
        /// A shape or a light with its source, as measured.
        const ITEM: u64 = 1024;
        let description = scene.scene();
        let [lights, shapes] = [description.lights().len(), description.shapes().len()].map(|count| count as u64);
        let parts: u64 = description.shapes().iter().map(|shape| u64::from(shape.geometry.parts())).sum();
        let files: u64 =
            description.files().iter().map(|file| file.content.as_ref().map_or(0, String::len) as u64).sum();
        let components = if description.color().is_some() { 3 } else { 1 };
        Self {
            read: PART_BYTES * parts + ITEM * shapes + ITEM * lights * components,
            // The text in the description, once more in the preview's, and in what they are compared with.
            written: ITEM * (lights + shapes) + 4 * files,
            // The renderer caches a million placed lights plus those of one more shape before it clears the cache.
            each_worker: components * 128 * (lights * shapes).min((1 << 20) + lights),
        }
    }
}

#[cfg(test)]
mod tests {
    use isophote::map::Resolution;
    use isophote::scene::library::Starter;
    use isophote::scene::{Scene, Syntax};

    use super::*;

    #[test]
    fn what_reading_took_and_what_colours_copy_counts() {
        let scene = |text: &str| PreparedScene::new(&Scene::from_text("a scene", text, Syntax::Toml).unwrap());
        let grey = scene(Starter::Lab.text());
        let plan = Plan::with_shard_side(Resolution { width: 1000, height: 1000 }, 512.try_into().unwrap());
        let most = |memory: u64, used: u64, scene: &PreparedScene| {
            let workers = Workers { threads: 1000.try_into().unwrap(), memory: Some(memory << 20), used: used << 20 };
            workers.fitting(&plan, 44, &SceneMemory::of(scene)).ok()
        };
        // 11 MiB a shard, beside 48.
        assert_eq!(most(256, 0, &grey), Some(18));
        assert_eq!(most(256, 200, &grey), Some(5));
        assert_eq!(most(256, 250, &grey), None);
        let light = "[[light]]\nposition = [5, 5, -10]\nintensity = 1\n".repeat(20_000);
        let text = Starter::Lab.text().to_owned() + &light;
        let [grey, colored] = [scene(&text), scene(&text.replace("intensity = 100", "intensity = [100, 1, 1]"))];
        assert!(most(256, 0, &grey) > most(256, 0, &colored));
    }
}
