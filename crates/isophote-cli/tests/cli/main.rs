//! The command as its user meets it: every test runs the real program in a folder of its own.

mod carried;
mod check;
mod color;
mod common;
mod explain;
mod figures;
mod files;
mod grid;
mod help;
mod interruption;
mod lab;
mod mistakes;
mod nasty;
mod options;
mod pictures;
mod probe;
mod russian;
mod scene_files;
mod schema;
mod section;
mod starters;
mod surface;
mod terminal;
mod usage;
mod zarr;
mod zarr_failures;
