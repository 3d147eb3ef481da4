//! What is left when the actuators are held: each leg becomes a dyad.
//!
//! With joint `k` held at `q`, the placements around it join: `T_(k-1) · J_k(q) · T_k`. What remains of the leg is a near part on
//! the base, a middle part between the two passive joints and a far part on the platform. They give
//!
//! | passive | dyad |
//! |---|---|
//! | RR | `a = near`, `length = abs(middle)`, `b = far` |
//! | PR | the line through `a = near·middle` along `u = near`'s x axis, `b = far` |
//! | RP | `a = near`, `b = far`, `v = far`'s x axis, `d = -Im(conj(e^(i delta)) t)` for the middle part `(t, delta)` |
//! | PP | `phi` = the angles of near and middle less that of far |
//!
//! The derivation `leg_reductions` works out all 21 leg types. A leg with two held joints pins or guides the platform; one with three
//! places it; one with none lets it go.

use arrayvec::ArrayVec;
use nalgebra::Vector2;
use thiserror::Error;

use super::describe::{JointKind, Leg, Manipulator, Placement};
use super::frame::{back, times, unit};
use crate::linkage::{Dyad, Offset, PinnedDyad, PinnedDyadError, Pose, Triad, TriadError};

/// A leg with its actuated joints held.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LockedLeg {
    /// From the base frame to the first passive joint.
    pub near: Placement,
    /// Passive joints, each with the placement that follows it, save that the last one's is `far`.
    pub passive: ArrayVec<(usize, JointKind), 3>,
    /// Placements between consecutive passive joints.
    pub between: ArrayVec<Placement, 3>,
    /// The frame after the last passive joint, in the platform frame.
    pub far: Placement,
}

/// What is left of a manipulator when its actuators are held.
#[derive(Clone, Debug, PartialEq)]
pub enum LockedGroup {
    /// Three dyads.
    Triad(Triad),
    /// Two actuators on one leg pin a platform point; another leg is a dyad.
    Pinned(PinnedDyad),
    /// Three actuators on one leg place the platform.
    Placed(Pose),
}

impl LockedGroup {
    /// det A in a pose that closes: [`Triad::det_a`], [`PinnedDyad::det_a`], and 1 where the actuators place the platform.
    ///
    /// [`Manipulator::forward`] and [`Manipulator::follow`] report this number. How it goes with the determinant of [`crate::Velocity::pose_matrix`]
    /// is said in the module `det_a` of `linkage`, and held by the test `kinematics_det_a`.
    ///
    /// ```
    /// use assur::Manipulator;
    /// let (robot, inputs) = Manipulator::of_family("3-PRR")?;
    /// let mode = &robot.forward(&inputs)?.modes[0].mode;
    /// assert!((robot.lock(&inputs)?.det_a(&mode.pose) - mode.det_a).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn det_a(&self, pose: &Pose) -> f64 {
        match self {
            Self::Triad(triad) => triad.det_a(pose),
            Self::Pinned(pinned) => pinned.det_a(pose),
            Self::Placed(_) => 1.0,
        }
    }
}

