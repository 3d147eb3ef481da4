//! Triads of one shape by the block: the fast route of [`super::real_modes`], each step a loop over all triads of the block, or over a number of roots.
//!
//! Numbers stand in columns, one for each triad or root, and compilers turn the loops into SIMD instructions. Formulas, and the order of operations, are
//! those of one triad alone, so that results are the same to the last bit.

// Loops over columns read and write several at one place; counted ones become SIMD instructions, chains of iterators as a rule do not.
#![allow(clippy::needless_range_loop)]

use super::closure_row::{ClosureRow, closure_row};
use super::columns::{Column, Kind, LegColumns, each_leg};
use super::group::{Dyad, Offset, Triad};
use super::local::{COSINES, LEG_ORDERS, SINES, own_length, power_of_two, reference_leg, roundings, sort};
use super::poses::{Approach, LAST_STEP, Measured, STEPS, best_crossing, crossing, measure, principal, sound};
use super::real_modes::MOST_MODES;
use super::triad::{LegNumbers, Row, Rows, leg_row, rows_consistency};
use crate::algebra::{Bounded, Gaussian, Lanes, Ring};
use crate::roots::{HarmonicBlock, RootColumns, RootQueue};

/// Triads in a block, and roots worked on together: as many as keep their numbers near the processor.
pub(super) const BLOCK: usize = 32;
const CHUNK: usize = 32;
/// Loops over triads run over a multiple of this many places, whole registers; those over roots over a multiple of four. How often they run is not known to the compiler: it would unroll them all, which takes minutes.
pub(super) const ABREAST: usize = 8;
/// Room for all roots of a block.
const ROOM: usize = BLOCK * MOST_MODES;

/// What triads of a block have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Shape {
    /// Kinds of the legs in the order given.
    kinds: [Kind; 3],
    /// Whose offset is given as a distance.
    distances: [bool; 3],
    /// The leg from which all is seen.
    reference: usize,
}

impl Shape {
    /// The shape of a triad; `None` with a PP leg.
    #[inline(always)]
    pub(super) fn of(triad: &Triad) -> Option<Self> {
        let kind = |leg: &Dyad| match leg {
            Dyad::RR { .. } => Some((Kind::Circle, false)),
            Dyad::PR { .. } => Some((Kind::Line, false)),
            Dyad::RP { offset, .. } => Some((Kind::PlatformLine, matches!(offset, Offset::Distance(_)))),
            Dyad::PP { .. } => None,
        };
        let [first, second, third] = triad.legs();
        let [first, second, third] = [kind(first)?, kind(second)?, kind(third)?];
        Some(Self {
            kinds: [first.0, second.0, third.0],
            distances: [first.1, second.1, third.1],
            reference: reference_leg(triad.legs()),
        })
    }
}

/// A leg as it is given: `a`, `b`, a direction, and length or offset.
type Given = [Column<BLOCK>; 7];

/// Triads of a block, each seen from its reference leg, lengths in units of a power of two; see [`super::local::Local`].
struct Locals {
    given: [Given; 3],
    legs: [LegColumns<BLOCK>; 3],
    unit: Column<BLOCK>,
    size: Column<BLOCK>,
    /// Rows of the legs at an angle: `g` and `e`.
    rows: [[Column<BLOCK>; 3]; 3],
    /// `T` at eight angles, and a bound on its rounding errors.
    values: [Column<BLOCK>; 8],
    bound: Column<BLOCK>,
}

#[inline(always)]
fn larger(x: f64, y: f64) -> f64 {
    if x > y { x } else { y }
}

#[inline(always)]
fn row_of<const N: usize>([x, y, e]: &[Column<N>; 3], i: usize) -> Row<f64> {
    Row { g: Gaussian::new(x[i], y[i]), e: e[i] }
}

#[inline(always)]
fn put_row<const N: usize>([x, y, e]: &mut [Column<N>; 3], i: usize, row: &Row<f64>) {
    (x[i], y[i], e[i]) = (row.g.re, row.g.im, row.e);
}

/// `T` from the rows of triads with an RR leg, of this length, or without.
#[inline(always)]
fn consistency_of<R: Ring>(first: Kind, radius: R, [p, q, r]: [Row<R>; 3]) -> R {
    match first {
        Kind::Circle => rows_consistency(&Rows::Circle { radius, rows: [q, r] }),
        _ => rows_consistency(&Rows::Lines([p, q, r])),
    }
}

