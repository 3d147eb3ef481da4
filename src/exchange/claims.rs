//! Reports read back: poses that somebody claims, and what is proved of them.

use std::path::Path;

use serde::Serialize;

use super::error::FileError;
use super::model::{ModelFile, read_text};
use super::reader::Field;
use super::report::{CertificateReport, proof};
use super::tree::Tree;
use super::triad_file::TriadFile;
use crate::linkage::{Assemblies, Judgement, Pose, Triad};

/// Poses that a report claims for some inputs. Angles in radians.
///
/// A report of ours, or any JSON or TOML file with `inputs` and either `modes` (tables with a `pose`) or `poses`, a list of `[x, y, phi]`.
#[derive(Clone, Debug, PartialEq)]
pub struct ClaimedPoses {
    /// The actuator values; empty for a triad.
    pub inputs: Vec<f64>,
    /// The poses.
    pub poses: Vec<Pose>,
}

impl ClaimedPoses {
    /// Reads a report; `-` is standard input.
    ///
    /// # Errors
    /// One line that names file, field and value.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        Self::parse(&read_text(path)?, &path.display().to_string())
    }

    /// The claims of a report's text; `file` is its name in messages.
    ///
    /// # Errors
    /// As [`ClaimedPoses::read`].
    pub fn parse(text: &str, file: &str) -> Result<Self, FileError> {
        let tree = Tree::parse(text, file)?;
        // Reports of other programs may say more than is understood here.
        let root = Field::root(&tree, file).open_table()?;
        let inputs = match root.get("inputs") {
            Some(inputs) => inputs.list("a list of numbers")?.iter().map(Field::number).collect::<Result<_, _>>()?,
            None => Vec::new(),
        };
        let pose = |field: &Field| -> Result<Pose, FileError> {
            let [x, y, phi] = field.array("x, y, phi")?;
            Ok(Pose::new(x.number()?, y.number()?, phi.number()?))
        };
        let poses = match root.get("poses") {
            Some(poses) => poses.list("a list of poses")?.iter().map(pose).collect::<Result<_, _>>()?,
            None => {
                let modes = root.need("modes", "a list of assembly modes")?.list("a list of assembly modes")?;
                let of_mode = |mode: &Field| pose(&mode.open_table()?.need("pose", "x, y, phi")?);
                modes.iter().map(of_mode).collect::<Result<_, _>>()?
            }
        };
        Ok(Self { inputs, poses })
    }
}

/// What a report may be about: a model file, or a triad problem file.
#[derive(Clone, Debug)]
pub enum Subject {
    /// A manipulator.
    Model(ModelFile),
    /// A triad.
    Triad(Triad),
}

impl Subject {
    /// Reads a file of either kind, as its `schema` says; `-` is standard input.
    ///
    /// # Errors
    /// As [`ModelFile::read`] and [`super::read_triad`].
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let (text, file) = (read_text(path)?, path.display().to_string());
        let tree = Tree::parse(&text, &file)?;
        let is_triad = match &tree {
            Tree::Table(entries) => entries
                .iter()
                .any(|(key, value)| key == "schema" && matches!(value, Tree::Text(name) if name.contains("triad"))),
            _ => false,
        };
        if is_triad {
            TriadFile::parse(&text, &file).map(Self::Triad)
        } else {
            ModelFile::parse(&text, &file).map(Self::Model)
        }
    }
}

/// What is proved of claimed poses, as one JSON document.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct VerifyReport {
    schema: &'static str,
    /// How far a claim may be from a mode: radians, and displacements over the group's size.
    pub tolerance: f64,
    /// The claims, in their order.
    pub claims: Vec<ClaimReport>,
    /// The modes that no claim is near.
    pub missing: Vec<MissingReport>,
    /// What is proved of the whole.
    pub certificate: Option<CertificateReport>,
}

/// A claimed pose and its verdict.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClaimReport {
    /// `[x, y, phi]` as claimed.
    pub pose: [f64; 3],
    /// `proven`, `refuted` or `undecided`.
    pub verdict: &'static str,
    /// The pose it stands for, or else the nearest, from 1: poses in the order of `assur forward`, each once however many ways free legs stand in it.
    pub nearest: Option<usize>,
    /// The claim, from 1, that already stands for that pose.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub repeats: Option<usize>,
    /// How far it is; `null` where there is no mode.
    pub distance: Option<f64>,
}

/// A mode that a report lacks.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MissingReport {
    /// Its number, from 1, as in [`ClaimReport::nearest`].
    pub mode: usize,
    /// `[x, y, phi]`.
    pub pose: [f64; 3],
    /// A box that holds it and no other.
    #[serde(rename = "box")]
    pub pose_box: Option<[[f64; 2]; 3]>,
}

impl VerifyReport {
    /// The report on claims about a group that has been certified.
    pub fn of(group: &Assemblies, judgement: &Judgement, tolerance: f64) -> Self {
        let claims = judgement.claims.iter().map(|claim| ClaimReport {
            pose: [claim.pose.x, claim.pose.y, claim.pose.phi],
            verdict: proof(claim.verdict),
            nearest: claim.nearest.map(|mode| mode + 1),
            repeats: claim.repeats.map(|claim| claim + 1),
            distance: claim.nearest.map(|_| claim.distance),
        });
        let missing = judgement.missing.iter().map(|&mode| {
            let found = &group.modes[mode];
            let pose = [found.pose.x, found.pose.y, found.pose.phi];
            MissingReport { mode: mode + 1, pose, pose_box: found.pose_box }
        });
        Self {
            schema: "assur/verify/1",
            tolerance,
            claims: claims.collect(),
            missing: missing.collect(),
            certificate: group.certificate.as_ref().map(CertificateReport::from),
        }
    }

    /// The report as a JSON document, ending in a newline.
    ///
    /// # Panics
    /// Never: the report is plain numbers and texts.
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("a report is plain numbers and texts");
        text.push('\n');
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn claims_are_read_from_both_forms_and_errors_name_the_field() {
        let ours = r#"{"schema":"assur/forward/1","inputs":[1,2,3],"modes":[{"pose":[1,2,0.5],"residual":0}]}"#;
        let theirs = r#"{"program":"other","inputs":[1,2,3],"poses":[[1,2,0.5]]}"#;
        let claims = ClaimedPoses::parse(ours, "a.json").expect("reads");
        assert_eq!(claims, ClaimedPoses { inputs: vec![1.0, 2.0, 3.0], poses: vec![Pose::new(1.0, 2.0, 0.5)] });
        assert_eq!(ClaimedPoses::parse(theirs, "b.json").expect("reads"), claims);
        let error = ClaimedPoses::parse(r#"{"poses":[[1,2]]}"#, "c.json").unwrap_err().to_string();
        assert_eq!(error, "c.json: poses[0]: [1, 2] must be x, y, phi, has 2");
    }
}
