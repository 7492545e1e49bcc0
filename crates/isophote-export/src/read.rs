//! Reads what a file says about itself, in any format and under any name.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek};
use std::path::{Path, PathBuf};

use isophote::units::Keyword;

use crate::format::Format;
use crate::metadata::FileMetadata;
use crate::{csv, exr, npy, npz, png};

/// The description that a file carries; the format is recognised by the first bytes, not by the name.
///
/// # Errors
/// [`ReadError`]; never a panic, and never more memory than a small multiple of the description's length.
pub fn read_metadata(path: &Path) -> Result<FileMetadata, ReadError> {
    let file = File::open(path).map_err(|reason| ReadError::File { path: path.into(), reason })?;
    read_metadata_from(file, path)
}

/// Like [`read_metadata`], from any reader, such as a [`Cursor`](io::Cursor) over bytes; `path` is used in error
/// messages. The reader must be seekable: NPY and NPZ have their descriptions at the end.
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
        /// The requested file.
        path: PathBuf,
        /// The system's error.
        reason: io::Error,
    },
    /// Its first bytes match no format that this program writes.
    #[error("‘{}’ is no PNG, EXR, NPY, NPZ or CSV file of Isophote", path.display())]
    Foreign {
        /// The requested file.
        path: PathBuf,
    },
    /// The file is valid, but written by another program.
    #[error("‘{}’ ({}) carries no Isophote metadata", path.display(), format.name())]
    NoMetadata {
        /// The requested file.
        path: PathBuf,
        /// Its format.
        format: Format,
    },
    /// The file is truncated or altered.
    #[error("‘{}’ ({}) is damaged: {reason}", path.display(), format.name())]
    Damaged {
        /// The requested file.
        path: PathBuf,
        /// Its format.
        format: Format,
        /// What is wrong.
        reason: String,
    },
    /// The file was written by a newer version of the program.
    #[error("‘{}’ has metadata of version {version}; this program reads up to {}", path.display(), FileMetadata::VERSION)]
    Newer {
        /// The requested file.
        path: PathBuf,
        /// Its version.
        version: u32,
    },
}

/// Read separately first: a newer version may lack fields that this one needs, and that is not damage.
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

/// The JSON that a file of this format carries; none if another program wrote it; an error if the file is damaged.
pub(crate) fn json_of(format: Format, file: &mut (impl BufRead + Seek)) -> Result<Option<Vec<u8>>, String> {
    match format {
        Format::Png => png::read_json(file),
        Format::Exr => exr::read_json(file),
        Format::Npy => npy::read_json(file),
        Format::Npz => npz::read_json(file),
        Format::Csv => csv::read_json(file),
    }
}
