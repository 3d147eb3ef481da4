//! A limit held at its value leaves a dyad: every joint's range, and the merging of two modes, as a surface with a side.

#[path = "page.rs"]
mod page;

use assur::nalgebra::{Isometry2, Vector2};
use assur::workspace::{ActiveLimit, Limit, LimitCause, WorkspaceModes};
use assur::{Dyad, JointKind, Leg, Manipulator, Placement, Pose};
use page::Page;

/// The text, with every step checked.
pub fn document() -> String {
    let mut page = Page::new(
        "Ranges of any joint as candidate curves",
        "Claim: with one joint held at an end of its range, or with its two modes merged, a leg RPR, RRR or PRR restrains the platform by one of the \
         dyads RR, PR, RP; the leg allows one side of that surface near it, the same in all of a working mode. So the curves that can bound a \
         workspace are circles and lines at a given orientation, circles and lines again where the surface is stationary in the orientation, \
         and coupler curves of two such dyads.\n\n\
         A base pivot (PRR: slider's pivot at stroke 0),   B platform pivot,   b = B from C, platform frame\n\
         u first moving link, w last link (unit vectors),   v = w seen from the platform,   E = elbow\n\n\
         Source: derived here; joints 2 and 3 are not treated by Merlet, Gosselin, Mouly (1998), who list sectors for joint 1 at a given orientation only.",
    );
    page.step(
        "The table",
        "leg  joint 1           joint 2                 joint 3                   modes merge\n\
         RPR  B on a ray: PR    |AB| = |rho|: RR        A on a platform line: RP  |AB| = |o|\n\
         RRR  |B - E| = l2: RR  |AB| by cosine law: RR  |E - A| = l1: RR          |AB| = l1 +- l2\n\
         PRR  |B - M| = l: RR   h = l sin(angle): PR    E on slider's line: PR    h = +-l: PR\n\
         \n\
         The three joint angles enter through unit vectors, so placements of the joint frames only shift where a range begins; E = B - l2 R v, o = the slider's offset. Joint 3 turns back \
         as the platform turns on: its range in v runs from K e(-max) to K e(-min).",
    );
    let mut on_surface = 0.0_f64;
    let mut wrong_side = 0;
    let mut checked = 0;
    for seed in 1..=600 {
        let n = |k: f64| (f64::from(seed) * 1.9 + 2.7 * k).sin();
        let leg = random_leg(seed, &n);
        let robot = Manipulator::new("", vec![leg.clone(); 3]).expect("is sound");
        let reach = robot.reach(&WorkspaceModes::Both).expect("is covered");
        let limits: Vec<Limit> = reach.limits().filter(|limit| limit.leg == 0).copied().collect();
        for joint in 0..3 {
            let Some(range) = leg.limits[joint] else { continue };
            for (end, inward) in [(range[0], 1.0), (range[1], -1.0)] {
                let at = |shift: f64| {
                    let mut q = [2.0 * n(21.0), 2.0 * n(22.0), 2.0 * n(23.0)];
                    q[joint] = end + inward * shift;
                    pose(&leg, &q)
                };
                let here = at(0.0);
                let mut q = [2.0 * n(21.0), 2.0 * n(22.0), 2.0 * n(23.0)];
                q[joint] = end;
                let plus = mode(&leg, &q);
                let begins = inward > 0.0;
                let named = |limit: &&Limit| {
                    let of = match limit.cause {
                        LimitCause::JointMin { joint, .. } => Some((joint, true)),
                        LimitCause::JointMax { joint, .. } => Some((joint, false)),
                        _ => None,
                    };
                    of == Some((joint, begins)) && limit.mode == Some(plus)
                };
                let Some(limit) = limits.iter().find(named) else { continue };
                let value = |pose: &Pose| {
                    limit.value(Vector2::new(pose.x, pose.y), Vector2::new(pose.phi.cos(), pose.phi.sin()))
                };
                on_surface = on_surface.max(value(&here).abs());
                // A little way into the range the leg is on the allowed side, unless the other joints move along the surface.
                let inside = limit.sense * value(&at(1e-6));
                wrong_side += usize::from(inside > 1e-13);
                checked += 1;
            }
        }
    }
    page.holds(
        "Limit::value vanishes with the joint at its end: to 1e-13, over 1000 ends",
        on_surface < 1e-13 && checked > 1000,
    );
    page.equal(
        "Limit::sense: with the joint a little inside its range, sense * value <= 0, in every case",
        &wrong_side,
        &0,
    );

    page.step(
        "Stationary in the orientation",
        "With C fixed, d|C + R b - a| = 0 where C, B, a are in line: circles about a of radius l +- b. For a line of the base the arm stands across it: \
         lines at a distance +-b. For a line of the platform through a: a circle of radius |d + m.b| about a, m the line's normal.",
    );
    let mut flat = 0.0_f64;
    for (dyad, name) in dyads() {
        let limit = Limit { leg: 0, mode: None, cause: LimitCause::Left, dyad, sense: 1.0 };
        for carrier in limit.alignments() {
            for k in 0..24 {
                let c = carrier.at(0.26 * f64::from(k));
                // On the alignment curve the two orientations on the surface have merged.
                let found = limit.orientations_at(c, 1e-12);
                let spread = found.iter().map(|phi| {
                    let turn = |x: f64| Vector2::new(x.cos(), x.sin());
                    let slope = (limit.value(c, turn(phi + 1e-5)) - limit.value(c, turn(phi - 1e-5))) / 2e-5;
                    slope.abs() + limit.value(c, turn(*phi)).abs()
                });
                flat = flat.max(spread.fold(0.0, f64::max));
                assert!(!found.is_empty(), "{name}");
            }
        }
    }
    page.holds("Limit::alignments: there value and slope vanish together, to 1e-6, for RR, PR and RP", flat < 1e-6);

    page.step(
        "Two limits of one leg",
        "Joints 1 and 2 at their ends hold B in the base: C runs on a circle about B. Joints 1 and 3: the elbow is a pivot fixed in base and platform. Joints 2 and 3: A is fixed in the \
         platform, or the orientation is given (sliders). These corners bound total and dextrous workspaces where they point into the leg's region. Only with joint 1 at an \
         end in one mode and joint 3 in the other is the corner a coupler curve, and such legs are refused for both modes at once.",
    );
    let leg = Leg { limits: [Some([0.2, 1.2]), None, Some([-1.0, 1.0])], ..Leg::rrr([0.0, 0.0], 2.0, 1.5, [0.3, 0.2]) };
    let robot = Manipulator::new("", vec![leg; 3]).expect("is sound");
    let ask = |modes: &str| {
        let kind = assur::workspace::WorkspaceKind::Dextrous;
        robot.workspace(&kind, &modes.parse().expect("names modes"))
    };
    page.holds(
        "RRR with ranges of joints 1 and 3: refused with both modes, answered with one",
        ask("both").is_err() && ask("+++").is_ok(),
    );
    page.step(
        "Names",
        "The limit of a leg's only driven joint is its \"min\" or \"max\"; other joints are named by their number.",
    );
    let name = |joint, driven| ActiveLimit::Leg { leg: 0, cause: LimitCause::JointMax { joint, driven } }.to_string();
    page.holds(
        "\"leg 1 max\", \"leg 1 joint 3 max\"",
        name(1, true) == "leg 1 max" && name(2, false) == "leg 1 joint 3 max",
    );
    page.finish()
}

