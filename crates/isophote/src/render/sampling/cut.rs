//! A pixel in two parts, of which each is about evenly bright, with an edge between them.

use super::edge::{Edge, ROUND};
use super::pattern::{error_bound, ratio};
use super::range;
use super::refine::Wanted;
use crate::prepare::Hit;
use crate::render::band::ScalarChannel;

/// The values of a pixel's samples.
pub struct Samples<'s> {
    pub places: &'s [[f64; 2]],
    /// Which of them see a surface.
    pub see: Vec<bool>,
    /// In each layer, sample by sample, the value of each averaged channel.
    pub values: Vec<Vec<f64>>,
    pub first_hit: Option<Hit>,
}

/// A pixel in two parts.
pub struct Cut {
    edge: Edge,
    rounds: u32,
    /// The samples that told the parts, and which of them are in the brighter one.
    pub samples: u32,
    is_bright: Vec<bool>,
    /// The layer in which the parts are told apart.
    pub layer: usize,
    /// The least and the greatest brightness there in the darker and in the brighter part.
    ranges: [[f64; 2]; 2],
    layers: Vec<LayerParts>,
    /// The fraction of each part that shows a surface.
    coverage: [f64; 2],
    pub first_hit: Option<Hit>,
}

/// The parts in a layer.
struct LayerParts {
    /// In each part, the mean of each averaged channel.
    means: [Vec<f64>; 2],
    /// How much brighter one is than the other.
    contrast: f64,
    /// The error that their unevenness may cause.
    unevenness: f64,
}

#[expect(clippy::cast_possible_truncation, reason = "small")]
const SAMPLES_OF_ROUND: u32 = ROUND as u32;

/// The largest number of rounds: what has not been located by then is no edge.
pub const ROUNDS: u32 = 8;

/// How uneven the parts may be: the part of the tolerance that this may use up.
const UNEVEN: f64 = 0.5;

/// How far a brightness may be from those of a part's samples, as a fraction of the gap between the parts.
const OUTSIDE: f64 = 0.25;

impl Cut {
    /// Cuts a pixel, whose brightness differs by so much in each layer, at the largest gap, if a straight line separates the
    /// samples on both sides of the gap, and each side is about evenly bright.
    pub fn new(samples: &Samples<'_>, contrasts: &[f64], wanted: &Wanted<'_>) -> Option<Self> {
        let in_tolerances = |layer: usize| ratio(contrasts[layer], wanted.tolerances[layer]);
        let layer = (0..contrasts.len()).max_by(|one, other| in_tolerances(*one).total_cmp(&in_tolerances(*other)))?;
        let brightness = samples.brightness(layer, wanted)?;
        let ranges = around_gap(&brightness)?;
        let is_bright: Vec<bool> = brightness.iter().map(|value| *value >= ranges[1][0]).collect();
        let parts = [false, true].map(|bright| Part::new(&is_bright, bright));
        let layers = (0..contrasts.len()).map(|layer| LayerParts::new(samples, &parts, layer, wanted));
        let layers = layers.collect::<Option<_>>()?;
        let [dark, bright] = parts.each_ref().map(|part| part.of(samples.places).collect::<Vec<_>>());
        let edge = Edge::between(&dark, &bright)?;
        let coverage = parts.map(|part| part.mean(|sample| f64::from(samples.see[sample])));
        let (samples, first_hit) = (samples.count(), samples.first_hit);
        Some(Self { edge, rounds: 0, samples, is_bright, layer, ranges, layers, coverage, first_hit })
    }

    /// The samples to trace next.
    pub fn places(&self) -> [[f64; 2]; ROUND] {
        self.edge.places()
    }

    /// Takes their brightness in the layer that tells the parts apart; `None` if the pixel is not what it seemed.
    pub fn bisect(&mut self, brightness: [f64; ROUND]) -> Option<()> {
        self.rounds += 1;
        let slack = OUTSIDE * (self.ranges[1][0] - self.ranges[0][1]);
        let mut is_bright = [false; ROUND];
        for (is_bright, value) in is_bright.iter_mut().zip(brightness) {
            let is_in = |[least, greatest]: [f64; 2]| (least - slack..=greatest + slack).contains(&value);
            *is_bright = is_in(self.ranges[1]);
            if !*is_bright && !is_in(self.ranges[0]) {
                return None;
            }
        }
        self.edge.bisect(&is_bright)
    }

