use std::collections::BTreeMap;
use std::io::Cursor;
use std::num::NonZeroUsize;

use exr::prelude::*;
use isophote::map::{Channel, Map, Quantity, Values};

use super::{encoded, in_single_precision, row, rows, sample, with_channels};
use crate::Format;
use crate::exr::write;

pub(super) fn image(map: &Map) -> FlatImage {
    let bytes = encoded(map, Format::Exr).unwrap();
    read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .pedantic()
        .from_buffered(Cursor::new(bytes))
        .unwrap()
}

pub(super) fn channels(image: &FlatImage) -> BTreeMap<String, Vec<f32>> {
    let values = |channel: &AnyChannel<FlatSamples>| match &channel.sample_data {
        FlatSamples::F32(samples) => samples.clone(),
        other => panic!("not 32-bit: {other:?}"),
    };
    let name = |channel: &AnyChannel<FlatSamples>| String::from_utf8(channel.name.as_slice().into()).unwrap();
    image.layer_data[0].channel_data.list.iter().map(|channel| (name(channel), values(channel))).collect()
}

fn attribute(image: &FlatImage, name: &str) -> String {
    // The reader may assign attributes of the only layer to the image or to the layer.
    let (shared, own) = (&image.attributes.other, &image.layer_data[0].attributes.other);
    match shared.get(&Text::from(name)).unwrap_or_else(|| &own[&Text::from(name)]) {
        AttributeValue::Text(text) => String::from_utf8(text.as_slice().into()).unwrap(),
        other => panic!("no text: {other:?}"),
    }
}

