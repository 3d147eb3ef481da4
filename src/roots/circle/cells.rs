//! The form over sixteen cells of directions, and which of them hold one root.
//!
//! Table and formula are the same for one polynomial, whose cells lie side by side, and for several, which lie side by side cell by cell.

use std::array::from_fn;
use std::f64::consts::PI;
use std::sync::LazyLock;

use super::queue::RootQueue;
use super::{DEGREE, FORM, Harmonics, MARGIN, UNIT};
use crate::algebra::{Interval, Lanes};

/// The cells are turned by this angle, in radians, so that right angles and Pythagorean ones of small numbers, which people choose for
/// mechanisms, do not fall on their ends.
const TURN: f64 = 0.083_7;

/// Halvings of a cell: beyond, roots lie closer together than `2⁻⁴⁰` and `f64` had better not decide.
const MAX_DEPTH: u32 = 40;

/// A polynomial whose coefficients add up to a number outside is left to exact arithmetic: underflow would not be covered.
const RANGE: std::ops::RangeInclusive<f64> = 1e-150..=1e150;

/// Cells between 0 and a right angle; and the sides of the circle, to which they are turned and mirrored by changes of sign.
pub(super) const QUARTER: usize = 4;
const SIDES: usize = 4;
/// Cells in all.
pub(super) const CELLS: usize = QUARTER * SIDES;

/// A quarter of a cell's width, in radians.
pub(super) const STEP: f64 = PI / 32.0;

/// Bernstein coefficients of the seven functions over the four cells between 0 and a right angle.
pub(super) struct Table {
    /// `[j][f][l]`: coefficient `j` of function `f` over cell `l`; functions 1, cos 2phi, sin 2phi, cos phi, cos 3phi, sin phi, sin 3phi.
    pub(super) coefficients: [[Lanes<QUARTER>; 7]; FORM],
    /// Where each of the sixteen cells lies, in the order of [`ORDER`].
    pub(super) places: [CellPlace; CELLS],
    /// Cosine and sine of one, two and three times the turn.
    pub(super) turns: [[f64; 2]; 3],
    /// Tangent of a quarter of a cell's width.
    pub(super) tangent: f64,
}

/// The middle of a cell.
#[derive(Clone, Copy)]
pub(super) struct CellPlace {
    pub(super) angle: f64,
    pub(super) cosine: f64,
    pub(super) sine: f64,
    /// 1, or -1 where the cell is run through clockwise.
    pub(super) sense: f64,
}

/// Sides are the angle itself, less pi, negated, and pi less it; cells go up with the angle, so that roots come sorted, as a rule.
const ORDER: [(usize, usize); CELLS] = [
    (1, 0),
    (1, 1),
    (1, 2),
    (1, 3),
    (2, 3),
    (2, 2),
    (2, 1),
    (2, 0),
    (0, 0),
    (0, 1),
    (0, 2),
    (0, 3),
    (3, 3),
    (3, 2),
    (3, 1),
    (3, 0),
];

pub(super) static TABLE: LazyLock<Table> = LazyLock::new(Table::new);

/// Cosine and sine, each within two units of `2^-53`, whatever the platform's library does.
fn direction(angle: f64) -> [f64; 2] {
    Interval::cos_sin(angle).map(Interval::middle)
}

/// `(n choose k)`, zero where `k` is out of range.
fn binomial(n: i32, k: i32) -> f64 {
    if k < 0 || k > n { 0.0 } else { (0..k).fold(1.0, |c, i| c * f64::from(n - i) / f64::from(i + 1)) }
}

impl Table {
    /// The blossom of `e^(ik phi)`, of degree 6 in `(x : y)`, at `j` times the end and `6 - j` times the start of a cell, is an average of
    /// `e^(i m STEP)`, `m` integers: of modulus at most 1.
    fn new() -> Self {
        let function = |j: i32, k: i32, l: i32| {
            let terms = (0..=j).map(|i| {
                let weight = binomial(3 + k, i) * binomial(3 - k, j - i) / binomial(6, j);
                let turns = 2 * k * (2 * l + 1) + 4 * i - 2 * k - 2 * j;
                let [cosine, sine] = direction(f64::from((turns + 31).rem_euclid(64) - 31) * STEP);
                [weight * cosine, weight * sine]
            });
            terms.fold([0.0; 2], |sum, term| [sum[0] + term[0], sum[1] + term[1]])
        };
        // Frequency, and 0 for cosine, 1 for sine.
        let functions = [(0, 0), (2, 0), (2, 1), (1, 0), (3, 0), (1, 1), (3, 1)];
        let place = |(side, l): (usize, usize)| {
            let own = STEP * (4 * l + 2) as f64;
            let (sense, angle) = match side {
                0 => (1.0, own),
                1 => (1.0, own - PI),
                2 => (-1.0, -own),
                _ => (-1.0, PI - own),
            };
            let angle = angle + TURN;
            let [cosine, sine] = direction(angle);
            CellPlace { angle, cosine, sine, sense }
        };
        Self {
            coefficients: from_fn(|j| {
                functions.map(|(k, part): (i32, usize)| Lanes(from_fn(|l| function(j as i32, k, l as i32)[part])))
            }),
            places: ORDER.map(place),
            turns: [1.0, 2.0, 3.0].map(|k| direction(k * TURN)),
            tangent: STEP.tan(),
        }
    }
}

