//! `isophote probe`: exact values at points.

use anyhow::Result;
use isophote::analysis::probe::{ProbeError, ProbePosition, ProbeReading};
use isophote::message;
use isophote::prepare::PreparedScene;
use isophote::scene::{Scene, limits};
use isophote::text::{Message, significant};
use isophote::units::Keyword;
use isophote::vector::Vector;
use serde::Serialize;

use super::reading_json::ProbeJson;
use super::reading_table;
use super::there_are;
use crate::args::ProbeArguments;
use crate::failure::{self, Usage};
use crate::{load, numbers};

/// Reads the values at the requested places, or at the scene's own probes.
pub fn run(arguments: &ProbeArguments) -> Result<String> {
    let language = arguments.language.lang;
    let scene = PreparedScene::new(&load::scene(&arguments.scene, arguments.quiet, language)?);
    let requests = requests(arguments, scene.scene())?;
    let mut readings = Vec::new();
    let mut refusals = Vec::new();
    for Request { name, place, published } in &requests {
        match scene.probe(place) {
            Ok(reading) => {
                if let Some(note) = snapped(name, place, &reading, scene.scene()).filter(|_| !arguments.quiet) {
                    failure::note(&note.in_language(language));
                }
                readings.push((name, reading, *published));
            }
            Err(error) => refusals.push(refusal(name, &error, scene.scene())),
        }
    }
    if let Some(refusals) = refusals.into_iter().reduce(|first, next| message!("{first}\nerror: {next}", first, next)) {
        return Err(Usage(refusals).into());
    }
    if arguments.json {
        let probes = readings
            .iter()
            .map(|(name, reading, published)| ProbeJson::new(&name.to_string(), reading, *published, &scene));
        let (length, color_space) = (scene.scene().length().name(), scene.components().map(|parts| parts.space.name()));
        return numbers::json(&ProbesJson { length, color_space, probes: probes.collect() });
    }
    if arguments.explain {
        let explained = |(name, reading, _): &(&Message, ProbeReading, _)| {
            reading.explain(&scene, &name.in_language(language), language)
        };
        let explanations: Vec<String> = readings.iter().map(explained).collect();
        return Ok(explanations.join("\n"));
    }
    let names: Vec<String> = readings.iter().map(|(name, ..)| name.in_language(language)).collect();
    let with_names = names.iter().zip(&readings);
    let rows: Vec<_> = with_names.map(|(name, (_, reading, published))| (name.as_str(), reading, *published)).collect();
    Ok(reading_table::text(&rows, &scene, language))
}

/// A named place.
struct Request {
    name: Message,
    place: ProbePosition,
    published: Option<f64>,
}

fn requests(arguments: &ProbeArguments, scene: &Scene) -> Result<Vec<Request>> {
    let length = scene.length();
    let mut requests = Vec::new();
    let mut push = |name: Message, place| requests.push(Request { name, place, published: None });
    for at in &arguments.at {
        let metres = at.map(|coordinate| length.to_metres(coordinate));
        let [x, y, z] = at;
        if metres.iter().any(|coordinate| coordinate.abs() > limits::COORDINATE) {
            let bound = length.from_metres(limits::COORDINATE);
            let message = message!(
                "--at {at} is too far away; allowed: up to {bound} {unit}",
                at = format!("{x:e},{y:e},{z:e}"),
                bound = format!("{bound:e}"),
                unit = length.name()
            );
            return Err(Usage(message).into());
        }
        let point = Vector::from(metres);
        push(
            Message::verbatim(format!("({x}, {y}, {z})")),
            if arguments.snap { ProbePosition::NearestTo(point) } else { ProbePosition::Point(point) },
        );
    }
    for pixel in &arguments.pixel {
        push(message!("pixel {column},{row}", column = pixel.column, row = pixel.row), ProbePosition::Pixel(*pixel));
    }
    for [theta, phi] in &arguments.angles {
        let shape = sphere(arguments, scene)?;
        let place = ProbePosition::Angles { shape, theta: theta.to_radians(), phi: phi.to_radians() };
        push(Message::verbatim(format!("θ {theta}°, φ {phi}°")), place);
    }
    if requests.is_empty() {
        requests.extend(scene.probes().iter().map(|probe| Request {
            name: Message::verbatim(&probe.name),
            place: ProbePosition::Point(probe.at),
            published: probe.published,
        }));
    }
    if requests.is_empty() {
        let message =
            message!("the scene has no probes; say where with --at X,Y,Z, --pixel COLUMN,ROW or --angles THETA,PHI");
        return Err(Usage(message).into());
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
        let there_are = there_are(&shown);
        Usage(message!("--angles needs --shape with the name of a sphere; {there_are}", there_are)).into()
    })
}

/// Why there is no value, and how to fix it.
fn refusal(name: &Message, error: &ProbeError, scene: &Scene) -> Message {
    match error {
        ProbeError::OffSurface(miss) => {
            let shape = &scene.shapes()[miss.shape].name;
            let miss = miss.describe(shape, scene.length());
            message!("the point {name} is on no surface: {miss}; --snap uses that point", name, miss)
        }
        other => message!("{name}: {reason}", name, reason = other.message()),
    }
}

/// How far --snap moved a point, if it did.
fn snapped(name: &Message, place: &ProbePosition, reading: &ProbeReading, scene: &Scene) -> Option<Message> {
    let ProbePosition::NearestTo(asked) = place else { return None };
    let moved = (reading.hit.point.position() - *asked).length();
    let geometry = &scene.shapes()[reading.hit.primitive.shape].geometry;
    (moved > geometry.surface_tolerance(*asked)).then(|| {
        let length = scene.length();
        let moved = significant(length.from_metres(moved), 6);
        let [x, y, z] = reading.position(length);
        message!(
            "{name} was moved by {moved} {unit} to {point}",
            name,
            moved,
            unit = length.name(),
            point = format!("[{x}, {y}, {z}]")
        )
    })
}

#[derive(Serialize)]
struct ProbesJson {
    length: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    color_space: Option<&'static str>,
    probes: Vec<ProbeJson>,
}
