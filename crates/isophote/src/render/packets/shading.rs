//! The light that reaches the points of a packet, and their brightness.

use super::ambient::AmbientLight;
use super::blocked::ShadowRay;
use super::rays::{RAYS, RayPacket, Vectors};
use super::{Blocked, Find, Hits, Packets, Place, bits, set_bits, those};
use crate::accelerate::Walk;
use crate::lanes::{Lane, LaneJob, Precision};
use crate::light::Emitter;
use crate::prepare::{AmbientIrradiance, AmbientShare, Hemisphere, Hit, LightAtPoint, PreparedScene};
use crate::ray::Ray;
use crate::reflectance::BrightnessFormula;
use crate::render::RenderError;
use crate::render::shading::block::{ShadedBlock, SurfaceBlock};
use crate::render::shading::emitters::Chosen;
use crate::render::shading::kernel::{PerPoint, ShadeBlock};
use crate::render::shading::lobe::Power;
use crate::render::vectors::{get, load, put, splat, store};
use crate::shape::Primitive;
use crate::vector::Vector;

/// What is to be shaded.
pub struct Subject<'h> {
    /// The scene.
    pub scene: &'h PreparedScene,
    /// The point of each ray.
    pub hits: &'h Hits,
    /// Where they come from.
    pub origin: Origin<'h>,
}

