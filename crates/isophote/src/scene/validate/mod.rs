//! From a scene as written to a valid scene: every check, once.

mod areas;
mod camera;
mod color;
mod files;
mod grids;
mod lights;
mod materials;
mod names;
mod numbers;
mod places;
mod probes;
mod projection;
mod shapes;

use crate::message;
use crate::text::Message;
use std::collections::{HashMap, HashSet};

use self::color::ComponentSelector;
use super::document::Path;
use super::error::{Problem, ProblemKind};
use super::problems::{Problems, short};
use super::source::SceneSource;
use super::source_files::NotedFiles;
use super::{Scene, Shape, limits};
use crate::camera::{Camera, Extent, Projection};
use crate::import::Resolver;
use crate::reflectance::Convention;
use crate::scene::Sampling;
use crate::units::{Keyword, LengthUnit, ScreenUnit, UnitSystem};

/// Checks a scene, given the problems that are already known. Files that an earlier scene has read in the same way are not
/// read again.
pub(super) fn validate(
    source: SceneSource,
    files: &dyn Resolver,
    problems: Problems,
    earlier: Option<&Scene>,
) -> Result<Scene, Vec<Problem>> {
    let mut validator = Validator {
        kept: earlier.map(|earlier| files::GeometryCache::of(earlier, &source)).unwrap_or_default(),
        length: source.length.unwrap_or(LengthUnit::Metre),
        convention: source.convention.unwrap_or(Convention::Radiance),
        shadows: source.shadows.unwrap_or(false),
        collapse: ComponentSelector::Luminance(source.color_space.unwrap_or_default()),
        files: NotedFiles::new(files),
        materials: source.material.keys().cloned().zip(0..).collect(),
        suggested: 0,
        problems,
        warnings: Problems::default(),
    };
    validator.head(&source);
    let camera = validator.camera(&source);
    let sampling = validator.sampling(&source);
    let materials = validator.materials(&source);
    let shapes = validator.shapes(&source);
    let lights = validator.lights(&source);
    let ambient = validator.ambient(&source);
    let probes = validator.probes(&source);
    let areas = validator.areas(&source, camera.as_ref(), &shapes);
    let grids = validator.grids(&source);
    validator.eye_against_shapes(camera.as_ref(), &shapes);
    let tree = Validator::tree_of(&shapes);
    validator.lights_against_shapes(camera.as_ref(), &lights, &shapes, &tree);
    validator.probes_against_shapes(&probes, &shapes, &tree);
    validator.words_of_advice(&source, camera.as_ref(), &shapes);
    let color = validator.color(&source);
    let Validator { length, convention, shadows, files, problems, warnings, .. } = validator;
    match camera {
        Some(camera) if problems.is_empty() => Ok(Scene {
            title: source.title.clone().unwrap_or_default(),
            length,
            convention,
            sampling,
            shadows,
            unit_system: source.quantities.unwrap_or(UnitSystem::Radiometric),
            camera,
            materials: materials.into_iter().flatten().collect(),
            shapes: shapes.into_iter().flatten().collect(),
            lights: lights.into_iter().flatten().collect(),
            ambient,
            color: color.map(Box::new),
            probes: probes.into_iter().flatten().collect(),
            areas: areas.into_iter().flatten().collect(),
            grids: grids.into_iter().flatten().collect(),
            warnings: warnings.into_list(),
            files: files.into_list(),
            source,
        }),
        _ => Err(problems.into_list()),
    }
}

/// Lists keep the positions of invalid items as `None`, so that indices match the file.
type Checked<T> = Vec<Option<T>>;

struct Validator<'f> {
    length: LengthUnit,
    convention: Convention,
    shadows: bool,
    /// How three numbers become one.
    collapse: ComponentSelector,
    /// The files that the scene names.
    files: NotedFiles<'f>,
    /// The index of each material by its name.
    materials: HashMap<String, usize>,
    /// How many suggestions for misspelt materials were looked for.
    suggested: usize,
    /// What need not be read again.
    kept: files::GeometryCache,
    problems: Problems,
    warnings: Problems,
}

