//! All roots of a square-free polynomial, to any number of digits.
//!
//! Ehrlich and Aberth's simultaneous iteration (Aberth 1973), with one twist: the polynomial is evaluated exactly, over the
//! integers, at dyadic points. So there is no noise floor, near-double roots come out with all their digits, and two
//! starting values never end in one root: each iterate is repelled by the others. Corrections are `f64`: one step adds up
//! to 52 bits.

use num_complex::Complex64;

use crate::algebra::{Gaussian, Integer, Ring, UPoly, integer_to_f64_scaled};

/// A root as a dyadic complex number: `numerator / 2^bits`.
#[derive(Clone, Debug, PartialEq)]
pub struct FineRoot {
    /// Numerator, a Gaussian integer.
    pub numerator: Gaussian<Integer>,
    /// Binary exponent of the denominator.
    pub bits: usize,
}

impl FineRoot {
    /// The nearest complex number in `f64` parts.
    pub fn to_complex(&self) -> Complex64 {
        scaled(&self.numerator, -(self.bits as i64))
    }

    /// A number near this root to `f64` accuracy.
    pub fn from_complex(value: Complex64, bits: usize) -> Self {
        Self { numerator: fixed(value, bits), bits }
    }

    /// `2^(bits·formal_degree) · p(root)`, exactly.
    ///
    /// Panics if the degree of `p` exceeds `formal_degree`.
    pub fn evaluate(&self, p: &UPoly<Gaussian<Integer>>, formal_degree: usize) -> Gaussian<Integer> {
        let shift = |g: &Gaussian<Integer>, n: usize| g.map(|x| x.clone() << n);
        let degree = p.coefficients().len().saturating_sub(1);
        assert!(degree <= formal_degree, "degree {degree} exceeds the formal degree {formal_degree}");
        let mut sum = Gaussian::<Integer>::zero();
        for (k, c) in p.coefficients().iter().enumerate().rev() {
            sum = sum * self.numerator.clone() + shift(c, self.bits * (degree - k));
        }
        shift(&sum, self.bits * (formal_degree - degree))
    }
}

/// Why polishing stopped short.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the roots did not settle to {bits} bits within {steps} steps")]
pub struct NotSettled {
    /// Bits asked for.
    pub bits: usize,
    /// Steps allowed.
    pub steps: usize,
}

/// Steps allowed. Six roots from random starts settle in under 20; a cluster 2⁻⁶⁰ wide in about 60.
const MAX_STEPS: usize = 300;

/// Last bits that may still move when a root counts as settled.
const SLACK_BITS: i64 = 6;

/// How far a stuck iterate is set aside, relative to its size: far above rounding, far below what starts are worth.
const NUDGE: f64 = 1.0 / 1024.0;

/// All roots of a square-free polynomial over the Gaussian integers, from rough starting values, to `2^-bits` absolute.
///
/// **Shape**: as many starting values as the degree; root `k` belongs to start `k`.
/// **Accuracy**: the last correction of each root was below `2^(6-bits)·max(1, |root|)`, evaluated without rounding.
/// **Errors**: [`NotSettled`] after 300 steps; the polynomial then is not square-free or needs more bits.
/// **Cost**: about 10 µs per root for degree 6 and 160 bits.
///
/// ```
/// use assur::algebra::{Gaussian, Integer, UPoly};
/// use assur::num_complex::Complex64;
/// use assur::roots::polish_roots;
/// let p = UPoly::new([-2, 0, 1].map(|c| Gaussian::new(Integer::from(c), Integer::ZERO)).to_vec()); // x² - 2
/// let roots = polish_roots(&p, &[Complex64::new(1.0, 0.5), Complex64::new(-1.0, 0.5)], 200).unwrap();
/// assert_eq!(roots[0].to_complex(), Complex64::new(2f64.sqrt(), 0.0));
/// ```
pub fn polish_roots(
    p: &UPoly<Gaussian<Integer>>,
    starts: &[Complex64],
    bits: usize,
) -> Result<Vec<FineRoot>, NotSettled> {
    assert_eq!(p.degree(), Some(starts.len()), "one starting value per root");
    let degree = starts.len();
    let derivative = p.derivative();
    let mut roots: Vec<FineRoot> = starts.iter().map(|&s| FineRoot::from_complex(s, bits)).collect();
    let mut settled = vec![false; degree];
    for _ in 0..MAX_STEPS {
        if settled.iter().all(|&s| s) {
            return Ok(roots);
        }
        for k in 0..degree {
            if settled[k] {
                continue;
            }
            let value = roots[k].evaluate(p, degree);
            if value == Gaussian::zero() {
                settled[k] = true;
                continue;
            }
            // p and p' carry 2^(bits·n) and 2^(bits·(n-1)).
            let slope = roots[k].evaluate(&derivative, degree - 1);
            // 1/correction = p'/p - sum over the others of 1/(root - other)
            let newton = quotient(&slope, &value, bits as i64);
            let gaps: Vec<Gaussian<Integer>> = (0..degree)
                .filter(|&j| j != k)
                .map(|j| roots[k].numerator.clone() - roots[j].numerator.clone())
                .collect();
            let repulsion: Complex64 = gaps.iter().map(|gap| scaled(gap, -(bits as i64)).inv()).sum();
            let correction = (newton - repulsion).inv();
            if gaps.contains(&Gaussian::zero()) || !correction.is_finite() {
                // Two iterates coincide, or stand still by symmetry: a nudge in a direction of its own sets this one free.
                let size = roots[k].to_complex().norm().max(f64::MIN_POSITIVE);
                let nudge = Complex64::from_polar(size * NUDGE, 1.0 + k as f64);
                roots[k].numerator = roots[k].numerator.clone() + fixed(nudge, bits);
                continue;
            }
            roots[k].numerator = roots[k].numerator.clone() - fixed(correction, bits);
            let size = roots[k].to_complex().norm().max(1.0);
            settled[k] = correction.norm() < size * 2f64.powi((SLACK_BITS - bits as i64).max(-1000) as i32);
        }
    }
    Err(NotSettled { bits, steps: MAX_STEPS })
}

