//! Angle and height on the lateral surface of a cylinder.

use super::chart::{ChartPoint, around, meridians};
use crate::shape::Cylinder;
use crate::vector::Vector;

/// The angle about the axis, and the height above the first end.
#[derive(Clone, Debug)]
pub(super) struct CylinderChart {
    from: Vector,
    axis: Vector,
    height: f64,
    radius: f64,
    meridians: [Vector; 2],
}

impl CylinderChart {
    pub(super) fn new(cylinder: &Cylinder) -> Self {
        let [from, to] = cylinder.ends();
        let height = (to - from).length();
        let axis = (to - from) * (1.0 / height);
        Self { from, axis, height, radius: cylinder.radius(), meridians: meridians(axis) }
    }

    pub(super) fn height(&self) -> f64 {
        self.height
    }

    pub(super) fn proportions(&self) -> [f64; 2] {
        [std::f64::consts::TAU * self.radius, self.height]
    }

    pub(super) fn point(&self, [angle, height]: [f64; 2]) -> ChartPoint {
        let normal = around(self.meridians, angle);
        ChartPoint { anchor: self.from, offset: self.axis * height + normal * self.radius, normal }
    }

    pub(super) fn area(&self, [first, last]: [f64; 2], [low, high]: [f64; 2]) -> f64 {
        self.radius * (last - first).to_radians() * (high - low)
    }
}
