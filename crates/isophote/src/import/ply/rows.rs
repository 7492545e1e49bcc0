//! The values of a PLY file, row by row.

use crate::message;
use crate::text::Message;
use memchr::memchr;

use super::{
    Element, Header, Kind,
    header::{Encoding, Property},
};
use crate::import::{
    Fault, FilePosition, FileProblem,
    text::{integer, number, shown, words},
};

/// The data after the header.
pub(in crate::import) struct Rows<'a> {
    rest: &'a [u8],
    encoding: Encoding,
    /// The number of lines so far, in an ASCII file.
    line: u64,
}

/// One row of an element.
pub(in crate::import) struct Row<'a> {
    /// A value for each property; a list has its length here.
    pub values: &'a [f64],
    /// The values of the one requested list.
    pub list: &'a [f64],
}

impl<'a> Rows<'a> {
    pub fn new(header: &Header, rest: &'a [u8]) -> Self {
        Self { rest, encoding: header.encoding, line: header.lines }
    }

    /// Calls `take` with each row of the element, which must be the next one in the file.
    pub fn read(
        &mut self,
        element: &Element,
        list: Option<usize>,
        mut take: impl FnMut(Row) -> Result<(), FileProblem>,
    ) -> Result<(), Fault> {
        self.check_length(element).map_err(|problem| problem.at(FilePosition::Header))?;
        let mut values = vec![0.0; element.properties.len()];
        let mut wanted = Vec::new();
        for number in 0..element.count {
            let mut source = self.source(element, number)?;
            let place = self.place(element, number);
            wanted.clear();
            let row = source.row(element, list, &mut values, &mut wanted);
            let row = row.and_then(|()| take(Row { values: &values, list: &wanted }));
            row.map_err(|problem| problem.at(place))?;
            if let Source::Bytes { rest, .. } = source {
                self.rest = rest;
            }
        }
        Ok(())
    }

    /// Checks that the file ends here.
    pub fn finish(mut self) -> Result<(), Fault> {
        let left = match self.encoding {
            Encoding::Ascii => self.line().map_or(0, |line| (line.len() + self.rest.len()) as u64),
            Encoding::Little | Encoding::Big => self.rest.len() as u64,
        };
        if left == 0 {
            return Ok(());
        }
        Err(FileProblem::Leftover { what: message!("the last element that the header announces"), left }
            .at(FilePosition::Whole))
    }

    /// Checks that there are no more rows than the data has room for.
    fn check_length(&self, element: &Element) -> Result<(), FileProblem> {
        if element.properties.is_empty() {
            let what = message!("a property of element {element}", element = element.name);
            return Err(FileProblem::Missing { what, needed: message!("an element without any has nothing to read") });
        }
        let row: usize = match self.encoding {
            // A digit and the separator after it.
            Encoding::Ascii => 2 * element.properties.len(),
            _ => element.properties.iter().map(|property| property.length.unwrap_or(property.kind).size()).sum(),
        };
        let last_separator = u128::from(self.encoding == Encoding::Ascii);
        let needed = (u128::from(element.count) * row as u128).saturating_sub(last_separator);
        let left = self.rest.len() as u64;
        if needed <= left.into() {
            return Ok(());
        }
        Err(FileProblem::Truncated {
            what: message!("{count} rows of element {element}", count = element.count, element = element.name),
            needed,
            left,
        })
    }

    fn source(&mut self, element: &Element, number: u64) -> Result<Source<'a>, Fault> {
        match self.encoding {
            Encoding::Ascii => self.line().map(|line| Source::Line { left: line, taken: 0 }).ok_or_else(|| {
                let what = message!("element {name}", name = element.name);
                let allowed = message!("the header announces {count} rows", count = element.count);
                FileProblem::Parts { what, found: number, allowed }.at(FilePosition::Line(self.line))
            }),
            encoding => Ok(Source::Bytes { rest: self.rest, is_big: encoding == Encoding::Big }),
        }
    }

    /// The next nonempty line.
    fn line(&mut self) -> Option<&'a [u8]> {
        while !self.rest.is_empty() {
            let end = memchr(b'\n', self.rest).unwrap_or(self.rest.len());
            let line = self.rest[..end].trim_ascii();
            self.rest = &self.rest[(end + 1).min(self.rest.len())..];
            self.line += 1;
            if !line.is_empty() {
                return Some(line);
            }
        }
        None
    }

    fn place(&self, element: &Element, number: u64) -> FilePosition {
        if self.encoding == Encoding::Ascii {
            return FilePosition::Line(self.line);
        }
        let kind = match element.name.as_str() {
            "vertex" => "vertex",
            "face" => "face",
            _ => "row of another element",
        };
        FilePosition::Element { kind, number }
    }
}

