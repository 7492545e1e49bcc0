//! The command line.

use std::ffi::OsString;

use pyo3::prelude::*;

/// The command `isophote`, the same as that of the program; gives the exit code. It is for processes that do nothing else.
#[pyfunction]
pub fn command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| isophote_cli::run(arguments))
}
