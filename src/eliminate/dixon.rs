//! How do several unknowns leave a system that is linear in them and in their inverses? Through a Dixon matrix, linear in the last one.
//!
//! Given are `l` equations `c_0 + c_h x + sum_j c_j t_j = 0` and `l` equations `d_0 + d_h / x + sum_j d_j / t_j = 0` in `x` and the
//! `N = 2l - 1` others `t_j`; `c` and `d` are columns of `l` numbers. A determinant with the columns `c_I` of `l - 1` chosen unknowns
//! removes those from the first equations; multiplied by `t^I = prod_{i in I} t_i` what is left is linear in the products
//! `u_I = t^I, |I| = l - 1` and `w_I = t^I, |I| = l`. The second equations likewise. Row by row:
//!
//! ```text
//! |I| = l-1:            (det[c_0, c_I] + x det[c_h, c_I]) u_I + sum_{j not in I} det[c_j, c_I] w_{I+j} = 0
//! |I| = l, J the rest:  (x det[d_0, d_J] + det[d_h, d_J]) w_I + x sum_{j in I} det[d_j, d_J] u_{I-j} = 0
//! ```
//!
//! That is `(M0 + x M1) v = 0` of size `C(2l, l)`: 2, 6, 20, 70. A solution makes `v` a kernel vector, and quotients of its entries are the
//! other unknowns. The converse fails: `x = 0`, `x = infinity` and a few finite values may be eigenvalues without a solution, so
//! whoever uses the pencil checks what it lifts. For special numbers the determinant may vanish for every `x`; another choice of `x` then
//! helps, or none does.
//!
//! Source: Nielsen, Roth (1999), Solving the input/output problem for planar mechanisms, J. Mech. Des. 121, 206-211,
//! doi:10.1115/1.2829445; Wampler (2001), Solving the kinematics of planar mechanisms by Dixon determinant and a complex-plane
//! formulation, J. Mech. Des. 123, 382-387, doi:10.1115/1.1372192.

use nalgebra::DMatrix;
use num_complex::Complex64;
use thiserror::Error;

use crate::algebra::Ring;

/// A matrix pencil `M0 + x M1` in which every unknown but `x` has been eliminated.
///
/// ```
/// use assur::eliminate::DixonPencil;
/// // 3 - 2x - t = 0 and 3 - 2/x - 1/t = 0: x = t = 1 is a solution.
/// let pencil = DixonPencil::new(&[vec![3.0, -2.0, -1.0]], &[vec![3.0, -2.0, -1.0]])?;
/// let row = |k: usize| (0..2).map(|j| pencil.constant()[k][j] + pencil.linear()[k][j]).sum::<f64>();
/// assert_eq!([row(0), row(1)], [0.0, 0.0]);
/// # Ok::<(), assur::eliminate::DixonShapeError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct DixonPencil<R> {
    equations: usize,
    /// The products of unknowns that the columns stand for, bit `j` for unknown `j`: first `l - 1` bits each, then `l`.
    monomials: Vec<u32>,
    constant: Vec<Vec<R>>,
    linear: Vec<Vec<R>>,
}

/// The coefficients do not have the shape of `l` equations in `2l` unknowns, twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "{upper} and {lower} equations with {columns} coefficients: l equations each way need 2l + 1 coefficients, l from 1 to {}",
    MOST_EQUATIONS
)]
pub struct DixonShapeError {
    /// Equations in the unknowns.
    pub upper: usize,
    /// Equations in their inverses.
    pub lower: usize,
    /// Coefficients of the first equation whose number is wrong, or of the first.
    pub columns: usize,
}

/// Beyond this the pencil (1716 rows) is no longer a sensible question.
const MOST_EQUATIONS: usize = 6;

impl<R: Ring> DixonPencil<R> {
    /// The pencil of two systems, given by their coefficients.
    ///
    /// **Shape:** one row an equation: the constant, the coefficient of `x` (of `1/x` in `lower`), then of each other unknown (its
    /// inverse). **Errors:** any other shape. **Cost:** `2^(2l+1)` minors, by expansion along the last row, and the matrices.
    pub fn new(upper: &[Vec<R>], lower: &[Vec<R>]) -> Result<Self, DixonShapeError> {
        let l = upper.len();
        let columns = 2 * l + 1;
        let wrong = upper.iter().chain(lower).find(|row| row.len() != columns);
        if !(1..=MOST_EQUATIONS).contains(&l) || lower.len() != l || wrong.is_some() {
            let columns = wrong.or(upper.first()).map_or(0, Vec::len);
            return Err(DixonShapeError { upper: l, lower: lower.len(), columns });
        }
        let others = 2 * l - 1;
        let of_size = |size: usize| (0..1u32 << others).filter(move |set| set.count_ones() as usize == size);
        let monomials: Vec<u32> = of_size(l - 1).chain(of_size(l)).collect();
        let mut place = vec![usize::MAX; 1 << others];
        for (k, &set) in monomials.iter().enumerate() {
            place[set as usize] = k;
        }
        let size = monomials.len();
        let (c, d) = (minors(upper), minors(lower));
        let mut constant = vec![vec![R::zero(); size]; size];
        let mut linear = constant.clone();
        let everything = (1u32 << others) - 1;
        for (row, &set) in monomials.iter().enumerate() {
            if (set.count_ones() as usize) < l {
                // Unknown j has bit j + 2 among the columns, after the constant and x.
                constant[row][row] = determinant(&c, 0, set << 2);
                linear[row][row] = determinant(&c, 1, set << 2);
                for j in bits(everything & !set) {
                    constant[row][place[(set | 1 << j) as usize]] = determinant(&c, j + 2, set << 2);
                }
            } else {
                let rest = (everything & !set) << 2;
                linear[row][row] = determinant(&d, 0, rest);
                constant[row][row] = determinant(&d, 1, rest);
                for j in bits(set) {
                    linear[row][place[(set & !(1 << j)) as usize]] = determinant(&d, j + 2, rest);
                }
            }
        }
        Ok(Self { equations: l, monomials, constant, linear })
    }

