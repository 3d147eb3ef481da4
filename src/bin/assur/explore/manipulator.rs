//! Answers about manipulators.

use assur::exchange::{ForwardReport, ModelFile, SingularitiesReport};
use assur::linkage::Pose;
use assur::plot::mode_marks;
use assur::{AssemblyModes, Manipulator, PathEventKind, Tracked};
use serde::Deserialize;
use serde_json::{Value, json};

use super::drawing::{Grid, marks};
use super::handles::{Pull, Wish, handles};
use super::question::{model_value, read_model};
use super::workspace::{WorkspaceQuestion, workspace};

/// A pull on a mechanism, or none: then what it is like as it stands.
#[derive(Deserialize)]
pub(crate) struct MoveQuestion {
    model: Value,
    inputs: Vec<f64>,
    /// The mode that is held.
    mode: Option<HeldMode>,
    /// Whether a mode is to be taken hold of where none is.
    #[serde(default)]
    pick: bool,
    pull: Option<Pull>,
    workspace: Option<WorkspaceQuestion>,
}

#[derive(Deserialize)]
struct HeldMode {
    pose: [f64; 3],
    signs: String,
}

impl HeldMode {
    fn pose(&self) -> Pose {
        let [x, y, phi] = self.pose;
        Pose::new(x, y, phi)
    }
}

/// The design and inputs after a pull, all assembly modes, and what became of each.
pub(crate) fn moved(question: &MoveQuestion) -> Result<Value, String> {
    let model = read_model(&question.model)?;
    let before = &model.manipulator;
    let held = question.mode.as_ref().map(|mode| (mode.pose(), mode.signs.clone()));
    let wish = match &question.pull {
        Some(pull) => pull.wish(&model, &question.inputs, held.as_ref().map(|held| held.0))?,
        None => Wish::Change(Box::new(model.clone()), question.inputs.clone()),
    };
    let (changed, inputs, held, event) = match (wish, held) {
        (Wish::Guide(target), Some((pose, signs))) => {
            let guided = before.guide(&pose, &signs, &target).map_err(|error| error.to_string())?;
            let inputs = before.inputs_beside(&guided.inputs, &question.inputs);
            let crossed = guided.crossed.last().map(|pose| json!({ "kind": "crossing", "pose": numbers(pose) }));
            let stopped = (!guided.arrived).then(|| json!({ "kind": "stopped", "pose": numbers(&guided.pose) }));
            (model.clone(), inputs, Some((guided.pose, guided.mode.signs)), crossed.or(stopped))
        }
        (Wish::Guide(_), None) => return Err("no assembly mode is held: take one of the modes first".to_owned()),
        (Wish::Change(changed, inputs), held) => {
            let (held, event) = carried(&model, &question.inputs, held, &changed, &inputs);
            (*changed, inputs, held, event)
        }
    };
    let robot = &changed.manipulator;
    let answer = robot.forward(&inputs).map_err(|error| changed.angle_unit.of_lock_error(robot, error).to_string())?;
    // Where the mechanism was none, or another, nothing is known of its modes before.
    let tracked = before.track(&question.inputs, robot, &inputs).ok();
    let current = match (&held, &question.mode) {
        (Some((pose, signs)), _) => nearest_mode(robot, &answer, pose, signs),
        // A mode within the limits, if there is one.
        (None, None) if question.pick => {
            let within = answer.modes.iter().position(|mode| mode.violations.is_empty());
            within.or((!answer.modes.is_empty()).then_some(0))
        }
        _ => None,
    };
    let mode = current.map(|number| &answer.modes[number]);
    let pose = mode.map(|mode| mode.mode.pose);
    let grid = Grid::of(robot.characteristic_length());
    Ok(json!({
        "model": model_value(&changed),
        "family": robot.family(),
        "inputs": robot.inputs_in_range(&inputs),
        "report": ForwardReport::of_manipulator(&answer),
        "came_from": came_from(robot, &answer, tracked.as_ref()),
        "ended": tracked.map_or(Vec::new(), |tracked| tracked.ends.iter().map(|end| numbers(&end.pose)).collect()),
        "drawings": answer.modes.iter().map(|mode| marks(&mode_marks(robot, mode), grid)).collect::<Vec<_>>(),
        "current": current,
        "event": event,
        "handles": handles(robot, mode),
        "actuators": actuators(robot),
        "size": robot.characteristic_length(),
        "workspace": question.workspace.map(|question| workspace(robot, question, pose)),
    }))
}

/// The held mode after a change of design or inputs; where it ends on the way, the event and nothing held.
fn carried(
    model: &ModelFile,
    inputs: &[f64],
    held: Option<(Pose, String)>,
    changed: &ModelFile,
    changed_inputs: &[f64],
) -> (Option<(Pose, String)>, Option<Value>) {
    let Some((pose, signs)) = held else { return (None, None) };
    let carried = model.manipulator.carry(inputs, &pose, &changed.manipulator, changed_inputs);
    match carried {
        Ok(carried) => match carried.end {
            None => (Some((carried.pose, signs)), None),
            Some((at, kind)) => (None, Some(end(at, kind, &carried.pose))),
        },
        // Another mechanism: nothing of it was held.
        Err(_) => (None, Some(json!({ "kind": "lost", "pose": numbers(&pose) }))),
    }
}

