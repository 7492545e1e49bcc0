//! `NumPy` itself reads what we write, and so do `pandas` and `OpenEXR` if they are installed.

use std::{env, fs, process::Command};

use isophote::map::{Map, Values};
use serde_json::{Value, json};

use super::{encoded, sample};
use crate::{FileMetadata, Format, csv, npy};

/// `ISOPHOTE_PYTHON` names a Python that must have `NumPy`; without it `python3` is tried, which may lack it.
#[test]
fn numpy_reads_the_same_numbers() {
    let named = env::var_os("ISOPHOTE_PYTHON");
    let python = named.clone().unwrap_or_else(|| "python3".into());
    let has_numpy = Command::new(&python).args(["-c", "import numpy"]).output().is_ok_and(|run| run.status.success());
    if !has_numpy {
        assert!(named.is_none(), "ISOPHOTE_PYTHON is {python:?}, which cannot import numpy");
        eprintln!("skipped: {python:?} cannot import numpy; name one that can in ISOPHOTE_PYTHON");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| fs::write(folder.path().join(name), bytes).unwrap();
    let map = sample();
    for channel in map.channels() {
        let mut bytes = Vec::new();
        npy::write(&map, &channel.quantity, &mut bytes).unwrap();
        write(&format!("{}.npy", channel.quantity.name().replace('/', "_")), &bytes);
    }
    write("map.npz", &encoded(&map, Format::Npz).unwrap());
    write("map.exr", &encoded(&map, Format::Exr).unwrap());
    write("map.csv", &encoded(&map, Format::Csv).unwrap());
    let mut visible = Vec::new();
    csv::write(&map, csv::Rows::Visible, &mut visible).unwrap();
    write("visible.csv", &visible);
    write("expected.json", expected(&map).to_string().as_bytes());
    let run =
        Command::new(&python).arg("-c").arg(include_str!("numpy.py")).current_dir(folder.path()).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    eprint!("{}", String::from_utf8_lossy(&run.stdout));
}

fn expected(map: &Map) -> Value {
    let values = |values: &Values| match values {
        Values::Scalar(values) => json!(values),
        Values::Single(values) => json!(values),
        Values::Vector(values) => json!(values),
        Values::Index(indices) => json!(indices),
    };
    let channels: serde_json::Map<_, _> = map
        .channels()
        .iter()
        .map(|channel| (channel.quantity.name().replace('/', "_"), values(&channel.values)))
        .collect();
    json!({ "channels": channels, "metadata": FileMetadata::of(map) })
}
