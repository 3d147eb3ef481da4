//! Model files and reports of the Multipterons.

use std::path::Path;

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::error::FileError;
use super::model::{AngleUnit, read_text};
use super::reader::Field;
use super::spatial_file::{angle_unit, name};
use super::spatial_report::{account, text, tripod_pose};
use super::tree::Tree;
use crate::spatial::{Multipteron, MultipteronPoses};

pub(super) const MULTIPTERON: &str = "assur/multipteron/1";

/// A model file of a Tripteron, Quadrupteron or Hexapteron.
#[derive(Clone, Debug, PartialEq)]
pub struct MultipteronFile {
    /// A name for people; may be empty.
    pub name: String,
    /// The robot.
    pub robot: Multipteron,
    /// The unit of angles on the command line.
    pub angle_unit: AngleUnit,
}

impl MultipteronFile {
    /// Reads a model file, TOML or JSON by its ending; `-` is standard input.
    ///
    /// # Errors
    /// One line that names file, field and value.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        Self::parse(&read_text(path)?, &path.display().to_string())
    }

    /// The model in a text; `file` is what errors call it.
    ///
    /// # Errors
    /// As [`MultipteronFile::read`].
    ///
    /// ```
    /// use assur::exchange::MultipteronFile;
    /// let text = "schema = \"assur/multipteron/1\"\nkind = \"tripteron\"\ndirections = [[1, 0, 0], [0, 1, 0], [1, 1, 0]]";
    /// let error = MultipteronFile::parse(text, "t.toml").unwrap_err();
    /// assert_eq!(
    ///     error.to_string(),
    ///     "t.toml: directions: they lie in a plane, so that the sliders do not determine the place"
    /// );
    /// ```
    pub fn parse(text: &str, file: &str) -> Result<Self, FileError> {
        let tree = Tree::parse(text, file)?;
        Field::root(&tree, file).expect_kind(MULTIPTERON)?;
        let known = ["schema", "name", "angle_unit", "kind", "directions", "points", "axis"];
        let root = Field::root(&tree, file).table(&known)?;
        root.need("schema", &format!("\"{MULTIPTERON}\""))?.one_of(&[MULTIPTERON])?;
        let kind = root.need("kind", "tripteron, quadrupteron or hexapteron")?.text("a name")?;
        let vectors = |field: &Field| -> Result<Vec<Vector3<f64>>, FileError> {
            field.list("a list of vectors")?.iter().map(|item| item.triple().map(Vector3::from)).collect()
        };
        let directions = vectors(&root.need("directions", "a list of vectors")?)?;
        let points = root.get("points").map_or(Ok(Vec::new()), |field| vectors(&field))?;
        let axis = root.get("axis").map(|field| field.triple().map(Vector3::from)).transpose()?;
        let robot = Multipteron::new(kind, &directions, &points, axis)
            .map_err(|error| FileError::Multipteron { file: file.to_owned(), error })?;
        Ok(Self { name: name(&root)?, robot, angle_unit: angle_unit(&root)? })
    }

    /// What stands above its answers: its name, or which member it is.
    pub fn title(&self) -> &str {
        if self.name.is_empty() { self.robot.name() } else { &self.name }
    }
}

/// Every pose of a Multipteron for slider positions.
pub fn multipteron_forward_json(robot: &Multipteron, inputs: &[f64], answer: &MultipteronPoses) -> String {
    let modes: Vec<Value> = answer.poses.iter().map(|pose| json!({ "pose": tripod_pose(pose) })).collect();
    text(&json!({
        "schema": "assur/multipteron-forward/1", "kind": robot.name(), "inputs": inputs, "modes": modes,
        "account": account(&answer.account),
    }))
}

/// The slider positions of a Multipteron for a pose.
pub fn multipteron_inverse_json(
    robot: &Multipteron,
    position: &Vector3<f64>,
    turn: &Vector3<f64>,
    inputs: &[f64],
) -> String {
    text(&json!({
        "schema": "assur/multipteron-inverse/1", "kind": robot.name(), "position": position.as_slice(), "rotation_vector": turn.as_slice(),
        "inputs": inputs,
    }))
}
