//! Degrees of the curves on which a manipulator is singular of type 2, at a fixed orientation.

use std::collections::BTreeSet;

use assur::algebra::{Integer, Poly};
use assur::nalgebra::Vector2;
use assur::{Leg, Manipulator, Placement};

/// Leg types with the degree of the curve for three such legs with nothing special about them.
const DEGREES: [(&str, u32); 18] = [
    ("R_P_R", 2),
    ("_R_PR", 16),
    ("RP_R_", 16),
    ("R_R_R", 2),
    ("_P_RR", 20),
    ("P_R_R", 0),
    ("PR_R_", 6),
    ("_R_RP", 6),
    ("R_R_P", 0),
    ("RR_P_", 20),
    ("_P_PR", 0),
    ("P_P_R", 0),
    ("_P_RP", 1),
    ("PR_P_", 1),
    ("R_P_P", 0),
    ("RP_P_", 0),
    ("_R_RR", 44),
    ("RR_R_", 44),
];

/// Mixtures, likewise.
const MIXED: [(&str, u32); 5] = [
    ("R_P_R,R_P_R,_P_RR", 6),
    ("R_P_R,_P_RR,_P_RR", 12),
    ("R_P_R,R_P_R,_R_RR", 8),
    ("_P_RR,_R_RP,R_P_R", 12),
    ("R_P_R,_P_RR,RP_P_", 6),
];

/// The text, with every step checked.
pub fn document() -> String {
    let mut text = String::from(
        "Degrees of the curves of type 2\n\
         ===============================\n\
         Claim. At a fixed orientation det A = 0, all working modes together, is a curve in the position (x, y) of the\n\
         degree below, for three legs of a type with general dimensions. Degree 0: whether A is singular does not depend\n\
         on the position.\n\n\
         What is shown. Each curve is found by exact elimination of the square roots (Manipulator::singularity_locus) on\n\
         members with random dimensions, multiples of 2^-20. A special member can only have a lower degree than the general one, so every\n\
         figure is proved as a lower bound of the general degree. It is lower than that only where the leading\n\
         coefficients vanish, polynomials in the dimensions of degree at most 288: three entries of degree 6 with the orientation's cosine and sine of\n\
         degree 6 more, in a product over 8 signs. By Schwartz and Zippel a member drawn from 2^20 values a number is\n\
         special with probability at most 288 / 2^20, below 3e-4; n members that agree, below (3e-4)^n.\n\n",
    );
    for (kind, degree) in DEGREES {
        // High degrees take seconds each.
        let members = if degree > 40 { 1 } else { 3 };
        let loci: Vec<_> = (0..members).map(|seed| locus(&[kind; 3], seed)).collect();
        assert!(loci.iter().all(|locus| locus.degree() == degree), "3-{kind}: {:?}", loci[0].degree());
        let removed: u32 = loci[0].removed.iter().map(|(_, power)| 2 * power).sum();
        text += &format!("3-{kind:<8} degree {degree:>2}, {:>4} terms", loci[0].polynomial.term_count());
        text += &format!(", {members} members alike");
        text += &if removed > 0 { format!(", after removing factors of degree {removed}\n") } else { "\n".to_owned() };
        if degree > 1 {
            let primes = irreducible(&loci[0].polynomial).unwrap_or_else(|| panic!("3-{kind} has no factor"));
            text += &format!(
                "            irreducible: its restriction to y = 1 splits alike modulo no two of {primes} primes\n"
            );
        }
    }
    text += "\nMixtures:\n";
    for (family, degree) in MIXED {
        let kinds: Vec<&str> = family.split(',').collect();
        let kinds = [kinds[0], kinds[1], kinds[2]];
        let degrees: Vec<u32> = (0..2).map(|seed| locus(&kinds, seed).degree()).collect();
        assert_eq!(degrees, [degree; 2], "{family}");
        text += &format!("{family:<20} degree {degree:>2}, 2 members alike\n");
    }
    text += "\nWhy factors are removed, and no others. With the last two joints idle, the row of an RRR leg is the force\n\
             ((2 d^2 - k) - i s) D as a complex number, D from base pivot to last pivot, d^2 = D conj(D),\n\
             and ((2 d^2 - k) - i s)((2 d^2 - k) + i s) = 4 l2^2 d^2. Where conj(D) = 0 one sign of s makes the second factor vanish as well, and with it the whole\n\
             row; likewise where D = 0. So the product over 8 signs has (d^2)^4 for each leg: degree 24 in all, 68 - 24 = 44. The curve that\n\
             is left is irreducible over the rationals, so whoever finds another degree for general dimensions has another curve.\n";
    text
}

fn locus(kinds: &[&str; 3], seed: u64) -> assur::SingularityLocus {
    general(kinds, seed).singularity_locus(0.375 + seed as f64).expect("one actuator a leg")
}

/// Three legs with random dimensions, multiples of 2^-20.
fn general(kinds: &[&str; 3], seed: u64) -> Manipulator {
    let mut state = 20_030_526 + 7919 * seed;
    let mut number = |low: f64, high: f64| {
        // Knuth's linear congruential generator, its upper bits.
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let part = (state >> 44) as f64 / f64::from(1 << 20);
        ((low + part * (high - low)) * f64::from(1 << 20)).round() / f64::from(1 << 20)
    };
    let mut placement = |size: f64| Placement {
        at: Vector2::new(number(-size, size), number(-size, size)),
        direction: Vector2::new(number(-4.0, 4.0), number(-4.0, 4.0)),
    };
    let legs = kinds.map(|kind| Leg {
        base: placement(8.0),
        links: [placement(4.0), placement(4.0)],
        platform: placement(2.0),
        ..kind.parse().expect("a leg type")
    });
    Manipulator::new("", legs.to_vec()).expect("is sound")
}

