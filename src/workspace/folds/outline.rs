//! From candidate curves to the outline of the maximal and inclusive workspaces.
//!
//! 1. Each candidate, divided where anything about it can change, leaves the pieces along which an interval of orientations vanishes (the fold rule).
//! 2. Those are divided further where they cross each other.
//! 3. Each piece is decided by the exact set of orientations on both its sides: empty outside and not inside, it is boundary; not empty on both, another way of
//!    reaching the places covers it, and it is kept as a separating arc.

use std::collections::HashSet;

use nalgebra::Vector2;

use super::super::boundary::{ArcCurve, BoundaryArc};
use super::super::limits::{ActiveLimit, Limit};
use super::super::reach::Reach;
use super::super::region::{Isolated, JoinedArc, Region, Workspace, WorkspaceKind};
use super::arc::CouplerArc;
use super::closing::{balance, drop_dead_ends, join};
use super::coupled::EDGE;
use super::crossings::{Chord, Common, chords, meet, nearest};
use super::curves::{AROUND, Course, Curves, Source, active_of, outside};
use super::edges;
use super::every::{self, Named};
use super::surface::{Form, Place, Slope, quarter};
use crate::linkage::Dyad;
use crate::plane::{Carrier, Meeting, PhiRange, direction, principal, product};

type Point = Vector2<f64>;

/// A limit missed by less than this share of the mechanism's length is met by a pose that lies on it (error bound: a pose's own roundings, some thousand at most).
const VALID: f64 = 1e-11;
/// Both sides of a piece are asked so far beside it, as a share of the mechanism's length: first just above roundings, since what bounds may be no further from what does
/// not, then further where roundings hide it.
const BESIDE: [f64; 4] = [1e-12, 1e-11, 1e-10, 1e-9];
/// Vertices nearer than this share of the mechanism's length are one.
pub(super) const SAME_VERTEX: f64 = 1e-10;
/// Curves that stay together over this share of the mechanism's length, or less, touch: between them is less than the square of it.
pub(super) const TOUCHING: f64 = 1e-6;
/// The normals of two limits of one leg are opposite below this (error bound: where modes merge they are opposite to roundings, else far from it).
const CUSP: f64 = 1e-7;
/// Curves with contact of the third order, as symmetric mechanisms have, stay closer than sides can tell over a piece this long, as a share of the mechanism's length.
const HIGH_CONTACT: f64 = 1e-3;
/// An orientation this far outside its range, in radians, is at its end.
const PHI_SLACK: f64 = 1e-12;
/// Where along a piece it is looked at: first in the middle.
const LOOKS: [f64; 5] = [0.5, 0.31, 0.67, 0.12, 0.86];

/// Part of a curve between two vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub(super) curve: usize,
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) start: usize,
    pub(super) end: usize,
}

impl Piece {
    pub(super) fn part(&self, part: f64) -> f64 {
        self.from + part * (self.to - self.from)
    }
}

/// What a piece is where it was looked at.
#[derive(Clone, Debug)]
pub(super) struct Look {
    pub(super) at: Point,
    /// The orientation that vanishes; `None` where no orientation enters.
    pub(super) phi: Option<f64>,
    /// Away from the places at which the orientation is allowed.
    pub(super) outward: Point,
    /// Whether it may as well be the other way.
    pub(super) either: bool,
    pub(super) active: Vec<ActiveLimit>,
    /// The limits held, of a coupled curve.
    pub(super) pair: Option<[Limit; 2]>,
}

/// What a piece of curve is to the workspace.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Standing {
    /// The workspace is on one side; `true`: on the left of the piece as it runs.
    Boundary(bool),
    /// Places on both sides are reached; `true`: the orientation that vanishes does so to the right.
    Separating(bool),
    /// Only the piece itself is reached.
    Isolated,
    /// No orientation vanishes here.
    Nothing,
    /// The sides say neither.
    Undecided,
}

/// The outline of a workspace: pieces with vertices.
#[derive(Debug, Default)]
pub(super) struct Outline {
    /// The workspace on the left.
    pub(super) boundary: Vec<JoinedArc>,
    pub(super) separating: Vec<BoundaryArc>,
    pub(super) isolated: Vec<BoundaryArc>,
    pub(super) points: Vec<Isolated>,
    /// Pieces whose sides said neither.
    pub(super) undecided: Vec<BoundaryArc>,
}

