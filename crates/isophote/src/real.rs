//! The number types for which the formulas are written once.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A real number: a double, a [pair of doubles](crate::double_double::DoubleDouble) with 32 digits, or a SIMD vector whose
/// lanes compute several pixels at once.
///
/// Branches are [`select`](Real::select) on masks, so that types that hold several numbers can implement it too. Addition,
/// subtraction, multiplication, division and the square root are correctly rounded.
pub trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// The result of a comparison.
    type Mask: Copy;

    /// Roughly the square of the type's precision: the fraction of a sum of squares that is negligible.
    const NEGLIGIBLE_SQUARE: f64;

    /// A constant of the same kind as `self`, whose value is not used: a SIMD vector carries the machine's instruction set
    /// in its type.
    #[must_use]
    fn splat_like(self, value: f64) -> Self;

    /// The square root of a nonnegative number.
    #[must_use]
    fn sqrt(self) -> Self;

    /// 1/√x of a positive normal number, with an error of two roundings.
    #[must_use]
    #[inline(always)]
    fn inverse_sqrt(self) -> Self {
        self.splat_like(1.0) / self.sqrt()
    }

    /// self · factor + addend, with a single rounding if the machine has an instruction for it, otherwise with two.
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

    /// The number, or zero if it is negative.
    #[must_use]
    #[inline(always)]
    fn max_zero(self) -> Self {
        self.max(self.splat_like(0.0))
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
