//! All real assembly modes, fast.
//!
//! `T(phi)` is evaluated at eight orientations side by side, with one bound on all rounding errors; its real roots are counted with a proof and found on
//! the circle ([`Harmonics::real_roots`]); above each the pose is taken from two rows, refined by Newton's method on the loop equations, and measured on the
//! geometry. Nothing is allocated. Wherever a bound does not decide, or a pose would have fewer than nine sure digits, the reference
//! route ([`Triad::assemble`]) answers instead.
//!
//! What it does not give: non-real solutions, boxes, the account; and triads with a PP leg always take the reference route.

use std::sync::LazyLock;

use super::assemblies::{AssemblyMode, Status};
use super::closure_row::{MARGIN, WIDTH, closure_rows, newton_step, proved_radii};
use super::group::{Dyad, Offset, Pose, Triad};
use super::loop_box::{IntervalTriad, PoseIntervals};
use super::triad::{LegNumbers, Row, Rows, leg_row, rows_consistency};
use super::verify::size;
use crate::algebra::{Bounded, Gaussian, Interval, Lanes, Ring};
use crate::roots::{CountedRoots, Harmonics};

/// As many isolated real modes as any triad has.
pub const MOST_MODES: usize = 6;

/// Which way an answer was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModesRoute {
    /// In floating point; its error bound proved the count.
    Fast,
    /// The reference route, over integers, since the bound did not decide.
    Reference,
}

/// A real assembly mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RealMode {
    /// The pose of the platform.
    pub pose: Pose,
    /// How many modes meet here.
    pub multiplicity: usize,
    /// Largest closure error of the assembled group over its largest length, measured on the geometry.
    pub residual: f64,
    /// As [`AssemblyMode::det_a`].
    pub det_a: f64,
}

const NO_MODE: RealMode =
    RealMode { pose: Pose { x: 0.0, y: 0.0, phi: 0.0 }, multiplicity: 0, residual: 0.0, det_a: 0.0 };

const NONE_YET: RealModes =
    RealModes { modes: [NO_MODE; MOST_MODES], count: 0, status: Status::Complete, route: ModesRoute::Fast };

/// All real assembly modes of a triad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RealModes {
    modes: [RealMode; MOST_MODES],
    count: usize,
    /// `Complete`: these are all. `SelfMotion`: there is also a curve of poses. `Undecided`: the list may be short.
    pub status: Status,
    /// Which way they were found.
    pub route: ModesRoute,
}

impl RealModes {
    /// The modes, sorted by `phi`, `x`, `y`.
    pub fn modes(&self) -> &[RealMode] {
        &self.modes[..self.count]
    }
}

impl Triad {
    /// Every real assembly mode, fast: the same modes as [`Triad::assemble`] lists.
    ///
    /// **Shape**: at most six modes, sorted by `phi`, then `x`, then `y`. **Units and frame**: as [`Triad::assemble`]. **Accuracy**: at least nine digits of the
    /// distance from the group, as a rule fifteen. **Proof**: the number of roots of `T` is exact, by a bound on all rounding errors or by integers;
    /// poses above them are measured (closure, regularity, their part of the circle), and [`Triad::prove`] boxes them.
    /// **Cost**: about a microsecond, a millisecond where the bound does not decide (about one random triad in a hundred thousand; `benches/real_modes.rs`).
    ///
    /// ```
    /// use assur::{Dyad, ModesRoute, Triad};
    /// let leg = |a: [f64; 2], b: [f64; 2], length| Dyad::RR { a: a.into(), b: b.into(), length };
    /// let triad = Triad::new([
    ///     leg([0.0, 0.0], [0.0, 0.0], 14.98),
    ///     leg([15.91, 0.0], [17.045, 0.0], 15.38),
    ///     leg([0.0, 10.0], [13.2389, 16.0929], 12.0),
    /// ])?;
    /// let found = triad.real_modes();
    /// assert_eq!((found.modes().len(), found.route), (6, ModesRoute::Fast));
    /// assert!(found.modes().iter().all(|mode| mode.residual < 1e-15));
    /// # Ok::<(), assur::TriadError>(())
    /// ```
    pub fn real_modes(&self) -> RealModes {
        let mut out = NONE_YET;
        if !ARCH.dispatch(Fast(self, &mut out, None)) {
            out = self.real_modes_reference();
        }
        out
    }

