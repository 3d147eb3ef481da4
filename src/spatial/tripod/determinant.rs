//! The determinant of the Jacobian, and its course over the designs of the paper's figure 8.
//!
//! The two rows of a leg share `n/(n·u)`; subtracted, they leave `d = v × (w × (Da - Db - (rho_b - rho_a) u))/(n·u)` in the part of the rotation. So
//! `det J = -det[n/(n·u)] · det[d]`: the first factor vanishes where the place is not determined, the second where the orientation is not.

use nalgebra::{Matrix3, Vector3};

use super::super::error::{SpatialError, moderate};
use super::model::{Tripod, TripodError, TripodPose};

/// A family of designs of the paper's figure 8, over an elevation; our reading of the figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TripodDesign {
    /// Figure 8(a): rails at the elevation over the horizontal, platform axes horizontal. [`Tripod::inclined`].
    Inclined,
    /// Figure 8(b): vertical rails, platform axes at the elevation. [`Tripod::upright`].
    Upright,
}

/// `det J` of one design.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeterminantPoint {
    /// Elevation of the rails or of the platform axes, in radians.
    pub elevation: f64,
    /// The angle between any two of them, in radians: `cos = -1/2 + (3/2) sin² elevation`.
    pub between: f64,
    /// `det J`, in the cube of the unit of length; `None` where a leg has no plane or none that its sliders reach (type 1).
    pub determinant: Option<f64>,
}

impl TripodDesign {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Inclined, Self::Upright];

    /// `inclined`, `upright`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Inclined => "inclined",
            Self::Upright => "upright",
        }
    }

    /// The robot of one elevation (radians), rails at the distances `d1`, `d2`.
    ///
    /// # Errors
    /// As [`Tripod::cartesian`].
    pub fn robot(self, elevation: f64, d1: f64, d2: f64) -> Result<Tripod, TripodError> {
        match self {
            Self::Inclined => Tripod::inclined(elevation, d1, d2),
            Self::Upright => Tripod::upright(elevation, d1, d2),
        }
    }

    /// `det J` in one pose over a range of elevations (radians), `count` of them, the ends included.
    ///
    /// **Accuracy**: [`Tripod::jacobian_determinant`]. With the platform level the curve of [`TripodDesign::Inclined`] is
    /// `(27/4)(d2 - d1)³ (sin e cos e)³`, greatest at 45°; that of [`TripodDesign::Upright`] is zero, since every `d` is horizontal there.
    ///
    /// # Errors
    /// Numbers that are not finite, equal distances, fewer than two points.
    ///
    /// ```
    /// use assur::{TripodDesign, TripodPose, nalgebra::Vector3};
    /// let level = TripodPose::new(Vector3::zeros(), Vector3::zeros());
    /// let curve = TripodDesign::Inclined.determinant_curve(600.0, 720.0, &level, [0.0, 1.0], 3)?;
    /// let (sine, cosine) = 0.5_f64.sin_cos();
    /// let expected = 6.75 * 120.0_f64.powi(3) * (sine * cosine).powi(3);
    /// assert!((curve[1].determinant.unwrap() / expected - 1.0).abs() < 1e-13);
    /// assert_eq!(curve[0].determinant, Some(0.0));
    /// # Ok::<(), assur::TripodError>(())
    /// ```
    pub fn determinant_curve(
        self,
        d1: f64,
        d2: f64,
        pose: &TripodPose,
        [from, to]: [f64; 2],
        count: usize,
    ) -> Result<Vec<DeterminantPoint>, TripodError> {
        moderate(|| "elevation from".to_owned(), from)?;
        moderate(|| "elevation to".to_owned(), to)?;
        if count < 2 {
            return Err(SpatialError::WrongCount { what: "points of a curve", expected: 2, found: count }.into());
        }
        let point = |k: usize| {
            let elevation = from + (to - from) * k as f64 / (count - 1) as f64;
            let robot = self.robot(elevation, d1, d2)?;
            let determinant = match robot.jacobian_determinant(pose) {
                Ok(determinant) => Some(determinant),
                Err(TripodError::ParallelAxes { .. } | TripodError::ParallelRail { .. }) => None,
                Err(error) => return Err(error),
            };
            let sine = elevation.sin();
            let between = (1.5 * sine * sine - 0.5).clamp(-1.0, 1.0).acos();
            Ok(DeterminantPoint { elevation, between, determinant })
        };
        (0..count).map(point).collect()
    }
}

impl Tripod {
    /// `det J` in a pose, in the cube of the unit of length.
    ///
    /// **Accuracy**: two determinants of order 3, a few roundings each; one that is zero to rounding makes it zero. **Source**: derived above.
    ///
    /// # Errors
    /// As [`Tripod::inverse`]: the singularities of type 1, where it has poles.
    ///
    /// ```
    /// use assur::{CartesianRobot, Tripod, TripodPose, nalgebra::Vector3};
    /// let pose = TripodPose::new(Vector3::new(200.0, 260.0, 240.0), Vector3::new(0.1, 0.2, -0.1));
    /// let robot = Tripod::cartesian(600.0, 720.0)?;
    /// let determinant = robot.jacobian_determinant(&pose)?;
    /// // (d2 - d1)³ (1 - T)(1 + T)/(r11 r22 r33)
    /// let closed = CartesianRobot { d1: 600.0, d2: 720.0 }.jacobian_determinant(&robot.inverse(&pose)?).unwrap();
    /// assert!((determinant / closed - 1.0).abs() < 1e-12);
    /// # Ok::<(), assur::TripodError>(())
    /// ```
    pub fn jacobian_determinant(&self, pose: &TripodPose) -> Result<f64, TripodError> {
        let inputs = self.inverse(pose)?;
        let (mut normals, mut turns) = ([Vector3::zeros(); 3], [Vector3::zeros(); 3]);
        for (k, leg) in self.legs.iter().enumerate() {
            let plane = leg.plane(pose, k + 1)?;
            let apart = leg.da - leg.db - leg.u * (inputs[2 * k + 1] - inputs[2 * k]);
            normals[k] = plane.normal / plane.along;
            turns[k] = plane.axis.cross(&leg.w.cross(&apart)) / plane.along;
        }
        // Not -0 where it vanishes.
        Ok(0.0 - volume(&normals) * volume(&turns))
    }
}

/// A volume within this of the product of the lengths is zero: what rounding leaves of vectors in a plane.
const FLAT: f64 = 16.0 * f64::EPSILON;

/// The volume that three vectors span; zero where it is so to rounding.
fn volume(vectors: &[Vector3<f64>; 3]) -> f64 {
    let volume = Matrix3::from_columns(vectors).determinant();
    let lengths: f64 = vectors.iter().map(|vector| vector.norm()).product();
    if volume.abs() <= FLAT * lengths { 0.0 } else { volume }
}