impl Outline {
    /// The workspace it bounds.
    pub(super) fn workspace(self, kind: &WorkspaceKind) -> Workspace {
        let isolated = self.isolated.into_iter().map(Isolated::Curve).chain(self.points).collect();
        let mut region = Region::from_arcs(self.boundary, isolated);
        region.unclosed.extend(self.undecided);
        Workspace { kind: *kind, region, separating: self.separating }
    }
}

/// Whether some orientation is left at a place.
pub(super) type Reached<'a> = dyn Fn(Point) -> bool + 'a;

/// The outline of the places at which some orientation of a range (or any) is allowed.
pub(super) fn outline(reach: &Reach, range: Option<&PhiRange>) -> Outline {
    let allowed = range.map(PhiRange::set);
    let reached = |at: Point| {
        let set = reach.orientations(at);
        match &allowed {
            Some(range) => !set.intersect(range).is_empty(),
            None => !set.is_empty(),
        }
    };
    let mut tracer = Tracer::new(reach, range);
    tracer.cross();
    tracer.outline(&reached)
}

/// The outline of those places of the maximal workspace that are `reached`.
pub(super) fn outline_where(reach: &Reach, reached: &Reached<'_>) -> Outline {
    let mut tracer = Tracer::new(reach, None);
    tracer.cross();
    tracer.partial = true;
    tracer.outline(reached)
}

/// The work in progress.
pub(super) struct Tracer<'a> {
    pub(super) reach: &'a Reach,
    pub(super) range: Option<PhiRange>,
    pub(super) curves: Curves,
    /// Pieces along which an orientation vanishes.
    pub(super) folds: Vec<Piece>,
    /// Whether only some of the places reached are asked for: what bounds others is nothing then.
    partial: bool,
    /// What candidates are called whose sides alone decide; empty where the fold rule does.
    named: Vec<Named>,
    pub(super) size: f64,
}

impl<'a> Tracer<'a> {
    /// Candidates that the fold rule has no part in.
    pub(super) fn of_candidates(reach: &'a Reach, curves: Curves, named: Vec<Named>) -> Self {
        let mut out = Self { reach, range: None, curves, folds: Vec::new(), partial: false, named, size: reach.size() };
        out.merge_vertices();
        for curve in (0..out.curves.curves.len()).filter(|&curve| !out.named[curve].double).collect::<Vec<_>>() {
            let pieces = out.pieces(curve);
            out.folds.extend(pieces);
        }
        out
    }

    pub(super) fn new(reach: &'a Reach, range: Option<&PhiRange>) -> Self {
        let range = range.filter(|range| !range.is_full());
        let mut out = Self {
            reach,
            range: range.copied(),
            curves: Curves::new(reach, range),
            folds: Vec::new(),
            partial: false,
            named: Vec::new(),
            size: reach.size(),
        };
        out.merge_vertices();
        for curve in 0..out.curves.curves.len() {
            for piece in out.pieces(curve) {
                if out.look(&piece, LOOKS[0]).is_some() {
                    out.folds.push(piece);
                }
            }
        }
        out
    }

    /// Gives vertices at the same place one number.
    fn merge_vertices(&mut self) {
        let vertices = &mut self.curves.vertices;
        let tol = SAME_VERTEX * self.size;
        let mut order: Vec<usize> = (0..vertices.len()).collect();
        order.sort_by(|&i, &j| vertices[i].x.total_cmp(&vertices[j].x));
        let mut first: Vec<usize> = (0..vertices.len()).collect();
        fn root(first: &mut [usize], mut i: usize) -> usize {
            while first[i] != i {
                first[i] = first[first[i]];
                i = first[i];
            }
            i
        }
        for (k, &i) in order.iter().enumerate() {
            for &j in &order[k + 1..] {
                if vertices[j].x - vertices[i].x > tol {
                    break;
                }
                if (vertices[j] - vertices[i]).norm() <= tol {
                    let (a, b) = (root(&mut first, i), root(&mut first, j));
                    first[a.max(b)] = a.min(b);
                }
            }
        }
        for curve in &mut self.curves.curves {
            for mark in &mut curve.marks {
                mark.1 = root(&mut first, mark.1);
            }
        }
        for piece in &mut self.folds {
            piece.start = root(&mut first, piece.start);
            piece.end = root(&mut first, piece.end);
        }
    }

