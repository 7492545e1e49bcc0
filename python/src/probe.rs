//! Values at many points at once.

use std::ops::ControlFlow;

use isophote::analysis::probe::{ProbeError, ProbePosition, ProbeReading};
use isophote::map::Pixel;
use isophote::prepare::Hit;
use isophote::render::{Observer, PointKernel, PointValues};
use isophote::scene::{Scene as CoreScene, limits};
use isophote::shade::Shading;
use isophote::text::Language;
use isophote::units::{Keyword, LengthUnit};
use isophote::vector::Vector;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error;
use crate::job::{self, Progress, Watch};
use crate::scene::Scene;
use crate::threads::threads;

/// Points that one thread takes at a time.
const CHUNK: usize = 1024;
/// How many of the points without a value are listed in the error.
const TOLD: usize = 5;

/// The values at points, n × 3 in the scene's unit. `elsewhere` says how to treat points that are not on a surface:
/// `error`, `nearest` (use the nearest point on a surface), `nan`.
#[pyfunction]
pub fn probe_points<'py>(
    py: Python<'py>,
    scene: &Scene,
    points: PyReadonlyArray2<'py, f64>,
    elsewhere: &str,
    per_light: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let points: Vec<[f64; 3]> = points.as_array().rows().into_iter().map(|row| [row[0], row[1], row[2]]).collect();
    let length = scene.core().length();
    let bound = length.from_metres(limits::COORDINATE);
    let is_possible = |point: &[f64; 3]| point.iter().all(|coordinate| coordinate.abs() <= bound);
    if let Some(index) = points.iter().position(|point| elsewhere != "nan" && !is_possible(point)) {
        let [x, y, z] = points[index];
        let unit = length.name();
        let message =
            format!("point {index} is [{x}, {y}, {z}] {unit}; allowed: finite numbers up to {bound:e} {unit}");
        return Err(error::probe(py, message, vec![index]));
    }
    let snaps = elsewhere == "nearest";
    let places = points.into_iter().map(|point| is_possible(&point).then(|| place_of(point, length, snaps))).collect();
    probe_places(py, scene, places, elsewhere == "nan", per_light, progress)
}

/// Brightness, irradiance and shape at many points, n × 3 in the scene's unit, and how many of the points are not on a
/// surface; there the values are NaN and the shape is −1. None for a scene whose points have to be computed one by one.
#[pyfunction]
pub fn probe_values<'py>(
    py: Python<'py>,
    scene: &Scene,
    points: PyReadonlyArray2<'py, f64>,
    snaps: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Option<Many<'py>>> {
    let content = scene.content();
    // A scene with a kernel is small.
    let Some(prepared) = content.prepared_at_once() else { return Ok(None) };
    let Some(kernel) = PointKernel::new(&prepared) else { return Ok(None) };
    let (points, rest) = points.as_slice().map_err(|error| error::internal(py, error))?.as_chunks::<3>();
    debug_assert!(rest.is_empty());
    let (mut brightness, mut irradiance, mut shape) =
        (vec![0.0; points.len()], vec![0.0; points.len()], vec![0; points.len()]);
    let progress = Progress { function: progress, total: points.len() as u64 };
    let misses = job::run_to_its_end(py, &progress, |watch| {
        let values = brightness.chunks_mut(CHUNK).zip(irradiance.chunks_mut(CHUNK));
        let values = values.zip(shape.chunks_mut(CHUNK)).zip(points.chunks(CHUNK));
        let misses: Vec<usize> = threads().map(values.collect(), |(((brightness, irradiance), shape), points)| {
            if watch.is_stopped() {
                return 0;
            }
            advance(watch, points.len());
            kernel.fill(points, snaps, &mut PointValues { brightness, irradiance, shape })
        });
        misses.into_iter().sum::<usize>()
    })?;
    Ok(Some((brightness.into_pyarray(py), irradiance.into_pyarray(py), shape.into_pyarray(py), misses)))
}

