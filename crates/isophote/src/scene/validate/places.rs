//! Validates where items are relative to each other.

use super::{Checked, Validator};
use crate::camera::{Camera, Projection};
use crate::light::Light;
use crate::message;
use crate::scene::document::Path;
use crate::scene::limits;
use crate::scene::{Probe, Shape};
use crate::shape::{Bounds, BoxTree, surface_at};
use crate::vector::Vector;

impl Validator<'_> {
    /// The tree of the shapes, by which those around a point are found.
    pub(super) fn tree_of(shapes: &Checked<Shape>) -> BoxTree {
        let nowhere =
            Bounds { least: Vector::new(1.0, 1.0, 1.0) * f64::MAX, greatest: Vector::new(1.0, 1.0, 1.0) * f64::MAX };
        BoxTree::new(
            shapes.iter().map(|shape| shape.as_ref().map_or(Some(nowhere), |shape| shape.geometry.bounds_of_all())),
        )
    }

    pub(super) fn eye_against_shapes(&mut self, camera: Option<&Camera>, shapes: &Checked<Shape>) {
        let Some(camera) = camera else { return };
        // Parallel rays start all over a plane, which may well cut through shapes.
        let is_a_start = !matches!(camera.projection, Projection::Orthographic(_));
        for shape in shapes.iter().flatten() {
            let distance = shape.geometry.signed_distance(camera.eye);
            if is_a_start && distance.abs() <= shape.geometry.surface_tolerance(camera.eye) {
                let message = message!("the eye is on the surface of \"{shape}\"", shape = shape.name);
                let path = Path::root().key("camera").key("eye");
                self.wrong(&path, message, message!("allowed: outside or inside a shape, not on its surface"));
            }
            if shape.geometry.relative_distance(camera.eye) > limits::RELATIVE_DISTANCE {
                let message =
                    message!("\"{shape}\" is too far from the eye for the promised digits", shape = shape.name);
                let path = Path::root().key("camera").key("eye");
                self.warn(&path, message, message!("they are kept up to a billion times the shape's size"));
            }
        }
    }

    /// Each light is told once of the first shape that it cannot be beside, and once of the first that is worth a word. Only
    /// the shapes around a light are looked at, and those around the eye: there may be a hundred thousand of both.
    pub(super) fn lights_against_shapes(
        &mut self,
        camera: Option<&Camera>,
        lights: &Checked<Light>,
        shapes: &Checked<Shape>,
        tree: &BoxTree,
    ) {
        let is_around =
            |shape: &usize, eye| shapes[*shape].as_ref().is_some_and(|shape| shape.geometry.signed_distance(eye) < 0.0);
        let around_eye: Vec<usize> = camera.map_or_else(Vec::new, |camera| {
            tree.around(camera.eye).into_iter().filter(|shape| is_around(shape, camera.eye)).collect()
        });
        for (index, light) in lights.iter().enumerate() {
            let Some(light) = light else { continue };
            let path = Path::root().key("light").index(index);
            // A parallel light is outside every shape.
            let path = path.key(if light.position().is_some() { "position" } else { "direction" });
            let around_light = light.position().map_or_else(Vec::new, |position| tree.around(position));
            if let Some(shape) = around_eye.iter().find(|&&shape| is_outside(light, shape, shapes, &around_light)) {
                let name = shapes[*shape].as_ref().map_or("", |shape| &shape.name);
                let message = message!(
                    "the eye is inside \"{name}\" and the light \"{light}\" outside: it lights nothing there",
                    name,
                    light = light.name
                );
                self.warn(&path, message, message!("move the light in, or the eye out"));
            }
            let Some(position) = light.position() else { continue };
            for shape in around_light {
                let eye_inside = around_eye.binary_search(&shape).is_ok();
                let Some(shape) = &shapes[shape] else { continue };
                let distance = shape.geometry.signed_distance(position);
                if distance.abs() <= shape.geometry.surface_tolerance(position) {
                    let message = message!(
                        "the light \"{light}\" is on the surface of \"{shape}\"",
                        light = light.name,
                        shape = shape.name
                    );
                    self.wrong(
                        &path,
                        message,
                        message!("move it away: the irradiance next to a point light has no bound"),
                    );
                    break;
                }
                if distance < 0.0
                    && !eye_inside
                    && camera.is_some()
                    && self.light_inside(&path, light, shape, -distance)
                {
                    break;
                }
            }
        }
    }

    /// Says that a light is inside a shape that the eye is not in; whether that is wrong.
    fn light_inside(&mut self, path: &Path, light: &Light, shape: &Shape, depth: f64) -> bool {
        let depth = self.length_text(depth);
        let message = message!("the light \"{light}\" is inside \"{shape}\"", light = light.name, shape = shape.name);
        if self.shadows && shape.casts_shadow && light.casts_shadows {
            let help = message!("it lights what is inside; the surface, {depth} away, lets no light out", depth);
            self.warn(path, message, help);
            return false;
        }
        let help = message!(
            "its surface is {depth} away and lets no light out; move the light out, the eye in, or write `shadows = true`",
            depth
        );
        self.wrong(path, message, help);
        true
    }

    pub(super) fn probes_against_shapes(&mut self, probes: &Checked<Probe>, shapes: &Checked<Shape>, tree: &BoxTree) {
        /// For so many points on no surface, the nearest one is looked for among all shapes.
        const EXPLAINED: usize = 100;
        // If a shape is missing, its probes would wrongly be reported as well.
        let is_wrong = |kind: &&'static str| self.problems.has(&Path::root().key(*kind));
        if shapes.iter().any(Option::is_none) || super::shapes::KINDS.iter().any(is_wrong) {
            return;
        }
        let mut missed = 0;
        for (index, probe) in probes.iter().enumerate() {
            let Some(probe) = probe else { continue };
            let near = tree.around(probe.at);
            if surface_at(near.iter().filter_map(|&shape| Some(&shapes[shape].as_ref()?.geometry)), probe.at).is_ok() {
                continue;
            }
            missed += 1;
            let path = Path::root().key("probe").index(index).key("at");
            let message = message!("the probe \"{probe}\" is on no surface", probe = probe.name);
            if missed > EXPLAINED {
                self.wrong(&path, message, message!("allowed: a point on a surface"));
                continue;
            }
            if let Err(miss) = surface_at(shapes.iter().flatten().map(|shape| &shape.geometry), probe.at) {
                let help = miss.map_or(message!("the scene has no shapes"), |miss| {
                    let name = shapes.iter().flatten().nth(miss.shape).map_or("", |shape| &shape.name);
                    miss.describe(name, self.length)
                });
                self.wrong(&path, message, help);
            }
        }
    }
}

/// Whether a light is outside a shape. It can only be inside one of those around it.
fn is_outside(light: &Light, shape: usize, shapes: &Checked<Shape>, around: &[usize]) -> bool {
    let (Some(position), Ok(_)) = (light.position(), around.binary_search(&shape)) else { return true };
    shapes[shape].as_ref().is_some_and(|shape| {
        let distance = shape.geometry.signed_distance(position);
        distance > shape.geometry.surface_tolerance(position)
    })
}
