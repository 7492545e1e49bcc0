//! A scene file as a tree that records where everything is in the text: TOML and JSON look the same from here on.

use crate::message;
use crate::text::{self, Message, ToValue};
use std::borrow::Cow;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use jsonc_parser::common::Ranged;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::{Problem, ProblemKind};

/// A scene file's text and its tree.
#[derive(Debug)]
pub struct Document<'t> {
    /// The root table.
    pub root: Node<'t>,
    /// Violations of the file's syntax; the tree holds what could be read in spite of them.
    pub syntax_problems: Vec<Problem>,
    /// Whether nothing was kept because of the first of them, in a text that is too long for looking at what follows.
    pub ends_at_problem: bool,
}

/// A value and its place in the text, in bytes.
#[derive(Debug)]
pub struct Node<'t> {
    /// The value.
    pub value: Value<'t>,
    /// Its place in the text.
    pub span: Range<usize>,
}

/// A value in either language.
#[derive(Debug)]
pub enum Value<'t> {
    /// `true` or `false`.
    Boolean(bool),
    /// A number without a fraction or an exponent.
    Integer(i64),
    /// Any other number; TOML has NaN and infinities too.
    Float(f64),
    /// A string.
    Text(Cow<'t, str>),
    /// `[…]`
    Array(Vec<Node<'t>>),
    /// A table, or an object.
    Table(Vec<Entry<'t>>),
    /// A date, a time or null: a scene needs none of these.
    Other(Message),
}

impl Value<'_> {
    /// Its kind, for error messages.
    #[must_use]
    pub fn describe(&self) -> Message {
        match self {
            Self::Boolean(value) => Message::verbatim(value.to_string()),
            Self::Integer(number) => message!("the number {number}", number),
            Self::Float(number) => message!("the number {number}", number = format!("{number:?}")),
            Self::Text(_) => message!("a text"),
            Self::Array(items) => message!("a list of {count}", count = items.len()),
            Self::Table(_) => message!("a table"),
            Self::Other(kind) => kind.clone(),
        }
    }
}

/// A key and its value.
#[derive(Debug)]
pub struct Entry<'t> {
    /// The key.
    pub key: Cow<'t, str>,
    /// The key's place in the text.
    pub key_span: Range<usize>,
    /// Its value.
    pub node: Node<'t>,
}

/// The language of a scene file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Syntax {
    /// <https://toml.io>
    Toml,
    /// <https://www.json.org>
    Json,
}

impl<'t> Document<'t> {
    /// Parses as much of the text as its syntax allows.
    #[must_use]
    pub fn parse(text: &'t str, syntax: Syntax) -> Self {
        if let Some(span) = too_deep(text, syntax) {
            let message = message!("brackets are nested more than {deepest} deep; a scene needs 4", deepest = DEEPEST);
            let problem = Problem::at_span(ProblemKind::Syntax, Some(span), message);
            let root = Node { value: Value::Table(Vec::new()), span: 0..0 };
            return Self { root, syntax_problems: vec![problem], ends_at_problem: false };
        }
        match syntax {
            Syntax::Toml => parse_toml(text),
            Syntax::Json => parse_json(text),
        }
    }

    /// The place of the item at a path, or of the nearest enclosing item that is in the text.
    #[must_use]
    pub fn span_of(&self, path: &Path) -> Option<Range<usize>> {
        let mut node: &Node<'_> = &self.root;
        // The root itself is represented by its first key.
        let mut span = match &node.value {
            Value::Table(entries) => entries.first().map(|entry| entry.key_span.clone()),
            _ => None,
        };
        for step in path.steps() {
            node = match (step, &node.value) {
                (Step::Key(key), Value::Table(entries)) => match entries.iter().find(|entry| entry.key == *key) {
                    Some(entry) => {
                        // A table's own span is often its whole body; its key shows the place better.
                        span = Some(match entry.node.value {
                            Value::Table(_) => entry.key_span.clone(),
                            _ => entry.node.span.clone(),
                        });
                        &entry.node
                    }
                    None => return span,
                },
                (Step::Index(index), Value::Array(items)) => match items.get(*index) {
                    Some(item) => {
                        span = Some(item.span.clone());
                        item
                    }
                    None => return span,
                },
                _ => return span,
            };
        }
        span
    }
}

/// The path from the root of a scene file to an item in it: `sphere[0].center[2]`. Paths that begin alike share their
/// beginning: checking a scene makes several for each of its numbers.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Path(Option<Arc<Link>>);

/// The last step of a path, and the path to there.
#[derive(Debug, PartialEq, Eq, Hash)]
struct Link {
    before: Path,
    step: Step,
}

