//! The reference renderer: one pixel after another, in double precision.

use super::band::{self, Sheet};
use super::sampling::Renders;
use super::{RenderError, RenderSettings, Renderer, derived, layers, rays, sampling};
use crate::lanes::Precision;
use crate::map::{Map, Values};
use crate::prepare::PreparedScene;
use crate::threads::Threads;

/// The renderer that every other one is checked against: scalar, single-threaded, obviously right.
#[derive(Clone, Copy, Debug, Default)]
pub struct ReferenceRenderer;

impl Renderer for ReferenceRenderer {
    fn name(&self) -> String {
        "double precision, reference".into()
    }

    fn render(&self, scene: &PreparedScene, settings: &RenderSettings<'_>) -> Result<Map, RenderError> {
        derived::render(scene, settings, |scene, settings| self.render_computed(scene, settings))
    }
}

impl ReferenceRenderer {
    fn render_computed(self, scene: &PreparedScene, settings: &RenderSettings<'_>) -> Result<Map, RenderError> {
        let centres =
            |memory, scene: &PreparedScene, settings: &RenderSettings<'_>| self.centres(memory, scene, settings);
        let layers = if scene.scene().sampling().is_multisampled() {
            let renders = Renders { parallel: &centres, serial: &centres, instructions: None };
            sampling::render(scene, settings, &Threads::single(), &renders)?
        } else {
            self.centres(Vec::new(), scene, settings)?
        };
        Ok(layers::combined(scene, &settings.quantities, layers))
    }

    fn centres(
        self,
        memory: Vec<Values>,
        scene: &PreparedScene,
        settings: &RenderSettings<'_>,
    ) -> Result<Vec<Map>, RenderError> {
        let sheet = Sheet::of_camera(scene, settings, self.name())?;
        let mut layers = band::empty_layers(scene, &sheet, &settings.quantities, Precision::Double, memory)?;
        let asked_for = band::asked_for(&layers[0], scene);
        let rows = layers[0].region.size.height;
        let mut runs = Vec::new();
        for mut band in band::split(&mut layers, rows) {
            runs.extend(rays::fill(&mut band, scene, &asked_for, settings.observer)?);
        }
        band::finish(&mut layers, runs);
        Ok(layers)
    }
}
