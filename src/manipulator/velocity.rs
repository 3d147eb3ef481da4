//! How fast, how hard: rates, accelerations and forces, between actuators and platform.
//!
//! One pair of matrices answers all of it: `A·pose' + B·inputs' = 0`. Each row of `A` is the wrench that a leg can withstand with its idle joints
//! free ([`super::reciprocal_wrench`]); the entry of `B` is less the power of that wrench on the actuated joint's screw.
//!
//! | symbol | meaning |
//! |---|---|
//! | `s_k` | screw of joint `k`, mark in the platform's origin: `pose' = sum of s_k·q_k'` over the joints of any one leg |
//! | `w` | `s_i × s_j` for the idle joints `i < j` of the leg: the row of `A` |
//! | `B` | `-w·s_a` for the actuated joint `a`: less the determinant of the leg's screws, up to their order |
//! | `beta` | `-w·(sum of s_k'·q_k')`, quadratic in the rates: `A·pose'' + B·inputs'' + beta = 0` |
//!
//! **Scaling of rows**: with RR idle the force of the row is the vector from the first idle pivot to the second, so the row's unit is length;
//! with PR or RP it is a unit force; with PP there is no force and the moment is the sine between the sliders. For 3-PRR these are eqs. (11)-(19) of
//! Gosselin, Lemieux and Merlet (1996), with eq. (19) corrected; see the derivations `velocity_row`, `acceleration_term` and `prr_rows`.
//!
//! A leg with two actuators gives two rows, with three the three rows of a unit matrix; one without gives none.
//! Not here: dynamics; masses are unknown to the model.

use nalgebra::{Matrix3, Vector2, Vector3};
use thiserror::Error;

use super::describe::{JointKind, Manipulator};
use super::frame::unit;
use super::inverse::KinematicsError;
use super::joints::frames;
use super::screw::{joint_screw, reciprocal_wrench, screw_rate};
use crate::linkage::Pose;

/// The matrices of a manipulator in one pose and working mode, and what they say.
///
/// Pose rates are `(x', y', phi')` of the platform's origin, wrenches `(fx, fy, m)` about it; inputs leg by leg, base first.
#[derive(Clone, Debug, PartialEq)]
pub struct Velocity {
    /// The pose.
    pub pose: Pose,
    /// Joint values of each leg.
    pub joints: Vec<[f64; 3]>,
    /// `A`: one row a wrench.
    pub pose_matrix: Matrix3<f64>,
    /// `B`: diagonal where each leg has one actuator.
    pub input_matrix: Matrix3<f64>,
    /// The leg that each row comes from, counted from 1.
    pub row_legs: [usize; 3],
    legs: Vec<LegMotion>,
}

/// The instantaneous motion of a leg.
#[derive(Clone, Debug, PartialEq)]
struct LegMotion {
    kinds: [JointKind; 3],
    actuated: [bool; 3],
    pivots: [Vector2<f64>; 3],
    directions: [Vector2<f64>; 3],
    screws: [Vector3<f64>; 3],
    wrenches: Vec<Vector3<f64>>,
}

/// A matrix that cannot be inverted: the question has no answer in this pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum SingularMatrix {
    /// `A` is singular (type 2): actuator rates do not determine the platform's, actuator forces cannot hold every wrench.
    #[error("the pose matrix is singular (type 2): inputs do not determine the platform's motion")]
    Pose,
    /// `B` is singular (type 1): the platform cannot move in some direction, whatever the actuators do.
    #[error("the input matrix is singular (type 1): the platform's motion does not determine the inputs")]
    Input,
    /// A leg's idle joints move against each other with the platform at rest.
    #[error("leg {leg}: its idle joints move with the platform at rest, so their rates are not determined")]
    Leg {
        /// Leg, from 1.
        leg: usize,
    },
}

