//! The observer, as it is written.

use schemars::JsonSchema;
use serde::Serialize;

use super::declare::tables;
use crate::scene::limits;
use crate::units::Keyword;

tables! {
    /// The observer.
    #[serde(deny_unknown_fields)]
    pub struct CameraSource {
        /// Where the eye is.
        pub eye: Option<[f64; 3]>,
        /// Direction of view, of any length but zero. Either this or `target`.
        pub forward: Option<[f64; 3]>,
        /// A point to look at. Either this or `forward`.
        pub target: Option<[f64; 3]>,
        /// The angle of the direction of view from −z, in degrees: 0 is straight down −z, 90 horizontal. With `azimuth`,
        /// instead of `forward` or `target`.
        #[schemars(range(min = 0.0, max = limits::TILT))]
        pub tilt: Option<f64>,
        /// The way that the direction of view leans, in degrees from +x towards +y. Needed where `tilt` is neither 0 nor 180;
        /// there, it is the way to the top of the picture, by default 90: +y.
        #[schemars(range(min = -limits::AZIMUTH, max = limits::AZIMUTH))]
        pub azimuth: Option<f64>,
        /// A direction that appears vertical; not parallel to the direction of view. By default +y; or −z, or +z, if the view
        /// is straight along −y, or +y. Where the view is given by its angles, the direction in which it rises with `tilt`.
        pub up: Option<[f64; 3]>,
        /// How directions become places in the image (formulas 2.1, 2.7 to 2.10).
        #[schemars(extend("default" = "perspective"))]
        pub projection: Option<ProjectionName>,
        /// The window of a perspective camera. Either this or `field_of_view`.
        pub screen: Option<ScreenSource>,
        /// The intrinsic parameters of a calibrated perspective camera (formula 2.11). Instead of `screen` and `field_of_view`.
        pub intrinsics: Option<IntrinsicsSource>,
        /// Where a calibrated camera is (formula 2.12). Instead of `eye`, `forward`, `target` and `up`.
        pub pose: Option<PoseSource>,
        /// The angle that the width of a perspective image spans, below 180; or the angle across the circle of a fisheye, up to
        /// 360; in degrees.
        #[schemars(range(min = *limits::FISHEYE_FIELD.start(), max = *limits::FISHEYE_FIELD.end()))]
        pub field_of_view: Option<f64>,
        /// The window of an orthographic camera, on the plane through the eye.
        pub window: Option<WindowSource>,
        /// Left and right edge of a panorama, in degrees from the direction of view towards the right.
        #[schemars(extend("default" = [-180, 180]), inner(range(min = -limits::LONGITUDE, max = limits::LONGITUDE)))]
        pub longitude: Option<[f64; 2]>,
        /// Lower and upper edge of a panorama, in degrees from the direction of view towards `up`.
        #[schemars(extend("default" = [-90, 90]), inner(range(min = -limits::LATITUDE, max = limits::LATITUDE)))]
        pub latitude: Option<[f64; 2]>,
        /// Width and height of the image in pixels.
        #[schemars(extend("default" = [800, 600]))]
        #[schemars(inner(range(min = 1, max = limits::SIDE)))]
        pub resolution: Option<[u64; 2]>,
    }

    /// The window on the screen plane.
    #[serde(deny_unknown_fields)]
    pub struct ScreenSource {
        /// Distance of the screen plane from the eye.
        #[schemars(required, extend("exclusiveMinimum" = 0))]
        pub distance: Option<f64>,
        /// Left and right edge of the window; the first is smaller.
        #[schemars(required)]
        pub x: Option<[f64; 2]>,
        /// Lower and upper edge of the window; the first is smaller.
        #[schemars(required)]
        pub y: Option<[f64; 2]>,
    }

    /// The intrinsic parameters of a pinhole camera, in pixels; the centre of the top left pixel is (0, 0), y runs down.
    #[serde(deny_unknown_fields)]
    pub struct IntrinsicsSource {
        /// Focal length in widths of a pixel.
        #[schemars(required, range(min = *limits::FOCAL_LENGTH.start(), max = *limits::FOCAL_LENGTH.end()))]
        pub fx: Option<f64>,
        /// Focal length in heights of a pixel.
        #[schemars(required, range(min = *limits::FOCAL_LENGTH.start(), max = *limits::FOCAL_LENGTH.end()))]
        pub fy: Option<f64>,
        /// Column of the principal point.
        #[schemars(required, range(min = -limits::PRINCIPAL_POINT, max = limits::PRINCIPAL_POINT))]
        pub cx: Option<f64>,
        /// Row of the principal point.
        #[schemars(required, range(min = -limits::PRINCIPAL_POINT, max = limits::PRINCIPAL_POINT))]
        pub cy: Option<f64>,
    }

    /// From the axes of the scene to those of the camera, whose x runs to the right, y down and z along the direction of view:
    /// rotation × point + translation.
    #[serde(deny_unknown_fields)]
    pub struct PoseSource {
        /// Three rows: the camera's x, y and z axes in those of the scene.
        #[schemars(required)]
        pub rotation: Option<[[f64; 3]; 3]>,
        /// Where the scene's origin is in the camera's axes.
        #[schemars(required)]
        pub translation: Option<[f64; 3]>,
    }

    /// The window of an orthographic camera.
    #[serde(deny_unknown_fields)]
    pub struct WindowSource {
        /// Left and right edge, from the eye; the first is smaller.
        #[schemars(required)]
        pub x: Option<[f64; 2]>,
        /// Lower and upper edge, from the eye; the first is smaller.
        #[schemars(required)]
        pub y: Option<[f64; 2]>,
    }
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

impl Keyword for ProjectionName {
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
