//! Means over pixels that show one sphere, or its outline against the background: by integration. Points would find the
//! share of an area that an edge cuts off only as n^(−3/4); the outline is known, and within it the brightness is smooth.

use super::refine::{Averages, Refinement};
use super::rule::{Center, MOST, Nodes, RowRule};
use super::uncertain::Uncertain;
use crate::camera::ScreenPosition;
use crate::lanes::{Instructions, Lane, LaneJob, Precision, SimdToken};
use crate::map::Pixel;
use crate::outline::{Ellipse, PlaceInRow};
use crate::prepare::PreparedScene;
use crate::reflectance::{BrightnessFormula, Lobe};
use crate::render::band::ScalarChannel;
use crate::render::lanes::kernel::{Sums, sum};
use crate::render::lanes::lights::{ShapeLights, ShapeShading, by_place};
use crate::render::lanes::power::{NoPower, Power};
use crate::render::lanes::visible::Candidate;
use crate::scene::{Filter, Sampling};
use crate::vector::Vector;

/// The spheres of a scene whose outlines are all that can cut a pixel.
pub struct Outlined<'s> {
    scene: &'s PreparedScene,
    spheres: Vec<OutlinedSphere<'s>>,
    averages: &'s Averages,
    instructions: Instructions,
    most: u32,
    tolerance: f64,
}

struct OutlinedSphere<'s> {
    shape: usize,
    outline: &'s Ellipse,
    center: Vector,
    formula: &'s BrightnessFormula,
    lights: ShapeLights<f64>,
    /// Whether its highlights are as wide as a pixel: else places in a few rows may miss them.
    is_smooth: bool,
}

/// A pixel of which an outline covers less is left to rays.
const NEGLIGIBLE: f64 = 1e-9;

/// With more spheres than this, most pixels show several, and none is asked which.
const FEW: usize = 16;

impl<'s> Outlined<'s> {
    /// Of a scene with a few spheres, all before the eye and none in another one's light, through a filter that is the pixel
    /// itself; nothing for others.
    pub fn new(scene: &'s PreparedScene, averages: &'s Averages, sampling: Sampling, tolerance: f64) -> Option<Self> {
        let lights = scene.scene().lights();
        if sampling.filter != Filter::Box || scene.scene().shapes().len() > FEW {
            return None;
        }
        let order = by_place(lights);
        let wanted: Vec<usize> = averages.lights().collect();
        let sphere = |candidate: &Candidate<'s>| {
            let (primitive, sphere) = (candidate.primitive(), &candidate.sphere);
            if scene.doubtful_in_outline(primitive).end.is_infinite() {
                return None;
            }
            match ShapeShading::new(scene, primitive, sphere, &order, &wanted, Precision::Double) {
                ShapeShading::Double(lights) => Some(OutlinedSphere {
                    shape: candidate.shape,
                    outline: candidate.ellipse,
                    center: sphere.center,
                    formula: scene.formula(primitive),
                    lights,
                    is_smooth: is_smooth(candidate.ellipse, scene.formula(primitive)),
                }),
                ShapeShading::Single(_) => None,
            }
        };
        let rows = 0..scene.scene().camera().resolution.height;
        let spheres: Option<Vec<_>> = Candidate::all(scene, rows)?.iter().map(sphere).collect();
        Some(Self {
            scene,
            spheres: spheres?,
            averages,
            instructions: Instructions::best(),
            most: sampling.samples,
            tolerance,
        })
    }

    /// Whether a pixel whose centre sees nothing shows nothing all over.
    pub fn is_missed_by_all(&self, pixel: Pixel, uncertain: &Uncertain) -> bool {
        !uncertain.sees && !self.spheres.iter().any(|sphere| sphere.may_touch(pixel))
    }

    /// The mean over a pixel; nothing where several spheres meet, or where the brightness varies too much to be integrated.
    pub fn mean(&self, nodes: &mut Nodes, pixel: Pixel, uncertain: &Uncertain) -> Option<Refinement> {
        let mut touching = self.spheres.iter().filter(|sphere| sphere.may_touch(pixel));
        let (Some(sphere), None) = (touching.next(), touching.next()) else { return None };
        if !sphere.is_smooth {
            return None;
        }
        let center = sphere.center_of(pixel);
        let channels = self.averages.channels();
        let mut means = vec![0.0; channels.len()];
        for (rows, widest) in [(RowRule::Two, 16.0), (RowRule::Four, 36.0)] {
            nodes.place(sphere.outline, center, rows);
            let samples = u32::try_from(nodes.count).unwrap_or(u32::MAX);
            if nodes.coverage < NEGLIGIBLE || samples > self.most {
                return None;
            }
            let job = Evaluate { sphere, nodes, channels, means: &mut means };
            // Where the brightness has a kink, at a terminator, two rows may miss 0.03 of its range and four 0.014.
            if self.instructions.run(job) <= widest * self.tolerance {
                let hit = if uncertain.sees || !self.averages.have_geometry() {
                    None
                } else {
                    let [column, row] = nodes.inside;
                    let place = [column - center.column + 0.5, row - center.row + 0.5];
                    Some(Box::new(self.scene.trace(ScreenPosition::InPixel { pixel, place })?))
                };
                let coverage = nodes.coverage.min(1.0);
                means.push(1.0);
                let (seen, sums) = (Some(sphere.shape), means);
                return Some(Refinement {
                    index: uncertain.index,
                    sees: uncertain.sees,
                    samples,
                    coverage,
                    seen,
                    hit,
                    sums,
                });
            }
        }
        None
    }
}

