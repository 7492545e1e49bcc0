//! `isophote probe`: exact values at points.

use anyhow::Result;
use isophote::analysis::probe::{ProbeError, ProbePosition, ProbeReading};
use isophote::prepare::PreparedScene;
use isophote::scene::{Scene, limits};
use isophote::text::significant;
use isophote::units::Keyword;
use isophote::vector::Vector;
use serde::Serialize;

use super::reading_json::ProbeJson;
use super::reading_table;
use crate::args::ProbeArguments;
use crate::failure::{self, Usage};
use crate::{load, numbers};

/// Reads the values at the requested places, or at the scene's own probes.
pub fn run(arguments: &ProbeArguments) -> Result<String> {
    let scene = PreparedScene::new(&load::scene(&arguments.scene, arguments.quiet)?);
    let requests = requests(arguments, scene.scene())?;
    let mut readings = Vec::new();
    let mut refusals = Vec::new();
    for Request { name, place, published } in &requests {
        match scene.probe(place) {
            Ok(reading) => {
                if let Some(note) = snapped(name, place, &reading, scene.scene()).filter(|_| !arguments.quiet) {
                    failure::note(&note);
                }
                readings.push((name.as_str(), reading, *published));
            }
            Err(error) => refusals.push(refusal(name, &error, scene.scene())),
        }
    }
    if !refusals.is_empty() {
        return Err(Usage(refusals.join("\nerror: ")).into());
    }
    if arguments.json {
        let probes =
            readings.iter().map(|(name, reading, published)| ProbeJson::new(name, reading, *published, &scene));
        let (length, color_space) = (scene.scene().length().name(), scene.components().map(|parts| parts.space.name()));
        return numbers::json(&ProbesJson { length, color_space, probes: probes.collect() });
    }
    if arguments.explain {
        let explanations: Vec<String> =
            readings.iter().map(|(name, reading, _)| reading.explain(&scene, name)).collect();
        return Ok(explanations.join("\n"));
    }
    let rows: Vec<_> = readings.iter().map(|(name, reading, published)| (*name, reading, *published)).collect();
    Ok(reading_table::text(&rows, &scene))
}

/// A named place.
struct Request {
    name: String,
    place: ProbePosition,
    published: Option<f64>,
}

fn requests(arguments: &ProbeArguments, scene: &Scene) -> Result<Vec<Request>> {
    let length = scene.length();
    let mut requests = Vec::new();
    let mut push = |name: String, place| requests.push(Request { name, place, published: None });
    for at in &arguments.at {
        let metres = at.map(|coordinate| length.to_metres(coordinate));
        let [x, y, z] = at;
        if metres.iter().any(|coordinate| coordinate.abs() > limits::COORDINATE) {
            let bound = length.from_metres(limits::COORDINATE);
            let message = format!("--at {x:e},{y:e},{z:e} is too far away; allowed: up to {bound:e} {}", length.name());
            return Err(Usage(message).into());
        }
        let point = Vector::from(metres);
        push(
            format!("({x}, {y}, {z})"),
            if arguments.snap { ProbePosition::NearestTo(point) } else { ProbePosition::Point(point) },
        );
    }
    for pixel in &arguments.pixel {
        push(format!("pixel {},{}", pixel.column, pixel.row), ProbePosition::Pixel(*pixel));
    }
    for [theta, phi] in &arguments.angles {
        let shape = sphere(arguments, scene)?;
        let place = ProbePosition::Angles { shape, theta: theta.to_radians(), phi: phi.to_radians() };
        push(format!("θ {theta}°, φ {phi}°"), place);
    }
    if requests.is_empty() {
        requests.extend(scene.probes().iter().map(|probe| Request {
            name: probe.name.clone(),
            place: ProbePosition::Point(probe.at),
            published: probe.published,
        }));
    }
    if requests.is_empty() {
        let message = "the scene has no probes; say where with --at X,Y,Z, --pixel COLUMN,ROW or --angles THETA,PHI";
        return Err(Usage(message.into()).into());
    }
    Ok(requests)
}

fn sphere(arguments: &ProbeArguments, scene: &Scene) -> Result<usize> {
    let names: Vec<&str> = scene.shapes().iter().map(|shape| shape.name.as_str()).collect();
    let index = match (&arguments.shape, names.as_slice()) {
        (None, [_]) => Some(0),
        (None, _) => None,
        (Some(name), _) => names.iter().position(|known| known == name),
    };
    index.ok_or_else(|| {
        let shown: Vec<&str> = names.iter().copied().take(20).collect();
        let there_are =
            if shown.is_empty() { "the scene has none".into() } else { format!("there are: {}", shown.join(", ")) };
        Usage(format!("--angles needs --shape with the name of a sphere; {there_are}")).into()
    })
}

/// Why there is no value, and how to fix it.
fn refusal(name: &str, error: &ProbeError, scene: &Scene) -> String {
    match error {
        ProbeError::OffSurface(miss) => {
            let shape = &scene.shapes()[miss.shape].name;
            format!(
                "the point {name} is on no surface: {}; --snap uses that point",
                miss.describe(shape, scene.length())
            )
        }
        other => format!("{name}: {other}"),
    }
}

/// How far --snap moved a point, if it did.
fn snapped(name: &str, place: &ProbePosition, reading: &ProbeReading, scene: &Scene) -> Option<String> {
    let ProbePosition::NearestTo(asked) = place else { return None };
    let moved = (reading.hit.point.position() - *asked).length();
    let geometry = &scene.shapes()[reading.hit.primitive.shape].geometry;
    (moved > geometry.surface_tolerance(*asked)).then(|| {
        let length = scene.length();
        let moved = significant(length.from_metres(moved), 6);
        let [x, y, z] = reading.position(length);
        format!("{name} was moved by {moved} {} to [{x}, {y}, {z}]", length.name())
    })
}

#[derive(Serialize)]
struct ProbesJson {
    length: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    color_space: Option<&'static str>,
    probes: Vec<ProbeJson>,
}
