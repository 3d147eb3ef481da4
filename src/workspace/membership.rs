//! How far a place is from the edge of a workspace, and which limit says so.
//!
//! At one orientation a leg allows a region of its platform pivot; the leg's slack is the signed distance to the edge of that region, and the
//! slack of the place the least over the legs: how far the reference point may be moved without turning the platform. The margin is
//! the greatest slack over the orientations (for total and dextrous the least). Between orientations where a leg meets a limit, or where
//! the distance to a piece of an edge is stationary or passes to another piece, every such distance is monotone, and these orientations are known
//! in closed form (all but one kind, see [`super::moving_edge`]). In between the least of the distances has one peak (superlevel sets of monotone functions are intervals, and so are their
//! intersections), which is where the slope changes its sign; the least value lies at an end.
//!
//! Of legs with a range of joint 3 the edge moves with the orientation; their orientations are in [`super::moving_edge`].

use std::f64::consts::{PI, TAU};

use arrayvec::ArrayVec;
use nalgebra::Vector2;

use super::arrangement::{Bound, Plan};
use super::boundary::{ArcCurve, BoundaryArc};
use super::leg::LegReach;
use super::limits::{ActiveLimit, Limit, LimitCause};
use super::reach::Reach;
use super::region::{Isolated, WorkspaceKind};
use crate::linkage::Dyad;
use crate::plane::{Carrier, PhiRange, Sector, direction, principal, product};

/// How a place stands to a workspace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Membership {
    /// Whether it belongs to it.
    pub inside: bool,
    /// In length units: the largest over the allowed orientations (for total and dextrous the smallest) of the smallest slack over
    /// all limits; negative outside.
    pub margin: f64,
    /// The limit that leaves no more; `None` where nothing limits.
    pub binding: Option<ActiveLimit>,
}

/// A piece of the edge of what a leg allows, in the plane of `C` at the orientation zero or at the one asked for.
#[derive(Clone, Debug)]
pub(super) struct Edge {
    shape: Shape,
    ends: [Vector2<f64>; 2],
    active: ActiveLimit,
}

#[derive(Clone, Debug)]
enum Shape {
    Point,
    /// A segment with its unit vector and length.
    Segment(Vector2<f64>, f64),
    /// An arc over a sector, or a whole circle.
    Arc(Vector2<f64>, f64, Option<Sector>),
}

/// A slack and the limit that leaves it.
#[derive(Clone, Copy, Debug)]
struct Slack {
    value: f64,
    /// Per radian that the platform turns; NaN where the edge moves with it.
    slope: f64,
    binding: Option<ActiveLimit>,
}

impl Slack {
    const NONE: Self = Self { value: f64::INFINITY, slope: 0.0, binding: None };
}

impl Edge {
    fn new(arc: &BoundaryArc) -> Option<Self> {
        let ends = [arc.start, arc.end].map(Vector2::from);
        let shape = match arc.curve {
            ArcCurve::Line => Shape::Segment((ends[1] - ends[0]).try_normalize(0.0)?, (ends[1] - ends[0]).norm()),
            ArcCurve::Circle { center, radius, start_angle, end_angle } => {
                let from = start_angle.min(end_angle);
                Shape::Arc(center.into(), radius, Sector::new(direction(from), (end_angle - start_angle).abs()))
            }
            ArcCurve::Coupler(_) | ArcCurve::Ellipse(_) => return None,
        };
        Some(Self { shape, ends, active: *arc.active.first()? })
    }

    /// How far a place is from this piece, and the unit vector in which it becomes farther; not finite on an end that is nearest.
    fn distance(&self, p: Vector2<f64>) -> (f64, Vector2<f64>) {
        let from_ends = || {
            let [one, other] = self.ends.map(|end| p - end);
            let away = if one.norm_squared() <= other.norm_squared() { one } else { other };
            let distance = away.norm();
            (distance, away / distance)
        };
        match &self.shape {
            Shape::Point => from_ends(),
            Shape::Segment(u, length) => {
                let from = p - self.ends[0];
                if !(0.0..=*length).contains(&u.dot(&from)) {
                    return from_ends();
                }
                let across = u.perp(&from);
                (across.abs(), Vector2::new(-u.y, u.x) * across.signum())
            }
            Shape::Arc(center, radius, sector) => {
                let from = p - center;
                if sector.is_some_and(|sector| !sector.contains(from, 0.0)) {
                    return from_ends();
                }
                let norm = from.norm();
                ((norm - radius).abs(), from * ((norm - radius).signum() / norm))
            }
        }
    }

