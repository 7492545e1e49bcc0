//! Maps built from given numbers, instead of rendered.

use super::{Channel, Map, Mask, Provenance, Quantity, Region, Resolution, Values, Window};
use crate::message;
use crate::text::Message;

/// A map under construction: [`Map::builder`].
#[derive(Clone, Debug)]
pub struct MapBuilder {
    full: Resolution,
    region: Region,
    window: Window,
    provenance: Provenance,
    shapes: Option<Vec<i32>>,
    channels: Vec<Channel>,
}

/// Why these channels do not make a map.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.message())]
pub enum MapError {
    /// The region does not lie in the image.
    Region {
        /// The requested region.
        region: Region,
    },
    /// A channel with too few or too many values.
    Length {
        /// The channel.
        name: String,
        /// How many values it has.
        values: usize,
        /// How many it should have.
        pixels: usize,
    },
    /// A value where there is no surface.
    Background {
        /// The channel.
        name: String,
        /// The first such pixel: row × width + column.
        index: usize,
    },
    /// Nothing tells which shapes are seen where.
    NoShape,
    /// Contradictory data about the shapes that are seen.
    OtherShape {
        /// The first such pixel: row × width + column.
        index: usize,
    },
}

impl MapError {
    /// What is wrong, in either language.
    #[must_use]
    pub fn message(&self) -> Message {
        match self {
            Self::Region { region } => message!(
                "the region of {width} × {height} pixels from column {column}, row {row} does not lie in the image",
                width = region.size.width,
                height = region.size.height,
                column = region.corner.column,
                row = region.corner.row
            ),
            Self::Length { name, values, pixels } => {
                message!("the channel ‘{name}’ has {values} values for {pixels} pixels", name, values, pixels)
            }
            Self::Background { name, index } => {
                message!("the channel ‘{name}’ is not 0 at pixel {index}, where no surface is seen", name, index)
            }
            Self::NoShape => message!("there is no channel ‘shape’ with an index for each pixel"),
            Self::OtherShape { index } => {
                message!("the channel ‘shape’ is not what is seen at pixel {index}", index)
            }
        }
    }
}

impl Map {
    /// Starts a map of an image of this size: of the whole image, unless a region is set. The window is that of the region.
    #[must_use]
    pub fn builder(full: Resolution, window: Window, provenance: Provenance) -> MapBuilder {
        MapBuilder { full, region: Region::all(full), window, provenance, shapes: None, channels: vec![] }
    }
}

impl MapBuilder {
    /// The part of the image that the map holds.
    #[must_use]
    pub fn region(mut self, region: Region) -> Self {
        self.region = region;
        self
    }

    /// The index of the shape that each pixel sees, −1 where there is none: for maps without a shape channel.
    #[must_use]
    pub fn shapes(mut self, shapes: Vec<i32>) -> Self {
        self.shapes = Some(shapes);
        self
    }

    /// Adds a channel after the existing ones: row by row from the top, 0 (−1 for indices) where no surface is seen.
    #[must_use]
    pub fn channel(mut self, quantity: Quantity, unit: &str, values: Values) -> Self {
        self.channels.push(Channel { quantity, unit: unit.into(), values });
        self
    }

    /// Builds the map.
    ///
    /// # Errors
    /// A region that is not in the image; channels whose lengths differ from its number of pixels; missing or contradictory
    /// data about the shapes that are seen; a value where there is no surface.
    pub fn build(mut self) -> Result<Map, MapError> {
        self.check_region()?;
        self.check_lengths()?;
        let shapes = self.shapes.take();
        let seen = shapes.as_deref().or_else(|| shape_channel(&self.channels)).ok_or(MapError::NoShape)?;
        self.check_values(seen)?;
        let mask = Mask::of_shapes(self.region.size, seen);
        let Self { full, region, window, provenance, channels, .. } = self;
        let whole = whole(full, region, window);
        Ok(Map { full, region, window, whole, provenance, over_tolerance: None, mask, channels })
    }

    fn check_region(&self) -> Result<(), MapError> {
        let Region { corner, size } = self.region;
        let lies_in = |start: u32, length: u32, whole: u32| start.checked_add(length).is_some_and(|end| end <= whole);
        let is_inside =
            lies_in(corner.column, size.width, self.full.width) && lies_in(corner.row, size.height, self.full.height);
        if is_inside { Ok(()) } else { Err(MapError::Region { region: self.region }) }
    }

    fn check_lengths(&self) -> Result<(), MapError> {
        let pixels = self.region.size.pixels();
        let channels = self.channels.iter().map(|channel| (channel.quantity.name(), channel.values.len()));
        let shapes = self.shapes.iter().map(|shapes| (Quantity::Shape.name(), shapes.len()));
        match channels.chain(shapes).find(|(_, values)| *values != pixels) {
            Some((name, values)) => Err(MapError::Length { name, values, pixels }),
            None => Ok(()),
        }
    }

    fn check_values(&self, seen: &[i32]) -> Result<(), MapError> {
        for channel in &self.channels {
            let is_empty = |index: usize| match &channel.values {
                Values::Scalar(values) => values[index] == 0.0,
                Values::Single(values) => values[index] == 0.0,
                Values::Vector(values) => values[index] == [0.0; 3],
                Values::Index(values) => values[index] < 0,
            };
            if let Some(index) = (0..seen.len()).find(|&index| seen[index] < 0 && !is_empty(index)) {
                return Err(MapError::Background { name: channel.quantity.name(), index });
            }
        }
        let told = shape_channel(&self.channels).unwrap_or(seen);
        match (0..seen.len()).find(|&index| seen[index] >= 0 && told[index] != seen[index]) {
            Some(index) => Err(MapError::OtherShape { index }),
            None => Ok(()),
        }
    }
}

/// The window of the whole image, from that of a part.
fn whole(full: Resolution, region: Region, window: Window) -> Window {
    let Region { corner, size } = region;
    let beyond = |[first, last]: [f64; 2], before: u32, length: u32, whole: u32| {
        if length == whole {
            return [first, last];
        }
        let step = (last - first) / f64::from(length);
        [first - step * f64::from(before), last + step * f64::from(whole - before - length)]
    };
    let [bottom, top] = window.y;
    let [top, bottom] = beyond([top, bottom], corner.row, size.height, full.height);
    Window { x: beyond(window.x, corner.column, size.width, full.width), y: [bottom, top], ..window }
}

fn shape_channel(channels: &[Channel]) -> Option<&[i32]> {
    channels.iter().find_map(|channel| match &channel.values {
        Values::Index(shapes) if channel.quantity == Quantity::Shape => Some(shapes.as_slice()),
        _ => None,
    })
}

#[cfg(test)]
mod tests;
