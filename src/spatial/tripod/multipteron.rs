//! The Multipteron family as models: which legs, which degree, forward and inverse kinematics.
//!
//! Each leg keeps a point `b` of the platform in a plane square to its slider: `e · (p + R b) = rho`. The Tripteron does not turn, the Quadrupteron turns about one axis,
//! the Hexapteron any way. Legs of Quadrupteron and Hexapteron are derived here; those of the robots in print are the user's to give. The Pentapteron is not covered: its forward
//! kinematics has 208 real solutions and more (Masouleh, Husty, Gosselin 2010).

use nalgebra::{Rotation3, Unit, Vector3};
use thiserror::Error;

use super::super::error::{SpatialError, moderate};
use super::members::{Hexapteron, Quadrupteron, Tripteron};
use super::model::TripodPose;
use crate::solve::Account;

/// A member of the family.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Multipteron {
    /// Three degrees of freedom: degree 1.
    Tripteron(Tripteron),
    /// Four: degree 2.
    Quadrupteron(Quadrupteron),
    /// Six: degree 8.
    Hexapteron(Hexapteron),
}

/// Why numbers make no Multipteron, or a question about one cannot be asked. Legs are counted from 1.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum MultipteronError {
    /// A number that cannot be computed with, or not as many as there must be.
    #[error(transparent)]
    Number(#[from] SpatialError),
    /// A member that is not covered.
    #[error(
        "the Pentapteron is not covered: its forward kinematics has 208 real solutions and more (M. T. Masouleh, M. Husty, C. Gosselin, Advances in Robot Kinematics 2010, \
         pp. 211-221)"
    )]
    Pentapteron,
    /// No member has this name.
    #[error("\"{name}\": must be tripteron, quadrupteron or hexapteron")]
    Unknown {
        /// The name found.
        name: String,
    },
    /// A direction of no length.
    #[error("{what}: has no length")]
    NoDirection {
        /// Which.
        what: String,
    },
    /// The sliders' directions lie in a plane: the place is not determined.
    #[error("directions: they lie in a plane, so that the sliders do not determine the place")]
    Coplanar,
    /// A rotation that the robot does not make.
    #[error("pose: the {name} cannot turn by the rotation vector {turn:?}")]
    Turn {
        /// The robot.
        name: &'static str,
        /// The rotation vector, in radians.
        turn: [f64; 3],
    },
    /// The two points of a pair of legs of the Hexapteron are one.
    #[error("legs {first} and {second}: their points coincide, so that they cannot turn the platform")]
    OnePoint {
        /// The first leg of the pair.
        first: usize,
        /// The second.
        second: usize,
    },
}

/// A rotation vector is along an axis to this sine: it was printed with some ten digits (heuristic).
const ABOUT_AXIS: f64 = 1e-9;

/// Every way to put a Multipteron together.
#[derive(Clone, Debug, PartialEq)]
pub struct MultipteronPoses {
    /// The poses.
    pub poses: Vec<TripodPose>,
    /// Sums to the degree: 1, 2 or 8. Counted numerically.
    pub account: Account,
}

/// A volume of three unit vectors below this counts as zero (heuristic).
const PLANAR: f64 = 1e-9;
/// The orientation's equation of the Quadrupteron vanishes below this, over its largest possible coefficients (heuristic).
const VANISHING: f64 = 1e-13;

