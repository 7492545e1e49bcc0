//! Figures fit for a report: a map with axes, colour bar, isophotes and marks; a section as a line plot.
//!
//! Figures are written as SVG by a small writer of our own. [`svg_to_png`] draws them using only one embedded font, so
//! that a picture does not depend on the system's fonts.

mod color_bar;
mod curve;
mod error;
mod frame;
mod label_box;
mod layers;
mod level_labels;
mod level_lines;
mod map_figure;
mod marks;
mod options;
mod page;
mod picture;
mod png_picture;
mod raster;
#[cfg(test)]
mod read_back;
mod section_figure;
mod svg;
mod text;
mod ticks;

pub use error::FigureError;
pub use map_figure::map_figure_svg;
pub use marks::Mark;
pub use options::FigureOptions;
pub use png_picture::svg_to_png;
pub use section_figure::{SectionOptions, SectionPoint, Series, section_figure_svg};
