//! How the area of a workspace changes with the design.
//!
//! The area's derivative by a design number `p` is the integral of the speed at which the boundary moves outwards. On a piece of boundary with the
//! active limits `g_k(C, phi; p) = 0` and multipliers `lam_k >= 0`, for which `sum lam_k dg_k/dphi = 0`, the outward normal is `sum lam_k grad g_k`, and
//!
//! `speed = - sum lam_k dg_k/dp / |sum lam_k grad g_k|`
//!
//! (the envelope theorem). With one active limit `lam = 1`; with two they are `dg_2/dphi` and `-dg_1/dphi`; where an end of the range of orientations is active
//! it takes up what is left of `dg/dphi`. Corners contribute nothing. The derivative exists where the boundary changes smoothly with `p`; where pieces appear or
//! vanish the area still has it, for they do so with length zero, but where a joint pivot lies in the reference point (`b = 0`) the area may have a kink.

use std::f64::consts::FRAC_PI_2;

use nalgebra::Vector2;

use super::boundary::{ArcCurve, BoundaryArc};
use super::limits::{ActiveLimit, Limit, LimitCause, WorkspaceError, WorkspaceModes, beside};
use super::reach::Reach;
use super::region::{Workspace, WorkspaceKind};
use crate::linkage::Dyad;
use crate::manipulator::{DesignNumber, Manipulator};
use crate::plane::{Carrier, conjugate, direction, gauss, product};

/// Step of a design number for the derivative of a limit's own closed form, over the mechanism's size (angles: radians). The rule of four points misses the fourth
/// power of the step over the shortest length that the limit bends with, 2e-11 for a link of a twentieth of the size; roundings over the step are as small.
const STEP: f64 = 1e-4;
/// Steps that are tried, each a hundredth of the one before, where a limit does not exist on both sides.
const TRIES: usize = 4;
/// Offsets of the rule and their weights.
const RULE: [(f64, f64); 4] = [(-2.0, 1.0 / 12.0), (-1.0, -2.0 / 3.0), (1.0, 2.0 / 3.0), (2.0, -1.0 / 12.0)];
/// A coupler arc is cut into this many parts for the first try of the quadrature.
const PARTS: usize = 2;
/// A part and its halves must agree to this, relative to the length of the part times the largest speed on it. Far above the roundings of the limits' derivatives, which
/// halving does not make smaller; the halves themselves are better by the rule's order.
const AGREE: f64 = 1e-10;
/// A part is halved at most so often: where the speed has a kink, that is a thousandth of it.
const DEPTH: usize = 6;

impl Manipulator {
    /// The derivatives of a workspace's area by design numbers, exactly: integrals over its boundary, not differences of areas.
    ///
    /// **Shape**: one for each of `numbers`. **Units**: area over length, or over radians. **Accuracy**: quadrature to about 1e-10 of the boundary's length times its
    /// largest speed. **Cost**: some ten microseconds an arc and number.
    ///
    /// # Errors
    /// As [`Manipulator::reach`].
    ///
    /// ```
    /// use assur::workspace::{WorkspaceKind, WorkspaceModes};
    /// # let (mut robot, _) = assur::Manipulator::of_family("3-RPR")?;
    /// # robot.legs.iter_mut().for_each(|leg| leg.limits[1] = Some([5.0, 14.0]));
    /// let (kind, both) = (WorkspaceKind::Constant { phi: 0.3 }, WorkspaceModes::Both);
    /// let number = "leg1.limits.max".parse::<assur::DesignKey>()?.numbers(&robot)?[0];
    /// let workspace = robot.workspace(&kind, &both)?;
    /// let slope = robot.area_gradient(&workspace, &both, &[number])?[0];
    /// robot.set_design_number(number, 14.0 + 1e-6)?;
    /// let difference = (robot.workspace(&kind, &both)?.region.area - workspace.region.area) / 1e-6;
    /// assert!((slope - difference).abs() < 1e-4);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn area_gradient(
        &self,
        workspace: &Workspace,
        modes: &WorkspaceModes,
        numbers: &[DesignNumber],
    ) -> Result<Vec<f64>, WorkspaceError> {
        let reach = self.reach(modes)?;
        let limits: Vec<Limit> = reach.limits().copied().collect();
        let nearby: Vec<Nearby> = numbers
            .iter()
            .map(|&number| Nearby::of(self, modes, number, &limits, reach.size()))
            .collect::<Result<_, _>>()?;
        let arcs = workspace.region.loops.iter().flat_map(|one| &one.arcs);
        let mut total = vec![0.0; numbers.len()];
        for arc in arcs {
            let held = Held { limits: &limits, nearby: &nearby, kind: &workspace.kind, arc };
            for (sum, part) in total.iter_mut().zip(held.integral()) {
                *sum += part;
            }
        }
        Ok(total)
    }
}

