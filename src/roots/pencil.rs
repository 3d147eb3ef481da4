//! For which `x` is `M0 + x M1` singular, and what does it take to zero? A generalised eigenproblem, with vectors.
//!
//! Eigenvalues stay pairs `alpha / beta`, so that infinite ones are numbers like others. Rows are scaled by powers of two, the pair goes to
//! the QZ algorithm, and each eigenpair is judged by what it leaves of the pencil, since the routine does not say how well it did.
//! A pencil that is singular for every `x` has no eigenvalues; what comes out then is arbitrary and shows as poor residuals or not at all.
//!
//! Source: Moler, Stewart (1973), An algorithm for generalized matrix eigenvalue problems, SIAM J. Numer. Anal. 10, 241-256,
//! doi:10.1137/0710024; Tisseur (2000), Backward error and condition of polynomial eigenvalue problems, Linear Algebra Appl. 309, 339-361,
//! doi:10.1016/S0024-3795(99)00063-4.

use faer::Mat;
use num_complex::Complex64;
use thiserror::Error;

/// A value `alpha / beta` at which a pencil is singular, and a vector that it takes to zero there.
#[derive(Clone, Debug, PartialEq)]
pub struct Eigenpair {
    /// Numerator of the eigenvalue.
    pub alpha: Complex64,
    /// Denominator; zero at infinity.
    pub beta: Complex64,
    /// The vector, of length 1.
    pub vector: Vec<Complex64>,
    /// `|(beta M0 + alpha M1) v| / (|beta| |M0| + |alpha| |M1|)` with Frobenius norms, rows scaled.
    pub residual: f64,
}

/// The eigenpairs of a pencil.
#[derive(Clone, Debug, PartialEq)]
pub struct PencilEigenpairs {
    /// The pairs, in no particular order.
    pub pairs: Vec<Eigenpair>,
    /// How many more the routine gave that are not numbers, as it does for pencils that are singular everywhere.
    pub not_numbers: usize,
}

/// Why a pencil has no list of eigenpairs.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum PencilError {
    /// The matrices are not square and of one size.
    #[error("a pencil needs two square matrices of one size")]
    NotSquare,
    /// An entry is NaN or infinite.
    #[error("entry ({row}, {column}) must be finite, not {value}")]
    NotFinite {
        /// Row, from 0.
        row: usize,
        /// Column, from 0.
        column: usize,
        /// What was found.
        value: Complex64,
    },
    /// The QZ algorithm gave up.
    #[error("the eigenvalue iteration did not converge")]
    NoConvergence,
}

/// An eigenvalue closer to zero or infinity than this, relative, counts as lying there: rounding of the pencil moves those of multiple
/// structure that far and further, and no solution of interest is that extreme (heuristic, from sweeps over random pencils).
const EXTREME: f64 = 1e-12;

impl Eigenpair {
    /// The eigenvalue, where it is neither zero nor infinite to twelve digits.
    pub fn value(&self) -> Option<Complex64> {
        let (alpha, beta) = (self.alpha.norm(), self.beta.norm());
        (alpha > EXTREME * beta && beta > EXTREME * alpha).then(|| self.alpha / self.beta)
    }
}

/// All eigenpairs of `constant + x linear`.
///
/// **Shape:** rows of square matrices. **Accuracy:** for regular pencils residuals are a few roundings; for singular ones nothing is
/// promised, which is what the residuals are for. **Errors:** other shapes, numbers that are not finite, no convergence.
/// **Cost:** about `50 n^3` operations: 0.2 ms for size 20, 6 ms for size 70.
///
/// ```
/// use assur::{num_complex::Complex64, roots::pencil_eigenpairs};
/// let c = |re: f64| Complex64::from(re);
/// // diag(x - 2, 3x - 1)
/// let found = pencil_eigenpairs(
///     &[vec![c(-2.0), c(0.0)], vec![c(0.0), c(-1.0)]],
///     &[vec![c(1.0), c(0.0)], vec![c(0.0), c(3.0)]],
/// )?;
/// let mut values: Vec<f64> = found.pairs.iter().filter_map(|pair| Some(pair.value()?.re)).collect();
/// values.sort_by(f64::total_cmp);
/// assert!((values[0] - 1.0 / 3.0).abs() < 1e-15 && (values[1] - 2.0).abs() < 1e-15);
/// # Ok::<(), assur::roots::PencilError>(())
/// ```
pub fn pencil_eigenpairs(
    constant: &[Vec<Complex64>],
    linear: &[Vec<Complex64>],
) -> Result<PencilEigenpairs, PencilError> {
    let size = constant.len();
    if linear.len() != size || constant.iter().chain(linear).any(|row| row.len() != size) {
        return Err(PencilError::NotSquare);
    }
    for (row, (a, b)) in constant.iter().zip(linear).enumerate() {
        if let Some((column, value)) = a.iter().chain(b).enumerate().find(|(_, z)| !z.is_finite()) {
            return Err(PencilError::NotFinite { row, column: column % size, value: *value });
        }
    }
    if size == 0 {
        return Ok(PencilEigenpairs { pairs: Vec::new(), not_numbers: 0 });
    }
    if let ([row0], [row1]) = (constant, linear) {
        // faer 0.24.4 asks for too little scratch space at size 1 and panics.
        let (alpha, beta) = (-row0[0], row1[0]);
        let known = alpha != Complex64::ZERO || beta != Complex64::ZERO;
        let pair = Eigenpair { alpha, beta, vector: vec![Complex64::ONE], residual: 0.0 };
        return Ok(PencilEigenpairs {
            pairs: known.then_some(pair).into_iter().collect(),
            not_numbers: usize::from(!known),
        });
    }
    let scales: Vec<f64> = constant.iter().zip(linear).map(|(a, b)| row_scale(a.iter().chain(b))).collect();
    let m0 = Mat::from_fn(size, size, |i, j| constant[i][j] * scales[i]);
    let m1 = Mat::from_fn(size, size, |i, j| linear[i][j] * scales[i]);
    let negated = Mat::from_fn(size, size, |i, j| -m0[(i, j)]);
    // Always with vectors: faer's call for values alone gave wrong and non-finite ones (0.24.4).
    let eigen = negated.generalized_eigen(&m1).map_err(|_| PencilError::NoConvergence)?;
    let (vectors, alphas, betas) = (eigen.U(), eigen.S_a().column_vector(), eigen.S_b().column_vector());
    let (norm0, norm1) = (m0.norm_l2(), m1.norm_l2());
    let mut pairs = Vec::with_capacity(size);
    for k in 0..size {
        let (alpha, beta) = (alphas[k], betas[k]);
        let column = vectors.col(k);
        let length = column.norm_l2();
        if !(alpha.is_finite() && beta.is_finite() && length.is_finite() && length > 0.0)
            || (alpha == Complex64::ZERO && beta == Complex64::ZERO)
        {
            continue;
        }
        let vector: Vec<Complex64> = column.iter().map(|z| z / length).collect();
        let mut square = 0.0;
        for i in 0..size {
            let mut sum = Complex64::ZERO;
            for (j, v) in vector.iter().enumerate() {
                sum += (beta * m0[(i, j)] + alpha * m1[(i, j)]) * v;
            }
            square += sum.norm_sqr();
        }
        let residual = square.sqrt() / (beta.norm() * norm0 + alpha.norm() * norm1);
        if residual.is_finite() {
            pairs.push(Eigenpair { alpha, beta, vector, residual });
        }
    }
    let not_numbers = size - pairs.len();
    Ok(PencilEigenpairs { pairs, not_numbers })
}

