//! The ellipsoid (2.4).

use super::body::Body;
use super::placement::{Placement, Rotation};
use super::{Accuracy, Bounds, Intersection, Measure, NearestPoint, ShapeHit, SurfacePoint, TracingError};
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vector::Vector;

/// (x/a)² + (y/b)² + (z/c)² = 1 in its own axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Ellipsoid {
    placement: Placement,
    /// a, b, c, in metres, positive.
    radii: Vector,
}

impl Ellipsoid {
    /// It in its own axes.
    pub(super) fn body(&self) -> Body {
        Body::ball(self.placement.origin, self.placement.axes(), self.radii.to_array())
    }

    /// An ellipsoid with these radii (in metres, positive) around a centre.
    #[must_use]
    pub fn new(center: Vector, radii: Vector, rotation: Rotation) -> Self {
        Self { placement: Placement::turned(center, rotation), radii }
    }

    /// Its centre, in metres.
    #[must_use]
    pub fn center(&self) -> Vector {
        self.placement.origin
    }

    /// Its semi-axes, from the shortest to the longest, in metres.
    #[must_use]
    pub fn semi_axes(&self) -> [Vector; 3] {
        let ([x, y, z], radii) = (self.placement.axes(), self.radii);
        let mut axes = [x * radii.x, y * radii.y, z * radii.z];
        axes.sort_unstable_by(|first, second| first.length().total_cmp(&second.length()));
        axes
    }

    /// Intersects the ray with a sphere, in the space where the radii are 1 (2.4). With x' = (x/a, y/b, z/c) of the point
    /// there and g = (x'/a, …), the normal is g/‖g‖, and cosθ_o = ‖D'‖ h'/‖g‖ exactly, where D' is the direction there and
    /// h' is half the chord.
    pub fn intersect<T: Scalar>(&self, ray: &Ray<T>, accuracy: Accuracy) -> Intersection<T> {
        let local = self.placement.local_ray(ray);
        let [shortest, longest] = self.extremes();
        if local.passes_by(longest * (1.0 + 1e-9) + f64::EPSILON * 16.0 * local.reach) {
            return Intersection::MISS;
        }
        let inverse = self.radii.map(|radius| T::from_f64(1.0) / T::from_f64(radius));
        let scaled = |vector: Vector<T>| Vector::new(vector.x * inverse.x, vector.y * inverse.y, vector.z * inverse.z);
        let (start, direction) = (scaled(local.nearest), scaled(local.direction));
        let stretch = direction.length();
        let direction = direction * (T::from_f64(1.0) / stretch);
        let along = -start.dot(direction);
        let perpendicular = direction.mul_add(along, start);
        let clearance = T::from_f64(1.0) - perpendicular.dot(perpendicular);
        // Rounding errors are amplified by the flattening: once in the ray's path, and again in the normal.
        let flatness = longest / shortest;
        let error = f64::EPSILON * (1.0 + local.reach / shortest);
        let error = TracingError { clearance: 16.0 * error * flatness, normal: 0.75 * error * flatness };
        let doubtful = accuracy.doubtful_clearance(&error);
        if clearance.rounded() <= doubtful.start {
            return Intersection::MISS;
        }
        let half_chord = clearance.max(T::zero()).sqrt();
        let place = |root: T| local.along + root / stretch;
        let (near, far) = (place(along - half_chord), place(along + half_chord));
        let on_surface = T::from_f64(error.clearance * longest);
        if far.is_less(-on_surface) {
            return Intersection::MISS;
        }
        let is_doubtful = clearance.rounded() < doubtful.end
            || [near, far].iter().any(|root| (-on_surface).is_less(*root) && root.is_less(on_surface));
        let doubtful_from = is_doubtful.then_some(near);
        if !T::zero().is_less(clearance) || !T::zero().is_less(far) {
            return Intersection { hit: None, doubtful_from };
        }
        let from_inside = !T::zero().is_less(near);
        let side = T::from_f64(if from_inside { -1.0 } else { 1.0 });
        let unit = direction.mul_add(-(side * half_chord), perpendicular);
        let gradient = scaled(unit);
        let length = gradient.length();
        let radii = self.radii.map(T::from_f64);
        let point = SurfacePoint {
            anchor: self.placement.origin,
            offset: self.placement.to_scene(Vector::new(unit.x * radii.x, unit.y * radii.y, unit.z * radii.z)),
            normal: self.placement.to_scene(gradient * (side / length)),
            view: -ray.direction,
            cos_theta_o: stretch * half_chord / length,
        };
        let distance = if from_inside { far } else { near };
        Intersection {
            hit: Some(ShapeHit { distance, point, from_inside, shadow_ray_offset: Vector::zero() }),
            doubtful_from,
        }
    }

