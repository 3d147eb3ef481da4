//! Model files: a manipulator and the unit its angles are written in.

use std::path::Path;

use nalgebra::Vector2;

use super::error::{FieldProblem, FileError};
use super::reader::{Field, Table};
use super::tree::Tree;
use crate::manipulator::{DescriptionError, JointKind, Leg, LockError, Manipulator, Placement};

/// What a model file calls itself.
pub(super) const SCHEMA: &str = "assur/manipulator/1";

/// The unit of every angle of a model file and of the command line with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum AngleUnit {
    /// Radians.
    #[default]
    Rad,
    /// Degrees.
    Deg,
}

impl AngleUnit {
    /// `rad` or `deg`, as files write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rad => "rad",
            Self::Deg => "deg",
        }
    }

    /// An angle of this unit in radians.
    pub fn to_rad(self, angle: f64) -> f64 {
        match self {
            Self::Rad => angle,
            Self::Deg => angle.to_radians(),
        }
    }

    /// Radians in this unit.
    pub fn from_rad(self, angle_rad: f64) -> f64 {
        match self {
            Self::Rad => angle_rad,
            Self::Deg => angle_rad.to_degrees(),
        }
    }

    /// A frame at a point, turned by an angle in this unit; exact at quarter turns.
    pub fn placement(self, at: Vector2<f64>, angle: f64) -> Placement {
        match self {
            Self::Rad => Placement::turned(at.x, at.y, angle),
            Self::Deg => Placement::turned_deg(at.x, at.y, angle),
        }
    }

    /// A joint value, given in this unit if it is an angle, in radians or length units.
    pub fn joint_to_rad(self, kind: JointKind, value: f64) -> f64 {
        match kind {
            JointKind::Revolute => self.to_rad(value),
            JointKind::Prismatic => value,
        }
    }

    /// A joint value, in radians or length units, in this unit if it is an angle.
    pub fn joint_from_rad(self, kind: JointKind, value: f64) -> f64 {
        match kind {
            JointKind::Revolute => self.from_rad(value),
            JointKind::Prismatic => value,
        }
    }

    /// What is wrong with inputs, angles in this unit.
    pub fn of_lock_error(self, robot: &Manipulator, error: LockError) -> LockError {
        match error {
            LockError::OutOfRange { leg, joint, value, limit } => {
                let kind = robot.legs[leg - 1].joints[joint - 1];
                let written = |value| self.joint_from_rad(kind, value);
                LockError::OutOfRange { leg, joint, value: written(value), limit: limit.map(written) }
            }
            other => other,
        }
    }
}

/// A model file: the manipulator, and the unit its file and its users write angles in.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelFile {
    /// The manipulator; its angles are radians and directions.
    pub manipulator: Manipulator,
    /// The unit of angles in the file.
    pub angle_unit: AngleUnit,
}

impl ModelFile {
    /// Reads a model file, TOML or JSON by its ending; `-` is standard input.
    ///
    /// # Errors
    /// One line that names file, leg, field and value.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        Self::parse(&read_text(path)?, &path.display().to_string())
    }

    /// The model in a text; `file` is what errors call it, and its ending (`.toml`, `.json`) says what it is.
    ///
    /// # Errors
    /// As [`ModelFile::read`].
    ///
    /// ```
    /// use assur::exchange::ModelFile;
    /// let error = ModelFile::parse("schema = \"assur/manipulator/1\"\nlegs = []", "arm.toml").unwrap_err();
    /// assert_eq!(error.to_string(), "arm.toml: legs: unknown key; did you mean \"leg\"?");
    /// ```
    pub fn parse(text: &str, file: &str) -> Result<Self, FileError> {
        let tree = Tree::parse(text, file)?;
        Field::root(&tree, file).expect_kind(SCHEMA)?;
        let root = Field::root(&tree, file).table(&["schema", "name", "angle_unit", "reference", "leg"])?;
        root.need("schema", &format!("\"{SCHEMA}\""))?.one_of(&[SCHEMA])?;
        let name = root.get("name").map_or(Ok(""), |field| field.text("a text"))?;
        let angle_unit = match root.get("angle_unit").map(|field| field.one_of(&["rad", "deg"])).transpose()? {
            Some("deg") => AngleUnit::Deg,
            _ => AngleUnit::Rad,
        };
        let reference = root.get("reference").map_or(Ok(Vector2::zeros()), |field| field.vector())?;
        let fields = root.need("leg", "a list of three legs")?.legs()?;
        let legs = (1..).zip(fields).map(|(number, field)| read_leg(&field, number, angle_unit, file));
        let legs = legs.collect::<Result<_, _>>()?;
        let manipulator = Manipulator { name: name.to_owned(), reference, legs };
        manipulator.validate().map_err(|error| FileError::Description { file: file.to_owned(), error })?;
        Ok(Self { manipulator, angle_unit })
    }
}

