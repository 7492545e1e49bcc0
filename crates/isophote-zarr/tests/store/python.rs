//! zarr-python and xarray read what we write for them.

use std::env;
use std::process::Command;

use isophote::map::{Quantity, Values};
use serde_json::{Value, json};

use crate::common::{Job, TWO_LIGHTS, map, scene};

/// `ISOPHOTE_PYTHON` names a Python that must have zarr and xarray; without it `python3` is tried, and may lack them.
#[test]
fn zarr_python_and_xarray_read_the_same_numbers() {
    let named = env::var_os("ISOPHOTE_PYTHON");
    let python = named.clone().unwrap_or_else(|| "python3".into());
    let check = Command::new(&python).args(["-c", "import zarr, xarray; assert zarr.__version__ >= '3'"]).output();
    if !check.is_ok_and(|run| run.status.success()) {
        assert!(named.is_none(), "ISOPHOTE_PYTHON is {python:?}, which cannot import zarr 3 and xarray");
        eprintln!("skipped: {python:?} cannot import zarr 3 and xarray; name one that can in ISOPHOTE_PYTHON");
        return;
    }
    let scene = scene(TWO_LIGHTS, 70, 50);
    let quantities = vec![Quantity::Brightness, Quantity::Shape, Quantity::Position];
    let map = map(&scene, &quantities);
    let (folder, statistics) = Job { quantities: quantities.clone(), ..Job::default() }.complete(&scene);
    let values = |quantity: &Quantity| -> Value {
        match &map.channel(quantity).unwrap().values {
            Values::Scalar(values) => json!(values),
            Values::Single(values) => json!(values),
            Values::Vector(values) => json!(values),
            Values::Index(indices) => json!(indices),
        }
    };
    let channels: serde_json::Map<_, _> =
        quantities.iter().map(|quantity| (quantity.name(), values(quantity))).collect();
    let largest = statistics.channels[0].statistics.unwrap().max;
    let expected = json!({ "channels": channels, "title": map.provenance.title, "max": largest.value });
    let file = folder.store().with_extension("json");
    std::fs::write(&file, expected.to_string()).unwrap();
    let run =
        Command::new(&python).args(["-c", include_str!("readers.py")]).args([folder.store(), file]).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
}
