//! Validates points, sizes, directions and fractions.

use super::Validator;
use crate::message;
use crate::scene::document::Path;
use crate::scene::limits;
use crate::text::Message;
use crate::vector::Vector;

impl Validator<'_> {
    pub(super) fn required_point(&mut self, path: &Path, key: &'static str, point: Option<[f64; 3]>) -> Option<Vector> {
        let Some(point) = point else {
            self.problems.missing(path, key, message!("write `{key} = [x, y, z]`", key));
            return None;
        };
        self.point(&path.key(key), point)
    }

    pub(super) fn point(&mut self, path: &Path, point: [f64; 3]) -> Option<Vector> {
        let metres = point.map(|coordinate| self.length.to_metres(coordinate));
        if metres.iter().any(|coordinate| coordinate.abs() > limits::COORDINATE) {
            self.too_far(path);
            return None;
        }
        Some(Vector::from(metres))
    }

    pub(super) fn too_far(&mut self, path: &Path) {
        let bound = self.length.from_metres(limits::COORDINATE);
        let help = message!(
            "allowed: coordinates from {least} to {most} {unit}",
            least = format!("{:e}", -bound),
            most = format!("{bound:e}"),
            unit = self.unit()
        );
        self.wrong(path, message!("`{path}` is too far away", path), help);
    }

    pub(super) fn required_size(&mut self, path: &Path, key: &'static str, size: Option<f64>) -> Option<f64> {
        let Some(size) = size else {
            self.problems.missing(path, key, message!("write `{key} = …`, a length above 0", key));
            return None;
        };
        self.size(&path.key(key), size)
    }

    /// Three sizes; all of their mistakes are reported.
    pub(super) fn required_sizes(&mut self, path: &Path, key: &'static str, sizes: Option<[f64; 3]>) -> Option<Vector> {
        let Some([x, y, z]) = sizes else {
            self.problems.missing(path, key, message!("write `{key} = [x, y, z]`, lengths above 0", key));
            return None;
        };
        let path = path.key(key);
        let [x, y, z] = [(0, x), (1, y), (2, z)].map(|(index, size)| self.size(&path.index(index), size));
        Some(Vector::new(x?, y?, z?))
    }

    fn size(&mut self, path: &Path, size: f64) -> Option<f64> {
        let metres = self.length.to_metres(size);
        if (limits::SMALLEST..=limits::COORDINATE).contains(&metres) {
            return Some(metres);
        }
        let [smallest, largest] = [limits::SMALLEST, limits::COORDINATE].map(|bound| self.length.from_metres(bound));
        let help = message!(
            "allowed: above 0 ({smallest} to {largest} {unit})",
            smallest = format!("{smallest:e}"),
            largest = format!("{largest:e}"),
            unit = self.unit()
        );
        self.wrong(path, message!("`{path}` is {value}", path, value = size), help);
        None
    }

    pub(super) fn required_direction(
        &mut self,
        path: &Path,
        key: &'static str,
        written: Option<[f64; 3]>,
    ) -> Option<Vector> {
        let Some(direction) = written else {
            self.problems.missing(
                path,
                key,
                message!("write `{key} = [x, y, z]`, a direction of any length but zero", key),
            );
            return None;
        };
        self.direction(&path.key(key), direction)
    }

    pub(super) fn direction(&mut self, path: &Path, direction: [f64; 3]) -> Option<Vector> {
        let largest = direction.iter().fold(0.0_f64, |largest, component| largest.max(component.abs()));
        if !(1e-100..=1e100).contains(&largest) {
            let direction = vector_text(direction);
            let message = if largest < 1.0 {
                message!("`{path}` has no length: {direction}", path, direction)
            } else {
                message!("`{path}` is too long: {direction}", path, direction)
            };
            self.wrong(path, message, message!("allowed: any direction, of any length from 1e-100 to 1e100"));
            return None;
        }
        // Scaled by a power of two, which changes no digits, so that the squares neither underflow nor overflow.
        let scale = libm::exp2(-libm::floor(libm::log2(largest)));
        Some(Vector::from(direction.map(|component| component * scale)))
    }

    /// A direction that is given directly, by a target point, or by angles.
    pub(super) fn aim(&mut self, path: &Path, from: Option<Vector>, aim: &Aim) -> Option<Vector> {
        let (key, direction) = aim.direction;
        if aim.tilt.is_some() || aim.azimuth.is_some() {
            let angle = if aim.tilt.is_some() { "tilt" } else { "azimuth" };
            let other = direction.map(|_| key).or_else(|| aim.target.map(|_| "target"));
            if let Some(other) = other {
                let message = message!("`{path}` has both `{other}` and `{angle}`", path, other, angle);
                self.wrong(&path.key(angle), message, message!("allowed: one of the two"));
                return None;
            }
            return self.direction_by_angles(path, aim);
        }
        match (direction, aim.target) {
            (Some(direction), None) => self.direction(&path.key(key), direction),
            (None, Some(target)) => {
                let to_target = self.point(&path.key("target"), target)? - from?;
                if to_target.length() < limits::SMALLEST {
                    let message = message!("`{path}.target` is where `{path}` itself is", path);
                    self.wrong(&path.key("target"), message, message!("allowed: any other point"));
                    return None;
                }
                Some(to_target)
            }
            (Some(_), Some(_)) => {
                let message = message!("`{path}` has both `{key}` and `target`", path, key);
                self.wrong(&path.key("target"), message, message!("allowed: one of the two"));
                None
            }
            (None, None) => {
                let help = message!(
                    "write `{key} = [x, y, z]`, a direction, `target = [x, y, z]`, a point, or angles: `tilt` and `azimuth`",
                    key
                );
                self.problems.missing(path, key, help);
                None
            }
        }
    }

    fn direction_by_angles(&mut self, path: &Path, aim: &Aim) -> Option<Vector> {
        let Some(tilt) = aim.tilt else {
            self.problems.missing(
                path,
                "tilt",
                message!("write `tilt = …`, in degrees from −z: 0 is straight down −z, 90 horizontal"),
            );
            return None;
        };
        let mut is_within = |key: &'static str, angle: f64, least: f64, most: f64, what: fn() -> Message| {
            let is_within = (least..=most).contains(&angle);
            if !is_within {
                let help = message!("allowed: {least} to {most} degrees, {what}", least, most, what = what());
                self.wrong(&path.key(key), message!("`{path}.{key}` is {angle}", path, key, angle), help);
            }
            is_within
        };
        let tilt_fits =
            is_within("tilt", tilt, 0.0, limits::TILT, || message!("from −z: 0 is straight down −z, 90 horizontal"));
        let azimuth = aim.azimuth.unwrap_or(Aim::DEFAULT_AZIMUTH);
        let azimuth_fits =
            is_within("azimuth", azimuth, -limits::AZIMUTH, limits::AZIMUTH, || message!("from +x towards +y"));
        if !(tilt_fits && azimuth_fits) {
            return None;
        }
        let [cosine, sine] = cosine_and_sine(tilt);
        if aim.azimuth.is_none() && sine != 0.0 {
            let help = message!("write `azimuth = …`, in degrees from +x towards +y: the way that it leans");
            self.problems.missing(path, "azimuth", help);
            return None;
        }
        let [along_x, along_y] = cosine_and_sine(azimuth);
        Some(Vector::new(sine * along_x, sine * along_y, -cosine))
    }
}

