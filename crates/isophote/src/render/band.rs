//! A map that is being filled, band by band.

use std::ops::ControlFlow;

use super::{Observer, RenderError, RenderSettings};
use crate::camera::ScreenPosition;
use crate::lanes::{Element, Precision};
use crate::map::{Channel, Map, Mask, Pixel, Provenance, Quantity, Region, Resolution, Run, Values};
use crate::prepare::{Hit, PreparedScene};
use crate::scene::Scene;
use crate::shade::ByLight;
use crate::units::{Keyword, LengthUnit};

/// A map of zeros (−1 for the shape) that sees nothing, with every channel that the settings ask for. In single
/// precision the geometry (depth, position, normal) is double all the same. `memory` is cleared memory to be used
/// again.
pub fn empty_map(
    scene: &PreparedScene,
    settings: &RenderSettings<'_>,
    renderer: String,
    precision: Precision,
    mut memory: Vec<Values>,
) -> Result<Map, RenderError> {
    let description = scene.scene();
    let full = description.camera.resolution;
    let region = settings.region.unwrap_or(Region::all(full));
    check(region, full)?;
    let mut channels: Vec<Channel> = Vec::new();
    for quantity in &settings.quantities {
        if channels.iter().all(|channel| channel.quantity != *quantity) {
            channels.push(empty_channel(quantity, description, region, precision, &mut memory)?);
        }
    }
    let mask = Mask::new(region.size, Vec::new());
    let window = description.camera.window(region, description.length);
    Ok(Map { full, region, window, provenance: provenance(scene, renderer), mask, channels })
}

/// What a map of the scene says about itself.
pub fn provenance(scene: &PreparedScene, renderer: String) -> Provenance {
    Provenance {
        program: concat!("isophote ", env!("CARGO_PKG_VERSION")).into(),
        title: scene.scene().title.clone(),
        scene: scene.source_text().to_owned(),
        convention: scene.scene().convention.label(),
        renderer,
        color_space: scene.components().map(|components| components.space.name().to_owned()),
    }
}

/// Whether a region is one of the image, and fits into memory.
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
    let pixels = region.size.pixels();
    let mut reuse = |fits: fn(&Values) -> bool| {
        let index = memory.iter().position(|values| fits(values) && values.len() == pixels);
        index.map(|index| memory.swap_remove(index))
    };
    let values = match quantity {
        Quantity::Position | Quantity::Normal => reuse(|values| matches!(values, Values::Vector(_)))
            .unwrap_or_else(|| Values::Vector(vec![[0.0; 3]; pixels])),
        // Written as a whole when the mask is known.
        Quantity::Shape => Values::Index(Vec::new()),
        _ if precision == Precision::Single && !is_always_double(quantity) => {
            reuse(|values| matches!(values, Values::Single(_))).unwrap_or_else(|| Values::Single(vec![0.0; pixels]))
        }
        _ => reuse(|values| matches!(values, Values::Scalar(_))).unwrap_or_else(|| Values::Scalar(vec![0.0; pixels])),
    };
    let unit = quantity.unit(scene.convention, scene.unit_system, scene.length).into();
    Ok(Channel { quantity: quantity.clone(), unit, values })
}

/// What single precision does not make smaller.
fn is_always_double(quantity: &Quantity) -> bool {
    matches!(quantity, Quantity::Depth | Quantity::Samples | Quantity::Coverage)
}

/// Rows of a map, to be filled.
pub struct Band<'m> {
    /// The top left pixel, of the full image.
    pub first: Pixel,
    /// Index in the map of that pixel.
    pub start: usize,
    /// Width and rows.
    pub size: Resolution,
    /// The unit in which lengths are stored.
    pub length: LengthUnit,
    /// What is to be filled in.
    pub channels: Vec<BandChannel<'m>>,
}

/// What goes into a band, and where. The shape comes from the mask in the end.
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

/// What a scalar channel holds; a light by its index.
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

/// Cuts a map into bands of so many rows, from the top.
pub fn split<'m>(map: &'m mut Map, scene: &PreparedScene, rows: u32) -> Vec<Band<'m>> {
    let Region { corner, size } = map.region;
    let pixels = size.width as usize * rows as usize;
    let mut bands: Vec<Band<'_>> = (0..size.height)
        .step_by(rows as usize)
        .map(|row| Band {
            first: Pixel { column: corner.column, row: corner.row + row },
            start: row as usize * size.width as usize,
            size: Resolution { width: size.width, height: rows.min(size.height - row) },
            length: map.window.length,
            channels: Vec::new(),
        })
        .collect();
    let is_computed = |quantity: &Quantity| !matches!(quantity, Quantity::Samples | Quantity::Coverage);
    for Channel { quantity, values, .. } in map.channels.iter_mut().filter(|channel| is_computed(&channel.quantity)) {
        let parts: Vec<BandChannel<'_>> = match values {
            Values::Scalar(values) => {
                let scalar = ScalarChannel::of(quantity, scene.scene());
                values.chunks_mut(pixels).map(|part| BandChannel::Double(scalar, part)).collect()
            }
            Values::Single(values) => {
                let scalar = ScalarChannel::of(quantity, scene.scene());
                values.chunks_mut(pixels).map(|part| BandChannel::Single(scalar, part)).collect()
            }
            Values::Vector(values) => {
                let part = if *quantity == Quantity::Normal { BandChannel::Normal } else { BandChannel::Position };
                values.chunks_mut(pixels).map(part).collect()
            }
            Values::Index(_) => continue,
        };
        for (band, part) in bands.iter_mut().zip(parts) {
            band.channels.push(part);
        }
    }
    bands
}

