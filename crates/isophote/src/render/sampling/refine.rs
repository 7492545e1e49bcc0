//! Many rays through the pixels that need them, and what they make of a map.

use super::pattern::{self, Patterns};
use super::uncertain::Uncertain;
use super::{FIRST_SAMPLES, Filter, Sampling};
use crate::camera::ScreenPosition;
use crate::hammersley::points;
use crate::map::{Map, Mask, Pixel, Quantity, Scalars, Values};
use crate::prepare::{Hit, PreparedScene};
use crate::render::RenderError;
use crate::render::band::ScalarChannel;
use crate::shade::ByLight;

/// The channels of a map that are means. The others hold what is seen at the centre.
pub struct Averages {
    /// Index among the map's channels, and what it is.
    channels: Vec<(usize, ScalarChannel)>,
}

/// What is asked of a pixel.
pub struct Wanted<'w> {
    pub averages: &'w Averages,
    pub sampling: Sampling,
    /// The places of the rays in a pixel, for each number of them that is asked for.
    pub patterns: &'w Patterns,
    /// The pixels that the filter reaches.
    pub offsets: &'w [[f64; 2]],
    /// The allowed error of the brightness.
    pub tolerance: f64,
}

/// What the rays through a pixel saw.
pub struct Refinement {
    /// Index in the map.
    index: usize,
    samples: u32,
    /// The part of them that saw a surface.
    coverage: f64,
    /// What the first one saw that saw anything; needed where the centre does not.
    hit: Option<Hit>,
    /// For each pixel that the filter reaches, row by row from the upper left: the mean of weight × value of each
    /// averaged channel, and last the mean weight.
    sums: Vec<f64>,
}

impl Averages {
    /// The averaged channels of a map.
    pub fn of(map: &Map, scene: &PreparedScene) -> Self {
        let channels = map.channels.iter().enumerate().filter(|(_, channel)| is_mean(&channel.quantity));
        let channels = channels.map(|(index, channel)| (index, ScalarChannel::of(&channel.quantity, scene.scene())));
        Self { channels: channels.collect() }
    }

    /// Index among the map's channels, and what it is.
    pub fn channels(&self) -> &[(usize, ScalarChannel)] {
        &self.channels
    }

    /// The lights whose irradiance is averaged by itself, in the order of their channels.
    pub fn lights(&self) -> impl Iterator<Item = usize> {
        self.channels.iter().filter_map(|(_, channel)| channel.light())
    }

    /// The values of a hit, and its brightness.
    fn values(&self, scene: &PreparedScene, hit: &Hit, position: ScreenPosition, values: &mut [f64]) -> f64 {
        let mut by_light = ByLight::of(self.lights());
        let shading = scene.shade(hit, Some(position), |light, term| by_light.take(light, term));
        for (value, (_, channel)) in values.iter_mut().zip(&self.channels) {
            match channel {
                ScalarChannel::Brightness => *value = shading.brightness(),
                ScalarChannel::Irradiance => *value = shading.irradiance,
                ScalarChannel::Diffuse => *value = shading.diffuse,
                ScalarChannel::Specular => *value = shading.specular,
                ScalarChannel::Ambient => *value = shading.ambient,
                ScalarChannel::Light(light) => *value = by_light.irradiance(*light),
                ScalarChannel::Depth | ScalarChannel::AmbientError => unreachable!("it is no mean"),
            }
        }
        shading.brightness()
    }
}

/// Whether a pixel's value is the mean over its area. Of the others it is the value at its centre.
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
        | Quantity::AmbientError => false,
    }
}

impl Refinement {
    /// Sends as many rays through a pixel as its contrast takes.
    pub fn new(scene: &PreparedScene, wanted: &Wanted<'_>, pixel: Pixel, uncertain: &Uncertain) -> Self {
        let index = uncertain.index;
        let most = wanted.sampling.samples;
        let mut samples = pattern::enough(uncertain.contrast, wanted.tolerance, most).max(FIRST_SAMPLES.min(most));
        loop {
            let (refinement, contrast) = Self::of_samples(scene, wanted, pixel, index, samples);
            let enough = pattern::enough(contrast, wanted.tolerance, most);
            if enough <= samples {
                return refinement;
            }
            samples = enough;
        }
    }

