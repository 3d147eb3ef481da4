//! Coupler curves: the reference intersections, what traced points satisfy, circuits, cognates, planted intersections.
//!
//! `tests/golden/coupler.json` holds all finite intersections of six pairs of four-bar curves to 30 digits.

mod random;

use assur::linkage::{
    CouplerCurve, CouplerError, CouplerSide, DoublePointKind, GrashofClass, InputRange, Intersections, Partner,
    TwoLinkGroup,
};
use assur::nalgebra::Vector2;
use assur::num_complex::Complex64;
use random::Random;
use serde_json::Value;

fn number(v: &Value) -> f64 {
    v.as_f64().unwrap_or_else(|| v.as_str().expect("a number or its digits").parse().expect("digits"))
}

fn pair(v: &Value) -> [f64; 2] {
    [number(&v[0]), number(&v[1])]
}

fn complex(v: &Value) -> Complex64 {
    Complex64::new(number(&v[0]), number(&v[1]))
}

fn scale() -> usize {
    std::env::var("ASSUR_TEST_SCALE").ok().and_then(|text| text.parse().ok()).unwrap_or(1)
}

fn four_bar(v: &Value) -> CouplerCurve {
    let radii = [number(&v["r"]), number(&v["s"])];
    CouplerCurve::four_bar([pair(&v["a"]), pair(&v["b"])], [pair(&v["p"]), pair(&v["q"])], radii).expect("sound")
}

fn vector(random: &mut Random) -> [f64; 2] {
    [random.between(-3.0, 3.0), random.between(-3.0, 3.0)]
}

/// A four-bar through a point with a rotation: it can be assembled.
fn planted(random: &mut Random, z: Complex64) -> CouplerCurve {
    let (arms, pivots) = ([vector(random), vector(random)], [vector(random), vector(random)]);
    let theta = Complex64::from_polar(1.0, random.between(-3.1, 3.1));
    let c = |v: [f64; 2]| Complex64::new(v[0], v[1]);
    let radii = [0, 1].map(|k| (z + theta * c(arms[k]) - c(pivots[k])).norm());
    CouplerCurve::four_bar(pivots, arms, radii).expect("sound")
}

/// A slider-crank or double slider through a point.
fn sliding(random: &mut Random, z: Complex64, cranks: usize) -> CouplerCurve {
    let theta = Complex64::from_polar(1.0, random.between(-3.1, 3.1));
    let mut side = |slides: bool| {
        let arm: Vector2<f64> = vector(random).into();
        let at = z + theta * Complex64::new(arm.x, arm.y);
        let at = Vector2::new(at.re, at.im);
        if slides {
            return CouplerSide::Line { point: at, direction: vector(random).into(), arm };
        }
        let pivot: Vector2<f64> = vector(random).into();
        CouplerSide::Circle { pivot, radius: (at - pivot).norm(), arm }
    };
    CouplerCurve::new([side(cranks == 0), side(true)]).expect("sound")
}

fn complete(found: &Intersections) -> bool {
    let account = found.account;
    account.adds_up() && account.undecided == 0 && account.self_motion == 0
}

#[test]
fn every_reference_intersection_is_found() {
    let all: Value = serde_json::from_str(include_str!("golden/coupler.json")).expect("json");
    let mut worst = 0.0f64;
    for case in all["instances"].as_array().expect("instances") {
        let (one, other) = (four_bar(&case["fourbar1"]), four_bar(&case["fourbar2"]));
        let found = one.meet(&Partner::Coupler(other)).expect("sound");
        let expected = |key: &str| case[key].as_u64().expect("a count") as usize;
        assert!(complete(&found), "{}: {:?}", case["kind"], found.account);
        assert_eq!(found.account.real + found.account.complex, expected("count"), "{}", case["kind"]);
        assert_eq!(found.account.at_infinity, 18 - expected("count"));
        assert_eq!(found.list.iter().filter(|i| i.real).count(), expected("n_real"), "{}", case["kind"]);
        for solution in case["solutions"].as_array().expect("solutions") {
            let [z, w, theta1, theta2] = ["z", "w", "theta1", "theta2"].map(|key| complex(&solution[key]));
            let real = solution["real"].as_bool().expect("real");
            let error = |i: &assur::linkage::Intersection| {
                let places = (i.z - z).norm() / z.norm().max(1.0) + (i.w - w).norm() / w.norm().max(1.0);
                let turns =
                    (i.thetas[0] - theta1).norm() / theta1.norm() + (i.thetas[1] - theta2).norm() / theta2.norm();
                places + turns
            };
            let same_kind = found.list.iter().filter(|i| i.real == real);
            worst = worst.max(same_kind.map(error).fold(f64::INFINITY, f64::min));
        }
    }
    println!("worst error: {worst:e}");
    assert!(worst < 1e-9, "{worst:e}");
}

