//! HANA: the published numbers, round trips, finite differences, and a second opinion by Newton's method from many starts.

mod random;

use assur::nalgebra::{Matrix3, Vector3};
use assur::{Hana, HanaFamily, HanaMode, HanaPose, HanaSingularKind, MixedReach};
use random::Random;
use serde_json::Value;

fn golden() -> Value {
    let text = std::fs::read_to_string(format!("{}/tests/golden/spatial.json", env!("CARGO_MANIFEST_DIR")));
    serde_json::from_str(&text.expect("the golden file is there")).expect("is JSON")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|x| x.as_f64().expect("a number")).collect()
}

fn three(value: &Value) -> [f64; 3] {
    numbers(value).try_into().expect("three numbers")
}

fn vector(value: &Value) -> Vector3<f64> {
    three(value).into()
}

fn random_robot(random: &mut Random) -> Hana {
    let (r, base) = (random.between(0.5, 4.0), random.between(1.0, 12.0));
    let [l, l3] = [0; 2].map(|_| random.between(2.0, 16.0));
    Hana::new(r, base, l, l3, [[-30.0, 30.0]; 3]).expect("is sound")
}

#[test]
fn golden_numbers_are_met() {
    let data = &golden()["hana"];
    let robot = Hana::example();
    let case = &data["ik_case"];
    let [y, z, phi] = three(&case["pose"]);
    let ways = robot.inverse(&HanaPose::new(y, z, phi)).expect("a pose");
    let solutions = case["solutions"].as_array().expect("a list");
    assert_eq!((ways.modes.len(), solutions.len()), (8, 8));
    for solution in solutions {
        let above: Vec<bool> = numbers(&solution["signs"]).iter().map(|&sign| sign > 0.0).collect();
        let way = ways.modes.iter().find(|way| way.mode.above[..] == above[..]).expect("every mode");
        let off = way.inputs.iter().zip(three(&solution["z"])).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-12, "{}: {off:e}", way.mode);
    }

    let case = &data["diff_case"];
    let [y, z, phi] = three(&case["pose"]);
    let velocity = robot.velocity(&HanaPose::new(y, z, phi), HanaMode::ABOVE).expect("reaches");
    assert!((velocity.input_matrix.diagonal() + vector(&case["A"])).norm() < 1e-12);
    let rows: Vec<Vector3<f64>> = case["B"].as_array().expect("rows").iter().map(vector).collect();
    let matrix = Matrix3::from_rows(&[rows[0].transpose(), rows[1].transpose(), rows[2].transpose()]);
    assert!((velocity.pose_matrix - matrix).norm() < 1e-12);
    assert!((velocity.pose_matrix.determinant() / case["detB"].as_f64().expect("a number") - 1.0).abs() < 1e-12);
    let (rates, accelerations) = (vector(&case["p_dot"]), vector(&case["p_ddot"]));
    let inputs = velocity.input_rates(&rates).expect("regular");
    assert!((inputs - vector(&case["z_dot"])).norm() < 1e-12);
    assert!((velocity.quadratic_term(&rates, &inputs) - vector(&case["bias"])).norm() < 1e-12);
    let second = velocity.input_accelerations(&rates, &accelerations).expect("regular");
    assert!((second - vector(&case["z_ddot"])).norm() < 1e-12);
    assert!((velocity.pose_accelerations(&inputs, &second).expect("regular") - accelerations).norm() < 1e-12);
}

#[test]
fn golden_assemblies_are_complete() {
    let data = &golden()["hana"];
    for case in data["fk_cases"].as_array().expect("cases") {
        let robot = match case.get("geometry") {
            Some(g) => {
                let n = |key: &str| g[key].as_f64().expect("a length");
                Hana::new(n("r"), n("R"), n("L"), n("L3"), [[-30.0, 30.0]; 3]).expect("is sound")
            }
            None => Hana::example(),
        };
        let answer = robot.forward(&three(&case["z"])).expect("finite");
        let expected = case["solutions"].as_array().expect("a list");
        assert_eq!((answer.modes.len(), answer.account.real), (expected.len(), expected.len()), "{case}");
        assert!(answer.account.adds_up() && answer.account.degree == 8);
        for solution in expected {
            let n = |key: &str| solution[key].as_f64().expect("a number");
            let found = answer.modes.iter().find(|mode| {
                let p = mode.pose;
                (p.y - n("y")).abs() + (p.z - n("z")).abs() + (p.phi - n("phi")).sin().abs() < 1e-9
                    && (p.phi - n("phi")).cos() > 0.0
            });
            assert_eq!(found.expect("is found").family.name(), solution["family"].as_str().expect("a name"));
        }
        assert!(answer.modes.iter().all(|mode| mode.residual < 1e-14));
    }
}

