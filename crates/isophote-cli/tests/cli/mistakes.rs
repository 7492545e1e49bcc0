//! Scenes that cannot be used: exit code 3, a word about why, and nothing written.

use crate::common::{Folder, LAB, lab_with};

/// Renders a scene into a folder where `map.csv` stands already: refused, and the folder is left as it was.
#[track_caller]
fn refused(folder: &Folder, scene: &str, stdin: &[u8], words: &[&str]) -> String {
    folder.write("map.csv", "old numbers");
    let before = folder.names();
    let outcome =
        folder.run_with(&format!("render {scene} -o map.csv -o map.png --figure map.svg"), stdin).failed(3, words);
    assert!(
        outcome
            .stderr
            .ends_with(&format!(" in {}; nothing was written\n", if scene == "-" { "standard input" } else { scene })),
        "{}",
        outcome.stderr
    );
    assert_eq!(folder.text("map.csv"), "old numbers");
    assert_eq!(folder.names(), before);
    outcome.stderr
}

#[test]
fn a_missing_file() {
    refused(&Folder::new(), "none.toml", b"", &["error: none.toml: there is no such file", "1 problem in none.toml"]);
    refused(&Folder::new(), "none.exr", b"", &["none.exr", "No such file"]);
}

#[test]
fn a_directory() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("scene.toml")).unwrap();
    refused(&folder, "scene.toml", b"", &["scene.toml: this is a directory, not a scene file"]);
    refused(&folder, ".", b"", &["this is a directory, not a scene file"]);
}

#[test]
fn a_binary_file() {
    let folder = Folder::with("scene.toml", [0x7f, b'E', b'L', b'F', 2, 1, 1, 0, 0xC3, 0x28, b'\n', 0xFF]);
    refused(&folder, "scene.toml", b"", &["not a text in UTF-8: byte 0xC3 at offset 8, line 1"]);
}

#[test]
fn an_empty_file() {
    let folder = Folder::with("scene.toml", "");
    refused(&folder, "scene.toml", b"", &["the scene is empty", "`isophote new lab` writes a scene to start from"]);
    refused(&Folder::new(), "-", b"", &["standard input: the scene is empty"]);
}

#[test]
fn a_file_in_utf_16() {
    let text: Vec<u8> = [0xFEFF].into_iter().chain(LAB.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    let folder = Folder::with("scene.toml", text);
    refused(&folder, "scene.toml", b"", &["not a text in UTF-8: byte 0xFF at offset 0, line 1", "save it as UTF-8"]);
    // In UTF-8 the mark at the beginning is harmless.
    let folder = Folder::with("scene.toml", format!("\u{feff}{LAB}"));
    folder.ok("check scene.toml");
}

#[test]
fn a_file_of_100_megabytes_is_refused_by_its_size() {
    let folder = Folder::with("scene.toml", LAB);
    std::fs::OpenOptions::new().write(true).open(folder.path("scene.toml")).unwrap().set_len(100 << 20).unwrap();
    refused(&folder, "scene.toml", b"", &["the file has 104857600 bytes; a scene file may have 67108864"]);
}

#[cfg(unix)]
#[test]
fn an_endless_file_is_read_to_the_limit_and_no_further() {
    refused(
        &Folder::new(),
        "/dev/zero",
        b"",
        &["the file has more than 67108864 bytes; a scene file may have 67108864"],
    );
}

#[test]
fn a_million_lights() {
    let lights = "[[light]]\nposition = [5, 5, -10]\nintensity = 1\n".repeat(999_999);
    let folder = Folder::with("scene.toml", format!("{LAB}\n{lights}"));
    refused(&folder, "scene.toml", b"", &["the scene has 1000000 tables [[light]]", "allowed: at most 100000"]);
}

#[test]
fn a_mistake_is_shown_with_file_line_caret_and_advice() {
    let folder = Folder::with("scene.toml", lab_with("radius = 1", "raduis = 1"));
    let message = refused(&folder, "scene.toml", b"", &[]);
    insta::assert_snapshot!(message);
}

#[test]
fn every_mistake_is_told_in_one_run() {
    let scene = lab_with("diffuse = 0.7", "diffuse = -7")
        .replace("up = [0, 1, 0]", "up = [0, 0, 1]")
        .replace("intensity = 100", "intensity = nan");
    let words = ["3 problems in scene.toml", "scene.toml:15:", "scene.toml:20:", "scene.toml:33:"];
    refused(&Folder::with("scene.toml", scene), "scene.toml", b"", &words);
}

#[test]
fn standard_input_is_named_in_the_message() {
    let scene = lab_with("radius = 1", "radius = -1");
    refused(&Folder::new(), "-", scene.as_bytes(), &[" --> standard input:27:10", "`sphere[0].radius` is -1"]);
    refused(
        &Folder::new(),
        "-",
        b"{\"version\": 1}",
        &["the key `length` is missing", "the key `camera` is missing", "2 problems"],
    );
    refused(&Folder::new(), "-", &[0xFF, 0xFE], &["standard input: not a text in UTF-8"]);
}

#[test]
fn a_json_file_by_its_suffix() {
    let folder = Folder::with("scene.json", "{\n  \"version\" 1\n}");
    refused(&folder, "scene.json", b"", &["not valid JSON", "scene.json:2:"]);
    let folder = Folder::with("scene.json", LAB);
    refused(&folder, "scene.json", b"", &["not valid JSON"]);
}

#[test]
fn the_scene_in_a_file_is_checked_as_any_other() {
    // Nothing that a user types: a file that somebody else changed.
    let folder = Folder::new();
    folder.ok("render --size 4x3 -o old.csv");
    folder.write("old.csv", folder.text("old.csv").replace("radius = 1.0", "radius = -1.0"));
    refused(&folder, "old.csv", b"", &["`sphere[0].radius` is -1", "old.csv"]);
}

#[cfg(unix)]
#[test]
fn a_name_that_is_no_text_is_a_name_all_the_same() {
    use std::os::unix::ffi::OsStrExt;
    let folder = Folder::new();
    let name = std::ffi::OsStr::from_bytes(b"sc\xFFene.toml");
    if std::fs::write(folder.path("").join(name), LAB).is_err() {
        return; // Some file systems hold nothing but UTF-8.
    }
    let mut command = assert_cmd::Command::new(crate::common::PROGRAM);
    let output = command.current_dir(folder.path("")).arg("check").arg(name).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn other_commands_refuse_a_scene_in_the_same_way() {
    let folder = Folder::with("scene.toml", lab_with("radius = 1", "radius = 0"));
    for command in
        ["check scene.toml", "check scene.toml --json", "probe scene.toml", "section scene.toml --row 1 -o row.csv"]
    {
        folder.run(command).failed(3, &["`sphere[0].radius` is 0", "scene.toml:27:10", "1 problem in scene.toml"]);
    }
    assert_eq!(folder.names(), ["scene.toml"]);
}
