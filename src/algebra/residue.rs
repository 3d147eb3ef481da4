//! Integers modulo one large prime: exact counting in microseconds.
//!
//! What holds over the integers holds modulo a prime; what fails over the integers holds modulo this one only if its 62 bits divide a number
//! that is not zero. For numbers that nobody chose for the purpose that has a chance of about 1e-18 each time. The prime is 1 modulo 4, so
//! that -1 has a root and complex numbers can be taken in.

use std::ops::{Add, Mul, Neg, Sub};

use super::{Gaussian, Ring};

/// `2^62 - 87`.
const PRIME: u64 = (1 << 62) - 87;
/// A root of -1 modulo the prime.
const ROOT_OF_MINUS_ONE: u64 = 4_490_822_397_581_186_023;

/// A number modulo `2^62 - 87`.
///
/// ```
/// use assur::algebra::{Residue, Ring};
/// let third = Residue::from_int(3).inverse().unwrap();
/// assert_eq!(third * Residue::from_int(6), Residue::from_int(2));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Residue(u64);

impl Residue {
    /// The residue of a finite `f64`, which is a dyadic rational; `None` for others.
    pub fn of_f64(x: f64) -> Option<Self> {
        if !x.is_finite() {
            return None;
        }
        let bits = x.to_bits();
        let field = (bits >> 52 & 0x7ff) as i64;
        let fraction = bits & ((1 << 52) - 1);
        let (mantissa, exponent) = if field == 0 { (fraction, -1074) } else { (fraction | 1 << 52, field - 1075) };
        let half = Self(PRIME.div_ceil(2));
        let base = if exponent < 0 { half } else { Self(2) };
        let size = Self(mantissa % PRIME) * base.to_the(exponent.unsigned_abs());
        Some(if x < 0.0 { -size } else { size })
    }

    /// A complex number, with `i` as a root of -1.
    pub fn of_gaussian(z: &Gaussian<Self>) -> Self {
        z.re + Self(ROOT_OF_MINUS_ONE) * z.im
    }

    fn to_the(self, mut exponent: u64) -> Self {
        let (mut power, mut square) = (Self(1), self);
        while exponent > 0 {
            if exponent & 1 == 1 {
                power = power * square;
            }
            square = square * square;
            exponent >>= 1;
        }
        power
    }

    /// The inverse; `None` for zero.
    pub fn inverse(self) -> Option<Self> {
        (self.0 != 0).then(|| self.to_the(PRIME - 2))
    }
}

impl Add for Residue {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let sum = self.0 + other.0;
        Self(if sum >= PRIME { sum - PRIME } else { sum })
    }
}

impl Sub for Residue {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Residue {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        // 2^62 = 87: the high part folds down twice instead of a division.
        let fold = |x: u128| (x & ((1 << 62) - 1)) + (x >> 62) * 87;
        let product = fold(fold(u128::from(self.0) * u128::from(other.0))) as u64;
        Self(if product >= PRIME { product - PRIME } else { product })
    }
}

impl Neg for Residue {
    type Output = Self;
    fn neg(self) -> Self {
        Self(if self.0 == 0 { 0 } else { PRIME - self.0 })
    }
}

impl Ring for Residue {
    fn from_int(n: i64) -> Self {
        let size = Self(n.unsigned_abs() % PRIME);
        if n < 0 { -size } else { size }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_a_field_with_a_root_of_minus_one() {
        let i = Residue(ROOT_OF_MINUS_ONE);
        assert_eq!(i * i, Residue::from_int(-1));
        let mut x = Residue::from_int(1_234_567);
        for _ in 0..1000 {
            x = x * x + Residue::from_int(3);
            let check = u128::from(x.0) * u128::from(x.0) % u128::from(PRIME);
            assert_eq!(u128::from((x * x).0), check);
            assert_eq!(x.inverse().map(|y| x * y), Some(Residue(1)));
        }
        assert_eq!(Residue(0).inverse(), None);
    }

    #[test]
    fn floats_keep_their_exact_value() {
        let of = |x: f64| Residue::of_f64(x).expect("finite");
        assert_eq!(of(-0.75) * Residue::from_int(4), Residue::from_int(-3));
        assert_eq!(of(0.1) * Residue::from_int(1 << 55), Residue::from_int((0.1 * 2f64.powi(55)) as i64));
        assert_eq!(of(f64::MIN_POSITIVE / 4.0) * of(f64::MAX) * of(4.0), of(f64::MIN_POSITIVE) * of(f64::MAX));
        assert_eq!(Residue::of_f64(f64::NAN), None);
    }
}
