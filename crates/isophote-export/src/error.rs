//! What can go wrong with a file that is written.

use std::io;
use std::path::PathBuf;

use isophote::map::Pixel;
use isophote::units::Keyword;

use crate::format::Format;

/// Why a map was not saved.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// A writer could not write on; [`write_atomically`](crate::write_atomically) turns it into [`ExportError::File`].
    #[error("cannot write: {0}")]
    Write(#[from] io::Error),
    /// The file could not be made or filled.
    #[error("cannot write ‘{}’: {reason}", path.display())]
    File {
        /// The file asked for.
        path: PathBuf,
        /// What the system said.
        reason: io::Error,
    },
    /// The folder of the file does not exist.
    #[error("cannot write ‘{}’: there is no folder ‘{}’", path.display(), folder.display())]
    NoFolder {
        /// The file asked for.
        path: PathBuf,
        /// The folder it would be in.
        folder: PathBuf,
    },
    /// The name is taken by something that a file must not replace.
    #[error("cannot write ‘{}’: it is {what}", path.display())]
    Taken {
        /// The file asked for.
        path: PathBuf,
        /// `a folder`, `a read-only file`, …
        what: &'static str,
    },
    /// The map lacks the channel.
    #[error("no channel ‘{name}’ in this map: it has {available}")]
    NoChannel {
        /// The channel asked for.
        name: String,
        /// The channels that there are.
        available: String,
    },
    /// The channel is not one number of a unit per pixel.
    #[error("channel ‘{name}’ cannot be a picture: it holds {holds} at each pixel")]
    NotPicture {
        /// The channel asked for.
        name: String,
        /// `three numbers`, `an index`.
        holds: &'static str,
    },
    /// Colours are shown as they are.
    #[error("channel ‘{name}’ is shown in its own colours: without a colour map, without gamma")]
    ColorStyle {
        /// The channel asked for.
        name: String,
    },
    /// Black and white are not two finite numbers in this order.
    #[error("range {} to {} of ‘{name}’: black must be below white, both finite", range[0], range[1])]
    Range {
        /// The channel asked for.
        name: String,
        /// The values of black and white.
        range: [f64; 2],
    },
    /// The exponent is not a positive number.
    #[error("gamma {gamma}: must be finite and above 0")]
    Gamma {
        /// The value asked for.
        gamma: f64,
    },
    /// Colour functions give 8 bits.
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
        /// Its value there.
        value: f64,
        /// The first such pixel, counted in the full image.
        pixel: Pixel,
    },
    /// The format's own limits are exceeded.
    #[error("cannot be saved as {}: {reason}", format.name())]
    Unsuitable {
        /// The format asked for.
        format: Format,
        /// The limit.
        reason: String,
    },
}
