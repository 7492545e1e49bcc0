//! Hammersley points: few of them represent an area well.

/// This many points of the unit square, spread evenly around its middle. Of n = 2^m points, every rectangle of area 1/n
/// whose sides are powers of 1/2 contains exactly one (a (0, m, 2)-net), so that edges in any direction cut off roughly
/// their share of them. One point is the centre.
pub fn points(count: u32) -> Vec<[f64; 2]> {
    let count = count.max(1);
    let shift = 0.5 - (0..count).map(mirrored).sum::<f64>() / f64::from(count);
    (0..count).map(|index| [(f64::from(index) + 0.5) / f64::from(count), mirrored(index) + shift]).collect()
}

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
    }

    #[test]
    fn the_points_are_spread_evenly_around_the_centre() {
        for count in [2, 4, 5, 16, 100, 256] {
            let points = points(count);
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
        let points = points(64);
        for columns in [1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0_f64] {
            let mut seen = std::collections::HashSet::new();
            for [across, down] in &points {
                #[expect(clippy::cast_possible_truncation, reason = "small whole numbers")]
                seen.insert(((across * columns).floor() as i32, (down * 64.0 / columns).floor() as i32));
            }
            assert_eq!(seen.len(), 64, "{columns} columns");
        }
    }
}
