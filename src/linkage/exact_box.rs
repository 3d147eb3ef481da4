//! A pose box from an exactly isolated root, where floating point has too few digits: double roots, modes that nearly meet, given orientations.
//!
//! The root is refined until integers scaled by a power of two tell everything apart; what then is rounded to `f64` is rounded outward.

use dashu_int::ops::BitTest;

use super::fibre::{Chart, Fibre, Part};
use super::loop_box::PoseIntervals;
use super::numbers::TriadNumbers;
use super::triad::{Row, Rows};
use crate::algebra::{Bracket, Gaussian, Integer, Interval, Rational, Ring, Trig};
use crate::roots::{Isolation, MAX_BITS, isolate_real_roots};

/// Real poses above the real roots of a part, in boxes.
pub(super) struct Boxed {
    /// The boxes, each with the multiplicity its root has; twins have half of it each.
    pub poses: Vec<(PoseIntervals, usize)>,
    /// Whether every real root of the part was lifted within [`MAX_BITS`].
    pub complete: bool,
}

/// Bits of the first attempt.
const FIRST: usize = 192;

/// A coordinate wider than this, relative to the group's size, calls for more bits. Rounding numerator, denominator and quotient to `f64` alone makes
/// six units in the last place, 1.4e-15.
const WANTED: f64 = 4e-15;

/// The rotation as integers over a common denominator: `(c, s) = (cosine, sine) / unit`.
pub(super) struct ScaledRotation {
    cosine: Bracket,
    sine: Bracket,
    unit: Integer,
    bits: usize,
}

/// A position of the reference leg's platform point, over a denominator.
struct ScaledPoint {
    at: Gaussian<Bracket>,
    unit: Bracket,
}

impl ScaledPoint {
    fn centre() -> Self {
        Self { at: Gaussian::new(Bracket::from_int(0), Bracket::from_int(0)), unit: Bracket::from_int(1) }
    }
}

/// Where a group stands: its reference points, and the unit of its integers.
pub(super) struct Frame {
    a0: [f64; 2],
    b0: [f64; 2],
    length_shift: i64,
    /// Bits of the largest length among the integers.
    size: i64,
}

impl Frame {
    pub fn new(a0: [f64; 2], b0: [f64; 2], numbers: &TriadNumbers, size: i64) -> Self {
        Self { a0, b0, length_shift: numbers.length_shift, size }
    }

    /// The pose of a point and a rotation.
    fn pose(&self, point: &ScaledPoint, rotation: &ScaledRotation) -> Option<PoseIntervals> {
        // Both parts of the quotient near 1.
        let places = point.unit.bits() as i64;
        let unit = point.unit.to_interval(-places);
        let u = |part: &Bracket| {
            Some(part.to_interval(-places - self.size).checked_div(unit)?.scale(self.size - self.length_shift))
        };
        let [c, s] = rotation.intervals();
        let ([ax, ay], [bx, by]) = (self.a0.map(Interval::point), self.b0.map(Interval::point));
        let x = ax + u(&point.at.re)? - (c * bx - s * by);
        let y = ay + u(&point.at.im)? - (s * bx + c * by);
        Some([x, y, Interval::angle(c, s)?])
    }

    /// The pose with the reference leg's platform point on its base point.
    pub fn centre(&self, rotation: &ScaledRotation) -> Option<PoseIntervals> {
        self.pose(&ScaledPoint::centre(), rotation)
    }

    /// Whether a point is known as well as `f64` can tell.
    fn is_sharp(&self, point: &ScaledPoint) -> bool {
        let places = point.unit.bits() as i64;
        let unit = point.unit.to_interval(-places);
        let sharp = |part: &Bracket| {
            part.to_interval(-places - self.size)
                .checked_div(unit)
                .is_some_and(|q| q.width() <= WANTED * q.magnitude().max(1.0))
        };
        sharp(&point.at.re) && sharp(&point.at.im)
    }
}

