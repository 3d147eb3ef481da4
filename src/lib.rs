//! **In which ways can this planar mechanism be put together?** All of them, with an account that adds up.
//!
//! ```
//! use assur::{Leg, Manipulator};
//!
//! let (sin, cos) = 0.8822f64.sin_cos();
//! let robot = Manipulator::new("3-RPR", vec![
//!     Leg::rpr([0.0, 0.0], [0.0, 0.0]),
//!     Leg::rpr([15.91, 0.0], [17.045, 0.0]),
//!     Leg::rpr([0.0, 10.0], [20.839 * cos, 20.839 * sin]),
//! ])?;
//! let answer = robot.forward(&[14.98, 15.38, 12.0])?;
//! for mode in &answer.modes {
//!     println!("{:?} closes to {:e}", mode.mode.pose, mode.mode.residual);
//! }
//! assert_eq!(answer.group.account.real, 6); // of degree 6: nothing missed, nothing invented
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # How
//!
//! [`Manipulator::lock`] holds the actuators and leaves an Assur group, mostly a [`Triad`]. [`Triad::constraints`] writes its
//! closures as polynomials, [`fn@eliminate`] takes them to one polynomial in `theta = e^(i phi)` by Sylvester resultants, over the
//! integers; [`roots`] counts its real roots exactly and locates all of them; each is lifted to the poses above it, and
//! each pose is measured on the assembled geometry. Every root of the polynomial ends in one entry of the [`Account`].
//! The generic layers ([`algebra`], [`mod@eliminate`], [`roots`], [`mod@solve`]) know no mechanism and solve any small polynomial system.
//!
//! # Vocabulary
//!
//! | word | meaning |
//! |---|---|
//! | Assur group | links and joints that are left when the drivers are held, and that no part of can be taken away |
//! | dyad | what is left of a locked leg: RR, PR, RP or PP, named by its passive joints, base first |
//! | triad | a platform on three dyads; an Assur group of class III |
//! | pose | position `x`, `y` and rotation `phi` of the platform frame in the base frame |
//! | assembly mode | one way to put a group together: a pose with its joint values |
//! | working mode | which of its ways each leg takes to a pose: `+-+` |
//! | eliminant | the polynomial in one unknown that elimination leaves |
//! | truss | an Assur group of revolute joints together with its ground |
//! | coupler curve | what a point of a link draws that is guided in two others |
//! | circuit | a piece of a coupler curve that the linkage traces without being taken apart |
//! | twin poses | two assembly modes with the same orientation |
//! | self-motion | a whole curve of poses for the same inputs |
//! | reference point | the platform point whose places a workspace is about |
//! | limit | an end of a joint's range, or the merging of a leg's working modes: what bounds a workspace |
//! | constant, maximal, inclusive, total, dextrous | reached with one orientation, with some, with some of a range, with every one of a range, with every one |
//!
//! # Features
//!
//! `cli` (default) is the command line; it brings `exchange` (model files and reports) and `plot` (drawings as SVG). The core builds
//! with none of them.
//!
//! # Bibliography
//!
//! - Aberth 1973: O. Aberth, Iteration methods for finding all zeros of a polynomial simultaneously, Math. Comp. 27, 339-344.
//! - Bareiss 1968: E. H. Bareiss, Sylvester's identity and multistep integer-preserving Gaussian elimination, Math. Comp. 22, 565-578.
//! - Cherkhelanov, Bonev: E. Cherkhelanov, I. A. Bonev, A novel three-legged 6-DOF parallel robot with simple kinematics.
//! - Collins and Akritas 1976: G. E. Collins, A. G. Akritas, Polynomial real root isolation using Descartes' rule of signs,
//!   SYMSAC '76, 272-275.
//! - Fujiwara 1916: M. Fujiwara, Über die obere Schranke des absoluten Betrages der Wurzeln einer algebraischen Gleichung, Tohoku Math.
//!   J. 10, 167-171.
//! - von zur Gathen and Gerhard 2013: Modern Computer Algebra, 3rd edition, Cambridge University Press.
//! - Gosselin, Lemieux, Merlet 1996: C. Gosselin, S. Lemieux, J.-P. Merlet, A new architecture of planar three-degree-of-freedom
//!   parallel manipulator, IEEE ICRA, 3738-3743.
//! - Gosselin, Sefrioui, Richard 1992: Solutions polynomiales au problème de la cinématique directe des manipulateurs parallèles plans à
//!   trois degrés de liberté, Mech. Mach. Theory 27, 107-119.
//! - Knuth 1969: D. E. Knuth, The Art of Computer Programming, vol. 2, Addison-Wesley (exact sums of two floats).
//! - Krawczyk 1969: R. Krawczyk, Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken, Computing 4, 187-201.
//! - Liu, Wang, Wang, Li 2004: X. Liu, J. Wang, Q. Wang, T. Li, Workspace and rotational capability analysis of a spatial 3-DoF parallel
//!   manipulator.
//! - Merlet, Gosselin, Mouly 1998: J.-P. Merlet, C. M. Gosselin, N. Mouly, Workspaces of planar parallel manipulators, Mech. Mach.
//!   Theory 33, 7-20.
//! - Mitsi, Bouzakis, Mansour, Popescu: A method for forward displacement analysis of 3-RRP and 3-PRP planar parallel manipulators.
//! - Mohamed and Duffy 1985: M. G. Mohamed, J. Duffy, A direct determination of the instantaneous kinematics of fully parallel robot
//!   manipulators, J. Mech. Transm. Autom. Des. 107, 226-229.
//! - Moore 1977: R. E. Moore, A test for existence of solutions to nonlinear systems, SIAM J. Numer. Anal. 14, 611-615.
//! - Moore, Kearfott, Cloud 2009: Introduction to Interval Analysis, SIAM.
//! - Nielsen and Roth 1999: J. Nielsen, B. Roth, Solving the input/output problem for planar mechanisms, J. Mech. Des. 121, 206-211.
//! - Parlett and Reinsch 1969: B. N. Parlett, C. Reinsch, Balancing a matrix for calculation of eigenvalues and eigenvectors,
//!   Numer. Math. 13, 293-304.
//! - Roberts 1875: S. Roberts, On three-bar motion in plane space, Proc. London Math. Soc. 7, 14-23.
//! - Rojas and Thomas 2012: N. Rojas, F. Thomas, On closed-form solutions to the position analysis of Baranov trusses, Mech. Mach. Theory
//!   50, 179-196.
//! - Wampler 2001: C. W. Wampler, Solving the kinematics of planar mechanisms by Dixon determinant and a complex-plane formulation, J.
//!   Mech. Des. 123, 382-387.
//! - Yun 1976: D. Y. Y. Yun, On square-free decomposition algorithms, SYMSAC '76, 26-35.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub use nalgebra;
pub use num_complex;