#[test]
fn a_planted_point_is_among_the_intersections() {
    let mut random = Random::new(18);
    for _ in 0..60 * scale() {
        let z = Complex64::new(random.between(-2.0, 2.0), random.between(-2.0, 2.0));
        let (one, other) = (planted(&mut random, z), planted(&mut random, z));
        let found = one.meet(&Partner::Coupler(other)).expect("sound");
        assert!(complete(&found), "{:?} {one:?} {other:?}", found.account);
        let nearest = found.list.iter().filter(|i| i.real).map(|i| (i.z - z).norm()).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-7, "{nearest:e}: {one:?} {other:?}");
        assert!(found.list.iter().all(|i| i.residual < 1e-10));
    }
}

#[test]
fn lines_and_circles_meet_six_times_four_about_a_focus() {
    let mut random = Random::new(6);
    for _ in 0..40 * scale() {
        let z = Complex64::new(random.between(-2.0, 2.0), random.between(-2.0, 2.0));
        let curve = planted(&mut random, z);
        let at = Vector2::new(z.re, z.im);
        let line = Partner::Line { point: at, direction: vector(&mut random).into() };
        let center: Vector2<f64> = vector(&mut random).into();
        let circle = Partner::Circle { center, radius: (at - center).norm() };
        let [a, _, _] = curve.foci().expect("a four-bar");
        let about_focus = Partner::Circle { center: a, radius: (at - a).norm() };
        for (partner, count) in [(line, 6), (circle, 6), (about_focus, 4)] {
            let found = curve.meet(&partner).expect("sound");
            assert!(complete(&found), "{:?}: {curve:?} {partner:?}", found.account);
            assert_eq!((found.account.degree, found.account.at_infinity), (6, 6 - count));
            // The planted point is on the curve up to rounding: near a tangent it may move by the root of that, or leave the reals.
            let nearest = found.list.iter().map(|i| (i.z - z).norm()).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-6, "{nearest:e}: {curve:?} {partner:?}");
        }
    }
}

#[test]
fn sliders_meet_everything_too() {
    let mut random = Random::new(4);
    for _ in 0..10 * scale() {
        let z = Complex64::new(random.between(-2.0, 2.0), random.between(-2.0, 2.0));
        let at = Vector2::new(z.re, z.im);
        let curves = [sliding(&mut random, z, 1), sliding(&mut random, z, 0), planted(&mut random, z)];
        for one in &curves[..2] {
            let line = Partner::Line { point: at, direction: vector(&mut random).into() };
            let center: Vector2<f64> = vector(&mut random).into();
            let circle = Partner::Circle { center, radius: (at - center).norm() };
            let others = [sliding(&mut random, z, 1), sliding(&mut random, z, 0), curves[2]].map(Partner::Coupler);
            for partner in [line, circle].into_iter().chain(others) {
                let found = one.meet(&partner).expect("sound");
                assert!(complete(&found), "{:?}: {one:?} {partner:?}", found.account);
                let nearest = found.list.iter().map(|i| (i.z - z).norm()).fold(f64::INFINITY, f64::min);
                assert!(nearest < 1e-6, "{nearest:e}: {one:?} {partner:?}");
            }
        }
    }
}

#[test]
fn a_curve_shares_a_piece_with_its_cognates_and_they_trace_it() {
    let mut random = Random::new(3);
    for _ in 0..10 * scale() {
        let curve = planted(&mut random, Complex64::new(0.3, -0.4));
        let floats =
            |curve: &CouplerCurve| curve.equation().0.map(|row| row.map(|c| c.map(assur::algebra::nearest_f64)));
        let equation = floats(&curve);
        for cognate in curve.cognates().expect("a four-bar") {
            // Numbers of the cognate are rounded, so its equation is the same up to a factor and rounding.
            let other = floats(&cognate);
            let factor = equation[3][3].re / other[3][3].re;
            let largest = equation.iter().flatten().map(|c| c.re.hypot(c.im)).fold(0.0, f64::max);
            for (x, y) in equation.iter().flatten().zip(other.iter().flatten()) {
                let difference = (x.re - y.re * factor).hypot(x.im - y.im * factor);
                assert!(difference < 1e-11 * largest, "{difference:e} of {largest:e}");
            }
        }
        assert_eq!(curve.meet(&Partner::Coupler(curve)).map(|found| found.account.self_motion), Some(18));
    }
}

