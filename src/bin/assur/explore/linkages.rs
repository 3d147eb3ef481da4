//! Answers about four-bars and trusses.

use assur::exchange::{CouplerFile, CouplerReport, GroupReport, parse_group, write_group};
use assur::linkage::{CouplerCurve, CouplerSide, Truss, TrussAssembly, TrussJoint};
use assur::nalgebra::{Rotation2, UnitComplex, Vector2};
use assur::plot::truss_marks;
use serde::Deserialize;
use serde_json::{Value, json};

use super::drawing::{Grid, marks};

/// Points along each circuit that is drawn.
const CURVE_POINTS: usize = 600;

/// A four-bar, where it stands, and what is pulled.
#[derive(Deserialize)]
pub(crate) struct FourBarQuestion {
    file: Value,
    #[serde(default)]
    place: CurvePlace,
    pull: Option<FourBarPull>,
}

/// A place on a coupler curve: the circuit, from 0, and the parameter along it.
#[derive(Clone, Copy, Default, Deserialize)]
struct CurvePlace {
    circuit: usize,
    tau: f64,
}

#[derive(Deserialize)]
#[serde(tag = "handle", rename_all = "snake_case")]
enum FourBarPull {
    /// A fixed pivot, 0 or 1.
    Pivot { side: usize, to: [f64; 2] },
    /// A guided joint of the coupler.
    Joint { side: usize, to: [f64; 2] },
    /// The point that draws the curve.
    Point { to: [f64; 2] },
}

pub(crate) fn four_bar(question: &FourBarQuestion) -> Result<Value, String> {
    let text = question.file.to_string();
    let CouplerFile { mut curve, .. } = CouplerFile::parse(&text, "coupler.json").map_err(|error| error.to_string())?;
    let mut place = question.place;
    // A pull may have left fewer circuits.
    if place.circuit >= curve.circuits().len() {
        place.circuit = 0;
    }
    let mut now = position(&curve, place);
    if let Some(pull) = &question.pull {
        let (point, turn) = now.ok_or("nothing can be pulled: with these lengths it cannot be put together")?;
        let (changed, point) = pulled(&curve, pull, point, turn)?;
        curve = changed;
        if let Some((circuit, tau)) = curve.nearest(&point, turn.cos_angle(), turn.sin_angle()) {
            place = CurvePlace { circuit, tau };
        }
        now = position(&curve, place);
    }
    let joints = now.map(|(point, turn)| joints(&curve, point, turn));
    let grid = Grid::of(curve.size());
    let circuits = curve.polygons(CURVE_POINTS);
    let polygons = circuits.iter().map(|points| grid.points(points.iter().map(|&point| point.into())));
    Ok(json!({
        "file": with_curve(&question.file, &curve),
        "report": CouplerReport::new(&curve, None),
        "circuits": polygons.collect::<Vec<_>>(),
        "place": { "circuit": place.circuit, "tau": place.tau },
        "pivots": curve.sides().each_ref().map(|side| <[f64; 2]>::from(pivot(side))),
        "joints": joints.map(|joints| joints.map(<[f64; 2]>::from)),
        "point": now.map(|(point, _)| <[f64; 2]>::from(point)),
        "size": curve.size(),
    }))
}

fn position(curve: &CouplerCurve, place: CurvePlace) -> Option<(Vector2<f64>, UnitComplex<f64>)> {
    let circuits = curve.circuits();
    let circuit = circuits.get(place.circuit).or(circuits.first())?;
    let (point, theta) = curve.trace(circuit, place.tau)?;
    Some((point, UnitComplex::new(theta.arg())))
}

fn pivot(side: &CouplerSide) -> Vector2<f64> {
    match side {
        CouplerSide::Circle { pivot, .. } => *pivot,
        CouplerSide::Line { point, .. } => *point,
    }
}

fn arm(side: &CouplerSide) -> Vector2<f64> {
    match side {
        CouplerSide::Circle { arm, .. } | CouplerSide::Line { arm, .. } => *arm,
    }
}

/// The guided joints, where the coupler's point and rotation are given.
fn joints(curve: &CouplerCurve, point: Vector2<f64>, turn: UnitComplex<f64>) -> [Vector2<f64>; 2] {
    curve.sides().each_ref().map(|side| point + turn * arm(side))
}

