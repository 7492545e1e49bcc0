//! Maps as arrays, and what is known of them.

use std::num::NonZero;

use isophote::analysis::isophotes::{isophotes, nice_levels};
use isophote::analysis::statistics::{Extreme, Statistics, counts, statistics};
use isophote::lanes::Precision;
use isophote::map::{Map, Pixel, Provenance, Quantity, Region, Resolution, Values, Window};
use isophote::message;
use isophote::prepare::PreparedScene;
use isophote::render::{RenderSettings, Renderer, SimdRenderer};
use serde::Serialize;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::problem::{Refusal, json};
use crate::request::{Edges, FrameHead, Levels, in_unit};

/// Some rows of a map, or the whole of one.
#[wasm_bindgen]
pub struct Band {
    head: String,
    values: Vec<f64>,
    shapes: Vec<i32>,
}

#[wasm_bindgen]
impl Band {
    /// Everything but the values, as JSON.
    #[wasm_bindgen(getter)]
    #[must_use]
    pub fn head(&self) -> String {
        self.head.clone()
    }

    /// The values, row by row; the band is left without them.
    pub fn take_values(&mut self) -> Vec<f64> {
        std::mem::take(&mut self.values)
    }

    /// The indices of the shapes seen, row by row; the band is left without them.
    pub fn take_shapes(&mut self) -> Vec<i32> {
        std::mem::take(&mut self.shapes)
    }
}

#[derive(Serialize)]
struct BandHead {
    channel: String,
    unit: String,
    width: u32,
    height: u32,
    /// The size of the whole image.
    full: [u32; 2],
    window: Edges,
    coordinates: isophote::map::Coordinates,
    axes: [AxisAnswer; 2],
    /// Pixels that receive any light, if the map says so.
    lit: Option<usize>,
}

#[derive(Serialize)]
struct AxisAnswer {
    name: &'static str,
    title: &'static str,
    unit: &'static str,
}

impl Band {
    /// A channel of a map.
    pub(crate) fn of(map: Map, quantity: &Quantity) -> Result<Self, Refusal> {
        Self::called(quantity, map, quantity)
    }

    /// A channel of a map under another name.
    pub(crate) fn called(name: &Quantity, mut map: Map, quantity: &Quantity) -> Result<Self, Refusal> {
        let (shapes, lit) = (map.mask().shapes(), counts(&map).lit);
        let Map { full, region, window, .. } = map;
        let axes = window.coordinates.axes(window.length);
        let unit = map.channel(quantity).map_or_else(String::new, |channel| channel.unit.clone());
        let head = json(&BandHead {
            channel: name.name(),
            unit,
            width: region.size.width,
            height: region.size.height,
            full: [full.width, full.height],
            window: Edges { x: window.x, y: window.y },
            coordinates: window.coordinates,
            axes: axes.map(|axis| AxisAnswer { name: axis.name, title: axis.title, unit: axis.unit }),
            lit,
        })?;
        let values = match map.take(quantity) {
            Some(Values::Scalar(values)) => values,
            Some(Values::Single(values)) => values.into_iter().map(f64::from).collect(),
            _ => {
                return Err(Refusal(message!(
                    "the channel `{channel}` is not one number per pixel",
                    channel = quantity.name()
                )));
            }
        };
        Ok(Self { head, values, shapes })
    }
}

/// Renders channels of a part of the image.
pub fn render(prepared: &PreparedScene, quantities: Vec<Quantity>, region: Option<Region>) -> Result<Map, Refusal> {
    let settings = RenderSettings { region, quantities, ..RenderSettings::default() };
    Ok(SimdRenderer::new(Precision::Double, Some(NonZero::<usize>::MIN)).render(prepared, &settings)?)
}

/// Some rows of the image of a scene.
pub fn rows(size: Resolution, first: u32, count: u32) -> Region {
    Region { corner: Pixel { column: 0, row: first }, size: Resolution { width: size.width, height: count } }
}

