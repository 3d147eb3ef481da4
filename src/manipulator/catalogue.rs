//! A sound model of every family, to start from.
//!
//! The base and platform points are the same for all families; each leg's lengths and angles are then chosen so that the
//! manipulator closes near one pose, and rounded to numbers that are pleasant to edit. So every model has assembly modes for the
//! inputs that come with it.

use std::f64::consts::FRAC_PI_2;

use nalgebra::Vector2;
use thiserror::Error;

use super::describe::{JointKind, JointsError, Leg, Manipulator, Placement};
use super::lock::LockError;
use crate::linkage::Pose;

/// Base points of the legs: a scalene triangle not similar to the platform's, so that no family starts out degenerate.
const BASE: [[f64; 2]; 3] = [[0.0, 0.0], [20.0, 0.0], [8.0, 16.0]];
/// Platform points of the legs.
const PLATFORM: [[f64; 2]; 3] = [[0.0, 0.0], [9.0, 0.0], [5.0, 7.0]];
/// Directions of first sliders on the base, in degrees.
const BASE_SLIDERS: [f64; 3] = [60.0, 135.0, -75.0];
/// Directions of last sliders on the platform of legs that may choose them, in degrees.
const PLATFORM_SLIDERS: [f64; 3] = [30.0, 140.0, -100.0];
/// The pose near which every model closes.
const HOME: [f64; 3] = [5.5, 4.0, 0.3];
/// A second slider stands at right angles to the first.
const SECOND_SLIDER: f64 = FRAC_PI_2;

/// Why a text names no family.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum FamilyError {
    /// A leg type cannot be read.
    #[error(
        "family \"{family}\": {error}; known are 3-RPR, 3-RRR, 3-PRR, 3-RRP, 3-PRP, any 3-R_P_R, any R_P_R,_P_RR,_R_RR"
    )]
    Joints {
        /// The text found.
        family: String,
        /// What is wrong with the leg.
        error: JointsError,
    },
    /// Not three legs with one actuator each.
    #[error("family \"{family}\": must be three legs with one actuated joint each, as in 3-R_P_R or R_P_R,_P_RR,_R_RR")]
    Shape {
        /// The text found.
        family: String,
    },
    /// The family exists, but three actuators do not determine the pose of any member.
    #[error("family \"{family}\": {error}")]
    Undetermined {
        /// The text found.
        family: String,
        /// Why.
        error: LockError,
    },
    /// Three sliders leave a leg that cannot turn.
    #[error("family \"{family}\": a leg PPP never turns the platform")]
    NeverTurns {
        /// The text found.
        family: String,
    },
}

impl Manipulator {
    /// A manipulator of a family, with inputs for which it has assembly modes.
    ///
    /// `3-RPR`, with the actuator where it is usual: the middle joint of RPR and RPP, else the base joint; or each leg with its actuator marked,
    /// `3-_R_RR`, `R_P_R,_P_RR,_R_RR`. Inputs: lengths, and angles in radians.
    ///
    /// # Errors
    /// A text that names no family of three legs with one actuator each; a family whose members no inputs determine, such as two legs left with PP.
    ///
    /// ```
    /// use assur::Manipulator;
    /// let (robot, inputs) = Manipulator::of_family("3-RPR").unwrap();
    /// assert_eq!(robot.family(), "3-R_P_R");
    /// assert_eq!(inputs.len(), 3);
    /// ```
    pub fn of_family(family: &str) -> Result<(Self, [f64; 3]), FamilyError> {
        let shape = || FamilyError::Shape { family: family.to_owned() };
        let texts = match family.strip_prefix("3-") {
            Some(text) => vec![text; 3],
            None => family.split(',').map(str::trim).collect(),
        };
        let texts: [&str; 3] = texts.try_into().map_err(|_| shape())?;
        let mut legs = Vec::new();
        let mut inputs = [0.0; 3];
        for (place, text) in texts.into_iter().enumerate() {
            let mut leg: Leg =
                text.parse().map_err(|error| FamilyError::Joints { family: family.to_owned(), error })?;
            if leg.joints == [JointKind::Prismatic; 3] {
                return Err(FamilyError::NeverTurns { family: family.to_owned() });
            }
            if leg.actuated == [false; 3] {
                leg.actuated[usual_actuator(&leg.joints)] = true;
            }
            let [driver] = (0..3).filter(|&joint| leg.actuated[joint]).collect::<Vec<_>>()[..] else {
                return Err(shape());
            };
            inputs[place] = fit(&mut leg, place)[driver];
            legs.push(leg);
        }
        let name = format!("A {} to start from", family.replace(',', ", "));
        let robot = Self { name, reference: Vector2::zeros(), legs };
        robot.lock(&inputs).map_err(|error| FamilyError::Undetermined { family: family.to_owned(), error })?;
        Ok((robot, inputs))
    }
}

