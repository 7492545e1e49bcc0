//! `isophote probe`: exact values at points.

use std::fmt::Write;

use anyhow::Result;
use isophote::analysis::probe::{ProbeError, ProbePosition, ProbeReading, SeenFromEye};
use isophote::color::Component;
use isophote::prepare::PreparedScene;
use isophote::scene::{Scene, limits};
use isophote::shade::Shading;
use isophote::text::significant;
use isophote::units::Keyword;
use isophote::vector::Vector;
use serde::Serialize;

use crate::args::ProbeArguments;
use crate::failure::{self, Usage};
use crate::table::{Align, table};
use crate::{load, numbers};

/// Reads the values at the places that were asked for, or at the scene's own probes.
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
    Ok(table_text(&rows, &scene))
}

/// A place with a name.
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

/// Why there is no value, and what to do about it.
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

/// How far --snap moved a point, when it did.
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

/// A table of readings, with the published values where there are any.
pub fn table_text(readings: &[(&str, &ProbeReading, Option<f64>)], scene: &PreparedScene) -> String {
    let description = scene.scene();
    let length = description.length();
    let convention = description.convention();
    let unit = convention.unit(description.unit_system());
    let point = format!("point, {}", length.name());
    let irradiance = format!("E (3.1), {}", description.unit_system().irradiance_unit());
    let brightness = format!("B ({}), {unit}", convention.formula_number());
    let mut columns = vec![
        ("probe", Align::Left),
        (point.as_str(), Align::Left),
        (irradiance.as_str(), Align::Right),
        (brightness.as_str(), Align::Right),
    ];
    let has_published = readings.iter().any(|(_, _, published)| published.is_some());
    if has_published {
        columns.push(("published", Align::Right));
    }
    let row = |(name, reading, published): &(&str, &ProbeReading, Option<f64>)| {
        let [x, y, z] = reading.position(length).map(|coordinate| significant(coordinate, 6));
        let mut row = vec![
            (*name).to_owned(),
            format!("({x}, {y}, {z})"),
            significant(reading.shading.irradiance, 15),
            significant(reading.shading.brightness(), 15),
        ];
        if has_published {
            row.push(published.map_or("–".into(), |value| significant(value, 15)));
        }
        row
    };
    let rows = readings.iter().flat_map(|reading| std::iter::once(row(reading)).chain(color_rows(reading.1)));
    // Nobody publishes components: their rows end before that column.
    let filled = |row: Vec<String>| row.into_iter().chain(has_published.then(String::new)).take(columns.len());
    let rows: Vec<Vec<String>> = rows.map(|row| filled(row).collect()).collect();
    let mut text = table(&columns, &rows);
    if let Some(color) = description.color_label() {
        // Writing to a text cannot fail.
        let _ = writeln!(text, "  {color}");
    }
    for (name, reading, _) in readings {
        if let Some(note) = unseen_note(reading, description) {
            // Writing to a text cannot fail.
            let _ = writeln!(text, "  {name} is not seen from the eye: {note}");
        }
    }
    text
}

/// A row for each component, below that of the luminance.
fn color_rows(reading: &ProbeReading) -> Vec<Vec<String>> {
    let Some(readings) = reading.components.as_deref() else { return Vec::new() };
    let row = |component: &Component| {
        let shading = &readings.of(*component).shading;
        let [irradiance, brightness] = [shading.irradiance, shading.brightness()].map(|value| significant(value, 15));
        vec![format!("  {}", component.name()), String::new(), irradiance, brightness]
    };
    Component::ALL.iter().map(row).collect()
}

/// Something of each component, in a scene with colours.
fn rgb(reading: &ProbeReading, of: &dyn Fn(&ProbeReading) -> f64) -> Option<[f64; 3]> {
    reading.components.as_deref().map(|readings| readings.map(of).into_array())
}

