//! The loop equations at a pose, linearised; and how far the assembly is from there, proved.
//!
//! Unknowns are the place `u` of the reference leg's platform point and the angle `phi`. A third form of the equations beside rows linear in `u`
//! ([`super::triad`]) and measured distances ([`super::verify`]), and the one whose zeros are regular wherever an assembly is.
//!
//! | leg | value | force, the derivative by `u` | moment, by `phi` |
//! |---|---|---|---|
//! | RR | `k·k - l²`, `k = u + R beta - alpha` | `2k` | `R beta x 2k` |
//! | PR | `n·k` | `n` | `R beta x n` |
//! | RP | `(R m)·(u - alpha) + m·beta + delta` | `R m` | `(R m) x (u - alpha)` |
//!
//! Source: Newton's method; Krawczyk 1969 and Kantorovich's bound on second derivatives for the proof, step 7 of the derivation `filter_bound`.

use super::triad::LegNumbers;
use crate::algebra::{Bounded, Gaussian, Lanes, Ring};
use crate::roots::WIDTH;

type L = Lanes<WIDTH>;

/// A closure equation at a pose: its value, and its derivatives.
#[derive(Clone, Copy)]
pub(super) struct ClosureRow<R> {
    pub(super) value: R,
    pub(super) force: Gaussian<R>,
    pub(super) moment: R,
}

/// The equation of a leg. `number` takes the leg's numbers to the ring; kinds of legs are told apart before their numbers are spread over
/// lanes, which the compiler does not do by itself.
#[inline(always)]
pub(super) fn closure_row<R: Ring + Copy>(
    leg: &LegNumbers<f64>,
    number: impl Fn(f64) -> R,
    u: Gaussian<R>,
    c: R,
    s: R,
) -> ClosureRow<R> {
    let rotation = Gaussian::new(c, s);
    let point = |p: Gaussian<f64>| Gaussian::new(number(p.re), number(p.im));
    match *leg {
        LegNumbers::Circle { alpha, beta, length } => {
            let (arm, length) = (rotation * point(beta), number(length));
            let along = u + arm - point(alpha);
            let force = along + along;
            ClosureRow { value: along.norm_sqr() - length * length, force, moment: arm.cross(&force) }
        }
        LegNumbers::Line { alpha, beta, normal } => {
            let (arm, force) = (rotation * point(beta), point(normal));
            ClosureRow { value: force.dot(&(u + arm - point(alpha))), force, moment: arm.cross(&force) }
        }
        LegNumbers::PlatformLine { alpha, beta, normal, delta } => {
            let (normal, away) = (point(normal), u - point(alpha));
            let force = rotation * normal;
            let value = force.dot(&away) + (normal.dot(&point(beta)) + number(delta));
            ClosureRow { value, force, moment: force.cross(&away) }
        }
    }
}

/// The equations of three legs in several poses.
#[inline(always)]
pub(super) fn closure_rows(legs: &[LegNumbers<f64>; 3], u: Gaussian<L>, c: L, s: L) -> [ClosureRow<L>; 3] {
    [
        closure_row(&legs[0], L::all, u, c, s),
        closure_row(&legs[1], L::all, u, c, s),
        closure_row(&legs[2], L::all, u, c, s),
    ]
}

/// One step of Newton's method: by how much `u` and `phi` change.
#[inline(always)]
pub(super) fn newton_step<const N: usize>(rows: &[ClosureRow<Lanes<N>>; 3]) -> (Gaussian<Lanes<N>>, Lanes<N>) {
    let [p, q, r] = rows;
    let y = inverse(rows);
    let step = |k: usize| -(y[k][0] * p.value + y[k][1] * q.value + y[k][2] * r.value);
    (Gaussian::new(step(0), step(1)), step(2))
}

/// The inverse of the matrix of derivatives, by cofactors: columns belong to the legs, rows to `u` and `phi`.
#[inline(always)]
fn inverse<const N: usize>([p, q, r]: &[ClosureRow<Lanes<N>>; 3]) -> [[Lanes<N>; 3]; 3] {
    let (pq, qr, rp) = (p.force.cross(&q.force), q.force.cross(&r.force), r.force.cross(&p.force));
    let scale = Lanes::all(1.0) / (p.moment * qr + q.moment * rp + r.moment * pq);
    let minor = |a: &ClosureRow<Lanes<N>>, b: &ClosureRow<Lanes<N>>| {
        let x = (a.force.im * b.moment - b.force.im * a.moment) * scale;
        let y = (b.force.re * a.moment - a.force.re * b.moment) * scale;
        (x, y)
    };
    let (of_p, of_q, of_r) = (minor(q, r), minor(r, p), minor(p, q));
    [[of_p.0, of_q.0, of_r.0], [of_p.1, of_q.1, of_r.1], [qr * scale, rp * scale, pq * scale]]
}

