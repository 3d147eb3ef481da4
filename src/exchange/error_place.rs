//! What an error is about, as data: faces whose errors are objects hand it on beside the message.
//!
//! Messages stay the authority; what a message does not name is not named here either.

use serde::Serialize;

use super::error::{FieldProblem, FileError};
use super::questions::LociError;
use crate::linkage::{CouplerError, GroupError, LinkageError, PinnedDyadError, TriadError, TrussError};
use crate::manipulator::{DescriptionError, DesignError, KinematicsError, LockError, LocusError, PathError};
use crate::spatial::{HanaCapabilityError, MultipteronError, SpatialError, TripodError};
use crate::workspace::WorkspaceError;

/// Where an error lies: file, row, leg, joint, field, and the value found there. Counted from 1.
///
/// ```
/// use assur::{Manipulator, exchange::{ErrorPlace, FoundValue}};
/// let (robot, _) = Manipulator::of_family("3-RPR")?;
/// let error = robot.forward(&[1.0, -f64::INFINITY, 1.0]).unwrap_err();
/// let place = ErrorPlace::from(&error);
/// assert_eq!((place.leg, place.joint, place.field.as_deref()), (Some(2), Some(2), Some("inputs")));
/// assert_eq!(place.value, Some(FoundValue::Number(-f64::INFINITY)));
/// # Ok::<(), assur::FamilyError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ErrorPlace {
    /// The file.
    pub file: Option<String>,
    /// Row of a path.
    pub row: Option<usize>,
    /// Leg; a coupler's side.
    pub leg: Option<usize>,
    /// Joint of the leg; of a group or linkage as its message counts it.
    pub joint: Option<usize>,
    /// Field or quantity: `links[0].at`, `inputs`, `pose`.
    pub field: Option<String>,
    /// What was found.
    pub value: Option<FoundValue>,
}

/// A value that an error found.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum FoundValue {
    /// A number.
    Number(f64),
    /// Two numbers, a range.
    Range([f64; 2]),
    /// How many there are.
    Count(usize),
    /// A text, or an excerpt of what a file holds there.
    Text(String),
}

impl ErrorPlace {
    fn field(field: impl Into<String>) -> Self {
        Self { field: Some(field.into()), ..Self::default() }
    }

    fn leg(leg: usize) -> Self {
        Self { leg: Some(leg), ..Self::default() }
    }

    fn and_field(self, field: impl Into<String>) -> Self {
        Self { field: Some(field.into()), ..self }
    }

    fn and_joint(self, joint: usize) -> Self {
        Self { joint: Some(joint), ..self }
    }

    fn and_value(self, value: FoundValue) -> Self {
        Self { value: Some(value), ..self }
    }

    /// `leg 2: links[0].at` taken apart.
    fn of_text(place: &str) -> Self {
        let legged = place.strip_prefix("leg ").and_then(|rest| {
            let (number, field) = rest.split_once(": ").unwrap_or((rest, ""));
            Some((number.parse().ok()?, field))
        });
        match legged {
            Some((leg, "")) => Self::leg(leg),
            Some((leg, field)) => Self::leg(leg).and_field(field),
            None => Self::field(place),
        }
    }
}

impl From<&FileError> for ErrorPlace {
    fn from(error: &FileError) -> Self {
        let (file, place) = match error {
            FileError::Unreadable { file, .. } | FileError::Syntax { file, .. } => (file, Self::default()),
            FileError::Field { file, place, problem } => (file, Self { value: problem.into(), ..Self::of_text(place) }),
            FileError::Description { file, error } => (file, error.into()),
            FileError::Linkage { file, error } => (file, error.into()),
            FileError::Coupler { file, error } => (file, error.into()),
            FileError::Truss { file, error } => (file, error.into()),
            FileError::Spatial { file, error } => (file, error.into()),
            FileError::Triad { file, error } => (file, error.into()),
            FileError::Multipteron { file, error } => (file, error.into()),
        };
        Self { file: Some(file.clone()), ..place }
    }
}

