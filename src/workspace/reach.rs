//! A manipulator's limits, ready for questions about places.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector2;

use super::leg::{Chain, LegReach};
use super::limits::{Limit, WorkspaceError, WorkspaceModes};
use super::membership::Edge;
use super::region::{Workspace, WorkspaceKind};
use super::total::Sweep;
use crate::manipulator::Manipulator;
use crate::plane::{AngleSet, PhiRange, direction};

/// The limits of a manipulator in the frame of its reference point.
#[derive(Clone, Debug)]
pub struct Reach {
    pub(super) legs: Vec<LegReach>,
    /// Per leg the edge that does not move with the platform.
    pub(super) edges: Vec<Vec<Edge>>,
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
        Ok(Reach::of_legs(legs))
    }
}

impl Reach {
    fn of_legs(legs: Vec<LegReach>) -> Self {
        let size = legs.iter().map(|leg| leg.largest().max(leg.a.norm())).fold(0.0, f64::max);
        let edges = legs.iter().map(|leg| leg.fixed_edges(size)).collect();
        Self { legs, edges, size }
    }

    /// The limits carried along with the base frame.
    pub(super) fn moved(&self, by: Vector2<f64>) -> Self {
        let legs = self.legs.iter().map(|leg| LegReach {
            a: leg.a + by,
            limits: leg.limits.iter().map(|limit| limit.moved(by)).collect(),
            ..leg.clone()
        });
        Self::of_legs(legs.collect())
    }

    /// The middle of the base pivots, where that is far from the origin: curves are told apart by the digits that distance leaves of their places.
    pub(super) fn far(&self) -> Option<Vector2<f64>> {
        let middle = self.legs.iter().map(|leg| leg.a).sum::<Vector2<f64>>() / self.legs.len() as f64;
        let spread = self.legs.iter().map(|leg| leg.largest().max((leg.a - middle).norm())).fold(0.0, f64::max);
        (spread > 0.0 && middle.norm() > FAR * spread).then_some(middle)
    }

    /// A workspace of these limits that was found where they are `near` the origin, carried back by `by`; its arcs name the limits as they are here.
    pub(super) fn carried(&self, near: &Self, found: &Workspace, by: Vector2<f64>) -> Workspace {
        let own = |limit: &Limit| {
            let named = near.limits().zip(self.limits()).find(|(there, _)| *there == limit);
            named.map_or_else(|| limit.moved(by), |(_, here)| *here)
        };
        Workspace {
            kind: found.kind,
            region: found.region.moved(by, &own),
            separating: found.separating.iter().map(|arc| arc.moved(by, &own)).collect(),
        }
    }

    /// Every surface that may bound the manipulator, leg by leg; see [`Limit`].
    pub fn limits(&self) -> impl Iterator<Item = &Limit> + '_ {
        self.legs.iter().flat_map(|leg| &leg.limits)
    }

    /// Number of legs.
    pub fn leg_count(&self) -> usize {
        self.legs.len()
    }

    /// The limits of one leg (from 0) alone, as if the platform hung on no other.
    ///
    /// ```
    /// use assur::workspace::{WorkspaceKind, WorkspaceModes};
    /// # let (mut robot, _) = assur::Manipulator::of_family("3-RPR")?;
    /// # robot.legs.iter_mut().for_each(|leg| leg.limits[1] = Some([5.0, 14.0]));
    /// let own = robot.reach(&WorkspaceModes::Both)?.only(1).workspace(&WorkspaceKind::Constant { phi: 0.3 })?;
    /// let ring = std::f64::consts::PI * (14.0 * 14.0 - 5.0 * 5.0);
    /// assert!((own.region.area - ring).abs() < 1e-10 && own.region.holes == 1);
    /// let own = robot.reach(&WorkspaceModes::Both)?.only(1).workspace(&WorkspaceKind::Maximal)?;
    /// assert_eq!(own.region.components, 1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn only(&self, leg: usize) -> Self {
        Self { legs: vec![self.legs[leg].clone()], edges: vec![self.edges[leg].clone()], size: self.size }
    }

    /// The leg that a limit names; of one leg alone ([`Reach::only`]) the numbers stay.
    pub(super) fn leg_of(&self, limit: usize) -> &LegReach {
        let named = |leg: &&LegReach| leg.limits.first().is_some_and(|first| first.leg == limit);
        self.legs.iter().find(named).expect("a limit belongs to a leg of its reach")
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

    /// Whether a place belongs to a workspace.
    pub fn contains(&self, kind: &WorkspaceKind, at: Vector2<f64>) -> bool {
        match kind {
            WorkspaceKind::Constant { phi } => self.allows(at, *phi),
            WorkspaceKind::Maximal => !self.orientations(at).is_empty(),
            WorkspaceKind::Inclusive(range) => !self.orientations(at).intersect(&range.set()).is_empty(),
            WorkspaceKind::Total(range) if range.is_full() => self.allows_all(at, None),
            WorkspaceKind::Total(range) => self.allows_all(at, Some(range)),
            WorkspaceKind::Dextrous => self.allows_all(at, None),
        }
    }

    fn allows_all(&self, at: Vector2<f64>, range: Option<&PhiRange>) -> bool {
        let (sweep, tol) = (Sweep::new(range), TOUCH * self.size);
        self.legs.iter().all(|leg| leg.allows_all(at, &sweep, tol, self.size))
    }

    /// Whether every leg allows the pose (C, phi), phi in radians.
    pub fn allows(&self, at: Vector2<f64>, phi: f64) -> bool {
        let turn = direction(phi);
        self.legs.iter().all(|leg| leg.allows_pose(at, turn, TOUCH * self.size))
    }
}

