//! A scene exactly as it is written: nothing checked, nothing filled in. Its tables are declared here once, for their
//! structures, their reading and the schema; the bounds of numbers are those of [`limits`](super::limits).

mod amount;
mod camera;
mod declare;
mod files;
mod light;
mod material;
mod points;
mod sampling;
mod schema;
mod shapes;

use std::collections::BTreeMap;

pub use amount::Amount;
pub use camera::{CameraSource, IntrinsicsSource, PoseSource, ProjectionName, ScreenSource, WindowSource};
use declare::{TableSource, tables};
pub use files::{MeshSource, SpheresSource};
pub use light::{AmbientSource, EmissionName, LightSource};
pub use material::MaterialSource;
pub use points::{AreaSource, GridSource, ProbeSource};
pub use sampling::SamplingSource;
pub use schema::schema;
pub use shapes::{
    ConeSource, CuboidSource, CylinderSource, DiskSource, EllipsoidSource, PlaneSource, RectangleSource,
    RotationSource, ShadowSource, SphereSource,
};

use super::document::{Document, Syntax};
use super::problems::Problems;
use super::table::read_root;
use crate::camera::Handedness;
use crate::color::ColorSpace;
use crate::import::Origin;
use crate::reflectance::Convention;
use crate::units::{LengthUnit, UnitSystem};

tables! {
    /// A scene of surfaces lit by point lights, for the program isophote.
    #[serde(deny_unknown_fields)]
    #[schemars(title = "Isophote scene")]
    pub struct SceneSource {
        /// Where the names of files in the scene start: in the directory of its own file, say.
        #[serde(skip)]
        pub origin: Origin,
        /// Version of the scene format: 1.
        #[schemars(required, extend("const" = 1))]
        pub version: Option<u64>,
        /// A line that says what the scene is.
        #[schemars(extend("default" = ""))]
        pub title: Option<String>,
        /// Unit of every length in the scene.
        #[schemars(required)]
        pub length: Option<LengthUnit>,
        /// Which way x runs on the screen (formula 2.3): `left` means right = up × forward, `right` means
        /// right = forward × up.
        #[schemars(extend("default" = "right"))]
        pub handedness: Option<Handedness>,
        /// Which formula gives the brightness (3.1 to 3.6, 3.11, 3.12).
        #[schemars(extend("default" = "radiance"))]
        pub convention: Option<Convention>,
        /// Whether shapes stand in each other's light.
        #[schemars(extend("default" = false))]
        pub shadows: Option<bool>,
        /// Whether lights are given in W and W/sr, or in lm and cd.
        #[schemars(extend("default" = "radiometric"))]
        pub quantities: Option<UnitSystem>,
        /// Which lights the three numbers of an amount that is written as [R, G, B] are amounts of: a space of linear RGB.
        #[schemars(extend("default" = "rec709"))]
        pub color_space: Option<ColorSpace>,
        /// The observer.
        #[schemars(required)]
        pub camera: Option<CameraSource>,
        /// How many rays a pixel's value is made of; one through its centre by default.
        pub sampling: Option<SamplingSource>,
        /// The materials by name.
        #[schemars(default, extend("default" = {}))]
        pub material: BTreeMap<String, MaterialSource>,
        /// The spheres.
        #[schemars(default, extend("default" = []))]
        pub sphere: Vec<SphereSource>,
        /// The ellipsoids.
        #[schemars(default, extend("default" = []))]
        pub ellipsoid: Vec<EllipsoidSource>,
        /// The boxes.
        #[schemars(default, extend("default" = []))]
        pub cuboid as "box": Vec<CuboidSource>,
        /// The cylinders.
        #[schemars(default, extend("default" = []))]
        pub cylinder: Vec<CylinderSource>,
        /// The cones.
        #[schemars(default, extend("default" = []))]
        pub cone: Vec<ConeSource>,
        /// The planes.
        #[schemars(default, extend("default" = []))]
        pub plane: Vec<PlaneSource>,
        /// The rectangles.
        #[schemars(default, extend("default" = []))]
        pub rectangle: Vec<RectangleSource>,
        /// The meshes.
        #[schemars(default, extend("default" = []))]
        pub mesh: Vec<MeshSource>,
        /// Files of many spheres.
        #[schemars(default, extend("default" = []))]
        pub spheres: Vec<SpheresSource>,
        /// The disks.
        #[schemars(default, extend("default" = []))]
        pub disk: Vec<DiskSource>,
        /// The lights.
        #[schemars(default, extend("default" = []))]
        pub light: Vec<LightSource>,
        /// Light from all around.
        pub ambient: Option<AmbientSource>,
        /// Points whose values are reported.
        #[schemars(default, extend("default" = []))]
        pub probe: Vec<ProbeSource>,
        /// Circles and rectangles whose extremes and mean are reported.
        #[schemars(default, extend("default" = []))]
        pub area: Vec<AreaSource>,
        /// Grids of points at which the irradiance is computed.
        #[schemars(default, extend("default" = []))]
        pub grid: Vec<GridSource>,
    }
}

impl SceneSource {
    /// Reads a scene out of a document. What cannot be read is reported and left out.
    pub(super) fn read(document: &Document<'_>, problems: &mut Problems) -> Self {
        read_root(document, problems, TableSource::read)
    }

    /// As much of a scene as can be read in a text, whatever else is wrong with it. What is wrong, [`Scene::from_text`] says.
    ///
    /// [`Scene::from_text`]: super::Scene::from_text
    #[must_use]
    pub fn readable_part(text: &str, syntax: Syntax) -> Self {
        Self::read(&Document::parse(text, syntax), &mut Problems::default())
    }

    /// The scene as a TOML scene file, with the keys that it has.
    ///
    /// # Panics
    /// Never: every value of a scene has a TOML form.
    #[must_use]
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("every value of a scene has a TOML form")
    }
}
