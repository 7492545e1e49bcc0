//! How rays intersect shapes.

use std::ops::Range;

use crate::scalar::Scalar;
use crate::tolerance;
use crate::vector::Vector;

/// The intersection of a ray with a shape.
#[derive(Clone, Copy, Debug)]
pub struct Intersection<T = f64> {
    /// The nearest intersection with t > 0.
    pub hit: Option<ShapeHit<T>>,
    /// The distance (in metres) beyond which double precision may have decided wrongly, or lost more digits than the
    /// accuracy allows: the ray comes near a silhouette, an edge or the surface that it starts on.
    pub doubtful_from: Option<T>,
}

/// A hit of a ray on a shape.
#[derive(Clone, Copy, Debug)]
pub struct ShapeHit<T = f64> {
    /// t, the distance from the start of the ray in metres.
    pub distance: T,
    /// The point that was hit.
    pub point: SurfacePoint<T>,
    /// Whether the ray comes from inside a closed shape.
    pub from_inside: bool,
    /// From the point to where its shadow rays start, in metres: nonzero only on meshes with smooth normals.
    pub shadow_ray_offset: Vector<T>,
}

/// A point on a surface, with what its shading needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint<T = f64> {
    /// A place near the point (the centre of a sphere), in metres. The point is kept as `anchor + offset`, because
    /// far from the origin the sum would lose the digits that the offset still has.
    pub anchor: Vector,
    /// From the anchor to the point, in metres.
    pub offset: Vector<T>,
    /// N, the unit normal on the viewer's side.
    pub normal: Vector<T>,
    /// V, the unit vector to the eye.
    pub view: Vector<T>,
    /// cosθ_o = N·V.
    pub cos_theta_o: T,
}

impl<T: Scalar> SurfacePoint<T> {
    /// P, in metres.
    #[must_use]
    pub fn position(&self) -> Vector<T> {
        Vector::from_f64(self.anchor) + self.offset
    }

    /// The same point in another number type.
    #[must_use]
    pub fn map<U: Scalar>(&self, convert: impl Fn(T) -> U) -> SurfacePoint<U> {
        SurfacePoint {
            anchor: self.anchor,
            offset: self.offset.map(&convert),
            normal: self.normal.map(&convert),
            view: self.view.map(&convert),
            cos_theta_o: convert(self.cos_theta_o),
        }
    }
}

impl<T> Intersection<T> {
    /// The ray certainly misses.
    pub const MISS: Self = Self { hit: None, doubtful_from: None };
}

/// How accurate a hit must be for its use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// How much shading amplifies an error of the normal: see [`for_shading`](Self::for_shading). Zero if only hit or miss
    /// matters.
    magnification: f64,
    /// How much it amplifies an error of the position, in sizes of the shape: 3 for 1/r² and cosθ_i of a light that is as
    /// far away as the shape is large, plus the effect of a highlight.
    of_place: f64,
}

impl Accuracy {
    /// Only hit or miss matters, as for shadows.
    pub const OF_VISIBILITY: Self = Self { magnification: 0.0, of_place: 0.0 };

    /// A hit that is shaded with a lobe of this shininess, if any, where the edges of spots are no
    /// [steeper](crate::light::Light::steepest_edge) than this.
    ///
    /// The error of the normal is amplified at a terminator, by 1/cosθ_i, by the edge of a spot, and by a highlight: the
    /// factor is n tanθ_h, largest where the highlight has fallen to a millionth of its peak, tan²θ_h = 10^(12/n) − 1, or
    /// where θ_h is as large as the cosines of the promise allow. Some four roundings go into θ_h.
    #[must_use]
    pub fn for_shading(shininess: Option<f64>, steepest_edge: f64) -> Self {
        let terminator = 1.0 / tolerance::DOUBLE.peak_cosine;
        let highlight = shininess.map_or(0.0, |n| {
            let faintest = (libm::pow(10.0, 12.0 / n) - 1.0).sqrt();
            4.0 * n * faintest.min(1.0 / tolerance::DOUBLE.above_cosine)
        });
        Self {
            magnification: terminator.max(highlight).max(steepest_edge),
            of_place: highlight.max(steepest_edge).max(4.0),
        }
    }

    /// Whether a hit is traced again with 32 digits, given these errors of its position (in sizes of the shape) and of its
    /// normal: for shapes whose normal does not follow from the position, or not closely.
    #[must_use]
    #[inline(always)]
    pub fn is_exceeded_by(self, place: f64, normal: f64) -> bool {
        let allowed = 0.5 * tolerance::DOUBLE.of_peak;
        // Written so that NaN counts as exceeding.
        self.magnification > 0.0 && !(place * self.of_place <= allowed && normal * self.magnification <= allowed)
    }

    /// The clearances cos²θ_o at which a ray is traced again with 32 digits: from around zero, where hit and miss are
    /// decided, up to where the error is within half of what [`tolerance::DOUBLE`] allows; the other half is for shading.
    ///
    /// cosθ_o is the root of the clearance, so its error is the clearance's error over 2 cosθ_o. If the error of the normal
    /// alone is too large, every hit is traced again.
    #[must_use]
    #[inline(always)]
    pub fn doubtful_clearance(self, error: &TracingError) -> Range<f64> {
        let allowed = 0.5 * tolerance::DOUBLE.of_peak;
        let least = -2.0 * error.clearance;
        if self.magnification == 0.0 {
            return least..-least;
        }
        let least_cosine = 0.5 * error.clearance / allowed;
        let is_too_much = error.normal * self.magnification > allowed;
        least..if is_too_much { f64::INFINITY } else { least_cosine * least_cosine }
    }
}

/// The rounding errors of the clearance cos²θ_o and of the normal.
#[derive(Clone, Copy, Debug)]
pub struct TracingError {
    /// The error of the clearance.
    pub clearance: f64,
    /// The error of the normal.
    pub normal: f64,
}

impl TracingError {
    /// For a pixel in an [outline](crate::outline::Outline), whose error does not grow with distance.
    pub const IN_OUTLINE: Self = Self { clearance: 32.0 * f64::EPSILON, normal: 2.0 * f64::EPSILON };

    /// For a ray that is traced in double precision and starts `relative_distance` sizes away from the shape: in units of ε
    /// (1 + ρ). Most of it is the ray's own rounding error; the figures are above what `tests/conformance.rs` finds in a
    /// hundred thousand random scenes.
    #[must_use]
    #[inline(always)]
    pub fn of_ray(relative_distance: f64) -> Self {
        let error = f64::EPSILON * (1.0 + relative_distance);
        Self { clearance: 16.0 * error, normal: 1.25 * error }
    }
}
