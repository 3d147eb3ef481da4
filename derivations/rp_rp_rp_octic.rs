//! The octic of the RP-RP-RP group is a quartic.
//!
//! `cargo run --release --example rp_rp_rp_octic` prints the derivation, `cargo test` checks it.

use assur::algebra::{Poly, Rational, Ring};
use assur::eliminate::{NamedFactor, Power, resultant};
use assur::linkage::rp_rp_rp_quartic;
use assur::nalgebra::Vector2;
use assur::{Dyad, Offset, Plan, System, Triad, eliminate, lift};

type P = Poly<Rational>;

/// The document, checked step by step while it is made.
pub fn document() -> String {
    let steps = [claim, leading_coefficient, named_platforms, any_platform, open_platform, published_case];
    steps.map(|step| step() + "\n\n").concat()
}

/// Prints the document.
pub fn main() {
    print!("{}", document());
}

fn claim() -> String {
    "THE OCTIC OF RP-RP-RP IS A QUARTIC
Claim. Eliminating two sliders from the three cosine laws of the RP-RP-RP group leaves, formally, an octic in the third. For every
platform whose angles sum to pi its coefficients P8, P7, P6, P5 vanish identically. Of the four roots left two build the platform
and two its mirror image.

Symbols. A1 A2 A3 base pivots; B1 B2 B3 platform corners, counter-clockwise; slider i runs along B_i B_(i+1), indices mod 3.
  s_i  from A_i to B_i along side i        l_i  length of side i        c_i = 2 cos(angle at B_(i+1))        D_i = |A_i A_(i+1)|^2
Source. S. Mitsi, K.-D. Bouzakis, G. Mansour, I. Popescu, eqs. (9)-(13), tables 1 and 2; the cosine laws are reconstructed, since their
printed forms are lost, and reproduce every published number but one.

Step 1. In the triangle A_i B_(i+1) A_(i+1) the legs s_i + l_i and s_(i+1) enclose pi less the platform's angle:
  Q_i:  (s_i + l_i)^2 + c_i (s_i + l_i) s_(i+1) + s_(i+1)^2 - D_i = 0.
Step 2. F(s2, s3) = Res_s1(Q_1, Q_3), octic(s2) = Res_s3(F, Q_2) = P8 s2^8 + ... + P0."
        .to_string()
}

/// `(s_i + l)² + c (s_i + l) s_j + s_j² - D`.
fn quadric(i: usize, length: P, c: P, squared_distance: P) -> P {
    let (leg, other) = (P::variable(i) + length, P::variable((i + 1) % 3));
    leg.power(2) + c * leg * other.clone() + other.power(2) - squared_distance
}

fn octic([q1, q2, q3]: &[P; 3]) -> P {
    resultant(&resultant(q1, q3, 0), q2, 2)
}

/// Step 3: P8 depends on the angles alone and is a square.
fn leading_coefficient() -> String {
    let c = [3, 4, 5].map(P::variable);
    let forms = [0, 1, 2].map(|i: usize| quadric(i, P::zero(), c[i].clone(), P::zero()));
    let octic = octic(&forms);
    let coefficients = octic.coefficients_in(1);
    assert_eq!(coefficients.len(), 9, "the octic of the leading forms is homogeneous");
    assert!(coefficients[..8].iter().all(P::vanishes));
    let closing =
        c.iter().fold(P::from_int(-4), |sum, c| sum + c.power(2)) + c[0].clone() * c[1].clone() * c[2].clone();
    let opening =
        c.iter().fold(P::from_int(-4), |sum, c| sum + c.power(2)) - c[0].clone() * c[1].clone() * c[2].clone();
    let (rest, power) = NamedFactor::new("the angles sum to pi", closing)
        .remove_from(&coefficients[8], Power::AsOftenAsItDivides)
        .expect("the factor is not zero");
    assert_eq!((power, &rest), (2, &P::one()), "P8 is the square of the closing condition");
    assert!(opening.vanishes() || coefficients[8] != opening.clone() * opening);
    "Step 3. P8 comes from the squares alone. As an identity in c1, c2, c3:
  P8 = (c1^2 + c2^2 + c3^2 + c1 c2 c3 - 4)^2,
and the bracket vanishes where the three angles sum to pi: P8 = 0 for every platform that closes.   [checked: identity in symbols]"
        .to_string()
}

/// Step 4: P7, P6, P5 for named platforms, the base free.
fn named_platforms() -> String {
    let mut text = "Step 4. Platforms with rational sides and cosines, the base free (D1, D2, D3 symbols):".to_string();
    for sides in [[3, 4, 5], [13, 14, 15], [1, 1, 1], [4, 5, 6]] {
        let quadrics = [0, 1, 2].map(|i: usize| {
            let c = double_cosine(sides, i);
            quadric(i, P::from_int(sides[i]), P::constant(c), P::variable(3 + i))
        });
        let coefficients = octic(&quadrics).coefficients_in(1);
        assert_eq!(coefficients.len(), 5, "sides {sides:?}: P8 to P5 vanish and P4 does not");
        text += &format!(
            "\n  sides {sides:?}: P8 = P7 = P6 = P5 = 0, P4 = {} terms in D1, D2, D3",
            coefficients[4].term_count()
        );
    }
    text + "   [checked: identities in D1, D2, D3]"
}

