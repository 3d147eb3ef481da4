//! One area by many roads: Green's theorem along the loops, polygons extrapolated, halves of a cut, other frames, other orders of the legs, closed forms.

use std::f64::consts::PI;

use assur::nalgebra::{Rotation2, Vector2};
use assur::plane::PhiRange;
use assur::workspace::{ArcCurve, BoundaryArc, Isolated, Region, WorkspaceKind, WorkspaceModes};
use assur::{JointKind, Leg, Manipulator, Placement};

use crate::golden::kind as golden_kind;
use crate::membership::{kind_of, modes_of, written};
use crate::models::{Case, TROUBLES, Trouble, golden, golden_manipulator, questions, random_case, scale};
use crate::oracle::Oracle;
use crate::random::Random;
use crate::reachable::along;

type Point = Vector2<f64>;

/// What areas agree to, relative.
const AGREE: f64 = 1e-12;
/// What is left of thin regions: vertices are known to some tens of roundings of the size, which along a perimeter makes so much of size times perimeter.
const ROUNDINGS: f64 = 1e-14;

fn room(area: f64, region: &Region, size: f64) -> f64 {
    AGREE * area.abs() + ROUNDINGS * size * region.perimeter
}

// ── Green's theorem and cuts, from points alone ──

/// What a piece of an arc sweeps seen from a point: polygons of 16 to 1024 sides, their error's even powers taken away one by one (Romberg 1955).
fn swept(arc: &BoundaryArc, seen_from: Point, [from, to]: [f64; 2]) -> f64 {
    const SIDES: usize = 16;
    const HALVINGS: usize = 6;
    let most = SIDES << HALVINGS;
    let points: Vec<Point> =
        (0..=most).map(|k| along(arc, from + (to - from) * k as f64 / most as f64) - seen_from).collect();
    let polygon = |step: usize| -> f64 {
        let corners: Vec<Point> = points.iter().copied().step_by(step).collect();
        corners.windows(2).map(|pair| 0.5 * pair[0].perp(&pair[1])).sum()
    };
    let mut row: Vec<f64> = Vec::new();
    let mut best = (f64::INFINITY, 0.0);
    for halving in 0..=HALVINGS {
        let mut value = polygon(most / (SIDES << halving));
        for (k, before) in row.iter_mut().enumerate() {
            let better = value + (value - *before) / (4f64.powi(k as i32 + 1) - 1.0);
            *before = std::mem::replace(&mut value, better);
        }
        // The row's last entry is the best so far; what it changed by says how good it is.
        if let Some(last) = row.last().copied().filter(|_| halving > 1) {
            let change = (value - last).abs();
            if change < best.0 {
                best = (change, value);
            }
        }
        row.push(value);
    }
    best.1
}

fn arcs(region: &Region) -> impl Iterator<Item = &BoundaryArc> {
    region.loops.iter().flat_map(|one| &one.arcs)
}

/// The area on each side of a line, each from its own place on the line: the parts of the line between them add nothing to either.
fn halves(region: &Region, at: Point, normal: Point) -> [f64; 2] {
    /// Looks along an arc for changes of side.
    const LOOKS: usize = 256;
    let line = Point::new(-normal.y, normal.x);
    let seen_from = [at + line * 0.37, at - line * 0.81];
    let mut sums = [0.0; 2];
    for arc in arcs(region) {
        let side = |part: f64| (along(arc, part) - at).dot(&normal);
        let mut cuts = vec![0.0];
        for k in 0..LOOKS {
            let (mut low, mut high) = (k as f64 / LOOKS as f64, (k + 1) as f64 / LOOKS as f64);
            let left = side(low) > 0.0;
            if left != (side(high) > 0.0) {
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if (side(middle) > 0.0) == left { low = middle } else { high = middle }
                }
                cuts.push(low);
            }
        }
        cuts.push(1.0);
        for pair in cuts.windows(2) {
            let k = usize::from(side(0.5 * (pair[0] + pair[1])) > 0.0);
            sums[k] += swept(arc, seen_from[k], [pair[0], pair[1]]);
        }
    }
    sums
}

