//! Problem files of coupler curves, and the answer to `coupler` as one JSON document.

use nalgebra::Vector2;
use num_complex::Complex64;
use serde::Serialize;

use super::error::{FieldProblem, FileError};
use super::reader::Field;
use super::report::AccountReport;
use super::tree::Tree;
use crate::linkage::{CouplerCurve, CouplerSide, InputRange, Intersections, Partner};

/// What a coupler file calls itself.
const COUPLER_SCHEMA: &str = "assur/coupler/1";

/// A coupler curve, and what it is to meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CouplerFile {
    /// The curve.
    pub curve: CouplerCurve,
    /// What it is to meet, if anything.
    pub with: Option<Partner>,
}

impl CouplerFile {
    /// The problem in a text; `file` is what errors call it, and its ending says what it is.
    ///
    /// # Errors
    /// One line that names file, field and value.
    ///
    /// ```
    /// use assur::exchange::CouplerFile;
    /// let bars = r#""fourbar":{"a":[0,0],"b":[4,0],"p":[-1,-1],"q":[2,-1],"r":1,"s":2.5}"#;
    /// let text = format!(r#"{{"schema":"assur/coupler/1",{bars},"with":{{"circle":{{"center":[0,0],"radius":-1}}}}}}"#);
    /// let error = CouplerFile::parse(&text, "c.json").unwrap_err();
    /// assert_eq!(error.to_string(), "c.json: with.circle.radius: -1 must be a positive number");
    /// ```
    pub fn parse(text: &str, file: &str) -> Result<Self, FileError> {
        let tree = Tree::parse(text, file)?;
        Field::root(&tree, file).expect_kind(COUPLER_SCHEMA)?;
        let root = Field::root(&tree, file).table(&["schema", "name", "fourbar", "with"])?;
        root.need("schema", &format!("\"{COUPLER_SCHEMA}\""))?.one_of(&[COUPLER_SCHEMA])?;
        let curve = read_curve(&root.need("fourbar", "a four-bar")?, file)?;
        let with = root.get("with").map(|field| read_partner(&field, file)).transpose()?;
        Ok(Self { curve, with })
    }
}

