//! A channel as a Zarr array: its description and its shards.

use std::num::NonZeroU32;

use isophote::map::{Channel, Quantity, Region, Values};
use serde::Serialize;
use serde_json::{Value, json};

use crate::error::StoreError;
use crate::plan::{Plan, Shard};
use crate::shard::{self, Layout};

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

    fn data_type(self) -> &'static str {
        match self.kind {
            Kind::Double => "float64",
            Kind::Single => "float32",
            Kind::Index => "int32",
        }
    }

    /// The value where no surface is seen.
    fn fill_value(self) -> Value {
        match self.kind {
            Kind::Double | Kind::Single => json!(0.0),
            Kind::Index => json!(-1),
        }
    }

    /// The byte of which the fill value consists.
    fn fill_byte(self) -> u8 {
        match self.kind {
            Kind::Double | Kind::Single => 0,
            Kind::Index => 0xff,
        }
    }
}

/// The array of a channel.
pub struct ChannelArray {
    pub quantity: Quantity,
    name: String,
    unit: String,
    element: NumberFormat,
    plan: Plan,
}

impl ChannelArray {
    /// The array called `name`.
    pub fn new(quantity: Quantity, name: &str, unit: &str, element: NumberFormat, plan: Plan) -> Self {
        Self { quantity, name: name.into(), unit: unit.into(), element, plan }
    }

    /// The array's `zarr.json`.
    pub fn metadata(&self) -> Value {
        let Plan { full, shard_side, inner_side } = self.plan;
        let shape = |rows, columns| match self.element.numbers {
            1 => vec![rows, columns],
            numbers => vec![rows, columns, numbers],
        };
        let square = |side: NonZeroU32| shape(side.get(), side.get());
        description(
            self.element,
            &shape(full.height, full.width),
            &square(shard_side),
            &shard::shard_codecs(&square(inner_side)),
            &attributes(&self.quantity, &self.unit),
            if self.element.numbers == 1 { &["y", "x"] } else { &["y", "x", "component"] },
        )
    }

    /// The name of a shard's file in the store.
    pub fn key(&self, Shard { row, column }: Shard) -> String {
        let component = if self.element.numbers == 1 { "" } else { "/0" };
        format!("{}/c/{row}/{column}{component}", self.name)
    }

    /// The bytes of a shard's file; none if the shard is all fill value, because then there is no file.
    pub fn encode(&self, channel: &Channel, region: Region) -> Result<Option<Vec<u8>>, StoreError> {
        let encoded = match &channel.values {
            Values::Scalar(values) => self.encode_numbers(values, f64::to_le_bytes, region),
            Values::Single(values) => self.encode_numbers(values, f32::to_le_bytes, region),
            Values::Vector(values) => self.encode_numbers(values.as_flattened(), f64::to_le_bytes, region),
            Values::Index(indices) => self.encode_numbers(indices, i32::to_le_bytes, region),
        };
        encoded.map_err(|reason| StoreError::Encode { quantity: self.quantity.clone(), reason })
    }

    /// A shard of the numbers of a region, and of fill values where it extends past the edge of the image.
    fn encode_numbers<N: Copy, const SIZE: usize>(
        &self,
        numbers: &[N],
        to_bytes: impl Fn(N) -> [u8; SIZE],
        region: Region,
    ) -> Result<Option<Vec<u8>>, String> {
        let layout = self.layout();
        let [inner, width] = [self.plan.inner_side.get(), region.size.width].map(|side| side as usize);
        let [chunk_row, image_row] = [inner, width].map(|pixels| pixels * self.element.numbers as usize);
        shard::encode_shard(layout, |[row, column], chunk| {
            let [start, end] = [column, column + 1].map(|column| (column * chunk_row).min(image_row));
            let mut rows = numbers.chunks_exact(image_row).skip(row * inner);
            for bytes in chunk.chunks_exact_mut(chunk_row * SIZE) {
                let numbers = rows.next().map_or(&[][..], |numbers| &numbers[start..end]);
                let (inside, outside) = bytes.split_at_mut(numbers.len() * SIZE);
                for (bytes, number) in inside.as_chunks_mut().0.iter_mut().zip(numbers) {
                    *bytes = to_bytes(*number);
                }
                outside.fill(layout.fill);
            }
        })
    }

    /// Decodes a shard and verifies the checksum of every chunk; returns what is wrong with it.
    pub fn check(&self, encoded: &[u8]) -> Result<(), String> {
        shard::decode_shard(self.layout(), encoded, |_, _| {})
    }

