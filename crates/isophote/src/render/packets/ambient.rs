//! The ambient light that arrives at the points of a packet. Points of a shape that face the same way look in one direction of
//! their hemispheres after another: these rays, which are nearly parallel, are a packet themselves.

use super::rays::{RAYS, RayPacket, Vectors};
use super::shading::{Shader, Subject};
use super::{Blocked, Find, Packets, set_bits, those};
use crate::accelerate::Walk;
use crate::lanes::{Lane, LaneJob};
use crate::prepare::{AmbientShare, Hemisphere, HemisphereDirection};
use crate::ray::Ray;
use crate::render::vectors::{get, load, put, splat, store};

/// The ambient light at the points of a packet.
pub struct AmbientLight {
    /// What arrives at each of them.
    pub shares: [AmbientShare; RAYS],
    /// Two unit vectors across each normal.
    across: [Vectors; 2],
}

/// The rays of fewer points than this are traced one by one.
const WORTH_A_PACKET: u32 = 4;

/// The cosine of the angle between axes that are nearly the same.
const ALIKE: f64 = 0.98;

impl AmbientLight {
    /// Nothing known yet.
    pub fn new() -> Self {
        Self { shares: [AmbientShare::ALL; RAYS], across: [[[0.0; RAYS]; 3]; 2] }
    }
}

impl Shader<'_> {
    /// Finds how much of the ambient light arrives at some of the points, given as bits.
    pub fn see_environment(&mut self, subject: &Subject<'_>, present: u64, packet: &mut RayPacket, walk: &mut Walk) {
        let hemisphere = subject.obstructed_hemisphere();
        let sampled = those(present, |ray| hemisphere.is_some() && subject.is_plain(ray));
        for ray in set_bits(present & !sampled) {
            self.ambient.shares[ray] = subject.ambient_share(ray);
        }
        let Some(hemisphere) = hemisphere.filter(|_| sampled != 0) else { return };
        for ray in set_bits(sampled) {
            let [first, second] = get(&self.normal, ray).perpendiculars();
            put(first, ray, &mut self.ambient.across[0]);
            put(second, ray, &mut self.ambient.across[1]);
        }
        let mut left = sampled;
        while left != 0 {
            let alike = self.facing_alike(subject, left);
            left &= !alike;
            self.sample(subject, hemisphere, alike, packet, walk);
        }
    }

    /// Of some points, the first one and those of the same shape whose hemispheres have nearly the same directions.
    fn facing_alike(&self, subject: &Subject<'_>, points: u64) -> u64 {
        let first = points.trailing_zeros() as usize;
        let axes = |ray: usize| [get(&self.normal, ray), get(&self.ambient.across[0], ray)];
        let ([normal, across], shape) = (axes(first), subject.shape(first));
        those(points, |ray| {
            let [other_normal, other_across] = axes(ray);
            let alike = normal.dot(other_normal).min(across.dot(other_across));
            alike > ALIKE && subject.shape(ray) == shape
        })
    }

    /// Samples the ambient light at points that are alike.
    fn sample(
        &mut self,
        subject: &Subject<'_>,
        hemisphere: &Hemisphere,
        points: u64,
        packet: &mut RayPacket,
        walk: &mut Walk,
    ) {
        let Packets { scene, instructions, .. } = self.packets;
        let first = points.trailing_zeros() as usize;
        let to_environment = |shader: &Self, packet: &RayPacket, ray: usize| Ray {
            anchor: get(&shader.anchor, ray),
            offset: get(&shader.offset, ray) + get(&shader.shadow_ray_offset, ray),
            direction: packet.direction_of(ray),
        };
        let mut free = [0_usize; RAYS];
        for direction in hemisphere.directions() {
            (packet.in_use, packet.range, packet.origin) = (points, [0.0, f64::INFINITY], get(&self.anchor, first));
            instructions.run_wide(Look { shader: self, direction, packet });
            let ray = |packet: &RayPacket, ray: usize| Some((to_environment(self, packet, ray), None));
            let mut blocked = Blocked { scene, own: &self.own, ray: &ray, surely: 0, maybe: 0 };
            if points.count_ones() < WORTH_A_PACKET {
                blocked.maybe = points;
            } else {
                instructions.run_wide(Find { scene, packet, walk, search: &mut blocked });
            }
            let Blocked { surely, maybe, .. } = blocked;
            for ray in set_bits(points & !surely) {
                let is_clear = |ray| subject.sees_environment(ray, &to_environment(self, packet, ray));
                free[ray] += usize::from(maybe >> ray & 1 == 0 || is_clear(ray));
            }
        }
        for ray in set_bits(points) {
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
