//! Linear RGB colour spaces.

use serde::{Deserialize, Serialize};

use super::Rgb;
use crate::units::Keyword;

/// Which lights the components of a colour are amounts of: a space of linear RGB, by the chromaticities of its primaries
/// and of its white.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ColorSpace {
    /// ITU-R BT.709: the primaries of sRGB, white D65.
    #[default]
    Rec709,
    /// ITU-R BT.2020, white D65.
    Rec2020,
    /// Display P3: the primaries of SMPTE RP 431-2, white D65.
    DisplayP3,
    /// `ACEScg`: the primaries AP1 of SMPTE ST 2065, white about D60.
    AcesCg,
}

/// A point of the CIE 1931 diagram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chromaticity {
    /// X/(X + Y + Z).
    pub x: f64,
    /// Y/(X + Y + Z).
    pub y: f64,
}

impl Keyword for ColorSpace {
    const ALL: &'static [Self] = &[Self::Rec709, Self::Rec2020, Self::DisplayP3, Self::AcesCg];

    fn name(self) -> &'static str {
        match self {
            Self::Rec709 => "rec709",
            Self::Rec2020 => "rec2020",
            Self::DisplayP3 => "display-p3",
            Self::AcesCg => "aces-cg",
        }
    }
}

impl ColorSpace {
    /// The primaries.
    #[must_use]
    pub fn primaries(self) -> Rgb<Chromaticity> {
        let primaries = match self {
            Self::Rec709 => [[0.640, 0.330], [0.300, 0.600], [0.150, 0.060]],
            Self::Rec2020 => [[0.708, 0.292], [0.170, 0.797], [0.131, 0.046]],
            Self::DisplayP3 => [[0.680, 0.320], [0.265, 0.690], [0.150, 0.060]],
            Self::AcesCg => [[0.713, 0.293], [0.165, 0.830], [0.128, 0.044]],
        };
        Rgb::from(primaries.map(|[x, y]| Chromaticity { x, y }))
    }

    /// The colour of equal amounts of all three.
    #[must_use]
    pub fn white(self) -> Chromaticity {
        match self {
            Self::Rec709 | Self::Rec2020 | Self::DisplayP3 => Chromaticity { x: 0.3127, y: 0.3290 },
            Self::AcesCg => Chromaticity { x: 0.32168, y: 0.33767 },
        }
    }

    /// w_R, w_G, w_B of (3.10): the luminances of the primaries that together are a white of luminance 1, the row Y of
    /// the matrix from RGB to CIE XYZ. Their sum is 1.
    #[must_use]
    pub fn luminance_weights(self) -> Rgb {
        Rgb::from(self.to_xyz().0[1])
    }

    /// The luminance as a formula: `0.2126 R + 0.7152 G + 0.0722 B`.
    #[must_use]
    pub fn luminance_text(self) -> String {
        let [red, green, blue] = self.luminance_weights().into_array();
        format!("{red:.4} R + {green:.4} G + {blue:.4} B")
    }

    /// From linear RGB of this space to linear RGB with sRGB's primaries, mapping white to white (Bradford adaptation where
    /// the whites differ); `None` if this space already has those primaries. The amounts may be negative: sRGB does not
    /// contain every colour.
    #[must_use]
    pub fn to_srgb(self) -> Option<Matrix> {
        if self == Self::Rec709 {
            return None;
        }
        let adapted = adaptation(self.white(), Self::Rec709.white()).times(self.to_xyz());
        Some(Self::Rec709.to_xyz().inverse().times(adapted))
    }

    fn to_xyz(self) -> Matrix {
        let [red, green, blue] = self.primaries().into_array().map(Chromaticity::xyz);
        let primaries = Matrix([0, 1, 2].map(|row| [red[row], green[row], blue[row]]));
        let amounts = primaries.inverse().apply(self.white().xyz());
        Matrix(primaries.0.map(|row| [0, 1, 2].map(|column| row[column] * amounts[column])))
    }
}

