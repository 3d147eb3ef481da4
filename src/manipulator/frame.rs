//! Rigid motions as chains of placements.
//!
//! A frame keeps its direction as a vector of any length: products of directions such as (3, 4) with the unturned (1, 0) stay
//! exact, and only where a point is moved is the direction brought to length one.

use nalgebra::{Isometry2, Translation2, UnitComplex, Vector2};

use super::describe::{JointKind, Leg, Placement};
use crate::linkage::Pose;

/// `p` turned by the direction `d` as a complex number of any length.
pub(super) fn times(d: Vector2<f64>, p: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(d.x * p.x - d.y * p.y, d.x * p.y + d.y * p.x)
}

/// The direction turned back: the complex conjugate.
pub(super) fn back(d: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(d.x, -d.y)
}

/// A direction of length one.
pub(super) fn unit(d: Vector2<f64>) -> Vector2<f64> {
    // Axes, by far the most, need no root; directions already of length one pass unchanged.
    if d == Vector2::x() {
        return d;
    }
    let length = d.x.hypot(d.y);
    if length == 1.0 { d } else { d / length }
}

impl Leg {
    /// Where its joints are for given values of them: the frames before and after each, what a drawing of the leg needs.
    ///
    /// **Shape**: `[joint][before, after]`, base first. **Units and frame**: lengths and radians, in the base frame; each joint's own x axis is that of the
    /// frame before it. **Accuracy**: a few roundings; directions are taken as angles.
    ///
    /// ```
    /// use assur::Leg;
    /// let leg = Leg::rpr([1.0, 0.0], [0.0, 0.0]);
    /// let [_, slider, _] = leg.frames(&[std::f64::consts::FRAC_PI_2, 2.0, 0.0]);
    /// assert!((slider[1].translation.vector - assur::nalgebra::Vector2::new(1.0, 2.0)).norm() < 1e-15);
    /// ```
    pub fn frames(&self, joints: &[f64; 3]) -> [[Isometry2<f64>; 2]; 3] {
        let mut frame = rigid_motion(&self.base);
        let mut out = [[Isometry2::identity(); 2]; 3];
        for (joint, value) in joints.iter().enumerate() {
            let before = frame;
            frame *= match self.joints[joint] {
                JointKind::Revolute => Isometry2::rotation(*value),
                JointKind::Prismatic => Isometry2::translation(*value, 0.0),
            };
            out[joint] = [before, frame];
            if let Some(link) = self.links.get(joint) {
                frame *= rigid_motion(link);
            }
        }
        out
    }
}

fn rigid_motion(placement: &Placement) -> Isometry2<f64> {
    let angle = placement.direction.y.atan2(placement.direction.x);
    Isometry2::from_parts(Translation2::from(placement.at), UnitComplex::new(angle))
}

impl Placement {
    /// This motion followed by another, given in the frame this one leads to.
    pub(super) fn then(&self, next: &Self) -> Self {
        Self { at: self.at + times(unit(self.direction), next.at), direction: times(self.direction, next.direction) }
    }

    /// The motion of a joint by `q`.
    pub(super) fn joint(kind: JointKind, q: f64) -> Self {
        match kind {
            JointKind::Revolute => Self::turned(0.0, 0.0, q),
            JointKind::Prismatic => Self::at(q, 0.0),
        }
    }

    /// The motion back.
    pub(super) fn inverse(&self) -> Self {
        let direction = back(self.direction);
        Self { at: -times(unit(direction), self.at), direction }
    }

    /// A pose as a placement.
    pub(super) fn of_pose(pose: &Pose) -> Self {
        Self::turned(pose.x, pose.y, pose.phi)
    }

    /// The angle of the direction, in (-pi, pi].
    pub(super) fn angle(&self) -> f64 {
        principal_angle(self.direction.y.atan2(self.direction.x))
    }

    /// This placement as a pose.
    pub(super) fn pose(&self) -> Pose {
        Pose::new(self.at.x, self.at.y, self.angle())
    }
}

/// The angle in (-pi, pi]; -pi is written pi. Takes any angle within a few turns.
pub(super) fn principal_angle(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    let reduced = angle - TAU * (angle / TAU).round();
    if reduced <= -PI { PI } else { reduced }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motions_compose_and_undo() {
        let a = Placement::turned(1.0, 2.0, 0.7);
        let b = Placement { at: Vector2::new(-3.0, 0.5), direction: Vector2::new(3.0, 4.0) };
        let round = a.then(&b).then(&b.inverse()).then(&a.inverse());
        assert!(round.at.norm() < 1e-15 && round.angle().abs() < 1e-15);
        assert_eq!(Placement::default().then(&b).direction, b.direction);
    }

    #[test]
    fn angles_are_principal() {
        use std::f64::consts::PI;
        assert_eq!(principal_angle(-PI), PI);
        assert_eq!(principal_angle(3.0 * PI), PI);
        assert_eq!(principal_angle(0.25), 0.25);
    }
}