    /// Saturates where a damaged plan asks for the impossible; to decode such a shard then fails.
    fn layout(&self) -> Layout {
        let [shard, inner] = [self.plan.shard_side, self.plan.inner_side].map(|side| side.get() as usize);
        let chunk = inner.saturating_mul(inner).saturating_mul(self.element.size());
        Layout { side: shard / inner, chunk, fill: self.element.fill_byte() }
    }
}

/// The array of pixel centres along one side of the image, in a single chunk.
pub fn coordinate(name: &str, unit: &str, centres: &[f64]) -> Result<(Value, Vec<u8>), String> {
    let long_name = format!("{name} of the pixel's centre on the screen");
    let description = description(
        NumberFormat { kind: Kind::Double, numbers: 1 },
        &[centres.len()],
        &[centres.len()],
        &shard::chunk_codecs(),
        &json!({ "long_name": long_name, "units": unit }),
        &[name],
    );
    let bytes: Vec<u8> = centres.iter().flat_map(|centre| centre.to_le_bytes()).collect();
    Ok((description, shard::encode_chunk(&bytes)?))
}

/// The `zarr.json` of an array. A store can be continued only if every byte of it is the same.
fn description<N: Serialize>(
    element: NumberFormat,
    shape: &[N],
    chunk_shape: &[N],
    codecs: &Value,
    attributes: &Value,
    dimensions: &[&str],
) -> Value {
    json!({
        "zarr_format": 3,
        "node_type": "array",
        "shape": shape,
        "data_type": element.data_type(),
        "chunk_grid": { "name": "regular", "configuration": { "chunk_shape": chunk_shape } },
        "chunk_key_encoding": { "name": "default", "configuration": { "separator": "/" } },
        "fill_value": element.fill_value(),
        "codecs": codecs,
        "attributes": attributes,
        "dimension_names": dimensions,
    })
}

fn attributes(quantity: &Quantity, unit: &str) -> Value {
    let mut attributes = json!({ "long_name": quantity.name(), "units": unit });
    if matches!(quantity, Quantity::Position | Quantity::Normal | Quantity::CameraNormal) {
        attributes["components"] = json!(["x", "y", "z"]);
    }
    if *quantity == Quantity::Color {
        attributes["components"] = json!(["red", "green", "blue"]);
    }
    attributes
}

#[cfg(test)]
mod tests {
    use isophote::map::{Pixel, Resolution};

    use super::*;

    /// An array in one shard with four chunks.
    fn array(format: NumberFormat, inner: u32, width: u32, height: u32) -> (ChannelArray, Region) {
        let side = |side| NonZeroU32::new(side).unwrap();
        let plan = Plan { full: Resolution { width, height }, shard_side: side(2 * inner), inner_side: side(inner) };
        let region = Region { corner: Pixel { column: 0, row: 0 }, size: plan.full };
        (ChannelArray::new(Quantity::Shape, "shape", "", format, plan), region)
    }

    /// The files were written by the library zarrs, version 0.23, which stores were once made with.
    #[test]
    fn the_files_are_those_of_earlier_versions() {
        // One value per chunk of 4 × 4, and 0 in the second chunk.
        let values = |place: u32| [[0.1, 0.0], [0.1, 0.2]][place as usize / 32][place as usize % 8 / 4];
        let singles = |place: u32| [[0.1, 0.0], [0.1, 0.2_f32]][place as usize / 32][place as usize % 8 / 4];
        let cases = [
            (
                Values::Index(vec![0, 1, -1, 2, -1, -1, -1, -1, 7]),
                (2, 3, 3),
                "28b52ffd2010810000000000000100000002000000ffffffffb2105db328b52ffd20105d00002807000000ff010006d0\
                 02415a187d00000000000000001d00000000000000ffffffffffffffffffffffffffffffffffffffffffffffffffffff\
                 ffffffffff1d0000000000000018000000000000007af08a0f",
            ),
            (
                Values::Scalar((0..64).map(values).collect()),
                (4, 8, 8),
                "28b52ffd20807d0000409a9999999999b93f01007569e1028da5138028b52ffd20807d0000409a9999999999b93f0100\
                 7569e1028da5138028b52ffd20807d0000409a9999999999c93f01007569e1029202651300000000000000001c000000\
                 00000000ffffffffffffffffffffffffffffffff1c000000000000001c0000000000000038000000000000001c000000\
                 00000000556a8880",
            ),
            (
                Values::Single((0..64).map(singles).collect()),
                (4, 8, 8),
                "28b52ffd204055000020cdcccc3d0100597244e9b5eb8c28b52ffd204055000020cdcccc3d0100597244e9b5eb8c28b5\
                 2ffd204055000020cdcc4c3e0100597244c770394d00000000000000001700000000000000ffffffffffffffffffffff\
                 ffffffffff170000000000000017000000000000002e000000000000001700000000000000902ddbcf",
            ),
            (
                Values::Vector(vec![[0.0; 3], [0.0, -0.0, 1.0]]),
                (1, 2, 1),
                "28b52ffd20188d000058000080000000000000f03f010007c002fd10e574ffffffffffffffffffffffffffffffff0000\
                 0000000000001e00000000000000ffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffe79c\
                 1d18",
            ),
        ];
        for (values, (inner, width, height), expected) in cases {
            let (array, region) = array(NumberFormat::of(&values), inner, width, height);
            let channel = Channel { quantity: Quantity::Shape, unit: String::new(), values };
            let file = array.encode(&channel, region).unwrap().unwrap();
            assert_eq!(hexadecimal(&file), expected, "{:?}", channel.values);
            assert_eq!(array.check(&file), Ok(()));
        }
        let (_, file) = coordinate("x", "m", &[-1.0, -0.5, 0.0, 0.5]).unwrap();
        assert_eq!(hexadecimal(&file), "28b52ffd2020b5000060000000000000f0bf00e0e03f030080c04ade161c0159f23391");
    }

