//! The observer: where the rays start and through which window they go (2.1), (2.3).

use serde::{Deserialize, Serialize};

use crate::map::{Pixel, Resolution};
use crate::real::Scalar;
use crate::shape::Ray;
use crate::units::Choice;
use crate::vector::Vector;

/// Which way x runs on the screen (2.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Handedness {
    /// right = up × forward: x right, y up, z away from the viewer, as on a blackboard.
    Left,
    /// right = forward × up.
    Right,
}

impl Choice for Handedness {
    const ALL: &'static [Self] = &[Self::Left, Self::Right];

    fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }
}

/// A pinhole camera. Lengths in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// O.
    pub eye: Vector,
    /// The direction of view; of any length but zero.
    pub forward: Vector,
    /// A direction that appears vertical; of any length but zero, not parallel to `forward`.
    pub up: Vector,
    /// Which way x runs.
    pub handedness: Handedness,
    /// The window.
    pub screen: Screen,
    /// Pixels of the full image.
    pub resolution: Resolution,
}

/// The window through which the camera looks. Lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screen {
    /// From the eye to the screen plane.
    pub distance: f64,
    /// Left and right edge.
    pub x: [f64; 2],
    /// Lower and upper edge.
    pub y: [f64; 2],
}

/// A place on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ScreenPosition {
    /// The centre of a pixel of the full image.
    PixelCenter(Pixel),
    /// A place in a pixel of the full image.
    InPixel {
        /// The pixel.
        pixel: Pixel,
        /// Parts of its width and height, from its upper left corner.
        place: [f64; 2],
    },
    /// A point of the screen plane, in metres.
    Point {
        /// To the right.
        x: f64,
        /// Upwards.
        y: f64,
    },
}

/// The camera's axes, computed once for a number type.
#[derive(Clone, Copy, Debug)]
pub struct CameraFrame<T = f64> {
    /// O.
    pub eye: Vector<T>,
    /// Unit vector of +x on the screen.
    pub right: Vector<T>,
    /// Unit vector of +y on the screen.
    pub up: Vector<T>,
    /// Unit vector of the direction of view.
    pub forward: Vector<T>,
    pub(crate) screen: Screen,
    pub(crate) resolution: Resolution,
}

impl<T: Scalar> CameraFrame<T> {
    /// The axes of a camera (2.3).
    #[must_use]
    pub fn new(camera: &Camera) -> Self {
        let forward = Vector::from_f64(camera.forward).normalized();
        let up_given = Vector::from_f64(camera.up).normalized();
        let right = match camera.handedness {
            Handedness::Left => up_given.cross(forward),
            Handedness::Right => forward.cross(up_given),
        }
        .normalized();
        let up = match camera.handedness {
            Handedness::Left => forward.cross(right),
            Handedness::Right => right.cross(forward),
        };
        let Camera { screen, resolution, .. } = *camera;
        Self { eye: Vector::from_f64(camera.eye), right, up, forward, screen, resolution }
    }

    /// The ray from the eye through a place on the screen (2.1).
    #[inline]
    pub fn ray(&self, position: ScreenPosition) -> Ray<T> {
        let (x, y) = self.screen_point(position);
        let direction = self.forward * T::from_f64(self.screen.distance) + self.right * x + self.up * y;
        let nothing = T::zero();
        let offset = Vector::new(nothing, nothing, nothing);
        Ray { anchor: self.eye, offset, direction: direction.normalized() }
    }

    fn screen_point(&self, position: ScreenPosition) -> (T, T) {
        match position {
            ScreenPosition::PixelCenter(pixel) => self.screen_point(ScreenPosition::InPixel { pixel, place: [0.5; 2] }),
            ScreenPosition::InPixel { pixel, place: [across, down] } => {
                let Resolution { width, height } = self.resolution;
                let [left, right] = self.screen.x;
                let [bottom, top] = self.screen.y;
                let column = f64::from(pixel.column) + (across - 0.5);
                let row = f64::from(pixel.row) + (down - 0.5);
                (between(left, right, column, width), between(top, bottom, row, height))
            }
            ScreenPosition::Point { x, y } => (T::from_f64(x), T::from_f64(y)),
        }
    }
}

