//! What can be taken hold of: points and axes of the design, the platform, the actuators.

use assur::exchange::ModelFile;
use assur::linkage::Pose;
use assur::nalgebra::{Rotation2, UnitComplex, Vector2};
use assur::{JointKind, Leg, Manipulator, ManipulatorMode};
use serde::Deserialize;
use serde_json::{Value, json};

use super::question::read_model;

/// How far from its point an axis is held, in characteristic lengths.
const ARM: f64 = 0.8;

/// What is pulled, and where to. Points in the base frame; legs from 0.
#[derive(Deserialize)]
#[serde(tag = "handle", rename_all = "snake_case")]
pub(crate) enum Pull {
    /// A leg's base point.
    Base { leg: usize, to: [f64; 2] },
    /// The direction of a first slider.
    BaseAxis { leg: usize, to: [f64; 2] },
    /// A leg's point on the platform.
    Platform { leg: usize, to: [f64; 2] },
    /// The direction of a last slider.
    PlatformAxis { leg: usize, to: [f64; 2] },
    /// The direction of a middle slider, whose axis starts in `from`.
    MiddleAxis { leg: usize, from: [f64; 2], to: [f64; 2] },
    /// The platform, by its origin.
    Pose { to: [f64; 2] },
    /// The platform, by its x axis.
    Turn { to: [f64; 2] },
    /// The platform, to a pose given by numbers.
    Place { to: [f64; 3] },
    /// An actuator.
    Input { number: usize, value: f64 },
    /// All actuators.
    Inputs { values: Vec<f64> },
    /// An actuator's limits; none for no limits.
    Limits { number: usize, range: Option<[f64; 2]> },
    /// The limits of all actuators that have none: the ranges that their sliders show.
    Bound,
    /// The whole design, edited as a file.
    Design { model: Value },
}

/// What a pull asks of the mechanism.
pub(crate) enum Wish {
    /// Another design, another input.
    Change(Box<ModelFile>, Vec<f64>),
    /// The platform in another pose.
    Guide(Pose),
}

impl Pull {
    /// `pose`: of the mode that is held.
    pub(crate) fn wish(&self, model: &ModelFile, inputs: &[f64], pose: Option<Pose>) -> Result<Wish, String> {
        let mut changed = model.clone();
        let legs = &mut changed.manipulator.legs;
        let held = pose.ok_or_else(|| "no assembly mode is held: take one of the modes first".to_owned());
        let no_leg = |leg: usize| format!("leg {} does not exist", leg + 1);
        // A point of the base frame in the platform's, and a direction.
        let in_platform = |pose: &Pose, to: &[f64; 2]| pose.isometry().inverse_transform_point(&(*to).into()).coords;
        let points_somewhere = |way: Vector2<f64>| way.try_normalize(0.0);
        match self {
            Self::Base { leg, to } => legs.get_mut(*leg).ok_or_else(|| no_leg(*leg))?.base.at = (*to).into(),
            Self::BaseAxis { leg, to } => {
                let base = &mut legs.get_mut(*leg).ok_or_else(|| no_leg(*leg))?.base;
                base.direction = points_somewhere(Vector2::from(*to) - base.at).unwrap_or(base.direction);
            }
            Self::Platform { leg, to } => {
                legs.get_mut(*leg).ok_or_else(|| no_leg(*leg))?.platform.at = in_platform(&held?, to);
            }
            Self::PlatformAxis { leg, to } => {
                let platform = &mut legs.get_mut(*leg).ok_or_else(|| no_leg(*leg))?.platform;
                let way = in_platform(&held?, to) - platform.at;
                platform.direction = points_somewhere(way).unwrap_or(platform.direction);
            }
            Self::MiddleAxis { leg, from, to } => {
                let leg = legs.get_mut(*leg).ok_or_else(|| no_leg(*leg))?;
                if let Some(way) = points_somewhere(Vector2::from(*to) - Vector2::from(*from)) {
                    turn_middle(leg, &held?, way);
                }
            }
            Self::Pose { to: [x, y] } => return Ok(Wish::Guide(Pose::new(*x, *y, held?.phi))),
            Self::Turn { to } => {
                let pose = held?;
                let way = Vector2::from(*to) - Vector2::new(pose.x, pose.y);
                return Ok(Wish::Guide(Pose::new(pose.x, pose.y, way.y.atan2(way.x))));
            }
            Self::Place { to: [x, y, phi] } => return Ok(Wish::Guide(Pose::new(*x, *y, *phi))),
            Self::Input { number, value } => {
                let mut inputs = inputs.to_vec();
                *inputs.get_mut(*number).ok_or_else(|| format!("actuator {} does not exist", number + 1))? = *value;
                return Ok(Wish::Change(Box::new(changed), inputs));
            }
            Self::Inputs { values } => return Ok(Wish::Change(Box::new(changed), values.clone())),
            Self::Limits { number, range } => {
                let actuator = model.manipulator.actuated_joints().nth(*number);
                let (leg, joint) = actuator.ok_or_else(|| format!("actuator {} does not exist", number + 1))?;
                legs[leg].limits[joint] = *range;
            }
            Self::Bound => {
                for (number, (leg, joint)) in model.manipulator.actuated_joints().enumerate() {
                    let limit = &mut legs[leg].limits[joint];
                    *limit = limit.or_else(|| model.manipulator.actuator_range(number));
                }
            }
            Self::Design { model } => changed = read_model(model)?,
        }
        changed.manipulator.validate().map_err(|error| error.to_string())?;
        // New limits may leave out where an actuator stands.
        let inputs = changed.manipulator.inputs_within_limits(inputs);
        Ok(Wish::Change(Box::new(changed), inputs))
    }
}

