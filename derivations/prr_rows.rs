//! The matrices of 3-PRR as printed in 1996, against what they must be.

use assur::{Leg, Manipulator, Pose};

/// The text, with every step checked.
pub fn document() -> String {
    let mut text = String::from(
        "The matrices of 3-PRR, printed and corrected\n\
         ============================================\n\
         Gosselin, Lemieux and Merlet (1996), \"A new architecture of planar three-degree-of-freedom parallel manipulator\", eqs. (7)-(19).\n\
         Rail through (xA, yA) at alpha, link l, platform pivot (x', y') in the platform frame, slider at rho.\n\n",
    );
    let (mut printed_10, mut printed_19) = (0.0_f64, 0.0_f64);
    let (mut worst_10, mut worst_a, mut worst_19) = (0.0_f64, 0.0_f64, 0.0_f64);
    for seed in 1..=300 {
        let n = |k: f64| (f64::from(seed) * 1.9 + 2.7 * k).sin();
        let geometry: Vec<([f64; 2], f64, [f64; 2])> = (0..3)
            .map(|k| {
                let k = 10.0 * f64::from(k);
                ([3.0 * n(k), 3.0 * n(k + 1.0)], 3.0 * n(k + 2.0), [n(k + 3.0), n(k + 4.0)])
            })
            .collect();
        let l = 9.0;
        let legs = geometry.iter().map(|&(a, alpha, c)| Leg::prr(a, alpha, l, c)).collect();
        let robot = Manipulator::new("", legs).expect("is sound");
        let pose = Pose::new(n(31.0), n(32.0), 3.0 * n(33.0));
        let velocity = robot.velocity(&pose, "+-+").expect("long links reach");
        let (x, y, phi) = (pose.x, pose.y, pose.phi);
        for (k, &([xa, ya], alpha, [xp, yp])) in geometry.iter().enumerate() {
            let (dx, dy) = (x + xp * phi.cos() - yp * phi.sin() - xa, y + xp * phi.sin() + yp * phi.cos() - ya);
            // Equations (7)-(10).
            let m = dx * alpha.cos() + dy * alpha.sin();
            let sign = if k == 1 { -1.0 } else { 1.0 };
            let rho_with = |s: f64| m + sign * (l * l - s * s).sqrt();
            let rho = rho_with(-dx * alpha.sin() + dy * alpha.cos());
            let rho_printed = rho_with(dx * alpha.sin() + dy * alpha.cos());
            worst_10 = worst_10.max((rho - velocity.joints[k][0]).abs());
            printed_10 = printed_10.max((rho_printed - velocity.joints[k][0]).abs());
            // Equations (16)-(18), all ten terms of the last.
            let a = -rho * alpha.cos() - xa + x + xp * phi.cos() - yp * phi.sin();
            let b = -ya + y + yp * phi.cos() + xp * phi.sin() - rho * alpha.sin();
            let c = -xp * ya * phi.cos() + xp * y * phi.cos() + rho * yp * (phi - alpha).cos() + xa * yp * phi.cos()
                - x * yp * phi.cos()
                + xa * xp * phi.sin()
                - x * xp * phi.sin()
                + ya * yp * phi.sin()
                - y * yp * phi.sin()
                + rho * xp * (phi - alpha).sin();
            let row = velocity.pose_matrix.row(k);
            worst_a = [a - row[0], b - row[1], c - row[2]].iter().fold(worst_a, |w, d| w.max(d.abs()));
            // Equation (19).
            let d_with = |turned: f64| {
                rho + xa * alpha.cos() - x * alpha.cos() - xp * turned.cos()
                    + yp * (phi - alpha).sin()
                    + ya * alpha.sin()
                    - y * alpha.sin()
            };
            let d = velocity.input_matrix[(k, k)];
            worst_19 = worst_19.max((d_with(phi - alpha) - d).abs());
            printed_19 = printed_19.max((d_with(phi + alpha) - d).abs());
        }
    }
    text += "(10) printed    S =  dx sin(alpha) + dy cos(alpha): the slider misses its place by up to ";
    text += &format!("{printed_10:.2}\n");
    text += "     corrected  S = -dx sin(alpha) + dy cos(alpha): agrees with Manipulator::velocity to 1e-12\n";
    text += "(16)-(18)       as printed: all nine entries agree with pose_matrix to 1e-12\n";
    text += &format!("(19) printed    -x' cos(phi + alpha): off by up to {printed_19:.2}\n");
    text += "     corrected  -x' cos(phi - alpha): agrees with input_matrix to 1e-12\n";
    assert!(worst_10 < 1e-12 && worst_a < 1e-12 && worst_19 < 1e-12, "{worst_10:e} {worst_a:e} {worst_19:e}");
    assert!(printed_10 > 0.1 && printed_19 > 0.1, "the printed forms are wrong");
    text
}

pub fn main() {
    print!("{}", document());
}

#[test]
fn every_step_holds() {
    assert!(!document().is_empty());
}
