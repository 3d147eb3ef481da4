//! Membership against brute force: points, sets of orientations, margins.

use std::f64::consts::{PI, TAU};

use assur::JointKind;
use assur::workspace::{Reach, WorkspaceKind, WorkspaceModes};

use crate::models::{Case, TROUBLES, Trouble, questions, random_case, scale};
use crate::oracle::{MANY_SAMPLES, Oracle, Question, SAMPLES, Verdict};
use crate::random::Random;

/// Slacks below this part of the size decide nothing.
pub const NEAR: f64 = 1e-9;

/// A question in the words of the library.
pub fn kind_of(question: Question, number: usize) -> WorkspaceKind {
    let range = assur::plane::PhiRange { from: question.from, width: question.width };
    match number {
        0 => WorkspaceKind::Constant { phi: question.from },
        1 => WorkspaceKind::Maximal,
        2 => WorkspaceKind::Inclusive(range),
        3 => WorkspaceKind::Total(range),
        _ => WorkspaceKind::Dextrous,
    }
}

/// The modes of a case in the words of the library.
pub fn modes_of(case: &Case) -> WorkspaceModes {
    case.modes.map_or(WorkspaceModes::Both, |signs| WorkspaceModes::Signs(signs.to_vec()))
}

/// A manipulator as a model file, to look into a disagreement with.
pub fn written(case: &Case) -> String {
    let mut text = format!(
        "schema = \"assur/manipulator/1\"\nreference = {:?}\n",
        [case.robot.reference.x, case.robot.reference.y]
    );
    for leg in &case.robot.legs {
        let frame = |p: &assur::Placement| {
            format!("{{ at = [{:?}, {:?}], direction = [{:?}, {:?}] }}", p.at.x, p.at.y, p.direction.x, p.direction.y)
        };
        text += &format!(
            "[[leg]]\njoints = \"{}\"\nbase = {}\nlinks = [{}, {}]\nplatform = {}\n",
            leg.name(),
            frame(&leg.base),
            frame(&leg.links[0]),
            frame(&leg.links[1]),
            frame(&leg.platform)
        );
        let of = |actuated: bool| {
            let ranges = (0..3)
                .filter(|&j| leg.actuated[j] == actuated)
                .filter_map(|j| leg.limits[j].map(|[a, b]| format!("{} = [{a:?}, {b:?}]", j + 1)));
            ranges.collect::<Vec<_>>().join(", ")
        };
        text += &format!("limits = {{ {} }}\npassive_limits = {{ {} }}\n", of(true), of(false));
    }
    text + &format!("# modes {:?}", case.modes)
}

/// Points worth asking about a case: spread over where it can be, and near the places where the answer changes.
fn points(r: &mut Random, oracle: &Oracle, question: Question) -> Vec<[f64; 2]> {
    let reach = 1.3 * oracle.size;
    let mut out: Vec<[f64; 2]> = (0..12).map(|_| [r.between(-reach, reach), r.between(-reach, reach)]).collect();
    let line =
        ([r.between(-reach, reach), r.between(-reach, reach)], [r.between(-reach, reach), r.between(-reach, reach)]);
    for (at, _) in oracle.crossings(line.0, line.1, question, 24) {
        let length = (line.1[0] - line.0[0]).hypot(line.1[1] - line.0[1]);
        let along = [(line.1[0] - line.0[0]) / length, (line.1[1] - line.0[1]) / length];
        for off in [1e-3, 1e-6, 3e-8] {
            for side in [-1.0, 1.0] {
                out.push([at[0] + side * off * oracle.size * along[0], at[1] + side * off * oracle.size * along[1]]);
            }
        }
    }
    out
}

