//! What can be wrong with a file of meshes or points, and where.

use std::{fmt, path::PathBuf};

use super::ReadFailure;

/// Why a file could not be imported.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// Its contents are not available.
    #[error("{}", failure.describe(file))]
    Unread {
        /// The requested file.
        file: PathBuf,
        /// The reason.
        failure: ReadFailure,
    },
    /// The suffix of its name is not that of a supported format.
    #[error("‘{}’: its suffix names no format that can be read here; allowed are {allowed}", file.display())]
    Suffix {
        /// The requested file.
        file: PathBuf,
        /// The suffixes that are allowed.
        allowed: &'static str,
    },
    /// Something in the file is wrong.
    #[error("‘{}’, {fault}", file.display())]
    Content {
        /// The file.
        file: PathBuf,
        /// What is wrong, and where.
        fault: Box<Fault>,
    },
}

/// Something wrong in the contents of a file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{place}: {problem}")]
pub struct Fault {
    /// Where in the file.
    pub place: FilePosition,
    /// What is wrong there.
    pub problem: FileProblem,
}

/// A place in a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FilePosition {
    /// The file as a whole.
    Whole,
    /// The header of a binary file.
    Header,
    /// A line, counted from 1.
    Line(u64),
    /// A vertex, a face, a triangle or a sphere of a binary file, counted from 0.
    Element {
        /// The kind of element.
        kind: &'static str,
        /// Its number.
        number: u64,
    },
    /// A part of a glTF document.
    Json(String),
}

impl fmt::Display for FilePosition {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole => write!(out, "the file"),
            Self::Header => write!(out, "header"),
            Self::Line(number) => write!(out, "line {number}"),
            Self::Element { kind, number } => write!(out, "{kind} {number}"),
            Self::Json(path) => write!(out, "{path}"),
        }
    }
}

/// What is wrong at a place.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FileProblem {
    /// No contents at all.
    #[error("it is empty; {expected} is needed")]
    Empty {
        /// The format that the file's name implies.
        expected: &'static str,
    },
    /// Contents of a different format than the file's name implies.
    #[error("it is no {expected} file: it looks like {looks_like}")]
    Foreign {
        /// The format that the file's name implies.
        expected: &'static str,
        /// What the contents look like.
        looks_like: &'static str,
    },
    /// A number that is infinite or NaN.
    #[error("{field} is {value}; it must be finite")]
    NotFinite {
        /// The coordinate, radius or component.
        field: &'static str,
        /// Its value.
        value: f64,
    },
    /// A radius that is not positive.
    #[error("radius is {value}; it must be greater than 0")]
    Radius {
        /// Its value.
        value: f64,
    },
    /// Text where a number is expected.
    #[error("{field} is ‘{text}’; {allowed} is needed")]
    NotANumber {
        /// The field.
        field: String,
        /// The text found there, or its beginning.
        text: String,
        /// The kind of number.
        allowed: &'static str,
    },
    /// An index of an element that does not exist.
    #[error("{field} is {index}; {}", allowed_indices(*first, *count, *backwards))]
    Index {
        /// The kind of element.
        field: &'static str,
        /// The index as written.
        index: i64,
        /// The index of the first element: 1 in OBJ, 0 elsewhere.
        first: u64,
        /// The number of elements.
        count: u64,
        /// The number of elements that negative indices can refer to.
        backwards: u64,
    },
    /// A normal of length zero.
    #[error("normal {number} of a triangle's corner is (0, 0, 0); a normal needs a direction")]
    NoDirection {
        /// Its number, as the format counts.
        number: u64,
    },
    /// A line, a row or a face has too few or too many parts.
    #[error("{what} has {found}; {allowed}")]
    Parts {
        /// The line, row or face.
        what: String,
        /// The number of parts found.
        found: u64,
        /// The allowed number of parts.
        allowed: String,
    },
    /// The file ends before the data that it announces.
    #[error("{what} need {needed} bytes, but {left} are left in the file")]
    Truncated {
        /// What was announced, with its number.
        what: String,
        /// The number of bytes that it takes.
        needed: u128,
        /// The number of bytes that are left.
        left: u64,
    },
    /// The file continues after the data that it announces.
    #[error("{left} bytes follow after {what}; nothing may follow")]
    Leftover {
        /// What was announced, with its number.
        what: String,
        /// The number of extra bytes.
        left: u64,
    },
    /// Something that the format or this reader requires is missing.
    #[error("{what} is missing; {needed}")]
    Missing {
        /// What is missing.
        what: String,
        /// What is needed, and why.
        needed: &'static str,
    },
    /// A value that is not one of those that the format allows.
    #[error("{what} is ‘{found}’; allowed: {allowed}")]
    Unexpected {
        /// The item concerned.
        what: String,
        /// The value found there, or its beginning.
        found: String,
        /// The allowed values.
        allowed: String,
    },
    /// A feature of the format that is not supported.
    #[error("{what} cannot be read here; {instead}")]
    Unsupported {
        /// The feature.
        what: String,
        /// What to do instead.
        instead: &'static str,
    },
    /// More items than can be counted.
    #[error("there are more than {most} {what}")]
    TooMany {
        /// The kind of item.
        what: &'static str,
        /// The maximum number.
        most: u64,
    },
    /// No triangle with an area.
    #[error("it has no triangles with an area ({degenerate} without)")]
    NoTriangles {
        /// The number of triangles without area.
        degenerate: u64,
    },
    /// No sphere.
    #[error("it has no spheres")]
    NoSpheres,
}

impl FileProblem {
    /// The fault with this problem at a place.
    pub(super) fn at(self, place: FilePosition) -> Fault {
        Fault { place, problem: self }
    }
}

fn allowed_indices(first: u64, count: u64, backwards: u64) -> String {
    let forwards = match (count, first + count) {
        (0, _) => return "there are none".into(),
        (_, end) => format!("allowed are {first} to {}", end - 1),
    };
    if backwards == 0 { forwards } else { format!("{forwards}, or -{backwards} to -1 counted backwards") }
}
