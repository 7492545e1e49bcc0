//! Values at points and over areas.

use isophote::analysis::area::{AreaExtreme, AreaReading};
use isophote::analysis::probe::{ProbeError, ProbeReading, SeenFromEye};
use isophote::message;
use isophote::prepare::PreparedScene;
use isophote::scene::{Area, AreaPlace, Scene};
use isophote::text::{Language, Message};
use serde::Serialize;

use crate::info::{MOST_LIGHTS, on_screen};
use crate::request::{ProbeRequest, in_unit};

/// A reading, or why there is none.
#[derive(Serialize)]
pub struct Probed {
    reading: Option<Reading>,
    error: Option<String>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Reading {
    name: String,
    point: [f64; 3],
    normal: [f64; 3],
    shape: String,
    screen: Option<[f64; 2]>,
    seen: bool,
    unseen_because: Option<String>,
    cos_theta_o: f64,
    brightness: f64,
    irradiance: f64,
    ambient: f64,
    diffuse: f64,
    specular: f64,
    lights: Vec<LightReading>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct LightReading {
    name: String,
    irradiance: f64,
    diffuse: f64,
    specular: f64,
    visibility: f64,
    cos_theta_i: f64,
    cos_theta_h: f64,
    distance: Option<f64>,
}

impl Probed {
    pub fn new(request: &ProbeRequest, prepared: &PreparedScene, language: Language) -> Self {
        let scene = prepared.scene();
        let reading = request.position(scene).map_err(|refusal| refusal.0);
        match reading.and_then(|position| prepared.probe(&position).map_err(|error| refusal(&error, scene))) {
            Ok(reading) => {
                Self { reading: Some(Reading::new(&request.name, &reading, prepared, language)), error: None }
            }
            Err(error) => Self { reading: None, error: Some(error.in_language(language)) },
        }
    }
}

/// Why there is no value, and where the nearest one is.
pub fn refusal(error: &ProbeError, scene: &Scene) -> Message {
    match error {
        ProbeError::OffSurface(miss) => {
            let miss = miss.describe(&scene.shapes()[miss.shape].name, scene.length());
            message!("{error}: {miss}", error = error.message(), miss)
        }
        other => other.message(),
    }
}

impl Reading {
    fn new(name: &str, reading: &ProbeReading, prepared: &PreparedScene, language: Language) -> Self {
        let scene = prepared.scene();
        let length = scene.length();
        let lights = scene.lights().iter().enumerate().take(MOST_LIGHTS).map(|(index, light)| {
            let (term, [diffuse, specular]) = (&reading.terms[index], reading.light_shares(prepared, index));
            LightReading {
                name: light.name.clone(),
                irradiance: term.irradiance,
                diffuse,
                specular,
                visibility: term.visibility,
                cos_theta_i: term.cos_theta_i,
                cos_theta_h: term.cos_theta_h,
                distance: light.position().map(|_| length.from_metres(term.distance)),
            }
        });
        let point = &reading.hit.point;
        Self {
            name: name.into(),
            point: reading.position(length),
            normal: point.normal.to_array(),
            shape: scene.name_of(reading.hit.primitive),
            screen: on_screen(prepared, point.position()),
            seen: reading.is_seen(),
            unseen_because: reading.why_unseen(scene).map(|why| why.in_language(language)),
            cos_theta_o: point.cos_theta_o,
            brightness: reading.shading.brightness(),
            irradiance: reading.shading.irradiance,
            ambient: reading.shading.ambient,
            diffuse: reading.shading.diffuse,
            specular: reading.shading.specular,
            lights: lights.collect(),
        }
    }
}

/// The values inside an area.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub struct AreaAnswer {
    name: String,
    on: Option<String>,
    unit: &'static str,
    max: Option<ExtremeAnswer>,
    min: Option<ExtremeAnswer>,
    mean: Option<f64>,
    mean_error: Option<f64>,
    visible: f64,
}

#[derive(Serialize)]
struct ExtremeAnswer {
    value: f64,
    point: [f64; 3],
    screen: Option<[f64; 2]>,
    seen: bool,
}

impl AreaAnswer {
    pub fn all(prepared: &PreparedScene) -> Vec<Self> {
        let scene = prepared.scene();
        scene.areas().iter().map(|area| Self::new(area, prepared.area(area).as_ref(), prepared)).collect()
    }

