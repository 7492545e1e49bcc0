//! From a scene's colours to those of a screen.

use isophote::color::{ColorSpace, Matrix};
use isophote::map::Map;
use isophote::units::Keyword;

/// Shows linear RGB as sRGB (IEC 61966-2-1): scaled, in sRGB's primaries, clipped to what a screen can show, and with
/// sRGB's transfer function.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ColorScale {
    /// The amounts shown as black and white.
    pub(crate) range: [f64; 2],
    to_srgb: Option<Matrix>,
}

/// A screen colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shown {
    /// Encoded red, green and blue from 0 to 1.
    pub(crate) encoded: [f64; 3],
    /// Whether a component was negative, which no screen can show.
    pub(crate) is_below: bool,
    /// Whether a component was above white.
    pub(crate) is_above: bool,
}

/// Rounding error outside of 0 to 1 that is not reported.
const ROUNDING: f64 = 1e-9;

impl ColorScale {
    /// The scale for a map's colours: the given range, or from 0 to the largest visible component; both 0 if all is
    /// dark.
    pub(crate) fn new(map: &Map, colors: &[[f64; 3]], range: Option<[f64; 2]>) -> Self {
        let largest = || map.mask().indices().flat_map(|index| colors[index]).fold(0.0, f64::max);
        let space = map.provenance.color_space.as_deref().and_then(ColorSpace::from_name).unwrap_or_default();
        Self { range: range.unwrap_or_else(|| [0.0, largest()]), to_srgb: space.to_srgb() }
    }

    pub(crate) fn shown(&self, color: [f64; 3]) -> Shown {
        let [black, white] = self.range;
        // In a map without light, 0/0 would give NaN.
        let linear = color.map(|amount| if black < white { (amount - black) / (white - black) } else { 0.0 });
        let linear = self.to_srgb.map_or(linear, |matrix| matrix.apply(linear));
        Shown {
            encoded: linear.map(|amount| transfer(amount.clamp(0.0, 1.0))),
            is_below: linear.iter().any(|amount| *amount < -ROUNDING),
            is_above: linear.iter().any(|amount| *amount > 1.0 + ROUNDING),
        }
    }
}

/// The transfer function of sRGB, from 0 to 1.
fn transfer(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_transfer_function_is_that_of_the_standard() {
        assert_eq!(transfer(0.0), 0.0);
        assert!((transfer(1.0) - 1.0).abs() < 1e-15);
        // The well-known values: half of white is 188 of 255, and 18 % grey is 118 (rounded).
        assert!((255.0 * transfer(0.5) - 187.516).abs() < 1e-3);
        assert!((255.0 * transfer(0.18) - 117.642).abs() < 1e-2, "{}", 255.0 * transfer(0.18));
        assert!((transfer(0.003_130_8) - transfer(0.003_130_800_1)).abs() < 1e-7, "both branches meet");
    }

    #[test]
    fn a_colour_that_srgb_does_not_hold_is_clipped_and_counted() {
        let to_srgb = ColorSpace::Rec2020.to_srgb();
        let scale = ColorScale { range: [0.0, 2.0], to_srgb };
        let green = scale.shown([0.0, 2.0, 0.0]);
        assert_eq!(green, Shown { encoded: [0.0, transfer(1.0), 0.0], is_below: true, is_above: true });
        let white = scale.shown([2.0; 3]);
        assert!(!white.is_above && !white.is_below, "white is white in both");
        let dark = ColorScale { range: [0.0, 0.0], to_srgb };
        assert_eq!(dark.shown([0.0; 3]), Shown { encoded: [0.0; 3], is_below: false, is_above: false });
    }
}
