//! The lobe (N·H)ⁿ in lanes.
//!
//! The kernel writes down for every emitter what its lobe is multiplied by, and sin²θ_h; the sum of the lobes follows from
//! these [terms](Terms) in a second loop, which is short and without branches for whatever n a material has. For an integer n
//! of moderate size (cos²θ_h)^(n/2) is a chain of multiplications, which amplifies the rounding error of cos²θ_h by n/2. For
//! any other n it is 2 to the power n/2 · log₂ cos²θ_h, by polynomials.

use super::emitters::SHININESS_IN_SINGLE;
use crate::lanes::{Element, Lane, Precision, SimdToken};
use crate::reflectance::{BrightnessFormula, Lobe, weight_without_cosine};

/// How the lobe of a material is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Power {
    /// The formula has no lobe.
    None,
    /// For an integer n.
    Whole(WholePower),
    /// For any n.
    Any(AnyPower),
    /// For any n, in a highlight without cosθ_i.
    WithoutCosine(AnyPower),
}

/// (cos²)^half, times cos if n is odd.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WholePower {
    half: u32,
    is_odd: bool,
}

/// 2 to the power half · log₂ cos².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnyPower {
    half: f64,
}

/// What emitters contribute to the sums of the lobes at vectors of points: for each in turn a vector of what its lobe is
/// multiplied by ([`LightTerm::lobe_irradiance`](crate::shade::LightTerm::lobe_irradiance)), and one of sin²θ_h.
#[derive(Default)]
pub struct Terms<E>(Vec<E>);

/// Where the next terms go.
pub struct Room<'t, E>(&'t mut [E]);

/// Leaves a lobe to [`Power::sum`]: its value is sin²θ_h.
pub trait LobeOfKernel<V: Lane>: Lobe<V> {
    /// Whether there is one.
    const IS_THERE: bool;
}

/// No lobe.
#[derive(Clone, Copy, Debug)]
pub struct NoLobe;

/// The lobe of a highlight with cosθ_i.
#[derive(Clone, Copy, Debug)]
pub struct WithCosine;

/// The lobe of a highlight without cosθ_i, (3.11) and (3.12).
#[derive(Clone, Copy, Debug)]
pub struct WithoutCosine;

impl<V: Lane> Lobe<V> for NoLobe {
    #[inline(always)]
    fn value(&self, cos_squared: V, _: V, _: V) -> V {
        cos_squared.splat_like(0.0)
    }
}

impl<V: Lane> LobeOfKernel<V> for NoLobe {
    const IS_THERE: bool = false;
}

impl<V: Lane> Lobe<V> for WithCosine {
    #[inline(always)]
    fn value(&self, _: V, sin_squared: V, inverse: V) -> V {
        sin_squared * inverse
    }
}

impl<V: Lane> LobeOfKernel<V> for WithCosine {
    const IS_THERE: bool = true;
}

impl<V: Lane> Lobe<V> for WithoutCosine {
    #[inline(always)]
    fn value(&self, _: V, sin_squared: V, inverse: V) -> V {
        sin_squared * inverse
    }

    #[inline(always)]
    fn weight(&self, along_lit: V, distance: V) -> V {
        weight_without_cosine(along_lit, distance)
    }
}

impl<V: Lane> LobeOfKernel<V> for WithoutCosine {
    const IS_THERE: bool = true;
}

impl Power {
    /// Chooses the method for the highlight of a formula and a precision.
    pub fn of(formula: &BrightnessFormula, precision: Precision) -> Self {
        match formula.sharpness() {
            Some(n) if formula.jumps_at_terminator() => Self::WithoutCosine(AnyPower { half: 0.5 * n }),
            shininess => Self::new(shininess, precision),
        }
    }

    /// Chooses the method for a shininess (`None` if the formula has no highlight) and a precision.
    fn new(shininess: Option<f64>, precision: Precision) -> Self {
        // Beyond these lengths, the chain's error would exceed that of the polynomials.
        let longest = match precision {
            Precision::Double => 512.0,
            Precision::Single => *SHININESS_IN_SINGLE.end(),
        };
        match shininess {
            None => Self::None,
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number up to 512")]
            Some(n) if n.fract() == 0.0 && n <= longest => {
                Self::Whole(WholePower { half: n as u32 / 2, is_odd: n % 2.0 == 1.0 })
            }
            Some(n) => Self::Any(AnyPower { half: 0.5 * n }),
        }
    }

    /// For each vector of points, the sum of the terms of `count` emitters, each multiplied by its lobe. The terms are
    /// overwritten.
    #[inline(always)]
    pub fn sum<V: Lane>(&self, token: V::Token, terms: &mut Terms<V::Element>, count: usize, sums: &mut [V::Element]) {
        token.in_own_function(
            #[inline(always)]
            || match self {
                Self::None => {}
                Self::Whole(power) => power.sum::<V>(token, terms, count, sums),
                Self::Any(power) | Self::WithoutCosine(power) => terms.sum(
                    token,
                    count,
                    sums,
                    #[inline(always)]
                    |sine: V| power.value(sine),
                ),
            },
        );
    }
}

