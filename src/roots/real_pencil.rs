//! The eigenpairs of a real pencil whose linear part can be inverted: one ordinary real eigenproblem, several times as fast as QZ.
//!
//! `A + t B` becomes `t - (-B^-1 A)`. That costs digits where `B` is nearly singular, so such pencils are refused and left to
//! [`super::pencil_eigenpairs`]; what remains is accurate enough to start Newton's method from, which is what it is for. Eigenvalues alone
//! are taken from the real Schur form; each vector then by inverse iteration on the Hessenberg form, at `n^2` operations. Of two conjugate
//! pairs one is given.
//!
//! Source: Golub, Van Loan (2013), Matrix Computations, 4th ed., 7.4 to 7.6; Peters, Wilkinson (1979), Inverse iteration, ill-conditioned
//! equations and Newton's method, SIAM Review 21, 339-360, doi:10.1137/1021052, for why one step suffices.

use nalgebra::linalg::{Hessenberg, LU, Schur};
use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

/// An eigenvalue of a real pencil and a vector that the pencil takes to nearly nothing there.
#[derive(Clone, Debug, PartialEq)]
pub struct RealPencilPair {
    /// The eigenvalue; its imaginary part is not negative.
    pub value: Complex64,
    /// The vector, real where the value is; of no particular length.
    pub vector: Vec<Complex64>,
}

/// Smallest pivot of the linear part over its largest: below, too few of sixteen digits are left to start from (heuristic).
const INVERTIBLE: f64 = 1e-9;
/// Steps of the QR algorithm for each eigenvalue; three are usual, and thirty are LAPACK's bound too.
const STEPS_EACH: usize = 30;

/// The finite eigenpairs of `constant + t linear`, one of each conjugate two; `None` where the linear part is nearly singular or the
/// iteration does not converge.
///
/// **Shape:** square matrices of one size, rows of comparable size. **Accuracy:** about `1e-16` times the condition of the linear part; nothing
/// is promised of the vectors of nearly equal eigenvalues. **Cost:** about `10 n^3` operations: 0.1 ms for size 20, 2 ms for size 70.
///
/// ```
/// use assur::nalgebra::DMatrix;
/// use assur::roots::real_pencil_eigenpairs;
/// // t^2 + 1 as a companion pencil.
/// let found = real_pencil_eigenpairs(&DMatrix::from_row_slice(2, 2, &[0.0, -1.0, 1.0, 0.0]), &DMatrix::identity(2, 2));
/// let found = found.expect("the linear part is the identity");
/// assert_eq!(found.len(), 1);
/// assert!((found[0].value.im - 1.0).abs() < 1e-15 && found[0].value.re.abs() < 1e-15);
/// ```
pub fn real_pencil_eigenpairs(constant: &DMatrix<f64>, linear: &DMatrix<f64>) -> Option<Vec<RealPencilPair>> {
    let size = linear.nrows();
    if size == 0 || linear.ncols() != size || constant.shape() != linear.shape() {
        return None;
    }
    let lu = LU::new(linear.clone());
    let pivots = lu.u().diagonal().abs();
    // Written so that NaN is refused.
    let invertible = pivots.min() > INVERTIBLE * pivots.max();
    if !invertible {
        return None;
    }
    let mut matrix = constant.clone();
    lu.solve_mut(&mut matrix);
    matrix.neg_mut();
    if matrix.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let (q, h) = Hessenberg::new(matrix).unpack();
    let values = Schur::try_new(h.clone(), f64::EPSILON, STEPS_EACH * size)?.complex_eigenvalues();
    let mut inverse = InverseIteration::new(h);
    let mut pairs = Vec::with_capacity(size);
    for value in values.iter().filter(|value| value.im >= 0.0) {
        let inner = inverse.vector(*value);
        let mut vector = vec![Complex64::ZERO; size];
        for (column, y) in q.column_iter().zip(inner) {
            for (sum, x) in vector.iter_mut().zip(column.iter()) {
                *sum += y * x;
            }
        }
        pairs.push(RealPencilPair { value: *value, vector });
    }
    Some(pairs)
}

