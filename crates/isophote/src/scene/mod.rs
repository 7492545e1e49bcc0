//! Scenes: read once, checked once, valid from then on.

mod color;
pub mod document;
pub mod error;
mod filter;
pub mod library;
mod read;
mod sampling;
pub mod source;
mod validate;

use std::io::Read;
use std::path::Path as FilePath;

pub use color::{Lighting, SceneColor};
pub use document::Syntax;
pub use error::{Problem, ProblemKind, SceneError, TextPosition};
pub use filter::Filter;
pub use sampling::Sampling;
pub use source::SceneSource;
use source::{GridSource, SamplingSource, ShadowSource};
pub use validate::limits;

use crate::camera::Camera;
use crate::light::{Ambient, Light};
use crate::map::Resolution;
use crate::reflectance::{Convention, Reflectance};
use crate::shape::{Geometry, Primitive, Side};
use crate::units::{LengthUnit, ScreenUnit, UnitSystem};
use crate::vector::Vector;
use document::Document;
use read::Problems;

/// A scene that is valid by construction. Lengths in metres.
#[derive(Clone, Debug)]
pub struct Scene {
    /// A line that says what the scene is; may be empty.
    pub(crate) title: String,
    pub(crate) length: LengthUnit,
    pub(crate) convention: Convention,
    pub(crate) shadows: bool,
    pub(crate) sampling: Sampling,
    pub(crate) unit_system: UnitSystem,
    pub(crate) camera: Camera,
    pub(crate) materials: Vec<Material>,
    pub(crate) shapes: Vec<Shape>,
    pub(crate) lights: Vec<Light>,
    pub(crate) ambient: Option<Ambient>,
    /// Of a scene with colours: its materials and lights above then hold luminances, which nothing may be shaded by.
    pub(crate) color: Option<Box<SceneColor>>,
    pub(crate) probes: Vec<Probe>,
    pub(crate) grids: Vec<Grid>,
    pub(crate) warnings: Vec<Problem>,
    pub(crate) source: SceneSource,
}

/// A material with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its name, unique among the materials.
    pub name: String,
    /// Its coefficients.
    pub reflectance: Reflectance,
}

/// A thing that can be seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Its name, unique among the shapes.
    pub name: String,
    /// Index of its material; none only in the `irradiance` convention.
    pub material: Option<usize>,
    /// Its form and place.
    pub geometry: Geometry,
    /// Whether it stands in other shapes' light, if the scene has shadows.
    pub casts_shadow: bool,
    /// Whether other shapes stand in its light.
    pub receives_shadow: bool,
}

impl Shape {
    fn new(name: String, material: Option<usize>, geometry: Geometry, shadow: ShadowSource) -> Self {
        let [casts_shadow, receives_shadow] =
            [shadow.casts_shadow, shadow.receives_shadow].map(|written| written.unwrap_or(true));
        Self { name, material, geometry, casts_shadow, receives_shadow }
    }
}

/// A point on a surface whose values are reported.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Its name, unique among the probes.
    pub name: String,
    /// The point, in metres.
    pub at: Vector,
    /// A value that somebody published for this point, in the unit of the brightness.
    pub published: Option<f64>,
}

/// Points on a rectangle at which the irradiance is computed. Lengths in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Its name, unique among the grids.
    pub name: String,
    /// Where both edges begin.
    pub corner: Vector,
    /// One edge.
    pub u: Vector,
    /// The other one, at right angles to the first.
    pub v: Vector,
    /// Points along u and along v.
    pub points: Resolution,
    /// The side that is lit: u × v leads to the front.
    pub side: Side,
}

impl Scene {
    /// Reads a scene file: JSON when the name ends in `.json`, TOML otherwise.
    ///
    /// # Errors
    /// Every problem of the file and of the scene in it, with its place.
    pub fn from_file(path: &FilePath) -> Result<Self, SceneError> {
        let name = path.display().to_string();
        let text = Self::read_text(&mut open(path, &name)?, &name)?;
        let is_json = path.extension().is_some_and(|suffix| suffix.eq_ignore_ascii_case("json"));
        let syntax = if is_json { Syntax::Json } else { Syntax::Toml };
        Self::from_text_in(path.parent().unwrap_or(FilePath::new("")), &name, &text, syntax)
    }

    /// Reads a scene from a text; `name` stands for it in error messages. Relative paths in it start at the working
    /// directory.
    ///
    /// # Errors
    /// Every problem of the text and of the scene in it, with its place.
    pub fn from_text(name: &str, text: &str, syntax: Syntax) -> Result<Self, SceneError> {
        Self::from_text_in(FilePath::new(""), name, text, syntax)
    }

    /// The same, with the directory at which relative paths start.
    ///
    /// # Errors
    /// As [`from_text`](Self::from_text).
    pub fn from_text_in(directory: &FilePath, name: &str, text: &str, syntax: Syntax) -> Result<Self, SceneError> {
        Self::from_text_reusing(None, directory, name, text, syntax)
    }

