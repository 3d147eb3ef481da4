//! Assur groups as data: the four dyads and the triads made of them.
//!
//! A locked leg of a planar manipulator restrains the platform by one of four dyads, named by the passive
//! joints that are left, base first: RR, PR, RP, PP. Three of them make a triad, an Assur group of class III.

use nalgebra::{Isometry2, Point2, Vector2};
use thiserror::Error;

/// Where the platform is: its frame in the base frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Abscissa of the platform's origin, in the base frame, in the model's length unit.
    pub x: f64,
    /// Ordinate of the platform's origin, in the base frame.
    pub y: f64,
    /// Rotation of the platform against the base, counter-clockwise, in radians, in (-pi, pi].
    pub phi: f64,
}

impl Pose {
    /// A pose from its three numbers.
    pub fn new(x: f64, y: f64, phi: f64) -> Self {
        Self { x, y, phi }
    }

    /// The pose as a rigid motion from platform coordinates to base coordinates.
    ///
    /// ```
    /// use assur::{Pose, nalgebra::Point2};
    /// let quarter_turn = Pose::new(2.0, 0.0, std::f64::consts::FRAC_PI_2);
    /// let tip = quarter_turn.isometry() * Point2::new(1.0, 0.0);
    /// assert!((tip - Point2::new(2.0, 1.0)).norm() < 1e-15);
    /// ```
    pub fn isometry(&self) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(self.x, self.y), self.phi)
    }

    /// A platform point, given in platform coordinates, in base coordinates.
    pub fn place(&self, point: Vector2<f64>) -> Vector2<f64> {
        (self.isometry() * Point2::from(point)).coords
    }
}

/// How far an RP dyad's line runs beside its base pivot.
///
/// With `m = i v / |v|`, the row of the dyad is `(R m)·(a - X - R b) = d`. Locking a leg yields `delta = d·|v|` directly; keeping
/// that number, and never dividing by `|v|`, keeps the row's numbers exactly those that were given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Offset {
    /// The distance `d` itself, signed, in length units.
    Distance(f64),
    /// `delta = d·|v|`.
    TimesDirection(f64),
}

/// What is left of a leg when its driver is held: one condition on the pose `(X, R)`.
///
/// All of `a`, `u` are in the base frame, `b`, `v` in the platform frame. `u` and `v` need not have length one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dyad {
    /// Two revolute joints a fixed distance apart: `|X + R b - a| = length`.
    RR {
        /// Base pivot.
        a: Vector2<f64>,
        /// Platform pivot.
        b: Vector2<f64>,
        /// Distance of the pivots, not negative.
        length: f64,
    },
    /// A slider on the base that carries a platform pivot: `X + R b` lies on the line `a + t u`.
    PR {
        /// A point of the line.
        a: Vector2<f64>,
        /// Direction of the line, not zero.
        u: Vector2<f64>,
        /// Platform pivot.
        b: Vector2<f64>,
    },
    /// A base pivot on a slider of the platform: `(R i v/|v|)·(a - X - R b) = d`.
    RP {
        /// Base pivot.
        a: Vector2<f64>,
        /// A point of the platform line.
        b: Vector2<f64>,
        /// Direction of the platform line, not zero.
        v: Vector2<f64>,
        /// How far the base pivot lies to the left of the platform line.
        offset: Offset,
    },
    /// Two sliders: the platform only translates, `phi` is given (radians).
    PP {
        /// Rotation of the platform, in radians.
        phi: f64,
    },
}

impl Dyad {
    /// The passive joints, base first: `RR`, `PR`, `RP` or `PP`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::RR { .. } => "RR",
            Self::PR { .. } => "PR",
            Self::RP { .. } => "RP",
            Self::PP { .. } => "PP",
        }
    }
}

/// A platform held by three dyads.
///
/// Can only be had validated: every number finite, lengths not negative, directions not zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triad {
    legs: [Dyad; 3],
}

/// Why three dyads make no triad. Legs are counted from 1.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TriadError {
    /// A number is NaN or infinite.
    #[error("leg {leg}: {field} must be finite, not {value}")]
    NotFinite {
        /// Leg, from 1.
        leg: usize,
        /// Field of the dyad.
        field: &'static str,
        /// The number found.
        value: f64,
    },
    /// The length of an RR dyad is negative.
    #[error("leg {leg}: length {value} must be ≥ 0")]
    NegativeLength {
        /// Leg, from 1.
        leg: usize,
        /// The number found.
        value: f64,
    },
    /// The direction of a slider has no length.
    #[error("leg {leg}: direction {field} must not be [0, 0]")]
    NoDirection {
        /// Leg, from 1.
        leg: usize,
        /// Field of the dyad.
        field: &'static str,
    },
}

