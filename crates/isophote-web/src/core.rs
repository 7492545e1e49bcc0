//! A scene in a worker, and the questions that it answers.

use isophote::analysis::surface::{SurfaceProjection, SurfaceRequest as SurfaceOfScene};
use isophote::map::{Quantity, Resolution};
use isophote::message;
use isophote::prepare::PreparedScene;
use isophote::scene::library::Starter;
use isophote::scene::{Problem, Scene, SceneError, SceneSource, Syntax};
use isophote::shape::{Primitive, Side};
use isophote::text::Language;
use serde::Serialize;
use serde::de::DeserializeOwned;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::answers::{AreaAnswer, Explanation, Probed, refusal};
use crate::export::export;
use crate::files::PageFiles;
use crate::frame::{Analysis, Band, render, rows};
use crate::info::SceneInfo;
use crate::problem::{ProblemAnswer, Refusal, json, told};
use crate::request::{
    ExportRequest, FrameHead, Levels, ProbeRequest, SectionRequest, SurfaceRequest, channel, colormap, keyword,
    shape_named,
};
use crate::section::Section;

/// Pixels of the longer side of a small map.
const THUMBNAIL: u32 = 200;

/// What a worker holds.
#[wasm_bindgen]
#[derive(Default)]
pub struct Core {
    language: Language,
    /// The files that scenes name, which the page has handed in.
    files: PageFiles,
    /// The last valid scene that was loaded.
    scene: Option<PreparedScene>,
    /// The same at half its resolution, for previews.
    half: Option<PreparedScene>,
    /// The same in at most [`THUMBNAIL`] pixels a side.
    small: Option<PreparedScene>,
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
        let language =
            keyword(name, |name, allowed| message!("there is no language `{name}`; allowed: {allowed}", name, allowed));
        self.language = told(language, self.language)?;
        Ok(())
    }

    /// Takes the content of a file that scenes name; it stays as long as this core does.
    pub fn add_file(&mut self, name: &str, content: Vec<u8>) {
        self.files.insert(name, content);
    }

    /// Reads a text, which is `toml` or `json`.
    ///
    /// # Errors
    /// Another syntax.
    pub fn read(&self, text: &str, syntax: &str) -> Result<String, JsValue> {
        let syntax = match syntax {
            "toml" => Syntax::Toml,
            "json" => Syntax::Json,
            other => {
                let refusal = Refusal(message!("no scene is written in `{other}`; allowed: `toml`, `json`", other));
                return told(Err(refusal), self.language);
            }
        };
        let (source, problems) = match Scene::from_text_with(&self.files, None, "", text, syntax) {
            Ok(scene) => (scene.source().clone(), ProblemAnswer::all(scene.warnings(), self.language)),
            Err(error) => {
                (SceneSource::readable_part(text, syntax), ProblemAnswer::all(&error.problems, self.language))
            }
        };
        let scene = (source != SceneSource::default()).then_some(source);
        told(json(&ReadScene { scene, problems }), self.language)
    }

    /// A starter scene with its comments.
    ///
    /// # Errors
    /// There is none of this name.
    pub fn starter(&self, name: &str) -> Result<String, JsValue> {
        let starter = keyword(name, |name, allowed| {
            message!("there is no starter scene `{name}`; allowed: {allowed}", name, allowed)
        });
        let starter: Starter = told(starter, self.language)?;
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
        let language = self.language;
        let checked = |info: Option<SceneInfo>, problems: &[Problem]| {
            told(json(&Checked { info, problems: ProblemAnswer::all(problems, language) }), language)
        };
        let earlier = self.scene.as_ref().map(PreparedScene::scene);
        match Scene::from_text_with(&self.files, earlier, "", scene, Syntax::Json) {
            Err(SceneError { problems, .. }) => checked(None, &problems),
            Ok(scene) => {
                let prepared = match &self.scene {
                    Some(earlier) => PreparedScene::reusing(earlier, &scene),
                    None => PreparedScene::new(&scene),
                };
                let info = SceneInfo::new(&prepared);
                self.half = None;
                self.small = None;
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
        let band = self.rendered(name, [first, count, step]);
        told(band, self.language)
    }

    /// A small map of a channel.
    ///
    /// # Errors
    /// No scene, no such channel.
    pub fn thumbnail(&mut self, name: &str) -> Result<Band, JsValue> {
        let band = self.small_map(name);
        told(band, self.language)
    }

    /// Statistics and isophotes of a frame.
    ///
    /// # Errors
    /// A frame that is no map.
    pub fn analyse(&self, head: &str, values: Vec<f64>, shapes: Vec<i32>, levels: &str) -> Result<String, JsValue> {
        self.answer(|core| {
            let (head, levels): (FrameHead, Levels) = (asked(head)?, asked(levels)?);
            json(&Analysis::new(core.scene()?, &head, values, shapes, &levels)?)
        })
    }

    /// Values at places.
    ///
    /// # Errors
    /// No scene.
    pub fn probe(&self, requests: &str) -> Result<String, JsValue> {
        self.answer(|core| {
            let (scene, requests) = (core.scene()?, asked::<Vec<ProbeRequest>>(requests)?);
            json(&requests.iter().map(|request| Probed::new(request, scene, core.language)).collect::<Vec<_>>())
        })
    }

    /// The calculation of a value.
    ///
    /// # Errors
    /// A place without a value.
    pub fn explain(&self, request: &str) -> Result<String, JsValue> {
        self.answer(|core| {
            let (prepared, request) = (core.scene()?, asked::<ProbeRequest>(request)?);
            let reading = prepared.probe(&request.position(prepared.scene())?);
            let reading = reading.map_err(|error| Refusal(refusal(&error, prepared.scene())))?;
            json(&Explanation::new(&reading.explain(prepared, &request.name, core.language)))
        })
    }

    /// Values along lines.
    ///
    /// # Errors
    /// A line that is not in the image, or a channel that sections do not have.
    pub fn section(&self, lines: &str, channels: &str) -> Result<String, JsValue> {
        self.answer(|core| {
            let prepared = core.scene()?;
            let (lines, names): (Vec<SectionRequest>, Vec<String>) = (asked(lines)?, asked(channels)?);
            let channels: Result<Vec<Quantity>, Refusal> =
                names.iter().map(|name| channel(name, prepared.scene())).collect();
            json(&Section::all(&lines, &channels?, prepared, core.language)?)
        })
    }

    /// The values inside the areas of the scene.
    ///
    /// # Errors
    /// No scene.
    pub fn areas(&self) -> Result<String, JsValue> {
        self.answer(|core| json(&AreaAnswer::all(core.scene()?)))
    }

    /// A channel over a shape's own surface.
    ///
    /// # Errors
    /// A shape without coordinates, or a channel that surfaces do not have.
    pub fn surface(&self, request: &str, name: &str) -> Result<Band, JsValue> {
        self.answer(|core| {
            let (prepared, request) = (core.scene()?, asked::<SurfaceRequest>(request)?);
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
            let size = prepared.surface(&of_width(None))?.size();
            let height = (u64::from(size.height) * u64::from(request.width) / u64::from(size.width.max(1))).max(2);
            let size = Resolution { width: request.width, height: u32::try_from(height).unwrap_or(u32::MAX) };
            let surface = prepared.surface(&of_width(Some(size)))?;
            let map = surface.map(std::slice::from_ref(&quantity))?;
            Band::of(map, &quantity)
        })
    }

    /// A channel on a grid of the scene.
    ///
    /// # Errors
    /// There is no such grid, or no such channel.
    pub fn grid(&self, grid: &str, name: &str) -> Result<Band, JsValue> {
        self.answer(|core| {
            let prepared = core.scene()?;
            let quantity = channel(name, prepared.scene())?;
            let known = prepared.scene().grids().iter().find(|known| known.name == grid);
            let known = known.ok_or_else(|| Refusal(message!("there is no grid \"{grid}\"", grid)))?;
            let map = prepared.grid(known, std::slice::from_ref(&quantity))?;
            Band::of(map, &quantity)
        })
    }

    /// The bytes of a file.
    ///
    /// # Errors
    /// What cannot be drawn or written.
    pub fn export(&self, request: &str) -> Result<Vec<u8>, JsValue> {
        self.answer(|core| export(core.scene()?, &asked::<ExportRequest>(request)?, core.language))
    }

    /// 256 colours, three bytes each.
    ///
    /// # Errors
    /// There is no such colour map.
    pub fn colormap(&self, name: &str) -> Result<Vec<u8>, JsValue> {
        let colormap = told(colormap(name), self.language)?;
        Ok((0..=255_u8).flat_map(|index| colormap.color(f64::from(index) / 255.0)).collect())
    }
}

impl Core {
    /// The answer to a question about the scene, or why there is none in the language of the page.
    fn answer<T>(&self, of: impl FnOnce(&Self) -> Result<T, Refusal>) -> Result<T, JsValue> {
        told(of(self), self.language)
    }

    fn rendered(&mut self, name: &str, [first, count, step]: [u32; 3]) -> Result<Band, Refusal> {
        let quantity = channel(name, self.scene()?.scene())?;
        let prepared = if step == 2 { self.half()? } else { self.scene()? };
        let region = rows(prepared.scene().camera().resolution, first, count);
        let mut quantities = vec![quantity.clone()];
        // Says which pixels are lit; previews are not counted.
        if step == 1 && quantity != Quantity::Irradiance {
            quantities.push(Quantity::Irradiance);
        }
        Band::of(render(prepared, quantities, Some(region))?, &quantity)
    }

    fn scene(&self) -> Result<&PreparedScene, Refusal> {
        self.scene.as_ref().ok_or_else(no_scene)
    }

    fn small_map(&mut self, name: &str) -> Result<Band, Refusal> {
        let quantity = channel(name, self.scene()?.scene())?;
        let Self { scene: Some(scene), small, .. } = self else { return Err(no_scene()) };
        let prepared = small.get_or_insert_with(|| resized(scene, thumbnail_of));
        Band::of(render(prepared, vec![quantity.clone()], None)?, &quantity)
    }

    fn half(&mut self) -> Result<&PreparedScene, Refusal> {
        let Self { scene: Some(scene), half, .. } = self else { return Err(no_scene()) };
        Ok(half.get_or_insert_with(|| resized(scene, half_of)))
    }
}

fn no_scene() -> Refusal {
    Refusal(message!("no scene was loaded"))
}

/// The same scene with another number of pixels.
fn resized(scene: &PreparedScene, size: impl Fn(Resolution) -> Resolution) -> PreparedScene {
    scene.at_resolution(size(scene.scene().camera().resolution))
}

fn half_of(Resolution { width, height }: Resolution) -> Resolution {
    Resolution { width: width.div_ceil(2), height: height.div_ceil(2) }
}

/// A size with the same proportions, of at most [`THUMBNAIL`] pixels a side.
fn thumbnail_of(size: Resolution) -> Resolution {
    let longest = u64::from(size.width.max(size.height).max(1));
    let side = |pixels: u32| {
        let scaled = (u64::from(pixels) * u64::from(THUMBNAIL)).div_ceil(longest);
        pixels.min(u32::try_from(scaled).unwrap_or(THUMBNAIL))
    };
    Resolution { width: side(size.width), height: side(size.height) }
}

/// A question as JSON.
fn asked<T: DeserializeOwned>(json: &str) -> Result<T, Refusal> {
    serde_json::from_str(json)
        .map_err(|error| Refusal(message!("this question is not one: {error}", error = error.to_string())))
}