#[test]
fn inputs_of_every_pose_lead_back_to_it_and_poses_of_all_inputs_to_them() {
    let mut random = Random::new(1);
    let mut counts = [0; 9];
    for _ in 0..3000 {
        let robot = random_robot(&mut random);
        let pose = HanaPose::new(random.between(-4.0, 4.0), random.between(-9.0, 9.0), random.between(-3.1, 3.1));
        let ways = robot.inverse(&pose).expect("finite");
        for way in &ways.modes {
            let answer = robot.forward(&way.inputs).expect("finite");
            assert!(answer.account.adds_up());
            counts[answer.account.real] += 1;
            let regular = robot.velocity(&pose, way.mode).expect("reaches").singularity().sigma_min;
            let near = |mode: &&assur::HanaAssembly| {
                let p = mode.pose;
                (p.y - pose.y).abs() + (p.z - pose.z).abs() + (p.phi - pose.phi).abs() < 1e-10 / regular
            };
            let found = answer.modes.iter().find(near);
            assert!(found.is_some(), "{robot:?} {pose:?} {way:?}");
            for mode in &answer.modes {
                assert!(mode.residual < 1e-13, "{:e}", mode.residual);
                let back = robot.inverse(&mode.pose).expect("finite");
                let off = |w: &assur::HanaWay| {
                    w.inputs.iter().zip(way.inputs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
                };
                // Near the end of a link's reach its height is known to half the digits.
                let best = back.modes.iter().map(off).fold(f64::INFINITY, f64::min);
                assert!(best < 1e-6, "{best:e}: {robot:?} {mode:?}");
            }
        }
    }
    assert!([2, 4, 6, 8].iter().all(|&count| counts[count] > 0), "{counts:?}");
}

/// The closures of the three links, and their derivatives by y, z, phi.
fn closures(robot: &Hana, [z1, z2, z3]: [f64; 3], x: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    let (r, base) = (robot.platform_radius, robot.base_radius);
    let (s, c) = x.z.sin_cos();
    let (u1, u2, u3) = (x.y - r * s - z1, x.y + r * s - z2, x.y - z3);
    let (across, w) = (base - r * c, x.x + base - r);
    let l = robot.link;
    let value = Vector3::new(
        across * across + x.x * x.x + u1 * u1 - l * l,
        across * across + x.x * x.x + u2 * u2 - l * l,
        w * w + u3 * u3 - robot.third_link * robot.third_link,
    );
    #[rustfmt::skip]
    let slope = 2.0 * Matrix3::new(
        x.x, u1, across * r * s - u1 * r * c,
        x.x, u2, across * r * s + u2 * r * c,
        w, u3, 0.0,
    );
    (value, slope)
}

#[test]
fn newton_from_many_starts_finds_nothing_else() {
    let mut random = Random::new(7);
    let mut eight = 0;
    for _ in 0..60 {
        let robot = if eight == 0 {
            Hana::new(3.0, 12.0, 15.0, 15.0, [[-3.0, 3.0]; 3]).expect("sound")
        } else {
            random_robot(&mut random)
        };
        let inputs = [0; 3].map(|_| random.between(-3.0, 3.0));
        let answer = robot.forward(&inputs).expect("finite");
        eight = eight.max(answer.modes.len());
        let mut seen = vec![false; answer.modes.len()];
        for _ in 0..300 {
            let mut x =
                Vector3::new(random.between(-20.0, 20.0), random.between(-20.0, 20.0), random.between(-3.2, 3.2));
            for _ in 0..60 {
                let (value, slope) = closures(&robot, inputs, &x);
                let Some(step) = slope.lu().solve(&value) else { break };
                x -= step;
            }
            let (value, slope) = closures(&robot, inputs, &x);
            if value.norm().is_nan() || value.norm() > 1e-9 || slope.determinant().abs() < 1e-3 {
                continue;
            }
            let found = answer.modes.iter().position(|mode| {
                let p = mode.pose;
                (p.y - x.x).abs() + (p.z - x.y).abs() + ((p.phi - x.z) / 2.0).sin().abs() < 1e-6
            });
            seen[found.unwrap_or_else(|| panic!("{robot:?} {inputs:?}: {x} is missing"))] = true;
        }
        assert!(seen.iter().filter(|seen| !**seen).count() <= 2, "{robot:?} {inputs:?}: {seen:?}");
    }
}

#[test]
fn rates_and_accelerations_are_those_of_small_steps() {
    let mut random = Random::new(3);
    let mut tried = 0;
    while tried < 400 {
        let robot = random_robot(&mut random);
        let mode = HanaMode::all().nth(tried % 8).expect("eight modes");
        let at = Vector3::from([0; 3].map(|_| random.between(-2.0, 2.0)));
        let [rates, second] = [0; 2].map(|_| Vector3::from([0; 3].map(|_| random.between(-1.0, 1.0))));
        let pose = |t: f64| {
            let x = at + rates * t + second * (0.5 * t * t);
            HanaPose::new(x.x, x.y, x.z)
        };
        let Ok(velocity) = robot.velocity(&pose(0.0), mode) else { continue };
        if velocity.singularity().sigma_min_input < 0.2 {
            continue;
        }
        tried += 1;
        let inputs = |t: f64| Vector3::from(robot.inputs_at(&pose(t), mode).expect("reaches"));
        let h = 1e-3;
        let first = (8.0 * (inputs(h) - inputs(-h)) - (inputs(2.0 * h) - inputs(-2.0 * h))) / (12.0 * h);
        let double = (16.0 * (inputs(h) + inputs(-h)) - (inputs(2.0 * h) + inputs(-2.0 * h)) - 30.0 * inputs(0.0))
            / (12.0 * h * h);
        assert!((velocity.input_rates(&rates).expect("regular") - first).norm() < 1e-6);
        let found = velocity.input_accelerations(&rates, &second).expect("regular");
        assert!((found - double).norm() < 1e-3 * (1.0 + double.norm()), "{found} {double}");
    }
}

#[test]
fn singularities_are_named() {
    let robot = Hana::example();
    let kind = |pose: HanaPose, mode: &str| {
        let mode = mode.parse().expect("a mode");
        robot.velocity(&pose, mode).expect("reaches").singularity()
    };
    assert_eq!(kind(HanaPose::new(-2.0, -12.0, 0.4), "+++").kind, HanaSingularKind::None);
    // y² = L² - (R - r)² = 144 at phi = 0: links 1 and 2 lie level; leg 3 reaches y = -12.
    let level = kind(HanaPose::new(-12.0, 0.0, 0.0), "+++");
    assert_eq!((level.kind, &level.level_legs[..]), (HanaSingularKind::Type3, &[1, 2][..]));
    let quarter = kind(HanaPose::new(1.0, -10.0, std::f64::consts::FRAC_PI_2), "+++");
    assert_eq!((quarter.kind, quarter.reading.len()), (HanaSingularKind::Type2, 1));
    // Eqs. (45), (46): published -25.42 and 1.42; only with the sliders on opposite sides.
    let mixed = robot.mixed_singularities(0.0, -12.0).expect("finite");
    assert_eq!(mixed.len(), 3, "two stretched, the folded one at a half turn: {mixed:?}");
    assert!((mixed[0].inputs[0] + 12.0 + 180.0_f64.sqrt()).abs() < 1e-12);
    assert!((mixed[0].inputs[1] + 12.0 - 180.0_f64.sqrt()).abs() < 1e-12);
    assert!(mixed.iter().all(|m| !m.within_strokes));
    assert_eq!(mixed[2].phi, std::f64::consts::PI);
    for m in &mixed[..2] {
        let pose = HanaPose::new(0.0, -12.0, m.phi);
        let above = [m.inputs[0] > pose.z - 3.0 * m.phi.sin(), m.inputs[1] > pose.z + 3.0 * m.phi.sin(), true];
        let velocity = robot.velocity(&pose, HanaMode { above }).expect("reaches");
        assert!((velocity.inputs[0] - m.inputs[0]).abs() < 1e-12, "{m:?} {velocity:?}");
        let singular = velocity.singularity();
        assert_eq!(singular.kind, HanaSingularKind::Type2);
        assert_eq!(singular.reading, ["links 1 and 2 lie in the plane of the platform"]);
    }
    // The published strokes reach none anywhere; with a longer one of leg 3 they do, near the ends of the reach of legs 1 and 2.
    assert_eq!(robot.mixed_reach(), MixedReach::Nowhere);
    let longer = Hana { strokes: [[-3.0, 3.0], [-3.0, 3.0], [-20.0, 20.0]], ..robot };
    let MixedReach::At { y, z } = longer.mixed_reach() else { panic!("{:?}", longer.mixed_reach()) };
    assert!(longer.mixed_singularities(y, z).expect("finite").iter().any(|m| m.within_strokes));
}

#[test]
fn another_unit_of_length_changes_nothing() {
    for factor in [1e-6, 1e6] {
        let robot =
            Hana::new(3.0 * factor, 12.0 * factor, 15.0 * factor, 15.0 * factor, [[-3.0 * factor, 3.0 * factor]; 3]);
        let robot = robot.expect("is sound");
        let there = robot.forward(&[factor, -0.5 * factor, 0.3 * factor]).expect("finite");
        let here = Hana::example().forward(&[1.0, -0.5, 0.3]).expect("finite");
        assert_eq!(there.modes.len(), here.modes.len());
        for (a, b) in there.modes.iter().zip(&here.modes) {
            assert!((a.pose.y / factor - b.pose.y).abs() + (a.pose.phi - b.pose.phi).abs() < 1e-12);
            assert_eq!((a.mode, a.family), (b.mode, b.family));
        }
    }
    assert!(
        Hana::example()
            .forward(&[1.0, -0.5, 0.3])
            .expect("finite")
            .modes
            .iter()
            .any(|m| m.family == HanaFamily::SameSide)
    );
}

#[test]
fn workspaces_have_the_golden_areas_and_corners() {
    let data = &golden()["hana"]["workspace"];
    let robot = Hana::example();
    let number = |value: &Value| value.as_f64().expect("a number");
    let level = robot.workspace(0.0, HanaMode::ABOVE).expect("finite");
    assert!((level.area - number(&data["phi0"]["area_exact"])).abs() < 1e-11);
    let corners: Vec<[f64; 2]> = level.loops[0].1.iter().map(|arc| arc.start).collect();
    for corner in data["phi0"]["vertices"].as_object().expect("corners").values() {
        let [y, z] = numbers(corner)[..] else { panic!("two numbers") };
        let found = corners.iter().any(|c| (c[0] - y).abs() + (c[1] - z).abs() < 1e-12);
        // The top and the bottom are where arcs of leg 1 and leg 2, the same at phi = 0, are lowest.
        assert!(found || y == 0.0, "{corner} {corners:?}");
    }
    for case in data["const_orientation_area"].as_array().expect("cases") {
        let phi = number(&case["phi_deg"]).to_radians();
        let area = robot.workspace(phi, HanaMode::ABOVE).expect("finite").area;
        assert!((area - number(&case["area"])).abs() < 1e-5, "{case}: {area}");
    }
    let reachable = robot.reachable_workspace(HanaMode::ABOVE).expect("is covered");
    assert!((reachable.area - number(&data["reachable_absphi_le_90"]["area_exact"])).abs() < 1e-11);
    let right = numbers(&data["reachable_absphi_le_90"]["vertex_right"]);
    assert!(
        reachable.loops[0]
            .1
            .iter()
            .any(|arc| (arc.start[0] - right[0]).abs() + (arc.start[1] - right[1]).abs() < 1e-12)
    );
    // The mirror image: every slider below.
    let below = HanaMode { above: [false; 3] };
    assert!((robot.reachable_workspace(below).expect("is covered").area - reachable.area).abs() < 1e-11);
}

/// Whether a place is reached in some orientation, by inverse kinematics alone.
fn reached(robot: &Hana, y: f64, z: f64, orientations: &[f64]) -> bool {
    orientations.iter().any(|&phi| {
        robot
            .inputs_at(&HanaPose::new(y, z, phi), HanaMode::ABOVE)
            .is_ok_and(|inputs| robot.violations(&inputs).is_empty())
    })
}

/// Heights that are reached above one `y` in mode `+++`, over the orientations from 0 to `last`; they are one interval, since they change continuously.
fn column(robot: &Hana, y: f64, steps: u32, last: f64) -> f64 {
    let (r, base) = (robot.platform_radius, robot.base_radius);
    let [[a1, b1], [a2, b2], [a3, b3]] = robot.strokes;
    let third = robot.third_link.powi(2) - (y + base - r).powi(2);
    let mut all: Option<[f64; 2]> = None;
    for k in 0..=steps {
        let (s, c) = (last * f64::from(k) / f64::from(steps.max(1))).sin_cos();
        let square = robot.link.powi(2) - (base - r * c).powi(2) - y * y;
        if square < 0.0 || third < 0.0 {
            continue;
        }
        let (n, n3) = (square.sqrt(), third.sqrt());
        let low = (a1 + r * s - n).max(a2 - r * s - n).max(a3 - n3);
        let high = (b1 + r * s - n).min(b2 - r * s - n).min(b3 - n3);
        if low <= high + 1e-12 {
            all = Some(all.map_or([low, high], |[l, h]| [l.min(low), h.max(high)]));
        }
    }
    all.map_or(0.0, |[low, high]| high - low)
}

fn integrated(robot: &Hana, steps: u32, last: f64) -> f64 {
    let n = 4000;
    let width = 2.0 * robot.link / f64::from(n);
    (0..n).map(|k| width * column(robot, -robot.link + (f64::from(k) + 0.5) * width, steps, last)).sum()
}

#[test]
fn areas_are_those_of_integration() {
    // The independent check of the two areas in print, 31.7521 and 32.7980, which are perimeters.
    let robot = Hana::example();
    let perimeters = [
        robot.workspace(0.0, HanaMode::ABOVE).expect("finite"),
        robot.reachable_workspace(HanaMode::ABOVE).expect("is covered"),
    ]
    .map(|region| region.perimeter);
    assert!((perimeters[0] - 31.7521).abs() < 5e-5 && (perimeters[1] - 32.7980).abs() < 5e-5, "{perimeters:?}");
    let level = integrated(&robot, 0, 0.0);
    // Midpoints over 4000 columns: the error is at most a width, 30/4000, times the jump of a column where the region ends, which is 0 at its corners.
    assert!((level - 43.453_703).abs() < 1e-2, "{level}");
    let any = integrated(&robot, 90, std::f64::consts::FRAC_PI_2);
    assert!((any - 44.244_826).abs() < 1e-2, "{any}");
}

/// Whether a place is reached in a mode by some orientation of a range, by inverse kinematics on a fine scan alone: `None` where the scan is too close to call.
fn scanned(robot: &Hana, mode: HanaMode, [y, z]: [f64; 2], [from, to]: [f64; 2]) -> Option<bool> {
    // Half a step is at most 1e-3. A slider's height changes by at most r (1 + (R + r)/N) for each radian, below 50 unless its link is within a percent of level (r < 5, R < 6,
    // N > 1): what is over 0.05 at the best step, or under -0.05, is not decided by what lies between steps. Places nearer than that are left out.
    let steps = 3000;
    let slack = |phi: f64| {
        let (r, base) = (robot.platform_radius, robot.base_radius);
        let (s, c) = phi.sin_cos();
        let (square, third) =
            (robot.link.powi(2) - (base - r * c).powi(2) - y * y, robot.third_link.powi(2) - (y + base - r).powi(2));
        if square < 0.0 || third < 0.0 {
            return square.min(third);
        }
        let sign = |leg: usize| if mode.above[leg] { 1.0 } else { -1.0 };
        let sliders =
            [z - r * s + sign(0) * square.sqrt(), z + r * s + sign(1) * square.sqrt(), z + sign(2) * third.sqrt()];
        let rooms = sliders.iter().zip(robot.strokes).map(|(x, [low, high])| (x - low).min(high - x));
        rooms.fold(f64::INFINITY, f64::min)
    };
    let best = (0..=steps)
        .map(|k| slack(from + (to - from) * f64::from(k) / f64::from(steps)))
        .fold(f64::NEG_INFINITY, f64::max);
    (best.abs() > 0.05).then_some(best > 0.0)
}

/// Whether a place lies within a region, by how often a ray crosses its boundary.
fn enclosed(region: &assur::ArcRegion, [y, z]: [f64; 2]) -> bool {
    let mut crossings = 0;
    for arc in region.loops.iter().flat_map(|(_, arcs)| arcs) {
        for pair in arc.points(240).windows(2) {
            let ([y1, z1], [y2, z2]) = (pair[0], pair[1]);
            if (y1 > y) != (y2 > y) && z1 + (y - y1) / (y2 - y1) * (z2 - z1) > z {
                crossings += 1;
            }
        }
    }
    crossings % 2 == 1
}

/// Area within a boundary drawn with many points, by Green's theorem.
fn drawn_area(region: &assur::ArcRegion) -> f64 {
    let arcs = region.loops.iter().flat_map(|(_, arcs)| arcs);
    arcs.flat_map(|arc| {
        let points = arc.points(2000);
        (1..points.len())
            .map(|k| 0.5 * (points[k - 1][0] * points[k][1] - points[k][0] * points[k - 1][1]))
            .collect::<Vec<_>>()
    })
    .sum()
}

#[test]
fn reachable_workspaces_of_any_design_are_those_of_a_scan() {
    let mut random = Random::new(11);
    let mut curves = std::collections::BTreeMap::new();
    let (mut places, mut insides, mut holes) = (0, 0, 0);
    let scale: usize = std::env::var("ASSUR_TEST_SCALE").ok().and_then(|text| text.parse().ok()).unwrap_or(1);
    for trial in 0..96 * scale {
        // Any strokes, sliders on either side, platforms smaller and larger than the base, ranges of orientations.
        let (r, base) = (random.between(0.5, 5.0), random.between(1.0, 6.0));
        let (l, l3) = (random.between(3.0, 9.0), random.between(3.0, 9.0));
        let strokes = [0; 3].map(|_| {
            let low = random.between(-4.0, 3.0);
            [low, low + random.between(0.3, 6.0)]
        });
        let robot = Hana::new(r, base, l, l3, strokes).expect("is sound");
        let mode = HanaMode::all().nth(trial % 8).expect("eight modes");
        let quarter = std::f64::consts::FRAC_PI_2;
        let range = match trial % 3 {
            0 => [-quarter, quarter],
            1 => {
                let from = random.between(-3.0, 3.0);
                [from, from + random.between(0.2, 4.0)]
            }
            _ => [-2.0 * quarter, 2.0 * quarter],
        };
        let region = robot.reachable_between(mode, range).expect("finite");
        assert!((drawn_area(&region) - region.area).abs() < 1e-3 * (1.0 + region.area), "{robot:?} {mode} {range:?}");
        holes += region.holes();
        for arc in region.loops.iter().flat_map(|(_, arcs)| arcs) {
            *curves.entry(arc.curve.name()).or_insert(0) += 1;
            assert!(arc.length > 0.0 && arc.start.iter().chain(&arc.end).all(|x| x.is_finite()), "{arc:?}");
        }
        for (_, arcs) in &region.loops {
            for (k, arc) in arcs.iter().enumerate() {
                let next = &arcs[(k + 1) % arcs.len()];
                let gap = (arc.end[0] - next.start[0]).hypot(arc.end[1] - next.start[1]);
                assert!(gap < 1e-5, "{gap:e} {robot:?} {mode} {range:?}");
            }
        }
        let [low, high] = region.bbox.map_or(([-8.0; 2], [8.0; 2]), |b| ([b[0], b[1]], [b[2], b[3]])).into();
        for _ in 0..60 {
            let place: [f64; 2] = std::array::from_fn(|k| random.between(low[k] - 1.0, high[k] + 1.0));
            let Some(expected) = scanned(&robot, mode, place, range) else { continue };
            places += 1;
            insides += usize::from(expected);
            assert_eq!(enclosed(&region, place), expected, "{place:?} {robot:?} {mode} {range:?}");
        }
    }
    assert!(places > 2000 && insides > 150, "{places} {insides}");
    assert!(["circle", "line", "spiric", "level link"].iter().all(|name| curves.contains_key(name)), "{curves:?}");
    println!("{places} places, {insides} inside, {holes} holes, {curves:?}");
}

#[test]
fn another_unit_of_length_changes_no_workspace() {
    let strokes = [[-1.0, 4.0], [0.5, 3.0], [-2.0, 5.0]];
    let robot = Hana::new(3.0, 2.0, 5.0, 4.0, strokes).expect("is sound");
    let here = robot.reachable_workspace(HanaMode::ABOVE).expect("finite");
    assert!(here.area > 0.0);
    for factor in [1e-6, 1e6, 1e-50, 1e50] {
        let scaled = strokes.map(|stroke| stroke.map(|end| end * factor));
        let robot = Hana::new(3.0 * factor, 2.0 * factor, 5.0 * factor, 4.0 * factor, scaled).expect("is sound");
        let there = robot.reachable_workspace(HanaMode::ABOVE).expect("finite");
        let ratio = there.area / factor / factor / here.area;
        assert!((ratio - 1.0).abs() < 1e-9, "{factor:e} {ratio} {} {}", here.area, there.loops.len());
        assert_eq!(there.loops.len(), here.loops.len());
        assert!((there.perimeter / factor / here.perimeter - 1.0).abs() < 1e-9);
    }
}

#[test]
fn capabilities_are_golden() {
    let data = &golden()["hana"];
    for case in data["capability"].as_array().expect("cases") {
        let n = |key: &str| case[key].as_f64().expect("a number");
        let [low, high] = numbers(&case["range"])[..] else { panic!("a range") };
        // The golden values are of legs 1 and 2 alone; leg 3 is given the room it needs.
        let robot = Hana { strokes: [[low, high], [low, high], [-60.0, 60.0]], ..Hana::example() };
        let zeta =
            robot.capability([n("y"), n("z")], HanaMode::ABOVE).expect("finite").map_or(0.0, |c| c.zeta.to_degrees());
        assert!((zeta - n("zeta_deg")).abs() < 1e-9, "{case}: {zeta}");
    }
    let best = Hana::example().capability_supremum(HanaMode::ABOVE).expect("is covered").expect("is not empty");
    let expected = &data["capability_sup"];
    assert!((best.zeta.to_degrees() - expected["zeta_sup"].as_f64().expect("a number")).abs() < 1e-8);
    assert!(
        (best.at[1] - expected["z_crit_at_y0"].as_f64().expect("a number")).abs() < 1e-9 && best.at[0].abs() < 1e-6
    );
    let longer = Hana::example().with_strokes(4.0).expect("is sound");
    assert!(longer.capability_supremum(HanaMode::ABOVE).expect("is covered").expect("is not empty").zeta > best.zeta);
}

#[test]
fn tilting_ends_where_a_scan_says() {
    let mut random = Random::new(5);
    let mut tried = 0;
    while tried < 200 {
        let h = random.between(1.0, 5.0);
        let robot = Hana::new(
            random.between(1.0, 4.0),
            random.between(5.0, 12.0),
            random.between(11.0, 16.0),
            random.between(11.0, 16.0),
            [[-h, h], [-h, random.between(0.5, h)], [-9.0, 9.0]],
        );
        let robot = robot.expect("is sound");
        let at = [random.between(-8.0, 8.0), random.between(-15.0, 0.0)];
        let Some(found) = robot.capability(at, HanaMode::ABOVE).expect("finite") else { continue };
        tried += 1;
        for side in 0..2 {
            let end = found.range[side];
            let inside = |phi: f64| reached(&robot, at[0], at[1], &[phi]);
            assert!((0..200).all(|k| inside(end * f64::from(k) / 200.0)), "{robot:?} {at:?} {found:?}");
            let singular =
                matches!(found.stops[side], assur::CapabilityStop::QuarterTurn | assur::CapabilityStop::InLine);
            assert!(singular || !inside(end + end.signum() * 1e-9), "{robot:?} {at:?} {found:?}");
        }
    }
}

#[test]
fn no_scanned_place_tilts_farther_than_the_supremum() {
    const SIDE: u32 = 60;
    let (mut random, mut tried, mut unequal) = (Random::new(77), 0, 0);
    while tried < 60 {
        let mut ends = || [-random.between(0.5, 4.0), random.between(0.5, 4.0)];
        let (one, two, three) = (ends(), ends(), ends());
        let radii = [random.between(1.0, 4.0), random.between(5.0, 12.0)];
        let links = [random.between(10.0, 16.0), random.between(10.0, 16.0)];
        let two = if tried % 3 == 0 { one } else { two };
        let robot = Hana::new(radii[0], radii[1], links[0], links[1], [one, two, three]).expect("is sound");
        let Some(best) = robot.capability_supremum(HanaMode::ABOVE).expect("is covered") else { continue };
        let Some([low_y, low_z, high_y, high_z]) = robot.workspace(0.0, HanaMode::ABOVE).expect("finite").bbox else {
            panic!("a supremum over nothing: {robot:?}")
        };
        tried += 1;
        unequal += usize::from(one != two);
        let place = |k: u32, n: u32| {
            let part = |k: u32, low: f64, high: f64| low + (high - low) * f64::from(k) / f64::from(SIDE);
            [part(k, low_y, high_y), part(n, low_z, high_z)]
        };
        let zeta = |at: [f64; 2]| robot.capability(at, HanaMode::ABOVE).expect("finite").map_or(0.0, |c| c.zeta);
        let scanned = (0..=SIDE).flat_map(|k| (0..=SIDE).map(move |n| (k, n))).map(|(k, n)| zeta(place(k, n)));
        let most = scanned.fold(0.0, f64::max);
        assert!(best.zeta >= most - 1e-9, "{robot:?} {best:?} {most}");
        // It is had there, or approached; on an edge of the workspace rounding decides which side is in.
        let aside = if best.attained { 1e-9 } else { 1e-6 };
        let near = [0.0, aside, -aside].map(|d| zeta([best.at[0], best.at[1] + d])).into_iter().fold(0.0, f64::max);
        // At a jump the angle can leave like the root of the distance.
        assert!(near >= best.zeta - 10.0 * f64::sqrt(aside), "{robot:?} {best:?} {near}");
    }
    assert!(unequal > 30, "{unequal}");
}

#[test]
fn what_unequal_strokes_have_in_common_counts() {
    let with = |one: [f64; 2], two: [f64; 2]| {
        let robot = Hana { strokes: [one, two, [-3.0, 3.0]], ..Hana::example() };
        robot.capability_supremum(HanaMode::ABOVE).expect("is covered")
    };
    let common = with([-3.0, 3.0], [-3.0, 3.0]);
    assert_eq!(with([-3.0, 4.0], [-5.0, 3.0]), common);
    assert_eq!(with([-5.0, 3.0], [-3.0, 4.0]), common);
    assert_eq!(with([1.0, 2.0], [-2.0, -1.0]), None);
}

#[test]
fn nothing_tilts_where_a_slider_is_at_its_end() {
    // On the circles of sliders 1 and 2, level: printed as (ii). Leg 3 is given the room it needs.
    let robot = Hana { strokes: [[-3.0, 3.0], [-3.0, 3.0], [-60.0, 60.0]], ..Hana::example() };
    let mut inside = 0;
    for k in -100..=50 {
        let y = f64::from(k) * 0.05;
        for end in [-3.0, 3.0] {
            let z = end - (144.0 - y * y).sqrt();
            if let Some(found) = robot.capability([y, z], HanaMode::ABOVE).expect("finite") {
                inside += 1;
                assert!(found.zeta < 1e-6, "{y} {z} {found:?}");
            }
        }
    }
    assert!(inside > 100, "{inside}");
}

/// What is shown to bound every place does: against places anywhere and against climbing from the best of them, in all modes that have the index, for platforms larger than the base as well.
#[test]
fn no_place_exceeds_the_bound() {
    const PLACES: usize = 1500;
    let mut random = Random::new(2004);
    let (mut tried, mut tight, mut climbed, mut in_line, mut large) = (0, 0, 0, 0, 0);
    while tried < 120 {
        let above = [[true, true], [false, false]][tried % 2];
        let mode = HanaMode { above: [above[0], above[1], tried % 4 < 2] };
        let mut ends = || {
            let low = random.between(-6.0, 2.0);
            [low, low + random.between(0.5, 9.0)]
        };
        let (one, three) = (ends(), ends());
        let radii = [random.between(1.0, 8.0), random.between(1.0, 12.0)];
        let links = [random.between(4.0, 16.0), random.between(4.0, 16.0)];
        let robot = Hana::new(radii[0], radii[1], links[0], links[1], [one, one, three]).expect("is sound");
        let Some(best) = robot.capability_supremum(mode).expect("is covered") else { continue };
        tried += 1;
        tight += usize::from(best.at_most - best.zeta <= 1.1e-9);
        large += usize::from(radii[0] > radii[1]);
        assert!((0.0..=1e-6).contains(&(best.at_most - best.zeta)), "{robot:?} {mode} {best:?}");
        let region = robot.workspace(0.0, mode).expect("finite");
        let boxes: Vec<[[f64; 2]; 2]> = region
            .loops
            .iter()
            .map(|(_, arcs)| {
                let side = |k: usize| {
                    let ends = arcs.iter().map(|arc| arc.start[k]);
                    [ends.clone().fold(f64::INFINITY, f64::min), ends.fold(f64::NEG_INFINITY, f64::max)]
                };
                [side(0), side(1)]
            })
            .collect();
        let zeta = |at: [f64; 2]| {
            let found = robot.capability(at, mode).expect("finite");
            let stops = found.map_or([assur::CapabilityStop::Level; 2], |found| found.stops);
            (found.map_or(0.0, |found| found.zeta), stops.contains(&assur::CapabilityStop::InLine))
        };
        let (mut most, mut place) = (0.0, [0.0; 2]);
        let mut width = boxes[0].map(|[low, high]| high - low);
        for k in 0..2 * PLACES {
            let within = boxes[k % boxes.len()];
            let anywhere = within.map(|[low, high]| random.between(low, high));
            let beside = [0, 1].map(|k| place[k] + random.between(-width[k], width[k]));
            let at = if k < PLACES { anywhere } else { beside };
            let (found, line) = zeta(at);
            assert!(found <= best.at_most, "{robot:?} {mode} {at:?} {found} {best:?}");
            in_line += usize::from(line);
            if found > most {
                (most, place) = (found, at);
            } else if k > PLACES {
                width = width.map(|w| w * 0.99);
            }
        }
        climbed += usize::from(most >= best.zeta - 0.01);
    }
    // Climbing at random does not end in every corner.
    assert!(tight >= 100 && climbed >= 100 && in_line > 100 && large > 10, "{tight} {climbed} {in_line} {large}");
}
