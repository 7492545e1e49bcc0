//! Maps as arrays.

use std::io::{self, Seek, SeekFrom, Write};
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::Arc;
use std::thread::available_parallelism;

use isophote::analysis::isophotes::{isophotes_observed, nice_levels};
use isophote::analysis::statistics::{Extreme, statistics};
use isophote::map::{Channel, Coordinates, Map as CoreMap, Quantity, Region, Resolution, Run, Values};
use isophote::units::Keyword;
use isophote_export::colormap::Colormap;
use isophote_export::csv::Rows;
use isophote_export::png::{Depth, Normalization, PictureColor, PictureOptions};
use isophote_export::{ExportError, FileMetadata, Format, csv, exr, npy, npz, png, write_atomically};
use numpy::ndarray::{ArrayView, Dimension, ShapeBuilder};
use numpy::{
    Element, IntoPyArray, PyArray, PyArray2, PyArrayMethods, PyReadonlyArray2, PyReadonlyArray3, PyReadonlyArrayDyn,
    PyReadwriteArrayDyn, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::error;
use crate::job::{self, Progress, Watch};
use crate::names::keyword;

/// A map of the core; its arrays are views of the map's memory.
#[pyclass(frozen, module = "isophote._isophote")]
pub struct Map {
    map: Arc<CoreMap>,
}

/// A value with its column and row in the map.
type Place = (f64, [u32; 2]);

/// A line of an isophote: an array of x and y, and whether the line is closed.
type Line<'py> = (Bound<'py, PyArray2<f64>>, bool);

impl Map {
    pub fn new(map: CoreMap) -> Self {
        Self { map: Arc::new(map) }
    }

    fn named(&self, name: &str) -> PyResult<&Channel> {
        let mut held = self.map.channels().iter();
        held.find(|channel| channel.quantity.name() == name).ok_or_else(|| PyKeyError::new_err(name.to_owned()))
    }

    fn quantity(&self, name: &str) -> PyResult<&Quantity> {
        Ok(&self.named(name)?.quantity)
    }
}

#[pymethods]
impl Map {
    /// The map that this metadata describes (as JSON), of these channels and the shape seen at each pixel.
    #[staticmethod]
    fn of(
        py: Python<'_>,
        metadata: &str,
        channels: Vec<(String, Bound<'_, PyAny>)>,
        shapes: PyReadonlyArrayDyn<'_, i32>,
    ) -> PyResult<Self> {
        let about: FileMetadata = serde_json::from_str(metadata).map_err(|error| error::value(py, error))?;
        let FileMetadata { full, region, window, .. } = about;
        let shapes = shapes.as_array().iter().copied().collect();
        let mut map = CoreMap::builder(full, window, about.provenance()).region(region).shapes(shapes);
        for (name, array) in channels {
            let quantity = Quantity::from_name(&name)
                .ok_or_else(|| error::value(py, format!("there is no channel \"{name}\"")))?;
            let unit = about.channels.iter().find(|channel| channel.name == name);
            map = map.channel(quantity, unit.map_or("", |channel| channel.unit.as_str()), values_of(&array)?);
        }
        Ok(Self::new(map.build().map_err(|error| error::value(py, error))?))
    }

    /// The channels' names and units.
    fn units(&self) -> Vec<(String, &str)> {
        self.map.channels().iter().map(|channel| (channel.quantity.name(), channel.unit.as_str())).collect()
    }

    /// A channel as a read-only array of height × width or height × width × 3.
    fn channel<'py>(this: &Bound<'py, Self>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let map = this.get();
        let Resolution { width, height } = map.map.region.size;
        let [height, width] = [height as usize, width as usize];
        match &map.named(name)?.values {
            Values::Scalar(values) => view(this, values, [height, width]),
            Values::Single(values) => view(this, values, [height, width]),
            Values::Index(values) => view(this, values, [height, width]),
            Values::Vector(values) => view(this, values.as_flattened(), [height, width, 3]),
        }
    }

