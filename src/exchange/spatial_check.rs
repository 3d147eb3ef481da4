//! What the model file of a spatial robot describes, before any pose is known.

use std::path::Path;

use serde::Serialize;

use super::check::{CheckReport, RemarkReport};
use super::error::FileError;
use super::model::{ModelFile, read_text};
use super::multipteron_file::MultipteronFile;
use super::spatial_file::{HanaFile, TripodFile};
use super::tree::Tree;
use crate::spatial::SpatialRemark;

/// The answer to `check` for a model file of any kind.
#[derive(Clone, Debug, PartialEq)]
pub enum AnyCheck {
    /// A planar manipulator.
    Planar(CheckReport),
    /// A spatial robot.
    Spatial(SpatialCheckReport),
}

/// The answer to `check` for a spatial robot.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SpatialCheckReport {
    schema: &'static str,
    /// The name for people.
    pub name: String,
    /// `HANA`, `three-legged 6-DOF robot`.
    pub family: &'static str,
    /// The unit of angles in the file.
    pub angle_unit: &'static str,
    /// Degrees of freedom.
    pub degrees_of_freedom: usize,
    /// Working modes: how many sets of inputs one pose can have.
    pub working_modes: usize,
    /// How many assembly modes there can be at most.
    pub degree_bound: usize,
    /// Named numbers of the model, for people.
    #[serde(serialize_with = "as_map")]
    pub numbers: Vec<(&'static str, String)>,
    /// What deserves a word.
    pub remarks: Vec<RemarkReport>,
}

fn as_map<S: serde::Serializer>(numbers: &[(&'static str, String)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(numbers.iter().map(|(name, value)| (name, value)))
}

impl AnyCheck {
    /// Reads a model file of any kind, as its `schema` says; `-` is standard input.
    ///
    /// # Errors
    /// One line that names file, leg, field and value.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let (text, file) = (read_text(path)?, path.display().to_string());
        Self::parse(&text, &file)
    }

    /// The model in a text; `file` is what errors call it.
    ///
    /// # Errors
    /// As [`AnyCheck::read`].
    ///
    /// ```
    /// use assur::exchange::AnyCheck;
    /// let text = "schema = \"assur/hana/1\"\nr = 3\nR = 12\nL = 15\nL3 = 15\nstrokes = [-3, 3]";
    /// let AnyCheck::Spatial(report) = AnyCheck::parse(text, "hana.toml").unwrap() else { panic!() };
    /// assert_eq!((report.family, report.degree_bound, report.remarks.len()), ("HANA", 8, 0));
    /// ```
    pub fn parse(text: &str, file: &str) -> Result<Self, FileError> {
        let tree = Tree::parse(text, file)?;
        let says = |kind: &str| match &tree {
            Tree::Table(entries) => entries
                .iter()
                .any(|(key, value)| key == "schema" && matches!(value, Tree::Text(name) if name.contains(kind))),
            _ => false,
        };
        let remarks = |found: Vec<SpatialRemark>| -> Vec<RemarkReport> {
            let report = |remark: SpatialRemark| RemarkReport { name: remark.name, leg: remark.leg, text: remark.text };
            found.into_iter().map(report).collect()
        };
        if says("assur/hana/") {
            let HanaFile { robot, angle_unit } = HanaFile::parse(text, file)?;
            let strokes = robot.strokes.map(|[low, high]| format!("[{low}, {high}]")).join(" ");
            return Ok(Self::Spatial(SpatialCheckReport {
                schema: "assur/check/1",
                name: robot.name.clone(),
                family: "HANA",
                angle_unit: angle_unit.name(),
                degrees_of_freedom: 3,
                working_modes: 8,
                degree_bound: 8,
                numbers: vec![
                    ("r", robot.platform_radius.to_string()),
                    ("R", robot.base_radius.to_string()),
                    ("L", robot.link.to_string()),
                    ("L3", robot.third_link.to_string()),
                    ("strokes", strokes),
                ],
                remarks: remarks(robot.remarks()),
            }));
        }
        if says("assur/tripod/") {
            let TripodFile { robot, angle_unit } = TripodFile::parse(text, file)?;
            let list = |strokes: &[[f64; 2]; 6]| strokes.map(|[low, high]| format!("[{low}, {high}]")).join(" ");
            let limit = robot.plane_angle_limit.map(|limit| angle_unit.from_rad(limit).to_string());
            return Ok(Self::Spatial(SpatialCheckReport {
                schema: "assur/check/1",
                name: robot.name.clone(),
                family: match robot.degrees_of_freedom() {
                    6 => "three-legged 6-DOF robot",
                    5 => "three-legged robot, 5-DOF variant",
                    4 => "three-legged robot, 4-DOF variant",
                    _ => "three-legged robot, 3-DOF variant",
                },
                angle_unit: angle_unit.name(),
                degrees_of_freedom: robot.degrees_of_freedom(),
                working_modes: 1,
                degree_bound: 8,
                numbers: vec![
                    ("strokes", robot.strokes.as_ref().map_or("unlimited".to_owned(), list)),
                    (
                        "plane angles",
                        limit.map_or("unlimited".to_owned(), |limit| format!("within {limit} {}", angle_unit.name())),
                    ),
                ],
                remarks: remarks(robot.remarks()),
            }));
        }
        if says("assur/multipteron/") {
            let MultipteronFile { name, robot, angle_unit } = MultipteronFile::parse(text, file)?;
            return Ok(Self::Spatial(SpatialCheckReport {
                schema: "assur/check/1",
                name,
                family: robot.name(),
                angle_unit: angle_unit.name(),
                degrees_of_freedom: robot.degrees_of_freedom(),
                working_modes: 1,
                degree_bound: robot.degree(),
                numbers: Vec::new(),
                remarks: Vec::new(),
            }));
        }
        ModelFile::parse(text, file).map(|model| Self::Planar(CheckReport::of(&model)))
    }

    /// The report as a JSON document, ending in a newline.
    ///
    /// # Panics
    /// Never: the report is plain numbers and texts.
    pub fn to_json(&self) -> String {
        match self {
            Self::Planar(report) => report.to_json(),
            Self::Spatial(report) => {
                let mut text = serde_json::to_string_pretty(report).expect("a report is plain numbers and texts");
                text.push('\n');
                text
            }
        }
    }
}
