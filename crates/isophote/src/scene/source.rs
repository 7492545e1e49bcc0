//! A scene exactly as it is written: nothing checked, nothing filled in. The schema is generated from here.

mod amount;
mod files;
mod grid;
mod shapes;

use std::collections::BTreeMap;

pub use amount::Amount;
pub use files::{MeshSource, SpheresSource};
pub use grid::GridSource;
use schemars::{JsonSchema, Schema, transform::RecursiveTransform, transform::Transform};
use serde::Serialize;
pub use shapes::{
    ConeSource, CuboidSource, CylinderSource, DiskSource, EllipsoidSource, PlaneSource, RectangleSource, RotationSource,
};

use crate::camera::Handedness;
use crate::color::ColorSpace;
use crate::import::Origin;
use crate::reflectance::Convention;
use crate::scene::Filter;
use crate::units::{LengthUnit, UnitSystem};

/// A scene of surfaces lit by point lights, for the program isophote.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Isophote scene")]
pub struct SceneSource {
    /// Where the names of files in the scene start: in the directory of its own file, say.
    #[serde(skip)]
    pub origin: Origin,
    /// Version of the scene format: 1.
    #[schemars(required, extend("const" = 1))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub version: Option<u64>,
    /// A line that says what the scene is.
    #[schemars(extend("default" = ""))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// Unit of every length in the scene.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length: Option<LengthUnit>,
    /// Which way x runs on the screen (formula 2.3): `left` means right = up × forward, `right` means
    /// right = forward × up.
    #[schemars(extend("default" = "right"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub handedness: Option<Handedness>,
    /// Which formula gives the brightness (3.1 to 3.6).
    #[schemars(extend("default" = "radiance"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub convention: Option<Convention>,
    /// Whether shapes stand in each other's light.
    #[schemars(extend("default" = false))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shadows: Option<bool>,
    /// Whether lights are given in W and W/sr, or in lm and cd.
    #[schemars(extend("default" = "radiometric"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quantities: Option<UnitSystem>,
    /// Which lights the three numbers of an amount that is written as [R, G, B] are amounts of: a space of linear RGB.
    #[schemars(extend("default" = "rec709"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color_space: Option<ColorSpace>,
    /// The observer.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraSource>,
    /// How many rays a pixel's value is made of; one through its centre by default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sampling: Option<SamplingSource>,
    /// The materials by name.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    #[schemars(default, extend("default" = {}))]
    pub material: BTreeMap<String, MaterialSource>,
    /// The spheres.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default, extend("default" = []))]
    pub sphere: Vec<SphereSource>,
    /// The ellipsoids.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default, extend("default" = []))]
    pub ellipsoid: Vec<EllipsoidSource>,
    /// The boxes.
    #[serde(rename = "box", skip_serializing_if = "Vec::is_empty")]
    #[schemars(default, extend("default" = []))]
    pub cuboid: Vec<CuboidSource>,
    /// The cylinders.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default, extend("default" = []))]
    pub cylinder: Vec<CylinderSource>,
    /// The cones.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default, extend("default" = []))]
    pub cone: Vec<ConeSource>,
    /// The planes.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default, extend("default" = []))]
    pub plane: Vec<PlaneSource>,
    /// The rectangles.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default, extend("default" = []))]
    pub rectangle: Vec<RectangleSource>,
    /// The meshes.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default, extend("default" = []))]
    pub mesh: Vec<MeshSource>,
    /// Files of many spheres.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default, extend("default" = []))]
    pub spheres: Vec<SpheresSource>,
    /// The disks.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default, extend("default" = []))]
    pub disk: Vec<DiskSource>,
    /// The lights.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default, extend("default" = []))]
    pub light: Vec<LightSource>,
    /// Light from all around.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ambient: Option<AmbientSource>,
    /// Points whose values are reported.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default, extend("default" = []))]
    pub probe: Vec<ProbeSource>,
    /// Grids of points at which the irradiance is computed.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default, extend("default" = []))]
    pub grid: Vec<GridSource>,
}

