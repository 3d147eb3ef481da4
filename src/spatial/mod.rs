//! Two spatial robots whose kinematics come down to the same small algebra.
//!
//! [`Hana`] moves its platform in a plane and tilts it about one axis; its forward kinematics falls into two families of square roots.

mod arcs;
mod error;
mod hana;

pub use arcs::{ArcCircle, ArcRegion, WorkspaceArc};
pub use error::SpatialError;
pub use hana::{
    Capability, CapabilityMap, CapabilityStop, CapabilitySupremum, Hana, HanaAssemblies, HanaAssembly, HanaFamily,
    HanaMode, HanaPose, HanaSingularKind, HanaSingularity, HanaUnreachable, HanaVelocity, HanaViolation, HanaWay,
    HanaWays, HanaWorkspaceError, MixedReach, MixedSingularity,
};
