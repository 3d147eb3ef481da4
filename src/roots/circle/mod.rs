//! How many real roots does a trigonometric polynomial have, and where: in floating point, the count with a proof.
//!
//! Half the angle as a direction `(x : y)` makes a polynomial of order 3 a form of degree 6, in which a half-turn is an ordinary point. Over a cell of
//! directions the form has seven Bernstein coefficients; the number of their sign changes is the number of roots wherever it is 0 or 1 (Descartes' rule).
//! Sixteen cells cover the circle ([`cells`]); those with more changes are halved (de Casteljau). One number bounds the errors of all coefficients, and a sign
//! counts only beyond it. Cells with one root each, of one polynomial or of a block of them, stand in a queue ([`queue`]), and Newton's method takes them from
//! there side by side. One polynomial and the same among others go through the same operations, so they give the same bits.
//!
//! What it cannot do: decide roots that nearly meet, or polynomials near zero; then it says so.
//!
//! Source: Lane, Riesenfeld 1981 for Bernstein forms; the bound is proved in the derivation `filter_bound`.

// Loops over columns read and write several at one place; counted ones become SIMD instructions, chains of iterators as a rule do not.
#![allow(clippy::needless_range_loop)]

mod block;
mod cells;
mod queue;

pub(crate) use block::HarmonicBlock;
pub(crate) use queue::{RootColumns, RootQueue, RootsFound, WIDTH};

use std::f64::consts::FRAC_1_SQRT_2;

use crate::algebra::{Interval, Lanes};

/// Degree of the form.
const DEGREE: usize = 6;

/// Its coefficients, as many as loops run over: loops over `0..=DEGREE` do not become SIMD instructions.
const FORM: usize = DEGREE + 1;

/// Unit roundoff of `f64`.
const UNIT: f64 = f64::EPSILON / 2.0;

/// Errors of error bounds, all below `2⁻⁴⁰`, are covered by this factor.
const MARGIN: f64 = 1.0 + 1e-9;

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
    found: [RootsFound<WIDTH>; LANES / WIDTH],
    count: usize,
}

/// Room for all roots of one polynomial, as many as fill SIMD registers.
const LANES: usize = 8;

impl CountedRoots {
    /// How many real roots there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The roots as angles in radians, in `(-pi, pi]`; not sorted.
    pub fn angles(&self) -> impl Iterator<Item = f64> + '_ {
        self.all(|found| &found.angle)
    }

    /// Cosines and sines of the roots, likewise.
    pub fn directions(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.all(|found| &found.cosine).zip(self.all(|found| &found.sine)).map(|(c, s)| [c, s])
    }

    fn all(&self, part: fn(&RootsFound<WIDTH>) -> &Lanes<WIDTH>) -> impl Iterator<Item = f64> + '_ {
        self.found.iter().flat_map(move |found| part(found).0).take(self.count)
    }

    /// Roots side by side, as they were found; lanes beyond the count hold any finite numbers.
    pub(crate) fn group(&self, group: usize) -> RootsFound<WIDTH> {
        self.found[group]
    }
}

