//! What is left of a manipulator when its actuators are held: which dyad each leg becomes, which group they make, how many
//! assembly modes that group can have.
//!
//! Read from the leg types alone, before any input is known.
//! Source of the degrees: K of T(phi) for each of the twenty triads; see `derivations/` for the table worked out.

use std::fmt;

use super::describe::{JointKind, Leg, Manipulator};
use crate::linkage::triad_degree;

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
}

impl Remark {
    /// A name for reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::OrientationTwice => "orientation_twice",
            Self::ParallelSliders { .. } => "parallel_sliders",
            Self::CoincidentPivots { .. } => "coincident_pivots",
        }
    }
}

impl Remark {
    /// The leg it is about, from 1; `None` where it is about all.
    pub fn leg(self) -> Option<usize> {
        match self {
            Self::OrientationTwice => None,
            Self::ParallelSliders { leg } | Self::CoincidentPivots { leg } => Some(leg),
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

    /// How many assembly modes there can be at most, for any inputs, self-motions apart; `None` where the group is no triad.
    pub fn degree_bound(&self) -> Option<usize> {
        triad_degree(&self.group()?.split('-').collect::<Vec<_>>())
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
        remarks
    }
}
