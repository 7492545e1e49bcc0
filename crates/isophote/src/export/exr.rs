//! All channels in 32-bit floating point, for programs that show and combine layers of light.
//!
//! | channel of the map | in the file |
//! |---|---|
//! | brightness | `Y`, in a scene with colours the luminance of `R`, `G`, `B` |
//! | color | `R`, `G`, `B` |
//! | irradiance, diffuse, specular | `irradiance.Y`, `diffuse.Y`, `specular.Y` |
//! | depth (along the ray) | `Z` |
//! | position, normal | `P.X` `P.Y` `P.Z`, `N.X` `N.Y` `N.Z` |
//! | shape | `shape.index`, −1 where none is seen |
//! | irradiance from one light | `light.<name>.Y`, all but letters, digits, `-` and `_` replaced by `_` |
//!
//! The standard attribute `chromaticities` tells the space of a scene with colours. The data window is the map's region, the
//! display window the full image.

mod blocks;

use std::io::{BufRead, Read, Seek, SeekFrom, Write};

use exr::{
    meta::{
        BlockDescription,
        attribute::{ChannelDescription, Chromaticities, SampleType},
        header::Header,
    },
    prelude::{AttributeValue, Compression, ImageAttributes, IntegerBounds, LayerAttributes, LineOrder, Text, Vec2},
};

use self::blocks::Plane;
use super::{
    ExportError, FileMetadata, Format, names,
    read::{LONGEST_JSON, read_exactly},
};
use crate::color::{Chromaticity, ColorSpace, Rgb};
use crate::map::{Channel, Map, Quantity, Region};
use crate::units::Keyword;

/// Writes one part with all channels of the map, without loss beyond the rounding to 32 bits (relative 6e-8; values
/// below 1.2e-38 lose digits and below 7e-46 become 0).
///
/// Attributes: `isophote` (the metadata's JSON), `units` (a line per channel), `comments`, `software`; all UTF-8.
///
/// # Errors
/// A value or index that 32 bits cannot hold; an image beyond the format's coordinates; an error of `out`.
pub fn write(map: &Map, out: &mut (impl Write + Seek)) -> Result<(), ExportError> {
    check_extent(map)?;
    let names = channel_names(map);
    let planes = planes(map, &names)?;
    let size = map.region.size;
    let channels = planes.iter().map(|plane| ChannelDescription::named(text(plane.name), SampleType::F32)).collect();
    let header = Header::new(text(""), (size.width as usize, size.height as usize), channels)
        .with_encoding(Compression::ZIP16, BlockDescription::ScanLines, LineOrder::Increasing)
        .with_attributes(layer_attributes(map, &names))
        .with_shared_attributes(image_attributes(map, &names));
    let headers = std::iter::once(header).collect();
    exr::block::write(out, headers, true, |_, chunks| blocks::write(map, &planes, chunks)).map_err(from_exr)
}

/// All channels of the file, in the order that the format asks for; refuses what 32 bits cannot hold.
fn planes<'m>(map: &'m Map, names: &'m [Vec<String>]) -> Result<Vec<Plane<'m>>, ExportError> {
    let mut planes = Vec::new();
    for (channel, names) in map.channels().iter().zip(names) {
        for (component, name) in names.iter().enumerate() {
            let plane = Plane::new(name, &channel.values, component);
            if let Some((index, value)) = plane.overflow(map.mask()) {
                return Err(ExportError::Overflow { name: channel.quantity.name(), value, pixel: map.pixel(index) });
            }
            planes.push(plane);
        }
    }
    planes.sort_unstable_by_key(|plane| plane.name);
    Ok(planes)
}

/// The name of each channel in the file, three for vectors; see the module's table.
fn channel_names(map: &Map) -> Vec<Vec<String>> {
    let plain = |character: char| character.is_alphanumeric() || "-_".contains(character);
    let names = names::unique(map.channels(), plain);
    let axes = |layer: &str| ["X", "Y", "Z"].map(|axis| format!("{layer}.{axis}")).to_vec();
    let in_file = |(channel, name): (&Channel, String)| match channel.quantity {
        Quantity::Brightness => vec!["Y".into()],
        Quantity::Color => ["R", "G", "B"].map(String::from).to_vec(),
        Quantity::Depth => vec!["Z".into()],
        Quantity::Position => axes("P"),
        Quantity::Normal => axes("N"),
        Quantity::Shape => vec!["shape.index".into()],
        Quantity::Irradiance
        | Quantity::Ambient
        | Quantity::AmbientError
        | Quantity::Diffuse
        | Quantity::Specular
        | Quantity::Light(_) => {
            vec![format!("{name}.Y")]
        }
        Quantity::Samples | Quantity::Coverage => vec![format!("{name}.V")],
    };
    map.channels().iter().zip(names).map(in_file).collect()
}

