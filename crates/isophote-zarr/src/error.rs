//! What can go wrong with a store.

use std::fmt;
use std::io;
use std::path::PathBuf;

use isophote::map::Quantity;
use isophote::render::RenderError;
use isophote_export::{ExportError, FileMetadata};

use crate::change::Change;

/// Why a store was not made, continued or read.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// A file of the store cannot be written.
    #[error("cannot write ‘{}’: {reason}", path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        reason: io::Error,
    },
    /// A file of the store cannot be read.
    #[error("cannot read ‘{}’: {reason}", path.display())]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        reason: io::Error,
    },
    /// The name is taken by something else.
    #[error("‘{}’ is {what}", path.display())]
    Foreign {
        /// The store asked for.
        path: PathBuf,
        /// `a file`, `no Zarr store of Isophote`, …
        what: String,
    },
    /// There is a store of this name, and nobody said that it is to be continued.
    #[error("‘{}’ exists already: {done} of its {shards} shards are done", path.display())]
    Exists {
        /// The store asked for.
        path: PathBuf,
        /// How many shards are done.
        done: u64,
        /// How many there are.
        shards: u64,
    },
    /// The store holds another map than the one that is asked for.
    #[error("‘{}’ holds another map: {}", path.display(), list(changes))]
    Changed {
        /// The store asked for.
        path: PathBuf,
        /// What is different.
        changes: Vec<Change>,
    },
    /// Its description is cut off or changed.
    #[error("‘{}’ is damaged: {reason}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What does not fit.
        reason: String,
    },
    /// A later program wrote it.
    #[error("‘{}’ has metadata of version {version}; this program reads up to {}", path.display(), FileMetadata::VERSION)]
    Newer {
        /// The store.
        path: PathBuf,
        /// Its version.
        version: u32,
    },
    /// Another process is writing into the store.
    #[error("‘{}’ is being written by another process", path.display())]
    Busy {
        /// The store.
        path: PathBuf,
    },
    /// Not one shard fits into the memory allowed.
    #[error("a limit of {limit} MiB of memory is too small: one shard of this map needs {needed} MiB")]
    Memory {
        /// What was allowed, in MiB.
        limit: u64,
        /// What is the least, in MiB.
        needed: u64,
    },
    /// Shards are missing or do not hold what their records say.
    #[error("‘{}’ is incomplete: {}", path.display(), damages_text(damages))]
    Incomplete {
        /// The store.
        path: PathBuf,
        /// What is wrong, shard by shard.
        damages: Vec<Damage>,
    },
    /// A region could not be rendered, or the work was interrupted.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The preview could not be made.
    #[error("the preview: {0}")]
    Preview(#[from] ExportError),
    /// The library for Zarr refused an array or a shard.
    #[error("the channel ‘{}’ cannot be encoded: {reason}", quantity.name())]
    Encode {
        /// The channel.
        quantity: Quantity,
        /// What it said.
        reason: String,
    },
}

/// What is wrong in a store, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Damage {
    /// A shard, such as `shard 3/7`, or the name of a file.
    pub place: String,
    /// What is wrong with it.
    pub reason: String,
}

impl fmt::Display for Damage {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} {}", self.place, self.reason)
    }
}

fn list(changes: &[Change]) -> String {
    changes.iter().map(Change::to_string).collect::<Vec<_>>().join("; ")
}

/// The first few by name: there may be a hundred thousand.
fn damages_text(damages: &[Damage]) -> String {
    const NAMED: usize = 5;
    let mut text: Vec<String> = damages.iter().take(NAMED).map(Damage::to_string).collect();
    if damages.len() > NAMED {
        text.push(format!("and {} more", damages.len() - NAMED));
    }
    text.join("; ")
}
