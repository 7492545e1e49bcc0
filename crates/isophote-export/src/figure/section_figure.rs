//! Values along a line as a figure.

use isophote::message;

use crate::figure::drawing::{Anchor, BLACK, Color, Drawing, Figure, Place, Rectangle, Stroke, Style, Text};
use crate::figure::error::FigureError;
use crate::figure::frame::{Axis, Frame, TICK_SIZE};
use crate::figure::page::{MARGIN, Page};
use crate::figure::text;
use crate::figure::ticks::{self, Ticks};

const WIDTH: f64 = 520.0;
const HEIGHT: f64 = 300.0;
const LEGEND_SIZE: f64 = 10.0;
const LEGEND_LINE: f64 = 17.0;
/// Length in px of a line sample in the legend, and the gap after it.
const SAMPLE: [f64; 2] = [24.0, 6.0];
const LEGEND_GAP: f64 = 20.0;

/// M. Okabe and K. Ito, "Color universal design", 2008: seven colours that people with colour blindness can
/// distinguish.
const COLORS: [Color; 7] = [
    [0x00, 0x72, 0xb2],
    [0xd5, 0x5e, 0x00],
    [0x00, 0x9e, 0x73],
    [0xcc, 0x79, 0xa7],
    [0x56, 0xb4, 0xe9],
    [0xe6, 0x9f, 0x00],
    BLACK,
];
/// One per round of the colours, so that 28 series are distinct.
const DASHES: [&[f64]; 4] = [&[], &[6.0, 3.0], &[2.0, 2.5], &[8.0, 3.0, 2.0, 3.0]];

/// One line of a section figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Shown in the legend if there are several series.
    pub name: String,
    /// In the order in which they are connected.
    pub points: Vec<SectionPoint>,
}

/// A value at a position along the section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionPoint {
    /// The position along the section, in the options' `x_unit`.
    pub x: f64,
    /// The value in the options' `y_unit`; `None` if no surface is seen, which interrupts the line.
    pub value: Option<f64>,
}

/// The texts of a section figure.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SectionOptions {
    /// Above the figure; broken into lines if it is long. No title if empty.
    pub title: String,
    /// The quantity on the horizontal axis: "x".
    pub x_label: String,
    /// Its unit.
    pub x_unit: String,
    /// The quantity on the vertical axis: "brightness B, lab (3.3)".
    pub y_label: String,
    /// Their unit.
    pub y_unit: String,
    /// The small line at the bottom: program and version, as in a map's provenance.
    pub footer: String,
}

/// Series of values along a line as a figure: axes with units, a light grid, gaps where nothing is seen, and a
/// legend above the plot if there are several series.
///
/// The vertical axis starts at 0 if that costs little space.
///
/// # Errors
/// [`FigureError`]: a number is not finite, there are fewer than two positions, or there is no value at all.
pub fn section_figure(series: &[Series], options: &SectionOptions) -> Result<Figure, FigureError> {
    let [x_range, y_range] = ranges(series)?;
    let x_ticks = Ticks::side_by_side(x_range, WIDTH, TICK_SIZE);
    let y_ticks = Ticks::stacked(y_range, HEIGHT);
    let x = Axis { title: ticks::title(&options.x_label, &options.x_unit, x_ticks.exponent), ticks: x_ticks };
    let y = Axis { title: ticks::title(&options.y_label, &options.y_unit, y_ticks.exponent), ticks: y_ticks };
    // The last label below the plot extends beyond its right edge.
    let right = 0.5 * text::widest(&x.ticks.labels, TICK_SIZE) + 2.0;
    let width = 2.0 * MARGIN + y.width() + WIDTH + right;
    let page = Page::new(width, &options.title, &options.footer);
    let left = MARGIN + y.width();
    let legend = legend(series, left);
    let legend_height = legend.last().map_or(0.0, |entry| entry.y + LEGEND_LINE);
    let top = page.top() + legend_height.max(0.5 * TICK_SIZE);
    let rectangle = Rectangle { left, top, width: WIDTH, height: HEIGHT };
    let frame = Frame { rectangle, x: x_range, y: y_range };
    let bottom = frame.bottom() + Axis::height();

    let mut drawing = Drawing::default();
    frame.draw_grid(&mut drawing, &x, &y);
    for (index, line) in series.iter().enumerate() {
        draw_series(&mut drawing, &frame, &line.points, index);
    }
    frame.draw_axes(&mut drawing, &x, &y);
    for (index, (entry, line)) in legend.iter().zip(series).enumerate() {
        let y = page.top() + entry.y + 0.4 * LEGEND_LINE;
        let sample = [Place { x: entry.x, y }, Place { x: entry.x + SAMPLE[0], y }];
        drawing.path(&sample, false, line_style(index));
        let at = Place { x: entry.x + SAMPLE[0] + SAMPLE[1], y };
        drawing.text(Text::new(&line.name, at, LEGEND_SIZE, Anchor::Start));
    }
    page.draw(&mut drawing, left + 0.5 * WIDTH, bottom);
    Ok(drawing.finish(width, page.height(bottom)))
}

