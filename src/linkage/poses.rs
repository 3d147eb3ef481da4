//! The pose above a root of `T`: from two rows, refined on the loop equations, measured on the geometry. Several side by side.

use super::closure_row::{ClosureRow, newton_step};
use super::triad::{LegNumbers, Row};
use crate::algebra::{Gaussian, Lanes};
use crate::roots::RootsFound;

/// Newton steps on the loop equations, and the step (radians, and lengths over the group's) whose square is below rounding.
pub(super) const STEPS: usize = 3;
pub(super) const LAST_STEP: f64 = 1e-8;
/// The largest turn of a Newton step in radians: angle and direction part by a sixth of its cube, below two units of rounding.
const LARGEST_TURN: f64 = 1e-5;
/// Largest closure error of a pose that needs no second look, over the group's size.
const CLOSURE: f64 = 1e-13;
/// Least determinant of the rows scaled to norm 1: below, a pose may have fewer than nine digits.
const REGULAR: f64 = 1e-6;
/// How far rounding may carry a root out of its part of the circle, in radians.
const ROOM_SLACK: f64 = 1e-9;

/// A pose on the way, in the frame and lengths of the reference leg.
#[derive(Clone, Copy)]
pub(super) struct Approach<const N: usize> {
    /// Place of the reference leg's platform point.
    pub(super) u: Gaussian<Lanes<N>>,
    /// Direction, of modulus 1 but for rounding.
    pub(super) c: Lanes<N>,
    pub(super) s: Lanes<N>,
    /// How far it has been turned in all, and at most in one step.
    pub(super) turned: Lanes<N>,
    pub(super) largest_turn: Lanes<N>,
    /// The last step.
    pub(super) step: Lanes<N>,
}

impl<const N: usize> Approach<N> {
    /// Above the direction of a root.
    #[inline(always)]
    pub(super) fn begin(u: Gaussian<Lanes<N>>, c: Lanes<N>, s: Lanes<N>) -> Self {
        let zero = Lanes::all(0.0);
        Self { u, c, s, turned: zero, largest_turn: zero, step: Lanes::all(1.0) }
    }

    /// One step of Newton's method, given the loop equations here.
    #[inline(always)]
    pub(super) fn step(&mut self, rows: &[ClosureRow<Lanes<N>>; 3]) {
        let (du, dphi) = newton_step(rows);
        self.u = self.u + du;
        self.turned = self.turned + dphi;
        // Of modulus 1 to the fourth power of the step.
        let (dc, ds) = (Lanes::all(1.0) - dphi * dphi * Lanes::all(0.5), dphi);
        (self.c, self.s) = (self.c * dc - self.s * ds, self.s * dc + self.c * ds);
        self.largest_turn = self.largest_turn.larger(dphi.abs());
        self.step = du.re.abs().larger(du.im.abs()).larger(dphi.abs());
    }

    /// Takes back the last step in lanes whose step before was small already.
    #[inline(always)]
    pub(super) fn stay_where_settled(&mut self, before: &Self) {
        let stay = |old: Lanes<N>, new: Lanes<N>| before.step.where_at_most(Lanes::all(LAST_STEP), old, new);
        self.u = Gaussian::new(stay(before.u.re, self.u.re), stay(before.u.im, self.u.im));
        (self.c, self.s) = (stay(before.c, self.c), stay(before.s, self.s));
        self.turned = stay(before.turned, self.turned);
        self.largest_turn = stay(before.largest_turn, self.largest_turn);
        self.step = stay(before.step, self.step);
    }

    /// The direction brought to modulus 1.
    #[inline(always)]
    pub(super) fn direction(&self) -> Gaussian<Lanes<N>> {
        let norm = Lanes::all(1.5) - Lanes::all(0.5) * (self.c * self.c + self.s * self.s);
        Gaussian::new(self.c * norm, self.s * norm)
    }
}

/// The rows' crossing and their cross product.
#[inline(always)]
pub(super) fn crossing<const N: usize>(p: &Row<Lanes<N>>, q: &Row<Lanes<N>>) -> (Lanes<N>, Gaussian<Lanes<N>>) {
    let cross = p.cross(q);
    // g·u = -e for both: Cramer's rule.
    let inverse = Lanes::all(1.0) / cross;
    let x = (q.e * p.g.im - p.e * q.g.im) * inverse;
    let y = (p.e * q.g.re - q.e * p.g.re) * inverse;
    (cross, Gaussian::new(x, y))
}

