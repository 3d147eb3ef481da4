//! What a manipulator is made of: legs, joints, placements, limits.
//!
//! With placements as rigid motions, the closure of a leg is
//! `base · J1(q1) · links[0] · J2(q2) · links[1] · J3(q3) = pose · platform`.
//! A revolute joint turns its outgoing frame by `q`; a prismatic joint slides it by `q` along its own x axis.

use std::f64::consts::FRAC_PI_2;
use std::str::FromStr;

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

impl JointKind {
    /// `R` or `P`.
    pub fn letter(self) -> char {
        match self {
            Self::Revolute => 'R',
            Self::Prismatic => 'P',
        }
    }
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
    ///
    /// At the multiples of pi/2, as `f64` has them, the direction is exact, although the cosine of such an angle is not quite zero.
    ///
    /// ```
    /// use assur::{Placement, nalgebra::Vector2};
    /// assert_eq!(Placement::turned(1.0, 2.0, std::f64::consts::FRAC_PI_2).direction, Vector2::new(0.0, 1.0));
    /// ```
    pub fn turned(x: f64, y: f64, angle_rad: f64) -> Self {
        let turns = (angle_rad / FRAC_PI_2).round();
        let direction = if turns * FRAC_PI_2 == angle_rad {
            quarter_turns(turns)
        } else {
            Vector2::new(angle_rad.cos(), angle_rad.sin())
        };
        Self { at: Vector2::new(x, y), direction }
    }

    /// A frame at a point, turned by an angle in degrees; exact at the multiples of 90.
    ///
    /// ```
    /// use assur::{Placement, nalgebra::Vector2};
    /// assert_eq!(Placement::turned_deg(0.0, 0.0, -180.0).direction, Vector2::new(-1.0, 0.0));
    /// ```
    pub fn turned_deg(x: f64, y: f64, angle_deg: f64) -> Self {
        let reduced = angle_deg % 360.0;
        let turns = (reduced / 90.0).round();
        if turns * 90.0 == reduced {
            Self { at: Vector2::new(x, y), direction: quarter_turns(turns) }
        } else {
            Self::turned(x, y, reduced.to_radians())
        }
    }
}

