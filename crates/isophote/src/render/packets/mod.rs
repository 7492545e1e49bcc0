//! Any shapes, seen by any camera: rays are traced in packets, tile by tile.
//!
//! The rays of a tile, and later those from its surface points to each light, go through the tree together, and the primitives
//! that they may meet are tested for several rays at a time, with a margin for every rounding error. That decides which primitive
//! each ray certainly hits, and which points certainly see a light. The points themselves are then computed in lanes of 32 digits,
//! and the kernel shades them. What is too close to call is traced ray by ray. Since each decision is made per ray, neither tiles
//! nor packets change a bit.

mod blocked;
mod body;
mod candidates;
mod nearest;
mod points;
mod precise;
mod rays;
mod shading;
mod triangle;

use self::blocked::Blocked;
use self::candidates::Search;
use self::nearest::{Nearest, Seen};
use self::points::{FindPoints, Points};
use self::precise::{Combine, PreciseRays};
use self::rays::{OCTET, RAYS, RayPacket};
use self::shading::Shader;
use crate::accelerate::Walk;
use crate::camera::ScreenPosition;
use crate::lanes::{Instructions, Lane, LaneJob};
use crate::map::{Pixel, Run};
use crate::prepare::{Hit, PreparedScene};
use crate::ray::Ray;
use crate::render::band::{self, Band, Tile};
use crate::render::hits::HitBlock;
use crate::render::shading::emitters::Lighting;
use crate::render::{Observer, RenderError, rays as single_rays};
use crate::shape::Primitive;

/// Columns and rows of a tile.
pub const SIDE: u32 = 8;

/// The settings for filling bands.
#[derive(Clone, Copy)]
pub struct Packets<'a> {
    /// The scene.
    pub scene: &'a PreparedScene,
    /// Its lights.
    pub lighting: &'a Lighting,
    /// The lights whose own irradiance is requested.
    pub asked_for: &'a [usize],
    /// The instruction set to use.
    pub instructions: Instructions,
    /// Receives progress reports.
    pub observer: Option<&'a dyn Observer>,
}

/// Whether a scene is rendered by packets: the visibility of each light at each point of a tile is stored, so there must not
/// be too many lights. Packets are not compiled for machines whose vectors have two numbers.
pub fn supports(scene: &PreparedScene, instructions: Instructions) -> bool {
    instructions.are_wide() && scene.emitters().all().len() <= MOST_LIGHTS
}

const MOST_LIGHTS: usize = 8192;

/// A sharper highlight would show that normals in lanes are rounded more than once.
const SHARPEST: f64 = 1000.0;

/// What each ray of a tile hits.
type Hits = [Option<Hit>; RAYS];

impl Packets<'_> {
    /// Fills a band, and returns what its pixels see.
    pub fn fill(&self, mut band: Band<'_>) -> Result<Vec<Run>, RenderError> {
        let mut work = Work {
            packets: *self,
            packet: RayPacket::new(),
            is_precise: false,
            precise: PreciseRays::new(),
            nearest: Nearest::new(),
            points: Points::new(),
            walk: Walk::default(),
            hits: Box::new([None; RAYS]),
            shader: Shader::new(self),
            one_by_one: HitBlock::new(self.scene, self.asked_for),
            seen: vec![band::NOTHING; band.size.pixels()],
        };
        work.is_precise = work.precise.begin(self.scene, &band);
        for tile in band.tiles(SIDE, SIDE) {
            work.tile(tile, &mut band)?;
            band::advance(self.observer, u64::from(tile.width) * u64::from(tile.height))?;
        }
        work.one_by_one.put(&mut band)?;
        Ok(band.runs(&work.seen))
    }
}

/// The scratch memory of a thread, reused from tile to tile.
struct Work<'a> {
    packets: Packets<'a>,
    packet: Box<RayPacket>,
    /// The same rays with 32 digits, if the camera has them.
    is_precise: bool,
    precise: Box<PreciseRays>,
    nearest: Box<Nearest>,
    points: Box<Points>,
    walk: Walk,
    hits: Box<Hits>,
    shader: Shader<'a>,
    /// Points that are traced and shaded one by one.
    one_by_one: HitBlock<'a>,
    /// The shape that each pixel of the band sees.
    seen: Vec<u32>,
}