/// Why actuator values leave no group that could be assembled. Legs and joints are counted from 1.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum LockError {
    /// Not as many inputs as actuated joints.
    #[error("inputs: {found} given, {expected} actuated joints")]
    WrongCount {
        /// Number of actuated joints.
        expected: usize,
        /// Number of values given.
        found: usize,
    },
    /// An input is NaN or infinite.
    #[error("leg {leg}: input of joint {joint}: {value} must be finite")]
    NotFinite {
        /// Leg, from 1.
        leg: usize,
        /// Joint, from 1.
        joint: usize,
        /// The number found.
        value: f64,
    },
    /// An input lies outside its joint's range.
    #[error("leg {leg}: input {value} of joint {joint} is outside limits [{}, {}]", .limit[0], .limit[1])]
    OutOfRange {
        /// Leg, from 1.
        leg: usize,
        /// Joint, from 1.
        joint: usize,
        /// The value given.
        value: f64,
        /// The range.
        limit: [f64; 2],
    },
    /// Several legs fix the orientation and leave a translation free.
    #[error(
        "legs {first} and {second} are both left with PP: the orientation is fixed twice and a translation is left free, so \
         three actuators do not determine the pose"
    )]
    OrientationTwice {
        /// Leg, from 1.
        first: usize,
        /// Leg, from 1.
        second: usize,
    },
    /// The two passive sliders of a leg are parallel: the leg has lost a freedom.
    #[error("leg {leg}: its passive sliders are parallel, so the leg moves in one direction only and restrains twice")]
    ParallelPassiveSliders {
        /// Leg, from 1.
        leg: usize,
    },
    /// The description's numbers lead to a group that is none.
    #[error(transparent)]
    Triad(#[from] TriadError),
    /// The same for a pinned platform.
    #[error(transparent)]
    Pinned(#[from] PinnedDyadError),
}

/// Two passive sliders closer to parallel than this, as the sine of their angle, have lost their second direction: a few
/// roundings of the directions' product.
const PARALLEL_SINE: f64 = 1e-15;

impl Manipulator {
    /// The group that is left when the actuators are held at these values.
    ///
    /// **Shape**: one input per actuated joint, leg by leg, base first. **Units**: lengths for sliders, radians for revolute joints.
    ///
    /// # Errors
    /// Inputs that are too few, too many, not finite or outside their ranges; groups that three actuators do not determine.
    ///
    /// ```
    /// use assur::{LockedGroup, Leg, Manipulator};
    /// let robot = Manipulator::new("", [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]].map(|a| Leg::rpr(a, a)).to_vec())?;
    /// let LockedGroup::Triad(triad) = robot.lock(&[1.0, 1.5, 2.0])? else { panic!("three dyads") };
    /// assert_eq!(triad.name(), "RR-RR-RR");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn lock(&self, inputs: &[f64]) -> Result<LockedGroup, LockError> {
        self.check_inputs(inputs)?;
        if let Some(dyads) = self.three_dyads(inputs) {
            return Ok(LockedGroup::Triad(Triad::new(dyads)?));
        }
        let legs = self.locked_legs(inputs)?;
        let fixed = |leg: &LockedLeg| matches!(leg.reduce(), Reduced::Dyad(Dyad::PP { .. }) | Reduced::Guided(..));
        let mut fixing = (1..).zip(&legs).filter(|(_, leg)| fixed(leg)).map(|(number, _)| number);
        if let (Some(first), Some(second)) = (fixing.next(), fixing.next()) {
            return Err(LockError::OrientationTwice { first, second });
        }
        for (leg, locked) in (1..).zip(&legs) {
            if let [(_, JointKind::Prismatic), (_, JointKind::Prismatic)] = locked.passive[..] {
                let direction = locked.between[0].direction;
                if direction.y.abs() <= PARALLEL_SINE * direction.norm() {
                    return Err(LockError::ParallelPassiveSliders { leg });
                }
            }
        }
        // Three passive joints or more in all are left free by a leg without actuator; the others hold the platform.
        let holding: ArrayVec<Reduced, 3> =
            legs.iter().map(LockedLeg::reduce).filter(|r| *r != Reduced::Free).collect();
        Ok(match holding[..] {
            [Reduced::Dyad(first), Reduced::Dyad(second), Reduced::Dyad(third)] => {
                LockedGroup::Triad(Triad::new([first, second, third])?)
            }
            [Reduced::Guided(slide, line), Reduced::Dyad(leg)] | [Reduced::Dyad(leg), Reduced::Guided(slide, line)] => {
                LockedGroup::Triad(Triad::new([slide, line, leg])?)
            }
            [Reduced::Pinned(a, b), Reduced::Dyad(leg)] | [Reduced::Dyad(leg), Reduced::Pinned(a, b)] => {
                LockedGroup::Pinned(PinnedDyad::new(a, b, leg)?)
            }
            [Reduced::Placed(pose)] => LockedGroup::Placed(pose),
            _ => unreachable!("three actuators on two or three legs hold the platform in one of these ways"),
        })
    }

    /// The dyads of three legs with one actuator each, none of them PP: the common case, without the general chains. Inputs are checked.
    fn three_dyads(&self, inputs: &[f64]) -> Option<[Dyad; 3]> {
        let ([first, second, third], &[p, q, r]) = (&self.legs[..], inputs) else { return None };
        Some([LockedLeg::one_held(first, p)?, LockedLeg::one_held(second, q)?, LockedLeg::one_held(third, r)?])
    }

    fn check_inputs(&self, inputs: &[f64]) -> Result<(), LockError> {
        let expected = self.actuated_joints().count();
        if expected != inputs.len() {
            return Err(LockError::WrongCount { expected, found: inputs.len() });
        }
        for ((leg, joint), &value) in self.actuated_joints().zip(inputs) {
            let description = &self.legs[leg];
            if !value.is_finite() {
                return Err(LockError::NotFinite { leg: leg + 1, joint: joint + 1, value });
            }
            if let Some(limit) = description.limits[joint].filter(|&l| !within(description.joints[joint], value, l)) {
                return Err(LockError::OutOfRange { leg: leg + 1, joint: joint + 1, value, limit });
            }
        }
        Ok(())
    }

    /// Every leg with its actuated joints held, inputs checked.
    pub(super) fn locked_legs(&self, inputs: &[f64]) -> Result<ArrayVec<LockedLeg, 3>, LockError> {
        self.check_inputs(inputs)?;
        let actuated: ArrayVec<(usize, usize), 9> = self.actuated_joints().collect();
        let held = |leg: usize| {
            let of_leg = actuated.iter().zip(inputs).filter(move |((l, _), _)| *l == leg);
            of_leg.map(|((_, joint), &q)| (*joint, q)).collect::<ArrayVec<_, 3>>()
        };
        Ok(self.legs.iter().enumerate().map(|(number, leg)| LockedLeg::new(leg, &held(number))).collect())
    }
}

