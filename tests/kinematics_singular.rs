//! Planted singular poses get the right name; loci hold every singular pose.

use assur::nalgebra::Vector2;
use assur::{Leg, Manipulator, Pose, Reading, SingularityKind, Velocity};

fn kind(robot: &Manipulator, pose: &Pose, signs: &str) -> SingularityKind {
    robot.singularity(pose, signs, None).unwrap().kind
}

fn all_numbers(robot: &Manipulator, pose: &Pose, signs: &str) {
    let found = robot.singularity(pose, signs, None).unwrap();
    let velocity: Velocity = robot.velocity(pose, signs).unwrap();
    let numbers = velocity.pose_matrix.iter().chain(velocity.input_matrix.iter()).copied();
    let others = [found.sigma_min, found.sigma_min_input, found.dexterity, velocity.stiffness(1.0)];
    let error = velocity.position_error(Vector2::zeros());
    assert!(numbers.chain(others).chain([error]).all(|n| !n.is_nan()), "{found:?}");
}

/// Strut whose line passes from `base` through a platform point at `tip`, both in base axes, in the pose (0, 0, 0).
fn strut(base: [f64; 2], tip: [f64; 2]) -> Leg {
    Leg::rpr(base, tip)
}

#[test]
fn each_type_is_named_where_it_is_planted() {
    let home = Pose::new(0.0, 0.0, 0.0);
    let concurrent =
        vec![strut([0.0, -5.0], [0.0, -1.0]), strut([5.0, 0.0], [1.0, 0.0]), strut([-3.0, 3.0], [-1.0, 1.0])];
    let robot = Manipulator::new("", concurrent.clone()).unwrap();
    let found = robot.singularity(&home, "+++", None).unwrap();
    assert_eq!((found.kind, found.legs.len()), (SingularityKind::Type2, 0));
    let Some(Reading::Meet { point }) = found.reading else { panic!("{found:?}") };
    assert!(point.norm() < 1e-12, "{point}");
    assert_eq!(found.dexterity, 0.0);

    let parallel =
        vec![strut([0.0, -5.0], [0.0, 0.0]), strut([2.0, -5.0], [2.0, 1.0]), strut([-1.0, 9.0], [-1.0, 1.0])];
    let found = Manipulator::new("", parallel).unwrap().singularity(&home, "+-+", None).unwrap();
    let Some(Reading::Parallel { direction }) = found.reading else { panic!("{found:?}") };
    assert!(found.kind == SingularityKind::Type2 && direction.x.abs() < 1e-12);
    let free = found.free_motion.unwrap();
    assert!(free.x.abs() > 0.99 && free.z.abs() < 1e-12);

    // A stretched leg beside two struts that do not meet its line in one point, and then do.
    let stretched = Leg::rrr([0.0, -3.0], 1.5, 1.0, [0.0, -0.5]);
    let others = [strut([5.0, 1.0], [1.0, 1.0]), strut([-3.0, 3.0], [-1.0, 1.0])];
    let robot = Manipulator::new("", vec![stretched.clone(), others[0].clone(), others[1].clone()]).unwrap();
    let found = robot.singularity(&home, "+++", None).unwrap();
    assert_eq!((found.kind, &found.legs[..]), (SingularityKind::Type1, &[1][..]));
    let robot = Manipulator::new("", vec![stretched, concurrent[1].clone(), concurrent[2].clone()]).unwrap();
    let found = robot.singularity(&home, "+++", None).unwrap();
    assert_eq!((found.kind, &found.legs[..]), (SingularityKind::Type3, &[1][..]));
    all_numbers(&robot, &home, "+++");

    // Links square to their sliders.
    let square = Leg::prr([-4.0, 0.0], 0.0, 2.0, [0.0, 2.0]);
    let robot = Manipulator::new("", vec![others[0].clone(), square, others[1].clone()]).unwrap();
    let found = robot.singularity(&home, "+++", None).unwrap();
    assert_eq!((found.kind, &found.legs[..]), (SingularityKind::Type1, &[2][..]));
    // A strut without length: its joints turn with the platform at rest.
    let robot =
        Manipulator::new("", vec![strut([1.0, 2.0], [1.0, 2.0]), others[0].clone(), others[1].clone()]).unwrap();
    let found = robot.singularity(&home, "+++", None).unwrap();
    assert_eq!((found.kind, &found.legs[..], &found.idle_legs[..]), (SingularityKind::Type1, &[1][..], &[1][..]));
    all_numbers(&robot, &home, "+++");

    // Congruent triangles on equal struts: a parallelogram that moves.
    let corners = [[0.0, 0.0], [4.0, 0.0], [1.0, 3.0]];
    let robot = Manipulator::new("", corners.map(|a| Leg::rpr(a, a)).to_vec()).unwrap();
    assert_eq!(kind(&robot, &Pose::new(3.0, 4.0, 0.0), "+++"), SingularityKind::SelfMotion);
    assert_eq!(kind(&robot, &Pose::new(3.0, 4.0, 0.3), "+++"), SingularityKind::Regular);
}

