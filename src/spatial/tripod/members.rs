//! Relatives of the three-legged robot: the Cartesian one with five and four degrees of freedom, and the Multipterons' models.
//!
//! Quadrupteron and Hexapteron are derived here, from legs that keep a point of the platform in a plane square to the driven direction (`e · (p + R b) = rho`); leg
//! vectors are the user's, not those of the robots in print. The Pentapteron is not covered.

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::super::error::SpatialError;
use super::cartesian::{CartesianRobot, CartesianSingular};
use super::fewer::{TripodTorsions, circle_equation, turned_into_plane, unit};
use super::model::TripodPose;
use super::orientation::PlaneConditions;
use crate::solve::Account;

impl CartesianRobot {
    /// The pose of the robot with five degrees of freedom, for `rho1, rho3, rho4, rho5, rho6`: leg 1 has one slider and does not turn, so its `rho2 = rho1`.
    ///
    /// Never singular of type 2: `T = 0`. The paper's text removes motor 4 and blocks leg 1; it must be motor 2 (or 1) for leg 1, or motor 4 for leg 2.
    ///
    /// # Errors
    /// Inputs that are not finite.
    pub fn forward_five(&self, &[r1, r3, r4, r5, r6]: &[f64; 5]) -> Result<TripodPose, CartesianSingular> {
        self.forward(&[r1, r1, r3, r4, r5, r6])
    }

    /// The orientations of the robot with five degrees of freedom that point an axis of the platform in a direction, least torsion first: `r12 = 0`.
    ///
    /// **Shape**: each with its torsion in radians, `R = rotation(direction, torsion)·R0`, where `R0` is the shortest rotation that takes the axis there, as [`crate::Tripod::pointing`].
    ///
    /// # Errors
    /// An axis or a direction of no length or not finite.
    pub fn five_dof_orientations(
        &self,
        axis: &Vector3<f64>,
        direction: &Vector3<f64>,
    ) -> Result<TripodTorsions, SpatialError> {
        Ok(turned_into_plane(&unit("axis", axis)?, &unit("direction", direction)?, &Vector3::y(), &Vector3::x()))
    }

    /// The pose of the robot with four degrees of freedom, for `rho1, rho3, rho5, rho6`: legs 1 and 2 do not turn, the platform turns about `y` only.
    ///
    /// ```
    /// use assur::CartesianRobot;
    /// let robot = CartesianRobot { d1: 600.0, d2: 720.0 };
    /// let pose = robot.forward_four(&[200.0, 260.0, 363.7344998438493, 400.8548497970041])?;
    /// assert!((pose.position.z - 240.0).abs() < 1e-9);
    /// # Ok::<(), assur::CartesianSingular>(())
    /// ```
    ///
    /// # Errors
    /// Inputs that are not finite.
    pub fn forward_four(&self, &[r1, r3, r5, r6]: &[f64; 4]) -> Result<TripodPose, CartesianSingular> {
        self.forward(&[r1, r1, r3, r3, r5, r6])
    }
}

/// The Tripteron: three legs, each of which holds the platform in a plane square to its slider; no rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tripteron {
    /// Directions of the sliders, of length 1.
    pub directions: [Vector3<f64>; 3],
}

impl Tripteron {
    /// The platform's place for slider positions; `None` where the directions lie in a plane.
    ///
    /// ```
    /// use assur::{Tripteron, nalgebra::Vector3};
    /// let robot = Tripteron { directions: [Vector3::x(), Vector3::y(), Vector3::z()] };
    /// assert_eq!(robot.forward(&[1.0, 2.0, 3.0]), Some(Vector3::new(1.0, 2.0, 3.0)));
    /// ```
    pub fn forward(&self, inputs: &[f64; 3]) -> Option<Vector3<f64>> {
        placed(&self.directions, inputs)
    }

    /// The slider positions for a place.
    pub fn inverse(&self, place: &Vector3<f64>) -> [f64; 3] {
        self.directions.map(|e| e.dot(place))
    }
}

/// The place in three planes; `None` where their normals lie in a plane.
fn placed(normals: &[Vector3<f64>; 3], heights: &[f64; 3]) -> Option<Vector3<f64>> {
    let [a, b, c] = normals;
    let determinant = a.dot(&b.cross(c));
    let place = (b.cross(c) * heights[0] + c.cross(a) * heights[1] + a.cross(b) * heights[2]) / determinant;
    (determinant.abs() > PLANAR).then_some(place)
}

/// Volumes of three unit vectors below this count as zero (heuristic).
const PLANAR: f64 = 1e-9;

