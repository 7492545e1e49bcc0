//! Numbers and texts in readable form.

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

#[cfg(test)]
mod tests {
    use super::{escaped, escaped_line, significant};

    #[test]
    fn what_controls_a_terminal_is_escaped_and_nothing_else() {
        assert_eq!(escaped("\u{1b}]0;x\u{7}\u{1b}[2J\r"), "\\u001B]0;x\\u0007\\u001B[2J\\u000D");
        assert_eq!(escaped("a\u{202e}b\u{2066}c\u{9b}\u{7f}\u{200f}"), "a\\u202Eb\\u2066c\\u009B\\u007F\\u200F");
        assert_eq!(escaped("two\nlines\tand"), "two\nlines\tand");
        assert_eq!(escaped_line("two\nlines\tand"), "two\\u000Alines\\u0009and");
        assert_eq!(escaped_line("Сфера «шар» 球 é W/m²"), "Сфера «шар» 球 é W/m²");
    }

    #[test]
    fn numbers_have_the_digits_that_were_asked_for_and_no_more() {
        assert_eq!(significant(0.316_677_297_547_092_75, 15), "0.316677297547093");
        assert_eq!(significant(0.316_677_297_547_092_75, 4), "0.3167");
        assert_eq!(significant(-100.0, 12), "-100");
        assert_eq!(significant(0.999_999_99, 4), "1");
        assert_eq!(significant(123_456.789, 3), "123457");
        assert_eq!(significant(1.5e-9, 12), "1.5e-9");
        assert_eq!(significant(-2.5e20, 12), "-2.5e20");
        assert_eq!(significant(0.0, 12), "0");
    }

    #[test]
    fn numbers_are_rounded_once() {
        let numbers = [9.9996, 99.9995, 999.95, 0.5, 1e14, 123_456.5, 2.5, 1.005, 65_535.0, 4.1e-5, 7.0, 100.25];
        for value in numbers.into_iter().flat_map(|value| [value, -value]) {
            for digits in 1..=17 {
                let scientific = format!("{value:.*e}", digits - 1);
                let exponent: i32 = scientific.split_once('e').unwrap().1.parse().unwrap();
                let decimals = usize::try_from(i32::try_from(digits).unwrap() - 1 - exponent).unwrap_or(0);
                let fixed = format!("{value:.decimals$}");
                let shown =
                    if fixed.contains('.') { fixed.trim_end_matches('0').trim_end_matches('.') } else { &fixed };
                assert_eq!(significant(value, digits), shown, "{value} with {digits} digits");
            }
        }
    }
}
