//! What a map figure shows, and its texts.

use isophote::map::Quantity;
use isophote::message;
use isophote::text::Language;

use crate::colormap::Colormap;
use crate::figure::marks::Mark;

/// A map figure to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureOptions {
    /// Above the picture; broken into lines if it is long. No title if empty.
    pub title: String,
    /// The channel to show: a scalar one, or colours, which get neither a colour bar nor isophotes.
    pub quantity: Quantity,
    /// What the values are, shown beside the colour bar: "brightness B, lab (3.3)".
    pub label: String,
    /// The language of the names of axes.
    pub language: Language,
    /// Replaces the channel's own unit, for figures in another language.
    pub unit: Option<String>,
    /// Replaces the name of the window's unit of length, for figures in another language.
    pub length_unit: Option<String>,
    /// Text for pixels without a surface.
    pub no_surface: String,
    /// Width and height of what is shown, in any unit, which set the picture's proportions. By default those of the
    /// window.
    pub proportions: Option<[f64; 2]>,
    /// The colour map.
    pub colormap: Colormap,
    /// Values of the first and the last colour; `None` uses the minimum and maximum seen. If there are values beyond an
    /// end, the colour bar ends in an arrow.
    pub range: Option<[f64; 2]>,
    /// About how many isophotes; 0 for none.
    pub isophotes: usize,
    /// The positions to mark.
    pub marks: Vec<Mark>,
}

impl FigureOptions {
    /// A plain figure: no title, viridis, the full range, about eight isophotes, no marks.
    #[must_use]
    pub fn new(quantity: Quantity, label: &str) -> Self {
        Self::in_language(quantity, label, Language::English)
    }

    /// The same, with its words in a language; the label is in it already.
    #[must_use]
    pub fn in_language(quantity: Quantity, label: &str, language: Language) -> Self {
        Self {
            title: String::new(),
            quantity,
            label: label.into(),
            language,
            unit: None,
            length_unit: None,
            no_surface: message!("no surface").in_language(language),
            proportions: None,
            colormap: Colormap::default(),
            range: None,
            isophotes: 8,
            marks: Vec::new(),
        }
    }
}
