//! The velocity row of every leg: the cross product of its idle joints' screws.

use assur::algebra::{Poly, Rational, Ring};
use assur::manipulator::{joint_screw, power, reciprocal_wrench};
use assur::nalgebra::{Isometry2, Vector2, Vector3};
use assur::{JointKind, Leg, Manipulator, Placement, Pose};

use JointKind::{Prismatic, Revolute};

type Symbol = Poly<Rational>;

/// The text, with every step checked.
pub fn document() -> String {
    let mut text = String::from(
        "The velocity row of a leg\n\
         =========================\n\
         Claim. In  A pose' + B inputs' = 0  the row of a leg with idle joints i < j and actuated joint a is\n\
         w = s_i x s_j  and the entry of B is  -w.s_a,  for all 21 leg types.\n\n\
         Symbols. s_k: screw of joint k, the twist (velocity of the mark m, rate of turning) that it gives the platform\n\
         at unit rate: (E(m - p), 1) for a revolute joint at p, (u, 0) for a slider along u. E turns by a quarter.\n\
         Source: reciprocal screws, Ball 1900; Mohamed and Duffy 1985.\n\n",
    );
    let symbol = Symbol::variable;
    let (p, q, m) = ([symbol(0), symbol(1)], [symbol(2), symbol(3)], [symbol(4), symbol(5)]);
    let (u, v) = ([symbol(6), symbol(7)], [symbol(8), symbol(9)]);

    text += "1. pose' = sum of s_k q_k' over the joints of a leg. With w = s_i x s_j the idle rates drop out:\n";
    for (first, second) in [(Revolute, Revolute), (Prismatic, Revolute), (Revolute, Prismatic), (Prismatic, Prismatic)]
    {
        let screws = [joint_screw(first, &p, &u, &m), joint_screw(second, &q, &v, &m)];
        let w = reciprocal_wrench(&screws[0], &screws[1]);
        assert!(screws.iter().all(|screw| power(&w, screw) == Symbol::zero()));
        text +=
            &format!("   {}{}: w.s_i = 0 and w.s_j = 0, identically in all symbols\n", first.letter(), second.letter());
    }

    text += "2. so  w.pose' = (w.s_a) q_a',  which is the claim. What w is:\n";
    let minus = |a: &[Symbol; 2], b: &[Symbol; 2]| [a[0].clone() - b[0].clone(), a[1].clone() - b[1].clone()];
    let cross = |a: &[Symbol; 2], b: &[Symbol; 2]| a[0].clone() * b[1].clone() - a[1].clone() * b[0].clone();
    let wrench = |force: [Symbol; 2], at: &[Symbol; 2]| {
        let moment = cross(&minus(at, &m), &force);
        let [x, y] = force;
        [x, y, moment]
    };
    let screw = |kind, at, along| joint_screw(kind, at, along, &m);
    let rr = reciprocal_wrench(&screw(Revolute, &p, &u), &screw(Revolute, &q, &u));
    assert_eq!(rr, wrench(minus(&q, &p), &q));
    text += "   RR: the force q - p through q, as long as the idle pivots are apart\n";
    let pr = reciprocal_wrench(&screw(Prismatic, &p, &u), &screw(Revolute, &q, &u));
    assert_eq!(pr, wrench([u[1].clone(), -u[0].clone()], &q));
    text += "   PR: the force -E u through q, of length one with u\n";
    let rp = reciprocal_wrench(&screw(Revolute, &p, &u), &screw(Prismatic, &q, &v));
    assert_eq!(rp, wrench([-v[1].clone(), v[0].clone()], &p));
    text += "   RP: the force E v through p\n";
    let pp = reciprocal_wrench(&screw(Prismatic, &p, &u), &screw(Prismatic, &q, &v));
    assert_eq!(pp, [Symbol::zero(), Symbol::zero(), cross(&u, &v)]);
    text += "   PP: no force, the moment u x v\n";

    text += "3. Manipulator::velocity_at gives these rows. Largest difference, relative, over 20 legs of each type:\n";
    for chain in ["RRR", "RPR", "PRR", "RRP", "PPR", "PRP", "RPP"] {
        for actuated in 0..3 {
            let worst = (1..=20).map(|seed| compare(chain, actuated, f64::from(seed))).fold(0.0, f64::max);
            assert!(worst < 1e-12, "{chain} with joint {actuated} actuated: {worst:e}");
        }
        text += &format!("   {chain}, each joint actuated in turn: below 1e-12\n");
    }
    text
}

