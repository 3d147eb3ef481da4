//! The constant-orientation workspace, and the entry to all kinds.

use nalgebra::Vector2;

use super::arrangement::{Bound, Plan};
use super::leg::Chain;
use super::limits::{WorkspaceError, WorkspaceModes};
use super::reach::Reach;
use super::region::{Region, Workspace, WorkspaceKind};
use crate::manipulator::Manipulator;
use crate::plane::direction;

impl Manipulator {
    /// A workspace of the reference point, as exact loops of arcs.
    ///
    /// **Units and frame**: lengths of the model, base frame; radians. **Accuracy**: vertices to some tens of roundings of the largest length, area and
    /// perimeter accordingly. **Source**: [`crate::workspace`].
    ///
    /// # Errors
    /// See [`Manipulator::reach`] and [`Reach::workspace`].
    ///
    /// ```
    /// use assur::{Leg, Manipulator, workspace::{WorkspaceKind, WorkspaceModes}};
    /// let legs = [[0.0, 0.0], [20.0, 0.0], [0.0, 10.0]].map(|a| {
    ///     Leg { limits: [None, Some([0.0, 15.0]), None], ..Leg::rpr(a, [0.0, 0.0]) }
    /// });
    /// let robot = Manipulator::new("three discs", legs.to_vec())?;
    /// let place = robot.workspace(&WorkspaceKind::Constant { phi: 0.0 }, &WorkspaceModes::Both)?;
    /// assert_eq!((place.region.components, place.region.holes), (1, 0));
    /// assert_eq!(place.region.loops[0].arcs[0].active[0].to_string(), "leg 1 max");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn workspace(&self, kind: &WorkspaceKind, modes: &WorkspaceModes) -> Result<Workspace, WorkspaceError> {
        self.reach(modes)?.workspace(kind)
    }
}

impl Reach {
    /// A workspace of the reference point; see [`Manipulator::workspace`].
    ///
    /// # Errors
    /// Numbers of the kind that are not finite, a negative width; no leg whose limits bound it.
    pub fn workspace(&self, kind: &WorkspaceKind) -> Result<Workspace, WorkspaceError> {
        kind.validate()?;
        self.window()?;
        let region = match kind {
            WorkspaceKind::Constant { phi } => self.constant(*phi),
            WorkspaceKind::Total(range) => self.total(Some(range)),
            WorkspaceKind::Dextrous => self.total(None),
            WorkspaceKind::Inclusive(range) if range.width == 0.0 => self.constant(range.from),
            WorkspaceKind::Inclusive(range) => return Ok(self.folded(kind, Some(range))),
            WorkspaceKind::Maximal => return Ok(self.folded(kind, None)),
        };
        Ok(Workspace { kind: *kind, region, separating: Vec::new() })
    }

    /// A disc that no workspace leaves.
    pub(super) fn window(&self) -> Result<(Vector2<f64>, f64), WorkspaceError> {
        let discs = self.legs.iter().map(|leg| (leg.a, leg.furthest() + leg.b.norm()));
        let smallest = discs.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|disc| disc.1.is_finite());
        smallest.ok_or_else(|| {
            let joint = match self.legs[0].chain {
                Chain::Prr { .. } => 1,
                _ => 2,
            };
            WorkspaceError::Unbounded { leg: 1, joint }
        })
    }

    pub(super) fn constant(&self, phi: f64) -> Region {
        let turn = direction(phi);
        // Legs by their places here: a reach of one leg alone keeps that leg's number in its limits.
        let numbered = self.legs.iter().enumerate().flat_map(|(k, leg)| leg.limits.iter().map(move |limit| (k, limit)));
        let bounds: Vec<Bound> = numbered
            .map(|(leg, limit)| Bound {
                carrier: limit.at_orientation(turn),
                leg,
                active: [limit.active()].into_iter().collect(),
            })
            .collect();
        let admits = |leg: usize, p: Vector2<f64>, tol: f64| self.legs[leg].allows_pose(p, turn, tol);
        Plan { bounds: &bounds, legs: self.legs.len(), admits: &admits, size: self.size }.region()
    }
}
