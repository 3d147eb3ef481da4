//! Where an interval of orientations vanishes: the rule behind maximal and inclusive workspaces.

#[path = "page.rs"]
mod page;

use assur::nalgebra::Vector2;
use assur::plane::{PhiRange, direction};
use assur::workspace::{ArcCurve, BoundaryArc, CouplerArc, Limit, Reach, WorkspaceKind, WorkspaceModes};
use assur::{Leg, Manipulator};
use page::Page;

/// The text, with every step checked.
pub fn document() -> String {
    let mut page = Page::new(
        "The fold rule",
        "Claim: let each limit of a manipulator be g(C, phi) <= 0, allowed where all are. A place C on the boundary of what is reached with some orientation of a range has an orientation at which the active limits carry multipliers lam >= 0, \
         not all zero, with\n\n\
         sum lam dg/dphi = 0,   and   n = sum lam dg/dC points outwards;\n\n\
         an end of the range counts as a limit with dg/dphi = -1 (from) or +1 (to) and dg/dC = 0. So the boundary is made of curves of four sources: \
         one limit stationary in phi, one limit at an end of the range, two limits with dg/dphi of opposite signs, and limits that do not depend on phi.\n\n\
         Source: Fritz John (1948) for the multipliers; Merlet, Gosselin, Mouly (1998), section 3, for the curves, whose sign test by joint velocities is corrected here.",
    );
    // Integers, so that the inequalities are decided exactly.
    let draw = |k: i64, n: i64| (k * 48_271 + n * 16_807 + k * k * 69_621) % 2003 - 1001;
    let all = |claim: &dyn Fn(i64, i64, i64, i64) -> bool| {
        (1..=3000).all(|k| claim(draw(k, 1), draw(k, 2), 1 + draw(k, 3).abs(), 1 + draw(k, 4).abs()))
    };

    page.step(
        "Two limits of opposite slopes",
        "Near a pose put g1 = a1 + d1 t and g2 = a2 - d2 t with t = phi - phi*, d1, d2 > 0. The first wants t <= -a1/d1, the second t >= a2/d2. Some t does both exactly where d2 a1 + d1 a2 <= 0: one inequality in C, \
         whose gradient |dg2/dphi| grad g1 + |dg1/dphi| grad g2 is the normal n.",
    );
    page.holds(
        "some t exists if and only if d2 a1 + d1 a2 <= 0 (3000 draws of integers, t = a2/d2 tried)",
        // The least t the second allows is the best for the first.
        // In units of 1/(d1 d2) the second allows the times from a2 d1 on, the first those up to -a1 d2.
        all(&|a1, a2, d1, d2| {
            let exists = (0..3).any(|later| a2 * d1 + later <= -a1 * d2);
            exists == (d2 * a1 + d1 * a2 <= 0)
        }),
    );

    page.step(
        "Slopes of one sign bound nothing",
        "With g1 = a1 + d1 t and g2 = a2 + d2 t, d1, d2 > 0, a small enough t satisfies both, whatever a1 and a2: C can be moved either way.",
    );
    page.holds(
        "t = -(|a1| + |a2|) will do",
        all(&|a1, a2, d1, d2| {
            let t = -(a1.abs() + a2.abs());
            a1 + d1 * t <= 0 && a2 + d2 * t <= 0
        }),
    );

    page.step(
        "One limit, stationary",
        "Put g = a + k t^2. For k > 0 (g least) some t is allowed exactly where a <= 0; for k < 0 (g greatest) some t always is, and a = 0 is where two intervals merge. At an end of the range, t >= 0 \
         and g = a + d t: for d >= 0 allowed exactly where a <= 0; for d < 0 always.",
    );
    page.holds(
        "for k > 0, over all integers t in -40..40, min (a + k t^2) = a",
        all(&|a, _, k, _| (-40..=40).map(|t| a + k * t * t).min() == Some(a)),
    );
    page.holds("for k < 0, t = |a| gives a + k t^2 <= 0", all(&|a, _, k, _| a - k * a * a <= 0));

    page.step(
        "Three limits",
        "leave isolated places: the ends of arcs. They are the real modes of a triad of three dyads, one of each leg held at its limit.",
    );

    page.step(
        "The slope of a circle",
        "For |B - A| with B = C + R b: d|B - A|/dphi = (B - A)·(i R b)/|B - A|, the sign of cross(R b, B - A). It vanishes where A, B and C are in line. The velocity of the other joints does not enter: \
         a sign test with the platform held, as in the paper, asks another question.",
    );
    let (a, b) = (Vector2::new(0.3, -0.4), Vector2::new(1.1, 0.7));
    let slopes = (0..200).all(|k| {
        let (c, phi) = (Vector2::new(2.0 * f64::from(k).sin(), 3.0 * f64::from(k).cos()), 0.7 * f64::from(k));
        let turned = |phi: f64| assur::plane::product(direction(phi), b);
        let strut = c + turned(phi) - a;
        let formula = turned(phi).perp(&strut) / strut.norm();
        let step = 1e-5;
        let distance = |phi: f64| (c + turned(phi) - a).norm();
        ((distance(phi + step) - distance(phi - step)) / (2.0 * step) - formula).abs() < 1e-8
    });
    page.holds("the formula is the derivative, by differences at 200 poses", slopes);

    page.step(
        "The library obeys the rule",
        "Every coupler arc of a boundary names its two limits. At places on it both hold, their slopes are opposite with the sides they allow taken into account, n points away from the region, \
         and the place a little inside is reached while the one outside is not.",
    );
    for (what, robot, to) in [("3-RPR", rpr(), 4.4), ("3-RRR", rrr(), 3.0), ("3-PRR", prr(), 2.4)] {
        for kind in [WorkspaceKind::Maximal, WorkspaceKind::Inclusive(PhiRange::between(0.2, to))] {
            let reach = robot.reach(&WorkspaceModes::Both).expect("is covered");
            let region = reach.workspace(&kind).expect("is bounded").region;
            let arcs: Vec<&BoundaryArc> = region.loops.iter().flat_map(|each| &each.arcs).collect();
            let couplers: Vec<&CouplerArc> = arcs
                .iter()
                .filter_map(|arc| match &arc.curve {
                    ArcCurve::Coupler(arc) | ArcCurve::Ellipse(arc) => Some(&**arc),
                    _ => None,
                })
                .collect();
            let held = couplers.iter().all(|arc| (1..10).all(|k| obeys(arc, 0.1 * f64::from(k), &reach, &kind)));
            page.holds(
                &format!("{what}, {}: {} coupler arcs of {} in all", kind.name(), couplers.len(), arcs.len()),
                held,
            );
            page.equal("pieces not joined to a loop: none", &region.unclosed.len(), &0);
        }
    }
    page.finish()
}

