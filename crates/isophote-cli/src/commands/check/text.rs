//! A scene for people, in metres.

use std::fmt::Write;

use isophote::camera::{CameraFrame, Extent, Fisheye, Mapping, Projection, Screen};
use isophote::light::{Emission, Light, LightKind};
use isophote::map::Resolution;
use isophote::message;
use isophote::reflectance::Reflectance;
use isophote::scene::{Lighting, Scene};
use isophote::shape::Measure;
use isophote::text::{Language, Message, escaped_line, significant};
use isophote::threads::Threads;
use isophote::units::Keyword;
use isophote::vector::Vector;

use super::amounts::{components, intensity_of, power_of, radiance_of};
use crate::table::{Align, table};

/// The scene as Isophote understands it.
pub(super) fn of(scene: &Scene, language: Language) -> String {
    let camera = scene.camera();
    let frame = CameraFrame::<f64>::new(camera);
    let convention = scene.convention();
    let mut text = String::new();
    // Writing to a string cannot fail.
    let mut row = |name: Message, value: Message| {
        let (name, value) = (name.in_language(language), value.in_language(language));
        let _ = writeln!(text, "  {name:<12}{}", escaped_line(&value));
    };
    row(message!("title"), Message::verbatim(scene.title()));
    row(message!("length"), message!("{unit} in the file; metres below", unit = scene.length().name()));
    row(message!("handedness"), Message::verbatim(format!("{} (2.3)", camera.handedness.name())));
    row(message!("convention"), Message::verbatim(format!("{}: {}", convention.label(), convention.formula())));
    let (quantities, unit) = (scene.unit_system().name(), convention.unit(scene.unit_system()));
    row(message!("quantities"), message!("{quantities}: B in {unit}", quantities, unit));
    if let Some(color) = scene.color_label() {
        row(message!("color space"), Message::verbatim(color));
    }
    if scene.shadows() {
        row(message!("shadows"), message!("shapes stand in each other's light"));
    }
    if scene.sampling().is_multisampled() {
        row(message!("sampling"), scene.sampling().describe());
    }
    row(message!("eye"), Message::verbatim(vector(camera.eye)));
    row(message!("forward"), Message::verbatim(vector(frame.forward)));
    row(message!("up"), Message::verbatim(vector(frame.up)));
    row(message!("right"), Message::verbatim(vector(frame.right)));
    let [name, projection] = projection_text(&camera.projection);
    row(name, projection);
    let Resolution { width, height } = camera.resolution;
    row(message!("resolution"), message!("{width} × {height} pixels", width, height));
    if let Some(ambient) = scene.ambient() {
        let unit = scene.unit_system().radiance_unit();
        let radiance = amount(scene, radiance_of, ambient.radiance);
        let value = match ambient.obstruction {
            Some(samples) => {
                message!("{radiance} {unit}, obstructed: {samples} directions a point", radiance, unit, samples)
            }
            None => Message::verbatim(format!("{radiance} {unit}")),
        };
        row(message!("ambient"), value);
    }
    // Side by side: a hundred thousand rows take as long as checking them.
    let tables: [fn(&Scene, Language) -> Option<String>; 4] = [materials, shapes, lights, probes];
    let tables: Vec<Option<String>> = Threads::default().map(tables.to_vec(), |table| table(scene, language));
    let titles = [message!("materials"), message!("shapes"), message!("lights"), message!("probes")];
    for (title, table) in titles.into_iter().zip(tables) {
        let none = || format!("  {}\n", message!("none").in_language(language));
        let _ = write!(text, "\n{}\n{}", title.in_language(language), table.unwrap_or_else(none));
    }
    text
}

/// The name of the row and its content.
fn projection_text(projection: &Projection) -> [Message; 2] {
    let edges = |[left, right]: [f64; 2], [bottom, top]: [f64; 2]| {
        let [left, right, bottom, top] = [left, right, bottom, top].map(short);
        message!("x {left} to {right}, y {bottom} to {top}", left, right, bottom, top)
    };
    match *projection {
        Projection::Perspective(Screen { distance, x, y }) => [
            message!("screen"),
            message!("distance {distance}, {edges}", distance = short(distance), edges = edges(x, y)),
        ],
        Projection::Orthographic(Extent { x, y }) => {
            [message!("projection"), message!("orthographic (2.7), {edges}", edges = edges(x, y))]
        }
        Projection::Fisheye(Fisheye { mapping, field_of_view }) => {
            let mapping = match mapping {
                Mapping::Equidistant => message!("equidistant (2.8)"),
                Mapping::EqualArea => message!("equal area (2.9)"),
            };
            [
                message!("projection"),
                message!("fisheye, {mapping}, {angle}° across", mapping, angle = short(field_of_view)),
            ]
        }
        Projection::Panorama(Extent { x: [west, east], y: [low, high] }) => {
            let [west, east, low, high] = [west, east, low, high].map(short);
            [
                message!("projection"),
                message!(
                    "panorama (2.10), longitude {west}° to {east}°, latitude {low}° to {high}°",
                    west,
                    east,
                    low,
                    high
                ),
            ]
        }
    }
}

