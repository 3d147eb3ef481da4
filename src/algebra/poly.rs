//! Polynomials in many variables over a ring, sparse.
//!
//! Terms are kept in a map from [`Monomial`] to coefficient, in lexicographic order, without zero
//! coefficients where the ring can tell (`Domain`). Variables are numbers here; names live in
//! [`crate::solve::System`].

use std::collections::BTreeMap;
use std::ops::{Add, Mul, Neg, Sub};

use super::{Domain, Monomial, Ring, UPoly};

/// A polynomial in many variables.
///
/// ```
/// use assur::algebra::{Poly, Rational, Ring};
/// let [x, y] = [0, 1].map(Poly::<Rational>::variable);
/// let product = (x.clone() + y.clone()) * (x.clone() - y.clone());
/// assert_eq!(product, x.power(2) - y.power(2));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Poly<R> {
    terms: BTreeMap<Monomial, R>,
}

impl<R: Ring> Poly<R> {
    /// A constant.
    pub fn constant(value: R) -> Self {
        Self::term(value, Monomial::default())
    }

    /// `coefficient · monomial`.
    pub fn term(coefficient: R, monomial: Monomial) -> Self {
        let mut terms = BTreeMap::new();
        if coefficient != R::zero() {
            terms.insert(monomial, coefficient);
        }
        Self { terms }
    }

    /// The variable with this number.
    pub fn variable(number: usize) -> Self {
        Self::term(R::one(), Monomial::variable(number))
    }

    /// The terms, lexicographically ascending.
    pub fn terms(&self) -> impl DoubleEndedIterator<Item = (&Monomial, &R)> {
        self.terms.iter()
    }

    /// How many terms there are.
    pub fn term_count(&self) -> usize {
        self.terms.len()
    }

    /// Whether no term is left.
    pub fn vanishes(&self) -> bool {
        self.terms.is_empty()
    }

    /// The degree in one variable; 0 for the zero polynomial.
    pub fn degree_in(&self, variable: usize) -> u32 {
        self.terms.keys().map(|m| m.exponent(variable)).max().unwrap_or(0)
    }

    /// The largest sum of exponents; 0 for the zero polynomial.
    pub fn total_degree(&self) -> u32 {
        self.terms.keys().map(Monomial::total_degree).max().unwrap_or(0)
    }

    /// The coefficients of `1, v, v², …` for one variable `v`, polynomials in the others; length degree + 1 (0 if zero).
    pub fn coefficients_in(&self, variable: usize) -> Vec<Self> {
        if self.terms.is_empty() {
            return Vec::new();
        }
        let mut out = vec![Self { terms: BTreeMap::new() }; self.degree_in(variable) as usize + 1];
        for (monomial, coefficient) in &self.terms {
            let power = monomial.exponent(variable) as usize;
            out[power].terms.insert(monomial.with_exponent(variable, 0), coefficient.clone());
        }
        out
    }

    /// The polynomial over another ring.
    pub fn map<S: Ring>(&self, f: impl Fn(&R) -> S) -> Poly<S> {
        let mut terms = BTreeMap::new();
        for (monomial, coefficient) in &self.terms {
            let image = f(coefficient);
            if image != S::zero() {
                terms.insert(monomial.clone(), image);
            }
        }
        Poly { terms }
    }

    /// The value where variable `v` is `values[v]`, in any ring that the coefficients embed into.
    ///
    /// Panics if a variable occurs that `values` does not give.
    pub fn evaluate<S: Ring>(&self, embed: impl Fn(&R) -> S, values: &[S]) -> S {
        self.terms.iter().fold(S::zero(), |sum, (monomial, coefficient)| {
            let term = monomial
                .exponents()
                .iter()
                .enumerate()
                .filter(|&(_, &e)| e > 0)
                .fold(embed(coefficient), |product, (v, &e)| product * values[v].power(e));
            sum + term
        })
    }

    /// The polynomial with one variable replaced by a polynomial.
    pub fn substitute(&self, variable: usize, value: &Self) -> Self {
        // Horner in the variable: one product per power.
        self.coefficients_in(variable)
            .into_iter()
            .rev()
            .fold(Self::zero(), |sum, coefficient| sum * value.clone() + coefficient)
    }

