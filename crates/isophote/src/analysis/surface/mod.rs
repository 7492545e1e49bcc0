//! Maps over a shape's own surface: the distribution of light over a sphere, for example, independent of any camera.

mod chart;
mod cylinder;
mod disk;
mod rectangle;
mod sphere;
#[cfg(test)]
mod tests;
mod totals;

use crate::analysis::cells::{self, Layout};
use crate::camera::{Sight, between};
use crate::map::{Map, Pixel, Quantity, Resolution, Window};
use crate::message;
use crate::prepare::{Hit, PreparedScene};
use crate::render::cells::Cells;
use crate::render::{Observer, RenderError};
use crate::shape::{Primitive, Side, SurfacePoint};
use crate::text::Message;
use crate::units::Keyword;
use crate::vector::Vector;
use chart::{Chart, ChartPoint};
pub use totals::{CellExtreme, SurfaceTotals};

/// Which surface, and how it is cut into cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceRequest {
    /// The primitive that has the surface.
    pub primitive: Primitive,
    /// How the surface is divided into equal cells.
    pub projection: SurfaceProjection,
    /// The direction in which the latitude of a sphere is 90°, of any nonzero length; +y by default.
    pub axis: Option<Vector>,
    /// The side to compute.
    pub side: Side,
    /// Columns and rows; by default 360 columns, and as many rows as make the cells roughly square.
    pub size: Option<Resolution>,
}

/// How a surface is divided into equal cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SurfaceProjection {
    /// Equal steps of latitude or radius: coordinates that are easy to read.
    #[default]
    Equirectangular,
    /// Equal areas: rows are steps of the sine of the latitude, or of the square of the radius.
    EqualArea,
}

impl Keyword for SurfaceProjection {
    const ALL: &'static [Self] = &[Self::Equirectangular, Self::EqualArea];

    fn name(self) -> &'static str {
        match self {
            Self::Equirectangular => "equirectangular",
            Self::EqualArea => "equal-area",
        }
    }
}

/// Why there is no map of a surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.message())]
pub enum SurfaceError {
    /// A shape whose surface has no coordinates.
    NoCoordinates {
        /// The kind of the shape.
        kind: &'static str,
    },
    /// There is no such shape, or it has no such part.
    NoSuchPart {
        /// The requested part.
        part: u32,
        /// The number of parts.
        parts: u32,
    },
    /// Only spheres allow an axis to be chosen.
    AxisOfItsOwn {
        /// The kind of the shape.
        kind: &'static str,
    },
    /// No cells, or too many.
    Size {
        /// The requested size.
        size: Resolution,
    },
    /// A channel that exists only for a camera's rays.
    ChannelOfCamera {
        /// The channel.
        name: String,
    },
    /// The channel `color` of a scene without colours.
    NoColor,
    /// A channel for a light that the scene does not have.
    NoSuchLight {
        /// The requested name.
        name: String,
    },
    /// The observer asked to stop.
    Interrupted,
}

impl SurfaceError {
    /// What is wrong, in either language.
    #[must_use]
    pub fn message(&self) -> Message {
        match self {
            Self::NoCoordinates { kind } => message!(
                "the surface of a {kind} has no coordinates; allowed: a sphere, a rectangle, a disk, a cylinder",
                kind
            ),
            Self::NoSuchPart { part, parts } => {
                message!("there is no part {part}: the shape has {parts}, counted from 0", part, parts)
            }
            Self::AxisOfItsOwn { kind } => {
                message!("an axis is chosen for a sphere only: a {kind} has its own", kind)
            }
            Self::Size { size: Resolution { width, height } } => message!(
                "a map of {width}×{height} cells cannot be held in memory; allowed: sides of 1 to {longest}, together at most {most} cells",
                width,
                height,
                longest = Resolution::LONGEST_IN_MEMORY,
                most = Resolution::MOST_IN_MEMORY
            ),
            Self::ChannelOfCamera { name } => {
                message!("a surface has no channel `{name}`: it belongs to a camera's map", name)
            }
            Self::NoColor => crate::render::no_color(),
            Self::NoSuchLight { name } => message!("the scene has no light named \"{name}\"", name),
            Self::Interrupted => message!("interrupted"),
        }
    }
}

