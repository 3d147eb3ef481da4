//! Inverse kinematics, velocity matrices, a step along a path; on the manipulators that `assur new` offers.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

use assur::nalgebra::Vector3;
use assur::{Manipulator, PathSettings};

fn kinematics(criterion: &mut Criterion) {
    for family in ["3-RPR", "3-RRR", "3-PRR"] {
        let (robot, inputs) = Manipulator::of_family(family).expect("a family");
        let mode = robot.forward(&inputs).expect("sound inputs").modes[0].clone();
        let pose = mode.mode.pose;
        criterion.bench_function(&format!("inverse/{family}"), |b| b.iter(|| robot.inverse(black_box(&pose))));
        criterion.bench_function(&format!("velocity/{family}"), |b| {
            b.iter(|| {
                let velocity = robot.velocity_at(black_box(&pose), &mode.joints);
                velocity.input_rates(&Vector3::new(1.0, 2.0, 3.0))
            });
        });
        // A hundred steps around a small circle of inputs, two comparisons with the complete solver included.
        let path: Vec<Vec<f64>> = (0..=100)
            .map(|k| {
                let angle = f64::from(k) * std::f64::consts::TAU / 100.0;
                vec![inputs[0] + 0.01 * angle.sin(), inputs[1] + 0.01 * angle.cos() - 0.01, inputs[2]]
            })
            .collect();
        let answer = robot.follow(&path, Some(pose), &PathSettings::default()).expect("starts");
        assert!(answer.complete, "the benchmark follows its path to the end");
        criterion.bench_function(&format!("path of 100 steps/{family}"), |b| {
            b.iter(|| robot.follow(black_box(&path), Some(pose), &PathSettings::default()));
        });
    }
}

criterion_group!(benches, kinematics);
criterion_main!(benches);
