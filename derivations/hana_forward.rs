//! HANA's forward kinematics is a product, so square roots do.

use assur::algebra::{Integer, Poly, Ring};
use assur::{Hana, HanaFamily};

#[path = "page.rs"]
mod page;

use page::Page;

type P = Poly<Integer>;

/// The text, with every step checked.
pub fn document() -> String {
    let mut page = Page::new(
        "HANA's forward kinematics",
        "Claim: for given slider heights HANA has at most eight assemblies, in two families of four, each by two square roots.\n\
         Symbols: r, R radii, L, L3 links, z1, z2, z3 inputs, (y, z, phi) the pose, s = sin phi, c = cos phi.\n\
         Source: Liu, Wang, Wang, Li 2004, eqs. (7)-(9).",
    );
    let [r, base, l, y, z, s, c, z1, z2] = [0, 1, 2, 3, 4, 5, 6, 7, 8].map(P::variable);
    let two = || P::from_int(2);
    let across = base.clone() - r.clone() * c.clone();
    let closure = |down: P| across.power(2) + y.power(2) + down.power(2) - l.power(2);
    let tilt = r.clone() * s.clone();
    let one = closure(z.clone() - tilt.clone() - z1.clone());
    let other = closure(z.clone() + tilt.clone() - z2.clone());
    page.step(
        "The closures of legs 1 and 2",
        "Links of length L from (R, 0, z1) to P1 and from (-R, 0, z2) to P2; their difference is free of y, R and L.",
    );
    let first = z2.clone() - z1.clone() - two() * tilt.clone();
    let second = two() * z.clone() - z1.clone() - z2.clone();
    page.equal("(1) - (2) = (z2 - z1 - 2 r s)(2 z - z1 - z2)", &(one.clone() - other.clone()), &(first * second));

    page.step(
        "Family A: sin phi = (z2 - z1)/(2r)",
        "Both sliders are on the same side of their joints. With r s = (z2 - z1)/2 the joints' heights above them are the same, so the centre lies on a circle \
         about (0, (z1 + z2)/2) of radius² L² - (R - r c)²; leg 3 puts it on a circle about (r - R, z3) of radius L3. cos phi has two signs, two circles meet twice.",
    );
    // 2 r s = z2 - z1, in (1) times 4: no division.
    let doubled = two() * z.clone() - z1.clone() - z2.clone();
    let four_one = P::from_int(4) * (across.power(2) + y.power(2) - l.power(2)) + doubled.power(2);
    let substituted = P::from_int(4) * one.clone();
    // z - r s - z1 = z - (z2 - z1)/2 - z1: replace 2 r s.
    let down = two() * z.clone() - two() * z1.clone() - (z2.clone() - z1.clone());
    let replaced = substituted - P::from_int(4) * (z.clone() - tilt.clone() - z1.clone()).power(2) + down.power(2);
    page.equal("4·(1) = 4((R - r c)² + y² - L²) + (2 z - z1 - z2)²", &replaced, &four_one);

    page.step(
        "Family B: z = (z1 + z2)/2",
        "The sliders are on opposite sides. Leg 3 gives two y; with d = (z2 - z1)/2 leg 1 is linear in (c, s) once c² + s² = 1 is used, so each y has two phi.",
    );
    let d = P::variable(9);
    let at = across.power(2) + y.power(2) + (d.clone() - tilt).power(2) - l.power(2);
    let circle = c.power(2) + s.power(2) - P::one();
    let linear = r.power(2) + base.power(2) + d.power(2) + y.power(2)
        - l.power(2)
        - two() * r.clone() * base * c
        - two() * r.clone() * d * s;
    page.equal(
        "(1) = r² + R² + d² + y² - L² - 2 r R c - 2 r d s + r²(c² + s² - 1)",
        &at,
        &(linear + r.power(2) * circle),
    );

    page.step("Against src/", "Hana::forward on many inputs: each mode is in the family whose factor vanishes.");
    let mut modes = 0;
    for seed in 1..=400 {
        let n = |k: f64| (f64::from(seed) * 1.7 + 2.3 * k).sin();
        let robot = Hana { third_link: 12.0 + 3.0 * n(9.0), ..Hana::example() };
        let inputs = [4.0 * n(1.0), 4.0 * n(2.0), 4.0 * n(3.0)];
        let answer = robot.forward(&inputs).expect("finite");
        for mode in &answer.modes {
            modes += 1;
            let factor = match mode.family {
                HanaFamily::SameSide => inputs[1] - inputs[0] - 6.0 * mode.pose.phi.sin(),
                HanaFamily::OppositeSides => 2.0 * mode.pose.z - inputs[0] - inputs[1],
            };
            assert!(factor.abs() < 1e-12, "{factor:e}");
        }
    }
    page.holds("400 inputs, every mode in its family", modes > 800);
    page.finish()
}

pub fn main() {
    print!("{}", document());
}

#[test]
fn every_step_holds() {
    assert!(!document().is_empty());
}
