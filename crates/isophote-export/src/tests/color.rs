//! Colours in every format, read back by independent readers.

use isophote::color::ColorSpace;
use isophote::map::{Channel, Map, Quantity, Values};
use isophote::units::Keyword;
use png::ColorType;

use super::exr::{channels, image};
use super::png::picture;
use super::{encoded, sample, with_channels};
use crate::figure::{FigureOptions, map_figure};
use crate::png::{Depth, PictureColor, PictureOptions, PictureReport, write};
use crate::{ExportError, FileMetadata, Format};

/// Pixels 0, 2, 3 and 4 of the sample are visible.
const COLORS: [[f64; 3]; 6] =
    [[2.0, 0.0, 0.0], [0.0; 3], [0.0, 1.0, 0.0], [1.0, 1.0, 1.0], [0.002, 0.5, 2.0], [0.0; 3]];

fn colored(space: ColorSpace) -> Map {
    let sample = sample();
    let values = Values::Vector(COLORS.to_vec());
    let color = Channel { quantity: Quantity::Color, unit: "W/m²".into(), values };
    let mut map = with_channels(&sample, std::iter::once(color).chain(sample.channels().iter().cloned()));
    map.provenance.color_space = Some(space.name().into());
    map
}

fn options() -> PictureOptions<'static> {
    PictureOptions::new(Quantity::Color)
}

fn colors(map: &Map, options: &PictureOptions<'_>) -> (Vec<u16>, PictureReport) {
    picture(map, options, ColorType::Rgb)
}

#[test]
fn a_picture_of_rec709_is_srgb_of_the_shares_of_the_largest_component() {
    let (samples, report) = colors(&colored(ColorSpace::Rec709), &options());
    // Half of white is 188, a thousandth 3 (12.92 × 255/1000), a quarter 137.
    let expected = [[255, 0, 0], [0; 3], [0, 188, 0], [188; 3], [3, 137, 255], [0; 3]];
    assert_eq!(samples, expected.as_flattened());
    assert_eq!(report, PictureReport { range: [0.0, 2.0], clamped_below: 0, clamped_above: 0 });
}

#[test]
fn sixteen_bits_and_a_range_hold_for_colours_too() {
    let options = PictureOptions { depth: Depth::Sixteen, range: Some([0.0, 1.0]), ..options() };
    let (samples, report) = colors(&colored(ColorSpace::Rec709), &options);
    assert_eq!(samples[9..12], [65535; 3]);
    assert_eq!((report.clamped_below, report.clamped_above), (0, 2));
}

/// By the matrix of ITU-R BT.2087, half of the green of BT.2020 is (−0.2938, 0.5665, −0.0503) in sRGB.
#[test]
fn another_space_is_shown_in_the_primaries_of_srgb() {
    let (samples, report) = colors(&colored(ColorSpace::Rec2020), &options());
    assert_eq!(samples[6..9], [0, 198, 0]);
    assert_eq!(samples[9..12], [188; 3], "white is white");
    assert_eq!((report.clamped_below, report.clamped_above), (3, 2));
}

#[test]
fn what_would_change_the_colours_is_refused() {
    let map = colored(ColorSpace::Rec709);
    let refused = |options: &PictureOptions<'_>| write(&map, options, &mut Vec::new()).unwrap_err();
    assert!(matches!(refused(&PictureOptions { gamma: 2.2, ..options() }), ExportError::ColorStyle { .. }));
    let color = PictureColor { name: "viridis", color: &|_| [0; 3] };
    assert!(matches!(refused(&PictureOptions { color: Some(color), ..options() }), ExportError::ColorStyle { .. }));
    let range = refused(&PictureOptions { range: Some([1.0, 1.0]), ..options() });
    assert!(matches!(range, ExportError::Range { .. }));
}

#[test]
fn exr_has_r_g_b_and_says_of_what() {
    let image = image(&colored(ColorSpace::AcesCg));
    let channels = channels(&image);
    assert_eq!(channels["R"], [2.0, 0.0, 0.0, 1.0, 0.002, 0.0]);
    assert_eq!(channels["B"], [0.0, 0.0, 0.0, 1.0, 2.0, 0.0]);
    let chromaticities = image.attributes.chromaticities.expect("the standard attribute");
    assert_eq!((chromaticities.green.0, chromaticities.green.1), (0.165, 0.83));
    assert_eq!((chromaticities.white.0, chromaticities.white.1), (0.32168, 0.33767));
    assert!(super::exr::image(&sample()).attributes.chromaticities.is_none());
}

#[test]
fn tables_name_the_components_and_the_space() {
    let text = String::from_utf8(encoded(&colored(ColorSpace::DisplayP3), Format::Csv).unwrap()).unwrap();
    assert!(text.contains("shape,color.r,color.g,color.b,brightness"), "{text}");
    assert!(text.contains("# color.r, color.g, color.b: W/m²\n"));
    assert!(text.contains("# color space: display-p3;"));
}

#[test]
fn the_description_names_the_space_and_none_where_there_is_none() {
    let metadata = FileMetadata::of(&colored(ColorSpace::Rec2020));
    let json = metadata.to_json();
    assert!(json.contains("\"color_space\":\"rec2020\""));
    assert_eq!(serde_json::from_str::<FileMetadata>(&json).unwrap(), metadata);
    assert!(!FileMetadata::of(&sample()).to_json().contains("color"));
}

#[test]
fn a_figure_of_colours_has_axes_and_no_colour_bar() {
    let figure = map_figure(&colored(ColorSpace::Rec709), &FigureOptions::new(Quantity::Color, "color")).unwrap();
    let svg = figure.to_svg().unwrap();
    assert_eq!(svg.matches("<image").count(), 1, "the picture alone");
    assert!(svg.contains("rec709"), "{svg}");
}