/// Where the actuator of a chain usually sits.
fn usual_actuator(joints: &[JointKind; 3]) -> usize {
    usize::from(joints[0] == JointKind::Revolute && joints[1] == JointKind::Prismatic)
}

/// Chooses the leg's lengths and angles so that it closes near [`HOME`]; returns its joint values there, rounded.
fn fit(leg: &mut Leg, place: usize) -> [f64; 3] {
    use JointKind::{Prismatic, Revolute};
    let [x, y, phi] = HOME;
    let [a, b] = [BASE, PLATFORM].map(|points| Vector2::from(points[place]));
    let target = Pose::new(x, y, phi).place(b);
    let slider = BASE_SLIDERS[place];
    let along = Placement::turned_deg(0.0, 0.0, slider).direction;
    leg.base = Placement::at(a.x, a.y);
    leg.platform = Placement::at(b.x, b.y);
    let reach = target - a;
    let mut values = match leg.joints {
        [Revolute, Prismatic, Revolute] => [angle(reach), reach.norm(), 0.0],
        [Revolute, Revolute, Revolute] => {
            // Two links a little longer than half the way, elbow to the left.
            let length = (0.6 * reach.norm() * 10.0).ceil() / 10.0;
            leg.links = [Placement::at(length, 0.0), Placement::at(length, 0.0)];
            let half = (reach.norm() / (2.0 * length)).acos();
            [angle(reach) + half, -2.0 * half, 0.0]
        }
        [Prismatic, Revolute, Revolute] => {
            leg.base = Placement::turned_deg(a.x, a.y, slider);
            // The slider stands at the foot of the platform point, moved a little to keep clear of the dead centre.
            let travel = reach.dot(&along) - 2.0;
            let link = target - (a + along * travel);
            leg.links[1] = Placement::at(rounded(link.norm(), 10.0), 0.0);
            [travel, angle(link) - slider.to_radians(), 0.0]
        }
        [Prismatic, Prismatic, Revolute] => {
            leg.base = Placement::turned_deg(a.x, a.y, slider);
            leg.links[0] = Placement::turned(0.0, 0.0, SECOND_SLIDER);
            let across = Vector2::new(-along.y, along.x);
            [reach.dot(&along), reach.dot(&across), 0.0]
        }
        [Revolute, Revolute, Prismatic] => {
            let crank = rounded(0.5 * reach.norm(), 2.0);
            leg.links[0] = Placement::at(crank, 0.0);
            let turn = angle(reach) + 0.9;
            let travel = platform_slider(leg, target - (a + Vector2::new(turn.cos(), turn.sin()) * crank), phi);
            [turn, 0.0, travel]
        }
        [Prismatic, Revolute, Prismatic] => {
            leg.base = Placement::turned_deg(a.x, a.y, slider);
            let travel = 0.5 * reach.dot(&along);
            let slide = platform_slider(leg, target - (a + along * travel), phi);
            [travel, 0.0, slide]
        }
        [Revolute, Prismatic, Prismatic] => {
            leg.links[1] = Placement::turned(0.0, 0.0, SECOND_SLIDER);
            let beta = PLATFORM_SLIDERS[place].to_radians();
            leg.platform = Placement::turned_deg(b.x, b.y, PLATFORM_SLIDERS[place]);
            let turn = phi + beta - SECOND_SLIDER;
            let (sin, cos) = turn.sin_cos();
            [turn, reach.x * cos + reach.y * sin, reach.y * cos - reach.x * sin]
        }
        // Asked about before.
        [Prismatic, Prismatic, Prismatic] => [0.0; 3],
    };
    if leg.joints[2] == Revolute {
        let base_angle = leg.base.direction.y.atan2(leg.base.direction.x);
        let second = leg.links[0].direction.y.atan2(leg.links[0].direction.x);
        let turned: f64 = (0..2).filter(|&joint| leg.joints[joint] == Revolute).map(|joint| values[joint]).sum();
        values[2] = phi - base_angle - second - turned;
    } else if leg.joints[1] == Revolute {
        let base_angle = leg.base.direction.y.atan2(leg.base.direction.x);
        let first = if leg.joints[0] == Revolute { values[0] } else { 0.0 };
        let beta = leg.platform.direction.y.atan2(leg.platform.direction.x);
        values[1] = phi + beta - base_angle - first;
    }
    values.map(|value| rounded(value, 1000.0))
}

/// Turns the leg's platform slider so that it points along `way` at the orientation `phi`; returns how far along it `way` reaches.
fn platform_slider(leg: &mut Leg, way: Vector2<f64>, phi: f64) -> f64 {
    let beta = (angle(way) - phi).to_degrees().round();
    leg.platform = Placement::turned_deg(leg.platform.at.x, leg.platform.at.y, beta);
    way.norm()
}

fn angle(way: Vector2<f64>) -> f64 {
    way.y.atan2(way.x)
}

fn rounded(value: f64, parts: f64) -> f64 {
    (value * parts).round() / parts
}