    /// A curve's pieces between its marks.
    pub(super) fn pieces(&mut self, curve: usize) -> Vec<Piece> {
        let ([low, high], closed) = self.curves.span(curve);
        let mut marks = self.curves.curves[curve].marks.clone();
        if !closed {
            for t in [low, high] {
                if !marks.iter().any(|mark| mark.0 == t) {
                    let at = self.curves.at(curve, t).at;
                    self.curves.vertices.push(at);
                    marks.push((t, self.curves.vertices.len() - 1));
                }
            }
        } else if marks.is_empty() {
            let at = self.curves.at(curve, low).at;
            self.curves.vertices.push(at);
            marks.push((low, self.curves.vertices.len() - 1));
        }
        marks.retain(|mark| mark.0.is_finite() && mark.0 >= low - 1.0 && mark.0 <= high + 1.0);
        marks.sort_by(|a, b| a.0.total_cmp(&b.0));
        if closed {
            let (t, vertex) = marks[0];
            marks.push((t + AROUND, vertex));
        }
        let pieces = marks.windows(2).map(|pair| Piece {
            curve,
            from: pair[0].0,
            to: pair[1].0,
            start: pair[0].1,
            end: pair[1].1,
        });
        pieces.filter(|piece| self.has_length(piece)).collect()
    }

    /// Whether a piece is more than its vertex.
    fn has_length(&self, piece: &Piece) -> bool {
        if piece.to <= piece.from {
            return false;
        }
        if piece.start != piece.end {
            return true;
        }
        let vertex = self.curves.vertices[piece.start];
        [0.25, 0.5, 0.75].iter().any(|&part| {
            (self.curves.at(piece.curve, piece.part(part)).at - vertex).norm() > 4.0 * SAME_VERTEX * self.size
        })
    }

