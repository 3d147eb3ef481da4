//! How many real roots does a trigonometric polynomial have, decided in floating point, with a proof?
//!
//! With `c = 2xy/(x²+y²)`, `s = (x²-y²)/(x²+y²)` a polynomial of order 3 becomes a form of degree 6 in `(x : y)`, half the angle, so that a half-turn is
//! an ordinary point. Over a cell of directions the form has Bernstein coefficients; the number of their sign changes is the number of
//! roots wherever it is 0 or 1 (Descartes' rule), and other cells are halved (de Casteljau). Coefficients come with one bound on all their errors, and a
//! sign counts only beyond that bound. What it cannot do: decide roots that nearly meet, or polynomials near zero; then it says so.
//!
//! Source: Lane, Riesenfeld 1981 for Bernstein forms; the bound is proved in the derivation `filter_bound`.

use crate::algebra::Interval;

/// Degree of the form.
const DEGREE: usize = 6;

/// Unit roundoff of `f64`.
const UNIT: f64 = f64::EPSILON / 2.0;

/// The cells are turned by twice the angle of this direction against the axes, so that right angles and Pythagorean ones of small numbers,
/// which people choose for mechanisms, do not fall on their ends.
const TURN: (i64, i64) = (8, 3);

/// Halvings of a cell: beyond, roots lie closer together than `2⁻⁴⁰` and `f64` had better not decide.
const MAX_DEPTH: u32 = 40;

/// Errors of error bounds, all below `2⁻⁴⁰`, are covered by this factor.
const MARGIN: f64 = 1.0 + 1e-9;

/// A polynomial whose largest coefficient lies outside is left to exact arithmetic: underflow would not be covered.
const RANGE: std::ops::RangeInclusive<f64> = 1e-150..=1e150;

/// The real roots of a trigonometric polynomial of order at most 3, counted with a proof.
///
/// All are simple. The directions are approximate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CountedRoots {
    directions: [[f64; 2]; DEGREE],
    count: usize,
}

impl CountedRoots {
    /// Cosine and sine near each root, to about half the digits of `f64` or better; as many as there are real roots.
    pub fn directions(&self) -> &[[f64; 2]] {
        &self.directions[..self.count]
    }
}

