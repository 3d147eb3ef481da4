//! The platform taken by hand: where it gets to, through inverse kinematics, when it is pulled from one pose towards another.
//!
//! The working mode stays; each step is allowed where every leg reaches in it and no joint leaves its range. The platform walks straight towards
//! the target; where it is blocked it turns aside, and where no direction is free it steps shorter and stops at last: so it slides along its limits.
//! It passes through singularities of type 2, as a hand may take it there, and says where.

use nalgebra::{Rotation2, Vector2};

use super::describe::Manipulator;
use super::frame::principal_angle;
use super::inverse::{KinematicsError, WorkingMode};
use crate::linkage::Pose;

/// The longest step, in characteristic lengths and radians: gaps in the reach are wider, or are jumped over.
const STEP: f64 = 0.02;
/// A step shorter than this, in the same units, is not worth taking: a hundredth of a pixel.
const SHORTEST: f64 = 1e-5;
/// Steps that one pull may take.
const MOST_STEPS: usize = 600;
/// Directions tried where the straight one is blocked, in degrees to both sides.
const ASIDE: [f64; 4] = [20.0, 40.0, 60.0, 80.0];
/// Halvings towards a singularity that a step crosses.
const HALVINGS: usize = 40;

/// Where a platform that is pulled gets to.
#[derive(Clone, Debug, PartialEq)]
pub struct Guided {
    /// The pose.
    pub pose: Pose,
    /// Its working mode, with all joints.
    pub mode: WorkingMode,
    /// The actuator values there, as [`Manipulator::forward`] takes them.
    pub inputs: Vec<f64>,
    /// Whether it got to the target.
    pub arrived: bool,
    /// Poses on the way in which two assembly modes meet: `det A` changes its sign.
    pub crossed: Vec<Pose>,
}

impl Manipulator {
    /// Pulls the platform from one pose towards another in a working mode, within reach and limits.
    ///
    /// **Units and frame**: poses of the platform frame in the base frame. A joint that is outside its range at the start may stay so. **Accuracy**: stops within
    /// 1e-5 characteristic lengths of what blocks it. **Cost**: two microseconds a step of 1/50 of the characteristic length.
    ///
    /// # Errors
    /// Poses that are not finite, a mode that is none, a start that is out of reach.
    ///
    /// ```
    /// use assur::{Leg, Manipulator, linkage::Pose};
    /// let legs = [([0.0, 0.0], [0.0, 0.0]), ([16.0, 0.0], [17.0, 0.0]), ([0.0, 10.0], [13.0, 16.0])];
    /// let mut robot = Manipulator::new("", legs.map(|(a, b)| Leg::rpr(a, b)).to_vec())?;
    /// robot.legs[0].limits[1] = Some([5.0, 12.0]);
    /// let start = Pose::new(6.0, 0.0, 0.3);
    /// let guided = robot.guide(&start, "+++", &Pose::new(40.0, 0.0, 0.3))?;
    /// // The first strut stops at its greatest length.
    /// assert!(!guided.arrived && (guided.inputs[0] - 12.0).abs() < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn guide(&self, from: &Pose, signs: &str, to: &Pose) -> Result<Guided, KinematicsError> {
        super::inverse::finite_pose(to)?;
        let scale = self.characteristic_length();
        let start = self.working_mode(from, signs)?;
        let begun: Vec<(usize, usize)> = start.violations.iter().map(|v| (v.leg, v.joint)).collect();
        let allowed = |pose: &Pose| {
            let mode = self.working_mode(pose, signs).ok()?;
            let kept = mode.violations.iter().all(|v| begun.contains(&(v.leg, v.joint)));
            kept.then_some(mode)
        };
        let (mut pose, mut mode, mut step) = (*from, start, STEP);
        let mut crossed = Vec::new();
        for _ in 0..MOST_STEPS {
            let way = Vector2::new(to.x - pose.x, to.y - pose.y) / scale;
            let turn = principal_angle(to.phi - pose.phi);
            let left = way.norm().max(turn.abs());
            if left == 0.0 || step < SHORTEST {
                break;
            }
            let share = (step / left).min(1.0);
            let straight = if share == 1.0 { *to } else { stepped(&pose, way * (share * scale), turn * share) };
            let aside = ASIDE.iter().flat_map(|&angle| [angle, -angle]).map(|angle| {
                let angle = angle.to_radians();
                // The part of the step that still goes towards the target.
                let way = Rotation2::new(angle) * way * (share * scale * angle.cos());
                stepped(&pose, way, turn * share)
            });
            // A platform that only turns has no other way to do so.
            let tried = std::iter::once(straight).chain(aside.filter(|_| way.norm() > SHORTEST));
            match tried.into_iter().find_map(|pose| Some((pose, allowed(&pose)?))) {
                Some((next, found)) => {
                    crossed.extend(self.crossing(&pose, &next, signs));
                    (pose, mode) = (next, found);
                    step = (2.0 * step).min(STEP);
                }
                None => step /= 2.0,
            }
        }
        let inputs = self.inputs_of(&mode.joints);
        Ok(Guided { pose, mode, inputs, arrived: pose == *to, crossed })
    }

    /// The singular pose between two, if `det A` changes its sign.
    fn crossing(&self, from: &Pose, to: &Pose, signs: &str) -> Option<Pose> {
        let positive = |pose: &Pose| {
            let mode = self.working_mode(pose, signs).ok()?;
            Some(self.velocity_at(pose, &mode.joints).pose_matrix.determinant() > 0.0)
        };
        let (begin, end) = (positive(from)?, positive(to)?);
        if begin == end {
            return None;
        }
        let (mut low, mut high) = (*from, *to);
        for _ in 0..HALVINGS {
            let way = Vector2::new(high.x - low.x, high.y - low.y) / 2.0;
            let middle = stepped(&low, way, principal_angle(high.phi - low.phi) / 2.0);
            if positive(&middle)? == begin { low = middle } else { high = middle }
        }
        Some(low)
    }
}

