//! How far can rounding have carried a formula?
//!
//! Run over [`Bounded`] a formula yields a bound on its size and on its rounding errors, for all inputs below given sizes: each sum and product adds
//! sizes as if all signs agreed and counts the roundings on the way. Cheaper and coarser than [`super::Interval`].
//!
//! Source: Higham 2002, section 3.1.

use std::ops::{Add, Mul, Neg, Sub};

use super::Ring;

/// The size of a number, and how often it was rounded.
///
/// A number `x` of modulus at most `size`, computed in `f64` by the formula, misses its exact value by no more than `((1+u)^roundings - 1)·size`,
/// `u = 2^-53`, unless something underflows or overflows on the way.
///
/// ```
/// use assur::algebra::Bounded;
/// let (x, y) = (Bounded::given(3.0), Bounded::rounded(4.0));
/// // x² - y: two roundings more than y's one.
/// let bound = x * x - y;
/// assert_eq!((bound.size(), bound.roundings()), (13.0, 2));
/// assert!(bound.error() < 3e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounded {
    size: f64,
    roundings: u32,
}

/// Covers the rounding of the sizes themselves, and of the bound: formulas have fewer than a thousand operations.
const MARGIN: f64 = 1.0 + 1e-9;

impl Bounded {
    /// A number of at most this modulus, not rounded.
    #[inline(always)]
    pub fn given(x: f64) -> Self {
        Self { size: x.abs(), roundings: 0 }
    }

    /// A number of about this modulus, rounded once.
    #[inline(always)]
    pub fn rounded(x: f64) -> Self {
        Self { size: x.abs(), roundings: 1 }
    }

    /// A number of about this modulus after several roundings.
    #[inline(always)]
    pub fn rounded_times(x: f64, roundings: u32) -> Self {
        Self { size: x.abs(), roundings }
    }

    /// A bound on the modulus, itself computed with a relative error below `1e-9`.
    pub fn size(self) -> f64 {
        self.size
    }

    /// How many roundings of relative size `u` lie on the longest way to the number.
    pub fn roundings(self) -> u32 {
        self.roundings
    }

    /// A bound on the error of the computed number.
    #[inline(always)]
    pub fn error(self) -> f64 {
        // (1+u)^n - 1 < n u (1 + 1e-9) for n below a million.
        f64::from(self.roundings) * (0.5 * f64::EPSILON) * self.size * (MARGIN * MARGIN)
    }
}

impl Add for Bounded {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { size: self.size + other.size, roundings: self.roundings.max(other.roundings) + 1 }
    }
}

impl Sub for Bounded {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.add(other)
    }
}

impl Mul for Bounded {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { size: self.size * other.size, roundings: self.roundings + other.roundings + 1 }
    }
}

impl Neg for Bounded {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self
    }
}

impl Ring for Bounded {
    #[inline(always)]
    fn from_int(n: i64) -> Self {
        // Small integers are exact.
        Self::given(n as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{Rational, dyadic};
    use proptest::prelude::*;

    fn formula<R: Ring>(x: R, y: R, z: R) -> R {
        let two = R::from_int(2);
        let difference = x.clone() * x.clone() - two * y.clone() * z.clone();
        difference.clone() * difference + y * (z - x)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn the_exact_value_is_within_the_bound(x in -3.0..3.0f64, y in -3.0..3.0f64, z in -3.0..3.0f64) {
            let number = |x: f64| dyadic(x).expect("finite");
            let exact: Rational = formula(number(x), number(y), number(z));
            let miss = number(formula(x, y, z)) - exact.clone();
            let bound = formula(Bounded::given(x), Bounded::given(y), Bounded::given(z));
            let error = number(bound.error());
            prop_assert!(miss <= error && -miss <= error);
            prop_assert!(exact.clone() <= number(bound.size() * 1.000001) && -exact <= number(bound.size() * 1.000001));
        }
    }
}
