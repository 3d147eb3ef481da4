//! det A is one number: forward kinematics, paths and velocity matrices agree on it.

use assur::nalgebra::Isometry2;
use assur::{JointKind, Leg, LockedGroup, Manipulator, PathSettings, Placement, Pose};
use proptest::prelude::*;

/// The 21 leg types.
fn leg_types() -> Vec<String> {
    let chains = ["RRR", "RPR", "PRR", "RRP", "PPR", "PRP", "RPP"];
    let marked = |chain: &str, actuated: usize| -> String {
        let mark = |(k, c)| if k == actuated { format!("_{c}_") } else { String::from(c) };
        chain.chars().enumerate().map(mark).collect()
    };
    chains.iter().flat_map(|chain| (0..3).map(|joint| marked(chain, joint))).collect()
}

fn motion(p: &Placement) -> Isometry2<f64> {
    Isometry2::new(p.at, p.direction.y.atan2(p.direction.x))
}

/// A leg of a type with these numbers that closes in a pose.
fn planted_leg(kind: &str, pose: &Pose, n: &[f64]) -> (Leg, [f64; 3]) {
    let mut leg: Leg = kind.parse().unwrap();
    leg.base = Placement::turned(4.0 * n[0], 4.0 * n[1], 3.0 * n[2]);
    leg.links =
        [Placement::turned(1.5 + n[3], 0.5 * n[4], 1.0 + n[5]), Placement::turned(1.5 + n[6], 0.5 * n[7], 1.0 + n[8])];
    let joints = [9, 10, 11].map(|k: usize| n[k] * 3.0);
    let mut frame = motion(&leg.base);
    for (k, &q) in joints.iter().enumerate() {
        frame *= match leg.joints[k] {
            JointKind::Revolute => Isometry2::rotation(q),
            JointKind::Prismatic => Isometry2::translation(q, 0.0),
        };
        if let Some(link) = leg.links.get(k) {
            frame *= motion(link);
        }
    }
    let end = pose.isometry().inverse() * frame;
    leg.platform = Placement::turned(end.translation.x, end.translation.y, end.rotation.angle());
    (leg, joints)
}

