//! The compiled part of the Python package: scenes, maps and analyses of the core, as arrays. It is private to the
//! package, whose Python classes wrap it; everything here is plain text, numbers and arrays.

mod analysis;
mod command;
mod error;
mod formula;
mod job;
mod map;
mod names;
mod probe;
mod read;
mod render;
mod scene;
mod store;
mod threads;

use pyo3::prelude::*;

#[pymodule]
mod _isophote {
    #[pymodule_export]
    use crate::analysis::{areas, center_on_screen, grid, section, surface};
    #[pymodule_export]
    use crate::command::{app_page, command};
    #[pymodule_export]
    use crate::formula::{brightness, conventions};
    #[pymodule_export]
    use crate::job::panic_on_purpose;
    #[pymodule_export]
    use crate::map::{Map, levels};
    #[pymodule_export]
    use crate::probe::{explain, probe_pixels, probe_points, probe_screen, probe_values};
    #[pymodule_export]
    use crate::read::{read_exr, read_metadata};
    #[pymodule_export]
    use crate::render::render;
    #[pymodule_export]
    use crate::scene::{Scene, starter};
    #[pymodule_export]
    use crate::store::{store_merge, store_prepare, store_render};

    use super::{Bound, PyModule, PyModuleMethods, PyResult};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
