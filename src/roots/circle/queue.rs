//! Cells with one root each, and Halley's method on several side by side.
//!
//! Four in the lanes of a register, or more by loops over columns of them, step by step: the same operations in the same order.

use std::f64::consts::{PI, TAU};

use super::cells::{Cell, STEP, TABLE};
use super::{DEGREE, FORM};
use crate::algebra::Lanes;

/// Roots of one polynomial that are worked on together.
pub(crate) const WIDTH: usize = 4;

/// Cells with one root each, of one polynomial or of many; as many as fit. Lanes that are loaded together lie beside each other.
pub(crate) struct RootQueue<const CAPACITY: usize> {
    /// `[j]`: coefficient `j` of each cell.
    coefficients: [[f64; CAPACITY]; FORM],
    from: [f64; CAPACITY],
    width: [f64; CAPACITY],
    /// Angle, cosine and sine of the whole cell's middle, and its sense.
    middle: [[f64; CAPACITY]; 4],
    owner: [u32; CAPACITY],
    count: usize,
}

impl<const CAPACITY: usize> Default for RootQueue<CAPACITY> {
    #[inline(always)]
    fn default() -> Self {
        Self {
            coefficients: [[0.0; CAPACITY]; FORM],
            from: [0.0; CAPACITY],
            width: [0.0; CAPACITY],
            middle: [[0.0; CAPACITY]; 4],
            owner: [0; CAPACITY],
            count: 0,
        }
    }
}

/// Roots side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RootsFound<const N: usize> {
    pub(crate) cosine: Lanes<N>,
    pub(crate) sine: Lanes<N>,
    /// In radians, in `(-pi, pi]`.
    pub(crate) angle: Lanes<N>,
    /// How far each angle may be moved, down and up, before it leaves the part of the circle in which the root is the only one.
    pub(crate) below: Lanes<N>,
    pub(crate) above: Lanes<N>,
}

impl<const N: usize> Default for RootsFound<N> {
    fn default() -> Self {
        let zero = Lanes::all(0.0);
        Self { cosine: zero, sine: zero, angle: zero, below: zero, above: zero }
    }
}

impl<const CAPACITY: usize> RootQueue<CAPACITY> {
    /// How many there are.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// Whose root each is.
    #[inline(always)]
    pub(crate) fn owners(&self) -> &[u32; CAPACITY] {
        &self.owner
    }

    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.count = 0;
    }

    #[inline(always)]
    pub(super) fn push(&mut self, cell: &Cell) {
        // Six at most of each owner: the form has degree 6.
        let at = self.count;
        for (all, &own) in self.coefficients.iter_mut().zip(&cell.coefficients) {
            all[at] = own;
        }
        let place = &TABLE.places[cell.which as usize];
        (self.from[at], self.width[at], self.owner[at]) = (cell.from, cell.width, cell.owner);
        for (all, own) in self.middle.iter_mut().zip([place.angle, place.cosine, place.sine, place.sense]) {
            all[at] = own;
        }
        self.count += 1;
    }

    /// Repeats the last root up to a whole number of groups, so that no lane holds anything strange; gives how many places are filled then.
    #[inline(always)]
    pub(crate) fn fill_up(&mut self) -> usize {
        let (count, filled) = (self.count, self.count.next_multiple_of(WIDTH).min(CAPACITY));
        for at in count..filled {
            for all in &mut self.coefficients {
                all[at] = all[count - 1];
            }
            for all in &mut self.middle {
                all[at] = all[count - 1];
            }
            (self.from[at], self.width[at]) = (self.from[count - 1], self.width[count - 1]);
            self.owner[at] = self.owner[count - 1];
        }
        filled
    }
}

/// Steps of Halley's method, at least and at most, and the step below which a root is found: the next would be of the order of its cube. Three are enough for 94 roots of a
/// hundred of random RR-RR-RR.
const FIRST_STEPS: usize = 3;
const MOST_STEPS: usize = 60;
const SMALL_STEP: f64 = 1e-5;

/// Halley's method on the way to roots.
#[derive(Clone, Copy)]
struct Search<const N: usize> {
    low: Lanes<N>,
    high: Lanes<N>,
    place: Lanes<N>,
    step: Lanes<N>,
}

/// Powers of the place in the cell from Bernstein coefficients: forward differences times binomials.
#[inline(always)]
fn powers<const N: usize>(coefficients: [Lanes<N>; FORM]) -> [Lanes<N>; FORM] {
    let mut powers = coefficients;
    for level in 0..DEGREE {
        for k in (level + 1..FORM).rev() {
            powers[k] = powers[k] - powers[k - 1];
        }
    }
    for (power, binomial) in powers.iter_mut().zip([1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0]) {
        *power = *power * Lanes::all(binomial);
    }
    powers
}

