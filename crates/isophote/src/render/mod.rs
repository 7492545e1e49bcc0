//! From a prepared scene to a map.

pub(crate) mod band;
pub(crate) mod cells;
mod derived;
mod fan_out;
pub(crate) mod hits;
pub(crate) mod layers;
mod packets;
mod points;
mod provenance;
mod rays;
mod reference;
mod rows;
mod sampling;
mod shading;
mod share;
mod simd;
mod tiles;
mod vectors;

use crate::message;
use crate::text::Message;
use std::ops::ControlFlow;

pub use points::{PointKernel, PointValues};
pub use reference::ReferenceRenderer;
pub use simd::SimdRenderer;

use crate::map::{Map, Pixel, Quantity, Region, Resolution};
use crate::prepare::PreparedScene;
use crate::threads::ThreadsError;

/// A renderer of maps. Every renderer passes the same [conformance suite](crate::conformance).
pub trait Renderer {
    /// Its name and precision, as written to outputs.
    fn name(&self) -> String;

    /// Computes the requested channels.
    ///
    /// # Errors
    /// Settings that do not fit the scene, or an interruption.
    fn render(&self, scene: &PreparedScene, settings: &RenderSettings<'_>) -> Result<Map, RenderError>;

    /// Like [`render`](Self::render), but reuses the memory of an earlier map if it fits: rendering many maps of the same
    /// size then skips clearing the background. The earlier map is lost on error.
    ///
    /// # Errors
    /// As for [`render`](Self::render).
    fn render_again(
        &self,
        scene: &PreparedScene,
        settings: &RenderSettings<'_>,
        earlier: Map,
    ) -> Result<Map, RenderError> {
        drop(earlier);
        self.render(scene, settings)
    }
}

/// What to render.
#[derive(Clone, Default)]
pub struct RenderSettings<'o> {
    /// The part of the image to compute; the whole image by default.
    pub region: Option<Region>,
    /// The channels, in the order of the outputs. Duplicates are ignored.
    pub quantities: Vec<Quantity>,
    /// Receives progress reports, and may stop the render.
    pub observer: Option<&'o dyn Observer>,
}

/// Receives the progress of a render. It may be called from several threads.
pub trait Observer: Sync {
    /// This many more pixels are done. `Break` ends the render with [`RenderError::Interrupted`].
    fn advance(&self, pixels: u64) -> ControlFlow<()>;
}

/// Why there is no map.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.message())]
pub enum RenderError {
    /// The region is empty or sticks out of the image.
    Region {
        /// The requested region.
        region: Region,
        /// The size of the image.
        full: Resolution,
    },
    /// The region is too large for one map; smaller regions of the same image can be rendered one after another.
    TooLarge {
        /// The requested size.
        size: Resolution,
    },
    /// The system does not grant the memory that the map needs.
    Memory {
        /// The memory of all channels.
        mebibytes: usize,
    },
    /// A channel for a light that the scene does not have.
    NoSuchLight {
        /// The requested name.
        name: String,
    },
    /// The channel `color` of a scene without colours.
    NoColor,
    /// The channel `sampling-error` of a scene without a tolerance.
    NoTolerance,
    /// Single precision cannot hold a value.
    Overflow {
        /// The pixel.
        pixel: Pixel,
        /// The value.
        value: f64,
    },
    /// The observer stopped it.
    Interrupted,
    /// The threads could not be started.
    #[error(transparent)]
    Threads(#[from] ThreadsError),
}

impl RenderError {
    /// What is wrong, in either language.
    #[must_use]
    pub fn message(&self) -> Message {
        match self {
            Self::Region { region: Region { corner, size }, full } => message!(
                "the region {size} at column {column}, row {row} is not within the image of {full} pixels",
                size = format!("{}×{}", size.width, size.height),
                column = corner.column,
                row = corner.row,
                full = format!("{}×{}", full.width, full.height)
            ),
            Self::TooLarge { size: Resolution { width, height } } => message!(
                "a map of {width}×{height} pixels is too large to be held in memory; allowed: sides up to {longest}, together at most {most} pixels",
                width,
                height,
                longest = Resolution::LONGEST_IN_MEMORY,
                most = Resolution::MOST_IN_MEMORY
            ),
            Self::Memory { mebibytes } => message!(
                "the map needs {mebibytes} MiB of memory, which the system does not grant; fewer channels or a smaller region need less",
                mebibytes
            ),
            Self::NoSuchLight { name } => message!("the scene has no light named \"{name}\"", name),
            Self::NoColor => no_color(),
            Self::NoTolerance => message!(
                "there is no channel `sampling-error`: the scene has no tolerance; allowed with `sampling.tolerance`"
            ),
            Self::Overflow { pixel: Pixel { column, row }, value } => message!(
                "column {column}, row {row}: {value} is more than single precision holds (3.4e38); double does",
                column,
                row,
                value = format!("{value:e}")
            ),
            Self::Interrupted => message!("interrupted"),
            Self::Threads(error) => Message::verbatim(error.to_string()),
        }
    }
}

/// Why there is no channel `color`.
pub(crate) fn no_color() -> Message {
    message!("there is no channel `color`: no coefficient and no strength of the scene is written as [R, G, B]")
}

impl Region {
    /// Whether a pixel of the image lies in it.
    #[must_use]
    pub fn contains(self, pixel: Pixel) -> bool {
        let within = |at: u32, first: u32, count: u32| at >= first && at - first < count;
        within(pixel.column, self.corner.column, self.size.width)
            && within(pixel.row, self.corner.row, self.size.height)
    }

    /// The whole image.
    #[must_use]
    pub fn all(full: Resolution) -> Self {
        Self { corner: Pixel { column: 0, row: 0 }, size: full }
    }
}
