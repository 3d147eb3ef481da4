//! When may floating point say how many assembly modes there are?
//!
//! `cargo run --release --example filter_bound` prints the derivation, `cargo test` checks it.

use assur::algebra::{Bounded, Gaussian, Integer, Interval, Poly, Rational, Ring, ShortTrig, Trig, dyadic};
use assur::linkage::{LegNumbers, Rows, consistency, triad_rows};
use assur::nalgebra::Vector2;
use assur::roots::{Harmonics, isolate_real_roots};
use assur::{Dyad, ProofRoute, Triad};

type P = Poly<Rational>;

pub fn main() {
    print!("{}", document());
}

/// The derivation, worked through; panics where a step fails.
pub fn document() -> String {
    [claim(), form(), order(), enclosure(), bound(), simple_root(), share(), radius()].join("\n\n") + "\n"
}

fn claim() -> String {
    "WHEN FLOATING POINT MAY COUNT ASSEMBLY MODES
Claim. Let T(phi) = a_0 + sum of a_k cos k phi + b_k sin k phi, of order at most 3, be known within a given error, and let b_j be the Bernstein coefficients of
its form, computed in f64 with unit roundoff u = 2^-53. If over cells that cover the circle the signs of all b_j beyond the bound E of step 4
change 0 or 1 times, then T has exactly as many real roots as there are cells with one change, all simple; and above each lies exactly one assembly mode.

Symbols. c, s  cosine and sine of phi        e  error of T: |da_0| + sum of |(da_k, db_k)|        E  bound on the error of every b_j        M  largest |b_j|
  S  sum of |a_k| and |b_k|        G, D  mismatch and cross product of the two rows        l  length of the reference leg
Source. Descartes' rule in Bernstein form: Lane and Riesenfeld 1981. Sums and products of rounded numbers: Higham 2002, section 3.1. Boxes: Krawczyk 1969.
The rest is ours."
        .to_string()
}

fn var(index: usize) -> P {
    P::variable(index)
}

/// Step 1: the form of degree 6 over a cell.
fn form() -> String {
    // x and y stand for 1 - t and t, q for e^(2i delta).
    let (x, y, q) = (var(0), var(1), var(2));
    let choose = |n: i64, k: i64| if k < 0 || k > n { 0 } else { (0..k).fold(1, |c, i| c * (n - i) / (i + 1)) };
    for k in 0..=3i64 {
        let product = (x.clone() + y.clone() * q.clone()).power(3 + k as u32)
            * (x.clone() * q.clone() + y.clone()).power(3 - k as u32);
        let mut sum = P::zero();
        for j in 0..=6i64 {
            let weights: Vec<i64> = (0..=j).map(|i| choose(3 + k, i) * choose(3 - k, j - i)).collect();
            assert_eq!(weights.iter().sum::<i64>(), choose(6, j));
            for (i, weight) in (0..).zip(weights).filter(|(_, w)| *w != 0) {
                let power = q.power(u32::try_from(2 * i + 3 - k - j).expect("no negative power has a weight"));
                sum = sum + P::from_int(weight) * power * y.power(j as u32) * x.power(6 - j as u32);
            }
        }
        assert_eq!(product, sum);
    }
    "Step 1. With z = e^(i phi/2) as a point of the plane, e^(ik phi) |z|^6 = z^(3+k) conj(z)^(3-k). Over the cell of angles within 2 delta of psi let z run straight from
e^(i(psi/2 - delta)) to e^(i(psi/2 + delta)). Then e^(ik phi) |z|^6 has the Bernstein coefficients
  b_j = e^(ik psi) sum_i (3+k choose i)(3-k choose j-i) / (6 choose j) e^(i delta (4i - 2k - 2j)),
checked as an identity in t and e^(2i delta). The weights add up to 1, so |b_j| ≤ 1: an error e of T moves no coefficient of T |z|^6 by more than e.
There are sixteen cells, turned by an angle that keeps right angles and Pythagorean ones off their ends."
        .to_string()
}

