//! The queries of the tree: the boxes in a tube along a ray, those in a beam of rays from a point, those in a shaft between
//! two boxes, and those around a point.

use super::Unit;
use super::node::{Node, WIDTH};
use crate::lanes::{Instructions, Lane, LaneJob};
use crate::shape::Bounds;
use crate::vector::Vector;

/// A test of the boxes of a node.
pub trait Query {
    /// For a vector of boxes, starting at index `at`: a lower bound on the depth of each box's relevant points, and which of
    /// the boxes are hit.
    fn intersect_some<V: Lane<Element = f32>>(&self, token: V::Token, node: &Node, at: usize) -> (V, u32);

    /// Tests all boxes.
    #[inline(always)]
    fn intersect<V: Lane<Element = f32>>(&self, token: V::Token, node: &Node) -> ([f32; WIDTH], u32) {
        let mut depths = [0.0; WIDTH];
        let mut met = 0;
        for at in (0..WIDTH).step_by(V::COUNT) {
            let (near, met_here) = self.intersect_some::<V>(token, node, at);
            near.store(&mut depths[at..]);
            met |= met_here << at;
        }
        (depths, met & node.used)
    }

    /// Tests all boxes with this instruction set.
    fn intersect_with(&self, instructions: Instructions, node: &Node) -> ([f32; WIDTH], u32)
    where
        Self: Sized,
    {
        instructions.run(Intersect { query: self, node })
    }
}

struct Intersect<'q, Q> {
    query: &'q Q,
    node: &'q Node,
}

impl<Q: Query> LaneJob for Intersect<'_, Q> {
    type Output = ([f32; WIDTH], u32);

    #[inline(always)]
    fn run<S, D>(self, token: S::Token) -> Self::Output
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        self.query.intersect::<S::Narrow>(token, self.node)
    }
}

/// The rounding error in single precision of the tests below, where all positions are within a few units of the middle: some
/// ten roundings of 2⁻²⁴ of 8.
pub(super) const SLACK: f64 = 4e-6;

/// If a ray starts farther from the middle than this, in units, its start is moved along it to a closer point.
const FAR: f64 = 4.0;

/// Everything that a box hits when it moves along a ray. Depths are distances from its start.
#[derive(Clone, Copy, Debug)]
pub struct Tube {
    /// Its start, shifted forwards and backwards along each axis: this is how boxes are enlarged.
    starts: [[f32; 3]; 2],
    inverse: [f32; 3],
    /// Which side of a box comes first, by axis.
    first: [usize; 3],
    /// The length of the ray that was skipped, in units.
    skipped: f64,
    /// Units per length of the direction.
    scale: f64,
}

impl Tube {
    /// A tube in the unit frame; `None` if it misses all boxes.
    #[expect(clippy::cast_possible_truncation, reason = "the slack covers the rounding")]
    pub(super) fn new(unit: &Unit, start: Vector, direction: Vector, radius: Vector) -> Option<Self> {
        let length = direction.length();
        let direction = direction * (1.0 / length);
        let start = unit.place(start);
        let distance = start.length();
        let slack = unit.slack + 64.0 * f64::EPSILON * distance;
        let widening = radius.to_array().map(|radius| slack + radius * unit.scale);
        let widest = widening.into_iter().fold(0.0, f64::max);
        let middle = -start.dot(direction);
        let skipped = if distance > FAR { (middle - FAR).max(0.0) } else { 0.0 };
        let start = start + direction * skipped;
        // Anything that is still far away after that misses the scene, or leads away from it.
        if start.length() - 2.0 * widest > 2.0 * FAR {
            return None;
        }
        // A ray whose direction has a smaller component than this stays within its slack over the length of the scene.
        let steepest = 1e-9;
        let (direction, start) = (direction.to_array(), start.to_array());
        let steep = direction.map(|d: f64| if d.abs() < steepest { steepest.copysign(d) } else { d });
        let moved =
            |side: f64| [0, 1, 2].map(|axis| (start[axis] + side * widening[axis].copysign(steep[axis])) as f32);
        Some(Self {
            starts: [moved(1.0), moved(-1.0)],
            inverse: steep.map(|d| (1.0 / d) as f32),
            first: steep.map(|d| usize::from(d < 0.0)),
            skipped,
            scale: unit.scale * length,
        })
    }

    /// The depth for a distance, given in lengths of the direction; rounded up.
    #[must_use]
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "rounded up")]
    pub fn depth_of(&self, distance: f64) -> f32 {
        let depth = distance * self.scale - self.skipped;
        (depth + 1e-6 * (depth.abs() + 1.0)) as f32
    }
}

