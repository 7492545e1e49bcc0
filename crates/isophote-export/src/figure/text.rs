//! Measures text in the embedded font, and breaks it into lines.

use std::sync::OnceLock;

use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, MetadataProvider};

/// `DejaVu Sans`, subset to the characters used in figures; see `font/README.md`.
pub(super) const FONT: &[u8] = include_bytes!("font/DejaVuSans-subset.ttf");

/// Advance of a character missing from the font: that of a wide capital, as a fraction of the font size.
const UNKNOWN_WIDTH: f64 = 0.8;

/// Width of a line of text in px, without kerning: at most a few per cent too wide.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let font = font();
    let metrics = font.glyph_metrics(Size::new(1.0), LocationRef::default());
    let characters = font.charmap();
    let advance = |character| characters.map(character).and_then(|glyph| metrics.advance_width(glyph));
    size * text.chars().map(|character| advance(character).map_or(UNKNOWN_WIDTH, f64::from)).sum::<f64>()
}

/// Width of the widest of several lines in px.
pub(super) fn widest<'text>(lines: impl IntoIterator<Item = &'text String>, size: f64) -> f64 {
    lines.into_iter().map(|line| width(line, size)).fold(0.0, f64::max)
}

/// The text in lines of at most `room` px, broken at spaces and newlines; a longer word gets its own line.
pub(super) fn wrap(text: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for paragraph in text.lines() {
        let mut line = String::new();
        for word in paragraph.split_whitespace() {
            if !line.is_empty() && width(&format!("{line} {word}"), size) > room {
                lines.push(std::mem::take(&mut line));
            }
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
        if !line.is_empty() {
            lines.push(line);
        }
    }
    lines
}

fn font() -> &'static FontRef<'static> {
    static PARSED: OnceLock<FontRef<'static>> = OnceLock::new();
    PARSED.get_or_init(|| FontRef::new(FONT).unwrap_or_else(|error| unreachable!("the embedded font: {error}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_those_of_dejavu_sans() {
        // DejaVu Sans has 2048 units per em; a digit is 1303 wide, a full stop 651, a minus sign 1716.
        assert!((width("0.5", 2048.0) - (2.0 * 1303.0 + 651.0)).abs() < 0.01);
        assert!((width("−1", 2048.0) - (1716.0 + 1303.0)).abs() < 0.01);
    }

    #[test]
    fn the_font_has_every_sign_that_a_figure_uses() {
        let figure = "AZaz09 éß°·×± АЯЁаяё ²³⁰⁻⁹₀₉ αωΣΩθφρ ←→↑↓ −≤≥≈∞∑√∫‖ «»„“–—… №";
        let missing: Vec<char> =
            figure.chars().filter(|&character| font().charmap().map(character).is_none()).collect();
        assert!(missing.is_empty(), "{missing:?}");
    }

    #[test]
    fn a_long_title_breaks_at_spaces_only() {
        let lines = wrap("Brightness of a sphere lit by two lamps", 10.0, 110.0);
        assert!(lines.len() > 1 && lines.iter().all(|line| width(line, 10.0) <= 110.0), "{lines:?}");
        assert_eq!(lines.join(" "), "Brightness of a sphere lit by two lamps");
        assert_eq!(wrap("one\ntwo", 10.0, 500.0), ["one", "two"]);
        assert!(wrap("", 10.0, 100.0).is_empty());
    }
}
