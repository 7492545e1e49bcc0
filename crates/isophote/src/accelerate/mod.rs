//! The acceleration structure: a tree of bounding boxes over all primitives, which finds those that a ray, a beam of rays or
//! a shadow may meet.
//!
//! Queries return a superset, from near to far, and never miss a primitive: boxes are in single precision and rounded
//! outwards, and every test allows for its own rounding errors, for any start and direction, near the scene or far away. The
//! caller tests the primitives themselves, in the precision that the answer needs.

mod build;
mod node;
mod query;
#[cfg(test)]
mod tests;
mod walk;

use self::query::Surroundings;
pub(crate) use query::{Beam, Shaft, Tube};
pub(crate) use walk::Walk;

use self::node::Node;
use self::query::Query;
use crate::lanes::Instructions;
use crate::shape::Bounds;
use crate::threads::Threads;
use crate::vector::Vector;

/// The tree. Primitives are numbered from 0, in the order in which their boxes were given.
#[derive(Clone, Debug)]
pub struct Accelerator {
    unit: Unit,
    /// The first node is the root.
    nodes: Vec<Node>,
    /// Unbounded primitives: they are in no box, and every query begins with them.
    unbounded: Vec<u32>,
    instructions: Instructions,
}

impl Accelerator {
    /// Builds the tree over `count` primitives on these threads; unbounded primitives have no box.
    #[must_use]
    pub fn new(threads: &Threads, count: u32, bounds: impl Fn(u32) -> Option<Bounds> + Sync) -> Self {
        build::build(threads, count, bounds)
    }

    /// Visits the primitives that a ray may hit, from near to far: `test` returns the distance (in lengths of the direction)
    /// up to which the search goes on.
    pub fn along_ray(&self, start: Vector, direction: Vector, limit: f64, mut test: impl FnMut(u32) -> f64) {
        let mut limit = limit;
        for primitive in &self.unbounded {
            limit = limit.min(test(*primitive));
        }
        let Some(tube) = Tube::new(&self.unit, start, direction, Vector::default()) else { return };
        let mut walk = Walk::default();
        walk.start(self);
        while let Some(primitive) = walk.next_with(self.instructions, self, &tube, tube.depth_of(limit)) {
            limit = limit.min(test(primitive));
        }
    }

    /// Visits the primitives around a point, roughly from near to far: `test` returns the distance up to which the search goes
    /// on.
    pub(crate) fn around(&self, point: Vector, mut test: impl FnMut(u32) -> f64) {
        let mut limit = f64::INFINITY;
        for primitive in &self.unbounded {
            limit = limit.min(test(*primitive));
        }
        let surroundings = Surroundings::new(&self.unit, point);
        let mut walk = Walk::default();
        walk.start(self);
        while let Some(primitive) = walk.next_with(self.instructions, self, &surroundings, surroundings.depth_of(limit))
        {
            limit = limit.min(test(primitive));
        }
    }

    /// Its size in memory, in bytes.
    #[must_use]
    pub fn size_in_bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>() + self.unbounded.capacity() * size_of::<u32>()
    }

    /// The volume that a box, given by half its sides, sweeps along a ray; `None` if it misses all boxes.
    pub(crate) fn tube(&self, start: Vector, direction: Vector, radius: Vector) -> Option<Tube> {
        Tube::new(&self.unit, start, direction, radius)
    }

    /// The volume between two boxes: everything that segments from one to the other may hit; `None` if it misses all boxes.
    pub(crate) fn shaft(&self, starts: &Bounds, ends: &Bounds) -> Option<Shaft> {
        Shaft::new(&self.unit, starts, ends)
    }

    /// A distance from a place, in metres, beyond which there are no boxes.
    pub(crate) fn farthest_from(&self, place: Vector) -> f64 {
        // The scene is a cube whose half side is 1.
        (self.unit.center - place).length() + 2.0 / self.unit.scale
    }

    /// The primitives that are in no box: every query begins with them.
    pub(crate) fn unbounded(&self) -> &[u32] {
        &self.unbounded
    }

    /// A beam of rays from a point, bounded by four directions in cyclic order.
    pub(crate) fn beam(&self, eye: Vector, corners: [Vector; 4], forward: Vector) -> Beam {
        Beam::new(&self.unit, eye, corners, forward)
    }
}

/// The frame in which boxes are stored: centred on the scene, which extends from −1 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Unit {
    center: Vector,
    /// Units per metre: a power of two.
    scale: f64,
    /// The possible error of positions in the frame: far from the origin, they were already rounded.
    slack: f64,
}

impl Unit {
    fn around(bounds: Bounds) -> Self {
        let half = (bounds.greatest - bounds.least) * 0.5;
        let size = half.to_array().into_iter().fold(0.0, f64::max);
        let scale = if size > 0.0 { libm::exp2(-libm::log2(size).ceil()) } else { 1.0 };
        let center = bounds.least + half;
        Self { center, scale, slack: query::SLACK + 16.0 * f64::EPSILON * center.length() * scale }
    }

    fn place(&self, point: Vector) -> Vector {
        (point - self.center) * self.scale
    }
}
