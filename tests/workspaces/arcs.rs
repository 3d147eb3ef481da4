//! Constant, total and dextrous workspaces, membership and sets of orientations against reference values computed apart from this crate.

use std::f64::consts::TAU;

use assur::nalgebra::Vector2;
use assur::plane::PhiRange;
use assur::workspace::{Isolated, Region, WorkspaceKind, WorkspaceModes};
use assur::{Leg, Manipulator};
use serde_json::Value;

use crate::golden::{kind, number, numbers};
use crate::models::{golden, golden_manipulator, scale};
use crate::random::Random;

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
    let data = golden();
    let (mut points, mut sets) = (0, 0);
    for case in data["cases"].as_array().expect("a list") {
        let name = case["manipulator"].as_str().expect("a name");
        let reach = golden_manipulator(&data, name).reach(&WorkspaceModes::Both).expect("is covered");
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
                let hit = |i: &&[f64; 2]| {
                    (near(i[0], from) && near(i[1], to))
                        || (found.is_full() && to - from > std::f64::consts::TAU - 1e-2)
                };
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
    let data = golden();
    let mut cases = 0;
    for case in data["cases"].as_array().expect("a list").iter().filter(|case| of_arcs(case)) {
        let name = case["manipulator"].as_str().expect("a name");
        let kind = kind(case);
        let region =
            golden_manipulator(&data, name).workspace(&kind, &WorkspaceModes::Both).expect("is covered").region;
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
            for ((found, expected), error) in
                bbox.iter().zip([x0, y0, x1, y1]).zip([error[0], error[2], error[1], error[3]])
            {
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
    let data: Value = serde_json::from_str(include_str!("../golden/spatial.json")).expect("is JSON");
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
                assert!(
                    (found - number(&expected[key])).abs() < 1e-9,
                    "{name} {modes} {kind:?} {found} {key} {expected}"
                );
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

    let data = golden();
    let point = dextrous(&golden_manipulator(&data, "RRR1"));
    let [Isolated::Point { at, active }] = &point.isolated[..] else { panic!("{:?}", point.isolated) };
    assert!((at[0] - 5.0).abs() < 1e-12 && at[1].abs() < 1e-12);
    assert!(active.len() >= 4, "{active:?}");
}

/// A leg of one of the three chains about a unit in size, its joint frames anywhere, each joint with a range or without.
fn random_leg(random: &mut Random, ranges: bool) -> Leg {
    let chain = ["R_P_R", "_R_RR", "_P_RR", "RR_R_", "_R_PR", "P_R_R"][random.between(0.0, 6.0) as usize];
    let mut leg: Leg = chain.parse().expect("is a leg");
    let mut place = |size: f64| {
        let [x, y] = [random.between(-size, size), random.between(-size, size)];
        assur::Placement::turned(x, y, random.between(-3.0, 3.0))
    };
    (leg.base, leg.platform) = (place(0.8), place(0.4));
    leg.links = [place(1.0), place(1.0)];
    for (joint, kind) in leg.joints.into_iter().enumerate() {
        leg.limits[joint] = match kind {
            assur::JointKind::Prismatic => {
                let low = random.between(-1.0, 1.0);
                Some([low, low + random.between(0.3, 4.0)])
            }
            assur::JointKind::Revolute if ranges && random.between(0.0, 1.0) < 0.4 => {
                let low = random.between(-3.0, 3.0);
                Some([low, low + random.between(1.0, 6.0)])
            }
            assur::JointKind::Revolute => None,
        };
    }
    leg
}

fn random_robot(random: &mut Random, ranges: bool) -> Manipulator {
    loop {
        let legs: Vec<Leg> = (0..3).map(|_| random_leg(random, ranges)).collect();
        if let Ok(mut robot) = Manipulator::new("", legs) {
            robot.reference = Vector2::new(random.between(-0.3, 0.3), random.between(-0.3, 0.3));
            return robot;
        }
    }
}

fn modes(random: &mut Random) -> WorkspaceModes {
    if random.between(0.0, 1.0) < 0.5 {
        WorkspaceModes::Both
    } else {
        WorkspaceModes::Signs((0..3).map(|_| random.between(0.0, 1.0) < 0.5).collect())
    }
}

/// Whether a region holds a point, by counting crossings of the ray to the right; `None` where the ray grazes a vertex.
fn holds(region: &Region, [x, y]: [f64; 2]) -> Option<bool> {
    let mut crossings = 0;
    for arc in region.loops.iter().flat_map(|l| &l.arcs) {
        if (arc.start[1] - y).abs() < 1e-9 || (arc.end[1] - y).abs() < 1e-9 {
            return None;
        }
        match arc.curve {
            assur::workspace::ArcCurve::Line => {
                if (arc.start[1] > y) != (arc.end[1] > y) {
                    let part = (y - arc.start[1]) / (arc.end[1] - arc.start[1]);
                    crossings += usize::from(arc.start[0] + part * (arc.end[0] - arc.start[0]) > x);
                }
            }
            assur::workspace::ArcCurve::Circle { center, radius, start_angle, end_angle } => {
                let height = (y - center[1]) / radius;
                if height.abs() >= 1.0 {
                    continue;
                }
                for angle in [height.asin(), std::f64::consts::PI - height.asin()] {
                    let after = (angle - start_angle.min(end_angle)).rem_euclid(TAU);
                    let on = after < (end_angle - start_angle).abs();
                    crossings += usize::from(on && center[0] + radius * angle.cos() > x);
                }
            }
            // Of a coupler curve a polygon, which tells off the curve itself.
            _ => {
                for pair in arc.points(1025).windows(2) {
                    let [[x0, y0], [x1, y1]] = [pair[0], pair[1]];
                    if (y0 > y) != (y1 > y) {
                        let right = x0 + (y - y0) / (y1 - y0) * (x1 - x0) - x;
                        if right.abs() < 1e-4 {
                            return None;
                        }
                        crossings += usize::from(right > 0.0);
                    }
                }
            }
        }
    }
    Some(crossings % 2 == 1)
}

/// Random manipulators of every mixture, with ranges of any joint: the loops hold exactly the points that membership admits, they
/// close, and the margin is the radius of a disc that stays inside.
#[test]
fn loops_hold_what_membership_admits() {
    let mut random = Random::new(0x5eed_0007);
    let (mut compared, mut filled) = (0u64, 0u64);
    for case in 0..600 * scale() {
        let robot = random_robot(&mut random, case % 2 == 1);
        let modes = modes(&mut random);
        let from = random.between(-3.0, 3.0);
        let width = random.between(0.0, 0.8);
        let kind = match case % 3 {
            0 => WorkspaceKind::Constant { phi: from },
            1 => WorkspaceKind::Total(PhiRange { from, width }),
            _ => WorkspaceKind::Dextrous,
        };
        let reach = robot.reach(&modes).expect("is covered");
        let region = reach.workspace(&kind).expect("is covered").region;
        assert!(
            region.unclosed.is_empty(),
            "case {case}: {} pieces of {kind:?} {modes} {robot:?}",
            region.unclosed.len()
        );
        closes(&region);
        filled += u64::from(region.area > 0.0);
        let bbox = region.bbox.unwrap_or([-2.0, -2.0, 2.0, 2.0]);
        for _ in 0..40 {
            let at = [random.between(bbox[0] - 0.1, bbox[2] + 0.1), random.between(bbox[1] - 0.1, bbox[3] + 0.1)];
            let Some(held) = holds(&region, at) else { continue };
            compared += 1;
            assert_eq!(held, reach.contains(&kind, at.into()), "case {case}: {at:?} {kind:?} {modes} {robot:?}");
        }
    }
    println!("{compared} points, {filled} with area");
    assert!(compared > 10_000 * scale() && filled > 100 * scale());
}

#[test]
fn margins_are_radii_of_discs_inside() {
    let mut random = Random::new(0x5eed_0008);
    let mut inside = 0u64;
    for case in 0..120 * scale() {
        let robot = random_robot(&mut random, case % 2 == 1);
        let reach = robot.reach(&modes(&mut random)).expect("is covered");
        let moves = robot.legs.iter().any(|leg| leg.limits[2].is_some());
        for _ in 0..10 {
            let at = Vector2::new(random.between(-1.5, 1.5), random.between(-1.5, 1.5));
            let phi = random.between(-3.0, 3.0);
            let kind = WorkspaceKind::Constant { phi };
            let here = reach.membership(&kind, at);
            let around = |radius: f64, k: u32| {
                let (sin, cos) = (TAU * f64::from(k) / 720.0).sin_cos();
                reach.allows(at + radius * Vector2::new(cos, sin), phi)
            };
            assert_eq!(here.inside, here.margin > 0.0);
            if here.inside {
                inside += 1;
                assert!(
                    (0..720).all(|k| around(0.999 * here.margin, k)),
                    "case {case} {at:?} {phi} {here:?} {robot:?}"
                );
                assert!(
                    !(0..720).all(|k| around(1.01 * here.margin, k)),
                    "case {case} {at:?} {phi} {here:?} {robot:?}"
                );
            }
            if moves {
                continue;
            }
            // Greatest and least over the orientations against those of many.
            let sampled: Vec<f64> = (0..720)
                .map(|k| reach.membership(&WorkspaceKind::Constant { phi: TAU * f64::from(k) / 720.0 }, at).margin)
                .collect();
            let most = sampled.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let least = sampled.iter().copied().fold(f64::INFINITY, f64::min);
            // A platform point moves by its distance from the reference point times half a step at most.
            let step = 2.2 * TAU / 1440.0;
            let maximal = reach.membership(&WorkspaceKind::Maximal, at);
            let dextrous = reach.membership(&WorkspaceKind::Dextrous, at);
            assert!(
                maximal.margin >= most - 1e-12 && maximal.margin <= most + step,
                "case {case} {at:?} {maximal:?} {most} {robot:?}"
            );
            assert!(
                dextrous.margin <= least + 1e-12 && dextrous.margin >= least - step,
                "case {case} {at:?} {dextrous:?} {least} {robot:?}"
            );
        }
    }
    assert!(inside > 30 * scale(), "{inside}");
}

#[test]
fn what_cannot_be_asked_is_refused_by_name() {
    let sound = fourth([[8.0, 12.0], [5.0, 15.0], [10.0, 17.0]]);
    let ask = |robot: &Manipulator, kind: WorkspaceKind, modes: &str| {
        let modes = modes.parse::<WorkspaceModes>().map_err(|error| error.to_string())?;
        robot.workspace(&kind, &modes).map(|_| ()).map_err(|error| error.to_string())
    };
    let error = |change: &dyn Fn(&mut Manipulator)| {
        let mut robot = sound.clone();
        change(&mut robot);
        ask(&robot, WorkspaceKind::Dextrous, "both").expect_err("cannot be asked")
    };
    assert_eq!(ask(&sound, WorkspaceKind::Dextrous, "both"), Ok(()));
    assert_eq!(
        error(&|robot| robot.legs[1].limits[1] = Some([15.0, 5.0])),
        "leg 2: limits of joint 2: [15, 5] must not decrease"
    );
    assert_eq!(
        error(&|robot| robot.legs[2].limits[1] = Some([1.0, f64::NAN])),
        "leg 3: limits of joint 2: NaN must be finite"
    );
    assert_eq!(
        error(&|robot| robot.legs[0] = Leg { actuated: [false, true, false], ..Leg::rrp([0.0; 2], 1.0, [0.0; 2], 0.0) }),
        "leg 1: workspaces of legs RRP are not covered; those of RPR, RRR and PRR are"
    );
    assert_eq!(
        error(&|robot| robot.legs[1] = Leg::rrr([0.0; 2], 1.0, 0.0, [0.0; 2])),
        "leg 2: links[1]: a length of 0 joins two pivots into one, which workspaces do not cover"
    );
    assert_eq!(
        error(&|robot| robot.legs.iter_mut().for_each(|leg| leg.limits[1] = None)),
        "leg 1: joint 2 has no limits, and no other leg is bounded either, so the workspace is infinite"
    );
    assert_eq!(error(&|robot| robot.reference.x = f64::INFINITY), "reference: inf must be finite");
    // One bounded leg bounds it.
    let mut one = sound.clone();
    (one.legs[0].limits[1], one.legs[2].limits[1]) = (None, None);
    assert_eq!(ask(&one, WorkspaceKind::Constant { phi: 0.1 }, "both"), Ok(()));
    let of = |kind| ask(&sound, kind, "both").expect_err("cannot be asked");
    assert_eq!(of(WorkspaceKind::Constant { phi: f64::NAN }), "phi: NaN must be finite");
    let range = |from, width| PhiRange { from, width };
    assert_eq!(of(WorkspaceKind::Total(range(f64::INFINITY, 1.0))), "from: inf must be finite");
    assert_eq!(of(WorkspaceKind::Inclusive(range(0.0, -1.0))), "width of the range of phi: -1 must be ≥ 0");
    let named = |modes| ask(&sound, WorkspaceKind::Dextrous, modes).expect_err("names no modes");
    assert_eq!(named("++"), "mode \"++\": 2 signs, must be 3, one a leg");
    assert_eq!(named("+x+"), "mode \"+x+\": must be \"both\" or a sign + or - for each leg");
    assert_eq!(named(""), "mode \"\": must be \"both\" or a sign + or - for each leg");
}

/// Tangent, coincident and empty: what is decided on an edge is decided the same way by every road.
#[test]
fn tangency_and_coincidence_have_their_answers() {
    let ring =
        |a: [f64; 2], low: f64, high: f64| Leg { limits: [None, Some([low, high]), None], ..Leg::rpr(a, [0.0; 2]) };
    let region = |legs: Vec<Leg>| {
        let robot = Manipulator::new("", legs).expect("is sound");
        let region =
            robot.workspace(&WorkspaceKind::Constant { phi: 0.0 }, &WorkspaceModes::Both).expect("is covered").region;
        closes(&region);
        region
    };
    // Two discs that touch from outside: a point; a third far around changes nothing.
    let touch = region(vec![ring([0.0, 0.0], 0.0, 1.0), ring([3.0, 0.0], 0.0, 2.0), ring([0.0, 0.0], 0.0, 9.0)]);
    let [Isolated::Point { at, active }] = &touch.isolated[..] else { panic!("{touch:?}") };
    assert!((at[0] - 1.0).abs() < 1e-14 && at[1].abs() < 1e-14 && active.len() == 2, "{touch:?}");
    // Three times the same ring: each arc names all three legs.
    let same = region(vec![ring([0.0, 0.0], 1.0, 2.0); 3]);
    assert!((same.area - 3.0 * std::f64::consts::PI).abs() < 1e-13 && (same.components, same.holes) == (1, 1));
    assert!(same.loops.iter().all(|l| l.arcs.len() == 1 && l.arcs[0].active.len() == 3), "{same:?}");
    // A ring of no width is a circle, cut by a half of the plane's worth of disc to an arc.
    let circle = region(vec![ring([0.0, 0.0], 2.0, 2.0), ring([2.0, 0.0], 0.0, 2.0), ring([0.0, 0.0], 0.0, 9.0)]);
    let length: f64 = (circle.isolated.iter())
        .map(|part| match part {
            Isolated::Curve(arc) => arc.length(),
            Isolated::Point { .. } => 0.0,
        })
        .sum();
    assert!(circle.loops.is_empty() && (length - 4.0 * std::f64::consts::PI / 3.0).abs() < 1e-12, "{circle:?}");
    // A hole that touches the rim from inside, and one that just does not.
    let pinched = region(vec![ring([0.0, 0.0], 0.0, 3.0), ring([1.0, 0.0], 2.0, 9.0), ring([0.0, 0.0], 0.0, 9.0)]);
    assert!((pinched.area - 5.0 * std::f64::consts::PI).abs() < 1e-12 && pinched.components == 1, "{pinched:?}");
    let free = region(vec![ring([0.0, 0.0], 0.0, 3.0), ring([1.0, 0.0], 2.0 - 1e-9, 9.0), ring([0.0, 0.0], 0.0, 9.0)]);
    assert!((free.components, free.holes) == (1, 1));
    // Apart: empty is an answer.
    let none = region(vec![ring([0.0, 0.0], 0.0, 1.0), ring([3.0, 0.0], 0.0, 1.0), ring([0.0, 0.0], 0.0, 9.0)]);
    assert!(none.is_empty() && none.bbox.is_none() && none.centroid.is_none() && none.area == 0.0);
    // Two lens-shaped pieces that touch in a point are two.
    let two =
        region(vec![ring([0.0, 0.0], 1.0, 3.0), ring([2.0, 0.0], 1.0, 9.0), ring([1.0, 0.0], 0.0, 3.0_f64.sqrt())]);
    assert!(two.components >= 2, "{two:?}");
}