/// The power of two that brings the largest entry of a row near one: exact, and no row drowns beside another.
fn row_scale<'a>(row: impl Iterator<Item = &'a Complex64>) -> f64 {
    let largest = row.map(|z| z.re.abs().max(z.im.abs())).fold(0.0, f64::max);
    // Far from one, `exp2` would leave the range of f64.
    if largest > 0.0 { (-largest.log2().round()).clamp(-1000.0, 1000.0).exp2() } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(size: usize, seed: u64) -> Vec<Vec<Complex64>> {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        (0..size).map(|_| (0..size).map(|_| Complex64::new(next(), next())).collect()).collect()
    }

    #[test]
    fn random_pencils_of_every_size_leave_small_residuals() {
        for size in [1, 2, 3, 4, 5, 6, 20, 70] {
            let found = pencil_eigenpairs(&random(size, 1), &random(size, 2)).expect("finite");
            assert_eq!((found.pairs.len(), found.not_numbers), (size, 0));
            let worst = found.pairs.iter().map(|pair| pair.residual).fold(0.0, f64::max);
            assert!(worst < 1e-13, "size {size}: {worst:e}");
            // The sum of the eigenvalues is the trace of -M1^-1 M0; here only that all are finite and distinct.
            assert!(found.pairs.iter().all(|pair| pair.value().is_some()));
        }
    }

    #[test]
    fn infinite_eigenvalues_are_pairs_with_zero_below() {
        let c = |re: f64| Complex64::from(re);
        let zero = vec![c(0.0), c(0.0)];
        let found =
            pencil_eigenpairs(&[vec![c(1.0), c(0.0)], vec![c(0.0), c(-4.0)]], &[zero.clone(), vec![c(0.0), c(2.0)]]);
        let values: Vec<_> = found.expect("finite").pairs.iter().filter_map(Eigenpair::value).collect();
        assert!(values.len() == 1 && (values[0] - 2.0).norm() < 1e-15, "{values:?}");
    }

    #[test]
    fn badly_scaled_rows_lose_nothing() {
        let (mut m0, mut m1) = (random(6, 3), random(6, 4));
        let plain = pencil_eigenpairs(&m0, &m1).expect("finite");
        for (k, row) in m0.iter_mut().chain(&mut m1).enumerate() {
            row.iter_mut().for_each(|z| *z *= 2f64.powi(100 * (k as i32 % 6) - 250));
        }
        let scaled = pencil_eigenpairs(&m0, &m1).expect("finite");
        for pair in &plain.pairs {
            let x = pair.value().expect("is finite");
            let nearest = scaled.pairs.iter().filter_map(Eigenpair::value).map(|y| (y - x).norm());
            assert!(nearest.fold(f64::INFINITY, f64::min) < 1e-12 * x.norm());
        }
    }

    #[test]
    fn bad_matrices_are_refused() {
        let one = vec![vec![Complex64::ONE]];
        assert_eq!(pencil_eigenpairs(&one, &[]), Err(PencilError::NotSquare));
        let nan = vec![vec![Complex64::new(f64::NAN, 0.0)]];
        assert!(matches!(pencil_eigenpairs(&one, &nan), Err(PencilError::NotFinite { .. })));
    }
}
