//! The assembly modes of a manipulator: each chain drawn from its nine joint values.

use nalgebra::{Isometry2, Vector2};

use super::scene::{Look, Mark, Scene, caption, heading, length, number, summary};
use super::sheet::sheet;
use crate::manipulator::{AssemblyModes, JointKind, Leg, Manipulator, ManipulatorMode};

/// Every assembly mode of a manipulator as one SVG document, small multiples on one scale.
///
/// The scale is set by the ordinary modes; one that runs many times as far is cut off and says so. Without modes the base is drawn.
pub fn draw_modes(robot: &Manipulator, answer: &AssemblyModes) -> String {
    let mut scenes: Vec<Scene> =
        (1..).zip(&answer.modes).map(|(number, mode)| mode_scene(robot, mode, number)).collect();
    if scenes.is_empty() {
        scenes.push(base_scene(robot));
    }
    let inputs =
        robot.actuated_joints().zip(&answer.inputs).map(|((leg, joint), &value)| match robot.legs[leg].joints[joint] {
            JointKind::Revolute => format!("{}°", number(value.to_degrees())),
            JointKind::Prismatic => length(value),
        });
    let inputs = inputs.collect::<Vec<_>>().join(", ");
    let count = summary(&answer.group.account, answer.modes.len(), answer.group.status);
    let (title, family) = heading(robot);
    sheet(&title, &format!("{family}inputs {inputs}  ·  {count}"), &scenes)
}

/// The symbols of one mode, from the back of the picture to its front; nothing is drawn for a caller that has a canvas of its own.
///
/// **Units and frame**: lengths of the mechanism, in the base frame.
///
/// ```
/// use assur::{Manipulator, plot::{Mark, mode_marks}};
/// let (robot, inputs) = Manipulator::of_family("3-RPR")?;
/// let mode = &robot.forward(&inputs)?.modes[0];
/// let struts = mode_marks(&robot, mode).iter().filter(|mark| matches!(mark, Mark::Telescope { .. })).count();
/// assert_eq!(struts, 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn mode_marks(robot: &Manipulator, mode: &ManipulatorMode) -> Vec<Mark> {
    let pose = mode.mode.pose;
    let corners = robot.legs.iter().map(|leg| pose.place(leg.platform.at)).collect();
    let mut marks = vec![Mark::Body { corners }, Mark::Frame { pose: pose.isometry() }];
    for (index, (leg, values)) in robot.legs.iter().zip(&mode.joints).enumerate() {
        let look = |joint: usize| Look {
            actuated: leg.actuated[joint],
            violated: mode.violations.iter().any(|found| (found.leg, found.joint) == (index + 1, joint + 1)),
        };
        draw_chain(&mut marks, leg, values, index + 1, look);
    }
    marks.sort_by_key(Mark::layer);
    marks
}

fn mode_scene(robot: &Manipulator, mode: &ManipulatorMode, number: usize) -> Scene {
    let caption = caption(&mode.mode, &mode.signs, !mode.violations.is_empty());
    Scene { marks: mode_marks(robot, mode), number: Some(number), caption, pose: Some(mode.mode.pose) }
}

fn draw_chain(marks: &mut Vec<Mark>, leg: &Leg, values: &[f64; 3], number: usize, look: impl Fn(usize) -> Look) {
    let frames = leg.frames(values);
    let (inner, outer) = (frames.map(|[before, _]| before), frames.map(|[_, after]| after));
    let at = |frame: &Isometry2<f64>| frame.translation.vector;
    let along = |frame: &Isometry2<f64>| frame.rotation * Vector2::x();
    marks.push(Mark::Number { at: at(&inner[0]), leg: number });
    for joint in 0..3 {
        let (from, to, direction) = (at(&inner[joint]), at(&outer[joint]), along(&inner[joint]));
        match (leg.joints[joint], joint) {
            (JointKind::Revolute, _) => {
                if joint == 0 {
                    marks.push(Mark::Ground { at: from });
                }
                marks.push(Mark::Pin { at: from, look: look(joint) });
            }
            (JointKind::Prismatic, 0) => {
                marks.push(Mark::Rail { from, to, along: direction, fixed: true });
                marks.push(Mark::Block { at: to, along: direction, look: look(joint) });
            }
            (JointKind::Prismatic, 1) => marks.push(Mark::Telescope { from, to, look: look(joint) }),
            // A last slider runs on a guide of the platform.
            (JointKind::Prismatic, _) => {
                marks.push(Mark::Rail { from: to, to: from, along: direction, fixed: false });
                marks.push(Mark::Block { at: from, along: direction, look: look(joint) });
            }
        }
    }
    for joint in 0..2 {
        marks.push(Mark::Bar { from: at(&outer[joint]), to: at(&inner[joint + 1]) });
    }
}

/// The base alone, where there is no mode to draw.
fn base_scene(robot: &Manipulator) -> Scene {
    let mut marks = Vec::new();
    for (index, leg) in robot.legs.iter().enumerate() {
        let (at, look) = (leg.base.at, Look { actuated: leg.actuated[0], violated: false });
        marks.push(Mark::Number { at, leg: index + 1 });
        match leg.joints[0] {
            JointKind::Revolute => {
                marks.extend([Mark::Ground { at }, Mark::Pin { at, look }]);
            }
            JointKind::Prismatic => {
                let along = leg.base.direction.normalize();
                marks.extend([Mark::Rail { from: at, to: at, along, fixed: true }, Mark::Block { at, along, look }]);
            }
        }
    }
    Scene { marks, number: None, caption: "no assembly mode".to_owned(), pose: None }
}