/// Step 2: of three RR legs, what T has beyond order 3 vanishes in all symbols.
fn order() -> String {
    let point = |k: usize| Gaussian::new(var(k), var(k + 1));
    let zero = Gaussian::new(P::zero(), P::zero());
    let legs = [
        LegNumbers::Circle { alpha: zero.clone(), beta: zero, length: var(0) },
        LegNumbers::Circle { alpha: point(1), beta: point(3), length: var(5) },
        LegNumbers::Circle { alpha: point(6), beta: point(8), length: var(10) },
    ];
    let symbols = legs.map(|leg| leg.map(|x| Trig::constant(x.clone())));
    let t = consistency(&symbols, &Trig::cosine(), &Trig::sine());
    assert_eq!(t.order(), 3);
    "Step 2. Each row has order 1, so T is formally of order 4. For three RR legs the coefficients of c⁴ and s c³ vanish identically in all eleven symbols (checked);
the derivation of the degree table shows the order of the others. Rounded, they are noise, and are set to zero: that is exact."
        .to_string()
}

/// A generator of 64-bit numbers, splitmix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn legs(&mut self) -> [LegNumbers<f64>; 3] {
        let zero = Gaussian::new(0.0, 0.0);
        let mut point = || Gaussian::new(self.next(), self.next());
        let mut leg = |near: bool| {
            let (alpha, beta) = (point(), point());
            let length = point().re.abs();
            if near {
                LegNumbers::Circle { alpha: zero, beta: zero, length }
            } else {
                LegNumbers::Circle { alpha, beta, length }
            }
        };
        [leg(true), leg(false), leg(false)]
    }
}

/// Step 3: how far T is known.
fn enclosure() -> String {
    let mut random = Random(3);
    let half = Interval::point(0.5).sqrt().expect("a positive number");
    let mut roundings = 0;
    for _ in 0..200 {
        let legs = random.legs();
        let rough = legs.each_ref().map(|leg| leg.map(|&x| ShortTrig::constant(Interval::point(x))));
        let rough = consistency(&rough, &ShortTrig::cosine(), &ShortTrig::sine());
        let number = |x: &f64| dyadic(*x).expect("finite");
        let exact = legs.each_ref().map(|leg| leg.map(|x| ShortExact::constant(number(x))));
        let exact = consistency(&exact, &Trig::cosine(), &Trig::sine());
        let mut coefficients = exact.coefficients();
        let even = rough.even().iter().take(4);
        for enclosure in even.chain(rough.odd().iter().take(3)) {
            let value = coefficients.next().cloned().unwrap_or(Rational::ZERO);
            assert!(number(&enclosure.lo()) <= value && value <= number(&enclosure.hi()));
        }
        // The same at eight angles, by sizes and roundings.
        let sizes = legs.each_ref().map(|leg| leg.map(|&x| Bounded::rounded(x)));
        let bound = consistency(&sizes, &Bounded::rounded(1.0), &Bounded::rounded(1.0));
        roundings = bound.roundings();
        let known = legs.each_ref().map(|leg| leg.map(|&x| Interval::point(x)));
        let signs = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)];
        for (x, y) in signs {
            let size = if x * y == 0 { Interval::ONE } else { half };
            let (c, s) = (size.times(f64::from(x)), size.times(f64::from(y)));
            let value = consistency(&known, &c, &s);
            let computed = consistency(&legs, &c.middle(), &s.middle());
            let nearest = value.lo().max(computed.min(value.hi()));
            assert!((computed - nearest).abs() <= bound.error(), "{computed} {value:?}");
        }
    }
    format!(
        "Step 3. T is taken at the eight multiples of a quarter of pi. Run over sizes in place of numbers, the one formula for T adds and multiplies moduli and counts roundings:
at most {roundings} on any way, so each value errs by no more than {roundings} u times the size found (checked against intervals at 200 random triads). By
Fourier's formula each of the seven complex coefficients of T is an average of eight values, each taken through six roundings: e = 7 (error + 7 u largest value).
Where that is too coarse, the formula is expanded in intervals instead, whose every operation holds every exact result (checked against rationals for the
same triads); e is then the sum of the radii."
    )
}

