//! SIMD vectors with one pixel per lane: the only file that names the SIMD crate.
//!
//! A vector has 16 numbers in single precision or 8 in double, in one register or two; with the widest registers, two
//! vectors are computed side by side. Where registers have 16 bytes, vectors have 4 and 2 numbers: emulating wider ones
//! makes the code large and slow to compile. Every lane is computed independently and rounded alike, so neither the
//! machine's vector width nor a pixel's position in a vector changes a bit. (The exception is machines without fused
//! multiply-add: SSE and WebAssembly round products before adding. AVX2, AVX-512 and NEON agree.)
//!
//! Everything generic over [`Lane`] must be `#[inline(always)]`: anything else is compiled for the baseline instruction set, and
//! each of its operations is a call. That holds for closures too, so they are written where they are passed (one bound by `let`
//! takes no attribute), and `array::map` and iterators over vectors are avoided.

use std::ops::{Add, Div, Mul, Neg, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{
    Level, f32x4, f32x16, f64x2, f64x8, mask32x4, mask32x16, mask64x2, mask64x8, u32x4, u32x16, u64x2, u64x8,
};

use crate::double_double::{DoubleDouble, ExactProduct, operations_on_pairs};
use crate::real::Real;

/// The instruction set that vectors are computed with.
pub trait SimdToken: Copy {
    /// Runs part of a job in a function of its own; mark the closure `#[inline(always)]`. Compile time grows roughly with
    /// the square of a function's size, so large functions are split.
    fn in_own_function<R>(self, part: impl FnOnce() -> R) -> R;
}

impl<S: Simd> SimdToken for S {
    #[inline(always)]
    fn in_own_function<R>(self, part: impl FnOnce() -> R) -> R {
        self.vectorize(part)
    }
}

/// A vector of numbers.
pub trait Lane: Real {
    /// The type of one of the numbers.
    type Element: Element;
    /// The instruction set that computes it.
    type Token: SimdToken;
    /// How many numbers there are.
    const COUNT: usize;
    /// The single vector type, where this one is a pair.
    type Narrow: Lane<Element = Self::Element, Token = Self::Token>;

    /// The same number in every lane.
    fn splat(token: Self::Token, element: Self::Element) -> Self;

    /// Reads the numbers; the slice must have at least [`COUNT`](Self::COUNT) of them.
    fn load(token: Self::Token, numbers: &[Self::Element]) -> Self;

    /// Reads doubles and rounds them; the slice must have at least [`COUNT`](Self::COUNT) of them.
    fn load_doubles(token: Self::Token, numbers: &[f64]) -> Self;

    /// Bit i tells whether the mask is set in lane i.
    fn bits(mask: Self::Mask) -> u32;

    /// Bit i tells whether the mask is not set in lane i.
    #[inline(always)]
    fn bits_not(mask: Self::Mask) -> u32 {
        let all = if Self::COUNT == 32 { u32::MAX } else { (1 << Self::COUNT) - 1 };
        !Self::bits(mask) & all
    }

    /// The smaller of two numbers.
    #[must_use]
    fn min(self, other: Self) -> Self;

    /// first + i in lane i. `first` is a whole number; in single precision, of less than 24 bits.
    fn counted(token: Self::Token, first: f64) -> Self;

    /// Writes the numbers; the slice has room for [`COUNT`](Self::COUNT).
    fn store(self, out: &mut [Self::Element]);

    /// self · factor − product, exactly, when `product` is the rounded self · factor.
    #[must_use]
    fn product_rest(self, factor: Self, product: Self) -> Self;

    /// m and k of x = m·2ᵏ with √½ ≤ m < √2, for a positive normal x.
    #[must_use]
    fn split(self) -> [Self; 2];

    /// self · 2ᵏ, where `shifted` is k + [`WHOLE`](Self::WHOLE) and nothing leaves the range of normal numbers.
    #[must_use]
    fn scale(self, shifted: Self) -> Self;

    /// 1.5·2ᵖ, where p is the number of a mantissa's stored digits: a sum with it has no fraction.
    const WHOLE: f64;
}

impl<V: Lane<Element = f64>> ExactProduct for V {
    #[inline(always)]
    fn product_rest(self, factor: Self, product: Self) -> Self {
        Lane::product_rest(self, factor, product)
    }

    operations_on_pairs!(inline(always));
}

/// The number type of a lane.
pub trait Element: Copy + Default + PartialOrd + Send + Sync + 'static {
    /// Of a [`LaneJob`]'s two types of lane, the one that computes with these numbers.
    type LaneOf<S, D>: Lane<Element = Self, Token = S::Token>
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>;

    /// Its precision, which sets the degree of polynomials.
    const PRECISION: Precision;

    /// The nearest number of this type.
    fn from_f64(value: f64) -> Self;

    /// The number, exactly.
    fn to_f64(self) -> f64;

    /// The same slice, if this type is `f64`.
    fn of_doubles(numbers: &mut [f64]) -> Option<&mut [Self]>;

    /// The same slice, if this type is `f32`.
    fn of_singles(numbers: &mut [f32]) -> Option<&mut [Self]>;

    /// The same slice, if this type is `E`.
    fn cast<E: Element>(numbers: &mut [Self]) -> Option<&mut [E]>;
}

