//! Which rays of a packet are blocked on their way.

use super::body::PacketBody;
use super::candidates::{Candidate, Search};
use super::rays::{OCTET, RAYS, RayPacket, has_any_of};
use super::set_bits;
use super::triangle::{Met, PacketTriangle};
use crate::lanes::Lane;
use crate::prepare::{Blocks, ERROR_OF_DISTANCE, PreparedScene};
use crate::ray::Ray;
use crate::shape::Geometry;

/// The rays that are blocked, as bits.
pub struct Blocked<'a> {
    /// The scene.
    pub scene: &'a PreparedScene,
    /// The number of the primitive that each ray belongs to, which does not block it.
    pub own: &'a [u32; RAYS],
    /// A ray, and its length if it ends.
    pub ray: &'a dyn Fn(usize) -> Option<(Ray, Option<f64>)>,
    /// The rays whose answer matters.
    pub in_use: u64,
    /// Those that are certainly blocked.
    pub surely: u64,
    /// Those that may be.
    pub maybe: u64,
}

impl Blocked<'_> {
    /// Those that are still open.
    fn open(&self) -> u64 {
        self.in_use & !self.surely
    }

    fn casts_shadow(&self, found: &Candidate<'_>) -> bool {
        self.scene.scene().shapes()[found.primitive.shape].casts_shadow
    }
}

impl Search for Blocked<'_> {
    #[inline(always)]
    fn test_triangle<V: Lane<Element = f64>>(&mut self, token: V::Token, packet: &RayPacket, found: &Candidate<'_>) {
        let Geometry::Mesh(mesh) = found.geometry else { return };
        if !self.casts_shadow(found) {
            return;
        }
        let triangle = PacketTriangle::new(&mesh.corners(found.primitive.part), packet);
        let mut octets = triangle.octets::<V>(token, packet);
        // Closer to the surface than this, a neighbour does not block the light.
        let margin = 4.0 * found.geometry.least_shadow_distance() / packet.lengths[0] + ERROR_OF_DISTANCE;
        while octets != 0 {
            let octet = octets.trailing_zeros() as usize;
            octets &= octets - 1;
            if !has_any_of(self.open(), octet) {
                continue;
            }
            for at in (octet * OCTET..(octet + 1) * OCTET).step_by(V::COUNT) {
                let crossing = triangle.cross::<V>(token, packet, at);
                let Met { surely, maybe } = triangle.met(token, &crossing, packet.range, margin);
                if surely | maybe == 0 {
                    continue;
                }
                let mut others = 0;
                for (lane, own) in self.own[at..at + V::COUNT].iter().enumerate() {
                    others |= u32::from(*own != found.number) << lane;
                }
                self.surely |= u64::from(surely & others) << at;
                self.maybe |= u64::from(maybe & others) << at;
            }
        }
    }

    #[inline(always)]
    fn test_body<V: Lane<Element = f64>>(
        &mut self,
        token: V::Token,
        packet: &RayPacket,
        found: &Candidate<'_>,
        body: &PacketBody,
        rays: u64,
    ) {
        let mut rays = rays & self.open();
        if rays == 0 || !self.casts_shadow(found) {
            return;
        }
        for (ray, own) in self.own.iter().enumerate() {
            rays &= !(u64::from(*own == found.number) << ray);
        }
        let mut doubtful = 0;
        for at in (0..RAYS).step_by(V::COUNT) {
            let here = rays >> at & ((1 << V::COUNT) - 1);
            if here != 0 {
                let Met { surely, maybe } = body.met::<V>(token, packet, at, packet.range, ERROR_OF_DISTANCE);
                self.surely |= (u64::from(surely) & here) << at;
                doubtful |= (u64::from(maybe) & here) << at;
            }
        }
        if doubtful != 0 {
            self.test_rays(found, doubtful);
        }
    }

    #[inline(always)]
    fn limit(&mut self) -> Option<f64> {
        (self.open() != 0).then_some(f64::INFINITY)
    }
}

impl Blocked<'_> {
    /// Tests rays one by one.
    #[inline(never)]
    fn test_rays(&mut self, found: &Candidate<'_>, rays: u64) {
        for index in set_bits(rays) {
            let Some((ray, distance)) = (self.ray)(index) else { continue };
            match self.scene.blocks(found.primitive, &ray, distance) {
                Blocks::Surely => self.surely |= 1 << index,
                Blocks::Maybe => self.maybe |= 1 << index,
                Blocks::Not => {}
            }
        }
    }
}
