//! Intersections of coupler curves: all of them, real and complex. Completeness and worst residual are printed beside the times.

use std::hint::black_box;

use assur::linkage::{CouplerCurve, Partner};
use assur::nalgebra::Vector2;
use criterion::{Criterion, criterion_group, criterion_main};

/// Random four-bars, the same each time.
fn curves(count: usize) -> Vec<CouplerCurve> {
    let mut state = 18u64;
    let mut next = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        3.0 * ((state >> 11) as f64 / (1u64 << 52) as f64 - 1.0)
    };
    let mut curve = || {
        let mut point = || [next(), next()];
        let (pivots, arms) = ([point(), point()], [point(), point()]);
        let radii = [1.0 + next().abs(), 1.0 + next().abs()];
        CouplerCurve::four_bar(pivots, arms, radii).expect("sound numbers")
    };
    (0..count).map(|_| curve()).collect()
}

fn coupler(criterion: &mut Criterion) {
    let curves = curves(60);
    let partners = |k: usize| {
        let other = curves[(k + 1) % 60];
        let center = Vector2::new(0.5 + k as f64 / 60.0, -0.25);
        [
            ("coupler-coupler, 18", Partner::Coupler(other)),
            ("circle, 6", Partner::Circle { center, radius: 1.5 }),
            ("line, 6", Partner::Line { point: center, direction: Vector2::new(0.7, 0.3) }),
        ]
    };
    for kind in 0..3 {
        let name = partners(0)[kind].0;
        let found: Vec<_> = (0..60).filter_map(|k| curves[k].meet(&partners(k)[kind].1)).collect();
        let complete = found.iter().filter(|f| f.account.adds_up() && f.account.undecided == 0).count();
        let worst = found.iter().flat_map(|f| &f.list).map(|i| i.residual).fold(0.0, f64::max);
        println!("{name}: {complete} of 60 complete, worst residual {worst:.1e}");
        assert_eq!(complete, 60);
        let mut place = 0;
        let mut one = move || {
            place = (place + 1) % 60;
            place
        };
        criterion.bench_function(name, |b| {
            b.iter(|| {
                let k = one();
                black_box(&curves[k]).meet(black_box(&partners(k)[kind].1))
            });
        });
    }
    criterion.bench_function("double points", |b| b.iter(|| black_box(&curves[7]).double_points()));
    criterion.bench_function("circuits", |b| b.iter(|| black_box(&curves[7]).circuits()));
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).measurement_time(std::time::Duration::from_secs(2));
    targets = coupler
}
criterion_main!(benches);
