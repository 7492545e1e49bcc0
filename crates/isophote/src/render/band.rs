//! A map that is filled band by band.

use std::ops::ControlFlow;

use super::provenance::provenance;
use super::{Observer, RenderError, RenderSettings, layers};
use crate::lanes::Precision;
use crate::map::{Channel, Map, Mask, Pixel, Quantity, Region, Resolution, Run, Values, Window};
use crate::prepare::PreparedScene;
use crate::scene::Scene;
use crate::units::LengthUnit;

/// What a map shows, and how it is computed.
pub struct Sheet {
    /// Size of the full image.
    pub full: Resolution,
    /// The part of the image that the map holds.
    pub region: Region,
    /// The outer edges of that part.
    pub window: Window,
    /// The same of the whole image.
    pub whole: Window,
    /// The renderer and its settings.
    pub renderer: String,
}

impl Sheet {
    /// What a scene's camera sees, limited to a region if the settings name one.
    pub fn of_camera(
        scene: &PreparedScene,
        settings: &RenderSettings<'_>,
        renderer: String,
    ) -> Result<Self, RenderError> {
        let description = scene.scene();
        let full = description.camera.resolution;
        let region = settings.region.unwrap_or(Region::all(full));
        check(region, full)?;
        let window = |region| description.camera.window(region, description.length);
        Ok(Self { full, region, window: window(region), whole: window(Region::all(full)), renderer })
    }
}

/// Empty maps of all [layers](super::layers), filled with zeros (−1 for the shape), with every requested channel. In single
/// precision the geometry (depth, position, normal) is still double. `memory` holds cleared buffers for reuse.
pub fn empty_layers(
    scene: &PreparedScene,
    sheet: &Sheet,
    quantities: &[Quantity],
    precision: Precision,
    mut memory: Vec<Values>,
) -> Result<Vec<Map>, RenderError> {
    let layers = 0..scene.layers().len();
    let bytes = layers.map(|layer| {
        let quantities = layers::quantities_of_layer(scene, quantities, layer);
        quantities.iter().map(|quantity| bytes_per_pixel(quantity, precision)).collect::<Vec<_>>()
    });
    refuse_too_little_memory(sheet.region.size, bytes.flatten(), &memory)?;
    let layer = |layer| {
        let quantities = layers::quantities_of_layer(scene, quantities, layer);
        empty_map(scene, sheet, &quantities, precision, &mut memory)
    };
    (0..scene.layers().len()).map(layer).collect()
}

fn empty_map(
    scene: &PreparedScene,
    sheet: &Sheet,
    quantities: &[Quantity],
    precision: Precision,
    memory: &mut Vec<Values>,
) -> Result<Map, RenderError> {
    let Sheet { full, region, window, whole, .. } = *sheet;
    let mut channels: Vec<Channel> = Vec::new();
    for quantity in quantities {
        if channels.iter().all(|channel| channel.quantity != *quantity) {
            channels.push(empty_channel(quantity, scene.scene(), region, precision, memory)?);
        }
    }
    let mask = Mask::new(region.size, Vec::new());
    let provenance = provenance(scene, sheet.renderer.clone());
    Ok(Map { full, region, window, whole, provenance, over_tolerance: None, mask, channels })
}

/// Checks that the system grants the memory of a large map, which would otherwise end the program when it does not.
fn refuse_too_little_memory(
    size: Resolution,
    bytes_per_pixel: impl Iterator<Item = usize>,
    reused: &[Values],
) -> Result<(), RenderError> {
    /// Smaller maps are not worth asking for.
    const LARGE: usize = 64 << 20;
    let sizes: Vec<usize> = bytes_per_pixel.map(|bytes| bytes.saturating_mul(size.pixels())).collect();
    let all = sizes.iter().fold(0_usize, |all, size| all.saturating_add(*size));
    if all < LARGE || !reused.is_empty() {
        return Ok(());
    }
    // Reserved channel by channel, as they will be, and given back untouched.
    let mut granted = Vec::with_capacity(sizes.len());
    for size in sizes {
        let mut memory = Vec::<u8>::new();
        if memory.try_reserve_exact(size).is_err() {
            return Err(RenderError::Memory { mebibytes: all >> 20 });
        }
        granted.push(memory);
    }
    Ok(())
}