/// How far the only assembly near a pose can be from it: bounds on the differences in `u` (both coordinates) and in `phi`; NaN or infinite where none is proved.
///
/// `(c, s)` stands for the direction it points in; it has modulus 1 to within four roundings. The legs' numbers stand for all within `roundings` roundings.
#[inline(always)]
pub(super) fn proved_radii(
    legs: &[LegNumbers<f64>; 3],
    roundings: u32,
    u: Gaussian<L>,
    c: L,
    s: L,
    used: usize,
) -> [L; 3] {
    let rows = closure_rows(legs, u, c, s);
    let y = inverse(&rows);
    // What rounding does to values and derivatives, for all lanes at once.
    let largest = |x: L| x.0[..used].iter().fold(0.0, |m: f64, x| if x.abs() > m { x.abs() } else { m });
    let (ux, uy) = (largest(u.re), largest(u.im));
    let place = Gaussian::new(Bounded::given(ux), Bounded::given(uy));
    let unit = Bounded::rounded_times(1.0, 4);
    let mut radii = [L::all(0.0); 3];
    let (mut value, mut slope, mut curvature) = ([0.0; 3], [0.0; 3], [0.0; 3]);
    for k in 0..3 {
        let bound = closure_row(&legs[k], |x| Bounded::rounded_times(x, roundings), place, unit, unit);
        value[k] = bound.value.error();
        let derivatives = [bound.force.re, bound.force.im, bound.moment];
        // The derivatives' own errors, and those of their products with the inverse: five roundings.
        slope[k] = derivatives.iter().map(|d| d.error() + 5.0 * f64::EPSILON * d.size()).sum();
        curvature[k] = second_derivatives(&legs[k], ux + uy);
    }
    let matrix = rows.map(|row| [row.force.re, row.force.im, row.moment]);
    let (mut eta, mut kappa, mut lambda) = ([L::all(0.0); 3], [L::all(0.0); 3], [L::all(0.0); 3]);
    for i in 0..3 {
        for k in 0..3 {
            let size = y[i][k].map(f64::abs);
            eta[i] = eta[i] + size * (rows[k].value.map(f64::abs) + L::all(value[k]));
            kappa[i] = kappa[i] + size * L::all(slope[k]);
            lambda[i] = lambda[i] + size * L::all(curvature[k]);
        }
        let [p, q, r] = &matrix;
        for (j, ((p, q), r)) in p.iter().zip(q).zip(r).enumerate() {
            let product = y[i][0] * *p + y[i][1] * *q + y[i][2] * *r;
            let identity = if i == j { 1.0 } else { 0.0 };
            kappa[i] = kappa[i] + (product - L::all(identity)).map(f64::abs);
        }
    }
    let larger = |x: L, y: L| x.zip(y, |x, y| if x > y { x } else { y });
    // A box half as wide again as Newton's step; the bounds on second derivatives hold within 1.
    let radius = larger(larger(eta[0], eta[1]), eta[2]) * L::all(2.0) + L::all(f64::MIN_POSITIVE);
    let mut proved = radius.map(|r| if r < 0.5 { 0.0 } else { f64::NAN });
    for i in 0..3 {
        radii[i] = (eta[i] + (kappa[i] + lambda[i] * radius) * radius) * L::all(MARGIN);
        proved = proved + radii[i].zip(radius, |new, old| if new < old { 0.0 } else { f64::NAN });
    }
    radii.map(|r| r + proved)
}

/// Covers the rounding of the bounds themselves: sums of a dozen positive terms.
pub(super) const MARGIN: f64 = 1.0 + 1e-12;

/// A bound on the sum of moduli of all second derivatives within 1 of a place at most `u` from the origin.
#[inline(always)]
fn second_derivatives(leg: &LegNumbers<f64>, u: f64) -> f64 {
    let size = |p: &Gaussian<f64>| p.re.abs() + p.im.abs();
    // Within 1 in each coordinate.
    let u = u + 2.0;
    // Rounded up: the sizes are rounded themselves, and turning a vector may make its coordinates' sum larger by sqrt 2.
    let bound = match leg {
        // uu: 2 and 2. u phi: twice 2 (R beta)'. phi phi: 2 (R beta)·(u - alpha).
        LegNumbers::Circle { alpha, beta, .. } => 4.0 + 4.0 * size(beta) + 2.0 * size(beta) * (u + size(alpha)),
        LegNumbers::Line { beta, normal, .. } => size(beta) * size(normal),
        LegNumbers::PlatformLine { alpha, normal, .. } => 2.0 * size(normal) + size(normal) * (u + size(alpha)),
    };
    1.5 * bound
}
