//! How the intensity of a point light depends on the direction.

use super::Spot;
use crate::real::Real;
use crate::vector::Vector;

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
    /// I₀ within a cone, 0 outside another: see [`Spot`].
    Spot(Spot<T>),
}

impl<T: Copy> Emission<T> {
    /// The same pattern in another number type.
    #[must_use]
    #[inline(always)]
    pub fn map<U>(self, convert: impl Fn(T) -> U) -> Emission<U> {
        match self {
            Self::Isotropic => Emission::Isotropic,
            Self::Lambertian { axis } => Emission::Lambertian { axis: axis.map(convert) },
            Self::Spot(spot) => Emission::Spot(spot.map(convert)),
        }
    }
}

impl<T: Real> Emission<T> {
    /// I₀, as a number of this type, times what of it goes towards a point. `to_light` leads from the point to the
    /// light; its length is 1/`inverse_distance`.
    #[inline(always)]
    pub(super) fn towards(&self, intensity: T, to_light: Vector<T>, inverse_distance: T) -> T {
        match self {
            Self::Isotropic => intensity,
            Self::Lambertian { axis } => intensity * (-axis.dot(to_light)).max_zero() * inverse_distance,
            Self::Spot(spot) => intensity * spot.share(to_light, inverse_distance),
        }
    }
}

impl Emission {
    /// Power over intensity on the axis, in sr: 4π, π, or that of the [`Spot`].
    #[must_use]
    pub fn solid_angle(self) -> f64 {
        match self {
            Self::Isotropic => 4.0 * std::f64::consts::PI,
            Self::Lambertian { .. } => std::f64::consts::PI,
            Self::Spot(spot) => spot.solid_angle(),
        }
    }
}
