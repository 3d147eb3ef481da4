//! Which limits a followed mode crosses, and where; excursions inside a stretch included.
//!
//! A joint's way along a shown stretch is cut where its rate changes sign, where it passes the middle of its range and, for a revolute
//! joint, the middle of the gap; between cuts one end of the range at most is crossed, and bisected. Cuts come from the cubic through values and rates at the
//! ends of pieces, which are halved until the cubic foretells their middles to [`CUBIC`] of the joint's way.
//!
//! This is measured, not proved: an excursion shallower than that part of the way may be missed. Not watched: legs without actuator,
//! which may reach in several ways.

use nalgebra::Vector3;

use super::describe::{JointKind, Leg};
use super::follow::{FollowedPath, PathEvent, PathEventKind, Stretch, Walk, blend};
use super::forward::Violation;
use super::frame::principal_angle;
use super::joints::{Joints, read_off};
use super::lock::LockedLeg;
use crate::linkage::Pose;

impl Walk<'_> {
    /// All joints in a pose at these inputs; NaN for those of a leg without actuator, which may reach in several ways.
    fn joints(&self, inputs: &[f64], pose: &Pose) -> Vec<Joints> {
        let mut given = inputs.iter();
        let of_leg = |leg: &Leg| {
            let mut held = [0.0; 3];
            let mut values = Vec::new();
            for joint in (0..3).filter(|&joint| leg.actuated[joint]) {
                if let Some(&value) = given.next() {
                    held[joint] = value;
                    values.push((joint, value));
                }
            }
            read_off(leg, &LockedLeg::new(leg, &values), &held, pose).unwrap_or([f64::NAN; 3])
        };
        self.robot.legs.iter().map(of_leg).collect()
    }

    fn is_limited(&self) -> bool {
        self.robot.legs.iter().any(|leg| leg.limits != [None; 3])
    }

    pub fn violations(&self, inputs: &[f64], pose: &Pose) -> Vec<Violation> {
        if !self.is_limited() {
            return Vec::new();
        }
        let known = |violation: &Violation| violation.value.is_finite();
        self.robot.all_violations(&self.joints(inputs, pose)).into_iter().filter(known).collect()
    }

    /// Books each limit that is crossed on a shown stretch, where it is crossed.
    pub fn watch_limits(&mut self, out: &mut FollowedPath, stretch: &Stretch, [start, end]: [f64; 2]) {
        if !self.is_limited() {
            return;
        }
        let mut cuts = vec![start];
        self.cuts(&mut cuts, stretch, [start, end], CUTTINGS);
        cuts.retain(|&t| start <= t && t < end);
        cuts.push(end);
        cuts.sort_by(f64::total_cmp);
        cuts.dedup();
        for pair in cuts.windows(2) {
            self.watch_piece(out, stretch, [pair[0], pair[1]]);
        }
    }

    /// The pose of the mode somewhere on a stretch.
    fn pose_on(&self, stretch: &Stretch, t: f64) -> Option<Pose> {
        let inputs = blend(stretch.from, stretch.to, t);
        let hold = self.hold(&inputs, &vec![0.0; inputs.len()])?;
        let pose = hold.settle(&stretch.begin).or_else(|| hold.settle(&stretch.shown.centre))?;
        (hold.distance(&pose, &stretch.shown.centre) <= stretch.shown.radius).then_some(pose)
    }

    /// All joints and their rates by `t`, somewhere on a stretch; NaN where a rate is not determined.
    fn moving(&self, stretch: &Stretch, t: f64) -> Option<Moving> {
        let inputs = blend(stretch.from, stretch.to, t);
        let pose = self.pose_on(stretch, t)?;
        let values = self.joints(&inputs, &pose);
        let velocity = self.robot.velocity_at(&pose, &values);
        let input_rates =
            Vector3::from_iterator(stretch.from.iter().zip(stretch.to).map(|(a, b)| b - a).chain([0.0; 3]).take(3));
        let rates = velocity.pose_rates(&input_rates).and_then(|twist| velocity.joint_rates(&twist, &input_rates));
        Some(Moving { values, rates: rates.unwrap_or_else(|_| vec![[f64::NAN; 3]; self.robot.legs.len()]) })
    }

    /// Where to cut a stretch so that between cuts every limited joint crosses one end of its range at most.
    fn cuts(&self, cuts: &mut Vec<f64>, stretch: &Stretch, [start, end]: [f64; 2], halvings: usize) {
        let middle = (start + end) / 2.0;
        let at = |t: f64| self.moving(stretch, t);
        let (Some(first), Some(half), Some(last)) = (at(start), at(middle), at(end)) else { return };
        let width = end - start;
        let mut wanted = Vec::new();
        for (leg, description) in self.robot.legs.iter().enumerate() {
            for joint in 0..3 {
                let (kind, Some(limit)) = (description.joints[joint], description.limits[joint]) else { continue };
                if first.values[leg][joint].is_nan() {
                    continue;
                }
                // An actuated joint goes straight, and as far as it is told to.
                let apart = |p: &Moving, q: &Moving| {
                    let way = q.values[leg][joint] - p.values[leg][joint];
                    let turning = kind == JointKind::Revolute && !description.actuated[joint];
                    if turning { principal_angle(way) } else { way }
                };
                let cubic = Cubic::new(
                    first.values[leg][joint],
                    apart(&first, &last),
                    [first.rates[leg][joint] * width, last.rates[leg][joint] * width],
                );
                let off = (cubic.way(0.5) - apart(&first, &half)).abs();
                if halvings > 0 && (off > CUBIC * cubic.size() || !off.is_finite()) {
                    cuts.push(middle);
                    self.cuts(cuts, stretch, [start, middle], halvings - 1);
                    self.cuts(cuts, stretch, [middle, end], halvings - 1);
                    return;
                }
                let rate = |part: f64| at(start + part * width).map(|moving| moving.rates[leg][joint]);
                let turns = cubic.turning_points().into_iter().map(|part| sign_change(rate, part));
                wanted.extend(turns.chain(cubic.passes(&marks(kind, limit, &cubic))));
            }
        }
        cuts.extend(wanted.into_iter().map(|part| start + part * width));
    }

    /// Books the limits that are crossed between two cuts.
    fn watch_piece(&mut self, out: &mut FollowedPath, stretch: &Stretch, [start, end]: [f64; 2]) {
        let Some(pose) = self.pose_on(stretch, end) else { return };
        let after = self.violations(&blend(stretch.from, stretch.to, end), &pose);
        let same = |p: &Violation, q: &Violation| (p.leg, p.joint) == (q.leg, q.joint);
        let outside = |list: &[Violation], one: &Violation| list.iter().any(|other| same(other, one));
        let left = after.iter().filter(|v| !outside(&self.violated, v)).map(|v| (*v, true));
        let back = self.violated.iter().filter(|v| !outside(&after, v)).map(|v| (*v, false));
        let mut found = Vec::new();
        for (violation, leaves) in left.chain(back) {
            let (mut low, mut high, mut here) = (start, end, pose);
            for _ in 0..BISECTIONS {
                let middle = (low + high) / 2.0;
                let Some(there) = self.pose_on(stretch, middle) else { break };
                let violations = self.violations(&blend(stretch.from, stretch.to, middle), &there);
                if outside(&violations, &violation) == leaves {
                    (high, here) = (middle, there);
                } else {
                    low = middle;
                }
            }
            let inputs = blend(stretch.from, stretch.to, high);
            let value = self.joints(&inputs, &here)[violation.leg - 1][violation.joint - 1];
            let kind = PathEventKind::Limit { violation: Violation { value, ..violation }, leaves };
            found.push(PathEvent { at: stretch.step as f64 + high, kind, inputs, pose: here });
        }
        found.sort_by(|p, q| p.at.total_cmp(&q.at));
        out.events.extend(found);
        self.violated = after;
    }
}

