//! Errors of writing a file.

use std::io;
use std::path::PathBuf;

use isophote::map::Pixel;
use isophote::units::Keyword;

use crate::format::Format;

/// Why a map could not be saved.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// A writer failed; [`write_atomically`](crate::write_atomically) turns this into [`ExportError::File`].
    #[error("cannot write: {0}")]
    Write(#[from] io::Error),
    /// The file could not be created or written.
    #[error("cannot write ‘{}’: {reason}", path.display())]
    File {
        /// The requested file.
        path: PathBuf,
        /// The system's error.
        reason: io::Error,
    },
    /// The folder of the file does not exist.
    #[error("cannot write ‘{}’: there is no folder ‘{}’", path.display(), folder.display())]
    NoFolder {
        /// The requested file.
        path: PathBuf,
        /// The missing folder.
        folder: PathBuf,
    },
    /// The name belongs to something that must not be replaced by a file.
    #[error("cannot write ‘{}’: it is {what}", path.display())]
    Taken {
        /// The requested file.
        path: PathBuf,
        /// `a folder`, `a read-only file`, …
        what: &'static str,
    },
    /// The map does not have the channel.
    #[error("no channel ‘{name}’ in this map: it has {available}")]
    NoChannel {
        /// The requested channel.
        name: String,
        /// The channels that the map has.
        available: String,
    },
    /// The channel is neither scalar nor colours.
    #[error("channel ‘{name}’ cannot be a picture: it holds {holds} at each pixel")]
    NotPicture {
        /// The requested channel.
        name: String,
        /// `three numbers`, `an index`.
        holds: &'static str,
    },
    /// A colour map or gamma was requested for a channel that is shown in its own colours.
    #[error("channel ‘{name}’ is shown in its own colours: without a colour map, without gamma")]
    ColorStyle {
        /// The requested channel.
        name: String,
    },
    /// The values of black and white are not two finite numbers in ascending order.
    #[error("range {} to {} of ‘{name}’: black must be below white, both finite", range[0], range[1])]
    Range {
        /// The requested channel.
        name: String,
        /// The values of black and white.
        range: [f64; 2],
    },
    /// A logarithm needs positive numbers.
    #[error("range {} to {} of ‘{name}’: on a logarithmic scale black must be above 0", range[0], range[1])]
    LogRange {
        /// The requested channel.
        name: String,
        /// The values of black and white.
        range: [f64; 2],
    },
    /// The exponent is not a positive number.
    #[error("gamma {gamma}: must be finite and above 0")]
    Gamma {
        /// The requested value.
        gamma: f64,
    },
    /// Colour maps have only 8 bits.
    #[error("depth 16 with colours ‘{color}’: colour maps have 8 bits, only grey pictures have 16")]
    ColorDepth {
        /// Name of the colour map.
        color: String,
    },
    /// A value has no finite 32-bit counterpart, or an index no exact one.
    #[error(
        "channel ‘{name}’ is {value:e} at column {}, row {}: EXR holds 32-bit numbers, up to 3.4e38, and whole ones up to 16777216",
        pixel.column, pixel.row
    )]
    Overflow {
        /// The channel.
        name: String,
        /// Its value at that pixel.
        value: f64,
        /// The first such pixel, in coordinates of the full image.
        pixel: Pixel,
    },
    /// A limit of the format is exceeded.
    #[error("cannot be saved as {}: {reason}", format.name())]
    Unsuitable {
        /// The requested format.
        format: Format,
        /// The limit.
        reason: String,
    },
}