    /// As in the test above.
    #[test]
    fn the_descriptions_are_those_of_earlier_versions() {
        let (array, _) = array(NumberFormat { kind: Kind::Index, numbers: 1 }, 2, 3, 3);
        let expected = r#"{
            "zarr_format": 3,
            "node_type": "array",
            "shape": [3, 3],
            "data_type": "int32",
            "chunk_grid": { "name": "regular", "configuration": { "chunk_shape": [4, 4] } },
            "chunk_key_encoding": { "name": "default", "configuration": { "separator": "/" } },
            "fill_value": -1,
            "codecs": [{
                "name": "sharding_indexed",
                "configuration": {
                    "chunk_shape": [2, 2],
                    "codecs": [
                        { "name": "bytes", "configuration": { "endian": "little" } },
                        { "name": "zstd", "configuration": { "level": 1, "checksum": false } },
                        { "name": "crc32c" }
                    ],
                    "index_codecs": [
                        { "name": "bytes", "configuration": { "endian": "little" } },
                        { "name": "crc32c" }
                    ],
                    "index_location": "end"
                }
            }],
            "attributes": { "long_name": "shape", "units": "" },
            "dimension_names": ["y", "x"]
        }"#;
        assert_eq!(array.metadata().to_string(), on_one_line(expected));
        let (description, _) = coordinate("x", "m", &[-1.0, -0.5, 0.0, 0.5]).unwrap();
        let expected = r#"{
            "zarr_format": 3,
            "node_type": "array",
            "shape": [4],
            "data_type": "float64",
            "chunk_grid": { "name": "regular", "configuration": { "chunk_shape": [4] } },
            "chunk_key_encoding": { "name": "default", "configuration": { "separator": "/" } },
            "fill_value": 0.0,
            "codecs": [
                { "name": "bytes", "configuration": { "endian": "little" } },
                { "name": "zstd", "configuration": { "level": 1, "checksum": false } },
                { "name": "crc32c" }
            ],
            "attributes": { "long_name": "x of the pixel's centre on the screen", "units": "m" },
            "dimension_names": ["x"]
        }"#;
        assert_eq!(description.to_string(), on_one_line(expected));
    }

    /// JSON with the same keys in the same order.
    fn on_one_line(json: &str) -> String {
        serde_json::from_str::<Value>(json).unwrap().to_string()
    }

    #[test]
    fn a_shard_of_fill_values_has_no_file() {
        let (array, region) = array(NumberFormat { kind: Kind::Double, numbers: 1 }, 2, 3, 3);
        let file = |value| {
            let channel =
                Channel { quantity: Quantity::Shape, unit: String::new(), values: Values::Scalar(vec![value; 9]) };
            array.encode(&channel, region).unwrap()
        };
        assert_eq!(file(0.0), None);
        assert!(file(-0.0).is_some(), "its bytes are those of another number");
    }

    fn hexadecimal(bytes: &[u8]) -> String {
        bytes.iter().map(|byte| format!("{byte:02x}")).collect::<Vec<_>>().concat()
    }
}
