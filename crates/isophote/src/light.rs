//! Point lights and where they send their power.

use crate::real::{Real, Scalar};
use crate::vector::Vector;

/// A point light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Its name, unique among the lights.
    pub name: String,
    /// Where it stands, in metres.
    pub position: Vector,
    /// I₀: radiant intensity (W/sr) on the axis, or luminous intensity (cd).
    pub intensity: f64,
    /// How the intensity depends on the direction.
    pub emission: Emission,
    /// Whether shapes keep its light from each other, if the scene has shadows.
    pub casts_shadows: bool,
}

/// The emission pattern I(ω) of a light (section 3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Emission<T = f64> {
    /// I₀ in every direction; power 4π I₀.
    Isotropic,
    /// I₀ max(0, cosγ), γ the angle from the axis; power π I₀.
    Lambertian {
        /// Unit vector of the axis.
        axis: Vector<T>,
    },
}

/// A light as it is seen from a place near the points that it lights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedLight<T = f64> {
    /// From that place to the light.
    pub position: Vector<T>,
    /// I₀.
    pub intensity: T,
    /// How the intensity depends on the direction.
    pub emission: Emission<T>,
}

impl Light {
    /// The light as it is seen from a place.
    #[must_use]
    #[inline(always)]
    pub fn seen_from<T: Scalar>(&self, place: Vector) -> PlacedLight<T> {
        PlacedLight {
            position: Vector::from_f64(self.position) - Vector::from_f64(place),
            intensity: T::from_f64(self.intensity),
            emission: self.emission.map(T::from_f64),
        }
    }

    /// The power that the light sends out in all directions, in W or lm.
    #[must_use]
    pub fn power(&self) -> f64 {
        self.intensity * self.emission.solid_angle()
    }
}

impl<T: Copy> PlacedLight<T> {
    /// The same light in another number type.
    #[must_use]
    #[inline(always)]
    pub fn map<U>(&self, convert: impl Fn(T) -> U) -> PlacedLight<U> {
        PlacedLight {
            position: self.position.map(&convert),
            intensity: convert(self.intensity),
            emission: self.emission.map(convert),
        }
    }
}

impl<T: Real> PlacedLight<T> {
    /// I(ω) towards a point, in W/sr or cd. `to_light` leads from the point to the light; its length is 1/`inverse_distance`.
    #[inline(always)]
    pub fn intensity_towards(&self, to_light: Vector<T>, inverse_distance: T) -> T {
        match self.emission {
            Emission::Isotropic => self.intensity,
            Emission::Lambertian { axis } => self.intensity * (-axis.dot(to_light)).or_zero() * inverse_distance,
        }
    }
}

impl<T: Copy> Emission<T> {
    /// The same pattern in another number type.
    #[must_use]
    #[inline(always)]
    pub fn map<U>(self, convert: impl Fn(T) -> U) -> Emission<U> {
        match self {
            Self::Isotropic => Emission::Isotropic,
            Self::Lambertian { axis } => Emission::Lambertian { axis: axis.map(convert) },
        }
    }
}

impl Emission {
    /// Power over intensity on the axis, in sr: 4π or π.
    #[must_use]
    pub fn solid_angle(self) -> f64 {
        match self {
            Self::Isotropic => 4.0 * std::f64::consts::PI,
            Self::Lambertian { .. } => std::f64::consts::PI,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ I(ω) dω over the sphere of directions, by the midpoint rule in cosine and azimuth about a slanted axis.
    #[test]
    fn the_power_of_a_light_is_the_integral_of_its_intensity() {
        let axis = Vector::new(1.0, 2.0, -2.0) * (1.0 / 3.0);
        for emission in [Emission::Isotropic, Emission::Lambertian { axis }] {
            let light = Light {
                name: "lamp".into(),
                position: Vector::default(),
                intensity: 3.5,
                emission,
                casts_shadows: true,
            };
            let (cosines, turns) = (1000, 1000);
            let mut power = 0.0;
            for i in 0..cosines {
                let z = (f64::from(i) + 0.5) / f64::from(cosines) * 2.0 - 1.0;
                for j in 0..turns {
                    let (sine, cosine) = (std::f64::consts::TAU * (f64::from(j) + 0.5) / f64::from(turns)).sin_cos();
                    let ring = (1.0 - z * z).sqrt();
                    let away = Vector::new(ring * cosine, ring * sine, z);
                    power += light.seen_from::<f64>(away).intensity_towards(-away, 1.0);
                }
            }
            power *= 4.0 * std::f64::consts::PI / f64::from(cosines * turns);
            assert!((power / light.power() - 1.0).abs() < 1e-5, "{emission:?}");
        }
    }
}
