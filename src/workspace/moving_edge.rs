//! Legs with a range of joint 3: the orientations between which the distance to every piece of their edge is monotone.
//!
//! In the plane of the platform pivot B the edge of what such a leg allows is made of *standing* carriers (ends of joints 1 and 2, merging modes) and *turning* ones (ends of joint 3).
//! Seen from a frame that turns with the platform about the base pivot the turning ones stand still. So, with `C` the reference point,
//!
//! | what happens | is met |
//! |---|---|
//! | the distance from a carrier is stationary | where platform arm and leg are in line |
//! | the same from a corner of two standing carriers, or of two turning ones | in line with the corner |
//! | the nearest place of a carrier passes a corner | `B` on the normal at the corner |
//! | three carriers pass one place: two of them stand, or two turn | that corner on the third |
//! | a standing and a turning carrier touch, or two lines along a slider are one | pivots in line, or a joint's arm on the line |
//! | a corner of joints 1 and 3 in one mode | it turns about the pivot between them |
//!
//! All of these are in closed form. Only the corner of joint 1 at an end in one mode and joint 3 in the other is not: its functions of the orientation, of low degree, are
//! cut evenly for changes of sign.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector2;

use super::arrangement::SAME;
use super::gradient::aligned;
use super::leg::{Chain, LegReach};
use super::limits::{Limit, LimitCause};
use crate::linkage::{Dyad, Offset};
use crate::plane::{Carrier, Meeting, direction, principal, product};

type Point = Vector2<f64>;

/// A corner that a leg misses by less than this share of the size counts (heuristic, generous: where working modes merge a joint moves as the root of a rounding; one
/// counted in vain costs time only).
const NEAR: f64 = 1e-7;

impl LegReach {
    /// Adds these orientations for a place of the reference point, radians in [-pi, pi): more than needed, as corners count whether the leg is in them or not.
    pub(super) fn moving_edge_events(&self, at: Point, size: f64, out: &mut Vec<f64>) {
        let same = SAME * size;
        let last = |limit: &&Limit| limit.cause.joint() == Some(2);
        // Both modes have most surfaces in common.
        let mut limits: Vec<&Limit> = Vec::new();
        for limit in &self.limits {
            if !limits.iter().any(|known| known.dyad == limit.dyad) {
                limits.push(limit);
            }
        }
        let (standing, turning): (Vec<&Limit>, Vec<&Limit>) = limits.iter().copied().partition(|limit| !last(limit));
        // A corner counts if joints 1 and 2, or 2 and 3, allow the platform pivot there.
        let near = NEAR * size;
        let standing_part = Self { platform_sector: None, ring: None, ..self.clone() };
        let turning_part = Self { base_sector: None, ring: None, ..self.clone() };
        let stands = |corner: &Point| standing_part.allows(*corner, Point::x(), near);
        let turns = |corner: &Point| turning_part.allows(self.a + corner, Point::x(), near);
        for limit in limits {
            out.extend(aligned(limit, at).map(principal));
        }
        let away = at - self.a;
        let meet = |one: &Carrier, other: &Carrier| match one.meet(other, same) {
            Meeting::Points(points) => points,
            Meeting::Same => Default::default(),
        };
        // Corners of two standing carriers.
        let carriers: Vec<Carrier> = standing.iter().map(|limit| base_carrier(limit)).collect();
        for (k, one) in carriers.iter().enumerate() {
            for other in &carriers[..k] {
                for corner in meet(one, other).into_iter().filter(stands) {
                    in_line(self.b, at - corner, out);
                    for carrier in [one, other] {
                        out.extend(on_line(at, self.b, corner, normal(carrier, corner)));
                    }
                    for limit in &turning {
                        // The platform points seen from the pivot, which is in the corner.
                        let dyad = match limit.dyad {
                            Dyad::RR { a, b, length } => Dyad::RR { a, b: b - self.b, length },
                            Dyad::PR { a, u, b } => Dyad::PR { a, u, b: b - self.b },
                            Dyad::RP { a, b, v, offset } => Dyad::RP { a, b: b - self.b, v, offset },
                            other => other,
                        };
                        out.extend(Limit { dyad, ..**limit }.orientations_at(corner, same));
                    }
                }
            }
        }
        // Corners of two turning carriers, or of one and a circle about the base pivot, in the frame that turns.
        let seen: Vec<Carrier> = turning.iter().filter_map(|limit| self.turning_carrier(limit)).collect();
        let about = standing.iter().filter_map(|limit| match limit.dyad {
            Dyad::RR { a, length, .. } if a == self.a => {
                Some(Carrier::Circle { center: Point::zeros(), radius: length })
            }
            _ => None,
        });
        let all: Vec<Carrier> = seen.iter().copied().chain(about).collect();
        for (k, one) in seen.iter().enumerate() {
            for other in &all[k + 1..] {
                for corner in meet(one, other).into_iter().filter(turns) {
                    in_line(self.b - corner, away, out);
                    for carrier in [one, other] {
                        turned_back(on_line(self.b, away, corner, normal(carrier, corner)), out);
                    }
                    for limit in &standing {
                        let dyad = match limit.dyad {
                            Dyad::RR { a, length, .. } => Dyad::RR { a, b: corner, length },
                            Dyad::PR { a, u, .. } => Dyad::PR { a, u, b: corner },
                            other => other,
                        };
                        out.extend(Limit { dyad, ..**limit }.orientations_at(self.a, same));
                    }
                }
            }
        }
        // Lines along a slider, where two are one.
        for (k, one) in turning.iter().enumerate() {
            let Dyad::PR { a, u, b } = one.dyad else { continue };
            for other in turning[..k].iter().chain(&standing) {
                match other.dyad {
                    Dyad::PR { b: arm, .. } if last(other) => in_line(b - arm, u, out),
                    Dyad::PR { a: point, .. } => out.extend(on_line(a, self.b - b, point, u)),
                    _ => {}
                }
            }
        }
        // Corners of joints 1 and 3.
        for base in standing.iter().filter(|limit| limit.cause.joint() == Some(0)) {
            for platform in &turning {
                self.crossed_corner(at, base, platform, out);
            }
        }
    }

