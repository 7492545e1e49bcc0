//! Any shapes, seen by any camera: rays are traced in packets, those of a tile of pixels or of a pixel's samples.
//!
//! The rays of a packet, and later those from its surface points to each light, go through the tree together, and the primitives
//! that they may meet are tested for several rays at a time, with a margin for every rounding error. That decides which primitive
//! each ray certainly hits, and which points certainly see a light. The points themselves are then computed in lanes of 32 digits,
//! and the kernel shades them. What is too close to call is traced ray by ray. Since each decision is made per ray, it does not
//! matter to a bit which rays are in a packet.

mod ambient;
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
use self::precise::{PreciseRays, Visible};
pub use self::rays::RAYS;
use self::rays::{OCTET, RayPacket};
pub use self::shading::Output;
use self::shading::{Origin, Shader, Subject};
use crate::accelerate::Walk;
use crate::camera::ScreenPosition;
use crate::lanes::{Instructions, Lane, LaneJob};
use crate::map::{Pixel, Run};
use crate::prepare::{Hit, PreparedScene};
use crate::ray::Ray;
use crate::render::band::{self, Band, Tile};
use crate::render::cells::Cells;
use crate::render::fan_out::{Pixels, Shaded};
use crate::render::shading::block::{ShadedBlock, SurfaceBlock};
use crate::render::shading::emitters::Lighting;
use crate::render::{Observer, RenderError};
use crate::shape::Primitive;

/// Columns and rows of a tile.
pub const SIDE: u32 = 8;

/// The settings for tracing and shading packets.
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
}

/// Whether packets are compiled: not as WebAssembly, where the app would take 40 % longer to build.
pub const ARE_COMPILED: bool = !cfg!(target_arch = "wasm32");

/// Whether a scene is rendered by packets: the visibility of each light at each point of a tile is stored, so there must not
/// be too many lights. Processors with SSE2 alone have no packets.
pub fn supports(scene: &PreparedScene, instructions: Instructions) -> bool {
    instructions.are_wide() && scene.emitters().all().len() <= MOST_LIGHTS
}

const MOST_LIGHTS: usize = 8192;

/// A sharper highlight would show that normals in lanes are rounded more than once.
const SHARPEST: f64 = 1000.0;

/// Where a ray passes the screen.
#[derive(Clone, Copy)]
pub struct Place {
    /// The pixel of the full image.
    pub pixel: Pixel,
    /// Fractions of its width and height, from its upper left corner.
    pub within: [f64; 2],
}

impl Place {
    /// The same as a screen position.
    pub fn position(self) -> ScreenPosition {
        ScreenPosition::InPixel { pixel: self.pixel, place: self.within }
    }
}

/// What each ray of a packet hits.
pub type Hits = [Option<Hit>; RAYS];

impl Packets<'_> {
    /// Fills a band, and returns what its pixels see.
    pub fn fill(&self, band: Band<'_>, observer: Option<&dyn Observer>) -> Result<Vec<Run>, RenderError> {
        let mut tracer = Tracer::new(*self);
        let mut output = InBand::new(band);
        for tile in output.band.tiles(SIDE, SIDE) {
            output.tile = tile;
            tracer.trace_tile(tile);
            for (ray, hit) in tracer.hits.iter().enumerate() {
                if let Some(hit) = hit {
                    output.see(ray, u32::try_from(hit.primitive.shape).unwrap_or(band::NOTHING));
                }
            }
            tracer.shade(&mut output)?;
            band::advance(observer, u64::from(tile.width) * u64::from(tile.height))?;
        }
        Ok(output.band.runs(&output.seen))
    }

    /// Fills a band of a map with points that no rays have found; those that there are belong to this shape.
    pub fn fill_cells(
        &self,
        band: Band<'_>,
        shape: u32,
        cells: &Cells<'_>,
        observer: Option<&dyn Observer>,
    ) -> Result<Vec<Run>, RenderError> {
        let mut tracer = Tracer::new(*self);
        let mut lights = Box::new([const { None }; RAYS]);
        let mut output = InBand::new(band);
        for tile in output.band.tiles(SIDE, SIDE) {
            output.tile = tile;
            let mut count = 0;
            tracer.hits.fill(None);
            for ray in (0..RAYS).filter(|ray| is_in(tile, *ray)) {
                let pixel = pixel_of(tile, ray);
                tracer.hits[ray] = match cells {
                    Cells::OnShapes(cell) => cell(pixel),
                    Cells::Free(cell) => cell(pixel).map(|point| {
                        lights[ray] = Some(self.scene.light_at(&point));
                        Hit::on_no_shape(point)
                    }),
                };
                if tracer.hits[ray].is_some() {
                    output.see(ray, shape);
                    count += 1;
                }
            }
            let origin = match cells {
                Cells::OnShapes(_) => Origin::Given,
                Cells::Free(_) => Origin::Free(&lights),
            };
            let Tracer { hits, packet, walk, shader, .. } = &mut tracer;
            shader.shade(&Subject { scene: self.scene, hits, origin }, packet, walk, &mut output)?;
            band::advance(observer, count)?;
        }
        Ok(output.band.runs(&output.seen))
    }
}

