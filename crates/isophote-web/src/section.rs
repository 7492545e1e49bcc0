//! Values along lines.

use isophote::analysis::section::{Sample, SectionLine};
use isophote::map::Quantity;
use isophote::message;
use isophote::prepare::PreparedScene;
use isophote::scene::Scene;
use isophote::text::{Language, significant};
use serde::Serialize;
use std::collections::BTreeMap;

use crate::problem::Refusal;
use crate::request::{SectionRequest, in_unit, shape_named};

/// Points on a line; odd, so that one of them is in the middle.
const SAMPLES: u32 = 513;

/// A line, and what a position along it is.
struct Line {
    along: SectionLine,
    axis: &'static str,
    name: String,
}

/// A section as the page takes it.
#[derive(Serialize)]
pub struct Section {
    pub name: String,
    pub axis: &'static str,
    pub positions: Vec<f64>,
    pub screen: Vec<[f64; 2]>,
    pub values: BTreeMap<String, Vec<Option<f64>>>,
    pub units: BTreeMap<String, &'static str>,
    points: Vec<Option<[f64; 3]>>,
}

impl Section {
    /// All sections that requests ask for.
    pub fn all(
        requests: &[SectionRequest],
        channels: &[Quantity],
        prepared: &PreparedScene,
        language: Language,
    ) -> Result<Vec<Self>, Refusal> {
        let mut sections = Vec::new();
        for request in requests {
            for line in lines(request, prepared, language)? {
                sections.push(Self::along(line, channels, prepared)?);
            }
        }
        Ok(sections)
    }

    fn along(line: Line, channels: &[Quantity], prepared: &PreparedScene) -> Result<Self, Refusal> {
        let scene = prepared.scene();
        let samples = prepared.section(line.along)?;
        let unit = scene.screen_unit();
        let screen: Vec<[f64; 2]> =
            samples.iter().map(|sample| sample.screen.map(|coordinate| unit.from_internal(coordinate))).collect();
        let start = screen.first().copied().unwrap_or_default();
        let position = |[x, y]: &[f64; 2]| match line.axis {
            "x" => *x,
            "y" => *y,
            _ => (x - start[0]).hypot(y - start[1]),
        };
        let positions = screen.iter().map(position).collect();
        let mut values = BTreeMap::new();
        let mut units = BTreeMap::new();
        for quantity in channels {
            let along = samples.iter().map(|sample| value(sample, quantity, scene)).collect::<Result<Vec<_>, _>>()?;
            values.insert(quantity.name(), along);
            units.insert(quantity.name(), quantity.unit(scene.convention(), scene.unit_system(), scene.length()));
        }
        let point =
            |sample: &Sample| sample.seen.as_ref().map(|(hit, _)| in_unit(hit.point.position(), scene.length()));
        let points = samples.iter().map(point).collect();
        Ok(Self { name: line.name, axis: line.axis, positions, screen, values, units, points })
    }
}

fn value(sample: &Sample, quantity: &Quantity, scene: &Scene) -> Result<Option<f64>, Refusal> {
    let Some((hit, shading)) = &sample.seen else { return Ok(None) };
    Ok(Some(match quantity {
        Quantity::Brightness => shading.brightness(),
        Quantity::Irradiance => shading.irradiance,
        Quantity::Ambient => shading.ambient,
        Quantity::Diffuse => shading.diffuse,
        Quantity::Specular => shading.specular,
        Quantity::Depth => scene.length().from_metres(hit.distance),
        other => {
            let allowed = "brightness, irradiance, ambient, diffuse, specular, depth";
            return Err(Refusal(message!(
                "a section cannot show `{channel}`; allowed: {allowed}",
                channel = other.name(),
                allowed
            )));
        }
    }))
}

fn lines(request: &SectionRequest, prepared: &PreparedScene, language: Language) -> Result<Vec<Line>, Refusal> {
    let scene = prepared.scene();
    let unit = scene.screen_unit();
    let camera = scene.camera();
    let extent = camera.projection.extent(camera.resolution);
    let text = |coordinate: f64| format!("{} {}", significant(unit.from_internal(coordinate), 6), unit.name());
    let horizontal = |y: f64| {
        let [left, right] = extent.x;
        let along = SectionLine::Between { from: [left, y], to: [right, y], samples: SAMPLES };
        Line { along, axis: "x", name: format!("y = {}", text(y)) }
    };
    let vertical = |x: f64| {
        let [bottom, top] = extent.y;
        let along = SectionLine::Between { from: [x, bottom], to: [x, top], samples: SAMPLES };
        Line { along, axis: "y", name: format!("x = {}", text(x)) }
    };
    let internal = |coordinate: f64| unit.to_internal(coordinate);
    Ok(match request {
        SectionRequest::Row { row } => {
            vec![Line {
                along: SectionLine::Row(*row),
                axis: "x",
                name: message!("row {row}", row).in_language(language),
            }]
        }
        SectionRequest::Column { column } => {
            vec![Line {
                along: SectionLine::Column(*column),
                axis: "y",
                name: message!("column {column}", column).in_language(language),
            }]
        }
        SectionRequest::Horizontal { y } => vec![horizontal(internal(*y))],
        SectionRequest::Vertical { x } => vec![vertical(internal(*x))],
        SectionRequest::Between { from, to } => {
            let name = format!("({}, {}) – ({}, {}) {}", from[0], from[1], to[0], to[1], unit.name());
            let [from, to] = [from, to].map(|end| end.map(internal));
            vec![Line { along: SectionLine::Between { from, to, samples: SAMPLES }, axis: "distance", name }]
        }
        SectionRequest::Through { shape } => {
            let center = scene.shapes()[shape_named(shape, scene)?].geometry.center();
            match prepared.frame().project(center) {
                Some([x, y]) if contains(extent.x, x) && contains(extent.y, y) => vec![horizontal(y), vertical(x)],
                _ => return Err(Refusal(message!("the centre of \"{shape}\" appears outside the image", shape))),
            }
        }
    })
}

fn contains([low, high]: [f64; 2], coordinate: f64) -> bool {
    (low..=high).contains(&coordinate)
}
