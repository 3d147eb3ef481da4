//! The fast route finds what the proved route finds: no mode lost, none invented.
//!
//! `ASSUR_TEST_SCALE=100 cargo test --release --test real_modes` runs the full million; seeds are fixed.

use assur::nalgebra::Vector2;
use assur::{Dyad, ModesBatch, ModesRoute, Offset, Pose, Status, Triad};
use rayon::prelude::*;

mod random;
use random::Random;

/// The ten triads without PP.
const NAMES: [&str; 10] = [
    "RR-RR-RR", "RR-RR-PR", "RR-RR-RP", "RR-PR-RP", "RR-PR-PR", "RR-RP-RP", "PR-PR-RP", "PR-RP-RP", "PR-PR-PR",
    "RP-RP-RP",
];

fn number(random: &mut Random) -> f64 {
    random.between(-1.0, 1.0)
}

fn point(random: &mut Random) -> Vector2<f64> {
    Vector2::new(number(random), number(random))
}

fn left(p: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-p.y, p.x)
}

fn turned(phi: f64, p: Vector2<f64>) -> Vector2<f64> {
    let (s, c) = phi.sin_cos();
    Vector2::new(c * p.x - s * p.y, s * p.x + c * p.y)
}

/// A leg that closes in a pose, its length or offset off by `miss`. Where a point is given, its force passes through it.
fn leg(kind: &str, random: &mut Random, pose: &Pose, through: Option<Vector2<f64>>, miss: f64) -> Dyad {
    let b = point(random);
    let joint = Vector2::new(pose.x, pose.y) + turned(pose.phi, b);
    let force = through.map_or_else(|| point(random), |p| p - joint);
    match kind {
        "RR" => {
            let a = joint + force * (1.0 + 0.5 * number(random));
            Dyad::RR { a, b, length: (joint - a).norm() + miss }
        }
        "PR" => {
            let u = left(force);
            Dyad::PR { a: joint + u * number(random) + force * (miss / force.norm()), u, b }
        }
        "RP" => {
            // The force passes through the base pivot, square to the platform line.
            let a = point(random);
            let force = through.map_or(force, |p| p - a);
            let normal = turned(-pose.phi, force);
            let v = -left(normal);
            let delta = force.dot(&(a - joint)) + miss * force.norm();
            Dyad::RP { a, b, v, offset: Offset::TimesDirection(delta) }
        }
        _ => unreachable!("a dyad without PP"),
    }
}

/// A triad that can be assembled in a random pose.
fn planted(name: &str, random: &mut Random) -> Triad {
    let pose = Pose::new(number(random), number(random), 3.2 * number(random));
    let mut kinds = name.split('-');
    Triad::new(std::array::from_fn(|_| leg(kinds.next().expect("three"), random, &pose, None, 0.0))).expect("finite")
}

/// A triad whose legs' forces meet in one point in some pose: two modes meet there, or part by about `apart`, or vanish.
fn nearly_singular(name: &str, random: &mut Random, apart: f64) -> Triad {
    let pose = Pose::new(number(random), number(random), 3.2 * number(random));
    let centre = point(random) * 2.0;
    let miss = apart * apart * number(random);
    let mut kinds = name.split('-');
    let mut next = |miss| leg(kinds.next().expect("three"), random, &pose, Some(centre), miss);
    Triad::new([next(0.0), next(0.0), next(miss)]).expect("finite")
}

/// What went wrong, if anything, and whether the fast route decided.
fn compare(triad: &Triad) -> Result<bool, String> {
    let Some(fast) = triad.real_modes_fast() else { return Ok(false) };
    let proved = triad.prove_exactly();
    if fast.status != Status::Complete || proved.status != Status::Complete || fast.modes().len() != proved.modes.len()
    {
        return Err(format!("{} modes against {} proved: {triad:?}", fast.modes().len(), proved.modes.len()));
    }
    for mode in fast.modes() {
        let inside = |value: f64, [lo, hi]: [f64; 2], slack: f64| lo - slack <= value && value <= hi + slack;
        let turn = std::f64::consts::TAU;
        let found = proved.modes.iter().filter(|p| {
            let [x, y, phi] = p.pose_box;
            // Nine digits of a place as far away as it is.
            let slack = 1e-9 * (1.0 + mode.pose.x.hypot(mode.pose.y));
            inside(mode.pose.x, x, slack)
                && inside(mode.pose.y, y, slack)
                && [0.0, turn, -turn].iter().any(|t| inside(mode.pose.phi + t, phi, 1e-9))
        });
        if found.count() != 1 || mode.multiplicity != 1 || mode.residual > 1e-13 || mode.det_a == 0.0 {
            return Err(format!("{mode:?} is in no box or two: {:?} {triad:?}", proved.modes));
        }
    }
    Ok(true)
}

