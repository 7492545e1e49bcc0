//! Text in the embedded font: its width, its lines, its letters' outlines.

use std::sync::OnceLock;

use tiny_skia::{Path, PathBuilder};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

use crate::figure::drawing::{Place, single};

/// `DejaVu Sans`, subset to the characters used in figures; see `font/README.md`.
const FONT: &[u8] = include_bytes!("font/DejaVuSans-subset.ttf");

/// Advance of a character missing from the font: that of a wide capital, as a fraction of the font size.
const UNKNOWN_WIDTH: f64 = 0.8;

/// Width of a line of text in px. Letters are not kerned.
pub(super) fn width(text: &str, size: f64) -> f64 {
    text.chars().map(|character| size * advance(character)).sum()
}

/// The outlines of a line's letters; none if nothing of it is to be seen. It starts at a point of its base line.
pub(super) fn outline(text: &str, size: f64, start: Place) -> Option<Path> {
    let unit = size / f64::from(font().units_per_em());
    let mut outline = Letters { path: PathBuilder::new(), start, unit };
    for character in text.chars() {
        // The first glyph stands for every character that the font lacks.
        let glyph = font().glyph_index(character).unwrap_or(GlyphId(0));
        font().outline_glyph(glyph, &mut outline);
        outline.start.x += size * advance(character);
    }
    outline.path.finish()
}

/// As a fraction of the font size.
fn advance(character: char) -> f64 {
    let advance = font().glyph_index(character).and_then(|glyph| font().glyph_hor_advance(glyph));
    advance.map_or(UNKNOWN_WIDTH, |advance| f64::from(advance) / f64::from(font().units_per_em()))
}

/// Outlines on the page, from those in the font, where y points up.
struct Letters {
    path: PathBuilder,
    start: Place,
    /// Size of the font's unit in px.
    unit: f64,
}

impl Letters {
    fn place(&self, x: f32, y: f32) -> [f32; 2] {
        [self.start.x + self.unit * f64::from(x), self.start.y - self.unit * f64::from(y)].map(single)
    }
}

impl OutlineBuilder for Letters {
    fn move_to(&mut self, x: f32, y: f32) {
        let [x, y] = self.place(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let [x, y] = self.place(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ([x1, y1], [x, y]) = (self.place(x1, y1), self.place(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ([x1, y1], [x2, y2], [x, y]) = (self.place(x1, y1), self.place(x2, y2), self.place(x, y));
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
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

fn font() -> &'static Face<'static> {
    static PARSED: OnceLock<Face<'static>> = OnceLock::new();
    PARSED.get_or_init(|| Face::parse(FONT, 0).unwrap_or_else(|error| unreachable!("the embedded font: {error}")))
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
        let missing: Vec<char> = figure.chars().filter(|&character| font().glyph_index(character).is_none()).collect();
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