/// The lobe (N·H)ⁿ falls to 1/√e where N has turned by 1/√n: on a sphere of R pixels that is R/√n pixels away.
fn is_smooth(outline: &Ellipse, formula: &BrightnessFormula) -> bool {
    let radius = 0.5 * (outline.rows[1] - outline.rows[0]);
    formula.sharpness().is_none_or(|shininess| shininess <= radius * radius)
}

impl OutlinedSphere<'_> {
    fn center_of(&self, pixel: Pixel) -> Center {
        Center { column: f64::from(pixel.column) - self.outline.column, row: f64::from(pixel.row) - self.outline.row }
    }

    /// Whether the outline may reach into a pixel, by the widest row and the ends of the middle.
    fn may_touch(&self, pixel: Pixel) -> bool {
        let Center { column, row } = self.center_of(pixel);
        let [start, end] = self.outline.rows;
        let (first, last) = (start.max(row - 0.5), end.min(row + 0.5));
        if first >= last {
            return false;
        }
        let widest = (0.5 * (start + end)).clamp(first, last);
        let half = (self.outline.width_squared * (widest - start) * (end - widest)).sqrt();
        let [middle, growth] = self.outline.middle;
        let [one, other] = [middle + growth * first, middle + growth * last];
        column + 0.5 > one.min(other) - half && column - 0.5 < one.max(other) + half
    }
}

/// Computes the means of some channels over places in an outline; comes to the range of the brightness.
struct Evaluate<'e> {
    sphere: &'e OutlinedSphere<'e>,
    nodes: &'e Nodes,
    channels: &'e [(usize, ScalarChannel)],
    means: &'e mut [f64],
}

impl LaneJob for Evaluate<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<S, D>(self, token: S::Token) -> f64
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        match &self.sphere.lights.power {
            Power::None => self.with::<D::Narrow, _>(token, &NoPower),
            Power::Even(lobe) => self.with::<D::Narrow, _>(token, lobe),
            Power::Odd(lobe) => self.with::<D::Narrow, _>(token, lobe),
            Power::Any(lobe) => self.with::<D::Narrow, _>(token, lobe),
        }
    }
}

impl Evaluate<'_> {
    #[inline(always)]
    fn with<V: Lane<Element = f64>, L: Lobe<V>>(self, token: V::Token, lobe: &L) -> f64 {
        token.in_own_function(
            #[inline(always)]
            || self.sums(token, lobe),
        )
    }

    #[inline(always)]
    fn sums<V: Lane<Element = f64>, L: Lobe<V>>(self, token: V::Token, lobe: &L) -> f64 {
        let Self { sphere, nodes, channels, means } = self;
        let OutlinedSphere { outline, center, formula, lights, .. } = sphere;
        let outline = outline.map(
            #[inline(always)]
            |value| V::splat(token, value),
        );
        let [mut least, mut greatest] = [f64::INFINITY, f64::NEG_INFINITY];
        means.fill(0.0);
        let mut buffer = [0.0; MOST];
        for start in (0..nodes.count).step_by(V::COUNT) {
            let [columns, rows, after_first, after_last] =
                [&nodes.columns, &nodes.rows, &nodes.after_first, &nodes.after_last].map(
                    #[inline(always)]
                    |numbers| V::load(token, &numbers[start..]),
                );
            let place = PlaceInRow { column: columns, after_first, after_last };
            let point = outline.row_at(rows).point(*center, &place).point;
            let (irradiance, lobes) = sum(token, &point, &lights.lights, lobe);
            let irradiance = irradiance + V::splat(token, lights.ambient);
            let sums = Sums { irradiance, lobes, cos_theta_o: point.cos_theta_o };
            let count = V::COUNT.min(nodes.count - start);
            (sums.diffuse(formula) + sums.specular(formula)).store(&mut buffer);
            for value in &buffer[..count] {
                (least, greatest) = (least.min(*value), greatest.max(*value));
            }
            let mut asked_for = lights.asked_for.iter();
            for (mean, (_, channel)) in means.iter_mut().zip(channels) {
                let values = match channel {
                    ScalarChannel::Brightness => sums.diffuse(formula) + sums.specular(formula),
                    ScalarChannel::Irradiance => sums.irradiance,
                    ScalarChannel::Ambient => V::splat(token, lights.ambient),
                    ScalarChannel::Diffuse => sums.diffuse(formula),
                    ScalarChannel::Specular => sums.specular(formula),
                    ScalarChannel::Light(_) => match asked_for.next() {
                        Some(light) => sum(token, &point, std::slice::from_ref(light), &NoPower).0,
                        None => unreachable!("a light was placed for every such channel"),
                    },
                    ScalarChannel::Depth | ScalarChannel::AmbientError => unreachable!("it is no mean"),
                };
                values.store(&mut buffer);
                for (value, weight) in buffer[..count].iter().zip(&nodes.weights[start..]) {
                    *mean += weight * value;
                }
            }
        }
        greatest - least
    }
}
