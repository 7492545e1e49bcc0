//! What files carry: they say what they are, and the scene in them makes them again.

use crate::common::{COURSE, Folder, LAB, TWO_LIGHTS};

const SUFFIXES: [&str; 5] = ["png", "exr", "npy", "npz", "csv"];

#[test]
fn show_tells_of_every_format_what_it_is() {
    let folder = Folder::with("course.toml", COURSE);
    for suffix in SUFFIXES {
        folder.ok(&format!("render course.toml --size 32x24 --region 4,6,20,10 -o map.{suffix} -q"));
        let shown = folder.ok(&format!("show map.{suffix}"));
        assert!(
            shown.stdout.contains("  title       Course: a sphere under two Lambertian lamps\n"),
            "{}",
            shown.stdout
        );
        assert_eq!(shown.row("convention")[1..], ["course", "(3.4)"], "{suffix}");
        assert_eq!(shown.row("image")[1..], ["32", "×", "24", "pixels"], "{suffix}");
        assert_eq!(shown.row("region")[1..], ["20", "×", "10", "from", "column", "4,", "row", "6"], "{suffix}");
        assert_eq!(shown.row("window")[1..], ["x", "-300", "to", "200,", "y", "-133.333333", "to", "200", "mm"]);
        assert!(shown.stdout.contains("  channel     brightness, W/(m²·sr)"), "{suffix}: {}", shown.stdout);
        assert!(shown.stdout.contains("\nscene\n  version = 1\n"), "{suffix}");
    }
}

#[test]
fn show_tells_how_a_picture_was_made() {
    let folder = Folder::new();
    folder.ok("render --size 8x6 --range 0,0.25 --colormap viridis --gamma 2 -o map.png");
    let shown = folder.ok("show map.png");
    assert!(shown.stdout.contains("0 to 0.25 from black to white, 8 bits, gamma 2"), "{}", shown.stdout);
    assert_eq!(shown.row("colours")[1..], ["viridis"]);
}

#[test]
fn show_json_can_be_parsed_and_has_the_scene() {
    let folder = Folder::new();
    folder.ok("render --size 8x6 --lights -o map.exr");
    let json = folder.ok("show map.exr --json").json();
    assert_eq!((&json["isophote"], &json["title"]), (&1.into(), &"Lab 4: one sphere, one light".into()));
    assert_eq!(json["full"], serde_json::json!({"width": 8, "height": 6}));
    let lamp = json["channels"].as_array().unwrap().iter().find(|channel| channel["name"] == "light.lamp").unwrap();
    assert_eq!(lamp, &serde_json::json!({"name": "light.lamp", "unit": "W/m²", "stored_as": ["light.lamp.Y"]}));
    assert!(json["scene"].as_str().unwrap().contains("radius = 1.0"));
}

#[test]
fn the_scene_in_a_file_renders_the_same_bytes_again() {
    for (name, scene) in [("lab", LAB), ("course", COURSE), ("two", TWO_LIGHTS)] {
        let folder = Folder::with("scene.toml", scene);
        for suffix in SUFFIXES {
            folder.ok(&format!("render scene.toml --size 40x30 -o first.{suffix} -q"));
            let carried = folder.ok(&format!("show first.{suffix} --scene")).stdout;
            folder.write("again.toml", &carried);
            folder.ok(&format!("render again.toml -o second.{suffix} -q"));
            assert!(
                folder.read(&format!("first.{suffix}")) == folder.read(&format!("second.{suffix}")),
                "{name} {suffix}"
            );
            let understood = folder.ok("check again.toml").stdout;
            assert!(understood.contains("40 × 30 pixels"), "the size that was asked for is part of it");
        }
    }
}

#[test]
fn an_output_file_can_stand_for_its_scene() {
    let folder = Folder::with("course.toml", COURSE);
    let first = folder.ok("render course.toml --size 40x40 -o map.exr");
    for suffix in SUFFIXES {
        folder.ok(&format!("render map.exr -o other.{suffix} -q"));
        let again = folder.ok(&format!("render other.{suffix} -o again.exr"));
        assert_eq!(first.stdout, again.stdout, "{suffix}");
        assert!(folder.read("map.exr") == folder.read("again.exr"), "{suffix}");
    }
    assert_eq!(folder.ok("probe map.exr").stdout, folder.ok("probe course.toml").stdout);
    folder.ok("render map.exr -o map.exr -q");
    assert!(folder.read("map.exr") == folder.read("again.exr"), "even written over itself");
}

#[test]
fn foreign_and_damaged_files_are_refused_with_a_word_about_why() {
    let folder = Folder::new();
    let file = std::fs::File::create(folder.path("foreign.png")).unwrap();
    let mut writer = png::Encoder::new(file, 4, 4).write_header().unwrap();
    writer.write_image_data(&[0; 16]).unwrap();
    writer.finish().unwrap();
    folder.run("show foreign.png").failed(1, &["‘foreign.png’ (png) carries no Isophote metadata"]);
    folder.run("render foreign.png -o map.csv").failed(3, &["carries no Isophote metadata"]);
    folder.write("notes.txt", "some notes");
    folder.run("show notes.txt").failed(1, &["is no PNG, EXR, NPY, NPZ or CSV file of Isophote"]);
    folder.run("show none.exr").failed(1, &["none.exr", "No such file"]);
    for suffix in SUFFIXES {
        let name = format!("map.{suffix}");
        folder.ok(&format!("render --size 4x3 -o {name} -q"));
        let bytes = folder.read(&name);
        folder.write(&name, &bytes[..bytes.len().min(200)]);
        let outcome = folder.run(&format!("show {name}"));
        assert_eq!((outcome.code, outcome.stdout.as_str()), (Some(1), ""), "{name}");
        assert!(outcome.stderr.starts_with(&format!("error: ‘{name}’ (")), "{}", outcome.stderr);
        std::fs::remove_file(folder.path(&name)).unwrap();
    }
    assert_eq!(folder.names(), ["foreign.png", "notes.txt"]);
}

#[test]
fn a_figure_in_png_carries_its_scene_too() {
    let folder = Folder::new();
    folder.ok("render --figure figure.png -o lab.png");
    folder.ok("render figure.png -o again.png");
    assert_eq!(folder.read("again.png"), folder.read("lab.png"));
    assert!(folder.ok("show figure.png").stdout.contains("brightness, W/m²"));
}
