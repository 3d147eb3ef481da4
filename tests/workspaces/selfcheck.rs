//! The check itself, checked: against the crate's inverse kinematics and against the reference data.

use assur::Pose;

use crate::models::{TROUBLES, golden, golden_manipulator, golden_question, random_case};
use crate::oracle::{Oracle, SAMPLES, Verdict};
use crate::random::Random;

#[test]
fn slack_agrees_with_the_inverse_kinematics() {
    let mut r = Random::new(11);
    let (mut inside, mut asked) = (0, 0);
    for number in 0..200 {
        let case = random_case(number, TROUBLES[(number / 10 % 10) as usize]);
        let oracle = Oracle::of(&case.robot, case.modes);
        for _ in 0..60 {
            let (at, phi) = ([r.between(-6.0, 6.0), r.between(-6.0, 6.0)], r.between(-3.2, 3.2));
            let slack = oracle.slack(at, phi);
            if slack.abs() < 1e-9 * oracle.size {
                continue;
            }
            let origin =
                assur::nalgebra::Vector2::from(at) - assur::nalgebra::Rotation2::new(phi) * case.robot.reference;
            let ways = case.robot.inverse(&Pose::new(origin.x, origin.y, phi)).expect("is finite");
            let wanted =
                case.modes.map(|signs| signs.map(|plus| if plus { '+' } else { '-' }).iter().collect::<String>());
            let fits = |signs: &str| wanted.as_ref().is_none_or(|wanted| wanted == signs);
            let found = ways.modes.iter().any(|way| way.violations.is_empty() && fits(&way.signs));
            assert_eq!(found, slack > 0.0, "{}: {at:?} {phi} slack {slack}", case.kind);
            asked += 1;
            inside += usize::from(found);
        }
    }
    assert!(asked > 10_000 && inside > 300, "{inside} of {asked} poses inside: not much of a test");
}

#[test]
fn brute_force_agrees_with_the_reference_data() {
    let data = golden();
    let mut asked = 0;
    for case in data["cases"].as_array().expect("a list") {
        let robot = golden_manipulator(&data, case["manipulator"].as_str().expect("a text"));
        let oracle = Oracle::of(&robot, None);
        let question = golden_question(case);
        // The decision is the same for every fourth point as for all.
        for point in case["points"].as_array().expect("a list").iter().step_by(4) {
            let [x, y, inside, distance] = [0, 1, 2, 3].map(|k| point[k].as_f64().expect("a number"));
            let verdict = oracle.verdict_at([x, y], question, SAMPLES, 1e-12);
            let expected = if inside == 1.0 { Verdict::Inside } else { Verdict::Outside };
            assert!(verdict == expected || distance.abs() < 1e-9, "case {}: {point}: {verdict:?}", case["index"]);
            asked += 1;
        }
        for set in case["theta_sets"].as_array().into_iter().flatten() {
            let at = [&set["x"], &set["y"]].map(|v| v.as_f64().expect("a number"));
            for interval in set["intervals_rad"].as_array().expect("a list") {
                let [from, to] = [0, 1].map(|k| interval[k].as_f64().expect("a number"));
                // A full turn ends nowhere.
                for end in [from, to].into_iter().filter(|_| to - from < std::f64::consts::TAU - 1e-3) {
                    // Where two modes merge a joint is off by the root of a rounding.
                    assert!(oracle.slack(at, end).abs() < 1e-6 * oracle.size, "case {}: {set}", case["index"]);
                }
                assert!(oracle.slack(at, (from + to) / 2.0) > 0.0, "case {}: {set}", case["index"]);
            }
        }
    }
    assert!(asked > 3000, "only {asked} points asked");
}

#[test]
fn scan_lines_measure_a_reference_area() {
    let data = golden();
    let cases = data["cases"].as_array().expect("a list");
    for index in [68, 119, 145] {
        let case = cases.iter().find(|case| case["index"] == index).expect("a case");
        let robot = golden_manipulator(&data, case["manipulator"].as_str().expect("a text"));
        let [xmin, xmax, ymin, ymax] = [0, 1, 2, 3].map(|k| case["bbox"][k].as_f64().expect("a number"));
        let area = case["area"].as_f64().expect("a number");
        let found =
            Oracle::of(&robot, None).area([xmin - 0.01, ymin, xmax + 0.01, ymax], golden_question(case), 40, 60);
        assert!((found - area).abs() < 3e-3 * area, "case {index}: {found} against {area}");
    }
}
