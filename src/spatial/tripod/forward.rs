//! In which ways can a three-legged robot be put together for given slider positions?

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::super::error::{SpatialError, moderate};
use super::exact::{ExactConditions, cross, exact3, rounded};
use super::model::{PARALLEL, Tripod, TripodError, TripodPose};
use super::orientation::{Orientations, PlaneConditions};
use crate::algebra::{Rational, Ring, dyadic};
use crate::solve::Account;

/// How the answer ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TripodStatus {
    /// All solutions are listed.
    Complete,
    /// The legs' planes are parallel to a line: the platform slides along it, or there is no place for it (type 2, `T = 1`).
    PositionFree,
    /// A whole curve of orientations.
    OrientationFree,
    /// The roots could not be had.
    Undecided,
}

impl TripodStatus {
    /// `complete`, `self_motion`, `undecided`, as reports write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Complete => "complete",
            Self::PositionFree | Self::OrientationFree => "self_motion",
            Self::Undecided => "undecided",
        }
    }
}

/// What the numbers of an account rest on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counted {
    /// Eigenvalues, with tolerances.
    Numerically,
    /// Integers: exact for the `f64`s given.
    Exactly,
}

/// One way to put the robot together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TripodAssembly {
    /// Where the platform is.
    pub pose: TripodPose,
    /// How many solutions meet here.
    pub multiplicity: usize,
    /// Legs, from 1, whose platform axis is parallel to their base axis: the plane that the sliders set is none of theirs. Such a solution of the equations is
    /// spurious: the robot cannot be driven there.
    pub parallel_axes: [bool; 3],
    /// Largest distance of a platform joint from its leg's plane over the robot's size, and of its axis from the plane's direction.
    pub residual: f64,
}

impl TripodAssembly {
    /// Whether the equations have it and the robot does not.
    pub fn spurious(&self) -> bool {
        self.parallel_axes.contains(&true)
    }
}

/// Every way to put the robot together, with an account that adds up to eight.
#[derive(Clone, Debug, PartialEq)]
pub struct TripodAssemblies {
    /// Slider positions.
    pub inputs: [f64; 6],
    /// How it ended.
    pub status: TripodStatus,
    /// What the account rests on.
    pub counted: Counted,
    /// The ways that the robot has, sorted by their rotation.
    pub modes: Vec<TripodAssembly>,
    /// Solutions of the equations in which a platform axis is parallel to a base axis.
    pub spurious: Vec<TripodAssembly>,
    /// Degree 8 = real + complex + rejected (spurious) + self-motion + undecided.
    pub account: Account,
}

/// A sine of platform axis and base axis below this makes a solution spurious: polished rotations are good to about 1e-15, where two meet to about 1e-8 (heuristic).
const SPURIOUS: f64 = 1e-9;
const SPURIOUS_DOUBLE: f64 = 1e-6;

fn check(inputs: &[f64; 6]) -> Result<(), SpatialError> {
    (1..).zip(inputs).try_for_each(|(slider, &value)| moderate(|| format!("input {slider}"), value))
}

impl Tripod {
    /// Every way to put the robot together.
    ///
    /// **Shape**: at most eight modes; the account sums to 8. **Accuracy**: orientations polished on the conditions, residual measured on the planes.
    /// **Proof**: none; counts are numerical: [`Tripod::certify`] counts exactly. **Cost**: some tens of microseconds. **Source**: `orientation.rs`; the degree in the derivation `tripod_orientation`.
    ///
    /// # Errors
    /// An input that is not finite.
    ///
    /// ```
    /// use assur::{Tripod, TripodPose, nalgebra::Vector3};
    /// let robot = Tripod::cartesian(600.0, 720.0)?;
    /// let pose = TripodPose::new(Vector3::new(200.0, 260.0, 240.0), Vector3::new(0.1, 0.2, -0.1));
    /// let answer = robot.forward(&robot.inverse(&pose)?)?;
    /// assert_eq!((answer.modes.len(), answer.spurious.len()), (4, 4));
    /// assert!(answer.modes.iter().any(|mode| (mode.pose.rotation.matrix() - pose.rotation.matrix()).norm() < 1e-12));
    /// # Ok::<(), assur::TripodError>(())
    /// ```
    pub fn forward(&self, inputs: &[f64; 6]) -> Result<TripodAssemblies, TripodError> {
        check(inputs)?;
        self.together(inputs)?;
        let mut normals = [Vector3::zeros(); 3];
        for (k, leg) in self.legs.iter().enumerate() {
            let normal = leg.normal_of([inputs[2 * k], inputs[2 * k + 1]]);
            normals[k] = normal.ok_or(TripodError::OneRail { leg: k + 1 })?.into_inner();
        }
        let conditions = self.conditions(normals);
        let free = normals[0].dot(&normals[1].cross(&normals[2])).abs() <= PARALLEL;
        let parallel = |rotations: &[(Rotation3<f64>, usize)], leg: usize| {
            let limit = |multiplicity: usize| if multiplicity > 1 { SPURIOUS_DOUBLE } else { SPURIOUS };
            rotations.iter().map(|(rotation, m)| self.axes_apart(rotation, leg) <= limit(*m)).collect()
        };
        Ok(self.assembled(inputs, &normals, conditions.solve(), free, Counted::Numerically, parallel))
    }

