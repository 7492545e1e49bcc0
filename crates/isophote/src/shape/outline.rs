//! Where a shape appears on the screen: for renderers that go along rows instead of tracing ray by ray.

use super::{Sphere, SurfacePoint};
use crate::camera::{CameraFrame, Projection, Screen, between};
use crate::double_double::DoubleDouble;
use crate::real::{Real, Scalar};
use crate::vector::Vector;

/// Where a shape appears on the screen.
#[derive(Clone, Debug)]
pub enum Outline {
    /// Nowhere: it is behind the eye.
    Unseen,
    /// Within an ellipse.
    Ellipse(Box<Ellipse>),
    /// In a place that has no such simple form: the eye is inside, or the shape reaches beside or behind it.
    Unknown,
}

/// The outline of a sphere that is wholly before the eye, and what its pixels see.
///
/// In units of the radius from the eye, with the screen at distance 1, the sphere's centre is c and a ray goes along
/// d = (x, y, 1). Its clearance (see [`Approach`](super::Approach)) is
///
/// ```text
/// cos²θ_o = 1 − ‖d × c‖²/‖d‖² = A (x − x_a)(x_b − x)/‖d‖²,   A = c_y² + c_z² − 1
/// x_a, x_b = m ∓ w,   m = c_x (y c_y + c_z)/A,   w² = (‖c‖² − 1) Z (y − y_a)(y_b − y)/A²
/// y_a, y_b = (c_y c_z ∓ √A)/Z,   Z = c_z² − 1
/// ```
///
/// Everything is computed once in 32 digits and counted in pixels from the one nearest to the outline's middle: after
/// that a double loses no digit by a great distance, nor to a small outline far from the axis. What is left is the
/// rounding of the roots themselves, a few ε of the clearance anywhere.
#[derive(Clone, Copy, Debug)]
pub struct Ellipse {
    /// The pixel from which columns and rows are counted: whole numbers, not always within the image.
    pub column: f64,
    /// See [`column`](Self::column).
    pub row: f64,
    /// The rows where the outline begins and ends, counted from `row`.
    pub rows: [f64; 2],
    /// m, counted from `column`, in the row `row` and its growth from row to row.
    middle: [f64; 2],
    /// w² over (v − v_a)(v_b − v), in pixels.
    width_squared: f64,
    /// cos²θ_o ‖d‖² over (u − u_a)(u_b − u), in pixels.
    clearance: f64,
    /// d at the pixel from which is counted, and its growth from column to column and row to row.
    direction: [Vector; 3],
    /// d × c likewise.
    moment: [Vector; 3],
    /// From the eye to the centre, in radii.
    center: Vector,
}

/// A row of an outline, in any number type. u is a column, counted from [`Ellipse::column`].
#[derive(Clone, Copy, Debug)]
pub struct RowOfEllipse<T = f64> {
    /// Where the outline begins and ends; the same twice where the row misses it.
    pub roots: [f64; 2],
    /// cos²θ_o ‖d‖² over (u − u_a)(u − u_b): negative.
    pub clearance: T,
    /// d at u = 0.
    pub direction: Vector<T>,
    /// The growth of d from column to column.
    pub direction_step: Vector<T>,
    /// d × c at u = 0, in radii.
    pub moment: Vector<T>,
    /// The growth of d × c from column to column.
    pub moment_step: Vector<T>,
    /// From the eye to the centre, in radii.
    pub center: Vector<T>,
}

/// A place in a row of an outline, with the digits that near the outline only the roots know.
#[derive(Clone, Copy, Debug)]
pub struct PlaceInRow<T = f64> {
    /// u.
    pub column: T,
    /// u − u_a.
    pub after_first: T,
    /// u − u_b.
    pub after_last: T,
}

