//! Flux, mean and extremes over a surface.

use super::Surface;
use crate::map::{Map, Pixel, Quantity};
use crate::sum::Sum;

/// The totals of a channel over a surface, with each cell weighted by its exact area.
///
/// The integral uses the midpoint rule: its error falls with the square of the cells' sides where the channel is continuous,
/// as at a terminator, and in proportion to their sides at the edge of a shadow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceTotals {
    /// The area of the cells that have a value, in m².
    pub area: f64,
    /// ∫ x dA over these cells, in the channel's unit times m²: for the irradiance, this is the flux in W or lm.
    pub integral: f64,
    /// The largest value; the first in reading order if several are equal.
    pub max: CellExtreme,
    /// The smallest value, likewise.
    pub min: CellExtreme,
}

/// An extreme value and its cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellExtreme {
    /// The value, in the channel's unit.
    pub value: f64,
    /// The cell.
    pub cell: Pixel,
}

impl SurfaceTotals {
    /// ∫ x dA / ∫ dA, in the channel's unit.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.integral / self.area
    }
}

impl Surface<'_> {
    /// The totals of a scalar channel of this surface's map; `None` if the map has no such channel, or no cell has a value.
    #[must_use]
    pub fn totals(&self, map: &Map, quantity: &Quantity) -> Option<SurfaceTotals> {
        let values = map.scalar(quantity)?;
        let (mut area, mut integral) = (Sum::<f64>::new(), Sum::<f64>::new());
        let mut extremes: Option<[CellExtreme; 2]> = None;
        for index in map.mask().indices() {
            let (cell, value) = (map.pixel(index), values.at(index));
            let cell_area = self.cell_area(cell);
            area.add(cell_area);
            integral.add(value * cell_area);
            let here = CellExtreme { value, cell };
            let [max, min] = extremes.get_or_insert([here; 2]);
            if value > max.value {
                *max = here;
            }
            if value < min.value {
                *min = here;
            }
        }
        let [max, min] = extremes?;
        Some(SurfaceTotals { area: area.value(), integral: integral.value(), max, min })
    }
}
