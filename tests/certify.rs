//! Proofs against independent exact methods: the reference set to 30 digits, and random triads against Sturm sequences written here.
//!
//! `ASSUR_TEST_SCALE` multiplies the number of random triads; 1 (the default) takes a hundredth of the full count, 100 all of it.

mod random;

use std::f64::consts::PI;

use assur::algebra::{Integer, Interval, Rational, dyadic};
use assur::nalgebra::Vector2;
use assur::roots::Harmonics;
use assur::{Dyad, Offset, ProofRoute, RejectionReason, Status, Triad, Verdict};
use random::Random;
use serde_json::Value;

fn point(random: &mut Random) -> Vector2<f64> {
    Vector2::new(random.between(-5.0, 5.0), random.between(-5.0, 5.0))
}

fn scale() -> usize {
    std::env::var("ASSUR_TEST_SCALE").ok().and_then(|text| text.parse().ok()).unwrap_or(1)
}

fn exact(x: f64) -> Rational {
    dyadic(x).expect("finite")
}

// ── An independent count: RR-RR-RR over rationals, by elimination in the half-angle and Sturm's theorem ──

/// A polynomial in the half-angle `t`, ascending.
type Poly = Vec<Rational>;

fn trim(mut p: Poly) -> Poly {
    while p.last().is_some_and(|c| *c == Rational::ZERO) {
        p.pop();
    }
    p
}

fn add(p: &Poly, q: &Poly) -> Poly {
    let zero = Rational::ZERO;
    let at = |p: &Poly, k: usize| p.get(k).cloned().unwrap_or(zero.clone());
    trim((0..p.len().max(q.len())).map(|k| at(p, k) + at(q, k)).collect())
}

fn mul(p: &Poly, q: &Poly) -> Poly {
    let mut out = vec![Rational::ZERO; (p.len() + q.len()).saturating_sub(1)];
    for (i, a) in p.iter().enumerate() {
        for (j, b) in q.iter().enumerate() {
            out[i + j] += a * b;
        }
    }
    trim(out)
}

fn times(p: &Poly, factor: i64) -> Poly {
    mul(p, &vec![Rational::from(factor)])
}

/// Quotient and remainder.
fn divide(p: &Poly, q: &Poly) -> (Poly, Poly) {
    let (mut rest, mut quotient) = (p.clone(), vec![Rational::ZERO; p.len().saturating_sub(q.len()) + 1]);
    while rest.len() >= q.len() {
        let factor = rest.last().expect("not zero") / q.last().expect("not zero");
        let shift = rest.len() - q.len();
        for (k, c) in q.iter().enumerate() {
            rest[shift + k] -= &factor * c;
        }
        quotient[shift] = factor;
        rest.pop();
        rest = trim(rest);
    }
    (trim(quotient), rest)
}

/// Distinct real roots, by Sturm's theorem; also of polynomials with multiple roots.
fn sturm_count(p: &Poly) -> usize {
    let derivative: Poly = p.iter().enumerate().skip(1).map(|(k, c)| c * Rational::from(k)).collect();
    let mut chain = vec![p.clone(), trim(derivative)];
    while chain[chain.len() - 1].len() > 1 {
        let (_, rest) = divide(&chain[chain.len() - 2], &chain[chain.len() - 1]);
        if rest.is_empty() {
            break;
        }
        let size =
            rest.iter().map(|c| if *c < Rational::ZERO { -c.clone() } else { c.clone() }).max().expect("not zero");
        chain.push(rest.iter().map(|c| -(c / &size)).collect());
    }
    let changes = |signs: Vec<bool>| signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
    let positive = |p: &Poly| *p.last().expect("not zero") > Rational::ZERO;
    let at_plus = changes(chain.iter().filter(|p| !p.is_empty()).map(positive).collect());
    let at_minus = changes(chain.iter().filter(|p| !p.is_empty()).map(|p| positive(p) ^ (p.len() % 2 == 0)).collect());
    at_minus - at_plus
}

