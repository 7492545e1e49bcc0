//! What is read off a finished map.

mod grid;
pub mod isophotes;
pub(crate) mod levels;