    /// The fast way alone; `None` where its bounds do not decide.
    pub fn real_modes_fast(&self) -> Option<RealModes> {
        let mut out = NONE_YET;
        ARCH.dispatch(Fast(self, &mut out, None)).then_some(out)
    }

    /// The fast way with a box around each mode, each proved to hold exactly one assembly; in no order.
    pub(super) fn boxes_fast(&self) -> Option<(Boxes, usize)> {
        let (mut out, mut boxes) = (NONE_YET, [[Interval::ZERO; 3]; MOST_MODES]);
        ARCH.dispatch(Fast(self, &mut out, Some(&mut boxes))).then_some((boxes, out.count))
    }

    /// The reference way, in the same form.
    #[cold]
    pub fn real_modes_reference(&self) -> RealModes {
        let answer = self.assemble();
        let mut out =
            RealModes { modes: [NO_MODE; MOST_MODES], count: 0, status: answer.status, route: ModesRoute::Reference };
        for AssemblyMode { pose, multiplicity, residual, det_a, .. } in answer.modes {
            out.modes[out.count] = RealMode { pose, multiplicity, residual, det_a };
            out.count += 1;
        }
        out
    }
}

/// The processor's SIMD registers.
static ARCH: LazyLock<pulp::Arch> = LazyLock::new(pulp::Arch::new);

/// The fast way, compiled for each kind of SIMD register: everything it calls must be inlined.
struct Fast<'a>(&'a Triad, &'a mut RealModes, Option<&'a mut Boxes>);

/// `[x, y, phi]` of each mode, before sorting.
pub(super) type Boxes = [PoseIntervals; MOST_MODES];

impl pulp::NullaryFnOnce for Fast<'_> {
    type Output = bool;
    #[inline(always)]
    fn call(self) -> Self::Output {
        fast(self.0, self.1, self.2).is_some()
    }
}

/// Newton steps on the loop equations, and the step (radians, and lengths over the group's) whose square is below rounding.
const STEPS: usize = 3;
const LAST_STEP: f64 = 1e-8;
/// The largest turn of a Newton step in radians: angle and direction part by a sixth of its cube, below two units of rounding.
const LARGEST_TURN: f64 = 1e-5;
/// Largest closure error of a pose that needs no second look, over the group's size.
const CLOSURE: f64 = 1e-13;
/// Least determinant of the rows scaled to norm 1: below, a pose may have fewer than nine digits.
const REGULAR: f64 = 1e-6;
/// How far rounding may carry a root out of its part of the circle, in radians.
const ROOM_SLACK: f64 = 1e-9;

/// Lengths are taken in units of a power of two; beyond these exponents underflow would not be covered by the bound.
const EXPONENTS: std::ops::RangeInclusive<i32> = -300..=300;

#[inline(always)]
fn fast(triad: &Triad, out: &mut RealModes, mut boxes: Option<&mut Boxes>) -> Option<()> {
    let local = Local::of(triad)?;
    let unit = Bounded::rounded(1.0);
    let bound = rows_consistency(&rows(&local.legs, |x| Bounded::rounded_times(x, local.roundings), unit, unit));
    let values = rows_consistency(&rows(&local.legs, Lanes::<8>::all, Lanes(COSINES), Lanes(SINES)));
    let roots = match Harmonics::from_samples(&values.0, local.order, bound.error()).real_roots() {
        Some(roots) => roots,
        None => closer_look(triad)?,
    };
    out.count = roots.count();
    for first in (0..roots.count()).step_by(WIDTH) {
        local.poses(&roots, first, out, boxes.as_deref_mut())?;
    }
    out.sort();
    Some(())
}

/// The roots by coefficients in intervals: a closer bound, which some random triads in ten thousand need.
#[cold]
#[inline(never)]
fn closer_look(triad: &Triad) -> Option<CountedRoots> {
    let (even, odd) = IntervalTriad::of(triad)?.consistency();
    Harmonics::from_powers(&even, &odd).real_roots()
}