/// The limits of four designs around one, and the weights that make a derivative of them.
struct Nearby {
    /// For each limit its four neighbours; `None` where it does not exist around.
    limits: Vec<Option<[Limit; 4]>>,
    step: f64,
}

impl Nearby {
    fn of(
        robot: &Manipulator,
        modes: &WorkspaceModes,
        number: DesignNumber,
        limits: &[Limit],
        size: f64,
    ) -> Result<Self, WorkspaceError> {
        let value = robot.design_number(number).unwrap_or_default();
        let mut step = STEP * if number.is_angle(robot) { 1.0 } else { size };
        let mut found = Self { limits: vec![None; limits.len()], step };
        for _ in 0..TRIES {
            let around = RULE.map(|(offset, _)| -> Result<Reach, WorkspaceError> {
                let mut other = robot.clone();
                // The number exists, or there would be no value.
                let _ = other.set_design_number(number, value + offset * step);
                other.reach(modes)
            });
            let around = around.into_iter().collect::<Result<Vec<_>, _>>();
            if let Ok(around) = around {
                let of_each: Vec<Vec<Limit>> = around.iter().map(|reach| reach.limits().copied().collect()).collect();
                let rank = |all: &[Limit], k: usize| all[..k].iter().filter(|limit| same(limit, &all[k])).count();
                found.limits = (0..limits.len())
                    .map(|k| {
                        let wanted = rank(limits, k);
                        let twin =
                            |all: &Vec<Limit>| all.iter().filter(|limit| same(limit, &limits[k])).nth(wanted).copied();
                        let twins: Vec<Limit> = of_each.iter().map_while(twin).collect();
                        twins.try_into().ok()
                    })
                    .collect();
                found.step = step;
                if found.limits.iter().all(Option::is_some) {
                    break;
                }
            }
            step *= 1e-2;
        }
        Ok(found)
    }

    /// How the reference point moves at a given orientation where a limit holds two pivots in one place.
    fn motion(&self, limit: usize, turn: Vector2<f64>) -> Vector2<f64> {
        let place = |twin: &Limit| match twin.dyad {
            Dyad::RR { a, b, .. } => a - product(turn, b),
            _ => Vector2::zeros(),
        };
        self.limits[limit].map_or_else(Vector2::zeros, |twins| {
            twins.iter().zip(RULE).map(|(twin, (_, weight))| place(twin) * weight).sum::<Vector2<f64>>() / self.step
        })
    }

    /// The derivative of a limit's measure at a pose of the reference point.
    fn slope(&self, limit: usize, at: Vector2<f64>, turn: Vector2<f64>) -> f64 {
        self.limits[limit].map_or(0.0, |twins| {
            twins.iter().zip(RULE).map(|(twin, (_, weight))| weight * twin.value(at, turn)).sum::<f64>() / self.step
        })
    }
}

fn same(one: &Limit, other: &Limit) -> bool {
    one.leg == other.leg && one.cause == other.cause && one.mode == other.mode
}

/// A place on a piece of boundary: where, the derivative along it, the orientation.
struct Spot {
    at: Vector2<f64>,
    along: Vector2<f64>,
    phi: Option<f64>,
}

/// A piece of boundary with the limits that hold it.
struct Held<'a> {
    limits: &'a [Limit],
    nearby: &'a [Nearby],
    kind: &'a WorkspaceKind,
    arc: &'a BoundaryArc,
}

