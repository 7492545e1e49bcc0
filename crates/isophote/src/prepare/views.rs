//! The same scene with another view or another search method.

use std::sync::{Arc, OnceLock};

use super::PreparedScene;
use crate::camera::CameraFrame;
use crate::map::Resolution;

impl PreparedScene {
    /// The same scene without a tree: every ray tries every primitive. The tree is checked against this.
    #[must_use]
    pub fn by_brute_force(self) -> Self {
        let components = self.components.as_ref().map(|components| components.map(|one| one.clone().by_brute_force()));
        Self { linear_search_max: u32::MAX, components, ..self }
    }

    /// The same scene seen with another number of pixels.
    #[must_use]
    pub fn at_resolution(&self, resolution: Resolution) -> Self {
        self.with_view(&|other| {
            Arc::make_mut(&mut other.scene).camera.resolution = resolution;
            other.frame = CameraFrame::new(&other.scene.camera);
            other.precise_frame = CameraFrame::new(&other.scene.camera);
        })
    }

    /// The same scene with rays through another place in the pixels than their centres, given as fractions of their width
    /// and height.
    pub(crate) fn seen_through(&self, place: [f64; 2]) -> Self {
        self.with_view(&|other| {
            other.frame.place = place;
            other.precise_frame.place = place;
        })
    }

    /// The same scene after a change of view, which applies to its components too.
    fn with_view(&self, change: &dyn Fn(&mut Self)) -> Self {
        let mut other = self.clone();
        change(&mut other);
        for shape in &mut other.shapes {
            shape.outline = OnceLock::new();
        }
        other.components = self.components.as_ref().map(|components| components.map(|one| one.with_view(change)));
        other
    }

    /// The same scene with each light as two emitters of half its strength.
    #[cfg(test)]
    pub(crate) fn with_emitters_halved(self) -> Self {
        Self { emitters: self.emitters.halved(), ..self }
    }
}
