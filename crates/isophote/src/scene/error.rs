//! What is wrong with a scene: every problem at once, each with its place.

use std::ops::Range;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

use super::document::{Document, Path};
use crate::text::escaped;

/// Why a scene could not be used.
#[derive(Debug, Clone, thiserror::Error)]
#[error("{}", self.report(false))]
pub struct SceneError {
    /// The file's name as the user gave it, or a word for the scene's origin.
    pub name: String,
    /// Everything that is wrong, in the order of the file.
    pub problems: Vec<Problem>,
}

/// One thing that is wrong with a scene or, in [`Scene::warnings`](super::Scene::warnings), worth mentioning.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// The kind of mistake.
    pub kind: ProblemKind,
    /// The item concerned, such as `sphere[0].radius`; empty for the file as a whole.
    pub path: String,
    /// What is wrong, with the value.
    pub message: String,
    /// What is allowed, or what to do.
    pub help: Option<String>,
    /// Its place in the text, if the scene came from a text that contains it.
    pub place: Option<TextPosition>,
    pub(super) target: Target,
}

/// How a problem is located in the text.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Target {
    Nothing,
    /// All that is not listed: how many.
    Rest(usize),
    Span(Range<usize>),
    Value(Path),
    /// The table that lacks a key.
    Table(Path),
}

/// The kind of a [`Problem`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProblemKind {
    /// The file cannot be read at all.
    Unreadable,
    /// The text is not TOML, or not JSON.
    Syntax,
    /// A key that does not exist in any scene.
    UnknownKey,
    /// A required key is missing.
    MissingKey,
    /// A value of the wrong type.
    WrongType,
    /// A value that is not allowed.
    Value,
    /// Nothing wrong, but the user should know.
    Warning,
}

impl ProblemKind {
    /// Its name for programs: `unknown-key`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Unreadable => "unreadable",
            Self::Syntax => "syntax",
            Self::UnknownKey => "unknown-key",
            Self::MissingKey => "missing-key",
            Self::WrongType => "wrong-type",
            Self::Value => "value",
            Self::Warning => "warning",
        }
    }
}

/// A place in a scene file.
#[derive(Debug, Clone, PartialEq)]
pub struct TextPosition {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// The line's text.
    pub text: String,
    /// The relevant bytes of `text`.
    pub highlight: Range<usize>,
}

impl SceneError {
    /// An error with one problem that concerns the file as a whole.
    #[must_use]
    pub fn unreadable(name: &str, message: String, help: Option<String>) -> Self {
        let problem = Problem { help, ..Problem::new(ProblemKind::Unreadable, Target::Nothing, message) };
        Self { name: name.into(), problems: vec![problem] }
    }

    /// How many problems there are. If there are very many, only the first ones are listed, and the last entry says how many
    /// more there are.
    #[must_use]
    pub fn count(&self) -> usize {
        count(&self.problems)
    }

    /// The problems in readable form: message, file, line, the line's text with a caret, and what is allowed. `color` adds
    /// terminal colours.
    #[must_use]
    pub fn report(&self, color: bool) -> String {
        report(&self.name, &self.problems, color)
    }
}

/// How many problems there are, with those that are not listed.
fn count(problems: &[Problem]) -> usize {
    match problems.last().map(|last| &last.target) {
        Some(Target::Rest(more)) => problems.len() - 1 + more,
        _ => problems.len(),
    }
}

/// Further problems are only counted: the first ones usually cause the rest.
const SHOWN: usize = 30;

/// Formats problems; see [`SceneError::report`].
#[must_use]
pub fn report(name: &str, problems: &[Problem], color: bool) -> String {
    let name = &escaped(name);
    let renderer = if color { Renderer::styled() } else { Renderer::plain() };
    let mut drawn: Vec<String> = problems.iter().take(SHOWN).map(|problem| problem.draw(name, &renderer)).collect();
    if problems.len() > SHOWN {
        drawn.push(format!("… and {} more", count(problems) - SHOWN));
    }
    drawn.join("\n\n")
}

