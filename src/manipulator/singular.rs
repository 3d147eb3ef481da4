//! Where a manipulator locks up, gives way, or is far from both.
//!
//! | type | where | what happens |
//! |---|---|---|
//! | 1 | `B` singular: a leg is stretched, folded or square to its slider | the platform loses a direction of motion; two working modes of the leg merge |
//! | 2 | `A` singular: the legs' lines of force meet in a point or are parallel | the platform moves with the actuators held; two assembly modes meet |
//! | 3 | both | |
//! | self-motion | the pose belongs to a curve of poses with the actuators held | the motion is not only instantaneous |
//!
//! Singular is decided on the loop equations, never on the eliminant: a double zero of the eliminant may be two poses of one orientation.
//! Whether an instantaneous motion is a finite one is decided exactly, on the locked group whose numbers are the `f64`s of the inputs.
//! Source: Gosselin and Angeles (1990), "Singularity analysis of closed-loop kinematic chains".

use nalgebra::{DMatrix, Matrix3, Vector2, Vector3};

use super::describe::Manipulator;
use super::inverse::KinematicsError;
use super::velocity::{SINGULAR, Velocity, smallest_singular_value};
use crate::linkage::Pose;

use super::lock::{LockError, LockedGroup};

/// What kind of singularity a pose is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SingularityKind {
    /// None.
    Regular,
    /// Of type 1: the platform loses a direction of motion.
    Type1,
    /// Of type 2: the platform moves with the actuators held.
    Type2,
    /// Of both types.
    Type3,
    /// On a curve of poses with the actuators held.
    SelfMotion,
}

impl SingularityKind {
    /// The name that reports use: `none`, `type 1`, `type 2`, `type 3`, `self-motion`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Regular => "none",
            Self::Type1 => "type 1",
            Self::Type2 => "type 2",
            Self::Type3 => "type 3",
            Self::SelfMotion => "self-motion",
        }
    }
}

/// How the legs' lines of force lie where `A` is singular.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    /// They meet in this point of the base frame, about which the platform turns freely.
    Meet {
        /// The point.
        point: Vector2<f64>,
    },
    /// They are parallel, in this direction; the platform moves freely at right angles to it.
    Parallel {
        /// The common direction, of length one.
        direction: Vector2<f64>,
    },
    /// They are one line: the platform has two free motions.
    OneLine {
        /// Direction of the line, of length one; zero where every leg gives a pure moment.
        direction: Vector2<f64>,
    },
}

/// What is known of a pose as a singularity.
#[derive(Clone, Debug, PartialEq)]
pub struct Singularity {
    /// Which kind.
    pub kind: SingularityKind,
    /// Legs that have lost a freedom (types 1 and 3), counted from 1.
    pub legs: Vec<usize>,
    /// Those of them whose idle joints move with the platform at rest, counted from 1: a strut without length, equal links folded.
    pub idle_legs: Vec<usize>,
    /// How the lines of force lie (types 2 and 3, self-motion).
    pub reading: Option<Reading>,
    /// The platform's free motion `(x', y', phi')` of size one (types 2 and 3, self-motion).
    pub free_motion: Option<Vector3<f64>>,
    /// The matrix whose singular values are given: `A` with moments in characteristic lengths and each row then divided by its length, so that it is a wrench of
    /// size one. A leg whose idle joints move with the platform at rest has two rows instead of its own. No unit.
    pub scaled_pose_matrix: DMatrix<f64>,
    /// Its singular values, largest first.
    pub singular_values: [f64; 3],
    /// The smallest of them: 0 singular, at most 1 for three rows.
    pub sigma_min: f64,
    /// The smallest singular value of a leg's block of `B`, rows divided as those of `A` and columns by the sizes of the actuated screws: the sine by which the leg
    /// is away from type 1.
    pub sigma_min_input: f64,
    /// Smallest over largest singular value of `B⁻¹ A diag(1, 1, 1/length)`, the map from `(x', y', length·phi')` to input rates, inputs weighed as they are: 0
    /// singular, 1 isotropic. The scaling of rows has no part in it.
    pub dexterity: f64,
    /// The characteristic length used.
    pub characteristic_length: f64,
}

