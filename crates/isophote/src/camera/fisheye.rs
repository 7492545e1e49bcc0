//! A cone of directions in a circle.

use super::panorama::radians;
use crate::double_double::{DoubleDouble, ExactProduct};
use crate::real::Real;
use crate::scalar::Scalar;
use crate::vector::Vector;

/// All directions within half the field of view of the direction of view, in a circle that touches the shorter sides of the
/// image. The direction at the angle θ from the axis is at the distance ρ from the middle, in degrees:
///
/// ```text
/// equidistant (2.8)   ρ = θ
/// equal area (2.9)    ρ = 2 sin(θ/2) · 180°/π
/// ```
///
/// Both are true to scale in the middle. In the second, an area of one square degree on the screen is a solid angle of one
/// square degree everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fisheye {
    /// How angles map to distances from the middle.
    pub mapping: Mapping,
    /// The angle across the circle, in degrees: above 0, up to 360.
    pub field_of_view: f64,
}

/// How the angle from the axis maps to a distance from the middle of the circle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mapping {
    /// The distance is the angle (2.8).
    Equidistant,
    /// Areas are solid angles (2.9).
    EqualArea,
}

impl Fisheye {
    /// The circle's radius on the screen, in degrees.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.distance_of(0.5 * self.field_of_view.to_radians())
    }

    /// ρ for an angle θ in radians.
    fn distance_of(&self, theta: f64) -> f64 {
        match self.mapping {
            Mapping::Equidistant => theta.to_degrees(),
            Mapping::EqualArea => (2.0 * libm::sin(0.5 * theta)).to_degrees(),
        }
    }

    /// The unit vector (right, up, forward) seen at a screen point; `None` outside the circle.
    pub(super) fn direction<T: Scalar>(&self, x: DoubleDouble, y: DoubleDouble) -> Option<Vector<T>> {
        if x.rounded().hypot(y.rounded()) > self.radius() {
            return None;
        }
        let distance = (x * x + y * y).sqrt();
        let one = DoubleDouble::from_f64(1.0);
        let per_distance = if distance.rounded() > 0.0 { one / distance } else { DoubleDouble::zero() };
        let [right, up] = [x, y].map(|coordinate| T::from_precise(coordinate * per_distance));
        let radians = radians(distance);
        let (sine, cosine) = match self.mapping {
            Mapping::Equidistant => T::sine_and_cosine_of(radians),
            Mapping::EqualArea => {
                let half = DoubleDouble::from_f64(0.5);
                let sine_of_half = radians * half;
                let square = sine_of_half * sine_of_half;
                let sine = (sine_of_half + sine_of_half) * (one - square).sqrt();
                (T::from_precise(sine), T::from_precise(one - (square + square)))
            }
        };
        Some(Vector::new(right * sine, up * sine, cosine))
    }

    /// The unit vectors seen at screen points, and how far from the middle these are, in radii of the circle.
    #[inline(always)]
    pub(super) fn direction_in_lanes<T: ExactProduct>(
        &self,
        x: DoubleDouble<T>,
        y: DoubleDouble<T>,
    ) -> (Vector<DoubleDouble<T>>, T) {
        let (zero, one) = (x.splat_like(0.0), x.splat_like(1.0));
        let distance = (x * x + y * y).sqrt();
        let is_beside = zero.is_less(distance);
        let per_distance = DoubleDouble::select(is_beside, one / DoubleDouble::select(is_beside, distance, one), zero);
        let angle = radians(distance);
        let (sine, cosine) = match self.mapping {
            Mapping::Equidistant => angle.sine_and_cosine(),
            Mapping::EqualArea => {
                let sine_of_half = angle * x.splat_like(0.5);
                let square = sine_of_half * sine_of_half;
                ((sine_of_half + sine_of_half) * (one - square).max_zero().sqrt(), one - (square + square))
            }
        };
        let eccentricity = distance.nearest() / distance.nearest().splat_like(self.radius());
        (Vector::new(x * per_distance * sine, y * per_distance * sine, cosine), eccentricity)
    }

    /// Where a direction (right, up, forward) appears; `None` outside the circle.
    pub(super) fn project(&self, direction: Vector) -> Option<[f64; 2]> {
        let across = libm::hypot(direction.x, direction.y);
        let distance = self.distance_of(libm::atan2(across, direction.z));
        // What is exactly behind the camera appears all around the circle of 360 degrees; it is assigned to the right.
        let [right, up] = if across > 0.0 { [direction.x / across, direction.y / across] } else { [1.0, 0.0] };
        (distance <= self.radius() * (1.0 + 4.0 * f64::EPSILON)).then_some([right * distance, up * distance])
    }
}
