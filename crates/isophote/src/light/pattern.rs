//! Emission patterns in the form that the formula evaluates.

use crate::real::Real;
use crate::vector::Vector;

/// How the light received from an emitter depends on the direction.
///
/// An emitter has the same pattern for all points, so a vector of points never branches per lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pattern<T = f64> {
    /// The same in every direction.
    Isotropic,
    /// Proportional to the cosine of the angle from the axis.
    Lambertian {
        /// Unit vector of the axis.
        axis: Vector<T>,
    },
    /// A cone with a smooth edge.
    Cone(Cone<T>),
    /// All from one direction, without loss over distance (3.8).
    Parallel,
}

/// The step of a [`Spot`](super::Spot) between its two half angles α and β (3.7).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone<T = f64> {
    /// Unit vector of the axis.
    pub axis: Vector<T>,
    /// 2(1 − cosβ).
    pub outer: T,
    /// 1/(2(cosα − cosβ)).
    pub steepness: T,
}

impl<T> Pattern<T> {
    /// Whether all light comes from one direction.
    #[inline(always)]
    pub fn is_parallel(&self) -> bool {
        matches!(self, Self::Parallel)
    }
}

impl<T: Copy> Pattern<T> {
    /// The same pattern in another number type.
    #[must_use]
    #[inline(always)]
    pub fn map<U>(self, convert: impl Fn(T) -> U) -> Pattern<U> {
        match self {
            Self::Isotropic => Pattern::Isotropic,
            Self::Lambertian { axis } => Pattern::Lambertian { axis: axis.map(convert) },
            Self::Cone(Cone { axis, outer, steepness }) => {
                let axis = axis.map(&convert);
                Pattern::Cone(Cone { axis, outer: convert(outer), steepness: convert(steepness) })
            }
            Self::Parallel => Pattern::Parallel,
        }
    }
}

impl<T: Real> Pattern<T> {
    /// The part of I₀, a number of this type, that goes towards a point. `to_light` is the vector from the point to the
    /// light; its length is 1/`inverse_distance`.
    #[inline(always)]
    pub(super) fn towards(&self, intensity: T, to_light: Vector<T>, inverse_distance: T) -> T {
        match self {
            Self::Isotropic | Self::Parallel => intensity,
            Self::Lambertian { axis } => intensity * (-axis.dot(to_light)).max_zero() * inverse_distance,
            Self::Cone(cone) => intensity * cone.share(to_light, inverse_distance),
        }
    }
}

impl Cone {
    /// An upper bound on how fast I/I₀ changes with γ, per radian: the step is steepest in its middle, with 3/2 of its
    /// height over cosα − cosβ, and sinγ is largest at the outer edge.
    #[must_use]
    pub fn steepest(&self) -> f64 {
        3.0 * self.steepness * libm::sin(self.outer_angle())
    }

    /// β, in radians.
    #[must_use]
    pub fn outer_angle(&self) -> f64 {
        2.0 * libm::asin(0.5 * self.outer.sqrt())
    }
}

impl<T: Real> Cone<T> {
    /// I/I₀ towards a point. `to_light` is the vector from the point to the light; its length is 1/`inverse_distance`.
    #[inline(always)]
    pub fn share(&self, to_light: Vector<T>, inverse_distance: T) -> T {
        let x = self.place_in_step(to_light, inverse_distance);
        x * x * (x + x).mul_add(x.splat_like(-1.0), x.splat_like(3.0))
    }

    /// x, computed from 2(1 − cosγ) = ‖A + L‖²: near the axis a cosine would lose the digits of the angle.
    #[inline(always)]
    pub(super) fn place_in_step(&self, to_light: Vector<T>, inverse_distance: T) -> T {
        let from_axis = to_light.mul_add(inverse_distance, self.axis);
        let x = ((self.outer - from_axis.dot(from_axis)) * self.steepness).max_zero();
        let one = x.splat_like(1.0);
        T::select(x.is_less(one), x, one)
    }
}
