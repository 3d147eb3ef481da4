//! A pose planted in each of the twenty triads is among the modes, and every root satisfies the closure equations.

use assur::{Assemblies, Dyad, Pose, Status, Triad};
use proptest::prelude::*;

use super::closure::{complex_error, determinant, real_error};
use super::planted::{TRIADS, miss, planted_leg, turn};
use super::{cases, leg_numbers, pose};

/// Below this a planted pose is close to singular, and rounding its lengths moves it by the square or cubic root of what they moved.
const NEARLY_SINGULAR: f64 = 1e-5;

/// Whether some complex solution is as near to the pose as two modes that have met and left the reals.
fn merged_away(answer: &Assemblies, pose: &Pose) -> bool {
    answer.complex.iter().any(|m| (m.theta.norm() - 1.0).abs() < 1e-4 && turn(m.theta.arg(), pose.phi) < 1e-4)
}

/// The laws of every answer: the account, the closure of every root, the partners of the complex ones, det A.
pub fn sound(triad: &Triad, answer: &Assemblies) -> Result<(), TestCaseError> {
    let account = answer.account;
    prop_assert!(account.adds_up(), "{account:?}");
    prop_assert_ne!(answer.status, Status::Undecided);
    prop_assert_eq!(account.undecided, 0);
    let vanishes = account.degree == 0;
    prop_assert!(vanishes || account.degree == triad.degree());
    prop_assert_eq!(account.real, answer.modes.iter().map(|m| m.multiplicity).sum::<usize>());
    prop_assert_eq!(account.complex, answer.complex.iter().map(|m| m.multiplicity).sum::<usize>());
    prop_assert_eq!(account.rejected, answer.rejections.iter().map(|m| m.multiplicity).sum::<usize>());
    prop_assert_eq!(answer.status == Status::SelfMotion, !answer.self_motions.is_empty());
    for mode in &answer.modes {
        let size = answer.size.max(mode.pose.x.hypot(mode.pose.y)).max(f64::MIN_POSITIVE);
        let error = real_error(triad.legs(), &mode.pose, size) / size;
        prop_assert!(error < 1e-14, "{:?} misses closure by {error:e}", mode);
        prop_assert!(mode.residual < 1e-14 * size / answer.size, "{mode:?}");
        let det_a = determinant(triad.legs(), &mode.pose, answer.size);
        prop_assert!((det_a - mode.det_a).abs() < 1e-9 * (1.0 + size / answer.size), "det A {det_a}, {mode:?}");
    }
    for mode in &answer.complex {
        let error = complex_error(triad.legs(), answer.size, mode.theta, mode.z, mode.w);
        prop_assert!(error < 1e-13, "{mode:?} misses closure by {error:e}");
        // Real equations: with (theta, z, w) also (1/conj theta, conj w, conj z).
        let partner = |other: &&assur::ComplexMode| {
            let size = answer.size.max(mode.z.norm()).max(mode.w.norm());
            other.multiplicity == mode.multiplicity
                && (other.theta.conj() * mode.theta - 1.0).norm() < 1e-9
                && (other.z - mode.w.conj()).norm().max((other.w - mode.z.conj()).norm()) < 1e-9 * size
        };
        prop_assert!(answer.complex.iter().any(|other| partner(&other)), "{mode:?} has no partner in {answer:?}");
    }
    Ok(())
}

fn planted_is_found(names: [&str; 3], pose: &Pose, numbers: [[f64; 7]; 3]) -> Result<(), TestCaseError> {
    let legs: [Dyad; 3] = std::array::from_fn(|i| planted_leg(names[i], pose, numbers[i]));
    let triad = Triad::new(legs).expect("planted numbers are finite");
    let answer = triad.assemble();
    sound(&triad, &answer)?;
    let translating = names.iter().filter(|name| **name == "PP").count();
    if translating > 1 {
        prop_assert_eq!(answer.status, Status::SelfMotion);
        prop_assert!(answer.modes.is_empty());
        let phi = answer.self_motions[0].phi.expect("the orientation is given");
        prop_assert!(turn(phi, pose.phi) < 1e-15);
        return Ok(());
    }
    let off = miss(&answer, pose);
    let moves = answer.self_motions.iter().any(|m| m.phi.is_none_or(|phi| turn(phi, pose.phi) < 1e-4));
    let regular = determinant(&legs, pose, answer.size.max(f64::MIN_POSITIVE)).abs();
    if off > 1e-9 && !moves {
        prop_assert!(regular < NEARLY_SINGULAR, "planted pose missed by {off:e} with det A {regular:e}: {answer:?}");
        prop_assert!(off < 1e-4 || merged_away(&answer, pose) || answer.account.at_infinity > 0, "{off:e}: {answer:?}");
    }
    Ok(())
}

#[test]
fn a_planted_pose_is_among_the_modes_of_each_triad() {
    for names in TRIADS {
        let config = cases(200);
        let mut runner = proptest::test_runner::TestRunner::new(config);
        let strategy = (pose(), prop::array::uniform3(leg_numbers()));
        let outcome = runner.run(&strategy, |(pose, numbers)| planted_is_found(names, &pose, numbers));
        if let Err(failure) = outcome {
            panic!("{}: {failure}", names.join("-"));
        }
    }
}

#[test]
fn given_orientations_that_differ_leave_no_assembly() {
    let pose = Pose::new(1.0, 2.0, 0.5);
    let leg = |kind| planted_leg(kind, &pose, [1.0, 2.0, -3.0, 0.5, 1.0, 2.0, 3.0]);
    for kind in ["RR", "PR", "RP"] {
        let triad = Triad::new([Dyad::PP { phi: 0.5 }, leg(kind), Dyad::PP { phi: 0.25 }]).unwrap();
        let answer = triad.assemble();
        assert_eq!((answer.status, answer.modes.len(), answer.account.degree), (Status::Complete, 0, 0));
    }
    let turns = Triad::new([0.5, 0.5, 0.5].map(|phi| Dyad::PP { phi })).unwrap().assemble();
    assert_eq!(turns.status, Status::SelfMotion);
}
