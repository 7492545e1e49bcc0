//! The lobe (N·H)ⁿ in lanes.
//!
//! For an integer n of moderate size it is a chain of multiplications, which amplifies the rounding error of cos²θ_h by n/2.
//! For any other n it is exp(n/2 · ln cos²θ_h), by polynomials; where cos²θ_h is near 1, its logarithm is computed from
//! sin²θ_h, which keeps its digits there.

use crate::lanes::{Element, Lane, Precision};
use crate::reflectance::{BrightnessFormula, Lobe, weight_without_cosine};

/// How the lobe of a material is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Power {
    /// The formula has no lobe.
    None,
    /// For an even integer n.
    Even(EvenLobe),
    /// For an odd integer n.
    Odd(OddLobe),
    /// For any n.
    Any(AnyLobe),
    /// For any n, in a highlight without cosθ_i.
    WithoutCosine(LobeWithoutCosine),
}

impl Power {
    /// Chooses the method for the highlight of a formula and a precision.
    pub fn of(formula: &BrightnessFormula, precision: Precision) -> Self {
        match formula.sharpness() {
            Some(n) if formula.jumps_at_terminator() => {
                Self::WithoutCosine(LobeWithoutCosine(AnyLobe { half: 0.5 * n }))
            }
            shininess => Self::new(shininess, precision),
        }
    }

    /// Chooses the method for a shininess (`None` if the formula has no highlight) and a precision.
    fn new(shininess: Option<f64>, precision: Precision) -> Self {
        // Beyond these lengths, the chain's error would exceed that of the polynomials.
        let longest = match precision {
            Precision::Double => 512.0,
            Precision::Single => 24.0,
        };
        match shininess {
            None => Self::None,
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number up to 512")]
            Some(n) if n.fract() == 0.0 && n <= longest => {
                let half = n as u32 / 2;
                if n % 2.0 == 0.0 { Self::Even(EvenLobe { half }) } else { Self::Odd(OddLobe { half }) }
            }
            Some(n) => Self::Any(AnyLobe { half: 0.5 * n }),
        }
    }
}

/// No lobe.
#[derive(Clone, Copy, Debug)]
pub struct NoLobe;

/// (cos²)^half.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EvenLobe {
    half: u32,
}

/// (cos²)^half · cos.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OddLobe {
    half: u32,
}

/// exp(half · ln cos²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnyLobe {
    half: f64,
}

/// The lobe of a highlight without cosθ_i, (3.11) and (3.12). One method does for every n: a variant for each would be
/// compiled for every way in which points are found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LobeWithoutCosine(AnyLobe);

impl<V: Lane> Lobe<V> for LobeWithoutCosine {
    #[inline(always)]
    fn denominator(&self, cos_squared: V, sin_squared: V) -> V {
        self.0.denominator(cos_squared, sin_squared)
    }

    #[inline(always)]
    fn value(&self, cos_squared: V, sin_squared: V, inverse: V) -> V {
        self.0.value(cos_squared, sin_squared, inverse)
    }

    #[inline(always)]
    fn weight(&self, along_lit: V, distance: V) -> V {
        weight_without_cosine(along_lit, distance)
    }
}

impl<V: Lane> Lobe<V> for NoLobe {
    #[inline(always)]
    fn denominator(&self, cos_squared: V, _: V) -> V {
        cos_squared.splat_like(1.0)
    }

    #[inline(always)]
    fn value(&self, cos_squared: V, _: V, _: V) -> V {
        cos_squared.splat_like(0.0)
    }
}

impl<V: Lane> Lobe<V> for EvenLobe {
    #[inline(always)]
    fn value(&self, _: V, sin_squared: V, inverse: V) -> V {
        whole_power(cos_share(sin_squared, inverse), self.half)
    }
}

impl<V: Lane> Lobe<V> for OddLobe {
    #[inline(always)]
    fn value(&self, _: V, sin_squared: V, inverse: V) -> V {
        let share = cos_share(sin_squared, inverse).max_zero();
        whole_power(share, self.half) * share.sqrt()
    }
}

/// cos²θ_h as 1 − sin²θ_h: near the peak, where the power would amplify it, only the error of one rounding remains.
#[inline(always)]
fn cos_share<V: Lane>(sin_squared: V, inverse: V) -> V {
    (-sin_squared).mul_add(inverse, inverse.splat_like(1.0))
}