impl Query for Tube {
    #[inline(always)]
    fn intersect_some<V: Lane<Element = f32>>(&self, token: V::Token, node: &Node, at: usize) -> (V, u32) {
        let mut near = V::splat(token, 0.0);
        let mut far = V::splat(token, f32::MAX);
        for axis in 0..3 {
            let first = self.first[axis];
            let inverse = V::splat(token, self.inverse[axis]);
            let [start, end] = [self.starts[0][axis], self.starts[1][axis]];
            near = near.max((V::load(token, &node.sides[first][axis][at..]) - V::splat(token, start)) * inverse);
            far = far.min((V::load(token, &node.sides[1 - first][axis][at..]) - V::splat(token, end)) * inverse);
        }
        (near, V::bits_not(far.is_less(near)))
    }
}

/// Everything that rays from a point between four directions can hit. Depths are measured along `forward`, and are never
/// negative.
#[derive(Clone, Copy, Debug)]
pub struct Beam {
    /// Its walls: unit normals that point inwards, and the distances of the origin, enlarged by the possible rounding error.
    walls: [([f32; 3], f32); 4],
    forward: ([f32; 3], f32),
    /// Units per metre.
    scale: f64,
}

impl Beam {
    /// A beam in the unit frame.
    #[expect(clippy::cast_possible_truncation, reason = "the slack covers the rounding")]
    pub(super) fn new(unit: &Unit, eye: Vector, corners: [Vector; 4], forward: Vector) -> Self {
        let eye = unit.place(eye);
        let middle = corners.into_iter().fold(Vector::default(), |sum, corner| sum + corner.normalized());
        // Rounded normals introduce an error of 2⁻²⁴ of a position, and the eye may be far away.
        let slack = unit.slack + 4e-7 * eye.length();
        let plane = |normal: Vector| {
            let offset = slack - normal.dot(eye);
            (normal.to_array().map(|x| x as f32), offset as f32)
        };
        let wall = |index: usize| {
            let normal = corners[index].cross(corners[(index + 1) % 4]).normalized();
            plane(if normal.dot(middle) < 0.0 { -normal } else { normal })
        };
        Self { walls: [0, 1, 2, 3].map(wall), forward: plane(-forward), scale: unit.scale }
    }

    /// The depth for a distance along `forward`, in metres; rounded up.
    #[must_use]
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "rounded up")]
    pub fn depth_of(&self, distance: f64) -> f32 {
        let depth = distance * self.scale;
        (depth + 1e-6 * (depth.abs() + 1.0)) as f32
    }
}

/// The largest value of n·x + offset over each box.
#[inline(always)]
fn highest<V: Lane<Element = f32>>(token: V::Token, node: &Node, at: usize, (normal, offset): &([f32; 3], f32)) -> V {
    let mut sum = V::splat(token, *offset);
    for (axis, component) in normal.iter().enumerate() {
        let side = usize::from(*component > 0.0);
        sum = V::load(token, &node.sides[side][axis][at..]).mul_add(V::splat(token, *component), sum);
    }
    sum
}

impl Query for Beam {
    #[inline(always)]
    fn intersect_some<V: Lane<Element = f32>>(&self, token: V::Token, node: &Node, at: usize) -> (V, u32) {
        let zero = V::splat(token, 0.0);
        let mut inside = highest::<V>(token, node, at, &self.walls[0]);
        for wall in &self.walls[1..] {
            inside = inside.min(highest(token, node, at, wall));
        }
        // −n·x is largest where the depth is smallest.
        let depth = (-highest::<V>(token, node, at, &self.forward)).max(zero);
        (depth, V::bits_not(inside.is_less(zero)))
    }
}

/// Everything that segments from one box to another can hit: a box that moves from the first to the second, and changes its
/// size on the way, sweeps their convex hull. Depths are fractions of the way.
#[derive(Clone, Copy, Debug)]
pub struct Shaft {
    /// For each axis, when the moving box's lower side passes a box's upper one, and its upper side the lower one.
    sides: [[Passage; 2]; 3],
    /// The part of the way on which there is anything to hit.
    part: [f64; 2],
}

/// When a coordinate that changes evenly passes another one.
#[derive(Clone, Copy, Debug)]
struct Passage {
    /// The coordinate at the beginning.
    start: f32,
    /// One over its change.
    inverse: f32,
    /// Whether the boxes overlap after that, rather than before.
    begins: bool,
}

