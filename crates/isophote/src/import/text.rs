//! Lines, words and numbers of text files, read as bytes: comments may be in any encoding.

use super::FileProblem;
use crate::message;
use crate::text::Message;

/// The lines with their numbers from 1, without the line endings (LF or CR LF). A final line ending does not start another
/// line.
pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = (u64, &[u8])> {
    let mut rest = Some(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes));
    let lines = std::iter::from_fn(move || {
        let bytes = rest.filter(|rest| !rest.is_empty())?;
        let (line, after) = match memchr::memchr(b'\n', bytes) {
            Some(end) => (&bytes[..end], Some(&bytes[end + 1..])),
            None => (bytes, None),
        };
        rest = after;
        Some(line.strip_suffix(b"\r").unwrap_or(line))
    });
    (1..).zip(lines)
}

/// The words of a line, separated by spaces and tabs.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// A decimal number; `nan`, `inf` and numbers too large for a double are left for the caller to reject, with the value.
pub(super) fn number(word: &[u8], field: &str) -> Result<f64, FileProblem> {
    let number = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
    number.ok_or_else(|| not_a_number(word, Message::verbatim(field), message!("a number")))
}

/// A finite decimal number.
pub(super) fn finite_number(word: &[u8], field: &'static str) -> Result<f64, FileProblem> {
    let value = number(word, field)?;
    finite(value, field)
}

/// The number itself if it is finite.
pub(super) fn finite(value: f64, field: &'static str) -> Result<f64, FileProblem> {
    if value.is_finite() { Ok(value) } else { Err(FileProblem::NotFinite { field, value }) }
}

/// An integer.
pub(super) fn integer(word: &[u8], field: impl FnOnce() -> Message) -> Result<i64, FileProblem> {
    let number = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
    number.ok_or_else(|| not_a_number(word, field(), message!("a whole number")))
}

fn not_a_number(word: &[u8], field: Message, allowed: Message) -> FileProblem {
    FileProblem::NotANumber { field, text: shown(word), allowed }
}

/// A word for messages: long ones are truncated, and invalid text is replaced.
pub(super) fn shown(word: &[u8]) -> String {
    let text = String::from_utf8_lossy(&word[..word.len().min(160)]);
    let mut shown: String = text.chars().map(|c| if c.is_control() { '\u{fffd}' } else { c }).take(40).collect();
    if shown.chars().count() < text.chars().count() || word.len() > 160 {
        shown.push('…');
    }
    shown
}
