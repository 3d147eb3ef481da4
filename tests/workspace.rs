//! Constant, total and dextrous workspaces, membership and sets of orientations against reference values computed apart from this crate.

use std::f64::consts::TAU;

use assur::nalgebra::Vector2;
use assur::plane::PhiRange;
use assur::workspace::{Isolated, Region, WorkspaceKind, WorkspaceModes};
use assur::{Leg, Manipulator};
use serde_json::Value;

fn golden(name: &str) -> Value {
    let path = format!("{}/tests/golden/{name}", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&std::fs::read_to_string(path).expect("is readable")).expect("is JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is a number"))
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|k| number(&value[k]))
}

/// A manipulator of the reference file: platform frame at B3, x axis towards B1.
fn manipulator(data: &Value) -> Manipulator {
    let leg = |k: usize| {
        let (a, b) = (numbers::<2>(&data["A"][k]), numbers::<2>(&data["platform"][k]));
        match data["type"].as_str() {
            Some("RPR") => {
                Leg { limits: [None, Some(numbers(&data["limits"][k])), None], ..Leg::rpr(a, b) }
            }
            Some("RRR") => {
                let [l1, l2] = numbers(&data["links"][k]);
                Leg::rrr(a, l1, l2, b)
            }
            Some("PRR") => {
                let leg = Leg::prr(a, number(&data["alpha_deg"][k]).to_radians(), number(&data["l"][k]), b);
                Leg { limits: [Some(numbers(&data["limits"][k])), None, None], ..leg }
            }
            other => panic!("{other:?}"),
        }
    };
    let mut robot = Manipulator::new("", (0..3).map(leg).collect()).expect("is sound");
    robot.reference = numbers(&data["ref"]).into();
    robot
}

fn kind(case: &Value) -> WorkspaceKind {
    let range = || {
        let [from, to] = numbers::<2>(&case["interval_deg"]);
        PhiRange { from: from.to_radians(), width: (to - from).to_radians() }
    };
    match case["kind"].as_str() {
        Some("constant") => WorkspaceKind::Constant { phi: number(&case["theta_deg"]).to_radians() },
        Some("maximal") => WorkspaceKind::Maximal,
        Some("inclusive") => WorkspaceKind::Inclusive(range()),
        Some("total") => WorkspaceKind::Total(range()),
        Some("dextrous") => WorkspaceKind::Dextrous,
        other => panic!("{other:?}"),
    }
}

/// Whether two angles are the same to the digits of the reference.
fn near(a: f64, b: f64) -> bool {
    (a - b - TAU * ((a - b) / TAU).round()).abs() < 1e-9
}

/// The intervals of the reference, which is cut wherever a limit is met: those that touch are one.
fn joined(intervals: &Value) -> Vec<[f64; 2]> {
    let mut out: Vec<[f64; 2]> = intervals.as_array().expect("a list").iter().map(numbers).collect();
    while let Some((i, j)) = (0..out.len())
        .flat_map(|i| (0..out.len()).map(move |j| (i, j)))
        .find(|&(i, j)| i != j && near(out[i][1], out[j][0]))
    {
        out[i][1] += out[j][1] - out[j][0];
        out.remove(j);
    }
    out
}

#[test]
fn points_of_every_case_are_told_in_from_out() {
    let data = golden("workspaces.json");
    let (mut points, mut sets) = (0, 0);
    for case in data["cases"].as_array().expect("a list") {
        let name = case["manipulator"].as_str().expect("a name");
        let reach = manipulator(&data["manipulators"][name]).reach(&WorkspaceModes::Both).expect("is covered");
        for row in case["points"].as_array().into_iter().flatten() {
            let [x, y, inside, clear] = numbers(row);
            if clear.abs() < 1e-9 {
                continue;
            }
            points += 1;
            let found = reach.contains(&kind(case), Vector2::new(x, y));
            assert_eq!(found, inside == 1.0, "{name} {:?} ({x}, {y}), {clear} from the boundary", kind(case));
        }
        for place in case["theta_sets"].as_array().into_iter().flatten() {
            sets += 1;
            let expected = joined(&place["intervals_rad"]);
            let found = reach.orientations(Vector2::new(number(&place["x"]), number(&place["y"])));
            assert_eq!(found.intervals().len(), expected.len(), "{name} {place} {found:?}");
            for [from, to] in expected {
                let hit = |i: &&[f64; 2]| (near(i[0], from) && near(i[1], to)) || (found.is_full() && to - from > 6.28);
                assert!(found.intervals().iter().any(|i| hit(&i)), "{name} {place} {found:?}");
            }
        }
    }
    assert!(points > 5000 && sets > 300, "{points} points, {sets} sets");
}

/// Kinds whose boundary is made of circles and lines.
fn of_arcs(case: &Value) -> bool {
    !matches!(kind(case), WorkspaceKind::Maximal | WorkspaceKind::Inclusive(_))
}

fn closes(region: &Region) {
    assert!(region.unclosed.is_empty(), "{} pieces", region.unclosed.len());
    for l in &region.loops {
        for (k, arc) in l.arcs.iter().enumerate() {
            assert_eq!(arc.end, l.arcs[(k + 1) % l.arcs.len()].start);
            assert!(!arc.active.is_empty());
        }
    }
    let sum: f64 = region.loops.iter().map(|l| l.area).sum();
    assert!((sum - region.area).abs() <= 1e-12 * region.area.abs().max(1.0));
}