impl<E: Element> Terms<E> {
    /// Room for a number of terms.
    #[inline(always)]
    pub fn room<V: Lane<Element = E>>(&mut self, terms: usize) -> Room<'_, E> {
        let needed = 2 * V::COUNT * terms;
        if self.0.len() < needed {
            self.0.resize(needed, E::default());
        }
        Room(&mut self.0)
    }

    /// The sums of the terms with this lobe.
    #[inline(always)]
    fn sum<V: Lane<Element = E>>(&self, token: V::Token, count: usize, sums: &mut [E], lobe: impl Fn(V) -> V) {
        let mut rest = self.0.as_slice();
        for out in sums.chunks_exact_mut(V::COUNT) {
            let mut sum = V::splat(token, E::default());
            for _ in 0..count {
                let (term, others) = rest.split_at(2 * V::COUNT);
                sum = V::load(token, term).mul_add(lobe(V::load(token, &term[V::COUNT..])), sum);
                rest = others;
            }
            sum.store(out);
        }
    }

    /// Replaces what each of `count` lobes is multiplied by, and its sin²θ_h.
    #[inline(always)]
    fn replace<V: Lane<Element = E>>(&mut self, token: V::Token, count: usize, change: impl Fn(V, V) -> [V; 2]) {
        let mut rest = self.0.as_mut_slice();
        for _ in 0..count {
            let (term, others) = rest.split_at_mut(2 * V::COUNT);
            let [weight, sine] = change(V::load(token, term), V::load(token, &term[V::COUNT..]));
            weight.store(term);
            sine.store(&mut term[V::COUNT..]);
            rest = others;
        }
    }
}

impl<E: Element> Room<'_, E> {
    /// Writes the next term.
    #[inline(always)]
    pub fn put<V: Lane<Element = E>>(&mut self, weight: V, sine: V) {
        let (term, others) = std::mem::take(&mut self.0).split_at_mut(2 * V::COUNT);
        weight.store(term);
        sine.store(&mut term[V::COUNT..]);
        self.0 = others;
    }
}

/// In the loop of the sum; for longer ones, cos²θ_h is squared before, and n is halved.
const LONGEST_CHAIN: u32 = 12;

impl WholePower {
    #[inline(always)]
    fn sum<V: Lane>(self, token: V::Token, terms: &mut Terms<V::Element>, count: usize, sums: &mut [V::Element]) {
        let all = count * (sums.len() / V::COUNT);
        if self.is_odd {
            terms.replace(
                token,
                all,
                #[inline(always)]
                |weight: V, sine| [weight * cos_squared(sine).max_zero().sqrt(), sine],
            );
        }
        // cos²θ_h is 1 − sin²θ_h, or what the sines are replaced by.
        let [mut slope, mut constant] = [-1.0, 1.0];
        let mut half = self.half;
        if half > LONGEST_CHAIN {
            terms.replace(
                token,
                all,
                #[inline(always)]
                |weight: V, sine| [weight, cos_squared(sine)],
            );
            [slope, constant] = [1.0, 0.0];
        }
        while half > LONGEST_CHAIN {
            let is_odd = half % 2 == 1;
            half /= 2;
            terms.replace(
                token,
                all,
                #[inline(always)]
                |weight: V, cosine| [if is_odd { weight * cosine } else { weight }, cosine * cosine],
            );
        }
        let slope = V::splat(token, V::Element::from_f64(slope));
        let constant = V::splat(token, V::Element::from_f64(constant));
        macro_rules! chain {
            ($length:literal) => {
                terms.sum(
                    token,
                    count,
                    sums,
                    #[inline(always)]
                    |sine: V| whole_power::<$length, V>(sine.mul_add(slope, constant)),
                )
            };
        }
        match half {
            0 => chain!(0),
            1 => chain!(1),
            2 => chain!(2),
            3 => chain!(3),
            4 => chain!(4),
            5 => chain!(5),
            6 => chain!(6),
            7 => chain!(7),
            8 => chain!(8),
            9 => chain!(9),
            10 => chain!(10),
            11 => chain!(11),
            _ => chain!(12),
        }
    }
}

/// cos²θ_h as 1 − sin²θ_h: near the peak, where the power would amplify it, only the error of one rounding remains.
#[inline(always)]
fn cos_squared<V: Lane>(sin_squared: V) -> V {
    sin_squared.splat_like(1.0) - sin_squared
}

