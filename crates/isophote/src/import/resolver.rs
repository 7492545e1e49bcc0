//! Where the files named in a scene come from: the caller decides, so that nothing else here depends on a file system.

mod memory;
mod origin;

use crate::message;
use crate::text::Message;
use std::borrow::Cow;
use std::io;
use std::path::PathBuf;

pub use memory::MemoryFiles;
pub use origin::Origin;

/// Provides the contents of files by the names used in a scene.
pub trait Resolver {
    /// The contents of a file.
    ///
    /// # Errors
    /// The reason why there are none.
    fn read(&self, name: &str) -> Result<Cow<'_, [u8]>, ReadFailure>;

    /// The length of a file in bytes, where it is known before the file is read.
    fn size(&self, _name: &str) -> Option<u64> {
        None
    }

    /// Is asked before so many bytes of memory are taken for what was read: a resolver may have a limit.
    ///
    /// # Errors
    /// [`ReadFailure::Memory`] if that is too much.
    fn admit(&self, _bytes: u64) -> Result<(), ReadFailure> {
        Ok(())
    }

    /// The base of relative names. Files read from one origin are not read again from an equal one.
    fn origin(&self) -> Origin;

    /// The file's name in messages.
    fn full_name(&self, name: &str) -> PathBuf {
        name.into()
    }
}

/// Why the contents of a file are not available.
#[derive(Debug)]
pub enum ReadFailure {
    /// It cannot be opened or read; contains the system's reason.
    Unreadable(io::Error),
    /// Its path is that of a directory.
    Directory,
    /// Its path is that of a pipe, which may never end, or of a device, which has no end.
    NoFile,
    /// It is not among the available files, whose names are listed.
    Unknown(Vec<String>),
    /// No files can be read at all.
    NoFiles,
    /// It takes more memory than there is leave for.
    Memory {
        /// The memory in bytes that would be in use.
        needed: u64,
        /// The most that may be.
        limit: u64,
    },
    /// It is not where an output says that it was.
    Gone {
        /// Its length and hash at that time.
        was: Message,
    },
    /// It is no longer the file that an output was made of.
    Changed {
        /// Its length and hash at that time.
        was: Message,
        /// Where the changed file is.
        at: PathBuf,
        /// The length and hash of the changed file.
        is: Message,
    },
}

impl ReadFailure {
    /// Describes what is wrong with a file, for people.
    #[must_use]
    pub fn describe(&self, file: &std::path::Path) -> Message {
        let file = file.display();
        match self {
            Self::Unreadable(reason) => message!("cannot read ‘{file}’: {reason}", file, reason = reason.to_string()),
            Self::Directory => message!("‘{file}’ is a directory; a file is needed", file),
            Self::NoFile => message!("‘{file}’ is a pipe or a device; a file is needed", file),
            Self::Unknown(_) => message!("there is no file ‘{file}’ here", file),
            Self::Gone { was } => {
                message!("the file ‘{file}’ that this was made of ({was}) is not there any more", file, was)
            }
            Self::Changed { was, at, is } => message!(
                "the file ‘{file}’ that this was made of ({was}) has changed: ‘{at}’ is {is}",
                file,
                was,
                at = at.display(),
                is
            ),
            Self::NoFiles => message!("the scene names the file ‘{file}’; none can be read here", file),
            Self::Memory { needed, limit } => message!(
                "a limit of {limit} MiB of memory is too small: reading ‘{file}’ needs at least {needed} MiB",
                limit = limit >> 20,
                file,
                needed = needed.div_ceil(1 << 20)
            ),
        }
    }

    /// What is allowed, or what to do.
    #[must_use]
    pub fn help(&self) -> Message {
        match self {
            Self::Unreadable(_) | Self::Directory | Self::NoFile => {
                message!("a relative path starts at the scene file")
            }
            Self::Unknown(known) if known.is_empty() => message!("there are no files"),
            Self::Unknown(known) => message!("allowed: {names}", names = known.join(", ")),
            Self::Gone { .. } | Self::Changed { .. } => message!(
                "put that file back; or write the scene beside other files: isophote show OUTPUT --scene > scene.toml"
            ),
            Self::NoFiles => message!("allowed: shapes whose numbers stand in the scene itself"),
            Self::Memory { .. } => message!("raise the limit, or take a smaller file"),
        }
    }
}

/// No files at all, as in a browser: a scene that names a file is rejected.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoFiles;

impl Resolver for NoFiles {
    fn read(&self, _: &str) -> Result<Cow<'_, [u8]>, ReadFailure> {
        Err(ReadFailure::NoFiles)
    }

    fn origin(&self) -> Origin {
        Origin::Named("no files".into())
    }
}