    fn new(area: &Area, reading: Option<&AreaReading>, prepared: &PreparedScene) -> Self {
        let scene = prepared.scene();
        let extreme = |extreme: &AreaExtreme| ExtremeAnswer {
            value: extreme.value,
            point: in_unit(extreme.point, scene.length()),
            screen: on_screen(prepared, extreme.point),
            seen: extreme.seen == SeenFromEye::Seen,
        };
        Self {
            name: area.name.clone(),
            on: match area.place {
                AreaPlace::Surface { shape, .. } => Some(scene.shapes()[shape].name.clone()),
                AreaPlace::Screen(_) => None,
            },
            unit: scene.convention().unit(scene.unit_system()),
            max: reading.map(|reading| extreme(&reading.max)),
            min: reading.map(|reading| extreme(&reading.min)),
            mean: reading.map(|reading| reading.mean),
            mean_error: reading.map(|reading| reading.mean_error),
            visible: reading.map_or(0.0, |reading| reading.visible),
        }
    }
}

/// Blocks, most of them lights, that the page shows of a calculation.
const MOST_BLOCKS: usize = 100;
/// Blocks that stand behind those of the lights: ambient light, and the sum.
const LAST_BLOCKS: usize = 2;

/// The calculation of a value, in blocks.
#[derive(Serialize)]
pub struct Explanation {
    title: String,
    blocks: Vec<Block>,
    /// Blocks that are left out before the last ones.
    omitted: usize,
}

#[derive(Serialize)]
struct Block {
    title: String,
    lines: Vec<String>,
}

impl Explanation {
    /// From the explanation as a text: blocks are set apart by empty lines, and the first one is the title. Of many blocks, the
    /// first [`MOST_BLOCKS`] stay, and the last ones.
    pub fn new(text: &str) -> Self {
        let mut blocks = text.split("\n\n");
        let title = blocks.next().unwrap_or_default().lines().collect::<Vec<_>>().join(" — ");
        let blocks: Vec<&str> = blocks.collect();
        let (first, rest) = blocks.split_at(blocks.len().min(MOST_BLOCKS));
        let last = &rest[rest.len().saturating_sub(LAST_BLOCKS)..];
        let block = |text: &&str| {
            let mut lines = text.lines().map(str::to_owned);
            Block { title: lines.next().unwrap_or_default(), lines: lines.collect() }
        };
        Self { title, blocks: first.iter().chain(last).map(block).collect(), omitted: rest.len() - last.len() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_long_calculation_the_first_blocks_and_the_sum_stay() {
        let text = |lights: usize| {
            let light = |index: usize| format!("Light {index}\n  E = {index}");
            let blocks: Vec<String> = (1..=lights).map(light).collect();
            format!("P: lab\nConvention\n\nGeometry\n  P = 0\n\n{}\n\nAmbient\n\nSum\n  B = 1\n", blocks.join("\n\n"))
        };
        let titles = |explanation: &Explanation| -> Vec<String> {
            explanation.blocks.iter().map(|block| block.title.clone()).collect()
        };
        let short = Explanation::new(&text(3));
        assert_eq!(short.title, "P: lab — Convention");
        assert_eq!(titles(&short), ["Geometry", "Light 1", "Light 2", "Light 3", "Ambient", "Sum"]);
        assert_eq!((short.omitted, &short.blocks[5].lines), (0, &vec!["  B = 1".to_owned()]));
        let whole = Explanation::new(&text(MOST_BLOCKS - 1));
        assert_eq!((whole.blocks.len(), whole.omitted), (MOST_BLOCKS + 2, 0));
        let long = Explanation::new(&text(1000));
        assert_eq!((long.blocks.len(), long.omitted), (MOST_BLOCKS + 2, 1001 - MOST_BLOCKS));
        assert_eq!(titles(&long)[MOST_BLOCKS - 1..], ["Light 99", "Ambient", "Sum"]);
    }
}
