//! Robots with fewer degrees of freedom: legs with one motor, whose plane does not turn.
//!
//! Both sliders of such a leg are one, `rho_b = rho_a`, so that its plane keeps its normal `n = (Db - Da) × w` and asks `n · R v = 0` of the orientation. Everything else is as with six motors: forward
//! kinematics puts both sliders in the same place, a singularity of type 2 is one of the robot with all motors. The paper's robots with five and four degrees of freedom are the
//! Cartesian one with leg 1, or legs 1 and 2, like this; its text removes motor 4 and blocks leg 1, which leaves four independent inputs: it must be motor 2 (or 1) for leg 1.

use nalgebra::{Rotation3, Unit, Vector3};

use super::super::error::{SpatialError, moderate};
use super::model::{Tripod, TripodError, TripodPose, TripodReach};

/// Sliders of a leg with one motor may be apart by this over the distance of its rails: a pose was printed with ten digits (heuristic).
pub(super) const TOGETHER: f64 = 1e-9;
/// The condition on the torsion, a product of vectors of length 1, comes from some ten roundings and is zero below this.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

impl Tripod {
    /// The same robot with one motor in some legs, leg 1 first.
    ///
    /// ```
    /// use assur::{Tripod, TripodPose, nalgebra::Vector3};
    /// let robot = Tripod::cartesian(600.0, 720.0)?.with_one_motor([true, false, false]);
    /// assert_eq!((robot.degrees_of_freedom(), robot.motors()), (5, vec![1, 3, 4, 5, 6]));
    /// // Its first leg does not turn, so r12 = 0.
    /// let turned = TripodPose::new(Vector3::zeros(), Vector3::new(0.0, 0.0, 0.1));
    /// assert!(robot.inverse(&turned).unwrap_err().to_string().starts_with("leg 1: has one motor"));
    /// # Ok::<(), assur::TripodError>(())
    /// ```
    pub fn with_one_motor(self, one_motor: [bool; 3]) -> Self {
        Self { one_motor, ..self }
    }

    /// How many motors there are: 6, less one for each leg with one motor.
    pub fn degrees_of_freedom(&self) -> usize {
        6 - self.one_motor.iter().filter(|&&one| one).count()
    }

    /// The sliders, from 1 to 6, that have a motor of their own: all but the second of a leg with one motor.
    pub fn motors(&self) -> Vec<usize> {
        (1..=6).filter(|slider| slider % 2 == 1 || !self.one_motor[slider / 2 - 1]).collect()
    }

    /// The positions, rates or accelerations of all six sliders from those of the motors; six numbers stay as they are.
    ///
    /// # Errors
    /// Not as many as there are motors, nor six; not finite; six in which the sliders of a leg with one motor differ.
    pub fn all_sliders(&self, what: &'static str, motors: &[f64]) -> Result<[f64; 6], TripodError> {
        let expected = self.degrees_of_freedom();
        let mut sliders = [0.0; 6];
        if motors.len() == expected {
            for (slider, &value) in self.motors().into_iter().zip(motors) {
                sliders[slider - 1] = value;
                if self.one_motor[(slider - 1) / 2] {
                    sliders[slider] = value;
                }
            }
        } else {
            sliders =
                motors.try_into().map_err(|_| SpatialError::WrongCount { what, expected, found: motors.len() })?;
        }
        for (slider, &value) in (1..).zip(&sliders) {
            moderate(|| format!("{what}, slider {slider}"), value)?;
        }
        self.together(&sliders)?;
        Ok(sliders)
    }

    /// Whether the sliders of legs with one motor are together.
    pub(super) fn together(&self, sliders: &[f64; 6]) -> Result<(), TripodError> {
        for (k, leg) in self.legs.iter().enumerate().filter(|(k, _)| self.one_motor[*k]) {
            let apart = sliders[2 * k + 1] - sliders[2 * k];
            if apart.abs() > TOGETHER * (leg.db - leg.da).norm() {
                return Err(TripodError::OneMotor { leg: k + 1, apart });
            }
        }
        Ok(())
    }

