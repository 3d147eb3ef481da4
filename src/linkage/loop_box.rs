//! A pose box proved on the loop equations.
//!
//! Unknowns are `u` and the rotation as a point `(c, s)` of the unit circle; equations are the reference leg's circle, the legs' rows
//! ([`super::triad`]) and `c² + s² = 1`: bilinear, so that enclosures of values and derivatives are near exact. Krawczyk's test then shows that a box holds
//! exactly one assembly. Differences of points are taken with their rounding errors before anything else, so a far origin costs nothing here.

use super::group::{Dyad, Offset, Triad};
use super::triad::{LegNumbers, Row, Rows, rows_consistency, triad_rows};
use crate::algebra::{Gaussian, Interval, ShortTrig};
use crate::certify::{Enclosure, Region, enclose_zero};

/// `[x, y, phi]`, an interval each.
pub(super) type PoseIntervals = [Interval; 3];

/// A triad without PP legs in intervals, reference leg first, lengths in units of `2^unit`.
pub(super) struct IntervalTriad {
    rows: Rows<ShortTrig<Interval>>,
    order: usize,
    unit: i64,
    a0: [f64; 2],
    b0: [f64; 2],
}

/// The exponent of a power of two near `x`.
fn exponent(x: f64) -> i64 {
    if x > 0.0 { x.log2().ceil() as i64 } else { 0 }
}

impl IntervalTriad {
    /// The triad in intervals; `None` with a PP leg, or where its numbers leave the range of `f64`.
    pub fn of(triad: &Triad) -> Option<Self> {
        let order = triad.order()?;
        let legs = triad.legs();
        let length = |i: usize| match legs[i] {
            Dyad::RR { length, .. } => length,
            _ => f64::INFINITY,
        };
        let reference = (0..3).min_by(|&i, &j| length(i).total_cmp(&length(j)))?;
        let sorted = match reference {
            0 => [0, 1, 2],
            1 => [1, 0, 2],
            _ => [2, 0, 1],
        };
        let (a0, b0) = points(&legs[reference])?;
        let mut largest = 0.0f64;
        for leg in legs {
            let (a, b) = points(leg)?;
            let own = match *leg {
                Dyad::RR { length, .. } => length,
                Dyad::RP { offset: Offset::Distance(d), .. } => d.abs(),
                _ => 0.0,
            };
            let apart = [a[0] - a0[0], a[1] - a0[1], b[0] - b0[0], b[1] - b0[1]];
            largest = apart.iter().fold(largest.max(own), |m, x| m.max(x.abs()));
        }
        if !largest.is_finite() || largest == 0.0 {
            return None;
        }
        let unit = exponent(largest);
        let numbers = sorted.map(|i: usize| leg_intervals(&legs[i], a0, b0, unit));
        let symbols = numbers.map(|leg| leg.map(|&x| ShortTrig::constant(x)));
        let rows = triad_rows(&symbols, &ShortTrig::cosine(), &ShortTrig::sine());
        Some(Self { rows, order, unit, a0, b0 })
    }

    /// Coefficients of `T`: of `1, c, c², c³` and of `s, s c, s c²`.
    ///
    /// Those beyond the triad's order vanish identically, whatever rounding makes of them.
    pub fn consistency(&self) -> ([Interval; 4], [Interval; 3]) {
        let t = rows_consistency(&self.rows);
        let even = std::array::from_fn(|k| if k <= self.order { t.even()[k] } else { Interval::ZERO });
        let odd = std::array::from_fn(|k| if k < self.order { t.odd()[k] } else { Interval::ZERO });
        (even, odd)
    }

    /// The loop equations.
    pub fn equations(&self) -> LoopEquations {
        let affine = |t: &ShortTrig<Interval>| Affine { constant: t.even()[0], by_c: t.even()[1], by_s: t.odd()[0] };
        let row = |row: &Row<ShortTrig<Interval>>| [affine(&row.g.re), affine(&row.g.im), affine(&row.e)];
        match &self.rows {
            Rows::Circle { radius, rows: [p, q] } => {
                LoopEquations { radius: Some(radius.even()[0]), rows: [row(p), row(q), row(q)] }
            }
            Rows::Lines(rows) => LoopEquations { radius: None, rows: rows.each_ref().map(row) },
        }
    }

    /// The pose box of a box of `(u, c, s)`.
    pub fn pose(&self, [ux, uy, c, s]: &Region<4>) -> Option<PoseIntervals> {
        let ([ax, ay], [bx, by]) = (self.a0.map(Interval::point), self.b0.map(Interval::point));
        let x = ax + ux.scale(self.unit) - (*c * bx - *s * by);
        let y = ay + uy.scale(self.unit) - (*s * bx + *c * by);
        Some([x, y, Interval::angle(*c, *s)?])
    }

