//! When do two polynomials share a root? When their Sylvester matrix is singular.
//!
//! For `f` of formal degree `m` and `g` of formal degree `n` in `v`, the rows are `v^(n-1) f, …, f, v^(m-1) g, …, g` and the columns
//! the powers `v^(m+n-1), …, 1`. At a common root the vector of powers lies in the kernel, which is how a root is lifted.
//! *Formal* degrees are stated, not read off: where a leading coefficient happens to vanish, the matrix keeps its shape, and its
//! determinant is the resultant of the family at that member (zero where both leading coefficients vanish: a common root at infinity).
//!
//! Source: Cox, Little, O'Shea, *Using Algebraic Geometry*, 2nd ed. (2005), chapter 3, section 1, doi:10.1007/b138611.

use std::fmt;

use thiserror::Error;

use crate::algebra::{Poly, Ring};

/// A Sylvester matrix whose rows and columns carry names.
///
/// ```
/// use assur::{algebra::Integer, eliminate::SylvesterMatrix};
/// let f = [2, -3, 1].map(Integer::from); // w² - 3w + 2
/// let g = [-2, 1].map(Integer::from); // w - 2
/// let matrix = SylvesterMatrix::new(("circle", &f), ("line", &g), "w");
/// assert_eq!(matrix.row_names(), ["circle", "w * line", "line"]);
/// assert_eq!(matrix.column_names(), ["w^2", "w", "1"]);
/// assert_eq!(matrix.rows()[1], [1, -2, 0].map(Integer::from));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SylvesterMatrix<R> {
    rows: Vec<Vec<R>>,
    row_names: Vec<String>,
    column_names: Vec<String>,
}

/// A stated degree is below the actual one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("formal degree {formal} is below the degree {actual} the polynomial has")]
pub struct FormalDegreeTooLow {
    /// The degree stated.
    pub formal: u32,
    /// The degree found.
    pub actual: u32,
}

impl<R: Ring> SylvesterMatrix<R> {
    /// The matrix of two polynomials given by name and ascending coefficients; formal degrees are the lengths less one.
    ///
    /// Panics if a polynomial has no coefficient at all: a constant, even zero, has one.
    pub fn new(first: (&str, &[R]), second: (&str, &[R]), variable: &str) -> Self {
        let (m, n) = (first.1.len() - 1, second.1.len() - 1);
        let size = m + n;
        let power = |k: usize| match k {
            0 => "1".to_string(),
            1 => variable.to_string(),
            _ => format!("{variable}^{k}"),
        };
        let mut rows = Vec::with_capacity(size);
        let mut row_names = Vec::with_capacity(size);
        for ((name, coefficients), shifts) in [(first, n), (second, m)] {
            for shift in (0..shifts).rev() {
                let mut row = vec![R::zero(); size];
                for (k, c) in coefficients.iter().enumerate() {
                    row[size - 1 - k - shift] = c.clone();
                }
                rows.push(row);
                row_names.push(if shift == 0 { name.to_string() } else { format!("{} * {name}", power(shift)) });
            }
        }
        Self { rows, row_names, column_names: (0..size).rev().map(power).collect() }
    }

    /// The entries, row by row; square.
    pub fn rows(&self) -> &[Vec<R>] {
        &self.rows
    }

    /// The entries, row by row, without a copy.
    pub fn into_rows(self) -> Vec<Vec<R>> {
        self.rows
    }

    /// What each row is: `w * leg 2`.
    pub fn row_names(&self) -> &[String] {
        &self.row_names
    }

    /// What each column multiplies: `w^3`.
    pub fn column_names(&self) -> &[String] {
        &self.column_names
    }
}

impl<R: Ring> SylvesterMatrix<Poly<R>> {
    /// The matrix of two polynomials in one of their variables, with formal degrees `degrees`; entries are polynomials in the others.
    ///
    /// # Errors
    /// A formal degree below the actual one.
    ///
    /// ```
    /// use assur::{algebra::{Integer, Poly, Ring}, eliminate::SylvesterMatrix};
    /// let [x, y] = [0, 1].map(Poly::<Integer>::variable);
    /// let matrix = SylvesterMatrix::in_variable(("f", &(x.clone() - y)), ("g", &x.power(2)), (0, "x"), (1, 2)).unwrap();
    /// assert_eq!(matrix.row_names(), ["x * f", "f", "g"]);
    /// ```
    pub fn in_variable(
        first: (&str, &Poly<R>),
        second: (&str, &Poly<R>),
        variable: (usize, &str),
        degrees: (u32, u32),
    ) -> Result<Self, FormalDegreeTooLow> {
        let f = formal_coefficients(first.1, variable.0, degrees.0)?;
        let g = formal_coefficients(second.1, variable.0, degrees.1)?;
        Ok(Self::new((first.0, &f), (second.0, &g), variable.1))
    }
}

/// The coefficients in one variable, padded with zeros to a formal degree.
fn formal_coefficients<R: Ring>(p: &Poly<R>, variable: usize, formal: u32) -> Result<Vec<Poly<R>>, FormalDegreeTooLow> {
    let mut coefficients = p.coefficients_in(variable);
    let actual = coefficients.len().saturating_sub(1) as u32;
    if actual > formal {
        return Err(FormalDegreeTooLow { formal, actual });
    }
    coefficients.resize(formal as usize + 1, Poly::zero());
    Ok(coefficients)
}

/// A table with the column names on top and the row names at the left.
impl<R: fmt::Display> fmt::Display for SylvesterMatrix<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let cells: Vec<Vec<String>> = self.rows.iter().map(|r| r.iter().map(R::to_string).collect()).collect();
        let width =
            cells.iter().flatten().chain(&self.column_names).map(|cell| cell.chars().count()).max().unwrap_or(1);
        let left = self.row_names.iter().map(|name| name.chars().count()).max().unwrap_or(0);
        let line = |name: &str, entries: &[String]| {
            let entries: Vec<String> = entries.iter().map(|entry| format!("{entry:>width$}")).collect();
            format!("{name:>left$} | {}", entries.join("  "))
        };
        write!(f, "{}", line("", &self.column_names))?;
        for (name, row) in self.row_names.iter().zip(&cells) {
            write!(f, "\n{}", line(name, row))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Integer;

    #[test]
    fn prints_as_a_named_table() {
        let (f, g) = ([1, -3, 2].map(Integer::from), [5, 7].map(Integer::from));
        let shown = SylvesterMatrix::new(("f", &f), ("leg 2", &g), "w").to_string();
        let expected = [
            "          | w^2    w    1",
            "        f |   2   -3    1",
            "w * leg 2 |   7    5    0",
            "    leg 2 |   0    7    5",
        ];
        assert_eq!(shown, expected.join("\n"));
    }

    #[test]
    fn powers_of_a_common_root_lie_in_the_kernel() {
        let (f, g) = ([6, -5, 1].map(Integer::from), [-2, 1, -2, 1].map(Integer::from));
        let powers = [16, 8, 4, 2, 1].map(Integer::from);
        for row in SylvesterMatrix::new(("f", &f), ("g", &g), "x").rows() {
            let sum = row.iter().zip(&powers).fold(Integer::ZERO, |sum, (a, b)| sum + a * b);
            assert_eq!(sum, Integer::ZERO);
        }
    }

    #[test]
    fn a_formal_degree_below_the_actual_one_is_refused() {
        let x = Poly::<Integer>::variable(0);
        let refused = SylvesterMatrix::in_variable(("f", &x.power(2)), ("g", &x), (0, "x"), (1, 1));
        assert_eq!(refused, Err(FormalDegreeTooLow { formal: 1, actual: 2 }));
    }
}
