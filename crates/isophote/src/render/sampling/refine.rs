//! Many rays through the pixels that need them.

use super::FIRST_SAMPLES;
use super::cut::{Cut, Samples};
use super::edge::ROUND;
use super::pattern::{self, Patterns};
use super::tracer::{SAMPLES, SampleTracer};
use super::uncertain::Uncertain;
use crate::map::{Channel, Map, Pixel, Quantity};
use crate::prepare::Hit;
use crate::render::RenderError;
use crate::render::band::ScalarChannel;
use crate::render::packets::Place;
use crate::render::shading::block::ShadedBlock;
use crate::scene::{Filter, Sampling};

/// The channels of a layer that hold means. The others hold what is visible at the centre.
pub struct Averages {
    /// Index among the map's channels, and what the channel holds.
    channels: Vec<(usize, ScalarChannel)>,
}

/// What to compute for a pixel.
pub struct Wanted<'w> {
    /// The averages of each layer.
    pub averages: &'w [Averages],
    pub sampling: Sampling,
    /// The positions of the rays in a pixel, for each number of rays in use.
    pub patterns: &'w Patterns,
    /// The pixels within reach of the filter.
    pub offsets: &'w [[f64; 2]],
    /// The allowed error of the brightness of each layer.
    pub tolerances: &'w [f64],
}

/// A pixel's values over its area.
pub struct Refinement {
    /// Index in the map.
    pub index: usize,
    /// Whether the centre sees a surface.
    pub sees: bool,
    /// The number of samples traced for it.
    pub samples: u32,
    /// The fraction of the pixel that shows a surface.
    pub coverage: f64,
    /// In each layer, what the error of its brightness does not exceed.
    pub error_bounds: Vec<f64>,
    /// The shape at the first sample that sees any.
    pub seen: Option<usize>,
    /// The hit there; needed only if the centre sees nothing and the map has channels for geometry.
    pub hit: Option<Box<Hit>>,
    /// In each layer, for each pixel within reach of the filter, row by row from the upper left: the mean of weight × value
    /// of each averaged channel, and finally the mean weight.
    pub sums: Vec<Vec<f64>>,
}

/// What the samples of a pixel add up to.
struct Means {
    samples: u32,
    coverage: f64,
    error_bounds: Vec<f64>,
    sums: Vec<Vec<f64>>,
}

impl Means {
    /// The refinement of a pixel whose first sample that sees anything has this hit.
    fn of(self, uncertain: &Uncertain, first_hit: Option<Hit>) -> Refinement {
        let Self { samples, coverage, error_bounds, sums } = self;
        let Uncertain { index, sees, .. } = *uncertain;
        let seen = first_hit.map(|hit| hit.primitive.shape);
        let hit = first_hit.filter(|_| !sees).map(Box::new);
        Refinement { index, sees, samples, coverage, error_bounds, seen, hit, sums }
    }
}

impl Averages {
    /// The averaged channels of a layer.
    pub fn of(map: &Map) -> Self {
        let mut lights = 0..;
        let mut channel = |(index, quantity): (usize, &Quantity)| {
            let scalar = ScalarChannel::of(quantity, &mut lights)?;
            is_mean(quantity).then_some((index, scalar))
        };
        let quantities = map.channels.iter().map(|channel| &channel.quantity);
        Self { channels: quantities.enumerate().filter_map(&mut channel).collect() }
    }

    /// Index among the map's channels, and what the channel holds.
    pub fn channels(&self) -> &[(usize, ScalarChannel)] {
        &self.channels
    }
}

/// Whether a map has channels for the geometry that a pixel sees.
pub fn has_geometry(map: &Map) -> bool {
    let is_geometry =
        |channel: &Channel| matches!(channel.quantity, Quantity::Depth | Quantity::Position | Quantity::Normal);
    map.channels.iter().any(is_geometry)
}

/// Whether a pixel's value is the mean over its area. Otherwise it is the value at the centre.
pub fn is_mean(quantity: &Quantity) -> bool {
    match quantity {
        Quantity::Brightness
        | Quantity::Irradiance
        | Quantity::Diffuse
        | Quantity::Specular
        | Quantity::Ambient
        | Quantity::Light(_) => true,
        Quantity::Depth
        | Quantity::Position
        | Quantity::Normal
        | Quantity::Color
        | Quantity::Shape
        | Quantity::Samples
        | Quantity::Coverage
        | Quantity::ZDepth
        | Quantity::CosThetaO
        | Quantity::CameraNormal
        | Quantity::Material
        | Quantity::LightBrightness(_)
        | Quantity::SamplingError
        | Quantity::AmbientError => false,
    }
}

