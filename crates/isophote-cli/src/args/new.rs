//! The arguments of `isophote new`.

use std::path::PathBuf;

use clap::Args;
use isophote::scene::library::Starter;
use isophote::text::Language;

use crate::args::parse;

#[derive(Args)]
pub struct NewArguments {
    /// Which scene
    #[arg(value_name = "NAME", value_parser = parse::keyword::<Starter>())]
    pub name: Starter,

    /// Language of the comments and the title
    #[arg(long, value_name = "LANGUAGE", default_value = "en", value_parser = parse::keyword::<Language>())]
    pub lang: Language,

    /// Write to FILE (by default NAME.toml), or - for standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Overwrite a file that exists
    #[arg(short, long)]
    pub force: bool,
}