/// One step of a [`Path`].
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Step {
    /// Into a table.
    Key(Cow<'static, str>),
    /// Into a list, counted from 0.
    Index(usize),
}

impl Path {
    /// The root itself.
    #[must_use]
    pub fn root() -> Self {
        Self::default()
    }

    /// The value of a key.
    #[must_use]
    pub fn key(&self, key: impl Into<Cow<'static, str>>) -> Self {
        self.step(Step::Key(key.into()))
    }

    /// An item of a list.
    #[must_use]
    pub fn index(&self, index: usize) -> Self {
        self.step(Step::Index(index))
    }

    fn step(&self, step: Step) -> Self {
        Self(Some(Arc::new(Link { before: self.clone(), step })))
    }

    /// The steps from the root on.
    fn steps(&self) -> Vec<&Step> {
        let mut steps: Vec<&Step> =
            std::iter::successors(self.0.as_deref(), |link| link.before.0.as_deref()).map(|link| &link.step).collect();
        steps.reverse();
        steps
    }
}

impl ToValue for Path {
    fn to_value(&self) -> text::Value {
        self.to_string().to_value()
    }
}

impl fmt::Display for Path {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, step) in self.steps().into_iter().enumerate() {
            match step {
                Step::Key(key) if position == 0 => write!(formatter, "{key}")?,
                Step::Key(key) => write!(formatter, ".{key}")?,
                Step::Index(index) => write!(formatter, "[{index}]")?,
            }
        }
        Ok(())
    }
}

/// The deepest nesting of brackets.
const DEEPEST: usize = 32;

/// The first bracket that is nested too deep. Texts and comments are skipped; in a text that is broken in other ways, some
/// bracket may be taken for one of another depth.
fn too_deep(text: &str, syntax: Syntax) -> Option<Range<usize>> {
    let bytes = text.as_bytes();
    let (mut depth, mut at) = (0_usize, 0);
    while at < bytes.len() {
        match bytes[at] {
            b'[' | b'{' => {
                depth += 1;
                if depth > DEEPEST {
                    return Some(at..at + 1);
                }
            }
            b']' | b'}' => depth = depth.saturating_sub(1),
            b'#' if syntax == Syntax::Toml => at += memchr::memchr(b'\n', &bytes[at..]).unwrap_or(bytes.len() - at) - 1,
            quote @ (b'"' | b'\'') if quote == b'"' || syntax == Syntax::Toml => at = end_of_text(bytes, at, syntax),
            _ => {}
        }
        at += 1;
    }
    None
}

/// The place of the last quote of a text that begins here, or of the end of its line if it does not end.
fn end_of_text(bytes: &[u8], start: usize, syntax: Syntax) -> usize {
    let quote = bytes[start];
    let long = [quote; 3];
    let is_long = syntax == Syntax::Toml && bytes[start..].starts_with(&long);
    let mut at = if is_long { start + 3 } else { start + 1 };
    while at < bytes.len() {
        match bytes[at] {
            b'\\' if quote == b'"' => at += 1,
            b'\n' if !is_long => return at,
            byte if byte == quote && !is_long => return at,
            byte if byte == quote && bytes[at..].starts_with(&long) => return at + 2,
            _ => {}
        }
        at += 1;
    }
    bytes.len()
}

/// More violations of the syntax than this are not looked at: one of them has caused the others.
const MOST_SYNTAX_PROBLEMS: usize = 100;

/// The longest text, in bytes, that is read on after a violation of the syntax. There may be one for every second byte, and
/// the parser keeps them all, at 300 bytes each.
const LONGEST_RECOVERED: usize = 256 << 10;

fn parse_toml(text: &str) -> Document<'_> {
    let (root, errors, ends_at_problem) = match DeTable::parse(text) {
        Ok(root) => (root, Vec::new(), false),
        Err(first) if text.len() > LONGEST_RECOVERED => (Spanned::new(0..0, DeTable::new()), vec![first], true),
        Err(_) => {
            let (root, errors) = DeTable::parse_recoverable(text);
            (root, errors, false)
        }
    };
    let syntax_problems = errors
        .iter()
        .take(MOST_SYNTAX_PROBLEMS)
        .map(|error| {
            let message = message!("not valid TOML: {reason}", reason = error.message());
            let mut problem = Problem::at_span(ProblemKind::Syntax, error.span(), message);
            problem.help = decimal_comma(text, error.span());
            problem
        })
        .collect();
    let span = root.span();
    let root = Node { value: Value::Table(toml_entries(root.into_inner())), span };
    Document { root, syntax_problems, ends_at_problem }
}

/// Advice on the line of a syntax problem if a number in it is written with a decimal comma.
fn decimal_comma(text: &str, span: Option<Range<usize>>) -> Option<Message> {
    let at = span?.start.min(text.len());
    let start = text.get(..at)?.rfind('\n').map_or(0, |end| end + 1);
    let line = text.get(start..)?.lines().next()?;
    line.match_indices(',').find_map(|(comma, _)| {
        let (before, after) = (&line[..comma], &line[comma + 1..]);
        let whole = &before[before.trim_end_matches(|letter: char| letter.is_ascii_digit()).len()..];
        let rest = after.trim_start_matches(|letter: char| letter.is_ascii_digit());
        let fraction = &after[..after.len() - rest.len()];
        let opening = before[..before.len() - whole.len()].trim_end_matches(['+', '-']).trim_end();
        let is_number = !whole.is_empty() && !fraction.is_empty() && opening.ends_with(['=', ':']);
        is_number
            .then(|| message!("a number has a decimal point, not a comma: write {whole}.{fraction}", whole, fraction))
    })
}

