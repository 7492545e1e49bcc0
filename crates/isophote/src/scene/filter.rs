//! Pixel filters.

use serde::{Deserialize, Serialize};

use crate::units::Keyword;

/// The weight of the light around a pixel in its value, as a product of a function of the way across and one of the way
/// down, both in pixels from the centre.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Filter {
    /// 1 over the pixel's own area, what a sensor reads.
    #[default]
    Box,
    /// 1 − |x| up to 1.
    Triangle,
    /// exp(−2x²) − exp(−2·1.5²) up to 1.5: a standard deviation of half a pixel.
    Gaussian,
    /// The cubic of Mitchell and Netravali ("Reconstruction filters in computer graphics", SIGGRAPH 1988) with
    /// B = C = 1/3, up to 2. It is negative beyond about 1.1, so edges ring a little.
    Mitchell,
}

impl Keyword for Filter {
    const ALL: &'static [Self] = &[Self::Box, Self::Triangle, Self::Gaussian, Self::Mitchell];

    fn name(self) -> &'static str {
        match self {
            Self::Box => "box",
            Self::Triangle => "triangle",
            Self::Gaussian => "gaussian",
            Self::Mitchell => "mitchell",
        }
    }
}

impl Filter {
    /// The number of additional pixels in each direction that contribute to a pixel's value.
    #[must_use]
    pub fn reach(self) -> u32 {
        match self {
            Self::Box => 0,
            Self::Triangle | Self::Gaussian => 1,
            Self::Mitchell => 2,
        }
    }

    /// The weight of light at this distance across and down from the centre, in pixels.
    #[must_use]
    pub fn weight(self, across: f64, down: f64) -> f64 {
        self.along(across.abs()) * self.along(down.abs())
    }

    fn along(self, x: f64) -> f64 {
        match self {
            Self::Box => f64::from(u8::from(x <= 0.5)),
            Self::Triangle => (1.0 - x).max(0.0),
            Self::Gaussian => (libm::exp(-2.0 * x * x) - libm::exp(-4.5)).max(0.0),
            Self::Mitchell if x < 1.0 => (7.0 * x * x * x - 12.0 * x * x + 16.0 / 3.0) / 6.0,
            Self::Mitchell if x < 2.0 => (-7.0 / 3.0 * x * x * x + 12.0 * x * x - 20.0 * x + 32.0 / 3.0) / 6.0,
            Self::Mitchell => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Spreading conserves the light: for these three filters, the weights of all pixels add up to 1 at any position; for
    /// the box too, except at its border.
    #[test]
    fn triangle_and_mitchell_weights_of_all_pixels_add_up_to_one() {
        for filter in [Filter::Triangle, Filter::Mitchell] {
            for x in [0.0, 0.1, 0.37, 0.5] {
                let sum: f64 =
                    (-3..=3).map(|pixel| filter.weight(x - f64::from(pixel), 0.0) / filter.weight(0.0, 0.0)).sum();
                assert!((sum * filter.weight(0.0, 0.0).sqrt() - 1.0).abs() < 1e-12, "{filter:?}: {sum}");
            }
        }
    }

    #[test]
    fn beyond_its_reach_a_filter_weighs_nothing() {
        for filter in Filter::ALL {
            assert_eq!(filter.weight(f64::from(filter.reach()) + 0.5 + 1e-9, 0.0), 0.0, "{filter:?}");
            assert!(filter.weight(0.0, 0.0) > 0.0);
        }
    }
}
