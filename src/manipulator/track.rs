//! All assembly modes at once through a change of the design, of the inputs, or of both: which becomes which, which meet.
//!
//! The change runs straight: points, directions (the shorter way round) and inputs move together. Each stretch of it is halved until every mode
//! has one partner at its end, of the same sign of `det A` and several times nearer than any other mode of that sign. Two modes that meet differ in that sign,
//! so they are told apart as long as there are two of them; where a stretch of [`SHORTEST`] does not help, modes without a partner have ended there.
//!
//! **Proof**: each list of modes is complete ([`Triad::real_modes`](crate::linkage::Triad::real_modes)), and which belongs to which is measured. Where only the inputs change,
//! [`Manipulator::carry`] takes the mode asked for along [`Manipulator::follow`], whose way is proved.
//!
//! What it cannot do: tell which of three modes is which while they meet in a cusp; those count as ended.

use std::f64::consts::PI;

use nalgebra::Vector2;

use super::describe::{JointKind, Leg, Manipulator, Placement};
use super::follow::{PathError, PathEventKind, PathSettings, blend};
use super::frame::{principal_angle, unit};
use super::lock::{LockError, LockedGroup};
use crate::linkage::Pose;

/// The shortest stretch, as a share of the change: modes move as the root of their distance from a meeting, so that partners are then within some 1e-4.
const SHORTEST: f64 = 1e-9;
/// A partner is sure at this share of the distance to the next mode of its sign, or less.
const SURE: f64 = 0.25;
/// A partner farther away than this, in characteristic lengths or radians, asks for a shorter stretch even if there is no other.
const FAR: f64 = 0.1;
/// Lists of modes that one change may take, some milliseconds; what is left then counts as ended.
const MOST_LISTS: usize = 4000;

/// Where a mode ends on the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeEnd {
    /// The mode, from 0, in [`Tracked::from`].
    pub mode: usize,
    /// The share of the change, 0 to 1.
    pub at: f64,
    /// Its last pose.
    pub pose: Pose,
}

/// All modes through a change.
#[derive(Clone, Debug, PartialEq)]
pub struct Tracked {
    /// The modes before it, sorted by `phi`, `x`, `y`; each pose once.
    pub from: Vec<Pose>,
    /// The modes after it.
    pub to: Vec<Pose>,
    /// For each mode before the number it has after, from 0; `None` where it ended.
    pub becomes: Vec<Option<usize>>,
    /// The modes that ended, in order along the change.
    pub ends: Vec<ModeEnd>,
}

/// One mode through a change.
#[derive(Clone, Debug, PartialEq)]
pub struct Carried {
    /// Its last pose: after the whole change, or where it ended.
    pub pose: Pose,
    /// Where it ended, as a share of the change, and how; `None` if it arrived.
    pub end: Option<(f64, PathEventKind)>,
}

/// A mode, and the sign of its `det A`.
#[derive(Clone, Copy)]
struct Held {
    pose: Pose,
    positive: bool,
}

