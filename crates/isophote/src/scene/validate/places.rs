//! Validates where items are relative to each other.

use super::{Checked, Validator};
use crate::camera::{Camera, Projection};
use crate::light::Light;
use crate::scene::document::Path;
use crate::scene::limits;
use crate::scene::{Probe, Shape};
use crate::shape::surface_at;

impl Validator<'_> {
    pub(super) fn eye_against_shapes(&mut self, camera: Option<&Camera>, shapes: &Checked<Shape>) {
        let Some(camera) = camera else { return };
        // Parallel rays start all over a plane, which may well cut through shapes.
        let is_a_start = !matches!(camera.projection, Projection::Orthographic(_));
        for shape in shapes.iter().flatten() {
            let distance = shape.geometry.signed_distance(camera.eye);
            if is_a_start && distance.abs() <= shape.geometry.surface_tolerance(camera.eye) {
                let message = format!("the eye is on the surface of \"{}\"", shape.name);
                let path = Path::root().key("camera").key("eye");
                self.wrong(&path, message, "allowed: outside or inside a shape, not on its surface");
            }
            if shape.geometry.relative_distance(camera.eye) > limits::RELATIVE_DISTANCE {
                let message = format!("\"{}\" is too far from the eye for the promised digits", shape.name);
                let path = Path::root().key("camera").key("eye");
                self.warn(&path, message, "they are kept up to a billion times the shape's size");
            }
        }
    }

    pub(super) fn lights_against_shapes(
        &mut self,
        camera: Option<&Camera>,
        lights: &Checked<Light>,
        shapes: &Checked<Shape>,
    ) {
        for shape in shapes.iter().flatten() {
            let eye_inside = camera.is_some_and(|camera| shape.geometry.signed_distance(camera.eye) < 0.0);
            for (index, light) in lights.iter().enumerate() {
                let Some(light) = light else { continue };
                let path = Path::root().key("light").index(index);
                // A parallel light is outside every shape.
                let position = light.position();
                let distance = position.map_or(f64::INFINITY, |position| shape.geometry.signed_distance(position));
                let path = path.key(if position.is_some() { "position" } else { "direction" });
                if position.is_some_and(|position| distance.abs() <= shape.geometry.surface_tolerance(position)) {
                    let message = format!("the light \"{}\" is on the surface of \"{}\"", light.name, shape.name);
                    self.wrong(&path, message, "move it away: the irradiance next to a point light has no bound");
                } else if distance < 0.0 && !eye_inside && camera.is_some() {
                    let message = format!("the light \"{}\" is inside \"{}\"", light.name, shape.name);
                    let depth = self.length_text(-distance);
                    if self.shadows && shape.casts_shadow && light.casts_shadows {
                        let help = format!("it lights what is inside; the surface, {depth} away, lets no light out");
                        self.warn(&path, message, &help);
                    } else {
                        let help = format!(
                            "its surface is {depth} away and lets no light out; move the light out, the eye in, or write \
                             `shadows = true`"
                        );
                        self.wrong(&path, message, &help);
                    }
                } else if distance > 0.0 && eye_inside {
                    let message = format!(
                        "the eye is inside \"{}\" and the light \"{}\" outside: it lights nothing there",
                        shape.name, light.name
                    );
                    self.warn(&path, message, "move the light in, or the eye out");
                }
            }
        }
    }

    pub(super) fn probes_against_shapes(&mut self, probes: &Checked<Probe>, shapes: &Checked<Shape>) {
        // If a shape is missing, its probes would wrongly be reported as well.
        let is_wrong = |kind: &&str| self.problems.has(&Path::root().key(kind));
        if shapes.iter().any(Option::is_none) || super::shapes::KINDS.iter().any(is_wrong) {
            return;
        }
        for (index, probe) in probes.iter().enumerate() {
            let Some(probe) = probe else { continue };
            let path = Path::root().key("probe").index(index).key("at");
            if let Err(miss) = surface_at(shapes.iter().flatten().map(|shape| &shape.geometry), probe.at) {
                let message = format!("the probe \"{}\" is on no surface", probe.name);
                let help = miss.map_or("the scene has no shapes".into(), |miss| {
                    let name = shapes.iter().flatten().nth(miss.shape).map_or("", |shape| &shape.name);
                    miss.describe(name, self.length)
                });
                self.wrong(&path, message, &help);
            }
        }
    }
}