impl<const N: usize> Search<N> {
    /// In the half in which the sign changes, where the straight line between the values at its ends crosses zero.
    #[inline(always)]
    fn begin(powers: &[Lanes<N>; FORM], end: Lanes<N>) -> Self {
        let all = Lanes::<N>::all;
        let (start, half) = (powers[0], all(0.5));
        let mut middle = powers[DEGREE];
        for k in (0..DEGREE).rev() {
            middle = middle * half + powers[k];
        }
        // Same sign as at the start: the root lies beyond.
        let before = start * middle;
        let beyond = |yes, no| all(0.0).where_less(before, yes, no);
        let (low, high) = (beyond(half, all(0.0)), beyond(all(1.0), half));
        let (from, to) = (beyond(middle, start), beyond(end, middle));
        Self { low, high, place: low + half * from / (from - to), step: all(1.0) }
    }

    /// One step, kept inside by bisection. Newton's method takes one or two steps more, which costs more than the curvature.
    #[inline(always)]
    fn step(&mut self, powers: &[Lanes<N>; FORM]) {
        let all = Lanes::<N>::all;
        let place = self.place;
        // The form, its slope, and half its curvature.
        let [mut value, mut slope, mut curve] = [powers[DEGREE], all(0.0), all(0.0)];
        for k in (0..DEGREE).rev() {
            curve = curve * place + slope;
            slope = slope * place + value;
            value = value * place + powers[k];
        }
        // Same sign as at the start: the root lies beyond. As minimum and maximum, since a choice between two numbers in memory becomes a jump, which
        // nothing could foresee.
        let before = powers[0] * value;
        self.low = self.low.larger(all(0.0).where_less(before, place, all(0.0)));
        self.high = self.high.smaller(all(0.0).where_less(before, all(1.0), place));
        let halley = place - value * slope / (slope * slope - value * curve);
        let middle = (self.low + self.high) * all(0.5);
        let next = self.low.where_at_most(halley, halley, middle);
        let next = next.where_at_most(self.high, next, middle);
        self.step = (next - place).abs();
        self.place = next;
    }
}

/// A root at a place in a cell, as an angle and a direction.
#[inline(always)]
fn on_circle<const N: usize>(
    place: Lanes<N>,
    from: Lanes<N>,
    width: Lanes<N>,
    [middle, middle_cosine, middle_sine, sense]: [Lanes<N>; 4],
    tangent: f64,
) -> RootsFound<N> {
    let all = Lanes::<N>::all;
    let along = from + width * place;
    let along = along + along - all(1.0);
    let tangent = along * all(tangent);
    let square = tangent * tangent;
    // Half the angle from the cell's middle: the arc tangent's series, |tangent| < 0.1.
    let mut series = all(ARC_TANGENT[7]);
    for k in (0..7).rev() {
        series = series * square + all(ARC_TANGENT[k]);
    }
    let angle = tangent * series;
    let scale = all(1.0) / (all(1.0) + square);
    let (cosine, sine) = ((all(1.0) - square) * scale, (tangent + tangent) * scale);
    let sine = sine * sense;
    let whole = middle + sense * (angle + angle);
    let whole = all(PI).where_less(whole, whole - all(TAU), whole);
    // The angle is no linear function of the place, but within a hundredth it is.
    let width = width * all(0.98 * 4.0 * STEP);
    let half = all(0.5);
    let below = width * (half + sense * (place - half));
    RootsFound {
        cosine: middle_cosine * cosine - middle_sine * sine,
        sine: middle_sine * cosine + middle_cosine * sine,
        angle: whole,
        below,
        above: width - below,
    }
}

impl<const CAPACITY: usize> RootQueue<CAPACITY> {
    #[inline(always)]
    fn take<const N: usize>(&self, from: &[f64; CAPACITY], first: usize) -> Lanes<N> {
        Lanes(*from[first..].first_chunk().expect("groups lie within the capacity"))
    }

    /// The roots of a group of cells, in the lanes of a register.
    #[inline(always)]
    pub(crate) fn find_abreast(&mut self, group: usize) -> RootsFound<WIDTH> {
        self.fill_up();
        let take = |from| self.take::<WIDTH>(from, WIDTH * group);
        let [c0, c1, c2, c3, c4, c5, c6] = &self.coefficients;
        let powers = powers([take(c0), take(c1), take(c2), take(c3), take(c4), take(c5), take(c6)]);
        let mut search = Search::begin(&powers, take(c6));
        for _ in 0..FIRST_STEPS {
            search.step(&powers);
        }
        let small = Lanes::all(SMALL_STEP);
        for _ in FIRST_STEPS..MOST_STEPS {
            if small.less(search.step) == 0 {
                break;
            }
            let before = search;
            search.step(&powers);
            // A lane whose step was small has its root and stays.
            search.place = small.where_less(before.step, search.place, before.place);
            search.step = small.where_less(before.step, search.step, before.step);
        }
        let [m0, m1, m2, m3] = &self.middle;
        let middle = [take(m0), take(m1), take(m2), take(m3)];
        on_circle(search.place, take(&self.from), take(&self.width), middle, TABLE.tangent)
    }

