//! Random and adversarial inputs, for as long as `ASSUR_FUZZ_SECONDS` says (2 seconds a target by default).
//! The check of everything, `.ci/run`, gives each of the three targets 20 seconds: a minute in all.
//!
//! Nothing may panic, hang or contradict itself. The seed is printed; `ASSUR_FUZZ_SEED` sets it.

mod random;

use std::time::{Duration, Instant};

use assur::algebra::{Interval, Rational, dyadic};
use assur::nalgebra::Vector2;
use assur::{Dyad, Offset, Status, Triad, Verdict};
use random::Random;

/// A whole number from 0 to below `n`.
fn below(random: &mut Random, n: usize) -> usize {
    random.between(0.0, n as f64) as usize
}

fn pick<T: Copy>(random: &mut Random, from: &[T]) -> T {
    from[below(random, from.len())]
}

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// Runs a case again and again until the time is up.
fn for_a_while(target: &str, mut case: impl FnMut(&mut Random)) {
    let seed = setting("ASSUR_FUZZ_SEED", 1);
    let until = Instant::now() + Duration::from_secs(setting("ASSUR_FUZZ_SECONDS", 2));
    let mut count = 0u64;
    while Instant::now() < until {
        // Each case has a seed of its own, so that a failure can be had again alone.
        let mut random = Random::new(seed.wrapping_mul(1 << 32).wrapping_add(count));
        case(&mut random);
        count += 1;
    }
    println!("{target}: {count} cases, seed {seed}");
    assert!(count > 0);
}

/// A triad takes milliseconds, hard numbers seconds; what hangs takes longer.
const PATIENCE: Duration = Duration::from_secs(30);

const HARD: [f64; 20] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    3.0,
    0.1,
    1e-16,
    5e-324,
    -5e-324,
    1e-308,
    2.2250738585072014e-308,
    1e300,
    -1e300,
    1e150,
    1e-150,
    1e15,
    -7.0,
    1.0000000000000002,
    0.9999999999999999,
];

/// An adversarial number: hard, near an earlier one, or ordinary.
fn number(random: &mut Random, before: &mut Vec<f64>, tame: bool) -> f64 {
    let kind = below(random, 8);
    let x = match kind {
        0 | 1 if !tame => pick(random, &HARD),
        2 if !before.is_empty() => before[below(random, before.len())],
        3 if !before.is_empty() => {
            let x = before[below(random, before.len())];
            if below(random, 2) == 0 { x.next_up() } else { -x }
        }
        4 => below(random, 5) as f64 - 2.0,
        _ => random.between(-1.0, 1.0),
    };
    let x = if x.is_finite() { x } else { 1.0 };
    before.push(x);
    x
}

fn triad(random: &mut Random) -> Option<Triad> {
    let mut before = Vec::new();
    let tame = below(random, 2) == 0;
    let mut leg = || {
        let kind = below(random, 10);
        let mut number = || number(random, &mut before, tame);
        let mut point = || Vector2::new(number(), number());
        let (a, b, c) = (point(), point(), point());
        match kind {
            0..=3 => Dyad::RR { a, b, length: c.x.abs() },
            4 | 5 => Dyad::PR { a, u: c, b },
            6 | 7 => Dyad::RP { a, b, v: c, offset: Offset::Distance(a.x) },
            8 => Dyad::RP { a, b, v: c, offset: Offset::TimesDirection(b.y) },
            _ => Dyad::PP { phi: c.x },
        }
    };
    Triad::new([leg(), leg(), leg()]).ok()
}

#[test]
fn triads_with_adversarial_numbers_are_answered_and_proofs_agree() {
    let (mut undecided, mut slowest) = (0, Duration::ZERO);
    for_a_while("triads", |random| {
        let Some(triad) = triad(random) else { return };
        let start = Instant::now();
        let exact = triad.prove_exactly();
        if let Some(filtered) = triad.prove_filtered() {
            assert_eq!(filtered.modes.len(), exact.modes.len(), "{triad:?}");
            assert_eq!(exact.status, Status::Complete, "{triad:?}");
        }
        let answer = triad.certify();
        assert!(answer.account.adds_up(), "{triad:?}");
        assert_eq!(answer.limit.is_some(), answer.status == Status::Undecided, "{triad:?}");
        undecided += u64::from(answer.limit.is_some());
        slowest = slowest.max(start.elapsed());
        assert!(start.elapsed() < PATIENCE, "{:?}: {triad:?}", start.elapsed());
        let certificate = answer.certificate.expect("asked for");
        if certificate.complete {
            assert_eq!(answer.modes.len(), exact.modes.len(), "{triad:?}");
            assert!(
                answer.modes.iter().all(|mode| mode.proof == Verdict::Proven && mode.pose_box.is_some()),
                "{triad:?}"
            );
        }
    });
    println!("triads: {undecided} undecided, each with its limit; slowest {slowest:.1?}");
}