/// The observer.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CameraSource {
    /// Where the eye is.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub eye: Option<[f64; 3]>,
    /// Direction of view, of any length but zero. Either this or `target`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub forward: Option<[f64; 3]>,
    /// A point to look at. Either this or `forward`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target: Option<[f64; 3]>,
    /// A direction that appears vertical; not parallel to the direction of view.
    #[schemars(extend("default" = [0, 1, 0]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub up: Option<[f64; 3]>,
    /// How directions become places in the image (formulas 2.1, 2.7 to 2.10).
    #[schemars(extend("default" = "perspective"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub projection: Option<ProjectionName>,
    /// The window of a perspective camera. Either this or `field_of_view`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub screen: Option<ScreenSource>,
    /// The angle that the width of a perspective image spans, below 180; or the angle across the circle of a fisheye, up to
    /// 360; in degrees.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = 360.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub field_of_view: Option<f64>,
    /// The window of an orthographic camera, on the plane through the eye.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub window: Option<WindowSource>,
    /// Left and right edge of a panorama, in degrees from the direction of view towards the right.
    #[schemars(extend("default" = [-180, 180]), inner(range(min = -360.0, max = 360.0)))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub longitude: Option<[f64; 2]>,
    /// Lower and upper edge of a panorama, in degrees from the direction of view towards `up`.
    #[schemars(extend("default" = [-90, 90]), inner(range(min = -90.0, max = 90.0)))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub latitude: Option<[f64; 2]>,
    /// Width and height of the image in pixels.
    #[schemars(extend("default" = [800, 600]))]
    #[schemars(inner(range(min = 1, max = 65536)))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resolution: Option<[u64; 2]>,
}

/// The window on the screen plane.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScreenSource {
    /// Distance of the screen plane from the eye.
    #[schemars(required, extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance: Option<f64>,
    /// Left and right edge of the window; the first is smaller.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x: Option<[f64; 2]>,
    /// Lower and upper edge of the window; the first is smaller.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y: Option<[f64; 2]>,
}

/// The window of an orthographic camera.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WindowSource {
    /// Left and right edge, from the eye; the first is smaller.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x: Option<[f64; 2]>,
    /// Lower and upper edge, from the eye; the first is smaller.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y: Option<[f64; 2]>,
}

/// The projections by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ProjectionName {
    /// Straight lines through the eye and a window.
    Perspective,
    /// Parallel rays from the plane through the eye.
    Orthographic,
    /// A cone of directions in a circle, whose radius is the angle from the axis.
    FisheyeEquidistant,
    /// A cone of directions in a circle, whose areas are solid angles.
    FisheyeEqualArea,
    /// Longitude and latitude.
    Panorama,
}

impl crate::units::Keyword for ProjectionName {
    const ALL: &'static [Self] =
        &[Self::Perspective, Self::Orthographic, Self::FisheyeEquidistant, Self::FisheyeEqualArea, Self::Panorama];

    fn name(self) -> &'static str {
        match self {
            Self::Perspective => "perspective",
            Self::Orthographic => "orthographic",
            Self::FisheyeEquidistant => "fisheye-equidistant",
            Self::FisheyeEqualArea => "fisheye-equal-area",
            Self::Panorama => "panorama",
        }
    }
}

/// How many rays a pixel's value is made of.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SamplingSource {
    /// Rays for each pixel. With a tolerance the most that a pixel gets, 256 by default.
    #[schemars(range(min = 1, max = 4096), extend("default" = 1))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub samples: Option<u64>,
    /// The error of a pixel's brightness that is allowed, as a part of the largest brightness of the image: each pixel
    /// gets as many rays as that takes.
    #[schemars(range(min = 0.0001, max = 1.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// What a pixel is a mean over.
    #[schemars(extend("default" = "box"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub filter: Option<Filter>,
}

/// What a surface is made of.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MaterialSource {
    /// Diffuse coefficient k_d, or those of red, green and blue.
    #[schemars(required, with = "Option<amount::Coefficient>")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub diffuse: Option<Amount>,
    /// Specular coefficient k_s, or those of red, green and blue.
    #[schemars(with = "Option<amount::Coefficient>", extend("default" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub specular: Option<Amount>,
    /// Shininess n, the exponent of the highlight. Must be given where `specular` is not 0.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = 100_000.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shininess: Option<f64>,
}

/// A sphere.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SphereSource {
    /// A name of its own; by default `sphere[0]`, `sphere[1]` and so on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its centre.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub center: Option<[f64; 3]>,
    /// Its radius.
    #[schemars(required, extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
    /// Name of its material. May be left out in the `irradiance` convention, which knows no material.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// What it has to do with shadows.
    #[serde(flatten)]
    pub shadow: ShadowSource,
}

/// What a shape has to do with the shadows of a scene that has them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct ShadowSource {
    /// Whether it stands in other shapes' light.
    #[schemars(extend("default" = true))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub casts_shadow: Option<bool>,
    /// Whether other shapes stand in its light.
    #[schemars(extend("default" = true))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub receives_shadow: Option<bool>,
}