    /// Every way to put the robot together, counted exactly for the `f64`s given.
    ///
    /// **Shape** and **accuracy** as [`Tripod::forward`]. **Proof**: how many solutions are real, with which multiplicity, whether they are a curve, whether the place is
    /// determined and how many are spurious for each leg is decided over the integers; what could not be lifted is counted as undecided. The digits of a pose are those
    /// of Newton's method beside an isolated root. **Cost**: some milliseconds; a tenth of a second where solutions meet. **Source**: `exact.rs`.
    ///
    /// # Errors
    /// As [`Tripod::forward`].
    ///
    /// ```
    /// use assur::{Counted, Tripod};
    /// let robot = Tripod::cartesian(600.0, 720.0)?;
    /// // t1 t2 t3 = -1: the four true orientations run into the four spurious ones.
    /// let answer = robot.certify(&[0.0, -120.0, 0.0, -120.0, 0.0, -120.0])?;
    /// assert_eq!((answer.counted, answer.spurious.len(), answer.account.rejected), (Counted::Exactly, 4, 8));
    /// # Ok::<(), assur::TripodError>(())
    /// ```
    pub fn certify(&self, inputs: &[f64; 6]) -> Result<TripodAssemblies, TripodError> {
        check(inputs)?;
        self.together(inputs)?;
        let finite = |v: &Vector3<f64>| exact3(&[v.x, v.y, v.z]).expect("a robot's numbers are finite");
        let exact = inputs.map(|x| dyadic(x).expect("inputs were checked"));
        let mut normals = Vec::with_capacity(3);
        for (k, leg) in self.legs.iter().enumerate() {
            let (da, db, u) = (finite(&leg.da), finite(&leg.db), finite(&leg.u));
            let apart = exact[2 * k + 1].clone() - exact[2 * k].clone();
            let across = std::array::from_fn(|i| db[i].clone() - da[i].clone() + u[i].clone() * apart.clone());
            normals.push(cross(&across, &finite(&leg.w)));
        }
        let normals: [_; 3] = normals.try_into().expect("three legs");
        let mut measured = [Vector3::zeros(); 3];
        for (k, normal) in normals.iter().enumerate() {
            measured[k] = rounded(normal).try_normalize(0.0).ok_or(TripodError::OneRail { leg: k + 1 })?;
        }
        let directions = self.legs.each_ref().map(|leg| [leg.v.x, leg.v.y, leg.v.z]);
        let zeros = [0, 0, 0].map(|_| Rational::zero());
        let conditions = ExactConditions::new(normals, directions, zeros).expect("a robot's numbers are finite");
        let orientations = conditions.solve(&self.conditions(measured));
        // As many as there are, and those nearest to it.
        let parallel = |rotations: &[(Rotation3<f64>, usize)], leg: usize| {
            let count = conditions.along(leg, &finite(&self.legs[leg].w)).unwrap_or(0);
            let mut nearest: Vec<usize> = (0..rotations.len()).collect();
            let apart = |k: usize| self.axes_apart(&rotations[k].0, leg);
            nearest.sort_by(|&a, &b| apart(a).total_cmp(&apart(b)));
            let mut flags = vec![false; rotations.len()];
            nearest.into_iter().take(count).for_each(|k| flags[k] = true);
            flags
        };
        Ok(self.assembled(inputs, &measured, orientations, conditions.coplanar(), Counted::Exactly, parallel))
    }

