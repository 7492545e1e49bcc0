//! A channel as a Zarr array: its description, and the encoding and decoding of its shards.

use std::num::NonZeroU64;
use std::sync::Arc;

use isophote::map::{Channel, Quantity, Region, Values};
use serde_json::{Map as JsonMap, Value, json};
use zarrs::array::codec::{Crc32cCodec, ShardingCodecOptions, SubchunkWriteOrder, ZstdCodec};
use zarrs::array::{Array, ArrayBuilder, ArrayBytes, ArrayCreateError, CodecOptions, CodecSpecificOptions, data_type};
use zarrs::array::{ArrayToBytesCodecTraits, DataType, FillValue};
use zarrs::storage::store::MemoryStore;

use crate::alone::alone;
use crate::error::StoreError;
use crate::json::object;
use crate::plan::{Plan, Shard};

/// The fastest level of zstd: on smooth maps higher levels save little and take long.
const LEVEL: i32 = 1;

/// What an array holds at each pixel, depending on the values of the map's channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NumberFormat {
    kind: Kind,
    /// Numbers per pixel.
    numbers: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Double,
    Single,
    Index,
}

impl NumberFormat {
    /// The only place that maps values to number formats.
    pub fn of(values: &Values) -> Self {
        match values {
            Values::Scalar(_) => Self { kind: Kind::Double, numbers: 1 },
            Values::Single(_) => Self { kind: Kind::Single, numbers: 1 },
            Values::Vector(_) => Self { kind: Kind::Double, numbers: 3 },
            Values::Index(_) => Self { kind: Kind::Index, numbers: 1 },
        }
    }

    /// The format in an array's description; none if this program would not write it that way.
    pub fn from_metadata(array: &Value) -> Option<Self> {
        let kind = match array["data_type"].as_str()? {
            "float64" => Kind::Double,
            "float32" => Kind::Single,
            "int32" => Kind::Index,
            _ => return None,
        };
        let numbers = match array["shape"].as_array()?.get(2) {
            None => 1,
            Some(numbers) => u32::try_from(numbers.as_u64()?).ok()?,
        };
        Some(Self { kind, numbers })
    }

    /// Bytes of one pixel.
    pub fn size(self) -> usize {
        let number = match self.kind {
            Kind::Double => 8,
            Kind::Single | Kind::Index => 4,
        };
        number * self.numbers as usize
    }

    fn data_type(self) -> DataType {
        match self.kind {
            Kind::Double => data_type::float64(),
            Kind::Single => data_type::float32(),
            Kind::Index => data_type::int32(),
        }
    }

    /// The value where no surface is seen.
    fn fill_value(self) -> FillValue {
        match self.kind {
            Kind::Double => 0.0_f64.into(),
            Kind::Single => 0.0_f32.into(),
            Kind::Index => (-1_i32).into(),
        }
    }

    /// The bytes of a whole shard of fill values.
    fn filled(self, pixels: usize) -> Vec<u8> {
        let byte = match self.kind {
            Kind::Double | Kind::Single => 0,
            Kind::Index => 0xff,
        };
        vec![byte; pixels * self.size()]
    }
}

/// The array of a channel.
pub struct ChannelArray {
    pub quantity: Quantity,
    array: Array<MemoryStore>,
    element: NumberFormat,
    plan: Plan,
    options: CodecOptions,
}

impl ChannelArray {
    /// The array called `name`.
    pub fn new(
        quantity: Quantity,
        name: &str,
        unit: &str,
        element: NumberFormat,
        plan: Plan,
    ) -> Result<Self, StoreError> {
        let (array, options) = alone(|| (array(&quantity, name, unit, element, plan), one_thread()));
        Ok(Self { array: array.map_err(encode_error(&quantity))?, quantity, element, plan, options })
    }

    /// The array's `zarr.json`.
    pub fn metadata(&self) -> Result<Value, StoreError> {
        serde_json::to_value(self.array.metadata()).map_err(encode_error(&self.quantity))
    }

    /// The name of a shard's file in the store.
    pub fn key(&self, shard: Shard) -> String {
        let mut indices = vec![u64::from(shard.row), u64::from(shard.column)];
        if self.element.numbers > 1 {
            indices.push(0);
        }
        self.array.chunk_key(&indices).to_string()
    }

    /// The bytes of a shard's file; none if the shard is all fill value, because then there is no file.
    pub fn encode(&self, channel: &Channel, region: Region) -> Result<Option<Vec<u8>>, StoreError> {
        let values: &[u8] = match &channel.values {
            Values::Scalar(values) => bytemuck::cast_slice(values),
            Values::Single(values) => bytemuck::cast_slice(values),
            Values::Vector(values) => bytemuck::cast_slice(values),
            Values::Index(indices) => bytemuck::cast_slice(indices),
        };
        let whole = self.whole_shard(values, region);
        let bytes = ArrayBytes::new_flen(whole.as_deref().unwrap_or(values));
        if bytes.is_fill_value(self.array.fill_value()) {
            return Ok(None);
        }
        let encoded = self.array.codecs().encode(
            bytes,
            &self.shard_shape()?,
            self.array.data_type(),
            self.array.fill_value(),
            &self.options,
        );
        encoded.map(|bytes| Some(bytes.into_owned())).map_err(encode_error(&self.quantity))
    }

