//! Analysis of maps and prepared scenes: statistics, isophotes, values at points, along lines and over areas.

pub mod area;
mod cells;
mod explain;
pub mod isophotes;
pub mod levels;
pub mod measuring_grid;
pub mod probe;
pub mod section;
pub mod statistics;
pub mod surface;
