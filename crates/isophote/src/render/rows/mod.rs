//! Visibility by rows: the outlines of a few spheres, intersected with each row of a band.

mod visible;

use std::ops::Range;

use super::band::{self, Band};
use super::fan_out::{Pixels, Shaded};
use super::hits::HitBlock;
use super::rays;
use super::shading::block::{POINTS, ShadedBlock, SurfaceBlock};
use super::shading::emitters::{BLOCK, Chosen, Lighting, ShapeEmitters};
use super::shading::kernel::{Lit, Points, Unobstructed};
use super::shading::lobe::Power;
use super::{Observer, RenderError};
use crate::lanes::{Element, Lane, LaneJob, Precision, SimdToken};
use crate::light::Ambient;
use crate::map::{Pixel, Run};
use crate::outline::{Ellipse, PlaceInRow, PointInRow, RowOfEllipse};
use crate::prepare::PreparedScene;
use crate::reflectance::BrightnessFormula;
use crate::shape::SurfacePoint;
use crate::vector::Vector;
pub use visible::Candidate;
use visible::{RowView, Stretch};

/// A band to be filled.
pub struct RowsJob<'a, 'm> {
    /// The scene.
    pub scene: &'a PreparedScene,
    /// The band.
    pub band: Band<'m>,
    /// The shapes that may be visible in it.
    pub candidates: Vec<Candidate<'a>>,
    /// The scene's lights.
    pub lighting: &'a Lighting,
    /// The lights whose own irradiance is requested.
    pub asked_for: &'a [usize],
    /// The precision of the shading.
    pub precision: Precision,
    /// Receives progress reports.
    pub observer: Option<&'a dyn Observer>,
}

/// Columns that share a selection of lights.
const CHUNK: u32 = 128;

/// Lights times pixels between two checks for an interruption: a few milliseconds.
const UNINTERRUPTED: u64 = 1 << 20;

impl LaneJob for RowsJob<'_, '_> {
    type Output = Result<Vec<Run>, RenderError>;

    #[inline(always)]
    fn run<S, D>(mut self, token: S::Token) -> Self::Output
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        let columns = self.band.first.column..self.band.first.column + self.band.size.width;
        let mut shader = RowShader::new(&self);
        let mut hits = HitBlock::new(self.scene, self.asked_for);
        let mut view = RowView::default();
        let mut runs = Vec::new();
        let rows = self.band.first.row..self.band.first.row + self.band.size.height;
        let seen = seen_rows(&self.candidates, &rows);
        let unseen = (seen.start - rows.start) + (rows.end - seen.end);
        band::advance(self.observer, u64::from(self.band.size.width) * u64::from(unseen))?;
        for row in seen {
            view.look(&self.candidates, row, &columns);
            for stretch in &view.stretches {
                let Ok(index) = self.candidates.binary_search_by_key(&stretch.shape, |candidate| candidate.shape)
                else {
                    unreachable!("what is seen is among the candidates");
                };
                let work = StretchWork::new(&self.candidates[index], *stretch, row);
                shader.shade::<S, D>(token, index, &work, &mut self.band)?;
            }
            let doubtful = view.doubtful.iter().map(|column| Pixel { column: *column, row });
            let traced = rays::retrace(self.scene, doubtful, &mut self.band, &mut hits)?;
            see(&self.band, row, &view.stretches, &traced, &mut runs);
            band::advance(self.observer, self.band.size.width.into())?;
        }
        hits.put(&mut self.band)?;
        Ok(runs)
    }
}

/// The rows in which anything can be visible.
fn seen_rows(candidates: &[Candidate<'_>], rows: &Range<u32>) -> Range<u32> {
    let start = candidates.iter().map(|candidate| candidate.rows.start).min().unwrap_or(rows.end);
    let end = candidates.iter().map(|candidate| candidate.rows.end).max().unwrap_or(rows.end);
    start.max(rows.start)..end.min(rows.end).max(start.max(rows.start))
}

/// Merges the stretches and the traced pixels of a row in order.
fn see(band: &Band<'_>, row: u32, stretches: &[Stretch], traced: &[(Pixel, usize)], runs: &mut Vec<Run>) {
    let mut traced = traced.iter().peekable();
    for stretch in stretches {
        while let Some((pixel, shape)) = traced.next_if(|(pixel, _)| pixel.column < stretch.start) {
            band.see(*pixel, 1, *shape, runs);
        }
        band.see(Pixel { column: stretch.start, row }, stretch.end - stretch.start, stretch.shape, runs);
    }
    for (pixel, shape) in traced {
        band.see(*pixel, 1, *shape, runs);
    }
}

/// Shades stretches: scratch memory in either precision, and what is cached per shape.
struct RowShader<'a> {
    layers: Vec<&'a PreparedScene>,
    lighting: &'a Lighting,
    candidates: Vec<Candidate<'a>>,
    precision: Precision,
    observer: Option<&'a dyn Observer>,
    /// The light on each candidate, placed when it is first visible.
    kept: Vec<Option<Vec<LitShape<'a>>>>,
    /// The number of cached emitters, over all shapes.
    kept_emitters: usize,
    single: Scratch<f32>,
    double: Scratch<f64>,
    geometry: Option<Box<SurfaceBlock<f64>>>,
}

