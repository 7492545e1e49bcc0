//! Scenes as large as the limits allow, and texts that are meant to take long: without the bounds that are tested here, each of
//! these tests would run for minutes.

use std::fmt::Write;

use isophote::scene::{Scene, SceneError, Syntax};

const HEAD: &str = r#"version = 1
length = "m"
convention = "lambert"
shadows = true

[camera]
eye = [0, 0, -1000]
target = [0, 0, 0]
field_of_view = 40
resolution = [40, 30]

[material.clay]
diffuse = 0.5
"#;

fn read(text: &str) -> Result<Scene, SceneError> {
    Scene::from_text("large.toml", text, Syntax::Toml)
}

/// Numbers that are spread between -100 and 100, the same on every run.
fn place(index: u32) -> [f64; 3] {
    [0.754_877_666, 0.569_840_29, 0.430_159_71].map(|step: f64| (f64::from(index) * step).fract() * 200.0 - 100.0)
}

fn sphere(text: &mut String, center: [f64; 3], radius: f64, material: &str) {
    writeln!(text, "[[sphere]]\ncenter = {center:?}\nradius = {radius}\nmaterial = \"{material}\"").unwrap();
}

fn light(text: &mut String, position: [f64; 3]) {
    writeln!(text, "[[light]]\nposition = {position:?}\nintensity = 1").unwrap();
}

/// 1.6·10⁹ pairs of a light and a shape.
#[test]
fn lights_are_compared_with_the_shapes_around_them_alone() {
    let mut text = HEAD.to_owned();
    for index in 0..40_000 {
        sphere(&mut text, place(index), 0.01, "clay");
        light(&mut text, place(1_000_000 + index).map(|coordinate| coordinate + 0.5));
    }
    // In the middle of one sphere, and on another one.
    light(&mut text, place(17));
    let on = place(18);
    let scene = read(&text).unwrap_or_else(|error| panic!("{error}"));
    let words = scene.warnings().iter().find(|warning| warning.path == "light[40000].position").expect("it is inside");
    assert!(
        words.message.to_string().contains("the light \"light[40000]\" is inside \"sphere[17]\""),
        "{}",
        words.message
    );
    light(&mut text, [on[0] + 0.01, on[1], on[2]]);
    let error = read(&text).expect_err("a light is on a sphere");
    assert_eq!(error.problems.len(), 1, "{error}");
    assert!(error.problems[0].message.to_string().contains("is on the surface of \"sphere[18]\""), "{error}");
}

/// The eye is in a room, and every light outside of it.
#[test]
fn lights_outside_the_room_of_the_eye_are_told_once_each() {
    let mut text = HEAD.replace("-1000", "0.5");
    sphere(&mut text, [0.0; 3], 2.0, "clay");
    for index in 0..2000 {
        sphere(&mut text, place(index).map(|coordinate| coordinate + 500.0), 0.01, "clay");
        light(&mut text, place(index).map(|coordinate| coordinate - 500.0));
    }
    let scene = read(&text).unwrap_or_else(|error| panic!("{error}"));
    let outside = |path: &str| path.starts_with("light[") && path.ends_with("].position");
    let told = scene.warnings().iter().filter(|warning| outside(&warning.path)).count();
    assert!((900..=1000).contains(&told), "{told}");
    let more = scene.warnings().last().unwrap();
    assert!(more.message.to_string().ends_with("more were found and are not listed"), "{}", more.message);
}

#[test]
fn materials_are_found_by_their_names_at_once() {
    let mut text = HEAD.to_owned();
    for index in 0..40_000 {
        writeln!(text, "[material.m{index}]\ndiffuse = 0.5").unwrap();
    }
    for index in 0..40_000 {
        sphere(&mut text, place(index), 0.01, &format!("m{}", 39_999 - index));
    }
    let scene = read(&text).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene.shapes()[0].material.map(|index| scene.materials()[index].name.as_str()), Some("m39999"));
    let misspelt = text.replace("material = \"m", "material = \"n");
    let error = read(&misspelt).expect_err("there are no such materials");
    assert_eq!(error.problems.len(), 1001);
    assert_eq!(error.problems[1000].message.to_string(), "39000 more were found and are not listed");
    assert!(
        error.problems[999].help.as_ref().is_some_and(|help| help.to_string().len() < 400),
        "{:?}",
        error.problems[999].help
    );
}

