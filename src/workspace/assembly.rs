//! **What can one assembly reach?** The connected parts of the configuration space, and the workspace of each.
//!
//! The places allowed at one orientation are a slice of the configuration space, and their pieces come exactly from the constant-orientation workspace. Between the
//! orientations at which three limits meet, two touch, or a leg's own change their order, slices keep their pieces; there a piece follows its like, and where pieces are joined is
//! told by places whose set of orientations reaches from one slice to the next. Working modes are slices of their own, joined where modes merge.
//! Every connection found is one: a place with an interval of orientations, or a piece of a slice. That none is missed rests on the list of those orientations.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use super::boundary::{ArcCurve, BoundaryArc};
use super::limits::{ActiveLimit, LimitCause, WorkspaceError};
use super::reach::Reach;
use super::region::{Region, Workspace, WorkspaceKind};
use crate::linkage::Pose;
use crate::plane::{AngleSet, direction};

type Point = Vector2<f64>;

/// Orientations of change nearer to each other than this, radians, are one: a slice between them would be thinner than what is told apart.
const SAME_TURN: f64 = 1e-9;
/// Slices beside an orientation of change are taken so far from it, radians; further away where digits run out nearer.
const BESIDE: [f64; 4] = [1e-7, 1e-6, 1e-5, 1e-4];
/// A piece is followed from slice to slice by at most so many slices between: a way halved towards one end takes some twenty.
const FOLLOW: usize = 40;
/// A place this near to a piece, as a share of the mechanism's length, may belong to it: places beside the boundary are asked for.
const NEAR: f64 = 1e-6;
/// Arcs of a piece from which places inside it are sought.
const SOUGHT: usize = 16;

/// A piece of a slice.
#[derive(Clone, Debug)]
struct Part {
    outer: Vec<BoundaryArc>,
    area: f64,
    /// Places inside.
    inside: Vec<Point>,
}

/// The places allowed at one orientation.
#[derive(Clone, Debug)]
struct Slice {
    phi: f64,
    parts: Vec<Part>,
    /// Arcs on which the modes of a leg merge: leg and a place on it.
    merging: Vec<(usize, Point)>,
    /// Whether all its loops close.
    closed: bool,
}

/// One choice of working modes.
struct Sheet {
    modes: Vec<bool>,
    reach: Reach,
    /// One slice between every two orientations of change.
    slices: Vec<Slice>,
    /// The number of each slice's first part.
    first: Vec<usize>,
}

/// The configuration space in connected parts.
struct Space {
    sheets: Vec<Sheet>,
    changes: Vec<f64>,
    parent: Vec<usize>,
    size: f64,
    /// An orientation at which slices could not be followed.
    undecided: Option<f64>,
}

