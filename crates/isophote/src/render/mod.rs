//! From a prepared scene to a map.

pub(crate) mod band;
mod fan_out;
pub(crate) mod hits;
pub(crate) mod layers;
mod points;
mod rays;
mod reference;
mod rows;
mod sampling;
mod shading;
mod share;
mod simd;
mod tiles;

use std::ops::ControlFlow;

pub use points::{PointKernel, PointValues};
pub use reference::ReferenceRenderer;
pub use simd::SimdRenderer;

use crate::map::{Map, Pixel, Quantity, Region, Resolution};
use crate::prepare::PreparedScene;
use crate::threads::ThreadsError;

/// Something that computes maps. Every renderer passes the one [conformance suite](crate::conformance).
pub trait Renderer {
    /// Its name and precision, as outputs carry them.
    fn name(&self) -> String;

    /// Computes the channels that the settings ask for.
    ///
    /// # Errors
    /// Settings that do not fit the scene, or an interruption.
    fn render(&self, scene: &PreparedScene, settings: &RenderSettings<'_>) -> Result<Map, RenderError>;

    /// The same, in the memory of an earlier map where that fits: who renders many maps of a size spares the clearing of
    /// their background. After an error the earlier map is gone.
    ///
    /// # Errors
    /// As [`render`](Self::render).
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
    /// The part of the image to compute; all of it by default.
    pub region: Option<Region>,
    /// The channels, in the order of the outputs. Duplicates count once.
    pub quantities: Vec<Quantity>,
    /// Hears of the progress and may stop it.
    pub observer: Option<&'o dyn Observer>,
}

/// Hears how a render gets on. It may be called from several threads.
pub trait Observer: Sync {
    /// So many more pixels are done. `Break` ends the render with [`RenderError::Interrupted`].
    fn advance(&self, pixels: u64) -> ControlFlow<()>;
}

/// Why there is no map.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RenderError {
    /// The region is empty or sticks out of the image.
    #[error("the region {}×{} at column {}, row {} is not within the image of {}×{} pixels",
        region.size.width, region.size.height, region.corner.column, region.corner.row, full.width, full.height)]
    Region {
        /// What was asked for.
        region: Region,
        /// The image.
        full: Resolution,
    },
    /// The region is too large for one map; smaller regions of the same image can be rendered one after another.
    #[error("a map of {}×{} pixels is too large to be held in memory; allowed: sides up to {}, together at most {} pixels",
        size.width, size.height, Resolution::LONGEST_IN_MEMORY, Resolution::MOST_IN_MEMORY)]
    TooLarge {
        /// What was asked for.
        size: Resolution,
    },
    /// A channel of a light that the scene does not have.
    #[error("the scene has no light named \"{name}\"")]
    NoSuchLight {
        /// What was asked for.
        name: String,
    },
    /// The channel `color` of a scene that has none.
    #[error("{}", NO_COLOR)]
    NoColor,
    /// Single precision cannot hold a value.
    #[error("column {}, row {}: {value:e} is more than single precision holds (3.4e38); double does", pixel.column, pixel.row)]
    Overflow {
        /// Where.
        pixel: Pixel,
        /// The value.
        value: f64,
    },
    /// The observer stopped it.
    #[error("interrupted")]
    Interrupted,
    /// The threads could not be started.
    #[error(transparent)]
    Threads(#[from] ThreadsError),
}

/// Why there is no channel `color`.
pub(crate) const NO_COLOR: &str =
    "there is no channel `color`: no coefficient and no strength of the scene is written as [R, G, B]";

impl Region {
    /// The whole image.
    #[must_use]
    pub fn all(full: Resolution) -> Self {
        Self { corner: Pixel { column: 0, row: 0 }, size: full }
    }
}
