//! How fast HANA moves for given rates of its sliders, and where it is singular.
//!
//! | symbol | meaning |
//! |---|---|
//! | `u1, u2, u3` | heights of the joints above their sliders: `z - r s - z1`, `z + r s - z2`, `z - z3` |
//! | `k1, k2` | `r(z1 - z)c + R r s`, `r(z - z2)c + R r s`: how turning lengthens links 1 and 2, times their lengths |
//! | `w` | `y + R - r` |
//!
//! Links of fixed length: row `i` of `A·pose' + B·inputs' = 0` is `[y, u1, k1 | -u1]`, `[y, u2, k2 | -u2]`, `[w, u3, 0 | -u3]`.
//! Then `det A = k1(y u3 - w u2) - k2(y u3 - w u1)`; where the sliders of legs 1 and 2 are on the same side, `u1 = u2 = u` and this is
//! `-2 r u c (y u3 - w u)`: singular at every quarter turn, and where the links' traces in the plane `Oyz` lie in line. The paper's
//! condition `k1 = k2 = 0` (its eq. (35)) holds only with the sliders on opposite sides.

use nalgebra::{Matrix3, Vector3};

use super::super::error::SpatialError;
use super::inverse::HanaMode;
use super::model::{Hana, HanaPose};

/// The matrices of HANA in one pose and working mode: `pose_matrix·(y', z', phi') + input_matrix·inputs' = 0`.
#[derive(Clone, Debug, PartialEq)]
pub struct HanaVelocity {
    /// The pose.
    pub pose: HanaPose,
    /// The working mode.
    pub mode: HanaMode,
    /// Heights of the sliders.
    pub inputs: [f64; 3],
    /// `A` (the paper's `B`); rows are forces as long as the links, moments about the platform's axis.
    pub pose_matrix: Matrix3<f64>,
    /// `B` (less the paper's `A`): diagonal.
    pub input_matrix: Matrix3<f64>,
    robot: Hana,
}

/// Why a pose of HANA is singular.
#[derive(Clone, Debug, PartialEq)]
pub struct HanaSingularity {
    /// What it is.
    pub kind: HanaSingularKind,
    /// Legs, from 1, whose links lie level (type 1).
    pub level_legs: Vec<usize>,
    /// How type 2 comes about; empty where it does not.
    pub reading: Vec<&'static str>,
    /// Smallest singular value of `A` with moments over `r` and rows of length 1.
    pub sigma_min: f64,
    /// Smallest height of a link over its length.
    pub sigma_min_input: f64,
    /// Smallest over largest singular value of `inverse(B) A diag(1, 1, 1/r)`; 0 at a singularity.
    pub dexterity: f64,
}

/// The kind of a singularity, after Gosselin and Angeles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HanaSingularKind {
    /// Regular.
    None,
    /// `B` is singular: a slider moves without the platform, to first order.
    Type1,
    /// `A` is singular: the platform moves with the sliders held.
    Type2,
    /// Both.
    Type3,
}

impl HanaSingularKind {
    /// `none`, `type 1`, `type 2`, `type 3`.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Type1 => "type 1",
            Self::Type2 => "type 2",
            Self::Type3 => "type 3",
        }
    }
}

/// Singular values of the normalised matrices below this count as zero: a pose known to rounding fixes a level link to `sqrt(EPSILON)`.
const SINGULAR: f64 = 1e-7;

