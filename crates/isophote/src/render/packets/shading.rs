//! The light that reaches the points of a packet, and their brightness.

use super::rays::{RAYS, RayPacket, Vectors};
use super::{Blocked, Find, Hits, Packets, bits, set_bits};
use crate::accelerate::Walk;
use crate::camera::ScreenPosition;
use crate::lanes::{Lane, LaneJob, Precision};
use crate::light::Emitter;
use crate::prepare::{AmbientIrradiance, AmbientShare, PreparedScene};
use crate::ray::Ray;
use crate::render::RenderError;
use crate::render::shading::block::{ShadedBlock, SurfaceBlock};
use crate::render::shading::emitters::Chosen;
use crate::render::shading::kernel::{PerPoint, ShadeBlock};
use crate::render::shading::lobe::Power;
use crate::render::vectors::{get, load, put, splat, store};
use crate::vector::Vector;

/// What is to be shaded.
pub struct Subject<'h> {
    /// What each ray has hit.
    pub hits: &'h Hits,
    /// The screen positions of the rays; points that no ray has found are taken as exact.
    pub seen_at: Option<&'h [ScreenPosition; RAYS]>,
}

/// Takes what has been shaded.
pub trait Output {
    /// Takes the values of some rays in a layer.
    ///
    /// # Errors
    /// A value that a channel of single precision cannot hold.
    fn put(&mut self, layer: usize, rays: &[usize], shaded: &ShadedBlock<f64>) -> Result<(), RenderError>;

    /// Takes the points of some rays, once for all layers.
    fn put_geometry(&mut self, rays: &[usize], points: &SurfaceBlock<f64>);
}

/// Shades the points of packets, one packet after another.
pub struct Shader<'a> {
    packets: Packets<'a>,
    layers: Vec<&'a PreparedScene>,
    /// The emitters that light anything, in the order in which they are summed: their positions in that order, and their
    /// indices among the scene's.
    order: Vec<(usize, usize)>,
    /// The points by ray: where they are, their normals, and the offsets of their shadow rays.
    anchor: Vectors,
    offset: Vectors,
    normal: Vectors,
    shadow_ray_offset: Vectors,
    /// The number of each ray's primitive.
    own: [u32; RAYS],
    /// The first ray that has a point.
    first: usize,
    /// The emitters that are above the horizon of any point.
    chosen: Vec<(usize, usize)>,
    /// v of every ray for each of them.
    visible: Vec<f64>,
    /// The points of one material.
    points: Box<SurfaceBlock<f64>>,
    /// v of these points.
    visible_there: Vec<f64>,
    ambient: Vec<AmbientShare>,
    emitters: Chosen<f64>,
    shaded: Box<ShadedBlock<f64>>,
}

impl<'a> Shader<'a> {
    /// For the lights of a scene.
    pub fn new(packets: &Packets<'a>) -> Self {
        let zeros = [[0.0; RAYS]; 3];
        let scene = packets.scene;
        Self {
            packets: *packets,
            layers: scene.layers(),
            order: packets.lighting.shining(scene).enumerate().collect(),
            anchor: zeros,
            offset: zeros,
            normal: zeros,
            shadow_ray_offset: zeros,
            own: [0; RAYS],
            first: 0,
            chosen: Vec::new(),
            visible: Vec::new(),
            points: SurfaceBlock::anchored(),
            visible_there: Vec::new(),
            ambient: Vec::with_capacity(RAYS),
            emitters: Chosen::default(),
            shaded: ShadedBlock::new(packets.asked_for.len()),
        }
    }

