//! A manipulator's limits, ready for questions about places.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use super::leg::{Chain, LegReach};
use super::limits::{ActiveLimit, Limit, WorkspaceError, WorkspaceModes};
use super::region::WorkspaceKind;
use crate::manipulator::Manipulator;
use crate::plane::{AngleSet, direction};

/// How a place stands to a workspace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Membership {
    /// Whether it belongs to it.
    pub inside: bool,
    /// In length units: the largest over the allowed orientations (for total and dextrous the smallest) of the smallest slack over
    /// all limits; negative outside.
    pub margin: f64,
    /// The limit that leaves no more.
    pub binding: Option<ActiveLimit>,
}

/// The limits of a manipulator in the frame of its reference point.
#[derive(Clone, Debug)]
pub struct Reach {
    pub(super) legs: Vec<LegReach>,
    /// Largest length of the mechanism: the scale of roundings.
    pub(super) size: f64,
}

impl Manipulator {
    /// The manipulator's limits, ready for questions about its workspaces.
    ///
    /// Every joint with a range counts, driven or not. **Cost**: some microseconds.
    ///
    /// # Errors
    /// A description that is no manipulator; a leg that is not RPR, RRR or PRR; a link without length; a wrong number of signs.
    ///
    /// ```
    /// use assur::{Manipulator, workspace::WorkspaceModes};
    /// let (mut robot, _) = Manipulator::of_family("3-RPR")?;
    /// robot.legs.iter_mut().for_each(|leg| leg.limits[1] = Some([8.0, 14.0]));
    /// let reach = robot.reach(&WorkspaceModes::Both)?;
    /// assert!(reach.orientations([1e3, 0.0].into()).is_empty());
    /// let (other, _) = Manipulator::of_family("3-PPR")?;
    /// let error = other.reach(&WorkspaceModes::Both).unwrap_err().to_string();
    /// assert_eq!(error, "leg 1: workspaces of legs PPR are not covered; those of RPR, RRR and PRR are");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn reach(&self, modes: &WorkspaceModes) -> Result<Reach, WorkspaceError> {
        self.validate()?;
        if let WorkspaceModes::Signs(signs) = modes
            && signs.len() != self.legs.len()
        {
            return Err(WorkspaceError::ModeCount { modes: modes.to_string(), legs: self.legs.len() });
        }
        let legs = self.legs.iter().enumerate().map(|(k, leg)| LegReach::new(k, leg, self.reference, modes));
        let legs = legs.collect::<Result<Vec<_>, _>>()?;
        let mut size = 0.0_f64;
        for leg in &legs {
            let reach = leg.furthest();
            let own = match leg.chain {
                Chain::Rpr { offset } => offset.abs(),
                Chain::Rrr { l1, l2 } => l1 + l2,
                Chain::Prr { l, .. } => l,
            };
            size = size.max(own).max(leg.a.norm()).max(leg.b.norm()).max(if reach.is_finite() { reach } else { 0.0 });
        }
        Ok(Reach { legs, size })
    }
}

impl Reach {
    /// Every surface that may bound the manipulator, leg by leg; see [`Limit`].
    pub fn limits(&self) -> impl Iterator<Item = &Limit> + '_ {
        self.legs.iter().flat_map(|leg| &leg.limits)
    }

    /// Number of legs.
    pub fn leg_count(&self) -> usize {
        self.legs.len()
    }

    /// The mechanism's largest length: the scale of roundings.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// The orientations in which every leg allows the reference point at a place. Exact: closed intervals, single orientations kept.
    pub fn orientations(&self, at: Vector2<f64>) -> AngleSet {
        let mut set = AngleSet::full();
        for leg in 0..self.legs.len() {
            set = set.intersect(&self.leg_orientations(leg, at));
            if set.is_empty() {
                break;
            }
        }
        set
    }

    /// The orientations in which one leg (from 0) allows the reference point at a place.
    pub fn leg_orientations(&self, leg: usize, at: Vector2<f64>) -> AngleSet {
        self.legs[leg].orientations(at, TOUCH * self.size)
    }

    /// Whether a place belongs to a workspace, with its margin.
    pub fn membership(&self, kind: &WorkspaceKind, at: Vector2<f64>) -> Membership {
        Membership { inside: self.contains(kind, at), margin: f64::NAN, binding: None }
    }

    /// Whether a place belongs to a workspace.
    pub fn contains(&self, kind: &WorkspaceKind, at: Vector2<f64>) -> bool {
        match kind {
            WorkspaceKind::Constant { phi } => self.allows(at, *phi),
            WorkspaceKind::Maximal => !self.orientations(at).is_empty(),
            WorkspaceKind::Inclusive(range) => !self.orientations(at).intersect(&range.set()).is_empty(),
            WorkspaceKind::Total(range) => self.orientations(at).covers(range, 0.0),
            WorkspaceKind::Dextrous => self.orientations(at).is_full(),
        }
    }

    /// Whether every leg allows the pose (C, phi), phi in radians.
    pub fn allows(&self, at: Vector2<f64>, phi: f64) -> bool {
        let turn = direction(phi);
        self.legs.iter().all(|leg| leg.allows_pose(at, turn, TOUCH * self.size))
    }
}

