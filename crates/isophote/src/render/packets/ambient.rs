//! The ambient light that arrives at the points of a packet: all of them look in one direction of their hemispheres after
//! another, and these rays, which are nearly parallel, are a packet themselves.

use super::rays::{RAYS, RayPacket, Vectors};
use super::shading::{Shader, Subject};
use super::{Blocked, Find, set_bits};
use crate::accelerate::Walk;
use crate::lanes::{Lane, LaneJob};
use crate::prepare::{AmbientShare, HemisphereDirection};
use crate::ray::Ray;
use crate::render::vectors::{get, load, put, splat, store};

/// The ambient light at the points of a packet.
pub struct AmbientLight {
    /// What arrives at each of them.
    pub shares: [AmbientShare; RAYS],
    /// Two unit vectors across each normal.
    across: [Vectors; 2],
}

impl AmbientLight {
    /// Nothing known yet.
    pub fn new() -> Self {
        Self { shares: [AmbientShare::ALL; RAYS], across: [[[0.0; RAYS]; 3]; 2] }
    }
}

impl Shader<'_> {
    /// Finds how much of the ambient light arrives at some of the points, given as bits.
    pub fn see_environment(&mut self, subject: &Subject<'_>, present: u64, packet: &mut RayPacket, walk: &mut Walk) {
        let scene = self.packets.scene;
        let hemisphere = subject.obstructed_hemisphere(scene);
        let is_sampled = |ray: &usize| hemisphere.is_some() && subject.is_plain(*ray);
        let sampled = set_bits(present).filter(is_sampled).fold(0_u64, |bits, ray| bits | 1 << ray);
        for ray in set_bits(present & !sampled) {
            self.ambient.shares[ray] = subject.ambient_share(scene, ray);
        }
        let Some(hemisphere) = hemisphere.filter(|_| sampled != 0) else { return };
        for ray in set_bits(sampled) {
            let [first, second] = get(&self.normal, ray).perpendiculars();
            put(first, ray, &mut self.ambient.across[0]);
            put(second, ray, &mut self.ambient.across[1]);
        }
        let first = sampled.trailing_zeros() as usize;
        let start = |ray: usize| get(&self.offset, ray) + get(&self.shadow_ray_offset, ray);
        let to_environment = |packet: &RayPacket, ray: usize| Ray {
            anchor: get(&self.anchor, ray),
            offset: start(ray),
            direction: packet.direction_of(ray),
        };
        let mut free = [0_usize; RAYS];
        for direction in hemisphere.directions() {
            (packet.in_use, packet.range, packet.origin) = (sampled, [0.0, f64::INFINITY], get(&self.anchor, first));
            let instructions = self.packets.instructions;
            instructions.run_wide(Look { shader: self, direction, packet });
            let ray = |packet: &RayPacket, ray: usize| Some((to_environment(packet, ray), None));
            let mut blocked = Blocked { scene, own: &self.own, ray: &ray, surely: 0, maybe: 0 };
            instructions.run_wide(Find { scene, packet, walk, search: &mut blocked });
            let Blocked { surely, maybe, .. } = blocked;
            for ray in set_bits(sampled & !surely) {
                let is_clear = |ray| subject.sees_environment(scene, ray, &to_environment(packet, ray));
                free[ray] += usize::from(maybe >> ray & 1 == 0 || is_clear(ray));
            }
        }
        for ray in set_bits(sampled) {
            self.ambient.shares[ray] = hemisphere.share(free[ray]);
        }
    }
}

/// Directs a packet's rays in the same direction of each point's hemisphere.
struct Look<'l, 'a> {
    shader: &'l Shader<'a>,
    direction: &'l HemisphereDirection,
    packet: &'l mut RayPacket,
}

impl LaneJob for Look<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<S, D>(self, token: S::Token)
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        self.look::<D::Narrow>(token);
    }
}

impl Look<'_, '_> {
    #[inline(always)]
    fn look<V: Lane<Element = f64>>(self, token: V::Token) {
        let Self { shader: Shader { anchor, offset, normal, shadow_ray_offset, ambient, .. }, direction, packet } =
            self;
        let origin = splat::<V>(token, packet.origin);
        for at in (0..RAYS).step_by(V::COUNT) {
            let start = load::<V, _>(token, at, offset) + load(token, at, shadow_ray_offset);
            store((load::<V, _>(token, at, anchor) - origin) + start, at, &mut packet.start);
            let [first, second] = &ambient.across;
            let across = [load::<V, _>(token, at, first), load(token, at, second)];
            store(direction.about(load(token, at, normal), across), at, &mut packet.direction);
        }
    }
}
