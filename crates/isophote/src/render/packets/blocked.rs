//! Which rays of a packet are blocked on their way.

use super::body::PacketBody;
use super::candidates::{Candidate, Search};
use super::rays::{RAYS, RayPacket};
use super::set_bits;
use super::triangle::{Met, PacketTriangle};
use crate::lanes::Lane;
use crate::prepare::{Blocks, ERROR_OF_DISTANCE, PreparedScene};
use crate::ray::Ray;

/// A ray, and its length if it ends.
pub type ShadowRay = (Ray, Option<f64>);

/// The rays that are blocked, as bits.
pub struct Blocked<'a> {
    /// The scene.
    pub scene: &'a PreparedScene,
    /// The number of the primitive that each ray belongs to, which does not block it.
    pub own: &'a [u32; RAYS],
    /// Each of the packet's rays.
    pub ray: &'a dyn Fn(&RayPacket, usize) -> Option<ShadowRay>,
    /// Those that are certainly blocked.
    pub surely: u64,
    /// Those that may be.
    pub maybe: u64,
}

impl Search for Blocked<'_> {
    #[inline(always)]
    fn open(&self, packet: &RayPacket, found: &Candidate<'_>) -> u64 {
        let casts_shadow = self.scene.scene().shapes()[found.primitive.shape].casts_shadow;
        if casts_shadow { packet.in_use & !self.surely } else { 0 }
    }

    #[inline(always)]
    fn test_triangle<V: Lane<Element = f64>>(
        &mut self,
        token: V::Token,
        packet: &RayPacket,
        found: &Candidate<'_>,
        triangle: &PacketTriangle,
        at: usize,
    ) {
        // Closer to the surface than this, a neighbour does not block the light.
        let margin = 4.0 * found.geometry.least_shadow_distance() / packet.lengths[0] + ERROR_OF_DISTANCE;
        let crossing = triangle.cross::<V>(token, packet, at);
        let Met { surely, maybe } = triangle.met(token, &crossing, packet.range, margin);
        if surely | maybe != 0 {
            let others = self.others::<V>(found, at);
            self.surely |= u64::from(surely & others) << at;
            self.maybe |= u64::from(maybe & others) << at;
        }
    }

    #[inline(always)]
    fn test_body<V: Lane<Element = f64>>(
        &mut self,
        token: V::Token,
        packet: &RayPacket,
        found: &Candidate<'_>,
        body: &PacketBody,
        at: usize,
        rays: u32,
    ) -> u32 {
        let rays = rays & self.others::<V>(found, at);
        if rays == 0 {
            return 0;
        }
        let Met { surely, maybe } = body.met::<V>(token, packet, at, packet.range, ERROR_OF_DISTANCE);
        self.surely |= u64::from(surely & rays) << at;
        maybe & rays
    }

    #[inline(never)]
    fn test_rays(&mut self, packet: &RayPacket, found: &Candidate<'_>, rays: u64) {
        for index in set_bits(rays) {
            let Some((ray, distance)) = (self.ray)(packet, index) else { continue };
            match self.scene.blocks(found.primitive, &ray, distance) {
                Blocks::Surely => self.surely |= 1 << index,
                Blocks::Maybe => self.maybe |= 1 << index,
                Blocks::Not => {}
            }
        }
    }

    #[inline(always)]
    fn limit(&mut self, packet: &RayPacket) -> Option<f64> {
        (packet.in_use & !self.surely != 0).then_some(f64::INFINITY)
    }
}

impl Blocked<'_> {
    /// Of some rays, those that do not belong to a primitive themselves.
    #[inline(always)]
    fn others<V: Lane>(&self, found: &Candidate<'_>, at: usize) -> u32 {
        let own = &self.own[at..at + V::COUNT];
        own.iter().enumerate().fold(0, |bits, (lane, own)| bits | u32::from(*own != found.number) << lane)
    }
}