const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Cosines and sines of the multiples of a quarter of pi, each rounded once.
const COSINES: [f64; 8] = [1.0, HALF, 0.0, -HALF, -1.0, -HALF, 0.0, HALF];
const SINES: [f64; 8] = [0.0, HALF, 1.0, HALF, 0.0, -HALF, -1.0, -HALF];

/// A triad seen from its reference leg, lengths in units of a power of two.
struct Local {
    /// The reference leg first; `alpha` and `beta` are rounded once.
    legs: [LegNumbers<f64>; 3],
    /// The same with normals of length 1.
    unit_normals: [LegNumbers<f64>; 3],
    /// How often any of these numbers was rounded.
    roundings: u32,
    order: usize,
    /// 1, or -1 where the legs are in an odd permutation of the order given.
    parity: f64,
    /// The unit of length, and the group's size in it.
    unit: f64,
    size: f64,
    /// Base and platform point of the reference leg.
    a0: [f64; 2],
    b0: [f64; 2],
}

impl Local {
    #[inline(always)]
    fn of(triad: &Triad) -> Option<Self> {
        let legs = triad.legs();
        let length = |i: usize| match legs[i] {
            Dyad::RR { length, .. } => length,
            _ => f64::INFINITY,
        };
        // The shortest RR leg, or else the first leg.
        let mut reference = 0;
        for i in [1, 2] {
            if length(i) < length(reference) {
                reference = i;
            }
        }
        let sorted = [[0, 1, 2], [1, 0, 2], [2, 0, 1]][reference];
        let parity = if reference == 1 { -1.0 } else { 1.0 };
        let (a0, b0) = points(&legs[reference])?;
        let mut largest = 0.0f64;
        for leg in legs {
            let (a, b) = points(leg)?;
            let own = match *leg {
                Dyad::RR { length, .. } => length,
                Dyad::RP { offset: Offset::Distance(d), .. } => d.abs(),
                _ => 0.0,
            };
            for x in [own, a[0] - a0[0], a[1] - a0[1], b[0] - b0[0], b[1] - b0[1]] {
                largest = largest.max(x.abs());
            }
        }
        let unit = power_of_two(largest)?;
        let inverse = 1.0 / unit;
        let mut numbers = [LegNumbers::Circle { alpha: ORIGIN, beta: ORIGIN, length: 0.0 }; 3];
        let mut roundings = 1;
        for k in 0..3 {
            let leg = &legs[sorted[k]];
            numbers[k] = local_leg(leg, a0, b0, inverse)?;
            if matches!(leg, Dyad::RP { offset: Offset::Distance(_), .. }) {
                // A square root of a sum, a product, and the rounding that the exact route begins with.
                roundings = 4;
            }
        }
        let unit_normals = three(&numbers, with_unit_normal);
        let size = size(&unit_normals);
        Some(Self { legs: numbers, unit_normals, roundings, order: triad.order()?, parity, unit, size, a0, b0 })
    }

