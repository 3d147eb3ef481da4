//! The numbers a design consists of, by name: what sweeps vary, gradients are taken by and optimisation chooses.
//!
//! A name follows the model file: `leg1.base.at.x`, `leg2.links1.at.x` (or `leg2.links1`, a length), `leg3.platform.angle`,
//! `leg1.limits.max`, `leg1.limits2.min` (of joint 2, driven or not), `reference.y`. `legs.` in place of a leg sets that number of every leg at once.

use std::fmt;
use std::str::FromStr;

use nalgebra::Vector2;
use thiserror::Error;

use super::describe::{JointKind, Leg, Manipulator, Placement};

/// A number of a manipulator's description.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum DesignNumber {
    /// A coordinate of the reference point in the platform frame: 0 for x, 1 for y.
    Reference(usize),
    /// A number of a placement of one leg.
    Placement {
        /// The leg, from 0.
        leg: usize,
        /// Which placement.
        part: DesignPart,
        /// Which number of it.
        number: DesignCoordinate,
    },
    /// An end of the range of a joint.
    Limit {
        /// The leg, from 0.
        leg: usize,
        /// The joint, from 0.
        joint: usize,
        /// The upper end, or the second angle.
        max: bool,
    },
}

/// A placement of a leg.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum DesignPart {
    /// The frame of the first joint.
    Base,
    /// `links[0]` or `links[1]`.
    Link(usize),
    /// The frame after the last joint.
    Platform,
}

/// A number of a placement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum DesignCoordinate {
    /// Of its origin.
    X,
    /// Of its origin.
    Y,
    /// Of its x axis, in radians.
    Angle,
}

/// A name that stands for one number of a design, or for the same number of every leg.
///
/// ```
/// use assur::{DesignKey, Manipulator};
/// let (mut robot, _) = Manipulator::of_family("3-RRR")?;
/// let key: DesignKey = "leg2.links1".parse()?;
/// let numbers = key.numbers(&robot)?;
/// robot.set_design_number(numbers[0], 7.5)?;
/// assert_eq!(robot.legs[1].links[0].at.x, 7.5);
/// assert_eq!("legs.platform.at.y".parse::<DesignKey>()?.numbers(&robot)?.len(), 3);
/// let error = "leg2.length".parse::<DesignKey>().unwrap_err().to_string();
/// assert!(error.starts_with("\"leg2.length\": no number of a design; names are leg1.base.at.x"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct DesignKey {
    text: String,
    leg: Which,
    field: Field,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Which {
    Reference,
    All,
    /// From 1, as written.
    One(usize),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Field {
    Reference(usize),
    Placement(DesignPart, DesignCoordinate),
    /// The joint from 0, or the leg's only driven one.
    Limit {
        joint: Option<usize>,
        max: bool,
    },
}

/// Why a name stands for no number of a design.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum DesignError {
    /// The name is not one.
    #[error(
        "\"{text}\": no number of a design; names are leg1.base.at.x, leg1.base.angle, leg1.links1 (a length), leg1.links2.at.y, leg1.platform.at.x, \
         leg1.limits.max, leg1.limits2.min (of joint 2), reference.x; legs. for every leg"
    )]
    Name {
        /// The text found.
        text: String,
    },
    /// There is no such leg.
    #[error("\"{key}\": there is no leg {leg}, the model has {legs}")]
    NoLeg {
        /// The name.
        key: String,
        /// The leg, from 1.
        leg: usize,
        /// How many there are.
        legs: usize,
    },
    /// `limits` without a joint, and the leg has not one driven joint.
    #[error("\"{key}\": leg {leg} has {driven} driven joints; name one, as in limits1.min")]
    WhichJoint {
        /// The name.
        key: String,
        /// The leg, from 1.
        leg: usize,
        /// How many of its joints are driven.
        driven: usize,
    },
    /// The joint has no range that could be changed.
    #[error("leg {leg}: joint {joint} has no limits in the model; give it some to vary them")]
    NoLimit {
        /// The leg, from 1.
        leg: usize,
        /// The joint, from 1.
        joint: usize,
    },
}

impl FromStr for DesignKey {
    type Err = DesignError;

    fn from_str(text: &str) -> Result<Self, DesignError> {
        parse(text).ok_or_else(|| DesignError::Name { text: text.to_owned() })
    }
}

impl fmt::Display for DesignKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