/// Shows that a polynomial in x and y has no factor over the rationals: in how many primes, or `None` where that is not shown.
///
/// A factor of it is one of its restriction to y = 1, if that keeps the degree, and one modulo every prime; so its degree is a sum of
/// degrees of factors modulo each.
fn irreducible(curve: &Poly<Integer>) -> Option<usize> {
    let degree = curve.total_degree() as usize;
    let mut restricted = vec![Integer::ZERO; degree + 1];
    for (monomial, coefficient) in curve.terms() {
        restricted[monomial.exponent(0) as usize] += coefficient;
    }
    let mut possible: BTreeSet<usize> = (0..=degree).collect();
    let mut prime = 1_000_003_u64;
    for tried in 1..200 {
        let reduced: Vec<u64> = restricted.iter().map(|c| remainder(c, prime)).collect();
        if reduced[degree] != 0
            && let Some(degrees) = factor_degrees(&reduced, prime)
        {
            let mut sums = BTreeSet::from([0]);
            for d in degrees {
                sums.extend(sums.clone().into_iter().map(|sum| sum + d));
            }
            possible.retain(|d| sums.contains(d));
            if possible.len() == 2 {
                return Some(tried);
            }
        }
        prime = next_prime(prime);
    }
    None
}

fn remainder(c: &Integer, prime: u64) -> u64 {
    let rest = i64::try_from(c.clone() % Integer::from(prime)).expect("below the prime");
    rest.rem_euclid(prime as i64) as u64
}

fn next_prime(after: u64) -> u64 {
    let is_prime = |n: u64| (2..).take_while(|d| d * d <= n).all(|d| !n.is_multiple_of(d));
    (after + 1..).find(|&n| is_prime(n)).expect("there are more primes")
}

/// Degrees of the irreducible factors modulo a prime, by distinct degrees (Gauss; von zur Gathen and Gerhard, algorithm 14.3); `None` where a
/// factor is repeated.
fn factor_degrees(f: &[u64], p: u64) -> Option<Vec<usize>> {
    let derivative: Vec<u64> = f.iter().enumerate().skip(1).map(|(k, c)| k as u64 % p * c % p).collect();
    if gcd(f, &derivative, p).len() > 1 {
        return None;
    }
    let (mut rest, mut out) = (f.to_vec(), Vec::new());
    let mut power = vec![0, 1];
    for degree in 1.. {
        if rest.len() <= 2 * degree {
            break;
        }
        power = raised(&power, p, &rest, p);
        // The factors of degree `degree` divide x^(p^degree) - x.
        let mut less = power.clone();
        less.resize(less.len().max(2), 0);
        less[1] = (less[1] + p - 1) % p;
        let common = gcd(&rest, &trimmed(less), p);
        for _ in 0..(common.len() - 1) / degree {
            out.push(degree);
        }
        if common.len() > 1 {
            rest = divided(&rest, &common, p).0;
            power = divided(&power, &rest, p).1;
        }
    }
    if rest.len() > 1 {
        out.push(rest.len() - 1);
    }
    Some(out)
}

fn trimmed(mut f: Vec<u64>) -> Vec<u64> {
    while f.last() == Some(&0) {
        f.pop();
    }
    f
}

fn inverse(a: u64, p: u64) -> u64 {
    let (mut base, mut exponent, mut out) = (a % p, p - 2, 1);
    while exponent > 0 {
        if exponent & 1 == 1 {
            out = out * base % p;
        }
        base = base * base % p;
        exponent >>= 1;
    }
    out
}

/// Quotient and remainder.
fn divided(f: &[u64], g: &[u64], p: u64) -> (Vec<u64>, Vec<u64>) {
    let mut rest = f.to_vec();
    if f.len() < g.len() {
        return (Vec::new(), rest);
    }
    let lead = inverse(g[g.len() - 1], p);
    let mut quotient = vec![0; f.len() + 1 - g.len()];
    for k in (0..quotient.len()).rev() {
        let factor = rest[k + g.len() - 1] * lead % p;
        quotient[k] = factor;
        for (j, c) in g.iter().enumerate() {
            rest[k + j] = (rest[k + j] + (p - factor) * c) % p;
        }
    }
    (trimmed(quotient), trimmed(rest))
}

fn gcd(f: &[u64], g: &[u64], p: u64) -> Vec<u64> {
    let (mut a, mut b) = (trimmed(f.to_vec()), trimmed(g.to_vec()));
    while !b.is_empty() {
        let rest = divided(&a, &b, p).1;
        a = std::mem::replace(&mut b, rest);
    }
    a
}

/// `base^exponent` modulo `f`.
fn raised(base: &[u64], exponent: u64, f: &[u64], p: u64) -> Vec<u64> {
    let product = |a: &[u64], b: &[u64]| {
        let mut out = vec![0; (a.len() + b.len()).max(1)];
        for (i, x) in a.iter().enumerate() {
            for (j, y) in b.iter().enumerate() {
                out[i + j] = (out[i + j] + x * y) % p;
            }
        }
        divided(&trimmed(out), f, p).1
    };
    let (mut square, mut left, mut out) = (divided(base, f, p).1, exponent, vec![1]);
    while left > 0 {
        if left & 1 == 1 {
            out = product(&out, &square);
        }
        square = product(&square, &square);
        left >>= 1;
    }
    out
}

pub fn main() {
    print!("{}", document());
}

#[test]
fn every_step_holds() {
    assert!(!document().is_empty());
}
