//! Validates the camera.

use super::numbers::{Aim, vector_text};
use super::{Validator, rounded};
use crate::camera::{Camera, Handedness};
use crate::map::Resolution;
use crate::message;
use crate::scene::document::Path;
use crate::scene::limits;
use crate::scene::source::{CameraSource, PoseSource, SceneSource};
use crate::text::Message;
use crate::vector::Vector;

impl Validator<'_> {
    pub(super) fn camera(&mut self, source: &SceneSource) -> Option<Camera> {
        let path = Path::root().key("camera");
        let Some(camera) = &source.camera else {
            self.problems.missing(
                &Path::root(),
                "camera",
                message!("write a table [camera] with `eye`, `forward` and `screen`"),
            );
            return None;
        };
        let handedness = source.handedness.unwrap_or(Handedness::Right);
        let [eye, forward, up] = match &camera.pose {
            Some(pose) => self.pose(&path, camera, pose, handedness),
            None => self.placed(&path, camera),
        };
        let resolution = self.resolution(&path.key("resolution"), camera.resolution.unwrap_or([800, 600]));
        let projection = self.projection(&path, camera, resolution);
        Some(Camera {
            eye: eye?,
            forward: forward?,
            up: up?,
            handedness,
            projection: projection?,
            resolution: resolution?,
        })
    }

    /// The eye, the direction of view and what is up.
    fn placed(&mut self, path: &Path, camera: &CameraSource) -> [Option<Vector>; 3] {
        let eye = self.required_point(path, "eye", camera.eye);
        let aim = Aim {
            direction: ("forward", camera.forward),
            target: camera.target,
            tilt: camera.tilt,
            azimuth: camera.azimuth,
        };
        let forward = self.aim(path, eye, &aim);
        let up = match camera.up {
            Some(up) => self.direction(&path.key("up"), up),
            None => forward.map(|forward| aim.rise().unwrap_or_else(|| default_up(forward))),
        };
        if let (Some(forward), Some(up)) = (forward, up) {
            self.not_parallel(path, camera, forward, up);
        }
        [eye, forward, up]
    }

    /// The same of a calibrated camera (2.12).
    fn pose(
        &mut self,
        path: &Path,
        camera: &CameraSource,
        pose: &PoseSource,
        handedness: Handedness,
    ) -> [Option<Vector>; 3] {
        let others = [
            ("eye", camera.eye.is_some()),
            ("forward", camera.forward.is_some()),
            ("target", camera.target.is_some()),
            ("tilt", camera.tilt.is_some()),
            ("azimuth", camera.azimuth.is_some()),
            ("up", camera.up.is_some()),
        ];
        for (key, _) in others.into_iter().filter(|(_, is_written)| *is_written) {
            let message = message!("`camera` has both `pose` and `{key}`", key);
            self.wrong(&path.key(key), message, message!("allowed: one of the two"));
        }
        let path = path.key("pose");
        if handedness == Handedness::Left {
            let message = message!("`camera.pose` is in a scene whose `handedness` is left");
            self.wrong(&path, message, message!("allowed: `handedness = \"right\"`, which calibrations are for"));
        }
        let rotation = self.rotation_rows(&path, pose.rotation);
        let translation = self.required_point(&path, "translation", pose.translation);
        let (Some([x, y, z]), Some(t)) = (rotation, translation) else { return [None; 3] };
        [Some(-(x * t.x + y * t.y + z * t.z)), Some(z), Some(-y)]
    }

    /// The rows of a rotation.
    fn rotation_rows(&mut self, path: &Path, written: Option<[[f64; 3]; 3]>) -> Option<[Vector; 3]> {
        let Some(rows) = written else {
            let help = message!(
                "write `rotation = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]`: the camera's axes to the right, down and forward"
            );
            self.problems.missing(path, "rotation", help);
            return None;
        };
        let rows = rows.map(Vector::from);
        let [x, y, z] = rows;
        let products =
            [x.dot(x) - 1.0, y.dot(y) - 1.0, z.dot(z) - 1.0, x.dot(y), y.dot(z), z.dot(x), x.cross(y).dot(z) - 1.0];
        // NaN, of numbers whose squares overflow, is not small.
        if products.iter().all(|product| product.abs() <= limits::ROTATION) {
            return Some(rows);
        }
        let path = path.key("rotation");
        let message = if x.cross(y).dot(z) < 0.0 {
            message!(
                "`{path}` mirrors: its determinant is {determinant}",
                path,
                determinant = rounded(x.cross(y).dot(z))
            )
        } else {
            message!("`{path}` is no rotation", path)
        };
        let help = message!(
            "allowed: three rows of length 1 at right angles to each other, to within {tolerance}, with the determinant 1",
            tolerance = format!("{:e}", limits::ROTATION)
        );
        self.wrong(&path, message, help);
        None
    }

    pub(super) fn not_parallel(&mut self, path: &Path, camera: &CameraSource, forward: Vector, up: Vector) {
        if forward.normalized().cross(up.normalized()).length() < PARALLEL {
            let key = ["up", "target", "forward"];
            let written = [camera.up.is_some(), camera.target.is_some(), true];
            let key = key.into_iter().zip(written).find_map(|(key, written)| written.then_some(key)).unwrap_or("up");
            let message = message!(
                "`camera.up` is parallel to the direction of view {direction}",
                direction = vector_text(forward.to_array())
            );
            self.wrong(
                &path.key(key),
                message,
                message!("allowed: any other direction; it shows where the top of the picture is"),
            );
        }
    }

    pub(super) fn edges(
        &mut self,
        path: &Path,
        key: &'static str,
        edges: Option<[f64; 2]>,
        which: impl Fn() -> Message,
    ) -> Option<[f64; 2]> {
        let Some(edges) = edges else {
            self.problems.missing(
                path,
                key,
                message!("write `{key} = [a, b]`: the {which} edge of the window", key, which = which()),
            );
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
            let message = message!("`{path}` runs from {first} to {second}", path, first, second);
            let help = message!(
                "allowed: the {which} edge, the smaller one first; `handedness` mirrors the picture",
                which = which()
            );
            self.wrong(&path, message, help);
            return None;
        }
        Some(metres)
    }

    pub(super) fn resolution(&mut self, path: &Path, [width, height]: [u64; 2]) -> Option<Resolution> {
        let side = |side: u64| u32::try_from(side).ok().filter(|side| (1..=limits::SIDE).contains(side));
        let resolution = side(width).zip(side(height)).map(|(width, height)| Resolution { width, height });
        if resolution.is_none() {
            let allowed = message!("allowed: width and height from 1 to {side}", side = limits::SIDE);
            self.wrong(path, message!("the resolution is {width} × {height} pixels", width, height), allowed);
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
