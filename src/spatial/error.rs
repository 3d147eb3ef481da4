//! What cannot be asked of a spatial robot.

use thiserror::Error;

/// Why a question about a spatial robot cannot be asked or answered. Legs are counted from 1.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SpatialError {
    /// A number is NaN or infinite.
    #[error("{what}: {value} must be finite")]
    NotFinite {
        /// Which number.
        what: String,
        /// The value found.
        value: f64,
    },
    /// A length that must be positive is not.
    #[error("{what}: {value} must be > 0")]
    NotPositive {
        /// Which length.
        what: String,
        /// The value found.
        value: f64,
    },
    /// A number so large or so small that its powers leave the range of `f64`.
    #[error("{what}: {value:e} must be between 1e-60 and 1e60 in size; choose another unit of length")]
    OutOfRange {
        /// Which number.
        what: String,
        /// The value found.
        value: f64,
    },
    /// A range whose ends are the wrong way round.
    #[error("{what}: [{low}, {high}] must run from the lower to the higher end")]
    Reversed {
        /// Which range.
        what: String,
        /// Its first number.
        low: f64,
        /// Its second number.
        high: f64,
    },
    /// Not as many numbers as there must be.
    #[error("{what}: {found} given, must be {expected}")]
    WrongCount {
        /// Which numbers.
        what: &'static str,
        /// How many there must be.
        expected: usize,
        /// How many were given.
        found: usize,
    },
    /// A leg does not reach the pose.
    #[error("leg {leg}: does not reach the pose, it misses by {miss:.6e}")]
    Unreachable {
        /// Leg, from 1.
        leg: usize,
        /// By how much, a length.
        miss: f64,
    },
    /// A mode's name that is none.
    #[error("mode \"{signs}\": must be 3 signs + or -, one a leg")]
    Signs {
        /// The text found.
        signs: String,
    },
    /// The matrix to be inverted is singular in this pose.
    #[error("the {matrix} matrix is singular ({kind}): {what}")]
    Singular {
        /// `pose` or `input`.
        matrix: &'static str,
        /// `type 1` or `type 2`.
        kind: &'static str,
        /// What that means here.
        what: &'static str,
    },
}

/// Lengths whose eighth powers fit into an `f64`.
const SIZES: std::ops::RangeInclusive<f64> = 1e-60..=1e60;

/// A finite number that is zero or of a size that can be computed with.
pub(super) fn moderate(what: impl FnOnce() -> String, value: f64) -> Result<(), SpatialError> {
    if value == 0.0 || SIZES.contains(&value.abs()) {
        return Ok(());
    }
    Err(if value.is_finite() {
        SpatialError::OutOfRange { what: what(), value }
    } else {
        SpatialError::NotFinite { what: what(), value }
    })
}

/// A positive length of a size that can be computed with.
pub(super) fn positive(what: &str, value: f64) -> Result<(), SpatialError> {
    moderate(|| what.to_owned(), value)?;
    if value > 0.0 { Ok(()) } else { Err(SpatialError::NotPositive { what: what.to_owned(), value }) }
}

/// A range that runs upwards.
pub(super) fn range(what: &str, [low, high]: [f64; 2]) -> Result<(), SpatialError> {
    moderate(|| what.to_owned(), low)?;
    moderate(|| what.to_owned(), high)?;
    if low <= high { Ok(()) } else { Err(SpatialError::Reversed { what: what.to_owned(), low, high }) }
}
