//! Which surfaces a point lies on, found by the tree.

use super::PreparedScene;
use crate::ray::Ray;
use crate::shape::{Located, Miss, NearestPoint, Primitive, surface_at};
use crate::vector::Vector;

/// A surface that a point lies on.
pub(super) struct SurfaceAt {
    pub(super) shape: usize,
    /// The distance, which is within the tolerance.
    distance: f64,
    pub(super) nearest: NearestPoint,
}

impl PreparedScene {
    /// The surface that a point lies on, as [`surface_at`] finds it among all shapes.
    ///
    /// # Errors
    /// The nearest surface if the point is on none; `None` if there are no shapes at all.
    pub(crate) fn surface_at(&self, point: Vector) -> Result<Located, Option<Box<Miss>>> {
        let nearest = self.surfaces_at(point).into_iter().min_by(|one, other| one.distance.total_cmp(&other.distance));
        match nearest {
            Some(SurfaceAt { shape, nearest, .. }) => Ok(Located { shape, nearest }),
            None => surface_at(self.scene.shapes().iter().map(|shape| &shape.geometry), point),
        }
    }

    /// The surfaces that a point lies on, to their tolerance, in the order of the shapes.
    pub(super) fn surfaces_at(&self, point: Vector) -> Vec<SurfaceAt> {
        let around = self.primitives_around(point);
        let of_shape = |primitives: &[Primitive]| {
            let shape = primitives.first()?.shape;
            let geometry = &self.shapes[shape].geometry;
            let distance = |part: u32| geometry.part_signed_distance(part, point);
            let parts = || primitives.iter().map(|primitive| primitive.part);
            // As of a whole cloud: inside one of its spheres, a point is not on another one.
            let union = parts().map(distance).fold(f64::INFINITY, f64::min).abs();
            let nearest = parts().min_by(|one, other| distance(*one).abs().total_cmp(&distance(*other).abs()))?;
            let is_on = union <= geometry.part_tolerance(nearest, point);
            is_on.then(|| SurfaceAt { shape, distance: union, nearest: geometry.part_nearest(nearest, point) })
        };
        around.chunk_by(|one, other| one.shape == other.shape).filter_map(of_shape).collect()
    }

    /// The primitives that a point may lie on, in their order: the boxes of the tree are larger than what is in them, by more
    /// than the tolerance of surfaces.
    fn primitives_around(&self, point: Vector) -> Vec<Primitive> {
        let nowhere = Ray { anchor: point, offset: Vector::default(), direction: Vector::new(1.0, 0.0, 0.0) };
        let mut primitives = Vec::new();
        self.along_ray(&nowhere, 0.0, |primitive| {
            primitives.push(primitive);
            0.0
        });
        primitives.sort_unstable_by_key(|primitive| (primitive.shape, primitive.part));
        primitives
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::scene::{MemoryFiles, Scene, Syntax};

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
    const CLOUD: &str = "x,y,z,radius\n-2,0,0,0.5\n-2.4,0,0,0.3\n-1.9,0.1,0,0.2\n-3,0.5,0.5,0.1\n-3,0.5,0.7,0.1";

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
            beside in prop_oneof![Just(0.0), Just(1e-12), Just(1e-6)],
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
            let found: Vec<usize> = scene.surfaces_at(point).iter().map(|surface| surface.shape).collect();
            prop_assert_eq!(found, on);
        }
    }
}