/// A light.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LightSource {
    /// A name of its own; by default `light[0]`, `light[1]` and so on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Where it stands: not inside a sphere, unless the eye is inside the same one. Required, but for a parallel light,
    /// which has no place.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position: Option<[f64; 3]>,
    /// Intensity on the axis in W/sr or cd. Either this or `power`.
    #[schemars(with = "Option<amount::Strength>")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub intensity: Option<Amount>,
    /// Power sent out in all directions, in W or lm; isotropic: 4π times the intensity, lambertian: π times,
    /// spot: π (2 − cos α − cos β) times, for the half angles α and β of its cones.
    #[schemars(with = "Option<amount::Strength>")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub power: Option<Amount>,
    /// How the intensity depends on the direction: not at all, as the cosine of the angle from the axis, or by two cones;
    /// or that the light comes from one direction, like the sun's.
    #[schemars(extend("default" = "isotropic"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub emission: Option<EmissionName>,
    /// The axis of a lambertian light or of a spot, of any length but zero. Either this or `target`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    /// A point at which a lambertian light or a spot is aimed. Either this or `axis`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target: Option<[f64; 3]>,
    /// Half the opening of the cone in which a spot has its full intensity, in degrees from the axis.
    #[schemars(range(min = 0.0, max = 90.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inner_angle: Option<f64>,
    /// Half the opening of the cone outside which a spot sends nothing, in degrees from the axis; at least half a degree more
    /// than `inner_angle`.
    #[schemars(range(min = 0.0, max = 90.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outer_angle: Option<f64>,
    /// The direction in which the light of a parallel light travels, of any length but zero.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<[f64; 3]>,
    /// What a parallel light gives to a plane at right angles to its direction, in W/m² or lx.
    #[schemars(with = "Option<amount::Strength>")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub irradiance: Option<Amount>,
    /// Whether shapes keep its light from each other, if the scene has shadows.
    #[schemars(extend("default" = true))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub casts_shadows: Option<bool>,
}

/// Light that comes from all around, with the same radiance from every direction.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AmbientSource {
    /// Its radiance L_a in W/(m²·sr) or cd/m²: every surface receives π L_a of it.
    #[schemars(required, with = "Option<amount::Strength>")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radiance: Option<Amount>,
    /// Whether shapes keep it from each other.
    #[schemars(extend("default" = false))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub obstructed: Option<bool>,
    /// In how many directions each point looks for shapes that are in the way.
    #[schemars(range(min = 1, max = 4096), extend("default" = 64))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub samples: Option<u64>,
}

/// The emission patterns by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum EmissionName {
    /// The same intensity in every direction.
    Isotropic,
    /// I₀ cosγ, γ the angle from the axis.
    Lambertian,
    /// I₀ within a cone, 0 outside another, a smooth step between.
    Spot,
    /// From one direction, without loss: the sun.
    Parallel,
}

impl crate::units::Keyword for EmissionName {
    const ALL: &'static [Self] = &[Self::Isotropic, Self::Lambertian, Self::Spot, Self::Parallel];

    fn name(self) -> &'static str {
        match self {
            Self::Isotropic => "isotropic",
            Self::Lambertian => "lambertian",
            Self::Spot => "spot",
            Self::Parallel => "parallel",
        }
    }
}

/// A point on a surface whose values are reported.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ProbeSource {
    /// A name of its own; by default `probe[0]`, `probe[1]` and so on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// The point; it must lie on a surface, to a billionth of the shape's size.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<[f64; 3]>,
    /// A value that somebody published for this point, shown beside the computed brightness and used for nothing else.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub published: Option<f64>,
}

impl SceneSource {
    /// The scene as a TOML scene file, with the keys that it has.
    ///
    /// # Panics
    /// Never: every value of a scene has a TOML form.
    #[must_use]
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("every value of a scene has a TOML form")
    }
}

/// The JSON Schema of a scene file, as `schema/scene.schema.json` holds it.
///
/// # Panics
/// Never: a schema is plain data.
#[must_use]
pub fn schema() -> String {
    let mut schema = schemars::schema_for!(SceneSource);
    // `Option` says whether a key was written; to write null for it is not allowed.
    RecursiveTransform(forbid_null).transform(&mut schema);
    let mut text = serde_json::to_string_pretty(&schema).expect("a schema is plain data");
    text.push('\n');
    text
}

fn forbid_null(schema: &mut Schema) {
    let Some(object) = schema.as_object_mut() else { return };
    if let Some(serde_json::Value::Array(types)) = object.get_mut("type") {
        types.retain(|kind| kind != "null");
        if let [only] = types.as_slice() {
            let only = only.clone();
            object.insert("type".into(), only);
        }
    }
    if let Some(serde_json::Value::Array(choices)) = object.get_mut("anyOf") {
        choices.retain(|choice| choice.get("type").is_none_or(|kind| kind != "null"));
        if let [serde_json::Value::Object(only)] = choices.as_slice() {
            let only = only.clone();
            object.remove("anyOf");
            object.extend(only);
        }
    }
}