    /// Decodes a shard and verifies the checksum of every chunk; returns what is wrong with it.
    pub fn check(&self, encoded: &[u8]) -> Result<(), String> {
        let shape = self.shard_shape().map_err(|error| error.to_string())?;
        let (data_type, fill_value) = (self.array.data_type(), self.array.fill_value());
        let decoded = self.array.codecs().decode(encoded.into(), &shape, data_type, fill_value, &self.options);
        decoded.map(drop).map_err(|error| error.to_string())
    }

    /// A shard at the edge of the image, padded with fill values; none if the region is already a whole shard.
    fn whole_shard(&self, values: &[u8], region: Region) -> Option<Vec<u8>> {
        let side = self.plan.shard_side.get() as usize;
        let [width, height] = [region.size.width, region.size.height].map(|side| side as usize);
        if (width, height) == (side, side) {
            return None;
        }
        let size = self.element.size();
        let mut whole = self.element.filled(side * side);
        for (row, values) in values.chunks_exact(width * size).enumerate() {
            whole[row * side * size..][..values.len()].copy_from_slice(values);
        }
        Some(whole)
    }

    fn shard_shape(&self) -> Result<Vec<NonZeroU64>, StoreError> {
        let side = u64::from(self.plan.shard_side.get());
        let sides = shape(self.element, [side, side]);
        sides.into_iter().map(|side| NonZeroU64::try_from(side).map_err(encode_error(&self.quantity))).collect()
    }
}

/// The array called `name` as described to Zarr. No chunks are stored in it: they go to their own files.
fn array(
    quantity: &Quantity,
    name: &str,
    unit: &str,
    element: NumberFormat,
    plan: Plan,
) -> Result<Array<MemoryStore>, ArrayCreateError> {
    let [shard, inner] = [plan.shard_side, plan.inner_side].map(|side| u64::from(side.get()));
    let mut builder = ArrayBuilder::new(
        shape(element, [plan.full.height.into(), plan.full.width.into()]),
        shape(element, [shard, shard]),
        element.data_type(),
        element.fill_value(),
    );
    builder
        .subchunk_shape(shape(element, [inner, inner]))
        .bytes_to_bytes_codecs(vec![Arc::new(ZstdCodec::new(LEVEL, false)), Arc::new(Crc32cCodec::new())])
        // Writing chunks in the order in which they finish would give different bytes on every run.
        .codec_specific_options(
            CodecSpecificOptions::default()
                .with_option(ShardingCodecOptions::default().with_subchunk_write_order(SubchunkWriteOrder::C)),
        )
        .dimension_names(Some(if element.numbers == 1 { vec!["y", "x"] } else { vec!["y", "x", "component"] }))
        .attributes(attributes(quantity, unit));
    builder.build(Arc::new(MemoryStore::new()), &format!("/{name}"))
}

/// The array of pixel centres along one side of the image, in a single chunk.
pub fn coordinate(name: &str, unit: &str, centres: &[f64]) -> Result<(Value, Vec<u8>), String> {
    alone(|| encoded_coordinate(name, unit, centres))
}

fn encoded_coordinate(name: &str, unit: &str, centres: &[f64]) -> Result<(Value, Vec<u8>), String> {
    let build = || -> Result<Array<MemoryStore>, ArrayCreateError> {
        let length = centres.len() as u64;
        let mut builder = ArrayBuilder::new(vec![length], vec![length], data_type::float64(), 0.0_f64);
        let long_name = format!("{name} of the pixel's centre on the screen");
        builder
            .bytes_to_bytes_codecs(vec![Arc::new(ZstdCodec::new(LEVEL, false)), Arc::new(Crc32cCodec::new())])
            .dimension_names(Some([name]))
            .attributes(object(json!({ "long_name": long_name, "units": unit })));
        builder.build(Arc::new(MemoryStore::new()), &format!("/{name}"))
    };
    let array = build().map_err(|error| error.to_string())?;
    let length = NonZeroU64::new(centres.len() as u64).ok_or("no pixels")?;
    let bytes = ArrayBytes::new_flen(bytemuck::cast_slice::<f64, u8>(centres));
    let encoded = array.codecs().encode(bytes, &[length], array.data_type(), array.fill_value(), &one_thread());
    let encoded = encoded.map_err(|error| error.to_string())?.into_owned();
    Ok((serde_json::to_value(array.metadata()).map_err(|error| error.to_string())?, encoded))
}

fn shape(element: NumberFormat, [rows, columns]: [u64; 2]) -> Vec<u64> {
    if element.numbers == 1 { vec![rows, columns] } else { vec![rows, columns, element.numbers.into()] }
}

fn attributes(quantity: &Quantity, unit: &str) -> JsonMap<String, Value> {
    let mut attributes = json!({ "long_name": quantity.name(), "units": unit });
    if matches!(quantity, Quantity::Position | Quantity::Normal | Quantity::CameraNormal) {
        attributes["components"] = json!(["x", "y", "z"]);
    }
    if *quantity == Quantity::Color {
        attributes["components"] = json!(["red", "green", "blue"]);
    }
    object(attributes)
}

/// Each worker has its own shard: more threads inside would only get in each other's way.
fn one_thread() -> CodecOptions {
    CodecOptions::default().with_concurrent_target(1)
}

fn encode_error<E: std::fmt::Display>(quantity: &Quantity) -> impl Fn(E) -> StoreError {
    let quantity = quantity.clone();
    move |reason| StoreError::Encode { quantity: quantity.clone(), reason: reason.to_string() }
}
