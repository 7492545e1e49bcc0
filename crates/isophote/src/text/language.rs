//! The languages of texts for people.

use crate::units::Keyword;

/// A language that messages, explanations and starter scenes are written in. Keys of scene files, columns of tables in files
/// and other identifiers are the same in all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// Russian.
    Russian,
}

impl Keyword for Language {
    const ALL: &'static [Self] = &[Self::English, Self::Russian];

    fn name(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::Russian => "ru",
        }
    }
}
