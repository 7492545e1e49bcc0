//! Numbers of 32 digits: the unevaluated sum of two doubles.
//!
//! They trace the few rays for which a double is not enough, and they are the yardstick by which the tests measure
//! the error of everything else. (Ours, because the crate at hand, twofloat 0.8.4, gave (1/3)·3 − 1 = −5.6e-17 and
//! exp(ln x) to 11 digits.) Algorithms: Dekker 1971; Knuth, TAOCP 4.2.2; Joldeș, Muller and Popescu, "Tight and
//! rigorous error bounds for basic building blocks of double-word arithmetic", ACM TOMS 44(2), 2017.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::lanes::Lane;
use crate::real::{Real, Scalar};

/// A number of about 106 bits: `high + low`, with |low| at most half a unit in the last place of `high`. Or a vector of
/// such numbers, in two vectors of doubles.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct DoubleDouble<T = f64> {
    high: T,
    low: T,
}

/// A number type whose products can be had exactly, as two numbers.
pub trait ExactProduct: Real {
    /// self · factor − product, exactly, when `product` is the rounded self · factor.
    #[must_use]
    fn product_rest(self, factor: Self, product: Self) -> Self;
}

impl ExactProduct for f64 {
    #[inline(always)]
    fn product_rest(self, factor: Self, product: Self) -> Self {
        self.mul_add(factor, -product)
    }
}

impl<V: Lane<Element = f64>> ExactProduct for V {
    #[inline(always)]
    fn product_rest(self, factor: Self, product: Self) -> Self {
        Lane::product_rest(self, factor, product)
    }
}

impl<T: ExactProduct> DoubleDouble<T> {
    /// A number of half the digits, exactly.
    #[must_use]
    #[inline(always)]
    pub fn exactly(high: T) -> Self {
        Self { high, low: high.constant(0.0) }
    }

    /// The same number in another type: `convert` must be exact.
    #[must_use]
    #[inline(always)]
    pub fn map<U>(self, convert: impl Fn(T) -> U) -> DoubleDouble<U> {
        DoubleDouble { high: convert(self.high), low: convert(self.low) }
    }

    /// The nearest number of half the digits.
    #[must_use]
    #[inline(always)]
    pub fn nearest(self) -> T {
        self.high
    }

    /// a + b, exactly.
    #[must_use]
    #[inline(always)]
    pub fn sum_of(a: T, b: T) -> Self {
        let high = a + b;
        let b_kept = high - a;
        Self { high, low: (a - (high - b_kept)) + (b - b_kept) }
    }

    /// a · b, exactly (but for underflow).
    #[must_use]
    #[inline(always)]
    pub fn product_of(a: T, b: T) -> Self {
        let high = a * b;
        Self { high, low: a.product_rest(b, high) }
    }

    /// high + low, when |high| ≥ |low|.
    #[inline(always)]
    fn normalized(high: T, low: T) -> Self {
        let sum = high + low;
        Self { high: sum, low: low - (sum - high) }
    }
}

impl DoubleDouble {
    /// eˣ, to about 30 digits, for x in −700…700.
    #[must_use]
    pub fn exp(self) -> Self {
        if self.high < 0.0 {
            return Self::from_f64(1.0) / (-self).exp();
        }
        // eˣ = (e^(x/1024))^1024: of the small argument a short series has all the digits. It is kept as e^y − 1,
        // whose squaring rule (1 + z)² − 1 = 2z + z² loses none of them.
        let halvings = 10;
        let scale = 0.5_f64.powi(halvings);
        let small = Self { high: self.high * scale, low: self.low * scale };
        let one = Self::from_f64(1.0);
        let mut term = one;
        let mut minus_one = Self::zero();
        for n in 1..=20 {
            term = term * small / Self::from_f64(f64::from(n));
            minus_one = minus_one + term;
        }
        for _ in 0..halvings {
            minus_one = minus_one + minus_one + minus_one * minus_one;
        }
        minus_one + one
    }

    /// ln x for x > 0, to about 30 digits: Newton's step on the double's logarithm, twice.
    #[must_use]
    pub fn ln(self) -> Self {
        let one = Self::from_f64(1.0);
        let mut logarithm = Self::from_f64(libm::log(self.high));
        for _ in 0..2 {
            logarithm = logarithm + self * (-logarithm).exp() - one;
        }
        logarithm
    }

    /// A power with an exponent above 0 of a base in 0…1: the whole part of the exponent by squaring, the rest by
    /// the logarithm.
    #[must_use]
    pub fn power(self, exponent: f64) -> Self {
        let mut result = Self::from_f64(1.0);
        let mut square = self;
        let mut whole = exponent.trunc();
        while whole >= 1.0 {
            if whole % 2.0 >= 1.0 {
                result = result * square;
            }
            square = square * square;
            whole = (whole / 2.0).trunc();
        }
        let fraction = exponent.fract();
        if fraction == 0.0 {
            result
        } else if self.high > 0.0 {
            result * (self.ln() * Self::from_f64(fraction)).exp()
        } else {
            Self::zero()
        }
    }
}

