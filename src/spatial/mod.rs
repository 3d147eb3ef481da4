//! Two spatial robots whose kinematics come down to the same small algebra.
//!
//! [`Hana`] moves its platform in a plane and tilts it about one axis; its forward kinematics falls into two families of square roots. [`Tripod`] has six degrees
//! of freedom; its orientation solves one polynomial of degree 8, its place three linear equations.

mod arcs;
mod error;
mod hana;
mod tripod;

pub use arcs::{ArcCircle, ArcRegion, WorkspaceArc};
pub use error::SpatialError;
pub use hana::{
    Capability, CapabilityMap, CapabilityStop, CapabilitySupremum, Hana, HanaAssemblies, HanaAssembly, HanaFamily,
    HanaMode, HanaPose, HanaSingularKind, HanaSingularity, HanaUnreachable, HanaVelocity, HanaViolation, HanaWay,
    HanaWays, HanaWorkspaceError, MixedReach, MixedSingularity,
};
pub use tripod::{
    CartesianRobot, CartesianSingular, Hexapteron, Orientations, PlaneConditions, Quadrupteron, Tilt, TiltLimit,
    Tripod, TripodAssemblies, TripodAssembly, TripodError, TripodLeg, TripodPose, TripodReach, TripodSingularity,
    TripodStatus, TripodVelocity, Tripteron,
};
