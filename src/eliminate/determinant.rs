//! Exact determinants, three ways.
//!
//! Bareiss eliminates without fractions: every division is exact, because each intermediate entry is a minor. Interpolation
//! evaluates a matrix of polynomials at small integers, takes the determinant of numbers, and rebuilds the polynomial from its
//! values; Newton's divided differences at integer nodes stay in the coefficient ring, so this too needs no fractions.
//! The expansion by minors is the definition; it serves tests and sizes up to three.
//!
//! Source: Bareiss (1968), Math. Comp. 22, 565-578, doi:10.1090/S0025-5718-1968-0226829-0.

use crate::algebra::{Domain, Ring, UPoly};

/// The determinant by fraction-free elimination.
///
/// **Shape:** square, row by row; the empty matrix has determinant 1. **Proof:** exact. **Cost:** about `2n³/3` products and `n³/3`
/// exact divisions; sizes up to 3 are expanded instead.
///
/// ```
/// use assur::{algebra::Integer, eliminate::determinant_bareiss};
/// let matrix = [[0, 2, 1, 0], [1, 1, 0, 0], [3, 0, 1, 2], [0, 0, 5, 1]].map(|row| row.map(Integer::from).to_vec());
/// assert_eq!(determinant_bareiss(matrix.to_vec()), Integer::from(15));
/// ```
pub fn determinant_bareiss<R: Domain>(mut matrix: Vec<Vec<R>>) -> R {
    let size = matrix.len();
    if size <= 3 {
        return determinant_expanded(&matrix);
    }
    let mut negative = false;
    let mut previous: Option<R> = None;
    for k in 0..size - 1 {
        let Some(pivot_row) = (k..size).find(|&i| !matrix[i][k].is_zero()) else {
            return R::zero();
        };
        if pivot_row != k {
            matrix.swap(pivot_row, k);
            negative = !negative;
        }
        let (upper, lower) = matrix.split_at_mut(k + 1);
        let top = &upper[k];
        let pivot = &top[k];
        for row in lower {
            let factor = row[k].clone();
            for j in k + 1..size {
                let raised = row[j].clone() * pivot.clone();
                let minor = if factor.is_zero() { raised } else { raised - factor.clone() * top[j].clone() };
                row[j] = match &previous {
                    None => minor,
                    Some(divisor) => minor
                        .exact_div(divisor)
                        .expect("Bareiss: the previous pivot divides every minor of the next order"),
                };
            }
        }
        previous = Some(pivot.clone());
    }
    let last = matrix.pop().and_then(|mut row| row.pop()).expect("a matrix of size four or more has a last entry");
    if negative { -last } else { last }
}

/// The determinant of a matrix of polynomials in one variable, by evaluation at `0, 1, -1, 2, -2, …` and interpolation.
///
/// **Shape:** square, row by row. **Proof:** exact. **Cost:** one [`determinant_bareiss`] over the coefficients per point, one
/// point more than [`determinant_degree_bound`].
///
/// ```
/// use assur::{algebra::{Integer, Ring, UPoly}, eliminate::determinant_interpolated};
/// let x = UPoly::<Integer>::variable();
/// let matrix = vec![vec![x.clone(), UPoly::one()], vec![UPoly::one(), x.clone()]];
/// assert_eq!(determinant_interpolated(&matrix), x.power(2) - UPoly::one());
/// ```
pub fn determinant_interpolated<R: Domain>(matrix: &[Vec<UPoly<R>>]) -> UPoly<R> {
    let Some(bound) = determinant_degree_bound(matrix, |entry| entry.degree()) else {
        return UPoly::zero();
    };
    let values = (0..=bound).map(|k| {
        let x = R::from_int(node(k));
        determinant_bareiss(matrix.iter().map(|row| row.iter().map(|entry| entry.evaluate(&x)).collect()).collect())
    });
    let mut sum = UPoly::zero();
    for (k, difference) in divided_differences(values.collect()).into_iter().enumerate().rev() {
        sum = sum * UPoly::new(vec![-R::from_int(node(k)), R::one()]) + UPoly::constant(difference);
    }
    sum
}

/// The determinant by expansion along the first row, its minors likewise.
///
/// The clear version, for any ring: no division. **Cost:** about `n!` products, fewer where entries are zero.
///
/// ```
/// use assur::eliminate::determinant_expanded;
/// assert_eq!(determinant_expanded(&[vec![1.0, 2.0], vec![3.0, 4.0]]), -2.0);
/// ```
pub fn determinant_expanded<R: Ring>(matrix: &[Vec<R>]) -> R {
    match matrix {
        [] => R::one(),
        [a] => a[0].clone(),
        [a, b] => a[0].clone() * b[1].clone() - a[1].clone() * b[0].clone(),
        [first, rest @ ..] => {
            let zero = R::zero();
            let mut sum = R::zero();
            for (j, entry) in first.iter().enumerate().filter(|(_, entry)| **entry != zero) {
                let minor: Vec<Vec<R>> = rest.iter().map(|row| [&row[..j], &row[j + 1..]].concat()).collect();
                let product = entry.clone() * determinant_expanded(&minor);
                sum = if j % 2 == 0 { sum + product } else { sum - product };
            }
            sum
        }
    }
}