impl Held<'_> {
    /// For each number the integral of the boundary's speed over the piece.
    fn integral(&self) -> Vec<f64> {
        let parts = match &self.arc.curve {
            ArcCurve::Line => 1,
            ArcCurve::Circle { start_angle, end_angle, .. } => {
                ((end_angle - start_angle).abs() / FRAC_PI_2).ceil().max(1.0) as usize
            }
            ArcCurve::Coupler(_) | ArcCurve::Ellipse(_) => PARTS,
        };
        let mut total = vec![0.0; self.nearby.len()];
        for k in 0..parts {
            let (from, to) = (k as f64 / parts as f64, (k + 1) as f64 / parts as f64);
            let whole = self.gauss(from, to);
            for (sum, part) in total.iter_mut().zip(self.adapt(from, to, whole, DEPTH)) {
                *sum += part;
            }
        }
        total
    }

    fn adapt(&self, from: f64, to: f64, whole: Sums, depth: usize) -> Vec<f64> {
        let middle = 0.5 * (from + to);
        let (a, b) = (self.gauss(from, middle), self.gauss(middle, to));
        let sums: Vec<f64> = a.values.iter().zip(&b.values).map(|(a, b)| a + b).collect();
        let scale = a.largest + b.largest;
        let off = sums.iter().zip(&whole.values).map(|(s, w)| (s - w).abs()).fold(0.0, f64::max);
        if depth == 0 || off <= AGREE * scale {
            return sums;
        }
        let (a, b) = (self.adapt(from, middle, a, depth - 1), self.adapt(middle, to, b, depth - 1));
        a.iter().zip(&b).map(|(a, b)| a + b).collect()
    }

    fn gauss(&self, from: f64, to: f64) -> Sums {
        let mut out = Sums { values: vec![0.0; self.nearby.len()], largest: 0.0 };
        for (part, weight) in gauss(from, to) {
            let spot = self.spot(part);
            let length = spot.along.norm() * weight;
            for (sum, speed) in out.values.iter_mut().zip(self.speeds(&spot)) {
                *sum += speed * length;
                out.largest += speed.abs() * length;
            }
        }
        out
    }

    fn spot(&self, part: f64) -> Spot {
        match &self.arc.curve {
            ArcCurve::Line => {
                let along = Vector2::from(self.arc.end) - Vector2::from(self.arc.start);
                Spot { at: Vector2::from(self.arc.start) + along * part, along, phi: None }
            }
            ArcCurve::Circle { center, radius, start_angle, end_angle } => {
                let turn = end_angle - start_angle;
                let (sin, cos) = (start_angle + turn * part).sin_cos();
                let at = Vector2::from(*center) + Vector2::new(cos, sin) * *radius;
                Spot { at, along: Vector2::new(-sin, cos) * (*radius * turn), phi: None }
            }
            ArcCurve::Coupler(arc) | ArcCurve::Ellipse(arc) => {
                let (at, along) = arc.at(part);
                Spot { at, along, phi: Some(arc.phi_at(part)) }
            }
        }
    }

    /// For each number the speed of the boundary outwards.
    fn speeds(&self, spot: &Spot) -> Vec<f64> {
        let none = || vec![0.0; self.nearby.len()];
        let outward = Vector2::new(spot.along.y, -spot.along.x);
        let Some(outward) = outward.try_normalize(0.0) else { return none() };
        let (phi, held) = self.pose(spot);
        let turn = direction(phi);
        // Two pivots held in one place, as of a leg folded upon itself: the place moves as they do.
        if let Some(&k) = held.iter().find(|&&k| matches!(self.limits[k].dyad, Dyad::RR { length: 0.0, .. })) {
            return self.nearby.iter().map(|nearby| nearby.motion(k, turn).dot(&outward)).collect();
        }
        // Where a leg's modes merge, the surface of another of its limits touches that of the merging: there is no combination of the two, but the leg is rigid.
        if let [i, j] = held[..]
            && let Some(speeds) = self.touching(i, j, spot, outward)
        {
            return speeds;
        }
        let pushes: Vec<(usize, Vector2<f64>, f64)> = held
            .iter()
            .map(|&k| {
                let (normal, by_phi) = derivatives(&self.limits[k], spot.at, turn);
                (k, normal, by_phi)
            })
            .collect();
        // With the orientation given or at an end of its range, one limit is enough.
        let weighted: Vec<(usize, f64)> = match &pushes[..] {
            [] => return none(),
            [(k, ..)] => vec![(*k, 1.0)],
            [(i, _, by_i), (j, _, by_j), ..] => vec![(*i, *by_j), (*j, -by_i)],
        };
        let normal: Vector2<f64> = weighted
            .iter()
            .map(|(k, w)| pushes.iter().find(|push| push.0 == *k).map_or(Vector2::zeros(), |push| push.1) * *w)
            .sum();
        let across = normal.dot(&outward);
        if across == 0.0 {
            return none();
        }
        self.nearby
            .iter()
            .map(|nearby| {
                let change: f64 = weighted.iter().map(|(k, w)| w * nearby.slope(*k, spot.at, turn)).sum();
                -change / across
            })
            .collect()
    }

    /// The speeds where two limits of one leg touch along the piece.
    fn touching(&self, i: usize, j: usize, spot: &Spot, outward: Vector2<f64>) -> Option<Vec<f64>> {
        let (one, other) = (&self.limits[i], &self.limits[j]);
        if one.leg != other.leg || one.mode.is_some() == other.mode.is_some() {
            return None;
        }
        let across = rigid(one, other)?.normal(spot.at).dot(&outward);
        let speed = |nearby: &Nearby| {
            let (Some(ones), Some(others)) = (&nearby.limits[i], &nearby.limits[j]) else { return 0.0 };
            let off = |k: usize| rigid(&ones[k], &others[k]).map_or(0.0, |carrier| carrier.distance(spot.at));
            let change = RULE.iter().enumerate().map(|(k, (_, weight))| weight * off(k)).sum::<f64>() / nearby.step;
            -change / across
        };
        (across != 0.0).then(|| self.nearby.iter().map(speed).collect())
    }

    /// The orientation at a place of the boundary, and the limits that hold it there (one, or a pair).
    fn pose(&self, spot: &Spot) -> (f64, Vec<usize>) {
        if let ArcCurve::Coupler(arc) | ArcCurve::Ellipse(arc) = &self.arc.curve {
            let held = arc.pair.iter().filter_map(|limit| self.limits.iter().position(|other| other == limit));
            return (spot.phi.unwrap_or_default(), held.collect());
        }
        let causes: Vec<(usize, LimitCause)> = self
            .arc
            .active
            .iter()
            .filter_map(|active| match active {
                ActiveLimit::Leg { leg, cause } => Some((*leg, *cause)),
                ActiveLimit::PhiFrom | ActiveLimit::PhiTo => None,
            })
            .collect();
        let given = match self.kind {
            WorkspaceKind::Constant { phi } => Some(*phi),
            WorkspaceKind::Inclusive(range) | WorkspaceKind::Total(range) => {
                self.arc.active.iter().find_map(|active| match active {
                    ActiveLimit::PhiFrom => Some(range.from),
                    ActiveLimit::PhiTo => Some(range.from + range.width),
                    ActiveLimit::Leg { .. } => None,
                })
            }
            WorkspaceKind::Maximal | WorkspaceKind::Dextrous => None,
        };
        let of_cause = |(leg, cause): (usize, LimitCause)| {
            (0..self.limits.len()).filter(move |&k| self.limits[k].leg == leg && self.limits[k].cause == cause)
        };
        let off = |k: usize, phi: f64| self.limits[k].value(spot.at, direction(phi)).abs();
        let nearest = |candidates: Vec<(f64, Vec<usize>)>| {
            let miss = |(phi, held): &(f64, Vec<usize>)| held.iter().map(|&k| off(k, *phi)).fold(0.0, f64::max);
            candidates.into_iter().min_by(|one, other| miss(one).total_cmp(&miss(other))).unwrap_or_default()
        };
        let mut candidates = Vec::new();
        match (given, &causes[..]) {
            (_, []) => return (0.0, Vec::new()),
            (Some(phi), [first, ..]) => candidates.extend(of_cause(*first).map(|k| (phi, vec![k]))),
            (None, [only]) => {
                for k in of_cause(*only) {
                    candidates.extend(aligned(&self.limits[k], spot.at).into_iter().map(|phi| (phi, vec![k])));
                }
            }
            (None, [first, second, ..]) => {
                for i in of_cause(*first) {
                    for phi in self.limits[i].orientations_at(spot.at, f64::INFINITY) {
                        candidates.extend(of_cause(*second).map(|j| (phi, vec![i, j])));
                    }
                }
            }
        }
        nearest(candidates)
    }
}