impl Manipulator {
    /// The velocity matrices in a pose and working mode.
    ///
    /// **Shape**: `pose_matrix · (x', y', phi') + input_matrix · inputs' = 0`. **Scaling of rows**: force as long as the distance of the
    /// idle pivots (RR), of length one (PR, RP), or none with the moment the sine between the sliders (PP). **Accuracy**: closed forms, a few roundings.
    /// **Cost**: two microseconds, the inverse kinematics included. **Source**: the derivation `velocity_row`.
    ///
    /// # Errors
    /// A pose that is not finite, a mode that is none, a leg that does not reach.
    ///
    /// ```
    /// use assur::{Manipulator, Pose, nalgebra::Vector3};
    /// let (robot, inputs) = Manipulator::of_family("3-RPR")?;
    /// let mode = &robot.forward(&inputs)?.modes[0];
    /// let velocity = robot.velocity(&mode.mode.pose, &mode.signs)?;
    /// let rates = velocity.input_rates(&Vector3::new(1.0, 0.0, 0.0))?;
    /// assert!((velocity.pose_rates(&rates)? - Vector3::new(1.0, 0.0, 0.0)).norm() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn velocity(&self, pose: &Pose, signs: &str) -> Result<Velocity, KinematicsError> {
        let mode = self.working_mode(pose, signs)?;
        Ok(self.velocity_at(pose, &mode.joints))
    }

    /// The velocity matrices in a pose with known joints, as [`Manipulator::forward`] gives them.
    ///
    /// The joints are taken at their word: that they close in this pose is not checked.
    pub fn velocity_at(&self, pose: &Pose, joints: &[[f64; 3]]) -> Velocity {
        let mark = Vector2::new(pose.x, pose.y);
        let legs: Vec<LegMotion> = self
            .legs
            .iter()
            .zip(joints)
            .map(|(leg, values)| {
                let frames = frames(leg, values);
                LegMotion::new(
                    leg.joints,
                    leg.actuated,
                    frames.map(|frame| frame.at),
                    frames.map(|frame| unit(frame.direction)),
                    mark,
                )
            })
            .collect();
        let (mut pose_matrix, mut input_matrix, mut row_legs) = (Matrix3::zeros(), Matrix3::zeros(), [0; 3]);
        let (mut row, mut first_input) = (0, 0);
        for (number, leg) in (1..).zip(&legs) {
            let actuated: Vec<usize> = (0..3).filter(|&joint| leg.actuated[joint]).collect();
            for wrench in &leg.wrenches {
                pose_matrix.set_row(row, &wrench.transpose());
                for (offset, &joint) in actuated.iter().enumerate() {
                    input_matrix[(row, first_input + offset)] = -wrench.dot(&leg.screws[joint]);
                }
                row_legs[row] = number;
                row += 1;
            }
            first_input += actuated.len();
        }
        Velocity { pose: *pose, joints: joints.to_vec(), pose_matrix, input_matrix, row_legs, legs }
    }
}

impl LegMotion {
    fn new(
        kinds: [JointKind; 3],
        actuated: [bool; 3],
        pivots: [Vector2<f64>; 3],
        directions: [Vector2<f64>; 3],
        mark: Vector2<f64>,
    ) -> Self {
        let screw = |k: usize| {
            let [p, d, m] = [pivots[k], directions[k], mark].map(<[f64; 2]>::from);
            joint_screw(kinds[k], &p, &d, &m)
        };
        let screws = [screw(0), screw(1), screw(2)];
        let idle: Vec<usize> = (0..3).filter(|&joint| !actuated[joint]).collect();
        let wrenches = match idle[..] {
            [] => vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            [only] => {
                // Two wrenches that do no work on one screw: forces through the pivot, or across the slider and a moment.
                let [x, y, _] = screws[only];
                match kinds[only] {
                    JointKind::Revolute => vec![[1.0, 0.0, -x], [0.0, 1.0, -y]],
                    JointKind::Prismatic => vec![[-y, x, 0.0], [0.0, 0.0, 1.0]],
                }
            }
            [first, second] => vec![reciprocal_wrench(&screws[first], &screws[second])],
            _ => Vec::new(),
        };
        Self {
            kinds,
            actuated,
            pivots,
            directions,
            screws: screws.map(Vector3::from),
            wrenches: wrenches.into_iter().map(Vector3::from).collect(),
        }
    }