/// How far outside its range, in units in the last place of the range's ends, a joint value may lie and still count as inside.
const LIMIT_SLACK: f64 = 4.0 * f64::EPSILON;

/// Whether a joint value lies in its range; a revolute range runs counter-clockwise from its first to its second angle, modulo a turn.
pub(super) fn within(kind: JointKind, value: f64, [low, high]: [f64; 2]) -> bool {
    use std::f64::consts::TAU;
    let slack = LIMIT_SLACK * low.abs().max(high.abs()).max(value.abs());
    match kind {
        JointKind::Prismatic => low - slack <= value && value <= high + slack,
        JointKind::Revolute => {
            let span = if high - low >= TAU { TAU } else { (high - low).rem_euclid(TAU) };
            let from_low = (value - low).rem_euclid(TAU);
            from_low <= span + slack || from_low >= TAU - slack
        }
    }
}

/// A locked leg as a condition on the platform.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Reduced {
    Dyad(Dyad),
    /// One passive revolute joint: the platform point `b` is at `a`.
    Pinned(Vector2<f64>, Vector2<f64>),
    /// One passive slider: the orientation is given and a platform point runs on a line.
    Guided(Dyad, Dyad),
    Placed(Pose),
    Free,
}

impl LockedLeg {
    /// `held`: joints from 0 with their values.
    pub fn new(leg: &Leg, held: &[(usize, f64)]) -> Self {
        let mut near = leg.base;
        let mut passive = ArrayVec::new();
        // One placement per passive joint, all that follows it up to the next.
        let mut after: ArrayVec<Placement, 3> = ArrayVec::new();
        let mut append = |after: &mut ArrayVec<Placement, 3>, motion: &Placement| match after.last_mut() {
            Some(last) => *last = last.then(motion),
            None => near = near.then(motion),
        };
        for joint in 0..3 {
            match held.iter().find(|(j, _)| *j == joint) {
                Some(&(_, q)) => append(&mut after, &Placement::joint(leg.joints[joint], q)),
                None => {
                    passive.push((joint, leg.joints[joint]));
                    after.push(Placement::default());
                }
            }
            if joint < 2 {
                append(&mut after, &leg.links[joint]);
            }
        }
        // What follows the last passive joint belongs to the platform: pose · platform = … · last, so far = platform · last⁻¹.
        let far = match after.pop() {
            Some(last) if last == Placement::default() => leg.platform,
            Some(last) => leg.platform.then(&last.inverse()),
            None => leg.platform,
        };
        Self { near, passive, between: after, far }
    }

    /// The dyad of a leg with one actuated joint, held; the same numbers as by [`LockedLeg::new`]. `None` for other legs and for PP.
    fn one_held(leg: &Leg, q: f64) -> Option<Dyad> {
        let [first, second, third] = leg.joints;
        let motion = |kind| Placement::joint(kind, q);
        match leg.actuated {
            [true, false, false] => {
                let near = leg.base.then(&motion(first)).then(&leg.links[0]);
                dyad(&near, [second, third], &leg.links[1], &leg.platform)
            }
            [false, true, false] => {
                let middle = leg.links[0].then(&motion(second)).then(&leg.links[1]);
                dyad(&leg.base, [first, third], &middle, &leg.platform)
            }
            [false, false, true] => {
                let last = leg.links[1].then(&motion(third));
                let far = if last == Placement::default() { leg.platform } else { leg.platform.then(&last.inverse()) };
                dyad(&leg.base, [first, second], &leg.links[0], &far)
            }
            _ => None,
        }
    }

