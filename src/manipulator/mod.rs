//! Planar 3-DOF parallel manipulators: a platform on legs of three joints each.
//!
//! A [`Manipulator`] is described once; [`Manipulator::forward`] locks its actuators and asks the triad that is left.

mod actuator_plane;
mod batch;
mod catalogue;
mod describe;
mod design;
mod follow;
mod forward;
mod frame;
mod guide;
mod hold;
mod inverse;
mod joints;
mod lock;
mod locus;
mod mobility;
mod screw;
mod singular;
mod trace;
mod track;
mod velocity;
mod watch;

pub use actuator_plane::ActuatorPlane;
pub use batch::{ModesBatch, ModesPlaces};
pub use catalogue::FamilyError;
pub use describe::{DescriptionError, JointKind, JointsError, JointsReason, Leg, Manipulator, Placement};
pub use design::{DesignCoordinate, DesignError, DesignKey, DesignNumber, DesignPart};
pub use follow::{FollowedPath, PathError, PathEvent, PathEventKind, PathRow, PathSettings};
pub use forward::{AssemblyModes, ManipulatorMode, Violation};
pub use guide::Guided;
pub use inverse::{InverseSpecial, KinematicsError, ModeChoice, Unreachable, WorkingMode, WorkingModes};
pub use lock::{LockError, LockedGroup};
pub use locus::{LegLocus, LocusError, PlaneCurve, SingularityLocus};
pub use mobility::Remark;
pub use screw::{joint_screw, power, reciprocal_wrench, screw_rate};
pub use singular::{Reading, Singularity, SingularityKind};
pub use trace::{MapQuantity, PlaneMap, PlaneWindow};
pub use track::{Carried, ModeEnd, Tracked};
pub use velocity::{SingularMatrix, Velocity};
