//! The quadratic term of the accelerations, for any leg and for 3-PRR.

use assur::algebra::{Poly, Rational, Ring};
use assur::manipulator::{power, screw_rate};
use assur::nalgebra::{Vector2, Vector3};
use assur::{JointKind, Leg, Manipulator, Pose};

type Symbol = Poly<Rational>;

/// The text, with every step checked.
pub fn document() -> String {
    let mut text = String::from(
        "The quadratic term of the accelerations\n\
         =======================================\n\
         Claim. Differentiating  A pose' + B inputs' = 0  once more gives  A pose'' + B inputs'' + beta = 0  with\n\
         beta = -w.(sum of s_k' q_k')  for a row w, s_k the screws of its leg. For 3-PRR, with L the link from slider to\n\
         platform pivot, r = R c, v = (x', y') + phi' E r:  beta = |v - rho' e|^2 - phi'^2 L.r.\n\
         Source: ours; the abstract of Gosselin, Lemieux and Merlet (1996) promises accelerations, the text has none.\n\n\
         1. pose' = sum s_k q_k', so pose'' = sum s_k q_k'' + sum s_k' q_k'. In the product with w the idle q_k'' drop out,\n\
            since w.s_k = 0 for them: w.pose'' = (w.s_a) q_a'' + w.(sum s_k' q_k'). That is the claim, with B = -w.s_a.\n",
    );
    let names = ["Lx", "Ly", "rx", "ry", "ex", "ey", "rho'", "omega", "phi'"];
    let s: Vec<Symbol> = (0..names.len()).map(Symbol::variable).collect();
    let (l, r, e) = ([&s[0], &s[1]], [&s[2], &s[3]], [&s[4], &s[5]]);
    let (rho, omega, phi) = (&s[6], &s[7], &s[8]);
    let quarter = |a: [&Symbol; 2]| [-a[1].clone(), a[0].clone()];
    let dot = |a: &[Symbol; 2], b: &[Symbol; 2]| a[0].clone() * b[0].clone() + a[1].clone() * b[1].clone();
    let own = |a: [&Symbol; 2]| [a[0].clone(), a[1].clone()];
    let sum = |a: &[Symbol; 2], f: &Symbol, b: &[Symbol; 2]| {
        [a[0].clone() + f.clone() * b[0].clone(), a[1].clone() + f.clone() * b[1].clone()]
    };
    let zero = [Symbol::zero(), Symbol::zero()];

    text += "2. 3-PRR. The link turns at omega: v = rho' e + omega E L. The mark moves with v - phi' E r.\n";
    let slider = sum(&zero, rho, &own(e));
    let pivot = sum(&slider, omega, &quarter(l));
    let mark = sum(&pivot, &-phi.clone(), &quarter(r));
    let rates = [
        screw_rate(JointKind::Prismatic, &zero, &own(e), &Symbol::zero(), &mark),
        screw_rate(JointKind::Revolute, &slider, &own(e), &Symbol::zero(), &mark),
        screw_rate(JointKind::Revolute, &pivot, &own(e), omega, &mark),
    ];
    let joint_rates = [rho.clone(), omega.clone(), phi.clone() - omega.clone()];
    // The moment of w is of no consequence: screws change in their velocity parts only.
    assert!(rates.iter().all(|rate| rate[2] == Symbol::zero()));
    let w = [l[0].clone(), l[1].clone(), Symbol::zero()];
    let drift = rates.iter().zip(&joint_rates);
    let beta = drift.fold(Symbol::zero(), |sum, (rate, q)| sum - power(&w, rate) * q.clone());
    let along = sum(&pivot, &-rho.clone(), &own(e));
    let stated = dot(&along, &along) - phi.clone() * phi.clone() * dot(&own(l), &own(r));
    assert_eq!(beta, stated);
    text += "   -w.(sum s_k' q_k') = |v - rho' e|^2 - phi'^2 L.r, identically in nine symbols.\n";

    text += "3. The loop equation itself, |L|^2 = l^2, differentiated twice: L'.L' + L.L'' with L' = v - rho' e and\n   \
             L'' = (x'', y'') + phi'' E r - phi'^2 r - rho'' e. Its part without accelerations is the same beta.\n";
    let part = dot(&along, &along) + dot(&own(l), &sum(&zero, &-(phi.clone() * phi.clone()), &own(r)));
    assert_eq!(part, stated);

    text += "4. Velocity::quadratic_term agrees. Largest difference over 200 states of a 3-PRR: ";
    let worst = (1..=200).map(|k| compare(f64::from(k))).fold(0.0, f64::max);
    assert!(worst < 1e-12, "{worst:e}");
    text += "below 1e-12\n";
    text
}

fn compare(seed: f64) -> f64 {
    let n = |k: f64| (seed * 1.3 + 2.1 * k).sin();
    let geometry: Vec<([f64; 2], f64, f64, [f64; 2])> = (0..3)
        .map(|k| {
            let k = 10.0 * f64::from(k);
            ([4.0 * n(k), 4.0 * n(k + 1.0)], 3.0 * n(k + 2.0), 9.0, [n(k + 3.0), n(k + 4.0)])
        })
        .collect();
    let legs = geometry.iter().map(|&(a, alpha, l, c)| Leg::prr(a, alpha, l, c)).collect();
    let robot = Manipulator::new("", legs).expect("is sound");
    let pose = Pose::new(n(31.0), n(32.0), 3.0 * n(33.0));
    let velocity = robot.velocity(&pose, "+-+").expect("long links reach");
    let rates = Vector3::new(n(34.0), n(35.0), n(36.0));
    let inputs = velocity.input_rates(&rates).expect("regular");
    let found = velocity.quadratic_term(&rates, &inputs).expect("regular");
    let (sin, cos) = pose.phi.sin_cos();
    (0..3)
        .map(|k| {
            let (a, alpha, _, c) = geometry[k];
            let e = Vector2::new(alpha.cos(), alpha.sin());
            let r = Vector2::new(cos * c[0] - sin * c[1], sin * c[0] + cos * c[1]);
            let link = Vector2::new(pose.x, pose.y) + r - Vector2::from(a) - e * velocity.joints[k][0];
            let v = rates.xy() + Vector2::new(-r.y, r.x) * rates.z;
            let beta = (v - e * inputs[k]).norm_squared() - rates.z * rates.z * link.dot(&r);
            (beta - found[k]).abs() / (1.0 + inputs.norm_squared() + link.norm() * rates.norm_squared())
        })
        .fold(0.0, f64::max)
}

pub fn main() {
    print!("{}", document());
}

#[test]
fn every_step_holds() {
    assert!(!document().is_empty());
}
