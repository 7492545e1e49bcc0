//! The lab's report: its table and its picture, by the bare command.

use png::BitDepth;

use crate::common::{Folder, bits, npy};

#[test]
fn the_bare_command_prints_the_labs_four_points_beside_the_published_values() {
    let folder = Folder::new();
    let outcome = folder.ok("");
    for (probe, brightness, published) in [
        ("P1", "0.316677297547093", "0.6"),
        ("P2", "0.137736208646844", "0.42"),
        ("P3", "0.137736208646844", "0.42"),
        ("P4", "0.260714199906064", "0.66"),
    ] {
        let row = outcome.row(probe);
        assert_eq!(row[row.len() - 2..], [brightness, published], "{probe}");
    }
    assert_eq!(outcome.row("P4")[4], "0.410002735970075", "the irradiance (3.1) of P4");
    let header = outcome.stdout.lines().find(|line| line.contains("probe")).unwrap();
    assert!(header.contains("B (3.3), W/m²") && header.ends_with("published"), "{header}");
}

#[test]
fn the_bare_command_writes_the_picture_and_says_so_on_standard_error() {
    let folder = Folder::new();
    let outcome = folder.ok("");
    assert_eq!(folder.names(), ["lab.png"]);
    assert_eq!(outcome.stderr, "wrote lab.png: 0 to 0.388476 W/m² from black to white\n");
}

#[test]
fn render_without_a_scene_does_the_same_as_the_bare_command() {
    let (bare, render) = (Folder::new(), Folder::new());
    let [first, second] = [bare.ok(""), render.ok("render")];
    assert_eq!(first.stdout, second.stdout);
    assert_eq!(render.names(), ["lab.png"]);
    assert_eq!(bare.read("lab.png"), render.read("lab.png"));
}

#[test]
#[expect(clippy::float_cmp, reason = "whole numbers")]
fn every_pixel_of_the_labs_picture_is_its_brightness_scaled_to_255() {
    let folder = Folder::new();
    folder.ok("");
    folder.ok("render -o map.npy");
    let (kind, shape, map) = npy(&folder.read("map.npy"));
    assert_eq!((kind.as_str(), shape.as_slice()), ("<f8", &[600, 800][..]));
    let picture = folder.picture("lab.png");
    assert_eq!((picture.width, picture.height), (800, 600));
    let maximum = map.iter().copied().fold(0.0, f64::max);
    let expected: Vec<f64> = map.iter().map(|brightness| (255.0 * brightness / maximum).round()).collect();
    let levels = picture.levels(BitDepth::Eight);
    assert!(levels == expected, "the first wrong pixel: {:?}", levels.iter().zip(&expected).position(|(a, b)| a != b));
    assert_eq!(levels[281 * 800 + 418], 255.0, "the maximum is white");
    assert_eq!(levels[0], 0.0, "nothing is seen in the corner");
}

#[test]
fn the_printed_maximum_mean_and_counts_are_those_of_the_map() {
    let folder = Folder::new();
    let outcome = folder.ok("render -o map.npy -o map.csv");
    let (_, _, map) = npy(&folder.read("map.npy"));
    let table = folder.csv("map.csv");
    assert_eq!(bits(&table.column("brightness")), bits(&map), "both files hold the same numbers");
    let visible: Vec<usize> = (0..map.len()).filter(|&index| table.column_at("shape", index) >= 0.0).collect();
    assert_eq!(visible.len(), 32744);
    assert_eq!(outcome.row("visible")[1..4], ["32744", "of", "480000"]);
    let lit = table.column("irradiance").iter().filter(|&&irradiance| irradiance > 0.0).count();
    assert_eq!(outcome.row("lit")[1], lit.to_string());
    let (at, maximum) = visible
        .iter()
        .map(|&index| (index, map[index]))
        .fold((0, 0.0), |best, next| if next.1 > best.1 { next } else { best });
    let row = outcome.row("maximum");
    assert_eq!(row[1], format!("{maximum:.12}"));
    assert_eq!(row[5..8], [&format!("{},", at % 800), "row", &format!("{},", at / 800)]);
    #[expect(clippy::cast_precision_loss, reason = "few pixels")]
    let mean = visible.iter().map(|&index| map[index]).sum::<f64>() / visible.len() as f64;
    assert_eq!(outcome.row("mean")[1], format!("{mean:.12}"));
}

#[test]
fn the_symmetry_of_the_labs_scene_is_in_its_map() {
    // Sphere, eye and light are symmetric about the plane x = y: swapping x and y changes nothing.
    let folder =
        Folder::with("square.toml", crate::common::lab_with("x = [-4, 4], y = [-3, 3]", "x = [-3, 3], y = [-3, 3]"));
    folder.ok("render square.toml --size 60x60 -o map.npy");
    let (_, _, map) = npy(&folder.read("map.npy"));
    let swapped: Vec<f64> = (0..3600).map(|index| map[(59 - index % 60) * 60 + (59 - index / 60)]).collect();
    assert!(map.iter().any(|&brightness| brightness > 0.3));
    for (value, mirrored) in map.iter().zip(&swapped) {
        assert!((value - mirrored).abs() <= 1e-14, "{value:e} {mirrored:e}");
    }
}