#[test]
fn around_planted_poses_nothing_is_nan_and_the_type_fades() {
    let robot = Manipulator::new(
        "",
        vec![strut([0.0, -5.0], [0.0, -1.0]), strut([5.0, 0.0], [1.0, 0.0]), strut([-3.0, 3.0], [-1.0, 1.0])],
    )
    .unwrap();
    for exponent in 0..18 {
        let step = 10f64.powi(-exponent);
        for pose in [Pose::new(step, 0.3 * step, 0.0), Pose::new(0.0, 0.0, step), Pose::new(-step, step, -step)] {
            all_numbers(&robot, &pose, "+++");
        }
    }
    assert_eq!(kind(&robot, &Pose::new(0.01, 0.02, 0.03), "+++"), SingularityKind::Regular);
    assert_eq!(kind(&robot, &Pose::new(1e-9, 0.0, 0.0), "+++"), SingularityKind::Type2);
}

/// Every leg type: between two poses with opposite det A lies a pose of type 2, and the exact curve passes through it.
#[test]
fn crossings_of_every_family_are_of_type_2_and_on_the_exact_curve() {
    let families = [
        "3-R_P_R",
        "3-_R_RR",
        "3-R_R_R",
        "3-_P_RR",
        "3-P_R_R",
        "3-PR_R_",
        "3-_R_RP",
        "3-R_R_P",
        "3-RR_P_",
        "3-_R_PR",
        "3-RP_R_",
        "3-RR_R_",
        "3-_P_PR",
        "3-P_P_R",
        "3-_P_RP",
        "3-PR_P_",
        "3-R_P_P",
        "3-RP_P_",
        "R_P_R,_P_RR,RP_P_",
        "_P_RR,R_P_R,P_R_P",
    ];
    let mut located = 0;
    for family in families {
        let (mut robot, _) = Manipulator::of_family(family).unwrap();
        // Offsets off the axes, so that nothing is special.
        for (k, leg) in robot.legs.iter_mut().enumerate() {
            leg.links[0].at.y += 0.25 + 0.125 * k as f64;
            leg.links[1].at.y -= 0.375;
        }
        let phi = 0.375;
        let heavy = family == "3-RR_R_";
        let locus = if heavy { None } else { Some(robot.singularity_locus(phi).unwrap()) };
        let window = robot.plane_window(phi);
        for signs in robot.mode_names() {
            let pieces = robot.trace_singularities(phi, &signs, &window).unwrap();
            for piece in pieces.iter().step_by(40).take(4) {
                let (centre, reach) = ((piece[0] + piece[1]) / 2.0, (piece[1] - piece[0]) / 2.0);
                let side = Vector2::new(-reach.y, reach.x).normalize() * (window.high - window.low).norm() * 1e-4;
                let det = |p: Vector2<f64>| {
                    let velocity = robot.velocity(&Pose::new(p.x, p.y, phi), &signs).ok()?;
                    Some(velocity.pose_matrix.determinant())
                };
                let (mut low, mut high) = (centre - side, centre + side);
                let (Some(a), Some(b)) = (det(low), det(high)) else { continue };
                if a * b >= 0.0 {
                    continue;
                }
                for _ in 0..60 {
                    let middle = (low + high) / 2.0;
                    match det(middle) {
                        Some(v) if v * a > 0.0 => low = middle,
                        Some(_) => high = middle,
                        None => break,
                    }
                }
                if robot.velocity(&Pose::new(low.x, low.y, phi), &signs).unwrap().singularity(1.0).sigma_min_input
                    < 1e-3
                {
                    continue;
                }
                let found = robot.singularity(&Pose::new(low.x, low.y, phi), &signs, None).unwrap();
                assert!(
                    matches!(found.kind, SingularityKind::Type2 | SingularityKind::SelfMotion),
                    "{family} {signs}: {found:?}"
                );
                located += 1;
                if let Some(locus) = &locus {
                    // Values are known up to a factor far outside the range of f64: only their quotient is one.
                    let value = |p: Vector2<f64>| locus.exact_value(p.x, p.y).unwrap();
                    let part = |q: Vector2<f64>| (value(low) / value(q)).to_f64().value().abs();
                    let quotient = part(low + side).min(part(low - side));
                    assert!(quotient < 1e-5, "{family} {signs}: {quotient:e}");
                }
            }
        }
    }
    assert!(located > 100, "{located}");
}