impl Locals {
    const EMPTY: Self = Self {
        given: [[[0.0; BLOCK]; 7]; 3],
        legs: [LegColumns::EMPTY; 3],
        unit: [0.0; BLOCK],
        size: [0.0; BLOCK],
        rows: [[[0.0; BLOCK]; 3]; 3],
        values: [[0.0; BLOCK]; 8],
        bound: [0.0; BLOCK],
    };

    /// Takes the numbers as they are given, and gives how many places are filled.
    #[inline(always)]
    fn take(&mut self, triads: &[&Triad], order: [usize; 3]) -> usize {
        let filled = triads.len().next_multiple_of(ABREAST).min(BLOCK);
        for i in 0..filled {
            // The last triad fills up the last register.
            let legs = triads[i.min(triads.len() - 1)].legs();
            for (given, leg) in self.given.iter_mut().zip(order) {
                let (a, b, x, y, own) = match legs[leg] {
                    Dyad::RR { a, b, length } => (a, b, 0.0, 0.0, length),
                    Dyad::PR { a, u, b } => (a, b, u.x, u.y, 0.0),
                    Dyad::RP { a, b, v, offset: Offset::Distance(own) | Offset::TimesDirection(own) } => {
                        (a, b, v.x, v.y, own)
                    }
                    Dyad::PP { .. } => unreachable!("a shape has no PP leg"),
                };
                let [g0, g1, g2, g3, g4, g5, g6] = given;
                (g0[i], g1[i], g2[i], g3[i], g4[i], g5[i], g6[i]) = (a.x, a.y, b.x, b.y, x, y, own);
            }
        }
        filled
    }

    /// Sees all from the reference legs; a bit for each triad whose numbers are in range.
    #[inline(always)]
    fn localise(&mut self, shape: Shape, order: [usize; 3], filled: usize) -> u64 {
        let filled = filled.min(BLOCK);
        let given = &self.given;
        let [a0x, a0y, b0x, b0y, ..] = &given[0];
        let zero = [a0x, a0y, b0x, b0y];
        let mut largest = [0.0; BLOCK];
        for (given, leg) in given.iter().zip(order) {
            for j in 0..4 {
                for i in 0..filled {
                    largest[i] = larger((given[j][i] - zero[j][i]).abs(), largest[i]);
                }
            }
            if shape.kinds[leg] == Kind::Circle || shape.distances[leg] {
                for i in 0..filled {
                    largest[i] = larger(given[6][i].abs(), largest[i]);
                }
            }
        }
        let (mut good, mut inverse) = ([0; BLOCK], [0.0; BLOCK]);
        for i in 0..filled {
            let (unit, inside) = power_of_two(largest[i]);
            (self.unit[i], good[i], inverse[i]) = (unit, u64::from(inside), 1.0 / unit);
        }
        for ((to, given), leg) in self.legs.iter_mut().zip(given).zip(order) {
            to.kind = shape.kinds[leg];
            let to = &mut to.numbers;
            for j in 0..4 {
                for i in 0..filled {
                    to[j][i] = (given[j][i] - zero[j][i]) * inverse[i];
                }
            }
            if shape.kinds[leg] == Kind::Circle {
                for i in 0..filled {
                    to[4][i] = given[6][i] * inverse[i];
                }
                continue;
            }
            for i in 0..filled {
                let (own, inside) = power_of_two(larger(given[4][i].abs(), given[5][i].abs()));
                good[i] &= u64::from(inside);
                let own = 1.0 / own;
                let (x, y) = (given[4][i] * own, given[5][i] * own);
                let delta = given[6][i] * inverse[i];
                // With the direction scaled first, nothing leaves the range on the way.
                let delta = if shape.distances[leg] { delta * x.hypot(y) } else { delta * own };
                (to[4][i], to[5][i], to[6][i]) = (-y, x, delta);
            }
        }
        let mut in_range = 0;
        for (i, good) in good.iter().enumerate().take(filled) {
            in_range |= good << i;
        }
        in_range
    }

    /// The largest length of each triad: distances of base points, of platform points, leg lengths and offsets.
    #[inline(always)]
    fn measure_sizes(&mut self, filled: usize) {
        let filled = filled.min(BLOCK);
        let [mut apart, mut own] = [[0.0; BLOCK]; 2];
        for (k, leg) in self.legs.iter().enumerate() {
            for other in &self.legs[..k] {
                for i in 0..filled {
                    for at in [0, 2] {
                        apart[i] = larger((leg.point(at, i) - other.point(at, i)).norm_sqr(), apart[i]);
                    }
                }
            }
            each_leg!(leg, filled, |i, leg| own[i] = larger(own_length(&leg), own[i]));
        }
        for i in 0..filled {
            self.size[i] = larger(own[i], apart[i].sqrt());
        }
    }

