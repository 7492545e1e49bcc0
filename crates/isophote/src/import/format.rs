//! The format of a file: chosen by its suffix, checked by its contents.

use crate::message;
use crate::text::Message;
use std::path::Path;

use super::{Fault, FilePosition, FileProblem, ImportError};

/// Formats of triangle meshes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshFormat {
    /// Wavefront OBJ.
    Obj,
    /// Polygon file format, ASCII or binary.
    Ply,
    /// Stereolithography, ASCII or binary.
    Stl,
    /// glTF 2.0 in one binary file.
    Glb,
}

impl MeshFormat {
    /// The format that a file's name implies.
    ///
    /// # Errors
    /// [`ImportError::Suffix`].
    pub fn from_suffix(file: &Path) -> Result<Self, ImportError> {
        match suffix(file).as_str() {
            "obj" => Ok(Self::Obj),
            "ply" => Ok(Self::Ply),
            "stl" => Ok(Self::Stl),
            "glb" => Ok(Self::Glb),
            _ => Err(ImportError::Suffix { file: file.into(), allowed: message!(".obj, .ply, .stl and .glb") }),
        }
    }

    pub(super) fn format(self) -> Format {
        match self {
            Self::Obj => Format::Obj,
            Self::Ply => Format::Ply,
            Self::Stl => Format::Stl,
            Self::Glb => Format::Glb,
        }
    }
}

/// Formats of lists of spheres.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpheresFormat {
    /// Comma-separated values with a line of column names.
    Csv,
    /// A single `NumPy` array.
    Npy,
    /// Polygon file format whose vertices have a radius.
    Ply,
}

impl SpheresFormat {
    /// The format that a file's name implies.
    ///
    /// # Errors
    /// [`ImportError::Suffix`].
    pub fn from_suffix(file: &Path) -> Result<Self, ImportError> {
        match suffix(file).as_str() {
            "csv" => Ok(Self::Csv),
            "npy" => Ok(Self::Npy),
            "ply" => Ok(Self::Ply),
            _ => Err(ImportError::Suffix { file: file.into(), allowed: message!(".csv, .npy and .ply") }),
        }
    }

    pub(super) fn format(self) -> Format {
        match self {
            Self::Csv => Format::Csv,
            Self::Npy => Format::Npy,
            Self::Ply => Format::Ply,
        }
    }
}

/// Accepts everything that is in this format; most files in other formats are recognised and named.
pub(super) fn check(bytes: &[u8], expected: Format) -> Result<(), Fault> {
    if bytes.is_empty() {
        return Err(FileProblem::Empty { expected: expected.name() }.at(FilePosition::Whole));
    }
    let guess = guess(bytes);
    let is_expected = match guess {
        Some(Guess::Format(format)) => format == expected,
        Some(Guess::Other(_)) => false,
        // A truncated STL file: its reader reports how much is missing.
        Some(Guess::Binary) => expected == Format::Stl,
        None => !expected.has_magic(),
    };
    if is_expected {
        return Ok(());
    }
    let looks_like = match guess {
        Some(Guess::Format(format)) => Message::verbatim(format.name()),
        Some(Guess::Other(name)) => name(),
        Some(Guess::Binary) => message!("binary data"),
        None => message!("nothing known here"),
    };
    Err(FileProblem::Foreign { expected: expected.name(), looks_like }.at(FilePosition::Whole))
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Format {
    Obj,
    Ply,
    Stl,
    Glb,
    Csv,
    Npy,
}

impl Format {
    fn name(self) -> &'static str {
        match self {
            Self::Obj => "OBJ",
            Self::Ply => "PLY",
            Self::Stl => "STL",
            Self::Glb => "glTF binary",
            Self::Csv => "CSV",
            Self::Npy => "NPY",
        }
    }

    /// Whether every file of the format starts with a magic number.
    fn has_magic(self) -> bool {
        matches!(self, Self::Ply | Self::Glb | Self::Npy)
    }
}

enum Guess {
    Format(Format),
    Other(fn() -> Message),
    Binary,
}

fn guess(bytes: &[u8]) -> Option<Guess> {
    let magic = [
        (&b"ply\n"[..], Guess::Format(Format::Ply)),
        (b"ply\r", Guess::Format(Format::Ply)),
        (b"glTF", Guess::Format(Format::Glb)),
        (b"\x93NUMPY", Guess::Format(Format::Npy)),
        (b"PK\x03\x04", Guess::Other(|| message!("a ZIP archive (NPZ, 3MF, USDZ)"))),
        (b"\x1f\x8b", Guess::Other(|| message!("a gzip archive"))),
        (b"\x89PNG", Guess::Other(|| message!("a PNG picture"))),
        (b"\x76\x2f\x31\x01", Guess::Other(|| message!("an EXR picture"))),
        (b"Kaydara FBX", Guess::Other(|| message!("an FBX scene"))),
        (b"BLENDER", Guess::Other(|| message!("a Blender scene"))),
        (b"\xff\xfe", Guess::Other(|| message!("text in UTF-16"))),
        (b"\xfe\xff", Guess::Other(|| message!("text in UTF-16"))),
    ];
    if let Some((_, guess)) = magic.into_iter().find(|(magic, _)| bytes.starts_with(magic)) {
        return Some(guess);
    }
    let start = &bytes[..bytes.len().min(1024)];
    if is_binary_stl(bytes) {
        return Some(Guess::Format(Format::Stl));
    }
    if start.contains(&0) {
        return Some(Guess::Binary);
    }
    guess_text(start)
}

/// Judged by size, because many binary files also start with the word `solid`.
pub(super) fn is_binary_stl(bytes: &[u8]) -> bool {
    let Some(count) = bytes.get(80..84) else { return false };
    let count = u32::from_le_bytes(count.try_into().expect("four bytes"));
    84 + 50 * u64::from(count) == bytes.len() as u64
}

fn guess_text(start: &[u8]) -> Option<Guess> {
    let text = String::from_utf8_lossy(start.strip_prefix(b"\xef\xbb\xbf").unwrap_or(start));
    let line = text.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'))?;
    let word = line.split_whitespace().next()?;
    match word {
        "v" | "vn" | "vt" | "f" | "o" | "g" | "s" | "mtllib" | "usemtl" => Some(Guess::Format(Format::Obj)),
        "solid" => Some(Guess::Format(Format::Stl)),
        _ if line.starts_with('{') => Some(Guess::Other(|| message!("JSON (a glTF scene goes into one file as .glb)"))),
        _ if line.starts_with('<') => Some(Guess::Other(|| message!("XML or HTML"))),
        _ if line.split(',').any(|column| matches!(column.trim(), "x" | "y" | "z" | "radius")) => {
            Some(Guess::Format(Format::Csv))
        }
        _ => None,
    }
}

fn suffix(file: &Path) -> String {
    file.extension().map(|suffix| suffix.to_string_lossy().to_lowercase()).unwrap_or_default()
}
