//! The manipulators the check asks about: golden ones, and random ones biased to trouble.

use std::f64::consts::{PI, TAU};

use assur::nalgebra::Vector2;
use assur::{Leg, Manipulator};
use serde_json::Value;

use crate::oracle::{Oracle, Question};
use crate::random::Random;

/// Published and reference cases: the data file, read once a test.
pub fn golden() -> Value {
    serde_json::from_str(include_str!("../golden/workspaces.json")).expect("is JSON")
}

fn pair(value: &Value) -> [f64; 2] {
    [0, 1].map(|k| value[k].as_f64().expect("a number"))
}

/// A manipulator of the golden file: the platform frame at B3 with its x axis towards B1.
pub fn golden_manipulator(data: &Value, name: &str) -> Manipulator {
    let entry = &data["manipulators"][name];
    let legs = (0..3)
        .map(|k| {
            let (a, b) = (pair(&entry["A"][k]), pair(&entry["platform"][k]));
            let limits = entry["limits"].get(k).map(pair);
            match entry["type"].as_str().expect("a text") {
                "RPR" => Leg { limits: [None, limits, None], ..Leg::rpr(a, b) },
                "RRR" => {
                    let [l1, l2] = pair(&entry["links"][k]);
                    Leg::rrr(a, l1, l2, b)
                }
                "PRR" => {
                    let l = entry["l"][k].as_f64().expect("a number");
                    let alpha = entry["alpha_deg"][k].as_f64().expect("a number").to_radians();
                    Leg { limits: [limits, None, None], ..Leg::prr(a, alpha, l, b) }
                }
                other => panic!("{other}"),
            }
        })
        .collect();
    let mut robot = Manipulator::new(name, legs).expect("is sound");
    robot.reference = Vector2::from(pair(&entry["ref"]));
    robot
}

/// The question of a golden case.
pub fn golden_question(case: &Value) -> Question {
    let range = || pair(&case["interval_deg"]).map(f64::to_radians);
    match case["kind"].as_str().expect("a text") {
        "constant" => Question::constant(case["theta_deg"].as_f64().expect("a number").to_radians()),
        "maximal" => Question::maximal(),
        "dextrous" => Question::dextrous(),
        kind => {
            let [from, to] = range();
            Question { from, width: to - from, every: kind == "total" }
        }
    }
}

/// A random manipulator and how it may be assembled.
#[derive(Clone, Debug)]
pub struct Case {
    pub robot: Manipulator,
    /// One working mode, or both.
    pub modes: Option<[bool; 3]>,
    /// What is special about it, for messages.
    pub kind: String,
}

/// Letters of the legs of a case, by its number: each type alone, then mixtures.
const TYPES: [[char; 3]; 10] = [
    ['s', 's', 's'],
    ['c', 'c', 'c'],
    ['p', 'p', 'p'],
    ['s', 'c', 'p'],
    ['s', 's', 'c'],
    ['p', 's', 's'],
    ['c', 'c', 'p'],
    ['p', 'p', 'c'],
    ['s', 'p', 'p'],
    ['c', 's', 'c'],
];

/// Which troubles a case has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trouble {
    None,
    /// Only the legs' reach and strokes limit; with some, ranges of the other joints too.
    PassiveRanges,
    OneMode,
    ReferenceInPivot,
    Sliver,
    /// Rings of the dextrous workspace that degenerate to circles; tangent circles.
    Tangent,
    CoincidentBases,
    Symmetric,
    SimilarPlatform,
    Bent,
}

pub const TROUBLES: [Trouble; 10] = [
    Trouble::None,
    Trouble::ReferenceInPivot,
    Trouble::Sliver,
    Trouble::Tangent,
    Trouble::CoincidentBases,
    Trouble::Symmetric,
    Trouble::SimilarPlatform,
    Trouble::OneMode,
    Trouble::PassiveRanges,
    Trouble::Bent,
];

