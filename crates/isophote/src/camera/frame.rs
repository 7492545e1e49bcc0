//! The camera's axes, its rays, and the projection of points in space onto the screen.

use super::{Camera, Extent, Handedness, Projection, ScreenPosition, panorama};
use crate::double_double::{DoubleDouble, ExactProduct};
use crate::map::Resolution;
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vector::Vector;

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
    pub(crate) projection: Projection,
    pub(crate) resolution: Resolution,
    /// Where a pixel's ray passes through it: fractions of its width and height, from its upper left corner.
    pub(crate) place: [f64; 2],
    extent: Extent,
    /// `right` and `up` with 32 digits, for rays that start beside the eye.
    across: [Vector<DoubleDouble>; 2],
}

/// The line of sight to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// Where the ray to the point starts, in metres: the eye, or a point of the plane through it.
    pub start: Vector,
    /// V, the unit vector from the point back along the ray.
    pub view: Vector,
    /// The distance from the start to the point, in metres; negative if parallel rays start beyond the point and do not see
    /// it.
    pub distance: f64,
}

impl<T: Scalar> CameraFrame<T> {
    /// The axes of a camera (2.3).
    #[must_use]
    pub fn new(camera: &Camera) -> Self {
        let axes = Axes::<T>::new(camera);
        let precise = Axes::<DoubleDouble>::new(camera);
        let Camera { projection, resolution, .. } = *camera;
        Self {
            eye: Vector::from_f64(camera.eye),
            right: axes.right,
            up: axes.up,
            forward: axes.forward,
            projection,
            resolution,
            place: [0.5; 2],
            extent: projection.extent(resolution),
            across: [precise.right, precise.up],
        }
    }

    /// The ray through a screen position (2.1), (2.7) to (2.10); `None` where the camera sees nothing: outside the circle of
    /// a fisheye, or beyond the poles of a panorama.
    #[inline]
    pub fn ray(&self, position: ScreenPosition) -> Option<Ray<T>> {
        let direction = match &self.projection {
            Projection::Perspective(screen) => {
                let (x, y) = self.screen_point::<T>(position);
                self.forward * T::from_f64(screen.distance) + self.right * x + self.up * y
            }
            Projection::Orthographic(_) => return Some(self.parallel_ray(position)),
            Projection::Fisheye(fisheye) => {
                let (x, y) = self.screen_point(position);
                self.out_of_axes(fisheye.direction(x, y)?)
            }
            Projection::Panorama(_) => {
                let (longitude, latitude) = self.screen_point(position);
                self.out_of_axes(panorama::direction(longitude, latitude)?)
            }
        };
        let offset = Vector::zero();
        Some(Ray { anchor: self.eye, offset, direction: direction.normalized() })
    }

    /// The start is computed with 32 digits, and the lower half goes into the offset: otherwise a start far from the eye
    /// would lose digits of what the ray hits nearby.
    fn parallel_ray(&self, position: ScreenPosition) -> Ray<T> {
        let (x, y) = self.screen_point::<DoubleDouble>(position);
        let [right, up] = self.across;
        let start = self.eye.map(T::precise) + right * x + up * y;
        let anchor = start.map(DoubleDouble::rounded);
        let rest = start - Vector::from_f64(anchor);
        Ray { anchor: Vector::from_f64(anchor), offset: rest.map(T::from_precise), direction: self.forward }
    }

    fn out_of_axes(&self, Vector { x, y, z }: Vector<T>) -> Vector<T> {
        self.forward * z + self.right * x + self.up * y
    }

    fn screen_point<U: Scalar>(&self, position: ScreenPosition) -> (U, U) {
        match position {
            ScreenPosition::PixelCenter(pixel) => {
                self.screen_point(ScreenPosition::InPixel { pixel, place: self.place })
            }
            ScreenPosition::InPixel { pixel, place: [across, down] } => {
                let Resolution { width, height } = self.resolution;
                let [left, right] = self.extent.x;
                let [bottom, top] = self.extent.y;
                let column = f64::from(pixel.column) + (across - 0.5);
                let row = f64::from(pixel.row) + (down - 0.5);
                (between(left, right, column, width), between(top, bottom, row, height))
            }
            ScreenPosition::Point { x, y } => (U::from_f64(x), U::from_f64(y)),
        }
    }
}

/// A camera's rays, several at a time, with 32 digits.
pub(crate) struct PreciseCamera<'f> {
    frame: &'f CameraFrame<DoubleDouble>,
    /// What all rays have in common: the eye, or the direction of parallel rays.
    pub common: Vector<DoubleDouble>,
    /// One over twice the number of columns and of rows.
    inverse: [DoubleDouble; 2],
}

/// What differs from ray to ray.
pub(crate) struct Differing<T> {
    /// The directions, of any length, or the starts of parallel rays.
    pub vector: Vector<DoubleDouble<T>>,
    /// Beyond 1, the camera sees nothing.
    pub eccentricity: T,
}

impl CameraFrame<DoubleDouble> {
    /// Its rays.
    pub(crate) fn in_lanes(&self) -> PreciseCamera<'_> {
        let is_parallel = matches!(self.projection, Projection::Orthographic(_));
        let Resolution { width, height } = self.resolution;
        let inverse = [width, height].map(|count| DoubleDouble::from_f64(0.5) / DoubleDouble::from_f64(count.into()));
        PreciseCamera { frame: self, common: if is_parallel { self.forward } else { self.eye }, inverse }
    }
}