/// The result of [`probe_values`].
type Many<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<i32>>, usize);

/// The values at what is seen at pixel centres, n × 2: column and row.
#[pyfunction]
pub fn probe_pixels<'py>(
    py: Python<'py>,
    scene: &Scene,
    pixels: PyReadonlyArray2<'py, u32>,
    elsewhere: &str,
    per_light: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let pixels = pixels.as_array();
    let places = pixels.rows().into_iter().map(|row| Some(ProbePosition::Pixel(Pixel { column: row[0], row: row[1] })));
    probe_places(py, scene, places.collect(), elsewhere == "nan", per_light, progress)
}

/// The values at what is seen at points of the screen, n × 2 in the screen's unit, inside the window or outside of it.
#[pyfunction]
pub fn probe_screen<'py>(
    py: Python<'py>,
    scene: &Scene,
    points: PyReadonlyArray2<'py, f64>,
    elsewhere: &str,
    per_light: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let unit = scene.core().screen_unit();
    let inside =
        |coordinate: f64| Some(unit.to_internal(coordinate)).filter(|inside| inside.abs() <= limits::COORDINATE);
    let points = points.as_array();
    let places: Vec<_> = points
        .rows()
        .into_iter()
        .map(|row| Some(ProbePosition::Screen { x: inside(row[0])?, y: inside(row[1])? }))
        .collect();
    if let Some(index) = places.iter().position(|place| elsewhere != "nan" && place.is_none()) {
        let (x, y, unit) = (points[[index, 0]], points[[index, 1]], unit.name());
        let bound = scene.core().screen_unit().from_internal(limits::COORDINATE);
        let message = format!("point {index} is [{x}, {y}] {unit}; allowed: finite numbers up to {bound:e} {unit}");
        return Err(error::probe(py, message, vec![index]));
    }
    probe_places(py, scene, places, elsewhere == "nan", per_light, progress)
}

fn probe_places<'py>(
    py: Python<'py>,
    scene: &Scene,
    places: Vec<Option<ProbePosition>>,
    leaves_gaps: bool,
    per_light: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let core = scene.core();
    let length = core.length();
    let lights = per_light.then(|| core.lights().len());
    let has_color = core.color().is_some();
    let content = scene.content();
    let count = places.len();
    let progress = Progress { function: progress, total: count as u64 };
    let chunks = job::run(py, &progress, move |watch| {
        let prepared = content.prepared();
        let chunk = |places: &[Option<ProbePosition>]| {
            let mut columns = Columns::new(places.len(), lights, has_color);
            let mut refusals = Vec::new();
            for (index, place) in places.iter().enumerate() {
                if watch.is_stopped() {
                    break;
                }
                match place.as_ref().map(|place| prepared.probe(place)) {
                    Some(Ok(reading)) => columns.push_reading(&reading, length),
                    Some(Err(error)) => {
                        columns.push_nothing();
                        refusals.push((index, error));
                    }
                    None => columns.push_nothing(),
                }
            }
            advance(watch, places.len());
            (columns, refusals)
        };
        threads().map::<_, _, Vec<_>>(places.chunks(CHUNK).collect(), chunk)
    })?;
    let mut all = Columns::new(count, lights, has_color);
    let mut refusals = Vec::new();
    for (number, (columns, refused)) in chunks.into_iter().enumerate() {
        all.append(columns);
        refusals.extend(refused.into_iter().map(|(index, error)| (number * CHUNK + index, error)));
    }
    if !refusals.is_empty() && !leaves_gaps {
        return Err(refused(py, core, &refusals, count));
    }
    let columns = PyDict::new(py);
    all.into_dict(py, &columns)?;
    Ok(columns)
}