/// By repeated squaring, from the lowest digit of the exponent.
#[inline(always)]
fn whole_power<V: Lane>(base: V, exponent: u32) -> V {
    let mut square = base;
    let mut rest = exponent;
    while rest & 1 == 0 && rest > 0 {
        square = square * square;
        rest >>= 1;
    }
    if rest == 0 {
        return base.splat_like(1.0);
    }
    let mut result = square;
    rest >>= 1;
    while rest > 0 {
        square = square * square;
        if rest & 1 == 1 {
            result = result * square;
        }
        rest >>= 1;
    }
    result
}

/// The fraction cos² / (cos² + sin²), as m·2ᵏ with m between √½ and √2.
struct Split<V> {
    /// (m − 1) times the sum of the squares.
    difference: V,
    /// Twice the sum of the squares.
    sum: V,
    /// k.
    exponent: V,
}

impl AnyLobe {
    #[inline(always)]
    fn split<V: Lane>(cos_squared: V, sin_squared: V) -> Split<V> {
        let sum = cos_squared + sin_squared;
        // Zero has no exponent, and for anything smaller than this the lobe is zero.
        let cos_squared = cos_squared.max(sum * sum.splat_like(1e-30));
        // With the factor √2, fractions from √½ up have an exponent of 0 or more: exactly 0, since fractions do not
        // exceed 1.
        let scaled = cos_squared * sum.splat_like(std::f64::consts::SQRT_2);
        let exponent = scaled.exponent() - sum.exponent();
        let one_less = exponent - sum.splat_like(1.0);
        let exponent = V::select(scaled.mantissa().is_less(sum.mantissa()), one_less, exponent);
        let is_far = exponent.is_less(sum.splat_like(0.0));
        // Near the peak, cos² − sum is −sin², with all its digits.
        let difference = V::select(is_far, cos_squared * (-exponent).power_of_two() - sum, -sin_squared);
        Split { difference, sum: sum + sum, exponent }
    }
}

impl<V: Lane> Lobe<V> for AnyLobe {
    /// The divisor in the logarithm: see [`value`](Self::value).
    #[inline(always)]
    fn denominator(&self, cos_squared: V, sin_squared: V) -> V {
        let split = Self::split(cos_squared, sin_squared);
        split.sum + split.difference
    }

    #[inline(always)]
    fn value(&self, cos_squared: V, sin_squared: V, inverse: V) -> V {
        // ln m = 2 artanh s with s = (m − 1)/(m + 1), where m is the fraction of cos², scaled by a power of two.
        let split = Self::split(cos_squared, sin_squared);
        let s = split.difference * inverse;
        let logarithm = split.exponent.mul_add(s.splat_like(std::f64::consts::LN_2), twice_artanh(s));
        exp(logarithm * s.splat_like(self.half))
    }
}

/// 2 artanh s = 2s (1 + s²/3 + s⁴/5 + …) for |s| ≤ (√2 − 1)/(√2 + 1) = 0.172.
#[inline(always)]
fn twice_artanh<V: Lane>(s: V) -> V {
    let square = s * s;
    let terms = match V::Element::PRECISION {
        Precision::Double => 10,
        Precision::Single => 4,
    };
    let mut series = s.splat_like(1.0 / f64::from(2 * terms + 1));
    for k in (0..terms).rev() {
        series = series.mul_add(square, s.splat_like(1.0 / f64::from(2 * k + 1)));
    }
    (s + s) * series
}

/// eˣ for x ≤ 0, down to the smallest number of the type; 0 below that.
#[inline(always)]
fn exp<V: Lane>(x: V) -> V {
    let (least, terms) = match V::Element::PRECISION {
        Precision::Double => (-700.0, 13),
        Precision::Single => (-86.0, 6),
    };
    let x_bounded = x.max(x.splat_like(least));
    // To the nearest integer: adding and subtracting 1.5·2^p drops the fraction.
    let magic = x.splat_like(match V::Element::PRECISION {
        Precision::Double => 6_755_399_441_055_744.0,
        Precision::Single => 12_582_912.0,
    });
    let exponent = x_bounded.mul_add(x.splat_like(std::f64::consts::LOG2_E), magic) - magic;
    // ln 2 in two parts; the first has so few digits that its product with the exponent is exact.
    let [high, low] = match V::Element::PRECISION {
        Precision::Double => [0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10],
        Precision::Single => [0.693_145_751_953_125, 1.428_606_820_309_417_2e-6],
    };
    let rest = (-exponent).mul_add(x.splat_like(high), x_bounded);
    let rest = (-exponent).mul_add(x.splat_like(low), rest);
    // eʳ by its power series, |r| ≤ ln 2 / 2.
    let mut series = x.splat_like(inverse_factorial(terms));
    for k in (0..terms).rev() {
        series = series.mul_add(rest, x.splat_like(inverse_factorial(k)));
    }
    let result = series * exponent.power_of_two();
    V::select(x.is_less(x.splat_like(least)), x.splat_like(0.0), result)
}