/// How precisely maps are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Precision {
    /// 64 bits: within [`DOUBLE`](crate::tolerance::DOUBLE) of exact arithmetic.
    #[default]
    Double,
    /// 32 bits: within [`SINGLE`](crate::tolerance::SINGLE), at about twice the speed.
    Single,
}

impl crate::units::Keyword for Precision {
    const ALL: &'static [Self] = &[Self::Double, Self::Single];

    fn name(self) -> &'static str {
        match self {
            Self::Double => "double",
            Self::Single => "single",
        }
    }
}

impl Element for f64 {
    type LaneOf<S, D>
        = D
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>;

    const PRECISION: Precision = Precision::Double;

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }

    #[inline(always)]
    fn of_doubles(numbers: &mut [f64]) -> Option<&mut [Self]> {
        Some(numbers)
    }

    #[inline(always)]
    fn of_singles(_: &mut [f32]) -> Option<&mut [Self]> {
        None
    }

    #[inline(always)]
    fn cast<E: Element>(numbers: &mut [Self]) -> Option<&mut [E]> {
        E::of_doubles(numbers)
    }
}

impl Element for f32 {
    type LaneOf<S, D>
        = S
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>;

    const PRECISION: Precision = Precision::Single;

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "rounding is the purpose")]
    fn from_f64(value: f64) -> Self {
        value as f32
    }

    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }

    #[inline(always)]
    fn of_doubles(_: &mut [f64]) -> Option<&mut [Self]> {
        None
    }

    #[inline(always)]
    fn of_singles(numbers: &mut [f32]) -> Option<&mut [Self]> {
        Some(numbers)
    }

    #[inline(always)]
    fn cast<E: Element>(numbers: &mut [Self]) -> Option<&mut [E]> {
        E::of_singles(numbers)
    }
}

/// An instruction set of the machine.
#[derive(Clone, Copy, Debug)]
pub struct Instructions(Level);

impl Instructions {
    /// The best instruction set of this machine.
    #[must_use]
    pub fn best() -> Self {
        Self(known(Level::new()))
    }