/// Twice the cosine at B_(i+1), between sides i and i + 1.
fn double_cosine(sides: [i64; 3], i: usize) -> Rational {
    let [a, b, opposite] = [sides[i], sides[(i + 1) % 3], sides[(i + 2) % 3]].map(Rational::from);
    (a.clone() * a.clone() + b.clone() * b.clone() - opposite.clone() * opposite) / (a * b)
}

/// A rational platform from the half-angle tangents of two angles: sides by the law of sines, angles summing to pi by construction.
fn platform(t: [Rational; 2]) -> ([Rational; 3], [Rational; 3]) {
    let one = Rational::ONE;
    let [cos_sin_1, cos_sin_2] = t.map(|t| {
        let square = t.clone() * t.clone();
        let w = one.clone() + square.clone();
        [(one.clone() - square) / w.clone(), Rational::from(2) * t / w]
    });
    let ([c1, s1], [c2, s2]) = (cos_sin_1, cos_sin_2);
    let s3 = s1.clone() * c2.clone() + c1.clone() * s2.clone();
    let c3 = s1.clone() * s2.clone() - c1.clone() * c2.clone();
    // Angles at B1, B2, B3; side i from B_i to B_(i+1) faces the third corner.
    let two = Rational::from(2);
    ([s3, s1, s2], [two.clone() * c2, two.clone() * c3, two * c1])
}

/// Seeded integers, uniform on `1..=2^20`.
fn random(state: &mut u64) -> Rational {
    *state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    Rational::from((*state >> 44) + 1)
}

/// Step 5: any platform.
fn any_platform() -> String {
    const TRIALS: usize = 20;
    let mut state = 20030807;
    for _ in 0..TRIALS {
        let tangents = [random(&mut state) / random(&mut state), random(&mut state) / random(&mut state)];
        let (l, c) = platform(tangents);
        let scale = random(&mut state);
        let quadrics = [0, 1, 2].map(|i: usize| {
            let distance = P::constant(random(&mut state));
            quadric(i, P::constant(l[i].clone() * scale.clone()), P::constant(c[i].clone()), distance)
        });
        assert_eq!(octic(&quadrics).degree_in(1), 4);
    }
    format!(
        "Step 5. Every platform: two half-angle tangents p, q give cosines and, by the law of sines, sides, all rational in p, q.
  At {TRIALS} seeded random (p, q, scale, D1, D2, D3), numerators and denominators up to 2^20, P8 to P5 vanish exactly and P4 does not.
  Each P_k is of degree 4 in the coefficients of each Q_i, and these, cleared of denominators, of degree at most 10 in the eight
  integers: 8 from the angles, 2 from the scale. Were a P_k of degree 120 not zero, a trial would miss it with probability at most
  120/2^20 (Schwartz, Zippel), all {TRIALS} with less than 10^-78.   [checked]"
    )
}

/// Step 6: angles that do not close.
fn open_platform() -> String {
    let c = [1, 1, -1].map(P::from_int);
    let quadrics = [0, 1, 2].map(|i: usize| quadric(i, P::from_int(1), c[i].clone(), P::from_int(9 + i as i64)));
    assert_eq!(octic(&quadrics).degree_in(1), 8);
    "Step 6. Angles 60, 60 and 120 degrees belong to no triangle; with them the degree is eight. So the octic is one only for
  inconsistent data, such as cosines rounded to floats, whose noise in P8 to P5 makes four spurious huge roots.   [checked]"
        .to_string()
}