#[inline(always)]
fn inverse_factorial(k: u32) -> f64 {
    let mut factorial = 1.0;
    for factor in 1..=k {
        factorial *= f64::from(factor);
    }
    1.0 / factorial
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::double_double::DoubleDouble;
    use crate::lanes::{Instructions, LaneJob};
    use crate::scalar::Scalar;

    /// The lobe at some angles, given by sin²θ_h.
    struct LobeAt<'a> {
        power: Power,
        sin_squared: &'a [f64],
    }

    impl LobeAt<'_> {
        #[inline(always)]
        fn value<V: Lane>(&self, token: V::Token, sin_squared: f64) -> f64 {
            let splat = |value| V::splat(token, V::Element::from_f64(value));
            let (cos, sin) = (splat(1.0 - sin_squared), splat(sin_squared));
            let one = splat(1.0);
            let lobe = match self.power {
                Power::None => NoLobe.value(cos, sin, one),
                Power::Even(lobe) => lobe.value(cos, sin, one / lobe.denominator(cos, sin)),
                Power::Odd(lobe) => lobe.value(cos, sin, one / lobe.denominator(cos, sin)),
                Power::Any(lobe) => lobe.value(cos, sin, one / lobe.denominator(cos, sin)),
                Power::WithoutCosine(lobe) => lobe.value(cos, sin, one / lobe.denominator(cos, sin)),
            };
            let mut values = [V::Element::default(); 32];
            lobe.store(&mut values);
            values[0].to_f64()
        }
    }

    impl LaneJob for LobeAt<'_> {
        type Output = [Vec<f64>; 2];

        #[inline(always)]
        fn run<S, D>(self, token: S::Token) -> Self::Output
        where
            S: Lane<Element = f32>,
            D: Lane<Element = f64, Token = S::Token>,
        {
            let mut values = [Vec::new(), Vec::new()];
            for sin_squared in self.sin_squared {
                values[0].push(self.value::<S>(token, *sin_squared));
                values[1].push(self.value::<D>(token, *sin_squared));
            }
            values
        }
    }

    fn exact(sin_squared: f64, shininess: f64) -> f64 {
        let sin_squared = DoubleDouble::from_f64(sin_squared);
        DoubleDouble::cosine_power(DoubleDouble::from_f64(1.0) - sin_squared, sin_squared, shininess).rounded()
    }

    /// The stated relative error: four roundings, plus those that the exponent −n/2 ln cos² amplifies; for integer n, which
    /// only multiplies, n/2 roundings.
    #[test]
    fn the_lobe_has_its_stated_error_for_any_shininess() {
        // Numbers that single precision represents exactly.
        let sin_squared: Vec<f64> =
            (0..1000).map(|k| f64::from(k) / 1024.0).chain([2e-6, 1e-9].map(|x| f32::from_f64(x).to_f64())).collect();
        for instructions in Instructions::all() {
            for shininess in [0.1, 1.0, 2.0, 7.0, 20.0, 20.5, 32.0, 511.0, 900.0, 12_345.6] {
                let [single, double] = [Precision::Single, Precision::Double].map(|precision| {
                    let job = LobeAt { power: Power::new(Some(shininess), precision), sin_squared: &sin_squared };
                    let [single, double] = instructions.run(job);
                    if precision == Precision::Single { single } else { double }
                });
                for ((sin_squared, single), double) in sin_squared.iter().zip(single).zip(double) {
                    let exact = exact(*sin_squared, shininess);
                    let exponent = -0.5 * shininess * libm::log1p(-sin_squared);
                    let roundings = 4.0 + 4.0 * exponent.max(0.5 * shininess.min(512.0));
                    let allowed = |epsilon: f64, least: f64| roundings * epsilon * exact + least;
                    let case = format!("{}: n = {shininess}, sin² = {sin_squared}", instructions.name());
                    assert!((double - exact).abs() <= allowed(1.1e-16, 1e-290), "{case}: {double:e} {exact:e}");
                    assert!((single - exact).abs() <= allowed(6e-8, 1e-36), "{case}: {single:e} {exact:e}");
                }
            }
        }
    }
}
