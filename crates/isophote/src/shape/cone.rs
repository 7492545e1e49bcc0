//! The cone, pointed or truncated, with its flat ends (2.4).

use super::body::{Body, Form};
use super::placement::{LocalRay, Placement};
use super::span::{Crossing, NEVER, Span, pass};
use super::{Accuracy, Bounds, Intersection, Measure, NearestPoint, PLACE_ERROR, ShapeHit, SurfacePoint, TracingError};
use crate::double_double::DoubleDouble;
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vector::Vector;

/// x² + y² ≤ R(z)², 0 ≤ z ≤ h in its own axes, with R(z) = R₀ + kz, k = (R₁ − R₀)/h.
#[derive(Clone, Debug, PartialEq)]
pub struct Cone {
    placement: Placement,
    /// The end of the axis at z = h, in metres.
    apex: Vector,
    /// h, in metres.
    height: DoubleDouble,
    /// R₀ at the base and R₁ at the apex, in metres, not negative and not both zero.
    radii: [f64; 2],
}

/// The faces: the base, the end at the apex, and the lateral side.
const BASE: usize = 0;
const END: usize = 1;
const SIDE: usize = 2;

/// The lateral side along a ray: the interval where F = x² + y² − R² is negative, between the roots of F = aτ² + 2bτ + c.
struct Side<T> {
    span: Span<T>,
    /// √(b² − ac).
    root: T,
    /// b² − ac, which is 0 for a ray that touches, and its rounding error.
    discriminant: f64,
    error: f64,
}

/// A point of the surface, in the shape's axes.
struct Found<T> {
    place: Vector<T>,
    /// Outward.
    normal: Vector<T>,
    cos_theta_o: T,
    /// Whether the hit is traced again with 32 digits.
    is_inexact: bool,
}

/// The fraction of a ray's transverse error bound that is passed on to the normal of the side: the bound is generous,
/// because hit and miss depend on it.
const NORMAL_ERROR: f64 = 0.2;

impl Cone {
    /// It in its own axes.
    pub(super) fn body(&self) -> Body {
        let [radius, _] = self.radii;
        let form = Form::Cone { radius, slope: self.slope::<f64>(), height: self.height.rounded() };
        Body::placed(&self.placement, form, self.size())
    }

    /// A cone from the middle of its base to its apex, two distinct points, with the radii at both (in metres, not negative,
    /// not both zero).
    #[must_use]
    pub fn new(base: Vector, apex: Vector, radii: [f64; 2]) -> Self {
        let axis = Vector::<DoubleDouble>::from_f64(apex) - Vector::from_f64(base);
        Self { placement: Placement::along(base, axis), apex, height: axis.length(), radii }
    }

    /// The part of the ray within the side, the part between the flat ends, and the intersection of the two (2.4).
    ///
    /// b² − ac is computed as ‖R D⊥ − k D_z P⊥‖² − (P⊥ × D⊥)², a difference of two squares, which factors: with P near the
    /// axis, it stays accurate at the silhouette. cosθ_o is its root over R √(1 + k²), exactly.
    pub fn intersect<T: Scalar>(&self, ray: &Ray<T>, accuracy: Accuracy) -> Intersection<T> {
        let local = self.placement.local_ray(ray);
        let size = self.size();
        let error = PLACE_ERROR * (local.reach + size);
        if local.passes_by(size + error) {
            return Intersection::MISS;
        }
        let height = T::from_precise(self.height);
        let ends = Span::between(local.nearest.z, local.direction.z, [T::zero(), height], error, [BASE, END]);
        let Some(side) = self.side(&local, error) else { return Intersection::MISS };
        let passage = pass([side.span, ends], local.along);
        let mut doubtful_from = passage.doubtful_from;
        if side.discriminant.abs() < side.error && passage.crossing.is_none_or(|crossing| crossing.face == SIDE) {
            doubtful_from = Some((local.along.rounded() - size).max(0.0));
        }
        let doubtful_from = doubtful_from.map(T::from_f64);
        let Some(crossing) = passage.crossing else { return Intersection { hit: None, doubtful_from } };
        let distance = local.along + crossing.at;
        let place = local.at(crossing.at);
        let on_side = (crossing.face == SIDE).then(|| self.on_side(place, &side, error, accuracy)).flatten();
        let Found { place, normal, cos_theta_o, is_inexact } = on_side.unwrap_or_else(|| {
            let z = if crossing.face == BASE { T::zero() } else { height };
            let cos_theta_o = local.direction.z.max(-local.direction.z);
            let outward = T::from_f64(if crossing.face == BASE { -1.0 } else { 1.0 });
            let is_inexact = accuracy.is_exceeded_by(error / (size * cos_theta_o.rounded()), 0.0);
            let normal = Vector::new(T::zero(), T::zero(), outward);
            Found { place: Vector::new(place.x, place.y, z), normal, cos_theta_o, is_inexact }
        });
        let turned = T::from_f64(if passage.from_inside { -1.0 } else { 1.0 });
        let point = SurfacePoint {
            anchor: self.placement.origin,
            offset: self.placement.to_scene(place),
            normal: self.placement.to_scene(normal * turned),
            view: -ray.direction,
            cos_theta_o,
        };
        let doubtful_from = doubtful_from.or(is_inexact.then_some(distance));
        let hit = ShapeHit { distance, point, from_inside: passage.from_inside, shadow_ray_offset: Vector::zero() };
        Intersection { hit: Some(hit), doubtful_from }
    }

