//! The 21 leg types and the dyads they leave when their driver is held.
//!
//! `cargo run --release --example leg_reductions` prints the document; its identities are checked while it is written.

mod dice;
mod page;

use std::f64::consts::{FRAC_PI_2, TAU};

use assur::algebra::{Domain, Gaussian, Integer, Rational, Ring, dyadic, nearest_f64};
use assur::nalgebra::Vector2;
use assur::{Dyad, JointKind, Leg, LockedGroup, Manipulator, Offset, Placement, Remark};
use dice::Dice;
use page::Page;

/// Exact points and rotations of the plane.
type Point = Gaussian<Rational>;

/// Leg types by the dyad they leave, and what the driver moves.
const TYPES: [(&str, &str, &[&str]); 21] = [
    ("_R_RR", "RR", &["a"]),
    ("R_R_R", "RR", &["length"]),
    ("RR_R_", "RR", &["b"]),
    ("RR_P_", "RR", &["b"]),
    ("R_P_R", "RR", &["length"]),
    ("_P_RR", "RR", &["a"]),
    ("_R_PR", "PR", &["direction", "offset"]),
    ("P_R_R", "PR", &["offset"]),
    ("PR_R_", "PR", &["b"]),
    ("PR_P_", "PR", &["b"]),
    ("_P_PR", "PR", &["offset"]),
    ("P_P_R", "PR", &["offset"]),
    ("_R_RP", "RP", &["a"]),
    ("R_R_P", "RP", &["offset"]),
    ("RP_R_", "RP", &["direction", "offset"]),
    ("R_P_P", "RP", &["offset"]),
    ("RP_P_", "RP", &["offset"]),
    ("_P_RP", "RP", &["a"]),
    ("_R_PP", "PP", &["orientation"]),
    ("P_R_P", "PP", &["orientation"]),
    ("PP_R_", "PP", &["orientation"]),
];

/// Legs with random numbers, for each type.
const DRAWS: usize = 50;

/// How far a number in `f64` may lie from the exact one: two units in the last place at the size of these legs, below 64.
const ROUNDING: f64 = 1.0 / (1_u64 << 46) as f64;

const OPENING: &str = "\
Claim. A leg of three joints R or P, not all P, with one joint held, restrains the platform as one of four
dyads, named by the two joints left: 18 types leave RR, PR or RP (6 each), 3 leave PP; 21 in all. Of
the 1771 manipulators of three such legs 118 can never hold the platform; 1653 are left, 1140 of them
without PP.

Symbols.  T_0 .. T_3    placements base, links[0], links[1], platform, as motions
          J_k(q)        joint k: R turns by q, P slides by q along x
          pose          X + R z, R = e^(i phi)
          N, M, F       near, middle and far part of the held leg; N = (n, nu): z -> n + nu z,
                        likewise M = (m, mu), F = (f, chi)
          underscores   stand around the held joint: R_P_R
          g.h, '        dot product of plane vectors; conjugate

Source.   Worked out here; the seven chains are those of Merlet, Parallel Robots, 2nd ed. (2006).";

/// The document, checked line by line while it is made.
pub fn document() -> String {
    let mut page = Page::new("The 21 leg reductions", OPENING);
    three_parts(&mut page);
    four_dyads(&mut page);
    drivers(&mut page);
    in_numbers(&mut page);
    counts(&mut page);
    page.finish()
}

fn three_parts(page: &mut Page) {
    page.step(
        "A held leg has three parts",
        "The leg closes where T_0 J_1 T_1 J_2 T_2 J_3 = pose T_3. A held joint is a fixed motion and joins its
neighbours, so that N J M J' = pose F with the two joints J, J' that are left:
    held first     N = T_0 J_1 T_1     M = T_2             F = T_3
    held second    N = T_0             M = T_1 J_2 T_2     F = T_3
    held third     N = T_0             M = T_1             F = T_3 (T_2 J_3)^-1",
    );
    let mut dice = Dice::new(21);
    for held in 0..3 {
        let holds = (0..TYPES.len() * DRAWS).all(|k| {
            let leg = ExactLeg::random(TYPES[k % TYPES.len()].0, &mut dice);
            let [n, m, f] = leg.parts(held);
            let [j, k] = others(held).map(|joint| leg.joint(joint));
            n.then(&j).then(&m).then(&k) == leg.pose().then(&f)
        });
        page.holds(
            &format!("held joint {}: N J M J' = pose F at {} random legs", held + 1, TYPES.len() * DRAWS),
            holds,
        );
    }
}

