//! What is asked of a map or of a prepared scene: statistics, values at points, values along lines.

mod explain;
pub mod probe;
pub mod section;
pub mod statistics;
