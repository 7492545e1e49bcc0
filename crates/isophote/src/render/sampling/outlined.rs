//! Means over pixels that show one sphere, or its outline against the background, by integration. Point samples would
//! estimate the area that an edge cuts off with an error that falls only as n^(−3/4); the outline is known, and within it
//! the brightness is smooth.

use super::range;
use super::refine::{Refinement, Wanted};
use super::rule::{Center, NodePlaces, RowRule};
use super::uncertain::Uncertain;
use crate::camera::ScreenPosition;
use crate::lanes::{Instructions, Precision};
use crate::light::Ambient;
use crate::map::Pixel;
use crate::outline::Ellipse;
use crate::prepare::PreparedScene;
use crate::reflectance::BrightnessFormula;
use crate::render::band::ScalarChannel;
use crate::render::rows::Candidate;
use crate::render::shading::block::{Places, SeePoints, ShadedBlock, SurfaceBlock};
use crate::render::shading::emitters::{Chosen, Lighting, ShapeEmitters};
use crate::render::shading::kernel::{PerPoint, ShadeBlock};
use crate::render::shading::lobe::Power;
use crate::scene::Filter;

/// The spheres of a scene in which only sphere outlines can cut a pixel.
pub struct Outlined<'s> {
    scene: &'s PreparedScene,
    spheres: Vec<OutlinedSphere<'s>>,
    wanted: &'s Wanted<'s>,
    /// Whether the map has channels for the geometry that a pixel sees.
    has_geometry: bool,
    instructions: Instructions,
}

struct OutlinedSphere<'s> {
    candidate: Candidate<'s>,
    layers: Vec<LitSphere<'s>>,
    /// Whether its highlights are at least as wide as a pixel: otherwise a few rows of nodes may miss them.
    is_smooth: bool,
}

/// The light on a sphere in a layer of the scene.
struct LitSphere<'s> {
    formula: &'s BrightnessFormula,
    power: Power,
    emitters: Chosen<f64>,
    ambient: f64,
}

/// Scratch memory for the nodes in a pixel and what is visible there.
pub struct Nodes {
    places: NodePlaces,
    points: Box<SurfaceBlock<f64>>,
    shaded: Box<ShadedBlock<f64>>,
}

impl Nodes {
    /// With room for the separate irradiances of this many lights.
    pub fn new(lights: usize) -> Self {
        Self { places: NodePlaces::new(), points: SurfaceBlock::new(), shaded: ShadedBlock::new(lights) }
    }
}

/// A pixel of which an outline covers less than this is left to rays.
const NEGLIGIBLE: f64 = 1e-9;

/// With more spheres than this, most pixels show several, so integration is not tried.
const FEW: usize = 16;