    /// The orientations of a robot with five degrees of freedom that point the tool's axis in a direction of the base frame, least torsion first.
    ///
    /// **Shape**: each with its torsion `s` in radians, `R = rotation(direction, s)·R0`, where `R0` is the shortest rotation that takes the axis there, opposite to it a half-turn about the normalised cross product of
    /// the axis and the coordinate axis least along it. Two, one where they meet, none, or every torsion: see [`TripodTorsions`]. **Accuracy**: closed form.
    ///
    /// # Errors
    /// Not exactly one leg with one motor; a direction of no length or not finite.
    ///
    /// ```
    /// use assur::{Tripod, TripodTorsions, nalgebra::Vector3};
    /// let robot = Tripod::cartesian(600.0, 720.0)?.with_one_motor([true, false, false]);
    /// let robot = Tripod { tool_axis: Vector3::repeat(1.0).normalize(), ..robot };
    /// let found = robot.pointing(&Vector3::new(0.43091815999632127, 0.43091815999632127, 0.7928550174973794))?;
    /// let TripodTorsions::Isolated(found) = found else { unreachable!() };
    /// assert!(found.len() == 2 && (found[0].0 + 0.03239425964481102).abs() < 1e-9);
    /// // Along the platform's axis of the leg that does not turn, a direction in that leg's plane leaves torsion free.
    /// let along = Tripod { tool_axis: Vector3::y(), ..robot };
    /// assert!(matches!(along.pointing(&Vector3::new(0.0, 0.8, 0.6))?, TripodTorsions::Every(_)));
    /// # Ok::<(), assur::TripodError>(())
    /// ```
    pub fn pointing(&self, direction: &Vector3<f64>) -> Result<TripodTorsions, TripodError> {
        let only = (0..3).filter(|&k| self.one_motor[k]).collect::<Vec<_>>();
        let &[k] = only.as_slice() else {
            return Err(TripodError::DegreesOfFreedom {
                what: "pointing the tool in a direction",
                needed: 5,
                found: self.degrees_of_freedom(),
            });
        };
        let direction = unit("direction", direction)?;
        let leg = &self.legs[k];
        let normal = (leg.db - leg.da).cross(&leg.w).normalize();
        Ok(turned_into_plane(&self.tool_axis, &direction, &leg.v, &normal))
    }
}

/// The torsions with which a robot of five degrees of freedom points its tool's axis in a direction, each with its orientation.
#[derive(Clone, Debug, PartialEq)]
pub enum TripodTorsions {
    /// All there are, in radians, least first: two, one where they meet, or none at all.
    Isolated(Vec<(f64, Rotation3<f64>)>),
    /// Every torsion serves, to rounding: the direction lies in the plane of the leg that does not turn and the tool's axis is the leg's axis on the platform, or the direction is square to that plane and the
    /// tool's axis to the leg's. The orientation is that of torsion 0.
    Every(Rotation3<f64>),
}

impl TripodTorsions {
    /// `complete`, or `every_torsion`, as reports write it.
    pub fn status(&self) -> &'static str {
        match self {
            Self::Isolated(_) => "complete",
            Self::Every(_) => "every_torsion",
        }
    }
}

/// How a robot of five degrees of freedom points its tool in a direction at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct TripodPointed {
    /// Whether every torsion serves; the pose listed is then that of torsion 0.
    pub every_torsion: bool,
    /// The poses, least torsion first; none means that there are none.
    pub ways: Vec<TripodPointing>,
}

impl TripodPointed {
    /// `complete`, or `every_torsion`, as reports write it.
    pub fn status(&self) -> &'static str {
        if self.every_torsion { "every_torsion" } else { "complete" }
    }
}

/// A pose that points the tool of a robot with five degrees of freedom in a direction.
#[derive(Clone, Debug, PartialEq)]
pub struct TripodPointing {
    /// The torsion, in radians: see [`Tripod::pointing`].
    pub torsion: f64,
    /// The pose.
    pub pose: TripodPose,
    /// Slider positions, leg by leg; both of a leg with one motor are the same.
    pub inputs: [f64; 6],
    /// The angles of the legs' planes, in radians.
    pub plane_angles: [f64; 3],
    /// Limits that it violates.
    pub violations: Vec<TripodReach>,
}

impl Tripod {
    /// The poses of a robot with five degrees of freedom at a place of the platform's origin that point the tool's axis in a direction, as [`Tripod::pointing`] has them.
    ///
    /// # Errors
    /// As [`Tripod::pointing`] and [`Tripod::inverse`].
    pub fn pointed(&self, position: &Vector3<f64>, direction: &Vector3<f64>) -> Result<TripodPointed, TripodError> {
        let (every_torsion, ways) = match self.pointing(direction)? {
            TripodTorsions::Isolated(ways) => (false, ways),
            TripodTorsions::Every(rotation) => (true, vec![(0.0, rotation)]),
        };
        let way = |(torsion, rotation): (f64, Rotation3<f64>)| {
            let pose = TripodPose { position: *position, rotation };
            let inputs = self.inverse(&pose)?;
            let (plane_angles, violations) = (self.plane_angles(&pose)?, self.violations(&pose, &inputs)?);
            Ok(TripodPointing { torsion, pose, inputs, plane_angles, violations })
        };
        let ways = ways.into_iter().map(way).collect::<Result<_, TripodError>>()?;
        Ok(TripodPointed { every_torsion, ways })
    }
}