    /// All instruction sets of this machine, for tests that compare their results.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let best = Level::new();
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        let levels =
            [best.as_sse2().map(Level::Sse2), best.as_avx2().map(Level::Avx2), best.as_avx512().map(Level::Avx512)];
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        let levels = [Some(best)];
        levels.into_iter().flatten().map(Self).collect()
    }

    /// Its usual name, such as `avx512`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self.0 {
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Sse2(_) => "sse2",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Avx2(_) => "avx2",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Avx512(_) => "avx512",
            #[cfg(target_arch = "aarch64")]
            Level::Neon(_) => "neon",
            _ => "simd128 or none",
        }
    }

    /// Whether it has fused multiply-add, which does not round the product: such machines agree in every bit.
    #[must_use]
    #[inline(always)]
    pub fn fuse(self) -> bool {
        match self.0 {
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Avx2(_) | Level::Avx512(_) => true,
            #[cfg(target_arch = "aarch64")]
            Level::Neon(_) => true,
            _ => false,
        }
    }

    /// Runs a job with vectors for this instruction set.
    pub fn run<J: LaneJob>(self, job: J) -> J::Output {
        job.run_by(self)
    }

    /// Whether [`run_wide`](Self::run_wide) knows this instruction set.
    #[must_use]
    pub fn are_wide(self) -> bool {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        return self.fuse();
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        true
    }

    /// Runs a job that is not compiled for machines from before 2013, of the kind that has SSE2 alone.
    ///
    /// # Panics
    /// On such a machine.
    pub fn run_wide<J: LaneJob>(self, job: J) -> J::Output {
        job.run_wide_by(self)
    }
}

/// A level that kernels are compiled for.
fn known(level: Level) -> Level {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    if let (Level::Sse4_2(_), Some(token)) = (level, level.as_sse2()) {
        return Level::Sse2(token);
    }
    level
}

/// A computation on vectors.
pub trait LaneJob {
    /// Its result.
    type Output;

    /// Runs it; mark it `#[inline(always)]`.
    fn run<S, D>(self, token: S::Token) -> Self::Output
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>;

    /// Runs it with this instruction set. Everything that a job calls is compiled into this function, once per instruction
    /// set. (Because it is a method of the job, each job is compiled separately.)
    #[inline(never)]
    fn run_by(self, instructions: Instructions) -> Self::Output
    where
        Self: Sized,
    {
        // Not the crate's `dispatch!`, which would also compile a kernel for SSE4.2 unless build flags set outside the
        // source say otherwise. Machines between SSE2 and AVX2 (2008 to 2013) use the SSE2 kernels.
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        if !instructions.are_wide()
            && let Some(token) = instructions.0.as_sse2()
        {
            return run_with(token, self);
        }
        self.run_wide_by(instructions)
    }

    /// See [`Instructions::run_wide`].
    #[inline(never)]
    fn run_wide_by(self, instructions: Instructions) -> Self::Output
    where
        Self: Sized,
    {
        let level = instructions.0;
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        {
            if let Some(token) = level.as_avx512() {
                return run_with(token, self);
            }
            if let Some(token) = level.as_avx2() {
                return run_with(token, self);
            }
        }
        #[cfg(target_arch = "aarch64")]
        if let Some(token) = level.as_neon() {
            return run_with(token, self);
        }
        #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
        if let Some(token) = level.as_wasm_simd128() {
            return run_with(token, self);
        }
        #[cfg(any(
            all(target_arch = "wasm32", not(target_feature = "simd128")),
            not(any(target_arch = "x86", target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32"))
        ))]
        if let Level::Fallback(token) = level {
            return run_with(token, self);
        }
        unreachable!("a machine of this architecture has one of the levels above, not {level:?}")
    }
}

#[inline(always)]
fn run_with<S: Simd, J: LaneJob>(simd: S, job: J) -> J::Output {
    simd.vectorize(
        #[inline(always)]
        || {
            // Two vectors in flight hide the latency of the divider. Where a vector already fills two of sixteen registers,
            // there is no room for two.
            match const { <S::f32s as SimdBase<S>>::LEN } {
                16 => job.run::<Pair<f32x16<S>>, Pair<f64x8<S>>>(simd),
                // NEON has enough registers for four at a time.
                4 if !cfg!(target_arch = "aarch64") => job.run::<f32x4<S>, f64x2<S>>(simd),
                _ => job.run::<f32x16<S>, f64x8<S>>(simd),
            }
        },
    )
}

