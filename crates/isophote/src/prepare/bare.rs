//! Points of a plane that need not be a shape's, such as those of a grid.

use std::cell::OnceCell;

use super::{Blocking, PreparedScene};
use crate::double_double::DoubleDouble;
use crate::real::Scalar;
use crate::shade::{LightTerm, Shading, shade};
use crate::shape::{NearestPoint, Primitive, SurfacePoint};
use crate::vector::Vector;

/// A surface on which a bare point happens to lie.
struct Touched {
    shape: usize,
    nearest: NearestPoint,
}

impl PreparedScene {
    /// What arrives from the lights (3.1) at a point that has a side but is no shape's; `each` sees every light's own
    /// term.
    ///
    /// Every shape may stand in its light but those on whose surface it lies: a grid may lie on a floor. Of these, a
    /// closed one hides what is behind its surface and not inside it.
    pub fn illuminate(&self, point: &SurfacePoint, each: impl FnMut(usize, &LightTerm)) -> Shading {
        let touched = self.touched(point.position());
        let precise = OnceCell::new();
        let visibility = |light| {
            let Blocking { mut blocker, is_doubtful } = self.blocking_of_bare(&touched, point, light);
            if is_doubtful {
                let precise = precise.get_or_init(|| point.map(DoubleDouble::from_f64));
                blocker = self.blocking_of_bare(&touched, precise, light).blocker;
            }
            if blocker.is_some() { 0.0 } else { 1.0 }
        };
        let without_material = &self.formulas[self.scene.materials.len()].formula;
        shade(point, &self.scene.lights, without_material, visibility, each)
    }

    fn blocking_of_bare<T: Scalar>(&self, touched: &[Touched], point: &SurfacePoint<T>, light: usize) -> Blocking {
        let source = &self.scene.lights[light];
        if !self.scene.shadows || !source.casts_shadows {
            return Blocking::NONE;
        }
        let to_light = source.position - point.position().map(T::rounded);
        let is_before_light = |touched: &&Touched| {
            let shape = &self.scene.shapes[touched.shape];
            let geometry = &shape.geometry;
            let is_behind = geometry.is_closed() && touched.nearest.outward_normal.dot(to_light) <= 0.0;
            shape.casts_shadow && is_behind && !geometry.part_encloses(touched.nearest.part, source.position)
        };
        if let Some(before) = touched.iter().find(is_before_light) {
            return Blocking { blocker: Some(before.primitive()), is_doubtful: false };
        }
        let own: Vec<Primitive> = touched.iter().map(Touched::primitive).collect();
        self.blocking_from(&own, point, Vector::from_f64(Vector::default()), light)
    }

    fn touched(&self, point: Vector) -> Vec<Touched> {
        if !self.scene.shadows {
            return Vec::new();
        }
        let on_surface = |(shape, prepared): (usize, &super::PreparedShape)| {
            let geometry = &prepared.geometry;
            let touches = geometry.signed_distance(point).abs() <= geometry.surface_tolerance(point);
            touches.then(|| Touched { shape, nearest: geometry.nearest(point) })
        };
        self.shapes.iter().enumerate().filter_map(on_surface).collect()
    }
}

impl Touched {
    fn primitive(&self) -> Primitive {
        Primitive { shape: self.shape, part: self.nearest.part }
    }
}