impl Reach {
    /// The workspace of each assembly: what the platform can reach without being taken apart, largest first.
    ///
    /// Assemblies may overlap in the plane. Working modes change where they merge, as far as both are allowed. **Cost**: some hundred slices,
    /// tens of milliseconds to seconds for legs with two modes. **Accuracy**: as [`Reach::workspace`]; parts that meet in a neck thinner than 1e-7 of the mechanism's length may count as two.
    ///
    /// # Errors
    /// No leg whose limits bound the workspace; slices that cannot be followed from one to the next, where digits run out.
    ///
    /// ```
    /// use assur::{Leg, Manipulator, workspace::WorkspaceModes};
    /// let leg = |a, b, limits| Leg { limits: [None, Some(limits), None], ..Leg::rpr(a, b) };
    /// let robot = Manipulator::new("two assemblies", vec![
    ///     leg([0.0, 0.0], [25.0, 0.0], [11.5, 12.0]),
    ///     leg([20.0, 0.0], [12.5, 21.650635], [5.0, 15.0]),
    ///     leg([0.0, 10.0], [0.0, 0.0], [10.0, 17.0]),
    /// ])?;
    /// let assemblies = robot.reach(&WorkspaceModes::Both)?.assemblies()?;
    /// assert_eq!(assemblies.len(), 2);
    /// assert!((assemblies[0].region.area - 277.6546).abs() < 1e-3 && (assemblies[1].region.area - 94.0087).abs() < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn assemblies(&self) -> Result<Vec<Workspace>, WorkspaceError> {
        if let Some(middle) = self.far() {
            let near = self.moved(-middle);
            return Ok(near.assemblies()?.iter().map(|found| self.carried(&near, found, middle)).collect());
        }
        self.window()?;
        let space = Space::new(self);
        space.decided()?;
        let roots = space.roots();
        if roots.len() < 2 {
            return Ok(roots.iter().map(|_| self.folded(&WorkspaceKind::Maximal, None)).collect());
        }
        let mut out: Vec<Workspace> =
            roots.iter().map(|&root| self.folded_where(&|at| space.reached(at, &[root]))).collect();
        out.sort_by(|a, b| b.region.area.total_cmp(&a.region.area));
        Ok(out)
    }

    /// The maximal workspace of the assembly that has a pose, in whichever of its working modes the pose is allowed.
    ///
    /// The pose is the platform frame's. **Cost**, **accuracy**: as [`Reach::assemblies`].
    ///
    /// # Errors
    /// No leg whose limits bound the workspace; a pose that a leg does not allow, or that is not finite; slices that cannot be followed.
    pub fn assembly(&self, from: &Pose) -> Result<Workspace, WorkspaceError> {
        for (what, value) in [("x", from.x), ("y", from.y), ("phi", from.phi)] {
            if !value.is_finite() {
                return Err(WorkspaceError::NotFinite { what, value });
            }
        }
        if let Some(middle) = self.far() {
            let near = self.moved(-middle);
            let found = near.assembly(&Pose::new(from.x - middle.x, from.y - middle.y, from.phi))?;
            return Ok(self.carried(&near, &found, middle));
        }
        self.window()?;
        let at = from.place(self.legs[0].reference);
        let turn = direction(from.phi);
        for (leg, reach) in self.legs.iter().enumerate() {
            if !reach.allows_pose(at, turn, NEAR * NEAR * self.size) {
                return Err(WorkspaceError::PoseNotAllowed { leg: leg + 1 });
            }
        }
        let space = Space::new(self);
        space.decided()?;
        let wanted = space.roots_at(at, from.phi);
        if space.roots().iter().all(|root| wanted.contains(root)) {
            return Ok(self.folded(&WorkspaceKind::Maximal, None));
        }
        Ok(self.folded_where(&|at| space.reached(at, &wanted)))
    }

    /// The same legs, each in one working mode.
    fn in_modes(&self, modes: &[bool]) -> Self {
        let mut out = self.clone();
        for (leg, &plus) in out.legs.iter_mut().zip(modes) {
            // Where the distance of the pivots alone decides, the modes reach the same.
            if leg.ring.is_none() {
                *leg = leg.in_mode(plus);
            }
        }
        out
    }
}

impl Space {
    fn new(reach: &Reach) -> Self {
        let mut changes = reach.turning_points();
        changes.dedup_by(|later, earlier| *later - *earlier < SAME_TURN);
        if changes.is_empty() {
            changes.push(0.0);
        }
        let mut out = Self { sheets: Vec::new(), changes, parent: Vec::new(), size: reach.size(), undecided: None };
        for modes in choices(reach) {
            let reach = reach.in_modes(&modes);
            let slices: Vec<Slice> = (0..out.changes.len()).map(|k| slice(&reach, out.middle(k))).collect();
            let mut first = Vec::with_capacity(slices.len());
            for slice in &slices {
                if !slice.closed {
                    out.undecided = Some(slice.phi);
                }
                first.push(out.parent.len());
                out.parent.extend(out.parent.len()..out.parent.len() + slice.parts.len());
            }
            out.sheets.push(Sheet { modes, reach, slices, first });
        }
        out.join_modes();
        out.join_far();
        if out.roots().len() > 1 {
            out.join_near();
        }
        out
    }

