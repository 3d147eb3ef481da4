//! A triad seen from its reference leg, lengths in units of a power of two: what the fast route works on.

use super::group::{Dyad, Offset, Triad};
use super::triad::{LegNumbers, Row, Rows, leg_row, rows_consistency};
use crate::algebra::{Bounded, Gaussian, Lanes, Ring};

/// Lengths are taken in units of a power of two; beyond these exponents underflow would not be covered by the bound.
const EXPONENTS: std::ops::RangeInclusive<i64> = -300..=300;

const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Cosines and sines of the multiples of a quarter of pi, each rounded once.
pub(super) const COSINES: [f64; 8] = [1.0, HALF, 0.0, -HALF, -1.0, -HALF, 0.0, HALF];
pub(super) const SINES: [f64; 8] = [0.0, HALF, 1.0, HALF, 0.0, -HALF, -1.0, -HALF];

/// The legs, those of the reference first, by the number of that.
pub(super) const LEG_ORDERS: [[usize; 3]; 3] = [[0, 1, 2], [1, 0, 2], [2, 0, 1]];

/// A triad seen from its reference leg, lengths in units of a power of two.
pub(super) struct Local {
    /// The reference leg first; `alpha` and `beta` are rounded once.
    pub(super) legs: [LegNumbers<f64>; 3],
    /// How often any of these numbers was rounded.
    pub(super) roundings: u32,
    pub(super) order: usize,
    /// 1, or -1 where the legs are in an odd permutation of the order given.
    pub(super) parity: f64,
    /// The unit of length, and the group's size in it.
    pub(super) unit: f64,
    pub(super) size: f64,
    /// Base and platform point of the reference leg.
    pub(super) a0: [f64; 2],
    pub(super) b0: [f64; 2],
}

/// The shortest RR leg, or else the first leg.
#[inline(always)]
pub(super) fn reference_leg(legs: &[Dyad; 3]) -> usize {
    let length = |i: usize| match legs[i] {
        Dyad::RR { length, .. } => length,
        _ => f64::INFINITY,
    };
    let mut reference = usize::from(length(1) < length(0));
    if length(2) < length(reference) {
        reference = 2;
    }
    reference
}

/// How often any number of a leg was rounded, at most. An offset given as a distance takes a square root of a sum, a product, and the rounding that the exact
/// route begins with.
pub(super) fn roundings(has_distance: bool) -> u32 {
    if has_distance { 4 } else { 1 }
}

impl Local {
    #[inline(always)]
    pub(super) fn of(triad: &Triad) -> Option<Self> {
        let legs = triad.legs();
        let reference = reference_leg(legs);
        let sorted = LEG_ORDERS[reference];
        let parity = if reference == 1 { -1.0 } else { 1.0 };
        let (a0, b0) = points(&legs[reference])?;
        let (mut largest, mut has_distance) = (0.0f64, false);
        for leg in legs {
            let (a, b) = points(leg)?;
            let own = match *leg {
                Dyad::RR { length, .. } => length,
                Dyad::RP { offset: Offset::Distance(d), .. } => {
                    has_distance = true;
                    d.abs()
                }
                _ => 0.0,
            };
            for x in [own, a[0] - a0[0], a[1] - a0[1], b[0] - b0[0], b[1] - b0[1]] {
                largest = largest.max(x.abs());
            }
        }
        let (unit, true) = power_of_two(largest) else { return None };
        let inverse = 1.0 / unit;
        let leg = |k: usize| local_leg(&legs[sorted[k]], a0, b0, inverse);
        let legs = [leg(0)?, leg(1)?, leg(2)?];
        let (size, roundings) = (size(&legs), roundings(has_distance));
        Some(Self { legs, roundings, order: triad.order()?, parity, unit, size, a0, b0 })
    }

    /// `T` at eight angles, and a bound on its rounding errors.
    #[inline(always)]
    pub(super) fn values(&self) -> ([f64; 8], f64) {
        let unit = Bounded::rounded(1.0);
        let bound = rows_consistency(&rows(&self.legs, |x| Bounded::rounded_times(x, self.roundings), unit, unit));
        let values = rows_consistency(&rows(&self.legs, Lanes::<8>::all, Lanes(COSINES), Lanes(SINES)));
        (values.0, bound.error())
    }
}

/// The rows of a triad over another ring. Each kind of leg is told apart before its numbers are spread, which the compiler does not do by itself.
#[inline(always)]
pub(super) fn rows<R: Ring + Copy>(
    legs: &[LegNumbers<f64>; 3],
    number: impl Fn(f64) -> R + Copy,
    c: R,
    s: R,
) -> Rows<R> {
    match legs[0] {
        LegNumbers::Circle { length, .. } => {
            let radius = number(length);
            Rows::Circle { radius, rows: [row(&legs[1], radius, number, c, s), row(&legs[2], radius, number, c, s)] }
        }
        _ => {
            let none = R::zero();
            Rows::Lines([
                row(&legs[0], none, number, c, s),
                row(&legs[1], none, number, c, s),
                row(&legs[2], none, number, c, s),
            ])
        }
    }
}

