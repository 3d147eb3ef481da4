//! Maximal and inclusive workspaces: reference values computed apart from this crate, laws, and every place told in from out by exact membership.

use std::f64::consts::TAU;

use assur::nalgebra::{Rotation2, Vector2};
use assur::plane::PhiRange;
use assur::workspace::{ArcCurve, BoundaryArc, Reach, Region, WorkspaceKind, WorkspaceModes};
use assur::{JointKind, Leg, Manipulator};
use serde_json::Value;

use crate::golden::{kind as golden_kind, number, numbers};
use crate::models::{golden, golden_manipulator, scale};
use crate::random::Random;

type Point = Vector2<f64>;

/// Pieces of the boundary of a region, loop after loop.
fn arcs(region: &Region) -> Vec<BoundaryArc> {
    region.loops.iter().flat_map(|each| each.arcs.iter().cloned()).collect()
}

/// A point of an arc, by the part of its parameter.
pub fn along(arc: &BoundaryArc, part: f64) -> Point {
    match &arc.curve {
        ArcCurve::Line => Point::from(arc.start).lerp(&Point::from(arc.end), part),
        ArcCurve::Circle { center, radius, start_angle, end_angle } => {
            let angle = start_angle + part * (end_angle - start_angle);
            Point::from(*center) + Point::new(angle.cos(), angle.sin()) * *radius
        }
        ArcCurve::Coupler(arc) | ArcCurve::Ellipse(arc) => arc.point_at(part).into(),
    }
}

/// The angle an arc sweeps seen from a point, and how near it comes.
fn swept(arc: &BoundaryArc, seen_from: Point) -> (f64, f64) {
    /// Halvings: a quadrillionth of an arc.
    const DEPTH: usize = 45;
    fn halve(arc: &BoundaryArc, from: Point, [a, b]: [(f64, Point); 2], depth: usize, sum: &mut (f64, f64)) {
        let middle = 0.5 * (a.0 + b.0);
        let at = along(arc, middle);
        let [u, v, w] = [a.1, at, b.1].map(|p| p - from);
        let near = u.norm().min(v.norm()).min(w.norm());
        sum.1 = sum.1.min(near);
        if depth == 0 || (v - u).norm() + (w - v).norm() < 0.3 * near {
            sum.0 += u.perp(&v).atan2(u.dot(&v)) + v.perp(&w).atan2(v.dot(&w));
            return;
        }
        halve(arc, from, [a, (middle, at)], depth - 1, sum);
        halve(arc, from, [(middle, at), b], depth - 1, sum);
    }
    let mut sum = (0.0, f64::INFINITY);
    for k in 0..8 {
        let ends = [f64::from(k) / 8.0, f64::from(k + 1) / 8.0].map(|part| (part, along(arc, part)));
        halve(arc, seen_from, ends, DEPTH, &mut sum);
    }
    sum
}

/// How often a region's loops wind around a point, and how near they come.
fn winding(arcs: &[BoundaryArc], point: Point) -> (f64, f64) {
    let sums = arcs.iter().map(|arc| swept(arc, point));
    let (angle, near) = sums.fold((0.0, f64::INFINITY), |(sum, near), (angle, d)| (sum + angle, near.min(d)));
    (angle / TAU, near)
}

fn is_one_or_none(winding: f64, inside: bool) -> bool {
    (winding - if inside { 1.0 } else { 0.0 }).abs() < 1e-3
}

// ── reference values ──

fn reach(robot: &Manipulator) -> Reach {
    robot.reach(&WorkspaceModes::Both).expect("is covered")
}

fn region(robot: &Manipulator, kind: &WorkspaceKind) -> Region {
    let region = reach(robot).workspace(kind).expect("is bounded").region;
    assert!(region.unclosed.is_empty(), "{:?}", region.unclosed);
    region
}

/// Maximal and inclusive cases of the reference: name, manipulator, kind, data.
fn cases(data: &Value) -> Vec<(String, Manipulator, WorkspaceKind, &Value)> {
    let all = data["cases"].as_array().expect("a list");
    let found = all.iter().filter_map(|case| {
        let kind = golden_kind(case);
        if !matches!(kind, WorkspaceKind::Maximal | WorkspaceKind::Inclusive(_)) {
            return None;
        }
        let name = case["manipulator"].as_str().expect("a name");
        let label = format!("{name} {} {}", kind.name(), case["interval_deg"]);
        Some((label, golden_manipulator(data, name), kind, case))
    });
    found.collect()
}