/// 1/√x from a first guess, x shifted by one bit, which halves its exponent: then e = 1 − x y² is within ±0.07, and 1/√(1 − e)
/// is a polynomial. (The divider would take longer than everything else that is computed about a point.)
#[inline(always)]
fn inverse_sqrt<V: Lane>(x: V, first: V) -> V {
    let rest = (-(first * first)).mul_add(x, x.splat_like(1.0));
    // Fit for the least relative error: 2.4e-8.
    let factor = x.splat_like(0.273_173_524_014_358_46);
    let factor = factor.mul_add(rest, x.splat_like(0.313_958_399_627_240_87));
    let factor = factor.mul_add(rest, x.splat_like(0.375_003_823_363_462_2));
    let factor = factor.mul_add(rest, x.splat_like(0.499_998_273_090_416_7));
    let factor = factor.mul_add(rest, x.splat_like(1.0));
    let second = first * factor;
    match V::Element::PRECISION {
        Precision::Single => second,
        Precision::Double => {
            let rest = (-(second * second)).mul_add(x, x.splat_like(1.0));
            let factor = rest.mul_add(x.splat_like(0.375), x.splat_like(0.5));
            (second * rest).mul_add(factor, second)
        }
    }
}

macro_rules! lane {
    ($vector:ident, $mask:ident, $bits:ident, $element:ty, $max:ident, $min:ident, half: $half:expr, negligible: $negligible:expr,
     mantissa bits: $width:expr, first whole: $first_whole:expr, bias: $bias:expr, one: $one:expr, root half: $root_half:expr,
     half of bits: $half_of_bits:expr) => {
        impl<S: Simd> Real for $vector<S> {
            type Mask = $mask<S>;
            const NEGLIGIBLE_SQUARE: f64 = $negligible;

            #[inline(always)]
            fn splat_like(self, value: f64) -> Self {
                <Self as Lane>::splat(self.simd, <$element>::from_f64(value))
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                <Self as fearless_simd::SimdFloat<S>>::sqrt(self)
            }

            #[inline(always)]
            fn inverse_sqrt(self) -> Self {
                let bits: $bits<S> = self.bitcast();
                inverse_sqrt(self, ($bits::splat(self.simd, $half_of_bits) - (bits >> 1)).bitcast())
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, addend: Self) -> Self {
                fearless_simd::SimdFloat::mul_add(self, factor, addend)
            }

            #[inline(always)]
            fn is_less(self, other: Self) -> Self::Mask {
                self.simd_lt(other)
            }

            #[inline(always)]
            fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
                mask.select(yes, no)
            }

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                self.simd.$max(self, other)
            }
        }

        impl<S: Simd> Lane for $vector<S> {
            type Element = $element;
            type Token = S;
            const COUNT: usize = <Self as SimdBase<S>>::LEN;
            type Narrow = Self;

            #[inline(always)]
            fn splat(token: S, element: $element) -> Self {
                SimdBase::splat(token, element)
            }

            #[inline(always)]
            fn load(token: S, numbers: &[$element]) -> Self {
                SimdBase::from_slice(token, &numbers[..Self::COUNT])
            }

            #[inline(always)]
            fn load_doubles(token: S, numbers: &[f64]) -> Self {
                doubles::$vector(token, numbers)
            }

            #[inline(always)]
            #[expect(clippy::cast_possible_truncation, reason = "at most 16 lanes")]
            fn bits(mask: $mask<S>) -> u32 {
                SimdMask::to_bitmask(mask) as u32
            }

            #[inline(always)]
            fn min(self, other: Self) -> Self {
                self.simd.$min(self, other)
            }

            #[inline(always)]
            fn counted(token: S, first: f64) -> Self {
                const LANES: [$element; 16] = [0., 1., 2., 3., 4., 5., 6., 7., 8., 9., 10., 11., 12., 13., 14., 15.];
                <Self as Lane>::load(token, &LANES) + <Self as Lane>::splat(token, <$element>::from_f64(first))
            }

            #[inline(always)]
            fn store(self, out: &mut [$element]) {
                self.store_slice(&mut out[..Self::COUNT]);
            }

            #[inline(always)]
            fn product_rest(self, factor: Self, product: Self) -> Self {
                if Instructions(self.simd.level()).fuse() {
                    return fearless_simd::SimdFloat::mul_add(self, factor, -product);
                }
                // Dekker's splitting: halves with half the digits, whose products are exact.
                let halves = |whole: Self| {
                    let shifted = whole * $half;
                    let upper = shifted - (shifted - whole);
                    (upper, whole - upper)
                };
                let ((a, b), (c, d)) = (halves(self), halves(factor));
                b * d - (((product - a * c) - b * c) - a * d)
            }

            #[inline(always)]
            fn split(self) -> [Self; 2] {
                let bits: $bits<S> = self.bitcast();
                let one = $bits::splat(self.simd, $one);
                // With this much more, numbers from √½ up have the exponent bits of numbers from 1 up.
                let raised = bits + $bits::splat(self.simd, $one - $root_half);
                // Puts the exponent bits below the binary point of a number whose last digit counts ones.
                let first_whole = <Self as Lane>::splat(self.simd, $first_whole).bitcast::<$bits<S>>();
                let exponent = ((raised >> $width) | first_whole).bitcast::<Self>();
                let mantissa = (bits - (raised & $bits::splat(self.simd, !((1 << $width) - 1)))) + one;
                [mantissa.bitcast(), exponent - ($first_whole + $bias)]
            }

            #[inline(always)]
            fn scale(self, shifted: Self) -> Self {
                let (bits, shifted): ($bits<S>, $bits<S>) = (self.bitcast(), shifted.bitcast());
                (bits + (shifted << $width)).bitcast()
            }

            const WHOLE: f64 = 1.5 * $first_whole;
        }
    };
}

