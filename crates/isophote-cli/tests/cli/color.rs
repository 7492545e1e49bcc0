//! Scenes with colours, from the file to every output.

use png::{BitDepth, ColorType};
use serde_json::json;

use crate::common::{Folder, assert_close, lab_with, npy};

const COLOR: &str = include_str!("../../../../scenes/color.toml");

/// The lab's scene with a coloured lamp and a reddish ball.
fn lab() -> String {
    lab_with("intensity = 100", "intensity = [100, 50, 25]")
        .replace("diffuse = 0.7", "diffuse = [0.7, 0.35, 0.0]")
        .replace("resolution = [800, 600]", "resolution = [40, 30]")
}

#[test]
fn without_a_channel_the_colours_are_written() {
    let folder = Folder::with("lab.toml", lab());
    folder.ok("render lab.toml -o a.png -o a.exr -o a.npy -o a.csv -o a.npz --figure a.svg --quiet");
    let picture = folder.picture("a.png");
    assert_eq!((picture.color, picture.depth), (ColorType::Rgb, BitDepth::Eight));
    let (kind, shape, colors) = npy(&folder.read("a.npy"));
    assert_eq!((kind.as_str(), shape.as_slice()), ("<f8", [30, 40, 3].as_slice()));
    let table = folder.csv("a.csv");
    let (red, green, blue) = (table.column("color.r"), table.column("color.g"), table.column("color.b"));
    for (index, luminance) in table.column("brightness").into_iter().enumerate() {
        assert_eq!(colors[3 * index..][..3], [red[index], green[index], blue[index]]);
        let weighted = 0.212_639_005_87 * red[index] + 0.715_168_678_77 * green[index] + 0.072_192_315_36 * blue[index];
        assert_close(luminance, weighted, 1e-10);
    }
    let text = folder.text("a.svg");
    assert!(text.contains("rec709") && !text.contains("isophote-label"));
    folder.ok("render lab.toml -c brightness -o grey.png --quiet");
    let picture = folder.picture("grey.png");
    assert_eq!((picture.color, picture.depth), (ColorType::Grayscale, BitDepth::Eight));
}

#[test]
fn a_file_of_colours_says_their_space_and_renders_again() {
    let folder = Folder::with("lab.toml", lab());
    folder.ok("render lab.toml -o a.png -o a.exr -o a.csv --quiet");
    for name in ["a.png", "a.exr", "a.csv"] {
        let shown = folder.ok(&format!("show {name}")).stdout;
        assert!(shown.contains("color space rec709"), "{shown}");
        assert_eq!(folder.ok(&format!("show {name} --json")).json()["color_space"], "rec709");
    }
    assert!(folder.ok("show a.png").stdout.contains("8 bits, sRGB"));
    folder.ok("render a.exr -o b.png --quiet");
    assert_eq!(folder.read("a.png"), folder.read("b.png"));
}

#[test]
fn a_probe_has_its_components_and_their_luminance() {
    let folder = Folder::with("lab.toml", lab());
    let json = folder.ok("probe lab.toml --at 0,0,4 --json").json();
    assert_eq!(json["color_space"], "rec709");
    let probe = &json["probes"][0];
    let rgb = |value: &serde_json::Value| -> Vec<f64> { serde_json::from_value(value.clone()).unwrap() };
    let irradiance = rgb(&probe["lights"][0]["irradiance_rgb"]);
    assert_eq!((irradiance[0], irradiance[1]), (4.0 * irradiance[2], 2.0 * irradiance[2]));
    assert_eq!(probe["channels"]["irradiance"]["rgb"], json!(irradiance));
    let diffuse = rgb(&probe["channels"]["diffuse"]["rgb"]);
    assert_close(diffuse[0], 4.0 * diffuse[1], 1e-15);
    assert_eq!(diffuse[2], 0.0);
    let luminance = probe["channels"]["diffuse"]["value"].as_f64().unwrap();
    assert_close(luminance, 0.212_639_005_87 * diffuse[0] + 0.715_168_678_77 * diffuse[1], 1e-10);
    assert_eq!(probe["lights"][0]["diffuse"], probe["channels"]["diffuse"]["value"]);
    let text = folder.ok("probe lab.toml --at 0,0,4");
    let row = |name| text.row(name)[1].parse::<f64>().unwrap();
    // The table has 15 digits.
    assert_close(row("red"), 4.0 * row("blue"), 1e-14);
}