/// Lines that meet farther away than this many characteristic lengths are called parallel.
const FAR: f64 = 1e7;

impl Manipulator {
    /// The length that weighs turning against moving where none is stated: the root mean square distance of the platform's joints from
    /// their centre; of the base's where those coincide; else 1.
    ///
    /// ```
    /// use assur::{Leg, Manipulator};
    /// let b = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0]];
    /// let robot = Manipulator::new("", b.map(|b| Leg::rpr([3.0 * b[0], 3.0 * b[1]], b)).to_vec())?;
    /// assert!((robot.characteristic_length() - (8.0f64 / 9.0).sqrt()).abs() < 1e-15);
    /// # Ok::<(), assur::DescriptionError>(())
    /// ```
    pub fn characteristic_length(&self) -> f64 {
        let spread = |points: Vec<Vector2<f64>>| {
            let count = points.len() as f64;
            let centre = points.iter().sum::<Vector2<f64>>() / count;
            (points.iter().map(|p| (p - centre).norm_squared()).sum::<f64>() / count).sqrt()
        };
        let platform = spread(self.legs.iter().map(|leg| leg.platform.at).collect());
        let base = spread(self.legs.iter().map(|leg| leg.base.at).collect());
        [platform, base].into_iter().find(|&length| length > 0.0).unwrap_or(1.0)
    }

    /// What kind of singularity a pose is in a working mode, and how far it is from one.
    ///
    /// `length` weighs turning against moving; [`Manipulator::characteristic_length`] where it is `None`. **Accuracy**: singular means that the
    /// smallest singular value is below 1e-7: a pose known to rounding fixes a stretched leg no better. Self-motion is decided exactly on the
    /// inputs that the pose gives. **Cost**: a few microseconds; half a millisecond more where `A` is singular.
    ///
    /// # Errors
    /// As [`Manipulator::velocity`]; a length that is not positive.
    ///
    /// ```
    /// use assur::{Leg, Manipulator, Pose, Reading, SingularityKind, nalgebra::Vector2};
    /// let robot = Manipulator::new("", vec![
    ///     Leg::rpr([0.0, 0.0], [0.0, 1.0]),
    ///     Leg::rpr([4.0, 0.0], [2.0, 1.0]),
    ///     Leg::rpr([2.0, 4.0], [1.0, 3.0]),
    /// ])?;
    /// // Here the lines of the three struts meet in (0, 4).
    /// let found = robot.singularity(&Pose::new(0.0, 1.0, 0.0), "+++", None)?;
    /// assert_eq!(found.kind, SingularityKind::Type2);
    /// let Some(Reading::Meet { point }) = found.reading else { panic!("the lines meet") };
    /// assert!((point - Vector2::new(0.0, 4.0)).norm() < 1e-12);
    /// assert_eq!(robot.singularity(&Pose::new(0.5, 1.2, 0.4), "+++", None)?.kind, SingularityKind::Regular);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn singularity(&self, pose: &Pose, signs: &str, length: Option<f64>) -> Result<Singularity, KinematicsError> {
        let length = length.unwrap_or_else(|| self.characteristic_length());
        positive_length(length)?;
        let velocity = self.velocity(pose, signs)?;
        let mut found = velocity.singularity(length);
        if found.reading.is_some() && self.moves_on(pose, &velocity.joints) {
            found.kind = SingularityKind::SelfMotion;
        }
        Ok(found)
    }

    /// Whether the pose belongs to a curve of poses with the actuators held where these joints have them.
    fn moves_on(&self, pose: &Pose, joints: &[[f64; 3]]) -> bool {
        let mut free = self.clone();
        free.legs.iter_mut().for_each(|leg| leg.limits = [None; 3]);
        let group = match free.lock(&self.inputs_of(joints)) {
            Ok(LockedGroup::Triad(triad)) => triad.assemble(),
            Ok(LockedGroup::Pinned(pinned)) => pinned.assemble(),
            Ok(LockedGroup::Placed(_)) => return false,
            // Two legs that hold the orientation leave a translation free in every pose.
            Err(LockError::OrientationTwice { .. }) => return true,
            Err(_) => return false,
        };
        let close = |a: f64, b: f64| super::frame::principal_angle(a - b).abs() < SELF_MOTION_ANGLE;
        let isolated = group.modes.iter().any(|mode| {
            (mode.pose.x - pose.x).hypot(mode.pose.y - pose.y) < SELF_MOTION_ANGLE * group.size
                && close(mode.pose.phi, pose.phi)
        });
        group.self_motions.iter().any(|motion| motion.real && motion.phi.map_or(!isolated, |phi| close(phi, pose.phi)))
    }
}