/// Traces as many rays through pixels as their contrasts require.
pub struct Refiner<'r> {
    pub tracer: SampleTracer<'r>,
    pub wanted: &'r Wanted<'r>,
}

/// A pixel that needs this many samples.
struct Open {
    pixel: Pixel,
    uncertain: Uncertain,
    samples: u32,
}

/// A pixel in two parts, of which the edge is to be located.
struct OpenCut {
    pixel: Pixel,
    uncertain: Uncertain,
    cut: Cut,
    /// How many samples are enough without cutting it.
    enough: u32,
}

/// What is left to do.
#[derive(Default)]
struct Left {
    open: Vec<Open>,
    cuts: Vec<OpenCut>,
}

/// A pixel is evenly bright if its samples differ by no more than this, in units of the tolerance.
const EVEN: f64 = 2.0;

/// Room for the samples that locate an edge: in most cases two or three rounds.
const EXPECTED_AT_EDGE: u32 = 36;

/// The side of the squares whose pixels share packets.
const SIDE: u32 = 8;

/// Rays of a packet should pass close to each other. Which ones they are does not matter to the results.
fn square(pixel: Pixel) -> (u32, u32) {
    (pixel.row / SIDE, pixel.column / SIDE)
}

impl Refiner<'_> {
    /// Refines pixels; the order of the results is any.
    pub fn refine(
        &mut self,
        pixels: impl Iterator<Item = (Pixel, Uncertain)>,
        mut advance: impl FnMut() -> Result<(), RenderError>,
    ) -> Result<Vec<Refinement>, RenderError> {
        let open = |(pixel, uncertain): (Pixel, Uncertain)| {
            let samples = self.wanted.first(&uncertain.contrasts);
            Open { pixel, uncertain, samples }
        };
        let mut left = Left { open: pixels.map(open).collect(), cuts: Vec::new() };
        let mut refined = Vec::with_capacity(left.open.len());
        while !left.open.is_empty() || !left.cuts.is_empty() {
            let Left { mut open, mut cuts } = std::mem::take(&mut left);
            let class = |open: &Open| (open.samples, square(open.pixel));
            open.sort_by_key(|open| (class(open), open.uncertain.index));
            for group in open.chunk_by(|one, other| class(one) == class(other)) {
                let together = (SAMPLES / group[0].samples as usize).max(1);
                for some in group.chunks(together) {
                    self.sample(some, &mut refined, &mut left, &mut advance)?;
                }
            }
            cuts.sort_by_key(|cut| (square(cut.pixel), cut.uncertain.index));
            while !cuts.is_empty() {
                let some = cuts.split_off(cuts.len().saturating_sub(SAMPLES / ROUND));
                advance()?;
                self.locate(some, &mut refined, &mut left)?;
            }
        }
        Ok(refined)
    }

    /// Traces the samples of pixels that need equally many of them, and finds out which of them need more.
    fn sample(
        &mut self,
        pixels: &[Open],
        refined: &mut Vec<Refinement>,
        left: &mut Left,
        advance: &mut impl FnMut() -> Result<(), RenderError>,
    ) -> Result<(), RenderError> {
        let wanted = self.wanted;
        let samples = pixels[0].samples;
        let mut means: Vec<PixelMeans> = pixels.iter().map(|_| PixelMeans::new(wanted, samples)).collect();
        let all = wanted.patterns.of(samples);
        for places in all.chunks(SAMPLES) {
            let in_pixel = |open: &Open| {
                let pixel = open.pixel;
                places.iter().map(move |within| Place { pixel, within: *within })
            };
            advance()?;
            self.tracer.trace(pixels.iter().flat_map(in_pixel))?;
            for (number, means) in means.iter_mut().enumerate() {
                means.add(&self.tracer, number * places.len(), places, wanted);
            }
        }
        for (open, means) in pixels.iter().zip(means) {
            let Open { pixel, ref uncertain, .. } = *open;
            let uncertain = uncertain.clone();
            let contrasts: Vec<f64> = means.layers.iter().map(LayerMeans::contrast).collect();
            let first = wanted.first(&contrasts);
            let is_even =
                contrasts.iter().zip(wanted.tolerances).all(|(contrast, tolerance)| *contrast <= EVEN * tolerance);
            let enough_by_neighbours = if is_even { 1 } else { wanted.enough(&uncertain.contrasts) };
            let enough = wanted.enough(&contrasts).max(enough_by_neighbours);
            if enough <= samples {
                let seen = contrasts.iter().map(|contrast| pattern::error_bound(*contrast, samples));
                let error_bounds = or_undetected(seen, &uncertain, samples);
                refined.push(means.finish(&uncertain, samples, error_bounds));
            } else if first > samples {
                left.open.push(Open { pixel, uncertain, samples: first });
            } else if wanted.may_cut(samples)
                && let Some(cut) = Cut::new(&means.into_samples(all), &contrasts, wanted)
            {
                left.cuts.push(OpenCut { pixel, uncertain, cut, enough });
            } else {
                left.open.push(Open { pixel, uncertain, samples: enough });
            }
        }
        Ok(())
    }

    /// Traces samples at the edges of cut pixels.
    fn locate(
        &mut self,
        cuts: Vec<OpenCut>,
        refined: &mut Vec<Refinement>,
        left: &mut Left,
    ) -> Result<(), RenderError> {
        let in_pixel = |open: &OpenCut| {
            let pixel = open.pixel;
            open.cut.places().map(|within| Place { pixel, within: within.map(pattern::short) })
        };
        self.tracer.trace(cuts.iter().flat_map(in_pixel))?;
        for (number, OpenCut { pixel, uncertain, mut cut, enough }) in cuts.into_iter().enumerate() {
            let (shaded, at) = self.tracer.values(cut.layer);
            let brightness = |sample: usize| {
                let sample = number * ROUND + sample;
                self.tracer.hit(sample).map_or(0.0, |_| shaded.brightness[at(sample)])
            };
            let is_cut = cut.bisect(std::array::from_fn(brightness)).is_some();
            let bounds = cut.error_bounds().map(|bounds| or_undetected(bounds.into_iter(), &uncertain, cut.samples));
            let is_within =
                |bounds: &Vec<f64>| bounds.iter().zip(self.wanted.tolerances).all(|(bound, most)| bound <= most);
            match bounds.filter(|bounds| is_cut && is_within(bounds)) {
                Some(error_bounds) if cut.is_confirmed(self.wanted.patterns.of(cut.samples)) => {
                    let (coverage, sums) = cut.means();
                    let means = Means { samples: cut.count(), coverage, error_bounds, sums };
                    refined.push(means.of(&uncertain, cut.first_hit));
                }
                None if is_cut && cut.has_rounds() => left.cuts.push(OpenCut { pixel, uncertain, cut, enough }),
                _ => left.open.push(Open { pixel, uncertain, samples: enough }),
            }
        }
        Ok(())
    }
}

