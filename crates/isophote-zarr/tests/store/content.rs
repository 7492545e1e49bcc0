//! The numbers in a store are those of a map in memory.

use std::fs;

use isophote::analysis::statistics::{counts, statistics};
use isophote::map::{Quantity, Resolution};
use isophote_export::FileMetadata;

use crate::common::{Job, TWO_LIGHTS, map, scene};

#[test]
fn every_value_is_that_of_the_map_in_memory_to_the_last_bit() {
    let scene = scene(TWO_LIGHTS, 70, 50);
    let light = Quantity::Light(scene.scene().lights()[0].name.clone());
    let quantities = vec![Quantity::Brightness, light.clone(), Quantity::Shape, Quantity::Normal, Quantity::Depth];
    let map = map(&scene, &quantities);
    let (folder, _) = Job { quantities, ..Job::default() }.complete(&scene);
    let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    let scalar = |quantity: &Quantity| map.scalar(quantity).unwrap().iter().collect::<Vec<_>>();
    for quantity in [Quantity::Brightness, light, Quantity::Depth] {
        let name = quantity.name();
        assert!(bits(&folder.doubles(&name)) == bits(&scalar(&quantity)), "{name}");
    }
    assert_eq!(folder.indices("shape"), map.mask().shapes());
    let isophote::map::Values::Vector(normals) = &map.channel(&Quantity::Normal).unwrap().values else { panic!() };
    assert!(bits(&folder.doubles("normal")) == bits(normals.as_flattened()));
}

#[test]
fn statistics_are_those_of_the_map_in_memory() {
    for side in [5, 16, 512] {
        let scene = scene(TWO_LIGHTS, 40, 30);
        let map = map(&scene, &[Quantity::Brightness]);
        let (_, stored) = Job { side, ..Job::default() }.complete(&scene);
        let known = counts(&map);
        let counted = [stored.pixels, stored.visible, stored.lit].map(|count| usize::try_from(count).unwrap());
        assert_eq!(counted, [known.pixels, known.visible, known.lit.unwrap()]);
        let (stored, known) =
            (stored.channels[0].statistics.unwrap(), statistics(&map, &Quantity::Brightness).unwrap());
        assert_eq!((stored.max, stored.min), (known.max, known.min), "side {side}");
        assert!((stored.mean - known.mean).abs() <= 4.0 * f64::EPSILON * known.mean, "side {side}");
    }
}

#[test]
fn of_equal_extremes_the_first_in_reading_order_is_reported() {
    // The index of the shape is no quantity; the depth of a mirrored pair of pixels is the same to the last bit.
    let scene = scene(include_str!("../../../../scenes/lab.toml"), 40, 30);
    let map = map(&scene, &[Quantity::Depth]);
    let known = statistics(&map, &Quantity::Depth).unwrap();
    for side in [4, 13] {
        let (_, stored) = Job { side, quantities: vec![Quantity::Depth], ..Job::default() }.complete(&scene);
        let stored = stored.channels[0].statistics.unwrap();
        assert_eq!((stored.max, stored.min), (known.max, known.min), "side {side}");
    }
}

#[test]
fn shards_in_which_nothing_is_seen_have_no_file() {
    let scene = scene(include_str!("../../../../scenes/lab.toml"), 80, 60);
    let (folder, _) = Job::default().complete(&scene);
    assert!(!folder.file("brightness/c/0/0").exists());
    assert!(folder.file("brightness/c/1/2").exists());
    assert_eq!(folder.description("shape")["fill_value"], -1);
}

#[test]
fn coordinates_are_the_centres_of_the_pixels_in_the_unit_of_the_scene() {
    let scene = scene(include_str!("../../../../scenes/course.toml"), 32, 24);
    let (folder, _) = Job::default().complete(&scene);
    let (x, y) = (folder.doubles("x"), folder.doubles("y"));
    assert_eq!((x.len(), y.len()), (32, 24));
    let camera = scene.scene().camera();
    let [left, right] =
        camera.projection.extent(camera.resolution).x.map(|metres| scene.scene().length().from_metres(metres));
    let width = (right - left) / 32.0;
    assert!((x[0] - (left + width / 2.0)).abs() < 1e-9 && (x[31] - (right - width / 2.0)).abs() < 1e-9);
    assert!(y[0] > y[23], "row 0 is on top");
    assert_eq!(folder.description("x")["attributes"]["units"], "mm");
    assert_eq!(folder.description("brightness")["dimension_names"], serde_json::json!(["y", "x"]));
}

#[test]
fn a_store_says_what_it_is_as_every_output_does() {
    let scene = scene(TWO_LIGHTS, 40, 30);
    let (folder, _) = Job::default().complete(&scene);
    let metadata = isophote_zarr::read_metadata(&folder.store()).unwrap();
    let known = FileMetadata::of(&map(&scene, &Job::default().quantities));
    assert_eq!((&metadata.scene, metadata.window, metadata.region), (&known.scene, known.window, known.region));
    let channels: Vec<_> = metadata.channels.iter().map(|channel| channel.name.as_str()).collect();
    assert_eq!(channels, ["brightness", "shape", "normal"]);
    let error = isophote_zarr::read_metadata(&folder.store().join("x")).unwrap_err();
    assert!(error.to_string().ends_with("is no Zarr store of Isophote"), "{error}");
}

#[test]
fn the_preview_shows_means_over_boxes() {
    let scene = scene(TWO_LIGHTS, 1500, 30);
    let map = map(&scene, &[Quantity::Brightness]);
    // Shards that do not end where the boxes end: 2 pixels by 2.
    let (folder, _) = Job { side: 25, ..Job::default() }.complete(&scene);
    let decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(folder.file("preview.png")).unwrap()));
    let mut reader = decoder.read_info().unwrap();
    let mut levels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut levels).unwrap();
    assert_eq!((reader.info().width, reader.info().height), (750, 15));
    let values = map.scalar(&Quantity::Brightness).unwrap();
    let value = |column: usize, row: usize| values.at(row * 1500 + column);
    let mean = |column: usize, row: usize| {
        [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| value(2 * column + x, 2 * row + y)).iter().sum::<f64>() / 4.0
    };
    let boxes = (0..15).flat_map(|row| (0..750).map(move |column| (column, row)));
    let means: Vec<f64> = boxes.map(|(column, row)| mean(column, row)).collect();
    let white = means.iter().fold(0.0_f64, |most, mean| most.max(*mean));
    assert!(white > 0.0);
    for (level, mean) in levels.iter().zip(&means) {
        assert!((f64::from(*level) - 255.0 * mean / white).abs() < 0.51, "{level} for {mean}");
    }
    assert_eq!(map.full, Resolution { width: 1500, height: 30 });
}
