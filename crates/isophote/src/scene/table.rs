//! Reads a table of a scene file: types and keys. The allowed values are checked in `validate`.

use crate::message;
use crate::text::Message;
use std::collections::BTreeMap;

use super::document::{Document, Entry, Node, Path, Value};
use super::error::{Problem, ProblemKind};
use super::problems::{Problems, closest, short, suggestion};
use super::source::Amount;
use crate::units::Keyword;

/// Reads the table at the root of a document.
pub fn read_root<T: Default>(
    document: &Document<'_>,
    problems: &mut Problems,
    read: impl FnOnce(&mut Table<'_>) -> T,
) -> T {
    let Value::Table(entries) = &document.root.value else { return T::default() };
    let mut table = Table { entries, path: Path::root(), known: Vec::new(), problems };
    let value = read(&mut table);
    table.refuse_unknown_keys();
    value
}

/// A table being read.
pub struct Table<'t> {
    entries: &'t [Entry<'t>],
    path: Path,
    known: Vec<&'static str>,
    problems: &'t mut Problems,
}

impl<'t> Table<'t> {
    fn find(&mut self, key: &'static str) -> Option<&'t Node<'t>> {
        self.known.push(key);
        self.entries.iter().find(|entry| entry.key == key).map(|entry| &entry.node)
    }

