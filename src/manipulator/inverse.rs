//! Inverse kinematics: from a pose to every working mode.
//!
//! Each leg is asked on its own ([`super::joints`]): it reaches the pose in two ways, one, or misses it by a length. A working mode
//! takes one way from each leg and is named by their signs, leg 1 first; three legs of two ways make eight. What the pose does not determine is
//! named: two ways that have merged, a pivot that turns freely, two parallel sliders that share a travel.

use std::fmt;

use thiserror::Error;

use super::describe::{Leg, Manipulator};
use super::forward::Violation;
use super::joints::{self, Indeterminate, Joints, Reach, branch_count, reach, sign};
use super::lock::within;
use crate::linkage::Pose;

/// A pose with all its joints: one way to reach it.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkingMode {
    /// The sign of each leg, leg 1 first: `+-+`.
    pub signs: String,
    /// Joint values of each leg, base first; lengths and radians in (-pi, pi].
    pub joints: Vec<[f64; 3]>,
    /// Joints outside their ranges, actuated ones too.
    pub violations: Vec<Violation>,
}

/// A leg that does not reach the pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unreachable {
    /// Leg, from 1.
    pub leg: usize,
    /// By how much it misses, a length.
    pub miss: f64,
}

/// What is special about the way back from a pose. Legs are counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InverseSpecial {
    /// The two ways of the leg have merged into one, written +: a singularity of type 1.
    MergedBranches {
        /// Leg, from 1.
        leg: usize,
    },
    /// The leg's last pivot lies on its base pivot (RPR at zero stroke, RRR with equal links folded): joint 1 may have any value; one is given.
    FreePivot {
        /// Leg, from 1.
        leg: usize,
    },
    /// Two sliders of the leg are parallel and share their travel: any split will do; the outer one is given as 0.
    SharedTravel {
        /// Leg, from 1.
        leg: usize,
    },
}

impl InverseSpecial {
    /// The name that reports use.
    pub fn name(self) -> &'static str {
        match self {
            Self::MergedBranches { .. } => "merged_branches",
            Self::FreePivot { .. } => "free_pivot",
            Self::SharedTravel { .. } => "shared_travel",
        }
    }

    /// The leg it is about, from 1.
    pub fn leg(self) -> usize {
        match self {
            Self::MergedBranches { leg } | Self::FreePivot { leg } | Self::SharedTravel { leg } => leg,
        }
    }
}

impl fmt::Display for InverseSpecial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::MergedBranches { leg } => write!(f, "leg {leg}: its two ways to reach the pose have merged"),
            Self::FreePivot { leg } => {
                write!(f, "leg {leg}: its last pivot lies on its base pivot, so joint 1 may have any value")
            }
            Self::SharedTravel { leg } => write!(f, "leg {leg}: two parallel sliders share their travel in any way"),
        }
    }
}

/// Every working mode for a pose.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkingModes {
    /// The pose asked for.
    pub pose: Pose,
    /// The modes, `+++` first, in the order of `+` before `-` from leg 1 on. Empty where a leg does not reach.
    pub modes: Vec<WorkingMode>,
    /// Legs that do not reach the pose.
    pub unreachable: Vec<Unreachable>,
    /// What is special.
    pub special: Vec<InverseSpecial>,
}

impl WorkingModes {
    /// The mode with these signs.
    pub fn mode(&self, signs: &str) -> Option<&WorkingMode> {
        self.modes.iter().find(|mode| mode.signs == signs)
    }
}

/// Why a question about a pose or a motion cannot be asked or answered. Legs are counted from 1.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum KinematicsError {
    /// A number is NaN or infinite.
    #[error("{what}: {value} must be finite")]
    NotFinite {
        /// Which number.
        what: &'static str,
        /// The value found.
        value: f64,
    },
    /// A mode's name has another length or other letters.
    #[error("mode \"{signs}\": must be {expected} signs + or -, one a leg (+ for a leg with two sliders)")]
    Signs {
        /// The text found.
        signs: String,
        /// Number of legs.
        expected: usize,
    },
    /// Not as many numbers as there are actuators or coordinates.
    #[error("{what}: {found} given, must be {expected}")]
    WrongCount {
        /// Which numbers.
        what: &'static str,
        /// How many there must be.
        expected: usize,
        /// How many were given.
        found: usize,
    },
    /// A leg does not reach the pose, so nothing can be said of its motion there.
    #[error("leg {leg}: does not reach the pose, it misses by {miss:.6e}")]
    Unreachable {
        /// Leg, from 1.
        leg: usize,
        /// By how much, a length.
        miss: f64,
    },
    /// Several working modes reach the pose and none was named.
    #[error("mode: none named, and {} of the {} that reach the pose {}: {}", .candidates.len(), .all,
        if *.within_limits { "are within the limits" } else { "could be meant" }, .candidates.join(", "))]
    WhichMode {
        /// The names of those that could be meant.
        candidates: Vec<String>,
        /// How many reach the pose.
        all: usize,
        /// Whether the candidates are within the limits and the others are not; else nothing tells them apart.
        within_limits: bool,
    },
    /// A length that must be positive is not.
    #[error("{what}: {value} must be > 0 and finite")]
    NotPositive {
        /// Which length.
        what: &'static str,
        /// The value found.
        value: f64,
    },
}

