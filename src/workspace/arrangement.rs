//! The region that circles and lines cut out of the plane, decided by exact membership.
//!
//! Every curve that may bound the region is given whole. They are cut where they meet; a piece is kept if membership differs between its
//! two sides, each tested nearer to the piece than any other curve passes, so that a verdict can only be wrong where two curves run closer
//! together than roundings. Pieces whose both sides are outside while they belong to the region are isolated curves; meeting points of no
//! kept piece that belong to it are isolated points. No sign rule is trusted.

use std::f64::consts::{PI, TAU};

use arrayvec::ArrayVec;
use nalgebra::Vector2;

use super::boundary::{ArcCurve, BoundaryArc};
use super::limits::ActiveLimit;
use super::region::{Isolated, JoinedArc, Region};
use crate::plane::{Carrier, Meeting};

/// A curve that may bound the region, and what bounds it there.
#[derive(Clone, Debug)]
pub(super) struct Bound {
    pub(super) carrier: Carrier,
    /// The leg it belongs to, from 0.
    pub(super) leg: usize,
    pub(super) active: ArrayVec<ActiveLimit, 2>,
}

/// What an arrangement is asked about.
pub(super) struct Plan<'a> {
    pub(super) bounds: &'a [Bound],
    pub(super) legs: usize,
    /// Whether a leg admits a place; bounds missed by the given length count as met.
    pub(super) admits: &'a dyn Fn(usize, Vector2<f64>, f64) -> bool,
    /// The mechanism's largest length.
    pub(super) size: f64,
}

/// Curves, meeting points and gaps nearer than this much of the size are one (error bound: centres, radii and meeting points carry some tens
/// of roundings of that length; a hundred times that leaves room for three curves through a point).
pub(super) const SAME: f64 = 1e-12;
/// A meeting point belongs to the region if its limits are missed by no more than this much of the size (heuristic, generous: where two working modes
/// merge, a joint moves as the square root of a rounding; points taken in vain only cut a piece in two).
const NEAR: f64 = 1e-7;

/// A curve with the places where it is cut.
struct Line {
    carrier: Carrier,
    bounds: ArrayVec<usize, 8>,
    /// (parameter, vertex)
    cuts: Vec<(f64, usize)>,
}

