//! Regions against brute force: both sides of every arc, random lines across them, loops that close, areas, laws.

use std::f64::consts::{PI, TAU};

use assur::nalgebra::{Rotation2, Vector2};
use assur::workspace::{ArcCurve, Isolated, Region, WorkspaceKind, WorkspaceModes};
use assur::{Dyad, JointKind, Leg, Manipulator, Placement, Triad};

use crate::membership::{NEAR, kind_of, modes_of, written};
use crate::models::{Case, TROUBLES, Trouble, questions, random_case, scale};
use crate::oracle::{MANY_SAMPLES, Oracle, Question, SAMPLES, Verdict};
use crate::random::Random;

/// Points along an arc for its polygon.
const POLYGON: usize = 257;
/// What a random line may miss a region's boundary by, in the size's part: the polygons' own error.
const CHORD: f64 = 1e-4;

/// A region as polygons.
pub struct Polygons(Vec<Vec<[f64; 2]>>);

impl Polygons {
    pub fn of(region: &Region) -> Self {
        let outline = |one: &assur::workspace::Loop| {
            one.arcs
                .iter()
                .flat_map(|arc| {
                    let mut points = arc.points(POLYGON);
                    points.pop();
                    points
                })
                .collect()
        };
        Self(region.loops.iter().map(outline).collect())
    }

    fn area(&self) -> f64 {
        let shoelace = |points: &Vec<[f64; 2]>| {
            let pairs = points.iter().zip(points.iter().cycle().skip(1));
            // Differences to the first corner keep the digits of small loops far from the origin.
            let [x0, y0] = points[0];
            pairs.map(|(p, q)| (p[0] - x0) * (q[1] - y0) - (q[0] - x0) * (p[1] - y0)).sum::<f64>() / 2.0
        };
        self.0.iter().filter(|points| !points.is_empty()).map(shoelace).sum()
    }

    /// How often the loops run around a point.
    pub fn winding(&self, [x, y]: [f64; 2]) -> i32 {
        let mut turns = 0;
        for points in &self.0 {
            for (p, q) in points.iter().zip(points.iter().cycle().skip(1)) {
                let side = (q[0] - p[0]) * (y - p[1]) - (x - p[0]) * (q[1] - p[1]);
                if p[1] <= y && q[1] > y && side > 0.0 {
                    turns += 1;
                } else if p[1] > y && q[1] <= y && side < 0.0 {
                    turns -= 1;
                }
            }
        }
        turns
    }

    /// The distance of a point from the nearest edge.
    pub fn distance(&self, [x, y]: [f64; 2]) -> f64 {
        let mut least = f64::INFINITY;
        for points in &self.0 {
            for (p, q) in points.iter().zip(points.iter().cycle().skip(1)) {
                let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
                let square = dx * dx + dy * dy;
                let t = if square > 0.0 { (((x - p[0]) * dx + (y - p[1]) * dy) / square).clamp(0.0, 1.0) } else { 0.0 };
                least = least.min((p[0] + t * dx - x).hypot(p[1] + t * dy - y));
            }
        }
        least
    }
}

/// Whether a number is greater than a bound, or none at all.
fn exceeds(value: f64, bound: f64) -> bool {
    value.is_nan() || value > bound
}

