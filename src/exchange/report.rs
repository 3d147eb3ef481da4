//! The answer to `forward` and `triad` as one JSON document.

use num_complex::Complex64;
use serde::Serialize;

use super::triad_file::{DyadEntry, TriadFile};
use crate::certify::Verdict;
use crate::linkage::{Assemblies, AssemblyMode, Certificate, ProofSubject, Status, Triad};
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
    /// Which limit was reached, where something is undecided.
    #[serde(skip_serializing_if = "Option::is_none")]
    limit: Option<LimitReport>,
    /// The actuator values; empty for a triad.
    pub inputs: Vec<f64>,
    /// The name of the triad: `RR-RR-RR`.
    pub group: Option<String>,
    /// The locked triad, as a problem file.
    pub triad: Option<TriadFile>,
    /// The assembly modes.
    pub modes: Vec<ModeReport>,
    complex: Vec<ComplexReport>,
    complex_out_of_range: usize,
    account: AccountReport,
    rejections: Vec<RejectionReport>,
    self_motions: Vec<SelfMotionReport>,
    /// What is special about the group.
    pub special: Vec<&'static str>,
    near: Vec<NearReport>,
    /// What a proof came to, where one was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub certificate: Option<CertificateReport>,
    polynomial: Option<PolynomialReport>,
    /// The length that residuals are measured against.
    pub size: f64,
}

/// A limit that was reached.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct LimitReport {
    /// `size` or `exponent_range`.
    name: &'static str,
    text: String,
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
    /// `proven`, `refuted`, `undecided` or `not_asked`.
    pub proof: &'static str,
    /// A box `[[lo, hi], ..]` of `[x, y, phi]` that holds this mode and no other, where a proof was asked for.
    #[serde(rename = "box", skip_serializing_if = "Option::is_none")]
    pub pose_box: Option<[[f64; 2]; 3]>,
    /// Joint values, leg by leg; `null` for a triad.
    pub joints: Option<Vec<[f64; 3]>>,
    /// Working-mode signs; `null` for a triad.
    pub signs: Option<String>,
    det_a: f64,
    violations: Vec<ViolationReport>,
}

/// A special shape that the group does not have, exactly, but nearly.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct NearReport {
    special: &'static str,
    distance: f64,
}

/// What is proved of an answer as a whole.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CertificateReport {
    /// `6 of degree 6: 4 real proved, 2 non-real proved, complete`.
    pub summary: String,
    /// Whether every mode is proved and no other exists.
    pub complete: bool,
    /// How many boxes meet another, since `f64` cannot tell their modes apart.
    pub indistinct: usize,
    /// Whether an RP leg's `d·|v|` was rounded for the count.
    pub rounded_offset: bool,
    /// In how many ways free legs can stand in each pose, at most; which of them they do is measured, not proved.
    pub free_ways: usize,
    /// What the proof is about, in words.
    pub about: String,
    /// What the proof is about, in numbers.
    pub subject: SubjectReport,
}

/// The group a proof is about: the legs of a triad, a pin and a leg, or a pose.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum SubjectReport {
    /// A triad, as a problem file.
    Triad(TriadFile),
    /// A platform pinned in a point.
    Pinned {
        /// The base point.
        a: [f64; 2],
        /// The platform point held there.
        b: [f64; 2],
        /// The leg.
        leg: DyadEntry,
    },
    /// `[x, y, phi]`.
    Placed([f64; 3]),
}

impl From<&ProofSubject> for SubjectReport {
    fn from(subject: &ProofSubject) -> Self {
        match subject {
            ProofSubject::Triad(triad) => Self::Triad(TriadFile::from(triad)),
            ProofSubject::Pinned(pinned) => {
                let (a, b) = pinned.pin();
                Self::Pinned { a: a.into(), b: b.into(), leg: DyadEntry::from(pinned.leg()) }
            }
            ProofSubject::Placed(pose) => Self::Placed([pose.x, pose.y, pose.phi]),
        }
    }
}

impl From<&Certificate> for CertificateReport {
    fn from(certificate: &Certificate) -> Self {
        Self {
            summary: certificate.to_string(),
            complete: certificate.complete,
            indistinct: certificate.indistinct,
            rounded_offset: certificate.rounded_offset,
            free_ways: certificate.free_ways,
            about: certificate.subject.to_string(),
            subject: SubjectReport::from(&certificate.subject),
        }
    }
}

/// A verdict as reports write it.
pub(super) fn proof(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::NotAsked => "not_asked",
        Verdict::Proven => "proven",
        Verdict::Refuted => "refuted",
        Verdict::Undecided => "undecided",
    }
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
pub(super) struct AccountReport {
    degree: usize,
    real: usize,
    complex: usize,
    at_infinity: usize,
    rejected: usize,
    self_motion: usize,
    undecided: usize,
}

impl From<Account> for AccountReport {
    fn from(account: Account) -> Self {
        let Account { degree, real, complex, at_infinity, rejected, self_motion, undecided } = account;
        Self { degree, real, complex, at_infinity, rejected, self_motion, undecided }
    }
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
        Self {
            schema: "assur/forward/1",
            status: match answer.status {
                Status::Complete => "complete",
                Status::SelfMotion => "self_motion",
                Status::Undecided => "undecided",
            },
            limit: answer.limit.map(|limit| LimitReport { name: limit.name(), text: limit.to_string() }),
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
            complex_out_of_range: answer.complex_out_of_range,
            account: AccountReport::from(answer.account),
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
            near: answer
                .near
                .iter()
                .map(|near| NearReport { special: near.special.name(), distance: near.distance })
                .collect(),
            certificate: answer.certificate.as_ref().map(CertificateReport::from),
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
            proof: proof(mode.proof),
            pose_box: mode.pose_box,
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