    /// A mean over the pixel itself that no rays were sent for. Where its centre sees nothing, a hit belongs to it.
    pub fn integrated(index: usize, samples: u32, coverage: f64, hit: Option<Hit>, means: Vec<f64>) -> Self {
        let mut sums = means;
        sums.push(1.0);
        Self { index, samples, coverage, hit, sums }
    }

    /// With so many samples; and how much their brightness differs.
    fn of_samples(scene: &PreparedScene, wanted: &Wanted<'_>, pixel: Pixel, index: usize, samples: u32) -> (Self, f64) {
        let averages = wanted.averages;
        let channels = averages.channels.len();
        let mut sums = vec![0.0; wanted.offsets.len() * (channels + 1)];
        let mut values = vec![0.0; channels];
        let [mut least, mut greatest] = [f64::INFINITY, f64::NEG_INFINITY];
        let (mut covered, mut first_hit) = (0_u32, None);
        for &place in wanted.patterns.of(samples) {
            let position = ScreenPosition::InPixel { pixel, place };
            let hit = scene.trace(position);
            values.fill(0.0);
            let brightness = hit.map_or(0.0, |hit| averages.values(scene, &hit, position, &mut values));
            covered += u32::from(hit.is_some());
            first_hit = first_hit.or(hit);
            least = least.min(brightness);
            greatest = greatest.max(brightness);
            let [across, down] = place.map(|part| part - 0.5);
            for (sums, [columns, rows]) in sums.chunks_exact_mut(channels + 1).zip(wanted.offsets) {
                let weight = wanted.sampling.filter.weight(across - columns, down - rows);
                for (sum, value) in sums.iter_mut().zip(&values) {
                    *sum += weight * value;
                }
                sums[channels] += weight;
            }
        }
        let share = 1.0 / f64::from(samples);
        for sum in &mut sums {
            *sum *= share;
        }
        let coverage = f64::from(covered) * share;
        (Self { index, samples, coverage, hit: first_hit, sums }, greatest - least)
    }
}

/// The pixels that the filter reaches from one pixel: columns and rows away from it.
pub fn offsets(filter: Filter) -> Vec<[f64; 2]> {
    let reach = i32::try_from(filter.reach()).unwrap_or(0);
    let rows = (-reach..=reach).flat_map(|row| (-reach..=reach).map(move |column| [column, row]));
    rows.map(|offset| offset.map(f64::from)).collect()
}

/// Puts refined pixels into a map.
pub fn apply(map: &mut Map, averages: &Averages, filter: Filter, refined: &[Refinement]) -> Result<(), RenderError> {
    let mut shapes = map.mask.shapes();
    for refinement in refined {
        if shapes[refinement.index] < 0
            && let Some(hit) = &refinement.hit
        {
            shapes[refinement.index] = i32::try_from(hit.primitive.shape).unwrap_or(i32::MAX);
            put_geometry(map, refinement.index, hit);
        }
        put_exactly(map, &Quantity::Samples, refinement.index, refinement.samples.into());
        put_exactly(map, &Quantity::Coverage, refinement.index, refinement.coverage);
    }
    let values = if filter.reach() == 0 {
        let mean = |refinement: &Refinement| (refinement.index, normalized(&refinement.sums));
        refined.iter().map(mean).collect()
    } else {
        gathered(map, averages, filter, refined, &mut shapes)
    };
    for (index, values) in values {
        for (value, (channel, _)) in values.into_iter().zip(&averages.channels) {
            put(map, *channel, index, value)?;
        }
    }
    put_shapes(map, &shapes);
    // Where no surface is, there was none to sample.
    for index in refined.iter().map(|refinement| refinement.index).filter(|index| shapes[*index] < 0) {
        put_exactly(map, &Quantity::Samples, index, 0.0);
        put_exactly(map, &Quantity::Coverage, index, 0.0);
    }
    Ok(())
}

/// Weighted sums of values, over the sum of the weights, which comes last.
fn normalized(sums: &[f64]) -> Vec<f64> {
    let (weight, sums) = sums.split_last().expect("there is always a weight");
    sums.iter().map(|sum| sum / weight).collect()
}

