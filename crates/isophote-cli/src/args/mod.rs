//! The command line as the user types it: one file for the arguments of each command.

mod app;
mod check;
mod grid;
mod language;
mod merge;
mod new;
mod parse;
mod probe;
mod render;
mod sampling;
mod scene;
mod section;
mod show;
mod store;
mod style;
mod surface;

use clap::{Parser, Subcommand};
use isophote::text::Language;

pub use app::AppArguments;
pub use check::CheckArguments;
pub use grid::{GridArguments, PlacedGridArguments};
pub use merge::MergeArguments;
pub use new::NewArguments;
pub use probe::ProbeArguments;
pub use render::RenderArguments;
pub use scene::SceneArgument;
pub use section::SectionArguments;
pub use show::ShowArguments;
pub use style::{CellStyleArguments, DEFAULT_ISOPHOTES};
pub use surface::SurfaceArguments;

/// Brightness of surfaces lit by point lights: maps, exact values at points, pictures.
///
/// Without a command, renders the lab's scene: a table to standard output and the picture lab.png.
#[derive(Parser)]
#[command(name = "isophote", version, max_term_width = 100)]
#[command(after_help = "Exit codes: 0 fine, 1 failed, 2 wrong arguments, 3 invalid scene, 130 interrupted.")]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Command>,
}

impl Arguments {
    /// The language of what the command says.
    pub fn language(&self) -> Language {
        match &self.command {
            Some(Command::Render(arguments)) => arguments.language.lang,
            Some(Command::Probe(arguments)) => arguments.language.lang,
            Some(Command::Section(arguments)) => arguments.language.lang,
            Some(Command::Surface(arguments)) => arguments.language.lang,
            Some(Command::Grid(arguments)) => arguments.language.lang,
            Some(Command::Merge(arguments)) => arguments.language.lang,
            Some(Command::App(arguments)) => arguments.language.lang,
            Some(Command::Check(arguments)) => arguments.language.lang,
            Some(Command::New(arguments)) => arguments.lang,
            Some(Command::Show(arguments)) => arguments.language.lang,
            Some(Command::Schema | Command::Completions { .. } | Command::Man { .. }) | None => Language::English,
        }
    }
}

#[derive(Subcommand)]
pub enum Command {
    /// Compute the brightness map of a scene; print its extremes and probes, write it to files
    Render(RenderArguments),
    /// Print exact values at points of a surface, with every step if asked
    Probe(ProbeArguments),
    /// Print or plot the values along a line of the picture
    Section(SectionArguments),
    /// Print, write or plot a channel over a shape's own surface: its flux, mean and extremes, and its map
    Surface(SurfaceArguments),
    /// Print, write or plot the illuminances at the points of a grid, and how even they are
    Grid(GridArguments),
    /// Put the parts of a .zarr store together: print its extremes and probes, or what is missing
    Merge(MergeArguments),
    /// Open the app in a browser, with a scene or where it was left: fields, pictures and values side by side
    App(AppArguments),
    /// Check a scene and print it as it is understood, in metres
    Check(CheckArguments),
    /// Write a commented scene file to start from
    New(NewArguments),
    /// Print what an output file says about itself
    Show(ShowArguments),
    /// Print the JSON Schema of scene files
    Schema,
    /// Print the completions for a shell
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Print the manual page, or that of a command
    Man {
        /// A command, such as `render`.
        command: Option<String>,
    },
}
