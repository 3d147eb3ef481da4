//! From a pose to the joints of a leg: every way it can reach, with the sign that names each.
//!
//! | passive | solutions | the sign + |
//! |---|---|---|
//! | RRR | 2 | link 1 × link 2 > 0 |
//! | RPR | 2 | the larger value of joint 2 |
//! | PRR | 2 | the larger value of joint 1 |
//! | RRP | 2 | the larger value of joint 3 |
//! | PPR, PRP, RPP | 1 | always |
//!
//! A leg with held joints has its remaining ones read off the pose; a pair that has merged is written + as well.

use nalgebra::Vector2;

use super::describe::JointKind::{Prismatic as P, Revolute as R};
use super::describe::{JointKind, Leg, Placement};
use super::frame::{back, principal_angle, times, unit};
use super::lock::LockedLeg;
use crate::linkage::Pose;

/// A branch whose distance from merging is below this, relative to the leg's lengths, is written +: a working mode cannot be
/// told from its twin there.
pub(super) const MERGED: f64 = 1e-12;

/// A leg's joint values, base first; lengths and radians.
pub(super) type Joints = [f64; 3];

/// Joint values of a locked leg at a pose that it reaches: the held ones as given, the passive ones read off.
///
/// `None` for a leg without held joints, which may have several (see [`reach`]).
pub(super) fn read_off(leg: &Leg, locked: &LockedLeg, held: &Joints, pose: &Pose) -> Option<Joints> {
    // near · J · middle · J' = pose · far
    let wanted = locked.near.inverse().then(&Placement::of_pose(pose)).then(&locked.far);
    let (w, omega) = (wanted.at, wanted.angle());
    let mut joints = *held;
    match (&locked.passive[..], &locked.between[..]) {
        ([], _) => {}
        (&[(j, R)], _) => joints[j] = omega,
        (&[(j, P)], _) => joints[j] = w.x,
        (&[(i, first), (j, second)], [middle]) => {
            let (t, delta) = (middle.at, middle.angle());
            [joints[i], joints[j]] = match (first, second) {
                (R, R) => {
                    // At length zero any angle does; 0 is as good as another.
                    let turn = if t == Vector2::zeros() { 0.0 } else { angle_between(t, w) };
                    [turn, omega - turn - delta]
                }
                (P, R) => [w.x - t.x, omega - delta],
                (R, P) => {
                    let turn = omega - delta;
                    let local = times(Vector2::new(turn.cos(), -turn.sin()), w) - t;
                    [turn, times(unit(back(middle.direction)), local).x]
                }
                (P, P) => {
                    let slide = unit(middle.direction);
                    let second = (w.y - t.y) / slide.y;
                    [w.x - t.x - second * slide.x, second]
                }
            };
        }
        _ => return None,
    }
    Some(principal(leg, joints))
}

/// The angle from `p` to `q`.
fn angle_between(p: Vector2<f64>, q: Vector2<f64>) -> f64 {
    let product = times(back(p), q);
    product.y.atan2(product.x)
}

/// Revolute values brought to (-pi, pi].
fn principal(leg: &Leg, joints: Joints) -> Joints {
    let mut out = joints;
    for (value, kind) in out.iter_mut().zip(leg.joints) {
        if kind == JointKind::Revolute {
            *value = principal_angle(*value);
        }
    }
    out
}

/// How many ways a leg with these joints reaches a general pose.
pub(super) fn branch_count(leg: &Leg) -> usize {
    let sliders = leg.joints.iter().filter(|&&kind| kind == JointKind::Prismatic).count();
    if sliders < 2 { 2 } else { 1 }
}

/// The quantity whose sign tells the two ways of a leg apart, over the largest value it can have; `None` where there is one way.
///
/// It vanishes where the two ways merge.
fn branch_measure(leg: &Leg, joints: &Joints) -> Option<f64> {
    let [first, second] = &leg.links;
    let elbow = || {
        let (sin, cos) = joints[1].sin_cos();
        times(unit(first.direction), Vector2::new(cos, sin))
    };
    let (value, scale) = match leg.joints {
        [R, R, R] => {
            let (a, b) = (first.at, times(elbow(), second.at));
            (a.x * b.y - a.y * b.x, a.norm() * b.norm())
        }
        [R, P, R] => {
            let offset = slider_offset(leg);
            (joints[1] + offset.x, (joints[1] + offset.x).hypot(offset.y))
        }
        // The slider is ahead where the link points back along it.
        [P, R, R] => (-times(elbow(), second.at).x, second.at.norm()),
        [R, R, P] => {
            let seen = times(back(times(elbow(), unit(second.direction))), first.at);
            (-seen.x, first.at.norm())
        }
        _ => return None,
    };
    Some(if scale > 0.0 { value / scale } else { 0.0 })
}

/// Both links of an RPR leg at zero stroke, seen from the slider.
fn slider_offset(leg: &Leg) -> Vector2<f64> {
    times(unit(back(leg.links[0].direction)), leg.links[0].at) + leg.links[1].at
}

