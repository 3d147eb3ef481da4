//! Joints as planar screws: the motion each gives the platform, and the force a leg can exert.
//!
//! A motion of the platform is a twist `(vx, vy, omega)`: the velocity of one fixed point of it, the *mark*, and its rate of turning. A force on
//! it is a wrench `(fx, fy, m)`: the force and its moment about the mark. Their product `fx·vx + fy·vy + m·omega` is power.
//! A revolute joint at `p` turns the mark about `p`; a slider moves it along. What a leg can withstand with two joints idle
//! is the wrench that does no work on either: the cross product of their screws. This one formula holds for every leg:
//!
//! | idle joints | wrench |
//! |---|---|
//! | RR at `p`, `q` | force `q - p` along the line through both pivots |
//! | PR, RP: direction `u`, pivot `p` | force `-i u` (RP: `i u`) through the pivot, at right angles to the slider |
//! | PP: directions `u`, `v` | no force, the moment `u × v` |
//!
//! Source: the derivation `velocity_row`; reciprocal screws go back to Ball (1900), for parallel manipulators to Mohamed and Duffy (1985).
//! Every function is written over a ring, so that the derivation can run it on symbols.

use super::describe::JointKind;
use crate::algebra::Ring;

/// The twist that a joint gives the platform at unit rate: `(vx, vy, omega)`.
///
/// `pivot` is the joint's origin, `direction` its x axis and `mark` the platform point whose velocity is meant, all in the base frame. A
/// direction that is not of length one stands for a slider at that rate.
///
/// ```
/// use assur::{JointKind, manipulator::joint_screw};
/// let [pivot, along, mark] = [[1.0, 0.0], [1.0, 0.0], [3.0, 0.0]];
/// assert_eq!(joint_screw(JointKind::Revolute, &pivot, &along, &mark), [0.0, 2.0, 1.0]);
/// assert_eq!(joint_screw(JointKind::Prismatic, &pivot, &along, &mark), [1.0, 0.0, 0.0]);
/// ```
pub fn joint_screw<R: Ring>(kind: JointKind, pivot: &[R; 2], direction: &[R; 2], mark: &[R; 2]) -> [R; 3] {
    match kind {
        JointKind::Revolute => [pivot[1].clone() - mark[1].clone(), mark[0].clone() - pivot[0].clone(), R::one()],
        JointKind::Prismatic => [direction[0].clone(), direction[1].clone(), R::zero()],
    }
}

/// The wrench that does no work on either of two screws: their cross product.
///
/// Zero where the two are dependent, that is, where two idle joints of a leg can move against each other with the platform at rest.
///
/// ```
/// use assur::{JointKind::Revolute, manipulator::{joint_screw, reciprocal_wrench}};
/// let pivot = |at: [f64; 2]| joint_screw(Revolute, &at, &[1.0, 0.0], &[0.0, 0.0]);
/// // A bar from (1, 0) to (1, 3) pushes along itself, with a moment of 3 about the origin.
/// assert_eq!(reciprocal_wrench(&pivot([1.0, 0.0]), &pivot([1.0, 3.0])), [0.0, 3.0, 3.0]);
/// ```
pub fn reciprocal_wrench<R: Ring>(first: &[R; 3], second: &[R; 3]) -> [R; 3] {
    let minor = |i: usize, j: usize| first[i].clone() * second[j].clone() - first[j].clone() * second[i].clone();
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// The power of a wrench on a twist.
pub fn power<R: Ring>(wrench: &[R; 3], twist: &[R; 3]) -> R {
    let term = |i: usize| wrench[i].clone() * twist[i].clone();
    term(0) + term(1) + term(2)
}

/// How fast a joint's screw changes: its pivot moves with `pivot_rate`, its direction turns at `turning`, the mark moves with `mark_rate`.
///
/// ```
/// use assur::{JointKind, manipulator::screw_rate};
/// let rate = screw_rate(JointKind::Prismatic, &[0.0, 0.0], &[1.0, 0.0], &2.0, &[0.0, 0.0]);
/// assert_eq!(rate, [0.0, 2.0, 0.0]);
/// ```
pub fn screw_rate<R: Ring>(
    kind: JointKind,
    pivot_rate: &[R; 2],
    direction: &[R; 2],
    turning: &R,
    mark_rate: &[R; 2],
) -> [R; 3] {
    match kind {
        JointKind::Revolute => {
            [pivot_rate[1].clone() - mark_rate[1].clone(), mark_rate[0].clone() - pivot_rate[0].clone(), R::zero()]
        }
        JointKind::Prismatic => {
            [-(turning.clone() * direction[1].clone()), turning.clone() * direction[0].clone(), R::zero()]
        }
    }
}