    /// Orientations where the distance of `C + (R - 1) b` from this piece is stationary or passes from its inside to an end.
    fn events(&self, at: Vector2<f64>, b: Vector2<f64>, out: &mut Vec<f64>) {
        // The moving point is q + R b.
        let (q, arm) = (at - b, b.y.atan2(b.x));
        let mut aligned = |p: Vector2<f64>| {
            let away = q - p;
            let phi = away.y.atan2(away.x) - arm;
            out.extend([principal(phi), principal(phi + PI)]);
        };
        for end in self.ends {
            aligned(end);
        }
        let across = |point: Vector2<f64>, u: Vector2<f64>| {
            let dyad = Dyad::PR { a: point, u, b };
            let held = Limit { leg: 0, mode: None, cause: LimitCause::Left, dyad, sense: 1.0 };
            held.orientations_at(q, 0.0)
        };
        match &self.shape {
            Shape::Point => {}
            Shape::Segment(u, _) => {
                let left = Vector2::new(-u.y, u.x);
                for end in self.ends {
                    out.extend(across(end, left));
                }
                let phi = left.y.atan2(left.x) - arm;
                out.extend([principal(phi), principal(phi + PI)]);
            }
            Shape::Arc(center, _, sector) => {
                aligned(*center);
                if sector.is_some() {
                    for end in self.ends {
                        out.extend(across(*center, end - center));
                    }
                }
            }
        }
    }
}

impl LegReach {
    /// The edge of what the leg allows `C` at an orientation.
    fn edges(&self, turn: Vector2<f64>, size: f64) -> Vec<Edge> {
        /// Unbounded edges are followed so many times the mechanism's largest length.
        const HORIZON: f64 = 1e4;
        let horizon = Carrier::Circle { center: self.a, radius: HORIZON * size };
        let mut bounds: Vec<Bound> = (self.limits.iter())
            .map(|limit| Bound {
                carrier: limit.at_orientation(turn),
                leg: 0,
                active: [limit.active()].into_iter().collect(),
            })
            .collect();
        bounds.push(Bound { carrier: horizon, leg: 0, active: ArrayVec::from_iter([ActiveLimit::PhiFrom]) });
        let admits = |_, p: Vector2<f64>, tol: f64| horizon.distance(p) <= tol && self.allows_pose(p, turn, tol);
        let region = Plan { bounds: &bounds, legs: 1, admits: &admits, size }.region();
        let mut edges: Vec<Edge> = (region.loops.iter().flat_map(|l| &l.arcs).chain(&region.unclosed))
            .filter(|arc| arc.active != [ActiveLimit::PhiFrom])
            .filter_map(Edge::new)
            .collect();
        for part in &region.isolated {
            match part {
                Isolated::Curve(arc) => edges.extend(Edge::new(arc)),
                Isolated::Point { at, active } => edges.extend(active.first().map(|&active| Edge {
                    shape: Shape::Point,
                    ends: [Vector2::from(*at); 2],
                    active,
                })),
            }
        }
        edges
    }

    /// The edge that does not move with the platform; empty for rings, which need none, and for legs whose edge moves.
    pub(super) fn fixed_edges(&self, size: f64) -> Vec<Edge> {
        if self.ring.is_some() || self.platform_sector.is_some() {
            return Vec::new();
        }
        self.edges(Vector2::x(), size)
    }

    /// The leg's slack at a pose.
    fn slack(&self, at: Vector2<f64>, turn: Vector2<f64>, fixed: &[Edge], size: f64) -> Slack {
        lesser(self.sides(at, turn, fixed, size))
    }