impl Plan<'_> {
    fn inside(&self, p: Vector2<f64>, tol: f64) -> bool {
        (0..self.legs).all(|leg| (self.admits)(leg, p, tol))
    }

    /// The region. Pieces that join no loop, which happens only where digits run out, are handed over as such.
    pub(super) fn region(&self) -> Region {
        let same = SAME * self.size;
        let mut lines: Vec<Line> = Vec::new();
        let mut vertices: Vec<Vector2<f64>> = Vec::new();
        for (k, bound) in self.bounds.iter().enumerate() {
            if let Carrier::Circle { center, radius } = bound.carrier
                && radius <= same
            {
                vertices.push(center);
                continue;
            }
            match lines.iter_mut().find(|line| line.carrier.meet(&bound.carrier, same) == Meeting::Same) {
                Some(line) => {
                    // More coincident curves than names are kept for add no boundary.
                    let _ = line.bounds.try_push(k);
                }
                None => lines.push(Line { carrier: bound.carrier, bounds: ArrayVec::from_iter([k]), cuts: Vec::new() }),
            }
        }
        // Zero radii are points of their own.
        let points = vertices.len();
        for (v, &p) in vertices.iter().enumerate() {
            for line in &mut lines {
                if line.carrier.distance(p).abs() <= same {
                    line.cuts.push((line.carrier.parameter(p), v));
                }
            }
        }
        for i in 1..lines.len() {
            for j in 0..i {
                let Meeting::Points(found) = lines[i].carrier.meet(&lines[j].carrier, same) else { continue };
                for p in found {
                    if !self.inside(p, NEAR * self.size) {
                        continue;
                    }
                    let v = vertices.len();
                    vertices.push(p);
                    for line in [i, j] {
                        let parameter = lines[line].carrier.parameter(p);
                        lines[line].cuts.push((parameter, v));
                    }
                }
            }
        }
        let ids = merged(&vertices, 4.0 * same);
        let mut touched = vec![false; vertices.len()];
        let mut arcs: Vec<JoinedArc> = Vec::new();
        let mut isolated: Vec<Isolated> = Vec::new();
        let mut pieces: Vec<(usize, Piece)> = Vec::new();
        for (n, line) in lines.iter().enumerate() {
            pieces.extend(self.pieces(line, &ids, vertices.len() + n).into_iter().map(|piece| (n, piece)));
        }
        for (k, (n, piece)) in pieces.iter().enumerate() {
            let (n, line) = (*n, &lines[*n]);
            let m = line.carrier.at(0.5 * (piece.from + piece.to));
            if !self.inside(m, same) {
                continue;
            }
            // Next to where two curves touch, pieces of both between the same vertices are one to roundings.
            let twin = |other: &usize| {
                let (line, piece) = (&lines[pieces[*other].0], &pieces[*other].1);
                (line.carrier.at(0.5 * (piece.from + piece.to)) - m).norm() <= 4.0 * same
            };
            let between = |other: &usize| {
                let ends = pieces[*other].1.ends;
                pieces[*other].0 != n && (ends == piece.ends || ends == [piece.ends[1], piece.ends[0]])
            };
            let twins: Vec<usize> = (0..pieces.len()).filter(between).filter(twin).collect();
            for id in piece.ends {
                if let Some(flag) = touched.get_mut(id) {
                    *flag = true;
                }
            }
            if twins.iter().any(|&other| other < k) {
                continue;
            }
            let together: ArrayVec<usize, 8> = twins.iter().map(|&other| pieces[other].0).chain([n]).take(8).collect();
            let reach = self.clearance(&lines, n, &together, m);
            let normal = line.carrier.normal(m) * reach;
            // Growing parameter: a circle has its inside on the left, a line its left.
            let (left, right) = match line.carrier {
                Carrier::Circle { .. } => (m - normal, m + normal),
                Carrier::Line { .. } => (m + normal, m - normal),
            };
            let sides = [self.inside(left, 0.0), self.inside(right, 0.0)];
            if sides == [true, true] {
                continue;
            }
            let bounds: Vec<usize> = together.iter().rev().flat_map(|&n| lines[n].bounds.iter().copied()).collect();
            let active = self.active(&bounds, left, right);
            let ahead = sides != [false, true];
            // A whole circle without a vertex starts and ends in one and the same point.
            let at = |id: usize| vertices.get(id).copied().unwrap_or_else(|| line.carrier.at(piece.from));
            let ends = piece.ends.map(at);
            let arc = boundary_arc(&line.carrier, [piece.from, piece.to], ends, ahead, active);
            if sides == [false, false] {
                isolated.push(Isolated::Curve(arc));
                continue;
            }
            let [from, to] = if ahead { piece.ends } else { [piece.ends[1], piece.ends[0]] };
            arcs.push(JoinedArc { arc, from, to, carrier: n });
        }
        for (k, &p) in vertices.iter().enumerate() {
            if ids[k] != k || touched[k] || !self.inside(p, same) {
                continue;
            }
            // A point of radius zero may lie in the midst of the region.
            let around = |k: u32| {
                let (sin, cos) = (0.3 + TAU * f64::from(k) / 8.0).sin_cos();
                p + self.clearance(&lines, usize::MAX, &[], p) * Vector2::new(cos, sin)
            };
            if k < points && (0..8).any(|k| self.inside(around(k), 0.0)) {
                continue;
            }
            let mut active: Vec<ActiveLimit> = (self.bounds.iter())
                .filter(|bound| bound.carrier.distance(p).abs() <= 4.0 * same)
                .flat_map(|bound| bound.active.iter().copied())
                .collect();
            active.sort();
            active.dedup();
            isolated.push(Isolated::Point { at: p.into(), active });
        }
        Region::from_arcs(arcs, isolated)
    }

    /// The pieces of a curve between its cuts.
    fn pieces(&self, line: &Line, ids: &[usize], own: usize) -> Vec<Piece> {
        let mut cuts: Vec<(f64, usize)> = line.cuts.iter().map(|&(parameter, v)| (parameter, ids[v])).collect();
        cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let scale = match line.carrier {
            Carrier::Circle { radius, .. } => radius,
            Carrier::Line { .. } => 1.0,
        };
        let short = 16.0 * SAME * self.size / scale;
        let mut out = Vec::new();
        for pair in cuts.windows(2) {
            out.push(Piece { from: pair[0].0, to: pair[1].0, ends: [pair[0].1, pair[1].1] });
        }
        if let Carrier::Circle { .. } = line.carrier {
            match (cuts.first(), cuts.last()) {
                (Some(first), Some(last)) => {
                    out.push(Piece { from: last.0, to: first.0 + TAU, ends: [last.1, first.1] });
                }
                _ => out.push(Piece { from: -PI, to: PI, ends: [own, own] }),
            }
        }
        out.retain(|piece| piece.ends[0] != piece.ends[1] || piece.to - piece.from > short);
        out
    }

    /// How far from a point of a curve its sides are tested: half as far as the nearest curve passes that is not one of those `together` there.
    fn clearance(&self, lines: &[Line], own: usize, together: &[usize], m: Vector2<f64>) -> f64 {
        /// No further than this much of the size or of a radius (heuristic: the curve is nearly straight so far).
        const STRAIGHT: f64 = 1e-3;
        let mut reach = 2.0 * STRAIGHT * self.size;
        for (k, line) in lines.iter().enumerate() {
            if k != own && !together.contains(&k) {
                reach = reach.min(line.carrier.distance(m).abs());
            } else if let Carrier::Circle { radius, .. } = line.carrier {
                reach = reach.min(radius);
            }
        }
        0.5 * reach
    }

    /// The limits on a piece: of coincident curves those whose own leg admits one side only.
    fn active(&self, bounds: &[usize], left: Vector2<f64>, right: Vector2<f64>) -> Vec<ActiveLimit> {
        let differs = |leg| (self.admits)(leg, left, 0.0) != (self.admits)(leg, right, 0.0);
        let pick = |all: bool| {
            let counted = bounds.iter().filter(|&&k| all || differs(self.bounds[k].leg));
            let mut names: Vec<_> = counted.flat_map(|&k| self.bounds[k].active.iter().copied()).collect();
            names.sort();
            names.dedup();
            names
        };
        if bounds.len() == 1 {
            return pick(true);
        }
        let some = pick(false);
        if some.is_empty() { pick(true) } else { some }
    }
}