fn read_curve(field: &Field, file: &str) -> Result<CouplerCurve, FileError> {
    let table = field.table(&["a", "b", "p", "q", "r", "s", "a_line", "b_line"])?;
    let side = |names: [&'static str; 3], line: &'static str| -> Result<CouplerSide, FileError> {
        let [pivot, arm, radius] = names;
        let arm = table.need(arm, "two numbers")?.vector()?;
        let Some(guide) = table.get(line) else {
            let (pivot, radius) = (table.need(pivot, "two numbers")?, table.need(radius, "a number")?);
            return Ok(CouplerSide::Circle { pivot: pivot.vector()?, radius: radius.number()?, arm });
        };
        if table.get(pivot).is_some() {
            return Err(guide.error(FieldProblem::Both { first: pivot, second: line }));
        }
        let (point, direction) = read_line(&guide)?;
        Ok(CouplerSide::Line { point, direction, arm })
    };
    let sides = [side(["a", "p", "r"], "a_line")?, side(["b", "q", "s"], "b_line")?];
    CouplerCurve::new(sides).map_err(|error| FileError::Coupler { file: file.to_owned(), error })
}

fn read_line(field: &Field) -> Result<(Vector2<f64>, Vector2<f64>), FileError> {
    let table = field.table(&["point", "direction"])?;
    let direction = table.need("direction", "two numbers")?;
    let along = direction.vector()?;
    if along == Vector2::zeros() {
        let found = direction.tree().to_string();
        return Err(direction.error(FieldProblem::Kind { expected: "a direction other than [0, 0]".to_owned(), found }));
    }
    Ok((table.need("point", "two numbers")?.vector()?, along))
}

fn read_partner(field: &Field, file: &str) -> Result<Partner, FileError> {
    let table = field.table(&["fourbar", "circle", "line"])?;
    let (fourbar, circle, line) = (table.get("fourbar"), table.get("circle"), table.get("line"));
    match (fourbar, circle, line) {
        (Some(curve), None, None) => Ok(Partner::Coupler(read_curve(&curve, file)?)),
        (None, Some(circle), None) => {
            let table = circle.table(&["center", "radius"])?;
            let radius = table.need("radius", "a positive number")?;
            let value = radius.number()?;
            if value <= 0.0 {
                let found = radius.tree().to_string();
                return Err(radius.error(FieldProblem::Kind { expected: "a positive number".to_owned(), found }));
            }
            Ok(Partner::Circle { center: table.need("center", "two numbers")?.vector()?, radius: value })
        }
        (None, None, Some(line)) => {
            let (point, direction) = read_line(&line)?;
            Ok(Partner::Line { point, direction })
        }
        _ => {
            let (expected, found) = ("one of fourbar, circle and line".to_owned(), field.tree().to_string());
            Err(field.error(FieldProblem::Kind { expected, found }))
        }
    }
}

/// A coupler curve, its special points and pieces, and its intersections. Angles in radians.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CouplerReport {
    schema: &'static str,
    /// The Grashof class of a four-bar.
    pub grashof: Option<&'static str>,
    sextic: SexticReport,
    foci: Vec<[f64; 2]>,
    circle_of_singular_foci: Option<CircleReport>,
    double_points: Option<Vec<DoublePointReport>>,
    circuits: Vec<CircuitReport>,
    cognates: Vec<FourBarReport>,
    intersections: Option<Vec<IntersectionReport>>,
    account: Option<AccountReport>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct SexticReport {
    /// `[i][j]` of `z^i w^j`, largest modulus 1.
    coefficients: [[[f64; 2]; 4]; 4],
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct CircleReport {
    center: [f64; 2],
    radius: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct DoublePointReport {
    kind: &'static str,
    point: Option<[f64; 2]>,
    z: [f64; 2],
    w: [f64; 2],
    thetas: [[f64; 2]; 2],
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct CircuitReport {
    /// `[from, to]` of the input angle; `null` for a full turn.
    input: Option<[f64; 2]>,
    /// In which way the dyad closes, where it is always the same.
    way: Option<i8>,
    /// Whether it meets another circuit where the linkage folds flat.
    touches: bool,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct FourBarReport {
    a: [f64; 2],
    b: [f64; 2],
    p: [f64; 2],
    q: [f64; 2],
    r: f64,
    s: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct IntersectionReport {
    real: bool,
    point: Option<[f64; 2]>,
    z: [f64; 2],
    w: [f64; 2],
    thetas: Vec<[f64; 2]>,
    multiplicity: usize,
    residual: f64,
}

impl CouplerReport {
    /// The report of a curve and, where asked for, its intersections.
    pub fn new(curve: &CouplerCurve, found: Option<&Intersections>) -> Self {
        let parts = |z: Complex64| [z.re, z.im];
        let circle = curve.circle_of_singular_foci();
        let four_bar = |curve: &CouplerCurve| match *curve.sides() {
            [
                CouplerSide::Circle { pivot: a, radius: r, arm: p },
                CouplerSide::Circle { pivot: b, radius: s, arm: q },
            ] => Some(FourBarReport { a: a.into(), b: b.into(), p: p.into(), q: q.into(), r, s }),
            _ => None,
        };
        let double_point = |point: &crate::linkage::DoublePoint| DoublePointReport {
            kind: point.kind.name(),
            point: point.point().map(Into::into),
            z: parts(point.z),
            w: parts(point.w),
            thetas: point.thetas.map(parts),
        };
        let circuit = |circuit: &crate::linkage::Circuit| CircuitReport {
            input: match circuit.input {
                InputRange::Full => None,
                InputRange::Between { mid, half } => Some([mid - half, mid + half]),
            },
            way: circuit.way,
            touches: circuit.touches,
        };
        let intersection = |meeting: &crate::linkage::Intersection| IntersectionReport {
            real: meeting.real,
            point: meeting.point().map(Into::into),
            z: parts(meeting.z),
            w: parts(meeting.w),
            thetas: meeting.thetas.iter().map(|&theta| parts(theta)).collect(),
            multiplicity: meeting.multiplicity,
            residual: meeting.residual,
        };
        Self {
            schema: "assur/coupler-report/1",
            grashof: curve.grashof().map(|class| class.name()),
            sextic: SexticReport { coefficients: curve.scaled_coefficients().map(|row| row.map(parts)) },
            foci: curve.foci().map_or(Vec::new(), |foci| foci.map(Into::into).to_vec()),
            circle_of_singular_foci: circle.map(|(center, radius)| CircleReport { center: center.into(), radius }),
            double_points: curve.double_points().map(|points| points.iter().map(double_point).collect()),
            circuits: curve.circuits().iter().map(circuit).collect(),
            cognates: curve.cognates().map_or(Vec::new(), |others| others.iter().filter_map(four_bar).collect()),
            intersections: found.map(|found| found.list.iter().map(intersection).collect()),
            account: found.map(|found| AccountReport::from(found.account)),
        }
    }

    /// The report as one JSON document.
    pub fn to_json(&self) -> String {
        let text = serde_json::to_string_pretty(self).expect("plain data with text keys");
        format!("{text}\n")
    }
}