    /// In each layer, what the error of the brightness does not exceed; `None` while the edge has been seen from one side only.
    pub fn error_bounds(&self) -> Option<Vec<f64>> {
        let uncertainty = self.edge.uncertainty()?;
        Some(self.layers.iter().map(|layer| layer.contrast * uncertainty + layer.unevenness).collect())
    }

    /// Whether the edge is where all samples say.
    pub fn is_confirmed(&self, places: &[[f64; 2]]) -> bool {
        self.edge.agrees(places.iter().copied().zip(self.is_bright.iter().copied()))
    }

    /// Whether there may be another round.
    pub fn has_rounds(&self) -> bool {
        self.rounds < ROUNDS
    }

    /// The largest number of samples that cutting a pixel may take after these.
    pub fn most_samples(samples: u32) -> u32 {
        samples + ROUNDS * SAMPLES_OF_ROUND
    }

    /// The number of samples so far.
    pub fn count(&self) -> u32 {
        self.samples + self.rounds * SAMPLES_OF_ROUND
    }

    /// The fraction of the pixel that shows a surface, and in each layer the mean of each averaged channel.
    pub fn means(&self) -> (f64, Vec<Vec<f64>>) {
        let dark = self.edge.dark_area();
        let mean = |[in_dark, in_bright]: [f64; 2]| dark * in_dark + (1.0 - dark) * in_bright;
        let of_layer = |layer: &LayerParts| {
            let [dark, bright] = &layer.means;
            dark.iter().zip(bright).map(|(dark, bright)| mean([*dark, *bright])).chain([1.0]).collect()
        };
        (mean(self.coverage), self.layers.iter().map(of_layer).collect())
    }
}

impl LayerParts {
    /// `None` if the parts are not evenly bright.
    fn new(samples: &Samples<'_>, parts: &[Part; 2], layer: usize, wanted: &Wanted<'_>) -> Option<Self> {
        let brightness = samples.brightness(layer, wanted)?;
        let [in_dark, in_bright] = parts.each_ref().map(|part| {
            let [least, greatest] = range(part.of(&brightness));
            error_bound(greatest - least, samples.count())
        });
        let unevenness = in_dark + in_bright;
        if unevenness > UNEVEN * wanted.tolerances[layer] {
            return None;
        }
        let (values, channels) = (&samples.values[layer], wanted.averages[layer].channels().len());
        let means = parts.each_ref().map(|part| {
            let mean = |channel| part.mean(|sample| values[sample * channels + channel]);
            (0..channels).map(mean).collect()
        });
        let [dark, bright] = parts.each_ref().map(|part| part.mean(|sample| brightness[sample]));
        Some(Self { means, contrast: (bright - dark).abs(), unevenness })
    }
}

impl Samples<'_> {
    fn count(&self) -> u32 {
        u32::try_from(self.places.len()).unwrap_or(u32::MAX)
    }

    /// The brightness of each sample in a layer.
    fn brightness(&self, layer: usize, wanted: &Wanted<'_>) -> Option<Vec<f64>> {
        let channels = wanted.averages[layer].channels();
        let index = channels.iter().position(|(_, channel)| *channel == ScalarChannel::Brightness)?;
        Some(self.values[layer].iter().skip(index).step_by(channels.len()).copied().collect())
    }
}

/// The samples of a part of a pixel.
struct Part {
    samples: Vec<usize>,
    /// 1 divided by their number.
    share: f64,
}

impl Part {
    fn new(is_bright: &[bool], bright: bool) -> Self {
        let samples: Vec<usize> = (0..is_bright.len()).filter(|sample| is_bright[*sample] == bright).collect();
        #[expect(clippy::cast_precision_loss, reason = "small")]
        let share = 1.0 / samples.len() as f64;
        Self { samples, share }
    }

    /// What belongs to them, of what belongs to all samples.
    fn of<T: Copy>(&self, all: &[T]) -> impl Iterator<Item = T> {
        self.samples.iter().map(|sample| all[*sample])
    }

    /// The mean of a value of each sample.
    fn mean(&self, value: impl Fn(usize) -> f64) -> f64 {
        self.samples.iter().map(|sample| value(*sample)).sum::<f64>() * self.share
    }
}

/// The least and the greatest of the values below the widest gap among them, and of those above it.
fn around_gap(values: &[f64]) -> Option<[[f64; 2]; 2]> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let gap = |pair: &[f64]| pair[1] - pair[0];
    let widest = sorted.windows(2).max_by(|one, other| gap(one).total_cmp(&gap(other)))?;
    (gap(widest) > 0.0).then_some([[sorted[0], widest[0]], [widest[1], *sorted.last()?]])
}
