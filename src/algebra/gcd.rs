//! Greatest common divisors and square-free parts of integer polynomials, exact.
//!
//! The primitive remainder sequence is exact but its numbers grow, so coprimality is first asked modulo one
//! prime: if the images are coprime and no leading coefficient is lost, the polynomials are (von zur Gathen and
//! Gerhard, Modern Computer Algebra, 2013, section 6.4). For generic mechanisms that settles it in a microsecond.

use dashu_int::ops::{Gcd, RemEuclid};

use super::{Domain, Integer, Ring, UPoly};

/// The largest prime below 2⁶¹ of Mersenne form; a random coprime pair fails the test with probability about degree²/2⁶¹.
const PRIME: u64 = (1 << 61) - 1;

impl UPoly<Integer> {
    /// The polynomial divided by the greatest common divisor of its coefficients, leading coefficient positive.
    ///
    /// ```
    /// use assur::algebra::{Integer, UPoly};
    /// let p = UPoly::new([6, 0, -4].map(Integer::from).to_vec());
    /// assert_eq!(p.primitive(), UPoly::new([-3, 0, 2].map(Integer::from).to_vec()));
    /// ```
    pub fn primitive(&self) -> Self {
        let Some(lead) = self.leading() else { return self.clone() };
        let mut content = Integer::ZERO;
        for c in self.coefficients().iter().filter(|c| !Domain::is_zero(*c)) {
            content = Integer::from(content.gcd(c));
            if content == Integer::ONE {
                break;
            }
        }
        if *lead < Integer::ZERO {
            content = -content;
        }
        self.divided_by_constant(&content).expect("the content divides every coefficient")
    }

    /// The greatest common divisor over the rationals, primitive; zero only if both are zero.
    ///
    /// ```
    /// use assur::algebra::{Integer, UPoly};
    /// let p = |c: &[i64]| UPoly::new(c.iter().map(|&x| Integer::from(x)).collect());
    /// assert_eq!((p(&[-1, 1]) * p(&[2, 1])).gcd(&(p(&[-1, 1]) * p(&[5, 3]))), p(&[-1, 1]));
    /// ```
    pub fn gcd(&self, other: &Self) -> Self {
        if self.vanishes() {
            return other.primitive();
        }
        if other.vanishes() {
            return self.primitive();
        }
        if coprime_modulo_prime(self, other) {
            return Self::one();
        }
        let (mut a, mut b) = (self.primitive(), other.primitive());
        if a.degree() < b.degree() {
            std::mem::swap(&mut a, &mut b);
        }
        while !b.vanishes() {
            (a, b) = (b.clone(), a.pseudo_remainder(&b).primitive());
        }
        if a.degree() == Some(0) { Self::one() } else { a }
    }

    /// Square-free decomposition (Yun 1976): pairwise coprime, square-free, primitive `p_m`, not constant, with `self = c · Π p_m^m`.
    ///
    /// Shape: pairs `(p_m, m)`, `m` ascending. Empty for constants and for zero.
    ///
    /// ```
    /// use assur::algebra::{Integer, Ring, UPoly};
    /// let p = |c: &[i64]| UPoly::new(c.iter().map(|&x| Integer::from(x)).collect());
    /// let (f, g) = (p(&[-1, 1]), p(&[1, 0, 1]));
    /// assert_eq!((f.power(3) * g.clone()).square_free(), vec![(g, 1), (f, 3)]);
    /// ```
    pub fn square_free(&self) -> Vec<(Self, usize)> {
        let f = self.primitive();
        if f.degree().unwrap_or(0) == 0 {
            return Vec::new();
        }
        let derivative = f.derivative();
        let common = f.gcd(&derivative);
        if common.degree() == Some(0) {
            return vec![(f, 1)];
        }
        let exact = |p: &Self, q: &Self| p.exact_div(q).expect("a primitive common divisor divides");
        let mut out = Vec::new();
        let mut b = exact(&f, &common);
        let mut d = exact(&derivative, &common) - b.derivative();
        let mut multiplicity = 1;
        while b.degree() != Some(0) {
            let part = b.gcd(&d);
            let next = exact(&b, &part);
            d = exact(&d, &part) - next.derivative();
            if part.degree() != Some(0) {
                out.push((part, multiplicity));
            }
            b = next;
            multiplicity += 1;
        }
        out
    }
}