impl Hana {
    /// The velocity matrices in a pose and working mode.
    ///
    /// **Shape**: `pose_matrix · (y', z', phi') + input_matrix · (z1', z2', z3') = 0`, one row a leg. **Accuracy**: closed forms.
    /// **Source**: Liu et al., eqs. (13)-(20).
    ///
    /// # Errors
    /// A pose that is not finite, a leg that does not reach.
    ///
    /// ```
    /// use assur::{Hana, HanaMode, HanaPose, nalgebra::Vector3};
    /// let velocity = Hana::example().velocity(&HanaPose::new(-2.0, -12.0, 0.4), HanaMode::ABOVE)?;
    /// let rates = velocity.input_rates(&Vector3::new(0.5, -0.3, 0.2))?;
    /// assert!((rates.x + 0.9520673081446874).abs() < 1e-13);
    /// # Ok::<(), assur::SpatialError>(())
    /// ```
    pub fn velocity(&self, pose: &HanaPose, mode: HanaMode) -> Result<HanaVelocity, SpatialError> {
        let inputs = self.inputs_at(pose, mode)?;
        let (sine, cosine) = pose.phi.sin_cos();
        let (r, base) = (self.platform_radius, self.base_radius);
        let joints = self.joint_heights(pose);
        let u: [f64; 3] = std::array::from_fn(|leg| joints[leg] - inputs[leg]);
        let k1 = r * (inputs[0] - pose.z) * cosine + base * r * sine;
        let k2 = r * (pose.z - inputs[1]) * cosine + base * r * sine;
        #[rustfmt::skip]
        let pose_matrix = Matrix3::new(
            pose.y, u[0], k1,
            pose.y, u[1], k2,
            pose.y + base - r, u[2], 0.0,
        );
        let input_matrix = Matrix3::from_diagonal(&-Vector3::from(u));
        Ok(HanaVelocity { pose: *pose, mode, inputs, pose_matrix, input_matrix, robot: self.clone() })
    }
}

impl HanaVelocity {
    /// The sliders' rates for a motion `(y', z', phi')` of the platform.
    ///
    /// # Errors
    /// A link that lies level: type 1.
    pub fn input_rates(&self, pose_rates: &Vector3<f64>) -> Result<Vector3<f64>, SpatialError> {
        self.solve_inputs(-(self.pose_matrix * pose_rates))
    }

    /// The platform's motion for rates of the sliders.
    ///
    /// # Errors
    /// A singularity of type 2.
    pub fn pose_rates(&self, input_rates: &Vector3<f64>) -> Result<Vector3<f64>, SpatialError> {
        self.solve_pose(-(self.input_matrix * input_rates))
    }

    /// `beta` in `A·pose'' + B·inputs'' + beta = 0`, for rates that belong together.
    ///
    /// **Source**: Liu et al., eqs. (21)-(23).
    pub fn quadratic_term(&self, pose_rates: &Vector3<f64>, input_rates: &Vector3<f64>) -> Vector3<f64> {
        let (r, base) = (self.robot.platform_radius, self.robot.base_radius);
        let (sine, cosine) = self.pose.phi.sin_cos();
        let [dy, dz, dphi]: [f64; 3] = (*pose_rates).into();
        let [u1, u2] = [-self.input_matrix[(0, 0)], -self.input_matrix[(1, 1)]];
        let square = |x: f64| x * x;
        let level = square(r * sine * dphi) + square(dy);
        Vector3::new(
            level
                + square(dz - r * cosine * dphi - input_rates.x)
                + square(dphi) * (-(r * cosine - base) * r * cosine + u1 * r * sine),
            level
                + square(dz + r * cosine * dphi - input_rates.y)
                + square(dphi) * ((base - r * cosine) * r * cosine - u2 * r * sine),
            square(dy) + square(dz - input_rates.z),
        )
    }

    /// The sliders' accelerations for a motion of the platform.
    ///
    /// # Errors
    /// As [`HanaVelocity::input_rates`].
    pub fn input_accelerations(
        &self,
        pose_rates: &Vector3<f64>,
        pose_accelerations: &Vector3<f64>,
    ) -> Result<Vector3<f64>, SpatialError> {
        let rates = self.input_rates(pose_rates)?;
        self.solve_inputs(-(self.pose_matrix * pose_accelerations + self.quadratic_term(pose_rates, &rates)))
    }

