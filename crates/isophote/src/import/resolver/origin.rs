//! The base of file names.

use std::path::{Path, PathBuf, absolute};

/// The base of the file names in a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A directory of the file system.
    Directory(PathBuf),
    /// Any other source. Two with the same name must give the same contents for the same file names.
    Named(String),
}

impl Default for Origin {
    /// The working directory.
    fn default() -> Self {
        Self::Directory(PathBuf::new())
    }
}

impl Origin {
    /// The directory, if the origin is one.
    #[must_use]
    pub fn directory(&self) -> Option<&Path> {
        match self {
            Self::Directory(directory) => Some(directory),
            Self::Named(_) => None,
        }
    }

    /// Whether equal names refer to the same file, however a directory is written.
    #[must_use]
    pub fn is_same_place(&self, other: &Self) -> bool {
        let absolute = |path: &Path| absolute(if path.as_os_str().is_empty() { Path::new(".") } else { path });
        let is_same_directory =
            |one, other| matches!((absolute(one), absolute(other)), (Ok(one), Ok(other)) if one == other);
        self == other
            || self.directory().zip(other.directory()).is_some_and(|(one, other)| is_same_directory(one, other))
    }
}
