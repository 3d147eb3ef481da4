//! Our side of `benches/peers/loops.py`: coupler curves and trusses of a file, one line of JSON a problem.
//!
//! `cargo run --release --example peers_loops -- target/peers/loops.json`

use std::hint::black_box;
use std::time::Instant;

use assur::linkage::{CouplerCurve, Partner, Truss, TrussJoint};
use serde_json::{Value, json};

/// Runs of each problem; the shortest counts, the others were interrupted.
const RUNS: usize = 9;

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn point(value: &Value) -> [f64; 2] {
    [number(&value[0]), number(&value[1])]
}

fn four_bar(value: &Value) -> CouplerCurve {
    let points = |a: &str, b: &str| [point(&value[a]), point(&value[b])];
    let radii = [number(&value["r"]), number(&value["s"])];
    CouplerCurve::four_bar(points("a", "b"), points("p", "q"), radii).expect("sound numbers")
}

fn truss(value: &Value) -> Truss {
    let links = |edge: &Value| [0, 1].map(|k| edge[k].as_u64().expect("a link") as usize);
    let list = |key: &str| value[key].as_array().expect("a list").iter();
    let joints: Vec<TrussJoint> = list("edges")
        .zip(list("joint_xy"))
        .map(|(edge, at)| TrussJoint::drawn(links(edge), point(at).into()))
        .collect();
    Truss::new(value["links"].as_u64().expect("a number") as usize, &joints, 0).expect("an Assur group")
}

/// The shortest time of a solve, and how many solutions it found.
fn measure(solve: impl Fn() -> usize) -> (f64, usize) {
    let run = || {
        let start = Instant::now();
        let count = black_box(solve());
        (start.elapsed().as_secs_f64(), count)
    };
    (0..RUNS).map(|_| run()).min_by(|a, b| a.0.total_cmp(&b.0)).expect("at least one run")
}

fn main() {
    let path = std::env::args().nth(1).expect("a file of problems");
    let file: Value = serde_json::from_str(&std::fs::read_to_string(path).expect("is readable")).expect("JSON");
    for pair in file["couplers"].as_array().expect("a list") {
        let [one, other] = [0, 1].map(|k| four_bar(&pair[k]));
        let (seconds, count) = measure(|| one.meet(&Partner::Coupler(other)).map_or(0, |found| found.list.len()));
        let equations = [one, other].map(|curve| curve.scaled_coefficients().map(|row| row.map(|c| [c.re, c.im])));
        println!("{}", json!({"kind": "coupler", "seconds": seconds, "count": count, "equations": equations}));
    }
    for group in file["trusses"].as_array().expect("a list") {
        let truss = truss(group);
        let (seconds, count) = measure(|| truss.assemble().count());
        println!("{}", json!({"kind": group["kind"], "seconds": seconds, "count": count}));
    }
}
