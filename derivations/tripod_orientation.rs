//! The orientation of a three-legged robot: degree 8 in the tangent of half an angle.

use assur::PlaneConditions;
use assur::algebra::{Integer, Poly, Ring};
use assur::eliminate::resultant_formal;
use assur::nalgebra::{Rotation3, Vector3};

#[path = "page.rs"]
mod page;

use page::Page;

type P = Poly<Integer>;

/// The text, with every step checked.
pub fn document() -> String {
    let mut page = Page::new(
        "The orientation of a three-legged robot",
        "Claim: rotations R with n_i · R v_i = k_i, i = 1, 2, 3, are the roots of a polynomial of degree 8.\n\
         Symbols: R v1 runs over a circle by the angle theta, R turns about it by psi; X = cos psi, Y = sin psi.\n\
         Conditions 2 and 3 are A_i X + B_i Y + C_i = 0 with A, B, C of order 1 in theta.",
    );
    let [x, y, a2, b2, c2, a3, b3, c3] = [0, 1, 2, 3, 4, 5, 6, 7].map(P::variable);
    let equation = |a: &P, b: &P, c: &P| a.clone() * x.clone() + b.clone() * y.clone() + c.clone();
    let (second, third) = (equation(&a2, &b2, &c2), equation(&a3, &b3, &c3));
    let circle = x.power(2) + y.power(2) - P::one();
    page.step("Eliminating X and Y", "By Sylvester resultants, from the two conditions and X² + Y² = 1.");
    let line = resultant_formal(&second, &third, 0, (1, 1)).expect("the degrees are these");
    let conic = resultant_formal(&second, &circle, 0, (1, 2)).expect("the degrees are these");
    let last = resultant_formal(&line, &conic, 1, (1, 2)).expect("the degrees are these");
    let minor = |p: &P, q: &P, r: &P, s: &P| (p.clone() * q.clone() - r.clone() * s.clone()).power(2);
    let closed = minor(&b2, &c3, &b3, &c2) + minor(&c2, &a3, &c3, &a2) - minor(&a2, &b3, &a3, &b2);
    page.equal(
        "Res = A2²·E,  E = (B2 C3 - B3 C2)² + (C2 A3 - C3 A2)² - (A2 B3 - A3 B2)²",
        &last,
        &(a2.power(2) * closed),
    );
    page.step(
        "The degree",
        "E is of degree 4 in A, B, C, each of order 1 in theta: of order 4, so of degree 8 in tan(theta/2). Res has the factor A2² besides, which comes from \
         eliminating X from condition 2 where it does not contain it; PlaneConditions leaves it out.",
    );
    page.step(
        "Against src/",
        "PlaneConditions::resultant vanishes at the theta of planted rotations, and solve() finds them again.",
    );
    let mut worst: f64 = 0.0;
    for seed in 1..=200 {
        let n = |k: f64| (f64::from(seed) * 1.3 + 2.9 * k).sin();
        let direction = |k: f64| Vector3::new(n(k), n(k + 1.0), n(k + 2.0)).normalize();
        let planted = Rotation3::new(direction(1.0) * 3.0 * n(20.0));
        let (normals, directions) =
            ([direction(4.0), direction(7.0), direction(10.0)], [direction(13.0), direction(16.0), direction(21.0)]);
        let cosines = std::array::from_fn(|k| normals[k].dot(&(planted * directions[k])));
        let conditions = PlaneConditions { normals, directions, cosines };
        let (polynomial, frame) = conditions.resultant();
        let p = frame.transpose() * (planted * directions[0]);
        let t = f64::tan(0.5 * f64::atan2(p.y, p.x));
        let size: f64 =
            polynomial.coefficients().iter().enumerate().map(|(k, c)| c.abs() * t.abs().powi(k as i32)).sum();
        worst = worst.max(polynomial.evaluate(&t).abs() / size);
        let found = conditions.solve();
        let near = |r: &Rotation3<f64>| (r.matrix() - planted.matrix()).norm() < 1e-6;
        assert!(found.rotations.iter().any(|(r, _)| near(r)), "seed {seed}");
    }
    page.holds("200 planted rotations: E vanishes to 1e-8 of its terms, each is found", worst < 1e-8);
    page.finish()
}

pub fn main() {
    print!("{}", document());
}

#[test]
fn every_step_holds() {
    assert!(!document().is_empty());
}