/// Gives a middle slider another direction: against the first slider, or a first joint that is driven; where that turns freely, against the last slider.
fn turn_middle(leg: &mut Leg, pose: &Pose, way: Vector2<f64>) {
    let angle = |way: Vector2<f64>| UnitComplex::new(way.y.atan2(way.x));
    let turned = |from: UnitComplex<f64>, to: UnitComplex<f64>| (to * from.inverse()) * Vector2::x();
    if leg.joints[0] == JointKind::Prismatic {
        leg.links[0].direction = turned(angle(leg.base.direction), angle(way));
    } else {
        let last = UnitComplex::new(pose.phi) * angle(leg.platform.direction);
        leg.links[1].direction = turned(angle(way), last);
    }
}

/// Whether a leg's middle joint is a slider whose direction against another slider is a number of the design.
fn has_middle_axis(leg: &Leg) -> bool {
    let slides = leg.joints.map(|kind| kind == JointKind::Prismatic);
    slides[1] && (slides[0] || (slides[2] && !leg.actuated[0]))
}

/// Where each handle is. `mode`: the one that is held; without one only the base has handles.
pub(crate) fn handles(robot: &Manipulator, mode: Option<&ManipulatorMode>) -> Vec<Value> {
    let arm = ARM * robot.characteristic_length();
    let point =
        |handle: &str, leg: usize, at: Vector2<f64>| json!({ "handle": handle, "leg": leg, "at": [at.x, at.y] });
    let mut out = Vec::new();
    for (number, leg) in robot.legs.iter().enumerate() {
        out.push(point("base", number, leg.base.at));
        if leg.joints[0] == JointKind::Prismatic {
            out.push(point("base_axis", number, leg.base.at + leg.base.direction.normalize() * arm));
        }
        let Some(ManipulatorMode { mode, joints, .. }) = mode else { continue };
        let at = mode.pose.place(leg.platform.at);
        out.push(point("platform", number, at));
        if leg.joints[2] == JointKind::Prismatic {
            let along = Rotation2::new(mode.pose.phi) * leg.platform.direction.normalize();
            out.push(point("platform_axis", number, at + along * arm));
        }
        if has_middle_axis(leg) {
            let [before, _] = leg.frames(&joints[number])[1];
            let from = before.translation.vector;
            let mut axis = point("middle_axis", number, from + before.rotation * Vector2::new(arm, 0.0));
            axis["from"] = json!([from.x, from.y]);
            out.push(axis);
        }
    }
    if let Some(pose) = mode.map(|mode| mode.mode.pose) {
        // The origin is often a leg's point, so the platform is held by the middle of its points.
        let points = robot.legs.iter().map(|leg| leg.platform.at);
        let middle = pose.place(points.sum::<Vector2<f64>>() / robot.legs.len() as f64);
        out.push(json!({ "handle": "pose", "at": [middle.x, middle.y], "origin": [pose.x, pose.y] }));
        let turn = pose.place(Vector2::new(arm, 0.0));
        out.push(json!({ "handle": "turn", "at": [turn.x, turn.y] }));
    }
    out
}