// ── other frames ──

/// The manipulator moved, turned, scaled, and its legs renumbered; and the question turned with it.
struct Frame {
    turn: f64,
    shift: Point,
    scale: f64,
    first: usize,
}

impl Frame {
    fn robot(&self, robot: &Manipulator) -> Manipulator {
        let rotation = Rotation2::new(self.turn);
        let mut out = robot.clone();
        out.reference *= self.scale;
        for leg in &mut out.legs {
            let at = rotation * leg.base.at * self.scale + self.shift;
            leg.base = Placement { at, direction: rotation * leg.base.direction };
            leg.platform.at *= self.scale;
            leg.links.iter_mut().for_each(|link| link.at *= self.scale);
            for (limit, kind) in leg.limits.iter_mut().zip(leg.joints) {
                if let (Some(ends), JointKind::Prismatic) = (limit, kind) {
                    *ends = ends.map(|end| end * self.scale);
                }
            }
        }
        out.legs.rotate_left(self.first);
        out
    }

    fn kind(&self, kind: &WorkspaceKind) -> WorkspaceKind {
        let turned = |range: &PhiRange| PhiRange { from: range.from + self.turn, ..*range };
        match kind {
            WorkspaceKind::Constant { phi } => WorkspaceKind::Constant { phi: phi + self.turn },
            WorkspaceKind::Inclusive(range) => WorkspaceKind::Inclusive(turned(range)),
            WorkspaceKind::Total(range) => WorkspaceKind::Total(turned(range)),
            other => *other,
        }
    }

    fn modes(&self, modes: &WorkspaceModes) -> WorkspaceModes {
        match modes {
            WorkspaceModes::Both => WorkspaceModes::Both,
            WorkspaceModes::Signs(signs) => {
                let mut signs = signs.clone();
                signs.rotate_left(self.first);
                WorkspaceModes::Signs(signs)
            }
        }
    }
}

/// What disagrees, and by how much the worst is off over what it may be.
#[derive(Default)]
struct Account {
    asked: usize,
    filled: usize,
    /// For each road the worst error: over the area, and over the size times the perimeter.
    worst: Vec<(&'static str, f64, f64)>,
    wrong: Vec<String>,
}

impl Account {
    fn note(
        &mut self,
        road: &'static str,
        found: f64,
        region: &Region,
        size: f64,
        more: f64,
        about: &dyn Fn() -> String,
    ) {
        let off = (found - region.area).abs();
        let (by_area, by_length) = (off / region.area, off / (size * region.perimeter));
        match self.worst.iter_mut().find(|(name, ..)| *name == road) {
            Some(worst) => *worst = (road, worst.1.max(by_area), worst.2.max(by_length)),
            None => self.worst.push((road, by_area, by_length)),
        }
        if off.is_nan() || off > more * room(region.area, region, size) {
            self.wrong.push(format!("{road}: {found} and {} ({off:e}), {}", region.area, about()));
        }
    }

