//! A store: created or opened, and finally complete.

use std::fs;
use std::io;
use std::num::NonZeroU32;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use isophote::map::Quantity;
use isophote::message;
use isophote::prepare::PreparedScene;
use isophote::render::{Observer, RenderError, Renderer};
use isophote::scene::{CarriedFiles, Scene, Syntax};
use isophote::text::Message;
use isophote_export::FileMetadata;

use crate::array::ChannelArray;
use crate::describe;
use crate::error::{Damage, StoreError};
use crate::files::{Files, Lock, Sharing};
use crate::identity::{Identity, ZARR_JSON};
use crate::json::pretty;
use crate::plan::{Part, Plan};
use crate::preview::{Boxes, Preview};
use crate::record::Record;
use crate::statistics::{MapStatistics, ShardStatistics};
use crate::workers::{SceneMemory, Workers};

/// The small picture of the whole map.
const PREVIEW: &str = "preview.png";

/// A store that this process may write to.
pub struct Store {
    pub(crate) files: Files,
    pub(crate) identity: Identity,
    pub(crate) arrays: Vec<ChannelArray>,
    /// For each shard of the plan, whether it was done when the store was opened.
    pub(crate) was_done: Vec<bool>,
    done: AtomicU64,
    pub(crate) lock: Lock,
}

/// The store that is requested.
#[derive(Clone, Debug)]
pub struct Request {
    /// The channels, without duplicates; the first one is pictured.
    pub quantities: Vec<Quantity>,
    /// What to do if the store already exists.
    pub opening: Opening,
    /// The part to compute when other processes write to the same store; by default everything.
    pub part: Option<Part>,
    /// Side of the shards of a new store; by default chosen to suit the channels.
    pub shard_side: Option<NonZeroU32>,
    /// Who will compute it: if their memory is too little for one shard, nothing is created.
    pub workers: Option<Workers>,
}

/// What to do if the store already exists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Opening {
    /// Fail: nothing is ever replaced.
    New,
    /// Continue it if it holds the same map; create it if it does not exist.
    Continue,
}

/// How thoroughly a store is checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Check {
    /// Every shard has its record, and its files have the right lengths.
    Presence,
    /// Every byte matches its checksum, and every chunk can be decoded.
    Content,
}

impl Store {
    /// Creates a store for a scene, or opens the existing one.
    ///
    /// # Errors
    /// The name is taken, the store holds another map or is being written, or the folder is not writable.
    pub fn prepare(
        path: &Path,
        scene: &PreparedScene,
        renderer: &dyn Renderer,
        request: &Request,
    ) -> Result<Self, StoreError> {
        let files = Files::new(path);
        let stored = check_place(&files, request.opening)?;
        let sample = describe::sample(scene, renderer, &request.quantities)?;
        let full = scene.scene().camera().resolution;
        let plan = match (request.shard_side, &stored) {
            (Some(side), _) => Plan::with_shard_side(full, side),
            (None, Some(stored)) => Plan { full, ..stored.plan },
            (None, None) => Plan::new(full, describe::need_per_pixel(&sample)),
        };
        if !plan.is_sound() {
            return Err(StoreError::TooManyShards { shards: plan.count() });
        }
        if let Some(workers) = request.workers {
            workers.fitting(&plan, describe::need_per_pixel(&sample), &SceneMemory::of(scene))?;
        }
        let metadata = describe::metadata(&sample, scene, &request.quantities);
        let arrays = describe::sample_arrays(&sample, &metadata, plan);
        let coordinates = describe::coordinates(scene, &metadata.window)?;
        let described = arrays.iter().map(|(name, array)| (name.clone(), array.metadata()));
        let centres = coordinates.iter().map(|(name, metadata, _)| ((*name).to_owned(), metadata.clone()));
        let identity = Identity { metadata, plan, arrays: described.chain(centres).collect() };
        if let Some(stored) = &stored {
            refuse_changes(stored, &identity, path)?;
        }
        let lock = files.lock(if request.part.is_some() { Sharing::Together } else { Sharing::Alone })?;
        if stored.is_none() && !files.put_new(ZARR_JSON, &identity.to_json(None))? {
            // Another process created it first.
            let text = files.get(ZARR_JSON)?.unwrap_or_default();
            refuse_changes(&Identity::from_json(&text, path)?, &identity, path)?;
        }
        for (name, metadata) in &identity.arrays {
            files.put_changed(&format!("{name}/{ZARR_JSON}"), &pretty(metadata))?;
        }
        for (name, _, bytes) in &coordinates {
            files.put_changed(&format!("{name}/c/0"), bytes)?;
        }
        Self::new(files, identity, arrays.into_iter().map(|(_, array)| array).collect(), lock)
    }

