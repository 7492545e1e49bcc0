//! What rays from the eye hit first.

use super::{Hit, PreparedScene, PreparedShape};
use crate::camera::{ScreenPosition, Sight};
use crate::double_double::DoubleDouble;
use crate::map::Pixel;
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::shape::{Accuracy, Intersection, Primitive};
use crate::vector::Vector;

impl PreparedScene {
    /// What the ray through a screen position hits first (2.1), (2.2).
    ///
    /// The error of cosθ_o in double precision grows without bound towards the silhouette; rays that pass near it are traced
    /// again with 32 digits, so that the error bound holds at every visible pixel.
    #[must_use]
    pub fn trace(&self, position: ScreenPosition) -> Option<Hit> {
        let Traced { hit, is_doubtful } = self.nearest(&self.frame.ray(position)?);
        if is_doubtful { self.trace_precisely(position).map(Hit::rounded) } else { hit }
    }

    /// What the ray through a screen position hits first, with 32 digits.
    #[must_use]
    pub fn trace_precisely(&self, position: ScreenPosition) -> Option<Hit<DoubleDouble>> {
        self.nearest(&self.precise_frame.ray(position)?).hit
    }

    /// Where a ray hits a primitive; `None` if a double is not enough, or if it misses.
    pub(crate) fn hit_on(&self, primitive: Primitive, ray: &Ray) -> Option<Hit> {
        let geometry = &self.shapes[primitive.shape].geometry;
        let Intersection { hit, doubtful_from } = geometry.intersect(primitive.part, ray, self.accuracy(primitive));
        hit.filter(|hit| doubtful_from.is_none_or(|from| hit.distance < from)).map(|hit| Hit::of(primitive, hit))
    }

    /// Where the ray through a screen position hits a primitive, with 32 digits.
    pub(crate) fn precise_hit_on(&self, primitive: Primitive, position: ScreenPosition) -> Option<Hit> {
        let geometry = &self.shapes[primitive.shape].geometry;
        let ray = self.precise_frame.ray(position)?;
        let hit = geometry.intersect(primitive.part, &ray, Accuracy::OF_VISIBILITY).hit?;
        Some(Hit::of(primitive, hit).rounded())
    }

    /// Whether a primitive has a highlight that is sharper than this.
    pub(crate) fn has_sharper_highlight(&self, primitive: Primitive, shininess: f64) -> bool {
        self.prepared_formula(primitive).formula.sharpness().is_some_and(|n| n > shininess)
    }

    /// What a pixel of the full image sees.
    #[must_use]
    pub fn trace_pixel(&self, pixel: Pixel) -> Option<Hit> {
        self.trace(ScreenPosition::PixelCenter(pixel))
    }

    /// What the eye sees first in the direction of a point, whether that is on the screen or not.
    #[must_use]
    pub fn first_towards(&self, point: Vector) -> Option<Primitive> {
        let Sight { start, view, .. } = self.frame.sight(point, Vector::default());
        let ray = Ray { anchor: start, offset: Vector::default(), direction: -view };
        self.nearest(&ray).hit.map(|hit| hit.primitive)
    }

    /// Where a line from a point meets another shape than one, which it may leave first. Double precision is enough to find a
    /// place, though not to shade it.
    pub(crate) fn first_beyond(&self, shape: usize, point: Vector, direction: Vector) -> Option<Vector> {
        let ray = Ray { anchor: point, offset: Vector::default(), direction };
        let mut search = Search::new(self, &ray);
        let beyond = |primitive: Primitive| {
            if primitive.shape == shape { search.reach() } else { search.test(primitive) }
        };
        self.along_ray(&ray, f64::INFINITY, beyond);
        search.finish().hit.map(|hit| point + direction * hit.distance)
    }

    /// Visits the primitives that a ray may hit, roughly from near to far; `test` returns the distance up to which the
    /// search goes on. With only a handful of primitives, all of them are visited.
    pub(super) fn along_ray<T: Scalar>(&self, ray: &Ray<T>, limit: f64, mut test: impl FnMut(Primitive) -> f64) {
        if self.tries_all_primitives() {
            self.primitives().for_each(|primitive| {
                test(primitive);
            });
            return;
        }
        let vector = |vector: Vector<T>| vector.map(T::rounded);
        let start = vector(ray.anchor) + vector(ray.offset);
        self.accelerator().along_ray(start, vector(ray.direction), limit, |number| test(self.primitive(number)));
    }

