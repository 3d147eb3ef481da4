//! Planar Assur groups: what is left of a mechanism when its drivers are held.
//!
//! A [`Triad`] is a platform on three [`Dyad`]s; [`Triad::assemble`] finds every way to put it together.

mod group;

pub use group::{Dyad, Offset, Pose, Triad, TriadError};
