//! How many real roots does a trigonometric polynomial have, and where: in floating point, the count with a proof.
//!
//! Half the angle as a direction `(x : y)` makes a polynomial of order 3 a form of degree 6, in which a half-turn is an ordinary point. Over a cell of
//! directions the form has seven Bernstein coefficients; the number of their sign changes is the number of roots wherever it is 0 or 1 (Descartes' rule).
//! Sixteen cells cover the circle, four at a time, since turning by `pi` and mirroring change signs only; cells with more changes are halved
//! (de Casteljau). One number bounds the errors of all coefficients, and a sign counts only beyond it. Roots are then found by Newton's method, several side by
//! side. What it cannot do: decide roots that nearly meet, or polynomials near zero; then it says so.
//!
//! Source: Lane, Riesenfeld 1981 for Bernstein forms; the bound is proved in the derivation `filter_bound`.

use std::array::from_fn;
use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};
use std::sync::LazyLock;

use crate::algebra::{Interval, Lanes};

/// Degree of the form.
const DEGREE: usize = 6;

/// Unit roundoff of `f64`.
const UNIT: f64 = f64::EPSILON / 2.0;

/// The cells are turned by this angle, in radians, so that right angles and Pythagorean ones of small numbers, which people choose for
/// mechanisms, do not fall on their ends.
const TURN: f64 = 0.083_7;

/// Halvings of a cell: beyond, roots lie closer together than `2⁻⁴⁰` and `f64` had better not decide.
const MAX_DEPTH: u32 = 40;

/// Errors of error bounds, all below `2⁻⁴⁰`, are covered by this factor.
const MARGIN: f64 = 1.0 + 1e-9;

/// A polynomial whose coefficients add up to a number outside is left to exact arithmetic: underflow would not be covered.
const RANGE: std::ops::RangeInclusive<f64> = 1e-150..=1e150;

/// A trigonometric polynomial of order at most 3 in multiples of the angle, with a bound on how far it is known.
///
/// `a_0 + sum of a_k cos(k phi) + b_k sin(k phi)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonics {
    /// `a_0 … a_3`.
    cosines: [f64; 4],
    /// `b_1 … b_3`.
    sines: [f64; 3],
    /// At least `|a_0 - A_0| + sum of |(a_k, b_k) - (A_k, B_k)|` for the polynomial meant.
    error: f64,
}

/// The real roots of a trigonometric polynomial, counted with a proof.
///
/// All are simple, and they stand apart: each alone in its part of the circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CountedRoots {
    cosines: [f64; LANES],
    sines: [f64; LANES],
    angles: [f64; LANES],
    /// How far each angle may move and stay in its part of the circle.
    below: [f64; LANES],
    above: [f64; LANES],
    count: usize,
}

/// Room for all roots, as many as fill SIMD registers.
const LANES: usize = 8;
/// Lanes that are worked on together.
const WIDTH: usize = 4;

impl CountedRoots {
    /// How many real roots there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Cosines of the roots, in the first [`CountedRoots::count`] places; the others hold any finite numbers.
    pub fn cosines(&self) -> &[f64; LANES] {
        &self.cosines
    }

    /// Sines of the roots, likewise.
    pub fn sines(&self) -> &[f64; LANES] {
        &self.sines
    }

    /// The roots as angles in radians, in `(-pi, pi]`, likewise; not sorted.
    pub fn angles(&self) -> &[f64; LANES] {
        &self.angles
    }

    /// How far each angle may be moved, down and up, before it leaves the part of the circle in which the root is the only one.
    pub fn room(&self) -> [&[f64; LANES]; 2] {
        [&self.below, &self.above]
    }
}