/// The linkage pulled out of shape as it stands, and where its point is then.
fn pulled(
    curve: &CouplerCurve,
    pull: &FourBarPull,
    point: Vector2<f64>,
    turn: UnitComplex<f64>,
) -> Result<(CouplerCurve, Vector2<f64>), String> {
    let back = Rotation2::from(turn).inverse();
    let at = joints(curve, point, turn);
    let mut sides = *curve.sides();
    let mut drawn = point;
    let no_side = |side: usize| format!("side {} does not exist", side + 1);
    match pull {
        FourBarPull::Pivot { side, to } => match sides.get_mut(*side).ok_or_else(|| no_side(*side))? {
            CouplerSide::Circle { pivot, radius, .. } => {
                *pivot = (*to).into();
                *radius = (at[*side] - *pivot).norm();
            }
            CouplerSide::Line { point, .. } => *point = (*to).into(),
        },
        FourBarPull::Joint { side, to } => match sides.get_mut(*side).ok_or_else(|| no_side(*side))? {
            CouplerSide::Circle { pivot, radius, arm } => {
                *arm = back * (Vector2::from(*to) - point);
                *radius = (Vector2::from(*to) - *pivot).norm();
            }
            CouplerSide::Line { point: on, arm, .. } => {
                *arm = back * (Vector2::from(*to) - point);
                *on = (*to).into();
            }
        },
        FourBarPull::Point { to } => {
            drawn = (*to).into();
            for (side, joint) in sides.iter_mut().zip(at) {
                match side {
                    CouplerSide::Circle { arm, .. } | CouplerSide::Line { arm, .. } => *arm = back * (joint - drawn),
                }
            }
        }
    }
    Ok((CouplerCurve::new(sides).map_err(|error| error.to_string())?, drawn))
}

/// A problem file with another curve; its name, and what the curve is to meet, stay.
fn with_curve(file: &Value, curve: &CouplerCurve) -> Value {
    let mut entries = serde_json::Map::new();
    for (side, names) in curve.sides().iter().zip([["a", "p", "r", "a_line"], ["b", "q", "s", "b_line"]]) {
        match side {
            CouplerSide::Circle { pivot, radius, arm } => {
                entries.insert(names[0].to_owned(), json!([pivot.x, pivot.y]));
                entries.insert(names[1].to_owned(), json!([arm.x, arm.y]));
                entries.insert(names[2].to_owned(), json!(radius));
            }
            CouplerSide::Line { point, direction, arm } => {
                entries.insert(names[1].to_owned(), json!([arm.x, arm.y]));
                let line = json!({ "point": [point.x, point.y], "direction": [direction.x, direction.y] });
                entries.insert(names[3].to_owned(), line);
            }
        }
    }
    let mut file = file.clone();
    file["fourbar"] = Value::Object(entries);
    file
}

/// A truss, drawn in the assembly that is held; what is pulled, or which assembly is taken.
#[derive(Deserialize)]
pub(crate) struct TrussQuestion {
    file: Value,
    pull: Option<TrussPull>,
    /// The real assembly, from 0, to be held from now on.
    take: Option<usize>,
}

#[derive(Deserialize)]
struct TrussPull {
    joint: usize,
    to: [f64; 2],
}

pub(crate) fn truss(question: &TrussQuestion) -> Result<Value, String> {
    let read = |file: &Value| parse_group(&file.to_string(), "group.json").map_err(|error| error.to_string());
    let mut truss = read(&question.file)?;
    if let Some(TrussPull { joint, to }) = &question.pull {
        truss = redrawn(&truss, |number, at| if number == *joint { (*to).into() } else { at })?;
    }
    if let Some(number) = question.take {
        let answer = truss.assemble();
        let taken = answer.real().nth(number).ok_or_else(|| format!("assembly {} does not exist", number + 1))?;
        let places = joint_places(&truss, taken);
        truss = redrawn(&truss, |number, at| places[number].unwrap_or(at))?;
    }
    let answer = truss.assemble();
    // The drawing itself is an assembly: nothing is turned.
    let turned = |assembly: &&TrussAssembly| assembly.theta.iter().map(|t| (t - 1.0).norm()).fold(0.0, f64::max);
    let current = answer.real().enumerate().min_by(|p, q| turned(&p.1).total_cmp(&turned(&q.1))).map(|(k, _)| k);
    let mut file: Value = serde_json::from_str(&write_group(&truss)).expect("what is written can be read");
    if let Some(name) = question.file.get("name") {
        file["name"] = name.clone();
    }
    Ok(json!({
        "file": file,
        "report": GroupReport::new(&truss, &answer, true),
        "drawings": answer.real().map(|assembly| marks(&truss_marks(&truss, assembly), Grid::of(truss.size()))).collect::<Vec<_>>(),
        "current": current,
        "joints": truss.joints().map(|joint| <[f64; 2]>::from(joint.at[0])).collect::<Vec<_>>(),
        "size": truss.size(),
    }))
}

/// The same links with their joints drawn elsewhere.
fn redrawn(truss: &Truss, place: impl Fn(usize, Vector2<f64>) -> Vector2<f64>) -> Result<Truss, String> {
    let drawn = |(number, joint): (usize, TrussJoint)| TrussJoint::drawn(joint.links, place(number, joint.at[0]));
    let joints: Vec<TrussJoint> = truss.joints().enumerate().map(drawn).collect();
    Truss::new(truss.links(), &joints, truss.ground()).map_err(|error| error.to_string())
}

fn joint_places(truss: &Truss, assembly: &TrussAssembly) -> Vec<Option<Vector2<f64>>> {
    let mut places = vec![None; truss.joints().count()];
    for link in 0..truss.links() {
        for (joint, at) in truss.joints_of_link(link, assembly) {
            places[joint] = Some(at);
        }
    }
    places
}
