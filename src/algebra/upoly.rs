//! Polynomials in one variable, dense.
//!
//! Coefficients ascend. Over a [`Domain`] there is pseudo-division, the greatest common divisor by the
//! primitive remainder sequence, and Yun's square-free decomposition, all exact.

use std::ops::{Add, Mul, Neg, Sub};

use super::{Domain, Ring};

/// A polynomial in one variable: `coefficients[k]` belongs to the `k`-th power.
///
/// The leading coefficient is never zero; the zero polynomial has no coefficient.
///
/// ```
/// use assur::algebra::{Ring, UPoly};
/// let p = UPoly::new(vec![-2.0, 0.0, 1.0]); // x² - 2
/// assert_eq!(p.degree(), Some(2));
/// assert_eq!(p.evaluate(&3.0), 7.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct UPoly<R> {
    coefficients: Vec<R>,
}

impl<R: Ring> UPoly<R> {
    /// The polynomial with these coefficients, ascending; zeros at the top are dropped.
    pub fn new(mut coefficients: Vec<R>) -> Self {
        while coefficients.last().is_some_and(|c| *c == R::zero()) {
            coefficients.pop();
        }
        Self { coefficients }
    }

    /// A constant.
    pub fn constant(value: R) -> Self {
        Self::new(vec![value])
    }

    /// The variable itself.
    pub fn variable() -> Self {
        Self::new(vec![R::zero(), R::one()])
    }

    /// The coefficients, ascending.
    pub fn coefficients(&self) -> &[R] {
        &self.coefficients
    }

    /// The coefficient of the `k`-th power, zero beyond the degree.
    pub fn coefficient(&self, k: usize) -> R {
        self.coefficients.get(k).cloned().unwrap_or_else(R::zero)
    }

    /// The degree, `None` for the zero polynomial.
    pub fn degree(&self) -> Option<usize> {
        self.coefficients.len().checked_sub(1)
    }

    /// The coefficient of the highest power, `None` for the zero polynomial.
    pub fn leading(&self) -> Option<&R> {
        self.coefficients.last()
    }

    /// Whether this is the zero polynomial.
    pub fn vanishes(&self) -> bool {
        self.coefficients.is_empty()
    }

    /// The value at `x`, by Horner's rule.
    pub fn evaluate(&self, x: &R) -> R {
        self.coefficients.iter().rev().fold(R::zero(), |sum, c| sum * x.clone() + c.clone())
    }

    /// The derivative.
    pub fn derivative(&self) -> Self {
        let terms = self.coefficients.iter().enumerate().skip(1);
        Self::new(terms.map(|(k, c)| c.clone() * R::from_int(k as i64)).collect())
    }

    /// The polynomial over another ring.
    pub fn map<S: Ring>(&self, f: impl Fn(&R) -> S) -> UPoly<S> {
        UPoly::new(self.coefficients.iter().map(f).collect())
    }

    /// `self · variable^n`.
    pub fn shifted(&self, n: usize) -> Self {
        if self.vanishes() {
            return self.clone();
        }
        let mut coefficients = vec![R::zero(); n];
        coefficients.extend(self.coefficients.iter().cloned());
        Self { coefficients }
    }

    /// Every coefficient multiplied by `factor`.
    pub fn scaled(&self, factor: &R) -> Self {
        Self::new(self.coefficients.iter().map(|c| c.clone() * factor.clone()).collect())
    }
}

impl<R: Domain> UPoly<R> {
    /// Every coefficient divided by `divisor`; `None` where one does not divide.
    pub fn divided_by_constant(&self, divisor: &R) -> Option<Self> {
        self.coefficients.iter().map(|c| c.exact_div(divisor)).collect::<Option<Vec<R>>>().map(Self::new)
    }

