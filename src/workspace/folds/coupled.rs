//! Two limits of different legs held at once: the reference point on a coupler curve, by the orientation in closed form.
//!
//! At one orientation each limit leaves a circle or a line of `C`; where both meet is `C`. With `psi = phi - axis` the two are as far apart at
//! `-psi` as at `psi`:
//!
//! | carriers | distance | by `psi` | they meet where |
//! |---|---|---|---|
//! | circle, circle | of the centres, `D` | `D² = (p - q)² + 4 p q sin²(psi/2)` | `\|r - s\| <= D <= r + s` |
//! | circle, line | of the centre from the line, `h` | `h = e - f cos psi` | `\|h\| <= r` |
//! | line, line | | | everywhere, or where not parallel |
//!
//! with `p`, `q` the distances of the two base and of the two platform points. So `|psi|` runs over one interval `[low, high]`, and the curve is made of branches: `psi` positive or
//! negative, and the first or the second meeting point (`sigma`). A branch ends where carriers touch (a *turn*: the two `sigma` join), or at `psi` 0 or
//! pi, where it goes *through* to its mirror image; where the centres coincide there, as those of a parallelogram do, `sigma` changes with it. The parameter `t` of a branch in `[0, 1]` is analytic up to a turn.
//! Differences that vanish at a turn are products of sines, so a point keeps its digits there.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector2;

use super::surface::{Form, Place, quarter};
use crate::plane::{direction, principal, product};

type Point = Vector2<f64>;

/// What happens at an end of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// The carriers touch: the two meeting points merge.
    Turn,
    /// `psi` is 0 or pi: the branch goes on with `psi` of the other sign.
    Through,
    /// The same where the centres coincide: they pass each other, so that the first meeting point goes on as the second.
    Swap,
    /// Both at once: four branches meet.
    Crossing,
    /// The curve runs off to infinity, or into an orientation at which the carriers are one line.
    Off,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Law {
    /// `D = base·((p - q) + q (1 - e^{i psi}))`; radii of both circles; `first = [a, b]` of the first.
    Circles { base: Point, p: f64, q: f64, r: f64, s: f64, first: [Point; 2] },
    /// The first is a circle; `e`, `f` as above; the line's normal turns with the platform or not.
    CircleLine { e: f64, f: f64, r: f64, first: [Point; 2], normal: Point, turning: bool },
    /// Two lines.
    Lines { forms: [Form; 2] },
}

/// A branch of a coupled curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Branch {
    /// Whether `psi` is positive.
    pub(crate) half: bool,
    /// Which meeting point: left of the way from the first centre to the second, or along the line's direction.
    pub(crate) sigma: bool,
}

/// A point of a curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    pub(crate) place: Place,
    pub(crate) phi: f64,
    /// Derivative of `C` by the parameter.
    pub(crate) velocity: Point,
}

/// The curve of two limits, one of each of two legs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupled {
    forms: [Form; 2],
    law: Law,
    axis: f64,
    low: f64,
    high: f64,
    pub(crate) ends: [End; 2],
    pub(crate) sigmas: usize,
}

/// Lengths whose relative difference is below this are taken to be equal, so that kites, parallelograms and parallel lines are what they were meant to
/// be (heuristic: some hundred roundings).
const SAME: f64 = 1e-13;

/// How near to the direction in which two lines are parallel a curve is followed, radians: from there `C` is further off than any mechanism reaches, or
/// nearer to the common line than the tolerance of vertices.
const NEARLY_PARALLEL: f64 = 1e-5;

/// Two limits hold, besides or instead of a curve, all along a carrier at one orientation.
pub(crate) type Frozen = Vec<f64>;

impl Coupled {
    /// The curve of two limits, and the orientations at which the two are one carrier. The curve is `None` where the limits never hold together or always.
    pub(crate) fn new(first: Form, second: Form) -> (Option<Self>, Frozen) {
        let mut frozen = Vec::new();
        let order = |form: &Form| u8::from(!matches!(form, Form::Circle { .. }));
        let forms = if order(&first) <= order(&second) { [first, second] } else { [second, first] };
        let curve = match forms {
            [Form::Circle { a, b, r }, Form::Circle { a: a2, b: b2, r: s }] => {
                circles([a, b], r, [a2, b2], s, &mut frozen)
            }
            [Form::Circle { a, b, r }, Form::Line { n, h, b: b2 }] => {
                let along = b2 - b;
                let f = along.norm();
                let axis = if f > 0.0 { angle(n) - angle(along) } else { 0.0 };
                let law = Law::CircleLine { e: h - n.dot(&a), f, r, first: [a, b], normal: n, turning: false };
                circle_line(law, h - n.dot(&a), f, r, axis)
            }
            [Form::Circle { a, b, r }, Form::PlatformLine { a: a2, m, k }] => {
                let along = a2 - a;
                let f = along.norm();
                let axis = if f > 0.0 { angle(along) - angle(m) + PI } else { 0.0 };
                let e = m.dot(&b) - k;
                let law = Law::CircleLine { e, f, r, first: [a, b], normal: m, turning: true };
                circle_line(law, e, f, r, axis)
            }
            _ => lines(forms, &mut frozen),
        };
        let curve = curve.map(|(law, axis, [low, high], ends, sigmas)| Self {
            forms,
            law,
            axis: principal(axis),
            low,
            high,
            ends,
            sigmas,
        });
        (curve, frozen)
    }