/// The factor between a row of the velocity matrix and the unit wrench of the leg, as the documentation of det A states it.
fn sigma(leg: &Leg, joints: &[f64; 3]) -> f64 {
    let mut frame = motion(&leg.base);
    let mut idle = Vec::new();
    for (k, &q) in joints.iter().enumerate() {
        if !leg.actuated[k] {
            idle.push((leg.joints[k], frame));
        }
        frame *= match leg.joints[k] {
            JointKind::Revolute => Isometry2::rotation(q),
            JointKind::Prismatic => Isometry2::translation(q, 0.0),
        };
        if let Some(link) = leg.links.get(k) {
            frame *= motion(link);
        }
    }
    let [(first, p), (second, q)] = idle[..] else { panic!("two idle joints") };
    match (first, second) {
        (JointKind::Revolute, JointKind::Revolute) => (q.translation.vector - p.translation.vector).norm(),
        (JointKind::Prismatic, JointKind::Revolute) => -1.0,
        (JointKind::Revolute, JointKind::Prismatic) => 1.0,
        (JointKind::Prismatic, JointKind::Prismatic) => (q.rotation.angle() - p.rotation.angle()).sin(),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn forward_path_and_velocity_agree_on_det_a(
        types in prop::array::uniform3(0usize..21),
        alike in any::<bool>(),
        at in prop::array::uniform3(-1.0f64..1.0),
        numbers in prop::collection::vec(-1.0f64..1.0, 36),
    ) {
        let names = leg_types();
        let types = if alike { [types[0]; 3] } else { types };
        let pose = Pose::new(3.0 * at[0], 3.0 * at[1], 3.0 * at[2]);
        let planted: Vec<(Leg, [f64; 3])> =
            (0..3).map(|k| planted_leg(&names[types[k]], &pose, &numbers[12 * k..12 * k + 12])).collect();
        let joints: Vec<[f64; 3]> = planted.iter().map(|leg| leg.1).collect();
        let robot = Manipulator::new("", planted.into_iter().map(|leg| leg.0).collect()).unwrap();
        prop_assume!(robot.legs.iter().filter(|leg| leg.passive_joints() == "PP").count() < 2);
        let inputs = robot.inputs_of(&joints);
        let answer = robot.forward(&inputs).unwrap();
        for mode in &answer.modes {
            let (pose, det_a) = (mode.mode.pose, mode.mode.det_a);
            let velocity = robot.velocity_at(&pose, &mode.joints);
            prop_assume!(velocity.singularity(1.0).sigma_min > 1e-5);
            // One row of a path.
            let path = robot.follow(std::slice::from_ref(&inputs), Some(pose), &PathSettings::default()).unwrap();
            prop_assert!(path.complete, "{:?}", path.events);
            let far = 1.0 + pose.x.hypot(pose.y);
            prop_assert!((path.rows[0].det_a - det_a).abs() < 1e-11 * far, "{} {}", path.rows[0].det_a, det_a);
            // The matrix of the velocities.
            let sigmas = robot.legs.iter().zip(&mode.joints).map(|(leg, values)| sigma(leg, values));
            let size = if robot.legs.iter().any(|leg| leg.passive_joints() == "PP") { 1.0 } else { answer.group.size };
            let factor = sigmas.product::<f64>() * size;
            let determinant = velocity.pose_matrix.determinant();
            let rows: f64 = velocity.pose_matrix.row_iter().map(|row| row.norm()).product();
            let error = (determinant - factor * det_a).abs();
            prop_assert!(error < 1e-9 * (1.0 + rows) * far, "{}: {} {}", robot.family(), determinant, factor * det_a);
        }
    }
}

#[test]
fn the_order_of_legs_sets_the_sign_and_neither_unit_nor_reference_matter() {
    let (robot, inputs) = Manipulator::of_family("R_P_R,_P_RR,RP_P_").unwrap();
    let det = |robot: &Manipulator, inputs: &[f64]| -> Vec<f64> {
        robot.forward(inputs).unwrap().modes.iter().map(|mode| mode.mode.det_a).collect()
    };
    let before = det(&robot, &inputs);
    assert!(!before.is_empty());
    let mut swapped = robot.clone();
    swapped.legs.swap(0, 1);
    let after = det(&swapped, &[inputs[1], inputs[0], inputs[2]]);
    assert!(before.iter().zip(&after).all(|(p, q)| (p + q).abs() < 1e-12), "{before:?} {after:?}");
    let mut large = robot.clone();
    for leg in &mut large.legs {
        leg.base.at *= 1e3;
        leg.platform.at *= 1e3;
        leg.links.iter_mut().for_each(|link| link.at *= 1e3);
    }
    let scaled: Vec<f64> = robot
        .actuated_joints()
        .zip(inputs)
        .map(|((leg, joint), q)| if robot.legs[leg].joints[joint] == JointKind::Prismatic { 1e3 * q } else { q })
        .collect();
    let after = det(&large, &scaled);
    assert!(before.iter().zip(&after).all(|(p, q)| (p - q).abs() < 1e-12), "{before:?} {after:?}");
}

#[test]
fn two_legged_manipulators_report_one_det_a_too() {
    let (base, _) = Manipulator::of_family("3-RRR").unwrap();
    let mut first = base.legs[0].clone();
    first.actuated = [true, true, false];
    let robot = Manipulator::new("", vec![first, base.legs[1].clone()]).unwrap();
    let inputs = [0.9, -0.7, 2.2];
    let answer = robot.forward(&inputs).unwrap();
    assert!(matches!(answer.locked, LockedGroup::Pinned(_)) && !answer.modes.is_empty());
    for mode in &answer.modes {
        assert!((answer.locked.det_a(&mode.mode.pose) - mode.mode.det_a).abs() < 1e-13);
    }
}
