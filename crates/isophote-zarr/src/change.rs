//! How an existing store differs from the requested one.

use std::fmt;

/// One difference from what was requested.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// The item that differs: `the size`, `the scene`, …
    pub what: &'static str,
    /// Its value in the store.
    pub stored: String,
    /// The requested value.
    pub asked: String,
}

impl fmt::Display for Change {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} is {} there and {} here", self.what, self.stored, self.asked)
    }
}
