//! Numbers hundreds of orders of magnitude apart: decided all the same, quickly, or the limit reached has a name.

use std::time::{Duration, Instant};

use assur::{Dyad, Status, Triad, Verdict};

/// Seen: at most a second, unoptimised dependencies included. What hangs takes minutes.
const PATIENCE: Duration = Duration::from_secs(20);

type Legs = [([f64; 2], [f64; 2], f64); 3];

/// The front page's triad, six modes.
const SIX: Legs =
    [([0.0, 0.0], [0.0, 0.0], 14.98), ([15.91, 0.0], [17.045, 0.0], 15.38), ([0.0, 10.0], [13.2389, 16.0929], 12.0)];

fn triad(legs: Legs) -> Triad {
    Triad::new(legs.map(|(a, b, length)| Dyad::RR { a: a.into(), b: b.into(), length })).expect("finite")
}

fn certified(legs: Legs, what: &str) -> assur::Assemblies {
    let start = Instant::now();
    let answer = triad(legs).certify();
    assert!(start.elapsed() < PATIENCE, "{what}: {:?}", start.elapsed());
    let certificate = answer.certificate.expect("asked for");
    assert!(certificate.complete && answer.status == Status::Complete, "{what}: {certificate} {:?}", answer.limit);
    assert_eq!((answer.limit, answer.account.degree), (None, 6), "{what}");
    let listed: usize = answer.complex.iter().map(|mode| mode.multiplicity).sum();
    assert_eq!(listed + answer.complex_out_of_range, answer.account.complex, "{what}");
    assert!(answer.modes.iter().all(|mode| mode.proof == Verdict::Proven && mode.pose_box.is_some()), "{what}");
    assert!(answer.near.iter().all(|near| near.distance > 0.0), "{what}: {:?}", answer.near);
    answer
}

#[test]
fn a_common_scale_changes_nothing() {
    for exponent in [-300, -150, 150, 300] {
        let scale = 10f64.powi(exponent);
        let legs = SIX.map(|(a, b, length)| (a.map(|x| x * scale), b.map(|x| x * scale), length * scale));
        let answer = certified(legs, &format!("1e{exponent}"));
        assert_eq!((answer.modes.len(), answer.complex_out_of_range), (6, 0));
    }
}

#[test]
fn lengths_hundreds_of_orders_apart_are_decided_in_moments() {
    for exponent in [-300, -150, -100, 100, 150, 300] {
        let scale = 10f64.powi(exponent);
        let [p, q, r] = SIX;
        let stretched = |(a, b, length): ([f64; 2], [f64; 2], f64)| (a.map(|x| x * scale), b, length);
        let cases = [
            [(p.0, p.1, p.2 * scale), q, r],
            SIX.map(|(a, b, length)| (a, b.map(|x| x * scale), length)),
            [p, stretched(q), r],
            [p, (stretched(q).0, q.1, q.2 * scale), r],
            [p, q, ([scale, 10.0], r.1, r.2)],
        ];
        for (number, legs) in cases.into_iter().enumerate() {
            certified(legs, &format!("case {number}, 1e{exponent}"));
        }
    }
}

#[test]
fn a_platform_as_small_as_an_atom_of_an_atom_stands_in_its_planted_pose() {
    // A platform 1e-200 in size near the point (3, 4): legs as long as the way there, but for what a turn of the platform can make up.
    for small in [1e-12, 1e-60, 1e-200] {
        let legs = [([0.0, 0.0], [0.0, 0.0], 5.0), ([6.0, 0.0], [small, 0.0], 5.0), ([3.0, -1.0], [0.0, small], 5.0)];
        let answer = certified(legs, &format!("{small:e}"));
        assert_eq!(answer.modes.len(), 2, "{small:e}");
        for mode in &answer.modes {
            assert!((mode.pose.x - 3.0).abs() < 1e-11 && (mode.pose.y - 4.0).abs() < 1e-11, "{mode:?}");
        }
    }
}

#[test]
fn near_misses_far_below_f64_keep_their_distance() {
    let [p, q, r] = SIX;
    let answer = certified([(p.0, p.1, 1e-300), q, r], "a leg of 1e-300");
    let near = answer.near.iter().find(|near| near.special.name() == "zero_length").expect("nearly zero");
    assert!((near.distance / (1e-300 / answer.size) - 1.0).abs() < 1e-12, "{near:?}");
}

#[test]
fn a_pose_beyond_f64_names_the_limit_of_exponents() {
    // Two lines that are parallel but for 1e-300, a distance of 1e200 apart: they cross 1e500 away.
    let line = |a: [f64; 2], u: [f64; 2], b: [f64; 2]| Dyad::PR { a: a.into(), u: u.into(), b: b.into() };
    let legs = [
        line([0.0, 0.0], [1.0, 0.0], [0.0, 0.0]),
        line([0.0, 1e200], [1.0, 1e-300], [0.0, 0.0]),
        Dyad::PP { phi: 0.0 },
    ];
    let answer = Triad::new(legs).expect("finite").certify();
    assert_eq!(answer.status, Status::Undecided);
    let limit = answer.limit.expect("named");
    assert_eq!(limit.name(), "exponent_range");
    assert!(limit.to_string().contains("range of f64"), "{limit}");
    assert!(!answer.certificate.expect("asked for").complete);
    // In range, the same is decided.
    let nearer = [legs[0], line([0.0, 1.0], [1.0, 1e-300], [0.0, 0.0]), legs[2]];
    let answer = Triad::new(nearer).expect("finite").certify();
    assert_eq!((answer.status, answer.limit), (Status::Complete, None));
    assert!((answer.modes[0].pose.x / -1e300 - 1.0).abs() < 1e-15);
}
