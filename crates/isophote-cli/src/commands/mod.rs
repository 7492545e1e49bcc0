//! One file per command: raw arguments become a job; the job runs and returns the text for standard output.

mod app;
mod areas;
mod cells;
mod check;
mod grid;
mod new;
mod output;
mod probe;
mod reading_json;
mod reading_table;
mod render;
mod section;
mod section_lines;
mod show;
mod store;
mod summary;
mod surface;

pub use app::PAGE as APP_PAGE;

use std::borrow::Cow;
use std::io::IsTerminal;

use anyhow::Result;
use clap::CommandFactory;
use isophote::message;
use isophote::text::{Message, escaped};

use crate::args::{Arguments, Command, RenderArguments};
use crate::failure::Usage;

/// Runs a command; returns the text for standard output. What is in a scene or a file gets there with its control characters
/// escaped, but in the scene itself where that goes to a program.
pub fn run(arguments: Arguments) -> Result<String> {
    let text = match arguments.command {
        Some(Command::Completions { shell }) => return Ok(completions(shell)),
        Some(Command::Man { command }) => return man(command.as_deref()),
        Some(Command::Show(arguments)) if arguments.scene && !std::io::stdout().is_terminal() => {
            return show::run(&arguments);
        }
        None => rendered(&RenderArguments::lab()),
        Some(Command::Render(arguments)) => rendered(&arguments),
        Some(Command::Probe(arguments)) => probe::run(&arguments),
        Some(Command::Section(arguments)) => section::run(&arguments),
        Some(Command::Surface(arguments)) => surface::run(&arguments),
        Some(Command::Grid(arguments)) => grid::run(&arguments),
        Some(Command::Merge(arguments)) => store::merge(&arguments),
        Some(Command::App(arguments)) => app::run(&arguments),
        Some(Command::Check(arguments)) => check::run(&arguments),
        Some(Command::New(arguments)) => new::run(&arguments),
        Some(Command::Show(arguments)) => show::run(&arguments),
        Some(Command::Schema) => Ok(isophote::scene::source::schema()),
    }?;
    Ok(match escaped(&text) {
        Cow::Borrowed(_) => text,
        Cow::Owned(escaped) => escaped,
    })
}

/// Renders into memory, or into a store that may be larger than memory.
fn rendered(arguments: &RenderArguments) -> Result<String> {
    match store::asked_for(arguments)? {
        Some(path) => store::render(arguments, path),
        None => render::run(arguments),
    }
}

/// What there is to choose from, for an error message.
fn there_are(names: &[&str]) -> Message {
    match names {
        [] => message!("the scene has none"),
        _ => message!("there are: {names}", names = names.join(", ")),
    }
}

fn completions(shell: clap_complete::Shell) -> String {
    let mut bytes = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "isophote", &mut bytes);
    String::from_utf8_lossy(&bytes).into_owned()
}

fn man(name: Option<&str>) -> Result<String> {
    let mut command = Arguments::command();
    command.build();
    let command = match name {
        None => &command,
        Some(name) => {
            command.find_subcommand(name).ok_or_else(|| Usage(message!("there is no command `{name}`", name)))?
        }
    };
    let mut bytes = Vec::new();
    clap_mangen::Man::new(command.clone()).render(&mut bytes)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
