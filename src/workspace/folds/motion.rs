//! One-parameter motions of the platform along which a limit can bound besides coupler motions: turning about a pin, and translating.
//!
//! | where it comes from | motion |
//! |---|---|
//! | RR limit stationary in phi | pinned: `C`, `B`, `a` in line, the platform turns about `a` as one with the leg |
//! | RP limit stationary in phi | pinned: the foot of `C` on the platform line lies on `a` |
//! | PR limit stationary in phi | sliding: the platform arm stands across the line |
//! | two limits of one leg | pinned at the joint that is left, or sliding along it |
//! | an RR limit at the end of the range of phi | sliding: `C` on a circle, phi held |
//! | two RR limits of equal radius over a parallelogram | sliding on their common circle |
//!
//! On each of them another limit is met at orientations (or places) in closed form, in the forms that keep their digits at a touch.

use std::f64::consts::PI;

use arrayvec::ArrayVec;
use nalgebra::Vector2;

use super::surface::{Form, Place, quarter};
use crate::plane::{Carrier, Meeting, conjugate, direction, principal, product};

type Point = Vector2<f64>;

/// A motion of the platform with one parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Motion {
    /// The platform's point `p` stays at `q`; the parameter is the direction of `C` from `q`, radians.
    Pinned { q: Point, p: Point },
    /// The orientation `phi` is held and `C` moves on a carrier; the parameter is the carrier's.
    Sliding { phi: f64, turn: Point, on: Carrier },
}

impl Motion {
    /// The platform held at `phi`, radians.
    pub(crate) fn sliding(phi: f64, on: Carrier) -> Self {
        Self::Sliding { phi, turn: direction(phi), on }
    }

    /// The curve of `C`.
    pub(crate) fn carrier(&self) -> Carrier {
        match *self {
            Self::Pinned { q, p } => Carrier::Circle { center: q, radius: p.norm() },
            Self::Sliding { on, .. } => on,
        }
    }

    /// The pose at a parameter.
    pub(crate) fn place(&self, parameter: f64) -> Place {
        match *self {
            Self::Pinned { q, p } => {
                // C - q = -R p.
                let away = direction(parameter);
                let turn = product(away, conjugate(-p)) / p.norm();
                Place { c: q + away * p.norm(), turn }
            }
            Self::Sliding { turn, on, .. } => Place { c: on.at(parameter), turn },
        }
    }

    /// The orientation at a parameter, radians.
    pub(crate) fn phi(&self, parameter: f64) -> f64 {
        match *self {
            Self::Pinned { p, .. } => principal(parameter - angle(-p)),
            Self::Sliding { phi, .. } => principal(phi),
        }
    }

    /// The parameter at which the platform is turned by `phi`, where turning is the motion.
    pub(crate) fn at_phi(&self, phi: f64) -> Option<f64> {
        match *self {
            Self::Pinned { p, .. } => Some(principal(phi + angle(-p))),
            Self::Sliding { .. } => None,
        }
    }

    /// Parameters at which another limit is met; what comes nearer than `tol` (a length) to a touch is a touch. None also where it is met all along.
    pub(crate) fn meets(&self, form: &Form, tol: f64) -> ArrayVec<f64, 2> {
        match *self {
            Self::Pinned { q, p } => {
                let zero = angle(-p);
                orientations_about(q, p, form, tol).into_iter().map(|phi| principal(phi + zero)).collect()
            }
            Self::Sliding { turn, on, .. } => match on.meet(&form.carrier(turn), tol) {
                Meeting::Same => ArrayVec::new(),
                Meeting::Points(points) => points.into_iter().map(|point| on.parameter(point)).collect(),
            },
        }
    }

