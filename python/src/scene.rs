//! Scenes: checked by the core, prepared on first use.

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use isophote::camera::Extent;
use isophote::map::Resolution;
use isophote::prepare::PreparedScene;
use isophote::scene::library::Starter;
use isophote::scene::{CarriedFiles, FileResolver, PartPlace, Scene as CoreScene, SceneError, Syntax};
use isophote_export::FileMetadata;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error;
use crate::job::{self, Progress};
use crate::names::{keyword, quantities};
use crate::threads::threads;

/// A valid scene.
#[pyclass(frozen, module = "isophote._isophote")]
pub struct Scene {
    content: Arc<Content>,
}

/// What a scene and its jobs share.
pub struct Content {
    scene: CoreScene,
    prepared: OnceLock<Arc<PreparedScene>>,
    /// The scene that this one was derived from: its files were not read again, and the two may share a tree.
    origin: Option<Arc<Content>>,
}

impl Content {
    /// The core's scene.
    pub fn scene(&self) -> &CoreScene {
        &self.scene
    }

    /// The scene, ready for rendering. The first call may take long, so it belongs in a job.
    pub fn prepared(&self) -> Arc<PreparedScene> {
        let prepare = || {
            Arc::new(match &self.origin {
                Some(origin) if PreparedScene::builds_tree(&self.scene) => {
                    PreparedScene::reusing(&origin.prepared(), &self.scene)
                }
                _ => PreparedScene::on_threads(&self.scene, &threads()),
            })
        };
        Arc::clone(self.prepared.get_or_init(prepare))
    }

    /// The prepared scene, if it already exists or takes no time to prepare.
    pub fn prepared_at_once(&self) -> Option<Arc<PreparedScene>> {
        (self.prepared.get().is_some() || !PreparedScene::builds_tree(&self.scene)).then(|| self.prepared())
    }
}

impl Scene {
    fn new(py: Python<'_>, scene: Result<CoreScene, SceneError>, origin: Option<&Arc<Content>>) -> PyResult<Self> {
        let scene = scene.map_err(|error| error::of_scene(py, &error))?;
        // Keep only the first in a chain of derived scenes: it has the files.
        let origin = origin.map(|origin| Arc::clone(origin.origin.as_ref().unwrap_or(origin)));
        Ok(Self { content: Arc::new(Content { scene, prepared: OnceLock::new(), origin }) })
    }

    /// Reads a scene: as a long-running job if it names files.
    fn read(
        py: Python<'_>,
        names_files: bool,
        read: impl FnOnce() -> Result<CoreScene, SceneError> + Send + 'static,
    ) -> PyResult<Result<CoreScene, SceneError>> {
        if names_files {
            job::run(py, &Progress::none(), move |_| read())
        } else {
            job::run_here(py, &Progress::none(), read)
        }
    }

    /// The core's scene.
    pub fn core(&self) -> &CoreScene {
        &self.content.scene
    }

    /// What jobs take with them.
    pub fn content(&self) -> Arc<Content> {
        Arc::clone(&self.content)
    }

    /// The index of the shape with this name.
    pub fn shape_named(&self, py: Python<'_>, name: &str) -> PyResult<usize> {
        let shapes = self.core().shapes();
        shapes.iter().position(|shape| shape.name == name).ok_or_else(|| {
            let names: Vec<&str> = shapes.iter().take(20).map(|shape| shape.name.as_str()).collect();
            error::value(py, format!("the scene has no shape \"{name}\"; there are: {}", names.join(", ")))
        })
    }
}

#[pymethods]
impl Scene {
    /// Reads a scene from text generated for it, so problems have no line numbers. Files that an earlier scene has read
    /// are not read again.
    #[staticmethod]
    #[pyo3(signature = (text, directory, earlier=None))]
    fn from_json(py: Python<'_>, text: String, directory: PathBuf, earlier: Option<Bound<'_, Self>>) -> PyResult<Self> {
        let origin = earlier.map(|earlier| earlier.get().content());
        let names_files = text.contains("\"file\"");
        let before = origin.clone();
        let scene = Self::read(py, names_files, move || {
            let earlier = before.as_ref().map(|before| &before.scene);
            CoreScene::from_text_with(&FileResolver::new(directory), earlier, "the scene", &text, Syntax::Json)
        })?;
        let scene = scene.map_err(|mut error| {
            for problem in &mut error.problems {
                problem.place = None;
            }
            error
        });
        Self::new(py, scene, origin.as_ref())
    }

    #[staticmethod]
    fn from_text(py: Python<'_>, text: String, is_json: bool, name: String, directory: PathBuf) -> PyResult<Self> {
        let syntax = if is_json { Syntax::Json } else { Syntax::Toml };
        let names_files = text.contains("file");
        let scene = Self::read(py, names_files, move || CoreScene::from_text_in(&directory, &name, &text, syntax))?;
        Self::new(py, scene, None)
    }

    /// The scene in an output, whose description is given as JSON, with the files that it was made of.
    #[staticmethod]
    fn from_output(py: Python<'_>, metadata: &str, path: PathBuf, name: String) -> PyResult<Self> {
        let metadata: FileMetadata = serde_json::from_str(metadata).map_err(|error| error::internal(py, error))?;
        let scene = Self::read(py, !metadata.files.is_empty(), move || {
            let files = CarriedFiles::of_output(&path, &metadata.files);
            CoreScene::from_text_with(&files, None, &name, &metadata.scene, Syntax::Toml)
        })?;
        Self::new(py, scene, None)
    }

    /// The base directory of the file names in the scene.
    #[getter]
    fn directory(&self) -> PathBuf {
        self.core().source().origin.directory().map_or(PathBuf::new(), PathBuf::from)
    }

