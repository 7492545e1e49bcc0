//! What the axes of a map stand for.

use serde::{Deserialize, Serialize};

use crate::message;
use crate::text::{Language, Message};
use crate::units::{Keyword, LengthUnit};

/// What x and y of a [`Window`](super::Window) are: coordinates on the screen, or on a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Coordinates {
    /// x and y on the camera's screen plane.
    #[default]
    Screen,
    /// x and y in degrees, as on the screens of a fisheye or a panorama.
    ScreenAngles,
    /// Longitude and latitude on a sphere.
    LongitudeLatitude,
    /// Longitude and the sine of the latitude on a sphere: equal areas have equal sizes (Lambert's cylindrical projection).
    LongitudeSine,
    /// The angle about a cylinder's axis, and the height along it.
    AngleHeight,
    /// The angle about a disk's normal, and the distance from its centre.
    AngleRadius,
    /// The angle about a disk's normal, and the square of the distance from its centre, as a fraction of R².
    AngleSquare,
    /// Along the width and the height of a rectangle, from its centre.
    Sides,
    /// Along the edges u and v of a grid's rectangle, from its corner. The grid is not a shape.
    Grid,
}

/// One of the two axes of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CoordinateAxis {
    /// Its name in tables.
    pub name: &'static str,
    /// Its name in figures.
    pub title: &'static str,
    /// Its unit; `"1"` for pure numbers.
    pub unit: &'static str,
}

impl CoordinateAxis {
    /// Its name in figures, in a language.
    #[must_use]
    pub fn label(&self, language: Language) -> String {
        let label = match self.name {
            "longitude" => message!("longitude"),
            "latitude" => message!("latitude"),
            "sin_latitude" => message!("sine of the latitude"),
            "angle" => message!("angle"),
            "height" => message!("height"),
            "radius" => message!("radius"),
            _ => Message::verbatim(self.title),
        };
        label.in_language(language)
    }
}

impl Coordinates {
    /// The axis from left to right, and the axis from the lower to the upper edge.
    #[must_use]
    pub fn axes(self, length: LengthUnit) -> [CoordinateAxis; 2] {
        let axis = |name, title, unit| CoordinateAxis { name, title, unit };
        let named = |name, unit| axis(name, name, unit);
        let length = length.name();
        match self {
            Self::Screen | Self::Sides => [named("x", length), named("y", length)],
            Self::ScreenAngles => [named("x", "°"), named("y", "°")],
            Self::LongitudeLatitude => [named("longitude", "°"), named("latitude", "°")],
            Self::LongitudeSine => [named("longitude", "°"), axis("sin_latitude", "sine of the latitude", "1")],
            Self::AngleHeight => [named("angle", "°"), named("height", length)],
            Self::AngleRadius => [named("angle", "°"), named("radius", length)],
            Self::AngleSquare => [named("angle", "°"), axis("radius_squared", "(r/R)²", "1")],
            Self::Grid => [named("u", length), named("v", length)],
        }
    }

    /// Whether a map's pixels are those of a camera.
    #[must_use]
    pub fn is_screen(&self) -> bool {
        matches!(self, Self::Screen | Self::ScreenAngles)
    }

    #[expect(clippy::trivially_copy_pass_by_ref, reason = "serde calls it so")]
    pub(super) fn is_default(&self) -> bool {
        *self == Self::default()
    }
}
