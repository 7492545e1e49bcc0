//! Failures and their exit codes.

use std::fmt;
use std::io::{IsTerminal, Write};

use isophote::render::RenderError;
use isophote::scene::SceneError;
use isophote::text::escaped;

/// Invalid arguments, for this scene or in general: exit code 2.
#[derive(Debug)]
pub struct Usage(pub String);

impl fmt::Display for Usage {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0)
    }
}

impl std::error::Error for Usage {}

/// The user stopped the program: exit code 130.
#[derive(Debug)]
pub struct Interrupted;

impl fmt::Display for Interrupted {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("interrupted")
    }
}

impl std::error::Error for Interrupted {}

/// The user stopped a computation that can be resumed later: exit code 130.
#[derive(Debug)]
pub struct Paused(pub String);

impl fmt::Display for Paused {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "interrupted; {}", self.0)
    }
}

impl std::error::Error for Paused {}

/// What an interruption of work on files is told as.
pub const NOTHING_HALF_WRITTEN: &str = "interrupted; nothing was left half-written";

/// Writes an error to standard error and chooses the exit code.
pub fn report(error: &anyhow::Error) -> u8 {
    if let Some(scene_error) = find::<SceneError>(error) {
        let count = scene_error.count();
        let plural = if count == 1 { "" } else { "s" };
        let report = scene_error.report(use_color());
        note_drawn(&format!(
            "{report}\n\n{count} problem{plural} in {}; nothing was written",
            escaped(&scene_error.name)
        ));
        return 3;
    }
    if let Some(paused) = find::<Paused>(error) {
        note(&paused.to_string());
        return 130;
    }
    if is_interruption(error) {
        note(NOTHING_HALF_WRITTEN);
        return 130;
    }
    note(&format!("error: {error:#}"));
    if find::<Usage>(error).is_some() { 2 } else { 1 }
}

/// Writes a line to standard error, with control characters escaped.
pub fn note(text: &str) {
    note_drawn(&escaped(text));
}

/// Writes a line that may have colours to standard error. The reader may close the pipe at any time, which would make `eprintln!` panic.
pub fn note_drawn(text: &str) {
    let _ = writeln!(std::io::stderr(), "{text}");
}

/// Whether standard error is a terminal that wants colours (<https://no-color.org>).
pub fn use_color() -> bool {
    std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

fn is_interruption(error: &anyhow::Error) -> bool {
    find::<Interrupted>(error).is_some() || matches!(find(error), Some(RenderError::Interrupted))
}

fn find<E: std::error::Error + 'static>(error: &anyhow::Error) -> Option<&E> {
    error.chain().find_map(|cause| cause.downcast_ref())
}