    /// The pseudo-remainder: `lead(divisor)^n · self` minus a multiple of the divisor, of lower degree than it.
    ///
    /// Panics if the divisor is zero.
    pub fn pseudo_remainder(&self, divisor: &Self) -> Self {
        let lead = divisor.leading().expect("a remainder needs a divisor that is not zero").clone();
        let degree = divisor.coefficients.len() - 1;
        let mut rest = self.coefficients.clone();
        while rest.len() > degree {
            let top = rest.pop().expect("longer than the divisor's degree");
            for c in &mut rest {
                *c = c.clone() * lead.clone();
            }
            let offset = rest.len() - degree;
            for (c, d) in rest[offset..].iter_mut().zip(&divisor.coefficients) {
                *c = c.clone() - top.clone() * d.clone();
            }
        }
        Self::new(rest)
    }
}

impl<R: Ring> Add for UPoly<R> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (mut long, short) =
            if self.coefficients.len() >= other.coefficients.len() { (self, other) } else { (other, self) };
        for (c, d) in long.coefficients.iter_mut().zip(short.coefficients) {
            *c = c.clone() + d;
        }
        Self::new(long.coefficients)
    }
}

impl<R: Ring> Sub for UPoly<R> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<R: Ring> Mul for UPoly<R> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        if self.vanishes() || other.vanishes() {
            return Self { coefficients: Vec::new() };
        }
        let mut out = vec![R::zero(); self.coefficients.len() + other.coefficients.len() - 1];
        for (i, a) in self.coefficients.iter().enumerate() {
            for (j, b) in other.coefficients.iter().enumerate() {
                out[i + j] = out[i + j].clone() + a.clone() * b.clone();
            }
        }
        Self::new(out)
    }
}

impl<R: Ring> Neg for UPoly<R> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { coefficients: self.coefficients.into_iter().map(|c| -c).collect() }
    }
}

impl<R: Ring> Ring for UPoly<R> {
    fn from_int(n: i64) -> Self {
        Self::constant(R::from_int(n))
    }
}

impl<R: Domain> Domain for UPoly<R> {
    fn is_zero(&self) -> bool {
        self.vanishes()
    }

    fn exact_div(&self, divisor: &Self) -> Option<Self> {
        let lead = divisor.leading()?;
        let degree = divisor.coefficients.len() - 1;
        let mut rest = self.coefficients.clone();
        let mut quotient = vec![R::zero(); (rest.len()).saturating_sub(degree)];
        while rest.len() > degree {
            let factor = rest.pop().expect("longer than the divisor's degree").exact_div(lead)?;
            let offset = rest.len() - degree;
            for (c, d) in rest[offset..].iter_mut().zip(&divisor.coefficients) {
                *c = c.clone() - factor.clone() * d.clone();
            }
            quotient[offset] = factor;
        }
        rest.iter().all(Domain::is_zero).then(|| Self::new(quotient))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Integer;

    fn p(coefficients: &[i64]) -> UPoly<Integer> {
        UPoly::new(coefficients.iter().map(|&c| Integer::from(c)).collect())
    }

    #[test]
    fn exact_division_undoes_multiplication_and_refuses_a_rest() {
        let (f, g) = (p(&[3, 0, -2, 5]), p(&[-1, 4, 2]));
        assert_eq!((f.clone() * g.clone()).exact_div(&g), Some(f.clone()));
        assert_eq!((f.clone() * g.clone() + p(&[0, 1])).exact_div(&g), None);
        assert_eq!(f.exact_div(&p(&[])), None);
        assert_eq!(p(&[]).exact_div(&f), Some(p(&[])));
    }

    #[test]
    fn pseudo_remainder_vanishes_exactly_on_multiples() {
        let (f, g) = (p(&[3, 0, -2, 5]), p(&[-1, 4, 2]));
        assert!((f.clone() * g.clone()).pseudo_remainder(&g).vanishes());
        assert!(!(f * g.clone() + p(&[1])).pseudo_remainder(&g).vanishes());
    }

    #[test]
    fn leading_zeros_are_dropped() {
        assert_eq!(p(&[1, 2]) - p(&[0, 2]), p(&[1]));
        assert_eq!((p(&[1, 2]) - p(&[1, 2])).degree(), None);
    }
}