    /// Where the interval after an orientation of change begins and how wide it is.
    fn interval(&self, k: usize) -> (f64, f64) {
        let from = self.changes[k];
        let to = self.changes.get(k + 1).copied().unwrap_or(self.changes[0] + TAU);
        (from, to - from)
    }

    fn middle(&self, k: usize) -> f64 {
        let (from, width) = self.interval(k);
        from + 0.5 * width
    }

    fn root(&self, mut node: usize) -> usize {
        while self.parent[node] != node {
            node = self.parent[node];
        }
        node
    }

    fn unite(&mut self, one: usize, other: usize) {
        let (a, b) = (self.root(one), self.root(other));
        self.parent[a.max(b)] = a.min(b);
    }

    /// One node of each connected part.
    fn roots(&self) -> Vec<usize> {
        (0..self.parent.len()).filter(|&node| self.parent[node] == node).collect()
    }

    /// Joins the slices of two choices of modes where those of a leg merge.
    fn join_modes(&mut self) {
        let mut pairs = Vec::new();
        for sheet in &self.sheets {
            for (k, slice) in sheet.slices.iter().enumerate() {
                for &(leg, at) in &slice.merging {
                    let mut modes = sheet.modes.clone();
                    modes[leg] = !modes[leg];
                    let Some(other) = self.sheets.iter().find(|other| other.modes == modes) else { continue };
                    if let (Some(i), Some(j)) = (self.part(slice, at), self.part(&other.slices[k], at)) {
                        pairs.push((sheet.first[k] + i, other.first[k] + j));
                    }
                }
            }
        }
        for (one, other) in pairs {
            self.unite(one, other);
        }
    }

    /// Joins neighbouring slices by places whose orientations reach from one to the other.
    fn join_far(&mut self) {
        let mut pairs = Vec::new();
        let count = self.changes.len();
        for sheet in &self.sheets {
            for k in 0..count {
                let next = (k + 1) % count;
                for (i, j) in self.links(&sheet.reach, &sheet.slices[k], &sheet.slices[next]) {
                    pairs.push((sheet.first[k] + i, sheet.first[next] + j));
                }
            }
        }
        for (one, other) in pairs {
            self.unite(one, other);
        }
    }

    /// Joins them close to the orientation of change between them.
    fn join_near(&mut self) {
        let mut pairs = Vec::new();
        let mut undecided = None;
        let count = self.changes.len();
        for sheet in &self.sheets {
            for k in 0..count {
                let next = (k + 1) % count;
                match self.passage(sheet, k, next) {
                    Some(found) => {
                        pairs.extend(found.into_iter().map(|(i, j)| (sheet.first[k] + i, sheet.first[next] + j)))
                    }
                    None => undecided = Some(self.changes[next]),
                }
            }
        }
        for (one, other) in pairs {
            self.unite(one, other);
        }
        self.undecided = self.undecided.or(undecided);
    }

    /// Which parts of a slice and of the next are joined at the orientation of change between them; `None` where one of them, seen just beside it, cannot be followed.
    fn passage(&self, sheet: &Sheet, k: usize, next: usize) -> Option<Vec<(usize, usize)>> {
        let at = self.changes[next];
        BESIDE.into_iter().find_map(|step| {
            let step = step.min(0.25 * self.interval(k).1).min(0.25 * self.interval(next).1);
            let [before, after] = [-step, step].map(|step| slice(&sheet.reach, at + step));
            let earlier = self.follow(&sheet.reach, &before, &sheet.slices[k], &mut { FOLLOW });
            let later = self.follow(&sheet.reach, &after, &sheet.slices[next], &mut { FOLLOW });
            // Parts too thin for a place inside them join nothing.
            let followed = |slice: &Slice, to: &[Option<usize>]| {
                slice.closed && slice.parts.iter().zip(to).all(|(part, to)| part.inside.is_empty() || to.is_some())
            };
            if !followed(&before, &earlier) || !followed(&after, &later) {
                return None;
            }
            let links = self.links(&sheet.reach, &before, &after).into_iter();
            Some(links.filter_map(|(i, j)| Some((earlier[i]?, later[j]?))).collect())
        })
    }