impl Harmonics {
    /// From values at the eight multiples of a quarter of `pi`, for a polynomial of order at most `order ≤ 3`.
    ///
    /// `error` bounds the error of each value.
    #[inline(always)]
    pub fn from_samples(values: &[f64; 8], order: usize, error: f64) -> Self {
        let v = values;
        // A Fourier transform of length eight; opposite angles first.
        let sum = [v[0] + v[4], v[1] + v[5], v[2] + v[6], v[3] + v[7]];
        let less = [v[0] - v[4], v[1] - v[5], v[2] - v[6], v[3] - v[7]];
        let (even, odd) = (sum[0] + sum[2], sum[1] + sum[3]);
        let (p, q) = (FRAC_1_SQRT_2 * (less[1] - less[3]), FRAC_1_SQRT_2 * (less[1] + less[3]));
        let mut cosines = [even + odd, 2.0 * (less[0] + p), 2.0 * (sum[0] - sum[2]), 2.0 * (less[0] - p)];
        let mut sines = [2.0 * (less[2] + q), 2.0 * (sum[1] - sum[3]), 2.0 * (q - less[2])];
        cosines.iter_mut().chain(&mut sines).for_each(|x| *x *= 0.125);
        let largest = v.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        // What the polynomial has beyond its order is exactly zero.
        cosines.iter_mut().skip(order + 1).for_each(|x| *x = 0.0);
        sines.iter_mut().skip(order).for_each(|x| *x = 0.0);
        // Each of the seven complex coefficients is an average of values, each with six roundings.
        Self { cosines, sines, error: 7.0 * (error + 7.0 * UNIT * largest) * MARGIN }
    }

    /// From `A(c) + s·B(c)`: coefficients of `1, c, c², c³` and of `s, s c, s c²`.
    pub fn from_powers([p0, p1, p2, p3]: &[Interval; 4], [q0, q1, q2]: &[Interval; 3]) -> Self {
        let cosines = [*p0 + p2.scale(-1), *p1 + p3.times(0.75), p2.scale(-1), p3.scale(-2)];
        let sines = [*q0 + q2.scale(-2), q1.scale(-1), q2.scale(-2)];
        let error: f64 = cosines.iter().chain(&sines).map(|x| x.radius()).sum();
        Self { cosines: cosines.map(Interval::middle), sines: sines.map(Interval::middle), error: error * MARGIN }
    }

    /// The real roots, counted; `None` where the error bound does not allow it.
    ///
    /// **Proof**: the count is exact, and each root simple, for every polynomial within the error bound. The roots themselves are good to about `1e-15` times what the
    /// slope there allows. **Cost**: a tenth of a microsecond, and some hundredths for each root.
    ///
    /// ```
    /// use assur::algebra::Interval;
    /// use assur::roots::Harmonics;
    /// let [zero, one, half] = [0.0, 1.0, 0.5].map(Interval::point);
    /// // cos phi = 1/2, twice.
    /// let roots = Harmonics::from_powers(&[-half, one, zero, zero], &[zero; 3]).real_roots().unwrap();
    /// assert_eq!(roots.count(), 2);
    /// assert!((roots.angles()[0].abs() - std::f64::consts::FRAC_PI_3).abs() < 1e-15);
    /// // cos phi = 1 is a double root: not decided in floating point.
    /// assert!(Harmonics::from_powers(&[-one, one, zero, zero], &[zero; 3]).real_roots().is_none());
    /// ```
    #[inline(always)]
    pub fn real_roots(&self) -> Option<CountedRoots> {
        let cells = Cells::of(self, &TABLE)?;
        let mut found = Found::default();
        let mut open = cells.open();
        while open != 0 {
            let cell = cells.cell(open.trailing_zeros() as usize);
            open &= open - 1;
            match sign_changes(&cell.coefficients, cells.error) {
                Changes::None => {}
                Changes::One => found.push(&cell),
                Changes::Open => {
                    let largest = cell.coefficients.iter().fold(0.0, |m: f64, c| if m > c.abs() { m } else { c.abs() });
                    // The first halving is common; more are not.
                    for half in &cell.halves() {
                        half.sort_out(cells.error, largest, &mut found)?;
                    }
                }
                Changes::Lost => return None,
            }
        }
        let mut out = CountedRoots {
            cosines: [1.0; LANES],
            sines: [0.0; LANES],
            angles: [0.0; LANES],
            below: [0.0; LANES],
            above: [0.0; LANES],
            count: found.count,
        };
        for first in (0..found.count).step_by(WIDTH) {
            find_roots(&found, first, &mut out);
        }
        Some(out)
    }
}

