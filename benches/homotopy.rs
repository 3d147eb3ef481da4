//! Numeric homotopy on triads without PP: time a solve, solutions found of those that exist, and the choice of predictor.

use std::hint::black_box;
use std::time::Instant;

use criterion::{Criterion, criterion_group, criterion_main};

#[path = "homotopy/mod.rs"]
mod homotopy;
#[path = "../tests/properties/planted.rs"]
#[allow(dead_code, reason = "shared with the tests")]
mod planted;

use homotopy::{Family, Outcome, Predictor, Problem, Settings, solve_by_total_degree};
use planted::{Random, TRIADS, planted_triad};

const SEED: u64 = 20_030_526;

/// Triads of each kind.
const TRIADS_EACH: usize = 1000;

fn triads(names: [&str; 3]) -> Vec<Problem> {
    let mut random = Random::new(SEED);
    (0..TRIADS_EACH).map(|_| Problem::of(&planted_triad(names, &mut random).0)).collect()
}

/// Median time, solutions found and how many paths were lost, in one line.
fn report(name: &str, problems: &[Problem], degree: usize, solve: impl Fn(&Problem) -> Outcome) {
    let timed = |problem| {
        let start = Instant::now();
        let out = solve(problem);
        (start.elapsed().as_secs_f64() * 1e6, out)
    };
    let runs: Vec<(f64, Outcome)> = problems.iter().map(timed).collect();
    let mut times: Vec<f64> = runs.iter().map(|(time, _)| *time).collect();
    times.sort_by(f64::total_cmp);
    let total = |count: fn(&Outcome) -> usize| runs.iter().map(|(_, out)| count(out)).sum::<usize>();
    let worst = runs.iter().flat_map(|(_, out)| &out.solutions).map(|s| s.residual).fold(0.0, f64::max);
    println!(
        "{name}: median {:.1} us; {} of {} solutions; of {} paths {} to infinity, {} failed, {} jumped, {} repeated; {:.1} steps a path; worst residual {worst:.0e}",
        times[times.len() / 2],
        total(|out| out.solutions.len()),
        degree * problems.len(),
        total(|out| out.paths),
        total(|out| out.at_infinity),
        total(|out| out.failed),
        total(|out| out.jumped),
        total(|out| out.repeated),
        total(|out| out.steps) as f64 / total(|out| out.paths) as f64,
    );
}

fn kinds(criterion: &mut Criterion) {
    let settings = Settings::default();
    for names in &TRIADS[..10] {
        let problems = triads(*names);
        let family = Family::new(*names, SEED);
        let name = names.join("-");
        report(&format!("parameter homotopy {name}"), &problems, family.degree(), |p| family.solve(p, &settings));
        report(&format!("total degree {name}"), &problems[..100], family.degree(), |p| {
            solve_by_total_degree(p, SEED, &settings)
        });
        let mut next = problems.iter().cycle();
        criterion.bench_function(&format!("parameter homotopy/{name}"), |b| {
            b.iter(|| black_box(family.solve(next.next().expect("a cycle never ends"), &settings)));
        });
    }
}

/// What was tried for the predictor and the step; the defaults stand on this.
fn choices(_: &mut Criterion) {
    let names = TRIADS[0];
    let problems = triads(names);
    let family = Family::new(names, SEED);
    for predictor in [Predictor::Euler, Predictor::RungeKutta, Predictor::Series, Predictor::Pade] {
        for (trust, aim) in [(1e-3, 1e-4), (1e-2, 1e-3), (1e-1, 2e-2), (3e-1, 5e-2)] {
            let settings = Settings { predictor, trust, aim, ..Settings::default() };
            let name = format!("{predictor:?}, trust {trust:.0e}, aim {aim:.0e}");
            report(&name, &problems, family.degree(), |p| family.solve(p, &settings));
        }
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).measurement_time(std::time::Duration::from_secs(1));
    targets = choices, kinds
}
criterion_main!(benches);