fn stepped(pose: &Pose, way: Vector2<f64>, turn: f64) -> Pose {
    Pose::new(pose.x + way.x, pose.y + way.y, principal_angle(pose.phi + turn))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_platform_slides_along_its_limits_and_never_leaves_them() {
        let (mut robot, inputs) = Manipulator::of_family("3-RRR").expect("a family");
        robot.legs.iter_mut().for_each(|leg| leg.limits[0] = Some([-1.2, 2.4]));
        let limits_hold = |mode: &WorkingMode| mode.violations.is_empty();
        let start = robot.without_violation(&inputs);
        let mut stopped = 0;
        for k in 0..24 {
            let turn = f64::from(k) * 0.2618;
            let far = Pose::new(start.0.x + 30.0 * turn.cos(), start.0.y + 30.0 * turn.sin(), start.0.phi + 0.3);
            let guided = robot.guide(&start.0, &start.1, &far).expect("a sound question");
            assert!(limits_hold(&guided.mode));
            let back = robot.forward(&guided.inputs).expect("within limits");
            let near = |pose: &Pose| (pose.x - guided.pose.x).abs() + (pose.y - guided.pose.y).abs() < 1e-6;
            assert!(back.modes.iter().any(|mode| near(&mode.mode.pose)), "forward gives the pose back");
            stopped += usize::from(!guided.arrived);
        }
        assert_eq!(stopped, 24);
    }

    impl Manipulator {
        /// A pose within all limits, with its mode.
        fn without_violation(&self, inputs: &[f64]) -> (Pose, String) {
            let mut poses = (0..4000).map(|k| {
                let [x, y, phi] = [k % 20, k / 20 % 20, k / 400].map(f64::from);
                Pose::new(x, y, 0.3 * phi - 1.0 + 1e-3 * inputs[0])
            });
            let found = poses.find_map(|pose| {
                let answer = self.inverse(&pose).ok()?;
                let mode = answer.modes.iter().find(|mode| mode.violations.is_empty())?;
                Some((pose, mode.signs.clone()))
            });
            found.expect("this robot has a workspace")
        }
    }

    #[test]
    fn singular_poses_on_the_way_are_named() {
        let legs = [([0.0, 0.0], [-1.0, 0.0]), ([10.0, 0.0], [1.0, 0.0]), ([5.0, 9.0], [0.0, 1.5])];
        let robot = Manipulator::new("", legs.map(|(a, b)| super::super::Leg::rpr(a, b)).to_vec()).expect("is sound");
        // Half a turn about one place passes an orientation in which the three struts meet.
        let guided = robot.guide(&Pose::new(5.0, 3.0, 0.0), "+++", &Pose::new(5.0, 3.0, 3.1)).expect("a question");
        assert!(guided.arrived && !guided.crossed.is_empty());
        for pose in &guided.crossed {
            let mode = robot.working_mode(pose, "+++").expect("is reached");
            assert!(robot.velocity_at(pose, &mode.joints).pose_matrix.determinant().abs() < 1e-6);
        }
    }
}
