//! Colour: three numbers in place of one, and the colour space that says which primaries they are amounts of.
//!
//! A scene with colours is three scenes of single numbers that share one geometry. Each component of B, E, … follows the
//! formulas for single numbers; where a scene with colours gives a single number, it is the luminance Y (3.10).

mod space;

pub use space::{Chromaticity, ColorSpace, Matrix};

use crate::message;
use crate::text::Message;
use crate::units::Keyword;

/// One value for each component of a colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rgb<T = f64> {
    /// The value of the red primary.
    pub red: T,
    /// The value of the green primary.
    pub green: T,
    /// The value of the blue primary.
    pub blue: T,
}

/// A component of a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Component {
    /// The amount of the space's red primary.
    Red,
    /// The amount of its green primary.
    Green,
    /// The amount of its blue primary.
    Blue,
}

impl Keyword for Component {
    const ALL: &'static [Self] = &[Self::Red, Self::Green, Self::Blue];

    fn name(self) -> &'static str {
        match self {
            Self::Red => "red",
            Self::Green => "green",
            Self::Blue => "blue",
        }
    }
}

impl Component {
    /// Its name for people.
    #[must_use]
    pub fn label(self) -> Message {
        match self {
            Self::Red => message!("red"),
            Self::Green => message!("green"),
            Self::Blue => message!("blue"),
        }
    }
}

impl<T> Rgb<T> {
    /// Calls a function for each component, in order.
    pub fn from_fn(mut of: impl FnMut(Component) -> T) -> Self {
        Self { red: of(Component::Red), green: of(Component::Green), blue: of(Component::Blue) }
    }

    /// The value of a component.
    #[must_use]
    pub fn of(&self, component: Component) -> &T {
        match component {
            Component::Red => &self.red,
            Component::Green => &self.green,
            Component::Blue => &self.blue,
        }
    }

    /// Applies a function to each component.
    pub fn map<'s, U>(&'s self, mut convert: impl FnMut(&'s T) -> U) -> Rgb<U> {
        Rgb::from_fn(|component| convert(self.of(component)))
    }

    /// Red, green, blue.
    #[must_use]
    pub fn into_array(self) -> [T; 3] {
        [self.red, self.green, self.blue]
    }
}

impl<T> From<[T; 3]> for Rgb<T> {
    fn from([red, green, blue]: [T; 3]) -> Self {
        Self { red, green, blue }
    }
}

impl Rgb {
    /// Y = w_R R + w_G G + w_B B (3.10), by the [weights](ColorSpace::luminance_weights) of a space.
    #[must_use]
    #[inline]
    pub fn weighted_by(self, weights: Self) -> f64 {
        weights.red * self.red + weights.green * self.green + weights.blue * self.blue
    }

    /// Whether all components are the same number.
    #[must_use]
    #[expect(clippy::float_cmp, reason = "whether it was written as one number")]
    pub fn is_even(self) -> bool {
        self.red == self.green && self.green == self.blue
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_keep_their_order() {
        let names = Rgb::from_fn(Component::name);
        assert_eq!(names.into_array(), ["red", "green", "blue"]);
        assert_eq!(*names.of(Component::Green), "green");
        assert_eq!(names.map(|name| name.len()), Rgb::from([3, 5, 4]));
    }

    #[test]
    fn the_luminance_is_the_weighted_sum() {
        let weights = Rgb::from([0.25, 0.5, 0.125]);
        assert_eq!(Rgb::from([4.0, 2.0, 8.0]).weighted_by(weights), 3.0);
    }
}
