//! The command line.

use std::ffi::OsString;

use pyo3::prelude::*;

/// Runs the command `isophote`, the same as the program; returns the exit code. Meant for processes that do nothing
/// else.
#[pyfunction]
pub fn command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| isophote_cli::run(arguments))
}

/// The app's page, packed by gzip; `None` if the package was built without it.
#[pyfunction]
pub fn app_page() -> Option<&'static [u8]> {
    isophote_cli::APP_PAGE
}