impl ScaledRotation {
    /// The rotations of an isolated root in a chart, to `bits` places.
    fn of_root(root: &Isolation, chart: Chart, bits: usize) -> Self {
        let places = |x: &Rational| x.denominator().bit_len() - 1;
        let k = places(&root.low).max(places(&root.high));
        let t = |x: &Rational| x.numerator().clone() << (k - places(x));
        let (low, high) = (t(&root.low), t(&root.high));
        let tau = Integer::from(chart.tau());
        let one = Integer::ONE << k;
        // tan(phi/2) = (tau + t) / (1 - tau t)
        let (n, d) = (tau.clone() * &one + &low, one.clone() - tau * &low);
        let (nn, dd) = (&n * &n, &d * &d);
        let size = &nn + &dd;
        // |dphi/dt| = 2/(1 + t²) ≤ 2.
        let spread = (((high - low) << (bits + 1)) >> k) + Integer::ONE;
        let near = |numerator: Integer| {
            let floor = floor_div(&(numerator << bits), &size);
            Bracket::new(floor.clone() - &spread, floor + Integer::ONE + &spread)
        };
        Self { cosine: near(&dd - &nn), sine: near((n * d) << 1), unit: Integer::ONE << bits, bits }
    }

    /// The rotations whose cosine and sine lie between two rationals each, to `bits` places.
    pub fn between([c, s]: [[Rational; 2]; 2], bits: usize) -> Self {
        let scale = Rational::from(Integer::ONE << bits);
        let bracket = |[low, high]: [Rational; 2]| Bracket::new((low * &scale).floor(), (high * &scale).ceil());
        Self { cosine: bracket(c), sine: bracket(s), unit: Integer::ONE << bits, bits }
    }

    fn intervals(&self) -> [Interval; 2] {
        let unit = Interval::new(-1.0, 1.0).unwrap_or(Interval::EVERYTHING);
        [&self.cosine, &self.sine].map(|x| {
            let interval = x.to_interval(-(self.bits as i64));
            interval.intersection(unit).unwrap_or(interval)
        })
    }

    /// A row at this rotation, multiplied by the denominator.
    fn row(&self, row: &Row<Trig<Integer>>) -> Row<Bracket> {
        let unit = Bracket::point(self.unit.clone());
        let at = |t: &Trig<Integer>| t.homogeneous(1, &self.cosine, &self.sine, &unit, |x| Bracket::point(x.clone()));
        Row { g: Gaussian::new(at(&row.g.re), at(&row.g.im)), e: at(&row.e) }
    }
}

fn floor_div(a: &Integer, b: &Integer) -> Integer {
    use dashu_int::ops::DivRemEuclid;
    a.div_rem_euclid(b).0
}

/// The boxes of all real poses of a part of `T`.
pub(super) fn boxes(part: &Part, rows: Option<&Rows<Trig<Integer>>>, frame: &Frame) -> Boxed {
    let mut out = Boxed { poses: Vec::new(), complete: true };
    if matches!(part.fibre, Fibre::Empty(_) | Fibre::Curve | Fibre::IsotropicPoint) {
        return out;
    }
    for root in isolate_real_roots(&part.in_chart) {
        let mut root = root;
        let mut bits = FIRST;
        loop {
            root = root.refined(&part.in_chart, bits);
            let rotation = ScaledRotation::of_root(&root, part.chart, bits);
            let poses = above(&rotation, part.fibre, rows, frame);
            if let Some(poses) = poses {
                let share = part.multiplicity / poses.len().max(1);
                out.poses.extend(poses.into_iter().map(|pose| (pose, share)));
                break;
            }
            if 2 * bits > MAX_BITS {
                out.complete = false;
                break;
            }
            bits *= 2;
        }
    }
    out
}

/// The poses above one rotation; `None` where it is not known well enough.
fn above(
    rotation: &ScaledRotation,
    fibre: Fibre,
    rows: Option<&Rows<Trig<Integer>>>,
    frame: &Frame,
) -> Option<Vec<PoseIntervals>> {
    let points = match (fibre, rows) {
        (Fibre::Centre, _) | (_, None) => vec![ScaledPoint::centre()],
        (Fibre::Point, Some(Rows::Circle { rows, .. })) => {
            vec![crossing(&rows.each_ref().map(|row| rotation.row(row)))?]
        }
        (Fibre::Point, Some(Rows::Lines(rows))) => vec![crossing(&rows.each_ref().map(|row| rotation.row(row)))?],
        (_, Some(Rows::Circle { radius, rows })) => {
            let radius = radius.evaluate(Clone::clone, &Integer::ONE, &Integer::ZERO);
            let rows = rows.each_ref().map(|row| rotation.row(row));
            let line = rows.iter().max_by_key(|row| row.g.norm_sqr().bits())?;
            line_and_circle(line, &radius, fibre == Fibre::Tangent)?
        }
        (_, Some(Rows::Lines(_))) => return None,
    };
    if !points.iter().all(|point| frame.is_sharp(point)) {
        return None;
    }
    points.iter().map(|point| frame.pose(point, rotation)).collect()
}

