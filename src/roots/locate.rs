//! All roots of a polynomial that is real on the unit circle, with an exact count of those on it.
//!
//! A trigonometric polynomial has two faces: in `theta = e^(i phi)` its roots are found, and in a real chart of the circle the
//! real ones are counted without rounding. Roots are polished until the two agree: as many as were counted lie on the
//! circle to half the digits computed, and no other does.

use dashu_int::ops::BitTest;
use num_complex::Complex64;
use thiserror::Error;

use super::companion::companion_roots;
use super::isolate::isolate_real_roots;
use super::polish::{FineRoot, NotSettled, polish, scaled};
use super::wide::Wide;
use crate::algebra::{Gaussian, Integer, UPoly, integer_to_f64_scaled};

/// A root `theta` of a polynomial real on the unit circle.
#[derive(Clone, Debug)]
pub struct CircleRoot {
    /// Where it is.
    pub root: FineRoot,
    /// Whether it lies on the unit circle, exactly.
    pub on_circle: bool,
}

/// Why the roots could not be located within [`MAX_BITS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum NotLocated {
    /// The iteration did not settle.
    #[error(transparent)]
    NotSettled(#[from] NotSettled),
    /// As many roots as were counted on the circle could not be told from the others.
    #[error("{counted} roots were counted on the circle but could not be told from the others with {bits} bits")]
    Ambiguous {
        /// Exact number on the circle.
        counted: usize,
        /// Bits computed.
        bits: usize,
    },
}

/// Bits of the first attempt: three times those of `f64`, so that what is computed from a root keeps them all.
pub const FIRST_BITS: usize = 160;

/// Bits of the last attempt. Nothing a designer writes down comes near; two roots 2⁻¹⁰⁰⁰ apart would.
pub const MAX_BITS: usize = 5120;

/// All roots of a square-free `in_theta`, and which of them lie on the unit circle.
///
/// `in_chart` is the same polynomial in a real chart of the circle in which no root is at infinity; `bits` is how fine the roots
/// are wanted, relative to those smaller than 1, absolute or relative to the others. **Proof**: the number of roots on the circle is exact.
pub fn locate_on_circle(
    in_theta: &UPoly<Gaussian<Integer>>,
    in_chart: &UPoly<Integer>,
    bits: usize,
) -> Result<Vec<CircleRoot>, NotLocated> {
    let counted = isolate_real_roots(in_chart).len();
    let sizes = root_sizes(in_theta);
    // The smallest root has to keep its digits.
    let extra = sizes.iter().min().map_or(0, |&smallest| (-smallest).max(0) as usize);
    let mut roots = starting_values(in_theta, &sizes, bits + extra);
    let mut bits = bits;
    loop {
        // What was reached serves the next attempt.
        let settled = polish(in_theta, &mut roots, bits + extra);
        let outcome = settled.map_err(NotLocated::from).and_then(|()| tell_apart(roots.clone(), counted));
        match outcome {
            Err(_) if 2 * bits <= MAX_BITS => bits *= 2,
            outcome => return outcome,
        }
    }
}

/// Marks the roots nearest to the circle, as many as were counted; an error unless they stand out.
fn tell_apart(roots: Vec<FineRoot>, counted: usize) -> Result<Vec<CircleRoot>, NotLocated> {
    let bits = roots.first().map_or(0, |root| root.bits);
    // log2 of | |theta|² - 1 |; the scaled integer has 2·bits binary places.
    let closeness = |root: &FineRoot| {
        let excess = root.numerator.norm_sqr() - (Integer::ONE << (2 * bits));
        let (mantissa, exponent) = integer_to_f64_scaled(&excess);
        if mantissa == 0.0 { i64::MIN } else { exponent + 64 - 2 * bits as i64 }
    };
    let mut ranked: Vec<(i64, usize)> = roots.iter().enumerate().map(|(k, r)| (closeness(r), k)).collect();
    ranked.sort_unstable();
    let half = -(bits as i64) / 2;
    let near = ranked.iter().filter(|(c, _)| *c < half).count();
    if near != counted {
        return Err(NotLocated::Ambiguous { counted, bits });
    }
    let mut on_circle = vec![false; roots.len()];
    for &(_, k) in &ranked[..counted] {
        on_circle[k] = true;
    }
    Ok(roots.into_iter().zip(on_circle).map(|(root, on_circle)| CircleRoot { root, on_circle }).collect())
}