/// What is seen at a place in a row.
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
            roots: self.roots,
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
    /// The clearance cos²θ_o at a column: negative outside the outline, but in a row that misses it not as negative as it
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
    /// The point of the sphere at a place; anything outside the outline.
    ///
    /// P − C = d × (d × c)/‖d‖² − cosθ_o d/‖d‖ in radii: the perpendicular from the centre to the ray, and half the chord.
    #[inline(always)]
    pub fn point(&self, anchor: Vector, place: &PlaceInRow<T>) -> PointInRow<T> {
        let u = place.column;
        let direction = self.direction_step.times_plus(u, self.direction);
        let moment = self.moment_step.times_plus(u, self.moment);
        let inverse_length = u.constant(1.0) / direction.dot(direction).sqrt();
        let clearance = self.clearance * place.after_first * place.after_last;
        let cos_theta_o = clearance.or_zero().sqrt() * inverse_length;
        let unit = direction * inverse_length;
        let normal = unit.times_plus(-cos_theta_o, unit.cross(moment * inverse_length));
        let point = SurfacePoint { anchor, offset: normal, normal, view: -unit, cos_theta_o };
        PointInRow { point, distance: unit.dot(self.center) - cos_theta_o }
    }
}

/// How far before the eye, in radii, the nearest point of a sphere must be for an ellipse to be trusted.
const BEFORE_THE_EYE: f64 = 1e-3;

impl Ellipse {
    /// The outline of a sphere.
    pub(super) fn of_sphere(sphere: &Sphere, frame: &CameraFrame<DoubleDouble>) -> Outline {
        let Projection::Perspective(window) = frame.projection else { return Outline::Unknown };
        let exact = DoubleDouble::from_f64;
        let one = exact(1.0);
        let per_radius = one / exact(sphere.radius);
        let from_eye = (Vector::from_f64(sphere.center) - frame.eye) * per_radius;
        let [x, y, z] = [frame.right, frame.up, frame.forward].map(|axis| axis.dot(from_eye));
        if z.rounded() <= -1.0 {
            return Outline::Unseen;
        }
        if z.rounded() < 1.0 + BEFORE_THE_EYE {
            let is_outside = is_beside_the_window([x, y, z].map(DoubleDouble::rounded), &window);
            return if is_outside { Outline::Unseen } else { Outline::Unknown };
        }
        let a = y * y + z * z - one;
        let z_part = z * z - one;
        let root = a.sqrt();
        let screen = Pixels::new(frame, window);
        let y_roots = [(y * z - root) / z_part, (y * z + root) / z_part];
        let y_middle = y * z / z_part;
        let row = screen.row(y_middle);
        let y_of_row = screen.y(row);
        let middle = |y_screen: DoubleDouble| x * (y_screen * y + z) / a;
        let column = screen.column(middle(y_middle));
        let x_of_column = screen.x(column);
        let [first, last] = y_roots.map(|root| ((root - y_of_row) / screen.row_step).rounded());
        let per_column = one / screen.column_step;
        let gap_squared = x * x + y * y + z_part;
        let rows_over_columns = screen.row_step * per_column;
        let direction = frame.forward + frame.right * x_of_column + frame.up * y_of_row;
        let column_growth = frame.right * screen.column_step;
        let row_growth = frame.up * screen.row_step;
        let directions = [direction, column_growth, row_growth];
        Outline::Ellipse(Box::new(Self {
            column,
            row,
            rows: [first.min(last), first.max(last)],
            middle: [
                ((middle(y_of_row) - x_of_column) * per_column).rounded(),
                (x * y / a * rows_over_columns).rounded(),
            ],
            width_squared: (gap_squared * z_part * rows_over_columns * rows_over_columns / (a * a)).rounded(),
            clearance: (a * screen.column_step * screen.column_step).rounded(),
            direction: directions.map(|vector| vector.map(DoubleDouble::rounded)),
            moment: directions.map(|vector| vector.cross(from_eye).map(DoubleDouble::rounded)),
            center: from_eye.map(DoubleDouble::rounded),
        }))
    }