impl Manipulator {
    /// Follows every assembly mode through a change of the design and of the inputs.
    ///
    /// **Shape**: inputs as in [`Manipulator::forward`]; `changed` has the same joints. Limits are not looked at. **Accuracy**: see the module's head; ends to 1e-9 of the
    /// change. **Cost**: some microseconds for a small change, a tenth of a millisecond for one on which modes meet.
    ///
    /// # Errors
    /// Inputs of the wrong count or not finite, manipulators that three actuators do not determine; designs with other joints.
    ///
    /// ```
    /// use assur::{Leg, Manipulator, nalgebra::Vector2};
    /// let robot = Manipulator::new("", vec![
    ///     Leg::rpr([0.0, 0.0], [0.0, 0.0]), Leg::rpr([15.91, 0.0], [17.045, 0.0]), Leg::rpr([0.0, 10.0], [13.2389, 16.0929]),
    /// ])?;
    /// let mut moved = robot.clone();
    /// moved.legs[2].base.at += Vector2::new(0.2, 0.1);
    /// let inputs = [14.98, 15.38, 12.0];
    /// let tracked = robot.track(&inputs, &moved, &inputs)?;
    /// assert_eq!(tracked.becomes, (0..6).map(Some).collect::<Vec<_>>());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn track(&self, inputs: &[f64], changed: &Self, changed_inputs: &[f64]) -> Result<Tracked, LockError> {
        let [begin, end] = [self, changed].map(Self::without_limits);
        if changed_inputs.len() != inputs.len() || !same_joints(self, changed) {
            let expected = begin.actuated_joints().count();
            return Err(LockError::WrongCount { expected, found: changed_inputs.len() });
        }
        let (first, last) = (begin.held_modes(inputs)?, end.held_modes(changed_inputs)?);
        let scale = self.characteristic_length();
        // Where each mode of the first list is in the present one.
        let mut place: Vec<Option<usize>> = (0..first.len()).map(Some).collect();
        let mut ends = Vec::new();
        let (mut now, mut t, mut stretch, mut lists) = (first.clone(), 0.0_f64, 1.0_f64, 0);
        while t < 1.0 {
            let next_t = if stretch >= 1.0 - t { 1.0 } else { t + stretch };
            let next = if next_t == 1.0 {
                last.clone()
            } else {
                // Between two sound ends a design may pass one that is none, such as two parallel sliders.
                let between = begin.between(&end, next_t);
                between.held_modes(&blend(inputs, changed_inputs, next_t)).unwrap_or_default()
            };
            lists += 1;
            let partners = partners(&now, &next, scale);
            let all = now.len() == next.len() && partners.iter().all(Option::is_some);
            if !all && stretch > SHORTEST && lists < MOST_LISTS {
                stretch = (next_t - t) / 2.0;
                continue;
            }
            for (mode, place) in place.iter_mut().enumerate() {
                let Some(here) = *place else { continue };
                *place = partners[here];
                if place.is_none() {
                    ends.push(ModeEnd { mode, at: t, pose: now[here].pose });
                }
            }
            (now, t) = (next, next_t);
            stretch *= 2.0;
        }
        let poses = |modes: &[Held]| modes.iter().map(|mode| mode.pose).collect();
        Ok(Tracked { from: poses(&first), to: poses(&last), becomes: place, ends })
    }

    /// Takes the assembly mode nearest to `from` through a change of the design and of the inputs.
    ///
    /// Where only the inputs change its way is proved, as [`Manipulator::follow`] does; else it is measured, as in [`Manipulator::track`].
    ///
    /// # Errors
    /// No mode near `from`; and as both.
    ///
    /// ```
    /// use assur::Manipulator;
    /// let (robot, inputs) = Manipulator::of_family("3-RPR")?;
    /// let pose = robot.forward(&inputs)?.modes[0].mode.pose;
    /// let shorter = inputs.map(|q| 0.5 * q);
    /// let carried = robot.carry(&inputs, &pose, &robot, &shorter)?;
    /// assert!(carried.end.is_some_and(|(at, _)| at < 1.0)); // the struts become too short to reach
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn carry(
        &self,
        inputs: &[f64],
        from: &Pose,
        changed: &Self,
        changed_inputs: &[f64],
    ) -> Result<Carried, PathError> {
        let settings = PathSettings::default();
        if self.without_limits() == changed.without_limits() {
            let rows = [inputs.to_vec(), changed_inputs.to_vec()];
            let path = self.without_limits().follow(&rows, Some(*from), &settings)?;
            let end = path.events.last().filter(|_| !path.complete);
            return Ok(match (end, path.rows.last()) {
                (Some(event), _) => Carried { pose: event.pose, end: Some((event.at - 1.0, event.kind)) },
                (None, Some(row)) => Carried { pose: row.pose, end: None },
                (None, None) => Carried { pose: *from, end: Some((0.0, PathEventKind::Branch)) },
            });
        }
        let error = |error| PathError::Inputs { row: 1, error };
        let tracked = self.track(inputs, changed, changed_inputs).map_err(error)?;
        let scale = self.characteristic_length();
        let nearest = tracked.nearest(from, scale).ok_or(PathError::NoMode)?;
        if pose_distance(&tracked.from[nearest], from, scale) > settings.start_tolerance {
            return Err(PathError::Start { from: *from, tolerance: settings.start_tolerance });
        }
        let ended = tracked.ends.iter().find(|end| end.mode == nearest);
        Ok(match (tracked.becomes[nearest], ended) {
            (Some(arrived), _) => Carried { pose: tracked.to[arrived], end: None },
            (None, Some(end)) => Carried { pose: end.pose, end: Some((end.at, PathEventKind::Meeting)) },
            (None, None) => Carried { pose: *from, end: Some((0.0, PathEventKind::Branch)) },
        })
    }

    /// The same inputs, each angle within half a turn of that in `near`: so that a change from there takes the shorter way round.
    ///
    /// ```
    /// use assur::Manipulator;
    /// let (robot, _) = Manipulator::of_family("3-RRR")?;
    /// let inputs = robot.inputs_beside(&[-3.1, 0.0, 0.5], &[3.1, 0.1, 0.5]);
    /// assert!((inputs[0] - 3.18).abs() < 0.01);
    /// # Ok::<(), assur::FamilyError>(())
    /// ```
    pub fn inputs_beside(&self, inputs: &[f64], near: &[f64]) -> Vec<f64> {
        let pairs = self.actuated_joints().zip(inputs.iter().zip(near));
        pairs
            .map(|((leg, joint), (&q, &near))| match self.legs[leg].joints[joint] {
                JointKind::Revolute if (q - near).abs() > PI => near + principal_angle(q - near),
                _ => q,
            })
            .collect()
    }

    /// The same inputs, each angle by whole turns where [`Manipulator::actuator_range`] has it: as a slider or a plane of actuators shows it.
    ///
    /// ```
    /// use assur::Manipulator;
    /// let (robot, inputs) = Manipulator::of_family("3-RRP")?;
    /// assert!(inputs[1] > std::f64::consts::PI);
    /// assert!((robot.inputs_in_range(&inputs)[1] - (inputs[1] - std::f64::consts::TAU)).abs() < 1e-12);
    /// # Ok::<(), assur::FamilyError>(())
    /// ```
    pub fn inputs_in_range(&self, inputs: &[f64]) -> Vec<f64> {
        let ranges = (0..).map_while(|number| self.actuator_range(number));
        let middles: Vec<f64> = ranges.map(|[low, high]| 0.5 * (low + high)).collect();
        self.inputs_beside(inputs, &middles)
    }

    /// The number, from 0, of the pose in a list that is nearest to another one, in characteristic lengths and radians.
    ///
    /// ```
    /// use assur::{Manipulator, linkage::Pose};
    /// let (robot, inputs) = Manipulator::of_family("3-RPR")?;
    /// let poses: Vec<Pose> = robot.forward(&inputs)?.modes.iter().map(|mode| mode.mode.pose).collect();
    /// let beside = Pose::new(poses[1].x + 0.01, poses[1].y, poses[1].phi);
    /// assert_eq!(robot.nearest_pose(&poses, &beside), Some(1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn nearest_pose(&self, poses: &[Pose], pose: &Pose) -> Option<usize> {
        nearest_pose(poses, pose, self.characteristic_length())
    }

    fn without_limits(&self) -> Self {
        let mut free = self.clone();
        free.legs.iter_mut().for_each(|leg| leg.limits = [None; 3]);
        free
    }

    fn held_modes(&self, inputs: &[f64]) -> Result<Vec<Held>, LockError> {
        let held = |pose, det_a: f64| Held { pose, positive: det_a > 0.0 };
        Ok(match self.lock(inputs)? {
            LockedGroup::Triad(triad) => triad.real_modes().modes().iter().map(|m| held(m.pose, m.det_a)).collect(),
            LockedGroup::Pinned(pinned) => pinned.assemble().modes.iter().map(|m| held(m.pose, m.det_a)).collect(),
            LockedGroup::Placed(pose) => vec![held(pose, 1.0)],
        })
    }

    /// The design at a share of the way to another with the same joints.
    fn between(&self, end: &Self, share: f64) -> Self {
        let mut out = self.clone();
        for (leg, (from, to)) in out.legs.iter_mut().zip(self.legs.iter().zip(&end.legs)) {
            leg.base = placement_between(&from.base, &to.base, share);
            leg.platform = placement_between(&from.platform, &to.platform, share);
            leg.links = [0, 1].map(|link| placement_between(&from.links[link], &to.links[link], share));
        }
        out
    }
}

