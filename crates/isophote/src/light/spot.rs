//! The spot light.

use super::Cone;
use crate::vector::Vector;

/// The emission pattern of a spot light (3.7): I₀ within the inner cone, 0 outside the outer one, and a smooth step in
/// between.
///
/// ```text
/// I = I₀ x²(3 − 2x),   x = (cosγ − cosβ)/(cosα − cosβ), at least 0 and at most 1
/// ```
///
/// γ is the angle from the axis, α and β are the half angles of the cones. Power: π I₀ (2 − cosα − cosβ).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// The cone in the form that the formula evaluates.
    pub cone: Cone,
}

impl Spot {
    /// The smallest allowed difference of the half angles, in radians: half a degree. A sharper edge would amplify the
    /// rounding errors of directions beyond what [`DOUBLE`](crate::tolerance::DOUBLE) allows.
    pub const SHARPEST: f64 = std::f64::consts::PI / 360.0;

    /// A cone around a unit vector, by its two half angles in radians, 0 ≤ inner < outer ≤ π/2.
    #[must_use]
    pub fn new(axis: Vector, inner: f64, outer: f64) -> Self {
        let [inner, outer] = [inner, outer].map(|angle| 4.0 * libm::pow(libm::sin(0.5 * angle), 2.0));
        Self { cone: Cone { axis, outer, steepness: 1.0 / (outer - inner) } }
    }

    /// α, in radians.
    #[must_use]
    pub fn inner_angle(&self) -> f64 {
        2.0 * libm::asin(0.5 * (self.cone.outer - 1.0 / self.cone.steepness).max(0.0).sqrt())
    }

    /// β, in radians.
    #[must_use]
    pub fn outer_angle(&self) -> f64 {
        self.cone.outer_angle()
    }

    /// Power over the intensity on the axis, in sr.
    #[must_use]
    pub fn solid_angle(&self) -> f64 {
        std::f64::consts::PI * (self.cone.outer - 0.5 / self.cone.steepness)
    }

    /// See [`Cone::steepest`].
    #[must_use]
    pub fn steepest(&self) -> f64 {
        self.cone.steepest()
    }

    /// The relative growth of I with γ, per radian, in a direction (a unit vector) from the light; infinite where there is
    /// no light.
    #[must_use]
    pub fn relative_growth(&self, direction: Vector) -> f64 {
        let x = self.cone.place_in_step(-direction, 1.0);
        if x >= 1.0 {
            return 0.0;
        }
        let sine = self.cone.axis.cross(direction).length();
        6.0 * (1.0 - x) / (x * (3.0 - 2.0 * x)) * 2.0 * self.cone.steepness * sine
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spot_has_its_full_intensity_inside_half_in_the_middle_and_none_outside() {
        let axis = Vector::new(0.0, 0.0, 1.0);
        let [inner, outer] = [20.0_f64, 30.0].map(f64::to_radians);
        let spot = Spot::new(axis, inner, outer);
        assert!((spot.inner_angle() - inner).abs() < 1e-15 && (spot.outer_angle() - outer).abs() < 1e-15);
        let share = |angle: f64| spot.cone.share(Vector::new(-2.0 * angle.sin(), 0.0, -2.0 * angle.cos()), 0.5);
        assert_eq!([0.0, 0.3, inner - 1e-12].map(share), [1.0; 3]);
        assert_eq!([outer + 1e-12, 1.0, 3.1].map(share), [0.0; 3]);
        let middle = f64::midpoint(inner.cos(), outer.cos()).acos();
        assert!((share(middle) - 0.5).abs() < 1e-14);
        let quarter = (outer.cos() + 0.25 * (inner.cos() - outer.cos())).acos();
        assert!((share(quarter) - 0.156_25).abs() < 1e-14, "x²(3 − 2x) at x = 1/4");
    }

    /// The growth from its definition, as a difference quotient.
    #[test]
    fn the_growth_of_a_spots_intensity_is_its_derivative() {
        let spot = Spot::new(Vector::new(0.0, 1.0, 0.0), 0.2, 0.5);
        let towards = |angle: f64| Vector::new(angle.sin(), angle.cos(), 0.0);
        let mut steepest = 0.0_f64;
        for step in 1..100 {
            let angle = 0.2 + 0.003 * f64::from(step);
            let share = |angle: f64| spot.cone.share(-towards(angle), 1.0);
            let growth = (share(angle - 1e-6) - share(angle + 1e-6)) / 2e-6;
            steepest = steepest.max(growth);
            let relative = growth / share(angle);
            assert!((spot.relative_growth(towards(angle)) / relative - 1.0).abs() < 1e-6, "{angle}");
        }
        // It is a bound: the slope is steepest in the middle, while sinγ is largest at the outer edge.
        assert!((0.7..=1.0).contains(&(steepest / spot.steepest())), "{steepest}");
        assert_eq!(spot.relative_growth(towards(0.1)), 0.0);
    }
}
