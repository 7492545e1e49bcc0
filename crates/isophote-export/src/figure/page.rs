//! What every figure has around its plot: a title above and a footer below.

use crate::figure::drawing::{Anchor, Drawing, PALE_INK, Place, Text};
use crate::figure::text;

/// White margin of the page in px.
pub(super) const MARGIN: f64 = 14.0;

const TITLE_SIZE: f64 = 14.0;
const TITLE_LINE: f64 = 19.0;
const FOOTER_SIZE: f64 = 8.0;
const FOOTER_LINE: f64 = 11.0;

/// Title and footer, broken into lines that fit the page.
pub(super) struct Page {
    width: f64,
    title: Vec<String>,
    footer: Vec<String>,
}

impl Page {
    pub(super) fn new(width: f64, title: &str, footer: &str) -> Self {
        let room = width - 2.0 * MARGIN;
        Self { width, title: text::wrap(title, TITLE_SIZE, room), footer: text::wrap(footer, FOOTER_SIZE, room) }
    }

    /// The top of the plot area.
    pub(super) fn top(&self) -> f64 {
        let gap = if self.title.is_empty() { 0.0 } else { 7.0 };
        MARGIN + lines(&self.title, TITLE_LINE) + gap
    }

    /// Height of the whole page if the plot area ends at `bottom`.
    pub(super) fn height(&self, bottom: f64) -> f64 {
        let gap = if self.footer.is_empty() { MARGIN } else { 10.0 + 0.6 * MARGIN };
        bottom + gap + lines(&self.footer, FOOTER_LINE)
    }

    /// Writes the title centred above `middle`, shifted sideways if it would not fit, and the footer below `bottom`.
    pub(super) fn draw(&self, drawing: &mut Drawing, middle: f64, bottom: f64) {
        let half = 0.5 * text::widest(&self.title, TITLE_SIZE);
        let x = middle.min(self.width - MARGIN - half).max(MARGIN + half);
        let mut y = MARGIN + 0.5 * TITLE_LINE;
        for line in &self.title {
            drawing.text(Text::new(line, Place { x, y }, TITLE_SIZE, Anchor::Middle));
            y += TITLE_LINE;
        }
        y = bottom + 10.0 + 0.5 * FOOTER_LINE;
        for line in &self.footer {
            let at = Place { x: MARGIN, y };
            drawing.text(Text { color: PALE_INK, ..Text::new(line, at, FOOTER_SIZE, Anchor::Start) });
            y += FOOTER_LINE;
        }
    }
}

fn lines(block: &[String], height: f64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a few lines")]
    let count = block.len() as f64;
    count * height
}