/// A cell of directions: Bernstein coefficients, and its part of the quarter or the other quarter it came from.
#[derive(Clone, Copy, Default)]
struct Cell {
    coefficients: [f64; DEGREE + 1],
    from: f64,
    width: f64,
    depth: u32,
    mirrored: bool,
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

/// The real roots of `A(c) + s·B(c)`, counted; `None` where the error bound does not allow it.
///
/// **Shape**: coefficients of `1, c, c², c³` and of `s, s c, s c²`. **Proof**: the count is exact, and each root simple, for every polynomial with
/// coefficients in the intervals. **Cost**: half a microsecond, and another tenth for each root.
///
/// ```
/// use assur::algebra::Interval;
/// use assur::roots::count_on_circle;
/// let [zero, one, half] = [0.0, 1.0, 0.5].map(Interval::point);
/// // cos phi = 1/2, twice.
/// let roots = count_on_circle(&[-half, one, zero, zero], &[zero; 3]).unwrap();
/// assert_eq!(roots.directions().len(), 2);
/// // cos phi = 1 is a double root: not decided in floating point.
/// assert!(count_on_circle(&[-one, one, zero, zero], &[zero; 3]).is_none());
/// ```
pub fn count_on_circle(even: &[Interval; 4], odd: &[Interval; 3]) -> Option<CountedRoots> {
    let (coefficients, error, largest) = bernstein(&form(even, odd))?;
    let mut mirrored = coefficients;
    mirrored.iter_mut().skip(1).step_by(2).for_each(|c| *c = -*c);
    let whole = Cell { coefficients, width: 1.0, ..Cell::default() };
    let mut stack = [Cell::default(); MAX_DEPTH as usize + 4];
    (stack[0], stack[1]) = (whole, Cell { coefficients: mirrored, mirrored: true, ..whole });
    let mut height = 2;
    let mut out = CountedRoots { directions: [[0.0; 2]; DEGREE], count: 0 };
    while height > 0 {
        height -= 1;
        let cell = stack[height];
        match sign_changes(&cell.coefficients, error_at(error, largest, cell.depth)) {
            Changes::None => {}
            Changes::One => {
                out.directions[out.count] = cell.root();
                out.count += 1;
            }
            Changes::Lost => return None,
            Changes::Open if cell.depth >= MAX_DEPTH => return None,
            Changes::Open => {
                (stack[height], stack[height + 1]) = cell.halves();
                height += 2;
            }
        }
    }
    Some(out)
}

/// The form of degree 6 in `(x : y)`: coefficients of `x^k y^(6-k)`.
fn form([a0, a1, a2, a3]: &[Interval; 4], [b0, b1, b2]: &[Interval; 3]) -> [Interval; DEGREE + 1] {
    let even = a0.scale(1) + *a0 + a2.scale(2);
    let odd = *b0 + b2.scale(2);
    [
        *a0 - *b0,
        (*a1 - *b1).scale(1),
        even - odd,
        a1.scale(2) + a3.scale(3),
        even + odd,
        (*a1 + *b1).scale(1),
        *a0 + *b0,
    ]
}

/// Bernstein coefficients of the form in turned axes, a bound on the error of each, and the largest.
fn bernstein(form: &[Interval; DEGREE + 1]) -> Option<([f64; DEGREE + 1], f64, f64)> {
    let middle = form.map(Interval::middle);
    // A product and six sums: seven roundings, and one for the division by the binomial.
    let spread: [f64; DEGREE + 1] = std::array::from_fn(|k| form[k].radius() + 9.0 * UNIT * middle[k].abs());
    let mut coefficients = [0.0; DEGREE + 1];
    let (mut error, mut largest) = (0.0f64, 0.0f64);
    for (j, coefficient) in coefficients.iter_mut().enumerate() {
        let (mut value, mut bound) = (0.0, 0.0);
        for k in 0..=DEGREE {
            value += TURNED[j][k] * middle[k];
            bound += TURNED[j][k].abs() * spread[k];
        }
        *coefficient = value / BINOMIALS[j];
        error = error.max(bound / BINOMIALS[j]);
        largest = largest.max(coefficient.abs());
    }
    (RANGE.contains(&largest) && error.is_finite()).then_some((coefficients, error * MARGIN, largest))
}

/// The bound after `depth` halvings: each is six averages, each of one rounding of a number at most `largest`.
fn error_at(error: f64, largest: f64, depth: u32) -> f64 {
    error + 7.0 * f64::from(depth) * UNIT * (largest + error) * MARGIN
}

fn sign_changes(coefficients: &[f64; DEGREE + 1], error: f64) -> Changes {
    let sign = |c: f64| {
        if c > error {
            1i8
        } else if c < -error {
            -1
        } else {
            0
        }
    };
    let mut last = sign(coefficients[0]);
    if last == 0 || sign(coefficients[DEGREE]) == 0 {
        return Changes::Lost;
    }
    let (mut changes, mut unknown, mut open) = (0, 0, false);
    for &c in &coefficients[1..] {
        match sign(c) {
            0 => unknown += 1,
            s => {
                let change = s != last;
                changes += usize::from(change);
                // One unknown sign between opposite ones makes no difference; any other may.
                open |= if change { unknown > 1 } else { unknown > 0 };
                (last, unknown) = (s, 0);
            }
        }
    }
    match changes {
        _ if open => Changes::Open,
        0 => Changes::None,
        1 => Changes::One,
        _ => Changes::Open,
    }
}

impl Cell {
    /// The two halves, by de Casteljau's averages.
    fn halves(&self) -> (Self, Self) {
        let mut right = self.coefficients;
        let mut left = self.coefficients;
        for (level, end) in left.iter_mut().enumerate().skip(1) {
            for k in 0..=DEGREE - level {
                right[k] = 0.5 * (right[k] + right[k + 1]);
            }
            *end = right[0];
        }
        let half = Self { width: 0.5 * self.width, depth: self.depth + 1, ..*self };
        (Self { coefficients: left, ..half }, Self { coefficients: right, from: self.from + half.width, ..half })
    }

