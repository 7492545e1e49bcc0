use proptest::prelude::*;

use super::*;
use crate::lanes::{Lane, LaneJob};

fn vector(range: f64) -> impl Strategy<Value = Vector> {
    [-range..range, -range..range, -range..range].prop_map(Vector::from)
}

/// Boxes around a place, many of them without volume.
fn boxes(least: usize) -> impl Strategy<Value = Vec<Option<Bounds>>> {
    let one = || {
        (vector(1.0), [0.0..0.3_f64, 0.0..0.3_f64, 0.0..0.3_f64], 0..6_u32).prop_map(|(least, size, flat)| {
            let mut size = size;
            for (axis, length) in size.iter_mut().enumerate() {
                if flat >> axis & 1 == 1 {
                    *length = 0.0;
                }
            }
            Some(Bounds { least, greatest: least + Vector::from(size) })
        })
    };
    prop_oneof![
        prop::collection::vec(one(), least..60),
        (one(), 1..200_usize).prop_map(|(bounds, count)| vec![bounds; count]),
    ]
}

#[expect(clippy::cast_possible_truncation, reason = "a few boxes")]
fn tree_over(boxes: &[Option<Bounds>]) -> Accelerator {
    Accelerator::new(&Threads::single(), boxes.len() as u32, |number| boxes[number as usize])
}

fn moved(boxes: &[Option<Bounds>], size: f64, place: Vector) -> Vec<Option<Bounds>> {
    let moved = |point: Vector| point * size + place;
    let bounds = |bounds: &Bounds| Bounds { least: moved(bounds.least), greatest: moved(bounds.greatest) };
    boxes.iter().map(|entry| entry.as_ref().map(bounds)).collect()
}

/// Where a ray is inside a box, by the textbook slab test in double precision, without any margin.
fn enters(bounds: &Bounds, start: Vector, direction: Vector) -> Option<f64> {
    let (mut near, mut far) = (0.0_f64, f64::INFINITY);
    let corners = bounds.least.to_array().into_iter().zip(bounds.greatest.to_array());
    for ((low, high), (o, d)) in corners.zip(start.to_array().into_iter().zip(direction.to_array())) {
        if d == 0.0 {
            if o < low || o > high {
                return None;
            }
        } else {
            let [first, last] = if d > 0.0 { [low, high] } else { [high, low] };
            near = near.max((first - o) / d);
            far = far.min((last - o) / d);
        }
    }
    (near <= far).then_some(near)
}

fn found(tree: &Accelerator, start: Vector, direction: Vector, limit: f64) -> Vec<u32> {
    let mut found = Vec::new();
    tree.along_ray(start, direction, limit, |primitive| {
        found.push(primitive);
        limit
    });
    found.sort_unstable();
    found
}

proptest! {
    /// Scales from 1e-6 to 1e6, far from the origin, with rays from near and far, including rays along the axes.
    #[test]
    fn no_box_that_a_ray_meets_is_missed(
        boxes in boxes(0), target in vector(1.0), away in vector(1.0), far in -2.0..6.0_f64, flat in 0..8_u32,
        exponent in -6..6_i32, place in vector(1.0), relative_distance in prop::sample::select(vec![0.0, 1.0, 1e3, 1e9]),
        part in 0.0..1.5_f64,
    ) {
        let size = 10.0_f64.powi(exponent);
        let place = place * (relative_distance * size);
        let boxes = moved(&boxes, size, place);
        let mut away = away.to_array();
        for (axis, component) in away.iter_mut().enumerate() {
            if flat >> axis & 1 == 1 {
                *component = 0.0;
            }
        }
        let away = Vector::from(away) * (size * 10.0_f64.powf(far));
        prop_assume!(away.length() > 0.0);
        let (start, direction) = (target * size + place + away, -away);
        let tree = tree_over(&boxes);
        let found = found(&tree, start, direction, part);
        for (primitive, bounds) in (0..).zip(boxes.iter().flatten()) {
            if enters(bounds, start, direction).is_some_and(|at| at <= part) {
                prop_assert!(found.contains(&primitive), "{primitive}: {bounds:?}");
            }
        }
    }

    #[test]
    fn the_nearest_box_is_that_of_brute_force(boxes in boxes(1), start in vector(3.0), direction in vector(1.0)) {
        prop_assume!(direction.length() > 1e-3);
        let tree = tree_over(&boxes);
        let (mut nearest, mut tested) = (f64::INFINITY, 0);
        tree.along_ray(start, direction, f64::INFINITY, |primitive| {
            tested += 1;
            let bounds = boxes[primitive as usize].as_ref().expect("it has one");
            nearest = nearest.min(enters(bounds, start, direction).unwrap_or(f64::INFINITY));
            nearest
        });
        let all = boxes.iter().flatten().filter_map(|bounds| enters(bounds, start, direction));
        prop_assert_eq!(nearest, all.fold(f64::INFINITY, f64::min));
        prop_assert!(tested <= boxes.len());
    }

    /// Points in the boxes, seen within the beam, and points in the boxes near a ray.
    #[test]
    fn no_box_that_reaches_into_a_beam_or_a_tube_is_missed(
        boxes in boxes(1), eye in vector(4.0), aim in vector(1.0), width in 0.001..1.0_f64, inside in vector(1.0),
        radius in 0.0..0.5_f64,
    ) {
        let forward = aim - eye;
        prop_assume!(forward.length() > 0.1);
        let forward = forward.normalized();
        let side = forward.cross(Vector::new(0.3, 0.5, -0.8)).normalized();
        let up = side.cross(forward);
        let corner = |x: f64, y: f64| forward + side * (x * width) + up * (y * width);
        let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        let tree = tree_over(&boxes);
        for instructions in Instructions::all() {
            let seen = instructions.run(All { tree: &tree, query: &tree.beam(eye, corners, forward) });
            let tube = tree.tube(eye, forward, Vector::new(radius, radius, radius));
            let near = tube.map_or(Vec::new(), |tube| instructions.run(All { tree: &tree, query: &tube }));
            for (primitive, bounds) in (0..).zip(boxes.iter().flatten()) {
                let half = (bounds.greatest - bounds.least) * 0.5;
                let point = bounds.least + half
                    + Vector::new(half.x * inside.x, half.y * inside.y, half.z * inside.z);
                let from_eye = point - eye;
                let depth = from_eye.dot(forward);
                let [x, y] = [side, up].map(|axis| axis.dot(from_eye));
                if depth > 0.0 && x.abs() <= width * depth && y.abs() <= width * depth {
                    prop_assert!(seen.contains(&primitive));
                }
                if depth > 0.0 && x.hypot(y) <= radius {
                    prop_assert!(near.contains(&primitive));
                }
            }
        }
    }
}