#[test]
fn points_are_inside_where_brute_force_finds_a_way() {
    let (mut asked, mut inside, mut refused) = (0, 0, 0);
    let mut wrong: Vec<String> = Vec::new();
    for number in 0..100 * scale() {
        let case = random_case(number, TROUBLES[(number / 10 % 10) as usize]);
        let oracle = Oracle::of(&case.robot, case.modes);
        let Ok(reach) = case.robot.reach(&modes_of(&case)) else {
            refused += 1;
            continue;
        };
        let mut r = Random::new(31 + number);
        for (index, question) in questions(&case, number).into_iter().enumerate() {
            let kind = kind_of(question, index);
            for at in points(&mut r, &oracle, question) {
                let found = reach.contains(&kind, at.into());
                asked += 1;
                inside += usize::from(found);
                let expected = oracle.verdict_at(at, question, SAMPLES, NEAR);
                let agrees = |verdict| match verdict {
                    Verdict::Inside => found,
                    Verdict::Outside => !found,
                    Verdict::Near => true,
                };
                // A disagreement counts only if a search three hundred times finer insists, away from the boundary.
                if !agrees(expected)
                    && !agrees(oracle.verdict_at(at, question, MANY_SAMPLES, NEAR))
                    && !oracle.is_boundary(at, question, NEAR)
                {
                    let slack = oracle.extreme(at, question, MANY_SAMPLES, f64::INFINITY);
                    wrong.push(format!(
                        "{}: {kind:?} at {at:?}: {found}, slack {slack}\n{}",
                        case.kind,
                        written(&case)
                    ));
                }
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "{} of {asked} points wrong; the first:\n{}",
        wrong.len(),
        wrong[..wrong.len().min(3)].join("\n\n")
    );
    assert!(
        inside > 100 && asked > 5000 && refused * 10 < asked,
        "{inside} of {asked} inside, {refused} cases refused: not much of a test"
    );
}

#[test]
fn sets_of_orientations_are_those_that_brute_force_finds() {
    let (mut asked, mut wrong) = (0, Vec::new());
    for number in 0..200 * scale() {
        let case = random_case(number, TROUBLES[(number / 10 % 10) as usize]);
        let oracle = Oracle::of(&case.robot, case.modes);
        let Ok(reach) = case.robot.reach(&modes_of(&case)) else { continue };
        let mut r = Random::new(77 + number);
        for _ in 0..10 {
            let at = [r.between(-oracle.size, oracle.size), r.between(-oracle.size, oracle.size)];
            let set = reach.orientations(at.into());
            for k in 0..90 {
                let phi = f64::from(k) * 0.07;
                let slack = oracle.slack(at, phi);
                if slack.abs() < 1e-8 * oracle.size {
                    continue;
                }
                asked += 1;
                if set.contains(phi) != (slack > 0.0) {
                    wrong.push(format!(
                        "{} at {at:?}, phi {phi}: slack {slack}, set {:?}\n{}",
                        case.kind,
                        set.intervals(),
                        written(&case)
                    ));
                }
            }
            // The ends of the intervals are places where a limit is met.
            for &[from, to] in set.intervals() {
                if to - from < std::f64::consts::TAU {
                    for end in [from, to] {
                        let slack = oracle.slack(at, end);
                        if slack.abs() > 1e-7 * oracle.size
                            && !case.kind.contains("Ranges")
                            && !case.kind.contains("Bent")
                        {
                            wrong.push(format!(
                                "{} at {at:?}: an interval ends at {end} with slack {slack}\n{}",
                                case.kind,
                                written(&case)
                            ));
                        }
                    }
                }
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "{} of {asked} wrong; the first:\n{}",
        wrong.len(),
        wrong[..wrong.len().min(3)].join("\n\n")
    );
}

/// Margins are compared where every limit is a distance of pivots: there the check's slack is the distance of C from the nearest bound.
#[test]
fn margins_are_the_extreme_slacks() {
    let mut asked = 0;
    for number in (0..200 * scale()).filter(|number| [0, 1, 4, 9].contains(&(number % 10))) {
        let case = random_case(number, TROUBLES[(number / 10 % 7) as usize]);
        let oracle = Oracle::of(&case.robot, case.modes);
        let Ok(reach) = case.robot.reach(&modes_of(&case)) else { continue };
        let mut r = Random::new(99 + number);
        for (index, question) in questions(&case, number).into_iter().enumerate() {
            for _ in 0..4 {
                let at = [r.between(-oracle.size, oracle.size), r.between(-oracle.size, oracle.size)];
                let expected = oracle.extreme(at, question, 4 * SAMPLES, f64::INFINITY);
                let found = margin(&reach, &kind_of(question, index), at);
                assert!(
                    (found - expected).abs() < 1e-6 * oracle.size,
                    "{}: {question:?} at {at:?}: margin {found}, slack {expected}\n{}",
                    case.kind,
                    written(&case)
                );
                asked += 1;
            }
        }
    }
    assert!(asked > 1000);
}

/// With a range of joint 3 the edge of what a leg allows moves with the orientation. The margin is one that some orientation has; no orientation of a fine grid, nor near its best
/// ones, has a better (for kinds that ask for every orientation: a worse).
#[test]
fn margins_with_ranges_of_joint_3_are_extreme_over_a_fine_grid() {
    /// Orientations of the grid; of its best so many are improved, by so many halvings of the step.
    const GRID: usize = 1440;
    const IMPROVED: usize = 6;
    const HALVINGS: usize = 40;
    let (mut asked, mut inside) = (0, 0);
    let mut wrong: Vec<String> = Vec::new();
    for number in 0..30 * scale() {
        let mut case =
            random_case(number, [Trouble::None, Trouble::ReferenceInPivot, Trouble::Bent][number as usize % 3]);
        let mut r = Random::new(0xed6e + number);
        for (k, leg) in case.robot.legs.iter_mut().enumerate() {
            let own = k == (number % 3) as usize;
            let mut range = |wide: f64| {
                let from = r.between(-PI, PI);
                Some([from, from + r.between(1.0, wide)])
            };
            // One leg has the range asked about; some have one of joint 1 as well.
            leg.limits[2] = if own { range(5.0) } else { None };
            if leg.joints[0] == JointKind::Revolute {
                leg.limits[0] = if own && number % 2 == 0 { range(6.0) } else { None };
            }
        }
        // One mode, or both.
        case.modes = case.modes.filter(|_| number % 4 == 0);
        let Ok(reach) = case.robot.reach(&modes_of(&case)) else { continue };
        for (index, question) in questions(&case, number).into_iter().enumerate().skip(1) {
            let kind = kind_of(question, index);
            let size = reach.size();
            // A place inside, if chance finds one.
            let mut place = || [0; 2].map(|_| r.between(-0.7 * size, 0.7 * size));
            let places: Vec<[f64; 2]> = (0..200).map(|_| place()).collect();
            let at = places.iter().copied().find(|&at| reach.contains(&kind, at.into())).unwrap_or(places[0]);
            let found = margin(&reach, &kind, at);
            let sense = if question.every { -1.0 } else { 1.0 };
            let value = |phi: f64| sense * margin(&reach, &WorkspaceKind::Constant { phi }, at);
            let step = question.width.min(TAU) / GRID as f64;
            let within = |phi: f64| phi.clamp(question.from, question.from + question.width.min(TAU));
            let mut grid: Vec<(f64, f64)> =
                (0..=GRID).map(|k| within(question.from + step * k as f64)).map(|phi| (value(phi), phi)).collect();
            grid.sort_by(|a, b| b.0.total_cmp(&a.0));
            let mut best = grid[0].0;
            for &(start, phi) in &grid[..IMPROVED] {
                let (mut here, mut phi, mut step) = (start, phi, step);
                for _ in 0..HALVINGS {
                    step /= 2.0;
                    for side in [phi - step, phi + step].map(within) {
                        let there = value(side);
                        if there > here {
                            (here, phi) = (there, side);
                        }
                    }
                }
                best = best.max(here);
            }
            asked += 1;
            inside += usize::from(found > 0.0);
            // A narrow peak may pass through the grid, but not a wide difference.
            if sense * found < best - 1e-10 * size || sense * found > best + 1e-3 * size {
                wrong.push(format!(
                    "{}: {kind:?} at {at:?}: {found}, on the grid {}\n{}",
                    case.kind,
                    sense * best,
                    written(&case)
                ));
            }
        }
    }
    let first = wrong[..wrong.len().min(3)].join("\n");
    assert!(wrong.is_empty(), "{} of {asked} margins are not extreme; the first:\n{first}", wrong.len());
    assert!(inside * 4 > asked, "{inside} of {asked} inside: not much of a test");
}

fn margin(reach: &Reach, kind: &WorkspaceKind, at: [f64; 2]) -> f64 {
    reach.membership(kind, at.into()).margin
}