/// A leg of one of the three chains, its frames anywhere, with a range for each joint.
fn random_leg(seed: i32, n: &dyn Fn(f64) -> f64) -> Leg {
    let mut leg: Leg = ["R_P_R", "_R_RR", "_P_RR"][seed as usize % 3].parse().expect("is a leg");
    leg.base = Placement::turned(n(1.0), n(2.0), 3.0 * n(3.0));
    leg.platform = Placement::turned(n(4.0), n(5.0), 3.0 * n(6.0));
    leg.links = [Placement::turned(n(7.0), n(8.0), 3.0 * n(9.0)), Placement::turned(n(10.0), n(11.0), 3.0 * n(12.0))];
    for (joint, kind) in leg.joints.into_iter().enumerate() {
        let low = 2.0 * n(13.0 + joint as f64);
        let width = if kind == JointKind::Prismatic { 1.5 } else { 2.5 };
        leg.limits[joint] = Some([low, low + width * (1.1 + n(16.0 + joint as f64))]);
    }
    leg
}

/// Where the platform is with these joint values: base · J1 · link · J2 · link · J3 = pose · platform.
fn pose(leg: &Leg, q: &[f64; 3]) -> Pose {
    let first = placed(&leg.base) * joint(leg, q, 0) * placed(&leg.links[0]);
    let chain = first * joint(leg, q, 1) * placed(&leg.links[1]) * joint(leg, q, 2);
    let pose = chain * placed(&leg.platform).inverse();
    Pose::new(pose.translation.x, pose.translation.y, pose.rotation.angle())
}

/// The working mode of a leg in these joint values, by its definition: RPR, the slider points to the platform pivot; RRR,
/// link 1 x link 2 > 0; PRR, the slider is ahead of the platform pivot.
fn mode(leg: &Leg, q: &[f64; 3]) -> bool {
    let first = placed(&leg.base) * joint(leg, q, 0) * placed(&leg.links[0]);
    let last = first * joint(leg, q, 1) * placed(&leg.links[1]);
    let [a, elbow, b] = [placed(&leg.base), first, last].map(|frame| frame.translation.vector);
    let x = |frame: &Isometry2<f64>| frame.rotation * Vector2::x();
    match leg.joints {
        [JointKind::Revolute, JointKind::Prismatic, _] => x(&first).dot(&(b - a)) > 0.0,
        [JointKind::Revolute, ..] => (elbow - a).perp(&(b - elbow)) > 0.0,
        [JointKind::Prismatic, ..] => x(&placed(&leg.base)).dot(&(elbow - b)) > 0.0,
    }
}

fn placed(p: &Placement) -> Isometry2<f64> {
    Isometry2::new(p.at, p.direction.y.atan2(p.direction.x))
}

/// The motion of a joint.
fn joint(leg: &Leg, q: &[f64; 3], k: usize) -> Isometry2<f64> {
    match leg.joints[k] {
        JointKind::Revolute => Isometry2::new(Vector2::zeros(), q[k]),
        JointKind::Prismatic => Isometry2::new(Vector2::new(q[k], 0.0), 0.0),
    }
}

/// One dyad of each kind.
fn dyads() -> [(Dyad, &'static str); 3] {
    let (a, b) = (Vector2::new(0.3, -0.5), Vector2::new(0.7, 0.4));
    let offset = assur::Offset::Distance(0.35);
    [
        (Dyad::RR { a, b, length: 1.7 }, "RR"),
        (Dyad::PR { a, u: Vector2::new(0.6, 0.8), b }, "PR"),
        (Dyad::RP { a, b, v: Vector2::new(0.8, -0.6), offset }, "RP"),
    ]
}

pub fn main() {
    print!("{}", document());
}

#[test]
fn every_step_holds() {
    assert!(!document().is_empty());
}
