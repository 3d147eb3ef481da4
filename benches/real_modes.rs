//! All real modes, fast: one triad at a time, and in batches. Counts and worst residuals are printed beside the times.

use std::hint::black_box;

use assur::nalgebra::Vector2;
use assur::{Dyad, Manipulator, ModesRoute, Offset, Triad};
use criterion::{Criterion, criterion_group, criterion_main};

/// The ten triads without PP.
const NAMES: [&str; 10] = [
    "RR-RR-RR", "RR-RR-PR", "RR-RR-RP", "RR-PR-RP", "RR-PR-PR", "RR-RP-RP", "PR-PR-RP", "PR-RP-RP", "PR-PR-PR",
    "RP-RP-RP",
];

/// Random triads with at least one assembly mode, the same each time.
fn triads(name: &str, count: usize) -> Vec<Triad> {
    let mut state = 4u64;
    let mut next = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let mut planted = || {
        let (x, y, turn) = (5.0 * next(), 5.0 * next(), std::f64::consts::PI * next());
        let turned =
            |p: Vector2<f64>| Vector2::new(turn.cos() * p.x - turn.sin() * p.y, turn.sin() * p.x + turn.cos() * p.y);
        let mut leg = |name: &str| {
            let mut point = || Vector2::new(5.0 * next(), 5.0 * next());
            let (a, b, w) = (point(), point(), point());
            let joint = Vector2::new(x, y) + turned(b);
            match name {
                "RR" => Dyad::RR { a, b, length: (joint - a).norm() },
                "PR" => Dyad::PR { a: joint + w, u: w, b },
                _ => {
                    let normal = turned(Vector2::new(-w.y, w.x));
                    Dyad::RP { a, b, v: w, offset: Offset::TimesDirection(normal.dot(&(a - joint))) }
                }
            }
        };
        let mut parts = name.split('-');
        Triad::new(std::array::from_fn(|_| leg(parts.next().expect("three dyads")))).expect("finite numbers")
    };
    (0..count).map(|_| planted()).collect()
}

fn real_modes(criterion: &mut Criterion) {
    for name in NAMES {
        let triads = triads(name, 10_000);
        let found: Vec<_> = triads.iter().map(Triad::real_modes).collect();
        let modes: usize = found.iter().map(|f| f.modes().len()).sum();
        let fast = found.iter().filter(|f| f.route == ModesRoute::Fast).count();
        let worst = found.iter().flat_map(|f| f.modes()).map(|m| m.residual).fold(0.0, f64::max);
        println!("{name}: {modes} modes of 10,000 triads, {fast} decided fast, worst residual {worst:.1e}");
        let mut at = 0;
        criterion.bench_function(&format!("real modes {name}"), |b| {
            b.iter(|| {
                at = (at + 1) % 10_000;
                black_box(&triads[at]).real_modes()
            })
        });
    }
}

/// Ten thousand at once on one thread, and rows of inputs; times are for all of them.
fn batch(criterion: &mut Criterion) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
    let triads = triads("RR-RR-RR", 10_000);
    let batch = Triad::real_modes_batch(&triads);
    let alone: usize = triads.iter().map(|triad| triad.real_modes().modes().len()).sum();
    let modes: usize = batch.counts().iter().map(|&count| usize::from(count)).sum();
    println!("batch of 10,000 RR-RR-RR: {modes} modes, {alone} one by one");
    criterion.bench_function("batch of 10,000 RR-RR-RR, one thread", |b| {
        b.iter(|| pool.install(|| Triad::real_modes_batch(black_box(&triads))))
    });
    let (robot, inputs) = Manipulator::of_family("3-RPR").expect("a family");
    let rows: Vec<f64> =
        (0..30_000).map(|i| inputs[i % 3] * (0.9 + 0.2 * ((i * 7919 % 9973) as f64 / 9973.0))).collect();
    let found = robot.forward_batch(&rows);
    println!("batch of 10,000 rows, 3-RPR: {} modes", found.counts().iter().map(|&c| usize::from(c)).sum::<usize>());
    criterion.bench_function("batch of 10,000 rows, 3-RPR, one thread", |b| {
        b.iter(|| pool.install(|| robot.forward_batch(black_box(&rows))))
    });
}

criterion_group!(benches, real_modes, batch);
criterion_main!(benches);