    /// Shades what the rays of a packet have hit.
    pub fn shade(
        &mut self,
        subject: &Subject<'_>,
        packet: &mut RayPacket,
        walk: &mut Walk,
        output: &mut impl Output,
    ) -> Result<(), RenderError> {
        let hits = subject.hits;
        let mut left = bits(hits.iter().map(Option::is_some));
        if left == 0 {
            return Ok(());
        }
        self.first = left.trailing_zeros() as usize;
        self.spread_out(hits);
        self.see_lights(subject, left, packet, walk);
        // The points of one material after those of another.
        let scene = self.packets.scene;
        while left != 0 {
            let Some(first) = &hits[left.trailing_zeros() as usize] else { break };
            let formula = scene.formula_index(first.primitive);
            let has_formula =
                |ray: &usize| hits[*ray].as_ref().is_some_and(|hit| scene.formula_index(hit.primitive) == formula);
            let rays: Vec<usize> = set_bits(left).filter(has_formula).collect();
            for ray in &rays {
                left &= !(1 << ray);
            }
            self.shade_some(hits, &rays, output)?;
        }
        Ok(())
    }

    /// Writes the points by axis.
    fn spread_out(&mut self, hits: &Hits) {
        for (ray, hit) in hits.iter().enumerate() {
            let Some(hit) = hit else {
                // It faces no light.
                put(Vector::default(), ray, &mut self.normal);
                continue;
            };
            put(hit.point.anchor, ray, &mut self.anchor);
            put(hit.point.offset, ray, &mut self.offset);
            put(hit.point.normal, ray, &mut self.normal);
            put(hit.shadow_ray_offset, ray, &mut self.shadow_ray_offset);
            self.own[ray] = self.packets.scene.number_of(hit.primitive);
        }
    }

    /// Finds which lights the points see.
    fn see_lights(&mut self, subject: &Subject<'_>, present: u64, packet: &mut RayPacket, walk: &mut Walk) {
        let Subject { hits, seen_at } = subject;
        let Packets { scene, instructions, .. } = self.packets;
        let from_inside = bits(hits.iter().map(|hit| hit.as_ref().is_some_and(|hit| hit.from_inside)));
        self.chosen.clear();
        self.visible.clear();
        for at in 0..self.order.len() {
            let (place, index) = self.order[at];
            let emitter = &scene.emitters().all()[index];
            let Lit { lit, close } = instructions.run_wide(Aim { shader: self, emitter, packet });
            let lit = lit & present;
            if lit == 0 {
                continue;
            }
            let casts_shadow = |ray: &usize| {
                hits[*ray].as_ref().is_some_and(|hit| scene.scene().casts_shadows(hit.primitive.shape, emitter.light))
            };
            let mut dark = 0;
            for ray in set_bits(lit & from_inside) {
                let own = hits[ray].map(|hit| hit.primitive);
                dark |= u64::from(own.is_some_and(|own| !scene.encloses(own, emitter))) << ray;
            }
            let in_use = if scene.scene().shadows() {
                set_bits(lit & !dark).filter(casts_shadow).fold(0, |bits, ray| bits | 1 << ray)
            } else {
                0
            };
            let mut maybe = 0;
            if in_use != 0 {
                let ray = |ray: usize| -> Option<(Ray, Option<f64>)> {
                    let hit = hits[ray].as_ref()?;
                    scene.shadow_ray(&hit.point, hit.shadow_ray_offset, index)
                };
                packet.in_use = in_use;
                let mut blocked = Blocked { scene, own: &self.own, ray: &ray, surely: 0, maybe: 0 };
                instructions.run_wide(Find { scene, packet, walk, search: &mut blocked });
                let surely = blocked.surely & !close;
                dark |= surely;
                maybe = (blocked.maybe | close & in_use) & !surely;
            }
            let start = self.visible.len();
            self.visible.extend((0..RAYS).map(|ray| if dark >> ray & 1 == 1 { 0.0 } else { 1.0 }));
            for ray in set_bits(maybe) {
                let Some(hit) = &hits[ray] else { continue };
                let position = seen_at.map(|positions| positions[ray]);
                self.visible[start + ray] = scene.visibility(hit, position)(index);
            }
            self.chosen.push((place, index));
        }
    }