/// A product of powers of two.
#[inline(always)]
fn whole_power<const EXPONENT: u32, V: Lane>(base: V) -> V {
    let square = base * base;
    let fourth = square * square;
    let eighth = fourth * fourth;
    match EXPONENT {
        0 => base.splat_like(1.0),
        1 => base,
        2 => square,
        3 => square * base,
        4 => fourth,
        5 => fourth * base,
        6 => fourth * square,
        7 => fourth * (square * base),
        8 => eighth,
        9 => eighth * base,
        10 => eighth * square,
        11 => eighth * (square * base),
        _ => eighth * fourth,
    }
}

impl AnyPower {
    #[inline(always)]
    fn value<V: Lane>(self, sin_squared: V) -> V {
        // Zero has no logarithm, and for anything smaller than this there are no digits.
        let cos_squared = cos_squared(sin_squared).max(sin_squared.splat_like(1e-30));
        exp2(log2_of_cosine(cos_squared, sin_squared) * sin_squared.splat_like(self.half))
    }
}

/// log₂ of a number up to 1, given 1 minus it too.
#[inline(always)]
fn log2_of_cosine<V: Lane>(x: V, rest: V) -> V {
    let [mantissa, exponent] = x.split();
    let above_one = mantissa - x.splat_like(1.0);
    match V::Element::PRECISION {
        // log₂(1 + f)/f, fit for the least error of the logarithm: 5e-8.
        Precision::Single => {
            let series = polynomial(
                above_one,
                &[
                    1.442_694_772_427_74,
                    -0.721_357_148_922_201_3,
                    0.480_939_444_824_166_23,
                    -0.360_087_215_859_417_94,
                    0.286_707_455_473_259_04,
                    -0.250_069_042_135_453_33,
                    0.236_890_377_489_824_42,
                    -0.145_744_469_412_340_04,
                ],
            );
            above_one.mul_add(series, exponent)
        }
        // 2 artanh s with s = (m − 1)/(m + 1), |s| ≤ 0.172: 2s (1 + s²/3 + s⁴/5 + …). Near the peak, m − 1 is −sin² with all
        // its digits.
        Precision::Double => {
            let is_far = exponent.is_less(x.splat_like(0.0));
            let above_one = V::select(is_far, above_one, -rest);
            let s = above_one / (above_one + x.splat_like(2.0));
            let square = s * s;
            let mut series = x.splat_like(LOG2_OF_E_TWICE / 19.0);
            for k in (0..9).rev() {
                series = series.mul_add(square, x.splat_like(LOG2_OF_E_TWICE / f64::from(2 * k + 1)));
            }
            s.mul_add(series, exponent)
        }
    }
}

const LOG2_OF_E_TWICE: f64 = 2.0 * std::f64::consts::LOG2_E;

/// 2ˣ for x ≤ 0, down to the smallest normal number of the type.
#[inline(always)]
fn exp2<V: Lane>(x: V) -> V {
    let least = match V::Element::PRECISION {
        Precision::Double => -1020.0,
        Precision::Single => -124.0,
    };
    let x = x.max(x.splat_like(least));
    let shifted = x + x.splat_like(V::WHOLE);
    let fraction = x - (shifted - x.splat_like(V::WHOLE));
    let power = match V::Element::PRECISION {
        // Fit for the least relative error: 9e-8.
        Precision::Single => polynomial(
            fraction,
            &[
                1.0,
                0.693_146_977_598_992_5,
                0.240_222_420_852_622_8,
                0.055_507_337_434_971_64,
                0.009_671_512_644_824_794,
                0.001_326_472_712_356_083_6,
            ],
        ),
        // The power series of e^(x ln 2), |x| ≤ ½.
        Precision::Double => {
            let mut terms = [1.0; 13];
            for k in 1..terms.len() {
                #[expect(clippy::cast_precision_loss, reason = "13 terms")]
                let next = terms[k - 1] * std::f64::consts::LN_2 / k as f64;
                terms[k] = next;
            }
            polynomial(fraction, &terms)
        }
    };
    power.scale(shifted)
}

/// The polynomial with these coefficients, from that of 1 up.
#[inline(always)]
fn polynomial<V: Lane, const COUNT: usize>(x: V, coefficients: &[f64; COUNT]) -> V {
    let mut value = x.splat_like(coefficients[COUNT - 1]);
    for k in (0..COUNT - 1).rev() {
        value = value.mul_add(x, x.splat_like(coefficients[k]));
    }
    value
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
            let mut terms = Terms::default();
            terms.room::<V>(1).put(splat(1.0), splat(sin_squared));
            let mut values = [V::Element::default(); 32];
            self.power.sum::<V>(token, &mut terms, 1, &mut values[..V::COUNT]);
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
            for shininess in [0.1, 1.0, 1.5, 2.0, 7.0, 20.0, 20.5, 23.9, 32.0, 511.0, 900.0, 12_345.6] {
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
                    // Sharper highlights are left to double precision.
                    if SHININESS_IN_SINGLE.contains(&shininess) {
                        assert!((single - exact).abs() <= allowed(6e-8, 1e-36), "{case}: {single:e} {exact:e}");
                    }
                }
            }
        }
    }
}
