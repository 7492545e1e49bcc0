//! What can be wrong with a file of meshes or points, and where.

use crate::message;
use crate::text::Message;
use std::path::PathBuf;

use super::ReadFailure;

/// Why a file could not be imported.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.message())]
pub enum ImportError {
    /// Its contents are not available.
    Unread {
        /// The requested file.
        file: PathBuf,
        /// The reason.
        failure: ReadFailure,
    },
    /// The suffix of its name is not that of a supported format.
    Suffix {
        /// The requested file.
        file: PathBuf,
        /// The suffixes that are allowed.
        allowed: Message,
    },
    /// Something in the file is wrong.
    Content {
        /// The file.
        file: PathBuf,
        /// What is wrong, and where.
        fault: Box<Fault>,
    },
}

/// Something wrong in the contents of a file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.message())]
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
    Json(Message),
}

impl ImportError {
    /// What is wrong, in either language.
    #[must_use]
    pub fn message(&self) -> Message {
        match self {
            Self::Unread { file, failure } => failure.describe(file),
            Self::Suffix { file, allowed } => message!(
                "‘{file}’: its suffix names no format that can be read here; allowed are {allowed}",
                file = file.display(),
                allowed
            ),
            Self::Content { file, fault } => {
                message!("‘{file}’, {fault}", file = file.display(), fault = fault.message())
            }
        }
    }
}

impl Fault {
    /// What is wrong, and where, in either language.
    #[must_use]
    pub fn message(&self) -> Message {
        message!("{place}: {problem}", place = self.place.message(), problem = self.problem.message())
    }
}

impl FilePosition {
    /// The place, in either language.
    #[must_use]
    pub fn message(&self) -> Message {
        match self {
            Self::Whole => message!("the file"),
            Self::Header => message!("header"),
            Self::Line(number) => message!("line {number}", number),
            Self::Element { kind: "vertex", number } => message!("vertex {number}", number),
            Self::Element { kind: "face", number } => message!("face {number}", number),
            Self::Element { kind: "triangle", number } => message!("triangle {number}", number),
            Self::Element { kind: "sphere", number } => message!("sphere {number}", number),
            Self::Element { number, .. } => message!("row of another element {number}", number),
            Self::Json(path) => path.clone(),
        }
    }
}

/// What is wrong at a place.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.message())]
pub enum FileProblem {
    /// No contents at all.
    Empty {
        /// The format that the file's name implies.
        expected: &'static str,
    },
    /// Contents of a different format than the file's name implies.
    Foreign {
        /// The format that the file's name implies.
        expected: &'static str,
        /// What the contents look like.
        looks_like: Message,
    },
    /// A number that is infinite or NaN.
    NotFinite {
        /// The coordinate, radius or component.
        field: &'static str,
        /// Its value.
        value: f64,
    },
    /// A radius that is not positive.
    Radius {
        /// Its value.
        value: f64,
    },
    /// Text where a number is expected.
    NotANumber {
        /// The field.
        field: Message,
        /// The text found there, or its beginning.
        text: String,
        /// The kind of number.
        allowed: Message,
    },
    /// An index of an element that does not exist.
    Index {
        /// The kind of element.
        field: Message,
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
    NoDirection {
        /// Its number, as the format counts.
        number: u64,
    },
    /// A line, a row or a face has too few or too many parts.
    Parts {
        /// The line, row or face.
        what: Message,
        /// The number of parts found.
        found: u64,
        /// The allowed number of parts.
        allowed: Message,
    },
    /// The file ends before the data that it announces.
    Truncated {
        /// What was announced, with its number.
        what: Message,
        /// The number of bytes that it takes.
        needed: u128,
        /// The number of bytes that are left.
        left: u64,
    },
    /// The file continues after the data that it announces.
    Leftover {
        /// What was announced, with its number.
        what: Message,
        /// The number of extra bytes.
        left: u64,
    },
    /// Something that the format or this reader requires is missing.
    Missing {
        /// What is missing.
        what: Message,
        /// What is needed, and why.
        needed: Message,
    },
    /// A value that is not one of those that the format allows.
    Unexpected {
        /// The item concerned.
        what: Message,
        /// The value found there, or its beginning.
        found: String,
        /// The allowed values.
        allowed: Message,
    },
    /// A feature of the format that is not supported.
    Unsupported {
        /// The feature.
        what: Message,
        /// What to do instead.
        instead: Message,
    },
    /// More items than can be counted.
    TooMany {
        /// The kind of item.
        what: Message,
        /// The maximum number.
        most: u64,
    },
    /// No triangle with an area.
    NoTriangles {
        /// The number of triangles without area.
        degenerate: u64,
    },
    /// No sphere.
    NoSpheres,
}

impl FileProblem {
    /// The fault with this problem at a place.
    pub(super) fn at(self, place: FilePosition) -> Fault {
        Fault { place, problem: self }
    }

    /// What is wrong, in either language.
    #[must_use]
    pub fn message(&self) -> Message {
        match self {
            Self::Empty { expected } => message!("it is empty; {expected} is needed", expected),
            Self::Foreign { expected, looks_like } => {
                message!("it is no {expected} file: it looks like {looks_like}", expected, looks_like)
            }
            Self::NotFinite { field, value } => message!("{field} is {value}; it must be finite", field, value),
            Self::Radius { value } => message!("radius is {value}; it must be greater than 0", value),
            Self::NotANumber { field, text, allowed } => {
                message!("{field} is ‘{text}’; {allowed} is needed", field, text, allowed)
            }
            Self::Index { field, index, first, count, backwards } => {
                let allowed = allowed_indices(*first, *count, *backwards);
                message!("{field} is {index}; {allowed}", field, index, allowed)
            }
            Self::NoDirection { number } => {
                message!("normal {number} of a triangle's corner is (0, 0, 0); a normal needs a direction", number)
            }
            Self::Parts { what, found, allowed } => message!("{what} has {found}; {allowed}", what, found, allowed),
            Self::Truncated { what, needed, left } => {
                message!("{what} need {needed} bytes, but {left} are left in the file", what, needed, left)
            }
            Self::Leftover { what, left } => {
                message!("{left} bytes follow after {what}; nothing may follow", left, what)
            }
            Self::Missing { what, needed } => message!("{what} is missing; {needed}", what, needed),
            Self::Unexpected { what, found, allowed } => {
                message!("{what} is ‘{found}’; allowed: {allowed}", what, found, allowed)
            }
            Self::Unsupported { what, instead } => {
                message!("{what} cannot be read here; {instead}", what, instead)
            }
            Self::TooMany { what, most } => message!("there are more than {most} {what}", most, what),
            Self::NoTriangles { degenerate } => {
                message!("it has no triangles with an area ({degenerate} without)", degenerate)
            }
            Self::NoSpheres => message!("it has no spheres"),
        }
    }
}

fn allowed_indices(first: u64, count: u64, backwards: u64) -> Message {
    let Some(last) = (first + count).checked_sub(1).filter(|_| count > 0) else { return message!("there are none") };
    if backwards == 0 {
        message!("allowed are {first} to {last}", first, last)
    } else {
        message!("allowed are {first} to {last}, or -{backwards} to -1 counted backwards", first, last, backwards)
    }
}
