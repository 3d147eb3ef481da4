//! Inverse kinematics of every leg type undoes forward kinematics, and the other way round.

use assur::nalgebra::{Isometry2, Vector2};
use assur::{JointKind, Leg, Manipulator, Placement, Pose};
use proptest::prelude::*;

/// The 21 leg types: seven chains, each with one of three joints actuated.
fn leg_types() -> Vec<String> {
    let mut out = Vec::new();
    for chain in ["RRR", "RPR", "PRR", "RRP", "PPR", "PRP", "RPP"] {
        for actuated in 0..3 {
            let letters = chain.chars().enumerate();
            out.push(letters.map(|(k, c)| if k == actuated { format!("_{c}_") } else { c.to_string() }).collect());
        }
    }
    out
}

fn motion(p: &Placement) -> Isometry2<f64> {
    Isometry2::new(p.at, p.direction.y.atan2(p.direction.x))
}

/// A leg of a type with these numbers, its platform end put where its joints lead in a pose.
fn planted_leg(kind: &str, pose: &Pose, numbers: &[f64]) -> (Leg, [f64; 3]) {
    let mut leg: Leg = kind.parse().expect("a leg type");
    leg.base = Placement::turned(4.0 * numbers[0], 4.0 * numbers[1], 3.0 * numbers[2]);
    leg.links = [
        Placement::turned(1.5 + numbers[3], 0.5 * numbers[4], 1.0 + numbers[5]),
        Placement::turned(1.5 + numbers[6], 0.5 * numbers[7], 1.0 + numbers[8]),
    ];
    let joints = [9, 10, 11].map(|k: usize| numbers[k] * 3.0);
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

fn apart(leg: &Leg, p: &[f64; 3], q: &[f64; 3]) -> f64 {
    let distance = |k: usize| match leg.joints[k] {
        JointKind::Prismatic => (p[k] - q[k]).abs(),
        JointKind::Revolute => ((p[k] - q[k]) / 2.0).sin().abs() * 2.0,
    };
    (0..3).map(distance).fold(0.0, f64::max)
}

fn pose_apart(p: &Pose, q: &Pose) -> f64 {
    (p.x - q.x).hypot(p.y - q.y).max(((p.phi - q.phi) / 2.0).sin().abs())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn forward_and_inverse_undo_each_other(
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

        // The planted joints are among the working modes of the pose.
        let back = robot.inverse(&pose).unwrap();
        prop_assert!(back.unreachable.is_empty(), "{:?}", back.unreachable);
        let expected: usize = robot.legs.iter().map(|leg| if leg.name().matches('P').count() < 2 { 2 } else { 1 }).product();
        prop_assert!(back.modes.len() == expected || !back.special.is_empty());
        let near = |modes: &[[f64; 3]], tolerance: f64| {
            robot.legs.iter().zip(modes).zip(&joints).all(|((leg, p), q)| apart(leg, p, q) < tolerance)
        };
        let velocity = robot.velocity_at(&pose, &joints).singularity(1.0);
        prop_assume!(velocity.sigma_min > 1e-4 && velocity.sigma_min_input > 1e-4);
        let mode = back.modes.iter().find(|mode| near(&mode.joints, 1e-9));
        prop_assert!(mode.is_some(), "{joints:?} not in {:?}", back.modes);

        // And the pose is among the assembly modes of its inputs, with the same joints and the same name.
        let answer = robot.forward(&robot.inputs_of(&joints)).unwrap();
        let found = answer.modes.iter().find(|m| pose_apart(&m.mode.pose, &pose) < 1e-8 && near(&m.joints, 1e-7));
        prop_assert!(found.is_some(), "{pose:?} not in {:?}", answer.modes);
        prop_assert_eq!(&found.unwrap().signs, &mode.unwrap().signs);

        // Every assembly mode leads back to the inputs.
        for m in &answer.modes {
            let ways = robot.inverse(&m.mode.pose).unwrap();
            let same = |way: &assur::WorkingMode| {
                let inputs = robot.inputs_of(&way.joints);
                robot.actuated_joints().zip(inputs.iter().zip(&answer.inputs)).all(|((leg, joint), (a, b))| {
                    match robot.legs[leg].joints[joint] {
                        JointKind::Prismatic => (a - b).abs() < 1e-6 * (1.0 + m.mode.pose.x.hypot(m.mode.pose.y)),
                        JointKind::Revolute => ((a - b) / 2.0).sin().abs() < 1e-6,
                    }
                })
            };
            prop_assert!(ways.modes.iter().any(same), "{:?} does not lead back", m);
        }
    }
}

#[test]
fn the_signs_mean_what_the_table_says() {
    let pose = Pose::new(0.4, 0.7, 0.2);
    for (leg, joint) in [
        (Leg::rpr([-3.0, 0.0], [0.0, 0.0]), 1),
        (Leg::prr([-3.0, 0.0], 0.3, 4.0, [0.0, 0.0]), 0),
        (Leg::rrp([-3.0, 0.0], 4.0, [0.0, 0.0], 0.5), 2),
    ] {
        let robot = Manipulator::new("", vec![leg; 3]).unwrap();
        let modes = robot.inverse(&pose).unwrap().modes;
        assert_eq!((modes[0].signs.as_str(), modes[7].signs.as_str()), ("+++", "---"));
        assert!(modes[0].joints[0][joint] > modes[7].joints[0][joint], "{}", robot.family());
    }
    let robot = Manipulator::new("", vec![Leg::rrr([-3.0, 0.0], 2.5, 2.0, [0.0, 0.0]); 3]).unwrap();
    let modes = robot.inverse(&pose).unwrap().modes;
    assert!(modes[0].joints[0][1].sin() > 0.0 && modes[7].joints[0][1].sin() < 0.0);
}

#[test]
fn a_far_origin_and_any_unit_give_the_same_modes() {
    let (robot, _) = Manipulator::of_family("R_P_R,_P_RR,_R_RR").unwrap();
    let pose = Pose::new(5.5, 4.0, 0.3);
    let modes = robot.inverse(&pose).unwrap().modes;
    for factor in [1e-6, 1e6] {
        let scaled = |p: &Placement| Placement { at: p.at * factor, direction: p.direction };
        let mut other = robot.clone();
        for leg in &mut other.legs {
            *leg = Leg {
                base: scaled(&leg.base),
                links: leg.links.each_ref().map(scaled),
                platform: scaled(&leg.platform),
                ..leg.clone()
            };
        }
        let found = other.inverse(&Pose::new(5.5 * factor, 4.0 * factor, 0.3)).unwrap().modes;
        assert_eq!(found.len(), modes.len());
        for (p, q) in found.iter().zip(&modes) {
            assert_eq!(p.signs, q.signs);
            let scale = |v: Vector2<f64>| v.norm();
            assert!(
                scale(Vector2::new(p.joints[0][1] / factor - q.joints[0][1], p.joints[2][0] - q.joints[2][0])) < 1e-9
            );
        }
    }
}