    /// The poses above four roots; `None` where one needs a second look.
    #[inline(always)]
    fn poses(&self, roots: &CountedRoots, first: usize, out: &mut RealModes, boxes: Option<&mut Boxes>) -> Option<()> {
        let take = |from: &[f64; 8]| Lanes([from[first], from[first + 1], from[first + 2], from[first + 3]]);
        let legs = &self.legs;
        let (mut c, mut s, start) = (take(roots.cosines()), take(roots.sines()), take(roots.angles()));
        let mut u = above(legs, c, s);
        let mut turned = L::all(0.0);
        let used = (roots.count() - first).min(WIDTH);
        let mut settled = false;
        let mut largest_turn = L::all(0.0);
        for _ in 0..STEPS {
            let (du, dphi) = newton_step(&closure_rows(legs, u, c, s));
            u = u + du;
            turned = turned + dphi;
            let half = dphi * dphi * L::all(0.5);
            // Of modulus 1 to the fourth power of the step.
            let (dc, ds) = (L::all(1.0) - half, dphi);
            (c, s) = (c * dc - s * ds, s * dc + c * ds);
            largest_turn = dphi.zip(largest_turn, |x, y| if x.abs() > y { x.abs() } else { y });
            let step = dphi.zip(du.re, |x, y| x.abs().max(y.abs())).zip(du.im, |x, y| x.max(y.abs()));
            settled = step.0[..used].iter().all(|&x| x <= LAST_STEP);
            if settled {
                break;
            }
        }
        if !settled {
            return None;
        }
        let norm = (c * c + s * s).map(|x| 1.5 - 0.5 * x);
        (c, s) = (c * norm, s * norm);
        let (residual, det, regular) = measure(&self.unit_normals, u, c, s);
        let size = L::all(1.0 / self.size);
        let (residual, det) = (residual * size, det * size);
        for i in 0..used {
            let [below, above] = roots.room().map(|room| room[first + i]);
            let sound = (residual.0[i] <= CLOSURE)
                & (largest_turn.0[i] <= LARGEST_TURN)
                & (regular.0[i].abs() >= REGULAR)
                & (turned.0[i] >= -below - ROOM_SLACK)
                & (turned.0[i] <= above + ROOM_SLACK);
            if !sound {
                return None;
            }
            let phi = start.0[i] + turned.0[i];
            let phi = if phi > std::f64::consts::PI {
                phi - std::f64::consts::TAU
            } else if phi <= -std::f64::consts::PI {
                phi + std::f64::consts::TAU
            } else {
                phi
            };
            let [c, s] = [c.0[i], s.0[i]];
            let x = self.a0[0] + u.re.0[i] * self.unit - (c * self.b0[0] - s * self.b0[1]);
            let y = self.a0[1] + u.im.0[i] * self.unit - (s * self.b0[0] + c * self.b0[1]);
            out.modes[first + i] = RealMode {
                pose: Pose { x, y, phi },
                multiplicity: 1,
                residual: residual.0[i],
                det_a: self.parity * det.0[i],
            };
        }
        if let Some(boxes) = boxes {
            let radii = proved_radii(legs, self.roundings, u, c, s, used);
            for i in 0..used {
                let [ux, uy, turn] = radii.map(|r| r.0[i]);
                // NaN where nothing was proved.
                if !(ux + uy + turn).is_finite() {
                    return None;
                }
                let Pose { x, y, phi } = out.modes[first + i].pose;
                let b0 = self.b0[0].abs() + self.b0[1].abs();
                let u = [u.re.0[i], u.im.0[i]].map(|u| u.abs() * self.unit);
                // Six roundings in x and y, and the direction's own.
                let shift = |radius: f64, a0: f64, u: f64| {
                    (radius * self.unit + b0 * (turn + 4.0 * UNIT) + 6.0 * UNIT * (a0.abs() + u + b0)) * MARGIN
                };
                let radii = [shift(ux, self.a0[0], u[0]), shift(uy, self.a0[1], u[1]), turn + ANGLE_ERROR];
                let around = |k: usize, x: f64| Interval::around(x, radii[k]);
                boxes[first + i] = [around(0, x), around(1, y), around(2, phi)];
            }
        }
        Some(())
    }
}

/// Unit roundoff of `f64`.
const UNIT: f64 = f64::EPSILON / 2.0;

/// A bound on the difference between the angle and the direction that were computed side by side: step 7 of the derivation.
const ANGLE_ERROR: f64 = 64.0 * UNIT;

/// `f` of each of three; unlike `array::map`, always inlined.
#[inline(always)]
fn three<A, B>(of: &[A; 3], f: impl Fn(&A) -> B) -> [B; 3] {
    [f(&of[0]), f(&of[1]), f(&of[2])]
}

/// The rows of a triad over another ring. Each kind of leg is told apart before its numbers are spread, which the compiler does not do by itself.
#[inline(always)]
fn rows<R: Ring + Copy>(legs: &[LegNumbers<f64>; 3], number: impl Fn(f64) -> R + Copy, c: R, s: R) -> Rows<R> {
    match legs[0] {
        LegNumbers::Circle { length, .. } => {
            let radius = number(length);
            Rows::Circle { radius, rows: [row(&legs[1], radius, number, c, s), row(&legs[2], radius, number, c, s)] }
        }
        _ => {
            let none = R::zero();
            Rows::Lines([
                row(&legs[0], none, number, c, s),
                row(&legs[1], none, number, c, s),
                row(&legs[2], none, number, c, s),
            ])
        }
    }
}