/// Case `number` of a sequence: the same on every machine.
pub fn random_case(number: u64, trouble: Trouble) -> Case {
    let mut r = Random::new(0x5eed_0000 + 977 * number);
    let types = TYPES[(number % TYPES.len() as u64) as usize];
    let turn = r.between(0.0, TAU);
    let mut legs = Vec::new();
    let shape: Vec<[f64; 2]> = (0..3).map(|_| [r.between(-4.0, 4.0), r.between(-4.0, 4.0)]).collect();
    let ratio = r.between(0.2, 0.9);
    // Small platforms have dextrous workspaces.
    let small = if r.between(0.0, 1.0) < 0.5 { 0.2 } else { 1.0 };
    for (k, letter) in types.into_iter().enumerate() {
        let around = turn + TAU * k as f64 / 3.0;
        let (mut a, mut b) = match trouble {
            Trouble::Symmetric => {
                ([5.0 * around.cos(), 5.0 * around.sin()], [1.5 * (around + 0.3).cos(), 1.5 * (around + 0.3).sin()])
            }
            Trouble::SimilarPlatform => (shape[k], shape[k].map(|x| x * ratio)),
            _ => {
                let far = r.between(2.0, 6.0);
                (
                    [far * around.cos() + r.between(-1.5, 1.5), far * around.sin() + r.between(-1.5, 1.5)],
                    [r.between(-3.0, 3.0), r.between(-3.0, 3.0)],
                )
            }
        };
        if trouble == Trouble::CoincidentBases && k == 1 {
            a = [0.0, 0.0];
        }
        if trouble == Trouble::CoincidentBases && k == 2 {
            (a, b) = ([0.0, 0.0], if number.is_multiple_of(3) { [b[0], b[1]] } else { [1.0, 0.5] });
        }
        let distance = b[0].hypot(b[1]);
        let mut low = r.between(0.5, 5.0);
        let mut high = low + r.between(0.5, 6.0);
        if trouble == Trouble::Sliver {
            high = low + 10f64.powf(r.between(-5.0, -1.5));
        }
        if trouble == Trouble::Tangent {
            // The ring of the dextrous workspace is a circle; or the inner circle just touches the reference pivot's.
            match number % 3 {
                0 => high = low + 2.0 * distance,
                1 => low = distance,
                _ => high = 2.0 * distance,
            }
            high = high.max(low + 0.1);
        }
        if trouble == Trouble::Symmetric {
            (low, high) = (2.0, 6.0);
        }
        let pick = r.between(0.0, 1.0);
        let angles = [r.between(-PI, PI), r.between(0.3, 5.5)];
        let equal = r.between(0.0, 1.0) < 0.25;
        let mut leg = match letter {
            's' => Leg { limits: [None, Some([low, high]), None], ..Leg::rpr(a, b) },
            'c' => {
                // Reach between low and high: the sum and the difference of the links.
                let (l1, l2) = ((high + low) / 2.0, (high - low) / 2.0);
                let (l1, l2) = if equal { (high / 2.0, high / 2.0) } else { (l1, l2) };
                if pick < 0.5 { Leg::rrr(a, l1, l2, b) } else { Leg::rrr(a, l2, l1, b) }
            }
            _ => {
                let l = r.between(0.6, 6.0);
                let alpha = match trouble {
                    Trouble::Symmetric => around + 2.0,
                    _ if equal => PI / 2.0,
                    _ => r.between(-PI, PI),
                };
                let l = if trouble == Trouble::Tangent { distance } else { l };
                let from = if trouble == Trouble::Symmetric { -2.0 } else { r.between(-4.0, 1.0) };
                // A stroke of exactly two links has a lens of one point.
                let stroke = if trouble == Trouble::Tangent && number.is_multiple_of(2) { 2.0 * l } else { high - low };
                Leg { limits: [Some([from, from + stroke]), None, None], ..Leg::prr(a, alpha, l, b) }
            }
        };
        if trouble == Trouble::PassiveRanges {
            for (joint, limit) in leg.limits.iter_mut().enumerate() {
                if limit.is_none() && r.between(0.0, 1.0) < 0.45 {
                    let from = angles[0] + joint as f64;
                    *limit = Some([from, from + angles[1]]);
                }
            }
        }
        if trouble == Trouble::Bent {
            // Links and frames that are turned and off their axes.
            let mut placement = |reach: f64| {
                assur::Placement::turned(r.between(-reach, reach), r.between(-reach, reach), r.between(-PI, PI))
            };
            let (first, second) = (placement(2.0), placement(2.0));
            leg.base = assur::Placement { at: leg.base.at, direction: placement(1.0).direction };
            leg.platform = assur::Placement { at: leg.platform.at, direction: placement(1.0).direction };
            leg.links = [
                assur::Placement { at: leg.links[0].at + first.at, ..first },
                assur::Placement { at: leg.links[1].at + second.at, ..second },
            ];
            if number.is_multiple_of(2) {
                for limit in leg.limits.iter_mut().filter(|limit| limit.is_none()) {
                    *limit = Some([angles[0], angles[0] + angles[1]]);
                }
            }
        }
        legs.push(leg);
    }
    let mut robot = Manipulator::new(format!("case {number}"), legs).expect("is sound");
    robot.reference = match trouble {
        Trouble::ReferenceInPivot => robot.legs[(number % 3) as usize].platform.at,
        Trouble::Symmetric | Trouble::SimilarPlatform => Vector2::zeros(),
        _ => Vector2::new(r.between(-1.0, 1.0), r.between(-1.0, 1.0)) * small,
    };
    let one = trouble == Trouble::OneMode || trouble == Trouble::PassiveRanges && number % 4 < 2;
    let bits = (r.between(0.0, 8.0)) as u32;
    // A strut's - mode has negative lengths, which its range rules out.
    let modes = one.then(|| [0, 1, 2].map(|k| types[k] == 's' || bits & (1 << k) != 0));
    Case { robot, modes, kind: format!("{types:?} {trouble:?} number {number}") }
}

/// The five kinds asked of a case: about an orientation that it can have somewhere.
pub fn questions(case: &Case, number: u64) -> [Question; 5] {
    let mut r = Random::new(0xface + number);
    let oracle = Oracle::of(&case.robot, case.modes);
    let mut from = r.between(-PI, PI);
    for _ in 0..4000 {
        let at = [r.between(-oracle.size, oracle.size), r.between(-oracle.size, oracle.size)];
        let phi = r.between(-PI, PI);
        if oracle.slack(at, phi) > 0.0 {
            from = phi;
            break;
        }
    }
    // Some ranges pass half a turn, some are short.
    let width = if number.is_multiple_of(3) { r.between(3.0, 6.0) } else { r.between(0.1, 1.5) };
    let short = r.between(0.02, 0.3);
    [
        Question::constant(from),
        Question::maximal(),
        Question { from: from - 0.5 * width, width, every: false },
        Question { from: from - 0.5 * short, width: short, every: true },
        Question::dextrous(),
    ]
}

/// How many times the usual number of random manipulators are asked.
pub fn scale() -> u64 {
    std::env::var("ASSUR_TEST_SCALE").ok().and_then(|scale| scale.parse().ok()).unwrap_or(1).max(1)
}
