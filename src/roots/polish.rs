//! All roots of a square-free polynomial, to any number of digits.
//!
//! Ehrlich and Aberth's simultaneous iteration (Aberth 1973), with one twist: the polynomial is evaluated exactly, over the
//! integers, at dyadic points. So there is no noise floor, near-double roots come out with all their digits, and two
//! starting values never end in one root: each iterate is repelled by the others. Corrections have the digits of `f64` until an iterate is much nearer to its
//! root than to the others; from there Newton's, divided out over the integers, double the digits at each step.

use dashu_int::ops::BitTest;
use num_complex::Complex64;

use super::wide::Wide;
use crate::algebra::{Gaussian, Integer, Ring, UPoly};

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
        Self { numerator: Wide::new(value, 0).fixed(bits), bits }
    }

    /// The same number, cut to so many bits after the point.
    pub fn with_bits(&self, bits: usize) -> Self {
        let part = |x: &Integer| match bits.checked_sub(self.bits) {
            Some(more) => x.clone() << more,
            None => x.clone() >> (self.bits - bits),
        };
        Self { numerator: self.numerator.map(part), bits }
    }

    /// Bits to which a settled root is known relative to its size: fewer than [`FineRoot::bits`] for a small one.
    pub fn significant_bits(&self) -> usize {
        self.bits.min(size_in_bits(&self.numerator))
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

/// Steps allowed, and one more for every second bit. Six roots from random starts settle in under 20; a cluster 2⁻⁶⁰ wide in about 60.
const MAX_STEPS: usize = 300;

/// Last bits that may still move when a root counts as settled.
const SLACK_BITS: usize = 6;

/// A step that is shorter than the way to the nearest other iterate by so many bits is Newton's, divided out exactly: the others bend it by less than its
/// own error.
const ALONE_BITS: i64 = 30;

/// How far an iterate that stands still is set aside, relative to its size: 2^-10, far above rounding, far below what starts are worth. One that
/// coincides with another goes by the last bit of the starts.
const NUDGE: i64 = -10;

/// A nudge is at least so many last bits long, to be one in its direction.
const NUDGE_BITS: i64 = 4;

/// All roots of a square-free polynomial over the Gaussian integers, from rough starting values, to `2^-bits` absolute.
///
/// **Shape**: as many starting values as the degree; root `k` belongs to start `k`.
/// **Accuracy**: the last correction of each root was below `2^(6-bits)·max(1, |root|)`, evaluated without rounding.
/// **Errors**: [`NotSettled`] after some hundred steps, or where two iterates meet; the polynomial then is not square-free or needs more bits.
/// **Cost**: about 10 µs per root for degree 6 and 160 bits.
///
/// ```
/// use assur::algebra::{Gaussian, Integer, UPoly};
/// use assur::num_complex::Complex64;
/// use assur::roots::{FineRoot, polish_roots};
/// let p = UPoly::new([-2, 0, 1].map(|c| Gaussian::new(Integer::from(c), Integer::ZERO)).to_vec()); // x² - 2
/// let starts = [1.0, -1.0].map(|re| FineRoot::from_complex(Complex64::new(re, 0.5), 10));
/// let roots = polish_roots(&p, &starts, 200).unwrap();
/// assert_eq!(roots[0].to_complex(), Complex64::new(2f64.sqrt(), 0.0));
/// ```
pub fn polish_roots(
    p: &UPoly<Gaussian<Integer>>,
    starts: &[FineRoot],
    bits: usize,
) -> Result<Vec<FineRoot>, NotSettled> {
    let mut roots = starts.to_vec();
    polish(p, &mut roots, bits).map(|()| roots)
}

/// The same in place: where the iteration does not settle, the roots are as near as it came, to start from with more bits.
pub(super) fn polish(p: &UPoly<Gaussian<Integer>>, roots: &mut [FineRoot], bits: usize) -> Result<(), NotSettled> {
    assert_eq!(p.degree(), Some(roots.len()), "one starting value per root");
    let degree = roots.len();
    let derivative = p.derivative();
    let coarsest = roots.iter().map(|start| start.bits).min().unwrap_or(bits) as i64;
    roots.iter_mut().for_each(|root| *root = root.with_bits(bits));
    let mut settled = vec![false; degree];
    // From half of the bits on, a pair of roots as near as the last bit comes apart by a factor of three at each step.
    let steps = MAX_STEPS + bits / 2;
    for step in 0..steps {
        if settled.iter().all(|&s| s) {
            return Ok(());
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
            let unit = -(bits as i64);
            let gaps: Vec<Wide> = (0..degree)
                .filter(|&j| j != k)
                .map(|j| Wide::of(&(roots[k].numerator.clone() - roots[j].numerator.clone()), unit))
                .collect();
            // 1/correction = p'/p - sum over the others of 1/(root - other)
            let crowded = gaps.iter().any(|gap| gap.is_zero());
            if crowded && step > 0 {
                // Two roots nearer than the last bit.
                return Err(NotSettled { bits, steps: step });
            }
            let correction = (!crowded).then(|| {
                let newton = Wide::of(&slope, -unit) * Wide::of(&value, 0).inv();
                gaps.iter().fold(newton, |sum, gap| sum - gap.inv())
            });
            let Some(correction) = correction.filter(|inverse| !inverse.is_zero()).map(Wide::inv) else {
                // Two starts coincide, or an iterate stands still by symmetry: a nudge in a direction of its own sets this one free.
                let size =
                    if crowded { -coarsest } else { Wide::of(&roots[k].numerator, unit).size().max(unit) + NUDGE };
                let nudge = Wide::new(Complex64::from_polar(1.0, 1.0 + k as f64), size.max(unit + NUDGE_BITS));
                roots[k].numerator = roots[k].numerator.clone() + nudge.fixed(bits);
                continue;
            };
            let nearest = gaps.iter().map(|gap| gap.size()).min().unwrap_or(i64::MAX);
            let alone = correction.size() < nearest.saturating_sub(ALONE_BITS) && slope != Gaussian::zero();
            let away = if alone { divided(&value, &slope) } else { correction.fixed(bits) };
            roots[k].numerator = roots[k].numerator.clone() - away.clone();
            let size = size_in_bits(&roots[k].numerator).max(bits) - bits;
            // Where others are as near as the correction is short, it says nothing of the way that is left.
            settled[k] = alone && size_in_bits(&away) <= size + SLACK_BITS;
        }
    }
    Err(NotSettled { bits, steps })
}

/// Bits of the larger part.
fn size_in_bits(x: &Gaussian<Integer>) -> usize {
    x.re.bit_len().max(x.im.bit_len())
}

/// `a / b`, each part rounded toward zero.
fn divided(a: &Gaussian<Integer>, b: &Gaussian<Integer>) -> Gaussian<Integer> {
    let (size, numerator) = (b.norm_sqr(), a.clone() * b.conj());
    numerator.map(|part| part / &size)
}

/// `numerator·2^exponent` in `f64` parts.
pub(crate) fn scaled(numerator: &Gaussian<Integer>, exponent: i64) -> Complex64 {
    let one = Integer::ONE;
    let part = |x: &Integer| crate::algebra::ratio_to_f64(x, &one, exponent);
    Complex64::new(part(&numerator.re), part(&numerator.im))
}

/// `a / b · 2^exponent` in `f64` parts, `b` not zero; to a few units in the last place of the larger part.
pub(crate) fn quotient(a: &Gaussian<Integer>, b: &Gaussian<Integer>, exponent: i64) -> Complex64 {
    (Wide::of(a, exponent) * Wide::of(b, 0).inv()).to_complex()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn g(re: i64, im: i64) -> Gaussian<Integer> {
        Gaussian::new(re.into(), im.into())
    }

    fn near(values: &[Complex64]) -> Vec<FineRoot> {
        values.iter().map(|&value| FineRoot::from_complex(value, 100)).collect()
    }

    #[test]
    fn a_near_double_root_comes_out_with_all_digits() {
        // (3x - 1)² = 2^-120: roots 1/3 ± 2^-60/3, which f64 cannot tell apart.
        let p = UPoly::new(vec![g(1, 0), g(-6, 0), g(9, 0)]);
        let p = p.scaled(&Gaussian::real(Integer::ONE << 120)) - UPoly::constant(g(1, 0));
        let starts = near(&[Complex64::new(0.33, 0.01), Complex64::new(0.34, -0.02)]);
        let roots = polish_roots(&p, &starts, 200).unwrap();
        let gap = roots[0].numerator.clone() - roots[1].numerator.clone();
        let gap = scaled(&gap, -200).norm();
        assert!((gap * 3.0 / 2.0 * 2f64.powi(60) - 1.0).abs() < 1e-12, "{gap}");
    }

    #[test]
    fn a_pair_of_roots_a_thousand_bits_apart_is_found_from_where_the_last_attempt_ended() {
        // (3x - 1)² = 2^-2000
        let p = UPoly::new(vec![g(1, 0), g(-6, 0), g(9, 0)]);
        let p = p.scaled(&Gaussian::real(Integer::ONE << 2000)) - UPoly::constant(g(1, 0));
        let mut roots = near(&[Complex64::new(0.33, 0.01), Complex64::new(0.34, -0.02)]);
        assert!(polish(&p, &mut roots, 640).is_err());
        assert!((roots[0].to_complex() - 1.0 / 3.0).norm() < 1e-15);
        polish(&p, &mut roots, 1280).expect("settles");
        let gap = Wide::of(&(roots[0].numerator.clone() - roots[1].numerator.clone()), -1280);
        assert_eq!(gap.size(), -1001);
    }

    #[test]
    fn equal_starts_still_find_different_roots() {
        let p = UPoly::new(vec![g(-1, 0), g(0, 0), g(0, 0), g(1, 0)]); // cube roots of unity
        let roots = polish_roots(&p, &near(&[Complex64::new(0.3, 0.1); 3]), 100).unwrap();
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
        let starts = near(&[Complex64::new(1e12, 0.0), Complex64::new(1e-11, 1e-12), Complex64::new(0.1, 0.9)]);
        let roots = polish_roots(&p, &starts, 200).unwrap();
        assert_eq!(roots[0].to_complex(), Complex64::new(2f64.powi(40), 0.0));
        assert!((roots[1].to_complex() / 2f64.powi(-40) - 1.0).norm() < 1e-15);
        assert_eq!(roots[2].to_complex(), Complex64::I);
    }
}