/// The format's coordinates are signed, and half of their range is what programs agree on.
fn check_extent(map: &Map) -> Result<(), ExportError> {
    let Region { corner, size } = map.region;
    let ends = [corner.column.saturating_add(size.width), corner.row.saturating_add(size.height)];
    match [map.full.width, map.full.height].into_iter().chain(ends).find(|end| *end > LARGEST_COORDINATE) {
        None => Ok(()),
        Some(end) => Err(ExportError::Unsuitable {
            format: Format::Exr,
            reason: format!("the image reaches to {end}, its coordinates to {LARGEST_COORDINATE}"),
        }),
    }
}

const LARGEST_COORDINATE: u32 = (1 << 30) - 2;

/// At most one attribute goes into each `other`: the encoder writes these in the random order of a hash map, and two
/// would make the same map give different bytes.
fn layer_attributes(map: &Map, names: &[Vec<String>]) -> LayerAttributes {
    let mut attributes = LayerAttributes::default();
    let corner = map.region.corner;
    attributes.layer_position = Vec2(corner.column.cast_signed(), corner.row.cast_signed());
    attributes.software_name = Some(text(&map.provenance.program));
    let space = map.provenance.color_space.as_ref().map_or(String::new(), |space| format!(", {space}"));
    attributes.comments = Some(text(&format!("{}: {}{space}", map.provenance.title, map.provenance.convention)));
    let json = FileMetadata::of_stored(map, names.to_vec()).to_json();
    attributes.other.insert(text("isophote"), AttributeValue::Text(text(&json)));
    attributes
}

fn image_attributes(map: &Map, names: &[Vec<String>]) -> ImageAttributes {
    let full = IntegerBounds::from_dimensions((map.full.width as usize, map.full.height as usize));
    let mut attributes = ImageAttributes::new(full);
    attributes.chromaticities =
        map.provenance.color_space.as_deref().and_then(ColorSpace::from_name).map(chromaticities);
    let line = |(channel, names): (&Channel, &Vec<String>)| {
        let unit = match channel.unit.as_str() {
            "" => "index",
            unit => unit,
        };
        format!("{}: {}, {unit}", names.join(" "), super::one_line(&channel.quantity.name()))
    };
    let units: Vec<_> = map.channels().iter().zip(names).map(line).collect();
    attributes.other.insert(text("units"), AttributeValue::Text(text(&units.join("\n"))));
    attributes
}

/// The standard attribute, which says what R, G, B and Y are amounts of.
fn chromaticities(space: ColorSpace) -> Chromaticities {
    #[expect(clippy::cast_possible_truncation, reason = "the format's numbers")]
    let vector = |Chromaticity { x, y }: Chromaticity| Vec2(x as f32, y as f32);
    let Rgb { red, green, blue } = space.primaries().map(|primary| vector(*primary));
    Chromaticities { red, green, blue, white: vector(space.white()) }
}

/// The crate's own conversion refuses all but Latin-1; the libraries of `OpenEXR` pass UTF-8 on as it is.
fn text(utf8: &str) -> Text {
    Text::from_slice_unchecked(utf8.as_bytes())
}

fn from_exr(error: exr::error::Error) -> ExportError {
    match error {
        exr::error::Error::Io(reason) => ExportError::Write(reason),
        other => ExportError::Unsuitable { format: Format::Exr, reason: other.to_string() },
    }
}

/// Walks the attributes of the first header (name, type, length, value; an empty name ends them) without reading
/// their values, which a general reader would have to hold.
pub(super) fn read_json(file: &mut (impl BufRead + Seek)) -> Result<Option<Vec<u8>>, String> {
    let broken = |error: std::io::Error| error.to_string();
    file.seek(SeekFrom::Start(8)).map_err(broken)?;
    loop {
        let name = read_name(file)?;
        if name.is_empty() {
            return Ok(None);
        }
        let kind = read_name(file)?;
        let mut length = [0; 4];
        file.read_exact(&mut length).map_err(broken)?;
        let length = u32::from_le_bytes(length);
        if name == b"isophote" && kind == b"string" {
            return read_exactly(file, length.into(), LONGEST_JSON).map(Some);
        }
        file.seek_relative(length.into()).map_err(broken)?;
    }
}

fn read_name(file: &mut impl BufRead) -> Result<Vec<u8>, String> {
    let mut name = Vec::new();
    file.take(256).read_until(0, &mut name).map_err(|error| error.to_string())?;
    match name.pop() {
        Some(0) => Ok(name),
        _ => Err("a name in its header does not end".into()),
    }
}
