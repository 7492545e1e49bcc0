//! Scenes to start from.

use crate::common::{COURSE, Folder, LAB, PHOTOMETRIC, TWO_LIGHTS, assert_close};

const STARTERS: [(&str, &str); 6] = [
    ("lab", LAB),
    ("course", COURSE),
    ("course-sphere", include_str!("../../../../scenes/course-sphere.toml")),
    ("course-plane", include_str!("../../../../scenes/course-plane.toml")),
    ("two-lights", TWO_LIGHTS),
    ("photometric", PHOTOMETRIC),
];

/// With Russian comments and title, a starter is the same scene.
#[test]
fn a_starter_has_comments_in_the_language_asked_for() {
    for (name, text) in STARTERS {
        let folder = Folder::new();
        folder.ok(&format!("new {name} --lang ru"));
        folder.write("english.toml", text);
        let russian = folder.text(&format!("{name}.toml"));
        let is_cyrillic = |letter: char| ('а'..='я').contains(&letter);
        assert!(russian.contains(is_cyrillic) && !text.contains(is_cyrillic), "{name}");
        assert_eq!(russian.lines().count(), text.lines().count(), "{name}");
        for text in [russian.as_str(), text] {
            assert!(text.starts_with("#:schema scene.schema.json\n"), "{name}");
        }
        let [mut one, mut other] = [format!("{name}.toml"), "english.toml".into()]
            .map(|file| folder.ok(&format!("check {file} --json")).json());
        assert_ne!(one["title"], other["title"]);
        for scene in [&mut one, &mut other] {
            scene["title"].take();
        }
        assert_eq!(one, other, "{name}");
    }
    Folder::new().run("new lab --lang de").failed(2, &["en, ru"]);
}

/// The sphere appears in the middle, and as large as (5.6) says: f R/√(D² − R²) = 242.7 mm of 400.
#[test]
fn the_courses_sphere_is_seen_from_above_and_not_mirrored() {
    let folder = Folder::new();
    folder.ok("new course-sphere");
    let json = folder.ok("section course-sphere.toml --through ball --samples 801 --json").json();
    let radius = 1500.0 * 300.0 / f64::sqrt(1900.0 * 1900.0 - 300.0 * 300.0);
    for section in json["sections"].as_array().unwrap() {
        let seen = section["channels"][0]["values"].as_array().unwrap().iter().filter(|value| !value.is_null()).count();
        assert!((f64::from(u32::try_from(seen).unwrap()) - 2.0 * radius).abs() <= 1.0, "{seen} {radius}");
    }
    // +x is on the right, +y on top.
    let probes = folder.ok("probe course-sphere.toml --pixel 400,300 --pixel 300,200 --json").json();
    assert!(probes["probes"][0]["point"][0].as_f64().unwrap() > 100.0);
    assert!(probes["probes"][1]["point"][1].as_f64().unwrap() > 100.0);
}

/// (5.4) in the probes and in the extremes of the circle: the lamp's foot is in it, the farthest point is opposite.
#[test]
fn the_courses_plane_has_the_values_of_the_closed_form() {
    let folder = Folder::new();
    folder.ok("new course-plane");
    let json = folder.ok("render course-plane.toml --json --quiet").json();
    let irradiance = |x: f64, y: f64| {
        let squared = (x - 0.1).powi(2) + (y - 0.05).powi(2) + 1.0;
        1000.0 / (squared * squared)
    };
    let probes = json["probes"].as_array().unwrap();
    for (probe, (x, y)) in probes.iter().zip([(0.0, 0.0), (0.3, 0.0), (0.0, 0.3), (-0.3, 0.0), (0.0, -0.3)]) {
        assert_close(probe["channels"]["irradiance"]["value"].as_f64().unwrap(), irradiance(x, y), 1e-14);
    }
    let area = &json["areas"][0];
    assert_eq!((&area["name"], &area["on"], &area["unit"]), (&"circle".into(), &"floor".into(), &"W/m²".into()));
    assert_close(area["max"]["value"].as_f64().unwrap(), 1000.0, 1e-14);
    let foot = f64::hypot(0.1, 0.05);
    assert_close(area["min"]["value"].as_f64().unwrap(), irradiance(-0.3 * 0.1 / foot, -0.3 * 0.05 / foot), 1e-13);
    assert!((area["max"]["point"][0].as_f64().unwrap() - 100.0).abs() < 1e-4);
    assert_eq!((&area["visible"], &area["max"]["seen"]), (&1.into(), &true.into()));
    let mean = area["mean"].as_f64().unwrap();
    assert!(mean < 1000.0 && mean > 800.0 && area["mean_error"].as_f64().unwrap() < 1e-9);
    let text = folder.ok("render course-plane.toml --quiet").stdout;
    for part in ["area    maximum of B (3.1), W/m²  at, mm", "circle", "(100, 50, 0)"] {
        assert!(text.contains(part), "{part:?} is not in\n{text}");
    }
}

#[test]
fn each_starter_is_written_under_its_name_and_warns_of_nothing_but_missing_shadows() {
    for (name, text) in STARTERS {
        let folder = Folder::new();
        assert_eq!(folder.ok(&format!("new {name}")).stdout, format!("{name}.toml\n"));
        assert_eq!(folder.names(), [format!("{name}.toml")]);
        assert_eq!(folder.text(&format!("{name}.toml")), text, "the file that is in scenes/");
        let warnings = folder.ok(&format!("check {name}.toml")).stderr;
        assert_eq!(warnings.matches("warning:").count(), usize::from(name == "two-lights"), "{warnings}");
        assert_eq!(warnings.contains("cast no shadows on each other"), name == "two-lights");
        folder.ok(&format!("render {name}.toml --size 16x12 -o map.png"));
    }
}

#[test]
fn the_embedded_scene_and_the_lab_starter_are_one() {
    let folder = Folder::new();
    folder.ok("new lab");
    folder.ok("render lab.toml -o named.png");
    folder.ok("");
    assert_eq!(folder.read("named.png"), folder.read("lab.png"));
}

#[test]
fn an_existing_file_is_overwritten_only_by_force() {
    let folder = Folder::with("lab.toml", "my own scene");
    folder.run("new lab").failed(2, &["lab.toml exists; --force overwrites it"]);
    assert_eq!(folder.text("lab.toml"), "my own scene");
    folder.ok("new lab --force");
    assert_eq!(folder.text("lab.toml"), LAB);
    assert_eq!(folder.names(), ["lab.toml"]);
}

#[test]
fn a_starter_goes_where_it_is_told_to_go() {
    let folder = Folder::new();
    let outcome = folder.ok("new course -o -");
    assert_eq!(outcome.stdout, COURSE);
    assert!(folder.names().is_empty());
    assert_eq!(folder.ok("new course -o mine.scene").stdout, "mine.scene\n");
    assert_eq!(folder.text("mine.scene"), COURSE);
    folder.run("new course -o none/mine.toml").failed(1, &["there is no folder ‘none’"]);
    folder.run("new course --force -o .").failed(1, &["it is a folder"]);
}

#[test]
fn an_unknown_starter_is_refused_with_the_list() {
    Folder::new()
        .run("new cornell")
        .failed(2, &["cornell", "lab, course, course-sphere, course-plane, two-lights, photometric"]);
    Folder::new().run("new").failed(2, &["<NAME>"]);
}
