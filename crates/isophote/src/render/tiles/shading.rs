//! Shades the pixels of a group as blocks of points, with the light that reaches them.

use super::Tiles;
use super::group::{Group, MOST};
use super::shadow::Shadows;
use crate::lanes::{Element, Instructions, Lane, LaneJob, Precision, SimdToken};
use crate::light::{Ambient, PlacedEmitter};
use crate::map::Pixel;
use crate::outline::PlaceInRow;
use crate::prepare::PreparedScene;
use crate::render::RenderError;
use crate::render::band::Band;
use crate::render::fan_out::{Pixels, Shaded};
use crate::render::shading::block::{Places, SeePoints, ShadedBlock, SurfaceBlock};
use crate::render::shading::emitters::{Chosen, Lighting, ShapeEmitters};
use crate::render::shading::kernel::{PerPoint, ShadeBlock};
use crate::render::shading::lobe::Power;
use crate::shape::Sphere;
use crate::vector::Vector;

/// Shades groups, one after another.
pub struct Shader<'a> {
    tiles: Tiles<'a>,
    layers: Vec<&'a PreparedScene>,
    places: Box<ScreenPlaces>,
    /// The points that the pixels see.
    points: Box<SurfaceBlock<f64>>,
    /// The same points, for sums in single precision.
    single_points: Box<SurfaceBlock<f32>>,
    shadows: Box<Shadows>,
    emitters: ShapeEmitters,
    /// The emitters above the horizon of any pixel: their position in the summation order, and their index among the
    /// scene's.
    chosen: Vec<(usize, usize)>,
    /// v of the pixels for each of these emitters.
    visible: Vec<f64>,
    /// Lanes in doubt, eight per number.
    doubtful: [u32; MOST / 8],
    single: Scratch<f32>,
    double: Scratch<f64>,
}

struct Scratch<E> {
    chosen: Chosen<E>,
    shaded: Box<ShadedBlock<E>>,
}

/// The screen positions of a group's pixels. The last one is repeated to fill the last vector.
struct ScreenPlaces {
    /// The index of each pixel in the band.
    index: [usize; MOST],
    /// Columns and rows in the outline's coordinates.
    column: [f64; MOST],
    row: [f64; MOST],
    after_first: [f64; MOST],
    after_last: [f64; MOST],
}

impl ScreenPlaces {
    fn new() -> Self {
        let zeros = [0.0; MOST];
        Self { index: [0; MOST], column: zeros, row: zeros, after_first: zeros, after_last: zeros }
    }

    /// Converts the pixels of a group to the outline's coordinates.
    fn count(&mut self, group: &Group<'_>, band: &Band<'_>) {
        let ellipse = &group.seen.ellipse;
        let mut pixel = Pixel { column: 0, row: 0 };
        for at in 0..group.pixels.len().next_multiple_of(16) {
            if let Some(cell) = group.pixels.get(at) {
                pixel = cell.within(group.tile);
            }
            self.index[at] = band.index(pixel);
            self.column[at] = f64::from(pixel.column) - ellipse.column;
            self.row[at] = f64::from(pixel.row) - ellipse.row;
        }
    }

    /// Computes the points that they see.
    #[inline(always)]
    fn see<D: Lane<Element = f64>>(&mut self, token: D::Token, group: &Group<'_>, points: &mut SurfaceBlock<f64>) {
        let outline = group.seen.ellipse.map(
            #[inline(always)]
            |number| D::splat(token, number),
        );
        for at in (0..points.count.next_multiple_of(16)).step_by(D::COUNT) {
            let column = D::load(token, &self.column[at..]);
            let row = outline.row_at(D::load(token, &self.row[at..]));
            let place = PlaceInRow { column, after_first: column - row.roots[0], after_last: column - row.roots[1] };
            place.after_first.store(&mut self.after_first[at..]);
            place.after_last.store(&mut self.after_last[at..]);
            points.store(at, &row.point(points.anchor, &place));
        }
    }
}