#[test]
fn areas_pieces_and_boxes_are_those_of_the_reference() {
    let data = golden("workspaces.json");
    let mut cases = 0;
    for case in data["cases"].as_array().expect("a list").iter().filter(|case| of_arcs(case)) {
        let name = case["manipulator"].as_str().expect("a name");
        let kind = kind(case);
        let region =
            manipulator(&data["manipulators"][name]).workspace(&kind, &WorkspaceModes::Both).expect("is covered").region;
        closes(&region);
        let about = format!("{name} {kind:?}: {} {} {}", region.area, region.components, region.holes);
        println!("{about} expected {} +- {} {} {}", case["area"], case["area_err"], case["components"], case["holes"]);
        assert!((region.area - number(&case["area"])).abs() <= number(&case["area_err"]).max(1e-9), "{about}");
        if case["topology_stable"] == true {
            assert_eq!(Some(region.components as u64), case["components"].as_u64(), "{about}");
            assert_eq!(Some(region.holes as u64), case["holes"].as_u64(), "{about}");
        }
        if let Some(bbox) = region.bbox.filter(|_| case["bbox"].is_array() && region.area > 0.0) {
            let [x0, x1, y0, y1] = numbers(&case["bbox"]);
            let error: [f64; 4] = numbers(&case["bbox_err"]);
            for ((found, expected), error) in bbox.iter().zip([x0, y0, x1, y1]).zip([error[0], error[2], error[1], error[3]]) {
                assert!((found - expected).abs() <= error.max(1e-9), "{about} {bbox:?}");
            }
        }
        cases += 1;
    }
    assert!(cases > 20, "{cases}");
}

/// Designs with sliders: areas and perimeters in all working modes.
#[test]
fn slider_designs_have_their_areas_in_every_mode() {
    let data = golden("spatial.json");
    let mut cases = 0;
    for (name, design) in data["prr"].as_object().expect("a table") {
        let Some(workspaces) = design["workspace"].as_array() else { continue };
        let g = &design["geometry"];
        let leg = |k: usize| {
            let leg = Leg::prr(numbers(&g["A"][k]), number(&g["alpha"][k]), number(&g["l"][k]), numbers(&g["c"][k]));
            Leg { limits: [Some([number(&g["rho_min"][k]), number(&g["rho_max"][k])]), None, None], ..leg }
        };
        let robot = Manipulator::new("", (0..3).map(leg).collect()).expect("is sound");
        for expected in workspaces {
            let modes: WorkspaceModes = expected["modes"].as_str().expect("a name").parse().expect("names modes");
            let kind = WorkspaceKind::Constant { phi: number(&expected["phi"]) };
            let region = robot.workspace(&kind, &modes).expect("is covered").region;
            closes(&region);
            for (found, key) in [(region.area, "area_green"), (region.perimeter, "perimeter")] {
                assert!((found - number(&expected[key])).abs() < 1e-9, "{name} {modes} {kind:?} {found} {key} {expected}");
            }
            let pieces: usize = region.loops.iter().map(|l| l.arcs.len()).sum();
            assert_eq!(Some(pieces as u64), expected["n_pieces"].as_u64(), "{name} {modes} {kind:?}");
            cases += 1;
        }
    }
    assert_eq!(cases, 30);
}

/// Manipulator 4 with its limits in set A: the rings of leg 1 is a circle.
fn fourth(limits: [[f64; 2]; 3]) -> Manipulator {
    let (a, b) = ([[0.0, 0.0], [10.0, 0.0], [5.0, 8.66]], [[2.0, 0.0], [1.0, 3.0_f64.sqrt()], [0.0, 0.0]]);
    let leg = |k: usize| Leg { limits: [None, Some(limits[k]), None], ..Leg::rpr(a[k], b[k]) };
    Manipulator::new("manipulator 4", (0..3).map(leg).collect()).expect("is sound")
}

#[test]
fn a_dextrous_workspace_can_be_an_arc_or_a_point() {
    let dextrous = |robot: &Manipulator| {
        robot.workspace(&WorkspaceKind::Dextrous, &WorkspaceModes::Both).expect("is covered").region
    };
    let arc = dextrous(&fourth([[8.0, 12.0], [5.0, 15.0], [10.0, 17.0]]));
    assert!(arc.loops.is_empty() && arc.area == 0.0);
    let [Isolated::Curve(arc)] = &arc.isolated[..] else { panic!("{:?}", arc.isolated) };
    let mut ends = [arc.start, arc.end].map(|[x, y]| {
        assert!((x.hypot(y) - 10.0).abs() < 1e-12);
        y.atan2(x).to_degrees()
    });
    ends.sort_by(f64::total_cmp);
    assert!((ends[0] + 56.42).abs() < 0.01 && (ends[1] + 40.97).abs() < 0.01, "{ends:?}");
    assert_eq!(arc.active.iter().map(ToString::to_string).collect::<Vec<_>>(), ["leg 1 min", "leg 1 max"]);

    let data = golden("workspaces.json");
    let point = dextrous(&manipulator(&data["manipulators"]["RRR1"]));
    let [Isolated::Point { at, active }] = &point.isolated[..] else { panic!("{:?}", point.isolated) };
    assert!((at[0] - 5.0).abs() < 1e-12 && at[1].abs() < 1e-12);
    assert!(active.len() >= 4, "{active:?}");
}