    /// The curve carried along with the base frame; branches and parameters stay.
    pub(crate) fn moved(&self, by: Point) -> Self {
        let mut out = *self;
        out.forms = self.forms.map(|form| form.moved(by));
        match &mut out.law {
            Law::Circles { first: [a, _], .. } | Law::CircleLine { first: [a, _], .. } => *a += by,
            Law::Lines { forms } => *forms = forms.map(|form| form.moved(by)),
        }
        out
    }

    /// The branches.
    pub(crate) fn branches(&self) -> impl Iterator<Item = Branch> + use<> {
        let sigmas = self.sigmas;
        [true, false]
            .into_iter()
            .flat_map(move |half| [true, false].into_iter().take(sigmas).map(move |sigma| Branch { half, sigma }))
    }

    /// The fraction of `[low, high]` at a parameter, its complement, and the derivative.
    fn fraction(&self, t: f64) -> [f64; 3] {
        let smooth = |end| end == End::Turn;
        match self.ends.map(smooth) {
            [true, true] => {
                let (sin, cos) = (FRAC_PI_2 * t).sin_cos();
                // From the other end, t near 1 would lose digits in the cosine.
                let cos = if t > 0.5 { (FRAC_PI_2 * (1.0 - t)).sin() } else { cos };
                [sin * sin, cos * cos, PI * sin * cos]
            }
            [true, false] => [t * t, (1.0 - t) * (1.0 + t), 2.0 * t],
            [false, true] => [t * (2.0 - t), (1.0 - t) * (1.0 - t), 2.0 * (1.0 - t)],
            [false, false] => [t, 1.0 - t, 1.0],
        }
    }

    /// The orientation at a parameter, radians, not reduced.
    pub(crate) fn phi(&self, branch: Branch, t: f64) -> f64 {
        let psi = self.low + (self.high - self.low) * self.fraction(t)[0];
        self.axis + if branch.half { psi } else { -psi }
    }