/// The text of a file; `-` is standard input.
/// The text of a problem file; `-` is standard input.
///
/// # Errors
/// One line that names the file and says why it cannot be read.
pub fn read_problem(path: &Path) -> Result<String, FileError> {
    read_text(path)
}

pub(super) fn read_text(path: &Path) -> Result<String, FileError> {
    let text =
        if path == Path::new("-") { std::io::read_to_string(std::io::stdin()) } else { std::fs::read_to_string(path) };
    text.map_err(|error| FileError::Unreadable { file: path.display().to_string(), reason: error.to_string() })
}

fn read_leg(field: &Field, number: usize, unit: AngleUnit, file: &str) -> Result<Leg, FileError> {
    let table = field.table(&["joints", "base", "links", "platform", "limits", "passive_limits"])?;
    let joints = table.need("joints", "three letters R or P, as in \"R_P_R\"")?.text("a text such as \"R_P_R\"")?;
    let mut leg: Leg = joints.parse().map_err(|error| FileError::Description {
        file: file.to_owned(),
        error: DescriptionError::Joints { leg: number, error },
    })?;
    leg.base = read_placement(&table.need("base", "{ at = [x, y], angle = a }")?, unit, At::Needed)?;
    leg.platform = read_placement(&table.need("platform", "{ at = [x, y], angle = a }")?, unit, At::Needed)?;
    if let Some(links) = table.get("links") {
        let [first, second] = links.array("two links")?;
        leg.links = [read_link(&first, unit)?, read_link(&second, unit)?];
    }
    read_limits(&table, &mut leg, unit)?;
    Ok(leg)
}

/// Whether a placement has to say where it is.
#[derive(Clone, Copy)]
enum At {
    Needed,
    Origin,
}

fn read_placement(field: &Field, unit: AngleUnit, at: At) -> Result<Placement, FileError> {
    let table = field.table(&["at", "angle", "direction"])?;
    let at = match (table.get("at"), at) {
        (Some(at), _) => at.vector()?,
        (None, At::Origin) => Vector2::zeros(),
        (None, At::Needed) => table.need("at", "two numbers")?.vector()?,
    };
    match (table.get("angle"), table.get("direction")) {
        (Some(_), Some(_)) => Err(field.error(FieldProblem::Both { first: "angle", second: "direction" })),
        (Some(angle), None) => Ok(unit.placement(at, angle.number()?)),
        (None, Some(direction)) => Ok(Placement { at, direction: direction.vector()? }),
        (None, None) => Ok(Placement::at(at.x, at.y)),
    }
}

/// A link: a length along the local x axis, or a placement.
fn read_link(field: &Field, unit: AngleUnit) -> Result<Placement, FileError> {
    match field.tree() {
        Tree::Table(_) => read_placement(field, unit, At::Origin),
        Tree::Number(_) => Ok(Placement::at(field.number()?, 0.0)),
        other => Err(field.error(FieldProblem::Kind {
            expected: "a length or { at = [x, y], angle = a }".to_owned(),
            found: other.to_string(),
        })),
    }
}

fn read_limits(table: &Table, leg: &mut Leg, unit: AngleUnit) -> Result<(), FileError> {
    let kinds = leg.joints;
    let range = |joint: usize, field: &Field| -> Result<[f64; 2], FileError> {
        Ok(field.pair()?.map(|value| unit.joint_to_rad(kinds[joint], value)))
    };
    if let Some(field) = table.get("limits") {
        let drivers: Vec<usize> = (0..3).filter(|&joint| leg.actuated[joint]).collect();
        match (field.tree(), &drivers[..]) {
            (Tree::Table(_), _) => by_joint(&field, leg, true, &range)?,
            (_, &[driver]) => leg.limits[driver] = Some(range(driver, &field)?),
            (found, _) => {
                let (found, actuated) = (found.to_string(), drivers.len());
                return Err(field.error(FieldProblem::WhichJoint { found, actuated }));
            }
        }
    }
    if let Some(field) = table.get("passive_limits") {
        by_joint(&field, leg, false, &range)?;
    }
    Ok(())
}

/// Ranges by joint number, of the actuated joints or of the others.
fn by_joint(
    field: &Field,
    leg: &mut Leg,
    actuated: bool,
    range: &impl Fn(usize, &Field) -> Result<[f64; 2], FileError>,
) -> Result<(), FileError> {
    let table = field.table(&["1", "2", "3"])?;
    for (joint, key) in ["1", "2", "3"].into_iter().enumerate() {
        let Some(field) = table.get(key) else { continue };
        if leg.actuated[joint] != actuated {
            let (role, belongs) = if actuated { ("passive", "passive_limits") } else { ("actuated", "limits") };
            return Err(field.error(FieldProblem::OtherField { joint: joint + 1, role, belongs }));
        }
        leg.limits[joint] = Some(range(joint, &field)?);
    }
    Ok(())
}