/// Why a working mode was taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModeChoice {
    /// It was named.
    Named,
    /// It is the only one that reaches the pose.
    Only,
    /// It is the only one within the limits.
    WithinLimits,
}

impl ModeChoice {
    /// The words that reports use: `named`, `the only one`, `the only one within the limits`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Named => "named",
            Self::Only => "the only one",
            Self::WithinLimits => "the only one within the limits",
        }
    }
}

impl Manipulator {
    /// The working mode meant in a pose: the one named, or else the one that alone reaches the pose or alone is within the limits.
    ///
    /// # Errors
    /// As [`Manipulator::working_mode`]; several modes that could be meant, with their names.
    ///
    /// ```
    /// use assur::{Manipulator, ModeChoice, Pose};
    /// let (mut robot, _) = Manipulator::of_family("3-RPR")?;
    /// let pose = Pose::new(5.5, 4.0, 0.3);
    /// let error = robot.chosen_mode(&pose, None).unwrap_err().to_string();
    /// assert!(error.starts_with("mode: none named, and 8 of the 8 that reach the pose could be meant: +++, ++-"));
    /// robot.legs.iter_mut().for_each(|leg| leg.limits[1] = Some([0.0, 50.0]));
    /// let (mode, choice) = robot.chosen_mode(&pose, None)?;
    /// assert_eq!((mode.signs.as_str(), choice), ("+++", ModeChoice::WithinLimits));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn chosen_mode(&self, pose: &Pose, signs: Option<&str>) -> Result<(WorkingMode, ModeChoice), KinematicsError> {
        if let Some(signs) = signs {
            return Ok((self.working_mode(pose, signs)?, ModeChoice::Named));
        }
        let answer = self.inverse(pose)?;
        if let Some(&Unreachable { leg, miss }) = answer.unreachable.first() {
            return Err(KinematicsError::Unreachable { leg, miss });
        }
        let inside: Vec<&WorkingMode> = answer.modes.iter().filter(|mode| mode.violations.is_empty()).collect();
        match (&answer.modes[..], &inside[..]) {
            ([only], _) => Ok((only.clone(), ModeChoice::Only)),
            (_, [only]) => Ok(((*only).clone(), ModeChoice::WithinLimits)),
            (all, inside) => {
                let within_limits = !inside.is_empty() && inside.len() < all.len();
                let names = |modes: &[&WorkingMode]| modes.iter().map(|mode| mode.signs.clone()).collect();
                let every: Vec<&WorkingMode> = all.iter().collect();
                let candidates = if within_limits { names(inside) } else { names(&every) };
                Err(KinematicsError::WhichMode { candidates, all: all.len(), within_limits })
            }
        }
    }

    /// Every working mode for a pose, with all joint values.
    ///
    /// **Shape**: up to two ways a leg, so up to eight modes, `+++` first. The sign of a leg is + for the larger value of the
    /// prismatic coordinate in which its two ways differ (RPR: joint 2, PRR: joint 1, RRP: joint 3), and for RRR where link 1 × link 2 > 0; legs
    /// with two sliders have one way, written +. A merged pair is one way, written +, and is named in `special`.
    /// **Units and frame**: the platform frame in the base frame; lengths and radians. **Accuracy**: closed forms, a few roundings. **Cost**: a microsecond a leg.
    ///
    /// # Errors
    /// A pose that is not finite.
    ///
    /// ```
    /// use assur::{Manipulator, Pose};
    /// let (robot, _) = Manipulator::of_family("3-PRR")?;
    /// let answer = robot.inverse(&Pose::new(5.5, 4.0, 0.3))?;
    /// assert_eq!(answer.modes.len(), 8);
    /// assert_eq!(answer.modes[5].signs, "-+-");
    /// let far = robot.inverse(&Pose::new(500.0, 4.0, 0.3))?;
    /// assert!(far.modes.is_empty() && far.unreachable[0].miss > 100.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn inverse(&self, pose: &Pose) -> Result<WorkingModes, KinematicsError> {
        finite_pose(pose)?;
        let mut answer = WorkingModes { pose: *pose, modes: Vec::new(), unreachable: Vec::new(), special: Vec::new() };
        let mut combinations: Vec<Vec<(char, Joints)>> = vec![Vec::new()];
        for (number, leg) in (1..).zip(&self.legs) {
            let ways = match reach(leg, pose) {
                Reach::Ways(ways) => named(leg, ways),
                Reach::Misses(miss) => {
                    answer.unreachable.push(Unreachable { leg: number, miss });
                    continue;
                }
            };
            answer.special.extend(specials(leg, number, &ways));
            combinations = combinations
                .iter()
                .flat_map(|begun| ways.iter().map(move |way| begun.iter().copied().chain([*way]).collect()))
                .collect();
        }
        if answer.unreachable.is_empty() {
            answer.modes = combinations.into_iter().map(|ways| self.working_mode_of(ways)).collect();
        }
        Ok(answer)
    }

    /// The joints with which a working mode reaches a pose.
    ///
    /// Where the two ways of a leg have merged, either sign names the one that is left.
    ///
    /// # Errors
    /// A pose that is not finite, a name of another length or with other letters, a leg that does not reach; a leg with one way only called `-`.
    ///
    /// ```
    /// use assur::{Manipulator, Pose};
    /// let (robot, _) = Manipulator::of_family("3-PRR")?;
    /// let mode = robot.working_mode(&Pose::new(5.5, 4.0, 0.3), "+-+")?;
    /// assert_eq!(mode.signs, "+-+");
    /// let error = robot.working_mode(&Pose::new(5.5, 4.0, 0.3), "+-").unwrap_err();
    /// assert_eq!(error.to_string(), "mode \"+-\": must be 3 signs + or -, one a leg (+ for a leg with two sliders)");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn working_mode(&self, pose: &Pose, signs: &str) -> Result<WorkingMode, KinematicsError> {
        finite_pose(pose)?;
        self.check_signs(signs)?;
        let mut chosen = Vec::new();
        for ((number, leg), wanted) in (1..).zip(&self.legs).zip(signs.chars()) {
            let ways = match reach(leg, pose) {
                Reach::Ways(ways) => named(leg, ways),
                Reach::Misses(miss) => return Err(KinematicsError::Unreachable { leg: number, miss }),
            };
            let way = ways.iter().find(|way| way.0 == wanted).or(ways.first());
            chosen.push(*way.expect("a leg that reaches does so in one way at least"));
        }
        Ok(self.working_mode_of(chosen))
    }

    /// Whether a mode has one sign a leg, `-` only where the leg has two ways.
    ///
    /// # Errors
    /// Another length, other letters, a `-` for a leg that reaches in one way only.
    pub fn check_signs(&self, signs: &str) -> Result<(), KinematicsError> {
        let sound = signs.chars().count() == self.legs.len()
            && signs.chars().zip(&self.legs).all(|(sign, leg)| sign == '+' || sign == '-' && branch_count(leg) == 2);
        let error = || KinematicsError::Signs { signs: signs.to_owned(), expected: self.legs.len() };
        sound.then_some(()).ok_or_else(error)
    }

    /// The actuated ones of all joint values, leg by leg, base first: what [`Manipulator::forward`] takes.
    ///
    /// ```
    /// let (robot, inputs) = assur::Manipulator::of_family("3-RPR")?;
    /// let pose = robot.forward(&inputs)?.modes[0].mode.pose;
    /// let back = robot.inverse(&pose)?;
    /// let found = robot.inputs_of(&back.modes[0].joints);
    /// assert!(found.iter().zip(inputs).all(|(a, b)| (a - b).abs() < 1e-12));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn inputs_of(&self, joints: &[[f64; 3]]) -> Vec<f64> {
        self.actuated_joints().map(|(leg, joint)| joints[leg][joint]).collect()
    }

    fn working_mode_of(&self, ways: Vec<(char, Joints)>) -> WorkingMode {
        let (signs, joints): (String, Vec<Joints>) = ways.into_iter().unzip();
        WorkingMode { violations: self.all_violations(&joints), signs, joints }
    }

    /// Joints outside their ranges, actuated ones too.
    pub(super) fn all_violations(&self, joints: &[Joints]) -> Vec<Violation> {
        let mut out = Vec::new();
        for (number, (leg, values)) in (1..).zip(self.legs.iter().zip(joints)) {
            for (joint, &value) in values.iter().enumerate() {
                if let Some(limit) = leg.limits[joint].filter(|&l| !within(leg.joints[joint], value, l)) {
                    out.push(Violation { leg: number, joint: joint + 1, value, limit });
                }
            }
        }
        out
    }
}

