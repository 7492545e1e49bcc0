//! A scene in SI units, for programs.

use isophote::camera::{Camera, CameraFrame, Extent, Fisheye, Mapping, Projection, Screen};
use isophote::light::{Ambient, Emission, Light, LightKind};
use isophote::reflectance::Reflectance;
use isophote::scene::{Lighting, Material, Probe, Problem, Sampling, Scene, Shape};
use isophote::shape::Measure;
use isophote::units::Keyword;
use serde_json::{Value, json};

use super::amounts::{components, intensity_of, power_of, radiance_of};

/// The scene as Isophote understands it.
pub(super) fn of(scene: &Scene) -> Value {
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
                "irradiance": strength(intensity_of), "on": light.is_on,
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
        "power": strength(power_of), "emission": emission, "axis": axis, "on": light.is_on,
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
    let (message, help) = (warning.message.to_string(), warning.help.as_ref().map(ToString::to_string));
    let line = warning.place.as_ref().map(|place| place.line);
    json!({"path": warning.path, "message": message, "help": help, "line": line})
}

/// An amount, per component if they differ.
fn amount_json(scene: &Scene, of: impl Fn(&Lighting) -> f64, one: f64) -> Value {
    components(scene, of, one).map_or_else(|one| json!(one), |amounts| json!(amounts))
}
