//! Places the level labels on the isophotes.

use std::collections::HashMap;

use crate::figure::curve::Curve;
use crate::figure::drawing::{Place, Rectangle};
use crate::figure::label_box::LabelBox;

pub(super) const LEVEL_SIZE: f64 = 9.0;
/// Gap in px between a label and the line on either side of it.
const PADDING: f64 = 2.5;
/// Distance in px between the positions tried along a line, and between the samples of lines to avoid.
const STEP: f64 = 4.0;
/// Side in px of the square cells that samples are sorted into.
const SQUARE: f64 = 16.0;
/// Chord-to-arc ratio below which a line bends too much under its label.
const STRAIGHT_ENOUGH: f64 = 0.95;

/// A label on its line, and the part of the line that it replaces.
#[derive(Clone, Copy, Debug)]
pub(super) struct LevelLabel {
    pub(super) room: LabelBox,
    /// The lengths along the curve between which the line is not drawn; on a closed curve `from` may be negative.
    pub(super) from: f64,
    pub(super) to: f64,
}

struct Sample {
    curve: usize,
    length: f64,
    place: Place,
}

/// What labels must stay clear of.
pub(super) struct Surroundings<'figure> {
    curves: &'figure [Curve],
    samples: HashMap<[i32; 2], Vec<Sample>>,
    taken: Vec<LabelBox>,
    inside: Rectangle,
    /// Whether a surface is visible at a point of the page.
    is_surface: &'figure dyn Fn(Place) -> bool,
}

impl<'figure> Surroundings<'figure> {
    pub(super) fn new(
        curves: &'figure [Curve],
        taken: Vec<LabelBox>,
        inside: Rectangle,
        is_surface: &'figure dyn Fn(Place) -> bool,
    ) -> Self {
        let mut samples: HashMap<[i32; 2], Vec<Sample>> = HashMap::new();
        for (curve, line) in curves.iter().enumerate() {
            for (length, place) in line.samples(STEP) {
                samples.entry(square(place)).or_default().push(Sample { curve, length, place });
            }
        }
        Self { curves, samples, taken, inside, is_surface }
    }

    /// A position for a label on each curve, given the labels' widths in px; `None` if a curve has no room for one.
    ///
    /// Short curves choose first because they have the fewest options.
    pub(super) fn place_all(&mut self, widths: &[f64]) -> Vec<Option<LevelLabel>> {
        let mut order: Vec<usize> = (0..self.curves.len()).collect();
        order.sort_by(|&one, &other| self.curves[one].length().total_cmp(&self.curves[other].length()));
        let mut labels = vec![None; self.curves.len()];
        for index in order {
            let label = self.best(index, widths[index]);
            self.taken.extend(label.map(|label| label.room));
            labels[index] = label;
        }
        labels
    }

    fn best(&self, index: usize, width: f64) -> Option<LevelLabel> {
        let curve = &self.curves[index];
        let gap = width + 2.0 * PADDING;
        if curve.length() < 2.5 * gap {
            return None;
        }
        let starts = curve.samples(STEP).map(|(length, _)| length - 0.5 * gap);
        let possible = starts.filter(|start| curve.closed || (*start >= 0.0 && start + gap <= curve.length()));
        let rated = possible.filter_map(|start| {
            let label = label(curve, start, width);
            Some((self.cost(index, &label)?, label))
        });
        rated.min_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, label)| label)
    }

    /// The cost of a position, higher if it is bent, steep, crowded or over the silhouette; `None` if it is impossible.
    fn cost(&self, index: usize, label: &LevelLabel) -> Option<f64> {
        let curve = &self.curves[index];
        let straightness = curve.at(label.from).distance(curve.at(label.to)) / (label.to - label.from);
        let room = label.room.grown(1.0);
        let is_free = straightness >= STRAIGHT_ENOUGH
            && room.lies_in(&self.inside)
            && !self.taken.iter().any(|taken| taken.overlaps(&room))
            && !self.is_crossed(index, label, &room);
        if !is_free {
            return None;
        }
        let wide = room.grown(5.0);
        let is_crowded = self.taken.iter().any(|taken| taken.overlaps(&wide)) || self.is_crossed(index, label, &wide);
        let leaves = !label.room.corners().into_iter().all(self.is_surface);
        let steepness = label.room.turn.abs() / std::f64::consts::FRAC_PI_2;
        Some(20.0 * (1.0 - straightness) + steepness + f64::from(is_crowded) + 3.0 * f64::from(leaves))
    }

    /// Whether a line other than the label's own part crosses the label's box.
    fn is_crossed(&self, index: usize, label: &LevelLabel, room: &LabelBox) -> bool {
        let middle = f64::midpoint(label.from, label.to);
        let own = 0.5 * (label.to - label.from) + room.half[1];
        let reach = room.half[0].hypot(room.half[1]);
        let Place { x, y } = room.center;
        let low = square(Place { x: x - reach, y: y - reach });
        let high = square(Place { x: x + reach, y: y + reach });
        let near = (low[0]..=high[0]).flat_map(|column| (low[1]..=high[1]).map(move |row| [column, row]));
        near.filter_map(|square| self.samples.get(&square)).flatten().any(|sample| {
            let is_own = sample.curve == index && self.curves[index].apart(sample.length, middle) <= own;
            !is_own && room.contains(sample.place)
        })
    }
}

