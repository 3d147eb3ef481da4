//! One mode along a path: it never jumps, and stops where it ends.

use assur::{Leg, Manipulator, PathEventKind, PathSettings, Pose};

fn shipped() -> Manipulator {
    let (sin, cos) = 0.8822f64.sin_cos();
    let legs = vec![
        Leg::rpr([0.0, 0.0], [0.0, 0.0]),
        Leg::rpr([15.91, 0.0], [17.045, 0.0]),
        Leg::rpr([0.0, 10.0], [20.839 * cos, 20.839 * sin]),
    ];
    Manipulator::new("3-RPR", legs).unwrap()
}

/// Two struts on one platform point, which their lengths put on two circles: modes meet exactly where the circles touch.
fn two_circles() -> Manipulator {
    let legs =
        vec![Leg::rpr([0.0, 0.0], [0.0, 0.0]), Leg::rpr([10.0, 0.0], [0.0, 0.0]), Leg::rpr([3.0, 9.0], [5.0, 1.0])];
    Manipulator::new("two circles", legs).unwrap()
}

fn follow(robot: &Manipulator, path: &[Vec<f64>], from: Option<Pose>) -> assur::FollowedPath {
    robot.follow(path, from, &PathSettings::default()).unwrap()
}

#[test]
fn ten_thousand_steps_without_singularity_keep_their_mode() {
    let robot = shipped();
    let path: Vec<Vec<f64>> = (0..=10_000)
        .map(|k| {
            let angle = f64::from(k) * std::f64::consts::TAU / 10_000.0;
            vec![14.98, 15.38 + 0.4 * angle.cos() - 0.4, 12.0 + 0.4 * angle.sin()]
        })
        .collect();
    let mut path = path;
    path[10_000] = path[0].clone();
    for mode in robot.forward(&path[0]).unwrap().modes {
        let answer = follow(&robot, &path, Some(mode.mode.pose));
        assert!(answer.complete && answer.events.is_empty(), "{:?}", answer.events);
        assert_eq!(answer.rows.len(), 10_001);
        let id = answer.rows[0].id;
        assert_eq!(answer.closed_in, Some(id));
        assert!(answer.rows.iter().all(|row| row.id == id && row.det_a * answer.rows[0].det_a > 0.0));
        let jump = |pair: &[assur::PathRow]| (pair[0].pose.x - pair[1].pose.x).hypot(pair[0].pose.y - pair[1].pose.y);
        assert!(answer.rows.windows(2).map(jump).fold(0.0, f64::max) < 0.02);
    }
}

#[test]
fn a_mode_that_ends_is_stopped_at_the_meeting() {
    let robot = two_circles();
    // The circles of radii 4 and r about points 10 apart touch at r = 6.
    let path: Vec<Vec<f64>> = [7.0, 6.7, 6.4, 5.5, 5.0].iter().map(|r| vec![4.0, *r, 8.0]).collect();
    let modes = robot.forward(&path[0]).unwrap().modes;
    assert!(modes.len() >= 2);
    for mode in &modes {
        let answer = follow(&robot, &path, Some(mode.mode.pose));
        assert!(!answer.complete);
        let event = answer.events.last().unwrap();
        assert_eq!(event.kind, PathEventKind::Meeting, "{event:?}");
        if answer.rows.len() == 3 && event.pose.y.abs() < 1e-6 {
            assert!((event.inputs[1] - 6.0).abs() < 1e-12, "{event:?}");
            assert!((event.at - (3.0 + 0.4 / 0.9)).abs() < 1e-12);
            assert!((event.pose.x - 4.0).abs() < 1e-9 && event.pose.y.abs() < 1e-7);
            assert!((answer.distance_to_meeting(1).unwrap() - 1.0).abs() < 1e-12);
        }
        // Just before it two modes with opposite det A are near, just after it none.
        let (last, next) = (&path[answer.rows.len() - 1], &path[answer.rows.len()]);
        let t = event.at.fract();
        let beside = |t: f64| -> Vec<f64> { last.iter().zip(next).map(|(a, b)| a + t * (b - a)).collect() };
        let near = |t: f64| -> Vec<f64> {
            let modes = robot.forward(&beside(t)).unwrap().modes;
            let close = |m: &&assur::ManipulatorMode| {
                (m.mode.pose.x - event.pose.x).hypot(m.mode.pose.y - event.pose.y) < 0.05
                    && ((m.mode.pose.phi - event.pose.phi) / 2.0).sin().abs() < 0.02
            };
            modes.iter().filter(close).map(|m| m.mode.det_a).collect()
        };
        let before = near(t - 1e-6);
        assert!(before.len() == 2 && before[0] * before[1] < 0.0, "{before:?}");
        assert!(near(t + 1e-6).is_empty());
    }
}

