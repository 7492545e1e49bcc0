//! A normalised picture of one channel: the only place where numbers become grey levels or colours.

mod color;
mod encode;
mod numbers;
mod options;

use std::io::Write;

use isophote::map::{Map, Quantity, Values};

use crate::channel;
use crate::error::ExportError;

pub(crate) use encode::{METADATA_KEYWORD, read_json};
pub use options::{Depth, Normalization, PictureColor, PictureOptions, PictureReport};

/// Writes the picture with row 0 at the top; missed pixels are black, even with a colour map.
///
/// A value v becomes ((v − black)/(white − black))^(1/gamma), times 255 or 65535, rounded to nearest.
/// Colours are scaled by one range, by default from 0 to the largest component, and shown in sRGB with its transfer
/// function, whatever their own colour space.
/// The text chunks `Title`, `Software`, `Description` and `isophote` (the metadata as JSON) come before the pixels.
///
/// # Errors
/// The channel is missing or cannot be shown; the range, gamma or depth is invalid; an error of `out`.
pub fn write(map: &Map, options: &PictureOptions, out: impl Write) -> Result<PictureReport, ExportError> {
    let channel = channel::find(map, &options.quantity)?;
    match (&channel.quantity, &channel.values) {
        (Quantity::Color, Values::Vector(colors)) => color::write(map, channel, colors, options, out),
        _ => numbers::write(map, channel, options, out),
    }
}
