//! Assur groups of any size with revolute joints: every way to put them together.
//!
//! A group with its ground is a truss: links and joints of mobility 0 without a smaller rigid part. [`Truss::assemble`] writes its loops
//! in rotations `theta_j`, hides one of them, and leaves the rest to a Dixon pencil ([`crate::eliminate::DixonPencil`]); each eigenvector is
//! lifted, refined on the loops themselves and kept only if they close. One hidden link may miss solutions of special dimensions, so
//! others are tried until the number that [`baranov_trusses`] gives is complete. What stays missing is said.
//!
//! Not covered: sliders, which break the linearity of the loops in each rotation; more than eleven links.

mod assemble;
mod catalogue;
mod closure;
mod describe;
mod graph;

pub use assemble::{TrussAssemblies, TrussAssembly};
pub(in crate::linkage) use catalogue::group_name;
pub use catalogue::{BaranovTruss, baranov_trusses};
pub use describe::{Truss, TrussError, TrussJoint};
pub use graph::GraphError;
pub(in crate::linkage) use graph::MOST_LINKS;
