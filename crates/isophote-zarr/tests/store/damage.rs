//! What is missing or damaged is found, named, and computed again.

use std::fs;
use std::path::Path;

use isophote_zarr::{Check, Opening, Store, StoreError, read_metadata};

use crate::common::{Folder, Job, TWO_LIGHTS, scene};

fn damages(folder: &Folder, check: Check) -> Vec<String> {
    match Store::open(&folder.store()).unwrap().merge(check) {
        Ok(_) => vec![],
        Err(StoreError::Incomplete { damages, .. }) => damages.iter().map(ToString::to_string).collect(),
        Err(error) => panic!("{error}"),
    }
}

fn flip(path: &Path, at: usize) {
    let mut bytes = fs::read(path).unwrap();
    let at = at.min(bytes.len() - 1);
    bytes[at] ^= 1;
    fs::write(path, bytes).unwrap();
}

/// A file, what happens to it, how closely one must look, and what is said.
type Harm = (&'static str, fn(&Path), Check, &'static str);

#[test]
fn damage_is_found_by_its_file_and_mended_by_continuing() {
    let scene = scene(TWO_LIGHTS, 70, 50);
    let (folder, _) = Job::default().complete(&scene);
    let before = folder.tree();
    assert!(!before.contains_key("brightness/c/3/4"), "nothing is seen there");
    let harms: [Harm; 9] = [
        ("brightness/c/1/2", |path| fs::remove_file(path).unwrap(), Check::Presence, "is missing"),
        ("normal/c/1/2/0", |path| fs::write(path, "short").unwrap(), Check::Presence, "has 5 bytes in place of"),
        ("brightness/c/1/2", |path| flip(path, 50), Check::Content, "has the checksum"),
        ("shape/c/1/2", |path| flip(path, usize::MAX), Check::Content, "has the checksum"),
        (".isophote/shards/1/2.json", |path| fs::write(path, "{").unwrap(), Check::Presence, "is damaged"),
        (
            ".isophote/shards/1/2.json",
            |path| edit(path, "\"lit\":", "\"lit\":1"),
            Check::Presence,
            "its checksum is wrong",
        ),
        (
            ".isophote/shards/1/2.json",
            |path| edit(path, "\"preview\":\"", "\"preview\":\"?"),
            Check::Presence,
            "its checksum",
        ),
        ("brightness/zarr.json", |path| flip(path, 9), Check::Content, "is missing or changed"),
        ("brightness/c/3/4", |path| put(path), Check::Presence, "should not be there"),
    ];
    for (file, harm, check, words) in harms {
        harm(&folder.file(file));
        let found = damages(&folder, check);
        assert_eq!(found.len(), 1, "{file}: {found:?}");
        assert!(found[0].starts_with(file) && found[0].contains(words), "{file}: {found:?}");
        Job { opening: Opening::Continue, ..Job::default() }.run(&folder.store(), &scene).unwrap();
        assert!(folder.tree() == before, "{file} is mended");
        assert!(damages(&folder, Check::Content).is_empty());
    }
}

#[test]
fn a_damaged_chunk_is_named_even_if_the_record_fits() {
    let scene = scene(TWO_LIGHTS, 70, 50);
    let (folder, _) = Job::default().complete(&scene);
    let [file, record] = ["normal/c/1/2/0", ".isophote/shards/1/2.json"].map(|name| folder.file(name));
    // The first byte of the last chunk.
    let bytes = fs::read(&file).unwrap();
    let last = bytes.len() - 4 - 16;
    flip(&file, usize::from(u16::from_le_bytes([bytes[last], bytes[last + 1]])));
    let mut json: serde_json::Value = serde_json::from_slice(&fs::read(&record).unwrap()).unwrap();
    json["record"]["files"][2]["crc32c"] = crc32c::crc32c(&fs::read(&file).unwrap()).into();
    json["crc32c"] = format!("{:08x}", crc32c::crc32c(json["record"].to_string().as_bytes())).into();
    fs::write(&record, json.to_string()).unwrap();
    let found = damages(&folder, Check::Content);
    let expected = "normal/c/1/2/0 cannot be decoded: its chunk in row 3, column 3 has the checksum ";
    assert!(found.len() == 1 && found[0].starts_with(expected), "{found:?}");
}

fn edit(path: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(path).unwrap();
    assert!(text.contains(from), "{text}");
    fs::write(path, text.replacen(from, to, 1)).unwrap();
}

fn put(path: &Path) {
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, "ghost").unwrap();
}

#[test]
fn shards_that_were_not_computed_are_listed() {
    let scene = scene(TWO_LIGHTS, 70, 50);
    let (folder, _) = Job::default().complete(&scene);
    for column in 0..5 {
        for row in [1, 3] {
            fs::remove_file(folder.file(&format!(".isophote/shards/{row}/{column}.json"))).unwrap();
        }
    }
    assert_eq!(damages(&folder, Check::Presence).len(), 10);
    let error = Store::open(&folder.store()).unwrap().merge(Check::Presence).unwrap_err().to_string();
    assert!(error.contains("shard 1/0 is not computed; shard 1/1 is not computed"), "{error}");
    assert!(error.ends_with("and 5 more"), "{error}");
}

/// A record is read back as it was written, or not at all: any other byte counts as not done.
#[test]
fn no_byte_of_a_record_is_trusted() {
    let scene = scene(TWO_LIGHTS, 20, 20);
    let (folder, _) = Job::default().complete(&scene);
    let path = folder.file(".isophote/shards/0/0.json");
    let bytes = fs::read(&path).unwrap();
    for at in (0..bytes.len()).step_by(7).chain([bytes.len() - 1]) {
        flip(&path, at);
        assert_eq!(damages(&folder, Check::Presence).len(), 1, "byte {at}");
        fs::write(&path, &bytes).unwrap();
    }
    assert!(damages(&folder, Check::Content).is_empty());
}

#[test]
fn a_description_that_makes_no_sense_is_an_error_and_no_panic() {
    let scene = scene(TWO_LIGHTS, 20, 20);
    let (folder, _) = Job::default().complete(&scene);
    let text = fs::read_to_string(folder.file("zarr.json")).unwrap();
    let changes = [
        ("\"shard_side\": 16", "\"shard_side\": 0"),
        ("\"inner_side\": 4", "\"inner_side\": 5"),
        ("\"data_type\": \"float64\"", "\"data_type\": \"float65\""),
        ("\"isophote\": 1", "\"isophote\": 99"),
        // A million million shards.
        ("\"width\": 20", "\"width\": 4000000000"),
        ("\"isophote\": 1", "\"isophot\": 1"),
        ("\"zarr_format\": 3,", "\"zarr_format\": 3,,"),
    ];
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        fs::write(folder.file("zarr.json"), text.replace(from, to)).unwrap();
        assert!(Store::open(&folder.store()).is_err(), "{to}");
    }
    for odd in ["[]", "\"x\"", "1", "null", "{}", "{\"attributes\":[]}", "{\"attributes\":{\"isophote\":[]}}", "[[[["] {
        fs::write(folder.file("zarr.json"), odd).unwrap();
        assert!(Store::open(&folder.store()).is_err(), "{odd}");
        assert!(read_metadata(&folder.store()).is_err(), "{odd}");
    }
}
