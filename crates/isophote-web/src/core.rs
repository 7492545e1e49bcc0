//! A scene in a worker, and the questions that it answers.

use isophote::analysis::surface::{SurfaceProjection, SurfaceRequest as SurfaceOfScene};
use isophote::map::{Quantity, Resolution};
use isophote::prepare::PreparedScene;
use isophote::scene::library::{Language, Starter};
use isophote::scene::{Problem, Scene, SceneError, SceneSource, Syntax};
use isophote::shape::{Primitive, Side};
use isophote_export::colormap::Colormap;
use serde::Serialize;
use serde::de::DeserializeOwned;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::answers::{AreaAnswer, Explanation, Probed, refusal};
use crate::export::export;
use crate::frame::{Analysis, Band, render, rows};
use crate::info::SceneInfo;
use crate::problem::{ProblemAnswer, Refusal, json};
use crate::request::{
    ExportRequest, FrameHead, Levels, ProbeRequest, SectionRequest, SurfaceRequest, channel, keyword, shape_named,
};
use crate::section::Section;

/// What a worker holds.
#[wasm_bindgen]
#[derive(Default)]
pub struct Core {
    language: Language,
    /// The last valid scene that was loaded.
    scene: Option<PreparedScene>,
    /// The same at half its resolution, for previews.
    half: Option<PreparedScene>,
}

#[derive(Serialize)]
struct ReadScene {
    /// As much of it as can be read; `None` if that is nothing.
    scene: Option<SceneSource>,
    problems: Vec<ProblemAnswer>,
}

#[derive(Serialize)]
struct Checked {
    info: Option<SceneInfo>,
    problems: Vec<ProblemAnswer>,
}

#[wasm_bindgen]
impl Core {
    /// A core without a scene.
    #[wasm_bindgen(constructor)]
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the language of messages and explanations: `en` or `ru`.
    ///
    /// # Errors
    /// Another language.
    pub fn set_language(&mut self, name: &str) -> Result<(), JsValue> {
        self.language = keyword("language", name)?;
        Ok(())
    }

    /// Reads a text, which is `toml` or `json`.
    ///
    /// # Errors
    /// Another syntax.
    pub fn read(&self, text: &str, syntax: &str) -> Result<String, JsValue> {
        let syntax = match syntax {
            "toml" => Syntax::Toml,
            "json" => Syntax::Json,
            other => return Err(Refusal(format!("no scene is written in {other}; allowed: toml, json")).into()),
        };
        let (source, problems) = match Scene::from_text("", text, syntax) {
            Ok(scene) => (scene.source().clone(), ProblemAnswer::all(scene.warnings())),
            Err(error) => (SceneSource::readable_part(text, syntax), ProblemAnswer::all(&error.problems)),
        };
        let scene = (source != SceneSource::default()).then_some(source);
        Ok(json(&ReadScene { scene, problems })?)
    }

    /// A starter scene with its comments.
    ///
    /// # Errors
    /// There is none of this name.
    pub fn starter(&self, name: &str) -> Result<String, JsValue> {
        let starter: Starter = keyword("starter scene", name)?;
        Ok(starter.text_in(self.language).into())
    }

    /// The same scene as TOML.
    ///
    /// # Errors
    /// A text that is not JSON.
    pub fn to_toml(&self, scene: &str) -> Result<String, JsValue> {
        Ok(SceneSource::readable_part(scene, Syntax::Json).to_toml())
    }

    /// Takes a scene, as JSON, if it is valid; otherwise the last one stays. Says what is known of it, and what is wrong.
    ///
    /// # Errors
    /// None that is known.
    pub fn load(&mut self, scene: &str) -> Result<String, JsValue> {
        let checked = |info: Option<SceneInfo>, problems: &[Problem]| {
            Ok(json(&Checked { info, problems: ProblemAnswer::all(problems) })?)
        };
        match Scene::from_text("", scene, Syntax::Json) {
            Err(SceneError { problems, .. }) => checked(None, &problems),
            Ok(scene) => {
                let prepared = match &self.scene {
                    Some(earlier) => PreparedScene::reusing(earlier, &scene),
                    None => PreparedScene::new(&scene),
                };
                let info = SceneInfo::new(&prepared);
                self.half = None;
                self.scene = Some(prepared);
                checked(Some(info), scene.warnings())
            }
        }
    }

    /// Rows of a channel, `step` 2 for those of an image of half the resolution.
    ///
    /// # Errors
    /// No scene, no such channel, no such rows.
    pub fn render(&mut self, name: &str, first: u32, count: u32, step: u32) -> Result<Band, JsValue> {
        let quantity = channel(name, self.scene()?.scene())?;
        let prepared = if step == 2 { self.half()? } else { self.scene()? };
        let region = rows(prepared.scene().camera().resolution, first, count);
        Ok(Band::of(render(prepared, vec![quantity.clone()], Some(region))?, &quantity)?)
    }

    /// Statistics and isophotes of a frame.
    ///
    /// # Errors
    /// A frame that is no map.
    pub fn analyse(&self, head: &str, values: Vec<f64>, shapes: Vec<i32>, levels: &str) -> Result<String, JsValue> {
        let (head, levels): (FrameHead, Levels) = (asked(head)?, asked(levels)?);
        Ok(json(&Analysis::new(self.scene()?, &head, values, shapes, &levels)?)?)
    }