    /// The point at a parameter in `[0, 1]`.
    pub(crate) fn at(&self, branch: Branch, t: f64) -> Spot {
        let [f, rest, df] = self.fraction(t);
        let width = self.high - self.low;
        let (up, down) = (width * f, width * rest);
        // Nearest end first, so that the distance from it is exact.
        let psi = if f <= 0.5 { self.low + up } else { self.high - down };
        let side = if branch.half { 1.0 } else { -1.0 };
        let phi = self.axis + side * psi;
        let turn = direction(phi);
        let sigma = if branch.sigma { 1.0 } else { -1.0 };
        // 4 sin((psi + low)/2) sin((psi - low)/2) = 2 (cos low - cos psi), and likewise for high.
        let over_low = || 4.0 * (self.low + 0.5 * up).sin() * (0.5 * up).sin();
        let under_high = || 4.0 * (self.high - 0.5 * down).sin() * (0.5 * down).sin();
        let is_turn = |k: usize| matches!(self.ends[k], End::Turn | End::Crossing);
        // C, and the cross product of the carriers' normals.
        let (c, cross) = match self.law {
            Law::Circles { base, p, q, r, s, first: [a, b] } => {
                let half = (0.5 * psi).sin();
                let gap = Point::new((p - q) + 2.0 * q * half * half, -side * q * psi.sin());
                let d = product(base, gap);
                let d2 = (p - q) * (p - q) + 4.0 * p * q * half * half;
                let within = if is_turn(1) { p * q * under_high() } else { (r + s) * (r + s) - d2 };
                let beyond = if is_turn(0) { p * q * over_low() } else { d2 - (r - s) * (r - s) };
                let root = (within.max(0.0) * beyond.max(0.0)).sqrt();
                let c = if p == q && r == s {
                    // A parallelogram's centres meet at psi = 0, but the way between them keeps a direction.
                    let way = product(base, Point::new(half, -side * (0.5 * psi).cos()));
                    a - product(turn, b) + way * (q * half) + quarter(way) * (sigma * 0.5 * within.max(0.0).sqrt())
                } else {
                    let along = 0.5 * ((r - s) * (r + s) / d2 + 1.0);
                    a - product(turn, b) + d * along + quarter(d) * (sigma * 0.5 * root / d2)
                };
                // Both normals point away from their centres.
                (c, sigma * 0.5 * root / (r * s))
            }
            Law::CircleLine { e, f, r, first: [a, b], normal, turning } => {
                let half = (0.5 * psi).sin();
                let h = (e - f) + 2.0 * f * half * half;
                let within = if is_turn(1) { 0.5 * f * under_high() } else { r - h };
                let beyond = if is_turn(0) { 0.5 * f * over_low() } else { r + h };
                let root = (within.max(0.0) * beyond.max(0.0)).sqrt();
                let n = if turning { product(turn, normal) } else { normal };
                let c = a - product(turn, b) + n * h + quarter(n) * (sigma * root);
                (c, -sigma * root / r * if turning { -1.0 } else { 1.0 })
            }
            Law::Lines { forms } => {
                let level = |form: &Form| match *form {
                    Form::Line { n, h, b } => (n, h - n.dot(&product(turn, b))),
                    Form::PlatformLine { a, m, k } => {
                        let rm = product(turn, m);
                        (rm, rm.dot(&a) - k)
                    }
                    Form::Circle { .. } => unreachable!("no circle among two lines"),
                };
                let [(n1, p1), (n2, p2)] = forms.each_ref().map(level);
                let cross = n1.perp(&n2);
                let sign = |form: &Form| if matches!(form, Form::PlatformLine { .. }) { -1.0 } else { 1.0 };
                ((quarter(n1) * p2 - quarter(n2) * p1) / cross, cross * sign(&forms[0]) * sign(&forms[1]))
            }
        };
        let place = Place { c, turn };
        // grad1·dC = -dg1/dphi, grad2·dC = -dg2/dphi.
        let [g1, g2] = self.forms.each_ref().map(|form| form.slope(&place));
        let rate = side * width * df / cross;
        let velocity = (quarter(g2.gradient) * g1.by_phi - quarter(g1.gradient) * g2.by_phi) * rate;
        Spot { place, phi, velocity }
    }

    /// The branch and parameter of a pose on the curve, and how far the place there is from the pose's: poses with both carriers one are on neither branch.
    pub(crate) fn locate(&self, place: &Place, phi: f64) -> (Branch, f64, f64) {
        let psi = principal(phi - self.axis);
        let half = psi >= 0.0;
        let side = match self.law {
            Law::Circles { base, p, q, first: [a, b], .. } => {
                let (sin, half) = (psi.sin(), (0.5 * psi).sin());
                let d = product(base, Point::new((p - q) + 2.0 * q * half * half, -q * sin));
                d.perp(&(place.c - a + product(place.turn, b)))
            }
            Law::CircleLine { first: [a, b], normal, turning, .. } => {
                let n = if turning { product(place.turn, normal) } else { normal };
                quarter(n).dot(&(place.c - a + product(place.turn, b)))
            }
            Law::Lines { .. } => 1.0,
        };
        let branch = Branch { half, sigma: side >= 0.0 || self.sigmas == 1 };
        let fraction = ((psi.abs() - self.low) / (self.high - self.low)).clamp(0.0, 1.0);
        let smooth = |end| end == End::Turn;
        let mut t = match self.ends.map(smooth) {
            [true, true] => fraction.sqrt().atan2((1.0 - fraction).sqrt()) / FRAC_PI_2,
            [true, false] => fraction.sqrt(),
            [false, true] => fraction / (1.0 + (1.0 - fraction).sqrt()),
            [false, false] => fraction,
        };
        // The orientation says little of the place near a turn; the place itself does. At a cusp it is the other way round.
        let miss = |t: f64| {
            let spot = self.at(branch, t.clamp(EDGE, 1.0 - EDGE));
            (place.c - spot.place.c, spot.velocity)
        };
        let (mut off, mut velocity) = miss(t);
        for _ in 0..LOCATING {
            let next = (t.clamp(EDGE, 1.0 - EDGE) + off.dot(&velocity) / velocity.norm_squared()).clamp(0.0, 1.0);
            if !next.is_finite() {
                break;
            }
            let nearer = miss(next);
            if nearer.0.norm() < off.norm() {
                t = next;
                (off, velocity) = nearer;
            } else {
                break;
            }
        }
        (branch, t, off.norm())
    }
}

