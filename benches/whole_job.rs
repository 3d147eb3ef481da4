//! The whole job: every assembly mode of a triad of each kind, and the forward kinematics of a 3-RPR with six modes.
//!
//! Before each measurement a line says what the answers are worth; see README.md beside this file.

use std::hint::black_box;

use assur::{Leg, Manipulator, Pose, Triad};
use criterion::{Criterion, criterion_group, criterion_main};

#[path = "../tests/properties/planted.rs"]
mod planted;

use planted::{Random, TRIADS, miss, planted_triad};

const SEED: u64 = 20_030_526;

/// Triads of each kind that are solved in turn.
const TRIADS_EACH: usize = 100;

/// One line on the quality of these answers.
fn report(name: &str, planted: &[(Triad, Pose)]) {
    let answers: Vec<_> = planted.iter().map(|(triad, pose)| (triad.assemble(), pose)).collect();
    let modes: usize = answers.iter().map(|(answer, _)| answer.modes.len()).sum();
    let missed = answers.iter().filter(|(answer, pose)| miss(answer, pose) > 1e-9).count();
    let worst = answers.iter().flat_map(|(answer, _)| &answer.modes).map(|m| m.residual).fold(0.0, f64::max);
    eprintln!(
        "{name}: {} triads, {modes} modes found, {missed} planted poses missed, worst residual {worst:.1e}",
        answers.len()
    );
}

fn triads(c: &mut Criterion) {
    let mut group = c.benchmark_group("assemble");
    // Two PP legs or more leave nothing to time.
    for names in &TRIADS[..16] {
        let mut random = Random::new(SEED);
        let planted: Vec<(Triad, Pose)> = (0..TRIADS_EACH).map(|_| planted_triad(*names, &mut random)).collect();
        let name = names.join("-");
        report(&name, &planted);
        let mut next = planted.iter().cycle();
        group.bench_function(&name, |b| {
            b.iter_batched(
                || &next.next().expect("a cycle never ends").0,
                |triad| black_box(triad.assemble()),
                criterion::BatchSize::SmallInput,
            );
        });
    }
    group.finish();
}

fn six_modes(c: &mut Criterion) {
    let (sin, cos) = 0.8822f64.sin_cos();
    let legs = vec![
        Leg::rpr([0.0, 0.0], [0.0, 0.0]),
        Leg::rpr([15.91, 0.0], [17.045, 0.0]),
        Leg::rpr([0.0, 10.0], [20.839 * cos, 20.839 * sin]),
    ];
    let robot = Manipulator::new("3-RPR with six modes", legs).expect("a sound description");
    let inputs = [14.98, 15.38, 12.0];
    let answer = robot.forward(&inputs).expect("inputs without limits");
    let worst = answer.modes.iter().map(|m| m.mode.residual).fold(0.0, f64::max);
    eprintln!("3-RPR: {} modes found, worst residual {worst:.1e}", answer.modes.len());
    c.bench_function("forward/3-RPR", |b| b.iter(|| robot.forward(black_box(&inputs))));
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).measurement_time(std::time::Duration::from_secs(2));
    targets = six_modes, triads
}
criterion_main!(benches);
