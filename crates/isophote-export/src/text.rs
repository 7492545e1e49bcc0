//! Numbers and texts as files have them.

use std::fmt::{self, Display, Formatter};

/// A number in the shortest form that reads back as the same one; with an exponent outside [1e-4, 1e16), as in Python.
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

/// Control characters would end a comment line of a table or a text chunk early; the metadata's JSON has them escaped.
pub(crate) fn one_line(text: &str) -> String {
    text.chars().map(|character| if character.is_control() { ' ' } else { character }).collect()
}
