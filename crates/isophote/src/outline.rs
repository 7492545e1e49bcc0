//! Where a shape appears on the screen: for renderers that work along rows instead of tracing ray by ray.

use crate::camera::{CameraFrame, Projection, Screen, between};
use crate::double_double::{DoubleDouble, ExactProduct};
use crate::map::Resolution;
use crate::real::Real;
use crate::shape::{Geometry, Sphere, SurfacePoint};
use crate::vector::Vector;

/// Where a shape appears on the screen.
#[derive(Clone, Debug)]
pub enum Outline {
    /// Nowhere: it is behind the eye.
    Unseen,
    /// Within an ellipse.
    Ellipse(Box<Ellipse>),
    /// In a region without such a simple form: the eye is inside, or the shape extends beside or behind it.
    Unknown,
}

impl Outline {
    /// Where a shape appears on the screen.
    #[must_use]
    pub fn of(geometry: &Geometry, frame: &CameraFrame<DoubleDouble>) -> Self {
        match geometry {
            Geometry::Sphere(sphere) if sphere.signed_distance(frame.eye.map(DoubleDouble::rounded)) > 0.0 => {
                Ellipse::of_sphere(sphere, frame)
            }
            _ => Self::Unknown,
        }
    }
}

/// The outline of a sphere that is wholly in front of the eye, and what its pixels see.
///
/// In units of the radius, relative to the eye, with the screen at distance 1, the sphere's centre is c and a ray has the
/// direction d = (x, y, 1). Its clearance cos²θ_o is
///
/// ```text
/// cos²θ_o = 1 − ‖d × c‖²/‖d‖² = A (x − x_a)(x_b − x)/‖d‖²,   A = c_y² + c_z² − 1
/// x_a, x_b = m ∓ w,   m = c_x (y c_y + c_z)/A,   w² = (‖c‖² − 1) Z (y − y_a)(y_b − y)/A²
/// y_a, y_b = (c_y c_z ∓ √A)/Z,   Z = c_z² − 1
/// ```
///
/// Everything is computed once with 32 digits, in pixels relative to the one nearest to the outline's middle. After that, a
/// double loses no digits because of a great distance, or because a small outline is far from the axis. What remains is the
/// rounding of the roots themselves, a few ε of the clearance anywhere.
#[derive(Clone, Copy, Debug)]
pub struct Ellipse<T = f64> {
    /// The pixel relative to which columns and rows are counted: whole numbers, not always within the image.
    pub column: T,
    /// See [`column`](Self::column).
    pub row: T,
    /// The rows where the outline begins and ends, relative to `row`.
    pub rows: [T; 2],
    /// m, relative to `column`, in the row `row`, and its change per row.
    pub middle: [T; 2],
    /// w² over (v − v_a)(v_b − v), in pixels.
    pub width_squared: T,
    /// cos²θ_o ‖d‖² over (u − u_a)(u_b − u), in pixels.
    pub clearance: T,
    /// d at the reference pixel, and its change per column and per row.
    pub direction: [Vector<T>; 3],
    /// d × c likewise.
    pub moment: [Vector<T>; 3],
    /// The vector from the eye to the centre, in radii.
    pub center: Vector<T>,
}

/// A row of an outline, in any number type. u is a column, relative to [`Ellipse::column`].
#[derive(Clone, Copy, Debug)]
pub struct RowOfEllipse<T = f64> {
    /// Where the outline begins and ends; twice the same number if the row misses it.
    pub roots: [T; 2],
    /// cos²θ_o ‖d‖² over (u − u_a)(u − u_b): negative.
    pub clearance: T,
    /// d at u = 0.
    pub direction: Vector<T>,
    /// The change of d per column.
    pub direction_step: Vector<T>,
    /// d × c at u = 0, in radii.
    pub moment: Vector<T>,
    /// The change of d × c per column.
    pub moment_step: Vector<T>,
    /// The vector from the eye to the centre, in radii.
    pub center: Vector<T>,
}