impl<'s> Outlined<'s> {
    /// For a scene with a few spheres, all in front of the eye and none shadowing another, with a filter that is the pixel
    /// itself; `None` for other scenes.
    pub fn new(
        scene: &'s PreparedScene,
        wanted: &'s Wanted<'s>,
        asked_for: &[usize],
        has_geometry: bool,
    ) -> Option<Self> {
        if wanted.sampling.filter != Filter::Box || scene.scene().shapes().len() > FEW {
            return None;
        }
        let lighting = Lighting::new(scene, asked_for);
        let layers = scene.layers();
        let sphere = |candidate: Candidate<'s>| {
            let primitive = candidate.primitive();
            if scene.doubtful_in_outline(primitive).end.is_infinite() {
                return None;
            }
            let lit = |layer: &&'s PreparedScene| LitSphere::new(layer, &lighting, &candidate);
            let layers: Vec<LitSphere<'s>> = layers.iter().map(lit).collect();
            let is_smooth = layers.iter().all(|layer| is_smooth(candidate.ellipse, layer.formula));
            Some(OutlinedSphere { candidate, layers, is_smooth })
        };
        let rows = 0..scene.scene().camera().resolution.height;
        let spheres: Option<Vec<_>> = Candidate::all(scene, rows)?.into_iter().map(sphere).collect();
        Some(Self { scene, spheres: spheres?, wanted, has_geometry, instructions: Instructions::best() })
    }

    /// Whether a pixel whose centre sees nothing is empty all over.
    pub fn is_missed_by_all(&self, pixel: Pixel, uncertain: &Uncertain) -> bool {
        !uncertain.sees && !self.spheres.iter().any(|sphere| sphere.may_touch(pixel))
    }

    /// The mean over a pixel; `None` where several spheres meet, or where the brightness varies too much for integration.
    pub fn mean(&self, nodes: &mut Nodes, pixel: Pixel, uncertain: &Uncertain) -> Option<Refinement> {
        let mut touching = self.spheres.iter().filter(|sphere| sphere.may_touch(pixel));
        let (Some(sphere), None) = (touching.next(), touching.next()) else { return None };
        if !sphere.is_smooth {
            return None;
        }
        let center = sphere.center_of(pixel);
        for rows in [RowRule::Two, RowRule::Four] {
            nodes.places.place(sphere.candidate.ellipse, center, rows);
            let samples = u32::try_from(nodes.places.count).unwrap_or(u32::MAX);
            if nodes.places.coverage < NEGLIGIBLE || samples > self.wanted.sampling.samples {
                return None;
            }
            let Some((sums, error_bounds)) = self.means(nodes, sphere, rows) else { continue };
            let hit = if uncertain.sees || !self.has_geometry {
                None
            } else {
                let [column, row] = nodes.places.inside;
                let place = [column - center.column + 0.5, row - center.row + 0.5];
                Some(Box::new(self.scene.trace(ScreenPosition::InPixel { pixel, place })?))
            };
            return Some(Refinement {
                index: uncertain.index,
                sees: uncertain.sees,
                samples,
                coverage: nodes.places.coverage.min(1.0),
                error_bounds,
                seen: Some(sphere.candidate.shape),
                hit,
                sums,
            });
        }
        None
    }

    /// The means in each layer and the bounds of their errors; `None` if any of these exceeds half the tolerance.
    fn means(
        &self,
        nodes: &mut Nodes,
        sphere: &OutlinedSphere<'s>,
        rows: RowRule,
    ) -> Option<(Vec<Vec<f64>>, Vec<f64>)> {
        let Wanted { averages, tolerances, .. } = self.wanted;
        let mut sums = Vec::with_capacity(averages.len());
        let mut error_bounds = Vec::with_capacity(averages.len());
        let layers = sphere.layers.iter().zip(*averages).zip(*tolerances);
        for (is_first, ((lit, averages), tolerance)) in
            std::iter::once(true).chain(std::iter::repeat(false)).zip(layers)
        {
            self.evaluate(nodes, sphere, lit, is_first);
            let count = nodes.places.count;
            let brightness = &nodes.shaded.brightness[..count];
            let [least, greatest] = range(brightness.iter().copied());
            let range = greatest - least;
            if !(range <= rows.widest() * tolerance) {
                return None;
            }
            error_bounds.push(0.5 * range / rows.widest());
            let mean = |channel: ScalarChannel| {
                let values = nodes.shaded.values(channel)[..count].iter();
                values.zip(&nodes.places.weights).fold(0.0, |mean, (value, weight)| mean + weight * value)
            };
            sums.push(averages.channels().iter().map(|(_, channel)| mean(*channel)).chain([1.0]).collect());
        }
        Some((sums, error_bounds))
    }

    /// Shades the places in an outline, in one layer; the first one finds the points.
    fn evaluate(&self, nodes: &mut Nodes, sphere: &OutlinedSphere<'s>, lit: &LitSphere<'s>, is_first: bool) {
        let Nodes { places, points, shaded } = nodes;
        let candidate = &sphere.candidate;
        if is_first {
            (points.count, points.primitive) = (places.count, candidate.primitive());
            (points.anchor, points.unit) = (candidate.sphere.center, candidate.sphere.radius);
            let NodePlaces { columns, rows, after_first, after_last, .. } = &*places;
            let places = Places { columns, rows, after_first, after_last };
            self.instructions.run(SeePoints { points: &mut **points, outline: candidate.ellipse, places });
        }
        points.ambient[..places.count.next_multiple_of(16)].fill(lit.ambient);
        self.instructions.run(ShadeBlock {
            points,
            formula: lit.formula,
            power: &lit.power,
            selection: lit.emitters.selection(),
            visibility: PerPoint::ALL,
            shaded,
        });
    }
}

impl<'s> LitSphere<'s> {
    fn new(layer: &'s PreparedScene, lighting: &Lighting, candidate: &Candidate<'_>) -> Self {
        let (mut placed, mut emitters) = (ShapeEmitters::default(), Chosen::default());
        lighting.place(layer, &candidate.sphere, &mut placed);
        emitters.choose_all(layer, lighting, &placed);
        let formula = layer.formula(candidate.primitive());
        let ambient = layer.scene().ambient().map_or(0.0, Ambient::unobstructed_irradiance);
        Self { formula, power: Power::of(formula, Precision::Double), emitters, ambient }
    }
}

/// The lobe (N·H)ⁿ falls to 1/√e where N has turned by 1/√n: on a sphere of R pixels that is R/√n pixels away. A jump at the
/// terminator is not smooth at all.
fn is_smooth(outline: &Ellipse, formula: &BrightnessFormula) -> bool {
    let radius = 0.5 * (outline.rows[1] - outline.rows[0]);
    !formula.jumps_at_terminator() && formula.sharpness().is_none_or(|shininess| shininess <= radius * radius)
}

impl OutlinedSphere<'_> {
    fn center_of(&self, pixel: Pixel) -> Center {
        Center {
            column: f64::from(pixel.column) - self.candidate.ellipse.column,
            row: f64::from(pixel.row) - self.candidate.ellipse.row,
        }
    }

    /// Whether the outline may reach into a pixel, judged by the widest row and the ends of the middle one.
    fn may_touch(&self, pixel: Pixel) -> bool {
        let Center { column, row } = self.center_of(pixel);
        let [start, end] = self.candidate.ellipse.rows;
        let (first, last) = (start.max(row - 0.5), end.min(row + 0.5));
        if first >= last {
            return false;
        }
        let widest = (0.5 * (start + end)).clamp(first, last);
        let half = (self.candidate.ellipse.width_squared * (widest - start) * (end - widest)).sqrt();
        let [middle, growth] = self.candidate.ellipse.middle;
        let [one, other] = [middle + growth * first, middle + growth * last];
        column + 0.5 > one.min(other) - half && column - 0.5 < one.max(other) + half
    }
}
