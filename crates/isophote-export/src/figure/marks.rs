//! Probe positions on a map figure.

use crate::figure::drawing::{Anchor, Drawing, INK, PAPER, Place, Stroke, Style, Text};
use crate::figure::error::FigureError;
use crate::figure::frame::Frame;
use crate::figure::label_box::LabelBox;
use crate::figure::text;

const NAME_SIZE: f64 = 10.0;
const RADIUS: f64 = 2.8;
/// Distance in px from the centre of a dot to its name.
const REACH: f64 = 6.5;

/// A named point on the screen, such as that of a probe.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// Shown beside the dot; may be empty.
    pub name: String,
    /// Rightwards, in the unit of the map's window.
    pub x: f64,
    /// Upwards, in the unit of the map's window.
    pub y: f64,
}

/// A mark and the position of its name.
pub(super) struct PlacedMark<'figure> {
    name: &'figure str,
    dot: Place,
    room: LabelBox,
}

/// For each dot, finds a side where its name covers no other dot and no other name.
///
/// # Errors
/// [`FigureError::MarkOutside`] for the first mark outside the frame.
pub(super) fn place<'figure>(frame: &Frame, marks: &'figure [Mark]) -> Result<Vec<PlacedMark<'figure>>, FigureError> {
    let is_inside =
        |mark: &Mark| (frame.x[0]..=frame.x[1]).contains(&mark.x) && (frame.y[0]..=frame.y[1]).contains(&mark.y);
    if let Some(mark) = marks.iter().find(|mark| !is_inside(mark)) {
        return Err(FigureError::MarkOutside { name: mark.name.clone(), x: mark.x, y: mark.y });
    }
    let dots: Vec<Place> = marks.iter().map(|mark| frame.place(mark.x, mark.y)).collect();
    let mut placed: Vec<PlacedMark> = Vec::new();
    for (index, (mark, &dot)) in marks.iter().zip(&dots).enumerate() {
        let others = dots.iter().enumerate().filter(|(other, _)| *other != index).map(|(_, &dot)| dot_room(dot));
        let taken: Vec<LabelBox> = others.chain(placed.iter().map(|other| other.room)).collect();
        let rooms = name_rooms(dot, text::width(&mark.name, NAME_SIZE));
        let is_free =
            |room: &&LabelBox| room.lies_in(&frame.rectangle) && !taken.iter().any(|box_| box_.overlaps(room));
        let in_frame = |room: &&LabelBox| room.lies_in(&frame.rectangle);
        let room = rooms.iter().find(is_free).or_else(|| rooms.iter().find(in_frame)).unwrap_or(&rooms[0]);
        placed.push(PlacedMark { name: &mark.name, dot, room: *room });
    }
    Ok(placed)
}

impl PlacedMark<'_> {
    /// The areas that other texts must avoid: the dot and the name.
    pub(super) fn rooms(&self) -> [LabelBox; 2] {
        [dot_room(self.dot), self.room]
    }

    pub(super) fn draw(&self, drawing: &mut Drawing) {
        drawing.circle(self.dot, RADIUS, Style::filled(PAPER).with_outline(Stroke::new(INK, 1.2)));
        if self.name.is_empty() {
            return;
        }
        let plain = Text::new(self.name, self.room.center, NAME_SIZE, Anchor::Middle);
        drawing.text(Text { halo: Some(PAPER), ..plain });
    }
}

fn dot_room(dot: Place) -> LabelBox {
    LabelBox { center: dot, half: [RADIUS + 1.5; 2], turn: 0.0 }
}

/// The sides of a dot, best first: upper right, upper left, lower right, lower left, right, left, above, below.
fn name_rooms(dot: Place, width: f64) -> [LabelBox; 8] {
    let half = [0.5 * width + 1.5, 0.5 * NAME_SIZE + 1.0];
    let (near, beside) = (0.6 * REACH, REACH + half[0]);
    let above = REACH + 0.5 * half[1];
    [
        (near + half[0], -above),
        (-near - half[0], -above),
        (near + half[0], above),
        (-near - half[0], above),
        (beside, 0.0),
        (-beside, 0.0),
        (0.0, -REACH - half[1]),
        (0.0, REACH + half[1]),
    ]
    .map(|(dx, dy)| LabelBox { center: Place { x: dot.x + dx, y: dot.y + dy }, half, turn: 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::drawing::Rectangle;

    fn frame() -> Frame {
        let rectangle = Rectangle { left: 50.0, top: 30.0, width: 300.0, height: 300.0 };
        Frame { rectangle, x: [-1.0, 1.0], y: [-1.0, 1.0] }
    }

    fn mark(name: &str, x: f64, y: f64) -> Mark {
        Mark { name: name.into(), x, y }
    }

    #[test]
    fn names_stay_in_the_frame_and_hide_neither_dots_nor_names() {
        let marks = [
            mark("top right corner", 0.99, 0.98),
            mark("P1", 0.0, 0.0),
            mark("P2", 0.05, 0.03),
            mark("P3", 0.02, -0.05),
            mark("левый край", -1.0, 0.0),
        ];
        let placed = place(&frame(), &marks).unwrap();
        for (index, one) in placed.iter().enumerate() {
            assert!(one.room.lies_in(&frame().rectangle), "{}", one.name);
            for other in placed.iter().skip(index + 1) {
                assert!(!one.room.overlaps(&other.room), "{} {}", one.name, other.name);
                assert!(!one.room.overlaps(&dot_room(other.dot)) && !other.room.overlaps(&dot_room(one.dot)));
            }
        }
    }

    #[test]
    fn a_dot_stands_where_its_coordinates_say() {
        let marks = [mark("P", 0.5, 0.5)];
        assert_eq!(place(&frame(), &marks).unwrap()[0].dot, Place { x: 275.0, y: 105.0 });
    }

    #[test]
    fn a_mark_outside_the_window_is_refused_by_name() {
        for (x, y) in [(1.01, 0.0), (0.0, -2.0), (f64::NAN, 0.0)] {
            let marks = [mark("inside", 0.0, 0.0), mark("lost", x, y)];
            let Err(FigureError::MarkOutside { name, .. }) = place(&frame(), &marks) else { panic!("{x} {y}") };
            assert_eq!(name, "lost");
        }
    }
}
