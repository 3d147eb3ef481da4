//! Legs whose pivots' distance decides: RPR by its stroke, RRR by its links. Their curves in all kinds of workspace.

#[path = "page.rs"]
mod page;

use assur::nalgebra::Vector2;
use assur::plane::PhiRange;
use assur::workspace::{WorkspaceKind, WorkspaceModes};
use assur::{Leg, Manipulator};
use page::Page;

/// The text, with every step checked.
pub fn document() -> String {
    let mut page = Page::new(
        "The reach of a leg whose pivots' distance decides",
        "Claim: a leg that only asks its base pivot A and its platform pivot B to be between r1 and r2 apart bounds the places of the \
         reference point C by circles about A of five radii, and by circles of radius r1, r2 where the orientation is given. Which of \
         them bounds which kind of workspace follows from one identity.\n\n\
         d = |C - A|,   b = |B - C|,   psi = the angle from A->C to C->B = phi + beta - arg(C - A)\n\
         RPR: r1, r2 are the ends of the stroke.  RRR: r1 = |l1 - l2|, r2 = l1 + l2.\n\n\
         Source: Merlet, Gosselin, Mouly (1998), sections 3, 5, 6, whose lists of circles are corrected here.",
    );
    // Integers, so that identities hold exactly or fail: a false one of degree 2 in numbers up to 10^6 passes 300 draws with
    // probability below 10^-1700.
    let draw = |k: i128, n: i128| (k * 48_271 + n * 16_807 + k * k * 69_621) % 1_000_003;
    let all =
        |identity: &dyn Fn(i128, i128, i128) -> bool| (1..=300).all(|k| identity(draw(k, 1), draw(k, 2), draw(k, 3)));

    page.step(
        "Distance against orientation",
        "C lies d from A, B lies b from C, with the exterior angle psi between: |AB|^2 = d^2 + b^2 + 2 d b cos psi. Put r for |AB| and solve for \
         cos psi; numerator and denominator of tan^2(psi/2) = (1 - cos psi)/(1 + cos psi) are differences of squares, which factor, so that no digit \
         is lost where the leg is aligned (psi = 0, pi), where an arc cosine would lose half of them.",
    );
    page.holds(
        "with 2db cos psi = r^2 - d^2 - b^2: 2db (1 - cos psi) = (d+b-r)(d+b+r)\nand 2db (1 + cos psi) = (r-d+b)(r+d-b)",
        all(&|d, b, r| {
            let cos2db = r * r - d * d - b * b;
            2 * d * b - cos2db == (d + b - r) * (d + b + r) && 2 * d * b + cos2db == (r - d + b) * (r + d - b)
        }),
    );

    page.step(
        "The set of orientations at a place",
        "|AB| falls from d + b at psi = 0 to |d - b| at psi = pi, without turning back in between. So the leg allows |psi| from psi(r2) to psi(r1): \
         two intervals, which merge at psi = 0 where d + b <= r2 and at psi = pi where |d - b| >= r1; none where |d - b| > r2 or \
         d + b < r1; every orientation or none where b = 0 or d = 0.",
    );
    let (r1, r2, a, b) = (2.0, 5.0, Vector2::new(0.3, -0.7), Vector2::new(1.1, 0.4));
    let robot = same_legs(Leg { limits: [None, Some([r1, r2]), None], ..Leg::rpr([a.x, a.y], [b.x, b.y]) });
    let reach = robot.reach(&WorkspaceModes::Both).expect("is covered");
    let arm = b.norm();
    let mut worst = 0.0_f64;
    let mut ends = 0;
    for k in 0..400 {
        let (d, turn) = (0.02 * f64::from(k), f64::from(k));
        let c = a + d * Vector2::new(turn.cos(), turn.sin());
        for phi in reach.orientations(c).intervals().iter().flatten().filter(|_| !reach.orientations(c).is_full()) {
            let pivot = c + Vector2::new(phi.cos() * b.x - phi.sin() * b.y, phi.sin() * b.x + phi.cos() * b.y);
            let distance = (pivot - a).norm();
            worst = worst.max((distance - r1).abs().min((distance - r2).abs()));
            ends += 1;
        }
    }
    page.holds(
        "Reach::orientations: every end of an interval has |AB| = r1 or r2, to 1e-13",
        worst < 1e-13 && ends > 200,
    );

    page.step(
        "Five circles",
        "The distance is stationary at psi = 0 and pi alone. A limit holds there on a circle about A:\n\
         \n\
         d            limit  psi  order    |AB| - limit   bounds\n\
         r2 + b       r2     pi   A,B,C    least          maximal, inclusive (outside)\n\
         b - r2       r2     pi   C,A,B    least          maximal, inclusive (inside), where b > r2\n\
         r1 - b       r1     0    A,C,B    least          maximal, inclusive (inside), where r1 > b\n\
         r2 - b       r2     0    A,C,B    greatest       total, dextrous (outside)\n\
         r1 + b       r1     pi   A,B,C    greatest       total, dextrous (inside)\n\
         b - r1       r1     pi   C,A,B    greatest       total, dextrous (outside), where b > r1\n\
         \n\
         \"Least\" and \"greatest\" are of the violation over the orientations. A union over orientations ends where even the least \
         violation is zero, an intersection where the greatest is; a limit in the wrong column only splits or joins intervals. The paper bounds the maximal \
         workspace by b - r1 as well (its cases 3 and 4) and leaves it out of the dextrous one, where B runs around the hole; with r2 - r1 = 2b the dextrous ring is a circle.",
    );
    let probe = |kind: &WorkspaceKind, d: f64| reach.contains(kind, a + Vector2::new(0.6 * d, 0.8 * d));
    for (what, kind, inner, outer) in [
        ("maximal: r1 - b <= d <= r2 + b", WorkspaceKind::Maximal, r1 - arm, r2 + arm),
        ("dextrous: r1 + b <= d <= r2 - b", WorkspaceKind::Dextrous, r1 + arm, r2 - arm),
    ] {
        let e = 1e-12;
        let sharp =
            !probe(&kind, inner - e) && probe(&kind, inner + e) && probe(&kind, outer - e) && !probe(&kind, outer + e);
        page.holds(&format!("Reach::contains, {what}, sharp to 1e-12"), sharp);
    }
    let dextrous = robot.workspace(&WorkspaceKind::Dextrous, &WorkspaceModes::Both).expect("is covered").region;
    let ring = std::f64::consts::PI * ((r2 - arm).powi(2) - (r1 + arm).powi(2));
    page.holds("dextrous area = pi ((r2-b)^2 - (r1+b)^2), to 1e-13", (dextrous.area / ring - 1.0).abs() < 1e-13);
    let long = same_legs(Leg { limits: [None, Some([1.0, 6.0]), None], ..Leg::rpr([0.0, 0.0], [3.0, 0.0]) });
    let dextrous = long.workspace(&WorkspaceKind::Dextrous, &WorkspaceModes::Both).expect("is covered").region;
    page.holds(
        "b = 3, r1 = 1, r2 = 6: only the disc d <= b - r1 = 2, area 4 pi, to 1e-13",
        (dextrous.area / (4.0 * std::f64::consts::PI) - 1.0).abs() < 1e-13,
    );
    page.equal("and no ring, r1 + b > r2 - b: one loop", &dextrous.loops.len(), &1);

    page.step(
        "Every orientation of a range",
        "Over a range T the greatest and the least distance are at the ends of T, or at psi = 0, pi where those lie in T: C - A, or A - C, \
         then points into the sector that the arm sweeps. So the bounds are the circles of radius r1, r2 about A - R(phi) b at both ends of T, and of the \
         alignment circles the arcs within that sector; at its edges they touch (same point, same tangent), because there the end of T is the aligned orientation.",
    );
    let range = PhiRange { from: 0.4, width: 0.9 };
    let mut agree = true;
    for k in 0..2000 {
        let (d, turn) = (0.003 * f64::from(k), 2.4 * f64::from(k));
        let c = a + d * Vector2::new(turn.cos(), turn.sin());
        let sampled = (0..=4000).all(|n| reach.allows(c, range.from + range.width * f64::from(n) / 4000.0));
        let exact = reach.contains(&WorkspaceKind::Total(range), c);
        // Between samples the distance changes by less than b (width/8000)^2.
        let margin = reach.membership(&WorkspaceKind::Total(range), c).margin;
        agree &= sampled == exact || margin.abs() < 1e-7;
    }
    page.holds("Reach::contains(Total) agrees with 4001 orientations at 2000 places", agree);

    page.step(
        "RRR",
        "Full-turn joints leave |l1 - l2| <= |AB| <= l1 + l2: bounds are not ends of a joint but the leg stretched and folded, where its working modes \
         merge. Links of equal length fold to r1 = 0, which bounds nothing: no inner circle in any kind.",
    );
    let equal = same_legs(Leg::rrr([0.0, 0.0], 1.5, 1.5, [0.5, 0.0]));
    let dextrous = equal.workspace(&WorkspaceKind::Dextrous, &WorkspaceModes::Both).expect("is covered").region;
    page.holds(
        "l1 = l2 = 1.5, b = 0.5: dextrous is the whole disc d <= 2.5, bounded by \"leg 1 stretched\"",
        dextrous.loops.len() == 1
            && (dextrous.area / (6.25 * std::f64::consts::PI) - 1.0).abs() < 1e-13
            && dextrous.loops[0].arcs[0].active[0].to_string() == "leg 1 stretched",
    );
    page.finish()
}

/// Three legs that are one and the same bound like one.
fn same_legs(leg: Leg) -> Manipulator {
    Manipulator::new("", vec![leg; 3]).expect("is sound")
}

pub fn main() {
    print!("{}", document());
}

#[test]
fn every_step_holds() {
    assert!(!document().is_empty());
}
