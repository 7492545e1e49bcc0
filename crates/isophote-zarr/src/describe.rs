//! What a store says about its map and each array, before anything is computed.

use std::path::Path;

use isophote::camera::ScreenPosition;
use isophote::map::{Map, Pixel, Quantity, Region, Resolution, Window};
use isophote::prepare::PreparedScene;
use isophote::render::{RenderSettings, Renderer};
use isophote_export::{FileMetadata, names};
use serde_json::Value;

use crate::array::{ChannelArray, NumberFormat, coordinate};
use crate::error::StoreError;
use crate::identity::{Identity, ZARR_JSON};
use crate::plan::Plan;

/// A map of one pixel, which shows what the renderer will produce.
pub fn sample(scene: &PreparedScene, renderer: &dyn Renderer, quantities: &[Quantity]) -> Result<Map, StoreError> {
    let size = Resolution { width: 1, height: 1 };
    let region = Region { corner: Pixel { column: 0, row: 0 }, size };
    let settings = RenderSettings { region: Some(region), quantities: rendered(quantities), observer: None };
    Ok(renderer.render(scene, &settings)?)
}

/// The channels to compute: the requested ones, the irradiance, which shows which pixels are lit, and what others are derived
/// from, which takes memory too.
pub fn rendered(quantities: &[Quantity]) -> Vec<Quantity> {
    let is_derived = |quantity: &Quantity| Quantity::OF_CAMERA.contains(quantity);
    let geometry = if quantities.iter().any(is_derived) { vec![Quantity::Position, Quantity::Normal] } else { vec![] };
    quantities.iter().cloned().chain([Quantity::Irradiance]).chain(geometry).collect()
}

/// Bytes per pixel that a shard is allowed while it is made: all channels of the map, and three times the largest one,
/// for the file of a channel that cannot be compressed and as a reserve. New stores are planned by this number: with
/// another one, the shards of the same map may have another size.
pub fn need_per_pixel(sample: &Map) -> u64 {
    let sizes = || sample.channels().iter().map(|channel| NumberFormat::of(&channel.values).size() as u64);
    sizes().sum::<u64>() + 3 * sizes().max().unwrap_or(0)
}

/// The number of bytes per pixel needed while a shard is made.
pub fn need(scene: &PreparedScene, renderer: &dyn Renderer, quantities: &[Quantity]) -> Result<u64, StoreError> {
    Ok(need_per_pixel(&sample(scene, renderer, quantities)?))
}

/// The description of the whole map, derived from that of one pixel.
pub fn metadata(sample: &Map, scene: &PreparedScene, quantities: &[Quantity]) -> FileMetadata {
    let is_allowed = |character: char| character.is_alphanumeric() || "-_.".contains(character);
    let camera = scene.scene().camera();
    let length = scene.scene().length();
    let mut metadata = FileMetadata::of(sample);
    for (channel, name) in metadata.channels.iter_mut().zip(names::unique(sample.channels(), is_allowed)) {
        channel.stored_as = vec![name];
    }
    metadata.channels.retain(|channel| quantities.iter().any(|quantity| quantity.name() == channel.name));
    metadata.region = Region::all(camera.resolution);
    metadata.window = camera.window(metadata.region, length);
    metadata
}

/// The arrays of the channels, by their names in the store.
pub fn sample_arrays(sample: &Map, metadata: &FileMetadata, plan: Plan) -> Vec<(String, ChannelArray)> {
    let mut arrays = Vec::new();
    for description in &metadata.channels {
        let channel = sample.channels().iter().find(|channel| channel.quantity.name() == description.name);
        let (Some(channel), Some(name)) = (channel, description.stored_as.first()) else { continue };
        let format = NumberFormat::of(&channel.values);
        let array = ChannelArray::new(channel.quantity.clone(), name, &channel.unit, format, plan);
        arrays.push((name.clone(), array));
    }
    arrays
}

/// The arrays of a store, according to its own description.
pub fn stored_arrays(identity: &Identity, path: &Path) -> Result<Vec<ChannelArray>, StoreError> {
    let damaged = |name: &str| StoreError::Damaged {
        path: path.join(ZARR_JSON),
        reason: format!("its channel ‘{name}’ is not described as this program does it"),
    };
    let mut arrays = Vec::new();
    for channel in &identity.metadata.channels {
        let name = channel.stored_as.first().ok_or_else(|| damaged(&channel.name))?;
        let described = identity.arrays.get(name).ok_or_else(|| damaged(name))?;
        let format = NumberFormat::from_metadata(described).ok_or_else(|| damaged(name))?;
        let quantity = Quantity::from_name(&channel.name).ok_or_else(|| damaged(name))?;
        let array = ChannelArray::new(quantity, name, &channel.unit, format, identity.plan);
        if array.metadata() != *described {
            return Err(damaged(name));
        }
        arrays.push(array);
    }
    Ok(arrays)
}

/// The name of a coordinate's array, its description, and its only chunk.
pub type Coordinate = (&'static str, Value, Vec<u8>);

/// The centres of columns and rows on the screen, in the window's unit.
pub fn coordinates(scene: &PreparedScene, window: &Window) -> Result<[Coordinate; 2], StoreError> {
    let Resolution { width, height } = scene.scene().camera().resolution;
    let centre = |pixel| {
        let point = scene.frame().point_on_screen(ScreenPosition::PixelCenter(pixel));
        point.map(|coordinate| window.unit().from_internal(coordinate))
    };
    let x: Vec<f64> = (0..width).map(|column| centre(Pixel { column, row: 0 })[0]).collect();
    let y: Vec<f64> = (0..height).map(|row| centre(Pixel { column: 0, row })[1]).collect();
    let unit = window.unit().name();
    let array = |name: &'static str, centres: &[f64]| -> Result<Coordinate, StoreError> {
        let encoded = coordinate(name, unit, centres);
        let (metadata, bytes) =
            encoded.map_err(|reason| StoreError::Encode { quantity: Quantity::Position, reason })?;
        Ok((name, metadata, bytes))
    };
    Ok([array("x", &x)?, array("y", &y)?])
}