fn end(at: f64, kind: PathEventKind, pose: &Pose) -> Value {
    let kind = match kind {
        PathEventKind::SelfMotion { .. } => "self_motion",
        other => other.name(),
    };
    json!({ "kind": kind, "at": at, "pose": numbers(pose) })
}

/// For each mode the number, from 0, of the pose it had before; numbers count each pose once, as `pose_numbers` does.
fn came_from(robot: &Manipulator, answer: &AssemblyModes, tracked: Option<&Tracked>) -> Vec<Option<usize>> {
    let Some(tracked) = tracked else { return vec![None; answer.modes.len()] };
    let before = |mode: &assur::ManipulatorMode| {
        let here = robot.nearest_pose(&tracked.to, &mode.mode.pose)?;
        tracked.becomes.iter().position(|&becomes| becomes == Some(here))
    };
    answer.modes.iter().map(before).collect()
}

/// The mode nearest to a pose, of those in one pose the one with these signs.
fn nearest_mode(robot: &Manipulator, answer: &AssemblyModes, pose: &Pose, signs: &str) -> Option<usize> {
    let poses: Vec<Pose> = answer.modes.iter().map(|mode| mode.mode.pose).collect();
    let first = robot.nearest_pose(&poses, pose)?;
    let same = |&number: &usize| answer.modes[number].mode.pose == answer.modes[first].mode.pose;
    let mut alike = (0..answer.modes.len()).filter(same);
    Some(alike.find(|&number| answer.modes[number].signs == signs).unwrap_or(first))
}

fn actuators(robot: &Manipulator) -> Vec<Value> {
    let actuator = |(number, (leg, joint)): (usize, (usize, usize))| {
        let angle = robot.legs[leg].joints[joint] == assur::JointKind::Revolute;
        let limited = robot.legs[leg].limits[joint].is_some();
        let range = robot.actuator_range(number);
        json!({ "leg": leg + 1, "joint": joint + 1, "angle": angle, "limited": limited, "range": range })
    };
    robot.actuated_joints().enumerate().map(actuator).collect()
}

fn numbers(pose: &Pose) -> [f64; 3] {
    [pose.x, pose.y, pose.phi]
}

/// A proof of all modes.
#[derive(Deserialize)]
pub(crate) struct ProveQuestion {
    model: Value,
    inputs: Vec<f64>,
}

pub(crate) fn proved(question: &ProveQuestion) -> Result<Value, String> {
    let model = read_model(&question.model)?;
    let answer = model.manipulator.certify(&question.inputs).map_err(|error| error.to_string())?;
    Ok(json!({ "report": ForwardReport::of_manipulator(&answer) }))
}

/// Curves of singular positions for an orientation, in one working mode.
#[derive(Deserialize)]
pub(crate) struct LociQuestion {
    model: Value,
    phi: f64,
    signs: String,
}

pub(crate) fn loci(question: &LociQuestion) -> Result<Value, String> {
    let model = read_model(&question.model)?;
    let robot = &model.manipulator;
    let window = robot.plane_window(question.phi);
    let pieces =
        robot.trace_singularities(question.phi, &question.signs, &window).map_err(|error| error.to_string())?;
    let legs = robot.leg_loci(question.phi).map_err(|error| error.to_string())?;
    let type_1: Vec<Vec<[[f64; 2]; 2]>> = legs
        .iter()
        .map(|leg| robot.trace_leg_locus(leg, question.phi, &window).iter().map(|p| p.map(Into::into)).collect())
        .collect();
    let none = Err("not asked for".to_owned());
    let report = SingularitiesReport::new(question.phi, none, &vec![(question.signs.clone(), pieces)], &legs, None);
    Ok(json!({ "report": report, "type_1": type_1 }))
}

/// The plane of two actuators.
#[derive(Deserialize)]
pub(crate) struct PlaneQuestion {
    model: Value,
    inputs: Vec<f64>,
    pair: [usize; 2],
    /// Columns and rows.
    size: [usize; 2],
}

/// Cells along a side that one question may ask for: a tenth of a second of work.
const MOST_CELLS: usize = 400;

pub(crate) fn plane(question: &PlaneQuestion) -> Result<Value, String> {
    let model = read_model(&question.model)?;
    let size = question.size.map(|cells| cells.clamp(1, MOST_CELLS));
    let plane = model.manipulator.actuator_plane(&question.inputs, question.pair, size);
    let plane = plane.map_err(|error| error.to_string())?;
    // One digit a cell.
    let counts: String = plane.counts.iter().map(|count| char::from(b'0' + count.min(&9))).collect();
    let (low, high) = (plane.window.low, plane.window.high);
    Ok(
        json!({ "pair": plane.pair, "low": [low.x, low.y], "high": [high.x, high.y], "size": plane.size, "counts": counts }),
    )
}