/// Bernstein coefficients of the eight functions over the four cells between 0 and a right angle.
struct Table {
    /// `[j][f][l]`: coefficient `j` of function `f` over cell `l`; functions 1, cos 2phi, sin 2phi, cos phi, cos 3phi, sin phi, sin 3phi.
    coefficients: [[Lanes<WIDTH>; 7]; DEGREE + 1],
    /// Where each of the sixteen cells lies, `4·side + l`.
    places: [CellPlace; 4 * WIDTH],
    /// Cosine and sine of one, two and three times the turn.
    turns: [[f64; 2]; 3],
    /// Tangent of a quarter of a cell's width.
    tangent: f64,
}

/// The middle of a cell.
#[derive(Clone, Copy)]
struct CellPlace {
    angle: f64,
    cosine: f64,
    sine: f64,
    /// 1, or -1 where the cell is run through clockwise.
    sense: f64,
}

/// A quarter of a cell's width.
const STEP: f64 = PI / 32.0;

static TABLE: LazyLock<Table> = LazyLock::new(Table::new);

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
        let place = |which: usize| {
            let own = STEP * (4 * (which % WIDTH) + 2) as f64;
            let (sense, angle) = match which / WIDTH {
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
            places: from_fn(place),
            turns: [1.0, 2.0, 3.0].map(|k| direction(k * TURN)),
            tangent: STEP.tan(),
        }
    }
}

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

/// The form over all sixteen cells.
struct Cells {
    /// `[side][j]` over four cells: sides are the angle itself, plus pi, negated, and pi less it.
    coefficients: [[Lanes<WIDTH>; DEGREE + 1]; 4],
    error: f64,
}

impl Cells {
    #[inline(always)]
    fn of(t: &Harmonics, table: &Table) -> Option<Self> {
        let mut turned = [[0.0; 2]; 3];
        let mut sum = t.cosines[0].abs();
        for (((turned, [c, s]), a), b) in turned.iter_mut().zip(table.turns).zip(&t.cosines[1..]).zip(t.sines) {
            *turned = [a * c + b * s, b * c - a * s];
            sum += a.abs() + b.abs();
        }
        if !RANGE.contains(&sum) {
            return None;
        }
        // Step 4 of the derivation: 6 roundings for the turn, 24 · sqrt 2 for the table and the sums.
        let error = (t.error + 41.0 * UNIT * sum) * MARGIN;
        let all = Lanes::<WIDTH>::all;
        let (constant, second) = (all(t.cosines[0]), [all(turned[1][0]), all(turned[1][1])]);
        let (first, third) = ([all(turned[0][0]), all(turned[0][1])], [all(turned[2][0]), all(turned[2][1])]);
        let mut coefficients = [[Lanes::all(0.0); DEGREE + 1]; 4];
        for (j, &[one, c2, s2, c1, c3, s1, s3]) in table.coefficients.iter().enumerate() {
            let (even_cosines, even_sines) = (one * constant + c2 * second[0], s2 * second[1]);
            let odd_cosines = c1 * first[0] + c3 * third[0];
            let odd_sines = s1 * first[1] + s3 * third[1];
            let (even, odd) = (even_cosines + even_sines, odd_cosines + odd_sines);
            let (mirrored_even, mirrored_odd) = (even_cosines - even_sines, odd_cosines - odd_sines);
            coefficients[0][j] = even + odd;
            coefficients[1][j] = even - odd;
            coefficients[2][j] = mirrored_even + mirrored_odd;
            coefficients[3][j] = mirrored_even - mirrored_odd;
        }
        Some(Self { coefficients, error })
    }