    /// The leg's slack at a pose as the lesser of two: what grows as the platform turns on, and what falls. Between events each keeps doing so.
    fn sides(&self, at: Vector2<f64>, turn: Vector2<f64>, fixed: &[Edge], size: f64) -> [Slack; 2] {
        if self.ring.is_some() {
            let [beyond, within] = self.ring_slacks(at, turn);
            // One grows as fast as the other falls.
            return if beyond.slope >= 0.0 { [beyond, within] } else { [within, beyond] };
        }
        let arm = product(turn, self.b);
        let moved;
        let (edges, place, moves) = if self.platform_sector.is_some() {
            moved = self.edges(turn, size);
            (&moved[..], at, Vector2::repeat(f64::NAN))
        } else {
            (fixed, at + arm - self.b, Vector2::new(-arm.y, arm.x))
        };
        let side = |slack: Slack| if slack.slope >= 0.0 { [slack, Slack::NONE] } else { [Slack::NONE, slack] };
        let mut pieces = edges.iter().map(|edge| {
            let (value, away) = edge.distance(place);
            Slack { value, slope: away.dot(&moves), binding: Some(edge.active) }
        });
        if self.allows_pose(at, turn, 0.0) {
            // Without an edge everything is allowed.
            return pieces.fold([Slack::NONE; 2], |sides, piece| lesser_of_each(sides, side(piece)));
        }
        // Outside it is as far to the nearest piece; without one nothing is allowed anywhere.
        let nothing = Slack { binding: self.limits.first().map(Limit::active), ..Slack::NONE };
        let first = pieces.next().unwrap_or(nothing);
        let nearest = pieces.fold(first, |one, other| if other.value < one.value { other } else { one });
        side(Slack { value: -nearest.value, slope: -nearest.slope, ..nearest })
    }

    /// How far the pivots of a ring are beyond its inner radius, and within its outer one.
    fn ring_slacks(&self, at: Vector2<f64>, turn: Vector2<f64>) -> [Slack; 2] {
        let [low, high] = self.ring.unwrap_or_default();
        let arm = product(turn, self.b);
        let leg = at + arm - self.a;
        let d = leg.norm();
        let parting = leg.dot(&Vector2::new(-arm.y, arm.x)) / d;
        let limit = |radius: f64| {
            let is = |limit: &&Limit| matches!(limit.dyad, Dyad::RR { length, .. } if length == radius);
            self.limits.iter().find(is).map(Limit::active)
        };
        let beyond = Slack { value: d - low, slope: parting, binding: limit(low) };
        let within =
            Slack { value: high - d, slope: -parting, binding: if high < f64::INFINITY { limit(high) } else { None } };
        [if low > 0.0 { beyond } else { Slack { slope: parting, ..Slack::NONE } }, within]
    }

    /// Orientations between which the leg's slack has one peak.
    fn events(&self, at: Vector2<f64>, fixed: &[Edge], size: f64, out: &mut Vec<f64>) {
        if self.b == Vector2::zeros() && self.platform_sector.is_none() {
            return;
        }
        if self.ring.is_some() {
            let away = at - self.a;
            let phi = away.y.atan2(away.x) - self.b.y.atan2(self.b.x);
            out.extend([principal(phi), principal(phi + PI)]);
            return;
        }
        out.extend(self.limits.iter().flat_map(|limit| limit.orientations_at(at, 0.0)));
        if self.platform_sector.is_some() {
            self.moving_edge_events(at, size, out);
        }
        for edge in fixed {
            edge.events(at, self.b, out);
        }
    }
}

