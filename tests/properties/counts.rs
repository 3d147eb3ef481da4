//! Second opinions on the number of modes: Sturm's sequence, and Newton's method from many starts.

use assur::nalgebra::{Matrix3, Vector3};
use assur::{Dyad, Offset, Pose, Triad};
use proptest::prelude::*;

use super::cases;
use super::closure::real_error;
use super::planted::{Random, TRIADS, miss, planted_leg, planted_triad};
use super::sturm::{real_orientations, real_roots};
use super::{leg_numbers, pose};
use assur::algebra::{Integer, UPoly};

#[test]
fn the_counter_counts() {
    let p = |c: &[i64]| UPoly::new(c.iter().map(|&c| Integer::from(c)).collect::<Vec<_>>());
    assert_eq!(real_roots(&p(&[-2, 0, 1])), 2);
    assert_eq!(real_roots(&p(&[2, 0, 1])), 0);
    assert_eq!(real_roots(&p(&[-2, 0, -1])), 0);
    assert_eq!(real_roots(&p(&[1, -2, 1])), 2);
    // -(x - 1)³ (x + 2) (x² + 1)
    let cube = p(&[-1, 1]) * p(&[-1, 1]) * p(&[-1, 1]) * p(&[-2, -1]) * p(&[1, 0, 1]);
    assert_eq!(real_roots(&cube), 4);
    assert_eq!(real_roots(&p(&[7])), 0);
}

/// The RP offset as `delta`, so that both sides take the same number exactly.
fn dyadic_offsets(legs: [Dyad; 3]) -> [Dyad; 3] {
    legs.map(|leg| match leg {
        Dyad::RP { a, b, v, offset: Offset::Distance(d) } => {
            Dyad::RP { a, b, v, offset: Offset::TimesDirection(d * v.norm()) }
        }
        other => other,
    })
}

#[test]
fn as_many_modes_as_sturm_counts() {
    for names in &TRIADS[..10] {
        let mut runner = proptest::test_runner::TestRunner::new(cases(200));
        let strategy = (pose(), prop::array::uniform3(leg_numbers()), 0.8..1.25);
        let outcome = runner.run(&strategy, |(pose, numbers, stretch)| {
            let mut legs = dyadic_offsets(std::array::from_fn(|i| planted_leg(names[i], &pose, numbers[i])));
            // Away from the planted pose, so that other counts come up too.
            if let Dyad::RR { length, .. } = &mut legs[0] {
                *length *= stretch;
            }
            let answer = Triad::new(legs).expect("planted numbers are finite").assemble();
            let account = answer.account;
            // Where roots of T carry no pose or a curve of them, T alone does not tell the number of modes.
            if account.rejected + account.self_motion == 0 && account.degree > 0 && answer.special.is_empty() {
                prop_assert_eq!(Some(account.real), real_orientations(&legs), "{:?}", answer);
            }
            Ok(())
        });
        if let Err(failure) = outcome {
            panic!("{}: {failure}", names.join("-"));
        }
    }
}

/// One signed closure error per leg.
fn errors(legs: &[Dyad; 3], at: &Vector3<f64>) -> Vector3<f64> {
    let (sin, cos) = at.z.sin_cos();
    let turned =
        |p: &assur::nalgebra::Vector2<f64>| assur::nalgebra::Vector2::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y);
    Vector3::from(legs.map(|leg| match leg {
        Dyad::RR { a, b, length } => ((at.xy() + turned(&b) - a).norm_squared() - length * length) / 10.0,
        Dyad::PR { a, u, b } => u.normalize().perp(&(at.xy() + turned(&b) - a)),
        Dyad::RP { a, b, v, offset } => {
            let d = match offset {
                Offset::Distance(d) => d,
                Offset::TimesDirection(delta) => delta / v.norm(),
            };
            turned(&v.normalize()).perp(&(a - at.xy() - turned(&b))) - d
        }
        Dyad::PP { phi } => 10.0 * (at.z - phi).sin(),
    }))
}

/// Newton's method with differences for slopes; the pose it settles on.
fn newton(legs: &[Dyad; 3], start: Vector3<f64>) -> Option<Pose> {
    let mut at = start;
    for _ in 0..60 {
        let here = errors(legs, &at);
        let slopes = Matrix3::from_columns(&[0, 1, 2].map(|k: usize| {
            let mut step = Vector3::zeros();
            step[k] = 1e-6;
            (errors(legs, &(at + step)) - errors(legs, &(at - step))) / 2e-6
        }));
        let step = slopes.lu().solve(&here)?;
        at -= step * (3.0 / step.norm()).min(1.0);
        if step.norm() < 1e-12 {
            return Some(Pose::new(at.x, at.y, at.z));
        }
    }
    None
}

#[test]
fn newton_from_many_starts_finds_no_mode_that_is_not_listed() {
    let mut random = Random::new(super::SEED);
    let (mut settled, mut reached, mut listed) = (0, 0, 0);
    for names in &TRIADS[..16] {
        for _ in 0..4 {
            let (triad, _) = planted_triad(*names, &mut random);
            let answer = triad.assemble();
            let mut seen = vec![false; answer.modes.len()];
            for _ in 0..150 {
                let range = [25.0, 25.0, 3.2];
                let start = Vector3::from(range.map(|r| random.between(-r, r)));
                let Some(pose) = newton(triad.legs(), start) else { continue };
                // With PP, sin(phi - phi0) = 0 half a turn away as well.
                let turned_over = real_error(triad.legs(), &pose, 1.0) > 1e-6;
                if turned_over || pose.x.hypot(pose.y) > 1e6 {
                    continue;
                }
                settled += 1;
                let off = miss(&answer, &pose);
                assert!(off < 1e-6, "{} has a mode {pose:?} that is not listed: {answer:?}", triad.name());
                for (seen, mode) in seen.iter_mut().zip(&answer.modes) {
                    *seen |= (mode.pose.x - pose.x).hypot(mode.pose.y - pose.y) < 1e-6;
                }
            }
            listed += seen.len();
            reached += seen.iter().filter(|&&s| s).count();
        }
    }
    println!("{settled} starts settled on {reached} of {listed} modes");
    assert!(settled > 1000 && reached * 10 > listed * 7, "the second opinion has gone blind");
}