#[test]
fn traced_points_satisfy_the_equation_and_the_linkage() {
    let mut random = Random::new(2);
    for k in 0..60 * scale() {
        let z = Complex64::new(random.between(-2.0, 2.0), random.between(-2.0, 2.0));
        let curve = match k % 4 {
            0 => sliding(&mut random, z, 1),
            1 => sliding(&mut random, z, 0),
            _ => planted(&mut random, z),
        };
        let circuits = curve.circuits();
        assert!(!circuits.is_empty(), "{curve:?}");
        let equation = curve.equation();
        let c = |x: &assur::algebra::Gaussian<assur::algebra::Rational>| {
            let x = x.map(assur::algebra::nearest_f64);
            Complex64::new(x.re, x.im)
        };
        let (mut nearest, mut widest) = (f64::INFINITY, 0.0f64);
        for circuit in &circuits {
            let mut last: Option<Vector2<f64>> = None;
            let steps = 400;
            let (mut longest, mut perimeter) = (0.0f64, 0.0f64);
            for step in 0..=steps {
                let tau = std::f64::consts::TAU * f64::from(step) / f64::from(steps);
                let Some((point, theta)) = curve.trace(circuit, tau) else { continue };
                let at = Complex64::new(point.x, point.y);
                let (mut sum, mut size) = (Complex64::ZERO, 0.0);
                for (i, row) in equation.0.iter().enumerate() {
                    for (j, entry) in row.iter().enumerate() {
                        let term = c(entry) * at.powu(i as u32) * at.conj().powu(j as u32);
                        sum += term;
                        size += term.norm();
                    }
                }
                assert!(sum.norm() < 1e-10 * size, "{:e} of {size:e}: {curve:?}", sum.norm());
                for side in curve.sides() {
                    let arm = match *side {
                        CouplerSide::Circle { arm, .. } | CouplerSide::Line { arm, .. } => arm,
                    };
                    let joint = at + theta * Complex64::new(arm.x, arm.y);
                    let joint = Vector2::new(joint.re, joint.im);
                    let miss = match *side {
                        CouplerSide::Circle { pivot, radius, .. } => (joint - pivot).norm() - radius,
                        CouplerSide::Line { point, direction, .. } => direction.normalize().perp(&(joint - point)),
                    };
                    assert!(miss.abs() < 1e-9, "{curve:?}");
                }
                let step = last.map_or(0.0, |last| (point - last).norm());
                (longest, perimeter) = (longest.max(step), perimeter + step);
                nearest = nearest.min((at - z).norm());
                last = Some(point);
            }
            // Smooth and without jumps: each step is a small part of the way round.
            assert!(longest < 0.1 * perimeter, "{longest} of {perimeter}: {curve:?} {circuit:?}");
            widest = widest.max(longest);
        }
        // The planted point lies on some circuit.
        assert!(nearest <= widest, "{nearest}: {curve:?}");
    }
}

#[test]
fn random_cranks_assemble_on_exactly_the_circuits_reported() {
    let mut random = Random::new(1);
    let mut kinds = std::collections::BTreeSet::new();
    for _ in 0..200 * scale() {
        let (pivots, arms) = ([vector(&mut random), vector(&mut random)], [vector(&mut random), vector(&mut random)]);
        let radii = [random.between(0.1, 4.0), random.between(0.1, 4.0)];
        let curve = CouplerCurve::four_bar(pivots, arms, radii).expect("sound");
        let circuits = curve.circuits();
        let class = curve.grashof().expect("a four-bar");
        kinds.insert(class.name());
        let expected = match class {
            GrashofClass::CannotAssemble => 0,
            GrashofClass::TripleRocker { .. } => 1,
            _ => 2,
        };
        assert_eq!(circuits.len(), expected, "{class:?}: {curve:?}");
        let full = circuits.iter().any(|circuit| circuit.input == InputRange::Full);
        assert_eq!(full, matches!(class, GrashofClass::CrankRocker | GrashofClass::DoubleCrank));
        let coupler = (Vector2::from(arms[0]) - Vector2::from(arms[1])).norm();
        for _ in 0..20 {
            let angle = random.between(-3.1, 3.1);
            let joint = Vector2::from(pivots[0]) + Vector2::new(angle.cos(), angle.sin()) * radii[0];
            let dyad = TwoLinkGroup::RRR { pivots: [joint, pivots[1].into()], lengths: [coupler, radii[1]] };
            let closes = dyad.assemble().expect("sound").assemblies.len();
            let ways = circuits.iter().filter(|circuit| circuit.contains_input(angle));
            let ways: usize = ways.map(|circuit| if circuit.way.is_some() { 1 } else { 2 }).sum();
            assert_eq!(ways, closes, "at {angle}: {curve:?} {circuits:?}");
        }
    }
    println!("{kinds:?}");
    assert!(kinds.len() >= 8, "{kinds:?}");
}

