//! Polynomial equations with names for everything.

use std::fmt;

use num_complex::Complex64;

use crate::algebra::{Domain, Gaussian, Integer, Monomial, Poly, Rational, Ring, integer_to_f64_scaled};

/// Polynomials that are to vanish together, each with a label, in named variables.
///
/// ```
/// use assur::{System, algebra::{Integer, Poly, Ring}};
/// let mut system = System::new(["x", "y"]);
/// let [x, y] = [system.variable("x"), system.variable("y")].map(Option::unwrap);
/// system.add("circle", x.clone() * x.clone() + y.clone() * y.clone() - Poly::from_int(25));
/// system.add("line", x - y - Poly::<Integer>::one());
/// assert_eq!(system.to_string(), "circle: x^2 + y^2 - 25 = 0\nline: x - y - 1 = 0");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct System<C> {
    variables: Vec<String>,
    equations: Vec<(String, Poly<C>)>,
}

impl<C: Domain> System<C> {
    /// A system without equations, in these variables; variable number `k` of its polynomials is the `k`-th name.
    pub fn new<N: Into<String>>(variables: impl IntoIterator<Item = N>) -> Self {
        Self { variables: variables.into_iter().map(Into::into).collect(), equations: Vec::new() }
    }

    /// Adds the equation `polynomial = 0` under a label; a label used before is replaced.
    pub fn add(&mut self, label: impl Into<String>, polynomial: Poly<C>) {
        let label = label.into();
        match self.equations.iter_mut().find(|(known, _)| *known == label) {
            Some((_, present)) => *present = polynomial,
            None => self.equations.push((label, polynomial)),
        }
    }

    /// The system with one equation more; for building in one expression.
    pub fn with(mut self, label: impl Into<String>, polynomial: Poly<C>) -> Self {
        self.add(label, polynomial);
        self
    }

    /// The names of the variables, by number.
    pub fn variables(&self) -> &[String] {
        &self.variables
    }

    /// The number of a variable.
    pub fn variable_number(&self, name: &str) -> Option<usize> {
        self.variables.iter().position(|known| known == name)
    }

    /// A variable as a polynomial.
    pub fn variable(&self, name: &str) -> Option<Poly<C>> {
        self.variable_number(name).map(Poly::variable)
    }

    /// The labelled polynomials, in the order added.
    pub fn equations(&self) -> &[(String, Poly<C>)] {
        &self.equations
    }

    /// The polynomial with this label.
    pub fn equation(&self, label: &str) -> Option<&Poly<C>> {
        self.equations.iter().find(|(known, _)| known == label).map(|(_, polynomial)| polynomial)
    }
}

impl<C: Domain + fmt::Display> fmt::Display for System<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, (label, polynomial)) in self.equations.iter().enumerate() {
            let end = if k == 0 { "" } else { "\n" };
            write!(f, "{end}{label}: {} = 0", show_polynomial(polynomial, &self.variables))?;
        }
        Ok(())
    }
}

/// A polynomial in words: highest terms first, `x^2 - 3 x y + 1`.
///
/// ```
/// use assur::{algebra::{Integer, Poly, Ring}, solve::show_polynomial};
/// let [s, t] = [0, 1].map(Poly::<Integer>::variable);
/// assert_eq!(show_polynomial(&(t.power(2) - Poly::from_int(3) * s * t), &["s", "t"]), "-3 s t + t^2");
/// ```
pub fn show_polynomial<C: Ring + fmt::Display, N: AsRef<str>>(polynomial: &Poly<C>, variables: &[N]) -> String {
    let mut shown = String::new();
    for (monomial, coefficient) in polynomial.terms().rev() {
        let factors: Vec<String> = monomial
            .exponents()
            .iter()
            .enumerate()
            .filter(|&(_, &e)| e > 0)
            .map(|(v, &e)| {
                let name = variables.get(v).map_or_else(|| format!("x{v}"), |name| name.as_ref().to_string());
                if e == 1 { name } else { format!("{name}^{e}") }
            })
            .collect();
        let product = factors.join(" ");
        let number = coefficient.to_string();
        let (negative, size) = match number.strip_prefix('-') {
            Some(size) => (true, size.to_string()),
            None => (false, number),
        };
        shown += match (shown.is_empty(), negative) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        };
        shown += &match (product.is_empty(), size.as_str()) {
            (true, _) => size,
            (false, "1") => product,
            (false, _) => format!("{size} {product}"),
        };
    }
    if shown.is_empty() { "0".to_string() } else { shown }
}

