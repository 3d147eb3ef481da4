//! The three-legged robots: golden numbers, round trips, finite differences, and a second opinion by Newton's method from many starts.

mod random;

use assur::nalgebra::{Matrix3, Rotation3, Vector3, Vector6};
use assur::{
    CartesianRobot, CartesianSingular, Counted, Hexapteron, PlaneConditions, Quadrupteron, Tripod, TripodDesign,
    TripodLeg, TripodPose, TripodSingularity, TripodStatus, TripodTorsions,
};
use random::Random;
use serde_json::Value;

fn golden() -> Value {
    let text = std::fs::read_to_string(format!("{}/tests/golden/spatial.json", env!("CARGO_MANIFEST_DIR")));
    serde_json::from_str(&text.expect("the golden file is there")).expect("is JSON")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|x| x.as_f64().expect("a number")).collect()
}

fn vector(value: &Value) -> Vector3<f64> {
    Vector3::from_vec(numbers(value))
}

fn six(first: &Value, last: &Value) -> Vector6<f64> {
    Vector6::from_vec([numbers(first), numbers(last)].concat())
}

fn matrix(value: &Value) -> Matrix3<f64> {
    let rows: Vec<_> = value.as_array().expect("rows").iter().map(|row| vector(row).transpose()).collect();
    Matrix3::from_rows(&rows)
}

/// How far two rotations are apart; for small angles sqrt(2) times the angle.
fn apart(a: &Rotation3<f64>, b: &Rotation3<f64>) -> f64 {
    (a.matrix() - b.matrix()).norm()
}

fn pose(case: &Value) -> TripodPose {
    TripodPose::with_matrix(vector(&case["p"]), matrix(&case["R"])).expect("a rotation")
}

/// The pose, the inputs, the Jacobian and all assemblies of a golden case.
fn check(robot: &Tripod, case: &Value) {
    let pose = pose(case);
    let inputs = robot.inverse(&pose).expect("regular");
    for (found, expected) in inputs.iter().zip(numbers(&case["rho"])) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
    let velocity = robot.velocity(&pose).expect("regular");
    for (row, expected) in case["J"].as_array().expect("rows").iter().enumerate() {
        for (found, expected) in velocity.jacobian.row(row).iter().zip(numbers(expected)) {
            assert!((found - expected).abs() < 1e-9 * (1.0 + expected.abs()), "{found} {expected}");
        }
    }
    let determinant = case["detJ"].as_f64().expect("a number");
    assert!((velocity.jacobian.determinant() / determinant - 1.0).abs() < 1e-9);
    let answer = robot.forward(&inputs).expect("finite");
    assert_eq!(answer.status, TripodStatus::Complete);
    let expected = case["fk_all"].as_array().expect("solutions");
    assert_eq!(answer.modes.len() + answer.spurious.len(), expected.len());
    for solution in expected {
        let wanted = self::pose(solution);
        let spurious = solution["spurious"].as_bool().unwrap_or(false);
        let list = if spurious { &answer.spurious } else { &answer.modes };
        let found = list.iter().find(|mode| {
            apart(&mode.pose.rotation, &wanted.rotation) < 1e-9 && (mode.pose.position - wanted.position).norm() < 1e-9
        });
        assert!(found.is_some(), "{solution}");
    }
    assert!(answer.account.adds_up());
    assert!(answer.modes.iter().all(|mode| mode.residual < 1e-12));
}

#[test]
fn golden_robots() {
    let data = &golden()["tripod6"];
    let cartesian = Tripod::cartesian(600.0, 720.0).expect("is sound");
    check(&cartesian, &data["cartesian"]);
    for (name, robot) in [
        ("fig8a", Tripod::inclined(15_f64.to_radians(), 600.0, 720.0)),
        ("fig8b", {
            let square = (110_f64.to_radians().cos() + 0.5) / 1.5;
            Tripod::upright(square.sqrt().asin(), 600.0, 720.0)
        }),
    ] {
        let robot = robot.expect("is sound");
        let geometry = &data[name]["geometry"];
        for (k, leg) in robot.legs.iter().enumerate() {
            for (key, value) in [("u", leg.u), ("w", leg.w), ("v", leg.v), ("c", leg.c), ("Da", leg.da), ("Db", leg.db)]
            {
                assert!((value - vector(&geometry[key][k])).norm() < 1e-9, "{name} {key}");
            }
        }
        check(&robot, &data[name]);
    }
}

