//! Small dense linear systems over the complex numbers, on the stack.

use num_complex::Complex64;

/// A vector of unknowns.
pub type Vector<const N: usize> = [Complex64; N];

/// A square matrix, by rows.
pub type Matrix<const N: usize> = [[Complex64; N]; N];

/// A matrix split into triangles, rows exchanged for the largest pivot.
pub struct Factored<const N: usize> {
    /// Both triangles; the diagonal holds the inverse pivots.
    triangles: Matrix<N>,
    order: [usize; N],
}

impl<const N: usize> Factored<N> {
    /// Gaussian elimination; `None` if a pivot is zero or not finite.
    #[inline]
    pub fn new(mut m: Matrix<N>) -> Option<Self> {
        let mut order = [0; N];
        for (i, place) in order.iter_mut().enumerate() {
            *place = i;
        }
        for k in 0..N {
            let mut best = k;
            for i in k + 1..N {
                if m[i][k].norm_sqr() > m[best][k].norm_sqr() {
                    best = i;
                }
            }
            m.swap(k, best);
            order.swap(k, best);
            let size = m[k][k].norm_sqr();
            if !(size > 0.0 && size < f64::INFINITY) {
                return None;
            }
            let inverse = m[k][k].conj() / size;
            m[k][k] = inverse;
            let pivot = m[k];
            for row in &mut m[k + 1..] {
                let factor = row[k] * inverse;
                row[k] = factor;
                for j in k + 1..N {
                    row[j] -= factor * pivot[j];
                }
            }
        }
        Some(Self { triangles: m, order })
    }

    /// `x` with `m x = right`.
    #[inline]
    pub fn solve(&self, right: &Vector<N>) -> Vector<N> {
        let mut x = [Complex64::ZERO; N];
        for i in 0..N {
            x[i] = (0..i).fold(right[self.order[i]], |sum, j| sum - self.triangles[i][j] * x[j]);
        }
        for i in (0..N).rev() {
            x[i] = (i + 1..N).fold(x[i], |sum, j| sum - self.triangles[i][j] * x[j]) * self.triangles[i][i];
        }
        x
    }
}
