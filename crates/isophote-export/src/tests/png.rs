use std::io::Cursor;

use isophote::map::{Map, Quantity};
use png::{BitDepth, ColorType, Decoder};

use super::{in_single_precision, row, rows, sample};
use crate::png::{Depth, Normalization, PictureColor, PictureOptions, PictureReport, write};

/// The samples of the map's picture, which has the map's size, these colours and the depth asked for.
pub(super) fn picture(map: &Map, options: &PictureOptions, color: ColorType) -> (Vec<u16>, PictureReport) {
    let mut file = Vec::new();
    let report = write(map, options, &mut file).unwrap();
    let mut reader = Decoder::new(Cursor::new(file)).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let found = reader.next_frame(&mut bytes).unwrap();
    reader.finish().unwrap();
    let (depth, samples) = match options.depth {
        Depth::Eight => (BitDepth::Eight, bytes.into_iter().map(u16::from).collect()),
        Depth::Sixteen => {
            (BitDepth::Sixteen, bytes.as_chunks().0.iter().map(|pair| u16::from_be_bytes(*pair)).collect())
        }
    };
    let size = map.region.size;
    assert_eq!((found.width, found.height), (size.width, size.height));
    assert_eq!((found.color_type, found.bit_depth), (color, depth));
    (samples, report)
}

fn grey(map: &Map, options: &PictureOptions) -> (Vec<u16>, PictureReport) {
    picture(map, options, ColorType::Grayscale)
}

fn brightness() -> PictureOptions<'static> {
    PictureOptions::new(Quantity::Brightness)
}

fn refusal(options: &PictureOptions) -> String {
    write(&sample(), options, &mut Vec::new()).unwrap_err().to_string()
}

#[test]
fn the_greatest_value_is_255_and_zero_is_0() {
    let (levels, report) = grey(&sample(), &brightness());
    // 0.5, missed, 2; 0.1, 1, missed: 63.75, –, 255; 12.75, 127.5, –.
    assert_eq!(levels, [64, 0, 255, 13, 128, 0]);
    assert_eq!(report, PictureReport { range: [0.0, 2.0], clamped_below: 0, clamped_above: 0 });
}

#[test]
fn sixteen_bits_reach_65535() {
    let (levels, _) = grey(&sample(), &PictureOptions { depth: Depth::Sixteen, ..brightness() });
    assert_eq!(levels, [16384, 0, 65535, 3277, 32768, 0]);
}

#[test]
fn runs_that_begin_and_end_with_rows_stay_where_they_are() {
    let values = [1.0, 0.0, 0.0, 0.0, 0.0, 2.0, 4.0, 4.0, 0.0, 0.0, 0.0, 0.0, 3.0, 0.0, 1.0];
    let map = rows(3, &values);
    let (levels, _) = grey(&map, &PictureOptions { range: Some([-1.0, 4.0]), ..brightness() });
    assert_eq!(levels, [102, 0, 0, 0, 0, 153, 255, 255, 0, 0, 0, 0, 204, 0, 102]);
}

#[test]
fn single_precision_gives_the_same_picture_as_double() {
    let map = row(&[0.25, 0.5, 1.0, 3.0, 1e-9, 2.5]);
    for depth in [Depth::Eight, Depth::Sixteen] {
        let options = PictureOptions { depth, range: Some([0.0, 2.5]), ..brightness() };
        assert_eq!(grey(&in_single_precision(&map), &options), grey(&map, &options));
    }
}

#[test]
fn gamma_is_the_root_of_the_share() {
    let map = row(&[0.0, 0.25, 0.5, 1.0]);
    let (levels, _) = grey(&map, &PictureOptions { gamma: 2.0, ..brightness() });
    assert_eq!(levels, [0, 128, 180, 255]);
}

#[test]
fn a_stretched_picture_runs_from_the_least_visible_value_to_the_greatest() {
    let options = PictureOptions { normalization: Normalization::MinMax, ..brightness() };
    let (levels, report) = grey(&row(&[1.0, 1.5, 2.0, 3.0]), &options);
    assert_eq!(levels, [0, 64, 128, 255]);
    assert_eq!(report, PictureReport { range: [1.0, 3.0], clamped_below: 0, clamped_above: 0 });
    let (levels, _) = grey(&row(&[2.0, 2.0]), &options);
    assert_eq!(levels, [0, 0], "of one value only");
}

#[test]
fn a_logarithmic_picture_has_three_decades() {
    let options = PictureOptions { normalization: Normalization::Log, ..brightness() };
    let (levels, report) = grey(&row(&[0.0, 1e-9, 0.02, 0.2, 2.0, 20.0]), &options);
    assert_eq!(levels, [0, 0, 0, 85, 170, 255]);
    assert_eq!(report, PictureReport { range: [0.02, 20.0], clamped_below: 2, clamped_above: 0 });
    let (levels, _) = grey(&row(&[1.0, 10.0, 100.0]), &PictureOptions { range: Some([1.0, 100.0]), ..options.clone() });
    assert_eq!(levels, [0, 128, 255]);
    let (levels, _) = grey(&row(&[0.0, 0.0]), &options);
    assert_eq!(levels, [0, 0], "without light");
    let message = refusal(&PictureOptions { range: Some([0.0, 1.0]), ..options });
    assert!(message.contains("must be above 0"), "{message}");
}

