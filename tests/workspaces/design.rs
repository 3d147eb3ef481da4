//! Stacks against their slices, searches against known tops, voids of strokes.

use assur::plane::PhiRange;
use assur::workspace::{DesignChoice, StrokeVoid, WorkspaceKind, WorkspaceModes};
use assur::{DesignKey, Leg, Manipulator};

use crate::models::{golden, golden_manipulator};

#[test]
fn a_stack_has_the_volume_of_its_slices() {
    // One leg's ring at every orientation: the volume is its area times the range.
    let leg = |x: f64| Leg { limits: [None, Some([1.0, 3.0]), None], ..Leg::rpr([x, 0.0], [0.0, 0.0]) };
    let robot = Manipulator::new("", vec![leg(0.0), leg(0.0), leg(0.0)]).expect("is sound");
    let stack = robot.workspace_stack(PhiRange::between(0.3, 1.3), 5, &WorkspaceModes::Both).expect("is covered");
    let ring = 8.0 * std::f64::consts::PI;
    assert!((stack.volume - ring).abs() < 1e-9 * ring, "{}", stack.volume);
    assert_eq!(stack.slices.len(), 5);
    let phis = stack.slices.iter().map(|slice| match slice.kind {
        WorkspaceKind::Constant { phi } => phi,
        _ => f64::NAN,
    });
    assert!(phis.zip([0.3, 0.55, 0.8, 1.05, 1.3]).all(|(found, expected)| (found - expected).abs() < 1e-15));
    // A general one: against many slices by the rule of the middle.
    let data = golden();
    let robot = golden_manipulator(&data, "M1A");
    let range = PhiRange::between(4.0, 4.5);
    let stack = robot.workspace_stack(range, 3, &WorkspaceModes::Both).expect("is covered");
    let reach = robot.reach(&WorkspaceModes::Both).expect("is covered");
    let count = 2000;
    let step = 0.5 / f64::from(count);
    let sum: f64 = (0..count)
        .map(|k| {
            reach
                .workspace(&WorkspaceKind::Constant { phi: 4.0 + step * (f64::from(k) + 0.5) })
                .expect("is covered")
                .region
                .area
        })
        .sum();
    assert!((stack.volume - sum * step).abs() < 1e-5 * stack.volume, "{} and {}", stack.volume, sum * step);
    assert!(stack.volume_error < 1e-6 * stack.volume, "{}", stack.volume_error);
}

#[test]
fn a_search_finds_the_top_of_a_known_hill() {
    // Two equal discs about bases 4 apart and a third whose base may move along x: the lens they share is largest midway.
    let leg = |x: f64| Leg { limits: [None, Some([0.0, 3.0]), None], ..Leg::rpr([x, 0.0], [0.0, 0.0]) };
    let robot = Manipulator::new("", vec![leg(0.0), leg(4.0), leg(-1.0)]).expect("is sound");
    let numbers = "leg3.base.at.x".parse::<DesignKey>().expect("a name").numbers(&robot).expect("is there");
    let choice = DesignChoice { numbers, bounds: [-3.0, 7.0] };
    let kind = WorkspaceKind::Constant { phi: 0.0 };
    let best = robot.optimise_area(&kind, &WorkspaceModes::Both, std::slice::from_ref(&choice)).expect("is covered");
    // The lens of the first two lies inside the third's disc for a range of places; any of them is a top.
    let lens = 2.0 * (9.0 * (2.0f64 / 3.0).acos() - 2.0 * 5f64.sqrt());
    assert!((best.area - lens).abs() < 1e-9, "{best:?}");
    assert!(best.area_before < best.area && best.gradient[0].abs() < 1e-9);
    // With the second base free too, all three coincide.
    let numbers = "leg2.base.at.x".parse::<DesignKey>().expect("a name").numbers(&robot).expect("is there");
    let second = DesignChoice { numbers, bounds: [-2.0, 6.0] };
    let best = robot.optimise_area(&kind, &WorkspaceModes::Both, &[choice, second]).expect("is covered");
    assert!((best.area - 9.0 * std::f64::consts::PI).abs() < 1e-3, "{best:?}");
}

#[test]
fn strokes_shorter_than_two_links_leave_a_lens() {
    let data = golden();
    let robot = golden_manipulator(&data, "PRR_lens");
    let voids = robot.stroke_voids();
    let Some(StrokeVoid::Lens { tips, area }) = voids[0] else { panic!("{voids:?}") };
    assert!(tips.iter().all(|tip| tip[0].abs() < 1e-12), "{tips:?}");
    assert!(area > 0.0 && area < 0.1);
    assert_eq!(voids[1], Some(StrokeVoid::None));
    assert_eq!(golden_manipulator(&data, "M1A").stroke_voids(), [None; 3]);
    // One leg's own region at a fixed orientation has the hole of this area.
    let reach = robot.reach(&WorkspaceModes::Both).expect("is covered");
    let own = reach.only(0).workspace(&WorkspaceKind::Constant { phi: 0.4 }).expect("is covered").region;
    let hole: f64 = own.loops.iter().map(|one| one.area).filter(|area| *area < 0.0).sum();
    assert!((hole + area).abs() < 1e-12, "{hole} {area}");
}
