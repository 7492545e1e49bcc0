//! What the rays of a packet hit first.

use super::body::{First, PacketBody};
use super::candidates::{Candidate, Search};
use super::rays::{RAYS, RayPacket};
use super::set_bits;
use super::triangle::{Met, PacketTriangle};
use crate::lanes::Lane;
use crate::prepare::ERROR_OF_DISTANCE;
use crate::shape::Accuracy;

/// The nearest hits so far.
pub struct Nearest {
    /// t of the nearest hit, its possible error, and the number of the primitive, −1 for none.
    distance: [f64; RAYS],
    error: [f64; RAYS],
    number: [f64; RAYS],
    /// The least t at which a double may have decided wrongly.
    doubtful_from: [f64; RAYS],
    /// The largest distance of a ray, unless it has to be found again.
    farthest: Option<f64>,
}

/// What a ray of a packet hits.
pub enum Seen {
    /// Nothing.
    Nothing,
    /// A primitive, by its number.
    Primitive(u32),
    /// It takes more than a double to tell.
    Doubtful,
}

impl Nearest {
    /// Nothing found yet.
    pub fn new() -> Box<Self> {
        Box::new(Self {
            distance: [0.0; RAYS],
            error: [0.0; RAYS],
            number: [0.0; RAYS],
            doubtful_from: [0.0; RAYS],
            farthest: None,
        })
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.distance.fill(f64::INFINITY);
        self.error.fill(0.0);
        self.number.fill(-1.0);
        self.doubtful_from.fill(f64::INFINITY);
        self.farthest = None;
    }

    /// What a ray hits.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a primitive's number, or −1")]
    pub fn seen(&self, ray: usize) -> Seen {
        let doubtful_from = self.doubtful_from[ray];
        if doubtful_from < f64::INFINITY && !(self.distance[ray] + self.error[ray] < doubtful_from) {
            return Seen::Doubtful;
        }
        if self.number[ray] < 0.0 {
            return Seen::Nothing;
        }
        Seen::Primitive(self.number[ray] as u32)
    }

    fn doubt(&mut self, ray: usize, from: f64) {
        // Written so that NaN counts as doubtful from the start.
        let from = if from > 0.0 { from } else { 0.0 };
        self.doubtful_from[ray] = self.doubtful_from[ray].min(from);
    }

    /// Takes hits of some of the rays.
    #[inline(always)]
    fn take<V: Lane<Element = f64>>(&mut self, token: V::Token, at: usize, rays: u32, t: V, error: V, number: u32) {
        let mut mask = [0.0; 16];
        for (lane, mask) in mask[..V::COUNT].iter_mut().enumerate() {
            *mask = f64::from(rays >> lane & 1);
        }
        let is_hit = V::splat(token, 0.5).is_less(V::load(token, &mask));
        let t = V::select(is_hit, t, V::splat(token, f64::INFINITY));
        let (before, error_before) = (V::load(token, &self.distance[at..]), V::load(token, &self.error[at..]));
        let gap = (t - before).max(before - t);
        // Where surfaces cross, the order of their distances is as uncertain as the distances themselves.
        let uncertain = V::splat(token, ERROR_OF_DISTANCE).mul_add(t, error_before + error);
        let close = V::bits(gap.is_less(uncertain)) & rays;
        if close != 0 {
            self.doubt_some(at, close, t.min(before) - uncertain);
        }
        let is_nearer = t.is_less(before);
        V::select(is_nearer, t, before).store(&mut self.distance[at..]);
        V::select(is_nearer, error, error_before).store(&mut self.error[at..]);
        let numbers = V::load(token, &self.number[at..]);
        V::select(is_nearer, V::splat(token, f64::from(number)), numbers).store(&mut self.number[at..]);
        self.farthest = None;
    }

    #[inline(never)]
    fn doubt_some<V: Lane<Element = f64>>(&mut self, at: usize, rays: u32, from: V) {
        let mut all = [0.0; 16];
        from.store(&mut all);
        for (lane, from) in all[..V::COUNT].iter().enumerate().filter(|(lane, _)| rays >> lane & 1 == 1) {
            self.doubt(at + lane, *from);
        }
    }
}

impl Search for Nearest {
    #[inline(always)]
    fn open(&self, packet: &RayPacket, _: &Candidate<'_>) -> u64 {
        packet.in_use
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
        let crossing = triangle.cross::<V>(token, packet, at);
        let Met { surely, maybe } = triangle.met(token, &crossing, packet.range, 0.0);
        if maybe != 0 {
            self.doubt_some(at, maybe, crossing.t - crossing.error);
        }
        if surely != 0 {
            self.take(token, at, surely, crossing.t, crossing.error, found.number);
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
        let First { t, error, met: Met { surely, maybe } } = body.first::<V>(token, packet, at);
        if surely & rays != 0 {
            self.take(token, at, surely & rays, t, error, found.number);
        }
        maybe & rays
    }

    #[inline(never)]
    fn test_rays(&mut self, packet: &RayPacket, found: &Candidate<'_>, rays: u64) {
        for index in set_bits(rays) {
            let intersection =
                found.geometry.intersect(found.primitive.part, &packet.ray(index), Accuracy::OF_VISIBILITY);
            if let Some(from) = intersection.doubtful_from {
                self.doubt(index, from);
            }
            let Some(hit) = intersection.hit else { continue };
            let (t, before) = (hit.distance, self.distance[index]);
            let uncertain = self.error[index] + ERROR_OF_DISTANCE * t;
            if (t - before).abs() < uncertain {
                self.doubt(index, t.min(before) - uncertain);
            }
            if t < before {
                (self.distance[index], self.error[index]) = (t, 0.0);
                self.number[index] = f64::from(found.number);
                self.farthest = None;
            }
        }
    }

    #[inline(always)]
    fn limit(&mut self, packet: &RayPacket) -> Option<f64> {
        if self.farthest.is_none() {
            let mut farthest = 0.0_f64;
            for ray in set_bits(packet.in_use) {
                farthest = farthest.max(self.distance[ray] + self.error[ray]);
            }
            // What is doubtful may be a little farther.
            self.farthest = Some(farthest * (1.0 + 1e-9));
        }
        self.farthest
    }
}