#[test]
fn two_modes_a_millionth_apart_tempt_no_jump() {
    let robot = two_circles();
    // y = ±sqrt(4.8 d) for r = 6 + d: 5e-7 to either side.
    let near = 6.0 + 2.5e-13 / 4.8;
    for rows in [vec![7.0, near, 7.0], vec![7.0, 6.0 + 1e-9, 7.0], vec![6.5, near, near + 1e-15, 6.5]] {
        let path: Vec<Vec<f64>> = rows.iter().map(|r| vec![4.0, *r, 8.0]).collect();
        for mode in robot.forward(&path[0]).unwrap().modes {
            let side = mode.mode.pose.y.signum();
            let answer = follow(&robot, &path, Some(mode.mode.pose));
            assert!(answer.rows.iter().all(|row| row.pose.y.signum() == side), "{rows:?}: {answer:?}");
            if answer.complete {
                let last = answer.rows.last().unwrap();
                let closed = if path.first() == path.last() { answer.closed_in == Some(last.id) } else { true };
                assert!(closed, "{answer:?}");
            } else {
                assert!(!answer.events.is_empty());
            }
            if rows[1] == near {
                assert!(!answer.complete, "modes a millionth apart cannot be told apart for certain");
            }
        }
    }
}

#[test]
fn a_loop_around_a_cusp_ends_in_another_mode_without_singularity() {
    let robot = shipped();
    let mut changed = 0;
    for (centre, radius) in [([13.8464, 6.2535], 0.25), ([16.0331, 29.5686], 0.1)] {
        for direction in [-1.0, 1.0] {
            for start in 0..4 {
                let first = f64::from(start) * std::f64::consts::FRAC_PI_2;
                let mut path: Vec<Vec<f64>> = (0..=90)
                    .map(|k| {
                        let angle = first + direction * f64::from(k) * std::f64::consts::TAU / 90.0;
                        vec![14.98, centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin()]
                    })
                    .collect();
                path[90] = path[0].clone();
                for mode in robot.forward(&path[0]).unwrap().modes {
                    let answer = follow(&robot, &path, Some(mode.mode.pose));
                    if answer.complete {
                        assert!(answer.events.is_empty());
                        assert!(answer.rows.iter().all(|row| row.det_a * answer.rows[0].det_a > 0.0));
                        changed += usize::from(answer.closed_in != Some(answer.rows[0].id));
                    }
                }
            }
        }
    }
    assert!(changed >= 2, "a loop around a cusp changes modes: {changed}");
}

#[test]
fn limits_are_reported_where_they_are_crossed() {
    let mut robot = shipped();
    robot.legs[1].limits[1] = Some([15.0, 20.0]);
    let path: Vec<Vec<f64>> = [15.5, 14.9, 15.2].iter().map(|q| vec![14.98, *q, 12.0]).collect();
    let answer = follow(&robot, &path, None);
    assert!(answer.complete);
    let at: Vec<f64> = answer.events.iter().map(|event| event.at).collect();
    assert_eq!(at.len(), 2);
    assert!((at[0] - (1.0 + 0.5 / 0.6)).abs() < 1e-12 && (at[1] - (2.0 + 0.1 / 0.3)).abs() < 1e-12, "{at:?}");
    let kind = |k: usize| answer.events[k].kind;
    assert!(
        matches!(kind(0), PathEventKind::Limit { leaves: true, violation } if (violation.leg, violation.joint) == (2, 2))
    );
    assert!(matches!(kind(1), PathEventKind::Limit { leaves: false, .. }));
}

/// Between two rows the angle of strut 1 rises to a maximum and falls again: `20 r cos = r² + 51` for struts r and 7 on pivots 10 apart.
#[test]
fn limits_crossed_inside_a_stretch_are_reported_out_and_in() {
    let mut robot = two_circles();
    let path = [vec![6.5, 7.0, 8.0], vec![8.0, 7.0, 8.0]];
    let top = (51f64.sqrt() / 10.0).acos();
    let mode = robot.forward(&path[0]).unwrap().modes.into_iter().find(|mode| mode.mode.pose.y > 0.0).unwrap();
    for depth in [1e-3, 1e-6, 1e-9] {
        let bound = top - depth;
        let (half, cosine) = ((100.0 * bound.cos().powi(2) - 51.0).sqrt(), 10.0 * bound.cos());
        robot.legs[0].limits[0] = Some([-1.0, bound]);
        let answer = follow(&robot, &path, Some(mode.mode.pose));
        let wanted = [(cosine - half, true), (cosine + half, false)];
        assert_eq!((answer.complete, answer.events.len()), (true, wanted.len()), "{depth}: {:?}", answer.events);
        for (event, (r, way)) in answer.events.iter().zip(wanted) {
            let PathEventKind::Limit { violation, leaves } = event.kind else { panic!("{event:?}") };
            assert_eq!((violation.leg, violation.joint, leaves), (1, 1, way));
            // Near its top the angle fixes r to the square root of rounding only.
            let certain = 1e-14 / depth.sqrt() * 10.0 + 1e-13;
            assert!((event.inputs[0] - r).abs() < certain, "{depth}: {} {r}", event.inputs[0]);
            assert!((event.at - 1.0 - (r - 6.5) / 1.5).abs() < certain && (violation.value - bound).abs() < 1e-12);
        }
    }
    // Just above the top nothing is crossed.
    robot.legs[0].limits[0] = Some([-1.0, top + 1e-9]);
    assert!(follow(&robot, &path, Some(mode.mode.pose)).events.is_empty());
}

