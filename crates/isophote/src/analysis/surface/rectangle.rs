//! The two sides of a rectangle.

use super::chart::ChartPoint;
use crate::shape::Rectangle;
use crate::vector::Vector;

/// x along the width and y along the height, from the middle.
#[derive(Clone, Debug)]
pub(super) struct RectangleChart {
    center: Vector,
    axes: [Vector; 3],
    sides: [f64; 2],
}

impl RectangleChart {
    pub(super) fn new(rectangle: &Rectangle) -> Self {
        Self { center: rectangle.center(), axes: rectangle.axes(), sides: rectangle.sides() }
    }

    pub(super) fn ranges(&self) -> [[f64; 2]; 2] {
        self.sides.map(|side| [-0.5 * side, 0.5 * side])
    }

    pub(super) fn point(&self, [x, y]: [f64; 2]) -> ChartPoint {
        let [along_width, along_height, normal] = self.axes;
        ChartPoint { anchor: self.center, offset: along_width * x + along_height * y, normal }
    }
}
