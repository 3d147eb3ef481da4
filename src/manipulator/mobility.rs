//! What is left of a manipulator when its actuators are held: which dyad each leg becomes, which group they make, how many
//! assembly modes that group can have.
//!
//! Read from the leg types alone, before any input is known.
//! Source of the degrees: K of T(phi) for each of the twenty triads; see `derivations/` for the table worked out.

use std::fmt;

use super::describe::{JointKind, Leg, Manipulator};
use super::joints::branch_count;
use super::lock::LockedGroup;
use crate::linkage::{Special, triad_degree};

/// What a description says before any input is known. Legs are counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remark {
    /// Two legs or more leave PP dyads, each of which fixes the orientation: no inputs determine the pose.
    OrientationTwice,
    /// Two adjacent sliders of the leg are parallel.
    ParallelSliders {
        /// Leg, from 1.
        leg: usize,
    },
    /// Two adjacent revolute joints of the leg coincide.
    CoincidentPivots {
        /// Leg, from 1.
        leg: usize,
    },
    /// The locked group has this shape for every input.
    Always(Special),
    /// A leg without actuator reaches each pose in several ways, and every count of modes is that many times as large.
    FreeLeg {
        /// Leg, from 1.
        leg: usize,
        /// In how many ways.
        ways: usize,
    },
}

impl Remark {
    /// A name for reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::OrientationTwice => "orientation_twice",
            Self::ParallelSliders { .. } => "parallel_sliders",
            Self::CoincidentPivots { .. } => "coincident_pivots",
            Self::Always(special) => special.name(),
            Self::FreeLeg { .. } => "free_leg",
        }
    }
}

impl Remark {
    /// The leg it is about, from 1; `None` where it is about all.
    pub fn leg(self) -> Option<usize> {
        match self {
            Self::OrientationTwice | Self::Always(_) => None,
            Self::ParallelSliders { leg } | Self::CoincidentPivots { leg } | Self::FreeLeg { leg, .. } => Some(leg),
        }
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OrientationTwice => {
                f.write_str("two or more locked legs leave PP, which fix the orientation twice and nothing else")
            }
            Self::ParallelSliders { leg } => write!(f, "leg {leg}: two adjacent sliders are parallel"),
            Self::CoincidentPivots { leg } => write!(f, "leg {leg}: two adjacent revolute joints coincide"),
            Self::Always(special) => write!(f, "{} for every input", special.name().replace('_', " ")),
            Self::FreeLeg { leg, ways } => write!(
                f,
                "leg {leg} has no actuator and reaches each pose in {ways} ways: each is a mode, and all counts are {ways} times those of the group that holds \
                 the platform"
            ),
        }
    }
}

impl Manipulator {
    /// The group that is left when the actuators are held, one dyad a leg: `RR-RR-RR`; `None` where a leg does not leave a dyad.
    ///
    /// ```
    /// use assur::Manipulator;
    /// let (robot, _) = Manipulator::of_family("3-_R_PR").unwrap();
    /// assert_eq!(robot.group().as_deref(), Some("PR-PR-PR"));
    /// assert_eq!(robot.degree_bound(), Some(2));
    /// ```
    pub fn group(&self) -> Option<String> {
        let dyads: Vec<String> = self.legs.iter().map(Leg::passive_joints).collect();
        (dyads.len() == 3 && dyads.iter().all(|dyad| dyad.len() == 2)).then(|| dyads.join("-"))
    }

    /// How many assembly modes there can be at most, for any inputs, self-motions apart: the degree of the account of [`Manipulator::forward`].
    ///
    /// Where two actuators share a leg: 2 for a pinned platform (1 on PP), the triad's with a slider that keeps its orientation; 1 where one leg places it. A leg without actuator
    /// doubles the count if it reaches poses in two ways. `None` where nothing is determined.
    ///
    /// ```
    /// use assur::{Leg, Manipulator};
    /// let two_on_one = vec!["_R__R_R".parse::<Leg>()?, "_R_RR".parse()?];
    /// assert_eq!(Manipulator::new("", two_on_one)?.degree_bound(), Some(2));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn degree_bound(&self) -> Option<usize> {
        let passive: Vec<String> = self.legs.iter().map(Leg::passive_joints).collect();
        let mut holding: Vec<&str> = passive.iter().map(String::as_str).filter(|joints| joints.len() < 3).collect();
        holding.sort_by_key(|joints| joints.len());
        let bound = match holding[..] {
            [""] => 1,
            ["R", "PP"] => 1,
            ["R", _] => 2,
            // A slider of the leg that keeps the orientation is the line of a PR leg.
            ["P", leg] => triad_degree(&["PP", "PR", leg])?,
            [_, _, _] => triad_degree(&holding)?,
            _ => return None,
        };
        Some(bound * self.free_legs().map(|(_, ways)| ways).product::<usize>())
    }

    /// Legs without actuator, from 1, with the number of ways in which each reaches a pose.
    fn free_legs(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let free = (1..).zip(&self.legs).filter(|(_, leg)| leg.actuated == [false; 3]);
        free.map(|(number, leg)| (number, branch_count(leg)))
    }

    /// The shapes that the locked group has for every input: those that three unrelated choices of inputs share, each decided exactly.
    fn lasting_shapes(&self) -> Vec<Special> {
        let mut free = self.clone();
        free.legs.iter_mut().for_each(|leg| leg.limits = [None; 3]);
        let length = self.characteristic_length();
        let shapes = |sample: usize| {
            let value = |(k, (leg, joint)): (usize, (usize, usize))| {
                // Angles and lengths with nothing special about them.
                let number = 0.6180 + 0.7311 * (sample * 3 + k) as f64 + 0.0137 * (sample * sample) as f64;
                if self.legs[leg].joints[joint] == JointKind::Prismatic { length * number } else { number }
            };
            let inputs: Vec<f64> = self.actuated_joints().enumerate().map(value).collect();
            match free.lock(&inputs) {
                Ok(LockedGroup::Triad(triad)) => triad.special_shapes(),
                _ => Vec::new(),
            }
        };
        let [second, third] = [shapes(1), shapes(2)];
        shapes(0).into_iter().filter(|shape| second.contains(shape) && third.contains(shape)).collect()
    }

    /// What deserves a word before any input is known: legs and groups that lose a freedom or a constraint.
    pub fn remarks(&self) -> Vec<Remark> {
        let mut remarks = Vec::new();
        if self.legs.iter().filter(|leg| leg.passive_joints() == "PP").count() > 1 {
            remarks.push(Remark::OrientationTwice);
        }
        for (number, leg) in (1..).zip(&self.legs) {
            for (pair, link) in leg.joints.windows(2).zip(&leg.links) {
                match pair {
                    [JointKind::Prismatic, JointKind::Prismatic] if link.direction.y == 0.0 => {
                        remarks.push(Remark::ParallelSliders { leg: number });
                    }
                    [JointKind::Revolute, JointKind::Revolute] if link.at.norm() == 0.0 => {
                        remarks.push(Remark::CoincidentPivots { leg: number });
                    }
                    _ => {}
                }
            }
        }
        remarks.extend(self.lasting_shapes().into_iter().map(Remark::Always));
        remarks.extend(self.free_legs().filter(|(_, ways)| *ways > 1).map(|(leg, ways)| Remark::FreeLeg { leg, ways }));
        remarks
    }
}