/// How near, in radians and in sizes of the group, a pose must be to a self-motion or an isolated mode to be taken for one of it: far above the
/// accuracy of modes (1e-15) and far below their distances.
const SELF_MOTION_ANGLE: f64 = 1e-9;

pub(super) fn positive_length(length: f64) -> Result<(), KinematicsError> {
    let sound = length > 0.0 && length.is_finite();
    sound.then_some(()).ok_or(KinematicsError::NotPositive { what: "characteristic length", value: length })
}

impl Velocity {
    /// What kind of singularity this is, self-motions not told from other singularities of type 2 or 3; `length` weighs turning against moving.
    ///
    /// [`Manipulator::singularity`] tells self-motions too.
    pub fn singularity(&self, length: f64) -> Singularity {
        let idle_legs: Vec<usize> = (1..)
            .zip(self.idle_independence(length))
            .filter(|(_, independence)| *independence <= SINGULAR)
            .map(|(leg, _)| leg)
            .collect();
        let input_sines = self.leg_sines(length);
        let lost = |leg: usize| {
            idle_legs.contains(&leg) || input_sines.iter().any(|&(of, sine)| of == leg && sine <= SINGULAR)
        };
        let legs: Vec<usize> = (1..=self.joints.len()).filter(|&leg| lost(leg)).collect();
        let wrenches = self.all_wrenches(length, &idle_legs);
        let decomposition = wrenches.clone().svd(false, true);
        let sigma = &decomposition.singular_values;
        let mut singular_values = [sigma[0], sigma[1], sigma[2]];
        singular_values.sort_by(|p, q| q.total_cmp(p));
        let sigma_min = singular_values[2];
        let mut out = Singularity {
            kind: SingularityKind::Regular,
            legs,
            idle_legs,
            reading: None,
            free_motion: None,
            scaled_pose_matrix: wrenches,
            singular_values,
            sigma_min,
            sigma_min_input: input_sines.iter().map(|&(_, sine)| sine).fold(1.0, f64::min),
            dexterity: self.dexterity(length),
            characteristic_length: length,
        };
        let type_2 = sigma_min <= SINGULAR;
        out.kind = match (out.legs.is_empty(), type_2) {
            (true, false) => SingularityKind::Regular,
            (false, false) => SingularityKind::Type1,
            (true, true) => SingularityKind::Type2,
            (false, true) => SingularityKind::Type3,
        };
        if let (true, Some(directions)) = (type_2, &decomposition.v_t) {
            let (mut least, mut rank) = (0, 0);
            for k in 0..3 {
                least = if sigma[k] < sigma[least] { k } else { least };
                rank += usize::from(sigma[k] > SINGULAR);
            }
            // In the plane of twists whose turning is measured as speed at the characteristic length.
            let free = Vector3::new(directions[(least, 0)], directions[(least, 1)], directions[(least, 2)]);
            out.reading = Some(if rank < 2 { self.one_line() } else { self.meeting(&free, length) });
            let motion = Vector3::new(free.x, free.y, free.z / length);
            out.free_motion = Some(motion / motion.norm());
        }
        out
    }

