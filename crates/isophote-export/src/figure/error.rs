//! What can be wrong with a figure.

use isophote::analysis::isophotes::IsophoteError;

/// Why a figure could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// The map lacks the channel, or the channel is not scalar.
    #[error(transparent)]
    Channel(#[from] IsophoteError),
    /// No pixel shows a surface, so the colour bar has no ends.
    #[error("no surface is seen in the map, so its values have no range of their own; give one")]
    NothingSeen,
    /// A value to be drawn is infinite or not a number.
    #[error("{name} is {value}, which has no place in a figure")]
    NotFinite {
        /// The channel, or the series with the index of the value.
        name: String,
        /// The value.
        value: f64,
    },
    /// The ends of the colour bar are reversed, equal or not finite.
    #[error("`range` is {low}..{high}: its ends must be finite, the lower one first")]
    Range {
        /// The lower end as given.
        low: f64,
        /// The upper end as given.
        high: f64,
    },
    /// A mark lies outside the picture.
    #[error("mark `{name}` at x = {x}, y = {y} lies outside the map's window")]
    MarkOutside {
        /// The mark's name.
        name: String,
        /// Its requested x, in the window's unit.
        x: f64,
        /// Its requested y, in the window's unit.
        y: f64,
    },
    /// A section has fewer than two positions, or none where a surface is seen.
    #[error("the section has {what}, so there is no line to draw")]
    EmptySection {
        /// What is missing.
        what: &'static str,
    },
    /// The PNG would have no pixels, or more than 16384 along a side.
    #[error("at `scale` {scale} the picture is {width} × {height} pixels; 1 to 16384 a side are possible")]
    PictureSize {
        /// The scale as given.
        scale: f64,
        /// Width in pixels.
        width: f64,
        /// Height in pixels.
        height: f64,
    },
    /// The PNG encoder failed.
    #[error("could not write the picture as PNG: {0}")]
    Png(String),
}