/// The ways to write a direction, of which one is chosen.
pub(super) struct Aim {
    /// As such, and the name of its key.
    pub(super) direction: (&'static str, Option<[f64; 3]>),
    /// By a point that it leads to.
    pub(super) target: Option<[f64; 3]>,
    /// By its angle from −z, in degrees.
    pub(super) tilt: Option<f64>,
    /// And by the way that it leans, in degrees from +x towards +y.
    pub(super) azimuth: Option<f64>,
}

impl Aim {
    /// Where a direction straight along z leans if that is not said: towards +y, the top of the picture.
    const DEFAULT_AZIMUTH: f64 = 90.0;

    /// The direction in which one given by angles rises with its tilt; `None` if it is given otherwise.
    pub(super) fn rise(&self) -> Option<Vector> {
        let [cosine, sine] = cosine_and_sine(self.tilt?);
        let [along_x, along_y] = cosine_and_sine(self.azimuth.unwrap_or(Self::DEFAULT_AZIMUTH));
        Some(Vector::new(cosine * along_x, cosine * along_y, sine))
    }
}

/// Cosine and sine of an angle in degrees: exactly 0 and ±1 at right angles.
fn cosine_and_sine(degrees: f64) -> [f64; 2] {
    let quarters = degrees / 90.0;
    if quarters.fract() == 0.0 {
        let [east, north, west, south] = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        return match quarters.rem_euclid(4.0) {
            1.0 => north,
            2.0 => west,
            3.0 => south,
            _ => east,
        };
    }
    let radians = degrees.to_radians();
    [libm::cos(radians), libm::sin(radians)]
}

pub(super) fn vector_text(vector: [f64; 3]) -> String {
    let [x, y, z] = vector;
    format!("[{x}, {y}, {z}]")
}
