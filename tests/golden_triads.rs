//! Every triad of the reference set: solutions to 30 digits, counts, multiplicities and degenerate cases.
//!
//! `tests/golden/triads.json` holds, per triad, all finite solutions found by exact Groebner bases and refined to 30 digits.

use assur::num_complex::Complex64;
use assur::{Assemblies, Dyad, Offset, Status, Triad, nalgebra::Vector2};
use serde_json::Value;

/// Relative error allowed for simple solutions, whatever their condition.
const SIMPLE: f64 = 1e-9;
/// The same for double and triple ones.
const DOUBLE: f64 = 1e-7;
const TRIPLE: f64 = 1e-4;
/// Largest residual allowed, in units of the triad's size.
const RESIDUAL: f64 = 1e-13;

fn number(v: &Value) -> f64 {
    v.as_f64().unwrap_or_else(|| v.as_str().expect("a number or its digits").parse().expect("digits"))
}

fn vector(v: &Value) -> Vector2<f64> {
    Vector2::new(number(&v[0]), number(&v[1]))
}

fn complex(v: &Value) -> Complex64 {
    Complex64::new(number(&v[0]), number(&v[1]))
}

fn dyad(leg: &Value) -> Dyad {
    match leg["type"].as_str().expect("type") {
        "RR" => Dyad::RR { a: vector(&leg["a"]), b: vector(&leg["b"]), length: number(&leg["l"]) },
        "PR" => Dyad::PR { a: vector(&leg["a"]), u: vector(&leg["u"]), b: vector(&leg["b"]) },
        "RP" => Dyad::RP {
            a: vector(&leg["a"]),
            b: vector(&leg["b"]),
            v: vector(&leg["v"]),
            offset: Offset::Distance(number(&leg["d"])),
        },
        "PP" => Dyad::PP { phi: number(&leg["phi"]) },
        other => panic!("unknown dyad {other}"),
    }
}

fn triad(instance: &Value) -> Triad {
    let legs = instance["legs"].as_array().expect("legs");
    Triad::new([0, 1, 2].map(|i: usize| dyad(&legs[i]))).expect("a valid triad")
}

fn instances() -> Vec<Value> {
    let text = include_str!("golden/triads.json");
    let all: Value = serde_json::from_str(text).expect("json");
    all["instances"].as_array().expect("instances").clone()
}

/// Angle between two orientations.
fn turn(a: f64, b: f64) -> f64 {
    let d = a - b;
    d.sin().atan2(d.cos()).abs()
}

/// The size of a solution: of the triad, or of its pose where that is far away.
fn scale(answer: &Assemblies, x: f64, y: f64) -> f64 {
    answer.size.max(x.hypot(y))
}

fn check(instance: &Value) -> Result<f64, String> {
    let answer = triad(instance).assemble();
    let fail = |what: String| Err(format!("triad {} ({}): {what}", instance["id"], instance["family"]));
    let solutions = instance["solutions"].as_array().expect("solutions");
    let (real, complex_ones): (Vec<&Value>, Vec<&Value>) =
        solutions.iter().partition(|s| s["real"].as_bool().expect("real"));
    let multiplicity = |s: &Value| s["mult"].as_u64().expect("mult") as usize;
    let status = match instance["status"].as_str().expect("status") {
        "ok" | "no_solution" => Status::Complete,
        _ => Status::SelfMotion,
    };
    if answer.status != status {
        return fail(format!("status {:?}, expected {status:?}", answer.status));
    }
    if answer.modes.len() != real.len() {
        return fail(format!("{} modes, expected {}: {answer:?}", answer.modes.len(), real.len()));
    }
    let count = |all: &[&Value]| all.iter().map(|s| multiplicity(s)).sum::<usize>();
    let account = answer.account;
    if (account.real, account.complex) != (count(&real), count(&complex_ones)) || !account.adds_up() {
        return fail(format!("account {account:?}, expected {} real, {} complex", count(&real), count(&complex_ones)));
    }
    if account.rejected != instance["dropped_roots_of_T"].as_u64().expect("dropped") as usize {
        return fail(format!("{} rejected", account.rejected));
    }
    let mut worst = 0.0f64;
    for solution in &real {
        let (x, y, phi) = (number(&solution["x"]), number(&solution["y"]), number(&solution["phi"]));
        let size = scale(&answer, x, y);
        let m = multiplicity(solution);
        let error = answer
            .modes
            .iter()
            .filter(|mode| mode.multiplicity == m)
            .map(|mode| turn(mode.pose.phi, phi).max((mode.pose.x - x).hypot(mode.pose.y - y) / size))
            .fold(f64::INFINITY, f64::min);
        let allowed = [SIMPLE, DOUBLE, TRIPLE][m - 1];
        if error > allowed {
            return fail(format!("mode ({x}, {y}, {phi}) of multiplicity {m} missed by {error:e}"));
        }
        worst = worst.max(error);
    }
    for solution in &complex_ones {
        let [theta, z, w] = ["theta", "z", "w"].map(|key| complex(&solution[key]));
        let size = answer.size.max(z.norm()).max(w.norm());
        let error = answer
            .complex
            .iter()
            .filter(|found| found.multiplicity == multiplicity(solution))
            .map(|found| {
                let position = (found.z - z).norm().max((found.w - w).norm()) / size;
                position.max((found.theta - theta).norm() / theta.norm())
            })
            .fold(f64::INFINITY, f64::min);
        if error > SIMPLE {
            return fail(format!("complex solution at theta = {theta} missed by {error:e}"));
        }
        worst = worst.max(error);
    }
    let residual = answer.modes.iter().map(|m| m.residual).fold(0.0, f64::max);
    if residual > RESIDUAL {
        return fail(format!("residual {residual:e}"));
    }
    let curves = instance["curve_thetas"].as_array().expect("curves");
    for curve in curves {
        let phi = complex(&curve["theta"]).arg();
        if !answer.self_motions.iter().any(|m| m.phi.is_some_and(|found| turn(found, phi) < SIMPLE)) {
            return fail(format!("self-motion at phi = {phi} missed"));
        }
        if account.self_motion != curve["mult_in_T"].as_u64().expect("mult_in_T") as usize {
            return fail(format!("self-motion counted {} times", account.self_motion));
        }
    }
    Ok(worst)
}

#[test]
fn every_reference_solution_is_found_and_nothing_else() {
    let mut failures = Vec::new();
    let mut worst = 0.0f64;
    for instance in instances() {
        match check(&instance) {
            Ok(error) => worst = worst.max(error),
            Err(failure) => failures.push(failure),
        }
    }
    println!("worst error over all solutions: {worst:e}");
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
