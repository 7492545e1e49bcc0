//! Scenes to start from.

use crate::common::{COURSE, Folder, LAB, PHOTOMETRIC, TWO_LIGHTS};

const STARTERS: [(&str, &str); 4] =
    [("lab", LAB), ("course", COURSE), ("two-lights", TWO_LIGHTS), ("photometric", PHOTOMETRIC)];

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
    Folder::new().run("new cornell").failed(2, &["cornell", "lab, course, two-lights, photometric"]);
    Folder::new().run("new").failed(2, &["<NAME>"]);
}