/// Whether the images modulo [`PRIME`] prove the two coprime.
fn coprime_modulo_prime(f: &UPoly<Integer>, g: &UPoly<Integer>) -> bool {
    let image = |p: &UPoly<Integer>| -> Vec<u64> {
        p.coefficients()
            .iter()
            .map(|c| u64::try_from(c.rem_euclid(Integer::from(PRIME))).expect("a residue is below the prime"))
            .collect()
    };
    let (mut a, mut b) = (image(f), image(g));
    // Only with both leading coefficients kept does a common divisor keep its degree.
    if a.last() == Some(&0) || b.last() == Some(&0) {
        return false;
    }
    while !b.is_empty() {
        if b.len() == 1 {
            return true;
        }
        remainder_modulo_prime(&mut a, &b);
        std::mem::swap(&mut a, &mut b);
    }
    a.len() == 1
}

/// `a` becomes the remainder of `a` by `b`, without leading zeros.
fn remainder_modulo_prime(a: &mut Vec<u64>, b: &[u64]) {
    let lead = *b.last().expect("divisor is not zero");
    let inverse = power_modulo_prime(lead, PRIME - 2);
    while a.len() >= b.len() {
        let top = a.pop().expect("longer than the divisor");
        let factor = product_modulo_prime(top, inverse);
        let offset = a.len() + 1 - b.len();
        for (c, &d) in a[offset..].iter_mut().zip(b) {
            *c = (*c + PRIME - product_modulo_prime(factor, d)) % PRIME;
        }
    }
    while a.last() == Some(&0) {
        a.pop();
    }
}

fn product_modulo_prime(a: u64, b: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(PRIME)) as u64
}

fn power_modulo_prime(mut base: u64, mut exponent: u64) -> u64 {
    let mut product = 1;
    while exponent > 0 {
        if exponent & 1 == 1 {
            product = product_modulo_prime(product, base);
        }
        base = product_modulo_prime(base, base);
        exponent >>= 1;
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(coefficients: &[i64]) -> UPoly<Integer> {
        UPoly::new(coefficients.iter().map(|&c| Integer::from(c)).collect())
    }

    #[test]
    fn gcd_finds_the_planted_factor() {
        let (f, g, h) = (p(&[3, 1, 0, 2]), p(&[-5, 7, 1]), p(&[1, 0, 0, 4, 9]));
        assert_eq!((f.clone() * g.clone()).gcd(&(f.clone() * h.clone())), f);
        assert_eq!(g.gcd(&h), p(&[1]));
        assert_eq!(g.gcd(&p(&[])), g);
        assert_eq!(p(&[]).gcd(&p(&[])), p(&[]));
        assert_eq!(p(&[6]).gcd(&p(&[4, 2])), p(&[1]));
    }

    #[test]
    fn coprimality_survives_leading_coefficients_that_the_prime_divides() {
        let lost = UPoly::new(vec![Integer::from(1), Integer::from(PRIME)]);
        assert_eq!(lost.gcd(&p(&[2, 1])), p(&[1]));
        assert_eq!(lost.gcd(&(lost.clone() * p(&[2, 1]))), lost);
    }

    #[test]
    fn square_free_parts_multiply_back() {
        let (f, g, h) = (p(&[3, 1]), p(&[-5, 7, 1]), p(&[1, 0, 4]));
        let product = f.clone() * g.power(2) * h.power(4);
        assert_eq!(product.square_free(), vec![(f, 1), (g, 2), (h, 4)]);
        assert!(p(&[7]).square_free().is_empty());
    }
}
