//! Which surfaces a point lies on, found by the tree.

use super::PreparedScene;
use crate::ray::Ray;
use crate::shape::{Located, Miss, NearestPoint, Primitive};
use crate::vector::Vector;

/// A surface near a point.
pub(super) struct SurfaceAt {
    pub(super) shape: usize,
    /// The signed distance.
    distance: f64,
    /// The nearest part.
    part: u32,
}

impl PreparedScene {
    /// The surface that a point lies on, as [`surface_at`](crate::shape::surface_at) finds it among all shapes.
    ///
    /// # Errors
    /// The nearest surface if the point is on none; `None` if there are no shapes at all.
    pub(crate) fn surface_at(&self, point: Vector) -> Result<Located, Option<Box<Miss>>> {
        let mut primitives = self.primitives_nearest_to(point);
        let surfaces = self.surfaces_of(&mut primitives, point);
        let nearest = surfaces.min_by(|one, other| one.distance.abs().total_cmp(&other.distance.abs()));
        let Some(surface) = nearest else { return Err(None) };
        let nearest = self.nearest_on(&surface, point);
        let SurfaceAt { shape, distance, .. } = surface;
        if self.is_on(&surface, point) {
            Ok(Located { shape, nearest })
        } else {
            Err(Some(Box::new(Miss { shape, distance, nearest })))
        }
    }

    /// The primitives that a point lies on, to the tolerance of their surfaces, one of each shape at most, in their order.
    pub(super) fn touched_at(&self, point: Vector) -> Vec<(Primitive, NearestPoint)> {
        let mut primitives = self.primitives_at(point);
        let surfaces = self.surfaces_of(&mut primitives, point).filter(|surface| self.is_on(surface, point));
        let touched = |surface: SurfaceAt| {
            let SurfaceAt { shape, part, .. } = surface;
            (Primitive { shape, part }, self.nearest_on(&surface, point))
        };
        surfaces.map(touched).collect()
    }

    /// The shapes that some of their primitives belong to.
    fn surfaces_of(&self, primitives: &mut [Primitive], point: Vector) -> impl Iterator<Item = SurfaceAt> {
        primitives.sort_unstable_by_key(|primitive| (primitive.shape, primitive.part));
        let of_shape = move |primitives: &[Primitive]| {
            let shape = primitives.first()?.shape;
            let geometry = &self.shapes[shape].geometry;
            let distance = |part: u32| geometry.part_signed_distance(part, point);
            let parts = || primitives.iter().map(|primitive| primitive.part);
            let part = parts().min_by(|one, other| distance(*one).abs().total_cmp(&distance(*other).abs()))?;
            // That of a whole cloud: inside one of its spheres, a point is not on another one.
            let distance = parts().map(distance).fold(f64::INFINITY, f64::min);
            Some(SurfaceAt { shape, distance, part })
        };
        primitives.chunk_by(|one, other| one.shape == other.shape).filter_map(of_shape)
    }

    fn is_on(&self, surface: &SurfaceAt, point: Vector) -> bool {
        let tolerance = self.shapes[surface.shape].geometry.part_tolerance(surface.part, point);
        surface.distance.abs() <= tolerance
    }

    fn nearest_on(&self, surface: &SurfaceAt, point: Vector) -> NearestPoint {
        self.shapes[surface.shape].geometry.part_nearest(surface.part, point)
    }

    /// The primitives that a point may lie on or in: the boxes of the tree are larger than what is in them, by more than the
    /// tolerance of surfaces.
    fn primitives_at(&self, point: Vector) -> Vec<Primitive> {
        let nowhere = Ray { anchor: point, offset: Vector::default(), direction: Vector::new(1.0, 0.0, 0.0) };
        let mut primitives = Vec::new();
        self.along_ray(&nowhere, 0.0, |primitive| {
            primitives.push(primitive);
            0.0
        });
        primitives
    }