/// Where those two of three rows cross that do so best.
#[inline(always)]
pub(super) fn best_crossing<const N: usize>(rows: &[Row<Lanes<N>>; 3]) -> Gaussian<Lanes<N>> {
    let [p, q, r] = rows;
    let mut best = crossing(p, q);
    for (cross, u) in [crossing(p, r), crossing(q, r)] {
        let (own, bound) = (best.0.abs(), cross.abs());
        let better = |yes: Lanes<N>, no: Lanes<N>| own.where_less(bound, yes, no);
        best = (better(cross, best.0), Gaussian::new(better(u.re, best.1.re), better(u.im, best.1.im)));
    }
    best.1
}

/// A leg at a pose: its closure error, its unit force, and the moment of that about the reference leg's base point.
#[derive(Clone, Copy)]
pub(super) struct Measured<const N: usize> {
    pub(super) miss: Lanes<N>,
    pub(super) force: Gaussian<Lanes<N>>,
    pub(super) moment: Lanes<N>,
}

impl<const N: usize> Measured<N> {
    /// Measures a leg. `number` spreads its numbers over the lanes.
    #[inline(always)]
    pub(super) fn of(
        leg: &LegNumbers<f64>,
        number: impl Fn(f64) -> Lanes<N>,
        u: Gaussian<Lanes<N>>,
        rotation: Gaussian<Lanes<N>>,
    ) -> Self {
        let point = |p: Gaussian<f64>| Gaussian::new(number(p.re), number(p.im));
        // The length of a normal, by which it is divided.
        let unit = |normal: Gaussian<f64>| {
            let normal = point(normal);
            let inverse = Lanes::all(1.0) / normal.norm_sqr().sqrt();
            (normal.scaled(&inverse), inverse)
        };
        let (miss, force, moment) = match *leg {
            LegNumbers::Circle { alpha, beta, length } => {
                let joint = u + rotation * point(beta);
                let along = joint - point(alpha);
                let distance = along.norm_sqr().sqrt();
                let force = along.scaled(&(Lanes::all(1.0) / distance));
                (distance - number(length), force, joint.cross(&force))
            }
            LegNumbers::Line { alpha, beta, normal } => {
                let (joint, normal) = (u + rotation * point(beta), unit(normal).0);
                (normal.dot(&(joint - point(alpha))), normal, joint.cross(&normal))
            }
            LegNumbers::PlatformLine { alpha, beta, normal, delta } => {
                let (normal, inverse) = unit(normal);
                let (turned, alpha) = (rotation * normal, point(alpha));
                let on_line = u + rotation * point(beta);
                (turned.dot(&(alpha - on_line)) - number(delta) * inverse, turned, alpha.cross(&turned))
            }
        };
        Self { miss: miss.abs(), force, moment }
    }
}

/// What is measured of a pose: the largest closure error, det A, and the determinant of the rows scaled to norm 1.
#[inline(always)]
pub(super) fn measure<const N: usize>([p, q, r]: &[Measured<N>; 3]) -> [Lanes<N>; 3] {
    let residual = p.miss.larger(q.miss).larger(r.miss);
    let det =
        p.moment * q.force.cross(&r.force) + q.moment * r.force.cross(&p.force) + r.moment * p.force.cross(&q.force);
    let norm = |leg: &Measured<N>| leg.force.norm_sqr() + leg.moment * leg.moment;
    let norms = norm(p) * norm(q) * norm(r);
    [residual, det, det * (Lanes::all(1.0) / norms.sqrt())]
}

/// A bit for each lane: whether a pose needs no second look.
#[inline(always)]
pub(super) fn sound<const N: usize>(
    at: &Approach<N>,
    roots: &RootsFound<N>,
    residual: Lanes<N>,
    regular: Lanes<N>,
) -> u32 {
    let slack = Lanes::all(ROOM_SLACK);
    at.step.at_most(Lanes::all(LAST_STEP))
        & residual.at_most(Lanes::all(CLOSURE))
        & at.largest_turn.at_most(Lanes::all(LARGEST_TURN))
        & Lanes::all(REGULAR).at_most(regular.abs())
        & (-roots.below - slack).at_most(at.turned)
        & at.turned.at_most(roots.above + slack)
}

/// An angle beyond a half-turn by less than a turn, in `(-pi, pi]`.
#[inline(always)]
pub(super) fn principal<const N: usize>(phi: Lanes<N>) -> Lanes<N> {
    let (pi, turn) = (Lanes::all(std::f64::consts::PI), Lanes::all(std::f64::consts::TAU));
    let phi = pi.where_less(phi, phi - turn, phi);
    phi.where_at_most(-pi, phi + turn, phi)
}