    /// `T` of each triad at eight angles, and a bound on its rounding errors.
    #[inline(always)]
    fn evaluate(&mut self, roundings: u32, filled: usize) {
        let filled = filled.min(BLOCK);
        let Self { legs, rows, values, bound, .. } = self;
        let radius = &legs[0].numbers[4];
        let first = legs[0].kind;
        // A reference circle is no row.
        let rows_from = usize::from(first == Kind::Circle);
        for (angle, values) in values.iter_mut().enumerate() {
            let (c, s) = (COSINES[angle], SINES[angle]);
            for (leg, rows) in legs.iter().zip(rows.iter_mut()).skip(rows_from) {
                each_leg!(leg, filled, |i, leg| put_row(rows, i, &leg_row(&leg, &radius[i], &c, &s)));
            }
            for i in 0..filled {
                values[i] =
                    consistency_of(first, radius[i], [row_of(&rows[0], i), row_of(&rows[1], i), row_of(&rows[2], i)]);
            }
        }
        // The same formulas over sizes.
        let one = Bounded::rounded(1.0);
        let mut counted = [[0; 3]; 3];
        for ((leg, rows), counted) in legs.iter().zip(rows.iter_mut()).zip(&mut counted).skip(rows_from) {
            each_leg!(leg, filled, |i, leg| {
                let leg = leg.map(|&x| Bounded::rounded_times(x, roundings));
                let Row { g, e } = leg_row(&leg, &Bounded::rounded_times(radius[i], roundings), &one, &one);
                *counted = [g.re.roundings(), g.im.roundings(), e.roundings()];
                put_row(rows, i, &Row { g: Gaussian::new(g.re.size(), g.im.size()), e: e.size() });
            });
        }
        let sized = |row: Row<f64>, [x, y, e]: [u32; 3]| Row {
            g: Gaussian::new(Bounded::rounded_times(row.g.re, x), Bounded::rounded_times(row.g.im, y)),
            e: Bounded::rounded_times(row.e, e),
        };
        for i in 0..filled {
            let (p, q) = (sized(row_of(&rows[0], i), counted[0]), sized(row_of(&rows[1], i), counted[1]));
            let r = sized(row_of(&rows[2], i), counted[2]);
            bound[i] = consistency_of(first, Bounded::rounded_times(radius[i], roundings), [p, q, r]).error();
        }
    }
}

/// Roots and the triads they belong to, on the way to poses.
struct Chunk {
    legs: [LegColumns<CHUNK>; 3],
    /// Unit, size, base and platform point of the reference leg.
    frame: [Column<CHUNK>; 6],
    rows: [[Column<CHUNK>; 3]; 3],
    /// Place, direction, turns and step: an [`Approach`] each.
    approach: [Column<CHUNK>; 7],
    /// A [`ClosureRow`], and later what is [`Measured`], for each leg.
    closure: [[Column<CHUNK>; 4]; 3],
    pose: [Column<CHUNK>; 3],
    sound: [u32; CHUNK],
}

#[inline(always)]
fn gather(from: &Column<BLOCK>, owners: &[u32], to: &mut Column<CHUNK>) {
    for (to, &owner) in to.iter_mut().zip(owners) {
        *to = from[owner as usize % BLOCK];
    }
}

#[inline(always)]
fn one<const N: usize>(column: &Column<N>, k: usize) -> Lanes<1> {
    Lanes([column[k]])
}

#[inline(always)]
fn approach_of(c: &[Column<CHUNK>; 7], k: usize) -> Approach<1> {
    let [ux, uy, x, y, turned, largest_turn, step] = c;
    Approach {
        u: Gaussian::new(one(ux, k), one(uy, k)),
        c: one(x, k),
        s: one(y, k),
        turned: one(turned, k),
        largest_turn: one(largest_turn, k),
        step: one(step, k),
    }
}

#[inline(always)]
fn put_approach(c: &mut [Column<CHUNK>; 7], k: usize, at: &Approach<1>) {
    let [ux, uy, x, y, turned, largest_turn, step] = c;
    (ux[k], uy[k], x[k], y[k]) = (at.u.re.0[0], at.u.im.0[0], at.c.0[0], at.s.0[0]);
    (turned[k], largest_turn[k], step[k]) = (at.turned.0[0], at.largest_turn.0[0], at.step.0[0]);
}

