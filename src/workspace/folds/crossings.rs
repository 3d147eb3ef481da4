//! Where curves cross: subdivision into nearly straight chords, and Newton's method on both parameters.
//!
//! A chord stands for a piece of curve that stays within a known distance of it. Pieces whose strips are apart do not meet; nearly straight ones that cross at an angle
//! meet once; all others are halved. Pieces that stay together down to the tolerance touch or overlap: the places are reported as well, since dividing a curve where it need
//! not be divided does no harm.

use nalgebra::Vector2;

type Point = Vector2<f64>;

/// A curve by its parameter: point and derivative.
pub(super) type Eval<'a> = dyn Fn(f64) -> (Point, Point) + 'a;

/// A piece of curve with its chord.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chord {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) start: Point,
    pub(super) end: Point,
    /// How far the piece can be beside its chord, a length.
    pub(super) bulge: f64,
    low: Point,
    high: Point,
}

/// Pieces whose directions differ from the chord's by more than this tangent are halved at once (heuristic: a third of a radian leaves a few chords a curve).
const BEND: f64 = 0.35;
/// The bulge of a smooth piece is at most half its length times the tangent of its greatest angle to the chord; measured at five places, it is enlarged by this factor.
const ALLOWANCE: f64 = 1.5;
/// Chords of a curve are halved at most so often.
const DEPTH: usize = 12;
/// Pairs of pieces looked at for one pair of chords before they count as overlapping (a crossing takes some ten, a touch some hundred).
const PATIENCE: usize = 1200;
/// Of these after so many it is asked whether they run along each other (more than a crossing takes).
const DOUBT: usize = 40;
/// Two curves touch where they come nearer than this share of the length over which they stay together: the square of a small bend.
const CLOSE: f64 = 1e-4;
/// A crossing is sought by Newton's method where the angle between chords exceeds their own bends by this factor.
const STEEP: f64 = 3.0;
/// Newton steps: quadratic from a chord's crossing.
const STEPS: usize = 8;

impl Chord {
    fn new(eval: &Eval<'_>, from: f64, to: f64, start: Point, end: Point) -> Self {
        let chord = end - start;
        let length = chord.norm();
        let sign = (to - from).signum();
        // Tangents at inner places: at turning points of the parameter they are 0/0.
        let mut slope = 0.0_f64;
        let mut aside = 0.0_f64;
        for part in [0.02, 0.27, 0.5, 0.73, 0.98] {
            let (at, velocity) = eval(from + part * (to - from));
            let velocity = velocity * sign;
            let (along, across) = (chord.dot(&velocity), chord.perp(&velocity));
            slope = slope.max(if along > 0.0 { (across / along).abs() } else { f64::INFINITY });
            if length > 0.0 {
                aside = aside.max((chord.perp(&(at - start)) / length).abs());
            }
        }
        let bulge = if slope.is_finite() { ALLOWANCE * (0.25 * length * slope).max(aside) } else { f64::INFINITY };
        let pad = if bulge.is_finite() { bulge } else { 0.0 };
        Self {
            from,
            to,
            start,
            end,
            bulge,
            low: start.inf(&end) - Point::repeat(pad),
            high: start.sup(&end) + Point::repeat(pad),
        }
    }

    /// The corners of the box around chords with their bulges.
    pub(super) fn around(chords: &[Self]) -> [Point; 2] {
        let none = [Point::repeat(f64::INFINITY), Point::repeat(f64::NEG_INFINITY)];
        chords.iter().fold(none, |[low, high], chord| [low.inf(&chord.low), high.sup(&chord.high)])
    }

    /// Whether a place is in the box of the chord, or nearer to it than `tol`.
    pub(super) fn reaches(&self, at: Point, tol: f64) -> bool {
        let (low, high) = (self.low - Point::repeat(tol), self.high + Point::repeat(tol));
        low.x <= at.x && at.x <= high.x && low.y <= at.y && at.y <= high.y
    }

    fn length(&self) -> f64 {
        (self.end - self.start).norm()
    }

    fn halves(&self, eval: &Eval<'_>) -> [Self; 2] {
        let middle = 0.5 * (self.from + self.to);
        let at = eval(middle).0;
        [Self::new(eval, self.from, middle, self.start, at), Self::new(eval, middle, self.to, at, self.end)]
    }

    /// Whether the boxes, and the strips along either chord, are apart.
    fn apart(&self, other: &Self) -> bool {
        let (a, b) = (self, other);
        if a.high.x < b.low.x || b.high.x < a.low.x || a.high.y < b.low.y || b.high.y < a.low.y {
            return true;
        }
        let beside = |strip: &Self, piece: &Self| {
            let chord = strip.end - strip.start;
            let length = chord.norm();
            if length == 0.0 {
                return false;
            }
            let normal = Point::new(-chord.y, chord.x) / length;
            let (p, q) = (normal.dot(&(piece.start - strip.start)), normal.dot(&(piece.end - strip.start)));
            p.min(q) - piece.bulge > strip.bulge || p.max(q) + piece.bulge < -strip.bulge
        };
        beside(a, b) || beside(b, a)
    }
}

