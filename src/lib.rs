#![forbid(unsafe_code)]
#![warn(missing_docs)]
//! In which ways can this planar mechanism be put together?

pub use nalgebra;
pub use num_complex;

pub mod algebra;
pub mod certify;
pub mod eliminate;
#[cfg(feature = "exchange")]
pub mod exchange;
pub mod linkage;
pub mod manipulator;
#[cfg(feature = "plot")]
pub mod plot;
pub mod roots;
pub mod solve;

pub use certify::Verdict;
pub use linkage::{
    Assemblies, AssemblyMode, ComplexMode, Dyad, Offset, PinnedDyad, PinnedDyadError, Pose, Rejection, RejectionReason,
    SelfMotion, Special, Status, ThetaPolynomial, Triad, TriadError,
};
pub use manipulator::{
    AssemblyModes, DescriptionError, FamilyError, InverseSpecial, JointKind, JointsError, JointsReason,
    KinematicsError, Leg, LegLocus, LockError, LockedGroup, LocusError, Manipulator, ManipulatorMode, Placement,
    PlaneCurve, Reading, Remark, SingularMatrix, Singularity, SingularityKind, SingularityLocus, Unreachable, Velocity,
    Violation, WorkingMode, WorkingModes, triad_degree,
};
pub use solve::{Account, Eliminant, EliminateError, Outcome, Plan, System, eliminate};