/// Newton steps that place a pose on the curve: quadratic convergence from half the digits.
const LOCATING: usize = 2;

/// How near to its ends a branch's velocity is asked for, as a parameter: at a turn itself it is 0/0.
pub(crate) const EDGE: f64 = 1e-10;

fn angle(v: Point) -> f64 {
    v.y.atan2(v.x)
}

type Parts = (Law, f64, [f64; 2], [End; 2], usize);

fn same(x: f64, y: f64, scale: f64) -> bool {
    (x - y).abs() <= SAME * scale
}

fn circles(first: [Point; 2], r: f64, second: [Point; 2], s: f64, frozen: &mut Frozen) -> Option<Parts> {
    let (base, tip) = (second[0] - first[0], second[1] - first[1]);
    let (p, q) = (base.norm(), tip.norm());
    let scale = r + s + p + q;
    if r == 0.0 || s == 0.0 {
        return None;
    }
    let (p, q) = (if p <= SAME * scale { 0.0 } else { p }, if q <= SAME * scale { 0.0 } else { q });
    let axis = if q == 0.0 {
        0.0
    } else if p == 0.0 {
        -angle(tip)
    } else {
        angle(base) - angle(tip)
    };
    let unit = if p > 0.0 { base / p } else { Point::x() };
    let (p, q) = if same(p, q, scale) { (p, p) } else { (p, q) };
    let (r, s) = if same(r, s, scale) { (r, r) } else { (r, s) };
    let law = Law::Circles { base: unit, p, q, r, s, first };
    let (near, far) = ((p - q).abs(), p + q);
    let (least, most) = ((r - s).abs(), r + s);
    if far == 0.0 {
        return None;
    }
    if p == 0.0 || q == 0.0 {
        let meets = near >= least && near <= most;
        return meets.then_some((law, axis, [0.0, PI], [End::Through; 2], 2));
    }
    if near == 0.0 && least == 0.0 {
        frozen.push(axis);
    }
    // |psi| at which D has a value between its extremes.
    let reach = |d: f64| 2.0 * ((d - near) * (d + near)).sqrt().atan2(((far - d) * (far + d)).sqrt());
    let (low, low_end) = if same(least, near, scale) {
        // A parallelogram's centres part at once: nothing crosses there.
        (0.0, if near == 0.0 { End::Swap } else { End::Crossing })
    } else if least < near {
        (0.0, End::Through)
    } else if least < far {
        (reach(least), End::Turn)
    } else {
        return None;
    };
    let (high, high_end) = if same(most, far, scale) {
        (PI, End::Crossing)
    } else if most > far {
        (PI, End::Through)
    } else if most > near {
        (reach(most), End::Turn)
    } else {
        return None;
    };
    (high > low).then_some((law, axis, [low, high], [low_end, high_end], 2))
}

fn circle_line(law: Law, e: f64, f: f64, r: f64, axis: f64) -> Option<Parts> {
    let scale = e.abs() + f + r;
    if r == 0.0 {
        return None;
    }
    if f <= SAME * scale {
        return (e.abs() <= r).then_some((law, axis, [0.0, PI], [End::Through; 2], 2));
    }
    // |psi| at which h = e - f cos psi has a value.
    let reach = |h: f64| 2.0 * (f - (e - h)).sqrt().atan2((f + (e - h)).sqrt());
    let (low, low_end) = if same(e - f, -r, scale) {
        (0.0, End::Crossing)
    } else if e - f > -r {
        (0.0, End::Through)
    } else if e + f > -r {
        (reach(-r), End::Turn)
    } else {
        return None;
    };
    let (high, high_end) = if same(e + f, r, scale) {
        (PI, End::Crossing)
    } else if e + f < r {
        (PI, End::Through)
    } else if e - f < r {
        (reach(r), End::Turn)
    } else {
        return None;
    };
    (high > low).then_some((law, axis, [low, high], [low_end, high_end], 2))
}

