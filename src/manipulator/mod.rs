//! Planar 3-DOF parallel manipulators: a platform on legs of three joints each.
//!
//! A [`Manipulator`] is described once; [`Manipulator::forward`] locks its actuators and asks the triad that is left.

mod describe;
mod forward;

pub use describe::{DescriptionError, JointKind, Leg, Manipulator, Placement};
pub use forward::{AssemblyModes, ForwardError, ManipulatorMode, Violation};