enum Source<'a> {
    Line { left: &'a [u8], taken: u64 },
    Bytes { rest: &'a [u8], is_big: bool },
}

impl Source<'_> {
    fn row(
        &mut self,
        element: &Element,
        wanted: Option<usize>,
        values: &mut [f64],
        list: &mut Vec<f64>,
    ) -> Result<(), FileProblem> {
        for (index, (property, value)) in element.properties.iter().zip(values).enumerate() {
            *value = self.value(property.length.unwrap_or(property.kind), &property.name)?;
            if property.length.is_some() {
                self.list(property, *value, (wanted == Some(index)).then_some(&mut *list))?;
            }
        }
        let Self::Line { left, taken } = self else { return Ok(()) };
        let more = words(left).count() as u64;
        if more == 0 {
            return Ok(());
        }
        let allowed = message!("its properties take {taken}", taken = *taken);
        Err(FileProblem::Parts { what: message!("the row, by its numbers,"), found: *taken + more, allowed })
    }

    fn list(&mut self, property: &Property, length: f64, list: Option<&mut Vec<f64>>) -> Result<(), FileProblem> {
        if length < 0.0 {
            let field = message!("the length of list {name}", name = property.name);
            return Err(FileProblem::NotANumber { field, text: length.to_string(), allowed: message!("0 or more") });
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number of 32 bits")]
        let length = length as u64;
        if let Self::Bytes { rest, .. } = self {
            let (needed, left) = (u128::from(length) * property.kind.size() as u128, rest.len() as u64);
            if needed > left.into() {
                let what = message!("{count} values of list {name}", count = length, name = property.name);
                return Err(FileProblem::Truncated { what, needed, left });
            }
        }
        let mut unused = Vec::new();
        let list = list.unwrap_or(&mut unused);
        for _ in 0..length {
            list.push(self.value(property.kind, &property.name)?);
        }
        Ok(())
    }

    fn value(&mut self, kind: Kind, name: &str) -> Result<f64, FileProblem> {
        match self {
            Self::Line { left, taken } => {
                let start = left.trim_ascii_start();
                let end = start.iter().position(u8::is_ascii_whitespace).unwrap_or(start.len());
                let (word, after) = start.split_at(end);
                if word.is_empty() {
                    let what = message!("the row, by its numbers,");
                    let allowed = message!("property {name} is missing", name);
                    return Err(FileProblem::Parts { what, found: *taken, allowed });
                }
                (*left, *taken) = (after, *taken + 1);
                if kind.is_integer() { whole_number(word, name) } else { number(word, name) }
            }
            Self::Bytes { rest, is_big } => {
                let Some((bytes, after)) = rest.split_at_checked(kind.size()) else {
                    let what = message!("the values of property {name}", name);
                    return Err(FileProblem::Truncated { what, needed: kind.size() as u128, left: rest.len() as u64 });
                };
                *rest = after;
                Ok(decoded(kind, bytes, *is_big))
            }
        }
    }
}

/// No integer type of PLY is wider than 32 bits, and a double holds all of these exactly.
fn whole_number(word: &[u8], name: &str) -> Result<f64, FileProblem> {
    let value = integer(word, || Message::verbatim(name))?;
    let value = i32::try_from(value).map(f64::from).or_else(|_| u32::try_from(value).map(f64::from));
    let allowed = || message!("a whole number of 32 bits");
    value.map_err(|_| FileProblem::NotANumber { field: Message::verbatim(name), text: shown(word), allowed: allowed() })
}

/// All of these types fit into a double.
fn decoded(kind: Kind, bytes: &[u8], is_big: bool) -> f64 {
    let mut little = [0; 8];
    for (to, from) in little.iter_mut().zip(bytes) {
        *to = *from;
    }
    let little = &mut little[..bytes.len()];
    if is_big {
        little.reverse();
    }
    let [a, b, c, d] = [0, 1, 2, 3].map(|i| little.get(i).copied().unwrap_or(0));
    match kind {
        Kind::I8 => f64::from(a.cast_signed()),
        Kind::U8 => f64::from(a),
        Kind::I16 => f64::from(i16::from_le_bytes([a, b])),
        Kind::U16 => f64::from(u16::from_le_bytes([a, b])),
        Kind::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
        Kind::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
        Kind::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
        Kind::F64 => f64::from_le_bytes(little.try_into().expect("eight bytes")),
    }
}
