//! All real modes, fast: one triad at a time, and in batches. Counts and worst residuals are printed beside the times.

use std::f64::consts::FRAC_PI_4;
use std::hint::black_box;

use assur::algebra::Gaussian;
use assur::linkage::{LegNumbers, consistency};
use assur::nalgebra::Vector2;
use assur::roots::{Harmonics, companion_roots};
use assur::{Dyad, Manipulator, ModesRoute, Offset, Triad};
use criterion::{Criterion, criterion_group, criterion_main};
use num_complex::Complex64;

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

/// Ways to find the real roots of T on the circle, on the same polynomials: why the fast route takes Bernstein forms. Only those prove their count.
fn roots(criterion: &mut Criterion) {
    let harmonics: Vec<([f64; 8], Vec<Complex64>)> = triads("RR-RR-RR", 1000)
        .iter()
        .map(|triad| {
            let legs = triad.legs().map(|leg| match leg {
                Dyad::RR { a, b, length } => (a, b, length),
                _ => unreachable!("three RR legs"),
            });
            let ((a0, b0, _), point) = (legs[0], |p: Vector2<f64>| Gaussian::new(p.x / 10.0, p.y / 10.0));
            let legs = legs.map(|(a, b, length)| LegNumbers::Circle {
                alpha: point(a - a0),
                beta: point(b - b0),
                length: length / 10.0,
            });
            let value = |k: usize| {
                let (s, c) = (k as f64 * FRAC_PI_4).sin_cos();
                consistency(&legs, &c, &s)
            };
            let values: [f64; 8] = std::array::from_fn(value);
            // The coefficients of theta^0 … theta^6, by Fourier's formula.
            let coefficient = |k: i32| -> Complex64 {
                (0..8).map(|j| values[j as usize] * Complex64::from_polar(0.125, -f64::from(k * j) * FRAC_PI_4)).sum()
            };
            (values, (-3..=3).map(coefficient).collect())
        })
        .collect();
    let ways: [(&str, Way); 3] = [
        ("Bernstein forms", |values, _| {
            Harmonics::from_samples(values, 3, 1e-14).real_roots().map_or(0, |roots| roots.count())
        }),
        ("Aberth's iteration", |_, coefficients| on_circle(&aberth(coefficients))),
        ("companion matrix", |_, coefficients| {
            companion_roots(coefficients).map_or(0, |roots| on_circle(&roots.finite))
        }),
    ];
    for (name, way) in ways {
        let found: usize = harmonics.iter().map(|(values, coefficients)| way(values, coefficients)).sum();
        println!("{name}: {found} real roots of 1000 polynomials");
        let mut at = 0;
        criterion.bench_function(&format!("roots of T, {name}"), |b| {
            b.iter(|| {
                at = (at + 1) % 1000;
                way(black_box(&harmonics[at].0), black_box(&harmonics[at].1))
            })
        });
    }
}

/// Counts the real roots of a polynomial given by eight values and by its coefficients.
type Way = fn(&[f64; 8], &[Complex64]) -> usize;

fn on_circle(roots: &[Complex64]) -> usize {
    roots.iter().filter(|theta| (theta.norm() - 1.0).abs() < 1e-7).count()
}

/// All roots at once (Aberth 1973), from points about the unit circle.
fn aberth(coefficients: &[Complex64]) -> [Complex64; 6] {
    let mut roots: [Complex64; 6] =
        std::array::from_fn(|k| Complex64::from_polar(0.9 + 0.05 * k as f64, k as f64 + 0.4));
    for _ in 0..60 {
        let mut largest = 0.0f64;
        for k in 0..6 {
            let (mut value, mut slope) = (Complex64::ZERO, Complex64::ZERO);
            for c in coefficients.iter().rev() {
                slope = slope * roots[k] + value;
                value = value * roots[k] + c;
            }
            let newton = value / slope;
            let push: Complex64 = (0..6).filter(|&j| j != k).map(|j| (roots[k] - roots[j]).inv()).sum();
            let step = newton / (Complex64::ONE - newton * push);
            roots[k] -= step;
            largest = largest.max(step.norm_sqr());
        }
        if largest < 1e-20 {
            break;
        }
    }
    roots
}

criterion_group!(benches, real_modes, roots, batch);
criterion_main!(benches);