fn four_dyads(page: &mut Page) {
    page.step(
        "Four dyads",
        "The motion N J M J' sends the origin, and turns the plane, as follows (q, p the two joint values):
    RR    n + nu e^(iq) m                        so |X + R f - n| = |m|
    PR    n + nu (q + m)                         so X + R f lies on the line n + nu m + t nu
    RP    n + nu e^(iq) (m + mu p)               so (R i chi).(n - X - R f) = -Im(mu' m)
    PP    turned by nu mu                        so R = nu mu chi'
In the third, the whole is turned by nu e^(iq) mu = R chi, whence X + R f - n = R chi (mu' m + p). The
dyads, in the terms of linkage::Dyad:
    RR    a = n            length = |m|     b = f
    PR    a = n + nu m     u = nu           b = f
    RP    a = n            v = chi          b = f       d = -Im(mu' m)
    PP    phi = the angle of nu mu chi'
Each equation is checked exactly at planted joint values: placements with rational numbers and rational
rotations (p + iq)^2/(p^2 + q^2), the pose from the closure. Cleared of denominators, the equations have
total degree 60 at most in the numbers drawn from -10^6 .. 10^6: a false one would pass one draw with
probability at most 60/(2 10^6 + 1) (Schwartz, Zippel), and all 50 with less than 10^-200.",
    );
    let mut dice = Dice::new(22);
    for dyad in ["RR", "PR", "RP", "PP"] {
        let types: Vec<_> = TYPES.iter().filter(|t| t.1 == dyad).map(|t| t.0).collect();
        let holds = types.iter().all(|text| {
            (0..DRAWS).all(|_| {
                let leg = ExactLeg::random(text, &mut dice);
                let reduced = leg.reduced();
                reduced.name() == dyad && reduced.holds_at(&leg.pose())
            })
        });
        page.holds(&format!("{dyad}: {} at {DRAWS} draws each", types.join(", ")), holds);
    }
}

fn drivers(page: &mut Page) {
    page.step(
        "What each driver moves",
        "The dyad is computed at two values of the held joint; listed is what differs. A line is told by its
direction and its offset, the product of its normal with a point of it (for RP: (i chi).f + d), since
its point may be moved along it. So a slider parallel to the dyad's own has no effect on it.",
    );
    let mut dice = Dice::new(23);
    for (text, dyad, moved) in TYPES {
        let always = (0..DRAWS).all(|_| {
            let leg = ExactLeg::random(text, &mut dice);
            let other = leg.with_another_input(&mut dice);
            other.reduced().differences(&leg.reduced()) == moved
        });
        page.holds(&format!("{text}  leaves {dyad}, moves {}", moved.join(" and ")), always);
    }
    let parallel = ["_P_PR", "P_P_R", "R_P_P", "RP_P_"];
    let without_effect = parallel.iter().all(|text| {
        let mut leg = ExactLeg::random(text, &mut dice);
        // The link between the two sliders is not turned.
        let between = if text.ends_with('R') { 1 } else { 2 };
        leg.placements[between].turn = Point::one();
        leg.with_another_input(&mut dice).reduced().differences(&leg.reduced()).is_empty()
    });
    page.holds(&format!("{}: parallel sliders, nothing moves", parallel.join(", ")), without_effect);
}

fn in_numbers(page: &mut Page) {
    page.step(
        "The library",
        "Manipulator::lock reduces each leg in f64. It is compared with the dyads of step 2 at data that f64
holds exactly: whole coordinates, revolute inputs of quarter turns. With placements turned by quarter
turns the two agree in every digit, lengths to the one rounding of their square root. With placements
turned to Pythagorean directions, (3, 4) and the like, directions still agree exactly, and points,
lengths and angles to 2^-46, two units in the last place at this size.",
    );
    let mut dice = Dice::new(24);
    for (text, ..) in TYPES {
        for quarter_turns in [true, false] {
            for _ in 0..DRAWS {
                let (leg, exact) = whole_leg(text, quarter_turns, &mut dice);
                let locked = locked_dyad(&leg, &exact);
                let tolerance = if quarter_turns { 0.0 } else { ROUNDING };
                let agrees = exact.reduced().agrees_with(&locked, tolerance);
                assert!(agrees, "{text}, quarter turns {quarter_turns}: {locked:?} for {leg:?}");
            }
        }
        page.holds(&format!("{text}: {DRAWS} times in quarter turns, {DRAWS} times in Pythagorean directions"), true);
    }
}

fn counts(page: &mut Page) {
    page.step(
        "How many there are",
        "Three legs out of 21 types, repetition allowed and order aside, are C(23, 3) = 1771 manipulators. Two
PP legs fix the orientation twice and leave a translation free: C(4, 2) . 18 + C(5, 3) = 118. Without
any PP leg there are C(20, 3) = 1140. Counted here one by one, with Manipulator::degree_bound (0: never
determinate) and Manipulator::remarks.",
    );
    let legs: Vec<Leg> = TYPES.iter().map(|t| t.0.parse().expect("a leg type")).collect();
    let chains = |kinds: [JointKind; 3]| kinds != [JointKind::Prismatic; 3];
    let different = (1..legs.len()).all(|i| (0..i).all(|j| legs[i] != legs[j]));
    page.holds(
        "21 = 7 chains, 3 joints to hold each: all different, none PPP, each as named",
        different && legs.iter().zip(TYPES).all(|(leg, t)| chains(leg.joints) && leg.name() == t.0),
    );
    let by_dyad = ["RR", "PR", "RP", "PP"].map(|dyad| legs.iter().filter(|leg| leg.passive_joints() == dyad).count());
    page.equal("they leave RR, PR, RP, PP: 6, 6, 6, 3 times", &by_dyad, &[6, 6, 6, 3]);
    let (mut all, mut never, mut without_pp) = (0, 0, 0);
    for i in 0..legs.len() {
        for j in i..legs.len() {
            for k in j..legs.len() {
                let robot = Manipulator::new("", [i, j, k].map(|n| legs[n].clone()).to_vec()).expect("is one");
                let fixing = robot.legs.iter().filter(|leg| leg.passive_joints() == "PP").count();
                let refused = robot.degree_bound() == Some(0);
                assert_eq!(refused, fixing >= 2, "{}", robot.family());
                assert_eq!(refused, robot.remarks().contains(&Remark::OrientationTwice), "{}", robot.family());
                all += 1;
                never += usize::from(refused);
                without_pp += usize::from(fixing == 0);
            }
        }
    }
    page.equal(
        "1771 in all; 118 with two PP or three; 1653 = 1771 - 118; 1140 without PP",
        &[all, never, all - never, without_pp],
        &[1771, 118, 1653, 1140],
    );
}

/// A rigid motion `z -> at + turn z`, `|turn| = 1`.
#[derive(Clone, Debug, PartialEq)]
struct Motion {
    at: Point,
    turn: Point,
}

impl Motion {
    fn then(&self, next: &Self) -> Self {
        Self { at: self.at.clone() + self.turn.clone() * next.at.clone(), turn: self.turn.clone() * next.turn.clone() }
    }

    fn inverse(&self) -> Self {
        Self { at: -(self.turn.conj() * self.at.clone()), turn: self.turn.conj() }
    }
}

/// A leg with all its numbers exact, joint values included.
#[derive(Clone, Debug)]
struct ExactLeg {
    joints: [JointKind; 3],
    held: usize,
    /// Base, links, platform.
    placements: [Motion; 4],
    /// A slider's value is `at`, a revolute joint's `turn`.
    values: [Motion; 3],
}

impl ExactLeg {
    fn of(text: &str, placements: [Motion; 4], values: [Motion; 3]) -> Self {
        let leg: Leg = text.parse().expect("a leg type");
        let held = leg.actuated.iter().position(|&actuated| actuated).expect("one joint is held");
        let values = [0, 1, 2].map(|k: usize| match leg.joints[k] {
            JointKind::Revolute => Motion { at: Point::zero(), turn: values[k].turn.clone() },
            JointKind::Prismatic => Motion { at: Point::real(values[k].at.re.clone()), turn: Point::one() },
        });
        Self { joints: leg.joints, held, placements, values }
    }

    fn random(text: &str, dice: &mut Dice) -> Self {
        Self::of(text, [0; 4].map(|_| random_motion(dice)), [0; 3].map(|_| random_motion(dice)))
    }

    /// The same with the held joint elsewhere.
    fn with_another_input(&self, dice: &mut Dice) -> Self {
        let mut other = self.clone();
        while other.values == self.values {
            let value = random_motion(dice);
            other.values[self.held] = match self.joints[self.held] {
                JointKind::Revolute => Motion { at: Point::zero(), turn: value.turn },
                JointKind::Prismatic => Motion { at: Point::real(value.at.re), turn: Point::one() },
            };
        }
        other
    }

    fn joint(&self, k: usize) -> Motion {
        self.values[k].clone()
    }

    /// The pose that these joint values give.
    fn pose(&self) -> Motion {
        let [base, first, second, platform] = &self.placements;
        let [j1, j2, j3] = &self.values;
        base.then(j1).then(first).then(j2).then(second).then(j3).then(&platform.inverse())
    }

    /// `N`, `M`, `F` of step 1.
    fn parts(&self, held: usize) -> [Motion; 3] {
        let [base, first, second, platform] = self.placements.clone();
        let fixed = self.joint(held);
        match held {
            0 => [base.then(&fixed).then(&first), second, platform],
            1 => [base, first.then(&fixed).then(&second), platform],
            _ => [base, first, platform.then(&second.then(&fixed).inverse())],
        }
    }

    /// The dyad of step 2.
    fn reduced(&self) -> Reduced {
        use JointKind::{Prismatic as P, Revolute as R};
        let [near, middle, far] = self.parts(self.held);
        match others(self.held).map(|k| self.joints[k]) {
            [R, R] => Reduced::Circle { a: near.at, b: far.at, square: middle.at.norm_sqr() },
            [P, R] => Reduced::Line { a: near.then(&middle).at, u: near.turn, b: far.at },
            [R, P] => {
                let d = -(middle.turn.conj() * middle.at).im;
                Reduced::PlatformLine { a: near.at, b: far.at, v: far.turn, d }
            }
            [P, P] => Reduced::Orientation { turn: near.turn * middle.turn * far.turn.conj() },
        }
    }
}

fn others(held: usize) -> [usize; 2] {
    [[1, 2], [0, 2], [0, 1]][held]
}

fn random_motion(dice: &mut Dice) -> Motion {
    let mut number = || Rational::from(dice.integer(1_000_000)) / Rational::from(7);
    let at = Point::new(number(), number());
    Motion { at, turn: random_turn(dice) }
}

/// A rotation that is no quarter turn, lest sliders be parallel.
fn random_turn(dice: &mut Dice) -> Point {
    let (turn, scale) = dice.turn();
    if turn.re.is_zero() || turn.im.is_zero() { random_turn(dice) } else { turn.map(|x| quotient(x, &scale)) }
}

fn quotient(x: &Integer, y: &Integer) -> Rational {
    Rational::from(x.clone()).exact_div(&Rational::from(y.clone())).expect("a triple's hypotenuse is not zero")
}

/// A dyad with its numbers exact; directions have length one.
#[derive(Clone, Debug, PartialEq)]
enum Reduced {
    Circle { a: Point, b: Point, square: Rational },
    Line { a: Point, u: Point, b: Point },
    PlatformLine { a: Point, b: Point, v: Point, d: Rational },
    Orientation { turn: Point },
}

impl Reduced {
    fn name(&self) -> &'static str {
        match self {
            Self::Circle { .. } => "RR",
            Self::Line { .. } => "PR",
            Self::PlatformLine { .. } => "RP",
            Self::Orientation { .. } => "PP",
        }
    }

    /// Whether the dyad's equation holds at a pose, exactly.
    fn holds_at(&self, pose: &Motion) -> bool {
        let placed = |b: &Point| pose.at.clone() + pose.turn.clone() * b.clone();
        match self {
            Self::Circle { a, b, square } => (placed(b) - a.clone()).norm_sqr() == *square,
            Self::Line { a, u, b } => u.cross(&(placed(b) - a.clone())).is_zero(),
            Self::PlatformLine { a, b, v, d } => {
                let normal = pose.turn.clone() * v.turned();
                normal.dot(&(a.clone() - placed(b))) == *d
            }
            Self::Orientation { turn } => pose.turn == *turn,
        }
    }

    /// What tells the condition apart from others of its kind, by name.
    fn marks(&self) -> Vec<(&'static str, Point)> {
        match self.clone() {
            Self::Circle { a, b, square } => vec![("a", a), ("b", b), ("length", Point::real(square))],
            Self::Line { a, u, b } => {
                let offset = u.turned().dot(&a);
                vec![("b", b), ("direction", u), ("offset", Point::real(offset))]
            }
            Self::PlatformLine { a, b, v, d } => {
                let offset = v.turned().dot(&b) + d;
                vec![("a", a), ("direction", v), ("offset", Point::real(offset))]
            }
            Self::Orientation { turn } => vec![("orientation", turn)],
        }
    }

    fn differences(&self, other: &Self) -> Vec<&'static str> {
        self.marks().into_iter().zip(other.marks()).filter(|(x, y)| x != y).map(|(x, _)| x.0).collect()
    }

    /// Whether a dyad in `f64` is this one: directions exactly, points and distances to within `tolerance`.
    fn agrees_with(&self, dyad: &Dyad, tolerance: f64) -> bool {
        let near = |x: &Rational, found: f64| (nearest_f64(&(x.clone() - exact(found)))).abs() <= tolerance;
        let at = |p: &Point, found: &Vector2<f64>| near(&p.re, found.x) && near(&p.im, found.y);
        let along = |p: &Point, found: &Vector2<f64>| {
            let found = Point::new(exact(found.x), exact(found.y));
            p.cross(&found).is_zero() && p.dot(&found) > Rational::zero()
        };
        match (self, dyad) {
            (Self::Circle { a, b, square }, Dyad::RR { a: a_, b: b_, length }) => {
                let rounding = nearest_f64(square).max(1.0) * (2.0 * f64::EPSILON) + 128.0 * tolerance;
                let square_found = exact(*length) * exact(*length);
                at(a, a_) && at(b, b_) && nearest_f64(&(square.clone() - square_found)).abs() <= rounding
            }
            (Self::Line { a, u, b }, Dyad::PR { a: a_, u: u_, b: b_ }) => at(a, a_) && along(u, u_) && at(b, b_),
            (Self::PlatformLine { a, b, v, d }, Dyad::RP { a: a_, b: b_, v: v_, offset }) => {
                // Directions that are no unit vectors come with the distance itself.
                let distance = match offset {
                    Offset::Distance(distance) => near(d, *distance),
                    Offset::TimesDirection(delta) => near(d, *delta) && v_.norm_squared() == 1.0,
                };
                at(a, a_) && at(b, b_) && along(v, v_) && distance
            }
            (Self::Orientation { turn }, Dyad::PP { phi }) => {
                let angle = nearest_f64(&turn.im).atan2(nearest_f64(&turn.re));
                let off = (angle - phi).rem_euclid(TAU);
                off.min(TAU - off) <= tolerance
            }
            _ => false,
        }
    }
}

fn exact(x: f64) -> Rational {
    dyadic(x).expect("a dyad's numbers are finite")
}

/// A leg of whole coordinates, in `f64` and exactly; only its held joint has a value.
///
/// Parallel passive sliders are drawn again: they leave no dyad, and the library refuses them.
fn whole_leg(text: &str, quarter_turns: bool, dice: &mut Dice) -> (Leg, ExactLeg) {
    loop {
        let (leg, exact) = any_whole_leg(text, quarter_turns, dice);
        let [_, middle, _] = exact.parts(exact.held);
        if leg.passive_joints() != "PP" || !middle.turn.im.is_zero() {
            return (leg, exact);
        }
    }
}

fn any_whole_leg(text: &str, quarter_turns: bool, dice: &mut Dice) -> (Leg, ExactLeg) {
    const DIRECTIONS: [[i64; 3]; 8] =
        [[3, 4, 5], [-4, 3, 5], [5, -12, 13], [-12, -5, 13], [8, 15, 17], [15, -8, 17], [-7, 24, 25], [-20, -21, 29]];
    const QUARTERS: [[i64; 3]; 4] = [[1, 0, 1], [0, 1, 1], [-1, 0, 1], [0, -1, 1]];
    let mut pick = |all: &[[i64; 3]]| all[dice.integer(1000).unsigned_abs() as usize % all.len()];
    let mut directions = [0; 4].map(|_| if quarter_turns { pick(&QUARTERS) } else { pick(&DIRECTIONS) });
    let input_turn = dice.integer(2);
    let points = [0; 5].map(|_| [dice.integer(9), dice.integer(9)]);
    if quarter_turns {
        // Lengths of the axis directions may be anything.
        directions[3] = directions[3].map(|x| 2 * x);
    }
    let motion = |k: usize| {
        let ([x, y], [c, s, r]) = (points[k], directions[k]);
        let part = |n: i64| quotient(&Integer::from(n), &Integer::from(r));
        Motion { at: Point::new(Rational::from(x), Rational::from(y)), turn: Point::new(part(c), part(s)) }
    };
    let placement = |k: usize| {
        let ([x, y], [c, s, _]) = (points[k], directions[k]);
        Placement { at: Vector2::new(x as f64, y as f64), direction: Vector2::new(c as f64, s as f64) }
    };
    let turn = Point::new(Rational::zero(), Rational::one()).power((input_turn + 4) as u32);
    let value = Motion { at: Point::real(Rational::from(points[4][0])), turn };
    let leg: Leg = text.parse().expect("a leg type");
    let leg = Leg { base: placement(0), links: [placement(1), placement(2)], platform: placement(3), ..leg };
    let values = [value.clone(), value.clone(), value];
    (leg, ExactLeg::of(text, [motion(0), motion(1), motion(2), motion(3)], values))
}

/// The dyad that `Manipulator::lock` makes of a leg, two RPR legs beside it.
fn locked_dyad(leg: &Leg, exact_leg: &ExactLeg) -> Dyad {
    let value = &exact_leg.values[exact_leg.held];
    let input = match leg.joints[exact_leg.held] {
        JointKind::Prismatic => nearest_f64(&value.at.re),
        JointKind::Revolute => {
            let angle = nearest_f64(&value.turn.im).atan2(nearest_f64(&value.turn.re));
            (angle / FRAC_PI_2).round() * FRAC_PI_2
        }
    };
    let others = [[40.0, 0.0], [0.0, 40.0]].map(|a| Leg::rpr(a, [1.0, 2.0]));
    let [second, third] = others;
    let robot = Manipulator::new("", vec![leg.clone(), second, third]).expect("is a manipulator");
    match robot.lock(&[input, 30.0, 35.0]) {
        Ok(LockedGroup::Triad(triad)) => triad.legs()[0],
        other => panic!("{}: {other:?}", leg.name()),
    }
}

/// Prints the document.
pub fn main() {
    print!("{}", document());
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_identity_of_the_document_holds() {
        assert!(super::document().contains("5. How many there are"));
    }
}
