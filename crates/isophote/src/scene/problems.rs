//! Collects the problems of a scene, and helps to word their messages.

use crate::message;
use crate::text::Message;
use std::collections::HashSet;

use super::document::Path;
use super::error::{Problem, ProblemKind, Target};

/// Problems in the order found, at most one for each place.
#[derive(Default)]
pub struct Problems {
    list: Vec<Problem>,
    /// How many more were found than are listed.
    left_out: usize,
    pub(super) reported: HashSet<Path>,
}

impl Problems {
    /// Adds a problem, unless its place or something around it is already known to be wrong.
    pub fn push(&mut self, kind: ProblemKind, path: &Path, message: Message, help: Message) {
        if !self.reported.contains(path) {
            self.reported.insert(path.clone());
            if self.is_full() {
                self.left_out += 1;
                return;
            }
            let problem = Problem::new(kind, Target::Value(path.clone()), message);
            self.add(problem.with_help(help));
        }
    }

    /// Adds a problem for a key that is missing from a table, unless the key is there and already known to be wrong.
    pub fn missing(&mut self, table: &Path, key: &'static str, help: Message) {
        if self.reported.insert(table.key(key)) {
            let target = Target::Table(table.clone());
            let message = if *table == Path::root() {
                message!("the key `{key}` is missing", key)
            } else {
                message!("the key `{key}` is missing in `{table}`", key, table)
            };
            let mut problem = Problem::new(ProblemKind::MissingKey, target, message).with_help(help);
            problem.path = table.key(key).to_string();
            self.add(problem);
        }
    }

    /// Adds a problem, if there are not too many already.
    pub(super) fn add(&mut self, problem: Problem) {
        if self.is_full() {
            self.left_out += 1;
        } else {
            self.list.push(problem);
        }
    }

    fn is_full(&self) -> bool {
        self.list.len() >= MOST
    }

    /// Adds problems that were found before the scene was read.
    pub fn extend(&mut self, problems: impl IntoIterator<Item = Problem>) {
        for problem in problems {
            self.add(problem);
        }
    }

    /// All problems, in the order in which they were found; if there are very many, the first ones and how many there are.
    pub fn into_list(mut self) -> Vec<Problem> {
        let kind = self.list.last().map(|last| last.kind);
        if let Some(kind) = kind.filter(|_| self.left_out > 0) {
            let message = message!("{count} more were found and are not listed", count = self.left_out);
            self.list.push(Problem::new(kind, Target::Rest(self.left_out), message));
        }
        self.list
    }

    /// Whether the item at a path is known to be wrong.
    pub fn has(&self, path: &Path) -> bool {
        self.reported.contains(path)
    }

    /// Whether nothing was found.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }
}

/// The most problems that are listed. Each is looked up in the text, which takes as long as the text is.
const MOST: usize = 1000;

/// The known word that is closest to the written one, if any is close enough.
pub(super) fn closest<'w>(written: &str, known: &[&'w str]) -> Option<&'w str> {
    let written = written.to_lowercase();
    known
        .iter()
        .map(|word| (strsim::damerau_levenshtein(&written, word), *word))
        .filter(|(distance, word)| *distance <= 1 + word.chars().count() / 4)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, word)| word)
}

/// `; did you mean …?`
pub(super) fn suggestion(meant: Option<&str>) -> Message {
    meant.map_or_else(Message::empty, |word| message!("; did you mean `{word}`?", word))
}

/// A text from the file, shortened for a message.
pub(super) fn short(text: &str) -> String {
    const LENGTH: usize = 40;
    let mut short: String = text.chars().take(LENGTH).flat_map(char::escape_debug).collect();
    if text.chars().nth(LENGTH).is_some() {
        short.push('…');
    }
    short
}