/// The working-mode sign of a leg in these joint values; see the table above.
pub(super) fn sign(leg: &Leg, joints: &Joints) -> char {
    if branch_measure(leg, joints).is_some_and(|measure| measure < -MERGED) { '-' } else { '+' }
}

/// The ways a whole leg, all joints free, reaches a pose.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Reach {
    /// Joint values of each way: one, or two with the + one first; a merged pair is one.
    Ways(Vec<Joints>),
    /// The leg misses the pose by this length.
    Misses(f64),
}

/// Every way a leg with all joints free reaches a pose.
///
/// One joint value decides the rest: it is found here, and with that joint held the others are read off.
pub(super) fn reach(leg: &Leg, pose: &Pose) -> Reach {
    // base · J1 · L1 · J2 · L2 · J3 = pose · platform
    let wanted = leg.base.inverse().then(&Placement::of_pose(pose)).then(&leg.platform);
    let [first, second] = &leg.links;
    // A leg with two sliders has one revolute joint, which takes the whole rotation.
    let rotation = wanted.angle() - first.angle() - second.angle();
    let (joint, middle, half) = match leg.joints {
        [R, R, R] => {
            let rest = times(first.direction, second.at);
            let zero = first.at.y.atan2(first.at.x) - rest.y.atan2(rest.x);
            (1, zero, exterior_angle(first.at.norm(), second.at.norm(), wanted.at.norm()))
        }
        [R, P, R] => {
            let offset = slider_offset(leg);
            (1, -offset.x, other_leg(wanted.at.norm(), offset.y))
        }
        [P, R, R] => {
            let target = wanted.at - first.at;
            (0, target.x, other_leg(second.at.norm(), target.y))
        }
        [R, R, P] => {
            let seen = times(unit(back(wanted.direction)), wanted.at) - times(unit(back(second.direction)), second.at);
            (2, seen.x, other_leg(first.at.norm(), seen.y))
        }
        [R, P, P] => (0, rotation, Ok(0.0)),
        [P, R, P] => (1, rotation, Ok(0.0)),
        [P, P, _] => (2, rotation, Ok(0.0)),
    };
    match half {
        Err(miss) => Reach::Misses(miss),
        Ok(half) => {
            // A pair has merged at half 0, and at half a turn where the folded leg comes from both sides.
            let single = half == 0.0 || (leg.joints[joint] == R && half == std::f64::consts::PI);
            let values = if single { vec![middle + half] } else { vec![middle + half, middle - half] };
            let mut ways = Vec::new();
            for value in values {
                let mut held = [0.0; 3];
                held[joint] = value;
                let locked = LockedLeg::new(leg, &[(joint, value)]);
                match along_parallel_sliders(&locked, &held, pose) {
                    Some(Err(miss)) => return Reach::Misses(miss),
                    Some(Ok(joints)) => ways.push(principal(leg, joints)),
                    None => ways.extend(read_off(leg, &locked, &held, pose)),
                }
            }
            Reach::Ways(ways)
        }
    }
}

/// Where the two free sliders of a leg are parallel: joint values with the second one at zero, since any share of the travel does,
/// or by how much the leg misses the pose sideways. `None` where they are not parallel, or not two.
fn along_parallel_sliders(locked: &LockedLeg, held: &Joints, pose: &Pose) -> Option<Result<Joints, f64>> {
    let (&[(i, P), (j, P)], [middle]) = (&locked.passive[..], &locked.between[..]) else { return None };
    if unit(middle.direction).y.abs() > MERGED {
        return None;
    }
    let wanted = locked.near.inverse().then(&Placement::of_pose(pose)).then(&locked.far).at;
    let miss = (wanted.y - middle.at.y).abs();
    if miss > MERGED * (wanted.norm() + middle.at.norm()) {
        return Some(Err(miss));
    }
    let mut joints = *held;
    [joints[i], joints[j]] = [wanted.x - middle.at.x, 0.0];
    Some(Ok(joints))
}

/// Why the joints of a leg are not determined by the pose, each with its meaning for this leg type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Indeterminate {
    /// The target lies on the leg's base pivot, which turns freely.
    BasePivot,
    /// Two sliders share a travel.
    Sliders,
}

/// What the pose leaves open in a leg that reaches it in these joint values.
pub(super) fn indeterminate(leg: &Leg, joints: &Joints) -> Option<Indeterminate> {
    let frames = frames(leg, joints);
    let size = leg.links[0].at.norm() + leg.links[1].at.norm() + joints[1].abs();
    let on_base = (frames[2].at - frames[0].at).norm() <= MERGED * size || size == 0.0;
    let parallel = |a: &Placement, b: &Placement| {
        let (a, b) = (unit(a.direction), unit(b.direction));
        (a.x * b.y - a.y * b.x).abs() <= MERGED
    };
    match leg.joints {
        // A zero stroke beside an offset is no zero distance; two equal links folded together are one.
        [R, R, R] | [R, P, R] => on_base.then_some(Indeterminate::BasePivot),
        [P, P, _] => parallel(&frames[0], &frames[1]).then_some(Indeterminate::Sliders),
        [P, R, P] => parallel(&frames[0], &frames[2]).then_some(Indeterminate::Sliders),
        [R, P, P] => parallel(&frames[1], &frames[2]).then_some(Indeterminate::Sliders),
        _ => None,
    }
}