/// Where the two of the rows that are furthest from parallel cross.
fn crossing(rows: &[Row<Bracket>]) -> Option<ScaledPoint> {
    let pairs = (0..rows.len()).flat_map(|i| (0..i).map(move |j| (j, i)));
    let quality = |&(i, j): &(usize, usize)| {
        let sizes = rows[i].g.norm_sqr().bits() + rows[j].g.norm_sqr().bits();
        2 * rows[i].cross(&rows[j]).bits() as i64 - sizes as i64
    };
    let (i, j) = pairs.max_by_key(quality)?;
    let cross = rows[i].cross(&rows[j]);
    if cross.contains_zero() {
        return None;
    }
    // e_j g_i - e_i g_j, turned by a quarter.
    let mismatch = rows[j].mismatch(&rows[i]);
    Some(ScaledPoint { at: Gaussian::new(mismatch.im, -mismatch.re), unit: cross })
}

/// The points of `g·u + e = 0` on the circle `u·u = radius²`: none, one where the line is known to touch, or two.
fn line_and_circle(line: &Row<Bracket>, radius: &Integer, touches: bool) -> Option<Vec<ScaledPoint>> {
    let Row { g, e } = line;
    let unit = g.norm_sqr();
    if unit.contains_zero() {
        return None;
    }
    let foot = g.scaled(&-e.clone());
    if touches {
        return Some(vec![ScaledPoint { at: foot, unit }]);
    }
    let discriminant = Bracket::point(radius * radius) * unit.clone() - e.clone() * e.clone();
    if discriminant.contains_zero() {
        return None;
    }
    let Some(root) = discriminant.sqrt() else { return Some(Vec::new()) };
    let along = g.turned().scaled(&root);
    let at = [foot.clone() + along.clone(), foot - along];
    Some(at.map(|at| ScaledPoint { at, unit: unit.clone() }).into())
}

/// The boxes of a group whose orientation is given, within the rotation's own uncertainty; `None` where that is too large.
///
/// `rows`: one row and the circle's radius, or two rows. `touches`: whether the line is known to touch the circle.
pub(super) fn given_boxes(
    rotation: &ScaledRotation,
    radius: Option<&Integer>,
    rows: &[Row<Trig<Integer>>],
    touches: bool,
    frame: &Frame,
) -> Option<Vec<PoseIntervals>> {
    let rows: Vec<Row<Bracket>> = rows.iter().map(|row| rotation.row(row)).collect();
    let points = match radius {
        Some(radius) => line_and_circle(rows.first()?, radius, touches)?,
        None => vec![crossing(&rows)?],
    };
    points.iter().map(|point| frame.pose(point, rotation)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rotation_holds_its_root_exactly_and_every_one_between_the_ends() {
        let third = Rational::ONE / Rational::from(4);
        let near = third.clone() + Rational::ONE / Rational::from(Integer::ONE << 20);
        for (low, high) in [(third.clone(), third.clone()), (third.clone(), near.clone())] {
            let chart = Chart::without_infinity(&Trig::one());
            assert_eq!(chart.tau(), 0);
            let root = Isolation { low: low.clone(), high: high.clone() };
            let rotation = ScaledRotation::of_root(&root, chart, 192);
            for t in [low, high] {
                let w = Rational::ONE + t.clone() * t.clone();
                let scale = Rational::from(Integer::ONE << 192);
                let (c, s) = ((Rational::ONE - t.clone() * t.clone()) / w.clone(), t * Rational::from(2) / w);
                for (held, x) in [(&rotation.cosine, c * scale.clone()), (&rotation.sine, s * scale)] {
                    let (numerator, denominator) = x.into_parts();
                    let scaled = held.clone() * Bracket::point(Integer::from(denominator));
                    assert!((scaled - Bracket::point(numerator)).contains_zero());
                }
            }
        }
    }
}
