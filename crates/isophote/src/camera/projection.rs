//! How directions map to screen positions.

use super::Fisheye;
use crate::map::Resolution;

/// How the camera projects: which ray belongs to which screen position. A closed set: projections with formulas of their own
/// have files of their own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Straight lines through the eye and a window (2.1).
    Perspective(Screen),
    /// Parallel rays that start on the plane through the eye (2.7), with the window there, in metres.
    Orthographic(Extent),
    /// A whole cone around the direction of view, in a circle (2.8), (2.9).
    Fisheye(Fisheye),
    /// Longitude and latitude (2.10), in degrees.
    Panorama(Extent),
}

/// The window through which a perspective camera looks. Lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screen {
    /// From the eye to the screen plane.
    pub distance: f64,
    /// Left and right edge.
    pub x: [f64; 2],
    /// Lower and upper edge.
    pub y: [f64; 2],
}

/// Outer edges of the image on the screen, in metres or degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Left and right edge.
    pub x: [f64; 2],
    /// Lower and upper edge.
    pub y: [f64; 2],
}

impl Screen {
    /// The window at a distance whose width spans an angle (in degrees, below 180) and whose pixels are square.
    #[must_use]
    pub fn of_field_of_view(field_of_view: f64, distance: f64, resolution: Resolution) -> Self {
        let half_width = distance * libm::tan(0.5 * field_of_view.to_radians());
        let half_height = half_width * f64::from(resolution.height) / f64::from(resolution.width);
        Self { distance, x: [-half_width, half_width], y: [-half_height, half_height] }
    }
}

impl Projection {
    /// Whether screen positions are in degrees instead of metres.
    #[must_use]
    pub fn is_angular(&self) -> bool {
        matches!(self, Self::Fisheye(_) | Self::Panorama(_))
    }

    /// The outer edges of an image.
    #[must_use]
    pub fn extent(&self, resolution: Resolution) -> Extent {
        match self {
            Self::Perspective(Screen { x, y, .. }) => Extent { x: *x, y: *y },
            Self::Orthographic(extent) | Self::Panorama(extent) => *extent,
            Self::Fisheye(fisheye) => {
                let [width, height] = [resolution.width, resolution.height].map(f64::from);
                let radius = fisheye.radius();
                let [half_width, half_height] = [width, height].map(|side| radius * (side / width.min(height)));
                Extent { x: [-half_width, half_width], y: [-half_height, half_height] }
            }
        }
    }
}
