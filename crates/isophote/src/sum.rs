//! Sums without loss of accuracy.

use crate::real::Real;
use crate::scalar::Scalar;

/// A sum that keeps the digits that plain addition would lose (Neumaier's form of Kahan summation, with Knuth's branch-free
/// exact addition). The error of n terms of one sign is that of a single rounding, whatever n is.
#[derive(Clone, Copy)]
pub struct Sum<T> {
    total: T,
    lost: T,
}

impl<T: Scalar> Sum<T> {
    /// An empty sum.
    #[must_use]
    #[inline(always)]
    pub fn new() -> Self {
        Self::starting_at(T::zero())
    }
}

impl<T: Real> Sum<T> {
    /// An empty sum, from a zero of the right type.
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
}