impl Tracked {
    /// The number, from 0, of the mode that is nearest to a pose before the change; lengths in units of `scale`.
    pub fn nearest(&self, pose: &Pose, scale: f64) -> Option<usize> {
        nearest_pose(&self.from, pose, scale)
    }
}

fn nearest_pose(poses: &[Pose], pose: &Pose, scale: f64) -> Option<usize> {
    let distance = |&number: &usize| pose_distance(&poses[number], pose, scale);
    (0..poses.len()).min_by(|p, q| distance(p).total_cmp(&distance(q)))
}

fn same_joints(one: &Manipulator, other: &Manipulator) -> bool {
    let joints = |leg: &Leg| (leg.joints, leg.actuated);
    one.legs.iter().map(joints).eq(other.legs.iter().map(joints))
}

fn placement_between(from: &Placement, to: &Placement, share: f64) -> Placement {
    if from == to {
        return *from;
    }
    let (start, turn) = (from.angle(), principal_angle(to.angle() - from.angle()));
    let direction =
        if turn == 0.0 { unit(from.direction) } else { Placement::turned(0.0, 0.0, start + share * turn).direction };
    Placement { at: from.at + (to.at - from.at) * share, direction }
}

/// For each mode of one list the one of the next that it certainly becomes.
fn partners(now: &[Held], next: &[Held], scale: f64) -> Vec<Option<usize>> {
    let apart = |p: &Held, q: &Held| pose_distance(&p.pose, &q.pose, scale);
    // To the nearest other mode of the same sign.
    let room = |list: &[Held], k: usize| {
        let others = list.iter().enumerate().filter(|(other, mode)| *other != k && mode.positive == list[k].positive);
        others.map(|(_, mode)| apart(mode, &list[k])).fold(f64::INFINITY, f64::min)
    };
    let nearest = |mode: &Held, list: &[Held]| {
        let same = list.iter().enumerate().filter(|(_, other)| other.positive == mode.positive);
        let nearest = same.map(|(k, other)| (k, apart(mode, other))).min_by(|p, q| p.1.total_cmp(&q.1));
        nearest.filter(|(_, distance)| *distance <= FAR)
    };
    let partner = |k: usize| {
        let (found, distance) = nearest(&now[k], next)?;
        let mutual = nearest(&next[found], now).is_some_and(|(back, _)| back == k);
        let sure = distance <= SURE * room(now, k).min(room(next, found));
        (mutual && sure).then_some(found)
    };
    (0..now.len()).map(partner).collect()
}