type ShortExact = Trig<Rational>;

/// Step 4: the bound, against exact counts.
fn bound() -> String {
    let mut random = Random(5);
    let mut decided = 0;
    for _ in 0..400 {
        let numbers: [i64; 7] = std::array::from_fn(|_| (30.0 * random.next()) as i64);
        let point = |k: usize| Interval::point(numbers[k] as f64);
        let counted = Harmonics::from_powers(&[0, 1, 2, 3].map(point), &[4, 5, 6].map(point)).real_roots();
        let integer = |k: usize| Trig::constant(Integer::from(numbers[k]));
        let (c, s) = (Trig::cosine(), Trig::sine());
        let even = integer(0) + c.clone() * (integer(1) + c.clone() * (integer(2) + c.clone() * integer(3)));
        let t = even + s * (integer(4) + c.clone() * (integer(5) + c * integer(6)));
        if let (Some(counted), Some(tau)) =
            (counted, (0..9).find(|&tau| t.half_angle_about(3, tau).degree() == Some(6)))
        {
            let parts = t.half_angle_about(3, tau).square_free();
            let exact: usize = parts.iter().map(|(p, _)| isolate_real_roots(p).len()).sum();
            assert_eq!(counted.count(), exact);
            decided += 1;
        }
    }
    assert!(decided > 300, "{decided}");
    format!(
        "Step 4. Turning T by the angle of the cells costs 4 u (|a_k| + |b_k|) in each new coefficient: 6 u S. The table of step 1 is computed to 16 u (checked against intervals in
the tests), a b_j takes seven products and adds them through four roundings or fewer, and turning may make S larger by sqrt 2: together
  E_0 = e + 41 u S.
Halving a cell (de Casteljau) takes each coefficient through at most six averages (p + q)/2: one rounding u M each, and an average of errors is no larger than
they are. So after d halvings E_d = E_0 + 7 d u (M + E_0). Bounds are rounded themselves, by less than a part in 10⁹, and are taken that much
larger. A sign is believed where |b_j| > E_d; a single unknown sign between opposite ones does not change the count; a
cell whose end value is not believed ends the attempt. Checked against exact counts: {decided} of 400 polynomials decided, all alike."
    )
}

/// Step 5: above a simple root lies one pose.
fn simple_root() -> String {
    let mut random = Random(7);
    for _ in 0..20 {
        let legs = random.legs();
        let legs = legs.each_ref().map(|leg| leg.map(|&x| Trig::constant(Integer::from((1000.0 * x) as i64))));
        let rows = triad_rows(&legs, &Trig::cosine(), &Trig::sine());
        let Rows::Circle { radius, rows: [p, q] } = rows else { panic!("three RR legs have a reference circle") };
        let (g, d) = (p.mismatch(&q), p.cross(&q));
        let slope = consistency(&legs, &Trig::cosine(), &Trig::sine()).derivative();
        let two = Trig::from_int(2);
        let by_parts = two.clone() * (g.re.clone() * g.re.derivative() + g.im.clone() * g.im.derivative())
            - two * radius.clone() * radius * d.clone() * d.derivative();
        assert_eq!(slope, by_parts);
    }
    "Step 5. T = G·G - l² D², so T' = 2 G·G' - 2 l² D D' (checked). At a real root with D = 0 also G·G = 0, that is G = 0, and T' = 0: the root is double. So at a simple
real root D is not zero, the two rows cross in one point, and T = 0 says that it lies on the circle: exactly one assembly mode. Without an RR leg T is the
determinant of the rows' (g, e); its derivative is a combination of their 2x2 minors, so at a simple root some two rows are independent: they cross in one point, or, all
three normals being parallel, at infinity. The latter is no mode: no box is proved then, and the fast route leaves such a triad to integers.
Simple roots, one mode each; boxes around them that do not meet, each proved to hold exactly one solution of the loop equations: then each holds one
mode, and there is no other."
        .to_string()
}

