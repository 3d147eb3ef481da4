//! The resultant of two polynomials in one of their variables.
//!
//! It vanishes where the two share a root (or, at formal degrees, where both lose their leading coefficient). [`resultant`]
//! chooses the algorithm; the two choices give the same polynomial.

use super::determinant::{determinant_bareiss, determinant_degree_bound, divided_differences, node};
use super::sylvester::{FormalDegreeTooLow, SylvesterMatrix};
use crate::algebra::{Domain, Poly, Ring, UPoly};

/// Sylvester size from which evaluation and interpolation answer, where two or more variables are left.
///
/// Dense integer polynomials of 25 to 400 bits, best of five, on a busy two-core machine (`benches/elimination.rs` has both sides): with
/// two variables left fraction-free elimination is faster by 4 to 6 at size 4 and by 1.6 to 5 at size 6; at size 8 the two are within
/// 40 %, interpolation ahead with 25 and with 400 bits. With one variable left elimination was never slower by more than 6 %, up to size 10.
const INTERPOLATED_SIZE: usize = 8;

/// The resultant in `variable`, at the actual degrees: a polynomial in the other variables.
///
/// **Proof:** exact. `res(f, g)` is the determinant of the [`SylvesterMatrix`] with `f` above `g`, hence
/// `res(g, f) = (-1)^(mn) res(f, g)`. If one polynomial is zero, so is the resultant, unless the other is constant in the variable.
///
/// ```
/// use assur::{algebra::{Integer, Poly, Ring}, eliminate::resultant};
/// let [x, y] = [0, 1].map(Poly::<Integer>::variable);
/// let circle = x.power(2) + y.power(2) - Poly::from_int(25);
/// let line = x - y.clone() - Poly::one();
/// // Left in y: 2y² + 2y - 24, at the intersections (4, 3) and (-3, -4).
/// let expected = Poly::from_int(2) * (y.clone() - Poly::from_int(3)) * (y + Poly::from_int(4));
/// assert_eq!(resultant(&circle, &line, 0), expected);
/// ```
pub fn resultant<R: Domain>(f: &Poly<R>, g: &Poly<R>, variable: usize) -> Poly<R> {
    choose(actual_matrix(f, g, variable))
}

/// The resultant in `variable` at formal degrees, of which actual ones may fall short.
///
/// # Errors
/// A formal degree below the actual one.
///
/// ```
/// use assur::{algebra::{Integer, Poly, Ring}, eliminate::resultant_formal};
/// let [x, y] = [0, 1].map(Poly::<Integer>::variable);
/// // Seen as 0·x² + y·x - 1, it meets x - 2 with the factor that a missing degree brings: the leading coefficient of x - 2.
/// let f = y.clone() * x.clone() - Poly::one();
/// let res = resultant_formal(&f, &(x - Poly::from_int(2)), 0, (2, 1)).unwrap();
/// assert_eq!(res, Poly::from_int(2) * y - Poly::one());
/// ```
pub fn resultant_formal<R: Domain>(
    f: &Poly<R>,
    g: &Poly<R>,
    variable: usize,
    degrees: (u32, u32),
) -> Result<Poly<R>, FormalDegreeTooLow> {
    Ok(choose(SylvesterMatrix::in_variable(("f", f), ("g", g), (variable, "v"), degrees)?))
}

/// [`resultant`] by fraction-free elimination on the polynomials themselves.
///
/// ```
/// use assur::{algebra::{Integer, Poly, Ring}, eliminate::resultant_bareiss};
/// let [x, y] = [0, 1].map(Poly::<Integer>::variable);
/// assert_eq!(resultant_bareiss(&(x.power(2) - y.clone()), &(x - Poly::from_int(3)), 0), Poly::from_int(9) - y);
/// ```
pub fn resultant_bareiss<R: Domain>(f: &Poly<R>, g: &Poly<R>, variable: usize) -> Poly<R> {
    bareiss(actual_matrix(f, g, variable).into_rows())
}

/// [`resultant`] by evaluating the other variables at small integers, elimination on numbers and interpolation.
///
/// ```
/// use assur::{algebra::{Integer, Poly, Ring}, eliminate::resultant_interpolated};
/// let [x, y] = [0, 1].map(Poly::<Integer>::variable);
/// assert_eq!(resultant_interpolated(&(x.power(2) - y.clone()), &(x - Poly::from_int(3)), 0), Poly::from_int(9) - y);
/// ```
pub fn resultant_interpolated<R: Domain>(f: &Poly<R>, g: &Poly<R>, variable: usize) -> Poly<R> {
    interpolated(actual_matrix(f, g, variable).rows())
}