#[test]
fn probes_are_compared_with_the_shapes_around_them_alone() {
    let mut text = HEAD.to_owned();
    for index in 0..20_000 {
        let [x, y, z] = place(index);
        sphere(&mut text, [x, y, z], 0.01, "clay");
        writeln!(text, "[[probe]]\nat = [{x:?}, {y:?}, {:?}]", z - 0.01).unwrap();
    }
    let scene = read(&text).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene.probes().len(), 20_000);
    writeln!(text, "[[probe]]\nat = [0, 0, 5000]").unwrap();
    let error = read(&text).expect_err("a probe is nowhere");
    assert!(
        error.problems[0].help.as_ref().is_some_and(|help| help.to_string().contains("the nearest point there")),
        "{error}"
    );
}

#[test]
fn what_is_nested_too_deep_is_told_with_its_place() {
    for (name, syntax, text) in [
        ("deep.toml", Syntax::Toml, format!("version = 1\nx = {}{}", "[".repeat(100), "]".repeat(100))),
        ("deep.toml", Syntax::Toml, format!("version = 1\nx = {}1{}", "{ a = ".repeat(100), "}".repeat(100))),
        ("deep.json", Syntax::Json, format!("{{\"version\": 1,\n\"x\": {}{}}}", "[".repeat(100), "]".repeat(100))),
        ("deep.json", Syntax::Json, format!("{{\"version\": 1,\n\"x\": {}{}}}", "[".repeat(1_000_000), "")),
    ] {
        let error = Scene::from_text(name, &text, syntax).expect_err("it is too deep");
        let problem = &error.problems[0];
        assert!(problem.message.to_string().starts_with("brackets are nested more than 32 deep"), "{error}");
        assert_eq!(problem.place.as_ref().map(|place| place.line), Some(2));
    }
    // Brackets in texts and comments are none.
    let text = format!(
        "title = \"{0}\" # {0}\n{HEAD}\n[[sphere]]\nname = '{0}\"'\nmaterial = \"clay\"\ncenter = [0,0,0]\nradius = 1",
        "[".repeat(100)
    );
    read(&text).unwrap_or_else(|error| panic!("{error}"));
}

/// All on one line, where a column is counted from the line's start, and each key looked up in its table.
#[test]
fn very_many_mistakes_on_one_line_are_counted() {
    let keys: Vec<String> = (0..100_000).map(|index| format!("\"k{index}\": 1")).collect();
    let text = format!("{{\"version\": 1, \"length\": \"m\", {}}}", keys.join(", "));
    let error = Scene::from_text("long.json", &text, Syntax::Json).expect_err("no such keys");
    assert_eq!(error.problems.len(), 1001);
    assert!(error.problems[1000].message.to_string().ends_with(" more were found and are not listed"));
    let text = "=\n".repeat(200_000);
    let error = Scene::from_text("wrong.toml", &text, Syntax::Toml).expect_err("it is not TOML");
    assert_eq!(error.problems.len(), 1, "what follows is a consequence");
}

/// There is one at every second byte; the parser kept them all, at 300 bytes each.
#[test]
fn only_the_first_of_very_many_syntax_problems_is_kept() {
    let wrong_lines = "=\n".repeat(2_000_000);
    let duplicates = "a = 1\n".repeat(700_000);
    let in_json = format!("{{{}\"a\": 1}}", "\"a\": 1,".repeat(500_000));
    for (text, syntax, line, word) in [
        (format!("version = 1\n{wrong_lines}"), Syntax::Toml, 2, "not valid TOML"),
        (format!("version = 1\n{duplicates}"), Syntax::Toml, 3, "duplicate key"),
        (in_json, Syntax::Json, 1, "stands twice"),
    ] {
        let error = Scene::from_text("wrong", &text, syntax).expect_err("it is wrong");
        let [problem] = error.problems.as_slice() else { panic!("{} problems", error.problems.len()) };
        assert!(problem.message.to_string().contains(word), "{error}");
        assert!(
            problem.help.as_ref().is_some_and(|help| help.to_string().contains("mend it and check again")),
            "{error}"
        );
        assert_eq!(problem.place.as_ref().map(|place| place.line), Some(line));
    }
}

/// A text of ordinary length is read on after a mistake, and one without mistakes always.
#[test]
fn all_mistakes_are_found_beside_a_violation_of_the_syntax() {
    let text = format!("{HEAD}diffuse = 0.7\nspecular = -1\n");
    let error = read(&text).expect_err("it has two mistakes");
    assert_eq!(error.problems.len(), 2, "{error}");
    let text =
        format!("{HEAD}# {}\n[[sphere]]\ncenter = [0, 0, 5]\nradius = 1\nmaterial = \"clay\"\n", "=".repeat(1 << 20));
    read(&text).unwrap_or_else(|error| panic!("{error}"));
}
