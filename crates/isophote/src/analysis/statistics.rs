//! Extremes and mean of a channel.

use crate::map::{Map, Pixel, Quantity, Scalars};
use crate::real::Sum;

/// Statistics of a scalar channel over the pixels that see a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// The largest value; the first one in reading order where several are equal.
    pub max: Extreme,
    /// The smallest value, likewise.
    pub min: Extreme,
    /// The mean over the visible pixels.
    pub mean: f64,
}

/// An extreme value and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// The value, in the channel's unit.
    pub value: f64,
    /// The pixel of the full image.
    pub pixel: Pixel,
}

/// How many pixels see what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    /// Pixels of the map.
    pub pixels: usize,
    /// Pixels that see a surface.
    pub visible: usize,
    /// Visible pixels to which any light comes; known when the map holds the irradiance.
    pub lit: Option<usize>,
}

/// Statistics of a channel; nothing if no surface is visible, or if the map has no such scalar channel.
#[must_use]
pub fn statistics(map: &Map, quantity: &Quantity) -> Option<Statistics> {
    let values = map.scalar(quantity)?;
    let first = map.mask().indices().next()?;
    let (mut max, mut min) = ((first, values.at(first)), (first, values.at(first)));
    let mut sum = Sum::new();
    let mut count = 0.0;
    for index in map.mask().indices() {
        let value = values.at(index);
        if value > max.1 {
            max = (index, value);
        }
        if value < min.1 {
            min = (index, value);
        }
        sum.add(value);
        count += 1.0;
    }
    let extreme = |(index, value)| Extreme { value, pixel: map.pixel(index) };
    Some(Statistics { max: extreme(max), min: extreme(min), mean: sum.value() / count })
}

/// Counts the pixels of a map.
#[must_use]
pub fn counts(map: &Map) -> Counts {
    let lit = |values: Scalars<'_>| map.mask().indices().filter(|&index| values.at(index) > 0.0).count();
    Counts {
        pixels: map.region.size.pixels(),
        visible: map.mask().visible(),
        lit: map.scalar(&Quantity::Irradiance).map(lit),
    }
}
