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
    Assemblies, AssemblyMode, ComplexMode, Dyad, DyadKind, GroupName, GroupNameError, Guide, Offset, PinnedDyad,
    PinnedDyadError, Pose, Rejection, RejectionReason, SelfMotion, Special, Status, ThetaPolynomial, Triad, TriadError,
    TwoLinkAssemblies, TwoLinkAssembly, TwoLinkError, TwoLinkGroup, TwoLinkSpecial, triad_degree,
};
pub use manipulator::{
    AssemblyModes, DescriptionError, FamilyError, JointKind, JointsError, JointsReason, Leg, LockError, LockedGroup,
    Manipulator, ManipulatorMode, Placement, Remark, Violation,
};
pub use solve::{
    Account, Eliminant, EliminateError, Outcome, Plan, RejectedRoot, RootRejection, Solution, Solutions, SolveError,
    System, eliminate, lift, solve,
};

/// The README's code runs as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