/// Where points come from.
#[derive(Clone, Copy)]
pub enum Origin<'h> {
    /// Rays have hit them that pass the screen here.
    Seen(&'h [Place; RAYS]),
    /// Points of shapes are taken as exact.
    Given,
    /// They lie on no shape but those that this knows of: only the light that they receive is computed.
    Free(&'h [Option<LightAtPoint>; RAYS]),
}

impl<'h> Subject<'h> {
    /// v of an emitter at a point, computed for itself.
    fn visibility(&self, ray: usize, emitter: usize) -> f64 {
        let Some(hit) = &self.hits[ray] else { return 0.0 };
        match self.origin {
            Origin::Seen(places) => self.scene.visibility(hit, Some(places[ray].position()))(emitter),
            Origin::Given => self.scene.visibility(hit, None)(emitter),
            Origin::Free(lights) => {
                lights[ray].as_ref().map_or(0.0, |light| self.scene.visibility_at(light, &hit.point, emitter))
            }
        }
    }

    /// The ambient light at a point, computed for itself.
    pub fn ambient_share(&self, ray: usize) -> AmbientShare {
        let Some(hit) = &self.hits[ray] else { return AmbientShare::ALL };
        match self.origin {
            Origin::Seen(_) | Origin::Given => self.scene.ambient_share(hit),
            Origin::Free(lights) => {
                let share = |light| self.scene.ambient_share_at(light, &hit.point);
                lights[ray].as_ref().map_or(AmbientShare::ALL, share)
            }
        }
    }

    /// Whether the light of a point is blocked by what is in its way alone.
    pub fn is_plain(&self, ray: usize) -> bool {
        match self.origin {
            Origin::Seen(_) | Origin::Given => self.hits[ray].as_ref().is_some_and(|hit| !hit.from_inside),
            Origin::Free(lights) => lights[ray].as_ref().is_some_and(LightAtPoint::is_plain),
        }
    }

    /// Whether a ray from a point sees the environment.
    pub fn sees_environment(&self, ray: usize, to_environment: &Ray) -> bool {
        match self.own(ray) {
            Some(own) => self.scene.sees_environment(&[own], to_environment),
            None => self.scene.sees_environment(&[], to_environment),
        }
    }

    /// The shape that a point belongs to.
    pub fn shape(&self, ray: usize) -> Option<usize> {
        self.hits[ray].as_ref().map(|hit| hit.primitive.shape)
    }

    /// The primitive that a point lies on.
    fn own(&self, ray: usize) -> Option<Primitive> {
        match self.origin {
            Origin::Seen(_) | Origin::Given => self.hits[ray].as_ref().map(|hit| hit.primitive),
            Origin::Free(lights) => lights[ray].as_ref().and_then(LightAtPoint::primitive),
        }
    }

    /// Whether a light casts shadows on a point.
    fn gets_shadows(&self, ray: usize, light: usize) -> bool {
        let scene = self.scene.scene();
        match (self.origin, &self.hits[ray]) {
            (Origin::Free(_), _) => scene.shadows() && scene.lights()[light].casts_shadows,
            (_, Some(hit)) => scene.casts_shadows(hit.primitive.shape, light),
            (_, None) => false,
        }
    }

    /// The directions in which the ambient light of the points may be blocked, if it may.
    pub fn obstructed_hemisphere(&self) -> Option<&'h Hemisphere> {
        self.scene.obstructed_hemisphere(!matches!(self.origin, Origin::Free(_)))
    }

    /// Tells the materials of points apart.
    fn formula_index(&self, hit: &Hit) -> usize {
        match self.origin {
            Origin::Seen(_) | Origin::Given => self.scene.formula_index(hit.primitive),
            Origin::Free(_) => 0,
        }
    }

    /// The convention applied in a layer to the material of a primitive, if points have one.
    fn formula<'s>(&self, layer: &'s PreparedScene, primitive: Primitive) -> &'s BrightnessFormula {
        match self.origin {
            Origin::Seen(_) | Origin::Given => layer.formula(primitive),
            Origin::Free(_) => layer.formula_without_material(),
        }
    }
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
    pub(super) packets: Packets<'a>,
    layers: Vec<&'a PreparedScene>,
    /// The emitters that light anything, in the order in which they are summed: their positions in that order, and their
    /// indices among the scene's.
    order: Vec<(usize, usize)>,
    /// The points by ray: where they are, their normals, and the offsets of their shadow rays.
    pub(super) anchor: Vectors,
    pub(super) offset: Vectors,
    pub(super) normal: Vectors,
    pub(super) shadow_ray_offset: Vectors,
    /// The number of each ray's primitive.
    pub(super) own: [u32; RAYS],
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
    /// The ambient light by ray.
    pub(super) ambient: AmbientLight,
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
            ambient: AmbientLight::new(),
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
        self.spread_out(subject);
        self.see_lights(subject, left, packet, walk);
        self.see_environment(subject, left, packet, walk);
        // The points of one material after those of another.
        while left != 0 {
            let Some(first) = &hits[left.trailing_zeros() as usize] else { break };
            let formula = subject.formula_index(first);
            let has_formula = |hit: &Hit| subject.formula_index(hit) == formula;
            let alike = those(left, |ray| hits[ray].as_ref().is_some_and(has_formula));
            left &= !alike;
            let rays: Vec<usize> = set_bits(alike).collect();
            self.shade_some(subject, &rays, output)?;
        }
        Ok(())
    }

    /// Writes the points by axis.
    fn spread_out(&mut self, subject: &Subject<'_>) {
        for (ray, hit) in subject.hits.iter().enumerate() {
            let Some(hit) = hit else {
                // It faces no light.
                put(Vector::default(), ray, &mut self.normal);
                continue;
            };
            put(hit.point.anchor, ray, &mut self.anchor);
            put(hit.point.offset, ray, &mut self.offset);
            put(hit.point.normal, ray, &mut self.normal);
            put(hit.shadow_ray_offset, ray, &mut self.shadow_ray_offset);
            self.own[ray] = subject.own(ray).map_or(u32::MAX, |own| subject.scene.number_of(own));
        }
    }

    /// Finds which lights the points see.
    fn see_lights(&mut self, subject: &Subject<'_>, present: u64, packet: &mut RayPacket, walk: &mut Walk) {
        let hits = subject.hits;
        let Packets { scene, instructions, .. } = self.packets;
        let from_inside = bits(hits.iter().map(|hit| hit.as_ref().is_some_and(|hit| hit.from_inside)));
        // Those whose lights are seen one by one.
        let special = match subject.origin {
            Origin::Free(_) => those(present, |ray| !subject.is_plain(ray)),
            Origin::Seen(_) | Origin::Given => 0,
        };
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
            let is_shut_out = |hit: &Hit| !scene.encloses(hit.primitive, emitter);
            let mut dark = those(lit & from_inside, |ray| hits[ray].as_ref().is_some_and(is_shut_out));
            let in_use = if scene.scene().shadows() {
                those(lit & !dark, |ray| subject.gets_shadows(ray, emitter.light))
            } else {
                0
            };
            let mut maybe = in_use & special;
            let in_use = in_use & !special;
            if in_use != 0 {
                let ray = |_: &RayPacket, ray: usize| -> Option<ShadowRay> {
                    let hit = hits[ray].as_ref()?;
                    scene.shadow_ray(&hit.point, hit.shadow_ray_offset, index)
                };
                packet.in_use = in_use;
                let mut blocked = Blocked { scene, own: &self.own, ray: &ray, surely: 0, maybe: 0 };
                instructions.run_wide(Find { scene, packet, walk, search: &mut blocked });
                let surely = blocked.surely & !close;
                dark |= surely;
                maybe |= (blocked.maybe | close & in_use) & !surely;
            }
            let start = self.visible.len();
            self.visible.extend((0..RAYS).map(|ray| if dark >> ray & 1 == 1 { 0.0 } else { 1.0 }));
            for ray in set_bits(maybe) {
                self.visible[start + ray] = subject.visibility(ray, index);
            }
            self.chosen.push((place, index));
        }
    }

    /// Shades some of the points, all of one material.
    fn shade_some(
        &mut self,
        subject: &Subject<'_>,
        rays: &[usize],
        output: &mut impl Output,
    ) -> Result<(), RenderError> {
        let Packets { lighting, instructions, .. } = self.packets;
        let Self { layers, chosen, visible, points, visible_there, ambient, emitters, shaded, .. } = self;
        points.count = rays.len();
        let mut primitive = None;
        for (at, ray) in rays.iter().enumerate() {
            let Some(hit) = &subject.hits[*ray] else { continue };
            primitive = Some(hit.primitive);
            points.set(at, hit);
        }
        let (Some(primitive), Some(last)) = (primitive, rays.last()) else { return Ok(()) };
        points.repeat_last();
        let stride = rays.len().next_multiple_of(16);
        visible_there.clear();
        for visible in visible.chunks_exact(RAYS) {
            visible_there.extend(rays.iter().chain(std::iter::repeat(last)).take(stride).map(|ray| visible[*ray]));
        }
        for (number, layer) in layers.iter().enumerate() {
            for (at, ray) in rays.iter().enumerate() {
                let share = ambient.shares[*ray];
                let AmbientIrradiance { irradiance, standard_error } = share.of(layer.scene().ambient());
                (points.ambient[at], shaded.ambient_error[at]) = (irradiance, standard_error);
            }
            emitters.choose(layer, lighting, chosen, |emitter| emitter.seen_from(Vector::default()));
            let formula = subject.formula(layer, primitive);
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