    /// What vanishes at a part of a piece; `None` where the limits are no bounds there or do not close in on an orientation.
    pub(super) fn look(&self, piece: &Piece, part: f64) -> Option<Look> {
        let t = match self.curves.curves[piece.curve].course {
            Course::Coupled { .. } => piece.part(part).clamp(EDGE, 1.0 - EDGE),
            _ => piece.part(part),
        };
        if !self.named.is_empty() {
            return every::look(&self.curves, &self.named, piece.curve, t);
        }
        let point = self.curves.at(piece.curve, t);
        let at = point.at;
        let tol = VALID * self.size;
        let (source, generators) = match self.curves.curves[piece.curve].course {
            Course::Upright { surface, on } => {
                let limit = self.curves.surfaces[surface].limits[0];
                let outward = on.normal(at) * sense_on(&limit, &on);
                return Some(Look { at, phi: None, outward, either: true, active: vec![limit.active()], pair: None });
            }
            Course::Motion { source, generators, .. } => (source, generators),
            Course::Coupled { coupled, .. } => (Source::Pair, self.curves.coupled[coupled].1),
        };
        let (turn, phi) = point.turn?;
        let place = Place { c: at, turn };
        if let (Some(range), false) = (&self.range, matches!(source, Source::PhiEnd(_)))
            && outside(range, phi) > PHI_SLACK
        {
            return None;
        }
        let surfaces = generators.map(|g| &self.curves.surfaces[g]);
        if source == Source::Pair && surfaces.iter().any(|surface| surface.upright) {
            return None;
        }
        // Signs first: they are cheaper than validity.
        let slopes: [Slope; 2] = surfaces.map(|surface| surface.form.slope(&place));
        let closes = |one: &Limit, other: &Limit| match source {
            Source::Stationary => one.sense * bend(&surfaces[0].form, &place) > 0.0,
            Source::PhiEnd(false) => one.sense * slopes[0].by_phi >= 0.0,
            Source::PhiEnd(true) => one.sense * slopes[0].by_phi <= 0.0,
            Source::Pair => one.sense * slopes[0].by_phi * other.sense * slopes[1].by_phi < 0.0,
        };
        let legs = surfaces.map(|surface| self.reach.leg_of(surface.leg));
        let bounds = |k: usize, limit: &Limit| edges::bounds(legs[k], limit, at, turn, tol);
        let mut found = None;
        'search: for one in &surfaces[0].limits {
            for other in &surfaces[1].limits {
                let single = source != Source::Pair;
                if single && one != other {
                    continue;
                }
                let same_leg = one.leg == other.leg;
                if !single && same_leg && one.mode.is_some() && other.mode.is_some() && one.mode != other.mode {
                    continue;
                }
                let valid = || {
                    if !single && same_leg {
                        return edges::holds(legs[0], [one, other], at, turn, tol);
                    }
                    bounds(0, one) && (single || bounds(1, other))
                };
                if closes(one, other) && valid() {
                    found = Some((*one, *other));
                    break 'search;
                }
            }
        }
        let (one, other) = found?;
        for (k, leg) in self.reach.legs.iter().enumerate() {
            if k != one.leg && k != other.leg && !leg.allows_pose(at, turn, tol) {
                return None;
            }
        }
        let (n1, n2) = (slopes[0].gradient * one.sense, slopes[1].gradient * other.sense);
        if source == Source::Pair {
            let outward = n1 * slopes[1].by_phi.abs() + n2 * slopes[0].by_phi.abs();
            let weight = slopes[0].by_phi.abs() + slopes[1].by_phi.abs();
            // Limits of one leg that touch in a cusp: the way out is across the curve, on the side the cusp does not open to.
            let either = one.leg == other.leg && outward.norm() <= CUSP * weight;
            let outward = if either { quarter(point.velocity) } else { outward }.try_normalize(0.0)?;
            let coupled = matches!(self.curves.curves[piece.curve].course, Course::Coupled { .. });
            let active = active_of(&[&one, &other], Some(source));
            Some(Look { at, phi: Some(phi), outward, either, active, pair: coupled.then_some([one, other]) })
        } else {
            let active = active_of(&[&one], Some(source));
            Some(Look { at, phi: Some(phi), outward: n1, either: false, active, pair: None })
        }
    }

    /// Divides the folds where they cross each other.
    pub(super) fn cross(&mut self) {
        let folds = std::mem::take(&mut self.folds);
        let mut marks: Vec<Vec<(f64, usize)>> =
            folds.iter().map(|piece| vec![(piece.from, piece.start), (piece.to, piece.end)]).collect();
        let mut vertices = std::mem::take(&mut self.curves.vertices);
        let tol = TOUCHING * self.size;
        let near = SAME_VERTEX * self.size;
        let carriers: Vec<Option<Carrier>> = folds.iter().map(|piece| self.carrier(piece.curve)).collect();
        let divided: Vec<Vec<Chord>> =
            folds.iter().map(|piece| chords(&|t| self.eval(piece.curve, t), piece.from, piece.to)).collect();
        let boxes: Vec<[Point; 2]> = divided.iter().map(|chords| Chord::around(chords)).collect();
        let mut order: Vec<usize> = (0..folds.len()).collect();
        order.sort_by(|&i, &j| boxes[i][0].x.total_cmp(&boxes[j][0].x));
        let mut overlaps: Vec<[usize; 2]> = Vec::new();
        for (k, &i) in order.iter().enumerate() {
            for &j in &order[k..] {
                if boxes[j][0].x > boxes[i][1].x {
                    break;
                }
                if boxes[j][0].y > boxes[i][1].y || boxes[i][0].y > boxes[j][1].y {
                    continue;
                }
                let (one, other) = (&folds[i], &folds[j]);
                if i == j && carriers[i].is_some() {
                    continue;
                }
                let evals: [&dyn Fn(f64) -> (Point, Point); 2] =
                    [&|t| self.eval(one.curve, t), &|t| self.eval(other.curve, t)];
                let mut shared: Vec<Point> = [one.start, one.end]
                    .into_iter()
                    .filter(|v| [other.start, other.end].contains(v))
                    .map(|v| vertices[v])
                    .collect();
                // A piece may end on another, where chords at a turning point of the parameter meet no longer.
                if i != j {
                    for (from, to) in [(i, j), (j, i)] {
                        let piece = &folds[to];
                        let ends = [folds[from].start, folds[from].end];
                        for vertex in ends.into_iter().filter(|v| ![piece.start, piece.end].contains(v)) {
                            let at = vertices[vertex];
                            let eval = |t: f64| self.eval(piece.curve, t);
                            let mut beside = divided[to].iter().filter(|chord| chord.reaches(at, near));
                            let found = beside.find_map(|chord| {
                                let t = nearest(&eval, at, chord.from, chord.to);
                                ((eval(t).0 - at).norm() <= near).then_some(t)
                            });
                            if let Some(t) = found {
                                marks[to].push((t, vertex));
                                shared.push(at);
                            }
                        }
                    }
                }
                let mut common = Common::default();
                if let (Some(a), Some(b)) = (carriers[i], carriers[j]) {
                    match a.meet(&b, near) {
                        Meeting::Same => common.overlap = true,
                        Meeting::Points(points) => {
                            for point in points {
                                let at = [(a, one), (b, other)].map(|(on, piece)| within(&on, piece, point));
                                if let [Some(s), Some(t)] = at {
                                    common.crossings.push([s, t]);
                                }
                            }
                        }
                    }
                } else {
                    for (m, a) in divided[i].iter().enumerate() {
                        for (n, b) in divided[j].iter().enumerate() {
                            // Pieces of one curve next to each other meet only at their common end.
                            if i == j && n < m + 2 {
                                continue;
                            }
                            let mut found = Common::default();
                            meet(evals[0], evals[1], [a, b], &shared, tol, &mut found);
                            // Where they run along each other every place is a touch.
                            if found.overlap {
                                common.overlap = true;
                            } else {
                                common.crossings.extend(found.crossings);
                            }
                        }
                    }
                }
                for [s, t] in common.crossings {
                    let at = evals[0](s).0;
                    if shared.iter().any(|p| (p - at).norm() <= 10.0 * near) {
                        continue;
                    }
                    vertices.push(at);
                    marks[i].push((s, vertices.len() - 1));
                    marks[j].push((t, vertices.len() - 1));
                }
                if common.overlap {
                    overlaps.push([i, j]);
                }
            }
        }
        // Curves that run along each other are divided at the same places: twice, as the second may bring places to a third.
        for _ in 0..2 {
            for &[i, j] in &overlaps {
                for (own, to) in [(i, j), (j, i)] {
                    let piece = &folds[to];
                    let eval = |t: f64| self.eval(piece.curve, t);
                    for (_, vertex) in marks[own].clone() {
                        if marks[to].iter().any(|mark| mark.1 == vertex) {
                            continue;
                        }
                        let at = vertices[vertex];
                        let onto = divided[to].iter().map(|chord| nearest(&eval, at, chord.from, chord.to));
                        if let Some(t) = onto.into_iter().find(|&t| (eval(t).0 - at).norm() <= 10.0 * near) {
                            marks[to].push((t, vertex));
                        }
                    }
                }
            }
        }
        self.curves.vertices = vertices;
        for (piece, mut marks) in folds.iter().zip(marks) {
            marks.sort_by(|a, b| a.0.total_cmp(&b.0));
            for pair in marks.windows(2) {
                let [(from, start), (to, end)] = [pair[0], pair[1]];
                self.folds.push(Piece { curve: piece.curve, from, to, start, end });
            }
        }
        self.merge_vertices();
        let kept = std::mem::take(&mut self.folds).into_iter().filter(|piece| self.has_length(piece)).collect();
        self.folds = kept;
    }

    fn carrier(&self, curve: usize) -> Option<Carrier> {
        match self.curves.curves[curve].course {
            Course::Motion { motion, .. } => Some(motion.carrier()),
            Course::Upright { on, .. } => Some(on),
            Course::Coupled { .. } => None,
        }
    }

    pub(super) fn eval(&self, curve: usize, t: f64) -> (Point, Point) {
        let t = match self.curves.curves[curve].course {
            Course::Coupled { .. } => t.clamp(EDGE, 1.0 - EDGE),
            _ => t,
        };
        let point = self.curves.at(curve, t);
        (point.at, point.velocity)
    }

    /// What a piece is to the places `reached`, with the look that told.
    pub(super) fn standing(&self, piece: &Piece, reached: &Reached<'_>) -> (Standing, Option<Look>) {
        let mut last = None;
        // Whether no place beside the piece was ever reached: then the pose that it holds is all there is.
        let mut alone = true;
        for part in LOOKS {
            let Some(look) = self.look(piece, part) else { continue };
            let t = piece.part(part);
            let left = quarter(self.eval(piece.curve, t).1);
            let mut covered = false;
            for distance in BESIDE {
                let aside = look.outward * (distance * self.size);
                let (inside, outside) = (reached(look.at - aside), reached(look.at + aside));
                alone &= !inside && !outside;
                let on_left = left.dot(&look.outward) < 0.0;
                match (inside, outside) {
                    (true, false) => return (Standing::Boundary(on_left), Some(look)),
                    // Where every orientation is asked for, the tolerance of membership hides a gap that just opens.
                    (true, true) if !self.named.is_empty() => covered = true,
                    (true, true) => return (Standing::Separating(on_left), Some(look)),
                    (false, true) if look.either => return (Standing::Boundary(!on_left), Some(look)),
                    (false, false) if look.phi.is_none() => {
                        let standing = if reached(look.at) { Standing::Isolated } else { Standing::Nothing };
                        return (standing, Some(look));
                    }
                    _ => {}
                }
            }
            if covered {
                return (Standing::Separating(false), Some(look));
            }
            last = Some(look);
        }
        let standing = match last {
            Some(_) if !self.partial && alone => Standing::Isolated,
            Some(_) if !self.partial => Standing::Undecided,
            _ => Standing::Nothing,
        };
        (standing, last)
    }

    /// The outline with respect to the places `reached`.
    pub(super) fn outline(&self, reached: &Reached<'_>) -> Outline {
        let mut out = Outline::default();
        let mut boundary: Vec<(Piece, bool, Look)> = Vec::new();
        let mut undecided: Vec<(Piece, bool, Look)> = Vec::new();
        let mut isolated: Vec<(Piece, bool, Look)> = Vec::new();
        for piece in &self.folds {
            let (standing, look) = self.standing(piece, reached);
            let Some(look) = look else { continue };
            match standing {
                Standing::Boundary(on_left) => boundary.push((*piece, on_left, look)),
                Standing::Separating(_) if !self.named.is_empty() => {}
                Standing::Separating(on_left) => out.separating.push(self.arc(piece, on_left, &look)),
                Standing::Isolated => isolated.push((*piece, true, look)),
                Standing::Nothing => {}
                Standing::Undecided => undecided.push((*piece, true, look)),
            }
        }
        self.drop_doubles(&mut boundary);
        self.prune(&mut boundary);
        self.bridge(&mut boundary);
        // What runs along a boundary adds nothing to it.
        undecided.retain(|open| !boundary.iter().any(|other| self.along(&open.0, &other.0)));
        isolated.retain(|open| !boundary.iter().any(|other| self.lies_on(&open.0, &other.0)));
        // Next to where curves of the boundary touch, roundings leave shreds.
        let bounding: HashSet<usize> = boundary.iter().flat_map(|(piece, ..)| [piece.start, piece.end]).collect();
        isolated.retain(|(piece, ..)| {
            let short = self.extent(piece) <= TOUCHING * self.size;
            !(short && [piece.start, piece.end].iter().any(|end| bounding.contains(end)))
        });
        self.drop_covered(&mut isolated);
        // Nor do, if all loops close without them, those that no loop of their own could take in, nor short ones where curves touch to a high order.
        if balance(&boundary).values().all(|&sum| sum == 0) {
            undecided.retain(|(piece, _, _)| self.extent(piece) > HIGH_CONTACT * self.size);
            self.drop_covered(&mut undecided);
            drop_dead_ends(&mut undecided);
        }
        out.undecided = undecided.iter().map(|(piece, on_left, look)| self.arc(piece, *on_left, look)).collect();
        if !self.partial {
            out.points = self.points(&boundary, &isolated, reached);
        }
        join(&mut isolated);
        out.isolated = isolated.iter().map(|(piece, on_left, look)| self.arc(piece, *on_left, look)).collect();
        join(&mut boundary);
        for (piece, on_left, look) in &boundary {
            let ends = if *on_left { [piece.start, piece.end] } else { [piece.end, piece.start] };
            let arc = self.arc(piece, *on_left, look);
            out.boundary.push(JoinedArc { arc, from: ends[0], to: ends[1], carrier: piece.curve });
        }
        out
    }

    /// Places with a pose at which limits leave no motion, and nothing reached around them.
    fn points(
        &self,
        boundary: &[(Piece, bool, Look)],
        isolated: &[(Piece, bool, Look)],
        reached: &Reached<'_>,
    ) -> Vec<Isolated> {
        /// Directions in which something around is sought, and how far off, as a share of the mechanism's length (heuristic: a piece of the
        /// workspace that ends in the place has it for an end of its boundary, which is asked for as well).
        const AROUND: u32 = 8;
        const OFF: f64 = 1e-7;
        let mut out: Vec<Isolated> = Vec::new();
        let vertices = &self.curves.vertices;
        let near = |at: &Point, p: Point| (p - at).norm() <= 4.0 * SAME_VERTEX * self.size;
        let within = |phi: Point| {
            let angle = phi.y.atan2(phi.x);
            self.range.is_none_or(|range| outside(&range, angle) <= PHI_SLACK)
        };
        for (place, surfaces) in &self.curves.poses {
            let at = place.c;
            let allowed = |leg: &super::super::leg::LegReach| leg.allows_pose(at, place.turn, VALID * self.size);
            if !within(place.turn) || !self.reach.legs.iter().all(allowed) {
                continue;
            }
            let mut ends = boundary.iter().chain(isolated).flat_map(|(piece, ..)| [piece.start, piece.end]);
            let on_curve = || isolated.iter().any(|(piece, ..)| self.passes(piece, at));
            let known = |part: &Isolated| matches!(part, Isolated::Point { at: p, .. } if near(&at, Point::from(*p)));
            let beside = |k: u32| {
                at + direction(0.3 + super::curves::AROUND * f64::from(k) / f64::from(AROUND)) * (OFF * self.size)
            };
            if ends.any(|end| near(&at, vertices[end]))
                || out.iter().any(known)
                || (0..AROUND).any(|k| reached(beside(k)))
                || on_curve()
            {
                continue;
            }
            let mut active: Vec<ActiveLimit> =
                surfaces.iter().map(|&s| self.curves.surfaces[s].limits[0].active()).collect();
            let phi = place.turn.y.atan2(place.turn.x);
            for (name, end) in
                self.range.iter().flat_map(|r| [(ActiveLimit::PhiFrom, r.from), (ActiveLimit::PhiTo, r.to())])
            {
                if principal(phi - end).abs() <= PHI_SLACK {
                    active.push(name);
                }
            }
            active.sort();
            active.dedup();
            out.push(Isolated::Point { at: at.into(), active });
        }
        out
    }

    /// A piece as a boundary arc, run so that the inside is on its left.
    fn arc(&self, piece: &Piece, on_left: bool, look: &Look) -> BoundaryArc {
        let ([from, to], [start, end]) = if on_left {
            ([piece.from, piece.to], [piece.start, piece.end])
        } else {
            ([piece.to, piece.from], [piece.end, piece.start])
        };
        let curve = match self.curves.curves[piece.curve].course {
            Course::Coupled { coupled, branch } => {
                let (curve, generators) = &self.curves.coupled[coupled];
                let pair = look.pair.unwrap_or_else(|| generators.map(|g| self.curves.surfaces[g].limits[0]));
                let arc = Box::new(CouplerArc::new(pair, *curve, branch, [from, to]));
                if pair.iter().all(|limit| matches!(limit.dyad, Dyad::PR { .. })) {
                    ArcCurve::Ellipse(arc)
                } else {
                    ArcCurve::Coupler(arc)
                }
            }
            _ => match self.carrier(piece.curve) {
                Some(Carrier::Circle { center, radius }) => {
                    ArcCurve::Circle { center: center.into(), radius, start_angle: from, end_angle: to }
                }
                _ => ArcCurve::Line,
            },
        };
        let [start, end] = [start, end].map(|vertex| self.curves.vertices[vertex].into());
        BoundaryArc { curve, start, end, active: look.active.clone() }
    }
}

