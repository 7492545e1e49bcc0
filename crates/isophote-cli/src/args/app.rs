//! The arguments of `isophote app`.

use clap::Args;

use crate::args::language::LanguageArgument;
use crate::args::scene::SceneArgument;

#[derive(Args)]
pub struct AppArguments {
    #[command(flatten)]
    pub scene: SceneArgument,

    /// Serve the page on this port of 127.0.0.1; by default on any free one
    #[arg(long, value_name = "PORT", default_value_t = 0, hide_default_value = true)]
    pub port: u16,

    /// Do not open a browser, only print the address
    #[arg(long)]
    pub no_browser: bool,

    /// Print the end of a link that holds the scene, for the address of the app on any server, and serve nothing
    #[arg(long, requires = "scene", conflicts_with_all = ["port", "no_browser"])]
    pub link: bool,

    #[command(flatten)]
    pub language: LanguageArgument,

    /// No warnings: only results and errors
    #[arg(short, long)]
    pub quiet: bool,
}
