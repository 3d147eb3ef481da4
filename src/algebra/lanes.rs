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

/// What choosing between numbers needs: no branches, which lanes that differ would not foresee.
impl<const N: usize> Lanes<N> {
    /// The modulus.
    #[inline(always)]
    pub fn abs(self) -> Self {
        self.map(f64::abs)
    }

    /// The square root.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    /// The larger of two; of a number and NaN, `other`.
    #[inline(always)]
    pub fn larger(self, other: Self) -> Self {
        self.zip(other, |x, y| if x > y { x } else { y })
    }

    /// The smaller of two; of a number and NaN, `other`.
    #[inline(always)]
    pub fn smaller(self, other: Self) -> Self {
        self.zip(other, |x, y| if x < y { x } else { y })
    }

    /// `yes` where `self < bound`, else `no`; `no` where either is NaN.
    #[inline(always)]
    pub fn where_less(self, bound: Self, yes: Self, no: Self) -> Self {
        let mut out = no.0;
        for (i, x) in out.iter_mut().enumerate() {
            *x = if self.0[i] < bound.0[i] { yes.0[i] } else { *x };
        }
        Self(out)
    }

    /// `yes` where `self <= bound`, else `no`; `no` where either is NaN.
    #[inline(always)]
    pub fn where_at_most(self, bound: Self, yes: Self, no: Self) -> Self {
        let mut out = no.0;
        for (i, x) in out.iter_mut().enumerate() {
            *x = if self.0[i] <= bound.0[i] { yes.0[i] } else { *x };
        }
        Self(out)
    }

    /// A bit for each lane: whether `self < bound`.
    #[inline(always)]
    pub fn less(self, bound: Self) -> u32 {
        (0..N).map(|i| u32::from(self.0[i] < bound.0[i]) << i).fold(0, |bits, bit| bits | bit)
    }

    /// A bit for each lane: whether `self <= bound`.
    #[inline(always)]
    pub fn at_most(self, bound: Self) -> u32 {
        (0..N).map(|i| u32::from(self.0[i] <= bound.0[i]) << i).fold(0, |bits, bit| bits | bit)
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
