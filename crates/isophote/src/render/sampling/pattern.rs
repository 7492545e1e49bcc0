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
    power_of_two(libm::pow(ratio(EDGE_ERROR * contrast, tolerance), 4.0 / 3.0), most)
}

/// A coordinate in few digits, so that adding it to a column loses none.
pub fn short(coordinate: f64) -> f64 {
    (coordinate * 16_777_216.0).round() / 16_777_216.0
}

/// The largest part of a pixel, cut off by a straight edge, that contains none of n points, times n.
const UNDETECTED: f64 = 1.6;

/// How much a part of a pixel may change its mean if it contains none of this many points and its brightness differs by
/// `contrast`.
pub fn undetected_error(contrast: f64, samples: u32) -> f64 {
    UNDETECTED * contrast / f64::from(samples)
}

/// The smallest number of points, a power of two, that detect every part of a pixel, cut off by a straight edge, that changes
/// its mean by more than the tolerance, where the part's brightness differs by `contrast`.
pub fn enough_to_detect(contrast: f64, tolerance: f64, most: u32) -> u32 {
    power_of_two(ratio(UNDETECTED * contrast, tolerance), most)
}

/// Nothing is 0 times as large as a tolerance of 0: that of a colour without any light.
pub fn ratio(error: f64, tolerance: f64) -> f64 {
    if error > 0.0 { error / tolerance } else { 0.0 }
}

/// The smallest power of two that is at least as large, or the maximum.
fn power_of_two(wanted: f64, most: u32) -> u32 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is positive, and at most `most`")]
    let wanted = wanted.min(f64::from(most)).ceil().max(1.0) as u32;
    wanted.next_power_of_two().min(most)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::sampling::edge::Line;
    use crate::render::sampling::range;

    /// The largest difference between the fraction of the points on one side of an edge in this direction and the fraction of
    /// the area. It is largest where the edge passes through a point.
    fn edge_error(places: &[[f64; 2]], [cosine, sine]: [f64; 2]) -> f64 {
        let mut distances: Vec<f64> = places.iter().map(|[x, y]| x * cosine + y * sine).collect();
        distances.sort_unstable_by(f64::total_cmp);
        #[expect(clippy::cast_precision_loss, reason = "small")]
        let share = |count: usize| count as f64 / places.len() as f64;
        let mut worst = 0.0_f64;
        for distance in &distances {
            let area = Line { normal: [cosine, sine], distance: *distance }.area_below();
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

    /// The largest error of an edge in any direction, as a fraction of its bound; none may exceed that.
    fn largest(error: impl Fn(&[[f64; 2]], [f64; 2]) -> f64, bound: impl Fn(f64, u32) -> f64) -> f64 {
        let mut largest = 0.0_f64;
        for exponent in 1..=12 {
            let count = 1_u32 << exponent;
            let patterns = Patterns::new(count);
            for direction in directions(200) {
                let scaled = error(patterns.of(count), direction) / bound(1.0, count);
                assert!(scaled < 1.0, "{count} points, {direction:?}: {scaled}");
                largest = largest.max(scaled);
            }
        }
        largest
    }

    #[test]
    fn the_error_of_an_edge_is_bounded() {
        let largest = largest(edge_error, error_bound);
        assert!(largest > 0.85, "the bound could be tighter: {largest}");
    }

    #[test]
    fn what_no_point_detects_is_bounded() {
        let undetected = |places: &[[f64; 2]], normal: [f64; 2]| {
            let [first, last] = range(places.iter().map(|[x, y]| x * normal[0] + y * normal[1]));
            let area = |distance| Line { normal, distance }.area_below();
            area(first).max(1.0 - area(last))
        };
        let largest = largest(undetected, undetected_error);
        assert!(largest > 0.8, "the bound could be tighter: {largest}");
    }

    /// The sum i + b(i) is the same for √n of n Hammersley points: they lie on the anti-diagonal.
    #[test]
    fn an_edge_along_the_diagonal_of_hammersley_points_is_off_by_half_a_root() {
        let diagonal = [0.5_f64.sqrt(); 2];
        let plain = edge_error(&crate::hammersley::points(1024), diagonal);
        assert!(plain > 0.45 / 1024.0_f64.sqrt(), "{plain}");
    }
}
