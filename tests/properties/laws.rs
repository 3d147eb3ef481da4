//! What moving, scaling, mirroring, relabelling and inverting a triad does to its modes.

use assur::nalgebra::Vector2;
use assur::{Assemblies, AssemblyMode, Dyad, Offset, Pose, Triad};
use proptest::prelude::*;

use super::closure::determinant;
use super::planted::{TRIADS, turn};
use super::{cases, leg_numbers};

/// Rounded to multiples of 2⁻²⁰, so that shifts by 2²⁰ are exact.
fn grid(x: f64) -> f64 {
    (x * 1_048_576.0).round() / 1_048_576.0
}

/// Legs on the grid, not planted: as often as not without a real mode.
fn legs(names: [&str; 3], numbers: [[f64; 7]; 3]) -> [Dyad; 3] {
    std::array::from_fn(|i| {
        let [ax, ay, bx, by, dx, dy, q] = numbers[i].map(grid);
        let (a, b) = (Vector2::new(ax, ay), Vector2::new(bx, by));
        let d = if (dx, dy) == (0.0, 0.0) { Vector2::x() } else { Vector2::new(dx, dy) };
        match names[i] {
            "RR" => Dyad::RR { a, b, length: q.abs() },
            "PR" => Dyad::PR { a, u: d, b },
            "RP" => Dyad::RP { a, b, v: d, offset: Offset::TimesDirection(q) },
            _ => Dyad::PP { phi: q },
        }
    })
}

fn assemble(legs: [Dyad; 3]) -> Assemblies {
    Triad::new(legs).expect("numbers are finite").assemble()
}

/// The same modes, each moved by `motion`, to `rounding` of the size (and one turn).
fn moved(
    before: &Assemblies,
    after: &Assemblies,
    rounding: f64,
    motion: impl Fn(&Pose) -> Pose,
) -> Result<(), TestCaseError> {
    let key = |a: &Assemblies| (a.status, a.account, a.special.clone(), a.modes.len(), a.complex.len());
    prop_assert_eq!(key(before), key(after));
    let off = |p: &Pose, mode: &AssemblyMode| {
        let size = after.size.max(p.x.hypot(p.y)).max(f64::MIN_POSITIVE);
        turn(p.phi, mode.pose.phi).max((p.x - mode.pose.x).hypot(p.y - mode.pose.y) / size)
    };
    let mut left: Vec<&AssemblyMode> = after.modes.iter().collect();
    for mode in &before.modes {
        let expected = motion(&mode.pose);
        let nearest = (0..left.len()).min_by(|&i, &j| off(&expected, left[i]).total_cmp(&off(&expected, left[j])));
        let found = left.swap_remove(nearest.expect("equally many modes"));
        let error = off(&expected, found);
        prop_assert!(error <= rounding, "{expected:?} became {found:?}, off by {error:e}");
        prop_assert_eq!(mode.multiplicity, found.multiplicity);
    }
    Ok(())
}

/// Runs a law over the twenty triads.
fn for_all(count: u32, law: impl Fn([Dyad; 3]) -> Result<(), TestCaseError>) {
    for names in TRIADS {
        let mut runner = proptest::test_runner::TestRunner::new(cases(count));
        let outcome = runner.run(&prop::array::uniform3(leg_numbers()), |numbers| law(legs(names, numbers)));
        if let Err(failure) = outcome {
            panic!("{}: {failure}", names.join("-"));
        }
    }
}

/// A few units in the last place: both poses are rounded from many more digits.
const ROUNDING: f64 = 4e-15;

fn map_points(
    leg: Dyad,
    base: impl Fn(Vector2<f64>) -> Vector2<f64>,
    platform: impl Fn(Vector2<f64>) -> Vector2<f64>,
) -> Dyad {
    match leg {
        Dyad::RR { a, b, length } => Dyad::RR { a: base(a), b: platform(b), length },
        Dyad::PR { a, u, b } => Dyad::PR { a: base(a), u, b: platform(b) },
        Dyad::RP { a, b, v, offset } => Dyad::RP { a: base(a), b: platform(b), v, offset },
        pp => pp,
    }
}

#[test]
fn relabelling_legs_permutes_modes() {
    for_all(30, |legs| {
        let before = assemble(legs);
        for (order, parity) in [([1, 0, 2], -1.0), ([2, 0, 1], 1.0), ([0, 2, 1], -1.0)] {
            let relabelled = order.map(|i: usize| legs[i]);
            let after = assemble(relabelled);
            moved(&before, &after, ROUNDING, |&pose| pose)?;
            for mode in &before.modes {
                // det A changes its sign with each exchange of legs.
                let expected = parity * determinant(&legs, &mode.pose, before.size);
                let near = |m: &&AssemblyMode| (m.det_a - expected).abs() < 1e-9 * (1.0 + expected.abs());
                prop_assert!(after.modes.iter().any(|m| near(&m)), "det A {expected} in {after:?}");
            }
        }
        Ok(())
    });
}

