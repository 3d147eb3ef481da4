//! Products of powers of variables, ordered lexicographically.

use std::cmp::Ordering;

/// `x0^e0 · x1^e1 · …`; exponents by variable number, no trailing zeros stored.
///
/// The order is lexicographic: the variable with the smallest number weighs most. It is compatible with
/// multiplication, which exact division of polynomials rests on.
///
/// ```
/// use assur::algebra::Monomial;
/// let xy2 = Monomial::new(&[1, 2]);
/// assert_eq!(xy2.clone() * Monomial::new(&[0, 1, 5]), Monomial::new(&[1, 3, 5]));
/// assert!(xy2 > Monomial::new(&[0, 9]));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Monomial {
    exponents: Vec<u32>,
}

impl Monomial {
    /// The monomial with these exponents.
    pub fn new(exponents: &[u32]) -> Self {
        let used = exponents.iter().rposition(|&e| e > 0).map_or(0, |last| last + 1);
        Self { exponents: exponents[..used].to_vec() }
    }

    /// The variable with this number.
    pub fn variable(number: usize) -> Self {
        Self::variable_power(number, 1)
    }

    /// A power of the variable with this number.
    pub fn variable_power(number: usize, exponent: u32) -> Self {
        let mut exponents = vec![0; number + 1];
        exponents[number] = exponent;
        Self::new(&exponents)
    }

    /// The exponent of a variable.
    pub fn exponent(&self, variable: usize) -> u32 {
        self.exponents.get(variable).copied().unwrap_or(0)
    }

    /// The exponents, by variable number, without trailing zeros.
    pub fn exponents(&self) -> &[u32] {
        &self.exponents
    }

    /// The sum of the exponents.
    pub fn total_degree(&self) -> u32 {
        self.exponents.iter().sum()
    }

    /// This monomial with the exponent of one variable replaced.
    pub fn with_exponent(&self, variable: usize, exponent: u32) -> Self {
        let mut exponents = self.exponents.clone();
        if exponents.len() <= variable {
            exponents.resize(variable + 1, 0);
        }
        exponents[variable] = exponent;
        Self::new(&exponents)
    }

    /// `self / divisor` where every exponent allows it.
    pub fn exact_div(&self, divisor: &Self) -> Option<Self> {
        let length = self.exponents.len().max(divisor.exponents.len());
        let exponents: Option<Vec<u32>> =
            (0..length).map(|v| self.exponent(v).checked_sub(divisor.exponent(v))).collect();
        exponents.map(|e| Self::new(&e))
    }
}

impl std::ops::Mul for Monomial {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        &self * &other
    }
}

impl std::ops::Mul for &Monomial {
    type Output = Monomial;
    fn mul(self, other: Self) -> Monomial {
        let (long, short) = if self.exponents.len() >= other.exponents.len() { (self, other) } else { (other, self) };
        let mut exponents = long.exponents.clone();
        for (e, f) in exponents.iter_mut().zip(&short.exponents) {
            *e += f;
        }
        Monomial { exponents }
    }
}

impl Ord for Monomial {
    fn cmp(&self, other: &Self) -> Ordering {
        // Trailing zeros are not stored, so the comparison of slices is the lexicographic one.
        self.exponents.cmp(&other.exponents)
    }
}

impl PartialOrd for Monomial {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_is_compatible_with_multiplication() {
        let all: Vec<Monomial> = (0..27u32).map(|n| Monomial::new(&[n / 9, n / 3 % 3, n % 3])).collect();
        for a in &all {
            for b in &all {
                for c in &all {
                    assert_eq!(a.cmp(b), (a * c).cmp(&(b * c)), "{a:?} {b:?} {c:?}");
                }
            }
        }
    }

    #[test]
    fn division_undoes_multiplication() {
        let (a, b) = (Monomial::new(&[2, 0, 1]), Monomial::new(&[0, 3]));
        assert_eq!((&a * &b).exact_div(&b), Some(a.clone()));
        assert_eq!(a.exact_div(&b), None);
    }
}
