//! Two limits of one leg at once: what the leg's remaining joint does with the platform.
//!
//! | leg | held | what is left |
//! |---|---|---|
//! | RPR | `u`, stroke | the platform turns about the pivot `B` |
//! | RPR | stroke, `v` | turns about `A` |
//! | RPR | `u`, `v` | slides along `u` |
//! | RRR | `u`, elbow | turns about `B` |
//! | RRR | elbow, `v` | turns about `A` |
//! | RRR | `u`, `v` | turns about the elbow |
//! | PRR | stroke, `w` | turns about `B` |
//! | PRR | stroke, `v` | turns about the slider's pivot |
//! | PRR | `w`, `v` | slides along the slider |
//!
//! `u` is the direction of the first moving link, `w` of the last, `v` that of the last seen from the platform. Where modes merge, the elbow is stretched or
//! folded, or the PRR link across the slider, or an RPR stroke zero.

use nalgebra::Vector2;

use super::super::leg::{Chain, LegReach};
use super::super::limits::{Limit, LimitCause, seen_from};
use super::super::reach::Reach;
use super::curves::Surface;
use super::motion::{Motion, angle};
use super::surface::quarter;
use crate::plane::{Carrier, Sector, conjugate, product};

type Point = Vector2<f64>;

/// What a limit holds.
#[derive(Clone, Copy, Debug)]
enum Held {
    /// Direction of the first moving link.
    First(Point),
    /// A stroke.
    Stroke(f64),
    /// Direction of link 2 seen from link 1.
    Elbow(Point),
    /// Direction of the last link of a PRR leg.
    Link(Point),
    /// Direction of the last link, or of the slider, seen from the platform.
    Last(Point),
}

fn held(leg: &LegReach, limit: &Limit) -> Option<Held> {
    let (joint, end) = match limit.cause {
        LimitCause::JointMin { joint, .. } => (joint, 0),
        LimitCause::JointMax { joint, .. } => (joint, 1),
        LimitCause::Stretched => return Some(Held::Elbow(Point::x())),
        LimitCause::Folded => return Some(Held::Elbow(-Point::x())),
        LimitCause::Shortest => return Some(Held::Stroke(0.0)),
        LimitCause::Left | LimitCause::Right => {
            let Chain::Prr { e, .. } = leg.chain else { return None };
            let side = if limit.cause == LimitCause::Left { 1.0 } else { -1.0 };
            return Some(Held::Link(quarter(e) * side));
        }
    };
    // The direction seen from the platform turns back while the joint's value grows.
    let ends = |sector: &Option<Sector>, from_first: bool| {
        sector.map(|sector| if from_first { sector.from } else { sector.to })
    };
    match (leg.chain, joint) {
        (Chain::Rpr { .. }, 1) | (Chain::Prr { .. }, 0) => Some(Held::Stroke(leg.stroke[end])),
        (Chain::Rpr { .. } | Chain::Rrr { .. }, 0) => ends(&leg.base_sector, end == 0).map(Held::First),
        (Chain::Rrr { .. }, 1) => ends(&leg.elbow_sector, end == 0).map(Held::Elbow),
        (Chain::Prr { .. }, 1) => ends(&leg.base_sector, end == 0).map(Held::Link),
        _ => ends(&leg.platform_sector, end == 1).map(Held::Last),
    }
}

