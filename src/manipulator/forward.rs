//! Forward kinematics: from actuator values to every assembly mode.
//!
//! The actuators are held ([`Manipulator::lock`]), the group that is left is assembled, and in every pose the joints of every leg
//! are read off. A leg without actuator takes no part in holding the platform; it then reaches each pose in up to two ways, or
//! not at all, and each way is a mode of its own.

use super::describe::{Leg, Manipulator};

use super::joints::{Joints, Reach, branch_count, reach, read_off, sign};
use super::lock::{LockError, LockedGroup, LockedLeg, within};
use crate::certify::Verdict;
use crate::linkage::{Assemblies, AssemblyMode, Status, Triad};
use crate::solve::Account;

/// A joint value outside its range. Legs and joints are counted from 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Violation {
    /// Leg, from 1.
    pub leg: usize,
    /// Joint of the leg, from 1.
    pub joint: usize,
    /// The joint's value, length or radians.
    pub value: f64,
    /// The range it leaves.
    pub limit: [f64; 2],
}

/// An assembly mode of a manipulator: a pose with all its joints.
#[derive(Clone, Debug, PartialEq)]
pub struct ManipulatorMode {
    /// The pose, its multiplicity, residual and det A.
    pub mode: AssemblyMode,
    /// Joint values of each leg, base first; lengths and radians in (-pi, pi].
    pub joints: Vec<[f64; 3]>,
    /// Working-mode signs, leg 1 first: `+-+`.
    pub signs: String,
    /// Passive joints outside their ranges.
    pub violations: Vec<Violation>,
}

/// Every assembly mode of a manipulator for given inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct AssemblyModes {
    /// The inputs, one per actuated joint, leg by leg, base first.
    pub inputs: Vec<f64>,
    /// The group that holding the actuators left.
    pub locked: LockedGroup,
    /// The modes, sorted by phi, x, y and, in one pose, by signs.
    pub modes: Vec<ManipulatorMode>,
    /// What is known of the group: status, account, complex solutions, rejections, self-motions.
    pub group: Assemblies,
}

impl AssemblyModes {
    /// The triad that was left, where it was one.
    pub fn triad(&self) -> Option<&Triad> {
        match &self.locked {
            LockedGroup::Triad(triad) => Some(triad),
            _ => None,
        }
    }
}