    /// Whether rays try each primitive, without a tree.
    pub(crate) fn tries_all_primitives(&self) -> bool {
        self.primitive_count() <= self.linear_search_max
    }

    /// How accurate a hit of a ray from the eye must be.
    pub(crate) fn accuracy(&self, primitive: Primitive) -> Accuracy {
        self.prepared_formula(primitive).accuracy
    }

    /// All primitives.
    fn primitives(&self) -> impl Iterator<Item = Primitive> {
        let parts = |(shape, prepared): (usize, &PreparedShape)| {
            (0..prepared.geometry.parts()).map(move |part| Primitive { shape, part })
        };
        self.shapes.iter().enumerate().flat_map(parts)
    }

    fn nearest<T: Scalar>(&self, ray: &Ray<T>) -> Traced<T> {
        let mut search = Search::new(self, ray);
        self.along_ray(ray, f64::INFINITY, |primitive| search.test(primitive));
        let mut traced = search.finish();
        if let Some(hit) = &mut traced.hit {
            let (offset, is_doubtful) = self.clear_shadow_ray_offset(hit);
            hit.shadow_ray_offset = offset;
            traced.is_doubtful |= is_doubtful;
        }
        traced
    }
}

/// A search for the nearest primitive; the order in which primitives are tested does not matter.
struct Search<'s, T> {
    scene: &'s PreparedScene,
    ray: &'s Ray<T>,
    nearest: Option<Hit<T>>,
    doubtful_from: Option<T>,
}

impl<'s, T: Scalar> Search<'s, T> {
    fn new(scene: &'s PreparedScene, ray: &'s Ray<T>) -> Self {
        Self { scene, ray, nearest: None, doubtful_from: None }
    }

    /// Tests a primitive; returns the distance beyond which nothing matters any more.
    fn test(&mut self, primitive: Primitive) -> f64 {
        let accuracy = self.scene.accuracy(primitive);
        let intersection = self.scene.shapes[primitive.shape].geometry.intersect(primitive.part, self.ray, accuracy);
        self.doubtful_from = least(self.doubtful_from, intersection.doubtful_from);
        if let Some(hit) = intersection.hit {
            let ahead_by = self.nearest.map(|nearest| (nearest.distance - hit.distance, nearest.primitive));
            // Where surfaces cross, the order of their distances is as uncertain as the distances themselves.
            let uncertain = T::from_f64(ERROR_OF_DISTANCE) * hit.distance;
            if ahead_by.is_some_and(|(by, _)| by.is_less(uncertain) && (-uncertain).is_less(by)) {
                self.doubtful_from = least(self.doubtful_from, Some(hit.distance - uncertain));
            }
            // Of coincident surfaces, the first one in the scene is seen.
            let is_nearer = |(by, other): (T, Primitive)| {
                T::zero().is_less(by)
                    || !by.is_less(T::zero()) && (primitive.shape, primitive.part) < (other.shape, other.part)
            };
            if ahead_by.is_none_or(is_nearer) {
                self.nearest = Some(Hit::of(primitive, hit));
            }
        }
        self.reach()
    }

    /// The distance beyond which nothing matters any more.
    fn reach(&self) -> f64 {
        self.nearest.map_or(f64::INFINITY, |hit| hit.distance.rounded())
    }

    fn finish(self) -> Traced<T> {
        let is_beyond = |from: T| self.nearest.is_some_and(|hit| hit.distance.is_less(from));
        Traced { hit: self.nearest, is_doubtful: self.doubtful_from.is_some_and(|from| !is_beyond(from)) }
    }
}

/// What a search for the nearest shape found, and whether the number type was accurate enough for it.
struct Traced<T> {
    hit: Option<Hit<T>>,
    is_doubtful: bool,
}

/// Distances whose relative difference is smaller than this are compared with 32 digits.
pub(crate) const ERROR_OF_DISTANCE: f64 = 1e-12;

/// The smaller of two optional numbers.
pub(super) fn least<T: Scalar>(first: Option<T>, second: Option<T>) -> Option<T> {
    match (first, second) {
        (Some(first), Some(second)) => Some(T::select(second.is_less(first), second, first)),
        (first, second) => first.or(second),
    }
}