/// The values of every pixel through a filter that reaches beyond it. A pixel that was not refined is as bright as its
/// centre all over.
fn gathered(
    map: &mut Map,
    averages: &Averages,
    filter: Filter,
    refined: &[Refinement],
    shapes: &mut [i32],
) -> Vec<(usize, Vec<f64>)> {
    let channels = averages.channels.len();
    let even: Vec<f64> = offsets(filter)
        .iter()
        .map(|[columns, rows]| {
            let places = points(64);
            let weight = |[x, y]: &[f64; 2]| filter.weight(x - 0.5 - columns, y - 0.5 - rows);
            places.iter().map(weight).sum::<f64>() / 64.0
        })
        .collect();
    let mut refinement_of = vec![None; shapes.len()];
    for refinement in refined {
        refinement_of[refinement.index] = Some(refinement);
    }
    let (width, height) = (map.region.size.width as usize, map.region.size.height as usize);
    let reach = filter.reach() as usize;
    let side = 2 * reach + 1;
    let seen = shapes.to_vec();
    let mut pixels = Vec::with_capacity(shapes.len());
    for index in 0..shapes.len() {
        let (row, column) = (index / width, index % width);
        let mut sums = vec![0.0; channels + 1];
        let mut source = None;
        for from_row in row.saturating_sub(reach)..(row + reach + 1).min(height) {
            for from_column in column.saturating_sub(reach)..(column + reach + 1).min(width) {
                let from = from_row * width + from_column;
                let offset = (row + reach - from_row) * side + (column + reach - from_column);
                if seen[from] >= 0 {
                    source = source.or(Some(from));
                }
                if let Some(refinement) = refinement_of[from] {
                    let part = &refinement.sums[offset * (channels + 1)..][..=channels];
                    sums.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
                } else {
                    for (sum, (channel, _)) in sums.iter_mut().zip(&averages.channels) {
                        let values = Scalars::of(&map.channels[*channel].values).expect("means are scalars");
                        *sum += even[offset] * values.at(from);
                    }
                    sums[channels] += even[offset];
                }
            }
        }
        let Some(source) = source else { continue };
        if seen[index] < 0 {
            shapes[index] = seen[source];
            copy_geometry(map, source, index);
        }
        pixels.push((index, normalized(&sums)));
    }
    pixels
}

/// Writes which shape each pixel sees.
pub fn put_shapes(map: &mut Map, shapes: &[i32]) {
    map.mask = Mask::of_shapes(map.region.size, shapes);
    for channel in &mut map.channels {
        if let Values::Index(values) = &mut channel.values {
            values.clear();
            values.extend_from_slice(shapes);
        }
    }
}

/// Writes a value into a scalar channel.
pub fn put(map: &mut Map, channel: usize, index: usize, value: f64) -> Result<(), RenderError> {
    match &mut map.channels[channel].values {
        Values::Scalar(values) => values[index] = value,
        Values::Single(values) => {
            #[expect(clippy::cast_possible_truncation, reason = "what does not fit is refused")]
            let single = value as f32;
            if !single.is_finite() {
                return Err(RenderError::Overflow { pixel: map.pixel(index), value });
            }
            values[index] = single;
        }
        Values::Vector(_) | Values::Index(_) => unreachable!("means are scalars"),
    }
    Ok(())
}

/// Writes a number that is small enough for any channel, if the map has that channel.
pub fn put_exactly(map: &mut Map, quantity: &Quantity, index: usize, value: f64) {
    let channel = map.channels.iter_mut().find(|channel| channel.quantity == *quantity);
    if let Some(Values::Scalar(values)) = channel.map(|channel| &mut channel.values) {
        values[index] = value;
    }
}

/// Writes where a hit is.
fn put_geometry(map: &mut Map, index: usize, hit: &Hit) {
    let length = map.window.length;
    for channel in &mut map.channels {
        match (&channel.quantity, &mut channel.values) {
            (Quantity::Depth, Values::Scalar(values)) => values[index] = length.from_metres(hit.distance),
            (Quantity::Normal, Values::Vector(values)) => values[index] = hit.point.normal.to_array(),
            (Quantity::Position, Values::Vector(values)) => {
                values[index] = hit.point.position().to_array().map(|coordinate| length.from_metres(coordinate));
            }
            _ => {}
        }
    }
}

/// Where the surface is that a filter reaches.
pub fn copy_geometry(map: &mut Map, from: usize, to: usize) {
    for channel in &mut map.channels {
        match (&channel.quantity, &mut channel.values) {
            (Quantity::Depth, Values::Scalar(values)) => values[to] = values[from],
            (Quantity::Normal | Quantity::Position, Values::Vector(values)) => values[to] = values[from],
            _ => {}
        }
    }
}