/// A curve as nearly straight pieces.
pub(super) fn chords(eval: &Eval<'_>, from: f64, to: f64) -> Vec<Chord> {
    /// Pieces at first, so that no loop is taken for a chord.
    const FIRST: usize = 3;
    let mut out = Vec::new();
    let parameter = |k: usize| from + (to - from) * (k as f64 / FIRST as f64);
    let mut start = eval(from).0;
    for k in 0..FIRST {
        let end = eval(parameter(k + 1)).0;
        divide(eval, Chord::new(eval, parameter(k), parameter(k + 1), start, end), DEPTH, &mut out);
        start = end;
    }
    out
}

fn divide(eval: &Eval<'_>, chord: Chord, depth: usize, out: &mut Vec<Chord>) {
    if depth == 0 || chord.bulge <= 0.25 * ALLOWANCE * BEND * chord.length() {
        out.push(chord);
        return;
    }
    for half in chord.halves(eval) {
        divide(eval, half, depth - 1, out);
    }
}

/// What two pieces of curve have in common.
#[derive(Clone, Debug, Default)]
pub(super) struct Common {
    /// Parameters on both.
    pub(super) crossings: Vec<[f64; 2]>,
    /// Whether they run along each other.
    pub(super) overlap: bool,
}

/// The crossings of two chords' pieces, and the touches down to `tol`, a length.
///
/// Pieces that lie within `tol` of one of the places `known` where the curves are known to meet are left alone.
pub(super) fn meet(
    one: &Eval<'_>,
    other: &Eval<'_>,
    [first, second]: [&Chord; 2],
    known: &[Point],
    tol: f64,
    out: &mut Common,
) {
    let mut todo = vec![(*first, *second)];
    let mut patience = PATIENCE;
    while let Some((a, b)) = todo.pop() {
        if a.apart(&b) {
            continue;
        }
        if patience == 0 {
            out.overlap = true;
            return;
        }
        patience -= 1;
        if patience == PATIENCE - DOUBT && run_along(one, other, [first, second], CLOSE * tol) {
            out.overlap = true;
            return;
        }
        let near = |p: &Point| [a.start, a.end, b.start, b.end].iter().all(|q| (p - q).norm() <= tol);
        if known.iter().any(near) {
            continue;
        }
        let (la, lb) = (a.length(), b.length());
        if la.max(lb) <= tol {
            out.crossings.extend(touch(one, other, &a, &b, CLOSE * tol));
            continue;
        }
        if la > 0.0 && lb > 0.0 {
            let sine = (a.end - a.start).perp(&(b.end - b.start)).abs() / (la * lb);
            let bends = 4.0 * (a.bulge / la + b.bulge / lb);
            if sine > STEEP * bends && bends < BEND {
                match newton(one, other, &a, &b) {
                    Answer::Crossing(at) => {
                        out.crossings.push(at);
                        continue;
                    }
                    Answer::Outside => continue,
                    Answer::Unknown => {}
                }
            }
        }
        if la >= lb {
            todo.extend(a.halves(one).map(|half| (half, b)));
        } else {
            todo.extend(b.halves(other).map(|half| (a, half)));
        }
    }
}

/// Whether two pieces have more than one of a few places in common.
fn run_along(one: &Eval<'_>, other: &Eval<'_>, [a, b]: [&Chord; 2], close: f64) -> bool {
    /// Places on each.
    const PLACES: usize = 7;
    let common = |from: &Eval<'_>, on: &Chord, to: &Eval<'_>, chord: &Chord| {
        let place = |k: usize| from(on.from + (k as f64 + 0.5) / PLACES as f64 * (on.to - on.from)).0;
        let lies = |at: &Point| (to(nearest(to, *at, chord.from, chord.to)).0 - at).norm() <= close;
        (0..PLACES).map(place).filter(lies).take(2).count() == 2
    };
    common(one, a, other, b) || common(other, b, one, a)
}

/// Where two short pieces come nearer than `close`, if they do: in the middle of one of them, or at an end where a curve begins.
fn touch(one: &Eval<'_>, other: &Eval<'_>, a: &Chord, b: &Chord, close: f64) -> Option<[f64; 2]> {
    let places = |chord: &Chord| [0.5 * (chord.from + chord.to), chord.from, chord.to];
    let onto = |from: &Eval<'_>, at: f64, to: &Eval<'_>, chord: &Chord| {
        let point = from(at).0;
        let found = nearest(to, point, chord.from, chord.to);
        ((to(found).0 - point).norm() <= close).then_some(found)
    };
    let first = places(a).into_iter().find_map(|s| onto(one, s, other, b).map(|t| [s, t]));
    first.or_else(|| places(b).into_iter().find_map(|t| onto(other, t, one, a).map(|s| [s, t])))
}

