//! Workspaces as the page draws them: boundaries as polygons, with their measures.

use std::time::Instant;

use assur::Manipulator;
use assur::linkage::Pose;
use assur::plane::PhiRange;
use assur::workspace::{ArcCurve, BoundaryArc, Isolated, WorkspaceKind, WorkspaceModes};
use serde::Deserialize;
use serde_json::{Value, json};

use super::drawing::Grid;
use super::question::read_model;

/// Steps in a full circle: it looks round on any screen.
const CIRCLE_STEPS: f64 = 180.0;
/// Points along other curves: so many in a length of the mechanism's size, and no fewer than that in any, since short ones bend as well.
const CURVE_POINTS: f64 = 40.0;
const FEWEST_POINTS: usize = 14;
/// The most along one curve.
const MOST_POINTS: usize = 120;

/// Which workspace; angles in radians.
#[derive(Clone, Copy, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub(crate) enum WorkspaceQuestion {
    /// Of the orientation at hand.
    Constant,
    Maximal,
    Inclusive {
        from: f64,
        to: f64,
    },
    Total {
        from: f64,
        to: f64,
    },
    Dextrous,
}

/// A workspace beside a drag: one that takes too long for its steps.
#[derive(Deserialize)]
pub(crate) struct RegionQuestion {
    model: Value,
    /// Of the mode that is held.
    pose: Option<[f64; 3]>,
    workspace: WorkspaceQuestion,
}

pub(crate) fn region(question: &RegionQuestion) -> Result<Value, String> {
    let pose = question.pose.map(|[x, y, phi]| Pose::new(x, y, phi));
    Ok(workspace(&read_model(&question.model)?.manipulator, question.workspace, pose))
}

/// The workspace and how long it took, or why there is none; `pose`: of the mode that is held.
pub(crate) fn workspace(robot: &Manipulator, question: WorkspaceQuestion, pose: Option<Pose>) -> Value {
    let began = Instant::now();
    let kind = match (question, pose) {
        (WorkspaceQuestion::Constant, Some(pose)) => WorkspaceKind::Constant { phi: pose.phi },
        (WorkspaceQuestion::Constant, None) => {
            return json!({ "error": "no assembly mode is held, so there is no orientation" });
        }
        (WorkspaceQuestion::Maximal, _) => WorkspaceKind::Maximal,
        (WorkspaceQuestion::Inclusive { from, to }, _) => WorkspaceKind::Inclusive(PhiRange::between(from, to)),
        (WorkspaceQuestion::Total { from, to }, _) => WorkspaceKind::Total(PhiRange::between(from, to)),
        (WorkspaceQuestion::Dextrous, _) => WorkspaceKind::Dextrous,
    };
    let found = match robot.workspace(&kind, &WorkspaceModes::Both) {
        Ok(found) => found,
        Err(error) => return json!({ "error": error.to_string() }),
    };
    let size = robot.characteristic_length();
    let grid = Grid::of(size);
    let curve_points = |arc: &BoundaryArc| grid.points(arc.points(steps(arc, size) + 1));
    // Each arc begins where the one before ends.
    let outline = |arcs: &[BoundaryArc]| {
        let without_end = |arc: &BoundaryArc| curve_points(arc).into_iter().take(steps(arc, size)).collect::<Vec<_>>();
        arcs.iter().flat_map(without_end).collect::<Vec<[f64; 2]>>()
    };
    let region = &found.region;
    let curve = |isolated: &Isolated| match isolated {
        Isolated::Curve(arc) => Some(curve_points(arc)),
        Isolated::Point { .. } => None,
    };
    let point = |isolated: &Isolated| match isolated {
        Isolated::Point { at, .. } => Some(grid.point(*at)),
        Isolated::Curve(_) => None,
    };
    let separating = found.separating.iter().map(curve_points);
    json!({
        "kind": kind.name(),
        "area": region.area,
        "perimeter": region.perimeter,
        "components": region.components,
        "holes": region.holes,
        "loops": region.loops.iter().map(|one| outline(&one.arcs)).collect::<Vec<_>>(),
        "separating": separating.chain(region.isolated.iter().filter_map(curve)).collect::<Vec<_>>(),
        "isolated": region.isolated.iter().filter_map(point).collect::<Vec<_>>(),
        "unclosed": region.unclosed.len(),
        "micros": u64::try_from(began.elapsed().as_micros()).unwrap_or(u64::MAX),
    })
}

/// Chords that draw an arc.
fn steps(arc: &BoundaryArc, size: f64) -> usize {
    match &arc.curve {
        ArcCurve::Line => 1,
        ArcCurve::Circle { start_angle, end_angle, .. } => {
            ((end_angle - start_angle).abs() / std::f64::consts::TAU * CIRCLE_STEPS).ceil().max(4.0) as usize
        }
        ArcCurve::Coupler(_) | ArcCurve::Ellipse(_) => {
            ((arc.length() / size * CURVE_POINTS).ceil() as usize).clamp(FEWEST_POINTS, MOST_POINTS)
        }
    }
}