    /// The part of a ray within the side; `None` if it certainly misses.
    fn side<T: Scalar>(&self, local: &LocalRay<T>, error: f64) -> Option<Side<T>> {
        let (place, direction) = (local.nearest, local.direction);
        let slope = self.slope::<T>();
        let radius = slope.mul_add(place.z, T::from_f64(self.radii[0]));
        let narrowing = slope * direction.z;
        let across = direction.x.mul_add(direction.x, direction.y * direction.y).sqrt();
        let from_axis = place.x.mul_add(place.x, place.y * place.y).sqrt();
        let first = Vector::new(
            direction.x * radius - place.x * narrowing,
            direction.y * radius - place.y * narrowing,
            T::zero(),
        );
        let first = first.length();
        let second = place.x * direction.y - place.y * direction.x;
        let discriminant = (first - second) * (first + second);
        let growth = 1.0 + slope.rounded().abs();
        let lost = 4.0 * (first.rounded() + second.rounded().abs() + error * growth) * error * growth;
        let quadratic = (across - narrowing) * (across + narrowing);
        let constant = (from_axis - radius) * (from_axis + radius);
        let is_steep = quadratic.rounded() < 0.0;
        if discriminant.rounded() <= -lost && !is_steep {
            return None;
        }
        let root = discriminant.max(T::zero()).sqrt();
        let half_linear = (place.x * direction.x + place.y * direction.y) - narrowing * radius;
        let crossing = |at: T| {
            let far = at.rounded().abs();
            let widest = self.radii[0].max(self.radii[1]) + far * growth;
            let error = 2.0 * widest * growth * (error + f64::EPSILON * far) / root.rounded();
            Crossing { at, error: error.min(2.0 * NEVER), face: SIDE }
        };
        let is_certain = constant.rounded().abs() > 4.0 * self.size() * error * growth;
        let degenerate = Span::always(constant.is_less(T::zero()), if is_certain { 0.0 } else { 2.0 * NEVER }, SIDE);
        let span = side_span(quadratic, half_linear, constant, root, narrowing, crossing).unwrap_or(degenerate);
        Some(Side { span, root, discriminant: discriminant.rounded(), error: lost })
    }

    /// A point of the side, moved exactly onto it; `None` at the apex, which has no normal of its own.
    fn on_side<T: Scalar>(&self, at: Vector<T>, side: &Side<T>, error: f64, accuracy: Accuracy) -> Option<Found<T>> {
        let slope = self.slope::<T>();
        let radius = slope.mul_add(at.z, T::from_f64(self.radii[0]));
        let from_axis = at.x.mul_add(at.x, at.y * at.y).sqrt();
        if !T::zero().is_less(radius) || !T::zero().is_less(from_axis) {
            return None;
        }
        let (x, y) = (at.x / from_axis, at.y / from_axis);
        let steepness = slope.mul_add(slope, T::from_f64(1.0)).sqrt();
        let cos_theta_o = side.root / (radius * steepness);
        let narrowest = radius.rounded() * steepness.rounded();
        let tracing = TracingError {
            clearance: side.error / (narrowest * narrowest),
            normal: NORMAL_ERROR * error * (1.0 + slope.rounded().abs()) / narrowest,
        };
        let cosine = cos_theta_o.rounded();
        let is_inexact = cosine * cosine < accuracy.doubtful_clearance(&tracing).end;
        let normal = Vector::new(x, y, -slope) * (T::from_f64(1.0) / steepness);
        Some(Found { place: Vector::new(x * radius, y * radius, at.z), normal, cos_theta_o, is_inexact })
    }

    /// k.
    #[inline(always)]
    fn slope<T: Scalar>(&self) -> T {
        (T::from_f64(self.radii[1]) - T::from_f64(self.radii[0])) / T::from_precise(self.height)
    }

    /// The distance from the surface, negative inside.
    #[must_use]
    pub fn signed_distance(&self, point: Vector) -> f64 {
        let place = self.placement.place_of(point);
        let from_axis = place.x.hypot(place.y);
        let (nearest, _) = self.nearest_in_section(from_axis, place.z);
        let distance = (from_axis - nearest[0]).hypot(place.z - nearest[1]);
        let height = self.height.rounded();
        let radius = self.slope::<f64>().mul_add(place.z, self.radii[0]);
        let is_inside = place.z > 0.0 && place.z < height && from_axis < radius;
        if is_inside { -distance } else { distance }
    }

