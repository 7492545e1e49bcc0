//! The scene as it is understood, and what deserves a warning.

use crate::common::{COURSE, Folder, LAB, PHOTOMETRIC, ROOM, TWO_LIGHTS, assert_close, lab_with};

fn checked(scene: &str) -> String {
    let outcome = Folder::with("scene.toml", scene).ok("check scene.toml");
    assert_eq!(outcome.stderr, "", "nothing deserves a warning");
    outcome.stdout
}

#[test]
fn the_labs_scene_as_text() {
    insta::assert_snapshot!(checked(LAB));
    assert_eq!(Folder::new().ok("check").stdout, checked(LAB), "the scene that is used when none is named");
}

#[test]
fn the_course_scene_as_text_in_metres() {
    insta::assert_snapshot!(checked(COURSE));
}

#[test]
fn the_photometric_scene_as_text() {
    insta::assert_snapshot!(checked(PHOTOMETRIC));
}

#[test]
fn a_scene_as_json_has_every_default_filled_in() {
    let scene = "version = 1\nlength = \"cm\"\n[camera]\neye = [0, 0, 100]\ntarget = [0, 0, 0]\nscreen = { distance = 50, x = [-40, 40], y = [-30, 30] }\n\
                 [material.chalk]\ndiffuse = 0.9\n[[sphere]]\ncenter = [0, 0, 0]\nradius = 10\nmaterial = \"chalk\"\n[[light]]\nposition = [0, 100, 100]\npower = 5\n";
    let outcome = Folder::with("scene.toml", scene).ok("check scene.toml --json");
    insta::assert_snapshot!(outcome.stdout);
}

#[test]
fn json_is_in_metres_and_watts_per_steradian() {
    let folder = Folder::with("course.toml", COURSE);
    let json = folder.ok("check course.toml --json").json();
    assert_eq!((&json["length"], &json["length_in_file"]), (&"m".into(), &"mm".into()));
    assert_eq!(json["shapes"][0]["radius"], 0.3);
    assert_eq!(json["camera"]["eye"], serde_json::json!([0, 0, -1]));
    assert_eq!(
        (&json["convention"], &json["formula"], &json["unit"]),
        (&"course".into(), &"3.4".into(), &"W/(m²·sr)".into())
    );
    let [key, fill] = [0, 1].map(|light| &json["lights"][light]);
    assert_close(key["power"].as_f64().unwrap(), 1000.0 * std::f64::consts::PI, 1e-15);
    assert_close(fill["intensity"].as_f64().unwrap(), 600.0 / std::f64::consts::PI, 1e-15);
    let axis: Vec<f64> = fill["axis"].as_array().unwrap().iter().map(|component| component.as_f64().unwrap()).collect();
    assert_close(axis[0], 2.0 * axis[2], 1e-15);
    assert_close(axis.iter().map(|component| component * component).sum(), 1.0, 1e-15);
    let photometric = Folder::with("photometric.toml", PHOTOMETRIC).ok("check photometric.toml --json").json();
    assert_eq!((&photometric["quantities"], &photometric["unit"]), (&"photometric".into(), &"cd/m²".into()));
    assert_eq!((&photometric["length_in_file"], &photometric["handedness"]), (&"cm".into(), &"right".into()));
    let lab = Folder::new().ok("check --json").json();
    assert_close(lab["lights"][0]["power"].as_f64().unwrap(), 400.0 * std::f64::consts::PI, 1e-15);
    assert_eq!(lab["probes"][3]["published"], 0.66);
    assert_eq!(lab["camera"]["right"], serde_json::json!([1, 0, 0]), "left-handed: right = up × forward");
}

#[test]
fn the_same_scene_in_json_is_understood_the_same() {
    let json = r#"{"version": 1, "title": "Lab 4: one sphere, one light", "length": "m", "handedness": "left", "convention": "lab",
        "camera": {"eye": [0, 0, 0], "forward": [0, 0, 1], "up": [0, 1, 0], "screen": {"distance": 5, "x": [-4, 4], "y": [-3, 3]}, "resolution": [800, 600]},
        "material": {"clay": {"diffuse": 0.7, "specular": 0.3, "shininess": 20}},
        "sphere": [{"name": "ball", "center": [0, 0, 5], "radius": 1, "material": "clay"}],
        "light": [{"name": "lamp", "position": [5, 5, -10], "intensity": 100}],
        "probe": [{"name": "P1", "at": [0, 0, 4], "published": 0.60}]}"#;
    let folder = Folder::with("lab.json", json);
    let (head, _) = LAB.split_once("[[probe]]\nname = \"P2\"").unwrap();
    folder.write("lab.toml", head);
    let understood = folder.ok("check lab.json").stdout;
    assert_eq!(understood, folder.ok("check lab.toml").stdout);
    assert_eq!(understood, folder.run_with("check -", json.as_bytes()).succeeded().stdout, "standard input takes JSON");
    assert_eq!(understood, folder.run_with("check -", head.as_bytes()).succeeded().stdout, "and TOML");
}

#[test]
fn what_deserves_a_warning_is_said_with_its_line_and_the_scene_is_used() {
    let folder = Folder::with("room.toml", ROOM);
    let outcome = folder.ok("check room.toml");
    insta::assert_snapshot!(outcome.stderr);
    assert_eq!(outcome.row("room")[1], "sphere");
    assert_eq!(folder.ok("check room.toml --quiet").stderr, "");
    let json = folder.ok("check room.toml --json -q").json();
    let paths: Vec<&str> =
        json["warnings"].as_array().unwrap().iter().map(|warning| warning["path"].as_str().unwrap()).collect();
    assert_eq!(paths, ["material.plaster", "light[1].position", "material.spare", "camera.resolution"]);
    assert_eq!(json["warnings"][3]["line"], 10);
}

#[test]
fn warnings_are_for_what_they_name() {
    let warned = |scene: &str, words: &str| {
        let outcome = Folder::with("scene.toml", scene).ok("check scene.toml");
        assert!(outcome.stderr.contains(words), "no {words:?} in {}", outcome.stderr);
        assert_eq!(outcome.stderr.matches("warning:").count(), 1, "{}", outcome.stderr);
    };
    warned(&lab_with("[800, 600]", "[800, 601]"), "pixels are not square");
    let (dark, _) = LAB.split_once("[[light]]").unwrap();
    warned(dark, "the scene has no lights: all is black");
    // --size can stretch pixels too.
    let outcome = Folder::with("two.toml", TWO_LIGHTS).ok("render two.toml --size 80x80 -o map.png");
    assert!(outcome.stderr.contains("pixels are not square"), "{}", outcome.stderr);
}