#[test]
fn scaling_by_powers_of_two_changes_nothing() {
    for_all(30, |legs| {
        let before = assemble(legs);
        for k in [1_048_576.0, 1.0 / 1_048_576.0] {
            let scaled = legs.map(|leg| match map_points(leg, |a| a * k, |b| b * k) {
                Dyad::RR { a, b, length } => Dyad::RR { a, b, length: length * k },
                Dyad::RP { a, b, v, offset: Offset::TimesDirection(delta) } => {
                    Dyad::RP { a, b, v, offset: Offset::TimesDirection(delta * k) }
                }
                other => other,
            });
            let after = assemble(scaled);
            prop_assert_eq!(before.size * k, after.size);
            // To the last bit.
            moved(&before, &after, 0.0, |p| Pose::new(p.x * k, p.y * k, p.phi))?;
        }
        Ok(())
    });
}

#[test]
fn directions_may_have_any_length() {
    for_all(15, |legs| {
        let before = assemble(legs);
        let stretched = legs.map(|leg| match leg {
            Dyad::PR { a, u, b } => Dyad::PR { a, u: u * -1024.0, b },
            Dyad::RP { a, b, v, offset: Offset::TimesDirection(delta) } => {
                Dyad::RP { a, b, v: v * 1024.0, offset: Offset::TimesDirection(delta * 1024.0) }
            }
            other => other,
        });
        moved(&before, &assemble(stretched), 0.0, |&pose| pose)
    });
}

#[test]
fn a_far_base_moves_the_poses_along() {
    let far = Vector2::new(1_048_576.0, -524_288.0);
    for_all(30, |legs| {
        let before = assemble(legs);
        let after = assemble(legs.map(|leg| map_points(leg, |a| a + far, |b| b)));
        moved(&before, &after, ROUNDING, |p| Pose::new(p.x + far.x, p.y + far.y, p.phi))?;
        let orientations = |a: &Assemblies| a.modes.iter().map(|m| m.pose.phi).collect::<Vec<_>>();
        prop_assert_eq!(orientations(&before), orientations(&after));
        Ok(())
    });
}

#[test]
fn a_quarter_turn_of_the_base_turns_the_poses() {
    let quarter = |p: Vector2<f64>| Vector2::new(-p.y, p.x);
    for_all(20, |legs| {
        // PP legs give an angle, which a quarter turn rounds.
        let turned = legs.map(|leg| match map_points(leg, quarter, |b| b) {
            Dyad::PR { a, u, b } => Dyad::PR { a, u: quarter(u), b },
            Dyad::PP { phi } => Dyad::PP { phi: phi + std::f64::consts::FRAC_PI_2 },
            other => other,
        });
        if legs.iter().any(|leg| matches!(leg, Dyad::PP { .. })) {
            return Ok(());
        }
        let quarter = std::f64::consts::FRAC_PI_2;
        moved(&assemble(legs), &assemble(turned), ROUNDING, |p| Pose::new(-p.y, p.x, p.phi + quarter))
    });
}

#[test]
fn moving_the_platform_frame_moves_its_origin() {
    let shift = Vector2::new(3.0, -5.0);
    for_all(20, |legs| {
        let after = assemble(legs.map(|leg| map_points(leg, |a| a, |b| b + shift)));
        moved(&assemble(legs), &after, 2.0 * ROUNDING, |p| {
            let origin = p.place(-shift);
            Pose::new(origin.x, origin.y, p.phi)
        })
    });
}

#[test]
fn the_mirror_image_has_mirrored_modes() {
    let mirror = |p: Vector2<f64>| Vector2::new(p.x, -p.y);
    for_all(20, |legs| {
        let mirrored = legs.map(|leg| match map_points(leg, mirror, mirror) {
            Dyad::PR { a, u, b } => Dyad::PR { a, u: mirror(u), b },
            // Left of the line becomes right of it.
            Dyad::RP { a, b, v, offset: Offset::TimesDirection(delta) } => {
                Dyad::RP { a, b, v: mirror(v), offset: Offset::TimesDirection(-delta) }
            }
            Dyad::PP { phi } => Dyad::PP { phi: -phi },
            other => other,
        });
        moved(&assemble(legs), &assemble(mirrored), ROUNDING, |p| Pose::new(p.x, -p.y, -p.phi))
    });
}

#[test]
fn seen_from_the_platform_pr_and_rp_change_places() {
    for_all(30, |legs| {
        // Sliders through their points: then both views have the same exact numbers.
        let legs = legs.map(|leg| match leg {
            Dyad::RP { a, b, v, .. } => Dyad::RP { a, b, v, offset: Offset::TimesDirection(0.0) },
            other => other,
        });
        let inverted = legs.map(|leg| match leg {
            Dyad::RR { a, b, length } => Dyad::RR { a: b, b: a, length },
            Dyad::PR { a, u, b } => Dyad::RP { a: b, b: a, v: u, offset: Offset::TimesDirection(0.0) },
            Dyad::RP { a, b, v, .. } => Dyad::PR { a: b, u: v, b: a },
            Dyad::PP { phi } => Dyad::PP { phi: -phi },
        });
        let (before, after) = (assemble(legs), assemble(inverted));
        let swap = |special: &assur::Special| match special {
            assur::Special::CollinearBase => assur::Special::CollinearPlatform,
            assur::Special::CollinearPlatform => assur::Special::CollinearBase,
            other => *other,
        };
        let mut seen = Assemblies { special: after.special.iter().map(swap).collect(), ..after };
        seen.special.sort_unstable();
        moved(&before, &seen, 4.0 * ROUNDING, |p| {
            let (sin, cos) = p.phi.sin_cos();
            Pose::new(-cos * p.x - sin * p.y, sin * p.x - cos * p.y, -p.phi)
        })
    });
}
