//! Sections, surface maps, grids and areas.

use isophote::analysis::area::{AreaExtreme, AreaReading};
use isophote::analysis::probe::SeenFromEye;
use isophote::analysis::section::SectionLine;
use isophote::analysis::surface::{SurfaceProjection, SurfaceRequest};
use isophote::map::{Quantity, Resolution};
use isophote::render::RenderError;
use isophote::scene::Area;
use isophote::shape::{Primitive, Side};
use isophote::vector::Vector;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error;
use crate::job::{self, Progress};
use crate::map::Map;
use crate::names::{keyword, quantities};
use crate::probe::Columns;
use crate::scene::Scene;

/// The values along a row, a column, or between two points on the screen (in the scene's unit or degrees).
#[pyfunction]
#[pyo3(signature = (scene, row, column, between, samples))]
pub fn section<'py>(
    py: Python<'py>,
    scene: &Scene,
    row: Option<u32>,
    column: Option<u32>,
    between: Option<[[f64; 2]; 2]>,
    samples: u32,
) -> PyResult<Bound<'py, PyDict>> {
    let unit = scene.core().screen_unit();
    let inside = |place: [f64; 2]| place.map(|coordinate| unit.to_internal(coordinate));
    let line = match (row, column, between) {
        (Some(row), None, None) => SectionLine::Row(row),
        (None, Some(column), None) => SectionLine::Column(column),
        (None, None, Some([from, to])) => SectionLine::Between { from: inside(from), to: inside(to), samples },
        _ => return Err(error::value(py, "say where: one of row, column and between")),
    };
    let content = scene.content();
    let found = job::run(py, &Progress::none(), move |watch| content.prepared().section_observed(line, Some(watch)))?;
    let found = found.map_err(|error| error::value(py, error))?;
    let length = scene.core().length();
    let columns = PyDict::new(py);
    let places = found.iter().flat_map(|sample| sample.screen.map(|coordinate| unit.from_internal(coordinate)));
    columns.set_item("screen", Columns::vectors(py, places.collect(), 2)?)?;
    let mut values = Columns::new(found.len(), None, false);
    for sample in &found {
        match &sample.seen {
            Some((hit, shading)) => values.push(hit, shading, length),
            None => values.push_nothing(),
        }
    }
    values.into_dict(py, &columns)?;
    Ok(columns)
}

/// An extreme of an area: its value, its point, its place on the screen for an area there, and whether the eye sees it.
type Extreme = (f64, [f64; 3], Option<[f64; 2]>, bool);

/// Maximum, minimum, mean, estimated error of the mean, and the visible fraction of an area.
type AreaNumbers = (Extreme, Extreme, f64, f64, f64);

/// The areas of a scene by name; without numbers where no surface is seen.
#[pyfunction]
pub fn areas(py: Python<'_>, scene: &Scene) -> PyResult<Vec<(String, Option<AreaNumbers>)>> {
    let content = scene.content();
    let unit = (scene.core().length(), scene.core().screen_unit());
    let found: Result<_, RenderError> = job::run(py, &Progress::none(), move |watch| {
        let extreme = |extreme: &AreaExtreme| -> Extreme {
            let point = extreme.point.to_array().map(|metres| unit.0.from_metres(metres));
            let screen = extreme.screen.map(|place| place.map(|coordinate| unit.1.from_internal(coordinate)));
            (extreme.value, point, screen, extreme.seen == SeenFromEye::Seen)
        };
        let numbers = |area: &Area| {
            let reading = content.prepared().area_observed(area, Some(watch))?;
            let numbers = reading.map(|AreaReading { max, min, mean, mean_error, visible }| {
                (extreme(&max), extreme(&min), mean, mean_error, visible)
            });
            Ok((area.name.clone(), numbers))
        };
        content.scene().areas().iter().map(numbers).collect()
    })?;
    found.map_err(|error| error::of_render(py, &error))
}

/// Where the centre of a shape appears on the screen; `None` where the camera cannot see it.
#[pyfunction]
pub fn center_on_screen(py: Python<'_>, scene: &Scene, shape: &str) -> PyResult<Option<[f64; 2]>> {
    let core = scene.core();
    let Some(shape) = core.shapes().iter().find(|known| known.name == shape) else {
        return Err(error::value(py, format!("there is no shape {shape:?}")));
    };
    let place = scene.content().prepared().frame().project(shape.geometry.center());
    Ok(place.map(|place| place.map(|coordinate| core.screen_unit().from_internal(coordinate))))
}

/// The map over the surface of a shape, with its area and totals: for each scalar channel the integral, the minimum,
/// the maximum, and the area they refer to.
#[pyfunction]
#[pyo3(signature = (scene, shape, part, channels, projection, side, axis, size))]
pub fn surface<'py>(
    py: Python<'py>,
    scene: &Scene,
    shape: &str,
    part: u32,
    channels: Vec<String>,
    projection: &str,
    side: &str,
    axis: Option<[f64; 3]>,
    size: Option<[u32; 2]>,
) -> PyResult<(Map, f64, Bound<'py, PyDict>)> {
    let quantities = quantities(py, &channels)?;
    let request = SurfaceRequest {
        primitive: Primitive { shape: scene.shape_named(py, shape)?, part },
        projection: keyword::<SurfaceProjection>(py, "projection", projection)?,
        axis: axis.map(Vector::from),
        side: keyword::<Side>(py, "side", side)?,
        size: size.map(|[width, height]| Resolution { width, height }),
    };
    let content = scene.content();
    let found = job::run(py, &Progress::none(), move |watch| {
        let prepared = content.prepared();
        let surface = prepared.surface(&request)?;
        let map = surface.map_observed(&quantities, Some(watch))?;
        let scalar = quantities.into_iter().filter(Quantity::is_scalar);
        let totals: Vec<_> = scalar.map(|quantity| (quantity.name(), surface.totals(&map, &quantity))).collect();
        Ok((map, surface.area(), totals))
    })?;
    let (map, area, totals) =
        found.map_err(|error: isophote::analysis::surface::SurfaceError| error::value(py, error))?;
    let by_channel = PyDict::new(py);
    for (name, totals) in totals {
        let totals = totals.map(|of| (of.integral, of.min.value, of.max.value, of.area));
        by_channel.set_item(name, totals)?;
    }
    Ok((Map::new(map), area, by_channel))
}

/// The map over one of the scene's grids.
#[pyfunction]
pub fn grid(py: Python<'_>, scene: &Scene, name: &str, channels: Vec<String>) -> PyResult<Map> {
    let quantities = quantities(py, &channels)?;
    let grids = scene.core().grids();
    let grid = grids.iter().find(|grid| grid.name == name).cloned().ok_or_else(|| {
        let names: Vec<&str> = grids.iter().take(20).map(|grid| grid.name.as_str()).collect();
        let there_are =
            if names.is_empty() { "it has none".into() } else { format!("there are: {}", names.join(", ")) };
        error::value(py, format!("the scene has no grid \"{name}\"; {there_are}"))
    })?;
    let content = scene.content();
    let map = job::run(py, &Progress::none(), move |watch| {
        content.prepared().grid_observed(&grid, &quantities, Some(watch))
    })?;
    Ok(Map::new(map.map_err(|error| error::value(py, error))?))
}
