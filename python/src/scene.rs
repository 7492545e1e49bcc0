//! Scenes: checked by the core, prepared when they are first used.

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use isophote::map::Resolution;
use isophote::prepare::PreparedScene;
use isophote::scene::library::Starter;
use isophote::scene::{Scene as CoreScene, SceneError, Syntax};
use isophote::units::Choice;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error;
use crate::render::quantities;

/// A scene that is valid.
#[pyclass(frozen, module = "isophote._isophote")]
pub struct Scene {
    scene: CoreScene,
    prepared: OnceLock<Arc<PreparedScene>>,
}

impl Scene {
    fn new(py: Python<'_>, scene: Result<CoreScene, SceneError>) -> PyResult<Self> {
        let scene = scene.map_err(|error| error::of_scene(py, &error))?;
        Ok(Self { scene, prepared: OnceLock::new() })
    }

    /// The core's scene.
    pub fn core(&self) -> &CoreScene {
        &self.scene
    }

    /// The same, ready for rendering.
    pub fn prepared(&self) -> Arc<PreparedScene> {
        Arc::clone(self.prepared.get_or_init(|| Arc::new(PreparedScene::new(&self.scene))))
    }

    /// The index of the shape with this name.
    pub fn shape_named(&self, py: Python<'_>, name: &str) -> PyResult<usize> {
        let shapes = self.scene.shapes();
        shapes.iter().position(|shape| shape.name == name).ok_or_else(|| {
            let names: Vec<&str> = shapes.iter().take(20).map(|shape| shape.name.as_str()).collect();
            error::value(py, format!("the scene has no shape \"{name}\"; there are: {}", names.join(", ")))
        })
    }
}

#[pymethods]
impl Scene {
    /// From a text that stands for the scene itself: its problems have no lines.
    #[staticmethod]
    fn from_json(py: Python<'_>, text: &str, directory: PathBuf) -> PyResult<Self> {
        let scene = CoreScene::from_text_in(&directory, "the scene", text, Syntax::Json);
        let without_place = |mut error: SceneError| {
            for problem in &mut error.problems {
                problem.place = None;
            }
            error
        };
        Self::new(py, py.detach(|| scene.map_err(without_place)))
    }

    #[staticmethod]
    fn from_text(py: Python<'_>, text: &str, is_json: bool, name: &str, directory: PathBuf) -> PyResult<Self> {
        let syntax = if is_json { Syntax::Json } else { Syntax::Toml };
        Self::new(py, py.detach(|| CoreScene::from_text_in(&directory, name, text, syntax)))
    }

    #[staticmethod]
    fn from_file(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        Self::new(py, py.detach(|| CoreScene::from_file(&path)))
    }

    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        serde_json::to_string(self.scene.source()).map_err(|error| error::internal(py, error))
    }

    /// For other processes: the scene is read again there.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String, PathBuf))> {
        let scene = slf.get();
        let again = slf.get_type().getattr("from_json")?;
        Ok((again, (scene.to_json(slf.py())?, scene.scene.source().directory.clone())))
    }

    fn to_toml(&self) -> String {
        self.scene.source().to_toml()
    }

    fn with_resolution(&self, py: Python<'_>, width: u32, height: u32) -> PyResult<Self> {
        let scene = self.scene.clone();
        Self::new(py, py.detach(|| scene.with_resolution(Resolution { width, height })))
    }

    /// Whether the scene has colours.
    #[getter]
    fn has_color(&self) -> bool {
        self.scene.color().is_some()
    }

    /// The unit of a channel.
    fn unit(&self, py: Python<'_>, channel: String) -> PyResult<&'static str> {
        let Self { scene, .. } = self;
        let quantity = &quantities(py, &[channel])?[0];
        Ok(quantity.unit(scene.convention(), scene.quantities(), scene.length()))
    }

    fn warnings<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        error::problems(py, self.scene.warnings())
    }

    /// What the scene is made of, by the names that maps and probes use.
    fn describe<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let Self { scene, .. } = self;
        let (convention, quantities) = (scene.convention(), scene.quantities());
        let description = PyDict::new(py);
        description.set_item("convention", convention.label())?;
        description.set_item("formula", convention.formula())?;
        description.set_item("brightness_unit", convention.unit(quantities))?;
        description.set_item("irradiance_unit", quantities.irradiance_unit())?;
        description.set_item("radiance_unit", quantities.radiance_unit())?;
        description.set_item("intensity_unit", quantities.intensity_unit())?;
        description.set_item("power_unit", quantities.power_unit())?;
        description.set_item("screen_unit", scene.screen_unit().name())?;
        description.set_item("shapes", scene.shapes().iter().map(|shape| shape.name.as_str()).collect::<Vec<_>>())?;
        let kinds = scene.shapes().iter().map(|shape| shape.geometry.kind());
        description.set_item("kinds", kinds.collect::<Vec<_>>())?;
        let lights = scene.lights().iter().map(|light| light.name.as_str());
        description.set_item("lights", lights.collect::<Vec<_>>())?;
        description.set_item("grids", scene.grids().iter().map(|grid| grid.name.as_str()).collect::<Vec<_>>())?;
        let probes: Vec<_> = scene.probes().iter().map(|probe| probe.name.as_str()).collect();
        description.set_item("probes", probes)?;
        description.set_item("is_sampled", scene.sampling().is_more_than_centres())?;
        let resolution = scene.camera().resolution;
        description.set_item("resolution", (resolution.width, resolution.height))?;
        Ok(description)
    }
}

/// The text of a scene to start from.
#[pyfunction]
pub fn starter(py: Python<'_>, name: &str) -> PyResult<&'static str> {
    Ok(Starter::from_name(name).ok_or_else(|| error::value(py, format!("there is no scene \"{name}\"")))?.text())
}
