//! The files that the page hands in.

use std::borrow::Cow;
use std::collections::BTreeMap;

use isophote::scene::{Origin, ReadFailure, Resolver};

/// Files by the names that scenes have for them.
#[derive(Default)]
pub struct PageFiles {
    files: BTreeMap<String, Vec<u8>>,
    /// Counts the files handed in, so that shapes are read again when one of them is another one.
    version: u64,
}

impl PageFiles {
    pub fn insert(&mut self, name: &str, content: Vec<u8>) {
        self.files.insert(name.into(), content);
        self.version += 1;
    }
}

impl Resolver for PageFiles {
    fn read(&self, name: &str) -> Result<Cow<'_, [u8]>, ReadFailure> {
        let content = self.files.get(name).map(|content| Cow::Borrowed(content.as_slice()));
        content.ok_or_else(|| ReadFailure::Unknown(self.files.keys().cloned().collect()))
    }

    fn size(&self, name: &str) -> Option<u64> {
        self.files.get(name).map(|content| content.len() as u64)
    }

    fn origin(&self) -> Origin {
        Origin::Named(format!("the page, {}", self.version))
    }
}