/// The x axis after a whole number of quarter turns.
fn quarter_turns(turns: f64) -> Vector2<f64> {
    match turns.rem_euclid(4.0) {
        1.0 => Vector2::new(0.0, 1.0),
        2.0 => Vector2::new(-1.0, 0.0),
        3.0 => Vector2::new(0.0, -1.0),
        _ => Vector2::new(1.0, 0.0),
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

/// Why a text names no leg.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("joints \"{text}\": {reason}")]
pub struct JointsError {
    /// The text found.
    pub text: String,
    /// What is wrong with it.
    pub reason: JointsReason,
}

/// What is wrong with the text of a leg.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum JointsReason {
    /// A letter is neither R nor P.
    #[error("unknown joint letter {0:?}, must be R or P")]
    UnknownLetter(char),
    /// Not three joints.
    #[error("{0} joints, must be 3")]
    Count(usize),
    /// An underscore without its partner around one joint.
    #[error("an actuated joint stands between two underscores, as in R_P_R")]
    Underscore,
}

impl FromStr for Leg {
    type Err = JointsError;

    /// A leg of this type with every placement at the origin, to be filled in.
    ///
    /// An actuated joint stands between underscores: `R_P_R`, `_R_RR`; with several, each between its own: `_R__P_R`.
    ///
    /// ```
    /// use assur::{JointKind, Leg};
    /// let leg: Leg = "_P_RR".parse().unwrap();
    /// assert_eq!(leg.joints[0], JointKind::Prismatic);
    /// assert_eq!(leg.actuated, [true, false, false]);
    /// let error = "R_X_R".parse::<Leg>().unwrap_err();
    /// assert_eq!(error.to_string(), "joints \"R_X_R\": unknown joint letter 'X', must be R or P");
    /// ```
    fn from_str(text: &str) -> Result<Self, JointsError> {
        let error = |reason| JointsError { text: text.to_owned(), reason };
        let kind = |letter| match letter {
            'R' => Ok(JointKind::Revolute),
            'P' => Ok(JointKind::Prismatic),
            other => Err(error(JointsReason::UnknownLetter(other))),
        };
        let mut joints = Vec::new();
        let mut letters = text.chars();
        while let Some(letter) = letters.next() {
            if letter == '_' {
                let inner = letters.next().filter(|&c| c != '_').ok_or_else(|| error(JointsReason::Underscore))?;
                joints.push((kind(inner)?, true));
                if letters.next() != Some('_') {
                    return Err(error(JointsReason::Underscore));
                }
            } else {
                joints.push((kind(letter)?, false));
            }
        }
        let joints: [(JointKind, bool); 3] =
            joints.try_into().map_err(|found: Vec<_>| error(JointsReason::Count(found.len())))?;
        Ok(Self::of(joints.map(|(kind, _)| kind), joints.map(|(_, actuated)| actuated)))
    }
}

impl Leg {
    fn of(joints: [JointKind; 3], actuated: [bool; 3]) -> Self {
        Self {
            joints,
            actuated,
            base: Placement::default(),
            links: [Placement::default(); 2],
            platform: Placement::default(),
            limits: [None; 3],
        }
    }

    /// `R_P_R`: an actuated strut from the base pivot `a` to the platform pivot `b`.
    ///
    /// ```
    /// use assur::Leg;
    /// assert_eq!(Leg::rpr([0.0, 0.0], [1.0, 0.0]).name(), "R_P_R");
    /// ```
    pub fn rpr(a: [f64; 2], b: [f64; 2]) -> Self {
        use JointKind::{Prismatic, Revolute};
        let leg = Self::of([Revolute, Prismatic, Revolute], [false, true, false]);
        Self { base: Placement::at(a[0], a[1]), platform: Placement::at(b[0], b[1]), ..leg }
    }

    /// `_R_RR`: a crank of length `l1` driven at the base pivot `a`, a coupler of length `l2`, the platform pivot `b`.
    ///
    /// ```
    /// use assur::Leg;
    /// assert_eq!(Leg::rrr([0.0, 0.0], 2.0, 3.0, [1.0, 0.0]).name(), "_R_RR");
    /// ```
    pub fn rrr(a: [f64; 2], l1: f64, l2: f64, b: [f64; 2]) -> Self {
        let leg = Self::of([JointKind::Revolute; 3], [true, false, false]);
        Self {
            base: Placement::at(a[0], a[1]),
            links: [Placement::at(l1, 0.0), Placement::at(l2, 0.0)],
            platform: Placement::at(b[0], b[1]),
            ..leg
        }
    }

    /// `_P_RR`: a driven slider on the base through `a` at the angle `alpha` (radians), a link of length `l`, the platform pivot `b`.
    ///
    /// ```
    /// use assur::Leg;
    /// assert_eq!(Leg::prr([0.0, 0.0], 0.5, 3.0, [1.0, 0.0]).name(), "_P_RR");
    /// ```
    pub fn prr(a: [f64; 2], alpha: f64, l: f64, b: [f64; 2]) -> Self {
        use JointKind::{Prismatic, Revolute};
        let leg = Self::of([Prismatic, Revolute, Revolute], [true, false, false]);
        Self {
            base: Placement::turned(a[0], a[1], alpha),
            links: [Placement::default(), Placement::at(l, 0.0)],
            platform: Placement::at(b[0], b[1]),
            ..leg
        }
    }

    /// `_R_RP`: a crank of length `l` driven at the base pivot `a`, pivoted to a slider on the platform line through `b` at the angle
    /// `beta` (radians, in the platform frame).
    ///
    /// ```
    /// use assur::Leg;
    /// assert_eq!(Leg::rrp([0.0, 0.0], 2.0, [1.0, 0.0], 0.5).name(), "_R_RP");
    /// ```
    pub fn rrp(a: [f64; 2], l: f64, b: [f64; 2], beta: f64) -> Self {
        use JointKind::{Prismatic, Revolute};
        let leg = Self::of([Revolute, Revolute, Prismatic], [true, false, false]);
        Self {
            base: Placement::at(a[0], a[1]),
            links: [Placement::at(l, 0.0), Placement::default()],
            platform: Placement::turned(b[0], b[1], beta),
            ..leg
        }
    }

    /// `_P_RP`: a driven slider on the base through `a` at the angle `alpha`, pivoted to a slider on the platform line through `b` at
    /// the angle `beta` (both in radians).
    ///
    /// ```
    /// use assur::Leg;
    /// assert_eq!(Leg::prp([0.0, 0.0], 0.1, [1.0, 0.0], 0.5).name(), "_P_RP");
    /// ```
    pub fn prp(a: [f64; 2], alpha: f64, b: [f64; 2], beta: f64) -> Self {
        use JointKind::{Prismatic, Revolute};
        let leg = Self::of([Prismatic, Revolute, Prismatic], [true, false, false]);
        Self { base: Placement::turned(a[0], a[1], alpha), platform: Placement::turned(b[0], b[1], beta), ..leg }
    }

    /// The leg's type: its joints, base first, actuated ones between underscores.
    ///
    /// ```
    /// use assur::Leg;
    /// assert_eq!("_R__P_R".parse::<Leg>().unwrap().name(), "_R__P_R");
    /// ```
    pub fn name(&self) -> String {
        let mark = |(kind, actuated): (&JointKind, &bool)| {
            if *actuated { format!("_{}_", kind.letter()) } else { kind.letter().to_string() }
        };
        self.joints.iter().zip(&self.actuated).map(mark).collect()
    }

    /// The letters of the joints that are not actuated, base first: `RR` for `R_P_R`. Two letters name the dyad the locked leg leaves.
    pub fn passive_joints(&self) -> String {
        let passive = self.joints.iter().zip(&self.actuated).filter(|(_, actuated)| !**actuated);
        passive.map(|(kind, _)| kind.letter()).collect()
    }
}

/// A platform on two or three legs with three actuated joints in all.
///
/// ```
/// use assur::{Leg, Manipulator};
/// let leg = |a, b| Leg::rpr(a, b);
/// let robot = Manipulator::new("demo", vec![
///     leg([0.0, 0.0], [0.0, 0.0]),
///     leg([16.0, 0.0], [17.0, 0.0]),
///     leg([0.0, 10.0], [13.0, 16.0]),
/// ]).unwrap();
/// assert_eq!(robot.family(), "3-R_P_R");
/// ```
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
    /// A leg's joints are not three letters R or P with underscores around the actuated ones.
    #[error("leg {leg}: {error}")]
    Joints {
        /// Leg, from 1.
        leg: usize,
        /// What is wrong with the text.
        error: JointsError,
    },
    /// Neither two nor three legs.
    #[error("leg: {found} given, must be 3 (or 2, with the three actuators on two legs)")]
    LegCount {
        /// Number of legs.
        found: usize,
    },
    /// Not three actuated joints.
    #[error("leg: {found} actuated joints in all ({family}), must be 3")]
    ActuatedCount {
        /// Number of actuated joints.
        found: usize,
        /// The types of the legs.
        family: String,
    },
    /// A number is NaN or infinite.
    #[error("{place}: {value} must be finite")]
    NotFinite {
        /// Leg and field: `leg 2: links[1].at`; or `reference`.
        place: String,
        /// The number found.
        value: f64,
    },
    /// The x axis of a placement points nowhere.
    #[error("leg {leg}: {field}.direction: [0, 0] has no direction")]
    NoDirection {
        /// Leg, from 1.
        leg: usize,
        /// The placement.
        field: &'static str,
    },
    /// The range of a slider is empty.
    #[error("leg {leg}: limits of joint {joint}: [{}, {}] must not decrease", .limit[0], .limit[1])]
    EmptyRange {
        /// Leg, from 1.
        leg: usize,
        /// Joint, from 1.
        joint: usize,
        /// The range found.
        limit: [f64; 2],
    },
}

