//! Numbers with 32 digits: the unevaluated sum of two doubles.
//!
//! They trace the few rays for which a double is not enough, and they are the reference against which the tests measure the
//! error of everything else. (This is our own implementation because the available crate, twofloat 0.8.4, gave (1/3)·3 − 1 =
//! −5.6e-17 and exp(ln x) to 11 digits.) Algorithms: Dekker 1971; Knuth, TAOCP 4.2.2; Joldeș, Muller and Popescu, "Tight and
//! rigorous error bounds for basic building blocks of double-word arithmetic", ACM TOMS 44(2), 2017.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::real::Real;

/// A number with about 106 bits: `high + low`, with |low| at most half a unit in the last place of `high`. Or a vector of
/// such numbers, as two vectors of doubles.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct DoubleDouble<T = f64> {
    high: T,
    low: T,
}

/// Doubles above this are whole numbers: adding and subtracting it rounds.
const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// The nearest whole number.
#[inline(always)]
fn whole<T: Real>(number: T) -> T {
    (number + number.splat_like(ROUNDING)) - number.splat_like(ROUNDING)
}

/// 1/n! for n = 3, 5, 7, …, as pairs.
const ODD_FACTORIALS: [(f64, f64); 14] = [
    (0.166_666_666_666_666_66, 9.251_858_538_542_97e-18),
    (0.008_333_333_333_333_333, 1.156_482_317_317_871_4e-19),
    (0.000_198_412_698_412_698_4, 1.720_955_829_342_070_5e-22),
    (2.755_731_922_398_589_3e-06, -1.858_393_274_046_472e-22),
    (2.505_210_838_544_172e-08, -1.448_814_070_935_912e-24),
    (1.605_904_383_682_161_3e-10, 1.258_529_458_875_209_8e-26),
    (7.647_163_731_819_816e-13, 7.038_728_777_334_53e-30),
    (2.811_457_254_345_520_6e-15, 1.650_884_273_086_143_3e-31),
    (8.220_635_246_624_33e-18, 2.214_189_411_960_426_5e-34),
    (1.957_294_106_339_126_3e-20, -1.364_350_383_008_790_8e-36),
    (3.868_170_170_630_684e-23, -8.843_177_655_482_344e-40),
    (6.446_950_284_384_474e-26, -1.933_040_423_370_346_5e-42),
    (9.183_689_863_795_546e-29, 1.430_315_039_678_732_2e-45),
    (1.130_996_288_644_771_6e-31, 1.049_801_541_295_950_6e-47),
];

/// 1/n! for n = 2, 4, 6, …, as pairs.
const EVEN_FACTORIALS: [(f64, f64); 14] = [
    (0.5, 0.0),
    (0.041_666_666_666_666_664, 2.312_964_634_635_742_7e-18),
    (0.001_388_888_888_888_889, -5.300_543_954_373_577e-20),
    (2.480_158_730_158_73e-05, 2.151_194_786_677_588_2e-23),
    (2.755_731_922_398_589e-07, 2.376_771_462_225_029_7e-23),
    (2.087_675_698_786_81e-09, -1.207_345_059_113_26e-25),
    (1.147_074_559_772_972_5e-11, 2.065_551_275_283_074_5e-28),
    (4.779_477_332_387_385e-14, 4.399_205_485_834_081e-31),
    (1.561_920_696_858_622_5e-16, 1.191_067_966_027_375_4e-32),
    (4.110_317_623_312_165e-19, 1.441_297_337_865_952_7e-36),
    (8.896_791_392_450_574e-22, -7.911_402_614_872_376e-38),
    (1.611_737_571_096_118_4e-24, -3.684_657_356_450_976_6e-41),
    (2.479_596_263_224_797_6e-27, -1.295_373_096_476_522_9e-43),
    (3.279_889_237_069_838e-30, 1.511_754_274_402_987_9e-46),
];