/// The ranges of both axes.
fn ranges(series: &[Series]) -> Result<[[f64; 2]; 2], FigureError> {
    let (mut x, mut y) = ([f64::INFINITY, f64::NEG_INFINITY], [f64::INFINITY, f64::NEG_INFINITY]);
    for line in series {
        for (index, point) in line.points.iter().enumerate() {
            for (number, range) in [(Some(point.x), &mut x), (point.value, &mut y)] {
                let Some(value) = number else { continue };
                if !value.is_finite() {
                    return Err(FigureError::NotFinite { name: format!("{}[{index}]", line.name), value });
                }
                *range = [range[0].min(value), range[1].max(value)];
            }
        }
    }
    if x[0] >= x[1] {
        return Err(FigureError::EmptySection { what: message!("no two places") });
    }
    if y[0] > y[1] {
        return Err(FigureError::EmptySection { what: message!("no value") });
    }
    Ok([x, padded(y)])
}

/// Adds some space above and below the values, and starts at 0 if they come close to it.
fn padded([low, high]: [f64; 2]) -> [f64; 2] {
    let span = high - low;
    if span <= 1e-12 * high.abs().max(low.abs()) {
        let half = if high == 0.0 { 1.0 } else { 0.5 * high.abs() };
        return [low - half, high + half];
    }
    let foot = if low >= 0.0 && low < 0.3 * high { 0.0 } else { low - 0.05 * span };
    [foot, high + 0.05 * span]
}

/// Draws each unbroken run as a line, and a value with gaps on both sides as a dot.
fn draw_series(drawing: &mut Drawing, frame: &Frame, points: &[SectionPoint], index: usize) {
    for run in points.split(|point| point.value.is_none()) {
        let places: Vec<Place> = run.iter().filter_map(|point| Some(frame.place(point.x, point.value?))).collect();
        match places[..] {
            [] => {}
            [alone] => drawing.circle(alone, 1.6, Style::filled(COLORS[index % COLORS.len()])),
            _ => drawing.path(&places, false, line_style(index)),
        }
    }
}

fn line_style(index: usize) -> Style {
    let dashes = DASHES[index / COLORS.len() % DASHES.len()];
    Style::line(Stroke { dashes, ..Stroke::new(COLORS[index % COLORS.len()], 1.5).round() })
}

/// Positions of the legend's entries, `y` measured from its top; empty for a single series.
fn legend(series: &[Series], left: f64) -> Vec<Place> {
    if series.len() < 2 {
        return Vec::new();
    }
    let mut next = Place { x: left, y: 0.0 };
    let mut places = Vec::new();
    for line in series {
        let width = SAMPLE[0] + SAMPLE[1] + text::width(&line.name, LEGEND_SIZE);
        if next.x > left && next.x + width > left + WIDTH {
            next = Place { x: left, y: next.y + LEGEND_LINE };
        }
        places.push(next);
        next.x += width + LEGEND_GAP;
    }
    places
}

#[cfg(test)]
mod tests;
