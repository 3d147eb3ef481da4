#![forbid(unsafe_code)]
#![warn(missing_docs)]
//! In which ways can this planar mechanism be put together?

pub use nalgebra;
pub use num_complex;

pub mod algebra;
pub mod linkage;
pub mod manipulator;

pub use linkage::{Dyad, Offset, Pose, Triad, TriadError};
pub use manipulator::{DescriptionError, JointKind, Leg, Manipulator, Placement};