/// Whether the rule holds at a part of an arc.
fn obeys(arc: &CouplerArc, part: f64, reach: &Reach, kind: &WorkspaceKind) -> bool {
    let (c, phi) = (Vector2::from(arc.point_at(part)), arc.phi_at(part));
    let g = |limit: &Limit, c: Vector2<f64>, phi: f64| limit.sense * limit.value(c, direction(phi));
    let step = 1e-6;
    let by_phi = |limit: &Limit| (g(limit, c, phi + step) - g(limit, c, phi - step)) / (2.0 * step);
    let gradient = |limit: &Limit| {
        let along = |d: Vector2<f64>| (g(limit, c + d * step, phi) - g(limit, c - d * step, phi)) / (2.0 * step);
        Vector2::new(along(Vector2::x()), along(Vector2::y()))
    };
    let [one, other] = &arc.pair;
    let (d1, d2) = (by_phi(one), by_phi(other));
    let outward = (gradient(one) * d2.abs() + gradient(other) * d1.abs()).normalize();
    let aside = outward * (1e-8 * reach.size());
    let holds = |limit: &Limit| g(limit, c, phi).abs() < 1e-13 * reach.size();
    // The region lies to the left.
    let along = Vector2::from(arc.point_at(part + 1e-5)) - Vector2::from(arc.point_at(part - 1e-5));
    holds(one)
        && holds(other)
        && d1 * d2 < 0.0
        && along.perp(&outward) < 0.0
        && reach.contains(kind, c - aside)
        && !reach.contains(kind, c + aside)
}

/// Manipulator 2 of the paper's table 1, with the reference point inside the platform.
fn rpr() -> Manipulator {
    let leg = |a, b, limits| Leg { limits: [None, Some(limits), None], ..Leg::rpr(a, b) };
    let legs = vec![
        leg([0.0, 0.0], [20.839, 0.0], [8.0, 12.0]),
        leg([15.91, 0.0], [10.0139, 13.1641], [5.0, 15.0]),
        leg([0.0, 10.0], [0.0, 0.0], [10.0, 17.0]),
    ];
    with_reference(legs, [8.0, 4.0])
}

fn rrr() -> Manipulator {
    let legs = vec![
        Leg::rrr([0.0, 0.0], 5.0, 4.0, [4.0, 0.0]),
        Leg::rrr([10.0, 0.0], 5.0, 4.0, [2.0, 3.5]),
        Leg::rrr([5.0, 8.7], 5.0, 4.0, [0.0, 0.0]),
    ];
    with_reference(legs, [2.0, 1.0])
}

fn prr() -> Manipulator {
    let turn = std::f64::consts::TAU / 3.0;
    let leg = |a, alpha, b| Leg { limits: [Some([1.0, 9.0]), None, None], ..Leg::prr(a, alpha, 3.5, b) };
    let legs = vec![
        leg([0.0, 0.0], 0.0, [3.0, 0.0]),
        leg([10.0, 0.0], turn, [1.5, 2.6]),
        leg([5.0, 8.66], 2.0 * turn, [0.0, 0.0]),
    ];
    with_reference(legs, [1.4, 0.8])
}

fn with_reference(legs: Vec<Leg>, reference: [f64; 2]) -> Manipulator {
    let mut robot = Manipulator::new("", legs).expect("is sound");
    robot.reference = reference.into();
    robot
}

pub fn main() {
    print!("{}", document());
}

#[test]
fn every_step_holds() {
    assert!(!document().is_empty());
}
