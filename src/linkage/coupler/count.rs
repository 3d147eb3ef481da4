//! In how many finite points do two of these curves meet? Counted exactly, modulo a large prime.
//!
//! The resultant of two equations in a direction of general position has as degree the number of finite intersections: none of them
//! hides behind another, and the points at infinity lower its degree. Two four-bars allow a shorter way: both equations lead with
//! `z^3 w^3`, so their resultant in `w`, formally of degree 18, loses one degree for each intersection at `z = infinity` and, by symmetry, has
//! as many roots that belong to `w = infinity`. A line or a circle makes the equation a polynomial in one parameter whose degree is read off.

use nalgebra::Vector2;

use super::curve::CouplerCurve;
use super::equation::{Biquadratic, coupler_equation};
use crate::algebra::{Gaussian, Residue, Ring};

type Form = Biquadratic<Residue>;

/// How many finite intersections there are, with multiplicity, real and complex; `None` where the curves have a piece in common.
pub(super) fn finite_intersections(one: &CouplerCurve, other: &CouplerCurve) -> Option<usize> {
    let [f, g] = [one, other].map(form);
    let zero = Residue::zero();
    if f.0[3][3] != zero && g.0[3][3] != zero {
        // The coefficient of `z^18` alone tells the usual case.
        if resultant(&f.0[3], &g.0[3]) != zero {
            return Some(18);
        }
        let value = |z: Residue| resultant(&in_w(&f, z), &in_w(&g, z));
        return degree(18, value).map(|found| 18 - 2 * (18 - found));
    }
    let [m, n] = [&f, &g].map(total_degree);
    // Any number will do that is not special.
    let slope = Residue::of_f64(std::f64::consts::E).expect("finite");
    let value = |u: Residue| resultant(&across(&f, u, slope, m), &across(&g, u, slope, n));
    degree(m * n, value)
}

/// How many finite intersections there are with the line `point + t direction`; `None` where the curve contains it.
pub(super) fn finite_on_line(curve: &CouplerCurve, point: &Vector2<f64>, direction: &Vector2<f64>) -> Option<usize> {
    let [p, u] = [point, direction].map(residues);
    let sum = along(&form(curve), [p.0, u.0], [p.1, u.1], 0);
    sum.iter().rposition(|c| *c != Residue::zero())
}

/// How many finite intersections there are with a circle; `None` where the curve contains it.
pub(super) fn finite_on_circle(curve: &CouplerCurve, center: &Vector2<f64>, radius: f64) -> Option<usize> {
    let (o, rho) = (residues(center), Residue::of_f64(radius).expect("finite, as checked"));
    // z = o + rho tau, w = o' + rho / tau; times tau^3.
    let sum = along(&form(curve), [o.0, rho], [rho, o.1], 3);
    let nonzero = |c: &Residue| *c != Residue::zero();
    Some(sum.iter().rposition(nonzero)? - sum.iter().position(nonzero)?)
}

/// The curve's equation.
fn form(curve: &CouplerCurve) -> Form {
    let sides = curve.sides.each_ref().map(|side| side.numbers(|x| Residue::of_f64(x).expect("finite, as validated")));
    Biquadratic(coupler_equation(&sides).0.each_ref().map(|row| row.each_ref().map(Residue::of_gaussian)))
}

/// A point's two isotropic coordinates.
fn residues(v: &Vector2<f64>) -> (Residue, Residue) {
    let z = Gaussian::new(v.x, v.y).map(|&x| Residue::of_f64(x).expect("finite, as checked"));
    (Residue::of_gaussian(&z), Residue::of_gaussian(&z.conj()))
}

/// The equation with `z` and `w` linear in one parameter, constants first; `w` divided by `t^(shift / 3)` where a shift is given.
fn along(form: &Form, z: [Residue; 2], w: [Residue; 2], shift: usize) -> [Residue; 7] {
    let (of_z, of_w) = (powers(z), powers(w));
    let mut sum = [Residue::zero(); 7];
    for (row, z) in form.0.iter().zip(&of_z) {
        for (j, (&c, w)) in row.iter().zip(&of_w).enumerate() {
            // Each power of w has lost one of t where w = o' + rho / t is written rho + o' t.
            let lost = if shift > 0 { shift - j } else { 0 };
            for (a, &x) in z.iter().enumerate() {
                for (b, &y) in w.iter().enumerate().filter(|(b, y)| a + b + lost < 7 && **y != Residue::zero()) {
                    sum[a + b + lost] = sum[a + b + lost] + c * x * y;
                }
            }
        }
    }
    sum
}

