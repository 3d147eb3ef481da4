//! Two spatial robots whose kinematics come down to the same small algebra.
//!
//! [`Hana`] moves its platform in a plane and tilts it about one axis; its forward kinematics falls into two families of square roots.

mod error;
mod hana;

pub use error::SpatialError;
pub use hana::{
    Hana, HanaAssemblies, HanaAssembly, HanaFamily, HanaMode, HanaPose, HanaSingularKind, HanaSingularity,
    HanaUnreachable, HanaVelocity, HanaViolation, HanaWay, HanaWays, MixedReach, MixedSingularity,
};
