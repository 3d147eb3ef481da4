//! Boundary pieces into closed loops: what runs along another piece is taken away, gaps where curves touch are bridged, and what follows on one curve is joined.
//!
//! Every vertex of a boundary has as many pieces that leave as that arrive, the workspace on the left; [`balance`] counts.

use std::collections::HashMap;

use super::crossings::{chords, nearest};
use super::outline::{Look, Piece, SAME_VERTEX, TOUCHING, Tracer};
use nalgebra::Vector2;

type Point = Vector2<f64>;

impl Tracer<'_> {
    /// Keeps one of the pieces that run along each other.
    pub(super) fn drop_doubles(&self, pieces: &mut Vec<(Piece, bool, Look)>) {
        let ends = |(piece, on_left, _): &(Piece, bool, Look)| {
            if *on_left { [piece.start, piece.end] } else { [piece.end, piece.start] }
        };
        let mut kept: Vec<(Piece, bool, Look)> = Vec::new();
        for candidate in pieces.drain(..) {
            if !kept.iter().any(|other| ends(other) == ends(&candidate) && self.along(&candidate.0, &other.0)) {
                kept.push(candidate);
            }
        }
        *pieces = kept;
    }

    /// Takes away pieces that lead nowhere and run along others, closer than their sides could tell.
    pub(super) fn prune(&self, pieces: &mut Vec<(Piece, bool, Look)>) {
        loop {
            let balance = balance(pieces);
            if balance.values().all(|&sum| sum == 0) {
                return;
            }
            let leads_nowhere = |k: &usize| {
                let (piece, on_left, _) = &pieces[*k];
                let side = if *on_left { 1 } else { -1 };
                let open = balance[&piece.start] * side > 0 || balance[&piece.end] * side < 0;
                let near = |other: &usize| other != k && self.is_near(piece, &pieces[*other].0);
                open && (0..pieces.len()).any(|other| near(&other))
            };
            let Some(found) = (0..pieces.len()).find(leads_nowhere) else { return };
            pieces.remove(found);
        }
    }

    /// Closes gaps where one curve takes over from another that it touches: where exactly, is known only to the root of a rounding, and on either curve. The
    /// curve that arrives is followed to where the other leaves, or that one back.
    pub(super) fn bridge(&self, pieces: &mut [(Piece, bool, Look)]) {
        let vertices = &self.curves.vertices;
        loop {
            let balance = balance(pieces);
            let open = |sign: i32| balance.iter().filter(move |(_, sum)| sign * **sum > 0).map(|(&vertex, _)| vertex);
            let mut gaps: Vec<(f64, usize, usize)> = Vec::new();
            for arrived in open(-1) {
                for left in open(1) {
                    let width = (vertices[left] - vertices[arrived]).norm();
                    if width <= TOUCHING * self.size {
                        gaps.push((width, arrived, left));
                    }
                }
            }
            gaps.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
            let closed = gaps.iter().any(|&(_, arrived, left)| {
                pieces.iter_mut().any(|(piece, on_left, _)| {
                    let [first, last] = if *on_left { [piece.start, piece.end] } else { [piece.end, piece.start] };
                    let moved = if last == arrived {
                        self.followed(piece, *on_left, left)
                    } else if first == left {
                        self.followed(piece, !*on_left, arrived)
                    } else {
                        None
                    };
                    moved.map(|moved| *piece = moved).is_some()
                })
            });
            if !closed {
                return;
            }
        }
    }

    /// A piece with its end (or its start) moved along its curve to another vertex, if it passes there.
    fn followed(&self, piece: &Piece, end: bool, vertex: usize) -> Option<Piece> {
        /// How far beyond the way to the vertex its parameter is sought.
        const BEYOND: f64 = 4.0;
        let at = self.curves.vertices[vertex];
        let old = if end { piece.to } else { piece.from };
        let eval = |t: f64| self.eval(piece.curve, t);
        let (place, velocity) = eval(old);
        let span = (BEYOND * (at - place).norm() / velocity.norm()).min(piece.to - piece.from);
        let ([low, high], closed) = self.curves.span(piece.curve);
        let (mut from, mut to) = (old - span, old + span);
        if !closed {
            (from, to) = (from.max(low), to.min(high));
        }
        let t = nearest(&eval, at, from, to);
        let moved =
            if end { Piece { to: t, end: vertex, ..*piece } } else { Piece { from: t, start: vertex, ..*piece } };
        ((eval(t).0 - at).norm() <= 10.0 * SAME_VERTEX * self.size && moved.to > moved.from).then_some(moved)
    }

    /// Keeps of pieces that lie on each other the longer.
    pub(super) fn drop_covered(&self, pieces: &mut Vec<(Piece, bool, Look)>) {
        let mut order: Vec<usize> = (0..pieces.len()).collect();
        order.sort_by(|&i, &j| self.extent(&pieces[j].0).total_cmp(&self.extent(&pieces[i].0)).then(i.cmp(&j)));
        let mut kept: Vec<usize> = Vec::new();
        for k in order {
            if !kept.iter().any(|&other| self.lies_on(&pieces[k].0, &pieces[other].0)) {
                kept.push(k);
            }
        }
        kept.sort_unstable();
        *pieces = kept.into_iter().map(|k| pieces[k].clone()).collect();
    }

    /// How far a piece goes from its start by its middle to its end, which may be the start again.
    pub(super) fn extent(&self, piece: &Piece) -> f64 {
        let [start, middle, end] = [0.0, 0.5, 1.0].map(|part| self.eval(piece.curve, piece.part(part)).0);
        (middle - start).norm() + (end - middle).norm()
    }

    /// Whether a piece lies on another, its ends and its middle.
    pub(super) fn lies_on(&self, piece: &Piece, other: &Piece) -> bool {
        [0.5, 0.0, 1.0].iter().all(|&part| self.passes(other, self.eval(piece.curve, piece.part(part)).0))
    }

    /// Whether the middle of a piece lies on another.
    fn is_near(&self, piece: &Piece, other: &Piece) -> bool {
        self.passes(other, self.eval(piece.curve, piece.part(0.5)).0)
    }

    /// Whether a piece passes a place, as far as vertices are told apart.
    pub(super) fn passes(&self, piece: &Piece, at: Point) -> bool {
        let near = 10.0 * SAME_VERTEX * self.size;
        let eval = |t: f64| self.eval(piece.curve, t);
        chords(&eval, piece.from, piece.to)
            .iter()
            .any(|chord| (eval(nearest(&eval, at, chord.from, chord.to)).0 - at).norm() <= near)
    }

    /// Whether a piece runs along another between the same vertices.
    pub(super) fn along(&self, piece: &Piece, other: &Piece) -> bool {
        let same = [piece.start, piece.end] == [other.start, other.end];
        if !same && [piece.end, piece.start] != [other.start, other.end] {
            return false;
        }
        self.is_near(piece, other)
    }
}

