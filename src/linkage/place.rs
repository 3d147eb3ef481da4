//! From a root of T to the poses above it.
//!
//! Rows are evaluated at roots that carry three times the digits of `f64`, over the integers; what is then rounded
//! has lost nothing to cancellation. Where a determinant turns out smaller than the root's digits can
//! support, more digits are asked for.

use num_complex::Complex64;

use super::fibre::{Fibre, Part};
use super::triad::{Row, Rows};
use crate::algebra::{Gaussian, Integer, Trig, UPoly, integer_to_f64_scaled};
use crate::roots::{CircleRoot, FIRST_BITS, FineRoot, MAX_BITS, NotLocated, locate_on_circle, quotient, scaled};

/// A solution of the closure equations, seen from the reference leg, lengths in units of `2^unit`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Solution {
    /// `e^(i phi)`.
    pub theta: Complex64,
    /// `u` as a complex number, and its formal conjugate.
    pub u: [Complex64; 2],
    /// Whether this is a real pose, exactly.
    pub real: bool,
    /// Whether another solution has the same orientation.
    pub twin: bool,
}

/// What was found above the roots of one part.
#[derive(Debug)]
pub(super) struct Placed {
    /// Each root and its solutions: none, one or two.
    pub roots: Vec<(Complex64, bool, Vec<Solution>)>,
}

/// Solves every fibre of a part. `exponent` is the unit of length, in bits of the integers.
pub(super) fn place(part: &Part, rows: &Rows<Trig<Integer>>, exponent: i64) -> Result<Placed, NotLocated> {
    place_on(part, &ThetaRows::of(rows), exponent)
}

/// The same for a platform pinned at the reference point, above which nothing is left to solve.
pub(super) fn place_pinned(part: &Part) -> Result<Placed, NotLocated> {
    place_on(part, &ThetaRows { radius: None, rows: Vec::new() }, 0)
}

fn place_on(part: &Part, rows: &ThetaRows, exponent: i64) -> Result<Placed, NotLocated> {
    let mut bits = FIRST_BITS;
    loop {
        let roots = locate_on_circle(&part.in_theta, &part.in_chart, bits)?;
        let above: Option<Vec<_>> = roots
            .iter()
            .map(|root| {
                let theta = root.root.to_complex();
                rows.above(root, part.fibre, exponent).map(|solutions| (theta, root.on_circle, solutions))
            })
            .collect();
        match above {
            Some(roots) => return Ok(Placed { roots }),
            None if 2 * bits <= MAX_BITS => bits *= 2,
            None => return Err(NotLocated::Ambiguous { counted: roots.iter().filter(|r| r.on_circle).count(), bits }),
        }
    }
}

/// A row as polynomials in theta: `A U + B V + C = 0`, each multiplied by `2 theta`, formal degree 2.
struct ThetaRow([UPoly<Gaussian<Integer>>; 3]);

struct ThetaRows {
    radius: Option<Integer>,
    rows: Vec<ThetaRow>,
}

/// A row's numbers at one root.
type RowValues = [Gaussian<Integer>; 3];

/// Digits that must be left in a determinant or discriminant after cancellation, in bits.
const KEPT_BITS: i64 = 80;

impl ThetaRows {
    fn of(rows: &Rows<Trig<Integer>>) -> Self {
        let i = Gaussian::new(Integer::ZERO, Integer::ONE);
        let row = |row: &Row<Trig<Integer>>| {
            let (x, y, e) = (row.g.re.theta(1), row.g.im.theta(1).scaled(&i), row.e.theta(1));
            ThetaRow([x.clone() - y.clone(), x + y, e.clone() + e])
        };
        match rows {
            Rows::Circle { radius, rows } => {
                // The radius is a constant trigonometric polynomial.
                let radius = radius.evaluate(Clone::clone, &Integer::ONE, &Integer::ZERO);
                Self { radius: Some(radius), rows: rows.iter().map(row).collect() }
            }
            Rows::Lines(rows) => Self { radius: None, rows: rows.iter().map(row).collect() },
        }
    }

    /// The solutions above one root; `None` where the root needs more digits.
    fn above(&self, root: &CircleRoot, fibre: Fibre, exponent: i64) -> Option<Vec<Solution>> {
        let theta = root.root.to_complex();
        let solution = |u: [Complex64; 2], real, twin| Solution { theta, u, real, twin };
        let values = || -> Vec<RowValues> { self.rows.iter().map(|row| row.at(&root.root)).collect() };
        let bits = root.root.significant_bits() as i64;
        match fibre {
            Fibre::Empty(_) | Fibre::Curve => Some(Vec::new()),
            Fibre::Centre => Some(vec![solution([Complex64::ZERO; 2], root.on_circle, false)]),
            Fibre::Point => {
                let u = crossing(&values(), exponent, bits)?;
                Some(vec![solution(u, root.on_circle, false)])
            }
            Fibre::Pair | Fibre::Tangent => {
                let radius = self.radius.as_ref().expect("only a reference circle has pairs");
                let line = thickest(values());
                let points = line_and_circle(&line, radius, &root.root, exponent, fibre)?;
                let real = root.on_circle && points.real;
                let count = if fibre == Fibre::Tangent { 1 } else { 2 };
                Some(points.at[..count].iter().map(|&u| solution(u, real, count == 2)).collect())
            }
            Fibre::IsotropicPoint => {
                let radius = self.radius.as_ref().expect("only a reference circle meets isotropic lines");
                Some(vec![solution(isotropic_point(&thickest(values()), radius, exponent), false, false)])
            }
        }
    }
}