/// The memory of a channel.
fn bytes_per_pixel(quantity: &Quantity, precision: Precision) -> usize {
    match quantity {
        Quantity::Position | Quantity::Normal => 24,
        Quantity::Shape => 4,
        _ if precision == Precision::Single && !is_always_double(quantity) => 4,
        _ => 8,
    }
}

/// Checks that a region lies in the image and fits into memory.
pub fn check(region: Region, full: Resolution) -> Result<(), RenderError> {
    let fits = |start: u32, size: u32, whole: u32| size > 0 && start < whole && size <= whole - start;
    if !fits(region.corner.column, region.size.width, full.width)
        || !fits(region.corner.row, region.size.height, full.height)
    {
        return Err(RenderError::Region { region, full });
    }
    if !region.size.fits_memory() {
        return Err(RenderError::TooLarge { size: region.size });
    }
    Ok(())
}

fn empty_channel(
    quantity: &Quantity,
    scene: &Scene,
    region: Region,
    precision: Precision,
    memory: &mut Vec<Values>,
) -> Result<Channel, RenderError> {
    if let Quantity::Light(name) = quantity
        && scene.light_named(name).is_none()
    {
        return Err(RenderError::NoSuchLight { name: name.clone() });
    }
    if *quantity == Quantity::Color {
        return Err(RenderError::NoColor);
    }
    if *quantity == Quantity::SamplingError && scene.sampling.tolerance.is_none() {
        return Err(RenderError::NoTolerance);
    }
    let pixels = region.size.pixels();
    let mut reuse = |fits: fn(&Values) -> bool| {
        let index = memory.iter().position(|values| fits(values) && values.len() == pixels);
        index.map(|index| memory.swap_remove(index))
    };
    let values = match quantity {
        Quantity::Position | Quantity::Normal => reuse(|values| matches!(values, Values::Vector(_)))
            .unwrap_or_else(|| Values::Vector(vec![[0.0; 3]; pixels])),
        // Written all at once when the mask is known.
        Quantity::Shape => Values::Index(Vec::new()),
        _ if precision == Precision::Single && !is_always_double(quantity) => {
            reuse(|values| matches!(values, Values::Single(_))).unwrap_or_else(|| Values::Single(vec![0.0; pixels]))
        }
        _ => reuse(|values| matches!(values, Values::Scalar(_))).unwrap_or_else(|| Values::Scalar(vec![0.0; pixels])),
    };
    let unit = quantity.unit(scene.convention, scene.unit_system, scene.length).into();
    Ok(Channel { quantity: quantity.clone(), unit, values })
}

/// Whether a quantity stays in double precision even in maps of single precision.
fn is_always_double(quantity: &Quantity) -> bool {
    matches!(quantity, Quantity::Depth | Quantity::Samples | Quantity::Coverage | Quantity::SamplingError)
}

/// Rows of a map that are to be filled.
pub struct Band<'m> {
    /// The top left pixel, in the full image.
    pub first: Pixel,
    /// The index of that pixel in the map.
    pub start: usize,
    /// Width and number of rows.
    pub size: Resolution,
    /// The unit in which lengths are stored.
    pub length: LengthUnit,
    /// The channels to fill, layer by layer: one layer for a scene without colours, otherwise one per component.
    pub layers: Vec<Vec<BandChannel<'m>>>,
}