impl Multipteron {
    /// A member by its name; directions and the axis may have any length, points are in the platform's frame.
    ///
    /// **Shape**: 3 directions and no points; 4 and 4, and an axis; 3 and 6, two for each direction.
    ///
    /// # Errors
    /// See [`MultipteronError`].
    ///
    /// ```
    /// use assur::{Multipteron, nalgebra::Vector3};
    /// let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    /// let robot = Multipteron::new("tripteron", &axes, &[], None)?;
    /// assert_eq!(robot.forward(&[1.0, 2.0, 3.0])?.poses[0].position, Vector3::new(1.0, 2.0, 3.0));
    /// assert!(Multipteron::new("pentapteron", &axes, &[], None).unwrap_err().to_string().contains("208"));
    /// # Ok::<(), assur::MultipteronError>(())
    /// ```
    pub fn new(
        name: &str,
        directions: &[Vector3<f64>],
        points: &[Vector3<f64>],
        axis: Option<Vector3<f64>>,
    ) -> Result<Self, MultipteronError> {
        let (legs, joints) = match name {
            "tripteron" => (3, 0),
            "quadrupteron" => (4, 4),
            "hexapteron" => (3, 6),
            "pentapteron" => return Err(MultipteronError::Pentapteron),
            _ => return Err(MultipteronError::Unknown { name: name.to_owned() }),
        };
        for (what, expected, found) in [("directions", legs, directions.len()), ("points", joints, points.len())] {
            if expected != found {
                return Err(SpatialError::WrongCount { what, expected, found }.into());
            }
        }
        let unit = |what: String, v: &Vector3<f64>| -> Result<Vector3<f64>, MultipteronError> {
            v.iter().try_for_each(|&x| moderate(|| what.clone(), x))?;
            Unit::try_new(*v, 0.0).map(Unit::into_inner).ok_or(MultipteronError::NoDirection { what })
        };
        let named = (1..).zip(directions);
        let e = named.map(|(k, v)| unit(format!("directions, number {k}"), v)).collect::<Result<Vec<_>, _>>()?;
        for (k, point) in (1..).zip(points) {
            point.iter().try_for_each(|&x| moderate(|| format!("points, number {k}"), x))?;
        }
        let spans = |a: usize, b: usize, c: usize| e[a].dot(&e[b].cross(&e[c])).abs() > PLANAR;
        let anywhere = spans(0, 1, 2) || (e.len() == 4 && (spans(0, 1, 3) || spans(0, 2, 3) || spans(1, 2, 3)));
        if !anywhere {
            return Err(MultipteronError::Coplanar);
        }
        Ok(match legs {
            4 => Self::Quadrupteron(Quadrupteron {
                directions: [e[0], e[1], e[2], e[3]],
                points: [points[0], points[1], points[2], points[3]],
                axis: unit("axis".to_owned(), &axis.unwrap_or_else(Vector3::zeros))?,
            }),
            _ if joints == 0 => Self::Tripteron(Tripteron { directions: [e[0], e[1], e[2]] }),
            _ => {
                if let Some(pair) = (0..3).find(|pair| points[2 * pair] == points[2 * pair + 1]) {
                    return Err(MultipteronError::OnePoint { first: 2 * pair + 1, second: 2 * pair + 2 });
                }
                let points = std::array::from_fn(|k| points[k]);
                Self::Hexapteron(Hexapteron { directions: [e[0], e[1], e[2]], points })
            }
        })
    }

