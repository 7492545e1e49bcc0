//! Coefficients and strengths: a number, or three of them.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Serialize;

use super::SceneSource;
use crate::color::{Component, Rgb};
use crate::scene::limits;

/// One number for all components of the light, or one for each.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Amount {
    /// The same for all components.
    Number(f64),
    /// Those of the colour space's red, green and blue primaries.
    Rgb([f64; 3]),
}

impl Amount {
    /// Whether it is three numbers.
    #[must_use]
    pub fn is_colored(self) -> bool {
        matches!(self, Self::Rgb(_))
    }

    /// What it has of a component.
    #[must_use]
    pub fn of(self, component: Component) -> f64 {
        match self {
            Self::Number(number) => number,
            Self::Rgb(numbers) => *Rgb::from(numbers).of(component),
        }
    }

    /// The same with other numbers.
    #[must_use]
    pub fn map(self, convert: impl Fn(f64) -> f64) -> Self {
        match self {
            Self::Number(number) => Self::Number(convert(number)),
            Self::Rgb(numbers) => Self::Rgb(numbers.map(convert)),
        }
    }

    /// Whether nothing of any component is there.
    #[must_use]
    pub fn is_zero(self) -> bool {
        match self {
            Self::Number(number) => number == 0.0,
            Self::Rgb(numbers) => numbers == [0.0; 3],
        }
    }
}

impl From<f64> for Amount {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl SceneSource {
    /// Whether any amount is written as three numbers: the scene then has a colour at each point.
    #[must_use]
    pub fn is_colored(&self) -> bool {
        let of_materials = self.material.values().flat_map(|material| [material.diffuse, material.specular]);
        let of_lights = self.light.iter().flat_map(|light| [light.intensity, light.power, light.irradiance]);
        let of_ambient = self.ambient.iter().map(|ambient| ambient.radiance);
        of_materials.chain(of_lights).chain(of_ambient).flatten().any(Amount::is_colored)
    }
}

/// A coefficient, as the schema has it.
pub(super) struct Coefficient;

/// An intensity, an irradiance, a radiance or a power, as the schema has it.
pub(super) struct Strength;

impl JsonSchema for Coefficient {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Coefficient".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        one_or_three(&json_schema!({"type": "number", "minimum": 0.0, "maximum": limits::COEFFICIENT}))
    }
}

impl JsonSchema for Strength {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Strength".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        one_or_three(&json_schema!({"type": "number", "minimum": 0.0, "maximum": limits::INTENSITY}))
    }
}

fn one_or_three(number: &Schema) -> Schema {
    json_schema!({"anyOf": [number, {"type": "array", "items": number, "minItems": 3, "maxItems": 3}]})
}
