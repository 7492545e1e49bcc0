//! What is wrong with a scene: every problem at once, each with its place.

use std::ops::Range;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

use super::document::{Document, Path};
use crate::message;
use crate::text::{Language, Message, escaped};

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
    pub message: Message,
    /// What is allowed, or what to do.
    pub help: Option<Message>,
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
    pub fn unreadable(name: &str, message: Message, help: Option<Message>) -> Self {
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
        self.report_in(Language::English, color)
    }

    /// The [report](Self::report) in a language. What the libraries that read TOML and JSON say of its syntax, and the
    /// operating system of a file, stays in English.
    #[must_use]
    pub fn report_in(&self, language: Language, color: bool) -> String {
        report_in(&self.name, &self.problems, language, color)
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
    report_in(name, problems, Language::English, color)
}

/// Formats problems in a language; see [`SceneError::report_in`].
#[must_use]
pub fn report_in(name: &str, problems: &[Problem], language: Language, color: bool) -> String {
    let name = &escaped(name);
    let renderer = if color { Renderer::styled() } else { Renderer::plain() };
    let mut drawn: Vec<String> =
        problems.iter().take(SHOWN).map(|problem| problem.draw(name, language, &renderer)).collect();
    if problems.len() > SHOWN {
        let more = message!("… and {count} more", count = count(problems) - SHOWN);
        drawn.push(more.in_language(language));
    }
    drawn.join("\n\n")
}

impl Problem {
    pub(super) fn new(kind: ProblemKind, target: Target, message: Message) -> Self {
        let path = match &target {
            Target::Value(path) | Target::Table(path) => path.to_string(),
            Target::Nothing | Target::Rest(_) | Target::Span(_) => String::new(),
        };
        let path = escaped(&path).into_owned();
        Self { kind, path, message, help: None, place: None, target }
    }

    pub(super) fn at_span(kind: ProblemKind, span: Option<Range<usize>>, message: Message) -> Self {
        Self::new(kind, span.map_or(Target::Nothing, Target::Span), message)
    }

    pub(super) fn with_help(mut self, help: Message) -> Self {
        self.help = Some(help);
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

    fn draw(&self, name: &str, language: Language, renderer: &Renderer) -> String {
        let (title, help) = self.levels(language);
        let message = self.message.in_language(language);
        let Some(place) = &self.place else {
            let place = if self.path.is_empty() { name.into() } else { format!("{name}: {}", self.path) };
            let title = title.primary_title(format!("{place}: {message}"));
            let group = title.elements(Vec::<Snippet<'_, annotate_snippets::Annotation<'_>>>::new());
            return self.with_help_drawn(group, help, language, renderer);
        };
        let Range { start, end } = place.highlight;
        let [before, marked, after] = [&place.text[..start], &place.text[start..end], &place.text[end..]].map(escaped);
        let marked_place = before.len()..before.len() + marked.len();
        let text = [before, marked, after].concat();
        let snippet = Snippet::source(text.as_str())
            .path(name)
            .line_start(place.line)
            .annotation(AnnotationKind::Primary.span(marked_place));
        self.with_help_drawn(title.primary_title(message).element(snippet), help, language, renderer)
    }

    /// The words before the message and before the help.
    fn levels(&self, language: Language) -> (Level<'static>, Level<'static>) {
        let (level, word) = match self.kind {
            ProblemKind::Warning => (Level::WARNING, message!("warning")),
            _ => (Level::ERROR, message!("error")),
        };
        if language == Language::English {
            return (level, Level::HELP);
        }
        let help = message!("help").in_language(language);
        (level.with_name(word.in_language(language)), Level::HELP.with_name(help))
    }

    fn with_help_drawn(
        &self,
        group: annotate_snippets::Group<'_>,
        level: Level<'_>,
        language: Language,
        renderer: &Renderer,
    ) -> String {
        match &self.help {
            Some(help) => renderer.render(&[group.element(level.message(help.in_language(language)))]),
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