    /// The index of the shape at each pixel, −1 if there is none.
    fn shapes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let Resolution { width, height } = self.map.region.size;
        let shapes = self.map.mask().shapes().into_pyarray(py);
        Ok(shapes.reshape([height as usize, width as usize])?.into_any())
    }

    fn visible(&self) -> usize {
        self.map.mask().visible()
    }

    /// Minimum, maximum and mean over the pixels that see a surface; none if there are no such pixels.
    fn statistics(&self, py: Python<'_>, name: &str) -> PyResult<Option<(Place, Place, f64)>> {
        let quantity = self.quantity(name)?;
        if !quantity.is_scalar() {
            return Err(error::value(py, format!("the channel {name} is not one number a pixel")));
        }
        let corner = self.map.region.corner;
        let place =
            |extreme: Extreme| (extreme.value, [extreme.pixel.column - corner.column, extreme.pixel.row - corner.row]);
        Ok(statistics(&self.map, quantity).map(|of| (place(of.min), place(of.max), of.mean)))
    }

    /// Column, row, width and height of the part of the image that the map holds.
    fn region(&self) -> [u32; 4] {
        let Region { corner, size } = self.map.region;
        [corner.column, corner.row, size.width, size.height]
    }

    /// How many pixels the allowed number of rays is not enough for; none without a tolerance.
    fn over_tolerance(&self) -> Option<usize> {
        self.map.over_tolerance
    }

    /// For both directions: name, title, unit, first and last edge.
    fn axes(&self) -> Vec<(&str, &str, &str, [f64; 2])> {
        let window = &self.map.window;
        let [x, y] = window.coordinates.axes(window.length);
        [(x, window.x), (y, window.y)]
            .into_iter()
            .map(|(axis, edges)| (axis.name, axis.title, axis.unit, edges))
            .collect()
    }

    /// The map's metadata as JSON, as stored in files.
    fn metadata(&self) -> String {
        FileMetadata::of(&self.map).to_json()
    }

    /// The isophotes at these levels.
    fn isophotes<'py>(&self, py: Python<'py>, name: &str, levels: Vec<f64>) -> PyResult<Vec<(f64, Vec<Line<'py>>)>> {
        let quantity = self.quantity(name)?.clone();
        let map = Arc::clone(&self.map);
        let found =
            job::run(py, &Progress::none(), move |watch| isophotes_observed(&map, &quantity, &levels, Some(watch)))?;
        let found = found.map_err(|error| error::value(py, error))?;
        let mut all = Vec::with_capacity(found.len());
        for isophote in found {
            let mut lines = Vec::with_capacity(isophote.lines.len());
            for line in isophote.lines {
                let points: Vec<f64> = line.points.iter().flat_map(|point| [point.x, point.y]).collect();
                lines.push((points.into_pyarray(py).reshape([line.points.len(), 2])?, line.closed));
            }
            all.push((isophote.level, lines));
        }
        Ok(all)
    }

    /// Writes a file in the format given by its suffix; `name` is the channel for formats that hold only one.
    #[pyo3(signature = (path, name, range, normalize, gamma, bits, colormap))]
    #[expect(clippy::too_many_arguments, reason = "the options of a picture, as keywords of Python")]
    fn save(
        &self,
        py: Python<'_>,
        path: PathBuf,
        name: &str,
        range: Option<[f64; 2]>,
        normalize: &str,
        gamma: f64,
        bits: u8,
        colormap: Option<&str>,
    ) -> PyResult<()> {
        let Some(format) = Format::from_path(&path) else {
            let message = format!(
                "cannot tell the format of {}; allowed: .png, .exr, .npy, .npz, .csv (render_to_zarr makes stores)",
                path.display()
            );
            return Err(error::value(py, message));
        };
        let style = Style {
            quantity: self.quantity(name)?.clone(),
            range,
            normalization: keyword(py, "normalization", normalize)?,
            gamma,
            depth: depth(py, bits)?,
            colormap: colormap_named(py, colormap)?,
        };
        let map = if matches!(format, Format::Exr | Format::Npz | Format::Csv) {
            with_shapes(&self.map)
        } else {
            Arc::clone(&self.map)
        };
        let saved = job::run_to_its_end(py, &Progress::none(), move |watch| {
            write_atomically(&path, |file| {
                let mut file = Stoppable { file, watch };
                match format {
                    Format::Png => style.write(&map, &mut file),
                    Format::Exr => exr::write(&map, available_parallelism().unwrap_or(NonZeroUsize::MIN), &mut file),
                    Format::Npy => npy::write(&map, &style.quantity, &mut file),
                    Format::Npz => npz::write(&map, &mut file),
                    Format::Csv => csv::write(&map, Rows::All, &mut file).map(|_| ()),
                }
            })
        })?;
        saved.map_err(|error| error::of_export(py, &error))
    }

    /// Copies a channel, or the visibility of a surface, into a contiguous, zero-initialised array of matching shape
    /// and type.
    #[pyo3(signature = (name, out))]
    fn copy_into(&self, py: Python<'_>, name: Option<&str>, out: &Bound<'_, PyAny>) -> PyResult<()> {
        let runs = self.map.mask().runs();
        let Some(name) = name else {
            return copy(py, out, |seen: &mut [bool]| runs.iter().for_each(|run| seen[run.start..run.end].fill(true)));
        };
        match &self.named(name)?.values {
            Values::Scalar(values) => copy(py, out, |out| copy_runs(runs, values, out, 1)),
            Values::Single(values) => copy(py, out, |out| copy_runs(runs, values, out, 1)),
            Values::Vector(values) => copy(py, out, |out| copy_runs(runs, values.as_flattened(), out, 3)),
            Values::Index(values) => copy(py, out, |out| out.copy_from_slice(values)),
        }
    }

    /// The picture of a channel as PNG bytes.
    fn png<'py>(&self, py: Python<'py>, name: &str, colormap: Option<&str>) -> PyResult<Bound<'py, PyBytes>> {
        let style = Style {
            quantity: self.quantity(name)?.clone(),
            range: None,
            normalization: Normalization::Max,
            gamma: 1.0,
            depth: Depth::Eight,
            colormap: colormap_named(py, colormap)?,
        };
        let mut bytes = Vec::new();
        style.write(&self.map, &mut bytes).map_err(|error| error::value(py, error))?;
        Ok(PyBytes::new(py, &bytes))
    }
}