    /// The wrenches of all rows at size one; a leg whose idle joints are dependent withstands two.
    fn all_wrenches(&self, length: f64, idle_legs: &[usize]) -> DMatrix<f64> {
        let normalised = self.normalised_pose_matrix(length);
        let mut rows = Vec::new();
        for row in 0..3 {
            match self.idle_screw(self.row_legs[row], length).filter(|_| idle_legs.contains(&self.row_legs[row])) {
                // Any two directions at right angles to the one screw that both idle joints have.
                Some(screw) => {
                    let axis = Vector3::ith(screw.iamin(), 1.0);
                    let first = screw.cross(&axis).normalize();
                    rows.extend([first, screw.cross(&first).normalize()]);
                }
                None => rows.push(normalised.row(row).transpose()),
            }
        }
        DMatrix::from_fn(rows.len(), 3, |r, c| rows[r][c])
    }

    /// The smallest singular value of each leg's block of the normalised input matrix, with the leg from 1.
    fn leg_sines(&self, length: f64) -> Vec<(usize, f64)> {
        let input = self.normalised_input_matrix(length);
        (1..=self.joints.len())
            .filter_map(|leg| {
                let rows: Vec<usize> = (0..3).filter(|&row| self.row_legs[row] == leg).collect();
                let first = *rows.first()?;
                let block = input.view((first, first), (rows.len(), rows.len())).clone_owned();
                Some((leg, block.singular_values().min()))
            })
            .collect()
    }

    fn meeting(&self, free: &Vector3<f64>, length: f64) -> Reading {
        let along = free.xy();
        if free.z.abs() * FAR <= along.norm() {
            return Reading::Parallel { direction: Vector2::new(-along.y, along.x).normalize() };
        }
        // The mark moves with omega times (mark - centre) turned by a quarter.
        let arm = Vector2::new(-along.y, along.x) * (length / free.z);
        Reading::Meet { point: Vector2::new(self.pose.x, self.pose.y) + arm }
    }

    fn one_line(&self) -> Reading {
        let forces = (0..3).map(|row| Vector2::new(self.pose_matrix[(row, 0)], self.pose_matrix[(row, 1)]));
        let longest =
            forces.fold(Vector2::zeros(), |best: Vector2<f64>, f| if f.norm() > best.norm() { f } else { best });
        let size = longest.norm();
        Reading::OneLine { direction: if size > 0.0 { longest / size } else { longest } }
    }

    /// Smallest over largest singular value of the map between input rates and `(x', y', length·phi')`: 0 where singular, 1 where
    /// isotropic.
    ///
    /// Inputs are weighed as they are: where lengths and angles mix, their units matter.
    pub fn dexterity(&self, length: f64) -> f64 {
        match (self.input_inverse(), self.pose_inverse()) {
            (Err(_), _) | (_, Err(_)) => 0.0,
            (Ok(inverse), Ok(_)) => {
                let values = (inverse * self.weighed_pose_matrix(length)).singular_values();
                let (low, high) = (values.min(), values.max());
                if high.is_finite() && high > 0.0 { low / high } else { 0.0 }
            }
        }
    }

    /// The largest displacement of a platform point `(x, y)`, given in base axes from the platform's origin, when each input is off by at most one unit:
    /// first order, in length units; infinite where `A` is singular.
    pub fn position_error(&self, from_origin: Vector2<f64>) -> f64 {
        let Ok(inverse) = self.pose_inverse() else { return f64::INFINITY };
        let pose = inverse * self.input_matrix;
        // The largest value of a convex function over a cube is at a corner; opposite corners are alike.
        let corners = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
        corners
            .into_iter()
            .map(|[b, c]| {
                let motion = pose * Vector3::new(1.0, b, c);
                (motion.xy() + Vector2::new(-from_origin.y, from_origin.x) * motion.z).norm()
            })
            .fold(0.0, f64::max)
    }

    /// The smallest stiffness of the platform, over all directions of motion of size one with turning weighed by `length`, when every
    /// actuator has stiffness one and all else is rigid: 0 at type 2, infinite where `B` is singular.
    pub fn stiffness(&self, length: f64) -> f64 {
        match self.input_inverse() {
            Err(_) => f64::INFINITY,
            Ok(inverse) => smallest_singular_value(&(inverse * self.weighed_pose_matrix(length))).powi(2),
        }
    }

    fn weighed_pose_matrix(&self, length: f64) -> Matrix3<f64> {
        let mut out = self.pose_matrix;
        out.column_mut(2).unscale_mut(length);
        out
    }
}
