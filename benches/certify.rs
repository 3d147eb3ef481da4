//! Proof of the count with a box around each mode: by the filter, by integers, and with everything `certify` says. Proved counts are printed beside.

use std::hint::black_box;

use assur::nalgebra::Vector2;
use assur::{Dyad, ProofRoute, Triad};
use criterion::{Criterion, criterion_group, criterion_main};

/// Random RR-RR-RR triads with at least one assembly mode, the same each time.
fn triads(count: usize) -> Vec<Triad> {
    let mut state = 4u64;
    let mut next = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let mut planted = || {
        let (x, y, turn) = (5.0 * next(), 5.0 * next(), std::f64::consts::PI * next());
        let mut leg = || {
            let (a, b) = (Vector2::new(5.0 * next(), 5.0 * next()), Vector2::new(5.0 * next(), 5.0 * next()));
            let joint = Vector2::new(x + turn.cos() * b.x - turn.sin() * b.y, y + turn.sin() * b.x + turn.cos() * b.y);
            Dyad::RR { a, b, length: (joint - a).norm() }
        };
        Triad::new([leg(), leg(), leg()]).expect("finite numbers")
    };
    (0..count).map(|_| planted()).collect()
}

fn certify(criterion: &mut Criterion) {
    let triads = triads(1000);
    let proved: Vec<_> = triads.iter().map(Triad::prove).collect();
    let filtered = proved.iter().filter(|p| p.route == ProofRoute::Filter).count();
    let modes: usize = proved.iter().map(|p| p.modes.len()).sum();
    let exact: usize = triads.iter().map(|t| t.prove_exactly().modes.len()).sum();
    println!("1000 random RR-RR-RR: {modes} modes proved, {filtered} triads by the filter; by integers {exact} modes");
    assert_eq!(modes, exact);
    let mut next = 0;
    let mut one = move || {
        next = (next + 1) % 1000;
        next
    };
    criterion.bench_function("prove RR-RR-RR, filter", |b| b.iter(|| black_box(&triads[one()]).prove_filtered()));
    criterion.bench_function("prove RR-RR-RR, exact", |b| b.iter(|| black_box(&triads[one()]).prove_exactly()));
    criterion.bench_function("certify RR-RR-RR", |b| b.iter(|| black_box(&triads[one()]).certify()));
    // Medians over instances: each timed alone, the best of five.
    for (name, prove) in [
        ("filter", (|t: &Triad| t.prove_filtered().map_or(0, |p| p.modes.len())) as fn(&Triad) -> usize),
        ("exact", |t: &Triad| t.prove_exactly().modes.len()),
    ] {
        let mut times: Vec<f64> = triads
            .iter()
            .map(|triad| {
                let timed = |_| {
                    let start = std::time::Instant::now();
                    black_box(prove(black_box(triad)));
                    start.elapsed().as_secs_f64() * 1e6
                };
                (0..5).map(timed).fold(f64::INFINITY, f64::min)
            })
            .collect();
        times.sort_by(f64::total_cmp);
        println!("prove RR-RR-RR, {name}: median over instances {:.2} us, 90 % below {:.2} us", times[500], times[900]);
    }
}

criterion_group!(benches, certify);
criterion_main!(benches);
