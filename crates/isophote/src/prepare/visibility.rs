//! Shadows: which lights a surface point sees.

use super::tracing::least;
use super::{ERROR_OF_DISTANCE, Hit, PreparedScene};
use crate::light::Emitter;
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::shape::{Accuracy, Intersection, Primitive, SurfacePoint};
use crate::vector::Vector;

/// What stands between a surface point and a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Blocking {
    /// The blocking primitive that is nearest to the point, if any.
    pub blocker: Option<Primitive>,
    /// Whether more digits could change the answer: the light is seen close to an edge.
    pub is_doubtful: bool,
}

impl Blocking {
    pub(super) const NONE: Self = Self { blocker: None, is_doubtful: false };
}

/// Whether a primitive blocks a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Blocks {
    /// It does.
    Surely,
    /// More digits are needed to tell.
    Maybe,
    /// It does not.
    Not,
}

impl PreparedScene {
    /// What stands between a hit and an emitter; if anything does, v of (3.1) is 0.
    ///
    /// The primitive that was hit is never traced, so no minimum distance from it is needed, at any scale: a convex
    /// primitive does not hide what is above its horizon, and what is below gets no light anyway. From inside, it hides
    /// every light that it does not enclose, with or without shadows.
    pub fn blocking<T: Scalar>(&self, hit: &Hit<T>, emitter: usize) -> Blocking {
        let source = &self.emitters.all()[emitter];
        let own = hit.primitive;
        if hit.from_inside && !self.encloses(own, source) {
            return Blocking { blocker: Some(own), is_doubtful: false };
        }
        if !self.scene.casts_shadows(own.shape, source.light) {
            return Blocking::NONE;
        }
        self.blocking_from(&[own], &hit.point, hit.shadow_ray_offset, emitter)
    }

    /// What stands between a point and an emitter, apart from the `own` primitives that the point lies on.
    pub(super) fn blocking_from<T: Scalar>(
        &self,
        own: &[Primitive],
        point: &SurfacePoint<T>,
        shadow_ray_offset: Vector<T>,
        emitter: usize,
    ) -> Blocking {
        self.shadow_ray(point, shadow_ray_offset, emitter)
            .map_or(Blocking::NONE, |(ray, distance)| self.nearest_blocker(own, &ray, distance))
    }

    /// The ray from a point to an emitter, and its length unless the emitter is a parallel one; `None` if the emitter is below
    /// the horizon.
    pub(crate) fn shadow_ray<T: Scalar>(
        &self,
        point: &SurfacePoint<T>,
        shadow_ray_offset: Vector<T>,
        emitter: usize,
    ) -> Option<(Ray<T>, Option<T>)> {
        let source = &self.emitters.all()[emitter];
        let from_point = source.from_place(point.anchor, point.offset);
        if !T::zero().is_less(point.normal.dot(from_point)) {
            return None;
        }
        // Not beyond a light that is closer than the offset is long.
        let (reach, offset) = (from_point.dot(from_point), shadow_ray_offset.dot(shadow_ray_offset));
        let is_close = source.place().is_some() && reach.is_less(T::from_f64(4.0) * offset);
        let part = if is_close { T::from_f64(0.5) * (reach / offset).sqrt() } else { T::from_f64(1.0) };
        let start = point.offset + shadow_ray_offset * part;
        let to_light = source.from_place(point.anchor, start);
        let distance = to_light.length();
        let direction = to_light * (T::from_f64(1.0) / distance);
        let ray = Ray { anchor: Vector::from_f64(point.anchor), offset: start, direction };
        Some((ray, source.place().map(|_| distance)))
    }

    /// Whether an emitter is inside a primitive. A parallel light is outside every shape.
    pub(crate) fn encloses(&self, primitive: Primitive, emitter: &Emitter) -> bool {
        let geometry = &self.shapes[primitive.shape].geometry;
        emitter.place().is_some_and(|place| geometry.part_encloses(primitive.part, place))
    }

    /// Whether a primitive blocks the light of a ray that does not start on it; the light is at this distance, if at any.
    pub(crate) fn blocks(&self, primitive: Primitive, ray: &Ray, distance: Option<f64>) -> Blocks {
        let geometry = &self.shapes[primitive.shape].geometry;
        let Intersection { hit, doubtful_from } = geometry.intersect(primitive.part, ray, Accuracy::OF_VISIBILITY);
        let is_before = |at: f64, part: f64| distance.is_none_or(|distance| at < distance * part);
        let at = hit.map(|hit| hit.distance);
        let is_certain = |at: f64| doubtful_from.is_none_or(|from| at < from);
        if at.is_some_and(|at| is_before(at, 1.0 - ERROR_OF_DISTANCE) && is_certain(at)) {
            Blocks::Surely
        } else if at.into_iter().chain(doubtful_from).any(|at| is_before(at, 1.0 + ERROR_OF_DISTANCE)) {
            Blocks::Maybe
        } else {
            Blocks::Not
        }
    }

