//! What a picture shows, and the report on how it was made.

use isophote::map::Quantity;
use isophote::units::Keyword;

/// What a picture shows and how.
#[derive(Clone)]
pub struct PictureOptions<'a> {
    /// The channel: a scalar one, or colours.
    pub quantity: Quantity,
    /// The values of black and white in the channel's unit; by default those of the normalization.
    pub range: Option<[f64; 2]>,
    /// How values become levels.
    pub normalization: Normalization,
    /// 1 is proportional, 2.2 brightens dark parts; must be finite and above 0.
    pub gamma: f64,
    /// Bits per sample.
    pub depth: Depth,
    /// A colour map instead of grey levels; 8 bits only.
    pub color: Option<PictureColor<'a>>,
}

impl PictureOptions<'_> {
    /// Eight bits of grey, proportional to the channel, with its greatest value white.
    #[must_use]
    pub fn new(quantity: Quantity) -> Self {
        Self { quantity, range: None, normalization: Normalization::Max, gamma: 1.0, depth: Depth::Eight, color: None }
    }
}

/// How values become levels from black, 0, to white, 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Normalization {
    /// Proportional: v/max.
    #[default]
    Max,
    /// Stretched: (v − min)/(max − min), for the least and the greatest visible value.
    MinMax,
    /// Logarithmic: ln(v/black)/ln(white/black), by default over [three decades](Self::DECADES) up to the greatest value.
    Log,
}

impl Normalization {
    /// The greatest value over that of black in a logarithmic picture without a range.
    pub const DECADES: f64 = 1000.0;

    /// The level of a value, between 0 and 1. In a map without light, where white is not above black, 0.
    #[must_use]
    pub fn level(self, value: f64, [black, white]: [f64; 2]) -> f64 {
        if black >= white {
            return 0.0;
        }
        match self {
            Self::Max | Self::MinMax => ((value - black) / (white - black)).clamp(0.0, 1.0),
            Self::Log if value <= black => 0.0,
            Self::Log => (libm::log(value / black) / libm::log(white / black)).clamp(0.0, 1.0),
        }
    }
}

impl Keyword for Normalization {
    const ALL: &'static [Self] = &[Self::Max, Self::MinMax, Self::Log];

    fn name(self) -> &'static str {
        match self {
            Self::Max => "max",
            Self::MinMax => "minmax",
            Self::Log => "log",
        }
    }
}

/// A named colour map.
#[derive(Clone, Copy)]
pub struct PictureColor<'a> {
    /// The name to record in the file's description.
    pub name: &'a str,
    /// The sRGB colour for a number from 0 to 1.
    pub color: &'a dyn Fn(f64) -> [u8; 3],
}

/// Bits per sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// 0 to 255.
    Eight,
    /// 0 to 65535.
    Sixteen,
}

impl Depth {
    /// 8 or 16.
    #[must_use]
    pub fn bits(self) -> u8 {
        match self {
            Self::Eight => 8,
            Self::Sixteen => 16,
        }
    }
}

/// How the values were mapped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureReport {
    /// The values of black and white in the channel's unit; both are 0 where no visible value is positive.
    pub range: [f64; 2],
    /// Visible pixels below black, shown as black.
    pub clamped_below: usize,
    /// Visible pixels above white, shown as white.
    pub clamped_above: usize,
}
