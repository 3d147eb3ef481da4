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
use super::polish::{FineRoot, NotSettled, polish_roots, scaled};
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
/// are wanted. **Proof**: the number of roots on the circle is exact.
pub fn locate_on_circle(
    in_theta: &UPoly<Gaussian<Integer>>,
    in_chart: &UPoly<Integer>,
    bits: usize,
) -> Result<Vec<CircleRoot>, NotLocated> {
    let counted = isolate_real_roots(in_chart).len();
    let mut starts = starting_values(in_theta);
    let mut bits = bits;
    loop {
        let outcome = polish_roots(in_theta, &starts, bits).map_err(NotLocated::from).and_then(|roots| {
            starts = roots.iter().map(FineRoot::to_complex).collect();
            tell_apart(roots, counted, bits)
        });
        match outcome {
            Err(_) if 2 * bits <= MAX_BITS => bits *= 2,
            outcome => return outcome,
        }
    }
}

/// Marks the roots nearest to the circle, as many as were counted; an error unless they stand out.
fn tell_apart(roots: Vec<FineRoot>, counted: usize, bits: usize) -> Result<Vec<CircleRoot>, NotLocated> {
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

/// Rough roots to start from: eigenvalues of the companion matrix, and where those fail or are too few, points apart.
fn starting_values(in_theta: &UPoly<Gaussian<Integer>>) -> Vec<Complex64> {
    let degree = in_theta.degree().unwrap_or(0);
    let bits = |c: &Gaussian<Integer>| c.re.bit_len().max(c.im.bit_len()) as i64;
    let exponent = in_theta.coefficients().iter().map(bits).max().unwrap_or(0);
    let rounded: Vec<Complex64> = in_theta.coefficients().iter().map(|c| scaled(c, -exponent)).collect();
    let mut starts = companion_roots(&rounded).map_or_else(|_| Vec::new(), |roots| roots.finite);
    // Coefficients that underflow lose roots at infinity; polishing finds them from anywhere.
    let missing = starts.len()..degree;
    starts.extend(missing.map(|k| Complex64::from_polar(1.0 + k as f64, 0.4 + 6.1 * k as f64 / degree as f64)));
    starts
}
