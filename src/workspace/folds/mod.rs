//! The boundary of what can be reached with some orientation: the curves along which an interval of orientations vanishes.
//!
//! Write each limit as `g(C, phi) <= 0`. Some orientation is lost at the boundary, so that there the limits active close in on one orientation: with multipliers
//! not negative, not all zero, `sum lam_k dg_k/dphi = 0` (Fritz John), the end of a range of phi counting as a limit. That leaves
//!
//! | active | condition | curve of `C` |
//! |---|---|---|
//! | one limit | `g` least in phi | circles and lines where platform arm and leg are in line ([`motion`]) |
//! | one limit, phi at an end of its range | `g` grows towards the inside of the range | a circle or a line |
//! | two limits of different legs | `dg/dphi` of opposite signs | coupler curve ([`coupled`]) |
//! | two limits of one leg | the same | a circle about the remaining joint, or a line ([`edges`]) |
//! | one limit at the reference point's own pivot | | its own circle or line |
//!
//! [`curves`] lists them with all places where anything about them changes, in closed form or as real modes of triads; [`outline`] keeps what bounds, [`closing`] makes loops of it. The derivation `fold_rule` has the rule.

mod arc;
mod closing;
mod coupled;
mod crossings;
mod curves;
mod edges;
mod every;
mod motion;
mod outline;
mod surface;

pub use arc::CouplerArc;

use nalgebra::Vector2;

use super::reach::Reach;
use super::region::{Workspace, WorkspaceKind};
use crate::plane::PhiRange;

impl Reach {
    /// The part of the maximal workspace at whose places `reached` says so.
    pub(super) fn folded_where(&self, reached: &dyn Fn(Vector2<f64>) -> bool) -> Workspace {
        outline::outline_where(self, reached).workspace(&WorkspaceKind::Maximal)
    }

    /// Orientations, radians in [-pi, pi) and sorted, between which the places allowed at one orientation keep their shape: a superset.
    pub(super) fn turning_points(&self) -> Vec<f64> {
        curves::Curves::new(self, None).turning_points()
    }

    /// The maximal workspace, or that of a range of orientations.
    pub(super) fn folded(&self, kind: &WorkspaceKind, range: Option<&PhiRange>) -> Workspace {
        let Some(middle) = self.far() else { return outline::outline(self, range).workspace(kind) };
        let near = self.moved(-middle);
        self.carried(&near, &outline::outline(&near, range).workspace(kind), middle)
    }
}
