//! Files in memory.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use super::{Origin, ReadFailure, Resolver};

/// Files in memory, by name: uploaded ones, or those of a test.
///
/// ```
/// use isophote::import::MemoryFiles;
///
/// let files = MemoryFiles::from_iter([("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")]);
/// ```
#[derive(Clone, Debug)]
pub struct MemoryFiles {
    files: BTreeMap<String, Vec<u8>>,
    origin: Origin,
}

impl<N: Into<String>, C: Into<Vec<u8>>> FromIterator<(N, C)> for MemoryFiles {
    fn from_iter<I: IntoIterator<Item = (N, C)>>(files: I) -> Self {
        let files: BTreeMap<_, _> = files.into_iter().map(|(name, content)| (name.into(), content.into())).collect();
        // Identified by their contents: files with the same name but different contents are read again.
        let mut hasher = DefaultHasher::new();
        files.hash(&mut hasher);
        let origin = Origin::Named(format!("memory {:016x}", hasher.finish()));
        Self { files, origin }
    }
}

impl Resolver for MemoryFiles {
    fn read(&self, name: &str) -> Result<Cow<'_, [u8]>, ReadFailure> {
        let known = || self.files.keys().cloned().collect();
        self.files.get(name).map(|content| Cow::Borrowed(&content[..])).ok_or_else(|| ReadFailure::Unknown(known()))
    }

    fn size(&self, name: &str) -> Option<u64> {
        self.files.get(name).map(|content| content.len() as u64)
    }

    fn origin(&self) -> Origin {
        self.origin.clone()
    }
}
