//! The answers to `inverse` and `velocity` as JSON documents. Angles in radians.

use nalgebra::{Matrix3, Vector3};
use serde::Serialize;

use super::report::ViolationReport;
use crate::linkage::Pose;
use crate::manipulator::{ModeChoice, Reading, SingularMatrix, Singularity, Velocity, WorkingModes};

/// Every working mode of a pose.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InverseReport {
    schema: &'static str,
    pose: [f64; 3],
    modes: Vec<WorkingModeReport>,
    unreachable_legs: Vec<UnreachableReport>,
    special: Vec<InverseSpecialReport>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct WorkingModeReport {
    signs: String,
    joints: Vec<[f64; 3]>,
    violations: Vec<ViolationReport>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct UnreachableReport {
    leg: usize,
    miss: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct InverseSpecialReport {
    name: &'static str,
    leg: usize,
    text: String,
}

impl From<&WorkingModes> for InverseReport {
    fn from(answer: &WorkingModes) -> Self {
        let mode = |mode: &crate::manipulator::WorkingMode| WorkingModeReport {
            signs: mode.signs.clone(),
            joints: mode.joints.clone(),
            violations: mode.violations.iter().map(ViolationReport::from).collect(),
        };
        let special = answer.special.iter();
        Self {
            schema: "assur/inverse/1",
            pose: numbers(&answer.pose),
            modes: answer.modes.iter().map(mode).collect(),
            unreachable_legs: answer
                .unreachable
                .iter()
                .map(|leg| UnreachableReport { leg: leg.leg, miss: leg.miss })
                .collect(),
            special: special
                .map(|s| InverseSpecialReport { name: s.name(), leg: s.leg(), text: s.to_string() })
                .collect(),
        }
    }
}

impl InverseReport {
    /// The report as a JSON document, ending in a newline.
    pub fn to_json(&self) -> String {
        super::report::json(self)
    }
}

/// What is asked of a pose in motion: rates and accelerations of the platform, a wrench on it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Rates of the platform `(x', y', phi')`, or of the actuators.
    pub rates: Option<Vector3<f64>>,
    /// Accelerations to go with the rates; at rest where there are none.
    pub accelerations: Option<Vector3<f64>>,
    /// An external wrench `(fx, fy, m)` on the platform, about its origin.
    pub wrench: Option<Vector3<f64>>,
}

/// The matrices of a pose, its singularity, and what was asked of its motion. Rates and accelerations are answered both ways: taken as the
/// platform's, and taken as the actuators'; `null` with a reason where a singularity leaves no answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct VelocityReport {
    schema: &'static str,
    pose: [f64; 3],
    signs: String,
    /// Why this mode: `named`, `the only one`, `the only one within the limits`.
    mode_choice: &'static str,
    joints: Vec<[f64; 3]>,
    /// `A`, row by row.
    pub pose_matrix: [[f64; 3]; 3],
    /// `B`, row by row.
    pub input_matrix: [[f64; 3]; 3],
    row_legs: [usize; 3],
    row_scaling: &'static str,
    det_pose: f64,
    det_input: f64,
    /// The singularity's name.
    pub singularity: &'static str,
    legs: Vec<usize>,
    idle_legs: Vec<usize>,
    reading: Option<ReadingReport>,
    free_motion: Option<[f64; 3]>,
    sigma_min: f64,
    sigma_min_input: f64,
    singular_values: [f64; 3],
    scaled_pose_matrix: Vec<[f64; 3]>,
    dexterity: f64,
    characteristic_length: f64,
    scaling: ScalingReport,
    #[serde(skip_serializing_if = "Option::is_none")]
    rates: Option<BothWays>,
    #[serde(skip_serializing_if = "Option::is_none")]
    accelerations: Option<BothWays>,
    #[serde(skip_serializing_if = "Option::is_none")]
    wrench: Option<WrenchReport>,
}

/// What each printed number is scaled by.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct ScalingReport {
    pose_matrix: &'static str,
    singular_values: &'static str,
    sigma_min_input: &'static str,
    dexterity: &'static str,
}

/// How the rows of the two matrices are scaled.
pub const ROW_SCALING: &str =
    "force: distance of the idle pivots (RR), 1 (PR, RP), 0 with the moment the sine between the sliders (PP)";
/// What the singular values are of.
pub const SINGULAR_VALUE_SCALING: &str =
    "of scaled_pose_matrix: A with moments over the characteristic length, each row then divided by its own length";
