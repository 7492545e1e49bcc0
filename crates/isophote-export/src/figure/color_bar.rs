//! The colour bar beside a map, with the levels of the isophotes marked on it.

use crate::colormap::luminance;
use crate::figure::drawing::{Anchor, BLACK, Color, Drawing, INK, PAPER, Place, Rectangle, Stroke, Style, Text};
use crate::figure::frame::{NUMBER_GAP, TICK_LENGTH, TICK_SIZE, TICK_STYLE, TITLE_SIZE};
use crate::figure::raster::{Scale, draw_ramp};
use crate::figure::text;
use crate::figure::ticks::Ticks;

const WIDTH: f64 = 16.0;
/// Height of the arrow for values beyond an end of the bar.
const ARROW: f64 = 11.0;
const TITLE_GAP: f64 = 9.0;
const TITLE_LINE: f64 = 15.0;

/// A vertical colour bar.
pub(super) struct ColorBar {
    pub(super) scale: Scale,
    pub(super) ticks: Ticks,
    /// The lines of the title, which reads from bottom to top.
    pub(super) title: Vec<String>,
    /// Levels of the isophotes.
    pub(super) levels: Vec<f64>,
    /// Whether there are values below the lower end and above the upper end.
    pub(super) beyond: [bool; 2],
}

impl ColorBar {
    /// Width in px, measured from the bar's left edge.
    pub(super) fn width(&self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "a few lines")]
        let title = TITLE_GAP + self.title.len() as f64 * TITLE_LINE;
        self.numbers_end() + if self.title.is_empty() { 0.0 } else { title }
    }

    fn numbers_end(&self) -> f64 {
        WIDTH + TICK_LENGTH + NUMBER_GAP + text::widest(&self.ticks.labels, TICK_SIZE)
    }

    pub(super) fn draw(&self, drawing: &mut Drawing, left: f64, top: f64, height: f64) {
        let [below, above] = self.beyond.map(|beyond| if beyond { ARROW } else { 0.0 });
        let bar = Rectangle { left, top: top + above, width: WIDTH, height: height - above - below };
        draw_ramp(drawing, self.scale.colormap, bar);
        let [low, high] = self.scale.range;
        let y = |value: f64| bar.top + (high - value) / (high - low) * bar.height;
        for &level in &self.levels {
            let style = Style::line(Stroke::new(contrast(self.scale.color(level)), 0.9));
            drawing.path(&[Place { x: left, y: y(level) }, Place { x: left + WIDTH, y: y(level) }], false, style);
        }
        self.draw_outline(drawing, bar, above, below);
        let right = left + WIDTH;
        for (&value, label) in self.ticks.values.iter().zip(&self.ticks.labels) {
            let y = y(value);
            drawing.path(&[Place { x: right, y }, Place { x: right + TICK_LENGTH, y }], false, TICK_STYLE);
            let at = Place { x: right + TICK_LENGTH + NUMBER_GAP, y };
            drawing.text(Text::new(label, at, TICK_SIZE, Anchor::Start));
        }
        let mut x = left + self.numbers_end() + TITLE_GAP + 0.5 * TITLE_LINE;
        for line in &self.title {
            let at = Place { x, y: top + 0.5 * height };
            drawing.text(Text { degrees: -90.0, ..Text::new(line, at, TITLE_SIZE, Anchor::Middle) });
            x += TITLE_LINE;
        }
    }

    /// The outline, with an arrow in the end's colour if there are values beyond that end.
    fn draw_outline(&self, drawing: &mut Drawing, bar: Rectangle, above: f64, below: f64) {
        let (right, bottom, middle) = (bar.left + WIDTH, bar.top + bar.height, bar.left + 0.5 * WIDTH);
        let corners = |edge: f64, tip: f64| {
            [Place { x: bar.left, y: edge }, Place { x: middle, y: tip }, Place { x: right, y: edge }]
        };
        let [upper, lower] = [corners(bar.top, bar.top - above), corners(bottom, bottom + below)];
        for (arrow, value) in [(upper, self.scale.range[1]), (lower, self.scale.range[0])] {
            drawing.path(&arrow, true, Style::filled(self.scale.color(value)));
        }
        let rim = [upper[0], upper[1], upper[2], lower[2], lower[1], lower[0]];
        drawing.path(&rim, true, Style::line(Stroke::new(INK, 0.9).round()));
    }
}

/// Black or white, whichever is more visible on this colour.
pub(super) fn contrast(color: Color) -> Color {
    // The contrast with black equals that with white where (L + 0.05)² = 0.05 · 1.05 (WCAG 2.2); thin lines want a
    // little more.
    if luminance(color) > 0.21 { BLACK } else { PAPER }
}
