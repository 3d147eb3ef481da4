//! Joint values planted in every kind of leg come back from the forward kinematics.
//!
//! Placements are composed here with nalgebra's rigid motions, apart from the library's own.

use assur::nalgebra::{Isometry2, Vector2};
use assur::{JointKind, Leg, LockedGroup, Manipulator, Placement, Pose, Status};
use proptest::prelude::*;

use super::cases;
use super::planted::turn;

/// The chains of three joints that can turn the platform.
const CHAINS: [&str; 7] = ["RRR", "RRP", "RPR", "PRR", "RPP", "PRP", "PPR"];

/// The text of a leg with these joints actuated: `R_P_R`.
fn text(chain: &str, actuated: &[usize]) -> String {
    let mark = |(k, letter): (usize, char)| {
        if actuated.contains(&k) { format!("_{letter}_") } else { letter.to_string() }
    };
    chain.chars().enumerate().map(mark).collect()
}

fn motion(p: &Placement) -> Isometry2<f64> {
    Isometry2::new(p.at, p.direction.y.atan2(p.direction.x))
}

fn joint(kind: JointKind, q: f64) -> Isometry2<f64> {
    match kind {
        JointKind::Revolute => Isometry2::rotation(q),
        JointKind::Prismatic => Isometry2::translation(q, 0.0),
    }
}

fn chain(leg: &Leg, q: &[f64; 3]) -> Isometry2<f64> {
    let [j1, j2, j3] = [0, 1, 2].map(|k: usize| joint(leg.joints[k], q[k]));
    motion(&leg.base) * j1 * motion(&leg.links[0]) * j2 * motion(&leg.links[1]) * j3
}

/// Numbers of a leg: three placements before the last, and the joint values.
type Numbers = ([[f64; 3]; 3], [f64; 3]);

fn numbers() -> impl Strategy<Value = Numbers> {
    let placement = || (-6.0..6.0, -6.0..6.0, -3.1..3.1).prop_map(|(x, y, angle)| [x, y, angle]);
    (prop::array::uniform3(placement()), prop::array::uniform3(-3.1..3.1))
}

fn pose() -> impl Strategy<Value = Pose> {
    (-8.0..8.0, -8.0..8.0, -3.1..3.1).prop_map(|(x, y, phi)| Pose::new(x, y, phi))
}

/// A leg whose platform frame is where its planted joints put it.
fn planted(text: &str, pose: &Pose, (placements, q): &Numbers) -> Leg {
    let [base, first, second] = placements.map(|[x, y, angle]| Placement::turned(x, y, angle));
    let leg = Leg { base, links: [first, second], ..text.parse().expect("a leg's name") };
    let platform = pose.isometry().inverse() * chain(&leg, q);
    let at = platform.translation.vector;
    Leg { platform: Placement::turned(at.x, at.y, platform.rotation.angle()), ..leg }
}

/// The working-mode sign of planted joints, from the slope of a squared distance: the larger of two values lies where it rises.
fn sign(leg: &Leg, q: &[f64; 3]) -> char {
    use JointKind::{Prismatic as P, Revolute as R};
    let end = |m: Isometry2<f64>| m.translation.vector;
    let slope = |f: &dyn Fn(f64) -> Vector2<f64>| (f(1e-4).norm_squared() - f(-1e-4).norm_squared()) / 2e-4;
    let [base, first, second] = [&leg.base, &leg.links[0], &leg.links[1]].map(motion);
    let measure = match leg.joints {
        [R, R, R] => {
            let elbow = first * joint(R, q[1]);
            first.translation.vector.perp(&(elbow.rotation * second.translation.vector))
        }
        [R, P, R] => slope(&|h| end(first * joint(P, q[1] + h) * second)),
        [P, R, R] => {
            let pivot = end(base * joint(P, q[0]) * first * joint(R, q[1]) * second);
            slope(&|h| pivot - end(base * joint(P, q[0] + h) * first))
        }
        [R, R, P] => {
            let before = base * joint(R, q[0]) * first * joint(R, q[1]) * second;
            slope(&|h| end(base) - end(before * joint(P, -h) * second.inverse()))
        }
        _ => 1.0,
    };
    if measure < 0.0 { '-' } else { '+' }
}

