//! A picture of one channel, normalised: the only place where numbers become grey levels or colours.

mod color;
mod encode;
mod numbers;
mod options;

use std::io::Write;

use isophote::map::{Map, Quantity, Values};

use crate::channel;
use crate::error::ExportError;

pub(crate) use encode::{METADATA_KEYWORD, read_json};
pub use options::{Depth, PictureColor, PictureOptions, PictureReport};

/// Writes the picture, row 0 on top; missed pixels are black, with a colour map too.
///
/// A value v becomes ((v − black)/(white − black))^(1/gamma), times 255 or 65535, rounded to nearest.
/// Colours are scaled by one range, which is from 0 to the largest component by default, and shown in sRGB with its own
/// transfer function, whatever space they are of.
/// Text chunks `Title`, `Software`, `Description` and `isophote` (the metadata's JSON) come before the pixels.
///
/// # Errors
/// No such channel, or not a scalar one; a range, gamma or depth that makes no picture; an error of `out`.
pub fn write(map: &Map, options: &PictureOptions, out: impl Write) -> Result<PictureReport, ExportError> {
    let channel = channel::find(map, &options.quantity)?;
    match (&channel.quantity, &channel.values) {
        (Quantity::Color, Values::Vector(colors)) => color::write(map, channel, colors, options, out),
        _ => numbers::write(map, channel, options, out),
    }
}