    /// `tripteron`, `quadrupteron`, `hexapteron`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Tripteron(_) => "tripteron",
            Self::Quadrupteron(_) => "quadrupteron",
            Self::Hexapteron(_) => "hexapteron",
        }
    }

    /// Degrees of freedom: how many sliders there are.
    pub fn degrees_of_freedom(&self) -> usize {
        match self {
            Self::Tripteron(_) => 3,
            Self::Quadrupteron(_) => 4,
            Self::Hexapteron(_) => 6,
        }
    }

    /// The direction of each leg's slider, of length 1, and the point of the platform, in its frame, that the leg holds.
    ///
    /// ```
    /// use assur::{Multipteron, nalgebra::Vector3};
    /// let robot = Multipteron::new("tripteron", &[Vector3::x(), Vector3::y(), Vector3::z() * 2.0], &[], None)?;
    /// assert_eq!(robot.legs()[2], (Vector3::z(), Vector3::zeros()));
    /// # Ok::<(), assur::MultipteronError>(())
    /// ```
    pub fn legs(&self) -> Vec<(Vector3<f64>, Vector3<f64>)> {
        match self {
            Self::Tripteron(robot) => robot.directions.iter().map(|&e| (e, Vector3::zeros())).collect(),
            Self::Quadrupteron(robot) => robot.directions.iter().copied().zip(robot.points).collect(),
            Self::Hexapteron(robot) => (0..6).map(|k| (robot.directions[k / 2], robot.points[k])).collect(),
        }
    }

    /// How many poses slider positions can have: 1, 2, 8.
    pub fn degree(&self) -> usize {
        match self {
            Self::Tripteron(_) => 1,
            Self::Quadrupteron(_) => 2,
            Self::Hexapteron(_) => 8,
        }
    }

    /// Every pose for slider positions.
    ///
    /// # Errors
    /// Not as many inputs as there are sliders; an input that is not finite.
    pub fn forward(&self, inputs: &[f64]) -> Result<MultipteronPoses, MultipteronError> {
        let expected = self.degrees_of_freedom();
        if inputs.len() != expected {
            return Err(SpatialError::WrongCount { what: "inputs", expected, found: inputs.len() }.into());
        }
        for (slider, &value) in (1..).zip(inputs) {
            moderate(|| format!("input {slider}"), value)?;
        }
        let mut account = Account { degree: self.degree(), ..Account::default() };
        let poses: Vec<TripodPose> = match self {
            Self::Tripteron(robot) => {
                let place = robot.forward(&[inputs[0], inputs[1], inputs[2]]);
                account.real = 1;
                place.map(|position| TripodPose { position, rotation: Rotation3::identity() }).into_iter().collect()
            }
            Self::Quadrupteron(robot) => {
                let found = robot.forward(&std::array::from_fn(|k| inputs[k]));
                let [cosine, sine, constant] = robot.orientation_equation(&std::array::from_fn(|k| inputs[k]));
                let size = robot.points.iter().map(|b| b.norm()).sum::<f64>();
                if cosine.hypot(sine) <= VANISHING * size {
                    // Turning changes nothing: any angle will do, or none.
                    let all = constant.abs() <= VANISHING * inputs.iter().map(|x| x.abs()).fold(size, f64::max);
                    *(if all { &mut account.self_motion } else { &mut account.at_infinity }) = 2;
                } else {
                    // One where two meet.
                    account.real = if found.is_empty() { 0 } else { 2 };
                    account.complex = 2 - account.real;
                }
                let pose = |(position, angle)| TripodPose { position, rotation: Rotation3::new(robot.axis * angle) };
                found.into_iter().map(pose).collect()
            }
            Self::Hexapteron(robot) => {
                let (poses, found) =
                    robot.forward(&std::array::from_fn(|k| inputs[k])).ok_or(MultipteronError::Coplanar)?;
                account = found;
                poses
            }
        };
        Ok(MultipteronPoses { poses, account })
    }

    /// The slider positions for a place and a rotation vector (axis times angle in radians). A Tripteron does not turn, a Quadrupteron about its axis only.
    ///
    /// # Errors
    /// A pose that is not finite, or one that the robot cannot turn to.
    pub fn inverse(&self, position: &Vector3<f64>, turn: &Vector3<f64>) -> Result<Vec<f64>, MultipteronError> {
        for (&value, name) in position.iter().chain(turn.iter()).zip(["x", "y", "z", "a", "b", "c"]) {
            moderate(|| format!("pose {name}"), value)?;
        }
        match self {
            Self::Tripteron(robot) if turn.norm() == 0.0 => Ok(robot.inverse(position).to_vec()),
            Self::Quadrupteron(robot) if turn.cross(&robot.axis).norm() <= ABOUT_AXIS * turn.norm() => {
                Ok(robot.inverse(position, turn.dot(&robot.axis)).to_vec())
            }
            Self::Tripteron(_) | Self::Quadrupteron(_) => {
                Err(MultipteronError::Turn { name: self.name(), turn: (*turn).into() })
            }
            Self::Hexapteron(robot) => Ok(robot.inverse(&TripodPose::new(*position, *turn)).to_vec()),
        }
    }
}