    /// The partial derivative by one variable.
    pub fn derivative(&self, variable: usize) -> Self {
        let mut out = Self::zero();
        for (monomial, coefficient) in &self.terms {
            let power = monomial.exponent(variable);
            if power > 0 {
                let scaled = coefficient.clone() * R::from_int(i64::from(power));
                out.add_term(monomial.with_exponent(variable, power - 1), scaled);
            }
        }
        out
    }

    /// The same polynomial seen in one variable, `None` where another variable occurs.
    pub fn univariate(&self, variable: usize) -> Option<UPoly<R>> {
        let mut coefficients = vec![R::zero(); self.degree_in(variable) as usize + 1];
        for (monomial, coefficient) in &self.terms {
            if monomial.total_degree() != monomial.exponent(variable) {
                return None;
            }
            coefficients[monomial.exponent(variable) as usize] = coefficient.clone();
        }
        Some(UPoly::new(coefficients))
    }

    fn add_term(&mut self, monomial: Monomial, coefficient: R) {
        let sum = match self.terms.remove(&monomial) {
            Some(present) => present + coefficient,
            None => coefficient,
        };
        if sum != R::zero() {
            self.terms.insert(monomial, sum);
        }
    }
}

impl<R: Ring> Add for Poly<R> {
    type Output = Self;
    fn add(mut self, other: Self) -> Self {
        for (monomial, coefficient) in other.terms {
            self.add_term(monomial, coefficient);
        }
        self
    }
}

impl<R: Ring> Sub for Poly<R> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<R: Ring> Mul for Poly<R> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let mut out = Self { terms: BTreeMap::new() };
        for (m, a) in &self.terms {
            for (n, b) in &other.terms {
                out.add_term(m * n, a.clone() * b.clone());
            }
        }
        out
    }
}

impl<R: Ring> Neg for Poly<R> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { terms: self.terms.into_iter().map(|(m, c)| (m, -c)).collect() }
    }
}

impl<R: Ring> Ring for Poly<R> {
    fn from_int(n: i64) -> Self {
        Self::constant(R::from_int(n))
    }
}

impl<R: Domain> Domain for Poly<R> {
    fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// Long division by the leading term; exact or `None`.
    fn exact_div(&self, divisor: &Self) -> Option<Self> {
        let (lead_monomial, lead) = divisor.terms.last_key_value()?;
        let mut rest = self.clone();
        let mut quotient = Self::zero();
        while let Some((monomial, coefficient)) = rest.terms.last_key_value() {
            let m = monomial.exact_div(lead_monomial)?;
            let c = coefficient.exact_div(lead)?;
            for (n, d) in &divisor.terms {
                rest.add_term(&m * n, -(c.clone() * d.clone()));
            }
            quotient.terms.insert(m, c);
        }
        Some(quotient)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Integer;

    fn xyz() -> [Poly<Integer>; 3] {
        [0, 1, 2].map(Poly::variable)
    }

    #[test]
    fn exact_division_undoes_multiplication_and_refuses_a_rest() {
        let [x, y, z] = xyz();
        let f = x.clone() * y.clone() + z.power(3) - Poly::from_int(7);
        let g = x.power(2) - y.clone() * z.clone() + Poly::from_int(2);
        assert_eq!((f.clone() * g.clone()).exact_div(&g), Some(f.clone()));
        assert_eq!((f.clone() * g.clone() + Poly::one()).exact_div(&g), None);
        assert_eq!(f.exact_div(&Poly::zero()), None);
    }

    #[test]
    fn substitution_agrees_with_evaluation() {
        let [x, y, _] = xyz();
        let f = x.power(3) * y.clone() - x.clone() * y.power(2) + Poly::from_int(5);
        let g = f.substitute(0, &(y.clone() + Poly::from_int(1)));
        let at = |p: &Poly<Integer>, v: [i64; 2]| p.evaluate(Clone::clone, &v.map(Integer::from));
        for y in -3..4 {
            assert_eq!(at(&g, [99, y]), at(&f, [y + 1, y]));
        }
    }

    #[test]
    fn derivative_obeys_the_product_rule() {
        let [x, y, z] = xyz();
        let f = x.power(2) * y.clone() + z.clone();
        let g = x.clone() * z.power(2) - y.clone();
        let both = (f.clone() * g.clone()).derivative(0);
        assert_eq!(both, f.derivative(0) * g.clone() + f * g.derivative(0));
    }
}