impl Manipulator {
    /// Every assembly mode for these actuator values.
    ///
    /// **Shape**: one input per actuated joint, leg by leg, base first; modes sorted by `phi`, `x`, `y`. **Units and frame**: lengths for
    /// sliders, radians for revolute joints; poses of the platform frame in the base frame. **Proof**: complete, in the sense of
    /// [`Triad::assemble`]: the account says where each of the eliminant's roots went. **Cost**: about a millisecond.
    ///
    /// # Errors
    /// Inputs of the wrong count, not finite or outside their limits; manipulators that three actuators do not determine.
    ///
    /// ```
    /// use assur::{Leg, Manipulator};
    /// let (sin, cos) = 0.8822f64.sin_cos();
    /// let robot = Manipulator::new("3-RPR", vec![
    ///     Leg::rpr([0.0, 0.0], [0.0, 0.0]),
    ///     Leg::rpr([15.91, 0.0], [17.045, 0.0]),
    ///     Leg::rpr([0.0, 10.0], [20.839 * cos, 20.839 * sin]),
    /// ])?;
    /// let answer = robot.forward(&[14.98, 15.38, 12.0])?;
    /// assert_eq!(answer.modes.len(), 6);
    /// assert!(answer.modes.iter().all(|m| m.mode.residual < 1e-15 && m.signs == "+++"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn forward(&self, inputs: &[f64]) -> Result<AssemblyModes, LockError> {
        let locked = self.lock(inputs)?;
        let group = match &locked {
            LockedGroup::Triad(triad) => triad.assemble(),
            LockedGroup::Pinned(pinned) => pinned.assemble(),
            LockedGroup::Placed(pose) => placed(*pose),
        };
        self.with_joints(inputs, locked, group)
    }

    /// Every assembly mode for these actuator values, each with a box that holds it and no other, and a certificate for the whole.
    ///
    /// As [`Manipulator::forward`], with the proof of [`Triad::certify`]. It is a theorem about the locked triad, whose numbers are `f64`s: sines and
    /// cosines of inputs and of the model's angles were rounded once, on locking, and are data from there on. A slider's
    /// direction can be given exactly, as a vector in place of an angle.
    ///
    /// # Errors
    /// As [`Manipulator::forward`].
    ///
    /// ```
    /// use assur::{Leg, Manipulator, Verdict};
    /// let robot = Manipulator::new("3-RPR", vec![
    ///     Leg::rpr([0.0, 0.0], [0.0, 0.0]),
    ///     Leg::rpr([15.91, 0.0], [17.045, 0.0]),
    ///     Leg::rpr([0.0, 10.0], [13.2389, 16.0929]),
    /// ])?;
    /// let answer = robot.certify(&[14.98, 15.38, 12.0])?;
    /// assert!(answer.modes.iter().all(|m| m.mode.proof == Verdict::Proven));
    /// assert_eq!(answer.group.certificate.unwrap().to_string(), "6 of degree 6: 6 real proved, 0 non-real proved, complete");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn certify(&self, inputs: &[f64]) -> Result<AssemblyModes, LockError> {
        let locked = self.lock(inputs)?;
        let group = match &locked {
            LockedGroup::Triad(triad) => triad.certify(),
            LockedGroup::Pinned(pinned) => pinned.certify(),
            LockedGroup::Placed(pose) => {
                let mut group = placed(*pose);
                group.certify_given(*pose);
                group
            }
        };
        self.with_joints(inputs, locked, group)
    }

    /// The modes of a group with all joints read off.
    fn with_joints(
        &self,
        inputs: &[f64],
        locked: LockedGroup,
        mut group: Assemblies,
    ) -> Result<AssemblyModes, LockError> {
        let legs = self.locked_legs(inputs)?;
        let held = self.held(inputs);
        let mut modes = Vec::new();
        // Each unactuated leg with two branches doubles what there is to account for.
        let free: Vec<&Leg> =
            self.legs.iter().zip(&legs).filter(|(_, l)| l.passive.len() == 3).map(|(leg, _)| leg).collect();
        let factor: usize = free.iter().map(|leg| branch_count(leg)).product();
        group.account = scaled(group.account, factor);
        if let Some(certificate) = &mut group.certificate {
            certificate.free_ways = factor;
        }
        for mode in &group.modes {
            let ways = self.joint_values(&legs, &held, mode);
            let found: usize = ways.iter().map(|way| way.1).sum();
            // Where a free leg does not reach a pose, its two ways are complex.
            let unreached = mode.multiplicity * (factor - found);
            group.account.real -= unreached;
            group.account.complex += unreached;
            modes.extend(ways.into_iter().map(|(joints, merged)| {
                let mode = AssemblyMode { multiplicity: mode.multiplicity * merged, ..mode.clone() };
                let signs = self.legs.iter().zip(&joints).map(|(leg, joints)| sign(leg, joints)).collect();
                let violations = self.violations(&joints);
                ManipulatorMode { mode, joints, signs, violations }
            }));
        }
        if factor > 1 {
            group.complex.iter_mut().for_each(|mode| mode.multiplicity *= factor);
            group.complex_out_of_range *= factor;
            group.rejections.iter_mut().for_each(|rejection| rejection.multiplicity *= factor);
        }
        assert!(group.account.adds_up(), "every way of a free leg is booked: {:?}", group.account);
        Ok(AssemblyModes { inputs: inputs.to_vec(), locked, modes, group })
    }

    /// The inputs by leg and joint; joints without input are 0.
    fn held(&self, inputs: &[f64]) -> Vec<Joints> {
        let mut held = vec![[0.0; 3]; self.legs.len()];
        for ((leg, joint), &q) in self.actuated_joints().zip(inputs) {
            held[leg][joint] = q;
        }
        held
    }

    /// All combinations of joint values in one pose, each with the number of branches merged in it.
    fn joint_values(&self, legs: &[LockedLeg], held: &[Joints], mode: &AssemblyMode) -> Vec<(Vec<Joints>, usize)> {
        let mut combinations = vec![(Vec::new(), 1)];
        for ((leg, locked), held) in self.legs.iter().zip(legs).zip(held) {
            let ways: Vec<(Joints, usize)> = match read_off(leg, locked, held, &mode.pose) {
                Some(joints) => vec![(joints, 1)],
                None => match reach(leg, &mode.pose) {
                    Reach::Ways(ways) => {
                        let merged = branch_count(leg) / ways.len().max(1);
                        ways.into_iter().map(|way| (way, merged)).collect()
                    }
                    Reach::Misses(_) => Vec::new(),
                },
            };
            combinations = combinations
                .iter()
                .flat_map(|(joints, merged): &(Vec<Joints>, usize)| {
                    ways.iter().map(move |(way, m)| {
                        let mut joints = joints.clone();
                        joints.push(*way);
                        (joints, merged * m)
                    })
                })
                .collect();
        }
        combinations
    }

    /// Passive joints outside their ranges.
    fn violations(&self, joints: &[Joints]) -> Vec<Violation> {
        let mut out = Vec::new();
        for (number, (leg, values)) in (1..).zip(self.legs.iter().zip(joints)) {
            for joint in (0..3).filter(|&j| !leg.actuated[j]) {
                if let Some(limit) = leg.limits[joint].filter(|&l| !within(leg.joints[joint], values[joint], l)) {
                    out.push(Violation { leg: number, joint: joint + 1, value: values[joint], limit });
                }
            }
        }
        out
    }
}

/// The account with everything counted `factor` times.
fn scaled(account: Account, factor: usize) -> Account {
    Account {
        degree: account.degree * factor,
        real: account.real * factor,
        complex: account.complex * factor,
        at_infinity: account.at_infinity * factor,
        rejected: account.rejected * factor,
        self_motion: account.self_motion * factor,
        undecided: account.undecided * factor,
    }
}

/// The answer where one leg places the platform.
fn placed(pose: crate::linkage::Pose) -> Assemblies {
    let mode =
        AssemblyMode { pose, multiplicity: 1, residual: 0.0, det_a: 1.0, proof: Verdict::NotAsked, pose_box: None };
    Assemblies {
        status: Status::Complete,
        limit: None,
        modes: vec![mode],
        complex: Vec::new(),
        complex_out_of_range: 0,
        account: Account { degree: 1, real: 1, ..Account::default() },
        rejections: Vec::new(),
        self_motions: Vec::new(),
        special: Vec::new(),
        near: Vec::new(),
        certificate: None,
        polynomial: None,
        size: 0.0,
        origin: nalgebra::Vector2::zeros(),
    }
}