/// The parameter of a point on a carrier's piece, if it lies on it.
fn within(on: &Carrier, piece: &Piece, point: Point) -> Option<f64> {
    let t = on.parameter(point);
    let t = match on {
        Carrier::Circle { .. } => piece.from + (t - piece.from).rem_euclid(AROUND),
        Carrier::Line { .. } => t,
    };
    (piece.from <= t && t <= piece.to).then_some(t)
}

/// The side of a carrier on which an upright limit does not allow its places: 1 where its normal points.
fn sense_on(limit: &Limit, on: &Carrier) -> f64 {
    let normal = on.normal(on.at(0.0));
    let gradient =
        Form::of(&limit.dyad).map_or(normal, |form| form.slope(&Place { c: on.at(0.0), turn: Point::x() }).gradient);
    limit.sense * normal.dot(&gradient).signum()
}

/// Second derivative by the orientation of a limit's value where the first vanishes, up to a positive factor.
pub(super) fn bend(form: &Form, place: &Place) -> f64 {
    match *form {
        // |B - a|² = d² + b² + 2 (C - a)·R b.
        Form::Circle { a, b, .. } => -(place.c - a).dot(&product(place.turn, b)),
        Form::Line { n, b, .. } => -n.dot(&product(place.turn, b)),
        Form::PlatformLine { k, .. } => -k,
    }
}
