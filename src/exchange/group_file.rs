//! Problem files of Assur groups with revolute joints, and the answer to `group` as one JSON document.

use serde::Serialize;

use super::error::{FieldProblem, FileError};
use super::reader::{Field, Table};
use super::tree::Tree;
use crate::linkage::{Status, Truss, TrussAssemblies, TrussAssembly, TrussJoint};

/// What a group file calls itself.
pub(super) const GROUP_SCHEMA: &str = "assur/group/1";

/// The truss in the text of a group file; `file` is what errors call it, and its ending says what it is.
///
/// # Errors
/// One line that names file, field and value, or the joint or part that is wrong.
///
/// ```
/// use assur::exchange::parse_group;
/// let text = r#"{"schema":"assur/group/1","links":3,"edges":[[0,1],[1,2],[0,4]],"joint_xy":[[0,0],[1,1],[2,0]]}"#;
/// let error = parse_group(text, "g.json").unwrap_err();
/// assert_eq!(error.to_string(), "g.json: joint 2: link 4 does not exist; there are 3, counted from 0");
/// ```
pub fn parse_group(text: &str, file: &str) -> Result<Truss, FileError> {
    let tree = Tree::parse(text, file)?;
    Field::root(&tree, file).expect_kind(GROUP_SCHEMA)?;
    let root = Field::root(&tree, file).table(&["schema", "name", "links", "edges", "joint_xy", "ground"])?;
    root.need("schema", &format!("\"{GROUP_SCHEMA}\""))?.one_of(&[GROUP_SCHEMA])?;
    let links = whole(&root.need("links", "the number of links")?)?;
    let ground = ground(&root)?;
    let edges = root.need("edges", "a list of pairs of links")?;
    let places = root.need("joint_xy", "a list of points, one for each of the edges")?;
    let listed = edges.list("a list of pairs of links")?;
    let points = places.list("a list of points")?;
    if points.len() != listed.len() {
        let expected = format!("as long as edges, {}", listed.len());
        let found = places.tree().to_string();
        return Err(places.error(FieldProblem::Length { expected, found, count: points.len() }));
    }
    let joint = |(edge, point): (&Field, &Field)| Ok(TrussJoint::drawn(link_pair(edge)?, point.vector()?));
    let joints = listed.iter().zip(&points).map(joint).collect::<Result<Vec<_>, FileError>>()?;
    Truss::new(links, &joints, ground).map_err(|error| FileError::Truss { file: file.to_owned(), error })
}

/// Two links by number.
pub(super) fn link_pair(field: &Field) -> Result<[usize; 2], FileError> {
    let [i, j] = field.array("two links")?;
    Ok([whole(&i)?, whole(&j)?])
}

pub(super) fn ground(root: &Table) -> Result<usize, FileError> {
    root.get("ground").map_or(Ok(0), |field| whole(&field))
}

/// A whole number from 0.
pub(super) fn whole(field: &Field) -> Result<usize, FileError> {
    /// Larger numbers of links or joints are mistakes.
    const MOST: f64 = 1e6;
    let value = field.number()?;
    if value.fract() != 0.0 || !(0.0..=MOST).contains(&value) {
        let found = field.tree().to_string();
        return Err(field.error(FieldProblem::Kind { expected: "a whole number from 0".to_owned(), found }));
    }
    Ok(value as usize)
}

/// Every assembly of a group. Contains everything that is known except what `--complex` adds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GroupReport {
    schema: &'static str,
    /// `complete`, `self_motion` or `undecided`.
    pub status: &'static str,
    /// The assemblies: the real ones, and the others where they are asked for.
    pub assemblies: Vec<GroupAssemblyReport>,
    /// How many there are, real and complex, with multiplicity.
    pub count: usize,
    /// How many there are for general dimensions, where that is known.
    pub expected: Option<usize>,
    /// How many were not found; special dimensions may have fewer.
    pub missing: Option<usize>,
    /// The name in the catalogue: `7#0`.
    pub truss: Option<String>,
    /// One assembly on each curve of assemblies that was met.
    pub self_motions: Vec<GroupAssemblyReport>,
    /// Links that turn freely, since their joints coincide.
    pub loose_links: Vec<usize>,
    /// The length that residuals are measured against.
    pub size: f64,
}