    fn ask(
        &mut self,
        robot: &Manipulator,
        modes: &WorkspaceModes,
        kind: &WorkspaceKind,
        size: f64,
        about: &dyn Fn() -> String,
    ) {
        let here = robot.workspace(kind, modes).expect("is covered").region;
        self.asked += 1;
        let Some(bbox) = here.bbox.filter(|_| !here.loops.is_empty()) else { return };
        self.filled += 1;
        let middle = Point::new(0.5 * (bbox[0] + bbox[2]), 0.5 * (bbox[1] + bbox[3]));
        let points = arcs(&here).map(|arc| swept(arc, middle + Point::new(0.1, -0.2) * size, [0.0, 1.0])).sum();
        self.note("polygons", points, &here, size, 1.0, about);
        let pieces = here.loops.iter().map(|one| one.area).sum();
        self.note("loops", pieces, &here, size, 1.0, about);
        for angle in [0.4, 1.7] {
            let [right, left] = halves(&here, middle, Point::new(f64::cos(angle), f64::sin(angle)));
            self.note("cut", left + right, &here, size, 1.0, about);
        }
        let plain = || Frame { turn: 0.0, shift: Point::zeros(), scale: 1.0, first: 0 };
        let sizes = 1e3;
        let frames = [
            // Coordinates so many sizes away have so many times the roundings.
            ("turned", 1.0, Frame { turn: 0.7, ..plain() }),
            ("moved", sizes, Frame { shift: Point::new(0.8, -0.6) * sizes * size, ..plain() }),
            ("larger", 1.0, Frame { scale: 1e3, ..plain() }),
            ("smaller", 1.0, Frame { scale: 1e-3, ..plain() }),
            ("renumbered", 1.0, Frame { first: 1, ..plain() }),
            ("renumbered again", 1.0, Frame { first: 2, ..plain() }),
        ];
        for (road, more, frame) in frames {
            let there =
                frame.robot(robot).workspace(&frame.kind(kind), &frame.modes(modes)).expect("is as here").region;
            self.note(road, there.area / (frame.scale * frame.scale), &here, size, more, about);
            let pieces = |region: &Region| (region.components, region.holes);
            if pieces(&there) != pieces(&here) {
                self.wrong.push(format!("{road}: pieces {:?} and {:?}, {}", pieces(&there), pieces(&here), about()));
            }
        }
    }

