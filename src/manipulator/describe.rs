//! What a manipulator is made of: legs, joints, placements, limits.
//!
//! With placements as rigid motions, the closure of a leg is
//! `base · J1(q1) · links[0] · J2(q2) · links[1] · J3(q3) = pose · platform`.
//! A revolute joint turns its outgoing frame by `q`; a prismatic joint slides it by `q` along its own x axis.

use nalgebra::Vector2;
use thiserror::Error;

/// The two kinds of planar joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// R: turns; its value is an angle in radians, counter-clockwise.
    Revolute,
    /// P: slides along its x axis; its value is a length.
    Prismatic,
}

/// A frame in another: where its origin lies and where its x axis points.
///
/// The direction may have any length; only where it points counts. Kept as given, a direction such as (3, 4) is exact, which
/// an angle is not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Origin, in the outer frame, in length units.
    pub at: Vector2<f64>,
    /// Direction of the x axis, in the outer frame, any length but zero.
    pub direction: Vector2<f64>,
}

impl Placement {
    /// A frame at a point, not turned.
    pub fn at(x: f64, y: f64) -> Self {
        Self { at: Vector2::new(x, y), direction: Vector2::x() }
    }

    /// A frame at a point, turned by an angle in radians.
    pub fn turned(x: f64, y: f64, angle_rad: f64) -> Self {
        // At quarter turns the direction is exact; cos(pi/2) in f64 is not zero.
        Self { at: Vector2::new(x, y), direction: Vector2::new(angle_rad.cos(), angle_rad.sin()) }
    }
}

impl Default for Placement {
    fn default() -> Self {
        Self::at(0.0, 0.0)
    }
}

/// A leg: three joints in series from base to platform.
#[derive(Clone, Debug, PartialEq)]
pub struct Leg {
    /// Kinds of the joints, base first.
    pub joints: [JointKind; 3],
    /// Which of them are actuated.
    pub actuated: [bool; 3],
    /// Frame of the first joint, in the base frame.
    pub base: Placement,
    /// Frame of joint 2 after joint 1, and of joint 3 after joint 2.
    pub links: [Placement; 2],
    /// Frame after the last joint, in the platform frame.
    pub platform: Placement,
    /// Range of each joint where it has one: lengths low to high, angles in radians counter-clockwise from the first to the second.
    pub limits: [Option<[f64; 2]>; 3],
}

/// A platform on two or three legs with three actuated joints in all.
#[derive(Clone, Debug, PartialEq)]
pub struct Manipulator {
    /// A name for people; may be empty.
    pub name: String,
    /// Reference point of workspaces, in the platform frame.
    pub reference: Vector2<f64>,
    /// The legs.
    pub legs: Vec<Leg>,
}

/// Why a description is no manipulator. Legs and joints are counted from 1.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum DescriptionError {
    /// Placeholder-free list begins here: a leg's joints are not written as three letters with underscores.
    #[error("leg {leg}: joints \"{text}\": {reason}")]
    Joints {
        /// Leg, from 1.
        leg: usize,
        /// The text found.
        text: String,
        /// What is wrong with it.
        reason: &'static str,
    },
}
