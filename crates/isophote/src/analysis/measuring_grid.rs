//! Grids of points on a plane, as used for measurements and calculations in lighting.

use crate::analysis::cells::{self, Layout};
use crate::map::{Coordinates, Map, Pixel, Quantity, Resolution, Window};
use crate::message;
use crate::prepare::PreparedScene;
use crate::render::cells::Cells;
use crate::render::{Observer, RenderError};
use crate::scene::Grid;
use crate::shape::SurfacePoint;
use crate::text::Message;
use crate::vector::Vector;

/// Why there is no map of a grid.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.message())]
pub enum GridError {
    /// At the position of a point light the irradiance is unbounded.
    LightAtPoint {
        /// The light.
        light: String,
        /// The grid.
        grid: String,
        /// The point.
        cell: Pixel,
    },
    /// A channel that needs a surface.
    NoSuchChannel {
        /// The channel.
        name: String,
    },
    /// A channel for a light that the scene does not have.
    NoSuchLight {
        /// The requested name.
        name: String,
    },
    /// The observer asked to stop.
    Interrupted,
}

impl GridError {
    /// What is wrong, in either language.
    #[must_use]
    pub fn message(&self) -> Message {
        match self {
            Self::LightAtPoint { light, grid, cell: Pixel { column, row } } => message!(
                "the light \"{light}\" stands at the point in column {column}, row {row} of the grid \"{grid}\"; move one of them",
                light,
                column,
                row,
                grid
            ),
            Self::NoSuchChannel { name } => message!(
                "a grid has no channel `{name}`; allowed: irradiance, ambient, position, normal, light.NAME",
                name
            ),
            Self::NoSuchLight { name } => message!("the scene has no light named \"{name}\"", name),
            Self::Interrupted => message!("interrupted"),
        }
    }
}

impl PreparedScene {
    /// The irradiance (3.1), (3.9) at each point of a grid, with the scene's shadows. A point is at the centre of its cell;
    /// row 0 is the farthest along v, column 0 the nearest along u.
    ///
    /// # Errors
    /// A light at one of the points, or a channel that grids do not have.
    pub fn grid(&self, grid: &Grid, quantities: &[Quantity]) -> Result<Map, GridError> {
        self.grid_observed(grid, quantities, None)
    }

    /// As [`grid`](Self::grid), with an observer, which hears of points and may end the work.
    ///
    /// # Errors
    /// Those of [`grid`](Self::grid), or the observer's wish to end.
    pub fn grid_observed(
        &self,
        grid: &Grid,
        quantities: &[Quantity],
        observer: Option<&dyn Observer>,
    ) -> Result<Map, GridError> {
        let is_known = |quantity: &Quantity| {
            let is_place = matches!(quantity, Quantity::Position | Quantity::Normal);
            is_place || matches!(quantity, Quantity::Irradiance | Quantity::Ambient | Quantity::Light(_))
        };
        if let Some(quantity) = quantities.iter().find(|quantity| !is_known(quantity)) {
            return Err(GridError::NoSuchChannel { name: quantity.name() });
        }
        for light in self.scene().lights() {
            if let Some(cell) = light.position().and_then(|position| grid.point_at(position)) {
                return Err(GridError::LightAtPoint { light: light.name.clone(), grid: grid.name.clone(), cell });
            }
        }
        let length = self.scene().length();
        let edge = |edge: Vector| [0.0, length.from_metres(edge.length())];
        let layout = Layout {
            size: grid.points,
            window: Window { x: edge(grid.u), y: edge(grid.v), length, coordinates: Coordinates::Grid },
            renderer: format!("grid {}, double", grid.name),
            shape: 0,
        };
        let cells = Cells::Free(&|cell| Some(grid.surface_point(cell)));
        let map = cells::map(self, layout, quantities, observer, &cells);
        map.map_err(|error| match error {
            RenderError::Interrupted => GridError::Interrupted,
            RenderError::NoSuchLight { name } => GridError::NoSuchLight { name },
            error => unreachable!("a grid is a map of known size: {error}"),
        })
    }
}

impl Grid {
    /// The unit normal on the lit side.
    #[must_use]
    pub fn normal(&self) -> Vector {
        self.u.cross(self.v).normalized() * self.side.sign()
    }

    /// The point of a cell, in metres.
    #[must_use]
    pub fn point(&self, cell: Pixel) -> Vector {
        self.corner + self.offset(cell)
    }

    /// The coordinates of a point along the edges, in metres.
    #[must_use]
    pub fn coordinates(&self, cell: Pixel) -> [f64; 2] {
        let [along_u, along_v] = self.parts(cell);
        [self.u.length() * along_u, self.v.length() * along_v]
    }

    fn parts(&self, cell: Pixel) -> [f64; 2] {
        let Resolution { width, height } = self.points;
        let part = |index: u32, count: u32| (f64::from(index) + 0.5) / f64::from(count);
        [part(cell.column, width), part(height - 1 - cell.row, height)]
    }

    fn offset(&self, cell: Pixel) -> Vector {
        let [along_u, along_v] = self.parts(cell);
        self.u * along_u + self.v * along_v
    }

    fn surface_point(&self, cell: Pixel) -> SurfacePoint {
        let normal = self.normal();
        SurfacePoint { anchor: self.corner, offset: self.offset(cell), normal, view: normal, cos_theta_o: 1.0 }
    }

    /// The grid point at a position, within a billionth of the grid's size.
    fn point_at(&self, place: Vector) -> Option<Pixel> {
        let from_corner = place - self.corner;
        let Resolution { width, height } = self.points;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the grid")]
        let index = |edge: Vector, count: u32| {
            let part = from_corner.dot(edge) / edge.dot(edge);
            (part * f64::from(count)).floor().clamp(0.0, f64::from(count - 1)) as u32
        };
        let nearest = Pixel { column: index(self.u, width), row: height - 1 - index(self.v, height) };
        let distance = (from_corner - self.offset(nearest)).length();
        (distance <= 1e-9 * (self.u + self.v).length()).then_some(nearest)
    }
}

#[cfg(test)]
mod tests;