#[test]
fn every_reference_case_agrees() {
    let data = golden();
    let cases = cases(&data);
    assert_eq!(cases.len(), 30);
    for (label, robot, kind, case) in cases {
        let region = region(&robot, &kind);
        let off = (region.area - number(&case["area"])).abs();
        assert!(off <= number(&case["area_err"]), "{label}: area {} off by {off:e}", region.area);
        let [low, high] = numbers(&case["bracket"]);
        assert!(low <= region.area && region.area <= high, "{label}");
        if case["topology_stable"] == true {
            assert_eq!(region.components as f64, number(&case["components"]), "{label}: components");
            assert_eq!(region.holes as f64, number(&case["holes"]), "{label}: holes");
        }
        let [x0, y0, x1, y1] = region.bbox.expect("is not empty");
        let (bbox, slack) = (numbers::<4>(&case["bbox"]), numbers::<4>(&case["bbox_err"]));
        for ((own, theirs), slack) in [x0, x1, y0, y1].into_iter().zip(bbox).zip(slack) {
            assert!((own - theirs).abs() <= 2.0 * slack, "{label}: bounding box {own} {theirs}");
        }
        let arcs = arcs(&region);
        for point in case["points"].as_array().expect("a list").iter().step_by(4) {
            let [x, y, inside, clear] = numbers::<4>(point);
            let (winding, near) = winding(&arcs, Point::new(x, y));
            assert!(is_one_or_none(winding, inside == 1.0), "{label}: ({x}, {y}) winds {winding}");
            assert!(
                near >= clear.abs() * (1.0 - 1e-9),
                "{label}: the boundary comes nearer to ({x}, {y}) than {clear}"
            );
        }
        for pair in region.loops.iter().flat_map(|each| each.arcs.iter().zip(each.arcs.iter().cycle().skip(1))) {
            let gap = (along(pair.0, 1.0) - along(pair.1, 0.0)).norm();
            assert!(gap < 1e-9, "{label}: a gap of {gap:e}");
        }
    }
}

// ── laws ──

/// The manipulator moved, turned and scaled, its platform frame turned; and by how much its orientations have grown.
fn elsewhere(robot: &Manipulator, angle: f64, platform_angle: f64, scale: f64, shift: Point) -> (Manipulator, f64) {
    let (turn, back) = (Rotation2::new(angle), Rotation2::new(-platform_angle));
    let mut out = robot.clone();
    out.reference = back * robot.reference * scale;
    for leg in &mut out.legs {
        leg.base.at = turn * leg.base.at * scale + shift;
        leg.base.direction = turn * leg.base.direction;
        leg.platform.at = back * leg.platform.at * scale;
        leg.platform.direction = back * leg.platform.direction;
        for link in &mut leg.links {
            link.at *= scale;
        }
        for (joint, limits) in leg.joints.iter().zip(&mut leg.limits) {
            if *joint == JointKind::Prismatic {
                *limits = limits.map(|range| range.map(|end| end * scale));
            }
        }
    }
    (out, angle + platform_angle)
}