/// The motion left to a leg with two of its limits held; `None` for two that hold the same joint.
pub(super) fn edge(leg: &LegReach, one: &Limit, other: &Limit) -> Option<Motion> {
    use Held::{Elbow, First, Last, Link, Stroke};
    let (a, b) = (leg.a, leg.b);
    let (one, other) = (held(leg, one)?, held(leg, other)?);
    let slide = |turn: Point, through: Point, direction: Point| {
        let turn = turn / turn.norm();
        Motion::Sliding { phi: angle(turn), turn, on: Carrier::Line { point: through - product(turn, b), direction } }
    };
    Some(match (leg.chain, one, other) {
        (Chain::Rpr { offset }, First(u), Stroke(rho)) | (Chain::Rpr { offset }, Stroke(rho), First(u)) => {
            Motion::Pinned { q: a + product(Point::new(rho, offset), u), p: b }
        }
        (Chain::Rpr { offset }, Last(v), Stroke(rho)) | (Chain::Rpr { offset }, Stroke(rho), Last(v)) => {
            Motion::Pinned { q: a, p: b - product(Point::new(rho, offset), v) }
        }
        (Chain::Rpr { offset }, First(u), Last(v)) | (Chain::Rpr { offset }, Last(v), First(u)) => {
            slide(product(u, conjugate(v)), a + quarter(u) * offset, u)
        }
        (Chain::Rrr { l1, l2 }, First(u), Elbow(e)) | (Chain::Rrr { l1, l2 }, Elbow(e), First(u)) => {
            Motion::Pinned { q: a + u * l1 + product(u, e) * l2, p: b }
        }
        (Chain::Rrr { l1, l2 }, Last(v), Elbow(e)) | (Chain::Rrr { l1, l2 }, Elbow(e), Last(v)) => {
            Motion::Pinned { q: a, p: b - v * l2 - product(v, conjugate(e)) * l1 }
        }
        (Chain::Rrr { l1, l2 }, First(u), Last(v)) | (Chain::Rrr { l1, l2 }, Last(v), First(u)) => {
            Motion::Pinned { q: a + u * l1, p: b - v * l2 }
        }
        (Chain::Prr { l, e }, Stroke(rho), Link(w)) | (Chain::Prr { l, e }, Link(w), Stroke(rho)) => {
            Motion::Pinned { q: a + e * rho + w * l, p: b }
        }
        (Chain::Prr { l, e }, Stroke(rho), Last(v)) | (Chain::Prr { l, e }, Last(v), Stroke(rho)) => {
            Motion::Pinned { q: a + e * rho, p: b - v * l }
        }
        (Chain::Prr { l, e }, Link(w), Last(v)) | (Chain::Prr { l, e }, Last(v), Link(w)) => {
            slide(product(w, conjugate(v)), a + w * l, e)
        }
        _ => return None,
    })
}

/// The pin of a leg whose two pivots can meet, an RPR leg without offset at stroke zero, an RRR leg of equal links folded: there both joint ranges end.
pub(super) fn apex(leg: &LegReach) -> Option<Motion> {
    let meets = match leg.chain {
        Chain::Rpr { offset } => offset == 0.0 && leg.stroke[0] <= 0.0 && leg.stroke[1] >= 0.0,
        Chain::Rrr { l1, l2 } => l1 == l2,
        Chain::Prr { .. } => false,
    };
    let ranged = leg.base_sector.is_some() || leg.platform_sector.is_some();
    (meets && ranged).then_some(Motion::Pinned { q: leg.a, p: leg.b })
}

/// The orientations at which a leg turning freely about its pivots that meet has both its first and its last joint at an end of their ranges; none for edges that
/// hold two joints.
pub(super) fn free_ends(one: &Surface, other: &Surface, reach: &Reach) -> Vec<f64> {
    let joint = |surface: &Surface| surface.limits[0].cause.joint();
    if joint(one).is_none() || joint(one) != joint(other) {
        return Vec::new();
    }
    let leg = &reach.legs[one.leg];
    let (Some(base), Some(platform)) = (leg.base_sector, leg.platform_sector) else { return Vec::new() };
    let mut out = Vec::new();
    for u in [base.from, base.to] {
        for v in [platform.from, platform.to] {
            out.push(angle(product(u, conjugate(v)) * along(leg)));
        }
    }
    out
}

/// Of a leg whose pivots meet: 1 where its last link then points as the first, -1 where it points back.
fn along(leg: &LegReach) -> f64 {
    if matches!(leg.chain, Chain::Rrr { .. }) { -1.0 } else { 1.0 }
}