    /// Parameters at which a limit that holds all along is stationary in the orientation, where turning about the pin is the motion.
    pub(crate) fn alignments(&self, form: &Form) -> ArrayVec<f64, 2> {
        let Self::Pinned { q, p } = *self else { return ArrayVec::new() };
        let zero = angle(-p);
        let turned = |base: Point, arm: Point| {
            // R arm along base, or against it.
            let phi = angle(base) - angle(arm);
            [phi, phi + PI].into_iter().map(|phi| principal(phi + zero)).collect()
        };
        match *form {
            // The platform arm b along B - a, and B - a = q + R (b - p) - a.
            Form::Circle { a, b, .. } => {
                // cross(R b, q - a) + cross(b, -p) = 0.
                let (base, constant) = (q - a, b.perp(&-p));
                let amplitude = base.norm() * b.norm();
                if amplitude == 0.0 {
                    return ArrayVec::new();
                }
                let sine = -constant / amplitude;
                if sine.abs() > 1.0 {
                    return ArrayVec::new();
                }
                // sin(angle(base) - angle(b) - phi) = sine.
                let (middle, delta) = (angle(base) - angle(b), sine.asin());
                [middle - delta, middle - PI + delta].into_iter().map(|phi| principal(phi + zero)).collect()
            }
            Form::Line { n, b, .. } => turned(n, b),
            // R m across a - C... stationary where a - C is along R m: a - q + R p.
            Form::PlatformLine { a, m, .. } => {
                let (base, constant) = (a - q, m.perp(&p));
                let amplitude = base.norm();
                if amplitude == 0.0 {
                    return ArrayVec::new();
                }
                let sine = -constant / amplitude;
                if sine.abs() > 1.0 {
                    return ArrayVec::new();
                }
                // cross(R m, base) + cross(m, p) = 0.
                let (middle, delta) = (angle(base) - angle(m), sine.asin());
                [middle - delta, middle - PI + delta].into_iter().map(|phi| principal(phi + zero)).collect()
            }
        }
    }

    /// The place of the reference point at which a limit is met in every orientation, if there is one: at the base pivot of a circle that the platform
    /// arm reaches just, or that a platform line through the reference point passes.
    pub(crate) fn pole(form: &Form, tol: f64) -> Option<Point> {
        match *form {
            Form::Circle { a, b, r } => ((b.norm() - r).abs() <= tol).then_some(a),
            Form::PlatformLine { a, k, .. } => (k.abs() <= tol).then_some(a),
            Form::Line { .. } => None,
        }
    }

    /// The orientations at which a limit holds with the reference point at a place; see [`Motion::meets`].
    pub(crate) fn orientations_at(at: Point, form: &Form, tol: f64) -> ArrayVec<f64, 2> {
        orientations_about(at, Point::zeros(), form, tol)
    }

    /// The motions along which a limit is stationary in the orientation: at most two.
    pub(crate) fn stationary(form: &Form) -> ArrayVec<Self, 2> {
        let mut out = ArrayVec::new();
        match *form {
            Form::Circle { a, b, r } => {
                let arm = b.norm();
                if arm == 0.0 {
                    return out;
                }
                for side in [1.0, -1.0] {
                    // The platform point at the base pivot.
                    let p = b * ((arm + side * r) / arm);
                    if p.norm() > 0.0 {
                        out.push(Self::Pinned { q: a, p });
                    }
                }
            }
            Form::Line { n, h, b } => {
                let arm = b.norm();
                if arm == 0.0 {
                    return out;
                }
                for side in [1.0, -1.0] {
                    // R b along side·n.
                    let turn = product(n * side, conjugate(b)) / arm;
                    let on = Carrier::Line { point: n * (h - side * arm), direction: -quarter(n) };
                    out.push(Self::Sliding { phi: angle(turn), turn, on });
                }
            }
            Form::PlatformLine { a, m, k } => {
                // (R m)·(a - C) = k, stationary where a - C = k R m.
                if k != 0.0 {
                    out.push(Self::Pinned { q: a, p: m * k });
                }
            }
        }
        out
    }
}