/// The ways of a leg with their signs; two that cannot be told apart are one.
fn named(leg: &Leg, ways: Vec<Joints>) -> Vec<(char, Joints)> {
    let mut out: Vec<(char, Joints)> = Vec::new();
    for way in ways {
        let sign = sign(leg, &way);
        if out.iter().all(|(known, _)| *known != sign) {
            out.push((sign, way));
        }
    }
    out
}

fn specials(leg: &Leg, number: usize, ways: &[(char, Joints)]) -> Vec<InverseSpecial> {
    let open = ways.iter().find_map(|(_, joints)| joints::indeterminate(leg, joints));
    let open = open.map(|open| match open {
        Indeterminate::BasePivot => InverseSpecial::FreePivot { leg: number },
        Indeterminate::Sliders => InverseSpecial::SharedTravel { leg: number },
    });
    let merged = (ways.len() < branch_count(leg)).then_some(InverseSpecial::MergedBranches { leg: number });
    merged.into_iter().chain(open).collect()
}

pub(super) fn finite_pose(pose: &Pose) -> Result<(), KinematicsError> {
    let parts = [("pose x", pose.x), ("pose y", pose.y), ("pose phi", pose.phi)];
    match parts.into_iter().find(|(_, value)| !value.is_finite()) {
        Some((what, value)) => Err(KinematicsError::NotFinite { what, value }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::manipulator::Placement;

    fn robot(leg: Leg) -> Manipulator {
        Manipulator::new("", vec![leg; 3]).expect("is sound")
    }

    #[test]
    fn merged_and_undetermined_legs_are_named() {
        let at = |x, y| Pose::new(x, y, 0.0);
        let merged = InverseSpecial::MergedBranches { leg: 1 };
        let free = InverseSpecial::FreePivot { leg: 1 };
        let shared = InverseSpecial::SharedTravel { leg: 1 };
        let special = |leg: Leg, pose| robot(leg).inverse(&pose).expect("is finite").special[..].to_vec();
        let of_leg_1 = |leg: Leg, pose| special(leg, pose).into_iter().filter(|s| s.leg() == 1).collect::<Vec<_>>();
        assert_eq!(of_leg_1(Leg::rpr([0.0; 2], [0.0; 2]), at(0.0, 0.0)), [merged, free]);
        assert_eq!(of_leg_1(Leg::rpr([0.0; 2], [0.0; 2]), at(1.0, 0.0)), []);
        let equal = Leg::rrr([0.0; 2], 1.0, 1.0, [0.0; 2]);
        assert_eq!(of_leg_1(equal.clone(), at(0.0, 0.0)), [merged, free]);
        assert_eq!(of_leg_1(equal, at(2.0, 0.0)), [merged]);
        let folded = robot(Leg::rrr([0.0; 2], 3.0, 1.0, [0.0; 2])).inverse(&at(0.0, 2.0)).expect("is finite");
        assert_eq!((folded.modes.len(), folded.modes[0].signs.as_str()), (1, "+++"));
        assert_eq!(of_leg_1(Leg::prr([0.0; 2], 0.0, 1.0, [0.0; 2]), at(5.0, 1.0)), [merged]);
        let sliders: Leg = "_P_PR".parse().expect("a leg");
        assert_eq!(of_leg_1(sliders.clone(), at(5.0, 0.0)), [shared]);
        let missed = robot(sliders).inverse(&at(5.0, 2.0)).expect("is finite");
        assert_eq!(missed.unreachable[0], Unreachable { leg: 1, miss: 2.0 });
    }

    #[test]
    fn limits_of_every_joint_are_watched() {
        let limited = Leg { limits: [Some([-0.1, 0.1]), Some([1.0, 2.0]), None], ..Leg::rpr([0.0; 2], [0.0; 2]) };
        let answer = robot(Leg { platform: Placement::default(), ..limited }).inverse(&Pose::new(0.0, 3.0, 0.0));
        let mode = answer.expect("is finite").modes[0].clone();
        let found: Vec<(usize, usize)> = mode.violations.iter().map(|v| (v.leg, v.joint)).collect();
        assert_eq!(found, [(1, 1), (1, 2), (2, 1), (2, 2), (3, 1), (3, 2)]);
        assert_eq!(mode.violations[1].value, 3.0);
    }

    #[test]
    fn what_cannot_be_asked_is_refused() {
        let (robot, _) = Manipulator::of_family("3-RPR").expect("a family");
        let pose = Pose::new(1.0, f64::NAN, 0.0);
        assert_eq!(robot.inverse(&pose).unwrap_err().to_string(), "pose y: NaN must be finite");
        for signs in ["", "++", "++++", "+x+", "+ -"] {
            assert!(robot.check_signs(signs).is_err(), "{signs:?}");
        }
        let (rigid, _) = Manipulator::of_family("R_P_R,R_P_R,_P_PR").expect("a family");
        assert!(rigid.check_signs("--+").is_ok() && rigid.check_signs("---").is_err());
    }
}
