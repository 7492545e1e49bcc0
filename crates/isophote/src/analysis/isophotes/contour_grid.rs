//! The grid of pixel centres that contours are drawn on, and the segments inside its cells.

use super::ScreenPoint;
use crate::map::{Map, Scalars};

/// A scalar channel with its mask. The edge from pixel `index` to its right neighbour has the number 2·index, the one to its
/// lower neighbour 2·index + 1.
pub(super) struct ContourGrid<'map> {
    map: &'map Map,
    values: Scalars<'map>,
    width: usize,
    height: usize,
}

/// A piece of contour through one cell, from edge to edge, with the higher values on its left.
pub(super) struct Segment {
    pub(super) start: usize,
    pub(super) end: usize,
}

impl<'map> ContourGrid<'map> {
    pub(super) fn new(map: &'map Map, values: Scalars<'map>) -> Self {
        let size = map.region.size;
        Self { map, values, width: size.width as usize, height: size.height as usize }
    }

    /// The segments of all cells, row by row.
    pub(super) fn segments(&self, level: f64) -> Vec<Segment> {
        let shapes = self.map.mask().shapes();
        let mut segments = Vec::new();
        for row in 1..self.height {
            for column in 1..self.width {
                let corner = (row - 1) * self.width + column - 1;
                // Clockwise from the top left.
                let corners = [corner, corner + 1, corner + self.width + 1, corner + self.width];
                let shape = shapes[corner];
                if shape >= 0 && corners.iter().all(|&pixel| shapes[pixel] == shape) {
                    self.push_cell(corners, level, &mut segments);
                }
            }
        }
        segments
    }

    fn push_cell(&self, corners: [usize; 4], level: f64, segments: &mut Vec<Segment>) {
        let values = corners.map(|pixel| self.values.at(pixel));
        let above = values.map(|value| value >= level);
        // Clockwise, edge k precedes corner k: left, top, right, bottom.
        let edges = [2 * corners[0] + 1, 2 * corners[0], 2 * corners[1] + 1, 2 * corners[3]];
        // Clockwise, a run of higher corners begins at `rise` and ends before `fall`: the segment goes round the run.
        let rises = |k: usize| above[k] && !above[(k + 3) % 4];
        let falls = |k: usize| !above[k] && above[(k + 3) % 4];
        let is_saddle = above[0] == above[2] && above[1] == above[3] && above[0] != above[1];
        let joined = is_saddle && saddle_value(values) >= level;
        for rise in (0..4).filter(|&k| rises(k)) {
            let mut after = (rise + 1..rise + 4).map(|k| k % 4).filter(|&k| falls(k));
            // If the two higher corners of a saddle are joined, segments go round the lower ones instead.
            let fall = if joined { after.next_back() } else { after.next() };
            segments.extend(fall.map(|fall| Segment { start: edges[rise], end: edges[fall] }));
        }
    }

    /// Where the contour crosses an edge: linear between the two centres, and the same for both cells that share the edge.
    pub(super) fn crossing(&self, edge: usize, level: f64) -> ScreenPoint {
        let (pixel, downwards) = (edge / 2, edge % 2 == 1);
        let neighbour = if downwards { pixel + self.width } else { pixel + 1 };
        let (from, to) = (self.values.at(pixel), self.values.at(neighbour));
        let fraction = (level - from) / (to - from);
        let (along_row, along_column) = if downwards { (0.0, fraction) } else { (fraction, 0.0) };
        #[expect(clippy::cast_precision_loss, reason = "image sizes are far below 2^53")]
        let (column, row) = ((pixel % self.width) as f64 + along_row, (pixel / self.width) as f64 + along_column);
        #[expect(clippy::cast_precision_loss, reason = "image sizes are far below 2^53")]
        let (columns, rows) = (self.width as f64, self.height as f64);
        let window = &self.map.window;
        ScreenPoint {
            x: window.x[0] + (column + 0.5) * (window.x[1] - window.x[0]) / columns,
            y: window.y[1] - (row + 0.5) * (window.y[1] - window.y[0]) / rows,
        }
    }
}

/// Value of the bilinear interpolant at its saddle point, from the corners in cyclic order.
fn saddle_value([a, b, c, d]: [f64; 4]) -> f64 {
    (a * c - b * d) / (a + c - b - d)
}
