//! What can go wrong with a store.

use std::fmt;
use std::io;
use std::path::PathBuf;

use isophote::map::Quantity;
use isophote::render::RenderError;
use isophote_export::{ExportError, FileMetadata};

use crate::change::Change;
use crate::plan::{Plan, Shard};

/// Why a store could not be created, continued or read.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// A file of the store cannot be written.
    #[error("cannot write ‘{}’: {reason}", path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        reason: io::Error,
    },
    /// A file of the store cannot be read.
    #[error("cannot read ‘{}’: {reason}", path.display())]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        reason: io::Error,
    },
    /// The name is taken by something else.
    #[error("‘{}’ is {what}", path.display())]
    Foreign {
        /// The requested store.
        path: PathBuf,
        /// `a file`, `no Zarr store of Isophote`, …
        what: String,
    },
    /// A store of this name exists, and continuing it was not requested.
    #[error("‘{}’ exists already: {done} of its {shards} shards are done", path.display())]
    Exists {
        /// The requested store.
        path: PathBuf,
        /// How many shards are done.
        done: u64,
        /// How many shards there are.
        shards: u64,
    },
    /// The store holds a different map from the one requested.
    #[error("‘{}’ holds another map: {}", path.display(), list(changes))]
    Changed {
        /// The requested store.
        path: PathBuf,
        /// The differences.
        changes: Vec<Change>,
    },
    /// The store's description is truncated or altered.
    #[error("‘{}’ is damaged: {reason}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// The store was written by a newer version of the program.
    #[error("‘{}’ has metadata of version {version}; this program reads up to {}", path.display(), FileMetadata::VERSION)]
    Newer {
        /// The store.
        path: PathBuf,
        /// Its version.
        version: u32,
    },
    /// Another process is writing to the store.
    #[error("‘{}’ is being written by another process", path.display())]
    Busy {
        /// The store.
        path: PathBuf,
    },
    /// Another process has written a shard, on a file system where it could not be kept from it.
    #[error("‘{}’: another process has written the shard {shard} meanwhile, and this file system has no locks; let only one write", path.display())]
    Met {
        /// The store.
        path: PathBuf,
        /// The shard that both have computed.
        shard: Shard,
    },
    /// The memory limit is too small for even one shard.
    #[error("a limit of {limit} MiB of memory is too small: one shard of this map needs {needed} MiB")]
    Memory {
        /// The limit, in MiB.
        limit: u64,
        /// The minimum needed, in MiB.
        needed: u64,
    },
    /// Shards that are too small for the image.
    #[error("{shards} shards are too many; allowed: {} at most, with larger shards", Plan::MOST_SHARDS)]
    TooManyShards {
        /// How many there would be.
        shards: u64,
    },
    /// Shards are missing or do not match their records.
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
    /// A shard could not be compressed, or the preview's map could not be made.
    #[error("the channel ‘{}’ cannot be encoded: {reason}", quantity.name())]
    Encode {
        /// The channel.
        quantity: Quantity,
        /// What went wrong.
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

/// Lists only the first few: there may be a hundred thousand.
fn damages_text(damages: &[Damage]) -> String {
    const NAMED: usize = 5;
    let mut text: Vec<String> = damages.iter().take(NAMED).map(Damage::to_string).collect();
    if damages.len() > NAMED {
        text.push(format!("and {} more", damages.len() - NAMED));
    }
    text.join("; ")
}
