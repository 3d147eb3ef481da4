//! The stages of the main job, one by one, on the 3-RPR with six modes and on random triads with as long numbers.

use std::hint::black_box;

use assur::algebra::{Gaussian, Integer, Rational, Trig, UPoly, dyadic};
use assur::linkage::{LegNumbers, consistency};
use assur::roots::{FIRST_BITS, isolate_real_roots, locate_on_circle};
use criterion::{Criterion, criterion_group, criterion_main};

/// The legs of the 3-RPR with six modes, base pivot, platform pivot and length, in units of 2⁻⁵²; the first is the shortest.
fn six_modes() -> [LegNumbers<Integer>; 3] {
    let (sin, cos) = 0.8822f64.sin_cos();
    let whole = |x: f64| {
        let scaled = dyadic(x).expect("finite") * Rational::from(Integer::ONE << 52);
        assert!(scaled.is_int(), "{x} has more than 52 binary places");
        scaled.numerator().clone()
    };
    let point = |x: f64, y: f64| Gaussian::new(whole(x), whole(y));
    let legs = [
        (point(0.0, 10.0), point(20.839 * cos, 20.839 * sin), whole(12.0)),
        (point(0.0, 0.0), point(0.0, 0.0), whole(14.98)),
        (point(15.91, 0.0), point(17.045, 0.0), whole(15.38)),
    ];
    let (a0, b0) = (legs[0].0.clone(), legs[0].1.clone());
    legs.map(|(a, b, length)| LegNumbers::Circle { alpha: a - a0.clone(), beta: b - b0.clone(), length })
}

fn expanded(legs: &[LegNumbers<Integer>; 3]) -> Trig<Integer> {
    let symbols = legs.each_ref().map(|leg| leg.map(|x| Trig::constant(x.clone())));
    consistency(&symbols, &Trig::cosine(), &Trig::sine())
}

fn stages(c: &mut Criterion) {
    let legs = six_modes();
    let mut group = c.benchmark_group("3-RPR");
    group.bench_function("expand T exactly", |b| b.iter(|| expanded(black_box(&legs))));
    let floats = legs.each_ref().map(|leg| leg.map(|x| x.to_f64().value() * 2f64.powi(-52)));
    group.bench_function("evaluate T in f64", |b| b.iter(|| consistency(black_box(&floats), &0.6, &0.8)));
    let t = expanded(&legs);
    let in_chart: UPoly<Integer> = t.half_angle(3);
    let in_theta = t.theta(3);
    group.bench_function("half-angle polynomial", |b| b.iter(|| black_box(&t).half_angle(3)));
    group.bench_function("theta polynomial", |b| b.iter(|| black_box(&t).theta(3)));
    let parts = in_chart.square_free();
    assert_eq!(parts.len(), 1);
    group.bench_function("square-free parts", |b| b.iter(|| black_box(&in_chart).square_free()));
    let primitive = &parts[0].0;
    eprintln!("{} real roots counted", isolate_real_roots(primitive).len());
    group.bench_function("count real roots", |b| b.iter(|| isolate_real_roots(black_box(primitive))));
    for bits in [64, FIRST_BITS, 320] {
        let roots = locate_on_circle(&in_theta, primitive, bits).expect("six simple roots");
        let on_circle = roots.iter().filter(|root| root.on_circle);
        let off = on_circle.clone().map(|root| (root.root.to_complex().norm() - 1.0).abs()).fold(0.0, f64::max);
        eprintln!("{bits} bits: {} modes found, off the circle by {off:.1e} at most", on_circle.count());
        group.bench_function(format!("count and locate to {bits} bits"), |b| {
            b.iter(|| locate_on_circle(black_box(&in_theta), primitive, bits));
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(30).measurement_time(std::time::Duration::from_secs(2));
    targets = stages
}
criterion_main!(benches);
