//! The reference: one pixel after the other, in double precision.

use super::sampling::Renders;
use super::{RenderError, RenderSettings, Renderer, band, color, sampling};
use crate::lanes::Precision;
use crate::map::Map;
use crate::prepare::PreparedScene;

/// The renderer that every other one is held to: scalar, single-threaded, obviously right.
#[derive(Clone, Copy, Debug, Default)]
pub struct ReferenceRenderer;

impl Renderer for ReferenceRenderer {
    fn name(&self) -> String {
        "double precision, reference".into()
    }

    fn render(&self, scene: &PreparedScene, settings: &RenderSettings<'_>) -> Result<Map, RenderError> {
        color::render(scene, settings, |scene, settings| {
            if scene.scene().sampling().is_multisampled() {
                let centres =
                    |_: Vec<_>, scene: &PreparedScene, settings: &RenderSettings<'_>| self.centres(scene, settings);
                sampling::render(scene, settings, None, &Renders { parallel: &centres, serial: &centres })
            } else {
                self.centres(scene, settings)
            }
        })
    }
}

impl ReferenceRenderer {
    fn centres(self, scene: &PreparedScene, settings: &RenderSettings<'_>) -> Result<Map, RenderError> {
        let mut map = band::empty_map(scene, settings, self.name(), Precision::Double, Vec::new())?;
        let mut runs = Vec::new();
        let rows = map.region.size.height;
        for mut band in band::split(&mut map, scene, rows) {
            runs.extend(band.render(scene, settings.observer)?);
        }
        band::finish(&mut map, runs);
        Ok(map)
    }
}