fn scale() -> u64 {
    std::env::var("ASSUR_TEST_SCALE").ok().and_then(|s| s.parse().ok()).unwrap_or(1)
}

/// Compares `count` triads of each kind; returns how many the fast route decided, in all.
fn sweep(what: &str, count: u64, make: impl Fn(&str, &mut Random) -> Triad + Sync) -> (u64, u64) {
    let mut total = (0, 0);
    for (kind, name) in (0..).zip(NAMES) {
        let decided: Vec<Result<bool, String>> = (0..count)
            .into_par_iter()
            .map(|i| compare(&make(name, &mut Random::new((kind << 40) + i * 7919 + 1))))
            .collect();
        let wrong: Vec<&String> = decided.iter().filter_map(|r| r.as_ref().err()).collect();
        assert!(wrong.is_empty(), "{name}: {} of {count} wrong, first {}", wrong.len(), wrong[0]);
        let fast = decided.iter().filter(|r| **r == Ok(true)).count() as u64;
        println!("{what} {name}: {fast} of {count} decided fast, all alike");
        total = (total.0 + fast, total.1 + count);
    }
    total
}

#[test]
fn a_million_random_triads_lose_no_mode() {
    let (fast, all) = sweep("random", 1000 * scale(), planted);
    // A triad in a thousand may be too near a singularity.
    assert!(1000 * (all - fast) <= 3 * all, "{fast} of {all}");
}

#[test]
fn a_hundred_thousand_nearly_singular_triads_lose_no_mode() {
    let (fast, _) = sweep("nearly singular", 100 * scale(), |name, random| {
        let apart = 10f64.powf(-2.0 - 12.0 * (0.5 + 0.5 * number(random)));
        nearly_singular(name, random, apart)
    });
    // Wide ones are decided, meeting ones are not: both happen.
    assert!(fast > 0);
}

fn golden_six() -> [Dyad; 3] {
    let leg = |a: [f64; 2], b: [f64; 2], length| Dyad::RR { a: a.into(), b: b.into(), length };
    [
        leg([0.0, 0.0], [0.0, 0.0], 14.98),
        leg([15.91, 0.0], [17.045, 0.0], 15.38),
        leg([0.0, 10.0], [13.2389, 16.0929], 12.0),
    ]
}

#[test]
fn the_fast_route_agrees_with_the_reference_number_by_number() {
    let mut random = Random::new(77);
    for name in NAMES {
        for _ in 0..20 {
            let triad = planted(name, &mut random);
            let (fast, reference) = (triad.real_modes(), triad.real_modes_reference());
            assert_eq!(fast.modes().len(), reference.modes().len());
            if fast.route == ModesRoute::Reference {
                continue;
            }
            for (p, q) in fast.modes().iter().zip(reference.modes()) {
                let near = |x: f64, y: f64| (x - y).abs() <= 1e-9 * (1.0 + y.abs());
                assert!(near(p.pose.x, q.pose.x) && near(p.pose.y, q.pose.y), "{name} {p:?} {q:?}");
                assert!(near(p.pose.phi, q.pose.phi) && near(p.det_a, q.det_a), "{name} {p:?} {q:?}");
            }
        }
    }
}

#[test]
fn order_of_legs_size_and_a_far_origin_change_nothing() {
    let legs = golden_six();
    let base = Triad::new(legs).expect("finite").real_modes();
    assert_eq!((base.modes().len(), base.route), (6, ModesRoute::Fast));
    for order in [[0, 1, 2], [1, 0, 2], [2, 1, 0], [1, 2, 0], [2, 0, 1], [0, 2, 1]] {
        for size in [1.0, 1e-6, 1e6, 1e-60, 1e60] {
            for far in [0.0, 1e5] {
                let moved = |leg: Dyad| match leg {
                    Dyad::RR { a, b, length } => {
                        Dyad::RR { a: (a + Vector2::new(far, -far)) * size, b: b * size, length: length * size }
                    }
                    other => other,
                };
                let triad = Triad::new(order.map(|i: usize| moved(legs[i]))).expect("finite");
                let found = triad.real_modes();
                assert_eq!((found.modes().len(), found.route), (6, ModesRoute::Fast));
                for (p, q) in found.modes().iter().zip(base.modes()) {
                    assert!((p.pose.phi - q.pose.phi).abs() < 1e-10, "{p:?} {q:?}");
                    assert!((p.pose.x / size - far - q.pose.x).abs() < 1e-8, "{p:?} {q:?}");
                    assert!((p.pose.y / size + far - q.pose.y).abs() < 1e-8, "{p:?} {q:?}");
                }
            }
        }
    }
}

