//! Trigonometric polynomials of order up to four, without allocation.
//!
//! The same ring as [`super::Trig`], `A(c) + s·B(c)`, for formulas that are expanded a million times: coefficients lie in arrays. It is what the fast
//! count of real roots expands its polynomial in, over [`super::Interval`]s.

use std::ops::{Add, Mul, Neg, Sub};

use super::Ring;

/// The largest order held.
pub const SHORT_ORDER: usize = 4;

/// `A(cos phi) + sin phi · B(cos phi)` of order at most 4.
///
/// Products beyond order 4 panic: the formulas it is made for have none.
///
/// ```
/// use assur::algebra::{Ring, ShortTrig};
/// let (c, s) = (ShortTrig::<f64>::cosine(), ShortTrig::sine());
/// assert_eq!((c.clone() * c + s.clone() * s).even(), &[1.0, 0.0, 0.0, 0.0, 0.0]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ShortTrig<R> {
    even: [R; SHORT_ORDER + 1],
    odd: [R; SHORT_ORDER],
    /// Coefficients beyond this order are zero.
    order: usize,
}

impl<R: Ring + Copy> ShortTrig<R> {
    /// A constant.
    pub fn constant(value: R) -> Self {
        let mut even = [R::zero(); SHORT_ORDER + 1];
        even[0] = value;
        Self { even, odd: [R::zero(); SHORT_ORDER], order: 0 }
    }

    /// `cos phi`.
    pub fn cosine() -> Self {
        let mut out = Self::constant(R::zero());
        out.even[1] = R::one();
        Self { order: 1, ..out }
    }

    /// `sin phi`.
    pub fn sine() -> Self {
        let mut out = Self::constant(R::zero());
        out.odd[0] = R::one();
        Self { order: 1, ..out }
    }

    /// Coefficients of `1, c, c², c³, c⁴`.
    pub fn even(&self) -> &[R; SHORT_ORDER + 1] {
        &self.even
    }

    /// Coefficients of `s, s·c, s·c², s·c³`.
    pub fn odd(&self) -> &[R; SHORT_ORDER] {
        &self.odd
    }
}

impl<R: Ring + Copy> Add for ShortTrig<R> {
    type Output = Self;
    fn add(mut self, other: Self) -> Self {
        for k in 0..=other.order {
            self.even[k] = self.even[k] + other.even[k];
        }
        for k in 0..other.order {
            self.odd[k] = self.odd[k] + other.odd[k];
        }
        self.order = self.order.max(other.order);
        self
    }
}

impl<R: Ring + Copy> Sub for ShortTrig<R> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<R: Ring + Copy> Mul for ShortTrig<R> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (p, q) = (self.order, other.order);
        let mut out = Self { order: p + q, ..Self::constant(R::zero()) };
        assert!(p + q <= SHORT_ORDER, "a product of order {} does not fit", p + q);
        for i in 0..=p {
            for j in 0..=q {
                out.even[i + j] = out.even[i + j] + self.even[i] * other.even[j];
            }
            for j in 0..q {
                out.odd[i + j] = out.odd[i + j] + self.even[i] * other.odd[j];
            }
        }
        for i in 0..p {
            for j in 0..=q {
                out.odd[i + j] = out.odd[i + j] + self.odd[i] * other.even[j];
            }
            for j in 0..q {
                // s² = 1 - c²
                let product = self.odd[i] * other.odd[j];
                out.even[i + j] = out.even[i + j] + product;
                out.even[i + j + 2] = out.even[i + j + 2] - product;
            }
        }
        out
    }
}

impl<R: Ring + Copy> Neg for ShortTrig<R> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { even: self.even.map(Neg::neg), odd: self.odd.map(Neg::neg), order: self.order }
    }
}

impl<R: Ring + Copy> Ring for ShortTrig<R> {
    fn from_int(n: i64) -> Self {
        Self::constant(R::from_int(n))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Trig;

    #[test]
    fn products_agree_with_those_of_any_order() {
        let numbers = [3.0, -2.0, 5.0, 7.0, -11.0, 13.0];
        let short = |k: usize| {
            ShortTrig::constant(numbers[k])
                + ShortTrig::constant(numbers[k + 1]) * ShortTrig::cosine()
                + ShortTrig::constant(numbers[k + 2]) * ShortTrig::sine()
        };
        let long = |k: usize| {
            Trig::constant(numbers[k])
                + Trig::constant(numbers[k + 1]) * Trig::cosine()
                + Trig::constant(numbers[k + 2]) * Trig::sine()
        };
        let (f, g) = (short(0) * short(1) - short(2), long(0) * long(1) - long(2));
        let (f, g) = (f.clone() * f, g.clone() * g);
        let coefficients: Vec<f64> = f.even().iter().chain(f.odd()).copied().collect();
        assert_eq!(coefficients, g.coefficients().copied().collect::<Vec<f64>>());
    }
}
