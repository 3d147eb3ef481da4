//! Tilts: the golden values, scans over azimuths, and the bound that no azimuth is worse.

mod random;

use assur::nalgebra::Vector3;
use assur::{Tilt, Tripod};
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