/// What is wrong with a region; empty where nothing is.
pub fn faults(oracle: &Oracle, question: Question, region: &Region, r: &mut Random) -> Vec<String> {
    let mut out = Vec::new();
    let size = oracle.size;
    let certainly = |at: [f64; 2], inside: bool| {
        let agrees = |verdict| match verdict {
            Verdict::Inside => inside,
            Verdict::Outside => !inside,
            Verdict::Near => true,
        };
        agrees(oracle.verdict_at(at, question, SAMPLES, NEAR))
            || agrees(oracle.verdict_at(at, question, MANY_SAMPLES, NEAR))
            || oracle.is_boundary(at, question, NEAR)
    };
    // Loops close, and every number is one.
    for (number, one) in region.loops.iter().enumerate() {
        for (arc, next) in one.arcs.iter().zip(one.arcs.iter().cycle().skip(1)) {
            let gap = (arc.end[0] - next.start[0]).hypot(arc.end[1] - next.start[1]);
            if exceeds(gap, NEAR * size) {
                out.push(format!("loop {number} has a gap of {gap:e} at {:?}", arc.end));
            }
            let ends = arc.points(2);
            for (claimed, drawn) in [arc.start, arc.end].iter().zip([ends[0], ends[ends.len() - 1]]) {
                let off = (claimed[0] - drawn[0]).hypot(claimed[1] - drawn[1]);
                if exceeds(off, 10.0 * NEAR * size) {
                    out.push(format!(
                        "loop {number}: an arc ends {off:e} from where it says, {claimed:?} {:?}",
                        arc.active
                    ));
                }
            }
        }
    }
    for arc in &region.unclosed {
        out.push(format!("not joined to a loop: {:?} to {:?} {:?}", arc.start, arc.end, arc.active));
    }
    let polygons = Polygons::of(region);
    let area = polygons.area();
    let room = 1e-4 * region.perimeter * size.min(region.perimeter) + 1e-9 * size * size;
    if exceeds((area - region.area).abs(), room) {
        out.push(format!("area {} but its polygons have {area}", region.area));
    }
    if let (Some(bbox), false) = (region.bbox, region.loops.is_empty()) {
        let all = || polygons.0.iter().flatten();
        for axis in 0..2 {
            let (low, high) =
                all().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p[axis]), h.max(p[axis])));
            if low < bbox[axis] - CHORD * size || high > bbox[axis + 2] + CHORD * size {
                out.push(format!("box {bbox:?} does not hold {low} to {high}"));
            }
        }
    }
    // Both sides of every arc.
    for arc in region.loops.iter().flat_map(|one| &one.arcs) {
        for part in [0.21, 0.5, 0.83] {
            let points = arc.points(POLYGON);
            let k = (part * (POLYGON - 1) as f64) as usize;
            let (p, along) = (points[k], [points[k + 1][0] - points[k - 1][0], points[k + 1][1] - points[k - 1][1]]);
            let length = along[0].hypot(along[1]);
            if length < 1e-7 * size {
                continue;
            }
            for (side, inside) in [(1.0, true), (-1.0, false)] {
                // Near enough that no other boundary lies between, mostly; where one does, a nearer point decides.
                let wrong = [1e-5, 1e-6, 1e-7].into_iter().all(|off| {
                    let off = side * off * size / length;
                    !certainly([p[0] - off * along[1], p[1] + off * along[0]], inside)
                });
                if wrong {
                    let side = if inside { "left" } else { "right" };
                    out.push(format!("{side} of {p:?} is not {inside}: {:?} {:?}", arc.active, arc.curve));
                }
            }
        }
    }
    // Points anywhere.
    let reach = region.bbox.map_or(size, |b| 0.6 * (b[2] - b[0]).max(b[3] - b[1]));
    let middle = region.bbox.map_or([0.0; 2], |b| [(b[0] + b[2]) / 2.0, (b[1] + b[3]) / 2.0]);
    for _ in 0..24 {
        let at = [middle[0] + r.between(-reach, reach), middle[1] + r.between(-reach, reach)];
        let winding = polygons.winding(at);
        if winding != 0 && winding != 1 && polygons.distance(at) > CHORD * size {
            out.push(format!("{at:?} is encircled {winding} times"));
        } else if polygons.distance(at) > CHORD * size && !certainly(at, winding == 1) {
            out.push(format!(
                "{at:?} is encircled {winding} times, slack {}",
                oracle.extreme(at, question, MANY_SAMPLES, f64::INFINITY)
            ));
        }
    }
    // Lines across: where the answer changes there is boundary.
    for _ in 0..2 {
        let reach = 1.2 * size.max(reach);
        let line = [0; 2].map(|_| [middle[0] + r.between(-reach, reach), middle[1] + r.between(-reach, reach)]);
        for (at, _) in oracle.crossings(line[0], line[1], question, 40) {
            if polygons.distance(at) > CHORD * size
                && !touches_isolated(region, at, CHORD * size)
                && oracle.is_boundary(at, question, NEAR)
            {
                out.push(format!(
                    "no boundary near {at:?}, where the answer changes (distance {})",
                    polygons.distance(at)
                ));
            }
        }
    }
    for part in &region.isolated {
        let at = match part {
            Isolated::Point { at, .. } => *at,
            Isolated::Curve(arc) => arc.points(3)[1],
        };
        if oracle.extreme(at, question, SAMPLES, f64::INFINITY) < -NEAR * size {
            out.push(format!("isolated {at:?} does not belong to it"));
        }
    }
    out
}

