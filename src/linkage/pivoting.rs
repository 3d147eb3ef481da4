//! Small complex linear systems that may have lost a rank, solved without allocation.

use arrayvec::ArrayVec;
use num_complex::Complex64;

/// The largest system: five loops, taken twice.
pub(super) const MOST_UNKNOWNS: usize = 10;

/// Numbers of a small system.
pub(super) type Small = ArrayVec<Complex64, MOST_UNKNOWNS>;

/// A linear system solved.
pub(super) struct Solved {
    pub(super) solution: Small,
    /// A vector that the matrix takes to nearly nothing, where it has lost a rank.
    pub(super) kernel: Option<Small>,
}

/// Gauss elimination with complete pivoting; unknowns whose pivots fall below `rank` times the largest stay zero.
///
/// **Shape:** square, row by row, at most [`MOST_UNKNOWNS`] wide. `None` for a matrix that is zero or not finite.
pub(super) fn solve(matrix: &mut [Complex64], right: &mut [Complex64], size: usize, rank: f64) -> Option<Solved> {
    assert!(size <= MOST_UNKNOWNS, "systems are small");
    let mut columns: [usize; MOST_UNKNOWNS] = std::array::from_fn(|k| k);
    let mut largest = 0.0;
    let mut kept = size;
    for k in 0..size {
        let mut best = (k, k, -1.0);
        for i in k..size {
            for (j, entry) in matrix[i * size..(i + 1) * size].iter().enumerate().skip(k) {
                let square = entry.norm_sqr();
                if square > best.2 {
                    best = (i, j, square);
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
            let (above, below) = matrix.split_at_mut(row * size);
            above[k * size..(k + 1) * size].swap_with_slice(&mut below[..size]);
            right.swap(row, k);
        }
        if column != k {
            for i in 0..size {
                matrix.swap(i * size + column, i * size + k);
            }
            columns.swap(column, k);
        }
        let inverse = matrix[k * size + k].inv();
        let (above, below) = matrix.split_at_mut((k + 1) * size);
        let above = &above[k * size + k + 1..];
        for (i, row) in (k + 1..).zip(below.chunks_exact_mut(size)) {
            if row[k] == Complex64::ZERO {
                continue;
            }
            let factor = row[k] * inverse;
            for (entry, top) in row[k + 1..].iter_mut().zip(above) {
                *entry -= factor * top;
            }
            let value = right[k];
            right[i] -= factor * value;
        }
    }
    let back = |value: &dyn Fn(usize) -> Complex64| {
        let mut found: Small = std::iter::repeat_n(Complex64::ZERO, size).collect();
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

/// The modulus, for numbers whose squares stay within range: several times as fast as `hypot`.
pub(super) fn modulus(z: Complex64) -> f64 {
    z.norm_sqr().sqrt()
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
