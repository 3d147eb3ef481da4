//! Two spatial robots whose kinematics come down to the same small algebra.
//!
//! [`Hana`] moves its platform in a plane and tilts it about one axis; its forward kinematics falls into two families of square roots. [`Tripod`] has six degrees
//! of freedom; its orientation solves one polynomial of degree 8, its place three linear equations.

mod bow;
mod error;
mod hana;
mod region;
mod remarks;
mod tripod;

pub use bow::LinkCurve;
pub use error::SpatialError;
pub use hana::{
    Capability, CapabilityMap, CapabilityStop, CapabilitySupremum, Hana, HanaAssemblies, HanaAssembly,
    HanaCapabilityError, HanaFamily, HanaMode, HanaPose, HanaSingularKind, HanaSingularity, HanaUnreachable,
    HanaVelocity, HanaViolation, HanaWay, HanaWays, MixedReach, MixedSingularity,
};
pub use region::{ArcCircle, ArcRegion, WorkspaceArc, WorkspaceCurve};
pub use remarks::SpatialRemark;
pub use tripod::{
    CartesianRobot, CartesianSingular, Counted, DeterminantPoint, Hexapteron, Multipteron, MultipteronError,
    MultipteronPoses, Orientations, PlaneConditions, Quadrupteron, Tilt, TiltLimit, Tripod, TripodAssemblies,
    TripodAssembly, TripodDesign, TripodError, TripodLeg, TripodPointed, TripodPointing, TripodPose, TripodReach,
    TripodSingularity, TripodStatus, TripodTorsions, TripodVelocity, Tripteron,
};