impl Chromaticity {
    /// X, Y, Z of this colour with Y = 1.
    fn xyz(self) -> [f64; 3] {
        [self.x / self.y, 1.0, (1.0 - self.x - self.y) / self.y]
    }
}

/// The Bradford adaptation: responses of sharpened cones are scaled so that one white becomes the other. (Lam, Bradford
/// 1985; as in the ICC specification, annex E.)
fn adaptation(from: Chromaticity, to: Chromaticity) -> Matrix {
    const CONES: Matrix = Matrix([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]);
    let [before, after] = [from, to].map(|white| CONES.apply(white.xyz()));
    let scaled = Matrix([0, 1, 2].map(|row| CONES.0[row].map(|number| number * after[row] / before[row])));
    CONES.inverse().times(scaled)
}

/// A linear map between colour spaces, as a matrix given by its rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matrix([[f64; 3]; 3]);

impl Matrix {
    /// The amounts in the other space.
    #[must_use]
    pub fn apply(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        self.0.map(|[a, b, c]| a * x + b * y + c * z)
    }

    fn times(self, other: Self) -> Self {
        let columns = [0, 1, 2].map(|column| self.apply(other.0.map(|row| row[column])));
        Self([0, 1, 2].map(|row| columns.map(|column| column[row])))
    }

    /// The inverse, by cofactors.
    fn inverse(self) -> Self {
        let Self(m) = self;
        let minor = |row: usize, column: usize| {
            let [r, s] = [(row + 1) % 3, (row + 2) % 3];
            let [c, d] = [(column + 1) % 3, (column + 2) % 3];
            m[r][c] * m[s][d] - m[r][d] * m[s][c]
        };
        let determinant = (0..3).map(|column| m[0][column] * minor(0, column)).sum::<f64>();
        Self([0, 1, 2].map(|row| [0, 1, 2].map(|column| minor(column, row) / determinant)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The luma coefficients of ITU-R BT.709 and BT.2020, and of ACEScg (TB-2014-004) and Display P3.
    #[test]
    fn luminance_weights_are_the_published_ones() {
        let published = [
            (ColorSpace::Rec709, [0.2126, 0.7152, 0.0722], 5e-5),
            (ColorSpace::Rec2020, [0.2627, 0.6780, 0.0593], 5e-5),
            (ColorSpace::DisplayP3, [0.228_975, 0.691_739, 0.079_287], 1e-6),
            (ColorSpace::AcesCg, [0.272_228_716_8, 0.674_081_765_8, 0.053_689_517_4], 1e-9),
        ];
        assert_eq!(published.len(), ColorSpace::ALL.len());
        for (space, weights, digits) in published {
            let found = space.luminance_weights().into_array();
            for (found, weight) in found.into_iter().zip(weights) {
                assert!((found - weight).abs() <= digits, "{}: {found} {weight}", space.name());
            }
            assert!((found.iter().sum::<f64>() - 1.0).abs() < 1e-15, "{}", space.name());
        }
    }

    #[test]
    fn white_stays_white_on_the_way_to_srgb() {
        assert!(ColorSpace::Rec709.to_srgb().is_none(), "nothing is to be rounded");
        for space in [ColorSpace::Rec2020, ColorSpace::DisplayP3, ColorSpace::AcesCg] {
            let white = space.to_srgb().unwrap().apply([1.0; 3]);
            assert!(white.iter().all(|component| (component - 1.0).abs() < 1e-14), "{}: {white:?}", space.name());
        }
    }

    /// The matrix of ITU-R BT.2087 from BT.2020 to BT.709, to its published digits.
    #[test]
    fn the_way_from_rec2020_to_srgb_is_the_published_one() {
        let Matrix(found) = ColorSpace::Rec2020.to_srgb().unwrap();
        let published = [[1.6605, -0.5876, -0.0728], [-0.1246, 1.1329, -0.0083], [-0.0182, -0.1006, 1.1187]];
        for (found, published) in found.as_flattened().iter().zip(published.as_flattened()) {
            assert!((found - published).abs() <= 6e-5, "{found} {published}");
        }
    }
}