    /// Events at the corner of an end of joint 1 and one of joint 3.
    fn crossed_corner(&self, at: Point, base: &Limit, platform: &Limit, out: &mut Vec<f64>) {
        let left = |v: Point| Point::new(-v.y, v.x);
        let (pin, arm) = match (base.dyad, platform.dyad) {
            (Dyad::RR { a, .. }, Dyad::RR { b, .. } | Dyad::PR { b, .. }) => (a, b),
            (Dyad::PR { u, .. }, Dyad::RP { v, .. }) => {
                in_line(v, u, out);
                self.other_corner(at, base, platform, out);
                return;
            }
            _ => return,
        };
        // In one mode it is the place of B with the pivot between them at `pin`.
        let link = self.b - arm;
        in_line(arm, at - pin, out);
        turned_back(on_line(self.b, at - pin, Point::zeros(), link), out);
        match self.chain {
            Chain::Prr { e, .. } => {
                out.extend(on_line(at - pin, arm, Point::zeros(), left(e)));
                in_line(link, left(e), out);
            }
            _ => {
                out.extend(on_line(at - self.a, arm, Point::zeros(), pin - self.a));
                in_line(link, pin - self.a, out);
            }
        }
        if self.modes == [true, true] {
            self.other_corner(at, base, platform, out);
        }
    }