impl<T: ExactProduct> Real for DoubleDouble<T> {
    type Mask = T::Mask;
    const NEGLIGIBLE_SQUARE: f64 = 1e-64;

    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::exactly(self.high.constant(value))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        let zero = self.high.constant(0.0);
        let root = self.high.max(zero).sqrt();
        let rest = self - Self::product_of(root, root);
        let is_positive = zero.is_less(root);
        let low = rest.high / (root + T::select(is_positive, root, root.constant(1.0)));
        Self::normalized(root, T::select(is_positive, low, zero))
    }

    #[inline(always)]
    fn is_less(self, other: Self) -> T::Mask {
        // The difference of two such numbers is never rounded to the other sign.
        let difference = self - other;
        difference.high.is_less(difference.high.constant(0.0))
    }

    #[inline(always)]
    fn select(mask: T::Mask, yes: Self, no: Self) -> Self {
        Self { high: T::select(mask, yes.high, no.high), low: T::select(mask, yes.low, no.low) }
    }
}

impl Scalar for DoubleDouble {
    fn from_f64(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    fn from_precise(value: Self) -> Self {
        value
    }

    fn rounded(self) -> f64 {
        self.high
    }

    fn cosine_power(cos_squared: Self, _: Self, exponent: f64) -> Self {
        cos_squared.sqrt().power(exponent)
    }
}

impl<T: ExactProduct> Add for DoubleDouble<T> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let high = Self::sum_of(self.high, other.high);
        let low = Self::sum_of(self.low, other.low);
        let carried = Self::normalized(high.high, high.low + low.high);
        Self::normalized(carried.high, carried.low + low.low)
    }
}

impl<T: ExactProduct> Sub for DoubleDouble<T> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<T: ExactProduct> Neg for DoubleDouble<T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl<T: ExactProduct> Mul for DoubleDouble<T> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let product = Self::product_of(self.high, other.high);
        let across = self.high * other.low + self.low * other.high;
        Self::normalized(product.high, product.low + across)
    }
}

impl<T: ExactProduct> Div for DoubleDouble<T> {
    type Output = Self;

    /// Long division, three digits of 53 bits.
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::exactly(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::exactly(second);
        let third = rest.high / other.high;
        Self::sum_of(first, second) + Self::exactly(third)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn number(high: f64, low: f64) -> DoubleDouble {
        DoubleDouble::sum_of(high, low * high * 1e-17)
    }

    fn assert_same(first: DoubleDouble, second: DoubleDouble, tolerance: f64) {
        let error = ((first - second) / second).rounded().abs();
        assert!(error <= tolerance, "{first:?} {second:?}: {error:e}");
    }

    #[test]
    fn known_numbers_have_their_second_double() {
        // The nearest doubles to √2, ln 2 and e, and what they leave over (50-digit values).
        assert_same(
            DoubleDouble::from_f64(2.0).sqrt(),
            DoubleDouble { high: std::f64::consts::SQRT_2, low: -9.667_293_313_452_913e-17 },
            1e-31,
        );
        assert_same(
            DoubleDouble::from_f64(2.0).ln(),
            DoubleDouble { high: std::f64::consts::LN_2, low: 2.319_046_813_846_299_6e-17 },
            1e-30,
        );
        assert_same(
            DoubleDouble::from_f64(1.0).exp(),
            DoubleDouble { high: std::f64::consts::E, low: 1.445_646_891_729_250_2e-16 },
            1e-30,
        );
    }

    proptest! {
        #[test]
        fn arithmetic_keeps_thirty_digits(a in 0.001..1000.0_f64, b in 0.001..1000.0_f64, low in -1.0..1.0_f64) {
            let (x, y) = (number(a, low), number(b, -low));
            assert_same(x / y * y, x, 1e-30);
            assert_same((x + y) * (x + y), x * x + x * y + x * y + y * y, 1e-30);
            assert_same(x.sqrt() * x.sqrt(), x, 1e-30);
            prop_assert!((x + y - y - x).rounded().abs() < 1e-29 * a.max(b));
        }

        #[test]
        fn exponential_and_logarithm_keep_their_digits(a in -50.0..50.0_f64, b in -50.0..50.0_f64) {
            let (x, y) = (DoubleDouble::from_f64(a), DoubleDouble::from_f64(b));
            assert_same(x.exp() * y.exp(), (x + y).exp(), 1e-28);
            assert_same(x.exp().ln().exp(), x.exp(), 1e-28);
        }

        #[test]
        fn powers_multiply(base in 0.1..1.0_f64, first in 0.1..40.0_f64, second in 0.1..40.0_f64) {
            let base = DoubleDouble::from_f64(base);
            let sum = DoubleDouble::sum_of(first, second);
            let joint = base.power(sum.high) * (base.ln() * DoubleDouble::from_f64(sum.low)).exp();
            assert_same(base.power(first) * base.power(second), joint, 1e-27);
        }
    }
}
