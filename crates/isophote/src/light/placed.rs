//! A light as the formula takes it.

use super::Emission;
use crate::real::Real;
use crate::vector::Vector;

/// A light as it is seen from a place near the points that it lights.
///
/// A parallel light is one at distance 1 from each of them: E₀ cosθ_i/1² is then its irradiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedLight<T = f64> {
    /// From that place to the light; L of a parallel light.
    pub position: Vector<T>,
    /// I₀; E₀ of a parallel light.
    pub intensity: T,
    /// Where its rays come from.
    pub rays: Rays<T>,
}

/// Where the rays of a light come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rays<T = f64> {
    /// From its position, with an intensity that depends on their direction.
    Point(Emission<T>),
    /// From one direction.
    Parallel,
}

impl<T: Copy> PlacedLight<T> {
    /// The same light in another number type.
    #[must_use]
    #[inline(always)]
    pub fn map<U>(&self, convert: impl Fn(T) -> U) -> PlacedLight<U> {
        PlacedLight {
            position: self.position.map(&convert),
            intensity: convert(self.intensity),
            rays: match self.rays {
                Rays::Point(emission) => Rays::Point(emission.map(convert)),
                Rays::Parallel => Rays::Parallel,
            },
        }
    }
}

impl<T: Real> PlacedLight<T> {
    /// From a point, given from the same place as the light, to the light.
    #[inline(always)]
    pub fn from_point(&self, offset: Vector<T>) -> Vector<T> {
        match self.rays {
            Rays::Point(_) => self.position - offset,
            Rays::Parallel => self.position,
        }
    }

    /// I(ω) towards a point, in W/sr or cd. `to_light` leads from the point to the light; its length is 1/`inverse_distance`.
    #[inline(always)]
    pub fn intensity_towards(&self, to_light: Vector<T>, inverse_distance: T) -> T {
        match self.rays {
            Rays::Point(emission) => emission.towards(self.intensity, to_light, inverse_distance),
            Rays::Parallel => self.intensity,
        }
    }
}
