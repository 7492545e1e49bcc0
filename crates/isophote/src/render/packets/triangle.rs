//! A triangle as the rays of a packet meet it: which of them certainly hit it, and which may.
//!
//! Only that is decided here, with margins for every rounding error; the points that rays hit are computed in [`points`], and
//! what is doubtful is traced ray by ray.
//!
//! [`points`]: super::points

use super::rays::{EdgeSide, OCTETS, RayPacket};
use crate::lanes::Lane;
use crate::render::vectors::splat;
use crate::vector::Vector;

/// A triangle relative to a packet.
pub struct PacketTriangle {
    edges: [EdgeSide; 3],
    /// The possible rounding error of their functions.
    edge_error: f64,
    /// The product of two sides: normal to the plane.
    face: Vector,
    /// The first corner, relative to the packet's origin.
    corner: Vector,
    /// The possible rounding error of t, times D·face.
    t_error: f64,
}

/// Where some rays meet the plane of a triangle.
pub struct Crossing<V> {
    /// How far inside the triangle they pass: negative outside.
    pub inside: V,
    /// t.
    pub t: V,
    /// Its possible error.
    pub error: V,
}

/// The rays of a vector that hit a triangle, as bits.
pub struct Met {
    /// Those that certainly do.
    pub surely: u32,
    /// Those that may.
    pub maybe: u32,
}

/// Roundings that go into an edge function or into t, in units of ε.
const ROUNDINGS: f64 = 16.0 * f64::EPSILON;

impl PacketTriangle {
    /// From its corners, in metres.
    #[inline(always)]
    pub fn new(corners: &[Vector; 3], packet: &RayPacket) -> Self {
        let (a, b, c) = (corners[0] - packet.origin, corners[1] - packet.origin, corners[2] - packet.origin);
        let sides = [corners[2] - corners[1], corners[0] - corners[2], corners[1] - corners[0]];
        let edges = [
            EdgeSide { across: b.cross(c), along: sides[0] },
            EdgeSide { across: c.cross(a), along: sides[1] },
            EdgeSide { across: a.cross(b), along: sides[2] },
        ];
        let square = a.dot(a).max(b.dot(b)).max(c.dot(c));
        let longest = sides[0].dot(sides[0]).max(sides[1].dot(sides[1])).max(sides[2].dot(sides[2]));
        let (reach, longest) = (square.sqrt(), longest.sqrt());
        let [_, length] = packet.lengths;
        Self {
            edges,
            edge_error: ROUNDINGS * length * (square + longest * packet.reach),
            face: sides[2].cross(-sides[1]),
            corner: a,
            t_error: ROUNDINGS * longest * longest * (reach + packet.reach),
        }
    }

    /// The octets that have rays which may hit it, as bits.
    #[inline(always)]
    pub fn octets<V: Lane<Element = f64>>(&self, token: V::Token, packet: &RayPacket) -> u32 {
        let error = V::splat(token, self.edge_error);
        let mut bits = 0;
        for at in (0..OCTETS).step_by(V::COUNT) {
            let [first, second, third] = &self.edges;
            let [middle, half] = packet.side_of_octets::<V>(token, at, first);
            let (mut low, mut high) = (middle - half, middle + half);
            let [middle, half] = packet.side_of_octets::<V>(token, at, second);
            (low, high) = (low.max(middle - half), high.min(middle + half));
            let [middle, half] = packet.side_of_octets::<V>(token, at, third);
            (low, high) = (low.max(middle - half), high.min(middle + half));
            // Inside, all three functions have one sign: the smallest upper bound is positive, or the largest lower bound
            // negative.
            let possible = high.max(-low) + error;
            bits |= V::bits_not(possible.is_less(V::splat(token, 0.0))) << at;
        }
        bits
    }

    /// Where some rays meet its plane.
    #[inline(always)]
    pub fn cross<V: Lane<Element = f64>>(&self, token: V::Token, packet: &RayPacket, at: usize) -> Crossing<V> {
        let first = packet.side::<V>(token, at, &self.edges[0]);
        let second = packet.side::<V>(token, at, &self.edges[1]);
        let third = packet.side::<V>(token, at, &self.edges[2]);
        let least = first.min(second).min(third);
        let greatest = first.max(second).max(third);
        let face = splat::<V>(token, self.face);
        let [start, direction] = packet.rays::<V>(token, at);
        let inverse = V::splat(token, 1.0) / direction.dot(face);
        let ahead = if packet.is_central() {
            V::splat(token, self.corner.dot(self.face))
        } else {
            (splat::<V>(token, self.corner) - start).dot(face)
        };
        let error = V::splat(token, self.t_error) * inverse;
        Crossing { inside: least.max(-greatest), t: ahead * inverse, error: error.max(-error) }
    }

    /// Which of the rays certainly hit it with t in a range, and which may; at the ends of the range, t is uncertain by this
    /// margin.
    #[inline(always)]
    pub fn met<V: Lane<Element = f64>>(
        &self,
        token: V::Token,
        crossing: &Crossing<V>,
        [first, last]: [f64; 2],
        margin: f64,
    ) -> Met {
        let Crossing { inside, t, error } = *crossing;
        let (first, last, edge) = (V::splat(token, first), V::splat(token, last), V::splat(token, self.edge_error));
        let margin = V::splat(token, margin) + error;
        let is_inside = V::bits(edge.is_less(inside));
        let may_be_inside = V::bits_not(inside.is_less(-edge));
        let is_within = V::bits((first + margin).is_less(t)) & V::bits(t.is_less(last - margin));
        // Written so that NaN counts as possible.
        let may_be_within = V::bits_not((t + margin).is_less(first)) & V::bits_not(last.is_less(t - margin));
        let surely = is_inside & is_within;
        Met { surely, maybe: may_be_inside & may_be_within & !surely }
    }
}