fn touches_isolated(region: &Region, at: [f64; 2], within: f64) -> bool {
    region.isolated.iter().any(|part| match part {
        Isolated::Point { at: p, .. } => (p[0] - at[0]).hypot(p[1] - at[1]) < within,
        Isolated::Curve(arc) => arc.points(POLYGON).iter().any(|p| (p[0] - at[0]).hypot(p[1] - at[1]) < 10.0 * within),
    })
}

/// Asks the kinds of an index range of many random manipulators.
fn check(kinds: std::ops::Range<usize>, cases: u64) {
    let (mut asked, mut empty) = (0, 0);
    let mut wrong: Vec<String> = Vec::new();
    for number in 0..cases * scale() {
        let case = random_case(number, TROUBLES[(number / 10 % 10) as usize]);
        let oracle = Oracle::of(&case.robot, case.modes);
        let mut r = Random::new(131 + number);
        for index in kinds.clone() {
            let question = questions(&case, number)[index];
            let kind = kind_of(question, index);
            asked += 1;
            let workspace = match case.robot.workspace(&kind, &modes_of(&case)) {
                Ok(workspace) => workspace,
                Err(error) => {
                    wrong.push(format!("{}, {kind:?}: {error}\n{}", case.kind, written(&case)));
                    continue;
                }
            };
            empty += usize::from(workspace.region.loops.is_empty());
            let faults = faults(&oracle, question, &workspace.region, &mut r);
            if !faults.is_empty() {
                let faults = faults[..faults.len().min(4)].join("\n  ");
                wrong.push(format!(
                    "{}, {kind:?}, area {}:\n  {faults}\n{}",
                    case.kind,
                    workspace.region.area,
                    written(&case)
                ));
            }
        }
    }
    let first = wrong[..wrong.len().min(3)].join("\n\n");
    assert!(wrong.is_empty(), "{} of {asked} workspaces wrong ({empty} empty); the first:\n{first}", wrong.len());
    assert!(4 * empty < 3 * asked, "{empty} of {asked} empty: not much of a test");
}

#[test]
fn constant_orientation_workspaces_are_those_of_brute_force() {
    check(0..1, 100);
}

#[test]
fn maximal_workspaces_are_those_of_brute_force() {
    check(1..2, 40);
}

#[test]
fn inclusive_workspaces_are_those_of_brute_force() {
    check(2..3, 40);
}

#[test]
fn total_orientation_and_dextrous_workspaces_are_those_of_brute_force() {
    check(3..5, 100);
}