    /// The distance from the surface, negative inside.
    #[must_use]
    pub fn signed_distance(&self, point: Vector) -> f64 {
        let place = self.placement.place_of(point);
        let distance = (place - self.nearest_place(place)).length();
        if self.scaled(place).length() < 1.0 { -distance } else { distance }
    }

    /// The surface point nearest to a point.
    #[must_use]
    pub fn nearest(&self, point: Vector) -> NearestPoint {
        let place = self.nearest_place(self.placement.place_of(point));
        let normal = self.scaled(self.scaled(place)).normalized();
        NearestPoint::new(self.placement.origin, self.placement.to_scene(place), self.placement.to_scene(normal))
    }

    fn scaled(&self, place: Vector) -> Vector {
        Vector::new(place.x / self.radii.x, place.y / self.radii.y, place.z / self.radii.z)
    }

    /// The nearest point x solves x_i (1 + s/r_i²) = y_i, where s is found by bisection such that x is on the surface
    /// (Eberly, "Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid"). The bisection is over u = 1 +
    /// s/c², with the shortest radius c, which stays accurate near the poles of s.
    fn nearest_place(&self, place: Vector) -> Vector {
        let [shortest, _] = self.extremes();
        let radii = self.radii.to_array();
        let is_flat = |axis: usize| radii[axis] == shortest;
        let flattest = (0..3).find(|axis| is_flat(*axis)).unwrap_or(0);
        let ratios = radii.map(|radius| (radius / shortest) * (radius / shortest));
        let mut scaled = self.scaled(place).map(f64::abs).to_array();
        // In the plane of the two longer axes there are two nearest points; either one will do.
        scaled[flattest] = scaled[flattest].max(1e-100);
        let place_at = |u: f64| [0, 1, 2].map(|axis| ratios[axis] * scaled[axis] / (u + (ratios[axis] - 1.0)));
        let is_outside = Vector::from(scaled).length() > 1.0;
        let farthest = Vector::from([0, 1, 2].map(|axis| ratios[axis] * scaled[axis])).length();
        let (mut low, mut high) = (scaled[flattest], if is_outside { farthest } else { 1.0 });
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if Vector::from(place_at(middle)).length() > 1.0 { low = middle } else { high = middle }
        }
        let unit = Vector::from(place_at(0.5 * (low + high))).normalized();
        let [x, y, z] = [0, 1, 2].map(|axis| (unit.to_array()[axis] * radii[axis]).copysign(place.to_array()[axis]));
        Vector::new(x, y, z)
    }

    /// Its bounding box, with sides along the scene's axes.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        let [x, y, z] = self.placement.axes::<f64>();
        let [x, y, z] = [x * self.radii.x, y * self.radii.y, z * self.radii.z];
        let half = Vector::new(
            Vector::new(x.x, y.x, z.x).length(),
            Vector::new(x.y, y.y, z.y).length(),
            Vector::new(x.z, y.z, z.z).length(),
        );
        Bounds::around(self.placement.origin, half)
    }

    /// The shortest and the longest radius, in metres.
    fn extremes(&self) -> [f64; 2] {
        let Vector { x, y, z } = self.radii;
        [x.min(y).min(z), x.max(y).max(z)]
    }

    /// Its longest radius, in metres.
    #[must_use]
    pub fn size(&self) -> f64 {
        self.extremes()[1]
    }

    /// The distance of a point, in units of the shortest radius.
    #[must_use]
    pub fn relative_distance(&self, point: Vector) -> f64 {
        (point - self.placement.origin).length() / self.extremes()[0]
    }

    /// The values that describe it.
    #[must_use]
    pub fn measures(&self) -> Vec<(&'static str, Measure)> {
        let mut measures =
            vec![("center", Measure::Vector(self.placement.origin)), ("radii", Measure::Vector(self.radii))];
        measures.extend(self.placement.turn_measures());
        measures
    }
}
