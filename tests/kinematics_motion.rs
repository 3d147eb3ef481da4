//! The matrices and the acceleration term against dual numbers, differences and reference values.

use assur::nalgebra::{Vector2, Vector3};
use assur::{JointKind, Leg, Manipulator, Placement, Pose};
use std::ops::{Add, Mul, Sub};

/// A number with its first and second derivative by time.
#[derive(Clone, Copy, Debug)]
struct Jet([f64; 3]);

impl Jet {
    fn constant(value: f64) -> Self {
        Self([value, 0.0, 0.0])
    }
    fn sine(self) -> Self {
        let ([_, d, e], (s, c)) = (self.0, self.0[0].sin_cos());
        Self([s, c * d, c * e - s * d * d])
    }
    fn cosine(self) -> Self {
        let ([_, d, e], (s, c)) = (self.0, self.0[0].sin_cos());
        Self([c, -s * d, -s * e - c * d * d])
    }
}

impl Add for Jet {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] + o.0[k]))
    }
}
impl Sub for Jet {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] - o.0[k]))
    }
}
impl Mul for Jet {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        let ([a, b, c], [p, q, r]) = (self.0, o.0);
        Self([a * p, b * p + a * q, c * p + 2.0 * b * q + a * r])
    }
}

/// A frame in motion: origin and angle.
#[derive(Clone, Copy)]
struct Frame {
    x: Jet,
    y: Jet,
    angle: Jet,
}

impl Frame {
    fn shifted(self, along: Jet, across: Jet, turn: Jet) -> Self {
        let (s, c) = (self.angle.sine(), self.angle.cosine());
        Self { x: self.x + c * along - s * across, y: self.y + s * along + c * across, angle: self.angle + turn }
    }
    fn placed(self, p: &Placement) -> Self {
        let turn = p.direction.y.atan2(p.direction.x);
        self.shifted(Jet::constant(p.at.x), Jet::constant(p.at.y), Jet::constant(turn))
    }
}

/// The platform's motion when the joints of a leg move so.
fn pose_of(leg: &Leg, joints: &[Jet; 3]) -> Frame {
    let zero = Jet::constant(0.0);
    let mut frame = Frame { x: zero, y: zero, angle: zero }.placed(&leg.base);
    for (k, &q) in joints.iter().enumerate() {
        frame = match leg.joints[k] {
            JointKind::Revolute => frame.shifted(zero, zero, q),
            JointKind::Prismatic => frame.shifted(q, zero, zero),
        };
        if let Some(link) = leg.links.get(k) {
            frame = frame.placed(link);
        }
    }
    // Back from the leg's end to the platform's origin.
    let turn = leg.platform.direction.y.atan2(leg.platform.direction.x);
    let frame = frame.shifted(zero, zero, Jet::constant(-turn));
    frame.shifted(Jet::constant(-leg.platform.at.x), Jet::constant(-leg.platform.at.y), zero)
}

fn leg_of(chain: &str, actuated: usize, seed: f64) -> Leg {
    let text: String =
        chain.chars().enumerate().map(|(k, c)| if k == actuated { format!("_{c}_") } else { c.to_string() }).collect();
    let n = |k: f64| (seed * 7.3 + k * 2.9).sin();
    Leg {
        base: Placement::turned(2.0 * n(1.0), 2.0 * n(2.0), 3.0 * n(3.0)),
        links: [
            Placement::turned(1.2 + n(4.0), 0.6 * n(5.0), 1.3 + 0.6 * n(6.0)),
            Placement::turned(1.1 + n(7.0), 0.6 * n(8.0), 1.2 + 0.6 * n(9.0)),
        ],
        platform: Placement::turned(n(10.0), n(11.0), 3.0 * n(12.0)),
        ..text.parse().expect("a leg type")
    }
}

const CHAINS: [&str; 7] = ["RRR", "RPR", "PRR", "RRP", "PPR", "PRP", "RPP"];

/// A robot whose first leg is the one in question; the others take no part in its row.
fn with_others(leg: &Leg, joints: &[f64; 3]) -> (Manipulator, Vec<[f64; 3]>) {
    let other = |x: f64| Leg::rpr([x, 5.0], [0.3 * x, 0.1]);
    let robot = Manipulator::new("", vec![leg.clone(), other(-3.0), other(4.0)]).expect("sound");
    (robot, vec![*joints, [0.3, 2.0, 0.1], [0.5, 3.0, 0.2]])
}