#[test]
fn golden_rates_and_accelerations() {
    let case = &golden()["tripod6"]["cartesian"];
    let robot = Tripod::cartesian(600.0, 720.0).expect("is sound");
    let velocity = robot.velocity(&pose(case)).expect("regular");
    let (rates, second) = (six(&case["p_dot"], &case["omega"]), six(&case["p_ddot"], &case["alpha"]));
    let inputs = velocity.input_rates(&rates);
    let list = |key: &str| Vector6::from_vec(numbers(&case[key]));
    assert!((inputs - list("rho_dot")).norm() < 1e-9);
    assert!((velocity.bias(&rates) - list("bias")).norm() < 1e-9);
    let accelerations = velocity.input_accelerations(&rates, &second);
    assert!((accelerations - list("rho_ddot")).norm() < 1e-9);
    assert!((velocity.pose_rates(&inputs).expect("regular") - rates).norm() < 1e-9);
    assert!((velocity.pose_accelerations(&inputs, &accelerations).expect("regular") - second).norm() < 1e-9);
}

#[test]
fn the_cartesian_formulas_are_the_general_robot_on_their_branch() {
    let (closed, general) = (CartesianRobot { d1: 600.0, d2: 720.0 }, Tripod::cartesian(600.0, 720.0).expect("sound"));
    let mut random = Random::new(2);
    let mut tried = 0;
    for _ in 0..3000 {
        let axis = Vector3::from_fn(|_, _| random.between(-0.9, 0.9));
        let pose = TripodPose::new(Vector3::from_fn(|_, _| random.between(-300.0, 300.0)), axis);
        let diagonal = pose.rotation.matrix().diagonal();
        if diagonal.min() < 0.1 {
            continue;
        }
        tried += 1;
        let inputs = closed.inverse(&pose).expect("within a quarter turn");
        let others = general.inverse(&pose).expect("regular");
        assert!(inputs.iter().zip(others).all(|(a, b)| (a - b).abs() < 1e-9));
        let back = closed.forward(&inputs).expect("T > -1");
        let determinant = general.velocity(&pose).expect("regular").jacobian.determinant();
        let t: f64 = [0, 2, 4].iter().map(|k| (inputs[k + 1] - inputs[*k]) / 120.0).product();
        let allowed = 1e-11 / f64::min((1.0 - t).abs(), 1.0 + t);
        assert!(apart(&back.rotation, &pose.rotation) < allowed, "{t}");
        assert!((back.position - pose.position).norm() < 1e4 * allowed, "{t}");
        let formula = closed.jacobian_determinant(&inputs).expect("T > -1");
        assert!((formula - determinant).abs() < 1e-9 * determinant.abs().max(1e3), "{formula} {determinant}");
    }
    assert!(tried > 1000);
    let steep = |t: f64| closed.forward(&[0.0, 120.0 * t, 0.0, 120.0 * t, 0.0, 120.0 * t]);
    assert!(matches!(steep(-2.0), Err(CartesianSingular::NoProperRotation { .. })));
    assert!(matches!(steep(-1.0), Err(CartesianSingular::Orientation { .. })));
    assert!(matches!(steep(1.0), Err(CartesianSingular::Position { .. })));
    assert_eq!(closed.jacobian_determinant(&[0.0, 120.0, 0.0, 120.0, 0.0, 120.0]), Ok(0.0));
    // The case for which the paper's formulas return a reflection: the general robot finds four proper rotations, none with a positive diagonal.
    let case = &golden()["tripod6"]["delta_negative_case"];
    let inputs: [f64; 6] = numbers(&case["rho"]).try_into().expect("six");
    let answer = general.forward(&inputs).expect("finite");
    assert_eq!((answer.modes.len(), answer.spurious.len()), (4, 4));
    assert!(answer.modes.iter().all(|mode| mode.pose.rotation.matrix().diagonal().min() < 0.0));
}