    /// # Errors
    /// Slices that could not be followed, and not all in one part.
    fn decided(&self) -> Result<(), WorkspaceError> {
        match self.undecided {
            Some(phi) if self.roots().len() != 1 => Err(WorkspaceError::AssembliesUndecided { phi }),
            _ => Ok(()),
        }
    }

    /// Pairs of parts of two slices that a place with an interval of orientations joins.
    fn links(&self, reach: &Reach, one: &Slice, other: &Slice) -> Vec<(usize, usize)> {
        let mut out = Vec::new();
        let turn = nearest_turn(one.phi, other.phi);
        for (i, part) in one.parts.iter().enumerate() {
            for &at in &part.inside {
                if spans(&reach.orientations(at), one.phi, turn) {
                    out.extend(self.part(other, at).map(|j| (i, j)));
                }
            }
        }
        for (j, part) in other.parts.iter().enumerate() {
            for &at in &part.inside {
                if spans(&reach.orientations(at), other.phi, -turn) {
                    out.extend(self.part(one, at).map(|i| (i, j)));
                }
            }
        }
        out.sort_unstable();
        out.dedup();
        out
    }

    /// The part of another slice that each part becomes, no change being between them.
    fn follow(&self, reach: &Reach, from: &Slice, to: &Slice, patience: &mut usize) -> Vec<Option<usize>> {
        let links = self.links(reach, from, to);
        let mut found = vec![None; from.parts.len()];
        for &(i, j) in &links {
            found[i] = Some(j);
        }
        let mut targets: Vec<usize> = links.iter().map(|link| link.1).collect();
        targets.sort_unstable();
        targets.dedup();
        // Parts too thin for a place inside them join nothing.
        let thick = |slice: &Slice| slice.parts.iter().filter(|part| !part.inside.is_empty()).count();
        let settled = links.len() == targets.len() && links.len() >= thick(from) && targets.len() >= thick(to);
        if settled || *patience == 0 {
            return found;
        }
        *patience -= 1;
        let middle = slice(reach, from.phi + 0.5 * nearest_turn(from.phi, to.phi));
        let near = self.follow(reach, from, &middle, patience);
        let far = self.follow(reach, &middle, to, patience);
        near.into_iter().map(|k| k.and_then(|k| far[k])).collect()
    }

    /// The part of a slice that a place belongs to, or lies beside.
    fn part(&self, slice: &Slice, at: Point) -> Option<usize> {
        let mut best: Option<(f64, usize)> = None;
        let mut inner: Option<(f64, usize)> = None;
        for (k, part) in slice.parts.iter().enumerate() {
            let (winding, near) = part
                .outer
                .iter()
                .map(|arc| swept(arc, at))
                .fold((0.0, f64::INFINITY), |sum, arc| (sum.0 + arc.0, f64::min(sum.1, arc.1)));
            if near <= NEAR * self.size && best.is_none_or(|best| near < best.0) {
                best = Some((near, k));
            }
            // Of nested parts the innermost.
            if winding > 0.5 * TAU && inner.is_none_or(|inner| part.area < inner.0) {
                inner = Some((part.area, k));
            }
        }
        inner.or(best).map(|found| found.1)
    }

    /// The connected parts that hold a pose, one for each choice of modes that allows it.
    fn roots_at(&self, at: Point, phi: f64) -> Vec<usize> {
        let mut out = Vec::new();
        for sheet in &self.sheets {
            let set = sheet.reach.orientations(at);
            let holds = |&&[from, to]: &&[f64; 2]| {
                let after = (phi - from).rem_euclid(TAU);
                after <= to - from + SAME_TURN || after >= TAU - SAME_TURN
            };
            if let Some(&interval) = set.intervals().iter().find(holds) {
                out.extend(self.root_of(sheet, at, interval));
            }
        }
        out
    }

