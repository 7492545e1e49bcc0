//! Converts errors of the core to exceptions of the package, which are defined in `isophote.errors`.

use std::io;
use std::path::Path;

use isophote::render::RenderError;
use isophote::scene::{Problem, SceneError};
use isophote_export::{ExportError, ReadError};
use isophote_zarr::StoreError;
use pyo3::call::PyCallArgs;
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;

/// An exception of the package.
fn exception<'py>(py: Python<'py>, class: &str, arguments: impl PyCallArgs<'py>) -> PyErr {
    let class = py.import("isophote.errors").and_then(|module| module.getattr(class));
    match class.and_then(|class| class.call1(arguments)) {
        Ok(exception) => PyErr::from_value(exception),
        Err(error) => error,
    }
}

/// An argument that does not fit the scene or is invalid.
pub fn value(py: Python<'_>, message: impl ToString) -> PyErr {
    exception(py, "ArgumentError", (message.to_string(),))
}

/// Any other failure.
pub fn render(py: Python<'_>, message: impl ToString) -> PyErr {
    exception(py, "RenderError", (message.to_string(),))
}

/// Points that are not on a surface: their indices, and a message about the first ones.
pub fn probe(py: Python<'_>, message: impl ToString, indices: Vec<usize>) -> PyErr {
    exception(py, "ProbeError", (message.to_string(), indices))
}

/// A bug in this program.
pub fn internal(py: Python<'_>, message: impl ToString) -> PyErr {
    exception(py, "InternalError", (message.to_string(),))
}

/// A file that could not be read or written, for a reason other than a system error.
pub fn file(message: impl ToString) -> PyErr {
    PyOSError::new_err(message.to_string())
}

/// A file error with the system's reason: for many of these Python has its own exception.
fn system(path: &Path, reason: &io::Error, message: impl ToString) -> PyErr {
    match reason.raw_os_error() {
        Some(code) => PyOSError::new_err((code, reason.to_string(), path.to_path_buf())),
        None => file(message),
    }
}

pub fn of_export(py: Python<'_>, error: &ExportError) -> PyErr {
    match error {
        ExportError::File { path, reason } => system(path, reason, error),
        ExportError::Write(_) | ExportError::NoFolder { .. } | ExportError::Taken { .. } => file(error),
        error => value(py, error),
    }
}

pub fn of_reading(error: &ReadError) -> PyErr {
    match error {
        ReadError::File { path, reason } => system(path, reason, error),
        error => file(error),
    }
}

pub fn of_render(py: Python<'_>, error: &RenderError) -> PyErr {
    match error {
        RenderError::Region { .. }
        | RenderError::TooLarge { .. }
        | RenderError::NoSuchLight { .. }
        | RenderError::NoColor
        | RenderError::NoTolerance => value(py, error),
        RenderError::Memory { .. }
        | RenderError::Overflow { .. }
        | RenderError::Interrupted
        | RenderError::Threads(_) => render(py, error),
    }
}

pub fn of_store(py: Python<'_>, error: &StoreError) -> PyErr {
    match error {
        StoreError::Write { path, reason } | StoreError::Read { path, reason } => system(path, reason, error),
        StoreError::Render(error) => of_render(py, error),
        _ => exception(py, "StoreError", (error.to_string(),)),
    }
}

pub fn of_scene(py: Python<'_>, error: &SceneError) -> PyErr {
    let problems = problems(py, &error.problems);
    problems.map_or_else(|error| error, |problems| exception(py, "SceneError", (error.report(false), problems)))
}

/// Converts problems to `isophote.errors.Problem`s.
pub fn problems<'py>(py: Python<'py>, problems: &[Problem]) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let class = py.import("isophote.errors")?.getattr("Problem")?;
    let problem = |problem: &Problem| {
        let place = problem.place.as_ref().map(|place| (place.line, place.column, place.text.as_str()));
        let Problem { kind, path, message, help, .. } = problem;
        let (message, help) = (message.to_string(), help.as_ref().map(ToString::to_string));
        class.call1((kind.name(), path.as_str(), message, help, place))
    };
    problems.iter().map(problem).collect()
}
