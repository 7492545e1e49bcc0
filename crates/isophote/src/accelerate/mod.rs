//! Which primitives a ray, a beam of rays or a shadow may meet: a tree of boxes over all of them.
//!
//! The tree answers with a superset, from near to far, and never misses: boxes are of single precision and rounded
//! outwards, and every test leaves room for its own rounding, for any start and direction, near the scene or far away.
//! The primitives themselves are tested by whoever asks, in the precision that the answer needs.

mod build;
mod node;
mod query;
#[cfg(test)]
mod tests;
mod walk;

pub(crate) use query::{Beam, Tube};
pub(crate) use walk::Walk;

use self::node::Node;
use self::query::Query;
use crate::lanes::Instructions;
use crate::shape::Bounds;
use crate::threads::Threads;
use crate::vector::Vector;

/// The tree. Primitives are numbers, from 0 in the order in which their boxes were given.
#[derive(Clone, Debug)]
pub struct Accelerator {
    unit: Unit,
    /// The first one is the root.
    nodes: Vec<Node>,
    /// Primitives without an end: they are in no box, and every query begins with them.
    unbounded: Vec<u32>,
    instructions: Instructions,
}

impl Accelerator {
    /// The tree over so many primitives, built on these threads; what has no end has no box.
    #[must_use]
    pub fn new(threads: &Threads, count: u32, bounds: impl Fn(u32) -> Option<Bounds> + Sync) -> Self {
        build::build(threads, count, bounds)
    }

    /// Goes through the primitives that a ray may meet, from near to far: `test` says up to which distance (in lengths of
    /// the direction) the search goes on.
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

    /// Bytes of memory that it takes.
    #[must_use]
    pub fn size_in_bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>() + self.unbounded.capacity() * size_of::<u32>()
    }

    /// What a box, given by half its sides, meets on its way along a ray; nothing where it passes all boxes.
    pub(crate) fn tube(&self, start: Vector, direction: Vector, radius: Vector) -> Option<Tube> {
        Tube::new(&self.unit, start, direction, radius)
    }

    /// A beam of rays from a point between four directions, given in turn.
    pub(crate) fn beam(&self, eye: Vector, corners: [Vector; 4], forward: Vector) -> Beam {
        Beam::new(&self.unit, eye, corners, forward)
    }
}

/// The frame in which boxes are kept: around the middle of the scene, which reaches from −1 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Unit {
    center: Vector,
    /// Units per metre: a power of two.
    scale: f64,
    /// By how much places in the frame may be off: far from the origin they were rounded before.
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