#[test]
fn a_narrow_range_and_a_narrow_gap_are_not_stepped_over() {
    let mut robot = shipped();
    let path = [vec![14.98, 15.3, 12.0], vec![14.98, 15.4, 12.0]];
    robot.legs[1].limits[1] = Some([15.35, 15.3501]);
    let answer = follow(&robot, &path, None);
    let at: Vec<f64> = answer.events.iter().map(|event| event.at).collect();
    // Outside from the start, in, out.
    assert_eq!(at.len(), 3, "{:?}", answer.events);
    assert!((at[1] - 1.5).abs() < 1e-9 && (at[2] - 1.501).abs() < 1e-9, "{at:?}");
    // A passive joint that may be anywhere but in a narrow gap.
    robot.legs[1].limits[1] = None;
    let plain = follow(&robot, &path, None);
    let angle = |row: usize| {
        let modes = robot.forward(&path[row]).unwrap().modes;
        let pose = plain.rows[row].pose;
        modes.iter().find(|m| (m.mode.pose.x - pose.x).abs() < 1e-9).unwrap().joints[0][0]
    };
    let (middle, width) = ((angle(0) + angle(1)) / 2.0, (angle(1) - angle(0)).abs() * 1e-3);
    robot.legs[0].limits[0] = Some([middle + width, middle - width]);
    let answer = follow(&robot, &path, None);
    assert_eq!(answer.events.len(), 2, "{:?}", answer.events);
    assert!(answer.events.iter().all(|event| (event.at - 1.5).abs() < 0.05));
}

#[test]
fn a_self_motion_is_called_one() {
    // Congruent triangles: equal struts leave a parallelogram that moves.
    let corners = [[0.0, 0.0], [4.0, 0.0], [1.0, 3.0]];
    let robot = Manipulator::new("", corners.map(|a| Leg::rpr(a, a)).to_vec()).unwrap();
    let settings = PathSettings::default();
    let equal = vec![5.0; 3];
    let on_it = Some(Pose::new(3.0, 4.0, 0.0));
    let error = robot.follow(&[equal.clone(), equal.clone()], on_it, &settings).unwrap_err().to_string();
    assert!(error.contains("self-motion") && error.contains("translation at phi = 0 rad"), "{error}");
    assert!(error.contains("through the start [3, 4, 0]"), "{error}");
    // Two struts bring the platform's origin onto the base pivot of the third, about which the platform then turns.
    let legs =
        vec![Leg::rpr([0.0, 0.0], [0.0, 0.0]), Leg::rpr([6.0, 0.0], [0.0, 0.0]), Leg::rpr([3.0, 4.0], [2.0, 0.0])];
    let robot = Manipulator::new("", legs).unwrap();
    for strokes in [vec![4.75, 5.25], vec![4.75, 5.0, 5.25], vec![5.5, 5.25, 4.75]] {
        let path: Vec<Vec<f64>> = strokes.iter().map(|q| vec![*q, 5.0, 2.0]).collect();
        let upper = robot.forward(&path[0]).unwrap().modes.into_iter().find(|mode| mode.mode.pose.y > 0.0).unwrap();
        let answer = follow(&robot, &path, Some(upper.mode.pose));
        let event = answer.events.last().unwrap();
        assert!(!answer.complete && event.kind == (PathEventKind::SelfMotion { phi: None }), "{event:?}");
        assert_eq!(event.inputs, [5.0, 5.0, 2.0], "{event:?}");
    }
}

#[test]
fn what_cannot_be_followed_is_refused() {
    let robot = shipped();
    let settings = PathSettings::default();
    let message = |path: &[Vec<f64>], from| robot.follow(path, from, &settings).unwrap_err().to_string();
    assert_eq!(message(&[], None), "the path has no rows");
    let rows = [vec![14.98, 15.38, 12.0], vec![1.0, f64::NAN, 2.0]];
    assert_eq!(message(&rows, None), "row 2: leg 2: input of joint 2: NaN must be finite");
    assert_eq!(message(&[vec![1.0, 2.0]], None), "row 1: inputs: 2 given, 3 actuated joints");
    assert_eq!(message(&[vec![1.0, 1.0, 1.0]], None), "row 1 has no assembly mode");
    let far = Some(Pose::new(0.0, 0.0, 0.0));
    assert!(message(&rows[..1], far).starts_with("no assembly mode of row 1 is within 0.001"));
}