/// A position in a row of an outline, with distances from the roots, which are accurate near the outline.
#[derive(Clone, Copy, Debug)]
pub struct PlaceInRow<T = f64> {
    /// u.
    pub column: T,
    /// u − u_a.
    pub after_first: T,
    /// u − u_b.
    pub after_last: T,
}

/// What is seen at a position in a row.
#[derive(Clone, Copy, Debug)]
pub struct PointInRow<T = f64> {
    /// The point, in radii from the centre, which is its anchor.
    pub point: SurfacePoint<T>,
    /// t, the distance from the eye, in radii.
    pub distance: T,
}

impl<T: Copy> RowOfEllipse<T> {
    /// The row in another number type.
    #[must_use]
    #[inline(always)]
    pub fn map<U>(&self, convert: impl Fn(T) -> U) -> RowOfEllipse<U> {
        RowOfEllipse {
            roots: [convert(self.roots[0]), convert(self.roots[1])],
            clearance: convert(self.clearance),
            direction: self.direction.map(&convert),
            direction_step: self.direction_step.map(&convert),
            moment: self.moment.map(&convert),
            moment_step: self.moment_step.map(&convert),
            center: self.center.map(&convert),
        }
    }
}

impl RowOfEllipse {
    /// The clearance cos²θ_o at a column: negative outside the outline; in a row that misses it, not as negative as it
    /// should be.
    #[must_use]
    #[inline(always)]
    pub fn clearance_at(&self, u: f64) -> f64 {
        let [first, last] = self.roots;
        let direction = self.direction + self.direction_step * u;
        self.clearance * (u - first) * (u - last) / direction.dot(direction)
    }
}

impl<T: Real> RowOfEllipse<T> {
    /// The point of the sphere at a position; meaningless outside the outline.
    ///
    /// P − C = d × (d × c)/‖d‖² − cosθ_o d/‖d‖ in radii: the perpendicular from the centre to the ray, and half the chord.
    #[inline(always)]
    pub fn point(&self, anchor: Vector, place: &PlaceInRow<T>) -> PointInRow<T> {
        let u = place.column;
        let direction = self.direction_step.mul_add(u, self.direction);
        let moment = self.moment_step.mul_add(u, self.moment);
        let inverse_length = direction.dot(direction).inverse_sqrt();
        let clearance = self.clearance * place.after_first * place.after_last;
        let cos_theta_o = clearance.max_zero().sqrt() * inverse_length;
        let unit = direction * inverse_length;
        let normal = unit.mul_add(-cos_theta_o, unit.cross(moment * inverse_length));
        let point = SurfacePoint { anchor, offset: normal, normal, view: -unit, cos_theta_o };
        PointInRow { point, distance: unit.dot(self.center) - cos_theta_o }
    }
}

/// How far in front of the eye, in radii, the nearest point of a sphere must be for its ellipse to be reliable.
pub(crate) const BEFORE_THE_EYE: f64 = 1e-3;

impl Ellipse {
    /// The outline of a sphere.
    fn of_sphere(sphere: &Sphere, frame: &CameraFrame<DoubleDouble>) -> Outline {
        let Projection::Perspective(window) = &frame.projection else { return Outline::Unknown };
        let grid = PixelGrid::new(frame, window);
        let from_eye = grid.seen_from_eye(Vector::from_f64(sphere.center), DoubleDouble::from_f64(sphere.radius));
        let in_camera = grid.in_camera(from_eye);
        let z = in_camera.z.rounded();
        if z <= -1.0 {
            return Outline::Unseen;
        }
        if z < 1.0 + BEFORE_THE_EYE {
            let is_outside = is_beside_the_window(in_camera.map(DoubleDouble::rounded).to_array(), window);
            return if is_outside { Outline::Unseen } else { Outline::Unknown };
        }
        Outline::Ellipse(Box::new(Self::new(from_eye, in_camera, &grid)))
    }

    /// A row of the image.
    #[must_use]
    #[inline(always)]
    pub fn in_row(&self, row: u32) -> RowOfEllipse {
        self.row_at(f64::from(row) - self.row)
    }

