//! Scenes: read once, checked once, valid from then on.

mod change;
mod color;
pub mod document;
pub mod error;
mod files;
mod filter;
pub mod library;
pub mod limits;
mod load;
mod parts;
mod problems;
mod sampling;
pub mod source;
mod source_files;
mod table;
mod validate;

pub use change::PartPlace;
pub use color::{Lighting, SceneColor};
pub use document::Syntax;
pub use error::{Problem, ProblemKind, SceneError, TextPosition};
pub use files::FileResolver;
pub use filter::Filter;
pub use parts::{Area, AreaOutline, AreaPlace, Grid, Material, Probe, Shape};
pub use sampling::Sampling;
pub use source::SceneSource;
pub use source_files::CarriedFiles;

pub use crate::import::{MemoryFiles, NoFiles, Origin, PART_BYTES, ReadFailure, Resolver};

use crate::camera::Camera;
use crate::light::{Ambient, Light};
use crate::map::SourceFile;
use crate::reflectance::Convention;
use crate::shape::Primitive;
use crate::units::{LengthUnit, ScreenUnit, UnitSystem};

/// A scene that is valid by construction. Lengths in metres.
#[derive(Clone, Debug)]
pub struct Scene {
    /// A line that describes the scene; may be empty.
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
    /// For a scene with colours: the materials and lights above then hold luminances, which must not be used for shading.
    pub(crate) color: Option<Box<SceneColor>>,
    pub(crate) probes: Vec<Probe>,
    pub(crate) areas: Vec<Area>,
    pub(crate) grids: Vec<Grid>,
    pub(crate) warnings: Vec<Problem>,
    pub(crate) files: Vec<SourceFile>,
    pub(crate) source: SceneSource,
}

impl Scene {
    /// A line that describes the scene; may be empty.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The unit of lengths in the scene file and in everything made from it.
    #[must_use]
    pub fn length(&self) -> LengthUnit {
        self.length
    }

    /// The unit of coordinates on the camera's screen.
    #[must_use]
    pub fn screen_unit(&self) -> ScreenUnit {
        ScreenUnit::of(self.length, self.camera.projection.is_angular())
    }

    /// Which formula gives the brightness.
    #[must_use]
    pub fn convention(&self) -> Convention {
        self.convention
    }

    /// How many rays are averaged for a pixel's value.
    #[must_use]
    pub fn sampling(&self) -> Sampling {
        self.sampling
    }

    /// Whether shapes block each other's light.
    #[must_use]
    pub fn shadows(&self) -> bool {
        self.shadows
    }

    /// Whether other shapes may block a light from a shape.
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

    /// The index of a primitive's material; `None` only in the `irradiance` convention.
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

    /// The camera.
    #[must_use]
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The parts that the scene has three of, if it has colours. Its [materials](Self::materials), [lights](Self::lights)
    /// and [ambient light](Self::ambient) are then luminances, only for listings.
    #[must_use]
    pub fn color(&self) -> Option<&SceneColor> {
        self.color.as_deref()
    }

    /// How its colours are combined to one number, if it has any: `rec709, Y = 0.2126 R + 0.7152 G + 0.0722 B (3.10)`.
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

    /// The lights, in the order of the file, which is the order of every sum.
    #[must_use]
    pub fn lights(&self) -> &[Light] {
        &self.lights
    }

    /// The index of the light with this name.
    #[must_use]
    pub fn light_named(&self, name: &str) -> Option<usize> {
        self.lights.iter().position(|light| light.name == name)
    }

    /// The ambient light, if there is any.
    #[must_use]
    pub fn ambient(&self) -> Option<&Ambient> {
        self.ambient.as_ref()
    }

    /// The probes, in the order of the file.
    #[must_use]
    pub fn probes(&self) -> &[Probe] {
        &self.probes
    }

    /// The areas of interest, in the order of the file.
    #[must_use]
    pub fn areas(&self) -> &[Area] {
        &self.areas
    }

    /// The grids, in the order of the file.
    #[must_use]
    pub fn grids(&self) -> &[Grid] {
        &self.grids
    }

    /// Warnings: allowed, but worth mentioning.
    #[must_use]
    pub fn warnings(&self) -> &[Problem] {
        &self.warnings
    }

    /// The files that it names, as they were read.
    #[must_use]
    pub fn files(&self) -> &[SourceFile] {
        &self.files
    }

    /// The scene as it was written.
    #[must_use]
    pub fn source(&self) -> &SceneSource {
        &self.source
    }
}
