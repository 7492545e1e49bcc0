//! What is asked of a map or of a prepared scene: statistics, isophotes, values at points and along lines.

mod explain;
mod grid;
pub mod isophotes;
pub(crate) mod levels;
pub mod probe;
pub mod section;
pub mod statistics;
