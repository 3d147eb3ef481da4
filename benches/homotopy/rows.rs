//! The loop equations of a triad, each a row of eight coefficients.
//!
//! With `u = z + theta b1 - a1`, `v = w + tau conj(b1) - conj(a1)` (the reference leg's platform point, seen from its base point), and
//! `alpha`, `beta` the points of a leg less those of the reference leg, every leg reads
//!
//! `c0 u v + c1 tau u + c2 theta v + c3 u + c4 v + c5 theta + c6 tau + c7 = 0`
//!
//! | leg | equation |
//! |---|---|
//! | RR | `(u + theta beta - alpha)(v + tau conj(beta) - conj(alpha)) = l²` |
//! | PR, normal `n = i u` | `conj(n) (u + theta beta - alpha) + n (v + tau conj(beta) - conj(alpha)) = 0` |
//! | RP, normal `m = i v` | `conj(m) (tau (alpha - u) - beta) + m (theta (conj(alpha) - v) - conj(beta)) = 2 delta` |
//!
//! From a second and third RR leg the first is subtracted, so that only the reference leg has `c0`. The coefficients of each
//! name fill a linear space, and a generic point of it has as many solutions as a generic triad of that name:
//! a straight line between two of its points makes a coefficient-parameter homotopy.

use assur::{Dyad, Offset, Triad};
use num_complex::Complex64;

use super::Solution;
use super::linear::{Matrix, Vector};

/// Coefficients of `u v`, `tau u`, `theta v`, `u`, `v`, `theta`, `tau`, `1`.
pub type Row = [Complex64; 8];

/// Legs in the order in which they are solved: RR, PR, RP.
const ORDER: [&str; 3] = ["RR", "PR", "RP"];

/// Which coefficients the rows of these legs, reference leg first, may have.
pub fn support(names: &[&str; 3]) -> [[bool; 8]; 3] {
    std::array::from_fn(|i| match (names[i], i) {
        ("RR", 0) => [true, false, false, false, false, false, false, true],
        ("RR", _) => [false, true, true, true, true, true, true, true],
        ("PR", 0) => [false, false, false, true, true, false, false, false],
        ("PR", _) => [false, false, false, true, true, true, true, true],
        ("RP", 0) => [false, true, true, false, false, false, false, true],
        ("RP", _) => [false, true, true, false, false, true, true, true],
        (other, _) => panic!("{other} is no leg of a turning platform"),
    })
}

/// A triad as three rows, lengths divided by its size.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The rows, reference leg first.
    pub rows: [Row; 3],
    /// Names of the legs in that order.
    pub names: [&'static str; 3],
    size: f64,
    a: Complex64,
    b: Complex64,
}

impl Problem {
    /// The rows of a triad without PP legs.
    pub fn of(triad: &Triad) -> Self {
        let mut legs = *triad.legs();
        let rank = |leg: &Dyad| ORDER.iter().position(|&name| name == leg.name()).expect("no PP leg");
        legs.sort_by_key(rank);
        let (a, b) = points(&legs[0]);
        let extent = |leg: &Dyad| {
            let (p, q) = points(leg);
            let length = match leg {
                Dyad::RR { length, .. } => *length,
                _ => 0.0,
            };
            (p - a).norm().max((q - b).norm()).max(length)
        };
        let size = legs.iter().map(extent).fold(0.0, f64::max);
        let size = if size > 0.0 { size } else { 1.0 };
        let first = match legs[0] {
            Dyad::RR { length, .. } => Some(length / size),
            _ => None,
        };
        let rows = std::array::from_fn(|i| row(&legs[i], [a, b], size, first.filter(|_| i > 0)));
        Self { rows, names: legs.each_ref().map(|leg| ORDER[rank(leg)]), size, a, b }
    }

    /// The solution in the frames and lengths of the triad.
    pub fn solution(&self, [theta, u, v]: &Vector<3>) -> Solution {
        let tau = theta.inv();
        let z = u * self.size + self.a - theta * self.b;
        let w = v * self.size + self.a.conj() - tau * self.b.conj();
        Solution { theta: *theta, z, w, residual: residual(&self.rows, &[*theta, *u, *v]) }
    }
}