    /// A row of the image.
    #[must_use]
    #[inline(always)]
    pub fn in_row(&self, row: u32) -> RowOfEllipse {
        let v = f64::from(row) - self.row;
        let width_squared = self.width_squared * ((v - self.rows[0]) * (self.rows[1] - v));
        // Only a root that is nearly double needs to know how much it misses the row: the clearance tells.
        let width = width_squared.max(0.0).sqrt();
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

    /// Whether the numbers of its rows, and their squares and products, are within the range of single precision.
    #[must_use]
    pub fn fits_single(&self) -> bool {
        let fits = |number: f64| number == 0.0 || (1e-15..1e15).contains(&number.abs());
        let steps = [self.direction[1], self.direction[2]].into_iter().map(Vector::length);
        let outline = [self.clearance * self.width_squared, self.rows[1] - self.rows[0], self.center.length()];
        steps.chain(outline).all(fits)
    }

    /// Its area in pixels.
    #[must_use]
    pub fn area(&self) -> f64 {
        let half_height = 0.5 * (self.rows[1] - self.rows[0]);
        std::f64::consts::PI * half_height * half_height * self.width_squared.sqrt()
    }

    /// t, the distance from the eye at a column of the image in a row, in radii; of a pixel that the outline covers.
    #[must_use]
    pub fn distance_at(&self, row: u32, column: f64) -> f64 {
        let row = self.in_row(row);
        let u = column - self.column;
        let direction = row.direction + row.direction_step * u;
        direction.normalized().dot(self.center) - row.clearance_at(u).max(0.0).sqrt()
    }
}

/// Whether a sphere of radius 1 is wholly beyond one of the four planes through the eye and an edge of the window.
fn is_beside_the_window([x, y, z]: [f64; 3], window: &Screen) -> bool {
    let beyond = |along: f64, [low, high]: [f64; 2]| {
        let [low, high] = [low, high].map(|edge| edge / window.distance);
        let below = (low * z - along) / low.hypot(1.0);
        let above = (along - high * z) / high.hypot(1.0);
        below.max(above) > 1.0 + 1e-9
    };
    beyond(x, window.x) || beyond(y, window.y)
}

/// The grid of pixel centres on a screen at distance 1.
struct Pixels<'f> {
    frame: &'f CameraFrame<DoubleDouble>,
    window: Screen,
    per_distance: DoubleDouble,
    column_step: DoubleDouble,
    row_step: DoubleDouble,
}

impl<'f> Pixels<'f> {
    fn new(frame: &'f CameraFrame<DoubleDouble>, window: Screen) -> Self {
        let exact = DoubleDouble::from_f64;
        let per_distance = exact(1.0) / exact(window.distance);
        let step =
            |first: f64, last: f64, count: u32| (exact(last) - exact(first)) * per_distance / exact(f64::from(count));
        let [left, right] = window.x;
        let [bottom, top] = window.y;
        Self {
            frame,
            window,
            per_distance,
            column_step: step(left, right, frame.resolution.width),
            row_step: step(top, bottom, frame.resolution.height),
        }
    }

    fn x(&self, column: f64) -> DoubleDouble {
        let [left, right] = self.window.x;
        between::<DoubleDouble>(left, right, column, self.frame.resolution.width) * self.per_distance
    }

    fn y(&self, row: f64) -> DoubleDouble {
        let [bottom, top] = self.window.y;
        between::<DoubleDouble>(top, bottom, row, self.frame.resolution.height) * self.per_distance
    }

    /// The column whose centre is nearest to x: a whole number.
    fn column(&self, x: DoubleDouble) -> f64 {
        ((x - self.x(0.0)) / self.column_step).rounded().round().clamp(-FARTHEST, FARTHEST)
    }

    /// The row whose centre is nearest to y: a whole number.
    fn row(&self, y: DoubleDouble) -> f64 {
        ((y - self.y(0.0)) / self.row_step).rounded().round().clamp(-FARTHEST, FARTHEST)
    }
}

/// Columns and rows are counted exactly up to here.
const FARTHEST: f64 = 1e15;
