//! Errors of writing a file.

use std::io;
use std::path::PathBuf;

use isophote::map::Pixel;
use isophote::message;
use isophote::text::Message;
use isophote::units::Keyword;

use crate::format::Format;

/// Why a map could not be saved.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.message())]
pub enum ExportError {
    /// A writer failed; [`write_atomically`](crate::write_atomically) turns this into [`ExportError::File`].
    Write(#[from] io::Error),
    /// The file could not be created or written.
    File {
        /// The requested file.
        path: PathBuf,
        /// The system's error.
        reason: io::Error,
    },
    /// The folder of the file does not exist.
    NoFolder {
        /// The requested file.
        path: PathBuf,
        /// The missing folder.
        folder: PathBuf,
    },
    /// The name belongs to something that must not be replaced by a file.
    Taken {
        /// The requested file.
        path: PathBuf,
        /// `a folder`, `a read-only file`, …
        what: Message,
    },
    /// The map does not have the channel.
    NoChannel {
        /// The requested channel.
        name: String,
        /// The channels that the map has.
        available: String,
    },
    /// The channel is neither scalar nor colours.
    NotPicture {
        /// The requested channel.
        name: String,
        /// `three numbers`, `an index`.
        holds: Message,
    },
    /// A colour map or gamma was requested for a channel that is shown in its own colours.
    ColorStyle {
        /// The requested channel.
        name: String,
    },
    /// The values of black and white are not two finite numbers in ascending order.
    Range {
        /// The requested channel.
        name: String,
        /// The values of black and white.
        range: [f64; 2],
    },
    /// A logarithm needs positive numbers.
    LogRange {
        /// The requested channel.
        name: String,
        /// The values of black and white.
        range: [f64; 2],
    },
    /// The exponent is not a positive number.
    Gamma {
        /// The requested value.
        gamma: f64,
    },
    /// Colour maps have only 8 bits.
    ColorDepth {
        /// Name of the colour map.
        color: String,
    },
    /// A value has no finite 32-bit counterpart, or an index no exact one.
    Overflow {
        /// The channel.
        name: String,
        /// Its value at that pixel.
        value: f64,
        /// The first such pixel, in coordinates of the full image.
        pixel: Pixel,
    },
    /// A limit of the format is exceeded.
    Unsuitable {
        /// The requested format.
        format: Format,
        /// The limit.
        reason: Message,
    },
}

impl ExportError {
    /// What is wrong, in either language; what the operating system says is as it says it.
    #[must_use]
    pub fn message(&self) -> Message {
        match self {
            Self::Write(reason) => message!("cannot write: {reason}", reason = reason.to_string()),
            Self::File { path, reason } => {
                message!("cannot write ‘{path}’: {reason}", path = path.display(), reason = reason.to_string())
            }
            Self::NoFolder { path, folder } => message!(
                "cannot write ‘{path}’: there is no folder ‘{folder}’",
                path = path.display(),
                folder = folder.display()
            ),
            Self::Taken { path, what } => message!("cannot write ‘{path}’: it is {what}", path = path.display(), what),
            Self::NoChannel { name, available } => {
                message!("no channel ‘{name}’ in this map: it has {available}", name, available)
            }
            Self::NotPicture { name, holds } => {
                message!("channel ‘{name}’ cannot be a picture: it holds {holds} at each pixel", name, holds)
            }
            Self::ColorStyle { name } => {
                message!("channel ‘{name}’ is shown in its own colours: without a colour map, without gamma", name)
            }
            Self::Range { name, range: [low, high] } => {
                message!("range {low} to {high} of ‘{name}’: black must be below white, both finite", low, high, name)
            }
            Self::LogRange { name, range: [low, high] } => message!(
                "range {low} to {high} of ‘{name}’: on a logarithmic scale black must be above 0",
                low,
                high,
                name
            ),
            Self::Gamma { gamma } => message!("gamma {gamma}: must be finite and above 0", gamma),
            Self::ColorDepth { color } => {
                message!("depth 16 with colours ‘{color}’: colour maps have 8 bits, only grey pictures have 16", color)
            }
            Self::Overflow { name, value, pixel } => message!(
                "channel ‘{name}’ is {value} at column {column}, row {row}: EXR holds 32-bit numbers, up to 3.4e38, and whole ones up to 16777216",
                name,
                value = format!("{value:e}"),
                column = pixel.column,
                row = pixel.row
            ),
            Self::Unsuitable { format, reason } => {
                message!("cannot be saved as {format}: {reason}", format = format.name(), reason)
            }
        }
    }
}