/// Drawn curves and maps keep to where every leg is within its limits, and the window to where they are.
#[test]
fn loci_and_maps_are_clipped_to_limits() {
    let (mut robot, _) = Manipulator::of_family("3-RRR").unwrap();
    let (phi, signs) = (0.3, "+++".to_owned());
    let mode = robot.working_mode(&Pose::new(5.5, 4.0, phi), &signs).unwrap();
    let wide = robot.plane_window(phi);
    let before = robot.trace_singularities(phi, &signs, &wide).unwrap();
    for (leg, joints) in robot.legs.iter_mut().zip(&mode.joints) {
        leg.limits[0] = Some([joints[0] - 0.5, joints[0] + 0.9]);
    }
    let window = robot.plane_window(phi);
    let extent = |w: &assur::PlaneWindow| (w.high - w.low).product();
    assert!(extent(&window) < extent(&wide));
    let pieces = robot.trace_singularities(phi, &signs, &wide).unwrap();
    assert!(!before.is_empty() && pieces.len() < before.len());
    let inside = |p: Vector2<f64>, signs: &str| {
        let mode = robot.working_mode(&Pose::new(p.x, p.y, phi), signs);
        mode.is_ok_and(|mode| mode.violations.is_empty())
    };
    assert!(pieces.iter().all(|piece| inside((piece[0] + piece[1]) / 2.0, &signs)));
    let map = robot.plane_map(assur::MapQuantity::Dexterity, phi, &signs, None, &wide, [30, 30]).unwrap();
    let known = map.values.iter().enumerate().filter(|(_, value)| value.is_some());
    assert!(known.clone().count() > 0 && known.count() < 900);
    for (index, value) in map.values.iter().enumerate() {
        assert_eq!(value.is_some(), inside(map.at(index % 30, index / 30), &signs));
    }
    // Edges of a leg's reach are drawn only where some mode reaches, within the limits, beside them.
    for locus in robot.leg_loci(phi).unwrap() {
        for [p, q] in robot.trace_leg_locus(&locus, phi, &wide) {
            let (middle, along) = ((p + q) / 2.0, (q - p).normalize());
            let side = Vector2::new(-along.y, along.x) * 0.01;
            let reached = |p: Vector2<f64>| robot.mode_names().iter().any(|signs| inside(p, signs));
            assert!(reached(middle + side) || reached(middle - side) || reached(middle), "{middle}");
        }
    }
}

/// Where the linear rows are parallel, near phi = 0.884 for the shipped 3-RPR, T has a double root of two poses: twins, not a meeting of modes.
#[test]
fn twin_poses_are_not_called_singular() {
    let (sin, cos) = 0.8822f64.sin_cos();
    let (base, platform) = ([[15.91, 0.0], [0.0, 10.0]], [[17.045, 0.0], [20.839 * cos, 20.839 * sin]]);
    let legs = vec![Leg::rpr([0.0; 2], [0.0; 2]), Leg::rpr(base[0], platform[0]), Leg::rpr(base[1], platform[1])];
    let robot = Manipulator::new("3-RPR", legs).unwrap();
    let parallel = |phi: f64| {
        let turn = |p: [f64; 2]| Pose::new(0.0, 0.0, phi).place(Vector2::from(p));
        let [g, h] = [0, 1].map(|k: usize| turn(platform[k]) - Vector2::from(base[k]));
        g.x * h.y - g.y * h.x
    };
    let (mut low, mut high) = (0.85, 0.92);
    assert!(parallel(low) * parallel(high) < 0.0);
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if parallel(low) * parallel(middle) > 0.0 { low = middle } else { high = middle }
    }
    assert!((low - 0.884).abs() < 1e-3, "{low}");
    let mut twins = 0;
    for k in 0..40 {
        let k = f64::from(k);
        let pose = Pose::new(12.0 * (1.3 * k).sin(), 12.0 * (2.1 * k + 0.4).cos(), low);
        let found = robot.singularity(&pose, "+++", None).unwrap();
        // On a line through the plane the twins do meet; far from it nothing is singular.
        if found.sigma_min < 1e-3 {
            continue;
        }
        assert_eq!(found.kind, SingularityKind::Regular, "{pose:?}");
        let inputs = robot.inputs_of(&robot.working_mode(&pose, "+++").unwrap().joints);
        let modes = robot.forward(&inputs).unwrap().modes;
        let beside: Vec<_> = modes.iter().filter(|m| (m.mode.pose.phi - low).abs() < 1e-6).collect();
        assert!(beside.iter().all(|m| m.mode.multiplicity == 1 && m.mode.det_a.abs() > 1e-6), "{beside:?}");
        twins += usize::from(beside.len() == 2 && beside[0].mode.det_a * beside[1].mode.det_a < 0.0);
    }
    assert!(twins > 20, "{twins}");
}

#[test]
fn degrees_of_the_exact_curves() {
    for (family, degree) in [("3-R_P_R", 2), ("3-R_R_R", 2), ("3-_P_RR", 20)] {
        let (robot, _) = Manipulator::of_family(family).unwrap();
        let locus = robot.singularity_locus(0.375).unwrap();
        assert_eq!(locus.degree(), degree, "{family}");
    }
}
