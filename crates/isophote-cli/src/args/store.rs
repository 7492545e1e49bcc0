//! The options of `isophote render` for stores.

use std::num::NonZeroU32;

use clap::Args;
use isophote_zarr::Part;

use crate::args::parse;
use crate::numbers;

/// What concerns .zarr stores alone.
#[derive(Args, Default)]
pub struct StoreArguments {
    /// Continue a .zarr store that was not finished; begin it if there is none
    #[arg(long)]
    pub resume: bool,

    /// Compute only every N-th shard of a .zarr store, the I-th of each N, beside other processes that compute the
    /// others; `isophote merge` puts them together
    #[arg(long, value_name = "I/N", value_parser = parse::part)]
    pub shard: Option<Part>,

    /// Memory that the computation of a .zarr store may take, such as 512M or 2G
    #[arg(long, value_name = "SIZE", value_parser = numbers::memory)]
    pub memory: Option<u64>,

    /// Side of a shard in pixels, for tests that need many shards of a small image
    #[arg(long, value_name = "PIXELS", hide = true)]
    pub shard_side: Option<NonZeroU32>,
}