#[test]
#[expect(clippy::cast_possible_truncation, reason = "the format's rounding is what is compared")]
fn every_channel_reads_back_rounded_to_32_bits() {
    let map = sample();
    let channels = channels(&image(&map));
    let names: Vec<_> = channels.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "N.X",
            "N.Y",
            "N.Z",
            "P.X",
            "P.Y",
            "P.Z",
            "Y",
            "irradiance.Y",
            "light.a___b_______c_.Y",
            "light.лампа.Y",
            "shape.index"
        ]
    );
    for (name, quantity) in [
        ("Y", Quantity::Brightness),
        ("irradiance.Y", Quantity::Irradiance),
        ("light.лампа.Y", Quantity::Light("лампа".into())),
    ] {
        let expected: Vec<f32> = map.scalar(&quantity).unwrap().iter().map(|value| value as f32).collect();
        assert_eq!(channels[name], expected, "{name}");
    }
    assert_eq!(channels["P.X"], [-1.0, 0.0, 1e5, 0.0, 0.0, 0.0]);
    assert_eq!(channels["P.Z"], [1e-7, 0.0, 2.5, 1.0, 1.0, 0.0]);
    assert_eq!(channels["N.Y"], [-1.0_f32 / 3.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(channels["shape.index"], [0.0, -1.0, 7.0, 0.0, 1.0, -1.0]);
}

/// Blocks of 16 rows: some with runs at both ends of rows, two of background only, one of noise that does not compress,
/// and one cut off by the end of the image.
#[test]
#[expect(clippy::cast_possible_truncation, reason = "the format's rounding is what is compared")]
fn blocks_with_and_without_a_surface_read_back_as_they_are() {
    let noise =
        |index: u32| f64::from(f32::from_bits(0x3f00_0000 + (index + 1).wrapping_mul(2_654_435_761) % (1 << 24)));
    let brightness: Vec<f64> = (0..7 * 90)
        .map(|index| match (index / 7, index % 7) {
            (0..16, 0 | 1 | 6) | (80.., 3..) => f64::from(index) + 0.1,
            (48..64, _) => noise(index),
            _ => 0.0,
        })
        .collect();
    let map = rows(7, &brightness);
    let channels = channels(&image(&map));
    assert_eq!(channels["Y"], brightness.iter().map(|value| *value as f32).collect::<Vec<_>>());
    let shapes = brightness.iter().map(|value| if *value == 0.0 { -1.0 } else { 0.0 });
    assert_eq!(channels["shape.index"], shapes.collect::<Vec<f32>>());
}

#[test]
fn single_precision_gives_the_same_file_as_double() {
    let mut channels = sample().channels().to_vec();
    channels[5].values = Values::Scalar(vec![0.25, 0.0, 0.25, 0.25, 0.25, 0.0]);
    let map = with_channels(&sample(), channels);
    assert!(encoded(&in_single_precision(&map), Format::Exr).unwrap() == encoded(&map, Format::Exr).unwrap());
}

#[test]
fn the_region_lies_in_the_full_image() {
    let image = image(&sample());
    assert_eq!(image.attributes.display_window, IntegerBounds::from_dimensions((5, 4)));
    assert_eq!(image.layer_data.len(), 1);
    assert_eq!(image.layer_data[0].attributes.layer_position, Vec2(1, 2));
    assert_eq!(image.layer_data[0].size, Vec2(3, 2));
}

#[test]
fn units_and_names_are_attributes_that_any_tool_shows() {
    let image = image(&sample());
    let own = &image.layer_data[0].attributes;
    assert_eq!(own.software_name, Some(Text::from("isophote 0.1.0")));
    assert_eq!(
        attribute(&image, "units"),
        "Y: brightness, W/m²\nirradiance.Y: irradiance, W/m²\nshape.index: shape, index\nP.X P.Y P.Z: position, mm\n\
         N.X N.Y N.Z: normal, 1\nlight.лампа.Y: light.лампа, W/m²\n\
         light.a___b_______c_.Y: light.a, \"b\" #/../c., W/m²"
    );
    assert!(attribute(&image, "isophote").contains(r#""stored_as":["light.лампа.Y"]"#));
}

#[test]
fn what_32_bits_cannot_hold_is_refused_with_its_place() {
    let map = row(&[1.0, 3.5e38]);
    let message = encoded(&map, Format::Exr).unwrap_err().to_string();
    assert!(message.starts_with("channel ‘brightness’ is 3.5e38 at column 2, row 2: "), "{message}");
    let mut channels = row(&[1.0]).channels().to_vec();
    channels[1].values = Values::Index(vec![16_777_217]);
    let map = with_channels(&row(&[1.0]), channels);
    let message = encoded(&map, Format::Exr).unwrap_err().to_string();
    assert!(message.starts_with("channel ‘shape’ is 1.6777217e7 at column 1, row 2: "), "{message}");
}

#[test]
fn an_image_beyond_the_formats_coordinates_is_refused() {
    let mut map = sample();
    map.full.width = 1 << 30;
    let message = encoded(&map, Format::Exr).unwrap_err().to_string();
    assert_eq!(message, "cannot be saved as exr: the image reaches to 1073741824, its coordinates to 1073741822");
    map.full.width = (1 << 30) - 2;
    map.region.corner.column = map.full.width - 3;
    assert_eq!(image(&map).layer_data[0].attributes.layer_position, Vec2(1_073_741_819, 2));
}

#[test]
fn lights_of_any_name_keep_channels_of_their_own() {
    let long = "я".repeat(1000);
    let lights = ["", "unnamed", ".", "\0", &long, &format!("{long}2")].map(|light| {
        let values = Values::Scalar(vec![1.0]);
        Channel { quantity: Quantity::Light(light.into()), unit: "W/m²".into(), values }
    });
    let map = with_channels(&row(&[1.0]), row(&[1.0]).channels().iter().cloned().chain(lights));
    let names: Vec<_> = channels(&image(&map)).into_keys().collect();
    assert_eq!(names.len(), 8, "{names:?}");
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let map = rows(9, &(0..9 * 700).map(|index| f64::from(index % 5000).sqrt()).collect::<Vec<_>>());
    let [alone, together] = [1, 5].map(|threads| {
        let mut out = Cursor::new(Vec::new());
        write(&map, NonZeroUsize::new(threads).unwrap(), &mut out).unwrap();
        out.into_inner()
    });
    assert!(alone == together);
}