impl CameraFrame {
    /// x and y on the screen of a place on it, in metres.
    #[must_use]
    pub fn point_on_screen(&self, position: ScreenPosition) -> [f64; 2] {
        let (x, y) = self.screen_point(position);
        [x, y]
    }

    /// Where a point in space appears on the screen plane, x and y in metres; nothing for a point that is not in
    /// front of the eye.
    #[must_use]
    pub fn project(&self, point: Vector) -> Option<[f64; 2]> {
        let from_eye = point - self.eye;
        let ahead = from_eye.dot(self.forward);
        (ahead > 0.0).then(|| {
            let scale = self.screen.distance / ahead;
            [from_eye.dot(self.right) * scale, from_eye.dot(self.up) * scale]
        })
    }
}

/// The middle of cell `index` (a cell, a place between the middles of two, or beside them) when the way from `first` to `last` is cut into
/// `count` cells. The two ends are
/// weighted, not their difference, so that a symmetric window has exactly symmetric pixels.
pub(crate) fn between<T: Scalar>(first: f64, last: f64, index: f64, count: u32) -> T {
    let after = 2.0 * index + 1.0;
    let before = 2.0 * f64::from(count) - after;
    let weighted = T::from_f64(first) * T::from_f64(before) + T::from_f64(last) * T::from_f64(after);
    weighted / T::from_f64(2.0 * f64::from(count))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lab(handedness: Handedness) -> Camera {
        Camera {
            eye: Vector::default(),
            forward: Vector::new(0.0, 0.0, 2.0),
            up: Vector::new(0.0, 3.0, 0.0),
            handedness,
            screen: Screen { distance: 5.0, x: [-4.0, 4.0], y: [-3.0, 3.0] },
            resolution: Resolution { width: 800, height: 600 },
        }
    }

    #[test]
    fn handedness_decides_which_way_x_runs() {
        let left = CameraFrame::<f64>::new(&lab(Handedness::Left));
        assert_eq!(left.right, Vector::new(1.0, 0.0, 0.0));
        assert_eq!(left.up, Vector::new(0.0, 1.0, 0.0));
        let right = CameraFrame::<f64>::new(&lab(Handedness::Right));
        assert_eq!(right.right, Vector::new(-1.0, 0.0, 0.0));
        assert_eq!(right.up, Vector::new(0.0, 1.0, 0.0));
    }

    #[test]
    fn the_first_pixel_is_the_top_left_one_and_its_centre_half_a_pixel_inside() {
        let frame = CameraFrame::<f64>::new(&lab(Handedness::Left));
        let point = |column, row| frame.point_on_screen(ScreenPosition::PixelCenter(Pixel { column, row }));
        assert_eq!(point(0, 0), [-3.995, 2.995]);
        assert_eq!(point(799, 599), [3.995, -2.995]);
        assert_eq!(point(400, 299), [0.005, 0.005]);
    }

    #[test]
    fn a_tilted_camera_keeps_up_upright() {
        let mut camera = lab(Handedness::Right);
        camera.forward = Vector::new(1.0, -1.0, 0.5);
        let frame = CameraFrame::<f64>::new(&camera);
        assert!(frame.right.y.abs() < 1e-15, "the horizon stays horizontal");
        assert!(frame.up.y > 0.0);
        assert!((frame.up.length() - 1.0).abs() < 1e-15);
        assert!((frame.right.cross(frame.up) + frame.forward).length() < 1e-15, "right × up = −forward");
    }

    #[test]
    fn projection_undoes_the_ray() {
        let mut camera = lab(Handedness::Left);
        camera.eye = Vector::new(1.0, 2.0, 3.0);
        camera.forward = Vector::new(0.3, -0.2, 0.9);
        let frame = CameraFrame::<f64>::new(&camera);
        let position = ScreenPosition::Point { x: 0.7, y: -1.3 };
        let ray = frame.ray(position);
        let [x, y] = frame.project(ray.anchor + ray.direction * 7.0).expect("it is ahead");
        assert!((x - 0.7).abs() < 1e-14 && (y + 1.3).abs() < 1e-14);
        assert_eq!(frame.project(ray.anchor - ray.direction), None);
    }
}
