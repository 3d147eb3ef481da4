//! Tilts: the golden values, scans over azimuths, and the bound that no azimuth is worse.

mod random;

use std::f64::consts::TAU;

use assur::nalgebra::Vector3;
use assur::{Tilt, TiltLimit, Tripod, TripodLeg, TripodPose};
use random::Random;
use serde_json::Value;

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|x| x.as_f64().expect("a number")).collect()
}

#[test]
fn golden_tilts() {
    let text = std::fs::read_to_string(format!("{}/tests/golden/spatial.json", env!("CARGO_MANIFEST_DIR")));
    let data: Value = serde_json::from_str(&text.expect("is there")).expect("is JSON");
    let robot = Tripod::cartesian_example();
    for case in data["tripod6"]["tilt"]["cases"].as_array().expect("cases") {
        let tip = Vector3::from_vec(numbers(&case["tip"]));
        let tilt = robot.tilt(&tip).expect("finite").expect("home is inside");
        let expected = case["max_tilt_deg"].as_f64().expect("a number");
        assert!((tilt.angle.to_degrees() - expected).abs() < 1e-6, "{case}: {tilt:?} {}", tilt.angle.to_degrees());
        let along = numbers(&case["theta_max_deg_at_az_0_60_90_150_240_330"]);
        for (azimuth, expected) in [0.0_f64, 60.0, 90.0, 150.0, 240.0, 330.0].into_iter().zip(along) {
            let (angle, _) = robot.tilt_along(&tip, azimuth.to_radians()).expect("finite").expect("home is inside");
            assert!((angle.to_degrees() - expected).abs() < 1e-6, "{case} {azimuth}: {}", angle.to_degrees());
        }
        let bound = robot.tilt_bound(&tip, &tilt, 1e-3).expect("finite");
        assert_eq!(bound, Some(tilt.angle - 1e-3));
        // A claim that is too high is not proved.
        let boast = Tilt { angle: tilt.angle + 2e-3, ..tilt };
        assert_eq!(robot.tilt_bound(&tip, &boast, 1e-3).expect("finite"), None);
    }
}

/// Robots of any geometry: home in the middle of the strokes.
fn any_robot(random: &mut Random) -> Option<(Tripod, Vector3<f64>)> {
    let mut vector = |size: f64| Vector3::from_fn(|_, _| random.between(-size, size));
    let legs = std::array::from_fn(|_| {
        let u = vector(1.0);
        let v = vector(1.0);
        let da = vector(3.0);
        TripodLeg { u, w: u.cross(&vector(1.0)), v, c: vector(0.5), da, db: da + vector(1.5) }
    });
    let robot = Tripod::new(legs).ok()?;
    let (tool, place, tool_axis) = (vector(0.5), vector(1.0), vector(1.0).normalize());
    let home = TripodPose::new(place - tool, Vector3::zeros());
    let inputs = robot.inverse(&home).ok()?;
    // Near a singularity of type 1 the sliders are far away.
    if inputs.iter().any(|x| x.abs() > 20.0) {
        return None;
    }
    let strokes = inputs.map(|x| [x - random.between(0.1, 1.5), x + random.between(0.1, 1.5)]);
    let room = robot.plane_angles(&home).ok()?.iter().fold(0.0, |most: f64, angle| most.max(angle.abs()));
    let plane_angle_limit = (random.between(0.0, 1.0) < 0.5).then(|| room + random.between(0.1, 0.8));
    let strokes = (random.between(0.0, 1.0) < 0.6).then_some(strokes);
    Some((Tripod { tool, tool_axis, strokes, plane_angle_limit, ..robot }, place))
}