/// Moving, turning, scaling and relabelling change nothing but the frame.
#[test]
fn the_frame_and_the_order_of_legs_do_not_matter() {
    let data = golden();
    for (label, robot, kind, _) in cases(&data) {
        let own = region(&robot, &kind);
        let turned = |kind: &WorkspaceKind, by: f64| match kind {
            WorkspaceKind::Inclusive(range) => {
                WorkspaceKind::Inclusive(PhiRange { from: range.from + by, width: range.width })
            }
            other => *other,
        };
        let frames = [(0.7, 0.0, 1.0, 0.0), (-2.3, 1.1, 1.0, 3.0), (0.4, -0.9, 1e6, 1e5), (3.0, 2.0, 1e-6, 0.0)];
        for (angle, platform_angle, scale, shift) in frames {
            let shift = Point::new(shift, -0.5 * shift);
            let (mut moved, by) = elsewhere(&robot, angle, platform_angle, scale, shift);
            moved.legs.rotate_left(1);
            let other = region(&moved, &turned(&kind, by));
            let same = |x: f64, y: f64, scale: f64| (x / scale - y).abs() <= 1e-12 * y.abs().max(own.area);
            assert!(same(other.area, own.area, scale * scale), "{label}: {:e}", other.area / scale / scale - own.area);
            assert!(
                same(other.perimeter, own.perimeter, scale),
                "{label}: perimeter off by {:e} of {}",
                other.perimeter / scale - own.perimeter,
                own.perimeter
            );
            assert_eq!((other.components, other.holes), (own.components, own.holes), "{label}");
            let centroid = |region: &Region| Point::from(region.centroid.expect("has an area"));
            let expected = Rotation2::new(angle) * centroid(&own) * scale + shift;
            let slack = 1e-10 * (own.area.sqrt() * scale + shift.norm());
            assert!((centroid(&other) - expected).norm() <= slack, "{label}");
        }
    }
}

/// The workspace of a range of orientations is that of its halves together, and all of them make the maximal one.
#[test]
fn ranges_add_up() {
    let data = golden();
    for name in ["M2C", "M1A_cen", "RRR3", "PRR2"] {
        let robot = golden_manipulator(&data, name);
        let reach = reach(&robot);
        let whole = region(&robot, &WorkspaceKind::Maximal);
        let full = region(&robot, &WorkspaceKind::Inclusive(PhiRange { from: 1.0, width: TAU }));
        assert!((whole.area - full.area).abs() <= 1e-12 * whole.area, "{name}");
        let parts: Vec<Vec<BoundaryArc>> = (0..4)
            .map(|k| WorkspaceKind::Inclusive(PhiRange { from: 0.25 * TAU * f64::from(k) + 0.3, width: 0.25 * TAU }))
            .map(|kind| arcs(&region(&robot, &kind)))
            .collect();
        let whole = arcs(&whole);
        let mut random = Random::new(7);
        for _ in 0..60 {
            let point = Point::new(random.between(-20.0, 20.0), random.between(-20.0, 20.0)) * (reach.size() / 25.0);
            let (all, near) = winding(&whole, point);
            if near < 1e-9 * reach.size() {
                continue;
            }
            let some = parts.iter().any(|part| winding(part, point).0 > 0.5);
            assert!(is_one_or_none(all, some), "{name} {point:?}");
        }
    }
}

// ── assemblies ──

/// Every place reached is reached by some assembly, and each assembly reaches only such places.
fn assemblies_cover(reach: &Reach, random: &mut Random) -> Vec<f64> {
    let whole = arcs(&reach.workspace(&WorkspaceKind::Maximal).expect("is bounded").region);
    let assemblies = reach.assemblies().expect("is bounded");
    assert!(assemblies.iter().all(|each| each.region.unclosed.is_empty()));
    let each: Vec<Vec<BoundaryArc>> = assemblies.iter().map(|each| arcs(&each.region)).collect();
    for _ in 0..40 {
        let arc = &whole[below(random, whole.len())];
        let off = Point::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0)) * (0.2 * reach.size());
        let place = along(arc, random.between(0.0, 1.0)) + off;
        let (all, near) = winding(&whole, place);
        if near > 1e-9 * reach.size() {
            let by = each.iter().filter(|part| winding(part, place).0 > 0.5).count();
            assert!(is_one_or_none(all, by > 0), "{place:?} reached by {by} assemblies, {all}");
        }
    }
    assemblies.iter().map(|each| each.region.area).collect()
}

#[test]
fn assemblies_of_the_reference_manipulators() {
    let data = golden();
    let mut random = Random::new(3);
    let expected: [(&str, &[f64]); 6] = [
        ("M1A", &[315.848]),
        ("M1_sep1", &[277.6546, 94.0087]),
        ("M1A_cen", &[283.0818]),
        ("RRR1", &[120.4103]),
        ("RRR3", &[66.3975]),
        // With its working modes: they merge where the links stand across the sliders.
        ("PRR1", &[34.9194]),
    ];
    for (name, areas) in expected {
        let reach = reach(&golden_manipulator(&data, name));
        let found = assemblies_cover(&reach, &mut random);
        assert_eq!(found.len(), areas.len(), "{name}: {found:?}");
        for (found, area) in found.iter().zip(areas) {
            assert!((found - area).abs() < 1e-3, "{name}: {found} {area}");
        }
    }
}

