//! In what a store differs from the one that is asked for.

use std::fmt;

/// Something that is different from what was asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// What: `the size`, `the scene`, …
    pub what: &'static str,
    /// As it is in the store.
    pub stored: String,
    /// As it was asked for.
    pub asked: String,
}

impl fmt::Display for Change {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} is {} there and {} here", self.what, self.stored, self.asked)
    }
}