impl From<&FieldProblem> for Option<FoundValue> {
    fn from(problem: &FieldProblem) -> Self {
        match problem {
            FieldProblem::NotFinite { value } => Some(FoundValue::Number(*value)),
            FieldProblem::Kind { found, .. }
            | FieldProblem::Length { found, .. }
            | FieldProblem::UnknownText { found, .. }
            | FieldProblem::OtherKind { found, .. }
            | FieldProblem::WhichJoint { found, .. } => Some(FoundValue::Text(found.clone())),
            FieldProblem::Missing { .. }
            | FieldProblem::UnknownKey { .. }
            | FieldProblem::Both { .. }
            | FieldProblem::Twice
            | FieldProblem::OtherField { .. } => None,
        }
    }
}

impl From<&DescriptionError> for ErrorPlace {
    fn from(error: &DescriptionError) -> Self {
        use DescriptionError as E;
        match error {
            E::Joints { leg, error } => {
                Self::leg(*leg).and_field("joints").and_value(FoundValue::Text(error.text.clone()))
            }
            E::LegCount { found } => Self::field("leg").and_value(FoundValue::Count(*found)),
            E::ActuatedCount { found, .. } => Self::field("joints").and_value(FoundValue::Count(*found)),
            E::NotFinite { place, value } => Self::of_text(place).and_value(FoundValue::Number(*value)),
            E::NoDirection { leg, field } => {
                Self::leg(*leg).and_field(format!("{field}.direction")).and_value(FoundValue::Range([0.0; 2]))
            }
            E::EmptyRange { leg, joint, limit } => {
                Self::leg(*leg).and_joint(*joint).and_field("limits").and_value(FoundValue::Range(*limit))
            }
        }
    }
}

impl From<&LockError> for ErrorPlace {
    fn from(error: &LockError) -> Self {
        use LockError as E;
        match error {
            E::WrongCount { found, .. } => Self::field("inputs").and_value(FoundValue::Count(*found)),
            E::NotFinite { leg, joint, value } | E::OutOfRange { leg, joint, value, .. } => {
                Self::leg(*leg).and_joint(*joint).and_field("inputs").and_value(FoundValue::Number(*value))
            }
            E::OrientationTwice { first, .. } => Self::leg(*first).and_field("joints"),
            E::ParallelPassiveSliders { leg } => Self::leg(*leg).and_field("joints"),
            E::Triad(error) => error.into(),
            E::Pinned(error) => error.into(),
        }
    }
}

impl From<&TriadError> for ErrorPlace {
    fn from(error: &TriadError) -> Self {
        use TriadError as E;
        match error {
            E::NotFinite { leg, field, value } => {
                Self::leg(*leg).and_field(*field).and_value(FoundValue::Number(*value))
            }
            E::NegativeLength { leg, value } => {
                Self::leg(*leg).and_field("length").and_value(FoundValue::Number(*value))
            }
            E::NoDirection { leg, field } => Self::leg(*leg).and_field(*field).and_value(FoundValue::Range([0.0; 2])),
        }
    }
}

impl From<&PinnedDyadError> for ErrorPlace {
    fn from(error: &PinnedDyadError) -> Self {
        match error {
            PinnedDyadError::NotFinite { value } => Self::field("pin").and_value(FoundValue::Number(*value)),
            PinnedDyadError::Leg(error) => error.into(),
        }
    }
}

impl From<&KinematicsError> for ErrorPlace {
    fn from(error: &KinematicsError) -> Self {
        use KinematicsError as E;
        match error {
            E::NotFinite { what, value } | E::NotPositive { what, value } => {
                Self::field(*what).and_value(FoundValue::Number(*value))
            }
            E::Signs { signs, .. } => Self::field("mode").and_value(FoundValue::Text(signs.clone())),
            E::WrongCount { what, found, .. } => Self::field(*what).and_value(FoundValue::Count(*found)),
            E::Unreachable { leg, miss } => Self::leg(*leg).and_field("pose").and_value(FoundValue::Number(*miss)),
            E::WhichMode { .. } => Self::field("mode"),
        }
    }
}