    /// Opens an existing store in order to merge it.
    ///
    /// # Errors
    /// It is not a store of Isophote, is damaged, or is being written.
    pub fn open(path: &Path) -> Result<Self, StoreError> {
        let files = Files::new(path);
        let identity = stored_identity(&files)?.ok_or_else(|| foreign(path, message!("no Zarr store of Isophote")))?;
        let arrays = describe::stored_arrays(&identity, path)?;
        let lock = files.lock(Sharing::Alone)?;
        Self::new(files, identity, arrays, lock)
    }

    fn new(files: Files, identity: Identity, arrays: Vec<ChannelArray>, lock: Lock) -> Result<Self, StoreError> {
        let is_done = |shard| Ok(Record::read(&files, &arrays, shard)?.is_ok());
        let was_done = identity.plan.shards().map(is_done).collect::<Result<Vec<bool>, StoreError>>()?;
        let done = AtomicU64::new(count(&was_done));
        Ok(Self { files, identity, arrays, was_done, done, lock })
    }

    /// What the store says about itself.
    #[must_use]
    pub fn metadata(&self) -> &FileMetadata {
        &self.identity.metadata
    }

    /// How it is divided into shards.
    #[must_use]
    pub fn plan(&self) -> Plan {
        self.identity.plan
    }

    /// The channels.
    #[must_use]
    pub fn quantities(&self) -> Vec<Quantity> {
        self.arrays.iter().map(|array| array.quantity.clone()).collect()
    }

    /// How many shards are done, as far as this process knows.
    #[must_use]
    pub fn done(&self) -> u64 {
        self.done.load(Ordering::Relaxed)
    }

    /// Whether other processes are kept from writing to the store. It is not so on file systems without locks: there, a
    /// shard that another process has written meanwhile ends the computation with an error.
    #[must_use]
    pub fn is_locked(&self) -> bool {
        self.lock.is_held
    }

    pub(crate) fn count_one(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
    }

    /// Merges the results of all shards: the statistics into the store's description, and the preview.
    ///
    /// The record of a shard with wrong content is removed, so that the shard is computed again when the store is
    /// continued.
    ///
    /// # Errors
    /// Lists all missing or damaged shards in one error.
    pub fn merge(&self, check: Check) -> Result<MapStatistics, StoreError> {
        self.merge_observed(check, None)
    }

    /// Like [`merge`](Self::merge), for an observer that is told of the pixels of each shard, and may end it: nothing is
    /// written then.
    ///
    /// # Errors
    /// As for [`merge`](Self::merge), and an interruption.
    pub fn merge_observed(&self, check: Check, observer: Option<&dyn Observer>) -> Result<MapStatistics, StoreError> {
        let plan = self.identity.plan;
        let mut preview = Preview::new(Boxes::new(plan.full));
        let mut shards = Vec::new();
        let mut damages = if check == Check::Content { self.damaged_descriptions()? } else { Vec::new() };
        for shard in plan.shards() {
            let pixels = plan.region(shard).size.count();
            if observer.is_some_and(|observer| observer.advance(pixels).is_break()) {
                return Err(RenderError::Interrupted.into());
            }
            match Record::read(&self.files, &self.arrays, shard)? {
                Err(damage) => damages.push(damage),
                Ok(record) => {
                    let damage = match check {
                        Check::Presence => None,
                        Check::Content => record.check(&self.files, &self.arrays, shard)?,
                    };
                    let of_preview = |reason| Damage {
                        place: Record::key(shard),
                        reason: message!("has a preview that does not fit: {reason}", reason),
                    };
                    let added = preview.add(plan.region(shard), &record.preview).map_err(of_preview);
                    let damage = damage.or(added.err());
                    if damage.is_some() {
                        Record::forget(&self.files, shard)?;
                    }
                    damages.extend(damage);
                    shards.push(record.statistics);
                }
            }
        }
        if damages.is_empty() {
            self.finish(&preview, &shards)
        } else {
            Err(StoreError::Incomplete { path: self.files.root().into(), damages })
        }
    }

