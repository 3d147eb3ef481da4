//! What can a number do? Two traits carry the crate.
//!
//! A [`Ring`] adds, subtracts and multiplies; a closed formula is written once over `R: Ring` and run
//! over floats for speed, over rationals for truth and over polynomials to check the formula itself.
//! A [`Domain`] also knows exactly when a number is zero and divides exactly; elimination asks for
//! that, and floats do not offer it.

use std::fmt::Debug;
use std::ops::{Add, Mul, Neg, Sub};

use num_complex::Complex64;

use super::rational::{Integer, Rational};

/// Numbers that can be added, subtracted and multiplied.
///
/// ```
/// use assur::algebra::{Rational, Ring};
/// fn square_of_sum<R: Ring>(a: R, b: R) -> R {
///     let sum = a + b;
///     sum.clone() * sum
/// }
/// assert_eq!(square_of_sum(1.5, 0.5), 4.0);
/// assert_eq!(square_of_sum(Rational::from_int(1), Rational::from_int(2)), Rational::from_int(9));
/// ```
pub trait Ring:
    Clone + PartialEq + Debug + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// The integer `n` in this ring.
    fn from_int(n: i64) -> Self;

    /// Zero.
    fn zero() -> Self {
        Self::from_int(0)
    }

    /// One.
    fn one() -> Self {
        Self::from_int(1)
    }

    /// `self` to the power `n`; `n = 0` gives one.
    fn power(&self, n: u32) -> Self {
        (0..n).fold(Self::one(), |product, _| product * self.clone())
    }
}

/// A ring without zero divisors in which equality with zero and divisibility are decided exactly.
///
/// ```
/// use assur::algebra::{Domain, Integer};
/// let (six, two, four) = (Integer::from(6), Integer::from(2), Integer::from(4));
/// assert_eq!(six.exact_div(&two), Some(Integer::from(3)));
/// assert_eq!(six.exact_div(&four), None);
/// ```
pub trait Domain: Ring {
    /// Whether this number is exactly zero.
    fn is_zero(&self) -> bool;

    /// The quotient `self / divisor` where it exists in the domain, `None` otherwise (also for a zero divisor).
    fn exact_div(&self, divisor: &Self) -> Option<Self>;
}

impl Ring for f64 {
    fn from_int(n: i64) -> Self {
        n as f64
    }
}

impl Ring for Complex64 {
    fn from_int(n: i64) -> Self {
        Complex64::new(n as f64, 0.0)
    }
}

impl Ring for Integer {
    fn from_int(n: i64) -> Self {
        Integer::from(n)
    }
}

impl Domain for Integer {
    fn is_zero(&self) -> bool {
        Integer::is_zero(self)
    }

    fn exact_div(&self, divisor: &Self) -> Option<Self> {
        use dashu_int::ops::DivRem;
        if Integer::is_zero(divisor) {
            return None;
        }
        let (quotient, rest) = self.div_rem(divisor);
        Integer::is_zero(&rest).then_some(quotient)
    }
}

impl Ring for Rational {
    fn from_int(n: i64) -> Self {
        Rational::from(n)
    }
}

impl Domain for Rational {
    fn is_zero(&self) -> bool {
        Rational::is_zero(self)
    }

    fn exact_div(&self, divisor: &Self) -> Option<Self> {
        (!Rational::is_zero(divisor)).then(|| self / divisor)
    }
}