/// With ranges of joints 1 and 3 and both modes, a leg's orientations are bounded by coupler curves of its own.
#[test]
fn total_orientation_workspaces_of_legs_whose_modes_differ_are_those_of_brute_force() {
    let (mut asked, mut full, mut coupled) = (0, 0, 0);
    let mut wrong: Vec<String> = Vec::new();
    for number in 0..60 * scale() {
        let mut case = random_case(number, Trouble::None);
        let mut r = Random::new(0xc0de + number);
        // One such leg, and others that allow nearly everything, or as they are. Strokes of one sign have one mode.
        let Some(own) = case.robot.legs.iter().position(|leg| leg.joints[1] == JointKind::Revolute) else { continue };
        for (k, leg) in case.robot.legs.iter_mut().enumerate() {
            if k == own {
                for joint in (0..3).filter(|joint| joint % 2 == 0 && leg.joints[*joint] == JointKind::Revolute) {
                    let from = r.between(-3.0, 3.0);
                    leg.limits[joint] = Some([from, from + r.between(2.0, 5.0)]);
                }
            } else if !number.is_multiple_of(3) {
                let (a, b): ([f64; 2], [f64; 2]) = (leg.base.at.into(), leg.platform.at.into());
                *leg = Leg { limits: [None, Some([0.0, 60.0]), None], ..Leg::rpr(a, b) };
            }
        }
        let oracle = Oracle::of(&case.robot, None);
        let Question { from, width, .. } = questions(&case, number)[3];
        let wider = r.between(0.2, 3.0);
        let question = Question { from: from + 0.5 * (width - wider), width: wider, every: true };
        let kind = kind_of(question, 3);
        let region = case.robot.workspace(&kind, &WorkspaceModes::Both).expect("is covered").region;
        let faults = faults(&oracle, question, &region, &mut r);
        if !faults.is_empty() {
            wrong.push(format!("{}, {kind:?}:\n  {}\n{}", case.kind, faults.join("\n  "), written(&case)));
        }
        let mut arcs = region.loops.iter().flat_map(|each| &each.arcs);
        asked += 1;
        full += usize::from(!region.loops.is_empty());
        coupled += usize::from(arcs.any(|arc| matches!(arc.curve, ArcCurve::Coupler(_) | ArcCurve::Ellipse(_))));
    }
    assert!(wrong.is_empty(), "{} of {asked} wrong; the first:\n{}", wrong.len(), wrong[0]);
    assert!(full * 4 > asked, "{full} of {asked} not empty");
    assert!(coupled * 10 > full, "{coupled} of {full} with coupler curves");
}

/// A manipulator on a grid of few numbers: regular, similar, mirrored or collinear, with equal lengths, so that candidate curves coincide and touch.
fn on_a_grid(number: u64) -> Case {
    let mut r = Random::new(0x9_1d00 + number);
    let mut of = |values: &[f64]| values[r.between(0.0, values.len() as f64) as usize];
    let (style, kind) = (number % 4, number / 4 % 4);
    let [far, arm, link] = [of(&[1.0, 2.0, 3.0, 4.0]), of(&[0.5, 1.0, 1.5, 2.0]), of(&[1.0, 1.5, 2.0, 2.5, 3.0])];
    let (turned, slope) = (of(&[0.0, PI, PI / 3.0, PI / 2.0, 0.3]), of(&[0.0, PI, PI / 2.0, -PI / 2.0, PI / 6.0, 1.0]));
    let low = of(&[-2.0, -1.0, 0.0, 0.5, 1.0, 1.5]);
    let stroke = of(&[0.5, 1.0, 2.0, 3.0, 4.0]);
    let shape = [0; 3].map(|_| [of(&[-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0]), of(&[-2.0, -1.0, 0.0, 1.0, 1.5, 2.0])]);
    let ratio = of(&[1.0, 0.5, -1.0, -0.5]);
    let mixed = of(&[0.0, 0.0, 1.0]) > 0.5;
    let ranged = of(&[0.0, 0.0, 0.0, 1.0]) > 0.5;
    let range = [of(&[-PI / 2.0, 0.0, PI / 4.0]), of(&[PI / 2.0, PI, 1.5 * PI])];
    let legs = (0..3usize).map(|k| {
        let around = PI / 2.0 + TAU * k as f64 / 3.0;
        let on = |radius: f64, angle: f64| [radius * angle.cos(), radius * angle.sin()];
        let (a, b, direction) = match style {
            0 => (on(far, around), on(arm, around + turned), around + slope),
            1 => (shape[k], shape[k].map(|x| x * ratio), slope),
            2 => (shape[k], [shape[(k + 1) % 3][0] * ratio, shape[(k + 2) % 3][1]], slope * k as f64),
            _ => ([far * (k as f64 - 1.0), 0.0], [arm * (k as f64 - 1.0), 0.0], slope),
        };
        let mut leg = match if mixed { (kind + k as u64) % 3 } else { kind % 3 } {
            0 => Leg { limits: [None, Some([low.abs(), low.abs() + stroke]), None], ..Leg::rpr(a, b) },
            1 => Leg::rrr(a, link, of(&[link, 1.0, 2.0]), b),
            _ => Leg { limits: [Some([low, low + stroke]), None, None], ..Leg::prr(a, direction, link, b) },
        };
        if ranged {
            for (joint, limit) in leg.limits.iter_mut().enumerate() {
                if limit.is_none() && (joint + k) % 2 == 0 {
                    *limit = Some([range[0], range[0] + range[1]]);
                }
            }
        }
        leg
    });
    let mut robot = Manipulator::new(format!("grid {number}"), legs.collect()).expect("is sound");
    robot.reference = robot.legs[0].platform.at * of(&[0.0, 0.0, 1.0]);
    let one = of(&[0.0, 0.0, 1.0]) > 0.5;
    let slides = |k: usize| robot.legs[k].joints[1] == JointKind::Prismatic;
    let modes = one.then(|| [0, 1, 2].map(|k| slides(k) | (of(&[0.0, 1.0]) > 0.5)));
    Case { robot, modes, kind: format!("grid {number}") }
}

