//! Maps whose cells are no pixels of a camera.

use rayon::prelude::*;

use crate::map::{Channel, Map, Mask, Pixel, Quantity, Region, Resolution, Values, Window};
use crate::prepare::PreparedScene;
use crate::render::provenance;
use crate::scene::Scene;
use crate::shade::{ByLight, Shading};
use crate::vector::Vector;

/// What is computed at the centre of a cell.
pub(super) struct Cell {
    /// The point, in metres.
    pub(super) position: Vector,
    /// The unit normal on the side that is lit.
    pub(super) normal: Vector,
    pub(super) shading: Shading,
    /// E_j of the lights that are asked for.
    pub(super) lights: ByLight,
}

/// Where a map of cells lies.
pub(super) struct Layout {
    pub(super) size: Resolution,
    pub(super) window: Window,
    /// What the map is of, and how it was computed.
    pub(super) renderer: String,
    /// Index of the shape that all cells are of.
    pub(super) shape: u32,
}

/// The map of such cells. Cells of which nothing is known are left out of the mask.
pub(super) fn map(
    scene: &PreparedScene,
    layout: Layout,
    quantities: &[Quantity],
    cell: impl Fn(Pixel) -> Option<Cell> + Sync,
) -> Map {
    let Layout { size, window, renderer, shape } = layout;
    let description = scene.scene();
    let mut channels: Vec<Channel> = Vec::new();
    for quantity in quantities {
        if channels.iter().all(|channel| channel.quantity != *quantity) {
            let unit = quantity.unit(description.convention, description.unit_system, description.length);
            channels.push(Channel { quantity: quantity.clone(), unit: unit.into(), values: no_values(quantity) });
        }
    }
    let mut shapes = Vec::with_capacity(size.pixels());
    for row in 0..size.height {
        let cells: Vec<Option<Cell>> =
            (0..size.width).into_par_iter().map(|column| cell(Pixel { column, row })).collect();
        let shape = shape.cast_signed();
        shapes.extend(cells.iter().map(|cell| if cell.is_some() { shape } else { -1 }));
        for channel in &mut channels {
            push(channel, &cells, description, shape, window);
        }
    }
    let mask = Mask::of_shapes(size, &shapes);
    Map { full: size, region: Region::all(size), window, provenance: provenance(scene, renderer), mask, channels }
}

/// The indices of the lights among these quantities.
///
/// # Errors
/// The name of a light that the scene does not have.
pub(super) fn lights(scene: &PreparedScene, quantities: &[Quantity]) -> Result<Vec<usize>, String> {
    let mut lights = Vec::new();
    for quantity in quantities {
        let Quantity::Light(name) = quantity else { continue };
        lights.push(scene.scene().light_named(name).ok_or_else(|| name.clone())?);
    }
    Ok(lights)
}

fn no_values(quantity: &Quantity) -> Values {
    match quantity {
        Quantity::Position | Quantity::Normal => Values::Vector(Vec::new()),
        Quantity::Shape => Values::Index(Vec::new()),
        _ => Values::Scalar(Vec::new()),
    }
}

fn push(channel: &mut Channel, cells: &[Option<Cell>], scene: &Scene, shape: i32, window: Window) {
    let in_unit = |vector: Vector| vector.to_array().map(|metres| window.length.from_metres(metres));
    let light = match &channel.quantity {
        Quantity::Light(name) => scene.light_named(name),
        _ => None,
    };
    let scalar = |cell: &Cell| match channel.quantity {
        Quantity::Irradiance => cell.shading.irradiance,
        Quantity::Ambient => cell.shading.ambient,
        Quantity::Diffuse => cell.shading.diffuse,
        Quantity::Specular => cell.shading.specular,
        Quantity::Light(_) => light.map_or(0.0, |light| cell.lights.irradiance(light)),
        _ => cell.shading.brightness(),
    };
    let is_normal = channel.quantity == Quantity::Normal;
    let vector = |cell: &Cell| if is_normal { cell.normal.to_array() } else { in_unit(cell.position) };
    let known = |cell: &Option<Cell>| cell.is_some();
    match &mut channel.values {
        Values::Scalar(values) => values.extend(cells.iter().map(|cell| cell.as_ref().map_or(0.0, scalar))),
        Values::Vector(values) => values.extend(cells.iter().map(|cell| cell.as_ref().map_or([0.0; 3], vector))),
        Values::Index(values) => values.extend(cells.iter().map(|cell| if known(cell) { shape } else { -1 })),
        Values::Single(_) => {}
    }
}
