//! Points of a plane that need not lie on a shape, such as those of a grid.

use std::cell::OnceCell;

use super::obstruction::{AmbientShare, sampled};
use super::{Blocking, PreparedScene};
use crate::double_double::DoubleDouble;
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::shape::{NearestPoint, Primitive, SurfacePoint};
use crate::vector::Vector;

/// The surfaces that a free point happens to lie on: a grid may lie on a floor. They do not block its light, except for
/// closed ones, which hide whatever is behind their surface but not inside them.
struct Touched {
    own: Vec<Primitive>,
    /// The closed ones that cast shadows, with the normal there.
    walls: Vec<(Primitive, NearestPoint)>,
}

/// What is known about the light at a free point, independent of the strength of the lights.
pub(crate) struct LightAtPoint {
    touched: Touched,
    precise: OnceCell<SurfacePoint<DoubleDouble>>,
}

impl LightAtPoint {
    /// Whether the point lies on one surface at most, which hides nothing.
    pub(crate) fn is_plain(&self) -> bool {
        self.touched.own.len() <= 1 && self.touched.walls.is_empty()
    }

    /// The primitive that it lies on, the first one of several.
    pub(crate) fn primitive(&self) -> Option<Primitive> {
        self.touched.own.first().copied()
    }
}

impl PreparedScene {
    /// The surroundings of a point.
    pub(crate) fn light_at(&self, point: &SurfacePoint) -> LightAtPoint {
        LightAtPoint { touched: self.touched(point.position()), precise: OnceCell::new() }
    }

    /// v of an emitter at a point.
    pub(crate) fn visibility_at(&self, light: &LightAtPoint, point: &SurfacePoint, emitter: usize) -> f64 {
        let LightAtPoint { touched, precise, .. } = light;
        let Blocking { mut blocker, is_doubtful } = self.free_point_blocking(touched, point, emitter);
        if is_doubtful {
            let precise = precise.get_or_init(|| point.map(DoubleDouble::from_f64));
            blocker = self.free_point_blocking(touched, precise, emitter).blocker;
        }
        if blocker.is_some() { 0.0 } else { 1.0 }
    }

    fn free_point_blocking<T: Scalar>(&self, touched: &Touched, point: &SurfacePoint<T>, emitter: usize) -> Blocking {
        let source = &self.emitters.all()[emitter];
        if !self.scene.shadows || !self.scene.lights[source.light].casts_shadows {
            return Blocking::NONE;
        }
        let to_light = source.from_place(point.anchor, point.offset).map(T::rounded);
        if let Some(wall) = self.wall_before(touched, to_light, source.place()) {
            return Blocking { blocker: Some(wall), is_doubtful: false };
        }
        self.blocking_from(&touched.own, point, Vector::zero(), emitter)
    }

    /// The part of the ambient light that arrives at a point.
    pub(crate) fn ambient_share_at(&self, light: &LightAtPoint, point: &SurfacePoint) -> AmbientShare {
        let LightAtPoint { touched, .. } = light;
        if self.scene.ambient.is_none() {
            return AmbientShare::ALL;
        }
        let sees_the_environment = |direction: Vector| {
            let ray = Ray { anchor: point.anchor, offset: point.offset, direction };
            self.wall_before(touched, direction, None).is_none() && self.sees_environment(&touched.own, &ray)
        };
        sampled(self.obstructed_hemisphere(false), point.normal, sees_the_environment)
    }

    /// The closed shape that hides a target in a direction (at a place, or infinitely far away) because the target is behind
    /// its surface.
    fn wall_before(&self, touched: &Touched, direction: Vector, place: Option<Vector>) -> Option<Primitive> {
        let hides = |(wall, nearest): &&(Primitive, NearestPoint)| {
            let geometry = &self.shapes[wall.shape].geometry;
            let is_inside = place.is_some_and(|place| geometry.part_encloses(wall.part, place));
            nearest.outward_normal.dot(direction) <= 0.0 && !is_inside
        };
        touched.walls.iter().find(hides).map(|(wall, _)| *wall)
    }

    fn touched(&self, point: Vector) -> Touched {
        let mut touched = Touched { own: Vec::new(), walls: Vec::new() };
        let is_obstructed = self.scene.ambient.as_ref().is_some_and(|ambient| ambient.obstruction.is_some());
        if !self.scene.shadows && !is_obstructed {
            return touched;
        }
        for (primitive, nearest) in self.touched_at(point) {
            touched.own.push(primitive);
            let Primitive { shape, .. } = primitive;
            if self.shapes[shape].geometry.is_closed() && self.scene.shapes[shape].casts_shadow {
                touched.walls.push((primitive, nearest));
            }
        }
        touched
    }
}