    /// Whether a place is reached by one of the connected parts.
    fn reached(&self, at: Point, wanted: &[usize]) -> bool {
        self.sheets.iter().any(|sheet| {
            let set = sheet.reach.orientations(at);
            set.intervals()
                .iter()
                .any(|&interval| self.root_of(sheet, at, interval).is_some_and(|root| wanted.contains(&root)))
        })
    }

    /// The connected part of an interval of orientations at a place.
    fn root_of(&self, sheet: &Sheet, at: Point, [from, to]: [f64; 2]) -> Option<usize> {
        // A slice that the interval passes.
        for (k, slice) in sheet.slices.iter().enumerate() {
            if (slice.phi - from).rem_euclid(TAU) <= to - from
                && let Some(part) = self.part(slice, at)
            {
                return Some(self.root(sheet.first[k] + part));
            }
        }
        let phi = 0.5 * (from + to);
        let after = |k: &usize| (phi - self.changes[*k]).rem_euclid(TAU);
        let k = (0..self.changes.len()).min_by(|a, b| after(a).total_cmp(&after(b)))?;
        let own = slice(&sheet.reach, phi);
        let part = self.part(&own, at)?;
        let found = self.follow(&sheet.reach, &own, &sheet.slices[k], &mut { FOLLOW })[part]?;
        Some(self.root(sheet.first[k] + found))
    }
}

/// Every choice of one mode a leg, among those allowed; legs whose modes reach the same have one.
fn choices(reach: &Reach) -> Vec<Vec<bool>> {
    let mut out: Vec<Vec<bool>> = vec![Vec::new()];
    for leg in &reach.legs {
        let modes: Vec<bool> = [true, false].into_iter().filter(|&plus| leg.modes[usize::from(!plus)]).collect();
        let modes = if leg.ring.is_some() { modes.into_iter().take(1).collect() } else { modes };
        out = out
            .into_iter()
            .flat_map(|begun| modes.iter().map(move |&plus| [begun.as_slice(), &[plus]].concat()).collect::<Vec<_>>())
            .collect();
    }
    out
}

/// The turn from one orientation to another, the shorter way round.
fn nearest_turn(from: f64, to: f64) -> f64 {
    let turn = (to - from).rem_euclid(TAU);
    if turn > 0.5 * TAU { turn - TAU } else { turn }
}

/// Whether a set holds all orientations from one over a turn.
fn spans(set: &AngleSet, phi: f64, turn: f64) -> bool {
    set.is_full()
        || set.intervals().iter().any(|[from, to]| {
            let start = (phi - from).rem_euclid(TAU);
            start <= to - from && (0.0..=to - from).contains(&(start + turn))
        })
}

fn slice(reach: &Reach, phi: f64) -> Slice {
    let region = reach.constant(phi);
    let turn = direction(phi);
    let mut parts = Vec::new();
    for each in region.loops.iter().filter(|each| each.area > 0.0) {
        let reaches = each.area.sqrt();
        let step = each.arcs.len().div_ceil(SOUGHT);
        let mut inside = Vec::new();
        for arc in each.arcs.iter().step_by(step) {
            let middle = along(arc, 0.5);
            let tangent = along(arc, 0.5 + 1e-4) - along(arc, 0.5 - 1e-4);
            let Some(inward) = Point::new(-tangent.y, tangent.x).try_normalize(0.0) else { continue };
            // The deepest that is inside this loop and allowed.
            let depths = [0.4, 0.15, 0.05, 0.01, 1e-3, 1e-4, 1e-6].map(|depth| middle + inward * (depth * reaches));
            let fits = |at: &Point| {
                let winding: f64 = each.arcs.iter().map(|arc| swept(arc, *at).0).sum();
                winding > 0.5 * TAU && reach.allows_turned(*at, turn) && innermost(&region, *at, each.area)
            };
            inside.extend(depths.into_iter().find(fits));
        }
        parts.push(Part { outer: each.arcs.clone(), area: each.area, inside });
    }
    let arcs = region.loops.iter().flat_map(|each| &each.arcs);
    let merging = arcs.filter_map(|arc| {
        arc.active.iter().find_map(|active| match active {
                ActiveLimit::Leg {
                    leg,
                    cause:
                        LimitCause::Stretched
                        | LimitCause::Folded
                        | LimitCause::Left
                        | LimitCause::Right
                        | LimitCause::Shortest,
                } => Some((*leg, along(arc, 0.5))),
                _ => None,
            })
    });
    Slice { phi, merging: merging.collect(), parts, closed: region.unclosed.is_empty() }
}