    /// The platform's pose where every joint is held.
    pub fn placed(&self) -> Pose {
        self.near.then(&self.far.inverse()).pose()
    }

    fn reduce(&self) -> Reduced {
        let Self { near, far, .. } = self;
        let kinds: ArrayVec<JointKind, 3> = self.passive.iter().map(|p| p.1).collect();
        use JointKind::{Prismatic as P, Revolute as R};
        match (&kinds[..], &self.between[..]) {
            (&[first, second], [middle]) if [first, second] != [P, P] => {
                Reduced::Dyad(dyad(near, [first, second], middle, far).expect("a dyad other than PP"))
            }
            ([P, P], [middle]) => {
                let turned = times(times(near.direction, middle.direction), back(far.direction));
                Reduced::Dyad(Dyad::PP { phi: turned.y.atan2(turned.x) })
            }
            ([R], _) => Reduced::Pinned(near.at, far.at),
            ([P], _) => {
                let turned = times(near.direction, back(far.direction));
                let line = Dyad::PR { a: near.at, u: near.direction, b: far.at };
                Reduced::Guided(Dyad::PP { phi: turned.y.atan2(turned.x) }, line)
            }
            ([], _) => Reduced::Placed(self.placed()),
            _ => Reduced::Free,
        }
    }
}

/// What two passive joints leave, the part between them `middle`; `None` for PP, whose dyad is an angle.
fn dyad(near: &Placement, kinds: [JointKind; 2], middle: &Placement, far: &Placement) -> Option<Dyad> {
    use JointKind::{Prismatic as P, Revolute as R};
    Some(match kinds {
        [R, R] => Dyad::RR { a: near.at, b: far.at, length: middle.at.x.hypot(middle.at.y) },
        [P, R] => Dyad::PR { a: near.then(middle).at, u: near.direction, b: far.at },
        [R, P] => {
            let distance = -times(unit(back(middle.direction)), middle.at).y;
            Dyad::RP { a: near.at, b: far.at, v: far.direction, offset: offset(distance, far.direction) }
        }
        [P, P] => return None,
    })
}

/// A direction that came from an angle has length one up to rounding; its offset is taken as `delta`, undivided. One that
/// was given as a vector keeps the distance.
fn offset(distance: f64, v: Vector2<f64>) -> Offset {
    let near_one = (v.norm_squared() - 1.0).abs() <= 8.0 * f64::EPSILON;
    if near_one { Offset::TimesDirection(distance) } else { Offset::Distance(distance) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::manipulator::Manipulator;

    #[test]
    fn the_common_case_has_the_numbers_of_the_general_one() {
        let mut compared = 0;
        for joints in ["RRR", "RRP", "RPR", "PRR", "RPP", "PRP", "PPR"] {
            for held in 0..3 {
                let named: Vec<String> = joints
                    .chars()
                    .enumerate()
                    .map(|(k, j)| if k == held { format!("_{j}_") } else { j.into() })
                    .collect();
                let leg = Leg {
                    base: Placement::turned(1.0, -2.0, 0.3),
                    links: [
                        Placement::turned(0.7, 0.2, -1.1),
                        Placement { at: Vector2::new(2.0, 0.1), direction: Vector2::new(3.0, 4.0) },
                    ],
                    platform: Placement::turned(-0.4, 0.9, 2.0),
                    ..named.concat().parse().expect("a leg")
                };
                for q in [0.0, 0.37, -2.5] {
                    match LockedLeg::new(&leg, &[(held, q)]).reduce() {
                        Reduced::Dyad(Dyad::PP { .. }) => assert_eq!(LockedLeg::one_held(&leg, q), None),
                        reduced => assert_eq!(LockedLeg::one_held(&leg, q).map(Reduced::Dyad), Some(reduced)),
                    }
                    compared += 1;
                }
            }
        }
        assert_eq!(compared, 63);
        let (robot, inputs) = Manipulator::of_family("3-RPR").expect("a family");
        assert!(robot.three_dyads(&inputs).is_some());
    }
}
