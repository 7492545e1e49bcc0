//! A scene for people, in metres.

use std::fmt::Write;

use isophote::camera::{CameraFrame, Extent, Fisheye, Mapping, Projection, Screen};
use isophote::light::{Emission, Light, LightKind};
use isophote::reflectance::Reflectance;
use isophote::scene::{Lighting, Scene};
use isophote::shape::Measure;
use isophote::text::{escaped_line, significant};
use isophote::threads::Threads;
use isophote::units::Keyword;
use isophote::vector::Vector;

use super::amounts::{components, intensity_of, power_of, radiance_of};
use crate::table::{Align, table};

/// The scene as Isophote understands it.
pub(super) fn of(scene: &Scene) -> String {
    let camera = scene.camera();
    let frame = CameraFrame::<f64>::new(camera);
    let convention = scene.convention();
    let mut text = String::new();
    // Writing to a string cannot fail.
    let mut row = |name: &str, value: String| {
        let _ = writeln!(text, "  {name:<12}{}", escaped_line(&value));
    };
    row("title", scene.title().to_owned());
    row("length", format!("{} in the file; metres below", scene.length().name()));
    row("handedness", format!("{} (2.3)", camera.handedness.name()));
    row("convention", format!("{}: {}", convention.label(), convention.formula()));
    row("quantities", format!("{}: B in {}", scene.unit_system().name(), convention.unit(scene.unit_system())));
    if let Some(color) = scene.color_label() {
        row("color space", color);
    }
    if scene.shadows() {
        row("shadows", "shapes stand in each other's light".into());
    }
    if scene.sampling().is_multisampled() {
        row("sampling", scene.sampling().describe());
    }
    row("eye", vector(camera.eye));
    row("forward", vector(frame.forward));
    row("up", vector(frame.up));
    row("right", vector(frame.right));
    let [name, projection] = projection_text(&camera.projection);
    row(&name, projection);
    row("resolution", format!("{} × {} pixels", camera.resolution.width, camera.resolution.height));
    if let Some(ambient) = scene.ambient() {
        let unit = scene.unit_system().radiance_unit();
        let obstructed =
            ambient.obstruction.map_or(String::new(), |samples| format!(", obstructed: {samples} directions a point"));
        let radiance = amount(scene, radiance_of, ambient.radiance);
        row("ambient", format!("{radiance} {unit}{obstructed}"));
    }
    // Side by side: a hundred thousand rows take as long as checking them.
    let tables: [fn(&Scene) -> Option<String>; 4] = [materials, shapes, lights, probes];
    let tables: Vec<Option<String>> = Threads::default().map(tables.to_vec(), |table| table(scene));
    for (title, table) in ["materials", "shapes", "lights", "probes"].into_iter().zip(tables) {
        let _ = write!(text, "\n{title}\n{}", table.unwrap_or_else(|| "  none\n".into()));
    }
    text
}

/// The name of the row and its content.
fn projection_text(projection: &Projection) -> [String; 2] {
    let edges = |[left, right]: [f64; 2], [bottom, top]: [f64; 2]| {
        let [left, right, bottom, top] = [left, right, bottom, top].map(short);
        format!("x {left} to {right}, y {bottom} to {top}")
    };
    match *projection {
        Projection::Perspective(Screen { distance, x, y }) => {
            ["screen".into(), format!("distance {}, {}", short(distance), edges(x, y))]
        }
        Projection::Orthographic(Extent { x, y }) => {
            ["projection".into(), format!("orthographic (2.7), {}", edges(x, y))]
        }
        Projection::Fisheye(Fisheye { mapping, field_of_view }) => {
            let mapping = match mapping {
                Mapping::Equidistant => "equidistant (2.8)",
                Mapping::EqualArea => "equal area (2.9)",
            };
            ["projection".into(), format!("fisheye, {mapping}, {}° across", short(field_of_view))]
        }
        Projection::Panorama(Extent { x: [west, east], y: [low, high] }) => {
            let [west, east, low, high] = [west, east, low, high].map(short);
            ["projection".into(), format!("panorama (2.10), longitude {west}° to {east}°, latitude {low}° to {high}°")]
        }
    }
}

fn materials(scene: &Scene) -> Option<String> {
    let columns = [("name", Align::Left), ("k_d", Align::Right), ("k_s", Align::Right), ("n", Align::Right)];
    let rows = scene.materials().iter().enumerate().map(|(index, material)| {
        let Reflectance { diffuse, specular, shininess } = material.reflectance;
        let shininess = if specular == 0.0 { "–".into() } else { short(shininess) };
        let diffuse = amount(scene, |lighting| lighting.materials[index].reflectance.diffuse, diffuse);
        let specular = amount(scene, |lighting| lighting.materials[index].reflectance.specular, specular);
        vec![material.name.clone(), diffuse, specular, shininess]
    });
    filled(&columns, &rows.collect::<Vec<_>>())
}

fn shapes(scene: &Scene) -> Option<String> {
    let columns =
        [("name", Align::Left), ("shape", Align::Left), ("measures, m", Align::Left), ("material", Align::Left)];
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

fn lights(scene: &Scene) -> Option<String> {
    let intensity = format!("I₀, {}", scene.unit_system().intensity_unit());
    let power = format!("power, {}", scene.unit_system().power_unit());
    let columns = [
        ("name", Align::Left),
        ("position, m", Align::Left),
        (intensity.as_str(), Align::Right),
        (power.as_str(), Align::Right),
        ("emission", Align::Left),
    ];
    let rows = scene.lights().iter().enumerate().map(|(index, light)| {
        let strength = |of: fn(&Light) -> f64| amount(scene, |lighting| of(&lighting.lights[index]), of(light));
        let off = if light.is_on { "" } else { "; switched off" };
        let light_row =
            |position, intensity, power, emission| vec![light.name.clone(), position, intensity, power, emission + off];
        match &light.kind {
            LightKind::Point(point) => {
                let emission = emission_text(&point.emission);
                light_row(vector(point.position), strength(intensity_of), strength(power_of), emission)
            }
            LightKind::Parallel(parallel) => {
                let irradiance = format!("{} {}", strength(intensity_of), scene.unit_system().irradiance_unit());
                let emission = format!("parallel, direction {}, E₀ {irradiance}", vector(parallel.direction));
                light_row("–".into(), "–".into(), "–".into(), emission)
            }
        }
    });
    filled(&columns, &rows.collect::<Vec<_>>())
}

fn emission_text(emission: &Emission) -> String {
    match emission {
        Emission::Isotropic => "isotropic".into(),
        Emission::Lambertian { axis } => format!("lambertian, axis {}", vector(*axis)),
        Emission::Spot(spot) => {
            let [inner, outer] = [spot.inner_angle(), spot.outer_angle()].map(|angle| short(angle.to_degrees()));
            format!("spot, axis {}, {inner}° to {outer}°", vector(spot.cone.axis))
        }
    }
}

fn probes(scene: &Scene) -> Option<String> {
    let columns = [("name", Align::Left), ("at, m", Align::Left), ("published", Align::Right)];
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
