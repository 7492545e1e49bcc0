//! Colour maps for pictures, from a fraction to an sRGB colour.

use isophote::units::Keyword;

use crate::colormap_tables::{BATLOW, CIVIDIS, INFERNO, TURBO, VIRIDIS};

/// A colour map of 256 entries. The sources and licences of the tables are listed in `tools/colormaps.py`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Colormap {
    /// From black to white in equal sRGB steps.
    Gray,
    /// Perceptually uniform, from dark violet to yellow: the default.
    #[default]
    Viridis,
    /// Perceptually uniform, and nearly the same to people with red-green colour blindness.
    Cividis,
    /// Perceptually uniform, from black through red to pale yellow.
    Inferno,
    /// A rainbow with smooth steps: for finding detail, not for reading amounts (its lightness rises and falls).
    Turbo,
    /// Perceptually uniform, ordered, safe for colour blindness; widely used in the earth sciences.
    Batlow,
}

impl Colormap {
    /// The sRGB colour of a fraction: the table's entry with index round(255·fraction).
    ///
    /// Fractions outside 0..=1 get the colour of the nearer end, and NaN gets that of 0.
    #[must_use]
    pub fn color(self, fraction: f64) -> [u8; 3] {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to 0..=255")]
        let index = (255.0 * fraction.clamp(0.0, 1.0)).round() as u8;
        let table = match self {
            Self::Gray => return [index; 3],
            Self::Viridis => &VIRIDIS,
            Self::Cividis => &CIVIDIS,
            Self::Inferno => &INFERNO,
            Self::Turbo => &TURBO,
            Self::Batlow => &BATLOW,
        };
        let [_, red, green, blue] = table[usize::from(index)].to_be_bytes();
        [red, green, blue]
    }
}

impl Keyword for Colormap {
    const ALL: &'static [Self] = &[Self::Gray, Self::Viridis, Self::Cividis, Self::Inferno, Self::Turbo, Self::Batlow];

    fn name(self) -> &'static str {
        match self {
            Self::Gray => "gray",
            Self::Viridis => "viridis",
            Self::Cividis => "cividis",
            Self::Inferno => "inferno",
            Self::Turbo => "turbo",
            Self::Batlow => "batlow",
        }
    }
}

/// Relative luminance of an sRGB colour, 0 for black to 1 for white (WCAG 2.2, section "relative luminance").
pub(crate) fn luminance(color: [u8; 3]) -> f64 {
    let linear = color.map(|component| {
        let encoded = f64::from(component) / 255.0;
        if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
    });
    0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Published values from the authors' own files: first, middle (index 128) and last entry.
    #[test]
    fn ends_and_middle_are_the_published_colors() {
        let published = [
            (Colormap::Gray, [0, 0, 0], [128, 128, 128], [255, 255, 255]),
            (Colormap::Viridis, [68, 1, 84], [33, 145, 140], [253, 231, 37]),
            (Colormap::Cividis, [0, 34, 78], [125, 124, 120], [254, 232, 56]),
            (Colormap::Inferno, [0, 0, 4], [188, 55, 84], [252, 255, 164]),
            (Colormap::Turbo, [48, 18, 59], [164, 252, 60], [122, 4, 3]),
            (Colormap::Batlow, [1, 25, 89], [130, 130, 49], [250, 204, 250]),
        ];
        assert_eq!(published.len(), Colormap::ALL.len());
        for (map, first, middle, last) in published {
            let name = map.name();
            assert_eq!(map.color(0.0), first, "{name}");
            assert_eq!(map.color(128.0 / 255.0), middle, "{name}");
            assert_eq!(map.color(1.0), last, "{name}");
            assert_eq!(Colormap::from_name(name), Some(map));
        }
    }

    #[test]
    fn the_nearest_entry_is_taken_and_the_ends_hold() {
        assert_eq!(Colormap::Gray.color(0.49 / 255.0), [0; 3]);
        assert_eq!(Colormap::Gray.color(0.51 / 255.0), [1; 3]);
        assert_eq!(Colormap::Viridis.color(-3.0), [68, 1, 84]);
        assert_eq!(Colormap::Viridis.color(f64::INFINITY), [253, 231, 37]);
        assert_eq!(Colormap::Viridis.color(f64::NAN), [68, 1, 84]);
    }

    #[test]
    fn lightness_rises_where_a_map_is_meant_to_be_read_as_an_amount() {
        for map in [Colormap::Gray, Colormap::Viridis, Colormap::Cividis, Colormap::Inferno, Colormap::Batlow] {
            let luminances: Vec<f64> = (0..=255).map(|index| luminance(map.color(f64::from(index) / 255.0))).collect();
            // Rounding to 8 bits may cost half a step: 0.004 is the luminance of one step of green at mid-scale.
            assert!(luminances.windows(2).all(|pair| pair[1] > pair[0] - 0.004), "{}", map.name());
            assert!(luminances.windows(8).all(|run| run[7] > run[0]), "{}", map.name());
        }
        let turbo = |index: i32| luminance(Colormap::Turbo.color(f64::from(index) / 255.0));
        assert!(turbo(255) < turbo(128), "turbo's lightness falls again, as its doc comment warns");
    }
}
