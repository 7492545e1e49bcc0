//! The sphere (2.2).

use super::{Intersection, NearestPoint, Ray, SurfacePoint};
use crate::real::Real;
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
    /// The nearest root of ‖O + tD − C‖² = R² with t > 0: the near one from outside, the far one from inside, with N
    /// turned to the viewer (2.2).
    ///
    /// Everything is built from the perpendicular from the centre to the ray, `l`, and the half chord
    /// h = √(R² − l²): P − C = l ∓ hD, and cosθ_o = h/R exactly. The textbook form b² − 4ac subtracts the squares of
    /// large distances and loses the limb; this one loses only what the ray itself has lost. (Haines, Günther and
    /// Akenine-Möller, "Precision improvements for ray/sphere intersection", Ray Tracing Gems, 2019.)
    #[inline(always)]
    pub fn intersect<T: Real>(&self, ray: &Ray<T>, from_inside: bool) -> Intersection<T> {
        let center = Vector::from_f64(self.center);
        let radius = T::from_f64(self.radius);
        let to_center = center - ray.origin;
        let along = to_center.dot(ray.direction);
        let perpendicular = ray.direction * along - to_center;
        let clearance = (radius * radius - perpendicular.dot(perpendicular)) / (radius * radius);
        let cos_theta_o = clearance.max(T::zero()).sqrt();
        let half_chord = cos_theta_o * radius;
        let (offset, normal, distance) = if from_inside {
            let offset = perpendicular + ray.direction * half_chord;
            (offset, -offset, along + half_chord)
        } else {
            let offset = perpendicular - ray.direction * half_chord;
            (offset, offset, along - half_chord)
        };
        // Seen from outside, a sphere behind the eye is a miss as clear as any.
        let clearance =
            if from_inside { clearance } else { T::select(T::zero().is_less(along), clearance, -T::from_f64(1.0)) };
        let normal = normal * (T::from_f64(1.0) / radius);
        Intersection {
            // A ray that touches at a single point sees no area: a miss.
            is_hit: T::zero().is_less(clearance),
            distance,
            point: SurfacePoint { anchor: center, offset, normal, view: -ray.direction, cos_theta_o },
            clearance,
        }
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