/// A polynomial turned to the cells, with the bound on the errors of all coefficients of its form.
#[derive(Clone, Copy)]
pub(super) struct Turned {
    /// `a_0`, then coefficients of the cosine and sine of one, two and three times the angle.
    pub(super) waves: [f64; 7],
    pub(super) error: f64,
    /// Whether underflow and overflow are out of the question, and the bound is a number.
    pub(super) in_range: bool,
}

impl Turned {
    #[inline(always)]
    pub(super) fn of(t: &Harmonics, turns: &[[f64; 2]; 3]) -> Self {
        let mut waves = [t.cosines[0], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let mut sum = t.cosines[0].abs();
        for k in 0..3 {
            let ([c, s], a, b) = (turns[k], t.cosines[k + 1], t.sines[k]);
            waves[2 * k + 1] = a * c + b * s;
            waves[2 * k + 2] = b * c - a * s;
            sum += a.abs() + b.abs();
        }
        // Step 4 of the derivation: 6 roundings for the turn, 24 · sqrt 2 for the table and the sums.
        let error = (t.error + 41.0 * UNIT * sum) * MARGIN;
        Self { waves, error, in_range: (sum >= *RANGE.start()) & (sum <= *RANGE.end()) & error.is_finite() }
    }
}

/// Coefficient `j` on the four sides, from the seven functions' coefficients and the polynomial's.
#[inline(always)]
pub(super) fn on_sides<const M: usize>(
    [one, c2, s2, c1, c3, s1, s3]: [Lanes<M>; 7],
    [constant, a1, b1, a2, b2, a3, b3]: [Lanes<M>; 7],
) -> [Lanes<M>; SIDES] {
    let (even_cosines, even_sines) = (one * constant + c2 * a2, s2 * b2);
    let odd_cosines = c1 * a1 + c3 * a3;
    let odd_sines = s1 * b1 + s3 * b3;
    let (even, odd) = (even_cosines + even_sines, odd_cosines + odd_sines);
    let (mirrored_even, mirrored_odd) = (even_cosines - even_sines, odd_cosines - odd_sines);
    [even + odd, even - odd, mirrored_even + mirrored_odd, mirrored_even - mirrored_odd]
}

/// How often the signs of coefficients change, and the least modulus among them.
#[inline(always)]
pub(super) fn changes<const M: usize>(form: &[Lanes<M>; FORM]) -> ([u64; M], Lanes<M>) {
    let (mut changes, mut least) = ([0u64; M], form[0].abs());
    for j in 0..DEGREE {
        for (i, changes) in changes.iter_mut().enumerate() {
            *changes += (form[j].0[i].to_bits() ^ form[j + 1].0[i].to_bits()) >> 63;
        }
        least = least.smaller(form[j + 1].abs());
    }
    (changes, least)
}

impl Harmonics {
    /// Adds the cells with one root each to a queue; `None` where the error bound does not tell.
    #[inline(always)]
    pub(crate) fn isolate<const CAPACITY: usize>(&self, queue: &mut RootQueue<CAPACITY>) -> Option<()> {
        let table = &*TABLE;
        let turned = Turned::of(self, &table.turns);
        if !turned.in_range {
            return None;
        }
        let mut waves = [Lanes::<QUARTER>::all(0.0); 7];
        for (wave, x) in waves.iter_mut().zip(turned.waves) {
            *wave = Lanes::all(x);
        }
        let mut forms = [[Lanes::<QUARTER>::all(0.0); FORM]; SIDES];
        for j in 0..FORM {
            let on_sides = on_sides(table.coefficients[j], waves);
            for side in 0..SIDES {
                forms[side][j] = on_sides[side];
            }
        }
        // A bit for each cell: one change of sign for certain; more, or one in doubt.
        let [mut one, mut open] = [0u32; 2];
        for (side, form) in forms.iter().enumerate() {
            let (changes, least) = changes(form);
            let [mut own_one, mut own_open] = [0u32; 2];
            for l in 0..QUARTER {
                let certain = least.0[l] > turned.error;
                own_one |= u32::from(certain & (changes[l] == 1)) << l;
                own_open |= u32::from(!certain | (changes[l] > 1)) << l;
            }
            one |= in_order(own_one, side);
            open |= in_order(own_open, side);
        }
        let cell = |which: u32| {
            let (side, l) = ORDER[which as usize];
            Cell::whole(from_fn(|j| forms[side][j].0[l]), which, 0)
        };
        while one != 0 {
            queue.push(&cell(one.trailing_zeros()));
            one &= one - 1;
        }
        while open != 0 {
            sort_out(&cell(open.trailing_zeros()), turned.error, queue)?;
            open &= open - 1;
        }
        Some(())
    }
}

/// Bits of a side's four cells, at their places in the order.
#[inline(always)]
fn in_order(bits: u32, side: usize) -> u32 {
    match side {
        0 => bits << 8,
        1 => bits,
        2 => REVERSED[bits as usize] << 4,
        _ => REVERSED[bits as usize] << 12,
    }
}

/// Four bits, last first.
const REVERSED: [u32; 16] = [0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15];

/// How often coefficients change sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Changes {
    None,
    One,
    /// Two or more, or not told by these coefficients; halving may tell.
    Open,
    /// The value at an end of the cell is below the error bound: halving will not help.
    Lost,
}