#[test]
fn chains_of_interval_operations_hold_the_exact_result() {
    for_a_while("intervals", |random| {
        let exact = |x: f64| dyadic(x).expect("finite");
        let start = pick(random, &HARD);
        let (mut interval, mut value) = (Interval::point(start), exact(start));
        for _ in 0..6 {
            let x = pick(random, &HARD);
            let (other, y) = (Interval::point(x), exact(x));
            match below(random, 7) {
                6 => {
                    // The root itself is irrational: it is held against the ends by squares.
                    if let Some(root) = interval.sqrt().filter(|_| value >= Rational::ZERO) {
                        let holds = |end: f64, above: bool| {
                            end.is_infinite()
                                || end < 0.0
                                || (exact(end) * exact(end) >= value) == above
                                || exact(end) * exact(end) == value
                        };
                        assert!(holds(root.lo(), false) && holds(root.hi(), true), "{interval:?} {root:?}");
                    }
                }
                0 => (interval, value) = (interval + other, value + y),
                1 => (interval, value) = (interval - other, value - y),
                2 => (interval, value) = (interval * other, value * y),
                3 => (interval, value) = (interval.square(), &value * &value),
                4 => {
                    if let Some(quotient) = interval.checked_div(other) {
                        (interval, value) = (quotient, value / y);
                    }
                }
                _ => (interval, value) = (-interval, -value),
            }
            let below = interval.lo() == f64::NEG_INFINITY || exact(interval.lo()) <= value;
            let above = interval.hi() == f64::INFINITY || value <= exact(interval.hi());
            assert!(
                below && above && interval.lo() <= interval.hi(),
                "{interval:?} {}",
                Rational::to_f64(&value).value()
            );
        }
    });
}

#[cfg(feature = "exchange")]
#[test]
fn damaged_model_files_are_refused_or_answered() {
    use assur::exchange::{ClaimedPoses, ModelFile};
    let sources = [
        include_str!("../examples/3-rpr.toml"),
        include_str!("../examples/mixed.toml"),
        include_str!("../examples/3-rrr.toml"),
    ];
    let pieces = [
        "nan",
        "inf",
        "1e999",
        "-1e300",
        "5e-324",
        "[",
        "]",
        "{",
        "}",
        "=",
        "\"",
        "_",
        "R_P_R",
        "RRR",
        "PPP",
        "leg",
        "0",
        "-",
        "\n",
        "deg",
        "\u{1F980}",
    ];
    for_a_while("model files", |random| {
        let mut text: Vec<char> = sources[below(random, sources.len())].chars().collect();
        for _ in 0..1 + below(random, 4) {
            let at = below(random, text.len().max(1));
            match below(random, 3) {
                0 => {
                    let end = (at + below(random, 12)).min(text.len());
                    text.drain(at..end);
                }
                1 => {
                    let piece: Vec<char> = pick(random, &pieces).chars().collect();
                    text.splice(at..at, piece);
                }
                _ => {
                    let piece: Vec<char> = pick(random, &pieces).chars().collect();
                    let end = (at + piece.len()).min(text.len());
                    text.splice(at..end, piece);
                }
            }
        }
        let text: String = text.into_iter().collect();
        let file = pick(random, &["model.toml", "model.json", "model"]);
        if let Err(error) = ClaimedPoses::parse(&text, file) {
            assert!(!error.to_string().contains('\n'), "{error}");
        }
        match ModelFile::parse(&text, file) {
            Err(error) => assert!(!error.to_string().contains('\n'), "{error}"),
            Ok(model) => {
                let inputs = [pick(random, &HARD), 10.0, 8.0];
                if let Err(error) = model.manipulator.certify(&inputs) {
                    assert!(!error.to_string().contains('\n'), "{error}");
                }
            }
        }
    });
}
