//! Planar 3-DOF parallel manipulators: a platform on legs of three joints each.
//!
//! A [`Manipulator`] is described once; [`Manipulator::forward`] locks its actuators and asks the triad that is left.

mod catalogue;
mod describe;
mod forward;
mod frame;
mod joints;
mod lock;
mod mobility;

pub use catalogue::FamilyError;
pub use describe::{DescriptionError, JointKind, JointsError, JointsReason, Leg, Manipulator, Placement};
pub use forward::{AssemblyModes, ManipulatorMode, Violation};
pub use lock::{LockError, LockedGroup};
pub use mobility::Remark;
