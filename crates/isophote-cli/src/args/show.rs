//! The arguments of `isophote show`.

use std::path::PathBuf;

use clap::Args;

use crate::args::language::LanguageArgument;

#[derive(Args)]
pub struct ShowArguments {
    /// A file or .zarr store that this program wrote
    pub file: PathBuf,

    /// Print the scene that the file carries, as a scene file
    #[arg(long, conflicts_with = "json")]
    pub scene: bool,

    #[command(flatten)]
    pub language: LanguageArgument,

    /// Print everything as JSON
    #[arg(long)]
    pub json: bool,
}
