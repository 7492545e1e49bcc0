//! How an existing store differs from the requested one.

use std::fmt;

use isophote::message;
use isophote::text::Message;

/// One difference from what was requested.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// The item that differs: `the size`, `the scene`, …
    pub what: Message,
    /// Its value in the store.
    pub stored: String,
    /// The requested value.
    pub asked: String,
}

impl Change {
    /// The difference, in either language.
    #[must_use]
    pub fn message(&self) -> Message {
        message!(
            "{what} is {stored} there and {asked} here",
            what = self.what,
            stored = self.stored,
            asked = self.asked
        )
    }
}

impl fmt::Display for Change {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.message().fmt(formatter)
    }
}
