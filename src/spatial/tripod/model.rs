//! What a three-legged robot is made of, and which inputs take it to a pose.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use thiserror::Error;

use super::super::error::{SpatialError, moderate, positive, range};

/// A leg: its rails and base axis in the base frame, its joint's axis in the platform's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TripodLeg {
    /// Direction of the rails.
    pub u: Vector3<f64>,
    /// Direction of the axes on the sliders, square to `u`.
    pub w: Vector3<f64>,
    /// Direction of the joint's axis, in the platform.
    pub v: Vector3<f64>,
    /// A point of the joint's axis, in the platform.
    pub c: Vector3<f64>,
    /// A point of the first rail: its slider is at `Da + rho_a u`.
    pub da: Vector3<f64>,
    /// A point of the second rail.
    pub db: Vector3<f64>,
}

/// A platform on three legs with two sliders each.
#[derive(Clone, Debug, PartialEq)]
pub struct Tripod {
    /// A name for people; may be empty.
    pub name: String,
    /// The legs; their directions have length 1.
    pub legs: [TripodLeg; 3],
    /// Ranges of the six sliders, leg by leg; unlimited where there are none.
    pub strokes: Option<[[f64; 2]; 6]>,
    /// The tool's point, in the platform.
    pub tool: Vector3<f64>,
    /// The tool's axis, in the platform, of length 1: what is tilted.
    pub tool_axis: Vector3<f64>,
    /// Largest angle, in radians, between a leg's plane and where it is with all sliders of the leg level; unlimited where there is none.
    pub plane_angle_limit: Option<f64>,
    /// Legs with one motor: both sliders are one, the plane does not turn. Each takes a degree of freedom.
    pub one_motor: [bool; 3],
}

/// A pose of the platform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TripodPose {
    /// Place of the platform's origin in the base frame.
    pub position: Vector3<f64>,
    /// Rotation from the platform's frame to the base's.
    pub rotation: Rotation3<f64>,
}

/// Why a three-legged robot, or a question about it, is none. Legs are counted from 1.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TripodError {
    /// A number that cannot be computed with.
    #[error(transparent)]
    Number(#[from] SpatialError),
    /// A direction of no length.
    #[error("leg {leg}: {name} has no length")]
    NoDirection {
        /// Leg.
        leg: usize,
        /// Which direction.
        name: &'static str,
    },
    /// The base axis is not square to the rails.
    #[error("leg {leg}: the base axis w must be square to the rails u, their cosine is {cosine:.3e}")]
    NotSquare {
        /// Leg.
        leg: usize,
        /// Cosine of the angle between them.
        cosine: f64,
    },
    /// Both rails are one, seen along the base axis: they cannot turn the plane.
    #[error("leg {leg}: the rails coincide, seen along the base axis")]
    OneRail {
        /// Leg.
        leg: usize,
    },
    /// In this pose the joint's axis is parallel to the base axis: the leg has no plane.
    #[error("leg {leg}: the platform's axis is parallel to the base axis, so the leg's plane is not determined")]
    ParallelAxes {
        /// Leg.
        leg: usize,
    },
    /// In this pose the leg's plane is parallel to the rails: no slider reaches it.
    #[error(
        "leg {leg}: its plane is parallel to the rails (the platform's axis lies in the plane of u and w), so no slider position reaches it"
    )]
    ParallelRail {
        /// Leg.
        leg: usize,
    },
    /// A matrix is no rotation.
    #[error("rotation: columns must be orthonormal and right-handed; off by {off:.3e}")]
    NoRotation {
        /// Largest deviation.
        off: f64,
    },
    /// A leg with one motor would have to turn its plane.
    #[error("leg {leg}: has one motor, its plane does not turn; its sliders would have to be {apart:.6e} apart")]
    OneMotor {
        /// Leg.
        leg: usize,
        /// The second slider's position less the first's.
        apart: f64,
    },
    /// A question for robots with other degrees of freedom.
    #[error("{what} is for robots with {needed} degrees of freedom; this one has {found}")]
    DegreesOfFreedom {
        /// The question.
        what: &'static str,
        /// Degrees of freedom that it needs.
        needed: usize,
        /// Those of the robot.
        found: usize,
    },
    /// The inverse of a singular Jacobian is asked for.
    #[error("singular (type 2): the inputs do not determine the platform's motion; {reading}")]
    Singular {
        /// How the singularity comes about.
        reading: &'static str,
    },
}