#[inline(always)]
fn put_four(c: &mut [Column<CHUNK>; 4], k: usize, numbers: [Lanes<1>; 4]) {
    let [c0, c1, c2, c3] = c;
    (c0[k], c1[k], c2[k], c3[k]) = (numbers[0].0[0], numbers[1].0[0], numbers[2].0[0], numbers[3].0[0]);
}

#[inline(always)]
fn closure_of(c: &[Column<CHUNK>; 4], k: usize) -> ClosureRow<Lanes<1>> {
    ClosureRow { value: one(&c[0], k), force: Gaussian::new(one(&c[1], k), one(&c[2], k)), moment: one(&c[3], k) }
}

#[inline(always)]
fn measured_of(c: &[Column<CHUNK>; 4], k: usize) -> Measured<1> {
    Measured { miss: one(&c[0], k), force: Gaussian::new(one(&c[1], k), one(&c[2], k)), moment: one(&c[3], k) }
}

impl Chunk {
    const EMPTY: Self = Self {
        legs: [LegColumns::EMPTY; 3],
        frame: [[0.0; CHUNK]; 6],
        rows: [[[0.0; CHUNK]; 3]; 3],
        approach: [[0.0; CHUNK]; 7],
        closure: [[[0.0; CHUNK]; 4]; 3],
        pose: [[0.0; CHUNK]; 3],
        sound: [0; CHUNK],
    };

    /// The poses above the first `count` roots, a multiple of four.
    #[inline(always)]
    fn find_poses(&mut self, locals: &Locals, owners: &[u32], roots: &RootColumns<CHUNK>, count: usize) {
        let count = count.min(CHUNK);
        let Self { legs, frame, rows, approach, closure, pose, sound: is_sound } = self;
        for (to, from) in legs.iter_mut().zip(&locals.legs) {
            to.kind = from.kind;
            for (to, from) in to.numbers.iter_mut().zip(&from.numbers).take(from.kind.numbers()) {
                gather(from, owners, to);
            }
        }
        let [a0x, a0y, b0x, b0y, ..] = &locals.given[0];
        for (to, from) in frame.iter_mut().zip([&locals.unit, &locals.size, a0x, a0y, b0x, b0y]) {
            gather(from, owners, to);
        }
        let first = legs[0].kind;
        let radius = &legs[0].numbers[4];
        for (leg, rows) in legs.iter().zip(rows.iter_mut()).skip(usize::from(first == Kind::Circle)) {
            each_leg!(leg, count, |k, leg| {
                put_row(rows, k, &leg_row(&leg, &radius[k], &roots.cosine[k], &roots.sine[k]));
            });
        }
        let row = |row: Row<f64>| Row { g: Gaussian::new(Lanes([row.g.re]), Lanes([row.g.im])), e: Lanes([row.e]) };
        for k in 0..count {
            let (q, r) = (row(row_of(&rows[1], k)), row(row_of(&rows[2], k)));
            let u = match first {
                Kind::Circle => crossing(&q, &r).1,
                _ => best_crossing(&[row(row_of(&rows[0], k)), q, r]),
            };
            put_approach(approach, k, &Approach::begin(u, one(&roots.cosine, k), one(&roots.sine, k)));
        }
        for (leg, closure) in legs.iter().zip(closure.iter_mut()) {
            each_leg!(leg, count, |k, leg| {
                let at = approach_of(approach, k);
                let ClosureRow { value, force, moment } = closure_row(&leg, |x| Lanes([x]), at.u, at.c, at.s);
                put_four(closure, k, [value, force.re, force.im, moment]);
            });
        }
        for k in 0..count {
            let mut at = approach_of(approach, k);
            at.step(&[closure_of(&closure[0], k), closure_of(&closure[1], k), closure_of(&closure[2], k)]);
            put_approach(approach, k, &at);
        }
        // Few need more.
        for k in 0..count {
            if approach[6][k] > LAST_STEP {
                let mut at = approach_of(approach, k);
                let own = [legs[0].leg(k), legs[1].leg(k), legs[2].leg(k)];
                for _ in 1..STEPS {
                    let (u, c, s) = (at.u, at.c, at.s);
                    let row = |leg: &LegNumbers<f64>| closure_row(leg, |x| Lanes([x]), u, c, s);
                    at.step(&[row(&own[0]), row(&own[1]), row(&own[2])]);
                    if at.step.0[0] <= LAST_STEP {
                        break;
                    }
                }
                put_approach(approach, k, &at);
            }
        }
        for (leg, measured) in legs.iter().zip(closure.iter_mut()) {
            each_leg!(leg, count, |k, leg| {
                let at = approach_of(approach, k);
                let Measured { miss, force, moment } = Measured::of(&leg, |x| Lanes([x]), at.u, at.direction());
                put_four(measured, k, [miss, force.re, force.im, moment]);
            });
        }
        let [unit, size, ax, ay, bx, by] = &*frame;
        let [to_x, to_y, to_phi] = pose;
        for k in 0..count {
            let at = approach_of(approach, k);
            let [residual, _, regular] =
                measure(&[measured_of(&closure[0], k), measured_of(&closure[1], k), measured_of(&closure[2], k)]);
            let root = roots.root(k);
            is_sound[k] = sound(&at, &root, residual * (Lanes([1.0]) / one(size, k)), regular);
            let Gaussian { re: c, im: s } = at.direction();
            let (bx, by, unit) = (one(bx, k), one(by, k), one(unit, k));
            let x = one(ax, k) + at.u.re * unit - (c * bx - s * by);
            let y = one(ay, k) + at.u.im * unit - (s * bx + c * by);
            let phi = principal(root.angle + at.turned);
            (to_x[k], to_y[k], to_phi[k]) = (x.0[0], y.0[0], phi.0[0]);
        }
    }
}

