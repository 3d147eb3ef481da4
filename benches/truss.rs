//! Assur groups beyond the triad: all assemblies, real and complex. Completeness and worst residual are printed beside the times.

use std::hint::black_box;

use assur::linkage::{Truss, TrussJoint, baranov_trusses};
use assur::nalgebra::Vector2;
use criterion::{Criterion, criterion_group, criterion_main};

/// Random members of a catalogued truss, the same each time.
fn members(links: usize, number: usize, count: usize) -> Vec<Truss> {
    let mut state = 11u64;
    let mut next = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        5.0 * ((state >> 11) as f64 / (1u64 << 52) as f64 - 1.0)
    };
    let truss = baranov_trusses().find(|truss| (truss.links, truss.number) == (links, number)).expect("catalogued");
    let mut member = || {
        let joints: Vec<TrussJoint> =
            truss.edges().into_iter().map(|edge| TrussJoint::drawn(edge, Vector2::new(next(), next()))).collect();
        Truss::new(links, &joints, 0).expect("an Assur group")
    };
    (0..count).map(|_| member()).collect()
}

fn truss(criterion: &mut Criterion) {
    for (links, number) in [(5, 0), (7, 0), (7, 1), (7, 2), (9, 26), (9, 22)] {
        let members = members(links, number, 30);
        let found: Vec<_> = members.iter().map(Truss::assemble).collect();
        let complete = found.iter().filter(|found| found.missing == Some(0)).count();
        let pencils: usize = found.iter().map(|found| found.pencils).sum();
        let worst = found.iter().flat_map(|f| &f.assemblies).map(|a| a.residual).fold(0.0, f64::max);
        println!("{links}#{number}: {complete} of 30 complete with {pencils} pencils, worst residual {worst:.1e}");
        assert_eq!(complete, 30);
        let mut place = 0;
        let mut one = move || {
            place = (place + 1) % 30;
            place
        };
        criterion.bench_function(&format!("truss {links}#{number}"), |b| {
            b.iter(|| black_box(&members[one()]).assemble());
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).measurement_time(std::time::Duration::from_secs(2));
    targets = truss
}
criterion_main!(benches);
