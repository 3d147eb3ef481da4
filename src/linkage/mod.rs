//! Planar Assur groups: what is left of a mechanism when its drivers are held.
//!
//! A [`Triad`] is a platform on three [`Dyad`]s; [`Triad::assemble`] finds every way to put it together.

mod assemblies;
mod dyad;
mod group;
mod name;
mod slider_quadrics;

pub use assemblies::{
    Assemblies, AssemblyMode, ComplexMode, Rejection, RejectionReason, SelfMotion, Special, Status, ThetaPolynomial,
};
pub use dyad::{Guide, TwoLinkAssemblies, TwoLinkAssembly, TwoLinkError, TwoLinkGroup, TwoLinkSpecial};
pub use group::{Dyad, Offset, Pose, Triad, TriadError};
pub use name::{DyadKind, GroupName, GroupNameError};
pub use slider_quadrics::{SliderPose, SliderQuadricsError, SliderSolutions, rp_rp_rp_quartic};

impl Triad {
    /// Every way to put the triad together.
    pub fn assemble(&self) -> Assemblies {
        unimplemented!("being written")
    }
}