fn materials(scene: &Scene, language: Language) -> Option<String> {
    let name = message!("name").in_language(language);
    let columns = [(name.as_str(), Align::Left), ("k_d", Align::Right), ("k_s", Align::Right), ("n", Align::Right)];
    let rows = scene.materials().iter().enumerate().map(|(index, material)| {
        let Reflectance { diffuse, specular, shininess } = material.reflectance;
        let shininess = if specular == 0.0 { "–".into() } else { short(shininess) };
        let diffuse = amount(scene, |lighting| lighting.materials[index].reflectance.diffuse, diffuse);
        let specular = amount(scene, |lighting| lighting.materials[index].reflectance.specular, specular);
        vec![material.name.clone(), diffuse, specular, shininess]
    });
    filled(&columns, &rows.collect::<Vec<_>>())
}

fn shapes(scene: &Scene, language: Language) -> Option<String> {
    let headings = [message!("name"), message!("shape"), message!("measures, m"), message!("material")]
        .map(|heading| heading.in_language(language));
    let columns = headings.each_ref().map(|heading| (heading.as_str(), Align::Left));
    let rows = scene.shapes().iter().map(|shape| {
        let material = shape.material.map_or("–", |index| scene.materials()[index].name.as_str());
        let measures = shape.geometry.measures().into_iter().map(|(name, measure)| match measure {
            Measure::Vector(value) => [name, " ", &vector(value)].concat(),
            Measure::Number(value) => [name, " ", &short(value)].concat(),
            Measure::Count(count) => format!("{name} {count}"),
        });
        let measures = measures.collect::<Vec<_>>().join(", ");
        vec![shape.name.clone(), shape.geometry.kind().into(), measures, material.to_owned()]
    });
    filled(&columns, &rows.collect::<Vec<_>>())
}

fn lights(scene: &Scene, language: Language) -> Option<String> {
    let intensity = format!("I₀, {}", scene.unit_system().intensity_unit());
    let power = message!("power, {unit}", unit = scene.unit_system().power_unit()).in_language(language);
    let [name, position, emission] =
        [message!("name"), message!("position, m"), message!("emission")].map(|heading| heading.in_language(language));
    let columns = [
        (name.as_str(), Align::Left),
        (position.as_str(), Align::Left),
        (intensity.as_str(), Align::Right),
        (power.as_str(), Align::Right),
        (emission.as_str(), Align::Left),
    ];
    let rows = scene.lights().iter().enumerate().map(|(index, light)| {
        let strength = |of: fn(&Light) -> f64| amount(scene, |lighting| of(&lighting.lights[index]), of(light));
        let light_row = |position, intensity, power, emission: Message| {
            let emission = if light.is_on { emission } else { message!("{emission}; switched off", emission) };
            vec![light.name.clone(), position, intensity, power, emission.in_language(language)]
        };
        match &light.kind {
            LightKind::Point(point) => {
                let emission = emission_text(&point.emission);
                light_row(vector(point.position), strength(intensity_of), strength(power_of), emission)
            }
            LightKind::Parallel(parallel) => {
                let irradiance = format!("{} {}", strength(intensity_of), scene.unit_system().irradiance_unit());
                let direction = vector(parallel.direction);
                let emission = message!("parallel, direction {direction}, E₀ {irradiance}", direction, irradiance);
                light_row("–".into(), "–".into(), "–".into(), emission)
            }
        }
    });
    filled(&columns, &rows.collect::<Vec<_>>())
}

fn emission_text(emission: &Emission) -> Message {
    match emission {
        Emission::Isotropic => message!("isotropic"),
        Emission::Lambertian { axis } => message!("lambertian, axis {axis}", axis = vector(*axis)),
        Emission::Spot(spot) => {
            let [inner, outer] = [spot.inner_angle(), spot.outer_angle()].map(|angle| short(angle.to_degrees()));
            message!("spot, axis {axis}, {inner}° to {outer}°", axis = vector(spot.cone.axis), inner, outer)
        }
    }
}

fn probes(scene: &Scene, language: Language) -> Option<String> {
    let [name, at, published] = [message!("name"), message!("at, {length}", length = "m"), message!("published")]
        .map(|heading| heading.in_language(language));
    let columns = [(name.as_str(), Align::Left), (at.as_str(), Align::Left), (published.as_str(), Align::Right)];
    let rows = scene
        .probes()
        .iter()
        .map(|probe| vec![probe.name.clone(), vector(probe.at), probe.published.map_or("–".into(), short)]);
    filled(&columns, &rows.collect::<Vec<_>>())
}

fn filled(columns: &[(&str, Align)], rows: &[Vec<String>]) -> Option<String> {
    (!rows.is_empty()).then(|| table(columns, rows))
}

fn short(value: f64) -> String {
    significant(value, 9)
}

fn vector(vector: Vector) -> String {
    let [x, y, z] = vector.to_array().map(short);
    ["(", &x, ", ", &y, ", ", &z, ")"].concat()
}

/// An amount, per component if they differ.
fn amount(scene: &Scene, of: impl Fn(&Lighting) -> f64, one: f64) -> String {
    components(scene, of, one).map_or_else(short, |amounts| format!("[{}]", amounts.map(short).join(", ")))
}