fn actual_matrix<R: Domain>(f: &Poly<R>, g: &Poly<R>, variable: usize) -> SylvesterMatrix<Poly<R>> {
    let degrees = (f.degree_in(variable), g.degree_in(variable));
    SylvesterMatrix::in_variable(("f", f), ("g", g), (variable, "v"), degrees)
        .expect("the actual degrees are no lower than themselves")
}

fn choose<R: Domain>(matrix: SylvesterMatrix<Poly<R>>) -> Poly<R> {
    let several_left = variables_of(matrix.rows()).nth(1).is_some();
    if matrix.rows().len() >= INTERPOLATED_SIZE && several_left {
        interpolated(matrix.rows())
    } else {
        bareiss(matrix.into_rows())
    }
}

/// One variable left is worth the dense representation: no sorted map per product.
fn bareiss<R: Domain>(rows: Vec<Vec<Poly<R>>>) -> Poly<R> {
    let mut variables = variables_of(&rows);
    match (variables.next(), variables.next()) {
        (Some(only), None) => {
            drop(variables);
            let dense = rows.iter().map(|row| {
                let entry = |p: &Poly<R>| p.univariate(only).expect("no other variable occurs");
                row.iter().map(entry).collect::<Vec<UPoly<R>>>()
            });
            from_univariate(&determinant_bareiss(dense.collect()), only)
        }
        _ => {
            drop(variables);
            determinant_bareiss(rows)
        }
    }
}

/// Evaluates one variable after another, the last ones in numbers, and interpolates on the way back.
fn interpolated<R: Domain>(rows: &[Vec<Poly<R>>]) -> Poly<R> {
    let Some(variable) = variables_of(rows).next() else {
        let number = |p: &Poly<R>| p.terms().next().map_or_else(R::zero, |(_, c)| c.clone());
        return Poly::constant(determinant_bareiss(rows.iter().map(|row| row.iter().map(number).collect()).collect()));
    };
    let degree = |p: &Poly<R>| (!p.vanishes()).then(|| p.degree_in(variable) as usize);
    let Some(bound) = determinant_degree_bound(rows, degree) else {
        return Poly::zero();
    };
    let split: Vec<Vec<Vec<Poly<R>>>> =
        rows.iter().map(|row| row.iter().map(|p| p.coefficients_in(variable)).collect()).collect();
    let values = (0..=bound).map(|k| {
        let x = Poly::constant(R::from_int(node(k)));
        let at = |c: &Vec<Poly<R>>| c.iter().rev().fold(Poly::zero(), |sum, c| sum * x.clone() + c.clone());
        let rows: Vec<Vec<Poly<R>>> = split.iter().map(|row| row.iter().map(at).collect()).collect();
        interpolated(&rows)
    });
    let v = Poly::variable(variable);
    let newton = divided_differences(values.collect());
    newton
        .into_iter()
        .enumerate()
        .rev()
        .fold(Poly::zero(), |sum, (k, difference)| sum * (v.clone() - Poly::from_int(node(k))) + difference)
}

/// The variables that occur, ascending.
fn variables_of<R: Ring>(rows: &[Vec<Poly<R>>]) -> impl Iterator<Item = usize> {
    let occurs = |v: usize| rows.iter().flatten().any(|p| p.degree_in(v) > 0);
    let count = rows.iter().flatten().flat_map(|p| p.terms().map(|(m, _)| m.exponents().len())).max().unwrap_or(0);
    (0..count).filter(move |&v| occurs(v))
}

