//! The kernel: rows of a band in lanes, from the outlines' roots to stored values.

use std::ops::Range;

use super::lights::{BLOCK, ShapeLights, ShapeShading};
use super::power::{NoPower, Power};
use super::visible::{Candidate, RowView, Stretch};
use crate::lanes::{Element, Lane, LaneJob, Precision, SimdToken};
use crate::light::PlacedLight;
use crate::map::{Pixel, Run};
use crate::outline::{PlaceInRow, PointInRow, RowOfEllipse};
use crate::prepare::PreparedScene;
use crate::reflectance::{BrightnessFormula, Lobe};
use crate::render::band::{self, Band, BandChannel, ScalarChannel};
use crate::render::{Observer, RenderError};
use crate::shade::light_term;
use crate::shape::{Primitive, Sphere, SurfacePoint};
use crate::sum::Sum;
use crate::vector::Vector;

/// A band to be filled.
pub struct BandJob<'a, 'm> {
    /// The scene.
    pub scene: &'a PreparedScene,
    /// The band.
    pub band: Band<'m>,
    /// The shapes that may be seen in it.
    pub candidates: Vec<Candidate<'a>>,
    /// The [order](super::lights::by_place) of the lights.
    pub order: &'a [usize],
    /// Of what is shaded.
    pub precision: Precision,
    /// Hears of the progress.
    pub observer: Option<&'a dyn Observer>,
}

/// Columns that share a choice of lights.
const CHUNK: u32 = 128;

/// Lights at pixels that are computed without asking whether to go on: a few milliseconds.
const UNINTERRUPTED: u64 = 1 << 20;

impl LaneJob for BandJob<'_, '_> {
    type Output = Result<Vec<Run>, RenderError>;

    #[inline(always)]
    fn run<S, D>(mut self, token: S::Token) -> Self::Output
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        let columns = self.band.first.column..self.band.first.column + self.band.size.width;
        let has_geometry = self.band.has_geometry();
        let mut shadings = Shadings::new(&self);
        let mut view = RowView::default();
        let mut runs = Vec::new();
        let rows = self.band.first.row..self.band.first.row + self.band.size.height;
        let seen = seen_rows(&self.candidates, &rows);
        let unseen = (seen.start - rows.start) + (rows.end - seen.end);
        band::advance(self.observer, u64::from(self.band.size.width) * u64::from(unseen))?;
        for row in seen {
            view.look(self.scene, &self.candidates, row, &columns);
            for stretch in &view.stretches {
                let Ok(index) = self.candidates.binary_search_by_key(&stretch.shape, |candidate| candidate.shape)
                else {
                    unreachable!("what is seen is among the candidates");
                };
                let candidate = &self.candidates[index];
                let ellipse = candidate.ellipse;
                let mut work = StretchWork {
                    row: ellipse.in_row(row),
                    counted_from: ellipse.column,
                    center: candidate.sphere.center,
                    radius: candidate.sphere.radius,
                    formula: self.scene.formula(candidate.primitive()),
                    stretch: *stretch,
                    at_row: row,
                    observer: self.observer,
                    at: self.band.index(Pixel { column: stretch.start, row }),
                    band: &mut self.band,
                };
                match shadings.of(index) {
                    ShapeShading::Single(lights) => work.shade::<S>(token, lights)?,
                    ShapeShading::Double(lights) => work.shade::<D>(token, lights)?,
                }
                if has_geometry {
                    token.in_own_function(
                        #[inline(always)]
                        || work.store_geometry::<D>(token),
                    );
                }
            }
            for traced in &view.traced {
                if let Some(hit) = &traced.hit {
                    self.band.store(traced.pixel, self.scene, hit)?;
                }
            }
            see(&self.band, row, &view, &mut runs);
            band::advance(self.observer, self.band.size.width.into())?;
        }
        Ok(runs)
    }
}

/// The rows in which anything can be seen.
fn seen_rows(candidates: &[Candidate<'_>], rows: &Range<u32>) -> Range<u32> {
    let start = candidates.iter().map(|candidate| candidate.rows.start).min().unwrap_or(rows.end);
    let end = candidates.iter().map(|candidate| candidate.rows.end).max().unwrap_or(rows.end);
    start.max(rows.start)..end.min(rows.end).max(start.max(rows.start))
}

/// Puts the stretches and the traced pixels of a row in order.
fn see(band: &Band<'_>, row: u32, view: &RowView, runs: &mut Vec<Run>) {
    let mut traced =
        view.traced.iter().filter_map(|traced| Some((traced.pixel, traced.hit?.primitive.shape))).peekable();
    for stretch in &view.stretches {
        while let Some((pixel, shape)) = traced.next_if(|(pixel, _)| pixel.column < stretch.start) {
            band.see(pixel, 1, shape, runs);
        }
        band.see(Pixel { column: stretch.start, row }, stretch.end - stretch.start, stretch.shape, runs);
    }
    for (pixel, shape) in traced {
        band.see(pixel, 1, shape, runs);
    }
}

/// The lights of each candidate, placed when it is first seen.
struct Shadings<'a> {
    scene: &'a PreparedScene,
    shapes: Vec<(Primitive, Sphere)>,
    /// Whether single precision can hold what the outline of each is computed from.
    holds_single: Vec<bool>,
    order: &'a [usize],
    wanted: Vec<usize>,
    precision: Precision,
    kept: Vec<Option<ShapeShading>>,
    /// Lights that are kept, over all shapes.
    count: usize,
}