impl Triad {
    /// The triad of three dyads, checked.
    ///
    /// # Errors
    /// A number that is not finite, a negative length, a direction without length; each names the leg and the field.
    ///
    /// ```
    /// use assur::{Dyad, Triad, nalgebra::Vector2};
    /// let leg = |x: f64, length| Dyad::RR { a: Vector2::new(x, 0.0), b: Vector2::new(0.5 * x, x * x), length };
    /// assert_eq!(Triad::new([leg(0.0, 2.0), leg(1.0, 2.0), leg(3.0, 2.0)]).unwrap().name(), "RR-RR-RR");
    /// let error = Triad::new([leg(0.0, -0.3), leg(1.0, 2.0), leg(3.0, 2.0)]).unwrap_err();
    /// assert_eq!(error.to_string(), "leg 1: length -0.3 must be ≥ 0");
    /// ```
    pub fn new(legs: [Dyad; 3]) -> Result<Self, TriadError> {
        for (leg, dyad) in (1..).zip(&legs) {
            let finite = |field, value: f64| {
                if value.is_finite() { Ok(()) } else { Err(TriadError::NotFinite { leg, field, value }) }
            };
            let point = |field, p: &Vector2<f64>| finite(field, p.x).and_then(|()| finite(field, p.y));
            let direction = |field, p: &Vector2<f64>| {
                point(field, p)?;
                if *p == Vector2::zeros() { Err(TriadError::NoDirection { leg, field }) } else { Ok(()) }
            };
            match dyad {
                Dyad::RR { a, b, length } => {
                    point("a", a)?;
                    point("b", b)?;
                    finite("length", *length)?;
                    if *length < 0.0 {
                        return Err(TriadError::NegativeLength { leg, value: *length });
                    }
                }
                Dyad::PR { a, u, b } => {
                    point("a", a)?;
                    direction("u", u)?;
                    point("b", b)?;
                }
                Dyad::RP { a, b, v, offset } => {
                    point("a", a)?;
                    point("b", b)?;
                    direction("v", v)?;
                    match offset {
                        Offset::Distance(d) => finite("d", *d)?,
                        Offset::TimesDirection(delta) => finite("delta", *delta)?,
                    }
                }
                Dyad::PP { phi } => finite("phi", *phi)?,
            }
        }
        Ok(Self { legs })
    }

    /// The three dyads, in the order given.
    pub fn legs(&self) -> &[Dyad; 3] {
        &self.legs
    }

    /// The name of the group, legs in the order given: `RR-RR-RP`.
    pub fn name(&self) -> String {
        self.legs.each_ref().map(Dyad::name).join("-")
    }
}

/// How many finite solutions, real and complex, a triad of these dyads has in general; also a bound for the real ones.
///
/// `dyads` are names `RR`, `PR`, `RP`, `PP` in any order; `None` for any other name, or unless there are three.
///
/// ```
/// use assur::triad_degree;
/// assert_eq!(triad_degree(&["RR", "RR", "RR"]), Some(6));
/// assert_eq!(triad_degree(&["RP", "RP", "RP"]), Some(2));
/// assert_eq!(triad_degree(&["PR", "PP", "RP"]), Some(1));
/// ```
pub fn triad_degree(dyads: &[&str]) -> Option<usize> {
    let count = |name| dyads.iter().filter(|dyad| **dyad == name).count();
    let counts = ["RR", "PR", "RP", "PP"].map(count);
    (dyads.len() == 3 && counts.iter().sum::<usize>() == 3).then(|| degree_of(counts))
}

/// The same from how many of the three are RR, PR, RP and PP.
pub(super) fn degree_of(counts: [usize; 4]) -> usize {
    match counts {
        [3, 0, 0, 0] | [2, 1, 0, 0] | [2, 0, 1, 0] | [1, 1, 1, 0] => 6,
        [1, 2, 0, 0] | [1, 0, 2, 0] | [0, 2, 1, 0] | [0, 1, 2, 0] => 4,
        [0, 3, 0, 0] | [0, 0, 3, 0] => 2,
        [2, 0, 0, 1] | [1, 1, 0, 1] | [1, 0, 1, 1] => 2,
        [0, 2, 0, 1] | [0, 1, 1, 1] | [0, 0, 2, 1] => 1,
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn swapping_base_and_platform_keeps_the_degree() {
        let names = ["RR", "PR", "RP", "PP"];
        let swapped = ["RR", "RP", "PR", "PP"];
        let mut triads = 0;
        for i in 0..4 {
            for j in i..4 {
                for k in j..4 {
                    let degree = triad_degree(&[names[i], names[j], names[k]]);
                    assert!(degree.is_some());
                    assert_eq!(degree, triad_degree(&[swapped[k], swapped[i], swapped[j]]));
                    triads += 1;
                }
            }
        }
        assert_eq!(triads, 20);
        assert_eq!(triad_degree(&["RR", "RR"]), None);
        assert_eq!(triad_degree(&["RR", "RR", "RRR"]), None);
    }
}
