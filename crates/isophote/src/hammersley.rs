//! Hammersley points: few of them represent an area well.

/// This many points of the unit square, spread evenly around its middle. Of n = 2^m points, every rectangle of area 1/n
/// whose sides are powers of 1/2 contains exactly one (a (0, m, 2)-net), so that edges in any direction cut off roughly
/// their share of them. One point is the centre.
pub fn points(count: u32) -> Vec<[f64; 2]> {
    let count = count.max(1);
    let shift = 0.5 - (0..count).map(mirrored).sum::<f64>() / f64::from(count);
    (0..count).map(|index| [(f64::from(index) + 0.5) / f64::from(count), mirrored(index) + shift]).collect()
}

/// Like [`points`], with the second coordinate scrambled if n is a power of two; the rectangles of [`points`] still contain one
/// point each. Without scrambling, up to √n points lie on one line: those of i + b(i) = const, and likewise along twice and half
/// that slope. An edge along such a line has nearly all of them on one side, and the fraction of points there is wrong by
/// 1/(2√n).
pub fn scrambled_points(count: u32) -> Vec<[f64; 2]> {
    if !count.is_power_of_two() {
        return points(count);
    }
    let scale = 1.0 / f64::from(count);
    let place = |index: u32| (f64::from(index) + 0.5) * scale;
    let digits = |index: u32| scrambled(index).reverse_bits().checked_shr(count.leading_zeros() + 1).unwrap_or(0);
    (0..count).map(|index| [place(index), place(digits(index))]).collect()
}

/// Flips each bit of a number or not, as its lower bits decide: the hash of S. Laine and T. Karras, "Stratified sampling for
/// stochastic transparency" (EGSR 2011).
fn scrambled(index: u32) -> u32 {
    let mixed = index.wrapping_add(SCRAMBLE);
    [0x6c50_b47c, 0xb82f_1e52, 0xc7af_e638, 0x8d22_f6e6]
        .into_iter()
        .fold(mixed, |mixed, factor: u32| mixed ^ mixed.wrapping_mul(factor))
}

/// Which of the scramblings it is: of several hundred, one with a small error for the worst edge.
const SCRAMBLE: u32 = 1_447_992_097;

/// The bits of a number, reversed behind the binary point.
fn mirrored(index: u32) -> f64 {
    f64::from(index.reverse_bits()) / 4_294_967_296.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_point_is_the_centre() {
        assert_eq!(points(1), [[0.5, 0.5]]);
        assert_eq!(scrambled_points(1), [[0.5, 0.5]]);
    }

    #[test]
    fn the_points_are_spread_evenly_around_the_centre() {
        for (count, make) in [2, 4, 5, 16, 100, 256]
            .into_iter()
            .flat_map(|count| [points, scrambled_points].map(|make: fn(u32) -> Vec<[f64; 2]>| (count, make)))
        {
            let points = make(count);
            assert_eq!(points.len(), count as usize);
            for axis in [0, 1] {
                let mean = points.iter().map(|place| place[axis]).sum::<f64>() / f64::from(count);
                assert!((mean - 0.5).abs() < 1e-12, "{count}: {mean}");
                assert!(points.iter().all(|point| (0.0..1.0).contains(&point[axis])), "{count}");
            }
        }
    }

    #[test]
    fn every_rectangle_of_powers_of_two_holds_one_point() {
        for points in [points(64), scrambled_points(64)] {
            assert_one_in_each_rectangle(&points);
        }
    }

    fn assert_one_in_each_rectangle(points: &[[f64; 2]]) {
        for columns in [1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0_f64] {
            let mut seen = std::collections::HashSet::new();
            for [across, down] in points {
                #[expect(clippy::cast_possible_truncation, reason = "small whole numbers")]
                seen.insert(((across * columns).floor() as i32, (down * 64.0 / columns).floor() as i32));
            }
            assert_eq!(seen.len(), 64, "{columns} columns");
        }
    }
}
