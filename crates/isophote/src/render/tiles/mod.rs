//! Clouds of spheres, and shadows between them: the screen is rendered tile by tile.
//!
//! The visible surfaces of a tile are drawn into a depth buffer, sphere after sphere from near to far, from the
//! [outlines](crate::shape::Ellipse) of the spheres in its beam. The pixels of a tile that see the same sphere form a group:
//! the spheres that may block their light are looked up once for all of them, in the tube from their part of the sphere to
//! the light, and tested for several pixels at a time. Where a decision is too close for a double, the pixel is traced with
//! 32 digits. Since each decision is made per pixel, neither tiles nor groups nor the order of tests changes a bit.

mod canvas;
mod group;
mod outlines;
mod shading;
mod shadow;

use self::canvas::{Canvas, Draw};
use self::group::{Group, Groups};
use self::outlines::{Outlines, Prepare, Take, View};
use self::shading::Shader;
use crate::accelerate::Walk;
use crate::camera::Projection;
use crate::lanes::{Instructions, Precision};
use crate::map::{Pixel, Run};
use crate::prepare::PreparedScene;
use crate::render::band::{self, Band, NOTHING, Tile};
use crate::render::hits::HitBlock;
use crate::render::shading::emitters::Lighting;
use crate::render::{Observer, RenderError, rays};

/// Columns of a tile.
pub const WIDTH: u32 = 64;
/// Rows of a tile: bands of this height are drawn most efficiently.
pub const HEIGHT: u32 = 64;

/// Whether a scene is rendered by tiles: spheres only, either many of them or with shadows; seen in perspective, with lights
/// at finite positions, and unobstructed ambient light.
pub fn supports(scene: &PreparedScene) -> bool {
    let description = scene.scene();
    let is_round = description.shapes().iter().all(|shape| shape.geometry.is_round());
    let all_are_somewhere = description.lights().iter().all(|light| light.position().is_some());
    let is_obstructed = description.ambient().is_some_and(|ambient| ambient.obstruction.is_some());
    let has_window = matches!(scene.frame().projection, Projection::Perspective(_));
    has_window
        && is_round
        && all_are_somewhere
        && !is_obstructed
        && (scene.casts_shadows_between_shapes() || scene.primitive_count() > MANY)
}

/// With fewer spheres, and no shadows, rendering by rows is faster.
const MANY: u32 = 64;

/// The settings for filling bands.
#[derive(Clone, Copy)]
pub struct Tiles<'a> {
    /// The scene.
    pub scene: &'a PreparedScene,
    /// Its lights.
    pub lighting: &'a Lighting,
    /// The lights whose own irradiance is requested.
    pub asked_for: &'a [usize],
    /// The precision of the shading.
    pub precision: Precision,
    /// The instruction set to use.
    pub instructions: Instructions,
    /// Receives progress reports.
    pub observer: Option<&'a dyn Observer>,
}

impl Tiles<'_> {
    /// Fills a band, and returns what its pixels see.
    pub fn fill(&self, mut band: Band<'_>) -> Result<Vec<Run>, RenderError> {
        let Projection::Perspective(window) = &self.scene.frame().projection else {
            unreachable!("`supports` refuses other cameras");
        };
        let view = View::new(self.scene, window);
        let mut work = Work {
            scene: self.scene,
            view: &view,
            instructions: self.instructions,
            outlines: Outlines::default(),
            canvas: Canvas::new(),
            groups: Groups::default(),
            walk: Walk::default(),
            shader: Shader::new(self),
            seen: vec![NOTHING; band.size.pixels()],
            doubtful: Vec::new(),
            hits: HitBlock::new(self.scene, self.asked_for),
        };
        for tile in band.tiles(WIDTH, HEIGHT) {
            work.tile(tile, &mut band)?;
            band::advance(self.observer, u64::from(tile.width) * u64::from(tile.height))?;
        }
        work.hits.put(&mut band)?;
        Ok(band.runs(&work.seen))
    }
}

/// The scratch memory of a thread, reused from tile to tile.
struct Work<'a> {
    scene: &'a PreparedScene,
    view: &'a View,
    instructions: Instructions,
    outlines: Outlines,
    canvas: Canvas,
    groups: Groups,
    walk: Walk,
    shader: Shader<'a>,
    /// The shape that each pixel of the band sees.
    seen: Vec<u32>,
    /// Pixels to be traced with 32 digits.
    doubtful: Vec<Pixel>,
    /// What those pixels see.
    hits: HitBlock<'a>,
}

impl Work<'_> {
    fn tile(&mut self, tile: Tile, band: &mut Band<'_>) -> Result<(), RenderError> {
        self.doubtful.clear();
        if self.draw(tile) {
            self.canvas.settle(tile, &mut self.doubtful);
            self.groups.collect(&self.canvas, tile, self.outlines.count());
            for index in 0..self.groups.seen.len() {
                let outline = self.groups.seen[index];
                let seen = self.outlines.get(outline);
                let primitive = self.scene.primitive(seen.primitive);
                for pixels in self.groups.pixels_of(index).chunks(group::MOST) {
                    let mut group = Group { seen: &seen, primitive, tile, pixels, walk: &mut self.walk };
                    for pixel in pixels {
                        self.seen[band.index(pixel.within(tile))] = u32::try_from(primitive.shape).unwrap_or(NOTHING);
                    }
                    self.shader.shade(&mut group, band, &mut self.doubtful)?;
                }
            }
        } else {
            let columns = tile.first.column..tile.first.column + tile.width;
            let rows = tile.first.row..tile.first.row + tile.height;
            let pixels = rows.flat_map(|row| columns.clone().map(move |column| Pixel { column, row }));
            self.doubtful.extend(pixels);
        }
        self.trace_doubtful(band)
    }

    /// Draws the visible surfaces of a tile; returns false if the outline of a sphere in its beam is not an ellipse.
    fn draw(&mut self, tile: Tile) -> bool {
        let tree = self.scene.accelerator();
        let beam = self.view.beam(tree, tile);
        self.outlines.clear();
        self.canvas.clear();
        self.walk.start(tree);
        let least_length = self.view.least_length(tile);
        loop {
            let limit = beam.depth_of(self.canvas.farthest() / (least_length * least_length));
            let Self { scene, view, outlines, walk, canvas, instructions, .. } = self;
            instructions.run(Take { outlines: &mut *outlines, tree, beam: &beam, limit, walk });
            if outlines.is_exhausted() {
                return true;
            }
            if !instructions.run(Prepare { outlines: &mut *outlines, scene, view }) {
                return false;
            }
            instructions.run(Draw { canvas, outlines, view, tile, least_length });
        }
    }

    #[inline(never)]
    fn trace_doubtful(&mut self, band: &mut Band<'_>) -> Result<(), RenderError> {
        self.doubtful.sort_unstable_by_key(|pixel| (pixel.row, pixel.column));
        self.doubtful.dedup();
        for pixel in &self.doubtful {
            self.seen[band.index(*pixel)] = NOTHING;
        }
        let pixels = self.doubtful.iter().copied();
        for (pixel, shape) in rays::retrace(self.scene, pixels, band, &mut self.hits)? {
            self.seen[band.index(pixel)] = u32::try_from(shape).unwrap_or(NOTHING);
        }
        Ok(())
    }
}