/// Exact coefficients that floats can approach.
///
/// The exponent is separate since numerators of eliminants leave the range of `f64`.
pub trait ToComplex: Domain {
    /// `(z, e)` with `self ≈ z·2^e` to a few 2⁻⁵³, the larger part of `z` neither huge nor tiny; `(0, 0)` for zero.
    ///
    /// ```
    /// use assur::{algebra::Integer, solve::ToComplex};
    /// let (z, e) = (Integer::from(3) << 5000).to_complex_scaled();
    /// assert_eq!(z.re * 2f64.powi((e - 5000) as i32), 3.0);
    /// ```
    fn to_complex_scaled(&self) -> (Complex64, i64);
}

impl ToComplex for Integer {
    fn to_complex_scaled(&self) -> (Complex64, i64) {
        let (mantissa, exponent) = integer_to_f64_scaled(self);
        (mantissa.into(), exponent)
    }
}

impl ToComplex for Rational {
    fn to_complex_scaled(&self) -> (Complex64, i64) {
        if self.is_zero() {
            return (Complex64::ZERO, 0);
        }
        let (n, en) = integer_to_f64_scaled(self.numerator());
        let (d, ed) = integer_to_f64_scaled(&Integer::from(self.denominator().clone()));
        ((n / d).into(), en - ed)
    }
}

impl<R: ToComplex> ToComplex for Gaussian<R> {
    fn to_complex_scaled(&self) -> (Complex64, i64) {
        let ((re, e_re), (im, e_im)) = (self.re.to_complex_scaled(), self.im.to_complex_scaled());
        let e = match (self.re.is_zero(), self.im.is_zero()) {
            (_, true) => e_re,
            (true, false) => e_im,
            (false, false) => e_re.max(e_im),
        };
        (Complex64::new(times_power_of_two(re.re, e_re - e), times_power_of_two(im.re, e_im - e)), e)
    }
}

/// `x·2^e`, zero where it underflows; in two factors, since 2^e alone may leave the range of `f64`.
fn times_power_of_two(x: f64, e: i64) -> f64 {
    if x == 0.0 || e < -1200 { 0.0 } else { x * 2f64.powi((e / 2) as i32) * 2f64.powi((e - e / 2) as i32) }
}

/// Exact numbers as floats, all divided by one power of two so that the largest is of size about one.
///
/// ```
/// use assur::{algebra::Integer, solve::to_complex_together};
/// let scaled = to_complex_together(&[Integer::from(3) << 5000, Integer::from(-6) << 5000]);
/// assert_eq!(scaled[1] / scaled[0], (-2.0).into());
/// ```
pub fn to_complex_together<C: ToComplex>(numbers: &[C]) -> Vec<Complex64> {
    let parts: Vec<(Complex64, i64)> = numbers.iter().map(C::to_complex_scaled).collect();
    let size = |&(z, e): &(Complex64, i64)| (z != Complex64::ZERO).then(|| e + z.norm().log2().ceil() as i64);
    let Some(top) = parts.iter().filter_map(size).max() else {
        return vec![Complex64::ZERO; numbers.len()];
    };
    parts
        .into_iter()
        .map(|(z, e)| Complex64::new(times_power_of_two(z.re, e - top), times_power_of_two(z.im, e - top)))
        .collect()
}

/// A polynomial with float coefficients, for evaluating.
#[derive(Clone, Debug)]
pub(super) struct NumericPoly {
    terms: Vec<(Monomial, Complex64)>,
}

impl NumericPoly {
    /// The polynomial, scaled by a power of two.
    pub(super) fn new<C: ToComplex>(polynomial: &Poly<C>) -> Self {
        let (monomials, coefficients): (Vec<Monomial>, Vec<C>) =
            polynomial.terms().map(|(m, c)| (m.clone(), c.clone())).unzip();
        Self { terms: monomials.into_iter().zip(to_complex_together(&coefficients)).collect() }
    }