impl Shaft {
    /// A shaft in the unit frame; `None` if it misses all boxes.
    pub(super) fn new(unit: &Unit, starts: &Bounds, ends: &Bounds) -> Option<Self> {
        let place = |bounds: &Bounds| [unit.place(bounds.least), unit.place(bounds.greatest)];
        let (starts, ends) = (place(starts), place(ends));
        let middle = |[least, greatest]: [Vector; 2]| (least + greatest) * 0.5;
        let half = |[least, greatest]: [Vector; 2]| ((greatest - least) * 0.5).length();
        let (first, way) = (middle(starts), middle(ends) - middle(starts));
        // Far from the scene, single precision would not be accurate enough, and there is nothing to hit.
        let reach = FAR + half(starts).max(half(ends));
        let (square, along) = (way.dot(way), first.dot(way));
        let [enter, leave] = if square > 0.0 {
            let nearest = first - way * (along / square);
            let half = (reach * reach - nearest.dot(nearest)) / square;
            if !(half >= 0.0) {
                return None;
            }
            let (middle, half) = (-along / square, half.sqrt());
            [(middle - half).max(0.0), (middle + half).min(1.0)]
        } else {
            [0.0, 1.0]
        };
        if !(enter < leave) {
            return None;
        }
        let at = |part: f64| [0, 1].map(|side| starts[side] + (ends[side] - starts[side]) * part);
        let ([low, high], [low_end, high_end]) = (at(enter), at(leave));
        let largest = [low, high, low_end, high_end].map(Vector::length).into_iter().fold(0.0, f64::max);
        let slack = unit.slack + 1e-6 * largest + 64.0 * f64::EPSILON * first.length().max((first + way).length());
        let sides = [0, 1, 2].map(|axis| {
            let [low, high, low_end, high_end] = [low, high, low_end, high_end].map(|corner| corner.to_array()[axis]);
            [Passage::new(low - slack, low_end - low, false), Passage::new(high + slack, high_end - high, true)]
        });
        Some(Self { sides, part: [enter, leave - enter] })
    }

    /// The depth for a fraction of the whole way; rounded up.
    #[must_use]
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "rounded up")]
    pub fn depth_of(&self, fraction: f64) -> f32 {
        let [skipped, part] = self.part;
        let depth = (fraction - skipped) / part;
        (depth + 1e-6 * (depth.abs() + 1.0)) as f32
    }
}

impl Passage {
    /// A coordinate that starts here and changes by this much; it is an upper side or a lower one.
    #[expect(clippy::cast_possible_truncation, reason = "the slack covers the rounding")]
    fn new(start: f64, change: f64, is_upper: bool) -> Self {
        // A smaller change stays within the slack.
        const LEAST: f64 = 1e-7;
        let change = if change.abs() < LEAST { LEAST.copysign(change) } else { change };
        Self { start: start as f32, inverse: (1.0 / change) as f32, begins: is_upper == (change > 0.0) }
    }
}

impl Query for Shaft {
    #[inline(always)]
    fn intersect_some<V: Lane<Element = f32>>(&self, token: V::Token, node: &Node, at: usize) -> (V, u32) {
        let mut near = V::splat(token, 0.0);
        let mut far = V::splat(token, 1.0);
        for (axis, passages) in self.sides.iter().enumerate() {
            for (side, passage) in passages.iter().enumerate() {
                // The lower side of the shaft against the upper side of the boxes, and the reverse.
                let other = V::load(token, &node.sides[1 - side][axis][at..]);
                let when = (other - V::splat(token, passage.start)) * V::splat(token, passage.inverse);
                if passage.begins {
                    near = near.max(when);
                } else {
                    far = far.min(when);
                }
            }
        }
        (near, V::bits_not(far.is_less(near)))
    }
}

/// Everything around a point. Depths are distances from it.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings {
    point: [f32; 3],
    slack: f32,
    /// Units per metre.
    scale: f64,
}

impl Surroundings {
    /// In the unit frame.
    #[expect(clippy::cast_possible_truncation, reason = "the slack covers the rounding")]
    pub(super) fn new(unit: &Unit, point: Vector) -> Self {
        let point = unit.place(point);
        let slack = unit.slack + 1e-6 * (1.0 + point.length());
        Self { point: point.to_array().map(|coordinate| coordinate as f32), slack: slack as f32, scale: unit.scale }
    }

    /// The depth for a distance in metres; rounded up.
    #[expect(clippy::cast_possible_truncation, reason = "rounded up")]
    pub fn depth_of(&self, distance: f64) -> f32 {
        (distance * self.scale * (1.0 + 1e-6)) as f32
    }
}

impl Query for Surroundings {
    #[inline(always)]
    fn intersect_some<V: Lane<Element = f32>>(&self, token: V::Token, node: &Node, at: usize) -> (V, u32) {
        let zero = V::splat(token, 0.0);
        let mut square = zero;
        for axis in 0..3 {
            let coordinate = V::splat(token, self.point[axis]);
            let [least, greatest] = [&node.sides[0][axis], &node.sides[1][axis]];
            let gap = (V::load(token, &least[at..]) - coordinate).max(coordinate - V::load(token, &greatest[at..]));
            let gap = gap.max(zero);
            square = gap.mul_add(gap, square);
        }
        ((square.sqrt() - V::splat(token, self.slack)).max(zero), V::bits_not(zero.is_less(zero)))
    }
}