/// The pixels of a band, of which those of a tile are being filled.
struct InBand<'m> {
    band: Band<'m>,
    /// The shape that each of them sees.
    seen: Vec<u32>,
    tile: Tile,
    /// Where the points of a block go.
    indices: Vec<usize>,
}

impl<'m> InBand<'m> {
    fn new(band: Band<'m>) -> Self {
        let seen = vec![band::NOTHING; band.size.pixels()];
        let tile = Tile { first: band.first, width: 0, height: 0 };
        Self { band, seen, tile, indices: Vec::with_capacity(RAYS) }
    }

    fn see(&mut self, ray: usize, shape: u32) {
        self.seen[self.band.index(pixel_of(self.tile, ray))] = shape;
    }

    fn find(&mut self, rays: &[usize]) {
        self.indices.clear();
        self.indices.extend(rays.iter().map(|ray| self.band.index(pixel_of(self.tile, *ray))));
    }
}

/// Traces and shades one packet after another in the same memory.
pub struct Tracer<'a> {
    packets: Packets<'a>,
    packet: Box<RayPacket>,
    /// The same rays with 32 digits.
    precise: Box<PreciseRays<'a>>,
    /// Where the rays pass the screen.
    places: Box<[Place; RAYS]>,
    nearest: Box<Nearest>,
    points: Box<Points>,
    walk: Walk,
    hits: Box<Hits>,
    shader: Shader<'a>,
}

impl<'a> Tracer<'a> {
    /// Without rays.
    pub fn new(packets: Packets<'a>) -> Self {
        Self {
            packets,
            packet: RayPacket::new(),
            precise: PreciseRays::new(packets.scene.precise_frame().in_lanes()),
            places: Box::new([Place { pixel: Pixel { column: 0, row: 0 }, within: [0.5; 2] }; RAYS]),
            nearest: Nearest::new(),
            points: Points::new(),
            walk: Walk::default(),
            hits: Box::new([None; RAYS]),
            shader: Shader::new(&packets),
        }
    }

    /// What the rays have hit.
    pub fn hits(&self) -> &Hits {
        &self.hits
    }

    /// Traces the rays through the pixels of a tile.
    fn trace_tile(&mut self, tile: Tile) {
        let within = self.packets.scene.frame().place;
        for (ray, place) in self.places.iter_mut().enumerate() {
            *place = Place { pixel: pixel_of(tile, ray), within };
        }
        self.trace_rays(bits((0..RAYS).map(|ray| is_in(tile, ray))));
    }

    /// Traces rays through pixels, up to as many as a packet has.
    pub fn trace(&mut self, rays: impl Iterator<Item = Place>) {
        let mut count = 0;
        for (place, of_ray) in rays.zip(&mut *self.places) {
            *of_ray = place;
            count += 1;
        }
        self.trace_rays(bits((0..RAYS).map(|ray| ray < count)));
    }

    fn trace_rays(&mut self, in_use: u64) {
        self.hits.fill(None);
        self.aim(in_use);
        if self.packet.in_use == 0 {
            return;
        }
        let Self { packets: Packets { scene, instructions, .. }, packet, nearest, walk, .. } = self;
        instructions.run_wide(Find { scene, packet, walk, search: &mut **nearest });
        self.find_points();
        self.clear_offsets();
    }

    /// Shades what the rays have hit.
    pub fn shade(&mut self, output: &mut impl Output) -> Result<(), RenderError> {
        let Self { packets, places, hits, packet, walk, shader, .. } = self;
        let subject = Subject { scene: packets.scene, hits, origin: Origin::Seen(places) };
        shader.shade(&subject, packet, walk, output)
    }

    /// Sets the rays.
    fn aim(&mut self, in_use: u64) {
        let Self { packets: Packets { scene, instructions, .. }, packet, precise, places, nearest, .. } = self;
        packet.range = [0.0, f64::INFINITY];
        packet.in_use = in_use;
        precise.aim(places);
        let Visible { surely, maybe } = instructions.run_wide(precise::Aim { rays: precise, packet });
        let is_seen = |ray: usize| scene.frame().ray(places[ray].position()).is_some();
        packet.in_use &= surely | those(maybe & in_use, is_seen);
        nearest.clear();
    }