#[test]
fn rows_and_acceleration_terms_of_all_leg_types_agree_with_jets() {
    for chain in CHAINS {
        for actuated in 0..3 {
            for seed in 0..40 {
                let seed = f64::from(seed);
                let leg = leg_of(chain, actuated, seed);
                let value = |k: f64| 2.0 * (1.7 * seed + k).sin();
                let joints = [value(0.3), value(1.9), value(4.1)];
                let (robot, all) = with_others(&leg, &joints);
                let here = pose_of(&leg, &joints.map(Jet::constant));
                let pose = Pose::new(here.x.0[0], here.y.0[0], here.angle.0[0]);
                let velocity = robot.velocity_at(&pose, &all);
                let row = velocity.pose_matrix.row(0).transpose();
                let entry = velocity.input_matrix[(0, 0)];
                let scale = row.norm();
                // Entries: each joint alone.
                for k in 0..3 {
                    let moving: [Jet; 3] = std::array::from_fn(|j| Jet([joints[j], f64::from(u8::from(j == k)), 0.0]));
                    let moved = pose_of(&leg, &moving);
                    let twist = Vector3::new(moved.x.0[1], moved.y.0[1], moved.angle.0[1]);
                    let expected = if k == actuated { -entry } else { 0.0 };
                    let error = (row.dot(&twist) - expected).abs();
                    assert!(error < 1e-12 * (1.0 + scale * twist.norm()), "{} joint {k}: {error:e}", leg.name());
                }
                // The stated scaling: distance of idle pivots, one, or the sine.
                let force = row.xy().norm();
                match leg.passive_joints().as_str() {
                    "PR" | "RP" => assert!((force - 1.0).abs() < 1e-12),
                    "PP" => assert!(force < 1e-15 && row.z.abs() <= 1.0),
                    _ => assert!(force > 0.0),
                }
                // Acceleration: all joints in motion.
                let rates = [value(5.2), value(6.6), value(7.7)];
                let accelerations = [value(8.1), value(9.4), value(0.8)];
                let moved = pose_of(&leg, &std::array::from_fn(|j| Jet([joints[j], rates[j], accelerations[j]])));
                let [first, second] = [1, 2].map(|d: usize| Vector3::new(moved.x.0[d], moved.y.0[d], moved.angle.0[d]));
                let inputs = Vector3::new(rates[actuated], 0.3, -0.4);
                if scale < 1e-3 {
                    continue;
                }
                let beta = velocity.quadratic_term(&first, &inputs).expect("regular")[0];
                let terms = [row.dot(&second), entry * accelerations[actuated], beta];
                let size: f64 =
                    terms.iter().map(|t| t.abs()).sum::<f64>() + scale * (second.norm() + first.norm_squared());
                let error = terms.iter().sum::<f64>().abs();
                assert!(error < 1e-12 * size.max(1.0) / scale.min(1.0), "{}: {error:e} of {size:e}", leg.name());
                let found = velocity.joint_rates(&first, &inputs).expect("regular")[0];
                let off = (0..3).map(|j| (found[j] - rates[j]).abs()).fold(0.0, f64::max);
                assert!(off < 1e-11 * size.max(1.0) / scale.min(1.0), "{}: {off:e}", leg.name());
            }
        }
    }
}

#[test]
fn input_rates_agree_with_differences_of_the_inverse() {
    for family in ["3-RPR", "3-RRR", "3-PRR", "3-RRP", "3-PRP", "3-PPR", "3-_R_PR", "3-RR_P_", "R_P_R,_P_RR,RP_P_"] {
        let (robot, inputs) = Manipulator::of_family(family).expect("a family");
        // The mode farthest from the ends of its legs' reach, where third derivatives are large.
        let modes = robot.forward(&inputs).expect("sound").modes;
        let sine =
            |m: &assur::ManipulatorMode| robot.velocity_at(&m.mode.pose, &m.joints).singularity(1.0).sigma_min_input;
        let mode = modes.iter().max_by(|p, q| sine(p).total_cmp(&sine(q))).expect("assembles");
        let (pose, signs) = (mode.mode.pose, &mode.signs);
        let rates = Vector3::new(0.4, -0.3, 0.2);
        let at = |t: f64| {
            let moved = Pose::new(pose.x + t * rates.x, pose.y + t * rates.y, pose.phi + t * rates.z);
            Vector3::from_vec(robot.inputs_of(&robot.working_mode(&moved, signs).expect("reaches").joints))
        };
        let h = 1e-4;
        let difference = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
        let found = robot.velocity(&pose, signs).expect("reaches").input_rates(&rates).expect("regular");
        assert!((found - difference).norm() < 1e-7 * (1.0 + found.norm()), "{family}: {found} {difference}");
    }
}