/// `numerator·2^exponent` in `f64` parts.
pub(crate) fn scaled(numerator: &Gaussian<Integer>, exponent: i64) -> Complex64 {
    let one = Integer::ONE;
    let part = |x: &Integer| crate::algebra::ratio_to_f64(x, &one, exponent);
    Complex64::new(part(&numerator.re), part(&numerator.im))
}

/// `a / b · 2^exponent` in `f64` parts, `b` not zero; to a few units in the last place of the larger part.
pub(crate) fn quotient(a: &Gaussian<Integer>, b: &Gaussian<Integer>, exponent: i64) -> Complex64 {
    let (a, ea) = floating(a);
    let (b, eb) = floating(b);
    // Exponents apart in two steps: 2^e alone may leave the range where the quotient does not.
    let e = (ea - eb + exponent).clamp(-2200, 2200) as i32;
    (a / b) * 2f64.powi(e / 2) * 2f64.powi(e - e / 2)
}

/// `(m, e)` with the number `≈ m·2^e` and the larger part of `m` about 1.
fn floating(x: &Gaussian<Integer>) -> (Complex64, i64) {
    let (re, e_re) = integer_to_f64_scaled(&x.re);
    let (im, e_im) = integer_to_f64_scaled(&x.im);
    let e = match (re == 0.0, im == 0.0) {
        (true, true) => return (Complex64::ZERO, 0),
        (false, true) => e_re,
        (true, false) => e_im,
        (false, false) => e_re.max(e_im),
    };
    let part = |m: f64, own: i64| m * 2f64.powi((own - e - 64).max(-1000) as i32);
    (Complex64::new(part(re, e_re), part(im, e_im)), e + 64)
}

/// `value·2^bits`, rounded toward zero.
fn fixed(value: Complex64, bits: usize) -> Gaussian<Integer> {
    let part = |x: f64| {
        // Mantissa and exponent apart, so that no product overflows.
        let rational = crate::algebra::dyadic(x).expect("iterates stay finite");
        let (numerator, denominator) = rational.into_parts();
        (numerator << bits) / Integer::from(denominator)
    };
    Gaussian::new(part(value.re), part(value.im))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn g(re: i64, im: i64) -> Gaussian<Integer> {
        Gaussian::new(re.into(), im.into())
    }

    #[test]
    fn a_near_double_root_comes_out_with_all_digits() {
        // (3x - 1)² = 2^-120: roots 1/3 ± 2^-60/3, which f64 cannot tell apart.
        let p = UPoly::new(vec![g(1, 0), g(-6, 0), g(9, 0)]);
        let p = p.scaled(&Gaussian::real(Integer::ONE << 120)) - UPoly::constant(g(1, 0));
        let starts = [Complex64::new(0.33, 0.01), Complex64::new(0.34, -0.02)];
        let roots = polish_roots(&p, &starts, 200).unwrap();
        let gap = roots[0].numerator.clone() - roots[1].numerator.clone();
        let gap = scaled(&gap, -200).norm();
        assert!((gap * 3.0 / 2.0 * 2f64.powi(60) - 1.0).abs() < 1e-12, "{gap}");
    }

    #[test]
    fn equal_starts_still_find_different_roots() {
        let p = UPoly::new(vec![g(-1, 0), g(0, 0), g(0, 0), g(1, 0)]); // cube roots of unity
        let roots = polish_roots(&p, &[Complex64::new(0.3, 0.1); 3], 100).unwrap();
        for (k, a) in roots.iter().enumerate() {
            assert!((a.to_complex().powi(3) - 1.0).norm() < 1e-14);
            assert!(roots[..k].iter().all(|b| (a.to_complex() - b.to_complex()).norm() > 1.0));
        }
    }

    #[test]
    fn roots_of_very_different_size_are_relatively_accurate() {
        // (x - 2^40)(2^40 x - 1)(x - i)
        let big = Integer::ONE << 40;
        let linear = |a: Gaussian<Integer>, b: Gaussian<Integer>| UPoly::new(vec![a, b]);
        let p = linear(-Gaussian::real(big.clone()), g(1, 0))
            * linear(g(-1, 0), Gaussian::real(big))
            * linear(g(0, -1), g(1, 0));
        let starts = [Complex64::new(1e12, 0.0), Complex64::new(1e-11, 1e-12), Complex64::new(0.1, 0.9)];
        let roots = polish_roots(&p, &starts, 200).unwrap();
        assert_eq!(roots[0].to_complex(), Complex64::new(2f64.powi(40), 0.0));
        assert!((roots[1].to_complex() / 2f64.powi(-40) - 1.0).norm() < 1e-15);
        assert_eq!(roots[2].to_complex(), Complex64::I);
    }
}
