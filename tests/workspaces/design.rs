//! How workspaces change with the design: gradients against differences, stacks against their slices, searches against known tops.

use assur::plane::PhiRange;
use assur::workspace::{DesignChoice, StrokeVoid, WorkspaceKind, WorkspaceModes};
use assur::{DesignKey, DesignNumber, Leg, Manipulator};

use crate::membership::{kind_of, modes_of, written};
use crate::models::{Case, TROUBLES, Trouble, golden, golden_manipulator, questions, random_case, scale};
use crate::oracle::Oracle;

/// Numbers of a design that every leg type has, and those of its limits.
const KEYS: [&str; 10] = [
    "leg1.base.at.x",
    "leg2.base.angle",
    "leg3.platform.at.y",
    "reference.x",
    "leg1.links1.at.x",
    "leg2.links2.at.y",
    "leg3.links2.at.x",
    "leg1.limits.max",
    "leg2.limits.min",
    "leg3.platform.angle",
];

fn area(case: &Case, kind: &WorkspaceKind, number: DesignNumber, value: f64) -> Option<f64> {
    let mut robot = case.robot.clone();
    robot.set_design_number(number, value).ok()?;
    Some(robot.workspace(kind, &modes_of(case)).ok()?.region.area)
}

fn compare(kinds: std::ops::Range<usize>, cases: u64) {
    let (mut asked, mut kinks) = (0, 0);
    for number in 0..cases * scale() {
        let trouble = TROUBLES[(number / 10 % 10) as usize];
        // At these the area has kinks by construction.
        if [Trouble::Sliver, Trouble::Tangent, Trouble::ReferenceInPivot, Trouble::Symmetric, Trouble::CoincidentBases]
            .contains(&trouble)
        {
            continue;
        }
        let case = random_case(number, trouble);
        let size = Oracle::of(&case.robot, case.modes).size;
        for index in kinds.clone() {
            let kind = kind_of(questions(&case, number)[index], index);
            let Ok(workspace) = case.robot.workspace(&kind, &modes_of(&case)) else { continue };
            if workspace.region.loops.is_empty() {
                continue;
            }
            for text in KEYS {
                let key: DesignKey = text.parse().expect("a name");
                let Ok(numbers) = key.numbers(&case.robot) else { continue };
                let slope = case.robot.area_gradient(&workspace, &modes_of(&case), &numbers).expect("is covered")[0];
                let here = case.robot.design_number(numbers[0]).expect("is there");
                let h = 1e-5 * if key.is_angle(&case.robot) { 1.0 } else { size };
                let around = [-2.0, -1.0, 1.0, 2.0].map(|k| area(&case, &kind, numbers[0], here + k * h));
                let [Some(a), Some(b), Some(c), Some(d)] = around else { continue };
                let middle = workspace.region.area;
                let (left, right) = ((middle - a) / (2.0 * h), (d - middle) / (2.0 * h));
                let difference = (8.0 * (c - b) - (d - a)) / (12.0 * h);
                asked += 1;
                let unit = size * size / if key.is_angle(&case.robot) { 1.0 } else { size };
                // Where a piece begins or ends within the step the differences say nothing.
                if (left - right).abs() > 3e-3 * unit {
                    kinks += 1;
                    continue;
                }
                assert!(
                    (slope - difference).abs() < 2e-6 * unit + 0.05 * (left - right).abs(),
                    "{}, {kind:?}, {text}: slope {slope}, difference {difference} (left {left}, right {right})\n{}",
                    case.kind,
                    written(&case)
                );
            }
        }
    }
    assert!(asked > 200 && kinks * 10 < asked, "{asked} slopes, {kinks} kinks");
}

#[test]
fn gradients_of_constant_total_and_dextrous_areas_are_those_of_differences() {
    compare(0..1, 100);
    compare(3..5, 100);
}

#[test]
fn gradients_of_maximal_and_inclusive_areas_are_those_of_differences() {
    compare(1..3, 60);
}

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
    assert!(tips.iter().all(|tip| (tip[0].abs()) < 1e-12), "{tips:?}");
    assert!(area > 0.0 && area < 0.1);
    assert_eq!(voids[1], Some(StrokeVoid::None));
    assert_eq!(golden_manipulator(&data, "M1A").stroke_voids(), [None; 3]);
    // One leg's own region at a fixed orientation has the hole of this area.
    let reach = robot.reach(&WorkspaceModes::Both).expect("is covered");
    let own = reach.only(0).workspace(&WorkspaceKind::Constant { phi: 0.4 }).expect("is covered").region;
    let hole: f64 = own.loops.iter().map(|one| one.area).filter(|area| *area < 0.0).sum();
    assert!((hole + area).abs() < 1e-12, "{hole} {area}");
}
