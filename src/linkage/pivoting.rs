//! Small complex linear systems that may have lost a rank.

use num_complex::Complex64;

/// A linear system solved.
pub(super) struct Solved {
    pub(super) solution: Vec<Complex64>,
    /// A vector that the matrix takes to nearly nothing, where it has lost a rank.
    pub(super) kernel: Option<Vec<Complex64>>,
}

/// Gauss elimination with complete pivoting; unknowns whose pivots fall below `rank` times the largest stay zero.
///
/// **Shape:** square, row by row. `None` for a matrix that is zero or not finite.
pub(super) fn solve(matrix: &mut [Complex64], right: &mut [Complex64], size: usize, rank: f64) -> Option<Solved> {
    let mut columns: Vec<usize> = (0..size).collect();
    let mut largest = 0.0;
    let mut kept = size;
    for k in 0..size {
        let mut best = (k, k, -1.0);
        for i in k..size {
            for j in k..size {
                let modulus = matrix[i * size + j].norm_sqr();
                if modulus > best.2 {
                    best = (i, j, modulus);
                }
            }
        }
        let (row, column, modulus) = (best.0, best.1, best.2.max(0.0).sqrt());
        if k == 0 {
            largest = modulus;
            if largest.is_nan() || largest <= 0.0 {
                return None;
            }
        }
        if modulus <= rank * largest {
            kept = k;
            break;
        }
        if row != k {
            for j in 0..size {
                matrix.swap(row * size + j, k * size + j);
            }
            right.swap(row, k);
        }
        if column != k {
            for i in 0..size {
                matrix.swap(i * size + column, i * size + k);
            }
            columns.swap(column, k);
        }
        let inverse = matrix[k * size + k].inv();
        for i in k + 1..size {
            let factor = matrix[i * size + k] * inverse;
            if factor == Complex64::ZERO {
                continue;
            }
            for j in k + 1..size {
                let entry = matrix[k * size + j];
                matrix[i * size + j] -= factor * entry;
            }
            let value = right[k];
            right[i] -= factor * value;
        }
    }
    let back = |value: &dyn Fn(usize) -> Complex64| {
        let mut found = vec![Complex64::ZERO; size];
        for k in (0..kept).rev() {
            let sum = (k + 1..kept).fold(value(k), |sum, j| sum - matrix[k * size + j] * found[columns[j]]);
            found[columns[k]] = sum / matrix[k * size + k];
        }
        found
    };
    let solution = back(&|k| right[k]);
    let kernel = (kept < size).then(|| {
        let mut kernel = back(&|k| -matrix[k * size + kept]);
        kernel[columns[kept]] = Complex64::ONE;
        kernel
    });
    Some(Solved { solution, kernel })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lost_rank_shows_as_a_kernel() {
        let c = |re: f64| Complex64::from(re);
        let mut regular = vec![c(0.0), c(2.0), c(4.0), c(1.0)];
        let solved = solve(&mut regular, &mut [c(6.0), c(7.0)], 2, 1e-6).expect("finite");
        assert!(solved.kernel.is_none());
        assert!((solved.solution[0] - 1.0).norm() < 1e-15 && (solved.solution[1] - 3.0).norm() < 1e-15);
        let mut singular = vec![c(1.0), c(2.0), c(2.0), c(4.0)];
        let solved = solve(&mut singular, &mut [c(1.0), c(2.0)], 2, 1e-6).expect("finite");
        let kernel = solved.kernel.expect("rank 1");
        assert!((kernel[0] + kernel[1] * 2.0).norm() < 1e-15);
    }
}