    /// The joint rates with which the leg follows the platform; `None` where its idle joints are dependent.
    fn rates(&self, twist: &Vector3<f64>, inputs: &[f64], scale: f64) -> Option<[f64; 3]> {
        let mut rates = [0.0; 3];
        let mut inputs = inputs.iter();
        let mut rest = *twist;
        for joint in (0..3).filter(|&joint| self.actuated[joint]) {
            rates[joint] = *inputs.next()?;
            rest -= self.screws[joint] * rates[joint];
        }
        // Turning measured as the speed at the distance `scale`, so that no unit weighs more than another.
        let even = |v: &Vector3<f64>| Vector3::new(v.x, v.y, v.z * scale);
        let rest = even(&rest);
        let idle: Vec<usize> = (0..3).filter(|&joint| !self.actuated[joint]).collect();
        let screws: Vec<Vector3<f64>> = idle.iter().map(|&joint| even(&self.screws[joint])).collect();
        let found = match screws[..] {
            [] => vec![],
            [only] => vec![only.dot(&rest) / only.norm_squared()],
            [first, second] => {
                let across = first.cross(&second);
                let square = across.norm_squared();
                vec![rest.cross(&second).dot(&across) / square, first.cross(&rest).dot(&across) / square]
            }
            _ => (Matrix3::from_columns(&screws).try_inverse()? * rest).iter().copied().collect(),
        };
        for (&joint, rate) in idle.iter().zip(found) {
            rates[joint] = rate;
        }
        rates.iter().all(|rate| rate.is_finite()).then_some(rates)
    }

    /// `sum of s_k'·q_k'`: what the platform's acceleration is at constant joint rates.
    fn drift(&self, rates: &[f64; 3], mark_rate: Vector2<f64>) -> Vector3<f64> {
        let mut drift = Vector3::zeros();
        let mut turning = 0.0;
        for k in 0..3 {
            // The joints before it carry its pivot along.
            let pivot_rate: Vector2<f64> = (0..k)
                .map(|j| match self.kinds[j] {
                    JointKind::Revolute => {
                        let arm = self.pivots[k] - self.pivots[j];
                        Vector2::new(-arm.y, arm.x) * rates[j]
                    }
                    JointKind::Prismatic => self.directions[j] * rates[j],
                })
                .sum();
            let [pivot, direction, mark] = [pivot_rate, self.directions[k], mark_rate].map(<[f64; 2]>::from);
            drift += Vector3::from(screw_rate(self.kinds[k], &pivot, &direction, &turning, &mark)) * rates[k];
            if self.kinds[k] == JointKind::Revolute {
                turning += rates[k];
            }
        }
        drift
    }

    /// A length of the leg, to weigh turning against moving; never zero.
    fn scale(&self) -> f64 {
        let longest = self.screws.iter().map(|s| if s.z == 0.0 { 0.0 } else { s.x.hypot(s.y) }).fold(0.0, f64::max);
        if longest > 0.0 { longest } else { 1.0 }
    }
}

/// A matrix counts as singular where the smallest singular value of its normalised form is below this.
///
/// Rows are divided by the sizes of their wrenches and columns by those of their screws, so the value is a sine. A pose that is known to
/// rounding only fixes a leg near the end of its reach to the square root of rounding, 1.5e-8; a planted singular pose lands there.
pub(super) const SINGULAR: f64 = 1e-7;

impl Velocity {
    /// The actuator rates for a motion of the platform.
    ///
    /// # Errors
    /// [`SingularMatrix::Input`] at a singularity of type 1.
    pub fn input_rates(&self, pose_rates: &Vector3<f64>) -> Result<Vector3<f64>, SingularMatrix> {
        Ok(-(self.input_inverse()? * (self.pose_matrix * pose_rates)))
    }

