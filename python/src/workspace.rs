//! Workspaces: the report and drawing as everywhere, and the region itself, asked for places and outlines.

use std::sync::Arc;

use assur::Manipulator;
use assur::exchange::{ModelFile, WorkspaceReport};
use assur::plane::PhiRange;
use assur::plot::{WorkspaceLayer, draw_workspaces};
use assur::workspace::{ArcCurve, BoundaryArc, Reach, Region, Workspace, WorkspaceKind, WorkspaceModes};
use numpy::{PyArray1, PyReadonlyArray2, ToPyArray};
use pyo3::prelude::*;

use crate::answer::Answer;
use crate::refused::Refused;

/// A workspace with what decides membership.
#[pyclass(frozen, module = "assur._assur")]
pub struct Shape {
    reach: Reach,
    workspace: Arc<Workspace>,
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

/// The workspace of a kind.
pub fn workspace(
    file: &Arc<ModelFile>,
    kind: &str,
    [phi, from, to]: [f64; 3],
    mode: &str,
) -> Result<(Answer, Shape), Refused> {
    let modes: WorkspaceModes = mode.parse().map_err(Refused::input)?;
    let reach = file.manipulator.reach(&modes).map_err(Refused::input)?;
    let workspace = Arc::new(reach.workspace(&kind_of(kind, phi, from, to)).map_err(Refused::input)?);
    let json = WorkspaceReport::new(&workspace, &modes, None, &[]).to_json();
    let shape = Shape { reach: reach.clone(), workspace: workspace.clone() };
    let file = file.clone();
    let draw = move || draw(&file.manipulator, &reach, &workspace);
    Ok((Answer::drawn(json, draw), shape))
}

/// The workspace over what each leg reaches alone, where that is bounded.
fn draw(robot: &Manipulator, reach: &Reach, workspace: &Workspace) -> String {
    let layer = WorkspaceLayer { name: workspace.kind.name().to_owned(), workspace };
    let alone = |leg| reach.only(leg).workspace(&workspace.kind).ok().map(|own| own.region);
    let legs: Vec<Region> = (0..robot.legs.len()).map_while(alone).collect();
    draw_workspaces(robot, &[layer], if legs.len() == robot.legs.len() { &legs } else { &[] })
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
