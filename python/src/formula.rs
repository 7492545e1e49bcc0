//! The bare formula, for callers with their own geometry.

use isophote::light::{Ambient, Emitters};
use isophote::reflectance::{BrightnessFormula, Convention};
use isophote::shade::shade;
use isophote::shape::SurfacePoint;
use isophote::units::Keyword;
use isophote::vector::Vector;
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::error;
use crate::job::{self, Progress};
use crate::scene::Scene;
use crate::threads::threads;

/// Points per chunk; each chunk is computed by one thread.
const CHUNK: usize = 4096;

/// The brightness by a convention, (3.1) to (3.12), at points with given normals (n × 3 each, lengths in metres, unit normals), using the
/// lights, the convention and the first material of a scene, without shadows. `eyes` has one row, or one per point.
#[pyfunction]
pub fn brightness<'py>(
    py: Python<'py>,
    scene: &Scene,
    positions: PyReadonlyArray2<'py, f64>,
    normals: PyReadonlyArray2<'py, f64>,
    eyes: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let core = scene.core();
    let Some(material) = core.materials().first() else {
        return Err(error::value(py, "the formula needs a material"));
    };
    let formula = BrightnessFormula::new(core.convention(), &material.reflectance);
    let rows = |array: &PyReadonlyArray2<'py, f64>| -> Vec<Vector> {
        array.as_array().rows().into_iter().map(|row| Vector::from([row[0], row[1], row[2]])).collect()
    };
    let (positions, normals, eyes) = (rows(&positions), rows(&normals), rows(&eyes));
    let content = scene.content();
    let values: Vec<f64> = job::run(py, &Progress::none(), move |watch| {
        let emitters = Emitters::of(content.scene().lights());
        let ambient = content.scene().ambient().map_or(0.0, Ambient::unobstructed_irradiance);
        let value = |index: usize| {
            if watch.is_stopped() {
                return f64::NAN;
            }
            let (position, normal) = (positions[index], normals[index]);
            let eye = eyes[if eyes.len() == 1 { 0 } else { index }];
            let view = (eye - position).normalized();
            let point = SurfacePoint {
                anchor: position,
                offset: Vector::default(),
                normal,
                view,
                cos_theta_o: normal.dot(view),
            };
            shade(&point, emitters.all(), &formula, ambient, |_| 1.0, |_, _| {}).brightness()
        };
        let starts: Vec<usize> = (0..positions.len()).step_by(CHUNK).collect();
        let chunk = |start: usize| -> Vec<f64> { (start..(start + CHUNK).min(positions.len())).map(value).collect() };
        threads().map::<_, _, Vec<Vec<f64>>>(starts, chunk).concat()
    })?;
    Ok(values.into_pyarray(py))
}

/// Name, number and formula of each convention.
#[pyfunction]
pub fn conventions() -> Vec<(&'static str, &'static str, &'static str)> {
    Convention::ALL.iter().map(|one| (one.name(), one.formula_number(), one.formula())).collect()
}