/// Orientations at which a form holds while the platform point `p` stays at `q`.
fn orientations_about(q: Point, p: Point, form: &Form, tol: f64) -> ArrayVec<f64, 2> {
    match *form {
        Form::Circle { a, b, r } => {
            // |q - a + R (b - p)| = r
            let (base, arm) = (q - a, b - p);
            let (d, l) = (base.norm(), arm.norm());
            if d == 0.0 || l == 0.0 {
                return ArrayVec::new();
            }
            let middle = angle(base) - angle(arm);
            // cos = (r² - d² - l²)/(2 d l); 1 - cos over 1 + cos, in factors.
            let (above, below) = ((d + l - r) * (d + l + r), (r - (d - l)) * (r + (d - l)));
            either(middle, above, below, tol * (d + l + r))
        }
        Form::Line { n, h, b } => {
            // n·(q + R (b - p)) = h
            let arm = b - p;
            let (l, rest) = (arm.norm(), h - n.dot(&q));
            if l == 0.0 {
                return ArrayVec::new();
            }
            either(angle(n) - angle(arm), l - rest, l + rest, tol)
        }
        Form::PlatformLine { a, m, k } => {
            // (R m)·(a - q + R p) = k
            let (base, rest) = (a - q, k - m.dot(&p));
            let d = base.norm();
            if d == 0.0 {
                return ArrayVec::new();
            }
            either(angle(base) - angle(m), d - rest, d + rest, tol)
        }
    }
}

/// The angles `middle ± psi` with `tan²(psi/2) = above/below`; none where one of the two is negative by more than `tol`.
fn either(middle: f64, above: f64, below: f64, tol: f64) -> ArrayVec<f64, 2> {
    let mut out = ArrayVec::new();
    if above < -tol || below < -tol {
        return out;
    }
    let touches = above <= tol || below <= tol;
    let psi = if touches { if above <= below { 0.0 } else { PI } } else { 2.0 * above.sqrt().atan2(below.sqrt()) };
    out.push(principal(middle + psi));
    if !touches {
        out.push(principal(middle - psi));
    }
    out
}

pub(crate) fn angle(v: Point) -> f64 {
    v.y.atan2(v.x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = Point> {
        (-3.0..3.0f64, -3.0..3.0f64).prop_map(|(x, y)| Point::new(x, y))
    }

    fn form() -> impl Strategy<Value = Form> {
        let unit = || (-3.2..3.2f64).prop_map(direction);
        prop_oneof![
            (point(), point(), 0.1..4.0f64).prop_map(|(a, b, r)| Form::Circle { a, b, r }),
            (point(), unit(), -2.0..2.0f64).prop_map(|(b, n, h)| Form::Line { n, h, b }),
            (point(), unit(), -2.0..2.0f64).prop_map(|(a, m, k)| Form::PlatformLine { a, m, k }),
        ]
    }

    proptest! {
        #[test]
        fn limits_met_are_held(q in point(), p in point(), phi in -3.0..3.0f64, form in form(), held in form()) {
            let tol = 1e-13;
            let carrier = held.carrier(direction(phi));
            for motion in [Motion::Pinned { q, p }, Motion::sliding(phi, carrier)] {
                for parameter in motion.meets(&form, tol) {
                    let place = motion.place(parameter);
                    prop_assert!(form.value(&place).abs() < 1e-9, "{}", form.value(&place));
                    prop_assert!((place.turn - direction(motion.phi(parameter))).norm() < 1e-14);
                }
            }
            for motion in Motion::stationary(&held) {
                for parameter in [0.3, 1.0, 4.0] {
                    let place = motion.place(parameter);
                    prop_assert!(held.value(&place).abs() < 1e-12 && held.slope(&place).by_phi.abs() < 1e-12);
                }
            }
            // Alignments on a pin that keeps the form held.
            let pinned = match form {
                Form::Circle { a, b, r } => Motion::Pinned { q: a + direction(phi) * r, p: b },
                Form::Line { n, h, b } => Motion::Pinned { q: n * h + quarter(n) * phi, p: b },
                Form::PlatformLine { a, m, k } => Motion::Pinned { q: a, p: m * k + quarter(m) * phi },
            };
            let aligned = pinned.alignments(&form);
            for parameter in &aligned {
                let place = pinned.place(*parameter);
                prop_assert!(form.value(&place).abs() < 1e-12 && form.slope(&place).by_phi.abs() < 1e-12, "{form:?} {:?}", form.slope(&place));
            }
        }
    }
}