    /// The cells in which not all coefficients have one certain sign, as bits `4·side + cell`.
    #[inline(always)]
    fn open(&self) -> u32 {
        let mut bits = 0;
        for (side, coefficients) in self.coefficients.iter().enumerate() {
            let (mut low, mut high) = (coefficients[0], coefficients[0]);
            for &c in &coefficients[1..] {
                low = low.zip(c, |x, y| if x < y { x } else { y });
                high = high.zip(c, |x, y| if x > y { x } else { y });
            }
            for l in 0..WIDTH {
                let closed = low.0[l] > self.error || high.0[l] < -self.error;
                bits |= u32::from(!closed) << (4 * side + l);
            }
        }
        bits
    }

    #[inline(always)]
    fn cell(&self, which: usize) -> Cell {
        let (side, l) = (which / WIDTH, which % WIDTH);
        let mut coefficients = [0.0; DEGREE + 1];
        for (own, all) in coefficients.iter_mut().zip(&self.coefficients[side]) {
            *own = all.0[l];
        }
        Cell { coefficients, from: 0.0, width: 1.0, which: which as u32, depth: 0 }
    }
}

/// A cell or part of one.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    coefficients: [f64; DEGREE + 1],
    from: f64,
    width: f64,
    which: u32,
    depth: u32,
}

/// Cells with one root each, side by side.
#[derive(Default)]
struct Found {
    /// `[j]`: coefficient `j` of each cell.
    coefficients: [[f64; LANES]; DEGREE + 1],
    from: [f64; LANES],
    width: [f64; LANES],
    which: [u32; LANES],
    count: usize,
}

impl Found {
    #[inline(always)]
    fn push(&mut self, cell: &Cell) {
        // Six at most: the form has degree 6.
        let at = self.count;
        for (all, &own) in self.coefficients.iter_mut().zip(&cell.coefficients) {
            all[at] = own;
        }
        (self.from[at], self.width[at], self.which[at]) = (cell.from, cell.width, cell.which);
        self.count += 1;
    }
}

/// The bound after `depth` halvings: each is six averages, each of one rounding of a number at most `largest`.
fn error_at(error: f64, largest: f64, depth: u32) -> f64 {
    error + 7.0 * f64::from(depth) * UNIT * (largest + error) * MARGIN
}