    /// What stands between the start of a ray, on its `own` primitives, and a light at this distance; without a distance (a
    /// parallel light), the light is beyond everything.
    pub(super) fn nearest_blocker<T: Scalar>(&self, own: &[Primitive], ray: &Ray<T>, distance: Option<T>) -> Blocking {
        let Obstacle { nearest, is_doubtful } = self.nearest_obstacle(own, ray, distance);
        Blocking { blocker: nearest.map(|(_, primitive)| primitive), is_doubtful }
    }

    /// The offset of a hit's shadow rays, shortened where something is in the way: their start must not be beyond what stands
    /// close to the surface. Also whether more digits could change it.
    pub(crate) fn clear_shadow_ray_offset<T: Scalar>(&self, hit: &Hit<T>) -> (Vector<T>, bool) {
        let offset = hit.shadow_ray_offset;
        let length = offset.length();
        if !T::zero().is_less(length) || !self.casts_shadows_between_shapes() {
            return (offset, false);
        }
        let direction = offset * (T::from_f64(1.0) / length);
        let ray = Ray { anchor: Vector::from_f64(hit.point.anchor), offset: hit.point.offset, direction };
        let Obstacle { nearest, is_doubtful } = self.nearest_obstacle(&[hit.primitive], &ray, Some(length));
        let clear = nearest.map_or(offset, |(at, _)| direction * (T::from_f64(0.5) * at));
        (clear, is_doubtful)
    }

    fn nearest_obstacle<T: Scalar>(&self, own: &[Primitive], ray: &Ray<T>, distance: Option<T>) -> Obstacle<T> {
        // Anything closer to the light than this may as well be behind it.
        let bounds = |distance: T| {
            let uncertain = distance * T::from_f64(ERROR_OF_DISTANCE);
            [distance - uncertain, distance, distance + uncertain]
        };
        let bounds = distance.map(bounds);
        let mut nearest: Option<(T, Primitive)> = None;
        let mut doubtful_from: Option<T> = None;
        let is_neighbour = |primitive: Primitive, at: T| {
            let least = |own: &Primitive| self.shapes[own.shape].geometry.least_shadow_distance();
            own.iter().any(|own| own.shape == primitive.shape && at.is_less(T::from_f64(least(own))))
        };
        let farthest = distance.map_or(f64::INFINITY, T::rounded);
        self.along_ray(ray, farthest, |primitive| {
            // Nothing matters beyond a certain blocker, nor behind the light.
            let limit = |nearest: Option<(T, Primitive)>| nearest.map_or(farthest, |(at, _)| at.rounded());
            if own.contains(&primitive) || !self.scene.shapes[primitive.shape].casts_shadow {
                return limit(nearest);
            }
            let intersection =
                self.shapes[primitive.shape].geometry.intersect(primitive.part, ray, Accuracy::OF_VISIBILITY);
            let is_before_light = |at: &T| bounds.is_none_or(|[_, _, last]| at.is_less(last));
            doubtful_from = least(doubtful_from, intersection.doubtful_from.filter(is_before_light));
            let Some(at) = intersection.hit.map(|hit| hit.distance) else { return limit(nearest) };
            if is_neighbour(primitive, at) || bounds.is_some_and(|[_, distance, _]| !at.is_less(distance)) {
                return limit(nearest);
            }
            if bounds.is_some_and(|[first, ..]| first.is_less(at)) {
                doubtful_from = least(doubtful_from, Some(at));
            }
            if nearest.is_none_or(|(nearest, _)| at.is_less(nearest)) {
                nearest = Some((at, primitive));
            }
            limit(nearest)
        });
        // Beyond a certain blocker, doubt does not matter.
        let blocks_for_sure = |from: T| nearest.is_some_and(|(at, _)| at.is_less(from));
        let is_doubtful = doubtful_from.is_some_and(|from| !blocks_for_sure(from));
        Obstacle { nearest, is_doubtful }
    }
}

/// What a ray meets first on its way to a light.
struct Obstacle<T> {
    /// Its distance from the start of the ray, in metres.
    nearest: Option<(T, Primitive)>,
    is_doubtful: bool,
}
