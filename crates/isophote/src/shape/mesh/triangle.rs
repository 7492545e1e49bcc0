//! One triangle of a mesh (2.5).

use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::shape::{Accuracy, Intersection, NearestPoint, PLACE_ERROR, ShapeHit, SurfacePoint};
use crate::vector::Vector;

/// Three corners and, for smooth shading, a normal at each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// In metres.
    pub corners: [Vector; 3],
    /// Unit vectors, or zero for none.
    pub normals: Option<[Vector; 3]>,
}

/// Where a ray crosses the plane of a triangle, as weights of its corners.
struct Crossing<T> {
    /// The weights of the corners; they sum to 1.
    weights: [T; 3],
    /// The distance, in metres.
    distance: T,
    /// The possible rounding error of a weight: a quarter of the bound that decides between hit and miss.
    error: f64,
}

impl Triangle {
    /// Projects the corners along the ray: in the plane across it, the test is on which side of the ray each of the three
    /// edges lies, and the same products give the weights of the corners (2.5).
    ///
    /// The result for an edge depends only on its two corners and the ray, and the neighbour that shares the edge computes
    /// the same number with the opposite sign: since ties count as hits, a ray cannot slip between the two (Woop, Benthin
    /// and Wald, "Watertight ray/triangle intersection", JCGT 2(1), 2013).
    pub fn intersect<T: Scalar>(&self, ray: &Ray<T>, accuracy: Accuracy, mesh_size: f64) -> Intersection<T> {
        let (crossing, doubtful_from) = self.cross(ray);
        let Some(crossing) = crossing else {
            return Intersection { hit: None, doubtful_from: doubtful_from.map(T::from_f64) };
        };
        let sides = self.sides::<T>();
        let weights = crossing.weights;
        let offset = sides[0] * weights[1] + sides[1] * weights[2];
        let across = sides[0].cross(sides[1]);
        let face = across.normalized();
        let is_back = T::zero().is_less(face.dot(ray.direction));
        let longest = sides[0].length().rounded().max(sides[1].length().rounded());
        let mut normal_error = 3.0 * f64::EPSILON * longest * longest / across.length().rounded();
        let (normal, shadow_ray_offset) = match self.normals {
            None => (if is_back { -face } else { face }, Vector::zero()),
            Some(normals) => {
                let spread = (normals[1] - normals[0]).length().max((normals[2] - normals[0]).length());
                normal_error = normal_error.min(4.0 * f64::EPSILON) + crossing.error * spread;
                let smooth = self.smooth(face, &weights, is_back);
                (smooth.normal, self.shadow_ray_offset(&smooth, &weights, offset))
            }
        };
        let cos_theta_o = -normal.dot(ray.direction);
        let place_error = crossing.error * longest / mesh_size;
        let faces_away_by_rounding = cos_theta_o.rounded().abs() < 4.0 * (normal_error + f64::EPSILON);
        let is_inexact = accuracy.is_exceeded_by(place_error, normal_error) || faces_away_by_rounding;
        let point = SurfacePoint { anchor: self.corners[0], offset, normal, view: -ray.direction, cos_theta_o };
        let doubtful_from = doubtful_from.map(T::from_f64).or(is_inexact.then_some(crossing.distance));
        let hit = ShapeHit { distance: crossing.distance, point, from_inside: false, shadow_ray_offset };
        Intersection { hit: Some(hit), doubtful_from }
    }