/// Computes the points that the pixels of a group see, and the lights that reach them.
struct See<'s, 'a, 'g> {
    shader: &'s mut Shader<'a>,
    group: &'s mut Group<'g>,
}

impl LaneJob for See<'_, '_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<S, D>(self, token: S::Token)
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        let Self { shader, group } = self;
        token.in_own_function(
            #[inline(always)]
            || shader.places.see::<D::Narrow>(token, group, &mut shader.points),
        );
        shader.see_lights::<S::Narrow, D::Narrow>(token, group);
    }
}

/// With more lights than this, fewer pixels are shaded together, because the visibility of each light at each pixel is
/// stored.
const MANY_LIGHTS: usize = 1024;

impl<'a> Shader<'a> {
    /// For the lights of a scene.
    pub fn new(tiles: &Tiles<'a>) -> Self {
        let lights = tiles.asked_for.len();
        Self {
            tiles: *tiles,
            layers: tiles.scene.layers(),
            places: Box::new(ScreenPlaces::new()),
            points: SurfaceBlock::new(),
            single_points: SurfaceBlock::new(),
            shadows: Box::new(Shadows::NEW),
            emitters: ShapeEmitters::default(),
            chosen: Vec::new(),
            visible: Vec::new(),
            doubtful: [0; MOST / 8],
            single: Scratch { chosen: Chosen::default(), shaded: ShadedBlock::new(lights) },
            double: Scratch { chosen: Chosen::default(), shaded: ShadedBlock::new(lights) },
        }
    }

    /// Shades the pixels of a group; those whose shadow is in doubt are also added to a list.
    pub fn shade(
        &mut self,
        group: &mut Group<'_>,
        band: &mut Band<'_>,
        doubtful: &mut Vec<Pixel>,
    ) -> Result<(), RenderError> {
        let instructions = self.tiles.instructions;
        let Some(sphere) = self.tiles.scene.sphere(group.primitive).copied() else { return Ok(()) };
        self.tiles.lighting.place(self.tiles.scene, &sphere, &mut self.emitters);
        let most = if self.emitters.len() > MANY_LIGHTS { 16 } else { MOST };
        let pixels = group.pixels;
        for pixels in pixels.chunks(most) {
            group.pixels = pixels;
            self.begin(group, &sphere, band);
            instructions.run(See { shader: &mut *self, group: &mut *group });
            for (vector, lanes) in self.doubtful[..pixels.len().div_ceil(8)].iter().enumerate() {
                let cells = pixels[vector * 8..].iter().take(8).enumerate();
                let in_doubt = cells.filter(|(lane, _)| lanes >> lane & 1 == 1);
                doubtful.extend(in_doubt.map(|(_, cell)| cell.within(group.tile)));
            }
            for layer in 0..self.layers.len() {
                self.shade_layer(group, layer, band)?;
            }
            if band.has_geometry() {
                band.put_geometry(Pixels::At(&self.places.index[..pixels.len()]), &self.points);
            }
        }
        Ok(())
    }

    fn begin(&mut self, group: &Group<'_>, sphere: &Sphere, band: &Band<'_>) {
        let Sphere { center, radius } = *sphere;
        let count = group.pixels.len();
        let points = &mut self.points;
        (points.count, points.primitive, points.anchor, points.unit) = (count, group.primitive, center, radius);
        let points = &mut self.single_points;
        (points.count, points.primitive, points.anchor, points.unit) = (count, group.primitive, center, radius);
        self.places.count(group, band);
    }

    fn is_single(&self, group: &Group<'_>, layer: usize) -> bool {
        let layer = self.layers[layer];
        self.tiles.precision == Precision::Single
            && group.seen.ellipse.fits_single()
            && self.emitters.fit_single(ambient(layer), layer.formula(group.primitive))
    }