    /// The motion of the platform for actuator rates.
    ///
    /// # Errors
    /// [`SingularMatrix::Pose`] at a singularity of type 2.
    pub fn pose_rates(&self, input_rates: &Vector3<f64>) -> Result<Vector3<f64>, SingularMatrix> {
        Ok(-(self.pose_inverse()? * (self.input_matrix * input_rates)))
    }

    /// The rates of all joints, for rates of platform and actuators that belong together.
    ///
    /// # Errors
    /// [`SingularMatrix::Leg`] where a leg's idle joints move on their own.
    ///
    /// ```
    /// use assur::{Manipulator, nalgebra::Vector3};
    /// let (robot, inputs) = Manipulator::of_family("3-RRR")?;
    /// let mode = &robot.forward(&inputs)?.modes[0];
    /// let velocity = robot.velocity_at(&mode.mode.pose, &mode.joints);
    /// let turning = Vector3::new(0.0, 0.0, 1.0);
    /// let rates = velocity.joint_rates(&turning, &velocity.input_rates(&turning)?)?;
    /// // The three joints of each leg turn the platform together.
    /// assert!(rates.iter().all(|leg| (leg.iter().sum::<f64>() - 1.0).abs() < 1e-12));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn joint_rates(
        &self,
        pose_rates: &Vector3<f64>,
        input_rates: &Vector3<f64>,
    ) -> Result<Vec<[f64; 3]>, SingularMatrix> {
        let mut first = 0;
        let mut out = Vec::new();
        for (number, leg) in (1..).zip(&self.legs) {
            let count = leg.actuated.iter().filter(|&&actuated| actuated).count();
            let inputs = &input_rates.as_slice()[first..first + count];
            let rates = leg.rates(pose_rates, inputs, leg.scale());
            out.push(rates.ok_or(SingularMatrix::Leg { leg: number })?);
            first += count;
        }
        Ok(out)
    }

    /// `beta` in `A·pose'' + B·inputs'' + beta = 0`, for rates of platform and actuators that belong together.
    ///
    /// **Scaling**: that of the rows of the matrices. **Source**: the derivation `acceleration_term`.
    ///
    /// # Errors
    /// [`SingularMatrix::Leg`] where a leg's idle joints move on their own.
    pub fn quadratic_term(
        &self,
        pose_rates: &Vector3<f64>,
        input_rates: &Vector3<f64>,
    ) -> Result<Vector3<f64>, SingularMatrix> {
        let rates = self.joint_rates(pose_rates, input_rates)?;
        let mark_rate = pose_rates.xy();
        let terms = self.legs.iter().zip(&rates).flat_map(|(leg, rates)| {
            let drift = leg.drift(rates, mark_rate);
            leg.wrenches.iter().map(move |wrench| -wrench.dot(&drift))
        });
        Ok(Vector3::from_iterator(terms))
    }

    /// The actuators' accelerations for a motion of the platform with these rates and accelerations.
    ///
    /// # Errors
    /// As [`Velocity::input_rates`] and [`Velocity::quadratic_term`].
    ///
    /// ```
    /// use assur::{Manipulator, nalgebra::Vector3};
    /// let (robot, inputs) = Manipulator::of_family("3-PRR")?;
    /// let mode = &robot.forward(&inputs)?.modes[0];
    /// let velocity = robot.velocity_at(&mode.mode.pose, &mode.joints);
    /// let (rates, accelerations) = (Vector3::new(0.3, -0.2, 0.1), Vector3::new(1.0, 0.0, 2.0));
    /// let inputs = velocity.input_accelerations(&rates, &accelerations)?;
    /// let back = velocity.pose_accelerations(&velocity.input_rates(&rates)?, &inputs)?;
    /// assert!((back - accelerations).norm() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn input_accelerations(
        &self,
        pose_rates: &Vector3<f64>,
        pose_accelerations: &Vector3<f64>,
    ) -> Result<Vector3<f64>, SingularMatrix> {
        let beta = self.quadratic_term(pose_rates, &self.input_rates(pose_rates)?)?;
        Ok(-(self.input_inverse()? * (self.pose_matrix * pose_accelerations + beta)))
    }

    /// The platform's acceleration for these rates and accelerations of the actuators.
    ///
    /// # Errors
    /// As [`Velocity::pose_rates`] and [`Velocity::quadratic_term`].
    pub fn pose_accelerations(
        &self,
        input_rates: &Vector3<f64>,
        input_accelerations: &Vector3<f64>,
    ) -> Result<Vector3<f64>, SingularMatrix> {
        let beta = self.quadratic_term(&self.pose_rates(input_rates)?, input_rates)?;
        Ok(-(self.pose_inverse()? * (self.input_matrix * input_accelerations + beta)))
    }

    /// The actuator forces (torques at revolute joints) that hold the platform against an external wrench `(fx, fy, m)` about its origin.
    ///
    /// Their power on any motion cancels that of the wrench: `wrench·pose' + forces·inputs' = 0`. Weight and friction are not in the model.
    ///
    /// # Errors
    /// [`SingularMatrix::Pose`] at a singularity of type 2, where some wrench cannot be held.
    ///
    /// ```
    /// use assur::{Leg, Manipulator, Pose, nalgebra::Vector3};
    /// // Three upright struts cannot hold a push to the side; with one slanted, a weight of 1 over the middle is shared.
    /// let robot = Manipulator::new("", vec![
    ///     Leg::rpr([0.0, 0.0], [0.0, 0.0]),
    ///     Leg::rpr([2.0, 0.0], [2.0, 0.0]),
    ///     Leg::rpr([0.0, 1.0], [2.0, 0.0]),
    /// ])?;
    /// let velocity = robot.velocity(&Pose::new(0.0, 1.0, 0.0), "+++")?;
    /// let forces = velocity.actuator_forces(&Vector3::new(0.0, -1.0, -1.0))?;
    /// assert!((forces - Vector3::new(0.5, 0.5, 0.0)).norm() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn actuator_forces(&self, wrench: &Vector3<f64>) -> Result<Vector3<f64>, SingularMatrix> {
        Ok(self.input_matrix.transpose() * (self.pose_inverse()?.transpose() * wrench))
    }

    /// The external wrench on the platform that actuator forces hold: the way back from [`Velocity::actuator_forces`].
    ///
    /// # Errors
    /// [`SingularMatrix::Input`] at a singularity of type 1, where some force meets its match in the structure.
    pub fn held_wrench(&self, forces: &Vector3<f64>) -> Result<Vector3<f64>, SingularMatrix> {
        Ok(self.pose_matrix.transpose() * (self.input_inverse()?.transpose() * forces))
    }

    /// The pose matrix with its rows as wrenches of size one, moments in units of `length`; a zero row stays zero.
    pub(super) fn normalised_pose_matrix(&self, length: f64) -> Matrix3<f64> {
        let mut out = self.pose_matrix;
        for mut row in out.row_iter_mut() {
            row[2] /= length;
            let size = row.norm();
            if size > 0.0 {
                row /= size;
            }
        }
        out
    }

    /// The input matrix with rows by the sizes of their wrenches and columns by those of their screws, both measured with `length`.
    ///
    /// For a leg with one actuator its entry is the cosine between the wrench and the actuated screw.
    pub(super) fn normalised_input_matrix(&self, length: f64) -> Matrix3<f64> {
        let mut out = self.input_matrix;
        for (k, mut row) in out.row_iter_mut().enumerate() {
            let size =
                Vector3::new(self.pose_matrix[(k, 0)], self.pose_matrix[(k, 1)], self.pose_matrix[(k, 2)] / length);
            if size.norm() > 0.0 {
                row /= size.norm();
            }
        }
        let screws = self.legs.iter().flat_map(|leg| (0..3).filter(|&j| leg.actuated[j]).map(|j| leg.screws[j]));
        for (mut column, screw) in out.column_iter_mut().zip(screws) {
            column /= Vector3::new(screw.x, screw.y, screw.z * length).norm();
        }
        out
    }

    /// The sine between the idle joints' screws of each row's leg: zero where they move with the platform at rest. One for rows of other legs.
    pub(super) fn idle_independence(&self, length: f64) -> Vec<f64> {
        let even = |s: &Vector3<f64>| Vector3::new(s.x, s.y, s.z * length).normalize();
        self.legs
            .iter()
            .map(|leg| {
                let idle: Vec<Vector3<f64>> =
                    (0..3).filter(|&j| !leg.actuated[j]).map(|j| even(&leg.screws[j])).collect();
                match idle[..] {
                    [first, second] => first.cross(&second).norm(),
                    _ => 1.0,
                }
            })
            .collect()
    }

    /// The screw of an idle joint of a leg with two, of size one, turning as the speed at `length`.
    pub(super) fn idle_screw(&self, leg: usize, length: f64) -> Option<Vector3<f64>> {
        let leg = &self.legs[leg - 1];
        let mut idle = (0..3).filter(|&j| !leg.actuated[j]).map(|j| leg.screws[j]);
        let (first, _) = (idle.next()?, idle.next()?);
        Some(Vector3::new(first.x, first.y, first.z * length).normalize())
    }

    /// A length to weigh turning against moving, where the caller states none.
    fn scale(&self) -> f64 {
        self.legs.iter().map(LegMotion::scale).fold(0.0, f64::max)
    }

    pub(super) fn pose_inverse(&self) -> Result<Matrix3<f64>, SingularMatrix> {
        let regular = smallest_singular_value(&self.normalised_pose_matrix(self.scale())) > SINGULAR;
        self.pose_matrix.try_inverse().filter(|_| regular).ok_or(SingularMatrix::Pose)
    }

    pub(super) fn input_inverse(&self) -> Result<Matrix3<f64>, SingularMatrix> {
        let regular = smallest_singular_value(&self.normalised_input_matrix(self.scale())) > SINGULAR;
        self.input_matrix.try_inverse().filter(|_| regular).ok_or(SingularMatrix::Input)
    }
}

