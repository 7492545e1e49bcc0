//! Texts from scenes and files on a terminal: nothing in them moves the cursor, renames the window or turns the text around.

use std::fmt::Write;

use crate::common::{Folder, LAB, Outcome, lab_with};

/// What a malicious title does: it renames the window, clears the screen, turns the direction of the text, begins a line.
const TITLE: &str = r#"title = "a\u001b]0;x\u0007\u001b[2J\u202e\u009b31m\nmaximum 1""#;
const SHOWN: &str = r"a\u001B]0;x\u0007\u001B[2J\u202E\u009B31m\u000Amaximum 1";

fn is_harmless(text: &str) -> bool {
    !text.chars().any(|character| isophote::text::is_control(character) && !"\n\t".contains(character))
}

#[track_caller]
fn assert_harmless(outcome: &Outcome) {
    assert!(is_harmless(&outcome.stdout), "isophote {}\n{:?}", outcome.command, outcome.stdout);
    assert!(is_harmless(&outcome.stderr), "isophote {}\n{:?}", outcome.command, outcome.stderr);
}

#[test]
fn a_title_is_shown_with_its_control_characters_escaped() {
    let scene = lab_with("title = \"Lab 4: one sphere, one light\"", TITLE);
    let folder = Folder::with("lab.toml", &scene);
    let commands = [
        "render lab.toml --size 8x6 -o map.csv -o map.png -o map.npz -o map.exr --figure map.svg",
        "render lab.toml --size 8x6 -o map.zarr",
        "check lab.toml",
        "show map.exr",
        "show map.zarr",
        "merge map.zarr",
        "surface lab.toml --size 8x4",
    ];
    for command in commands {
        let outcome = folder.ok(command);
        assert_harmless(&outcome);
        assert!(outcome.stdout.contains(SHOWN), "{command}: {}", outcome.stdout);
    }
    for command in ["check lab.toml --json", "show map.png --json", "render lab.toml --size 8x6 --json"] {
        let outcome = folder.ok(command);
        assert_harmless(&outcome);
        assert!(outcome.json()["title"].as_str().unwrap().starts_with("a\u{1b}]0;x\u{7}"), "{command}");
    }
    folder.write("again.toml", folder.ok("show map.exr --scene").stdout);
    assert!(folder.ok("check again.toml").stdout.contains(SHOWN), "the scene itself is not changed");
}

#[test]
fn names_have_no_control_characters() {
    for name in ["a\\u001b[2J", "a\\u202e", "a\\u2066b", "a\\nb", "a\\u0085", ""] {
        for (from, to) in [("name = \"ball\"", "name = \"NAME\""), ("name = \"lamp\"", "name = \"NAME\"")] {
            let folder = Folder::with("lab.toml", lab_with(from, &to.replace("NAME", name)));
            let outcome =
                folder.run("check lab.toml").failed(3, &["is not usable", "without control and bidirectional"]);
            assert_harmless(&outcome);
        }
        let scene = LAB.replace("[material.clay]", &format!("[material.\"{name}\"]"));
        let folder = Folder::with("lab.toml", scene.replace("\"clay\"", &format!("\"{name}\"")));
        assert_harmless(&folder.run("check lab.toml").failed(3, &["is not usable"]));
    }
    let long = "я".repeat(501);
    let folder = Folder::with("lab.toml", lab_with("name = \"ball\"", &format!("name = \"{long}\"")));
    folder.run("check lab.toml").failed(3, &["is not usable", "up to 1000 bytes"]);
}

#[test]
fn mistakes_are_told_without_what_they_say_to_the_terminal() {
    for harm in ["\"\\u001b[2J\" = 1", "\"\u{202e}\" = 1", "convention = \"\\u001b[31m\"", "# \u{202e}\nx = [\u{2066}]"]
    {
        let folder = Folder::with("lab.toml", format!("{harm}\n{LAB}"));
        assert_harmless(&folder.run("check lab.toml").failed(3, &[]));
    }
}

/// A file says about itself what whoever made it wanted.
#[test]
fn show_escapes_what_a_file_says_about_itself() {
    let folder = Folder::new();
    folder.ok("render --size 4x3 -o map.csv");
    let harm = "\\u001b]0;x\\u0007\\u202e\u{9b}";
    let mut text = folder.text("map.csv");
    let said =
        ["isophote 0.1.0", "\"title\":\"", "\"convention\":\"", "\"renderer\":\"", "\"unit\":\"W", "\"name\":\"b"];
    for honest in said {
        assert!(text.contains(honest), "{honest}");
        text = text.replace(honest, &format!("{honest}{harm}"));
    }
    folder.write("map.csv", text);
    for command in ["show map.csv", "show map.csv --json", "render map.csv -o again.npz"] {
        let outcome = folder.run(command);
        assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
        assert_harmless(&outcome);
    }
}

#[test]
fn a_title_has_a_length_that_can_be_read_back() {
    let mut title = String::from("title = \"");
    write!(title, "{}\"", "x".repeat(10_001)).unwrap();
    let folder = Folder::with("lab.toml", lab_with("title = \"Lab 4: one sphere, one light\"", &title));
    folder.run("render lab.toml --size 4x3 -o map.exr").failed(3, &["`title` has 10001 bytes", "allowed: up to 10000"]);
}
