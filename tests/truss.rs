//! Assur groups beyond the triad: the reference cases, random members of every catalogued truss, special dimensions, bad input.
//!
//! `tests/golden/truss_cases.json` holds all finite solutions of four trusses to 30 digits; `tests/golden/trusses.json` the catalogue.

mod random;

use assur::linkage::{Truss, TrussError, TrussJoint, baranov_trusses};
use assur::nalgebra::Vector2;
use assur::num_complex::Complex64;
use assur::{Status, linkage::TrussAssemblies};
use random::Random;
use serde_json::Value;

fn number(v: &Value) -> f64 {
    v.as_f64().unwrap_or_else(|| v.as_str().expect("a number or its digits").parse().expect("digits"))
}

fn integer(v: &Value) -> usize {
    v.as_u64().expect("an integer") as usize
}

fn pair<T>(v: &Value, read: impl Fn(&Value) -> T) -> [T; 2] {
    [read(&v[0]), read(&v[1])]
}

fn joints(case: &Value) -> Vec<TrussJoint> {
    let list = |key: &str| case[key].as_array().expect("a list").iter();
    let joint = |(edge, at): (&Value, &Value)| TrussJoint::drawn(pair(edge, integer), pair(at, number).into());
    list("edges").zip(list("joint_xy")).map(joint).collect()
}

/// How many times the usual number of random cases.
fn scale() -> usize {
    std::env::var("ASSUR_TEST_SCALE").ok().and_then(|text| text.parse().ok()).unwrap_or(1)
}

fn drawn(edges: &[[usize; 2]], random: &mut Random) -> Vec<TrussJoint> {
    let mut coordinate = || random.between(-5.0, 5.0);
    edges.iter().map(|&links| TrussJoint::drawn(links, Vector2::new(coordinate(), coordinate()))).collect()
}

/// Whether every solution's partner `1 / conj(theta)` is there.
fn closed_under_mirroring(found: &TrussAssemblies) -> bool {
    found.assemblies.iter().all(|a| {
        let mirrored: Vec<Complex64> = a.theta.iter().map(|t| t.conj().inv()).collect();
        found.assemblies.iter().any(|b| apart(&b.theta, &mirrored) < 1e-7)
    })
}

fn apart(a: &[Complex64], b: &[Complex64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).norm() / y.norm()).fold(0.0, f64::max)
}

#[test]
fn every_reference_solution_is_found() {
    let all: Value = serde_json::from_str(include_str!("golden/truss_cases.json")).expect("json");
    let mut worst = 0.0f64;
    for case in all["instances"].as_array().expect("instances") {
        let truss = Truss::new(integer(&case["links"]), &joints(case), integer(&case["ground"])).expect("a truss");
        let found = truss.assemble();
        let name = truss.catalogued().expect("is catalogued");
        assert_eq!((name.links, name.number), (integer(&case["links"]), integer(&case["truss"])));
        assert_eq!((found.count(), found.real().count()), (integer(&case["count"]), integer(&case["n_real"])));
        assert_eq!((found.status, found.missing), (Status::Complete, Some(0)));
        for solution in case["solutions"].as_array().expect("solutions") {
            let mut theta: Vec<Complex64> = vec![Complex64::ONE];
            theta.extend(solution["theta"].as_array().expect("theta").iter().map(|t| {
                let [re, im] = pair(t, number);
                Complex64::new(re, im)
            }));
            let real = solution["real"].as_bool().expect("real");
            let same_kind = found.assemblies.iter().filter(|a| a.real == real);
            worst = worst.max(same_kind.map(|a| apart(&a.theta, &theta)).fold(f64::INFINITY, f64::min));
        }
    }
    println!("worst relative error: {worst:e}");
    assert!(worst < 1e-9, "{worst:e}");
}

#[test]
fn the_catalogue_is_the_published_one() {
    let all: Value = serde_json::from_str(include_str!("golden/trusses.json")).expect("json");
    let all = all.as_array().expect("a list");
    assert_eq!(all.len(), baranov_trusses().count());
    for (given, own) in all.iter().zip(baranov_trusses()) {
        let edges: Vec<[usize; 2]> =
            given["edges"].as_array().expect("edges").iter().map(|edge| pair(edge, integer)).collect();
        let given = [&given["links"], &given["id"], &given["count"]].map(integer);
        assert_eq!(([own.links, own.number, own.count], own.edges()), (given, edges));
    }
}

/// The share of the promise that runs each time; all of it with `ASSUR_TEST_SCALE=100`.
#[test]
fn random_members_of_every_truss_are_complete_and_hold_their_drawing() {
    let mut random = Random::new(32);
    let (mut members, mut pencils, mut worst) = (0, 0, 0.0f64);
    for truss in baranov_trusses() {
        let count = if truss.links == 9 { scale() } else { 10 * scale() };
        for _ in 0..count {
            let joints = drawn(&truss.edges(), &mut random);
            let ground = members % truss.links;
            let found = Truss::new(truss.links, &joints, ground).expect("a truss").assemble();
            assert_eq!(
                found.status,
                Status::Complete,
                "{}: {} of {}: {joints:?}",
                truss.name(),
                found.count(),
                truss.count
            );
            assert_eq!(found.assemblies.len(), truss.count, "{}", truss.name());
            let planted = found.real().map(|a| apart(&a.theta, &vec![Complex64::ONE; truss.links]));
            let planted = planted.fold(f64::INFINITY, f64::min);
            assert!(planted < 1e-6, "{}: the drawing is missed by {planted:e}", truss.name());
            worst = worst.max(planted);
            assert!(closed_under_mirroring(&found), "{}", truss.name());
            assert!(found.assemblies.iter().all(|a| a.residual < 1e-10), "{}", truss.name());
            members += 1;
            pencils += found.pencils;
        }
    }
    println!("{members} members complete with {pencils} pencils; drawings found to {worst:e}");
}