fn toml_entries(table: DeTable<'_>) -> Vec<Entry<'_>> {
    table
        .into_iter()
        .map(|(key, value)| Entry { key_span: key.span(), key: key.into_inner(), node: toml_node(value) })
        .collect()
}

fn toml_node(value: Spanned<DeValue<'_>>) -> Node<'_> {
    let span = value.span();
    let value = match value.into_inner() {
        DeValue::Boolean(value) => Value::Boolean(value),
        DeValue::String(text) => Value::Text(text),
        DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix())
            .map_or_else(|_| number(integer.as_str()), Value::Integer),
        DeValue::Float(float) => number(float.as_str()),
        DeValue::Array(items) => Value::Array(items.into_iter().map(toml_node).collect()),
        DeValue::Table(table) => Value::Table(toml_entries(table)),
        DeValue::Datetime(_) => Value::Other(message!("a date or time")),
    };
    Node { value, span }
}

/// A decimal literal. One that exceeds the range of doubles becomes infinite and is rejected later.
fn number(literal: &str) -> Value<'static> {
    literal.parse().map_or_else(|_| Value::Other(message!("a number that cannot be read")), Value::Float)
}

fn parse_json(text: &str) -> Document<'_> {
    use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};
    let strict = ParseOptions {
        allow_comments: false,
        allow_loose_object_property_names: false,
        allow_trailing_commas: false,
        allow_missing_commas: false,
        allow_single_quoted_strings: false,
        allow_hexadecimal_numbers: false,
        allow_unary_plus_numbers: false,
        allow_bare_decimal_point_numbers: false,
        allow_non_finite_numbers: false,
        allow_extended_string_escapes: false,
    };
    let empty = || Node { value: Value::Table(Vec::new()), span: 0..0 };
    let mut syntax_problems = Vec::new();
    let root = match parse_to_ast(text, &CollectOptions::default(), &strict) {
        Ok(parsed) => parsed.value.map_or_else(empty, |value| json_node(value, &mut syntax_problems)),
        Err(error) => {
            let span = error.range().start..error.range().end;
            let message = message!("not valid JSON: {reason}", reason = error.kind().to_string());
            let mut problem = Problem::at_span(ProblemKind::Syntax, Some(span.clone()), message);
            problem.help = decimal_comma(text, Some(span));
            syntax_problems.push(problem);
            empty()
        }
    };
    if !matches!(root.value, Value::Table(_)) {
        let message = message!("a scene is an object {{…}}, not {found}", found = root.value.describe());
        syntax_problems.push(Problem::at_span(ProblemKind::Syntax, Some(root.span), message));
        return Document { root: empty(), syntax_problems, ends_at_problem: false };
    }
    Document { root, syntax_problems, ends_at_problem: false }
}

fn json_node<'t>(value: jsonc_parser::ast::Value<'t>, problems: &mut Vec<Problem>) -> Node<'t> {
    use jsonc_parser::ast::Value as Json;
    let span = value.range().start..value.range().end;
    let value = match value {
        Json::BooleanLit(literal) => Value::Boolean(literal.value),
        Json::NullKeyword(_) => Value::Other(Message::verbatim("null")),
        Json::StringLit(text) => Value::Text(text.value),
        Json::NumberLit(literal) => literal.value.parse().map_or_else(|_| number(literal.value), Value::Integer),
        Json::Array(array) => Value::Array(array.elements.into_iter().map(|item| json_node(item, problems)).collect()),
        Json::Object(object) => Value::Table(json_entries(object, problems)),
    };
    Node { value, span }
}

fn json_entries<'t>(object: jsonc_parser::ast::Object<'t>, problems: &mut Vec<Problem>) -> Vec<Entry<'t>> {
    use jsonc_parser::ast::ObjectPropName;
    let mut entries: Vec<Entry<'_>> = Vec::with_capacity(object.properties.len());
    let mut keys = std::collections::HashSet::new();
    for property in object.properties {
        let key_span = property.name.range().start..property.name.range().end;
        let key: Cow<'_, str> = match property.name {
            ObjectPropName::String(literal) => literal.value,
            ObjectPropName::Word(literal) => literal.value.into(),
        };
        if keys.insert(key.clone()) {
            entries.push(Entry { key, key_span, node: json_node(property.value, problems) });
        } else if problems.len() < MOST_SYNTAX_PROBLEMS {
            let message = message!("the key `{key}` stands twice in this object", key);
            problems.push(Problem::at_span(ProblemKind::Syntax, Some(key_span), message));
        }
    }
    entries
}
