//! What can be wrong with a figure.

use isophote::analysis::isophotes::IsophoteError;
use isophote::message;
use isophote::text::Message;

/// Why a figure could not be drawn.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.message())]
pub enum FigureError {
    /// The map lacks the channel, or the channel is not scalar.
    Channel(#[from] IsophoteError),
    /// No pixel shows a surface, so the colour bar has no ends.
    NothingSeen,
    /// A value to be drawn is infinite or not a number.
    NotFinite {
        /// The channel, or the series with the index of the value.
        name: String,
        /// The value.
        value: f64,
    },
    /// The ends of the colour bar are reversed, equal or not finite.
    Range {
        /// The lower end as given.
        low: f64,
        /// The upper end as given.
        high: f64,
    },
    /// A mark lies outside the picture.
    MarkOutside {
        /// The mark's name.
        name: String,
        /// Its requested x, in the window's unit.
        x: f64,
        /// Its requested y, in the window's unit.
        y: f64,
    },
    /// A section has fewer than two positions, or none where a surface is seen.
    EmptySection {
        /// What is missing.
        what: Message,
    },
    /// The PNG would have no pixels, or more than 16384 along a side.
    PictureSize {
        /// The scale as given.
        scale: f64,
        /// Width in pixels.
        width: f64,
        /// Height in pixels.
        height: f64,
    },
    /// The PNG encoder failed.
    Png(String),
}

impl FigureError {
    /// What is wrong, in either language.
    #[must_use]
    pub fn message(&self) -> Message {
        match self {
            Self::Channel(error) => error.message(),
            Self::NothingSeen => {
                message!("no surface is seen in the map, so its values have no range of their own; give one")
            }
            Self::NotFinite { name, value } => {
                message!("{name} is {value}, which has no place in a figure", name, value)
            }
            Self::Range { low, high } => {
                message!("`range` is {low}..{high}: its ends must be finite, the lower one first", low, high)
            }
            Self::MarkOutside { name, x, y } => {
                message!("mark `{name}` at x = {x}, y = {y} lies outside the map's window", name, x, y)
            }
            Self::EmptySection { what } => {
                message!("the section has {what}, so there is no line to draw", what)
            }
            Self::PictureSize { scale, width, height } => message!(
                "at `scale` {scale} the picture is {width} × {height} pixels; 1 to 16384 a side are possible",
                scale,
                width,
                height
            ),
            Self::Png(reason) => message!("could not write the picture as PNG: {reason}", reason),
        }
    }
}