    /// Values at places.
    ///
    /// # Errors
    /// No scene.
    pub fn probe(&self, requests: &str) -> Result<String, JsValue> {
        let (scene, requests) = (self.scene()?, asked::<Vec<ProbeRequest>>(requests)?);
        Ok(json(&requests.iter().map(|request| Probed::new(request, scene)).collect::<Vec<_>>())?)
    }

    /// The calculation of a value.
    ///
    /// # Errors
    /// A place without a value.
    pub fn explain(&self, request: &str) -> Result<String, JsValue> {
        let (prepared, request) = (self.scene()?, asked::<ProbeRequest>(request)?);
        let reading = prepared.probe(&request.position(prepared.scene())?);
        let reading = reading.map_err(|error| Refusal(refusal(&error, prepared.scene())))?;
        Ok(json(&Explanation::new(&reading.explain(prepared, &request.name)))?)
    }

    /// Values along lines.
    ///
    /// # Errors
    /// A line that is not in the image, or a channel that sections do not have.
    pub fn section(&self, lines: &str, channels: &str) -> Result<String, JsValue> {
        let prepared = self.scene()?;
        let (lines, names): (Vec<SectionRequest>, Vec<String>) = (asked(lines)?, asked(channels)?);
        let channels: Result<Vec<Quantity>, Refusal> =
            names.iter().map(|name| channel(name, prepared.scene())).collect();
        Ok(json(&Section::all(&lines, &channels?, prepared)?)?)
    }

    /// The values inside the areas of the scene.
    ///
    /// # Errors
    /// No scene.
    pub fn areas(&self) -> Result<String, JsValue> {
        Ok(json(&AreaAnswer::all(self.scene()?))?)
    }

    /// A channel over a shape's own surface.
    ///
    /// # Errors
    /// A shape without coordinates, or a channel that surfaces do not have.
    pub fn surface(&self, request: &str, name: &str) -> Result<Band, JsValue> {
        let (prepared, request) = (self.scene()?, asked::<SurfaceRequest>(request)?);
        let quantity = channel(name, prepared.scene())?;
        let shape = shape_named(&request.shape, prepared.scene())?;
        let projection =
            if request.equal_area { SurfaceProjection::EqualArea } else { SurfaceProjection::Equirectangular };
        let of_width = |size: Option<Resolution>| SurfaceOfScene {
            primitive: Primitive { shape, part: 0 },
            projection,
            axis: None,
            side: Side::Front,
            size,
        };
        let size = prepared.surface(&of_width(None)).map_err(Refusal::from)?.size();
        let height = (u64::from(size.height) * u64::from(request.width) / u64::from(size.width.max(1))).max(2);
        let size = Resolution { width: request.width, height: u32::try_from(height).unwrap_or(u32::MAX) };
        let surface = prepared.surface(&of_width(Some(size))).map_err(Refusal::from)?;
        let map = surface.map(std::slice::from_ref(&quantity)).map_err(Refusal::from)?;
        Ok(Band::of(map, &quantity)?)
    }

    /// A channel on a grid of the scene.
    ///
    /// # Errors
    /// There is no such grid, or no such channel.
    pub fn grid(&self, grid: &str, name: &str) -> Result<Band, JsValue> {
        let prepared = self.scene()?;
        let quantity = channel(name, prepared.scene())?;
        let known = prepared.scene().grids().iter().find(|known| known.name == grid);
        let known = known.ok_or_else(|| Refusal(format!("there is no grid “{grid}”")))?;
        let map = prepared.grid(known, std::slice::from_ref(&quantity)).map_err(Refusal::from)?;
        Ok(Band::of(map, &quantity)?)
    }

    /// The bytes of a file.
    ///
    /// # Errors
    /// What cannot be drawn or written.
    pub fn export(&self, request: &str) -> Result<Vec<u8>, JsValue> {
        Ok(export(self.scene()?, &asked::<ExportRequest>(request)?)?)
    }

    /// 256 colours, three bytes each.
    ///
    /// # Errors
    /// There is no such colour map.
    pub fn colormap(&self, name: &str) -> Result<Vec<u8>, JsValue> {
        let colormap: Colormap = keyword("colour map", name)?;
        Ok((0..=255_u8).flat_map(|index| colormap.color(f64::from(index) / 255.0)).collect())
    }
}

impl Core {
    fn scene(&self) -> Result<&PreparedScene, Refusal> {
        self.scene.as_ref().ok_or_else(|| Refusal("no scene was loaded".into()))
    }

    fn half(&mut self) -> Result<&PreparedScene, Refusal> {
        if self.half.is_none() {
            let scene = self.scene()?;
            let Resolution { width, height } = scene.scene().camera().resolution;
            let half = Resolution { width: width.div_ceil(2), height: height.div_ceil(2) };
            self.half = Some(scene.at_resolution(half));
        }
        self.half.as_ref().ok_or_else(|| Refusal("no scene was loaded".into()))
    }
}

/// A question as JSON.
fn asked<T: DeserializeOwned>(json: &str) -> Result<T, Refusal> {
    serde_json::from_str(json).map_err(|error| Refusal(format!("this question is not one: {error}")))
}