    /// The surface point nearest to a point.
    #[must_use]
    pub fn nearest(&self, point: Vector) -> NearestPoint {
        let place = self.placement.place_of(point);
        let from_axis = place.x.hypot(place.y);
        let [x, y] = if from_axis > 0.0 { [place.x / from_axis, place.y / from_axis] } else { [1.0, 0.0] };
        let (nearest, normal) = self.nearest_in_section(from_axis, place.z);
        let turned = |[across, along]: [f64; 2]| self.placement.to_scene(Vector::new(x * across, y * across, along));
        NearestPoint::new(self.placement.origin, turned(nearest), turned(normal))
    }

    /// The nearest point on the outline of half a section through the axis, as (distance from the axis, z), and the normal
    /// there.
    fn nearest_in_section(&self, from_axis: f64, z: f64) -> ([f64; 2], [f64; 2]) {
        let [base, end] = self.radii;
        let height = self.height.rounded();
        let (run, rise) = (end - base, height);
        let length = run.hypot(rise);
        let along = (((from_axis - base) * run + z * rise) / (length * length)).clamp(0.0, 1.0);
        let candidates = [
            ([base + run * along, rise * along], [rise / length, -run / length]),
            ([from_axis.min(base), 0.0], [0.0, -1.0]),
            ([from_axis.min(end), height], [0.0, 1.0]),
        ];
        let distance = |[x, y]: [f64; 2]| (from_axis - x).hypot(z - y);
        let least = candidates.iter().map(|(at, _)| distance(*at)).fold(f64::INFINITY, f64::min);
        // At a rim, where two faces are equally near, choose the face that the point is in front of.
        let before = |(at, normal): &([f64; 2], [f64; 2])| (from_axis - at[0]) * normal[0] + (z - at[1]) * normal[1];
        let nearest = candidates.into_iter().filter(|(at, _)| distance(*at) <= least * (1.0 + 1e-12));
        nearest.max_by(|first, second| before(first).total_cmp(&before(second))).unwrap_or(candidates[0])
    }

    /// Its bounding box, with sides along the scene's axes.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        let axis = self.placement.axis(2);
        let [base, end] = self.ends();
        Bounds::of_disk(base, axis, self.radii[0]).union(Bounds::of_disk(end, axis, self.radii[1]))
    }

    /// The centres of the base and of the other end, in metres.
    #[must_use]
    pub fn ends(&self) -> [Vector; 2] {
        [self.placement.origin, self.apex]
    }

    /// The radii at the base and at the other end, in metres.
    #[must_use]
    pub fn radii(&self) -> [f64; 2] {
        self.radii
    }

    /// The radius of the ball around the centre of the base that contains it, in metres.
    #[must_use]
    pub fn size(&self) -> f64 {
        self.radii[0].max(self.height.rounded().hypot(self.radii[1]))
    }

    /// The distance of a point, in units of the larger radius or the height, whichever is smaller.
    #[must_use]
    pub fn relative_distance(&self, point: Vector) -> f64 {
        let widest = self.radii[0].max(self.radii[1]);
        (point - self.placement.origin).length() / self.height.rounded().min(widest)
    }

    /// The values that describe it.
    #[must_use]
    pub fn measures(&self) -> Vec<(&'static str, Measure)> {
        let ([base, apex], [radius, apex_radius]) = (self.ends(), self.radii);
        vec![
            ("base", Measure::Vector(base)),
            ("apex", Measure::Vector(apex)),
            ("radius", Measure::Number(radius)),
            ("apex radius", Measure::Number(apex_radius)),
        ]
    }
}

/// Where F < 0, on the side of the apex where R > 0; beyond the apex, the flat end cuts it off. `None` if F is constant
/// along the ray: on a ray along the axis of a cylinder, or one through the apex.
fn side_span<T: Scalar>(
    quadratic: T,
    half_linear: T,
    constant: T,
    root: T,
    narrowing: T,
    crossing: impl Fn(T) -> Crossing<T>,
) -> Option<Span<T>> {
    let never = |side: f64| Crossing { at: T::from_f64(NEVER * side), error: 0.0, face: SIDE };
    let is_negative = half_linear.rounded() < 0.0;
    // The root that adds two numbers of the same sign, and the other one from the product of both.
    let sum = if is_negative { root - half_linear } else { -(root + half_linear) };
    if sum.rounded() == 0.0 {
        return None;
    }
    let near = constant / sum;
    let from = |at| Span { enter: crossing(at), leave: never(1.0) };
    let until = |at| Span { enter: never(-1.0), leave: crossing(at) };
    if quadratic.rounded() == 0.0 {
        return Some(if is_negative { from(near) } else { until(near) });
    }
    let far = sum / quadratic;
    let (first, last) = if near.is_less(far) { (near, far) } else { (far, near) };
    Some(if quadratic.rounded() > 0.0 {
        Span { enter: crossing(first), leave: crossing(last) }
    } else if narrowing.rounded() > 0.0 {
        from(last)
    } else {
        until(first)
    })
}
