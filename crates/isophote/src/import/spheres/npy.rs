//! A single `NumPy` array (`numpy.lib.format`, versions 1 to 3): of shape (N, 4), with the columns x, y, z, radius, in
//! single or double precision of either byte order.

use super::{SphereList, SpheresBuilder};
use crate::import::{Fault, FilePosition, FileProblem, text::shown};
use crate::message;
use crate::text::Message;

/// The spheres of an NPY file. Anything after the array is ignored, as `NumPy` does.
pub(in crate::import) fn read(bytes: &[u8]) -> Result<SphereList, Fault> {
    let (header, body) = split(bytes).map_err(|problem| problem.at(FilePosition::Header))?;
    let array = Array::parse(header).map_err(|problem| problem.at(FilePosition::Header))?;
    let needed = u128::from(array.rows) * 4 * array.number.size() as u128;
    let left = body.len() as u64;
    if needed > left.into() {
        let what = message!("{count} rows of 4 numbers", count = array.rows);
        return Err(FileProblem::Truncated { what, needed, left }.at(FilePosition::Header));
    }
    let body = &body[..usize::try_from(needed).expect("it is shorter than the file")];
    match array.number {
        Number::F4Little => rows(body, f32::from_le_bytes),
        Number::F4Big => rows(body, f32::from_be_bytes),
        Number::F8Little => rows(body, f64::from_le_bytes),
        Number::F8Big => rows(body, f64::from_be_bytes),
    }
}

fn rows<T: Into<f64>, const SIZE: usize>(body: &[u8], number: fn([u8; SIZE]) -> T) -> Result<SphereList, Fault> {
    let numbers = body.as_chunks::<SIZE>().0;
    let mut builder = SpheresBuilder::with_capacity(numbers.len() / 4);
    for (row, sphere) in (0..).zip(numbers.as_chunks::<4>().0) {
        let sphere = sphere.map(|bytes| number(bytes).into());
        builder.sphere(sphere).map_err(|problem| problem.at(FilePosition::Element { kind: "sphere", number: row }))?;
    }
    builder.finish()
}

/// The dictionary and what follows it.
fn split(bytes: &[u8]) -> Result<(&str, &[u8]), FileProblem> {
    let truncated = |needed: u64| FileProblem::Truncated {
        what: message!("magic, version and header"),
        needed: needed.into(),
        left: bytes.len() as u64,
    };
    let version = *bytes.get(6).ok_or_else(|| truncated(10))?;
    let (start, length) = match (version, bytes.get(8..10), bytes.get(8..12)) {
        (1, Some(length), _) => (10, u32::from(u16::from_le_bytes(length.try_into().expect("two bytes")))),
        (2 | 3, _, Some(length)) => (12, u32::from_le_bytes(length.try_into().expect("four bytes"))),
        (1..=3, ..) => return Err(truncated(12)),
        _ => {
            let (what, allowed) = (message!("the version of the format"), message!("1, 2 and 3"));
            return Err(FileProblem::Unexpected { what, found: version.to_string(), allowed });
        }
    };
    let end = start as u64 + u64::from(length);
    let header = usize::try_from(end).ok().and_then(|end| bytes.split_at_checked(end));
    let (header, body) = header.ok_or_else(|| truncated(end))?;
    let header = &header[start..];
    let text = std::str::from_utf8(header).map_err(|_| dictionary(header))?;
    Ok((text, body))
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Number {
    F4Little,
    F4Big,
    F8Little,
    F8Big,
}

impl Number {
    fn size(self) -> usize {
        match self {
            Self::F4Little | Self::F4Big => 4,
            Self::F8Little | Self::F8Big => 8,
        }
    }
}

struct Array {
    number: Number,
    rows: u64,
}

impl Array {
    /// Parses a Python dictionary with the keys `descr`, `fortran_order` and `shape`.
    fn parse(header: &str) -> Result<Self, FileProblem> {
        let kind = value(header, "descr")?;
        let order = value(header, "fortran_order")?;
        let shape = value(header, "shape")?;
        let number = match kind.trim_matches(['\'', '"']) {
            "<f4" => Number::F4Little,
            ">f4" => Number::F4Big,
            "<f8" => Number::F8Little,
            ">f8" => Number::F8Big,
            _ => {
                return Err(unexpected(
                    message!("the kind of its numbers"),
                    kind,
                    message!("float32 and float64 (<f4, <f8, >f4, >f8)"),
                ));
            }
        };
        let sizes: Option<Vec<u64>> = shape
            .trim_matches(['(', ')'])
            .split(',')
            .map(str::trim)
            .filter(|size| !size.is_empty())
            .map(|size| size.parse().ok())
            .collect();
        let rows = match sizes.as_deref() {
            Some([rows, 4]) => *rows,
            Some([_, 3]) => {
                let allowed = message!(
                    "(N, 4): x, y, z, radius. To give all points one radius: numpy.column_stack([points, numpy.full(len(points), radius)])"
                );
                return Err(unexpected(message!("its shape"), shape, allowed));
            }
            _ => return Err(unexpected(message!("its shape"), shape, Message::verbatim("(N, 4): x, y, z, radius"))),
        };
        match order {
            "False" => Ok(Self { number, rows }),
            // A single row is the same in either order.
            "True" if rows == 1 => Ok(Self { number, rows }),
            _ => Err(unexpected(
                Message::verbatim("fortran_order"),
                order,
                message!("False (numpy.ascontiguousarray makes it so)"),
            )),
        }
    }
}

/// The value of a key in the dictionary: up to the next comma outside of brackets, or to the end.
fn value<'a>(header: &'a str, key: &str) -> Result<&'a str, FileProblem> {
    let after = [format!("'{key}'"), format!("\"{key}\"")]
        .iter()
        .find_map(|key| header.split_once(key.as_str()))
        .and_then(|(_, after)| after.trim_start().strip_prefix(':'));
    let Some(after) = after else { return Err(dictionary(header.as_bytes())) };
    let mut depth = 0_u32;
    let end = after.find(|character| {
        match character {
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        depth == 0 && matches!(character, ',' | '}')
    });
    Ok(after[..end.unwrap_or(after.len())].trim())
}

fn dictionary(header: &[u8]) -> FileProblem {
    let header = header.trim_ascii();
    FileProblem::Unexpected {
        what: message!("the header"),
        found: shown(header),
        allowed: message!("a dictionary with descr, fortran_order and shape"),
    }
}

fn unexpected(what: Message, found: &str, allowed: Message) -> FileProblem {
    FileProblem::Unexpected { what, found: shown(found.as_bytes()), allowed }
}