fn parse(text: &str) -> Option<DesignKey> {
    let mut words = text.split('.');
    let head = words.next()?;
    let rest: Vec<&str> = words.collect();
    let axis = |name: &str| match name {
        "x" => Some(DesignCoordinate::X),
        "y" => Some(DesignCoordinate::Y),
        _ => None,
    };
    let counted = |word: &str, stem: &str, most: usize| -> Option<usize> {
        word.strip_prefix(stem)?.parse().ok().filter(|n| (1..=most).contains(n))
    };
    let leg = match head {
        "reference" => Which::Reference,
        "legs" => Which::All,
        _ => Which::One(head.strip_prefix("leg")?.parse().ok().filter(|&n| n >= 1)?),
    };
    let field = match (leg, &rest[..]) {
        (Which::Reference, ["x"]) => Field::Reference(0),
        (Which::Reference, ["y"]) => Field::Reference(1),
        (Which::Reference, _) => return None,
        (_, [limits, end @ ("min" | "max")])
            if limits.starts_with("limits") || limits.starts_with("passive_limits") =>
        {
            let stem = if limits.starts_with("limits") { "limits" } else { "passive_limits" };
            let joint = if *limits == "limits" { None } else { Some(counted(limits, stem, 3)? - 1) };
            Field::Limit { joint, max: *end == "max" }
        }
        (_, [place, number @ ..]) => {
            let part = match *place {
                "base" => DesignPart::Base,
                "platform" => DesignPart::Platform,
                link => DesignPart::Link(counted(link, "links", 2)? - 1),
            };
            let number = match (part, number) {
                (_, ["angle"]) => DesignCoordinate::Angle,
                (_, ["at", name]) => axis(name)?,
                (DesignPart::Link(_), []) => DesignCoordinate::X,
                _ => return None,
            };
            Field::Placement(part, number)
        }
        _ => return None,
    };
    Some(DesignKey { text: text.to_owned(), leg, field })
}

impl DesignKey {
    /// Whether it stands for an angle of this manipulator.
    pub fn is_angle(&self, robot: &Manipulator) -> bool {
        self.numbers(robot).is_ok_and(|numbers| numbers.iter().all(|number| number.is_angle(robot)))
    }

    /// The numbers it stands for in a manipulator, leg by leg.
    ///
    /// # Errors
    /// A leg or a joint's range that is not there.
    pub fn numbers(&self, robot: &Manipulator) -> Result<Vec<DesignNumber>, DesignError> {
        let legs = robot.legs.len();
        let of = |leg: usize| -> Result<DesignNumber, DesignError> {
            let one =
                robot.legs.get(leg).ok_or_else(|| DesignError::NoLeg { key: self.text.clone(), leg: leg + 1, legs })?;
            match self.field {
                Field::Reference(axis) => Ok(DesignNumber::Reference(axis)),
                Field::Placement(part, number) => Ok(DesignNumber::Placement { leg, part, number }),
                Field::Limit { joint, max } => {
                    let driven: Vec<usize> = (0..3).filter(|&joint| one.actuated[joint]).collect();
                    let joint = match (joint, &driven[..]) {
                        (Some(joint), _) | (None, &[joint]) => joint,
                        _ => {
                            let (key, driven) = (self.text.clone(), driven.len());
                            return Err(DesignError::WhichJoint { key, leg: leg + 1, driven });
                        }
                    };
                    if one.limits[joint].is_none() {
                        return Err(DesignError::NoLimit { leg: leg + 1, joint: joint + 1 });
                    }
                    Ok(DesignNumber::Limit { leg, joint, max })
                }
            }
        };
        match (self.leg, self.field) {
            (Which::Reference, Field::Reference(axis)) => Ok(vec![DesignNumber::Reference(axis)]),
            (Which::One(leg), _) => Ok(vec![of(leg - 1)?]),
            _ => (0..legs).map(of).collect(),
        }
    }
}

impl DesignNumber {
    /// Whether it is an angle, in radians; a length otherwise.
    pub fn is_angle(&self, robot: &Manipulator) -> bool {
        match *self {
            Self::Reference(_) => false,
            Self::Placement { number, .. } => number == DesignCoordinate::Angle,
            Self::Limit { leg, joint, .. } => robot.legs[leg].joints[joint] == JointKind::Revolute,
        }
    }
}