/// The planted pose is among the modes, with its joints and signs; every mode closes every leg.
fn comes_back(legs: Vec<Leg>, pose: &Pose, planted: &[[f64; 3]]) -> Result<(), TestCaseError> {
    let robot = Manipulator::new("planted", legs).expect("a sound description");
    let inputs: Vec<f64> = robot.actuated_joints().map(|(leg, joint)| planted[leg][joint]).collect();
    let answer = robot.forward(&inputs).expect("a group that three actuators determine");
    prop_assert!(answer.group.account.adds_up());
    prop_assert_eq!(answer.group.status, Status::Complete);
    prop_assert_eq!(&answer.inputs, &inputs);
    let mut best = f64::INFINITY;
    for mode in &answer.modes {
        let mut off = turn(mode.mode.pose.phi, pose.phi);
        off = off.max((mode.mode.pose.x - pose.x).hypot(mode.mode.pose.y - pose.y));
        for ((leg, found), expected) in robot.legs.iter().zip(&mode.joints).zip(planted) {
            let closes = mode.mode.pose.isometry() * motion(&leg.platform);
            let error = (chain(leg, found).inverse() * closes).translation.vector.norm();
            let size = 1.0 + mode.mode.pose.x.hypot(mode.mode.pose.y);
            prop_assert!(error < 1e-11 * size, "{} {found:?} misses its platform by {error:e}", leg.name());
            for k in 0..3 {
                off = off.max(match leg.joints[k] {
                    JointKind::Revolute => turn(found[k], expected[k]),
                    JointKind::Prismatic => (found[k] - expected[k]).abs(),
                });
                prop_assert!(leg.joints[k] == JointKind::Prismatic || found[k].abs() <= std::f64::consts::PI);
            }
        }
        let signs: String = robot.legs.iter().zip(&mode.joints).map(|(leg, q)| sign(leg, q)).collect();
        prop_assert_eq!(&mode.signs, &signs);
        best = best.min(off);
    }
    let singular = answer.modes.iter().map(|m| m.mode.det_a.abs()).fold(f64::INFINITY, f64::min);
    let twisted = robot.legs.iter().any(|leg| {
        let parallel = |k: usize| leg.joints[k] == JointKind::Prismatic && leg.joints[k + 1] == JointKind::Prismatic;
        (0..2).any(|k| parallel(k) && leg.links[k].direction.normalize().y.abs() < 1e-3)
    });
    prop_assert!(
        best < 1e-9 || ((singular < 1e-5 || twisted) && best < 1e-4),
        "{} missed by {best:e} (det A {singular:e}): {answer:?}",
        robot.family()
    );
    Ok(())
}

fn leaves_pp(text: &str) -> bool {
    text.parse::<Leg>().expect("a leg's name").passive_joints() == "PP"
}

#[test]
fn planted_joints_come_back_from_each_of_the_twenty_one_leg_types() {
    for chain in CHAINS {
        for actuated in 0..3 {
            let name = text(chain, &[actuated]);
            let mut runner = proptest::test_runner::TestRunner::new(cases(200));
            let strategy = (pose(), prop::array::uniform3(numbers()));
            let outcome = runner.run(&strategy, |(pose, numbers)| {
                // Two legs that leave PP hold nothing: one of them, then, and two usual ones.
                let others = if leaves_pp(&name) { ["R_P_R", "_P_RR"] } else { [&*name; 2] };
                let names = [&name, others[0], others[1]];
                let legs = (0..3).map(|i| planted(names[i], &pose, &numbers[i])).collect();
                comes_back(legs, &pose, &numbers.map(|n| n.1))
            });
            if let Err(failure) = outcome {
                panic!("{name}: {failure}");
            }
        }
    }
}