/// The places of the reference point where two limits of one leg touch: the leg is straight, or stands across its slider, with one more joint held.
fn rigid(one: &Limit, other: &Limit) -> Option<Carrier> {
    let left = |v: Vector2<f64>| Vector2::new(-v.y, v.x);
    // The point of a circle on the line to another centre that has its distance from that.
    let between = |from: Vector2<f64>, length: f64, to: Vector2<f64>, wanted: f64| {
        let along = (to - from).try_normalize(0.0).unwrap_or_else(Vector2::zeros) * length;
        let miss = |p: &Vector2<f64>| ((p - to).norm() - wanted).abs();
        let [ahead, behind] = [from + along, from - along];
        if miss(&ahead) <= miss(&behind) { ahead } else { behind }
    };
    let circle = |center, radius| Some(Carrier::Circle { center, radius });
    match (one.dyad, other.dyad) {
        (Dyad::RR { a, b, length }, Dyad::RR { a: a2, b: b2, length: length2 }) => {
            if a == a2 {
                circle(a, between(b, length, b2, length2).norm())
            } else if b == b2 {
                circle(between(a, length, a2, length2), b.norm())
            } else {
                None
            }
        }
        (Dyad::RR { a, b, .. }, Dyad::PR { a: on, u, b: b2 })
        | (Dyad::PR { a: on, u, b: b2 }, Dyad::RR { a, b, .. })
            if b == b2 =>
        {
            let u = u.normalize();
            circle(on + u * u.dot(&(a - on)), b.norm())
        }
        (Dyad::RR { a, .. }, Dyad::RP { a: a2, b, v, offset })
        | (Dyad::RP { a: a2, b, v, offset }, Dyad::RR { a, .. })
            if a == a2 =>
        {
            circle(a, (b + left(v.normalize()) * beside(v, offset)).norm())
        }
        (Dyad::PR { a, u, b }, Dyad::PR { a: a2, u: u2, b: b2 }) if u == u2 => {
            let across = left(u.normalize());
            let towards = across * across.dot(&(a2 - a)).signum();
            let turn = product(conjugate((b2 - b).try_normalize(0.0)?), towards);
            Some(one.at_orientation(turn))
        }
        _ => None,
    }
}