/// Where candidate curves coincide or touch, loops close all the same and the answer is decided.
#[test]
fn workspaces_of_regular_similar_and_collinear_manipulators_are_decided() {
    let (mut asked, mut full) = (0, 0);
    let mut wrong: Vec<String> = Vec::new();
    for number in 0..40 * scale() {
        let case = on_a_grid(number);
        let oracle = Oracle::of(&case.robot, case.modes);
        let mut r = Random::new(number);
        let mut of = |values: &[f64]| values[r.between(0.0, values.len() as f64) as usize];
        let (from, width) = (of(&[-0.5, 0.0, 0.3, -PI / 2.0]), of(&[0.5, 1.0, PI]));
        let questions = [
            Question::constant(from),
            Question::maximal(),
            Question { from, width, every: false },
            Question { from, width: 0.1, every: true },
            Question::dextrous(),
        ];
        for (index, question) in questions.into_iter().enumerate() {
            let kind = kind_of(question, index);
            let region = case.robot.workspace(&kind, &modes_of(&case)).expect("is bounded").region;
            asked += 1;
            full += usize::from(!region.loops.is_empty());
            let faults = faults(&oracle, question, &region, &mut r);
            if !faults.is_empty() {
                let faults = faults[..faults.len().min(4)].join("\n  ");
                wrong.push(format!("{}, {kind:?}, area {}:\n  {faults}\n{}", case.kind, region.area, written(&case)));
            }
        }
    }
    // Two limits of two legs that are one surface, allowed on opposite sides, leave a leaf of poses without thickness, which stays undecided: rare here.
    let first = wrong[..wrong.len().min(3)].join("\n\n");
    assert!(wrong.len() <= asked / 500, "{} of {asked} wrong; the first:\n{first}", wrong.len());
    assert!(4 * full > asked, "{full} of {asked} not empty: not much of a test");
}

/// The radial 3-PRR whose platform is as large as the triangle of its sliders' ends: all three legs trace one circle there, and the platform goes around it without turning.
#[test]
fn a_platform_congruent_to_its_base_goes_around_a_circle_and_is_decided() {
    let legs = [0.0, 1.0, 2.0].map(|k| {
        let around = PI / 2.0 + k * TAU / 3.0;
        let on = |radius: f64| [radius * around.cos(), radius * around.sin()];
        Leg { limits: [Some([1.5, 3.5]), None, None], ..Leg::prr(on(4.0), around + PI, 1.5, on(0.5)) }
    });
    let robot = Manipulator::new("radial", legs.to_vec()).expect("is sound");
    let oracle = Oracle::of(&robot, None);
    let found = robot.workspace(&WorkspaceKind::Maximal, &WorkspaceModes::Both).expect("is bounded").region;
    let faults = faults(&oracle, Question::maximal(), &found, &mut Random::new(5));
    assert!(faults.is_empty() && found.components == 1, "{}", faults.join("\n"));
    // Three mirrors: the centroid is the middle.
    let [x, y] = found.centroid.expect("has area");
    assert!(x.hypot(y) < 1e-9, "{x} {y}");
    // What of the circle is not on the edge of the area is isolated: arcs of it, three alike.
    let total: f64 = (found.isolated.iter())
        .map(|part| match part {
            Isolated::Curve(arc) => {
                let off = arc.points(5).iter().map(|p| (p[0].hypot(p[1]) - 1.5).abs()).fold(0.0, f64::max);
                assert!(off < 1e-9, "{off:e} beside the circle");
                arc.length()
            }
            Isolated::Point { at, .. } => panic!("{at:?} is alone"),
        })
        .sum();
    assert!((total - 1.5 * PI).abs() < 1e-4, "{total}");
}