/// A model of the Quadrupteron: four legs `e · (p + R b) = rho`, rotation about one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadrupteron {
    /// Directions of the sliders, of length 1.
    pub directions: [Vector3<f64>; 4],
    /// Points of the platform, in its frame.
    pub points: [Vector3<f64>; 4],
    /// The axis of rotation, of length 1.
    pub axis: Vector3<f64>,
}

impl Quadrupteron {
    /// The slider positions for a place and a rotation in radians.
    pub fn inverse(&self, place: &Vector3<f64>, angle: f64) -> [f64; 4] {
        let rotation = Rotation3::new(self.axis * angle);
        std::array::from_fn(|k| self.directions[k].dot(&(place + rotation * self.points[k])))
    }

    /// `[A, B, C]` of `A cos phi + B sin phi = C`: the combination of the four equations in which the place drops out.
    pub fn orientation_equation(&self, inputs: &[f64; 4]) -> [f64; 3] {
        let null = self.null_vector();
        let (mut cosine, mut sine, mut constant) = (0.0, 0.0, 0.0);
        for k in 0..4 {
            let e = &self.directions[k];
            let fixed = self.axis * self.axis.dot(&self.points[k]);
            cosine += null[k] * e.dot(&(self.points[k] - fixed));
            sine += null[k] * e.dot(&self.axis.cross(&self.points[k]));
            constant += null[k] * (inputs[k] - e.dot(&fixed));
        }
        [cosine, sine, constant]
    }

    /// The left null vector of the directions: signed minors.
    fn null_vector(&self) -> [f64; 4] {
        let volume = |k: usize| {
            let [a, b, c] = others(k).map(|i| self.directions[i]);
            a.dot(&b.cross(&c))
        };
        std::array::from_fn(|k| if k % 2 == 0 { volume(k) } else { -volume(k) })
    }

    /// Places and rotations (radians) for slider positions: at most two.
    ///
    /// By [`Quadrupteron::orientation_equation`]. Empty too where the directions lie in a plane.
    pub fn forward(&self, inputs: &[f64; 4]) -> Vec<(Vector3<f64>, f64)> {
        let (e, null) = (&self.directions, self.null_vector());
        let [cosine, sine, constant] = self.orientation_equation(inputs);
        let largest = (0..4).max_by(|&a, &b| null[a].abs().total_cmp(&null[b].abs())).unwrap_or(0);
        let place = |angle: f64| {
            let rotation = Rotation3::new(self.axis * angle);
            let rows = others(largest);
            let heights = rows.map(|k| inputs[k] - e[k].dot(&(rotation * self.points[k])));
            placed(&rows.map(|k| e[k]), &heights).map(|place| (place, angle))
        };
        circle_equation(cosine, sine, constant).into_iter().filter_map(place).collect()
    }
}

/// The three legs beside one.
fn others(k: usize) -> [usize; 3] {
    std::array::from_fn(|i| if i < k { i } else { i + 1 })
}

/// A model of the Hexapteron: six legs `e · (p + R b) = rho`, two for each direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hexapteron {
    /// Three directions, of length 1; legs 1 and 2 along the first, and so on.
    pub directions: [Vector3<f64>; 3],
    /// Points of the platform, in its frame.
    pub points: [Vector3<f64>; 6],
}

impl Hexapteron {
    /// The slider positions for a pose.
    pub fn inverse(&self, pose: &TripodPose) -> [f64; 6] {
        std::array::from_fn(|k| self.directions[k / 2].dot(&(pose.position + pose.rotation * self.points[k])))
    }

    /// All poses for slider positions, with the account of the eight orientations; `None` where two points of a direction coincide or the directions lie in a plane.
    ///
    /// The differences of the pairs are three conditions on the orientation alone, those of [`PlaneConditions`].
    pub fn forward(&self, inputs: &[f64; 6]) -> Option<(Vec<TripodPose>, Account)> {
        let mut conditions =
            PlaneConditions { normals: self.directions, directions: [Vector3::zeros(); 3], cosines: [0.0; 3] };
        for k in 0..3 {
            let apart = self.points[2 * k + 1] - self.points[2 * k];
            let length = apart.norm();
            if length == 0.0 || Matrix3::from_columns(&self.directions).determinant().abs() <= PLANAR {
                return None;
            }
            conditions.directions[k] = apart / length;
            conditions.cosines[k] = (inputs[2 * k + 1] - inputs[2 * k]) / length;
        }
        let found = conditions.solve();
        let pose = |rotation: Rotation3<f64>| {
            let heights =
                std::array::from_fn(|k| inputs[2 * k] - self.directions[k].dot(&(rotation * self.points[2 * k])));
            placed(&self.directions, &heights).map(|position| TripodPose { position, rotation })
        };
        let poses = found.rotations.iter().filter_map(|(rotation, _)| pose(*rotation)).collect();
        Some((poses, found.account))
    }
}