/// A cell or part of one.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cell {
    pub(super) coefficients: [f64; FORM],
    pub(super) from: f64,
    pub(super) width: f64,
    pub(super) which: u32,
    /// Whose root it is.
    pub(super) owner: u32,
    pub(super) depth: u32,
}

/// The bound after `depth` halvings: each is six averages, each of one rounding of a number at most `largest`.
#[inline(always)]
pub(super) fn error_at(error: f64, largest: f64, depth: u32) -> f64 {
    error + 7.0 * f64::from(depth) * UNIT * (largest + error) * MARGIN
}

#[inline(always)]
fn sign_changes(coefficients: &[f64; FORM], error: f64) -> Changes {
    let (mut plus, mut minus) = (0u32, 0u32);
    for (j, &c) in coefficients.iter().enumerate() {
        plus |= u32::from(c > error) << j;
        minus |= u32::from(c < -error) << j;
    }
    let unknown = !(plus | minus) & ALL;
    if unknown & ENDS != 0 {
        return Changes::Lost;
    }
    if unknown != 0 {
        return sign_changes_with_unknown(plus, minus);
    }
    match ((plus ^ (plus >> 1)) & (ALL >> 1)).count_ones() {
        0 => Changes::None,
        1 => Changes::One,
        _ => Changes::Open,
    }
}

/// A bit for each coefficient, and those of the first and last.
const ALL: u32 = (1 << (DEGREE + 1)) - 1;
const ENDS: u32 = 1 | 1 << DEGREE;

/// The same where some signs are not known, but both ends' are.
#[cold]
fn sign_changes_with_unknown(plus: u32, minus: u32) -> Changes {
    let mut last = plus & 1;
    let (mut changes, mut unknown, mut open) = (0, 0, false);
    for j in 1..FORM {
        if (plus | minus) >> j & 1 == 0 {
            unknown += 1;
            continue;
        }
        let sign = plus >> j & 1;
        let change = sign != last;
        changes += usize::from(change);
        // One unknown sign between opposite ones makes no difference; any other may.
        open |= if change { unknown > 1 } else { unknown > 0 };
        (last, unknown) = (sign, 0);
    }
    match changes {
        _ if open => Changes::Open,
        0 => Changes::None,
        1 => Changes::One,
        _ => Changes::Open,
    }
}

/// Books a cell whose signs change several times, or in doubt, by its halves; `None` where the bound does not tell.
#[inline(never)]
pub(super) fn sort_out<const CAPACITY: usize>(cell: &Cell, error: f64, queue: &mut RootQueue<CAPACITY>) -> Option<()> {
    let largest = cell.coefficients.iter().fold(0.0, |m: f64, c| if m > c.abs() { m } else { c.abs() });
    cell.sort_out(error, largest, queue)
}

/// The forms of the two halves, by de Casteljau's averages.
#[inline(always)]
pub(super) fn halves<const M: usize>(form: [Lanes<M>; FORM]) -> [[Lanes<M>; FORM]; 2] {
    let (mut left, mut right) = (form, form);
    for level in 1..FORM {
        for k in 0..FORM - level {
            right[k] = Lanes::all(0.5) * (right[k] + right[k + 1]);
        }
        left[level] = right[0];
    }
    [left, right]
}

impl Cell {
    #[inline(always)]
    pub(super) fn whole(coefficients: [f64; FORM], which: u32, owner: u32) -> Self {
        Self { coefficients, from: 0.0, width: 1.0, which, owner, depth: 0 }
    }

