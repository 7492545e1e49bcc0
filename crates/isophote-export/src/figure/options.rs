//! What a map figure shows, and in which words.

use isophote::map::Quantity;

use crate::colormap::Colormap;
use crate::figure::marks::Mark;

/// A map figure to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureOptions {
    /// Above the picture; broken into lines where it is long. None where empty.
    pub title: String,
    /// The channel that is shown: a scalar one, or colours, which have no colour bar and no isophotes.
    pub quantity: Quantity,
    /// What the values are, beside the colour bar: "brightness B, lab (3.3)".
    pub label: String,
    /// Written for the channel's own unit, for figures in another language.
    pub unit: Option<String>,
    /// Written for the name of the window's unit of length, likewise.
    pub length_unit: Option<String>,
    /// Words for pixels without a surface.
    pub no_surface: String,
    /// Width and height of what is shown, in any unit: the proportions of the picture. Those of the window by default.
    pub proportions: Option<[f64; 2]>,
    /// From values to colours.
    pub colormap: Colormap,
    /// Values of the first and the last colour; `None` takes the least and the greatest value seen. Where values lie
    /// beyond an end, the colour bar ends in an arrow.
    pub range: Option<[f64; 2]>,
    /// About how many isophotes; 0 for none.
    pub isophotes: usize,
    /// Places to be marked.
    pub marks: Vec<Mark>,
}

impl FigureOptions {
    /// A plain figure: no title, viridis, the whole range, about eight isophotes, no marks.
    #[must_use]
    pub fn new(quantity: Quantity, label: &str) -> Self {
        Self {
            title: String::new(),
            quantity,
            label: label.into(),
            unit: None,
            length_unit: None,
            no_surface: "no surface".into(),
            proportions: None,
            colormap: Colormap::default(),
            range: None,
            isophotes: 8,
            marks: Vec::new(),
        }
    }
}
