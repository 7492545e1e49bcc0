//! Maps as files for other programs and for people.

pub mod colormap;
mod colormap_tables;
pub mod figure;
