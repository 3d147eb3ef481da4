//! When may floating point say how many assembly modes there are?
//!
//! `cargo run --release --example filter_bound` prints the derivation, `cargo test` checks it.

use assur::algebra::{Gaussian, Integer, Interval, Poly, Rational, Ring, ShortTrig, Trig, dyadic};
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
    [claim(), form(), order(), enclosure(), bound(), simple_root(), share()].join("\n\n") + "\n"
}

fn claim() -> String {
    "WHEN FLOATING POINT MAY COUNT ASSEMBLY MODES
Claim. Let T(phi) = A(c) + s B(c), of order at most 3, have coefficients in given intervals, and let b_j be the Bernstein coefficients of its form,
computed in f64 with unit roundoff u = 2^-53. If over cells of directions that cover the circle the signs of all b_j beyond the bound E of step 4
change 0 or 1 times, then T has exactly as many real roots as there are cells with one change, all simple; and above each lies exactly one assembly mode.

Symbols. c, s  cosine and sine of phi        (x : y)  half the angle        E  bound on the error of every b_j        M  largest |b_j|
  G, D  mismatch and cross product of the two rows        l  length of the reference leg
Source. Descartes' rule in Bernstein form: Lane and Riesenfeld 1981. Sums and products of rounded numbers: Higham 2002, section 3.1. The rest is ours."
        .to_string()
}

fn var(index: usize) -> P {
    P::variable(index)
}

/// Step 1: the form of degree 6, and its turn.
fn form() -> String {
    let (x, y) = (var(0), var(1));
    let (c, s, w) = (P::from_int(2) * x.clone() * y.clone(), x.power(2) - y.power(2), x.power(2) + y.power(2));
    assert_eq!(c.power(2) + s.power(2), w.power(2));
    let (p, q) = (P::from_int(8), P::from_int(3));
    let (tx, ty) = (p.clone() * x.clone() - q.clone() * y.clone(), q * x + p * y);
    assert_eq!(tx.power(2) + ty.power(2), P::from_int(73) * w);
    "Step 1. c = 2xy/(x²+y²), s = (x²-y²)/(x²+y²) runs once round the circle while (x : y) runs through all directions, and (x²+y²)³ T is a form of degree 6.
Its coefficient of x^j y^(6-j) over (6 choose j) is the Bernstein coefficient b_j over the quarter from (0 : 1) to (1 : 0). Turning the axes by
(8x - 3y, 3x + 8y) multiplies x²+y² by 73 and keeps right angles off the ends of cells."
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

/// Step 3: T in intervals holds T over the rationals, coefficient by coefficient.
fn enclosure() -> String {
    let mut random = Random(3);
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
    }
    "Step 3. The one formula for T, run over intervals whose every operation holds every exact result, gives intervals that hold the coefficients of T (checked
against rationals for 200 random triads). Each is a middle m_k and a radius r_k."
        .to_string()
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
        "Step 4. b_j is a sum of seven products with integers below 2²², divided by a binomial: eight roundings at most, each of relative size u, so
  E_0 = max_j (sum_k |t_jk| (r_k + 9u |m_k|)) / (6 choose j),
9 in place of 8 covering second-order terms. Halving a cell (de Casteljau) takes each coefficient through at most six averages (p + q)/2: one rounding u M each,
and an average of errors is no larger than they are. So after d halvings E_d = E_0 + 7 d u (M + E_0). The sum bounds are rounded themselves, by less than a part
in 10⁹, and are taken that much larger. A sign is believed where |b_j| > E_d; a single unknown sign between opposite ones does not change the count; a
cell whose end value is not believed ends the attempt. The same radii bound T and its derivative on the whole circle: |dT| ≤ sum r_k and, T being
of order 3, |dT'| ≤ 3 sum r_k (Bernstein's inequality). Checked against exact counts: {decided} of 400 polynomials decided, all alike."
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
determinant of the rows' (g, e); its derivative is a combination of their 2x2 minors and vanishes where all do, with the same conclusion.
Simple roots, one mode each; boxes around them that do not meet, each proved to hold exactly one solution of the loop equations: then each holds one
mode, and there is no other."
        .to_string()
}

/// Step 6: how often the filter decides, and that it never contradicts exact arithmetic.
fn share() -> String {
    let mut random = Random(11);
    let (count, mut decided) = (400, 0);
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
    }
    assert!(100 * decided >= 99 * count, "{decided} of {count}");
    format!(
        "Step 6. Of {count} random RR-RR-RR triads the filter decides {decided}, each as exact arithmetic does; the rest goes to integers."
    )
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_step_holds() {
        assert!(super::document().contains("Step 6"));
    }
}
