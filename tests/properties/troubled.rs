//! Triads near trouble: half-turns, close pairs, small integers, extreme sizes.

use assur::nalgebra::Vector2;
use assur::{Dyad, Offset, Pose, Status, Triad};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;

use super::cases;
use super::planted::{TRIADS, miss};
use super::sturm::real_orientations;
use super::triads::sound;

/// Integer legs that hold the platform, turned by half a turn, at an integer place: every number is exact.
fn half_turned(names: [&str; 3], at: [i32; 2], numbers: [[i32; 6]; 3]) -> [Dyad; 3] {
    std::array::from_fn(|i| {
        let [bx, by, dx, dy, k, n] = numbers[i].map(f64::from);
        let b = Vector2::new(bx, by);
        let joint = Vector2::new(f64::from(at[0]), f64::from(at[1])) - b;
        let d = if (dx, dy) == (0.0, 0.0) { Vector2::new(1.0, 2.0) } else { Vector2::new(dx, dy) };
        match names[i] {
            // A 3-4-5 triangle in one of its positions.
            "RR" => {
                let way = if n > 0.0 { Vector2::new(3.0, 4.0) } else { Vector2::new(-4.0, 3.0) };
                Dyad::RR { a: joint + way * k, b, length: 5.0 * k.abs() }
            }
            "PR" => Dyad::PR { a: joint + d * k, u: d, b },
            // (R i v)·(a - joint) with R = -1.
            "RP" => {
                let a = joint + Vector2::new(n, k);
                let delta = Vector2::new(d.y, -d.x).dot(&Vector2::new(n, k));
                Dyad::RP { a, b, v: d, offset: Offset::TimesDirection(delta) }
            }
            _ => Dyad::PP { phi: std::f64::consts::PI },
        }
    })
}

#[test]
fn a_half_turn_is_an_ordinary_pose() {
    for names in &TRIADS[..16] {
        let strategy = ([-6i32..=6, -6i32..=6], prop::array::uniform3(prop::array::uniform6(-5i32..=5)));
        let outcome = TestRunner::new(cases(200)).run(&strategy, |(at, numbers)| {
            let triad = Triad::new(half_turned(*names, at, numbers)).expect("integers are finite");
            let answer = triad.assemble();
            sound(&triad, &answer)?;
            let pose = Pose::new(f64::from(at[0]), f64::from(at[1]), std::f64::consts::PI);
            let given = names.contains(&"PP");
            let moves = |phi: Option<f64>| phi.is_none_or(|phi| phi == pose.phi);
            if answer.self_motions.iter().any(|m| moves(m.phi)) {
                return Ok(());
            }
            prop_assert!(miss(&answer, &pose) < 1e-14, "{answer:?}");
            if !given {
                prop_assert!(answer.modes.iter().any(|m| m.pose.phi == pose.phi), "exactly pi: {answer:?}");
            }
            Ok(())
        });
        if let Err(failure) = outcome {
            panic!("{}: {failure}", names.join("-"));
        }
    }
}

#[test]
fn small_integers_are_decided_whatever_they_are() {
    for names in TRIADS {
        let strategy = prop::array::uniform3(prop::array::uniform7(-2i32..=2));
        let outcome = TestRunner::new(cases(400)).run(&strategy, |numbers| {
            let legs = std::array::from_fn(|i| integer_leg(names[i], numbers[i]));
            let triad = Triad::new(legs).expect("integers are finite");
            let answer = triad.assemble();
            sound(&triad, &answer)?;
            let account = answer.account;
            let plain = account.rejected + account.self_motion + account.at_infinity == 0 && account.degree > 0;
            let shared = |special| answer.special.contains(&special);
            if plain
                && !names.contains(&"PP")
                && ![assur::Special::TwinPoses, assur::Special::ZeroLength].into_iter().any(shared)
                && !shared(assur::Special::ParallelSliders)
            {
                let twins = answer.complex.iter().filter(|m| (m.theta.norm() - 1.0).abs() < 1e-12);
                let twins = twins.map(|m| m.multiplicity).sum::<usize>();
                prop_assert_eq!(Some(account.real + twins), real_orientations(&legs), "{:?}", answer);
            }
            Ok(())
        });
        if let Err(failure) = outcome {
            panic!("{}: {failure}", names.join("-"));
        }
    }
}

