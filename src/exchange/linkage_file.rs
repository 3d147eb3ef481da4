//! Problem files of whole linkages, and the answer to `group --inputs` as one JSON document.

use serde::Serialize;

use super::error::{FieldProblem, FileError};
use super::group_file::{ground, link_pair, status_name, whole};
use super::reader::Field;
use super::tree::Tree;
use crate::linkage::{Linkage, LinkageAssemblies, LinkageJoint, LinkageJointKind};

/// What a linkage file calls itself.
const LINKAGE_SCHEMA: &str = "assur/linkage/1";

/// Whether a text is a linkage file rather than a group file.
pub fn is_linkage(text: &str, file: &str) -> bool {
    let Ok(tree) = Tree::parse(text, file) else { return false };
    let Ok(table) = Field::root(&tree, file).open_table() else { return false };
    table.get("schema").is_some_and(|schema| schema.text("a text").is_ok_and(|text| text == LINKAGE_SCHEMA))
}

/// The linkage in the text of a linkage file; `file` is what errors call it, and its ending says what it is.
///
/// # Errors
/// One line that names file, field and value, or the part that is wrong.
///
/// ```
/// use assur::exchange::parse_linkage;
/// let joint = r#"{"type":"P","links":[0,1],"at":[0,0],"direction":[1,0]}"#;
/// let text = format!(r#"{{"schema":"assur/linkage/1","links":2,"joints":[{joint}]}}"#);
/// let error = parse_linkage(&text, "l.json").unwrap_err();
/// assert_eq!(error.to_string(),
///     "l.json: links 1: still movable with the drivers held, mobility 1; another driven joint is needed");
/// ```
pub fn parse_linkage(text: &str, file: &str) -> Result<Linkage, FileError> {
    let tree = Tree::parse(text, file)?;
    Field::root(&tree, file).expect_kind(LINKAGE_SCHEMA)?;
    let root = Field::root(&tree, file).table(&["schema", "name", "links", "ground", "joints"])?;
    root.need("schema", &format!("\"{LINKAGE_SCHEMA}\""))?.one_of(&[LINKAGE_SCHEMA])?;
    let links = whole(&root.need("links", "the number of links")?)?;
    let joints = root.need("joints", "a list of joints")?.list("a list of joints")?;
    let joints = joints.iter().map(read_joint).collect::<Result<Vec<_>, _>>()?;
    Linkage::new(links, ground(&root)?, &joints).map_err(|error| FileError::Linkage { file: file.to_owned(), error })
}

fn read_joint(field: &Field) -> Result<LinkageJoint, FileError> {
    let table = field.table(&["type", "links", "at", "direction", "driven"])?;
    let slides = table.need("type", "R or P")?.one_of(&["R", "P"])? == "P";
    let kind = match (slides, table.get("direction")) {
        (true, _) => {
            let direction = table.need("direction", "two numbers, since the joint slides")?.vector()?;
            LinkageJointKind::Prismatic { direction }
        }
        (false, None) => LinkageJointKind::Revolute,
        (false, Some(field)) => {
            let (expected, found) = ("left out: only a joint of type P has one".to_owned(), field.tree().to_string());
            return Err(field.error(FieldProblem::Kind { expected, found }));
        }
    };
    let driven = match table.get("driven") {
        None => false,
        Some(field) => match field.tree() {
            Tree::Bool(value) => *value,
            other => {
                let (expected, found) = ("true or false".to_owned(), other.to_string());
                return Err(field.error(FieldProblem::Kind { expected, found }));
            }
        },
    };
    let links = link_pair(&table.need("links", "two links")?)?;
    Ok(LinkageJoint { links, at: table.need("at", "two numbers")?.vector()?, kind, driven })
}

/// Every assembly of a linkage, as the tree of its groups' assemblies. Angles in radians, lengths those of the file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LinkageReport {
    schema: &'static str,
    /// `complete`, or the worst that a group's answer was.
    pub status: &'static str,
    inputs: Vec<f64>,
    groups: Vec<GroupEntry>,
    /// The tree: parents before children, by their places in this list.
    nodes: Vec<NodeEntry>,
    assemblies: Vec<AssemblyEntry>,
    /// Branches of the tree that end at a group without a real assembly.
    dead_ends: usize,
    /// How many assemblies there are.
    pub count: usize,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct GroupEntry {
    links: Vec<usize>,
    name: String,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct NodeEntry {
    group: usize,
    parent: Option<usize>,
    number: usize,
    multiplicity: usize,
    status: &'static str,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct AssemblyEntry {
    /// Which of each group's real assemblies, from 1.
    choice: Vec<usize>,
    /// `[x, y, phi]` of each link from the reference assembly.
    poses: Vec<[f64; 3]>,
    /// Displacement of each joint from the reference assembly, in file order.
    displacements: Vec<f64>,
    residual: f64,
}

impl LinkageReport {
    /// The report of an answer to these inputs.
    pub fn new(inputs: &[f64], answer: &LinkageAssemblies) -> Self {
        let groups = answer.groups.iter().map(|g| GroupEntry { links: g.links.clone(), name: g.name.clone() });
        let nodes = answer.nodes.iter().map(|node| NodeEntry {
            group: node.group,
            parent: node.parent,
            number: node.number,
            multiplicity: node.multiplicity,
            status: status_name(node.status),
        });
        let assemblies = answer.assemblies.iter().map(|assembly| AssemblyEntry {
            choice: assembly.choice.clone(),
            poses: assembly.poses.clone(),
            displacements: assembly.displacements.clone(),
            residual: assembly.residual,
        });
        Self {
            schema: "assur/linkage-report/1",
            status: status_name(answer.status),
            inputs: inputs.to_vec(),
            groups: groups.collect(),
            nodes: nodes.collect(),
            assemblies: assemblies.collect(),
            dead_ends: answer.dead_ends,
            count: answer.assemblies.len(),
        }
    }

    /// The report as one JSON document.
    pub fn to_json(&self) -> String {
        let text = serde_json::to_string_pretty(self).expect("plain data with text keys");
        format!("{text}\n")
    }
}