    /// The same after an earlier scene: files that both name are not read again.
    ///
    /// # Errors
    /// As [`from_text`](Self::from_text).
    pub fn from_text_reusing(
        earlier: Option<&Self>,
        directory: &FilePath,
        name: &str,
        text: &str,
        syntax: Syntax,
    ) -> Result<Self, SceneError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if text.trim().is_empty() {
            let help = "`isophote new lab` writes a scene to start from";
            return Err(SceneError::unreadable(name, "the scene is empty".into(), Some(help.into())));
        }
        let mut document = Document::parse(text, syntax);
        let mut problems = Problems::default();
        let mut syntax_problems = std::mem::take(&mut document.syntax_problems);
        let is_broken = !syntax_problems.is_empty();
        let is_unreadable = syntax_problems.len() > FOLLOWED_SYNTAX_PROBLEMS;
        if is_unreadable {
            syntax_problems.truncate(1);
            let help = "what follows could not be read because of this; mend it and check again";
            syntax_problems[0].help = Some(help.into());
        }
        problems.extend(syntax_problems);
        let mut source = read::read(&document, &mut problems);
        source.directory = directory.into();
        let lines = error::Lines::new(text);
        let locate = |mut problem: Problem| {
            problem.locate(&lines, &document);
            problem
        };
        match validate::validate(source, problems, earlier) {
            Ok(mut scene) => {
                scene.warnings = scene.warnings.into_iter().map(locate).collect();
                Ok(scene)
            }
            Err(mut problems) => {
                if is_unreadable {
                    problems.retain(|problem| problem.kind == ProblemKind::Syntax);
                } else if is_broken {
                    // What a broken text seems to lack may stand in the part that could not be read.
                    problems.retain(|problem| problem.kind != ProblemKind::MissingKey);
                }
                let mut problems: Vec<Problem> = problems.into_iter().map(locate).collect();
                problems.sort_by_key(|problem| problem.place.as_ref().map_or(0, |place| place.line));
                Err(SceneError { name: name.into(), problems })
            }
        }
    }

    /// Reads the text of a scene from anything that may turn out to be endless or binary; `name` stands for it in
    /// error messages.
    ///
    /// # Errors
    /// More bytes than the [`limits`] allow, or bytes that are no text.
    pub fn read_text(input: &mut impl std::io::Read, name: &str) -> Result<String, SceneError> {
        let mut bytes = Vec::new();
        std::io::Read::take(input, limits::FILE_BYTES + 1)
            .read_to_end(&mut bytes)
            .map_err(|error| SceneError::unreadable(name, describe(&error), None))?;
        if bytes.len() as u64 > limits::FILE_BYTES {
            return Err(too_large(name, &format!("more than {} bytes", limits::FILE_BYTES)));
        }
        String::from_utf8(bytes).map_err(|error| {
            let at = error.utf8_error().valid_up_to();
            let line = String::from_utf8_lossy(&error.as_bytes()[..at]).matches('\n').count() + 1;
            let byte = error.as_bytes()[at];
            let message = format!("not a text in UTF-8: byte 0x{byte:02X} at offset {at}, line {line}");
            let help = "a scene is a TOML or JSON text; save it as UTF-8";
            SceneError::unreadable(name, message, Some(help.into()))
        })
    }

    /// The scene with another number of pixels.
    ///
    /// # Errors
    /// A resolution out of the [`limits`].
    pub fn with_resolution(&self, resolution: Resolution) -> Result<Self, SceneError> {
        self.changed(|source| {
            source.camera.get_or_insert_default().resolution =
                Some([u64::from(resolution.width), u64::from(resolution.height)]);
        })
    }

    /// The scene with what is given here in place of its own sampling.
    ///
    /// # Errors
    /// Numbers out of the [`limits`].
    pub fn with_sampling(&self, given: &SamplingSource) -> Result<Self, SceneError> {
        self.changed(|source| {
            let sampling = source.sampling.get_or_insert_default();
            sampling.samples = given.samples.or(sampling.samples);
            sampling.tolerance = given.tolerance.or(sampling.tolerance);
            sampling.filter = given.filter.or(sampling.filter);
        })
    }

    /// The scene with this grid in place of its own.
    ///
    /// # Errors
    /// Whatever is wrong with the grid.
    pub fn with_grid(&self, grid: GridSource) -> Result<Self, SceneError> {
        self.changed(|source| source.grid = vec![grid])
    }

    /// The scene with something else written in it. Its files are not read again.
    fn changed(&self, change: impl FnOnce(&mut SceneSource)) -> Result<Self, SceneError> {
        let mut source = self.source.clone();
        change(&mut source);
        let name = "the scene".into();
        validate::validate(source, Problems::default(), Some(self)).map_err(|problems| SceneError { name, problems })
    }

    /// A line that says what the scene is; may be empty.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The unit of lengths in the scene's file and in everything that is made from it.
    #[must_use]
    pub fn length(&self) -> LengthUnit {
        self.length
    }

    /// The unit of places on the camera's screen.
    #[must_use]
    pub fn screen_unit(&self) -> ScreenUnit {
        ScreenUnit::of(self.length, self.camera.projection.is_angular())
    }

    /// Which formula gives the brightness.
    #[must_use]
    pub fn convention(&self) -> Convention {
        self.convention
    }

    /// How many rays a pixel's value is made of.
    #[must_use]
    pub fn sampling(&self) -> Sampling {
        self.sampling
    }

    /// Whether shapes stand in each other's light.
    #[must_use]
    pub fn shadows(&self) -> bool {
        self.shadows
    }

    /// Whether other shapes may stand between a shape and a light.
    #[must_use]
    pub fn casts_shadows(&self, shape: usize, light: usize) -> bool {
        self.shadows && self.shapes[shape].receives_shadow && self.lights[light].casts_shadows
    }

    /// The name of a primitive: its shape's, with the number of the part if it has several.
    #[must_use]
    pub fn name_of(&self, primitive: Primitive) -> String {
        let Shape { name, geometry, .. } = &self.shapes[primitive.shape];
        if geometry.parts() > 1 { format!("{name}[{}]", primitive.part) } else { name.clone() }
    }

    /// The index of a primitive's material; none only in the `irradiance` convention.
    #[must_use]
    pub fn material_of(&self, primitive: Primitive) -> Option<usize> {
        let shape = &self.shapes[primitive.shape];
        shape.geometry.material_of(primitive.part).or(shape.material)
    }

    /// Radiometric or photometric.
    #[must_use]
    pub fn unit_system(&self) -> UnitSystem {
        self.unit_system
    }

    /// The observer.
    #[must_use]
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// What the scene has three of, if it has colours. Its [materials](Self::materials), [lights](Self::lights) and
    /// [ambient light](Self::ambient) are then luminances, for listings alone.
    #[must_use]
    pub fn color(&self) -> Option<&SceneColor> {
        self.color.as_deref()
    }

    /// How one number is made of its colours, if it has any: `rec709, Y = 0.2126 R + 0.7152 G + 0.0722 B (3.10)`.
    #[must_use]
    pub fn color_label(&self) -> Option<String> {
        let space = self.color()?.space;
        Some(format!("{}, Y = {} (3.10)", crate::units::Keyword::name(space), space.luminance_text()))
    }

    /// The materials, by name.
    #[must_use]
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// The shapes, in the order of the file.
    #[must_use]
    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    /// The lights, in the order of the file: the order of every sum.
    #[must_use]
    pub fn lights(&self) -> &[Light] {
        &self.lights
    }

    /// The index of the light with this name.
    #[must_use]
    pub fn light_named(&self, name: &str) -> Option<usize> {
        self.lights.iter().position(|light| light.name == name)
    }

    /// The light from all around, if there is one.
    #[must_use]
    pub fn ambient(&self) -> Option<&Ambient> {
        self.ambient.as_ref()
    }

    /// The probes, in the order of the file.
    #[must_use]
    pub fn probes(&self) -> &[Probe] {
        &self.probes
    }

    /// The grids, in the order of the file.
    #[must_use]
    pub fn grids(&self) -> &[Grid] {
        &self.grids
    }

    /// What is allowed but deserves a word.
    #[must_use]
    pub fn warnings(&self) -> &[Problem] {
        &self.warnings
    }

    /// The scene as it was written.
    #[must_use]
    pub fn source(&self) -> &SceneSource {
        &self.source
    }
}

