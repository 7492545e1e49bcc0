//! The header of a PLY file.

use crate::message;
use crate::text::Message;
use memchr::memchr;

use crate::import::{
    Fault, FilePosition, FileProblem,
    text::{integer, shown, words},
};

/// The elements in the order of the file, and the encoding of their values.
#[derive(Debug, PartialEq)]
pub(in crate::import) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// The number of lines in the header.
    pub lines: u64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::import) enum Encoding {
    Ascii,
    Little,
    Big,
}

#[derive(Debug, Clone, PartialEq)]
pub(in crate::import) struct Element {
    pub name: String,
    pub count: u64,
    pub properties: Vec<Property>,
}

#[derive(Debug, Clone, PartialEq)]
pub(in crate::import) struct Property {
    pub name: String,
    /// The type of its values.
    pub kind: Kind,
    /// The type of a list's length.
    pub length: Option<Kind>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::import) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// Far more than any file needs. Each is compared with every other one, and walked through for every row.
const MOST_ELEMENTS: usize = 100;
const MOST_PROPERTIES: usize = 1000;

impl Header {
    /// The header and the rest of the file.
    pub fn split(bytes: &[u8]) -> Result<(Self, &[u8]), Fault> {
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let mut rest = bytes;
        for number in 1.. {
            let at = |problem: FileProblem| problem.at(FilePosition::Line(number));
            let Some(end) = memchr(b'\n', rest) else { break };
            let (line, after) = (rest[..end].trim_ascii(), &rest[end + 1..]);
            rest = after;
            let parts: Vec<&[u8]> = words(line).collect();
            match parts.as_slice() {
                [b"ply"] if number == 1 => {}
                [b"comment" | b"obj_info", ..] | [] => {}
                [b"format", name, b"1.0"] => encoding = Some(Encoding::named(name).map_err(at)?),
                [b"element", name, count] => {
                    let element = Element::new(name, count).map_err(at)?;
                    if elements.iter().any(|other| other.name == element.name) {
                        return Err(at(twice(message!("an element that is there twice"), &element.name)));
                    }
                    if elements.len() == MOST_ELEMENTS {
                        return Err(at(too_many(message!("elements in the header"), MOST_ELEMENTS)));
                    }
                    elements.push(element);
                }
                [b"property", parts @ ..] => {
                    let element = elements.last_mut().ok_or_else(|| at(unexpected(line)))?;
                    let property = Property::new(parts).map_err(at)?;
                    if element.property(&[&property.name]).is_some() {
                        return Err(at(twice(message!("a property that is there twice"), &property.name)));
                    }
                    if element.properties.len() == MOST_PROPERTIES {
                        return Err(at(too_many(message!("properties of one element"), MOST_PROPERTIES)));
                    }
                    element.properties.push(property);
                }
                [b"end_header"] => {
                    let encoding = encoding.ok_or_else(|| at(no_format()))?;
                    return Ok((Self { encoding, elements, lines: number }, rest));
                }
                _ => return Err(at(unexpected(line))),
            }
        }
        Err(FileProblem::Missing {
            what: message!("the line ‘{line}’", line = "end_header"),
            needed: message!("it ends the header"),
        }
        .at(FilePosition::Header))
    }

    /// The element with this name, which is required.
    pub fn element(&self, name: &str, needed: fn() -> Message) -> Result<&Element, FileProblem> {
        let element = self.elements.iter().find(|element| element.name == name);
        element.ok_or_else(|| FileProblem::Missing { what: message!("element {name}", name), needed: needed() })
    }
}

impl Encoding {
    fn named(name: &[u8]) -> Result<Self, FileProblem> {
        match name {
            b"ascii" => Ok(Self::Ascii),
            b"binary_little_endian" => Ok(Self::Little),
            b"binary_big_endian" => Ok(Self::Big),
            _ => {
                let allowed = message!("ascii, binary_little_endian and binary_big_endian");
                Err(FileProblem::Unexpected { what: message!("the format"), found: shown(name), allowed })
            }
        }
    }
}

impl Element {
    fn new(name: &[u8], count: &[u8]) -> Result<Self, FileProblem> {
        let field = || message!("the number of elements");
        let count = u64::try_from(integer(count, field)?).map_err(|_| FileProblem::NotANumber {
            field: field(),
            text: shown(count),
            allowed: message!("0 or more"),
        })?;
        Ok(Self { name: shown(name), count, properties: Vec::new() })
    }

    /// The index of the property with one of these names.
    pub fn property(&self, names: &[&str]) -> Option<usize> {
        self.properties.iter().position(|property| names.contains(&property.name.as_str()))
    }

    /// The indices of these scalar properties.
    pub fn values<const N: usize>(&self, names: [&'static str; N]) -> Result<[usize; N], FileProblem> {
        let mut places = [0; N];
        for (place, name) in places.iter_mut().zip(names) {
            let found = self.property(&[name]).filter(|index| self.properties[*index].length.is_none());
            *place = found.ok_or_else(|| FileProblem::Missing {
                what: message!("property {name} of element {element}", name, element = self.name),
                needed: message!("it must be a single number"),
            })?;
        }
        Ok(places)
    }
}

impl Property {
    fn new(parts: &[&[u8]]) -> Result<Self, FileProblem> {
        let (length, kind, name) = match parts {
            [b"list", length, kind, name] => (Some(Kind::named(length)?), kind, name),
            [kind, name] => (None, kind, name),
            _ => return Err(unexpected(&parts.join(&b' '))),
        };
        if matches!(length, Some(Kind::F32 | Kind::F64)) {
            let what = message!("the kind of a list's length");
            return Err(FileProblem::Unexpected { what, found: "float".into(), allowed: message!("whole numbers") });
        }
        Ok(Self { name: shown(name), kind: Kind::named(kind)?, length })
    }
}

impl Kind {
    fn named(name: &[u8]) -> Result<Self, FileProblem> {
        match name {
            b"char" | b"int8" => Ok(Self::I8),
            b"uchar" | b"uint8" => Ok(Self::U8),
            b"short" | b"int16" => Ok(Self::I16),
            b"ushort" | b"uint16" => Ok(Self::U16),
            b"int" | b"int32" => Ok(Self::I32),
            b"uint" | b"uint32" => Ok(Self::U32),
            b"float" | b"float32" => Ok(Self::F32),
            b"double" | b"float64" => Ok(Self::F64),
            _ => Err(FileProblem::Unexpected {
                what: message!("the kind of a property"),
                found: shown(name),
                allowed: message!("char, uchar, short, ushort, int, uint, float, double (or int8 to float64)"),
            }),
        }
    }

    /// In bytes.
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    pub fn is_integer(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}

fn unexpected(line: &[u8]) -> FileProblem {
    FileProblem::Unexpected {
        what: message!("a line of the header"),
        found: shown(line),
        allowed: message!("format, comment, obj_info, element, property (of an element), end_header"),
    }
}

fn twice(what: Message, name: &str) -> FileProblem {
    FileProblem::Unexpected { what, found: name.into(), allowed: message!("each name once") }
}

fn too_many(what: Message, most: usize) -> FileProblem {
    FileProblem::TooMany { what, most: most as u64 }
}

fn no_format() -> FileProblem {
    FileProblem::Missing {
        what: message!("the line ‘{line}’", line = "format … 1.0"),
        needed: message!("it says how numbers are written"),
    }
}