    /// Whether the numbers of its rows, and their squares and products, are within the range of single precision, and its
    /// columns are whole numbers there.
    #[must_use]
    pub fn fits_single(&self) -> bool {
        const FARTHEST_COLUMN: f64 = 4e6;
        let half_height = 0.5 * (self.rows[1] - self.rows[0]);
        let columns = [self.column, half_height * self.middle[1], half_height * self.width_squared.sqrt()];
        if !columns.iter().all(|column| column.abs() < FARTHEST_COLUMN) {
            return false;
        }
        let fits = |number: f64| number == 0.0 || (1e-15..1e15).contains(&number.abs());
        let steps = [self.direction[1], self.direction[2]].into_iter().map(Vector::length);
        let outline = [self.clearance * self.width_squared, self.rows[1] - self.rows[0], self.center.length()];
        steps.chain(outline).all(fits)
    }

    /// Its area, in pixels.
    #[must_use]
    pub fn area(&self) -> f64 {
        let half_height = 0.5 * (self.rows[1] - self.rows[0]);
        std::f64::consts::PI * half_height * half_height * self.width_squared.sqrt()
    }

    /// t, the distance from the eye at a column of the image in a row, in radii; for a pixel that the outline covers.
    #[must_use]
    pub fn distance_at(&self, row: u32, column: f64) -> f64 {
        let row = self.in_row(row);
        let u = column - self.column;
        let direction = row.direction + row.direction_step * u;
        direction.normalized().dot(self.center) - row.clearance_at(u).max(0.0).sqrt()
    }
}

impl<T: ExactProduct> Ellipse<T> {
    /// The outline of a sphere that is at least [`BEFORE_THE_EYE`] in front of the eye, given by its centre relative to the
    /// eye, in radii, in the axes of the scene and in those of the camera.
    #[inline(always)]
    pub(crate) fn new(
        from_eye: Vector<DoubleDouble<T>>,
        in_camera: Vector<DoubleDouble<T>>,
        grid: &PixelGrid<T>,
    ) -> Self {
        let Vector { x, y, z } = in_camera;
        let one = x.splat_like(1.0);
        let a = y * y + z * z - one;
        let z_part = z * z - one;
        let root = a.sqrt();
        let (per_a, per_z_part) = (one / a, one / z_part);
        let y_middle = y * z * per_z_part;
        let reach = root * per_z_part;
        let row = nearest_whole((y_middle - grid.first_y) * grid.per_row);
        let y_of_row = grid.first_y + grid.row_step * DoubleDouble::exactly(row);
        let middle_there = x * (y_middle * y + z) * per_a;
        let column = nearest_whole((middle_there - grid.first_x) * grid.per_column);
        let x_of_column = grid.first_x + grid.column_step * DoubleDouble::exactly(column);
        let first = ((y_middle - reach - y_of_row) * grid.per_row).nearest();
        let last = ((y_middle + reach - y_of_row) * grid.per_row).nearest();
        let is_upright = first.is_less(last);
        let rows = [T::select(is_upright, first, last), T::select(is_upright, last, first)];
        let gap_squared = x * x + y * y + z_part;
        let stretch = grid.row_step * grid.per_column * per_a;
        let direction = grid.forward + grid.right * x_of_column + grid.up * y_of_row;
        let [by_column, by_row] = [grid.right * grid.column_step, grid.up * grid.row_step];
        let middle = x * (y_of_row * y + z) * per_a;
        Self {
            column,
            row,
            rows,
            middle: [((middle - x_of_column) * grid.per_column).nearest(), (x * y * stretch).nearest()],
            width_squared: (gap_squared * z_part * stretch * stretch).nearest(),
            clearance: (a * grid.column_step * grid.column_step).nearest(),
            direction: [nearest(direction), nearest(by_column), nearest(by_row)],
            moment: [
                nearest(direction.cross(from_eye)),
                nearest(by_column.cross(from_eye)),
                nearest(by_row.cross(from_eye)),
            ],
            center: nearest(from_eye),
        }
    }
}

#[inline(always)]
fn nearest<T: ExactProduct>(vector: Vector<DoubleDouble<T>>) -> Vector<T> {
    Vector::new(vector.x.nearest(), vector.y.nearest(), vector.z.nearest())
}

