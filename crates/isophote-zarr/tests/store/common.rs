//! Scenes, stores of them, and readers that the crate does not have.

use std::collections::BTreeMap;
use std::fs;
use std::num::{NonZeroU32, NonZeroUsize};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use isophote::map::{Map, Quantity, Resolution};
use isophote::prepare::PreparedScene;
use isophote::render::{ReferenceRenderer, RenderSettings, Renderer};
use isophote::scene::{Scene, Syntax};
use isophote_zarr::{MapStatistics, Opening, Outcome, Part, Request, Store, StoreError, Workers};
use tempfile::TempDir;
use zarrs::array::{Array, ArraySubset};
use zarrs::storage::store::MemoryStore;
use zarrs::storage::{StoreKey, WritableStorageTraits};

pub const TWO_LIGHTS: &str = include_str!("../../../../scenes/two-lights.toml");

pub fn scene(text: &str, width: u32, height: u32) -> PreparedScene {
    let scene = Scene::from_text("the scene", text, Syntax::Toml).unwrap();
    PreparedScene::new(&scene.with_resolution(Resolution { width, height }).unwrap())
}

pub fn map(scene: &PreparedScene, quantities: &[Quantity]) -> Map {
    let quantities = quantities.iter().cloned().chain([Quantity::Irradiance]).collect();
    ReferenceRenderer.render(scene, &RenderSettings { quantities, ..RenderSettings::default() }).unwrap()
}

/// How a store is computed.
#[derive(Clone)]
pub struct Job {
    pub quantities: Vec<Quantity>,
    pub opening: Opening,
    pub part: Option<Part>,
    pub side: u32,
    pub threads: usize,
    pub memory: Option<u64>,
}

impl Default for Job {
    fn default() -> Self {
        let quantities = vec![Quantity::Brightness, Quantity::Shape, Quantity::Normal];
        Self { quantities, opening: Opening::New, part: None, side: 16, threads: 2, memory: None }
    }
}

impl Job {
    pub fn run(&self, path: &Path, scene: &PreparedScene) -> Result<Outcome, StoreError> {
        let workers = Workers { threads: NonZeroUsize::new(self.threads).unwrap(), memory: self.memory, used: 0 };
        let request = Request {
            quantities: self.quantities.clone(),
            opening: self.opening,
            part: self.part,
            shard_side: NonZeroU32::new(self.side),
            workers: Some(workers),
        };
        let store = Store::prepare(path, scene, &ReferenceRenderer, &request)?;
        store.render(scene, &ReferenceRenderer, workers, self.part, None)
    }

    /// A complete store and its results.
    pub fn complete(&self, scene: &PreparedScene) -> (Folder, MapStatistics) {
        let folder = Folder::new();
        match self.run(&folder.store(), scene).unwrap() {
            Outcome::Complete(statistics) => (folder, statistics),
            Outcome::Part { .. } => panic!("all of it was asked for"),
        }
    }
}

pub struct Folder(TempDir);

impl Folder {
    pub fn new() -> Self {
        Self(TempDir::new().unwrap())
    }

    pub fn store(&self) -> PathBuf {
        self.0.path().join("map.zarr")
    }

    pub fn file(&self, key: &str) -> PathBuf {
        self.store().join(key)
    }

    /// Every file of the store with its content.
    pub fn tree(&self) -> BTreeMap<String, Vec<u8>> {
        let mut tree = BTreeMap::new();
        collect(&self.store(), &self.store(), &mut tree);
        tree
    }

    /// An array of the store, as the library for Zarr reads it.
    pub fn array(&self, name: &str) -> Array<MemoryStore> {
        let memory = MemoryStore::new();
        for (key, bytes) in self.tree().into_iter().filter(|(key, _)| key.starts_with(&format!("{name}/"))) {
            memory.set(&StoreKey::new(key).unwrap(), bytes.into()).unwrap();
        }
        Array::open(Arc::new(memory), &format!("/{name}")).unwrap()
    }

    pub fn doubles(&self, name: &str) -> Vec<f64> {
        let array = self.array(name);
        let all: ArraySubset = array.subset_all();
        array.retrieve_array_subset::<Vec<f64>>(&all).unwrap()
    }

    pub fn indices(&self, name: &str) -> Vec<i32> {
        let array = self.array(name);
        array.retrieve_array_subset::<Vec<i32>>(&array.subset_all()).unwrap()
    }
}

fn collect(root: &Path, folder: &Path, tree: &mut BTreeMap<String, Vec<u8>>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(root, &path, tree);
        } else {
            tree.insert(path.strip_prefix(root).unwrap().to_str().unwrap().into(), fs::read(&path).unwrap());
        }
    }
}
