//! Every degenerate case of the theory, once, on small integers, with its name.

use assur::nalgebra::Vector2;
use assur::{Assemblies, Dyad, Offset, RejectionReason, Special, Status, Triad};

use super::triads::sound;

fn v([x, y]: [i32; 2]) -> Vector2<f64> {
    Vector2::new(f64::from(x), f64::from(y))
}

fn rr(a: [i32; 2], b: [i32; 2], length: i32) -> Dyad {
    Dyad::RR { a: v(a), b: v(b), length: f64::from(length) }
}

fn pr(a: [i32; 2], u: [i32; 2], b: [i32; 2]) -> Dyad {
    Dyad::PR { a: v(a), u: v(u), b: v(b) }
}

fn rp(a: [i32; 2], b: [i32; 2], direction: [i32; 2]) -> Dyad {
    Dyad::RP { a: v(a), b: v(b), v: v(direction), offset: Offset::Distance(0.0) }
}

fn pp() -> Dyad {
    Dyad::PP { phi: 0.0 }
}

fn assemble(legs: [Dyad; 3]) -> Assemblies {
    let triad = Triad::new(legs).expect("integers are finite");
    let answer = triad.assemble();
    if let Err(failure) = sound(&triad, &answer) {
        panic!("{failure}");
    }
    answer
}

fn finite(answer: &Assemblies) -> usize {
    answer.account.real + answer.account.complex
}

fn is(answer: &Assemblies, special: Special) -> bool {
    answer.special.contains(&special)
}

#[test]
fn coaxal_circles_give_twin_poses() {
    // At phi = 0 the platform's origin is on three circles through (0, 3) and (0, -3).
    let answer = assemble([rr([4, 0], [0, 0], 5), rr([-3, 2], [1, 2], 5), rr([2, -1], [2, -1], 3)]);
    assert!(is(&answer, Special::TwinPoses));
    assert_eq!((finite(&answer), answer.account.degree, answer.status), (6, 6, Status::Complete));
    for y in [3.0, -3.0] {
        let here = |m: &&assur::AssemblyMode| m.pose.phi == 0.0 && (m.pose.y - y).abs() < 1e-15 && m.multiplicity == 1;
        assert_eq!(answer.modes.iter().filter(here).count(), 1, "{answer:?}");
    }
}

#[test]
fn parallel_sliders_beside_a_circle_have_four_solutions() {
    let answer = assemble([rr([1, 0], [2, 1], 3), pr([0, 1], [1, 2], [3, -1]), pr([2, -1], [2, 4], [-1, 1])]);
    assert!(is(&answer, Special::ParallelSliders));
    assert_eq!((finite(&answer), answer.account.degree), (4, 4));
    let seen = assemble([rr([2, 1], [1, 0], 3), rp([3, -1], [0, 1], [1, 2]), rp([-1, 1], [2, -1], [2, 4])]);
    assert!(is(&seen, Special::ParallelSliders));
    assert_eq!(seen.account, answer.account);
}

#[test]
fn parallel_sliders_beside_a_crossed_one_lose_two() {
    let answer = assemble([pr([0, 1], [1, 2], [3, -1]), pr([2, -1], [1, 2], [-1, 1]), rp([4, 1], [0, 2], [1, 0])]);
    assert!(is(&answer, Special::ParallelSliders));
    assert_eq!((finite(&answer), answer.account.rejected + answer.account.at_infinity), (2, 2), "{answer:?}");
    assert!(answer.rejections.iter().all(|r| r.reason == RejectionReason::ParallelRows));
    let seen = assemble([rp([3, -1], [0, 1], [1, 2]), rp([-1, 1], [2, -1], [1, 2]), pr([0, 2], [1, 0], [4, 1])]);
    assert_eq!(seen.account, answer.account);
}

#[test]
fn three_parallel_sliders_fit_nowhere_or_slide() {
    let line = |a, b| pr(a, [1, 0], b);
    let none = assemble([line([0, 0], [0, 0]), line([0, 1], [3, 1]), line([0, 5], [1, -4])]);
    assert_eq!((none.status, none.account.degree, none.modes.len()), (Status::Complete, 0, 0));
    let slides = assemble([line([0, 0], [0, 0]), line([0, 1], [3, 1]), line([0, -4], [1, -4])]);
    assert_eq!(slides.status, Status::SelfMotion);
    assert!(slides.self_motions.iter().any(|m| m.phi == Some(0.0) && m.real), "{slides:?}");
    let seen = assemble([rp([0, 0], [0, 0], [1, 0]), rp([3, 1], [0, 1], [1, 0]), rp([1, -4], [0, -4], [1, 0])]);
    assert_eq!(seen.self_motions.len(), slides.self_motions.len());
}

#[test]
fn parallel_lines_in_a_given_orientation_fit_nowhere_or_slide() {
    for (other, curve) in [
        (pr([0, 1], [1, 0], [3, 1]), true),
        (pr([0, 1], [1, 0], [3, 2]), false),
        // A platform line that is parallel at phi = 0 only.
        (rp([3, 1], [5, 1], [1, 0]), true),
        (rp([3, 1], [5, 2], [1, 0]), false),
    ] {
        let answer = assemble([pr([0, 0], [1, 0], [0, 0]), other, pp()]);
        let expected = if curve { Status::SelfMotion } else { Status::Complete };
        assert_eq!((answer.status, answer.modes.len()), (expected, 0), "{answer:?}");
        let account = answer.account;
        assert_eq!((account.self_motion, account.at_infinity), if curve { (1, 0) } else { (0, 1) });
    }
}