/// A surface divided into cells, each with an exactly known area.
#[derive(Debug)]
pub struct Surface<'s> {
    scene: &'s PreparedScene,
    request: SurfaceRequest,
    chart: Chart,
    size: Resolution,
}

impl PreparedScene {
    /// Divides a surface into cells.
    ///
    /// # Errors
    /// A shape without coordinates, a part that does not exist, an axis where none can be chosen, or a size out of bounds.
    pub fn surface(&self, request: &SurfaceRequest) -> Result<Surface<'_>, SurfaceError> {
        let Primitive { shape, part } = request.primitive;
        let geometry = self.scene().shapes().get(shape).map(|shape| &shape.geometry);
        let parts = geometry.map_or(0, crate::shape::Geometry::parts);
        let geometry = geometry.filter(|_| part < parts).ok_or(SurfaceError::NoSuchPart { part, parts })?;
        let chart = Chart::new(geometry, part, request.projection, request.axis)?;
        let size = request.size.unwrap_or_else(|| default_size(&chart));
        if size.pixels() == 0 || !size.fits_memory() {
            return Err(SurfaceError::Size { size });
        }
        Ok(Surface { scene: self, request: *request, chart, size })
    }
}

/// The number of columns if no size is given.
const DEFAULT_COLUMNS: u32 = 360;

fn default_size(chart: &Chart) -> Resolution {
    let [width, height] = chart.proportions();
    let rows = (f64::from(DEFAULT_COLUMNS) * height / width).round().clamp(2.0, 4.0 * f64::from(DEFAULT_COLUMNS));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    let height = rows as u32;
    Resolution { width: DEFAULT_COLUMNS, height }
}