impl Work<'_> {
    fn tile(&mut self, tile: Tile, band: &mut Band<'_>) -> Result<(), RenderError> {
        let scene = self.packets.scene;
        self.aim(tile);
        if self.packet.in_use == 0 {
            return Ok(());
        }
        let Self { packets: Packets { instructions, .. }, packet, nearest, walk, .. } = self;
        instructions.run_wide(Find { scene, packet, walk, search: &mut **nearest });
        let mut doubtful = self.find_points(tile);
        doubtful |= self.clear_offsets();
        for ray in set_bits(doubtful) {
            let pixel = pixel_of(tile, ray);
            if let Some(hit) = scene.trace_pixel(pixel) {
                single_rays::put(pixel, &hit, band, &mut self.one_by_one)?;
                self.seen[band.index(pixel)] = shape_of(&hit);
            }
            self.hits[ray] = None;
        }
        for (ray, hit) in self.hits.iter().enumerate() {
            if let Some(hit) = hit {
                self.seen[band.index(pixel_of(tile, ray))] = shape_of(hit);
            }
        }
        self.shader.shade(&self.hits, tile, &mut self.packet, &mut self.walk, band)
    }

    /// Sets the rays of a tile.
    fn aim(&mut self, tile: Tile) {
        let Self { packets: Packets { scene, instructions, .. }, packet, is_precise, precise, nearest, .. } = self;
        packet.range = [0.0, f64::INFINITY];
        packet.in_use = bits((0..RAYS).map(|index| {
            let (column, row) = place_of(index);
            column < tile.width && row < tile.height
        }));
        if *is_precise {
            precise.aim(tile);
            instructions.run_wide(Combine { rays: precise, packet });
        } else {
            packet.origin = scene.frame().eye;
            for index in set_bits(packet.in_use) {
                match scene.frame().ray(ScreenPosition::PixelCenter(pixel_of(tile, index))) {
                    Some(ray) => packet.set(index, ray.start_from(packet.origin), ray.direction),
                    None => packet.in_use &= !(1 << index),
                }
            }
        }
        nearest.clear();
    }

    /// The points that the rays hit; returns the rays for which a double is not enough, as bits.
    fn find_points(&mut self, tile: Tile) -> u64 {
        let Self {
            packets: Packets { scene, instructions, .. },
            packet,
            is_precise,
            precise,
            nearest,
            points,
            hits,
            ..
        } = self;
        let mut doubtful = 0;
        let mut left = 0_u64;
        let mut primitives = [Primitive { shape: 0, part: 0 }; RAYS];
        hits.fill(None);
        for index in set_bits(packet.in_use) {
            match nearest.seen(index) {
                Seen::Nothing => {}
                Seen::Doubtful => doubtful |= 1 << index,
                Seen::Primitive(number) => {
                    primitives[index] = scene.primitive(number);
                    left |= 1 << index;
                }
            }
        }
        points.clear();
        while left != 0 {
            let Primitive { shape, .. } = primitives[left.trailing_zeros() as usize];
            let on_shape = set_bits(left).filter(|ray| primitives[*ray].shape == shape);
            let on_shape = on_shape.fold(0, |bits, ray| bits | 1 << ray);
            left &= !on_shape;
            let geometry = scene.geometry(shape);
            let is_sharp = |ray: usize| scene.has_sharper_highlight(primitives[ray], SHARPEST);
            let in_lanes = *is_precise && !set_bits(on_shape).any(is_sharp);
            if in_lanes {
                instructions.run_wide(FindPoints {
                    rays: precise,
                    on_shape,
                    geometry,
                    primitives: &primitives,
                    points,
                });
            }
            for index in set_bits(on_shape) {
                let primitive = primitives[index];
                hits[index] = if in_lanes {
                    points.hit(index, primitive, precise)
                } else {
                    let position = ScreenPosition::PixelCenter(pixel_of(tile, index));
                    let hit = scene.hit_on(primitive, &packet.ray(index));
                    hit.or_else(|| scene.precise_hit_on(primitive, position))
                };
                doubtful |= u64::from(hits[index].is_none()) << index;
            }
        }
        doubtful
    }

    /// Shortens the offsets of shadow rays that have something in their way; returns the rays for which a double is not enough
    /// to tell, as bits.
    fn clear_offsets(&mut self) -> u64 {
        let Self { packets: Packets { scene, instructions, .. }, packet, walk, hits, .. } = self;
        let has_offset = |hit: &Hit| hit.shadow_ray_offset.dot(hit.shadow_ray_offset) > 0.0;
        let in_use = bits(hits.iter().map(|hit| hit.as_ref().is_some_and(has_offset)));
        if in_use == 0 || !scene.casts_shadows_between_shapes() {
            return 0;
        }
        let mut own = [0; RAYS];
        (packet.in_use, packet.range) = (in_use, [0.0, 1.0]);
        packet.origin = hits[in_use.trailing_zeros() as usize].map(|hit| hit.point.anchor).unwrap_or_default();
        for index in set_bits(in_use) {
            let Some(hit) = &hits[index] else { continue };
            own[index] = scene.number_of(hit.primitive);
            packet.set(index, (hit.point.anchor - packet.origin) + hit.point.offset, hit.shadow_ray_offset);
        }
        let ray = |index: usize| {
            let hit = hits[index].as_ref()?;
            let length = hit.shadow_ray_offset.length();
            let direction = hit.shadow_ray_offset * (1.0 / length);
            Some((Ray { anchor: hit.point.anchor, offset: hit.point.offset, direction }, Some(length)))
        };
        let mut blocked = Blocked { scene, own: &own, ray: &ray, surely: 0, maybe: 0 };
        instructions.run_wide(Find { scene, packet, walk, search: &mut blocked });
        let mut doubtful = 0;
        for index in set_bits(blocked.surely | blocked.maybe) {
            if let Some(hit) = &mut hits[index] {
                let (clear, is_doubtful) = scene.clear_shadow_ray_offset(hit);
                hit.shadow_ray_offset = clear;
                doubtful |= u64::from(is_doubtful) << index;
            }
        }
        doubtful
    }
}