/// The most emitters cached in a band: beyond that, they are placed again each time rather than fill the memory.
const KEPT: usize = 1 << 20;

/// The light on a shape in a layer of the scene.
struct LitShape<'a> {
    layer: &'a PreparedScene,
    emitters: ShapeEmitters,
    all: AllChosen,
    power: Power,
    formula: &'a BrightnessFormula,
    /// E_a: nothing obstructs it in the scenes that are rendered by rows, which have one convex shape, or several that do
    /// not obstruct it.
    ambient: f64,
}

/// All emitters of a shape, in the precision in which it is shaded.
enum AllChosen {
    Single(Chosen<f32>),
    Double(Chosen<f64>),
}

struct Scratch<E> {
    chosen: Vec<KeptChoice<E>>,
    shaded: Box<ShadedBlock<E>>,
}

/// A selection of emitters that is good for several rows.
#[derive(Default)]
struct KeptChoice<E> {
    made_for: Option<ChoiceFor>,
    chosen: Chosen<E>,
}

/// What a selection of emitters is made for.
#[derive(Clone, Copy, PartialEq, Eq)]
struct ChoiceFor {
    candidate: usize,
    layer: usize,
    /// The columns, as the number of a chunk.
    chunk: u32,
    /// The rows, as the number of [`ROWS_OF_CHOICE`] of them.
    rows: u32,
}

/// Rows that share a selection of lights.
const ROWS_OF_CHOICE: u32 = 8;

/// The most emitters in the selections that are kept.
const KEPT_IN_CHOICES: usize = 1 << 16;

impl<E: Element> Scratch<E> {
    fn new(band: &Band<'_>, lights: usize) -> Self {
        let mut shaded = ShadedBlock::new(lights);
        shaded.is_whole = band.shows_parts();
        Self { chosen: Vec::new(), shaded }
    }

    /// Where the selection for a chunk is kept, of so many emitters.
    fn kept(&mut self, chunk: u32, emitters: usize) -> usize {
        let places = (KEPT_IN_CHOICES / emitters).max(1);
        let place = chunk as usize % places;
        if self.chosen.len() <= place {
            self.chosen.resize_with(place + 1, KeptChoice::default);
        }
        place
    }
}

impl<'a> RowShader<'a> {
    fn new(job: &RowsJob<'a, '_>) -> Self {
        let lights = job.asked_for.len();
        Self {
            layers: job.scene.layers(),
            lighting: job.lighting,
            candidates: job.candidates.clone(),
            precision: job.precision,
            observer: job.observer,
            kept: job.candidates.iter().map(|_| None).collect(),
            kept_emitters: 0,
            single: Scratch::new(&job.band, lights),
            double: Scratch::new(&job.band, lights),
            geometry: job.band.has_geometry().then(SurfaceBlock::new),
        }
    }

    /// Shades a stretch of a candidate.
    #[inline(always)]
    fn shade<S, D>(
        &mut self,
        token: S::Token,
        candidate: usize,
        work: &StretchWork<'_>,
        band: &mut Band<'_>,
    ) -> Result<(), RenderError>
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        self.keep(candidate);
        let Self { kept, lighting, single, double, observer, .. } = self;
        let Some(layers) = &kept[candidate] else { unreachable!("it was placed") };
        for (index, lit) in layers.iter().enumerate() {
            let mut target = Target { lit, lighting, candidate, layer: index, band: &mut *band, observer: *observer };
            match &lit.all {
                AllChosen::Single(all) => target.shade::<S>(token, work, all, single)?,
                AllChosen::Double(all) => target.shade::<D>(token, work, all, double)?,
            }
        }
        if let Some(block) = &mut self.geometry {
            token.in_own_function(
                #[inline(always)]
                || work.put_geometry::<D>(token, block, band),
            );
        }
        Ok(())
    }

    /// Makes sure that a candidate's light is cached.
    fn keep(&mut self, candidate: usize) {
        if self.kept[candidate].is_some() {
            return;
        }
        if self.kept_emitters > KEPT {
            self.kept.fill_with(|| None);
            self.kept_emitters = 0;
        }
        let lit = |layer| LitShape::new(layer, self.lighting, &self.candidates[candidate], self.precision);
        let layers: Vec<LitShape<'a>> = self.layers.iter().copied().map(lit).collect();
        self.kept_emitters += layers.iter().map(|lit| lit.emitters.len()).sum::<usize>();
        self.kept[candidate] = Some(layers);
    }
}

