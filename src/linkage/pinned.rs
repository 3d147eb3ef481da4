//! A platform pinned at one point and held by a dyad: the class-II group that two actuators on one leg leave.

use nalgebra::Vector2;
use thiserror::Error;

use super::group::{Dyad, Triad, TriadError};

/// A platform with its point `b` at the base point `a`, and one more leg.
///
/// | leg | assemblies | group of class II |
/// |---|---|---|
/// | RR | 2 | RRR |
/// | PR | 2 | RRP |
/// | RP | 2 | RPR |
/// | PP | 1 | RPP |
///
/// ```
/// use assur::{Dyad, PinnedDyad, nalgebra::Vector2};
/// // A crank of length 3 pinned in the origin, its tip 4 away from (5, 0): the 3-4-5 triangle and its mirror image.
/// let leg = Dyad::RR { a: Vector2::new(5.0, 0.0), b: Vector2::new(3.0, 0.0), length: 4.0 };
/// let answer = PinnedDyad::new(Vector2::zeros(), Vector2::zeros(), leg)?.assemble();
/// assert_eq!(answer.modes.len(), 2);
/// assert!((answer.modes[1].pose.phi.cos() - 0.6).abs() < 1e-15);
/// # Ok::<(), assur::PinnedDyadError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PinnedDyad {
    a: Vector2<f64>,
    b: Vector2<f64>,
    leg: Dyad,
}

/// Why a pin and a dyad make no group.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PinnedDyadError {
    /// A coordinate of the pin is NaN or infinite.
    #[error("pin: {value} must be finite")]
    NotFinite {
        /// The number found.
        value: f64,
    },
    /// The leg's numbers make no dyad.
    #[error(transparent)]
    Leg(#[from] TriadError),
}

impl PinnedDyad {
    /// The group of a pin and a leg, checked: `b` in the platform frame is held at `a` in the base frame.
    ///
    /// # Errors
    /// A number that is not finite, a negative length, a direction without length.
    pub fn new(a: Vector2<f64>, b: Vector2<f64>, leg: Dyad) -> Result<Self, PinnedDyadError> {
        if let Some(&value) = a.iter().chain(b.iter()).find(|value| !value.is_finite()) {
            return Err(PinnedDyadError::NotFinite { value });
        }
        // The same checks as in a triad; only the first leg can be wrong.
        Triad::new([leg, leg, leg])?;
        Ok(Self { a, b, leg })
    }

    /// The pinned base point and platform point.
    pub fn pin(&self) -> (Vector2<f64>, Vector2<f64>) {
        (self.a, self.b)
    }

    /// The leg.
    pub fn leg(&self) -> &Dyad {
        &self.leg
    }

    /// The pin as a leg of length zero, first, and the leg.
    pub(super) fn as_legs(&self) -> [Dyad; 2] {
        [Dyad::RR { a: self.a, b: self.b, length: 0.0 }, self.leg]
    }

    /// How many assemblies there can be: 2, or 1 where the leg fixes the orientation.
    pub fn degree(&self) -> usize {
        if matches!(self.leg, Dyad::PP { .. }) { 1 } else { 2 }
    }
}