    /// The platform's accelerations for a motion of the sliders.
    ///
    /// # Errors
    /// As [`HanaVelocity::pose_rates`].
    pub fn pose_accelerations(
        &self,
        input_rates: &Vector3<f64>,
        input_accelerations: &Vector3<f64>,
    ) -> Result<Vector3<f64>, SpatialError> {
        let rates = self.pose_rates(input_rates)?;
        self.solve_pose(-(self.input_matrix * input_accelerations + self.quadratic_term(&rates, input_rates)))
    }

    /// What kind of singularity the pose is, if any.
    ///
    /// **Accuracy**: heuristic; a normalised singular value below 1e-7 counts as zero.
    pub fn singularity(&self) -> HanaSingularity {
        let h = &self.robot;
        let u = -self.input_matrix.diagonal();
        let links = [h.link, h.link, h.third_link];
        let heights: Vec<f64> = (0..3).map(|leg| u[leg].abs() / links[leg]).collect();
        let level_legs: Vec<usize> = (0..3).filter(|&leg| heights[leg] <= SINGULAR).map(|leg| leg + 1).collect();
        let mut scaled = self.pose_matrix;
        for row in 0..3 {
            scaled[(row, 2)] /= h.platform_radius;
            let length = scaled.row(row).norm();
            if length > 0.0 {
                scaled.row_mut(row).iter_mut().for_each(|entry| *entry /= length);
            }
        }
        let sigma_min = scaled.singular_values().min();
        let type_2 = sigma_min <= SINGULAR;
        let mut reading = Vec::new();
        if type_2 {
            let small = |value: f64, scale: f64| value.abs() <= SINGULAR * scale;
            let (k1, k2) = (self.pose_matrix[(0, 2)], self.pose_matrix[(1, 2)]);
            let moment = h.platform_radius * h.link;
            if self.mode.above[0] == self.mode.above[1] && small(self.pose.phi.cos(), 1.0) {
                reading.push("a quarter turn: legs 1 and 2 cannot hold the rotation");
            }
            if small(k1, moment) && small(k2, moment) {
                reading.push("links 1 and 2 lie in the plane of the platform");
            }
            let traces =
                |row: usize| self.pose_matrix[(row, 0)] * u.z - self.pose_matrix[(2, 0)] * self.pose_matrix[(row, 1)];
            if small(traces(0), h.link * h.third_link) && small(traces(1), h.link * h.third_link) {
                reading.push("the links lie in line, seen along x");
            }
        }
        let kind = match (level_legs.is_empty(), type_2) {
            (true, false) => HanaSingularKind::None,
            (false, false) => HanaSingularKind::Type1,
            (true, true) => HanaSingularKind::Type2,
            (false, true) => HanaSingularKind::Type3,
        };
        let dexterity = if kind == HanaSingularKind::None {
            let mut map = self.pose_matrix;
            for row in 0..3 {
                map[(row, 2)] /= h.platform_radius;
                map.row_mut(row).iter_mut().for_each(|entry| *entry /= u[row]);
            }
            let values = map.singular_values();
            values.min() / values.max()
        } else {
            0.0
        };
        let sigma_min_input = heights.into_iter().fold(f64::INFINITY, f64::min);
        HanaSingularity { kind, level_legs, reading, sigma_min, sigma_min_input, dexterity }
    }

    fn solve_inputs(&self, right: Vector3<f64>) -> Result<Vector3<f64>, SpatialError> {
        if !self.singularity().level_legs.is_empty() {
            let what = "a link lies level, so the platform's motion does not determine the inputs";
            return Err(SpatialError::Singular { matrix: "input", kind: "type 1", what });
        }
        Ok(right.component_div(&self.input_matrix.diagonal()))
    }

    fn solve_pose(&self, right: Vector3<f64>) -> Result<Vector3<f64>, SpatialError> {
        let singular = SpatialError::Singular {
            matrix: "pose",
            kind: "type 2",
            what: "inputs do not determine the platform's motion",
        };
        if self.singularity().sigma_min <= SINGULAR {
            return Err(singular);
        }
        self.pose_matrix.lu().solve(&right).ok_or(singular)
    }
}