fn unseen_note(reading: &ProbeReading, scene: &Scene) -> Option<String> {
    match reading.seen {
        SeenFromEye::Seen => None,
        SeenFromEye::Behind => Some("it is behind the plane of the eye".into()),
        SeenFromEye::FacesAway => Some("the surface faces away there (θ_o ≥ 90°)".into()),
        SeenFromEye::HiddenBy(other) => Some(format!("\"{}\" stands before it", scene.name_of(other))),
    }
}

#[derive(Serialize)]
struct ProbesJson {
    length: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    color_space: Option<&'static str>,
    probes: Vec<ProbeJson>,
}

/// A reading as JSON; lengths in the scene's unit.
#[derive(Serialize)]
pub struct ProbeJson {
    name: String,
    point: [f64; 3],
    normal: [f64; 3],
    shape: String,
    seen: bool,
    cos_theta_o: f64,
    channels: ChannelsJson,
    #[serde(skip_serializing_if = "Option::is_none")]
    published: Option<f64>,
    lights: Vec<LightJson>,
}

#[derive(Serialize)]
struct ChannelsJson {
    brightness: ValueJson,
    irradiance: ValueJson,
    #[serde(skip_serializing_if = "Option::is_none")]
    ambient: Option<ValueJson>,
    diffuse: ValueJson,
    specular: ValueJson,
}

#[derive(Serialize)]
struct ValueJson {
    /// The luminance, in a scene with colours.
    value: f64,
    unit: &'static str,
    /// The components.
    #[serde(skip_serializing_if = "Option::is_none")]
    rgb: Option<[f64; 3]>,
}

#[derive(Serialize)]
struct LightJson {
    name: String,
    irradiance: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    irradiance_rgb: Option<[f64; 3]>,
    cos_theta_i: f64,
    cos_theta_h: f64,
    /// None of a parallel light.
    #[serde(skip_serializing_if = "Option::is_none")]
    distance: Option<f64>,
    /// Likewise.
    #[serde(skip_serializing_if = "Option::is_none")]
    intensity: Option<f64>,
    visibility: f64,
    diffuse: f64,
    specular: f64,
}

impl ProbeJson {
    pub fn new(name: &str, reading: &ProbeReading, published: Option<f64>, scene: &PreparedScene) -> Self {
        let description = scene.scene();
        let length = description.length();
        let of_all =
            |of: &dyn Fn(&ProbeReading) -> f64, unit| ValueJson { value: of(reading), unit, rgb: rgb(reading, of) };
        let brightness = |of: fn(&Shading) -> f64| {
            of_all(&|reading| of(&reading.shading), description.convention().unit(description.unit_system()))
        };
        let irradiance = |of: fn(&Shading) -> f64| {
            of_all(&|reading| of(&reading.shading), description.unit_system().irradiance_unit())
        };
        let terms = reading.terms.iter().zip(description.lights()).enumerate();
        let lights = terms.map(|(index, (term, light))| (reading.light_shares(scene, index), index, term, light));
        let lights = lights.map(|([diffuse, specular], index, term, light)| LightJson {
            name: light.name.clone(),
            irradiance: term.irradiance,
            irradiance_rgb: rgb(reading, &|reading| reading.terms[index].irradiance),
            cos_theta_i: term.cos_theta_i,
            cos_theta_h: term.cos_theta_h,
            distance: light.position().map(|_| length.from_metres(term.distance)),
            intensity: light.position().map(|_| term.intensity),
            visibility: term.visibility,
            diffuse,
            specular,
        });
        Self {
            name: name.into(),
            point: reading.position(length),
            normal: reading.hit.point.normal.to_array(),
            shape: description.name_of(reading.hit.primitive),
            seen: reading.is_seen(),
            cos_theta_o: reading.hit.point.cos_theta_o,
            channels: ChannelsJson {
                brightness: brightness(Shading::brightness),
                irradiance: irradiance(|shading| shading.irradiance),
                ambient: description.ambient().map(|_| irradiance(|shading| shading.ambient)),
                diffuse: brightness(|shading| shading.diffuse),
                specular: brightness(|shading| shading.specular),
            },
            published,
            lights: lights.collect(),
        }
    }
}
