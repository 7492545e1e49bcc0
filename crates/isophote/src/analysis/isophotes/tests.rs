use super::*;
use crate::sample_map::{Seen, everywhere, square_map};

fn contour(map: &Map, level: f64) -> Vec<Polyline> {
    isophotes(map, &Quantity::Brightness, &[level]).unwrap().remove(0).lines
}

fn radii(line: &Polyline) -> impl Iterator<Item = f64> {
    line.points.iter().map(|point| point.x.hypot(point.y))
}

#[test]
fn a_paraboloid_gives_circles_to_the_square_of_the_pixel_size() {
    for pixels in [20, 40, 80, 160, 320] {
        let map = square_map(pixels, 1.0, everywhere(|x, y| x * x + y * y));
        let pitch = 2.0 / f64::from(pixels);
        for radius in [0.31, 0.5, 0.77] {
            let lines = contour(&map, radius * radius);
            assert_eq!(lines.len(), 1);
            assert!(lines[0].closed);
            // On an edge of length h the chord of t² is off by h²/8 · f'' = h²/4 in f, that is h²/(8r) in r.
            let error = radii(&lines[0]).map(|r| (r - radius).abs()).fold(0.0, f64::max);
            assert!(error <= 1.1 * pitch * pitch / (8.0 * radius), "{error:e} at {pixels} pixels");
            assert!(error > 0.0);
        }
    }
}

#[test]
fn a_spheres_cosine_gives_circles_of_the_sine() {
    // Seen along the axis from far away, and lit from the eye: cosθ = √(1 − r²) on the unit disc.
    let map = square_map(400, 1.2, |x, y| {
        let square = 1.0 - x * x - y * y;
        (square > 0.0).then(|| Seen { brightness: square.sqrt(), shape: 0 })
    });
    for cosine in [0.3_f64, 0.5, 0.8, 0.95] {
        let sine = (1.0 - cosine * cosine).sqrt();
        let lines = contour(&map, cosine);
        assert_eq!(lines.len(), 1, "cosθ = {cosine}");
        assert!(lines[0].closed);
        // As for the paraboloid: h²/8 times the second derivative 1/cos³, over the slope sin/cos; h = 0.006.
        let bound = 1.1 * 0.006 * 0.006 / (8.0 * cosine * cosine * sine);
        assert!(radii(&lines[0]).all(|r| (r - sine).abs() < bound), "cosθ = {cosine}");
    }
}

#[test]
fn a_plane_gives_a_straight_line_that_stops_at_the_outer_pixel_centres() {
    let map = square_map(10, 1.0, everywhere(|x, y| x + 2.0 * y));
    let lines = contour(&map, 0.33);
    assert_eq!(lines.len(), 1);
    assert!(!lines[0].closed);
    assert!(lines[0].points.iter().all(|point| (point.x + 2.0 * point.y - 0.33).abs() < 1e-14));
    // Higher values lie to the left, so the line runs from left to right.
    let (first, last) = (lines[0].points[0], lines[0].points[lines[0].points.len() - 1]);
    assert!((first.x + 0.9).abs() < 1e-14 && (last.x - 0.9).abs() < 1e-14, "{first:?} {last:?}");
}

#[test]
fn higher_values_lie_to_the_left() {
    let map = square_map(64, 1.0, everywhere(|x, y| (3.0 * x).sin() * (2.0 * y + 0.3).cos()));
    for level in [-0.6, -0.2, 0.1, 0.5] {
        for line in contour(&map, level) {
            for pair in line.points.windows(2) {
                let (dx, dy) = (pair[1].x - pair[0].x, pair[1].y - pair[0].y);
                let (x, y) = (f64::midpoint(pair[0].x, pair[1].x), f64::midpoint(pair[0].y, pair[1].y));
                let along = |t: f64| (3.0 * (x - t * dy)).sin() * (2.0 * (y + t * dx) + 0.3).cos();
                assert!(along(0.1) >= along(-0.1), "at {x}, {y}");
            }
        }
    }
}

#[test]
fn a_saddle_goes_the_way_of_the_bilinear_interpolant() {
    // One cell; clockwise from the top left the corners are 1, 0, 1, s, and the saddle value is (1 − 0)/(2 − s).
    for (corner, level, joined) in [(0.2, 0.5, true), (0.2, 0.6, false), (-3.0, 0.25, false), (-3.0, 0.15, true)] {
        let map = square_map(
            2,
            1.0,
            everywhere(|x, y| {
                if x * y < 0.0 {
                    1.0
                } else if x > 0.0 {
                    0.0
                } else {
                    corner
                }
            }),
        );
        let lines = contour(&map, level);
        assert_eq!(lines.len(), 2);
        // The higher corners are the top left and the bottom right: if they are joined, no piece goes round the top left.
        let goes_round_top_left = lines.iter().any(|line| {
            let on_left = line.points.iter().any(|point| (point.x + 0.5).abs() < 1e-12);
            on_left && line.points.iter().any(|point| (point.y - 0.5).abs() < 1e-12)
        });
        assert_eq!(goes_round_top_left, !joined, "corner {corner}, level {level}");
    }
}

