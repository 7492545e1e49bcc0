//! Numbers and texts in readable form, in either language.

mod language;
mod message;
mod russian;
#[cfg(test)]
mod tests;

pub use language::Language;
pub use message::{Message, ToValue, Value};

use std::borrow::Cow;
use std::fmt::Write;

/// Whether a character must not reach a terminal as it is: it controls the terminal, or the direction of the text around it.
#[must_use]
pub fn is_control(character: char) -> bool {
    character.is_control()
        || matches!(character, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// A text for a terminal: [control characters](is_control) but line ends and tabs are shown as escapes, such as `\u001B`, which
/// mean the same in a JSON or TOML string.
#[must_use]
pub fn escaped(text: &str) -> Cow<'_, str> {
    escaped_but(text, &['\n', '\t'])
}

/// A text for one line of a terminal: line ends are shown as escapes too.
#[must_use]
pub fn escaped_line(text: &str) -> Cow<'_, str> {
    escaped_but(text, &[])
}

fn escaped_but<'t>(text: &'t str, kept: &[char]) -> Cow<'t, str> {
    let is_escaped = |character: char| is_control(character) && !kept.contains(&character);
    let is_plain = text.bytes().all(|byte| matches!(byte, b' '..=b'~' | b'\n'));
    if (is_plain && (kept.contains(&'\n') || !text.contains('\n'))) || !text.contains(is_escaped) {
        return text.into();
    }
    let mut escaped = String::with_capacity(text.len() + 16);
    for character in text.chars() {
        if is_escaped(character) {
            // All of them have four digits. Writing to a string cannot fail.
            let _ = write!(escaped, "\\u{:04X}", u32::from(character));
        } else {
            escaped.push(character);
        }
    }
    escaped.into()
}

/// A number with this many significant digits, without trailing zeros; as a power of ten if it is very large or very small.
#[must_use]
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let mut scientific = String::with_capacity(digits + 8);
    // Writing to a string cannot fail.
    let _ = write!(scientific, "{value:.*e}", digits - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if !(-5..15).contains(&exponent) {
        return format!("{}e{exponent}", trimmed(mantissa));
    }
    let whole = usize::try_from(exponent).unwrap_or(0);
    if exponent < 0 || whole >= digits {
        let decimals = usize::try_from(i32::try_from(digits).unwrap_or(17) - 1 - exponent).unwrap_or(0);
        return trimmed(&format!("{value:.decimals$}")).to_owned();
    }
    // The digits are the same: the point moves.
    scientific.truncate(mantissa.len());
    if let Some(point) = scientific.find('.') {
        scientific.remove(point);
        scientific.insert(point + whole, '.');
        scientific.truncate(trimmed(&scientific).len());
    }
    scientific
}

fn trimmed(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}
