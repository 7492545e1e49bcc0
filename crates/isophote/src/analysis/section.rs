//! Values along a line on the screen.

use crate::camera::{Camera, ScreenPosition};
use crate::map::{Pixel, Quantity};
use crate::message;
use crate::prepare::{Hit, PreparedScene};
use crate::render::Observer;
use crate::shade::Shading;
use crate::text::Message;
use crate::units::{Keyword, LengthUnit};

/// A line on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SectionLine {
    /// The centres of a row's pixels, from left to right.
    Row(u32),
    /// The centres of a column's pixels, from top to bottom.
    Column(u32),
    /// Evenly spaced points between two screen points, including both ends; in metres or degrees.
    Between {
        /// The first point: x, y.
        from: [f64; 2],
        /// The last point: x, y.
        to: [f64; 2],
        /// The number of points, at least 2.
        samples: u32,
    },
}

/// What the position along a line is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// x.
    X,
    /// y.
    Y,
    /// The distance from its first point.
    Distance,
}

/// A point of a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Its screen position: x, y in metres or degrees.
    pub screen: [f64; 2],
    /// The hit and its shading; `None` where no surface is seen.
    pub seen: Option<(Hit, Shading)>,
}

impl Keyword for Axis {
    const ALL: &'static [Self] = &[Self::X, Self::Y, Self::Distance];

    fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Distance => "distance",
        }
    }
}

impl SectionLine {
    /// The usual number of points on a line; odd, so that one of them is in the middle.
    pub const SAMPLES: u32 = 513;

    /// A line across the whole image at this y, in metres or degrees.
    #[must_use]
    pub fn horizontal(camera: &Camera, y: f64, samples: u32) -> Self {
        let [left, right] = camera.projection.extent(camera.resolution).x;
        Self::Between { from: [left, y], to: [right, y], samples }
    }

    /// A line from the bottom of the image to its top at this x, in metres or degrees.
    #[must_use]
    pub fn vertical(camera: &Camera, x: f64, samples: u32) -> Self {
        let [bottom, top] = camera.projection.extent(camera.resolution).y;
        Self::Between { from: [x, bottom], to: [x, top], samples }
    }
}

impl Axis {
    /// The position of a screen point on a line that starts at another one, in the unit of both.
    #[must_use]
    pub fn position(self, [x, y]: [f64; 2], start: [f64; 2]) -> f64 {
        match self {
            Self::X => x,
            Self::Y => y,
            Self::Distance => (x - start[0]).hypot(y - start[1]),
        }
    }
}

impl Sample {
    /// The value of a quantity that [sections can show](refuse), lengths in a unit; `None` where no surface is seen.
    #[must_use]
    pub fn value(&self, quantity: &Quantity, length: LengthUnit) -> Option<f64> {
        let (hit, shading) = self.seen.as_ref()?;
        Some(match quantity {
            Quantity::Irradiance => shading.irradiance,
            Quantity::Ambient => shading.ambient,
            Quantity::Diffuse => shading.diffuse,
            Quantity::Specular => shading.specular,
            Quantity::Depth => length.from_metres(hit.distance),
            _ => shading.brightness(),
        })
    }
}

/// Says why a section cannot show a quantity, if it cannot.
///
/// # Errors
/// What is wrong.
pub fn refuse(quantity: &Quantity) -> Result<(), Message> {
    let shown = [
        Quantity::Brightness,
        Quantity::Irradiance,
        Quantity::Ambient,
        Quantity::Diffuse,
        Quantity::Specular,
        Quantity::Depth,
    ];
    if shown.contains(quantity) {
        return Ok(());
    }
    let allowed = shown.map(|quantity| quantity.name()).join(", ");
    Err(message!("a section cannot show `{channel}`; allowed: {allowed}", channel = quantity.name(), allowed))
}