/// How many more pieces leave a vertex than arrive.
pub(super) fn balance(pieces: &[(Piece, bool, Look)]) -> HashMap<usize, i32> {
    let mut balance = HashMap::new();
    for (piece, on_left, _) in pieces {
        let side = if *on_left { 1 } else { -1 };
        *balance.entry(piece.start).or_default() += side;
        *balance.entry(piece.end).or_default() -= side;
    }
    balance
}

/// Takes away pieces that belong to no closed way along the others.
pub(super) fn drop_dead_ends(pieces: &mut Vec<(Piece, bool, Look)>) {
    loop {
        let mut degree: HashMap<usize, usize> = HashMap::new();
        for (piece, _, _) in pieces.iter() {
            *degree.entry(piece.start).or_default() += 1;
            *degree.entry(piece.end).or_default() += 1;
        }
        let before = pieces.len();
        pieces.retain(|(piece, _, _)| degree[&piece.start] > 1 && degree[&piece.end] > 1);
        if pieces.len() == before {
            return;
        }
    }
}

/// Joins pieces of one curve that follow each other where nothing else ends.
pub(super) fn join(pieces: &mut Vec<(Piece, bool, Look)>) {
    let mut degree: HashMap<usize, usize> = HashMap::new();
    for (piece, _, _) in pieces.iter() {
        *degree.entry(piece.start).or_default() += 1;
        *degree.entry(piece.end).or_default() += 1;
    }
    let mut joined: Vec<(Piece, bool, Look)> = Vec::with_capacity(pieces.len());
    for (piece, on_left, look) in pieces.drain(..) {
        if let Some((last, side, before)) = joined.last_mut()
            && last.curve == piece.curve
            && *side == on_left
            && last.to == piece.from
            && last.end == piece.start
            && degree[&piece.start] == 2
            && before.active == look.active
            && before.pair == look.pair
        {
            last.to = piece.to;
            last.end = piece.end;
            continue;
        }
        joined.push((piece, on_left, look));
    }
    *pieces = joined;
}