    #[staticmethod]
    fn from_file(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        Self::new(py, Self::read(py, true, move || CoreScene::from_file(&path))?, None)
    }

    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        serde_json::to_string(self.core().source()).map_err(|error| error::internal(py, error))
    }

    /// For other processes, which read the scene again.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String, PathBuf))> {
        let scene = slf.get();
        let again = slf.get_type().getattr("from_json")?;
        Ok((again, (scene.to_json(slf.py())?, scene.directory())))
    }

    fn to_toml(&self) -> String {
        self.core().source().to_toml()
    }

    fn with_resolution(&self, py: Python<'_>, width: u32, height: u32) -> PyResult<Self> {
        Self::new(py, self.core().with_resolution(Resolution { width, height }), Some(&self.content))
    }

    /// The scene with parts written anew: the key of a table, the number of an item of a list or the name of a material, and
    /// the part as JSON, or nothing where it is left out.
    fn with_parts(&self, py: Python<'_>, parts: Vec<WrittenPart>) -> PyResult<Self> {
        let scene = job::run_here(py, &Progress::none(), || {
            let places: Vec<_> =
                parts.iter().map(|(key, item, text)| (place(key, item.as_ref()), text.as_deref())).collect();
            self.core().with_parts(&places)
        })?;
        Self::new(py, scene, Some(&self.content))
    }

    /// The items of a list whose name is this text, or its beginning up to a dot: their numbers and names, the longest first.
    fn named(&self, py: Python<'_>, list: &str, text: &str) -> PyResult<Vec<(usize, String)>> {
        let scene = self.core();
        let is_meant =
            |name: &str| text.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
        let mut found: Vec<(usize, String)> = match list {
            "shapes" => meant(scene.shapes().iter().map(|shape| &shape.name), is_meant),
            "lights" => meant(scene.lights().iter().map(|light| &light.name), is_meant),
            "probes" => meant(scene.probes().iter().map(|probe| &probe.name), is_meant),
            "areas" => meant(scene.areas().iter().map(|area| &area.name), is_meant),
            "grids" => meant(scene.grids().iter().map(|grid| &grid.name), is_meant),
            _ => return Err(error::internal(py, format!("a scene has no {list}"))),
        };
        found.sort_by_key(|(_, name)| std::cmp::Reverse(name.len()));
        Ok(found)
    }

    /// Whether the scene has colours.
    #[getter]
    fn has_color(&self) -> bool {
        self.core().color().is_some()
    }

    /// The unit of a channel.
    fn unit(&self, py: Python<'_>, channel: String) -> PyResult<&'static str> {
        let scene = self.core();
        let quantity = &quantities(py, &[channel])?[0];
        Ok(quantity.unit(scene.convention(), scene.unit_system(), scene.length()))
    }

    fn warnings<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        error::problems(py, self.core().warnings())
    }

    /// The contents of the scene, by the names that maps and probes use.
    fn describe<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let scene = self.core();
        let (convention, units) = (scene.convention(), scene.unit_system());
        let description = PyDict::new(py);
        description.set_item("convention", convention.label())?;
        description.set_item("brightness_unit", convention.unit(units))?;
        description.set_item("irradiance_unit", units.irradiance_unit())?;
        description.set_item("radiance_unit", units.radiance_unit())?;
        description.set_item("intensity_unit", units.intensity_unit())?;
        description.set_item("power_unit", units.power_unit())?;
        description.set_item("screen_unit", scene.screen_unit().name())?;
        description.set_item("shapes", scene.shapes().iter().map(|shape| shape.name.as_str()).collect::<Vec<_>>())?;
        let lights = scene.lights().iter().map(|light| light.name.as_str());
        description.set_item("lights", lights.collect::<Vec<_>>())?;
        description.set_item("grids", scene.grids().iter().map(|grid| grid.name.as_str()).collect::<Vec<_>>())?;
        description.set_item("areas", scene.areas().iter().map(|area| area.name.as_str()).collect::<Vec<_>>())?;
        let probes: Vec<_> = scene.probes().iter().map(|probe| probe.name.as_str()).collect();
        description.set_item("probes", probes)?;
        description.set_item("is_sampled", scene.sampling().is_multisampled())?;
        let resolution = scene.camera().resolution;
        let Extent { x, y } = scene.camera().projection.extent(resolution);
        let [x, y] = [x, y].map(|edges| edges.map(|edge| scene.screen_unit().from_internal(edge)));
        description.set_item("extent", (x, y))?;
        description.set_item("resolution", (resolution.width, resolution.height))?;
        Ok(description)
    }
}

/// The key of a table, which of its items, and what is written there.
type WrittenPart = (String, Option<Item>, Option<String>);

/// An item of a list by its number, or a material by its name.
#[derive(FromPyObject)]
enum Item {
    Number(usize),
    Name(String),
}

fn place<'p>(key: &'p str, item: Option<&'p Item>) -> PartPlace<'p> {
    match item {
        None => PartPlace::Top(key),
        Some(Item::Number(number)) => PartPlace::Item(key, *number),
        Some(Item::Name(name)) => PartPlace::Material(name),
    }
}

fn meant<'n>(names: impl Iterator<Item = &'n String>, is_meant: impl Fn(&str) -> bool) -> Vec<(usize, String)> {
    names.enumerate().filter(|(_, name)| is_meant(name)).map(|(number, name)| (number, name.clone())).collect()
}

/// The text of a starter scene.
#[pyfunction]
pub fn starter(py: Python<'_>, name: &str) -> PyResult<&'static str> {
    Ok(keyword::<Starter>(py, "scene", name)?.text())
}
