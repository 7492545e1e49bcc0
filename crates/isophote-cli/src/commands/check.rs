//! `isophote check`: the scene as it is understood.

use std::fmt::Write;

use anyhow::Result;
use isophote::camera::{Camera, CameraFrame, Extent, Fisheye, Mapping, Projection, Screen};
use isophote::light::{Ambient, Emission, Light, LightKind};
use isophote::reflectance::Reflectance;
use isophote::scene::Lighting;
use isophote::scene::Sampling;
use isophote::scene::{Material, Probe, Problem, Scene, Shape};
use isophote::shape::Measure;
use isophote::text::significant;
use isophote::units::Keyword;
use isophote::vector::Vector;
use serde_json::{Value, json};

use crate::args::CheckArguments;
use crate::table::{Align, table};
use crate::{load, numbers};

/// Checks a scene and prints it.
pub fn run(arguments: &CheckArguments) -> Result<String> {
    let scene = load::scene(&arguments.scene, arguments.quiet)?;
    if arguments.json { numbers::json(&to_json(&scene)) } else { Ok(to_text(&scene)) }
}

fn to_text(scene: &Scene) -> String {
    let camera = scene.camera();
    let frame = CameraFrame::<f64>::new(camera);
    let convention = scene.convention();
    let mut text = String::new();
    // Writing to a text cannot fail.
    let mut row = |name: &str, value: String| {
        let _ = writeln!(text, "  {name:<12}{value}");
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
    for (title, table) in [
        ("materials", materials(scene)),
        ("shapes", shapes(scene)),
        ("lights", lights(scene)),
        ("probes", probes(scene)),
    ] {
        let _ = write!(text, "\n{title}\n{}", table.unwrap_or_else(|| "  none\n".into()));
    }
    text
}

/// The name of the row and what stands in it.
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
            Measure::Vector(value) => format!("{name} {}", vector(value)),
            Measure::Number(value) => format!("{name} {}", short(value)),
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
        let light_row =
            |position, intensity, power, emission| vec![light.name.clone(), position, intensity, power, emission];
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

/// I₀ of a point light, E₀ of a parallel one.
fn intensity_of(light: &Light) -> f64 {
    match &light.kind {
        LightKind::Point(point) => point.intensity,
        LightKind::Parallel(parallel) => parallel.irradiance,
    }
}

fn power_of(light: &Light) -> f64 {
    match &light.kind {
        LightKind::Point(point) => point.power(),
        LightKind::Parallel(_) => 0.0,
    }
}

/// L_a, 0 where there is no ambient light.
fn radiance_of(lighting: &Lighting) -> f64 {
    lighting.ambient.map_or(0.0, |ambient| ambient.radiance)
}

/// An amount of each component, where they differ; else the one number that it is.
fn components(scene: &Scene, of: impl Fn(&Lighting) -> f64, one: f64) -> std::result::Result<[f64; 3], f64> {
    let Some(color) = scene.color() else { return Err(one) };
    let amounts = color.lighting.map(of);
    if amounts.is_even() { Err(amounts.red) } else { Ok(amounts.into_array()) }
}

/// As a text.
fn amount(scene: &Scene, of: impl Fn(&Lighting) -> f64, one: f64) -> String {
    components(scene, of, one).map_or_else(short, |amounts| format!("[{}]", amounts.map(short).join(", ")))
}

/// For programs.
fn amount_json(scene: &Scene, of: impl Fn(&Lighting) -> f64, one: f64) -> Value {
    components(scene, of, one).map_or_else(|one| json!(one), |amounts| json!(amounts))
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
    format!("({x}, {y}, {z})")
}

/// The same in SI units, for programs.
fn to_json(scene: &Scene) -> Value {
    let materials = scene.materials().iter().enumerate().map(|(index, material)| material_json(scene, index, material));
    let lights = scene.lights().iter().enumerate().map(|(index, light)| light_json(scene, index, light));
    json!({
        "title": scene.title(),
        "length": "m",
        "length_in_file": scene.length().name(),
        "handedness": scene.camera().handedness.name(),
        "convention": scene.convention().name(),
        "formula": scene.convention().formula_number(),
        "quantities": scene.unit_system().name(),
        "unit": scene.convention().unit(scene.unit_system()),
        "color_space": scene.color().map(|color| color.space.name()),
        "shadows": scene.shadows(),
        "sampling": sampling_json(scene.sampling()),
        "camera": camera_json(scene.camera()),
        "materials": materials.collect::<Vec<_>>(),
        "shapes": scene.shapes().iter().map(|shape| shape_json(shape, scene)).collect::<Vec<_>>(),
        "lights": lights.collect::<Vec<_>>(),
        "ambient": scene.ambient().map(|ambient| ambient_json(scene, ambient)),
        "probes": scene.probes().iter().map(probe_json).collect::<Vec<_>>(),
        "warnings": scene.warnings().iter().map(warning_json).collect::<Vec<_>>(),
    })
}

fn ambient_json(scene: &Scene, ambient: &Ambient) -> Value {
    let obstruction = ambient.obstruction;
    let radiance = amount_json(scene, radiance_of, ambient.radiance);
    json!({"radiance": radiance, "obstructed": obstruction.is_some(), "samples": obstruction})
}

fn sampling_json(sampling: Sampling) -> Value {
    let Sampling { samples, tolerance, filter } = sampling;
    json!({"samples": samples, "tolerance": tolerance, "filter": filter.name()})
}

fn camera_json(camera: &Camera) -> Value {
    let frame = CameraFrame::<f64>::new(camera);
    let mut value = json!({
        "eye": camera.eye.to_array(),
        "forward": frame.forward.to_array(),
        "up": frame.up.to_array(),
        "right": frame.right.to_array(),
        "resolution": [camera.resolution.width, camera.resolution.height],
    });
    let (name, key, projection) = match camera.projection {
        Projection::Perspective(Screen { distance, x, y }) => {
            ("perspective", "screen", json!({"distance": distance, "x": x, "y": y}))
        }
        Projection::Orthographic(Extent { x, y }) => ("orthographic", "window", json!({"x": x, "y": y})),
        Projection::Fisheye(Fisheye { mapping, field_of_view }) => {
            let name = if mapping == Mapping::Equidistant { "fisheye-equidistant" } else { "fisheye-equal-area" };
            (name, "field_of_view", field_of_view.into())
        }
        Projection::Panorama(Extent { x, y }) => ("panorama", "edges", json!({"longitude": x, "latitude": y})),
    };
    value["projection"] = name.into();
    value[key] = projection;
    value
}

fn material_json(scene: &Scene, index: usize, material: &Material) -> Value {
    let Reflectance { diffuse, specular, shininess } = material.reflectance;
    let diffuse = amount_json(scene, |lighting| lighting.materials[index].reflectance.diffuse, diffuse);
    let specular = amount_json(scene, |lighting| lighting.materials[index].reflectance.specular, specular);
    json!({"name": material.name, "diffuse": diffuse, "specular": specular, "shininess": shininess})
}

fn shape_json(shape: &Shape, scene: &Scene) -> Value {
    let material = shape.material.map(|index| scene.materials()[index].name.as_str());
    let mut json = json!({
        "name": shape.name, "shape": shape.geometry.kind(), "material": material,
        "casts_shadow": shape.casts_shadow, "receives_shadow": shape.receives_shadow,
    });
    for (name, measure) in shape.geometry.measures() {
        json[name] = match measure {
            Measure::Vector(value) => json!(value.to_array()),
            Measure::Number(value) => json!(value),
            Measure::Count(count) => json!(count),
        };
    }
    json
}

fn light_json(scene: &Scene, index: usize, light: &Light) -> Value {
    let strength = |of: fn(&Light) -> f64| amount_json(scene, |lighting| of(&lighting.lights[index]), of(light));
    let point = match &light.kind {
        LightKind::Point(point) => point,
        LightKind::Parallel(parallel) => {
            return json!({
                "name": light.name, "emission": "parallel", "direction": parallel.direction.to_array(),
                "irradiance": strength(intensity_of),
            });
        }
    };
    let (emission, axis) = match point.emission {
        Emission::Isotropic => ("isotropic", None),
        Emission::Lambertian { axis } => ("lambertian", Some(axis.to_array())),
        Emission::Spot(spot) => ("spot", Some(spot.cone.axis.to_array())),
    };
    let mut value = json!({
        "name": light.name, "position": point.position.to_array(), "intensity": strength(intensity_of),
        "power": strength(power_of), "emission": emission, "axis": axis,
    });
    if let Emission::Spot(spot) = point.emission {
        value["inner_angle"] = spot.inner_angle().to_degrees().into();
        value["outer_angle"] = spot.outer_angle().to_degrees().into();
    }
    value
}

fn probe_json(probe: &Probe) -> Value {
    json!({"name": probe.name, "at": probe.at.to_array(), "published": probe.published})
}

fn warning_json(warning: &Problem) -> Value {
    let line = warning.place.as_ref().map(|place| place.line);
    json!({"path": warning.path, "message": warning.message, "help": warning.help, "line": line})
}