/// A slider outside its stroke, or a plane turned too far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TripodReach {
    /// Leg, from 1.
    pub leg: usize,
    /// Slider, from 1 to 6; `None` for the angle of the leg's plane.
    pub slider: Option<usize>,
    /// The value.
    pub value: f64,
    /// Its range.
    pub limit: [f64; 2],
}

/// Sines below this count as zero: eight digits are gone where a leg's plane is so nearly undetermined (heuristic).
pub(super) const PARALLEL: f64 = 1e-9;
/// How far a given rotation may be from orthonormal: it was printed with some ten digits (heuristic).
const NEARLY_ROTATION: f64 = 1e-6;

impl TripodPose {
    /// A pose from a place and an axis with its angle in radians as length.
    pub fn new(position: Vector3<f64>, axis_angle: Vector3<f64>) -> Self {
        Self { position, rotation: Rotation3::new(axis_angle) }
    }

    /// A pose from a place and a rotation matrix, which is made exactly orthonormal.
    ///
    /// # Errors
    /// A matrix that is no rotation to within `1e-6`.
    pub fn with_matrix(position: Vector3<f64>, matrix: Matrix3<f64>) -> Result<Self, TripodError> {
        let off =
            (matrix * matrix.transpose() - Matrix3::identity()).abs().max().max((matrix.determinant() - 1.0).abs());
        if off.is_nan() || off > NEARLY_ROTATION {
            return Err(TripodError::NoRotation { off });
        }
        // Newton's iteration for the nearest rotation doubles the digits each time.
        let nearer = |m: Matrix3<f64>| m * (Matrix3::identity() * 3.0 - m.transpose() * m) * 0.5;
        Ok(Self { position, rotation: Rotation3::from_matrix_unchecked(nearer(nearer(matrix))) })
    }

    fn check(&self) -> Result<(), SpatialError> {
        let parts = self.position.iter().zip(["pose x", "pose y", "pose z"]);
        parts.into_iter().try_for_each(|(&value, name)| moderate(|| name.to_owned(), value))?;
        match self.rotation.matrix().iter().find(|entry| !entry.is_finite()) {
            Some(&value) => Err(SpatialError::NotFinite { what: "pose rotation".to_owned(), value }),
            None => Ok(()),
        }
    }
}

impl Tripod {
    /// A robot of three legs, directions of any length, without limits.
    ///
    /// # Errors
    /// Numbers that are not finite, directions of no length, a base axis not square to its rails, rails that coincide.
    pub fn new(legs: [TripodLeg; 3]) -> Result<Self, TripodError> {
        let mut legs = legs;
        for (number, leg) in (1..).zip(&mut legs) {
            for (name, vector) in [("u", &mut leg.u), ("w", &mut leg.w), ("v", &mut leg.v)] {
                vector.iter().try_for_each(|&x| moderate(|| format!("leg {number}: {name}"), x))?;
                let length = vector.norm();
                if length == 0.0 {
                    return Err(TripodError::NoDirection { leg: number, name });
                }
                // What is a direction to rounding stays as it is written.
                if (length - 1.0).abs() > 4.0 * f64::EPSILON {
                    *vector /= length;
                }
            }
            for (name, vector) in [("c", &leg.c), ("Da", &leg.da), ("Db", &leg.db)] {
                vector.iter().try_for_each(|&x| moderate(|| format!("leg {number}: {name}"), x))?;
            }
            let cosine = leg.u.dot(&leg.w);
            if cosine.abs() > PARALLEL {
                return Err(TripodError::NotSquare { leg: number, cosine });
            }
            let apart = leg.db - leg.da;
            let across = apart.dot(&leg.w.cross(&leg.u));
            if across == 0.0 || across.abs() <= PARALLEL * apart.norm() {
                return Err(TripodError::OneRail { leg: number });
            }
        }
        Ok(Self {
            name: String::new(),
            legs,
            strokes: None,
            tool: Vector3::zeros(),
            tool_axis: Vector3::z(),
            plane_angle_limit: None,
            one_motor: [false; 3],
        })
    }