impl<'a> LitShape<'a> {
    fn new(layer: &'a PreparedScene, lighting: &Lighting, candidate: &Candidate<'a>, precision: Precision) -> Self {
        let mut emitters = ShapeEmitters::default();
        lighting.place(layer, &candidate.sphere, &mut emitters);
        let formula = layer.formula(candidate.primitive());
        let ambient = layer.scene().ambient().map_or(0.0, Ambient::unobstructed_irradiance);
        let is_single =
            precision == Precision::Single && candidate.ellipse.fits_single() && emitters.fit_single(ambient, formula);
        let all = if is_single {
            let mut all = Chosen::default();
            all.choose_all(layer, lighting, &emitters);
            AllChosen::Single(all)
        } else {
            let mut all = Chosen::default();
            all.choose_all(layer, lighting, &emitters);
            AllChosen::Double(all)
        };
        let precision = if is_single { Precision::Single } else { Precision::Double };
        Self { layer, emitters, all, power: Power::of(formula, precision), formula, ambient }
    }
}

/// Columns of a row that see the same sphere.
struct StretchWork<'c> {
    ellipse: &'c Ellipse,
    row: RowOfEllipse,
    roots: [Root; 2],
    /// [`Ellipse::column`](crate::outline::Ellipse::column).
    counted_from: f64,
    center: Vector,
    radius: f64,
    stretch: Stretch,
    at_row: u32,
}

/// A root of a row as a whole number and a rest of at most ½: near the outline, single precision would lose the digits of the
/// distance from their sum.
#[derive(Clone, Copy)]
struct Root {
    whole: f64,
    rest: f64,
}

impl Root {
    fn new(root: f64) -> Self {
        let whole = root.round();
        Self { whole, rest: root - whole }
    }

    /// How far columns are behind it: the difference of whole numbers is exact.
    #[inline(always)]
    fn before<V: Lane>(self, token: V::Token, column: V) -> V {
        let whole = V::splat(token, V::Element::from_f64(self.whole));
        (column - whole) - V::splat(token, V::Element::from_f64(self.rest))
    }
}

/// Where a stretch is written, and the light that it is shaded in.
struct Target<'t, 'a, 'm> {
    lit: &'t LitShape<'a>,
    lighting: &'t Lighting,
    candidate: usize,
    layer: usize,
    band: &'t mut Band<'m>,
    observer: Option<&'t dyn Observer>,
}

impl Target<'_, '_, '_> {
    #[inline(always)]
    fn shade<V: Lane>(
        &mut self,
        token: V::Token,
        work: &StretchWork<'_>,
        all: &Chosen<V::Element>,
        scratch: &mut Scratch<V::Element>,
    ) -> Result<(), RenderError>
    where
        for<'s> Shaded<'s>: From<&'s ShadedBlock<V::Element>>,
    {
        let LitShape { layer, emitters, power, formula, ambient, .. } = self.lit;
        let row = work.row.map(
            #[inline(always)]
            |value| V::splat(token, V::Element::from_f64(value)),
        );
        let ambient = V::splat(token, V::Element::from_f64(*ambient));
        // Counted in the full image, so that the selection of lights, and with it the order of the sum, is the same for any
        // region.
        let has_choice = emitters.len() > BLOCK;
        for columns in work.chunks(if has_choice { CHUNK } else { WHOLE }) {
            let selection = if has_choice {
                let (chunk, rows) = (columns.start / CHUNK, work.at_row / ROWS_OF_CHOICE);
                let place = scratch.kept(chunk, emitters.len());
                let KeptChoice { made_for, chosen } = &mut scratch.chosen[place];
                let this = ChoiceFor { candidate: self.candidate, layer: self.layer, chunk, rows };
                if *made_for != Some(this) {
                    chosen.choose_above_horizon(layer, self.lighting, emitters, work.cap_of_rows(chunk));
                    *made_for = Some(this);
                }
                chosen.selection()
            } else {
                all.selection()
            };
            let count = columns.len();
            if count as u64 * selection.emitters.len() as u64 > UNINTERRUPTED {
                band::advance(self.observer, 0)?;
            }
            let points = RowPoints { work, row: &row, first: columns.start, ambient };
            let lit = Lit { points: &points, count, formula, power, selection, visibility: &Unobstructed };
            lit.shade::<V>(token, &mut scratch.shaded);
            let start = self.band.index(Pixel { column: columns.start, row: work.at_row });
            self.band.put(self.layer, Pixels::InRow { start, count }, Shaded::from(&*scratch.shaded))?;
        }
        Ok(())
    }
}

