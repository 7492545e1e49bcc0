//! Many rays through the pixels that need them, and how the results change a map.

use super::FIRST_SAMPLES;
use super::pattern::{self, Patterns};
use super::tracer::{SAMPLES, SampleTracer};
use super::uncertain::Uncertain;
use crate::hammersley::points;
use crate::map::{Channel, Map, Mask, Pixel, Quantity, Run, Scalars, Values};
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
    /// The number of samples in the mean.
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

/// The side of the squares whose pixels share packets.
const SIDE: u32 = 8;

impl Refiner<'_> {
    /// Refines pixels; the order of the results is any.
    pub fn refine(
        &mut self,
        pixels: impl Iterator<Item = (Pixel, Uncertain)>,
        mut advance: impl FnMut() -> Result<(), RenderError>,
    ) -> Result<Vec<Refinement>, RenderError> {
        let most = self.wanted.sampling.samples;
        let open = |(pixel, uncertain): (Pixel, Uncertain)| {
            let samples = self.wanted.enough(&uncertain.contrasts).max(FIRST_SAMPLES.min(most));
            Open { pixel, uncertain, samples }
        };
        let mut open: Vec<Open> = pixels.map(open).collect();
        let mut refined = Vec::with_capacity(open.len());
        while !open.is_empty() {
            // Rays of a packet should pass close to each other. Which ones they are does not matter to the results.
            let square = |pixel: Pixel| (pixel.row / SIDE, pixel.column / SIDE);
            let class = |open: &Open| (open.samples, square(open.pixel));
            open.sort_by_key(|open| (class(open), open.uncertain.index));
            let mut next = Vec::new();
            for group in open.chunk_by(|one, other| class(one) == class(other)) {
                let together = (SAMPLES / group[0].samples as usize).max(1);
                for some in group.chunks(together) {
                    self.add(some, &mut refined, &mut next, &mut advance)?;
                }
            }
            open = next;
        }
        Ok(refined)
    }

    /// Traces the samples of pixels that need equally many of them, and finds out which of them need more.
    fn add(
        &mut self,
        pixels: &[Open],
        refined: &mut Vec<Refinement>,
        next: &mut Vec<Open>,
        advance: &mut impl FnMut() -> Result<(), RenderError>,
    ) -> Result<(), RenderError> {
        let wanted = self.wanted;
        let samples = pixels[0].samples;
        let mut means: Vec<PixelMeans> = pixels.iter().map(|_| PixelMeans::new(wanted)).collect();
        for places in wanted.patterns.of(samples).chunks(SAMPLES) {
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
            let contrasts: Vec<f64> = means.layers.iter().map(LayerMeans::contrast).collect();
            let enough = wanted.enough(&contrasts);
            if enough > samples {
                next.push(Open { uncertain: open.uncertain.clone(), samples: enough, ..*open });
                continue;
            }
            let error_bounds = contrasts.iter().map(|contrast| pattern::error_bound(*contrast, samples)).collect();
            refined.push(means.finish(&open.uncertain, samples, error_bounds));
        }
        Ok(())
    }
}

impl Wanted<'_> {
    /// How many samples are enough where brightness differs by this much in each layer.
    fn enough(&self, contrasts: &[f64]) -> u32 {
        let of_layer =
            |(contrast, tolerance): (&f64, &f64)| pattern::enough(*contrast, *tolerance, self.sampling.samples);
        contrasts.iter().zip(self.tolerances).map(of_layer).max().unwrap_or(1)
    }
}

/// The sums over the samples of a pixel.
struct PixelMeans<'w> {
    layers: Vec<LayerMeans<'w>>,
    covered: u32,
    first_hit: Option<Hit>,
}

impl<'w> PixelMeans<'w> {
    fn new(wanted: &Wanted<'w>) -> Self {
        let layers = wanted.averages.iter().map(|of| LayerMeans::new(of, wanted.offsets)).collect();
        Self { layers, covered: 0, first_hit: None }
    }

    /// Adds samples that have been traced, given by the number of the first one and their positions in the pixel.
    fn add(&mut self, tracer: &SampleTracer<'_>, first: usize, places: &[[f64; 2]], wanted: &Wanted<'_>) {
        for hit in (first..first + places.len()).filter_map(|sample| tracer.hit(sample)) {
            self.covered += 1;
            if self.first_hit.is_none() {
                self.first_hit = Some(*hit);
            }
        }
        for (layer, means) in self.layers.iter_mut().enumerate() {
            let (shaded, at) = tracer.values(layer);
            let seen = places.iter().zip(first..);
            let seen = seen.map(|(place, sample)| (*place, tracer.hit(sample).map(|_| at(sample))));
            means.add(seen, shaded, wanted.sampling.filter, wanted.offsets);
        }
    }

    fn finish(self, uncertain: &Uncertain, samples: u32, error_bounds: Vec<f64>) -> Refinement {
        let share = 1.0 / f64::from(samples);
        let Uncertain { index, sees, .. } = *uncertain;
        Refinement {
            index,
            sees,
            samples,
            coverage: f64::from(self.covered) * share,
            error_bounds,
            seen: self.first_hit.map(|hit| hit.primitive.shape),
            hit: self.first_hit.filter(|_| !sees).map(Box::new),
            sums: self.layers.into_iter().map(|means| means.finish(share)).collect(),
        }
    }
}