/// Whether a leg with two of its limits held is allowed at a pose of the motion left to it: its third joint in range, and the mode that of both limits. Bounds missed by `tol`, a length, are met.
///
/// Asked of the joints held and not of the pose, in which merging modes hide a joint's value behind a root.
pub(super) fn holds(leg: &LegReach, limits: [&Limit; 2], c: Point, turn: Point, tol: f64) -> bool {
    use Held::{Elbow, First, Last, Link, Stroke};
    let from_base = c + product(turn, leg.b) - leg.a;
    let points = |sector: &Option<Sector>, v: Point| sector.is_none_or(|sector| sector.contains(v, tol));
    let within = |rho: f64| leg.stroke[0] - tol <= rho && rho <= leg.stroke[1] + tol;
    // Positive in the mode +; zero where modes merge.
    let is_mode = |measure: f64| {
        limits.iter().all(|limit| limit.mode.is_none_or(|plus| if plus { measure >= -tol } else { measure <= tol }))
            && ((leg.modes[0] && measure >= -tol) || (leg.modes[1] && measure <= tol))
    };
    let (Some(one), Some(other)) = (held(leg, limits[0]), held(leg, limits[1])) else { return false };
    match (leg.chain, one, other) {
        (Chain::Rpr { .. }, First(u), Stroke(rho)) | (Chain::Rpr { .. }, Stroke(rho), First(u)) => {
            within(rho) && is_mode(rho) && points(&leg.platform_sector, seen_from(turn, u))
        }
        (Chain::Rpr { .. }, Last(v), Stroke(rho)) | (Chain::Rpr { .. }, Stroke(rho), Last(v)) => {
            within(rho) && is_mode(rho) && points(&leg.base_sector, product(turn, v))
        }
        (Chain::Rpr { .. }, First(u), Last(_)) | (Chain::Rpr { .. }, Last(_), First(u)) => {
            let rho = u.dot(&from_base);
            within(rho) && is_mode(rho)
        }
        (Chain::Rrr { l2, .. }, First(u), Elbow(e)) | (Chain::Rrr { l2, .. }, Elbow(e), First(u)) => {
            let v = seen_from(turn, product(u, e));
            points(&leg.elbow_sector, e * l2) && is_mode(e.y) && points(&leg.platform_sector, v * l2)
        }
        (Chain::Rrr { l1, l2 }, Last(v), Elbow(e)) | (Chain::Rrr { l1, l2 }, Elbow(e), Last(v)) => {
            let u = product(product(turn, v), conjugate(e));
            points(&leg.elbow_sector, e * l2) && is_mode(e.y) && points(&leg.base_sector, u * l1)
        }
        (Chain::Rrr { l2, .. }, First(u), Last(v)) | (Chain::Rrr { l2, .. }, Last(v), First(u)) => {
            let e = product(conjugate(u), product(turn, v));
            points(&leg.elbow_sector, e * l2) && is_mode(e.y * l2)
        }
        (Chain::Prr { l, e }, Stroke(rho), Link(w)) | (Chain::Prr { l, e }, Link(w), Stroke(rho)) => {
            let merged = limits.iter().any(|limit| limit.mode.is_none());
            let measure = if merged { 0.0 } else { -w.dot(&e) };
            let v = seen_from(turn, w);
            within(rho) && points(&leg.base_sector, w * l) && is_mode(measure) && points(&leg.platform_sector, v * l)
        }
        (Chain::Prr { l, e }, Stroke(rho), Last(v)) | (Chain::Prr { l, e }, Last(v), Stroke(rho)) => {
            let w = product(turn, v);
            within(rho) && points(&leg.base_sector, w * l) && is_mode(-w.dot(&e) * l)
        }
        (Chain::Prr { l, e }, Link(w), Last(_)) | (Chain::Prr { l, e }, Last(_), Link(w)) => {
            let merged = limits.iter().any(|limit| limit.mode.is_none());
            let measure = if merged { 0.0 } else { -w.dot(&e) };
            within(e.dot(&from_base) - l * w.dot(&e)) && points(&leg.base_sector, w * l) && is_mode(measure)
        }
        // The pivots meet and the leg turns freely, as far as both ranges have a direction in common.
        _ => match (&leg.base_sector, &leg.platform_sector) {
            (Some(base), Some(platform)) => {
                let common = |u: Point| platform.contains(seen_from(turn, u) * along(leg), tol);
                let back = |v: Point| base.contains(product(turn, v) * along(leg), tol);
                common(base.from) || common(base.to) || back(platform.from) || back(platform.to)
            }
            _ => true,
        },
    }
}

/// Whether a pose on a limit's surface is a bound of the leg: the leg is in the limit's mode and its other joints are in range, all by `tol`, a length.
pub(super) fn bounds(leg: &LegReach, limit: &Limit, c: Point, turn: Point, tol: f64) -> bool {
    let at = c + product(turn, leg.b);
    let Some(plus) = limit.mode else {
        return [true, false]
            .into_iter()
            .any(|plus| leg.modes[usize::from(!plus)] && leg.allows_in(plus, at, turn, tol));
    };
    let side = if plus { 1.0 } else { -1.0 };
    // Positive in the mode +, on the surface.
    let measure = match (leg.chain, held(leg, limit)) {
        (Chain::Rpr { .. }, Some(Held::First(u))) => u.dot(&(at - leg.a)),
        (Chain::Rpr { .. }, Some(Held::Last(v))) => product(turn, v).dot(&(at - leg.a)),
        (Chain::Rrr { l1, .. }, Some(Held::First(u))) => u.perp(&(at - leg.a - u * l1)),
        (Chain::Rrr { l2, .. }, Some(Held::Last(v))) => {
            let w = product(turn, v);
            (at - leg.a - w * l2).perp(&w)
        }
        (Chain::Prr { e, .. }, Some(Held::Stroke(rho))) => -e.dot(&(at - leg.a - e * rho)),
        (Chain::Prr { e, .. }, Some(Held::Last(v))) => -e.dot(&product(turn, v)),
        // Stroke of RPR, elbow of RRR, link of PRR: the value itself is of one mode.
        _ => side,
    };
    measure * side >= -tol && leg.allows_in(plus, at, turn, tol)
}