#[test]
fn what_the_fast_route_cannot_decide_the_reference_route_answers() {
    let [first, second, _] = golden_six();
    let at = |x, y| Vector2::new(x, y);
    // A leg of length zero, a PP leg, a platform congruent to the base (a curve of poses), numbers out of range.
    let mut random = Random::new(9);
    let pose = Pose::new(0.3, 0.2, 0.4);
    let pinned = [0, 1, 2].map(|_| leg("RR", &mut random, &pose, None, 0.0));
    let b = at(2.0, 1.0);
    let zero = Dyad::RR { a: pose.place(b), b, length: 0.0 };
    let congruent = [at(0.0, 0.0), at(4.0, 0.0), at(1.0, 3.0)].map(|a| Dyad::RR { a, b: a, length: 2.0 });
    let huge = golden_six().map(|leg| match leg {
        Dyad::RR { a, b, length } => Dyad::RR { a: a * 1e140, b: b * 1e140, length: length * 1e140 },
        other => other,
    });
    for (legs, status) in [
        ([pinned[0], zero, pinned[2]], Status::Complete),
        ([first, second, Dyad::PP { phi: 0.3 }], Status::Complete),
        (congruent, Status::SelfMotion),
        (huge, Status::Complete),
    ] {
        let triad = Triad::new(legs).expect("finite");
        assert_eq!(triad.real_modes_fast(), None);
        let found = triad.real_modes();
        assert_eq!((found.route, found.status), (ModesRoute::Reference, status));
        assert_eq!(found.modes().len(), triad.assemble().modes.len());
    }
}

#[test]
fn half_turns_and_right_angles_are_ordinary() {
    // Modes planted exactly at multiples of a right angle.
    for quarter in 0..4u32 {
        for name in NAMES {
            let phi = f64::from(quarter) * std::f64::consts::FRAC_PI_2;
            let mut random = Random::new(5 + u64::from(quarter));
            let pose = Pose::new(0.25, -0.5, phi);
            let mut kinds = name.split('-');
            let mut next = || leg(kinds.next().expect("three"), &mut random, &pose, None, 0.0);
            let triad = Triad::new([next(), next(), next()]).expect("finite");
            let found = triad.real_modes();
            assert_eq!(found.route, ModesRoute::Fast, "{name}");
            let apart = |p: f64| (p - phi).sin().abs() + (1.0 - (p - phi).cos());
            assert!(found.modes().iter().any(|m| apart(m.pose.phi) < 1e-9), "{name} {found:?}");
            assert_eq!(compare(&triad), Ok(true));
        }
    }
}

/// Triads of all kinds in any order, ordinary and nearly singular, some beyond the fast route.
fn mixed(count: u64) -> Vec<Triad> {
    let mut random = Random::new(2024);
    (0..count)
        .map(|i| {
            let name = NAMES[(i * i + i / 3) as usize % NAMES.len()];
            match i % 5 {
                0 => {
                    let apart = 10f64.powf(-2.0 - 12.0 * (0.5 + 0.5 * number(&mut random)));
                    nearly_singular(name, &mut random, apart)
                }
                1 => {
                    // An offset given as a distance, where there is one.
                    let legs = planted(name, &mut random).legs().map(|leg| match leg {
                        Dyad::RP { a, b, v, offset: Offset::TimesDirection(delta) } => {
                            Dyad::RP { a, b, v, offset: Offset::Distance(delta / v.norm()) }
                        }
                        other => other,
                    });
                    Triad::new(legs).expect("finite")
                }
                _ if i % 997 == 0 => {
                    let [first, second, _] = *planted(name, &mut random).legs();
                    Triad::new([first, second, Dyad::PP { phi: 0.3 }]).expect("finite")
                }
                _ => planted(name, &mut random),
            }
        })
        .collect()
}

/// What a batch says of a triad, to the last bit: poses, count, status.
type Answer = (Vec<u64>, u8, Option<Status>);