/// Distinct real orientations of an RR-RR-RR triad, `phi = pi` excepted, from the three circles themselves: the two radical lines of the circles about
/// `A_i - R b_i` are intersected by Cramer's rule and put into the first circle. `None` where that degenerates.
fn count_by_sturm(legs: &[Dyad; 3]) -> Option<usize> {
    let constant = |x: Rational| trim(vec![x]);
    let [zero, one] = [0i64, 1].map(Rational::from);
    // w = 1 + t², c w = 1 - t², s w = 2t.
    let w: Poly = vec![one.clone(), zero.clone(), one.clone()];
    let c: Poly = vec![one.clone(), zero.clone(), -one.clone()];
    let s: Poly = vec![zero, Rational::from(2)];
    // Centres times w, and squared lengths times w².
    let circles: Vec<(Poly, Poly, Poly)> = legs
        .iter()
        .map(|leg| {
            let Dyad::RR { a, b, length } = leg else { panic!("RR legs only") };
            let [ax, ay, bx, by, l] = [a.x, a.y, b.x, b.y, *length].map(|x| constant(exact(x)));
            let x = add(&mul(&ax, &w), &times(&add(&mul(&bx, &c), &times(&mul(&by, &s), -1)), -1));
            let y = add(&mul(&ay, &w), &times(&add(&mul(&bx, &s), &mul(&by, &c)), -1));
            (x, y, mul(&mul(&l, &l), &mul(&w, &w)))
        })
        .collect();
    let norm = |x: &Poly, y: &Poly| add(&mul(x, x), &mul(y, y));
    let minus = |p: &Poly, q: &Poly| add(p, &times(q, -1));
    // |P - C_i|² = l_i² less |P - C_0|² = l_0², all about C_0: with p = w (P - C_0) and d = w (C_i - C_0), 2 d·p = d·d - (l_i² - l_0²) w².
    let line = |i: usize| {
        let (dx, dy) = (minus(&circles[i].0, &circles[0].0), minus(&circles[i].1, &circles[0].1));
        let right = minus(&norm(&dx, &dy), &minus(&circles[i].2, &circles[0].2));
        (times(&dx, 2), times(&dy, 2), right)
    };
    let ((a1, b1, r1), (a2, b2, r2)) = (line(1), line(2));
    let determinant = minus(&mul(&a1, &b2), &mul(&a2, &b1));
    let x = minus(&mul(&r1, &b2), &mul(&r2, &b1));
    let y = minus(&mul(&a1, &r2), &mul(&a2, &r1));
    let mut t = minus(&norm(&x, &y), &mul(&circles[0].2, &mul(&determinant, &determinant)));
    if t.is_empty() || determinant.is_empty() {
        return None;
    }
    // Powers of 1 + t² are common to all and have no real root.
    while t.len() > 2 {
        let (quotient, rest) = divide(&t, &w);
        if !rest.is_empty() {
            break;
        }
        t = quotient;
    }
    Some(sturm_count(&t))
}

fn rr(a: Vector2<f64>, b: Vector2<f64>, length: f64) -> Dyad {
    Dyad::RR { a, b, length }
}

fn random_triad(random: &mut Random) -> Triad {
    let leg = |random: &mut Random| {
        let (a, b) = (point(random), point(random));
        rr(a, b, random.between(0.0, 10.0))
    };
    Triad::new([leg(random), leg(random), leg(random)]).expect("valid")
}

/// A planted pose, so that there is at least one mode.
fn planted_triad(random: &mut Random) -> Triad {
    let (x, turn) = (point(random), random.between(-PI, PI));
    let leg = |random: &mut Random| {
        let (a, b) = (point(random), point(random));
        let joint = x + Vector2::new(turn.cos() * b.x - turn.sin() * b.y, turn.sin() * b.x + turn.cos() * b.y);
        rr(a, b, (joint - a).norm())
    };
    Triad::new([leg(random), leg(random), leg(random)]).expect("valid")
}

/// A planted pose in which the legs' lines nearly meet in a point: two modes `gap` apart, in order of magnitude, or nearly.
fn nearly_singular_triad(random: &mut Random, gap: f64) -> Triad {
    let (x, turn, pole) = (point(random), random.between(-PI, PI), point(random));
    let leg = |random: &mut Random, miss: f64| {
        let b = point(random);
        let joint = x + Vector2::new(turn.cos() * b.x - turn.sin() * b.y, turn.sin() * b.x + turn.cos() * b.y);
        // The base pivot on the line through the pole and the joint, but for a turn by `miss`.
        let along = pole - joint;
        let across = Vector2::new(-along.y, along.x);
        let a = joint + (along + miss * across) * random.between(0.5, 2.5);
        rr(a, b, (joint - a).norm())
    };
    let legs = [leg(random, 0.0), leg(random, 0.0), leg(random, gap)];
    Triad::new(legs).expect("valid")
}

fn check_against_sturm(triad: &Triad, what: &str) -> ProofRoute {
    let proved = triad.prove();
    assert_ne!(proved.status, Status::Undecided, "{what}: undecided: {triad:?}");
    if let Some(count) = count_by_sturm(triad.legs()) {
        assert_eq!(proved.modes.len(), count, "{what}: {triad:?}");
    }
    assert_eq!(proved.indistinct, 0, "{what}: {triad:?} {proved:?}");
    proved.route
}