macro_rules! single_lane {
    ($($vector:ident $mask:ident $bits:ident $max:ident $min:ident),*) => {$(
        lane!($vector, $mask, $bits, f32, $max, $min, half: 4097.0, negligible: 1e-14,
            mantissa bits: 23, first whole: 8_388_608.0, bias: 127.0, one: 0x3f80_0000, root half: 0x3f35_04f3,
            half of bits: 0x5f37_59df);
    )*};
}

macro_rules! double_lane {
    ($($vector:ident $mask:ident $bits:ident $max:ident $min:ident),*) => {$(
        lane!($vector, $mask, $bits, f64, $max, $min, half: 134_217_729.0, negligible: 1e-32,
            mantissa bits: 52, first whole: 4_503_599_627_370_496.0, bias: 1023.0, one: 0x3ff0_0000_0000_0000,
            root half: 0x3fe6_a09e_667f_3bcd, half of bits: 0x5fe6_eb50_c7b5_37a9);
    )*};
}

single_lane!(f32x4 mask32x4 u32x4 max_f32x4 min_f32x4, f32x16 mask32x16 u32x16 max_f32x16 min_f32x16);
double_lane!(f64x2 mask64x2 u64x2 max_f64x2 min_f64x2, f64x8 mask64x8 u64x8 max_f64x8 min_f64x8);

/// Doubles as vectors of either precision.
mod doubles {
    use super::{Simd, SimdBase, SimdNarrow, f32x4, f32x16, f64x2, f64x8};

