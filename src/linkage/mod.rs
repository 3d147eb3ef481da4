//! Planar Assur groups: what is left of a mechanism when its drivers are held.
//!
//! A [`Triad`] is a platform on three [`Dyad`]s; [`Triad::assemble`] finds every way to put it together.

mod assemble;
mod assemblies;
mod certificate;
mod exact_box;
mod fibre;
mod given_orientation;
mod group;
mod judge;
mod loop_box;
mod numbers;
mod pinned;
mod place;
mod prove;
mod special;
mod triad;
mod vanishing;
mod verify;

pub use assemblies::{
    Assemblies, AssemblyMode, ComplexMode, Rejection, RejectionReason, SelfMotion, Special, Status, ThetaPolynomial,
};
pub use certificate::Certificate;
pub use group::{Dyad, Offset, Pose, Triad, TriadError};
pub use judge::{Claim, Judgement};
pub use pinned::{PinnedDyad, PinnedDyadError};
pub use prove::{ProofRoute, ProvedMode, ProvedModes};
pub use special::NearMiss;
pub use triad::{LegNumbers, Row, Rows, consistency, leg_row, triad_rows};