impl From<&DesignError> for ErrorPlace {
    fn from(error: &DesignError) -> Self {
        match error {
            DesignError::Name { text } => Self::field(text),
            DesignError::NoLeg { key, leg, .. } | DesignError::WhichJoint { key, leg, .. } => {
                Self::leg(*leg).and_field(key)
            }
            DesignError::NoLimit { leg, joint } => Self::leg(*leg).and_joint(*joint).and_field("limits"),
        }
    }
}

impl From<&PathError> for ErrorPlace {
    fn from(error: &PathError) -> Self {
        match error {
            PathError::Empty => Self::field("path").and_value(FoundValue::Count(0)),
            PathError::Inputs { row, error } => Self { row: Some(*row), ..error.into() },
            PathError::Start { .. } => Self { row: Some(1), ..Self::field("from") },
            PathError::NoMode | PathError::SelfMotion { .. } => Self { row: Some(1), ..Self::field("inputs") },
        }
    }
}

impl From<&LocusError> for ErrorPlace {
    fn from(error: &LocusError) -> Self {
        match error {
            LocusError::NotFinite(value) => Self::field("phi").and_value(FoundValue::Number(*value)),
            LocusError::Actuators { leg, actuated } => {
                Self::leg(*leg).and_field("joints").and_value(FoundValue::Count(*actuated))
            }
        }
    }
}

impl From<&LociError> for ErrorPlace {
    fn from(error: &LociError) -> Self {
        match error {
            LociError::Locus(error) => error.into(),
            LociError::Mode(error) => error.into(),
        }
    }
}

impl From<&SpatialError> for ErrorPlace {
    fn from(error: &SpatialError) -> Self {
        use SpatialError as E;
        match error {
            E::NotFinite { what, value } | E::NotPositive { what, value } | E::OutOfRange { what, value } => {
                Self::field(what).and_value(FoundValue::Number(*value))
            }
            E::Reversed { what, low, high } => Self::field(what).and_value(FoundValue::Range([*low, *high])),
            E::WrongCount { what, found, .. } => Self::field(*what).and_value(FoundValue::Count(*found)),
            E::Unreachable { leg, miss } => Self::leg(*leg).and_field("pose").and_value(FoundValue::Number(*miss)),
            E::Signs { signs } => Self::field("mode").and_value(FoundValue::Text(signs.clone())),
            E::Singular { matrix, .. } => Self::field(format!("{matrix} matrix")),
        }
    }
}

impl From<&TripodError> for ErrorPlace {
    fn from(error: &TripodError) -> Self {
        use TripodError as E;
        match error {
            E::Number(error) => error.into(),
            E::NoDirection { leg, name } => Self::leg(*leg).and_field(*name),
            E::NotSquare { leg, cosine } => Self::leg(*leg).and_field("w").and_value(FoundValue::Number(*cosine)),
            E::OneRail { leg } => Self::leg(*leg).and_field("u"),
            E::ParallelAxes { leg } | E::ParallelRail { leg } => Self::leg(*leg).and_field("pose"),
            E::NoRotation { off } => Self::field("rotation").and_value(FoundValue::Number(*off)),
            E::OneMotor { leg, apart } => Self::leg(*leg).and_field("motors").and_value(FoundValue::Number(*apart)),
            E::Singular { .. } => Self::field("pose"),
            E::DegreesOfFreedom { found, .. } => Self::field("motors").and_value(FoundValue::Count(*found)),
        }
    }
}

impl From<&MultipteronError> for ErrorPlace {
    fn from(error: &MultipteronError) -> Self {
        use MultipteronError as E;
        match error {
            E::Number(error) => error.into(),
            E::Pentapteron => Self::field("family"),
            E::Unknown { name } => Self::field("family").and_value(FoundValue::Text(name.clone())),
            E::NoDirection { what } => Self::field(what),
            E::Coplanar => Self::field("directions"),
            E::Turn { .. } => Self::field("pose"),
            E::OnePoint { first, .. } => Self::leg(*first),
        }
    }
}

impl From<&HanaCapabilityError> for ErrorPlace {
    fn from(error: &HanaCapabilityError) -> Self {
        use HanaCapabilityError as E;
        match error {
            E::Question(error) => error.into(),
            E::OppositeSides { mode } => Self::field("mode").and_value(FoundValue::Text(mode.to_string())),
        }
    }
}

