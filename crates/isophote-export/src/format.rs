//! The file formats.

use std::path::Path;

use isophote::units::Keyword;

/// A format in which a map can be saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// A normalised picture of one channel, or of colours: [`png::write`](crate::png::write).
    Png,
    /// All channels in 32-bit floating point: [`exr::write`](crate::exr::write).
    Exr,
    /// One channel as a `NumPy` array: [`npy::write`](crate::npy::write).
    Npy,
    /// All channels as `NumPy` arrays: [`npz::write`](crate::npz::write).
    Npz,
    /// All channels as a table, one row per pixel: [`csv::write`](crate::csv::write).
    Csv,
}

impl Keyword for Format {
    const ALL: &'static [Self] = &[Self::Png, Self::Exr, Self::Npy, Self::Npz, Self::Csv];

    /// The suffix of the file name, without its dot.
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
    /// The format for a file's suffix, in upper or lower case: `Map.PNG` is a PNG.
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Self> {
        Self::from_name(&path.extension()?.to_str()?.to_ascii_lowercase())
    }
}