/// A slider-driven manipulator whose working modes cannot be left: each choice of modes is an assembly of its own, with its own workspace.
#[test]
fn modes_that_never_merge_are_assemblies_of_their_own() {
    let leg = |x: f64, y: f64, alpha: f64, b: [f64; 2]| Leg {
        limits: [Some([-0.2, 0.2]), None, None],
        ..Leg::prr([x, y], alpha, 3.0, b)
    };
    let legs = vec![
        leg(-3.0, 0.0, 0.1, [0.0, 0.0]),
        leg(3.2, 0.3, 0.2, [0.4, 0.1]),
        leg(0.1, 3.1, TAU / 4.0 + 0.3, [0.1, 0.5]),
    ];
    let robot = Manipulator::new("", legs).expect("is sound");
    let all = assemblies_cover(&reach(&robot), &mut Random::new(5));
    let mut by_modes: Vec<f64> = Vec::new();
    for k in 0..8 {
        let modes = WorkspaceModes::Signs([1, 2, 4].iter().map(|bit| k & bit == 0).collect());
        by_modes.extend(assemblies_cover_or_none(&robot, &modes));
    }
    by_modes.sort_by(|a, b| b.total_cmp(a));
    assert!(!all.is_empty() && all.len() <= by_modes.len(), "{all:?} {by_modes:?}");
    assert!(all[0] >= by_modes[0] * (1.0 - 1e-12), "{all:?} {by_modes:?}");
}

fn assemblies_cover_or_none(robot: &Manipulator, modes: &WorkspaceModes) -> Vec<f64> {
    let reach = robot.reach(modes).expect("is covered");
    let region = reach.workspace(&WorkspaceKind::Maximal).expect("is bounded").region;
    if region.loops.is_empty() { Vec::new() } else { assemblies_cover(&reach, &mut Random::new(6)) }
}

/// The two poses of figure 14 of Merlet, Gosselin and Mouly are one assembly's: at (9, 14.4) their intervals of orientations are one, so the platform goes there, turns,
/// and comes back.
#[test]
fn the_poses_of_figure_14_are_joined_by_a_motion() {
    let data = golden();
    let robot = golden_manipulator(&data, "M1A");
    let reach = reach(&robot);
    let (here, there) = (Point::new(7.0, 20.0), Point::new(9.0, 14.4));
    let holding = |place: Point, phi: f64| {
        let set = reach.orientations(place);
        let interval = set.intervals().iter().find(|[from, to]| (phi - from).rem_euclid(TAU) <= to - from).copied();
        interval.unwrap_or_else(|| panic!("{phi} is not allowed at {place:?}"))
    };
    assert!(holding(here, 270f64.to_radians()) != holding(here, 225f64.to_radians()), "two sheets at the start");
    // Each pose is carried to the meeting place in small steps, always turned to the middle of its interval.
    let arrives = [270f64, 225.0].map(|start| {
        let mut phi = start.to_radians();
        for step in 0..=2000 {
            let place = here.lerp(&there, f64::from(step) / 2000.0);
            let [from, to] = holding(place, phi);
            phi = 0.5 * (from + to);
        }
        holding(there, phi)
    });
    assert_eq!(arrives[0], arrives[1], "one interval at the meeting place");
    for start in [270f64, 225.0] {
        let workspace = reach.assembly(&assur::Pose::new(7.0, 20.0, start.to_radians())).expect("is allowed");
        assert!((workspace.region.area - 315.848).abs() < 1e-3);
    }
    // Where leg 1 is held longer the sheets stay apart.
    let apart = self::reach(&golden_manipulator(&data, "M1_sep1"));
    let assemblies = apart.assemblies().expect("is bounded");
    for (assembly, sheet) in assemblies.iter().zip([1.0, -1.0]) {
        // Angle of the platform line from A1 to the pivot, between 0 and pi on one sheet.
        let place = Point::from(assembly.region.centroid.expect("has an area"));
        let set = apart.orientations(place);
        let psi = |phi: f64| (phi - place.y.atan2(place.x)).rem_euclid(TAU);
        let own = set
            .intervals()
            .iter()
            .map(|[from, to]| 0.5 * (from + to))
            .find(|phi| (psi(*phi) < 0.5 * TAU) == (sheet > 0.0));
        let Some(phi) = own else { continue };
        let from = apart.assembly(&assur::Pose::new(place.x, place.y, phi)).expect("is allowed");
        assert!(
            (from.region.area - assembly.region.area).abs() < 1e-9,
            "{} {}",
            from.region.area,
            assembly.region.area
        );
    }
    let error = apart.assembly(&assur::Pose::new(100.0, 0.0, 0.0)).unwrap_err();
    assert_eq!(error.to_string(), "leg 1: does not allow the pose of the assembly");
}