/// A piece of a curve between two cuts.
struct Piece {
    from: f64,
    to: f64,
    ends: [usize; 2],
}

/// A piece of a circle or a line as boundary, run through with growing parameter or the other way.
fn boundary_arc(
    carrier: &Carrier,
    parameters: [f64; 2],
    ends: [Vector2<f64>; 2],
    ahead: bool,
    active: Vec<ActiveLimit>,
) -> BoundaryArc {
    let ([from, to], [start, end]) =
        if ahead { (parameters, ends) } else { ([parameters[1], parameters[0]], [ends[1], ends[0]]) };
    let curve = match *carrier {
        Carrier::Circle { center, radius } => {
            ArcCurve::Circle { center: center.into(), radius, start_angle: from, end_angle: to }
        }
        Carrier::Line { .. } => ArcCurve::Line,
    };
    BoundaryArc { curve, start: start.into(), end: end.into(), active }
}

/// For each point the first of those within `tol` of it, through neighbours.
fn merged(points: &[Vector2<f64>], tol: f64) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| points[a].x.total_cmp(&points[b].x));
    let mut ids: Vec<usize> = (0..points.len()).collect();
    fn root(ids: &mut [usize], k: usize) -> usize {
        let mut k = k;
        while ids[k] != k {
            ids[k] = ids[ids[k]];
            k = ids[k];
        }
        k
    }
    for (n, &a) in order.iter().enumerate() {
        for &b in order[n + 1..].iter().take_while(|&&b| points[b].x - points[a].x <= tol) {
            if (points[b] - points[a]).norm() <= tol {
                let (a, b) = (root(&mut ids, a), root(&mut ids, b));
                let (first, other) = (a.min(b), a.max(b));
                ids[other] = first;
            }
        }
    }
    (0..points.len()).map(|k| root(&mut ids, k)).collect()
}
