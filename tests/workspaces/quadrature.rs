//! Areas by adaptive quadrature of membership: for every point brute force over the orientations, no boundary curve, no set of orientations.
//!
//! A line's length within the workspace is found by walking along it with steps no longer than the slack allows (a leg's slack changes no faster than its pivot moves,
//! but where working modes merge), and each change of sign by false position. The lines are summed by Gauss and Kronrod's rules of 7 and 15
//! points, the worst interval halved first. At one orientation it reaches 4e-8 of the area, and 1e-7 is asserted; of maximal and total-orientation workspaces, where every point
//! costs a search over the orientations, 4e-4, and 1e-3 is asserted.

use assur::workspace::Region;

use crate::membership::{kind_of, modes_of, written};
use crate::models::{Case, Trouble, questions, random_case, scale};
use crate::oracle::{Oracle, Question};

/// Orientations sampled at a point; the best are refined.
const SAMPLES: usize = 120;
/// Longest step along a line, in parts of it.
const LONGEST: f64 = 1.0 / 40.0;
/// Intervals at the start, and rules applied at most.
const START: usize = 16;
const MOST_RULES: usize = 1000;

/// Gauss-Kronrod: node, weight of 15, weight of 7.
const RULE: [[f64; 3]; 8] = [
    [0.0, 0.209_482_141_084_727_83, 0.417_959_183_673_469_4],
    [0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0],
    [0.405_845_151_377_397_2, 0.190_350_578_064_785_4, 0.381_830_050_505_118_9],
    [0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0],
    [0.741_531_185_599_394_4, 0.140_653_259_715_525_92, 0.279_705_391_489_276_64],
    [0.864_864_423_359_769_1, 0.104_790_010_322_250_18, 0.0],
    [0.949_107_912_342_758_5, 0.063_092_092_629_978_55, 0.129_484_966_168_869_7],
    [0.991_455_371_120_812_6, 0.022_935_322_010_529_22, 0.0],
];

/// Where a slack changes sign between two places, by false position that halves the weight of an end that stays (Dowell, Jarratt 1971).
fn crossing(slack: &impl Fn(f64) -> f64, mut low: (f64, f64), mut high: (f64, f64), exact: f64) -> f64 {
    let mut stayed = 0;
    for round in 0..80 {
        let middle =
            if round % 8 == 7 { 0.5 * (low.0 + high.0) } else { (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1) };
        let here = (middle, slack(middle));
        if here.1 == 0.0 || high.0 - low.0 < exact {
            return middle;
        }
        if (here.1 > 0.0) == (low.1 > 0.0) {
            low = here;
            if stayed == 1 {
                high.1 *= 0.5;
            }
            stayed = 1;
        } else {
            high = here;
            if stayed == -1 {
                low.1 *= 0.5;
            }
            stayed = -1;
        }
    }
    0.5 * (low.0 + high.0)
}

/// The length of a horizontal line within the workspace.
///
/// `shortest`: the shortest step, in parts of the line; pieces of the workspace shorter than that may be missed.
fn chord(oracle: &Oracle, question: Question, y: f64, [from, to]: [f64; 2], shortest: f64) -> f64 {
    let width = to - from;
    let (longest, shortest) = (LONGEST * width, shortest * width);
    let slack = |x: f64| oracle.extreme([x, y], question, SAMPLES, longest);
    let mut before = (from, slack(from));
    let (mut entered, mut length) = (from, 0.0);
    while before.0 < to {
        let mut step = before.1.abs().clamp(shortest, longest);
        // Near where modes merge a stroke changes faster than its pivot moves.
        while question.width == 0.0
            && before.1 < 0.0
            && step > shortest
            && oracle.slack_within([before.0, y], question.from, step) > 0.0
        {
            step *= 0.5;
        }
        let x = (before.0 + step).min(to);
        let here = (x, slack(x));
        if (here.1 > 0.0) != (before.1 > 0.0) {
            let at = crossing(&slack, before, here, 1e-13 * width);
            if here.1 > 0.0 {
                entered = at;
            } else {
                length += at - entered;
            }
        }
        before = here;
    }
    if before.1 > 0.0 { length + to - entered } else { length }
}