fn integer_leg(name: &str, numbers: [i32; 7]) -> Dyad {
    let [ax, ay, bx, by, dx, dy, q] = numbers.map(f64::from);
    let (a, b) = (Vector2::new(ax, ay), Vector2::new(bx, by));
    let d = if (dx, dy) == (0.0, 0.0) { Vector2::y() } else { Vector2::new(dx, dy) };
    match name {
        "RR" => Dyad::RR { a, b, length: q.abs() },
        "PR" => Dyad::PR { a, u: d, b },
        "RP" => Dyad::RP { a, b, v: d, offset: Offset::TimesDirection(q) },
        _ => Dyad::PP { phi: 0.5 * q },
    }
}

#[test]
fn close_pairs_are_counted_right() {
    // Legs along lines through one point are singular; one length is then off by as little as 2⁻⁵⁰.
    let strategy =
        (prop::array::uniform3((-8i32..=8, -8i32..=8, 1i32..=4)), [-8i32..=8, -8i32..=8], 20i32..=50, prop::bool::ANY);
    let outcome = TestRunner::new(cases(400)).run(&strategy, |(joints, [cx, cy], bits, longer)| {
        let centre = Vector2::new(f64::from(cx), f64::from(cy));
        let mut legs = joints.map(|(x, y, k)| {
            let b = Vector2::new(f64::from(x), f64::from(y));
            let a = b + (centre - b) * (f64::from(k) / 2.0);
            Dyad::RR { a, b, length: (b - a).norm() }
        });
        if let Dyad::RR { length, .. } = &mut legs[0] {
            let off = 2f64.powi(-bits);
            *length *= if longer { 1.0 + off } else { 1.0 - off };
        }
        let triad = Triad::new(legs).expect("numbers are finite");
        let answer = triad.assemble();
        sound(&triad, &answer)?;
        let account = answer.account;
        if account.rejected + account.self_motion + account.at_infinity == 0 && account.degree > 0 {
            let plain =
                !answer.special.iter().any(|s| matches!(s, assur::Special::TwinPoses | assur::Special::ZeroLength));
            if plain {
                prop_assert_eq!(Some(account.real), real_orientations(&legs), "{:?}", answer);
            }
        }
        Ok(())
    });
    if let Err(failure) = outcome {
        panic!("{failure}");
    }
}

/// Sizes from the smallest number to near the largest.
fn any_size() -> impl Strategy<Value = f64> {
    prop_oneof![
        1 => Just(0.0),
        1 => Just(5e-324),
        1 => Just(f64::MIN_POSITIVE),
        1 => Just(1e308),
        3 => (-1.0..1.0, -150i32..=150).prop_map(|(m, e)| m * 10f64.powi(e)),
        3 => -4.0..4.0,
    ]
}

/// Sizes far apart but not absurdly so.
fn uneven_size() -> impl Strategy<Value = f64> {
    prop_oneof![
        1 => Just(0.0),
        2 => (-1.0..1.0, -6i32..=6).prop_map(|(m, e)| m * 10f64.powi(e)),
        1 => -4.0..4.0,
    ]
}

