//! A linkage with drivers, taken apart into Assur groups and put together again, group after group.
//!
//! A driven joint holds two links together at a given place, so they are one body. From the ground outwards, the smallest set of bodies whose
//! joints to each other and to what is known leave no freedom is the next Assur group (`take_apart.rs`); it is assembled on known places, dyads and
//! triads of every kind exactly (`small.rs`), larger groups of revolute joints as a [`super::Truss`], and each real assembly is the
//! beginning of a branch. The leaves of that tree are the assemblies of the linkage (`assemble.rs`): every combination, nothing sampled.
//!
//! Not covered, and named where a file has them: sliders in groups larger than the triad; loops closed by sliders alone, which cannot
//! turn, so that one of their conditions is superfluous. A group without a real assembly ends its branch.

mod assemble;
mod describe;
mod motion;
mod small;
mod take_apart;

pub use assemble::{LinkageAssemblies, LinkageAssembly, LinkageGroup, LinkageNode};
pub use describe::{GroupError, Linkage, LinkageError, LinkageJoint, LinkageJointKind};