/// In units of the scale, or of the distance of modes that run far away, and radians.
fn pose_distance(p: &Pose, q: &Pose, scale: f64) -> f64 {
    let [a, b] = [p, q].map(|pose| Vector2::new(pose.x, pose.y));
    let turned = principal_angle(p.phi - q.phi).abs();
    ((a - b).amax() / scale.max(a.amax())).max(turned)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 3-RPR with six modes, of the README.
    fn robot() -> Manipulator {
        let legs = vec![
            Leg::rpr([0.0, 0.0], [0.0, 0.0]),
            Leg::rpr([15.91, 0.0], [17.045, 0.0]),
            Leg::rpr([0.0, 10.0], [13.2389, 16.0929]),
        ];
        Manipulator::new("", legs).expect("a sound model")
    }

    const INPUTS: [f64; 3] = [14.98, 15.38, 12.0];

    #[test]
    fn tracking_agrees_with_the_proved_way() {
        let robot = robot();
        let mut arrived = 0;
        for k in 0..40 {
            let turn = f64::from(k) * 0.157;
            let other = [INPUTS[0] + 2.0 * turn.cos(), INPUTS[1] + 2.0 * turn.sin(), INPUTS[2] + (2.0 * turn).sin()];
            let tracked = robot.track(&INPUTS, &robot, &other).expect("a sound question");
            for (mode, pose) in tracked.from.iter().enumerate() {
                let proved = robot.carry(&INPUTS, pose, &robot, &other).expect("a sound question");
                assert_eq!(proved.end.is_none(), tracked.becomes[mode].is_some(), "mode {mode} towards {other:?}");
                match tracked.becomes[mode] {
                    Some(number) => {
                        arrived += 1;
                        assert!(pose_distance(&tracked.to[number], &proved.pose, 10.0) < 1e-9);
                    }
                    None => {
                        let end = tracked.ends.iter().find(|end| end.mode == mode).expect("is listed");
                        assert!((end.at - proved.end.expect("asked above").0).abs() < 1e-6);
                    }
                }
            }
        }
        assert!(arrived > 80, "{arrived}");
    }

    #[test]
    fn a_change_there_and_back_along_small_steps_is_one_change() {
        let robot = robot();
        let mut moved = robot.clone();
        moved.legs[2].base.at += Vector2::new(1.5, -2.0);
        moved.legs[1].platform.at += Vector2::new(0.5, 0.5);
        let whole = robot.track(&INPUTS, &moved, &INPUTS).expect("a sound question");
        let mut numbers: Vec<Option<usize>> = (0..6).map(Some).collect();
        for k in 0..50 {
            let [here, there] = [k, k + 1].map(|k| robot.between(&moved, f64::from(k) / 50.0));
            let step = here.track(&INPUTS, &there, &INPUTS).expect("a sound question");
            numbers.iter_mut().for_each(|number| *number = number.and_then(|number| step.becomes[number]));
        }
        assert_eq!(numbers, whole.becomes);
        assert!(whole.becomes.contains(&None) || whole.to.len() == 6);
    }

    #[test]
    fn designs_with_other_joints_are_refused() {
        let (other, inputs) = Manipulator::of_family("3-RRR").expect("a family");
        assert!(robot().track(&INPUTS, &other, &inputs).is_err());
    }
}