    /// Shades some of the points, all of one material.
    fn shade_some(&mut self, hits: &Hits, rays: &[usize], output: &mut impl Output) -> Result<(), RenderError> {
        let Packets { scene, lighting, instructions, .. } = self.packets;
        let Self { layers, chosen, visible, points, visible_there, ambient, emitters, shaded, .. } = self;
        ambient.clear();
        points.count = rays.len();
        let mut primitive = None;
        for (at, ray) in rays.iter().enumerate() {
            let Some(hit) = &hits[*ray] else { continue };
            primitive = Some(hit.primitive);
            points.set(at, hit);
            ambient.push(scene.ambient_share(hit));
        }
        let (Some(primitive), Some(last)) = (primitive, rays.last()) else { return Ok(()) };
        points.repeat_last();
        let stride = rays.len().next_multiple_of(16);
        visible_there.clear();
        for visible in visible.chunks_exact(RAYS) {
            visible_there.extend(rays.iter().chain(std::iter::repeat(last)).take(stride).map(|ray| visible[*ray]));
        }
        for (number, layer) in layers.iter().enumerate() {
            for (at, share) in ambient.iter().enumerate() {
                let AmbientIrradiance { irradiance, standard_error } = share.of(layer.scene().ambient());
                (points.ambient[at], shaded.ambient_error[at]) = (irradiance, standard_error);
            }
            emitters.choose(layer, lighting, chosen, |emitter| emitter.seen_from(Vector::default()));
            let formula = layer.formula(primitive);
            instructions.run(ShadeBlock {
                points,
                formula,
                power: &Power::of(formula, Precision::Double),
                selection: emitters.selection(),
                visibility: PerPoint { visible: visible_there, stride },
                shaded,
            });
            output.put(number, rays, shaded)?;
        }
        output.put_geometry(rays, points);
        Ok(())
    }
}

/// The points that face a light, as bits.
struct Lit {
    lit: u64,
    /// Those that it is so close to that their shadow rays start elsewhere.
    close: u64,
}

/// Directs a packet's rays at the points from an emitter; from the points, if it is a parallel one.
struct Aim<'f, 'a> {
    shader: &'f Shader<'a>,
    emitter: &'f Emitter,
    packet: &'f mut RayPacket,
}

impl LaneJob for Aim<'_, '_> {
    type Output = Lit;

    #[inline(always)]
    fn run<S, D>(self, token: S::Token) -> Lit
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        self.aim::<D::Narrow>(token)
    }
}

impl Aim<'_, '_> {
    #[inline(always)]
    fn aim<V: Lane<Element = f64>>(self, token: V::Token) -> Lit {
        let Self { shader: Shader { anchor, offset, normal, shadow_ray_offset, first, .. }, emitter, packet } = self;
        let position = splat::<V>(token, emitter.position);
        let is_parallel = emitter.place().is_none();
        let (mut lit, mut close) = (0, 0);
        (packet.origin, packet.range) = match emitter.place() {
            Some(place) => (place, [0.0, 1.0]),
            None => (get(anchor, *first), [0.0, f64::INFINITY]),
        };
        let origin = splat::<V>(token, packet.origin);
        let zero = V::splat(token, 0.0);
        for at in (0..RAYS).step_by(V::COUNT) {
            let (anchor, offset) = (load::<V, _>(token, at, anchor), load::<V, _>(token, at, offset));
            let (normal, spare) = (load::<V, _>(token, at, normal), load::<V, _>(token, at, shadow_ray_offset));
            if is_parallel {
                lit |= u64::from(V::bits(zero.is_less(normal.dot(position)))) << at;
                store((anchor - origin) + (offset + spare), at, &mut packet.start);
                store(position, at, &mut packet.direction);
                continue;
            }
            let to_light = (position - anchor) - offset;
            lit |= u64::from(V::bits(zero.is_less(normal.dot(to_light)))) << at;
            let longest = spare.dot(spare) * V::splat(token, 4.0);
            close |= u64::from(V::bits(to_light.dot(to_light).is_less(longest))) << at;
            store(Vector::new(zero, zero, zero), at, &mut packet.start);
            store(spare - to_light, at, &mut packet.direction);
        }
        Lit { lit, close }
    }
}
