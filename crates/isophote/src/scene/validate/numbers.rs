//! Validates points, sizes, directions and fractions.

use super::Validator;
use crate::scene::document::Path;
use crate::scene::limits;
use crate::vector::Vector;

impl Validator<'_> {
    pub(super) fn required_point(&mut self, path: &Path, key: &str, point: Option<[f64; 3]>) -> Option<Vector> {
        let Some(point) = point else {
            self.problems.missing(path, key, format!("write `{key} = [x, y, z]`"));
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
        let help = format!("allowed: coordinates from {:e} to {bound:e} {}", -bound, self.unit());
        self.wrong(path, format!("`{path}` is too far away"), &help);
    }

    pub(super) fn required_size(&mut self, path: &Path, key: &str, size: Option<f64>) -> Option<f64> {
        let Some(size) = size else {
            self.problems.missing(path, key, format!("write `{key} = …`, a length above 0"));
            return None;
        };
        self.size(&path.key(key), size)
    }

    /// Three sizes; all of their mistakes are reported.
    pub(super) fn required_sizes(&mut self, path: &Path, key: &str, sizes: Option<[f64; 3]>) -> Option<Vector> {
        let Some([x, y, z]) = sizes else {
            self.problems.missing(path, key, format!("write `{key} = [x, y, z]`, lengths above 0"));
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
        let help = format!("allowed: above 0 ({smallest:e} to {largest:e} {})", self.unit());
        self.wrong(path, format!("`{path}` is {size}"), &help);
        None
    }

    pub(super) fn required_direction(&mut self, path: &Path, key: &str, written: Option<[f64; 3]>) -> Option<Vector> {
        let Some(direction) = written else {
            self.problems.missing(path, key, format!("write `{key} = [x, y, z]`, a direction of any length but zero"));
            return None;
        };
        self.direction(&path.key(key), direction)
    }

    pub(super) fn direction(&mut self, path: &Path, direction: [f64; 3]) -> Option<Vector> {
        let largest = direction.iter().fold(0.0_f64, |largest, component| largest.max(component.abs()));
        if !(1e-100..=1e100).contains(&largest) {
            let what = if largest < 1.0 { "has no length" } else { "is too long" };
            let message = format!("`{path}` {what}: {}", vector_text(direction));
            self.wrong(path, message, "allowed: any direction, of any length from 1e-100 to 1e100");
            return None;
        }
        // Scaled by a power of two, which changes no digits, so that the squares neither underflow nor overflow.
        let scale = libm::exp2(-libm::floor(libm::log2(largest)));
        Some(Vector::from(direction.map(|component| component * scale)))
    }

    /// A direction that is given directly or by a target point.
    pub(super) fn direction_or_target(
        &mut self,
        path: &Path,
        from: Option<Vector>,
        (key, direction): (&str, Option<[f64; 3]>),
        target: Option<[f64; 3]>,
    ) -> Option<Vector> {
        match (direction, target) {
            (Some(direction), None) => self.direction(&path.key(key), direction),
            (None, Some(target)) => {
                let to_target = self.point(&path.key("target"), target)? - from?;
                if to_target.length() < limits::SMALLEST {
                    let message = format!("`{path}.target` is where `{path}` itself is");
                    self.wrong(&path.key("target"), message, "allowed: any other point");
                    return None;
                }
                Some(to_target)
            }
            (Some(_), Some(_)) => {
                let message = format!("`{path}` has both `{key}` and `target`");
                self.wrong(&path.key("target"), message, "allowed: one of the two");
                None
            }
            (None, None) => {
                let help = format!("write `{key} = [x, y, z]`, a direction, or `target = [x, y, z]`, a point");
                self.problems.missing(path, key, help);
                None
            }
        }
    }
}

pub(super) fn vector_text(vector: [f64; 3]) -> String {
    let [x, y, z] = vector;
    format!("[{x}, {y}, {z}]")
}