/// As many columns as a block has points: without a new selection of lights, a stretch is cut only for this reason.
#[expect(clippy::cast_possible_truncation, reason = "a few hundred")]
const WHOLE: u32 = POINTS as u32;

/// The points of some columns of a row, straight from the outline. (This avoids storing them in a block first, which costs
/// about as much as one light.)
struct RowPoints<'p, V> {
    work: &'p StretchWork<'p>,
    row: &'p RowOfEllipse<V>,
    first: u32,
    ambient: V,
}

impl<V: Lane> Points<V> for RowPoints<'_, V> {
    #[inline(always)]
    fn point(&self, token: V::Token, at: usize) -> SurfacePoint<V> {
        self.work.point(token, self.row, self.first, at).point
    }

    #[inline(always)]
    fn ambient(&self, _: V::Token, _: usize) -> V {
        self.ambient
    }
}

impl<'c> StretchWork<'c> {
    fn new(candidate: &Candidate<'c>, stretch: Stretch, at_row: u32) -> Self {
        let row = candidate.ellipse.in_row(at_row);
        Self {
            ellipse: candidate.ellipse,
            row,
            roots: row.roots.map(Root::new),
            counted_from: candidate.ellipse.column,
            center: candidate.sphere.center,
            radius: candidate.sphere.radius,
            stretch,
            at_row,
        }
    }

    /// The columns, cut where the image is cut into chunks of this width.
    fn chunks(&self, width: u32) -> impl Iterator<Item = Range<u32>> + use<> {
        let Stretch { mut start, end, .. } = self.stretch;
        std::iter::from_fn(move || {
            let next = end.min((start / width + 1) * width);
            let chunk = (start < end).then_some(start..next);
            start = next;
            chunk
        })
    }

    /// What a vector of pixels sees; its first pixel is `after` columns to the right of `first`.
    #[inline(always)]
    #[expect(clippy::cast_precision_loss, reason = "a few hundred columns")]
    fn point<V: Lane>(&self, token: V::Token, row: &RowOfEllipse<V>, first: u32, after: usize) -> PointInRow<V> {
        let column = V::counted(token, f64::from(first) + after as f64 - self.counted_from);
        let [first, last] = self.roots;
        let place =
            PlaceInRow { column, after_first: first.before(token, column), after_last: last.before(token, column) };
        row.point(self.center, &place)
    }

    /// A cap of the unit sphere, given by the direction of its middle and the largest distance from there, that contains
    /// everything the columns of a chunk can see in the rows that share its selection of lights, this one among them.
    fn cap_of_rows(&self, chunk: u32) -> (Vector, f64) {
        let first = self.at_row / ROWS_OF_CHOICE * ROWS_OF_CHOICE;
        let mut caps = (first..first + ROWS_OF_CHOICE).filter_map(|row| self.cap(&self.ellipse.in_row(row), chunk));
        let Some((middle, reach)) = caps.next() else { return (Vector::default(), f64::INFINITY) };
        let farthest = |farthest: f64, (other, reach): (Vector, f64)| farthest.max((other - middle).length() + reach);
        (middle, caps.fold(reach, farthest))
    }

    /// The cap for a single row; `None` if it sees nothing there. A row cuts the sphere in a circle, so the ends are farthest
    /// from the middle.
    fn cap(&self, row: &RowOfEllipse, chunk: u32) -> Option<(Vector, f64)> {
        let [left, right] = row.roots;
        let start = f64::from(chunk) * f64::from(CHUNK) - self.counted_from;
        let [first, last] = [start.max(left), (start + f64::from(CHUNK)).min(right)];
        if first >= last {
            return None;
        }
        let normal = |u: f64| {
            let place = PlaceInRow { column: u, after_first: u - left, after_last: u - right };
            row.point(self.center, &place).point.normal
        };
        let middle = normal(0.5 * (first + last));
        let reach = |u: f64| (normal(u) - middle).length();
        Some((middle, reach(first).max(reach(last))))
    }

    #[inline(always)]
    fn put_geometry<D: Lane<Element = f64>>(
        &self,
        token: D::Token,
        block: &mut SurfaceBlock<f64>,
        band: &mut Band<'_>,
    ) {
        let row = self.row.map(
            #[inline(always)]
            |value| D::splat(token, value),
        );
        (block.anchor, block.unit) = (self.center, self.radius);
        for columns in self.chunks(WHOLE) {
            for at in (0..columns.len()).step_by(D::COUNT) {
                block.store(at, &self.point(token, &row, columns.start, at));
            }
            let start = band.index(Pixel { column: columns.start, row: self.at_row });
            band.put_geometry(Pixels::InRow { start, count: columns.len() }, block);
        }
    }
}