#[test]
fn similar_platforms_lose_two() {
    // a = (1 + 2i) b, and collinear with a = 3 b.
    let turned = assemble([rr([0, 0], [0, 0], 3), rr([2, 4], [2, 0], 4), rr([-5, 5], [1, 3], 5)]);
    assert!(is(&turned, Special::SimilarPlatforms) && !is(&turned, Special::CongruentPlatforms));
    let line = assemble([rr([0, 0], [0, 0], 3), rr([3, 0], [1, 0], 4), rr([12, 0], [4, 0], 5)]);
    assert!(is(&line, Special::SimilarPlatforms) && is(&line, Special::CollinearBase));
    for answer in [turned, line] {
        assert_eq!((finite(&answer), answer.account.rejected), (4, 2));
        // Away from the circle the rows do not vanish but turn isotropic; the reason is the same.
        assert!(answer.rejections.iter().all(|r| r.reason == RejectionReason::SimilarPlatforms), "{answer:?}");
    }
}

#[test]
fn congruent_platforms_lose_a_double_root_or_turn_parallel() {
    let place = [[0, 0], [4, 0], [1, 3]];
    let turned = [[0, 0], [0, 4], [-3, 1]];
    let uneven: [Dyad; 3] = std::array::from_fn(|i| rr(turned[i], place[i], [2, 3, 4][i]));
    let answer = assemble(uneven);
    assert!(is(&answer, Special::CongruentPlatforms));
    assert_eq!((finite(&answer), answer.account.rejected, answer.status), (4, 2, Status::Complete));
    assert_eq!(answer.rejections[0].reason, RejectionReason::SimilarPlatforms);
    let even: [Dyad; 3] = std::array::from_fn(|i| rr(turned[i], place[i], 3));
    let answer = assemble(even);
    assert_eq!(answer.status, Status::SelfMotion);
    assert_eq!((answer.account.self_motion, finite(&answer)), (4, 2));
    let phi = answer.self_motions[0].phi.expect("one orientation");
    assert!((phi - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
}

#[test]
fn mirrored_and_collinear_platforms_are_generic() {
    let mirrored = assemble([rr([0, 0], [0, 0], 3), rr([4, 2], [2, -1], 4), rr([2, 6], [1, -3], 5)]);
    assert_eq!(finite(&mirrored), 6);
    assert!(!is(&mirrored, Special::SimilarPlatforms));
    let collinear = assemble([rr([0, 0], [0, 0], 3), rr([4, 0], [2, 0], 4), rr([6, 0], [5, 0], 5)]);
    assert!(is(&collinear, Special::CollinearBase) && is(&collinear, Special::CollinearPlatform));
    assert_eq!(finite(&collinear), 6);
}

#[test]
fn coincident_pivots_leave_four() {
    let base = assemble([rr([0, 0], [0, 0], 3), rr([0, 0], [2, -1], 4), rr([2, 6], [1, 3], 5)]);
    let platform = assemble([rr([0, 0], [0, 0], 3), rr([2, -1], [0, 0], 4), rr([1, 3], [2, 6], 5)]);
    for answer in [base, platform] {
        assert!(is(&answer, Special::CoincidentPivots));
        assert_eq!((finite(&answer), answer.account.at_infinity), (4, 2));
    }
}

#[test]
fn a_leg_given_twice_moves_and_one_of_two_lengths_breaks() {
    let twice = assemble([rr([0, 0], [0, 0], 3), rr([0, 0], [0, 0], 3), rr([5, 0], [2, 1], 4)]);
    assert_eq!((twice.status, twice.account.degree), (Status::SelfMotion, 0));
    assert_eq!(twice.self_motions[0].phi, None);
    let broken = assemble([rr([0, 0], [0, 0], 3), rr([0, 0], [0, 0], 4), rr([5, 0], [2, 1], 4)]);
    assert_eq!((broken.status, broken.modes.len()), (Status::Complete, 0));
}

#[test]
fn base_pivots_all_in_one_point_let_the_platform_turn_or_do_not_fit() {
    let star = |length| [rr([1, 1], [3, 4], 5), rr([1, 1], [-4, 3], 5), rr([1, 1], [5, 0], length)];
    let turns = assemble(star(5));
    assert_eq!((turns.status, turns.self_motions[0].phi), (Status::SelfMotion, None));
    let none = assemble(star(6));
    assert_eq!((none.status, none.modes.len()), (Status::Complete, 0));
}

#[test]
fn a_leg_of_length_zero_is_a_pin() {
    // Pinned at the origin; (4, 0) and (0, 3) of the platform each reach their circles at phi = 0.
    let fits = assemble([rr([0, 0], [0, 0], 0), rr([4, 2], [4, 0], 2), rr([1, 3], [0, 3], 1)]);
    assert!(is(&fits, Special::ZeroLength));
    let mode = fits.modes.iter().find(|m| m.pose.phi == 0.0).expect("the planted pose");
    assert_eq!((mode.multiplicity, mode.pose.x, mode.pose.y), (2, 0.0, 0.0));
    let misses = assemble([rr([0, 0], [0, 0], 0), rr([4, 2], [4, 0], 2), rr([1, 3], [0, 3], 2)]);
    assert_eq!((misses.modes.len(), misses.account.real), (0, 0));
    assert_eq!(finite(&misses) + misses.account.rejected, 6);
}

#[test]
fn parallel_legs_are_a_double_root() {
    // Three upright legs of lengths 1, 2, 4.
    let answer = assemble([rr([0, 0], [0, 1], 1), rr([4, 0], [4, 2], 2), rr([1, 2], [1, 6], 4)]);
    assert!(is(&answer, Special::DoubleRoot));
    let mode = answer.modes.iter().find(|m| m.pose.phi == 0.0).expect("the planted pose");
    assert_eq!(mode.multiplicity, 2);
    assert!(mode.det_a.abs() < 1e-15);
}
