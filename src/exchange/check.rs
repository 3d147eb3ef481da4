//! What a model file describes, before any input is known.

use serde::Serialize;

use super::model::ModelFile;
use crate::manipulator::{Leg, Remark};

/// The answer to `check` as one JSON document.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CheckReport {
    schema: &'static str,
    /// The name for people.
    pub name: String,
    /// The family: `3-R_P_R`.
    pub family: String,
    /// The unit of angles in the file.
    pub angle_unit: &'static str,
    /// The legs.
    pub legs: Vec<LegReport>,
    /// The group that is left when the actuators are held; `null` where it is no triad.
    pub group: Option<String>,
    /// How many assembly modes there can be at most.
    pub degree_bound: Option<usize>,
    /// What deserves a word.
    pub remarks: Vec<RemarkReport>,
}

/// A leg as `check` names it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LegReport {
    /// Its joints, actuated ones between underscores.
    pub joints: String,
    /// Its actuated joints, from 1.
    pub actuated: Vec<usize>,
    /// The passive joints that are left: a dyad, where there are two.
    pub passive: String,
}

/// A remark as `check` writes it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RemarkReport {
    /// Its name.
    pub name: &'static str,
    /// The leg it is about, from 1; `null` where it is about all.
    pub leg: Option<usize>,
    /// In words.
    pub text: String,
}

impl CheckReport {
    /// What the model describes.
    ///
    /// ```
    /// use assur::{Manipulator, exchange::{AngleUnit, CheckReport, ModelFile}};
    /// let (manipulator, _) = Manipulator::of_family("3-PRP").unwrap();
    /// let report = CheckReport::of(&ModelFile { manipulator, angle_unit: AngleUnit::Deg });
    /// assert_eq!((report.group.as_deref(), report.degree_bound), (Some("RP-RP-RP"), Some(2)));
    /// ```
    pub fn of(model: &ModelFile) -> Self {
        let robot = &model.manipulator;
        let leg = |leg: &Leg| LegReport {
            joints: leg.name(),
            actuated: (0..3).filter(|&joint| leg.actuated[joint]).map(|joint| joint + 1).collect(),
            passive: leg.passive_joints(),
        };
        let remark = |remark: Remark| RemarkReport { name: remark.name(), leg: remark.leg(), text: remark.to_string() };
        Self {
            schema: "assur/check/1",
            name: robot.name.clone(),
            family: robot.family(),
            angle_unit: model.angle_unit.name(),
            legs: robot.legs.iter().map(leg).collect(),
            group: robot.group(),
            degree_bound: robot.degree_bound(),
            remarks: robot.remarks().into_iter().map(remark).collect(),
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