/// One assembly as reports write it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GroupAssemblyReport {
    /// `e^(i phi)` of every link but the ground, in order.
    pub theta: Vec<[f64; 2]>,
    /// Whether it is real.
    pub real: bool,
    /// How many solutions meet here.
    pub multiplicity: usize,
    /// Closure error over the size; for complex ones over the sizes of the terms.
    pub residual: f64,
}

/// Status as reports write it.
pub(super) fn status_name(status: Status) -> &'static str {
    match status {
        Status::Complete => "complete",
        Status::SelfMotion => "self_motion",
        Status::Undecided => "undecided",
    }
}

impl GroupReport {
    /// The report; with `complex` the assemblies that are not real are listed too.
    pub fn new(truss: &Truss, answer: &TrussAssemblies, complex: bool) -> Self {
        let write = |assembly: &TrussAssembly| {
            let others = assembly.theta.iter().enumerate().filter(|(link, _)| *link != truss.ground());
            GroupAssemblyReport {
                theta: others.map(|(_, t)| [t.re, t.im]).collect(),
                real: assembly.real,
                multiplicity: assembly.multiplicity,
                residual: assembly.residual,
            }
        };
        Self {
            schema: "assur/group-report/1",
            status: status_name(answer.status),
            assemblies: answer.assemblies.iter().filter(|a| complex || a.real).map(write).collect(),
            count: answer.count(),
            expected: answer.expected,
            missing: answer.missing,
            truss: truss.catalogued().map(|entry| entry.name()),
            self_motions: answer.curves.iter().map(write).collect(),
            loose_links: answer.loose_links.clone(),
            size: truss.size(),
        }
    }

    /// The report as one JSON document.
    pub fn to_json(&self) -> String {
        let text = serde_json::to_string_pretty(self).expect("plain data with text keys");
        format!("{text}\n")
    }
}

/// A group file's text for a truss that is drawn in one reference assembly.
pub fn write_group(truss: &Truss) -> String {
    let joints: Vec<TrussJoint> = truss.joints().collect();
    let document = serde_json::json!({
        "schema": GROUP_SCHEMA,
        "links": truss.links(),
        "edges": joints.iter().map(|joint| joint.links).collect::<Vec<_>>(),
        "joint_xy": joints.iter().map(|joint| <[f64; 2]>::from(joint.at[0])).collect::<Vec<_>>(),
        "ground": truss.ground(),
    });
    format!("{document:#}\n")
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;

    #[test]
    fn what_is_written_is_read_back() {
        let joint = |links, x, y| TrussJoint::drawn(links, Vector2::new(x, y));
        let joints = [joint([0, 1], 0.0, 1.0 / 3.0), joint([1, 2], 1.0, 1.5), joint([2, 0], 4.0, 0.0)];
        let truss = Truss::new(3, &joints, 2).expect("a dyad");
        assert_eq!(parse_group(&write_group(&truss), "g.json"), Ok(truss));
    }

    #[test]
    fn mistakes_are_named() {
        let error = |text: &str| parse_group(text, "g.json").unwrap_err().to_string();
        let start = r#"{"schema":"assur/group/1","links":"#;
        assert_eq!(error(&format!("{start}2.5}}")), "g.json: links: 2.5 must be a whole number from 0");
        let lists = r#""edges":[[0,1]],"joint_xy":[]"#;
        assert!(error(&format!("{start}3,{lists}}}")).ends_with("must be as long as edges, 1, has 0"));
        assert!(error(r#"{"schema":"assur/triad/1"}"#).contains("is a file for `assur triad`"));
    }
}
