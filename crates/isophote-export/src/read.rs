//! What a file says about itself, whatever its format and whatever its name.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek};
use std::path::{Path, PathBuf};

use isophote::units::Keyword;

use crate::format::Format;
use crate::metadata::FileMetadata;
use crate::{csv, exr, npy, npz, png};

/// The description that a file carries; its format is told by its first bytes, not by its name.
///
/// # Errors
/// [`ReadError`]; never a panic, and never more memory than a small multiple of the description's length.
pub fn read_metadata(path: &Path) -> Result<FileMetadata, ReadError> {
    let file = File::open(path).map_err(|reason| ReadError::File { path: path.into(), reason })?;
    read_metadata_from(file, path)
}

/// The same from whatever can be read, such as a [`Cursor`](io::Cursor) over bytes; `path` is what errors call it. It
/// must be able to seek: NPY and NPZ have their descriptions at the end.
///
/// # Errors
/// [`ReadError`], as for a file.
pub fn read_metadata_from(file: impl Read + Seek, path: &Path) -> Result<FileMetadata, ReadError> {
    let unreadable = |reason| ReadError::File { path: path.into(), reason };
    let mut file = BufReader::new(file);
    let format = format_of(&mut file).map_err(unreadable)?.ok_or_else(|| ReadError::Foreign { path: path.into() })?;
    let damaged = |reason| ReadError::Damaged { path: path.into(), format, reason };
    let json = json_of(format, &mut file).map_err(damaged)?;
    let json = json.ok_or_else(|| ReadError::NoMetadata { path: path.into(), format })?;
    match serde_json::from_slice(&json).map_err(|error| damaged(error.to_string()))? {
        Version { isophote: version } if version > FileMetadata::VERSION => {
            Err(ReadError::Newer { path: path.into(), version })
        }
        Version { .. } => serde_json::from_slice(&json).map_err(|error| damaged(error.to_string())),
    }
}

/// Why a file's description could not be read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file cannot be opened or read.
    #[error("cannot read ‘{}’: {reason}", path.display())]
    File {
        /// The file asked for.
        path: PathBuf,
        /// What the system said.
        reason: io::Error,
    },
    /// Its beginning is that of no format which this program writes.
    #[error("‘{}’ is no PNG, EXR, NPY, NPZ or CSV file of Isophote", path.display())]
    Foreign {
        /// The file asked for.
        path: PathBuf,
    },
    /// It is sound, but another program's.
    #[error("‘{}’ ({}) carries no Isophote metadata", path.display(), format.name())]
    NoMetadata {
        /// The file asked for.
        path: PathBuf,
        /// Its format.
        format: Format,
    },
    /// It is cut off or changed.
    #[error("‘{}’ ({}) is damaged: {reason}", path.display(), format.name())]
    Damaged {
        /// The file asked for.
        path: PathBuf,
        /// Its format.
        format: Format,
        /// What does not fit.
        reason: String,
    },
    /// A later program wrote it.
    #[error("‘{}’ has metadata of version {version}; this program reads up to {}", path.display(), FileMetadata::VERSION)]
    Newer {
        /// The file asked for.
        path: PathBuf,
        /// Its version.
        version: u32,
    },
}

/// Read by itself first: a later version may lack fields that this one needs, which is not damage.
#[derive(serde::Deserialize)]
struct Version {
    isophote: u32,
}

fn format_of(file: &mut (impl Read + Seek)) -> io::Result<Option<Format>> {
    let mut start = Vec::new();
    file.by_ref().take(8).read_to_end(&mut start)?;
    file.rewind()?;
    let magic = [
        (&b"\x89PNG\r\n\x1a\n"[..], Format::Png),
        (b"\x76\x2f\x31\x01", Format::Exr),
        (npy::MAGIC, Format::Npy),
        (b"PK\x03\x04", Format::Npz),
        (b"# isopho", Format::Csv),
    ];
    Ok(magic.into_iter().find(|(magic, _)| start.starts_with(magic)).map(|(_, format)| format))
}

/// The JSON that a file of this format carries, none if it is another program's, or what is wrong with the file.
pub(crate) fn json_of(format: Format, file: &mut (impl BufRead + Seek)) -> Result<Option<Vec<u8>>, String> {
    match format {
        Format::Png => png::read_json(file),
        Format::Exr => exr::read_json(file),
        Format::Npy => npy::read_json(file),
        Format::Npz => npz::read_json(file),
        Format::Csv => csv::read_json(file),
    }
}