impl Reach {
    /// Whether a place belongs to a workspace, how far it is from the edge in its best orientation, and which limit binds there.
    ///
    /// **Accuracy**: a few roundings of the mechanism's largest length; for legs with a range of joint 3 a peak nearer than 1e-5 rad to where the shape of an edge changes
    /// may be cut by that share of a pivot's way, and where joints 1 and 3 end in different modes, two events within 0.07 rad of each other may be missed. Outside, the margin is measured to the nearest
    /// edges in the best orientation. **Cost**: `inside` alone ([`Reach::contains`]) below a microsecond; the margin some microseconds for rings, some tens for sliders with links and sectors, tens of milliseconds, and up to a second, for legs with a range of joint 3.
    ///
    /// ```
    /// use assur::{Leg, Manipulator, workspace::{WorkspaceKind, WorkspaceModes}};
    /// let legs = [[0.0, 0.0], [20.0, 0.0], [0.0, 10.0]].map(|a| {
    ///     Leg { limits: [None, Some([1.0, 15.0]), None], ..Leg::rpr(a, [0.0, 0.0]) }
    /// });
    /// let reach = Manipulator::new("three rings", legs.to_vec())?.reach(&WorkspaceModes::Both)?;
    /// let found = reach.membership(&WorkspaceKind::Maximal, [8.0, 6.0].into());
    /// assert!(found.inside && (found.margin - (15.0 - 180.0_f64.sqrt())).abs() < 1e-14);
    /// assert_eq!(found.binding.unwrap().to_string(), "leg 2 max");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn membership(&self, kind: &WorkspaceKind, at: Vector2<f64>) -> Membership {
        let inside = self.contains(kind, at);
        let slack = match kind {
            WorkspaceKind::Constant { phi } => self.slack(at, *phi),
            WorkspaceKind::Maximal => self.extreme_slack(at, &PhiRange::FULL, true),
            WorkspaceKind::Inclusive(range) => self.extreme_slack(at, range, true),
            WorkspaceKind::Total(range) => self.extreme_slack(at, range, false),
            WorkspaceKind::Dextrous => self.extreme_slack(at, &PhiRange::FULL, false),
        };
        // On the edge itself roundings may have the two disagree.
        let margin = if inside { slack.value.max(0.0) } else { slack.value.min(0.0) };
        Membership { inside, margin, binding: slack.binding }
    }

    /// The least slack of the legs at a pose.
    fn slack(&self, at: Vector2<f64>, phi: f64) -> Slack {
        let turn = direction(phi);
        let slacks = self.legs.iter().zip(&self.edges).map(|(leg, fixed)| leg.slack(at, turn, fixed, self.size));
        slacks.min_by(|a, b| a.value.total_cmp(&b.value)).unwrap_or(Slack::NONE)
    }

    /// The greatest or the least slack over a range of orientations.
    fn extreme_slack(&self, at: Vector2<f64>, range: &PhiRange, greatest: bool) -> Slack {
        if greatest {
            return self.extreme_of(0..self.legs.len(), at, range, true);
        }
        // The least is that of one leg, which outside has valleys of its own only.
        let each = (0..self.legs.len()).map(|leg| self.extreme_of(leg..leg + 1, at, range, false));
        each.min_by(|a, b| a.value.total_cmp(&b.value)).unwrap_or(Slack::NONE)
    }

    /// The same of some of the legs.
    fn extreme_of(&self, legs: std::ops::Range<usize>, at: Vector2<f64>, range: &PhiRange, greatest: bool) -> Slack {
        let each = || self.legs[legs.clone()].iter().zip(&self.edges[legs.clone()]);
        let mut events = Vec::new();
        for (leg, fixed) in each() {
            leg.events(at, fixed, self.size, &mut events);
        }
        // As turns on from the beginning of the range.
        let width = range.width.min(TAU);
        let mut cuts: Vec<f64> = events.iter().map(|phi| (phi - range.from).rem_euclid(TAU)).collect();
        cuts.retain(|&cut| cut < width);
        cuts.extend([0.0, width]);
        /// Events nearer than this (radians; some roundings of an angle) are one.
        const SEAM: f64 = 1e-14;
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|later, earlier| *later - *earlier <= SEAM);
        let moving = self.legs[legs.clone()].iter().any(|leg| leg.platform_sector.is_some());
        let slack_of = |cut: f64, which: &dyn Fn(&LegReach) -> bool| {
            let turn = direction(range.from + cut);
            let slacks = each().filter(|(leg, _)| which(leg)).map(|(leg, fixed)| leg.slack(at, turn, fixed, self.size));
            slacks.min_by(|a, b| a.value.total_cmp(&b.value)).unwrap_or(Slack::NONE)
        };
        let slack = |cut: f64| slack_of(cut, &|_| true);
        let sides = |cut: f64| {
            let turn = direction(range.from + cut);
            let each = each().map(|(leg, fixed)| leg.sides(at, turn, fixed, self.size));
            each.fold([Slack::NONE; 2], lesser_of_each)
        };
        // The slack of legs whose edges stand changes no faster than a pivot moves; corners of an edge that moves with the platform have no such bound.
        let stands = |leg: &LegReach| leg.platform_sector.is_none();
        let speed = each().filter(|(leg, _)| stands(leg)).map(|(leg, _)| leg.b.norm()).fold(0.0, f64::max);
        let better = |a: &Slack, b: &Slack| if greatest { a.value > b.value } else { a.value < b.value };
        let steady: Vec<Slack> = cuts.iter().map(|&cut| slack_of(cut, &stands)).collect();
        // The best that legs whose edges stand leave in an interval; the most promising first.
        let bound = |k: usize| {
            let (room, middle) = (0.5 * speed * (cuts[k + 1] - cuts[k]), 0.5 * (steady[k].value + steady[k + 1].value));
            if greatest { middle + room } else { middle - room }
        };
        let mut order: Vec<(f64, usize)> = (0..cuts.len().saturating_sub(1)).map(|k| (bound(k), k)).collect();
        if greatest {
            order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        }
        let mut values: Vec<Option<Slack>> =
            if moving { vec![None; cuts.len()] } else { steady.iter().copied().map(Some).collect() };
        if cuts.len() == 1 {
            return slack(cuts[0]);
        }
        let mut best = Slack { value: if greatest { f64::NEG_INFINITY } else { f64::INFINITY }, ..Slack::NONE };
        if !moving {
            best = steady
                .iter()
                .copied()
                .reduce(|best, next| if better(&next, &best) { next } else { best })
                .unwrap_or(best);
        }
        for (bound, k) in order {
            if (greatest || !moving) && !better(&Slack { value: bound, ..Slack::NONE }, &best) {
                continue;
            }
            let ends = [k, k + 1].map(|k| *values[k].get_or_insert_with(|| slack(cuts[k])));
            for end in &ends {
                if better(end, &best) {
                    best = *end;
                }
            }
            // Inside, the least value is at an end; outside, the distance to the nearest piece may pass from one to another.
            let inside = |slack: &Slack| slack.value >= 0.0;
            if !greatest && ends.iter().all(inside) && (!moving || inside(&slack(0.5 * (cuts[k] + cuts[k + 1])))) {
                continue;
            }
            let stretch = [cuts[k], cuts[k + 1]];
            let found = match (moving, greatest) {
                (true, _) => moving_peak(&slack, stretch, ends, greatest),
                (false, true) => crossing_peak(&sides, stretch, ends, self.size),
                (false, false) => valley(&slack, stretch, ends),
            };
            if better(&found, &best) {
                best = found;
            }
        }
        best
    }
}

