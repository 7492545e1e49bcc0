//! The arguments of `isophote check`.

use clap::Args;

use crate::args::language::LanguageArgument;
use crate::args::scene::SceneArgument;

#[derive(Args)]
pub struct CheckArguments {
    #[command(flatten)]
    pub scene: SceneArgument,

    #[command(flatten)]
    pub language: LanguageArgument,

    /// Print the scene, with every default filled in, as JSON
    #[arg(long)]
    pub json: bool,

    /// No warnings: only results and errors
    #[arg(short, long)]
    pub quiet: bool,
}