    /// The same for the corner where the two are in different modes.
    fn other_corner(&self, at: Point, base: &Limit, platform: &Limit, out: &mut Vec<f64>) {
        /// Even cuts of the circle between which each function changes its sign once at most (heuristic: they are of degree six at most, so that only pairs
        /// of zeros nearer than this are missed, between which a distance changes by its smallness squared).
        const CUTS: u32 = 96;
        /// Step of a central difference, radians: its square against roundings over it.
        const STEP: f64 = 1e-6;
        /// Halvings: to a rounding of the angle.
        const HALVINGS: u32 = 44;
        // From B to the corner, and the normals there.
        let corner = |phi: f64| -> Option<(Point, [Point; 2])> {
            let turn = direction(phi);
            let pivot = at + product(turn, self.b);
            let (place, normals) = match (base.dyad, platform.dyad) {
                (Dyad::RR { a: pin, .. }, Dyad::RR { b: arm, .. }) => {
                    // The other meeting point of both circles: the parallelogram's corner mirrored in the line of centres.
                    let second = self.a + product(turn, self.b - arm);
                    let across = (second - pin).try_normalize(0.0)?;
                    let known = second - self.a;
                    let place = pin + across * (2.0 * across.dot(&known)) - known;
                    (place, [place - pin, place - second])
                }
                (Dyad::RR { a: pin, .. }, Dyad::PR { u, b: arm, .. }) => {
                    let (along, link) = (u.normalize(), product(turn, self.b - arm));
                    let place = pin + link - along * (2.0 * along.dot(&link));
                    (place, [place - pin, Point::new(-along.y, along.x)])
                }
                _ => {
                    let (one, other) = (base_carrier(base), self.turning_carrier(platform)?);
                    let (Carrier::Line { point, direction: u }, Carrier::Line { point: q, direction: v }) =
                        (one, other)
                    else {
                        return None;
                    };
                    let (q, v) = (self.a + product(turn, q), product(turn, v));
                    let cross = u.perp(&v);
                    if cross == 0.0 {
                        return None;
                    }
                    let left = |v: Point| Point::new(-v.y, v.x);
                    (point + u * ((q - point).perp(&v) / cross), [left(u), left(v)])
                }
            };
            Some((place - pivot, normals))
        };
        let value = |which: usize, phi: f64| -> Option<f64> {
            if which < 2 {
                let (to, normals) = corner(phi)?;
                return Some(to.perp(&normals[which]));
            }
            let ends = [phi - STEP, phi + STEP].map(corner);
            let [Some((before, _)), Some((after, _))] = ends else { return None };
            Some((after - before).dot(&(after + before)))
        };
        for which in 0..3 {
            let part = |k: u32| -PI + TAU * f64::from(k) / f64::from(CUTS);
            let samples: Vec<Option<f64>> = (0..=CUTS).map(|k| value(which, part(k))).collect();
            for k in 0..CUTS {
                let (Some(a), Some(b)) = (samples[k as usize], samples[k as usize + 1]) else { continue };
                if (a > 0.0) == (b > 0.0) {
                    continue;
                }
                let (mut low, mut high) = (part(k), part(k + 1));
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (low + high);
                    match value(which, middle) {
                        Some(at_middle) if (at_middle > 0.0) == (a > 0.0) => low = middle,
                        _ => high = middle,
                    }
                }
                out.push(principal(0.5 * (low + high)));
            }
        }
    }

    /// What a limit of joint 3 holds the platform pivot on, in the frame that turns with the platform about the base pivot; `None` for sliders, whose lines keep their direction.
    fn turning_carrier(&self, limit: &Limit) -> Option<Carrier> {
        match limit.dyad {
            Dyad::RR { b, length, .. } => Some(Carrier::Circle { center: self.b - b, radius: length }),
            Dyad::RP { v, offset, .. } => {
                let d = match offset {
                    Offset::Distance(d) => d,
                    Offset::TimesDirection(delta) => delta / v.norm(),
                };
                let direction = v.normalize();
                Some(Carrier::Line { point: Point::new(direction.y, -direction.x) * d, direction })
            }
            _ => None,
        }
    }
}

/// What a limit of the joints 1 and 2 holds the platform pivot on.
fn base_carrier(limit: &Limit) -> Carrier {
    match limit.dyad {
        Dyad::RR { a, length, .. } => Carrier::Circle { center: a, radius: length },
        Dyad::PR { a, u, .. } => Carrier::Line { point: a, direction: u.normalize() },
        _ => unreachable!("a limit of the platform pivot alone"),
    }
}

/// The direction across a carrier at one of its places.
fn normal(carrier: &Carrier, at: Point) -> Point {
    match carrier {
        Carrier::Circle { center, .. } => at - center,
        Carrier::Line { direction, .. } => Point::new(-direction.y, direction.x),
    }
}

/// The orientations in which a platform vector points along a base vector, or against it.
fn in_line(arm: Point, base: Point, out: &mut Vec<f64>) {
    let phi = base.y.atan2(base.x) - arm.y.atan2(arm.x);
    out.extend([principal(phi), principal(phi + PI)]);
}

/// The orientations in which `from + R arm` lies on a line.
fn on_line(from: Point, arm: Point, point: Point, along: Point) -> impl Iterator<Item = f64> {
    let held = (along != Point::zeros()).then_some(Limit {
        leg: 0,
        mode: None,
        cause: LimitCause::Left,
        dyad: Dyad::PR { a: point, u: along, b: arm },
        sense: 1.0,
    });
    held.into_iter().flat_map(move |limit| limit.orientations_at(from, 0.0))
}

/// Orientations of the base seen from the platform, as those of the platform.
fn turned_back(phis: impl Iterator<Item = f64>, out: &mut Vec<f64>) {
    out.extend(phis.map(|phi| principal(-phi)));
}