#[test]
fn no_scanned_azimuth_is_worse_whatever_the_robot() {
    const AZIMUTHS: u32 = 7200;
    let (mut random, mut tried, mut strokes, mut planes) = (Random::new(31), 0, 0, 0);
    while tried < 150 {
        let Some((robot, place)) = any_robot(&mut random) else { continue };
        let along = |azimuth: f64| robot.tilt_along(&place, azimuth).expect("finite").expect("home is inside").0;
        let tilt = robot.tilt(&place).expect("finite").expect("home is inside");
        tried += 1;
        match tilt.limit {
            TiltLimit::Stroke { .. } => strokes += 1,
            TiltLimit::PlaneAngle { .. } | TiltLimit::AlongRail { .. } => planes += 1,
            TiltLimit::HalfTurn => {}
        }
        let scanned = (0..AZIMUTHS).map(|k| along(f64::from(k) * TAU / f64::from(AZIMUTHS)));
        let least = scanned.fold(f64::INFINITY, f64::min);
        assert!(tilt.angle <= least + 1e-12, "{robot:?} {place} {tilt:?} {least}");
        // The scan is within half a step of the worst azimuth, where the angle is stationary.
        assert!(tilt.angle >= least - 1e-3, "{robot:?} {place} {tilt:?} {least}");
        assert!((along(tilt.azimuth) - tilt.angle).abs() < 1e-12);
        // A valley: a thousandth of a degree away on either side it is no lower, and hardly higher.
        for aside in [-1.7e-5, 1.7e-5] {
            let rise = along(tilt.azimuth + aside) - tilt.angle;
            assert!((-1e-12..1e-6).contains(&rise), "{robot:?} {place} {tilt:?} {rise:e}");
        }
        let bound = robot.tilt_bound(&place, &tilt, 1e-6).expect("finite");
        assert_eq!(bound, Some((tilt.angle - 1e-6).max(0.0)), "{robot:?} {place} {tilt:?}");
        let boast = Tilt { angle: tilt.angle + 2e-6, ..tilt };
        assert_eq!(robot.tilt_bound(&place, &boast, 1e-6).expect("finite"), None, "{robot:?} {place} {tilt:?}");
    }
    assert!(strokes > 30 && planes > 30, "{strokes} {planes}");
}

#[test]
fn no_scanned_azimuth_is_worse_and_the_limit_is_kept() {
    let mut random = Random::new(9);
    let inclined = Tripod {
        strokes: Some([[-250.0, 250.0]; 6]),
        plane_angle_limit: Some(0.9),
        ..Tripod::inclined(0.5, 600.0, 720.0).expect("sound")
    };
    let upright = Tripod { strokes: Some([[-600.0, 900.0]; 6]), ..Tripod::upright(0.35, 600.0, 720.0).expect("sound") };
    let robots =
        [(Tripod::cartesian_example(), [-50.0, 450.0]), (inclined, [-150.0, 150.0]), (upright, [-200.0, 200.0])];
    let mut inside = 0;
    for trial in 0..240 {
        let (robot, [low, high]) = &robots[trial % 3];
        let tip = Vector3::from_fn(|_, _| random.between(*low, *high));
        let Ok(Some(tilt)) = robot.tilt(&tip) else { continue };
        inside += 1;
        let least = (0..720)
            .map(|k| robot.tilt_along(&tip, f64::from(k).to_radians() * 0.5).expect("finite").expect("inside").0)
            .fold(f64::INFINITY, f64::min);
        assert!(tilt.angle <= least + 1e-12, "{tip} {tilt:?} {least}");
        assert!(tilt.angle >= least - 0.02, "{tip} {tilt:?} {least}");
        let (again, _) = robot.tilt_along(&tip, tilt.azimuth).expect("finite").expect("inside");
        assert!((again - tilt.angle).abs() < 1e-12);
        // Just before the limit everything is kept, just beyond something is not.
        let kept = |angle: f64| {
            let pose = robot.tilted_pose(&tip, angle, tilt.azimuth);
            let Ok(inputs) = robot.inverse(&pose) else { return false };
            robot.violations(&pose, &inputs).expect("regular").is_empty()
        };
        if tilt.angle < 3.0 {
            assert!(kept(tilt.angle * (1.0 - 1e-9)) && !kept(tilt.angle + 1e-7), "{tip} {tilt:?}");
        }
    }
    assert!(inside > 60, "{inside}");
    let out = Tripod::cartesian_example().tilt(&Vector3::repeat(900.0)).expect("finite");
    assert_eq!(out, None);
}