/// A number type whose products can be computed exactly, as two numbers.
///
/// Operations on pairs of vectors must be inlined, so that they use the selected instruction set; for pairs of doubles,
/// inlining would only make the program large. So each type defines how its operations are called.
pub trait ExactProduct: Real {
    /// self · factor − product, exactly, when `product` is the rounded self · factor.
    #[must_use]
    fn product_rest(self, factor: Self, product: Self) -> Self;

    /// first + second.
    #[must_use]
    fn sum_of_pairs(first: DoubleDouble<Self>, second: DoubleDouble<Self>) -> DoubleDouble<Self>;

    /// first · second.
    #[must_use]
    fn product_of_pairs(first: DoubleDouble<Self>, second: DoubleDouble<Self>) -> DoubleDouble<Self>;

    /// first / second.
    #[must_use]
    fn quotient_of_pairs(first: DoubleDouble<Self>, second: DoubleDouble<Self>) -> DoubleDouble<Self>;
}

/// The operations of [`ExactProduct`] on pairs, with their inlining attribute.
macro_rules! operations_on_pairs {
    ($inline:meta) => {
        #[$inline]
        fn sum_of_pairs(first: DoubleDouble<Self>, second: DoubleDouble<Self>) -> DoubleDouble<Self> {
            first.plus(second)
        }

        #[$inline]
        fn product_of_pairs(first: DoubleDouble<Self>, second: DoubleDouble<Self>) -> DoubleDouble<Self> {
            first.times(second)
        }

        #[$inline]
        fn quotient_of_pairs(first: DoubleDouble<Self>, second: DoubleDouble<Self>) -> DoubleDouble<Self> {
            first.over(second)
        }
    };
}

pub(crate) use operations_on_pairs;

impl ExactProduct for f64 {
    #[inline(always)]
    fn product_rest(self, factor: Self, product: Self) -> Self {
        self.mul_add(factor, -product)
    }

    operations_on_pairs!(inline);
}

impl<T> DoubleDouble<T> {
    /// The same number in another type: `convert` must be exact.
    #[must_use]
    #[inline(always)]
    pub fn map<U>(self, convert: impl Fn(T) -> U) -> DoubleDouble<U> {
        DoubleDouble { high: convert(self.high), low: convert(self.low) }
    }
}

impl<T: ExactProduct> DoubleDouble<T> {
    /// A number with half the digits, exactly.
    #[must_use]
    #[inline(always)]
    pub fn exactly(high: T) -> Self {
        Self { high, low: high.splat_like(0.0) }
    }

    /// The nearest number with half the digits.
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

    /// a · b, exactly (except for underflow).
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
    /// A double, exactly.
    #[must_use]
    #[inline(always)]
    pub const fn from_f64(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    /// The nearest double.
    #[must_use]
    #[inline(always)]
    pub const fn rounded(self) -> f64 {
        self.high
    }

    /// π.
    pub const PI: Self = Self { high: std::f64::consts::PI, low: 1.224_646_799_147_353_2e-16 };

    /// The same number as a constant of another type.
    #[must_use]
    #[inline(always)]
    pub fn constant_like<T: ExactProduct>(self, like: T) -> DoubleDouble<T> {
        DoubleDouble { high: like.splat_like(self.high), low: like.splat_like(self.low) }
    }

    /// eˣ, to about 30 digits, for x in −700…700.
    #[must_use]
    pub fn exp(self) -> Self {
        if self.high < 0.0 {
            return Self::from_f64(1.0) / (-self).exp();
        }
        // eˣ = (e^(x/1024))^1024: for the small argument, a short series has full accuracy. It is stored as e^y − 1, for
        // which the squaring rule (1 + z)² − 1 = 2z + z² loses no digits.
        let halvings = 10;
        let scale = 0.5_f64.powi(halvings);
        let small = Self { high: self.high * scale, low: self.low * scale };
        let one = Self::from_f64(1.0);
        let mut term = one;
        let mut minus_one = Self::from_f64(0.0);
        for n in 1..=20 {
            term = term * small / Self::from_f64(f64::from(n));
            minus_one = minus_one + term;
        }
        for _ in 0..halvings {
            minus_one = minus_one + minus_one + minus_one * minus_one;
        }
        minus_one + one
    }

    /// ln x for x > 0, to about 30 digits: two Newton steps from the double's logarithm.
    #[must_use]
    pub fn ln(self) -> Self {
        let one = Self::from_f64(1.0);
        let mut logarithm = Self::from_f64(libm::log(self.high));
        for _ in 0..2 {
            logarithm = logarithm + self * (-logarithm).exp() - one;
        }
        logarithm
    }

    /// A power with an exponent above 0 of a base in 0…1: the integer part of the exponent by repeated squaring, the rest by
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
            Self::from_f64(0.0)
        }
    }
}

