//! The shapes other than spheres, as they are written.

use schemars::JsonSchema;
use serde::Serialize;

use super::ShadowSource;

/// An ellipsoid.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EllipsoidSource {
    /// A name of its own; by default `ellipsoid[0]`, `ellipsoid[1]` and so on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its centre.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub center: Option<[f64; 3]>,
    /// Its radii along its own x, y and z.
    #[schemars(required, extend("items" = {"type": "number", "format": "double", "exclusiveMinimum": 0}))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radii: Option<[f64; 3]>,
    /// How it is turned about its centre.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation: Option<RotationSource>,
    /// Name of its material. May be left out in the `irradiance` convention, which knows no material.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// What it has to do with shadows.
    #[serde(flatten)]
    pub shadow: ShadowSource,
}

/// A box.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CuboidSource {
    /// A name of its own; by default `box[0]`, `box[1]` and so on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its centre.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub center: Option<[f64; 3]>,
    /// Its sides along its own x, y and z.
    #[schemars(required, extend("items" = {"type": "number", "format": "double", "exclusiveMinimum": 0}))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size: Option<[f64; 3]>,
    /// How it is turned about its centre.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation: Option<RotationSource>,
    /// Name of its material. May be left out in the `irradiance` convention, which knows no material.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// What it has to do with shadows.
    #[serde(flatten)]
    pub shadow: ShadowSource,
}

/// A cylinder, its two flat ends included.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CylinderSource {
    /// A name of its own; by default `cylinder[0]`, `cylinder[1]` and so on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// The middle of one end.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from: Option<[f64; 3]>,
    /// The middle of the other end.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to: Option<[f64; 3]>,
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

/// A cone, its flat base included; cut off at the top if `apex_radius` is not 0.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConeSource {
    /// A name of its own; by default `cone[0]`, `cone[1]` and so on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// The middle of the base.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base: Option<[f64; 3]>,
    /// The point, or the middle of the upper end.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub apex: Option<[f64; 3]>,
    /// Radius of the base.
    #[schemars(required, extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
    /// Radius of the upper end.
    #[schemars(range(min = 0.0), extend("default" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub apex_radius: Option<f64>,
    /// Name of its material. May be left out in the `irradiance` convention, which knows no material.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// What it has to do with shadows.
    #[serde(flatten)]
    pub shadow: ShadowSource,
}

/// A plane without end.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaneSource {
    /// A name of its own; by default `plane[0]`, `plane[1]` and so on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// A point of it.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub point: Option<[f64; 3]>,
    /// A direction at right angles to it, of any length but zero.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal: Option<[f64; 3]>,
    /// Name of its material. May be left out in the `irradiance` convention, which knows no material.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// What it has to do with shadows.
    #[serde(flatten)]
    pub shadow: ShadowSource,
}

/// A rectangle, seen from both sides.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RectangleSource {
    /// A name of its own; by default `rectangle[0]`, `rectangle[1]` and so on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its middle.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub center: Option<[f64; 3]>,
    /// A direction at right angles to it, of any length but zero.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal: Option<[f64; 3]>,
    /// The direction of its height; not parallel to `normal`.
    #[schemars(extend("default" = [0, 1, 0]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub up: Option<[f64; 3]>,
    /// Its extent at right angles to `up`.
    #[schemars(required, extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
    /// Its extent along `up`.
    #[schemars(required, extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height: Option<f64>,
    /// Name of its material. May be left out in the `irradiance` convention, which knows no material.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// What it has to do with shadows.
    #[serde(flatten)]
    pub shadow: ShadowSource,
}

/// A disk, seen from both sides.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DiskSource {
    /// A name of its own; by default `disk[0]`, `disk[1]` and so on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its middle.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub center: Option<[f64; 3]>,
    /// A direction at right angles to it, of any length but zero.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal: Option<[f64; 3]>,
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

/// A turn about an axis through the shape's centre.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RotationSource {
    /// The axis, a direction of any length but zero.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    /// By how many degrees; counter-clockwise for who looks against the axis.
    #[schemars(required)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub degrees: Option<f64>,
}