#[inline(always)]
fn row<R: Ring + Copy>(leg: &LegNumbers<f64>, radius: R, number: impl Fn(f64) -> R + Copy, c: R, s: R) -> Row<R> {
    let point = |p: Gaussian<f64>| Gaussian::new(number(p.re), number(p.im));
    match *leg {
        LegNumbers::Circle { alpha, beta, length } => {
            let leg = LegNumbers::Circle { alpha: point(alpha), beta: point(beta), length: number(length) };
            leg_row(&leg, &radius, &c, &s)
        }
        LegNumbers::Line { alpha, beta, normal } => {
            let leg = LegNumbers::Line { alpha: point(alpha), beta: point(beta), normal: point(normal) };
            leg_row(&leg, &radius, &c, &s)
        }
        LegNumbers::PlatformLine { alpha, beta, normal, delta } => {
            let (alpha, beta, normal) = (point(alpha), point(beta), point(normal));
            leg_row(&LegNumbers::PlatformLine { alpha, beta, normal, delta: number(delta) }, &radius, &c, &s)
        }
    }
}

/// The same point in every lane.
#[inline(always)]
fn all(p: Gaussian<f64>) -> Gaussian<L> {
    Gaussian { re: L::all(p.re), im: L::all(p.im) }
}

const ORIGIN: Gaussian<f64> = Gaussian { re: 0.0, im: 0.0 };

/// The power of two at or below `x`; `None` for zero and far out of the usual range.
#[inline(always)]
fn power_of_two(x: f64) -> Option<f64> {
    let exponent = ((x.to_bits() >> 52) & 0x7ff) as i32 - 1023;
    EXPONENTS.contains(&exponent).then(|| f64::from_bits(((exponent + 1023) as u64) << 52))
}

/// Base and platform point of a leg.
#[inline(always)]
fn points(leg: &Dyad) -> Option<([f64; 2], [f64; 2])> {
    match leg {
        Dyad::RR { a, b, .. } | Dyad::PR { a, b, .. } | Dyad::RP { a, b, .. } => Some(([a.x, a.y], [b.x, b.y])),
        Dyad::PP { .. } => None,
    }
}

#[inline(always)]
fn local_leg(leg: &Dyad, a0: [f64; 2], b0: [f64; 2], inverse: f64) -> Option<LegNumbers<f64>> {
    let (a, b) = points(leg)?;
    let less = |p: [f64; 2], q: [f64; 2]| Gaussian::new((p[0] - q[0]) * inverse, (p[1] - q[1]) * inverse);
    let (alpha, beta) = (less(a, a0), less(b, b0));
    Some(match *leg {
        Dyad::RR { length, .. } => LegNumbers::Circle { alpha, beta, length: length * inverse },
        Dyad::PR { u, .. } => {
            let own = 1.0 / power_of_two(u.x.abs().max(u.y.abs()))?;
            LegNumbers::Line { alpha, beta, normal: Gaussian::new(-u.y * own, u.x * own) }
        }
        Dyad::RP { v, offset, .. } => {
            let own = 1.0 / power_of_two(v.x.abs().max(v.y.abs()))?;
            let delta = match offset {
                Offset::TimesDirection(delta) => delta * inverse * own,
                // With the direction scaled first, nothing leaves the range on the way.
                Offset::Distance(d) => d * inverse * (v.x * own).hypot(v.y * own),
            };
            LegNumbers::PlatformLine { alpha, beta, normal: Gaussian::new(-v.y * own, v.x * own), delta }
        }
        Dyad::PP { .. } => return None,
    })
}

/// The same leg with a normal of length 1.
#[inline(always)]
fn with_unit_normal(leg: &LegNumbers<f64>) -> LegNumbers<f64> {
    let inverse = |normal: &Gaussian<f64>| 1.0 / normal.norm_sqr().sqrt();
    match *leg {
        LegNumbers::Circle { .. } => *leg,
        LegNumbers::Line { alpha, beta, normal } => {
            LegNumbers::Line { alpha, beta, normal: normal.scaled(&inverse(&normal)) }
        }
        LegNumbers::PlatformLine { alpha, beta, normal, delta } => {
            let inverse = inverse(&normal);
            LegNumbers::PlatformLine { alpha, beta, normal: normal.scaled(&inverse), delta: delta * inverse }
        }
    }
}

