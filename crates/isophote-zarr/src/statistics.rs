//! Statistics of a map that is never in memory as a whole: computed per shard, then combined.

use isophote::analysis::statistics::{Counts, Extreme, Statistics, Totals, counts, totals};
use isophote::map::{Map, Pixel, Quantity};
use isophote::sum::Sum;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// The statistics of one shard.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ShardStatistics {
    visible: u64,
    lit: u64,
    /// One per channel; none if no surface is seen or the channel is not a scalar.
    channels: Vec<Option<ShardChannel>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct ShardChannel {
    max: Place,
    min: Place,
    sum: f64,
}

/// A value and the pixel it is at.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Place {
    value: f64,
    row: u32,
    column: u32,
}

/// The statistics of a whole map.
#[derive(Clone, Debug, PartialEq)]
pub struct MapStatistics {
    /// Pixels in the image.
    pub pixels: u64,
    /// Pixels that see a surface.
    pub visible: u64,
    /// Visible pixels that receive any light.
    pub lit: u64,
    /// Every channel of the store.
    pub channels: Vec<ChannelStatistics>,
}

/// The statistics of a channel.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelStatistics {
    /// The channel.
    pub quantity: Quantity,
    /// None if no surface is seen or the channel is not a scalar.
    pub statistics: Option<Statistics>,
}

impl ShardStatistics {
    /// The statistics of these channels, and of the irradiance, which shows which pixels are lit.
    pub fn of(map: &Map, quantities: &[Quantity]) -> Self {
        let Counts { visible, lit, .. } = counts(map);
        let channel = |quantity: &Quantity| totals(map, quantity).map(ShardChannel::from);
        Self {
            visible: visible as u64,
            lit: lit.unwrap_or(0) as u64,
            channels: quantities.iter().map(channel).collect(),
        }
    }
}

impl From<Totals> for ShardChannel {
    fn from(Totals { max, min, sum }: Totals) -> Self {
        let place = |Extreme { value, pixel: Pixel { column, row } }| Place { value, row, column };
        Self { max: place(max), min: place(min), sum }
    }
}

impl MapStatistics {
    /// The statistics of a map from those of its shards, which must come in the plan's order, whenever each was
    /// computed.
    pub(crate) fn new(pixels: u64, quantities: &[Quantity], shards: &[ShardStatistics]) -> Self {
        let visible = shards.iter().map(|shard| shard.visible).sum();
        let channels = quantities.iter().enumerate().map(|(index, quantity)| {
            let parts = shards.iter().filter_map(move |shard| shard.channels.get(index).copied().flatten());
            ChannelStatistics { quantity: quantity.clone(), statistics: combined(parts, visible) }
        });
        Self { pixels, visible, lit: shards.iter().map(|shard| shard.lit).sum(), channels: channels.collect() }
    }

    /// The form in which the store's attributes hold them.
    pub(crate) fn to_json(&self) -> Value {
        let extreme = |extreme: &Extreme| json!({ "value": extreme.value, "pixel": extreme.pixel });
        let channels = self.channels.iter().filter_map(|channel| {
            let Statistics { max, min, mean } = channel.statistics.as_ref()?;
            Some((channel.quantity.name(), json!({ "max": extreme(max), "min": extreme(min), "mean": mean })))
        });
        json!({
            "pixels": self.pixels,
            "visible_pixels": self.visible,
            "lit_pixels": self.lit,
            "channels": channels.collect::<serde_json::Map<_, _>>(),
        })
    }
}

fn combined(parts: impl Iterator<Item = ShardChannel>, visible: u64) -> Option<Statistics> {
    let mut parts = parts.peekable();
    let ShardChannel { mut max, mut min, .. } = *parts.peek()?;
    let mut sum = Sum::new();
    for part in parts {
        // Among equal values, take the first in reading order, which is not the order of the plan.
        let is_earlier = |part: &Place, known: &Place| {
            part.value == known.value && (part.row, part.column) < (known.row, known.column)
        };
        if part.max.value > max.value || is_earlier(&part.max, &max) {
            max = part.max;
        }
        if part.min.value < min.value || is_earlier(&part.min, &min) {
            min = part.min;
        }
        sum.add(part.sum);
    }
    let extreme = |place: Place| Extreme { value: place.value, pixel: Pixel { column: place.column, row: place.row } };
    #[expect(clippy::cast_precision_loss, reason = "an image has fewer than 2^53 pixels")]
    let mean = sum.value() / visible as f64;
    Some(Statistics { max: extreme(max), min: extreme(min), mean })
}