fn lines(forms: [Form; 2], frozen: &mut Frozen) -> Option<Parts> {
    let law = Law::Lines { forms };
    let always = Some((law, 0.0, [0.0, PI], [End::Through; 2], 1));
    // Orientations at which `constant + amplitude·cos(phi - shift)` vanishes.
    let mut zeros = |constant: f64, amplitude: f64, shift: f64| {
        if amplitude > 0.0 && constant.abs() <= amplitude {
            let half = (-constant / amplitude).acos();
            frozen.extend([shift + half, shift - half]);
        }
    };
    match forms {
        [Form::Line { n, h, b }, Form::Line { n: n2, h: h2, b: b2 }] => {
            if n.perp(&n2).abs() > SAME {
                return always;
            }
            let sign = n.dot(&n2).signum();
            let tip = b * 1.0 - b2;
            // n·R b - h = sign (n2·R b2 - h2)
            zeros(sign * h2 - h, tip.norm(), angle(n) - angle(tip));
            None
        }
        [Form::PlatformLine { a, m, k }, Form::PlatformLine { a: a2, m: m2, k: k2 }] => {
            if m.perp(&m2).abs() > SAME {
                return always;
            }
            let sign = m.dot(&m2).signum();
            let base = a - a2;
            zeros(sign * k2 - k, base.norm(), angle(base) - angle(m));
            None
        }
        [Form::Line { n, h, b }, Form::PlatformLine { a, m, k }]
        | [Form::PlatformLine { a, m, k }, Form::Line { n, h, b }] => {
            let axis = angle(n) - angle(m);
            // At psi = 0 the line of the platform is n·C = n·a - k, at psi = pi n·C = n·a + k.
            for (psi, sign) in [(0.0, 1.0), (PI, -1.0)] {
                let level = h - n.dot(&product(direction(axis + psi), b));
                let other = n.dot(&a) - sign * k;
                if same(level, other, h.abs() + b.norm() + a.norm() + k.abs()) {
                    frozen.push(axis + psi);
                }
            }
            Some((law, axis, [NEARLY_PARALLEL, PI - NEARLY_PARALLEL], [End::Off; 2], 1))
        }
        _ => unreachable!("no circle among two lines"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn form() -> impl Strategy<Value = Form> {
        let point = || (-3.0..3.0f64, -3.0..3.0f64).prop_map(|(x, y)| Point::new(x, y));
        let unit = || (-3.2..3.2f64).prop_map(direction);
        prop_oneof![
            3 => (point(), point(), 0.1..4.0f64).prop_map(|(a, b, r)| Form::Circle { a, b, r }),
            1 => (point(), unit(), -2.0..2.0f64).prop_map(|(b, n, h)| Form::Line { n, h, b }),
            1 => (point(), unit(), -2.0..2.0f64).prop_map(|(a, m, k)| Form::PlatformLine { a, m, k }),
        ]
    }

    proptest! {
        /// Every point lies on both surfaces, the velocity is the difference of points, and a pose is found again.
        #[test]
        fn points_hold_both_limits(first in form(), second in form(), t in 0.01..0.99f64) {
            let (Some(curve), _) = Coupled::new(first, second) else { return Ok(()) };
            for branch in curve.branches() {
                let spot = curve.at(branch, t);
                if curve.ends[0] == End::Off && spot.place.c.norm() > 1e3 { continue }
                for form in &curve.forms {
                    prop_assert!(form.value(&spot.place).abs() < 1e-11, "{:?}", form.value(&spot.place));
                }
                let step = 1e-6;
                let difference = (curve.at(branch, t + step).place.c - curve.at(branch, t - step).place.c) / (2.0 * step);
                let miss = (difference - spot.velocity).norm();
                prop_assert!(miss < 1e-4 * (1.0 + spot.velocity.norm()), "{difference:?} {:?}", spot.velocity);
                let (found, at, _) = curve.locate(&spot.place, spot.phi);
                prop_assert_eq!(found, branch);
                prop_assert!((at - t).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn the_kite_and_the_parallelogram() {
        let circle = |ax: f64, bx: f64, r| Form::Circle { a: Point::new(ax, 0.0), b: Point::new(bx, 0.0), r };
        // r = p, s = q: a kite; its branches meet where the two pivots coincide.
        let (kite, frozen) = Coupled::new(circle(0.0, 0.0, 2.0), circle(2.0, 1.0, 1.0));
        let kite = kite.expect("a curve");
        assert_eq!(kite.ends, [End::Crossing, End::Crossing]);
        assert!(frozen.is_empty());
        // p = q, r = s: at psi = 0 both circles are one.
        let (parallelogram, frozen) = Coupled::new(circle(0.0, 0.0, 2.0), circle(1.5, 1.5, 2.0));
        assert_eq!(frozen, [0.0]);
        assert_eq!(parallelogram.map(|curve| curve.ends), Some([End::Swap, End::Through]));
        let spot = parallelogram.expect("a curve").at(Branch { half: true, sigma: true }, 1e-7);
        assert!(spot.place.c.x.abs() < 2.0 && spot.place.c.iter().all(|x| x.is_finite()));
    }
}
