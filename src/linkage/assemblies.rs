//! The answer to "in which ways can this group be put together", with the account that shows it complete.

use nalgebra::Vector2;
use num_complex::Complex64;
use thiserror::Error;

use super::certificate::Certificate;
use super::group::Pose;
use super::special::NearMiss;
use crate::certify::Verdict;
use crate::roots::MAX_BITS;
use crate::solve::Account;

/// How an answer ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Every assembly mode is listed; also when there is none.
    Complete,
    /// A whole curve of poses exists; isolated modes are listed beside it.
    SelfMotion,
    /// Something could not be decided within the stated limits; the account says how much, and [`Limit`] which.
    Undecided,
}

/// Which limit ended an answer as undecided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum Limit {
    /// Two roots, or a coordinate and zero, are not told apart within [`MAX_BITS`] bits.
    #[error("limit of size: {MAX_BITS} bits do not tell apart what has to be")]
    Size,
    /// A mode's coordinates leave the range of `f64`.
    #[error("limit of exponents: a coordinate leaves the range of f64")]
    ExponentRange,
}

impl Limit {
    /// The name that reports use: `size`, `exponent_range`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Size => "size",
            Self::ExponentRange => "exponent_range",
        }
    }
}

/// One way to put a group together.
#[derive(Clone, Debug, PartialEq)]
pub struct AssemblyMode {
    /// The pose of the platform.
    pub pose: Pose,
    /// How many modes meet here: 1 for an ordinary mode, more where the mechanism is singular.
    pub multiplicity: usize,
    /// Largest closure error of the assembled group over its largest length, measured on the geometry; where the platform stands further away than that, over
    /// its distance.
    pub residual: f64,
    /// det A, without unit: the determinant of the legs' unit wrenches in their order, moments over the group's size; see [`super::Triad::det_a`].
    pub det_a: f64,
    /// Whether a proof was asked for and what it came to.
    pub proof: Verdict,
    /// `[x, y, phi]`, each from lower to upper bound: a box that holds this mode and no other; `None` where no proof was asked for.
    ///
    /// The angle may go on beyond pi.
    pub pose_box: Option<[[f64; 2]; 3]>,
}

/// A solution of the closure equations that is not a real pose.
///
/// In isotropic coordinates `theta = e^(i phi)`, `z = x + iy`, `w = x - iy`, all three independent complex numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComplexMode {
    /// `e^(i phi)` for a complex `phi`; not of modulus 1, or `w` is not the conjugate of `z`.
    pub theta: Complex64,
    /// `x + iy`, in length units.
    pub z: Complex64,
    /// `x - iy`, in length units.
    pub w: Complex64,
    /// Multiplicity as a solution.
    pub multiplicity: usize,
}

/// Why a root of the eliminant carries no pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum RejectionReason {
    /// `theta` is the complex ratio of similar platforms, or its partner: every leg row has lost an unknown, both where they are congruent, and the lengths
    /// do not fit.
    #[error("no finite pose: theta is the ratio of similar platforms, and the lengths do not fit")]
    SimilarPlatforms,
    /// The two linear rows are parallel and contradict each other.
    #[error("no finite pose: the leg conditions are parallel in this orientation and contradict each other")]
    ParallelRows,
    /// The line of the linear rows is isotropic, so a second intersection with the circle lies at infinity.
    #[error("no finite pose: an isotropic line meets the circle only once")]
    IsotropicLine,
}

/// A root of the eliminant that carries no pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rejection {
    /// The orientation `e^(i phi)`, complex.
    pub theta: Complex64,
    /// How often the eliminant has this root, less the poses found above it.
    pub multiplicity: usize,
    /// Why.
    pub reason: RejectionReason,
}

/// A curve (or surface) of poses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SelfMotion {
    /// The orientation in which the platform translates freely, in radians; `None` where the platform turns along the motion.
    pub phi: Option<f64>,
    /// Whether real poses lie on it; a motion may exist over the complex numbers only.
    pub real: bool,
}

/// What is special about a group or its answer. Decided exactly, over the rationals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Special {
    /// The base and platform triangles of three RR legs are directly similar.
    SimilarPlatforms,
    /// They are directly congruent.
    CongruentPlatforms,
    /// Two base pivots or two platform pivots of RR legs coincide.
    CoincidentPivots,
    /// Two sliders keep parallel in every orientation.
    ParallelSliders,
    /// An RR leg has length zero.
    ZeroLength,
    /// The three base pivots lie on one line.
    CollinearBase,
    /// The three platform pivots lie on one line.
    CollinearPlatform,
    /// Two assembly modes share one orientation.
    TwinPoses,
    /// A mode of multiplicity two or more: a singular pose.
    DoubleRoot,
    /// A curve of poses exists.
    SelfMotion,
}

impl Special {
    /// The name that reports use: `similar_platforms`, `twin_poses`, …
    pub fn name(self) -> &'static str {
        match self {
            Self::SimilarPlatforms => "similar_platforms",
            Self::CongruentPlatforms => "congruent_platforms",
            Self::CoincidentPivots => "coincident_pivots",
            Self::ParallelSliders => "parallel_sliders",
            Self::ZeroLength => "zero_length",
            Self::CollinearBase => "collinear_base",
            Self::CollinearPlatform => "collinear_platform",
            Self::TwinPoses => "twin_poses",
            Self::DoubleRoot => "double_root",
            Self::SelfMotion => "self_motion",
        }
    }
}

/// The eliminant of a group, ready to be shown: `sum of coefficients[k] · theta^(from + k)`, zero exactly at the orientations of the modes.
#[derive(Clone, Debug, PartialEq)]
pub struct ThetaPolynomial {
    /// Lowest exponent, `-K`.
    pub from: i32,
    /// Coefficients, ascending, largest modulus 1; conjugate-symmetric.
    pub coefficients: Vec<Complex64>,
}

/// Every way to put a group together.
#[derive(Clone, Debug, PartialEq)]
pub struct Assemblies {
    /// How the answer ended.
    pub status: Status,
    /// Which limit was reached, where something is undecided.
    pub limit: Option<Limit>,
    /// The assembly modes, sorted by phi, then x, then y (equal within 1e-9 counts as equal).
    pub modes: Vec<AssemblyMode>,
    /// The solutions that are not real, partners included.
    pub complex: Vec<ComplexMode>,
    /// How many non-real solutions the account counts that are not listed, since their numbers leave the range of `f64`.
    pub complex_out_of_range: usize,
    /// Where every root of the eliminant went.
    pub account: Account,
    /// The roots that carry no pose, each with its reason.
    pub rejections: Vec<Rejection>,
    /// The curves of poses.
    pub self_motions: Vec<SelfMotion>,
    /// What is special, sorted, each once.
    pub special: Vec<Special>,
    /// What is exactly not special but within 1e-12 of it.
    pub near: Vec<NearMiss>,
    /// What a proof came to, where one was asked for.
    pub certificate: Option<Certificate>,
    /// The eliminant; `None` where the orientation is given (a PP leg) and there is nothing to eliminate for.
    pub polynomial: Option<ThetaPolynomial>,
    /// The length residuals are measured against: the group's largest.
    pub size: f64,
    /// Base point the group was placed against; only of interest with origins far away.
    pub origin: Vector2<f64>,
}
