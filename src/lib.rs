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
    Assemblies, AssemblyMode, Certificate, Claim, ComplexMode, Dyad, Judgement, NearMiss, Offset, PinnedDyad,
    PinnedDyadError, Pose, ProofRoute, ProvedMode, ProvedModes, Rejection, RejectionReason, SelfMotion, Special,
    Status, ThetaPolynomial, Triad, TriadError,
};
pub use manipulator::{
    AssemblyModes, DescriptionError, FamilyError, JointKind, JointsError, JointsReason, Leg, LockError, LockedGroup,
    Manipulator, ManipulatorMode, Placement, Remark, Violation, triad_degree,
};
pub use solve::{Account, Eliminant, EliminateError, Outcome, Plan, System, eliminate};