impl Manipulator {
    /// A manipulator of these legs, its reference point in the platform's origin, checked.
    ///
    /// # Errors
    /// See [`Manipulator::validate`].
    pub fn new(name: impl Into<String>, legs: Vec<Leg>) -> Result<Self, DescriptionError> {
        let robot = Self { name: name.into(), reference: Vector2::zeros(), legs };
        robot.validate()?;
        Ok(robot)
    }

    /// Whether the description is one: two or three legs, three actuated joints, every number finite, every direction somewhere, no
    /// slider range empty.
    ///
    /// # Errors
    /// The first thing that is not so, with its leg, field and value.
    ///
    /// ```
    /// use assur::{Leg, Manipulator};
    /// let one_short = Manipulator::new("", vec![Leg::rpr([0.0, 0.0], [1.0, 0.0]); 2]).unwrap_err();
    /// assert_eq!(one_short.to_string(), "leg: 2 actuated joints in all (2-R_P_R), must be 3");
    /// ```
    pub fn validate(&self) -> Result<(), DescriptionError> {
        let found = self.legs.len();
        if !(2..=3).contains(&found) {
            return Err(DescriptionError::LegCount { found });
        }
        let found = self.actuated_joints().count();
        if found != 3 {
            return Err(DescriptionError::ActuatedCount { found, family: self.family() });
        }
        finite(&self.reference, || "reference".to_owned())?;
        for (leg, description) in (1..).zip(&self.legs) {
            description.validate(leg)?;
        }
        Ok(())
    }

    /// The actuated joints as (leg, joint), both from 0, leg by leg, base first: the order of the inputs.
    ///
    /// ```
    /// use assur::{Leg, Manipulator};
    /// let legs = ["_R__P_R", "RR_R_"].map(|text| text.parse().unwrap()).to_vec();
    /// let robot = Manipulator::new("", legs).unwrap();
    /// assert_eq!(robot.actuated_joints().collect::<Vec<_>>(), [(0, 0), (0, 1), (1, 2)]);
    /// ```
    pub fn actuated_joints(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let joints = |(leg, description): (usize, &Leg)| {
            let actuated = description.actuated;
            (0..3).filter(move |&joint| actuated[joint]).map(move |joint| (leg, joint))
        };
        self.legs.iter().enumerate().flat_map(joints)
    }