impl Manipulator {
    /// A number of the design; angles in radians.
    ///
    /// # Errors
    /// The range of a joint that has none.
    pub fn design_number(&self, number: DesignNumber) -> Result<f64, DesignError> {
        match number {
            DesignNumber::Reference(axis) => Ok(self.reference[axis]),
            DesignNumber::Placement { leg, part, number } => {
                let placement = *part_of(&self.legs[leg], part);
                Ok(match number {
                    DesignCoordinate::X => placement.at.x,
                    DesignCoordinate::Y => placement.at.y,
                    DesignCoordinate::Angle => placement.direction.y.atan2(placement.direction.x),
                })
            }
            DesignNumber::Limit { leg, joint, max } => {
                let limit = self.legs[leg].limits[joint];
                limit.map(|ends| ends[usize::from(max)]).ok_or(DesignError::NoLimit { leg: leg + 1, joint: joint + 1 })
            }
        }
    }

    /// Sets a number of the design; angles in radians. What comes of it is checked by [`Manipulator::validate`].
    ///
    /// # Errors
    /// The range of a joint that has none.
    pub fn set_design_number(&mut self, number: DesignNumber, value: f64) -> Result<(), DesignError> {
        match number {
            DesignNumber::Reference(axis) => self.reference[axis] = value,
            DesignNumber::Placement { leg, part, number } => {
                let placement = part_of_mut(&mut self.legs[leg], part);
                match number {
                    DesignCoordinate::X => placement.at.x = value,
                    DesignCoordinate::Y => placement.at.y = value,
                    DesignCoordinate::Angle => placement.direction = direction(value),
                }
            }
            DesignNumber::Limit { leg, joint, max } => {
                let none = DesignError::NoLimit { leg: leg + 1, joint: joint + 1 };
                self.legs[leg].limits[joint].as_mut().ok_or(none)?[usize::from(max)] = value;
            }
        }
        Ok(())
    }
}

/// The direction at an angle, exact at quarter turns.
fn direction(angle: f64) -> Vector2<f64> {
    Placement::turned(0.0, 0.0, angle).direction
}

fn part_of(leg: &Leg, part: DesignPart) -> &Placement {
    match part {
        DesignPart::Base => &leg.base,
        DesignPart::Link(k) => &leg.links[k],
        DesignPart::Platform => &leg.platform,
    }
}

fn part_of_mut(leg: &mut Leg, part: DesignPart) -> &mut Placement {
    match part {
        DesignPart::Base => &mut leg.base,
        DesignPart::Link(k) => &mut leg.links[k],
        DesignPart::Platform => &mut leg.platform,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_are_none_are_refused() {
        for text in [
            "",
            "leg0.base.at.x",
            "leg1",
            "leg1.base",
            "leg1.links3",
            "leg1.limits",
            "leg1.limits4.min",
            "reference",
            "legx.base.at.x",
            "leg1.base.at.z",
            "leg1.platform",
        ] {
            assert!(text.parse::<DesignKey>().is_err(), "{text}");
        }
    }

    #[test]
    fn what_is_set_is_read_back() {
        let (mut robot, _) = Manipulator::of_family("3-RPR").expect("a family");
        robot.legs.iter_mut().for_each(|leg| leg.limits = [Some([0.0, 1.0]), Some([5.0, 9.0]), None]);
        let keys = [
            "leg1.base.at.x",
            "leg2.platform.angle",
            "legs.limits.max",
            "leg3.limits1.min",
            "leg1.links2.at.y",
            "reference.y",
        ];
        for (k, text) in keys.into_iter().enumerate() {
            let key: DesignKey = text.parse().expect("a name");
            let value = 0.25 + 0.1 * k as f64;
            for number in key.numbers(&robot).expect("are there") {
                robot.set_design_number(number, value).expect("is there");
                assert!((robot.design_number(number).expect("is there") - value).abs() < 1e-15, "{text}");
            }
            assert_eq!(key.to_string(), text);
        }
        let none: DesignKey = "leg1.limits3.min".parse().expect("a name");
        assert_eq!(
            none.numbers(&robot).unwrap_err().to_string(),
            "leg 1: joint 3 has no limits in the model; give it some to vary them"
        );
        let far: DesignKey = "leg4.base.at.x".parse().expect("a name");
        assert_eq!(
            far.numbers(&robot).unwrap_err().to_string(),
            "\"leg4.base.at.x\": there is no leg 4, the model has 3"
        );
        assert!("leg1.limits1.max".parse::<DesignKey>().expect("a name").is_angle(&robot));
        assert!(!"leg1.limits.max".parse::<DesignKey>().expect("a name").is_angle(&robot));
    }
}
