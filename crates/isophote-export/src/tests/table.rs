use isophote::map::{Map, Quantity, Values};

use super::{row, sample};
use crate::csv::{Rows, write};

fn table(map: &Map, rows: Rows) -> (String, u64) {
    let mut bytes = Vec::new();
    let written = write(map, rows, &mut bytes).unwrap();
    (String::from_utf8(bytes).unwrap(), written)
}

fn body(text: &str) -> Vec<Vec<&str>> {
    text.lines().filter(|line| !line.starts_with('#')).map(|line| line.split(',').collect()).collect()
}

#[test]
fn every_number_reads_back_exactly_beside_the_centre_of_its_pixel() {
    let map = sample();
    let (text, written) = table(&map, Rows::All);
    let lines = body(&text);
    assert_eq!(written, 6);
    assert_eq!(
        lines[0].join(","),
        "column,row,x,y,shape,brightness,irradiance,position.x,position.y,position.z,normal.x,normal.y,normal.z,\
         light.лампа,light.a_ _b_ _/../c."
    );
    assert_eq!(lines[1][..5], ["1", "2", "-1", "-0.5", "0"]);
    assert_eq!(lines[2][..5], ["2", "2", "0", "-0.5", "-1"]);
    assert_eq!(lines[6][..5], ["3", "3", "1", "-1.5", "-1"]);
    let read = |index: usize, column: usize| lines[index + 1][column].parse::<f64>().unwrap().to_bits();
    let Values::Vector(positions) = &map.channel(&Quantity::Position).unwrap().values else { unreachable!() };
    for (index, position) in positions.iter().enumerate() {
        assert_eq!(read(index, 6), map.scalar(&Quantity::Irradiance).unwrap().at(index).to_bits());
        assert_eq!(read(index, 8), position[1].to_bits());
        assert_eq!(read(index, 13), map.scalar(&Quantity::Light("лампа".into())).unwrap().at(index).to_bits());
    }
}

#[test]
fn numbers_take_their_shortest_usual_form() {
    let map = row(&[0.0, 0.1, -2.5, 1e300, 1.25e-300, 1e16, 123_456_789.0, 1e-4, 1e-5, f64::MIN_POSITIVE]);
    let (text, _) = table(&map, Rows::All);
    let numbers: Vec<_> = body(&text)[1..].iter().map(|line| line[5].to_owned()).collect();
    let expected =
        ["0", "0.1", "-2.5", "1e300", "1.25e-300", "1e16", "123456789", "0.0001", "1e-5", "2.2250738585072014e-308"];
    assert_eq!(numbers, expected);
}

#[test]
fn missed_pixels_are_left_out_on_request() {
    let (text, written) = table(&sample(), Rows::Visible);
    let places: Vec<_> = body(&text)[1..].iter().map(|line| [line[0], line[1], line[4]].join(" ")).collect();
    assert_eq!(written, 4);
    assert_eq!(places, ["1 2 0", "3 2 7", "1 3 0", "2 3 1"]);
}

#[test]
fn the_comments_give_units_and_never_end_early() {
    let (text, _) = table(&sample(), Rows::All);
    let comments: Vec<_> = text.lines().take_while(|line| line.starts_with("# ")).collect();
    assert_eq!(text.lines().filter(|line| line.contains('#')).count(), comments.len());
    assert!(comments[0].starts_with("# isophote 0.1.0; "));
    assert!(comments[0].ends_with(&format!("skip_header={})", comments.len())));
    for line in [
        "# title: Сфера, \"пример\" # 1 вторая строка",
        "# convention: lab (3.3)",
        "# x, y: centre of the pixel on the screen, mm",
        "# brightness: W/m²",
        "# position.x, position.y, position.z: mm",
        "# normal.x, normal.y, normal.z: no unit",
        "# light.лампа: W/m²",
    ] {
        assert!(comments.contains(&line), "{line}");
    }
    assert!(comments.last().unwrap().starts_with("# isophote: {"));
}