/// Step 6: how often the filter decides, and that it never contradicts exact arithmetic.
fn share() -> String {
    let mut random = Random(11);
    let (count, mut decided) = (400, 0);
    let mut triads = Vec::new();
    for _ in 0..count {
        let mut leg = || {
            let mut point = || Vector2::new(random.next(), random.next());
            let (a, b) = (point(), point());
            Dyad::RR { a, b, length: 1.0 + point().x }
        };
        let triad = Triad::new([leg(), leg(), leg()]).expect("finite numbers");
        let proved = triad.prove();
        if proved.route == ProofRoute::Filter {
            decided += 1;
            assert_eq!(proved.modes.len(), triad.prove_exactly().modes.len());
        }
        triads.push(triad);
    }
    let batch = Triad::real_modes_batch(&triads);
    for ((triad, poses), &found) in triads.iter().zip(batch.poses().chunks_exact(18)).zip(batch.counts()) {
        let alone: Vec<f64> =
            triad.real_modes().modes().iter().flat_map(|mode| [mode.pose.x, mode.pose.y, mode.pose.phi]).collect();
        assert_eq!(poses[..3 * usize::from(found)], alone, "a block does what is done alone");
    }
    assert!(100 * decided >= 99 * count, "{decided} of {count}");
    format!(
        "Step 6. Of {count} random RR-RR-RR triads the filter decides {decided}, each as exact arithmetic does; the rest goes to integers. Many triads take
the same steps, in loops over blocks of them: the same operations on each number, and so the same bounds; all {count} come out to the last bit as alone."
    )
}

/// Step 7: a box around each mode.
fn radius() -> String {
    let mut random = Random(13);
    let (mut widest, mut boxes) = (0.0f64, 0);
    for _ in 0..200 {
        let mut leg = || {
            let mut point = || Vector2::new(random.next(), random.next());
            let (a, b) = (point(), point());
            Dyad::RR { a, b, length: 1.0 + point().x }
        };
        let triad = Triad::new([leg(), leg(), leg()]).expect("finite numbers");
        let Some(proved) = triad.prove_filtered() else { continue };
        let exact = triad.prove_exactly();
        assert_eq!(proved.modes.len(), exact.modes.len());
        for mode in &proved.modes {
            // Each holds one exact box, and meets no other.
            let meets = |p: &[[f64; 2]; 3]| p.iter().zip(&mode.pose_box).all(|(p, q)| p[0] <= q[1] && q[0] <= p[1]);
            assert_eq!(exact.modes.iter().filter(|p| meets(&p.pose_box)).count(), 1);
            widest = mode.pose_box.iter().fold(widest, |w, [lo, hi]| w.max(hi - lo));
            boxes += 1;
        }
    }
    assert!(boxes > 200 && widest < 1e-6);
    "Step 7. At a pose found, let F be the three loop equations in (u, phi), J their derivatives, Y an approximate inverse of J. Within a box of radius r < 1 about the
pose the derivatives of equation k change by no more than L_k r, L_k the sum of the moduli of its second derivatives there; so with
  eta = |Y| (|F| + rounding),    kappa = |1 - Y J| + |Y| rounding,    lambda = |Y| L
Krawczyk's operator takes the box into the one of radius eta + (kappa + lambda r) r. Where that is smaller than r in each coordinate, the box holds exactly one
assembly, and so does the smaller one. Roundings of F and J are counted as in step 3, with sizes for all poses at once. The direction (c, s) and the angle phi were
computed side by side: the cell's middle (4 u), half the arc tangent's series (8 u), their sum and a whole turn (8 u), the turn of the direction (7 u), and for each of three
Newton steps 4 u for both, turns being at most 1e-5, by a sixth of whose cube, below 2 u, angle and direction part: below 64 u, which the box of phi is wider. Brought to modulus 1 by 3/2 - (c² + s²)/2, the
direction has it to 3 u. Checked: the boxes of 200 random triads meet one exact box each."
        .to_string()
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_step_holds() {
        assert!(super::document().contains("Step 7"));
    }
}