#[test]
fn both_singularities_are_named() {
    let general = Tripod::cartesian(600.0, 720.0).expect("sound");
    // T = 1: all planes at 45°.
    let answer = general.forward(&[0.0, 120.0, 0.0, 120.0, 0.0, 120.0]).expect("finite");
    assert_eq!(answer.status, TripodStatus::PositionFree);
    let mut random = Random::new(4);
    let mut seen = 0;
    for _ in 0..60 {
        // A pose in which the orientation is not determined, by bisection along a turn of a random robot.
        let robot = random_robot(&mut random);
        let axis = direction(&mut random);
        let at = |angle: f64| robot.velocity(&TripodPose::new(Vector3::new(1.0, 2.0, 3.0), axis * angle));
        let volume = |angle: f64| at(angle).map_or(f64::NAN, |velocity| velocity.orientation_volume);
        let angles: Vec<f64> = (1..150).map(|k| f64::from(k) * 0.02).collect();
        let crossing = |p: &&[f64]| volume(p[0]) * volume(p[1]) < 0.0 && (volume(p[0]) - volume(p[1])).abs() < 0.2;
        let Some(&[mut low, mut high]) = angles.windows(2).find(crossing) else { continue };
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if volume(low) * volume(middle) <= 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        let velocity = at(low).expect("regular");
        seen += 1;
        assert_eq!(velocity.singularity(), TripodSingularity::Orientation);
        assert!(velocity.pose_rates(&Vector6::repeat(1.0)).is_err());
        // Two solutions meet there.
        let answer = robot.forward(&velocity.inputs).expect("finite");
        assert!(
            answer
                .modes
                .iter()
                .any(|mode| mode.multiplicity == 2 && apart(&mode.pose.rotation, &velocity.pose.rotation) < 1e-4)
        );
    }
    // T = -1 for the Cartesian robot: the four true rotations have run into the four spurious ones.
    let answer = general.forward(&[0.0, -120.0, 0.0, -120.0, 0.0, -120.0]).expect("finite");
    assert_eq!((answer.modes.len(), answer.spurious.len(), answer.account.rejected), (0, 4, 8));
    assert!(seen > 0);
    // Figure 8: singular everywhere with horizontal rails; with level axes on vertical rails at zero tilt and any torsion, and not when tilted.
    let flat = Tripod::inclined(0.0, 600.0, 720.0).expect("sound");
    let coplanar = Tripod::upright(0.0, 600.0, 720.0).expect("sound");
    for _ in 0..50 {
        let axis = Vector3::from_fn(|_, _| random.between(-0.5, 0.5));
        let pose = TripodPose::new(Vector3::zeros(), axis);
        assert!(flat.velocity(&pose).is_ok_and(|v| v.position_volume.abs() < 1e-12));
        let torsion = TripodPose::new(Vector3::zeros(), Vector3::z() * axis.z);
        assert!(coplanar.velocity(&torsion).is_ok_and(|v| v.singularity() != TripodSingularity::None));
    }
    let tilted = TripodPose::new(Vector3::zeros(), Vector3::new(0.31, 0.1, 0.0));
    assert_eq!(coplanar.velocity(&tilted).expect("regular").singularity(), TripodSingularity::None);
}

fn direction(random: &mut Random) -> Vector3<f64> {
    Vector3::from_fn(|_, _| random.between(-1.0, 1.0)).normalize()
}

fn random_robot(random: &mut Random) -> Tripod {
    let legs = [0; 3].map(|_| {
        let u = direction(random);
        let w = u.cross(&direction(random)).normalize();
        let across = w.cross(&u);
        let da = across * random.between(2.0, 5.0) + w * random.between(-1.0, 1.0);
        TripodLeg { u, w, v: direction(random), c: direction(random), da, db: da + across * random.between(0.5, 1.5) }
    });
    Tripod::new(legs).expect("is sound")
}