    /// The family: `3-R_P_R` where all legs are alike, else their types: `R_P_R,_P_RR,_R_RR`.
    pub fn family(&self) -> String {
        let names: Vec<String> = self.legs.iter().map(Leg::name).collect();
        match names.split_first() {
            Some((first, rest)) if rest.iter().all(|name| name == first) => format!("{}-{first}", names.len()),
            _ => names.join(","),
        }
    }
}

impl Leg {
    fn validate(&self, leg: usize) -> Result<(), DescriptionError> {
        let placements = [
            ("base", &self.base),
            ("links[0]", &self.links[0]),
            ("links[1]", &self.links[1]),
            ("platform", &self.platform),
        ];
        for (field, placement) in placements {
            finite(&placement.at, || format!("leg {leg}: {field}.at"))?;
            finite(&placement.direction, || format!("leg {leg}: {field}.direction"))?;
            if placement.direction == Vector2::zeros() {
                return Err(DescriptionError::NoDirection { leg, field });
            }
        }
        for (joint, (kind, limit)) in (1..).zip(self.joints.iter().zip(&self.limits)) {
            let Some(limit) = *limit else { continue };
            finite(&Vector2::from(limit), || format!("leg {leg}: limits of joint {joint}"))?;
            if *kind == JointKind::Prismatic && limit[0] > limit[1] {
                return Err(DescriptionError::EmptyRange { leg, joint, limit });
            }
        }
        Ok(())
    }
}

fn finite(numbers: &Vector2<f64>, place: impl Fn() -> String) -> Result<(), DescriptionError> {
    match numbers.iter().find(|value| !value.is_finite()) {
        Some(&value) => Err(DescriptionError::NotFinite { place: place(), value }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_leg_type_is_read_and_named() {
        for chain in 0..8_u8 {
            for actuated in 0..8_u8 {
                let letter = |bit: u8| if chain >> bit & 1 == 0 { "R" } else { "P" };
                let joint = |bit| {
                    if actuated >> bit & 1 == 0 { letter(bit).to_owned() } else { format!("_{}_", letter(bit)) }
                };
                let text: String = (0..3).map(joint).collect();
                assert_eq!(text.parse::<Leg>().map(|leg| leg.name()), Ok(text));
            }
        }
    }

    #[test]
    fn unfinished_texts_are_refused() {
        for text in ["", "RR", "RRRR", "_R", "_RRR", "R__R", "R_P_R_", "_R_P_R", "r_p_r"] {
            assert!(text.parse::<Leg>().is_err(), "{text:?} was taken for a leg");
        }
    }

    #[test]
    fn quarter_turns_are_exact() {
        let exact = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        for turns in -9_i32..=9 {
            let direction = Vector2::from(exact[turns.rem_euclid(4) as usize]);
            assert_eq!(Placement::turned(0.0, 0.0, f64::from(turns) * FRAC_PI_2).direction, direction);
            assert_eq!(Placement::turned_deg(0.0, 0.0, f64::from(turns) * 90.0).direction, direction);
        }
        assert_ne!(Placement::turned(0.0, 0.0, 1.5707963267948963).direction, Vector2::new(0.0, 1.0));
        assert!(!Placement::turned(0.0, 0.0, f64::NAN).direction.x.is_finite());
    }

    #[test]
    fn what_is_no_manipulator_is_named() {
        let sound = || Manipulator::new("", vec![Leg::rrr([0.0, 0.0], 1.0, 1.0, [0.0, 0.0]); 3]).expect("is sound");
        let message = |change: fn(&mut Manipulator)| {
            let mut robot = sound();
            change(&mut robot);
            robot.validate().expect_err("is not sound").to_string()
        };
        assert_eq!(
            message(|robot| robot.legs.truncate(1)),
            "leg: 1 given, must be 3 (or 2, with the three actuators on two legs)"
        );
        assert_eq!(message(|robot| robot.legs[1].links[1].at.y = f64::NAN), "leg 2: links[1].at: NaN must be finite");
        assert_eq!(
            message(|robot| robot.legs[2].base.direction = Vector2::zeros()),
            "leg 3: base.direction: [0, 0] has no direction"
        );
        assert_eq!(
            message(
                |robot| robot.legs[0] = Leg { limits: [None, Some([2.0, 1.0]), None], ..Leg::rpr([0.0; 2], [0.0; 2]) }
            ),
            "leg 1: limits of joint 2: [2, 1] must not decrease"
        );
    }
}
