//! Scenes, stores of them, and readers that the crate does not have.

use std::collections::BTreeMap;
use std::fs;
use std::num::{NonZeroU32, NonZeroUsize};
use std::path::{Path, PathBuf};

use isophote::map::{Map, Quantity, Resolution};
use isophote::prepare::PreparedScene;
use isophote::render::{ReferenceRenderer, RenderSettings, Renderer};
use isophote::scene::{Scene, Syntax};
use isophote_zarr::{MapStatistics, Opening, Outcome, Part, Request, Store, StoreError, Workers};
use serde_json::Value;
use tempfile::TempDir;

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

    /// The `zarr.json` of an array.
    pub fn description(&self, name: &str) -> Value {
        serde_json::from_slice(&fs::read(self.file(&format!("{name}/zarr.json"))).unwrap()).unwrap()
    }

    pub fn doubles(&self, name: &str) -> Vec<f64> {
        self.bytes(name, "float64").as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect()
    }

    pub fn indices(&self, name: &str) -> Vec<i32> {
        self.bytes(name, "int32").as_chunks().0.iter().map(|bytes| i32::from_le_bytes(*bytes)).collect()
    }

    /// The bytes of all numbers of an array, read as the specification of Zarr says and by other code than the crate's.
    fn bytes(&self, name: &str, data_type: &str) -> Vec<u8> {
        let description = self.description(name);
        assert_eq!(description["data_type"], data_type);
        let (fill, size) = if data_type == "int32" { (0xff, 4) } else { (0_u8, 8) };
        let shape = numbers(&description["shape"]);
        let sharding = &description["codecs"][0];
        if sharding["name"] == "bytes" {
            return chunk(&fs::read(self.file(&format!("{name}/c/0"))).unwrap(), shape[0] * size);
        }
        let shard = numbers(&description["chunk_grid"]["configuration"]["chunk_shape"])[0];
        let inner = numbers(&sharding["configuration"]["chunk_shape"])[0];
        let (rows, columns, last) = (shape[0], shape[1], if shape.len() == 3 { "/0" } else { "" });
        let pixel = size * shape.get(2).unwrap_or(&1);
        let mut all = vec![fill; rows * columns * pixel];
        let corners = |size: usize, width: usize, height: usize| {
            (0..height).step_by(size).flat_map(move |row| (0..width).step_by(size).map(move |column| [row, column]))
        };
        for [top, left] in corners(shard, columns, rows) {
            let Ok(file) = fs::read(self.file(&format!("{name}/c/{}/{}{last}", top / shard, left / shard))) else {
                continue;
            };
            let index = &file[file.len() - 16 * (shard / inner).pow(2) - 4..];
            let (entries, checksum) = index.as_chunks();
            assert_eq!(crc32c::crc32c(entries.as_flattened()).to_le_bytes(), checksum);
            let entries = entries.iter().map(|bytes| usize::try_from(u64::from_le_bytes(*bytes)).unwrap());
            let entries: Vec<usize> = entries.collect();
            for (entry, [row, column]) in entries.chunks(2).zip(corners(inner, shard, shard)) {
                if entry == [usize::MAX; 2] {
                    continue;
                }
                let bytes = chunk(&file[entry[0]..][..entry[1]], inner * inner * pixel);
                let column = left + column;
                for (bytes, row) in bytes.chunks(inner * pixel).zip(top + row..rows) {
                    let length = pixel * inner.min(columns - column);
                    all[(row * columns + column) * pixel..][..length].copy_from_slice(&bytes[..length]);
                }
            }
        }
        all
    }
}

fn numbers(json: &Value) -> Vec<usize> {
    serde_json::from_value(json.clone()).unwrap()
}

/// A chunk that is this long when it is decompressed.
fn chunk(encoded: &[u8], length: usize) -> Vec<u8> {
    let (compressed, checksum) = encoded.split_last_chunk().unwrap();
    assert_eq!(crc32c::crc32c(compressed).to_le_bytes(), *checksum);
    let mut chunk = Vec::with_capacity(length);
    assert_eq!(zstd_safe::decompress(&mut chunk, compressed), Ok(length));
    chunk
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