/// Searches what the rays of a packet meet.
struct Find<'f, Q> {
    scene: &'f PreparedScene,
    packet: &'f mut RayPacket,
    walk: &'f mut Walk,
    search: &'f mut Q,
}

impl<Q: Search> LaneJob for Find<'_, Q> {
    type Output = ();

    #[inline(always)]
    fn run<S, D>(self, token: S::Token)
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        self.packet.finish::<D::Narrow>(token);
        candidates::search::<S::Narrow, D::Narrow>(token, self.scene, self.packet, self.walk, self.search);
    }
}

/// Column and row of a ray in its tile: an octet is four columns wide and two rows high.
#[expect(clippy::cast_possible_truncation, reason = "below 8")]
fn place_of(ray: usize) -> (u32, u32) {
    let (octet, lane) = (ray / OCTET, ray % OCTET);
    ((octet % 2 * 4 + lane % 4) as u32, (octet / 2 * 2 + lane / 4) as u32)
}

fn pixel_of(tile: Tile, ray: usize) -> Pixel {
    let (column, row) = place_of(ray);
    Pixel { column: tile.first.column + column, row: tile.first.row + row }
}

fn shape_of(hit: &Hit) -> u32 {
    u32::try_from(hit.primitive.shape).unwrap_or(band::NOTHING)
}

/// The positions of the bits that are set.
fn set_bits(mut bits: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let next = (bits != 0).then(|| bits.trailing_zeros() as usize)?;
        bits &= bits - 1;
        Some(next)
    })
}

/// A bit for each answer.
fn bits(answers: impl Iterator<Item = bool>) -> u64 {
    answers.enumerate().fold(0, |bits, (index, answer)| bits | u64::from(answer) << index)
}