/// Whether no smaller part around a place lies within the one of this area.
fn innermost(region: &Region, at: Point, area: f64) -> bool {
    let smaller = region.loops.iter().filter(|each| each.area > 0.0 && each.area < area);
    !smaller.into_iter().any(|each| each.arcs.iter().map(|arc| swept(arc, at).0).sum::<f64>() > 0.5 * TAU)
}

impl Reach {
    /// Whether every leg allows the reference point at a place, the platform turned by a unit vector.
    fn allows_turned(&self, at: Point, turn: Point) -> bool {
        self.legs.iter().all(|leg| leg.allows_pose(at, turn, 0.0))
    }
}

/// A point of a circle's or a line's arc, by the part of it.
fn along(arc: &BoundaryArc, part: f64) -> Point {
    match &arc.curve {
        ArcCurve::Circle { center, radius, start_angle, end_angle } => {
            let (sin, cos) = (start_angle + part * (end_angle - start_angle)).sin_cos();
            Point::from(*center) + Point::new(cos, sin) * *radius
        }
        _ => Point::from(arc.start).lerp(&Point::from(arc.end), part),
    }
}

/// The angle an arc sweeps seen from a place, radians, and how near it comes.
fn swept(arc: &BoundaryArc, from: Point) -> (f64, f64) {
    let turned = |p: Point, q: Point| p.perp(&q).atan2(p.dot(&q));
    let ends = [Point::from(arc.start) - from, Point::from(arc.end) - from];
    match &arc.curve {
        ArcCurve::Circle { center, radius, start_angle, end_angle } => {
            let c = Point::from(*center) - from;
            let off = c.norm();
            // Quarters of the arc turn by less than half a turn seen from anywhere off their segments; inside a segment the angle is the other way round.
            let mut sum = 0.0;
            let mut near = f64::INFINITY;
            const PARTS: usize = 8;
            let at = |k: usize| {
                let (sin, cos) = (start_angle + (end_angle - start_angle) * k as f64 / PARTS as f64).sin_cos();
                c + Point::new(cos, sin) * *radius
            };
            let side = (end_angle - start_angle).signum();
            for k in 0..PARTS {
                let (p, q) = (at(k), at(k + 1));
                near = near.min(p.norm()).min(q.norm());
                let mut angle = turned(p, q);
                // Between chord and arc: inside the circle and beyond the chord.
                let beyond = side * (q - p).perp(&-p) < 0.0;
                if off < *radius && beyond && angle * side < 0.0 {
                    angle += side * TAU;
                }
                sum += angle;
            }
            let toward = (-c.y).atan2(-c.x);
            let width = (end_angle - start_angle).abs();
            let after = (side * (toward - start_angle)).rem_euclid(TAU);
            if after <= width {
                near = near.min((off - radius).abs());
            }
            (sum, near)
        }
        _ => {
            let [p, q] = ends;
            let chord = q - p;
            let part =
                if chord.norm_squared() > 0.0 { (-p.dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0) } else { 0.0 };
            (turned(p, q), (p + chord * part).norm())
        }
    }
}
