//! Brightness maps larger than memory, as sharded [Zarr v3](https://zarr-specs.readthedocs.io) stores.
//!
//! An image is divided into [shards](Plan). Each is rendered on its own and written whole, and a small record beside it
//! says that it is done and what is in it. So a computation can be [stopped at any moment and resumed](Store::render),
//! [divided](Part) among processes and computers, and finally [merged and checked](Store::merge), and the bytes are
//! always those of one uninterrupted run.

mod array;
mod change;
mod describe;
mod error;
mod files;
mod identity;
mod json;
mod plan;
mod preview;
mod record;
mod render;
mod shard;
mod statistics;
mod store;
mod workers;

pub use change::Change;
pub use error::{Damage, StoreError};
pub use identity::read_metadata;
pub use plan::{Part, Plan, Shard};
pub use render::Outcome;
pub use statistics::{ChannelStatistics, MapStatistics};
pub use store::{Check, Opening, Request, Store};
pub use workers::Workers;
