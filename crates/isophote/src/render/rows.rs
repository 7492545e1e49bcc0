//! A map that is being filled, row by row.

use super::{Observer, RenderError, RenderSettings};
use crate::map::{Channel, Map, Pixel, Provenance, Quantity, Region, Values, Window};
use crate::prepare::{Hit, PreparedScene};
use crate::scene::Scene;
use crate::units::LengthUnit;

/// A map of zeros (−1 for the shape), with every channel that the settings ask for.
pub fn empty_map(scene: &PreparedScene, settings: &RenderSettings<'_>, renderer: String) -> Result<Map, RenderError> {
    let description = scene.scene();
    let full = description.camera.resolution;
    let region = settings.region.unwrap_or(Region::all(full));
    let fits = |start: u32, size: u32, whole: u32| size > 0 && start < whole && size <= whole - start;
    if !fits(region.corner.column, region.size.width, full.width)
        || !fits(region.corner.row, region.size.height, full.height)
    {
        return Err(RenderError::Region { region, full });
    }
    if !region.size.fits_memory() {
        return Err(RenderError::TooLarge { size: region.size });
    }
    let mut channels: Vec<Channel> = Vec::new();
    for quantity in settings.quantities.iter().chain([&Quantity::Shape]) {
        if channels.iter().all(|channel| channel.quantity != *quantity) {
            channels.push(empty_channel(quantity, description, region)?);
        }
    }
    let provenance = Provenance {
        program: concat!("isophote ", env!("CARGO_PKG_VERSION")).into(),
        title: description.title.clone(),
        scene: description.source.to_toml(),
        convention: description.convention.label(),
        renderer,
    };
    Ok(Map { full, region, window: window(description, region), provenance, channels })
}

fn empty_channel(quantity: &Quantity, scene: &Scene, region: Region) -> Result<Channel, RenderError> {
    if let Quantity::Light(name) = quantity
        && scene.lights.iter().all(|light| light.name != *name)
    {
        return Err(RenderError::NoSuchLight { name: name.clone() });
    }
    let pixels = region.size.pixels();
    let values = match quantity {
        Quantity::Position | Quantity::Normal => Values::Vector(vec![[0.0; 3]; pixels]),
        Quantity::Shape => Values::Index(vec![-1; pixels]),
        _ => Values::Scalar(vec![0.0; pixels]),
    };
    let unit = quantity.unit(scene.convention, scene.quantities, scene.length).into();
    Ok(Channel { quantity: quantity.clone(), unit, values })
}

fn window(scene: &Scene, region: Region) -> Window {
    let full = scene.camera.resolution;
    let screen = scene.camera.screen;
    let edge = |[first, last]: [f64; 2], edge: u32, count: u32| {
        let part = f64::from(edge) / f64::from(count);
        scene.length.from_metres(first * (1.0 - part) + last * part)
    };
    let [bottom, top] = screen.y;
    let x = |column| edge(screen.x, column, full.width);
    let y = |row| edge([top, bottom], row, full.height);
    let Region { corner, size } = region;
    Window {
        x: [x(corner.column), x(corner.column + size.width)],
        y: [y(corner.row + size.height), y(corner.row)],
        length: scene.length,
    }
}

/// A row of a map, to be filled.
pub struct Row<'m> {
    first: Pixel,
    width: u32,
    length: LengthUnit,
    channels: Vec<RowChannel<'m>>,
}