/// The smallest singular value of a 3×3 matrix.
pub(super) fn smallest_singular_value(matrix: &Matrix3<f64>) -> f64 {
    matrix.singular_values().min()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_and_forces_go_there_and_back() {
        for family in ["3-RPR", "3-RRR", "3-PRR", "3-RRP", "3-PRP", "R_P_R,_P_RR,RP_P_"] {
            let (robot, inputs) = Manipulator::of_family(family).expect("a family");
            for mode in robot.forward(&inputs).expect("sound inputs").modes {
                let velocity = robot.velocity_at(&mode.mode.pose, &mode.joints);
                let given = Vector3::new(0.3, -0.7, 0.11);
                let back = velocity.pose_rates(&velocity.input_rates(&given).expect("regular")).expect("regular");
                assert!((back - given).norm() < 1e-11, "{family}");
                let forces = velocity.actuator_forces(&given).expect("regular");
                assert!((velocity.held_wrench(&forces).expect("regular") - given).norm() < 1e-11, "{family}");
                let rates = Vector3::new(0.2, 0.5, -0.3);
                let inputs = velocity.input_rates(&rates).expect("regular");
                assert!((given.dot(&rates) + forces.dot(&inputs)).abs() < 1e-11, "power balances: {family}");
            }
        }
    }

    #[test]
    fn a_strut_without_length_leaves_its_joints_free() {
        let (robot, _) = Manipulator::of_family("3-RPR").expect("a family");
        let at = robot.legs[0].base.at - robot.legs[0].platform.at;
        let velocity = robot.velocity(&Pose::new(at.x, at.y, 0.0), "+++").expect("reaches");
        assert_eq!(velocity.pose_matrix.row(0).norm(), 0.0);
        let still = Vector3::zeros();
        assert_eq!(velocity.joint_rates(&still, &still), Err(SingularMatrix::Leg { leg: 1 }));
        assert_eq!(velocity.pose_rates(&still), Err(SingularMatrix::Pose));
    }
}