#[test]
fn every_pose_is_found_again_from_its_inputs() {
    let mut random = Random::new(5);
    let mut counts = [0; 9];
    for _ in 0..1500 {
        let robot = random_robot(&mut random);
        let pose = TripodPose::new(direction(&mut random), direction(&mut random) * random.between(0.0, 3.1));
        let Ok(velocity) = robot.velocity(&pose) else { continue };
        if velocity.position_volume.abs() < 1e-3 || velocity.orientation_volume.abs() < 1e-3 {
            continue;
        }
        let answer = robot.forward(&velocity.inputs).expect("finite");
        assert_eq!(answer.status, TripodStatus::Complete);
        counts[answer.account.real] += 1;
        let found = answer.modes.iter().any(|mode| {
            apart(&mode.pose.rotation, &pose.rotation) < 1e-8 && (mode.pose.position - pose.position).norm() < 1e-6
        });
        assert!(found, "{robot:?} {pose:?}");
        for mode in &answer.modes {
            let Ok(back) = robot.inverse(&mode.pose) else { continue };
            let size = velocity.inputs.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
            let off = back.iter().zip(velocity.inputs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-6 * size * size, "{off:e} {size}");
        }
    }
    // An even number is real, as many as eight.
    assert!(counts[1] + counts[3] + counts[5] + counts[7] == 0 && counts[8] > 0 && counts[2] > 0, "{counts:?}");
}

#[test]
fn newton_from_many_starts_finds_nothing_else() {
    let mut random = Random::new(6);
    for trial in 0..150 {
        let normals = [0; 3].map(|_| direction(&mut random));
        let directions = [0; 3].map(|_| direction(&mut random));
        let planted = Rotation3::new(direction(&mut random) * random.between(0.0, 3.0));
        // Odd ones as the Hexapteron has them, with other cosines than zero.
        let cosines =
            std::array::from_fn(|k| if trial % 2 == 0 { 0.0 } else { normals[k].dot(&(planted * directions[k])) });
        let conditions = PlaneConditions { normals, directions, cosines };
        let answer = conditions.solve();
        assert!(answer.account.adds_up());
        for _ in 0..150 {
            let mut rotation = Rotation3::new(direction(&mut random) * random.between(0.0, 3.1));
            let mut determinant: f64 = 0.0;
            for _ in 0..40 {
                let values = Vector3::from_fn(|k, _| normals[k].dot(&(rotation * directions[k])) - cosines[k]);
                let rows = [0, 1, 2].map(|k| (rotation * directions[k]).cross(&normals[k]).transpose());
                let slope = Matrix3::from_rows(&rows);
                determinant = slope.determinant();
                let Some(step) = slope.lu().solve(&values) else { break };
                rotation = Rotation3::new(-step * (1.0_f64).min(1.0 / step.norm())) * rotation;
            }
            if conditions.residual(&rotation) > 1e-10 || determinant.abs() < 1e-4 {
                continue;
            }
            let known = answer.rotations.iter().any(|(r, _)| apart(r, &rotation) < 1e-6);
            assert!(known, "{conditions:?} {rotation}");
        }
    }
}

#[test]
fn rates_and_accelerations_are_those_of_small_steps() {
    let mut random = Random::new(8);
    let mut tried = 0;
    while tried < 200 {
        let robot = random_robot(&mut random);
        let start = TripodPose::new(direction(&mut random), direction(&mut random));
        let (dp, omega, ddp, alpha) =
            (direction(&mut random), direction(&mut random), direction(&mut random), direction(&mut random));
        let Ok(velocity) = robot.velocity(&start) else { continue };
        if robot.legs.iter().any(|leg| {
            let n = (start.rotation * leg.v).cross(&leg.w);
            n.norm() < 0.3 || n.dot(&leg.u).abs() < 0.3
        }) {
            continue;
        }
        tried += 1;
        let at = |t: f64| {
            // To second order the rotation vector of the step; its derivatives at 0 are omega and alpha.
            let rotation = Rotation3::new(omega * t + alpha * (0.5 * t * t)) * start.rotation;
            let pose = TripodPose { position: start.position + dp * t + ddp * (0.5 * t * t), rotation };
            Vector6::from(robot.inverse(&pose).expect("regular"))
        };
        let h = 1e-3;
        let first = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
        let double = (16.0 * (at(h) + at(-h)) - (at(2.0 * h) + at(-2.0 * h)) - 30.0 * at(0.0)) / (12.0 * h * h);
        let rates = Vector6::from_iterator(dp.iter().chain(&omega).copied());
        let second = Vector6::from_iterator(ddp.iter().chain(&alpha).copied());
        assert!((velocity.input_rates(&rates) - first).norm() < 1e-6 * (1.0 + first.norm()));
        let found = velocity.input_accelerations(&rates, &second);
        assert!((found - double).norm() < 1e-4 * (1.0 + double.norm()), "{found} {double}");
    }
}