impl Problem {
    pub(super) fn new(kind: ProblemKind, target: Target, message: String) -> Self {
        let path = match &target {
            Target::Value(path) | Target::Table(path) => path.to_string(),
            Target::Nothing | Target::Rest(_) | Target::Span(_) => String::new(),
        };
        let [path, message] = [path, message].map(|text| escaped(&text).into_owned());
        Self { kind, path, message, help: None, place: None, target }
    }

    pub(super) fn at_span(kind: ProblemKind, span: Option<Range<usize>>, message: String) -> Self {
        Self::new(kind, span.map_or(Target::Nothing, Target::Span), message)
    }

    pub(super) fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(escaped(&help.into()).into_owned());
        self
    }

    /// Finds the problem's place in the source text.
    pub(super) fn locate(&mut self, text: &Lines<'_>, document: &Document<'_>) {
        let span = match &self.target {
            Target::Nothing | Target::Rest(_) => None,
            Target::Span(span) => Some(span.clone()),
            Target::Value(path) | Target::Table(path) => document.span_of(path),
        };
        self.place = span.map(|span| text.place(&span));
    }

    fn draw(&self, name: &str, renderer: &Renderer) -> String {
        let level = if self.kind == ProblemKind::Warning { Level::WARNING } else { Level::ERROR };
        let Some(place) = &self.place else {
            let place = if self.path.is_empty() { name.into() } else { format!("{name}: {}", self.path) };
            let title = level.primary_title(format!("{place}: {}", self.message));
            return self
                .add_help(title.elements(Vec::<Snippet<'_, annotate_snippets::Annotation<'_>>>::new()), renderer);
        };
        let Range { start, end } = place.highlight;
        let [before, marked, after] = [&place.text[..start], &place.text[start..end], &place.text[end..]].map(escaped);
        let marked_place = before.len()..before.len() + marked.len();
        let text = [before, marked, after].concat();
        let snippet = Snippet::source(text.as_str())
            .path(name)
            .line_start(place.line)
            .annotation(AnnotationKind::Primary.span(marked_place));
        self.add_help(level.primary_title(self.message.as_str()).element(snippet), renderer)
    }

    fn add_help(&self, group: annotate_snippets::Group<'_>, renderer: &Renderer) -> String {
        match &self.help {
            Some(help) => renderer.render(&[group.element(Level::HELP.message(help.as_str()))]),
            None => renderer.render(&[group]),
        }
    }
}

/// A text whose lines are indexed once, however many problems it has.
pub(super) struct Lines<'t> {
    text: &'t str,
    /// The start of each line.
    starts: Vec<usize>,
}

impl<'t> Lines<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        let starts = std::iter::once(0).chain(text.match_indices('\n').map(|(newline, _)| newline + 1)).collect();
        Self { text, starts }
    }

    fn place(&self, span: &Range<usize>) -> TextPosition {
        let text = self.text;
        let start = text.floor_char_boundary(span.start.min(text.len()));
        let line = self.starts.partition_point(|&line_start| line_start <= start);
        let line_start = self.starts[line - 1];
        let line_end = self.starts.get(line).map_or(text.len(), |next| next - 1);
        // A line of a generated file may be as long as the file, so only the surroundings of the place are kept.
        let from = text.floor_char_boundary(line_start.max(start.saturating_sub(Self::AROUND)));
        let to = text.ceil_char_boundary(line_end.min(start + Self::AROUND)).max(from);
        let end = text.ceil_char_boundary(span.end.clamp(start, start.max(to)));
        let kept = text[from..to].trim_end_matches('\r');
        let highlight = (start - from).min(kept.len())..(end - from).min(kept.len());
        let column = text[line_start..start].chars().count() + 1;
        TextPosition { line, column, text: kept.to_owned(), highlight }
    }

    /// The number of bytes of a line that are kept on either side of the place.
    const AROUND: usize = 160;
}
