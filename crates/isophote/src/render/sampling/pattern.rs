//! How many samples of a pixel are enough, and where they are.

use std::sync::OnceLock;

use crate::hammersley::points;

/// The sample positions in a pixel, for every sample count that [`enough`] may return; computed on first use.
pub struct Patterns(Vec<(u32, OnceLock<Vec<[f64; 2]>>)>);

impl Patterns {
    /// For up to this many samples.
    pub fn new(most: u32) -> Self {
        let powers = (0..32).map(|exponent| 1_u32 << exponent).take_while(|count| *count < most);
        Self(powers.chain([most]).map(|count| (count, OnceLock::new())).collect())
    }

    /// The positions of this many samples: a power of two, or the maximum.
    pub fn of(&self, count: u32) -> &[[f64; 2]] {
        let (_, places) = self.0.iter().find(|(known, _)| *known == count).expect("a power of two, or the most");
        // Few digits, so that adding them to a column loses none.
        let short = |part: f64| (part * 16_777_216.0).round() / 16_777_216.0;
        places.get_or_init(|| points(count).into_iter().map(|place| place.map(short)).collect())
    }
}

/// The largest difference between the fraction of n points on one side of a straight edge and the fraction of the area,
/// times n^(3/4), for up to 1024 points. The worst edges run along the diagonal.
pub const EDGE_ERROR: f64 = 1.7;

/// The smallest number of points, a power of two, that bounds the error of the mean over a pixel cut by an edge, where the
/// values on the two sides differ by `contrast`.
pub fn enough(contrast: f64, tolerance: f64, most: u32) -> u32 {
    let wanted = libm::pow(EDGE_ERROR * contrast / tolerance, 4.0 / 3.0).min(f64::from(most));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is positive, and at most `most`")]
    let wanted = wanted.ceil().max(1.0) as u32;
    wanted.next_power_of_two().min(most)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The area of the unit square where `x cosφ + y sinφ < d`, by a fine sum over columns.
    fn area_below(angle: f64, distance: f64) -> f64 {
        let (sine, cosine) = angle.sin_cos();
        let steps = 4000;
        let column = |index: u32| {
            let x = (f64::from(index) + 0.5) / f64::from(steps);
            let edge = (distance - x * cosine) / sine;
            if sine > 0.0 { edge.clamp(0.0, 1.0) } else { 1.0 - edge.clamp(0.0, 1.0) }
        };
        (0..steps).map(column).sum::<f64>() / f64::from(steps)
    }

    #[test]
    fn the_error_of_an_edge_is_bounded() {
        let mut worst = 0.0_f64;
        for count in [4, 8, 16, 32, 64, 128, 256, 512, 1024] {
            let places = points(count);
            for turn in 1..180 {
                let angle = (f64::from(turn) + 0.21).to_radians() * 2.0;
                let (sine, cosine) = angle.sin_cos();
                for step in 0..40 {
                    let distance = (f64::from(step) + 0.37) / 40.0 * 3.0 - 1.5;
                    let below = places.iter().filter(|[x, y]| x * cosine + y * sine < distance).count();
                    #[expect(clippy::cast_precision_loss, reason = "small")]
                    let share = below as f64 / f64::from(count);
                    let error = (share - area_below(angle, distance)).abs();
                    worst = worst.max(error * f64::from(count).powf(0.75));
                }
            }
        }
        assert!(worst < EDGE_ERROR, "{worst}");
        assert!(worst > 0.6 * EDGE_ERROR, "the bound could be tighter: {worst}");
    }
}
