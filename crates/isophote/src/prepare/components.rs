//! A scene with colours as three scenes of single numbers.

use std::sync::Arc;

use super::PreparedScene;
use crate::color::{ColorSpace, Component, Rgb};
use crate::light::Emitters;
use crate::scene::Lighting;
use crate::scene::Scene;

/// The components of a scene with colours, each a scene of single numbers. They share the geometry and its tree.
#[derive(Clone, Debug)]
pub struct Components {
    /// The colour space whose primaries they are amounts of.
    pub space: ColorSpace,
    scenes: Arc<Rgb<PreparedScene>>,
}

impl Components {
    /// The scene of a component. Its source text is that of the scene with colours.
    #[must_use]
    pub fn of(&self, component: Component) -> &PreparedScene {
        self.scenes.of(component)
    }

    /// All three.
    #[must_use]
    pub fn scenes(&self) -> &Rgb<PreparedScene> {
        &self.scenes
    }

    /// The same components after a change of view.
    pub(super) fn map(&self, change: impl FnMut(&PreparedScene) -> PreparedScene) -> Self {
        Self { space: self.space, scenes: Arc::new(self.scenes.map(change)) }
    }
}

impl PreparedScene {
    /// The components of a scene with colours. Only they may be shaded: the scene's own materials and lights are luminances,
    /// and the luminance of a product is not the product of the luminances.
    #[must_use]
    pub fn components(&self) -> Option<&Components> {
        self.components.as_ref()
    }

    /// The scenes that are shaded to get the brightness: the components of a scene with colours, otherwise the scene itself.
    /// The visible surfaces are the same in all of them.
    #[must_use]
    pub fn layers(&self) -> Vec<&Self> {
        match self.components() {
            None => vec![self],
            Some(components) => {
                let Rgb { red, green, blue } = components.scenes();
                vec![red, green, blue]
            }
        }
    }

    pub(super) fn split_into_components(&self) -> Option<Components> {
        let color = self.scene.color()?;
        let scenes = color.lighting.map(|lighting| self.lit_by(lighting));
        Some(Components { space: color.space, scenes: Arc::new(scenes) })
    }

    fn lit_by(&self, lighting: &Lighting) -> Self {
        let Lighting { materials, lights, ambient } = lighting.clone();
        let scene = Scene { materials, lights, ambient, color: None, ..Scene::clone(&self.scene) };
        Self {
            emitters: Emitters::of(&scene.lights),
            formulas: super::formulas(&scene),
            components: None,
            scene: Arc::new(scene),
            ..self.clone()
        }
    }

    /// Guards against a silent error: a scene with colours must be shaded by its components.
    #[inline(always)]
    pub(super) fn expect_single_numbers(&self) {
        debug_assert!(self.components.is_none(), "a scene with colours is shaded by its components");
    }
}