#[test]
fn bad_robots_and_poses_are_refused() {
    let good = Tripod::cartesian(1.0, 2.0).expect("sound").legs;
    let with = |change: &dyn Fn(&mut TripodLeg)| {
        let mut legs = good;
        change(&mut legs[1]);
        Tripod::new(legs).unwrap_err().to_string()
    };
    assert_eq!(with(&|leg| leg.u = Vector3::zeros()), "leg 2: u has no length");
    assert!(with(&|leg| leg.w = leg.u).starts_with("leg 2: the base axis w must be square"));
    assert_eq!(with(&|leg| leg.db = leg.da), "leg 2: the rails coincide, seen along the base axis");
    assert_eq!(with(&|leg| leg.c.x = f64::NAN), "leg 2: c: NaN must be finite");
    let along = Tripod::new({
        let mut legs = good;
        // Rails parallel to the platform's axis.
        legs[0].v = legs[0].u;
        legs
    });
    let error = along.expect("sound").inverse(&TripodPose::new(Vector3::zeros(), Vector3::zeros())).unwrap_err();
    assert!(error.to_string().starts_with("leg 1: its plane is parallel to the rails"), "{error}");
    assert!(TripodPose::with_matrix(Vector3::zeros(), Matrix3::identity() * 2.0).is_err());
}

#[test]
fn fewer_degrees_of_freedom() {
    let data = &golden()["tripod6"];
    let (robot, general) = (CartesianRobot { d1: 600.0, d2: 720.0 }, Tripod::cartesian(600.0, 720.0).expect("sound"));
    let case = &data["dof5"];
    let found = robot.five_dof_orientations(&Vector3::repeat(1.0), &vector(&case["tool_dir"])).expect("directions");
    let TripodTorsions::Isolated(found) = found else { panic!("{found:?}") };
    let solutions = case["solutions"].as_array().expect("a list");
    assert_eq!((found.len(), solutions.len()), (2, 2));
    for ((torsion, rotation), solution) in found.iter().zip(solutions) {
        assert!((torsion - solution["s"].as_f64().expect("a number")).abs() < 1e-9);
        assert!((rotation.matrix() - matrix(&solution["R"])).norm() < 1e-9);
        let rho = numbers(&solution["rho"]);
        let pose = TripodPose { position: vector(&case["p"]), rotation: *rotation };
        let inputs = general.inverse(&pose).expect("regular");
        assert!(inputs.iter().zip(&rho).all(|(a, b)| (a - b).abs() < 1e-8 * b.abs().max(1.0)), "{inputs:?} {rho:?}");
    }
    let rho = numbers(&solutions[0]["rho"]);
    let back = robot.forward_five(&[rho[0], rho[2], rho[3], rho[4], rho[5]]).expect("never singular");
    assert!((back.rotation.matrix() - matrix(&solutions[0]["R"])).norm() < 1e-9);

    let case = &data["dof4"];
    let rho = numbers(&case["rho"]);
    let pose = robot.forward_four(&[rho[0], rho[2], rho[4], rho[5]]).expect("never singular");
    let turned = Rotation3::new(Vector3::y() * case["rotation_about_y"].as_f64().expect("an angle"));
    assert!((pose.position - vector(&case["p"])).norm() < 1e-9 && apart(&pose.rotation, &turned) < 1e-12);
}