    /// Whether limits are sound.
    ///
    /// # Errors
    /// A stroke reversed, an angle that is not positive, a tool that is not finite.
    pub fn validate_limits(&self) -> Result<(), TripodError> {
        self.tool.iter().try_for_each(|&x| moderate(|| "tool".to_owned(), x))?;
        self.tool_axis.iter().try_for_each(|&x| moderate(|| "tool axis".to_owned(), x))?;
        if (self.tool_axis.norm() - 1.0).abs() > NEARLY_ROTATION {
            return Err(SpatialError::NotPositive {
                what: "tool axis, its length less its distance from 1".to_owned(),
                value: 0.0,
            }
            .into());
        }
        for (slider, stroke) in (1..).zip(self.strokes.iter().flatten()) {
            range(&format!("strokes, slider {slider}"), *stroke)?;
        }
        self.plane_angle_limit.map_or(Ok(()), |limit| positive("plane angle limit", limit))?;
        Ok(())
    }

    /// The robot of the paper: rails along `x, y, z`, base axes `z, x, y`, platform axes `y', z', x'` through the platform's origin, rails at the distances `d1`, `d2`.
    ///
    /// # Errors
    /// Distances that are not finite, or equal.
    pub fn cartesian(d1: f64, d2: f64) -> Result<Self, TripodError> {
        let [x, y, z] = axes();
        let leg = |u, w, v: Vector3<f64>| TripodLeg { u, w, v, c: Vector3::zeros(), da: d1 * v, db: d2 * v };
        let robot = Self::new([leg(x, z, y), leg(y, x, z), leg(z, y, x)])?;
        Ok(Self { name: "three-legged robot with Cartesian rails".to_owned(), ..robot })
    }

    /// The first design of the paper's figure 8: rails at `elevation` (radians) over the horizontal in the azimuths 0, 120°, 240°, platform axes horizontal.
    ///
    /// Our reading of the figure. At the elevations 0 and 90° every pose is singular.
    ///
    /// # Errors
    /// As [`Tripod::cartesian`].
    pub fn inclined(elevation: f64, d1: f64, d2: f64) -> Result<Self, TripodError> {
        let leg = |azimuth: f64| {
            let (s, c) = azimuth.sin_cos();
            let q = Vector3::new(-s, c, 0.0);
            let u = Vector3::new(elevation.cos() * c, elevation.cos() * s, elevation.sin());
            TripodLeg { u, w: u.cross(&q), v: q, c: Vector3::zeros(), da: d1 * q, db: d2 * q }
        };
        let robot = Self::new(AZIMUTHS.map(leg))?;
        Ok(Self { name: "three-legged robot with inclined rails".to_owned(), ..robot })
    }

    /// The second design of the paper's figure 8: vertical rails, base axes tangential, platform axes at `elevation` (radians) over the horizontal.
    ///
    /// Our reading of the figure. Axes 110° apart have `cos 110° = -1/2 + (3/2) sin² elevation`; horizontal ones are singular wherever the
    /// platform is level. In this reading torsion is free in the home pose itself, whatever the elevation.
    ///
    /// # Errors
    /// As [`Tripod::cartesian`].
    pub fn upright(elevation: f64, d1: f64, d2: f64) -> Result<Self, TripodError> {
        let leg = |azimuth: f64| {
            let (s, c) = azimuth.sin_cos();
            let radial = Vector3::new(c, s, 0.0);
            let v = Vector3::new(elevation.cos() * c, elevation.cos() * s, elevation.sin());
            TripodLeg {
                u: Vector3::z(),
                w: Vector3::new(-s, c, 0.0),
                v,
                c: Vector3::zeros(),
                da: d1 * radial,
                db: d2 * radial,
            }
        };
        let robot = Self::new(AZIMUTHS.map(leg))?;
        Ok(Self { name: "three-legged robot with vertical rails".to_owned(), ..robot })
    }