/// Lights kept in a band: beyond that they are placed anew rather than fill the memory.
const KEPT: usize = 1 << 20;

impl<'a> Shadings<'a> {
    fn new(job: &BandJob<'a, '_>) -> Self {
        let shapes: Vec<(Primitive, Sphere)> =
            job.candidates.iter().map(|candidate| (candidate.primitive(), candidate.sphere)).collect();
        Self {
            scene: job.scene,
            holds_single: job.candidates.iter().map(|candidate| candidate.ellipse.fits_single()).collect(),
            kept: shapes.iter().map(|_| None).collect(),
            shapes,
            order: job.order,
            wanted: job.band.lights(),
            precision: job.precision,
            count: 0,
        }
    }

    fn of(&mut self, index: usize) -> &ShapeShading {
        if self.kept[index].is_none() && self.count > KEPT {
            self.kept.fill_with(|| None);
            self.count = 0;
        }
        let Self { scene, shapes, holds_single, order, wanted, precision, kept, count } = self;
        kept[index].get_or_insert_with(|| {
            *count += scene.scene().lights().len();
            let precision = if holds_single[index] { *precision } else { Precision::Double };
            let (primitive, sphere) = shapes[index];
            ShapeShading::new(scene, primitive, &sphere, order, wanted, precision)
        })
    }
}

/// Columns of a row to be computed.
struct StretchWork<'w, 'm> {
    row: RowOfEllipse,
    /// [`Ellipse::column`](crate::shape::Ellipse::column).
    counted_from: f64,
    center: Vector,
    radius: f64,
    formula: &'w BrightnessFormula,
    stretch: Stretch,
    at_row: u32,
    observer: Option<&'w dyn Observer>,
    /// Index in the band of the first column.
    at: usize,
    band: &'w mut Band<'m>,
}

/// The sums over the lights at a vector of pixels.
pub struct Sums<V> {
    /// E.
    pub irradiance: V,
    /// Σ E_j (N·H_j)ⁿ.
    pub lobes: V,
    /// cosθ_o.
    pub cos_theta_o: V,
}

impl<V: Lane> Sums<V> {
    /// The diffuse part of B.
    #[inline(always)]
    pub fn diffuse(&self, formula: &BrightnessFormula) -> V {
        self.irradiance * formula.diffuse_factor(self.cos_theta_o)
    }

    /// The specular part of B.
    #[inline(always)]
    pub fn specular(&self, formula: &BrightnessFormula) -> V {
        self.lobes * formula.specular_factor(self.cos_theta_o)
    }
}

impl StretchWork<'_, '_> {
    #[inline(always)]
    fn shade<V: Lane>(&mut self, token: V::Token, lights: &ShapeLights<V::Element>) -> Result<(), RenderError> {
        match &lights.power {
            Power::None => self.shade_with::<V, _>(token, lights, &NoPower),
            Power::Even(lobe) => self.shade_with::<V, _>(token, lights, lobe),
            Power::Odd(lobe) => self.shade_with::<V, _>(token, lights, lobe),
            Power::Any(lobe) => self.shade_with::<V, _>(token, lights, lobe),
        }
    }

    #[inline(always)]
    fn shade_with<V: Lane, L: Lobe<V>>(
        &mut self,
        token: V::Token,
        lights: &ShapeLights<V::Element>,
        lobe: &L,
    ) -> Result<(), RenderError> {
        token.in_own_function(
            #[inline(always)]
            || self.shade_columns(token, lights, lobe),
        )
    }

