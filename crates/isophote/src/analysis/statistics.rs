//! Extremes and mean of a channel.

pub use crate::map::{Extreme, Totals, totals};
use crate::map::{Map, Mask, Quantity, Run, Scalars};

/// Statistics of a scalar channel over the pixels that see a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// The largest value; the first in reading order if several are equal.
    pub max: Extreme,
    /// The smallest value, likewise.
    pub min: Extreme,
    /// The mean over the visible pixels.
    pub mean: f64,
}

/// Numbers of pixels by what they see.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    /// Pixels of the map.
    pub pixels: usize,
    /// Pixels that see a surface.
    pub visible: usize,
    /// Visible pixels that receive any light; known if the map holds the irradiance.
    pub lit: Option<usize>,
}

/// Statistics of a channel; `None` if no surface is visible, or if the map has no such scalar channel.
///
#[must_use]
pub fn statistics(map: &Map, quantity: &Quantity) -> Option<Statistics> {
    let Totals { max, min, sum } = totals(map, quantity)?;
    #[expect(clippy::cast_precision_loss, reason = "an image has fewer than 2^53 pixels")]
    let count = map.mask().visible() as f64;
    Some(Statistics { max, min, mean: sum / count })
}

/// The largest value among pixels that see a surface; `None` if there are none.
#[must_use]
pub fn largest(mask: &Mask, values: Scalars<'_>) -> Option<f64> {
    let of_run = |run: &Run| match values {
        Scalars::Double(values) => largest_of(&values[run.start..run.end]),
        Scalars::Single(values) => largest_of(&values[run.start..run.end]),
    };
    mask.runs().iter().map(of_run).reduce(f64::max)
}

/// The smallest value among pixels that see a surface; `None` if there are none.
#[must_use]
pub fn smallest(mask: &Mask, values: Scalars<'_>) -> Option<f64> {
    let of_run = |run: &Run| match values {
        Scalars::Double(values) => smallest_of(&values[run.start..run.end]),
        Scalars::Single(values) => smallest_of(&values[run.start..run.end]),
    };
    mask.runs().iter().map(of_run).reduce(f64::min)
}

/// Counts the pixels of a map.
#[must_use]
pub fn counts(map: &Map) -> Counts {
    let mask = map.mask();
    let lit_in_run = |values: Scalars<'_>, run: &Run| match values {
        Scalars::Double(values) => positive(&values[run.start..run.end]),
        Scalars::Single(values) => positive(&values[run.start..run.end]),
    };
    let lit = |values| mask.runs().iter().map(|run| lit_in_run(values, run)).sum();
    Counts {
        pixels: map.region.size.pixels(),
        visible: mask.visible(),
        lit: map.scalar(&Quantity::Irradiance).map(lit),
    }
}

fn largest_of<T: Copy + Into<f64>>(values: &[T]) -> f64 {
    let larger = |largest: f64, value: &T| if (*value).into() > largest { (*value).into() } else { largest };
    values.iter().fold(f64::NEG_INFINITY, larger)
}

fn smallest_of<T: Copy + Into<f64>>(values: &[T]) -> f64 {
    let smaller = |smallest: f64, value: &T| if (*value).into() < smallest { (*value).into() } else { smallest };
    values.iter().fold(f64::INFINITY, smaller)
}

fn positive<T: Copy + Into<f64>>(values: &[T]) -> usize {
    values.iter().filter(|value| (**value).into() > 0.0).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::Values;
    use crate::sample_map::{Seen, square_map};
    use crate::sum::Sum;

    /// Runs of every length from 0 to 37, at both ends of rows; each extreme occurs twice.
    fn sample() -> Map {
        let value = |x: f64, y: f64| 2.0 + (3.0 * x).sin() * (5.0 * y).cos();
        let mut map =
            square_map(37, 37.0, |x, y| (x.abs() > y).then(|| Seen { brightness: value(x.abs(), y), shape: 0 }));
        map.channels[0].quantity = Quantity::Irradiance;
        map
    }

    fn seen(map: &Map) -> Vec<(usize, f64)> {
        let values = map.scalar(&Quantity::Irradiance).unwrap();
        map.mask().indices().map(|index| (index, values.at(index))).collect()
    }

    #[test]
    fn extremes_are_the_first_ones_and_the_mean_is_that_of_all_visible_pixels() {
        let map = sample();
        let seen = seen(&map);
        let found = statistics(&map, &Quantity::Irradiance).unwrap();
        let highest = seen.iter().map(|(_, value)| *value).fold(f64::MIN, f64::max);
        let lowest = seen.iter().map(|(_, value)| *value).fold(f64::MAX, f64::min);
        let first = |wanted: f64| map.pixel(seen.iter().find(|(_, value)| *value == wanted).unwrap().0);
        assert_eq!(found.max, Extreme { value: highest, pixel: first(highest) });
        assert_eq!(found.min, Extreme { value: lowest, pixel: first(lowest) });
        let mut sum = Sum::<f64>::new();
        for (_, value) in &seen {
            sum.add(*value);
        }
        #[expect(clippy::cast_precision_loss, reason = "a small map")]
        let mean = sum.value() / seen.len() as f64;
        assert!((found.mean - mean).abs() <= mean * f64::EPSILON, "{} {mean}", found.mean);
        assert_eq!(largest(map.mask(), map.scalar(&Quantity::Irradiance).unwrap()), Some(highest));
        assert_eq!(smallest(map.mask(), map.scalar(&Quantity::Irradiance).unwrap()), Some(lowest));
    }

    #[test]
    #[expect(clippy::cast_possible_truncation, reason = "rounded first to what single precision has exactly")]
    fn single_precision_has_the_statistics_of_its_values() {
        let mut map = sample();
        let exact = |value: f64| f64::from((value * 64.0).round() as i16) / 64.0;
        let Values::Scalar(values) = &mut map.channels[0].values else { panic!("the sample is in double precision") };
        for value in values {
            *value = exact(*value);
        }
        let (double, counted) = (statistics(&map, &Quantity::Irradiance), counts(&map));
        let Values::Scalar(values) = &map.channels[0].values else { unreachable!("it was above") };
        map.channels[0].values = Values::Single(values.iter().map(|value| *value as f32).collect());
        assert_eq!(statistics(&map, &Quantity::Irradiance), double);
        assert_eq!(counts(&map), counted);
        assert_eq!(counted.lit, Some(seen(&map).iter().filter(|(_, value)| *value > 0.0).count()));
    }

    #[test]
    fn a_map_without_a_surface_has_no_statistics() {
        let map = square_map(3, 1.0, |_, _| None);
        assert_eq!(statistics(&map, &Quantity::Brightness), None);
        assert_eq!(counts(&map), Counts { pixels: 9, visible: 0, lit: None });
    }
}
