//! How refined pixels change a map.

use super::refine::{Averages, Refinement, offsets};
use crate::hammersley::points;
use crate::map::{Map, Mask, Quantity, Run, Scalars, Values};
use crate::prepare::Hit;
use crate::render::RenderError;
use crate::scene::Filter;

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
        for (value, (channel, _)) in normalized(&refinement.sums[layer]).zip(averages.channels()) {
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

/// Writes the number of samples in a pixel and the fraction of it that shows a surface, which are 0 where there is none, and how
/// far its mean may be off.
fn put_counts((layer, map): (usize, &mut Map), refinement: &Refinement, is_seen: bool) {
    let Refinement { index, samples, coverage, .. } = *refinement;
    let [samples, coverage] = if is_seen { [samples.into(), coverage] } else { [0.0; 2] };
    put_exactly(map, &Quantity::SamplingError, index, refinement.error_bounds[layer]);
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
        for (value, (channel, _)) in values.into_iter().zip(averages.channels()) {
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
    let channels = averages.channels().len();
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
                    for (sum, (channel, _)) in sums.iter_mut().zip(averages.channels()) {
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
