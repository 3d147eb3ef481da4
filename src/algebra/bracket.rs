//! Intervals with integer ends: arithmetic on sets of numbers without any rounding.
//!
//! Where `f64` has too few digits, numbers are scaled by a power of two until integers hold what is to be told apart. Sums and products of
//! integers are exact, so a [`Bracket`] grows only by what its arguments do not say. Its only source is [`super::Interval`]'s theory.

use std::ops::{Add, Mul, Neg, Sub};

use dashu_int::UBig;
use dashu_int::ops::{BitTest, SquareRootRem};

use super::{Integer, Interval, Ring};

/// The real numbers from `low` to `high`, both integers.
///
/// ```
/// use assur::algebra::{Bracket, Integer};
/// let two_to_three = Bracket::new(2.into(), 3.into());
/// assert_eq!(two_to_three.clone() - two_to_three, Bracket::new(Integer::from(-1), 1.into()));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bracket {
    low: Integer,
    high: Integer,
}

impl Bracket {
    /// The numbers between two integers, in either order.
    pub fn new(a: Integer, b: Integer) -> Self {
        if a <= b { Self { low: a, high: b } } else { Self { low: b, high: a } }
    }

    /// One integer alone.
    pub fn point(n: Integer) -> Self {
        Self { low: n.clone(), high: n }
    }

    /// Whether zero is among the numbers.
    pub fn contains_zero(&self) -> bool {
        self.low <= Integer::ZERO && self.high >= Integer::ZERO
    }

    /// The smallest interval in `f64` around the numbers times `2^exponent`.
    pub fn to_interval(&self, exponent: i64) -> Interval {
        Interval::of_integer(&self.low, exponent).hull(Interval::of_integer(&self.high, exponent))
    }

    /// The square roots of the numbers that are not negative; `None` where all are negative.
    pub fn sqrt(&self) -> Option<Self> {
        let root = |n: &Integer| UBig::try_from(n.clone()).ok().map(|n| n.sqrt_rem());
        let (high, rest) = root(&self.high)?;
        let low = root(&self.low).map_or(UBig::ZERO, |(root, _)| root);
        let high = if rest.is_zero() { high } else { high + UBig::ONE };
        Some(Self { low: low.into(), high: high.into() })
    }

    /// Bits of the end furthest from zero.
    pub fn bits(&self) -> usize {
        self.low.bit_len().max(self.high.bit_len())
    }

    fn is_point(&self) -> bool {
        self.low == self.high
    }
}

impl Add for Bracket {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { low: self.low + other.low, high: self.high + other.high }
    }
}

impl Sub for Bracket {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { low: self.low - other.high, high: self.high - other.low }
    }
}

impl Neg for Bracket {
    type Output = Self;
    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl Mul for Bracket {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        if self.is_point() {
            return Self::new(&self.low * other.low, self.low * other.high);
        }
        if other.is_point() {
            return other * self;
        }
        let pair = |end: &Integer| Self::new(end * &other.low, end * &other.high);
        let (p, q) = (pair(&self.low), pair(&self.high));
        Self { low: p.low.min(q.low), high: p.high.max(q.high) }
    }
}

impl Ring for Bracket {
    fn from_int(n: i64) -> Self {
        Self::point(n.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn bracket() -> impl Strategy<Value = (Bracket, i64)> {
        (-40i64..40, 0i64..9, 0i64..9)
            .prop_map(|(low, up, down)| (Bracket::new((low - down).into(), (low + up).into()), low))
    }

    proptest! {
        #[test]
        fn every_operation_holds_the_exact_result((x, a) in bracket(), (y, b) in bracket()) {
            let holds = |bracket: &Bracket, n: i64| bracket.low <= Integer::from(n) && Integer::from(n) <= bracket.high;
            prop_assert!(holds(&(x.clone() + y.clone()), a + b));
            prop_assert!(holds(&(x.clone() - y.clone()), a - b));
            prop_assert!(holds(&(x.clone() * y.clone()), a * b));
            prop_assert!(holds(&-x.clone(), -a));
            match x.sqrt() {
                Some(root) if a >= 0 => {
                    prop_assert!(root.low.clone() * root.low.clone() <= Integer::from(a));
                    prop_assert!(root.high.clone() * root.high >= Integer::from(a));
                }
                Some(_) => {}
                None => prop_assert!(x.high < Integer::ZERO),
            }
        }
    }

    #[test]
    fn large_numbers_become_tight_intervals() {
        let n = (Integer::from(3) << 2000) + Integer::ONE;
        let interval = Bracket::point(n).to_interval(-2000);
        assert!(interval.contains(3.0) && interval.width() < 1e-15);
    }
}
