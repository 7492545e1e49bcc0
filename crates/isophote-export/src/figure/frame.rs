//! The box around a plot, with its axes.

use crate::figure::drawing::{Anchor, Drawing, INK, Place, Rectangle, Stroke, Style, Text};
use crate::figure::text;
use crate::figure::ticks::Ticks;

pub(super) const TICK_SIZE: f64 = 10.0;
pub(super) const TITLE_SIZE: f64 = 11.5;
pub(super) const TICK_LENGTH: f64 = 4.0;
pub(super) const TICK_STYLE: Style = Style::line(Stroke::new(INK, 0.8));
pub(super) const NUMBER_GAP: f64 = 3.0;
pub(super) const AXIS_TITLE_GAP: f64 = 8.0;

/// Maps values to positions on the page.
pub(super) struct Frame {
    pub(super) rectangle: Rectangle,
    /// Values at the left and right edges.
    pub(super) x: [f64; 2],
    /// Values at the lower and upper edges.
    pub(super) y: [f64; 2],
}

/// Ticks and title along an edge.
pub(super) struct Axis {
    pub(super) ticks: Ticks,
    pub(super) title: String,
}

impl Axis {
    /// Height in px of a horizontal axis, below its edge.
    pub(super) fn height() -> f64 {
        TICK_LENGTH + NUMBER_GAP + TICK_SIZE + AXIS_TITLE_GAP + TITLE_SIZE
    }

    /// Width in px of a vertical axis, left of its edge.
    pub(super) fn width(&self) -> f64 {
        let numbers = text::widest(&self.ticks.labels, TICK_SIZE);
        TICK_LENGTH + NUMBER_GAP + numbers + AXIS_TITLE_GAP + TITLE_SIZE
    }
}

impl Frame {
    pub(super) fn right(&self) -> f64 {
        self.rectangle.left + self.rectangle.width
    }

    pub(super) fn bottom(&self) -> f64 {
        self.rectangle.top + self.rectangle.height
    }

    pub(super) fn place(&self, x: f64, y: f64) -> Place {
        let Rectangle { left, top, width, height } = self.rectangle;
        Place {
            x: left + (x - self.x[0]) / (self.x[1] - self.x[0]) * width,
            y: top + (self.y[1] - y) / (self.y[1] - self.y[0]) * height,
        }
    }

    /// Light lines at the ticks, drawn below everything else.
    pub(super) fn draw_grid(&self, drawing: &mut Drawing, x: &Axis, y: &Axis) {
        const STYLE: Style = Style::line(Stroke::new([0xe4; 3], 0.8));
        for &value in &x.ticks.values {
            let at = self.place(value, self.y[0]).x;
            let (top, bottom) = (self.rectangle.top, self.bottom());
            drawing.path(&[Place { x: at, y: top }, Place { x: at, y: bottom }], false, STYLE);
        }
        for &value in &y.ticks.values {
            let at = self.place(self.x[0], value).y;
            let (left, right) = (self.rectangle.left, self.right());
            drawing.path(&[Place { x: left, y: at }, Place { x: right, y: at }], false, STYLE);
        }
    }

    /// The box, its ticks and labels, and the titles of both axes.
    pub(super) fn draw_axes(&self, drawing: &mut Drawing, x: &Axis, y: &Axis) {
        self.draw_horizontal(drawing, x);
        self.draw_vertical(drawing, y);
        drawing.rectangle(self.rectangle, Style::line(Stroke::new(INK, 0.9)));
    }

    fn draw_horizontal(&self, drawing: &mut Drawing, axis: &Axis) {
        let bottom = self.bottom();
        let numbers = bottom + TICK_LENGTH + NUMBER_GAP + 0.5 * TICK_SIZE;
        for (&value, label) in axis.ticks.values.iter().zip(&axis.ticks.labels) {
            let x = self.place(value, self.y[0]).x;
            drawing.path(&[Place { x, y: bottom }, Place { x, y: bottom + TICK_LENGTH }], false, TICK_STYLE);
            drawing.text(Text::new(label, Place { x, y: numbers }, TICK_SIZE, Anchor::Middle));
        }
        let middle = self.rectangle.left + 0.5 * self.rectangle.width;
        let at = Place { x: middle, y: bottom + Axis::height() - 0.5 * TITLE_SIZE };
        drawing.text(Text::new(&axis.title, at, TITLE_SIZE, Anchor::Middle));
    }

    fn draw_vertical(&self, drawing: &mut Drawing, axis: &Axis) {
        let left = self.rectangle.left;
        for (&value, label) in axis.ticks.values.iter().zip(&axis.ticks.labels) {
            let y = self.place(self.x[0], value).y;
            drawing.path(&[Place { x: left - TICK_LENGTH, y }, Place { x: left, y }], false, TICK_STYLE);
            let at = Place { x: left - TICK_LENGTH - NUMBER_GAP, y };
            drawing.text(Text::new(label, at, TICK_SIZE, Anchor::End));
        }
        let middle = self.rectangle.top + 0.5 * self.rectangle.height;
        let at = Place { x: left - axis.width() + 0.5 * TITLE_SIZE, y: middle };
        drawing.text(Text { degrees: -90.0, ..Text::new(&axis.title, at, TITLE_SIZE, Anchor::Middle) });
    }
}
