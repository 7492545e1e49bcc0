//! Single numbers: a double, or a pair of doubles with 32 digits.

use crate::double_double::DoubleDouble;
use crate::real::Real;

/// A single number: it can be compared, and converted from a double.
///
/// The transcendental functions come from one portable library: the same scene gives the same bytes on every machine.
pub trait Scalar: Real<Mask = bool> {
    /// A double, exactly.
    fn from_f64(value: f64) -> Self;

    /// A number with 32 digits, rounded to this type.
    fn from_precise(value: DoubleDouble) -> Self;

    /// The nearest double.
    fn rounded(self) -> f64;

    /// The same number with 32 digits.
    fn precise(self) -> DoubleDouble;

    /// Sine and cosine of an angle in radians, within ±100. The angle has 32 digits, because rounding it to a double would
    /// lose digits that still affect the sine of a large angle.
    fn sine_and_cosine_of(angle: DoubleDouble) -> (Self, Self);

    /// cosⁿ of an angle, from the squares of its cosine and its sine: the lobe (N·H)ⁿ of (3.3) to (3.6).
    ///
    /// Near the lobe's peak, the power of the cosine would amplify its rounding error by n; the sine is small there and
    /// stays accurate, so cosⁿ = exp(n/2 · ln(1 − sin²)).
    fn cosine_power(cos_squared: Self, sin_squared: Self, exponent: f64) -> Self;

    /// Zero.
    #[inline(always)]
    #[must_use]
    fn zero() -> Self {
        Self::from_f64(0.0)
    }
}

impl Scalar for f64 {
    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn from_precise(value: DoubleDouble) -> Self {
        value.rounded()
    }

    #[inline(always)]
    fn rounded(self) -> f64 {
        self
    }

    #[inline(always)]
    fn precise(self) -> DoubleDouble {
        DoubleDouble::from_f64(self)
    }

    fn sine_and_cosine_of(angle: DoubleDouble) -> (Self, Self) {
        let nearest = angle.rounded();
        let rest = (angle - DoubleDouble::from_f64(nearest)).rounded();
        let (sine, cosine) = (libm::sin(nearest), libm::cos(nearest));
        (cosine.mul_add(rest, sine), sine.mul_add(-rest, cosine))
    }

    fn cosine_power(cos_squared: Self, sin_squared: Self, exponent: f64) -> Self {
        if sin_squared < 0.5 {
            libm::exp(0.5 * exponent * libm::log1p(-sin_squared))
        } else {
            libm::pow(cos_squared, 0.5 * exponent)
        }
    }
}

impl Scalar for DoubleDouble {
    fn from_f64(value: f64) -> Self {
        Self::exactly(value)
    }

    fn from_precise(value: Self) -> Self {
        value
    }

    fn rounded(self) -> f64 {
        self.nearest()
    }

    fn precise(self) -> DoubleDouble {
        self
    }

    fn sine_and_cosine_of(angle: DoubleDouble) -> (Self, Self) {
        angle.sine_and_cosine()
    }

    fn cosine_power(cos_squared: Self, _: Self, exponent: f64) -> Self {
        cos_squared.sqrt().power(exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Compared with the 30-digit power e^x. The relative errors of the square, the logarithm and the product add up to
        /// 2.1ε; multiplied by |x| they become absolute errors of the exponent, and the exponential adds its own.
        #[test]
        fn the_lobe_keeps_its_digits_for_any_shininess(sin in 0.0..0.999_f64, exponent in 0.1..100_000.0_f64) {
            let sin_squared = DoubleDouble::product_of(sin, sin);
            let cos_squared = DoubleDouble::from_f64(1.0) - sin_squared;
            let exact = DoubleDouble::cosine_power(cos_squared, sin_squared, exponent).rounded();
            let double = f64::cosine_power(cos_squared.rounded(), sin_squared.rounded(), exponent);
            let allowed = f64::EPSILON * (1.0 + 2.5 * exact.ln().abs());
            prop_assert!(exact < 1e-300 || (double / exact - 1.0).abs() <= allowed, "{double} {exact}");
        }
    }
}