pub mod algebra;
pub mod certify;
pub mod eliminate;
#[cfg(feature = "exchange")]
pub mod exchange;
pub mod linkage;
pub mod manipulator;
pub mod plane;
#[cfg(feature = "plot")]
pub mod plot;
pub mod roots;
pub mod solve;
pub mod spatial;
pub mod workspace;

pub use certify::Verdict;
pub use linkage::{
    Assemblies, AssemblyMode, Certificate, Claim, ComplexMode, CouplerCurve, CouplerError, CouplerSide, Dyad, DyadKind,
    GroupName, GroupNameError, Guide, Judgement, Limit, ModesRoute, NearMiss, Offset, PinnedDyad, PinnedDyadError,
    Pose, ProofRoute, ProofSubject, ProvedMode, ProvedModes, RealMode, RealModes, Rejection, RejectionReason,
    SelfMotion, Special, Status, ThetaPolynomial, Triad, TriadError, Truss, TrussAssemblies, TrussAssembly, TrussError,
    TrussJoint, TwoLinkAssemblies, TwoLinkAssembly, TwoLinkError, TwoLinkGroup, TwoLinkSpecial, triad_degree,
};
pub use manipulator::{
    ActuatorPlane, AssemblyModes, Carried, DescriptionError, DesignCoordinate, DesignError, DesignKey, DesignNumber,
    DesignPart, FamilyError, FollowedPath, Guided, InverseSpecial, JointKind, JointsError, JointsReason,
    KinematicsError, Leg, LegLocus, LockError, LockedGroup, LocusError, Manipulator, ManipulatorMode, MapQuantity,
    ModeChoice, ModeEnd, ModesBatch, ModesPlaces, PathError, PathEvent, PathEventKind, PathRow, PathSettings,
    Placement, PlaneCurve, PlaneMap, PlaneWindow, Reading, Remark, SingularMatrix, Singularity, SingularityKind,
    SingularityLocus, Tracked, Unreachable, Velocity, Violation, WorkingMode, WorkingModes,
};
pub use solve::{
    Account, Eliminant, EliminateError, Outcome, Plan, RejectedRoot, RootRejection, Solution, Solutions, SolveError,
    System, eliminate, lift, solve,
};

pub use spatial::{
    ArcCircle, ArcRegion, Capability, CapabilityMap, CapabilityStop, CapabilitySupremum, CartesianRobot,
    CartesianSingular, Counted, DeterminantPoint, Hana, HanaAssemblies, HanaAssembly, HanaCapabilityError, HanaFamily,
    HanaMode, HanaPose, HanaSingularKind, HanaSingularity, HanaUnreachable, HanaVelocity, HanaViolation, HanaWay,
    HanaWays, Hexapteron, LinkCurve, MixedReach, MixedSingularity, Multipteron, MultipteronError, MultipteronPoses,
    Orientations, PlaneConditions, Quadrupteron, SpatialError, SpatialRemark, Tilt, TiltLimit, Tripod,
    TripodAssemblies, TripodAssembly, TripodDesign, TripodError, TripodLeg, TripodPointed, TripodPointing, TripodPose,
    TripodReach, TripodSingularity, TripodStatus, TripodTorsions, TripodVelocity, Tripteron, WorkspaceArc,
    WorkspaceCurve,
};

pub use plane::{AngleSet, PhiRange};
pub use workspace::{
    ActiveLimit, ArcCurve, BoundaryArc, Isolated, Membership, Reach, Region, Workspace, WorkspaceError, WorkspaceKind,
    WorkspaceModes,
};

/// The README's code runs as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// The guide's code runs as a test.
#[cfg(doctest)]
#[doc = include_str!("../docs/src/first-answers.md")]
#[doc = include_str!("../docs/src/motion.md")]
struct GuideChapters;
