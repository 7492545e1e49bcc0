//! Reading map files.

use std::path::PathBuf;

use exr::prelude::{FlatSamples, read_first_flat_layer_from_file};
use numpy::{IntoPyArray, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

use crate::error;

/// A channel's name and its values.
type Channel<'py> = (String, Bound<'py, PyArray2<f32>>);

/// The metadata of a file or a store, as JSON.
#[pyfunction]
pub fn read_metadata(py: Python<'_>, path: PathBuf) -> PyResult<String> {
    let metadata = if path.is_dir() {
        py.detach(|| isophote_zarr::read_metadata(&path)).map_err(|error| error::of_store(py, &error))?
    } else {
        py.detach(|| isophote_export::read_metadata(&path)).map_err(|error| error::of_reading(&error))?
    };
    Ok(metadata.to_json())
}

/// The channels of an EXR file, under their names in the file.
#[pyfunction]
pub fn read_exr(py: Python<'_>, path: PathBuf) -> PyResult<Vec<Channel<'_>>> {
    let image = py.detach(|| read_first_flat_layer_from_file(&path));
    let layer = image.map_err(|error| error::file(format!("cannot read ‘{}’: {error}", path.display())))?.layer_data;
    let size = [layer.size.height(), layer.size.width()];
    let mut channels = Vec::new();
    for channel in layer.channel_data.list {
        let values: Vec<f32> = match channel.sample_data {
            FlatSamples::F32(values) => values,
            other => other.values_as_f32().collect(),
        };
        // The bytes are UTF-8.
        let name = String::from_utf8_lossy(channel.name.as_slice()).into_owned();
        channels.push((name, values.into_pyarray(py).reshape(size)?));
    }
    Ok(channels)
}