/// The powers 0 to 3 of `constant + linear t`, as ascending coefficients.
fn powers([constant, linear]: [Residue; 2]) -> [[Residue; 4]; 4] {
    let mut power = [Residue::one(), Residue::zero(), Residue::zero(), Residue::zero()];
    std::array::from_fn(|k| {
        if k > 0 {
            for i in (0..4).rev() {
                let below = if i > 0 { power[i - 1] } else { Residue::zero() };
                power[i] = power[i] * constant + below * linear;
            }
        }
        power
    })
}

/// Coefficients of the powers of `w`, ascending.
fn in_w(form: &Form, z: Residue) -> Vec<Residue> {
    let column = |j: usize| form.0.iter().rev().fold(Residue::zero(), |sum, row| sum * z + row[j]);
    (0..4).map(column).collect()
}

fn total_degree(form: &Form) -> usize {
    let entries = (0..4).flat_map(|i| (0..4).map(move |j| (i, j)));
    entries.filter(|&(i, j)| form.0[i][j] != Residue::zero()).map(|(i, j)| i + j).max().unwrap_or(0)
}

/// The equation on the line `z = u - slope v`, `w = v`: coefficients of the powers of `v`.
fn across(form: &Form, u: Residue, slope: Residue, degree: usize) -> Vec<Residue> {
    let mut sum = vec![Residue::zero(); degree + 1];
    let mut power = vec![Residue::one()];
    for row in &form.0 {
        for (j, &c) in row.iter().enumerate().filter(|(_, c)| **c != Residue::zero()) {
            for (k, &p) in power.iter().enumerate() {
                sum[j + k] = sum[j + k] + c * p;
            }
        }
        let mut next = vec![Residue::zero(); power.len() + 1];
        for (k, &p) in power.iter().enumerate() {
            next[k] = next[k] + u * p;
            next[k + 1] = next[k + 1] - slope * p;
        }
        power = next;
    }
    sum
}

/// Sylvester's determinant of two polynomials of formal degrees.
fn resultant(f: &[Residue], g: &[Residue]) -> Residue {
    let (m, n) = (f.len() - 1, g.len() - 1);
    let size = m + n;
    let mut rows = vec![vec![Residue::zero(); size]; size];
    for shift in 0..n {
        rows[shift][shift..=shift + m].copy_from_slice(f);
    }
    for shift in 0..m {
        rows[n + shift][shift..=shift + n].copy_from_slice(g);
    }
    let mut determinant = Residue::one();
    for k in 0..size {
        let Some(pivot) = (k..size).find(|&i| rows[i][k] != Residue::zero()) else { return Residue::zero() };
        if pivot != k {
            rows.swap(pivot, k);
            determinant = -determinant;
        }
        let lead = rows[k][k];
        determinant = determinant * lead;
        let Some(inverse) = lead.inverse() else { return Residue::zero() };
        let (above, below) = rows.split_at_mut(k + 1);
        for row in below.iter_mut().filter(|row| row[k] != Residue::zero()) {
            let factor = row[k] * inverse;
            for (entry, &top) in row[k..].iter_mut().zip(&above[k][k..]) {
                *entry = *entry - factor * top;
            }
        }
    }
    determinant
}

/// The degree of a polynomial known to be at most `bound`, from its values; `None` for zero.
fn degree(bound: usize, value: impl Fn(Residue) -> Residue) -> Option<usize> {
    let at = |k: usize| Residue::from_int(k as i64 + 1);
    // Forward differences over equidistant points: the last that does not vanish tells the degree.
    let mut differences: Vec<Residue> = (0..=bound).map(|k| value(at(k))).collect();
    for order in 1..=bound {
        for k in (order..=bound).rev() {
            differences[k] = differences[k] - differences[k - 1];
        }
    }
    differences.iter().rposition(|difference| *difference != Residue::zero())
}
