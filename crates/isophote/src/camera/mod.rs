//! The camera: where the rays start and which screen positions they belong to (2.1), (2.3), (2.7) to (2.10).

mod fisheye;
mod frame;
mod panorama;
mod projection;

pub use fisheye::{Fisheye, Mapping};
pub use frame::{CameraFrame, Sight};
pub(crate) use frame::{Differing, PreciseCamera, between};
pub use projection::{Extent, Projection, Screen};

use serde::{Deserialize, Serialize};

use crate::map::{Coordinates, Pixel, Region, Resolution, Window};
use crate::units::{Keyword, LengthUnit, ScreenUnit};
use crate::vector::Vector;

/// Which way x runs on the screen (2.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Handedness {
    /// right = up × forward: x right, y up, z away from the viewer, as on a blackboard.
    Left,
    /// right = forward × up.
    Right,
}

impl Keyword for Handedness {
    const ALL: &'static [Self] = &[Self::Left, Self::Right];

    fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }
}

/// A camera. Lengths in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// O.
    pub eye: Vector,
    /// The direction of view; of any nonzero length.
    pub forward: Vector,
    /// A direction that appears vertical; of any nonzero length, not parallel to `forward`.
    pub up: Vector,
    /// Which way x runs.
    pub handedness: Handedness,
    /// Which ray belongs to which screen position.
    pub projection: Projection,
    /// Pixels of the full image.
    pub resolution: Resolution,
}

/// A position on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ScreenPosition {
    /// The centre of a pixel of the full image.
    PixelCenter(Pixel),
    /// A position inside a pixel of the full image.
    InPixel {
        /// The pixel.
        pixel: Pixel,
        /// Fractions of its width and height, from its upper left corner.
        place: [f64; 2],
    },
    /// A point of the screen, in metres or degrees.
    Point {
        /// To the right.
        x: f64,
        /// Upwards.
        y: f64,
    },
}

impl Camera {
    /// The outer edges of a part of the image on the screen, in a unit of length or in degrees.
    #[must_use]
    pub fn window(&self, region: Region, length: LengthUnit) -> Window {
        let full = self.resolution;
        let Extent { x, y: [bottom, top] } = self.projection.extent(full);
        let in_degrees = self.projection.is_angular();
        let unit = ScreenUnit::of(length, in_degrees);
        let edge = |[first, last]: [f64; 2], edge: u32, count: u32| {
            let part = f64::from(edge) / f64::from(count);
            unit.from_internal(first * (1.0 - part) + last * part)
        };
        let x = |column| edge(x, column, full.width);
        let y = |row| edge([top, bottom], row, full.height);
        let Region { corner, size } = region;
        Window {
            x: [x(corner.column), x(corner.column + size.width)],
            y: [y(corner.row + size.height), y(corner.row)],
            length,
            coordinates: if in_degrees { Coordinates::ScreenAngles } else { Coordinates::Screen },
        }
    }
}

#[cfg(test)]
mod tests;
