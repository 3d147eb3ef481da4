//! Workspaces: the report and drawing as everywhere, and the region itself, asked for places and outlines.

use std::f64::consts::TAU;
use std::sync::Arc;

use assur::exchange::{ModelFile, WorkspaceReport, workspace_csv, workspace_dxf};
use assur::plane::PhiRange;
use assur::plot::{WorkspaceLayer, draw_workspaces};
use assur::workspace::{ArcCurve, BoundaryArc, DesignChoice, Reach, Region, Workspace, WorkspaceKind, WorkspaceModes};
use assur::{DesignError, DesignKey, DesignNumber, Manipulator, Pose};
use numpy::{PyArray1, PyReadonlyArray2, ToPyArray};
use pyo3::prelude::*;

use crate::answer::Answer;
use crate::refused::Refused;

/// A workspace with what decides membership.
#[pyclass(frozen, module = "assur._assur")]
pub struct Shape {
    reach: Reach,
    workspace: Arc<Workspace>,
    slices: Vec<Workspace>,
    overlays: Arc<Vec<Workspace>>,
}

/// What is asked of a workspace, as on the command line; angles in radians.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Asked {
    kind: String,
    /// `phi`, `from`, `to`; zero where the kind takes none.
    angles: [f64; 3],
    mode: String,
    assembly: Option<[f64; 3]>,
    /// How many slices, if any.
    slices: Option<usize>,
    /// Numbers of the design by which the area is derived.
    gradient: Vec<String>,
    /// Numbers of the design with their bounds, for the largest area.
    optimise: Vec<(String, [f64; 2])>,
    /// Other kinds over it, each with its angles as above.
    overlays: Vec<(String, [f64; 3])>,
}

/// A kind by its name, as on the command line; angles in radians.
fn kind_of(name: &str, phi: f64, from: f64, to: f64) -> WorkspaceKind {
    match name {
        "constant" => WorkspaceKind::Constant { phi },
        "inclusive" => WorkspaceKind::Inclusive(PhiRange::between(from, to)),
        "total" => WorkspaceKind::Total(PhiRange::between(from, to)),
        "dextrous" => WorkspaceKind::Dextrous,
        _ => WorkspaceKind::Maximal,
    }
}

/// The workspace of a kind, or what one assembly reaches of the maximal one.
pub fn workspace(file: &Arc<ModelFile>, asked: &Asked) -> Result<(Answer, Shape), Refused> {
    let robot = &file.manipulator;
    let [phi, from, to] = asked.angles;
    let modes: WorkspaceModes = asked.mode.parse().map_err(Refused::input)?;
    let reach = robot.reach(&modes).map_err(Refused::input)?;
    let kind = kind_of(&asked.kind, phi, from, to);
    let found = match asked.assembly {
        Some([x, y, phi]) => reach.assembly(&Pose::new(x, y, phi)),
        None => reach.workspace(&kind),
    };
    let workspace = Arc::new(found.map_err(Refused::input)?);
    let mut report = WorkspaceReport::new(&workspace, &modes, asked.assembly, &[]);
    let overlaid = |(name, [phi, from, to]): &(String, [f64; 3])| reach.workspace(&kind_of(name, *phi, *from, *to));
    let overlays = asked.overlays.iter().map(overlaid).collect::<Result<Vec<_>, _>>().map_err(Refused::input)?;
    report.overlays = overlays.iter().map(|other| WorkspaceReport::new(other, &modes, None, &[])).collect();
    let overlays = Arc::new(overlays);
    let mut slices = Vec::new();
    if let Some(count) = asked.slices {
        let range = match kind {
            WorkspaceKind::Constant { phi } => PhiRange { from: phi, width: 0.0 },
            WorkspaceKind::Inclusive(range) | WorkspaceKind::Total(range) => range,
            WorkspaceKind::Maximal | WorkspaceKind::Dextrous => PhiRange::between(0.0, TAU),
        };
        let stack = robot.workspace_stack(range, count, &modes).map_err(Refused::input)?;
        report = report.with_stack(&stack);
        slices = stack.slices;
    }
    for name in &asked.gradient {
        let (name, numbers) = numbers(robot, name)?;
        let slopes = robot.area_gradient(&workspace, &modes, &numbers).map_err(Refused::input)?;
        report.gradient.insert(name, slopes.iter().sum());
    }
    if !asked.optimise.is_empty() {
        let choice = |(name, bounds): &(String, [f64; 2])| {
            let (name, numbers) = numbers(robot, name)?;
            Ok::<_, Refused>((name, DesignChoice { numbers, bounds: *bounds }))
        };
        let chosen = asked.optimise.iter().map(choice).collect::<Result<Vec<_>, _>>()?;
        let (names, choices): (Vec<String>, Vec<DesignChoice>) = chosen.into_iter().unzip();
        let best = robot.optimise_area(&kind, &modes, &choices).map_err(Refused::input)?;
        report = report.with_optimum(&names, &best);
    }
    let json = report.to_json();
    let shape = Shape { reach: reach.clone(), workspace: workspace.clone(), slices, overlays: overlays.clone() };
    let file = file.clone();
    let draw = move || draw(&file, &reach, &workspace, &overlays);
    Ok((Answer::drawn(json, draw), shape))
}