#[test]
fn planted_joints_come_back_from_mixed_legs() {
    let mut runner = proptest::test_runner::TestRunner::new(cases(1000));
    let types = || (0..7usize, 0..3usize).prop_map(|(chain, actuated)| text(CHAINS[chain], &[actuated]));
    let strategy = (pose(), prop::array::uniform3((types(), numbers())));
    let outcome = runner.run(&strategy, |(pose, described)| {
        let legs: Vec<Leg> = described.iter().map(|(name, numbers)| planted(name, &pose, numbers)).collect();
        if described.iter().filter(|(name, _)| leaves_pp(name)).count() < 2 {
            return comes_back(legs, &pose, &described.map(|d| d.1.1));
        }
        let robot = Manipulator::new("", legs).expect("a sound description");
        let refused = robot.forward(&[0.1, 0.2, 0.3]).expect_err("the orientation is fixed twice").to_string();
        prop_assert!(refused.contains("are both left with PP"), "{refused}");
        Ok(())
    });
    if let Err(failure) = outcome {
        panic!("{failure}");
    }
}

#[test]
fn other_distributions_of_actuators_are_solved() {
    // Two actuators on one leg and one on another, with and without a free leg; three on one.
    let mut described: Vec<Vec<String>> = Vec::new();
    for (n, two) in CHAINS.iter().enumerate() {
        for pair in [[0, 1], [0, 2], [1, 2]] {
            let left = text(two, &pair);
            let one = text(CHAINS[(2 * n + pair[1]) % 7], &[(n + pair[0]) % 3]);
            let slides = left.parse::<Leg>().expect("a leg's name").passive_joints() == "P";
            if slides && leaves_pp(&one) {
                continue;
            }
            described.push(vec![left.clone(), one.clone()]);
            described.push(vec![one, CHAINS[(n + 3) % 7].to_owned(), left]);
        }
        described.push(vec![text(two, &[0, 1, 2]), CHAINS[(n + 1) % 7].to_owned()]);
        described.push(vec!["RRR".to_owned(), text(two, &[0, 1, 2]), CHAINS[(n + 2) % 7].to_owned()]);
    }
    for names in described {
        let mut runner = proptest::test_runner::TestRunner::new(cases(20));
        let strategy = (pose(), prop::array::uniform3(numbers()));
        let outcome = runner.run(&strategy, |(pose, numbers)| {
            let legs = names.iter().zip(&numbers).map(|(name, n)| planted(name, &pose, n)).collect();
            let joints: Vec<[f64; 3]> = numbers[..names.len()].iter().map(|n| n.1).collect();
            comes_back(legs, &pose, &joints)
        });
        if let Err(failure) = outcome {
            panic!("{names:?}: {failure}");
        }
    }
}

#[test]
fn what_is_left_is_the_triad_of_the_passive_joints() {
    let at = Pose::new(1.0, 2.0, 0.3);
    let numbers = ([[1.0, 2.0, 0.4], [0.5, 1.5, 1.1], [2.0, -0.5, -0.7]], [0.3, 1.2, -0.8]);
    for chain in CHAINS {
        for actuated in 0..3 {
            let name = text(chain, &[actuated]);
            let passive: String = chain.chars().enumerate().filter(|&(k, _)| k != actuated).map(|c| c.1).collect();
            let legs = ["R_P_R", &name, "R_P_R"].map(|name| planted(name, &at, &numbers)).to_vec();
            let robot = Manipulator::new("", legs).expect("a sound description");
            let inputs = [1.2, numbers.1[actuated], 1.2];
            let LockedGroup::Triad(triad) = robot.lock(&inputs).expect("can be locked") else { panic!("a triad") };
            assert_eq!(triad.name(), format!("RR-{passive}-RR"), "{name}");
        }
    }
}