    /// Value and slope at a place of the cell, 0 to 1.
    fn at(&self, place: f64) -> (f64, f64) {
        let mut c = self.coefficients;
        for level in 1..DEGREE {
            for k in 0..=DEGREE - level {
                c[k] += place * (c[k + 1] - c[k]);
            }
        }
        (c[0] + place * (c[1] - c[0]), DEGREE as f64 * (c[1] - c[0]))
    }

    /// The direction of the only root, by Newton's method kept inside by bisection.
    fn root(&self) -> [f64; 2] {
        let rising = self.coefficients[DEGREE] > 0.0;
        let (mut low, mut high) = (0.0, 1.0);
        let mut place = 0.5;
        for _ in 0..ROOT_STEPS {
            let (value, slope) = self.at(place);
            if (value > 0.0) == rising {
                high = place
            } else {
                low = place
            }
            let newton = place - value / slope;
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            let step = (next - place).abs();
            place = next;
            if step < ROOT_ACCURACY {
                break;
            }
        }
        let along = self.from + self.width * place;
        let (x, y) = (along, if self.mirrored { along - 1.0 } else { 1.0 - along });
        let (p, q) = (TURN.0 as f64, TURN.1 as f64);
        let (x, y) = (p * x - q * y, q * x + p * y);
        let size = x * x + y * y;
        [2.0 * x * y / size, (x * x - y * y) / size]
    }
}

/// Steps towards a root, and the step below which it is good enough to start from: what follows doubles the digits.
const ROOT_STEPS: usize = 60;
const ROOT_ACCURACY: f64 = 1e-7;

/// `(6 choose k)`.
const BINOMIALS: [f64; DEGREE + 1] = [1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0];

/// Coefficient of `x^j y^(6-j)` in `(p x - q y)^k (q x + p y)^(6-k)`: integers below 2²².
const TURNED: [[f64; DEGREE + 1]; DEGREE + 1] = turned(TURN.0, TURN.1);

const fn turned(p: i64, q: i64) -> [[f64; DEGREE + 1]; DEGREE + 1] {
    let mut out = [[0.0; DEGREE + 1]; DEGREE + 1];
    let mut k = 0;
    while k <= DEGREE {
        let mut product = [0i64; DEGREE + 2];
        product[0] = 1;
        let mut factor = 0;
        while factor < DEGREE {
            let (in_x, in_y) = if factor < k { (p, -q) } else { (q, p) };
            let mut j = factor + 1;
            loop {
                let lower = if j > 0 { product[j - 1] } else { 0 };
                product[j] = in_x * lower + in_y * product[j];
                if j == 0 {
                    break;
                }
                j -= 1;
            }
            factor += 1;
        }
        let mut j = 0;
        while j <= DEGREE {
            out[j][k] = product[j] as f64;
            j += 1;
        }
        k += 1;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{Integer, Trig, dyadic};
    use crate::roots::isolate_real_roots;
    use proptest::prelude::*;

    /// The trigonometric polynomial with integer coefficients, in both forms.
    fn both(n: &[i64; 7]) -> (Trig<Integer>, [Interval; 4], [Interval; 3]) {
        let constant = |k: usize| Trig::constant(Integer::from(n[k]));
        let (c, s) = (Trig::cosine(), Trig::sine());
        let even = constant(0) + c.clone() * (constant(1) + c.clone() * (constant(2) + c.clone() * constant(3)));
        let odd = s * (constant(4) + c.clone() * (constant(5) + c * constant(6)));
        let point = |k: usize| Interval::point(n[k] as f64);
        (even + odd, [0, 1, 2, 3].map(point), [4, 5, 6].map(point))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(3000))]

        #[test]
        fn the_count_is_that_of_exact_arithmetic(n in prop::array::uniform7(-40i64..40)) {
            let (exact, even, odd) = both(&n);
            if let Some(roots) = count_on_circle(&even, &odd) {
                let tau = (0..).find(|&tau| exact.half_angle_about(3, tau).degree() == Some(6)).expect("a chart");
                let square_free = exact.half_angle_about(3, tau).square_free();
                let counted: usize = square_free.iter().map(|(p, _)| isolate_real_roots(p).len()).sum();
                prop_assert_eq!(roots.directions().len(), counted);
                for &[c, s] in roots.directions() {
                    let value = exact.evaluate(|x| x.to_f64().value(), &c, &s);
                    prop_assert!(value.abs() < 1e-3, "{} at {} {}", value, c, s);
                }
            }
        }
    }