#[test]
fn a_saddle_surface_gives_two_hyperbola_branches() {
    let map = square_map(81, 1.0, everywhere(|x, y| x * y));
    for level in [0.04, -0.04] {
        let lines = contour(&map, level);
        assert_eq!(lines.len(), 2);
        assert!(lines.iter().all(|line| !line.closed));
        let points = lines.iter().flat_map(|line| &line.points);
        assert!(points.clone().count() > 80);
        // x·y is linear along every edge, so the crossings are exact.
        assert!(points.clone().all(|point| (point.x * point.y - level).abs() < 1e-14));
    }
}

#[test]
fn no_contour_touches_a_cell_with_a_missed_pixel_or_two_shapes() {
    // A steep step at the silhouette of shape 1 in front of shape 0, and a hole.
    let map = square_map(50, 1.0, |x, y| {
        let hole = (x + 0.5).hypot(y) < 0.2;
        let shape = i32::from(x > 0.1);
        (!hole).then_some(Seen { brightness: f64::from(shape) + 0.1 * y, shape })
    });
    assert!(contour(&map, 0.5).is_empty(), "the step is a silhouette, not a slope");
    let lines = contour(&map, 0.0);
    assert_eq!(lines.len(), 2, "y = 0 on shape 0, cut in two by the hole");
    for point in lines.iter().flat_map(|line| &line.points) {
        assert!(point.x < 0.1 && (point.x + 0.5).abs() > 0.15, "{point:?}");
    }
}

#[test]
fn nothing_to_draw_gives_no_line() {
    let constant = square_map(8, 1.0, everywhere(|_, _| 3.0));
    assert!(contour(&constant, 3.0).is_empty());
    assert!(contour(&constant, 2.0).is_empty());
    let slope = square_map(8, 1.0, everywhere(|x, _| x));
    for level in [-2.0, 2.0] {
        assert!(contour(&slope, level).is_empty());
    }
    let peak = square_map(9, 1.0, everywhere(|x, y| -(x * x + y * y)));
    assert!(contour(&peak, 0.0).is_empty(), "a peak that equals the level is a point, not a line");
    let nothing = square_map(8, 1.0, |_, _| None);
    assert!(contour(&nothing, 0.0).is_empty());
}

#[test]
fn every_crossing_is_joined_exactly_once() {
    let map = square_map(60, 1.0, everywhere(|x, y| (7.0 * x).sin() * (9.0 * y).cos() + 0.3 * x));
    for level in [-0.8, -0.3, 0.05, 0.4, 0.9] {
        let grid = super::contour_grid::ContourGrid::new(&map, map.scalar(&Quantity::Brightness).unwrap());
        let segments = grid.segments(level);
        let starts: HashSet<usize> = segments.iter().map(|segment| segment.start).collect();
        let ends: HashSet<usize> = segments.iter().map(|segment| segment.end).collect();
        assert_eq!((starts.len(), ends.len()), (segments.len(), segments.len()));
        let lines = contour(&map, level);
        // A closed line has as many points as segments, an open one has one more.
        let open = lines.iter().filter(|line| !line.closed).count();
        assert_eq!(open, ends.difference(&starts).count());
        let points: usize = lines.iter().map(|line| line.points.len()).sum();
        assert_eq!(points, segments.len() + open);
    }
}

#[test]
fn a_contour_through_pixel_centres_has_no_repeated_points() {
    // x² + y² = 25 passes through centres such as (3, 4): 11 pixels with centres at −5, −4, …, 5.
    let map = square_map(11, 5.5, everywhere(|x, y| x * x + y * y));
    let lines = contour(&map, 25.0);
    assert_eq!(lines.len(), 1);
    let points = &lines[0].points;
    assert!(lines[0].closed && points.contains(&ScreenPoint { x: 3.0, y: 4.0 }));
    assert!((0..points.len()).all(|index| points[index] != points[(index + 1) % points.len()]));
}

#[test]
fn a_wrong_question_is_answered_with_its_reason() {
    let map = square_map(4, 1.0, everywhere(|x, _| x));
    let error = isophotes(&map, &Quantity::Depth, &[0.0]).unwrap_err();
    assert_eq!(error.to_string(), "the map holds no channel `depth`; it holds brightness, normal, shape");
    let vector = isophotes(&map, &Quantity::Normal, &[0.0]).unwrap_err();
    assert_eq!(vector, IsophoteError::NotScalar { name: "normal".into() });
    let level = isophotes(&map, &Quantity::Brightness, &[0.0, f64::NAN]).unwrap_err();
    assert!(matches!(level, IsophoteError::LevelNotFinite { index: 1, .. }));
}