/// Statistics and isophotes of a frame.
#[derive(Serialize)]
pub struct Analysis {
    statistics: StatisticsAnswer,
    isophotes: Vec<IsophoteAnswer>,
}

#[derive(Serialize)]
struct StatisticsAnswer {
    pixels: usize,
    visible: usize,
    lit: Option<usize>,
    max: Option<ExtremeAnswer>,
    min: Option<ExtremeAnswer>,
    mean: Option<f64>,
}

#[derive(Serialize)]
struct ExtremeAnswer {
    value: f64,
    pixel: [u32; 2],
    screen: [f64; 2],
    point: Option<[f64; 3]>,
}

#[derive(Serialize)]
struct IsophoteAnswer {
    level: f64,
    lines: Vec<LineAnswer>,
}

#[derive(Serialize)]
struct LineAnswer {
    points: Vec<[f64; 2]>,
    closed: bool,
}

impl Analysis {
    /// Of the values of a frame whose map was `head`.
    pub fn new(
        prepared: &PreparedScene,
        head: &FrameHead,
        values: Vec<f64>,
        shapes: Vec<i32>,
        levels: &Levels,
    ) -> Result<Self, Refusal> {
        let quantity = Quantity::from_name(&head.channel)
            .ok_or_else(|| Refusal(message!("there is no channel `{channel}`", channel = head.channel)))?;
        let map = map_again(prepared, head, &quantity, values, shapes)?;
        let statistics = statistics(&map, &quantity);
        let levels = match (levels, &statistics) {
            (Levels::These(levels), _) => levels.clone(),
            (Levels::About(count), Some(Statistics { max, min, .. })) if *count > 0 => {
                nice_levels(min.value, max.value, *count)
            }
            _ => Vec::new(),
        };
        let curves = isophotes(&map, &quantity, &levels)?.into_iter().map(|isophote| IsophoteAnswer {
            level: isophote.level,
            lines: isophote
                .lines
                .into_iter()
                .map(|line| LineAnswer {
                    points: line.points.iter().map(|point| [point.x, point.y]).collect(),
                    closed: line.closed,
                })
                .collect(),
        });
        let counted = counts(&map);
        let is_camera = map.window.coordinates.is_screen();
        let full = prepared.scene().camera().resolution == map.full;
        let extreme = |extreme: Extreme| ExtremeAnswer {
            value: extreme.value,
            pixel: [extreme.pixel.column, extreme.pixel.row],
            screen: map.center(extreme.pixel),
            point: (is_camera && full)
                .then(|| prepared.trace_pixel(extreme.pixel))
                .flatten()
                .map(|hit| in_unit(hit.point.position(), prepared.scene().length())),
        };
        Ok(Self {
            statistics: StatisticsAnswer {
                pixels: counted.pixels,
                visible: counted.visible,
                lit: head.lit,
                max: statistics.map(|statistics| extreme(statistics.max)),
                min: statistics.map(|statistics| extreme(statistics.min)),
                mean: statistics.map(|statistics| statistics.mean),
            },
            isophotes: curves.collect(),
        })
    }
}

/// The map that a frame was, of its values.
fn map_again(
    prepared: &PreparedScene,
    head: &FrameHead,
    quantity: &Quantity,
    values: Vec<f64>,
    shapes: Vec<i32>,
) -> Result<Map, Refusal> {
    let scene = prepared.scene();
    let (x, y) = (head.window.x, head.window.y);
    let window = Window { x, y, length: scene.length(), coordinates: head.coordinates };
    let provenance = Provenance {
        program: String::new(),
        title: String::new(),
        scene: String::new(),
        files: Vec::new(),
        convention: scene.convention().label(),
        renderer: String::new(),
        color_space: None,
    };
    let size = Resolution { width: head.width, height: head.height };
    let builder = Map::builder(size, window, provenance).shapes(shapes);
    Ok(builder.channel(quantity.clone(), &head.unit, Values::Scalar(values)).build()?)
}