/// A channel of a band that is to be filled. The shape channel is written at the end, from the mask.
pub enum BandChannel<'m> {
    /// Double precision.
    Double(ScalarChannel, &'m mut [f64]),
    /// Single precision.
    Single(ScalarChannel, &'m mut [f32]),
    /// P.
    Position(&'m mut [[f64; 3]]),
    /// N.
    Normal(&'m mut [[f64; 3]]),
}

/// What a scalar channel holds; a light is given by its index among the channels of lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScalarChannel {
    /// B.
    Brightness,
    /// E.
    Irradiance,
    /// E_a.
    Ambient,
    /// The standard error of the ambient light.
    AmbientError,
    /// The diffuse part of B.
    Diffuse,
    /// The specular part of B.
    Specular,
    /// t.
    Depth,
    /// E_j.
    Light(usize),
}

/// Cuts the maps of all layers into bands of this many rows, from the top.
pub fn split(layers: &mut [Map], rows: u32) -> Vec<Band<'_>> {
    let Map { region: Region { corner, size }, window, .. } = layers[0];
    let count = layers.len();
    let mut bands: Vec<Band<'_>> = (0..size.height)
        .step_by(rows as usize)
        .map(|row| Band {
            first: Pixel { column: corner.column, row: corner.row + row },
            start: row as usize * size.width as usize,
            size: Resolution { width: size.width, height: rows.min(size.height - row) },
            length: window.length,
            layers: (0..count).map(|_| Vec::new()).collect(),
        })
        .collect();
    let pixels = size.width as usize * rows as usize;
    for (layer, map) in layers.iter_mut().enumerate() {
        let mut lights = 0..;
        for Channel { quantity, values, .. } in &mut map.channels {
            for (band, part) in bands.iter_mut().zip(parts(quantity, values, &mut lights, pixels)) {
                band.layers[layer].push(part);
            }
        }
    }
    bands
}

/// The parts of a channel, each with this many pixels; none for a channel that is not computed pixel by pixel.
fn parts<'m>(
    quantity: &Quantity,
    values: &'m mut Values,
    lights: &mut impl Iterator<Item = usize>,
    pixels: usize,
) -> Vec<BandChannel<'m>> {
    match (values, ScalarChannel::of(quantity, lights)) {
        (Values::Scalar(values), Some(scalar)) => {
            values.chunks_mut(pixels).map(|part| BandChannel::Double(scalar, part)).collect()
        }
        (Values::Single(values), Some(scalar)) => {
            values.chunks_mut(pixels).map(|part| BandChannel::Single(scalar, part)).collect()
        }
        (Values::Vector(values), _) => {
            let part = if *quantity == Quantity::Normal { BandChannel::Normal } else { BandChannel::Position };
            values.chunks_mut(pixels).map(part).collect()
        }
        _ => Vec::new(),
    }
}

/// The buffers of maps, cleared for reuse: only the pixels that saw something are nonzero.
pub fn recycle(maps: impl IntoIterator<Item = Map>) -> Vec<Values> {
    maps.into_iter().flat_map(cleared).collect()
}

fn cleared(map: Map) -> impl Iterator<Item = Values> {
    let Map { mask, channels, .. } = map;
    let clear = move |mut values: Values| {
        for run in mask.runs() {
            let run = run.start..run.end;
            match &mut values {
                Values::Scalar(values) => values[run].fill(0.0),
                Values::Single(values) => values[run].fill(0.0),
                Values::Vector(values) => values[run].fill([0.0; 3]),
                Values::Index(_) => {}
            }
        }
        values
    };
    channels.into_iter().map(move |channel| clear(channel.values))
}

/// Gives maps their mask once their bands are filled, and writes the channels that follow from it.
pub fn finish(layers: &mut [Map], runs: Vec<Run>) {
    let mask = Mask::new(layers[0].region.size, runs);
    for map in layers {
        map.mask = mask.clone();
        finish_channels(map);
    }
}

fn finish_channels(map: &mut Map) {
    for channel in &mut map.channels {
        match (&channel.quantity, &mut channel.values) {
            (_, Values::Index(shapes)) => *shapes = map.mask.shapes(),
            // A single ray through the centre, and it hit.
            (Quantity::Samples | Quantity::Coverage, Values::Scalar(values)) => {
                for run in map.mask.runs() {
                    values[run.start..run.end].fill(1.0);
                }
            }
            _ => {}
        }
    }
}

impl ScalarChannel {
    /// The kind of a scalar channel that is computed pixel by pixel; `lights` yields the indices of the light channels.
    pub fn of(quantity: &Quantity, lights: &mut impl Iterator<Item = usize>) -> Option<Self> {
        match quantity {
            Quantity::Brightness => Some(Self::Brightness),
            Quantity::Irradiance => Some(Self::Irradiance),
            Quantity::Ambient => Some(Self::Ambient),
            Quantity::AmbientError => Some(Self::AmbientError),
            Quantity::Diffuse => Some(Self::Diffuse),
            Quantity::Specular => Some(Self::Specular),
            Quantity::Depth => Some(Self::Depth),
            Quantity::Light(_) => lights.next().map(Self::Light),
            Quantity::Position
            | Quantity::Normal
            | Quantity::Shape
            | Quantity::Samples
            | Quantity::Coverage
            | Quantity::SamplingError
            | Quantity::ZDepth
            | Quantity::CosThetaO
            | Quantity::CameraNormal
            | Quantity::Material
            | Quantity::LightBrightness(_)
            | Quantity::Color => None,
        }
    }
}