/// Beyond so many of its own lengths from the origin a mechanism is far away (heuristic: nearer, moving it gains less than three bits of its places).
const FAR: f64 = 4.0;

/// What misses a limit by less than this many of the mechanism's largest length meets it (error bound: the places of pivots
/// and their distances take some ten roundings of that length).
pub(super) const TOUCH: f64 = 16.0 * f64::EPSILON;

impl LegReach {
    /// Its largest length.
    fn largest(&self) -> f64 {
        let own = match self.chain {
            Chain::Rpr { offset } => offset.abs(),
            Chain::Rrr { l1, l2 } => l1 + l2,
            Chain::Prr { l, .. } => l,
        };
        let reach = self.furthest();
        own.max(self.b.norm()).max(if reach.is_finite() { reach } else { 0.0 })
    }

    /// Whether the leg allows the reference point at a place, the platform turned by a unit vector.
    pub(super) fn allows_pose(&self, at: Vector2<f64>, turn: Vector2<f64>, tol: f64) -> bool {
        self.allows(at + crate::plane::product(turn, self.b), turn, tol)
    }

    pub(super) fn orientations(&self, at: Vector2<f64>, tol: f64) -> AngleSet {
        if let Some([low, high]) = self.ring {
            return self.ring_orientations(low, high, at, tol);
        }
        let mut ends: Vec<f64> = self.limits.iter().flat_map(|limit| limit.orientations_at(at, tol)).collect();
        /// Ends nearer than this (radians; some roundings of an angle) are one orientation.
        const SEAM: f64 = 2e-15;
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|later, earlier| *later - *earlier <= SEAM);
        let Some(&first) = ends.first() else {
            return if self.allows_pose(at, direction(0.0), tol) { AngleSet::full() } else { AngleSet::empty() };
        };
        // From one end to the next the leg allows all or nothing; across pi in two pieces that share the verdict.
        let mut pieces: Vec<[f64; 2]> = Vec::with_capacity(ends.len() + 1);
        let last = ends[ends.len() - 1];
        let outer = self.allows_pose(at, direction(0.5 * (last + first + TAU)), tol);
        if outer {
            pieces.push([-PI, first]);
        }
        for (k, &from) in ends.iter().enumerate() {
            let to = ends.get(k + 1).copied();
            let beyond = to.map_or(outer, |to| self.allows_pose(at, direction(0.5 * (from + to)), tol));
            if beyond {
                pieces.push([from, to.unwrap_or(PI)]);
            } else if pieces.last().is_none_or(|last| last[1] < from) && self.allows_pose(at, direction(from), tol) {
                pieces.push([from, from]);
            }
        }
        AngleSet::from_pieces(pieces)
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
        let outer = if (d - arm).abs() >= low { PI } else { psi(low) };
        if inner == 0.0 {
            return AngleSet::arc(middle - outer, 2.0 * outer);
        }
        if outer == PI {
            return AngleSet::arc(middle + inner, TAU - 2.0 * inner);
        }
        AngleSet::arc(middle + inner, outer - inner).union(&AngleSet::arc(middle - outer, outer - inner))
    }
}
