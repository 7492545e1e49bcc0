//! The numbers on axes, colour bars and isophotes.

use isophote::analysis::levels::nice_ticks;

use crate::figure::text;

/// Ticks and their labels. A label times 10^exponent is the tick's value.
pub(super) struct Ticks {
    pub(super) values: Vec<f64>,
    pub(super) labels: Vec<String>,
    /// Nonzero if the plain numbers would be long; it is shown in the axis title.
    pub(super) exponent: i32,
}

impl Ticks {
    /// About this many round numbers across the range.
    pub(super) fn new(range: [f64; 2], about: usize) -> Self {
        let exponent = common_exponent(range);
        let values = nice_ticks(range[0], range[1], about);
        Self { labels: written(&values, exponent), values, exponent }
    }

    /// As many ticks along `length` px as leave space between labels written side by side.
    pub(super) fn side_by_side(range: [f64; 2], length: f64, size: f64) -> Self {
        let all_fit = |ticks: &Self| {
            let [first, second, ..] = ticks.values[..] else { return true };
            let pitch = (second - first) / (range[1] - range[0]) * length;
            text::widest(&ticks.labels, size) + 1.2 * size <= pitch
        };
        let wish = usize::max(count(length, 60.0), 2);
        (1..=wish).rev().map(|about| Self::new(range, about)).find(all_fit).unwrap_or_else(|| Self::new(range, 0))
    }

    /// As many ticks along `length` px as look good with labels stacked vertically.
    pub(super) fn stacked(range: [f64; 2], length: f64) -> Self {
        Self::new(range, usize::max(count(length, 60.0), 2))
    }

    /// Ticks of angles along `length` px: as many as leave room for three-digit labels.
    pub(super) fn of_degrees(range: [f64; 2], length: f64) -> Self {
        let fits = |step: &&f64| **step / (range[1] - range[0]) * length >= 38.0;
        let step = DEGREES.iter().find(fits).copied().unwrap_or(360.0);
        let (first, last) = ((range[0] / step).ceil(), (range[1] / step).floor());
        let several =
            std::iter::successors(Some(first), |number| Some(number + 1.0)).take_while(|number| *number <= last);
        let values: Vec<f64> = several.map(|number| number * step).collect();
        Self { labels: written(&values, 0), values, exponent: 0 }
    }
}

/// Tick steps for angles: divisors of a right angle, and 180.
const DEGREES: [f64; 9] = [1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0];

/// Labels for values divided by 10^exponent: all with the same number of decimals, as few as keep them distinct.
pub(super) fn written(values: &[f64], exponent: i32) -> Vec<String> {
    let power = 10_f64.powi(exponent.abs());
    let scaled: Vec<f64> =
        values.iter().map(|value| if exponent < 0 { value * power } else { value / power }).collect();
    let is_enough = |decimals: &usize| {
        let power = 10_f64.powi(i32::try_from(*decimals).unwrap_or(i32::MAX));
        scaled.iter().all(|value| (value * power - (value * power).round()).abs() < 1e-6)
    };
    let decimals = (0..12).find(is_enough).unwrap_or(12);
    scaled.iter().map(|value| format!("{value:.decimals$}").replace('-', "−")).collect()
}

/// A multiple of 3, as in unit prefixes; 0 if the plain numbers are short enough to read.
pub(super) fn common_exponent(range: [f64; 2]) -> i32 {
    let largest = range[0].abs().max(range[1].abs());
    if largest == 0.0 || (1e-3..1e5).contains(&largest) {
        return 0;
    }
    #[expect(clippy::cast_possible_truncation, reason = "the exponent of a finite number")]
    let exponent = largest.log10().floor() as i32;
    exponent.div_euclid(3) * 3
}

/// An axis title: "x, m"; "B, 10⁻⁶ W/m²" if the numbers are divided by 10⁻⁶. Pure numbers have no unit.
pub(super) fn title(label: &str, unit: &str, exponent: i32) -> String {
    let unit = if unit == "1" { "" } else { unit };
    let power = if exponent == 0 { String::new() } else { format!("10{}", superscript(exponent)) };
    let scale = [power.as_str(), unit].iter().filter(|part| !part.is_empty()).copied().collect::<Vec<_>>().join(" ");
    [label, &scale].iter().filter(|part| !part.is_empty()).copied().collect::<Vec<_>>().join(", ")
}

fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |character: char| character.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]);
    exponent.to_string().chars().map(digit).collect()
}

fn count(length: f64, pitch: f64) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few hundred at most")]
    let count = (length / pitch).round().clamp(0.0, 100.0) as usize;
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_share_their_decimals_and_have_a_true_minus() {
        assert_eq!(written(&[-0.5, 0.0, 0.25], 0), ["−0.50", "0.00", "0.25"]);
        assert_eq!(written(&[2e-6, 4e-6], -6), ["2", "4"]);
        assert_eq!(written(&[2.5e6, 5e6], 6), ["2.5", "5.0"]);
    }

    #[test]
    fn long_numbers_move_their_power_into_the_title() {
        for (largest, exponent) in [(0.0, 0), (0.002, 0), (99_999.0, 0), (1e5, 3), (3.2e6, 6), (4e-4, -6), (2e-10, -12)]
        {
            assert_eq!(common_exponent([-largest / 2.0, largest]), exponent, "{largest}");
        }
        assert_eq!(title("B", "W/m²", -12), "B, 10⁻¹² W/m²");
        assert_eq!(title("x", "m", 0), "x, m");
        assert_eq!(title("k_d", "1", 0), "k_d");
        assert_eq!(title("", "", 3), "10³");
    }

    #[test]
    fn numbers_side_by_side_do_not_touch() {
        for length in [60.0, 100.0, 200.0, 500.0] {
            for range in [[0.0, 1.0], [-1234.5, -1234.0], [0.0, 7e-9], [-50_000.0, 90_000.0]] {
                let ticks = Ticks::side_by_side(range, length, 10.0);
                let pitch = ticks.values.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
                assert!(length < 200.0 || ticks.values.len() >= 2, "{range:?} {length}");
                let room = pitch / (range[1] - range[0]) * length;
                assert!(ticks.values.len() < 2 || text::widest(&ticks.labels, 10.0) < room, "{range:?} {length}");
            }
        }
    }
}
