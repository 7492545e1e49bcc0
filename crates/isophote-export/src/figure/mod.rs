//! Figures fit for a report: a map with axes, colour bar, isophotes and marks; a section as a line plot.
//!
//! A [`Figure`] is a list of shapes, texts and images, written as SVG or drawn as PNG. Pictures use one embedded font, so that
//! they do not depend on the system's fonts.

mod color_bar;
mod curve;
mod drawing;
mod error;
mod frame;
mod label_box;
mod level_labels;
mod level_lines;
mod map_figure;
mod marks;
mod options;
mod page;
mod picture;
mod picture_file;
mod raster;
#[cfg(test)]
mod read_back;
mod section_figure;
mod svg;
mod text;
mod ticks;

pub use drawing::Figure;
pub use error::FigureError;
pub use map_figure::map_figure;
pub use marks::Mark;
pub use options::FigureOptions;
pub use section_figure::{SectionOptions, SectionPoint, Series, section_figure};
