//! Reference data: areas, pieces, boxes, points, assemblies of 63 published and planted cases.

use assur::exchange::ModelFile;
use assur::workspace::{WorkspaceKind, WorkspaceModes};
use assur::{Leg, Manipulator, Pose};
use serde_json::Value;

use crate::membership::kind_of;
use crate::models::{golden, golden_manipulator, golden_question};

pub fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is a number"))
}

pub fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|k| number(&value[k]))
}

/// The question of a golden case in the words of the library.
pub fn kind(case: &Value) -> WorkspaceKind {
    let names = ["constant", "maximal", "inclusive", "total", "dextrous"];
    let index = names.iter().position(|name| case["kind"] == *name).expect("a kind");
    kind_of(golden_question(case), index)
}

/// Every golden case of these kinds.
fn check(kinds: &[&str]) {
    let data = golden();
    let mut wrong = Vec::new();
    let mut asked = 0;
    for case in data["cases"].as_array().expect("a list") {
        if !kinds.contains(&case["kind"].as_str().expect("a text")) {
            continue;
        }
        asked += 1;
        let robot = golden_manipulator(&data, case["manipulator"].as_str().expect("a text"));
        let name = format!("case {} {} {}", case["index"], case["manipulator"], case["kind"]);
        let reach = robot.reach(&WorkspaceModes::Both).expect("is covered");
        let workspace = match reach.workspace(&kind(case)) {
            Ok(workspace) => workspace,
            Err(error) => {
                wrong.push(format!("{name}: {error}"));
                continue;
            }
        };
        let region = &workspace.region;
        let (area, error) = (number(&case["area"]), number(&case["area_err"]));
        // The reference's error is an estimate; what both sides of its bracket exclude is certain.
        if (region.area - area).abs() > 3.0 * error + 1e-9 * area {
            wrong.push(format!("{name}: area {} against {area} ± {error}", region.area));
        }
        let counts = [region.components, region.holes].map(|count| count as u64);
        if [&case["components"], &case["holes"]].map(|count| count.as_u64().unwrap_or_default()) != counts {
            let stable = &case["topology_stable"];
            wrong.push(format!(
                "{name}: {counts:?} pieces and holes against {} and {} (stable: {stable})",
                case["components"], case["holes"]
            ));
        }
        if let (Some(bbox), Some(_)) = (region.bbox, case["bbox"].as_array()) {
            let order = [0, 2, 1, 3].map(|k| number(&case["bbox"][k]));
            let off = bbox.iter().zip(order).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            let error = case["bbox_err"].as_array().into_iter().flatten().map(number).fold(1e-6, f64::max);
            if off > 2.0 * error {
                wrong.push(format!("{name}: box {bbox:?} against {order:?}"));
            }
        }
        for point in case["points"].as_array().expect("a list") {
            let at = [number(&point[0]), number(&point[1])];
            let member = reach.membership(&kind(case), at.into());
            let inside = point[2] == 1;
            if member.inside != inside && number(&point[3]).abs() > 1e-9 {
                wrong.push(format!("{name}: {point} found {}", member.inside));
            }
            let contradicts = (member.margin >= 0.0) != member.inside && member.margin.abs() > 1e-9;
            if contradicts || !member.margin.is_finite() {
                wrong.push(format!("{name}: {point} inside {} with margin {}", member.inside, member.margin));
            }
        }
        for set in case["theta_sets"].as_array().into_iter().flatten() {
            let found = reach.orientations([number(&set["x"]), number(&set["y"])].into());
            let expected = set["intervals_rad"].as_array().expect("a list");
            let width: f64 = expected.iter().map(|interval| number(&interval[1]) - number(&interval[0])).sum();
            if (found.measure() - width).abs() > 1e-9 {
                wrong.push(format!("{name}: {set} found {:?}", found.intervals()));
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "{} things wrong in {asked} cases:\n{}",
        wrong.len(),
        wrong[..wrong.len().min(40)].join("\n")
    );
}

#[test]
fn constant_total_and_dextrous_workspaces_are_the_published_ones() {
    check(&["constant", "total", "dextrous"]);
}

#[test]
fn maximal_workspaces_are_the_published_ones() {
    check(&["maximal"]);
}

#[test]
fn inclusive_workspaces_are_the_published_ones() {
    check(&["inclusive"]);
}

#[test]
fn slider_designs_have_the_published_areas() {
    let data: Value = serde_json::from_str(include_str!("../golden/spatial.json")).expect("is JSON");
    let mut asked = 0;
    for (name, entry) in data["prr"].as_object().expect("a table") {
        let Some(geometry) = entry.get("geometry") else { continue };
        let pair = |value: &Value| [number(&value[0]), number(&value[1])];
        let legs = (0..3)
            .map(|k| {
                let g = |key: &str| &geometry[key][k];
                let leg = Leg::prr(pair(g("A")), number(g("alpha")), number(g("l")), pair(g("c")));
                Leg { limits: [Some([number(g("rho_min")), number(g("rho_max"))]), None, None], ..leg }
            })
            .collect();
        let robot = Manipulator::new(name.clone(), legs).expect("is sound");
        // The example file is the same design.
        let path = format!("{}/examples/workspaces/prr-{}.toml", env!("CARGO_MANIFEST_DIR"), name.replace('_', "-"));
        let file = ModelFile::read(path.as_ref()).expect("an example");
        for one in entry["workspace"].as_array().expect("a list") {
            let modes: WorkspaceModes = one["modes"].as_str().expect("a text").parse().expect("modes");
            let kind = WorkspaceKind::Constant { phi: number(&one["phi"]) };
            for robot in [&robot, &file.manipulator] {
                let region = robot.workspace(&kind, &modes).expect("is covered").region;
                let (area, length) = (number(&one["area_green"]), number(&one["perimeter"]));
                // The square's borders are drawn by several legs at once; the angles of examples are rounded.
                assert!((region.area - area).abs() < 1e-9, "{name} {one}: area {}", region.area);
                assert!((region.perimeter - length).abs() < 1e-8, "{name} {one}: perimeter {}", region.perimeter);
                asked += 1;
            }
        }
    }
    assert!(asked >= 50, "{asked}");
}

#[test]
fn assemblies_are_the_published_ones() {
    let data = golden();
    let robot = golden_manipulator(&data, "M1A");
    let reach = robot.reach(&WorkspaceModes::Both).expect("is covered");
    let pose = |degrees: f64| Pose::new(7.0, 20.0, f64::to_radians(degrees));
    // The paper's figure 14 has two regions here; the two poses are joined by a motion.
    for degrees in [270.0, 225.0] {
        let area = reach.assembly(&pose(degrees)).expect("is allowed").region.area;
        assert!((area - 315.848_147).abs() < 1e-4, "{degrees}: {area}");
    }
    let data_robot = golden_manipulator(&data, "M1_sep1");
    let reach = data_robot.reach(&WorkspaceModes::Both).expect("is covered");
    for (sheet, sign) in [("psi1_in_(0,pi)", 1.0), ("psi1_in_(pi,2pi)", -1.0)] {
        let entry = &data["assemblies"]["M1_sep1"][sheet];
        let (area, error) = (number(&entry["area"]), number(&entry["err"]));
        let start = entry["points"].as_array().expect("a list").iter().find_map(|point| {
            let at = [number(&point[0]), number(&point[1])];
            let towards = at[1].atan2(at[0]);
            let set = reach.orientations(at.into());
            set.intervals().iter().find_map(|&[from, to]| {
                let phi = (from + to) / 2.0;
                // psi1 = theta - arg(C - A1).
                ((phi - towards).sin() * sign > 0.0 && to - from > 1e-3).then(|| Pose::new(at[0], at[1], phi))
            })
        });
        let found = reach.assembly(&start.expect("a pose of this sheet")).expect("is allowed").region.area;
        assert!((found - area).abs() < 3.0 * error, "{sheet}: {found} against {area}");
    }
    let error = reach.assembly(&Pose::new(1e3, 0.0, 0.0)).unwrap_err().to_string();
    assert!(error.contains("leg 1"), "{error}");
}

#[test]
fn the_poses_of_figure_14_are_joined_by_a_motion() {
    // Straight through B3, A1, B1 in line, each step within all limits.
    let robot = golden_manipulator(&golden(), "M1A");
    let reach = robot.reach(&WorkspaceModes::Both).expect("is covered");
    let through =
        [(7.0, 20.0, 270.0f64), (9.0, 14.4, 240.0), (12.258, 11.779, 223.86), (9.0, 14.4, 225.0), (7.0, 20.0, 225.0)];
    // The way between is found by asking, at each place on it, for the allowed orientation nearest to the last.
    let mut phi = through[0].2.to_radians();
    for pair in through.windows(2) {
        for step in 0..=400 {
            let t = f64::from(step) / 400.0;
            let at = [pair[0].0 + t * (pair[1].0 - pair[0].0), pair[0].1 + t * (pair[1].1 - pair[0].1)];
            let wanted = (pair[0].2 + t * (pair[1].2 - pair[0].2)).to_radians();
            let set = reach.orientations(at.into());
            // Stay in the interval that holds the last orientation; move towards the wanted one in it.
            let turn = std::f64::consts::TAU;
            let inside = set.intervals().iter().find_map(|&[from, to]| {
                (-2..=2)
                    .map(|k| [from + turn * f64::from(k), to + turn * f64::from(k)])
                    .find(|[from, to]| (*from - 0.02..=*to + 0.02).contains(&phi))
            });
            let [from, to] = inside.unwrap_or_else(|| {
                panic!("no way on at {at:?}, phi {}, allowed {:?}", phi.to_degrees(), set.intervals())
            });
            phi = wanted.clamp(from, to);
        }
    }
    assert!((phi.to_degrees() - 225.0).abs() < 1e-6);
}