fn row(batch: &ModesBatch, k: usize) -> Answer {
    let bits = batch.poses()[18 * k..18 * (k + 1)].iter().map(|x| x.to_bits()).collect();
    (bits, batch.counts()[k], batch.statuses()[k])
}

/// The same of the triad alone.
fn alone(triad: &Triad) -> Answer {
    let found = triad.real_modes();
    let mut bits = vec![0u64; 18];
    for (place, mode) in bits.chunks_exact_mut(3).zip(found.modes()) {
        let Pose { x, y, phi } = mode.pose;
        place.copy_from_slice(&[x, y, phi].map(f64::to_bits));
    }
    (bits, found.modes().len() as u8, Some(found.status))
}

#[test]
fn groups_of_any_length_are_as_alone_and_so_are_numbers_out_of_range() {
    let mut random = Random::new(31);
    let mut six = |size: f64| {
        Triad::new(golden_six().map(|leg| match leg {
            Dyad::RR { a, b, length } => {
                let b = b + Vector2::new(number(&mut random), number(&mut random)) * 1e-4;
                Dyad::RR { a: a * size, b: b * size, length: length * size }
            }
            other => other,
        }))
        .expect("finite")
    };
    let mut all_six = true;
    // Around whole registers and blocks; six modes each fill a block's room for roots.
    for count in [0, 1, 3, 4, 5, 7, 8, 9, 31, 32, 33, 65] {
        let triads: Vec<Triad> = (0..count).map(|_| six(1.0)).collect();
        let batch = Triad::real_modes_batch(&triads);
        assert_eq!(batch.len(), count);
        for (k, triad) in triads.iter().enumerate() {
            assert_eq!(row(&batch, k), alone(triad), "{k} of {count}");
            all_six &= batch.counts()[k] == 6;
        }
    }
    assert!(all_six);
    // Beside ordinary ones: sizes inside and outside of the range, a length of zero, a direction near zero, a huge offset.
    let at = |x, y| Vector2::new(x, y);
    let strange = [
        Dyad::RR { a: at(1.0, 2.0), b: at(0.5, 0.25), length: 0.0 },
        Dyad::PR { a: at(1.0, 2.0), u: at(1e-200, 2e-200), b: at(0.5, 0.25) },
        Dyad::RP { a: at(1.0, 2.0), b: at(0.5, 0.25), v: at(1.0, 0.5), offset: Offset::Distance(1e150) },
    ];
    let triads: Vec<Triad> = (0..60)
        .map(|k| match k % 6 {
            0..3 => six([1e-140, 1e-60, 1e60, 1e140, 1.0][k % 5]),
            other => {
                let [_, second, third] = *six(1.0).legs();
                Triad::new([strange[other - 3], second, third]).expect("finite")
            }
        })
        .collect();
    let batch = Triad::real_modes_batch(&triads);
    let fast = triads.iter().filter(|triad| triad.real_modes_fast().is_some()).count();
    assert!(0 < fast && fast < triads.len(), "{fast}");
    triads.iter().enumerate().for_each(|(k, triad)| assert_eq!(row(&batch, k), alone(triad), "{k}: {triad:?}"));
}

#[test]
fn a_batch_has_the_bits_of_each_triad_alone_whatever_its_company() {
    let triads = mixed(2_000 * scale());
    let batch = Triad::real_modes_batch(&triads);
    // Cut anywhere, and backwards: other neighbours, other places in a block.
    let cut = triads.len() / 2 + 77;
    let halves = [Triad::real_modes_batch(&triads[..cut]), Triad::real_modes_batch(&triads[cut..])];
    let turned: Vec<Triad> = triads.iter().rev().copied().collect();
    let turned = Triad::real_modes_batch(&turned);
    let wrong: Vec<usize> = (0..triads.len())
        .into_par_iter()
        .filter(|&k| {
            let own = alone(&triads[k]);
            let half = if k < cut { row(&halves[0], k) } else { row(&halves[1], k - cut) };
            [row(&batch, k), half, row(&turned, triads.len() - 1 - k)].iter().any(|found| *found != own)
        })
        .collect();
    assert!(wrong.is_empty(), "{} of {} differ, first {:?}", wrong.len(), triads.len(), triads[wrong[0]]);
    let fast = triads.iter().filter(|triad| triad.real_modes_fast().is_some()).count();
    assert!(fast > triads.len() / 2 && fast < triads.len(), "{fast} of {}", triads.len());
}
