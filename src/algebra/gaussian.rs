//! Complex numbers over any ring: `re + i·im`.
//!
//! Planar points and rotations are complex numbers; over the integers they are Gaussian integers and
//! exact. `num_complex::Complex` asks more of its parts than rings of polynomials offer, hence this type.

use std::ops::{Add, Mul, Neg, Sub};

use super::{Domain, Ring};

/// `re + i·im` over the ring `R`.
///
/// ```
/// use assur::algebra::Gaussian;
/// let z = Gaussian::new(3, 4).map(|&x| f64::from(x));
/// assert_eq!(z.clone() * z.conj(), Gaussian::new(25.0, 0.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gaussian<R> {
    /// Real part.
    pub re: R,
    /// Imaginary part.
    pub im: R,
}

impl<R> Gaussian<R> {
    /// `re + i·im`.
    #[inline(always)]
    pub fn new(re: R, im: R) -> Self {
        Self { re, im }
    }

    /// The same number over another ring.
    #[inline(always)]
    pub fn map<S>(&self, f: impl Fn(&R) -> S) -> Gaussian<S> {
        Gaussian { re: f(&self.re), im: f(&self.im) }
    }
}

impl<R: Ring> Gaussian<R> {
    /// The real number `re`.
    #[inline(always)]
    pub fn real(re: R) -> Self {
        Self { re, im: R::zero() }
    }

    /// The conjugate `re - i·im`.
    #[inline(always)]
    pub fn conj(&self) -> Self {
        Self { re: self.re.clone(), im: -self.im.clone() }
    }

    /// The number turned by a quarter: `i·self`.
    #[inline(always)]
    pub fn turned(&self) -> Self {
        Self { re: -self.im.clone(), im: self.re.clone() }
    }

    /// `|self|²`, a number of `R`.
    #[inline(always)]
    pub fn norm_sqr(&self) -> R {
        self.re.clone() * self.re.clone() + self.im.clone() * self.im.clone()
    }

    /// The dot product `re·re' + im·im'` of the two as plane vectors.
    #[inline(always)]
    pub fn dot(&self, other: &Self) -> R {
        self.re.clone() * other.re.clone() + self.im.clone() * other.im.clone()
    }

    /// The cross product `re·im' - im·re'` of the two as plane vectors.
    #[inline(always)]
    pub fn cross(&self, other: &Self) -> R {
        self.re.clone() * other.im.clone() - self.im.clone() * other.re.clone()
    }

    /// Every part multiplied by `factor`.
    #[inline(always)]
    pub fn scaled(&self, factor: &R) -> Self {
        self.map(|x| x.clone() * factor.clone())
    }
}

impl<R: Ring> Add for Gaussian<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl<R: Ring> Sub for Gaussian<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl<R: Ring> Mul for Gaussian<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            re: self.re.clone() * other.re.clone() - self.im.clone() * other.im.clone(),
            im: self.re * other.im + self.im * other.re,
        }
    }
}

impl<R: Ring> Neg for Gaussian<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { re: -self.re, im: -self.im }
    }
}

impl<R: Ring> Ring for Gaussian<R> {
    #[inline(always)]
    fn from_int(n: i64) -> Self {
        Self::real(R::from_int(n))
    }
}

impl<R: Domain> Domain for Gaussian<R> {
    #[inline(always)]
    fn is_zero(&self) -> bool {
        self.re.is_zero() && self.im.is_zero()
    }

    #[inline(always)]
    fn exact_div(&self, divisor: &Self) -> Option<Self> {
        if divisor.im.is_zero() {
            return Some(Self { re: self.re.exact_div(&divisor.re)?, im: self.im.exact_div(&divisor.re)? });
        }
        let norm = divisor.norm_sqr();
        let product = self.clone() * divisor.conj();
        Some(Self { re: product.re.exact_div(&norm)?, im: product.im.exact_div(&norm)? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Integer;

    fn g(re: i64, im: i64) -> Gaussian<Integer> {
        Gaussian::new(re.into(), im.into())
    }

    #[test]
    fn division_undoes_multiplication_and_refuses_a_rest() {
        assert_eq!((g(3, -2) * g(5, 7)).exact_div(&g(5, 7)), Some(g(3, -2)));
        assert_eq!(g(1, 0).exact_div(&g(1, 1)), None);
        assert_eq!(g(1, 0).exact_div(&g(0, 0)), None);
    }

    #[test]
    fn dot_and_cross_are_the_parts_of_conj_a_times_b() {
        let (a, b) = (g(2, 3), g(-1, 4));
        assert_eq!(a.conj() * b.clone(), Gaussian::new(a.dot(&b), a.cross(&b)));
        assert_eq!(a.turned(), g(0, 1) * a);
    }
}