/// What goes into a row, and where.
enum RowChannel<'m> {
    Scalar(Scalar, &'m mut [f64]),
    Position(&'m mut [[f64; 3]]),
    Normal(&'m mut [[f64; 3]]),
    Shape(&'m mut [i32]),
}

/// What a scalar channel holds; a light by its index.
#[derive(Clone, Copy)]
enum Scalar {
    Brightness,
    Irradiance,
    Diffuse,
    Specular,
    Depth,
    Light(usize),
}

/// The rows of a map, from the top.
pub fn split<'m>(map: &'m mut Map, scene: &PreparedScene) -> Vec<Row<'m>> {
    let Region { corner, size } = map.region;
    let length = map.window.length;
    let mut rows: Vec<Row<'_>> = (corner.row..corner.row + size.height)
        .map(|row| Row { first: Pixel { column: corner.column, row }, width: size.width, length, channels: Vec::new() })
        .collect();
    for channel in &mut map.channels {
        for (row, part) in rows.iter_mut().zip(parts(channel, size.width as usize, scene.scene())) {
            row.channels.push(part);
        }
    }
    rows
}

/// A channel cut into rows.
fn parts<'m>(channel: &'m mut Channel, width: usize, scene: &Scene) -> Vec<RowChannel<'m>> {
    let Channel { quantity, values, .. } = channel;
    match values {
        Values::Scalar(values) => {
            let scalar = Scalar::of(quantity, scene);
            values.chunks_mut(width).map(|row| RowChannel::Scalar(scalar, row)).collect()
        }
        Values::Vector(values) => {
            let row = if *quantity == Quantity::Normal { RowChannel::Normal } else { RowChannel::Position };
            values.chunks_mut(width).map(row).collect()
        }
        Values::Index(values) => values.chunks_mut(width).map(RowChannel::Shape).collect(),
    }
}

impl Scalar {
    fn of(quantity: &Quantity, scene: &Scene) -> Self {
        let light = |name: &String| scene.lights.iter().position(|light| light.name == *name);
        match quantity {
            Quantity::Brightness => Self::Brightness,
            Quantity::Irradiance => Self::Irradiance,
            Quantity::Diffuse => Self::Diffuse,
            Quantity::Specular => Self::Specular,
            Quantity::Depth => Self::Depth,
            Quantity::Light(name) => Self::Light(light(name).expect("the map was made for this scene")),
            Quantity::Position | Quantity::Normal | Quantity::Shape => {
                unreachable!("`empty_channel` gives it other values")
            }
        }
    }
}

impl Row<'_> {
    /// Fills the row.
    pub fn render(&mut self, scene: &PreparedScene, observer: Option<&dyn Observer>) -> Result<(), RenderError> {
        let mut by_light = vec![0.0; scene.scene().lights.len()];
        for index in 0..self.width {
            let pixel = Pixel { column: self.first.column + index, row: self.first.row };
            if let Some(hit) = scene.trace_pixel(pixel) {
                self.store(index as usize, scene, &hit, &mut by_light);
            }
        }
        let go_on = observer.map(|observer| observer.advance(u64::from(self.width)));
        if go_on.is_some_and(|answer| answer.is_break()) { Err(RenderError::Interrupted) } else { Ok(()) }
    }

    fn store(&mut self, index: usize, scene: &PreparedScene, hit: &Hit, by_light: &mut [f64]) {
        let shading = scene.shade(hit.shape, &hit.point, |light, term| by_light[light] = term.irradiance);
        let length = self.length;
        for channel in &mut self.channels {
            match channel {
                RowChannel::Scalar(scalar, values) => {
                    values[index] = match *scalar {
                        Scalar::Brightness => shading.brightness(),
                        Scalar::Irradiance => shading.irradiance,
                        Scalar::Diffuse => shading.diffuse,
                        Scalar::Specular => shading.specular,
                        Scalar::Depth => length.from_metres(hit.distance),
                        Scalar::Light(light) => by_light[light],
                    }
                }
                RowChannel::Position(values) => {
                    let position = hit.point.position().to_array();
                    values[index] = position.map(|coordinate| length.from_metres(coordinate));
                }
                RowChannel::Normal(values) => values[index] = hit.point.normal.to_array(),
                RowChannel::Shape(values) => values[index] = i32::try_from(hit.shape).unwrap_or(i32::MAX),
            }
        }
    }
}