#[test]
fn values_outside_the_range_are_clamped_and_counted_but_missed_pixels_are_not() {
    let (levels, report) = grey(&sample(), &PictureOptions { range: Some([0.4, 0.9]), ..brightness() });
    assert_eq!(levels, [51, 0, 255, 0, 255, 0]);
    assert_eq!(report, PictureReport { range: [0.4, 0.9], clamped_below: 1, clamped_above: 2 });
}

#[test]
fn missed_pixels_are_black_even_below_a_negative_range() {
    let (levels, _) = grey(&sample(), &PictureOptions { range: Some([-2.0, 2.0]), ..brightness() });
    assert_eq!(levels, [159, 0, 255, 134, 191, 0]);
}

#[test]
fn a_colour_map_paints_what_is_seen_and_nothing_else() {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 200")]
    let color = |level: f64| [10, (level * 200.0) as u8, 20];
    let options = PictureOptions { color: Some(PictureColor { name: "test", color: &color }), ..brightness() };
    let (colors, _) = picture(&sample(), &options, ColorType::Rgb);
    assert_eq!(
        colors,
        [
            10, 50, 20, 0, 0, 0, 10, 200, 20, //
            10, 10, 20, 10, 100, 20, 0, 0, 0
        ]
    );
}

#[test]
fn a_map_without_light_is_black() {
    let map = row(&[0.0, 0.0]);
    let (levels, report) = grey(&map, &brightness());
    assert_eq!(levels, [0, 0]);
    assert_eq!(report, PictureReport { range: [0.0, 0.0], clamped_below: 0, clamped_above: 0 });
    let map = row(&[-1.0, -2.0]);
    let (levels, report) = grey(&map, &brightness());
    assert_eq!(levels, [0, 0]);
    assert_eq!(report.clamped_below, 2);
}

#[test]
fn what_makes_no_picture_is_refused_by_name_and_value() {
    let of = |quantity| refusal(&PictureOptions::new(quantity));
    assert_eq!(of(Quantity::Normal), "channel ‘normal’ cannot be a picture: it holds three numbers at each pixel");
    assert_eq!(of(Quantity::Shape), "channel ‘shape’ cannot be a picture: it holds an index at each pixel");
    for range in [[1.0, 1.0], [2.0, 1.0], [0.0, f64::NAN], [0.0, f64::INFINITY], [-f64::MAX, f64::MAX]] {
        let message = refusal(&PictureOptions { range: Some(range), ..brightness() });
        let said = format!("range {} to {} of ‘brightness’: ", range[0], range[1]);
        assert!(message.starts_with(&said), "{message}");
    }
    for gamma in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let message = refusal(&PictureOptions { gamma, ..brightness() });
        assert_eq!(message, format!("gamma {gamma}: must be finite and above 0"));
    }
    let color = Some(PictureColor { name: "viridis", color: &|_| [0; 3] });
    let message = refusal(&PictureOptions { color, depth: Depth::Sixteen, ..brightness() });
    assert!(message.starts_with("depth 16 with colours ‘viridis’"), "{message}");
}

#[test]
fn the_texts_are_readable_and_say_what_white_is() {
    let mut bytes = Vec::new();
    write(&sample(), &brightness(), &mut bytes).unwrap();
    let reader = Decoder::new(Cursor::new(bytes)).read_info().unwrap();
    let texts: Vec<_> =
        reader.info().utf8_text.iter().map(|chunk| (chunk.keyword.clone(), chunk.get_text().unwrap())).collect();
    assert_eq!(texts[0], ("Title".into(), "Сфера, \"пример\" # 1 вторая строка".into()));
    assert_eq!(texts[1], ("Software".into(), "isophote 0.1.0".into()));
    assert_eq!(texts[2].0, "Description");
    assert_eq!(
        texts[2].1,
        "brightness, lab (3.3); black is 0 W/m², white is 2 W/m²; level proportional to the value (linear, not gamma-encoded)"
    );
    assert_eq!(texts[3].0, "isophote");
    assert!(reader.info().source_gamma.is_none());
}

#[test]
fn the_description_of_a_coloured_picture_says_where_its_colours_begin_and_end() {
    let mut bytes = Vec::new();
    let color = Some(PictureColor { name: "viridis", color: &|_| [0; 3] });
    let options = PictureOptions { color, gamma: 2.2, range: Some([1e-9, 1e300]), ..brightness() };
    write(&sample(), &options, &mut bytes).unwrap();
    let reader = Decoder::new(Cursor::new(bytes)).read_info().unwrap();
    assert_eq!(
        reader.info().utf8_text[2].get_text().unwrap(),
        "brightness, lab (3.3); colours viridis from 1e-9 W/m² to 1e300 W/m², missed pixels black; \
         level = (share of the way between them)^(1/2.2)"
    );
}