#[inline(always)]
fn sign_changes(coefficients: &[f64; DEGREE + 1], error: f64) -> Changes {
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
fn sign_changes_with_unknown(plus: u32, minus: u32) -> Changes {
    let mut last = plus & 1;
    let (mut changes, mut unknown, mut open) = (0, 0, false);
    for j in 1..=DEGREE {
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

impl Cell {
    /// Books a half of a cell that has no root or one, else its own halves; `None` where the bound does not tell.
    #[inline(always)]
    fn sort_out(&self, error: f64, largest: f64, found: &mut Found) -> Option<()> {
        match sign_changes(&self.coefficients, error_at(error, largest, self.depth)) {
            Changes::None => {}
            Changes::One => found.push(self),
            Changes::Lost => return None,
            Changes::Open => self.halve(error, largest, found)?,
        }
        Some(())
    }

    #[inline(never)]
    fn halve(&self, error: f64, largest: f64, found: &mut Found) -> Option<()> {
        if self.depth >= MAX_DEPTH {
            return None;
        }
        let [left, right] = self.halves();
        left.sort_out(error, largest, found)?;
        right.sort_out(error, largest, found)
    }

    /// The two halves, by de Casteljau's averages.
    #[inline(always)]
    fn halves(&self) -> [Self; 2] {
        let mut right = self.coefficients;
        let mut left = self.coefficients;
        for (level, end) in left.iter_mut().enumerate().skip(1) {
            for k in 0..=DEGREE - level {
                right[k] = 0.5 * (right[k] + right[k + 1]);
            }
            *end = right[0];
        }
        let half = Self { width: 0.5 * self.width, depth: self.depth + 1, ..*self };
        [Self { coefficients: left, ..half }, Self { coefficients: right, from: self.from + half.width, ..half }]
    }
}

/// Steps of Newton's method, at least and at most, and the step below which a root is found: the next would be its square.
const FIRST_STEPS: usize = 3;
const MOST_STEPS: usize = 60;
const SMALL_STEP: f64 = 1e-8;

/// The roots of four cells side by side: Newton's method, kept inside by bisection.
#[inline(always)]
fn find_roots(found: &Found, first: usize, out: &mut CountedRoots) {
    let take = |from: &[f64; LANES]| Lanes([from[first], from[first + 1], from[first + 2], from[first + 3]]);
    // Powers of the place in the cell: forward differences times binomials.
    let mut powers = [Lanes::<WIDTH>::all(0.0); DEGREE + 1];
    for (power, coefficients) in powers.iter_mut().zip(&found.coefficients) {
        *power = take(coefficients);
    }
    let (start, end) = (powers[0], powers[DEGREE]);
    for level in 0..DEGREE {
        for k in (level + 1..=DEGREE).rev() {
            powers[k] = powers[k] - powers[k - 1];
        }
    }
    for (power, binomial) in powers.iter_mut().zip([1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0]) {
        *power = *power * Lanes::all(binomial);
    }
    let (mut low, mut high) = (Lanes::<WIDTH>::all(0.0), Lanes::<WIDTH>::all(1.0));
    let mut place = start.zip(end, |p, q| p / (p - q));
    for round in 0..MOST_STEPS {
        let (mut value, mut slope) = (powers[DEGREE], Lanes::all(0.0));
        for power in powers[..DEGREE].iter().rev() {
            slope = slope * place + value;
            value = value * place + *power;
        }
        // Same sign as at the start: the root lies beyond.
        let before = start * value;
        for i in 0..WIDTH {
            low.0[i] = if before.0[i] > 0.0 { place.0[i] } else { low.0[i] };
            high.0[i] = if before.0[i] > 0.0 { high.0[i] } else { place.0[i] };
        }
        let newton = place - value / slope;
        let middle = (low + high) * Lanes::all(0.5);
        let mut next = middle;
        for i in 0..WIDTH {
            let inside = (newton.0[i] >= low.0[i]) & (newton.0[i] <= high.0[i]);
            next.0[i] = if inside { newton.0[i] } else { middle.0[i] };
        }
        let step = (next - place).map(f64::abs);
        place = next;
        // Lanes without a cell hold NaN, which compares as small.
        if round + 1 >= FIRST_STEPS && !step.0.iter().any(|&x| x > SMALL_STEP) {
            break;
        }
    }
    let table = &*TABLE;
    let along = take(&found.from) + take(&found.width) * place;
    let along = along + along - Lanes::all(1.0);
    let tangent = along * Lanes::all(table.tangent);
    let square = tangent * tangent;
    // Half the angle from the cell's middle: the arc tangent's series, |tangent| < 0.1.
    let series = ARC_TANGENT.iter().rev().fold(Lanes::all(0.0), |sum, &c| sum * square + Lanes::all(c));
    let angle = tangent * series;
    let scale = Lanes::all(1.0) / (Lanes::all(1.0) + square);
    let (cosine, sine) = ((Lanes::all(1.0) - square) * scale, (tangent + tangent) * scale);
    let places = &table.places;
    let [i, j, k, l] = [0, 1, 2, 3].map(|lane| found.which[first + lane] as usize);
    let of = |f: fn(&CellPlace) -> f64| Lanes([f(&places[i]), f(&places[j]), f(&places[k]), f(&places[l])]);
    let (middle_cosine, middle_sine, sense) = (of(|p| p.cosine), of(|p| p.sine), of(|p| p.sense));
    let sine = sine * sense;
    let whole = of(|p| p.angle) + sense * (angle + angle);
    let whole = whole.map(|x| if x > PI { x - TAU } else { x });
    put(&mut out.cosines, first, middle_cosine * cosine - middle_sine * sine);
    put(&mut out.sines, first, middle_sine * cosine + middle_cosine * sine);
    put(&mut out.angles, first, whole);
    // The angle is no linear function of the place, but within a hundredth it is.
    let width = take(&found.width) * Lanes::all(0.98 * 4.0 * STEP);
    let half = Lanes::all(0.5);
    let below = width * (half + sense * (place - half));
    put(&mut out.below, first, below);
    put(&mut out.above, first, width - below);
}

#[inline(always)]
fn put(to: &mut [f64; LANES], first: usize, from: Lanes<WIDTH>) {
    to[first..first + WIDTH].copy_from_slice(&from.0);
}

/// `atan x = x (1 - x²/3 + x⁴/5 …)`; what is left out is below `1e-17` for `x < 0.1`.
const ARC_TANGENT: [f64; 8] = [1.0, -1.0 / 3.0, 1.0 / 5.0, -1.0 / 7.0, 1.0 / 9.0, -1.0 / 11.0, 1.0 / 13.0, -1.0 / 15.0];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{Integer, Rational, Trig, dyadic};
    use crate::roots::isolate_real_roots;
    use proptest::prelude::*;

    /// The trigonometric polynomial with integer coefficients, exact and as harmonics.
    fn both(n: &[i64; 7]) -> (Trig<Integer>, Harmonics) {
        let constant = |k: usize| Trig::constant(Integer::from(n[k]));
        let (c, s) = (Trig::cosine(), Trig::sine());
        let even = constant(0) + c.clone() * (constant(1) + c.clone() * (constant(2) + c.clone() * constant(3)));
        let odd = s * (constant(4) + c.clone() * (constant(5) + c * constant(6)));
        let point = |k: usize| Interval::point(n[k] as f64);
        (even + odd, Harmonics::from_powers(&[0, 1, 2, 3].map(point), &[4, 5, 6].map(point)))
    }

    fn exact_count(t: &Trig<Integer>) -> usize {
        let tau = (0..).find(|&tau| t.half_angle_about(3, tau).degree() == Some(6)).expect("a chart");
        t.half_angle_about(3, tau).square_free().iter().map(|(p, _)| isolate_real_roots(p).len()).sum()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(3000))]

        #[test]
        fn the_count_is_that_of_exact_arithmetic(n in prop::array::uniform7(-40i64..40)) {
            let (exact, harmonics) = both(&n);
            if let Some(roots) = harmonics.real_roots() {
                prop_assert_eq!(roots.count(), exact_count(&exact));
                for i in 0..roots.count() {
                    let (c, s, angle) = (roots.cosines()[i], roots.sines()[i], roots.angles()[i]);
                    let value = exact.evaluate(|x| x.to_f64().value(), &c, &s);
                    prop_assert!(value.abs() < 1e-11, "{} at {} {}", value, c, s);
                    prop_assert!((c - angle.cos()).abs() < 3e-15 && (s - angle.sin()).abs() < 3e-15);
                    prop_assert!(-PI < angle && angle <= PI);
                }
            }
        }

        #[test]
        fn samples_give_the_harmonics(n in prop::array::uniform7(-40i64..40)) {
            let (exact, harmonics) = both(&n);
            let at = |k: usize| {
                let (s, c) = (k as f64 * PI / 4.0).sin_cos();
                exact.evaluate(|x| x.to_f64().value(), &c, &s)
            };
            let sampled = Harmonics::from_samples(&from_fn(at), 3, 1e-13);
            let miss: f64 = harmonics.cosines.iter().chain(&harmonics.sines).zip(sampled.cosines.iter().chain(&sampled.sines))
                .map(|(x, y)| (x - y).abs()).sum();
            prop_assert!(miss < 1e-12 && miss <= sampled.error, "{} {}", miss, sampled.error);
        }
    }

    #[test]
    fn near_double_roots_are_counted_until_the_bound_forbids() {
        // cos phi = 1 - e: two roots, cos phi = 1 + e: none.
        let count = |e: f64| {
            let [zero, one] = [Interval::ZERO, Interval::ONE];
            Harmonics::from_powers(&[Interval::point(-1.0) + Interval::point(e), one, zero, zero], &[zero; 3])
                .real_roots()
                .map(|r| r.count())
        };
        assert_eq!([1e-4, 1e-8, 1e-12].map(count), [Some(2); 3]);
        assert_eq!([-1e-4, -1e-8, -1e-12].map(count), [Some(0); 3]);
        assert_eq!([1e-17, -1e-17, 0.0].map(count), [None; 3]);
    }

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