struct All<'q, Q> {
    tree: &'q Accelerator,
    query: &'q Q,
}

impl<Q: Query> LaneJob for All<'_, Q> {
    type Output = Vec<u32>;

    #[inline(always)]
    fn run<S, D>(self, token: S::Token) -> Vec<u32>
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        let mut walk = Walk::default();
        walk.start(self.tree);
        std::iter::from_fn(|| walk.next::<S::Narrow>(token, self.tree, self.query, f32::INFINITY)).collect()
    }
}

#[test]
fn without_boxes_nothing_is_found() {
    let tree = tree_over(&[]);
    assert!(found(&tree, Vector::default(), Vector::new(0.0, 0.0, 1.0), f64::INFINITY).is_empty());
}

#[test]
fn what_has_no_end_is_always_found() {
    let unit = Bounds { least: Vector::default(), greatest: Vector::new(1.0, 1.0, 1.0) };
    let endless = Bounds { greatest: Vector::new(f64::INFINITY, 1.0, 1.0), ..unit };
    let tree = tree_over(&[None, Some(unit), Some(endless)]);
    let past = Vector::new(5.0, 5.0, -1.0);
    assert_eq!(found(&tree, past, Vector::new(0.0, 0.0, 1.0), 1.0), [0, 2]);
    assert_eq!(found(&tree, Vector::new(0.5, 0.5, -1.0), Vector::new(0.0, 0.0, 1.0), 1.0), [0, 1, 2]);
}

/// A box given by its middle and half its sides.
fn around(middle: Vector, half: Vector) -> Bounds {
    Bounds { least: middle - half, greatest: middle + half }
}

fn found_in_shaft(tree: &Accelerator, starts: &Bounds, ends: &Bounds) -> Vec<u32> {
    let Some(shaft) = tree.shaft(starts, ends) else { return Vec::new() };
    let mut walk = Walk::default();
    walk.start(tree);
    std::iter::from_fn(|| walk.next_with(tree.instructions, tree, &shaft, shaft.depth_of(1.0))).collect()
}

proptest! {
    /// Segments between any points of two boxes, near the scene or far away, at any scale: whatever they pass through is found.
    #[test]
    fn a_shaft_misses_nothing_between_its_ends(
        boxes in boxes(1),
        (from, to) in (vector(6.0), vector(6.0)),
        (half, other_half) in (vector(0.4), vector(0.4)),
        away in prop_oneof![Just(0.0), Just(1.0), Just(1e6)],
        size in prop_oneof![Just(1e-3), Just(1.0), Just(1e3)],
        corners in prop::collection::vec(([0.0..=1.0_f64, 0.0..=1.0, 0.0..=1.0], [0.0..=1.0_f64, 0.0..=1.0, 0.0..=1.0]), 8),
    ) {
        let place = Vector::new(3.0, -2.0, 1.0) * away;
        let moved = moved(&boxes, size, place);
        let tree = tree_over(&moved);
        let end = |middle: Vector, half: Vector| around(middle * size + place, half.map(f64::abs) * size);
        let (starts, ends) = (end(from, half), end(to, other_half));
        let found = found_in_shaft(&tree, &starts, &ends);
        let within = |bounds: &Bounds, part: [f64; 3]| {
            let side = bounds.greatest - bounds.least;
            bounds.least + Vector::new(side.x * part[0], side.y * part[1], side.z * part[2])
        };
        for (first, last) in corners {
            let (start, end) = (within(&starts, first), within(&ends, last));
            for (number, bounds) in moved.iter().enumerate() {
                let Some(bounds) = bounds else { continue };
                if enters(bounds, start, end - start).is_some_and(|at| at <= 1.0) {
                    prop_assert!(found.iter().any(|one| *one as usize == number), "{start:?} {end:?} {bounds:?}");
                }
            }
        }
    }
}
