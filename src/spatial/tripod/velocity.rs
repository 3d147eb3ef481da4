//! How fast a three-legged robot moves, and where it is singular.
//!
//! `rho' = J [p'; omega]`, the row of a rail through `D` being `[n, r × n + v × (w × s)]/(n · u)` with `r = R c`, `v = R v`, `s = P - D - rho u`; and
//! `rho'' = J [p''; alpha] + b`. The Jacobian fails to be invertible where the three normals lie in a plane (the place is not determined; `T = 1` for the Cartesian
//! robot) or where the axes `v × n` do (the orientation is not; `T = -1`).

use nalgebra::{Matrix6, Vector3, Vector6};

use super::model::{Tripod, TripodError, TripodPose};

/// The Jacobian of a three-legged robot in a pose.
#[derive(Clone, Debug, PartialEq)]
pub struct TripodVelocity {
    /// The pose.
    pub pose: TripodPose,
    /// Slider positions.
    pub inputs: [f64; 6],
    /// `J`: one row a slider, columns `p'` (length) and `omega` (base frame, radians).
    pub jacobian: Matrix6<f64>,
    /// Volume spanned by the unit normals of the legs' planes.
    pub position_volume: f64,
    /// Volume spanned by the unit vectors `v × n`.
    pub orientation_volume: f64,
    robot: Tripod,
}

/// What kind of singularity a pose is; those of type 1 have no pose in [`Tripod::velocity`], which says so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TripodSingularity {
    /// Regular.
    None,
    /// Type 2: the legs' planes are parallel to a line (`T = 1`).
    Position,
    /// Type 2: the platform turns with the sliders held (`T = -1`).
    Orientation,
    /// Both at once.
    Both,
}

impl TripodSingularity {
    /// `none` or `type 2`.
    pub fn name(self) -> &'static str {
        if self == Self::None { "none" } else { "type 2" }
    }

    /// What it means.
    pub fn reading(self) -> &'static str {
        match self {
            Self::None => "",
            Self::Position => "the legs' planes are parallel to a line, along which the platform is free",
            Self::Orientation => "the platform is free to turn about an axis",
            Self::Both => "the platform is free to move along a line and to turn about an axis",
        }
    }
}

/// Volumes of three unit vectors below this count as zero (heuristic).
const SINGULAR: f64 = 1e-9;

impl Tripod {
    /// The Jacobian in a pose.
    ///
    /// **Shape**: 6 by 6, rows as [`Tripod::inverse`]. **Accuracy**: closed form. **Source**: derived here; the determinant for the Cartesian robot in the derivation
    /// `cartesian_robot`.
    ///
    /// # Errors
    /// As [`Tripod::inverse`]: the singularities of type 1.
    pub fn velocity(&self, pose: &TripodPose) -> Result<TripodVelocity, TripodError> {
        let inputs = self.inverse(pose)?;
        let mut jacobian = Matrix6::zeros();
        let mut turning = [Vector3::zeros(); 3];
        let (_, position_volume) = self.unit_normals(pose)?;
        for (k, leg) in self.legs.iter().enumerate() {
            let plane = leg.plane(pose, k + 1)?;
            for (slider, rail) in [leg.da, leg.db].into_iter().enumerate() {
                let s = plane.joint - rail - leg.u * inputs[2 * k + slider];
                let moment = plane.arm.cross(&plane.normal) + plane.axis.cross(&leg.w.cross(&s));
                for i in 0..3 {
                    jacobian[(2 * k + slider, i)] = plane.normal[i] / plane.along;
                    jacobian[(2 * k + slider, i + 3)] = moment[i] / plane.along;
                }
            }
            turning[k] = plane.axis.cross(&plane.normal).normalize();
        }
        let orientation_volume = turning[0].dot(&turning[1].cross(&turning[2]));
        Ok(TripodVelocity { pose: *pose, inputs, jacobian, position_volume, orientation_volume, robot: self.clone() })
    }
}

impl TripodVelocity {
    /// The sliders' rates for `(p', omega)`.
    pub fn input_rates(&self, pose_rates: &Vector6<f64>) -> Vector6<f64> {
        self.jacobian * pose_rates
    }

    /// `(p', omega)` for rates of the sliders.
    ///
    /// # Errors
    /// A singularity of type 2.
    pub fn pose_rates(&self, input_rates: &Vector6<f64>) -> Result<Vector6<f64>, TripodError> {
        self.solved(input_rates)
    }

    /// The sliders' accelerations for `(p', omega)` and `(p'', alpha)`.
    pub fn input_accelerations(&self, pose_rates: &Vector6<f64>, pose_accelerations: &Vector6<f64>) -> Vector6<f64> {
        self.jacobian * pose_accelerations + self.bias(pose_rates)
    }

    /// `(p'', alpha)` for rates and accelerations of the sliders.
    ///
    /// # Errors
    /// A singularity of type 2.
    pub fn pose_accelerations(
        &self,
        input_rates: &Vector6<f64>,
        input_accelerations: &Vector6<f64>,
    ) -> Result<Vector6<f64>, TripodError> {
        let rates = self.pose_rates(input_rates)?;
        self.solved(&(input_accelerations - self.bias(&rates)))
    }

    /// `b` in `rho'' = J [p''; alpha] + b`.
    pub fn bias(&self, pose_rates: &Vector6<f64>) -> Vector6<f64> {
        let (dp, omega) = (pose_rates.fixed_rows::<3>(0).into_owned(), pose_rates.fixed_rows::<3>(3).into_owned());
        let rates = self.input_rates(pose_rates);
        let mut bias = Vector6::zeros();
        for (k, leg) in self.robot.legs.iter().enumerate() {
            let axis = self.pose.rotation * leg.v;
            let arm = self.pose.rotation * leg.c;
            let (normal, once) = (axis.cross(&leg.w), omega.cross(&axis));
            let (first, second) = (once.cross(&leg.w), omega.cross(&once).cross(&leg.w));
            for (slider, rail) in [leg.da, leg.db].into_iter().enumerate() {
                let row = 2 * k + slider;
                let s = self.pose.position + arm - rail - leg.u * self.inputs[row];
                let ds = dp + omega.cross(&arm) - leg.u * rates[row];
                let centripetal = omega.cross(&omega.cross(&arm));
                bias[row] = (normal.dot(&centripetal) + second.dot(&s) + 2.0 * first.dot(&ds)) / normal.dot(&leg.u);
            }
        }
        bias
    }

    /// What kind of singularity the pose is, if any.
    pub fn singularity(&self) -> TripodSingularity {
        match (self.position_volume.abs() <= SINGULAR, self.orientation_volume.abs() <= SINGULAR) {
            (false, false) => TripodSingularity::None,
            (true, false) => TripodSingularity::Position,
            (false, true) => TripodSingularity::Orientation,
            (true, true) => TripodSingularity::Both,
        }
    }

    fn solved(&self, right: &Vector6<f64>) -> Result<Vector6<f64>, TripodError> {
        let kind = self.singularity();
        let regular = (kind == TripodSingularity::None).then(|| self.jacobian.lu().solve(right)).flatten();
        regular.ok_or(TripodError::Singular { reading: kind.reading() })
    }
}
