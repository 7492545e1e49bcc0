//! Files: a [`Map`] as a picture, as layers, as arrays, as a table, or as a figure for a report.
//!
//! Every writer takes the map and a place to write to, so that the caller decides on names, interrupts and progress;
//! [`write_atomically`] puts the bytes under a name only when they are complete. Every file carries a
//! [`FileMetadata`], which [`read_metadata`] finds again, and the same map gives the same bytes on every run.

pub mod atomic;
mod color_scale;
pub mod colormap;
mod colormap_tables;
pub mod csv;
pub mod exr;
pub mod figure;
pub mod metadata;
pub mod names;
pub mod npy;
pub mod npz;
pub mod png;
pub mod read;
#[cfg(test)]
mod tests;

use std::{io, path::Path, path::PathBuf};

pub use self::{
    atomic::write_atomically,
    metadata::{ChannelMetadata, FileMetadata, PictureMetadata},
    read::{ReadError, read_metadata},
};
use crate::{
    map::{Channel, Map, Pixel, Quantity},
    units::Keyword,
};

/// What a map can be saved as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// A picture of one channel, normalised, or of colours: [`png::write`].
    Png,
    /// All channels in 32-bit floating point: [`exr::write`].
    Exr,
    /// One channel as a `NumPy` array: [`npy::write`].
    Npy,
    /// All channels as `NumPy` arrays: [`npz::write`].
    Npz,
    /// All channels as a table, one row a pixel: [`csv::write`].
    Csv,
}

impl Keyword for Format {
    const ALL: &'static [Self] = &[Self::Png, Self::Exr, Self::Npy, Self::Npz, Self::Csv];

    /// The suffix of the file's name, without its dot.
    fn name(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Exr => "exr",
            Self::Npy => "npy",
            Self::Npz => "npz",
            Self::Csv => "csv",
        }
    }
}

impl Format {
    /// The format that a file's suffix asks for, in either case: `Map.PNG` is a PNG.
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Self> {
        Self::from_name(&path.extension()?.to_str()?.to_ascii_lowercase())
    }
}

/// Why a map was not saved.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// A writer could not write on; [`write_atomically`] turns it into [`ExportError::File`].
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

fn channel<'a>(map: &'a Map, quantity: &Quantity) -> Result<&'a Channel, ExportError> {
    map.channel(quantity).ok_or_else(|| ExportError::NoChannel {
        name: quantity.name(),
        available: map.channels().iter().map(|channel| channel.quantity.name()).collect::<Vec<_>>().join(", "),
    })
}

/// Control characters would end a comment line of a table or a text chunk early; the metadata's JSON has them escaped.
fn one_line(text: &str) -> String {
    text.chars().map(|character| if character.is_control() { ' ' } else { character }).collect()
}