    /// `M0`, row by row.
    pub fn constant(&self) -> &[Vec<R>] {
        &self.constant
    }

    /// `M1`, row by row.
    pub fn linear(&self) -> &[Vec<R>] {
        &self.linear
    }

    /// The products that the columns stand for: bit `j` where the other unknown `j` is a factor.
    pub fn monomials(&self) -> &[u32] {
        &self.monomials
    }

    /// The other unknowns that a kernel vector stands for, each as a quotient of entries over the largest there is.
    ///
    /// `None` where an entry is not finite or a divisor is zero. Nothing is checked: an eigenvalue that belongs to no solution lifts to
    /// numbers that satisfy no equation.
    pub fn unknowns(&self, vector: &[Complex64]) -> Option<Vec<Complex64>> {
        let lower = self.monomials.iter().take_while(|set| (set.count_ones() as usize) < self.equations).count();
        let value = |j: usize| {
            let without = (0..lower).filter(|&k| self.monomials[k] >> j & 1 == 0);
            let k = without.max_by(|&a, &b| vector[a].norm_sqr().total_cmp(&vector[b].norm_sqr()))?;
            let with = self.monomials[k] | 1 << j;
            let place = lower + self.monomials[lower..].binary_search(&with).ok()?;
            let quotient = vector[place] / vector[k];
            (quotient.is_finite() && quotient != Complex64::ZERO).then_some(quotient)
        };
        (0..2 * self.equations - 1).map(value).collect()
    }
}

/// The pencil of a system whose lower coefficients are the conjugates of its upper ones, as that of real loops are, in a real parameter.
///
/// With `x = (1 + it) / (1 - it)` real `t` are the points of the unit circle. Conjugation then exchanges the row of a set with that of the
/// rest, and an entry of a kernel vector with that of the rest; so the rows of one half, split into real and imaginary parts,
/// say everything, in the sums and differences of paired entries: a real pencil of the same size, whose eigenvalues are real or
/// conjugate in pairs.
#[derive(Clone, Debug, PartialEq)]
pub struct RealDixonPencil {
    /// Column of the set that complements each of the first half.
    partners: Vec<usize>,
    /// `A` of `A + t B`.
    pub constant: DMatrix<f64>,
    /// `B`.
    pub linear: DMatrix<f64>,
}

impl DixonPencil<Complex64> {
    /// The pencil in `t`, `x = (1 + it) / (1 - it)`. Meant for `lower` conjugate to `upper`, which is not checked.
    ///
    /// ```
    /// use assur::{eliminate::DixonPencil, num_complex::Complex64};
    /// // 1 - 2x + ct = 0 with |c| = sqrt(5) and the conjugate of it: x = i, so t = 1, is a solution.
    /// let c = |re, im| Complex64::new(re, im);
    /// let upper = [vec![c(1.0, 0.0), c(-2.0, 0.0), c(-1.0, 2.0)]];
    /// let lower = [vec![c(1.0, 0.0), c(-2.0, 0.0), c(-1.0, -2.0)]];
    /// let pencil = DixonPencil::new(&upper, &lower)?.on_unit_circle();
    /// assert!((&pencil.constant + &pencil.linear).determinant().abs() < 1e-14);
    /// # Ok::<(), assur::eliminate::DixonShapeError>(())
    /// ```
    pub fn on_unit_circle(&self) -> RealDixonPencil {
        let size = self.monomials.len();
        let half = size / 2;
        let everything = (1u32 << (2 * self.equations - 1)) - 1;
        let partner = |set: &u32| self.monomials[half..].binary_search(&(everything & !set)).map(|place| half + place);
        let partners: Vec<usize> =
            self.monomials[..half].iter().map(|set| partner(set).expect("every set of l is listed")).collect();
        let (mut constant, mut linear) = (DMatrix::zeros(size, size), DMatrix::zeros(size, size));
        for row in 0..half {
            let (m0, m1) = (&self.constant[row], &self.linear[row]);
            for (column, &other) in partners.iter().enumerate() {
                // (1 - it) M0 + (1 + it) M1, entries p + iq and p - iq.
                let sum = |k: usize| m0[k] + m1[k];
                let turned = |k: usize| Complex64::I * (m1[k] - m0[k]);
                for (matrix, here, there) in
                    [(&mut constant, sum(column), sum(other)), (&mut linear, turned(column), turned(other))]
                {
                    let (p, q) = (here + there, Complex64::I * (here - there));
                    matrix[(row, column)] = p.re;
                    matrix[(half + row, column)] = p.im;
                    matrix[(row, half + column)] = q.re;
                    matrix[(half + row, half + column)] = q.im;
                }
            }
        }
        RealDixonPencil { partners, constant, linear }
    }
}

