//! Failures and their exit codes.

use std::fmt;
use std::io::{IsTerminal, Write};

use isophote::analysis::isophotes::IsophoteError;
use isophote::map::MapError;
use isophote::message;
use isophote::render::RenderError;
use isophote::scene::SceneError;
use isophote::text::{Language, Message, escaped};
use isophote_export::ExportError;
use isophote_export::figure::FigureError;
use isophote_zarr::StoreError;

/// Invalid arguments, for this scene or in general: exit code 2.
#[derive(Debug)]
pub struct Usage(pub Message);

impl fmt::Display for Usage {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(formatter)
    }
}

impl std::error::Error for Usage {}

/// What went wrong although the arguments were right: exit code 1.
#[derive(Debug)]
pub struct Failed(pub Message);

impl fmt::Display for Failed {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(formatter)
    }
}

impl std::error::Error for Failed {}

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
pub struct Paused(pub Message);

impl fmt::Display for Paused {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.message().fmt(formatter)
    }
}

impl std::error::Error for Paused {}

impl Paused {
    fn message(&self) -> Message {
        message!("interrupted; {stays}", stays = self.0)
    }
}

/// What an interruption of work on files is told as.
pub fn nothing_half_written() -> Message {
    message!("interrupted; nothing was left half-written")
}

/// Writes an error to standard error and chooses the exit code.
pub fn report(error: &anyhow::Error, language: Language) -> u8 {
    if let Some(scene_error) = find::<SceneError>(error) {
        let count = scene_error.count();
        let report = scene_error.report_in(language, use_color());
        let name = &scene_error.name;
        let sum = match count {
            1 => message!("{count} problem in {name}; nothing was written", count, name),
            _ => message!("{count} problems in {name}; nothing was written", count, name),
        };
        note_drawn(&format!("{report}\n\n{}", sum.in_language(language)));
        return 3;
    }
    if let Some(paused) = find::<Paused>(error) {
        note(&paused.message().in_language(language));
        return 130;
    }
    if is_interruption(error) {
        note(&nothing_half_written().in_language(language));
        return 130;
    }
    let reason = message_of(error).unwrap_or_else(|| Message::verbatim(format!("{error:#}")));
    note(&message!("error: {reason}", reason).in_language(language));
    if find::<Usage>(error).is_some() { 2 } else { 1 }
}

/// What an error says in either language. What the system and the files of outputs say is in English.
fn message_of(error: &anyhow::Error) -> Option<Message> {
    if let Some(Usage(message)) = find(error) {
        return Some(message.clone());
    }
    if let Some(Failed(message)) = find(error) {
        return Some(message.clone());
    }
    // Only as they are: an error around one of these says more.
    find::<RenderError>(error)
        .map(RenderError::message)
        .or_else(|| error.downcast_ref().map(ExportError::message))
        .or_else(|| error.downcast_ref().map(FigureError::message))
        .or_else(|| error.downcast_ref().map(IsophoteError::message))
        .or_else(|| error.downcast_ref().map(MapError::message))
        .or_else(|| error.downcast_ref().map(StoreError::message))
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