    /// The primitives that may be the nearest to a point.
    fn primitives_nearest_to(&self, point: Vector) -> Vec<Primitive> {
        let mut primitives = self.primitives_at(point);
        // Inside a cloud, its surface is as far away as the deepest of its spheres says, however close the others are.
        let inside: Vec<SurfaceAt> =
            self.surfaces_of(&mut primitives, point).filter(|surface| surface.distance < 0.0).collect();
        let mut limit = inside.iter().map(|surface| -surface.distance).fold(f64::INFINITY, f64::min);
        let is_inside = |shape: usize| inside.iter().any(|surface| surface.shape == shape);
        let mut nearest = Vec::new();
        let mut test = |primitive: Primitive| {
            nearest.push(primitive);
            if !is_inside(primitive.shape) {
                let geometry = &self.shapes[primitive.shape].geometry;
                limit = limit.min(geometry.part_signed_distance(primitive.part, point).abs());
            }
            limit
        };
        if self.tries_all_primitives() {
            for number in 0..self.primitive_count() {
                test(self.primitive(number));
            }
        } else {
            self.accelerator().around(point, |number| test(self.primitive(number)));
        }
        nearest
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::scene::{MemoryFiles, Scene, Syntax};
    use crate::shape::surface_at;

    const SCENE: &str = r#"
        version = 1
        length = "m"
        convention = "radiance"
        camera = { eye = [1, 3, 6], target = [0, 0, 0], resolution = [40, 30], field_of_view = 50 }
        material.a = { diffuse = 0.6 }
        plane = [{ point = [0, -1, 0], normal = [0, 1, 0], material = "a" }]
        box = [
            { center = [-1, -0.5, 0.3], size = [0.7, 1, 0.5], material = "a" },
            { center = [-0.3, -0.5, 0.3], size = [0.7, 1, 0.5], material = "a" },
        ]
        sphere = [{ center = [0.2, 0.1, 0.3], radius = 0.4, material = "a" }]
        cylinder = [{ from = [2, -1, 0], to = [2, 1, 0.5], radius = 0.3, material = "a" }]
        mesh = [{ file = "mesh.obj", material = "a" }]
        spheres = [{ file = "cloud.csv", material = "a" }]
        light = [{ position = [30, 40, 20], intensity = 30 }]
    "#;
    const MESH: &str = "v 0 0 0\nv 1 0.2 0\nv 0.3 1 0.1\nv 0.5 0.4 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3";
    const CLOUD: &str = "x,y,z,radius\n-1,-0.2,0.9,0.05\n-1,-0.5,0.3,0.9\n-2,0,0,0.5\n-2.4,0,0,0.3\n-1.9,0.1,0,0.2\n-3,0.5,0.5,0.1\n-3,0.5,0.7,0.1";

    fn prepared() -> PreparedScene {
        let files = MemoryFiles::from_iter([("mesh.obj", MESH), ("cloud.csv", CLOUD)]);
        let scene = Scene::from_text_with(&files, None, "scene.toml", SCENE, Syntax::Toml);
        PreparedScene::new(&scene.unwrap_or_else(|error| panic!("{error}")))
    }

    proptest! {
        /// On, beside and in every shape, where two of them touch, and inside another part.
        #[test]
        fn the_tree_finds_the_surface_that_all_shapes_together_have(
            shape in 0_usize..7,
            place in [-3.5..2.5_f64, -1.5..1.5, -1.0..1.5],
            beside in prop_oneof![Just(0.0), Just(1e-12), Just(1e-6), Just(0.1), Just(-0.07), Just(30.0)],
        ) {
            let scene = prepared();
            prop_assert!(!scene.tries_all_primitives());
            let geometries = || scene.scene.shapes().iter().map(|shape| &shape.geometry);
            let geometry = geometries().nth(shape).expect("there are seven");
            let nearest = geometry.nearest(place.into());
            let point = nearest.anchor + nearest.offset + nearest.outward_normal * beside;
            prop_assert_eq!(scene.surface_at(point), surface_at(geometries(), point));
            let on = geometries().map(|geometry| geometry.signed_distance(point).abs() <= geometry.surface_tolerance(point));
            let on: Vec<usize> = on.enumerate().filter(|(_, is_on)| *is_on).map(|(shape, _)| shape).collect();
            let found: Vec<usize> = scene.touched_at(point).iter().map(|(primitive, _)| primitive.shape).collect();
            prop_assert_eq!(found, on);
        }
    }
}