/// The map with the shape at each pixel among its channels, without which a file would not tell background from dark
/// surfaces. (The points of a grid are on no shape.)
fn with_shapes(map: &Arc<CoreMap>) -> Arc<CoreMap> {
    if map.channel(&Quantity::Shape).is_some() || map.window.coordinates == Coordinates::Grid {
        return Arc::clone(map);
    }
    let mut with = CoreMap::clone(map);
    with.add_shapes();
    Arc::new(with)
}

/// The values of a channel, from an array of height × width or height × width × 3.
fn values_of(array: &Bound<'_, PyAny>) -> PyResult<Values> {
    if let Ok(values) = array.extract::<PyReadonlyArray2<'_, f64>>() {
        return Ok(Values::Scalar(values.as_array().iter().copied().collect()));
    }
    if let Ok(values) = array.extract::<PyReadonlyArray2<'_, f32>>() {
        return Ok(Values::Single(values.as_array().iter().copied().collect()));
    }
    if let Ok(values) = array.extract::<PyReadonlyArray2<'_, i32>>() {
        return Ok(Values::Index(values.as_array().iter().copied().collect()));
    }
    let vectors: Vec<f64> = array.extract::<PyReadonlyArray3<'_, f64>>()?.as_array().iter().copied().collect();
    Ok(Values::Vector(vectors.as_chunks::<3>().0.to_vec()))
}

