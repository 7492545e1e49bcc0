//! The polygon file format, ASCII and binary in either byte order, with properties in any order. Elements and properties
//! that are not needed are skipped.

mod header;
pub(super) mod mesh;
mod rows;
pub(super) mod spheres;

use header::{Element, Header, Kind};
use rows::{Row, Rows};