#[test]
fn random_triads_are_counted_as_by_sturm() {
    let mut random = Random::new(4);
    let count = 1000 * scale();
    let mut filtered = 0;
    for n in 0..count {
        let triad = if n % 2 == 0 { random_triad(&mut random) } else { planted_triad(&mut random) };
        filtered += usize::from(check_against_sturm(&triad, &format!("triad {n} of seed 4")) == ProofRoute::Filter);
    }
    println!("{count} random triads, none undecided; {filtered} decided by the filter");
    // The filter is there to spare exact arithmetic, not only to be right.
    assert!(100 * filtered > 98 * count, "{filtered} of {count}");
}

#[test]
fn nearly_singular_triads_are_counted_as_by_sturm() {
    let mut random = Random::new(14);
    let count = 200 * scale();
    let mut filtered = 0;
    for n in 0..count {
        let gap = 10f64.powf(random.between(-14.0, -4.0));
        let triad = nearly_singular_triad(&mut random, gap);
        filtered += usize::from(
            check_against_sturm(&triad, &format!("triad {n} of seed 14, gap {gap:e}")) == ProofRoute::Filter,
        );
    }
    println!("{count} nearly singular triads, none undecided; {filtered} decided by the filter");
}

// ── The reference set ──

fn number(v: &Value) -> f64 {
    v.as_f64().unwrap_or_else(|| v.as_str().expect("a number or its digits").parse().expect("digits"))
}

/// A decimal fraction as printed, exactly.
fn decimal(v: &Value) -> Rational {
    let text = match v {
        Value::String(text) => text.clone(),
        other => other.to_string(),
    };
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((&text, "0"));
    let exponent: i64 = exponent.parse().expect("an exponent");
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: Integer = format!("{whole}{fraction}").parse().expect("digits");
    let shift = exponent - fraction.len() as i64;
    let power = Rational::from(Integer::from(10).pow(shift.unsigned_abs() as usize));
    if shift >= 0 { Rational::from(digits) * power } else { Rational::from(digits) / power }
}

fn vector(v: &Value) -> Vector2<f64> {
    Vector2::new(number(&v[0]), number(&v[1]))
}

fn dyad(leg: &Value) -> Dyad {
    match leg["type"].as_str().expect("type") {
        "RR" => rr(vector(&leg["a"]), vector(&leg["b"]), number(&leg["l"])),
        "PR" => Dyad::PR { a: vector(&leg["a"]), u: vector(&leg["u"]), b: vector(&leg["b"]) },
        "RP" => {
            let offset = Offset::Distance(number(&leg["d"]));
            Dyad::RP { a: vector(&leg["a"]), b: vector(&leg["b"]), v: vector(&leg["v"]), offset }
        }
        "PP" => Dyad::PP { phi: number(&leg["phi"]) },
        other => panic!("unknown dyad {other}"),
    }
}

/// What an instance gets wrong, if anything.
fn failures(instance: &Value) -> Vec<String> {
    let legs = instance["legs"].as_array().expect("legs");
    let triad = Triad::new([0, 1, 2].map(|i: usize| dyad(&legs[i]))).expect("valid");
    let answer = triad.certify();
    let mut out = Vec::new();
    let mut fail =
        |what: String| out.push(format!("triad {} ({}, {}): {what}", instance["id"], instance["family"], triad.name()));
    let status = match instance["status"].as_str().expect("status") {
        "ok" | "no_solution" => Status::Complete,
        _ => Status::SelfMotion,
    };
    let certificate = answer.certificate.expect("asked for");
    if answer.status != status || !certificate.complete {
        fail(format!("{:?} instead of {status:?}: {certificate}", answer.status));
    }
    if answer.modes.iter().any(|mode| mode.proof != Verdict::Proven) {
        fail("a mode is not proved".into());
    }
    let proved = triad.prove();
    if proved.status != status || proved.modes.len() != answer.modes.len() {
        fail(format!("prove: {:?} with {} modes", proved.status, proved.modes.len()));
    }
    let real: Vec<&Value> =
        instance["solutions"].as_array().expect("solutions").iter().filter(|s| s["real"] == true).collect();
    if real.len() != answer.modes.len() {
        fail(format!("{} modes instead of {}", answer.modes.len(), real.len()));
    }
    // References are rounded in their 30th digit.
    let slack = Rational::ONE / Rational::from(Integer::from(10).pow(27));
    for solution in &real {
        let place = ["x", "y", "phi"].map(|key| decimal(&solution[key]));
        let holds = |bounds: &[[f64; 2]; 3]| {
            let turn = Rational::from(2) * "31415926535897932384626433832795".parse::<Rational>().expect("digits")
                / Rational::from(Integer::from(10).pow(31));
            (0..3).all(|k| {
                let size = Rational::ONE + if place[k] < Rational::ZERO { -place[k].clone() } else { place[k].clone() };
                let within = |x: &Rational| {
                    exact(bounds[k][0]) - &slack * &size <= *x && *x <= exact(bounds[k][1]) + &slack * &size
                };
                within(&place[k]) || (k == 2 && (within(&(&place[2] + &turn)) || within(&(&place[2] - &turn))))
            })
        };
        let boxes = answer.modes.iter().filter(|m| m.pose_box.as_ref().is_some_and(holds));
        let found: Vec<usize> = boxes.map(|m| m.multiplicity).collect();
        if found != [solution["mult"].as_u64().expect("mult") as usize] {
            fail(format!(
                "({}, {}, {}) of multiplicity {} lies in boxes of {found:?}: {:?}",
                solution["x"], solution["y"], solution["phi"], solution["mult"], answer.modes
            ));
        }
        if proved.modes.iter().filter(|m| holds(&m.pose_box)).count() != 1 {
            fail(format!("({}, {}, {}) and the boxes of prove", solution["x"], solution["y"], solution["phi"]));
        }
    }
    out
}