/// The bounds of the errors in each layer, or what a part of the pixel may make that none of these samples has detected.
fn or_undetected(bounds: impl Iterator<Item = f64>, uncertain: &Uncertain, samples: u32) -> Vec<f64> {
    let undetected = uncertain.contrasts.iter().map(|contrast| pattern::undetected_error(*contrast, samples));
    bounds.zip(undetected).map(|(bound, undetected)| bound.max(undetected)).collect()
}

impl Wanted<'_> {
    /// Whether a pixel with this many samples may be cut.
    fn may_cut(&self, samples: u32) -> bool {
        self.sampling.filter == Filter::Box && Cut::most_samples(samples) <= self.sampling.samples
    }

    /// How many samples are enough where brightness differs by this much in each layer.
    fn enough(&self, contrasts: &[f64]) -> u32 {
        self.most(contrasts, pattern::enough)
    }

    /// How many samples are traced first where brightness differs by this much in each layer: enough, or, if cutting the pixel
    /// may save most of them, as many as detect all of its parts.
    fn first(&self, contrasts: &[f64]) -> u32 {
        let few = FIRST_SAMPLES.min(self.sampling.samples);
        let [enough, detecting] =
            [pattern::enough, pattern::enough_to_detect].map(|samples| self.most(contrasts, samples).max(few));
        if self.may_cut(detecting) && detecting + EXPECTED_AT_EDGE <= enough / 2 { detecting } else { enough }
    }

    /// The largest number of samples that any layer needs.
    fn most(&self, contrasts: &[f64], samples: impl Fn(f64, f64, u32) -> u32) -> u32 {
        let of_layer = |(contrast, tolerance): (&f64, &f64)| samples(*contrast, *tolerance, self.sampling.samples);
        contrasts.iter().zip(self.tolerances).map(of_layer).max().unwrap_or(1)
    }
}

/// The sums over the samples of a pixel.
struct PixelMeans<'w> {
    layers: Vec<LayerMeans<'w>>,
    first_hit: Option<Hit>,
    /// Which samples see a surface.
    see: Vec<bool>,
}