    /// The value of a key, converted by `convert`; if that fails, it is reported as not being `expected`.
    fn value<T>(
        &mut self,
        key: &'static str,
        expected: impl Fn() -> Message,
        convert: impl FnOnce(&Value<'_>) -> Option<T>,
    ) -> Option<T> {
        let node = self.find(key)?;
        let value = convert(&node.value);
        if value.is_none() {
            self.wrong_type(&self.path.key(key), &node.value, &expected());
        }
        value
    }

    fn wrong_type(&mut self, path: &Path, value: &Value<'_>, expected: &Message) {
        let message = message!("`{path}` is {found}", path, found = value.describe());
        self.problems.push(ProblemKind::WrongType, path, message, message!("allowed: {expected}", expected));
    }

    pub(super) fn text(&mut self, key: &'static str) -> Option<String> {
        self.value(
            key,
            || message!("a text in quotes"),
            |value| match value {
                Value::Text(text) => Some(text.clone().into_owned()),
                _ => None,
            },
        )
    }

    pub(super) fn number(&mut self, key: &'static str) -> Option<f64> {
        let number = self.value(key, || message!("a number"), as_number)?;
        self.finite(|path| path.key(key), number)
    }

    /// A number, or three.
    pub(super) fn amount(&mut self, key: &'static str) -> Option<Amount> {
        let expected = || message!("a number, or a list of three: [red, green, blue]");
        let entry = self.entries.iter().find(|entry| entry.key == key);
        if entry.is_some_and(|entry| matches!(entry.node.value, Value::Array(_))) {
            return self.numbers_expected(key, expected).map(Amount::Rgb);
        }
        let number = self.value(key, expected, as_number)?;
        self.finite(|path| path.key(key), number).map(Amount::Number)
    }

    pub(super) fn boolean(&mut self, key: &'static str) -> Option<bool> {
        self.value(
            key,
            || message!("true or false"),
            |value| match value {
                Value::Boolean(value) => Some(*value),
                _ => None,
            },
        )
    }

    pub(super) fn count(&mut self, key: &'static str) -> Option<u64> {
        self.value(key, || message!("a whole number, not negative"), as_count)
    }

    pub(super) fn numbers<const N: usize>(&mut self, key: &'static str) -> Option<[f64; N]> {
        self.numbers_expected(key, || message!("a list of {count} numbers", count = N))
    }

    fn numbers_expected<const N: usize>(
        &mut self,
        key: &'static str,
        expected: impl Fn() -> Message,
    ) -> Option<[f64; N]> {
        let numbers: [f64; N] = self.list(key, expected, as_number)?;
        let mut all_finite = true;
        for (index, number) in numbers.into_iter().enumerate() {
            all_finite &= self.finite(|path| path.key(key).index(index), number).is_some();
        }
        if !all_finite {
            self.problems.reported.insert(self.path.key(key));
        }
        all_finite.then_some(numbers)
    }

    /// Three rows of three numbers.
    pub(super) fn matrix(&mut self, key: &'static str) -> Option<[[f64; 3]; 3]> {
        let rows: [[f64; 3]; 3] = self.list(key, || message!("a list of 3 rows, each a list of 3 numbers"), as_row)?;
        for (number, row) in rows.iter().enumerate() {
            for (column, value) in row.iter().enumerate() {
                if self.finite(|path| path.key(key).index(number).index(column), *value).is_none() {
                    self.problems.reported.insert(self.path.key(key));
                    return None;
                }
            }
        }
        Some(rows)
    }

    /// Any number of rows of three numbers.
    pub(super) fn rows(&mut self, key: &'static str) -> Option<Vec<[f64; 3]>> {
        let rows = self.several(key, || message!("a list of 3 numbers"), as_row)?;
        for (number, row) in rows.iter().enumerate() {
            if let Some(column) = row.iter().position(|value| !value.is_finite()) {
                self.finite(|path| path.key(key).index(number).index(column), row[column]);
                self.problems.reported.insert(self.path.key(key));
                return None;
            }
        }
        Some(rows)
    }

    /// Any number of rows of three whole numbers.
    pub(super) fn rows_of_counts(&mut self, key: &'static str) -> Option<Vec<[u64; 3]>> {
        self.several(
            key,
            || message!("a list of 3 whole numbers, not negative"),
            |value| {
                let Value::Array(items) = value else { return None };
                let [a, b, c] = items.as_slice() else { return None };
                Some([as_count(&a.value)?, as_count(&b.value)?, as_count(&c.value)?])
            },
        )
    }

    /// A list of any length. Only the first item that is not as expected is reported: there may be millions.
    fn several<T>(
        &mut self,
        key: &'static str,
        expected: impl Fn() -> Message,
        convert: impl Fn(&Value<'_>) -> Option<T>,
    ) -> Option<Vec<T>> {
        let node = self.find(key)?;
        let path = self.path.key(key);
        let Value::Array(items) = &node.value else {
            self.wrong_type(
                &path,
                &node.value,
                &message!("a list, each of whose items is {expected}", expected = expected()),
            );
            return None;
        };
        let mut list = Vec::with_capacity(items.len());
        for (index, item) in items.iter().enumerate() {
            let Some(value) = convert(&item.value) else {
                self.wrong_type(&path.index(index), &item.value, &expected());
                self.problems.reported.insert(path);
                return None;
            };
            list.push(value);
        }
        Some(list)
    }

    pub(super) fn counts<const N: usize>(&mut self, key: &'static str) -> Option<[u64; N]> {
        self.list(key, || message!("a list of {count} whole numbers, not negative", count = N), as_count)
    }

    fn list<T: Copy + Default, const N: usize>(
        &mut self,
        key: &'static str,
        expected: impl Fn() -> Message,
        convert: impl Fn(&Value<'_>) -> Option<T>,
    ) -> Option<[T; N]> {
        let node = self.find(key)?;
        let Value::Array(items) = &node.value else {
            self.wrong_type(&self.path.key(key), &node.value, &expected());
            return None;
        };
        if items.len() != N {
            let comma = if items.len() > N && items.len() <= 2 * N && items.iter().all(is_whole) {
                message!("; numbers have decimal points: a comma begins the next number")
            } else {
                Message::empty()
            };
            let expected = message!("{expected}{comma}", expected = expected(), comma);
            self.wrong_type(&self.path.key(key), &node.value, &expected);
            return None;
        }
        let mut list = [T::default(); N];
        let mut complete = true;
        for (index, item) in items.iter().enumerate() {
            if let Some(value) = convert(&item.value) {
                list[index] = value;
            } else {
                let path = self.path.key(key).index(index);
                self.wrong_type(&path, &item.value, &message!("`{key}` is {expected}", key, expected = expected()));
                complete = false;
            }
        }
        // The whole key is then known to be wrong, rather than missing.
        if !complete {
            self.problems.reported.insert(self.path.key(key));
        }
        complete.then_some(list)
    }

    pub(super) fn keyword<C: Keyword>(&mut self, key: &'static str) -> Option<C> {
        let text = self.text(key)?;
        let choice = C::from_name(&text);
        if choice.is_none() {
            let names: Vec<&str> = C::ALL.iter().map(|choice| choice.name()).collect();
            let path = self.path.key(key);
            let message = message!("`{path}` cannot be \"{text}\"", path, text = short(&text));
            let help = message!(
                "allowed: {names}{meant}",
                names = names.join(", "),
                meant = suggestion(closest(&text, &names))
            );
            self.problems.push(ProblemKind::Value, &path, message, help);
        }
        choice
    }

    pub(super) fn table<T>(&mut self, key: &'static str, read: impl FnOnce(&mut Table<'_>) -> T) -> Option<T> {
        let path = self.path.key(key);
        let node = self.find(key)?;
        self.read_table(node, path, read)
    }

    fn read_table<T>(&mut self, node: &Node<'_>, path: Path, read: impl FnOnce(&mut Table<'_>) -> T) -> Option<T> {
        let Value::Table(entries) = &node.value else {
            self.wrong_type(&path, &node.value, &message!("a table"));
            return None;
        };
        let mut table = Table { entries, path, known: Vec::with_capacity(KEYS), problems: self.problems };
        let value = read(&mut table);
        table.refuse_unknown_keys();
        Some(value)
    }

    pub(super) fn tables<T: Default>(&mut self, key: &'static str, read: impl Fn(&mut Table<'_>) -> T) -> Vec<T> {
        let path = self.path.key(key);
        let Some(node) = self.find(key) else {
            return Vec::new();
        };
        let Value::Array(items) = &node.value else {
            let help = message!("a list of tables, each headed by [[{key}]]", key);
            self.wrong_type(&path, &node.value, &help);
            return Vec::new();
        };
        let read_item = |(index, item)| {
            let path = path.index(index);
            // An item that is not a table keeps its place, so that the others keep their numbers.
            self.read_table(item, path, &read).unwrap_or_default()
        };
        items.iter().enumerate().map(read_item).collect()
    }