fn points(leg: &Dyad) -> (Complex64, Complex64) {
    match leg {
        Dyad::RR { a, b, .. } | Dyad::PR { a, b, .. } | Dyad::RP { a, b, .. } => {
            (Complex64::new(a.x, a.y), Complex64::new(b.x, b.y))
        }
        Dyad::PP { .. } => panic!("a PP leg turns no platform"),
    }
}

/// The row of a leg; `subtract` is the reference circle's radius.
fn row(leg: &Dyad, [a0, b0]: [Complex64; 2], size: f64, subtract: Option<f64>) -> Row {
    let zero = Complex64::ZERO;
    let (a, b) = points(leg);
    let (alpha, beta) = ((a - a0) / size, (b - b0) / size);
    let mut row = match leg {
        Dyad::RR { length, .. } => {
            let l = length / size;
            let own = alpha.norm_sqr() + beta.norm_sqr();
            let squares = subtract.map_or(-l * l, |radius| own - (l - radius) * (l + radius));
            let uv = if subtract.is_some() { 0.0 } else { 1.0 };
            [
                uv.into(),
                beta.conj(),
                beta,
                -alpha.conj(),
                -alpha,
                -beta * alpha.conj(),
                -alpha * beta.conj(),
                squares.into(),
            ]
        }
        Dyad::PR { u, .. } => {
            let n = Complex64::new(-u.y, u.x) / u.norm();
            let constant = -2.0 * (n.conj() * alpha).re;
            [zero, zero, zero, n.conj(), n, n.conj() * beta, n * beta.conj(), constant.into()]
        }
        Dyad::RP { v, offset, .. } => {
            let m = Complex64::new(-v.y, v.x) / v.norm();
            let distance = match offset {
                Offset::Distance(d) => *d,
                Offset::TimesDirection(delta) => delta / v.norm(),
            };
            let constant = 2.0 * (m.conj() * beta).re + 2.0 * distance / size;
            [zero, m.conj(), m, zero, zero, -m * alpha.conj(), -m.conj() * alpha, constant.into()]
        }
        Dyad::PP { .. } => unreachable!("its points were refused above"),
    };
    let largest = row.iter().map(|c| c.norm()).fold(0.0, f64::max);
    for c in &mut row {
        *c /= largest;
    }
    row
}

/// Largest defect of three rows at `(theta, u, v)`, each over the sum of the moduli of its terms.
pub fn residual(rows: &[Row; 3], [theta, u, v]: &Vector<3>) -> f64 {
    let tau = theta.inv();
    let monomials = [u * v, tau * u, theta * v, *u, *v, *theta, tau, Complex64::ONE];
    let defect = |row: &Row| {
        let terms: [Complex64; 8] = std::array::from_fn(|i| row[i] * monomials[i]);
        let sum: Complex64 = terms.iter().sum();
        let sizes: f64 = terms.iter().map(|term| term.norm()).sum();
        sum.norm() / sizes
    };
    rows.iter().map(defect).fold(0.0, f64::max)
}

/// Rows and their Jacobian in `(theta, u, v)`.
#[inline]
pub fn system(rows: &[Row; 3], [theta, u, v]: &Vector<3>) -> (Vector<3>, Matrix<3>) {
    let tau = theta.inv();
    let minus_tau2 = -tau * tau;
    let mut value = [Complex64::ZERO; 3];
    let mut jacobian = [[Complex64::ZERO; 3]; 3];
    for i in 0..3 {
        let c = &rows[i];
        let (by_u, by_v) = (c[1] * tau + c[3], c[2] * theta + c[4]);
        value[i] = u * by_u + v * by_v + c[5] * theta + c[6] * tau + c[7];
        jacobian[i] = [c[2] * v + c[5] + minus_tau2 * (c[1] * u + c[6]), by_u, by_v];
    }
    // Only the reference leg has u v.
    let (c0_u, c0_v) = (rows[0][0] * u, rows[0][0] * v);
    value[0] += c0_u * v;
    jacobian[0][1] += c0_v;
    jacobian[0][2] += c0_u;
    (value, jacobian)
}
