//! The sphere (2.2).

use super::body::Body;
use super::{Accuracy, Bounds, Intersection, NearestPoint, ShapeHit, SurfacePoint, TracingError};
use crate::ray::Ray;
use crate::scalar::Scalar;
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
    /// It in its own axes.
    pub(super) fn body(&self) -> Body {
        Body::ball(self.center, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vector::from), [self.radius; 3])
    }

    /// The nearest root of ‖O + tD − C‖² = R² with t > 0: the near one from outside, the far one from inside, with N turned
    /// towards the viewer (2.2).
    ///
    /// Everything is computed from the perpendicular from the centre to the ray, `l`, and the half chord h = √(R² − l²): P −
    /// C = l ∓ hD, and cosθ_o = h/R exactly. The textbook form b² − 4ac subtracts the squares of large distances and is
    /// inaccurate at the limb; this one loses only the digits that the ray itself has lost. (Haines, Günther and
    /// Akenine-Möller, "Precision improvements for ray/sphere intersection", Ray Tracing Gems, 2019.)
    #[inline(always)]
    pub fn intersect<T: Scalar>(&self, ray: &Ray<T>, accuracy: Accuracy) -> Intersection<T> {
        let radius = T::from_f64(self.radius);
        let to_center = -ray.start_from(self.center);
        let along = to_center.dot(ray.direction);
        let perpendicular = ray.direction * along - to_center;
        // How far the ray is from grazing: cos²θ_o of a hit. A ray that touches at a single point sees no area, so it
        // misses.
        let clearance = (radius * radius - perpendicular.dot(perpendicular)) / (radius * radius);
        let relative_distance = (along.rounded().abs() + perpendicular.length().rounded()) / self.radius;
        let doubtful = accuracy.doubtful_clearance(&TracingError::of_ray(relative_distance));
        // Seen from outside, a sphere behind the start is clearly missed; from inside, none is.
        let nearby = T::from_f64(-2.0 * self.radius);
        if clearance.rounded() <= doubtful.start || along.is_less(nearby) {
            return Intersection::MISS;
        }
        let cos_theta_o = clearance.max(T::zero()).sqrt();
        let half_chord = cos_theta_o * radius;
        let (near, far) = (along - half_chord, along + half_chord);
        let starts_on_surface = T::from_f64(doubtful.start * self.radius);
        let is_doubtful = clearance.rounded() < doubtful.end
            || [near, far].iter().any(|root| starts_on_surface.is_less(*root) && root.is_less(-starts_on_surface));
        let doubtful_from = is_doubtful.then_some(near);
        let from_inside = !T::zero().is_less(near);
        if !T::zero().is_less(clearance) || !T::zero().is_less(far) {
            return Intersection { hit: None, doubtful_from };
        }
        let (offset, outwards, distance) = if from_inside {
            (perpendicular + ray.direction * half_chord, -T::from_f64(1.0), far)
        } else {
            (perpendicular - ray.direction * half_chord, T::from_f64(1.0), near)
        };
        let normal = offset * (outwards / radius);
        let point = SurfacePoint { anchor: self.center, offset, normal, view: -ray.direction, cos_theta_o };
        let shadow_ray_offset = Vector::zero();
        Intersection { hit: Some(ShapeHit { distance, point, from_inside, shadow_ray_offset }), doubtful_from }
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
        NearestPoint::new(self.center, direction * self.radius, direction)
    }

    /// Its bounding box.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        let half = Vector::new(self.radius, self.radius, self.radius);
        Bounds { least: self.center - half, greatest: self.center + half }
    }
}
