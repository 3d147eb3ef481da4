//! Model files of the two spatial robots.

use std::path::Path;

use nalgebra::Vector3;

use super::error::FileError;
use super::model::{AngleUnit, read_text};
use super::reader::{Field, Table};
use super::tree::Tree;
use crate::spatial::{Hana, SpatialError, Tripod, TripodError, TripodLeg};

const HANA: &str = "assur/hana/1";
const TRIPOD: &str = "assur/tripod/1";

/// A model file of HANA, with the unit of angles on the command line.
#[derive(Clone, Debug, PartialEq)]
pub struct HanaFile {
    /// The robot.
    pub robot: Hana,
    /// The unit of angles.
    pub angle_unit: AngleUnit,
}

/// A model file of a three-legged robot.
#[derive(Clone, Debug, PartialEq)]
pub struct TripodFile {
    /// The robot.
    pub robot: Tripod,
    /// The unit of angles in the file and on the command line.
    pub angle_unit: AngleUnit,
}

impl HanaFile {
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
    /// As [`HanaFile::read`].
    ///
    /// ```
    /// use assur::exchange::HanaFile;
    /// let text = "schema = \"assur/hana/1\"\nr = 3\nR = 12\nL = 15\nL3 = 15\nstrokes = [3, -3]";
    /// let error = HanaFile::parse(text, "hana.toml").unwrap_err();
    /// assert_eq!(error.to_string(), "hana.toml: strokes, leg 1: [3, -3] must run from the lower to the higher end");
    /// ```
    pub fn parse(text: &str, file: &str) -> Result<Self, FileError> {
        let tree = Tree::parse(text, file)?;
        Field::root(&tree, file).expect_kind(HANA)?;
        let root = Field::root(&tree, file).table(&["schema", "name", "angle_unit", "r", "R", "L", "L3", "strokes"])?;
        root.need("schema", &format!("\"{HANA}\""))?.one_of(&[HANA])?;
        let length = |key: &str| root.need(key, "a length")?.number();
        let strokes = root.need("strokes", "one range [a, b] or three")?.ranges()?;
        let robot = Hana {
            name: name(&root)?,
            platform_radius: length("r")?,
            base_radius: length("R")?,
            link: length("L")?,
            third_link: length("L3")?,
            strokes,
        };
        robot.validate().map_err(|error| unsound(file, error.into()))?;
        Ok(Self { robot, angle_unit: angle_unit(&root)? })
    }
}

impl TripodFile {
    /// Reads a model file, TOML or JSON by its ending; `-` is standard input.
    ///
    /// # Errors
    /// One line that names file, leg, field and value.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        Self::parse(&read_text(path)?, &path.display().to_string())
    }

    /// The model in a text; `file` is what errors call it.
    ///
    /// # Errors
    /// As [`TripodFile::read`].
    pub fn parse(text: &str, file: &str) -> Result<Self, FileError> {
        let tree = Tree::parse(text, file)?;
        Field::root(&tree, file).expect_kind(TRIPOD)?;
        let known = ["schema", "name", "angle_unit", "legs", "strokes", "tool", "tool_axis", "plane_angle_limit"];
        let root = Field::root(&tree, file).table(&known)?;
        root.need("schema", &format!("\"{TRIPOD}\""))?.one_of(&[TRIPOD])?;
        let angle_unit = angle_unit(&root)?;
        let fields = root.need("legs", "a list of three legs")?;
        let _: [Field; 3] = fields.array("a list of three legs")?;
        let (mut legs, mut one_motor) = (Vec::new(), [false; 3]);
        for (k, field) in fields.legs()?.into_iter().enumerate() {
            let table = field.table(&["u", "w", "v", "c", "Da", "Db", "motors"])?;
            let vector = |key: &str| Ok(Vector3::from(table.need(key, "three numbers")?.triple()?));
            if let Some(field) = table.get("motors") {
                let motors = field.number()?;
                one_motor[k] = motors == 1.0;
                if !one_motor[k] && motors != 2.0 {
                    return Err(field.not("1 or 2"));
                }
            }
            let c = table.get("c").map_or(Ok([0.0; 3]), |field| field.triple())?;
            legs.push(TripodLeg {
                u: vector("u")?,
                w: vector("w")?,
                v: vector("v")?,
                c: c.into(),
                da: vector("Da")?,
                db: vector("Db")?,
            });
        }
        let legs: [TripodLeg; 3] = legs.try_into().expect("three legs were counted");
        let mut robot = Tripod::new(legs).map_err(|error| unsound(file, error))?;
        robot.name = name(&root)?;
        robot.one_motor = one_motor;
        robot.strokes = root.get("strokes").map(|field| field.ranges()).transpose()?;
        if let Some(field) = root.get("tool") {
            robot.tool = field.triple()?.into();
        }
        if let Some(field) = root.get("tool_axis") {
            let axis = Vector3::from(field.triple()?);
            let none =
                TripodError::Number(SpatialError::NotPositive { what: "length of tool_axis".into(), value: 0.0 });
            robot.tool_axis = axis.try_normalize(0.0).ok_or_else(|| unsound(file, none))?;
        }
        let limit = root.get("plane_angle_limit").map(|field| field.number()).transpose()?;
        robot.plane_angle_limit = limit.map(|limit| angle_unit.to_rad(limit));
        robot.validate_limits().map_err(|error| unsound(file, error))?;
        Ok(Self { robot, angle_unit })
    }
}

fn unsound(file: &str, error: TripodError) -> FileError {
    FileError::Spatial { file: file.to_owned(), error }
}

pub(super) fn name(root: &Table) -> Result<String, FileError> {
    root.get("name").map_or(Ok(String::new()), |field| field.text("a text").map(str::to_owned))
}

pub(super) fn angle_unit(root: &Table) -> Result<AngleUnit, FileError> {
    let unit = root.get("angle_unit").map(|field| field.one_of(&["rad", "deg"])).transpose()?;
    Ok(if unit == Some("deg") { AngleUnit::Deg } else { AngleUnit::Rad })
}