impl From<&WorkspaceError> for ErrorPlace {
    fn from(error: &WorkspaceError) -> Self {
        use WorkspaceError as E;
        match error {
            E::Description(error) => error.into(),
            E::LegNotCovered { leg, joints } => {
                Self::leg(*leg).and_field("joints").and_value(FoundValue::Text(joints.clone()))
            }
            E::NoLength { leg, link } => {
                Self::leg(*leg).and_field(format!("links[{link}]")).and_value(FoundValue::Number(0.0))
            }
            E::Modes { text } => Self::field("mode").and_value(FoundValue::Text(text.clone())),
            E::ModeCount { modes, .. } => Self::field("mode").and_value(FoundValue::Text(modes.clone())),
            E::NotFinite { what, value } => Self::field(*what).and_value(FoundValue::Number(*value)),
            E::NegativeWidth { value } => Self::field("phi").and_value(FoundValue::Number(*value)),
            E::Unbounded { leg, joint } => Self::leg(*leg).and_joint(*joint).and_field("limits"),
            E::PoseNotAllowed { leg } => Self::leg(*leg).and_field("assembly"),
            E::AssembliesUndecided { phi } => Self::field("assembly").and_value(FoundValue::Number(*phi)),
        }
    }
}

impl From<&TrussError> for ErrorPlace {
    fn from(error: &TrussError) -> Self {
        match error {
            TrussError::NotFinite { joint, value } => {
                Self::field("joint_xy").and_joint(*joint).and_value(FoundValue::Number(*value))
            }
            TrussError::GroundIsPoint { ground } => Self::field("ground").and_value(FoundValue::Count(*ground)),
            TrussError::NoLength => Self::field("joint_xy"),
            TrussError::Graph(_) => Self::field("edges"),
        }
    }
}

impl From<&GroupError> for ErrorPlace {
    fn from(error: &GroupError) -> Self {
        match error {
            GroupError::Truss(error) => error.into(),
            GroupError::Triad(error) => error.into(),
            GroupError::Dyad(error) => error.into(),
        }
    }
}

impl From<&LinkageError> for ErrorPlace {
    fn from(error: &LinkageError) -> Self {
        use LinkageError as E;
        match error {
            E::NoSuchLink { what, link, .. } => Self::field(what).and_value(FoundValue::Count(*link)),
            E::SelfJoint { joint, .. } | E::DrivenLoop { joint } | E::NoDirection { joint } => {
                Self::field("joints").and_joint(*joint)
            }
            E::Coincident { first, .. } => Self::field("joints").and_joint(*first),
            E::NotFinite { what, value } => Self::field(what).and_value(FoundValue::Number(*value)),
            E::InputCount { found, .. } => Self::field("inputs").and_value(FoundValue::Count(*found)),
            E::Group { error, .. } => error.into(),
            // About links or the whole: what is wrong is how they are joined.
            _ => Self::field("joints"),
        }
    }
}

impl From<&CouplerError> for ErrorPlace {
    fn from(error: &CouplerError) -> Self {
        use CouplerError as E;
        match error {
            E::NotFinite { side, field, value } => {
                Self::leg(*side).and_field(*field).and_value(FoundValue::Number(*value))
            }
            E::NegativeRadius { side, value } => {
                Self::leg(*side).and_field("radius").and_value(FoundValue::Number(*value))
            }
            E::NoDirection { side } => Self::leg(*side).and_field("direction"),
            E::OneJoint | E::ParallelLines => Self::field("fourbar"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_in_files_are_taken_apart() {
        let place = ErrorPlace::of_text("leg 2: links[0].at");
        assert_eq!((place.leg, place.field.as_deref()), (Some(2), Some("links[0].at")));
        let place = ErrorPlace::of_text("leg 3");
        assert_eq!((place.leg, place.field), (Some(3), None));
        let place = ErrorPlace::of_text("schema");
        assert_eq!((place.leg, place.field.as_deref()), (None, Some("schema")));
    }
}
