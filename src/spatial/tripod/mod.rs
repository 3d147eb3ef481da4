//! A platform on three legs, each driven by two sliders on parallel rails: six degrees of freedom with simple kinematics.
//!
//! The two sliders of a leg turn and shift a plane; a joint of the platform moves freely in that plane and keeps its axis in it.
//!
//! | symbol | meaning |
//! |---|---|
//! | `u` | direction of a leg's rails, through the points `Da` and `Db` |
//! | `w` | direction of the base axes that ride on the sliders, square to `u` |
//! | `v`, `c` | direction of the joint's axis on the platform and a point of it, in the platform's frame |
//! | `p`, `R` | the pose: place of the platform's origin, its rotation |
//! | `P` | `p + R c` |
//! | `n` | normal of the leg's plane: `R v × w`, and as well `(Db - Da + (rho_b - rho_a) u) × w` up to its length |
//!
//! So inverse kinematics is one division a slider; forward, the inputs give the three normals, the orientation solves `n_i · R v_i = 0`, and the place three
//! linear equations. Source: Cherkhelanov, Bonev; what is printed there and does not hold is said where it matters.
//! Not covered: the Pentapteron, whose forward kinematics has 208 real solutions and more (cited there as its reference 6).

mod cartesian;
mod determinant;
mod exact;
mod fewer;
mod forward;
mod members;
mod model;
mod multipteron;
mod orientation;
mod sector;
mod tilt;
mod tilt_limits;
mod velocity;

pub use cartesian::{CartesianRobot, CartesianSingular};
pub use determinant::{DeterminantPoint, TripodDesign};
pub use fewer::{TripodPointed, TripodPointing, TripodTorsions};
pub use forward::{Counted, TripodAssemblies, TripodAssembly, TripodStatus};
pub use members::{Hexapteron, Quadrupteron, Tripteron};
pub use model::{Tripod, TripodError, TripodLeg, TripodPose, TripodReach};
pub use multipteron::{Multipteron, MultipteronError, MultipteronPoses};
pub use orientation::{Orientations, PlaneConditions};
pub use tilt::{Tilt, TiltLimit};
pub use velocity::{TripodSingularity, TripodVelocity};
