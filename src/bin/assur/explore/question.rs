//! What a page can ask, and the form of answers: `{"id": n, "answer": {..}}` or `{"id": n, "error": "one line"}`. Angles in radians.

use std::time::Instant;

use assur::Manipulator;
use assur::exchange::{AngleUnit, CouplerFile, ModelFile, parse_group};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::linkages::{FourBarQuestion, TrussQuestion};
use super::manipulator::{LociQuestion, MoveQuestion, PlaneQuestion, ProveQuestion};
use super::start::Start;
use super::workspace::RegionQuestion;
use super::{linkages, manipulator, workspace};
use crate::tables;

/// A question with the number its answer will carry.
#[derive(Deserialize)]
pub(crate) struct Envelope {
    pub(crate) id: u64,
    #[serde(flatten)]
    question: Question,
}

#[derive(Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case")]
enum Question {
    /// What to show first.
    Start,
    /// A model of a family.
    New {
        family: String,
    },
    /// A file's text.
    Open {
        text: String,
        file: String,
    },
    /// A model as the text of a file.
    Write {
        model: Value,
    },
    Move(Box<MoveQuestion>),
    Prove(ProveQuestion),
    Loci(LociQuestion),
    Plane(PlaneQuestion),
    Workspace(RegionQuestion),
    FourBar(FourBarQuestion),
    Truss(TrussQuestion),
}

impl Envelope {
    /// The question in a message; where it is none, why, and the number of what was asked if that can be read.
    pub(crate) fn parse(text: &str) -> Result<Self, (Option<u64>, String)> {
        #[derive(Deserialize)]
        struct Number {
            id: u64,
        }
        serde_json::from_str(text).map_err(|error| {
            let id = serde_json::from_str(text).ok().map(|Number { id }| id);
            (id, format!("the question cannot be read: {error}"))
        })
    }

    /// Whether the answer may take longer than a frame.
    pub(crate) fn is_slow(&self) -> bool {
        use Question::{Loci, Plane, Prove, Workspace};
        matches!(self.question, Prove(_) | Loci(_) | Plane(_) | Workspace(_))
    }
}

/// The answer, as the text of a message.
pub(crate) fn answer(envelope: Envelope, start: &Start) -> String {
    let began = Instant::now();
    let answer = match envelope.question {
        Question::Start => {
            let mut document = start.opened.to_json();
            document["families"] = json!(families());
            document["largest_message"] = json!(super::server::LARGEST_MESSAGE);
            Ok(document)
        }
        Question::New { family } => Opened::family(&family, AngleUnit::Deg).map(|opened| opened.to_json()),
        Question::Open { text, file } => Opened::read(&text, &file).map(|opened| opened.to_json()),
        Question::Write { model } => read_model(&model).map(|model| json!({ "text": model.to_toml() })),
        Question::Move(question) => manipulator::moved(&question),
        Question::Prove(question) => manipulator::proved(&question),
        Question::Loci(question) => manipulator::loci(&question),
        Question::Plane(question) => manipulator::plane(&question),
        Question::Workspace(question) => workspace::region(&question),
        Question::FourBar(question) => linkages::four_bar(&question),
        Question::Truss(question) => linkages::truss(&question),
    };
    match answer {
        Ok(answer) => {
            let micros = u64::try_from(began.elapsed().as_micros()).unwrap_or(u64::MAX);
            json!({ "id": envelope.id, "micros": micros, "answer": answer }).to_string()
        }
        Err(error) => refuse(Some(envelope.id), &error),
    }
}

pub(crate) fn refuse(id: Option<u64>, error: &str) -> String {
    json!({ "id": id, "error": error }).to_string()
}

/// Families to start from.
pub(crate) fn families() -> [&'static str; 8] {
    ["3-RPR", "3-RRR", "3-PRR", "3-RRP", "3-PRP", "3-PPR", "3-RPP", "R_P_R,_P_RR,_R_RP"]
}

/// A model in a message, read as the file it is.
pub(crate) fn read_model(model: &Value) -> Result<ModelFile, String> {
    ModelFile::parse(&model.to_string(), "model.json").map_err(|error| error.to_string())
}

/// A model as messages carry it.
pub(crate) fn model_value(model: &ModelFile) -> Value {
    serde_json::from_str(&model.to_json()).expect("what is written can be read")
}

/// A problem to show, of one of the page's three kinds.
#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub(crate) enum Opened {
    Manipulator { model: Value, inputs: Vec<f64> },
    FourBar { file: Value },
    Truss { file: Value },
}

impl Opened {
    pub(crate) fn manipulator(model: ModelFile, inputs: Option<Vec<f64>>) -> Self {
        let robot = &model.manipulator;
        // Without a mode anywhere it is shown all the same, at inputs that its limits allow.
        let without_mode = || robot.inputs_within_limits(&vec![0.0; robot.actuated_joints().count()]);
        let inputs = inputs.or_else(|| robot.sample_inputs()).unwrap_or_else(without_mode);
        Self::Manipulator { model: model_value(&model), inputs }
    }

    pub(crate) fn family(family: &str, angle_unit: AngleUnit) -> Result<Self, String> {
        let (manipulator, inputs) = Manipulator::of_family(family).map_err(|error| error.to_string())?;
        Ok(Self::manipulator(ModelFile { manipulator, angle_unit }, Some(inputs.to_vec())))
    }

    /// The problem in a file's text, by what the file calls itself.
    pub(crate) fn read(text: &str, file: &str) -> Result<Self, String> {
        let tree = plain(text);
        let schema = tree.as_ref().and_then(|tree| tree["schema"].as_str());
        match (schema, &tree) {
            (Some("assur/coupler/1"), Some(tree)) => {
                CouplerFile::parse(text, file).map_err(|error| error.to_string())?;
                Ok(Self::FourBar { file: tree.clone() })
            }
            (Some("assur/group/1"), Some(tree)) => {
                parse_group(text, file).map_err(|error| error.to_string())?;
                Ok(Self::Truss { file: tree.clone() })
            }
            _ => {
                let model = ModelFile::parse(text, file).map_err(|error| error.to_string())?;
                Ok(Self::manipulator(model, None))
            }
        }
    }

    /// Begun at these inputs, angles in the model's unit, if there are any. Refused where no group is left to assemble.
    pub(crate) fn begun_at(self, given: &[f64]) -> Result<Self, String> {
        let Self::Manipulator { model, inputs } = self else {
            let refused = "it has no actuators, so --inputs does not go with it";
            return if given.is_empty() { Ok(self) } else { Err(refused.to_owned()) };
        };
        let ModelFile { manipulator: robot, angle_unit } = read_model(&model)?;
        let inputs = if given.is_empty() { inputs } else { tables::inputs_in_radians(&robot, given, angle_unit) };
        robot.lock(&inputs).map_err(|error| angle_unit.of_lock_error(&robot, error).to_string())?;
        Ok(Self::Manipulator { model, inputs })
    }

    pub(crate) fn to_json(&self) -> Value {
        serde_json::to_value(self).expect("plain data with text keys")
    }
}

/// A file's text, TOML or JSON, as plain data.
fn plain(text: &str) -> Option<Value> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    serde_json::from_str(text).ok().or_else(|| toml::from_str(text).ok())
}
