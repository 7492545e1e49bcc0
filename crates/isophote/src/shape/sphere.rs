//! The sphere (2.2).

use super::{Approach, Intersection, NearestPoint, Ray, SurfacePoint};
use crate::real::Scalar;
use crate::vector::Vector;

/// ‖P − C‖ = R.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// C, in metres.
    pub center: Vector,
    /// R, in metres, positive.
    pub radius: f64,
}

impl Sphere {
    /// How a ray passes the sphere: all that tells a hit from a miss.
    ///
    /// Everything is built from the perpendicular from the centre to the ray, `l`, and the half chord
    /// h = √(R² − l²): P − C = l ∓ hD, and cosθ_o = h/R exactly. The textbook form b² − 4ac subtracts the squares of
    /// large distances and loses the limb; this one loses only what the ray itself has lost. (Haines, Günther and
    /// Akenine-Möller, "Precision improvements for ray/sphere intersection", Ray Tracing Gems, 2019.)
    #[inline(always)]
    pub fn approach<T: Scalar>(&self, ray: &Ray<T>, from_inside: bool) -> Approach<T> {
        let radius = T::from_f64(self.radius);
        let to_center = Vector::from_f64(self.center) - ray.origin;
        let along = to_center.dot(ray.direction);
        let perpendicular = ray.direction * along - to_center;
        let clearance = (radius * radius - perpendicular.dot(perpendicular)) / (radius * radius);
        // Seen from outside, a sphere behind the eye is a miss as clear as any.
        let clearance =
            if from_inside { clearance } else { T::select(T::zero().is_less(along), clearance, -T::from_f64(1.0)) };
        Approach { clearance, along, perpendicular }
    }

    /// The nearest root of ‖O + tD − C‖² = R² with t > 0: the near one from outside, the far one from inside, with N
    /// turned to the viewer (2.2). Means something only where the approach is a hit.
    #[inline(always)]
    pub fn intersection<T: Scalar>(&self, ray: &Ray<T>, from_inside: bool, approach: &Approach<T>) -> Intersection<T> {
        let Approach { clearance, along, perpendicular } = *approach;
        let cos_theta_o = clearance.max(T::zero()).sqrt();
        let half_chord = cos_theta_o * T::from_f64(self.radius);
        let (offset, outwards, distance) = if from_inside {
            (perpendicular + ray.direction * half_chord, -T::from_f64(1.0), along + half_chord)
        } else {
            (perpendicular - ray.direction * half_chord, T::from_f64(1.0), along - half_chord)
        };
        let normal = offset * (outwards / T::from_f64(self.radius));
        let anchor = self.center;
        Intersection { distance, point: SurfacePoint { anchor, offset, normal, view: -ray.direction, cos_theta_o } }
    }

    /// ‖P − C‖ − R.
    #[must_use]
    pub fn signed_distance(&self, point: Vector) -> f64 {
        (point - self.center).length() - self.radius
    }

    /// The surface point nearest to `point`; for the centre itself, the one in direction −z.
    #[must_use]
    pub fn nearest(&self, point: Vector) -> NearestPoint {
        let from_center = point - self.center;
        let is_center = from_center.length() == 0.0;
        self.in_direction(if is_center { Vector::new(0.0, 0.0, -1.0) } else { from_center.normalized() })
    }

    /// The surface point in a direction from the centre.
    #[must_use]
    pub fn in_direction(&self, direction: Vector) -> NearestPoint {
        NearestPoint { anchor: self.center, offset: direction * self.radius, outward_normal: direction }
    }
}
