//! Plane geometry that every planar question shares: sets of angles, sectors of directions, circles and lines and where they meet.
//!
//! Nothing here knows a mechanism. Decisions near tangency are made on gaps (lengths), never on differences of squares or on arc cosines, which
//! lose half their digits there.

mod angles;
mod carrier;
mod quadrature;
mod sector;

pub use angles::{AngleSet, PhiRange, principal};
pub use carrier::{Carrier, Meeting};
pub(crate) use quadrature::gauss;
pub use sector::{Sector, conjugate, direction, product};
