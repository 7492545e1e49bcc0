//! What can go wrong with a store.

use std::fmt;
use std::io;
use std::path::PathBuf;

use isophote::map::Quantity;
use isophote::message;
use isophote::render::RenderError;
use isophote::text::Message;
use isophote_export::{ExportError, FileMetadata};

use crate::change::Change;
use crate::plan::{Plan, Shard};

/// Why a store could not be created, continued or read.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.message())]
pub enum StoreError {
    /// A file of the store cannot be written.
    Write {
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        reason: io::Error,
    },
    /// A file of the store cannot be read.
    Read {
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        reason: io::Error,
    },
    /// The name is taken by something else.
    Foreign {
        /// The requested store.
        path: PathBuf,
        /// `a file`, `no Zarr store of Isophote`, …
        what: Message,
    },
    /// A store of this name exists, and continuing it was not requested.
    Exists {
        /// The requested store.
        path: PathBuf,
        /// How many shards are done.
        done: u64,
        /// How many shards there are.
        shards: u64,
    },
    /// The store holds a different map from the one requested.
    Changed {
        /// The requested store.
        path: PathBuf,
        /// The differences.
        changes: Vec<Change>,
    },
    /// The store's description is truncated or altered.
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// The store was written by a newer version of the program.
    Newer {
        /// The store.
        path: PathBuf,
        /// Its version.
        version: u32,
    },
    /// Another process is writing to the store.
    Busy {
        /// The store.
        path: PathBuf,
    },
    /// Another process has written a shard, on a file system where it could not be kept from it.
    Met {
        /// The store.
        path: PathBuf,
        /// The shard that both have computed.
        shard: Shard,
    },
    /// The memory limit is too small for even one shard.
    Memory {
        /// The limit, in MiB.
        limit: u64,
        /// The minimum needed, in MiB.
        needed: u64,
    },
    /// Shards that are too small for the image.
    TooManyShards {
        /// How many there would be.
        shards: u64,
    },
    /// Shards are missing or do not match their records.
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
    Preview(#[from] ExportError),
    /// A shard could not be compressed, or the preview's map could not be made.
    Encode {
        /// The channel.
        quantity: Quantity,
        /// What went wrong.
        reason: String,
    },
}

impl StoreError {
    /// What is wrong, in either language; what the operating system and the libraries say is as they say it.
    #[must_use]
    pub fn message(&self) -> Message {
        match self {
            Self::Write { path, reason } => {
                message!("cannot write ‘{path}’: {reason}", path = path.display(), reason = reason.to_string())
            }
            Self::Read { path, reason } => {
                message!("cannot read ‘{file}’: {reason}", file = path.display(), reason = reason.to_string())
            }
            Self::Foreign { path, what } => message!("‘{path}’ is {what}", path = path.display(), what),
            Self::Exists { path, done, shards } => message!(
                "‘{path}’ exists already: {done} of its {shards} shards are done",
                path = path.display(),
                done,
                shards
            ),
            Self::Changed { path, changes } => {
                let changes = joined(changes.iter().map(Change::message));
                message!("‘{path}’ holds another map: {changes}", path = path.display(), changes)
            }
            Self::Damaged { path, reason } => {
                message!("‘{path}’ is damaged: {reason}", path = path.display(), reason)
            }
            Self::Newer { path, version } => message!(
                "‘{path}’ has metadata of version {version}; this program reads up to {known}",
                path = path.display(),
                version,
                known = FileMetadata::VERSION
            ),
            Self::Busy { path } => {
                message!("‘{path}’ is being written by another process", path = path.display())
            }
            Self::Met { path, shard } => message!(
                "‘{path}’: another process has written the shard {shard} meanwhile, and this file system has no locks; let only one write",
                path = path.display(),
                shard = shard.to_string()
            ),
            Self::Memory { limit, needed } => message!(
                "a limit of {limit} MiB of memory is too small: one shard of this map needs {needed} MiB",
                limit,
                needed
            ),
            Self::TooManyShards { shards } => message!(
                "{shards} shards are too many; allowed: {most} at most, with larger shards",
                shards,
                most = Plan::MOST_SHARDS
            ),
            Self::Incomplete { path, damages } => {
                message!("‘{path}’ is incomplete: {damages}", path = path.display(), damages = first_of(damages))
            }
            Self::Render(error) => error.message(),
            Self::Preview(error) => message!("the preview: {reason}", reason = error.message()),
            Self::Encode { quantity, reason } => {
                message!("the channel ‘{channel}’ cannot be encoded: {reason}", channel = quantity.name(), reason)
            }
        }
    }
}

/// What is wrong in a store, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Damage {
    /// A shard, such as `shard 3/7`, or the name of a file.
    pub place: String,
    /// What is wrong with it.
    pub reason: Message,
}

impl Damage {
    fn message(&self) -> Message {
        message!("{place} {reason}", place = self.place, reason = self.reason)
    }
}

impl fmt::Display for Damage {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.message().fmt(formatter)
    }
}

/// Parts of a sentence that are set apart by semicolons.
fn joined(parts: impl Iterator<Item = Message>) -> Message {
    parts.reduce(|first, second| message!("{first}; {second}", first, second)).unwrap_or_else(Message::empty)
}

/// Lists only the first few: there may be a hundred thousand.
fn first_of(damages: &[Damage]) -> Message {
    const NAMED: usize = 5;
    let rest = damages.len().saturating_sub(NAMED);
    let named = damages.iter().take(NAMED).map(Damage::message);
    joined(named.chain((rest > 0).then(|| message!("and {count} more", count = rest))))
}