type L = Lanes<WIDTH>;

/// Where two rows of a triad cross: the two that do so best.
#[inline(always)]
fn above(legs: &[LegNumbers<f64>; 3], c: L, s: L) -> Gaussian<L> {
    let crossing = |p: &Row<L>, q: &Row<L>| {
        let cross = p.cross(q);
        // g·u = -e for both: Cramer's rule.
        let x = (q.e * p.g.im - p.e * q.g.im) / cross;
        let y = (p.e * q.g.re - q.e * p.g.re) / cross;
        (cross, Gaussian::new(x, y))
    };
    match &rows(legs, L::all, c, s) {
        Rows::Circle { rows: [p, q], .. } => crossing(p, q).1,
        Rows::Lines([p, q, r]) => {
            let pairs = [crossing(p, q), crossing(p, r), crossing(q, r)];
            let mut best = pairs[0];
            for pair in &pairs[1..] {
                for i in 0..WIDTH {
                    if pair.0.0[i].abs() > best.0.0[i].abs() {
                        best.0.0[i] = pair.0.0[i];
                        best.1.re.0[i] = pair.1.re.0[i];
                        best.1.im.0[i] = pair.1.im.0[i];
                    }
                }
            }
            best.1
        }
    }
}

/// Closure error over the group's size, det A, and the determinant of the rows scaled to norm 1.
#[inline(always)]
fn measure(legs: &[LegNumbers<f64>; 3], u: Gaussian<L>, c: L, s: L) -> (L, L, L) {
    let legs = [measure_leg(&legs[0], u, c, s), measure_leg(&legs[1], u, c, s), measure_leg(&legs[2], u, c, s)];
    let larger = |x: L, y: L| x.zip(y, |x, y| if x > y { x } else { y });
    let residual = larger(larger(legs[0].0, legs[1].0), legs[2].0);
    let [(_, p, pm), (_, q, qm), (_, r, rm)] = legs;
    let det = pm * q.cross(&r) + qm * r.cross(&p) + rm * p.cross(&q);
    let norms = (p.norm_sqr() + pm * pm) * (q.norm_sqr() + qm * qm) * (r.norm_sqr() + rm * rm);
    (residual, det, det * norms.map(|x| 1.0 / x.sqrt()))
}

/// Closure error of a leg with a normal of length 1, its unit force, and the moment of that about the reference leg's base point.
#[inline(always)]
fn measure_leg(leg: &LegNumbers<f64>, u: Gaussian<L>, c: L, s: L) -> (L, Gaussian<L>, L) {
    let rotation = Gaussian::new(c, s);
    let (miss, force, moment) = match *leg {
        LegNumbers::Circle { alpha, beta, length } => {
            let joint = u + rotation * all(beta);
            let along = joint - all(alpha);
            let distance = along.norm_sqr().map(f64::sqrt);
            let force = along.scaled(&(L::all(1.0) / distance));
            (distance - L::all(length), force, joint.cross(&force))
        }
        LegNumbers::Line { alpha, beta, normal } => {
            let (joint, normal) = (u + rotation * all(beta), all(normal));
            (normal.dot(&(joint - all(alpha))), normal, joint.cross(&normal))
        }
        LegNumbers::PlatformLine { alpha, beta, normal, delta } => {
            let (turned, alpha) = (rotation * all(normal), all(alpha));
            let on_line = u + rotation * all(beta);
            (turned.dot(&(alpha - on_line)) - L::all(delta), turned, alpha.cross(&turned))
        }
    };
    (miss.map(f64::abs), force, moment)
}

impl RealModes {
    #[inline(always)]
    fn sort(&mut self) {
        for i in 1..self.count {
            let mode = self.modes[i];
            let mut at = i;
            while at > 0 && self.modes[at - 1].pose.phi > mode.pose.phi {
                self.modes[at] = self.modes[at - 1];
                at -= 1;
            }
            self.modes[at] = mode;
        }
    }
}