/// What misses a limit by less than this many of the mechanism's largest length meets it (error bound: the places of pivots
/// and their distances take some ten roundings of that length).
pub(super) const TOUCH: f64 = 16.0 * f64::EPSILON;

impl LegReach {
    /// Whether the leg allows the reference point at a place, the platform turned by a unit vector.
    pub(super) fn allows_pose(&self, at: Vector2<f64>, turn: Vector2<f64>, tol: f64) -> bool {
        self.allows(at + crate::plane::product(turn, self.b), turn, tol)
    }

    fn orientations(&self, at: Vector2<f64>, tol: f64) -> AngleSet {
        if let Some([low, high]) = self.ring {
            return self.ring_orientations(low, high, at, tol);
        }
        let mut ends: Vec<f64> = self.limits.iter().flat_map(|limit| limit.orientations_at(at, tol)).collect();
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        let Some(&first) = ends.first() else {
            return if self.allows_pose(at, direction(0.0), tol) { AngleSet::full() } else { AngleSet::empty() };
        };
        let mut set = AngleSet::empty();
        let next = ends.iter().skip(1).copied().chain([first + TAU]);
        for (&from, to) in ends.iter().zip(next) {
            if self.allows_pose(at, direction(0.5 * (from + to)), tol) {
                set = set.union(&AngleSet::arc(from, to - from));
            } else if self.allows_pose(at, direction(from), tol) {
                set = set.union(&AngleSet::arc(from, 0.0));
            }
        }
        set
    }

    /// `|psi|` between the values at the two radii, psi the angle from C - A to the platform arm.
    fn ring_orientations(&self, low: f64, high: f64, at: Vector2<f64>, tol: f64) -> AngleSet {
        let (away, arm) = (at - self.a, self.b.norm());
        let d = away.norm();
        if d == 0.0 || arm == 0.0 {
            let inside = low - tol <= d + arm && d + arm <= high + tol;
            return if inside { AngleSet::full() } else { AngleSet::empty() };
        }
        // psi at a radius; 0 where even the furthest position is nearer than it, pi where the nearest is further.
        let psi = |r: f64| {
            let (above, below) = (d + arm - r, r - (d - arm).abs());
            2.0 * (above.max(0.0) * (d + arm + r)).sqrt().atan2((below.max(0.0) * (r + (d - arm).abs())).sqrt())
        };
        if (d - arm).abs() > high + tol || d + arm < low - tol {
            return AngleSet::empty();
        }
        let middle = away.y.atan2(away.x) - self.b.y.atan2(self.b.x);
        let inner = if d + arm <= high { 0.0 } else { psi(high) };
        let outer = if (d - arm).abs() >= low { std::f64::consts::PI } else { psi(low) };
        if inner == 0.0 {
            return AngleSet::arc(middle - outer, 2.0 * outer);
        }
        if outer == std::f64::consts::PI {
            return AngleSet::arc(middle + inner, TAU - 2.0 * inner);
        }
        AngleSet::arc(middle + inner, outer - inner).union(&AngleSet::arc(middle - outer, outer - inner))
    }
}