    fn conditions(&self, normals: [Vector3<f64>; 3]) -> PlaneConditions {
        PlaneConditions { normals, directions: self.legs.each_ref().map(|leg| leg.v), cosines: [0.0; 3] }
    }

    /// The sine of the angle between a leg's axes on the platform and on the base.
    fn axes_apart(&self, rotation: &Rotation3<f64>, leg: usize) -> f64 {
        let leg = &self.legs[leg];
        (rotation * leg.v).cross(&leg.w).norm()
    }

    /// From orientations to poses, spurious ones apart; `parallel` tells for which orientations a leg's axes are parallel.
    fn assembled(
        &self,
        inputs: &[f64; 6],
        normals: &[Vector3<f64>; 3],
        orientations: Orientations,
        place_free: bool,
        counted: Counted,
        parallel: impl Fn(&[(Rotation3<f64>, usize)], usize) -> Vec<bool>,
    ) -> TripodAssemblies {
        let Orientations { rotations, mut account, self_motion } = orientations;
        let mut answer = TripodAssemblies {
            inputs: *inputs,
            status: TripodStatus::Complete,
            counted,
            modes: Vec::new(),
            spurious: Vec::new(),
            account,
        };
        if self_motion {
            answer.status = TripodStatus::OrientationFree;
            return answer;
        }
        if account.undecided > 0 {
            answer.status = TripodStatus::Undecided;
        }
        if place_free {
            answer.status = TripodStatus::PositionFree;
            account.self_motion = account.real;
            account.real = 0;
            answer.account = account;
            return answer;
        }
        let [n1, n2, n3] = *normals;
        let minors = [n2.cross(&n3), n3.cross(&n1), n1.cross(&n2)];
        let determinant = n1.dot(&minors[0]);
        let flags: [Vec<bool>; 3] = std::array::from_fn(|leg| parallel(&rotations, leg));
        for (number, &(rotation, multiplicity)) in rotations.iter().enumerate() {
            let right: [f64; 3] = std::array::from_fn(|k| {
                let leg = &self.legs[k];
                normals[k].dot(&(leg.da + leg.u * inputs[2 * k] - rotation * leg.c))
            });
            let position = (minors[0] * right[0] + minors[1] * right[1] + minors[2] * right[2]) / determinant;
            let pose = TripodPose { position, rotation };
            let parallel_axes = flags.each_ref().map(|flags| flags[number]);
            let residual = self.residual(&pose, inputs, normals);
            let mode = TripodAssembly { pose, multiplicity, parallel_axes, residual };
            if mode.spurious() {
                account.real -= multiplicity;
                account.rejected += multiplicity;
                answer.spurious.push(mode);
            } else {
                answer.modes.push(mode);
            }
        }
        answer.account = account;
        debug_assert!(account.adds_up(), "{account:?}");
        answer
    }

    /// How far the assembled robot is from closing: both points of each joint's axis against the plane through both sliders.
    fn residual(&self, pose: &TripodPose, inputs: &[f64; 6], normals: &[Vector3<f64>; 3]) -> f64 {
        let mut worst: f64 = 0.0;
        for (k, leg) in self.legs.iter().enumerate() {
            let joint = pose.position + pose.rotation * leg.c;
            for (slider, rail) in [leg.da, leg.db].into_iter().enumerate() {
                let arm = joint - rail - leg.u * inputs[2 * k + slider];
                let size = arm.norm().max(leg.da.norm()).max(leg.db.norm());
                worst = worst.max(normals[k].dot(&arm).abs() / size);
            }
            worst = worst.max(normals[k].dot(&(pose.rotation * leg.v)).abs());
        }
        worst
    }

    /// The normals of the legs' planes in a pose, of length 1, and the volume they span: 0 where the place is not determined.
    pub(super) fn unit_normals(&self, pose: &TripodPose) -> Result<([Vector3<f64>; 3], f64), TripodError> {
        let mut normals = [Vector3::zeros(); 3];
        for (k, leg) in self.legs.iter().enumerate() {
            normals[k] = leg.plane(pose, k + 1)?.normal.normalize();
        }
        Ok((normals, Matrix3::from_columns(&normals).determinant()))
    }
}