#[test]
fn every_component_is_explained_and_their_sum() {
    let folder = Folder::with("lab.toml", lab());
    insta::assert_snapshot!(folder.ok("probe lab.toml --at 0,0,4 --explain").stdout);
}

#[test]
fn a_scene_with_colours_is_checked_with_them() {
    let folder = Folder::with("color.toml", COLOR);
    insta::assert_snapshot!(folder.ok("check color.toml").stdout);
    let json = folder.ok("check color.toml --json").json();
    assert_eq!(json["color_space"], "rec709");
    assert_eq!(json["lights"][0]["intensity"], json!([9, 6.2, 3.6]));
    assert_eq!(json["ambient"]["radiance"], json!([0.16, 0.18, 0.21]));
    let white = json["materials"].as_array().unwrap().iter().find(|material| material["name"] == "white").unwrap();
    assert_eq!(white["diffuse"], 0.75);
}

#[test]
fn what_colours_do_not_go_with_is_said() {
    let folder = Folder::with("lab.toml", lab());
    folder.run("render -c color -o a.png").failed(2, &["there is no channel `color`", "[R, G, B]"]);
    folder.run("render lab.toml -o a.png --colormap viridis").failed(2, &["--colormap", "`color`", "-c brightness"]);
    folder.run("render lab.toml -o a.png --gamma 2").failed(2, &["--gamma", "sRGB"]);
    folder.run("section lab.toml --row 15 -c color").failed(2, &["a section cannot show `color`"]);
    folder
        .run("grid lab.toml --center 0,0,3 --u 1,0,0 --v 0,1,0 --points 2x2 -c color")
        .failed(2, &["no channel `color`"]);
    let note = folder.ok("render lab.toml --figure a.svg --isophotes 3").stderr;
    assert!(note.contains("--isophotes has no effect"), "{note}");
    assert_eq!(folder.names(), ["a.svg", "lab.toml"]);
}

#[test]
fn surfaces_and_stores_hold_colours_too() {
    let folder = Folder::with("lab.toml", lab());
    folder.ok("surface lab.toml -c color -o a.csv --figure a.png --size 12x6 --quiet");
    assert!(folder.csv("a.csv").column("color.r").iter().any(|red| *red > 0.0));
    let summary = folder.ok("render lab.toml -o a.zarr --shard-side 32 --quiet").stdout;
    assert!(summary.contains("color space rec709, Y = 0.2126 R"), "{summary}");
    let group: serde_json::Value = serde_json::from_slice(&folder.read("a.zarr/zarr.json")).unwrap();
    assert_eq!(group["attributes"]["color_space"], "rec709");
    let array = &group["consolidated_metadata"]["metadata"]["color"];
    assert_eq!(array["shape"], json!([30, 40, 3]));
    assert_eq!(array["attributes"]["components"], json!(["red", "green", "blue"]));
}

#[test]
fn single_precision_and_smooth_edges_have_colours() {
    let folder = Folder::with("lab.toml", lab());
    folder.ok("render lab.toml -o double.npy --quiet");
    folder.ok("render lab.toml -o single.npy --precision single --quiet");
    folder.ok("render lab.toml -o smooth.npy --tolerance 0.01 --quiet");
    let read = |name: &str| npy(&folder.read(name)).2;
    let (double, single, smooth) = (read("double.npy"), read("single.npy"), read("smooth.npy"));
    let largest = double.iter().copied().fold(0.0, f64::max);
    assert!(double.iter().zip(&single).all(|(double, single)| (double - single).abs() <= 3e-6 * largest));
    assert_ne!(smooth, double);
}