    /// Where the ray crosses the triangle, and the distance from which that is doubtful.
    fn cross<T: Scalar>(&self, ray: &Ray<T>) -> (Option<Crossing<T>>, Option<f64>) {
        let corners = self.corners.map(|corner| (-ray.start_from(corner)).to_array());
        let direction = ray.direction.to_array();
        let steepness = direction.map(|component| component.rounded().abs());
        // The dominant axis of the ray: the other two are sheared so that the ray runs straight along it.
        let ahead = (0..3).max_by(|first, second| steepness[*first].total_cmp(&steepness[*second])).unwrap_or(0);
        let [right, up] = [(ahead + 1) % 3, (ahead + 2) % 3];
        let inverse = T::from_f64(1.0) / direction[ahead];
        let shear = [direction[right] * inverse, direction[up] * inverse];
        let seen = corners.map(|c| [c[right] - shear[0] * c[ahead], c[up] - shear[1] * c[ahead]]);
        let edge = |from: usize, to: usize| seen[to][0] * seen[from][1] - seen[to][1] * seen[from][0];
        let edges = [edge(1, 2), edge(2, 0), edge(0, 1)];
        let largest = |values: &[T]| values.iter().fold(0.0_f64, |largest, value| largest.max(value.rounded().abs()));
        let reach = corners.iter().map(|corner| largest(corner)).fold(0.0, f64::max);
        let width = seen.iter().map(|corner| largest(corner)).fold(0.0, f64::max);
        let error = 2.0 * PLACE_ERROR * reach * width;
        let depths = corners.map(|corner| (corner[ahead] * inverse).rounded());
        let [least, greatest] =
            [depths.into_iter().fold(f64::INFINITY, f64::min), depths.into_iter().fold(f64::NEG_INFINITY, f64::max)];
        let doubles = edges.map(T::rounded);
        let is_beside = doubles.iter().any(|edge| *edge < -error) && doubles.iter().any(|edge| *edge > error);
        if is_beside || greatest < -2.0 * PLACE_ERROR * reach {
            return (None, None);
        }
        let is_within = doubles.iter().all(|edge| *edge > error) || doubles.iter().all(|edge| *edge < -error);
        let whole = edges[0] + edges[1] + edges[2];
        let error = error / whole.rounded().abs();
        let weights = edges.map(|edge| edge * (T::from_f64(1.0) / whole));
        let distance =
            (corners[0][ahead] * weights[0] + corners[1][ahead] * weights[1] + corners[2][ahead] * weights[2])
                * inverse;
        let distance_error = 4.0 * PLACE_ERROR * reach + error * (greatest - least);
        let starts_here = !(distance.rounded().abs() > distance_error);
        let doubtful_from = (!is_within || starts_here).then(|| (least - distance_error).max(0.0));
        let is_hit =
            edges.iter().all(|edge| !edge.is_less(T::zero())) || edges.iter().all(|edge| !T::zero().is_less(*edge));
        let is_seen = is_hit && whole.rounded() != 0.0 && T::zero().is_less(distance);
        (is_seen.then_some(Crossing { weights, distance, error: 0.25 * error }), doubtful_from)
    }

    /// The vectors from the first corner to the others.
    #[inline(always)]
    fn sides<T: Scalar>(&self) -> [Vector<T>; 2] {
        let from_first = |corner: usize| Vector::from_f64(self.corners[corner]) - Vector::from_f64(self.corners[0]);
        [from_first(1), from_first(2)]
    }

    /// The normals of the corners, interpolated by the weights. They determine which side of the triangle is the front; then
    /// all of them are turned to the viewer's side together.
    fn smooth<T: Scalar>(&self, face: Vector<T>, weights: &[T; 3], is_back: bool) -> Smooth<T> {
        let given = self.normals.map_or([face; 3], |normals| normals.map(Vector::from_f64));
        let has_none = |normal: Vector<T>| normal.dot(normal).rounded() == 0.0;
        let filled = given.map(|normal| if has_none(normal) { face } else { normal });
        let mixed = filled[0] * weights[0] + filled[1] * weights[1] + filled[2] * weights[2];
        // Normals that cancel each other carry no information.
        let (corners, mixed) = if mixed.dot(mixed).rounded() < 1e-12 { ([face; 3], face) } else { (filled, mixed) };
        let faces_other_side = mixed.dot(face).is_less(T::zero());
        let turn = |normal: Vector<T>| if is_back == faces_other_side { normal } else { -normal };
        Smooth { normal: turn(mixed.normalized()), corners: corners.map(turn) }
    }