    /// Determines which lights the pixels see.
    #[inline(always)]
    fn see_lights<S, D>(&mut self, token: S::Token, group: &mut Group<'_>)
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        let Self { tiles: Tiles { scene, .. }, points, shadows, emitters, chosen, visible, doubtful, .. } = self;
        let stride = points.count.next_multiple_of(16);
        let vectors = points.count.div_ceil(D::COUNT);
        doubtful.fill(0);
        chosen.clear();
        visible.resize(visible.len().max(stride * emitters.len()), 1.0);
        for (place, (index, emitter)) in emitters.iter().enumerate() {
            let visible = &mut visible[chosen.len() * stride..][..stride];
            if !scene.scene().casts_shadows(group.primitive.shape, scene.emitters().all()[index].light) {
                visible.fill(1.0);
            } else if !shadows.find::<S, D>(token, scene, group, points, emitter.position, visible) {
                continue;
            } else {
                for vector in 0..vectors {
                    let at = vector * D::COUNT;
                    doubtful[at / 8] |= shadows.doubtful(vector) << (at % 8);
                }
            }
            chosen.push((place, index));
        }
    }

    /// Shades the points of a group in a layer of the scene.
    fn shade_layer(&mut self, group: &Group<'_>, layer: usize, band: &mut Band<'_>) -> Result<(), RenderError> {
        let is_single = self.is_single(group, layer);
        let Self { tiles: Tiles { lighting, instructions, .. }, layers, places, chosen, visible, .. } = self;
        let light = Light { layer: layers[layer], lighting, chosen, visible };
        let ScreenPlaces { index, column, row, after_first, after_last } = &**places;
        let pixels = Pixels::At(&index[..group.pixels.len()]);
        if is_single {
            let places = Places { columns: column, rows: row, after_first, after_last };
            let points = &mut *self.single_points;
            instructions.run(SeePoints { points, outline: &group.seen.ellipse, places });
            light.fall_on(*instructions, &mut self.single_points, &mut self.single);
            band.put(layer, pixels, Shaded::Single(&self.single.shaded))
        } else {
            light.fall_on(*instructions, &mut self.points, &mut self.double);
            band.put(layer, pixels, Shaded::Double(&self.double.shaded))
        }
    }
}

/// E_a (3.9), which nothing obstructs in scenes that are rendered by tiles.
fn ambient(layer: &PreparedScene) -> f64 {
    layer.scene().ambient().map_or(0.0, Ambient::unobstructed_irradiance)
}

/// The light of a layer that reaches a group.
struct Light<'l> {
    layer: &'l PreparedScene,
    lighting: &'l Lighting,
    chosen: &'l [(usize, usize)],
    visible: &'l [f64],
}

impl Light<'_> {
    /// Shades the points that it falls on.
    fn fall_on<E: Element>(&self, instructions: Instructions, points: &mut SurfaceBlock<E>, scratch: &mut Scratch<E>) {
        let stride = points.count.next_multiple_of(16);
        points.ambient[..stride].fill(E::from_f64(ambient(self.layer)));
        self.choose(points.anchor, points.unit, &mut scratch.chosen);
        let formula = self.layer.formula(points.primitive);
        instructions.run(ShadeBlock {
            points,
            formula,
            power: &Power::of(formula, E::PRECISION),
            selection: scratch.chosen.selection(),
            visibility: PerPoint { visible: self.visible, stride },
            shaded: &mut scratch.shaded,
        });
    }

    /// Selects the emitters.
    fn choose<E: Element>(&self, center: Vector, radius: f64, chosen: &mut Chosen<E>) {
        // Reciprocals, where rows divide: the last digits stay what they were.
        let (per_unit, per_square) = (1.0 / radius, 1.0 / (radius * radius));
        chosen.choose(self.layer, self.lighting, self.chosen, |emitter| {
            let seen = emitter.seen_from::<f64>(center);
            PlacedEmitter { position: seen.position * per_unit, intensity: seen.intensity * per_square, ..seen }
        });
    }
}