#[test]
fn double_points_are_double_and_of_their_kind() {
    let mut random = Random::new(9);
    let mut kinds = std::collections::BTreeMap::new();
    for _ in 0..60 * scale() {
        let curve = planted(&mut random, Complex64::new(0.5, 0.25));
        let points = curve.double_points().expect("not a guided point");
        assert_eq!(points.len(), 3, "{curve:?}");
        for point in &points {
            *kinds.entry(point.kind.name()).or_insert(0) += 1;
            let Some(at) = point.point() else { continue };
            let (centre, radius) = curve.circle_of_singular_foci().expect("not on a line");
            assert!(((at - centre).norm() - radius).abs() < 1e-6 * radius.max(1.0));
            // A line through a double point meets the curve twice there, with two rotations.
            let line = Partner::Line { point: at, direction: Vector2::new(0.6, 0.77) };
            let found = curve.meet(&line).expect("sound");
            let here: Vec<_> = found.list.iter().filter(|i| (i.z - point.z).norm() < 1e-5).collect();
            if point.kind == DoublePointKind::Crunode {
                assert_eq!(here.iter().filter(|i| i.real).count(), 2, "{curve:?} {point:?} {found:?}");
            }
        }
    }
    println!("{kinds:?}");
    assert!(kinds["crunode"] > 0 && kinds["acnode"] > 0, "{kinds:?}");
}

#[test]
fn degenerate_four_bars_have_names() {
    let class = |ground: f64, coupler: f64, radii| {
        let arms = [[0.0, 1.0], [coupler, 1.0]];
        CouplerCurve::four_bar([[0.0, 0.0], [ground, 0.0]], arms, radii).expect("sound").grashof().expect("a four-bar")
    };
    assert_eq!(class(4.0, 4.0, [2.0, 2.0]), GrashofClass::Parallelogram);
    assert_eq!(class(4.0, 2.0, [4.0, 2.0]), GrashofClass::Kite);
    assert_eq!(class(4.0, 3.0, [2.0, 3.0]), GrashofClass::ChangePoint);
    assert_eq!(class(4.0, 3.0, [0.0, 3.0]), GrashofClass::ZeroLink);
    assert_eq!(class(9.0, 1.0, [2.0, 3.0]), GrashofClass::CannotAssemble);
    let parallelogram =
        CouplerCurve::four_bar([[0.0, 0.0], [4.0, 0.0]], [[0.0, 1.0], [4.0, 1.0]], [2.0, 2.0]).expect("sound");
    assert!(parallelogram.circuits().iter().all(|circuit| circuit.touches));
    // A crank without length: nothing moves.
    let stiff = CouplerCurve::four_bar([[0.0, 0.0], [4.0, 0.0]], [[0.0, 1.0], [3.0, 1.0]], [0.0, 3.0]).expect("sound");
    assert!(stiff.circuits().is_empty());
    let point = CouplerCurve::four_bar([[0.0, 0.0], [4.0, 0.0]], [[0.0, 0.0], [2.0, 0.0]], [1.0, 2.5]).expect("sound");
    assert_eq!(point.double_points(), None);
}

#[test]
fn bad_input_is_refused_by_name() {
    let four_bar = |p: [f64; 2], radii| CouplerCurve::four_bar([[0.0, 0.0], [4.0, 0.0]], [p, [2.0, 1.0]], radii);
    assert_eq!(four_bar([2.0, 1.0], [1.0, 1.0]), Err(CouplerError::OneJoint));
    assert_eq!(four_bar([0.0, 1.0], [1.0, -2.0]).unwrap_err().to_string(), "side 2: radius -2 must be ≥ 0");
    assert_eq!(four_bar([0.0, f64::NAN], [1.0, 2.0]).unwrap_err().to_string(), "side 1: arm NaN must be finite");
    let line = |direction: [f64; 2], arm: [f64; 2]| CouplerSide::Line {
        point: Vector2::zeros(),
        direction: direction.into(),
        arm: arm.into(),
    };
    let parallel = CouplerCurve::new([line([1.0, 2.0], [0.0, 0.0]), line([-2.0, -4.0], [1.0, 0.0])]);
    assert_eq!(parallel, Err(CouplerError::ParallelLines));
    let curve = four_bar([0.0, 1.0], [1.0, 3.0]).expect("sound");
    assert_eq!(curve.meet(&Partner::Line { point: Vector2::zeros(), direction: Vector2::zeros() }), None);
    assert_eq!(curve.meet(&Partner::Circle { center: Vector2::zeros(), radius: f64::INFINITY }), None);
}
