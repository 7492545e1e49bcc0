//! The attributes in an EXR file's header, besides the sizes.

use exr::meta::attribute::Chromaticities;
use exr::prelude::{AttributeValue, ImageAttributes, IntegerBounds, LayerAttributes, Text, Vec2};
use isophote::color::{Chromaticity, ColorSpace, Rgb};
use isophote::map::{Channel, Map};
use isophote::units::Keyword;

use crate::metadata::FileMetadata;
use crate::text::one_line;

/// At most one attribute goes into each `other`: the encoder writes them in the random order of a hash map, so two
/// would make the same map give different bytes.
pub(super) fn of_layer(map: &Map, names: &[Vec<String>]) -> LayerAttributes {
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

pub(super) fn of_image(map: &Map, names: &[Vec<String>]) -> ImageAttributes {
    let full = IntegerBounds::from_dimensions((map.full.width as usize, map.full.height as usize));
    let mut attributes = ImageAttributes::new(full);
    attributes.chromaticities =
        map.provenance.color_space.as_deref().and_then(ColorSpace::from_name).map(chromaticities);
    let line = |(channel, names): (&Channel, &Vec<String>)| {
        let unit = match channel.unit.as_str() {
            "" => "index",
            unit => unit,
        };
        format!("{}: {}, {unit}", names.join(" "), one_line(&channel.quantity.name()))
    };
    let units: Vec<_> = map.channels().iter().zip(names).map(line).collect();
    attributes.other.insert(text("units"), AttributeValue::Text(text(&units.join("\n"))));
    attributes
}

/// The standard attribute that defines the primaries of R, G, B and Y.
fn chromaticities(space: ColorSpace) -> Chromaticities {
    #[expect(clippy::cast_possible_truncation, reason = "the format's numbers")]
    let vector = |Chromaticity { x, y }: Chromaticity| Vec2(x as f32, y as f32);
    let Rgb { red, green, blue } = space.primaries().map(|primary| vector(*primary));
    Chromaticities { red, green, blue, white: vector(space.white()) }
}

/// The crate's own conversion rejects everything but Latin-1; the `OpenEXR` libraries pass UTF-8 through unchanged.
pub(super) fn text(utf8: &str) -> Text {
    Text::from_slice_unchecked(utf8.as_bytes())
}