/// Solves blocks, one after the other, and holds what the last one came to.
pub(super) struct BlockSolver {
    /// `x, y, phi` of each mode, sorted by `phi`.
    pub(super) poses: [[[f64; 3]; MOST_MODES]; BLOCK],
    pub(super) counts: [u8; BLOCK],
    /// A bit for each triad that the bounds did not decide.
    pub(super) undecided: u64,
    harmonics: HarmonicBlock<BLOCK>,
    queue: RootQueue<ROOM>,
}

impl BlockSolver {
    pub(super) fn new() -> Self {
        Self {
            poses: [[[0.0; 3]; MOST_MODES]; BLOCK],
            counts: [0; BLOCK],
            undecided: 0,
            harmonics: HarmonicBlock::EMPTY,
            queue: RootQueue::default(),
        }
    }

    /// Solves a block of triads of one shape, whose `T` has this order.
    #[inline(always)]
    pub(super) fn solve(&mut self, triads: &[&Triad], shape: Shape, order: usize) {
        const { assert!(BLOCK < 64, "a bit for each triad") };
        let Self { poses, counts, undecided, harmonics, queue } = self;
        // On the stack: that they do not overlap is plain to the compiler, which vectorises the loops then.
        let mut locals = Locals::EMPTY;
        let count = triads.len();
        let legs = LEG_ORDERS[shape.reference];
        let filled = locals.take(triads, legs);
        let in_range = locals.localise(shape, legs, filled);
        locals.measure_sizes(filled);
        locals.evaluate(roundings(shape.distances.contains(&true)), filled);
        harmonics.put_samples(&locals.values, order, &locals.bound, filled);
        queue.clear();
        *undecided = harmonics.isolate(count, queue) | !in_range & ((1 << count) - 1);
        *counts = [0; BLOCK];
        let (mut roots, mut chunk) = (RootColumns::EMPTY, Chunk::EMPTY);
        for first in (0..queue.len()).step_by(CHUNK) {
            let filled = queue.find(first, &mut roots);
            let owners = &queue.owners()[first..first + filled];
            chunk.find_poses(&locals, owners, &roots, filled);
            for k in 0..(queue.len() - first).min(CHUNK) {
                let owner = owners[k] as usize % BLOCK;
                debug_assert!(usize::from(counts[owner]) < MOST_MODES, "a form of degree 6 has six roots");
                // The remainders change nothing; they spare checks of bounds.
                let at = usize::from(counts[owner]) % MOST_MODES;
                poses[owner][at] = [chunk.pose[0][k], chunk.pose[1][k], chunk.pose[2][k]];
                counts[owner] += 1;
                *undecided |= u64::from(chunk.sound[k] ^ 1) << owner;
            }
        }
        for (poses, &count) in poses.iter_mut().zip(counts.iter()).take(count) {
            // Roots lie in cells of their own: no two have the same angle.
            sort(&mut poses[..usize::from(count).min(MOST_MODES)], |pose| pose[2]);
        }
    }
}