/// All joints on the way, and their rates by the share of the way between rows.
struct Moving {
    values: Vec<Joints>,
    rates: Vec<[f64; 3]>,
}

/// A joint's way over a piece, from 0 to 1: the cubic with its ends and rates.
struct Cubic {
    begin: f64,
    /// `way(s) = c[0] s + c[1] s² + c[2] s³`
    c: [f64; 3],
}

impl Cubic {
    fn new(begin: f64, way: f64, [first, last]: [f64; 2]) -> Self {
        Self { begin, c: [first, 3.0 * way - 2.0 * first - last, first + last - 2.0 * way] }
    }

    fn way(&self, s: f64) -> f64 {
        s * (self.c[0] + s * (self.c[1] + s * self.c[2]))
    }

    /// A bound of how far it goes.
    fn size(&self) -> f64 {
        self.c.iter().map(|c| c.abs()).sum()
    }

    /// Where its rate vanishes, inside.
    fn turning_points(&self) -> Vec<f64> {
        let [c, b, a] = [self.c[0], 2.0 * self.c[1], 3.0 * self.c[2]];
        let discriminant = b * b - 4.0 * a * c;
        // NaN, of a rate that is not determined, has no turning point.
        if discriminant.is_nan() || discriminant <= 0.0 {
            return Vec::new();
        }
        // The sum without cancellation gives one root, the product the other.
        let q = -0.5 * (b + b.signum() * discriminant.sqrt());
        [q / a, c / q].into_iter().filter(|s| 0.0 < *s && *s < 1.0).collect()
    }