/// Why there is no section.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.message())]
pub enum SectionError {
    /// The image has no such row.
    NoSuchRow {
        /// The requested row.
        row: u32,
        /// The last row.
        last: u32,
    },
    /// The image has no such column.
    NoSuchColumn {
        /// The requested column.
        column: u32,
        /// The last column.
        last: u32,
    },
    /// A line with fewer than two points.
    TooFewSamples,
    /// The observer asked to stop.
    Interrupted,
}

impl SectionError {
    /// What is wrong, in either language.
    #[must_use]
    pub fn message(&self) -> Message {
        match self {
            Self::NoSuchRow { row, last } => {
                message!("there is no row {row}: the image has rows 0 to {last}", row, last)
            }
            Self::NoSuchColumn { column, last } => {
                message!("there is no column {column}: the image has columns 0 to {last}", column, last)
            }
            Self::TooFewSamples => message!("a section needs at least 2 samples"),
            Self::Interrupted => message!("interrupted"),
        }
    }
}

impl PreparedScene {
    /// The values along a line, each traced and summed in double precision, whatever the resolution of any map.
    ///
    /// # Errors
    /// A line that is not in the image.
    pub fn section(&self, line: SectionLine) -> Result<Vec<Sample>, SectionError> {
        self.section_observed(line, None)
    }

    /// As [`section`](Self::section), with an observer, which hears of samples and may end the work.
    ///
    /// # Errors
    /// Those of [`section`](Self::section), or the observer's wish to end.
    pub fn section_observed(
        &self,
        line: SectionLine,
        observer: Option<&dyn Observer>,
    ) -> Result<Vec<Sample>, SectionError> {
        let positions = self.positions(line)?;
        let sample = |position| {
            if observer.is_some_and(|observer| observer.advance(1).is_break()) {
                return Err(SectionError::Interrupted);
            }
            let seen = self.trace(position).map(|hit| (hit, self.shade_colored(&hit, position)));
            Ok(Sample { screen: self.frame().point_on_screen(position), seen })
        };
        positions.into_iter().map(sample).collect()
    }

    /// The shading of a hit; for a scene with colours, its luminance (3.10).
    pub(super) fn shade_colored(&self, hit: &Hit, position: ScreenPosition) -> Shading {
        let shade = |scene: &Self, hit: &Hit| scene.shade(hit, Some(position), |_, _| {});
        let Some(components) = self.components() else { return shade(self, hit) };
        // Each component traces separately, because the accuracy needed depends on its highlights.
        let shading = |scene: &Self| scene.trace(position).map_or_else(|| shade(scene, hit), |hit| shade(scene, &hit));
        Shading::luminance(&components.scenes().map(shading), components.space.luminance_weights())
    }

    fn positions(&self, line: SectionLine) -> Result<Vec<ScreenPosition>, SectionError> {
        let size = self.scene().camera().resolution;
        match line {
            SectionLine::Row(row) if row >= size.height => Err(SectionError::NoSuchRow { row, last: size.height - 1 }),
            SectionLine::Column(column) if column >= size.width => {
                Err(SectionError::NoSuchColumn { column, last: size.width - 1 })
            }
            SectionLine::Between { samples, .. } if samples < 2 => Err(SectionError::TooFewSamples),
            SectionLine::Row(row) => {
                Ok((0..size.width).map(|column| ScreenPosition::PixelCenter(Pixel { column, row })).collect())
            }
            SectionLine::Column(column) => {
                Ok((0..size.height).map(|row| ScreenPosition::PixelCenter(Pixel { column, row })).collect())
            }
            SectionLine::Between { from, to, samples } => {
                let point = |index: u32| {
                    let part = f64::from(index) / f64::from(samples - 1);
                    let between = |axis: usize| from[axis] * (1.0 - part) + to[axis] * part;
                    ScreenPosition::Point { x: between(0), y: between(1) }
                };
                Ok((0..samples).map(point).collect())
            }
        }
    }
}