/// A label centred on the part of the curve that begins at `start`, along its chord and never upside down.
fn label(curve: &Curve, start: f64, width: f64) -> LevelLabel {
    let (from, to) = (start, start + width + 2.0 * PADDING);
    let (first, middle, last) = (curve.at(from), curve.at(f64::midpoint(from, to)), curve.at(to));
    let chord = Place { x: f64::midpoint(first.x, last.x), y: f64::midpoint(first.y, last.y) };
    let center = Place { x: f64::midpoint(chord.x, middle.x), y: f64::midpoint(chord.y, middle.y) };
    let direct = (last.y - first.y).atan2(last.x - first.x);
    // Maps the angle to −90°..90°; a vertical line gets −90° (read from below).
    let half_turns = (direct / std::f64::consts::PI + 0.5).floor();
    let turn = direct - half_turns * std::f64::consts::PI;
    LevelLabel { room: LabelBox { center, half: [0.5 * width, 0.45 * LEVEL_SIZE], turn }, from, to }
}

fn square(place: Place) -> [i32; 2] {
    #[expect(clippy::cast_possible_truncation, reason = "places on a page of some thousand px")]
    [place.x, place.y].map(|coordinate| (coordinate / SQUARE).floor() as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: Rectangle = Rectangle { left: 0.0, top: 0.0, width: 400.0, height: 400.0 };

    fn circle(radius: f64) -> Curve {
        let place = |step: u32| {
            let (sine, cosine) = f64::from(step).to_radians().sin_cos();
            Place { x: 200.0 + radius * cosine, y: 200.0 + radius * sine }
        };
        Curve::new((0..360).map(place).collect(), true)
    }

    #[test]
    fn numbers_on_nested_circles_neither_touch_each_other_nor_another_line_nor_stand_on_their_heads() {
        let curves: Vec<Curve> = (2..=13_u32).map(|step| circle(14.0 * f64::from(step))).collect();
        let obstacle = LabelBox { center: Place { x: 200.0, y: 60.0 }, half: [60.0, 60.0], turn: 0.0 };
        let mut surroundings = Surroundings::new(&curves, vec![obstacle], PAGE, &|_| true);
        let labels: Vec<LevelLabel> = surroundings.place_all(&[24.0; 12]).into_iter().flatten().collect();
        assert!(labels.len() >= 10, "{}", labels.len());
        for (index, label) in labels.iter().enumerate() {
            assert!(label.room.turn.abs() <= std::f64::consts::FRAC_PI_2);
            assert!(label.room.lies_in(&PAGE) && !label.room.overlaps(&obstacle));
            assert!(labels[..index].iter().all(|other| !other.room.overlaps(&label.room)));
            // Only its own circle may cross a label.
            let own = curves.iter().position(|curve| {
                let middle = curve.at(f64::midpoint(label.from, label.to));
                middle.distance(label.room.center) < 3.0
            });
            for (other, curve) in curves.iter().enumerate().filter(|(other, _)| Some(*other) != own) {
                assert!(curve.samples(1.0).all(|(_, place)| !label.room.contains(place)), "circle {other}");
            }
        }
    }

    #[test]
    fn a_number_lies_along_its_line_and_never_upside_down() {
        use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
        let (low_left, high_right) = (Place { x: 10.0, y: 300.0 }, Place { x: 300.0, y: 10.0 });
        let high_left = Place { x: 10.0, y: 10.0 };
        // Angles are clockwise: rising to the right is negative, and a vertical line is read from below.
        for (from, to, turn) in [
            (low_left, high_right, -FRAC_PI_4),
            (high_right, low_left, -FRAC_PI_4),
            (low_left, high_left, -FRAC_PI_2),
            (high_left, low_left, -FRAC_PI_2),
            (high_right, high_left, 0.0),
        ] {
            let label = label(&Curve::new(vec![from, to], false), 50.0, 30.0);
            assert!((label.room.turn - turn).abs() < 1e-9, "{from:?} {to:?}");
        }
    }

    #[test]
    fn a_line_without_room_gets_no_number() {
        let short = [circle(8.0)];
        assert!(Surroundings::new(&short, Vec::new(), PAGE, &|_| true).place_all(&[30.0])[0].is_none());
        let crowded: Vec<Curve> = (0..30_u32).map(|step| circle(100.0 + 2.0 * f64::from(step))).collect();
        let labels = Surroundings::new(&crowded, Vec::new(), PAGE, &|_| true).place_all(&[30.0; 30]);
        assert!(labels.iter().all(Option::is_none));
    }
}
