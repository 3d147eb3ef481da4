//! The Cartesian three-legged robot: its equations as printed and as corrected, its singularities.

use assur::algebra::{Rational, Ring};
use assur::nalgebra::Vector3;
use assur::{CartesianRobot, Tripod, TripodPose};

#[path = "page.rs"]
mod page;

use page::Page;

fn q(n: i64, d: i64) -> Rational {
    Rational::from_int(n) / Rational::from_int(d)
}

/// The text, with every step checked.
pub fn document() -> String {
    let mut page = Page::new(
        "The Cartesian three-legged robot",
        "Claim: equations (14) and (15) of the paper have rho3 where it must be rho5; det J = (d2 - d1)³(1 - T)(1 + T)/(r11 r22 r33).\n\
         Symbols: t1 = r12/r22, t2 = r23/r33, t3 = r31/r11, T = t1 t2 t3; rho1 = x + (d1 - y) t1, rho3 = y + (d1 - z) t2, rho5 = z + (d1 - x) t3.\n\
         Source: Cherkhelanov, Bonev, eqs. (5)-(23).",
    );
    page.step(
        "The place, over the rationals",
        "At rational places and tangents the inputs are rational, and each formula is right or wrong exactly.",
    );
    let (mut corrected, mut printed) = (0, 0);
    let count = 60;
    for k in 1..=count {
        let [x, y, z] = [q(7 * k - 90, 11), q(5 * k + 3, 7), q(40 - 3 * k, 13)];
        let [t1, t2, t3] = [q(k % 7 - 3, 5), q(k % 5 - 2, 3), q(k % 11 - 5, 4)];
        let d = q(600, 1);
        let r1 = x.clone() + (d.clone() - y.clone()) * t1.clone();
        let r3 = y.clone() + (d.clone() - z.clone()) * t2.clone();
        let r5 = z.clone() + (d.clone() - x.clone()) * t3.clone();
        let product = t1.clone() * t2.clone() * t3.clone();
        if product == Rational::one() || t1 == Rational::zero() || t2 == Rational::zero() {
            continue;
        }
        let over = |numerator: Rational| numerator / (product.clone() - Rational::one());
        let base = d.clone() * product.clone();
        let x_with = |rho: &Rational| {
            over(
                base.clone()
                    + (d.clone() - rho.clone()) * t1.clone() * t2.clone()
                    + (d.clone() - r3.clone()) * t1.clone()
                    - r1.clone(),
            )
        };
        let y_with = |rho: &Rational| {
            over(
                base.clone()
                    + (d.clone() - r1.clone()) * t2.clone() * t3.clone()
                    + (d.clone() - rho.clone()) * t2.clone()
                    - r3.clone(),
            )
        };
        let z_found = over(
            base.clone() + (d.clone() - r3.clone()) * t1.clone() * t3.clone() + (d.clone() - r1.clone()) * t3.clone()
                - r5.clone(),
        );
        assert!(x_with(&r5) == x && y_with(&r5) == y && z_found == z, "case {k}");
        corrected += 1;
        printed += usize::from(x_with(&r3) == x && y_with(&r3) == y);
    }
    page.holds("(14), (15) with rho5 and (16) as printed: exact in every case", corrected > 20);
    page.equal("(14), (15) as printed, with rho3: right in no case", &printed, &0);

    page.step(
        "The orientation",
        "x' = r11 (1, a3, t3), y' = r22 (t1, 1, a1), z' = r33 (a2, t2, 1) are square to each other, which is linear in a1, a2, a3 with the determinant 1 + T; \
         (17)-(23) are its solution. For T < -1 the three have the determinant -1: a reflection.",
    );
    let robot = CartesianRobot { d1: 600.0, d2: 720.0 };
    let general = Tripod::cartesian(600.0, 720.0).expect("the distances differ");
    let (mut turned, mut determinant, mut tried): (f64, f64, usize) = (0.0, 0.0, 0);
    for seed in 1..=400 {
        let n = |k: f64| (f64::from(seed) * 2.1 + 1.7 * k).sin();
        let pose =
            TripodPose::new(Vector3::new(n(1.0), n(2.0), n(3.0)) * 300.0, Vector3::new(n(4.0), n(5.0), n(6.0)) * 0.8);
        if pose.rotation.matrix().diagonal().min() < 0.2 {
            continue;
        }
        let inputs = robot.inverse(&pose).expect("within a quarter turn");
        let t: f64 = [0, 2, 4].iter().map(|&k| (inputs[k + 1] - inputs[k]) / 120.0).product();
        if f64::min((1.0 - t).abs(), 1.0 + t) < 0.05 {
            continue;
        }
        tried += 1;
        let back = robot.forward(&inputs).expect("T > -1");
        turned = turned.max((back.rotation.matrix() - pose.rotation.matrix()).norm());
        let jacobian = general.velocity(&pose).expect("regular").jacobian.determinant();
        determinant = determinant.max((robot.jacobian_determinant(&inputs).expect("T > -1") / jacobian - 1.0).abs());
    }
    page.holds("CartesianRobot::forward returns the orientation to 1e-11", tried > 200 && turned < 1e-11);

    page.step(
        "The determinant of the Jacobian",
        "The normals of the three planes span a volume proportional to 1 - T, the turning axes one proportional to 1 + T.",
    );
    page.holds("det J = (d2 - d1)³(1 - T)(1 + T)/(r11 r22 r33), against Tripod::velocity, to 1e-9", determinant < 1e-9);
    page.finish()
}

pub fn main() {
    print!("{}", document());
}

#[test]
fn every_step_holds() {
    assert!(!document().is_empty());
}
