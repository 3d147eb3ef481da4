//! Workspaces as the page draws them: boundaries as polygons, with their measures.

use assur::Manipulator;
use assur::linkage::Pose;
use assur::plane::PhiRange;
use assur::workspace::{BoundaryArc, Isolated, WorkspaceKind, WorkspaceModes};
use serde::Deserialize;
use serde_json::{Value, json};

/// Points along each arc: a full circle of them looks round on any screen.
const ARC_POINTS: usize = 64;

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

/// The workspace, or why there is none; `pose`: of the mode that is held.
pub(crate) fn workspace(robot: &Manipulator, question: WorkspaceQuestion, pose: Option<Pose>) -> Value {
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
    let points = |arcs: &[BoundaryArc]| arcs.iter().flat_map(|arc| arc.points(ARC_POINTS)).collect::<Vec<[f64; 2]>>();
    let region = &found.region;
    let curve = |isolated: &Isolated| match isolated {
        Isolated::Curve(arc) => Some(arc.points(ARC_POINTS)),
        Isolated::Point { .. } => None,
    };
    let separating = found.separating.iter().map(|arc| arc.points(ARC_POINTS));
    json!({
        "kind": kind.name(),
        "area": region.area,
        "perimeter": region.perimeter,
        "components": region.components,
        "holes": region.holes,
        "loops": region.loops.iter().map(|outline| points(&outline.arcs)).collect::<Vec<_>>(),
        "separating": separating.chain(region.isolated.iter().filter_map(curve)).collect::<Vec<_>>(),
    })
}
