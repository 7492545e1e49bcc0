//! Values along lines.

use isophote::analysis::section::{self, Axis, Sample, SectionLine};
use isophote::map::Quantity;
use isophote::message;
use isophote::prepare::PreparedScene;
use isophote::text::{Language, significant};
use isophote::units::Keyword;
use serde::Serialize;
use std::collections::BTreeMap;

use crate::problem::Refusal;
use crate::request::{SectionRequest, in_unit, shape_named};

/// A line, and what a position along it is.
struct Line {
    along: SectionLine,
    axis: Axis,
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
        channels.iter().try_for_each(section::refuse).map_err(Refusal)?;
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
        let positions = screen.iter().map(|place| line.axis.position(*place, start)).collect();
        let mut values = BTreeMap::new();
        let mut units = BTreeMap::new();
        for quantity in channels {
            let along = samples.iter().map(|sample| sample.value(quantity, scene.length())).collect();
            values.insert(quantity.name(), along);
            units.insert(quantity.name(), quantity.unit(scene.convention(), scene.unit_system(), scene.length()));
        }
        let point =
            |sample: &Sample| sample.seen.as_ref().map(|(hit, _)| in_unit(hit.point.position(), scene.length()));
        let points = samples.iter().map(point).collect();
        Ok(Self { name: line.name, axis: line.axis.name(), positions, screen, values, units, points })
    }
}

fn lines(request: &SectionRequest, prepared: &PreparedScene, language: Language) -> Result<Vec<Line>, Refusal> {
    let scene = prepared.scene();
    let unit = scene.screen_unit();
    let camera = scene.camera();
    let extent = camera.projection.extent(camera.resolution);
    let text = |coordinate: f64| format!("{} {}", significant(unit.from_internal(coordinate), 6), unit.name());
    let horizontal = |y: f64| {
        let along = SectionLine::horizontal(camera, y, SectionLine::SAMPLES);
        Line { along, axis: Axis::X, name: format!("y = {}", text(y)) }
    };
    let vertical = |x: f64| {
        let along = SectionLine::vertical(camera, x, SectionLine::SAMPLES);
        Line { along, axis: Axis::Y, name: format!("x = {}", text(x)) }
    };
    let internal = |coordinate: f64| unit.to_internal(coordinate);
    Ok(match request {
        SectionRequest::Row { row } => {
            vec![Line {
                along: SectionLine::Row(*row),
                axis: Axis::X,
                name: message!("row {row}", row).in_language(language),
            }]
        }
        SectionRequest::Column { column } => {
            vec![Line {
                along: SectionLine::Column(*column),
                axis: Axis::Y,
                name: message!("column {column}", column).in_language(language),
            }]
        }
        SectionRequest::Horizontal { y } => vec![horizontal(internal(*y))],
        SectionRequest::Vertical { x } => vec![vertical(internal(*x))],
        SectionRequest::Between { from, to } => {
            let name = format!("({}, {}) – ({}, {}) {}", from[0], from[1], to[0], to[1], unit.name());
            let [from, to] = [from, to].map(|end| end.map(internal));
            vec![Line {
                along: SectionLine::Between { from, to, samples: SectionLine::SAMPLES },
                axis: Axis::Distance,
                name,
            }]
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