fn lesser([grows, falls]: [Slack; 2]) -> Slack {
    if falls.value < grows.value { falls } else { grows }
}

fn lesser_of_each(mut one: [Slack; 2], other: [Slack; 2]) -> [Slack; 2] {
    for (one, other) in one.iter_mut().zip(other) {
        if other.value < one.value {
            *one = other;
        }
    }
    one
}

/// This share of a stretch inside its ends it is asked where a slack goes: at the ends themselves its slope may be that beyond (heuristic: well above the roundings of an angle, and
/// what a slack gains in it is a rounding).
const JUST_INSIDE: f64 = 1e-12;

/// The peak between two events of the lesser of a slack that grows and one that falls: where they cross, by Newton's method within bounds, or at an end.
fn crossing_peak(sides: &dyn Fn(f64) -> [Slack; 2], [from, to]: [f64; 2], ends: [Slack; 2], size: f64) -> Slack {
    /// Steps; half of the stretch goes with each that Newton's method does not take.
    const STEPS: usize = 60;
    let same = 4.0 * f64::EPSILON * size;
    let least = JUST_INSIDE * (to - from);
    let [mut a, mut b] = [from + least, to - least];
    let gap = |[grows, falls]: &[Slack; 2]| falls.value - grows.value;
    let higher = |one: Slack, other: Slack| if other.value > one.value { other } else { one };
    let mut best = higher(ends[0], ends[1]);
    let [left, right] = [sides(a), sides(b)];
    if gap(&left) <= 0.0 || gap(&right) >= 0.0 {
        return best;
    }
    let mut now = left;
    let mut x = a;
    for _ in 0..STEPS {
        let newton = x - gap(&now) / (now[1].slope - now[0].slope);
        let next = if newton > a && newton < b { newton } else { 0.5 * (a + b) };
        if next <= a || next >= b {
            break;
        }
        (x, now) = (next, sides(next));
        best = higher(best, lesser(now));
        if gap(&now).abs() <= same {
            break;
        }
        if gap(&now) > 0.0 {
            a = x;
        } else {
            b = x;
        }
    }
    best
}