/// What leaves torsion free is told from what no torsion reaches, whatever rounding makes of it; legs whose axes point anywhere.
#[test]
fn every_torsion_is_no_empty_list() {
    let mut random = Random::new(20_260);
    for round in 0..2000 {
        let turn = Rotation3::new(Vector3::from_fn(|_, _| random.between(-3.0, 3.0)));
        let home = Rotation3::new(Vector3::from_fn(|_, _| random.between(-3.0, 3.0)));
        let robot = Tripod::cartesian(600.0, 720.0).expect("sound");
        let legs = robot.legs.map(|leg| TripodLeg {
            u: turn * leg.u,
            w: turn * leg.w,
            v: home * leg.v,
            da: turn * leg.da,
            db: turn * leg.db,
            ..leg
        });
        let leg = round % 3;
        let robot = Tripod::new(legs).expect("sound").with_one_motor(std::array::from_fn(|k| k == leg));
        let (normal, axis) = (robot.legs[leg].u, robot.legs[leg].v);
        let angle = random.between(-3.0, 3.0);
        let inside = Rotation3::new(normal * angle) * robot.legs[leg].w;
        let beside = axis.cross(&Vector3::new(0.3, -0.7, 0.6)).normalize();
        let tilted = (inside + normal * 1e-6).normalize();
        for (tool_axis, direction, every) in [
            (axis, inside, true),
            (-axis, inside, true),
            (beside, normal, true),
            (beside, -normal, true),
            (axis, tilted, false),
            (axis, normal, false),
        ] {
            let robot = Tripod { tool_axis, ..robot.clone() };
            match robot.pointing(&direction).expect("a direction") {
                TripodTorsions::Every(rotation) => {
                    assert!(every, "{round}: {direction}");
                    for torsion in [0.0, 1.0, -2.0] {
                        let rotation = Rotation3::new(direction * torsion) * rotation;
                        assert!((rotation * tool_axis - direction).norm() < 1e-14);
                        assert!(normal.dot(&(rotation * axis)).abs() < 1e-14);
                    }
                }
                TripodTorsions::Isolated(found) => assert!(!every && found.is_empty(), "{round}: {found:?}"),
            }
        }
        // Where two torsions meet, rounding does not lose them: tool axis and leg's axis at the angle of direction and plane.
        let (s, c) = angle.sin_cos();
        let robot = Tripod { tool_axis: axis * c + beside * s, ..robot };
        match robot.pointing(&(inside * c + normal * s)).expect("a direction") {
            TripodTorsions::Isolated(found) => assert!((1..=2).contains(&found.len()), "{round}"),
            TripodTorsions::Every(_) => panic!("{round}"),
        }
    }
}

#[test]
fn multipterons() {
    let data = &golden()["multipteron"];
    let case = &data["quadrupteron_model"];
    let four = |key: &str| std::array::from_fn(|k| vector(&case[key][k]));
    let robot = Quadrupteron { directions: four("e"), points: four("b"), axis: vector(&case["axis"]) };
    let inputs: [f64; 4] = numbers(&case["rho"]).try_into().expect("four");
    let phi = case["phi"].as_f64().expect("an angle");
    assert!(robot.inverse(&vector(&case["p"]), phi).iter().zip(inputs).all(|(a, b)| (a - b).abs() < 1e-12));
    let found = robot.forward(&inputs);
    for solution in case["fk"].as_array().expect("a list") {
        let (p, phi) = (vector(&solution["p"]), solution["phi"].as_f64().expect("an angle"));
        assert!(found.iter().any(|(place, angle)| (place - p).norm() + (angle - phi).abs() < 1e-9), "{found:?}");
    }
    assert_eq!(found.len(), 2);

    let case = &data["hexapteron_model"];
    let robot = Hexapteron {
        directions: [Vector3::x(), Vector3::y(), Vector3::z()],
        points: std::array::from_fn(|k| vector(&case["b"][k])),
    };
    let inputs = robot.inverse(&pose(case));
    assert!(inputs.iter().zip(numbers(&case["rho"])).all(|(a, b)| (a - b).abs() < 1e-9));
    let (poses, account) = robot.forward(&inputs).expect("regular");
    let expected = case["fk"].as_array().expect("a list");
    assert_eq!((poses.len(), account.real, expected.len()), (8, 8, 8));
    for solution in expected {
        let wanted = pose(solution);
        assert!(
            poses.iter().any(|p| apart(&p.rotation, &wanted.rotation) + (p.position - wanted.position).norm() < 1e-9)
        );
    }
}

