//! Extremes and sum of a channel.

use super::{Map, Pixel, Quantity, Scalars};
use crate::sum::Sum;

/// The extremes and the sum from which the statistics of a part of an image are computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Totals {
    /// The largest value; the first in reading order if several are equal.
    pub max: Extreme,
    /// The smallest value, likewise.
    pub min: Extreme,
    /// The sum over the visible pixels.
    pub sum: f64,
}

/// An extreme value and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// The value, in the channel's unit.
    pub value: f64,
    /// The pixel of the full image.
    pub pixel: Pixel,
}

/// Extremes and sum of a channel; `None` if no surface is visible, or if the map has no such scalar channel.
///
/// The sum is made of eight compensated sums: the i-th pixel of a run goes into sum i mod 8, and finally the eight are added
/// in order, also with compensation. The result is the same on every machine.
#[must_use]
pub fn totals(map: &Map, quantity: &Quantity) -> Option<Totals> {
    match map.scalar(quantity)? {
        Scalars::Double(values) => totals_of(map, values),
        Scalars::Single(values) => totals_of(map, values),
    }
}

fn totals_of<T: Copy + Into<f64>>(map: &Map, values: &[T]) -> Option<Totals> {
    let mask = map.mask();
    let first = mask.runs().first()?.start;
    let (mut max, mut min) = ((first, values[first].into()), (first, values[first].into()));
    let mut sums = EightSums::default();
    for run in mask.runs() {
        let values = &values[run.start..run.end];
        let find = |extreme: f64| run.start + values.iter().position(|value| (*value).into() == extreme).unwrap_or(0);
        let [low, high] = sums.add(values);
        if high > max.1 {
            max = (find(high), high);
        }
        if low < min.1 {
            min = (find(low), low);
        }
    }
    let extreme = |(index, value)| Extreme { value, pixel: map.pixel(index) };
    Some(Totals { max: extreme(max), min: extreme(min), sum: sums.total() })
}

/// The number of values processed at once: the compiler turns loops over arrays of this size into SIMD, but not loops over a
/// [`Sum`] each.
const LANES: usize = 8;

/// Compensated sums, as [`Sum`] makes them: the i-th value goes into lane i mod [`LANES`].
#[derive(Default)]
struct EightSums {
    totals: [f64; LANES],
    lost: [f64; LANES],
}

impl EightSums {
    /// Adds the values; returns the smallest and the largest of them.
    fn add<T: Copy + Into<f64>>(&mut self, values: &[T]) -> [f64; 2] {
        let (mut low, mut high) = ([f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]);
        let mut add = |lane: usize, value: f64| {
            low[lane] = if value < low[lane] { value } else { low[lane] };
            high[lane] = if value > high[lane] { value } else { high[lane] };
            let total = self.totals[lane] + value;
            let kept = total - self.totals[lane];
            self.lost[lane] += (self.totals[lane] - (total - kept)) + (value - kept);
            self.totals[lane] = total;
        };
        let (blocks, rest) = values.as_chunks::<LANES>();
        for block in blocks {
            for (lane, value) in block.iter().enumerate() {
                add(lane, (*value).into());
            }
        }
        for (lane, value) in rest.iter().enumerate() {
            add(lane, (*value).into());
        }
        [low.into_iter().fold(f64::INFINITY, f64::min), high.into_iter().fold(f64::NEG_INFINITY, f64::max)]
    }

    fn total(&self) -> f64 {
        let mut sum = Sum::new();
        for term in self.totals.iter().chain(&self.lost) {
            sum.add(*term);
        }
        sum.value()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lane_keeps_what_plain_addition_loses() {
        let mut sums = EightSums::default();
        sums.add(&[1.0; LANES]);
        sums.add(&vec![1e-17; 1_000_000 * LANES]);
        assert_eq!(sums.total(), 8.0 * (1.0 + 1e-11));
    }
}
