//! Validates the projection of the camera, with the keys that belong to each kind.

use super::Validator;
use super::leave_out_or_write;
use crate::camera::{Extent, Fisheye, Mapping, Projection, Screen};
use crate::map::Resolution;
use crate::message;
use crate::scene::document::Path;
use crate::scene::limits;
use crate::scene::source::{CameraSource, IntrinsicsSource, ProjectionName, ScreenSource, WindowSource};
use crate::units::Keyword;

/// The smallest width and height of a panorama, in degrees.
const NARROWEST: f64 = 1e-6;

impl Validator<'_> {
    pub(super) fn projection(
        &mut self,
        path: &Path,
        camera: &CameraSource,
        resolution: Option<Resolution>,
    ) -> Option<Projection> {
        if self.problems.has(&path.key("projection")) {
            // It is unknown which keys it needs.
            return None;
        }
        let name = camera.projection.unwrap_or(ProjectionName::Perspective);
        self.refuse_keys_of_other_projections(path, camera, name);
        match name {
            ProjectionName::Perspective => self.perspective(path, camera, resolution).map(Projection::Perspective),
            ProjectionName::Orthographic => self.window(path, camera.window.as_ref()).map(Projection::Orthographic),
            ProjectionName::FisheyeEquidistant => {
                self.fisheye(path, camera, Mapping::Equidistant).map(Projection::Fisheye)
            }
            ProjectionName::FisheyeEqualArea => self.fisheye(path, camera, Mapping::EqualArea).map(Projection::Fisheye),
            ProjectionName::Panorama => self.panorama(path, camera).map(Projection::Panorama),
        }
    }

    fn perspective(&mut self, path: &Path, camera: &CameraSource, resolution: Option<Resolution>) -> Option<Screen> {
        let distance = self.length.to_metres(1.0);
        match (&camera.screen, camera.field_of_view, &camera.intrinsics) {
            (None, None, Some(intrinsics)) => self.intrinsics(path, intrinsics, distance, resolution),
            (Some(_), None, Some(_)) => self.either(path, "screen", "intrinsics"),
            (_, Some(_), Some(_)) => self.either(path, "field_of_view", "intrinsics"),
            (Some(_), Some(_), None) => self.either(path, "screen", "field_of_view"),
            (None, Some(field_of_view), None) => {
                let field_of_view = self.field_of_view(path, field_of_view, limits::PERSPECTIVE_FIELD)?;
                Some(Screen::of_field_of_view(field_of_view, distance, resolution?))
            }
            (Some(screen), None, None) => self.screen(path, screen),
            (None, None, None) => {
                let help = message!(
                    "write `screen = {{ distance = 5, x = [-4, 4], y = [-3, 3] }}`, or `field_of_view = 40` instead"
                );
                self.problems.missing(path, "screen", help);
                None
            }
        }
    }

    fn either<T>(&mut self, path: &Path, one: &str, other: &'static str) -> Option<T> {
        self.wrong(
            &path.key(other),
            message!("`camera` has both `{one}` and `{other}`", one, other),
            message!("allowed: one of the two"),
        );
        None
    }

    /// The window of a calibrated camera (2.11).
    fn intrinsics(
        &mut self,
        path: &Path,
        written: &IntrinsicsSource,
        distance: f64,
        resolution: Option<Resolution>,
    ) -> Option<Screen> {
        let path = path.key("intrinsics");
        let principal = -limits::PRINCIPAL_POINT..=limits::PRINCIPAL_POINT;
        let [fx, fy] = [("fx", written.fx), ("fy", written.fy)]
            .map(|(key, value)| self.pixels(&path, key, value, &limits::FOCAL_LENGTH));
        let [cx, cy] =
            [("cx", written.cx), ("cy", written.cy)].map(|(key, value)| self.pixels(&path, key, value, &principal));
        let (fx, fy, cx, cy) = (fx?, fy?, cx?, cy?);
        let Resolution { width, height } = resolution?;
        let [width, height] = [width, height].map(f64::from);
        Some(Screen {
            distance,
            x: [(-0.5 - cx) / fx * distance, (width - 0.5 - cx) / fx * distance],
            y: [-(height - 0.5 - cy) / fy * distance, (0.5 + cy) / fy * distance],
        })
    }

    fn pixels(
        &mut self,
        path: &Path,
        key: &'static str,
        written: Option<f64>,
        allowed: &std::ops::RangeInclusive<f64>,
    ) -> Option<f64> {
        let Some(value) = written else {
            self.problems.missing(path, key, message!("write `{key} = …`, in pixels", key));
            return None;
        };
        if allowed.contains(&value) {
            return Some(value);
        }
        let path = path.key(key);
        let help = message!(
            "allowed: {least} to {most} pixels",
            least = format!("{:e}", allowed.start()),
            most = format!("{:e}", allowed.end())
        );
        self.wrong(&path, message!("`{path}` is {value}", path, value), help);
        None
    }

    fn screen(&mut self, path: &Path, screen: &ScreenSource) -> Option<Screen> {
        let path = path.key("screen");
        let distance = self.required_size(&path, "distance", screen.distance);
        let x = self.edges(&path, "x", screen.x, || message!("left and right"));
        let y = self.edges(&path, "y", screen.y, || message!("lower and upper"));
        Some(Screen { distance: distance?, x: x?, y: y? })
    }

    fn window(&mut self, path: &Path, window: Option<&WindowSource>) -> Option<Extent> {
        let Some(window) = window else {
            self.problems.missing(path, "window", message!("write `window = {{ x = [-4, 4], y = [-3, 3] }}`"));
            return None;
        };
        let path = path.key("window");
        let x = self.edges(&path, "x", window.x, || message!("left and right"));
        let y = self.edges(&path, "y", window.y, || message!("lower and upper"));
        Some(Extent { x: x?, y: y? })
    }

    fn fisheye(&mut self, path: &Path, camera: &CameraSource, mapping: Mapping) -> Option<Fisheye> {
        let Some(field_of_view) = camera.field_of_view else {
            let help = message!("write `field_of_view = 180`, the angle across the circle, in degrees");
            self.problems.missing(path, "field_of_view", help);
            return None;
        };
        Some(Fisheye { mapping, field_of_view: self.field_of_view(path, field_of_view, limits::FISHEYE_FIELD)? })
    }

    fn field_of_view(&mut self, path: &Path, value: f64, allowed: std::ops::RangeInclusive<f64>) -> Option<f64> {
        if allowed.contains(&value) {
            return Some(value);
        }
        let message = message!("`camera.field_of_view` is {value}", value);
        let help = message!("allowed: {least} to {most} degrees", least = allowed.start(), most = allowed.end());
        self.wrong(&path.key("field_of_view"), message, help);
        None
    }

    fn panorama(&mut self, path: &Path, camera: &CameraSource) -> Option<Extent> {
        let x = self.angles(path, "longitude", camera.longitude.unwrap_or([-180.0, 180.0]), limits::LONGITUDE);
        let y = self.angles(path, "latitude", camera.latitude.unwrap_or([-90.0, 90.0]), limits::LATITUDE);
        Some(Extent { x: x?, y: y? })
    }

    fn angles(&mut self, path: &Path, key: &'static str, [first, second]: [f64; 2], farthest: f64) -> Option<[f64; 2]> {
        let is_within = [first, second].iter().all(|angle| angle.abs() <= farthest);
        if is_within && (NARROWEST..=360.0).contains(&(second - first)) {
            return Some([first, second]);
        }
        let path = path.key(key);
        let (least, most) = (-farthest, farthest);
        let help = if farthest > 180.0 {
            message!(
                "allowed: from {least} to {most} degrees, the smaller one first and at most 360 apart",
                least,
                most
            )
        } else {
            message!("allowed: from {least} to {most} degrees, the smaller one first", least, most)
        };
        self.wrong(&path, message!("`{path}` runs from {first} to {second}", path, first, second), help);
        None
    }

    fn refuse_keys_of_other_projections(&mut self, path: &Path, camera: &CameraSource, name: ProjectionName) {
        use ProjectionName::{FisheyeEqualArea, FisheyeEquidistant, Orthographic, Panorama, Perspective};
        let keys: [(&str, bool, &[ProjectionName]); 6] = [
            ("screen", camera.screen.is_some(), &[Perspective]),
            ("intrinsics", camera.intrinsics.is_some(), &[Perspective]),
            ("field_of_view", camera.field_of_view.is_some(), &[Perspective, FisheyeEquidistant, FisheyeEqualArea]),
            ("window", camera.window.is_some(), &[Orthographic]),
            ("longitude", camera.longitude.is_some(), &[Panorama]),
            ("latitude", camera.latitude.is_some(), &[Panorama]),
        ];
        for (key, is_written, projections) in keys {
            if is_written && !projections.contains(&name) {
                let message =
                    message!("`camera.{key}` means nothing for the projection \"{name}\"", key, name = name.name());
                let help = leave_out_or_write("projection", projections);
                self.wrong(&path.key(key), message, help);
            }
        }
    }
}
