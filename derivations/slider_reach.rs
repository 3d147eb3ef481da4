//! What a PRR leg reaches, and 3-PRR's region: segments, half circles, the lens and its tips.

#[path = "page.rs"]
mod page;

use std::f64::consts::PI;

use assur::nalgebra::Vector2;
use assur::workspace::{WorkspaceKind, WorkspaceModes};
use assur::{Leg, Manipulator};
use page::Page;

/// The text, with every step checked.
pub fn document() -> String {
    let mut page = Page::new(
        "The reach of a slider with a link",
        "Claim: a PRR leg allows its platform pivot B exactly the places within l of the slider's travel, except those nearer than l to both its ends; one \
         working mode alone a band of area 2 l D. The maximal, total and dextrous workspaces follow by offsets.\n\n\
         M1, M2 = the slider's pivot at both ends of its stroke,   D = |M1 M2|,   l = the link,\n\
         e = the slider's direction,\n\
         B = M1 + t e + h n,   n = e turned by 90 degrees\n\n\
         Source: Gosselin, Lemieux, Merlet (1996), eqs. (20)-(37); Merlet, Gosselin, Mouly (1998), sections 3.4, 5.3, 6.3. Corrected: the signs in (20), (21); \
         lines bound without any joint at an end; the void is the open lens; arcs about its tips.",
    );

    page.step(
        "Both modes: a stadium without a lens",
        "B is allowed if some slider place M on the travel has |B - M| = l. |B - M| is continuous in M; its least value is the distance of B from the segment, its \
         greatest value is at an end. So B is allowed if and only if dist(B, M1M2) <= l <= max(|B - M1|, |B - M2|). The second fails in the open lens \
         of the discs about M1 and M2, which is empty where D >= 2l: eq. (37) with equality included.",
    );
    let (l, d) = (1.5, 2.0);
    let lens = lens_area(l, d);
    let leg = |d: f64, b: f64| {
        let leg = Leg::prr([0.4, -0.3], 0.7, l, [b, 0.0]);
        same_legs(Leg { limits: [Some([1.0, 1.0 + d]), None, None], ..leg })
    };
    let region = |robot: &Manipulator, kind: &WorkspaceKind, modes: &str| {
        let modes = modes.parse().expect("names modes");
        robot.workspace(kind, &modes).expect("is covered").region
    };
    let constant = WorkspaceKind::Constant { phi: 0.2 };
    let close = |found: f64, expected: f64| (found - expected).abs() <= 1e-13 * expected.abs().max(1.0);
    let whole = region(&leg(d, 0.3), &constant, "both");
    page.holds(
        "l = 1.5, D = 2: area = pi l^2 + 2 l D - lens, with one hole of two arcs",
        close(whole.area, PI * l * l + 2.0 * l * d - lens) && whole.holes == 1 && whole.loops.len() == 2,
    );
    let free = region(&leg(3.5, 0.3), &constant, "both");
    page.holds(
        "D = 3.5 > 2l: area = pi l^2 + 2 l D, no hole",
        close(free.area, PI * l * l + 2.0 * l * 3.5) && free.holes == 0,
    );
    let touching = region(&leg(3.0, 0.3), &constant, "both");
    page.holds("D = 2l: the lens is a point, which belongs to the region", touching.holes == 0);

    page.step(
        "One mode: a shifted band",
        "In the mode + the slider is ahead: rho = t + sqrt(l^2 - h^2). For each |h| <= l this allows t an interval of length D: a band between two half circles of the same shape, \
         shifted against each other by D. Its area is 2 l D by Cavalieri, and it has no void.",
    );
    for modes in ["+++", "---"] {
        let band = region(&leg(d, 0.3), &constant, modes);
        let name = format!("mode {modes}: area = 2 l D, perimeter = 2 D + 2 pi l, four arcs, no hole");
        let arcs = band.loops[0].arcs.len();
        page.holds(
            &name,
            close(band.area, 2.0 * l * d)
                && close(band.perimeter, 2.0 * d + 2.0 * PI * l)
                && arcs == 4
                && band.holes == 0,
        );
    }

    page.step(
        "The sides bound with no joint at an end",
        "On the segments h = +-l the link stands across the slider, whose stroke is inside its range: a bound where the modes merge, not an extreme leg. Merlet, \
         Gosselin, Mouly take \"on the boundary\" to mean \"a slider at an end\" and miss them, and with them the slider-crank quartics and ellipses that pairs of legs add.",
    );
    let sides =
        whole.loops.iter().flat_map(|l| &l.arcs).filter(|arc| arc.active[0].to_string() == "leg 1 side").count();
    page.equal("two arcs of the region are named \"leg 1 side\"", &sides, &2);

    page.step(
        "Dextrous: offsets, and arcs about the tips",
        "With every orientation B runs round a circle of radius b about C, which must lie in the stadium and must not enter the lens: dist(C, M1M2) <= l - b, \
         and either dist(C, lens) >= b, or the circle surrounds the lens: |C - V+| <= b and |C - V-| <= b, V+- its tips. The points b from the lens are arcs of radius l + b about \
         M1, M2 and arcs of radius b about the tips: where B is in a tip, two limits of the same leg are met, the one kind of corner that bounds an intersection over orientations. \
         By Steiner's formula the lens grown by b has area: lens + b perimeter + pi b^2.",
    );
    let b = 0.15;
    let half = (d / (2.0 * l)).acos();
    let grown = lens + b * 4.0 * half * l + PI * b * b;
    let dextrous = region(&leg(d, b), &WorkspaceKind::Dextrous, "both");
    let stadium = PI * (l - b).powi(2) + 2.0 * (l - b) * d;
    // The grown lens sticks out of the shrunk stadium where its tips are higher than l - 2b.
    let tip = (l * l - 0.25 * d * d).sqrt();
    page.holds("the grown lens lies inside the shrunk stadium: sqrt(l^2 - D^2/4) + b <= l - b", tip + b <= l - b);
    page.holds("b = 0.15: area = pi (l-b)^2 + 2 (l-b) D - grown lens, one hole of four arcs", {
        close(dextrous.area, stadium - grown)
            && dextrous.holes == 1
            && dextrous.loops.iter().any(|l| l.area < 0.0 && l.arcs.len() == 4)
    });
    let narrow = 2.8;
    let surrounding = region(&leg(narrow, 0.75), &WorkspaceKind::Dextrous, "both");
    let tip = (l * l - 0.25 * narrow * narrow).sqrt();
    let inside = |x: f64, y: f64| {
        let (e, n) = (Vector2::new(0.7_f64.cos(), 0.7_f64.sin()), Vector2::new(-(0.7_f64.sin()), 0.7_f64.cos()));
        let c = Vector2::new(0.4, -0.3) + (1.0 + 0.5 * narrow + x) * e + y * n;
        leg(narrow, 0.75).reach(&WorkspaceModes::Both).expect("is covered").contains(&WorkspaceKind::Dextrous, c)
    };
    // On the axis |C - V| = b at x = sqrt(b^2 - tip^2).
    let edge = (0.75_f64.powi(2) - tip * tip).sqrt();
    page.holds(
        "D = 2.8, b = 0.75: B runs around the lens about its middle; that part ends at |C - V| = b",
        surrounding.area > 0.0 && inside(0.0, 0.0) && inside(edge - 1e-9, 0.0) && !inside(edge + 1e-9, 0.0),
    );

    page.step(
        "3-PRR's region",
        "At a given orientation C = B - R b, so each leg allows its own region shifted, and the workspace is the intersection of three. All curves are circles of radius l and \
         lines; pieces of two legs may lie on one line (parallel rails), so each piece is decided by membership on both its sides. Square design: rails at 0, 90, 0 degrees, \
         l = 1, no void: at phi = 0 the workspace is the square of side 2l.",
    );
    let rails = [([-4.0, 0.0], 0.0, [-0.3, 0.0]), ([0.0, -4.0], 0.5 * PI, [0.0, -0.3]), ([-4.0, 0.3], 0.0, [0.3, 0.3])];
    let legs = rails.map(|(a, alpha, c)| Leg { limits: [Some([0.0, 8.0]), None, None], ..Leg::prr(a, alpha, 1.0, c) });
    let square = region(
        &Manipulator::new("square", legs.to_vec()).expect("is sound"),
        &WorkspaceKind::Constant { phi: 0.0 },
        "both",
    );
    page.holds(
        "area 4, perimeter 8, four segments although legs 1 and 3 share two lines",
        close(square.area, 4.0) && close(square.perimeter, 8.0) && square.loops[0].arcs.len() == 4,
    );
    page.finish()
}

/// The area common to two discs of radius `l` whose centres are `d` apart.
fn lens_area(l: f64, d: f64) -> f64 {
    2.0 * l * l * (d / (2.0 * l)).acos() - 0.5 * d * (4.0 * l * l - d * d).sqrt()
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