/// Largest relative difference between a row of the library and the table of step 2, written out with plain vectors.
fn compare(chain: &str, actuated: usize, seed: f64) -> f64 {
    let number = |k: f64| (seed * 5.1 + k * 3.7).sin();
    let letters = chain.chars().enumerate();
    let text: String = letters.map(|(k, c)| if k == actuated { format!("_{c}_") } else { c.to_string() }).collect();
    let leg = Leg {
        base: Placement::turned(number(1.0), number(2.0), 3.0 * number(3.0)),
        links: [
            Placement::turned(1.5 + number(4.0), number(5.0), 3.0 * number(6.0)),
            Placement::turned(1.5 + number(7.0), number(8.0), 3.0 * number(9.0)),
        ],
        ..text.parse().expect("a leg type")
    };
    let joints = [3.0 * number(10.0), 3.0 * number(11.0), 3.0 * number(12.0)];
    let motion = |p: &Placement| Isometry2::new(p.at, p.direction.y.atan2(p.direction.x));
    let mut frame = motion(&leg.base);
    let mut frames = Vec::new();
    for (k, &q) in joints.iter().enumerate() {
        frames.push(frame);
        frame *= match leg.joints[k] {
            Revolute => Isometry2::rotation(q),
            Prismatic => Isometry2::translation(q, 0.0),
        };
        if let Some(link) = leg.links.get(k) {
            frame *= motion(link);
        }
    }
    // The platform's frame is the end of the leg, so the mark is its origin.
    let pose = Pose::new(frame.translation.x, frame.translation.y, frame.rotation.angle());
    let at = |k: usize| frames[k].translation.vector;
    let along = |k: usize| frames[k].rotation * Vector2::x();
    let mark = Vector2::new(pose.x, pose.y);
    let perp = |a: Vector2<f64>, b: Vector2<f64>| a.x * b.y - a.y * b.x;
    let wrench = |f: Vector2<f64>, through: Vector2<f64>| Vector3::new(f.x, f.y, perp(through - mark, f));
    let idle: Vec<usize> = (0..3).filter(|&k| k != actuated).collect();
    let (i, j) = (idle[0], idle[1]);
    let row = match (leg.joints[i], leg.joints[j]) {
        (Revolute, Revolute) => wrench(at(j) - at(i), at(j)),
        (Prismatic, Revolute) => wrench(Vector2::new(along(i).y, -along(i).x), at(j)),
        (Revolute, Prismatic) => wrench(Vector2::new(-along(j).y, along(j).x), at(i)),
        (Prismatic, Prismatic) => Vector3::new(0.0, 0.0, perp(along(i), along(j))),
    };
    let screw = match leg.joints[actuated] {
        Revolute => {
            let arm = mark - at(actuated);
            Vector3::new(-arm.y, arm.x, 1.0)
        }
        Prismatic => Vector3::new(along(actuated).x, along(actuated).y, 0.0),
    };
    let other = Leg::rpr([9.0, 9.0], [0.0, 0.0]);
    let robot = Manipulator::new("", vec![leg, other.clone(), other]).expect("is sound");
    let velocity = robot.velocity_at(&pose, &[joints, [0.1, 1.0, 0.2], [0.3, 2.0, 0.1]]);
    let size = 1.0 + row.norm() * (1.0 + screw.norm());
    let off_row = (velocity.pose_matrix.row(0).transpose() - row).norm();
    let off_entry = (velocity.input_matrix[(0, 0)] + row.dot(&screw)).abs();
    off_row.max(off_entry) / size
}

pub fn main() {
    print!("{}", document());
}

#[test]
fn every_step_holds() {
    assert!(!document().is_empty());
}
