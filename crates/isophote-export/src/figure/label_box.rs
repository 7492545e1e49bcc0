//! The area that a text covers on the page, rotated with the text.

use crate::figure::drawing::{Place, Rectangle};

/// A rotated rectangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct LabelBox {
    pub(super) center: Place,
    /// Half its width and half its height in px.
    pub(super) half: [f64; 2],
    /// Clockwise, in radians.
    pub(super) turn: f64,
}

impl LabelBox {
    pub(super) fn grown(self, by: f64) -> Self {
        Self { half: self.half.map(|half| half + by), ..self }
    }

    pub(super) fn contains(&self, place: Place) -> bool {
        let (sine, cosine) = self.turn.sin_cos();
        let (dx, dy) = (place.x - self.center.x, place.y - self.center.y);
        (dx * cosine + dy * sine).abs() <= self.half[0] && (dy * cosine - dx * sine).abs() <= self.half[1]
    }

    pub(super) fn corners(&self) -> [Place; 4] {
        let (sine, cosine) = self.turn.sin_cos();
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(along, across)| {
            let (along, across) = (along * self.half[0], across * self.half[1]);
            Place {
                x: self.center.x + along * cosine - across * sine,
                y: self.center.y + along * sine + across * cosine,
            }
        })
    }

    /// Whether two boxes overlap, that is, none of the four directions of their sides separates them.
    pub(super) fn overlaps(&self, other: &Self) -> bool {
        let directions = [self.turn, other.turn].map(|turn| [turn, turn + std::f64::consts::FRAC_PI_2]);
        directions.as_flattened().iter().all(|direction| {
            let (sine, cosine) = direction.sin_cos();
            let [one, two] = [self, other].map(|label| {
                let along = label.corners().map(|corner| corner.x * cosine + corner.y * sine);
                (along.iter().copied().fold(f64::INFINITY, f64::min), along.iter().copied().fold(f64::MIN, f64::max))
            });
            one.0 < two.1 && two.0 < one.1
        })
    }

    pub(super) fn lies_in(&self, rectangle: &Rectangle) -> bool {
        self.corners().iter().all(|corner| {
            let (right, down) = (corner.x - rectangle.left, corner.y - rectangle.top);
            (0.0..=rectangle.width).contains(&right) && (0.0..=rectangle.height).contains(&down)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_4;

    fn label(x: f64, y: f64, turn: f64) -> LabelBox {
        LabelBox { center: Place { x, y }, half: [10.0, 2.0], turn }
    }

    #[test]
    fn turned_boxes_overlap_only_where_they_share_a_place() {
        let level = label(0.0, 0.0, 0.0);
        assert!(level.overlaps(&label(19.0, 3.0, 0.0)) && !level.overlaps(&label(21.0, 0.0, 0.0)));
        assert!(level.overlaps(&label(0.0, 0.0, FRAC_PI_4)));
        // The axis-aligned bounding boxes of these two would overlap.
        assert!(!label(0.0, 0.0, FRAC_PI_4).overlaps(&label(6.0, -6.0, FRAC_PI_4)));
        assert!(label(0.0, 0.0, FRAC_PI_4).overlaps(&label(6.0, 6.0, FRAC_PI_4)));
    }

    #[test]
    fn a_box_turned_clockwise_reaches_down_on_the_right() {
        let turned = label(0.0, 0.0, FRAC_PI_4);
        assert!(turned.contains(Place { x: 6.5, y: 6.5 }) && !turned.contains(Place { x: 6.5, y: -6.5 }));
        let page = Rectangle { left: -8.6, top: -8.6, width: 17.2, height: 17.2 };
        assert!(turned.lies_in(&page) && !label(0.0, 0.0, 0.0).lies_in(&page));
    }
}
