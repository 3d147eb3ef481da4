//! Questions about workspaces as words of the command line: kinds with their angles, points from files.

use std::path::Path;

use thiserror::Error;

use super::model::{AngleUnit, read_text};
use super::path_file::PathFileError;
use crate::plane::PhiRange;
use crate::workspace::WorkspaceKind;

/// Why a text names no kind of workspace.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("\"{text}\": {reason}; kinds are constant:PHI, maximal, inclusive:FROM:TO, total:FROM:TO, dextrous")]
pub struct WorkspaceKindError {
    /// The text found.
    pub text: String,
    /// What is wrong with it.
    pub reason: String,
}

/// A kind of workspace in one word: `constant:PHI`, `maximal`, `inclusive:FROM:TO`, `total:FROM:TO`, `dextrous`; angles in `unit`.
///
/// A range from A to B runs counter-clockwise: A = B is that single orientation, a full turn or more is every orientation.
///
/// # Errors
/// Another name, another number of angles, an angle that is no finite number.
///
/// ```
/// use assur::exchange::{AngleUnit, parse_workspace_kind};
/// use assur::workspace::WorkspaceKind;
/// assert_eq!(parse_workspace_kind("maximal", AngleUnit::Deg), Ok(WorkspaceKind::Maximal));
/// let Ok(WorkspaceKind::Inclusive(range)) = parse_workspace_kind("inclusive:-10:20", AngleUnit::Deg) else { panic!() };
/// assert!((range.width - 30f64.to_radians()).abs() < 1e-15);
/// let error = parse_workspace_kind("total:5", AngleUnit::Deg).unwrap_err().to_string();
/// assert!(error.starts_with("\"total:5\": total has 1 angle, must have 2; kinds are "));
/// ```
pub fn parse_workspace_kind(text: &str, unit: AngleUnit) -> Result<WorkspaceKind, WorkspaceKindError> {
    let fail = |reason: String| WorkspaceKindError { text: text.to_owned(), reason };
    let mut words = text.split(':');
    let name = words.next().unwrap_or_default();
    let angles: Vec<f64> = words
        .map(|word| {
            let angle = word.parse::<f64>().ok().filter(|angle| angle.is_finite());
            angle.map(|angle| unit.to_rad(angle)).ok_or_else(|| fail(format!("\"{word}\" must be a finite angle")))
        })
        .collect::<Result<_, _>>()?;
    let wanted = match name {
        "constant" => 1,
        "inclusive" | "total" => 2,
        "maximal" | "dextrous" => 0,
        _ => return Err(fail("no such kind".to_owned())),
    };
    let count = angles.len();
    if count != wanted {
        return Err(fail(format!("{name} has {count} angle{}, must have {wanted}", if count == 1 { "" } else { "s" })));
    }
    Ok(match name {
        "constant" => WorkspaceKind::Constant { phi: angles[0] },
        "maximal" => WorkspaceKind::Maximal,
        "inclusive" => WorkspaceKind::Inclusive(PhiRange::between(angles[0], angles[1])),
        "total" => WorkspaceKind::Total(PhiRange::between(angles[0], angles[1])),
        _ => WorkspaceKind::Dextrous,
    })
}

/// Reads points: CSV with the header `x,y`, or JSON lines (`.jsonl`) of `[x, y]` or `{"x": .., "y": ..}`; `-` is standard input, CSV.
///
/// # Errors
/// The first bad row, with its number and value; a file that cannot be read.
pub fn read_points(path: &Path) -> Result<Vec<[f64; 2]>, PathFileError> {
    parse_points(&read_text(path)?, &path.display().to_string())
}

/// The points in a text; `file` is what errors call it, and its ending says what it is.
///
/// # Errors
/// As [`read_points`].
///
/// ```
/// use assur::exchange::parse_points;
/// assert_eq!(parse_points("x,y\n1,2\n3,4.5\n", "p.csv")?, [[1.0, 2.0], [3.0, 4.5]]);
/// assert_eq!(parse_points("[1, 2]\n{\"x\": 3, \"y\": 4.5}\n", "p.jsonl")?, [[1.0, 2.0], [3.0, 4.5]]);
/// let error = parse_points("x,y\n1,2\n1,far\n", "p.csv").unwrap_err();
/// assert_eq!(error.to_string(), "p.csv: row 2: y: \"far\" must be a finite number");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn parse_points(text: &str, file: &str) -> Result<Vec<[f64; 2]>, PathFileError> {
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let json = file.ends_with(".jsonl") || file.ends_with(".ndjson");
    if !json {
        let found = lines.next().unwrap_or_default().to_owned();
        let names = found.trim_start_matches('\u{feff}').split(',').map(str::trim).collect::<Vec<_>>().join(",");
        if names != "x,y" {
            return Err(PathFileError::Header { file: file.to_owned(), found, expected: "x,y".to_owned() });
        }
    }
    (1..).zip(lines).map(|(row, line)| if json { of_json(line, file, row) } else { of_csv(line, file, row) }).collect()
}

fn of_csv(line: &str, file: &str, row: usize) -> Result<[f64; 2], PathFileError> {
    let values: Vec<&str> = line.split(',').map(str::trim).collect();
    let &[x, y] = &values[..] else {
        return Err(PathFileError::Count { file: file.to_owned(), row, found: values.len(), expected: 2 });
    };
    let number = |name: &'static str, text: &str| {
        let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| PathFileError::Named { file: file.to_owned(), row, name, found: text.to_owned() })
    };
    Ok([number("x", x)?, number("y", y)?])
}

fn of_json(line: &str, file: &str, row: usize) -> Result<[f64; 2], PathFileError> {
    let bad = |name, found: String| PathFileError::Named { file: file.to_owned(), row, name, found };
    let value: serde_json::Value = serde_json::from_str(line).map_err(|_| bad("line", line.to_owned()))?;
    if let Some(list) = value.as_array()
        && list.len() != 2
    {
        return Err(PathFileError::Count { file: file.to_owned(), row, found: list.len(), expected: 2 });
    }
    let number = |name: &'static str, index: usize| {
        let entry = value.get(name).or_else(|| value.get(index));
        let number = entry.and_then(serde_json::Value::as_f64).filter(|value| value.is_finite());
        number.ok_or_else(|| bad(name, entry.map(ToString::to_string).unwrap_or_default()))
    };
    Ok([number("x", 0)?, number("y", 1)?])
}