const INPUT_SCALING: &str = "of B with rows divided as those of A, columns by the sizes of the actuated screws";
const DEXTERITY_SCALING: &str = "smallest over largest singular value of inverse(B) A diag(1, 1, 1/characteristic length), inputs in their own units";

#[derive(Clone, Debug, PartialEq, Serialize)]
struct ReadingReport {
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    point: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    direction: Option<[f64; 2]>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct BothWays {
    given: [f64; 3],
    inputs_if_pose: Answer,
    pose_if_inputs: Answer,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct WrenchReport {
    given: [f64; 3],
    actuator_forces: Answer,
}

/// Three numbers, or why there are none.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
enum Answer {
    Found([f64; 3]),
    Singular { singular: String },
}

impl From<Result<Vector3<f64>, SingularMatrix>> for Answer {
    fn from(answer: Result<Vector3<f64>, SingularMatrix>) -> Self {
        match answer {
            Ok(found) => Self::Found(found.into()),
            Err(error) => Self::Singular { singular: error.to_string() },
        }
    }
}

impl VelocityReport {
    /// The report on a pose in motion.
    pub fn new(
        velocity: &Velocity,
        (signs, choice): (&str, ModeChoice),
        singularity: &Singularity,
        motion: &Motion,
    ) -> Self {
        let rows = |m: &Matrix3<f64>| std::array::from_fn(|r| std::array::from_fn(|c| m[(r, c)]));
        let reading = |reading: Reading| match reading {
            Reading::Meet { point } => ReadingReport { kind: "meet", point: Some(point.into()), direction: None },
            Reading::Parallel { direction } => {
                ReadingReport { kind: "parallel", point: None, direction: Some(direction.into()) }
            }
            Reading::OneLine { direction } => {
                ReadingReport { kind: "one line", point: None, direction: Some(direction.into()) }
            }
        };
        let rates = |given: Vector3<f64>| BothWays {
            given: given.into(),
            inputs_if_pose: velocity.input_rates(&given).into(),
            pose_if_inputs: velocity.pose_rates(&given).into(),
        };
        let at = motion.rates.unwrap_or_else(Vector3::zeros);
        let accelerations = |given: Vector3<f64>| BothWays {
            given: given.into(),
            inputs_if_pose: velocity.input_accelerations(&at, &given).into(),
            pose_if_inputs: velocity.pose_accelerations(&at, &given).into(),
        };
        let wrench = |given: Vector3<f64>| WrenchReport {
            given: given.into(),
            actuator_forces: velocity.actuator_forces(&given).into(),
        };
        Self {
            schema: "assur/velocity/1",
            pose: numbers(&velocity.pose),
            signs: signs.to_owned(),
            mode_choice: choice.name(),
            joints: velocity.joints.clone(),
            pose_matrix: rows(&velocity.pose_matrix),
            input_matrix: rows(&velocity.input_matrix),
            row_legs: velocity.row_legs,
            row_scaling: ROW_SCALING,
            det_pose: velocity.pose_matrix.determinant(),
            det_input: velocity.input_matrix.determinant(),
            singularity: singularity.kind.name(),
            legs: singularity.legs.clone(),
            idle_legs: singularity.idle_legs.clone(),
            reading: singularity.reading.map(reading),
            free_motion: singularity.free_motion.map(Into::into),
            sigma_min: singularity.sigma_min,
            sigma_min_input: singularity.sigma_min_input,
            singular_values: singularity.singular_values,
            scaled_pose_matrix: singularity
                .scaled_pose_matrix
                .row_iter()
                .map(|row| std::array::from_fn(|c| row[c]))
                .collect(),
            dexterity: singularity.dexterity,
            characteristic_length: singularity.characteristic_length,
            scaling: ScalingReport {
                pose_matrix: ROW_SCALING,
                singular_values: SINGULAR_VALUE_SCALING,
                sigma_min_input: INPUT_SCALING,
                dexterity: DEXTERITY_SCALING,
            },
            rates: motion.rates.map(rates),
            accelerations: motion.accelerations.map(accelerations),
            wrench: motion.wrench.map(wrench),
        }
    }

    /// The report as a JSON document, ending in a newline.
    pub fn to_json(&self) -> String {
        super::report::json(self)
    }
}

pub(super) fn numbers(pose: &Pose) -> [f64; 3] {
    [pose.x, pose.y, pose.phi]
}