/// The parameter between `from` and `to` of the place on a nearly straight piece nearest to a point.
pub(super) fn nearest(eval: &Eval<'_>, point: Point, from: f64, to: f64) -> f64 {
    /// Newton steps: a nearly straight piece takes few.
    const STEPS: usize = 5;
    let mut t = 0.5 * (from + to);
    for _ in 0..STEPS {
        let (at, velocity) = eval(t);
        let square = velocity.norm_squared();
        if !(square > 0.0 && square.is_finite()) {
            break;
        }
        t = (t + (point - at).dot(&velocity) / square).clamp(from.min(to), from.max(to));
    }
    t
}

enum Answer {
    Crossing([f64; 2]),
    Outside,
    Unknown,
}

/// The one crossing of two nearly straight pieces, if it is on both.
fn newton(one: &Eval<'_>, other: &Eval<'_>, a: &Chord, b: &Chord) -> Answer {
    /// How far beyond its ends a piece may be met, as a share of it: a crossing at a common end of two pieces belongs to one of them at least.
    const BEYOND: f64 = 1e-7;
    /// Further outside than this nothing is lost by dropping it.
    const WELL_OUTSIDE: f64 = 0.3;
    /// The last step's size as a share of the piece: its square is below rounding.
    const SETTLED: f64 = 1e-9;
    let (da, db) = (a.end - a.start, b.end - b.start);
    let cross = da.perp(&db);
    let between = b.start - a.start;
    let (mut s, mut t) = (between.perp(&db) / cross, between.perp(&da) / cross);
    let outside = |x: f64| (x - 1.0).max(-x);
    for _ in 0..STEPS {
        if outside(s).max(outside(t)) > 1.0 {
            return Answer::Unknown;
        }
        let (u, v) = (s.clamp(-BEYOND, 1.0 + BEYOND), t.clamp(-BEYOND, 1.0 + BEYOND));
        let (ta, tb) = (a.from + u * (a.to - a.from), b.from + v * (b.to - b.from));
        let ((p, dp), (q, dq)) = (one(ta), other(tb));
        let (dp, dq) = (dp * (a.to - a.from), dq * (b.to - b.from));
        let cross = dp.perp(&dq);
        if !cross.is_finite() || cross == 0.0 {
            return Answer::Unknown;
        }
        let miss = q - p;
        let step = [miss.perp(&dq) / cross, miss.perp(&dp) / cross];
        (s, t) = (u + step[0], v + step[1]);
        if step[0].abs().max(step[1].abs()) <= SETTLED {
            let out = outside(s).max(outside(t));
            if out <= BEYOND {
                let (s, t) = (s.clamp(0.0, 1.0), t.clamp(0.0, 1.0));
                return Answer::Crossing([a.from + s * (a.to - a.from), b.from + t * (b.to - b.from)]);
            }
            return Answer::Outside;
        }
        // Held at an end and pushed outwards again and again.
        if outside(s).max(outside(t)) > WELL_OUTSIDE && outside(u).max(outside(v)) >= 0.0 {
            return Answer::Unknown;
        }
    }
    Answer::Unknown
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle(center: Point, radius: f64) -> impl Fn(f64) -> (Point, Point) {
        move |t: f64| (center + radius * Point::new(t.cos(), t.sin()), radius * Point::new(-t.sin(), t.cos()))
    }

    fn common(one: &Eval<'_>, other: &Eval<'_>) -> Common {
        let mut out = Common::default();
        let (a, b) = (chords(one, 0.1, 6.3), chords(other, 0.1, 6.3));
        for first in &a {
            for second in &b {
                meet(one, other, [first, second], &[], 1e-6, &mut out);
            }
        }
        out
    }

    #[test]
    fn circles_cross_touch_and_overlap() {
        let unit = circle(Point::zeros(), 1.0);
        let crossing = common(&unit, &circle(Point::new(1.2, 0.0), 0.9));
        assert_eq!(crossing.crossings.len(), 2);
        assert!(!crossing.overlap);
        assert!(common(&unit, &circle(Point::new(0.5, 0.0), 0.3)).crossings.is_empty());
        let touch = common(&unit, &circle(Point::new(-1.5, 0.0), 0.5));
        assert!(!touch.crossings.is_empty() || touch.overlap);
        assert!(common(&unit, &circle(Point::zeros(), 1.0)).overlap);
    }
}
