use super::*;
use crate::figure::read_back::{page, texts};
use crate::figure::svg::hex;

fn options() -> SectionOptions {
    SectionOptions {
        title: "Сечение y = 0".into(),
        x_label: "x".into(),
        x_unit: "m".into(),
        y_label: "B".into(),
        y_unit: "W/m²".into(),
        footer: "isophote 0.1.0".into(),
    }
}

fn svg_of(series: &[Series], options: &SectionOptions) -> String {
    section_figure(series, options).unwrap().to_svg().unwrap()
}

fn series(name: &str, values: &[Option<f64>]) -> Series {
    let points = (0_u32..).zip(values).map(|(index, &value)| SectionPoint { x: f64::from(index), value }).collect();
    Series { name: name.into(), points }
}

/// Coordinates of the paths in a series' colour.
fn lines(svg: &str, color: Color) -> Vec<Vec<f64>> {
    let paths = svg.lines().filter(|line| line.starts_with("<path") && line.contains(&hex(color)));
    paths
        .filter_map(|line| line.split('"').nth(1))
        .map(|data| data.split(|sign: char| "ML ".contains(sign)).filter_map(|word| word.parse().ok()).collect())
        .collect()
}

#[test]
fn a_line_is_interrupted_where_nothing_is_seen() {
    let values = [Some(1.0), Some(2.0), None, Some(3.0), None, None, Some(2.0), Some(1.0), Some(4.0)];
    let svg = svg_of(&[series("B", &values)], &options());
    let lines = lines(&svg, COLORS[0]);
    assert_eq!(lines.iter().map(Vec::len).collect::<Vec<_>>(), [4, 6], "two places and three places");
    assert_eq!(svg.matches("<circle").count(), 1, "the value alone between two gaps");
}

#[test]
fn values_stand_where_the_numbers_of_the_axes_say() {
    let svg = svg_of(&[series("B", &[Some(0.0), Some(10.0), Some(5.0)])], &options());
    let line = &lines(&svg, COLORS[0])[0];
    let texts = texts(&svg);
    let number = |wanted: f64, is_below: bool| {
        let mut numbers = texts.iter().filter(|text| text.content.parse() == Ok(wanted)).map(|text| text.room.center);
        numbers.rfind(|center| (center.y > line[1] + 5.0) == is_below).unwrap()
    };
    assert!((number(1.0, true).x - line[2]).abs() < 0.02 && (number(2.0, true).x - line[4]).abs() < 0.02);
    assert!((number(10.0, false).y - line[3]).abs() < 0.02 && (number(0.0, false).y - line[1]).abs() < 0.02);
    assert_eq!(texts.iter().filter(|text| ["x, m", "B, W/m²"].contains(&text.content.as_str())).count(), 2);
}

#[test]
fn a_legend_names_several_series_and_keeps_clear_of_everything() {
    let values = [Some(1e-5), Some(4e-5), Some(2e-5)];
    let one = svg_of(&[series("alone", &values)], &options());
    assert!(!one.contains("alone"));
    let names = ["lamp 1", "lamp 2, показатель 40", "the sum of all lamps of the scene", "reference & bound", "5"];
    let several: Vec<Series> = names.iter().map(|name| series(name, &values)).collect();
    let svg = svg_of(&several, &options());
    let (page, texts) = (page(&svg), texts(&svg));
    let line = &lines(&svg, COLORS[0])[0];
    let highest = line.chunks(2).map(|place| place[1]).fold(f64::INFINITY, f64::min);
    for name in names {
        let text = texts.iter().find(|text| text.content == *name).unwrap();
        assert!(text.room.center.y < highest, "{name} stands above the box");
    }
    for (index, text) in texts.iter().enumerate() {
        assert!(text.room.lies_in(&page), "{}", text.content);
        assert!(texts[..index].iter().all(|other| !other.room.overlaps(&text.room)), "{}", text.content);
    }
}

#[test]
fn twenty_eight_series_differ_in_colour_or_dash() {
    let styles: std::collections::HashSet<String> = (0..28).map(|index| format!("{:?}", line_style(index))).collect();
    assert_eq!(styles.len(), 28);
}

#[test]
fn the_vertical_axis_begins_at_zero_only_where_values_come_near_it() {
    for (range, foot) in
        [([1.0, 10.0], 0.0), ([8.0, 10.0], 7.9), ([-1.0, 1.0], -1.1), ([3.0, 3.0], 1.5), ([0.0, 0.0], -1.0)]
    {
        assert!((padded(range)[0] - foot).abs() < 1e-12, "{range:?}");
        assert!(padded(range)[1] > range[1]);
    }
}

#[test]
fn a_section_without_a_line_is_refused() {
    let refuse = |series: &[Series]| section_figure(series, &options()).unwrap_err().to_string();
    assert!(refuse(&[]).contains("no two places"));
    assert!(refuse(&[series("B", &[Some(1.0)])]).contains("no two places"));
    assert!(refuse(&[series("B", &[None, None])]).contains("no value"));
    assert!(refuse(&[series("B", &[Some(1.0), Some(f64::NAN)])]).starts_with("B[1] is NaN"));
}