    /// Where it first passes each of these values, to bisection; between turning points it does so once.
    fn passes(&self, values: &[f64]) -> Vec<f64> {
        let mut ends = vec![0.0];
        ends.extend(self.turning_points());
        ends.push(1.0);
        ends.sort_by(f64::total_cmp);
        let mut out = Vec::new();
        for value in values {
            let above = |s: f64| self.begin + self.way(s) > *value;
            for pair in ends.windows(2).filter(|pair| above(pair[0]) != above(pair[1])) {
                let (mut low, mut high) = (pair[0], pair[1]);
                for _ in 0..BISECTIONS {
                    let middle = (low + high) / 2.0;
                    if above(middle) == above(pair[0]) { low = middle } else { high = middle }
                }
                out.push(high);
            }
        }
        out
    }
}

/// The values that part the ends of a range from each other: its middle and, modulo turns, the middle of the gap, where a joint's way reaches.
fn marks(kind: JointKind, [low, high]: [f64; 2], cubic: &Cubic) -> Vec<f64> {
    use std::f64::consts::{PI, TAU};
    match kind {
        JointKind::Prismatic => vec![low + (high - low) / 2.0],
        JointKind::Revolute => {
            let span = if high - low >= TAU { TAU } else { (high - low).rem_euclid(TAU) };
            let near = |mark: f64| mark + TAU * ((cubic.begin - mark) / TAU).round();
            let middles = [near(low + span / 2.0), near(low + span / 2.0 + PI)];
            middles.into_iter().flat_map(|mark| [mark - TAU, mark, mark + TAU]).collect()
        }
    }
}

/// Where a rate that changes sign near `guess` does so.
fn sign_change(rate: impl Fn(f64) -> Option<f64>, guess: f64) -> f64 {
    let (mut low, mut high) = ((guess - AROUND).max(0.0), (guess + AROUND).min(1.0));
    let (Some(first), Some(last)) = (rate(low), rate(high)) else { return guess };
    if first * last >= 0.0 {
        return guess;
    }
    for _ in 0..BISECTIONS / 2 {
        let middle = (low + high) / 2.0;
        match rate(middle) {
            Some(value) if value * first > 0.0 => low = middle,
            Some(_) => high = middle,
            None => break,
        }
    }
    (low + high) / 2.0
}

/// Bisections of a limit's crossing: to rounding.
const BISECTIONS: usize = 52;
/// By how much of a joint's way the middle of a piece may differ from its cubic's; below it pieces are not halved any more.
const CUBIC: f64 = 1e-4;
/// Halvings of a stretch for its limits.
const CUTTINGS: usize = 12;
/// How far from a cubic's turning point, in parts of the piece, the joint's own is sought.
const AROUND: f64 = 0.05;