    /// `(u, c, s)` of a pose, approximately.
    pub fn start(&self, x: f64, y: f64, phi: f64) -> [f64; 4] {
        let (s, c) = phi.sin_cos();
        let (a0, b0) = (self.a0, self.b0);
        let ux = Interval::point((x - a0[0]) + (c * b0[0] - s * b0[1])).scale(-self.unit).middle();
        let uy = Interval::point((y - a0[1]) + (s * b0[0] + c * b0[1])).scale(-self.unit).middle();
        [ux, uy, c, s]
    }
}

/// Base and platform point of a leg.
fn points(leg: &Dyad) -> Option<([f64; 2], [f64; 2])> {
    match leg {
        Dyad::RR { a, b, .. } | Dyad::PR { a, b, .. } | Dyad::RP { a, b, .. } => Some(([a.x, a.y], [b.x, b.y])),
        Dyad::PP { .. } => None,
    }
}

fn leg_intervals(leg: &Dyad, a0: [f64; 2], b0: [f64; 2], unit: i64) -> LegNumbers<Interval> {
    let number = |x: f64, shift: i64| Interval::point(x).scale(-shift);
    let less = |p: [f64; 2], q: [f64; 2]| {
        let part = |k: usize| (Interval::point(p[k]) - Interval::point(q[k])).scale(-unit);
        Gaussian::new(part(0), part(1))
    };
    let (a, b) = points(leg).unwrap_or((a0, b0));
    let (alpha, beta) = (less(a, a0), less(b, b0));
    // i·direction with its larger part about 1.
    let left_of = |x: f64, y: f64| {
        let own = exponent(x.abs().max(y.abs()));
        (Gaussian::new(number(-y, own), number(x, own)), own)
    };
    match *leg {
        Dyad::RR { length, .. } => LegNumbers::Circle { alpha, beta, length: number(length, unit) },
        Dyad::PR { u, .. } => LegNumbers::Line { alpha, beta, normal: left_of(u.x, u.y).0 },
        Dyad::RP { v, offset, .. } => {
            let (normal, own) = left_of(v.x, v.y);
            let delta = match offset {
                Offset::TimesDirection(delta) => number(delta, unit + own),
                Offset::Distance(d) => {
                    let size = (normal.re.square() + normal.im.square()).sqrt().unwrap_or(Interval::EVERYTHING);
                    let rounded = number(d * v.x.hypot(v.y), unit + own);
                    // Both the distance meant and the rounded number that the exact route counts with.
                    (number(d, unit) * size).hull(if d == 0.0 { Interval::ZERO } else { rounded })
                }
            };
            LegNumbers::PlatformLine { alpha, beta, normal, delta }
        }
        Dyad::PP { .. } => unreachable!("a triad with an order has no PP leg"),
    }
}

/// `constant + by_c c + by_s s`.
#[derive(Clone, Copy, Debug)]
struct Affine {
    constant: Interval,
    by_c: Interval,
    by_s: Interval,
}

impl Affine {
    fn at(&self, c: Interval, s: Interval) -> Interval {
        self.constant + self.by_c * c + self.by_s * s
    }
}

/// Two or three rows `g·u + e`, the reference circle where there is one, and the unit circle.
pub(super) struct LoopEquations {
    radius: Option<Interval>,
    rows: [[Affine; 3]; 3],
}

impl LoopEquations {
    /// A box around the only assembly near `(u, c, s)`, or `None`.
    pub fn enclose(&self, start: [f64; 4]) -> Option<Region<4>> {
        start.iter().all(|x| x.is_finite()).then(|| enclose_zero(self, start)).flatten()
    }

    /// Where the rows stand among the equations: from here.
    fn first(&self) -> usize {
        usize::from(self.radius.is_some())
    }
}

impl Enclosure<4> for LoopEquations {
    fn values(&self, [ux, uy, c, s]: &Region<4>) -> [Interval; 4] {
        let mut out = [Interval::ZERO; 4];
        if let Some(radius) = self.radius {
            out[0] = ux.square() + uy.square() - radius.square();
        }
        for (value, [gx, gy, e]) in out[self.first()..3].iter_mut().zip(&self.rows) {
            *value = gx.at(*c, *s) * *ux + gy.at(*c, *s) * *uy + e.at(*c, *s);
        }
        out[3] = c.square() + s.square() - Interval::ONE;
        out
    }

    fn derivatives(&self, [ux, uy, c, s]: &Region<4>) -> [[Interval; 4]; 4] {
        let mut out = [[Interval::ZERO; 4]; 4];
        out[0] = [ux.scale(1), uy.scale(1), Interval::ZERO, Interval::ZERO];
        for (slopes, [gx, gy, e]) in out[self.first()..3].iter_mut().zip(&self.rows) {
            let by_c = gx.by_c * *ux + gy.by_c * *uy + e.by_c;
            let by_s = gx.by_s * *ux + gy.by_s * *uy + e.by_s;
            *slopes = [gx.at(*c, *s), gy.at(*c, *s), by_c, by_s];
        }
        out[3] = [Interval::ZERO, Interval::ZERO, c.scale(1), s.scale(1)];
        out
    }
}
