//! Each stage of the engine: resultant, determinant, companion matrix, lift. Quality is printed beside the times.

use std::hint::black_box;

use assur::algebra::{Gaussian, Integer, Monomial, Poly, Ring, UPoly};
use assur::eliminate::{
    Power, SylvesterMatrix, determinant_bareiss, determinant_interpolated, resultant, resultant_bareiss,
    resultant_interpolated,
};
use assur::num_complex::Complex64;
use assur::roots::companion_roots;
use assur::{Plan, System, eliminate, lift};
use criterion::{Criterion, criterion_group, criterion_main};

type P = Poly<Integer>;

/// Dense polynomial in x, y, z of the given total degree, seeded.
fn dense(degree: u32, seed: i64) -> P {
    let mut sum = P::zero();
    for i in 0..=degree {
        for j in 0..=degree - i {
            for k in 0..=degree - i - j {
                let c = (seed * 7 + i64::from(i * 31 + j * 17 + k * 5)) % 23 - 11;
                sum = sum + P::term(Integer::from(c), Monomial::new(&[i, j, k]));
            }
        }
    }
    sum
}

fn three_quadrics() -> (System<Integer>, Plan<Integer>) {
    let [s1, s2, s3] = [0, 1, 2].map(P::variable);
    let quadric = |x: &P, y: &P, [a, b, c, d, e, f]: [i64; 6]| {
        let n = P::from_int;
        n(a) * x.power(2)
            + n(b) * x.clone() * y.clone()
            + n(c) * y.power(2)
            + n(d) * x.clone()
            + n(e) * y.clone()
            + n(f)
    };
    let system = System::new(["s1", "s2", "s3"])
        .with("Q12", quadric(&s1, &s2, [1, 1, 2, -3, 1, -6]))
        .with("Q23", quadric(&s2, &s3, [2, -1, 1, 1, -2, -5]))
        .with("Q31", quadric(&s3, &s1, [1, -2, 1, -1, 3, -8]));
    (system, Plan::new("s2").resultant("F23", ("Q12", "Q31"), "s1").resultant("octic", ("F23", "Q23"), "s3"))
}

/// A circle `theta (z w - l²)` and two rows linear in z and w, with 100-bit Gaussian coefficients: six roots.
fn circle_and_two_rows() -> (System<Gaussian<Integer>>, Plan<Gaussian<Integer>>) {
    let mut state = 12345u64;
    let mut random = || {
        let mut part = || {
            (0..2).fold(Integer::ZERO, |sum, _| {
                state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
                (sum << 50) + Integer::from(state >> 14) - (Integer::ONE << 49)
            })
        };
        Poly::constant(Gaussian::new(part(), part()))
    };
    let [z, w, t] = [0, 1, 2].map(Poly::<Gaussian<Integer>>::variable);
    let mut row = || {
        let linear = |a: Poly<Gaussian<Integer>>, b| a + b * t.clone();
        let on_z = linear(random(), random());
        let on_w = linear(random(), random()) * t.clone();
        on_z * z.clone() * t.clone() + on_w * w.clone() + random() + random() * t.clone() + random() * t.power(2)
    };
    let (first, second) = (row(), row());
    let circle = t.clone() * (random() * z * w - random());
    let system = System::new(["z", "w", "theta"]).with("circle", circle).with("L2", first).with("L3", second);
    let plan = Plan::new("theta")
        .resultant_formal("R1", ("L2", 1), ("L3", 1), "z")
        .resultant_formal("R2", ("circle", 1), ("L2", 1), "z")
        .resultant_formal("T", ("R1", 1), ("R2", 2), "w")
        .remove_coefficient("T", "L2", ("z", 1), Power::Exactly(1))
        .remove("T", t, Power::AsOftenAsItDivides, "theta");
    (system, plan)
}

fn resultants(c: &mut Criterion) {
    for degree in [1, 2, 3, 4] {
        let (f, g) = (dense(degree, 3), dense(degree, 8));
        assert_eq!(resultant_bareiss(&f, &g, 0), resultant_interpolated(&f, &g, 0));
        println!("resultant of degree {degree}: {} terms", resultant(&f, &g, 0).term_count());
        let size = 2 * degree;
        c.bench_function(&format!("resultant/bareiss/{size}"), |b| b.iter(|| resultant_bareiss(black_box(&f), &g, 0)));
        c.bench_function(&format!("resultant/interpolated/{size}"), |b| {
            b.iter(|| resultant_interpolated(black_box(&f), &g, 0));
        });
    }
}

fn determinants(c: &mut Criterion) {
    for degree in [2, 3, 4] {
        let random = |seed: i64| {
            let coefficient =
                |k: i64| UPoly::new((0..=degree - k).map(|j| Integer::from((seed + 3 * k + 7 * j) % 11 - 5)).collect());
            (0..=degree).map(coefficient).collect::<Vec<_>>()
        };
        let (f, g) = (random(2), random(6));
        let rows = SylvesterMatrix::new(("f", &f), ("g", &g), "v").into_rows();
        let size = rows.len();
        println!("determinant of size {size}: degree {:?}", determinant_interpolated(&rows).degree());
        c.bench_function(&format!("determinant/bareiss/{size}"), |b| {
            b.iter(|| determinant_bareiss(black_box(rows.clone())))
        });
        c.bench_function(&format!("determinant/interpolated/{size}"), |b| {
            b.iter(|| determinant_interpolated(black_box(&rows)))
        });
    }
}

fn companions(c: &mut Criterion) {
    for degree in [6, 8, 18] {
        let coefficients: Vec<Complex64> = (0..=degree).map(|k| Complex64::cis(f64::from(k * k))).collect();
        let roots = companion_roots(&coefficients).expect("a polynomial with coefficients of modulus one has roots");
        let residual = |z: &Complex64| coefficients.iter().rev().fold(Complex64::ZERO, |sum, a| sum * z + a).norm();
        let worst = roots.finite.iter().map(residual).fold(0.0, f64::max);
        println!("companion of degree {degree}: {} roots, worst residual {worst:.1e}", roots.finite.len());
        c.bench_function(&format!("companion/{degree}"), |b| b.iter(|| companion_roots(black_box(&coefficients))));
    }
}

fn lifts(c: &mut Criterion) {
    let (system, plan) = three_quadrics();
    let eliminant = eliminate(&system, &plan).expect("the plan fits");
    let found = lift(&system, &plan, &eliminant).expect("the octic has roots");
    println!("three quadrics: {} solutions, worst residual {:.1e}", found.solutions.len(), found.worst_residual());
    c.bench_function("eliminate/three quadrics", |b| b.iter(|| eliminate(black_box(&system), &plan)));
    c.bench_function("lift/three quadrics", |b| b.iter(|| lift(black_box(&system), &plan, &eliminant)));

    let (system, plan) = circle_and_two_rows();
    let eliminant = eliminate(&system, &plan).expect("the plan fits");
    let found = lift(&system, &plan, &eliminant).expect("the eliminant has roots");
    println!(
        "circle and two rows: degree {:?}, {:?}, worst residual {:.1e}",
        eliminant.polynomial.degree(),
        found.account,
        found.worst_residual()
    );
    c.bench_function("eliminate/circle and two rows", |b| b.iter(|| eliminate(black_box(&system), &plan)));
    c.bench_function("lift/circle and two rows", |b| b.iter(|| lift(black_box(&system), &plan, &eliminant)));
}

criterion_group!(benches, resultants, determinants, companions, lifts);
criterion_main!(benches);