    #[test]
    fn near_double_roots_are_counted_until_the_bound_forbids() {
        // cos phi = 1 - e: two roots, cos phi = 1 + e: none.
        let count = |e: f64| {
            let [zero, one] = [Interval::ZERO, Interval::ONE];
            count_on_circle(&[Interval::point(-1.0) + Interval::point(e), one, zero, zero], &[zero; 3])
                .map(|r| r.directions().len())
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
    }

    #[test]
    fn halving_alone_stays_within_its_share_of_the_bound() {
        let mut missed = 0;
        for seed in 1..200u32 {
            let coefficients: [f64; 7] =
                std::array::from_fn(|k| 1.0 / f64::from(seed + 3 * k as u32) - 0.01 * k as f64);
            let largest = coefficients.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
            let exact = |x: f64| dyadic(x).expect("finite");
            let mut truth = coefficients.map(exact);
            let mut cell = Cell { coefficients, width: 1.0, ..Cell::default() };
            for depth in 1..6 {
                cell = cell.halves().1;
                for level in 1..7 {
                    for k in 0..7 - level {
                        truth[k] = (truth[k].clone() + truth[k + 1].clone()) / exact(2.0);
                    }
                }
                let bound = exact(error_at(0.0, largest, depth));
                for (c, t) in cell.coefficients.iter().zip(&truth) {
                    let miss = exact(*c) - t.clone();
                    assert!(miss <= bound && -miss.clone() <= bound);
                    missed += usize::from(miss != exact(0.0));
                }
            }
        }
        assert!(missed > 0, "rounding was at work");
    }

    #[test]
    fn the_bound_covers_the_turn_and_every_halving() {
        let mut random = 1u64;
        let mut next = || {
            random = random.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (random >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        for _ in 0..300 {
            let form: [f64; 7] = std::array::from_fn(|_| next());
            let (coefficients, error, largest) = bernstein(&form.map(Interval::point)).expect("in range");
            let exact = |x: f64| dyadic(x).expect("finite");
            let mut truth: [crate::algebra::Rational; 7] = std::array::from_fn(|j| {
                let sum = (0..7).map(|k| exact(TURNED[j][k]) * exact(form[k])).fold(exact(0.0), |s, x| s + x);
                sum / exact(BINOMIALS[j])
            });
            let mut cell = Cell { coefficients, width: 1.0, ..Cell::default() };
            for depth in 0..12 {
                let bound = exact(error_at(error, largest, depth));
                for (c, t) in cell.coefficients.iter().zip(&truth) {
                    let miss = exact(*c) - t.clone();
                    assert!(miss <= bound && -miss <= bound);
                }
                let (left, right) = cell.halves();
                let mut averages = truth.clone();
                let mut ends = vec![averages[0].clone()];
                for level in 1..7 {
                    for k in 0..7 - level {
                        averages[k] = (averages[k].clone() + averages[k + 1].clone()) / exact(2.0);
                    }
                    ends.push(averages[0].clone());
                }
                (cell, truth) =
                    if next() > 0.0 { (right, averages) } else { (left, std::array::from_fn(|k| ends[k].clone())) };
            }
        }
    }
}
