//! Which roots does an exact polynomial repeat, and how often?
//!
//! Musser's decomposition over the greatest common divisor with the derivative, by the subresultant remainder sequence. All divisions are
//! exact in the domain; factors come out up to constants, which move no root.
//!
//! Source: Knuth, *The Art of Computer Programming* 2, 3rd ed. (1997), section 4.6.1, algorithm C.

use crate::algebra::{Domain, Ring, UPoly};

/// Square-free polynomials without common roots, each with the multiplicity its roots have in `p`; nothing for a constant.
pub(super) fn square_free<C: Domain>(p: &UPoly<C>) -> Vec<(UPoly<C>, usize)> {
    let mut factors = Vec::new();
    if p.degree().unwrap_or(0) == 0 {
        return factors;
    }
    let mut repeated = common_divisor(p, &p.derivative());
    let mut distinct = quotient(p, &repeated);
    let mut multiplicity = 1;
    while distinct.degree() > Some(0) {
        let further = common_divisor(&distinct, &repeated);
        let exactly = quotient(&distinct, &further);
        if exactly.degree() > Some(0) {
            factors.push((exactly, multiplicity));
        }
        repeated = quotient(&repeated, &further);
        distinct = further;
        multiplicity += 1;
    }
    factors
}

/// The greatest common divisor up to a constant; one where there is none.
fn common_divisor<C: Domain>(f: &UPoly<C>, g: &UPoly<C>) -> UPoly<C> {
    let (mut a, mut b) = if f.degree() >= g.degree() { (f.clone(), g.clone()) } else { (g.clone(), f.clone()) };
    let (mut lead, mut h) = (C::one(), C::one());
    while b.degree() > Some(0) {
        let gap = (a.degree().unwrap_or(0) - b.degree().unwrap_or(0)) as u32;
        let rest = a.pseudo_remainder(&b);
        if rest.vanishes() {
            return b;
        }
        let divisor = lead * h.power(gap);
        a = b;
        b = rest.divided_by_constant(&divisor).expect("subresultants divide the pseudo-remainders");
        lead = a.leading().cloned().unwrap_or_else(C::one);
        h = match gap {
            0 => h,
            _ => lead.power(gap).exact_div(&h.power(gap - 1)).expect("subresultant leads divide"),
        };
    }
    // A constant divides everything; zero is divided by the other.
    if b.vanishes() { a } else { UPoly::one() }
}

/// `f / g` up to a constant, where `g` divides `f` up to one.
fn quotient<C: Domain>(f: &UPoly<C>, g: &UPoly<C>) -> UPoly<C> {
    let (Some(m), Some(n), Some(lead)) = (f.degree(), g.degree(), g.leading()) else {
        return f.clone();
    };
    if n == 0 {
        return f.clone();
    }
    let raised = f.scaled(&lead.power((m + 1).saturating_sub(n) as u32));
    raised.exact_div(g).expect("a divisor divides once the leading coefficient has been multiplied in")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Integer;

    fn p(coefficients: &[i64]) -> UPoly<Integer> {
        UPoly::new(coefficients.iter().map(|&c| Integer::from(c)).collect())
    }

    #[test]
    fn multiplicities_are_told_apart() {
        let (a, b, c) = (p(&[-2, 0, 3]), p(&[5, 2]), p(&[1, 1, 1]));
        let product = p(&[6]) * a.clone() * b.power(2) * c.power(4);
        let found = square_free(&product);
        assert_eq!(found.iter().map(|(f, m)| (f.degree().unwrap(), *m)).collect::<Vec<_>>(), [(2, 1), (1, 2), (2, 4)]);
        for ((factor, _), planted) in found.iter().zip([a, b, c]) {
            assert!(factor.pseudo_remainder(&planted).vanishes());
        }
        assert_eq!(square_free(&p(&[7])), []);
        assert_eq!(square_free(&p(&[0, 0, 0, 5]))[0].1, 3);
    }
}