/// The area and what its rules differ by.
fn area(oracle: &Oracle, question: Question, [x0, y0, x1, y1]: [f64; 4], [wanted, shortest]: [f64; 2]) -> (f64, f64) {
    let rule = |low: f64, high: f64| {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let (mut fine, mut coarse) = (0.0, 0.0);
        for [node, weight, weight_of_7] in RULE {
            let signs: &[f64] = if node == 0.0 { &[1.0] } else { &[1.0, -1.0] };
            for sign in signs {
                let length = chord(oracle, question, middle + sign * half * node, [x0, x1], shortest);
                fine += weight * length * half;
                coarse += weight_of_7 * length * half;
            }
        }
        (low, high, fine, (fine - coarse).abs())
    };
    let cut = (y1 - y0) / START as f64;
    let mut pieces: Vec<(f64, f64, f64, f64)> =
        (0..START).map(|k| rule(y0 + cut * k as f64, y0 + cut * (k + 1) as f64)).collect();
    for _ in 0..MOST_RULES {
        let (total, left) = pieces.iter().fold((0.0, 0.0), |(t, l), piece| (t + piece.2, l + piece.3));
        if left <= wanted * total {
            break;
        }
        let worst = (0..pieces.len()).max_by(|&i, &j| pieces[i].3.total_cmp(&pieces[j].3)).expect("there are pieces");
        let (low, high, ..) = pieces.swap_remove(worst);
        let middle = 0.5 * (low + high);
        pieces.extend([rule(low, middle), rule(middle, high)]);
    }
    pieces.iter().fold((0.0, 0.0), |(t, l), piece| (t + piece.2, l + piece.3))
}

/// A box that the workspace cannot leave, whatever bounds it: about the leg whose joints reach least far.
fn bounds(case: &Case) -> [f64; 4] {
    let reach = |leg: &assur::Leg| {
        let lengths = leg.links.iter().map(|link| link.at.norm()).sum::<f64>();
        let strokes = leg.limits.iter().zip(leg.joints).filter(|(_, kind)| *kind == assur::JointKind::Prismatic);
        let stroke = |limit: &Option<[f64; 2]>| limit.map_or(f64::INFINITY, |ends| ends[0].abs().max(ends[1].abs()));
        lengths + strokes.map(|(limit, _)| stroke(limit)).sum::<f64>() + (leg.platform.at - case.robot.reference).norm()
    };
    let leg = case.robot.legs.iter().min_by(|one, other| reach(one).total_cmp(&reach(other))).expect("has legs");
    let (at, reach) = (leg.base.at, 1.01 * reach(leg));
    [at.x - reach, at.y - reach, at.x + reach, at.y + reach]
}

/// Areas of random manipulators by quadrature. `wanted`: what the rules may differ by, relative, and the shortest step along a line; `exact`: what is asserted, relative.
fn compare(index: usize, numbers: impl Iterator<Item = (u64, Trouble)>, wanted: [f64; 2], exact: f64) {
    let (mut asked, mut worst) = (0, (0.0f64, String::new()));
    let mut wrong = Vec::new();
    for (number, trouble) in numbers {
        let case = random_case(number, trouble);
        let question = questions(&case, number)[index];
        let kind = kind_of(question, index);
        let region: Region = case.robot.workspace(&kind, &modes_of(&case)).expect("is covered").region;
        // What is thinner than a step the walk may miss.
        let size = Oracle::of(&case.robot, case.modes).size;
        if region.area < 5e-3 * size * size {
            continue;
        }
        asked += 1;
        let (found, left) = area(&Oracle::of(&case.robot, case.modes), question, bounds(&case), wanted);
        let off = (found - region.area).abs() / region.area;
        if off > worst.0 {
            worst = (off, format!("{}, rules differ by {:.1e}", case.kind, left / found));
        }
        if off.is_nan() || off > exact {
            wrong.push(format!("{} {kind:?}: {found} ({left:.1e}) and {}\n{}", case.kind, region.area, written(&case)));
        }
    }
    println!("{asked} areas, worst off by {:.1e}: {}", worst.0, worst.1);
    assert!(
        wrong.is_empty(),
        "{} of {asked} wrong; the first:\n{}",
        wrong.len(),
        wrong[..wrong.len().min(3)].join("\n")
    );
    assert!(asked >= 5, "{asked} asked");
}

/// Each leg type alone and seven mixtures, without troubles.
fn plain(cases: u64) -> impl Iterator<Item = (u64, Trouble)> {
    (0..cases * scale()).map(|number| (number, Trouble::None))
}

#[test]
fn areas_at_one_orientation_are_those_of_quadrature() {
    let others = (0..10 * scale()).map(|number| (number, Trouble::OneMode));
    compare(0, plain(30).chain(others), [1e-8, 1e-7], 1e-7);
}

#[test]
fn maximal_areas_are_those_of_quadrature() {
    compare(1, plain(12), [1e-3, 1e-3], 1e-3);
}

#[test]
fn total_areas_are_those_of_quadrature() {
    compare(3, plain(10), [3e-4, 3e-4], 1e-3);
}
