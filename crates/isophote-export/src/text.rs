//! Formats numbers and text for files.

use std::fmt::{self, Display, Formatter};

/// A number in its shortest form that reads back exactly; with an exponent outside [1e-4, 1e16), as in Python.
pub(crate) struct Number(pub(crate) f64);

impl Display for Number {
    fn fmt(&self, formatter: &mut Formatter) -> fmt::Result {
        let Self(value) = self;
        if *value == 0.0 || (1e-4..1e16).contains(&value.abs()) {
            write!(formatter, "{value}")
        } else {
            write!(formatter, "{value:e}")
        }
    }
}

/// Replaces control characters, which would end a table's comment line or a text chunk early; the metadata's JSON
/// escapes them.
pub(crate) fn one_line(text: &str) -> String {
    text.chars().map(|character| if character.is_control() { ' ' } else { character }).collect()
}
