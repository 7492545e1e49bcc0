//! Values at points, for programs.

use isophote::analysis::probe::ProbeReading;
use isophote::prepare::PreparedScene;
use isophote::shade::Shading;
use serde::Serialize;

/// A reading as JSON; lengths in the scene's unit.
#[derive(Serialize)]
pub struct ProbeJson {
    name: String,
    point: [f64; 3],
    normal: [f64; 3],
    shape: String,
    seen: bool,
    /// Why it is not seen.
    #[serde(skip_serializing_if = "Option::is_none")]
    unseen_because: Option<String>,
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
    /// The luminance, if the scene has colours.
    value: f64,
    unit: &'static str,
    /// The colour components.
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
    /// None for a parallel light.
    #[serde(skip_serializing_if = "Option::is_none")]
    distance: Option<f64>,
    /// None for a parallel light.
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
            unseen_because: reading.why_unseen(description).map(|why| why.to_string()),
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

/// A quantity per component, if the scene has colours.
fn rgb(reading: &ProbeReading, of: &dyn Fn(&ProbeReading) -> f64) -> Option<[f64; 3]> {
    reading.components.as_deref().map(|readings| readings.map(of).into_array())
}