impl<'w> PixelMeans<'w> {
    fn new(wanted: &Wanted<'w>, samples: u32) -> Self {
        let keeps = wanted.may_cut(samples);
        let layers = wanted.averages.iter().map(|of| LayerMeans::new(of, wanted.offsets, keeps)).collect();
        Self { layers, first_hit: None, see: Vec::new() }
    }

    /// Adds samples that have been traced, given by the number of the first one and their positions in the pixel.
    fn add(&mut self, tracer: &SampleTracer<'_>, first: usize, places: &[[f64; 2]], wanted: &Wanted<'_>) {
        let hits = (first..first + places.len()).map(|sample| tracer.hit(sample));
        self.see.extend(hits.clone().map(|hit| hit.is_some()));
        self.first_hit = self.first_hit.or_else(|| hits.flatten().next().copied());
        for (layer, means) in self.layers.iter_mut().enumerate() {
            let (shaded, at) = tracer.values(layer);
            let seen = places.iter().zip(first..);
            let seen = seen.map(|(place, sample)| (*place, tracer.hit(sample).map(|_| at(sample))));
            means.add(seen, shaded, wanted.sampling.filter, wanted.offsets);
        }
    }

    fn into_samples(self, places: &[[f64; 2]]) -> Samples<'_> {
        let Self { layers, first_hit, see, .. } = self;
        Samples {
            places,
            see,
            values: layers.into_iter().map(|layer| layer.values.unwrap_or_default()).collect(),
            first_hit,
        }
    }

    fn finish(self, uncertain: &Uncertain, samples: u32, error_bounds: Vec<f64>) -> Refinement {
        let share = 1.0 / f64::from(samples);
        let covered: f64 = self.see.iter().map(|sees| f64::from(*sees)).sum();
        let coverage = covered * share;
        let sums = self.layers.into_iter().map(|means| means.finish(share)).collect();
        Means { samples, coverage, error_bounds, sums }.of(uncertain, self.first_hit)
    }
}

/// The sums over the samples of a pixel in a layer.
struct LayerMeans<'w> {
    channels: &'w [(usize, ScalarChannel)],
    sums: Vec<f64>,
    least: f64,
    greatest: f64,
    /// The values of each sample, if they are kept.
    values: Option<Vec<f64>>,
}

impl<'w> LayerMeans<'w> {
    fn new(averages: &'w Averages, offsets: &[[f64; 2]], keeps: bool) -> Self {
        let channels = &averages.channels;
        let sums = vec![0.0; offsets.len() * (channels.len() + 1)];
        Self { channels, sums, least: f64::INFINITY, greatest: f64::NEG_INFINITY, values: keeps.then(Vec::new) }
    }

    /// Adds samples, given by their positions and where their values are, if they see anything.
    fn add(
        &mut self,
        seen: impl Iterator<Item = ([f64; 2], Option<usize>)>,
        shaded: &ShadedBlock<f64>,
        filter: Filter,
        offsets: &[[f64; 2]],
    ) {
        let count = self.channels.len();
        for (place, point) in seen {
            let at = |values: &[f64]| point.map_or(0.0, |point| values[point]);
            let brightness = at(&shaded.brightness);
            (self.least, self.greatest) = (self.least.min(brightness), self.greatest.max(brightness));
            if let Some(values) = &mut self.values {
                values.extend(self.channels.iter().map(|(_, channel)| at(shaded.values(*channel))));
            }
            let [across, down] = place.map(|part| part - 0.5);
            for (sums, [columns, rows]) in self.sums.chunks_exact_mut(count + 1).zip(offsets) {
                let weight = filter.weight(across - columns, down - rows);
                for (sum, (_, channel)) in sums.iter_mut().zip(self.channels) {
                    *sum += weight * at(shaded.values(*channel));
                }
                sums[count] += weight;
            }
        }
    }

    fn contrast(&self) -> f64 {
        self.greatest - self.least
    }

    fn finish(mut self, share: f64) -> Vec<f64> {
        for sum in &mut self.sums {
            *sum *= share;
        }
        self.sums
    }
}

/// The pixels within reach of the filter from one pixel, as column and row offsets.
pub fn offsets(filter: Filter) -> Vec<[f64; 2]> {
    let reach = i32::try_from(filter.reach()).unwrap_or(0);
    let rows = (-reach..=reach).flat_map(|row| (-reach..=reach).map(move |column| [column, row]));
    rows.map(|offset| offset.map(f64::from)).collect()
}