    fn close(self) {
        println!("{} of {} not empty", self.filled, self.asked);
        for (road, by_area, by_length) in &self.worst {
            println!("{road:18} worst {by_area:.1e} of the area, {by_length:.1e} of size times perimeter");
        }
        let first = self.wrong[..self.wrong.len().min(4)].join("\n\n");
        assert!(self.wrong.is_empty(), "{} of {} areas disagree; the first:\n{first}", self.wrong.len(), self.asked);
        assert!(2 * self.filled > self.asked, "{} of {} not empty", self.filled, self.asked);
    }
}

#[test]
fn areas_of_the_reference_cases_agree_on_every_road() {
    let data = golden();
    let mut account = Account::default();
    for case in data["cases"].as_array().expect("a list") {
        let name = case["manipulator"].as_str().expect("a name");
        let robot = golden_manipulator(&data, name);
        let size = Oracle::of(&robot, None).size;
        let kind = golden_kind(case);
        account.ask(&robot, &WorkspaceModes::Both, &kind, size, &|| format!("{name} {kind:?}"));
    }
    account.close();
}

fn of_random(kinds: std::ops::Range<usize>, cases: u64) {
    let mut account = Account::default();
    for number in 0..cases * scale() {
        // Slivers and exact tangencies are decided by roundings, which other frames change.
        let trouble = TROUBLES[(number / 10 % 10) as usize];
        if [Trouble::Sliver, Trouble::Tangent, Trouble::Symmetric].contains(&trouble) {
            continue;
        }
        let case: Case = random_case(number, trouble);
        let size = Oracle::of(&case.robot, case.modes).size;
        for index in kinds.clone() {
            let kind = kind_of(questions(&case, number)[index], index);
            let about = || format!("{}, {kind:?}\n{}", case.kind, written(&case));
            account.ask(&case.robot, &modes_of(&case), &kind, size, &about);
        }
    }
    account.close();
}

#[test]
fn areas_at_one_orientation_agree_on_every_road() {
    of_random(0..1, 300);
}

#[test]
fn maximal_and_inclusive_areas_agree_on_every_road() {
    of_random(1..3, 100);
}

#[test]
fn total_areas_agree_on_every_road() {
    of_random(3..4, 300);
}

/// Most random manipulators have no dextrous workspace: struts that can grow from next to nothing have.
#[test]
fn dextrous_areas_agree_on_every_road() {
    let mut account = Account::default();
    let mut r = Random::new(0xde87);
    for number in 0..150 * scale() {
        let mut case = random_case(number, TROUBLES[if number % 2 == 0 { 0 } else { 5 }]);
        for leg in &mut case.robot.legs {
            leg.platform.at *= 0.3;
            if leg.joints[1] == JointKind::Prismatic {
                leg.limits[1] = Some([r.between(0.0, 1.0), r.between(6.0, 12.0)]);
            }
        }
        let size = Oracle::of(&case.robot, None).size;
        let about = || format!("{}\n{}", case.kind, written(&case));
        if case.robot.workspace(&WorkspaceKind::Dextrous, &WorkspaceModes::Both).expect("is covered").region.area > 0.0
        {
            account.ask(&case.robot, &WorkspaceModes::Both, &WorkspaceKind::Dextrous, size, &about);
        }
    }
    assert!(account.filled > 50);
    account.close();
}

#[test]
fn workspaces_far_away_are_those_at_home() {
    let mut coupled = 0;
    for number in 0..24 * scale() {
        let case = random_case(number, Trouble::None);
        let size = Oracle::of(&case.robot, case.modes).size;
        for (way, kind) in [
            (Point::new(1.0, 0.0), WorkspaceKind::Maximal),
            (Point::new(0.0, -1.0), WorkspaceKind::Maximal),
            (Point::new(0.8, -0.6), WorkspaceKind::Inclusive(PhiRange { from: -0.4, width: 0.9 })),
        ] {
            let shift = way * 1e3 * size;
            let far = Frame { turn: 0.0, shift, scale: 1.0, first: 0 }.robot(&case.robot);
            let workspace = |robot: &Manipulator| robot.workspace(&kind, &modes_of(&case)).expect("is covered");
            let (here, there) = (workspace(&case.robot), workspace(&far));
            let near = |p: [f64; 2], q: [f64; 2]| (Point::from(p) - Point::from(q)).norm() <= 1e-9 * size;
            let back = |p: [f64; 2]| [p[0] - shift.x, p[1] - shift.y];
            let what = format!("{} {way:?} {}", case.kind, kind.name());
            assert!((here.region.area - there.region.area).abs() <= 1e-9 * size * size, "{what}");
            assert_eq!(here.region.isolated.len(), there.region.isolated.len(), "{what}");
            match (here.region.centroid, there.region.centroid) {
                // Of slivers the area is known too badly to divide by.
                (Some(p), Some(q)) => assert!(near(p, back(q)) || here.region.area < 1e-4 * size * size, "{what}"),
                (p, q) => assert!(p.is_none() && q.is_none(), "{what}"),
            }
            if let (Some(p), Some(q)) = (here.region.bbox, there.region.bbox) {
                assert!(near([p[0], p[1]], back([q[0], q[1]])) && near([p[2], p[3]], back([q[2], q[3]])), "{what}");
            }
            let reach = far.reach(&modes_of(&case)).expect("is covered");
            let isolated = there.region.isolated.iter().filter_map(|part| match part {
                Isolated::Curve(arc) => Some(arc),
                Isolated::Point { .. } => None,
            });
            for arc in arcs(&there.region).chain(&there.separating).chain(isolated) {
                let points = arc.points(3);
                assert!(near(points[0], arc.start) && near(points[2], arc.end), "{what}");
                let (ArcCurve::Coupler(curve) | ArcCurve::Ellipse(curve)) = &arc.curve else { continue };
                // Its limits are those of the mechanism, and hold on it.
                let (at, phi) = (Point::from(curve.point_at(0.5)), curve.phi_at(0.5));
                for limit in &curve.pair {
                    assert!(reach.limits().any(|own| own == limit), "{what}");
                    assert!(limit.value(at, Point::new(phi.cos(), phi.sin())).abs() <= 1e-9 * size, "{what}");
                }
                coupled += 1;
            }
        }
    }
    assert!(coupled > 100, "{coupled}");
}

// ── ranges cut in two ──

/// At one orientation and in one working mode a joint's value belongs to the place: cutting its range in two cuts the workspace in two.
#[test]
fn ranges_cut_in_two_cut_the_area_in_two() {
    let mut account = Account::default();
    for number in 0..300 * scale() {
        let trouble = [Trouble::None, Trouble::OneMode, Trouble::PassiveRanges, Trouble::Bent][(number % 4) as usize];
        let case = random_case(number, trouble);
        let mut r = Random::new(0xc07 + number);
        let modes = WorkspaceModes::Signs(case.modes.map_or_else(|| vec![true; 3], |signs| signs.to_vec()));
        let size = Oracle::of(&case.robot, case.modes).size;
        let kind = kind_of(questions(&case, number)[0], 0);
        let whole = case.robot.workspace(&kind, &modes).expect("is covered").region;
        account.asked += 1;
        if whole.loops.is_empty() {
            continue;
        }
        account.filled += 1;
        for (k, leg) in case.robot.legs.iter().enumerate() {
            for (joint, limit) in leg.limits.iter().enumerate() {
                let Some([low, high]) = *limit else { continue };
                let between = low + r.between(0.1, 0.9) * (high - low);
                let area = |ends: [f64; 2]| {
                    let mut robot = case.robot.clone();
                    robot.legs[k].limits[joint] = Some(ends);
                    robot.workspace(&kind, &modes).expect("is covered").region.area
                };
                let sum = area([low, between]) + area([between, high]);
                let about =
                    || format!("leg {} joint {} at {between}: {}\n{}", k + 1, joint + 1, case.kind, written(&case));
                // Both halves have the cut's length as well.
                account.note("range cut", sum, &whole, size, 4.0, &about);
            }
        }
    }
    account.close();
}

// ── closed forms ──

/// The lens that two discs share.
fn lens(r: f64, s: f64, d: f64) -> f64 {
    let part = |r: f64, s: f64| {
        // Half the angle that the other circle cuts out, from the three sides without loss.
        let (a, b) = ((s - (d - r)) * (s + (d - r)), (d + r - s) * (d + r + s));
        let half = 2.0 * a.sqrt().atan2(b.sqrt());
        r * r * (half - half.sin() * half.cos())
    };
    part(r, s) + part(s, r)
}

/// What all discs of one radius share whose centres run over an arc of radius `arm` and this width.
///
/// On the sector opposite to the arc, a disc of radius `radius - arm` about the arc's centre; elsewhere the disc about the end of the arc that is further away, whose edge
/// at an angle `v` from its furthest direction is `sqrt(radius² - arm² sin² v) - arm cos v` from the arc's centre.
fn shared(radius: f64, arm: f64, width: f64) -> f64 {
    let half = 0.5 * width;
    let swept = |v: f64| {
        let (x, y) = (arm * v.sin(), arm * v.cos());
        0.5 * (radius * radius * (v - (x / radius).asin()) + x * y - x * (radius * radius - x * x).sqrt())
    };
    half * (radius - arm) * (radius - arm) + 2.0 * swept(PI - half)
}

fn near(found: f64, expected: f64) -> bool {
    (found - expected).abs() <= AGREE * expected.abs()
}

#[test]
fn areas_with_a_closed_form_have_it() {
    let mut r = Random::new(0xc105);
    let strut =
        |a: [f64; 2], low: f64, high: f64| Leg { limits: [None, Some([low, high]), None], ..Leg::rpr(a, [0.0; 2]) };
    let far = |leg: &Leg| strut(leg.base.at.into(), 0.0, 100.0);
    let area = |legs: Vec<Leg>, reference: [f64; 2], kind: WorkspaceKind| {
        let mut robot = Manipulator::new("", legs).expect("is sound");
        robot.reference = reference.into();
        robot.workspace(&kind, &WorkspaceModes::Both).expect("is covered").region.area
    };
    for _ in 0..100 * scale() {
        let base = [r.between(-5.0, 5.0), r.between(-5.0, 5.0)];
        let (low, high, phi) = (r.between(0.5, 3.0), r.between(3.2, 8.0), r.between(-PI, PI));
        let constant = WorkspaceKind::Constant { phi };
        // A lens of two discs: the strut of one and the stretched links of another.
        let towards = r.between(-PI, PI);
        let (s, d) = (r.between(1.0, 4.0), high + r.between(-0.9, 0.9));
        let other = [base[0] + d * towards.cos(), base[1] + d * towards.sin()];
        let discs =
            vec![strut(base, 0.0, high), Leg::rrr(other, s / 2.0, s / 2.0, [0.0; 2]), far(&strut(base, 0.0, 1.0))];
        if s < d + high && d < s + high && high < s + d {
            assert!(near(area(discs, [0.0; 2], constant), lens(high, s, d)), "lens {high} {s} {d}");
        }
        // A sector of a ring: a strut whose base joint has a range.
        let (from, width) = (r.between(-PI, PI), r.between(0.2, 6.0));
        let ring = strut(base, low, high);
        let sector = Leg { limits: [Some([from, from + width]), Some([low, high]), None], ..ring.clone() };
        let expected = 0.5 * (high * high - low * low) * width;
        assert!(
            near(area(vec![sector.clone(), far(&ring), far(&ring)], [0.0; 2], constant), expected),
            "sector {sector:?}"
        );
        // One leg with the reference point beside its pivot: rings.
        let arm = r.between(0.05, 0.45) * low.min(high - low);
        let turn = r.between(-PI, PI);
        let reference = [arm * turn.cos(), arm * turn.sin()];
        let legs = || vec![ring.clone(), far(&ring), far(&ring)];
        let between = |low: f64, high: f64| PI * (high - low) * (high + low);
        assert!(
            near(area(legs(), reference, WorkspaceKind::Maximal), between(low - arm, high + arm)),
            "maximal {ring:?}"
        );
        assert!(
            near(area(legs(), reference, WorkspaceKind::Dextrous), between(low + arm, high - arm)),
            "dextrous {ring:?}"
        );
        let range = PhiRange { from: r.between(-PI, PI), width: r.between(0.1, 3.0) };
        let discs = vec![strut(base, 0.0, high), far(&ring), far(&ring)];
        let found = area(discs, reference, WorkspaceKind::Total(range));
        assert!(near(found, shared(high, arm, range.width)), "total {found}: {high} {arm} {range:?}");
        // A slider's link: everything within its length of the stroke, the lens that neither end leaves out.
        let (l, stroke) = (r.between(0.5, 3.0), r.between(0.3, 7.0));
        let slider = Leg { limits: [Some([-1.0, stroke - 1.0]), None, None], ..Leg::prr(base, turn, l, [0.0; 2]) };
        let void = if stroke < 2.0 * l { lens(l, l, stroke) } else { 0.0 };
        let expected = PI * l * l + 2.0 * l * stroke - void;
        assert!(
            near(area(vec![slider.clone(), far(&ring), far(&ring)], [0.0; 2], constant), expected),
            "slider {slider:?}"
        );
        // Its maximal workspace: offset outwards, the lens of the ends' discs of radius l - arm left out.
        let arm = 0.4 * l;
        let inner = l - arm;
        let void = if stroke < 2.0 * inner { lens(inner, inner, stroke) } else { 0.0 };
        let expected = PI * (l + arm) * (l + arm) + 2.0 * (l + arm) * stroke - void;
        let found = area(vec![slider.clone(), far(&ring), far(&ring)], [arm, 0.0], WorkspaceKind::Maximal);
        assert!(near(found, expected), "maximal slider {slider:?}: {found} {expected}");
    }
}