    macro_rules! doubles {
        ($($double:ident $single:ident $count:literal),*) => {$(
            #[inline(always)]
            pub fn $double<S: Simd>(token: S, numbers: &[f64]) -> $double<S> {
                $double::from_slice(token, &numbers[..$count])
            }

            #[inline(always)]
            pub fn $single<S: Simd>(token: S, numbers: &[f64]) -> $single<S> {
                $double(token, numbers).narrow($double(token, &numbers[$count..]))
            }
        )*};
    }

    doubles!(f64x2 f32x4 2, f64x8 f32x16 8);
}

/// Two vectors that are computed side by side.
#[derive(Clone, Copy, Debug)]
pub struct Pair<V>(V, V);

macro_rules! pairwise {
    ($($trait:ident $method:ident),*) => {$(
        impl<V: $trait<Output = V>> $trait for Pair<V> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0), self.1.$method(other.1))
            }
        }
    )*};
}

pairwise!(Add add, Sub sub, Mul mul, Div div);

impl<V: Neg<Output = V>> Neg for Pair<V> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl<V: Real> Real for Pair<V> {
    type Mask = (V::Mask, V::Mask);
    const NEGLIGIBLE_SQUARE: f64 = V::NEGLIGIBLE_SQUARE;

    #[inline(always)]
    fn splat_like(self, value: f64) -> Self {
        let constant = self.0.splat_like(value);
        Self(constant, constant)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt(), self.1.sqrt())
    }

    #[inline(always)]
    fn inverse_sqrt(self) -> Self {
        Self(self.0.inverse_sqrt(), self.1.inverse_sqrt())
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        Self(self.0.mul_add(factor.0, addend.0), self.1.mul_add(factor.1, addend.1))
    }

    #[inline(always)]
    fn is_less(self, other: Self) -> Self::Mask {
        (self.0.is_less(other.0), self.1.is_less(other.1))
    }

    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Self(V::select(mask.0, yes.0, no.0), V::select(mask.1, yes.1, no.1))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0), self.1.max(other.1))
    }
}

impl<V: Lane> Lane for Pair<V> {
    type Element = V::Element;
    type Token = V::Token;
    const COUNT: usize = 2 * V::COUNT;
    type Narrow = V;

    #[inline(always)]
    fn splat(token: V::Token, element: V::Element) -> Self {
        let splat = V::splat(token, element);
        Self(splat, splat)
    }

    #[inline(always)]
    fn load(token: V::Token, numbers: &[V::Element]) -> Self {
        Self(V::load(token, numbers), V::load(token, &numbers[V::COUNT..]))
    }

    #[inline(always)]
    fn load_doubles(token: V::Token, numbers: &[f64]) -> Self {
        Self(V::load_doubles(token, numbers), V::load_doubles(token, &numbers[V::COUNT..]))
    }

    #[inline(always)]
    fn bits(mask: Self::Mask) -> u32 {
        V::bits(mask.0) | (V::bits(mask.1) << V::COUNT)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0), self.1.min(other.1))
    }

    #[inline(always)]
    #[expect(clippy::cast_precision_loss, reason = "a vector is short")]
    fn counted(token: V::Token, first: f64) -> Self {
        Self(V::counted(token, first), V::counted(token, first + V::COUNT as f64))
    }

    #[inline(always)]
    fn store(self, out: &mut [V::Element]) {
        self.0.store(out);
        self.1.store(&mut out[V::COUNT..]);
    }

    #[inline(always)]
    fn product_rest(self, factor: Self, product: Self) -> Self {
        Self(self.0.product_rest(factor.0, product.0), self.1.product_rest(factor.1, product.1))
    }

    #[inline(always)]
    fn split(self) -> [Self; 2] {
        let ([low, low_exponent], [high, high_exponent]) = (self.0.split(), self.1.split());
        [Self(low, high), Self(low_exponent, high_exponent)]
    }

    #[inline(always)]
    fn scale(self, shifted: Self) -> Self {
        Self(self.0.scale(shifted.0), self.1.scale(shifted.1))
    }

    const WHOLE: f64 = V::WHOLE;
}