/// Kernel vectors of `H - t`, `H` upper Hessenberg, with the memory they need.
struct InverseIteration {
    h: DMatrix<f64>,
    /// A pivot of zero is taken for this.
    tiny: f64,
    /// The rows of the triangular factor, one after another.
    upper: Vec<Complex64>,
    right: Vec<Complex64>,
    start: DVector<f64>,
}

impl InverseIteration {
    fn new(h: DMatrix<f64>) -> Self {
        let size = h.nrows();
        let tiny = (f64::EPSILON * h.norm()).max(f64::MIN_POSITIVE);
        // Any start will do that is not orthogonal to what is sought; one without pattern never is.
        let start = DVector::from_fn(size, |k, _| 1.0 + 0.5 * (1.0 + 2.4 * k as f64).sin());
        let (upper, right) = (vec![Complex64::ZERO; size * size], vec![Complex64::ZERO; size]);
        Self { h, tiny, upper, right, start }
    }

    /// One step of inverse iteration: at an eigenvalue correct to rounding it reaches the vector.
    fn vector(&mut self, value: Complex64) -> &[Complex64] {
        let size = self.h.nrows();
        for i in 0..size {
            self.right[i] = Complex64::from(self.start[i]);
            for j in i.saturating_sub(1)..size {
                self.upper[i * size + j] = Complex64::from(self.h[(i, j)]);
            }
            self.upper[i * size + i] -= value;
        }
        for k in 0..size {
            // Two rows have an entry in this column; the larger becomes the pivot.
            if k + 1 < size && self.upper[(k + 1) * size + k].norm_sqr() > self.upper[k * size + k].norm_sqr() {
                let (above, below) = self.upper.split_at_mut((k + 1) * size);
                above[k * size + k..].swap_with_slice(&mut below[k..size]);
                self.right.swap(k, k + 1);
            }
            let pivot = &mut self.upper[k * size + k];
            if pivot.norm_sqr() < self.tiny * self.tiny {
                *pivot = Complex64::from(self.tiny);
            }
            if k + 1 < size {
                let (above, below) = self.upper.split_at_mut((k + 1) * size);
                let (above, below) = (&above[k * size + k..], &mut below[k..size]);
                let factor = below[0] / above[0];
                for (entry, x) in below[1..].iter_mut().zip(&above[1..]) {
                    *entry -= factor * x;
                }
                let value = self.right[k];
                self.right[k + 1] -= factor * value;
            }
        }
        for k in (0..size).rev() {
            let row = &self.upper[k * size..(k + 1) * size];
            let known = row[k + 1..].iter().zip(&self.right[k + 1..]).map(|(x, y)| x * y).sum::<Complex64>();
            self.right[k] = (self.right[k] - known) / row[k];
        }
        &self.right
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(size: usize, seed: u64) -> DMatrix<f64> {
        let mut state = seed;
        DMatrix::from_fn(size, size, |_, _| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        })
    }

    #[test]
    fn every_pair_leaves_next_to_nothing_of_the_pencil() {
        for size in [1, 2, 3, 6, 20, 70] {
            let (a, b) = (random(size, 1), random(size, 2));
            let found = real_pencil_eigenpairs(&a, &b).expect("regular");
            let count: usize = found.iter().map(|pair| if pair.value.im > 0.0 { 2 } else { 1 }).sum();
            assert_eq!(count, size);
            for pair in found {
                let vector = DVector::from_vec(pair.vector);
                let complex = |m: &DMatrix<f64>| m.map(Complex64::from);
                let rest = (complex(&a) + complex(&b) * pair.value) * &vector;
                let bound = (a.norm() + pair.value.norm() * b.norm()) * vector.norm();
                assert!(rest.norm() < 1e-12 * bound, "size {size}: {:e}", rest.norm() / bound);
            }
        }
    }

    #[test]
    fn singular_linear_parts_are_refused() {
        let a = random(4, 3);
        let mut b = random(4, 4);
        let row = b.row(0) * 2.0;
        b.set_row(3, &row);
        assert_eq!(real_pencil_eigenpairs(&a, &b), None);
        assert_eq!(real_pencil_eigenpairs(&a, &random(3, 1)), None);
        assert_eq!(real_pencil_eigenpairs(&a, &DMatrix::from_element(4, 4, f64::NAN)), None);
    }
}
