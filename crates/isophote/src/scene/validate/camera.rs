//! Validates the camera.

use super::Validator;
use super::numbers::{Aim, vector_text};
use crate::camera::{Camera, Handedness};
use crate::map::Resolution;
use crate::scene::document::Path;
use crate::scene::limits;
use crate::scene::source::{CameraSource, SceneSource};
use crate::vector::Vector;

impl Validator<'_> {
    pub(super) fn camera(&mut self, source: &SceneSource) -> Option<Camera> {
        let path = Path::root().key("camera");
        let Some(camera) = &source.camera else {
            self.problems.missing(&Path::root(), "camera", "write a table [camera] with `eye`, `forward` and `screen`");
            return None;
        };
        let eye = self.required_point(&path, "eye", camera.eye);
        let aim = Aim {
            direction: ("forward", camera.forward),
            target: camera.target,
            tilt: camera.tilt,
            azimuth: camera.azimuth,
        };
        let forward = self.aim(&path, eye, &aim);
        let up = match camera.up {
            Some(up) => self.direction(&path.key("up"), up),
            None => forward.map(|forward| aim.rise().unwrap_or_else(|| default_up(forward))),
        };
        if let (Some(forward), Some(up)) = (forward, up) {
            self.not_parallel(&path, camera, forward, up);
        }
        let resolution = self.resolution(&path.key("resolution"), camera.resolution.unwrap_or([800, 600]));
        let projection = self.projection(&path, camera, resolution);
        Some(Camera {
            eye: eye?,
            forward: forward?,
            up: up?,
            handedness: source.handedness.unwrap_or(Handedness::Right),
            projection: projection?,
            resolution: resolution?,
        })
    }

    pub(super) fn not_parallel(&mut self, path: &Path, camera: &CameraSource, forward: Vector, up: Vector) {
        if forward.normalized().cross(up.normalized()).length() < PARALLEL {
            let key = ["up", "target", "forward"];
            let written = [camera.up.is_some(), camera.target.is_some(), true];
            let key = key.into_iter().zip(written).find_map(|(key, written)| written.then_some(key)).unwrap_or("up");
            let message =
                format!("`camera.up` is parallel to the direction of view {}", vector_text(forward.to_array()));
            self.wrong(
                &path.key(key),
                message,
                "allowed: any other direction; it shows where the top of the picture is",
            );
        }
    }

    pub(super) fn edges(&mut self, path: &Path, key: &str, edges: Option<[f64; 2]>, which: &str) -> Option<[f64; 2]> {
        let Some(edges) = edges else {
            self.problems.missing(path, key, format!("write `{key} = [a, b]`: the {which} edge of the window"));
            return None;
        };
        let path = path.key(key);
        let metres = edges.map(|edge| self.length.to_metres(edge));
        if metres.iter().any(|edge| edge.abs() > limits::COORDINATE) {
            self.too_far(&path);
            return None;
        }
        if metres[1] - metres[0] < limits::SMALLEST {
            let [first, second] = edges;
            let message = format!("`{path}` runs from {first} to {second}");
            let help = format!("allowed: the {which} edge, the smaller one first; `handedness` mirrors the picture");
            self.wrong(&path, message, &help);
            return None;
        }
        Some(metres)
    }

    pub(super) fn resolution(&mut self, path: &Path, [width, height]: [u64; 2]) -> Option<Resolution> {
        let side = |side: u64| u32::try_from(side).ok().filter(|side| (1..=limits::SIDE).contains(side));
        let resolution = side(width).zip(side(height)).map(|(width, height)| Resolution { width, height });
        if resolution.is_none() {
            let allowed = format!("allowed: width and height from 1 to {}", limits::SIDE);
            self.wrong(path, format!("the resolution is {width} × {height} pixels"), &allowed);
        }
        resolution
    }
}

/// The top of a picture for which no `up` is written: +y; where the view is straight along the y axis, what it becomes when a
/// level view along −z is turned down, or up, that far.
fn default_up(forward: Vector) -> Vector {
    let up = Vector::new(0.0, 1.0, 0.0);
    let along = forward.normalized();
    if along.cross(up).length() >= PARALLEL { up } else { Vector::new(0.0, 0.0, along.y.signum()) }
}

/// The sine of the angle between two directions below which they count as parallel.
const PARALLEL: f64 = 1e-6;