/// A leg held in a corner of what it allows, two of its own limits at once, by another leg that just reaches it: the maximal workspace is that pose alone.
#[test]
fn a_corner_of_one_leg_just_reached_by_another_is_an_isolated_point() {
    // A leg whose base pivot is the origin with its platform pivot, a corner of where it can be, and a direction in which nothing of that lies.
    let corners = |b: [f64; 2]| {
        let strut = Leg { limits: [Some([0.0, PI / 2.0]), Some([2.0, 5.0]), None], ..Leg::rpr([0.0; 2], b) };
        let crank =
            Leg { limits: [Some([0.0, 2.0]), Some([PI / 4.0, PI / 2.0]), None], ..Leg::rrr([0.0; 2], 3.0, 2.0, b) };
        let slider = Leg { limits: [Some([0.0, 2.0]), Some([2.0, 2.8]), None], ..Leg::prr([0.0; 2], 0.0, 2.0, b) };
        let half = 2.0 * (PI / 4.0).sin();
        [
            (strut, [0.0, 5.0], [-0.6, 0.8], ["leg 1 max", "leg 1 joint 1 max"]),
            (crank, [3.0 + half, half], [0.28, -0.96], ["leg 1 min", "leg 1 joint 2 min"]),
            (slider, [2.0 * 2.8_f64.cos(), 2.0 * 2.8_f64.sin()], [-0.8, -0.6], ["leg 1 min", "leg 1 joint 2 max"]),
        ]
    };
    let mut r = Random::new(0xc0);
    for round in 0..8 * scale() {
        let mut point = || Vector2::new(r.between(-2.0, 2.0), r.between(-2.0, 2.0));
        let (b, arm, reference) = (point(), point(), point());
        for (leg, corner, out, names) in corners(b.into()) {
            let (corner, out) = (Vector2::from(corner), Vector2::from(out));
            let reach = 4.0;
            // Leg 2 stretches to its end along `out`, the platform's side between both pivots as well.
            let base = corner + out * (reach + arm.norm());
            let other = Leg { limits: [None, Some([0.5, reach]), None], ..Leg::rpr(base.into(), (b + arm).into()) };
            let lax = Leg { limits: [None, Some([0.0, 90.0]), None], ..Leg::rpr([7.0, 3.0], [0.4, 1.0]) };
            let mut robot = Manipulator::new("corner", vec![leg, other, lax]).expect("is sound");
            // Also with the reference point at a pivot of either leg.
            robot.reference = [reference, b, b + arm][round as usize % 3];
            let phi = out.y.atan2(out.x) - arm.y.atan2(arm.x);
            let expected = corner + Rotation2::new(phi) * (robot.reference - b);
            let range = assur::plane::PhiRange { from: phi - 0.3, width: 0.7 };
            for kind in [WorkspaceKind::Maximal, WorkspaceKind::Inclusive(range)] {
                let found = robot.workspace(&kind, &WorkspaceModes::Both).expect("is bounded").region;
                let [Isolated::Point { at, active }] = &found.isolated[..] else {
                    panic!("round {round}, {kind:?} {names:?}: {:?}", found.isolated)
                };
                assert!(found.loops.is_empty() && found.unclosed.is_empty());
                assert!((Vector2::from(*at) - expected).norm() < 1e-9, "{at:?} {expected:?}");
                let active: Vec<String> = active.iter().map(ToString::to_string).collect();
                assert!(active.len() >= 2 && active.contains(&"leg 2 max".to_owned()), "{active:?}");
                assert!(active.iter().any(|name| names.contains(&&name[..])), "{active:?}");
            }
        }
    }
}

