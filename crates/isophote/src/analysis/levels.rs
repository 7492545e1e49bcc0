//! Round numbers for contour levels and axis ticks: multiples of 1, 2, 2.5 or 5 times a power of ten.

/// Contour levels: round numbers strictly between `minimum` and `maximum`, as close in number to `about` as the steps 1, 2,
/// 2.5 and 5 times a power of ten allow.
///
/// Empty if there is nothing to divide: `about` is 0, or the bounds are equal, reversed or not finite.
#[must_use]
pub fn nice_levels(minimum: f64, maximum: f64, about: usize) -> Vec<f64> {
    multiples_near(minimum, maximum, about, Ends::Excluded)
}

/// Ticks of an axis: like [`nice_levels`], but including round numbers at either end.
#[must_use]
pub fn nice_ticks(minimum: f64, maximum: f64, about: usize) -> Vec<f64> {
    multiples_near(minimum, maximum, about, Ends::Included)
}

#[derive(Clone, Copy)]
enum Ends {
    Included,
    Excluded,
}

/// The step (mantissa · 10^exponent) between successive round numbers.
#[derive(Clone, Copy)]
struct Step {
    mantissa: f64,
    exponent: i32,
}

impl Step {
    /// The nth multiple, rounded once: 3 · 0.1 is 0.3 and not 0.30000000000000004.
    fn multiple(self, n: f64) -> f64 {
        let power = 10_f64.powi(self.exponent.abs());
        if self.exponent < 0 { n * self.mantissa / power } else { n * self.mantissa * power }
    }

    fn multiples(self, minimum: f64, maximum: f64, ends: Ends) -> Vec<f64> {
        let size = self.multiple(1.0);
        // Bounds result from arithmetic: one that differs from a round number only by rounding counts as that number.
        let slack = match ends {
            Ends::Included => 1e-9,
            Ends::Excluded => -1e-9,
        };
        let first = (minimum / size - slack).ceil();
        let last = (maximum / size + slack).floor();
        let numbers = std::iter::successors(Some(first), |n| Some(n + 1.0)).take_while(|n| *n <= last);
        // Adding zero turns −0 into 0; −0 would be written with a minus sign.
        numbers.map(|n| self.multiple(n) + 0.0).collect()
    }
}

fn multiples_near(minimum: f64, maximum: f64, about: usize, ends: Ends) -> Vec<f64> {
    let span = maximum - minimum;
    // A span that is only rounding noise of its bounds has no round numbers inside.
    let resolvable = span > 1e-12 * minimum.abs().max(maximum.abs()) && span.is_normal();
    if about == 0 || !resolvable {
        return Vec::new();
    }
    #[expect(clippy::cast_precision_loss, reason = "a count of ticks")]
    let rough = span / about as f64;
    #[expect(clippy::cast_possible_truncation, reason = "the exponent of a finite number")]
    let exponent = rough.log10().floor() as i32;
    let steps = [(0, 1.0), (0, 2.0), (0, 2.5), (0, 5.0), (1, 1.0), (1, 2.0)];
    let rows =
        steps.map(|(shift, mantissa)| Step { mantissa, exponent: exponent + shift }.multiples(minimum, maximum, ends));
    // Of equal candidates, `min_by_key` returns the first: the finer step.
    rows.into_iter().min_by_key(|row| row.len().abs_diff(about)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_round_and_strictly_inside() {
        assert_eq!(nice_levels(0.0, 1.0, 4), [0.2, 0.4, 0.6, 0.8]);
        assert_eq!(nice_levels(0.0, 1.0, 9), [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]);
        assert_eq!(nice_levels(-10.0, 10.0, 7), [-7.5, -5.0, -2.5, 0.0, 2.5, 5.0, 7.5]);
        assert_eq!(nice_levels(3e-7, 9e-7, 5), [4e-7, 5e-7, 6e-7, 7e-7, 8e-7]);
        assert_eq!(nice_levels(0.0, 0.1 + 0.2, 2), [0.1, 0.2], "0.30000000000000004 is the end itself");
    }

    #[test]
    fn nothing_to_divide_gives_no_level() {
        for (minimum, maximum, about) in [
            (1.0, 1.0, 5),
            (2.0, 1.0, 5),
            (0.0, 1.0, 0),
            (f64::NAN, 1.0, 5),
            (0.0, f64::INFINITY, 5),
            (1.0, 1.0 + 1e-15, 5),
        ] {
            assert!(nice_levels(minimum, maximum, about).is_empty(), "{minimum} {maximum} {about}");
        }
    }

    #[test]
    fn the_count_stays_near_the_wish_over_many_ranges() {
        for index in 1..2000_u32 {
            let minimum = f64::from(index % 37) * 0.37 - 5.0;
            let maximum = minimum + f64::from(index) * 10_f64.powi(i32::try_from(index % 9).unwrap() - 4);
            for about in 2..15 {
                let count = nice_levels(minimum, maximum, about).len();
                assert!(count.abs_diff(about) <= about / 3 + 1, "{count} for {about} in {minimum}..{maximum}");
            }
        }
    }

    #[test]
    fn ticks_keep_round_ends_and_write_zero_without_a_sign() {
        let ticks = nice_ticks(-1.5, 1.5, 7);
        assert_eq!(ticks, [-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5]);
        assert!(ticks[3].is_sign_positive());
        assert_eq!(nice_ticks(0.0, 0.1 + 0.2, 4), [0.0, 0.1, 0.2, 0.3]);
    }
}
