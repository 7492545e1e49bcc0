//! Questions, as the page writes them.

use isophote::analysis::probe::ProbePosition;
use isophote::map::{Pixel, Quantity};
use isophote::message;
use isophote::scene::Scene;
use isophote::text::Message;
use isophote::units::{Keyword, LengthUnit};
use isophote::vector::Vector;
use isophote_export::colormap::Colormap;
use isophote_export::png::Normalization;
use serde::{Deserialize, Serialize};

use crate::problem::Refusal;

/// A place where a value is wanted: exactly one of `at`, `pixel`, `screen` and `angles`.
#[derive(Deserialize)]
pub struct ProbeRequest {
    pub name: String,
    at: Option<[f64; 3]>,
    #[serde(default)]
    snap: bool,
    pixel: Option<[u32; 2]>,
    screen: Option<[f64; 2]>,
    shape: Option<String>,
    angles: Option<[f64; 2]>,
}

impl ProbeRequest {
    pub fn position(&self, scene: &Scene) -> Result<ProbePosition, Refusal> {
        if let Some(at) = self.at {
            let point = Vector::from(at.map(|coordinate| scene.length().to_metres(coordinate)));
            return Ok(if self.snap { ProbePosition::NearestTo(point) } else { ProbePosition::Point(point) });
        }
        if let Some([column, row]) = self.pixel {
            return Ok(ProbePosition::Pixel(Pixel { column, row }));
        }
        if let Some(screen) = self.screen {
            let [x, y] = screen.map(|coordinate| scene.screen_unit().to_internal(coordinate));
            return Ok(ProbePosition::Screen { x, y });
        }
        match (&self.shape, self.angles) {
            (Some(name), Some([theta, phi])) => {
                let shape = shape_named(name, scene)?;
                Ok(ProbePosition::Angles { shape, theta: theta.to_radians(), phi: phi.to_radians() })
            }
            _ => Err(Refusal(message!("a probe needs a point, a pixel, a screen point, or angles on a shape"))),
        }
    }
}

/// A line on the screen.
#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum SectionRequest {
    Row { row: u32 },
    Column { column: u32 },
    Horizontal { y: f64 },
    Vertical { x: f64 },
    Between { from: [f64; 2], to: [f64; 2] },
    Through { shape: String },
}

/// A map over a shape's own surface.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct SurfaceRequest {
    pub shape: String,
    pub width: u32,
    #[serde(default)]
    pub equal_area: bool,
}

/// How values become a picture.
#[derive(Deserialize)]
pub struct PictureStyle {
    colormap: String,
    pub range: Option<[f64; 2]>,
    normalization: String,
    pub isophotes: usize,
}

impl PictureStyle {
    pub fn colormap(&self) -> Result<Colormap, Refusal> {
        colormap(&self.colormap)
    }

    pub fn normalization(&self) -> Result<Normalization, Refusal> {
        keyword(&self.normalization, |name, allowed| {
            message!("there is no normalization `{name}`; allowed: {allowed}", name, allowed)
        })
    }
}

/// A file to be made.
#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum ExportRequest {
    Png { channel: String, style: PictureStyle },
    FigureSvg { channel: String, style: PictureStyle, marks: bool },
    FigurePng { channel: String, style: PictureStyle, marks: bool },
    MapCsv { channels: Vec<String> },
    SectionCsv { sections: Vec<SectionRequest>, channels: Vec<String> },
    SectionSvg { sections: Vec<SectionRequest>, channels: Vec<String> },
    SectionPng { sections: Vec<SectionRequest>, channels: Vec<String> },
    ProbesCsv { probes: Vec<ProbeRequest> },
}

/// A frame of the page, without its values: what its map was.
#[derive(Deserialize)]
pub struct FrameHead {
    pub channel: String,
    pub unit: String,
    pub width: u32,
    pub height: u32,
    pub window: Edges,
    /// Pixels that receive any light, if its map said so.
    pub lit: Option<usize>,
    /// What the coordinates are, as `Frame` has it.
    pub coordinates: isophote::map::Coordinates,
}

/// Edges of a map, or of the picture.
#[derive(Clone, Copy, Serialize, Deserialize)]
pub struct Edges {
    pub x: [f64; 2],
    pub y: [f64; 2],
}

/// The levels of isophotes: about so many, or these.
#[derive(Deserialize)]
#[serde(untagged)]
pub enum Levels {
    About(usize),
    These(Vec<f64>),
}

/// The word of a list; `no_such` says that the name is not in it, and what is allowed.
pub fn keyword<K: Keyword>(name: &str, no_such: impl FnOnce(&str, String) -> Message) -> Result<K, Refusal> {
    K::from_name(name).ok_or_else(|| {
        let names: Vec<&str> = K::ALL.iter().map(|keyword| keyword.name()).collect();
        Refusal(no_such(name, names.join(", ")))
    })
}

/// The colour map with this name.
pub fn colormap(name: &str) -> Result<Colormap, Refusal> {
    keyword(name, |name, allowed| message!("there is no colour map `{name}`; allowed: {allowed}", name, allowed))
}

/// The channel of a scene with this name, if a picture can show it.
pub fn channel(name: &str, scene: &Scene) -> Result<Quantity, Refusal> {
    let is_known = |quantity: &Quantity| match quantity {
        Quantity::Light(light) | Quantity::LightBrightness(light) => scene.light_named(light).is_some(),
        quantity => quantity.is_scalar(),
    };
    let no_such = || Refusal(message!("this scene has no channel `{name}` of single numbers", name));
    Quantity::from_name(name).filter(is_known).ok_or_else(no_such)
}

/// The index of the shape with this name.
pub fn shape_named(name: &str, scene: &Scene) -> Result<usize, Refusal> {
    let no_such = || Refusal(message!("there is no shape \"{on}\"", on = name));
    scene.shapes().iter().position(|shape| shape.name == name).ok_or_else(no_such)
}

/// A vector in the scene's unit.
pub fn in_unit(vector: Vector, length: LengthUnit) -> [f64; 3] {
    vector.to_array().map(|metres| length.from_metres(metres))
}