impl<T: Copy> Ellipse<T> {
    /// The same outline in another number type.
    #[inline(always)]
    pub fn map<U>(&self, convert: impl Fn(T) -> U) -> Ellipse<U> {
        Ellipse {
            column: convert(self.column),
            row: convert(self.row),
            rows: [convert(self.rows[0]), convert(self.rows[1])],
            middle: [convert(self.middle[0]), convert(self.middle[1])],
            width_squared: convert(self.width_squared),
            clearance: convert(self.clearance),
            direction: [
                self.direction[0].map(&convert),
                self.direction[1].map(&convert),
                self.direction[2].map(&convert),
            ],
            moment: [self.moment[0].map(&convert), self.moment[1].map(&convert), self.moment[2].map(&convert)],
            center: self.center.map(&convert),
        }
    }
}

impl<T: Copy> Ellipse<T> {
    /// An outline with all numbers equal.
    pub(crate) fn filled_with(number: T) -> Self {
        let vector = Vector { x: number, y: number, z: number };
        Self {
            column: number,
            row: number,
            rows: [number; 2],
            middle: [number; 2],
            width_squared: number,
            clearance: number,
            direction: [vector; 3],
            moment: [vector; 3],
            center: vector,
        }
    }

    /// Stores each number in its place in another outline.
    #[inline(always)]
    pub(crate) fn put_into<U>(self, other: &mut Ellipse<U>, mut put: impl FnMut(T, &mut U)) {
        let mut vector = |from: Vector<T>, to: &mut Vector<U>| {
            put(from.x, &mut to.x);
            put(from.y, &mut to.y);
            put(from.z, &mut to.z);
        };
        for (from, to) in self.direction.into_iter().zip(&mut other.direction) {
            vector(from, to);
        }
        for (from, to) in self.moment.into_iter().zip(&mut other.moment) {
            vector(from, to);
        }
        vector(self.center, &mut other.center);
        put(self.column, &mut other.column);
        put(self.row, &mut other.row);
        for (from, to) in self.rows.into_iter().zip(&mut other.rows) {
            put(from, to);
        }
        for (from, to) in self.middle.into_iter().zip(&mut other.middle) {
            put(from, to);
        }
        put(self.width_squared, &mut other.width_squared);
        put(self.clearance, &mut other.clearance);
    }
}

impl<T: Real> Ellipse<T> {
    /// A row, relative to [`row`](Self::row).
    #[must_use]
    #[inline(always)]
    pub fn row_at(&self, v: T) -> RowOfEllipse<T> {
        let width_squared = self.width_squared * ((v - self.rows[0]) * (self.rows[1] - v));
        // Only a nearly double root would need to know by how much it misses the row; the clearance handles that.
        let width = width_squared.max_zero().sqrt();
        let middle = self.middle[0] + self.middle[1] * v;
        RowOfEllipse {
            roots: [middle - width, middle + width],
            clearance: -self.clearance,
            direction: self.direction[0] + self.direction[2] * v,
            direction_step: self.direction[1],
            moment: self.moment[0] + self.moment[2] * v,
            moment_step: self.moment[1],
            center: self.center,
        }
    }
}

/// Whether a sphere of radius 1 is entirely beyond one of the four planes through the eye and an edge of the window.
fn is_beside_the_window([x, y, z]: [f64; 3], window: &Screen) -> bool {
    let beyond = |along: f64, [low, high]: [f64; 2]| {
        let [low, high] = [low, high].map(|edge| edge / window.distance);
        let below = (low * z - along) / low.hypot(1.0);
        let above = (along - high * z) / high.hypot(1.0);
        below.max(above) > 1.0 + 1e-9
    };
    beyond(x, window.x) || beyond(y, window.y)
}