    /// The value and the sum of the sizes of the terms.
    pub(super) fn value_and_size(&self, values: &[Complex64]) -> (Complex64, f64) {
        self.terms.iter().fold((Complex64::ZERO, 0.0), |(sum, size), (monomial, c)| {
            let term = product(monomial, values, None) * c;
            (sum + term, size + term.norm())
        })
    }

    /// The partial derivative's value.
    pub(super) fn derivative(&self, variable: usize, values: &[Complex64]) -> Complex64 {
        let terms = self.terms.iter().filter(|(monomial, _)| monomial.exponent(variable) > 0);
        terms
            .map(|(monomial, c)| product(monomial, values, Some(variable)) * c * f64::from(monomial.exponent(variable)))
            .sum()
    }

    /// Whether a variable occurs.
    pub(super) fn contains(&self, variable: usize) -> bool {
        self.terms.iter().any(|(monomial, _)| monomial.exponent(variable) > 0)
    }

    /// The coefficients in one variable, ascending, at the values of the others, and for each the sum of the sizes of its terms.
    pub(super) fn coefficients_in(
        &self,
        variable: usize,
        degree: usize,
        values: &[Complex64],
    ) -> (Vec<Complex64>, Vec<f64>) {
        let mut coefficients = vec![Complex64::ZERO; degree + 1];
        let mut sizes = vec![0.0; degree + 1];
        for (monomial, c) in &self.terms {
            let power = monomial.exponent(variable) as usize;
            let term = product(&monomial.with_exponent(variable, 0), values, None) * c;
            coefficients[power] += term;
            sizes[power] += term.norm();
        }
        (coefficients, sizes)
    }

    /// The degree in one variable.
    pub(super) fn degree_in(&self, variable: usize) -> usize {
        self.terms.iter().map(|(monomial, _)| monomial.exponent(variable) as usize).max().unwrap_or(0)
    }
}

/// The monomial's value, with the exponent of `lowered` one less.
fn product(monomial: &Monomial, values: &[Complex64], lowered: Option<usize>) -> Complex64 {
    monomial.exponents().iter().enumerate().fold(Complex64::ONE, |product, (v, &e)| {
        let e = if lowered == Some(v) { e - 1 } else { e };
        if e == 0 { product } else { product * values[v].powu(e) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaussian_numbers_of_unequal_parts_keep_their_larger_one() {
        let z = Gaussian::new(Integer::from(1) << 3000, Integer::from(-3));
        let (c, e) = z.to_complex_scaled();
        assert_eq!((c.re * 2f64.powi((e - 2990) as i32), c.im), (1024.0, 0.0));
        let z = Gaussian::new(Integer::ZERO, Integer::from(-3) << 70);
        let (c, e) = z.to_complex_scaled();
        assert_eq!((c.re, c.im * 2f64.powi(e as i32)), (0.0, -3.0 * 2f64.powi(70)));
    }

    #[test]
    fn numeric_polynomial_evaluates_like_the_exact_one() {
        let [x, y] = [0, 1].map(Poly::<Rational>::variable);
        let f = x.power(2) * y.clone() - Poly::from_int(6) * y.power(3) + Poly::from_int(3) * x;
        let at = [Complex64::new(0.5, 1.0), Complex64::new(-2.0, 0.25)];
        let direct = at[0].powu(2) * at[1] - 6.0 * at[1].powu(3) + 3.0 * at[0];
        let numeric = NumericPoly::new(&f);
        let factor = numeric.value_and_size(&at).0 / direct;
        assert!((factor.re.log2().fract()).abs() < 1e-12 && factor.im.abs() < 1e-12);
        let by_x = 2.0 * at[0] * at[1] + 3.0;
        assert!((numeric.derivative(0, &at) / factor - by_x).norm() < 1e-12);
        let (coefficients, _) = numeric.coefficients_in(0, 2, &at);
        assert!((coefficients[2] / factor - at[1]).norm() < 1e-14);
    }
}