/// Step 7: the published example, by the function of the library.
fn published_case() -> String {
    let root_3 = 3f64.sqrt();
    let degrees = |x: f64| x.to_radians();
    let fixed = [[0.0, 0.0], [140.0, 0.0], [70.0, 70.0 * root_3]].map(Vector2::from);
    let turned = [60.0, 100.0, 210.0].map(degrees);
    let pivots = [0, 1, 2].map(|i: usize| fixed[i] + 20.0 * Vector2::new(turned[i].cos(), turned[i].sin()));
    let corners = [[0.0, 0.0], [40.0, 0.0], [20.0, 20.0 * root_3]].map(Vector2::from);
    let leg = |i: usize| Dyad::RP {
        a: pivots[i],
        b: corners[i],
        v: corners[(i + 1) % 3] - corners[i],
        offset: Offset::Distance(0.0),
    };
    let triad = Triad::new([leg(0), leg(1), leg(2)]).expect("the published numbers make a triad");
    let found = rp_rp_rp_quartic(&triad).expect("an equilateral platform is a triangle");
    assert_eq!((found.quartic.degree(), found.account.at_infinity), (Some(4), 4));
    assert_eq!((found.account.real, found.account.complex), (2, 2));
    assert!(found.mirrored.is_empty() && found.proper.len() == 2);

    // Table 1 and table 2, to the digits printed; y_B2 of configuration 1 is printed 44.8191, at odds with the sides of 40.
    let table = [
        ([-77.5558, -103.5205, -79.5285], [[63.6963, 73.2813], [36.0020, 44.4191], [74.8446, 34.8662]]),
        ([42.7405, 62.9381, 34.9262], [[48.2205, 36.4501], [83.9904, 54.3532], [50.6010, 76.3792]]),
    ];
    let mut text = "Step 7. The published case: three pivots on cranks of 20, an equilateral platform of 40, by `rp_rp_rp_quartic`.".to_string();
    for (number, (sliders, corners)) in table.into_iter().enumerate() {
        let matches = |s: &[f64; 3]| s.iter().zip(&sliders).all(|(a, b)| (a - b).abs() < 0.51e-4);
        let pose =
            found.proper.iter().find(|p| matches(&p.sliders)).expect("the published sliders are among those found");
        assert!(pose.residual < 1e-13);
        for (corner, printed) in pose.corners.iter().zip(corners) {
            assert!((corner - Vector2::from(printed)).amax() < 0.51e-4, "{corner} {printed:?}");
        }
        let [b1, b2, b3] = pose.corners.map(|b| format!("({:.4}, {:.4})", b.x, b.y));
        let [s1, s2, s3] = pose.sliders;
        text += &format!("\n  configuration {}: s = {s1:.4}, {s2:.4}, {s3:.4}; B1 {b1}, B2 {b2}, B3 {b3}", number + 1);
    }
    let mirrored = mirrored_sliders(&pivots);
    assert!((mirrored.0 + 39.252).abs() < 1e-3 && (mirrored.1 - 137.072).abs() < 1e-3);
    text += "\n  All digits agree but one: y_B2 of configuration 1 is 44.4191, printed 44.8191, which would make the sides 39.712 and 40.098.";
    text + &format!(
        "\n  The other two roots, s2 = {:.3} +- {:.3} i, build the mirrored platform: area(A'1 A'2 A'3) has the other sign.   [checked]",
        mirrored.0, mirrored.1
    )
}

/// The two roots that are not proper, as real and imaginary part of s2, and the sign of the area they lead to.
fn mirrored_sliders(pivots: &[Vector2<f64>; 3]) -> (f64, f64) {
    let number = |x: f64| P::constant(assur::algebra::dyadic(x).expect("finite"));
    let quadrics = [0, 1, 2].map(|i: usize| {
        let distance = (pivots[i] - pivots[(i + 1) % 3]).norm_squared();
        quadric(i, P::from_int(40), P::one(), number(distance))
    });
    let [q1, q2, q3] = quadrics;
    let system = System::new(["s1", "s2", "s3"]).with("Q1", q1).with("Q2", q2).with("Q3", q3);
    let plan = Plan::new("s2").resultant("F", ("Q1", "Q3"), "s1").resultant("octic", ("F", "Q2"), "s3").of_degree(8);
    let found =
        lift(&system, &plan, &eliminate(&system, &plan).expect("the plan fits")).expect("the quartic has roots");
    assert_eq!((found.account.real, found.account.complex, found.account.at_infinity), (2, 2, 4));
    // Signed area of the body points B_i - s_i u_i, from corners and unit sides of the equilateral platform.
    let h = 3f64.sqrt() / 2.0;
    let (corners, units) = ([[0.0, 0.0], [40.0, 0.0], [20.0, 40.0 * h]], [[1.0, 0.0], [-0.5, h], [-0.5, -h]]);
    let base = (pivots[1] - pivots[0]).perp(&(pivots[2] - pivots[0]));
    let mut mirrored = (0.0, 0.0);
    for solution in &found.solutions {
        let p = [0, 1, 2].map(|i: usize| [0, 1].map(|k: usize| corners[i][k] - solution.values[i] * units[i][k]));
        let d = |i: usize, k: usize| p[i][k] - p[0][k];
        let area = d(1, 0) * d(2, 1) - d(1, 1) * d(2, 0);
        let sign = area.re / base;
        // Equal up to sign, whatever the root: the triangles are congruent, directly or by reflection.
        assert!(area.im.abs() < 1e-8 * base.abs() && (sign.abs() - 1.0).abs() < 1e-9);
        assert_eq!(sign > 0.0, solution.real, "here the proper roots are the real ones");
        if sign < 0.0 {
            mirrored = (solution.values[1].re, solution.values[1].im.abs());
        }
    }
    mirrored
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_step_holds() {
        let steps = [
            super::claim,
            super::leading_coefficient,
            super::named_platforms,
            super::any_platform,
            super::open_platform,
            super::published_case,
        ];
        for step in steps {
            assert!(step().contains("Step"));
        }
    }
}