/// The grid of pixel centres on a screen at distance 1, and the axes of the camera.
#[derive(Clone, Copy)]
pub(crate) struct PixelGrid<T = f64> {
    eye: Vector<DoubleDouble<T>>,
    right: Vector<DoubleDouble<T>>,
    up: Vector<DoubleDouble<T>>,
    forward: Vector<DoubleDouble<T>>,
    /// x of column 0, y of row 0.
    first_x: DoubleDouble<T>,
    first_y: DoubleDouble<T>,
    column_step: DoubleDouble<T>,
    row_step: DoubleDouble<T>,
    per_column: DoubleDouble<T>,
    per_row: DoubleDouble<T>,
}

impl PixelGrid {
    /// The grid of a camera.
    pub fn new(frame: &CameraFrame<DoubleDouble>, window: &Screen) -> Self {
        let exact = DoubleDouble::from_f64;
        let per_distance = exact(1.0) / exact(window.distance);
        let step =
            |first: f64, last: f64, count: u32| (exact(last) - exact(first)) * per_distance / exact(f64::from(count));
        let Resolution { width, height } = frame.resolution;
        let [left, right] = window.x;
        let [bottom, top] = window.y;
        let [across, down] = frame.place;
        let (column_step, row_step) = (step(left, right, width), step(top, bottom, height));
        Self {
            eye: frame.eye,
            right: frame.right,
            up: frame.up,
            forward: frame.forward,
            first_x: between::<DoubleDouble>(left, right, across - 0.5, width) * per_distance,
            first_y: between::<DoubleDouble>(top, bottom, down - 0.5, height) * per_distance,
            column_step,
            row_step,
            per_column: exact(1.0) / column_step,
            per_row: exact(1.0) / row_step,
        }
    }

    /// x of column 0 and y of row 0, and their steps from pixel to pixel.
    pub fn rounded(&self) -> ([f64; 2], [f64; 2]) {
        ([self.first_x.rounded(), self.first_y.rounded()], [self.column_step.rounded(), self.row_step.rounded()])
    }

    /// The same grid for vectors of doubles.
    #[inline(always)]
    pub fn map<U>(&self, convert: impl Fn(f64) -> U) -> PixelGrid<U> {
        PixelGrid {
            eye: vector_of(self.eye, &convert),
            right: vector_of(self.right, &convert),
            up: vector_of(self.up, &convert),
            forward: vector_of(self.forward, &convert),
            first_x: self.first_x.map(&convert),
            first_y: self.first_y.map(&convert),
            column_step: self.column_step.map(&convert),
            row_step: self.row_step.map(&convert),
            per_column: self.per_column.map(&convert),
            per_row: self.per_row.map(&convert),
        }
    }
}

#[inline(always)]
fn vector_of<U>(vector: Vector<DoubleDouble>, convert: &impl Fn(f64) -> U) -> Vector<DoubleDouble<U>> {
    Vector { x: vector.x.map(convert), y: vector.y.map(convert), z: vector.z.map(convert) }
}

impl<T: ExactProduct> PixelGrid<T> {
    /// The vector from the eye to a centre, in radii.
    #[inline(always)]
    pub fn seen_from_eye(&self, center: Vector<DoubleDouble<T>>, radius: DoubleDouble<T>) -> Vector<DoubleDouble<T>> {
        (center - self.eye) * (radius.splat_like(1.0) / radius)
    }

    /// A vector converted to the axes of the camera: right, up, forward.
    #[inline(always)]
    pub fn in_camera(&self, from_eye: Vector<DoubleDouble<T>>) -> Vector<DoubleDouble<T>> {
        Vector::new(self.right.dot(from_eye), self.up.dot(from_eye), self.forward.dot(from_eye))
    }
}

/// The nearest integer, up to [`FARTHEST`].
#[inline(always)]
fn nearest_whole<T: ExactProduct>(number: DoubleDouble<T>) -> T {
    let number = number.nearest();
    let farthest = number.splat_like(FARTHEST);
    let bounded = -(-number.max(-farthest)).max(-farthest);
    // Adding and subtracting 1.5·2⁵² drops the fraction.
    let magic = number.splat_like(6_755_399_441_055_744.0);
    (bounded + magic) - magic
}

/// Columns and rows are exact up to here.
const FARTHEST: f64 = 1e15;