/// The frame before each joint, in the base frame.
pub(super) fn frames(leg: &Leg, joints: &Joints) -> [Placement; 3] {
    let second = leg.base.then(&Placement::joint(leg.joints[0], joints[0])).then(&leg.links[0]);
    let third = second.then(&Placement::joint(leg.joints[1], joints[1])).then(&leg.links[1]);
    [leg.base, second, third]
}

/// The angle between two links whose ends are `distance` apart, in [0, pi]; by how much they miss it otherwise.
fn exterior_angle(l1: f64, l2: f64, distance: f64) -> Result<f64, f64> {
    let (reach, gap) = (l1 + l2, (l1 - l2).abs());
    // tan²(angle/2) = ((l1+l2)² - d²) / (d² - (l1-l2)²), exact at both ends where the arc cosine loses half its digits.
    let square = |difference: f64, sum: f64| {
        let miss = -difference;
        if miss > MERGED * reach { Err(miss) } else { Ok((difference * sum).max(0.0).sqrt()) }
    };
    Ok(2.0 * square(reach - distance, reach + distance)?.atan2(square(distance - gap, distance + gap)?))
}

/// The other leg of a right triangle; by how much the hypotenuse falls short otherwise.
fn other_leg(hypotenuse: f64, leg: f64) -> Result<f64, f64> {
    let (h, l) = (hypotenuse.abs(), leg.abs());
    if l - h > MERGED * h { Err(l - h) } else { Ok(((h - l) * (h + l)).max(0.0).sqrt()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A leg of each chain with nothing special about it.
    fn chains() -> Vec<Leg> {
        ["RRR", "RPR", "PRR", "RRP", "PPR", "PRP", "RPP"]
            .iter()
            .map(|text| Leg {
                base: Placement::turned(0.3, -0.2, 0.4),
                links: [Placement::turned(1.1, 0.3, -0.7), Placement::turned(0.9, -0.4, 1.3)],
                platform: Placement::turned(-0.2, 0.5, 0.6),
                ..text.parse().expect("a chain")
            })
            .collect()
    }

    fn pose_of(leg: &Leg, joints: &Joints) -> Pose {
        LockedLeg::new(leg, &[(0, joints[0]), (1, joints[1]), (2, joints[2])]).placed()
    }

    #[test]
    fn every_chain_finds_its_planted_joints_again() {
        for leg in chains() {
            for k in 0..200 {
                let value = |n: f64| 2.5 * (n * (1.0 + f64::from(k))).sin();
                let planted = principal(&leg, [value(1.0), value(1.7), value(2.3)]);
                let pose = pose_of(&leg, &planted);
                let Reach::Ways(ways) = reach(&leg, &pose) else { panic!("{} reaches its own pose", leg.name()) };
                assert_eq!(ways.len(), branch_count(&leg));
                let off = |way: &Joints| {
                    way.iter()
                        .zip(planted)
                        .map(|(a, b)| principal_angle(a - b).abs().min((a - b).abs()))
                        .fold(0.0, f64::max)
                };
                assert!(ways.iter().any(|way| off(way) < 1e-9), "{}: {planted:?} not in {ways:?}", leg.name());
                for (way, expected) in ways.iter().zip(['+', '-']) {
                    assert_eq!(sign(&leg, way), expected, "{} {way:?}", leg.name());
                    let back = pose_of(&leg, way);
                    let error = (back.x - pose.x).hypot(back.y - pose.y) + principal_angle(back.phi - pose.phi).abs();
                    assert!(error < 1e-9, "{}: {error:e}", leg.name());
                }
            }
        }
    }

    #[test]
    fn a_leg_that_falls_short_says_by_how_much() {
        let leg = Leg { platform: Placement::default(), ..Leg::rrr([0.0, 0.0], 1.0, 2.0, [0.0, 0.0]) };
        assert_eq!(reach(&leg, &Pose::new(3.5, 0.0, 0.0)), Reach::Misses(0.5));
        let Reach::Misses(short) = reach(&leg, &Pose::new(0.25, 0.0, 0.0)) else { panic!("too near") };
        assert_eq!(short, 0.75);
        let Reach::Ways(merged) = reach(&leg, &Pose::new(3.0, 0.0, 0.0)) else { panic!("stretched") };
        assert_eq!(merged.len(), 1);
        assert_eq!(sign(&leg, &merged[0]), '+');
    }
}