#[test]
fn scale_and_place_change_nothing() {
    let mut random = Random::new(5);
    for truss in baranov_trusses().filter(|truss| truss.links < 9) {
        let joints = drawn(&truss.edges(), &mut random);
        let plain = Truss::new(truss.links, &joints, 0).expect("a truss").assemble();
        for (factor, shift) in [(1e-6, 0.0), (1e6, 0.0), (1.0, 1e3)] {
            let moved = |at: Vector2<f64>| at * factor + Vector2::repeat(shift);
            let joints: Vec<TrussJoint> =
                joints.iter().map(|joint| TrussJoint { links: joint.links, at: joint.at.map(moved) }).collect();
            let other = Truss::new(truss.links, &joints, 0).expect("a truss").assemble();
            assert_eq!(other.count(), plain.count());
            for a in &plain.assemblies {
                let nearest = other.assemblies.iter().map(|b| apart(&b.theta, &a.theta)).fold(f64::INFINITY, f64::min);
                assert!(nearest < 1e-6, "{} at {factor}, {shift}: {nearest:e}", truss.name());
            }
        }
    }
}

fn triad(points: [[f64; 2]; 6]) -> Vec<TrussJoint> {
    let edges = [[0, 3], [1, 3], [2, 3], [0, 4], [1, 4], [2, 4]];
    edges.into_iter().zip(points).map(|(links, at)| TrussJoint::drawn(links, at.into())).collect()
}

#[test]
fn special_dimensions_are_named_not_hidden() {
    // Platform congruent to the base and legs parallel: it translates on circles.
    let base = [[0.0, 0.0], [4.0, 0.0], [1.0, 3.0]];
    let shifted = base.map(|[x, y]| [x + 1.0, y + 2.0]);
    let joints = triad([base[0], base[1], base[2], shifted[0], shifted[1], shifted[2]]);
    let found = Truss::new(5, &joints, 3).expect("a truss").assemble();
    assert_eq!(found.status, Status::SelfMotion);
    assert!(!found.curves.is_empty());
    // A leg without length: its joints are one. The drawing is found, and the leg is said to be loose.
    let joints = triad([base[0], base[1], base[2], base[0], [3.0, 2.5], [0.5, 4.0]]);
    let found = Truss::new(5, &joints, 3).expect("a truss").assemble();
    assert_eq!(found.loose_links, [0]);
    assert!(found.real().any(|a| apart(&a.theta, &[Complex64::ONE; 5]) < 1e-9), "{found:?}");
    assert_eq!((found.expected, found.missing), (None, None));
    // Two platform pivots in one point.
    let joints = triad([base[0], base[1], base[2], [1.0, 1.0], [1.0, 1.0], [2.0, 2.5]]);
    let found = Truss::new(5, &joints, 3).expect("a truss").assemble();
    assert_eq!((found.status, found.missing), (Status::Undecided, Some(2)), "{found:?}");
    assert_eq!(found.count(), 4);
}

#[test]
fn bad_input_is_refused_by_name() {
    let refused = |joints: &[TrussJoint], links, ground| Truss::new(links, joints, ground).unwrap_err().to_string();
    let good = triad([[0.0, 0.0], [4.0, 0.0], [1.0, 3.0], [1.0, 1.0], [2.0, 1.0], [2.0, 2.5]]);
    let mut nan = good.clone();
    nan[2].at[1].x = f64::NAN;
    assert_eq!(refused(&nan, 5, 0), "joint 2: NaN must be finite");
    assert_eq!(refused(&good, 5, 9), "ground 9 does not exist; there are 5 links, counted from 0");
    assert_eq!(refused(&good, 2, 0), "2 links: must be from 3 to 11");
    let mut doubled = good.clone();
    doubled[3].links = [0, 3];
    assert!(refused(&doubled, 5, 0).starts_with("no Assur group: links 0, 3 with 2 joints between them, mobility -1"));
    assert_eq!(refused(&triad([[1.0, 2.0]; 6]), 5, 0), TrussError::NoLength.to_string());
}

#[cfg(feature = "exchange")]
#[test]
fn the_report_holds_what_the_contract_says() {
    use assur::exchange::{GroupReport, parse_group};
    let truss = parse_group(include_str!("../examples/seven-link.json"), "seven-link.json").expect("a truss");
    let report: Value =
        serde_json::from_str(&GroupReport::new(&truss, &truss.assemble(), true).to_json()).expect("json");
    assert_eq!(report["schema"], "assur/group-report/1");
    assert_eq!((&report["status"], &report["truss"]), (&"complete".into(), &"7#0".into()));
    assert_eq!((&report["count"], &report["expected"], &report["missing"]), (&18.into(), &18.into(), &0.into()));
    let assemblies = report["assemblies"].as_array().expect("a list");
    assert_eq!(assemblies.len(), 18);
    assert!(assemblies.iter().all(|a| a["theta"].as_array().is_some_and(|theta| theta.len() == 6)));
}