/// Strokes held at one length: with three of them the maximal workspace is the assembly modes, with two a coupler curve's pieces.
#[test]
fn held_strokes_leave_points_and_curves() {
    let strut = |a, b, limits| Leg { limits: [None, Some(limits), None], ..Leg::rpr(a, b) };
    let robot = |third: [f64; 2]| {
        let legs = vec![
            strut([0.0, 0.0], [-5.0, -3.0], [14.98, 14.98]),
            strut([15.91, 0.0], [12.04, -3.0], [15.38, 15.38]),
            strut([0.0, 10.0], [8.19, 6.98], third),
        ];
        Manipulator::new("held", legs).expect("is sound")
    };
    let maximal = |third| {
        let found = robot(third).workspace(&WorkspaceKind::Maximal, &WorkspaceModes::Both).expect("is bounded").region;
        assert!(found.loops.is_empty() && found.unclosed.is_empty());
        found.isolated
    };
    let modes = |third: f64| {
        let legs = robot([third; 2]).legs;
        let held = [0, 1, 2].map(|k| {
            let length = legs[k].limits[1].expect("has a stroke")[0];
            Dyad::RR { a: legs[k].base.at, b: legs[k].platform.at, length }
        });
        Triad::new(held).expect("is sound").real_modes().modes().to_vec()
    };
    let points = maximal([12.0, 12.0]);
    assert_eq!((points.len(), modes(12.0).len()), (6, 6));
    for mode in modes(12.0) {
        let off = |part: &Isolated| match part {
            Isolated::Point { at: [x, y], .. } => (x - mode.pose.x).hypot(y - mode.pose.y),
            Isolated::Curve(_) => f64::INFINITY,
        };
        assert!(points.iter().map(off).fold(f64::INFINITY, f64::min) < 1e-11);
    }
    // The ends of the curves are where the third stroke ends.
    let curves = maximal([10.0, 14.0]);
    let ends: Vec<[f64; 2]> = (curves.iter())
        .flat_map(|part| match part {
            Isolated::Curve(arc) => [arc.start, arc.end],
            Isolated::Point { .. } => panic!("no point is alone"),
        })
        .collect();
    let apart = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
    let alone = ends.iter().filter(|p| ends.iter().filter(|q| apart(**p, **q) < 1e-9).count() == 1).count();
    assert_eq!(alone, modes(10.0).len() + modes(14.0).len());
}

/// Manipulator 4 of the published ones with leg 1 at the two limits of having a dextrous workspace: a point, where the least stroke is the platform arm; a circle, where
/// the strokes differ by twice that arm.
#[test]
fn dextrous_workspaces_shrink_to_a_point_and_to_a_circle() {
    let dextrous = |first: [f64; 2]| {
        let strut = |a, b, limits| Leg { limits: [None, Some(limits), None], ..Leg::rpr(a, b) };
        let legs = vec![
            strut([0.0, 0.0], [2.0, 0.0], first),
            strut([10.0, 0.0], [1.0, 3f64.sqrt()], [1.0, 20.0]),
            strut([5.0, 8.66], [0.0, 0.0], [1.0, 20.0]),
        ];
        let robot = Manipulator::new("4", legs).expect("is sound");
        let found = robot.workspace(&WorkspaceKind::Dextrous, &WorkspaceModes::Both).expect("is bounded").region;
        assert!(found.loops.is_empty() && found.area == 0.0 && found.unclosed.is_empty());
        found.isolated
    };
    let point = dextrous([2.0, 3.5]);
    assert!(matches!(point[..], [Isolated::Point { at: [x, y], .. }] if x.hypot(y) < 1e-14), "{point:?}");
    // Leg 2 keeps out the part nearer to its pivot than 3; leg 3, whose pivot is the reference point, only what is nearer than 1 to a place 10 away.
    let circle = dextrous([5.5, 9.5]);
    let total: f64 = (circle.iter())
        .map(|part| match part {
            Isolated::Curve(arc) => arc.length(),
            Isolated::Point { .. } => panic!("no point is alone"),
        })
        .sum();
    let half = ((7.5_f64.powi(2) + 100.0 - 9.0) / (2.0 * 7.5 * 10.0)).acos();
    assert!((total - 7.5 * (TAU - 2.0 * half)).abs() < 1e-12 * total, "{total}");
}