impl<T: ExactProduct> Real for DoubleDouble<T> {
    type Mask = T::Mask;
    const NEGLIGIBLE_SQUARE: f64 = 1e-64;

    #[inline(always)]
    fn splat_like(self, value: f64) -> Self {
        Self::exactly(self.high.splat_like(value))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        let zero = self.high.splat_like(0.0);
        let root = self.high.max(zero).sqrt();
        let rest = self - Self::product_of(root, root);
        let is_positive = zero.is_less(root);
        let low = rest.high / (root + T::select(is_positive, root, root.splat_like(1.0)));
        Self::normalized(root, T::select(is_positive, low, zero))
    }

    #[inline(always)]
    fn is_less(self, other: Self) -> T::Mask {
        // The difference of two such numbers is never rounded to the opposite sign.
        let difference = self - other;
        difference.high.is_less(difference.high.splat_like(0.0))
    }

    #[inline(always)]
    fn select(mask: T::Mask, yes: Self, no: Self) -> Self {
        Self { high: T::select(mask, yes.high, no.high), low: T::select(mask, yes.low, no.low) }
    }
}

impl<T: ExactProduct> DoubleDouble<T> {
    /// Sine and cosine of an angle within ±100, to about 29 decimal places.
    #[must_use]
    #[inline(always)]
    pub fn sine_and_cosine(self) -> (Self, Self) {
        let one = self.high.splat_like(1.0);
        let quarters = whole(self.high * one.splat_like(std::f64::consts::FRAC_2_PI));
        let rest = self - DoubleDouble::PI.constant_like(one) * Self::exactly(quarters * one.splat_like(0.5));
        // For an angle up to an eighth of a turn, the series have full accuracy by the 29th power.
        let square = -(rest * rest);
        let mut sums = [Self::exactly(one.splat_like(0.0)); 2];
        for (sum, factorials) in sums.iter_mut().zip([ODD_FACTORIALS, EVEN_FACTORIALS]) {
            for (high, low) in factorials.into_iter().rev() {
                *sum = (*sum + DoubleDouble { high, low }.constant_like(one)) * square;
            }
        }
        let (sine, cosine) = (rest + rest * sums[0], Self::exactly(one) + sums[1]);
        // −2 to 2, where both ends are half a turn.
        let quarter = quarters - one.splat_like(4.0) * whole(quarters * one.splat_like(0.25));
        let part = quarter * quarter - one;
        let is_odd = (part * part).is_less(one.splat_like(0.5));
        (Self::select(is_odd, cosine, sine).turned(quarter), Self::select(is_odd, sine, cosine).turned(-quarter))
    }

    /// The same with the other sign, half a turn and a negative quarter of one further.
    #[inline(always)]
    fn turned(self, quarter: T) -> Self {
        let one = quarter.splat_like(1.0);
        let sign = T::select(quarter.is_less(one.splat_like(-0.5)), -one, one);
        let sign = T::select(one.splat_like(2.25).is_less(quarter * quarter), -one, sign);
        Self { high: self.high * sign, low: self.low * sign }
    }

    #[inline(always)]
    pub(crate) fn plus(self, other: Self) -> Self {
        let high = Self::sum_of(self.high, other.high);
        let low = Self::sum_of(self.low, other.low);
        let carried = Self::normalized(high.high, high.low + low.high);
        Self::normalized(carried.high, carried.low + low.low)
    }