// ── random manipulators ──

fn below(random: &mut Random, n: usize) -> usize {
    random.between(0.0, n as f64) as usize
}

fn chance(random: &mut Random, p: f64) -> bool {
    random.between(0.0, 1.0) < p
}

/// What is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Trouble {
    General,
    ReferenceAtPivot,
    /// Numbers on a coarse grid, three-fold symmetry, equal limits: coincident circles, tangencies, triple points.
    Symmetric,
    /// Ranges of every joint.
    Ranges,
    /// Strokes down to a millionth.
    Slivers,
    /// Similar and congruent platforms: parallelograms, self-motions.
    Similar,
}

fn random_manipulator(random: &mut Random, trouble: Trouble) -> Manipulator {
    let symmetric = trouble == Trouble::Symmetric;
    let snap = |x: f64| if symmetric { (2.0 * x).round() / 2.0 } else { x };
    let mut base = [Point::zeros(); 3];
    let mut platform = base;
    for k in 0..3 {
        base[k] = Point::new(random.between(-3.0, 3.0), random.between(-3.0, 3.0)).map(snap);
        platform[k] = Point::new(random.between(-1.5, 1.5), random.between(-1.5, 1.5)).map(snap);
    }
    if symmetric && chance(random, 0.5) {
        let (r, s) = (snap(random.between(1.0, 4.0)), snap(random.between(0.5, 2.0)));
        for k in 0..3 {
            let (sin, cos) = (TAU / 3.0 * k as f64).sin_cos();
            base[k] = Point::new(r * cos, r * sin);
            platform[k] = Point::new(s * cos, s * sin);
        }
    }
    if trouble == Trouble::Similar {
        let ratio = if chance(random, 0.3) { 1.0 } else { random.between(0.3, 1.2) };
        let turn = Rotation2::new(if chance(random, 0.5) { 0.0 } else { random.between(-3.0, 3.0) });
        platform = base.map(|a| turn * a * ratio);
    }
    let alike = symmetric && chance(random, 0.7) || trouble == Trouble::Similar && chance(random, 0.5);
    let (first, mixed) = (below(random, 3), chance(random, 0.4));
    let mut legs: Vec<Leg> = Vec::new();
    for k in 0..3 {
        let (a, b) = (base[k].into(), platform[k].into());
        let stroke = |random: &mut Random, low: f64, high: f64, longest: f64| {
            let from = snap(random.between(low, high));
            let length = if trouble == Trouble::Slivers {
                10f64.powf(random.between(-6.0, -1.0))
            } else {
                snap(random.between(0.5, longest))
            };
            Some([from, from + length])
        };
        let mut leg = match if mixed { below(random, 3) } else { first } {
            0 => Leg { limits: [None, stroke(random, 0.0, 2.5, 3.0), None], ..Leg::rpr(a, b) },
            1 => {
                let l1 = snap(random.between(0.5, 2.5)).max(0.5);
                let l2 = if chance(random, 0.2) { l1 } else { snap(random.between(0.5, 2.5)).max(0.5) };
                Leg::rrr(a, l1, l2, b)
            }
            _ => {
                let limits = stroke(random, -2.0, 1.0, 4.0);
                let sixth = TAU / 6.0 * below(random, 6) as f64;
                let alpha = if symmetric { sixth } else { random.between(-3.1, 3.1) };
                let l = snap(random.between(0.6, 2.5)).max(0.5);
                Leg { limits: [limits, None, None], ..Leg::prr(a, alpha, l, b) }
            }
        };
        if trouble == Trouble::Ranges {
            for limits in leg.limits.iter_mut().filter(|limits| limits.is_none()) {
                let from = random.between(-3.1, 3.1);
                if chance(random, 0.5) {
                    *limits = Some([from, from + random.between(0.3, 5.0)]);
                }
            }
        }
        if let (true, Some(model)) = (alike, legs.first()) {
            leg = Leg { base: leg.base, platform: leg.platform, ..model.clone() };
        }
        legs.push(leg);
    }
    let mut robot = Manipulator::new("", legs).expect("is sound");
    if trouble == Trouble::ReferenceAtPivot || symmetric && chance(random, 0.5) {
        robot.reference = platform[below(random, 3)];
    } else if !symmetric {
        robot.reference = Point::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
    }
    robot
}