impl TryFrom<SceneSource> for Scene {
    type Error = SceneError;

    /// Checks a scene and converts it to metres.
    fn try_from(source: SceneSource) -> Result<Self, SceneError> {
        validate::validate(source, Problems::default(), None)
            .map_err(|problems| SceneError { name: "the scene".into(), problems })
    }
}

/// When a text has more syntax problems than this, one of them (a bracket that never closes) has caused the others.
const FOLLOWED_SYNTAX_PROBLEMS: usize = 3;

/// Opens a file that may be anything: missing, a directory, huge.
fn open(path: &FilePath, name: &str) -> Result<std::fs::File, SceneError> {
    let unreadable = |error: std::io::Error| SceneError::unreadable(name, describe(&error), None);
    let file = std::fs::File::open(path).map_err(unreadable)?;
    let metadata = file.metadata().map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(SceneError::unreadable(name, "this is a directory, not a scene file".into(), None));
    }
    if metadata.len() > limits::FILE_BYTES {
        return Err(too_large(name, &format!("{} bytes", metadata.len())));
    }
    Ok(file)
}

fn too_large(name: &str, size: &str) -> SceneError {
    let message = format!("the file has {size}; a scene file may have {}", limits::FILE_BYTES);
    SceneError::unreadable(name, message, None)
}

fn describe(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::NotFound => "there is no such file".into(),
        std::io::ErrorKind::PermissionDenied => "this file may not be read: permission denied".into(),
        _ => format!("this file cannot be read: {error}"),
    }
}