    #[inline(always)]
    pub(crate) fn times(self, other: Self) -> Self {
        let product = Self::product_of(self.high, other.high);
        let across = self.high * other.low + self.low * other.high;
        Self::normalized(product.high, product.low + across)
    }

    /// Long division, with three digits of 53 bits.
    #[inline(always)]
    pub(crate) fn over(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::exactly(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::exactly(second);
        let third = rest.high / other.high;
        Self::sum_of(first, second) + Self::exactly(third)
    }
}

impl<T: ExactProduct> Add for DoubleDouble<T> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        T::sum_of_pairs(self, other)
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
        T::product_of_pairs(self, other)
    }
}

impl<T: ExactProduct> Div for DoubleDouble<T> {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        T::quotient_of_pairs(self, other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Scalar;
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
        // The nearest doubles to √2, ln 2 and e, and their remainders (50-digit values).
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

    /// 50-digit values of sin and cos, split into doubles.
    #[test]
    fn sine_and_cosine_of_known_angles_have_their_second_double() {
        for (angle, sine, cosine) in KNOWN_ANGLES {
            let (found_sine, found_cosine) = DoubleDouble::from_f64(angle).sine_and_cosine();
            for (found, [high, low]) in [(found_sine, sine), (found_cosine, cosine)] {
                let error = (found - DoubleDouble { high, low }).rounded().abs();
                assert!(error < 1e-30, "{angle}: {error:e}");
            }
        }
    }

    #[expect(clippy::unreadable_literal, reason = "digits to be compared, not read")]
    const KNOWN_ANGLES: [(f64, [f64; 2], [f64; 2]); 10] = [
        (0.0, [0.0, 0.0], [1.0, 0.0]),
        (1e-08, [1e-08, -1.6666666666666668e-25], [1.0, -5e-17]),
        (0.5, [0.479425538604203, -5.103969860556013e-18], [0.8775825618903728, -4.2623149864279997e-17]),
        (1.0, [0.8414709848078965, 1.776845092935536e-18], [0.5403023058681398, -4.760954612604417e-17]),
        (2.0, [0.9092974268256817, -1.4020906557816256e-17], [-0.4161468365471424, 1.990596398957495e-17]),
        (3.0, [0.1411200080598672, 8.577269787017502e-18], [-0.9899924966004454, -4.2060261566099734e-17]),
        (4.5, [-0.977530117665097, -4.619499329500834e-17], [-0.2107957994307797, -1.036476988089257e-17]),
        (-1.25, [-0.9489846193555862, -1.3508965656504773e-17], [0.3153223623952687, -8.38166872079122e-18]),
        (6.25, [-0.03317921654755682, -5.87475042180262e-20], [0.9994494182244994, 1.1869597287901431e-17]),
        (30.0, [-0.9880316240928618, 3.655935837727403e-17], [0.15425144988758405, 3.980208666184612e-18]),
    ];

    proptest! {
        #[test]
        fn sine_and_cosine_add_their_angles(a in -40.0..40.0_f64, b in -40.0..40.0_f64) {
            let (x, y) = (DoubleDouble::from_f64(a), DoubleDouble::from_f64(b));
            let ((sin_x, cos_x), (sin_y, cos_y)) = (x.sine_and_cosine(), y.sine_and_cosine());
            let (sine, cosine) = (x + y).sine_and_cosine();
            prop_assert!((sine - (sin_x * cos_y + cos_x * sin_y)).rounded().abs() < 1e-29);
            prop_assert!((cosine - (cos_x * cos_y - sin_x * sin_y)).rounded().abs() < 1e-29);
            let (double_sine, double_cosine) = f64::sine_and_cosine_of(x + DoubleDouble { high: 0.0, low: 1e-18 });
            prop_assert!((double_sine - sin_x.rounded()).abs() < 3e-16 && (double_cosine - cos_x.rounded()).abs() < 3e-16);
        }

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