/// A point in the scene's unit, or the nearest point on a surface.
fn place_of(point: [f64; 3], length: LengthUnit, snaps: bool) -> ProbePosition {
    let metres = Vector::from(point.map(|coordinate| length.to_metres(coordinate)));
    if snaps { ProbePosition::NearestTo(metres) } else { ProbePosition::Point(metres) }
}

fn advance(watch: &Watch, count: usize) {
    // A stopped job notices before its next point.
    let (ControlFlow::Continue(()) | ControlFlow::Break(())) = watch.advance(count as u64);
}

fn refused(py: Python<'_>, scene: &CoreScene, refusals: &[(usize, ProbeError)], count: usize) -> PyErr {
    let describe = |(index, error): &(usize, ProbeError)| match error {
        ProbeError::OffSurface(miss) => {
            let name = &scene.shapes()[miss.shape].name;
            let miss = miss.describe(name, scene.length());
            format!(
                "point {index} is on no surface: {miss}; elsewhere=\"nearest\" takes that one, \"nan\" leaves a gap"
            )
        }
        error => format!("point {index}: {error}"),
    };
    let mut lines: Vec<String> = refusals.iter().take(TOLD).map(describe).collect();
    if refusals.len() > TOLD {
        lines.push(format!("… and {} more of {count}", refusals.len() - TOLD));
    }
    error::probe(py, lines.join("\n"), refusals.iter().map(|(index, _)| *index).collect())
}

/// Every step of computing the value at a point, or at what a pixel or a point of the screen sees.
#[pyfunction]
#[pyo3(signature = (scene, index, name, point, pixel, screen, snaps))]
pub fn explain(
    py: Python<'_>,
    scene: &Scene,
    index: usize,
    name: &str,
    point: Option<[f64; 3]>,
    pixel: Option<[u32; 2]>,
    screen: Option<[f64; 2]>,
    snaps: bool,
) -> PyResult<String> {
    let length = scene.core().length();
    let unit = scene.core().screen_unit();
    let place = match (point, pixel, screen) {
        (Some(point), None, None) => place_of(point, length, snaps),
        (None, Some([column, row]), None) => ProbePosition::Pixel(Pixel { column, row }),
        (None, None, Some([x, y])) => ProbePosition::Screen { x: unit.to_internal(x), y: unit.to_internal(y) },
        _ => return Err(error::value(py, "say where: one of point, pixel and screen")),
    };
    let content = scene.content();
    let name = name.to_owned();
    let explained = job::run(py, &Progress::none(), move |_| {
        let prepared = content.prepared();
        prepared.probe(&place).map(|reading| reading.explain(&prepared, &name, Language::English))
    })?;
    explained.map_err(|error| refused(py, scene.core(), &[(index, error)], 1))
}

/// The results at points, in order: NaN and −1 if there is none.
pub struct Columns {
    position: Vec<f64>,
    normal: Vec<f64>,
    shape: Vec<i32>,
    part: Vec<i32>,
    is_seen: Vec<bool>,
    cos_theta_o: Vec<f64>,
    /// Brightness, irradiance, ambient, diffuse, specular.
    values: [Vec<f64>; 5],
    lights: Vec<f64>,
    /// None unless they are requested.
    light_count: Option<usize>,
    color: Option<Vec<f64>>,
}

impl Columns {
    pub fn new(count: usize, light_count: Option<usize>, has_color: bool) -> Self {
        let numbers = |per_point: usize| Vec::with_capacity(count * per_point);
        Self {
            position: numbers(3),
            normal: numbers(3),
            shape: Vec::with_capacity(count),
            part: Vec::with_capacity(count),
            is_seen: Vec::with_capacity(count),
            cos_theta_o: numbers(1),
            values: std::array::from_fn(|_| numbers(1)),
            lights: numbers(light_count.unwrap_or(0)),
            light_count,
            color: has_color.then(|| numbers(3)),
        }
    }