/// The lights whose own irradiance is requested, in the order of their channels.
pub fn asked_for(map: &Map, scene: &PreparedScene) -> Vec<usize> {
    let light = |channel: &Channel| match &channel.quantity {
        Quantity::Light(name) => scene.scene().light_named(name),
        _ => None,
    };
    map.channels.iter().filter_map(light).collect()
}

/// Pixels of the full image that are rendered together.
#[derive(Clone, Copy, Debug)]
pub struct Tile {
    /// The top left pixel.
    pub first: Pixel,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

/// Marks a pixel that sees nothing.
pub const NOTHING: u32 = u32::MAX;

impl Band<'_> {
    /// Cuts the band into tiles of up to this many columns and rows: their edges are the same for any region of the image.
    pub fn tiles(&self, width: u32, height: u32) -> Vec<Tile> {
        let parts = |first: u32, count: u32, size: u32| {
            let end = first + count;
            let mut start = first;
            std::iter::from_fn(move || {
                let next = ((start / size + 1) * size).min(end);
                let part = (start < end).then_some((start, next - start));
                start = next;
                part
            })
        };
        let row = |(row, height)| {
            let tile = move |(column, width)| Tile { first: Pixel { column, row }, width, height };
            parts(self.first.column, self.size.width, width).map(tile)
        };
        parts(self.first.row, self.size.height, height).flat_map(row).collect()
    }

    /// The runs of the band, from the shapes that its pixels see, or [`NOTHING`].
    pub fn runs(&self, seen: &[u32]) -> Vec<Run> {
        let mut runs = Vec::new();
        let width = self.size.width as usize;
        for (row, seen) in seen.chunks_exact(width).enumerate() {
            let mut start = 0;
            while start < width {
                let shape = seen[start];
                let length = seen[start..].iter().take_while(|other| **other == shape).count();
                if shape != NOTHING {
                    let start = self.start + row * width + start;
                    runs.push(Run { start, end: start + length, shape });
                }
                start += length;
            }
        }
        runs
    }

    /// Whether depth, position or normal are requested.
    pub fn has_geometry(&self) -> bool {
        let is_geometry = |channel: &BandChannel<'_>| {
            matches!(
                channel,
                BandChannel::Double(ScalarChannel::Depth, _) | BandChannel::Position(_) | BandChannel::Normal(_)
            )
        };
        self.layers.iter().flatten().any(is_geometry)
    }

    /// Whether anything but brightness is requested of the light.
    pub fn shows_parts(&self) -> bool {
        let is_brightness = |channel: &BandChannel<'_>| {
            matches!(
                channel,
                BandChannel::Double(ScalarChannel::Brightness, _) | BandChannel::Single(ScalarChannel::Brightness, _)
            )
        };
        !self.layers.iter().flatten().all(is_brightness)
    }

    /// The index in the band of a pixel of the full image.
    pub fn index(&self, pixel: Pixel) -> usize {
        let row = (pixel.row - self.first.row) as usize;
        row * self.size.width as usize + (pixel.column - self.first.column) as usize
    }

    /// The pixel of the full image at an index of the band.
    #[expect(clippy::cast_possible_truncation, reason = "an index of a map is below 2^27")]
    pub fn pixel(&self, index: usize) -> Pixel {
        let width = self.size.width as usize;
        Pixel { column: self.first.column + (index % width) as u32, row: self.first.row + (index / width) as u32 }
    }

    /// Adds `count` pixels of a row, starting at `first`, to the visible runs; extends the last run if they continue it.
    pub fn see(&self, first: Pixel, count: u32, shape: usize, runs: &mut Vec<Run>) {
        let start = self.start + self.index(first);
        let end = start + count as usize;
        let shape = u32::try_from(shape).unwrap_or(u32::MAX);
        match runs.last_mut() {
            Some(last) if last.end == start && last.shape == shape && first.column != self.first.column => {
                last.end = end;
            }
            _ => runs.push(Run { start, end, shape }),
        }
    }
}

/// Reports progress to the observer, and returns an error if it asks to stop.
pub fn advance(observer: Option<&dyn Observer>, pixels: u64) -> Result<(), RenderError> {
    match observer.map(|observer| observer.advance(pixels)) {
        Some(ControlFlow::Break(())) => Err(RenderError::Interrupted),
        _ => Ok(()),
    }
}