#[test]
fn every_reference_solution_lies_in_a_box_of_its_own() {
    let all: Value = serde_json::from_str(include_str!("golden/triads.json")).expect("json");
    let instances = all["instances"].as_array().expect("instances");
    let failures: Vec<String> = instances.iter().flat_map(failures).collect();
    assert!(failures.is_empty(), "{} failures in {}:\n{}", failures.len(), instances.len(), failures.join("\n"));
}

#[test]
fn decimals_that_only_look_similar_are_reported_with_their_distance() {
    let leg = |a: [f64; 2], b: [f64; 2], l| rr(a.into(), b.into(), l);
    // The platform is three tenths of the base, in decimals; in binary it is not.
    let triad = Triad::new([
        leg([0.0, 0.0], [0.0, 0.0], 1.0),
        leg([1.0, 0.2], [0.3, 0.06], 1.1),
        leg([0.4, 0.9], [0.12, 0.27], 0.9),
    ]);
    let answer = triad.expect("valid").certify();
    assert!(!answer.special.iter().any(|s| s.name() == "similar_platforms"));
    let near = answer.near.iter().find(|near| near.special.name() == "similar_platforms").expect("a near miss");
    assert!(near.distance > 0.0 && near.distance < 1e-15, "{near:?}");
    assert!(answer.certificate.expect("asked for").complete);
}

#[test]
fn similar_platforms_of_any_ratio_are_rejected_by_name() {
    let leg = |a: [f64; 2], b: [f64; 2], l| rr(a.into(), b.into(), l);
    // a = k b with k = 1/2, 2i, 1 + i, and with |k| = 1 but unequal lengths.
    for [re, im] in [[0.5, 0.0], [0.0, 2.0], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0]] {
        let of = |b: [f64; 2]| [re * b[0] - im * b[1], re * b[1] + im * b[0]];
        let platform = [[0.0, 0.0], [4.0, 1.0], [1.0, 3.0]];
        let legs: [Dyad; 3] = std::array::from_fn(|i| leg(of(platform[i]), platform[i], [3.0, 3.25, 3.5][i]));
        let answer = Triad::new(legs).expect("valid").certify();
        assert!(answer.special.iter().any(|s| s.name() == "similar_platforms"), "{re} + {im}i: {:?}", answer.special);
        assert_eq!(answer.account.rejected, 2, "{re} + {im}i: {:?}", answer.account);
        assert_eq!(answer.account.real + answer.account.complex, 4, "{re} + {im}i: {:?}", answer.account);
        assert!(answer.certificate.expect("asked for").complete);
        for rejection in &answer.rejections {
            assert_eq!(rejection.reason, RejectionReason::SimilarPlatforms, "{re} + {im}i");
            // theta = k and 1/conj(k).
            let size = rejection.theta.norm();
            let ratio = re.hypot(im);
            assert!((size - ratio).abs() < 1e-12 || (size - 1.0 / ratio).abs() < 1e-12, "{re} + {im}i: {size}");
        }
    }
}

#[test]
fn the_filter_does_not_decide_what_its_intervals_leave_open() {
    // cos(phi - turn) = h has two roots below h = 1 and none above; the interval of h reaches just beyond 1.
    let zero = Interval::ZERO;
    for n in 0..360 {
        let (sin, cos) = (f64::from(n) * PI / 180.0).sin_cos();
        let [sin, cos] = [sin, cos].map(Interval::point);
        for away in [1e-8, 1e-4, 0.01, 0.1, 0.5] {
            for h in [1.0 - away, 1.0 + away] {
                let open = Interval::around(h, 1.001 * away);
                let count = Harmonics::from_powers(&[-open, cos, zero, zero], &[sin, zero, zero]).real_roots();
                assert!(count.is_none(), "turned by {n} degrees: {open:?}");
            }
        }
    }
}
