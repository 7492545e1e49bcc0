//! An SVG writer: elements in drawing order, all text escaped.

use std::fmt::Write;

/// Fallbacks for programs that lack the first font; Verdana has nearly the same widths.
const FONTS: &str = "DejaVu Sans, Verdana, Bitstream Vera Sans, sans-serif";
pub(super) const INK: &str = "#1a1a1a";
pub(super) const PALE_INK: &str = "#7a7a7a";
pub(super) const PAPER: &str = "#ffffff";

/// A point on the page in px: x to the right, y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) x: f64,
    pub(super) y: f64,
}

impl Place {
    pub(super) fn distance(self, other: Self) -> f64 {
        (self.x - other.x).hypot(self.y - other.y)
    }
}

/// A rectangle on the page in px.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rectangle {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

/// A page under construction.
pub(super) struct Svg {
    body: String,
}

impl Svg {
    pub(super) fn new() -> Self {
        Self { body: String::new() }
    }

    /// The complete file; the size is in px.
    pub(super) fn finish(self, width: f64, height: f64) -> String {
        let (width, height) = (number(width.ceil()), number(height.ceil()));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" \
             width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" font-family=\"{FONTS}\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"{PAPER}\"/>\n{}</svg>\n",
            self.body
        )
    }

    /// An element, written unchanged: only for attributes without user text.
    pub(super) fn raw(&mut self, element: &str) {
        self.body.push_str(element);
        self.body.push('\n');
    }

    /// `style` is a string of attributes.
    pub(super) fn rectangle(&mut self, rectangle: Rectangle, style: &str) {
        let Rectangle { left, top, width, height } = rectangle;
        let [left, top, width, height] = [left, top, width, height].map(number);
        self.raw(&format!("<rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" {style}/>"));
    }

    /// A path through the points. `style` is a string of attributes, including `fill` unless it is "none".
    pub(super) fn path(&mut self, places: &[Place], closed: bool, style: &str) {
        let mut data = String::new();
        for (index, place) in places.iter().enumerate() {
            let command = if index == 0 { "M" } else { "L" };
            let _ = write!(data, "{command}{} {}", number(place.x), number(place.y));
        }
        let end = if closed { "Z" } else { "" };
        let fill = if style.contains("fill=") { "" } else { " fill=\"none\"" };
        self.raw(&format!("<path d=\"{data}{end}\"{fill} {style}/>"));
    }

    pub(super) fn circle(&mut self, center: Place, radius: f64, style: &str) {
        let (x, y) = (number(center.x), number(center.y));
        self.raw(&format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{}\" {style}/>", number(radius)));
    }

    pub(super) fn text(&mut self, text: &Text) {
        let Text { content, at, size, anchor, degrees, color, halo } = text;
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let halo = halo.as_ref().map_or(String::new(), |color| {
            format!(" stroke=\"{color}\" stroke-width=\"2.6\" stroke-linejoin=\"round\" paint-order=\"stroke\"")
        });
        // Half the height of a capital below the middle; programs interpret dominant-baseline differently.
        let drop = 0.364 * size;
        let place = if *degrees == 0.0 {
            format!("x=\"{}\" y=\"{}\"", number(at.x), number(at.y + drop))
        } else {
            let turn = format!("translate({} {}) rotate({})", number(at.x), number(at.y), number(*degrees));
            format!("y=\"{}\" transform=\"{turn}\"", number(drop))
        };
        let (size, content) = (number(*size), escape(content));
        self.raw(&format!("<text {place} font-size=\"{size}\" fill=\"{color}\"{anchor}{halo}>{content}</text>"));
    }
}

/// Which end of a text is at its position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// One line of text; `at` is at half the height of its capitals.
pub(super) struct Text<'text> {
    pub(super) content: &'text str,
    pub(super) at: Place,
    pub(super) size: f64,
    pub(super) anchor: Anchor,
    /// Clockwise.
    pub(super) degrees: f64,
    pub(super) color: &'text str,
    /// Colour of an outline that keeps the text readable on top of lines.
    pub(super) halo: Option<String>,
}

impl<'text> Text<'text> {
    /// Horizontal black text, without a halo.
    pub(super) fn new(content: &'text str, at: Place, size: f64, anchor: Anchor) -> Self {
        Self { content, at, size, anchor, degrees: 0.0, color: INK, halo: None }
    }
}

/// At most two decimals: a hundredth of a pixel is invisible, and files stay small.
pub(super) fn number(value: f64) -> String {
    let fixed = format!("{value:.2}");
    let short = fixed.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".into() } else { short.into() }
}

/// Text as XML character data. Characters that XML 1.0 cannot hold at all become U+FFFD.
pub(super) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\u{0}'..='\u{8}' | '\u{b}' | '\u{c}' | '\u{e}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => {
                escaped.push('\u{fffd}');
            }
            other => escaped.push(other),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let written = [1.0, -0.001, 0.126, -12.5, 100.0].map(number);
        assert_eq!(written, ["1", "0", "0.13", "-12.5", "100"]);
    }

    #[test]
    fn a_title_cannot_break_the_file() {
        let mut svg = Svg::new();
        let title = "k_d < 0.5 & \"Сфера\" </text><script>\u{1}";
        svg.text(&Text::new(title, Place { x: 1.0, y: 2.0 }, 10.0, Anchor::Start));
        let file = svg.finish(20.0, 10.0);
        assert!(file.contains("k_d &lt; 0.5 &amp; &quot;Сфера&quot; &lt;/text&gt;&lt;script&gt;\u{fffd}</text>"));
        assert!(resvg::usvg::roxmltree::Document::parse(&file).is_ok());
    }
}