    /// The six slider positions for a pose; one way only.
    ///
    /// **Shape**: `[rho_a, rho_b]` of leg 1, then 2, 3. **Accuracy**: closed form, a few roundings over the sine of the angle between plane and rail.
    /// **Source**: Cherkhelanov, Bonev, eqs. (4)-(13).
    ///
    /// # Errors
    /// A pose that is not finite; a leg's plane that is not determined, or parallel to its rails; one that would have to turn and has one motor.
    ///
    /// ```
    /// use assur::{Tripod, TripodPose, nalgebra::Vector3};
    /// let robot = Tripod::cartesian(600.0, 720.0)?;
    /// let inputs = robot.inverse(&TripodPose::new(Vector3::new(200.0, 260.0, 240.0), Vector3::zeros()))?;
    /// assert_eq!(inputs, [200.0, 200.0, 260.0, 260.0, 240.0, 240.0]);
    /// let across = TripodPose::new(Vector3::zeros(), Vector3::new(std::f64::consts::FRAC_PI_2, 0.0, 0.0));
    /// assert!(robot.inverse(&across).unwrap_err().to_string().starts_with("leg 1: the platform's axis is parallel"));
    /// # Ok::<(), assur::TripodError>(())
    /// ```
    pub fn inverse(&self, pose: &TripodPose) -> Result<[f64; 6], TripodError> {
        pose.check()?;
        let mut inputs = [0.0; 6];
        for (k, leg) in self.legs.iter().enumerate() {
            let plane = leg.plane(pose, k + 1)?;
            for (slider, rail) in [leg.da, leg.db].into_iter().enumerate() {
                inputs[2 * k + slider] = plane.normal.dot(&(plane.joint - rail)) / plane.along;
            }
        }
        self.together(&inputs)?;
        for k in (0..3).filter(|&k| self.one_motor[k]) {
            inputs[2 * k + 1] = inputs[2 * k];
        }
        Ok(inputs)
    }

    /// The angles of the legs' planes, in radians, from where both sliders of the leg are level.
    pub fn plane_angles(&self, pose: &TripodPose) -> Result<[f64; 3], TripodError> {
        let mut angles = [0.0; 3];
        for (k, leg) in self.legs.iter().enumerate() {
            let plane = leg.plane(pose, k + 1)?;
            angles[k] = (plane.normal.dot(&leg.across()) / plane.along).atan();
        }
        Ok(angles)
    }

    /// Limits that a pose violates; `inputs` are those of [`Tripod::inverse`].
    ///
    /// # Errors
    /// As [`Tripod::inverse`].
    pub fn violations(&self, pose: &TripodPose, inputs: &[f64; 6]) -> Result<Vec<TripodReach>, TripodError> {
        let mut found = Vec::new();
        for (k, (&value, limit)) in inputs.iter().zip(self.strokes.iter().flatten()).enumerate() {
            if !(limit[0]..=limit[1]).contains(&value) {
                found.push(TripodReach { leg: k / 2 + 1, slider: Some(k + 1), value, limit: *limit });
            }
        }
        if let Some(limit) = self.plane_angle_limit {
            for (leg, value) in (1..).zip(self.plane_angles(pose)?) {
                if value.abs() > limit {
                    found.push(TripodReach { leg, slider: None, value, limit: [-limit, limit] });
                }
            }
        }
        Ok(found)
    }
}

impl TripodLeg {
    /// The direction across the rails in the plane of the leg's sliders: the rails lie along it.
    pub(super) fn across(&self) -> Vector3<f64> {
        self.w.cross(&self.u)
    }

    /// The leg's plane in a pose; legs are counted from 1.
    pub(super) fn plane(&self, pose: &TripodPose, number: usize) -> Result<LegPlane, TripodError> {
        let axis = pose.rotation * self.v;
        let normal = axis.cross(&self.w);
        if normal.norm() <= PARALLEL {
            return Err(TripodError::ParallelAxes { leg: number });
        }
        let along = normal.dot(&self.u);
        if along.abs() <= PARALLEL * normal.norm() {
            return Err(TripodError::ParallelRail { leg: number });
        }
        let arm = pose.rotation * self.c;
        Ok(LegPlane { axis, normal, along, arm, joint: pose.position + arm })
    }

    /// The unit normal that the inputs give the leg's plane.
    pub(super) fn normal_of(&self, [a, b]: [f64; 2]) -> Option<Unit<Vector3<f64>>> {
        let across = self.db - self.da + self.u * (b - a);
        Unit::try_new(across.cross(&self.w), 0.0)
    }
}

/// A leg's plane in a pose.
pub(super) struct LegPlane {
    /// `R v`.
    pub(super) axis: Vector3<f64>,
    /// `n = R v × w`, not of length 1.
    pub(super) normal: Vector3<f64>,
    /// `n · u`.
    pub(super) along: f64,
    /// `R c`.
    pub(super) arm: Vector3<f64>,
    /// `p + R c`.
    pub(super) joint: Vector3<f64>,
}

const AZIMUTHS: [f64; 3] = [0.0, 2.0 * std::f64::consts::PI / 3.0, 4.0 * std::f64::consts::PI / 3.0];

fn axes() -> [Vector3<f64>; 3] {
    [Vector3::x(), Vector3::y(), Vector3::z()]
}