impl Surface<'_> {
    /// The values at the centres of the cells, in double precision: row 0 has the greatest latitude or height, column 0 the
    /// least longitude or angle, −180°.
    ///
    /// The irradiance and the contributions of single lights are those of (3.1) and (3.9), with the scene's shadows.
    /// Brightness and its two parts are what the scene's eye would see if nothing were in the way: if one of them is
    /// requested, cells that face away from the eye (θ_o ≥ 90°) are left out.
    ///
    /// # Errors
    /// A channel of a camera, of a light that does not exist, or of colours in a scene without colours.
    pub fn map(&self, quantities: &[Quantity]) -> Result<Map, SurfaceError> {
        self.map_observed(quantities, None)
    }

    /// As [`map`](Self::map), with an observer, which hears of cells and may end the work.
    ///
    /// # Errors
    /// Those of [`map`](Self::map), or the observer's wish to end.
    pub fn map_observed(&self, quantities: &[Quantity], observer: Option<&dyn Observer>) -> Result<Map, SurfaceError> {
        let of_camera = |quantity: &&Quantity| {
            quantity.is_derived() || **quantity == Quantity::Depth || Quantity::OF_SAMPLING.contains(quantity)
        };
        if let Some(quantity) = quantities.iter().find(of_camera) {
            return Err(SurfaceError::ChannelOfCamera { name: quantity.name() });
        }
        if quantities.contains(&Quantity::Color) && self.scene.components().is_none() {
            return Err(SurfaceError::NoColor);
        }
        let needs_eye = quantities.iter().any(depends_on_eye);
        let layout = Layout {
            size: self.size,
            window: self.window(),
            renderer: self.description(),
            shape: self.request.primitive.shape,
        };
        let cells = Cells::OnShapes(&|cell| {
            let hit = self.hit(cell);
            (!needs_eye || hit.point.cos_theta_o > 0.0).then_some(hit)
        });
        let map = cells::map(self.scene, layout, quantities, observer, &cells);
        map.map_err(|error| match error {
            RenderError::Interrupted => SurfaceError::Interrupted,
            RenderError::NoSuchLight { name } => SurfaceError::NoSuchLight { name },
            error => unreachable!("a surface is a map of known size: {error}"),
        })
    }

    /// The number of columns and rows.
    #[must_use]
    pub fn size(&self) -> Resolution {
        self.size
    }

    /// Width and height of the map as unrolled from its shape, in metres.
    #[must_use]
    pub fn proportions(&self) -> [f64; 2] {
        self.chart.proportions()
    }

    /// The area that the map covers, in m².
    #[must_use]
    pub fn area(&self) -> f64 {
        let [x, y] = self.chart.ranges();
        self.chart.area(x, y)
    }

    /// What belongs to the shape but not to the map.
    #[must_use]
    pub fn left_out(&self) -> Option<&'static str> {
        self.chart.left_out()
    }

    /// The direction in which the latitude of a sphere is 90°, a unit vector.
    #[must_use]
    pub fn axis(&self) -> Option<Vector> {
        self.chart.axis_of_sphere()
    }

    /// The coordinates of a cell's centre, in the units of the map's window.
    #[must_use]
    pub fn coordinates(&self, cell: Pixel) -> [f64; 2] {
        let Window { x, y, .. } = self.window();
        [centre(x, cell.column, self.size.width), centre([y[1], y[0]], cell.row, self.size.height)]
    }

    /// The centre of a cell, in metres.
    #[must_use]
    pub fn point(&self, cell: Pixel) -> Vector {
        let ChartPoint { anchor, offset, .. } = self.chart_point(cell);
        anchor + offset
    }

    /// The exact area of a cell, in m².
    #[must_use]
    pub fn cell_area(&self, cell: Pixel) -> f64 {
        let [x, y] = self.chart.ranges();
        let edge =
            |[first, last]: [f64; 2], index: u32, count: u32| between(first, last, f64::from(index) - 0.5, count);
        let Resolution { width, height } = self.size;
        let (left, right) = (edge(x, cell.column, width), edge(x, cell.column + 1, width));
        let (top, bottom) = (edge([y[1], y[0]], cell.row, height), edge([y[1], y[0]], cell.row + 1, height));
        self.chart.area([left, right], [bottom, top])
    }

    fn chart_point(&self, cell: Pixel) -> ChartPoint {
        let [x, y] = self.chart.ranges();
        let Resolution { width, height } = self.size;
        self.chart.point([centre(x, cell.column, width), centre([y[1], y[0]], cell.row, height)])
    }

    /// The centre of a cell as a hit from the requested side.
    pub(super) fn hit(&self, cell: Pixel) -> Hit {
        let ChartPoint { anchor, offset, normal } = self.chart_point(cell);
        let normal = normal * self.request.side.sign();
        let Sight { view, distance, .. } = self.scene.frame().sight(anchor, offset);
        let point = SurfacePoint { anchor, offset, normal, view, cos_theta_o: normal.dot(view) };
        let geometry = &self.scene.scene().shapes()[self.request.primitive.shape].geometry;
        let from_inside = geometry.is_closed() && self.request.side == Side::Back;
        Hit { primitive: self.request.primitive, distance, point, from_inside, shadow_ray_offset: Vector::default() }
    }

    fn window(&self) -> Window {
        let length = self.scene.scene().length();
        let coordinates = self.chart.coordinates();
        let units = coordinates.axes(length).map(|axis| axis.unit);
        let [x, y] = self.chart.ranges();
        let in_unit = |edges: [f64; 2], unit: &str| {
            if unit == length.name() { edges.map(|metres| length.from_metres(metres)) } else { edges }
        };
        Window { x: in_unit(x, units[0]), y: in_unit(y, units[1]), length, coordinates }
    }

    fn description(&self) -> String {
        let name = self.scene.scene().name_of(self.request.primitive);
        let axis = self.axis().map_or(String::new(), |axis| {
            let [x, y, z] = axis.to_array().map(|component| crate::text::significant(component, 6));
            format!(", axis ({x}, {y}, {z})")
        });
        let (side, projection) = (self.request.side.name(), self.request.projection.name());
        format!("surface of {name}, {side}, {projection}{axis}, double")
    }
}

/// Whether a quantity depends on what an eye sees.
#[must_use]
pub fn depends_on_eye(quantity: &Quantity) -> bool {
    matches!(quantity, Quantity::Brightness | Quantity::Color | Quantity::Diffuse | Quantity::Specular)
}

fn centre([first, last]: [f64; 2], index: u32, count: u32) -> f64 {
    between(first, last, f64::from(index), count)
}
