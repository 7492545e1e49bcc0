//! Isophotes on a map figure: thin lines labelled with their level.

use isophote::analysis::isophotes::Isophote;

use crate::figure::color_bar::contrast;
use crate::figure::curve::Curve;
use crate::figure::drawing::{Anchor, Color, Drawing, Place, Rectangle, Stroke, Style, Text};
use crate::figure::frame::Frame;
use crate::figure::label_box::LabelBox;
use crate::figure::level_labels::{LEVEL_SIZE, LevelLabel, Surroundings};
use crate::figure::raster::Scale;
use crate::figure::text;
use crate::figure::ticks::written;

/// Points closer together than this in px are left out of a line: the difference is invisible, and files stay small.
const FINEST: f64 = 0.4;
/// Open pieces shorter than this in px are not drawn: along a limb, the pixel steps cut steep contours into such
/// fragments.
const SHORTEST_PIECE: f64 = 6.0;
/// Space in px between a label and the frame.
const RIM: f64 = 3.0;

/// Draws all isophotes. Labels stay clear of `taken`, and where possible of areas without a surface; like those of the
/// colour bar, their numbers are divided by 10^exponent.
pub(super) fn draw(
    drawing: &mut Drawing,
    frame: &Frame,
    isophotes: &[Isophote],
    scale: Scale,
    exponent: i32,
    taken: Vec<LabelBox>,
    is_surface: &dyn Fn(Place) -> bool,
) {
    let levels: Vec<f64> = isophotes.iter().map(|isophote| isophote.level).collect();
    let numbers = written(&levels, exponent);
    let mut curves = Vec::new();
    let mut owners = Vec::new();
    for (owner, isophote) in isophotes.iter().enumerate() {
        for line in &isophote.lines {
            let places = line.points.iter().map(|point| frame.place(point.x, point.y)).collect();
            let curve = Curve::new(places, line.closed);
            if line.closed || curve.length() >= SHORTEST_PIECE {
                curves.push(curve);
                owners.push(owner);
            }
        }
    }
    let widths: Vec<f64> = owners.iter().map(|&owner| text::width(&numbers[owner], LEVEL_SIZE)).collect();
    let Rectangle { left, top, width, height } = frame.rectangle;
    let inside = Rectangle { left: left + RIM, top: top + RIM, width: width - 2.0 * RIM, height: height - 2.0 * RIM };
    let labels = Surroundings::new(&curves, taken, inside, is_surface).place_all(&widths);
    for ((curve, label), &owner) in curves.iter().zip(&labels).zip(&owners) {
        draw_line(drawing, curve, label.as_ref(), scale.color(levels[owner]));
    }
    for (label, &owner) in labels.iter().zip(&owners) {
        if let Some(label) = label {
            draw_number(drawing, &numbers[owner], label, scale.color(levels[owner]));
        }
    }
}

/// The colour map's colour at the level is the background of the line, which is drawn in black or white to contrast
/// with it.
fn draw_line(drawing: &mut Drawing, curve: &Curve, label: Option<&LevelLabel>, ground: Color) {
    let style = Style::line(Stroke { opacity: 0.85, ..Stroke::new(contrast(ground), 0.8).round() });
    let total = curve.length();
    match label {
        None => drawing.path(&thinned(&curve.piece(0.0, total)), false, style),
        Some(label) if curve.closed => {
            drawing.path(&thinned(&curve.piece(label.to, label.from + total)), false, style);
        }
        Some(label) => {
            drawing.path(&thinned(&curve.piece(0.0, label.from)), false, style);
            drawing.path(&thinned(&curve.piece(label.to, total)), false, style);
        }
    }
}

fn draw_number(drawing: &mut Drawing, number: &str, label: &LevelLabel, ground: Color) {
    let plain = Text::new(number, label.room.center, LEVEL_SIZE, Anchor::Middle);
    let degrees = label.room.turn.to_degrees();
    drawing.text(Text { degrees, color: contrast(ground), halo: Some(ground), ..plain });
}

fn thinned(places: &[Place]) -> Vec<Place> {
    let mut thinned: Vec<Place> = Vec::with_capacity(places.len());
    for (index, &place) in places.iter().enumerate() {
        let is_end = index + 1 == places.len();
        if is_end || thinned.last().is_none_or(|last| last.distance(place) >= FINEST) {
            thinned.push(place);
        }
    }
    thinned
}