    fn push_reading(&mut self, reading: &ProbeReading, length: LengthUnit) {
        self.push(&reading.hit, &reading.shading, length);
        if let Some(is_seen) = self.is_seen.last_mut() {
            *is_seen = reading.is_seen();
        }
        let terms = reading.terms.iter().take(self.light_count.unwrap_or(0));
        self.lights.extend(terms.map(|term| term.irradiance));
        if let (Some(color), Some(components)) = (&mut self.color, &reading.components) {
            color.extend(components.map(|component| component.shading.brightness()).into_array());
        }
    }

    pub fn push(&mut self, hit: &Hit, shading: &Shading, length: LengthUnit) {
        self.position.extend(hit.point.position().to_array().map(|metres| length.from_metres(metres)));
        self.normal.extend(hit.point.normal.to_array());
        self.shape.push(i32::try_from(hit.primitive.shape).unwrap_or(i32::MAX));
        self.part.push(i32::try_from(hit.primitive.part).unwrap_or(i32::MAX));
        self.is_seen.push(true);
        self.cos_theta_o.push(hit.point.cos_theta_o);
        let Shading { irradiance, ambient, diffuse, specular } = *shading;
        let values = [shading.brightness(), irradiance, ambient, diffuse, specular];
        self.values.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
    }

    pub fn push_nothing(&mut self) {
        self.position.extend([f64::NAN; 3]);
        self.normal.extend([f64::NAN; 3]);
        self.shape.push(-1);
        self.part.push(-1);
        self.is_seen.push(false);
        self.cos_theta_o.push(f64::NAN);
        self.values.iter_mut().for_each(|column| column.push(f64::NAN));
        self.lights.extend(std::iter::repeat_n(f64::NAN, self.light_count.unwrap_or(0)));
        if let Some(color) = &mut self.color {
            color.extend([f64::NAN; 3]);
        }
    }

    fn append(&mut self, mut other: Self) {
        self.position.append(&mut other.position);
        self.normal.append(&mut other.normal);
        self.shape.append(&mut other.shape);
        self.part.append(&mut other.part);
        self.is_seen.append(&mut other.is_seen);
        self.cos_theta_o.append(&mut other.cos_theta_o);
        self.values.iter_mut().zip(&mut other.values).for_each(|(all, more)| all.append(more));
        self.lights.append(&mut other.lights);
        if let (Some(all), Some(more)) = (&mut self.color, &mut other.color) {
            all.append(more);
        }
    }

    /// The columns as arrays, by their names.
    pub fn into_dict(self, py: Python<'_>, columns: &Bound<'_, PyDict>) -> PyResult<()> {
        let count = self.shape.len();
        columns.set_item("position", Self::vectors(py, self.position, 3)?)?;
        columns.set_item("normal", Self::vectors(py, self.normal, 3)?)?;
        columns.set_item("shape", self.shape.into_pyarray(py))?;
        columns.set_item("part", self.part.into_pyarray(py))?;
        columns.set_item("seen", self.is_seen.into_pyarray(py))?;
        columns.set_item("cos_theta_o", self.cos_theta_o.into_pyarray(py))?;
        let names = ["brightness", "irradiance", "ambient", "diffuse", "specular"];
        for (name, column) in names.into_iter().zip(self.values) {
            let column: Bound<'_, PyArray1<f64>> = column.into_pyarray(py);
            columns.set_item(name, column)?;
        }
        if let Some(light_count) = self.light_count {
            columns.set_item("lights", self.lights.into_pyarray(py).reshape([count, light_count])?)?;
        }
        if let Some(color) = self.color {
            columns.set_item("color", Self::vectors(py, color, 3)?)?;
        }
        Ok(())
    }

    /// The numbers as an array with `width` columns.
    pub fn vectors(py: Python<'_>, numbers: Vec<f64>, width: usize) -> PyResult<Bound<'_, PyArray2<f64>>> {
        let rows = numbers.len() / width;
        numbers.into_pyarray(py).reshape([rows, width])
    }
}