/// The manipulator moved, turned and scaled.
fn moved(robot: &Manipulator, turn: f64, shift: Vector2<f64>, scale: f64) -> Manipulator {
    let rotation = Rotation2::new(turn);
    let mut out = robot.clone();
    out.reference *= scale;
    for leg in &mut out.legs {
        leg.base = Placement { at: rotation * leg.base.at * scale + shift, direction: rotation * leg.base.direction };
        leg.platform.at *= scale;
        leg.links.iter_mut().for_each(|link| link.at *= scale);
        for (limit, kind) in leg.limits.iter_mut().zip(leg.joints) {
            if let (Some(ends), JointKind::Prismatic) = (limit, kind) {
                *ends = ends.map(|end| end * scale);
            }
        }
    }
    out
}

#[test]
fn moving_turning_scaling_and_relabelling_change_nothing() {
    let mut asked = 0;
    for number in 0..40 * scale() {
        // Slivers and exact tangencies are decided by roundings, which moving changes.
        let trouble = TROUBLES[(number / 10 % 10) as usize];
        if [Trouble::Sliver, Trouble::Tangent, Trouble::Symmetric].contains(&trouble) {
            continue;
        }
        let case = random_case(number, trouble);
        for (index, question) in questions(&case, number).into_iter().enumerate() {
            let kind = kind_of(question, index);
            let Ok(here) = case.robot.workspace(&kind, &modes_of(&case)) else { continue };
            let turn = 0.7;
            let turned = match kind {
                WorkspaceKind::Constant { phi } => WorkspaceKind::Constant { phi: phi + turn },
                WorkspaceKind::Inclusive(range) => {
                    WorkspaceKind::Inclusive(assur::plane::PhiRange { from: range.from + turn, ..range })
                }
                WorkspaceKind::Total(range) => {
                    WorkspaceKind::Total(assur::plane::PhiRange { from: range.from + turn, ..range })
                }
                other => other,
            };
            let factor = 1e3;
            let there = moved(&case.robot, turn, Vector2::new(30.0, -20.0), factor);
            let there = there.workspace(&turned, &modes_of(&case)).expect("is the same question");
            let mut swapped = case.robot.clone();
            swapped.legs.rotate_left(1);
            let modes = case.modes.map(|mut signs| {
                signs.rotate_left(1);
                signs
            });
            let again = Case { robot: swapped, modes, kind: String::new() };
            let again = again.robot.workspace(&kind, &modes_of(&again)).expect("is the same question");
            let size = Oracle::of(&case.robot, case.modes).size;
            for (other, factor) in [(&there.region, factor), (&again.region, 1.0)] {
                let (area, length) = (other.area / (factor * factor), other.perimeter / factor);
                let same = (area - here.region.area).abs() <= 1e-11 * size * size
                    && (length - here.region.perimeter).abs() <= 1e-8 * size
                    && (other.components, other.holes) == (here.region.components, here.region.holes);
                assert!(
                    same,
                    "{}, {kind:?}: area {} and {area}, length {} and {length}, pieces {:?} and {:?}\n{}",
                    case.kind,
                    here.region.area,
                    here.region.perimeter,
                    (here.region.components, here.region.holes),
                    (other.components, other.holes),
                    written(&case)
                );
                asked += 1;
            }
        }
    }
    assert!(asked > 100, "{asked}");
}
