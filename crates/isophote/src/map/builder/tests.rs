use super::*;
use crate::map::{Coordinates, Pixel, Run};
use crate::units::LengthUnit;

const FULL: Resolution = Resolution { width: 4, height: 3 };

/// A builder for an image of 4 × 3 pixels.
fn begun() -> MapBuilder {
    let window =
        Window { x: [0.0, 4.0], y: [0.0, 3.0], length: LengthUnit::Metre, coordinates: Coordinates::default() };
    let provenance = Provenance {
        program: "a test".into(),
        title: String::new(),
        scene: String::new(),
        files: Vec::new(),
        convention: "lab (3.3)".into(),
        renderer: "none".into(),
        color_space: None,
    };
    Map::builder(FULL, window, provenance)
}

/// The two middle pixels of its lowest row.
fn part() -> Region {
    Region { corner: Pixel { column: 1, row: 2 }, size: Resolution { width: 2, height: 1 } }
}

fn brightness(builder: MapBuilder, values: &[f64]) -> MapBuilder {
    builder.channel(Quantity::Brightness, "W/m²", Values::Scalar(values.into()))
}

fn shape(builder: MapBuilder, shapes: &[i32]) -> MapBuilder {
    builder.channel(Quantity::Shape, "", Values::Index(shapes.into()))
}

#[test]
fn a_map_of_a_region_has_its_pixels_at_their_places_in_the_image() {
    let map = shape(brightness(begun().region(part()), &[0.0, 2.0]), &[-1, 5]).build().unwrap();
    assert_eq!((map.full, map.region), (FULL, part()));
    assert_eq!(map.mask().runs(), [Run { start: 1, end: 2, shape: 5 }]);
    assert_eq!(map.pixel(1), Pixel { column: 2, row: 2 });
    let names: Vec<_> = map.channels().iter().map(|channel| channel.quantity.name()).collect();
    assert_eq!(names, ["brightness", "shape"], "in the order in which they were added");
}

#[test]
fn without_a_region_it_is_the_whole_image() {
    let map = shape(begun(), &[0; 12]).build().unwrap();
    assert_eq!((map.region, map.mask().visible()), (Region::all(FULL), 12));
}

#[test]
fn what_is_seen_may_be_told_beside_the_channels() {
    let map = brightness(begun().region(part()).shapes(vec![3, -1]), &[1.0, 0.0]).build().unwrap();
    assert_eq!(map.mask().shapes(), [3, -1]);
    assert_eq!(map.channel(&Quantity::Shape), None);
}

#[test]
fn a_region_that_sticks_out_of_the_image_is_refused() {
    for (column, row, width, height) in [(3, 0, 2, 1), (0, 3, 1, 1), (u32::MAX, 0, 2, 1), (0, 0, 4, 4)] {
        let region = Region { corner: Pixel { column, row }, size: Resolution { width, height } };
        let error = begun().region(region).shapes(vec![]).build().unwrap_err();
        assert_eq!(error, MapError::Region { region });
    }
    let region = Region { corner: Pixel { column: 3, row: 0 }, size: Resolution { width: 2, height: 1 } };
    let message = MapError::Region { region }.to_string();
    assert_eq!(message, "the region of 2 × 1 pixels from column 3, row 0 does not lie in the image");
}

#[test]
fn channels_of_another_length_are_refused_by_name() {
    let length = |name: &str, values| MapError::Length { name: name.into(), values, pixels: 2 };
    let part = || begun().region(part());
    assert_eq!(shape(brightness(part(), &[1.0]), &[0, 0]).build(), Err(length("brightness", 1)));
    assert_eq!(shape(part(), &[0, 0, 0]).build(), Err(length("shape", 3)));
    assert_eq!(part().shapes(vec![0]).build(), Err(length("shape", 1)));
}

#[test]
fn something_must_say_what_is_seen_and_only_one_thing_may() {
    let part = || begun().region(part());
    assert_eq!(brightness(part(), &[1.0, 2.0]).build(), Err(MapError::NoShape));
    assert_eq!(shape(part().shapes(vec![0, 1]), &[0, 2]).build(), Err(MapError::OtherShape { index: 1 }));
    assert_eq!(shape(part().shapes(vec![0, 1]), &[0, -1]).build(), Err(MapError::OtherShape { index: 1 }));
    assert!(shape(part().shapes(vec![-1, 1]), &[-1, 1]).build().is_ok());
}

#[test]
fn a_value_where_nothing_is_seen_is_refused_with_its_place() {
    let background = |name: &str| MapError::Background { name: name.into(), index: 1 };
    let part = || begun().region(part()).shapes(vec![0, -1]);
    assert_eq!(brightness(part(), &[1.0, 2.0]).build(), Err(background("brightness")));
    assert_eq!(brightness(part(), &[1.0, f64::NAN]).build(), Err(background("brightness")));
    assert_eq!(shape(part(), &[0, 0]).build(), Err(background("shape")));
    let normal = Values::Vector(vec![[0.0; 3], [0.0, 0.0, 1.0]]);
    assert_eq!(part().channel(Quantity::Normal, "1", normal).build(), Err(background("normal")));
    let depth = Values::Single(vec![1.0, 1e-20]);
    assert_eq!(part().channel(Quantity::Depth, "m", depth).build(), Err(background("depth")));
}