    /// Up to `N` roots from `first` on, by loops over their cells; places up to the next multiple of four are filled, too. Gives how many are.
    #[inline(always)]
    pub(crate) fn find<const N: usize>(&mut self, first: usize, out: &mut RootColumns<N>) -> usize {
        let filled = (self.fill_up() - first).min(N);
        // Columns of this function's own: that they do not overlap is plain to the compiler, which vectorises the loops then.
        let mut p = [[0.0; N]; FORM];
        let [mut low, mut high, mut place, mut step] = [[0.0; N]; 4];
        for (p, all) in p.iter_mut().zip(&self.coefficients) {
            p[..filled].copy_from_slice(&all[first..first + filled]);
        }
        for k in 0..filled {
            let own = powers_of(&p, k);
            let end = own[DEGREE];
            let own = powers(own);
            let search = Search::begin(&own, end);
            for j in 0..FORM {
                p[j][k] = own[j].0[0];
            }
            (low[k], high[k], place[k]) = (search.low.0[0], search.high.0[0], search.place.0[0]);
        }
        for _ in 0..FIRST_STEPS {
            for k in 0..filled {
                let mut search =
                    Search { low: one(&low, k), high: one(&high, k), place: one(&place, k), step: Lanes([0.0]) };
                search.step(&powers_of(&p, k));
                (low[k], high[k], place[k], step[k]) =
                    (search.low.0[0], search.high.0[0], search.place.0[0], search.step.0[0]);
            }
        }
        // Few need more.
        for k in 0..filled {
            if step[k] > SMALL_STEP {
                let mut search =
                    Search { low: one(&low, k), high: one(&high, k), place: one(&place, k), step: one(&step, k) };
                for _ in FIRST_STEPS..MOST_STEPS {
                    search.step(&powers_of(&p, k));
                    if search.step.0[0] <= SMALL_STEP {
                        break;
                    }
                }
                place[k] = search.place.0[0];
            }
        }
        let mut middle = [[0.0; N]; 4];
        for (middle, all) in middle.iter_mut().zip(&self.middle) {
            middle[..filled].copy_from_slice(&all[first..first + filled]);
        }
        let [mut from, mut width] = [[0.0; N]; 2];
        from[..filled].copy_from_slice(&self.from[first..first + filled]);
        width[..filled].copy_from_slice(&self.width[first..first + filled]);
        let tangent = TABLE.tangent;
        for k in 0..filled {
            let [m0, m1, m2, m3] = &middle;
            let middle = [one(m0, k), one(m1, k), one(m2, k), one(m3, k)];
            let found = on_circle(one(&place, k), one(&from, k), one(&width, k), middle, tangent);
            (out.cosine[k], out.sine[k], out.angle[k]) = (found.cosine.0[0], found.sine.0[0], found.angle.0[0]);
            (out.below[k], out.above[k]) = (found.below.0[0], found.above.0[0]);
        }
        filled
    }
}

#[inline(always)]
fn one<const N: usize>(column: &[f64; N], k: usize) -> Lanes<1> {
    Lanes([column[k]])
}

#[inline(always)]
fn powers_of<const N: usize>(columns: &[[f64; N]; FORM], k: usize) -> [Lanes<1>; FORM] {
    let mut own = [Lanes([0.0]); FORM];
    for j in 0..FORM {
        own[j] = one(&columns[j], k);
    }
    own
}

/// Roots side by side in columns.
pub(crate) struct RootColumns<const N: usize> {
    pub(crate) cosine: [f64; N],
    pub(crate) sine: [f64; N],
    pub(crate) angle: [f64; N],
    pub(crate) below: [f64; N],
    pub(crate) above: [f64; N],
}

impl<const N: usize> RootColumns<N> {
    pub(crate) const EMPTY: Self =
        Self { cosine: [0.0; N], sine: [0.0; N], angle: [0.0; N], below: [0.0; N], above: [0.0; N] };

    /// Root `k`, alone.
    #[inline(always)]
    pub(crate) fn root(&self, k: usize) -> RootsFound<1> {
        RootsFound {
            cosine: one(&self.cosine, k),
            sine: one(&self.sine, k),
            angle: one(&self.angle, k),
            below: one(&self.below, k),
            above: one(&self.above, k),
        }
    }
}

/// `atan x = x (1 - x²/3 + x⁴/5 …)`; what is left out is below `1e-17` for `x < 0.1`.
const ARC_TANGENT: [f64; 8] = [1.0, -1.0 / 3.0, 1.0 / 5.0, -1.0 / 7.0, 1.0 / 9.0, -1.0 / 11.0, 1.0 / 13.0, -1.0 / 15.0];
