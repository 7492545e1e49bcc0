//! Makes valid scenes from valid scenes.

use super::document::{Document, Path};
use super::error::ProblemKind;
use super::problems::Problems;
use super::source::{GridSource, SamplingSource};
use super::{Scene, SceneError, SceneSource, Syntax, validate};
use crate::import::NoFiles;
use crate::map::Resolution;
use crate::message;

/// The place of a part in a scene file that [`Scene::with_parts`] writes anew.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PartPlace<'p> {
    /// A value on top, or a table of which there is one: `title`, `camera`.
    Top(&'p str),
    /// An item of a list: `light`, counted from 0.
    Item(&'p str, usize),
    /// The material of this name.
    Material(&'p str),
}

impl Scene {
    /// The scene with parts written anew, each as JSON; `None` leaves out a value or a material. What stays is not read again,
    /// and no file is: apart from the parts, only names and places are checked, a microsecond or two for each item.
    ///
    /// # Errors
    /// Every problem of the parts and of the scene with them, a place that no scene or this one does not have, or a part that
    /// names a file which this scene has not read.
    pub fn with_parts(&self, parts: &[(PartPlace<'_>, Option<&str>)]) -> Result<Self, SceneError> {
        let mut source = self.source.clone();
        let mut problems = Problems::default();
        for (place, text) in parts {
            if put(&mut source, *place, *text, &mut problems).is_none() {
                let path = place.path();
                problems.push(
                    ProblemKind::Value,
                    &path,
                    message!("the scene has no `{path}`", path),
                    message!("allowed: a part that it has"),
                );
            }
        }
        let name = "the scene".into();
        validate::validate(source, &NoFiles, problems, Some(self)).map_err(|problems| SceneError { name, problems })
    }

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

impl PartPlace<'_> {
    fn path(self) -> Path {
        let root = Path::root();
        match self {
            Self::Top(key) => root.key(key.to_owned()),
            Self::Item(key, index) => root.key(key.to_owned()).index(index),
            Self::Material(name) => root.key("material").key(name.to_owned()),
        }
    }

    /// A scene file with this part alone.
    fn alone(self, text: &str) -> String {
        match self {
            Self::Top(key) => format!("{{\"{key}\":{text}}}"),
            Self::Item(key, _) => format!("{{\"{key}\":[{text}]}}"),
            Self::Material(_) => format!("{{\"material\":{{\"\":{text}}}}}"),
        }
    }
}

/// Puts a part in its place in a source; `None` if there is no such place.
fn put(source: &mut SceneSource, place: PartPlace<'_>, text: Option<&str>, problems: &mut Problems) -> Option<()> {
    let alone = text.map_or_else(|| "{}".into(), |text| place.alone(text));
    let mut document = Document::parse(&alone, Syntax::Json);
    problems.extend(std::mem::take(&mut document.syntax_problems));
    let mut part = SceneSource::read(&document, problems);
    macro_rules! top {
        ($key:ident: $($field:ident)*) => {
            match $key {
                $( stringify!($field) => source.$field = part.$field, )*
                _ => return None,
            }
        };
    }
    macro_rules! item {
        ($key:ident, $index:ident: $($field:ident $name:expr;)*) => {
            match $key {
                $( $name => *source.$field.get_mut($index)? = part.$field.pop()?, )*
                _ => return None,
            }
        };
    }
    match place {
        PartPlace::Top(key) => {
            top!(key: title length handedness convention shadows quantities color_space camera sampling ambient);
        }
        PartPlace::Item(key, index) => item!(key, index:
            sphere "sphere"; ellipsoid "ellipsoid"; cuboid "box"; cylinder "cylinder"; cone "cone"; plane "plane";
            rectangle "rectangle"; mesh "mesh"; spheres "spheres"; disk "disk"; light "light"; probe "probe"; area "area";
            grid "grid";
        ),
        PartPlace::Material(name) => {
            let written = source.material.remove(name)?;
            if text.is_some() {
                let material = part.material.pop_first().map_or(written, |(_, material)| material);
                source.material.insert(name.to_owned(), material);
            }
        }
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::library::Starter;
    use crate::units::Keyword;

    fn lab() -> Scene {
        let starter = Starter::ALL.iter().find(|starter| starter.name() == "lab").unwrap();
        Scene::from_text("lab", starter.text(), Syntax::Toml).unwrap()
    }

    /// The scene after it was written as a whole and read again.
    fn read_again(scene: &Scene) -> Scene {
        Scene::from_text("the scene", &serde_json::to_string(scene.source()).unwrap(), Syntax::Json).unwrap()
    }

    #[test]
    fn parts_that_are_written_anew_are_those_of_the_whole_scene_read_again() {
        let light = r#"{"name": "lamp", "position": [1, 2, -3], "power": 7}"#;
        let parts = [
            (PartPlace::Top("convention"), Some("\"lambert\"")),
            (PartPlace::Top("title"), None),
            (PartPlace::Item("light", 0), Some(light)),
            (
                PartPlace::Item("sphere", 0),
                Some(r#"{"name": "ball", "center": [0, 0, 5], "radius": 0.5, "material": "clay"}"#),
            ),
            (PartPlace::Material("clay"), Some(r#"{"diffuse": 0.5}"#)),
        ];
        let scene = lab().set_probes_aside().with_parts(&parts).unwrap();
        assert_eq!(scene.title(), "");
        assert_eq!(scene.source().light[0].power, Some(7.0.into()));
        let again = read_again(&scene);
        assert_eq!(scene.source(), again.source());
        assert_eq!(format!("{:?}", scene.lights()), format!("{:?}", again.lights()));
        assert_eq!(format!("{:?}", scene.shapes()), format!("{:?}", again.shapes()));
        assert_eq!(format!("{:?}", scene.materials()), format!("{:?}", again.materials()));
    }

    #[test]
    fn wrong_parts_are_reported_where_they_are() {
        let scene = lab();
        let path = |place, text| match scene.with_parts(&[(place, text)]) {
            Err(error) => error.problems[0].path.clone(),
            Ok(_) => panic!("{place:?} is taken"),
        };
        assert_eq!(path(PartPlace::Item("light", 1), Some("{}")), "light[1]");
        assert_eq!(path(PartPlace::Item("lamp", 0), Some("{}")), "lamp");
        assert_eq!(path(PartPlace::Top("version"), Some("2")), "version");
        assert_eq!(path(PartPlace::Material("chalk"), Some("{}")), "material.chalk");
        assert_eq!(
            path(PartPlace::Item("sphere", 0), Some(r#"{"center": [0, 0, 5], "radius": -1}"#)),
            "sphere[0].radius"
        );
        assert_eq!(path(PartPlace::Material("clay"), None), "sphere[0].material");
    }

    impl Scene {
        fn set_probes_aside(&self) -> Self {
            self.changed(|source| source.probe.clear()).unwrap()
        }
    }
}
