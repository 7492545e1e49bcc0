//! The polygon file format, ASCII and binary of either byte order, whatever the order of its properties. Elements and
//! properties beyond those that are looked for are walked over.

mod header;
pub(super) mod mesh;
mod rows;
pub(super) mod spheres;

use header::{Element, Header, Kind};
use rows::{Row, Rows};