/// A vector at length 1.
pub(super) fn unit(what: &str, vector: &Vector3<f64>) -> Result<Vector3<f64>, SpatialError> {
    vector.iter().try_for_each(|&x| moderate(|| what.to_owned(), x))?;
    let no_length = || SpatialError::NotPositive { what: format!("length of the {what}"), value: 0.0 };
    vector.try_normalize(0.0).ok_or_else(no_length)
}

/// The shortest rotation that takes one direction to another, both of length 1; between opposite ones a half-turn about a fixed axis square to the first.
///
/// The angle by its sine and cosine: by its cosine alone it loses half of its digits near home.
fn shortest_turn(from: &Vector3<f64>, to: &Vector3<f64>) -> Rotation3<f64> {
    let across = from.cross(to);
    let angle = across.norm().atan2(from.dot(to));
    // Between nearly opposite ones rounding would leave a part along the first.
    let axis = Unit::try_new(across - from * across.dot(from), 0.0).unwrap_or_else(|| {
        // Square to the first, from the coordinate axis that is least along it.
        let least = from.iamin();
        Unit::new_normalize(from.cross(&Vector3::ith(least, 1.0)))
    });
    Rotation3::from_axis_angle(&axis, angle)
}

/// Turns that take an axis to a direction, both of length 1, and keep another axis square to a normal; least torsion first.
pub(super) fn turned_into_plane(
    axis: &Vector3<f64>,
    direction: &Vector3<f64>,
    kept: &Vector3<f64>,
    normal: &Vector3<f64>,
) -> TripodTorsions {
    let shortest = shortest_turn(axis, direction);
    // normal · R kept = a + b cos s + c sin s.
    let there = shortest * kept;
    let a = normal.dot(direction) * direction.dot(&there);
    let (b, c) = (normal.dot(&there) - a, normal.dot(&direction.cross(&there)));
    let amplitude = b.hypot(c);
    if amplitude <= ROUNDING {
        return if a.abs() <= ROUNDING {
            TripodTorsions::Every(shortest)
        } else {
            TripodTorsions::Isolated(Vec::new())
        };
    }
    // Beyond by rounding alone they meet.
    let level = if a.abs() <= amplitude + ROUNDING { a.clamp(-amplitude, amplitude) } else { a };
    let mut found: Vec<(f64, Rotation3<f64>)> = circle_equation(b, c, -level)
        .into_iter()
        .map(|torsion| (torsion, Rotation3::new(direction * torsion) * shortest))
        .collect();
    found.sort_by(|p, q| p.0.abs().total_cmp(&q.0.abs()));
    TripodTorsions::Isolated(found)
}

/// Angles in `(-pi, pi]` with `b cos s + c sin s = k`: two, one where they meet, or none.
pub(super) fn circle_equation(b: f64, c: f64, k: f64) -> Vec<f64> {
    let amplitude = b.hypot(c);
    if amplitude == 0.0 || k.abs() > amplitude {
        return Vec::new();
    }
    let (middle, half) = (c.atan2(b), (k / amplitude).acos());
    let wrapped = |angle: f64| angle.sin().atan2(angle.cos());
    let mut found = vec![wrapped(middle - half)];
    if half > 0.0 {
        found.push(wrapped(middle + half));
    }
    found
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix3;

    use super::*;

    /// Near home, near the half-turn, and at both.
    #[test]
    fn shortest_turns_keep_their_digits() {
        let from = Vector3::new(0.48, -0.6, 0.64);
        let beside = from.cross(&Vector3::x()).normalize();
        for small in [0.0, 1e-300, 1e-12, 1e-9, 1e-6, 1e-3] {
            for sign in [1.0_f64, -1.0] {
                let to = (sign * from + small * beside).normalize();
                let turn = shortest_turn(&from, &to);
                // A few roundings of numbers up to 1.
                assert!((turn * from - to).norm() < 8.0 * f64::EPSILON, "{small} {sign}: {turn}");
                assert!((turn.matrix() * turn.matrix().transpose() - Matrix3::identity()).norm() < 8.0 * f64::EPSILON);
            }
        }
    }
}
