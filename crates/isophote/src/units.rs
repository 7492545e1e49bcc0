//! Units: every number that leaves the program carries one.

use serde::{Deserialize, Serialize};

/// A closed set of words that a scene file may use for one key.
pub trait Keyword: Copy + 'static {
    /// Every member, in the order in which error messages list them.
    const ALL: &'static [Self];

    /// The word that stands in scene files and outputs.
    fn name(self) -> &'static str;

    /// The member with this name.
    fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|choice| choice.name() == name)
    }
}

/// The unit of every length in a scene file and in every output. Inside the program lengths are in metres.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, schemars::JsonSchema)]
pub enum LengthUnit {
    /// Millimetre.
    #[serde(rename = "mm")]
    Millimetre,
    /// Centimetre.
    #[serde(rename = "cm")]
    Centimetre,
    /// Metre.
    #[serde(rename = "m")]
    Metre,
}

impl Keyword for LengthUnit {
    const ALL: &'static [Self] = &[Self::Millimetre, Self::Centimetre, Self::Metre];

    fn name(self) -> &'static str {
        match self {
            Self::Millimetre => "mm",
            Self::Centimetre => "cm",
            Self::Metre => "m",
        }
    }
}

impl LengthUnit {
    /// How many of this unit make a metre: 1000, 100 or 1. Exact in binary, unlike its inverse.
    #[must_use]
    pub fn per_metre(self) -> f64 {
        match self {
            Self::Millimetre => 1000.0,
            Self::Centimetre => 100.0,
            Self::Metre => 1.0,
        }
    }

    /// A length in this unit, in metres (correctly rounded).
    #[must_use]
    pub fn to_metres(self, length: f64) -> f64 {
        length / self.per_metre()
    }

    /// A length in metres, in this unit (correctly rounded).
    #[must_use]
    pub fn from_metres(self, metres: f64) -> f64 {
        metres * self.per_metre()
    }
}

/// The unit of screen coordinates, which are metres or degrees internally.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ScreenUnit {
    /// For a planar screen.
    Length(LengthUnit),
    /// For a camera whose screen coordinates are angles.
    Degree,
}

impl ScreenUnit {
    /// Degrees, or this unit of length.
    #[must_use]
    pub fn of(length: LengthUnit, in_degrees: bool) -> Self {
        if in_degrees { Self::Degree } else { Self::Length(length) }
    }

    /// Its name in outputs: `m` or `°`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Length(length) => length.name(),
            Self::Degree => "°",
        }
    }

    /// Converts metres or degrees to this unit.
    #[must_use]
    pub fn from_internal(self, coordinate: f64) -> f64 {
        match self {
            Self::Length(length) => length.from_metres(coordinate),
            Self::Degree => coordinate,
        }
    }

    /// Converts a coordinate in this unit to metres or degrees.
    #[must_use]
    pub fn to_internal(self, coordinate: f64) -> f64 {
        match self {
            Self::Length(length) => length.to_metres(coordinate),
            Self::Degree => coordinate,
        }
    }
}

/// Whether the lights of a scene are given in watts or in lumens. A scene is one or the other as a whole:
/// converting needs a luminous efficacy, and there is no silent default for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum UnitSystem {
    /// W, W/sr, W/m², W/(m²·sr).
    Radiometric,
    /// lm, cd, lx, cd/m².
    Photometric,
}

impl Keyword for UnitSystem {
    const ALL: &'static [Self] = &[Self::Radiometric, Self::Photometric];

    fn name(self) -> &'static str {
        match self {
            Self::Radiometric => "radiometric",
            Self::Photometric => "photometric",
        }
    }
}

impl UnitSystem {
    /// Unit of a light's power: W or lm.
    #[must_use]
    pub fn power_unit(self) -> &'static str {
        match self {
            Self::Radiometric => "W",
            Self::Photometric => "lm",
        }
    }

    /// Unit of a light's intensity: W/sr or cd.
    #[must_use]
    pub fn intensity_unit(self) -> &'static str {
        match self {
            Self::Radiometric => "W/sr",
            Self::Photometric => "cd",
        }
    }

    /// Unit of irradiance or illuminance: W/m² or lx.
    #[must_use]
    pub fn irradiance_unit(self) -> &'static str {
        match self {
            Self::Radiometric => "W/m²",
            Self::Photometric => "lx",
        }
    }

    /// Unit of radiance or luminance: W/(m²·sr) or cd/m².
    #[must_use]
    pub fn radiance_unit(self) -> &'static str {
        match self {
            Self::Radiometric => "W/(m²·sr)",
            Self::Photometric => "cd/m²",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_length_survives_the_way_to_metres_and_back() {
        for unit in LengthUnit::ALL {
            for tenths in 0..100_000_u32 {
                let length = f64::from(tenths) / 10.0;
                let back = unit.from_metres(unit.to_metres(length));
                assert!((back - length).abs() <= length * f64::EPSILON, "{length} {}", unit.name());
            }
        }
    }
}