/// The sums over the samples of a pixel in a layer.
struct LayerMeans<'w> {
    channels: &'w [(usize, ScalarChannel)],
    sums: Vec<f64>,
    least: f64,
    greatest: f64,
}

impl<'w> LayerMeans<'w> {
    fn new(averages: &'w Averages, offsets: &[[f64; 2]]) -> Self {
        let channels = &averages.channels;
        let sums = vec![0.0; offsets.len() * (channels.len() + 1)];
        Self { channels, sums, least: f64::INFINITY, greatest: f64::NEG_INFINITY }
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

/// Writes refined pixels, given in reading order, into the map of a layer.
pub fn apply(
    (layer, map): (usize, &mut Map),
    averages: &Averages,
    filter: Filter,
    refined: &[Refinement],
) -> Result<(), RenderError> {
    if filter.reach() > 0 {
        return spread((layer, map), averages, filter, refined);
    }
    let found = find_shapes(map, refined);
    for refinement in refined {
        put_counts((layer, map), refinement, refinement.sees || refinement.seen.is_some());
        for (value, (channel, _)) in normalized(&refinement.sums[layer]).zip(&averages.channels) {
            put(map, *channel, refinement.index, value)?;
        }
    }
    for channel in &mut map.channels {
        if let Values::Index(values) = &mut channel.values {
            for run in &found {
                values[run.start] = i32::try_from(run.shape).unwrap_or(i32::MAX);
            }
        }
    }
    map.mask = map.mask.with(&found);
    Ok(())
}

/// Where the centre saw nothing, finds what the pixel sees, and writes that into the map's geometry too.
fn find_shapes(map: &mut Map, refined: &[Refinement]) -> Vec<Run> {
    let mut found = Vec::new();
    for refinement in refined.iter().filter(|refinement| !refinement.sees) {
        let index = refinement.index;
        if let Some(shape) = refinement.seen {
            found.push(Run { start: index, end: index + 1, shape: u32::try_from(shape).unwrap_or(u32::MAX) });
        }
        if let Some(hit) = &refinement.hit {
            put_geometry(map, index, hit);
        }
    }
    found
}

/// Writes the number of samples in a pixel, the fraction of it that shows a surface, and how far its mean may be off. Where
/// there is no surface, all are 0.
fn put_counts((layer, map): (usize, &mut Map), refinement: &Refinement, is_seen: bool) {
    let Refinement { index, samples, coverage, .. } = *refinement;
    let counts = [samples.into(), coverage, refinement.error_bounds[layer]];
    let [samples, coverage, error_bound] = if is_seen { counts } else { [0.0; 3] };
    put_exactly(map, &Quantity::SamplingError, index, error_bound);
    put_exactly(map, &Quantity::Samples, index, samples);
    put_exactly(map, &Quantity::Coverage, index, coverage);
}

/// Writes them through a filter that spreads light over more than a pixel.
fn spread(
    (layer, map): (usize, &mut Map),
    averages: &Averages,
    filter: Filter,
    refined: &[Refinement],
) -> Result<(), RenderError> {
    let found = find_shapes(map, refined);
    let mut shapes = map.mask.with(&found).shapes();
    for (index, values) in gathered((layer, &mut *map), averages, filter, refined, &mut shapes) {
        for (value, (channel, _)) in values.into_iter().zip(&averages.channels) {
            put(map, *channel, index, value)?;
        }
    }
    put_shapes(map, &shapes);
    for refinement in refined {
        put_counts((layer, map), refinement, shapes[refinement.index] >= 0);
    }
    Ok(())
}

/// Weighted sums of values, divided by the sum of the weights, which comes last.
fn normalized(sums: &[f64]) -> impl Iterator<Item = f64> {
    let (weight, sums) = sums.split_last().expect("there is always a weight");
    sums.iter().map(move |sum| sum / weight)
}

/// The values of every pixel through a filter that extends beyond it. A pixel that was not refined is taken to be as bright
/// all over as at its centre.
fn gathered(
    (layer, map): (usize, &mut Map),
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
                    let part = &refinement.sums[layer][offset * (channels + 1)..][..=channels];
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
        pixels.push((index, normalized(&sums).collect()));
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

/// Writes a number that any channel can hold, if the map has that channel.
pub fn put_exactly(map: &mut Map, quantity: &Quantity, index: usize, value: f64) {
    let channel = map.channels.iter_mut().find(|channel| channel.quantity == *quantity);
    if let Some(Values::Scalar(values)) = channel.map(|channel| &mut channel.values) {
        values[index] = value;
    }
}

/// Writes the geometry of a hit.
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

/// Copies the geometry of a surface that a filter reaches.
pub fn copy_geometry(map: &mut Map, from: usize, to: usize) {
    for channel in &mut map.channels {
        match (&channel.quantity, &mut channel.values) {
            (Quantity::Depth, Values::Scalar(values)) => values[to] = values[from],
            (Quantity::Normal | Quantity::Position, Values::Vector(values)) => values[to] = values[from],
            _ => {}
        }
    }
}