    #[inline(always)]
    fn shade_columns<V: Lane, L: Lobe<V>>(
        &mut self,
        token: V::Token,
        lights: &ShapeLights<V::Element>,
        lobe: &L,
    ) -> Result<(), RenderError> {
        let row = self.row.map(
            #[inline(always)]
            |value| V::splat(token, V::Element::from_f64(value)),
        );
        let mut chosen = Vec::new();
        let Stretch { start, end, .. } = self.stretch;
        let mut first = start;
        while first < end {
            // Counted in the full image: the choice of lights, and with it the order of the sum, is that of any region.
            let chunk = first / CHUNK;
            let chunk_end = end.min((chunk + 1) * CHUNK);
            let lit_by = if lights.lights.len() > BLOCK {
                let (middle, reach) = self.cap(chunk);
                lights.above_horizon(middle, reach, &mut chosen)
            } else {
                &lights.lights
            };
            let work = u64::from(chunk_end - first) * lit_by.len() as u64;
            if work > UNINTERRUPTED {
                band::advance(self.observer, 0)?;
            }
            while first < chunk_end {
                let point = self.point::<V>(token, &row, first).point;
                let (irradiance, lobes) = sum(token, &point, lit_by, lobe);
                let irradiance = irradiance + V::splat(token, lights.ambient);
                let sums = Sums { irradiance, lobes, cos_theta_o: point.cos_theta_o };
                let count = (chunk_end - first).min(count_of::<V>());
                self.store(first, count, &sums, &point, token, lights)?;
                first += count;
            }
        }
        Ok(())
    }

    /// What a vector of pixels sees.
    #[inline(always)]
    fn point<V: Lane>(&self, token: V::Token, row: &RowOfEllipse<V>, first: u32) -> PointInRow<V> {
        let first = f64::from(first) - self.counted_from;
        let [left, right] = self.row.roots;
        let place = PlaceInRow {
            column: V::distances(token, first, 0.0),
            after_first: V::distances(token, first, left),
            after_last: V::distances(token, first, right),
        };
        row.point(self.center, &place)
    }

    /// A cap of the unit sphere that holds what the columns of a chunk can see: the direction of its middle, and the
    /// largest distance from there. A row cuts the sphere in a circle, so the ends are farthest from the middle.
    fn cap(&self, chunk: u32) -> (Vector, f64) {
        let [left, right] = self.row.roots;
        let start = f64::from(chunk) * f64::from(CHUNK) - self.counted_from;
        let [first, last] = [start.max(left), (start + f64::from(CHUNK)).min(right)];
        let normal = |u: f64| {
            let place = PlaceInRow { column: u, after_first: u - left, after_last: u - right };
            self.row.point(self.center, &place).point.normal
        };
        let middle = normal(0.5 * (first + last));
        let reach = |u: f64| (normal(u) - middle).length();
        (middle, reach(first).max(reach(last)))
    }

    #[inline(always)]
    fn store<V: Lane>(
        &mut self,
        first: u32,
        count: u32,
        sums: &Sums<V>,
        point: &SurfacePoint<V>,
        token: V::Token,
        lights: &ShapeLights<V::Element>,
    ) -> Result<(), RenderError> {
        let at = self.at + (first - self.stretch.start) as usize;
        let formula = self.formula;
        let mut asked_for = lights.asked_for.iter();
        for channel in &mut self.band.channels {
            let quantity = match channel {
                BandChannel::Double(quantity, _) | BandChannel::Single(quantity, _) => *quantity,
                BandChannel::Position(_) | BandChannel::Normal(_) => continue,
            };
            let values = match quantity {
                ScalarChannel::Brightness => sums.diffuse(formula) + sums.specular(formula),
                ScalarChannel::Irradiance => sums.irradiance,
                ScalarChannel::Ambient => V::splat(token, lights.ambient),
                ScalarChannel::AmbientError => V::splat(token, V::Element::default()),
                ScalarChannel::Diffuse => sums.diffuse(formula),
                ScalarChannel::Specular => sums.specular(formula),
                ScalarChannel::Light(_) => match asked_for.next() {
                    Some(light) => sum(token, point, std::slice::from_ref(light), &NoPower).0,
                    None => unreachable!("a light was placed for every such channel"),
                },
                ScalarChannel::Depth => continue,
            };
            let overflow = match channel {
                BandChannel::Double(_, out) => put(values, token, &mut out[at..], count),
                BandChannel::Single(_, out) => put(values, token, &mut out[at..], count),
                BandChannel::Position(_) | BandChannel::Normal(_) => None,
            };
            if let Some((lane, value)) = overflow {
                let pixel = Pixel { column: first + lane, row: self.at_row };
                return Err(RenderError::Overflow { pixel, value });
            }
        }
        Ok(())
    }

