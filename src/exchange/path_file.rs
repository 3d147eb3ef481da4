//! Rows of inputs along a path, read from CSV or JSON lines; the followed path as JSON, CSV or JSON lines.

use std::fmt::Write;
use std::path::Path;

use serde::Serialize;
use thiserror::Error;

use super::error::FileError;
use super::model::{AngleUnit, read_text};
use super::motion_report::numbers;
use super::report::ViolationReport;
use crate::manipulator::{FollowedPath, Manipulator, PathEvent, PathEventKind, PathRow};

/// Why a file holds no rows of inputs. Prints as one line.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PathFileError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The first line does not name the inputs.
    #[error("{file}: header \"{found}\" must be \"{expected}\"")]
    Header {
        /// The file.
        file: String,
        /// The line found.
        found: String,
        /// What it must be.
        expected: String,
    },
    /// A row has another number of values.
    #[error("{file}: row {row}: {found} values, must be {expected}")]
    Count {
        /// The file.
        file: String,
        /// Row of data, from 1.
        row: usize,
        /// How many values it has.
        found: usize,
        /// How many it must have.
        expected: usize,
    },
    /// A value is no finite number.
    #[error("{file}: row {row}: q{input}: \"{found}\" must be a finite number")]
    Value {
        /// The file.
        file: String,
        /// Row of data, from 1.
        row: usize,
        /// Input, from 1.
        input: usize,
        /// The text found.
        found: String,
    },
    /// A named value is no finite number.
    #[error("{file}: row {row}: {name}: \"{found}\" must be a finite number")]
    Named {
        /// The file.
        file: String,
        /// Row of data, from 1.
        row: usize,
        /// The column.
        name: &'static str,
        /// The text found.
        found: String,
    },
}

/// Reads rows of inputs for a manipulator: CSV with the header `q1,q2,q3`, or JSON lines of lists where the name ends in `.jsonl`; angles in `unit`.
///
/// # Errors
/// The first bad row, with its number and value.
///
/// ```
/// use assur::{Manipulator, exchange::{AngleUnit, parse_path}};
/// let (robot, _) = Manipulator::of_family("3-RPR")?;
/// let rows = parse_path("q1,q2,q3\n1,2,3\n1.5,2,3\n", "path.csv", &robot, AngleUnit::Rad)?;
/// assert_eq!(rows[1], [1.5, 2.0, 3.0]);
/// let error = parse_path("q1,q2,q3\n1,2,3\n1,x,3\n", "path.csv", &robot, AngleUnit::Rad).unwrap_err();
/// assert_eq!(error.to_string(), "path.csv: row 2: q2: \"x\" must be a finite number");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn parse_path(
    text: &str,
    file: &str,
    robot: &Manipulator,
    unit: AngleUnit,
) -> Result<Vec<Vec<f64>>, PathFileError> {
    let kinds: Vec<_> = robot.actuated_joints().map(|(leg, joint)| robot.legs[leg].joints[joint]).collect();
    let file = || file.to_owned();
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let json = file().ends_with(".jsonl");
    if !json {
        let expected = (1..=kinds.len()).map(|k| format!("q{k}")).collect::<Vec<_>>().join(",");
        let found = lines.next().unwrap_or_default().to_owned();
        let names = found.trim_start_matches('\u{feff}').split(',').map(str::trim).collect::<Vec<_>>().join(",");
        if names != expected {
            return Err(PathFileError::Header { file: file(), found, expected });
        }
    }
    (1..)
        .zip(lines)
        .map(|(row, line)| {
            let line = if json { line.trim_start_matches('[').trim_end_matches(']') } else { line };
            let values: Vec<&str> = line.split(',').map(str::trim).collect();
            let (found, expected) = (values.len(), kinds.len());
            if found != expected {
                return Err(PathFileError::Count { file: file(), row, found, expected });
            }
            let value = |(input, (text, &kind)): (usize, (&&str, &crate::manipulator::JointKind))| {
                let bad = || PathFileError::Value { file: file(), row, input, found: (*text).to_owned() };
                let value = text.parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(bad)?;
                Ok(unit.joint_to_rad(kind, value))
            };
            (1..).zip(values.iter().zip(&kinds)).map(value).collect()
        })
        .collect()
}

/// [`parse_path`] of a file; `-` is standard input.
///
/// # Errors
/// As [`parse_path`]; a file that cannot be read.
pub fn read_path(path: &Path, robot: &Manipulator, unit: AngleUnit) -> Result<Vec<Vec<f64>>, PathFileError> {
    parse_path(&read_text(path)?, &path.display().to_string(), robot, unit)
}

/// A followed path. Angles in radians.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PathReport {
    schema: &'static str,
    /// Whether the last row was reached.
    pub complete: bool,
    rows: Vec<RowReport>,
    events: Vec<EventReport>,
    closed_in: Option<usize>,
    distance_to_meeting: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct RowReport {
    step: usize,
    inputs: Vec<f64>,
    pose: [f64; 3],
    id: usize,
    det_a: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct EventReport {
    at: f64,
    kind: &'static str,
    inputs: Vec<f64>,
    pose: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    violation: Option<ViolationReport>,
    #[serde(skip_serializing_if = "Option::is_none")]
    leaves: Option<bool>,
    /// Where the path stops on a curve of poses.
    #[serde(skip_serializing_if = "Option::is_none")]
    self_motion: Option<CurveOfPoses>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct CurveOfPoses {
    /// The orientation of a translation; `null` where the platform turns.
    phi: Option<f64>,
}

impl From<&PathRow> for RowReport {
    fn from(row: &PathRow) -> Self {
        Self { step: row.step, inputs: row.inputs.clone(), pose: numbers(&row.pose), id: row.id, det_a: row.det_a }
    }
}

impl From<&PathEvent> for EventReport {
    fn from(event: &PathEvent) -> Self {
        let (violation, leaves) = match &event.kind {
            PathEventKind::Limit { violation, leaves } => (Some(ViolationReport::from(violation)), Some(*leaves)),
            _ => (None, None),
        };
        let self_motion = match event.kind {
            PathEventKind::SelfMotion { phi } => Some(CurveOfPoses { phi }),
            _ => None,
        };
        let (inputs, pose) = (event.inputs.clone(), numbers(&event.pose));
        Self { at: event.at, kind: event.kind.name(), inputs, pose, violation, leaves, self_motion }
    }
}

impl From<&FollowedPath> for PathReport {
    fn from(path: &FollowedPath) -> Self {
        Self {
            schema: "assur/path/1",
            complete: path.complete,
            rows: path.rows.iter().map(RowReport::from).collect(),
            events: path.events.iter().map(EventReport::from).collect(),
            closed_in: path.closed_in,
            distance_to_meeting: path.distance_to_meeting(1),
        }
    }
}

impl PathReport {
    /// The report as a JSON document, ending in a newline.
    pub fn to_json(&self) -> String {
        super::report::json(self)
    }

    /// The rows as JSON, one a line.
    pub fn to_json_lines(&self) -> String {
        let line = |row: &RowReport| serde_json::to_string(row).expect("a row is plain numbers") + "\n";
        self.rows.iter().map(line).collect()
    }

    /// The rows as CSV with the header `step,q1,q2,q3,x,y,phi,id,det_a`.
    pub fn to_csv(&self) -> String {
        let mut text = "step,q1,q2,q3,x,y,phi,id,det_a\n".to_owned();
        for row in &self.rows {
            let numbers = row.inputs.iter().chain(&row.pose).map(f64::to_string).collect::<Vec<_>>().join(",");
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{},{numbers},{},{}", row.step, row.id, row.det_a);
        }
        text
    }
}
