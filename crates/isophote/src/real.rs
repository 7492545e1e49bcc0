//! The number types over which the formulas are written once.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::double_double::DoubleDouble;

/// A real number: a double, a [pair of doubles](crate::double_double::DoubleDouble) of 32 digits, or a vector of lanes
/// that compute several pixels at once.
///
/// Branches are [`select`](Real::select) on masks, so that a type that holds several numbers can be one too.
/// Addition, subtraction, multiplication, division and the square root are correctly rounded.
pub trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// The answer of a comparison.
    type Mask: Copy;

    /// About the square of the type's precision: a part of a sum of squares that is lost beside the whole.
    const NEGLIGIBLE_SQUARE: f64;

    /// A constant, of the same kind as `self`, whose value is not used: a vector of lanes knows by its kind which
    /// instructions the machine has.
    #[must_use]
    fn splat_like(self, value: f64) -> Self;

    /// The square root of a number that is not negative.
    #[must_use]
    fn sqrt(self) -> Self;

    /// self · factor + addend, with one rounding where the machine has it in one instruction, else with two.
    #[must_use]
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }

    /// Whether `self < other`.
    fn is_less(self, other: Self) -> Self::Mask;

    /// `yes` where the mask is set, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// The larger of two numbers.
    #[must_use]
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::select(self.is_less(other), other, self)
    }

    /// The number, or zero where it is negative.
    #[must_use]
    #[inline(always)]
    fn max_zero(self) -> Self {
        self.max(self.splat_like(0.0))
    }
}

/// A single number: it can be asked whether it is smaller, and comes from a double.
///
/// The transcendental functions come from one portable library: the same scene gives the same bytes on every machine.
pub trait Scalar: Real<Mask = bool> {
    /// A double, exactly.
    fn from_f64(value: f64) -> Self;

    /// A number of 32 digits, to the digits of this type.
    fn from_precise(value: DoubleDouble) -> Self;

    /// The nearest double.
    fn rounded(self) -> f64;

    /// The same number with 32 digits.
    fn precise(self) -> DoubleDouble;

    /// Sine and cosine of an angle in radians, within ±100. The angle comes with 32 digits, because a double of it would have
    /// lost what the sine of a large angle still shows.
    fn sine_and_cosine_of(angle: DoubleDouble) -> (Self, Self);

    /// cosⁿ of an angle, from the squares of its cosine and its sine: the lobe (N·H)ⁿ of (3.3) to (3.6).
    ///
    /// Near the lobe's peak the power of the cosine would multiply its rounding error by n; the sine is small there
    /// and carries the digits, so cosⁿ = exp(n/2 · ln(1 − sin²)).
    fn cosine_power(cos_squared: Self, sin_squared: Self, exponent: f64) -> Self;

    /// Zero.
    #[inline(always)]
    #[must_use]
    fn zero() -> Self {
        Self::from_f64(0.0)
    }
}

impl Real for f64 {
    type Mask = bool;
    const NEGLIGIBLE_SQUARE: f64 = 1e-32;

    #[inline(always)]
    fn splat_like(self, value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn is_less(self, other: Self) -> bool {
        self < other
    }

    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
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

/// A sum that keeps the digits which plain addition would lose (Neumaier's form of Kahan's sum, with Knuth's
/// branch-free exact addition). The error of n terms of one sign is that of a single rounding, whatever n is.
#[derive(Clone, Copy)]
pub struct Sum<T> {
    total: T,
    lost: T,
}

impl<T: Scalar> Sum<T> {
    /// Nothing summed yet.
    #[must_use]
    #[inline(always)]
    pub fn new() -> Self {
        Self::starting_at(T::zero())
    }
}

impl<T: Real> Sum<T> {
    /// Nothing summed yet, from a zero of the right kind.
    #[must_use]
    #[inline(always)]
    pub fn starting_at(zero: T) -> Self {
        Self { total: zero, lost: zero }
    }

    /// Adds a term.
    #[inline(always)]
    pub fn add(&mut self, term: T) {
        let total = self.total + term;
        let kept = total - self.total;
        self.lost = self.lost + ((self.total - (total - kept)) + (term - kept));
        self.total = total;
    }

    /// The sum of all terms.
    #[must_use]
    #[inline(always)]
    pub fn value(self) -> T {
        self.total + self.lost
    }
}

impl<T: Scalar> Default for Sum<T> {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_compensated_sum_keeps_what_plain_addition_loses() {
        let mut sum = Sum::new();
        let mut plain = 0.0;
        for term in std::iter::once(1.0).chain(std::iter::repeat_n(1e-17, 1_000_000)) {
            sum.add(term);
            plain += term;
        }
        assert_eq!(plain, 1.0, "else this test shows nothing");
        assert_eq!(sum.value(), 1.0 + 1e-11);
    }

    proptest! {
        /// Against the 30-digit power e^x. The relative errors of the square, the logarithm and the product come to 2.1ε
        /// together; |x| makes them absolute ones of the exponent, and the exponential adds its own.
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