fn from_univariate<R: Ring>(p: &UPoly<R>, variable: usize) -> Poly<R> {
    let terms = p.coefficients().iter().enumerate();
    terms.fold(Poly::zero(), |sum, (k, c)| {
        sum + Poly::term(c.clone(), crate::algebra::Monomial::variable_power(variable, k as u32))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{Gaussian, Integer, Monomial, Rational};
    use crate::eliminate::determinant_expanded;
    use proptest::prelude::*;

    /// Polynomials in x, y, z of degree 2 in x: the coefficient of x² is too large to cancel.
    fn polynomial() -> impl Strategy<Value = Poly<Integer>> {
        let exponents = (0u32..3, 0u32..2, 0u32..2);
        let terms = prop::collection::vec((exponents, -4i64..5), 1..5);
        (terms, 30i64..34).prop_map(|(terms, lead)| {
            let lead = Poly::term(Integer::from(lead), Monomial::new(&[2]));
            terms
                .into_iter()
                .fold(lead, |sum, ((i, j, k), c)| sum + Poly::term(Integer::from(c), Monomial::new(&[i, j, k])))
        })
    }

    fn degree(p: &Poly<Integer>) -> u32 {
        p.degree_in(0)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100))]

        #[test]
        fn multiplicative_and_antisymmetric((f, g, h) in (polynomial(), polynomial(), polynomial())) {
            let product = resultant(&(f.clone() * g.clone()), &h, 0);
            prop_assert_eq!(product, resultant(&f, &h, 0) * resultant(&g, &h, 0));
            let sign = Poly::from_int(if (degree(&f) * degree(&h)).is_multiple_of(2) { 1 } else { -1 });
            prop_assert_eq!(resultant(&h, &f, 0), sign * resultant(&f, &h, 0));
        }

        #[test]
        fn algorithms_agree((f, g, h) in (polynomial(), polynomial(), polynomial())) {
            let g = g * h;
            let expanded = determinant_expanded(actual_matrix(&f, &g, 0).rows());
            prop_assert_eq!(&resultant_bareiss(&f, &g, 0), &expanded);
            prop_assert_eq!(&resultant_interpolated(&f, &g, 0), &expanded);
        }

        #[test]
        fn homogeneous_in_each_argument((f, h) in (polynomial(), polynomial()), c in 2i64..6) {
            let scaled = resultant(&(Poly::from_int(c) * f.clone()), &h, 0);
            prop_assert_eq!(scaled, Poly::from_int(c).power(degree(&h)) * resultant(&f, &h, 0));
        }

        #[test]
        fn zero_exactly_where_a_root_is_shared((f, g, h) in (polynomial(), polynomial(), polynomial())) {
            prop_assert!(resultant(&(f * h.clone()), &(g * h), 0).vanishes());
        }

        /// Each degree that `f` lacks multiplies the resultant by the leading coefficient of `g`, up to the sign the exchange of rows gives.
        #[test]
        fn missing_degrees_bring_leading_coefficients((f, g) in (polynomial(), polynomial()), missing in 0u32..3) {
            let (m, n) = (degree(&f), degree(&g));
            let formal = resultant_formal(&f, &g, 0, (m + missing, n)).unwrap();
            let lead = g.coefficients_in(0).pop().unwrap();
            let sign = Poly::from_int(if n * missing % 2 == 0 { 1 } else { -1 });
            prop_assert_eq!(formal, sign * lead.power(missing) * resultant(&f, &g, 0));
            prop_assert!(resultant_formal(&f, &g, 0, (m + 1, n + 1)).unwrap().vanishes());
        }
    }

    #[test]
    fn roots_of_products_of_linear_factors_by_poissons_formula() {
        // res(2(x-1)(x-2), 3(x-5)(x-7)(x+1)) = 2³·3²·prod of differences
        let linear = |root: i64| Poly::<Rational>::variable(0) - Poly::from_int(root);
        let f = Poly::from_int(2) * linear(1) * linear(2);
        let g = Poly::from_int(3) * linear(5) * linear(7) * linear(-1);
        let differences = [1, 2].into_iter().flat_map(|a| [5, 7, -1].map(|b| a - b)).product::<i64>();
        assert_eq!(resultant(&f, &g, 0), Poly::from_int(8 * 9 * differences));
    }

    #[test]
    fn gaussian_integers_are_a_domain_too() {
        let [z, w] = [0, 1].map(Poly::<Gaussian<Integer>>::variable);
        let i = Poly::constant(Gaussian::new(Integer::ZERO, Integer::ONE));
        // z w = 1 and z = i w meet where i w² = 1.
        let res = resultant(&(z.clone() * w.clone() - Poly::one()), &(z - i.clone() * w.clone()), 0);
        assert_eq!(res, Poly::one() - i * w.power(2));
    }
}
