//! The primitives that the rays of a packet may meet.

use super::body::PacketBody;
use super::rays::{OCTET, RAYS, RayPacket, has_any_of};
use super::set_bits;
use super::triangle::PacketTriangle;
use crate::accelerate::{Shaft, Walk};
use crate::lanes::Lane;
use crate::prepare::PreparedScene;
use crate::render::vectors::splat;
use crate::shape::{Bounds, Geometry, Primitive};
use crate::vector::Vector;

/// A search for what the rays of a packet meet.
pub trait Search {
    /// The rays that a primitive may still matter to, as bits; none if it does not matter at all.
    fn open(&self, packet: &RayPacket, found: &Candidate<'_>) -> u64;

    /// Tests a triangle for some of the rays, in lanes.
    fn test_triangle<V: Lane<Element = f64>>(
        &mut self,
        token: V::Token,
        packet: &RayPacket,
        found: &Candidate<'_>,
        triangle: &PacketTriangle,
        at: usize,
    );

    /// Tests another primitive for some of the rays, in lanes, `rays` of which matter; returns those that lanes cannot decide.
    fn test_body<V: Lane<Element = f64>>(
        &mut self,
        token: V::Token,
        packet: &RayPacket,
        found: &Candidate<'_>,
        body: &PacketBody,
        at: usize,
        rays: u32,
    ) -> u32;

    /// Tests another primitive for the rays that are left, one by one.
    fn test_rays(&mut self, packet: &RayPacket, found: &Candidate<'_>, rays: u64);

    /// The t up to which the search goes on; `None` if it is over.
    fn limit(&mut self, packet: &RayPacket) -> Option<f64>;
}

/// A primitive that may be met.
pub struct Candidate<'s> {
    /// Its number in the scene.
    pub number: u32,
    /// It.
    pub primitive: Primitive,
    /// The shape that it is a part of.
    pub geometry: &'s Geometry,
}

/// Finds the primitives that rays of a packet may meet, and lets the search test each of them. Without an end of t, the
/// packet's rays are followed until they have left the scene.
#[inline(always)]
pub fn search<S, D>(
    token: S::Token,
    scene: &PreparedScene,
    packet: &RayPacket,
    walk: &mut Walk,
    search: &mut impl Search,
) where
    S: Lane<Element = f32>,
    D: Lane<Element = f64, Token = S::Token>,
{
    if scene.tries_all_primitives() {
        for number in 0..scene.primitive_count() {
            test::<D>(token, scene, packet, search, number);
        }
        return;
    }
    let tree = scene.accelerator();
    for number in tree.unbounded() {
        test::<D>(token, scene, packet, search, *number);
    }
    let farthest = || (tree.farthest_from(packet.origin) + packet.reach) / packet.lengths[0];
    let end = if packet.range[1].is_finite() { packet.range[1] } else { farthest() };
    let [starts, ends] = packet.ends::<D>(token, end);
    let Some(shaft) = tree.shaft(&starts, &ends) else { return };
    walk.start(tree);
    let depth = |shaft: &Shaft, limit: f64| shaft.depth_of(if limit < end { limit / end } else { 1.0 });
    while let Some(limit) = search.limit(packet)
        && let Some(number) = walk.next::<S>(token, tree, &shaft, depth(&shaft, limit))
    {
        test::<D>(token, scene, packet, search, number);
    }
}

#[inline(always)]
fn test<V: Lane<Element = f64>>(
    token: V::Token,
    scene: &PreparedScene,
    packet: &RayPacket,
    search: &mut impl Search,
    number: u32,
) {
    let primitive = scene.primitive(number);
    let geometry = scene.geometry(primitive.shape);
    let found = Candidate { number, primitive, geometry };
    if search.open(packet, &found) == 0 {
        return;
    }
    if let Geometry::Mesh(mesh) = geometry {
        let triangle = PacketTriangle::new(&mesh.corners(primitive.part), packet);
        for octet in set_bits(triangle.octets::<V>(token, packet).into()) {
            if has_any_of(search.open(packet, &found), octet) {
                for at in (octet * OCTET..(octet + 1) * OCTET).step_by(V::COUNT) {
                    search.test_triangle::<V>(token, packet, &found, &triangle, at);
                }
            }
        }
    } else if let Some(body) = geometry.body(primitive.part) {
        let rays = match geometry.bounds(primitive.part) {
            Some(bounds) => through::<V>(token, packet, &bounds),
            None => u64::MAX,
        };
        let rays = rays & search.open(packet, &found);
        let body = PacketBody::new(body, packet);
        let mut left = 0;
        for at in (0..RAYS).step_by(V::COUNT) {
            #[expect(clippy::cast_possible_truncation, reason = "the bits of a vector")]
            let rays = (rays >> at & ((1 << V::COUNT) - 1)) as u32;
            if rays != 0 {
                left |= u64::from(search.test_body::<V>(token, packet, &found, &body, at, rays)) << at;
            }
        }
        if left != 0 {
            search.test_rays(packet, &found, left);
        }
    }
}

/// A component of a unit vector that is smaller than this is taken for it, which moves the ray by less than the slack.
const SMALLEST: f64 = 1e-10;

/// The rays that may pass through a box with t in the packet's range, as bits.
#[inline(always)]
fn through<V: Lane<Element = f64>>(token: V::Token, packet: &RayPacket, bounds: &Bounds) -> u64 {
    let (least, greatest) = (bounds.least - packet.origin, bounds.greatest - packet.origin);
    let reach = least.length() + greatest.length() + packet.reach;
    let slack = 4.0 * SMALLEST * reach;
    let slack = Vector::new(slack, slack, slack);
    let (least, greatest) = (splat::<V>(token, least - slack), splat::<V>(token, greatest + slack));
    let smallest = V::splat(token, SMALLEST * packet.lengths[1]);
    let zero = V::splat(token, 0.0);
    let one = V::splat(token, 1.0);
    let mut bits = 0;
    for at in (0..RAYS).step_by(V::COUNT) {
        if !has_any_of(packet.in_use, at / OCTET) {
            continue;
        }
        let [start, direction] = packet.rays::<V>(token, at);
        let mut near = V::splat(token, packet.range[0]);
        let mut far = V::splat(token, packet.range[1]);
        let slab = Slab { zero, one, smallest };
        (near, far) = slab.cut(near, far, start.x, direction.x, [least.x, greatest.x]);
        (near, far) = slab.cut(near, far, start.y, direction.y, [least.y, greatest.y]);
        (near, far) = slab.cut(near, far, start.z, direction.z, [least.z, greatest.z]);
        bits |= u64::from(V::bits_not(far.is_less(near))) << at;
    }
    bits
}

/// The part of some rays between two planes.
struct Slab<V> {
    zero: V,
    one: V,
    /// The smallest component of a direction.
    smallest: V,
}

impl<V: Lane<Element = f64>> Slab<V> {
    #[inline(always)]
    fn cut(&self, near: V, far: V, start: V, direction: V, [least, greatest]: [V; 2]) -> (V, V) {
        let size = direction.max(-direction).max(self.smallest);
        let inverse = self.one / V::select(direction.is_less(self.zero), -size, size);
        let (first, last) = ((least - start) * inverse, (greatest - start) * inverse);
        (near.max(first.min(last)), far.min(first.max(last)))
    }
}