#[inline(always)]
fn row<R: Ring + Copy>(leg: &LegNumbers<f64>, radius: R, number: impl Fn(f64) -> R + Copy, c: R, s: R) -> Row<R> {
    let point = |p: Gaussian<f64>| Gaussian::new(number(p.re), number(p.im));
    match *leg {
        LegNumbers::Circle { alpha, beta, length } => {
            let leg = LegNumbers::Circle { alpha: point(alpha), beta: point(beta), length: number(length) };
            leg_row(&leg, &radius, &c, &s)
        }
        LegNumbers::Line { alpha, beta, normal } => {
            let leg = LegNumbers::Line { alpha: point(alpha), beta: point(beta), normal: point(normal) };
            leg_row(&leg, &radius, &c, &s)
        }
        LegNumbers::PlatformLine { alpha, beta, normal, delta } => {
            let (alpha, beta, normal) = (point(alpha), point(beta), point(normal));
            leg_row(&LegNumbers::PlatformLine { alpha, beta, normal, delta: number(delta) }, &radius, &c, &s)
        }
    }
}

/// The power of two at or below `x`, and whether it is in the range that bounds cover; else some number, also for zero.
#[inline(always)]
pub(super) fn power_of_two(x: f64) -> (f64, bool) {
    let exponent = ((x.to_bits() >> 52) & 0x7ff) as i64 - 1023;
    let inside = (exponent >= *EXPONENTS.start()) & (exponent <= *EXPONENTS.end());
    let power = f64::from_bits(x.to_bits() & (0x7ff << 52));
    (if inside { power } else { 1.0 }, inside)
}

/// Base and platform point of a leg.
#[inline(always)]
fn points(leg: &Dyad) -> Option<([f64; 2], [f64; 2])> {
    match leg {
        Dyad::RR { a, b, .. } | Dyad::PR { a, b, .. } | Dyad::RP { a, b, .. } => Some(([a.x, a.y], [b.x, b.y])),
        Dyad::PP { .. } => None,
    }
}

#[inline(always)]
fn local_leg(leg: &Dyad, a0: [f64; 2], b0: [f64; 2], inverse: f64) -> Option<LegNumbers<f64>> {
    let (a, b) = points(leg)?;
    let less = |p: [f64; 2], q: [f64; 2]| Gaussian::new((p[0] - q[0]) * inverse, (p[1] - q[1]) * inverse);
    let (alpha, beta) = (less(a, a0), less(b, b0));
    let scaled = |x: f64, y: f64| {
        let (own, true) = power_of_two(x.abs().max(y.abs())) else { return None };
        let own = 1.0 / own;
        Some((x * own, y * own, own))
    };
    Some(match *leg {
        Dyad::RR { length, .. } => LegNumbers::Circle { alpha, beta, length: length * inverse },
        Dyad::PR { u, .. } => {
            let (x, y, _) = scaled(u.x, u.y)?;
            LegNumbers::Line { alpha, beta, normal: Gaussian::new(-y, x) }
        }
        Dyad::RP { v, offset, .. } => {
            let (x, y, own) = scaled(v.x, v.y)?;
            let delta = match offset {
                Offset::TimesDirection(delta) => delta * inverse * own,
                // With the direction scaled first, nothing leaves the range on the way.
                Offset::Distance(d) => d * inverse * x.hypot(y),
            };
            LegNumbers::PlatformLine { alpha, beta, normal: Gaussian::new(-y, x), delta }
        }
        Dyad::PP { .. } => return None,
    })
}

/// A leg's own length, or its line's distance.
#[inline(always)]
pub(super) fn own_length(leg: &LegNumbers<f64>) -> f64 {
    match leg {
        LegNumbers::Circle { length, .. } => *length,
        LegNumbers::Line { .. } => 0.0,
        LegNumbers::PlatformLine { normal, delta, .. } => delta.abs() / normal.norm_sqr().sqrt(),
    }
}

/// The largest length among the legs: distances of base points, of platform points, leg lengths and offsets.
#[inline(always)]
fn size(legs: &[LegNumbers<f64>; 3]) -> f64 {
    let points = |leg: &LegNumbers<f64>| match *leg {
        LegNumbers::Circle { alpha, beta, .. }
        | LegNumbers::Line { alpha, beta, .. }
        | LegNumbers::PlatformLine { alpha, beta, .. } => [alpha, beta],
    };
    let all = [points(&legs[0]), points(&legs[1]), points(&legs[2])];
    let (mut apart, mut own) = (0.0f64, own_length(&legs[0]));
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        apart = apart.max((all[i][0] - all[j][0]).norm_sqr()).max((all[i][1] - all[j][1]).norm_sqr());
        own = own.max(own_length(&legs[j]));
    }
    own.max(apart.sqrt())
}

/// Sorts few that are nearly sorted.
#[inline(always)]
pub(super) fn sort<T: Copy>(all: &mut [T], key: impl Fn(&T) -> f64) {
    for i in 1..all.len() {
        let own = all[i];
        let mut at = i;
        while at > 0 && key(&all[at - 1]) > key(&own) {
            all[at] = all[at - 1];
            at -= 1;
        }
        all[at] = own;
    }
}