    /// Array descriptions that differ from those in the group, and coordinates that differ from the scene's.
    fn damaged_descriptions(&self) -> Result<Vec<Damage>, StoreError> {
        let mut damages = Vec::new();
        let metadata = &self.identity.metadata;
        let files = CarriedFiles::of_output(self.files.root(), &metadata.files);
        let scene = Scene::from_text_with(&files, None, "the store's scene", &metadata.scene, Syntax::Toml)
            .map_err(|error| StoreError::Damaged { path: self.files.path(ZARR_JSON), reason: error.to_string() })?;
        for (name, _, bytes) in describe::coordinates(&PreparedScene::new(&scene), &metadata.window)? {
            let file = format!("{name}/c/0");
            if self.files.get(&file)?.as_ref() != Some(&bytes) {
                damages.push(Damage { place: file, reason: message!("is missing or changed") });
            }
        }
        for (name, metadata) in &self.identity.arrays {
            let file = format!("{name}/{ZARR_JSON}");
            if self.files.get(&file)?.as_deref() != Some(&pretty(metadata)) {
                let reason = message!("is missing or changed");
                damages.push(Damage { place: file, reason });
            }
        }
        Ok(damages)
    }

    fn finish(&self, preview: &Preview, shards: &[ShardStatistics]) -> Result<MapStatistics, StoreError> {
        let Identity { metadata, plan, .. } = &self.identity;
        let quantities = self.quantities();
        let statistics = MapStatistics::new(plan.full.count(), &quantities, shards);
        if let (Some(main), Some(channel)) = (quantities.first(), metadata.channels.first())
            && main.is_scalar()
        {
            self.files.put_changed(PREVIEW, &preview.to_png(metadata, main, &channel.unit)?)?;
        }
        self.files.put_changed(ZARR_JSON, &self.identity.to_json(Some(statistics.to_json())))?;
        Ok(statistics)
    }
}

/// The existing store, if it may be continued; none if the name is free.
fn check_place(files: &Files, opening: Opening) -> Result<Option<Identity>, StoreError> {
    let path = files.root();
    match fs::metadata(path) {
        Ok(found) if !found.is_dir() => return Err(foreign(path, message!("a file"))),
        Ok(_) => {}
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
            return match parent.filter(|parent| !parent.is_dir()) {
                Some(parent) => Err(foreign(
                    path,
                    message!("in a folder ‘{folder}’ that does not exist", folder = parent.display()),
                )),
                None => Ok(None),
            };
        }
        Err(reason) => return Err(StoreError::Read { path: path.into(), reason }),
    }
    let Some(stored) = stored_identity(files)? else {
        return if files.is_unused()? {
            Ok(None)
        } else {
            Err(foreign(path, message!("a folder with other things in it")))
        };
    };
    if opening == Opening::Continue {
        return Ok(Some(stored));
    }
    let arrays = describe::stored_arrays(&stored, path)?;
    let mut done = 0;
    for shard in stored.plan.shards() {
        done += u64::from(Record::read(files, &arrays, shard)?.is_ok());
    }
    Err(StoreError::Exists { path: path.into(), done, shards: stored.plan.count() })
}

fn stored_identity(files: &Files) -> Result<Option<Identity>, StoreError> {
    files.get(ZARR_JSON)?.map(|text| Identity::from_json(&text, files.root())).transpose()
}

fn foreign(path: &Path, what: Message) -> StoreError {
    StoreError::Foreign { path: path.into(), what }
}

fn refuse_changes(stored: &Identity, asked: &Identity, path: &Path) -> Result<(), StoreError> {
    let changes = stored.changes(asked);
    if changes.is_empty() { Ok(()) } else { Err(StoreError::Changed { path: path.into(), changes }) }
}

fn count(flags: &[bool]) -> u64 {
    flags.iter().filter(|&&flag| flag).count() as u64
}