    /// The points that the rays hit. What is too close to call is traced by itself, but only to learn which primitive it hits: each
    /// ray's point is computed in the same way, whatever other rays are in the packet.
    fn find_points(&mut self) {
        let Self {
            packets: Packets { scene, instructions, .. }, packet, precise, nearest, points, hits, places, ..
        } = self;
        let mut left = 0_u64;
        let mut primitives = [Primitive { shape: 0, part: 0 }; RAYS];
        for index in set_bits(packet.in_use) {
            let seen = match nearest.seen(index) {
                Seen::Nothing => None,
                Seen::Doubtful => scene.trace(places[index].position()).map(|hit| hit.primitive),
                Seen::Primitive(number) => Some(scene.primitive(number)),
            };
            if let Some(primitive) = seen {
                primitives[index] = primitive;
                left |= 1 << index;
            }
        }
        points.clear();
        let kind = |ray: usize| (primitives[ray].shape, scene.has_sharper_highlight(primitives[ray], SHARPEST));
        while left != 0 {
            let (shape, is_sharp) = kind(left.trailing_zeros() as usize);
            let on_shape = those(left, |ray| kind(ray) == (shape, is_sharp));
            left &= !on_shape;
            if !is_sharp {
                let geometry = scene.geometry(shape);
                instructions.run_wide(FindPoints {
                    rays: precise,
                    on_shape,
                    geometry,
                    primitives: &primitives,
                    points,
                });
            }
            for index in set_bits(on_shape) {
                let (primitive, position) = (primitives[index], places[index].position());
                hits[index] = if is_sharp {
                    let hit = scene.frame().ray(position).and_then(|ray| scene.hit_on(primitive, &ray));
                    hit.or_else(|| scene.precise_hit_on(primitive, position))
                } else {
                    points.hit(index, primitive, precise)
                };
                if hits[index].is_none() {
                    hits[index] = scene.trace(position);
                }
            }
        }
    }

    /// Shortens the offsets of shadow rays that have something in their way.
    fn clear_offsets(&mut self) {
        let Self { packets: Packets { scene, instructions, .. }, packet, walk, hits, places, .. } = self;
        let has_offset = |hit: &Hit| hit.shadow_ray_offset.dot(hit.shadow_ray_offset) > 0.0;
        let in_use = bits(hits.iter().map(|hit| hit.as_ref().is_some_and(has_offset)));
        if in_use == 0 || !scene.casts_shadows_between_shapes() {
            return;
        }
        let mut own = [0; RAYS];
        (packet.in_use, packet.range) = (in_use, [0.0, 1.0]);
        packet.origin = hits[in_use.trailing_zeros() as usize].map(|hit| hit.point.anchor).unwrap_or_default();
        for index in set_bits(in_use) {
            let Some(hit) = &hits[index] else { continue };
            own[index] = scene.number_of(hit.primitive);
            packet.set(index, (hit.point.anchor - packet.origin) + hit.point.offset, hit.shadow_ray_offset);
        }
        let ray = |_: &RayPacket, index: usize| {
            let hit = hits[index].as_ref()?;
            let length = hit.shadow_ray_offset.length();
            let direction = hit.shadow_ray_offset * (1.0 / length);
            Some((Ray { anchor: hit.point.anchor, offset: hit.point.offset, direction }, Some(length)))
        };
        let mut blocked = Blocked { scene, own: &own, ray: &ray, surely: 0, maybe: 0 };
        instructions.run_wide(Find { scene, packet, walk, search: &mut blocked });
        for index in set_bits(blocked.surely | blocked.maybe) {
            if let Some(hit) = &mut hits[index] {
                let (clear, is_doubtful) = scene.clear_shadow_ray_offset(hit);
                let again = if is_doubtful { scene.trace(places[index].position()) } else { None };
                hit.shadow_ray_offset = again.map_or(clear, |hit| hit.shadow_ray_offset);
            }
        }
    }
}

impl Output for InBand<'_> {
    fn put(&mut self, layer: usize, rays: &[usize], shaded: &ShadedBlock<f64>) -> Result<(), RenderError> {
        self.find(rays);
        self.band.put(layer, Pixels::At(&self.indices), Shaded::Double(shaded))
    }

    fn put_geometry(&mut self, rays: &[usize], points: &SurfaceBlock<f64>) {
        if self.band.has_geometry() {
            self.find(rays);
            self.band.put_geometry(Pixels::At(&self.indices), points);
        }
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

/// Whether there is a pixel for a ray in a tile, which may be cut.
fn is_in(tile: Tile, ray: usize) -> bool {
    let (column, row) = place_of(ray);
    column < tile.width && row < tile.height
}

fn pixel_of(tile: Tile, ray: usize) -> Pixel {
    let (column, row) = place_of(ray);
    Pixel { column: tile.first.column + column, row: tile.first.row + row }
}

/// The positions of the bits that are set.
fn set_bits(mut bits: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let next = (bits != 0).then(|| bits.trailing_zeros() as usize)?;
        bits &= bits - 1;
        Some(next)
    })
}

/// Those of the bits for which something holds.
fn those(all: u64, holds: impl Fn(usize) -> bool) -> u64 {
    set_bits(all).filter(|bit| holds(*bit)).fold(0, |those, bit| those | 1 << bit)
}

/// A bit for each answer.
fn bits(answers: impl Iterator<Item = bool>) -> u64 {
    answers.enumerate().fold(0, |bits, (index, answer)| bits | u64::from(answer) << index)
}
