//! Where the samples of a pixel are.

/// Places within a pixel, as parts of its width and height from its upper left corner: Hammersley's points, the same in
/// every pixel. Of n = 2^m points, every rectangle of 1/n of the pixel whose sides are powers of 1/2 holds exactly one
/// (a (0, m, 2)-net), so that edges of any direction cut off about their share of them. One point is the centre.
pub fn places(count: u32) -> Vec<[f64; 2]> {
    let count = count.max(1);
    let levels = count.next_power_of_two();
    let place = |index: u32| {
        let across = (f64::from(index) + 0.5) / f64::from(count);
        // The bits of the index, mirrored at the binary point, and half of the last place.
        let down = f64::from(index.reverse_bits()) / 4_294_967_296.0 + 0.5 / f64::from(levels);
        [across, down]
    };
    (0..count).map(place).collect()
}

/// How far the share of the points on one side of a straight edge may be from the share of the area, times n^(3/4).
pub const EDGE_ERROR: f64 = 0.75;

/// The least number of points, a power of two, that bounds the error of the mean over a pixel that an edge cuts: the
/// values on both sides differ by `contrast`.
pub fn enough(contrast: f64, tolerance: f64, most: u32) -> u32 {
    let wanted = libm::pow(EDGE_ERROR * contrast / tolerance, 4.0 / 3.0).min(f64::from(most));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is positive, and at most `most`")]
    let wanted = wanted.ceil().max(1.0) as u32;
    wanted.next_power_of_two().min(most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_sample_is_the_centre_of_the_pixel() {
        assert_eq!(places(1), [[0.5, 0.5]]);
    }

    #[test]
    fn the_samples_are_spread_evenly_around_the_centre() {
        for count in [2, 4, 5, 16, 100, 256] {
            let places = places(count);
            assert_eq!(places.len(), count as usize);
            for axis in [0, 1] {
                let mean = places.iter().map(|place| place[axis]).sum::<f64>() / f64::from(count);
                assert!((mean - 0.5).abs() < 0.5 / f64::from(count), "{count}: {mean}");
            }
        }
    }

    #[test]
    fn every_rectangle_of_powers_of_two_holds_one_point() {
        let places = places(64);
        for columns in [1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0_f64] {
            let mut seen = std::collections::HashSet::new();
            for [across, down] in &places {
                #[expect(clippy::cast_possible_truncation, reason = "small whole numbers")]
                seen.insert(((across * columns).floor() as i32, (down * 64.0 / columns).floor() as i32));
            }
            assert_eq!(seen.len(), 64, "{columns} columns");
        }
    }

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
        for count in [4, 8, 16, 32, 64, 128, 256] {
            let places = places(count);
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
