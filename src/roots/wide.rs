//! A complex number with the digits of `f64` and an exponent of its own.
//!
//! Roots of a mechanism whose lengths are 300 orders of magnitude apart are as far apart, and their differences and inverses leave the range of
//! `f64` where the numbers themselves do not. Nothing here overflows or underflows.

use std::ops::{Add, Mul, Neg, Sub};

use num_complex::Complex64;

use crate::algebra::{Gaussian, Integer, integer_to_f64_scaled, scale_by_power_of_two};

/// `mantissa · 2^exponent`, the larger part of the mantissa between 1 and 2, or zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wide {
    mantissa: Complex64,
    exponent: i64,
}

impl Wide {
    pub const ZERO: Self = Self { mantissa: Complex64::ZERO, exponent: 0 };

    /// `value · 2^exponent`; `value` finite.
    pub fn new(value: Complex64, exponent: i64) -> Self {
        let size = value.re.abs().max(value.im.abs());
        if size == 0.0 {
            return Self::ZERO;
        }
        let own = size.log2().floor() as i64;
        let part = |x: f64| scale_by_power_of_two(x, -own);
        Self { mantissa: Complex64::new(part(value.re), part(value.im)), exponent: exponent + own }
    }

    /// `numerator · 2^exponent`, rounded.
    pub fn of(numerator: &Gaussian<Integer>, exponent: i64) -> Self {
        let ((re, e_re), (im, e_im)) = (integer_to_f64_scaled(&numerator.re), integer_to_f64_scaled(&numerator.im));
        let part = |re, im, e| Self::new(Complex64::new(re, im), e);
        part(re, 0.0, e_re + exponent) + part(0.0, im, e_im + exponent)
    }

    pub fn is_zero(self) -> bool {
        self == Self::ZERO
    }

    /// The binary exponent of its size; `i64::MIN` for zero.
    pub fn size(self) -> i64 {
        if self.is_zero() { i64::MIN } else { self.exponent }
    }

    /// The inverse; of a number that is not zero.
    pub fn inv(self) -> Self {
        Self::new(self.mantissa.inv(), -self.exponent)
    }

    /// The nearest in `f64` parts; zero or infinite where out of range.
    pub fn to_complex(self) -> Complex64 {
        let part = |x: f64| scale_by_power_of_two(x, self.exponent);
        Complex64::new(part(self.mantissa.re), part(self.mantissa.im))
    }

    /// `self · 2^bits`, rounded toward zero.
    pub fn fixed(self, bits: usize) -> Gaussian<Integer> {
        /// Bits that an `f64` between -2 and 2 has beyond the point, at most, if smaller ones do not matter.
        const POINT: i64 = 60;
        let shift = self.exponent + bits as i64 - POINT;
        let part = |x: f64| {
            let whole = Integer::from((x * (1i64 << POINT) as f64) as i64);
            if shift >= 0 { whole << shift as usize } else { whole / (Integer::ONE << (-shift) as usize) }
        };
        Gaussian::new(part(self.mantissa.re), part(self.mantissa.im))
    }
}

impl Add for Wide {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (large, small) = if self.size() >= other.size() { (self, other) } else { (other, self) };
        if small.is_zero() {
            return large;
        }
        let gap = (small.exponent - large.exponent).max(-1000) as i32;
        Self::new(large.mantissa + small.mantissa * 2f64.powi(gap), large.exponent)
    }
}

impl Neg for Wide {
    type Output = Self;
    fn neg(self) -> Self {
        Self { mantissa: -self.mantissa, ..self }
    }
}

impl Sub for Wide {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Wide {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(self.mantissa * other.mantissa, self.exponent + other.exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_far_outside_f64_come_back() {
        let tiny = Wide::new(Complex64::new(3.0, -4.0), -5000);
        let back = tiny.inv() * Wide::new(Complex64::new(0.0, 25.0), -5000);
        assert_eq!(back.to_complex(), Complex64::new(-4.0, 3.0));
        assert_eq!(tiny.fixed(5001), Gaussian::new(Integer::from(6), Integer::from(-8)));
        assert_eq!((tiny + tiny - tiny).fixed(5000), Gaussian::new(Integer::from(3), Integer::from(-4)));
        assert_eq!(tiny.to_complex(), Complex64::ZERO);
        assert!((tiny - tiny).is_zero());
        let denormal = Wide::new(Complex64::new(5e-324, 0.0), 1074);
        assert_eq!(denormal.to_complex(), Complex64::ONE);
    }

    #[test]
    fn integers_keep_their_first_digits() {
        let n = Gaussian::new(Integer::from(5) << 3000, Integer::ONE << 2990);
        assert_eq!(Wide::of(&n, -3000).to_complex(), Complex64::new(5.0, 2f64.powi(-10)));
    }
}