impl Harmonics {
    /// From values at the eight multiples of a quarter of `pi`, for a polynomial of order at most `order ≤ 3`.
    ///
    /// `error` bounds the error of each value.
    #[inline(always)]
    pub fn from_samples(v: &[f64; 8], order: usize, error: f64) -> Self {
        // A Fourier transform of length eight; opposite angles first.
        let sum = [v[0] + v[4], v[1] + v[5], v[2] + v[6], v[3] + v[7]];
        let less = [v[0] - v[4], v[1] - v[5], v[2] - v[6], v[3] - v[7]];
        let (even, odd) = (sum[0] + sum[2], sum[1] + sum[3]);
        let (p, q) = (FRAC_1_SQRT_2 * (less[1] - less[3]), FRAC_1_SQRT_2 * (less[1] + less[3]));
        // What the polynomial has beyond its order is exactly zero.
        let up_to = |k: usize, x: f64| if k > order { 0.0 } else { x };
        let cosines = [
            0.125 * (even + odd),
            up_to(1, 0.25 * (less[0] + p)),
            up_to(2, 0.25 * (sum[0] - sum[2])),
            up_to(3, 0.25 * (less[0] - p)),
        ];
        let sines =
            [up_to(1, 0.25 * (less[2] + q)), up_to(2, 0.25 * (sum[1] - sum[3])), up_to(3, 0.25 * (q - less[2]))];
        let mut largest = v[0].abs();
        for x in &v[1..] {
            largest = if x.abs() > largest { x.abs() } else { largest };
        }
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
    /// slope there allows. **Cost**: half a microsecond (`benches/real_modes.rs`).
    ///
    /// ```
    /// use assur::algebra::Interval;
    /// use assur::roots::Harmonics;
    /// let [zero, one, half] = [0.0, 1.0, 0.5].map(Interval::point);
    /// // cos phi = 1/2, twice.
    /// let roots = Harmonics::from_powers(&[-half, one, zero, zero], &[zero; 3]).real_roots().unwrap();
    /// assert_eq!(roots.count(), 2);
    /// assert!(roots.angles().all(|angle| (angle.abs() - std::f64::consts::FRAC_PI_3).abs() < 1e-15));
    /// // cos phi = 1 is a double root: not decided in floating point.
    /// assert!(Harmonics::from_powers(&[-one, one, zero, zero], &[zero; 3]).real_roots().is_none());
    /// ```
    pub fn real_roots(&self) -> Option<CountedRoots> {
        let mut queue = RootQueue::<LANES>::default();
        self.isolate(&mut queue)?;
        let mut out = CountedRoots { found: [RootsFound::default(); LANES / WIDTH], count: queue.len() };
        for (group, found) in out.found.iter_mut().enumerate().take(queue.len().div_ceil(WIDTH)) {
            *found = queue.find_abreast(group);
        }
        Some(out)
    }
}

#[cfg(test)]
mod tests {
    use std::array::from_fn;
    use std::f64::consts::PI;

    use super::*;
    use crate::algebra::{Integer, Trig};
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
                for ([c, s], angle) in roots.directions().zip(roots.angles()) {
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

    /// Polynomials in blocks, whole and in part, have the roots that each has alone, to the last bit; also where single signs are in doubt, and where more cells are
    /// open than there is room for.
    #[test]
    fn a_block_gives_the_bits_of_each_polynomial_alone() {
        const B: usize = 32;
        let mut state = 7u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        let (mut roots_seen, mut undecided_seen) = (0, 0);
        for round in 0..400 {
            // Coarse bounds, too: they leave single signs in doubt.
            let bound = [1e-15, 1e-3, 1e-2][round / B % 3];
            let mut values = [[0.0; B]; 8];
            for i in 0..B {
                let cosines: [f64; 4] = from_fn(|_| next());
                // Every third is near a double root, half of those nearer than the bound tells.
                let distance = if round % 2 == 0 { 1e-9 } else { 1e-16 };
                let near = ((round + i) % 3 == 0).then(|| distance * next());
                for (k, value) in values.iter_mut().enumerate() {
                    let phi = k as f64 * PI / 4.0;
                    value[i] = match near {
                        None => (0..4).map(|j| cosines[j] * (j as f64 * phi + cosines[3 - j]).cos()).sum(),
                        Some(near) => 1.0 + near - (phi - cosines[0]).cos(),
                    };
                }
            }
            let error = [bound; B];
            let mut block = HarmonicBlock::<B>::EMPTY;
            block.put_samples(&values, 3, &error, B);
            let mut queue = RootQueue::<{ 6 * B }>::default();
            let count = 1 + round % B;
            let undecided = block.isolate(count, &mut queue);
            let mut columns = RootColumns::<{ 6 * B }>::EMPTY;
            queue.find(0, &mut columns);
            for i in 0..count {
                let own: [f64; 8] = from_fn(|k| values[k][i]);
                let alone = Harmonics::from_samples(&own, 3, error[i]).real_roots();
                assert_eq!(alone.is_none(), undecided >> i & 1 == 1);
                let Some(alone) = alone else {
                    undecided_seen += 1;
                    continue;
                };
                let bits = |all: &mut Vec<f64>| {
                    all.sort_by(f64::total_cmp);
                    all.iter().map(|x| x.to_bits()).collect::<Vec<u64>>()
                };
                let mut found: Vec<f64> =
                    (0..queue.len()).filter(|&k| queue.owners()[k] == i as u32).map(|k| columns.angle[k]).collect();
                assert_eq!(bits(&mut found), bits(&mut alone.angles().collect()));
                roots_seen += found.len();
            }
        }
        assert!(roots_seen > 1000 && undecided_seen > 0, "{roots_seen} {undecided_seen}");
    }
}
