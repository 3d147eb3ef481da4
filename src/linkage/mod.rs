//! Planar Assur groups: what is left of a mechanism when its drivers are held.
//!
//! A [`Triad`] is a platform on three [`Dyad`]s; [`Triad::assemble`] finds every way to put it together. A [`TwoLinkGroup`] is one of
//! the five groups of class II. A [`Truss`] is a group of any size with revolute joints, together with its ground. A [`Linkage`]
//! is taken apart into such groups and put together again.

mod assemble;
mod assemblies;
mod block;
mod certificate;
mod closure_row;
mod columns;
mod constraint;
mod coupler;
mod decompose;
mod det_a;
mod dyad;
mod exact_box;
mod fibre;
mod given_orientation;
mod group;
mod judge;
mod local;
mod loop_box;
mod loops;
mod many;
mod name;
mod numbers;
mod pinned;
mod pivoting;
mod place;
mod poses;
mod prove;
mod real_modes;
mod slider_quadrics;
mod special;
mod triad;
mod truss;
mod vanishing;
mod verify;

pub use assemblies::{
    Assemblies, AssemblyMode, ComplexMode, Limit, Rejection, RejectionReason, SelfMotion, Special, Status,
    ThetaPolynomial,
};
pub use certificate::{Certificate, ProofSubject};
pub use constraint::{RotationNumbers, constraint_system, sylvester_plan};
pub use coupler::{
    Biquadratic, Circuit, CouplerCurve, CouplerError, CouplerSide, DoublePoint, DoublePointKind, GrashofClass,
    InputRange, Intersection, Intersections, Partner, SideNumbers, coupler_equation,
};
pub use decompose::{
    GroupError, Linkage, LinkageAssemblies, LinkageAssembly, LinkageError, LinkageGroup, LinkageJoint,
    LinkageJointKind, LinkageNode,
};
pub use dyad::{Guide, TwoLinkAssemblies, TwoLinkAssembly, TwoLinkError, TwoLinkGroup, TwoLinkSpecial};
pub use group::{Dyad, Offset, Pose, Triad, TriadError, triad_degree};
pub use judge::{Claim, Judgement};
pub(crate) use many::real_modes_of_many;
pub use name::{DyadKind, GroupName, GroupNameError};
pub use pinned::{PinnedDyad, PinnedDyadError};
pub use prove::{ProofRoute, ProvedMode, ProvedModes};
pub use real_modes::{MOST_MODES, ModesRoute, RealMode, RealModes};
pub use slider_quadrics::{SliderPose, SliderQuadricsError, SliderSolutions, rp_rp_rp_quartic};
pub use special::NearMiss;
pub use triad::{LegNumbers, Row, Rows, consistency, leg_row, triad_rows};
pub use truss::{
    BaranovTruss, GraphError, Truss, TrussAssemblies, TrussAssembly, TrussError, TrussJoint, baranov_trusses,
};