fn numbers(value: &serde_json::Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|v| v.as_f64().expect("a number")).collect()
}

fn golden() -> serde_json::Value {
    let text = include_str!("golden/prr.json");
    serde_json::from_str::<serde_json::Value>(text).expect("sound JSON")["prr"].clone()
}

fn design(geometry: &serde_json::Value) -> Manipulator {
    let list = |key: &str, k: usize| numbers(&geometry[key][k]);
    let number = |key: &str, k: usize| geometry[key][k].as_f64().expect("a number");
    let leg = |k: usize| {
        let (a, c) = (list("A", k), list("c", k));
        Leg::prr([a[0], a[1]], number("alpha", k), number("l", k), [c[0], c[1]])
    };
    Manipulator::new("", (0..3).map(leg).collect()).expect("sound")
}

fn signs_of(value: &serde_json::Value) -> String {
    numbers(value).iter().map(|s| if *s > 0.0 { '+' } else { '-' }).collect()
}

/// Reference values of 3-PRR: printed to 16 digits, held to 1e-9.
#[test]
fn prr_reference_values() {
    let data = golden();
    let near = |found: &[f64], wanted: &serde_json::Value| {
        let wanted = numbers(wanted);
        assert_eq!(found.len(), wanted.len());
        assert!(found.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?} {wanted:?}");
    };
    let case = &data["ik_case"];
    let robot = design(&data[case["design"].as_str().expect("a name")]["geometry"]);
    let pose = numbers(&case["pose"]);
    let modes = robot.inverse(&Pose::new(pose[0], pose[1], pose[2])).expect("finite");
    assert_eq!(modes.modes.len(), 8);
    for solution in case["solutions"].as_array().expect("a list") {
        let mode = modes.mode(&signs_of(&solution["signs"])).expect("a mode of this name");
        near(&robot.inputs_of(&mode.joints), &solution["rho"]);
    }

    let case = &data["diff_case"];
    let robot = design(&data[case["design"].as_str().expect("a name")]["geometry"]);
    let pose = numbers(&case["pose"]);
    let velocity = robot.velocity(&Pose::new(pose[0], pose[1], pose[2]), &signs_of(&case["signs"])).expect("reaches");
    near(&robot.inputs_of(&velocity.joints), &case["rho"]);
    for k in 0..3 {
        let row: Vec<f64> = velocity.pose_matrix.row(k).iter().copied().collect();
        near(&row, &case["A"][k]);
        assert!((velocity.input_matrix[(k, k)] - case["B"][k].as_f64().expect("a number")).abs() < 1e-9);
    }
    let vector = |key: &str| Vector3::from_vec(numbers(&case[key]));
    let (p_dot, p_ddot) = (vector("p_dot"), vector("p_ddot"));
    let rho_dot = velocity.input_rates(&p_dot).expect("regular");
    near(rho_dot.as_slice(), &case["rho_dot"]);
    near(velocity.quadratic_term(&p_dot, &rho_dot).expect("regular").as_slice(), &case["bias"]);
    let rho_ddot = velocity.input_accelerations(&p_dot, &p_ddot).expect("regular");
    near(rho_ddot.as_slice(), &case["rho_ddot"]);
    assert!((velocity.dexterity(1.0) - case["dexterity_Lc_1"].as_f64().expect("a number")).abs() < 1e-9);
    assert!((velocity.dexterity(0.5) - case["dexterity_Lc_0p5"].as_f64().expect("a number")).abs() < 1e-9);

    for case in data["fk_cases"].as_array().expect("a list") {
        let answer = design(&case["geometry"]).forward(&numbers(&case["rho"])).expect("sound");
        let poses = case["poses"].as_array().expect("a list");
        assert_eq!(answer.modes.len(), poses.len());
        for pose in poses.iter().map(numbers) {
            let close = |m: &assur::ManipulatorMode| {
                Vector2::new(m.mode.pose.x - pose[0], m.mode.pose.y - pose[1]).norm() < 1e-9
                    && ((m.mode.pose.phi - pose[2]) / 2.0).sin().abs() < 1e-9
            };
            assert!(answer.modes.iter().any(close), "{pose:?}");
        }
    }
}