impl RealDixonPencil {
    /// The kernel vector of the complex pencil that belongs to one of this.
    pub fn entries(&self, vector: &[Complex64]) -> Vec<Complex64> {
        let half = self.partners.len();
        let mut entries = vec![Complex64::ZERO; 2 * half];
        for (column, &other) in self.partners.iter().enumerate() {
            let (p, q) = (vector[column], Complex64::I * vector[half + column]);
            entries[column] = p + q;
            entries[other] = p - q;
        }
        entries
    }
}

/// Minors of the first rows: entry `set` belongs to as many rows as `set` has columns, columns in ascending order.
fn minors<R: Ring>(rows: &[Vec<R>]) -> Vec<R> {
    let columns = rows[0].len();
    let mut found = vec![R::zero(); 1 << columns];
    found[0] = R::one();
    for set in 1..1usize << columns {
        let size = set.count_ones() as usize;
        if size > rows.len() {
            continue;
        }
        // Expansion along the last row: the column with k columns of the set behind it has sign (-1)^k.
        let mut sum = R::zero();
        for j in bits(set as u32) {
            let term = rows[size - 1][j].clone() * found[set & !(1 << j)].clone();
            let behind = (set >> (j + 1)).count_ones();
            sum = if behind.is_multiple_of(2) { sum + term } else { sum - term };
        }
        found[set] = sum;
    }
    found
}

/// `det[column, set]`: the extra column first, those of the set in ascending order.
fn determinant<R: Ring>(minors: &[R], column: usize, set: u32) -> R {
    let minor = minors[(set | 1 << column) as usize].clone();
    let passed = (set & ((1 << column) - 1)).count_ones();
    if passed.is_multiple_of(2) { minor } else { -minor }
}

fn bits(set: u32) -> impl Iterator<Item = usize> {
    (0..32).filter(move |&j| set >> j & 1 == 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{Rational, Ring};

    fn q(n: i64) -> Rational {
        Rational::from_int(n)
    }

    /// Equations with small integer coefficients and the solution `x = 2`, `t_j = j + 3`, by choice of the constants.
    fn planted(l: usize) -> [Vec<Vec<Rational>>; 2] {
        let mut seed = 7i64;
        let mut next = || {
            seed = (seed * 1103 + 577) % 10_007;
            seed % 19 - 9
        };
        let values: Vec<Rational> = std::iter::once(q(2)).chain((0..2 * l as i64 - 1).map(|j| q(j + 3))).collect();
        let mut system = |inverse: bool| {
            let row = |_| {
                let mut row: Vec<Rational> = (0..2 * l).map(|_| q(next())).collect();
                let value = |v: &Rational| if inverse { q(1) / v.clone() } else { v.clone() };
                let sum = row.iter().zip(&values).fold(q(0), |sum, (c, v)| sum + c.clone() * value(v));
                row.insert(0, -sum);
                row
            };
            (0..l).map(row).collect::<Vec<_>>()
        };
        [system(false), system(true)]
    }

    #[test]
    fn a_planted_solution_lies_in_the_kernel_exactly() {
        for (l, size) in [(1, 2), (2, 6), (3, 20), (4, 70)] {
            let [upper, lower] = planted(l);
            let pencil = DixonPencil::new(&upper, &lower).expect("the shape is right");
            assert_eq!(pencil.monomials().len(), size);
            let product = |set: &u32| bits(*set).fold(q(1), |p, j| p * q(j as i64 + 3));
            let vector: Vec<Rational> = pencil.monomials().iter().map(product).collect();
            for (m0, m1) in pencil.constant().iter().zip(pencil.linear()) {
                let entry =
                    |((a, b), v): ((&Rational, &Rational), &Rational)| (a.clone() + q(2) * b.clone()) * v.clone();
                assert_eq!(m0.iter().zip(m1).zip(&vector).map(entry).fold(q(0), |sum, term| sum + term), q(0));
            }
            let floats: Vec<Complex64> =
                vector.iter().map(|v| Complex64::new(crate::algebra::nearest_f64(v), 0.0)).collect();
            let unknowns = pencil.unknowns(&floats).expect("no entry is zero");
            assert!((0..).zip(&unknowns).all(|(j, t)| (t - (f64::from(j) + 3.0)).norm() < 1e-12), "{unknowns:?}");
        }
    }

    #[test]
    fn other_shapes_are_refused() {
        let error = DixonPencil::new(&[vec![1.0, 2.0]], &[vec![1.0, 2.0, 3.0]]).unwrap_err();
        assert_eq!(error.columns, 2);
        assert!(DixonPencil::<f64>::new(&[], &[]).is_err());
    }
}