impl PreciseCamera<'_> {
    /// Whether the starts differ, and not the directions.
    pub fn is_parallel(&self) -> bool {
        matches!(self.frame.projection, Projection::Orthographic(_))
    }

    /// The rays at columns and rows counted from the centre of the first pixel, which may be fractional.
    #[inline(always)]
    pub fn at<T: ExactProduct>(&self, column: T, row: T) -> Differing<T> {
        let CameraFrame { right, up, forward, eye, extent: Extent { x, y: [bottom, top] }, resolution, .. } =
            self.frame;
        let x = between_exactly(*x, column, (resolution.width, self.inverse[0]));
        let y = between_exactly([*top, *bottom], row, (resolution.height, self.inverse[1]));
        let one = column.splat_like(1.0);
        let ([right, up, forward], zero) = ([right, up, forward].map(constants(one)), one.splat_like(0.0));
        match &self.frame.projection {
            Projection::Perspective(screen) => {
                let ahead = forward * DoubleDouble::exactly(one.splat_like(screen.distance));
                Differing { vector: ahead + right * x + up * y, eccentricity: zero }
            }
            Projection::Orthographic(_) => {
                Differing { vector: constants(one)(eye) + right * x + up * y, eccentricity: zero }
            }
            Projection::Fisheye(fisheye) => {
                let (direction, eccentricity) = fisheye.direction_in_lanes(x, y);
                Differing { vector: forward * direction.z + right * direction.x + up * direction.y, eccentricity }
            }
            Projection::Panorama(_) => {
                let (direction, eccentricity) = panorama::direction_in_lanes(x, y);
                Differing { vector: forward * direction.z + right * direction.x + up * direction.y, eccentricity }
            }
        }
    }
}

/// The same vector in every lane.
#[inline(always)]
fn constants<T: ExactProduct>(like: T) -> impl Fn(&Vector<DoubleDouble>) -> Vector<DoubleDouble<T>> {
    #[inline(always)]
    move |vector| {
        vector.map(
            #[inline(always)]
            |number| number.constant_like(like),
        )
    }
}

/// [`between`] for several cells at a time; with the number of cells, one over twice this number is given.
#[inline(always)]
fn between_exactly<T: ExactProduct>(
    [first, last]: [f64; 2],
    index: T,
    (count, inverse): (u32, DoubleDouble),
) -> DoubleDouble<T> {
    let after = index + index + index.splat_like(1.0);
    let before = index.splat_like(2.0 * f64::from(count)) - after;
    let weighted = DoubleDouble::product_of(index.splat_like(first), before)
        + DoubleDouble::product_of(index.splat_like(last), after);
    weighted * inverse.constant_like(index)
}

impl CameraFrame {
    /// x and y of a screen position, in metres or degrees.
    #[must_use]
    pub fn point_on_screen(&self, position: ScreenPosition) -> [f64; 2] {
        let (x, y) = self.screen_point(position);
        [x, y]
    }

    /// Where a point in space appears on the screen, x and y in metres or degrees; `None` for a point that the camera cannot
    /// see: behind it, or outside the circle of a fisheye.
    #[must_use]
    pub fn project(&self, point: Vector) -> Option<[f64; 2]> {
        let from_eye = point - self.eye;
        let [x, y, ahead] = [self.right, self.up, self.forward].map(|axis| from_eye.dot(axis));
        match &self.projection {
            Projection::Perspective(screen) => (ahead > 0.0).then(|| {
                let scale = screen.distance / ahead;
                [x * scale, y * scale]
            }),
            Projection::Orthographic(_) => (ahead > 0.0).then_some([x, y]),
            Projection::Fisheye(fisheye) => fisheye.project(Vector::new(x, y, ahead)),
            Projection::Panorama(extent) => Some(panorama::project(extent, Vector::new(x, y, ahead))),
        }
    }

    /// The column and row of a point on the screen, x and y in metres or degrees, counted from the upper left corner of the
    /// image: the centre of the first pixel is at (1/2, 1/2).
    #[must_use]
    pub fn column_and_row(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let part = |at: f64, [first, last]: [f64; 2], count: u32| (at - first) / (last - first) * f64::from(count);
        let ([left, right], [bottom, top]) = (self.extent.x, self.extent.y);
        [part(x, [left, right], self.resolution.width), part(y, [top, bottom], self.resolution.height)]
    }

    /// The line of sight to the point `anchor + offset`.
    #[must_use]
    pub fn sight(&self, anchor: Vector, offset: Vector) -> Sight {
        let to_eye = (self.eye - anchor) - offset;
        if let Projection::Orthographic(_) = self.projection {
            let (view, distance) = (-self.forward, -to_eye.dot(self.forward));
            return Sight { start: anchor + offset + view * distance, view, distance };
        }
        let distance = to_eye.length();
        Sight { start: self.eye, view: to_eye * (1.0 / distance), distance }
    }
}

/// The unit vectors of a camera.
struct Axes<T> {
    right: Vector<T>,
    up: Vector<T>,
    forward: Vector<T>,
}

impl<T: Scalar> Axes<T> {
    fn new(camera: &Camera) -> Self {
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
        Self { right, up, forward }
    }
}

/// The middle of cell `index` when the interval from `first` to `last` is divided into `count` cells; `index` may be
/// fractional or outside the interval. The two ends are weighted, rather than their difference, so that a symmetric window
/// has exactly symmetric pixels.
pub(crate) fn between<T: Scalar>(first: f64, last: f64, index: f64, count: u32) -> T {
    let after = 2.0 * index + 1.0;
    let before = 2.0 * f64::from(count) - after;
    let weighted = T::from_f64(first) * T::from_f64(before) + T::from_f64(last) * T::from_f64(after);
    weighted / T::from_f64(2.0 * f64::from(count))
}
