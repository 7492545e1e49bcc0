//! Shapes, as they are written; those from files are in `files`.

use super::declare::tables;

tables! {
    /// A sphere.
    #[serde(deny_unknown_fields)]
    pub struct SphereSource {
        /// A name of its own; by default `sphere[0]`, `sphere[1]` and so on.
        pub name: Option<String>,
        /// Its centre.
        #[schemars(required)]
        pub center: Option<[f64; 3]>,
        /// Its radius.
        #[schemars(required, extend("exclusiveMinimum" = 0))]
        pub radius: Option<f64>,
        /// Name of its material. May be left out in the `irradiance` convention, which knows no material.
        pub material: Option<String>,
        /// What it has to do with shadows.
        #[serde(flatten)]
        pub shadow: ShadowSource,
    }

    /// An ellipsoid.
    #[serde(deny_unknown_fields)]
    pub struct EllipsoidSource {
        /// A name of its own; by default `ellipsoid[0]`, `ellipsoid[1]` and so on.
        pub name: Option<String>,
        /// Its centre.
        #[schemars(required)]
        pub center: Option<[f64; 3]>,
        /// Its radii along its own x, y and z.
        #[schemars(required, extend("items" = {"type": "number", "format": "double", "exclusiveMinimum": 0}))]
        pub radii: Option<[f64; 3]>,
        /// How it is turned about its centre.
        pub rotation: Option<RotationSource>,
        /// Name of its material. May be left out in the `irradiance` convention, which knows no material.
        pub material: Option<String>,
        /// What it has to do with shadows.
        #[serde(flatten)]
        pub shadow: ShadowSource,
    }

    /// A box.
    #[serde(deny_unknown_fields)]
    pub struct CuboidSource {
        /// A name of its own; by default `box[0]`, `box[1]` and so on.
        pub name: Option<String>,
        /// Its centre.
        #[schemars(required)]
        pub center: Option<[f64; 3]>,
        /// Its sides along its own x, y and z.
        #[schemars(required, extend("items" = {"type": "number", "format": "double", "exclusiveMinimum": 0}))]
        pub size: Option<[f64; 3]>,
        /// How it is turned about its centre.
        pub rotation: Option<RotationSource>,
        /// Name of its material. May be left out in the `irradiance` convention, which knows no material.
        pub material: Option<String>,
        /// What it has to do with shadows.
        #[serde(flatten)]
        pub shadow: ShadowSource,
    }

    /// A cylinder, its two flat ends included.
    #[serde(deny_unknown_fields)]
    pub struct CylinderSource {
        /// A name of its own; by default `cylinder[0]`, `cylinder[1]` and so on.
        pub name: Option<String>,
        /// The middle of one end.
        #[schemars(required)]
        pub from: Option<[f64; 3]>,
        /// The middle of the other end.
        #[schemars(required)]
        pub to: Option<[f64; 3]>,
        /// Its radius.
        #[schemars(required, extend("exclusiveMinimum" = 0))]
        pub radius: Option<f64>,
        /// Name of its material. May be left out in the `irradiance` convention, which knows no material.
        pub material: Option<String>,
        /// What it has to do with shadows.
        #[serde(flatten)]
        pub shadow: ShadowSource,
    }

    /// A cone, its flat base included; cut off at the top if `apex_radius` is not 0.
    #[serde(deny_unknown_fields)]
    pub struct ConeSource {
        /// A name of its own; by default `cone[0]`, `cone[1]` and so on.
        pub name: Option<String>,
        /// The middle of the base.
        #[schemars(required)]
        pub base: Option<[f64; 3]>,
        /// The point, or the middle of the upper end.
        #[schemars(required)]
        pub apex: Option<[f64; 3]>,
        /// Radius of the base.
        #[schemars(required, extend("exclusiveMinimum" = 0))]
        pub radius: Option<f64>,
        /// Radius of the upper end.
        #[schemars(range(min = 0.0), extend("default" = 0))]
        pub apex_radius: Option<f64>,
        /// Name of its material. May be left out in the `irradiance` convention, which knows no material.
        pub material: Option<String>,
        /// What it has to do with shadows.
        #[serde(flatten)]
        pub shadow: ShadowSource,
    }

    /// A plane without end.
    #[serde(deny_unknown_fields)]
    pub struct PlaneSource {
        /// A name of its own; by default `plane[0]`, `plane[1]` and so on.
        pub name: Option<String>,
        /// A point of it.
        #[schemars(required)]
        pub point: Option<[f64; 3]>,
        /// A direction at right angles to it, of any length but zero.
        #[schemars(required)]
        pub normal: Option<[f64; 3]>,
        /// Name of its material. May be left out in the `irradiance` convention, which knows no material.
        pub material: Option<String>,
        /// What it has to do with shadows.
        #[serde(flatten)]
        pub shadow: ShadowSource,
    }

    /// A rectangle, seen from both sides.
    #[serde(deny_unknown_fields)]
    pub struct RectangleSource {
        /// A name of its own; by default `rectangle[0]`, `rectangle[1]` and so on.
        pub name: Option<String>,
        /// Its middle.
        #[schemars(required)]
        pub center: Option<[f64; 3]>,
        /// A direction at right angles to it, of any length but zero.
        #[schemars(required)]
        pub normal: Option<[f64; 3]>,
        /// The direction of its height; not parallel to `normal`.
        #[schemars(extend("default" = [0, 1, 0]))]
        pub up: Option<[f64; 3]>,
        /// Its extent at right angles to `up`.
        #[schemars(required, extend("exclusiveMinimum" = 0))]
        pub width: Option<f64>,
        /// Its extent along `up`.
        #[schemars(required, extend("exclusiveMinimum" = 0))]
        pub height: Option<f64>,
        /// Name of its material. May be left out in the `irradiance` convention, which knows no material.
        pub material: Option<String>,
        /// What it has to do with shadows.
        #[serde(flatten)]
        pub shadow: ShadowSource,
    }

    /// A disk, seen from both sides.
    #[serde(deny_unknown_fields)]
    pub struct DiskSource {
        /// A name of its own; by default `disk[0]`, `disk[1]` and so on.
        pub name: Option<String>,
        /// Its middle.
        #[schemars(required)]
        pub center: Option<[f64; 3]>,
        /// A direction at right angles to it, of any length but zero.
        #[schemars(required)]
        pub normal: Option<[f64; 3]>,
        /// Its radius.
        #[schemars(required, extend("exclusiveMinimum" = 0))]
        pub radius: Option<f64>,
        /// Name of its material. May be left out in the `irradiance` convention, which knows no material.
        pub material: Option<String>,
        /// What it has to do with shadows.
        #[serde(flatten)]
        pub shadow: ShadowSource,
    }

    /// A turn about an axis through the shape's centre.
    #[derive(Copy)]
    #[serde(deny_unknown_fields)]
    pub struct RotationSource {
        /// The axis, a direction of any length but zero.
        #[schemars(required)]
        pub axis: Option<[f64; 3]>,
        /// By how many degrees; counter-clockwise for who looks against the axis.
        #[schemars(required)]
        pub degrees: Option<f64>,
    }

    /// What a shape has to do with the shadows of a scene that has them.
    #[derive(Copy)]
    pub struct ShadowSource {
        /// Whether it stands in the light of shapes, itself included.
        #[schemars(extend("default" = true))]
        pub casts_shadow: Option<bool>,
        /// Whether shapes stand in its light, itself included.
        #[schemars(extend("default" = true))]
        pub receives_shadow: Option<bool>,
    }
}