    /// The offset from the triangle to the smooth surface that its normals suggest: above the tangent planes of all three
    /// corners. Shadow rays start there, or the triangles themselves would show at the terminator (Hanika, "Hacking the
    /// shadow terminator", Ray Tracing Gems II, 2021).
    fn shadow_ray_offset<T: Scalar>(&self, smooth: &Smooth<T>, weights: &[T; 3], offset: Vector<T>) -> Vector<T> {
        let [second, third] = self.sides();
        let mut shadow_ray_offset = Vector::zero();
        for ((corner, normal), weight) in [Vector::zero(), second, third].into_iter().zip(smooth.corners).zip(weights) {
            let below = (-(offset - corner).dot(normal)).max(T::zero());
            shadow_ray_offset = shadow_ray_offset + normal * (below * *weight);
        }
        shadow_ray_offset
    }

    /// The distance of a point.
    pub fn distance(&self, point: Vector) -> f64 {
        let place = point - self.corners[0];
        (place - self.nearest_place(place).1).length()
    }

    /// The point of it nearest to a given point, with its front outward.
    pub fn nearest(&self, point: Vector) -> NearestPoint {
        let (weights, offset) = self.nearest_place(point - self.corners[0]);
        let [second, third] = self.sides::<f64>();
        let face = second.cross(third).normalized();
        let [front, back] = [false, true].map(|is_back| self.smooth(face, &weights, is_back));
        let [shadow_ray_offset, shadow_ray_offset_behind] = if self.normals.is_some() {
            [&front, &back].map(|smooth| self.shadow_ray_offset(smooth, &weights, offset))
        } else {
            [Vector::default(); 2]
        };
        let outward_normal = front.normal;
        NearestPoint {
            part: 0,
            anchor: self.corners[0],
            offset,
            outward_normal,
            face_normal: face,
            shadow_ray_offset,
            shadow_ray_offset_behind,
        }
    }

    /// The weights of the nearest point and its position relative to the first corner, found from the region in which the
    /// point lies (Ericson, "Real-time collision detection", 5.1.5).
    fn nearest_place(&self, place: Vector) -> ([f64; 3], Vector) {
        let [b, c] = self.sides::<f64>();
        let (to_a, to_b, to_c) = (place, place - b, place - c);
        let [a1, a2] = [b.dot(to_a), c.dot(to_a)];
        let [b1, b2] = [b.dot(to_b), c.dot(to_b)];
        let [c1, c2] = [b.dot(to_c), c.dot(to_c)];
        let (beyond_ab, beyond_ac, beyond_bc) = (a1 * b2 - b1 * a2, c1 * a2 - a1 * c2, b1 * c2 - c1 * b2);
        let [second, third] = if a1 <= 0.0 && a2 <= 0.0 {
            [0.0, 0.0]
        } else if b1 >= 0.0 && b2 <= b1 {
            [1.0, 0.0]
        } else if c2 >= 0.0 && c1 <= c2 {
            [0.0, 1.0]
        } else if beyond_ab <= 0.0 && a1 >= 0.0 && b1 <= 0.0 {
            [a1 / (a1 - b1), 0.0]
        } else if beyond_ac <= 0.0 && a2 >= 0.0 && c2 <= 0.0 {
            [0.0, a2 / (a2 - c2)]
        } else if beyond_bc <= 0.0 && b2 >= b1 && c1 >= c2 {
            let along = (b2 - b1) / ((b2 - b1) + (c1 - c2));
            [1.0 - along, along]
        } else {
            let whole = beyond_ab + beyond_ac + beyond_bc;
            [beyond_ac / whole, beyond_ab / whole]
        };
        ([1.0 - second - third, second, third], b * second + c * third)
    }
}

/// The normals on the viewer's side.
struct Smooth<T> {
    /// Interpolated, a unit vector.
    normal: Vector<T>,
    /// The normals of the corners.
    corners: [Vector<T>; 3],
}
