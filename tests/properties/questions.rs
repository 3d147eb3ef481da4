//! Questions that cannot be asked are refused with one line that says why.

use assur::{Dyad, Leg, Manipulator, Offset, PinnedDyad, Triad, nalgebra::Vector2};

fn robot(names: [&str; 3]) -> Manipulator {
    let (robot, _) = Manipulator::of_family(&names.join(",")).expect("a known family");
    robot
}

#[test]
fn inputs_are_checked() {
    let mut robot = robot(["R_P_R", "_R_RR", "_P_RR"]);
    robot.legs[0].limits[1] = Some([2.0, 9.0]);
    robot.legs[1].limits[0] = Some([3.0, -3.0]);
    let refused = |inputs: &[f64]| robot.forward(inputs).expect_err("must be refused").to_string();
    assert_eq!(refused(&[5.0, 1.0]), "inputs: 2 given, 3 actuated joints");
    assert_eq!(refused(&[5.0, 1.0, 2.0, 3.0]), "inputs: 4 given, 3 actuated joints");
    assert_eq!(refused(&[5.0, f64::NAN, 2.0]), "leg 2: input of joint 1: NaN must be finite");
    assert_eq!(refused(&[f64::INFINITY, 3.1, 2.0]), "leg 1: input of joint 2: inf must be finite");
    assert_eq!(refused(&[9.5, 3.1, 2.0]), "leg 1: input 9.5 of joint 2 is outside limits [2, 9]");
    // The revolute range runs through half a turn.
    assert_eq!(refused(&[9.0, 0.0, 2.0]), "leg 2: input 0 of joint 1 is outside limits [3, -3]");
    assert!(robot.forward(&[9.0, -3.1, 2.0]).is_ok());
}

#[test]
fn an_orientation_fixed_twice_is_refused_with_the_legs() {
    let expected = "legs 1 and 3 are both left with PP: the orientation is fixed twice and a translation is left free, so three \
                    actuators do not determine the pose";
    // The catalogue refuses such a family, for the same reason.
    let legs = ["_R_PP", "R_P_R", "PP_R_"].map(|name| name.parse::<Leg>().expect("a leg type"));
    let robot = Manipulator::new("", legs.to_vec()).expect("is sound");
    let refused = robot.forward(&[0.1, 5.0, 0.2]).expect_err("must be refused");
    assert_eq!(refused.to_string(), expected);
    let refused = Manipulator::of_family("_R_PP,R_P_R,PP_R_").expect_err("must be refused");
    assert_eq!(refused.to_string(), format!("family \"_R_PP,R_P_R,PP_R_\": {expected}"));
}

#[test]
fn parallel_passive_sliders_are_refused() {
    let mut robot = robot(["_R_PP", "R_P_R", "R_P_R"]);
    robot.legs[0].links[1].direction = Vector2::new(2.0, 0.0);
    let refused = robot.forward(&[0.1, 5.0, 5.0]).expect_err("must be refused").to_string();
    assert!(refused.starts_with("leg 1: its passive sliders are parallel"), "{refused}");
}

#[test]
fn descriptions_are_checked() {
    let refused = |legs: &[&str]| {
        let legs = legs.iter().map(|name| name.parse::<Leg>().expect("a leg's name")).collect();
        Manipulator::new("", legs).expect_err("must be refused").to_string()
    };
    assert_eq!(refused(&["R_P_R"]), "leg: 1 given, must be 3 (or 2, with the three actuators on two legs)");
    assert_eq!(refused(&["R_P_R"; 4]), "leg: 4 given, must be 3 (or 2, with the three actuators on two legs)");
    assert_eq!(refused(&["R_P_R", "RRR", "_R_RR"]), "leg: 2 actuated joints in all (R_P_R,RRR,_R_RR), must be 3");
}

#[test]
fn dyads_are_checked() {
    let zero = Vector2::zeros();
    let sound = Dyad::RR { a: zero, b: zero, length: 1.0 };
    let refused = |leg| Triad::new([sound, leg, sound]).expect_err("must be refused").to_string();
    assert_eq!(refused(Dyad::RR { a: zero, b: zero, length: -0.3 }), "leg 2: length -0.3 must be ≥ 0");
    let nan = Vector2::new(0.0, f64::NAN);
    assert_eq!(refused(Dyad::PR { a: nan, u: Vector2::x(), b: zero }), "leg 2: a must be finite, not NaN");
    assert_eq!(refused(Dyad::PR { a: zero, u: zero, b: zero }), "leg 2: direction u must not be [0, 0]");
    let rp = |v, offset| Dyad::RP { a: zero, b: zero, v, offset };
    assert_eq!(refused(rp(zero, Offset::Distance(0.0))), "leg 2: direction v must not be [0, 0]");
    assert_eq!(refused(rp(Vector2::x(), Offset::Distance(f64::INFINITY))), "leg 2: d must be finite, not inf");
    assert_eq!(refused(Dyad::PP { phi: f64::NAN }), "leg 2: phi must be finite, not NaN");
    let pinned = PinnedDyad::new(nan, zero, sound).expect_err("must be refused");
    assert_eq!(pinned.to_string(), "pin: NaN must be finite");
}