    /// Books a cell that has no root or one, else its halves; `None` where the bound does not tell.
    pub(super) fn sort_out<const CAPACITY: usize>(
        &self,
        error: f64,
        largest: f64,
        queue: &mut RootQueue<CAPACITY>,
    ) -> Option<()> {
        match sign_changes(&self.coefficients, error_at(error, largest, self.depth)) {
            Changes::None => {}
            Changes::One => queue.push(self),
            Changes::Lost => return None,
            Changes::Open if self.depth >= MAX_DEPTH => return None,
            Changes::Open => {
                let [left, right] = self.halves();
                left.sort_out(error, largest, queue)?;
                right.sort_out(error, largest, queue)?;
            }
        }
        Some(())
    }

    #[inline(always)]
    fn halves(&self) -> [Self; 2] {
        let [left, right] = halves(self.coefficients.map(|c| Lanes([c]))).map(|form| form.map(|c| c.0[0]));
        let half = Self { width: 0.5 * self.width, depth: self.depth + 1, ..*self };
        [Self { coefficients: left, ..half }, Self { coefficients: right, from: self.from + half.width, ..half }]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{Rational, dyadic};

    #[test]
    fn one_sign_in_doubt_is_no_root_and_no_lack_of_one() {
        let changes = |c: [f64; 7]| sign_changes(&c, 0.1);
        assert_eq!(changes([1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0]), Changes::Open);
        assert_eq!(changes([1.0, 1.0, 1.0, 0.0, -1.0, -1.0, -1.0]), Changes::One);
        assert_eq!(changes([1.0, 1.0, 0.05, -0.05, -1.0, -1.0, -1.0]), Changes::Open);
        assert_eq!(changes([0.1, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]), Changes::Lost);
        assert_eq!(changes([1.0, 1.0, -1.0, 1.0, 1.0, 1.0, 1.0]), Changes::Open);
        assert_eq!(changes([-1.0, -1.0, -1.0, -1.0, -1.0, -1.0, -1.0]), Changes::None);
        assert_eq!(changes([-1.0, -1.0, -1.0, 1.0, 1.0, 1.0, 1.0]), Changes::One);
    }

    /// A function's Bernstein coefficients over the cells, from the table, hold the function itself: at the ends and, degree raised, all along.
    #[test]
    fn the_table_is_exact_to_its_bound() {
        // cos and sin of multiples of STEP in intervals, and the blossoms from them.
        let direction = |turns: i32| {
            let turns = turns.rem_euclid(64);
            let turns = if turns > 32 { turns - 64 } else { turns };
            let [c, s] = Interval::cos_sin(f64::from(turns) * STEP);
            // The angle itself is rounded: by less than 4e-16.
            let slack = Interval::around(0.0, 5e-16);
            [c + slack, s + slack]
        };
        for j in 0..=6i32 {
            for (f, (k, part)) in [(0, 0), (2, 0), (2, 1), (1, 0), (3, 0), (1, 1), (3, 1)].into_iter().enumerate() {
                for l in 0..4i32 {
                    let mut sum = Interval::ZERO;
                    for i in 0..=j {
                        let weight = binomial(3 + k, i) * binomial(3 - k, j - i);
                        let turns = 2 * k * (2 * l + 1) + 4 * i - 2 * k - 2 * j;
                        sum = sum + direction(turns)[part].times(weight);
                    }
                    let exact = sum.checked_div(Interval::point(binomial(6, j))).expect("a binomial");
                    let found = TABLE.coefficients[j as usize][f].0[l as usize];
                    assert!((exact - Interval::point(found)).magnitude() < 16.0 * UNIT, "{j} {f} {l}");
                }
            }
        }
    }

    #[test]
    fn halving_alone_stays_within_its_share_of_the_bound() {
        let mut missed = 0;
        for seed in 1..200u32 {
            let coefficients: [f64; 7] = from_fn(|k| 1.0 / f64::from(seed + 3 * k as u32) - 0.01 * k as f64);
            let largest = coefficients.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
            let exact = |x: f64| dyadic(x).expect("finite");
            let mut truth = coefficients.map(exact);
            let mut cell = Cell { coefficients, width: 1.0, ..Cell::default() };
            for depth in 1..6 {
                cell = cell.halves()[1];
                for level in 1..7 {
                    for k in 0..7 - level {
                        truth[k] = (truth[k].clone() + truth[k + 1].clone()) / exact(2.0);
                    }
                }
                let bound = exact(error_at(0.0, largest, depth));
                for (c, t) in cell.coefficients.iter().zip(&truth) {
                    let miss: Rational = exact(*c) - t.clone();
                    assert!(miss <= bound && -miss.clone() <= bound);
                    missed += usize::from(miss != exact(0.0));
                }
            }
        }
        assert!(missed > 0, "rounding was at work");
    }
}
