//! Several floats at once.
//!
//! The same formula over many angles or many roots is the same work in every place of an array; compilers turn such loops into SIMD
//! instructions where the processor has them, if everything is inlined: hence plain loops, and `inline(always)`. [`Lanes`] is a [`Ring`], so that a formula written once runs over it as over one number.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Ring;

/// `N` numbers, added and multiplied each on its own.
///
/// ```
/// use assur::algebra::{Lanes, Ring};
/// let x = Lanes([1.0, 2.0, 3.0, 4.0]);
/// assert_eq!(x * x - Lanes::from_int(1), Lanes([0.0, 3.0, 8.0, 15.0]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(32))]
pub struct Lanes<const N: usize>(pub [f64; N]);

impl<const N: usize> Lanes<N> {
    /// The same number in every lane.
    #[inline(always)]
    pub fn all(x: f64) -> Self {
        Self([x; N])
    }

    /// `f` of two, lane by lane.
    #[inline(always)]
    pub fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut out = self.0;
        for (x, y) in out.iter_mut().zip(other.0) {
            *x = f(*x, y);
        }
        Self(out)
    }

    /// `f`, lane by lane.
    #[inline(always)]
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut out = self.0;
        for x in &mut out {
            *x = f(*x);
        }
        Self(out)
    }
}

impl<const N: usize> Add for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |x, y| x + y)
    }
}

impl<const N: usize> Sub for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |x, y| x - y)
    }
}

impl<const N: usize> Mul for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |x, y| x * y)
    }
}

impl<const N: usize> Div for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |x, y| x / y)
    }
}

impl<const N: usize> Neg for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|x| -x)
    }
}

impl<const N: usize> Ring for Lanes<N> {
    #[inline(always)]
    fn from_int(n: i64) -> Self {
        Self::all(n as f64)
    }
}