impl ThetaRow {
    fn at(&self, root: &FineRoot) -> RowValues {
        self.0.each_ref().map(|p| root.evaluate(p, 2))
    }
}

/// log2 of a number's size, roughly; `i64::MIN / 4` for zero.
fn magnitude(x: &Gaussian<Integer>) -> i64 {
    let part = |n: &Integer| {
        let (mantissa, exponent) = integer_to_f64_scaled(n);
        if mantissa == 0.0 { i64::MIN / 4 } else { exponent + 64 }
    };
    part(&x.re).max(part(&x.im))
}

/// The row with the largest normal.
fn thickest(rows: Vec<RowValues>) -> RowValues {
    let thickness = |row: &RowValues| magnitude(&row[0]).max(magnitude(&row[1]));
    rows.into_iter().max_by_key(thickness).expect("a triad has rows")
}

/// Where the best-conditioned two of the rows cross.
fn crossing(rows: &[RowValues], exponent: i64, bits: i64) -> Option<[Complex64; 2]> {
    let minor =
        |p: &RowValues, q: &RowValues, i: usize, j: usize| p[i].clone() * q[j].clone() - q[i].clone() * p[j].clone();
    let thickness = |row: &RowValues| magnitude(&row[0]).max(magnitude(&row[1]));
    let pairs = (0..rows.len()).flat_map(|i| (0..i).map(move |j| (j, i)));
    let (loss, determinant, p, q) = pairs
        .map(|(i, j)| {
            let determinant = minor(&rows[i], &rows[j], 0, 1);
            let loss = thickness(&rows[i]) + thickness(&rows[j]) - magnitude(&determinant);
            (loss, determinant, &rows[i], &rows[j])
        })
        .min_by_key(|pair| pair.0)?;
    if loss > bits - KEPT_BITS {
        return None;
    }
    let u = minor(p, q, 1, 2);
    let v = minor(p, q, 2, 0);
    Some([u, v].map(|numerator| quotient(&numerator, &determinant, -exponent)))
}

/// Two points of a line and a circle.
struct LineAndCircle {
    at: [[Complex64; 2]; 2],
    /// Whether both are real, given that the line is.
    real: bool,
}

/// The points of `A U + B V + C = 0` on `U V = radius²`.
fn line_and_circle(
    [a, b, c]: &RowValues,
    radius: &Integer,
    root: &FineRoot,
    exponent: i64,
    fibre: Fibre,
) -> Option<LineAndCircle> {
    let ab = (a.clone() * b.clone()).scaled(&(Integer::from(4) * radius.clone() * radius.clone()));
    let cc = c.clone() * c.clone();
    let discriminant = cc.clone() - ab.clone();
    let half = Complex64::new(-0.5, 0.0);
    let points = |root_over_b: Complex64, root_over_a: Complex64| {
        let (v, u) = (quotient(c, b, -exponent), quotient(c, a, -exponent));
        [[half * (u + root_over_a), half * (v - root_over_b)], [half * (u - root_over_a), half * (v + root_over_b)]]
    };
    if fibre == Fibre::Tangent {
        return Some(LineAndCircle { at: points(Complex64::ZERO, Complex64::ZERO), real: true });
    }
    let loss = magnitude(&cc).max(magnitude(&ab)) - magnitude(&discriminant);
    if loss > root.significant_bits() as i64 - KEPT_BITS {
        return None;
    }
    // Rows carry a factor theta, squared in the discriminant; without it a real line has a real discriminant.
    let theta_squared = root.numerator.clone() * root.numerator.clone();
    let normalised = quotient(&discriminant, &theta_squared, 0);
    let over_b = quotient(&discriminant, &(b.clone() * b.clone()), -2 * exponent).sqrt();
    // Both roots stem from one square root: its quotient by A follows from that by B.
    let over_a = over_b * quotient(b, a, 0);
    Some(LineAndCircle { at: points(over_b, over_a), real: normalised.re < 0.0 })
}

/// The one finite point of an isotropic line, `A = 0` or `B = 0`, on `U V = radius²`.
fn isotropic_point([a, b, c]: &RowValues, radius: &Integer, exponent: i64) -> [Complex64; 2] {
    let square = Complex64::from(scaled(&Gaussian::real(radius.clone() * radius.clone()), -2 * exponent).re);
    if magnitude(a) > magnitude(b) {
        let u = -quotient(c, a, -exponent);
        [u, square / u]
    } else {
        let v = -quotient(c, b, -exponent);
        [square / v, v]
    }
}