/// The numbers of the design that a name stands for, and the name as reports write it.
fn numbers(robot: &Manipulator, name: &str) -> Result<(String, Vec<DesignNumber>), Refused> {
    let key: DesignKey = name.parse().map_err(|error: DesignError| Refused::input(error))?;
    Ok((key.to_string(), key.numbers(robot).map_err(Refused::input)?))
}

/// The workspace over what each leg reaches alone, where that is bounded; or with others over it.
fn draw(file: &ModelFile, reach: &Reach, workspace: &Workspace, overlays: &[Workspace]) -> String {
    let robot = &file.manipulator;
    if !overlays.is_empty() {
        let layer = |workspace| WorkspaceLayer { name: layer_name(workspace, file), workspace };
        let layers: Vec<_> = std::iter::once(workspace).chain(overlays).map(layer).collect();
        return draw_workspaces(robot, &layers, &[]);
    }
    let layer = WorkspaceLayer { name: workspace.kind.name().to_owned(), workspace };
    let alone = |leg| reach.only(leg).workspace(&workspace.kind).ok().map(|own| own.region);
    let legs: Vec<Region> = (0..robot.legs.len()).map_while(alone).collect();
    draw_workspaces(robot, &[layer], if legs.len() == robot.legs.len() { &legs } else { &[] })
}

/// A kind with its angles, in the file's unit.
fn layer_name(workspace: &Workspace, file: &ModelFile) -> String {
    let angle = |angle: f64| format!("{:.4} {}", file.angle_unit.from_rad(angle), file.angle_unit.name());
    match &workspace.kind {
        WorkspaceKind::Constant { phi } => format!("constant, φ = {}", angle(*phi)),
        WorkspaceKind::Maximal | WorkspaceKind::Dextrous => workspace.kind.name().to_owned(),
        WorkspaceKind::Inclusive(range) | WorkspaceKind::Total(range) => {
            format!("{}, φ {} … {}", workspace.kind.name(), angle(range.from), angle(range.from + range.width))
        }
    }
}

fn flat(arcs: &[BoundaryArc], points: usize) -> Vec<f64> {
    let mut out = Vec::new();
    for arc in arcs {
        let count = if arc.curve == ArcCurve::Line { 2 } else { points };
        // The last point of an arc is the first of the next.
        out.extend(arc.points(count).iter().take(count - 1).flatten());
    }
    if let Some(first) = arcs.first() {
        out.extend(first.start);
    }
    out
}

/// Whether places are inside, their margins, and what binds.
type Memberships<'py> = (Bound<'py, PyArray1<bool>>, Bound<'py, PyArray1<f64>>, Vec<Option<String>>);

#[pymethods]
impl Shape {
    /// The loops as closed polygons, flat.
    fn outlines(&self, py: Python<'_>, points: usize) -> Vec<Vec<f64>> {
        py.detach(|| self.workspace.region.loops.iter().map(|one| flat(&one.arcs, points.max(2))).collect())
    }

    /// The loops of each slice as closed polygons, flat.
    fn slices(&self, py: Python<'_>, points: usize) -> Vec<Vec<Vec<f64>>> {
        let outlines =
            |slice: &Workspace| slice.region.loops.iter().map(|one| flat(&one.arcs, points.max(2))).collect();
        py.detach(|| self.slices.iter().map(outlines).collect())
    }

    /// The loops of each overlay as closed polygons, flat.
    fn overlays(&self, py: Python<'_>, points: usize) -> Vec<Vec<Vec<f64>>> {
        let outlines =
            |other: &Workspace| other.region.loops.iter().map(|one| flat(&one.arcs, points.max(2))).collect();
        py.detach(|| self.overlays.iter().map(outlines).collect())
    }

    /// The boundary as a DXF drawing.
    fn dxf(&self, py: Python<'_>) -> String {
        py.detach(|| workspace_dxf(&self.workspace))
    }

    /// Points along the boundary as CSV.
    fn csv(&self, py: Python<'_>) -> String {
        py.detach(|| workspace_csv(&self.workspace))
    }

    /// Arcs that are no part of a loop, separating ones, flat and open.
    fn separating(&self, py: Python<'_>, points: usize) -> Vec<Vec<f64>> {
        let open = |arc: &BoundaryArc| arc.points(points.max(2)).into_iter().flatten().collect();
        py.detach(|| self.workspace.separating.iter().map(open).collect())
    }

    /// Whether each place is inside, and its margin.
    fn memberships<'py>(&self, py: Python<'py>, points: PyReadonlyArray2<'py, f64>) -> PyResult<Memberships<'py>> {
        let points = points.as_slice()?;
        let kind = &self.workspace.kind;
        let found: Vec<_> =
            py.detach(|| points.chunks_exact(2).map(|at| self.reach.membership(kind, [at[0], at[1]].into())).collect());
        let inside: Vec<bool> = found.iter().map(|one| one.inside).collect();
        let margins: Vec<f64> = found.iter().map(|one| one.margin).collect();
        let binding = found.iter().map(|one| one.binding.map(|limit| limit.to_string())).collect();
        Ok((inside.to_pyarray(py), margins.to_pyarray(py), binding))
    }
}
