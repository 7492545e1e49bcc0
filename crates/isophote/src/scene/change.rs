//! Makes valid scenes from valid scenes.

use super::problems::Problems;
use super::source::{GridSource, SamplingSource};
use super::{Scene, SceneError, SceneSource, validate};
use crate::import::NoFiles;
use crate::map::Resolution;

impl Scene {
    /// The scene with another resolution.
    ///
    /// # Errors
    /// A resolution out of the [`limits`](super::limits).
    pub fn with_resolution(&self, resolution: Resolution) -> Result<Self, SceneError> {
        self.changed(|source| {
            source.camera.get_or_insert_default().resolution =
                Some([u64::from(resolution.width), u64::from(resolution.height)]);
        })
    }

    /// The scene with these values in place of its own sampling.
    ///
    /// # Errors
    /// Numbers out of the [`limits`](super::limits).
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
    /// Anything that is wrong with the grid.
    pub fn with_grid(&self, grid: GridSource) -> Result<Self, SceneError> {
        self.changed(|source| source.grid = vec![grid])
    }

    /// The scene with one of its lights alone, and without ambient light.
    ///
    /// # Errors
    /// None: a part of a valid scene is valid.
    pub(crate) fn with_one_light(&self, light: usize) -> Result<Self, SceneError> {
        self.changed(|source| {
            source.light = vec![source.light.swap_remove(light)];
            source.ambient = None;
        })
    }

    /// The scene after a change of its source that does not concern its files: none is read again.
    fn changed(&self, change: impl FnOnce(&mut SceneSource)) -> Result<Self, SceneError> {
        let mut source = self.source.clone();
        change(&mut source);
        let name = "the scene".into();
        validate::validate(source, &NoFiles, Problems::default(), Some(self))
            .map_err(|problems| SceneError { name, problems })
    }
}