    #[inline(always)]
    fn store_geometry<V: Lane<Element = f64>>(&mut self, token: V::Token) {
        let row = self.row.map(
            #[inline(always)]
            |value| V::splat(token, value),
        );
        let length = self.band.length;
        let mut first = self.stretch.start;
        while first < self.stretch.end {
            let PointInRow { point, distance } = self.point::<V>(token, &row, first);
            let count = (self.stretch.end - first).min(count_of::<V>()) as usize;
            let at = self.at + (first - self.stretch.start) as usize;
            let mut buffer = Vector { x: [0.0; LONGEST], y: [0.0; LONGEST], z: [0.0; LONGEST] };
            point.normal.x.store(&mut buffer.x);
            point.normal.y.store(&mut buffer.y);
            point.normal.z.store(&mut buffer.z);
            let mut distances = [0.0; LONGEST];
            distance.store(&mut distances);
            for channel in &mut self.band.channels {
                match channel {
                    BandChannel::Double(ScalarChannel::Depth, out) => {
                        for (out, distance) in out[at..][..count].iter_mut().zip(distances) {
                            *out = length.from_metres(distance * self.radius);
                        }
                    }
                    BandChannel::Normal(out) => {
                        for (index, out) in out[at..][..count].iter_mut().enumerate() {
                            *out = [buffer.x[index], buffer.y[index], buffer.z[index]];
                        }
                    }
                    BandChannel::Position(out) => {
                        for (index, out) in out[at..][..count].iter_mut().enumerate() {
                            let normal = Vector::new(buffer.x[index], buffer.y[index], buffer.z[index]);
                            let position = self.center + normal * self.radius;
                            *out = position.to_array().map(|coordinate| length.from_metres(coordinate));
                        }
                    }
                    BandChannel::Double(..) | BandChannel::Single(..) => {}
                }
            }
            first += count_of::<V>();
        }
    }
}

/// The longest vector.
const LONGEST: usize = 32;

/// Lanes of a vector, as columns.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "at most 32")]
const fn count_of<V: Lane>() -> u32 {
    V::COUNT as u32
}

/// Writes the first so many numbers of a vector, and zeros in place of the others if there is room: what comes later in
/// the band is not written yet, and zero. Tells which of them, if any, is a number that the channel cannot hold.
#[inline(always)]
fn put<V: Lane, O: Element>(values: V, token: V::Token, out: &mut [O], count: u32) -> Option<(u32, f64)> {
    if out.len() >= V::COUNT
        && let Some(out) = O::cast::<V::Element>(out)
    {
        if count == count_of::<V>() {
            values.store(out);
        } else {
            let index = V::distances(token, 0.0, 0.0);
            let is_wanted = index.is_less(index.splat_like(f64::from(count)));
            V::select(is_wanted, values, index.splat_like(0.0)).store(out);
        }
        return None;
    }
    let mut buffer = [V::Element::default(); LONGEST];
    values.store(&mut buffer);
    for ((out, value), lane) in out[..count as usize].iter_mut().zip(buffer).zip(0..) {
        *out = O::from_f64(value.to_f64());
        if !out.to_f64().is_finite() {
            return Some((lane, value.to_f64()));
        }
    }
    None
}

/// E and Σ E_j (N·H_j)ⁿ at a vector of pixels. Blocks of lights are summed plainly, the blocks' sums with compensation,
/// so that the error does not grow with the number of lights.
#[inline(always)]
pub fn sum<V: Lane, L: Lobe<V>>(
    token: V::Token,
    point: &SurfacePoint<V>,
    lights: &[PlacedLight<V::Element>],
    lobe: &L,
) -> (V, V) {
    if lights.len() <= BLOCK {
        return plain_sum(token, point, lights, lobe);
    }
    let zero = point.cos_theta_o.splat_like(0.0);
    let (mut irradiance, mut lobes) = (Sum::starting_at(zero), Sum::starting_at(zero));
    for block in lights.chunks(BLOCK) {
        let (of_block, lobes_of_block) = plain_sum(token, point, block, lobe);
        irradiance.add(of_block);
        lobes.add(lobes_of_block);
    }
    (irradiance.value(), lobes.value())
}

/// The same, by plain addition.
#[inline(always)]
fn plain_sum<V: Lane, L: Lobe<V>>(
    token: V::Token,
    point: &SurfacePoint<V>,
    lights: &[PlacedLight<V::Element>],
    lobe: &L,
) -> (V, V) {
    let zero = point.cos_theta_o.splat_like(0.0);
    let one = point.cos_theta_o.splat_like(1.0);
    let (mut irradiance, mut lobes) = (zero, zero);
    for light in lights {
        let light = light.map(
            #[inline(always)]
            |element| V::splat(token, element),
        );
        let term = light_term(point, &light, one, lobe);
        irradiance = irradiance + term.irradiance;
        lobes = term.irradiance.mul_add(term.lobe, lobes);
    }
    (irradiance, lobes)
}
