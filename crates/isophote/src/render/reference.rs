//! The reference: one pixel after the other, in double precision.

use super::{RenderError, RenderSettings, Renderer, rows};
use crate::map::{Map, Mask};
use crate::prepare::PreparedScene;

/// The renderer that every other one is held to: scalar, single-threaded, obviously right.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reference;

impl Renderer for Reference {
    fn name(&self) -> String {
        "double precision, reference".into()
    }

    fn render(&self, scene: &PreparedScene, settings: &RenderSettings<'_>) -> Result<Map, RenderError> {
        let mut map = rows::empty_map(scene, settings, self.name())?;
        let mut runs = Vec::new();
        for mut row in rows::split(&mut map, scene) {
            runs.extend(row.render(scene, settings.observer)?);
        }
        map.mask = Mask::new(map.region.size, runs);
        Ok(map)
    }
}