/// Binary exponents of the roots' moduli, descending, each right within a few bits: the slopes of the Newton polygon, the upper hull of
/// the points `(k, log2 |c_k|)` (Bini 1996). A root at zero has exponent 0.
fn root_sizes(p: &UPoly<Gaussian<Integer>>) -> Vec<i64> {
    let points: Vec<(i64, i64)> = (0..)
        .zip(p.coefficients())
        .map(|(k, c)| (k, Wide::of(c, 0).size()))
        .filter(|&(_, size)| size > i64::MIN)
        .collect();
    let mut sizes = vec![0; points.first().map_or(0, |&(k, _)| k as usize)];
    let mut from = 0;
    while from + 1 < points.len() {
        let (k, size) = points[from];
        let slope = |&(j, other): &(i64, i64)| (other - size) as f64 / (j - k) as f64;
        let steepest = (from + 1..points.len()).max_by(|&i, &j| slope(&points[i]).total_cmp(&slope(&points[j])));
        let to = steepest.expect("there is a point beyond");
        let (j, other) = points[to];
        sizes.extend(std::iter::repeat_n((size - other).div_euclid(j - k), (j - k) as usize));
        from = to;
    }
    sizes
}

/// Sizes, as powers of two, within which eigenvalues in `f64` make good starting values.
const COMPANION_RANGE: i64 = 100;

/// Rough roots to start from: eigenvalues of the companion matrix, and where those fail or sizes are too far apart for them, points on circles of the
/// sizes that the Newton polygon tells.
fn starting_values(in_theta: &UPoly<Gaussian<Integer>>, sizes: &[i64], bits: usize) -> Vec<FineRoot> {
    if sizes.iter().all(|size| size.abs() <= COMPANION_RANGE) {
        let largest = in_theta.coefficients().iter().map(|c| c.re.bit_len().max(c.im.bit_len()) as i64).max();
        let rounded: Vec<Complex64> =
            in_theta.coefficients().iter().map(|c| scaled(c, -largest.unwrap_or(0))).collect();
        if let Ok(roots) = companion_roots(&rounded)
            && roots.finite.len() == sizes.len()
        {
            // No more bits than they are worth, so that those that coincide are parted by their own inaccuracy.
            return roots
                .finite
                .iter()
                .map(|&root| FineRoot::from_complex(root, COMPANION_RANGE as usize + 40))
                .collect();
        }
    }
    let angle = |k: usize| 0.4 + 6.1 * k as f64 / sizes.len() as f64;
    let start = |(k, &size): (usize, &i64)| Wide::new(Complex64::from_polar(1.0, angle(k)), size).fixed(bits);
    sizes.iter().enumerate().map(start).map(|numerator| FineRoot { numerator, bits }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Ring;

    fn real(n: Integer) -> Gaussian<Integer> {
        Gaussian::real(n)
    }

    #[test]
    fn roots_of_any_size_are_told_and_found() {
        // (x - 2^3000)(2^3000 x - 1)(x - i)
        let big = Integer::ONE << 3000;
        let linear = |a, b| UPoly::new(vec![a, b]);
        let p = linear(real(-big.clone()), real(Integer::ONE))
            * linear(real(-Integer::ONE), real(big))
            * linear(Gaussian::new(Integer::ZERO, -Integer::ONE), Gaussian::one());
        let sizes = root_sizes(&p);
        for (size, expected) in sizes.iter().zip([-3000, 0, 3000]) {
            assert!((size - expected).abs() <= 2, "{sizes:?}");
        }
        // One root on the circle, of which a chart knows: here any polynomial with one real root.
        let chart = UPoly::new(vec![Integer::from(-2), Integer::ONE]);
        let found = locate_on_circle(&p, &chart, 160).expect("found");
        assert_eq!(found.iter().filter(|root| root.on_circle).count(), 1);
        let smallest = found.iter().map(|root| Wide::of(&root.root.numerator, -(root.root.bits as i64)).size()).min();
        assert_eq!(smallest, Some(-3000));
    }
}