    pub(super) fn named_tables<T>(
        &mut self,
        key: &'static str,
        read: impl Fn(&mut Table<'_>) -> T,
    ) -> BTreeMap<String, T> {
        let path = self.path.key(key);
        let Some(node) = self.find(key) else {
            return BTreeMap::new();
        };
        let Value::Table(tables) = &node.value else {
            self.wrong_type(&path, &node.value, &message!("tables with names, each headed by [{key}.NAME]", key));
            return BTreeMap::new();
        };
        let read_entry = |entry: &Entry<'_>| {
            let value = self.read_table(&entry.node, path.key(entry.key.clone().into_owned()), &read)?;
            Some((entry.key.clone().into_owned(), value))
        };
        tables.iter().filter_map(read_entry).collect()
    }

    /// A number that is finite; `place` makes the path to it from that of the table.
    fn finite(&mut self, place: impl FnOnce(&Path) -> Path, number: f64) -> Option<f64> {
        if number.is_finite() {
            return Some(number);
        }
        let path = &place(&self.path);
        let message = message!("`{path}` is {value}", path, value = number);
        self.problems.push(ProblemKind::Value, path, message, message!("allowed: finite numbers"));
        None
    }

    fn refuse_unknown_keys(&mut self) {
        for entry in self.entries {
            if !self.known.contains(&&*entry.key) {
                let path = self.path.key(entry.key.clone().into_owned());
                let key = short(&entry.key);
                let message = if self.path == Path::root() {
                    message!("a scene has no key `{key}`", key)
                } else {
                    message!("`{path}` has no key `{key}`", path = self.path, key)
                };
                let meant = closest(&entry.key, &self.known);
                // The intended key is then not reported as missing too.
                self.problems.reported.extend(meant.map(|key| self.path.key(key)));
                let help =
                    message!("allowed: {names}{meant}", names = self.known.join(", "), meant = suggestion(meant));
                let mut problem = Problem::at_span(ProblemKind::UnknownKey, Some(entry.key_span.clone()), message);
                problem.path = path.to_string();
                self.problems.add(problem.with_help(help));
            }
        }
    }
}

/// The most keys that a table of a list has, so that what is known of them need not grow.
const KEYS: usize = 20;

#[allow(clippy::cast_precision_loss, reason = "a number with more than 15 digits is rounded, as every double is")]
fn as_number(value: &Value<'_>) -> Option<f64> {
    match value {
        Value::Integer(number) => Some(*number as f64),
        Value::Float(number) => Some(*number),
        _ => None,
    }
}

fn as_row(value: &Value<'_>) -> Option<[f64; 3]> {
    let Value::Array(items) = value else { return None };
    let [x, y, z] = items.as_slice() else { return None };
    Some([as_number(&x.value)?, as_number(&y.value)?, as_number(&z.value)?])
}

fn as_count(value: &Value<'_>) -> Option<u64> {
    match value {
        Value::Integer(number) => u64::try_from(*number).ok(),
        _ => None,
    }
}

/// Whether it is written without a fraction, as both halves of a number with a decimal comma are.
fn is_whole(item: &Node<'_>) -> bool {
    matches!(item.value, Value::Integer(_))
}