#[test]
fn exact_counts_are_those_of_the_numbers() {
    let mut random = Random::new(21);
    let mut counts = [0; 9];
    let scale: usize = std::env::var("ASSUR_TEST_SCALE").ok().and_then(|text| text.parse().ok()).unwrap_or(1);
    for trial in 0..24 * scale {
        let robot = match trial % 4 {
            0 => Tripod::cartesian(600.0, 720.0).expect("sound"),
            1 => Tripod::inclined(random.between(0.1, 1.2), 2.0, 3.0).expect("sound"),
            2 => Tripod::upright(random.between(0.1, 1.2), 2.0, 3.0).expect("sound"),
            _ => random_robot(&mut random),
        };
        let pose = TripodPose::new(direction(&mut random), direction(&mut random) * random.between(0.0, 1.4));
        let Ok(velocity) = robot.velocity(&pose) else { continue };
        if velocity.position_volume.abs() < 1e-2 || velocity.orientation_volume.abs() < 1e-2 {
            continue;
        }
        let (exact, fast) =
            (robot.certify(&velocity.inputs).expect("finite"), robot.forward(&velocity.inputs).expect("finite"));
        assert_eq!((exact.counted, fast.counted), (Counted::Exactly, Counted::Numerically));
        assert_eq!((exact.account, exact.status), (fast.account, fast.status), "{robot:?} {:?}", velocity.inputs);
        counts[exact.account.real] += 1;
        assert_eq!(exact.modes.len(), fast.modes.len());
        for mode in &exact.modes {
            assert!(mode.residual < 1e-12);
            assert!(fast.modes.iter().any(|other| apart(&mode.pose.rotation, &other.pose.rotation) < 1e-9));
        }
    }
    assert!(counts[4] > 0 && counts.iter().sum::<usize>() > 12, "{counts:?}");
}

#[test]
fn degenerate_inputs_are_decided_exactly() {
    let cartesian = Tripod::cartesian(600.0, 720.0).expect("sound");
    // T = 1, as exactly as 120/120 is 1: the place is not determined; a little beside, it is.
    let free = cartesian.certify(&[0.0, 120.0, 0.0, 120.0, 0.0, 120.0]).expect("finite");
    assert_eq!(free.status, TripodStatus::PositionFree);
    let beside = cartesian.certify(&[0.0, 120.0, 0.0, 120.0, 0.0, 120.0 + 1e-9]).expect("finite");
    assert_eq!((beside.status, beside.modes.len(), beside.spurious.len()), (TripodStatus::Complete, 4, 4));
    // T = -1: the four true orientations have run into the four spurious ones; beside, they are eight.
    let merged = cartesian.certify(&[0.0, -120.0, 0.0, -120.0, 0.0, -120.0]).expect("finite");
    assert_eq!((merged.modes.len(), merged.spurious.len(), merged.account.rejected), (0, 4, 8));
    assert!(merged.spurious.iter().all(|mode| mode.multiplicity == 2 && mode.parallel_axes == [true; 3]));
    let beside = cartesian.certify(&[0.0, -120.0, 0.0, -120.0, 0.0, -120.0 - 1e-9]).expect("finite");
    assert_eq!((beside.modes.len(), beside.spurious.len()), (4, 4));
    // All platform axes parallel: free to turn about them.
    let mut legs = cartesian.legs;
    legs.iter_mut().for_each(|leg| leg.v = Vector3::new(0.6, 0.0, 0.8));
    let turning = Tripod::new(legs).expect("sound").certify(&[1.0, 2.0, 3.0, 5.0, 8.0, 13.0]).expect("finite");
    assert_eq!((turning.status, turning.account.self_motion), (TripodStatus::OrientationFree, 8));
}

#[test]
fn determinants_of_figure_8_vanish_where_said() {
    // The curves of det J over elevation and axis angle, at home: none at the ends, some in between.
    let home = TripodPose::new(Vector3::new(0.0, 0.0, 10.0), Vector3::zeros());
    let determinant = |robot: Tripod| robot.velocity(&home).map_or(0.0, |v| v.position_volume * v.orientation_volume);
    let inclined = |degrees: f64| determinant(Tripod::inclined(degrees.to_radians(), 600.0, 720.0).expect("sound"));
    let upright = |degrees: f64| determinant(Tripod::upright(degrees.to_radians(), 600.0, 720.0).expect("sound"));
    assert!(inclined(0.0).abs() < 1e-12 && inclined(90.0).abs() < 1e-12 && inclined(35.0).abs() > 0.1);
    // With vertical rails the turning axes are tangential at home, whatever the elevation: torsion is free. Tilted, it is not.
    assert!(upright(0.0).abs() < 1e-12 && upright(19.0).abs() < 1e-12);
    let tilted = TripodPose::new(Vector3::zeros(), Vector3::new(0.2, 0.1, 0.0));
    let robot = Tripod::upright(19_f64.to_radians(), 600.0, 720.0).expect("sound");
    assert_eq!(robot.velocity(&tilted).expect("regular").singularity(), TripodSingularity::None);
}