/// Loops wind once around the places that exact membership holds, none around others, everywhere further than 1e-9 of the
/// mechanism's size from the boundary; half of the places are sought close to the boundary.
fn places_agree(trouble: Trouble) {
    for seed in 0..40 * scale() {
        let mut random = Random::new(seed * 6 + trouble as u64 + 1);
        let robot = random_manipulator(&mut random, trouble);
        let kind = if chance(&mut random, 0.4) {
            let from = random.between(-3.1, 3.1);
            WorkspaceKind::Inclusive(PhiRange::between(from, from + 10f64.powf(random.between(-2.0, 0.7))))
        } else {
            WorkspaceKind::Maximal
        };
        let modes = if chance(&mut random, 0.3) {
            WorkspaceModes::Signs((0..3).map(|_| chance(&mut random, 0.7)).collect())
        } else {
            WorkspaceModes::Both
        };
        let case = || format!("{trouble:?} {seed} {kind:?} {modes}: {robot:#?}");
        let reach = robot.reach(&modes).expect("is covered");
        let size = reach.size();
        let workspace = reach.workspace(&kind).expect("is bounded");
        assert!(workspace.region.unclosed.is_empty(), "{:?} {}", workspace.region.unclosed, case());
        let arcs = arcs(&workspace.region);
        let mut places: Vec<Point> =
            (0..25).map(|_| Point::new(random.between(-6.0, 6.0), random.between(-6.0, 6.0))).collect();
        if !arcs.is_empty() {
            for _ in 0..25 {
                let arc = &arcs[below(&mut random, arcs.len())];
                let part = random.between(0.01, 0.99);
                let along_it = along(arc, part + 1e-4) - along(arc, part - 1e-4);
                let off =
                    size * 10f64.powf(random.between(-8.5, -1.0)) * if chance(&mut random, 0.5) { 1.0 } else { -1.0 };
                if along_it.norm() > 0.0 {
                    places.push(along(arc, part) + Point::new(-along_it.y, along_it.x) * (off / along_it.norm()));
                }
            }
        }
        for place in places {
            let (winding, near) = winding(&arcs, place);
            let inside = reach.contains(&kind, place);
            assert!(
                near <= 1e-9 * size || is_one_or_none(winding, inside),
                "{place:?}, {near:e} from the boundary, winds {winding}, inside {inside}; {}",
                case()
            );
        }
    }
}

#[test]
fn places_agree_in_general() {
    places_agree(Trouble::General);
}

#[test]
fn places_agree_with_the_reference_at_a_pivot() {
    places_agree(Trouble::ReferenceAtPivot);
}

#[test]
fn places_agree_for_symmetric_manipulators() {
    places_agree(Trouble::Symmetric);
}

#[test]
fn places_agree_with_ranges_of_every_joint() {
    places_agree(Trouble::Ranges);
}

#[test]
fn places_agree_in_slivers() {
    places_agree(Trouble::Slivers);
}

#[test]
fn places_agree_for_similar_platforms() {
    places_agree(Trouble::Similar);
}