/// Whatever the numbers are, the account adds up and nothing that is listed is NaN.
fn accounted_for(names: [&str; 3], numbers: [[f64; 7]; 3]) -> Result<Status, TestCaseError> {
    let legs = std::array::from_fn(|i| {
        let [ax, ay, bx, by, dx, dy, q] = numbers[i];
        let (a, b) = (Vector2::new(ax, ay), Vector2::new(bx, by));
        let d = if (dx, dy) == (0.0, 0.0) { Vector2::y() } else { Vector2::new(dx, dy) };
        match names[i] {
            "RR" => Dyad::RR { a, b, length: q.abs() },
            "PR" => Dyad::PR { a, u: d, b },
            "RP" => Dyad::RP { a, b, v: d, offset: Offset::Distance(q) },
            _ => Dyad::PP { phi: q },
        }
    });
    let answer = Triad::new(legs).expect("numbers are finite").assemble();
    prop_assert!(answer.account.adds_up());
    prop_assert_eq!(answer.account.undecided > 0, answer.status == Status::Undecided);
    for mode in &answer.modes {
        let p = mode.pose;
        prop_assert!(p.x.is_finite() && p.y.is_finite() && p.phi.abs() <= std::f64::consts::PI);
        prop_assert!(mode.residual < 1e-9 && mode.det_a.is_finite(), "{mode:?}");
    }
    prop_assert!(answer.complex.iter().all(|m| m.theta.is_finite() && m.z.is_finite() && m.w.is_finite()));
    Ok(answer.status)
}

#[test]
fn numbers_of_any_size_lead_to_an_account_that_adds_up() {
    // Triads of degree six with such numbers take seconds, until the limit on digits ends them as undecided.
    for names in TRIADS.iter().filter(|names| names.contains(&"PP") || names.iter().all(|name| *name == names[0])) {
        if names.contains(&"RR") && !names.contains(&"PP") {
            continue;
        }
        let strategy = prop::array::uniform3(prop::array::uniform7(any_size()));
        let outcome = TestRunner::new(cases(10)).run(&strategy, |numbers| accounted_for(*names, numbers).map(|_| ()));
        if let Err(failure) = outcome {
            panic!("{}: {failure}", names.join("-"));
        }
    }
}

#[test]
fn lengths_a_million_times_apart_are_accounted_for() {
    let (mut asked, mut undecided) = (0, 0);
    for names in TRIADS {
        let strategy = prop::array::uniform3(prop::array::uniform7(uneven_size()));
        let tally = std::cell::Cell::new((0, 0));
        let outcome = TestRunner::new(cases(50)).run(&strategy, |numbers| {
            let status = accounted_for(names, numbers)?;
            let (asked, undecided) = tally.get();
            tally.set((asked + 1, undecided + usize::from(status == Status::Undecided)));
            Ok(())
        });
        if let Err(failure) = outcome {
            panic!("{}: {failure}", names.join("-"));
        }
        (asked, undecided) = (asked + tally.get().0, undecided + tally.get().1);
    }
    println!("{undecided} of {asked} undecided");
    assert!(undecided * 50 < asked, "{undecided} of {asked} undecided");
}

#[test]
fn uniformly_tiny_and_huge_triads_are_as_good_as_others() {
    for scale in [1e-150, 1e-60, 1e60, 1e150] {
        for names in &TRIADS[..10] {
            let mut random = super::planted::Random::new(super::SEED);
            for _ in 0..10 {
                let (triad, pose) = super::planted::planted_triad(*names, &mut random);
                let scaled = triad.legs().map(|leg| match leg {
                    Dyad::RR { a, b, length } => Dyad::RR { a: a * scale, b: b * scale, length: length * scale },
                    Dyad::PR { a, u, b } => Dyad::PR { a: a * scale, u, b: b * scale },
                    Dyad::RP { a, b, v, offset } => {
                        let offset = match offset {
                            Offset::Distance(d) => Offset::Distance(d * scale),
                            Offset::TimesDirection(d) => Offset::TimesDirection(d * scale),
                        };
                        Dyad::RP { a: a * scale, b: b * scale, v, offset }
                    }
                    pp => pp,
                });
                let answer = Triad::new(scaled).expect("numbers are finite").assemble();
                assert_eq!(answer.status, Status::Complete);
                assert_eq!(answer.modes.len(), triad.assemble().modes.len());
                let off = miss(&answer, &Pose::new(pose.x * scale, pose.y * scale, pose.phi));
                assert!(off < 1e-9, "{} at {scale:e}: {off:e}", triad.name());
            }
        }
    }
}
