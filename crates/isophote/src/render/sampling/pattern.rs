//! How many samples of a pixel are enough, and where they are.

use std::sync::OnceLock;

use crate::hammersley::scrambled_points;

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
        places.get_or_init(|| scrambled_points(count).into_iter().map(|place| place.map(short)).collect())
    }
}

/// The largest difference between the fraction of n points on one side of a straight edge and the fraction of the area,
/// times n^(3/4), where n is a power of two up to 4096.
pub const EDGE_ERROR: f64 = 1.9;

/// The largest error of a mean of this many values over a pixel cut by an edge, where the values on the two sides differ by
/// `contrast`.
pub fn error_bound(contrast: f64, samples: u32) -> f64 {
    EDGE_ERROR * contrast * libm::pow(f64::from(samples), -0.75)
}

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

    /// The area of the unit square where x cosφ + y sinφ ≤ d.
    fn area_below([cosine, sine]: [f64; 2], distance: f64) -> f64 {
        let (longer, shorter) = (cosine.abs().max(sine.abs()), cosine.abs().min(sine.abs()));
        let distance = (distance - cosine.min(0.0) - sine.min(0.0)).clamp(0.0, longer + shorter);
        if shorter < 1e-12 {
            return (distance / longer).min(1.0);
        }
        let square = |part: f64| part.max(0.0) * part.max(0.0);
        let cut = square(distance - longer) + square(distance - shorter) - square(distance - longer - shorter);
        (square(distance) - cut) / (2.0 * longer * shorter)
    }

    /// The largest difference between the fraction of the points on one side of an edge in this direction and the fraction of
    /// the area. It is largest where the edge passes through a point.
    fn edge_error(places: &[[f64; 2]], [cosine, sine]: [f64; 2]) -> f64 {
        let mut distances: Vec<f64> = places.iter().map(|[x, y]| x * cosine + y * sine).collect();
        distances.sort_unstable_by(f64::total_cmp);
        #[expect(clippy::cast_precision_loss, reason = "small")]
        let share = |count: usize| count as f64 / places.len() as f64;
        let mut worst = 0.0_f64;
        for distance in &distances {
            let area = area_below([cosine, sine], *distance);
            // Points on the edge itself, but for rounding, are on either side.
            let before = distances.partition_point(|other| *other < distance - 1e-9);
            let after = distances.partition_point(|other| *other <= distance + 1e-9);
            worst = worst.max((share(before) - area).abs()).max((share(after) - area).abs());
        }
        worst
    }

    /// Directions all around, and those of small whole numbers: along these, points of a regular pattern line up.
    fn directions(turns: u32) -> impl Iterator<Item = [f64; 2]> {
        let turned = (0..turns).map(move |turn| {
            let angle = std::f64::consts::PI * (f64::from(turn) + 0.21) / f64::from(turns);
            [angle.cos(), angle.sin()]
        });
        let whole = (0..=8).flat_map(|down| (-8..=8).map(move |across| [f64::from(across), f64::from(down)]));
        let whole = whole.filter(|[across, down]| across.abs() + down > 0.0);
        turned.chain(whole.map(|[across, down]| [across, down].map(|part| part / across.hypot(down))))
    }

    #[test]
    fn the_error_of_an_edge_is_bounded() {
        let mut worst = 0.0_f64;
        for exponent in 1..=12 {
            let count = 1_u32 << exponent;
            let patterns = Patterns::new(count);
            for direction in directions(200) {
                let scaled = edge_error(patterns.of(count), direction) / error_bound(1.0, count);
                assert!(scaled < 1.0, "{count} points, {direction:?}: {scaled}");
                worst = worst.max(scaled);
            }
        }
        assert!(worst > 0.85, "the bound could be tighter: {worst}");
    }

    /// The sum i + b(i) is the same for √n of n Hammersley points: they lie on the anti-diagonal.
    #[test]
    fn an_edge_along_the_diagonal_of_hammersley_points_is_off_by_half_a_root() {
        let diagonal = [0.5_f64.sqrt(); 2];
        let plain = edge_error(&crate::hammersley::points(1024), diagonal);
        assert!(plain > 0.45 / 1024.0_f64.sqrt(), "{plain}");
    }
}
