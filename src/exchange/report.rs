//! The answer to `forward` and `triad` as one JSON document.

use num_complex::Complex64;
use serde::Serialize;

use super::triad_file::TriadFile;
use crate::certify::Verdict;
use crate::linkage::{Assemblies, AssemblyMode, Status, Triad};
use crate::manipulator::{AssemblyModes, ManipulatorMode, Violation};
use crate::solve::Account;

/// Every assembly mode, the non-real solutions, and where every root went. Angles in radians.
///
/// Everything that is known is in it; nothing depends on what a table was asked to show.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ForwardReport {
    schema: &'static str,
    /// `complete`, `self_motion` or `undecided`.
    pub status: &'static str,
    /// The actuator values; empty for a triad.
    pub inputs: Vec<f64>,
    /// The name of the triad: `RR-RR-RR`.
    pub group: Option<String>,
    /// The locked triad, as a problem file.
    pub triad: Option<TriadFile>,
    /// The assembly modes.
    pub modes: Vec<ModeReport>,
    complex: Vec<ComplexReport>,
    account: AccountReport,
    rejections: Vec<RejectionReport>,
    self_motions: Vec<SelfMotionReport>,
    /// What is special about the group.
    pub special: Vec<&'static str>,
    polynomial: Option<PolynomialReport>,
    /// The length that residuals are measured against.
    pub size: f64,
}

/// An assembly mode as reports write it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModeReport {
    /// `[x, y, phi]`.
    pub pose: [f64; 3],
    /// How many modes meet here.
    pub multiplicity: usize,
    /// Largest closure error over the largest length.
    pub residual: f64,
    proof: &'static str,
    /// Joint values, leg by leg; `null` for a triad.
    pub joints: Option<Vec<[f64; 3]>>,
    /// Working-mode signs; `null` for a triad.
    pub signs: Option<String>,
    det_a: f64,
    violations: Vec<ViolationReport>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct ViolationReport {
    leg: usize,
    joint: usize,
    value: f64,
    limit: [f64; 2],
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct ComplexReport {
    theta: [f64; 2],
    z: [f64; 2],
    w: [f64; 2],
    multiplicity: usize,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct AccountReport {
    degree: usize,
    real: usize,
    complex: usize,
    at_infinity: usize,
    rejected: usize,
    self_motion: usize,
    undecided: usize,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct RejectionReport {
    theta: [f64; 2],
    multiplicity: usize,
    reason: String,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct SelfMotionReport {
    phi: Option<f64>,
    real: bool,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct PolynomialReport {
    variable: &'static str,
    from: i32,
    coefficients: Vec<[f64; 2]>,
}

impl ForwardReport {
    /// The report on a manipulator.
    pub fn of_manipulator(answer: &AssemblyModes) -> Self {
        let modes = answer.modes.iter().map(ModeReport::from).collect();
        Self { inputs: answer.inputs.clone(), ..Self::of(answer.triad(), &answer.group, modes) }
    }

    /// The report on a triad.
    pub fn of_triad(triad: &Triad, answer: &Assemblies) -> Self {
        Self::of(Some(triad), answer, answer.modes.iter().map(ModeReport::from).collect())
    }

    fn of(triad: Option<&Triad>, answer: &Assemblies, modes: Vec<ModeReport>) -> Self {
        let Account { degree, real, complex, at_infinity, rejected, self_motion, undecided } = answer.account;
        Self {
            schema: "assur/forward/1",
            status: match answer.status {
                Status::Complete => "complete",
                Status::SelfMotion => "self_motion",
                Status::Undecided => "undecided",
            },
            inputs: Vec::new(),
            group: triad.map(Triad::name),
            triad: triad.map(TriadFile::from),
            modes,
            complex: answer
                .complex
                .iter()
                .map(|mode| ComplexReport {
                    theta: parts(mode.theta),
                    z: parts(mode.z),
                    w: parts(mode.w),
                    multiplicity: mode.multiplicity,
                })
                .collect(),
            account: AccountReport { degree, real, complex, at_infinity, rejected, self_motion, undecided },
            rejections: answer
                .rejections
                .iter()
                .map(|rejection| RejectionReport {
                    theta: parts(rejection.theta),
                    multiplicity: rejection.multiplicity,
                    reason: rejection.reason.to_string(),
                })
                .collect(),
            self_motions: answer
                .self_motions
                .iter()
                .map(|motion| SelfMotionReport { phi: motion.phi, real: motion.real })
                .collect(),
            special: answer.special.iter().map(|special| special.name()).collect(),
            polynomial: answer.polynomial.as_ref().map(|polynomial| PolynomialReport {
                variable: "theta",
                from: polynomial.from,
                coefficients: polynomial.coefficients.iter().copied().map(parts).collect(),
            }),
            size: answer.size,
        }
    }

    /// The report as a JSON document, ending in a newline.
    ///
    /// # Panics
    /// Never: the report is plain numbers and texts.
    pub fn to_json(&self) -> String {
        json(self)
    }
}

impl From<&AssemblyMode> for ModeReport {
    fn from(mode: &AssemblyMode) -> Self {
        Self {
            pose: [mode.pose.x, mode.pose.y, mode.pose.phi],
            multiplicity: mode.multiplicity,
            residual: mode.residual,
            proof: match mode.proof {
                Verdict::NotAsked => "not_asked",
                Verdict::Proven => "proven",
                Verdict::Refuted => "refuted",
                Verdict::Undecided => "undecided",
            },
            joints: None,
            signs: None,
            det_a: mode.det_a,
            violations: Vec::new(),
        }
    }
}

impl From<&ManipulatorMode> for ModeReport {
    fn from(mode: &ManipulatorMode) -> Self {
        Self {
            joints: Some(mode.joints.clone()),
            signs: Some(mode.signs.clone()),
            violations: mode.violations.iter().map(ViolationReport::from).collect(),
            ..Self::from(&mode.mode)
        }
    }
}

fn parts(value: Complex64) -> [f64; 2] {
    [value.re, value.im]
}

impl From<&Violation> for ViolationReport {
    fn from(&Violation { leg, joint, value, limit }: &Violation) -> Self {
        Self { leg, joint, value, limit }
    }
}

/// A report as a JSON document, ending in a newline.
pub(super) fn json(report: &impl Serialize) -> String {
    let mut text = serde_json::to_string_pretty(report).expect("a report is plain numbers and texts");
    text.push('\n');
    text
}