#[test]
fn determinant_curves_are_those_of_the_jacobian_and_the_closed_forms() {
    let level = TripodPose::new(Vector3::new(3.0, -8.0, 20.0), Vector3::zeros());
    let curve = TripodDesign::Inclined.determinant_curve(600.0, 720.0, &level, [0.0, 1.5], 40).expect("sound");
    for point in &curve {
        let (s, c) = point.elevation.sin_cos();
        let closed = 6.75 * 120.0_f64.powi(3) * (s * c).powi(3);
        assert!((point.determinant.expect("regular") - closed).abs() < 1e-9 * 120.0_f64.powi(3), "{point:?} {closed}");
    }
    let level = TripodDesign::Upright.determinant_curve(600.0, 720.0, &level, [0.0, 1.4], 40).expect("sound");
    // The turning axes are horizontal: zero, and said to be zero.
    assert!(level.iter().all(|point| point.determinant == Some(0.0)), "{level:?}");
    // 110° between axes at an elevation of 18.94°, as the paper's text has it.
    let angle = |degrees: f64| {
        let range = [degrees.to_radians(), 1.0];
        TripodDesign::Upright.determinant_curve(
            600.0,
            720.0,
            &TripodPose::new(Vector3::zeros(), Vector3::zeros()),
            range,
            2,
        )
    };
    assert!((angle(18.937_119_75).expect("sound")[0].between.to_degrees() - 110.0).abs() < 1e-4);
    // Against the 6 by 6 determinant, in any pose.
    let mut random = Random::new(31);
    for trial in 0..200 {
        let robot = random_robot(&mut random);
        let robot = match trial % 3 {
            0 => TripodDesign::Inclined.robot(random.between(0.1, 1.4), 2.0, 3.0).expect("sound"),
            1 => TripodDesign::Upright.robot(random.between(0.1, 1.4), 2.0, 3.0).expect("sound"),
            _ => robot,
        };
        let pose = TripodPose::new(direction(&mut random), direction(&mut random));
        let Ok(velocity) = robot.velocity(&pose) else { continue };
        let scale: f64 = velocity.jacobian.row_iter().map(|row| row.norm()).product();
        let (short, long) = (robot.jacobian_determinant(&pose).expect("regular"), velocity.jacobian.determinant());
        assert!((short - long).abs() < 1e-11 * scale, "{short} {long} {scale}");
    }
}

#[test]
fn plane_angles_are_those_in_print() {
    let case = &golden()["tripod6"]["cartesian"];
    let robot = Tripod::cartesian(600.0, 720.0).expect("sound");
    let angles = robot.plane_angles(&pose(case)).expect("regular");
    for (angle, (gamma, rho)) in angles.iter().zip(numbers(&case["gamma"]).iter().zip(numbers(&case["rho"]).chunks(2)))
    {
        assert!((angle - gamma).abs() < 1e-9, "{angles:?}");
        assert!((angle.tan() - (rho[1] - rho[0]) / 120.0).abs() < 1e-9, "{angles:?}");
    }
}

#[test]
fn planes_that_do_not_turn_lose_no_assembly() {
    // Two of the planes' normals are square to each other then, and an equation vanishes at a root.
    let (general, closed) = (Tripod::cartesian(600.0, 720.0).expect("sound"), CartesianRobot { d1: 600.0, d2: 720.0 });
    let mut random = Random::new(51);
    for trial in 0..300 {
        let mut inputs: [f64; 6] = std::array::from_fn(|_| random.between(-200.0, 300.0));
        for leg in (0..3).filter(|leg| ((trial % 7) + 1) >> leg & 1 == 1) {
            inputs[2 * leg + 1] = inputs[2 * leg];
        }
        let expected = closed.forward(&inputs).expect("T = 0 is regular");
        let answer = general.forward(&inputs).expect("finite");
        assert_eq!((answer.modes.len(), answer.spurious.len(), answer.account.real), (4, 4, 4), "{inputs:?}");
        let found = answer.modes.iter().any(|mode| {
            apart(&mode.pose.rotation, &expected.rotation) < 1e-9
                && (mode.pose.position - expected.position).norm() < 1e-6
        });
        assert!(found, "{inputs:?}");
    }
}
