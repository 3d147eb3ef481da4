//! Inverse kinematics, velocity matrices, a step along a path, a singular curve; on the manipulators that `assur new` offers.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

use assur::nalgebra::Vector3;
use assur::{Manipulator, PathSettings};

fn kinematics(criterion: &mut Criterion) {
    for family in ["3-RPR", "3-RRR", "3-PRR"] {
        let (robot, inputs) = Manipulator::of_family(family).expect("a family");
        let mode = robot.forward(&inputs).expect("sound inputs").modes[0].clone();
        let pose = mode.mode.pose;
        let ways = robot.inverse(&pose).expect("a pose").modes;
        let off = |way: &assur::WorkingMode| -> f64 {
            robot.inputs_of(&way.joints).iter().zip(&inputs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        let nearest = ways.iter().map(off).fold(f64::INFINITY, f64::min);
        eprintln!("{family}: {} working modes, the inputs found again to {nearest:.0e}", ways.len());
        criterion.bench_function(&format!("inverse/{family}"), |b| b.iter(|| robot.inverse(black_box(&pose))));

        let velocity = robot.velocity_at(&pose, &mode.joints);
        let rates = Vector3::new(1.0, 2.0, 3.0);
        let there = velocity.input_rates(&rates).expect("regular");
        let back = velocity.pose_rates(&there).expect("regular");
        eprintln!("{family}: rates there and back to {:.0e}", (back - rates).norm());
        criterion.bench_function(&format!("velocity/{family}"), |b| {
            b.iter(|| robot.velocity_at(black_box(&pose), &mode.joints).input_rates(&rates));
        });

        // A hundred steps around a small circle of inputs, two comparisons with the complete solver included.
        let path: Vec<Vec<f64>> = (0..=100)
            .map(|k| {
                let angle = f64::from(k) * std::f64::consts::TAU / 100.0;
                vec![inputs[0] + 0.01 * angle.sin(), inputs[1] + 0.01 * angle.cos() - 0.01, inputs[2]]
            })
            .collect();
        let answer = robot.follow(&path, Some(pose), &PathSettings::default()).expect("starts");
        assert!(answer.complete && answer.events.is_empty(), "the benchmark follows its path to the end");
        let closure = |row: &assur::PathRow| {
            let ways = robot.inverse(&row.pose).expect("a pose").modes;
            let off = |way: &assur::WorkingMode| -> f64 {
                robot.inputs_of(&way.joints).iter().zip(&row.inputs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
            };
            ways.iter().map(off).fold(f64::INFINITY, f64::min)
        };
        let worst = answer.rows.iter().map(closure).fold(0.0, f64::max);
        let kept = answer.rows.iter().filter(|row| row.det_a * answer.rows[0].det_a > 0.0).count();
        eprintln!("{family}: {kept} of 101 rows in their mode, inputs found again to {worst:.0e}");
        criterion.bench_function(&format!("path of 100 steps/{family}"), |b| {
            b.iter(|| robot.follow(black_box(&path), Some(pose), &PathSettings::default()));
        });
    }
    for (family, degree) in [("3-RPR", 2), ("3-PRR", 20)] {
        let (robot, _) = Manipulator::of_family(family).expect("a family");
        let locus = robot.singularity_locus(0.3).expect("one actuator a leg");
        assert_eq!(locus.degree(), degree);
        eprintln!("{family}: a singular curve of degree {degree}");
        criterion.bench_function(&format!("singular curve/{family}"), |b| {
            b.iter(|| robot.singularity_locus(black_box(0.3)));
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = kinematics
}
criterion_main!(benches);
