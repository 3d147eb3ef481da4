//! Big integers and rationals, and the two ways between them and `f64`.
//!
//! The numbers are dashu's. A finite `f64` is a dyadic rational `m·2^e`; [`dyadic`] gives exactly that
//! one. The way back rounds to the nearest `f64` and never overflows on the way: numerators and
//! denominators of eliminants have thousands of bits.

/// An integer of any size.
pub use dashu_int::IBig as Integer;
/// A rational number of any size, in lowest terms.
pub use dashu_ratio::RBig as Rational;

use dashu_int::ops::BitTest;

/// The rational number that a finite `f64` is, exactly; `None` for NaN and the infinities.
///
/// ```
/// use assur::algebra::{Rational, dyadic};
/// assert_eq!(dyadic(0.375), Some(Rational::from_parts(3.into(), 8u8.into())));
/// assert_eq!(dyadic(f64::NAN), None);
/// ```
pub fn dyadic(x: f64) -> Option<Rational> {
    Rational::try_from(x).ok()
}

/// The `f64` nearest to a rational.
///
/// ```
/// use assur::algebra::{dyadic, nearest_f64};
/// assert_eq!(nearest_f64(&dyadic(-0.1).unwrap()), -0.1);
/// ```
pub fn nearest_f64(x: &Rational) -> f64 {
    x.to_f64().value()
}

/// `(m, e)` with `n ≈ m·2^e` to 2⁻⁶² relative and `m` between 2⁶² and 2⁶⁴, or `(0, 0)`.
///
/// Scaled so, sizes far outside the range of `f64` can still be compared and divided.
pub fn integer_to_f64_scaled(n: &Integer) -> (f64, i64) {
    if n.is_zero() {
        return (0.0, 0);
    }
    let bits = n.bit_len() as i64;
    let shift = bits - 64;
    let head = if shift > 0 { n.clone() >> shift as usize } else { n.clone() << (-shift) as usize };
    (head.to_f64().value(), shift)
}

/// The quotient `numerator / denominator · 2^exponent` as `f64`, relative error at most a few 2⁻⁵³.
///
/// Neither part need fit an `f64`. A zero denominator gives an infinity or NaN, as floats do; callers rule it out.
///
/// ```
/// use assur::algebra::{Integer, ratio_to_f64};
/// let huge = Integer::from(3) << 5000;
/// assert_eq!(ratio_to_f64(&(huge.clone() * Integer::from(5)), &huge, -1), 2.5);
/// ```
pub fn ratio_to_f64(numerator: &Integer, denominator: &Integer, exponent: i64) -> f64 {
    let (n, en) = integer_to_f64_scaled(numerator);
    let (d, ed) = integer_to_f64_scaled(denominator);
    scale_by_power_of_two(n / d, en - ed + exponent)
}

/// `x·2^e` without an intermediate overflow.
pub(crate) fn scale_by_power_of_two(x: f64, e: i64) -> f64 {
    // Two factors, since 2^e alone may leave the range of f64 where the product does not.
    let half = (e / 2).clamp(-1100, 1100) as i32;
    let rest = (e - i64::from(half)).clamp(-1100, 1100) as i32;
    x * 2f64.powi(half) * 2f64.powi(rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_round_trip_through_rationals() {
        for x in [0.0, 1.0, -0.1, 1e300, -1e-300, f64::MIN_POSITIVE, 5e-324, f64::MAX] {
            assert_eq!(nearest_f64(&dyadic(x).unwrap()), x);
        }
        assert!(dyadic(f64::INFINITY).is_none());
    }

    #[test]
    fn ratios_of_huge_integers_do_not_overflow() {
        let n = Integer::from(7) << 4000;
        let d = Integer::from(2) << 4000;
        assert_eq!(ratio_to_f64(&n, &d, 0), 3.5);
        assert_eq!(ratio_to_f64(&-n, &Integer::from(2), -4000), -3.5);
        assert_eq!(ratio_to_f64(&Integer::ZERO, &d, 3), 0.0);
    }
}