/// The largest degree the determinant can have, from the degrees of the entries alone (`None`: a zero entry); `None` where the
/// pattern of zeros makes it vanish.
///
/// The heaviest choice of one entry per row and column. For a Sylvester matrix of a graded system this is the weight count, below
/// both the sum of row degrees and the sum of column degrees. **Cost:** `n·2^n`; from size 17 on those two sums are used.
///
/// ```
/// use assur::eliminate::determinant_degree_bound;
/// let degrees = [vec![Some(2), Some(0)], vec![Some(1), Some(1)]];
/// assert_eq!(determinant_degree_bound(&degrees, |&d| d), Some(3));
/// ```
pub fn determinant_degree_bound<E>(matrix: &[Vec<E>], degree: impl Fn(&E) -> Option<usize>) -> Option<usize> {
    const EXHAUSTIVE_SIZE: usize = 16;
    let degrees: Vec<Vec<Option<usize>>> = matrix.iter().map(|row| row.iter().map(&degree).collect()).collect();
    let size = degrees.len();
    if size > EXHAUSTIVE_SIZE {
        let rows = degrees.iter().map(|row| row.iter().flatten().max().copied()).sum::<Option<usize>>();
        let columns = (0..size).map(|j| degrees.iter().filter_map(|row| row[j]).max()).sum::<Option<usize>>();
        return rows.zip(columns).map(|(r, c)| r.min(c));
    }
    // best[set] = heaviest way to give the first rows the columns of the set.
    let mut best: Vec<Option<usize>> = vec![None; 1 << size];
    best[0] = Some(0);
    for set in 1usize..1 << size {
        let row = &degrees[set.count_ones() as usize - 1];
        let last_columns = (0..size).filter(|j| set >> j & 1 == 1);
        best[set] = last_columns.filter_map(|j| Some(best[set & !(1 << j)]? + row[j]?)).max();
    }
    best[(1 << size) - 1]
}

/// The `k`-th node: 0, 1, -1, 2, -2, …
pub(super) fn node(k: usize) -> i64 {
    let half = k.div_ceil(2) as i64;
    if k % 2 == 1 { half } else { -half }
}

/// Newton's coefficients of the polynomial through `values` at the nodes.
///
/// The divided differences of a power at integers are complete symmetric functions of them, hence integers: the divisions are exact.
pub(super) fn divided_differences<R: Domain>(mut values: Vec<R>) -> Vec<R> {
    for order in 1..values.len() {
        for k in (order..values.len()).rev() {
            let gap = R::from_int(node(k) - node(k - order));
            values[k] = (values[k].clone() - values[k - 1].clone())
                .exact_div(&gap)
                .expect("divided differences of a polynomial at integers lie in its ring");
        }
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Integer;
    use proptest::prelude::*;

    fn square(size: usize, degree: usize) -> impl Strategy<Value = Vec<Vec<UPoly<Integer>>>> {
        // Small entries, many zeros: pivots must be looked for.
        let entry = prop::collection::vec(prop_oneof![Just(0i64), -3i64..4], 0..=degree + 1);
        let entry = entry.prop_map(|c| UPoly::new(c.into_iter().map(Integer::from).collect()));
        prop::collection::vec(prop::collection::vec(entry, size), size)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn three_algorithms_agree(matrix in (0usize..6, 0usize..3).prop_flat_map(|(n, d)| square(n, d))) {
            let expanded = determinant_expanded(&matrix);
            prop_assert_eq!(&determinant_bareiss(matrix.clone()), &expanded);
            prop_assert_eq!(&determinant_interpolated(&matrix), &expanded);
        }

        #[test]
        fn product_of_determinants(a in square(4, 0), b in square(4, 0)) {
            let product: Vec<Vec<_>> = a.iter().map(|row| (0..4).map(|j| {
                (0..4).fold(UPoly::zero(), |sum, k| sum + row[k].clone() * b[k][j].clone())
            }).collect()).collect();
            prop_assert_eq!(determinant_bareiss(product), determinant_bareiss(a) * determinant_bareiss(b));
        }
    }

    #[test]
    fn exchanging_rows_changes_the_sign() {
        let rows = [[0, 0, 0, 1], [0, 0, 1, 0], [0, 1, 0, 0], [1, 0, 0, 0]].map(|r| r.map(Integer::from).to_vec());
        let mut rows = rows.to_vec();
        assert_eq!(determinant_bareiss(rows.clone()), Integer::ONE);
        rows.swap(1, 3);
        assert_eq!(determinant_bareiss(rows), Integer::from(-1));
    }

    #[test]
    fn nodes_are_distinct_and_small() {
        assert_eq!((0..5).map(node).collect::<Vec<_>>(), [0, 1, -1, 2, -2]);
    }
}
