//! The arguments of `isophote merge`.

use std::path::PathBuf;

use clap::Args;

use crate::args::language::LanguageArgument;

#[derive(Args)]
pub struct MergeArguments {
    /// A .zarr store whose parts were computed by `isophote render --shard`
    pub store: PathBuf,

    /// Read every shard and compare it with its checksums
    #[arg(long)]
    pub check: bool,

    #[command(flatten)]
    pub language: LanguageArgument,

    /// Print the results as JSON
    #[arg(long)]
    pub json: bool,
}