/// Sums of a quadrature, and the sum of the largest sizes.
struct Sums {
    values: Vec<f64>,
    largest: f64,
}

/// The gradient of a limit's measure by the place, and its derivative by the orientation.
fn derivatives(limit: &Limit, at: Vector2<f64>, turn: Vector2<f64>) -> (Vector2<f64>, f64) {
    let left = |v: Vector2<f64>| Vector2::new(-v.y, v.x);
    match limit.dyad {
        Dyad::RR { a, b, .. } => {
            let arm = product(turn, b);
            let normal = (at + arm - a).try_normalize(0.0).unwrap_or_else(Vector2::zeros);
            (normal, normal.dot(&left(arm)))
        }
        Dyad::PR { u, b, .. } => {
            let normal = left(u.normalize());
            (normal, normal.dot(&left(product(turn, b))))
        }
        Dyad::RP { a, v, .. } => {
            let along = product(turn, v).normalize();
            (-left(along), -along.dot(&(a - at)))
        }
        Dyad::PP { .. } => unreachable!("no limit of a covered leg leaves two sliders"),
    }
}

/// The orientations in which a limit's measure is stationary at a place.
pub(super) fn aligned(limit: &Limit, at: Vector2<f64>) -> [f64; 2] {
    // The direction of `of` (platform) turned onto that of `onto` (base), and against it.
    let onto = |of: Vector2<f64>, onto: Vector2<f64>| {
        let phi = onto.y.atan2(onto.x) - of.y.atan2(of.x);
        [phi, phi + std::f64::consts::PI]
    };
    let left = |v: Vector2<f64>| Vector2::new(-v.y, v.x);
    match limit.dyad {
        Dyad::RR { a, b, .. } => onto(b, at - a),
        Dyad::PR { u, b, .. } => onto(b, left(u)),
        Dyad::RP { a, v, .. } => onto(left(v), a - at),
        Dyad::PP { .. } => unreachable!("no limit of a covered leg leaves two sliders"),
    }
}
