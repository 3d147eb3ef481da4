//! `f64` twice over: a sum of two numbers with some 106 bits, for the last digits of a residual.
//!
//! A sum or product of two `f64` and its rounding error are two `f64`; keeping both costs some twenty operations. Not a full
//! arithmetic: no division, no care for overflow beyond `1e290`, and the last few bits of a result may be wrong.
//!
//! Source: Dekker (1971), A floating-point technique for extending the available precision, Numer. Math. 18, 224-242, doi:10.1007/BF01397083.

use std::ops::{Add, Mul, Neg, Sub};

use super::Ring;

/// `high + low`, `low` below half the last bit of `high`.
///
/// ```
/// use assur::algebra::Twice;
/// let third = Twice::from(1.0 / 3.0);
/// // What 1/3 misses in f64.
/// let rest = third * Twice::from(3.0) - Twice::from(1.0);
/// assert_eq!(rest.high(), -(2f64.powi(-54)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twice {
    high: f64,
    low: f64,
}

impl Twice {
    /// The number rounded to `f64`.
    #[inline]
    pub fn high(self) -> f64 {
        self.high
    }

    /// The sum of two numbers of which the first is larger.
    #[inline]
    fn ordered(high: f64, low: f64) -> Self {
        let sum = high + low;
        Self { high: sum, low: low - (sum - high) }
    }
}

impl From<f64> for Twice {
    #[inline]
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Add for Twice {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let sum = self.high + other.high;
        let part = sum - self.high;
        let error = (self.high - (sum - part)) + (other.high - part);
        Self::ordered(sum, error + (self.low + other.low))
    }
}

impl Sub for Twice {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Twice {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Mul for Twice {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        /// `2^27 + 1`: cuts a number into two of 26 bits, whose products are exact.
        const CUT: f64 = 134_217_729.0;
        let halves = |x: f64| {
            let upper = CUT * x - (CUT * x - x);
            (upper, x - upper)
        };
        let product = self.high * other.high;
        let ((a, b), (c, d)) = (halves(self.high), halves(other.high));
        let error = ((a * c - product) + a * d + b * c) + b * d;
        Self::ordered(product, error + (self.high * other.low + self.low * other.high))
    }
}

impl Ring for Twice {
    fn from_int(n: i64) -> Self {
        // Halves of 32 bits are exact.
        let upper = (n >> 32) as f64 * 4_294_967_296.0;
        Self::from(upper) + Self::from((n & 0xffff_ffff) as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{Rational, dyadic};

    #[test]
    fn sums_and_products_keep_a_hundred_bits() {
        let exact = |x: Twice| dyadic(x.high).expect("finite") + dyadic(x.low).expect("finite");
        let mut state = 1u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        let bound = dyadic(2f64.powi(-100)).expect("finite");
        for _ in 0..1000 {
            let [a, b] = [0, 1].map(|_| Twice::from(next()) + Twice::from(next() * 1e-17));
            for (found, truth) in [(a + b, exact(a) + exact(b)), (a * b, exact(a) * exact(b))] {
                let error = exact(found) - truth;
                let size = if error < Rational::from_int(0) { -error } else { error };
                assert!(size < bound, "{a:?} {b:?}");
            }
        }
        assert_eq!(exact(Twice::from_int(i64::MAX)), Rational::from_int(i64::MAX));
        assert_eq!(exact(Twice::from_int(-3)), Rational::from_int(-3));
    }
}