impl Validator<'_> {
    fn head(&mut self, source: &SceneSource) {
        let root = Path::root();
        match source.version {
            None => self.problems.missing(&root, "version", message!("write `version = 1` on top")),
            Some(1) => {}
            Some(version) => {
                self.wrong(&root.key("version"), message!("`version` is {version}", version), message!("allowed: 1"));
            }
        }
        if let Some(title) = source.title.as_ref().filter(|title| title.len() > limits::TITLE_BYTES) {
            let help = message!("allowed: up to {most}", most = limits::TITLE_BYTES);
            self.wrong(&root.key("title"), message!("`title` has {bytes} bytes", bytes = title.len()), help);
        }
        if source.length.is_none() {
            let help = message!("write `length = \"m\"`, \"cm\" or \"mm\": the unit of every length in the scene");
            self.problems.missing(&root, "length", help);
        }
    }

    /// Returns defaults in place of wrong values, which have been reported by then.
    fn sampling(&mut self, source: &SceneSource) -> Sampling {
        let Some(written) = &source.sampling else { return Sampling::default() };
        let path = Path::root().key("sampling");
        if let Some(tolerance) = written.tolerance.filter(|tolerance| !limits::TOLERANCE.contains(tolerance)) {
            let help = message!(
                "allowed: {least} to {most}",
                least = limits::TOLERANCE.start(),
                most = limits::TOLERANCE.end()
            );
            self.wrong(&path.key("tolerance"), message!("`sampling.tolerance` is {tolerance}", tolerance), help);
        }
        let default = if written.tolerance.is_some() { Sampling::MOST } else { 1 };
        let samples = written.samples.map_or(Some(default), |samples| self.samples(&path, samples));
        Sampling {
            samples: samples.unwrap_or(default),
            tolerance: written.tolerance,
            filter: written.filter.unwrap_or_default(),
        }
    }

    /// Checks the key `samples` of a table.
    fn samples(&mut self, table: &Path, written: u64) -> Option<u32> {
        let samples = u32::try_from(written).ok().filter(|samples| (1..=limits::SAMPLES).contains(samples));
        if samples.is_none() {
            let help = message!("allowed: 1 to {most}", most = limits::SAMPLES);
            self.wrong(&table.key("samples"), message!("`{table}.samples` is {written}", table, written), help);
        }
        samples
    }

    fn words_of_advice(&mut self, source: &SceneSource, camera: Option<&Camera>, shapes: &Checked<Shape>) {
        let root = Path::root();
        let count = shapes::count(source);
        if count == 0 && source.grid.is_empty() {
            let help = message!("write a table [[sphere]], [[box]] or of another shape");
            self.warn(&root.key("sphere"), message!("the scene has no shapes"), help);
        }
        if source.light.is_empty() && source.ambient.is_none() {
            self.warn(
                &root.key("light"),
                message!("the scene has no lights: all is black"),
                message!("write a table [[light]]"),
            );
        }
        if count > 1 && !source.light.is_empty() && source.shadows.is_none() {
            let message = message!("the shapes cast no shadows on each other: each is lit as if it were alone");
            self.warn(
                &root.key("shadows"),
                message,
                message!("write `shadows = true`, or `shadows = false` if that is meant"),
            );
        }
        let used: HashSet<&str> = shapes::materials_in_use(source).collect();
        let mut of_parts = vec![false; source.material.len()];
        for material in shapes.iter().flatten().flat_map(|shape| shape.geometry.materials_of_parts()) {
            of_parts[material] = true;
        }
        for (index, name) in source.material.keys().enumerate() {
            if !used.contains(name.as_str()) && !of_parts[index] {
                let message = message!("no shape is made of the material \"{name}\"", name = short(name));
                self.warn(&root.key("material").key(name.clone()), message, message!("leave it out, or use it"));
            }
        }
        // The pixels of a calibrated camera are as they are.
        let is_calibrated = source.camera.as_ref().is_some_and(|camera| camera.intrinsics.is_some());
        if let Some(camera) = camera.filter(|_| !is_calibrated) {
            self.square_pixels(camera);
        }
    }

    fn square_pixels(&mut self, camera: &Camera) {
        let Camera { projection, resolution, .. } = camera;
        let Extent { x, y } = projection.extent(*resolution);
        let width = (x[1] - x[0]) / f64::from(resolution.width);
        let height = (y[1] - y[0]) / f64::from(resolution.height);
        if (width / height - 1.0).abs() > 1e-9 {
            let unit = ScreenUnit::of(self.length, projection.is_angular());
            let [width, height] = [width, height].map(|side| {
                let separator = if unit == ScreenUnit::Degree { "" } else { " " };
                format!("{}{separator}{}", rounded(unit.from_internal(side)), unit.name())
            });
            let message = message!("pixels are not square: {width} wide, {height} high", width, height);
            let edges = match projection {
                Projection::Perspective(_) | Projection::Fisheye(_) => Message::verbatim("`screen`"),
                Projection::Orthographic(_) => Message::verbatim("`window`"),
                Projection::Panorama(_) => message!("`longitude` and `latitude`"),
            };
            let help = message!("pictures look stretched; give `resolution` the proportions of {edges}", edges);
            self.warn(&Path::root().key("camera").key("resolution"), message, help);
        }
    }

    fn few_enough(&mut self, key: &'static str, count: usize, limit: usize) -> bool {
        if count > limit {
            let path = Path::root().key(key).index(limit);
            self.wrong(
                &path,
                message!("the scene has {count} tables [[{key}]]", count, key),
                message!("allowed: at most {most}", most = limit),
            );
        }
        count <= limit
    }

    fn wrong(&mut self, path: &Path, message: Message, help: Message) {
        self.problems.push(ProblemKind::Value, path, message, help);
    }

    fn warn(&mut self, path: &Path, message: Message, help: Message) {
        self.warnings.push(ProblemKind::Warning, path, message, help);
    }

    fn unit(&self) -> &'static str {
        self.length.name()
    }

    fn length_text(&self, metres: f64) -> String {
        format!("{} {}", rounded(self.length.from_metres(metres)), self.unit())
    }
}

/// Help on a key that belongs to these words of another key.
fn leave_out_or_write<C: Keyword>(key: &str, words: &[C]) -> Message {
    let written = |word: &C| Message::verbatim(format!("`{key} = \"{}\"`", word.name()));
    let all = words.iter().map(written).reduce(|first, second| message!("{first} or {second}", first, second));
    message!("leave it out, or write {all}", all = all.unwrap_or_else(Message::empty))
}

/// A number with a few digits, for messages.
fn rounded(value: f64) -> String {
    let text = format!("{value:.5e}").parse::<f64>().unwrap_or(value);
    format!("{text}")
}
