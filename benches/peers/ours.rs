//! Our side of `benches/peers/run.py`: every route on the triads of a file, one line of JSON a route.
//!
//! `cargo run --release --example peers_ours -- target/peers/problems.json`; the first line is the reference route, whose solutions are
//! complete and stand as the truth for all others.

use std::hint::black_box;
use std::time::Instant;

use assur::nalgebra::Vector2;
use assur::{Dyad, ProofRoute, Triad};
use num_complex::Complex64;
use serde_json::{Value, json};

#[path = "../homotopy/mod.rs"]
#[allow(dead_code, unused_imports, reason = "shared with the benches")]
mod homotopy;

use homotopy::{Family, Problem, Settings, solve_by_total_degree};

/// Runs of each triad; the shortest counts, the others were interrupted.
const RUNS: usize = 3;

/// A run repeats the solve until it has taken this long, in seconds, so that the clock's own time does not count.
const LEAST: f64 = 20e-6;

/// `theta`, `z`, `w`.
type Found = [Complex64; 3];

fn triads(file: &Value) -> Vec<Triad> {
    let number = |value: &Value| value.as_f64().expect("a number");
    let point = |value: &Value| Vector2::new(number(&value[0]), number(&value[1]));
    let leg = |leg: &Value| Dyad::RR { a: point(&leg["a"]), b: point(&leg["b"]), length: number(&leg["l"]) };
    let triad = |legs: &Value| Triad::new([leg(&legs[0]), leg(&legs[1]), leg(&legs[2])]).expect("finite numbers");
    file["triads"].as_array().expect("a list of triads").iter().map(triad).collect()
}

/// What a route is called, whether it lists the real solutions only, what it proves, how it goes.
struct Route<'a> {
    system: &'a str,
    real_only: bool,
    certified: &'a str,
    note: &'a str,
}

/// Times `solve` on every triad, reads its answers off by `solutions`, and prints one line.
fn measure<T>(route: &Route, triads: &[Triad], solve: impl Fn(&Triad) -> T, solutions: impl Fn(&T) -> Vec<Found>) {
    let timed = |triad: &Triad| {
        let mut repeats = 1;
        loop {
            let start = Instant::now();
            for _ in 0..repeats {
                black_box(solve(black_box(triad)));
            }
            let elapsed = start.elapsed().as_secs_f64();
            if elapsed > LEAST {
                return elapsed / f64::from(repeats);
            }
            repeats *= 2;
        }
    };
    let seconds: Vec<f64> =
        triads.iter().map(|triad| (0..RUNS).map(|_| timed(triad)).fold(f64::INFINITY, f64::min)).collect();
    let flat = |found: Found| found.iter().flat_map(|c| [c.re, c.im]).collect::<Vec<f64>>();
    let found: Vec<Vec<Vec<f64>>> =
        triads.iter().map(|triad| solutions(&solve(triad)).into_iter().map(flat).collect()).collect();
    let line = json!({
        "system": route.system, "real_only": route.real_only, "certified": route.certified, "note": route.note,
        "seconds": seconds, "solutions": found,
    });
    println!("{line}");
}

/// A real pose as a solution.
fn pose(x: f64, y: f64, phi: f64) -> Found {
    [Complex64::from_polar(1.0, phi), Complex64::new(x, y), Complex64::new(x, -y)]
}

fn main() {
    let path = std::env::args().nth(1).expect("usage: peers_ours PROBLEMS.json");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let triads = triads(&serde_json::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}")));

    let reference = Route {
        system: "assur, reference",
        real_only: false,
        certified: "count and multiplicities",
        note: "`Triad::assemble`: exact eliminant, 160 bits",
    };
    measure(&reference, &triads, Triad::assemble, |answer| {
        let real = answer.modes.iter().map(|m| pose(m.pose.x, m.pose.y, m.pose.phi));
        real.chain(answer.complex.iter().map(|m| [m.theta, m.z, m.w])).collect()
    });

    let fast = Route {
        system: "assur, fast",
        real_only: true,
        certified: "count proved",
        note: "`Triad::real_modes`; one thread, one triad at a time",
    };
    measure(&fast, &triads, Triad::real_modes, |answer| {
        answer.modes().iter().map(|m| pose(m.pose.x, m.pose.y, m.pose.phi)).collect()
    });

    let filtered = triads.iter().filter(|t| t.prove().route == ProofRoute::Filter).count();
    let proved = Route {
        system: "assur, proved",
        real_only: true,
        certified: "every real mode boxed, none missing",
        note: &format!("`Triad::prove`; {filtered} of {} by the floating-point filter, else integers", triads.len()),
    };
    measure(&proved, &triads, Triad::prove, |answer| {
        let middle = |[low, high]: [f64; 2]| 0.5 * (low + high);
        answer.modes.iter().map(|m| m.pose_box.map(middle)).map(|[x, y, phi]| pose(x, y, phi)).collect()
    });

    let settings = Settings::default();
    let family = Family::new(["RR", "RR", "RR"], 1);
    let parameter = Route {
        system: "our parameter homotopy",
        real_only: false,
        certified: "no",
        note: "`benches/homotopy`: 6 paths from a generic member, Padé predictor, compiled",
    };
    let list = |out: &homotopy::Outcome| out.solutions.iter().map(|s| [s.theta, s.z, s.w]).collect();
    measure(&parameter, &triads, |triad| family.solve(&Problem::of(triad), &settings), list);

    let total = Route {
        system: "our total-degree homotopy",
        real_only: false,
        certified: "no",
        note: "`benches/homotopy`: 16 paths from roots of unity, 10 of them to infinity",
    };
    measure(&total, &triads, |triad| solve_by_total_degree(&Problem::of(triad), 1, &settings), list);
}