/// The memory of a map, cleared: only where it saw something is it not zero.
pub fn recycle(map: Map) -> Vec<Values> {
    let Map { mask, channels, .. } = map;
    let clear = |mut values: Values| {
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
    channels.into_iter().map(|channel| clear(channel.values)).collect()
}

/// Gives a map whose bands are filled its mask, and the channels that follow from it.
pub fn finish(map: &mut Map, runs: Vec<Run>) {
    map.mask = Mask::new(map.region.size, runs);
    for channel in &mut map.channels {
        match (&channel.quantity, &mut channel.values) {
            (_, Values::Index(shapes)) => *shapes = map.mask.shapes(),
            // One ray through the centre, which met it.
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
    /// The kind of a scalar channel that renderers fill in.
    pub fn of(quantity: &Quantity, scene: &Scene) -> Self {
        match quantity {
            Quantity::Brightness => Self::Brightness,
            Quantity::Irradiance => Self::Irradiance,
            Quantity::Ambient => Self::Ambient,
            Quantity::AmbientError => Self::AmbientError,
            Quantity::Diffuse => Self::Diffuse,
            Quantity::Specular => Self::Specular,
            Quantity::Depth => Self::Depth,
            Quantity::Light(name) => Self::Light(scene.light_named(name).expect("the map was made for this scene")),
            Quantity::Position
            | Quantity::Normal
            | Quantity::Shape
            | Quantity::Samples
            | Quantity::Coverage
            | Quantity::Color => unreachable!("renderers do not fill it in"),
        }
    }

    /// The index of the light whose irradiance it is.
    pub fn light(self) -> Option<usize> {
        match self {
            Self::Light(light) => Some(light),
            _ => None,
        }
    }
}

impl Band<'_> {
    /// Fills the band pixel by pixel, and says what its pixels see.
    pub fn render(&mut self, scene: &PreparedScene, observer: Option<&dyn Observer>) -> Result<Vec<Run>, RenderError> {
        let mut runs = Vec::new();
        let asks_often = scene.scene().lights().len() > 1000;
        for row in 0..self.size.height {
            for column in 0..self.size.width {
                if asks_often {
                    advance(observer, 0)?;
                }
                let pixel = Pixel { column: self.first.column + column, row: self.first.row + row };
                if let Some(hit) = scene.trace_pixel(pixel) {
                    self.store(pixel, scene, &hit)?;
                    self.see(pixel, 1, hit.primitive.shape, &mut runs);
                }
            }
            advance(observer, self.size.width.into())?;
        }
        Ok(runs)
    }

    /// The lights whose irradiance is asked for by itself, in the order of their channels.
    pub fn lights(&self) -> Vec<usize> {
        let light = |channel: &BandChannel<'_>| match channel {
            BandChannel::Double(scalar, _) | BandChannel::Single(scalar, _) => scalar.light(),
            BandChannel::Position(_) | BandChannel::Normal(_) => None,
        };
        self.channels.iter().filter_map(light).collect()
    }

    /// Whether depth, position or normal are asked for.
    pub fn has_geometry(&self) -> bool {
        let is_geometry = |channel: &BandChannel<'_>| {
            matches!(
                channel,
                BandChannel::Double(ScalarChannel::Depth, _) | BandChannel::Position(_) | BandChannel::Normal(_)
            )
        };
        self.channels.iter().any(is_geometry)
    }

    /// Index in the band of a pixel of the full image.
    pub fn index(&self, pixel: Pixel) -> usize {
        let row = (pixel.row - self.first.row) as usize;
        row * self.size.width as usize + (pixel.column - self.first.column) as usize
    }

    /// Adds so many pixels of a row, from this one on, to what is seen; lengthens the last run if it goes on there.
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

    /// Shades what is seen at a pixel and stores it.
    pub fn store(&mut self, pixel: Pixel, scene: &PreparedScene, hit: &Hit) -> Result<(), RenderError> {
        let index = self.index(pixel);
        let mut by_light = ByLight::of(self.lights());
        let position = ScreenPosition::PixelCenter(pixel);
        let shading = scene.shade(hit, Some(position), |light, term| by_light.take(light, term));
        let length = self.length;
        let scalar = |scalar: ScalarChannel| match scalar {
            ScalarChannel::Brightness => shading.brightness(),
            ScalarChannel::Irradiance => shading.irradiance,
            ScalarChannel::Ambient => shading.ambient,
            ScalarChannel::AmbientError => scene.ambient_irradiance(hit).standard_error,
            ScalarChannel::Diffuse => shading.diffuse,
            ScalarChannel::Specular => shading.specular,
            ScalarChannel::Depth => length.from_metres(hit.distance),
            ScalarChannel::Light(light) => by_light.irradiance(light),
        };
        for channel in &mut self.channels {
            match channel {
                BandChannel::Double(quantity, values) => values[index] = scalar(*quantity),
                BandChannel::Single(quantity, values) => {
                    let value = scalar(*quantity);
                    values[index] = f32::from_f64(value);
                    if !values[index].is_finite() {
                        return Err(RenderError::Overflow { pixel, value });
                    }
                }
                BandChannel::Position(values) => {
                    let position = hit.point.position().to_array();
                    values[index] = position.map(|coordinate| length.from_metres(coordinate));
                }
                BandChannel::Normal(values) => values[index] = hit.point.normal.to_array(),
            }
        }
        Ok(())
    }
}

/// Tells the observer, and hears whether to go on.
pub fn advance(observer: Option<&dyn Observer>, pixels: u64) -> Result<(), RenderError> {
    match observer.map(|observer| observer.advance(pixels)) {
        Some(ControlFlow::Break(())) => Err(RenderError::Interrupted),
        _ => Ok(()),
    }
}