/// The valley between two events, where the slope changes its sign, or the lesser end.
fn valley(f: &dyn Fn(f64) -> Slack, [from, to]: [f64; 2], ends: [Slack; 2]) -> Slack {
    let least = JUST_INSIDE * (to - from);
    let lower = |one: Slack, other: Slack| if other.value < one.value { other } else { one };
    let best = lower(ends[0], ends[1]);
    let [a, b] = [from + least, to - least];
    if f(a).slope >= 0.0 || f(b).slope <= 0.0 { best } else { lower(best, section_search(f, a, b, false)) }
}

/// The peak (or the valley) between two events of a function that may be another one at the events themselves, as where a part of what a leg allows has just shrunk away.
///
/// With one peak the function rises from the beginning and falls towards the end, or the peak is at an end.
fn moving_peak(f: &dyn Fn(f64) -> Slack, [from, to]: [f64; 2], ends: [Slack; 2], greatest: bool) -> Slack {
    /// So far inside the ends it is asked where the function goes, radians: nearer to where two carriers touch they are one to roundings.
    const INSIDE: f64 = 1e-5;
    if to - from < 4.0 * INSIDE {
        return f(0.5 * (from + to));
    }
    let better = |a: &Slack, b: &Slack| if greatest { a.value > b.value } else { a.value < b.value };
    let [first, second] = [1.0, 2.0].map(|steps| f(from + steps * INSIDE));
    let [last, before] = [1.0, 2.0].map(|steps| f(to - steps * INSIDE));
    if better(&second, &first) && better(&before, &last) {
        return section_search(f, from + INSIDE, to - INSIDE, greatest);
    }
    // Where the function jumps at the event its limit from inside counts.
    let limit = |near: &Slack, next: &Slack, end: &Slack| {
        if better(near, end) && better(near, next) {
            Slack { value: 2.0 * near.value - next.value, ..*near }
        } else {
            *end
        }
    };
    let (left, right) = (limit(&first, &second, &ends[0]), limit(&last, &before, &ends[1]));
    if better(&left, &right) { left } else { right }
}

/// The peak of a function with one peak between two arguments (or its valley), by golden section.
fn section_search(f: &dyn Fn(f64) -> Slack, from: f64, to: f64, greatest: bool) -> Slack {
    /// Sections by the golden ratio that leave 1e-12 of the interval; at a peak where two slopes meet this bounds the value's relative error.
    const SECTIONS: usize = 58;
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (mut a, mut b) = (from, to);
    let (mut x, mut y) = (b - GOLDEN * (b - a), a + GOLDEN * (b - a));
    let (mut fx, mut fy) = (f(x), f(y));
    for _ in 0..SECTIONS {
        if (fx.value > fy.value) == greatest {
            (b, y, fy) = (y, x, fx);
            x = b - GOLDEN * (b - a);
            fx = f(x);
        } else {
            (a, x, fx) = (x, y, fy);
            y = a + GOLDEN * (b - a);
            fy = f(y);
        }
    }
    if (fx.value > fy.value) == greatest { fx } else { fy }
}