/// A file whose writing stops when it is no longer needed.
struct Stoppable<'w, W> {
    file: W,
    watch: &'w Watch,
}

impl<W: Write> Write for Stoppable<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.watch.is_stopped() {
            return Err(io::Error::other("interrupted"));
        }
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl<W: Seek> Seek for Stoppable<'_, W> {
    fn seek(&mut self, position: SeekFrom) -> io::Result<u64> {
        self.file.seek(position)
    }
}

/// About this many round levels between two values.
#[pyfunction]
#[pyo3(name = "nice_levels")]
pub fn levels(least: f64, greatest: f64, about: usize) -> Vec<f64> {
    nice_levels(least, greatest, about)
}

/// Fills an array without the interpreter's lock.
fn copy<T: Element + Send>(py: Python<'_>, out: &Bound<'_, PyAny>, fill: impl FnOnce(&mut [T]) + Send) -> PyResult<()> {
    let mut out = out.extract::<PyReadwriteArrayDyn<'_, T>>()?;
    let out = out.as_slice_mut().map_err(|error| error::internal(py, error))?;
    py.detach(|| fill(out));
    Ok(())
}

/// Copies the pixels that see a surface, each with `width` numbers.
fn copy_runs<T: Copy>(runs: &[Run], values: &[T], out: &mut [T], width: usize) {
    for run in runs {
        let range = run.start * width..run.end * width;
        out[range.clone()].copy_from_slice(&values[range]);
    }
}

/// How a picture shows its channel.
struct Style {
    quantity: Quantity,
    range: Option<[f64; 2]>,
    normalization: Normalization,
    gamma: f64,
    depth: Depth,
    colormap: Option<Colormap>,
}

impl Style {
    fn write(&self, map: &CoreMap, out: &mut impl Write) -> Result<(), ExportError> {
        let color = self.colormap.map(|colormap| move |fraction| colormap.color(fraction));
        let name = self.colormap.map_or("", Colormap::name);
        let options = PictureOptions {
            range: self.range,
            normalization: self.normalization,
            gamma: self.gamma,
            depth: self.depth,
            color: color.as_ref().map(|color| PictureColor { name, color }),
            ..PictureOptions::new(self.quantity.clone())
        };
        png::write(map, &options, out).map(|_| ())
    }
}

fn depth(py: Python<'_>, bits: u8) -> PyResult<Depth> {
    match bits {
        8 => Ok(Depth::Eight),
        16 => Ok(Depth::Sixteen),
        _ => Err(error::value(py, format!("a picture cannot have {bits} bits; allowed: 8, 16"))),
    }
}

fn colormap_named(py: Python<'_>, name: Option<&str>) -> PyResult<Option<Colormap>> {
    name.map(|name| keyword(py, "colour map", name)).transpose()
}

/// A read-only array over a channel's own memory, which the array keeps alive.
fn view<'py, T: Element, D: Dimension>(
    map: &Bound<'py, Map>,
    values: &[T],
    shape: impl ShapeBuilder<Dim = D>,
) -> PyResult<Bound<'py, PyAny>> {
    let values =
        ArrayView::from_shape(shape.into_shape_with_order(), values).map_err(|e| error::internal(map.py(), e))?;
    // SAFETY: the values are in the memory of the map in `map`, which is the array's base and so lives at least as
    // long. The map neither changes nor moves them: the class is frozen, and the core's map is behind an `Arc` through
    // which nothing writes. `make_nonwriteable` below keeps Python from writing.
    #[expect(unsafe_code, reason = "without it every channel would be copied")]
    let array = unsafe { PyArray::borrow_from_array(&values, map.clone().into_any()) };
    array.try_readwrite().map_err(|error| error::internal(map.py(), error))?.make_nonwriteable();
    debug_assert!(array.is_c_contiguous());
    Ok(array.into_any())
}
